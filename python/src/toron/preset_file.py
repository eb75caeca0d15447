"""A preset's file, as `toron fit` writes it: docs/guides/load-paths.md of the repository has its keys."""

import os
import tomllib
from math import inf, isclose, isfinite, log10
from typing import Any

from toron import tables
from toron._library import lib
from toron.arrays import number
from toron.errors import ArgumentError, Error, PropertyError, shown

_KEYS = ("name", "source", "units", "law", "density", "properties")
_LAWS = {"hyperelastic": lib.TORON_HYPERELASTIC, "linear-elastic": lib.TORON_LINEAR_ELASTIC, "frictional": lib.TORON_FRICTIONAL}

Dimension = tuple[int, int, int]
_DENSITY: Dimension = (1, -3, 0)


class File:
    """The values of a preset's file in the units of a model: what it gives of "density" and the properties, by name.

    Raises `ArgumentError` and `PropertyError`, which name the file and what is wrong in it.
    """

    def __init__(self, path: str | os.PathLike[str], law: int, units: str) -> None:
        try:
            self.name = os.fsdecode(path)
        except (TypeError, ValueError):
            raise ArgumentError(f"path is {shown(path)}; allowed: the path of a preset's file", lib.TORON_BAD_ARGUMENT) from None
        self._rows = {row.name: row for row in tables.properties(law)}
        table = self._read(path)
        for key in table:
            if key not in _KEYS:
                raise self._error(f"key {shown(key)} is unknown; allowed: {', '.join(_KEYS)}")
        for key in ("name", "source", "units"):
            if not isinstance(table.get(key, ""), str):
                raise self._error(f"{key} is {shown(table[key])}; allowed: text in quotes")
        self._check_law(table.get("law", "hyperelastic"), law)
        wanted = _scales(units)
        try:
            own = _scales(table["units"])
        except KeyError:
            raise self._error("units is missing; allowed: the units of the file's values, such as mm-tonne-s") from None
        except ArgumentError as error:
            raise self._error(str(error), error.code) from None
        self.values = {}
        for name, (value, dimension) in (self._density(table) | self._properties(table)).items():
            self.values[name] = _converted(value, own[dimension], wanted[dimension])

    def check_complete(self, changes: dict[str, Any]) -> None:
        """Raises `PropertyError` for a property that neither the file nor `changes` gives, and that has no default."""
        for row in self._rows.values():
            if row.default is None and row.name not in self.values and row.name not in changes:
                message = f"property {row.name} ({row.meaning}) is missing; allowed: {row.allowed}"
                raise self._of_property(message, lib.TORON_PROPERTY_COUNT)

    def of_law(self, error: PropertyError) -> PropertyError:
        """The error of a law that refuses the file's values."""
        return self._of_property(str(error), error.code)

    def _read(self, path: Any) -> dict[str, Any]:
        try:
            with open(path, encoding="utf-8") as file:
                text = file.read()
        except OSError as error:
            raise self._error(f"the file cannot be read: {error.strerror}") from None
        except ValueError as error:
            # It is not UTF-8, or its name is none that a file can have.
            raise self._error(f"the file cannot be read: {error}") from None
        try:
            return tomllib.loads(text)
        except (ValueError, RecursionError) as error:
            raise self._error(f"the file is no TOML: {error}") from None

    def _check_law(self, name: Any, law: int) -> None:
        if not isinstance(name, str) or name not in _LAWS:
            raise self._error(f"law is {shown(name)}; allowed: {' or '.join(_LAWS)}")
        if _LAWS[name] != law:
            (allowed,) = (name for name, number in _LAWS.items() if number == law)
            raise self._of_property(f"law is {name!r}; allowed: {allowed!r} for this class", lib.TORON_PROPERTY_COUNT)

    def _density(self, table: dict[str, Any]) -> dict[str, tuple[float, Dimension]]:
        if "density" not in table:
            return {}
        value = _number(table["density"])
        if value is None or not 0 < value < inf:
            raise self._error(f"density is {shown(table['density'])}; allowed: a finite number > 0")
        return {"density": (value, _DENSITY)}

    def _properties(self, table: dict[str, Any]) -> dict[str, tuple[float, Dimension]]:
        given, rows, found = table.get("properties", {}), self._rows, {}
        if not isinstance(given, dict):
            raise self._error(f"properties is {shown(given)}; allowed: a table")
        for name, entry in given.items():
            if name not in rows:
                raise self._error(f"property {shown(name)} is unknown; allowed: {' '.join(rows)}", lib.TORON_UNKNOWN_NAME)
            row, value = rows[name], _number(entry)
            allowed = value is not None and isfinite(value) and row.minimum <= value <= row.maximum
            if not allowed or row.minimum_excluded and value == row.minimum:
                text = f"property {name} ({row.meaning}) is {shown(entry)}; allowed: {row.allowed}"
                raise self._of_property(text, lib.TORON_PROPERTY_OUT_OF_BOUNDS)
            found[name] = (value, (row.mass, row.length, row.time))
        return found

    def _error(self, message: str, code: int = lib.TORON_BAD_ARGUMENT) -> Error:
        return ArgumentError(f"{self.name}: {message}", code)

    def _of_property(self, message: str, code: int) -> PropertyError:
        return PropertyError(f"{self.name}: {message}", code)


def _number(entry: Any) -> float | None:
    """TOML has its own words for what is true."""
    return None if isinstance(entry, bool) else number(entry)


def _scales(units: str) -> dict[Dimension, float]:
    """What a preset of the library has in these units, one value of each dimension: values of that dimension are proportional to it."""
    rows = tables.properties(lib.TORON_HYPERELASTIC)
    values, density = tables.preset("kevlar-km2-600", units, len(rows))
    return {(row.mass, row.length, row.time): value for row, value in zip(rows, values) if value} | {_DENSITY: density}


def _converted(value: float, own: float, wanted: float) -> float:
    """The value in the wanted units: as the program has it to the bit between decimal units, with one rounding."""
    ratio = wanted / own
    exponent = round(log10(ratio))
    if isclose(ratio, 10.0**exponent, rel_tol=1e-12):
        return value * 10.0**exponent if exponent >= 0 else value / 10.0**-exponent
    return value * ratio
