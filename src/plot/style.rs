//! Sizes that depend on that of the letters.

/// Sizes that a figure's parts share, in pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    /// Size of ordinary text.
    pub em: f64,
    /// How far the numbers of an axis may stick out beyond its ends.
    pub slack: f64,
}

impl Style {
    /// Whole pixels for so many em.
    pub(super) fn px(&self, ems: f64) -> i32 {
        (self.em * ems).round() as i32
    }

    /// Height of the ticks and numbers below a rectangle.
    pub(super) fn below(&self) -> i32 {
        self.px(1.95)
    }

    /// Size of the numbers of an axis.
    pub(super) fn numbers(&self) -> f64 {
        self.em * 0.9
    }

    /// Length of a tick.
    pub(super) fn tick(&self) -> i32 {
        self.px(0.35)
    }
}
