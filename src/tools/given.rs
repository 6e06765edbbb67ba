//! What is asked of paths that are given.

use super::Tool;
use super::input::objects;
use crate::error::{Error, Result};
use crate::path::{Course, Motion, OffsetCurve, Separation, Spot, Summary, Verdict, kept, separations};
use crate::plain::count;
use crate::transition::{Piece, Station};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

/// A path as all tools report it.
#[derive(Debug, Clone, Deserialize)]
#[serde(from = "RawPath")]
pub struct GivenPath {
    /// In order.
    pub pieces: Vec<Piece>,
}

/// The same, and when and how fast a vehicle travels along it.
#[derive(Debug, Clone, Deserialize)]
#[serde(from = "RawPath")]
pub struct Vehicle {
    /// Its path.
    pub pieces: Vec<Piece>,
    /// Its constant speed; 1 where it is left out.
    pub speed: f64,
    /// When it starts; 0 where it is left out.
    pub start_time: f64,
}

/// All fields that a path may have. Those that reports have beside the pieces say nothing new, and any other is a
/// mistake.
#[derive(Deserialize)]
#[serde(rename = "path", deny_unknown_fields)]
#[expect(dead_code, reason = "what reports have is only let pass")]
struct RawPath {
    #[serde(deserialize_with = "objects")]
    pieces: Vec<Piece>,
    speed: Option<f64>,
    start_time: Option<f64>,
    length: Option<IgnoredAny>,
    greatest_curvature: Option<IgnoredAny>,
    curvature_at_most: Option<IgnoredAny>,
    curvature_range: Option<IgnoredAny>,
    rate_range: Option<IgnoredAny>,
    bending_energy: Option<IgnoredAny>,
    absolute_rotation: Option<IgnoredAny>,
    candidates: Option<IgnoredAny>,
    best: Option<IgnoredAny>,
    paper: Option<IgnoredAny>,
    length_saved: Option<IgnoredAny>,
    clearance: Option<IgnoredAny>,
    polyline: Option<IgnoredAny>,
    corners: Option<IgnoredAny>,
    samples: Option<IgnoredAny>,
}

impl From<RawPath> for GivenPath {
    fn from(raw: RawPath) -> GivenPath {
        GivenPath { pieces: raw.pieces }
    }
}

impl From<RawPath> for Vehicle {
    fn from(RawPath { pieces, speed, start_time, .. }: RawPath) -> Vehicle {
        Vehicle { pieces, speed: speed.unwrap_or(1.0), start_time: start_time.unwrap_or(0.0) }
    }
}

/// The motions of vehicles, each of which stands at a place of the request that errors name.
///
/// # Errors
/// [`Error::Domain`] for fewer than two; those of [`Motion::new`].
pub fn motions(vehicles: Vec<(String, Vehicle)>) -> Result<Vec<Motion>> {
    if vehicles.len() < 2 {
        let paths = count(vehicles.len(), "path");
        return Err(Error::invalid(format!("`paths` has {paths}; it takes two to be apart")));
    }
    let motion =
        |(place, of): (String, Vehicle)| Motion::new(of.pieces, of.speed, of.start_time).map_err(|e| e.at(place));
    vehicles.into_iter().map(motion).collect()
}

/// Whether vehicles keep a distance.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Apart {
    /// Two at least.
    #[serde(deserialize_with = "objects")]
    pub paths: Vec<Vehicle>,
    /// The distance to keep.
    pub minimum: f64,
}

/// How near vehicles come.
#[derive(Debug, Serialize)]
pub struct Separations {
    /// The distance to keep.
    pub minimum: f64,
    /// Of all pairs: the worst.
    #[serde(serialize_with = "kept")]
    pub verdict: Verdict,
    /// Each two.
    pub pairs: Vec<Pair>,
}

/// Two vehicles.
#[derive(Debug, Serialize)]
pub struct Pair {
    /// Index of one.
    pub first: usize,
    /// Index of the other, which is larger.
    pub second: usize,
    /// What is known of them.
    #[serde(flatten)]
    pub found: Separation,
}

impl Separations {
    /// Of the motions of vehicles.
    ///
    /// # Errors
    /// [`Error::Domain`] for a minimum that is negative or not finite.
    pub fn new(motions: &[Motion], minimum: f64) -> Result<Separations> {
        let found = separations(motions, minimum)?;
        let verdict = Verdict::all(found.iter().map(|(_, _, found)| found.verdict));
        let pairs = found.into_iter().map(|(first, second, found)| Pair { first, second, found }).collect();
        Ok(Separations { minimum, verdict, pairs })
    }

    /// The least separation of all pairs is no more than this.
    pub fn least(&self) -> f64 {
        self.pairs.iter().map(|pair| pair.found.closest.at_most).fold(f64::INFINITY, f64::min)
    }
}

/// At all times, proved.
impl Tool for Apart {
    type Answer = Separations;

    fn answer(self) -> Result<Separations> {
        let placed = (0..).zip(self.paths).map(|(i, vehicle)| (format!("paths[{i}]"), vehicle));
        Separations::new(&motions(placed.collect())?, self.minimum)
    }
}

/// Numbers, places and offset curves of paths.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measure {
    /// One or more.
    #[serde(deserialize_with = "objects")]
    pub paths: Vec<GivenPath>,
    /// So many points at equal steps of length, both ends included.
    pub samples: Option<u32>,
    /// Distance of an offset curve, positive to the left.
    pub offset: Option<f64>,
}

/// What was measured.
#[derive(Debug, Serialize)]
pub struct Measures {
    /// Of each path.
    pub paths: Vec<Measured>,
}

/// A path, measured.
#[derive(Debug, Serialize)]
pub struct Measured {
    /// In a few numbers.
    #[serde(flatten)]
    pub summary: Summary,
    /// Where its curvature is extreme.
    pub curvature_extrema: Vec<Spot>,
    /// Where its curvature changes its sign.
    pub inflections: Vec<Spot>,
    /// As many as were asked for.
    pub samples: Vec<Station>,
    /// Where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset: Option<Vec<OffsetCurve>>,
}

impl Measured {
    /// Of a path.
    ///
    /// # Errors
    /// [`Error::Domain`] for numbers of samples outside 2 to [`crate::transition::MOST_SAMPLES`], and for an offset
    /// that is not finite.
    pub fn new(course: &Course, samples: Option<u32>, offset: Option<f64>) -> Result<Measured> {
        Ok(Measured {
            summary: course.summary(),
            curvature_extrema: course.curvature_extrema(),
            inflections: course.inflections(),
            samples: samples.map_or(Ok(vec![]), |count| course.stations(count as usize))?,
            offset: offset.map(|d| course.offset(d)).transpose()?,
        })
    }
}

/// Of each path in turn.
impl Tool for Measure {
    type Answer = Measures;

    fn answer(self) -> Result<Measures> {
        let (samples, offset) = (self.samples, self.offset);
        let measured = |(i, path): (usize, GivenPath)| {
            Course::new(path.pieces)
                .and_then(|course| Measured::new(&course, samples, offset))
                .map_err(|e| e.at(format!("paths[{i}]")))
        };
        Ok(Measures { paths: self.paths.into_iter().enumerate().map(measured).collect::<Result<_>>()? })
    }
}
