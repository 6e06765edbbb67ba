//! What the path tools draw.

use spiral_atlas::curve::Choice;
use spiral_atlas::curve::PhQuintic;
use spiral_atlas::path::{Course, Motion, Plan, Scene};
use spiral_atlas::plain::count;
use spiral_atlas::plot::{self, Backdrop, Drawing, Lines, PathsFigure};
use spiral_atlas::tools::{Pair, PathReport, Separations};
use spiral_atlas::transition::{Piece, Station};
use spiral_atlas::{Error, Result};

const SIZE: (u32, u32) = (1500, 900);
const TALL: (u32, u32) = (1300, 1300);
/// Samples of a path, about.
pub(crate) const SAMPLES: usize = 2000;

/// Points of a line.
pub(crate) type Line = Vec<[f64; 2]>;

/// Parameters of one of several spans.
fn steps(spans: usize) -> impl Iterator<Item = f64> + Clone {
    let n = (SAMPLES / spans.max(1)).max(8);
    (0..=n).map(move |i| i as f64 / n as f64)
}

/// The same, and where the curvature is extreme.
fn places(curve: &PhQuintic, spans: usize) -> Vec<f64> {
    let mut all: Vec<f64> = steps(spans).chain(curve.curvature_extrema()).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn points(spans: &[PhQuintic]) -> Vec<[f64; 2]> {
    spans.iter().flat_map(|c| places(c, spans.len()).into_iter().map(|t| c.point(t))).collect()
}

fn pieces(all: &[Piece]) -> Line {
    let point = |piece: &Piece, t: f64| {
        let [from, to] = piece.range();
        piece.at(from + t * (to - from)).point
    };
    all.iter().flat_map(|piece| steps(all.len()).map(move |t| point(piece, t))).collect()
}

/// A function of the arc length along spans.
fn along(spans: &[PhQuintic], f: impl Fn(&PhQuintic, f64) -> f64) -> Vec<[f64; 2]> {
    let mut from = 0.0;
    let mut all = Vec::new();
    for c in spans {
        all.extend(places(c, spans.len()).into_iter().map(|t| [from + c.length_to(t), f(c, t)]));
        from += c.length();
    }
    all
}

/// Paths and their curvatures.
pub(crate) fn reported(paths: &[PathReport], title: &str) -> Result<Drawing> {
    let paths: Vec<_> = paths.iter().map(|path| path.pieces.clone()).collect();
    beside_others(&paths, vec![], title, "dots: starts")
}

/// Paths with their curvatures and offset curves.
pub(crate) fn measured<'c>(courses: impl Iterator<Item = &'c Course>, offset: Option<f64>) -> Result<Drawing> {
    let courses: Vec<&Course> = courses.collect();
    let all = courses.iter().map(|course| course.outline(SAMPLES)).collect::<Result<Vec<_>>>()?;
    let each = |f: &dyn Fn(&Station) -> [f64; 2]| all.iter().map(|path| path.iter().map(f).collect()).collect();
    let offsets = offset.map_or(vec![], |d| each(&|s| s.beside(d)));
    let length: f64 = courses.iter().map(|course| course.length()).sum();
    let title = if let [_] = courses[..] {
        format!("A path of length {length:.6}")
    } else {
        format!("{} paths", courses.len())
    };
    let note = offset.map_or("dots: starts".into(), |d| format!("dots: starts; the other colours: at distance {d}"));
    drawn(each(&|s| [s.x, s.y]), each(&|s| [s.station, s.curvature]), offsets, vec![], [&title, &note])
}

/// The curve taken, its curvature, and the others there are.
pub(crate) fn choice(choice: &Choice) -> Result<Drawing> {
    let others = choice.candidates.iter().enumerate().filter(|(i, _)| *i != choice.best);
    let others = others.map(|(_, c)| points(&[c.curve])).collect();
    let title = format!("{} curves between two ends", choice.candidates.len());
    let note = "dot: start; blue: the one of least absolute rotation, and its curvature";
    beside_others(&[vec![*choice.best()]], others, &title, note)
}

