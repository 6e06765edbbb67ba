"""A store made by local workers, beside the file that `spiral-atlas generate` makes of the same recipe.

    python benches/cluster.py PROGRAM [COUNT ..]

PROGRAM is the built `spiral-atlas`; the Python needs the package with its extra `cluster`. Of each COUNT of nodes along
four axes, without scalars and with two of them, it prints for one and two workers or threads: seconds from start to end
and processor time; of a store also the seconds until the workers are there, those of their work, and the most memory
of a worker.
"""

import os
import re
import resource
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


def spent() -> float:
    """Processor seconds of this process and of its children that have ended."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def program(recipe: Path, threads: int, folder: Path) -> str:
    began, before = time.perf_counter(), spent()
    command = [sys.argv[1], "generate", recipe, "--backend", "cpu", "--threads", str(threads), "--out", folder]
    subprocess.run(command, check=True, capture_output=True)
    return f"file,  {threads} threads: {time.perf_counter() - began:6.2f} s, {spent() - before:6.2f} s of processors"


def family() -> list[psutil.Process]:
    """Processes of this one: workers are copies of one that is its child."""
    return psutil.Process().children(recursive=True)


def store(recipe: Path, workers: int, folder: Path) -> str:
    began, times, memory, cpu = time.perf_counter(), [], [], []
    before = spent()

    def heard(summary):
        times.append(time.perf_counter() - began)
        if len(summary.shards) in (0, summary.store.shard_count):
            cpu.append(spent() - before + sum(sum(child.cpu_times()[:2]) for child in family()))
            for child in family():
                peak = re.search(r"VmHWM:\s+(\d+)", Path(f"/proc/{child.pid}/status").read_text())
                if peak and child.ppid() != os.getpid():
                    memory.append(int(peak[1]) / 1024)

    # The process that workers are copied from outlives a run, and its time would be counted again.
    forked = sum(sum(child.cpu_times()[:2]) for child in family())
    done = generate(recipe, folder / "bench.zarr", workers=workers, progress=heard)
    wall = time.perf_counter() - began
    return (
        f"store, {workers} workers: {wall:6.2f} s, {cpu[-1] - forked:6.2f} s of processors; {times[0]:.2f} s to start, "
        f"{times[-1] - times[0]:.2f} s and {cpu[-1] - cpu[0]:.2f} s of processors for the shards; "
        f"{max(memory):.0f} MiB a worker, {done.store.shard_count} shards of {done.store.shards}"
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
