//! The atlas file: one `safetensors` file, written as a stream, mapped and looked up.
//!
//! | tensor | type | shape |
//! | --- | --- | --- |
//! | one per axis, named like it | F64 | `[count]` |
//! | one per scalar of the recipe | F32 | the grid's |
//! | `flags` | U8 | the grid's |
//! | `solutions` | U8 | the grid's |
//!
//! in this order, without gaps, each aligned to its type; first axis slowest. The metadata maps text to text;
//! structured values are JSON:
//!
//! | key | value |
//! | --- | --- |
//! | `format`, `format_version` | `spiral-atlas`, [`FORMAT_VERSION`] |
//! | `generator` | the program and its version |
//! | `name`, `recipe` | the atlas's name in the recipe, the recipe's text |
//! | `family`, `conventions` | the family; frame, signs and units |
//! | `chart`, `chart_doc` | which axes; what they are, with units |
//! | `axes` | `[{"name", "spacing": "linear"\|"log"\|"values"}]`, slowest first |
//! | `flags` | `[{"name", "doc"}]`, bit 0 first |
//! | `counts` | `[{"name", "doc", "shift", "bits"}]` of a `solutions` byte |
//! | `scalars`, `no_value` | `[{"name", "doc"}]`; what a scalar holds where there is no value |
//! | `blake3` | BLAKE3 of the first bytes of the file, up to the tensors, with these 64 digits zero: the atlas's id |
//! | `blake3.NAME` | BLAKE3 of the tensor's bytes, 64 hexadecimal digits |
//!
//! The bytes are a function of the recipe, the atlas's name and the generator's version.

mod about;
mod fault;
pub(crate) mod header;
mod map;
mod outline;
pub mod verify;
mod write;

pub use about::{About, FORMAT_VERSION, Kind, Named, Packed, Spec};
use map::{MEMORY, map_file};
pub(crate) use map::{Map, map_bytes, map_path};
pub use outline::Outline;
pub use write::{Writer, Written};

use crate::error::{Error, Result};
use crate::files::Draft;
use crate::grid::{Grid, Lookup};
use blake3::Hash;
use header::{FLAGS, Header, SOLUTIONS};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The verdicts of one node; see [`Atlas::about`] for what the bits mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Entry {
    /// The `flags` byte.
    pub flags: u8,
    /// The `solutions` byte.
    pub solutions: u8,
}

/// An atlas file, mapped into memory and checked.
///
/// The fields are read from the file when they are looked at. So the file must not be changed in place, nor shortened,
/// while it is open: lookups would give what was written (memory stays safe, but the atlas may then lie), and on Unix
/// touching a part that is cut off ends the process (SIGBUS). This crate never changes a file in place: [`Writer`]
/// replaces it as a whole, which leaves open atlases as they were.
///
/// ```no_run
/// let atlas = spiral_atlas::atlas::Atlas::open("quickstart.safetensors")?;
/// if let Some((node, entry)) = atlas.nearest(&[0.7, 1.4, 0.4, 4.0]) {
///     let holds = |bit: &usize| entry.flags >> bit & 1 == 1;
///     let names: Vec<&str> = atlas.flag_names().enumerate().filter(|(bit, _)| holds(bit)).map(|f| f.1).collect();
///     println!("{}: {}", atlas.grid().describe(node), names.join(" "));
/// }
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
#[derive(Debug)]
pub struct Atlas {
    path: PathBuf,
    map: Map,
    header: Header,
    body: usize,
    flags: Range<usize>,
    solutions: Range<usize>,
    lookups: Vec<Lookup>,
    metadata: BTreeMap<String, String>,
    id: Hash,
    /// The file, where it goes with the atlas: after the map, because some systems keep a file that is mapped.
    _draft: Option<Draft>,
}

impl Atlas {
    /// Maps a file and checks its header and axes: sizes, types, shapes, order, names, version, finite increasing axes
    /// that are what their spacing says. The fields' own bytes are left alone; [`Atlas::check_hashes`] reads those.
    ///
    /// # Errors
    /// [`Error::Io`] when the file cannot be opened or mapped, [`Error::Atlas`] when it is not a valid atlas.
    pub fn open(path: impl AsRef<Path>) -> Result<Atlas> {
        let path = path.as_ref();
        Atlas::new(path.to_owned(), map_path(path)?)
    }

