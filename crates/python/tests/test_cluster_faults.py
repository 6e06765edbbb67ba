"""Stores that meet with accidents: real processes are killed, disks are full, files are cut off."""

import contextlib
import json
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import psutil
import pytest
import spiral_atlas
from spiral_atlas.cluster import Store, cli, create, generate, write_shard

COMMAND = [sys.executable, "-m", "spiral_atlas.cluster"]
AXES = "phi0 = { linear = [0.2, 1.2], count = 16 }\nphi1 = { linear = [0.3, 1.4], count = 16 }\n"
AXES += "kappa0 = { linear = [-0.5, 1], count = 16 }\nkappa1 = { log = [1, 100], count = 16 }\n"
SHAPES = {"shards": (8, 8, 4, 4), "chunks": (4, 8, 4, 4)}
OPTIONS = ["--shards", "8,8,4,4", "--chunks", "4,8,4,4"]
SHARDS = 64


@pytest.fixture(scope="module")
def recipe(tmp_path_factory) -> Path:
    """Slow enough that there is a middle of the run: all takes a second or two."""
    path = tmp_path_factory.mktemp("recipes") / "slow.toml"
    path.write_text(f'family = "ph-quintic"\n[[atlas]]\nname = "slow"\n[atlas.axes]\n{AXES}')
    return path


@pytest.fixture(scope="module")
def atlas(recipe) -> spiral_atlas.Atlas:
    return spiral_atlas.generate(recipe)[0]


@pytest.fixture
def place(tmp_path) -> Path:
    return tmp_path / "slow.atlas.zarr"


def run(*arguments, **options) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*COMMAND, *map(str, arguments)], capture_output=True, text=True, timeout=120, **options)


@contextlib.contextmanager
def started(*arguments, command=COMMAND, **options):
    """A process that is dead at the end, with all that it started."""
    with subprocess.Popen([*command, *map(str, arguments)], stderr=subprocess.PIPE, text=True, **options) as process:
        family = []
        try:
            yield process
        finally:
            with contextlib.suppress(psutil.NoSuchProcess):
                parent = psutil.Process(process.pid)
                family = [*parent.children(recursive=True), parent]
            for member in family:
                with contextlib.suppress(psutil.NoSuchProcess):
                    member.kill()


def written(place: Path) -> int:
    return sum(1 for path in (place / "manifest" / "digests" / "c").rglob("*") if path.is_file())


def wait_for(condition, what: str) -> None:
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.002)


def complete(file: Path) -> bool:
    """Whether the file is there with all its text: a scheduler opens its file before it writes into it."""
    return file.exists() and file.read_text().rstrip().endswith("}")


def equal(place: Path, atlas: spiral_atlas.Atlas) -> None:
    store = spiral_atlas.open(place)
    store.check()
    assert np.array_equal(store.flags[...], atlas.flags) and np.array_equal(store.solutions[...], atlas.solutions)
    assert not list(place.rglob("*.partial"))


def workers_of(process: subprocess.Popen) -> list[psutil.Process]:
    # They are copies of one process that has what they import.
    family = psutil.Process(process.pid).children(recursive=True)
    return [child for child in family if child.ppid() != process.pid]


def test_a_killed_worker_is_replaced(recipe, place, atlas):
    with started("generate", recipe, place, *OPTIONS, "--workers", 2, stdout=subprocess.PIPE) as process:
        wait_for(lambda: written(place) > 1, "the first shards")
        workers = workers_of(process)
        assert len(workers) == 2 and written(place) < SHARDS
        workers[0].kill()
        told, complaint = process.communicate(timeout=120)
        assert process.returncode == 0, complaint
        assert f"{SHARDS} shards:" in told
    equal(place, atlas)


