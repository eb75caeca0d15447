"""A yarn under impact in Akantu, with the law as a material in Python: `impact.py none|multiaxial LAYERS ROWS COLUMNS STEP`.

The scene is that of `toron impact` without friction and viscosity: half a yarn, clamped at its end and symmetric about mid-span, and a
rigid cylinder across it as penalty forces on the nodes. Akantu's hexahedra have eight integration points. Prints lines of a name and
numbers. Units: mm, g, ms, so that stresses are MPa and speeds m/s.
"""

import os
import sys
import tempfile

import akantu
import numpy as np
import toron
from mesh import yarn as yarn_mesh

LENGTH, HEIGHT, WIDTH = 12.7, 0.115, 0.5337
MASS, RADIUS, STIFFNESS, SPEED = 9.91e-3, 1.1, 1e6, 120.0
#: Times at which the projectile's speed is printed; the run ends at the last.
TIMES = (0.01, 0.02, 0.03)
#: Half of the strain behind the wave of elongation.
THRESHOLD = 0.0023
HEXAHEDRON = akantu._hexahedron_8


class Yarn(akantu.Material):
    """Fills the second Piola-Kirchhoff stress of all integration points from their displacement gradients.

    An element whose latch is set at one point carries nothing from then on at any.
    """

    law: toron.Hyperelastic

    def initMaterial(self):
        super().initMaterial()
        self._step = None

    def _bind(self, points: int) -> None:
        # Component by component, as the library is fastest.
        self.F, self.modes = np.empty((3, 3, points)), np.empty((4, 6, points))
        self.status, self.state = np.empty(points, np.int32), self.law.new_state(points, layout="last")
        out = {"modes": self.modes, "status": self.status}
        self._step = self.law.bind(self.F, out=out, state=self.state, points="last")
        self.latch = self.state[self.law.state_index("failed")].reshape(-1, 8)

    def computeStress(self, element_type, ghost_type):
        gradient = self.getGradU(element_type, ghost_type)
        if self._step is None:
            self._bind(len(gradient))
        # Akantu's matrices are column-major.
        np.add(gradient.T.reshape(3, 3, -1).swapaxes(0, 1), np.eye(3)[:, :, None], out=self.F)
        self._step()
        second = toron.matrix(toron.second_piola_kirchhoff(self.modes, points="last"), points="last")
        self.getInternalReal("piola_kirchhoff_2")(element_type, ghost_type)[...] = second.reshape(9, -1).T
        self.latch[self.latch.any(axis=1)] = 1


def model_of(nodes: np.ndarray, hexahedra: np.ndarray, density: float, step: float) -> tuple[akantu.Mesh, akantu.SolidMechanicsModel]:
    """The yarn, symmetric about mid-span and clamped at its end. The mesh must live as long as the model."""
    akantu.MaterialFactory.getInstance().registerAllocator("yarn", lambda dim, option, model, name: Yarn(model, name))
    with tempfile.NamedTemporaryFile("w", suffix=".dat") as file:
        file.write(f"material yarn [\n name = yarn\n rho = {density!r}\n finite_deformation = true\n]\n")
        file.flush()
        akantu.parseInput(file.name)
    mesh = akantu.Mesh(3)
    access = akantu.MeshAccessor(mesh)
    access.resizeNodes(len(nodes))
    mesh.getNodes()[...] = nodes
    mesh.addConnectivityType(HEXAHEDRON)
    access.resizeConnectivity(len(hexahedra), HEXAHEDRON)
    mesh.getConnectivity(HEXAHEDRON)[...] = hexahedra
    access.makeReady()
    model = akantu.SolidMechanicsModel(mesh)
    model.initFull(_analysis_method=akantu._explicit_lumped_mass)
    model.setTimeStep(step)
    blocked = model.getBlockedDOFs()
    blocked[nodes[:, 0] == 0, 0] = True
    blocked[nodes[:, 0] == LENGTH, :] = True
    return mesh, model


