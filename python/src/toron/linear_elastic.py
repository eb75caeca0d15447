"""The linear elastic orthotropic law."""

from collections.abc import Iterable, Mapping
from math import inf
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from toron import arrays
from toron._library import CAPACITY, buffers, constants, ffi, lib, structure
from toron.call import Call
from toron.errors import ArgumentError, raise_for_point, shown
from toron.law import LEVELS, POINTS, STATUS, SUFFIX, TANGENTS, Law, Level, Points, Tangent, choice
from toron.placement import Member

Rotation = Literal["fibre", "polar", "spin"]
Criterion = Literal["principal", "fibre"]

_ROTATIONS = constants("TORON_ROTATION_")
_CRITERIA = constants("TORON_CRITERION_")

_NEW = Member("f_new", (3, 3), "deformation_gradient", separate=True, order=(1, 0))
_OLD = Member("f_old", (3, 3), "deformation_gradient", separate=True, order=(1, 0))
_FIBRE = Member("fibre", (3,), "fibre", separate=True)
_SECOND_AXIS = Member("second_axis", (3,), "fibre", separate=True)
_LIMIT = Member("limit", (), "limit")
_AXES = Member("axes", (3, 3), "axes", written=True)
_STATE_OLD = Member("state_old", (lib.TORON_LINEAR_ELASTIC_STATE,), "state")
_OUTPUTS = {
    "stress": Member("stress", (6,), "stress", separate=True, written=True),
    "tangent": Member("tangent", (6, 6), "tangent", written=True),
    "state": Member("state_new", _STATE_OLD.components, "state", written=True),
    "wave_speed": Member("wave_speed", (), written=True),
    "active": Member("active", (), written=True),
    "status": STATUS,
}
_NOMINAL = Member("tangent", (3, 3, 3, 3), "tangent", written=True, order=(1, 0, 3, 2))


