"""Laws of dry fabrics under ballistic impact on NumPy arrays: del Sorbo's hyperelastic yarn and its linear elastic baseline.

    import numpy as np, toron
    yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s")
    yarn.stress(np.diag([1.02, 1.0, 0.8]))     # MPa, 11 22 33 12 23 31

Everything is computed by the shared library that the package carries. Calls release the interpreter's lock.
"""

from toron._library import lib, text
from toron.benchmark import bench
from toron.call import Call
from toron.errors import ArgumentError, Error, PointError, PropertyError, status_message
from toron.hyperelastic import Frictional, Hyperelastic
from toron.law import Law
from toron.linear_elastic import LinearElastic
from toron.measures import first_piola_kirchhoff, matrix, second_piola_kirchhoff
from toron.tables import Row

__version__: str = text(lib.toron_version())

__all__ = [
    "ArgumentError",
    "Call",
    "Error",
    "Frictional",
    "Hyperelastic",
    "Law",
    "LinearElastic",
    "PointError",
    "PropertyError",
    "Row",
    "bench",
    "first_piola_kirchhoff",
    "matrix",
    "second_piola_kirchhoff",
    "status_message",
]
