//! Orbits as lines in the plane.

use billiards::geometry::{Lattice, Vector2};

use crate::picture::{Leaving, Path};

/// Lines of orbits; on a lattice, folded into the unit cell.
#[derive(Debug)]
pub(crate) struct Paths {
    lattice: Option<Lattice>,
    /// Most lines drawn for each orbit, and how many are left for the current one.
    most: usize,
    left: usize,
    /// Whether the current orbit has reached the point beyond which it is no longer drawn.
    is_beyond: bool,
    drawn: Vec<Path>,
}

/// Most lines that one leg is folded into: more lines for a longer flight would only blacken the picture.
const MOST_FOLDS: usize = 1000;

impl Paths {
    /// No lines yet; at most this many for each orbit.
    pub(crate) fn new(lattice: Option<Lattice>, most: usize) -> Self {
        Paths { lattice, most, left: 0, is_beyond: false, drawn: vec![] }
    }

    /// Starts the next orbit; returns the cell in which it starts.
    pub(crate) fn start(&mut self, at: [f64; 2]) -> [f64; 2] {
        let nowhere = (at.into(), [0.0; 2]);
        let (home, cell) = self.lattice.as_ref().map_or(nowhere, |lattice| lattice.reduce(&at.into()));
        self.drawn.push(Path { chains: vec![vec![home.into()]], ..Path::default() });
        (self.left, self.is_beyond) = (self.most, false);
        cell
    }

    /// How many orbits have been started.
    pub(crate) fn started(&self) -> u64 {
        self.drawn.len() as u64
    }

    /// Flies on to a point of the plane; where the plane is folded, it is given by its copy in the unit cell and by the
    /// edges of cells crossed on the way, in lattice vectors.
    pub(crate) fn fly(&mut self, to: [f64; 2], cells: [f64; 2]) {
        self.is_beyond |= self.left == 0;
        let Some(path) = self.drawn.last_mut().filter(|_| !self.is_beyond) else { return };
        let Some(chain) = path.chains.last_mut() else { return };
        match &self.lattice {
            Some(lattice) if cells != [0.0, 0.0] => {
                let Some(&from) = chain.last() else { return };
                let most = self.left.min(MOST_FOLDS);
                self.left -= fold(&mut path.chains, lattice, from.into(), to.into(), cells, most);
            }
            _ => {
                chain.push(to);
                self.left -= 1;
            }
        }
    }

    /// Flies on to a point that may lie in another cell, and stays there.
    pub(crate) fn rest(&mut self, at: [f64; 2]) {
        let nowhere = (at.into(), [0.0; 2]);
        let (home, cells) = self.lattice.as_ref().map_or(nowhere, |lattice| lattice.reduce(&at.into()));
        let is_there = |path: &Path| path.chains.last().and_then(|chain| chain.last()) == Some(&home.into());
        if cells == [0.0; 2] && self.drawn.last().is_some_and(is_there) {
            return; // it ended with a collision
        }
        self.fly(home.into(), cells);
    }

    /// Leaves for ever in a direction; on a lattice, the drawn part is folded into the unit cell.
    pub(crate) fn escape(&mut self, direction: [f64; 2]) {
        self.leave(direction, f64::INFINITY);
    }

    /// The same for a time, after which it is at a point that may lie in another cell.
    pub(crate) fn drift(&mut self, direction: [f64; 2], time: f64, to: [f64; 2]) {
        self.leave(direction, time);
        let home = self.lattice.as_ref().map_or(to, |lattice| lattice.reduce(&to.into()).0.into());
        if let Some(path) = self.drawn.last_mut().filter(|_| !self.is_beyond) {
            path.rest = Some(home);
        }
    }

    fn leave(&mut self, direction: [f64; 2], until: f64) {
        if let Some(path) = self.drawn.last_mut().filter(|_| !self.is_beyond)
            && let Some(&from) = path.chains.last().and_then(|chain| chain.last())
        {
            path.escape = match &self.lattice {
                Some(lattice) => leaving(lattice, from.into(), direction.into(), until, self.left.min(MOST_FOLDS)),
                None => vec![Leaving { from, direction, until }],
            };
        }
    }

    /// Marks the current point of the orbit as the last known one.
    pub(crate) fn mark_horizon(&mut self) {
        if let Some(path) = self.drawn.last_mut().filter(|_| !self.is_beyond) {
            path.horizon = path.chains.last().and_then(|chain| chain.last()).copied();
        }
    }

