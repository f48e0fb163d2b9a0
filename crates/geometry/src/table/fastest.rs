//! The fastest walls for a table.
use super::{
    FundamentalCell, Table, Translate,
    container::{Container, Enclosed, MOST_SIDES, container, strip},
    ends::unite,
    sides::{Side, sides},
    translates,
};
use crate::{
    Figure, Piece,
    afar::NEWTON,
    copies::finite_extent,
    nearest::nearest_of,
    plane::slack,
    shapes::{Segment, Shape},
    walls::{
        Around, Corners, Enclosure, Hull, Junctions, List, Obstacles, Periodic, Pieces, Polygon, Scatterer, Seam,
        WithWalls,
    },
};
use nalgebra::Vector2;
use std::sync::Arc;

/// Places along a piece, in parts of its length, of which one at least is off a curve that the piece touches.
const PLACES: [f64; 4] = [0.13, 0.37, 0.62, 0.91];

impl Table {
    /// Runs a computation with the best walls for this table.
    pub fn with_walls<V: WithWalls<2>>(&self, visit: V) -> V::Output {
        if let Some(cell) = self.cell() {
            let boxes = || self.pieces.iter().map(Piece::extent);
            return match self.lone_disk(cell) {
                Some(disk) => visit.run(&Periodic::in_cell(disk, cell).within(cell.lattice(), boxes())),
                None => visit.run(&Periodic::in_cell(self.translates(cell), cell).within(cell.lattice(), boxes())),
            };
        }
        // even obstacles with straight sides in a rectangle are tested faster together with the rectangle
        if self.polygon.get().is_some() || (self.pieces.len() > MOST_SIDES && self.is_straight()) {
            return self.with_general_walls(visit);
        }
        let Some(known) = self.enclosed.get_or_init(|| self.enclosed().map(Arc::new)) else {
            return self.with_general_walls(visit);
        };
        let Enclosed { container, seams, rest } = &**known;
        let hull = match container {
            Container::Level(walls) => return visit.run_homogeneous(walls),
            Container::Upright(walls) => return visit.run_homogeneous(walls),
            Container::Strip(walls) => return visit.run_homogeneous(walls),
            Container::Hexagon(walls) => return visit.run(walls),
            Container::Wedge(walls) => return visit.run(walls),
            Container::Capsule(walls) => return visit.run(walls),
            Container::Hull(hull) => hull,
        };
        let obstacles = match (self.scatterer(rest), rest.as_slice()) {
            (Some(disk), _) => Obstacles::Disk(disk),
            (None, []) => Obstacles::None,
            (None, many) => Obstacles::Pieces(self.parts(many)),
        };
        match (hull, seams.as_slice(), obstacles) {
            (Hull::Rectangle(walls), [], Obstacles::None) => visit.run(walls),
            (Hull::Convex(walls), [], Obstacles::None) => visit.run(walls),
            (Hull::Capsule(walls), [], Obstacles::None) => visit.run(walls),
            (Hull::Disk(walls), [], Obstacles::None) => visit.run_homogeneous(walls),
            (Hull::Rectangle(container), [], Obstacles::Disk(obstacles)) => visit.run(&Around { container, obstacles }),
            (Hull::Disk(container), [], Obstacles::Disk(obstacles)) => visit.run(&Around { container, obstacles }),
            (hull, seams, obstacles) => visit.run(&Enclosure { hull, seams, obstacles }),
        }
    }

    /// Runs a computation with walls for boundaries of any form.
    fn with_general_walls<V: WithWalls<2>>(&self, visit: V) -> V::Output {
        match self.polygon.get_or_init(|| self.polygon().map(Arc::new)) {
            Some(walls) => visit.run(&**walls),
            None => visit.run(self.parts(&(0..self.pieces.len()).collect::<Vec<_>>())),
        }
    }

    /// Whether all pieces are segments.
    fn is_straight(&self) -> bool {
        self.pieces.iter().all(|piece| straight(&**piece).is_some())
    }

    /// All pieces as the sides of a polygon, if they are straight and none is one side of a two-sided wall.
    fn polygon(&self) -> Option<Polygon> {
        let number = |(i, side): (usize, Option<Segment>)| Some((i, side.filter(|side| !side.is_two_sided())?));
        let sides: Option<Vec<_>> =
            self.pieces.iter().map(|piece| straight(&**piece)).enumerate().map(number).collect();
        let junctions = Junctions::of(&self.numbered(0..self.pieces.len()));
        Some(Polygon::new(&sides?, &self.corners).with_junctions(junctions))
    }

    /// The obstacles as one scatterer, if they are one disk.
    fn scatterer(&self, obstacles: &[usize]) -> Option<Scatterer<2>> {
        let &[piece] = obstacles else { return None };
        match self.pieces[piece].figure() {
            Figure::Circle { center, radius, inside: false }
                if radius > NEWTON * finite_extent(&self.pieces).size() =>
            {
                Scatterer::new(center, radius, piece).ok()
            }
            _ => None,
        }
    }

    /// The whole content of a cell, if that is one whole disk that touches none of its translates.
    fn lone_disk(&self, cell: &FundamentalCell) -> Option<Scatterer<2>> {
        match self.figures()[..] {
            [Figure::Circle { center, radius, inside: false }] => {
                let (home, _) = cell.home(&center);
                let vectors = || cell.lattice().vectors().iter();
                let size = vectors().map(Vector2::amax).fold(0.0, f64::max);
                let apart = |vector: &Vector2<f64>| libm::hypot(vector.x, vector.y) - 2.0 * radius > slack([size]);
                (radius > NEWTON * size && cell.contains_disk(home, radius) && vectors().all(apart))
                    .then(|| Scatterer::new(home, radius, 0).ok())?
            }
            _ => None,
        }
    }

