//! A table: its pieces, how they hang together, and the fastest walls for it.
use crate::{
    Error, Extent, Figure, Landing, Lattice, Piece,
    plane::slack,
    shapes::{self, Segment},
    walls::{
        Around, Capsule, ConvexPolygon, Cuboid, List, Periodic, Pieces, Polygon, Rotated, Scatterer, Slab, Sphere,
        Wedge, WithWalls, Zonogon,
    },
};
use nalgebra::Vector2;
use std::{
    cell::LazyCell,
    sync::{Arc, OnceLock},
};

/// A planar table: numbered boundary pieces, each traversed with the table on its left.
///
/// Pieces that meet share a vertex exactly. A vertex where the direction of the boundary jumps is a corner.
#[derive(Clone, Debug)]
pub struct Table {
    pieces: Vec<Arc<dyn Piece>>,
    /// For each piece, the one that starts where it ends.
    next: Vec<Option<usize>>,
    corners: Vec<Vector2<f64>>,
    lattice: Option<Lattice>,
    /// All pieces with their numbers; on a lattice, every translate that reaches within a cell of the unit cell.
    nearby: Vec<(usize, Arc<dyn Piece>)>,
    /// All pieces as the sides of a polygon, where composite walls do not cover them and they are straight. This and what follows
    /// is made when it is first asked for: of many pieces or of curves that takes longer than many a run.
    polygon: OnceLock<Option<Arc<Polygon>>>,
    /// Those pieces that no composite wall covers, on a lattice with all translates.
    parts: OnceLock<Arc<Pieces>>,
}

/// Two normals that differ by less than this belong to a smooth joint.
///
/// Rounding of the vertices of a joint meant to be smooth turns the normals by a few ulp of size over length of the
/// shorter piece; no corner that anybody means is this flat.
const SMOOTH: f64 = 1e-9;

impl Table {
    /// The table bounded by the given pieces.
    ///
    /// # Errors
    /// [`Error::Empty`] without pieces, [`Error::Open`] where a piece ends and no other starts.
    pub fn new(pieces: Vec<Box<dyn Piece>>) -> Result<Table, Error> {
        Table::periodic(pieces, None)
    }

    /// The same on the plane modulo a lattice. A piece may then end where a translate of another one starts.
    ///
    /// # Errors
    /// As [`Table::new`].
    pub fn periodic(pieces: Vec<Box<dyn Piece>>, lattice: Option<Lattice>) -> Result<Table, Error> {
        if pieces.is_empty() {
            return Err(Error::Empty);
        }
        let pieces: Vec<Arc<dyn Piece>> = pieces.into_iter().map(Arc::from).collect();
        let ends: Vec<Option<[Vector2<f64>; 2]>> = pieces.iter().map(|p| p.ends()).collect();
        let finite = |v: &Vector2<f64>| v.iter().all(|x| x.is_finite());
        let starts = || ends.iter().enumerate().filter_map(|(i, e)| e.map(|[a, _]| (a, i)));
        let order = |a: &Vector2<f64>, b: &Vector2<f64>| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        let positive = |v: &Vector2<f64>| v.map(|x| x + 0.0); // −0 is 0
        let sorted = LazyCell::new(|| {
            let mut sorted: Vec<(Vector2<f64>, usize)> = starts().map(|(a, i)| (positive(&a), i)).collect();
            sorted.sort_by(|(a, _), (b, _)| order(a, b));
            sorted
        });
        let starts_at = |i: usize, v: &Vector2<f64>| ends.get(i).copied().flatten().is_some_and(|[a, _]| a == *v);
        // mostly the piece after it, or the first piece of the loop that it closes
        let mut head = 0;
        let mut starting_at = |v: &Vector2<f64>, i: usize| {
            let next = [i + 1, head].into_iter().find(|&j| starts_at(j, v));
            if next != Some(i + 1) {
                head = i + 1;
            }
            next.or_else(|| {
                let v = positive(v);
                sorted.binary_search_by(|(a, _)| order(a, &v)).ok().map(|k| sorted[k].1)
            })
        };
        let starting_at_translate = |b: &Vector2<f64>, lattice: &Lattice| {
            let same = |a: &Vector2<f64>| {
                let off = b - a - lattice.translation(lattice.nearest(&(b - a)));
                finite(a) && off.amax() <= slack(a.iter().chain(b.iter()).copied())
            };
            starts().find(|(a, _)| same(a))
        };
        // whether the direction of the boundary jumps from the end of one piece to the start of another
        let kink = |(i, b): (usize, Vector2<f64>), (j, a): (usize, Vector2<f64>)| {
            (pieces[i].closest(&b).normal - pieces[j].closest(&a).normal).norm() > SMOOTH
        };
        let mut next = vec![None; pieces.len()];
        let mut corners = vec![];
        for (i, end) in ends.iter().enumerate() {
            let Some([_, b]) = end else {
                next[i] = Some(i);
                continue;
            };
            if !finite(b) {
                continue;
            }
            next[i] = starting_at(b, i);
            if let Some(j) = next[i] {
                if kink((i, *b), (j, *b)) {
                    corners.push(*b);
                }
            } else if let Some((a, j)) = lattice.as_ref().and_then(|lattice| starting_at_translate(b, lattice)) {
                if kink((i, *b), (j, a)) {
                    corners.extend([*b, a]);
                }
            } else {
                let gap = starts().map(|(a, _)| (a - b).norm()).fold(f64::INFINITY, f64::min);
                return Err(Error::Open { piece: i, gap });
            }
        }
        let nearby = match &lattice {
            Some(lattice) => translates(&pieces, lattice, 1.0).into_iter().map(|(i, _, piece)| (i, piece)).collect(),
            None => pieces.iter().cloned().enumerate().collect(),
        };
        Ok(Table { pieces, next, corners, lattice, nearby, polygon: OnceLock::new(), parts: OnceLock::new() })
    }

