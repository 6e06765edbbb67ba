"""All shards of a store, on Dask."""

import errno
import logging
import os
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal
from uuid import uuid4

from .._core import Outline
from .layout import lay_out, refuse_others
from .lock import locked, sweep
from .shards import Shard, finish, look_at, write_shard
from .store import Store, absolute

if TYPE_CHECKING:
    from distributed import Client, Future

HOPELESS = {errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM, errno.EFBIG}
"""What the system refuses to every worker alike: neither another try nor another shard helps."""


LOST = "the scheduler was lost"


SETTINGS = {
    # Workers keep the memory of a shard for the next. Dask has them give it back each time, which takes a fifth longer.
    "distributed.nanny.pre-spawn-environ.MALLOC_TRIM_THRESHOLD_": str(1 << 28),
    "distributed.nanny.pre-spawn-environ.MALLOC_MMAP_THRESHOLD_": str(1 << 25),
    # One process imports what workers need, and they are its copies.
    "distributed.worker.multiprocessing-method": "forkserver",
    # Shards are computed in one call, in which a profile of Python sees nothing.
    "distributed.worker.profile.enabled": False,
}
"""Of the cluster on this machine."""


class IncompleteError(RuntimeError):
    """Shards could not be written; the message says which and why. What is written stays, and the next run goes on."""


@dataclass
class Summary:
    """What a run did."""

    store: Store
    shards: list[Shard] = field(default_factory=list)
    workers: int = 0
    dashboard: str | None = None
    """Address of the page on which Dask shows the run."""
    seconds: float = 0.0

    def count(self, state: str) -> int:
        """Shards in this state."""
        return sum(shard.state == state for shard in self.shards)

    @property
    def nodes(self) -> int:
        """Nodes of all shards that are right."""
        return sum(shard.nodes for shard in self.shards)

    @property
    def yes(self) -> dict[str, int]:
        """Nodes with a proved yes, by flag."""
        return {name: sum(shard.yes.get(name, 0) for shard in self.shards) for name in self.store.flag_docs}

    @property
    def undecided_f64(self) -> int:
        """Nodes that went to intervals, of the shards that this run computed."""
        return sum(shard.undecided_f64 for shard in self.shards)


Progress = Callable[[Summary], object]


def generate(
    recipe: Any,
    place: str | os.PathLike[str],
    *,
    atlas: str | None = None,
    scheduler: str | None = None,
    workers: int | None = None,
    chunks: Sequence[int] | None = None,
    shards: Sequence[int] | None = None,
    progress: Progress | None = None,
) -> Summary:
    """Makes a store, or completes the one that is there: shards that are there and right are not computed again.

    A script that calls this without a scheduler must guard its main part by ``if __name__ == "__main__":``, because the
    workers are processes that import it.

    Args:
        recipe: a dictionary, or the path of a TOML file.
        place: a folder that all workers share, or a URL that zarr understands.
        atlas: which atlas of the recipe, where it has several.
        scheduler: address of a Dask scheduler. Without one, a cluster on this machine lives as long as the run.
        workers: processes of that cluster; by default as many as there are cores.
        chunks, shards: nodes along each axis; by default at most 2**20 nodes and 2**25 bytes.
        progress: called after each shard with the summary so far.

    Raises:
        ValueError: the recipe is wrong; or another atlas is there, and the message says what differs.
        StoreLockedError: another run works on the store.
        IncompleteError: shards are missing, and the message says which and why. The next run completes the store.
    """
    outline, place = Outline.of_recipe(recipe, atlas), absolute(place)
    refuse_others(place)
    with locked(place):
        sweep(place)
        summary = Summary(lay_out(outline, place, chunks, shards))
        _run(summary, write_task, scheduler, workers, progress)
        finish(summary.store)
    return summary


