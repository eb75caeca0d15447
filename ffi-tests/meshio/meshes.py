"""What meshio reads in mesh files: of each, its points, hexahedra, volume and the sets of nodes, and where it is."""

import sys

import meshio
import numpy as np

for path in sys.argv[1:]:
    mesh = meshio.read(path)
    hexahedra = np.concatenate([block.data for block in mesh.cells if block.type == "hexahedron"])
    assert {block.type for block in mesh.cells} == {"hexahedron"}, mesh
    points = mesh.points.astype(float)
    corners = points[hexahedra]
    # Six tetrahedra about a diagonal, whatever way round the file's nodes go.
    parts = [(1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)]
    edges = corners - corners[:, :1]
    volume = sum(np.einsum("ij,ij->i", np.cross(edges[:, a], edges[:, b]), edges[:, 6]) for a, b in parts) / 6
    assert (volume > 0).all(), path
    sets = " ".join(f"{name}:{len(nodes)}" for name, nodes in sorted(mesh.point_sets.items()))
    print(len(points), len(hexahedra), f"{volume.sum():.9e}", *(f"{x:.9e}" for x in points.mean(axis=0)), sets)
