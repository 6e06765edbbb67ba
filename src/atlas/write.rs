//! Writing an atlas as a stream.

use super::about::{About, check_name};
use super::header::{Header, Tensor};
use super::{Atlas, Spec, fault};
use crate::error::{Error, Result};
use crate::eval::Chunk;
use crate::files::{Draft, check_room, folder};
use crate::grid::Axis;
use blake3::{Hash, Hasher};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Bytes of f32 that are converted at a time.
const BLOCK: usize = 1 << 16;

/// Writes an atlas chunk by chunk, beside its target; the target appears, whole, with [`Writer::finish`].
///
/// Memory: the header, the axes, one hash state a tensor and 64 KiB, whatever the size of the atlas.
/// Dropping a writer that is not finished removes what it wrote, and leaves an earlier file of that name as it was.
#[derive(Debug)]
pub struct Writer {
    target: PathBuf,
    draft: Draft,
    header: Header,
    body: u64,
    hashers: Vec<Hasher>,
    nodes: u64,
    next: u64,
}

/// What [`Writer::finish`] wrote.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// Length of the file.
    pub bytes: u64,
    /// The hash that stands for the whole atlas; see [`super::Atlas::id`].
    pub id: Hash,
    /// BLAKE3 of each tensor, in file order.
    pub hashes: Vec<(String, Hash)>,
}

impl Writer {
    /// Bytes of the file that a specification makes.
    ///
    /// # Errors
    /// [`Error::Domain`] when the specification is inconsistent (axes that are no chart of the family, a scalar given
    /// twice, a recipe too long).
    pub fn size(spec: &Spec) -> Result<u64> {
        let header = header_of(spec)?;
        Ok(header.render().map_err(Error::invalid)?.len() as u64 + header.body_len() as u64)
    }

    /// Opens a temporary file in the folder of `path` and lays the atlas out.
    ///
    /// # Errors
    /// [`Error::Domain`] when the specification is inconsistent, as for [`Writer::size`], or the disk has no room for
    /// the atlas; [`Error::Io`], naming `path`, when the system refuses.
    pub fn create(path: &Path, spec: &Spec) -> Result<Writer> {
        Writer::of(path, header_of(spec)?)
    }

    pub(super) fn of(path: &Path, header: Header) -> Result<Writer> {
        let head = header.render().map_err(Error::invalid)?;
        let io = || Error::io(path);
        let size = head.len() as u64 + header.body_len() as u64;
        check_room(folder(path), &format!("the atlas `{}`", header.about.name), size)?;
        let mut draft = Draft::beside(path).map_err(io())?;
        let body = head.len() as u64;
        draft.file().set_len(size).map_err(io())?;
        let hashers = vec![Hasher::new(); header.tensors.len()];
        let nodes = header.grid.len();
        let axis_bytes = |axis: &Axis| axis.values().iter().flat_map(|v| v.to_le_bytes()).collect();
        let axes: Vec<Vec<u8>> = header.grid.axes().iter().map(axis_bytes).collect();
        let mut writer = Writer { target: path.to_owned(), draft, header, body, hashers, nodes, next: 0 };
        for (i, bytes) in axes.iter().enumerate() {
            writer.append(i, 0, bytes)?;
        }
        Ok(writer)
    }

    /// Writes the next chunk. Chunks come in flat order, without gaps.
    ///
    /// # Errors
    /// [`Error::Domain`] for a chunk that does not start where the last one ended, leaves the grid, has fields of
    /// different lengths or values that no atlas may hold; [`Error::Io`], naming the target, for a full disk or the
    /// like.
    pub fn put(&mut self, chunk: &Chunk) -> Result<()> {
        self.check(chunk).map_err(|what| Error::invalid(format!("chunk at node {}: {what}", chunk.start)))?;
        let first = self.header.grid.axes().len();
        for (i, scalar) in chunk.scalars.iter().enumerate() {
            let mut at = 4 * chunk.start;
            for part in scalar.chunks(BLOCK / 4) {
                let bytes: Vec<u8> = part.iter().flat_map(|v| v.to_le_bytes()).collect();
                self.append(first + i, at, &bytes)?;
                at += bytes.len() as u64;
            }
        }
        let flags = first + chunk.scalars.len();
        self.append(flags, chunk.start, &chunk.flags)?;
        self.append(flags + 1, chunk.start, &chunk.solutions)?;
        self.next += chunk.len() as u64;
        Ok(())
    }

