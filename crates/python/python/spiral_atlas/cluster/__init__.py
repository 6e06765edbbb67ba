"""Atlases larger than a machine: Zarr stores, filled shard by shard by many processes.

A store is a Zarr v3 group. It has an array for each field and each axis, the metadata of an atlas file as
attributes, and the BLAKE3 of every shard. Any number of processes may write shards at the same time, because each
shard is a file of its own, and each is a function of the recipe alone.

`generate` runs all shards on Dask. `create` and `write_shard`, which it is made of, know nothing of Dask.
"""

from .layout import create
from .lock import StoreLockedError
from .picture import pictures
from .run import IncompleteError, Summary, check, generate
from .shards import Shard, write_shard
from .store import Store

__all__ = [
    "IncompleteError",
    "Shard",
    "Store",
    "StoreLockedError",
    "Summary",
    "check",
    "create",
    "generate",
    "pictures",
    "write_shard",
]
