//! The connected parts of a table.
use crate::{
    Table,
    sight::{Aim, Sight, Wall},
    table::Parted,
};
use nalgebra::Vector2;

/// A connected part of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// The numbers of the pieces that bound it, in rising order.
    pub pieces: Vec<usize>,
    /// Its area \[L²\], per unit cell on a lattice; infinite where it is unbounded.
    pub area: f64,
    /// The length of its boundary \[L\], per unit cell on a lattice.
    pub perimeter: f64,
}

impl Table {
    /// The connected parts of the table (what a point can reach), in the order of their lowest piece numbers. Walls that only touch at
    /// points also separate parts, and a piece may bound several of them; contacts of ellipses and of curves given by formulas are not
    /// recognised.
    ///
    /// ```
    /// use geometry::tables;
    /// // a disk that does not fit between the scatterer and the walls can only be in one of the four corners
    /// let centres = tables::sinai(2.0, 0.5)?.offset(0.3)?.table;
    /// assert_eq!(centres.components().len(), 4);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn components(&self) -> Vec<Component> {
        components_of(self, self.parted())
    }
}

/// The connected parts of a table, perhaps given as parted where boundaries touch.
pub(crate) fn components_of(table: &Table, parted: Option<Parted>) -> Vec<Component> {
    let mut found = components(parted.as_ref().map_or(table, |parted| &parted.table));
    if let Some(Parted { numbers, .. }) = parted {
        for Component { pieces, .. } in &mut found {
            *pieces = pieces.iter().map(|&i| numbers[i]).collect();
            pieces.dedup();
        }
    }
    found.sort_by(|a, b| a.pieces.cmp(&b.pieces));
    found
}

/// The connected parts of a table on whose boundary nothing touches.
fn components(table: &Table) -> Vec<Component> {
    let sight = Sight::new(table, 2.0);
    let chains = &sight.chains;
    let mut groups = Groups::new(chains.len());
    let distant = sight.infinite();
    let Continued { after, period } = Continued::of(table, chains);
    for (k, next) in after.iter().enumerate() {
        if let &Some(next) = next {
            groups.unite(k, next);
        }
    }
    // two degrees off the vertical, a direction that drawn sides and lines through two drawn vertices hardly ever have; or away from a
    // wall that goes on for ever
    let forward = period.map_or(Vector2::new(1.0, 0.0), |period| period / libm::hypot(period.x, period.y));
    let up = Vector2::new(-forward.y, forward.x) * 0.999_472_5 + forward * 0.032_475_5;
    for k in 0..chains.len() {
        let others = distant.iter().filter(|&&other| other != k).map(|&other| Aim::At(other));
        // a part without an endless wall above it has one below it
        let down = period.map(|_| Aim::Along(-up));
        // inward, should no line upwards be clear
        for aim in [Aim::Along(up), Aim::Inward].into_iter().chain(down).chain(others) {
            let until = |wall: &Wall| {
                let there = sight.chain_of[wall.number];
                match aim {
                    Aim::At(other) => there == other,
                    // Where a line leaves an obstacle for the last time, it goes on into the part of the table around it, and is there
                    // again beyond each obstacle of that part. Up to its first wall above the one where it began, these are all united
                    // with that one, and the last of them, in front of that wall or around it, reaches higher, or bounds the part from
                    // without. So each is united with a higher one, up to the outer wall.
                    Aim::Along(direction) => there != k && sight.extents[k].is_behind(&wall.point, &direction),
                    Aim::Inward | Aim::Outward => there != k,
                }
            };
            let Some((walls, _)) = sight.look(k, aim, until) else { continue };
            for pair in walls.windows(2).filter(|pair| sight.is_table_behind(&pair[0])) {
                groups.unite(sight.chain_of[pair[0].number], sight.chain_of[pair[1].number]);
            }
        }
    }
    // where no wall goes on for ever, all chains that enclose no room bound the same part from within
    if distant.is_empty() && period.is_none() {
        let around_no_room = |group: &Vec<usize>| {
            let length: f64 = group.iter().flat_map(|&k| &chains[k]).map(|&i| table.pieces()[i].length()).sum();
            table.enclosed_by(group.iter().map(|&k| &chains[k])) <= sight.rounding * length
        };
        let outside: Vec<Vec<usize>> = groups.all().into_iter().filter(around_no_room).collect();
        outside.windows(2).for_each(|pair| groups.unite(pair[0][0], pair[1][0]));
    }
    let mut components: Vec<Component> = vec![];
    for group in groups.all() {
        let members: Vec<&Vec<usize>> = group.iter().map(|&k| &chains[k]).collect();
        let mut pieces: Vec<usize> = members.iter().flat_map(|c| c.iter().copied()).collect();
        pieces.sort_unstable();
        let area = table.bounded_by(members.iter().copied());
        let perimeter = pieces.iter().map(|&i| table.pieces()[i].length()).sum();
        components.push(Component { pieces, area, perimeter });
    }
    components
}