    /// The pieces, in the order of their numbers.
    pub fn pieces(&self) -> &[Arc<dyn Piece>] {
        &self.pieces
    }

    /// The vertices at which the direction of the boundary jumps.
    pub fn corners(&self) -> &[Vector2<f64>] {
        &self.corners
    }

    /// The translations that identify points, where there are any.
    pub fn lattice(&self) -> Option<&Lattice> {
        self.lattice.as_ref()
    }

    /// The closed loops and infinite chains of the boundary: piece numbers in the order of traversal.
    pub fn chains(&self) -> Vec<Vec<usize>> {
        let mut has_previous = vec![false; self.pieces.len()];
        for &j in self.next.iter().flatten() {
            has_previous[j] = true;
        }
        let mut seen = vec![false; self.pieces.len()];
        let heads = (0..self.pieces.len()).filter(|&i| !has_previous[i]).chain(0..self.pieces.len());
        let mut chains = vec![];
        for head in heads {
            let mut chain = vec![];
            let mut at = Some(head);
            while let Some(i) = at.filter(|&i| !seen[i]) {
                seen[i] = true;
                chain.push(i);
                at = self.next[i];
            }
            if !chain.is_empty() {
                chains.push(chain);
            }
        }
        chains
    }

    /// Whether a chain of [`Table::chains`] closes.
    pub fn is_closed(&self, chain: &[usize]) -> bool {
        chain.last().is_some_and(|&last| self.next[last] == chain.first().copied())
    }

    /// Area of the table \[L²\], per unit cell on a lattice; infinite or NaN for infinite tables.
    pub fn area(&self) -> f64 {
        let mut enclosed: f64 = self.pieces.iter().map(|p| p.area()).sum();
        // a chain that goes on in a translate of itself is closed along edges of the cell, of which two differ by the
        // vector from its start to its end
        for chain in self.chains().iter().filter(|chain| !self.is_closed(chain)) {
            let (first, last) = (chain[0], chain[chain.len() - 1]);
            if let (Some([a, _]), Some([_, b])) = (self.pieces[first].ends(), self.pieces[last].ends()) {
                enclosed += 0.5 * a.perp(&b);
            }
        }
        match &self.lattice {
            Some(lattice) if enclosed < 0.0 => lattice.cell_area() + enclosed,
            _ => enclosed,
        }
    }

