"""Arrays of every layout give the same numbers, and are copied only where the documentation says so."""

import gc
import pickle
import sys
import tracemalloc
import weakref

import numpy as np
import pytest

import toron

N = 100_000


def copies_of(call, size: int) -> int:
    """How many arrays of so many bytes a call allocates; NumPy reports its allocations to tracemalloc."""
    call()
    tracemalloc.start()
    call()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return round(peak / size)


def last(array: np.ndarray) -> np.ndarray:
    """(n, …) as (…, n) in memory."""
    return np.ascontiguousarray(np.moveaxis(array, 0, -1))


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("kind", ["material", "truesdell", "jaumann", "nominal"])
def test_both_layouts_give_the_same(yarn, gradients, dtype, kind):
    F = gradients(50, dtype)
    names = ("stress", "modes", "tangent", "state", "wave_speed", "active")
    first = yarn.evaluate(F, outputs=names, tangent=kind)
    second = yarn.evaluate(last(F), outputs=names, tangent=kind, points="last")
    for name in names:
        assert first[name].dtype == dtype
        np.testing.assert_array_equal(np.moveaxis(second[name], -1, 0), first[name], err_msg=name)
    assert first["tangent"].shape == ((50, 3, 3, 3, 3) if kind == "nominal" else (50, 6, 6))
    assert np.abs(first["stress"]).max() > 100 and np.abs(first["tangent"]).max() > 1000


def test_one_point_many_points_and_axes_of_points(yarn, gradients):
    F = gradients(12)
    whole = yarn.stress(F)
    assert whole.shape == (12, 6)
    for one, expected in zip(F, whole):
        found = yarn.stress(one)
        assert found.shape == (6,)
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-9)
    np.testing.assert_array_equal(yarn.stress(F.reshape(3, 4, 3, 3)), whole.reshape(3, 4, 6))
    cells = last(F).reshape(3, 3, 3, 4)
    np.testing.assert_array_equal(yarn.stress(cells, points="last"), whole.T.reshape(6, 3, 4))
    assert yarn.stress(F[:0]).shape == (0, 6)


#: Views of the same numbers (n, 3, 3), with the number of copies of F that a call needs.
VIEWS = {
    "rows": (lambda F: np.ascontiguousarray(F), 0),
    "columns": (lambda F: np.ascontiguousarray(F.transpose(0, 2, 1)).transpose(0, 2, 1), 0),
    "component-major": (lambda F: np.ascontiguousarray(F.transpose(1, 2, 0)).transpose(2, 0, 1), 0),
    "every second point": (lambda F: np.repeat(F, 2, axis=0)[::2], 0),
    "part of larger matrices": (lambda F: np.pad(F, ((0, 0), (0, 1), (1, 1)))[:, :3, 1:4], 0),
    "components backwards": (lambda F: np.ascontiguousarray(F[:, ::-1, ::-1])[:, ::-1, ::-1], 0),
    "points backwards": (lambda F: np.ascontiguousarray(F[::-1])[::-1], 1),
    "in other byte order": (lambda F: F.astype(F.dtype.newbyteorder()), 1),
}


@pytest.mark.parametrize("name", VIEWS)
def test_inputs_are_read_where_they_are(yarn, gradients, name):
    F, (view, copies) = gradients(N), VIEWS[name]
    array = view(F)
    np.testing.assert_array_equal(array, F)
    out = {"stress": np.empty((N, 6)), "status": np.empty(N, np.int32)}
    np.testing.assert_array_equal(yarn.evaluate(array, out=out)["stress"], yarn.stress(F))
    assert copies_of(lambda: yarn.evaluate(array, out=out), F.nbytes) == copies


@pytest.mark.parametrize("layout", ["first", "last"])
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_outputs_and_state_are_written_where_they_are(yarn, gradients, layout, dtype):
    F = gradients(N, dtype)
    F = F if layout == "first" else last(F)
    state = yarn.new_state(N, dtype, layout)
    names = ("stress", "modes", "wave_speed", "active", "tangent")
    out = dict(yarn.evaluate(F, outputs=names, points=layout, tangent="jaumann"))
    expected = {name: array.copy() for name, array in out.items()}
    for array in out.values():
        array.fill(np.nan)
    out["status"] = np.full(N, -1, np.int32)

    def call():
        yarn.evaluate(F, out=out, state=state, points=layout)

    call()
    for name, array in expected.items():
        np.testing.assert_array_equal(out[name], array, err_msg=name)
    assert (out["status"] == 0).all() and state.any()
    assert copies_of(call, N * np.dtype(dtype).itemsize) == 0


