//! `query`: the exact answer for one datum of any family, or for many as a stream.

use super::cells::{self, Opened};
use super::datum::{Coordinates, Datum, from_cells};
use super::output::{self, Object};
use super::question::QuestionArgs;
use super::{Outcome, points};
use serde::Serialize;
use spiral_atlas::atlas::Atlas;
use spiral_atlas::family::cubic::Cubic;
use spiral_atlas::family::{self, Family, NO_VALUE, Value, by_name};
use spiral_atlas::{Error, Result};
use std::path::PathBuf;

/// Answer exactly for one datum, or for a table of them.
///
/// Which conditions hold, and all curves with these ends; nothing is rounded before it is decided. The frame is the
/// family's own (for `cubic`: end points (-1, 0) and (1, 0), so curvatures are the user's times half the chord);
/// `curve` takes data as they are.
///
/// With --points, one line of JSON for each row, in order:
/// {"phi0":..,"phi1":..,"kappa0":..,"kappa1":..,"flags":{"SOLVABLE":true,..},"solutions":[{"f0":..,"f1":..,
/// "theorem31":true,"spiral":true,"margin":..,"length":..,"control_points":[[x,y],..]},..],"chosen":0}, where `chosen`
/// is an index into `solutions` or null; a bad row gives {"row":..,"error":".."},
/// counted from 1 after the header.
///
/// Exit status: 0 when what the family looks for exists, 1 when it does not, 2 for an error. With --points it is 0 when
/// every row was answered, whatever the answers, and 2 when one was bad. A yes is the flag SPIRAL (`cubic`,
/// `ph-quintic`, `trig-quintic`), EXISTS (`any-spiral`), CASE1_EXACT or CASE2_EXACT (`reach-cubic`, `reach-ph`),
/// REGULAR (`ph-equal-length`, `ph-hermite`).
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
              spiral-atlas query --phi0 40deg --phi1 80deg --kappa0 0.4 --kappa1 4\n  \
              spiral-atlas query --family reach-ph --theta 40deg --xi 1.5 --eta 0.35\n  \
              spiral-atlas query --points data.csv > answers.jsonl\n  \
              spiral-atlas query --phi0 40deg --phi1 80deg --kappa0 0.4 --ranges kappa1 --within 0,100\n  \
              spiral-atlas query --phi0 40deg --phi1 80deg --kappa0 3 --kappa1 4 --nearest --weights inf,inf,1,1")]
pub(super) struct Args {
    /// The family; that of the atlas, or `cubic`, unless given.
    #[arg(long, value_name = "NAME", value_parser = by_name)]
    family: Option<&'static dyn Family>,
    #[command(flatten)]
    coordinates: Coordinates,
    /// A CSV file whose header names the coordinates, such as phi0,phi1,kappa0,kappa1 (in any order; other columns are
    /// not looked at); - is standard input.
    #[arg(long, value_name = "FILE")]
    points: Option<PathBuf>,
    /// Print also what this atlas says: at the node nearest to the datum, or of the cell that holds it (`cell`, null
    /// outside the cells).
    #[arg(long, value_name = "FILE")]
    atlas: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    question: QuestionArgs,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<Outcome> {
    let atlas = args.atlas.as_ref().map(Opened::checked).transpose()?;
    let of = |atlas: &Opened| match atlas {
        Opened::Nodes(atlas) => atlas.about().family(),
        Opened::Cells(found) => Ok(found.family()),
    };
    let its_own = atlas.as_ref().map(of).transpose()?;
    let family = args.family.or(its_own).unwrap_or(&Cubic);
    if let (Some(path), Some(its_own)) = (&args.atlas, its_own)
        && its_own.about().name != family.about().name
    {
        let what =
            format!("it is an atlas of `{}`; the datum is one of `{}`", its_own.about().name, family.about().name);
        return Err(Error::Atlas { path: path.clone(), what });
    }
    if let Some(path) = &args.points {
        let charts: Vec<&'static [&'static str]> = family.about().charts.iter().map(|chart| chart.axes).collect();
        return points::run(path, &charts, false, |row| {
            let answer = Answer::new(family, from_cells(family, row.chart, row.cells)?, atlas.as_ref())?;
            serde_json::to_vec(&answer).map_err(output::json_error)
        });
    }
    if args.question.any() {
        return args.question.run(family, &args.coordinates, args.json);
    }
    let datum = args.coordinates.datum(family).unwrap_or_else(|what| super::refuse(&what));
    let answer = Answer::new(family, datum, atlas.as_ref())?;
    if args.json {
        output::print(&(serde_json::to_string(&answer).map_err(output::json_error)? + "\n"))?;
    } else {
        output::print(&answer.text(family))?;
    }
    Ok(if answer.holds { Outcome::Fine } else { Outcome::Bad })
}

/// All that is known of a datum, as it is printed in JSON.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    /// Whether what the family looks for exists.
    #[serde(skip)]
    holds: bool,
    #[serde(flatten)]
    coordinates: Object<&'static str, f64>,
    flags: Object<&'static str, bool>,
    #[serde(skip_serializing_if = "empty")]
    counts: Object<&'static str, u8>,
    #[serde(skip_serializing_if = "empty")]
    derived: Object<&'static str, Value>,
    solutions: Vec<Object<&'static str, Value>>,
    chosen: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    atlas: Option<AtlasReport>,
    /// What the cell of the datum says of each flag, where the atlas has cells; none outside them.
    #[serde(skip_serializing_if = "Option::is_none")]
    cell: Option<Option<Object<&'static str, &'static str>>>,
}

/// What an atlas says.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum AtlasReport {
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

fn empty<K, V>(object: &Object<K, V>) -> bool {
    object.0.is_empty()
}

