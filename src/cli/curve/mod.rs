//! `curve`: transition curves in the user's own units and axes.

mod cubic;
mod involute;
mod options;
mod ph;
mod reach;
mod report;
mod trig;

use super::Outcome;
use serde::Serialize;
use spiral_atlas::Result;
use spiral_atlas::curve::Jet;
use spiral_atlas::family::reach::Kind as Segment;
use spiral_atlas::plot::{CurveFigure, EndCircle, Graph};
use spiral_atlas::transition::{Ends, Kind, Piece};
use std::ffi::OsString;

const SAMPLES: usize = 801;

/// Find a transition curve of monotone curvature, anywhere in the plane, in any unit of length.
///
/// Exit status: 0 when there is such a spiral, 1 when there is none, 2 for an error. A no comes with the condition that
/// fails, in your units, and with what to type for the other kinds of curve that would do. With --points it is 0 when
/// every row was answered, whatever the answers, and 2 when one was bad.
///
/// The older spelling `curve --family NAME` works too; without a family it means `cubic`.
#[derive(clap::Args)]
#[command(subcommand_value_name = "NAME", after_help = "Each lists its options: spiral-atlas curve NAME --help")]
pub(super) struct Args {
    #[command(subcommand)]
    family: Family,
}

/// Families that make curves.
#[derive(clap::Subcommand)]
enum Family {
    /// Join two ends by a cubic Bézier spiral: of several the one with the largest margin.
    #[command(after_help = "Examples:\n  \
            spiral-atlas curve cubic --from 0,0 --to 200,0 --start-direction -40deg --end-direction 80deg \\\n      \
            --start-curvature 0.004 --end-curvature 0.04 --figure spiral.png\n  \
            spiral-atlas curve cubic --points ends.csv --samples 101 --csv")]
    Cubic(options::Between),
    /// Join two ends by a PH quintic spiral: of several the one of least bending energy.
    #[command(after_help = "Example:\n  \
            spiral-atlas curve ph-quintic --from 0,0 --to 200,0 --start-direction -25deg \\\n      \
            --end-direction 50deg --start-curvature 0 --end-curvature 0.012 --json")]
    PhQuintic(options::Between),
    /// Join two ends by the image of an involute of a circle, which exists whenever any spiral does.
    #[command(after_help = "Example:\n  \
            spiral-atlas curve involute --from 0,0 --to 2,0 --start-direction 1,-0.84 \\\n      \
            --end-direction 0.17,0.98 --start-curvature -0.3 --end-curvature 4 --json")]
    Involute(involute::Args),
    /// Add a cubic spiral to the end of a line or of an arc, given by its shape m and q or by its end.
    #[command(after_help = "Example:\n  \
            spiral-atlas curve reach-cubic --base line --from 10,5 --start-direction 30deg --turn left \\\n      \
            --radius 20 --angle 45deg --m 0.8 --q 1.9")]
    ReachCubic(reach::Args),
    /// Add a PH quintic spiral to the end of a line or of an arc, given by its shape m and q or by its end.
    #[command(after_help = "Example:\n  \
            spiral-atlas curve reach-ph --base line --from 10,5 --start-direction 30deg --turn left \\\n      \
            --radius 20 --angle 45deg --to 30,25")]
    ReachPh(reach::Args),
    /// Join lines and circles by one or two quintic trigonometric spirals, in five templates.
    #[command(after_help = "Example:\n  \
            spiral-atlas curve trig-quintic --template line-circle --from 10,5 --start-direction 30deg \\\n      \
            --turn left --radius 20 --angle 42deg --m 1")]
    TrigQuintic(trig::Args),
}

/// The words of a command line, with the older spelling `curve [--family NAME] ..` as `curve NAME ..`.
pub(super) fn modern(mut words: Vec<OsString>) -> Vec<OsString> {
    let older = |word: &OsString| word.to_str().is_some_and(|w| w.starts_with('-') && w != "-h" && w != "--help");
    if !(words.get(1).is_some_and(|word| word == "curve") && words.get(2).is_some_and(older)) {
        return words;
    }
    let mut family = OsString::from("cubic");
    let named = |word: &OsString| word == "--family" || word.to_str().is_some_and(|w| w.starts_with("--family="));
    if let Some(place) = words.iter().position(named) {
        let word = words.remove(place);
        family = match word.to_str().and_then(|word| word.strip_prefix("--family=")) {
            Some(name) => name.into(),
            None if place < words.len() => words.remove(place),
            // A missing name is refused as an unknown one, with those that there are.
            None => OsString::new(),
        };
    }
    words.insert(2, family);
    words
}

