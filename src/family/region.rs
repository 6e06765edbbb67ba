//! What a family can prove of its flags over a whole box of data.

/// Most coordinates of a box.
pub const MOST_SIDES: usize = 4;

/// What is proved of the flags over a closed box, bit by bit; see [`Region::facts`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Facts {
    /// Flags that hold at every point.
    pub inside: u8,
    /// Flags that hold at no point.
    pub outside: u8,
    /// About how much each coordinate moves what is left open: only a hint, for whoever halves the box.
    pub pull: [f64; MOST_SIDES],
}

/// Proofs over boxes, beside a family's proofs at points.
pub trait Region: Sync {
    /// Whether it has proofs in the family's chart of this name.
    fn covers(&self, chart: &str) -> bool;

    /// Proves what it can of the flags in `wanted` over the closed box of all real points between `low` and `high`,
    /// both included.
    ///
    /// What is said of a flag holds at every point of the box that lies in the family's domain. So a box may leave
    /// the domain, and a flag's verdict may be proved although other conditions change inside. Nothing is said by
    /// chance: where rounding could matter, nothing is said.
    ///
    /// # Arguments
    /// - `chart`: index of the family's chart; `low` and `high` have a coordinate for each of its axes, with `low <=
    ///   high`.
    /// - `wanted`: the flags that matter; others may be left open.
    fn facts(&self, chart: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts;
}