def test_a_killed_run_goes_on_where_it_was(recipe, place, atlas):
    with started("generate", recipe, place, *OPTIONS, "--workers", 2, stdout=subprocess.DEVNULL) as process:
        wait_for(lambda: written(place) > 1, "the first shards")
        workers = workers_of(process)
        for worker in workers:
            worker.suspend()
        # The lock is held, so a second run and a job that writes shards are refused.
        for refused in (run("generate", recipe, place), run("shard", place, 0)):
            assert refused.returncode == 2 and "another run works on this store" in refused.stderr
        process.kill()
        process.wait()
        for worker in workers:
            worker.resume()
    # Its workers go with it, and nobody holds the lock.
    gone, alive = psutil.wait_procs(workers, timeout=30)
    assert not alive
    there = written(place)
    assert 1 < there < SHARDS
    with pytest.raises(spiral_atlas.AtlasError, match="shards are missing"):
        spiral_atlas.open(place)
    litter = place / "flags" / "c" / "0" / "0" / "0" / "0.dead.partial"
    litter.write_bytes(b"half")
    again = run("generate", recipe, place, "--workers", 1)
    assert again.returncode == 0, again.stderr
    assert f"{SHARDS - there} written, {there} there and right" in again.stdout
    equal(place, atlas)


def test_a_lost_scheduler_ends_the_run_with_what_is_there(recipe, place, atlas, tmp_path):
    dask = [sys.executable, "-m", "dask"]
    file = tmp_path / "scheduler.json"
    # How long a lost scheduler is sought; half a minute by default.
    env = os.environ | {"DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "10s"}
    options = ["--scheduler-file", file, "--no-dashboard"]
    with started("scheduler", *options, "--port", 0, command=dask) as scheduler:
        with started("worker", *options, "--nworkers", 1, "--nthreads", 1, "--no-nanny", command=dask, cwd=tmp_path):
            wait_for(lambda: complete(file), "the scheduler's file")
            address = json.loads(file.read_text())["address"]
            with started(
                "generate", recipe, place, *OPTIONS, "--scheduler", address, stdout=subprocess.PIPE, env=env
            ) as process:
                wait_for(lambda: written(place) > 1, "the first shards")
                scheduler.kill()
                _, complaint = process.communicate(timeout=120)
                assert process.returncode == 2
                assert "the scheduler was lost" in complaint and "The next run goes on from here" in complaint
    assert written(place) < SHARDS
    assert run("generate", recipe, place).returncode == 0
    equal(place, atlas)


def test_a_full_disk_is_told_and_the_next_run_completes(recipe, place, atlas):
    """A limit on the size of files stands for a disk that is full: both refuse to write on."""
    create(recipe, place, **SHAPES)
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64))  # noqa: E731
    full = run("generate", recipe, place, "--workers", 1, preexec_fn=limit)
    assert full.returncode == 2
    assert "File too large" in full.stderr and f"0 of {SHARDS} shards are done" in full.stderr, full.stderr
    assert not list(place.rglob("*.partial"))
    assert run("generate", recipe, place).returncode == 0
    equal(place, atlas)


def test_a_disk_without_room_is_told(recipe, atlas, tmp_path):
    """A disk in memory, where this user may make one."""
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=96k", "tmpfs", disk], capture_output=True).returncode:
        print("this user may not mount a disk; a limit on files stood for it")
        return
    try:
        full = run("generate", recipe, disk / "slow.atlas.zarr", *OPTIONS, "--workers", 1)
        assert full.returncode == 2 and "No space left on device" in full.stderr, full.stderr
        subprocess.run(["mount", "-o", "remount,size=8m", disk], check=True)
        assert run("generate", recipe, disk / "slow.atlas.zarr", "--workers", 1).returncode == 0
        equal(disk / "slow.atlas.zarr", atlas)
    finally:
        subprocess.run(["umount", disk], check=True)


