//! The file of cells: written whole, mapped, checked, looked up.

use super::build::{Built, shape};
use super::tree::{Known, Layout, MOST_AXES, Words};
use super::{Spec, region};
use crate::atlas::header::{Header, ROOTS, TOP, TREES};
use crate::atlas::{About, Kind, Map, map_bytes, map_path};
use crate::error::{Error, Result};
use crate::family::{self, Family};
use crate::files::write_file;
use crate::grid::{Axis, Grid, Lookup};
use blake3::Hash;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Writes cells to a file, which appears whole or not at all.
///
/// # Errors
/// As [`bytes`], and [`Error::Io`] when the system refuses.
pub fn write(path: &Path, spec: &Spec, built: &Built) -> Result<()> {
    write_file(path, &bytes(spec, built)?)
}

/// The bytes of a file of cells.
///
/// # Errors
/// [`Error::Domain`] for a specification that does not fit the cells, or a recipe too long.
pub fn bytes(spec: &Spec, built: &Built) -> Result<Vec<u8>> {
    let domain = |what| Error::invalid(format!("the atlas `{}`: {what}", spec.name));
    let Spec { name, family, grid, recipe, .. } = *spec;
    let about = About::of(&crate::atlas::Spec { name, family, grid, scalars: &[], recipe }).map_err(domain)?;
    let about = About { kind: Kind::Cells, counts: Vec::new(), ..about };
    let mut header = Header::of_cells(about, grid.clone(), 1 << built.shape.top, built.trees.len()).map_err(domain)?;
    let mut body = Vec::with_capacity(header.body_len());
    grid.axes().iter().flat_map(|axis| axis.values()).for_each(|x| body.extend(x.to_le_bytes()));
    built.roots.iter().chain(&built.trees).for_each(|word| body.extend(word.to_le_bytes()));
    body.extend(built.top.as_flattened());
    if body.len() != header.body_len() {
        return Err(domain("its cells are those of another grid".into()));
    }
    let hashes =
        header.tensors.iter().map(|t| blake3::hash(&body[t.info.data_offsets.0..t.info.data_offsets.1])).collect();
    header.hashes = hashes;
    Ok([header.render().map_err(domain)?, body].concat())
}

/// Where the cells lie along an axis.
#[derive(Debug)]
enum Side {
    Divided(Lookup),
    /// At one value alone.
    Single(f64),
}

impl Side {
    fn new(axis: &Axis) -> Side {
        match axis.values() {
            [only] => Side::Single(*only),
            _ => Side::Divided(Lookup::new(axis)),
        }
    }
}

/// A file of cells, mapped into memory and checked; what is said of [`crate::atlas::Atlas`] and changes of an open
/// file holds here, too.
///
/// It may be used from several threads at once, and several processes share its memory.
///
/// ```no_run
/// use spiral_atlas::{cells::Cells, family::cubic::SPIRAL};
/// let cells = Cells::open("out/cells.atlas.safetensors")?;
/// let known = cells.lookup(&[0.7, 1.4, 0.4, 4.0]).expect("inside the box");
/// if known.outside & SPIRAL != 0 {
///     println!("no cubic spiral joins these ends, nor any in the same cell");
/// }
/// let spiral = cells.verdict(&[0.7, 1.4, 0.4, 4.0], SPIRAL)? != 0;
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
#[derive(Debug)]
pub struct Cells {
    path: PathBuf,
    map: Map,
    header: Header,
    body: usize,
    shape: Layout,
    family: &'static dyn Family,
    chart: usize,
    sides: Vec<Side>,
    spread: Box<[u32]>,
    roots: Range<usize>,
    trees: Range<usize>,
    top: Range<usize>,
}

impl Cells {
    /// Maps a file and checks its header, axes and every word of its trees.
    ///
    /// # Errors
    /// [`Error::Io`] when the file cannot be opened or mapped, [`Error::Atlas`] when it is not a valid file of cells.
    pub fn open(path: impl AsRef<Path>) -> Result<Cells> {
        let path = path.as_ref();
        Cells::new(path.to_owned(), map_path(path)?)
    }

    /// Checks a copy of the bytes of a file, as [`Cells::open`] does.
    ///
    /// # Errors
    /// As there, with the path `(memory)`.
    pub fn from_bytes(bytes: &[u8]) -> Result<Cells> {
        let (path, map) = map_bytes(bytes)?;
        Cells::new(path, map)
    }

