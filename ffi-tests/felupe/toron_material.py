"""The yarn law as a material of felupe: the library's block entry through ctypes, on felupe's own arrays.

felupe's arrays are (3, 3, quadrature points, cells), and the library takes a pointer to each component of F: nothing is copied on
the way in, nor the tangent on the way out.
"""

import ctypes

import felupe
import numpy as np

NOMINAL = 3
_pointer, _size = ctypes.c_void_p, ctypes.c_size_t


class Law(ctypes.Structure):
    """`toron_hyperelastic_f64` of toron.h."""

    _fields_ = [("tag", ctypes.c_uint64), ("size", ctypes.c_uint64), ("values", ctypes.c_double * 62)]


class Layout(ctypes.Structure):
    """`toron_layout` of toron.h."""

    _fields_ = [("leading_dimension", _size), ("stride", _size)]


class Block(ctypes.Structure):
    """`toron_block_f64` of toron.h."""

    _fields_ = (
        [(name, _size) for name in "size n leading_dimension".split()]
        + [("measure", ctypes.c_int32), ("level", ctypes.c_int32), ("density", ctypes.c_double)]
        + [("deformation_gradient", _pointer * 9), ("fibre", _pointer * 3)]
        + [(name, _pointer) for name in "energies_old invariants_old failure_old".split()]
        + [("stress", _pointer * 6)]
        + [(name, _pointer) for name in "energies invariants failure modes tangent wave_speed active status".split()]
        + [(f"{name}_layout", Layout) for name in "deformation_gradient fibre state stress modes tangent".split()]
    )


class Yarn:
    """Properties in the order of the library's table; no failure, so that there is no state to keep."""

    def __init__(self, library, properties):
        self.library, self.law = ctypes.CDLL(library), Law()
        self.message = ctypes.create_string_buffer(512)
        properties = np.array(properties, dtype=float)
        self._check(
            self.library.toron_hyperelastic_prepare_f64(
                ctypes.byref(self.law), _size(ctypes.sizeof(Law)), _pointer(properties.ctypes.data), _size(properties.size), *self._room()
            )
        )
        self.material = felupe.Material(self._stress, self._elasticity)

    def _room(self):
        return self.message, _size(len(self.message))

    def _check(self, status):
        if status != 0:
            raise ValueError(f"toron: {self.message.value.decode()} (status {status})")

    def _call(self, f, **outputs):
        columns = [f[i, j] for j in range(3) for i in range(3)]
        assert all(x.flags.c_contiguous and x.dtype == np.float64 for x in [*columns, *outputs.values()])
        block = Block(size=ctypes.sizeof(Block), n=f[0, 0].size, measure=NOMINAL)
        block.deformation_gradient[:] = [x.ctypes.data for x in columns]
        for name, array in outputs.items():
            setattr(block, name, array.ctypes.data)
        self._check(self.library.toron_hyperelastic_block_f64(ctypes.byref(self.law), ctypes.byref(block), *self._room()))

    def _stress(self, x):
        """P = F S, S being the sum over the modes, 11 22 33 12 23 31."""
        f = x[0]
        modes = np.empty((4, 6, *f.shape[2:]))
        self._call(f, modes=modes)
        s = modes.sum(axis=0)[[0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(f.shape)
        return [np.einsum("iK...,KJ...->iJ...", f, s), x[-1]]

    def _elasticity(self, x):
        """dP_iJ/dF_kL; the library's rows are i + 3 J, its columns k + 3 L."""
        f = x[0]
        tangent = np.empty((3, 3, 3, 3, *f.shape[2:]))
        self._call(f, tangent=tangent)
        return [tangent.transpose(1, 0, 3, 2, 4, 5)]
