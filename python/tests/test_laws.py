"""The laws as objects: properties, presets, tables, tangents, failure, the linear law's steps."""

import copy
import pickle

import numpy as np
import pytest

import toron


def test_presets_in_units():
    yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s")
    assert yarn.properties["k_el"] == pytest.approx(82341.0, rel=1e-14) and yarn.density == pytest.approx(1.3514e-9, rel=1e-14)
    si = toron.Hyperelastic.from_preset("kevlar-km2-600", units="si")
    F = np.diag([1.02, 1.0, 0.8])
    np.testing.assert_allclose(si.stress(F), 1e6 * yarn.stress(F), rtol=1e-13)
    np.testing.assert_allclose(yarn.stress(F)[:3], [1998.25, -57.91, -146.75], atol=0.005)  # as docs/guides/c.md prints
    other = toron.Hyperelastic.from_preset("kevlar-km2-600", "mm-tonne-s", k_ld=7.0, m_1=0.0, m_3=2.0)
    assert (other.properties["k_ld"], other.properties["m_3"]) == (7.0, 2.0)


def test_tables():
    names = [row.name for row in toron.Hyperelastic.properties_table()]
    assert names == ["k_el", "k_tc", "p", "k_td", "k_ld", "eps_lim", "alpha", "beta", "m_1", "m_2", "m_3"]
    p = toron.Hyperelastic.properties_table()[2]
    assert (p.default, p.minimum, p.minimum_excluded, p.maximum, p.unit) == (None, 1.0, True, 40.0, "-")
    k_el = toron.Hyperelastic.properties_table()[0]
    assert (k_el.unit, k_el.mass, k_el.length, k_el.time) == ("stress", 1, -1, -2)
    states = [row.name for row in toron.Hyperelastic.state_table()]
    assert states[:4] == ["w_el", "w_tc", "w_td", "w_ld"] and states[-2:] == ["failed", "alive"]
    assert [toron.Hyperelastic.state_index(name) for name in states] == list(range(11))
    assert len(toron.LinearElastic.properties_table()) == len(toron.LinearElastic.state_table()) == 10


def test_a_law_is_its_properties(yarn, linear):
    for law in (yarn, linear.replace(rotation="polar", criterion="fibre")):
        again = pickle.loads(pickle.dumps(law))
        assert repr(again) == repr(law) and again.properties == law.properties and again.density == law.density
    assert pickle.loads(pickle.dumps(linear.replace(rotation="polar"))).rotation == "polar"
    values = list(yarn.properties.values())
    assert toron.Hyperelastic.from_values(values, yarn.density).properties == yarn.properties
    assert eval(repr(yarn), {"Hyperelastic": toron.Hyperelastic}).properties == yarn.properties
    with pytest.raises(TypeError):
        yarn.properties["k_el"] = 1.0


def test_laws_of_the_same_properties_are_equal(yarn, linear):
    others = (yarn, yarn.replace(k_el=1.0)), (linear, linear.replace(rotation="polar")), (linear, linear.replace(criterion="fibre"))
    for law, other in others:
        for same in (pickle.loads(pickle.dumps(law)), copy.deepcopy(law), law.replace()):
            assert same == law and hash(same) == hash(law) and {law: 1}[same] == 1
            assert same is not law
        assert law != other and law != law.replace(density=1.0) and law.replace(density=1.0) != law.replace(density=None)
        assert law != dict(law.properties) and law != None  # noqa: E711
    assert yarn != linear


def test_a_law_does_not_change(yarn, linear):
    attempts = (yarn, "k_el", 3), (yarn, "density", 1.0), (yarn, "k_ell", 3), (linear, "rotation", "spin"), (linear, "criterion", "fibre")
    for law, name, value in attempts:
        before = repr(law)
        for kind in (toron.Error, AttributeError):
            with pytest.raises(kind, match=rf"^{name} cannot be set.*law\.replace\({name}=…\)"):
                setattr(law, name, value)
        assert repr(law) == before and not hasattr(law, "k_ell")