    /// Length of the boundary \[L\], per unit cell on a lattice.
    pub fn perimeter(&self) -> f64 {
        self.pieces.iter().map(|p| p.length()).sum()
    }

    /// A box around all pieces; infinite where they are.
    pub fn extent(&self) -> Extent {
        self.pieces.iter().map(|p| p.extent()).fold(Extent::EMPTY, Extent::union)
    }

    /// The piece closest to a point, the point of it that is closest, and its inward normal.
    pub fn closest(&self, point: &Vector2<f64>) -> (usize, Landing) {
        let (home, cell) = self.lattice.as_ref().map_or((*point, None), |lattice| {
            let (home, cell) = lattice.reduce(point);
            (home, Some(lattice.translation(cell)))
        });
        let (i, mut landing) = closest_of(self.nearby.iter().map(|(i, piece)| (*i, piece)), &home);
        if let Some(back) = cell {
            landing.point += back;
        }
        (i, landing)
    }

    /// The curvature \[L⁻¹\] of a piece at a point of it, or on a lattice of a translate of it; 0 for a number beyond the last.
    pub fn curvature(&self, piece: usize, point: &Vector2<f64>) -> f64 {
        // on a lattice, of the translate that is there
        let here = |p: &&Arc<dyn Piece>| (p.closest(point).point - point).norm_squared();
        let copies = self.nearby.iter().filter(|(number, _)| *number == piece).map(|(_, p)| p);
        copies.min_by(|a, b| here(a).total_cmp(&here(b))).map_or(0.0, |p| p.curvature(point))
    }

    /// The distance from the boundary \[L\], negative outside the table.
    pub fn signed_distance(&self, point: &Vector2<f64>) -> f64 {
        let (_, landing) = self.closest(point);
        let d = point - landing.point;
        let distance = libm::hypot(d.x, d.y);
        if d.dot(&landing.normal) < 0.0 { -distance } else { distance }
    }

    /// Whether a point lies in the table, off the boundary.
    pub fn contains(&self, point: &Vector2<f64>) -> bool {
        self.signed_distance(point) > 0.0
    }

    /// Arc length of the start of each piece, all pieces laid end to end in the order of their numbers.
    pub fn arc_length_offsets(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let before = |p: &Arc<dyn Piece>| {
            let at = sum;
            sum += p.length();
            at
        };
        self.pieces.iter().map(before).collect()
    }

