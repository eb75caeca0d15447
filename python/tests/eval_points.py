"""Points through the package, one JSON object a line, in and out as `toron eval`; `--f32`: in single precision.

    python3 eval_points.py < ../../tests/truth/points.jsonl > results.jsonl
"""

import json
import sys

import numpy as np
from test_truth import amid_others
from truth import TABLE_ORDER


def main() -> None:
    dtype = np.float32 if "--f32" in sys.argv[1:] else np.float64
    for number, line in enumerate(sys.stdin):
        case = json.loads(line)
        found = amid_others({"id": number} | case, dtype, ("first", "last")[number % 2])
        answer = dict(zip(("wel", "wtc", "wtd", "wld"), found["energies"].tolist()))
        answer |= zip(("iel", "itc", "itd", "ild"), found["invariants"].tolist())
        answer |= zip(("Sel", "Stc", "Std", "Sld"), found["modes"][:, TABLE_ORDER].tolist())
        answer["sigma"] = found["stress"][TABLE_ORDER].tolist()
        answer["ddsdde"] = found["tangent"][np.ix_(TABLE_ORDER, TABLE_ORDER)].tolist()
        answer["failed"] = bool(found["failed"])
        print(json.dumps(answer))


main()