/// Paths and their curvatures, and points of other curves.
fn beside_others(paths: &[Vec<PhQuintic>], others: Vec<Vec<[f64; 2]>>, title: &str, note: &str) -> Result<Drawing> {
    let lines = paths.iter().map(|spans| along(spans, PhQuintic::curvature)).collect();
    drawn(paths.iter().map(|spans| points(spans)).collect(), lines, others, vec![], [title, note])
}

/// Points of paths, their curvatures over the length, points of other curves and of what was given, heading and note. A
/// single path without other curves beside it (dots are none) has a comb, where its curvatures are those at its points.
pub(crate) fn drawn(
    paths: Vec<Line>,
    lines: Vec<Line>,
    others: Vec<Line>,
    given: Vec<Line>,
    [title, note]: [&str; 2],
) -> Result<Drawing> {
    if lines.iter().flatten().flatten().any(|x| !x.is_finite()) {
        return Err(Error::invalid("a path stands still somewhere, where it has no curvature"));
    }
    let comb = match (&paths[..], &lines[..]) {
        ([path], [line]) if path.len() == line.len() && others.iter().all(|other| other.len() == 1) => {
            line.iter().map(|[_, curvature]| *curvature).collect()
        }
        _ => Vec::new(),
    };
    let figure = PathsFigure {
        title: title.into(),
        note: note.into(),
        paths: paths.into_iter().chain(others).collect(),
        comb,
        given,
        graph: Lines { across: "s".into(), up: "κ".into(), lines },
        level: None,
        backdrop: None,
    };
    plot::draw_paths(&figure, SIZE)
}

/// A planned path among its obstacles, above its curvature.
pub(crate) fn planned(scene: &Scene, plan: &Plan) -> Result<Drawing> {
    let (most, spans) = (scene.greatest_curvature, &plan.spans);
    let figure = PathsFigure {
        title: format!(
            "{}, length {:.4}, saved {:.4}",
            count(plan.corners.len(), "corner"),
            length(spans),
            plan.length_saved
        ),
        note: format!(
            "dot: start; bright: within the clearance {}; red: the greatest curvature {most}",
            scene.clearance
        ),
        paths: vec![points(spans)],
        graph: Lines { across: "s".into(), up: "|κ|".into(), lines: vec![along(spans, |c, t| c.curvature(t).abs())] },
        comb: Vec::new(),
        given: Vec::new(),
        level: Some(most),
        backdrop: Some(Backdrop {
            obstacles: scene.obstacles.clone(),
            grown: scene.clearance,
            polyline: plan.polyline.clone(),
        }),
    };
    plot::draw_paths(&figure, TALL)
}

fn length(spans: &[PhQuintic]) -> f64 {
    spans.iter().map(PhQuintic::length).sum()
}

/// The paths of several motions and the separation of each pair over time.
pub(crate) fn separations(motions: &[Motion], found: &Separations, title: String) -> Result<Drawing> {
    let minimum = found.minimum;
    let line = |Pair { first, second, found }: &Pair| {
        let (a, b) = (&motions[*first], &motions[*second]);
        let (from, to) = (a.times()[0].min(b.times()[0]), a.times()[1].max(b.times()[1]));
        let n = SAMPLES / 4;
        let mut times: Vec<f64> = (0..=n).map(|k| from + (to - from) * k as f64 / n as f64).collect();
        times.push(found.closest.time.clamp(from, to));
        times.sort_by(f64::total_cmp);
        let apart = |t: f64| {
            let (p, q) = (a.at(t), b.at(t));
            [t, (p[0] - q[0]).hypot(p[1] - q[1])]
        };
        times.into_iter().map(apart).collect()
    };
    let lines = found.pairs.iter().map(line).collect();
    let figure = PathsFigure {
        title,
        note: format!("dots: starts; on the right a line for each pair; red: the minimum {minimum}"),
        paths: motions.iter().map(|m| pieces(m.course().pieces())).collect(),
        graph: Lines { across: "time".into(), up: "separation".into(), lines },
        comb: Vec::new(),
        given: Vec::new(),
        level: Some(minimum),
        backdrop: None,
    };
    plot::draw_paths(&figure, SIZE)
}