class Projectile:
    """A cylinder along axis 2 that moves along axis 1; half of it, as half the yarn."""

    def __init__(self, nodes: np.ndarray, surface: np.ndarray):
        self.met = np.flatnonzero((surface > 0) & (nodes[:, 0] < LENGTH))
        self.reference, self.stiffness = nodes[self.met, :2], STIFFNESS * surface[self.met]
        self.centre, self.velocity, self.force = nodes[:, 1].max() + RADIUS, -SPEED, 0.0

    def forces(self, displacement: np.ndarray) -> np.ndarray:
        """On the nodes that it may meet, (…, 2)."""
        way = self.reference + displacement[self.met, :2] - [0.0, self.centre]
        distance = np.hypot(way[:, 0], way[:, 1])
        depth = np.maximum(RADIUS - distance, 0)
        forces = way * (self.stiffness * depth / distance)[:, None]
        self.force = -forces[:, 1].sum()
        return forces

    def move(self, step: float) -> None:
        """By a step of central differences."""
        self.velocity += step * self.force / (0.5 * MASS)
        self.centre += step * self.velocity


def front(arrivals: list[tuple[float, float]]) -> float:
    """The speed of a wave that reaches places at times, by a straight line between 0.4 and 0.85 of the length."""
    x, t = np.array([(x, t) for x, t in arrivals if 0.4 * LENGTH < x < 0.85 * LENGTH]).T
    return float(np.polyfit(t, x, 1)[0])


def main(failure: str, layers: int, rows: int, columns: int, step: float) -> None:
    limit = {"eps_lim": 0.0} if failure == "none" else {}
    law = Yarn.law = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-g-ms", **limit)
    nodes, hexahedra, surface = yarn_mesh(LENGTH, HEIGHT, WIDTH, layers, rows, columns)
    mesh, model = model_of(nodes, hexahedra, law.density, step)
    material, projectile = model.getMaterial(0), Projectile(nodes, surface)
    displacement, velocity = model.getDisplacement(), model.getVelocity()
    acceleration, external = model.getAcceleration(), model.getExternalForce()
    elongation, arrivals, pending, times = law.state_index("i_el"), [], set(range(layers)), list(TIMES)
    for count in range(1, round(TIMES[-1] / step) + 1):
        # The contact is that at the end of the step, where Akantu's predictor moves the nodes.
        projectile.move(step)
        external[projectile.met, :2] = projectile.forces(displacement + step * velocity + 0.5 * step**2 * acceleration)
        model.solveStep()
        if pending:
            strain = material.state[elongation].reshape(layers, -1).mean(axis=1)
            for layer in [layer for layer in pending if strain[layer] > THRESHOLD]:
                arrivals.append(((layer + 0.5) * LENGTH / layers, count * step))
                pending.discard(layer)
        if (count + 0.5) * step > times[0]:
            print("speed", times.pop(0), -projectile.velocity)
    print("wave", front(arrivals), np.sqrt(law.properties["k_el"] / law.density))
    print_failed(material, model, hexahedra)


def print_failed(material: Yarn, model: akantu.SolidMechanicsModel, hexahedra: np.ndarray) -> None:
    """Failed elements: how many, their largest stress, the nodes that belong to them alone, the largest force there. Then all others'."""
    failed = (material.latch == 1).all(axis=1)
    stress = material.getInternalReal("piola_kirchhoff_2")(HEXAHEDRON, akantu._not_ghost).reshape(len(failed), -1)
    alone, force = np.setdiff1d(hexahedra[failed], hexahedra[~failed]), model.getInternalForce()
    print("failed", failed.sum(), np.abs(stress[failed]).max(initial=0.0), len(alone), np.abs(force[alone]).max(initial=0.0))
    print("intact", (~failed).sum(), np.abs(stress[~failed]).max(), np.abs(force).max())


main(sys.argv[1], *map(int, sys.argv[2:5]), float(sys.argv[5]))
sys.stdout.flush()
# At exit Akantu's interpreter aborts.
os._exit(0)
