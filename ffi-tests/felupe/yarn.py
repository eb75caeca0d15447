"""A yarn segment with clamped ends, pressed by a rigid plate: an eighth of it, by symmetry. Newton's residuals, a line an
increment."""

import felupe
import numpy as np
import toron
from toron_material import material

HALF_LENGTH, HALF_WIDTH, HALF_HEIGHT = 0.3, 0.5337 / 2, 0.115 / 2


def section(n):
    """Nodes (y, z) and quadrilaterals of a quarter of the unit disc: a square in the middle and a ring around it."""
    core = [np.array([u, v]) * (0.5 - 0.03 * (u * u + v * v)) for v in np.linspace(0, 1, n + 1) for u in np.linspace(0, 1, n + 1)]
    index = lambda i, j: i + (n + 1) * j
    quads = [[index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)] for j in range(n) for i in range(n)]
    inside = [index(n, j) for j in range(n + 1)] + [index(i, n) for i in reversed(range(n))]
    nodes, previous = list(core), inside
    rim = [np.array([np.cos(a), np.sin(a)]) for a in np.linspace(0, np.pi / 2, 2 * n + 1)]
    for r in range(1, n + 1):
        ring = [len(nodes) + q for q in range(2 * n + 1)]
        nodes += [core[c] + (point - core[c]) * r / n for c, point in zip(inside, rim)]
        quads += [[previous[q], ring[q], ring[q + 1], previous[q + 1]] for q in range(2 * n)]
        previous = ring
    return np.array(nodes) * [HALF_WIDTH, HALF_HEIGHT], np.array(quads), np.array(previous)


def segment(n, layers):
    """The section drawn out along x, and the nodes of its skin."""
    flat, quads, rim = section(n)
    x = np.linspace(0, HALF_LENGTH, layers + 1)
    points = np.vstack([np.column_stack([np.full(len(flat), x), flat]) for x in x])
    cells = np.vstack([np.hstack([quads + len(flat) * k, quads + len(flat) * (k + 1)]) for k in range(layers)])
    skin = np.concatenate([rim + len(flat) * k for k in range(layers + 1)])
    plate = [[HALF_LENGTH, 0.0, HALF_HEIGHT]]  # a point of the plate, which lies on the yarn
    return felupe.Mesh(np.vstack([points, plate]), cells, "hexahedron"), skin, len(points)


def main():
    mesh, skin, plate = segment(n=3, layers=6)
    field = felupe.FieldContainer([felupe.Field(felupe.RegionHexahedron(mesh), dim=3)])
    # N, mm, MPa, fibre along x, with some longitudinal shear stiffness: without it the ends would hold nothing.
    yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s", k_ld=100.0)
    solid = felupe.SolidBody(material(yarn), field)
    # The plate covers the half of the segment that is far from the clamp.
    under = skin[mesh.points[skin, 0] > 0.5 * HALF_LENGTH]
    contact = felupe.ContactRigidPlane(field, points=under, centerpoint=plate, normal=[0, 0, -1], multiplier=1e3)
    bounds = felupe.BoundaryDict(
        clamp=felupe.Boundary(field[0], fx=0.0),
        middle=felupe.Boundary(field[0], fx=HALF_LENGTH, skip=(0, 1, 1)),
        y=felupe.Boundary(field[0], fy=0.0, skip=(1, 0, 1)),
        z=felupe.Boundary(field[0], fz=0.0, skip=(1, 1, 0)),
        move=felupe.Boundary(field[0], mask=np.arange(mesh.npoints) == plate, skip=(1, 1, 0)),
    )
    dof0, dof1 = felupe.dof.partition(field, bounds)
    current = field
    for depth in np.linspace(0, 0.3 * HALF_HEIGHT, 7)[1:]:
        bounds["move"].value = -depth
        ext0 = felupe.dof.apply(field, bounds, dof0)
        result = felupe.newtonraphson(
            current, items=[solid, contact], dof0=dof0, dof1=dof1, ext0=ext0, tol=1e-11, maxiter=30, verbose=0
        )
        current = result.x
        print(f"{depth:.6f}", *(f"{norm:.3e}" for norm in result.fnorms))


main()
