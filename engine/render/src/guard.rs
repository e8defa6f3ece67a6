//! Faults of code that is not ours, caught where it is called.
//!
//! Shaders are composed and checked by libraries that stop with a panic where they meet something
//! that their authors did not think of. A student's text must never end the program, so such a panic
//! becomes an error, and the text that led to it is named.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static CAUGHT_HERE: Cell<bool> = const { Cell::new(false) };
}

/// Runs `work`, and gives the words of a panic in it as an error.
///
/// What `work` was changing when it stopped must not be used again.
///
/// # Errors
/// The panic's message.
pub fn catch<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    let before = CAUGHT_HERE.replace(true);
    let result = catch_unwind(AssertUnwindSafe(work));
    CAUGHT_HERE.set(before);
    result.map_err(|payload| {
        let text = payload.downcast_ref::<&str>().copied();
        let owned = payload.downcast_ref::<String>().map(String::as_str);
        text.or(owned).unwrap_or("no message").to_owned()
    })
}

/// Whether a panic of this thread would be caught by [`catch`]: a panic hook then has nothing to
/// say.
pub fn is_caught() -> bool {
    CAUGHT_HERE.get()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panics_become_errors() {
        assert_eq!(catch(|| 7), Ok(7));
        let inside = catch(|| {
            assert!(is_caught());
            panic!("no {}", "way")
        });
        assert_eq!(inside, Err::<(), _>("no way".to_owned()));
        assert!(!is_caught());
    }
}