    /// Fills in the hashes, makes sure of the disk, and moves the file to its place, over an earlier one.
    ///
    /// # Errors
    /// [`Error::Domain`] when nodes are missing; [`Error::Io`], naming the target, when the system refuses.
    pub fn finish(mut self) -> Result<Written> {
        let id = self.complete()?;
        let bytes = self.body + self.header.body_len() as u64;
        let Writer { target, draft, header, .. } = self;
        draft.keep().map_err(Error::io(&target))?;
        let hashes = header.tensors.into_iter().map(|t: Tensor| t.name).zip(header.hashes).collect();
        Ok(Written { bytes, id, hashes })
    }

    /// Fills in the hashes and opens the atlas where it is. It never gets its place, and its file goes when the atlas
    /// is dropped.
    ///
    /// # Errors
    /// As of [`Writer::finish`].
    pub fn open(mut self) -> Result<Atlas> {
        self.complete()?;
        Atlas::of_draft(self.target, self.draft)
    }

    /// Writes the header, now that all hashes are known; returns the atlas's id.
    fn complete(&mut self) -> Result<Hash> {
        if self.next != self.nodes {
            return Err(Error::invalid(format!(
                "the atlas `{}` has {} of {} nodes; write them all before finishing",
                self.header.about.name, self.next, self.nodes
            )));
        }
        self.header.hashes = self.hashers.iter().map(Hasher::finalize).collect();
        let (head, id) = (self.header.render().map_err(Error::invalid)?, self.header.id().map_err(Error::invalid)?);
        let file = self.draft.file();
        file.rewind().and_then(|()| file.write_all(&head)).map_err(Error::io(&self.target))?;
        Ok(id)
    }

    fn check(&self, chunk: &Chunk) -> Result<(), String> {
        let (len, scalars) = (chunk.len(), self.header.about.scalars.len());
        if chunk.start != self.next {
            return Err(format!("node {} comes next", self.next));
        }
        if len as u64 > self.nodes - self.next {
            return Err(format!("it has {len} nodes, {} are left in the grid", self.nodes - self.next));
        }
        if chunk.solutions.len() != len || chunk.scalars.iter().any(|s| s.len() != len) {
            return Err("its fields differ in length".into());
        }
        if chunk.scalars.len() != scalars {
            return Err(format!("it has {} scalars, the atlas {scalars}", chunk.scalars.len()));
        }
        let about = &self.header.about;
        fault::bits("flags", &chunk.flags, about.flag_bits())?;
        fault::bits("solutions", &chunk.solutions, about.count_bits())?;
        chunk.scalars.iter().zip(&about.scalars).try_for_each(|(values, s)| fault::finite(&s.name, values))
    }

    /// Writes and hashes the next bytes of a tensor; `at` counts from the tensor's start.
    fn append(&mut self, tensor: usize, at: u64, bytes: &[u8]) -> Result<()> {
        let start = self.body + self.header.tensors[tensor].info.data_offsets.0 as u64 + at;
        let file = self.draft.file();
        file.seek(SeekFrom::Start(start)).and_then(|_| file.write_all(bytes)).map_err(Error::io(&self.target))?;
        self.hashers[tensor].update(bytes);
        Ok(())
    }
}

/// The header of a specification as it stands before any hash is known.
pub(super) fn header_of(spec: &Spec) -> Result<Header> {
    let domain = |what| Error::invalid(format!("the atlas `{}`: {what}", spec.name));
    check_name("atlas", spec.name).map_err(Error::invalid)?;
    let header = Header::new(About::of(spec).map_err(domain)?, spec.grid.clone()).map_err(domain)?;
    // Whether it is short enough.
    header.render().map_err(domain)?;
    Ok(header)
}
