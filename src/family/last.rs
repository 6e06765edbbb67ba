//! The last value of its kind, kept: neighbouring nodes share their angles, and the sines cost more than all else.

use std::cell::RefCell;
use std::rc::Rc;
use std::thread::LocalKey;

/// A key with its value.
pub(super) type Last<K, V> = RefCell<Option<(K, Rc<V>)>>;

/// The value of a key: the last one where that has the same key, else a new one.
pub(super) fn kept<K: PartialEq, V>(
    last: &'static LocalKey<Last<K, V>>,
    key: K,
    make: impl FnOnce() -> Option<V>,
) -> Option<Rc<V>> {
    last.with_borrow_mut(|last| match last {
        Some((known, value)) if *known == key => Some(value.clone()),
        _ => {
            let value = Rc::new(make()?);
            *last = Some((key, value.clone()));
            Some(value)
        }
    })
}
