//! Orbits as lines in the plane.

use billiards::geometry::{Lattice, Vector2};

use crate::picture::Path;

/// Lines of orbits; on a lattice, folded into the unit cell.
#[derive(Debug)]
pub(crate) struct Paths {
    lattice: Option<Lattice>,
    drawn: Vec<Path>,
}

/// Most edges of the unit cell that one leg is folded at: a longer flight would only blacken the picture.
const MOST_FOLDS: usize = 1000;

impl Paths {
    /// No lines yet.
    pub(crate) fn new(lattice: Option<Lattice>) -> Self {
        Paths { lattice, drawn: vec![] }
    }

    /// Starts the next orbit; the cell that it starts in.
    pub(crate) fn start(&mut self, at: [f64; 2]) -> [f64; 2] {
        let nowhere = (at.into(), [0.0; 2]);
        let (home, cell) = self.lattice.as_ref().map_or(nowhere, |lattice| lattice.reduce(&at.into()));
        self.drawn.push(Path { chains: vec![vec![home.into()]], ..Path::default() });
        cell
    }

    /// How many orbits have been started.
    pub(crate) fn started(&self) -> u64 {
        self.drawn.len() as u64
    }

    /// Flies on to a point of the plane; where the plane is folded, it is given by its copy in the unit cell and by the
    /// edges of cells crossed on the way, in lattice vectors.
    pub(crate) fn fly(&mut self, to: [f64; 2], cells: [f64; 2]) {
        let Some(path) = self.drawn.last_mut() else { return };
        let Some(chain) = path.chains.last_mut() else { return };
        match &self.lattice {
            Some(lattice) if cells != [0.0, 0.0] => {
                let Some(&from) = chain.last() else { return };
                fold(&mut path.chains, lattice, from.into(), to.into(), cells);
            }
            _ => chain.push(to),
        }
    }

    /// Flies on to a point that may lie in another cell, and stays there.
    pub(crate) fn rest(&mut self, at: [f64; 2]) {
        let nowhere = (at.into(), [0.0; 2]);
        let (home, cells) = self.lattice.as_ref().map_or(nowhere, |lattice| lattice.reduce(&at.into()));
        self.fly(home.into(), cells);
    }

    /// Leaves for ever in a direction.
    pub(crate) fn escape(&mut self, direction: [f64; 2]) {
        if let Some(path) = self.drawn.last_mut()
            && let Some(&point) = path.chains.last().and_then(|chain| chain.last())
        {
            path.escape = Some([point, direction]);
        }
    }

    /// Marks where the orbit is as the last place that is known.
    pub(crate) fn mark_horizon(&mut self) {
        if let Some(path) = self.drawn.last_mut() {
            path.horizon = path.chains.last().and_then(|chain| chain.last()).copied();
        }
    }

    /// The lines.
    pub(crate) fn into_paths(self) -> Vec<Path> {
        self.drawn
    }
}

/// A leg cut at the edges of cells, every part moved into the unit cell.
fn fold(chains: &mut Vec<Vec<[f64; 2]>>, lattice: &Lattice, from: Vector2<f64>, to: Vector2<f64>, cells: [f64; 2]) {
    let leg = to + lattice.translation(cells) - from;
    // the parts of the leg, between 0 and 1, at which a lattice coordinate is a whole number
    let (start, along) = (lattice.coordinates(&from), lattice.coordinates(&leg));
    let mut cuts = vec![];
    for i in 0..lattice.vectors().len() {
        let (first, last) = (start[i].min(start[i] + along[i]), start[i].max(start[i] + along[i]));
        let mut edge = libm::ceil(first);
        while edge <= last && cuts.len() < MOST_FOLDS {
            cuts.push((edge - start[i]) / along[i]);
            edge += 1.0;
        }
    }
    cuts.sort_by(f64::total_cmp);
    let mut begun = 0.0;
    for end in cuts.into_iter().chain([1.0]) {
        if end > begun {
            let middle = from + leg * (0.5 * (begun + end));
            let home = lattice.translation(lattice.reduce(&middle).1);
            let point = |part: f64| -> [f64; 2] { (from + leg * part - home).into() };
            match chains.last_mut() {
                // the first part goes on where the orbit is
                Some(chain) if begun == 0.0 => chain.push(point(end)),
                _ => chains.push(vec![point(begun), point(end)]),
            }
            begun = end;
        }
    }
    // the last part ends at the collision itself, not at a rounded copy of it
    if let Some(last) = chains.last_mut().and_then(|chain| chain.last_mut()) {
        *last = to.into();
    }
}