/// How chains continue in translates of others, or of themselves.
struct Continued {
    /// For each chain the one of which a translate begins where it ends.
    after: Vec<Option<usize>>,
    /// The translation after which the first endless wall repeats itself.
    period: Option<Vector2<f64>>,
}

impl Continued {
    fn of(table: &Table, chains: &[Vec<usize>]) -> Continued {
        let ends = |k: usize| {
            let chain: &Vec<usize> = &chains[k];
            let [first, last] = [chain[0], chain[chain.len() - 1]].map(|i| table.pieces()[i].ends());
            Some([first?[0], last?[1]]).filter(|_| !table.is_closed(chain))
        };
        let Some(lattice) = table.shortest() else {
            return Continued { after: vec![None; chains.len()], period: None };
        };
        let open: Vec<(usize, [Vector2<f64>; 2])> = (0..chains.len()).filter_map(|k| Some((k, ends(k)?))).collect();
        let mut after = vec![None; chains.len()];
        for (at, &(k, [_, end])) in open.iter().enumerate() {
            // the chain itself first: where walls touch, several chains begin
            let mut from_here = open[at..].iter().chain(&open[..at]);
            after[k] = from_here.find(|(_, [start, _])| lattice.between(start, &end).is_some()).map(|(next, _)| *next);
        }
        let period = |&(head, [start, end]): &(usize, [Vector2<f64>; 2])| {
            let (mut way, mut at) = (end - start, after[head]?);
            for _ in &open {
                if at == head {
                    let period = lattice.translation(lattice.rounded(&way));
                    return (period != Vector2::zeros()).then_some(period);
                }
                let [start, end] = ends(at)?;
                (way, at) = (way + (end - start), after[at]?);
            }
            None
        };
        let period = open.iter().find_map(period);
        Continued { after, period }
    }
}

/// Disjoint sets: which of several things belong together.
struct Groups(Vec<usize>);

