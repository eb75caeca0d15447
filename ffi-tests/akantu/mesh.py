"""The yarn's mesh of `toron impact`: an elliptical section by columns and rows, half the yarn by layers.

Axis 0 runs along the yarn from mid-span, axis 1 points at the projectile, axis 2 across.
"""

import numpy as np


def section(height: float, width: float, rows: int, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Points (y, z), and their numbers by column and row; the rows of the outermost columns meet in one point."""
    # Straight sides cut off some of the ellipse: the polygon is enlarged to its area.
    scale = np.sqrt(np.pi / (columns * np.sin(np.pi / columns)))
    points, numbers = [], np.empty((columns + 1, rows + 1), int)
    for column in range(columns + 1):
        angle, tip = np.pi * column / columns, column in (0, columns)
        for row in range(rows + 1):
            if row == 0 or not tip:
                level = 0.0 if tip else 2.0 * row / rows - 1.0
                points.append([0.5 * scale * height * np.sin(angle) * level, -0.5 * scale * width * np.cos(angle)])
            numbers[column, row] = len(points) - 1
    return np.array(points), numbers


def yarn(length: float, height: float, width: float, layers: int, rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nodes (n, 3), hexahedra (m, 8), and the surface that belongs to each node of the outline."""
    flat, numbers = section(height, width, rows, columns)
    nodes = np.array([[length * layer / layers, y, z] for layer in range(layers + 1) for y, z in flat])
    hexahedra, surface = [], np.zeros(len(nodes))
    for layer in range(layers):
        base, next_ = len(flat) * layer, len(flat) * (layer + 1)
        for column in range(columns):
            for row in range(rows):
                corners = [numbers[column, row], numbers[column, row + 1], numbers[column + 1, row + 1], numbers[column + 1, row]]
                hexahedra.append([base + c for c in corners] + [next_ + c for c in corners])
            for row in (0, rows):
                ends = numbers[column : column + 2, row]
                area = length / layers * np.linalg.norm(flat[ends[1]] - flat[ends[0]])
                for start in (base, next_):
                    surface[start + ends] += area / 4
    return nodes, np.array(hexahedra), surface
