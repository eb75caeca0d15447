"""The law with friction against its truth table: every step from the state that the step before left."""

import json
from decimal import Decimal, getcontext
from pathlib import Path

import numpy as np
import pytest

import toron

getcontext().prec = 40
TABLE = Path(__file__).parents[2] / "tests/truth/friction.jsonl"
#: 11 22 33 12 13 23, the order of the table, in that of the library.
ORDER = [0, 1, 2, 3, 5, 4]
EPSILON = Decimal(2) ** -53


def _cases() -> list[dict]:
    with TABLE.open(encoding="utf-8") as lines:
        return [json.loads(line) for line in lines]


def _norm(values) -> Decimal:
    weights = [1, 1, 1, 2, 2, 2] if len(values) == 6 else [1] * len(values)
    return sum(w * v * v for w, v in zip(weights, values)).sqrt()


def _roundings(found, truth, sensitivity: Decimal) -> float:
    exact = [Decimal(x) for x in truth]
    error = _norm([Decimal(float(a)) - b for a, b in zip(found, exact)])
    scale = EPSILON * (_norm(exact) + sensitivity)
    return float(error / scale) if error else 0.0


@pytest.mark.parametrize("layout", ["first", "last"])
def test_truth(layout):
    cases = _cases()
    assert len(cases) == 88
    for case in cases:
        law = toron.Frictional(**case["properties"], **dict(zip(("m_1", "m_2", "m_3"), case["m"])))
        n, place = 2 + case["id"] % 5, case["id"] % 2
        state = law.new_state(n)
        slip_1, i_te, w_fr = (law.state_index(name) for name in ("slip_1", "i_te", "w_fr"))
        state[place, slip_1 : slip_1 + 2], state[place, i_te], state[place, w_fr] = case["before"][:2], *case["before"][2:]
        sums = dict.fromkeys(("sigma", "slip", "i_te", "w_fr"), Decimal(0))
        for F, after in zip(case["path"], case["after"]):
            gradients = np.tile(np.diag([1.01, 0.99, 0.98]), (n, 1, 1))
            gradients[place] = F
            if layout == "last":
                turned = np.ascontiguousarray(np.moveaxis(state, 0, -1))
                stress = law.stress(np.moveaxis(gradients, 0, -1), state=turned, points="last")[:, place]
                state = np.ascontiguousarray(np.moveaxis(turned, -1, 0))
            else:
                stress = law.stress(gradients, state=state)[place]
            new = state[place]
            found = {"sigma": stress[ORDER], "slip": new[slip_1 : slip_1 + 2], "i_te": [new[i_te]], "w_fr": [new[w_fr]]}
            for name, values in found.items():
                if name not in after:
                    continue
                sums[name] += Decimal(after["K"][name])
                truth = after[name] if isinstance(after[name], list) else [after[name]]
                assert _roundings(values, truth, sums[name]) <= 4, (case["id"], name)


def test_tables_and_presets():
    law = toron.Frictional.from_preset("kevlar-km2-600-frictional", units="mm-tonne-s")
    assert law.properties["mu"] == 0.15 and law.properties["cohesion"] == 0.0
    assert len(law.properties_table()) == 13 and len(law.state_table()) == 15
    assert law.replace(cohesion=0.2).properties["cohesion"] == 0.2
    with pytest.raises(toron.PropertyError, match="property 12 .mu, .* is 1.0; allowed: a number from 0 to below 1"):
        law.replace(mu=1.0)
    with pytest.raises(toron.PropertyError, match="is of another law"):
        toron.Frictional.from_preset("kevlar-km2-600", units="si")


def test_parts_of_the_state_and_the_tangent():
    law = toron.Frictional(k_el=82341.0, k_tc=1055.0, p=2.2, k_td=649.74, mu=0.25, cohesion=0.3)
    F = np.array([[1.01, 0.02, 0.0], [0.0, 1.1, 0.05], [0.0, 0.0, 0.7]])
    found = law.evaluate(F, outputs=("stress", "state", "tangent"), tangent="jaumann")
    parts = law.evaluate(F, outputs=("energies", "invariants", "failure"))
    np.testing.assert_array_equal(found["state"], np.concatenate([parts[name] for name in ("energies", "invariants", "failure")]))
    assert parts["failure"].shape == (7,) and parts["failure"][0] > 0
    unsymmetric = np.abs(found["tangent"] - found["tangent"].T).max()
    assert unsymmetric > 1.0
    single = law.evaluate(F.astype(np.float32), outputs="state")["state"]
    np.testing.assert_allclose(single, found["state"], rtol=2e-5, atol=1e-6)
