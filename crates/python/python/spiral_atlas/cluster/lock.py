"""A lock on a store that a dead process does not hold."""

import contextlib
import errno
import fcntl
import os
import sys
from collections.abc import Iterator
from pathlib import Path

# Inside an array, where nobody looks for members of a group.
LOCK = Path("manifest", "digests", ".lock")
UNSUPPORTED = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP}


class StoreLockedError(RuntimeError):
    """Another run works on the store."""


@contextlib.contextmanager
def locked(place: str, *, shared: bool = False) -> Iterator[None]:
    """Holds the lock of a store: alone, or together with others that share it.

    The system takes the lock back when its holder dies, however that happens. A store that is no folder of a file
    system has no lock: two runs there write the same shards with the same content, which costs time and harms nothing.

    Raises:
        StoreLockedError: another run holds it.
    """
    if "://" in place:
        yield
        return
    path = Path(place) / LOCK
    path.parent.mkdir(parents=True, exist_ok=True)
    file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        try:
            fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError:
            raise StoreLockedError(f"{place}: another run works on this store; wait for its end, or end it") from None
        except OSError as error:
            if error.errno not in UNSUPPORTED:
                raise
            print(f"note: {place}: this file system has no locks; do not start a second run", file=sys.stderr)
        yield
    finally:
        os.close(file)


def sweep(place: str) -> None:
    """Removes files that dead writers left half-written. Only for the one holder of the lock."""
    if "://" not in place:
        for path in Path(place).rglob("*.partial"):
            path.unlink(missing_ok=True)
