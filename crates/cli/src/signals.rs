//! Which signals reach the program.

use std::fs;

use nix::sys::signal::{SigSet, Signal};

/// Where a file grows beyond the limit on its size, writing fails as on a full disk and does not end the process.
pub fn survive_long_files() {
    // threads begun from here on block it, too; a failure to block it prevents nothing
    let _ = SigSet::from(Signal::SIGXFSZ).thread_block();
}

/// A request to end that the program was started to ignore, as by `nohup` or in the background of a script, never reaches it. Call
/// this before another thread begins. Only Linux tells which signals are ignored.
pub fn leave_ignored_ones_alone() {
    let ignored = ignored(&fs::read_to_string("/proc/self/status").unwrap_or_default());
    let requests = [Signal::SIGINT, Signal::SIGTERM, Signal::SIGHUP];
    let set: SigSet = requests.into_iter().filter(|signal| ignored >> (*signal as u32 - 1) & 1 == 1).collect();
    // ctrlc handles all of them; blocked ones do not get that far
    let _ = set.thread_block();
}

/// The signals that are ignored, the first one in the lowest bit, as the status of a process tells them.
fn ignored(status: &str) -> u64 {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_status_of_a_process_tells_which_signals_are_ignored() {
        let status =
            "Name:\tbilliards\nSigBlk:\t0000000000000002\nSigIgn:\t0000000000001001\nSigCgt:\t0000000000004000\n";
        assert_eq!(ignored(status), 1 << (Signal::SIGHUP as u32 - 1) | 1 << (Signal::SIGPIPE as u32 - 1));
        assert_eq!([ignored(""), ignored("SigIgn:\tnone\n")], [0, 0]);
    }
}
