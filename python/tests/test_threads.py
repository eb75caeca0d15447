"""Calls release the interpreter's lock, and a law may be used by several threads."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import toron


def test_the_lock_is_released(yarn):
    n = 2_000_000
    F = np.zeros((3, 3, n))
    F[0, 0] = F[1, 1] = F[2, 2] = 1.01
    out, running, ticks = {"stress": np.empty((6, n))}, threading.Event(), []
    yarn.evaluate(F, out=out, points="last")
    finished: list[float] = []

    def work():
        running.set()
        start = time.perf_counter()
        yarn.evaluate(F, out=out, points="last")
        finished.extend((start, time.perf_counter()))

    thread = threading.Thread(target=work)
    thread.start()
    running.wait()
    while thread.is_alive():
        ticks.append(time.perf_counter())
        time.sleep(1e-4)
    start, end = finished
    middle = [t for t in ticks if start + 0.2 * (end - start) < t < start + 0.8 * (end - start)]
    assert len(middle) >= 3, f"{len(middle)} of {len(ticks)} within a call of {end - start} s"


def test_threads_share_a_law(gradients):
    yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", "si")
    F = gradients(64)
    expected = yarn.stress(F)
    F[5] = 0

    def work(k: int) -> None:
        own, out = (F if k % 2 else gradients(64)), {"stress": np.empty((64, 6))}
        for _ in range(300):
            try:
                yarn.evaluate(own, out=out)
                assert k % 2 == 0
            except toron.PointError as error:
                assert k % 2 == 1 and "point 5" in str(error)
        if k % 2 == 0:
            np.testing.assert_array_equal(out["stress"], expected)

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(work, range(8)))