def test_the_stress_is_linear_in_the_stiffness(yarn, gradients):
    double = yarn.replace(**{name: 2 * yarn.properties[name] for name in ("k_el", "k_tc", "k_td", "k_ld")})
    np.testing.assert_allclose(double.stress(gradients(9)), 2 * yarn.stress(gradients(9)), rtol=1e-12)


def test_the_nominal_tangent_is_the_derivative_of_p(yarn, gradients):
    F = gradients(6)
    tangent, h = yarn.tangent(F, "nominal"), 1e-6
    first = lambda F: toron.first_piola_kirchhoff(F, yarn.stress(F))  # noqa: E731
    for k in range(3):
        for l in range(3):
            step = np.zeros((3, 3))
            step[k, l] = h
            difference = (first(F + step) - first(F - step)) / (2 * h)
            np.testing.assert_allclose(tangent[:, :, :, k, l], difference, atol=2e-6 * np.abs(tangent).max())


def test_measures_of_stress(yarn, gradients):
    F = gradients(10)
    found = yarn.evaluate(F, outputs=("stress", "modes"))
    sigma, P = toron.matrix(found["stress"]), toron.first_piola_kirchhoff(F, found["stress"])
    S = toron.matrix(toron.second_piola_kirchhoff(found["modes"]))
    np.testing.assert_allclose(P, F @ S, rtol=1e-9, atol=1e-9 * np.abs(P).max())
    J = np.linalg.det(F)[:, None, None]
    np.testing.assert_allclose(P @ F.transpose(0, 2, 1) / J, sigma, rtol=1e-9, atol=1e-9 * np.abs(sigma).max())
    other = toron.first_piola_kirchhoff(np.moveaxis(F, 0, -1), found["stress"].T, points="last")
    np.testing.assert_array_equal(np.moveaxis(other, -1, 0), P)
    bad = np.full((3, 3), np.nan)
    np.testing.assert_array_equal(toron.first_piola_kirchhoff(bad, np.zeros(6)), np.zeros((3, 3)))


def test_failure_is_a_latch(yarn):
    state, F = yarn.new_state(2), np.tile(np.eye(3), (2, 1, 1))
    failed, active = yarn.state_index("failed"), np.empty(2)
    for stretch, expected in ((1.01, 0), (1.06, 1), (1.01, 1)):
        F[1, 0, 0] = stretch
        stress = yarn.evaluate(F, outputs=("stress",), out={"active": active}, state=state)["stress"]
        assert (state[1, failed], active[1]) == (expected, 1 - expected)
        # The call that detects failure returns the intact stress.
        assert (stress[1, 0] > 100) == (stretch == 1.06 or expected == 0)
    assert state[0, failed] == 0 and active[0] == 1
    F[1, 0, 0] = 1.06
    assert yarn.stress(F)[1, 0] > 1000, "without a state nothing fails"


def test_wave_speed_and_density(yarn):
    speed = yarn.evaluate(np.eye(3), outputs="wave_speed")["wave_speed"]
    assert speed == pytest.approx(np.sqrt(yarn.properties["k_el"] / yarn.density), rel=1e-3)
    quarter = yarn.evaluate(np.eye(3), outputs="wave_speed", density=4 * yarn.density)["wave_speed"]
    assert quarter == pytest.approx(speed / 2, rel=1e-12)
    with pytest.raises(toron.ArgumentError, match="density"):
        toron.Hyperelastic.from_values(list(yarn.properties.values())).evaluate(np.eye(3), outputs="wave_speed")


