"""A call of the library with its arguments in place."""

import sys
from collections.abc import Mapping
from operator import attrgetter, itemgetter
from types import MappingProxyType
from typing import Any, Self

import numpy as np

from toron._library import CAPACITY, buffers, ffi, lib, text
from toron.arrays import Arrays
from toron.errors import ArgumentError, PointError, is_of_points, raise_for
from toron.placement import Copy

_layout = attrgetter("shape", "strides", "dtype", "flags.writeable")
_size = attrgetter("nbytes")


def _address_behind_head(array: np.ndarray) -> Any:
    """A pointer to where an array says where its data are: NumPy's C interface has that right behind what every object begins with, and
    all extensions are compiled to it. `array.ctypes.data` tells the same, and takes longer than the law at ten points.
    """
    return ffi.cast("uintptr_t *", id(array) + object.__basicsize__)


_PROBE = np.empty(1)
_HAS_HEAD = sys.implementation.name == "cpython" and _address_behind_head(_PROBE)[0] == _PROBE.ctypes.data


class _Memory:
    """The memory of arrays to which a block has pointers. NumPy's `resize` with refcheck=False and `__setstate__` free it, and the same
    array has other memory then.
    """

    __slots__ = ("_names", "_arrays", "_layouts", "_sizes", "_addresses", "_look", "_seen")

    def __init__(self, arrays: Mapping[str, np.ndarray]) -> None:
        self._names, self._arrays = list(arrays), list(arrays.values())
        self._layouts, self._sizes = [*map(_layout, self._arrays)], [*map(_size, self._arrays)]
        self._look, self._seen = attrgetter("ctypes.data"), self._arrays
        self._addresses = [*map(self._look, self._arrays)]
        if _HAS_HEAD:
            self._look, self._seen = itemgetter(0), [*map(_address_behind_head, self._arrays)]

    def is_kept(self) -> bool:
        """Whether all arrays have the memory that they had when they were bound."""
        return [*map(self._look, self._seen)] == self._addresses and [*map(_size, self._arrays)] == self._sizes

    def is_unchanged(self) -> bool:
        """Whether all have the memory, shapes, strides and types that they had, and may be written as then."""
        return [*map(self._look, self._seen)] == self._addresses and [*map(_layout, self._arrays)] == self._layouts

    def refuse(self) -> None:
        """Raises the error that names the arrays which have other memory."""
        found = zip(map(self._look, self._seen), map(_size, self._arrays))
        before = zip(self._addresses, self._sizes)
        names = ", ".join(name for name, now, then in zip(self._names, found, before) if now != then)
        allowed = "an array keeps the memory that it had when the call was bound; bind again after a resize"
        raise ArgumentError(f"{names} has other memory than when the call was bound; allowed: {allowed}", lib.TORON_BAD_ARGUMENT)


class Call:
    """A law bound to arrays: every call evaluates it on what they hold then, and returns the mapping of the outputs.

    Made by `bind` of a law. It holds the arrays, and must not be used by two threads at a time.
    """

    __slots__ = ("_function", "_law", "_block", "_copies", "_status", "_reported", "_arrays", "_memory", "_shape", "outputs", "points")

    def __init__(
        self,
        function: Any,
        law: Any,
        block: Any,
        copies: list[Copy],
        placed: Arrays,
        outputs: Mapping[str, np.ndarray],
        status: np.ndarray | None,
    ) -> None:
        self._function, self._law, self._block = function, law, block
        # The block has pointers into all of these.
        self._copies, self._arrays = copies, placed.held
        self._memory: _Memory | None = None
        self._status, self._reported, self._shape = status, "status" in outputs, placed.points
        #: The outputs by name.
        self.outputs: Mapping[str, np.ndarray] = MappingProxyType(outputs)
        #: The number of points.
        self.points: int = block.n

    def __call__(self) -> Mapping[str, np.ndarray]:
        """Evaluates the law. Raises `PointError` for points that cannot be evaluated, unless "status" is among the outputs, and
        `ArgumentError` if an array has been resized since it was bound.
        """
        if not self._memory.is_kept():
            self._memory.refuse()
        return self.run()

    def for_later(self) -> Self:
        """Notes where the arrays have their memory, which can change until the next call; returns the call."""
        self._memory = _Memory(self._arrays)
        return self

    def run(self) -> Mapping[str, np.ndarray]:
        """As a call, where the arrays have just been bound, or seen to have the memory that they had."""
        if self._copies:
            return self._with_copies()
        code = self._function(self._law, self._block, buffers.message, CAPACITY)
        if code:
            self._check(code)
        return self.outputs

    def _with_copies(self) -> Mapping[str, np.ndarray]:
        for member, callers, librarys in self._copies:
            # The axes are read and written.
            if not member.written or member.name == "axes":
                librarys[...] = callers
        code = self._function(self._law, self._block, buffers.message, CAPACITY)
        if code < 0 and not is_of_points(code):
            raise_for(code)
        for member, callers, librarys in self._copies:
            if member.written:
                callers[...] = librarys
        if code:
            self._check(code)
        return self.outputs

    def _check(self, code: int) -> None:
        if not is_of_points(code):
            raise_for(code)
        if self._reported:
            return
        status = np.full(self._shape, code, np.int32) if self._status is None else self._status.copy()
        raise PointError(text(buffers.message), code, status)

    def unchanged(self) -> bool:
        """Whether the arrays have memory, shapes, strides and types as when they were bound, and may be written as then."""
        return self._memory.is_unchanged()

    def pointers(self) -> tuple[Any, Any, Any]:
        """The library's function, the prepared law and the structure of the block, for callers from other languages."""
        return self._function, self._law, self._block
