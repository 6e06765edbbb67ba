//! Paths of bounded curvature among polygons: the shortest polyline whose corners can be rounded, rounded.
//!
//! Places beside the vertices of obstacles, visibility, the search and the rounding are guesses; [`prove`] has the last
//! word.

mod obstacles;
mod open;
mod parted;
mod places;
mod proof;
mod round;
mod search;
#[cfg(test)]
mod work;

use super::{ROUNDINGS, Turn, check_joined, distance, finite};
use crate::curve::PhQuintic;
use crate::curve::vector::sub;
use crate::error::{Error, OTHER_UNIT, Result};
use obstacles::{Obstacles, to_segment};
use open::open;
use parted::parted;
use places::{Place, places};
pub use proof::Clearance;
use proof::clearance;
use round::Polyline;
use search::{Limits, Search, SearchResult, Why};

/// The clearance is enclosed to this share of the size of the scene.
const TOLERANCE: f64 = 1e-9;
/// Corner curves have at least this share of the size of the scene.
const LEAST_REACH: f64 = 1e-9;
/// Scenes within which no square leaves the range of doubles.
const SIZES: [f64; 2] = [1e-100, 1e100];
/// How much further off places are, in least radii, where those beside vertices and in the open give no path: one
/// distance after the other, then several.
const WIDE: [f64; 12] = [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
const SEVERAL: [f64; 4] = [0.5, 1.0, 2.0, 4.0];
/// How close directions from start and goal to places in the open may be, radians: first few, which one search tells
/// from each other whatever they see, then many.
const CLOSE: [f64; 2] = [0.5, 0.15];
/// Work for all searches but the first, some seconds, and for those after there is a path.
const WORK: usize = 8_000_000;
const MORE: usize = 1_000_000;
/// Sides that the first search looks at: so many, and so many for each vertex. Scattered obstacles take 800 a vertex
/// where they have 1,000 vertices, and 3,500 where they have 10,000; only sides that crowd along many lines take more
/// than twice that.
const SIDES_LOOKED_AT: [usize; 2] = [2_000_000, 6_000];
/// Paths this much longer than without a limit of curvature are detours: then there may be shorter ones further off.
const DETOUR: f64 = 2.0;

/// Where to go, and what is in the way.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with start, goal, obstacles, clearance and greatest_curvature")]
pub struct Scene {
    /// Where the path starts, in any direction.
    pub start: [f64; 2],
    /// Where it ends, elsewhere.
    pub goal: [f64; 2],
    /// Polygons by their vertices, in either orientation; each simple, but they may touch and overlap each other.
    pub obstacles: Vec<Vec<[f64; 2]>>,
    /// Distance to keep from all obstacles, at least 0; with 0 the path still touches none.
    pub clearance: f64,
    /// Greatest curvature of the path, above 0.
    pub greatest_curvature: f64,
}

/// A rounded corner.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Corner {
    /// The corner of the polyline.
    pub at: [f64; 2],
    /// The obstacle that it leads around; nothing for one in the open, where the path only needs room to turn.
    pub obstacle: Option<usize>,
    /// The vertex of that obstacle; for a gentle bend of several, where the sides around it would meet.
    pub vertex: Option<[f64; 2]>,
    /// Turning angle, radians, positive to the left.
    pub turning_angle: f64,
    /// Distance from the corner to the ends of its curve.
    pub reach: f64,
    /// Index of the curve among the spans; among the pieces in JSON.
    #[serde(rename = "piece")]
    pub span: usize,
}

/// A path and what is proved of it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Plan {
    /// Lines and corner curves in turn; they join with the same direction and without curvature.
    pub spans: Vec<PhQuintic>,
    /// The polyline that was rounded.
    pub polyline: Vec<[f64; 2]>,
    /// Its corners.
    pub corners: Vec<Corner>,
    /// How much shorter the path is than the polyline.
    pub length_saved: f64,
    /// What is proved.
    pub proof: Proof,
}

/// What is proved of a path, roundings included.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Proof {
    /// No point has a curvature above this.
    pub curvature_at_most: f64,
    /// The least distance from an obstacle; nothing without obstacles.
    pub clearance: Option<Clearance>,
}

impl Scene {
    fn size(&self) -> f64 {
        let points = self.obstacles.iter().flatten().chain([&self.start, &self.goal]);
        points.flatten().fold(0.0f64, |most, x| most.max(x.abs()))
    }

