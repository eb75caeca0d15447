"""The yarn law as a material of felupe: the library's block entry through ctypes, on felupe's own arrays.

A block is component-major: component c of point i at c n + i, F by columns. felupe's arrays are (3, 3, quadrature points,
cells), F by rows, but it writes F into whatever array it is given: `attach` gives it one whose memory is by columns. Nothing
is copied on the way in, nor the tangent on the way out.
"""

import ctypes

import felupe
import numpy as np

STATE, NOMINAL = 11, 3
_pointer = ctypes.POINTER(ctypes.c_double)


class Block(ctypes.Structure):
    """`toron_block_f64` of toron.h."""

    _fields_ = [("n", ctypes.c_size_t), ("leading_dimension", ctypes.c_size_t)] + [
        (name, ctypes.c_double if name == "density" else _pointer)
        for name in "deformation_gradient fibre energies_old invariants_old failure_old density "
        "stress energies invariants failure modes wave_speed".split()
    ]
    _fields_ += [("status", ctypes.POINTER(ctypes.c_int32)), ("active", _pointer), ("level", ctypes.c_int32)]


def _address(array):
    assert array.flags.c_contiguous and array.dtype == np.float64
    return array.ctypes.data_as(_pointer)


class Yarn:
    """Properties in the order of the library's table; no failure, so that there is no state to keep."""

    def __init__(self, library, properties):
        self.properties = np.array(properties, dtype=float)
        self.entry = ctypes.CDLL(library).toron_hyperelastic_block_tangent_f64
        self.entry.argtypes = [_pointer, ctypes.c_size_t, ctypes.POINTER(Block), ctypes.c_int32, _pointer]
        self.material = felupe.Material(self._stress, self._elasticity)

    def attach(self, solid):
        """From now on felupe writes F of this solid by columns."""
        f = solid.results.kinematics[0]
        by_columns = np.ascontiguousarray(f.swapaxes(0, 1))
        solid.results.kinematics = (by_columns.swapaxes(0, 1),)

    def _call(self, f, **outputs):
        f = f.swapaxes(0, 1)  # the memory is by columns
        n = f[0, 0].size
        tangent = outputs.pop("tangent", None)
        block = Block(n=n, leading_dimension=n, deformation_gradient=_address(f))
        for name, array in outputs.items():
            setattr(block, name, _address(array))
        worst = self.entry(
            _address(self.properties), self.properties.size, block, NOMINAL, tangent if tangent is None else _address(tangent)
        )
        if worst != 0:
            raise ValueError(f"toron: status {worst}")

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
