"""The arrays of one call: their shapes and types are checked, what is left out is made, and all are put in their places."""

from collections.abc import Iterable, Mapping
from math import prod
from typing import Any

import numpy as np

from toron._library import lib
from toron.errors import ArgumentError, shown
from toron.placement import Copy, Member, Placed, components_first, place

_FLOATS = (np.dtype(np.float32), np.dtype(np.float64))
_STATUS = np.dtype(np.int32)


class Arrays:
    """The arrays beside a deformation gradient, which sets the axes of points and the precision."""

    def __init__(self, name: str, member: Member, gradient: Any, points_last: bool, frozen: bool) -> None:
        self._points_last, self._frozen = points_last, frozen
        #: By name, the arrays as they are read and written, and which of them are written.
        self.all: dict[str, np.ndarray] = {}
        self.written: dict[str, np.ndarray] = {}
        #: Those that have the memory: the caller's own objects, and what has been made. They must live as long as the call.
        self.held: dict[str, np.ndarray] = {}
        self._placed: list[Placed] = []
        array = self._array(name, gradient)
        self.dtype = array.dtype if array.dtype in _FLOATS else np.dtype(np.float64)
        own = array.shape[:2] if points_last else array.shape[-2:]
        if own != (3, 3):
            allowed = "(3, 3) or (3, 3, n)" if points_last else "(3, 3) or (n, 3, 3)"
            raise ArgumentError(f"{name} has shape {array.shape}; allowed: {allowed}", lib.TORON_BAD_COUNT)
        self.points = array.shape[2:] if points_last else array.shape[:-2]
        self.all[name] = array
        self.put(member, array)

    def shape(self, components: tuple[int, ...]) -> tuple[int, ...]:
        """The shape of an array with these components at every point."""
        return components + self.points if self._points_last else self.points + components

    def put(self, member: Member, array: np.ndarray) -> None:
        """Says that the member is to be this array."""
        self._placed.append(Placed(member, components_first(array, member, self._points_last)))

    def put_parts(self, members: Iterable[Member], whole: np.ndarray) -> dict[str, np.ndarray]:
        """Says that these members are the parts of an array, one after the other; returns the parts by the members' names."""
        parts, first = {}, 0
        for member in members:
            selected = slice(first, first + member.components[0])
            parts[member.name] = whole[selected] if self._points_last else whole[..., selected]
            self.put(member, parts[member.name])
            first = selected.stop
        return parts

    def input(self, name: str, member: Member, values: Any) -> np.ndarray:
        """An array that is read, checked."""
        array = self._array(name, values)
        self._check_shape(name, array, member)
        self.all[name] = array
        return array

    def one_for_all(self, name: str, member: Member, values: Any) -> np.ndarray:
        """As `input`; one entry is that of all points."""
        array = self._array(name, values)
        if array.shape != member.components or not self.points:
            return self.input(name, member, values)
        own_axes = array.reshape(array.shape + (1,) * len(self.points)) if self._points_last else array
        self.all[name] = np.broadcast_to(own_axes, self.shape(member.components))
        return self.all[name]

    def output(self, name: str, member: Member, given: Any) -> np.ndarray:
        """An array that is written, perhaps after it has been read: the one given, checked, or a new one."""
        array = self.empty(member) if given is None else given
        dtype = _STATUS if member.name == "status" else self.dtype
        if not isinstance(array, np.ndarray) or array.dtype != dtype:
            found = f"type {array.dtype}" if isinstance(array, np.ndarray) else f"type {type(array).__name__}"
            raise ArgumentError(f"{name} has {found}; allowed: a NumPy array of {dtype}", lib.TORON_BAD_ARGUMENT)
        refuse_mask(name, array)
        self._check_shape(name, array, member)
        if not array.flags.writeable:
            raise ArgumentError(f"{name} is read-only; allowed: an array that may be written", lib.TORON_BAD_ARGUMENT)
        self.all[name] = self.written[name] = self.held[name] = array
        return array

    def parts(self, members: list[Member]) -> dict[str, np.ndarray]:
        """New arrays for outputs that share a layout in the library, by the members' names: the parts of one array."""
        whole = self.empty(Member("parts", (sum(member.components[0] for member in members),)))
        self.held[", ".join(member.name for member in members)] = whole
        return self.put_parts(members, whole)

    def empty(self, member: Member) -> np.ndarray:
        """A new array for an output, in such an order that the library can write to it."""
        dtype = _STATUS if member.name == "status" else self.dtype
        array = np.empty(self.shape(member.components), dtype)
        axes = list(range(array.ndim))
        first = 0 if self._points_last else array.ndim - len(member.order)
        axes[first : first + len(member.order)] = [first + k for k in member.order]
        return array.transpose(axes)

    def place(self, block: Any) -> list[Copy]:
        """Sets the members of the block; returns the copies that are needed."""
        block.n = prod(self.points)
        self._check_overlap()
        return place(block, self._placed, self.dtype)

    def _array(self, name: str, values: Any) -> np.ndarray:
        if not self._frozen and not isinstance(values, np.ndarray):
            raise ArgumentError(f"{name} is a {type(values).__name__}; allowed: a NumPy array", lib.TORON_BAD_ARGUMENT)
        array = real(name, values)
        self.held[name] = values if isinstance(values, np.ndarray) else array
        return array

    def _check_shape(self, name: str, array: np.ndarray, member: Member) -> None:
        if array.shape != self.shape(member.components):
            raise ArgumentError(f"{name} has shape {array.shape}; allowed: {self.shape(member.components)}", lib.TORON_BAD_COUNT)

    def _check_overlap(self) -> None:
        """The library reads and writes by parts, so that an output over another array would change what is still to be read, or has
        been written. Only the new state may be where the old one is.
        """
        for name, output in self.written.items():
            for other, array in self.all.items():
                if other == name or not np.may_share_memory(array, output):
                    continue
                if (name, other) == ("state", "state_old") and _same_place(array, output):
                    continue
                if np.shares_memory(array, output):
                    raise ArgumentError(f"{name} shares memory with {other}; allowed: arrays of their own", lib.TORON_BAD_ARGUMENT)


