"""The hyperelastic yarn law, alone and with friction between its fibres."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from toron import arrays
from toron._library import CAPACITY, buffers, ffi, lib, structure
from toron.call import Call
from toron.errors import ArgumentError, raise_for_point
from toron.law import LEVELS, POINTS, STATUS, SUFFIX, TANGENTS, Law, Level, Points, Tangent, choice
from toron.placement import Member

_F = Member("deformation_gradient", (3, 3), "deformation_gradient", separate=True, order=(1, 0))
#: What a point may have of its own, in the order of the inputs: an array for all points, or one value for each of them.
_OWN = (Member("fibre", (3,), "fibre", separate=True), Member("limit", (), "limit"))
#: The parts of the state, in its order.
_PARTS = ("energies", "invariants", "failure")


def _outputs_with(variables: int) -> dict[str, Member]:
    """The outputs of a law with so many state variables: its failure is what is behind energies and invariants."""
    return {
        "stress": Member("stress", (6,), "stress", separate=True, written=True),
        "modes": Member("modes", (4, 6), "modes", written=True),
        "tangent": Member("tangent", (6, 6), "tangent", written=True),
        "state": Member("state", (variables,), "state", written=True),
        "energies": Member("energies", (4,), "state", written=True),
        "invariants": Member("invariants", (4,), "state", written=True),
        "failure": Member("failure", (variables - 8,), "state", written=True),
        "wave_speed": Member("wave_speed", (), written=True),
        "active": Member("active", (), written=True),
        "status": STATUS,
    }


_NOMINAL = Member("tangent", (3, 3, 3, 3), "tangent", written=True, order=(1, 0, 3, 2))


class _Yarn(Law):
    """What both yarn laws have: their points are the same structure of the library."""

    _outputs: dict[str, Member]

    def evaluate(
        self,
        F: ArrayLike,
        *,
        outputs: str | Iterable[str] | None = None,
        out: Mapping[str, np.ndarray] | None = None,
        state: np.ndarray | None = None,
        state_old: ArrayLike | None = None,
        fibre: ArrayLike | None = None,
        limit: ArrayLike | None = None,
        tangent: Tangent = "jaumann",
        density: float | None = None,
        points: Points = "first",
        level: Level = "best",
    ) -> Mapping[str, np.ndarray]:
        """Evaluates the law at one point or many; returns the outputs by name.

        F: deformation gradients, (3, 3), or (…, 3, 3), or (3, 3, …) with `points="last"`, where … are axes of points, the same for
        all arrays. float64 and float32 are used as they are, and all arrays are then of that type; others are converted to float64.

        `outputs`: names of what is wanted; the rest costs nothing. By default the stress. Shapes are those of a point:

        - stress: (6,), Cauchy stress 11 22 33 12 23 31, in the unit of the properties;
        - modes: (4, 6), second Piola-Kirchhoff stress of elongation, compaction, distortion and longitudinal shear;
        - tangent: (6, 6) for "material" dS/dE, "truesdell" or "jaumann" (DDSDDE), order as the stress, derivatives with respect to
          engineering shears; (3, 3, 3, 3) for "nominal", entry [i, J, k, L] = dP_iJ/dF_kL;
        - state: (11,), of `Frictional` (15,), see `state_table()`; energies: (4,), energy per reference volume, invariants: (4,),
          failure: (3,) failure index, failed, alive, of `Frictional` (7,), which are parts of it;
        - wave_speed: (), an upper bound, to be used with current element lengths; needs the density;
        - active: (), 1, or 0 if the point has failed or cannot be evaluated;
        - status: (), int32, 0 or the code of a point that cannot be evaluated. Without it such points raise `PointError`.

        `out`: arrays for outputs, by name; they are outputs too. Without `outputs` it is `out` that is returned. They are written
        without a copy where their strides allow: docs/guides/python.md says when. No output may share memory with another array of the call.

        `state`: the old state, updated in place. Or `state_old`, which is only read, and the output "state". Without either all old
        states are 0. Without a new state, nor "failure", no point fails; those that have failed before stay so.

        `fibre`: (3,) at every point, or one for all, reference directions of any length in place of the law's own; `limit`: (), the true fibre
        strain at failure, ln(1 + eps_lim), of every point, or one for all, 0 for that of the law; `level`: the widest instructions to use,
        "best", "baseline", "avx2" or "avx512".

        Raises `ArgumentError` for an argument, `PointError` for points that cannot be evaluated (all others have been written).
        """
        return self._evaluate((F, state, state_old, fibre, limit), out, outputs, (tangent, density, points, level))

    def bind(
        self,
        F: np.ndarray,
        *,
        outputs: str | Iterable[str] | None = None,
        out: Mapping[str, np.ndarray] | None = None,
        state: np.ndarray | None = None,
        state_old: np.ndarray | None = None,
        fibre: np.ndarray | None = None,
        limit: np.ndarray | None = None,
        tangent: Tangent = "jaumann",
        density: float | None = None,
        points: Points = "first",
        level: Level = "best",
    ) -> Call:
        """As `evaluate`, but returns a call to be made as often as you like: `step = law.bind(F, state=h)`, then `step()`.

        Every call reads and writes these arrays as they are then, checks nothing but their contents and that they have not been resized,
        and returns the same arrays.
        """
        return self._bind((F, state, state_old, fibre, limit), out, outputs, (tangent, density, points, level), frozen=False).for_later()

    def stress(self, F: ArrayLike, *, out: np.ndarray | None = None, **arguments: Any) -> NDArray[Any]:
        """The Cauchy stress, 11 22 33 12 23 31: (…, 6), or (6, …) with `points="last"`; arguments as for `evaluate`."""
        return self._one("stress", F, out, arguments)

    def tangent(self, F: ArrayLike, tangent: Tangent, *, out: np.ndarray | None = None, **arguments: Any) -> NDArray[Any]:
        """A tangent: (…, 6, 6), or (…, 3, 3, 3, 3) for "nominal"; arguments as for `evaluate`."""
        return self._one("tangent", F, out, arguments | {"tangent": tangent})

    def _one(self, name: str, F: ArrayLike, out: np.ndarray | None, arguments: dict[str, Any]) -> NDArray[Any]:
        if out is None:
            return self.evaluate(F, outputs=name, **arguments)[name]
        self.evaluate(F, out={name: out}, **arguments)
        return out

    def _bind(self, inputs: tuple[Any, ...], out: Any, outputs: Any, options: tuple[Any, ...], frozen: bool = True) -> Call:
        F, state, state_old, *own = inputs
        tangent, density, points, level = options
        wanted = arrays.names(outputs, out, self._outputs)
        given = dict(out or {})
        placed = arrays.Arrays("F", _F, F, choice("points", points, POINTS) == 1, frozen)
        for member, values in zip(_OWN, own, strict=True):
            if values is not None:
                placed.put(member, placed.one_for_all(member.name, member, values))
        block = structure(f"toron_block_{SUFFIX[placed.dtype]}")
        block.level = choice("level", level, LEVELS)
        block.measure = choice("tangent", tangent, TANGENTS)
        self._set_density(block, density, wanted)
        results = _states(placed, self._outputs, given, wanted, state, state_old)
        for name in wanted:
            if name not in results:
                member = _NOMINAL if name == "tangent" and tangent == "nominal" else self._outputs[name]
                results[name] = placed.output(name, member, given.get(name))
                placed.put(member, results[name])
        outputs = {name: results[name] for name in wanted}
        return self._call(f"{self._structure}_block_{SUFFIX[placed.dtype]}", block, placed, outputs)


class Hyperelastic(_Yarn):
    """Del Sorbo's hyperelastic law of a yarn, prepared from its properties by name.

    `toron.Hyperelastic(k_el=82341.0, k_tc=1055.0, p=2.2, k_td=649.74, eps_lim=0.0458, alpha=1.8)`: stiffnesses in a unit of your
    own, which is that of the stresses; `properties_table()` has all properties with their dimensions and defaults. `density`, which
    only the wave speed needs, must fit the units.

    Raises `PropertyError` for a property that is missing or out of bounds, `ArgumentError` for a name that is none.
    """

    _number = lib.TORON_HYPERELASTIC
    _structure = "toron_hyperelastic"
    _outputs = _outputs_with(lib.TORON_HYPERELASTIC_STATE)

    def least_acoustic_eigenvalue(self, F: ArrayLike, fibre: ArrayLike | None = None) -> tuple[float, NDArray[np.float64]]:
        """Stability at one point: the smallest eigenvalue of the acoustic tensor times the density, and the normal of that wave.

        F: (3, 3); `fibre`: (3,), in place of the law's own. The eigenvalue, in the unit of the stress, is negative where the material
        has lost ellipticity; without k_ld it is 0 to rounding in stable states: compare it with -1e-9 k_el.

        Raises `ArgumentError`, or `PointError` if the point cannot be evaluated.
        """
        point = structure("toron_point_f64")
        columns = np.ascontiguousarray(arrays.numbers("F", F, (3, 3)).T)
        point.deformation_gradient = ffi.from_buffer("double[]", columns)
        if fibre is not None:
            direction = arrays.numbers("fibre", fibre, (3,))
            point.fibre = ffi.from_buffer("double[]", direction)
        least, normal = ffi.new("double *"), np.empty(3)
        law, written = self._law_in(np.dtype(np.float64)), ffi.from_buffer("double[]", normal)
        code = lib.toron_hyperelastic_least_acoustic_eigenvalue_f64(law, point, least, written, buffers.message, CAPACITY)
        raise_for_point(code)
        return least[0], normal


class Frictional(_Yarn):
    """The hyperelastic law with friction between the fibres of a section, prepared from its properties by name.

    `toron.Frictional(k_el=82341.0, k_tc=1055.0, p=2.2, k_td=649.74, mu=0.25, cohesion=0.2)`: the properties of `Hyperelastic`, and the
    friction. Its answer depends on the state: pass `state`, or `state_old` from the step before. The state has 15 variables, and
    "failure" 7: the energy lost, I_te, the slip, then failure index, failed, alive. The tangent is not symmetric where the fibres slide.

    Raises `PropertyError` for a property that is missing or out of bounds, `ArgumentError` for a name that is none.
    """

    _number = lib.TORON_FRICTIONAL
    _structure = "toron_frictional"
    _outputs = _outputs_with(lib.TORON_FRICTIONAL_STATE)


def _states(
    placed: arrays.Arrays, members: dict[str, Member], given: dict[str, Any], wanted: tuple[str, ...], state: Any, old: Any
) -> dict[str, np.ndarray]:
    """Places the old and the new state, and parts of the state that are wanted without it; returns those that are outputs."""
    if state is not None and (old is not None or "state" in wanted):
        raise ArgumentError("state is the old and the new one; give state_old for an old one of its own", lib.TORON_BAD_ARGUMENT)
    if old is not None:
        old = placed.input("state_old", members["state"], old)
    parts = [name for name in _PARTS if name in wanted]
    results: dict[str, np.ndarray] = {}
    if state is not None or "state" in wanted:
        twice = [name for name in parts if name in given]
        if twice:
            raise ArgumentError(f"out has {', '.join(twice)}: parts of the state, which is given", lib.TORON_BAD_ARGUMENT)
        new = placed.output("state", members["state"], given.get("state") if state is None else state)
        old = old if state is None else new
        results = {"state": new, **placed.put_parts([members[name] for name in _PARTS], new)}
    elif not any(name in given for name in parts):
        # One array for them all, since they have one layout.
        results = placed.parts([members[name] for name in parts])
    if old is not None:
        placed.put_parts([members[name]._replace(name=f"{name}_old", written=False) for name in _PARTS], old)
    return results