    /// Checks numbers and polygons.
    fn check(&self) -> Result<Obstacles> {
        let numbers: [(&str, &[f64]); 4] = [
            ("start", &self.start),
            ("goal", &self.goal),
            ("clearance", &[self.clearance]),
            ("greatest_curvature", &[self.greatest_curvature]),
        ];
        for (name, numbers) in numbers {
            finite("plan", name, numbers)?;
        }
        let (clearance, most, size) = (self.clearance, self.greatest_curvature, self.size());
        if clearance < 0.0 {
            return fail(format!("`clearance` is {clearance:?}; a distance is at least 0"));
        }
        if most <= 0.0 {
            return fail(format!("`greatest_curvature` is {most:?}; it must be above 0"));
        }
        if self.start == self.goal {
            return fail(format!("`start` and `goal` are both {:?}; a path needs different ends", self.start));
        }
        let obstacles = Obstacles::new(&self.obstacles)?;
        if !(SIZES[0]..=SIZES[1]).contains(&size) {
            return fail(format!("coordinates go up to {size:?}; {OTHER_UNIT} to bring them within 1e-100 and 1e100"));
        }
        for (name, point) in [("start", self.start), ("goal", self.goal)] {
            self.check_end(name, point, &obstacles)?;
        }
        Ok(obstacles)
    }

    fn check_end(&self, name: &str, point: [f64; 2], obstacles: &Obstacles) -> Result<()> {
        if let Some(i) = obstacles.holding(point) {
            return fail(format!("`{name}` {point:?} lies in or on obstacles[{i}]"));
        }
        let Some(side) = obstacles.nearest(point) else { return Ok(()) };
        let (away, i) = (to_segment(point, side.ends), side.obstacle);
        if away < self.limits().keep {
            let clearance = self.clearance;
            return fail(format!(
                "`{name}` {point:?} is {away:?} away from obstacles[{i}]; it must be further than the clearance \
                 {clearance:?}"
            ));
        }
        Ok(())
    }

    fn limits(&self) -> Limits {
        let size = self.size();
        let least_reach = LEAST_REACH * size;
        // Walls kept at this distance are proved to be at the clearance: what [`clearance`] takes off is less.
        let keep = self.clearance + 32.0 * ROUNDINGS * size;
        Limits { clearance: self.clearance, keep, most: self.greatest_curvature.min(1.0 / least_reach), least_reach }
    }
}

/// Plans a path among obstacles: a short polyline around their vertices whose corners are rounded by PH quintics
/// (Farouki et al., (15)-(21)).
///
/// Each corner stands where the sharpest turn around its vertex would keep the clearance at the greatest curvature, or
/// a part of that turn. Its curve is then as large as its legs and the obstacles allow. The polyline is the shortest
/// with its corners at such places that can be rounded; where there is none, or it is a large detour, places in the
/// open and further off are tried.
///
/// # Accuracy
/// What [`prove`] says. The path is not the shortest of all paths of bounded curvature.
///
/// # Errors
/// [`Error::Domain`] naming what is wrong with the scene. [`Error::NoPath`] naming the corner that cannot be rounded,
/// or why else none was found; "every way is blocked" alone proves that there is no path.
///
/// ```
/// use spiral_atlas::path::{Scene, plan};
/// let square = vec![[1.0, -1.0], [2.0, -1.0], [2.0, 1.0], [1.0, 1.0]];
/// let (start, goal, obstacles) = ([0.0, 0.0], [3.0, 0.0], vec![square]);
/// let scene = Scene { start, goal, obstacles, clearance: 0.1, greatest_curvature: 5.0 };
/// let plan = plan(&scene)?;
/// assert_eq!((plan.corners.len(), plan.spans.len()), (2, 5));
/// assert!(plan.proof.curvature_at_most <= 5.0 && plan.proof.clearance.unwrap().at_least >= 0.1);
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn plan(scene: &Scene) -> Result<Plan> {
    let obstacles = scene.check()?;
    let limits = scene.limits();
    let path = route(scene, &obstacles, limits)?;
    let points: Vec<[f64; 2]> = path.iter().map(|place| place.at).collect();
    let turns = points.windows(3).map(|w| Turn::new(sub(w[1], w[0]), sub(w[2], w[1])));
    // The search took the same turns.
    let turns = turns.collect::<Option<Vec<Turn>>>().ok_or_else(|| Error::invalid("plan: the path turns back"))?;
    let polyline = Polyline { points: &points, turns: &turns };
    let reaches = polyline.reaches(&limits, &obstacles);
    let spans = polyline.spans(&reaches)?;
    let proof = proved(scene, &obstacles, &spans).map_err(|e| Error::NoPath(format!("no path was proved: {e}")))?;
    let corner = |(i, (turn, reach)): (usize, (&Turn, &f64))| {
        let Place { at, vertex, .. } = path[i + 1];
        let (obstacle, vertex) = (vertex.map(|v| v.obstacle), vertex.map(|v| v.at));
        Corner { at, obstacle, vertex, turning_angle: turn.angle(), reach: *reach, span: 2 * i + 1 }
    };
    let corners = turns.iter().zip(&reaches).enumerate().map(corner).collect();
    let length_saved = turns.iter().zip(&reaches).map(|(turn, reach)| turn.saved(*reach)).sum();
    Ok(Plan { spans, polyline: points, corners, length_saved, proof })
}

