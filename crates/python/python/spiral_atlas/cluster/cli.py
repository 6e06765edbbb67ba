"""The command `spiral-atlas-cluster`."""

import argparse
import json
import os
import sys
import tempfile
import time
from collections.abc import Sequence
from itertools import chain
from math import prod
from pathlib import Path
from typing import Any

from . import layout, picture, run, shapes, shards
from .lock import StoreLockedError, locked
from .store import Store

EPILOG = """Examples:
  spiral-atlas-cluster generate big.toml big.atlas.zarr --workers 8
  spiral-atlas-cluster generate big.toml big.atlas.zarr --scheduler tcp://head:8786
  spiral-atlas-cluster shard big.atlas.zarr 0-15
  spiral-atlas-cluster render big.atlas.zarr --x kappa0 --y kappa1 --at phi0=40deg --at phi1=1.4

Exit status: 0, or 1 where `check` finds shards that are missing or wrong, 2 for an error, 130 after Ctrl-C."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns the exit status."""
    options = parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except KeyboardInterrupt:
        print("error: interrupted; what is written stays, and the next run goes on from here", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"error: {refusal(error)}", file=sys.stderr)
        return 2
    # An import fails where a place needs a package of fsspec, or Dask is missing; the error names it.
    except (run.IncompleteError, StoreLockedError, ValueError, ArithmeticError, ImportError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2


def refusal(error: OSError) -> str:
    """What the system refused, without its number, and for which file."""
    text, name = error.strerror or str(error), error.filename
    return text if name is None or str(name) in text else f"{name}: {text}"


def parser() -> argparse.ArgumentParser:
    """What the command takes."""
    whole = argparse.ArgumentParser(
        prog="spiral-atlas-cluster",
        description="Atlases larger than a machine: Zarr stores, made shard by shard by many processes.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = whole.add_subparsers(required=True, metavar="COMMAND")

    def command(name: str, does: Any, words: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=words, description=words)
        added.set_defaults(run=does)
        return added

    def recipe(added: argparse.ArgumentParser) -> None:
        added.add_argument("recipe", metavar="RECIPE", help="a TOML file")
        added.add_argument(
            "store", metavar="STORE", help="a folder that all workers share, best named NAME.atlas.zarr, or a URL"
        )
        added.add_argument("--atlas", metavar="NAME", help="which atlas of the recipe, where it has several")
        added.add_argument(
            "--chunks", type=sides, metavar="N,N,..", help="nodes of a chunk along each axis [at most 2^20 in all]"
        )
        added.add_argument(
            "--shards", type=sides, metavar="N,N,..", help="nodes of a shard along each axis [at most 32 MiB in all]"
        )

    def cluster(added: argparse.ArgumentParser) -> None:
        where = added.add_mutually_exclusive_group()
        where.add_argument("--scheduler", metavar="ADDRESS", help="a running Dask scheduler, as tcp://head:8786")
        where.add_argument(
            "--workers", type=positive, metavar="N", help="processes on this machine [one for each core]"
        )
        added.add_argument("--json", action="store_true", help="print JSON")

    added = command("generate", generate, "Make a store, or complete the one that is there.")
    recipe(added)
    cluster(added)
    recipe(command("create", create, "Make a store without shards, and report their number."))
    added = command(
        "shard", shard, "Write shards of a store. Needs no Dask: a job of a batch system writes some of them."
    )
    added.add_argument("store", metavar="STORE")
    added.add_argument(
        "shards",
        metavar="I",
        nargs="+",
        type=numbers,
        help="a number from 0 on, or a range such as 0-15, cut off at the last shard",
    )
    added = command("info", info, "Report what a store holds: grid, fields, legend, shards and recipe.")
    added.add_argument("store", metavar="STORE")
    added = command("check", check, "Read every shard of a store and compare it with its digest.")
    added.add_argument("store", metavar="STORE")
    cluster(added)
    added = command(
        "render", render, "Draw the pictures of the recipe that a store carries, or a slice; only that is read."
    )
    added.add_argument("store", metavar="STORE")
    added.add_argument("--x", metavar="AXIS", help="horizontal axis of a slice")
    added.add_argument("--y", metavar="AXIS", help="vertical axis of a slice")
    added.add_argument(
        "--at", type=pair, action="append", default=[], metavar="AXIS=VALUE", help="where on another axis"
    )
    added.add_argument(
        "-o", "--out", metavar="DIR|FILE", default="out", help="a folder, or a file.png for one picture [out]"
    )
    return whole


def sides(text: str) -> tuple[int, ...]:
    """`16,16,32,32`"""
    return tuple(positive(side) for side in text.split(","))


def positive(text: str) -> int:
    """A number from 1 on."""
    if not text.strip().isascii() or not text.strip().isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 1 on")
    return int(text)


def numbers(text: str) -> range:
    """`7`, or `0-15`"""
    first, _, last = text.partition("-")
    if not (first.isdecimal() and (last or first).isdecimal() and int(first) <= int(last or first)):
        raise argparse.ArgumentTypeError(f"{text!r} is no number of a shard, and no range such as 0-15")
    return range(int(first), int(last or first) + 1)


def pair(text: str) -> tuple[str, float | str]:
    """`phi0=0.7`, or `phi0=40deg`"""
    axis, equals, value = text.partition("=")
    if not (axis and equals and value):
        raise argparse.ArgumentTypeError(f"{text!r} is not AXIS=VALUE")
    try:
        return axis, float(value)
    except ValueError:
        return axis, value


def generate(options: argparse.Namespace) -> int:
    with Progress() as progress:
        summary = run.generate(
            options.recipe,
            options.store,
            atlas=options.atlas,
            scheduler=options.scheduler,
            workers=options.workers,
            chunks=options.chunks,
            shards=options.shards,
            progress=progress.show,
        )
    print(as_json(summary) if options.json else told(summary))
    return 0


def check(options: argparse.Namespace) -> int:
    with Progress() as progress:
        summary = run.check(options.store, scheduler=options.scheduler, workers=options.workers, progress=progress.show)
    print(as_json(summary) if options.json else told(summary))
    return 0 if summary.count("kept") == summary.store.shard_count else 1


def create(options: argparse.Namespace) -> int:
    store = layout.create(
        options.recipe, options.store, atlas=options.atlas, chunks=options.chunks, shards=options.shards
    )
    print(f"{options.store}: shards 0 to {store.shard_count - 1} of {' x '.join(map(str, store.shards))} nodes")
    return 0


def shard(options: argparse.Namespace) -> int:
    # Before the lock, which would make a folder of any name.
    place = Store(options.store, complete=False).path
    with locked(place, shared=True):
        store = Store(place, mode="r+", complete=False)
        for some in options.shards:
            store.box(some.start)
        # The last job of many may have a range that goes on behind the last shard.
        ranges = [range(some.start, min(some.stop, store.shard_count)) for some in options.shards]
        for number in chain(*ranges):
            done = shards.write_shard(store, number)
            print(f"shard {number}: {done.state}, {done.nodes:,} nodes, {done.seconds:.2f} s", flush=True)
    return 0


def info(options: argparse.Namespace) -> int:
    store = Store(options.store, complete=False)
    about = store.metadata
    complete = "complete" if store.group.attrs.get("complete") else "not complete: `generate` goes on with it"
    lines = [store.path, f"  {about['name']}, {store.family}, by {about['generator']}; {complete}"]
    lines += [f"grid of {prod(store.shape):,} nodes, first axis slowest; chart `{store.chart}`"]
    for name, axis in store.axes.items():
        unit = " radians" if name in store.angles else ""
        lines.append(f"  {name:<14} {len(axis):>7,} values from {axis[0]} to {axis[-1]}{unit}")
    lines += [f"{store.shard_count:,} shards of {shapes.told(store.shards)}, in chunks of {shapes.told(store.chunks)}"]
    flags = enumerate(store.flag_docs.items())
    lines += ["flags (u8)", *(f"  bit {bit} {name:<14} {doc}" for bit, (name, doc) in flags)]
    counts = store.counts.items()
    lines += ["solutions (u8)", *(f"  {name}: {bits} bits from bit {shift} on" for name, (shift, bits) in counts)]
    if store.scalar_docs:
        lines += ["scalars (f32)", *(f"  {name:<14} {doc}" for name, doc in store.scalar_docs.items())]
    print("\n".join([*lines, "recipe", *(f"  {line}".rstrip() for line in store.recipe.splitlines())]))
    return 0


def render(options: argparse.Namespace) -> int:
    store, out = Store(options.store), Path(options.out)
    drawn = list(picture.pictures(store, x=options.x, y=options.y, at=dict(options.at)))
    if out.suffix == ".png":
        if len(drawn) > 1:
            raise ValueError(f"the recipe has {len(drawn)} pictures, and {out} is one file; give a folder")
        files = [out]
    else:
        out.mkdir(parents=True, exist_ok=True)
        name = store.metadata["name"]
        files = [out / (f"{name}.png" if len(drawn) == 1 else f"{name}-{i}.png") for i in range(1, len(drawn) + 1)]
    if not files[0].parent.is_dir():
        raise ValueError(f"{files[0].parent}: there is no such folder")
    for file, png in zip(files, drawn, strict=True):
        with tempfile.NamedTemporaryFile(dir=file.parent, suffix=".part", delete=False) as draft:
            try:
                draft.write(png)
                os.chmod(draft.name, 0o644)
                os.replace(draft.name, file)
            except BaseException:
                os.unlink(draft.name)
                raise
        print(file)
    return 0


def told(summary: run.Summary) -> str:
    """The summary of a run in words, as `spiral-atlas generate` has it."""
    store, nodes = summary.store, summary.nodes
    axes = " x ".join(f"{name} {len(axis):,}" for name, axis in store.axes.items())
    states = {"written": "written", "kept": "there and right", "missing": "missing", "wrong": "wrong"}
    counts = [f"{summary.count(state):,} {words}" for state, words in states.items() if summary.count(state)]
    lines = [
        f"{store.metadata['name']}: {axes} = {nodes:,} nodes",
        f"  {store.shard_count:,} shards: {', '.join(counts)}; by {summary.workers} workers in {summary.seconds:.2f} s",
    ]
    for state in ("missing", "wrong"):
        bad = [shard.number for shard in summary.shards if shard.state == state]
        if bad:
            lines.append(f"  {state}: {ranges(bad)}")
    lines.append("  nodes with a proved yes")
    lines += [
        f"    {name:<14} {count:>16,}  {100 * count / max(nodes, 1):6.2f} %" for name, count in summary.yes.items()
    ]
    if summary.count("written"):
        undecided = summary.undecided_f64
        lines.append(f"  nodes that the f64 step left to intervals: {undecided:,}, all of them decided")
    return "\n".join([*lines, f"  {store.path}"])


def ranges(shards: list[int]) -> str:
    """`0-3 7`, as `shard` takes them."""
    found: list[list[int]] = []
    for number in sorted(shards):
        if found and number == found[-1][1] + 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return " ".join(f"{first}-{last}" if first < last else f"{first}" for first, last in found)


def as_json(summary: run.Summary) -> str:
    """The summary of a run as JSON."""
    states = {state: summary.count(state) for state in ("written", "kept", "missing", "wrong")}
    bad = {state: [s.number for s in summary.shards if s.state == state] for state in ("missing", "wrong")}
    return json.dumps(
        {
            "atlas": summary.store.metadata["name"],
            "store": summary.store.path,
            "id": summary.store.id,
            "shape": list(summary.store.shape),
            "nodes": summary.nodes,
            "shards": {"all": summary.store.shard_count, **states},
            "bad": bad,
            "yes": summary.yes,
            "undecided_f64": summary.undecided_f64,
            "workers": summary.workers,
            "seconds": summary.seconds,
        }
    )


class Progress:
    """A line on a terminal that shows how far a run is; elsewhere nothing."""

    def __init__(self) -> None:
        self.shown, self.began, self.width = sys.stderr.isatty(), 0.0, 0
        self.last = 0.0

    def __enter__(self) -> "Progress":
        return self

    def show(self, summary: run.Summary) -> None:
        done, count, now = len(summary.shards), summary.store.shard_count, time.monotonic()
        if not done:
            self.began = now
            if summary.workers == 0:
                print("note: the scheduler has no workers yet; the run waits for them", file=sys.stderr)
            if self.shown and summary.dashboard:
                print(f"{summary.workers} workers; dashboard: {summary.dashboard}", file=sys.stderr)
        # Terminals are slower than shards.
        if not self.shown or (now - self.last < 0.1 and done < count):
            return
        self.last = now
        left = (now - self.began) / done * (count - done) if done else 0.0
        rate = summary.nodes / max(now - self.began, 1e-9) / 1e6
        text = f"{done} of {count} shards, {rate:.1f} Mnodes/s" + (f", {left:.0f} s left" if done else "")
        print(f"\r{text:<{self.width}}", end="", file=sys.stderr, flush=True)
        self.width = len(text)

    def __exit__(self, *_: object) -> None:
        if self.width:
            print(f"\r{'':<{self.width}}\r", end="", file=sys.stderr, flush=True)
