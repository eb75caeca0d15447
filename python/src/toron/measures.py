"""The stress in other measures and shapes. Each makes a new array."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from toron.law import POINTS, Points, choice

#: 11 22 33 12 23 31 as entries of a symmetric matrix.
_MATRIX = [[0, 3, 5], [3, 1, 4], [5, 4, 2]]


def matrix(stress: ArrayLike, points: Points = "first") -> NDArray[np.floating]:
    """Stresses (…, 6), in the order 11 22 33 12 23 31, as symmetric matrices (…, 3, 3); (6, …) and (3, 3, …) with `points="last"`."""
    stress = np.asarray(stress)
    return stress[_MATRIX] if choice("points", points, POINTS) else stress[..., _MATRIX]


def first_piola_kirchhoff(F: ArrayLike, stress: ArrayLike, points: Points = "first") -> NDArray[np.floating]:
    """P = σ cof F, (…, 3, 3), from F (…, 3, 3) and Cauchy stresses (…, 6); (3, 3, …) and (6, …) with `points="last"`.

    P is 0 where there is no stress, for any F.
    """
    F, stress = np.asarray(F), np.asarray(stress)
    if choice("points", points, POINTS):
        return np.moveaxis(first_piola_kirchhoff(np.moveaxis(F, (0, 1), (-2, -1)), np.moveaxis(stress, 0, -1)), (-2, -1), (0, 1))
    a, b, c = F[..., 0], F[..., 1], F[..., 2]
    with np.errstate(invalid="ignore", over="ignore"):
        cofactor = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-1)
        first = matrix(stress) @ cofactor
    return np.where((stress == 0).all(axis=-1)[..., None, None], first.dtype.type(0), first)


def second_piola_kirchhoff(modes: ArrayLike, points: Points = "first") -> NDArray[np.floating]:
    """S, (…, 6) in the order 11 22 33 12 23 31, from the output "modes", (…, 4, 6): the sum; (6, …) with `points="last"`."""
    return np.asarray(modes).sum(axis=0 if choice("points", points, POINTS) else -2)