class LinearElastic(Law):
    """The linear elastic orthotropic law that yarns are commonly given, prepared from its properties by name.

    `toron.LinearElastic(e_1=82341.0, e_2=1340.0, g=1055.0, sigma_lim=3400.0)`; `properties_table()` has all properties. `rotation` is
    the frame that turns with the material: "fibre", which is right for a yarn, "polar" or "spin"; `criterion` the stress that is
    compared with the strength: "principal", the largest one, or "fibre".

    Raises `PropertyError` for a property that is missing or out of bounds, `ArgumentError` for a name or an option that is none.
    """

    _number = lib.TORON_LINEAR_ELASTIC
    _structure = "toron_linear_elastic"

    def __init__(
        self, density: float | None = None, rotation: Rotation = "fibre", criterion: Criterion = "principal", **properties: float
    ) -> None:
        self._rotation, self._rotation_code = rotation, choice("rotation", rotation, _ROTATIONS)
        self._criterion, self._criterion_code = criterion, choice("criterion", criterion, _CRITERIA)
        super().__init__(density, **properties)

    @property
    def rotation(self) -> Rotation:
        """The frame that turns with the material."""
        return self._rotation

    @property
    def criterion(self) -> Criterion:
        """The stress that is compared with the strength."""
        return self._criterion

    def _options(self) -> dict[str, Any]:
        return super()._options() | {"rotation": self._rotation, "criterion": self._criterion}

    def evaluate(
        self,
        f_old: ArrayLike,
        f_new: ArrayLike,
        *,
        outputs: str | Iterable[str] | None = None,
        out: Mapping[str, np.ndarray] | None = None,
        state: np.ndarray | None = None,
        state_old: ArrayLike | None = None,
        fibre: ArrayLike | None = None,
        second_axis: ArrayLike | None = None,
        limit: ArrayLike | None = None,
        axes: np.ndarray | None = None,
        tangent: Tangent = "jaumann",
        density: float | None = None,
        points: Points = "first",
        level: Level = "best",
    ) -> Mapping[str, np.ndarray]:
        """A step from `f_old` to `f_new` at one point or many; returns the outputs by name.

        Arguments are those of `Hyperelastic.evaluate`, but for

        - `f_old`, `f_new`: F at both ends of the step, (3, 3), (…, 3, 3) or (3, 3, …); copy the new one to the old one after it;
        - `state`, `state_old` and the output "state": (10,) at every point; the law needs it, since the stress is in it:
          without it every step starts without stress;
        - `fibre`, `second_axis`: (3,) at every point, or one for all, reference directions in place of the law's own;
        - `limit`: (), the strength of every point, or one for all, in place of sigma_lim; 0 for that of the law;
        - `axes`: (3, 3) at every point, the current material axes one after the other, updated in place, for the frame "spin";
          `reference_axes` gives those at the start.

        The outputs are stress (6,), state (10,), tangent (6, 6) or (3, 3, 3, 3), not symmetric, wave_speed (), active () and status ().
        """
        return self._evaluate(
            (f_old, f_new, state, state_old, fibre, second_axis, limit, axes), out, outputs, (tangent, density, points, level)
        )

    def bind(
        self,
        f_old: np.ndarray,
        f_new: np.ndarray,
        *,
        outputs: str | Iterable[str] | None = None,
        out: Mapping[str, np.ndarray] | None = None,
        state: np.ndarray | None = None,
        state_old: np.ndarray | None = None,
        fibre: np.ndarray | None = None,
        second_axis: np.ndarray | None = None,
        limit: np.ndarray | None = None,
        axes: np.ndarray | None = None,
        tangent: Tangent = "jaumann",
        density: float | None = None,
        points: Points = "first",
        level: Level = "best",
    ) -> Call:
        """As `evaluate`, but returns a call to be made as often as you like, as `Hyperelastic.bind`."""
        inputs = (f_old, f_new, state, state_old, fibre, second_axis, limit, axes)
        return self._bind(inputs, out, outputs, (tangent, density, points, level), frozen=False).for_later()

    def increment(self, strain: ArrayLike, state: np.ndarray, jacobian: float | None = None) -> NDArray[np.float64]:
        """The stress after a strain increment at one point, for a solver that turns the material axes by itself.

        `strain`: (6,), tensor components 11 22 33 12 23 31 in the material axes (half the engineering shears); `state`: (10,),
        float64, updated in place; `jacobian`: the volume ratio, a factor of the work, 1 if it is not given. Returns (6,), Cauchy
        stress in the same axes.

        Raises `ArgumentError`, or `PointError` if the point cannot be evaluated.
        """
        strains, stress = arrays.numbers("strain", strain, (6,)), np.empty(6)
        if not isinstance(state, np.ndarray) or state.dtype != np.float64 or state.shape != _STATE_OLD.components:
            raise ArgumentError(f"state is no float64 array of shape {_STATE_OLD.components}", lib.TORON_BAD_ARGUMENT)
        arrays.refuse_mask("state", state)
        if not state.flags.writeable:
            raise ArgumentError("state is read-only; allowed: an array that may be written", lib.TORON_BAD_ARGUMENT)
        new = np.array(state)
        step = structure("toron_linear_increment_f64")
        step.criterion = self._criterion_code
        step.jacobian = 0.0 if jacobian is None else _checked_jacobian(jacobian)
        step.strain, step.stress = ffi.from_buffer("double[]", strains), ffi.from_buffer("double[]", stress)
        step.state_old = step.state_new = ffi.from_buffer("double[]", new)
        law = self._law_in(np.dtype(np.float64))
        raise_for_point(lib.toron_linear_elastic_increment_f64(law, step, buffers.message, CAPACITY))
        state[...] = new
        return stress

    def reference_axes(self, fibre: ArrayLike | None = None, second_axis: ArrayLike | None = None) -> NDArray[np.float64]:
        """The material axes of a point in the undeformed state, (3, 3), one after the other: what `axes` starts with.

        `fibre`, `second_axis`: (3,), in place of the law's own. Raises `PointError` if there are no such axes.
        """
        named = (("fibre", fibre), ("second_axis", second_axis))
        given = [None if axis is None else arrays.numbers(name, axis, (3,)) for name, axis in named]
        pointers = [ffi.NULL if axis is None else ffi.from_buffer("double[]", axis) for axis in given]
        found = np.empty((3, 3))
        law = self._law_in(np.dtype(np.float64))
        raise_for_point(
            lib.toron_linear_elastic_axes_f64(law, *pointers, ffi.from_buffer("double[]", found), buffers.message, CAPACITY)
        )
        return found

    def _bind(self, inputs: tuple[Any, ...], out: Any, outputs: Any, options: tuple[Any, ...], frozen: bool = True) -> Call:
        f_old, f_new, state, state_old, fibre, second_axis, limit, axes = inputs
        tangent, density, points, level = options
        wanted = arrays.names(outputs, out, _OUTPUTS)
        given = dict(out or {})
        placed = arrays.Arrays("f_new", _NEW, f_new, choice("points", points, POINTS) == 1, frozen)
        if f_old is not None:
            placed.put(_OLD, placed.input("f_old", _OLD, f_old))
        for name, member, values in (("fibre", _FIBRE, fibre), ("second_axis", _SECOND_AXIS, second_axis), ("limit", _LIMIT, limit)):
            if values is not None:
                placed.put(member, placed.one_for_all(name, member, values))
        if axes is not None:
            placed.put(_AXES, placed.output("axes", _AXES, axes))
        block = structure(f"toron_linear_block_{SUFFIX[placed.dtype]}")
        block.rotation, block.criterion = self._rotation_code, self._criterion_code
        block.level = choice("level", level, LEVELS)
        block.measure = choice("tangent", tangent, TANGENTS)
        self._set_density(block, density, wanted)
        if state is not None:
            if state_old is not None or "state" in wanted:
                raise ArgumentError("state is the old and the new one; give state_old for an old one of its own", lib.TORON_BAD_ARGUMENT)
            state_old = placed.output("state", _OUTPUTS["state"], state)
            placed.put(_OUTPUTS["state"], state_old)
        elif state_old is not None:
            state_old = placed.input("state_old", _STATE_OLD, state_old)
        if state_old is not None:
            placed.put(_STATE_OLD, state_old)
        results = {}
        for name in wanted:
            member = _NOMINAL if name == "tangent" and tangent == "nominal" else _OUTPUTS[name]
            results[name] = placed.output(name, member, given.get(name))
            placed.put(member, results[name])
        return self._call(f"toron_linear_elastic_block_{SUFFIX[placed.dtype]}", block, placed, results)


def _checked_jacobian(jacobian: Any) -> float:
    value = arrays.number(jacobian)
    # The library takes 0 for one that is not given.
    if value is None or not 0 < value < inf:
        raise ArgumentError(f"jacobian is {shown(jacobian)}; allowed: a finite number > 0", lib.TORON_BAD_ARGUMENT)
    return value