    /// Opens a file that has no place and goes with the atlas; `path` is the place it would have had.
    pub(crate) fn of_draft(path: PathBuf, mut draft: Draft) -> Result<Atlas> {
        let map = map_file(&path, draft.file())?;
        Ok(Atlas { _draft: Some(draft), ..Atlas::new(path, map)? })
    }

    /// Checks a copy of the bytes of a file, as [`Atlas::open`] does.
    ///
    /// # Errors
    /// [`Error::Atlas`], with the path `(memory)`, when they are not a valid atlas; [`Error::Io`] when memory is short.
    pub fn from_bytes(bytes: &[u8]) -> Result<Atlas> {
        let (path, map) = map_bytes(bytes)?;
        Atlas::new(path, map)
    }

    fn new(path: PathBuf, map: Map) -> Result<Atlas> {
        let invalid = |what| Error::Atlas { path: path.clone(), what };
        let (header, body) = Header::open(&map, Kind::Nodes).map_err(invalid)?;
        let place = |name| header.range(name, body).map_err(invalid);
        let (flags, solutions) = (place(FLAGS)?, place(SOLUTIONS)?);
        let (metadata, id) = (header.metadata().map_err(invalid)?, header.id().map_err(invalid)?);
        let lookups = header.grid.axes().iter().map(Lookup::new).collect();
        Ok(Atlas { map, header, body, flags, solutions, lookups, metadata, id, path, _draft: None })
    }

    /// The file it was opened from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The nodes.
    pub fn grid(&self) -> &Grid {
        &self.header.grid
    }

    /// What it says about itself: family, chart, conventions, legend, recipe.
    pub fn about(&self) -> &About {
        &self.header.about
    }

    /// The family's name.
    pub fn family_name(&self) -> &str {
        &self.about().family
    }

    /// The chart's name.
    pub fn chart_name(&self) -> &str {
        &self.about().chart
    }

    /// The names of the bits of `flags`, bit 0 first.
    pub fn flag_names(&self) -> impl Iterator<Item = &str> {
        self.about().flags.iter().map(|f| &f.name[..])
    }

    /// The numbers packed in `solutions`.
    pub fn counts(&self) -> &[Packed] {
        &self.about().counts
    }

    /// The names of the scalar fields, in file order.
    pub fn scalar_names(&self) -> impl Iterator<Item = &str> {
        self.about().scalars.iter().map(|s| &s.name[..])
    }

    /// The text of the recipe it was made from.
    pub fn recipe_text(&self) -> &str {
        &self.about().recipe
    }

    /// All metadata of the file.
    pub fn metadata(&self) -> &BTreeMap<String, String> {
        &self.metadata
    }

    /// The hash that stands for the whole atlas, legend and recipe included: atlases of one id are equal, byte for
    /// byte.
    ///
    /// True once [`Atlas::check_hashes`] has found the tensors' hashes true.
    pub fn id(&self) -> Hash {
        self.id
    }

    /// Name and stated BLAKE3 of each tensor, in file order; whether they are true, [`Atlas::check_hashes`] says.
    pub fn hashes(&self) -> impl Iterator<Item = (&str, Hash)> {
        self.header.tensors.iter().map(|t| &t.name[..]).zip(self.header.hashes.iter().copied())
    }

    /// The `flags` of every node, in flat order.
    #[inline]
    pub fn flags(&self) -> &[u8] {
        &self.map[self.flags.clone()]
    }

    /// The `solutions` of every node, in flat order.
    #[inline]
    pub fn solutions(&self) -> &[u8] {
        &self.map[self.solutions.clone()]
    }

    /// A scalar of every node, in flat order; [`crate::family::NO_VALUE`] where a node has none.
    pub fn scalar(&self, name: &str) -> Option<&[f32]> {
        self.scalar_names().find(|known| *known == name)?;
        let bytes = self.tensor(name)?;
        // SAFETY: every bit pattern is a valid f32, and `align_to` gives only aligned, whole numbers.
        let (before, values, after) = unsafe { bytes.align_to::<f32>() };
        (before.is_empty() && after.is_empty()).then_some(values)
    }