    /// Any table as a list of pieces, tested one by one: the reference for all other walls.
    pub fn list(&self, numbers: impl IntoIterator<Item = usize>) -> List {
        List::new(self.numbered(numbers), &self.corners)
    }

    /// The pieces that no composite wall covers, as walls, each tested in the best way.
    fn parts(&self, numbers: &[usize]) -> &Pieces {
        self.parts.get_or_init(|| Arc::new(Pieces::new(self.numbered(numbers.iter().copied()), &self.corners)))
    }

    fn numbered(&self, numbers: impl IntoIterator<Item = usize>) -> Vec<(usize, Arc<dyn Piece>)> {
        numbers.into_iter().map(|i| (i, self.pieces[i].clone())).collect()
    }

    fn figures(&self) -> Vec<Figure> {
        self.pieces.iter().map(|p| p.figure()).collect()
    }

    /// A chain of pieces that one composite wall can answer for, and all other pieces.
    fn enclosed(&self) -> Option<Enclosed> {
        if self.unbounded {
            return None; // around all chains
        }
        if Junctions::of(&self.numbered(0..self.pieces.len())).is_some_and(|junctions| junctions.on_others()) {
            return None; // where a vertex or a wall with two sides stands on the container, orbits end
        }
        let corners = Corners::new(&self.corners);
        let is_corner = |vertex: &Vector2<f64>| corners.contains(vertex);
        let mut lines = vec![];
        for chain in self.chains() {
            if chain.len() > MOST_SIDES {
                continue;
            }
            if chain.iter().any(|&i| self.pieces[i].shape().is_some_and(|shape| shape.is_two_sided())) {
                continue; // what starts on it may be on either side
            }
            if chain.len() > 2 && chain.windows(2).any(|w| w[1] != w[0] + 1) {
                continue; // where tables touch, a chain may lead from one into another
            }
            if let [one] = chain[..]
                && matches!(self.pieces[one].figure(), Figure::Line { .. })
            {
                lines.push(one);
                continue;
            }
            let side =
                |&i: &usize| Side { figure: self.pieces[i].figure(), straight: straight(&*self.pieces[i]), piece: i };
            let pieces: Vec<Side> = chain.iter().map(side).collect();
            let Some((sides, seams)) = sides(&pieces, is_corner) else { continue };
            let alone = seams.is_empty() && chain.len() == self.pieces.len();
            if let Some(container) = container(&sides, alone) {
                return self.around(container, seams, &chain).filter(|_| !has_flat_vertex(&sides, is_corner));
            }
        }
        let [one, other] = lines[..] else { return None };
        if self.pieces.len() > 2 {
            return None; // a strip stands alone
        }
        let strip = strip([one, other].map(|i| self.pieces[i].figure()), [one, other])?;
        self.around(strip, vec![], &[one, other])
    }

    /// A composite wall of some pieces with all others, if these lie inside it: a table may have several rooms.
    fn around(&self, container: Container, seams: Vec<Seam>, chain: &[usize]) -> Option<Enclosed> {
        let rest: Vec<usize> = (0..self.pieces.len()).filter(|i| !chain.contains(i)).collect();
        rest.iter().all(|&i| self.inside(chain, i)).then_some(Enclosed { container, seams, rest })
    }

    /// Whether a piece lies on the table's side of a chain that it does not cross; never one of infinite length, since the chain is closed.
    fn inside(&self, chain: &[usize], piece: usize) -> bool {
        let piece = &self.pieces[piece];
        let length = piece.length();
        if !length.is_finite() {
            return false;
        }
        // the place that is farthest from the chain tells, for it may touch the chain elsewhere
        let seen = |part: f64| {
            let point = piece.point_at(part * length);
            let nearest = nearest_of(chain.iter().map(|&i| (i, &*self.pieces[i])), &point)?;
            Some(((nearest.landing.point - point).norm(), nearest.is_outside))
        };
        let farthest = PLACES.into_iter().filter_map(seen).max_by(|a, b| a.0.total_cmp(&b.0));
        farthest.is_some_and(|(_, is_outside)| !is_outside)
    }

    /// Every piece that reaches into the cell, translated there.
    fn translates(&self, cell: &FundamentalCell) -> &Pieces {
        self.parts.get_or_init(|| {
            let mut corners = vec![];
            let mut pieces = vec![];
            let copies = translates(&self.pieces, cell, 0.0);
            // neighbours across an edge share a vertex exactly, or a path through it could slip through between them
            let mut moved: Vec<_> = copies.iter().map(|copy| copy.piece.clone()).collect();
            unite(&mut moved);
            for (Translate { number, by, .. }, piece) in copies.into_iter().zip(moved) {
                let ends = self.pieces[number].ends().map_or(vec![], Vec::from);
                corners.extend(ends.iter().filter(|end| self.corners.contains(end)).map(|end| end + by));
                pieces.push((number, piece));
            }
            Arc::new(Pieces::new(pieces, &corners))
        })
    }
}

/// Whether a polygon has a vertex that is not a corner of the table: composite walls of straight sides report every vertex
/// as a corner.
fn has_flat_vertex(sides: &[Side], is_corner: impl Fn(&Vector2<f64>) -> bool) -> bool {
    let starts: Option<Vec<Segment>> = sides.iter().map(|side| side.straight).collect();
    starts.is_some_and(|sides| sides.iter().any(|side| !is_corner(&side.start().into())))
}

/// A piece as a segment, if it is one.
fn straight(piece: &dyn Piece) -> Option<Segment> {
    match piece.shape() {
        Some(Shape::Segment(side)) => Some(side),
        _ => None,
    }
}
