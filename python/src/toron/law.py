"""What both laws have in common: properties by name, the prepared law, and calls on arrays."""

from collections.abc import Iterable, Mapping
from math import inf, prod
from operator import index as integer
from operator import is_
from os import PathLike
from types import MappingProxyType
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from toron import tables
from toron._library import CAPACITY, buffers, constants, ffi, lib
from toron.arrays import Arrays, number, numbers
from toron.call import Call
from toron.errors import ArgumentError, AssignmentError, PropertyError, raise_for, shown
from toron.placement import Member
from toron.preset_file import File
from toron.tables import Row

Tangent = Literal["material", "truesdell", "jaumann", "nominal"]
Level = Literal["best", "baseline", "avx2", "avx512"]
Points = Literal["first", "last"]

TANGENTS = constants("TORON_TANGENT_")
LEVELS = constants("TORON_LEVEL_")
POINTS = {"first": 0, "last": 1}
SUFFIX = {np.dtype(np.float64): "f64", np.dtype(np.float32): "f32"}

STATUS = Member("status", (), written=True)

#: How many calls with `out` a law remembers, and how many bytes the arrays of one may have, together with those that they are views
#: of: it holds them.
_CALLS = 8
_BYTES = 4 << 20
_FIXED = (str, int, float, type(None))


def choice(name: str, value: Any, choices: dict[str, int]) -> int:
    """The library's constant for an option."""
    try:
        return choices[value]
    except (KeyError, TypeError):
        raise ArgumentError(f"{name} is {shown(value)}; allowed: {', '.join(choices)}", lib.TORON_BAD_ARGUMENT) from None


