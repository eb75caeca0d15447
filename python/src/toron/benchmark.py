"""What a call from Python takes beside the same call from C."""

import ctypes
import subprocess
import tempfile
from pathlib import Path
from shutil import which
from time import perf_counter
from typing import Any

import numpy as np

from toron._library import ffi
from toron.call import Call
from toron.hyperelastic import Hyperelastic

#: Points in a call; calls in a round, so few that some rounds are not interrupted by another program; rounds.
_SIZES = ((1, 200, 300), (1000, 20, 200), (1_000_000, 1, 15))


class _Loop:
    """A loop of C around a call, compiled on the spot if there is a compiler."""

    def __init__(self, folder: Path) -> None:
        compiler = which("cc") or which("gcc") or which("clang")
        self.compiled = compiler is not None
        if compiler:
            source, library = Path(__file__).with_name("benchmark_loop.c"), folder / "loop.so"
            subprocess.run([compiler, "-O2", "-shared", "-fPIC", "-o", library, source], check=True)
            self._mean_time = ctypes.CDLL(str(library)).mean_time
            self._mean_time.restype = ctypes.c_double

    def time(self, call: Call, calls: int) -> float:
        """The mean time of so many calls, in seconds."""
        pointers = (ctypes.c_void_p(int(ffi.cast("uintptr_t", pointer))) for pointer in call.pointers())
        return self._mean_time(*pointers, calls)


def _mean(function: Any, calls: int) -> float:
    start = perf_counter()
    for _ in range(calls):
        function()
    return (perf_counter() - start) / calls


def bench() -> dict[int, dict[str, float | None]]:
    """Prints and returns the microseconds of a call of the hyperelastic law: F, state in place, stress; n = 1, 10³ and 10⁶ points.

    Arrays are (…, n), float64, given as `out` and `state`. The columns: `evaluate` with the same arrays in every call; a call that has
    been bound; the same call on the same arrays in a loop of C (None without a C compiler). The least of many rounds, which
    take turns.
    """
    yarn = Hyperelastic.from_preset("kevlar-km2-600", "mm-tonne-s")
    table: dict[int, dict[str, float | None]] = {}
    print(f"{'n':>8} {'evaluate':>12} {'bound':>12} {'C':>12}   microseconds a call")
    with tempfile.TemporaryDirectory() as folder:
        loop = _Loop(Path(folder))
        for n, calls, rounds in _SIZES:
            F = np.zeros((3, 3, n))
            F[0, 0], F[1, 1], F[2, 2] = 1.0 + np.linspace(0, 0.02, n), 1.0, 0.9
            state, out = yarn.new_state(n, layout="last"), {"stress": np.empty((6, n))}
            bound = yarn.bind(F, out=out, state=state, points="last")
            evaluate = lambda: yarn.evaluate(F, out=out, state=state, points="last")  # noqa: E731
            times: dict[str, list[float]] = {"evaluate": [], "bound": [], "C": []}
            for _ in range(rounds):
                times["evaluate"].append(_mean(evaluate, calls))
                times["bound"].append(_mean(bound, calls))
                if loop.compiled:
                    times["C"].append(loop.time(bound, calls))
            table[n] = {name: 1e6 * min(values) if values else None for name, values in times.items()}
            print(f"{n:>8}", *("no compiler".rjust(12) if t is None else f"{t:12.2f}" for t in table[n].values()))
    return table
