//! `query`: the exact answer for one datum, or for many as a stream.

use super::output::{self, Object};
use super::{Outcome, pictures, points};
use serde::Serialize;
use spiral_atlas::atlas::Atlas;
use spiral_atlas::curve::CubicBezier;
use spiral_atlas::family::cubic::{Cubic, Datum, Root, solve};
use spiral_atlas::family::{Family, NO_VALUE};
use spiral_atlas::recipe::parse_angle;
use spiral_atlas::{Error, Result};
use std::path::PathBuf;

/// Answer exactly for one datum, or for a table of them.
///
/// All cubics with these ends, which conditions hold, and the margin of each; nothing is rounded before it is decided.
/// End points are (-1, 0) and (1, 0), so curvatures are the user's times half the chord; `curve` takes data as they are.
///
/// With --points, one line of JSON for each row, in order:
/// {"phi0":..,"phi1":..,"kappa0":..,"kappa1":..,"flags":{"SOLVABLE":true,..},"solutions":[{"f0":..,"f1":..,"theorem31":true,
/// "spiral":true,"margin":..,"control_points":[[x,y],..]},..],"chosen":0}, where `chosen` is an index into `solutions` or null;
/// a bad row gives {"line":..,"error":".."}, and the exit code is 1 at the end.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  spiral-atlas query --phi0 40deg --phi1 80deg --kappa0 0.4 --kappa1 4\n  \
                        spiral-atlas query --points data.csv > answers.jsonl")]
pub struct Args {
    /// Angle of the start tangent below the chord.
    #[arg(long, value_name = "ANGLE", value_parser = parse_angle, allow_hyphen_values = true, required_unless_present = "points")]
    phi0: Option<f64>,
    /// Angle of the end tangent above the chord.
    #[arg(long, value_name = "ANGLE", value_parser = parse_angle, allow_hyphen_values = true, required_unless_present = "points")]
    phi1: Option<f64>,
    /// Curvature at the start times half the chord.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true, required_unless_present = "points")]
    kappa0: Option<f64>,
    /// Curvature at the end times half the chord.
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true, required_unless_present = "points")]
    kappa1: Option<f64>,
    /// A CSV file with the header phi0,phi1,kappa0,kappa1 (in any order; other columns are not looked at); - is standard input.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["phi0", "phi1", "kappa0", "kappa1"])]
    points: Option<PathBuf>,
    /// Tell also what this atlas says, at the node nearest to the datum.
    #[arg(long, value_name = "FILE")]
    atlas: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &Args) -> Result<Outcome> {
    let atlas = args.atlas.as_ref().map(Atlas::open).transpose()?;
    if let Some(atlas) = &atlas {
        let family = pictures::of(atlas)?.name();
        if family != Cubic.name() {
            let what = format!("it is an atlas of `{family}`; `query` answers for `{}`", Cubic.name());
            return Err(Error::Atlas { path: atlas.path().to_owned(), what });
        }
    }
    if let Some(path) = &args.points {
        return points::run(path, atlas.as_ref());
    }
    let (Some(phi0), Some(phi1), Some(kappa0), Some(kappa1)) = (args.phi0, args.phi1, args.kappa0, args.kappa1) else {
        super::refuse("a datum needs `--phi0`, `--phi1`, `--kappa0` and `--kappa1`");
    };
    let answer = Answer::new(&Datum { phi0, phi1, kappa0, kappa1 }, atlas.as_ref())?;
    if args.json {
        output::print(&(serde_json::to_string(&answer).map_err(output::json_error)? + "\n"))?;
    } else {
        output::print(&answer.text())?;
    }
    Ok(Outcome::Fine)
}

/// All that is known of a datum, as it is told in JSON.
#[derive(Debug, Serialize)]
pub struct Answer {
    #[serde(flatten)]
    datum: Datum,
    flags: Object<&'static str, bool>,
    solutions: Vec<Solution>,
    chosen: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    atlas: Option<Told>,
}

#[derive(Debug, Serialize)]
struct Solution {
    f0: f64,
    f1: f64,
    theorem31: bool,
    spiral: bool,
    margin: f64,
    control_points: [[f64; 2]; 4],
}

/// What an atlas says.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Told {
    Node {
        node: u64,
        coordinates: Object<String, f64>,
        flags: Object<String, bool>,
        solutions: Object<String, u8>,
        #[serde(skip_serializing_if = "empty")]
        scalars: Object<String, Option<f32>>,
    },
    Outside {
        outside: String,
    },
}

fn empty(scalars: &Object<String, Option<f32>>) -> bool {
    scalars.0.is_empty()
}