    /// Runs a computation with the best walls for this table.
    pub fn with_walls<V: WithWalls<2>>(&self, visit: V) -> V::Output {
        if let Some(lattice) = &self.lattice {
            return match self.figures().as_slice() {
                [Figure::Circle { center, radius, inside: false }] if inside_cell(*center, *radius, lattice) => {
                    match Scatterer::new(*center, *radius, 0) {
                        Ok(disk) => visit.run(&Periodic::new(disk, lattice)),
                        Err(_) => visit.run(&Periodic::new(self.translates(lattice), lattice)),
                    }
                }
                _ => visit.run(&Periodic::new(self.translates(lattice), lattice)),
            };
        }
        // obstacles of straight sides in a rectangle, too, are asked faster together with it
        if self.polygon.get().is_some() || (self.pieces.len() > MOST_SIDES && self.is_straight()) {
            return self.with_general_walls(visit);
        }
        let Some((container, rest)) = self.container() else { return self.with_general_walls(visit) };
        match (container, rest.as_slice()) {
            (Container::Level(walls), []) => visit.run_homogeneous(&walls),
            (Container::Upright(walls), []) => visit.run_homogeneous(&walls),
            (Container::Rectangle(walls), []) => visit.run(&walls),
            (Container::Hexagon(walls), []) => visit.run(&walls),
            (Container::Convex(walls), []) => visit.run(&walls),
            (Container::Wedge(walls), []) => visit.run(&walls),
            (Container::Capsule(walls), []) => visit.run(&walls),
            (Container::RotatedCapsule(walls), []) => visit.run(&walls),
            (Container::Disk(walls), []) => visit.run_homogeneous(&walls),
            (Container::Rectangle(walls), [one]) => match self.scatterer(*one) {
                Some(disk) => visit.run(&Around { container: walls, obstacles: disk }),
                None => visit.run(&Around { container: walls, obstacles: self.parts(&[*one]) }),
            },
            (Container::Disk(walls), [one]) => match self.scatterer(*one) {
                Some(disk) => visit.run(&Around { container: walls, obstacles: disk }),
                None => visit.run(&Around { container: walls, obstacles: self.parts(&[*one]) }),
            },
            (Container::Rectangle(walls), many) => visit.run(&Around { container: walls, obstacles: self.parts(many) }),
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
        self.pieces.iter().all(|piece| matches!(piece.figure(), Figure::Segment { .. }))
    }

    /// All pieces as the sides of a polygon, if they are straight.
    fn polygon(&self) -> Option<Polygon> {
        let side = |(i, piece): (usize, &Arc<dyn Piece>)| match piece.figure() {
            Figure::Segment { ends } => Some((i, ends)),
            _ => None,
        };
        let sides: Option<Vec<_>> = self.pieces.iter().enumerate().map(side).collect();
        Polygon::new(&sides?, &self.corners).ok()
    }

    /// A piece as a scatterer, if it is one.
    fn scatterer(&self, piece: usize) -> Option<Scatterer<2>> {
        match self.pieces[piece].figure() {
            Figure::Circle { center, radius, inside: false } => Scatterer::new(center, radius, piece).ok(),
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
    fn container(&self) -> Option<(Container, Vec<usize>)> {
        let figures = self.figures();
        let rest = |used: &[usize]| (0..self.pieces.len()).filter(|i| !used.contains(i)).collect();
        for chain in self.chains() {
            let of_chain: Vec<Figure> = chain.iter().map(|&i| figures[i]).collect();
            if let Some(container) = Container::of(&chain, &of_chain) {
                let rest: Vec<usize> = rest(&chain);
                // what else there is must lie inside: a table may have several rooms
                return rest.iter().all(|&i| self.inside(&chain, i)).then_some((container, rest));
            }
        }
        if let [Figure::Line { .. }, Figure::Line { .. }] = figures[..]
            && let Some(slab) = Container::slab(&figures)
        {
            return Some((slab, vec![]));
        }
        None
    }

    /// Whether a piece lies on the table's side of a chain that it does not cross.
    fn inside(&self, chain: &[usize], piece: usize) -> bool {
        let point = self.pieces[piece].point_at(0.5 * self.pieces[piece].length());
        let (_, landing) = closest_of(chain.iter().map(|&i| (i, &self.pieces[i])), &point);
        (point - landing.point).dot(&landing.normal) >= 0.0
    }

    /// Every piece that reaches into the unit cell, translated there.
    fn translates(&self, lattice: &Lattice) -> &Pieces {
        self.parts.get_or_init(|| {
            let mut corners = vec![];
            let mut pieces = vec![];
            for (i, by, piece) in translates(&self.pieces, lattice, 0.0) {
                let ends = self.pieces[i].ends().map_or(vec![], Vec::from);
                corners.extend(ends.iter().filter(|end| self.corners.contains(end)).map(|end| end + by));
                pieces.push((i, piece));
            }
            Arc::new(Pieces::new(pieces, &corners))
        })
    }
}

/// Whether a disk lies in the unit cell, so that no translate of it reaches in.
fn inside_cell(center: Vector2<f64>, radius: f64, lattice: &Lattice) -> bool {
    (0..lattice.vectors().len()).all(|i| {
        let [f, g] = lattice.functional(i);
        let (at, reach) = (f * center.x + g * center.y, radius * libm::hypot(f, g));
        at - reach >= 0.0 && at + reach <= 1.0
    })
}

/// The closest of some pieces, the point of it that is closest, and its inward normal.
fn closest_of<'a>(pieces: impl Iterator<Item = (usize, &'a Arc<dyn Piece>)>, point: &Vector2<f64>) -> (usize, Landing) {
    let mut best = (0, Landing { point: Vector2::zeros(), normal: Vector2::zeros() });
    let mut distance = f64::INFINITY;
    for (i, piece) in pieces {
        let landing = piece.closest(point);
        let d = (landing.point - point).norm_squared();
        // at a shared vertex, equally far but for rounding, the piece that the point faces decides
        let faces = |l: &Landing| l.normal.dot(&(point - l.point)).abs();
        let same = d <= distance * (1.0 + 1e-12) && distance <= d * (1.0 + 1e-12);
        if if same { faces(&landing) > faces(&best.1) } else { d < distance } {
            best = (i, landing);
            distance = d;
        }
    }
    best
}

/// The translates of pieces, with their numbers and the translations, that reach within `margin` cells of the unit cell.
fn translates(pieces: &[Arc<dyn Piece>], lattice: &Lattice, margin: f64) -> Vec<(usize, Vector2<f64>, Arc<dyn Piece>)> {
    let mut found: Vec<(usize, Vector2<f64>, Arc<dyn Piece>)> = vec![];
    for (i, piece) in pieces.iter().enumerate() {
        let Extent { min, max } = piece.extent();
        let corners_of = [min, Vector2::new(max.x, min.y), max, Vector2::new(min.x, max.y)];
        let mut range = [[0.0, 0.0]; 2];
        for (k, range) in range.iter_mut().enumerate().take(lattice.vectors().len()) {
            let [f, g] = lattice.functional(k);
            // an infinite extent at right angles to the functional counts nothing
            let at = corners_of.map(|c| [f * c.x, g * c.y].iter().filter(|a| !a.is_nan()).sum::<f64>());
            let (low, high) = at.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &a| (l.min(a), h.max(a)));
            if low.is_finite() && high.is_finite() {
                // translates by t reach that far where low + t < 1 + margin and high + t ≥ −margin
                *range = [-libm::floor(high + margin), libm::ceil(1.0 + margin - low) - 1.0];
            }
        }
        let mut first = range[0][0];
        while first <= range[0][1] {
            let mut second = range[1][0];
            while second <= range[1][1] {
                let by = lattice.translation([first, second]);
                let at_home = by == Vector2::zeros();
                let moved = || -> Arc<dyn Piece> { Arc::new(shapes::Translated::new(piece.clone(), by)) };
                found.push((i, by, if at_home { piece.clone() } else { moved() }));
                second += 1.0;
            }
            first += 1.0;
        }
    }
    found
}