def test_the_nominal_tangent_is_written_in_place_where_the_package_made_it(yarn, gradients):
    F = gradients(10_000)
    made = yarn.evaluate(F, outputs="tangent", tangent="nominal")
    expected, own = made["tangent"].copy(), np.empty((10_000, 3, 3, 3, 3))
    made["tangent"].fill(0)
    status = {"status": np.empty(10_000, np.int32)}
    assert copies_of(lambda: yarn.evaluate(F, out=made | status, tangent="nominal"), own.nbytes) == 0
    np.testing.assert_array_equal(made["tangent"], expected)
    # Of any other array it is a copy.
    assert copies_of(lambda: yarn.tangent(F, "nominal", out=own), own.nbytes) == 1
    np.testing.assert_array_equal(own, expected)


def test_outputs_that_the_library_cannot_write_go_through_a_copy(yarn, gradients):
    F = gradients(20)
    expected = yarn.evaluate(F, outputs=("stress", "wave_speed", "energies"))
    out = {
        "stress": np.empty((20, 6))[::-1],
        "wave_speed": np.empty(40)[::2],
        "energies": np.empty((20, 4), order="F"),
    }
    for name, array in yarn.evaluate(F, out=out).items():
        assert array is out[name]
        np.testing.assert_array_equal(array, expected[name], err_msg=name)
    state = np.zeros((11, 20))[:, ::-1].T
    yarn.evaluate(F, state=state)
    np.testing.assert_array_equal(state, yarn.evaluate(F, outputs="state")["state"])


def test_entries_between_each_other_go_through_a_copy(yarn, gradients):
    F, lattice = gradients(3), np.lib.stride_tricks.as_strided(np.empty(40), (3, 11), (16, 24))
    found = yarn.evaluate(F, out={"state": lattice})["state"]
    np.testing.assert_array_equal(found, yarn.evaluate(F, outputs="state")["state"])


def test_a_separate_old_state_is_only_read(yarn, gradients):
    F = gradients(30)
    old = yarn.new_state(30)
    old[::3, yarn.state_index("failed")] = 1
    before = old.copy()
    for new in (np.empty((30, 11)), np.empty((11, 30)).T):
        found = yarn.evaluate(F, state_old=old, out={"state": new, "stress": np.empty((30, 6))})
        np.testing.assert_array_equal(old, before)
        assert not found["stress"][::3].any() and found["stress"][1::3].any()
        assert (new[::3, yarn.state_index("failed")] == 1).all()


def test_fibre_directions_of_points(yarn):
    turned = yarn.replace(m_1=0.0, m_2=1.0)
    F = np.tile(np.diag([1.01, 1.02, 0.97]), (8, 1, 1))
    fibre = np.tile([0.0, 3.0, 0.0], (8, 1))
    np.testing.assert_allclose(yarn.stress(F, fibre=fibre), turned.stress(F), rtol=1e-14, atol=1e-12)
    np.testing.assert_allclose(yarn.stress(last(F), fibre=last(fibre), points="last").T, turned.stress(F), rtol=1e-14, atol=1e-12)