    /// The lines.
    pub(crate) fn into_paths(self) -> Vec<Path> {
        self.drawn
    }
}

/// Cuts a leg at the edges of cells and moves every part into the unit cell; returns how many parts are drawn: for a longer leg,
/// the first ones and its end.
fn fold(
    chains: &mut Vec<Vec<[f64; 2]>>,
    lattice: &Lattice,
    from: Vector2<f64>,
    to: Vector2<f64>,
    cells: [f64; 2],
    most: usize,
) -> usize {
    let leg = to + lattice.translation(cells) - from;
    let (mut begun, mut drawn) = (0.0, 0);
    for end in cuts(lattice, &from, &leg, 1.0, most).into_iter().chain([1.0]) {
        if end > begun {
            if drawn == most {
                chains.push(vec![to.into()]);
                return drawn;
            }
            let middle = from + leg * (0.5 * (begun + end));
            let cell = lattice.reduce(&middle).1;
            let home = lattice.translation(cell);
            let point = |part: f64| -> [f64; 2] { (from + leg * part - home).into() };
            match chains.last_mut() {
                // the first part continues from where the orbit is, unless that is an edge of the cell and the orbit leaves there
                Some(chain) if begun == 0.0 && cell == [0.0; 2] => chain.push(point(end)),
                _ => chains.push(vec![point(begun), point(end)]),
            }
            begun = end;
            drawn += 1;
        }
    }
    // the last part ends at the collision itself, not at a rounded copy of it
    if let Some(last) = chains.last_mut().and_then(|chain| chain.last_mut()) {
        *last = to.into();
    }
    drawn
}

/// A leg that no wall ends, cut at the edges of cells, with its first `most` parts moved into the unit cell.
fn leaving(lattice: &Lattice, from: Vector2<f64>, direction: Vector2<f64>, until: f64, most: usize) -> Vec<Leaving> {
    let cuts = cuts(lattice, &from, &direction, until, most);
    if cuts.is_empty() {
        return vec![Leaving { from: from.into(), direction: direction.into(), until }];
    }
    let mut begun = 0.0;
    let mut legs = vec![];
    // of a leg without end there are more cuts than are drawn
    let last = Some(until).filter(|until| until.is_finite());
    for end in cuts.into_iter().chain(last).filter(|end| *end > 0.0) {
        if end > begun && legs.len() < most {
            let middle = from + direction * (0.5 * (begun + end));
            let home = lattice.translation(lattice.reduce(&middle).1);
            let first = from + direction * begun - home;
            legs.push(Leaving { from: first.into(), direction: direction.into(), until: end - begun });
            begun = end;
        }
    }
    legs
}

