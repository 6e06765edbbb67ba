//! The exact answer for one datum, in a form that fits every family: what `query` reports.

use super::Code;

/// All that a family knows of a datum.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The proved verdicts, as an atlas has them.
    pub code: Code,
    /// What else follows from the datum, by name: its coordinates in the family's other charts, invariants.
    pub derived: Values,
    /// The curves with these ends.
    pub solutions: Vec<Values>,
    /// Which of them the family's scalars describe.
    pub chosen: Option<usize>,
}

/// Values by name, in the order in which they are printed.
pub type Values = Vec<(&'static str, Value)>;

/// A value of an [`Answer`].
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A finite number.
    Number(f64),
    /// A number of things, or a case.
    Whole(u32),
    /// Whether a condition holds.
    Holds(bool),
    /// One of a few words.
    Word(&'static str),
    /// Control points.
    Points(Vec<[f64; 2]>),
}

impl Value {
    fn is_finite(&self) -> bool {
        match self {
            Value::Number(x) => x.is_finite(),
            Value::Points(points) => points.iter().flatten().all(|x| x.is_finite()),
            Value::Whole(_) | Value::Holds(_) | Value::Word(_) => true,
        }
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Value {
        Value::Number(x)
    }
}

impl From<bool> for Value {
    fn from(holds: bool) -> Value {
        Value::Holds(holds)
    }
}

impl<const N: usize> From<[[f64; 2]; N]> for Value {
    fn from(points: [[f64; 2]; N]) -> Value {
        Value::Points(points.to_vec())
    }
}

impl Answer {
    /// Which number is not finite, in words; the first one.
    pub(super) fn beyond_range(&self) -> Option<String> {
        let first = |values: &Values| values.iter().find(|(_, value)| !value.is_finite()).map(|(name, _)| *name);
        let of_solution = |(i, values)| first(values).map(|name| format!("{name} of solution {i}"));
        let derived = first(&self.derived).map(str::to_owned);
        derived.or_else(|| self.solutions.iter().enumerate().find_map(of_solution))
    }

    /// The control points of the chosen curve.
    pub fn control_points(&self) -> Option<&[[f64; 2]]> {
        self.solutions.get(self.chosen?)?.iter().find_map(|(name, value)| match value {
            Value::Points(points) if *name == "control_points" => Some(points.as_slice()),
            _ => None,
        })
    }

    /// A derived number by name.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.derived.iter().find_map(|(n, value)| match value {
            Value::Number(x) if *n == name => Some(*x),
            _ => None,
        })
    }
}
