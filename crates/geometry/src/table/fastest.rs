//! The fastest walls for a table.
use super::{
    FundamentalCell, Table, Translate,
    container::{Container, Enclosed, MOST_SIDES},
    translates,
};
use crate::{
    Figure, Piece,
    nearest::nearest_of,
    shapes::{Segment, Shape},
    walls::{Around, List, Periodic, Pieces, Polygon, Scatterer, WithWalls},
};
use std::sync::Arc;

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
        // obstacles of straight sides in a rectangle, too, are asked faster together with it
        if self.polygon.get().is_some() || (self.pieces.len() > MOST_SIDES && self.is_straight()) {
            return self.with_general_walls(visit);
        }
        let Some(known) = self.enclosed.get_or_init(|| self.enclosed().map(Arc::new)) else {
            return self.with_general_walls(visit);
        };
        let Enclosed { container, rest } = &**known;
        match (container, rest.as_slice()) {
            (Container::Level(walls), []) => visit.run_homogeneous(walls),
            (Container::Upright(walls), []) => visit.run_homogeneous(walls),
            (Container::Rectangle(walls), []) => visit.run(walls),
            (Container::Hexagon(walls), []) => visit.run(walls),
            (Container::Convex(walls), []) => visit.run(walls),
            (Container::Wedge(walls), []) => visit.run(walls),
            (Container::Capsule(walls), []) => visit.run(walls),
            (Container::RotatedCapsule(walls), []) => visit.run(walls),
            (Container::Disk(walls), []) => visit.run_homogeneous(walls),
            (Container::Rectangle(walls), [one]) => match self.scatterer(*one) {
                Some(disk) => visit.run(&Around { container: walls.clone(), obstacles: disk }),
                None => visit.run(&Around { container: walls.clone(), obstacles: self.parts(&[*one]) }),
            },
            (Container::Disk(walls), [one]) => match self.scatterer(*one) {
                Some(disk) => visit.run(&Around { container: walls.clone(), obstacles: disk }),
                None => visit.run(&Around { container: walls.clone(), obstacles: self.parts(&[*one]) }),
            },
            (Container::Rectangle(walls), many) => {
                visit.run(&Around { container: walls.clone(), obstacles: self.parts(many) })
            }
            _ => self.with_general_walls(visit),
        }
    }

    /// Runs a computation with walls of any form.
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

    /// All pieces as the sides of a polygon, if they are straight and none is one side of a wall with two.
    fn polygon(&self) -> Option<Polygon> {
        let number = |(i, side): (usize, Option<Segment>)| Some((i, side.filter(|side| !side.is_two_sided())?));
        let sides: Option<Vec<_>> =
            self.pieces.iter().map(|piece| straight(&**piece)).enumerate().map(number).collect();
        Some(Polygon::new(&sides?, &self.corners))
    }

    /// A piece as a scatterer, if it is one.
    fn scatterer(&self, piece: usize) -> Option<Scatterer<2>> {
        match self.pieces[piece].figure() {
            Figure::Circle { center, radius, inside: false } => Scatterer::new(center, radius, piece).ok(),
            _ => None,
        }
    }

    /// All that there is in a cell, if that is one disk as a whole.
    fn lone_disk(&self, cell: &FundamentalCell) -> Option<Scatterer<2>> {
        match self.figures()[..] {
            [Figure::Circle { center, radius, inside: false }] => {
                let (home, _) = cell.home(&center);
                cell.contains_disk(home, radius).then(|| Scatterer::new(home, radius, 0).ok())?
            }
            _ => None,
        }
    }

    /// Any table as a list of pieces, asked one by one: the reference for all other walls.
    pub fn list(&self, numbers: impl IntoIterator<Item = usize>) -> List {
        List::new(self.numbered(numbers), &self.corners)
    }

    /// Those pieces that no composite wall covers as walls, each asked in the best way.
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
        let figures = self.figures();
        let rest = |used: &[usize]| (0..self.pieces.len()).filter(|i| !used.contains(i)).collect();
        for chain in self.chains() {
            let of_chain: Vec<Figure> = chain.iter().map(|&i| figures[i]).collect();
            if chain.iter().any(|&i| self.pieces[i].shape().is_some_and(|shape| shape.is_two_sided())) {
                continue; // what starts on it may be on either side
            }
            let sides: Option<Vec<Segment>> = chain.iter().map(|&i| straight(&*self.pieces[i])).collect();
            if let Some(container) = Container::of(&chain, &of_chain, sides.as_deref()) {
                let rest: Vec<usize> = rest(&chain);
                // what else there is must lie inside: a table may have several rooms
                let fits = !self.has_flat_vertex(&of_chain) && rest.iter().all(|&i| self.inside(&chain, i));
                return fits.then_some(Enclosed { container, rest });
            }
        }
        if let [Figure::Line { .. }, Figure::Line { .. }] = figures[..]
            && let Some(slab) = Container::slab(&figures)
        {
            return Some(Enclosed { container: slab, rest: vec![] });
        }
        None
    }

    /// Whether a polygon has a vertex that is no corner of the table: composite walls of straight sides call each of theirs one.
    fn has_flat_vertex(&self, chain: &[Figure]) -> bool {
        let start = |figure: &Figure| match figure {
            Figure::Segment { ends: [start, _] } => Some(*start),
            _ => None,
        };
        let starts: Option<Vec<_>> = chain.iter().map(start).collect();
        starts.is_some_and(|starts| starts.iter().any(|start| !self.corners.contains(start)))
    }

    /// Whether a piece lies on the table's side of a chain that it does not cross.
    fn inside(&self, chain: &[usize], piece: usize) -> bool {
        let point = self.pieces[piece].point_at(0.5 * self.pieces[piece].length());
        let nearest = nearest_of(chain.iter().map(|&i| (i, &*self.pieces[i])), &point);
        nearest.is_some_and(|(_, foot)| (point - foot.point).dot(&foot.normal) >= 0.0)
    }

    /// Every piece that reaches into the cell, translated there.
    fn translates(&self, cell: &FundamentalCell) -> &Pieces {
        self.parts.get_or_init(|| {
            let mut corners = vec![];
            let mut pieces = vec![];
            for Translate { number, by, piece, .. } in translates(&self.pieces, cell, 0.0) {
                let ends = self.pieces[number].ends().map_or(vec![], Vec::from);
                corners.extend(ends.iter().filter(|end| self.corners.contains(end)).map(|end| end + by));
                pieces.push((number, piece));
            }
            Arc::new(Pieces::new(pieces, &corners))
        })
    }
}

/// A piece as a segment, if it is one.
fn straight(piece: &dyn Piece) -> Option<Segment> {
    match piece.shape() {
        Some(Shape::Segment(side)) => Some(side),
        _ => None,
    }
}
