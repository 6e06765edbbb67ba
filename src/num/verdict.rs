//! What is proved of a condition, and how verdicts combine.

/// A condition's verdict: `Some(true)`, it is proved to hold; `Some(false)`, it is proved to fail; `None`, undecided.
///
/// In shaders and in codes of nodes the same are `YES`, `NO` and `OPEN`.
pub type Verdict = Option<bool>;

/// Whether all hold: it fails as soon as one is proved to fail.
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

/// Whether it fails.
pub(crate) fn not(a: Verdict) -> Verdict {
    a.map(|holds| !holds)
}
