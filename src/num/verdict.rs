//! What is proved of a condition, and how verdicts combine.

use std::ops::Not;

/// What is proved of a condition.
///
/// Shaders call the three `YES`, `NO` and `OPEN`. A node of which a condition is undecided has the code
/// `Code::UNDECIDED`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It is proved to hold.
    Yes,
    /// It is proved to fail.
    No,
    /// Neither is proved.
    Undecided,
}

impl Verdict {
    /// Of a condition that is known.
    pub(crate) const fn of(holds: bool) -> Verdict {
        if holds { Verdict::Yes } else { Verdict::No }
    }

    /// From two proofs, of which one at most succeeds: that it holds, and that it fails.
    pub(crate) const fn proved(holds: bool, fails: bool) -> Verdict {
        if holds {
            Verdict::Yes
        } else if fails {
            Verdict::No
        } else {
            Verdict::Undecided
        }
    }

    /// Whether it holds; `None` where that is undecided.
    pub(crate) const fn decided(self) -> Option<bool> {
        match self {
            Verdict::Yes => Some(true),
            Verdict::No => Some(false),
            Verdict::Undecided => None,
        }
    }

    pub(crate) fn is_yes(self) -> bool {
        self == Verdict::Yes
    }

    pub(crate) fn is_no(self) -> bool {
        self == Verdict::No
    }

    pub(crate) fn is_open(self) -> bool {
        self == Verdict::Undecided
    }

    /// Whether both hold: no where one fails, else undecided where one is undecided.
    pub(crate) fn and(self, other: Verdict) -> Verdict {
        Verdict::proved(self.is_yes() && other.is_yes(), self.is_no() || other.is_no())
    }

    /// Whether one of both holds.
    pub(crate) fn or(self, other: Verdict) -> Verdict {
        !(!self).and(!other)
    }

    /// Whether all hold.
    pub(crate) fn all(conditions: impl IntoIterator<Item = Verdict>) -> Verdict {
        let mut known = Verdict::Yes;
        for condition in conditions {
            known = known.and(condition);
            if known.is_no() {
                break;
            }
        }
        known
    }

    /// The same where it is no, else undecided: for what was looked at in more than may be.
    pub(crate) fn only_no(self) -> Verdict {
        Verdict::proved(false, self.is_no())
    }
}

/// The verdict with yes and no exchanged.
impl Not for Verdict {
    type Output = Verdict;

    fn not(self) -> Verdict {
        Verdict::proved(self.is_no(), self.is_yes())
    }
}

/// `None` is undecided.
impl From<Option<bool>> for Verdict {
    fn from(known: Option<bool>) -> Verdict {
        known.map_or(Verdict::Undecided, Verdict::of)
    }
}
