//! A request that stands in a file.

use super::super::path::read;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use spiral_atlas::plain::name;
use spiral_atlas::tools::input::{Named, angle};
use spiral_atlas::transition::Turn;
use spiral_atlas::transition::join::{self, Family, Objective, State};
use spiral_atlas::{Error, Result};
use std::path::Path;

/// Longest file in bytes; a request has some hundred.
const MAX_INPUT: u64 = 1 << 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Request {
    #[serde(deserialize_with = "end")]
    from: join::End,
    #[serde(deserialize_with = "end")]
    to: join::End,
    greatest_curvature: f64,
    #[serde(default, deserialize_with = "name")]
    family: Family,
    #[serde(default, deserialize_with = "name")]
    objective: Objective,
    longest: Option<f64>,
    most_pieces: Option<usize>,
}

/// One of three.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    state: Option<Named<StateEnd>>,
    line: Option<Named<LineEnd>>,
    circle: Option<Named<CircleEnd>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StateEnd {
    point: [f64; 2],
    #[serde(deserialize_with = "angle")]
    direction: f64,
    #[serde(default)]
    curvature: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LineEnd {
    point: [f64; 2],
    #[serde(deserialize_with = "angle")]
    direction: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CircleEnd {
    centre: [f64; 2],
    radius: f64,
    #[serde(deserialize_with = "name")]
    turn: Turn,
}

fn end<'de, D: Deserializer<'de>>(from: D) -> std::result::Result<join::End, D::Error> {
    let Named(End { state, line, circle }) = Named::deserialize(from)?;
    let state =
        state.map(|Named(StateEnd { point, direction, curvature })| State { point, direction, curvature }.into());
    let line = line.map(|Named(LineEnd { point, direction })| join::End::Line { point, direction });
    let circle = circle.map(|Named(CircleEnd { centre, radius, turn })| join::End::Circle { centre, radius, turn });
    match [state, line, circle] {
        [Some(end), None, None] | [None, Some(end), None] | [None, None, Some(end)] => Ok(end),
        [None, None, None] => Err(D::Error::custom("give one of `state`, `line` and `circle`; there is none")),
        _ => Err(D::Error::custom("keep one of `state`, `line` and `circle`; there are several")),
    }
}

/// What stands in a JSON file, in a TOML file named `.toml`, or as JSON in standard input for `-`.
pub(super) fn read(path: &Path) -> Result<join::Request> {
    let text = spiral_atlas::files::read_text(path, MAX_INPUT)?;
    let toml = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    let name = if path == Path::new("-") { "standard input".into() } else { path.display().to_string() };
    let Request { from, to, greatest_curvature, family, objective, longest, most_pieces } =
        read::parse(&text, toml).map_err(|e| Error::invalid(format!("{name}: {e}")))?;
    Ok(join::Request {
        family,
        objective,
        longest: longest.unwrap_or(f64::INFINITY),
        most_pieces: most_pieces.unwrap_or(join::Request::MOST_PIECES),
        ..join::Request::new(from, to, greatest_curvature)
    })
}