def test_damage_is_found_and_made_good(recipe, place, atlas):
    generate(recipe, place, **SHAPES, workers=1)
    identity = Store(place).id

    def shard(field, number):
        return place / field / "c" / "/".join(map(str, np.unravel_index(number, (2, 2, 4, 4))))

    # Half-written, gone, another's bytes: of the shards 5, 6 and 7; of shard 8 the digest is gone.
    cut = shard("flags", 5)
    cut.write_bytes(cut.read_bytes()[:100])
    shard("solutions", 6).unlink()
    shard("flags", 7).write_bytes(shard("flags", 40).read_bytes())
    (shard("manifest/digests", 8) / "0" / "0").unlink()
    found = run("check", place, "--workers", 1)
    assert found.returncode == 1, found.stderr
    assert "missing: 8\n" in found.stdout and "wrong: 5-7\n" in found.stdout, found.stdout
    with pytest.raises(spiral_atlas.AtlasError, match="shard 5 is wrong"):
        Store(place).check()
    with pytest.raises(spiral_atlas.AtlasError, match="a shard is damaged"):
        spiral_atlas.to_safetensors(place, place.with_suffix(".safetensors"))
    again = run("generate", recipe, place, "--workers", 1)
    assert "4 written, 60 there and right" in again.stdout, again.stderr
    equal(place, atlas)
    assert Store(place).id == identity


def test_jobs_of_a_batch_system_fill_a_store_together(recipe, place, atlas):
    made = run("create", recipe, place, *OPTIONS)
    assert f"shards 0 to {SHARDS - 1}" in made.stdout, made.stderr
    code = "import sys; from spiral_atlas.cluster import cli; cli.main(); assert 'dask' not in sys.modules"
    jobs = [[sys.executable, "-c", code, "shard", place, some] for some in ("0-30", "31-62", "63-90")]
    running = [subprocess.Popen(job) for job in jobs]
    assert [job.wait(timeout=120) for job in running] == [0, 0, 0]
    done = run("generate", recipe, place, "--workers", 1)
    assert f"{SHARDS} shards: {SHARDS} there and right" in done.stdout, done.stderr
    equal(place, atlas)
    for wrong in ("64", "3-1", "x"):
        assert run("shard", place, wrong).returncode == 2


def test_another_recipe_is_refused_with_what_differs(recipe, place, tmp_path):
    create(recipe, place)
    text = recipe.read_text()
    for old, new, words in [
        (
            "[0.2, 1.2]",
            "[0.2, 1.3]",
            "axis `phi0` has 16 nodes from 0.2 to 1.2 there and 16 nodes from 0.2 to 1.3 here",
        ),
        ("ph-quintic", "cubic", "`family` is ph-quintic there and cubic here"),
        ('"slow"', '"fast"', "line 3 of the recipe is 'name = \"slow\"' there and 'name = \"fast\"' here"),
    ]:
        other = tmp_path / "other.toml"
        other.write_text(text.replace(old, new))
        with pytest.raises(ValueError, match="holds another atlas") as raised:
            generate(other, place)
        assert words in str(raised.value)
    with pytest.raises(ValueError, match="`shards` are 16,16,16,16 there and 8,8,4,4 here"):
        create(recipe, place, shards=(8, 8, 4, 4))
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "a").write_text("mine")
    for foreign in (tmp_path / "notes", recipe):
        with pytest.raises(ValueError, match="something else than an atlas"):
            generate(recipe, foreign)
    assert os.listdir(tmp_path / "notes") == ["a"]


def test_mistakes_of_a_command_are_told_at_once(recipe, place, tmp_path):
    create(recipe, place, **SHAPES)
    other = tmp_path / "other.atlas.zarr"
    for arguments, words in [
        (("shard", place, f"{SHARDS}-{10**17}"), f"shards 0 to {SHARDS - 1}; given: {SHARDS}"),
        (("generate", recipe, place, "--scheduler", "head"), "missing port number in address 'head'"),
        (("generate", recipe, other, "--shards", f"{10**20},1,1,1"), "longer than the axes"),
        (("generate", recipe, other, "--chunks", "1,1,1,1,1"), "must be 4 sides"),
        # Packages of fsspec that the tests do not install.
        (("generate", recipe, "smb://host/store.zarr"), "smbprotocol"),
        (("generate", tmp_path / "none.toml", other), "there is no such file"),
    ]:
        done = run(*arguments)
        assert done.returncode == 2 and words in done.stderr, done.stderr
        assert done.stderr.startswith("error: ") and done.stderr.count("\n") == 1 and "Errno" not in done.stderr
    # A range that goes on far behind the last shard is cut off.
    done = run("shard", place, f"{SHARDS - 1}-{10**17}")
    assert done.returncode == 0 and done.stdout.count("\n") == 1, done.stderr
    generate(recipe, place, workers=1)
    assert run("render", place, "-o", tmp_path / "none" / "a.png").stderr.endswith("there is no such folder\n")


