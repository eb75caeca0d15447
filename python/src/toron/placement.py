"""Where the entries of a NumPy array are, in the terms of the library: pointers, leading dimensions and strides.

Arrays are used where they are. One whose strides the library cannot express goes through a copy, in before the call or out after it.
"""

from itertools import product
from math import prod
from typing import Any, NamedTuple

import numpy as np

from toron._library import ffi


class Member(NamedTuple):
    """A member of the library's structure for a block.

    `components` is the shape of its entries at a point, `order` the axes of that shape in the library's order. Members with the
    same `layout` share one, or have none. `separate`: there is a pointer for each component.
    """

    name: str
    components: tuple[int, ...]
    layout: str | None = None
    separate: bool = False
    written: bool = False
    order: tuple[int, ...] = ()


class Placed(NamedTuple):
    """An array beside the member that it is for, seen with its components first and in the library's order, then the points."""

    member: Member
    view: np.ndarray


class Copy(NamedTuple):
    """An array of the caller, seen as in `Placed`, and the copy that the library gets in its place."""

    member: Member
    callers: np.ndarray
    librarys: np.ndarray


def components_first(array: np.ndarray, member: Member, points_last: bool) -> np.ndarray:
    """The view of an array whose first axes are the member's components in the library's order, the others the points."""
    rank = len(member.components)
    axes = tuple(range(array.ndim))
    components, points = (axes[:rank], axes[rank:]) if points_last else (axes[array.ndim - rank :], axes[: array.ndim - rank])
    if member.order:
        components = tuple(components[k] for k in member.order)
    return array.transpose(components + points)


def _distance(shape: tuple[int, ...], strides: tuple[int, ...]) -> int | None:
    """The distance between neighbours where all entries along these axes have the same one; 0 for one entry, None if it differs."""
    distance, count = 0, 1
    for size, stride in zip(reversed(shape), reversed(strides)):
        if size == 1:
            continue
        if count == 1:
            distance = stride
        elif stride != distance * count:
            return None
        count *= size
    return distance


def _strides(placed: Placed, dtype: np.dtype) -> tuple[int, int] | None:
    """Leading dimension and stride in numbers, 0 where there is one entry only; None where the library cannot express them."""
    member, view = placed
    rank = len(member.components)
    if view.dtype != dtype or not view.flags.aligned or any(stride % dtype.itemsize for stride in view.strides):
        return None
    strides = tuple(stride // dtype.itemsize for stride in view.strides)
    stride = _distance(view.shape[rank:], strides[rank:])
    leading_dimension = 0 if member.separate else _distance(view.shape[:rank], strides[:rank])
    if stride is None or leading_dimension is None or stride < 0 or leading_dimension < 0:
        return None
    points = prod(view.shape[rank:])
    if points > 1 and (stride == 0 or member.layout is None and stride != 1):
        return None
    if rank and not member.separate:
        # The library takes points beside each other in every component, or whole points one after the other.
        in_rows = stride > leading_dimension * (prod(view.shape[:rank]) - 1)
        if leading_dimension == 0 or points > 1 and not (in_rows or leading_dimension > (points - 1) * stride):
            return None
    return leading_dimension, stride


def _pointer(view: np.ndarray, dtype: np.dtype) -> Any:
    return ffi.cast({"d": "double *", "f": "float *", "i": "int32_t *"}[dtype.char], view.ctypes.data)


def place(block: Any, arrays: list[Placed], dtype: np.dtype) -> list[Copy]:
    """Sets pointers and layouts of `block`; returns the copies that are needed."""
    copies = []
    groups: dict[str, list[Placed]] = {}
    for placed in arrays:
        groups.setdefault(placed.member.layout or placed.member.name, []).append(placed)
    for group in groups.values():
        kind = np.dtype(np.int32) if group[0].member.name == "status" else dtype
        strides = {_strides(placed, kind) for placed in group}
        first = strides.pop()
        if strides or first is None:
            kept = []
            for member, view in group:
                copy = np.empty(view.shape, kind)
                copies.append(Copy(member, view, copy))
                kept.append(Placed(member, copy))
            group, first = kept, _strides(kept[0], kind)
        leading_dimension, stride = first or (0, 0)
        for member, view in group:
            _point_to(block, member, view, kind)
        if group[0].member.layout is not None:
            layout = getattr(block, f"{group[0].member.layout}_layout")
            layout.leading_dimension, layout.stride = leading_dimension, max(stride, 1)
    return copies


def _point_to(block: Any, member: Member, view: np.ndarray, dtype: np.dtype) -> None:
    start = _pointer(view, dtype)
    if not member.separate:
        setattr(block, member.name, start)
        return
    steps = [stride // dtype.itemsize for stride in view.strides[: len(member.components)]]
    places = product(*(range(0, size * step, step) if step else [0] * size for size, step in zip(view.shape, steps)))
    setattr(block, member.name, [start + sum(place) for place in places])