def test_least_acoustic_eigenvalue(yarn):
    least, normal = yarn.least_acoustic_eigenvalue(np.diag([1.01, 0.95, 0.95]))
    assert least > 0 and np.linalg.norm(normal) == pytest.approx(1)
    pressed, _ = yarn.replace(k_ld=0.0).least_acoustic_eigenvalue(np.diag([1.0, 0.5, 0.5]))
    assert pressed < 0, "a pressed yarn without longitudinal shear stiffness buckles"
    with pytest.raises(toron.PointError):
        yarn.least_acoustic_eigenvalue(np.diag([1.0, -1.0, 1.0]))


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_a_step_of_the_linear_law(linear, dtype):
    old, new = np.tile(np.eye(3, dtype=dtype), (3, 1, 1)), np.tile(np.eye(3, dtype=dtype), (3, 1, 1))
    new[1, 0, 0], new[2, 1, 1] = 1.001, 0.999
    state = linear.new_state(3, dtype)
    stress = linear.evaluate(old, new, state=state)["stress"]
    assert stress.dtype == dtype
    tolerance = 1e-3 if dtype == np.float64 else 3e-3
    assert stress[1, 0] == pytest.approx(1e-3 * linear.properties["e_1"], rel=tolerance)
    assert stress[2, 1] == pytest.approx(-1e-3 * linear.properties["e_2"], rel=tolerance)
    again = linear.evaluate(new, new, state=state)["stress"]
    np.testing.assert_allclose(again, stress, rtol=1e-5, atol=1e-5)


def test_layouts_outputs_and_states_of_the_linear_law(linear, gradients):
    old, new = gradients(20, size=1e-3), gradients(20, size=2e-3)
    state_old = np.zeros((20, 10))
    names = ("stress", "state", "tangent", "wave_speed", "active", "status")
    first = linear.evaluate(old, new, state_old=state_old, outputs=names, tangent="nominal")
    assert first["tangent"].shape == (20, 3, 3, 3, 3) and not state_old.any() and first["state"].any()
    turned = [np.ascontiguousarray(np.moveaxis(array, 0, -1)) for array in (old, new, state_old)]
    second = linear.evaluate(*turned[:2], state_old=turned[2], outputs=names, tangent="nominal", points="last")
    for name in names:
        np.testing.assert_array_equal(np.moveaxis(second[name], -1, 0), first[name], err_msg=name)
    # One end by rows and one by columns of points: they share a stride in the library, so that a copy is made.
    mixed = linear.evaluate(np.asfortranarray(old), new[::-1].copy()[::-1], state_old=state_old, outputs=names, tangent="nominal")
    np.testing.assert_array_equal(mixed["stress"], first["stress"])


def test_bound_steps_of_the_linear_law(linear):
    old, new, state = np.eye(3), np.eye(3), linear.new_state()
    step = linear.bind(old, new, outputs="stress", state=state)
    for k in range(1, 4):
        new[0, 0] = 1 + 1e-4 * k
        stress = step()["stress"]
        old[...] = new
    assert stress[0] == pytest.approx(3e-4 * linear.properties["e_1"], rel=1e-3)


def test_frames_and_axes(linear):
    c, s = np.cos(0.3), np.sin(0.3)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    for rotation in ("fibre", "polar", "spin"):
        law = linear.replace(rotation=rotation)
        axes = law.reference_axes()
        np.testing.assert_allclose(axes, np.eye(3), atol=1e-15)
        state = law.new_state()
        law.evaluate(np.eye(3), np.diag([1.001, 1.0, 1.0]), state=state, axes=axes)
        stress = law.evaluate(np.diag([1.001, 1.0, 1.0]), turn @ np.diag([1.001, 1.0, 1.0]), state=state, axes=axes)["stress"]
        expected = turn @ toron.matrix(linear.evaluate(np.eye(3), np.diag([1.001, 1.0, 1.0]))["stress"]) @ turn.T
        np.testing.assert_allclose(toron.matrix(stress), expected, atol=1e-2 * expected.max())
        if rotation == "spin":
            np.testing.assert_allclose(axes[0], turn[:, 0], atol=1e-2)
    with pytest.raises(toron.ArgumentError, match="axes"):
        linear.replace(rotation="spin").evaluate(np.eye(3), np.eye(3))


def test_increment(linear):
    law = linear.replace(criterion="fibre")
    state, strain = law.new_state(), np.array([0.001, 0, 0, 0.001, 0, 0])
    for _ in range(3):
        stress = law.increment(strain, state)
    np.testing.assert_allclose(stress[[0, 3]], [238.242, 0.756], atol=0.005)  # 0.003 E1 and 0.006 G
    before = state.copy()
    with pytest.raises(toron.PointError):
        law.increment(np.full(6, np.nan), state)
    np.testing.assert_array_equal(state, before)
