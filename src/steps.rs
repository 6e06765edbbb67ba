//! Counts of steps, for tests that assert how much work an answer takes. Nothing is counted in the program itself.

#[cfg(test)]
thread_local! {
    static STEPS: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// One step of some work.
#[inline(always)]
pub(crate) fn step() {
    #[cfg(test)]
    STEPS.with(|steps| steps.set(steps.get() + 1));
}

/// How many steps some work takes, and what comes of it.
#[cfg(test)]
pub(crate) fn counted<T>(work: impl FnOnce() -> T) -> (usize, T) {
    let before = STEPS.with(|steps| steps.get());
    let result = work();
    (STEPS.with(|steps| steps.get()) - before, result)
}