def test_limits_of_points(yarn, gradients):
    F = gradients(40)
    limit = np.resize([0.0, 1e-3, 0.03, 0.08], 40)
    index = yarn.state_index("failure_index")
    for dtype in (np.float64, np.float32):
        G = F.astype(dtype)
        own = {value: yarn.replace(eps_lim=np.expm1(value)) if value else yarn for value in np.unique(limit)}
        found = yarn.evaluate(G, outputs="state", limit=limit.astype(dtype))["state"][:, index]
        expected = [own[value].evaluate(f, outputs="state")["state"][index] for f, value in zip(G, limit)]
        np.testing.assert_allclose(found, expected, rtol=1e-5 if dtype == np.float32 else 1e-13)
        apart = np.stack([limit, -limit - 1.0], 1).astype(dtype)[:, 0]
        np.testing.assert_array_equal(yarn.evaluate(G, outputs="state", limit=apart)["state"][:, index], found)
        one = yarn.evaluate(G, outputs="failure", limit=0.03)["failure"][:, 0]
        np.testing.assert_array_equal(one[limit == 0.03], found[limit == 0.03])
    status = yarn.evaluate(F, outputs=("state", "status"), limit=-limit)["status"]
    np.testing.assert_array_equal(status < 0, limit > 0)
    with pytest.raises(toron.PointError, match="failure limit of this point"):
        yarn.evaluate(F, outputs="state", limit=np.nan)


def test_strengths_of_points(linear, gradients):
    F = gradients(30)
    limit = np.resize([0.0, 1.0, 500.0, 1e5], 30)
    rest = np.tile(np.eye(3), (30, 1, 1))
    found = linear.evaluate(rest, F, outputs="state", limit=limit)["state"]
    for value in np.unique(limit):
        own = linear.replace(sigma_lim=value) if value else linear
        expected = own.evaluate(rest, F, outputs="state")["state"]
        np.testing.assert_array_equal(found[limit == value], expected[limit == value])
    one = linear.evaluate(rest, F, outputs="state", limit=500.0)["state"]
    np.testing.assert_array_equal(one[limit == 500.0], found[limit == 500.0])
    assert 0 < found[:, linear.state_index("failed")].sum() < 30
    with pytest.raises(toron.PointError, match="failure limit of this point"):
        linear.evaluate(rest, F, outputs="state", limit=-1.0)


@pytest.mark.parametrize("shape", [(), (3,), (2, 4)])
def test_one_direction_is_that_of_all_points(yarn, linear, shape):
    F = np.tile(np.diag([1.01, 1.02, 0.97]), (*shape, 1, 1))
    points_last = np.moveaxis(F, (-2, -1), (0, 1))
    expected = yarn.replace(m_1=0.0, m_2=1.0).stress(F)
    for fibre in ([0, 1, 0], np.array([0.0, 1.0, 0.0])):
        out = np.empty((*shape, 6))
        for _ in range(2):
            np.testing.assert_allclose(yarn.stress(F, fibre=fibre, out=out), expected, rtol=1e-14, atol=1e-12)
        found = yarn.stress(points_last, fibre=fibre, points="last")
        np.testing.assert_allclose(np.moveaxis(found, 0, -1), expected, rtol=1e-14, atol=1e-12)
    turned = linear.replace(m_1=0.0, m_2=1.0, n_1=0.0, n_2=0.0, n_3=1.0)
    start = np.broadcast_to(np.eye(3), F.shape)
    found = linear.evaluate(start, F, fibre=[0, 1, 0], second_axis=[0, 0, 1])["stress"]
    np.testing.assert_allclose(found, turned.evaluate(start, F)["stress"], rtol=1e-13, atol=1e-10)
    direction = np.array([0.0, 1.0, 0.0])
    step = yarn.bind(F, fibre=direction)
    direction[:] = 1.0, 0.0, 0.0
    np.testing.assert_allclose(step()["stress"], yarn.stress(F), rtol=1e-14, atol=1e-12)


