//! What else joins two ends, where one kind of curve does not.

use super::segment::{Request, add_segment};
use super::{Ends, FITTED, Fit, Kind, fit};
use crate::error::Result;
use crate::family::reach::{self, Level};

/// Other kinds of curves that have a spiral where one has none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Others {
    /// Those that take the same ends.
    pub kinds: Vec<Kind>,
    /// Segments added to the straight end, where one of the ends is straight.
    pub segments: Vec<(reach::Kind, Request)>,
}

impl Others {
    /// All that join two ends by a spiral no longer than allowed, but for the kind that was asked: each is asked too.
    /// One that fails counts as none. Where no involute exists no spiral does, so that nobody is asked.
    pub fn new(ends: &Ends, kind: Kind, longest: f64) -> Others {
        let involute = fit(ends, Kind::Involute, longest);
        if involute.as_ref().is_ok_and(|found| found.solutions.is_empty()) {
            return Others::default();
        }
        let has = |found: &Result<Fit>| found.as_ref().is_ok_and(|found| found.outcome.is_ok());
        let joins = |kind: &Kind| match kind {
            Kind::Involute => has(&involute),
            _ => has(&fit(ends, *kind, longest)),
        };
        let segment = Request::between(ends).ok().flatten();
        let added = |kind: reach::Kind| {
            let request = segment?;
            let added = add_segment(kind, &request).ok()?.ok()?;
            let spiral = added.level != Level::Exists && added.piece.length() <= longest;
            spiral.then_some((kind, request))
        };
        Others {
            kinds: FITTED.into_iter().filter(|other| *other != kind).filter(joins).collect(),
            segments: [reach::Kind::Cubic, reach::Kind::Ph].into_iter().filter_map(added).collect(),
        }
    }
}
