//! Stretches of one line or curve, and which of them overlap.

/// A piece as a stretch of the line or curve on which it lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) number: usize,
    /// Whether it has the table on this side.
    pub(super) forward: bool,
    pub(super) from: f64,
    pub(super) to: f64,
    /// Whether it is known to coincide with another one.
    is_double: bool,
}

impl Stretch {
    pub(super) fn new(number: usize, forward: bool, [from, to]: [f64; 2]) -> Stretch {
        Stretch { number, forward, from, to, is_double: false }
    }
}

/// The numbers of stretches that overlap one with the table on the other side, as confirmed by `coincide` for their indices.
pub(super) fn doubles(mut line: Vec<(Stretch, usize)>, coincide: impl Fn(usize, usize, f64) -> bool) -> Vec<usize> {
    line.sort_by(|(a, _), (b, _)| a.from.total_cmp(&b.from));
    let mut found = vec![];
    // the stretches that reach this far; of those already found, the farthest one in each direction suffices
    let mut open: Vec<usize> = vec![];
    for k in 0..line.len() {
        open.retain(|&other| line[other].0.to > line[k].0.from);
        for &other in &open {
            let ((a, i), (b, j)) = (line[k], line[other]);
            let overlap = a.to.min(b.to) - a.from.max(b.from);
            if !(a.is_double && b.is_double) && a.forward != b.forward && coincide(i, j, overlap) {
                (line[k].0.is_double, line[other].0.is_double) = (true, true);
                found.extend([a.number, b.number]);
            }
        }
        open.push(k);
        for forward in [true, false] {
            let of_these = |&&i: &&usize| line[i].0.is_double && line[i].0.forward == forward;
            let farthest = open.iter().filter(of_these).copied().max_by(|&i, &j| line[i].0.to.total_cmp(&line[j].0.to));
            open.retain(|i| !of_these(&i) || Some(*i) == farthest);
        }
    }
    found
}