impl Answer {
    /// Solves a datum, and looks it up.
    ///
    /// # Errors
    /// Those of [`Family::answer`].
    pub(super) fn new(family: &dyn Family, datum: Datum, atlas: Option<&Opened>) -> Result<Answer> {
        let solved = family.answer(datum.chart, &datum.point)?;
        let axes = family.about().charts[datum.chart].axes;
        let flag = |(bit, flag): (usize, &family::Flag)| (flag.name, solved.code.flags() >> bit & 1 == 1);
        let coordinates = axes.iter().copied().zip(datum.point.iter().copied()).collect::<Vec<_>>();
        let place = |name: &str| {
            let given = coordinates.iter().find(|(axis, _)| *axis == name).map(|(_, x)| *x);
            given.or_else(|| solved.number(name)).unwrap_or(f64::NAN)
        };
        Ok(Answer {
            holds: family.holds(solved.code),
            flags: Object(family.about().flags.iter().enumerate().map(flag).collect()),
            counts: Object(
                family.about().counts.iter().map(|count| (count.name, count.of(solved.code.counts()))).collect(),
            ),
            atlas: atlas.and_then(|atlas| match atlas {
                Opened::Nodes(atlas) => Some(look_up(atlas, place)),
                Opened::Cells(_) => None,
            }),
            cell: atlas.and_then(|atlas| match atlas {
                Opened::Nodes(_) => None,
                Opened::Cells(found) => Some(cells::look_up(found, datum.chart, &datum.point)),
            }),
            derived: Object(solved.derived),
            solutions: solved.solutions.into_iter().map(Object).collect(),
            chosen: solved.chosen,
            coordinates: Object(coordinates),
        })
    }

    fn text(&self, family: &dyn Family) -> String {
        let mut text = list(&self.coordinates.0, |x| format!("{x:?}")) + "\n";
        for ((name, holds), flag) in self.flags.0.iter().zip(family.about().flags) {
            text += &format!("  {name:<14} {:<4} {}\n", yes(*holds), flag.doc);
        }
        for (name, value) in &self.derived.0 {
            text += &format!("  {name} = {}\n", word(value));
        }
        if self.solutions.is_empty() {
            text += &format!("`{}` has no curve for these ends\n", family.about().name);
        }
        for (i, solution) in self.solutions.iter().enumerate() {
            let chosen = if self.chosen == Some(i) { ", chosen" } else { "" };
            text += &format!("solution {i}{chosen}: {}\n", list(&solution.0, word));
        }
        match &self.cell {
            Some(Some(cell)) => text += &format!("its cell: {}\n", list(&cell.0, |word| (*word).to_owned())),
            Some(None) => text += "the cells do not reach there, or have other coordinates\n",
            None => {}
        }
        text + &self.atlas.as_ref().map_or(String::new(), AtlasReport::text)
    }
}

/// `name = value, ...`.
fn list<K: std::fmt::Display, V>(values: &[(K, V)], word: impl Fn(&V) -> String) -> String {
    values.iter().map(|(name, value)| format!("{name} = {}", word(value))).collect::<Vec<_>>().join(", ")
}

fn word(value: &Value) -> String {
    match value {
        Value::Number(x) => format!("{x:?}"),
        Value::Whole(n) => n.to_string(),
        Value::Holds(holds) => yes(*holds).into(),
        Value::Word(word) => (*word).into(),
        Value::Points(points) => points.iter().map(|[x, y]| format!("({x:?}, {y:?})")).collect::<Vec<_>>().join(" "),
    }
}

impl AtlasReport {
    fn text(&self) -> String {
        match self {
            AtlasReport::Outside { outside } => format!("the atlas does not reach there: {outside}\n"),
            AtlasReport::Node { node, coordinates, flags, solutions, scalars } => {
                let place = list(&coordinates.0, |x| format!("{x:?}"));
                let set: Vec<&str> = flags.0.iter().filter(|(_, set)| *set).map(|(name, _)| &name[..]).collect();
                let set = if set.is_empty() { "no flag".into() } else { set.join(" ") };
                let counts: Vec<String> = solutions.0.iter().map(|(name, n)| format!("{name} {n}")).collect();
                let values =
                    scalars.0.iter().map(|(name, v)| format!("{name} {}", v.map_or("-".into(), |v| format!("{v:?}"))));
                let rest: Vec<String> = counts.into_iter().chain(values).collect();
                format!("the atlas at node {node}, the nearest ({place}):\n  {set}; {}\n", rest.join(", "))
            }
        }
    }
}

fn yes(holds: bool) -> &'static str {
    if holds { "yes" } else { "no" }
}

/// What an atlas says of the place with these coordinates, by axis.
fn look_up(atlas: &Atlas, coordinate: impl Fn(&str) -> f64) -> AtlasReport {
    let axes = atlas.grid().axes();
    let point: Vec<f64> = axes.iter().map(|axis| coordinate(axis.name())).collect();
    let Some((node, entry)) = atlas.nearest(&point) else {
        return AtlasReport::Outside { outside: outside(atlas, &point) };
    };
    let names = axes.iter().map(|a| a.name().to_owned());
    let scalar = |name: &str| {
        let value = atlas.scalar(name).and_then(|values| values.get(node as usize)).copied();
        (name.to_owned(), value.filter(|v| *v != NO_VALUE))
    };
    AtlasReport::Node {
        node,
        coordinates: Object(names.zip(atlas.grid().node(node)).collect()),
        flags: Object(
            atlas.flag_names().enumerate().map(|(bit, n)| (n.to_owned(), entry.flags >> bit & 1 == 1)).collect(),
        ),
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