def test_ctrl_c_keeps_what_is_written(recipe, place):
    with started("generate", recipe, place, *OPTIONS, "--workers", 1, stdout=subprocess.DEVNULL) as process:
        wait_for(lambda: written(place) > 0, "the first shard")
        process.send_signal(signal.SIGINT)
        _, complaint = process.communicate(timeout=60)
        assert process.returncode == 130 and "interrupted" in complaint, complaint
    assert 0 < written(place) < SHARDS


def test_a_store_whose_making_was_interrupted_is_made_anew(recipe, place, atlas):
    create(recipe, place, **SHAPES)
    (place / "zarr.json").write_text('{"zarr_format": 3, "node_type": "group", "attributes": {}}')
    with pytest.raises(spiral_atlas.AtlasError, match="interrupted"):
        Store(place)
    assert generate(recipe, place, **SHAPES, workers=2).count("written") == SHARDS
    equal(place, atlas)


def damaged(place: Path, name: str, **changes) -> None:
    file = place / name / "zarr.json"
    told = json.loads(file.read_text())
    (told["attributes"] if not name else told).update(changes)
    file.write_text(json.dumps(told))


HOSTILE = {
    "root is a list": lambda place: (place / "zarr.json").write_text("[1]"),
    "root is endless": lambda place: (place / "zarr.json").write_text("[" * 200_000),
    "array is no JSON": lambda place: (place / "flags" / "zarr.json").write_text("{nope"),
    "a number for a text": lambda place: damaged(place, "", flags=5),
    "axes are no axes": lambda place: damaged(place, "", axes='[{"name": {}}]'),
    "an axis is four-dimensional": lambda place: damaged(place, "", axes='[{"name": "flags"}]'),
    "another version of the format": lambda place: damaged(place, "", format_version="9"),
    "a type that is none": lambda place: damaged(place, "flags", data_type="bogus"),
    "a type of other fields": lambda place: damaged(place, "solutions", data_type="int8"),
    "fractions of nodes": lambda place: damaged(place, "flags", shape=[8.5] * 4),
    "10^30 nodes": lambda place: damaged(place, "flags", shape=[10**30] * 4),
    "an axis of 64 GiB": lambda place: damaged(place, "phi0", shape=[1 << 33]),
    "no digests": lambda place: (place / "manifest" / "digests" / "zarr.json").unlink(),
    "digests of 2^63 bytes": lambda place: damaged(place, "manifest/digests", shape=[1 << 62]),
}


@pytest.mark.parametrize("damage", HOSTILE)
def test_a_store_that_is_none_is_refused_in_one_line(recipe, place, damage, capsys, tmp_path):
    create(recipe, place, **SHAPES)
    damaged(place, "", complete=True)
    HOSTILE[damage](place)
    with pytest.raises(spiral_atlas.AtlasError) as raised:
        spiral_atlas.open(place)
    assert str(place) in str(raised.value) and len(str(raised.value)) < 600
    picture = ["render", place, "-o", tmp_path / "a.png"]
    for command in (["info", place], ["check", place], picture, ["shard", place, 0]):
        assert cli.main(list(map(str, command))) == 2, command
        complaint = capsys.readouterr().err
        assert complaint.startswith("error: ") and complaint.count("\n") == 1, complaint
    with pytest.raises(ValueError):
        create(recipe, place)


def test_digests_that_are_cut_off_are_found(recipe, place):
    create(recipe, place, **SHAPES)
    write_shard(place, 0)
    (file,) = (path for path in (place / "manifest" / "digests" / "c").rglob("*") if path.is_file())
    file.write_bytes(b"cut")
    with pytest.raises(spiral_atlas.AtlasError, match="a shard is damaged"):
        Store(place, complete=False).check()