    /// Reads the whole file: the BLAKE3 of every tensor, no bit without a name, no scalar that is not finite.
    ///
    /// # Errors
    /// [`Error::Atlas`] that names the first tensor that is not what it should be.
    pub fn check_hashes(&self) -> Result<()> {
        for (name, stated) in self.hashes() {
            let found = blake3::hash(self.tensor(name).unwrap_or_default());
            if found != stated {
                let what = format!("the BLAKE3 of `{name}` is {found}, not {stated}: its bytes were damaged");
                return Err(self.invalid(what));
            }
        }
        let about = self.about();
        let bits = fault::bits(FLAGS, self.flags(), about.flag_bits());
        let bits = bits.and_then(|()| fault::bits(SOLUTIONS, self.solutions(), about.count_bits()));
        let mut names = self.scalar_names();
        let all =
            bits.and_then(|()| names.try_for_each(|name| fault::finite(name, self.scalar(name).unwrap_or_default())));
        all.map_err(|what| self.invalid(what))
    }

    /// The verdicts at a node; `None` when an index is out of range or their number is wrong.
    #[inline]
    pub fn at(&self, index: &[usize]) -> Option<Entry> {
        self.entry(self.flat(index, |lookup, i| (*i < lookup.count()).then_some(*i))?)
    }

    /// Flat index and verdicts of the node nearest to a point, along each axis; of two equally near the lower one.
    ///
    /// A verdict holds at its node; how far it holds around the node, an atlas does not know.
    ///
    /// # Returns
    /// `None` when the point does not belong to the grid: a coordinate is NaN or lies outside an axis by more than half
    /// the step at that end, or their number is wrong. An axis of a single value accepts that value alone.
    #[inline]
    pub fn nearest(&self, coordinates: &[f64]) -> Option<(u64, Entry)> {
        let flat = self.flat(coordinates, |lookup, x| lookup.nearest(*x))?;
        Some((flat as u64, self.entry(flat)?))
    }

    /// The flat index from one argument for each axis. What [`Grid::flat`] does, without leaving the lookups' memory.
    #[inline]
    fn flat<T>(&self, arguments: &[T], index: impl Fn(&Lookup, &T) -> Option<usize>) -> Option<usize> {
        if arguments.len() != self.lookups.len() {
            return None;
        }
        // The product of the counts is the length of a tensor, so this stays below it.
        self.lookups
            .iter()
            .zip(arguments)
            .try_fold(0, |flat, (lookup, x)| Some(flat * lookup.count() + index(lookup, x)?))
    }

    #[inline]
    fn entry(&self, node: usize) -> Option<Entry> {
        Some(Entry { flags: *self.flags().get(node)?, solutions: *self.solutions().get(node)? })
    }

    fn tensor(&self, name: &str) -> Option<&[u8]> {
        self.map.get(self.header.range(name, self.body).ok()?)
    }

    fn invalid(&self, what: String) -> Error {
        Error::Atlas { path: self.path.clone(), what }
    }
}

/// What the file of a path holds: nodes, which [`Atlas`] opens, or cells, which [`crate::cells::Cells`] opens.
///
/// # Errors
/// Those of [`Atlas::open`].
pub fn kind(path: impl AsRef<Path>) -> Result<Kind> {
    let path = path.as_ref();
    let map = map_path(path)?;
    Header::parse(&map)
        .map(|(header, _)| header.about.kind)
        .map_err(|what| Error::Atlas { path: path.to_owned(), what })
}

/// [`kind`] of the bytes of a file.
///
/// # Errors
/// [`Error::Atlas`], with the path `(memory)`, when they are no atlas.
pub fn kind_of(bytes: &[u8]) -> Result<Kind> {
    let invalid = |what| Error::Atlas { path: PathBuf::from(MEMORY), what };
    Header::parse(bytes).map(|(header, _)| header.about.kind).map_err(invalid)
}
