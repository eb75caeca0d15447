"""A call of the library with its arguments in place."""

from collections.abc import Mapping
from operator import attrgetter
from types import MappingProxyType
from typing import Any

import numpy as np

from toron._library import CAPACITY, buffers, text
from toron.arrays import Arrays
from toron.errors import PointError, is_of_points, raise_for
from toron.placement import Copy

_layout = attrgetter("shape", "strides", "dtype")
_writeable = attrgetter("flags.writeable")


class Call:
    """A law bound to arrays: every call evaluates it on what they hold then, and returns the mapping of the outputs.

    Made by `Hyperelastic.bind` and `LinearElastic.bind`. It holds the arrays, and must not be used by two threads at a time.
    """

    __slots__ = ("_function", "_law", "_block", "_copies", "_status", "_reported", "_written", "_arrays", "_layouts", "_wholes", "_shape", "outputs", "points")

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
        self._copies, self._arrays, self._wholes = copies, tuple(placed.all.values()), tuple(placed.wholes)
        self._status, self._reported, self._shape = status, "status" in outputs, placed.points
        self._layouts = tuple(map(_layout, self._arrays))
        self._written = tuple(placed.written.values())
        #: The outputs by name.
        self.outputs: Mapping[str, np.ndarray] = MappingProxyType(outputs)
        #: The number of points.
        self.points: int = block.n

    def __call__(self) -> Mapping[str, np.ndarray]:
        """Evaluates the law. Raises `PointError` for points that cannot be evaluated, unless "status" is among the outputs."""
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
        """Whether the arrays have shapes, strides and types as when they were bound, and those that are written may be."""
        return tuple(map(_layout, self._arrays)) == self._layouts and all(map(_writeable, self._written))

    def pointers(self) -> tuple[Any, Any, Any]:
        """The library's function, the prepared law and the structure of the block, for callers from other languages."""
        return self._function, self._law, self._block
