"""A rigid cylinder pressed across a block of yarn, with contact, implicit and in finite strain, in fedoo.

Prints the residuals of Newton's method over the external forces, a line an increment, and then the force on the cylinder and that on
the ground. Units: mm, N, MPa.
"""

import fedoo
import numpy as np
import toron
from fedoo.core.mechanical3d import Mechanical3D
from fedoo.util.voigt_tensors import StressTensorList

#: fedoo's order of components, 11 22 33 12 13 23, in that of the library.
ORDER = [0, 1, 2, 3, 5, 4]
LENGTH, RADIUS, DEPTH, INCREMENTS = 2.0, 1.0, 0.2, 20
#: What the block is stretched by along the yarn and pressed by across it meanwhile.
STRETCH, PRESSED = 0.01, 0.05
#: Force by depth at a node.
PENALTY = 1e3


class Yarn(Mechanical3D):
    """Cauchy stress and Truesdell's modulus of it at fedoo's integration points; no failure, so that there is no state to keep."""

    def __init__(self, law: toron.Hyperelastic):
        super().__init__(name="yarn")
        self.law = law

    def initialize(self, assembly, problem):
        self.is_initialized = True
        self._evaluate(assembly, np.broadcast_to(np.eye(3)[:, :, None], (3, 3, assembly.n_gauss_points)))

    def update(self, assembly, problem):
        self._evaluate(assembly, assembly.sv["F"])

    def _evaluate(self, assembly, F):
        found = self.law.evaluate(F, outputs=("stress", "tangent"), tangent="truesdell", points="last")
        assembly.sv["Stress"] = StressTensorList(np.asfortranarray(found["stress"][ORDER]))
        assembly.sv["TangentMatrix"] = np.asfortranarray(found["tangent"][np.ix_(ORDER, ORDER)])


class Newton(fedoo.problem.NonLinear):
    """fedoo's solver, which also keeps the residuals of an increment."""

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        self.residuals = []

    def compute_nr_error(self):
        self.residuals.append(super().compute_nr_error())
        return self.residuals[-1]


def cylinder(parts: int = 24) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of its lower surface, which touches the block in the middle and looks at it."""
    angles = np.linspace(-0.7, 0.7, parts + 1)
    points = [[LENGTH / 2 + RADIUS * np.sin(a), 1 + RADIUS - RADIUS * np.cos(a), z] for a in angles for z in (-0.2, 1.2)]
    triangles = [t for k in range(0, 2 * parts, 2) for t in ([k, k + 2, k + 1], [k + 1, k + 2, k + 3])]
    points, triangles = np.array(points), np.array(triangles)
    a, b, c = points[triangles[parts]]
    return points, triangles if np.cross(b - a, c - a)[1] < 0 else triangles[:, ::-1]


def main() -> None:
    fedoo.ModelingSpace("3D")
    block = fedoo.mesh.box_mesh(
        nx=13, ny=5, nz=5, x_min=0, x_max=LENGTH, y_min=0, y_max=1, z_min=0, z_max=1, elm_type="hex8"
    )
    points, triangles = cylinder()
    nodes = np.vstack([block.nodes, points])
    mesh = fedoo.Mesh(nodes, block.elements, "hex8", name="yarn")
    surface = fedoo.Mesh(nodes, triangles + block.n_nodes, "tri3", name="cylinder")
    law = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s", k_ld=100.0, eps_lim=0.0)
    # The tangent is that of the updated Lagrangian formulation already; the stiffness of the stress comes with it.
    equilibrium = fedoo.weakform.StressEquilibrium(Yarn(law), convert_tangent=False, nlgeom="UL")
    equilibrium.geometric_stiffness = True

    def on(axis, where):
        return np.flatnonzero(np.isclose(block.nodes[:, axis], where))

    contact = fedoo.constraint.Contact(on(1, 1.0), surface, search_algorithm="search_nearest")
    contact.eps_n, contact.max_dist = PENALTY, 1.5
    problem = Newton(fedoo.Assembly.sum(fedoo.Assembly.create(equilibrium, mesh), contact), nlgeom="UL")
    rigid, ground = np.arange(block.n_nodes, len(nodes)), on(1, 0.0)
    for where, component, value in (
        (on(0, 0.0), "DispX", 0.0),
        (on(0, LENGTH), "DispX", STRETCH * LENGTH),
        (ground, "DispY", 0.0),
        (on(2, 0.0), "DispZ", 0.0),
        (on(2, 1.0), "DispZ", -PRESSED),
        (rigid, "DispX", 0.0),
        (rigid, "DispY", -DEPTH),
        (rigid, "DispZ", 0.0),
    ):
        problem.bc.add("Dirichlet", where, component, value)
    problem.set_nr_criterion("Force", tol=1e-10, max_subiter=15)

    def report(problem):
        print("residuals", *(f"{residual:.3e}" for residual in problem.residuals))
        problem.residuals.clear()

    problem.nlsolve(dt=1 / INCREMENTS, tmax=1, update_dt=False, print_info=0, callback=report)
    forces = problem.get_ext_forces("Disp")
    print(f"forces {forces[1, rigid].sum():.12e} {forces[1, ground].sum():.12e}")


main()
