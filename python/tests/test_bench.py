"""What a call costs beside the same call from C."""

import shutil
from timeit import repeat

import numpy as np
import pytest

import toron


#: Microseconds that NumPy takes to add three numbers to three on a machine where `evaluate` takes 2.3.
ADDITION = 0.35
#: Microseconds of the same call from C there.
CALL = 0.17


def slowness() -> float:
    """How much slower Python is now than on that machine: clocks change, and other programs share the caches."""
    a, b = np.ones(3), np.empty(3)
    return max(1.0, 1e6 * min(repeat(lambda: np.add(a, a, out=b), number=200, repeat=300)) / 200 / ADDITION)


@pytest.mark.skipif(not (shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")), reason="no C compiler")
def test_overhead(capsys):
    # Another program on the machine may disturb a table.
    for _ in range(4):
        before = slowness()
        table = toron.bench()
        assert list(table) == [1, 1000, 1_000_000]
        assert "microseconds a call" in capsys.readouterr().out
        # Another processor may be slower at calls than NumPy's addition shows.
        slower = max(before, table[1]["C"] / CALL)
        if table[1]["evaluate"] <= 3 * slower and table[1_000_000]["evaluate"] <= 1.1 * table[1_000_000]["C"]:
            break
    else:
        raise AssertionError(f"{table}")
    assert table[1]["bound"] < table[1]["evaluate"]
