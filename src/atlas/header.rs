//! The header of an atlas: what the file says about itself, and where its tensors lie.
//!
//! A header has exactly one spelling. The writer renders it from [`About`], the grid and the hashes; the reader takes
//! those out of the file, renders them again and demands the same bytes. So whatever the reader believes (names,
//! shapes, offsets, padding, order) is what the writer would have written, and a key that the reader overlooks cannot
//! exist. The header's own hash is among them, so that damage to the legend or the recipe is seen too.

use super::about::{About, Kind, check_name};
use crate::grid::{Grid, MAX_AXES};
use crate::plain;
use blake3::Hash;
use safetensors::tensor::{Dtype, Metadata, TensorInfo};
use std::collections::BTreeMap;
use std::ops::Range;

/// Longest header, in bytes; the recipe's text is most of it.
pub(crate) const MAX_HEADER: usize = crate::files::LONGEST_RECIPE as usize;
/// The tensor of flags.
pub(super) const FLAGS: &str = "flags";
/// The tensor of packed counts.
pub(super) const SOLUTIONS: &str = "solutions";
/// The tensors of a file of cells: where the trees of each top cell begin, their nodes, and what is known of each top
/// cell.
pub(crate) const ROOTS: &str = "roots";
/// See [`ROOTS`].
pub(crate) const TREES: &str = "trees";
/// See [`ROOTS`].
pub(crate) const TOP: &str = "top";
/// Bytes of the length that starts the file, and the alignment of the tensors.
const WORD: usize = 8;
/// Holds the place of a hash that is not known yet.
const ZERO: Hash = Hash::from_bytes([0; blake3::OUT_LEN]);

/// A tensor's name, type, shape and place after the header.
#[derive(Debug)]
pub(crate) struct Tensor {
    pub name: String,
    pub info: TensorInfo,
}

/// Everything before the tensors.
#[derive(Debug)]
pub(crate) struct Header {
    pub about: About,
    pub grid: Grid,
    pub tensors: Vec<Tensor>,
    /// BLAKE3 of each tensor, in the order of `tensors`.
    pub hashes: Vec<Hash>,
}

impl Header {
    /// Lays the tensors out, the widest type first, so that each is aligned when the header's end is; hashes are zero
    /// as yet.
    pub(crate) fn new(about: About, grid: Grid) -> Result<Header, String> {
        let shape = grid.shape();
        let scalars = about.scalars.iter().map(|s| (s.name.clone(), Dtype::F32, shape.clone()));
        let bytes = [FLAGS, SOLUTIONS].map(|name| (name.to_owned(), Dtype::U8, shape.clone()));
        let fields = scalars.chain(bytes).collect();
        Header::with(about, grid, fields)
    }

    /// The same for cells: `top` of them along each axis of several values, and so many words of trees.
    pub(crate) fn of_cells(about: About, grid: Grid, top: usize, words: usize) -> Result<Header, String> {
        let divided = grid.axes().iter().filter(|axis| axis.values().len() > 1).count();
        let shape = |last: usize| [vec![top; divided], vec![last]].concat();
        let fields = vec![
            (ROOTS.to_owned(), Dtype::U32, shape(about.flags.len())),
            (TREES.to_owned(), Dtype::U32, vec![words]),
            (TOP.to_owned(), Dtype::U8, shape(2)),
        ];
        Header::with(about, grid, fields)
    }

    fn with(about: About, grid: Grid, fields: Vec<(String, Dtype, Vec<usize>)>) -> Result<Header, String> {
        about.check()?;
        let axes =
            grid.axes().iter().map(|a| (a.name().to_owned(), Dtype::F64, vec![a.values().len()])).collect::<Vec<_>>();
        let mut tensors: Vec<Tensor> = Vec::new();
        let mut start = 0usize;
        for (name, dtype, shape) in axes.into_iter().chain(fields) {
            let name = &name[..];
            check_name("tensor", name)?;
            if tensors.iter().any(|t| t.name == name) {
                return Err(format!("two tensors are named `{name}`; axes and fields need different names"));
            }
            let size = shape.iter().try_fold(dtype.bitsize() / 8, |n, s| n.checked_mul(*s));
            let end = size.and_then(|s| start.checked_add(s)).ok_or("the grid is too large for this machine")?;
            tensors
                .push(Tensor { name: name.to_owned(), info: TensorInfo { dtype, shape, data_offsets: (start, end) } });
            start = end;
        }
        let hashes = vec![ZERO; tensors.len()];
        Ok(Header { about, grid, tensors, hashes })
    }

