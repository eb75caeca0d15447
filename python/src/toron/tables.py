"""The tables of properties and state variables, and the presets, as the library tells them."""

from dataclasses import dataclass
from typing import Any

from toron._library import CAPACITY, buffers, ffi, lib, structure, text
from toron.errors import ArgumentError, PropertyError, raise_for, shown


@dataclass(frozen=True)
class Row:
    """A property or a state variable.

    `unit` is the physical dimension in words ("stress", "-"), `mass`, `length` and `time` are its exponents. `default` is None where
    the property must be given. The value is at least `minimum` (more, if `minimum_excluded`) and at most `maximum`.
    """

    name: str
    symbol: str
    unit: str
    mass: int
    length: int
    time: int
    default: float | None
    minimum: float
    maximum: float
    minimum_excluded: bool
    allowed: str
    meaning: str


def _rows(count: int, read) -> tuple[Row, ...]:
    rows = []
    for index in range(raise_for(count)):
        row = structure("toron_table_row")
        raise_for(read(index, row))
        rows.append(
            Row(
                name=text(row.name),
                symbol=text(row.symbol),
                unit=text(row.unit),
                mass=row.mass,
                length=row.length,
                time=row.time,
                default=row.default_value if row.has_default else None,
                minimum=row.minimum,
                maximum=row.maximum,
                minimum_excluded=bool(row.minimum_excluded),
                allowed=text(row.allowed),
                meaning=text(row.meaning),
            )
        )
    return tuple(rows)


def properties(law: int) -> tuple[Row, ...]:
    """The properties of a law (`lib.TORON_HYPERELASTIC`, …) in the library's order."""
    count = lib.toron_property_count(law, buffers.message, CAPACITY)
    return _rows(count, lambda index, row: lib.toron_property(law, index, row, buffers.message, CAPACITY))


def state_variables(law: int) -> tuple[Row, ...]:
    """The state variables of a law in the library's order."""
    count = lib.toron_state_count(law, buffers.message, CAPACITY)
    return _rows(count, lambda index, row: lib.toron_state_variable(law, index, row, buffers.message, CAPACITY))


def encoded(what: str, name: Any) -> bytes:
    """A name as the library takes it. Raises `ArgumentError` for what is no text, or would be another one there."""
    try:
        found = name.encode() if isinstance(name, str) else b"\0"
    except UnicodeEncodeError:
        found = b"\0"
    if b"\0" in found:
        allowed = "a text of Unicode characters but the null character"
        raise ArgumentError(f"{what} is {shown(name)}; allowed: {allowed}", lib.TORON_BAD_ARGUMENT)
    return found


def property_index(law: int, name: str) -> int:
    """The index of a property, counted from 0. Raises `ArgumentError`, which lists the names, if there is none."""
    return raise_for(lib.toron_property_index(law, encoded("property", name), buffers.message, CAPACITY))


def preset(name: str, units: str, count: int) -> tuple[list[float], float]:
    """The `count` properties of a preset in the library's order, and the reference density, in these units.

    Raises `ArgumentError` for a name or a unit that does not exist, `PropertyError` if the preset is of another law.
    """
    wanted, system = encoded("preset", name), encoded("units", units)
    values, density = ffi.new("double[]", count), ffi.new("double *")
    code = lib.toron_preset_f64(wanted, system, values, count, density, buffers.message, CAPACITY)
    if code == lib.TORON_PROPERTY_COUNT:
        raise PropertyError(f"preset {name} is of another law: {text(buffers.message)}", code)
    raise_for(code)
    return list(values), density[0]
