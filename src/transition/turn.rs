//! Words for the two ends and the two sides.

use serde::{Deserialize, Serialize};
use std::fmt;

/// One of the user's two ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Which {
    /// Where the curve starts.
    Start,
    /// Where it ends.
    End,
}

/// The side to which the user's curve turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Turn {
    /// Counter-clockwise, positive curvature.
    Left,
    /// Clockwise, negative curvature.
    Right,
}

impl fmt::Display for Which {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == Which::Start { "start" } else { "end" })
    }
}

impl fmt::Display for Turn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == Turn::Left { "left" } else { "right" })
    }
}
