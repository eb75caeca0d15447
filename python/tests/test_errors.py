"""No status is lost, and every exception says in the library's words what is wrong and what is allowed."""

import pickle

import numpy as np
import pytest

import toron


def test_properties_are_refused_with_the_librarys_text(yarn):
    with pytest.raises(toron.PropertyError, match=r"p.*0\.5.*> 1") as caught:
        yarn.replace(p=0.5)
    assert isinstance(caught.value, ValueError) and caught.value.code == -203
    with pytest.raises(toron.PropertyError, match="k_el.*NaN") as caught:
        yarn.replace(k_el=float("nan"))
    assert caught.value.code == -202
    with pytest.raises(toron.PropertyError, match="property k_tc is missing"):
        toron.Hyperelastic(k_el=1.0)
    with pytest.raises(toron.ArgumentError, match="k_ell.*allowed: k_el"):
        toron.Hyperelastic(k_ell=1.0)
    with pytest.raises(toron.PropertyError):
        yarn.replace(m_1=0.0)
    with pytest.raises(toron.PropertyError, match="values has shape"):
        toron.Hyperelastic.from_values([1.0, 2.0])


def test_presets_and_units_are_refused_with_the_librarys_text():
    with pytest.raises(toron.ArgumentError, match="nylon.*kevlar-km2-600") as caught:
        toron.Hyperelastic.from_preset("nylon", "si")
    assert caught.value.code == -104
    with pytest.raises(toron.ArgumentError, match="furlong"):
        toron.Hyperelastic.from_preset("kevlar-km2-600", "furlong-kg-s")
    with pytest.raises(toron.PropertyError):
        toron.Hyperelastic.from_preset("kevlar-km2-600-linear", "si")
    with pytest.raises(toron.ArgumentError, match="frame"):
        toron.LinearElastic.from_preset("kevlar-km2-600-linear", "si", frame="polar")


WRONG = {
    "shape of F": (dict(F=np.eye(4)), r"F has shape \(4, 4\)"),
    "layout": (dict(F=np.ones((3, 3, 5))), r"F has shape \(3, 3, 5\).*\(n, 3, 3\)"),
    "numbers of F": (dict(F=np.eye(3, dtype=complex)), "complex128.*real"),
    "outputs": (dict(outputs="strain"), "strain.*allowed: stress"),
    "tangent": (dict(outputs="tangent", tangent="secant"), "secant.*nominal"),
    "level": (dict(level="sse"), "sse.*avx2"),
    "points": (dict(points="middle"), "middle.*first"),
    "shape of out": (dict(out={"stress": np.empty((2, 6))}), r"stress has shape \(2, 6\); allowed: \(6,\)"),
    "type of out": (dict(out={"stress": np.empty(6, np.float32)}), "stress has type float32"),
    "out that is no array": (dict(out={"stress": [0.0] * 6}), "stress has type list"),
    "status": (dict(out={"status": np.empty((), np.int64)}), "status has type int64"),
    "state": (dict(state=np.zeros(10)), r"state has shape \(10,\); allowed: \(11,\)"),
    "two states": (dict(state=np.zeros(11), state_old=np.zeros(11)), "state_old"),
    "parts of a state": (dict(state=np.zeros(11), out={"energies": np.zeros(4)}), "parts of the state"),
    "fibre": (dict(fibre=np.ones(2)), r"fibre has shape \(2,\)"),
    "density": (dict(outputs="wave_speed", density=-1.0), "density.*-1"),
    "density that is no number": (dict(outputs="wave_speed", density="one"), "density is 'one'; allowed: a finite number > 0"),
    "out that is an array": (dict(out=np.empty(6)), "out is of type ndarray; allowed: arrays by the names"),
    "ragged F": (dict(F=[[1.0, 0, 0], [0, 1]]), "F is no array of numbers"),
}


@pytest.mark.parametrize("arguments,text", WRONG.values(), ids=WRONG)
def test_arguments(yarn, arguments, text):
    F = arguments.get("F", np.eye(3))
    rest = {name: value for name, value in arguments.items() if name != "F"}
    with pytest.raises(toron.ArgumentError, match=text) as caught:
        yarn.evaluate(F, **rest)
    assert isinstance(caught.value, ValueError) and -200 < caught.value.code < -100


def test_outputs_over_inputs_are_refused(yarn):
    whole = np.zeros(100)
    F = whole[:9].reshape(3, 3)
    with pytest.raises(toron.ArgumentError, match="shares memory"):
        yarn.evaluate(F, out={"stress": whole[3:9]})
    h = np.zeros(22)
    with pytest.raises(toron.ArgumentError, match="shares memory"):
        yarn.evaluate(np.eye(3), state_old=h[:11], out={"state": h[5:16]})
    state = np.zeros(11)
    yarn.evaluate(np.eye(3), state_old=state, out={"state": state})


def test_two_outputs_at_one_place_are_refused(yarn, linear):
    F, one, four = np.tile(np.diag([1.02, 0.9, 0.9]), (4, 1, 1)), np.empty(4), np.empty((4, 4))
    with pytest.raises(toron.ArgumentError, match="shares memory with"):
        yarn.evaluate(F, out={"wave_speed": one, "active": one})
    with pytest.raises(toron.ArgumentError, match="energies shares memory with invariants"):
        yarn.evaluate(F, out={"energies": four, "invariants": four})
    single = np.empty(4, np.float32)
    with pytest.raises(toron.ArgumentError, match="shares memory with"):
        yarn.evaluate(F.astype(np.float32), out={"active": single, "status": single.view(np.int32)})
    spin, new = linear.replace(rotation="spin"), np.eye(3)
    for old, axes in ((np.eye(3), new), (new, np.eye(3)), (new, new)):
        if axes is new:
            with pytest.raises(toron.ArgumentError, match="axes shares memory with f_new"):
                spin.evaluate(old, new, axes=axes, state=spin.new_state())
        else:
            spin.evaluate(old, new, axes=axes, state=spin.new_state())