/// Proves of spans, whoever made them, that they lead from start to goal, keep the clearance from every obstacle and
/// bend no more than allowed, and encloses clearance and curvature.
///
/// # Accuracy
/// The curve of a span is its start and the integral of its squared pre-image, or its Bézier form; both hold what is
/// proved. The clearance is enclosed to 1e-9 of the size of the scene. What keeps a limit by less than roundings is
/// refused.
///
/// # Errors
/// [`Error::Domain`] naming what is wrong with the scene, or the span that is not proved and why.
pub fn prove(scene: &Scene, spans: &[PhQuintic]) -> Result<Proof> {
    proved(scene, &scene.check()?, spans)
}

fn proved(scene: &Scene, obstacles: &Obstacles, spans: &[PhQuintic]) -> Result<Proof> {
    check_ends(scene, spans)?;
    let curvature_at_most = spans.iter().enumerate().map(|(i, span)| bounded(i, span, scene.greatest_curvature));
    let curvature_at_most = curvature_at_most.collect::<Result<Vec<_>>>()?.into_iter().fold(0.0, f64::max);
    let wanted = scene.clearance;
    let clearance = clearance(spans, obstacles, wanted, TOLERANCE * scene.size());
    match clearance {
        // The start is outside of all obstacles, and no path gets in without touching a side.
        Some(c) if c.at_least < wanted || c.at_least <= 0.0 => {
            let Clearance { at_least, at_most, point, obstacle } = c;
            fail(format!(
                "the path near {point:?} is between {at_least:?} and {at_most:?} away from obstacles[{obstacle}]; \
                 the clearance {wanted:?} is not proved"
            ))
        }
        clearance => Ok(Proof { curvature_at_most, clearance }),
    }
}

fn check_ends(scene: &Scene, spans: &[PhQuintic]) -> Result<()> {
    let ends = [spans.first().map(|s| s.start), spans.last().map(|s| s.end)];
    if ends != [Some(scene.start), Some(scene.goal)] {
        return fail(format!("the path leads from {:?} to {:?}, not from `start` to `goal`", ends[0], ends[1]));
    }
    check_joined("plan", spans)
}

/// A bound of the curvature: close to its greatest value, if that can be proved, else the one to keep.
fn bounded(i: usize, span: &PhQuintic, most: f64) -> Result<f64> {
    let value = span.greatest_curvature().1;
    let close = value * (1.0 + 1e-9);
    match () {
        () if value == 0.0 && span.turn_coefficients() == [0.0; 3] => Ok(0.0),
        () if close <= most && span.bends_less(close) => Ok(close),
        () if span.bends_less(most) => Ok(most),
        () => fail(format!("span {i} has a curvature of {value:?}; the greatest allowed, {most:?}, is not proved")),
    }
}

