"""The stress in other measures and shapes. Each makes a new array, and raises `ArgumentError` for other shapes than it says."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from toron._library import lib
from toron.arrays import real
from toron.errors import ArgumentError
from toron.law import POINTS, Points, choice

#: 11 22 33 12 23 31 as entries of a symmetric matrix.
_MATRIX = [[0, 3, 5], [3, 1, 4], [5, 4, 2]]


def _tensors(name: str, values: Any, components: tuple[int, ...], last: int) -> np.ndarray:
    """Arrays with these components at every point."""
    array, rank = real(name, values), len(components)
    if (array.shape[:rank] if last else array.shape[-rank:]) != components:
        own = ", ".join(map(str, components))
        allowed = f"({own}, …)" if last else f"(…, {own})"
        raise ArgumentError(f"{name} has shape {array.shape}; allowed: {allowed}", lib.TORON_BAD_COUNT)
    return array if array.dtype.kind == "f" else array.astype(np.float64)


def matrix(stress: ArrayLike, points: Points = "first") -> NDArray[np.floating]:
    """Stresses (…, 6), in the order 11 22 33 12 23 31, as symmetric matrices (…, 3, 3); (6, …) and (3, 3, …) with `points="last"`."""
    last = choice("points", points, POINTS)
    stress = _tensors("stress", stress, (6,), last)
    return stress[_MATRIX] if last else stress[..., _MATRIX]


def first_piola_kirchhoff(F: ArrayLike, stress: ArrayLike, points: Points = "first") -> NDArray[np.floating]:
    """P = σ cof F, (…, 3, 3), from F (…, 3, 3) and Cauchy stresses (…, 6); (3, 3, …) and (6, …) with `points="last"`.

    P is 0 where there is no stress, for any F.
    """
    last = choice("points", points, POINTS)
    F, stress = _tensors("F", F, (3, 3), last), _tensors("stress", stress, (6,), last)
    if last:
        return np.moveaxis(first_piola_kirchhoff(np.moveaxis(F, (0, 1), (-2, -1)), np.moveaxis(stress, 0, -1)), (-2, -1), (0, 1))
    try:
        np.broadcast_shapes(F.shape[:-2], stress.shape[:-1])
    except ValueError:
        allowed = f"the points of stress, {stress.shape[:-1]}"
        raise ArgumentError(f"F has the points {F.shape[:-2]}; allowed: {allowed}", lib.TORON_BAD_COUNT) from None
    a, b, c = F[..., 0], F[..., 1], F[..., 2]
    with np.errstate(invalid="ignore", over="ignore"):
        cofactor = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-1)
        first = matrix(stress) @ cofactor
    return np.where((stress == 0).all(axis=-1)[..., None, None], first.dtype.type(0), first)


def second_piola_kirchhoff(modes: ArrayLike, points: Points = "first") -> NDArray[np.floating]:
    """S, (…, 6) in the order 11 22 33 12 23 31, from the output "modes", (…, 4, 6): the sum; (6, …) with `points="last"`."""
    last = choice("points", points, POINTS)
    return _tensors("modes", modes, (4, 6), last).sum(axis=0 if last else -2)
