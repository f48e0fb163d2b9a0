//! Work that takes longer than a second shows its progress on a terminal.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Work that ends sooner shows nothing.
const PATIENCE: Duration = Duration::from_secs(1);
/// Interval between two updates of the progress.
pub(super) const GLANCE: Duration = Duration::from_millis(100);

/// What a progress bar says of Ctrl-C.
pub(super) fn of_ctrl_c(interrupted: bool) -> &'static str {
    if interrupted { "interrupting; Ctrl-C again keeps nothing" } else { "Ctrl-C keeps what is done" }
}

/// Does work whose progress is unknown, and shows on a terminal what is being done.
pub(super) fn with_spinner<R>(what: &str, work: impl FnOnce() -> R) -> R {
    let spinner = || {
        let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed} elapsed");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_spinner());
        ProgressBar::new_spinner().with_style(style).with_message(what.to_owned())
    };
    with_bar(spinner, ProgressBar::tick, work)
}

/// Does the work, and shows a progress bar on a terminal, updated again and again.
pub(super) fn with_bar<R>(
    bar: impl Fn() -> ProgressBar + Sync,
    update: impl Fn(&ProgressBar) + Sync,
    work: impl FnOnce() -> R,
) -> R {
    if !io::stderr().is_terminal() {
        return work();
    }
    let over = AtomicBool::new(false);
    thread::scope(|scope| {
        let watcher = scope.spawn(|| {
            let begun = Instant::now();
            let mut shown = None;
            while !over.load(Ordering::Relaxed) {
                thread::park_timeout(GLANCE);
                if begun.elapsed() > PATIENCE {
                    update(shown.get_or_insert_with(|| bar().with_elapsed(begun.elapsed())));
                }
            }
            if let Some(shown) = shown {
                shown.finish_and_clear();
            }
        });
        // ends the bar even if the work panics, since the scope waits for it
        let _over = Over { flag: &over, watcher: watcher.thread() };
        work()
    })
}

/// Ends the watch when it is dropped.
struct Over<'a> {
    flag: &'a AtomicBool,
    watcher: &'a thread::Thread,
}

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.flag.store(true, Ordering::Relaxed);
        self.watcher.unpark();
    }
}