    /// Number of bytes after the header.
    pub(crate) fn body_len(&self) -> usize {
        self.tensors.last().map_or(0, |t| t.info.data_offsets.1)
    }

    /// Where a tensor lies in the file, whose first tensor begins at `body`.
    pub(crate) fn range(&self, name: &str, body: usize) -> Result<Range<usize>, String> {
        let tensor = self.tensors.iter().find(|t| t.name == name);
        let (start, end) = tensor.ok_or_else(|| format!("it has no tensor `{name}`"))?.info.data_offsets;
        Ok(body + start..body + end)
    }

    /// [`Header::parse`] of a file of one kind, to be read on this machine.
    pub(crate) fn open(file: &[u8], kind: Kind) -> Result<(Header, usize), String> {
        if cfg!(target_endian = "big") {
            return Err("its numbers are little-endian, those of this machine are not".into());
        }
        match Header::parse(file)? {
            found if found.0.about.kind == kind => Ok(found),
            _ if kind == Kind::Nodes => Err("it holds cells, not nodes; `spiral_atlas::cells::Cells` opens it".into()),
            _ => Err("it holds nodes, not cells; `spiral_atlas::atlas::Atlas` opens it".into()),
        }
    }

    /// The metadata of the file, sorted by key.
    pub(crate) fn metadata(&self) -> Result<BTreeMap<String, String>, String> {
        self.metadata_with(self.id()?)
    }

    /// BLAKE3 of the header as written but with zeros for this hash itself: it stands for all that the atlas holds.
    pub(crate) fn id(&self) -> Result<Hash, String> {
        Ok(blake3::hash(&self.render_with(ZERO)?))
    }

    /// The header's bytes with the length before them; their number does not depend on the hashes.
    pub(crate) fn render(&self) -> Result<Vec<u8>, String> {
        self.render_with(self.id()?)
    }

    fn metadata_with(&self, id: Hash) -> Result<BTreeMap<String, String>, String> {
        let mut map = self.about.to_map(&self.grid)?;
        map.insert("blake3".to_owned(), id.to_hex().to_string());
        map.extend(
            self.tensors.iter().zip(&self.hashes).map(|(t, hash)| (hash_key(&t.name), hash.to_hex().to_string())),
        );
        Ok(map)
    }

    /// Spelt out here, because the crate keeps metadata in a hash map, whose order changes from run to run.
    fn render_with(&self, id: Hash) -> Result<Vec<u8>, String> {
        let broken = |e: serde_json::Error| e.to_string();
        let metadata = serde_json::to_string(&self.metadata_with(id)?).map_err(broken)?;
        let mut json = format!("{{\"__metadata__\":{metadata}");
        for tensor in &self.tensors {
            // Names are plain identifiers, so they need no escapes.
            json += &format!(",\"{}\":{}", tensor.name, serde_json::to_string(&tensor.info).map_err(broken)?);
        }
        json.push('}');
        let len = json.len().next_multiple_of(WORD);
        if len > MAX_HEADER {
            return Err(format!("the header takes {len} bytes, more than {MAX_HEADER}; shorten the recipe"));
        }
        let mut bytes = (len as u64).to_le_bytes().to_vec();
        bytes.extend(json.into_bytes());
        bytes.resize(WORD + len, b' ');
        Ok(bytes)
    }