impl Answer {
    /// Solves a datum, and looks it up.
    ///
    /// # Errors
    /// Those of [`solve`].
    pub fn new(datum: &Datum, atlas: Option<&Atlas>) -> Result<Answer> {
        let solved = solve(datum)?;
        let solution = |root: &Root| {
            let Root { f0, f1, theorem31, spiral, margin } = *root;
            let control_points = CubicBezier::from_ratios(datum.phi0, datum.phi1, f0, f1).p;
            Solution { f0, f1, theorem31, spiral, margin, control_points }
        };
        let flag = |(bit, flag): (usize, &spiral_atlas::family::Flag)| (flag.name, solved.flags() >> bit & 1 == 1);
        Ok(Answer {
            datum: *datum,
            flags: Object(Cubic.flags().iter().enumerate().map(flag).collect()),
            solutions: solved.roots().iter().map(solution).collect(),
            chosen: solved.chosen_index(),
            atlas: atlas.map(|atlas| look_up(atlas, datum)),
        })
    }

    fn text(&self) -> String {
        let Datum { phi0, phi1, kappa0, kappa1 } = self.datum;
        let mut text = format!("phi0 = {phi0:?}, phi1 = {phi1:?}, kappa0 = {kappa0:?}, kappa1 = {kappa1:?}\n");
        for ((name, holds), flag) in self.flags.0.iter().zip(Cubic.flags()) {
            text += &format!("  {name:<14} {:<4} {}\n", yes(*holds), flag.doc);
        }
        if self.solutions.is_empty() {
            text += "no cubic with f0, f1 in (0, 3) has these ends\n";
        }
        for (i, s) in self.solutions.iter().enumerate() {
            let chosen = if self.chosen == Some(i) { ", chosen" } else { "" };
            text += &format!("solution {i}{chosen}: f0 = {:?}, f1 = {:?}\n", s.f0, s.f1);
            text += &format!("  spiral: {}, margin {:?}; Theorem 3.1: {}\n", yes(s.spiral), s.margin, yes(s.theorem31));
            let points: Vec<String> = s.control_points.iter().map(|[x, y]| format!("({x:?}, {y:?})")).collect();
            text += &format!("  control points {}\n", points.join(" "));
        }
        text + &self.atlas.as_ref().map_or(String::new(), Told::text)
    }
}

impl Told {
    fn text(&self) -> String {
        match self {
            Told::Outside { outside } => format!("the atlas does not reach there: {outside}\n"),
            Told::Node { node, coordinates, flags, solutions, scalars } => {
                let place: Vec<String> = coordinates.0.iter().map(|(name, x)| format!("{name} = {x:?}")).collect();
                let set: Vec<&str> = flags.0.iter().filter(|(_, set)| *set).map(|(name, _)| &name[..]).collect();
                let set = if set.is_empty() { "no flag".into() } else { set.join(" ") };
                let counts: Vec<String> = solutions.0.iter().map(|(name, n)| format!("{name} {n}")).collect();
                let values = scalars.0.iter().map(|(name, v)| format!("{name} {}", v.map_or("-".into(), |v| format!("{v:?}"))));
                let rest: Vec<String> = counts.into_iter().chain(values).collect();
                format!("the atlas at node {node}, the nearest ({}):\n  {set}; {}\n", place.join(", "), rest.join(", "))
            }
        }
    }
}

fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "no" }
}

fn look_up(atlas: &Atlas, datum: &Datum) -> Told {
    let (a, k) = datum.normalised();
    let coordinate = |name: &str| match name {
        "phi0" => datum.phi0,
        "phi1" => datum.phi1,
        "kappa0" => datum.kappa0,
        "kappa1" => datum.kappa1,
        "a" => a,
        "k" => k,
        _ => f64::NAN,
    };
    let axes = atlas.grid().axes();
    let point: Vec<f64> = axes.iter().map(|axis| coordinate(axis.name())).collect();
    let Some((node, entry)) = atlas.nearest(&point) else { return Told::Outside { outside: outside(atlas, &point) } };
    let names = axes.iter().map(|a| a.name().to_owned());
    let scalar = |name: &str| {
        let value = atlas.scalar(name).and_then(|values| values.get(node as usize)).copied();
        (name.to_owned(), value.filter(|v| *v != NO_VALUE))
    };
    Told::Node {
        node,
        coordinates: Object(names.zip(atlas.grid().node(node)).collect()),
        flags: Object(atlas.flag_names().enumerate().map(|(bit, n)| (n.to_owned(), entry.flags >> bit & 1 == 1)).collect()),
        solutions: Object(atlas.counts().iter().map(|c| (c.name.clone(), c.of(entry.solutions))).collect()),
        scalars: Object(atlas.scalar_names().map(scalar).collect()),
    }
}

/// Which coordinates leave their axes.
fn outside(atlas: &Atlas, point: &[f64]) -> String {
    let axes = atlas.grid().axes().iter().zip(point);
    let ends = |values: &[f64]| (values[0], values[values.len() - 1]);
    let beyond = axes.filter_map(|(axis, x)| {
        let (first, last) = ends(axis.values());
        (!(first..=last).contains(x)).then(|| format!("{} = {x:?} is outside {first:?} to {last:?}", axis.name()))
    });
    beyond.collect::<Vec<_>>().join("; ")
}
