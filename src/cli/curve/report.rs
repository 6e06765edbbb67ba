//! What every family of `curve` reports alike: paths, reasons, other families, samples.

use super::super::numbers::are_radii;
use super::super::{Outcome, output};
use super::Reportable;
use serde::{Serialize, Serializer};
use spiral_atlas::Result;
use spiral_atlas::family::reach;
use spiral_atlas::path::{Course, Summary};
use spiral_atlas::transition::segment::{Base, Request};
use spiral_atlas::transition::{Ends, Others, Piece, Station};
use std::io::Write;

/// An answer as JSON.
#[derive(Debug, Serialize)]
pub(super) struct Report<'f, F: Reportable> {
    #[serde(flatten)]
    pub found: &'f F,
    /// The path that was asked for; none where there is none.
    paths: Vec<Path>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Whether curvatures are meant as radii; the reason asks it too.
    #[serde(skip)]
    ask: Option<String>,
    #[serde(flatten)]
    advice: Option<Advice>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<Vec<Station>>,
}

/// A path of spirals.
#[derive(Debug, Serialize)]
struct Path {
    #[serde(flatten)]
    summary: Summary,
    #[serde(rename = "pieces", serialize_with = "pieces")]
    course: Course,
}

fn pieces<S: Serializer>(course: &Course, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    course.pieces().serialize(serializer)
}

impl Path {
    /// # Errors
    /// Those of [`Course::new`], and [`Error::Domain`] where another number leaves the range of doubles.
    fn new(pieces: Vec<Piece>) -> Result<Path> {
        let course = Course::new(pieces)?;
        Ok(Path { summary: course.summary().finite()?, course })
    }

    /// Points at equal lengths. The curvature of an end that is straight by the question is 0.
    ///
    /// There the first two sides of the polygon, or the first two numbers of the pre-image, are multiples of each
    /// other. Turned into the user's frame each of their coordinates has a few roundings, so their cross product is no
    /// 0 but up to 2^-51 of the product of their lengths a and b. The curvature shown is some b 2^-51 over a²: a
    /// rounding of this frame, and nothing of the curve.
    fn stations(&self, count: u32, found: &impl Reportable) -> Result<Vec<Station>> {
        let mut all = self.course.stations(count as usize)?;
        let last = all.len() - 1;
        for (place, straight) in [0, last].into_iter().zip(found.straight()) {
            if straight {
                all[place].curvature = 0.0;
            }
        }
        Ok(all)
    }
}

/// What is asked of a curve whatever its kind.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wish {
    pub longest: Option<f64>,
    pub samples: Option<u32>,
    /// Whether a no comes with advice. In a batch it does not: asking every other kind costs far more than the answer.
    pub advice: bool,
}

impl Wish {
    /// The greatest length that counts.
    pub(super) fn longest(self) -> f64 {
        self.longest.unwrap_or(f64::INFINITY)
    }
}

impl<'f, F: Reportable> Report<'f, F> {
    /// # Errors
    /// [`Error::Domain`] where a number leaves the range of doubles.
    pub(super) fn new(found: &'f F, wish: Wish) -> Result<Report<'f, F>> {
        let (paths, reason) = match found.spirals().map(Path::new) {
            Err(why) => (Vec::new(), Some(why)),
            Ok(path) => {
                let path = path?;
                let length = path.summary.length;
                match wish.longest.filter(|longest| length > *longest) {
                    Some(longest) => (
                        Vec::new(),
                        Some(format!("the curve is {length:?} long, more than the {longest:?} that are allowed")),
                    ),
                    None => (vec![path], None),
                }
            }
        };
        let asked = found.between().filter(|_| reason.is_some()).map(|(ends, _)| ends);
        let ask = asked.and_then(|e| are_radii(e.start, e.end, [e.start_curvature, e.end_curvature]));
        let reason = reason.map(|why| ask.as_ref().map_or(why.clone(), |ask| format!("{why}; {ask}")));
        let unsure = found.between().filter(|_| wish.advice && reason.is_some());
        let advice = unsure.map(|(ends, kind)| Advice::new(&Others::new(ends, kind, wish.longest()), ends));
        let samples = wish.samples.map(|n| paths.first().map_or(Ok(Vec::new()), |path| path.stations(n, found)));
        Ok(Report { found, paths, reason, ask, advice, samples: samples.transpose()? })
    }

    pub(super) fn outcome(&self) -> Outcome {
        if self.reason.is_some() { Outcome::Bad } else { Outcome::Fine }
    }

    /// Prints all of it in words.
    pub(super) fn text(&self) -> Result<()> {
        let mut text = match &self.reason {
            Some(reason) if self.found.spirals().is_ok() => reason.clone(),
            _ => self.found.text().trim_end().to_owned(),
        };
        text += &self
            .ask
            .as_ref()
            .filter(|_| self.found.spirals().is_err())
            .map_or(String::new(), |ask| format!("\n{ask}"));
        text += &self.advice.as_ref().map_or(String::new(), Advice::text);
        output::stream(|out| {
            writeln!(out, "{text}")?;
            match self.samples.as_ref().filter(|samples| !samples.is_empty()) {
                Some(samples) => output::table(out, samples, ", "),
                None => Ok(()),
            }
        })
    }

    /// The samples alone, as CSV; without any, the reason goes to standard error.
    pub(super) fn csv(&self) -> Result<()> {
        match &self.reason {
            Some(reason) => {
                output::note(reason);
                Ok(())
            }
            None => output::stream(|out| output::table(out, self.samples.as_deref().unwrap_or_default(), ",")),
        }
    }
}

/// What else would do, as it is printed.
#[derive(Debug, Serialize)]
struct Advice {
    /// Those that take the same ends.
    families: Vec<&'static str>,
    /// Commands for a segment added to the straight end, where one of the ends is straight.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    segments: Vec<String>,
}

impl Advice {
    fn new(others: &Others, ends: &Ends) -> Advice {
        Advice {
            families: others.kinds.iter().map(|kind| kind.name()).collect(),
            segments: others.segments.iter().map(|(kind, request)| command(*kind, request, ends.end)).collect(),
        }
    }

    /// What to type for them.
    fn text(&self) -> String {
        let mut text = String::new();
        if !self.families.is_empty() {
            let names: Vec<String> = self.families.iter().map(|name| format!("`curve {name}`")).collect();
            text += &format!("\nanother kind of curve would do: {}", names.join(" or "));
        }
        for command in &self.segments {
            text += &format!("\na segment that is added to the straight end would do: `{command}`");
        }
        text
    }
}

/// What to type for a segment that ends at a point.
fn command(kind: reach::Kind, request: &Request, to: [f64; 2]) -> String {
    let Request { base, start, direction, turn, radius, theta, .. } = request;
    let base = if *base == Base::Line { "line" } else { "circle" };
    format!(
        "spiral-atlas curve {} --base {base} --from={:?},{:?} --start-direction={direction:?} --turn {turn} --radius \
         {radius:?} --angle {theta:?} --to={:?},{:?}",
        kind.name(),
        start[0],
        start[1],
        to[0],
        to[1]
    )
}
