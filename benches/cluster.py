"""A store made by local workers, beside the file that `spiral-atlas generate` makes of the same recipe.

    python benches/cluster.py PROGRAM [COUNT ..]

PROGRAM is the built `spiral-atlas`; the Python needs the package with its extra `cluster`. Of each COUNT of nodes along
four axes, without scalars and with two of them, it prints for one and two workers or threads: wall seconds from start to
end, seconds until the workers are there, seconds and processor time of their work, and the most memory of a worker.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
from spiral_atlas.cluster import generate

AXES = """
[[atlas]]
name = "bench"
[atlas.axes]
phi0 = {{ linear = [0.1, 1.2], count = {0} }}
phi1 = {{ linear = [0.2, 1.5], count = {0} }}
kappa0 = {{ linear = [0.02, 1.0], count = {0} }}
kappa1 = {{ log = [1.0, 100.0], count = {0} }}
"""


def program(recipe: Path, threads: int, folder: Path) -> str:
    began = time.perf_counter()
    command = [sys.argv[1], "generate", recipe, "--backend", "cpu", "--threads", str(threads), "--out", folder]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    wall, work = time.perf_counter() - began, re.search(r"in ([0-9.]+) s", told)
    return f"file,  {threads} threads: {wall:6.2f} s, work {work and work[1]} s"


def store(recipe: Path, workers: int, folder: Path) -> str:
    began, started, memory, cpu = time.perf_counter(), [], [], []

    def heard(summary):
        if not summary.shards:
            started.append(time.perf_counter())
        if len(summary.shards) == summary.store.shard_count:
            for child in psutil.Process().children(recursive=True):
                peak = re.search(r"VmHWM:\s+(\d+)", Path(f"/proc/{child.pid}/status").read_text())
                if peak and "spawn_main" in " ".join(child.cmdline()):
                    memory.append(int(peak[1]) / 1024)
                    cpu.append(sum(child.cpu_times()[:2]))

    done = generate(recipe, folder / "bench.zarr", workers=workers, progress=heard)
    wall = time.perf_counter() - began
    work = done.seconds - (started[0] - began)
    return (
        f"store, {workers} workers: {wall:6.2f} s, work {work:.2f} s; {started[0] - began:.2f} s to start, {sum(cpu):.2f} s of "
        f"processors, {max(memory):.0f} MiB a worker, {done.store.shard_count} shards of {done.store.shards}"
    )


def main() -> None:
    for count in map(int, sys.argv[2:] or ["64", "128"]):
        for fields in ("[]", '["f0", "f1"]'):
            print(f"{count}^4, fields {fields}, load {os.getloadavg()[0]:.1f}")
            for ways in (1, 2, 1, 2):
                for make in (program, store):
                    folder = Path(tempfile.mkdtemp())
                    (folder / "bench.toml").write_text(f'family = "cubic"\nfields = {fields}\n' + AXES.format(count))
                    print("  " + make(folder / "bench.toml", ways, folder), flush=True)
                    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
