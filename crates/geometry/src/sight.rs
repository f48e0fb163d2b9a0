//! What can be seen from a boundary along straight lines: enough to tell its sides and its connected parts apart.
use crate::{
    Extent, Figure, Lattice, MeetingKind, Piece, Table,
    copies::{Copies, finite_extent},
    enclosed_area, meetings,
    piece::rounding,
    plane::{GOLDEN_SECTION, PLASTIC_RATIOS, SAME_DIRECTION, is_finite, slack},
    shapes::Ray,
};
use nalgebra::Vector2;

/// Lines that meet a wall at less than this angle (radians) may be on either side of it: a touch is known only to the square root of
/// rounding, 10⁻⁸.
const GRAZING: f64 = 1e-6;

/// Number of tries to find a line of sight that grazes nothing and meets no vertex.
const TRIES: usize = 16;

/// `√5 − 2`: by so much of its length, the places tried on a piece wander from the first to the last.
const WANDER: f64 = 0.236_067_977_499_79;

/// Each further try along a normal leans by about this much more (radians).
const LEAN: f64 = 0.0625;

/// This far along a wall (times the size of the table) its two faces still coincide, whereas walls that touch at a point are
/// separated by the square of it times the difference of their curvatures, which is more than rounding.
const BESIDE: f64 = 1e-5;

/// A closed chain narrower than this many times the rounding of points is a point for lines of sight. Where a line crosses a curve is found
/// between points so near one another that the curve is straight there, and on a curve some ten thousand roundings wide such points would
/// be one.
const POINT: f64 = 131_072.0; // 2¹⁷

/// A table's chains of pieces, prepared for lines of sight.
pub(crate) struct Sight<'a> {
    table: &'a Table,
    copies: Copies,
    /// The middle of all pieces of finite length.
    middle: Vector2<f64>,
    /// On a lattice, the box outside of which not all translates are known: lines of sight end where they leave it.
    known: Option<Extent>,
    /// Greatest finite coordinate; 1 where there is none (lines through the origin).
    pub(crate) size: f64,
    /// The error that points of pieces may have.
    pub(crate) rounding: f64,
    pub(crate) chains: Vec<Vec<usize>>,
    /// For each piece, its chain.
    pub(crate) chain_of: Vec<usize>,
    /// The boxes around the chains.
    pub(crate) extents: Vec<Extent>,
    /// For each chain that is a point for lines of sight, 1 if the table lies around it, and −1 if not.
    points: Vec<Option<f64>>,
}

/// Where a line of sight leads.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Aim {
    Inward,
    Outward,
    Along(Vector2<f64>),
    /// At a chain.
    At(usize),
}

/// A wall on a line of sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    pub(crate) number: usize,
    /// Where the line meets it.
    pub(crate) point: Vector2<f64>,
    /// Whether the line goes on into the table.
    pub(crate) into_table: bool,
}

/// A meeting of a line of sight with a piece, at a distance from the start of the line.
struct Ahead {
    far: f64,
    /// The index of its copy.
    index: usize,
    /// The sine of the angle between line and wall, by which rounding of the wall is divided in that of the distance; 1 where none is known.
    sine: f64,
    /// The wall met; `None` where the line grazes or meets a vertex.
    wall: Option<Wall>,
}

/// What is met by a line of sight.
struct Prospect {
    /// The piece that is the other face of the wall on which the line starts, if that wall has two.
    other_face: Option<usize>,
    /// All that lies ahead, in order.
    ahead: Vec<Ahead>,
}

