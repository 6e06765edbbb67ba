//! The path tools by name: a request in, an answer out, both as they are written in JSON.
//!
//! The command `path`, the Python package and the C library are layers over this. Fields and units are those of
//! docs/path.md.

mod ends;
mod given;
#[doc(hidden)]
pub mod input;
mod plan;
mod report;

pub use ends::{Chosen, EqualLengths, LeastBend, LeastBendPath, PathEnds, Paths, Through};
pub use given::{Apart, GivenPath, Measure, Measured, Measures, Pair, Separations, Vehicle, motions};
pub use plan::{Planned, PlannedPath};
pub use report::{CandidateReport, ChoiceReport, PathReport};

use crate::curve::Hermite;
use crate::error::{Error, Result};
use crate::path::Scene;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// A request to a path tool.
pub trait Tool: DeserializeOwned {
    /// What answers it.
    type Answer: Serialize;

    /// Answers it.
    ///
    /// # Errors
    /// [`Error::Domain`] naming what is wrong with the request; [`Error::NoPath`] with the reason, where there is no
    /// path such as was asked for.
    fn answer(self) -> Result<Self::Answer>;
}

/// The names of the tools.
pub const NAMES: [&str; 7] = ["hermite", "equal-length", "least-curvature", "spline", "plan", "separation", "measure"];

/// The answer that there is no path.
#[derive(Debug, Serialize)]
pub struct NoPath {
    /// Empty.
    pub paths: [PathReport; 0],
    /// Why.
    pub reason: String,
}

impl NoPath {
    /// For a reason.
    pub fn new(reason: String) -> NoPath {
        NoPath { paths: [], reason }
    }
}

/// Answers a request to a tool in JSON.
///
/// # Arguments
/// - `tool`: one of [`NAMES`].
/// - `request`: an object with the fields of docs/path.md. The options of the commands are fields too: `minimum` of
///   `separation`, `samples` and `offset` of `measure`, `paper` of `equal-length`.
///
/// # Returns
/// What the command prints. Where there is no path such as was asked for, `paths` is empty, and `reason` says why.
///
/// # Errors
/// [`Error::Domain`] for an unknown tool, for what is not such an object, and for values outside their domain.
///
/// ```
/// use spiral_atlas::tools;
/// let wave = tools::answer("spline", r#"{"points": [[0, 0], [1, 1], [2, 0], [3, 1]]}"#)?;
/// assert!(wave.starts_with(r#"{"paths":[{"length":"#));
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn answer(tool: &str, request: &str) -> Result<String> {
    match tool {
        "hermite" => of::<Hermite>(request),
        "equal-length" => of::<EqualLengths>(request),
        "least-curvature" => of::<LeastBend>(request),
        "spline" => of::<Through>(request),
        "plan" => of::<Scene>(request),
        "separation" => of::<Apart>(request),
        "measure" => of::<Measure>(request),
        _ => {
            let known = NAMES.join("`, `");
            Err(Error::invalid(format!("unknown tool `{}`; known are `{known}`", crate::plain::cut(tool))))
        }
    }
}

fn of<T: Tool>(request: &str) -> Result<String> {
    let asked: T = input::json(request).map_err(Error::invalid)?;
    match asked.answer() {
        Ok(found) => written(&found),
        Err(Error::NoPath(reason)) => written(&NoPath::new(reason)),
        Err(e) => Err(e),
    }
}

fn written(found: &impl Serialize) -> Result<String> {
    serde_json::to_string(found).map_err(|e| Error::invalid(format!("the answer cannot be written: {e}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_a_tool_and_no_other() {
        for tool in NAMES {
            let wrong = answer(tool, "[]").unwrap_err().to_string();
            assert!(wrong.contains("an object with the fields"), "{tool}: {wrong}");
        }
        let wrong = answer("splines", "{}").unwrap_err().to_string();
        assert!(wrong.contains("unknown tool `splines`; known are `hermite`"), "{wrong}");
    }

    #[test]
    fn no_path_is_an_answer_with_a_reason() {
        let blocked = r#"{"start": [0, 0], "goal": [10, 0], "clearance": 1, "greatest_curvature": 1,
            "obstacles": [[[-5, -5], [5, -5], [5, -4], [-5, -4]], [[-5, 4], [5, 4], [5, 5], [-5, 5]],
                          [[-5, -5], [-4, -5], [-4, 5], [-5, 5]], [[4, -5], [5, -5], [5, 5], [4, 5]]]}"#;
        let none = answer("plan", blocked).unwrap();
        assert!(none.starts_with(r#"{"paths":[],"reason":""#), "{none}");
    }
}
