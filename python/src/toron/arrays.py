"""The arrays of one call: their shapes and types are checked, what is left out is made, and all are put in their places."""

from collections.abc import Iterable, Mapping
from math import prod
from typing import Any

import numpy as np

from toron._library import lib
from toron.errors import ArgumentError
from toron.placement import Copy, Member, Placed, components_first, place

_FLOATS = (np.dtype(np.float32), np.dtype(np.float64))
_STATUS = np.dtype(np.int32)


class Arrays:
    """The arrays beside a deformation gradient, which sets the axes of points and the precision."""

    def __init__(self, name: str, member: Member, gradient: Any, points_last: bool, frozen: bool) -> None:
        self._points_last, self._frozen = points_last, frozen
        #: The arrays of the caller and those made in their place, and by name those that are written.
        self.all: list[np.ndarray] = []
        self.written: dict[str, np.ndarray] = {}
        self._placed: list[Placed] = []
        array = self._array(name, gradient)
        self.dtype = array.dtype if array.dtype in _FLOATS else np.dtype(np.float64)
        own = array.shape[:2] if points_last else array.shape[-2:]
        if own != (3, 3):
            allowed = "(3, 3) or (3, 3, n)" if points_last else "(3, 3) or (n, 3, 3)"
            raise ArgumentError(f"{name} has shape {array.shape}; allowed: {allowed}", lib.TORON_BAD_COUNT)
        self.points = array.shape[2:] if points_last else array.shape[:-2]
        self.all.append(array)
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
        self.all.append(array)
        return array

    def output(self, name: str, member: Member, given: Any) -> np.ndarray:
        """An array that is written, perhaps after it has been read: the one given, checked, or a new one."""
        array = self.empty(member) if given is None else given
        dtype = _STATUS if member.name == "status" else self.dtype
        if not isinstance(array, np.ndarray) or array.dtype != dtype:
            found = f"type {array.dtype}" if isinstance(array, np.ndarray) else f"type {type(array).__name__}"
            raise ArgumentError(f"{name} has {found}; allowed: a NumPy array of {dtype}", lib.TORON_BAD_ARGUMENT)
        self._check_shape(name, array, member)
        if not array.flags.writeable:
            raise ArgumentError(f"{name} is read-only; allowed: an array that may be written", lib.TORON_BAD_ARGUMENT)
        self.written[name] = array
        self.all.append(array)
        return array

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
        array = np.asarray(values)
        if not np.can_cast(array.dtype, np.float64, "same_kind"):
            raise ArgumentError(f"{name} has type {array.dtype}; allowed: real numbers", lib.TORON_BAD_ARGUMENT)
        return array

    def _check_shape(self, name: str, array: np.ndarray, member: Member) -> None:
        if array.shape != self.shape(member.components):
            raise ArgumentError(f"{name} has shape {array.shape}; allowed: {self.shape(member.components)}", lib.TORON_BAD_COUNT)

    def _check_overlap(self) -> None:
        """The library reads and writes by parts, so that an output over an input would change what is still to be read."""
        for name, output in self.written.items():
            for array in self.all:
                if array is not output and np.may_share_memory(array, output) and not _same_place(array, output):
                    if np.shares_memory(array, output):
                        raise ArgumentError(f"{name} shares memory with another array of the call", lib.TORON_BAD_ARGUMENT)


def _same_place(a: np.ndarray, b: np.ndarray) -> bool:
    return a.ctypes.data == b.ctypes.data and a.shape == b.shape and a.strides == b.strides


def names(outputs: str | Iterable[str] | None, out: Mapping[str, Any] | None, allowed: Iterable[str]) -> tuple[str, ...]:
    """The outputs that are wanted: those of `outputs` and of `out`, or else the stress."""
    if outputs is None:
        outputs = () if out else "stress"
    named = (outputs,) if isinstance(outputs, str) else tuple(outputs)
    wanted = tuple(dict.fromkeys((*(out or ()), *named)))
    for name in wanted:
        if name not in allowed:
            raise ArgumentError(f"output {name!r} is unknown; allowed: {', '.join(allowed)}", lib.TORON_UNKNOWN_NAME)
    return wanted
