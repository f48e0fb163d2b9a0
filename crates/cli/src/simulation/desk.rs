//! Rows of a record, formatted by any thread that is free.

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use super::event::Event;
use super::recorder::Recorder;
use super::results::Results;

/// Bytes that a row of a record seldom exceeds.
const BYTES_OF_ROW: usize = 192;

/// Where threads leave blocks of results for others to format, so that a long orbit can go on at once.
pub(super) struct Desk<'a> {
    recorder: Option<Recorder<'a>>,
    drawn: bool,
    state: Mutex<State>,
    /// Wakes waiting threads, whether they wait for a block or for something else.
    news: Condvar,
}

#[derive(Default)]
struct State {
    /// Blocks to be formatted. For each there is a waiting thread, and every thread that stops waiting takes one.
    blocks: VecDeque<Block>,
    waiting: usize,
    /// Number of threads from which blocks may still come.
    busy: usize,
    /// How often results have been taken to be consumed, and how many threads wait for that.
    taken: u64,
    full: usize,
}

/// Results, and the channel on which they are expected with their rows.
struct Block {
    results: Results,
    to: SyncSender<Results>,
}

/// A thread from which blocks may come.
pub(super) struct Busy<'a>(&'a Desk<'a>);

impl Drop for Busy<'_> {
    fn drop(&mut self) {
        let mut state = self.0.state();
        state.busy -= 1;
        if state.busy == 0 {
            self.0.news.notify_all();
        }
    }
}

/// The thread that consumes results.
pub(super) struct Consumer<'a>(&'a Desk<'a>);

impl Consumer<'_> {
    /// Announces that results have been taken, so that there is room for others.
    pub(super) fn has_taken(&self) {
        let mut state = self.0.state();
        state.taken += 1;
        if state.full > 0 {
            self.0.news.notify_all();
        }
    }
}

impl Drop for Consumer<'_> {
    fn drop(&mut self) {
        // threads that wait for room find that nothing is consumed any more
        self.has_taken();
    }
}

impl<'a> Desk<'a> {
    /// A desk for rows of this record, if there is one; `drawn`: events are drawn as well.
    pub(super) fn new(recorder: Option<Recorder<'a>>, drawn: bool) -> Self {
        Desk { recorder, drawn, state: Mutex::default(), news: Condvar::new() }
    }

    /// Marks this thread as busy until the returned value is dropped.
    pub(super) fn busy(&self) -> Busy<'_> {
        self.state().busy += 1;
        Busy(self)
    }

    /// Marks this thread as the consumer of results. The value must be dropped only when nothing can be sent to it any more.
    pub(super) fn consumer(&self) -> Consumer<'_> {
        Consumer(self)
    }

    /// Sends results through `out`; their rows are formatted by a waiting thread, or by this one. Returns an empty buffer for
    /// events; `None` if the results are no longer wanted.
    pub(super) fn send(&self, results: Results, out: &SyncSender<Receiver<Results>>) -> Option<Vec<Event>> {
        let (to, mut formatted) = sync_channel(1);
        let block = Block { results, to };
        if self.recorder.is_none() {
            out.send(formatted).ok()?;
            return Some(self.format(block));
        }
        loop {
            let before = self.state().taken;
            match out.try_send(formatted) {
                Ok(()) => break,
                Err(TrySendError::Full(again)) => formatted = again,
                Err(TrySendError::Disconnected(_)) => return None,
            }
            self.state().full += 1;
            let other = self.wait(|state| state.taken != before);
            self.state().full -= 1;
            other.map(|other| self.format(other));
        }
        let mut state = self.state();
        if state.blocks.len() < state.waiting {
            state.blocks.push_back(block);
            self.news.notify_one();
            return Some(vec![]);
        }
        drop(state);
        Some(self.format(block))
    }

    /// Formats blocks of other threads until no more can come.
    pub(super) fn help_on(&self) {
        while let Some(block) = self.wait(|state| state.busy == 0) {
            self.format(block);
        }
    }

    /// Waits for a block to be formatted, or until `enough` holds.
    fn wait(&self, enough: impl Fn(&State) -> bool) -> Option<Block> {
        let mut state = self.state();
        state.waiting += 1;
        let nothing = |state: &mut State| state.blocks.is_empty() && !enough(state);
        let mut state = self.news.wait_while(state, nothing).unwrap_or_else(PoisonError::into_inner);
        state.waiting -= 1;
        state.blocks.pop_front()
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Formats the rows. Returns an empty buffer for events.
    fn format(&self, Block { mut results, to }: Block) -> Vec<Event> {
        let mut place = vec![];
        if let Some(recorder) = &self.recorder {
            results.rows = results.events.len() as u64;
            results.formatted.reserve(results.events.len() * BYTES_OF_ROW);
            results.events.iter().for_each(|event| recorder.write(event, &mut results.formatted));
            if !self.drawn {
                // the events are not needed elsewhere
                place = core::mem::take(&mut results.events);
                place.clear();
                results.ends.iter_mut().for_each(|(before, _)| *before = 0);
            }
        }
        // without a receiver they are no longer wanted
        let _ = to.send(results);
        place
    }
}