    fn new(path: PathBuf, map: Map) -> Result<Cells> {
        let invalid = |what| Error::Atlas { path: path.clone(), what };
        let (header, body) = Header::open(&map, Kind::Cells).map_err(invalid)?;
        let about = &header.about;
        let blame = |e: Error| invalid(e.to_string());
        let family = family::by_name(&about.family).map_err(blame)?;
        let (_, chart) = region(family, &header.grid).map_err(blame)?;
        let shape = shape(&header.grid, family.about().flags.len()).map_err(blame)?;
        if !about.flags.iter().map(|f| &f.name[..]).eq(family.about().flags.iter().map(|f| f.name)) {
            return Err(invalid(format!("its flags are not those of `{}`", family.about().name)));
        }
        let place = |name| header.range(name, body).map_err(invalid);
        let (roots, trees, top) = (place(ROOTS)?, place(TREES)?, place(TOP)?);
        if top.len() != 2 * shape.top_cells() {
            return Err(invalid(format!("`{TOP}` has {} bytes; these axes need {}", top.len(), 2 * shape.top_cells())));
        }
        let sides = header.grid.axes().iter().map(Side::new).collect();
        let spread = shape.spread();
        let cells = Cells { path, map, header, body, shape, family, chart, sides, spread, roots, trees, top };
        let checked = cells.words().check();
        checked.map_err(|what| Error::Atlas { path: cells.path.clone(), what })?;
        Ok(cells)
    }

    /// What the cell of a point says of all flags: of each, that it holds at every point of the cell, at none, or
    /// neither.
    ///
    /// No memory is allocated, and nothing is computed that costs more than a few comparisons and reads.
    ///
    /// # Returns
    /// `None` outside the box of the file, for NaN, and for a wrong number of coordinates. A point on a common face
    /// of cells gets one of them; what that says is true, because cells are closed.
    #[inline]
    pub fn lookup(&self, point: &[f64]) -> Option<Known> {
        self.find(point, u8::MAX)
    }

    #[inline]
    fn find(&self, point: &[f64], wanted: u8) -> Option<Known> {
        if point.len() != self.sides.len() {
            return None;
        }
        let mut place = [0u32; MOST_AXES];
        let mut places = place.iter_mut();
        for (side, x) in self.sides.iter().zip(point) {
            match side {
                Side::Divided(lookup) => *places.next()? = lookup.cell(*x)? as u32,
                Side::Single(only) if only == x => {}
                Side::Single(_) => return None,
            }
        }
        let wanted = wanted & ((1u32 << self.shape.flags) - 1) as u8;
        Some(self.words().find(&place[..self.shape.axes], wanted))
    }

    /// The truth about the wanted flags at a point: from its cell where that says it, or else from the family itself.
    ///
    /// # Returns
    /// Those of the wanted flags that hold.
    ///
    /// # Errors
    /// [`Error::Domain`], naming the coordinate, outside the family's domain; [`Error::Undecided`] at the precision
    /// cap.
    pub fn verdict(&self, point: &[f64], wanted: u8) -> Result<u8> {
        let wanted = wanted & self.family.about().all_flags();
        let known = self.find(point, wanted).unwrap_or_default();
        if known.inside | known.outside == wanted {
            return Ok(known.inside);
        }
        if point.len() != self.sides.len() {
            return Err(family::wrong_count(point.len(), self.sides.len()));
        }
        Ok(family::verdict(self.family, self.chart, point)?.flags() & wanted)
    }

    #[inline]
    pub(super) fn words(&self) -> Words<'_> {
        Words {
            shape: self.shape,
            roots: self.map[self.roots.clone()].as_chunks().0,
            trees: self.map[self.trees.clone()].as_chunks().0,
            top: self.map[self.top.clone()].as_chunks().0,
            spread: &self.spread,
        }
    }

    /// The file it was opened from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The edges of the finest cells.
    pub fn grid(&self) -> &Grid {
        &self.header.grid
    }

    /// The family.
    pub fn family(&self) -> &'static dyn Family {
        self.family
    }

    /// Index of the chart of its axes.
    pub fn chart(&self) -> usize {
        self.chart
    }

    /// What it says about itself: family, chart, conventions, legend, recipe.
    pub fn about(&self) -> &About {
        &self.header.about
    }

    /// Cells along each axis of several values.
    pub fn resolution(&self) -> usize {
        1 << self.shape.depth
    }

    /// Bytes of the file.
    pub fn bytes(&self) -> u64 {
        self.map.len() as u64
    }

    /// Name and stated BLAKE3 of each tensor, in file order; whether they are true, [`Cells::check_hashes`] tells.
    pub fn hashes(&self) -> impl Iterator<Item = (&str, Hash)> {
        self.header.tensors.iter().map(|t| &t.name[..]).zip(self.header.hashes.iter().copied())
    }

    /// The hash that stands for the whole file once [`Cells::check_hashes`] has found those of the tensors true.
    ///
    /// # Errors
    /// [`Error::Atlas`]; none is known.
    pub fn id(&self) -> Result<Hash> {
        self.header.id().map_err(|what| Error::Atlas { path: self.path.clone(), what })
    }

    /// Reads the whole file: the BLAKE3 of every tensor.
    ///
    /// # Errors
    /// [`Error::Atlas`] that names the first tensor that is not what it should be.
    pub fn check_hashes(&self) -> Result<()> {
        for (name, stated) in self.hashes() {
            let found = blake3::hash(&self.map[self.header.range(name, self.body).unwrap_or_default()]);
            if found != stated {
                let what = format!("the BLAKE3 of `{name}` is {found}, not {stated}: its bytes were damaged");
                return Err(Error::Atlas { path: self.path.clone(), what });
            }
        }
        Ok(())
    }
}
