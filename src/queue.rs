//! What waits to be looked at, the least bound first: for branch and bound, and for shortest ways. All searches use it.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Items by their bounds; of equal bounds the one that came first.
#[derive(Debug)]
pub(crate) struct Queue<T> {
    heap: BinaryHeap<Entry<T>>,
    count: u64,
}

#[derive(Debug)]
struct Entry<T> {
    bound: f64,
    number: u64,
    item: T,
}

impl<T> PartialEq for Entry<T> {
    fn eq(&self, other: &Entry<T>) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<T> Eq for Entry<T> {}

impl<T> PartialOrd for Entry<T> {
    fn partial_cmp(&self, other: &Entry<T>) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Entry<T> {
    /// The least is the greatest entry, for it comes out of the heap first.
    fn cmp(&self, other: &Entry<T>) -> Ordering {
        other.bound.total_cmp(&self.bound).then(other.number.cmp(&self.number))
    }
}

impl<T> Queue<T> {
    pub(crate) fn new() -> Queue<T> {
        Queue { heap: BinaryHeap::new(), count: 0 }
    }

    pub(crate) fn push(&mut self, bound: f64, item: T) {
        self.heap.push(Entry { bound, number: self.count, item });
        self.count += 1;
    }

    /// The item of the least bound, and that.
    pub(crate) fn pop(&mut self) -> Option<(f64, T)> {
        self.heap.pop().map(|entry| (entry.bound, entry.item))
    }

    /// The same, if the bound is below a limit.
    pub(crate) fn pop_below(&mut self, limit: f64) -> Option<(f64, T)> {
        if self.least()? < limit { self.pop() } else { None }
    }

    /// The least bound.
    pub(crate) fn least(&self) -> Option<f64> {
        self.heap.peek().map(|entry| entry.bound)
    }
}
