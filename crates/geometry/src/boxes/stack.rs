//! The nodes that a search has yet to visit.
use super::OPEN;

/// Places in a tree, the next one on top, in an array of fixed size.
pub(super) struct Stack<T> {
    places: [T; OPEN],
    count: usize,
}

impl<T: Copy> Stack<T> {
    /// A stack with one place to visit.
    #[inline(always)]
    pub(super) fn of(root: T) -> Self {
        Stack { places: [root; OPEN], count: 1 }
    }

    /// How many there are.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Takes the next one, as long as there are more than `bottom`.
    #[inline(always)]
    pub(super) fn pop(&mut self, bottom: usize) -> Option<T> {
        (self.count > bottom).then(|| {
            self.count -= 1;
            self.places[self.count]
        })
    }

    /// Pushes one on top.
    #[inline(always)]
    pub(super) fn push(&mut self, place: T) {
        self.places[self.count] = place;
        self.count += 1;
    }

    /// Inserts one below those on top that are `nearer`, but above the first `bottom` places.
    #[inline(always)]
    pub(super) fn insert(&mut self, bottom: usize, place: T, nearer: impl Fn(&T) -> bool) {
        let mut at = self.count;
        while at > bottom && nearer(&self.places[at - 1]) {
            self.places[at] = self.places[at - 1];
            at -= 1;
        }
        self.places[at] = place;
        self.count += 1;
    }
}
