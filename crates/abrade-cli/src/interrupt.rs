//! The user's interrupt.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that an interrupt sets from now on.
pub(crate) fn flag() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&flag);
    // Without a handler an interrupt ends the process as it always did.
    let _ = ctrlc::set_handler(move || seen.store(true, Ordering::Relaxed));
    flag
}
