//! An atlas without its fields, for stores that keep those in another way.

use super::about::About;
use super::header::Header;
use super::write::{Writer, header_of};
use super::{Atlas, Kind, Spec};
use crate::error::{Error, Result};
use crate::family::Family;
use crate::grid::{Grid, Lookup};
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

/// What an atlas of nodes says about itself, and its grid. It is all of the file but the fields and their hashes.
///
/// ```
/// use spiral_atlas::atlas::{Outline, Spec};
/// use spiral_atlas::family::by_name;
/// use spiral_atlas::grid::{Axis, Grid, Spacing};
///
/// let axis = |name: &str| Axis::new(name, Spacing::Values(vec![0.5, 0.75]));
/// let grid = Grid::new(["phi0", "phi1", "kappa0", "kappa1"].map(axis).into_iter().collect::<Result<_, _>>()?)?;
/// let family = by_name("cubic").unwrap();
/// let outline = Outline::of(&Spec { name: "mine", family, grid: &grid, scalars: &[], recipe: "" })?;
/// let again = Outline::read("somewhere", outline.metadata()?.into_iter().collect(), |axis| {
///     grid.axes().iter().find(|known| known.name() == axis).map(|known| known.values().to_vec())
/// })?;
/// assert_eq!(again.nearest(&[0.51, 0.74, 0.5, 0.5]), Some(4));
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
#[derive(Debug)]
pub struct Outline {
    header: Header,
    lookups: Vec<Lookup>,
}

impl Outline {
    /// The outline of what a specification makes.
    ///
    /// # Errors
    /// Those of [`Writer::size`].
    pub fn of(spec: &Spec) -> Result<Outline> {
        Ok(Outline::new(header_of(spec)?))
    }

    /// The outline of an atlas.
    ///
    /// # Errors
    /// None that a valid atlas can have.
    pub fn of_atlas(atlas: &Atlas) -> Result<Outline> {
        let invalid = |what| Error::Atlas { path: atlas.path().to_owned(), what };
        Ok(Outline::new(Header::new(atlas.about().clone(), atlas.grid().clone()).map_err(invalid)?))
    }

    /// Reads what [`Outline::metadata`] gives, and the values of the axes that it names.
    ///
    /// # Arguments
    /// - `place`: where they are from, for messages.
    ///
    /// # Errors
    /// [`Error::Atlas`], naming `place`, when they are not the metadata and the axes of one atlas of nodes.
    pub fn read(
        place: impl AsRef<Path>,
        metadata: HashMap<String, String>,
        values: impl Fn(&str) -> Option<Vec<f64>>,
    ) -> Result<Outline> {
        let read = || {
            let (about, axes) = About::from_map(&metadata)?;
            if about.kind != Kind::Nodes {
                return Err("it holds cells, not nodes".to_owned());
            }
            let axis = |axis: &super::about::NamedAxis| {
                axis.build(values(&axis.name).ok_or_else(|| format!("it has no values of the axis `{}`", axis.name))?)
            };
            let grid = Grid::new(axes.iter().map(axis).collect::<Result<_, _>>()?).map_err(|e| e.to_string())?;
            let outline = Outline::new(Header::new(about, grid)?);
            // As a header, metadata have one spelling.
            let known = outline.header.about.to_map(&outline.header.grid)?;
            let differs = |(key, text): &(&String, &String)| known.get(*key) != Some(*text);
            match metadata.iter().find(differs) {
                None => Ok(outline),
                Some((key, text)) => Err(format!("its metadata `{key}` is not as this version spells it: {text:?}")),
            }
        };
        read().map_err(|what| Error::Atlas { path: place.as_ref().to_owned(), what })
    }

    fn new(header: Header) -> Outline {
        let lookups = header.grid.axes().iter().map(Lookup::new).collect();
        Outline { header, lookups }
    }

    /// What it says about itself.
    pub fn about(&self) -> &About {
        &self.header.about
    }

    /// The nodes.
    pub fn grid(&self) -> &Grid {
        &self.header.grid
    }

    /// The metadata of the file, without the hashes.
    ///
    /// # Errors
    /// None that an outline can have.
    pub fn metadata(&self) -> Result<BTreeMap<String, String>> {
        self.about().to_map(self.grid()).map_err(Error::invalid)
    }

    /// The family, and which of its scalars there are.
    ///
    /// # Errors
    /// [`Error::Domain`] for a family or a scalar that this program does not have.
    pub fn family(&self) -> Result<(&'static dyn Family, Vec<usize>)> {
        let about = self.about();
        let family = about.family()?;
        let place = |name: &str| family.about().scalars.iter().position(|s| s.name == name);
        let scalar = |s: &super::Named| {
            place(&s.name).ok_or_else(|| {
                Error::invalid(format!("this program knows no scalar `{}` of `{}`", s.name, about.family))
            })
        };
        Ok((family, about.scalars.iter().map(scalar).collect::<Result<_>>()?))
    }

    /// The flat index of the node nearest to a point, as [`Atlas::nearest`] has it.
    #[inline]
    pub fn nearest(&self, point: &[f64]) -> Option<u64> {
        if point.len() != self.lookups.len() {
            return None;
        }
        let axes = self.lookups.iter().zip(point);
        axes.into_iter()
            .try_fold(0, |flat, (lookup, x)| Some(flat * lookup.count() as u64 + lookup.nearest(*x)? as u64))
    }

    /// Opens a file for an atlas of this outline, as [`Writer::create`] does.
    ///
    /// # Errors
    /// As there.
    pub fn create(&self, path: &Path) -> Result<Writer> {
        let header = Header::new(self.about().clone(), self.grid().clone()).map_err(Error::invalid)?;
        Writer::of(path, header)
    }
}