def test_what_is_no_array_of_numbers_of_the_library_is_converted(yarn):
    rows = [[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]
    np.testing.assert_array_equal(yarn.stress(rows), np.zeros(6))
    np.testing.assert_array_equal(yarn.stress(np.eye(3, dtype=int)), np.zeros(6))
    out = {"stress": np.zeros(6)}
    yarn.evaluate(rows, out=out)
    rows[0][0] = 1.01
    yarn.evaluate(rows, out=out)
    assert out["stress"][0] > 100, "a list that has changed is read anew"


def test_parts_of_the_state(yarn, gradients):
    F = gradients(5)
    whole = yarn.evaluate(F, outputs="state")["state"]
    parts = yarn.evaluate(F, outputs=("energies", "invariants", "failure"))
    np.testing.assert_array_equal(np.concatenate(list(parts.values()), axis=1), whole)
    np.testing.assert_array_equal(yarn.evaluate(F, outputs="invariants")["invariants"], whole[:, 4:8])
    np.testing.assert_array_equal(yarn.evaluate(F, outputs="failure")["failure"], whole[:, 8:])
    for names in (("energies",), ("failure",), ("invariants", "failure")):
        out = {name: np.empty((5, 3 if name == "failure" else 4)) for name in names}
        for name, array in yarn.evaluate(F, out=out).items():
            np.testing.assert_array_equal(array, parts[name])
    both = yarn.evaluate(F, outputs=("state", "energies"))
    assert np.shares_memory(both["state"], both["energies"])


def test_the_same_arrays_again_and_others(yarn, gradients):
    """The law remembers its last calls: whatever changes between two of them is seen."""
    F, other = gradients(4), gradients(4, size=0.01)
    a, b = np.empty((4, 6)), np.empty((4, 6))
    assert yarn.stress(F, out=a) is a
    expected = yarn.stress(F)
    np.testing.assert_array_equal(a, expected)
    a.fill(0)
    yarn.stress(F, out=a)
    np.testing.assert_array_equal(a, expected)
    yarn.stress(F, out=b)
    np.testing.assert_array_equal(b, expected)
    yarn.stress(other, out=b)
    np.testing.assert_array_equal(b, yarn.stress(other))
    F[...] = other
    yarn.stress(F, out=b)
    np.testing.assert_array_equal(b, yarn.stress(other))
    out = {"stress": a}
    yarn.evaluate(F, out=out)
    out["stress"] = b
    b.fill(0)
    assert yarn.evaluate(F, out=out)["stress"] is b
    np.testing.assert_array_equal(b, yarn.stress(other))
    b.flags.writeable = False
    with pytest.raises(toron.ArgumentError, match="read-only"):
        yarn.evaluate(F, out=out)
    F.shape = (2, 2, 3, 3)
    with pytest.raises(toron.ArgumentError, match=r"stress has shape \(4, 6\); allowed: \(2, 2, 6\)"):
        yarn.evaluate(F, out={"stress": a})


def test_no_more_than_some_calls_are_remembered(gradients):
    yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", "si")
    arrays = [gradients(2) * (1 + 1e-3 * k) for k in range(50)]
    held = sys.getrefcount(arrays[0])
    for _ in range(2):
        for k, F in enumerate(arrays):
            out = np.empty((2, 6))
            np.testing.assert_array_equal(yarn.stress(F, out=out), yarn.stress(F.copy()), err_msg=str(k))
    del F
    first, last_ = sys.getrefcount(arrays[0]), sys.getrefcount(arrays[-1])
    assert first == held and last_ > held
    many, out = gradients(40_000), np.empty((40_000, 6))
    part, of_out = many[:10], out[:10]
    before = sys.getrefcount(many), sys.getrefcount(part)
    yarn.stress(many, out=out)
    yarn.stress(part, out=of_out)
    after = sys.getrefcount(many), sys.getrefcount(part)
    assert before == after, "large arrays are not held, nor what is a part of one"


def test_a_call_of_before_is_not_taken_for_one_of_another_layout_or_option(yarn, gradients):
    F, out = np.ascontiguousarray(gradients(4)), np.empty((4, 6))
    yarn.stress(F, out=out)
    F.dtype = np.int64
    np.testing.assert_array_equal(yarn.stress(F, out=out, level="best"), yarn.stress(F.astype(float)))
    density, speed = np.array(1e-9), {"wave_speed": np.empty(4)}
    F = gradients(4)
    slow = yarn.evaluate(F, out=speed, density=density)["wave_speed"].copy()
    density[...] = 0.25e-9
    np.testing.assert_allclose(yarn.evaluate(F, out=speed, density=density)["wave_speed"], 2 * slow)


def move_by_resize(array: np.ndarray) -> None:
    """Gives the array other memory of the same size, and frees what it had."""
    shape = array.shape
    array.resize((array.size + 100_000,), refcheck=False)
    array.resize(shape, refcheck=False)


def move_by_setstate(array: np.ndarray) -> None:
    array.__setstate__(array.copy(order="K").__reduce__()[2])


@pytest.mark.parametrize("move", [move_by_resize, move_by_setstate])
@pytest.mark.parametrize("which", ["F", "stress", "state", "energies"])
@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("has_head", [True, False], ids=["from the object", "from ctypes"])
def test_no_call_uses_memory_that_an_array_has_no_more(yarn, gradients, monkeypatch, move, which, order, has_head):
    if not has_head:
        monkeypatch.setattr("toron.call._HAS_HEAD", False)
    n = 60
    arrays = {"F": np.array(gradients(n), order=order)}
    expected = yarn.stress(arrays["F"])
    arrays |= {name: np.zeros((n, size), order=order) for name, size in (("stress", 6), ("energies", 4), ("state", 11))}
    state = {} if which == "energies" else {"state": arrays["state"]}
    out = {"stress": arrays["stress"]} | ({} if state else {"energies": arrays["energies"]})
    yarn.evaluate(arrays["F"], out=out, **state)
    step = yarn.bind(arrays["F"], out=out, **state)
    step()
    kept, start, blockers = arrays[which].copy(), arrays[which].ctypes.data, []
    while arrays[which].ctypes.data == start:
        # What may be given back to the array is taken by another one first.
        blockers.append(np.empty(kept.size))
        move(arrays[which])
    arrays[which][...] = kept
    arrays["stress"].fill(np.nan)
    with pytest.raises(toron.ArgumentError, match=f"^{which} has other memory than when the call was bound; allowed: .*bind again"):
        step()
    assert np.isnan(arrays["stress"]).all()
    yarn.evaluate(arrays["F"], out=out, **state)
    np.testing.assert_array_equal(arrays["stress"], expected)
    arrays["stress"].fill(np.nan)
    np.testing.assert_array_equal(yarn.bind(arrays["F"], out=out, **state)()["stress"], expected)


def test_a_bound_call_sees_that_an_array_of_a_class_of_its_own_is_resized(yarn):
    class Own(np.ndarray):
        pass

    F = np.tile(np.eye(3), (50, 1, 1)).view(Own).copy()
    step = yarn.bind(F)
    step()
    F.resize((5, 3, 3), refcheck=False)
    with pytest.raises(toron.ArgumentError, match="F has other memory"):
        step()


def test_a_bound_call_takes_another_shape_of_the_same_memory(yarn, gradients):
    F = gradients(6)
    step = yarn.bind(F)
    F.shape = (2, 3, 3, 3)
    np.testing.assert_array_equal(step()["stress"], yarn.stress(F).reshape(6, 6))
    empty = yarn.bind(F[:0], outputs=("stress", "state"))
    assert empty()["stress"].shape == (0, 3, 6)


def test_a_bound_call_keeps_what_it_writes_to(yarn, gradients):
    step = yarn.bind(gradients(50), outputs=("energies", "failure"))
    with pytest.raises(TypeError):
        step()["energies"] = np.zeros((50, 4))
    whole = weakref.ref(step.outputs["energies"].base)
    step.outputs = {}
    gc.collect()
    assert whole() is not None, "the library still writes to it"


def test_outputs_of_a_call_are_the_caller_s(yarn, gradients):
    found = yarn.evaluate(gradients(3), outputs=("stress", "energies"))
    assert set(pickle.loads(pickle.dumps(found))) == {"stress", "energies"}
    assert list(yarn.evaluate(gradients(3), out={})) == ["stress"]


def test_a_bound_call_reads_the_arrays_as_they_are(yarn, gradients):
    F = gradients(6)
    step = yarn.bind(F, outputs=("stress", "tangent"), state=yarn.new_state(6))
    # A tangent changes the last digits of the stress.
    np.testing.assert_array_equal(step()["stress"], yarn.evaluate(F, outputs=("stress", "tangent"))["stress"])
    F *= 1.001
    np.testing.assert_allclose(step()["stress"], yarn.stress(F), rtol=1e-12, atol=1e-9)
    backwards = F[::-1]
    reverse = yarn.bind(backwards, outputs="stress")
    F *= 1.001
    np.testing.assert_array_equal(reverse()["stress"], yarn.stress(F[::-1].copy()))