/// The parts of a leg, between 0 and `until`, at which a lattice coordinate is a whole number: the first `most` of them, and more.
fn cuts(lattice: &Lattice, from: &Vector2<f64>, leg: &Vector2<f64>, until: f64, most: usize) -> Vec<f64> {
    let (start, along) = (lattice.coordinates(from), lattice.coordinates(leg));
    let mut cuts = vec![];
    for i in (0..lattice.vectors().len()).filter(|i| along[*i] != 0.0) {
        let forwards = along[i] > 0.0;
        let (first, step) = if forwards { (libm::ceil(start[i]), 1.0) } else { (libm::floor(start[i]), -1.0) };
        // one more than are drawn, and one for the start if that is on an edge
        let parts = (0..most + 2).map(|k| (first + step * k as f64 - start[i]) / along[i]);
        cuts.extend(parts.take_while(|part| *part <= until));
    }
    cuts.sort_by(f64::total_cmp);
    cuts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_out_of_a_channel_stays_in_the_unit_cell() {
        let band = Lattice::new(&[Vector2::new(1.0, 0.0)]).unwrap();
        let mut paths = Paths::new(Some(band), 20_000);
        for (from, direction) in [([0.25, 0.0], [1.0, 0.25]), ([0.25, 3.0], [-3.0, -0.5]), ([0.0, 1.0], [-0.5, 1.0])] {
            paths.start(from);
            paths.escape(direction);
            let legs = &paths.drawn.last().unwrap().escape;
            assert_eq!(legs.len(), MOST_FOLDS);
            let mut height = from[1];
            for leg in legs {
                let x = [0.0, leg.until].map(|s| leg.from[0] + s * leg.direction[0]);
                assert!(x.iter().all(|x| (-1e-9..=1.0 + 1e-9).contains(x)), "{leg:?}");
                assert!((leg.from[1] - height).abs() < 1e-9, "{leg:?} {height}");
                height += leg.until * leg.direction[1];
            }
        }
        // straight out, nothing is folded
        paths.start([0.25, 0.0]);
        paths.escape([0.0, -2.0]);
        let straight = Leaving { from: [0.25, 0.0], direction: [0.0, -2.0], until: f64::INFINITY };
        assert_eq!(paths.drawn.last().unwrap().escape, [straight]);
    }

    #[test]
    fn a_way_out_of_a_channel_that_the_time_ends_ends_there() {
        let band = Lattice::new(&[Vector2::new(1.0, 0.0)]).unwrap();
        let mut paths = Paths::new(Some(band), 20_000);
        for (time, parts, rest) in [(2.0, 1, [0.75, 0.5]), (5.0, 2, [0.5, 1.25]), (1e6, MOST_FOLDS, [0.25, 250_000.0])]
        {
            paths.start([0.25, 0.0]);
            paths.drift([0.25, 0.25], time, [0.25 + 0.25 * time, 0.25 * time]);
            let path = paths.drawn.last().unwrap();
            assert_eq!((path.escape.len(), path.rest), (parts, Some(rest)));
            let last = path.escape.last().unwrap();
            let end = [0, 1].map(|i| last.from[i] + last.until * last.direction[i]);
            assert_eq!(end == rest, parts < MOST_FOLDS, "{time}: {end:?}");
        }
    }

    fn on_torus(most: usize) -> Paths {
        let lattice = Lattice::new(&[Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)]).unwrap();
        let mut paths = Paths::new(Some(lattice), most);
        paths.start([0.5, 0.25]);
        paths
    }

    /// The lines drawn, none of which may leave the unit cell.
    fn lines(paths: Paths) -> usize {
        let [path] = &paths.into_paths()[..] else { panic!("one orbit") };
        for point in path.chains.iter().flatten() {
            assert!(point.iter().all(|x| (-1e-9..=1.0 + 1e-9).contains(x)), "{point:?}");
        }
        path.chains.iter().map(|chain| chain.len() - 1).sum()
    }

    #[test]
    fn a_flight_through_very_many_cells_stays_in_the_cell_and_ends_where_it_ends() {
        for cells in [[123_456.0, 76_299.0], [-123_456.0, 76_299.0], [3.0, -99_999.0], [0.0, 5000.0]] {
            let mut paths = on_torus(20_000);
            paths.fly([0.75, 0.5], cells);
            paths.fly([0.25, 0.5], [0.0; 2]);
            let last = paths.drawn[0].chains.last().cloned();
            assert_eq!(last, Some(vec![[0.75, 0.5], [0.25, 0.5]]), "{cells:?}");
            assert_eq!(lines(paths), MOST_FOLDS + 1, "{cells:?}");
        }
    }

    #[test]
    fn a_flight_out_of_the_cell_from_its_edge_goes_on_at_the_other_edge() {
        let mut paths = on_torus(10);
        for (from, to, cells, on) in [
            ([0.0, 0.25], [0.75, 0.5], [-1.0, 0.0], [1.0, 0.25]),
            ([0.0, 0.0], [0.75, 0.5], [-1.0, -1.0], [1.0, 1.0]),
            ([0.5, 0.0], [0.75, 0.5], [0.0, -1.0], [0.5, 1.0]),
        ] {
            paths.start(from);
            paths.fly(to, cells);
            assert_eq!(paths.drawn.last().unwrap().chains, [vec![from], vec![on, to]]);
        }
        // into the cell, or along its edge
        for to in [[0.25, 0.5], [0.0, 0.75]] {
            paths.start([0.0, 0.5]);
            paths.fly(to, [0.0, 0.0]);
            paths.fly([0.25, 0.25], [0.0, 1.0]);
            assert_eq!(paths.drawn.last().unwrap().chains[0][..2], [[0.0, 0.5], to]);
            assert_eq!(paths.drawn.last().unwrap().chains.len(), 2);
        }
    }

    #[test]
    fn of_an_orbit_as_many_lines_are_drawn_as_may_be_however_they_are_folded() {
        let mut paths = on_torus(10);
        for _ in 0..5 {
            paths.fly([0.5, 0.5], [2.0, 1.0]);
            paths.fly([0.5, 0.25], [-2.0, -1.0]);
        }
        paths.mark_horizon();
        paths.escape([1.0, 0.0]);
        assert_eq!((paths.drawn[0].horizon, &paths.drawn[0].escape[..]), (None, &[][..]));
        assert_eq!(lines(paths), 10);
    }
}
