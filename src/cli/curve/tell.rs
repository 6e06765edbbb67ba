//! What every family of `curve` tells alike: paths, reasons, other families, samples.

use super::super::{Outcome, output};
use super::{Family, Found, involute, reach};
use serde::Serialize;
use spiral_atlas::family::reach::Kind;
use spiral_atlas::transition::segment::Request;
use spiral_atlas::transition::{Ends, Piece, Station, ph_spiral, spiral, stations};
use spiral_atlas::{Error, Result};

/// An answer as JSON.
#[derive(Debug, Serialize)]
pub struct Told<'f, F: Found> {
    #[serde(flatten)]
    pub found: &'f F,
    /// The path that was asked for; none where there is none.
    paths: Vec<Path>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    #[serde(flatten)]
    others: Option<Others>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<Vec<Station>>,
}

/// A path of spirals. Null stands for what is not finite.
#[derive(Debug, Serialize)]
struct Path {
    length: f64,
    greatest_curvature: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    bending_energy: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    absolute_rotation: Option<f64>,
    pieces: Vec<Piece>,
}

impl Path {
    /// Of pieces whose curvature is monotone, so that it is greatest at an end of one.
    fn new(pieces: Vec<Piece>) -> Path {
        let ends = pieces.iter().flat_map(|piece| piece.range().map(|t| piece.at(t).curvature.abs()));
        let only = match pieces.as_slice() {
            [Piece::PhQuintic(curve)] => Some(*curve),
            _ => None,
        };
        Path {
            length: pieces.iter().map(Piece::length).sum(),
            greatest_curvature: ends.fold(0.0, f64::max),
            bending_energy: only.map(|curve| curve.bending_energy()),
            absolute_rotation: only.map(|curve| curve.absolute_rotation()),
            pieces,
        }
    }

    fn is_finite(&self) -> bool {
        [self.length, self.greatest_curvature].into_iter().chain(self.bending_energy).all(f64::is_finite)
    }
}

/// What is asked of a curve whatever its family.
#[derive(Debug, Clone, Copy)]
pub struct Wish {
    pub family: Family,
    pub longest: Option<f64>,
    pub samples: Option<u32>,
    /// Whether a no comes with advice. In a batch it does not: asking every other family costs far more than the answer.
    pub advice: bool,
}

impl Wish {
    /// The greatest length that counts.
    pub fn longest(self) -> f64 {
        self.longest.unwrap_or(f64::INFINITY)
    }
}

impl<'f, F: Found> Told<'f, F> {
    /// # Errors
    /// [`Error::Domain`] where a number leaves the range of doubles.
    pub fn new(found: &'f F, wish: Wish) -> Result<Told<'f, F>> {
        let (paths, reason) = match found.spirals() {
            Err(why) => (Vec::new(), Some(why)),
            Ok(pieces) => {
                let path = Path::new(pieces);
                match wish.longest.filter(|longest| path.length > *longest) {
                    Some(longest) => (
                        Vec::new(),
                        Some(format!("the curve is {:?} long, more than the {longest:?} that are allowed", path.length)),
                    ),
                    None => (vec![path], None),
                }
            }
        };
        if let Some(path) = paths.iter().find(|path| !path.is_finite()) {
            let Path { length, greatest_curvature, .. } = path;
            return Err(Error::Domain(format!(
                "the curve leaves the range of doubles: its length is {length:?}, its greatest curvature {greatest_curvature:?} (change the \
                 unit of length)"
            )));
        }
        let unsure = found.ends().filter(|_| wish.advice && reason.is_some());
        let others = unsure.map(|ends| Others::new(ends, wish));
        let samples = wish.samples.map(|n| paths.first().map_or(Ok(Vec::new()), |path| stations(&path.pieces, n as usize)));
        Ok(Told { found, paths, reason, others, samples: samples.transpose()? })
    }

    pub fn outcome(&self) -> Outcome {
        if self.reason.is_some() { Outcome::Bad } else { Outcome::Fine }
    }

    /// All of it in words.
    pub fn text(&self) -> String {
        let mut text = match &self.reason {
            Some(reason) if self.found.spirals().is_ok() => format!("{reason}\n"),
            _ => self.found.text(),
        };
        text += &self.others.as_ref().map_or(String::new(), Others::advice);
        if let Some(samples) = self.samples.as_ref().filter(|samples| !samples.is_empty()) {
            text += "\n";
            text += table(samples, ", ").trim_end();
        }
        text + "\n"
    }

    /// The samples alone, as CSV; without any, the reason goes to standard error.
    pub fn csv(&self) -> Result<()> {
        match &self.reason {
            Some(reason) => {
                output::note(reason);
                Ok(())
            }
            None => output::print(&table(self.samples.as_deref().unwrap_or_default(), ",")),
        }
    }
}

/// Samples with their header.
fn table(samples: &[Station], comma: &str) -> String {
    let row = |s: &Station| s.numbers().map(|x| format!("{x:?}")).join(comma);
    let lines = std::iter::once(Station::COLUMNS.join(comma)).chain(samples.iter().map(row));
    lines.map(|line| line + "\n").collect()
}

/// Other families that have a spiral where one has none.
#[derive(Debug, Default, Serialize)]
struct Others {
    /// Those that take the same ends.
    families: Vec<&'static str>,
    /// Commands for a segment added to the straight end, where one of the ends is straight.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    segments: Vec<String>,
}

impl Others {
    /// All families that join two ends by a spiral no longer than allowed, but for the one that was asked: each is asked too. One that
    /// fails counts as none.
    fn new(ends: &Ends, wish: Wish) -> Others {
        let longest = wish.longest();
        let short = |pieces: std::result::Result<Vec<Piece>, String>| {
            pieces.is_ok_and(|pieces| pieces.iter().map(Piece::length).sum::<f64>() <= longest)
        };
        let cubic = || spiral(ends).is_ok_and(|found| short(found.no_longer_than(longest).spirals()));
        let ph = || ph_spiral(ends).is_ok_and(|found| short(found.no_longer_than(longest).spirals()));
        // Where no involute exists no spiral does.
        let involute = || involute::find(ends, [0, 0]).is_ok_and(|found| short(found.spirals()));
        let all: [(Family, &'static str, &dyn Fn() -> bool); 3] =
            [(Family::Cubic, "cubic", &cubic), (Family::PhQuintic, "ph-quintic", &ph), (Family::Involute, "involute", &involute)];
        let families = all.into_iter().filter(|(family, _, has)| *family != wish.family && has()).map(|(_, name, _)| name);
        let segment = Request::between(ends).ok().flatten();
        let added = |kind: Kind| {
            let request = segment.filter(|request| reach::find(kind, request).is_ok_and(|found| short(found.spirals())))?;
            Some(reach::command(kind, &request, ends.end))
        };
        Others { families: families.collect(), segments: [Kind::Cubic, Kind::Ph].into_iter().filter_map(added).collect() }
    }

    /// What to type for them.
    fn advice(&self) -> String {
        let mut text = String::new();
        if !self.families.is_empty() {
            let names: Vec<String> = self.families.iter().map(|name| format!("`--family {name}`")).collect();
            text += &format!("\nanother kind of curve would do: add {}", names.join(" or "));
        }
        for command in &self.segments {
            text += &format!("\na segment that is added to the straight end would do: `{command}`");
        }
        text
    }
}
