//! A request that stands in a file.

use super::super::path::input;
use serde::Deserialize;
use spiral_atlas::transition::Turn;
use spiral_atlas::transition::join::{self, Family, Objective, State};
use spiral_atlas::{Error, Result};
use std::path::Path;

/// Longest file in bytes; a request has some hundred.
const MAX_INPUT: u64 = 1 << 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Request {
    from: End,
    to: End,
    greatest_curvature: f64,
    #[serde(default)]
    family: Family,
    #[serde(default)]
    objective: Objective,
    longest: Option<f64>,
    most_pieces: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum End {
    State {
        point: [f64; 2],
        #[serde(deserialize_with = "input::angle")]
        direction: f64,
        #[serde(default)]
        curvature: f64,
    },
    Line {
        point: [f64; 2],
        #[serde(deserialize_with = "input::angle")]
        direction: f64,
    },
    Circle {
        centre: [f64; 2],
        radius: f64,
        turn: Turn,
    },
}

impl From<End> for join::End {
    fn from(end: End) -> join::End {
        match end {
            End::State { point, direction, curvature } => State { point, direction, curvature }.into(),
            End::Line { point, direction } => join::End::Line { point, direction },
            End::Circle { centre, radius, turn } => join::End::Circle { centre, radius, turn },
        }
    }
}

/// What stands in a JSON file, in a TOML file named `.toml`, or as JSON in standard input for `-`.
pub(super) fn read(path: &Path) -> Result<join::Request> {
    let text = spiral_atlas::files::read_text(path, MAX_INPUT)?;
    let toml = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    let name = if path == Path::new("-") { "standard input".into() } else { path.display().to_string() };
    let Request { from, to, greatest_curvature, family, objective, longest, most_pieces } =
        input::parse(&text, toml).map_err(|e| Error::invalid(format!("{name}: {e}")))?;
    Ok(join::Request {
        family,
        objective,
        longest: longest.unwrap_or(f64::INFINITY),
        most_pieces: most_pieces.unwrap_or(join::Request::MOST_PIECES),
        ..join::Request::new(from, to, greatest_curvature)
    })
}