/// A composite wall that encloses the particle.
enum Container {
    Level(Slab<2, 1>),
    Upright(Slab<2, 0>),
    Rectangle(Cuboid<2>),
    Hexagon(Zonogon<3>),
    Convex(ConvexPolygon),
    Wedge(Wedge),
    Capsule(Capsule),
    RotatedCapsule(Rotated<Capsule>),
    Disk(Sphere<2>),
}

/// Polygons with more sides than this are better served piece by piece.
const MOST_SIDES: usize = 16;

impl Container {
    fn of(chain: &[usize], figures: &[Figure]) -> Option<Container> {
        if let [Figure::Circle { center, radius, inside: true }] = figures {
            return Sphere::new(*center, *radius, chain[0]).ok().map(Container::Disk);
        }
        if let (&[i, j], &[arriving, leaving]) = (chain, figures)
            && let Ok(wedge) = Wedge::new([arriving, leaving], [i, j])
        {
            return Some(Container::Wedge(wedge));
        }
        if chain.windows(2).any(|w| w[1] != w[0] + 1) {
            return None; // composite walls number their pieces consecutively
        }
        Container::polygon(chain[0], figures).or_else(|| Container::capsule(chain, figures))
    }

    fn polygon(first: usize, figures: &[Figure]) -> Option<Container> {
        if figures.len() > MOST_SIDES {
            return None;
        }
        let side = |f: &Figure| match f {
            Figure::Segment { ends: [a, b] } => Segment::new(*a, *b).ok(),
            _ => None,
        };
        let sides: Vec<Segment> = figures.iter().map(side).collect::<Option<_>>()?;
        Container::rectangle(first, &sides)
            .or_else(|| Zonogon::new(&sides, first).ok().map(Container::Hexagon))
            .or_else(|| ConvexPolygon::new(&sides, first).ok().map(Container::Convex))
    }

