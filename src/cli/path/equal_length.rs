//! `path equal-length`.

use super::input::{angle, objects};
use super::{Files, Outcome, PathReport, Paths, figure};
use serde::Deserialize;
use spiral_atlas::curve::{EqualLength, equal_length};
use spiral_atlas::{Error, Result};

/// Join points and directions by paths of one given length, so that vehicles of one speed arrive at the same time.
///
/// Input: {"length": L, "paths": [{"start": [x, y], "end": [x, y], "start_direction": angle, "end_direction": angle},
/// ..]}.
///
/// Each path is the one of least absolute rotation of four; `paper` is the index of the one that the paper takes, of
/// its two.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  spiral-atlas path equal-length examples/swarm.json --figure swarm.png")]
pub(super) struct Args {
    #[command(flatten)]
    files: Files,
    /// Take the better of the paper's two solutions, not the best of four.
    #[arg(long)]
    paper: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    length: f64,
    #[serde(deserialize_with = "objects")]
    paths: Vec<Ends>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ends {
    start: [f64; 2],
    end: [f64; 2],
    #[serde(deserialize_with = "angle")]
    start_direction: f64,
    #[serde(deserialize_with = "angle")]
    end_direction: f64,
}

pub(super) fn run(args: &Args) -> Result<Outcome> {
    let input: Input = args.files.read()?;
    if input.paths.is_empty() {
        return Err(args.files.blame(Error::invalid("`paths` is empty; give the ends of one at least")));
    }
    let path = |(i, ends): (usize, &Ends)| {
        let Ends { start, end, start_direction, end_direction } = *ends;
        let choice = equal_length(&EqualLength { start, end, start_direction, end_direction, length: input.length })
            .map_err(|e| args.files.blame(e.at(format!("paths[{i}]"))))?;
        let paper = EqualLength::paper(&choice);
        Ok(PathReport::chosen(&choice, if args.paper { paper } else { choice.best }, Some(paper)))
    };
    let paths = input.paths.iter().enumerate().map(path).collect::<Result<Vec<_>>>()?;
    let paths = Paths { paths };
    let title = format!("Paths of length {}", input.length);
    args.files
        .finish(&paths, || figure::curves(&paths.paths.iter().map(PathReport::curves).collect::<Vec<_>>(), &title))
}
