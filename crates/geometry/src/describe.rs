//! What a table is like: its parts, sizes and corners.
use crate::{
    LargestDisk, Table,
    joints::joints,
    sight::{Aim, Sight, Wall},
    table::{Parted, SMOOTH},
};
use nalgebra::Vector2;

/// The measures of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Number of pieces.
    pub pieces: usize,
    /// Length of the boundary \[L\], per unit cell on a lattice.
    pub perimeter: f64,
    /// Joints of two pieces at which the boundary turns, once each, and places where walls touch, once for each part of the table.
    /// ([`Table::corners`] are vertices at which the normal jumps, two for a joint across cells of a lattice.)
    pub corners: usize,
    /// Those of them where the table's angle is greater than π.
    pub re_entrant_corners: usize,
    /// The connected parts of the table.
    pub components: Vec<Component>,
    /// The largest disk that fits in.
    pub largest_disk: LargestDisk,
}

impl Description {
    /// Area of the table \[L²\], per unit cell on a lattice; infinite where it is unbounded.
    pub fn area(&self) -> f64 {
        self.components.iter().map(|c| c.area).sum()
    }
}

/// A connected part of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// The numbers of the pieces that bound it, in rising order.
    pub pieces: Vec<usize>,
    /// Its area \[L²\], per unit cell on a lattice; infinite where it is unbounded.
    pub area: f64,
}

impl Table {
    /// Describes the table, which should satisfy [`Table::validate`].
    ///
    /// ```
    /// use geometry::tables;
    /// let mushroom = tables::mushroom(1.0, 0.5, 0.75)?.describe();
    /// assert_eq!((mushroom.corners, mushroom.re_entrant_corners), (6, 2));
    /// assert!((mushroom.area() - (core::f64::consts::FRAC_PI_2 + 0.375)).abs() < 1e-14);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn describe(&self) -> Description {
        let parted = self.parted();
        let turns = match &parted {
            Some(parted) => parted.turns.clone(),
            None => joints(self).iter().map(|joint| joint.turn(self)).collect(),
        };
        Description {
            pieces: self.pieces().len(),
            perimeter: self.perimeter(),
            corners: turns.iter().filter(|t| t.abs() > SMOOTH).count(),
            re_entrant_corners: turns.iter().filter(|&&t| t < -SMOOTH).count(),
            components: components_of(self, parted),
            largest_disk: self.largest_disk(),
        }
    }

    /// The connected parts of the table, in the order of their lowest piece numbers: what a point can reach. Walls part it where they touch
    /// at points, too, and a piece may bound several of them; where ellipses or curves by formulas touch, that is not seen.
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

/// The connected parts of a table, which may be parted.
fn components_of(table: &Table, parted: Option<Parted>) -> Vec<Component> {
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
    // in one direction, every chain sees the next one of its part of the table, and the last of them its outer wall: upwards but for
    // two degrees, as a drawn side or a line through two drawn vertices hardly ever is
    let up = Vector2::new(0.032_475_5, 0.999_472_5);
    let mut outside: Option<usize> = None;
    for k in 0..chains.len() {
        let others = distant.iter().filter(|&&other| other != k).map(|&other| Aim::At(other));
        for aim in [Aim::Along(up), Aim::Inward].into_iter().chain(others) {
            let until = |wall: &Wall| {
                let there = sight.chain_of[wall.number];
                if let Aim::At(other) = aim { there == other } else { there != k }
            };
            let Some((walls, escapes)) = sight.look(k, aim, until) else { continue };
            for pair in walls.windows(2).filter(|pair| pair[0].into_table) {
                groups.unite(sight.chain_of[pair[0].number], sight.chain_of[pair[1].number]);
            }
            // without infinite walls there is one outside
            if escapes
                && distant.is_empty()
                && table.shortest().is_none()
                && let Some(last) = walls.last().filter(|wall| wall.into_table)
            {
                let last = sight.chain_of[last.number];
                groups.unite(*outside.get_or_insert(last), last);
            }
        }
    }
    let infinite = |chain: &Vec<usize>| chain.iter().any(|&i| !table.pieces()[i].length().is_finite());
    let mut components: Vec<Component> = vec![];
    for group in groups.all() {
        let members: Vec<&Vec<usize>> = group.iter().map(|&k| &chains[k]).collect();
        let mut pieces: Vec<usize> = members.iter().flat_map(|c| c.iter().copied()).collect();
        pieces.sort_unstable();
        let area = if members.iter().any(|c| infinite(c)) {
            f64::INFINITY
        } else {
            let enclosed = table.enclosed_by(members.iter().copied());
            match table.shortest() {
                _ if enclosed > 0.0 => enclosed,
                Some(lattice) => lattice.cell_area() + enclosed,
                None => f64::INFINITY,
            }
        };
        components.push(Component { pieces, area });
    }
    components
}

/// Which of several things belong together.
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
        Error, Outline, Piece, Turn,
        shapes::{Circle, FullLine},
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
        // outside of the room there is no table
        let loops = [square(0.0, 0.0, 9.0, false), slit(10.0)];
        let beside = Table::new(loops.into_iter().flatten().collect()).unwrap().validate();
        assert!(matches!(beside, Err(crate::Error::Orientation { piece: 4..=5 })), "{beside:?}");
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
    fn a_lattice_has_its_parts_once() {
        let lorentz = tables::sinai_torus(0.25, 1.0).unwrap();
        let whole = lorentz.components();
        assert_eq!(whole.len(), 1);
        assert!((whole[0].area - (1.0 - PI / 16.0)).abs() < 1e-15);
        let channel = tables::channel(1.0, 1.0, 0.0).unwrap().components();
        assert_eq!(channel, [Component { pieces: vec![0, 1], area: 1.0 }]);
    }

    #[test]
    fn descriptions_count_corners() {
        let stadium = tables::stadium(1.0, 1.0).unwrap().describe();
        assert_eq!((stadium.pieces, stadium.corners, stadium.components.len()), (4, 0, 1));
        assert!((stadium.largest_disk.radius - 1.0).abs() < 1e-15);
        let moon = tables::moon(1.0, 0.75, 1.0).unwrap().describe();
        assert_eq!((moon.corners, moon.re_entrant_corners), (2, 0));
        let wedge = tables::wedge(1.0).unwrap().describe();
        assert_eq!((wedge.corners, wedge.area()), (1, f64::INFINITY));
        assert!(wedge.largest_disk.radius.is_infinite());
    }
}
