"""The yarn law as a material of felupe, on felupe's own arrays (3, 3, quadrature points, cells)."""

import felupe
import toron


def material(yarn: toron.Hyperelastic) -> felupe.Material:
    """The law without failure, so that there is no state to keep."""

    def stress(x):
        sigma = yarn.stress(x[0], points="last")
        return [toron.first_piola_kirchhoff(x[0], sigma, points="last"), x[-1]]

    def elasticity(x):
        return [yarn.tangent(x[0], "nominal", points="last")]

    return felupe.Material(stress, elasticity)
