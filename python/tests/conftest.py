import numpy as np
import pytest

import toron


@pytest.fixture(scope="session")
def yarn() -> toron.Hyperelastic:
    """Kevlar KM2 600 in N, mm, MPa, fibre along the first axis, with some longitudinal shear stiffness."""
    return toron.Hyperelastic.from_preset("kevlar-km2-600", "mm-tonne-s", k_ld=100.0)


@pytest.fixture(scope="session")
def linear() -> toron.LinearElastic:
    return toron.LinearElastic.from_preset("kevlar-km2-600-linear", "mm-tonne-s")


@pytest.fixture
def gradients():
    """`gradients(n)`: so many deformation gradients (n, 3, 3), all different: stretched, pressed and turned."""

    def make(n: int, dtype=np.float64, size: float = 0.03) -> np.ndarray:
        return (np.eye(3) + size * np.random.default_rng(7).uniform(-1, 1, (n, 3, 3))).astype(dtype)

    return make