/// The places of the path: beside obstacles as far as turns need, else also in the open and further off.
fn route(scene: &Scene, obstacles: &Obstacles, limits: Limits) -> Result<Vec<Place>> {
    let ends = [scene.start, scene.goal];
    if parted(obstacles, ends, scene.clearance, 32.0 * ROUNDINGS * scene.size()) {
        let clearance = scene.clearance;
        return none(format!(
            "every way is blocked: obstacles grown by the clearance {clearance:?} part `start` from `goal`"
        ));
    }
    let beside = |limits: Limits, wide: f64| places(obstacles, limits.keep, limits.most, wide);
    let near = beside(limits, 0.0);
    let search = |limits: Limits, places: Vec<Place>| Search::new(obstacles, limits, ends, places);
    // If it could turn on the spot: found at most once, where it is needed.
    let sharp = || search(limits.sharp(), beside(limits.sharp(), 0.0)).within(f64::INFINITY, WORK).run().0;
    let (mut best, mut gave_up, mut shortest) = (None, false, None);
    let mut longest = f64::INFINITY;
    let sides = SIDES_LOOKED_AT[0] + SIDES_LOOKED_AT[1] * obstacles.sides().count();
    match search(limits, near.clone()).looking_at(sides).run().0 {
        SearchResult::Path(path, length) if length <= DETOUR * distance(ends[0], ends[1]) => return Ok(path),
        SearchResult::Path(path, length) => {
            shortest = Some(sharp());
            if let Some(SearchResult::Path(_, least)) = shortest
                && length <= DETOUR * least
            {
                return Ok(path);
            }
            (best, longest) = (Some(path), length);
        }
        SearchResult::None => {}
        SearchResult::GaveUp => gave_up = true,
    }
    let [coarse, fine] = CLOSE.map(|close| open(obstacles, ends, &near, &limits, close));
    let wide = |all: &[f64]| [near.clone(), all.iter().flat_map(|wide| beside(limits, *wide)).collect()].concat();
    let wider = WIDE.chunks(1).chain([&SEVERAL[..]]).map(wide);
    // Those in the open are few, and alone they give a path where it need not come close to anything.
    let alone = [coarse, fine.clone()];
    let tried = alone.len();
    let mut left = WORK;
    for (i, places) in alone.into_iter().chain([[&near[..], &fine].concat()]).chain(wider).enumerate() {
        let (found, rest) = search(limits, places).within(longest, left).run();
        left = rest;
        match found {
            SearchResult::Path(path, length) => {
                (best, longest) = (Some(path), length);
                // A path in the open alone may be long; but where places are too many for the first search, more work
                // is in vain.
                if i >= tried || gave_up {
                    left = left.min(MORE);
                }
            }
            SearchResult::None => {}
            SearchResult::GaveUp => gave_up = true,
        }
    }
    if let Some(path) = best {
        return Ok(path);
    }
    let beyond = if gave_up { "; the search gave up before it had tried all, so there may be one" } else { "" };
    match shortest.unwrap_or_else(sharp) {
        SearchResult::Path(path, _) => none(explain(&path, scene, obstacles, limits) + beyond),
        _ => none(format!(
            "no path was found, though obstacles grown by the clearance {:?} do not part `start` from `goal`: \
             a way is too narrow for doubles so far from the origin, or has too many turns{beyond}",
            scene.clearance
        )),
    }
}

/// Why the corners of a path cannot be rounded: the one that lacks most.
fn explain(path: &[Place], scene: &Scene, obstacles: &Obstacles, limits: Limits) -> String {
    let corner = |w: &[Place]| {
        let (before, after) = (sub(w[1].at, w[0].at), sub(w[2].at, w[1].at));
        let (turn, leg) = (Turn::new(before, after)?, before[0].hypot(before[1]).min(after[0].hypot(after[1])));
        Some((w[1], turn, limits.reach(&turn), leg))
    };
    let corners = path.windows(3).filter_map(corner);
    let lacks = |(_, _, needed, leg): &(Place, Turn, f64, f64)| needed / leg;
    let Some((place, turn, needed, leg)) = corners.max_by(|a, b| lacks(a).total_cmp(&lacks(b))) else {
        return "no path was found".into();
    };
    let why = match limits.breach(&turn, place.at, needed, obstacles) {
        _ if needed > leg => format!("its curve needs {needed:?} of both legs, and one is {leg:?} long"),
        Some(Why::Near(c)) => {
            format!("its curve comes to {:?} of obstacles[{}], near {:?}", c.at_most, c.obstacle, c.point)
        }
        _ => format!("its curve takes {needed:?} of both legs, and no corners were found that leave room for that"),
    };
    let vertex =
        place.vertex.map_or(String::new(), |v| format!(" around the vertex {:?} of obstacles[{}]", v.at, v.obstacle));
    let (at, angle, most) = (place.at, turn.angle().to_degrees(), scene.greatest_curvature);
    format!(
        "no path was found: the shortest way turns by {angle:.1} degrees at {at:?}{vertex}, and with curvature \
         {most:?} {why}; allow more curvature"
    )
}

fn none<T>(why: String) -> Result<T> {
    Err(Error::NoPath(why))
}

fn fail<T>(what: String) -> Result<T> {
    Err(Error::invalid(format!("plan: {what}")))
}