impl Groups {
    fn new(count: usize) -> Groups {
        Groups((0..count).collect())
    }
    fn root(&self, mut k: usize) -> usize {
        while self.0[k] != k {
            k = self.0[k];
        }
        k
    }
    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
    fn all(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = vec![vec![]; self.0.len()];
        for k in 0..self.0.len() {
            groups[self.root(k)].push(k);
        }
        groups.retain(|g| !g.is_empty());
        groups
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Error, Lattice, Outline, Piece, Turn,
        shapes::{Circle, FullLine, Segment},
        tables,
    };
    use core::f64::consts::PI;

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }
    fn square(x: f64, y: f64, side: f64, hole: bool) -> Vec<Box<dyn Piece>> {
        let mut corners = [v(x, y), v(x + side, y), v(x + side, y + side), v(x, y + side)];
        if hole {
            corners.reverse();
        }
        let o = Outline::from(corners[3]);
        corners.into_iter().fold(o, |o, c| o.line_to(c).unwrap()).close().unwrap()
    }
    fn disk(x: f64, y: f64, r: f64) -> Box<dyn Piece> {
        Box::new(Circle::new(v(x, y), r, false).unwrap())
    }

    #[test]
    fn walls_with_two_sides_take_nothing_of_a_cell() {
        let cell = || Lattice::new(&[v(1.44, -0.24), v(-0.45, 1.44)]).unwrap();
        // whose triangles about a vertex sum to a rounding error of either sign, or to 0
        for shift in 0..20 {
            let at = f64::from(shift) / 7.0;
            let corners = [v(0.446 + at, -0.153), v(0.616 + at, 0.02), v(0.487 + at, 0.2), v(0.355 + at, 0.205)];
            let there = corners[1..].iter().fold(Outline::from(corners[0]), |o, c| o.line_to(*c).unwrap());
            let back = corners.iter().rev().skip(1).fold(there, |o, c| o.line_to(*c).unwrap());
            let pieces = back.close().unwrap();
            let table = Table::periodic(pieces, Some(cell())).unwrap();
            let area = table.area();
            assert!((area - cell().cell_area()).abs() < 1e-15, "{area}");
            assert_eq!(table.components().iter().map(|part| part.area).collect::<Vec<_>>(), [area]);
        }
        // in the open plane the region around a wall or an obstacle is infinite
        let (from, to) = (v(0.1, 0.2), v(0.7, 0.3));
        let wall = Outline::from(from).line_to(to).unwrap().line_to(from).unwrap().close().unwrap();
        for pieces in [wall, vec![disk(0.0, 0.0, 1.0)], square(0.0, 0.0, 1.0, true)] {
            assert_eq!(Table::new(pieces).unwrap().unbounded().components()[0].area, f64::INFINITY);
        }
    }

    #[test]
    fn rooms_within_rooms_are_told_apart() {
        let loops = [
            square(0.0, 0.0, 8.0, false),
            square(2.0, 2.0, 4.0, true),
            square(3.0, 3.0, 2.0, false),
            vec![disk(1.0, 1.0, 0.5), disk(7.0, 1.0, 0.5), disk(4.0, 4.0, 0.5)],
            square(10.0, 0.0, 1.0, false),
        ];
        let table = Table::new(loops.into_iter().flatten().collect()).unwrap();
        let found = table.components();
        let sizes: Vec<usize> = found.iter().map(|c| c.pieces.len()).collect();
        assert_eq!(sizes, [10, 5, 4]);
        let areas = [64.0 - 16.0 - 0.5 * PI, 4.0 - 0.25 * PI, 1.0];
        assert!(found.iter().zip(areas).all(|(c, a)| (c.area - a).abs() < 1e-13), "{found:?}");
    }

    #[test]
    fn areas_and_senses_do_not_depend_on_where_a_table_is() {
        for far in [0.0, 1e6, 1e8, 1e12] {
            let room = |hole: bool| Table::new(square(far + 0.25, 0.5 - far, 1.0, hole)).unwrap();
            assert_eq!((room(false).area(), room(false).describe().area()), (1.0, 1.0), "{far:e}");
            let inner = room(false).offset(0.25).unwrap().table.describe();
            assert_eq!((inner.area(), inner.largest_disk.radius), (0.25, 0.25), "{far:e}");
            assert!(room(false).validate().is_ok());
            assert!(matches!(room(true).validate(), Err(Error::Orientation { .. })), "{far:e}");
            assert!(room(true).unbounded().validate().is_ok());
            assert!(room(true).largest_disk().radius.is_infinite());
            let cap = |x: f64, y: f64| v(far + x, y - far);
            let o = Outline::from(cap(-1.0, -1.0)).line_to(cap(1.0, -1.0)).unwrap();
            let o = o.arc_to(cap(1.0, 1.0), cap(1.0, 0.0), Turn::CounterClockwise).unwrap();
            let o = o.line_to(cap(-1.0, 1.0)).unwrap().line_to(cap(-1.0, -1.0)).unwrap();
            let area = Table::new(o.close().unwrap()).unwrap().area();
            assert!((area - (4.0 + 0.5 * PI)).abs() < 1e-14, "{far:e}: {area}");
        }
    }

    #[test]
    fn the_open_plane_is_one_part() {
        let table = Table::new(vec![disk(0.0, 0.0, 1.0), disk(3.0, 0.0, 1.0), disk(1.0, 9.0, 1.0)]).unwrap();
        let found = table.components();
        assert_eq!((found.len(), found[0].area), (1, f64::INFINITY));
    }

    #[test]
    fn around_a_slit_the_table_is_one_part() {
        let slit = |x: f64| {
            let o = Outline::from(v(x, 1.0)).line_to(v(x + 1.0, 2.0)).unwrap();
            o.line_to(v(x, 1.0)).unwrap().close().unwrap()
        };
        let alone = Table::new(slit(0.0)).unwrap().describe();
        assert_eq!((alone.components.len(), alone.area()), (1, f64::INFINITY));
        assert!(alone.largest_disk.radius.is_infinite());
        let loops = [square(0.0, 0.0, 9.0, false), slit(1.0), slit(2.0), slit(7.0)];
        let room = Table::new(loops.into_iter().flatten().collect()).unwrap();
        assert_eq!(room.validate(), Ok(()));
        let found = room.components();
        assert_eq!((found.len(), found[0].pieces.len(), found[0].area), (1, 10, 81.0));
        // outside the room there is no table
        let loops = [square(0.0, 0.0, 9.0, false), slit(10.0)];
        let beside = Table::new(loops.into_iter().flatten().collect()).unwrap().validate();
        assert!(matches!(beside, Err(Error::Orientation { piece: 4..=5 })), "{beside:?}");
    }

    #[test]
    fn two_strips_are_two_parts() {
        let line = |y: f64, x: f64| Box::new(FullLine::new(v(0.0, y), v(x, 0.0)).unwrap()) as Box<dyn Piece>;
        let lines = vec![line(0.0, 1.0), line(1.0, -1.0), line(2.0, 1.0), line(3.0, -1.0), disk(5.0, 2.5, 0.25)];
        let table = Table::new(lines).unwrap();
        let found: Vec<Vec<usize>> = table.components().into_iter().map(|c| c.pieces).collect();
        assert_eq!(found, [vec![0, 1], vec![2, 3, 4]]);
    }

    #[test]
    fn small_scatterers_on_a_lattice_leave_one_part_wherever_they_lie() {
        let triangle = |x: f64, y: f64| {
            let o = Outline::from(v(x, y)).line_to(v(x, y + 0.06)).unwrap();
            o.line_to(v(x + 0.05, y)).unwrap().line_to(v(x, y)).unwrap().close().unwrap()
        };
        for [a, b] in [[v(1.0, 0.0), v(0.0, 1.0)], [v(1.3, 0.2), v(-0.1, 0.9)]] {
            let lattice = Lattice::new(&[a, b]).unwrap();
            let at = |s: f64, t: f64| a * s + b * t;
            // two columns, of which each sees itself only
            let places = [(0.43, 0.56), (0.42, 0.1), (0.9, 0.9), (0.93, 0.3)].map(|(s, t)| at(s, t));
            let mut pieces: Vec<Box<dyn Piece>> = places.map(|c| disk(c.x, c.y, 0.05)).into();
            pieces.extend(triangle(at(0.6, 0.4).x, at(0.6, 0.4).y));
            let found = Table::periodic(pieces, Some(lattice.clone())).unwrap().components();
            assert_eq!(found.len(), 1, "{found:?}");
            let area = lattice.cell_area() - 4.0 * PI * 0.05 * 0.05 - 0.5 * 0.05 * 0.06;
            assert!((found[0].area - area).abs() < 1e-14, "{found:?}");
        }
    }

    #[test]
    fn scatterers_on_a_lattice_that_see_only_themselves_leave_one_part() {
        let corners = [(0.5957, 0.447), (0.5516, 0.474), (0.5776, 0.513), (0.6159, 0.4951), (0.5975, 0.4477)];
        let pentagon =
            corners.into_iter().fold(Outline::from(v(0.5975, 0.4477)), |o, (x, y)| o.line_to(v(x, y)).unwrap());
        let pieces = [disk(0.43, 0.56, 0.047)].into_iter().chain(pentagon.close().unwrap()).collect();
        let lattice = Lattice::new(&[v(1.0, 0.0), v(0.0, 1.0)]).unwrap();
        let found = Table::periodic(pieces, Some(lattice)).unwrap().components();
        assert_eq!(found.len(), 1, "{found:?}");
    }

    #[test]
    fn a_wall_that_goes_on_for_ever_parts_a_lattice_in_whatever_direction_it_runs() {
        // nearly upwards, as lines of sight go elsewhere
        for forward in [v(1.0, 0.0), v(0.0, 1.0), v(0.03, 1.0), v(0.032_475_5, 0.999_472_5)] {
            let across = v(-forward.y, forward.x) / forward.norm_squared();
            let lattice = Lattice::new(&[forward, across]).unwrap();
            let line = |from: f64, to: f64, s: f64| {
                let ends = [from, to].map(|part| forward * part + across * s);
                Box::new(Segment::new(ends[0], ends[1]).unwrap()) as Box<dyn Piece>
            };
            // that along which it is looked away from it runs along the walls
            let slit = |part: f64, s: f64| {
                let [from, to] = [s, s + 0.02].map(|s| forward * part + across * s);
                Outline::from(from).line_to(to).unwrap().line_to(from).unwrap().close().unwrap()
            };
            // two bands of table, of heights 0.4 and 0.15, each with two slits across it; the upper one is drawn across the cell's edge
            let walls = [line(0.0, 1.0, 0.1), line(1.0, 0.0, 0.5), line(0.0, 1.0, 0.9), line(1.0, 0.0, 0.05)];
            let slits = [slit(0.2, 0.3), slit(0.7, 0.2), slit(0.3, 0.95), slit(0.9, 1.0)];
            let pieces: Vec<Box<dyn Piece>> = walls.into_iter().chain(slits.into_iter().flatten()).collect();
            let found = Table::periodic(pieces, Some(lattice)).unwrap().components();
            let parts: Vec<&[usize]> = found.iter().map(|part| &part.pieces[..]).collect();
            assert_eq!(parts, [&[0, 1, 4, 5, 6, 7][..], &[2, 3, 8, 9, 10, 11]], "{forward}");
            let areas = [0.4, 0.15];
            assert!(found.iter().zip(areas).all(|(part, area)| (part.area - area).abs() < 1e-14), "{found:?}");
        }
    }

    #[test]
    fn a_lattice_has_its_parts_once() {
        let lorentz = tables::sinai_torus(0.25, 1.0).unwrap();
        let whole = lorentz.components();
        assert_eq!(whole.len(), 1);
        assert!((whole[0].area - (1.0 - PI / 16.0)).abs() < 1e-15);
        let channel = tables::channel(1.0, 1.0, 0.0).unwrap().components();
        assert_eq!(channel, [Component { pieces: vec![0, 1], area: 1.0, perimeter: 2.0 }]);
    }
}