def real(name: str, values: Any) -> np.ndarray:
    """The values as an array of real numbers of any type."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ArgumentError(f"{name} is no array of numbers: {error}", lib.TORON_BAD_ARGUMENT) from None
    if not np.can_cast(array.dtype, np.float64, "same_kind"):
        raise ArgumentError(f"{name} has type {array.dtype}; allowed: real numbers", lib.TORON_BAD_ARGUMENT)
    refuse_mask(name, values)
    return array


def refuse_mask(name: str, values: Any) -> None:
    """The library has no masks: it would take what is under one for a value. Lists may have masked arrays in them."""
    if isinstance(values, np.ma.MaskedArray):
        allowed = 'an array without a mask, such as "filled(value)" or the entries that are not masked'
        raise ArgumentError(f"{name} is a masked array; allowed: {allowed}", lib.TORON_BAD_ARGUMENT)
    if isinstance(values, (list, tuple)):
        for value in values:
            refuse_mask(name, value)


def numbers(name: str, values: Any, shape: tuple[int, ...]) -> np.ndarray:
    """The values as a contiguous array of this shape, float64."""
    array = np.ascontiguousarray(real(name, values), np.float64)
    if array.shape != shape:
        raise ArgumentError(f"{name} has shape {array.shape}; allowed: {shape}", lib.TORON_BAD_COUNT)
    return array


def number(value: Any) -> float | None:
    """The value as a number; None if it is none, or none that float64 has. A text is none, as little as bytes."""
    if isinstance(value, (str, bytes, bytearray, np.ma.MaskedArray)):
        return None
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        return None


def _same_place(a: np.ndarray, b: np.ndarray) -> bool:
    return a.ctypes.data == b.ctypes.data and a.shape == b.shape and a.strides == b.strides


def names(outputs: str | Iterable[str] | None, out: Mapping[str, Any] | None, allowed: Iterable[str]) -> tuple[str, ...]:
    """The outputs that are wanted: those of `outputs` and of `out`, or else the stress."""
    if out is not None and not isinstance(out, Mapping):
        found = type(out).__name__
        raise ArgumentError(f"out is of type {found}; allowed: arrays by the names of outputs, {{\"stress\": …}}", lib.TORON_BAD_ARGUMENT)
    for name, array in (out or {}).items():
        if array is None:
            raise ArgumentError(f"{name} in out is None; allowed: a NumPy array", lib.TORON_BAD_ARGUMENT)
    if outputs is None:
        outputs = () if out else "stress"
    try:
        named = (*(out or ()), *((outputs,) if isinstance(outputs, str) else outputs))
    except TypeError:
        raise ArgumentError(f"outputs is {shown(outputs)}; allowed: {', '.join(allowed)}", lib.TORON_BAD_ARGUMENT) from None
    for name in named:
        if not isinstance(name, str) or name not in allowed:
            raise ArgumentError(f"output {shown(name)} is unknown; allowed: {', '.join(allowed)}", lib.TORON_UNKNOWN_NAME)
    return tuple(dict.fromkeys(named))
