"""A block of yarn under a plate that is pressed into it, implicit and in finite strain, in FEniCSx: `mpirun -n 2 python3 press.py`.

P and dP/dF come from the package at the quadrature points of each process. The fibre is crimped: it has a direction at every point.
Prints the residuals of Newton's method over the reaction forces, a line an increment, and then quantities of the answer. Units: mm, N,
MPa. For dolfinx 0.5.
"""

import basix
import numpy as np
import toron
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

LENGTH, DEPTH, INCREMENTS = 2.0, 0.15, 5
#: What the block is stretched by along the yarn and pressed by across it before the plate comes, so that no fibre is slack and no
#: section grows: there the law has kinks.
STRETCH, PRESSED = 0.01, 0.05
DEGREE = 2
#: What rounding leaves of a residual.
ROUNDING = 1e-12


def quadrature_space(domain: mesh.Mesh, numbers: int) -> fem.FunctionSpace:
    """So many numbers at every quadrature point."""
    cell = domain.ufl_cell()
    return fem.FunctionSpace(domain, ufl.VectorElement("Quadrature", cell, DEGREE, dim=numbers, quad_scheme="default"))


class Points:
    """The law at the quadrature points of this process, ghosts included."""

    def __init__(self, law: toron.Hyperelastic, domain: mesh.Mesh, u: fem.Function):
        self.law = law
        points, _ = basix.make_quadrature(basix.CellType.hexahedron, DEGREE)
        cells = domain.topology.index_map(3)
        self.cells = np.arange(cells.size_local + cells.num_ghosts, dtype=np.int32)
        self.gradient = fem.Expression(ufl.Identity(3) + ufl.grad(u), points)
        self.P, self.A, self.energy = (fem.Function(quadrature_space(domain, numbers)) for numbers in (9, 81, 4))
        x = fem.Expression(ufl.SpatialCoordinate(domain), points).eval(self.cells).reshape(-1, 3)
        slope = 0.2 * np.cos(np.pi * x[:, 0] / LENGTH)
        self.fibre = np.column_stack([np.ones(len(x)), slope, np.zeros(len(x))])

    def update(self) -> None:
        F = self.gradient.eval(self.cells).reshape(-1, 3, 3)
        found = self.law.evaluate(F, outputs=("stress", "tangent", "energies"), tangent="nominal", fibre=self.fibre)
        self._set(self.P, toron.first_piola_kirchhoff(F, found["stress"]))
        self._set(self.A, found["tangent"])
        self._set(self.energy, found["energies"])

    @staticmethod
    def _set(function: fem.Function, values: np.ndarray) -> None:
        dofs = function.function_space.dofmap.list.array
        function.x.array.reshape(-1, function.function_space.dofmap.bs)[dofs] = values.reshape(len(dofs), -1)


def conditions(domain: mesh.Mesh, V: fem.FunctionSpace, plate: fem.Function) -> list:
    """The ends are pulled, the sides press, the ground is smooth, and so is the plate above."""

    def on(axis, where):
        return mesh.locate_entities_boundary(domain, 2, lambda x: np.isclose(x[axis], where))

    def held(axis, where, value):
        space = V.sub(axis)
        return fem.dirichletbc(PETSc.ScalarType(value), fem.locate_dofs_topological(space, 2, on(axis, where)), space)

    space = V.sub(1)
    above = fem.locate_dofs_topological((space, plate.function_space), 2, on(1, 1.0))
    sides = [held(1, 0.0, 0.0), held(2, 0.0, 0.0), held(2, 1.0, -PRESSED)]
    ends = [held(0, 0.0, 0.0), held(0, LENGTH, STRETCH * LENGTH)]
    return [fem.dirichletbc(plate, above, space), *sides, *ends]


def main() -> None:
    domain = mesh.create_box(
        MPI.COMM_WORLD, [np.zeros(3), np.array([LENGTH, 1.0, 1.0])], [12, 6, 6], mesh.CellType.hexahedron
    )
    V = fem.VectorFunctionSpace(domain, ("Lagrange", 1))
    u, v, du = fem.Function(V), ufl.TestFunction(V), ufl.TrialFunction(V)
    law = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s", k_ld=100.0, eps_lim=0.0)
    points = Points(law, domain, u)
    dx = ufl.Measure("dx", domain=domain, metadata={"quadrature_degree": DEGREE, "quadrature_scheme": "default"})
    i, J, k, L = ufl.indices(4)
    P = ufl.as_tensor(np.array(ufl.split(points.P)).reshape(3, 3).tolist())
    A = ufl.as_tensor(np.array(ufl.split(points.A)).reshape(3, 3, 3, 3).tolist())
    residual = fem.form(P[i, J] * ufl.grad(v)[i, J] * dx)
    tangent = fem.form(A[i, J, k, L] * ufl.grad(du)[k, L] * ufl.grad(v)[i, J] * dx)
    energy = fem.form(sum(ufl.split(points.energy)) * dx)
    collapsed, _ = V.sub(1).collapse()
    plate = fem.Function(collapsed)
    bcs = conditions(domain, V, plate)
    solver = PETSc.KSP().create(domain.comm)
    solver.setType("preonly")
    solver.getPC().setType("lu")
    solver.getPC().setFactorSolverType("mumps")
    step = u.vector.duplicate()
    u.interpolate(lambda x: np.array([STRETCH * x[0], -PRESSED * x[1], -PRESSED * x[2]]))
    first = domain.comm.rank == 0
    for increment in range(1, INCREMENTS + 1):
        depth = DEPTH * increment / INCREMENTS
        plate.interpolate(lambda x: -PRESSED - depth * np.sin(np.pi * x[0] / LENGTH) ** 2)
        norms = []
        for _ in range(15):
            points.update()
            b = fem.petsc.assemble_vector(residual)
            reactions = fem.petsc.assemble_vector(residual)
            reactions.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
            fem.petsc.apply_lifting(b, [tangent], [bcs], [u.vector], -1.0)
            b.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
            fem.petsc.set_bc(b, bcs, u.vector, -1.0)
            norms.append(b.norm() / (reactions.norm() or 1.0))
            if len(norms) > 1 and norms[-1] < ROUNDING:
                break
            K = fem.petsc.assemble_matrix(tangent, bcs)
            K.assemble()
            solver.setOperators(K)
            solver.solve(b, step)
            u.vector.axpy(-1.0, step)
            u.x.scatter_forward()
        if first:
            print("residuals", *(f"{norm:.3e}" for norm in norms[1:]))
    total = domain.comm.allreduce(fem.assemble_scalar(energy), MPI.SUM)
    squares = domain.comm.allreduce(fem.assemble_scalar(fem.form(ufl.inner(u, u) * dx)), MPI.SUM)
    cells = domain.comm.allreduce(domain.topology.index_map(3).size_local, MPI.SUM)
    if first:
        print("processes", domain.comm.size, "cells", cells)
        print(f"answer {total:.15e} {squares:.15e} {reactions.norm():.15e}")


main()
