//! Rows of a record, formatted by whoever has time.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::event::Event;
use super::recorder::Recorder;
use super::results::Results;

/// A row of a record seldom takes more.
const BYTES_OF_ROW: usize = 192;
/// A thread that waits for something else looks here for so long at a time.
const A_WHILE: Duration = Duration::from_millis(1);

/// Where threads leave blocks of results whose rows others may format: an orbit goes on at once, however long it is.
pub(super) struct Desk<'a> {
    recorder: Option<Recorder<'a>>,
    drawn: bool,
    leave: SyncSender<Block>,
    blocks: Mutex<Receiver<Block>>,
    /// Threads that wait for blocks, and those from which blocks may yet come.
    waiting: AtomicUsize,
    busy: AtomicUsize,
}

/// Results, and who waits for them with their rows.
pub(super) struct Block {
    results: Results,
    to: SyncSender<Results>,
}

/// A thread from which blocks may come.
pub(super) struct Busy<'a>(&'a AtomicUsize);

impl Drop for Busy<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::AcqRel);
    }
}

impl<'a> Desk<'a> {
    /// For rows of this record, if there is one; whether events are drawn as well.
    pub(super) fn new(recorder: Option<Recorder<'a>>, drawn: bool, threads: usize) -> Self {
        let (leave, blocks) = sync_channel(threads);
        let none = || AtomicUsize::new(0);
        Desk { recorder, drawn, leave, blocks: Mutex::new(blocks), waiting: none(), busy: none() }
    }

    /// This thread is at work, until what is returned is dropped.
    pub(super) fn busy(&self) -> Busy<'_> {
        self.busy.fetch_add(1, Ordering::AcqRel);
        Busy(&self.busy)
    }

    /// Hands over results by `out`, whose rows are formatted by a thread that waits for such, or by this one. Returns an empty
    /// place for events; nothing if nobody wants the results any more.
    pub(super) fn send(&self, results: Results, out: &SyncSender<Receiver<Results>>) -> Option<Vec<Event>> {
        let (to, mut formatted) = sync_channel(1);
        let mut block = Block { results, to };
        if self.recorder.is_none() {
            out.send(formatted).ok()?;
            return Some(self.format(block));
        }
        while let Err(error) = out.try_send(formatted) {
            let TrySendError::Full(again) = error else { return None };
            self.help();
            formatted = again;
        }
        if self.waiting.load(Ordering::Acquire) > 0 {
            match self.leave.try_send(block) {
                Ok(()) => return Some(vec![]),
                Err(TrySendError::Full(back) | TrySendError::Disconnected(back)) => block = back,
            }
        }
        Some(self.format(block))
    }

    /// Formats blocks of other threads until no more can come.
    pub(super) fn help_on(&self) {
        while self.recorder.is_some() && (self.busy.load(Ordering::Acquire) > 0 || self.help()) {
            self.help();
        }
    }

    /// Formats a block, if there is one in a while.
    fn help(&self) -> bool {
        self.waiting.fetch_add(1, Ordering::AcqRel);
        let block = self.blocks.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(A_WHILE);
        self.waiting.fetch_sub(1, Ordering::AcqRel);
        block.map(|block| self.format(block)).is_ok()
    }

    /// Formats the rows. Returns an empty place for events.
    fn format(&self, Block { mut results, to }: Block) -> Vec<Event> {
        let mut place = vec![];
        if let Some(recorder) = &self.recorder {
            results.rows = results.events.len() as u64;
            results.formatted.reserve(results.events.len() * BYTES_OF_ROW);
            results.events.iter().for_each(|event| recorder.write(event, &mut results.formatted));
            if !self.drawn {
                // nobody else wants them
                place = core::mem::take(&mut results.events);
                place.clear();
                results.ends.iter_mut().for_each(|(before, _)| *before = 0);
            }
        }
        // without a receiver nobody wants them any more
        let _ = to.send(results);
        place
    }
}