def test_what_is_no_number_is_refused_as_an_error_of_the_package(yarn, linear):
    for value in (None, "a"):
        with pytest.raises(toron.PropertyError, match="k_el is .*; allowed: a number"):
            yarn.replace(k_el=value)
    for value in (-1.0, float("nan"), "1 kg"):
        with pytest.raises(toron.ArgumentError, match="density is"):
            yarn.replace(density=value)
    with pytest.raises(toron.ArgumentError, match="units is None"):
        toron.Hyperelastic.from_preset("kevlar-km2-600", None)
    with pytest.raises(toron.PropertyError, match="preset kevlar-km2-600-linear is of another law"):
        toron.Hyperelastic.from_preset("kevlar-km2-600-linear", "si")
    for code in (2**40, "none"):
        with pytest.raises(toron.ArgumentError, match="unknown"):
            toron.status_message(code)
    with pytest.raises(toron.ArgumentError, match="complex128"):
        yarn.least_acoustic_eigenvalue(np.eye(3, dtype=complex))
    state = linear.new_state()
    state.flags.writeable = False
    with pytest.raises(toron.ArgumentError, match="read-only"):
        linear.increment(np.zeros(6), state)
    with pytest.raises(toron.ArgumentError, match="layout is 'Last'"):
        yarn.new_state(5, layout="Last")
    assert yarn.new_state(np.int64(5)).shape == (5, 11)


def test_a_bound_call_wants_arrays(yarn):
    with pytest.raises(toron.ArgumentError, match="F is a list; allowed: a NumPy array"):
        yarn.bind([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]])


def bad(gradients, n=10) -> np.ndarray:
    F = gradients(n)
    F[3, 0, 0] = np.nan
    F[7] = np.diag([1.0, -1.0, 1.0])
    return F


@pytest.mark.parametrize("layout", ["first", "last"])
def test_points_that_cannot_be_evaluated_raise(yarn, gradients, layout):
    F = bad(gradients)
    expected = yarn.evaluate(F, outputs=("stress", "status"))
    array = F if layout == "first" else np.ascontiguousarray(np.moveaxis(F, 0, -1))
    out = {"stress": np.full((10, 6) if layout == "first" else (6, 10), np.nan)}
    for _ in range(2):
        with pytest.raises(toron.PointError, match="point 3") as caught:
            yarn.evaluate(array, out=out, points=layout)
    error = caught.value
    assert isinstance(error, ArithmeticError) and error.code == -302
    assert (np.flatnonzero(error.status) == [3, 7]).all() and list(error.status[[3, 7]]) == [-302, -301]
    np.testing.assert_array_equal(out["stress"] if layout == "first" else out["stress"].T, expected["stress"])
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and (again.status == error.status).all()


def test_one_point_that_cannot_be_evaluated_raises(yarn):
    out = {"stress": np.ones(6)}
    with pytest.raises(toron.PointError) as caught:
        yarn.evaluate(np.full((3, 3), np.inf), out=out)
    assert caught.value.status == caught.value.code == -302 and not out["stress"].any()


@pytest.mark.parametrize("shape", [(1,), (1, 1), ()])
def test_the_status_has_the_shape_of_the_points(yarn, shape):
    with pytest.raises(toron.PointError) as caught:
        yarn.stress(np.full((*shape, 3, 3), np.nan))
    assert caught.value.status.shape == shape and (caught.value.status == -302).all()


def test_the_status_of_points_where_it_is_wanted(yarn, gradients):
    F = bad(gradients)
    state = yarn.new_state(10)
    found = yarn.evaluate(F, outputs=("stress", "status", "active"), state=state)
    assert list(np.flatnonzero(found["status"])) == [3, 7]
    assert not found["stress"][[3, 7]].any() and np.isfinite(found["stress"]).all()
    assert list(np.flatnonzero(found["active"] == 0)) == [3, 7]
    assert not state[3, :8].any() and state[4, :8].any()
    for code in set(found["status"][[3, 7]].tolist()):
        assert len(toron.status_message(code)) > 10
    with pytest.raises(toron.ArgumentError):
        toron.status_message(-999)


def test_copies_are_written_back_before_an_exception(yarn, gradients):
    F, stress = bad(gradients), np.full((10, 6), np.nan)[::-1]
    with pytest.raises(toron.PointError):
        yarn.stress(F, out=stress)
    assert stress[2].any() and np.isfinite(stress).all() and not stress[3].any()


def test_a_state_that_is_no_number(yarn, gradients):
    state = yarn.new_state(4)
    state[2, 9] = np.nan
    with pytest.raises(toron.PointError) as caught:
        yarn.evaluate(gradients(4), state=state)
    assert list(caught.value.status) == [0, 0, -304, 0]


def test_errors_of_the_linear_law(linear):
    with pytest.raises(toron.PointError) as caught:
        linear.evaluate(np.eye(3), np.diag([20.0, 1, 1]), state=linear.new_state())
    assert caught.value.code == -306
    with pytest.raises(toron.ArgumentError, match="elastic.*fibre, polar, spin"):
        linear.replace(rotation="elastic")
    with pytest.raises(toron.ArgumentError, match="f_old"):
        linear.evaluate(np.ones((2, 3, 3)), np.eye(3))
