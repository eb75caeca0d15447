"""Pictures of the law: stress by mode along three load paths, and the failure surface. `gallery.py [FOLDER]`; needs matplotlib."""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import toron  # noqa: E402

MODES = ("elongation", "compaction", "distortion", "longitudinal shear")


def stresses_by_mode(yarn: toron.Hyperelastic, F: np.ndarray) -> np.ndarray:
    """Cauchy stress of each mode, (n, 4, 3, 3): F S Fᵀ/J of its second Piola-Kirchhoff stress."""
    S = toron.matrix(yarn.evaluate(F, outputs="modes")["modes"])
    J = np.linalg.det(F)[:, None, None, None]
    return F[:, None] @ S @ F.transpose(0, 2, 1)[:, None] / J


def gradients(**entries: np.ndarray) -> np.ndarray:
    """F (n, 3, 3), the unit matrix but for the entries that are given: F22=…"""
    F = np.tile(np.eye(3), (len(next(iter(entries.values()))), 1, 1))
    for name, values in entries.items():
        F[:, int(name[1]) - 1, int(name[2]) - 1] = values
    return F


def plot_modes(yarn: toron.Hyperelastic, figure) -> None:
    t = np.linspace(0, 1, 200)
    paths = [
        ("drawn", "stretch along the fibre", 1 + 0.04 * t, gradients(F11=1 + 0.04 * t), (0, 0), "σ₁₁"),
        ("pressed flat", "height over that at rest", 1 - 0.5 * t, gradients(F33=1 - 0.5 * t), (2, 2), "σ₃₃"),
        ("sheared along the fibre", "slip F₁₃", 0.5 * t, gradients(F13=0.5 * t), (0, 2), "σ₁₃"),
    ]
    for axes, (title, label, x, F, (i, j), name) in zip(figure.subplots(1, 3), paths):
        by_mode = stresses_by_mode(yarn, F)[:, :, i, j]
        for k, mode in enumerate(MODES):
            if np.abs(by_mode[:, k]).max() > 1e-3 * np.abs(by_mode).max():
                axes.plot(x, by_mode[:, k], color=f"C{k}", label=mode)
        axes.plot(x, toron.matrix(yarn.stress(F))[:, i, j], "k--", linewidth=1, label="sum")
        axes.set(title=title, xlabel=label, ylabel=f"{name} in MPa")
        axes.legend(frameon=False)


def failure_strain(yarn: toron.Hyperelastic, side: np.ndarray, height: np.ndarray) -> np.ndarray:
    """The strain along the fibre at which a section of this width and height fails, by bisection of the failure index; NaN: none."""
    low, high = np.zeros(side.shape), np.full(side.shape, 0.2)
    index = lambda strain: yarn.evaluate(section(strain, side, height), outputs="failure")["failure"][..., 0]  # noqa: E731
    fails = index(high) >= 1
    for _ in range(40):
        middle = (low + high) / 2
        below = index(middle) < 1
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.where(fails, high, np.nan)


def section(strain: np.ndarray, side: np.ndarray, height: np.ndarray) -> np.ndarray:
    F = np.zeros((*strain.shape, 3, 3))
    F[..., 0, 0], F[..., 1, 1], F[..., 2, 2] = 1 + strain, side, height
    return F


def plot_failure(yarn: toron.Hyperelastic, figure) -> None:
    axes = figure.subplots()
    side, height = np.meshgrid(np.linspace(0.7, 1.3, 150), np.linspace(0.5, 1.0, 120))
    strain = 100 * failure_strain(yarn, side, height)
    filled = axes.contourf(side, height, strain, levels=20)
    lines = axes.contour(side, height, strain, levels=[1, 2, 3, 4], colors="white", linewidths=0.8)
    axes.clabel(lines, fmt="%g %%")
    figure.colorbar(filled, label="strain along the fibre at failure, %")
    axes.set(title="multiaxial failure", xlabel="width over that at rest", ylabel="height over that at rest")


def main(folder: Path) -> None:
    yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s", k_ld=100.0)
    folder.mkdir(parents=True, exist_ok=True)
    for name, size, plot in (("modes", (12, 3.6), plot_modes), ("failure-surface", (6, 4.4), plot_failure)):
        figure = plt.figure(figsize=size, layout="constrained")
        plot(yarn, figure)
        figure.savefig(folder / f"{name}.png", dpi=120)
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "toron-out"))
