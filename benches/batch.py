"""What benches/batch.rs times, from Python: a million data at once."""

import time

import numpy as np
import spiral_atlas

ROWS = 1_000_000
STEPS = [0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101]
BOX = {"phi0": [0.1, 1.2], "phi1": [0.2, 1.5], "kappa0": [0.02, 1.0], "kappa1": [1.0, 100.0]}

low, high = np.array(list(BOX.values())).T
data = low + (high - low) * (np.outer(np.arange(ROWS), STEPS) % 1.0)
axes = {name: {"linear": ends, "count": 32} for name, ends in BOX.items()}
(atlas,) = spiral_atlas.generate({"family": "cubic", "atlas": [{"name": "batch", "axes": axes}]})


def best(name, work):
    times = []
    for _ in range(5):
        started = time.perf_counter()
        work()
        times.append(time.perf_counter() - started)
    print(f"{name:44} {min(times) / ROWS * 1e9:12.1f} ns each")


for threads in [1, 2]:
    for what, curves in [("", False), (", curves", True)]:
        name = f"Python: solve_batch{what}, threads: {threads}"
        best(name, lambda t=threads, c=curves: spiral_atlas.solve_batch("cubic", data, threads=t, curves=c))
best("Python: lookup", lambda: atlas.lookup(data))