    fn rectangle(first: usize, sides: &[Segment]) -> Option<Container> {
        if sides.len() != 4 {
            return None;
        }
        let all: Vec<[f64; 2]> = sides.iter().map(Segment::start).collect();
        let bound = |i: usize, pick: fn(f64, f64) -> f64| all.iter().map(|p| p[i]).reduce(pick).unwrap_or(0.0);
        let (low, high) = ([bound(0, f64::min), bound(1, f64::min)], [bound(0, f64::max), bound(1, f64::max)]);
        // the walls in the order of axes: lower and upper
        let mut pieces = [[usize::MAX; 2]; 2];
        for (k, s) in sides.iter().enumerate() {
            let n = s.inward_normal();
            let axis = usize::from(n[0] == 0.0);
            if n[1 - axis] != 0.0 || s.start()[axis] != s.end()[axis] {
                return None;
            }
            pieces[axis][usize::from(n[axis] < 0.0)] = first + k;
        }
        if pieces.iter().flatten().any(|&p| p == usize::MAX) {
            return None;
        }
        Cuboid::new(low, high, pieces).ok().map(Container::Rectangle)
    }

    fn capsule(chain: &[usize], figures: &[Figure]) -> Option<Container> {
        // in whatever order the loop starts: side, cap, side, cap
        let k = figures.iter().position(|f| matches!(f, Figure::Segment { .. }))?;
        let at = |i: usize| figures[(k + i) % figures.len()];
        if figures.len() != 4 {
            return None;
        }
        let (
            Figure::Segment { ends: [a, b] },
            Figure::Arc { center: head, radius, ends: [b1, c0], inside: true },
            Figure::Segment { ends: [c, d] },
            Figure::Arc { center: tail, radius: r2, ends: [d1, a1], inside: true },
        ) = (at(0), at(1), at(2), at(3))
        else {
            return None;
        };
        let size = [a, b, c, d].iter().flat_map(|p| p.iter()).fold(0.0, |m: f64, x| m.max(x.abs()));
        let near = |p: Vector2<f64>, q: Vector2<f64>| (p - q).amax() <= 16.0 * f64::EPSILON * size;
        let axis = head - tail;
        let length = libm::hypot(axis.x, axis.y);
        let across = Vector2::new(axis.y, -axis.x) * (radius / length);
        let fits = (radius - r2).abs() <= 16.0 * f64::EPSILON * size
            && near(a, tail + across)
            && near(b, head + across)
            && near(c, head - across)
            && near(d, tail - across)
            && b == b1
            && c == c0
            && d == d1
            && a == a1;
        let pieces = [0, 1, 2, 3].map(|i| chain[(k + i) % 4]);
        if !fits {
            return None;
        }
        // in the capsule's own frame, along whose first axis the centres lie
        let [c, s] = [axis.x / length, axis.y / length];
        let middle = (head + tail) * 0.5;
        let center = Vector2::new(middle.x * c + middle.y * s, middle.y * c - middle.x * s);
        let capsule = Capsule::new(center, 0.5 * length, radius, pieces).ok()?;
        if axis.y == 0.0 && axis.x > 0.0 {
            return Some(Container::Capsule(capsule));
        }
        Rotated::new(capsule, axis).ok().map(Container::RotatedCapsule)
    }

    fn slab(figures: &[Figure]) -> Option<Container> {
        let [Figure::Line { through: p, direction: d }, Figure::Line { through: q, direction: e }] = figures else {
            return None;
        };
        for axis in 0..2 {
            let across = 1 - axis;
            // along the axis `across`, opposite to one another; the table on the left of each
            if d[axis] == 0.0 && e[axis] == 0.0 && d[across] == -e[across] {
                let first_is_low = if axis == 1 { d.x > 0.0 } else { d.y < 0.0 };
                let (low, high, pieces) =
                    if first_is_low { (p[axis], q[axis], [0, 1]) } else { (q[axis], p[axis], [1, 0]) };
                return if axis == 1 {
                    Slab::new(low, high, pieces).ok().map(Container::Level)
                } else {
                    Slab::new(low, high, pieces).ok().map(Container::Upright)
                };
            }
        }
        None
    }
}