/// What a family found, as it is reported; as JSON too.
trait Reportable: Serialize {
    /// The spirals that were asked for, in the direction of travel, or why there are none.
    fn spirals(&self) -> std::result::Result<Vec<Piece>, String>;
    /// The ends that were to be joined and the kind of the curve, where other kinds could do it too.
    fn between(&self) -> Option<(&Ends, Kind)> {
        None
    }
    /// Which of the ends are straight by the question.
    fn straight(&self) -> [bool; 2] {
        self.between().map_or([false; 2], |(ends, _)| [ends.start_curvature, ends.end_curvature].map(|k| k == 0.0))
    }
    /// In words; of a no what there is to say beside the reason.
    fn text(&self) -> String;
    /// What is drawn.
    ///
    /// # Errors
    /// [`Error::Domain`](spiral_atlas::Error::Domain) when there is nothing to draw.
    fn figure(&self) -> Result<CurveFigure>;
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    match &args.family {
        Family::Cubic(ends) => ends.answer(cubic::find),
        Family::PhQuintic(ends) => ends.answer(ph::find),
        Family::Involute(args) => args.run(),
        Family::ReachCubic(args) => args.run(Segment::Cubic),
        Family::ReachPh(args) => args.run(Segment::Ph),
        Family::TrigQuintic(args) => args.run(),
    }
}

/// A circle of curvature for a figure.
fn circle(at: [f64; 2], direction: f64, curvature: f64, label: &str) -> EndCircle {
    EndCircle { at, direction: [direction.cos(), direction.sin()], curvature, label: label.into() }
}

/// Those at the ends.
fn end_circles(ends: &Ends) -> Vec<EndCircle> {
    vec![
        circle(ends.start, ends.start_direction, ends.start_curvature, "circle of curvature at the start"),
        circle(ends.end, ends.end_direction, ends.end_curvature, "circle of curvature at the end"),
    ]
}

/// A Bézier curve given relative to its start, its curvature, and the derivative of that.
fn drawn([x, y]: [f64; 2], local_control_points: &[[f64; 2]]) -> (Vec<[f64; 2]>, Graph, Graph) {
    let step = |i: usize| i as f64 / (SAMPLES - 1) as f64;
    let jets: Vec<(f64, Jet)> = (0..SAMPLES).map(step).map(|t| (t, Jet::of_bezier(local_control_points, t))).collect();
    let graph = |label: &str, value: fn(&Jet) -> f64| Graph {
        label: label.into(),
        points: jets.iter().map(|(t, jet)| [*t, value(jet)]).collect(),
    };
    let curve = jets.iter().map(|(_, jet)| [x + jet.point[0], y + jet.point[1]]).collect();
    (curve, graph("κ", Jet::curvature), graph("dκ/dt", Jet::curvature_dt))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_older_spelling_is_the_new_one() {
        let words = |line: &str| line.split(' ').map(OsString::from).collect::<Vec<_>>();
        for (older, new) in [
            ("atlas curve --from 0,0", "atlas curve cubic --from 0,0"),
            ("atlas curve --json --family involute --m 1", "atlas curve involute --json --m 1"),
            ("atlas curve --family=reach-ph --help", "atlas curve reach-ph --help"),
            ("atlas curve --m 1 --family", "atlas curve  --m 1"),
        ] {
            assert_eq!(modern(words(older)), words(new));
        }
        for new in ["atlas", "atlas curve", "atlas curve -h", "atlas curve --help", "atlas curve involute --m 1"] {
            assert_eq!(modern(words(new)), words(new));
        }
        assert_eq!(modern(words("atlas query --family cubic")), words("atlas query --family cubic"));
    }
}
