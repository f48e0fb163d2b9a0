//! The lock by which processes name their files in a folder one after the other.

use std::fs::{File, TryLockError};
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

/// Interval between two attempts.
const GLANCE: Duration = Duration::from_millis(5);

/// Locks the folder itself, so that nothing is left behind, until the file is dropped. `None` where folders cannot be locked, or
/// where another process holds the lock for longer than `patience`.
pub(super) fn lock(folder: &Path, patience: Duration) -> Option<File> {
    let begun = Instant::now();
    let locked = File::open(folder).ok()?;
    loop {
        match locked.try_lock() {
            Ok(()) => return Some(locked),
            Err(TryLockError::WouldBlock) if begun.elapsed() < patience => thread::sleep(GLANCE),
            Err(_) => return None,
        }
    }
}