class Law:
    """A law prepared from its properties. Laws do not change; they may be used by several threads, and be pickled. Those of one class
    with the same properties and options are equal.
    """

    #: The library's constant for the law; this one is of none.
    _number: ClassVar[int] = -1
    _structure: ClassVar[str]

    def __init__(self, density: float | None = None, **properties: float) -> None:
        indices = {name: tables.property_index(self._number, name) for name in properties}
        given = {index: _property(name, properties[name]) for name, index in indices.items()}
        values = []
        for index, row in enumerate(self.properties_table()):
            value = given.get(index, row.default)
            if value is None:
                raise PropertyError(f"property {row.name} is missing; allowed: {row.allowed}", lib.TORON_PROPERTY_COUNT)
            values.append(value)
        self._values = np.array(values, np.float64)
        self._density = None if density is None else _checked_density(density)
        self._prepared: dict[np.dtype, Any] = {}
        self._calls: tuple[tuple[Call, tuple[Any, ...]], ...] = ()
        self._law_in(np.dtype(np.float64))

    @classmethod
    def from_values(cls, values: ArrayLike, density: float | None = None, **options: Any) -> Self:
        """The law from its properties in the order of the table, and options of the class."""
        names = [row.name for row in cls.properties_table()]
        try:
            given = numbers("values", values, (len(names),))
        except ArgumentError as error:
            raise PropertyError(str(error), lib.TORON_PROPERTY_COUNT) from None
        return cls(density=density, **options, **dict(zip(names, given.tolist())))

    @classmethod
    def from_preset(cls, name: str, units: str, **changes: Any) -> Self:
        """The law of a preset of the library, such as "kevlar-km2-600" or "kevlar-km2-600-linear", with its density.

        `units`: those of your model, length, mass and time joined by "-": "m-kg-s" (or "si"), "mm-tonne-s", "mm-g-ms", …;
        `changes`: properties and options that replace those of the preset.

        Raises `ArgumentError` for a name or unit that does not exist, `PropertyError` for a property.
        """
        names = [row.name for row in cls.properties_table()]
        values, density = tables.preset(name, units, len(names))
        return cls(**({"density": density} | dict(zip(names, values)) | changes))

    @classmethod
    def from_file(cls, path: str | PathLike[str], units: str, **changes: Any) -> Self:
        """The law of a preset's file, such as `toron fit` writes, with its density if it has one.

        `units`: those of your model, as for `from_preset`; values are converted to them from the units of the file. `changes`: properties
        and options that replace those of the file, and give what it leaves open.

        Raises `ArgumentError` for a file that cannot be read, a key or a unit, `PropertyError` for a property; both name the file.
        """
        file = File(path, cls._number, units)
        file.check_complete(changes)
        try:
            return cls(**(file.values | changes))
        except PropertyError as error:
            raise error if changes else file.of_law(error) from None

    @classmethod
    def properties_table(cls) -> tuple[Row, ...]:
        """The properties: names, dimensions, defaults, bounds and meanings."""
        return tables.properties(cls._number)

    @classmethod
    def state_table(cls) -> tuple[Row, ...]:
        """The state variables, in the order in which they stand in a `state` array; all are 0 at the start."""
        return tables.state_variables(cls._number)

    @classmethod
    def state_index(cls, name: str) -> int:
        """The index of a state variable in a `state` array. Raises `ArgumentError`, which lists the names, if there is none."""
        wanted = tables.encoded("state variable", name)
        return raise_for(lib.toron_state_index(cls._number, wanted, buffers.message, CAPACITY))

    @property
    def properties(self) -> Mapping[str, float]:
        """The properties by name."""
        return MappingProxyType({row.name: value for row, value in zip(self.properties_table(), self._values.tolist())})

    @property
    def density(self) -> float | None:
        """The reference density, which the wave speed needs; None if it has not been given."""
        return self._density

    def _options(self) -> dict[str, Any]:
        """What a law is made of beside its properties."""
        return {"density": self._density}

    def replace(self, **changes: Any) -> Self:
        """The law with other properties or options."""
        return type(self)(**(self._options() | dict(self.properties) | changes))

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise AssignmentError(
                f"{name} cannot be set, since a law does not change; allowed: a new one, law.replace({name}=…)", lib.TORON_BAD_ARGUMENT
            )
        super().__setattr__(name, value)

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self.properties == other.properties and self._options() == other._options()

    def __hash__(self) -> int:
        return hash((type(self), *self.properties.values(), *self._options().values()))

    def __repr__(self) -> str:
        arguments = ", ".join(f"{name}={value!r}" for name, value in (dict(self.properties) | self._options()).items())
        return f"{type(self).__name__}({arguments})"

    def __reduce__(self) -> Any:
        return _remade, (type(self), self._options() | dict(self.properties))

    def new_state(self, points: int | tuple[int, ...] = (), dtype: DTypeLike = np.float64, layout: Points = "first") -> NDArray[Any]:
        """The state of so many points at the start, zeros: (n, number of state variables), or (…, n) with `layout="last"`.

        Raises `ArgumentError` for what are no numbers of points, and a `dtype` that is neither float64 nor float32.
        """
        try:
            kind = np.dtype(dtype)
        except Exception:  # NumPy has many for what is no type.
            kind = None
        if kind not in SUFFIX:
            raise ArgumentError(f"dtype is {shown(dtype)}; allowed: float64, float32", lib.TORON_BAD_ARGUMENT)
        last, count = choice("layout", layout, POINTS), (len(self.state_table()),)
        try:
            shape = tuple(map(integer, points)) if isinstance(points, Iterable) else (integer(points),)
            return np.zeros(count + shape if last else shape + count, kind)
        except (TypeError, ValueError, OverflowError, MemoryError):
            allowed = "a number of points that memory has room for, or a tuple of such numbers"
            raise ArgumentError(f"points is {shown(points)}; allowed: {allowed}", lib.TORON_BAD_COUNT) from None

    def _law_in(self, dtype: np.dtype) -> Any:
        """The prepared law in this precision."""
        if dtype not in self._prepared:
            suffix = SUFFIX[dtype]
            law = ffi.new(f"{self._structure}_{suffix} *")
            prepare = getattr(lib, f"{self._structure}_prepare_{suffix}")
            values = ffi.new("double[]" if suffix == "f64" else "float[]", self._values.tolist())
            raise_for(prepare(law, ffi.sizeof(law[0]), values, len(self._values), buffers.message, CAPACITY))
            self._prepared[dtype] = law
        return self._prepared[dtype]

    def _set_density(self, block: Any, density: float | None, outputs: Iterable[str]) -> None:
        if "wave_speed" in outputs:
            density = self._density if density is None else density
            if density is None:
                raise ArgumentError("density is missing; allowed: a finite number > 0, for the wave speed", lib.TORON_BAD_ARGUMENT)
            block.density = _checked_density(density)

    def _evaluate(
        self, inputs: tuple[Any, ...], out: Mapping[str, np.ndarray] | None, outputs: str | Iterable[str] | None, options: tuple[Any, ...]
    ) -> Mapping[str, np.ndarray]:
        """Calls what `_bind` makes, or has made before for the very same objects: to look at arrays anew takes longer than to
        evaluate some points.
        """
        # A dict is seen to be one in a tenth of the time that a mapping takes.
        if outputs is not None or not (type(out) is dict or isinstance(out, Mapping)) or not out:
            return dict(self._bind(inputs, out, outputs, options).run())
        given = (*inputs, *options, *out, *out.values())
        for call, before in self._calls:
            if len(before) == len(given) and all(map(is_, before, given)) and call.unchanged():
                call.run()
                return out
        call = self._bind(inputs, out, outputs, options)
        if _can_be_remembered((*inputs, *out.values()), options):
            self._calls = ((call.for_later(), given), *self._calls)[:_CALLS]
        call.run()
        return out

    def _bind(self, inputs: tuple[Any, ...], out: Any, outputs: Any, options: tuple[Any, ...], frozen: bool = True) -> Call:
        """Checks the arguments and places the arrays; `frozen`: inputs may be what NumPy makes arrays of."""
        raise NotImplementedError

    def _call(self, function: str, block: Any, placed: Arrays, outputs: dict[str, np.ndarray]) -> Call:
        """The call whose arrays and options are set."""
        status = outputs.get("status")
        if status is None and prod(placed.points) != 1:
            # With it the message names the point.
            status = placed.empty(STATUS)
            placed.put(STATUS, status)
        return Call(getattr(lib, function), self._law_in(placed.dtype), block, placed.place(block), placed, outputs, status)


def _property(name: str, value: Any) -> float:
    found = number(value)
    if found is None:
        raise PropertyError(f"property {name} is {shown(value)}; allowed: a number", lib.TORON_PROPERTY_NOT_FINITE)
    return found


def _checked_density(density: Any) -> float:
    value = number(density)
    if value is None or not 0 < value < inf:
        raise ArgumentError(f"density is {shown(density)}; allowed: a finite number > 0", lib.TORON_BAD_ARGUMENT)
    return value


def _can_be_remembered(arrays: tuple[Any, ...], options: tuple[Any, ...]) -> bool:
    """Whether a call may be taken for an earlier one by its very objects: what is no plain array is read once, when it is converted,
    and what can change without being looked at is no plain option. What the law holds then must not be large.
    """
    total = 0
    for array in arrays:
        if array is None:
            continue
        whole = array
        while type(whole) is np.ndarray and whole.base is not None:
            whole = whole.base
        if type(array) is not np.ndarray or type(whole) is not np.ndarray:
            return False
        total += whole.nbytes
    return total <= _BYTES and all(isinstance(option, _FIXED) for option in options)


def _remade(law: type[Law], arguments: dict[str, Any]) -> Law:
    return law(**arguments)