    /// Reads and checks the header of a whole file; returns it with the offset of the first tensor.
    ///
    /// Touches the header and the axes only.
    pub(crate) fn parse(file: &[u8]) -> Result<(Header, usize), String> {
        let (text, body) = split(file)?;
        let metadata: Metadata = serde_json::from_slice(text)
            .map_err(|e| format!("its header is no safetensors header: {}", plain::json("", &e)))?;
        if metadata.data_len() != body.len() {
            return Err(format!("{} bytes of tensors are announced, {} are there", metadata.data_len(), body.len()));
        }
        let map = metadata.metadata().as_ref().ok_or("it has no metadata")?;
        let (about, axes) = About::from_map(map)?;
        if axes.len() > MAX_AXES {
            return Err(format!("it has {} axes; an atlas has 1 to {MAX_AXES}", axes.len()));
        }
        let axes = axes.iter().map(|axis| axis.build(axis_values(&metadata, &axis.name, body)?));
        let grid = Grid::new(axes.collect::<Result<_, _>>()?).map_err(|e| e.to_string())?;
        let mut header = match about.kind {
            Kind::Nodes => Header::new(about, grid)?,
            Kind::Cells => {
                let length = |name: &str| metadata.info(name).and_then(|info| info.shape.first().copied());
                let (Some(top), Some(words)) = (length(TOP), length(TREES)) else {
                    return Err(format!("it has no tensors `{TOP}` and `{TREES}`"));
                };
                Header::of_cells(about, grid, top, words)?
            }
        };
        for (tensor, hash) in header.tensors.iter().zip(&mut header.hashes) {
            tensor.check(metadata.info(&tensor.name))?;
            let text =
                map.get(&hash_key(&tensor.name)).ok_or_else(|| format!("it has no hash of `{}`", tensor.name))?;
            let wrong = |_| {
                let shown: String = text.chars().take(64).collect();
                format!("the hash of `{}` is {shown:?}; it must be 64 hexadecimal digits", tensor.name)
            };
            *hash = Hash::from_hex(text).map_err(wrong)?;
        }
        let start = file.len() - body.len();
        if header.render()? != file[..start] {
            return Err(
                "its header is not spelt as this version spells it: it is damaged, or another program wrote it".into(),
            );
        }
        Ok((header, start))
    }
}

impl Tensor {
    fn check(&self, found: Option<&TensorInfo>) -> Result<(), String> {
        let TensorInfo { dtype, shape, data_offsets } = &self.info;
        match found {
            Some(f) if (&f.dtype, &f.shape, &f.data_offsets) == (dtype, shape, data_offsets) => Ok(()),
            Some(f) => Err(format!(
                "tensor `{}` is {:?} {:?} at {:?}; its grid and metadata ask for {dtype:?} {shape:?} at \
                 {data_offsets:?}",
                self.name, f.dtype, f.shape, f.data_offsets
            )),
            None => Err(format!("it has no tensor `{}`", self.name)),
        }
    }
}

/// The header's text and the tensors of a file.
fn split(file: &[u8]) -> Result<(&[u8], &[u8]), String> {
    let (len, rest) = file.split_first_chunk::<WORD>().ok_or("it is no atlas: it is shorter than 8 bytes")?;
    let len = u64::from_le_bytes(*len);
    if len > MAX_HEADER as u64 || len % WORD as u64 != 0 {
        return Err(format!(
            "it is no atlas: its first {WORD} bytes announce a header of {len} bytes, where an atlas has a multiple of \
             {WORD} up to {MAX_HEADER}"
        ));
    }
    rest.split_at_checked(len as usize).ok_or_else(|| format!("it ends inside its header of {len} bytes"))
}

fn axis_values(metadata: &Metadata, name: &str, body: &[u8]) -> Result<Vec<f64>, String> {
    check_name("axis", name)?;
    let info = metadata.info(name).ok_or_else(|| format!("it has no tensor for the axis `{name}`"))?;
    if info.dtype != Dtype::F64 || info.shape.len() != 1 {
        return Err(format!("the axis `{name}` is {:?} {:?}; it must be one row of F64", info.dtype, info.shape));
    }
    let bytes = body.get(info.data_offsets.0..info.data_offsets.1).ok_or("a tensor leaves the file")?;
    Ok(bytes.as_chunks().0.iter().map(|b| f64::from_le_bytes(*b)).collect())
}

fn hash_key(tensor: &str) -> String {
    format!("blake3.{tensor}")
}
