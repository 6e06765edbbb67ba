//! What is proved of a condition, and how verdicts combine.

/// A condition's verdict: `Some(true)`, it is proved to hold; `Some(false)`, it is proved to fail; `None`, undecided.
///
/// Shaders call the three `YES`, `NO` and `OPEN`. An undecided node has the code `Code::UNDECIDED`.
pub(crate) type Verdict = Option<bool>;

/// Whether all hold: no where one fails, else undecided where one is undecided.
pub(crate) fn all(conditions: impl IntoIterator<Item = Verdict>) -> Verdict {
    let mut known = Some(true);
    for condition in conditions {
        match condition {
            Some(false) => return Some(false),
            None => known = None,
            Some(true) => {}
        }
    }
    known
}

/// Whether both hold.
pub(crate) fn and(a: Verdict, b: Verdict) -> Verdict {
    all([a, b])
}

/// Whether one of both holds.
pub(crate) fn or(a: Verdict, b: Verdict) -> Verdict {
    not(and(not(a), not(b)))
}

/// The verdict with yes and no exchanged.
pub(crate) fn not(a: Verdict) -> Verdict {
    a.map(|holds| !holds)
}
