//! A piece moved inwards, before any cutting.
use super::{Origin, vertices::Site};
use crate::{Piece, shapes::Parallel};
use std::sync::Arc;

/// A moved piece.
#[derive(Clone, Debug)]
pub(super) struct Moved {
    pub(super) piece: Arc<dyn Piece>,
    pub(super) origin: Origin,
    /// Its finite ends.
    pub(super) ends: [Option<Site>; 2],
    /// For a curve without a figure, the part of its parallel curve that it is.
    pub(super) part: Option<Part>,
}

/// Part of a regular parallel curve.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) parallel: Parallel,
    /// Parts of one curve have the same mark.
    pub(super) curve: usize,
}

impl Part {
    /// Whether `next` continues along the curve where this part ends, given their numbers among the moved
    /// pieces.
    pub(super) fn leads_to(&self, next: &Part, [number, next_number]: [usize; 2]) -> bool {
        let base = self.parallel.base();
        let around = base.ends().is_none()
            && self.parallel.base_range()[1] == base.length()
            && next.parallel.base_range()[0] == 0.0;
        self.curve == next.curve && (next_number == number + 1 || around)
    }
}