impl<'a> Sight<'a> {
    /// `cells`: how many more translates to take into account on each side, on a lattice. Those around all starting points and
    /// targets of lines are always known.
    pub(crate) fn new(table: &'a Table, cells: f64) -> Sight<'a> {
        let pieces = table.pieces();
        let coordinates = pieces.iter().map(|p| match p.figure() {
            Figure::Line { through, .. } => through.amax(),
            _ => p.extent().size(),
        });
        let size = coordinates.fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let rounding = pieces.iter().map(|p| rounding(&**p)).fold(slack([size]), f64::max);
        let reach = table.shortest().map_or(0.0, |l| l.vectors().iter().map(Vector2::amax).sum::<f64>() * cells);
        let reach = rounding + reach;
        let finite = finite_extent(pieces);
        let middle = if finite.is_finite() { 0.5 * finite.min + 0.5 * finite.max } else { Vector2::zeros() };
        let lines = pieces.iter().filter(|p| !p.length().is_finite());
        let around = match table.shortest() {
            Some(lattice) => {
                Extent::of(lines.flat_map(|p| [0.0, 1.0].map(|part| in_cell(&**p, lattice, middle, part))))
            }
            None => Extent::EMPTY,
        };
        let around = finite.union(around);
        let copies = Copies::new(pieces, table.shortest(), &around, reach);
        let known =
            table.shortest().map(|_| Extent { min: around.min.add_scalar(-reach), max: around.max.add_scalar(reach) });
        let chains = table.chains();
        let mut chain_of = vec![0; pieces.len()];
        for (k, chain) in chains.iter().enumerate() {
            for &i in chain {
                chain_of[i] = k;
            }
        }
        let around = |chain: &Vec<usize>| chain.iter().map(|&i| pieces[i].extent()).fold(Extent::EMPTY, Extent::union);
        let extents = chains.iter().map(around).collect();
        let points = vec![None; chains.len()];
        let mut sight = Sight { table, copies, middle, known, size, rounding, chains, chain_of, extents, points };
        sight.points = (0..sight.chains.len()).map(|k| sight.as_point(k)).collect();
        sight
    }

    /// If a chain is a point for lines of sight, 1 or −1: whether the table lies around it. A wall with two sides is none.
    fn as_point(&self, chain: usize) -> Option<f64> {
        let is_point = self.width(chain) < POINT * self.rounding && self.table.is_closed(&self.chains[chain]);
        is_point.then(|| self.area(chain)).filter(|area| *area != 0.0).map(|area| -area.signum())
    }

    /// The area on the left of a loop; that of a two-sided wall, zero within rounding, is 0.
    pub(crate) fn area(&self, chain: usize) -> f64 {
        let Extent { min, max } = self.extents[chain];
        let area = enclosed_area(self.chains[chain].iter().map(|&i| &*self.table.pieces()[i]));
        if area.abs() > slack([(max - min).product()]) { area } else { 0.0 }
    }

    pub(crate) fn copies(&self) -> &Copies {
        &self.copies
    }

    /// The chains that reach to infinity.
    pub(crate) fn infinite(&self) -> Vec<usize> {
        (0..self.chains.len()).filter(|&k| !self.extents[k].is_finite()).collect()
    }

    /// The walls on a line of sight from a chain, starting with that chain itself, up to the first that satisfies `until`; and
    /// whether the line escapes beyond the last of them, or leaves the region where all translates are known. `None` where no line
    /// is clear.
    ///
    /// Chains that are points are not seen by others: a line enters a closed curve as often as it leaves it. From such a chain itself one
    /// looks around, into every direction.
    pub(crate) fn look(&self, chain: usize, aim: Aim, until: impl Fn(&Wall) -> bool) -> Option<(Vec<Wall>, bool)> {
        (0..TRIES).find_map(|k| self.look_along(chain, aim, k, &until))
    }

    /// The same along the `k`-th line tried; `None` where that is not clear.
    fn look_along(
        &self,
        chain: usize,
        aim: Aim,
        k: usize,
        until: &impl Fn(&Wall) -> bool,
    ) -> Option<(Vec<Wall>, bool)> {
        let (index, from) = self.place(chain, k, GOLDEN_SECTION);
        let (copy, _) = self.copies.get(index);
        let normal = copy.piece.closest(&from).normal;
        // the normals of a circle all meet in one point, where walls may touch
        let leaning = normal + Vector2::new(-normal.y, normal.x) * (LEAN * k as f64);
        let direction = match aim {
            Aim::Inward => leaning,
            Aim::Outward => -leaning,
            Aim::Along(direction) => direction,
            // not the fraction complementary to that of the start: lines between circles that touch would pass through the point
            // of contact
            Aim::At(other) => self.place(other, k, PLASTIC_RATIOS[0]).1 - from,
        };
        let direction = direction / libm::hypot(direction.x, direction.y);
        let facing =
            self.points[chain].unwrap_or_else(|| self.normal_beside(&*copy.piece, &from, direction).dot(&direction));
        if facing.is_nan() || facing.abs() <= GRAZING {
            return None;
        }
        let rounding = 4.0 * self.rounding.max(slack(from.iter().copied()));
        // farther away there is nothing, or nothing known
        let everything = self.known.map_or(16.0 * (self.size + from.amax()), |known| (known.max - known.min).sum());
        let mut limit = 4.0 * self.width(chain);
        loop {
            if limit.is_nan() || limit >= everything {
                limit = f64::INFINITY;
            }
            let Prospect { other_face, ahead } = self.ahead(index, from, direction, limit)?;
            // of the two faces of one wall, the line starts on the one that it leaves
            let number = other_face.filter(|_| facing < 0.0).unwrap_or(copy.number);
            let has_two = other_face.is_some() || copy.piece.tips().is_some();
            let mut walls = vec![Wall { number, point: from, into_table: facing > 0.0 || has_two }];
            for met in ahead.chunk_by(|a, b| b.far - a.far <= rounding / a.sine.min(b.sine)) {
                if met.iter().any(|wall| wall.far + rounding > limit) {
                    break;
                }
                let found = self.met_at_once(met, from + direction * met[0].far, rounding)?;
                if met[0].far <= rounding {
                    return None;
                }
                for wall in found.into_iter().flatten() {
                    walls.push(wall);
                    if until(&wall) {
                        return Some((walls, false));
                    }
                }
            }
            if limit == f64::INFINITY {
                return Some((walls, true));
            }
            limit *= 8.0;
        }
    }

    /// The walls of what a line of sight meets at one point; `None` for a corner, or one wall that is seen twice.
    fn met_at_once(&self, met: &[Ahead], point: Vector2<f64>, rounding: f64) -> Option<[Option<Wall>; 2]> {
        match *met {
            [Ahead { wall: Some(wall), .. }] => Some([Some(wall), None]),
            // two faces of one wall: the line arrives at the one and goes on from the other
            [Ahead { index: i, wall: Some(a), .. }, Ahead { index: j, wall: Some(b), .. }]
                if a.into_table != b.into_table && self.coincide([i, j], point, rounding) =>
            {
                Some(if a.into_table { [Some(b), Some(a)] } else { [Some(a), Some(b)] })
            }
            _ => None,
        }
    }

    /// Whether the table lies behind a wall on a line of sight: so it does if the wall has two sides.
    pub(crate) fn is_table_behind(&self, wall: &Wall) -> bool {
        wall.into_table || self.table.pieces()[wall.number].tips().is_some()
    }

    /// The sum of the sides of the box around a chain.
    pub(crate) fn width(&self, chain: usize) -> f64 {
        (self.extents[chain].max - self.extents[chain].min).sum()
    }

    /// Whether two copies, with these indices, run along each other at a point of both.
    fn coincide(&self, copies: [usize; 2], point: Vector2<f64>, rounding: f64) -> bool {
        let [a, b] = copies.map(|index| &self.copies.get(index).0.piece);
        let normal = a.closest(&point).normal;
        let along = Vector2::new(normal.y, -normal.x) * (BESIDE * self.size);
        [point - along, point + along].iter().any(|beside| {
            let here = a.closest(beside).point;
            (here - point).norm() >= 0.5 * along.norm() && (b.closest(&here).point - here).norm() <= rounding
        })
    }

    /// The normal of a wall at a point of it, as seen from a little way in some direction: on a curve with very steep flanks a point at
    /// hand tells its side better than one within rounding. A wall without thickness has the table on both sides.
    fn normal_beside(&self, piece: &dyn Piece, at: &Vector2<f64>, toward: Vector2<f64>) -> Vector2<f64> {
        let way = if piece.tips().is_some() { 0.0 } else { 8.0 * self.rounding };
        piece.closest(&(at + toward * way)).normal
    }

    /// All that the line meets from a point of the copy with the given index; beyond the limit perhaps not everything.
    fn ahead(&self, own: usize, from: Vector2<f64>, direction: Vector2<f64>, limit: f64) -> Option<Prospect> {
        let ray = Ray::new(from, direction, true).ok()?;
        let rounding = self.rounding.max(slack(from.iter().copied()));
        let normal = self.copies.get(own).0.piece.closest(&from).normal;
        let (mut other_face, mut ahead) = (None, vec![]);
        let own_chain = self.chain_of[self.copies.get(own).0.number];
        let start = Extent { min: from, max: from };
        let mut is_clear = true;
        self.copies.search(
            |e| is_hit(e, &from, &direction, rounding, limit),
            |index| {
                let (copy, extent) = self.copies.get(index);
                let chain = self.chain_of[copy.number];
                if self.points[chain].is_some() {
                    // a start beside another one may be inside it
                    let is_own = chain == own_chain && copy.cell == [0.0; 2];
                    is_clear &= is_own || !extent.meets(&start, self.width(chain));
                    return;
                }
                for m in meetings(&ray, &*copy.piece) {
                    let here = Extent { min: m.point, max: m.point };
                    if self.known.is_some_and(|known| !known.meets(&here, 0.0)) {
                        continue;
                    }
                    let far = m.at[0];
                    if far <= 4.0 * rounding && index == own {
                        continue;
                    }
                    if far <= 4.0 * rounding && (copy.piece.closest(&from).normal + normal).norm() <= SAME_DIRECTION {
                        other_face = Some(copy.number);
                        continue;
                    }
                    let facing = self.normal_beside(&*copy.piece, &m.point, -direction).dot(&direction);
                    let clear = m.kind == MeetingKind::Crossing && facing.abs() > GRAZING;
                    // whichever of its normals a wall without thickness tells, the line arrives from the table
                    let into_table = facing > 0.0 && copy.piece.tips().is_none();
                    let wall = clear.then_some(Wall { number: copy.number, point: m.point, into_table });
                    ahead.push(Ahead { far, index, sine: if clear { facing.abs() } else { 1.0 }, wall });
                }
            },
        );
        ahead.sort_by(|a, b| a.far.total_cmp(&b.far));
        is_clear.then_some(Prospect { other_face, ahead })
    }

    /// The `k`-th of some places spread over a chain: index of the copy, and the point. With irrational fractions of the length one
    /// is soon found from which the line meets no corner.
    fn place(&self, chain: usize, k: usize, part: f64) -> (usize, Vector2<f64>) {
        let chain = &self.chains[chain];
        let i = chain[k * chain.len() / TRIES];
        let piece = &self.table.pieces()[i];
        let part = part + WANDER * (k as f64 / TRIES as f64);
        let length = piece.length();
        if let Some(lattice) = self.table.shortest().filter(|_| !length.is_finite()) {
            return (self.copies.home(i), in_cell(&**piece, lattice, self.middle, part));
        }
        let from_end = piece.ends().is_some_and(|[a, _]| is_finite(&a));
        let s = match (length.is_finite(), from_end) {
            (true, _) => length * part,
            (false, true) => self.size * part,
            (false, false) => -self.size * part,
        };
        (self.copies.home(i), piece.point_at(s))
    }
}

/// A point of an infinite line along a lattice vector, taken in the cell that begins near a given point.
fn in_cell(line: &dyn Piece, lattice: &Lattice, near: Vector2<f64>, part: f64) -> Vector2<f64> {
    line.closest(&(near + lattice.vectors()[0] * part)).point
}

/// Whether a line of some length meets a box, or comes within `reach` of it.
pub(crate) fn is_hit(extent: &Extent, from: &Vector2<f64>, direction: &Vector2<f64>, reach: f64, length: f64) -> bool {
    let (mut enter, mut leave) = (0.0_f64, length);
    for i in 0..2 {
        let (low, high) = (extent.min[i] - reach - from[i], extent.max[i] + reach - from[i]);
        if direction[i] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return false;
            }
        } else {
            let (a, b) = (low / direction[i], high / direction[i]);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
    }
    enter <= leave
}