def check(
    place: str | os.PathLike[str],
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Summary:
    """Reads every shard of a store and compares it with its digest; nothing is written.

    Shards of the summary are `kept` where they are right, or else `missing` or `wrong`. Arguments are those of
    `generate`.
    """
    summary = Summary(Store(place, complete=False))
    _run(summary, check_task, scheduler, workers, progress)
    return summary


@dataclass(frozen=True)
class Refused:
    """What is refused to all shards alike, so that the run ends."""

    why: str


_stores: dict[tuple[str, str], Store] = {}


def _opened(place: str, mode: Literal["r", "r+"], run: str) -> Store:
    """The store of a run, opened once by each worker; the next run may be one of another store in the same place."""
    store = _stores.get((place, run))
    if store is None:
        _stores.clear()
        store = _stores[place, run] = Store(place, mode=mode, complete=False)
    return store


def write_task(place: str, run: str, number: int) -> Shard | Refused:
    """`write_shard` on one thread, since a worker has a process or a thread for each core."""
    try:
        return write_shard(_opened(place, "r+", run), number, threads=1)
    except OSError as error:
        if error.errno not in HOPELESS:
            raise
        return Refused(f"{error.strerror} ({error.filename or place})")


def check_task(place: str, run: str, number: int) -> Shard:
    """`look_at` for a worker."""
    return look_at(_opened(place, "r", run), number)


def _run(
    summary: Summary,
    task: Callable[[str, str, int], Shard | Refused],
    scheduler: str | None,
    workers: int | None,
    progress: Progress | None,
) -> None:
    # Here, so that jobs of a batch system do not wait for it.
    from distributed import as_completed

    began, store = time.perf_counter(), summary.store
    failures: dict[int, str] = {}
    hopeless = False
    with _client(scheduler, min(workers or len(os.sched_getaffinity(0)), store.shard_count)) as client:
        summary.workers, summary.dashboard = client.scheduler_info()["total_threads"], client.dashboard_link
        if progress:
            progress(summary)
        count = store.shard_count
        # Not pure: a shard of an earlier run is another task.
        futures = client.map(task, [store.path] * count, [uuid4().hex] * count, range(count), pure=False, retries=3)
        numbers = {future.key: number for number, future in enumerate(futures)}
        # Without results: where the scheduler is lost while it hands one over, Dask would wait for that one for ever.
        for batch in as_completed(futures, loop=client.loop).batches():
            for future, result in zip(batch, _results(client, batch), strict=True):
                if isinstance(result, Shard):
                    summary.shards.append(result)
                else:
                    failures[numbers[future.key]] = _why(result)
                if isinstance(result, Refused):
                    hopeless = True
                # The result is kept here, so the scheduler may forget it.
                future.release()
            summary.seconds = time.perf_counter() - began
            if progress:
                progress(summary)
            if hopeless:
                client.cancel(futures)
                break
    if failures:
        raise IncompleteError(_complaint(summary, failures))


def _results(client: "Client", done: Sequence["Future"]) -> list[Any]:
    """What each of some tasks that have ended returned or raised."""
    finished = [future for future in done if future.status == "finished"]
    try:
        values = dict(zip(finished, client.gather(finished), strict=True))
    except Exception:
        # Tasks that have finished have results, so it is the scheduler that does not hand them over.
        return [Refused(LOST)] * len(done)
    results = []
    for future in done:
        try:
            results.append(values[future] if future in values else future.result())
        except Exception as error:
            results.append(error)
    return results


def _why(result: Any) -> str:
    """Why a task has no result."""
    from distributed import CancelledError, KilledWorker

    match result:
        case Refused(why):
            return why
        case CancelledError():
            return LOST
        case KilledWorker() as error:
            return f"{error.allowed_failures + 1} workers died while they worked at it, perhaps for lack of memory"
        case error:
            return f"{type(error).__name__}: {error}"


def _complaint(summary: Summary, failures: dict[int, str]) -> str:
    store, done = summary.store, len(summary.shards)
    left = store.shard_count - done
    text = f"{store.path}: {done} of {store.shard_count} shards are done, {left} are not"
    # Many have the same reason; one of each is reported, with its shards.
    reasons: dict[str, list[int]] = {}
    for number, why in sorted(failures.items()):
        reasons.setdefault(why, []).append(number)
    for why, numbers in list(reasons.items())[:5]:
        more = ", .." if len(numbers) > 5 else ""
        text += f"\n  shard {', '.join(map(str, numbers[:5]))}{more}: {why}"
    return text + "\nThe next run goes on from here"


@contextmanager
def _client(scheduler: str | None, workers: int) -> "Iterator[Client]":
    """A client of a scheduler or, without one, of a cluster that lives as long."""
    import dask
    from distributed import Client, LocalCluster
    from distributed.comm.addressing import get_address_host_port
    from distributed.utils import get_mp_context

    if scheduler is not None:
        # Of an address that is none, Dask would complain, and then wait for a minute.
        get_address_host_port(scheduler)
        # Its own log says in other words what the failures say.
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        with Client(scheduler, set_as_default=False) as client:
            yield client
        return
    with warnings.catch_warnings(), dask.config.set(SETTINGS):
        # The usual port of the dashboard may be taken; it is another one then.
        warnings.filterwarnings("ignore", "Port .* is already in use")
        get_mp_context().set_forkserver_preload(["distributed", __name__])
        cluster = LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, silence_logs=logging.CRITICAL)
    with cluster, Client(cluster, set_as_default=False) as client:
        yield client
