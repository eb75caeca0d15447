"""Whether what `press.py` printed with one process and with two is right: `check.py one.txt two.txt`."""

import sys
from pathlib import Path

#: What rounding leaves of a residual.
ROUNDING = 1e-12
#: r' ≤ C r². A tangent that is off by 1 % leaves r' = 0.01 r, far more at the last residuals.
CONSTANT = 50.0
#: The largest difference of the answers: that of a sum in another order.
SAME = 1e-12


def lines(path: str, name: str) -> list[list[str]]:
    found = [line.split()[1:] for line in Path(path).read_text(encoding="utf-8").splitlines() if line.startswith(name)]
    assert found, f"{path} has no line {name}"
    return found


answers = []
for path, processes in zip(sys.argv[1:], (1, 2), strict=True):
    assert lines(path, "processes")[0][0] == str(processes), f"{path} is not of {processes} processes"
    increments = lines(path, "residuals")
    assert len(increments) == 5
    for increment in increments:
        a, b, c = (float(norm) for norm in increment[-3:])
        for before, after in ((a, b), (b, c)):
            assert after <= max(CONSTANT * before**2, ROUNDING), f"{path}: {before} is followed by {after}"
        assert c < ROUNDING < b, f"{path}: {increment}"
    answers.append([float(number) for number in lines(path, "answer")[0]])
one, two = answers
difference = max(abs(a - b) / abs(a) for a, b in zip(one, two, strict=True))
assert difference < SAME, f"{one} and {two}"
print(f"quadratic in all increments; answers of 1 and 2 processes differ by {difference:.1e}")
