"""No status is lost, and every exception says in the library's words what is wrong and what is allowed."""

import pickle
from decimal import Decimal

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


class Unprintable:
    def __repr__(self) -> str:
        raise RuntimeError


#: What few arguments may be: every one is wrong in most places, and must be refused there by an error of the package.
ODD = [
    *(10**400, -(10**5000), 2**63, -1, 1j, True, float("nan"), float("inf"), Decimal("nan"), Unprintable(), object, Ellipsis),
    *("", "1", "a", "kevlar-km2-600\0", "si\0-", "\ud800", "é" * 600, b"stress", bytearray(3), memoryview(b"abc"), iter([1]), range(2)),
    *([], [None], [[1, 2], [3]], ["stress", ["stress"]], {}, {1: 2}, {"stress": None}, {"stress": 1}, {"\ud800": 1}, {"stress"}),
    *(np.zeros(()), np.zeros(5), np.array("3"), np.zeros((3, 3), object), np.zeros((3, 3), "M8[s]"), np.zeros((3, 3), [("a", "f8")])),
    *(np.ma.masked, np.ma.zeros(6), np.ma.zeros((3, 3)), np.ma.zeros(11), [np.ma.masked, 1.0, 1.0], np.zeros((1,) * 30 + (3, 3))),
]


def calls(law) -> dict:
    """Ways to pass an argument, by what it is."""
    kind, one = type(law), np.eye(3)
    F = (one,) if kind is toron.Hyperelastic else (one, one)
    names = ("outputs", "out", "state", "state_old", "fibre", "tangent", "points", "level", "limit") + ("second_axis", "axes") * (len(F) - 1)
    found = {f"evaluate {name}": lambda value, name=name: law.evaluate(*F, **{name: value}) for name in names}
    found |= {f"bind {name}": lambda value, name=name: law.bind(*F, **{name: value})() for name in names}
    found |= {f"out {name}": lambda value, name=name: law.evaluate(*F, out={name: value}) for name in ("stress", "tangent", "status")}
    found |= {f"property {name}": lambda value, name=name: law.replace(**{name: value}) for name in law._options() | dict(law.properties)}
    found |= {
        "F": lambda value: law.evaluate(*F[1:], value),
        "F bound": lambda value: law.bind(*F[1:], value)(),
        "density": lambda value: law.evaluate(*F, outputs="wave_speed", density=value),
        "preset": lambda value: kind.from_preset(value, "si"),
        "units": lambda value: kind.from_preset("kevlar-km2-600", value),
        "values": lambda value: kind.from_values(value),
        "state variable": lambda value: kind.state_index(value),
        "name": lambda value: kind(**{value: 1.0}) if isinstance(value, str) else kind(),
        "points": lambda value: law.new_state((2**62, value)),
        "layout": lambda value: law.new_state(2, layout=value),
        "dtype": lambda value: law.new_state(2, value),
        "attribute": lambda value: setattr(law, value if isinstance(value, str) else "k_el", value),
        "no law": lambda value: toron.Law(**{value: 1.0} if isinstance(value, str) else {}),
    }
    if kind is toron.Hyperelastic:
        found |= {
            "acoustic F": lambda value: law.least_acoustic_eigenvalue(value),
            "acoustic fibre": lambda value: law.least_acoustic_eigenvalue(one, value),
            "status": lambda value: toron.status_message(value),
            "matrix": lambda value: toron.matrix(value),
            "first": lambda value: toron.first_piola_kirchhoff(value, np.zeros(6)),
            "first, stress": lambda value: toron.first_piola_kirchhoff(one, value, points="last"),
            "second": lambda value: toron.second_piola_kirchhoff(value),
            "measure's points": lambda value: toron.matrix(np.zeros(6), value),
        }
    else:
        found |= {
            "strain": lambda value: law.increment(value, law.new_state()),
            "state": lambda value: law.increment(np.zeros(6), value),
            "jacobian": lambda value: law.increment(np.zeros(6), law.new_state(), value),
            "axes": lambda value: law.reference_axes(value, value),
        }
    return found


@pytest.mark.filterwarnings("ignore")
def test_whatever_is_wrong_is_an_error_of_the_package(yarn, linear):
    refused = 0
    for law in (yarn, linear):
        for name, call in calls(law).items():
            for value in ODD:
                try:
                    call(value)
                except toron.Error as error:
                    assert len(str(error).encode()) > 5, name
                    refused += 1
                except Exception as error:
                    raise AssertionError(f"{name}: {type(error).__name__}: {error}") from error
    assert refused > 3000, refused


def test_names_are_not_cut_at_a_null_character(yarn):
    for name in ("kevlar-km2-600\0", "kevlar-km2-600\0-linear", "\ud800"):
        with pytest.raises(toron.ArgumentError, match="preset is 'kevlar|preset is .*ud800"):
            toron.Hyperelastic.from_preset(name, "si")
    with pytest.raises(toron.ArgumentError, match=r"units is 'si\\x00x'; allowed: .*null"):
        toron.Hyperelastic.from_preset("kevlar-km2-600", "si\0x")
    with pytest.raises(toron.ArgumentError, match=r"property is 'k_el\\x00'"):
        yarn.replace(**{"k_el\0": 1.0})
    with pytest.raises(toron.ArgumentError, match=r"state variable is 'failed\\x00'"):
        yarn.state_index("failed\0")


@pytest.mark.parametrize("mask", [False, True])
def test_masks_are_refused(yarn, linear, mask):
    def masked(array):
        return np.ma.array(array, mask=mask)

    one, text = np.eye(3), r"^{} is a masked array; allowed: an array without a mask.*filled"
    for name, call in {
        "F": lambda: yarn.stress(masked(one)),
        "fibre": lambda: yarn.stress(one, fibre=masked([1.0, 0, 0])),
        "stress": lambda: yarn.stress(one, out=masked(np.zeros(6))),
        "state": lambda: yarn.stress(one, state=masked(np.zeros(11))),
        "state_old": lambda: yarn.stress(one, state_old=masked(np.zeros(11))),
        "strain": lambda: linear.increment(masked(np.zeros(6)), linear.new_state()),
        "modes": lambda: toron.second_piola_kirchhoff(masked(np.zeros((4, 6)))),
    }.items():
        with pytest.raises(toron.ArgumentError, match=text.format(name)):
            call()
    with pytest.raises(toron.ArgumentError, match=text.format("F")):
        yarn.stress([masked(one), masked(one)])
    with pytest.raises(toron.ArgumentError, match=text.format("F")):
        yarn.bind(masked(one))


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
