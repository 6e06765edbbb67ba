//! The bytes of a file: mapped into memory or, where there are no maps (in a browser), a copy.

use crate::error::{Error, Result};
use std::fs::File;
use std::path::{Path, PathBuf};

/// The name, in messages, of bytes that lie in no file.
pub(super) const MEMORY: &str = "(memory)";

/// The bytes of a file, aligned for every number that it holds.
#[cfg(not(target_family = "wasm"))]
pub(crate) type Map = memmap2::Mmap;
/// The bytes of a file. The allocator of WebAssembly aligns everything to 8 bytes.
#[cfg(target_family = "wasm")]
pub(crate) type Map = Vec<u8>;

/// Maps the file of a path.
pub(crate) fn map_path(path: &Path) -> Result<Map> {
    // Asked before opening, because opening a pipe would wait for its other end.
    if !std::fs::metadata(path).map_err(Error::io(path))?.is_file() {
        let what = if path.join("zarr.json").is_file() {
            "it is a Zarr store; `spiral-atlas-cluster` reads it: its `info`, `check` and `render`"
        } else {
            "it is not an ordinary file; an atlas is mapped into memory, and needs one"
        };
        return Err(Error::Atlas { path: path.to_owned(), what: what.into() });
    }
    map_file(path, &File::open(path).map_err(Error::io(path))?)
}

#[cfg(not(target_family = "wasm"))]
pub(super) fn map_file(path: &Path, file: &File) -> Result<Map> {
    // SAFETY: the map is read-only and private to the value that holds it, and only ever read as u8, u32, f32 or f64,
    // for which every bit pattern is valid. That nobody changes the file meanwhile cannot be enforced; the
    // documentation of `Atlas` asks for it. Should someone do so, no invariant that memory safety rests on is read from
    // the map again after its first check.
    unsafe { memmap2::Mmap::map(file) }.map_err(Error::io(path))
}

#[cfg(target_family = "wasm")]
pub(super) fn map_file(path: &Path, mut file: &File) -> Result<Map> {
    let mut bytes = Vec::new();
    std::io::Read::read_to_end(&mut file, &mut bytes).map_err(Error::io(path))?;
    Ok(bytes)
}

/// A copy of bytes as a map of its own, which has the alignment of a mapped file, under a name for messages.
#[cfg(not(target_family = "wasm"))]
pub(crate) fn map_bytes(bytes: &[u8]) -> Result<(PathBuf, Map)> {
    let path = PathBuf::from(MEMORY);
    // An empty one is not possible.
    let mut map = memmap2::MmapMut::map_anon(bytes.len().max(1)).map_err(Error::io(&path))?;
    map[..bytes.len()].copy_from_slice(bytes);
    let map = map.make_read_only().map_err(Error::io(&path))?;
    Ok((path, map))
}

/// A copy of bytes, under a name for messages.
#[cfg(target_family = "wasm")]
pub(crate) fn map_bytes(bytes: &[u8]) -> Result<(PathBuf, Map)> {
    Ok((PathBuf::from(MEMORY), bytes.to_vec()))
}
