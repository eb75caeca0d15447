"""The truth table of the repository, and the measure of an answer against it.

`tests/common/truth.rs` says what the measures are: a result is as good as its input allows where its error is about one rounding of
the value plus what one rounding of each entry of F does to it. Computed with 40 digits.
"""

import json
from decimal import Decimal, getcontext
from pathlib import Path

import numpy as np

getcontext().prec = 40
POINTS = Path(__file__).parents[2] / "tests/truth/points.jsonl"
#: 11 22 33 12 13 23, the order of the table, in that of the library.
TABLE_ORDER = [0, 1, 2, 3, 5, 4]
#: The categories in which the stresses by mode are held.
MODES_HELD = ("small", "degenerate", "moderate", "failure", "units", "fibre_direction")


def cases() -> list[dict]:
    with POINTS.open(encoding="utf-8") as lines:
        return [json.loads(line) for line in lines]


def properties(case: dict) -> dict[str, float]:
    p = case["params"]
    names = {"k_el": "kel", "k_tc": "ktc", "p": "p", "k_td": "ktd", "k_ld": "kld", "eps_lim": "eps_lim", "alpha": "alpha", "beta": "beta"}
    return {name: p[other] for name, other in names.items()} | dict(zip(("m_1", "m_2", "m_3"), case["m"]))


def _decimals(values) -> list[Decimal]:
    """Exactly; what is no number is as wrong as can be."""
    return [Decimal(float(v)) if np.isfinite(v) else Decimal("1e300") for v in values]


def _size(tensor) -> Decimal:
    return (sum(x * x for x in tensor[:3]) + 2 * sum(x * x for x in tensor[3:])).sqrt()


def _ratio(error: Decimal, scale: Decimal) -> float:
    return float(error / scale) if scale else (0.0 if error == 0 else float("inf"))


def score(case: dict, answer: dict, epsilon: float) -> dict[str, float]:
    """The measures of one answer: arrays stress (6,), modes (4, 6), energies (4,), invariants (4,), tangent (6, 6) in the library's order."""
    eps, result = Decimal(epsilon), {}
    truth = [Decimal(x) for x in case["sigma"]]
    stress = _decimals(answer["stress"][TABLE_ORDER])
    error, size = _size([a - b for a, b in zip(stress, truth)]), _size(truth)
    result["back"] = _ratio(error, eps * (size + Decimal(case["sensitivity"])))
    result["forward"] = _ratio(error, size) if size else 0.0
    sensitivities = [Decimal(x) for x in case["sensitivity_invariants"]]
    truths, scale = [Decimal(case[name]) for name in ("iel", "itc", "itd", "ild")], []
    errors = []
    for k, found in enumerate(_decimals(answer["invariants"])):
        errors.append(_ratio(abs(found - truths[k]), eps * (abs(truths[k]) + sensitivities[k])))
        # A kink within rounding counts.
        scale.append(abs(truths[k]) + 4 * eps * sensitivities[k])
    result["invariants"] = max(errors)
    p = case["params"]
    slopes = [
        Decimal(p["kel"]) * scale[0],
        Decimal(p["p"] * p["ktc"] * float(scale[1]) ** (p["p"] - 1)),
        Decimal(p["ktd"]) * scale[2],
        Decimal(p["kld"]) * scale[3],
    ]
    errors = []
    for k, (name, found) in enumerate(zip(("wel", "wtc", "wtd", "wld"), _decimals(answer["energies"]))):
        energy = Decimal(case[name])
        errors.append(_ratio(abs(found - energy), eps * (abs(energy) + slopes[k] * sensitivities[k])))
    result["energies"] = max(errors)
    modes = [[Decimal(x) for x in case[name]] for name in ("Sel", "Stc", "Std", "Sld")]
    whole = sum(map(_size, modes))
    found = [_decimals(mode[TABLE_ORDER]) for mode in answer["modes"]]
    result["modes"] = max(_ratio(_size([a - b for a, b in zip(f, t)]), whole) for f, t in zip(found, modes))
    if "ddsdde" in case:
        rows = [[Decimal(x) for x in row] for row in case["ddsdde"]]
        found = [_decimals(row) for row in answer["tangent"][np.ix_(TABLE_ORDER, TABLE_ORDER)]]
        differences = sum((a - b) ** 2 for f, t in zip(found, rows) for a, b in zip(f, t)).sqrt()
        result["tangent"] = _ratio(differences, sum(x * x for row in rows for x in row).sqrt())
    limit = (1 + Decimal(p["eps_lim"])).ln()
    decided = abs(Decimal(case["fail_margin"])) > Decimal(0 if epsilon < 1e-10 else "1e-6") * limit
    result["wrong"] = float(decided and bool(answer["failed"]) != case["failed"])
    return result


def worst(scores: list[tuple[str, dict[str, float]]]) -> dict[str, dict[str, float]]:
    """The worst of each measure by category."""
    table: dict[str, dict[str, float]] = {}
    for category, measures in scores:
        row = table.setdefault(category, {})
        for name, value in measures.items():
            row[name] = max(value, row.get(name, 0.0)) if name != "wrong" else row.get(name, 0.0) + value
    return table
