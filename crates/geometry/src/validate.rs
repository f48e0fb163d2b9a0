//! Is this a table? What a set of pieces must satisfy before a particle may run in it.
use crate::{
    Error, Extent, Figure, Lattice, Meeting, MeetingKind, Piece, Table,
    intersect::{direction_at, self_crossing},
    meetings,
    plane::{key, slack},
    shapes::Shape,
    sight::{Aim, Sight, Wall},
    spokes::alternate,
    table::side_by_side,
};
use nalgebra::Vector2;
use std::collections::HashSet;

/// Largest radius that an arc may have, in units of the largest coordinate of the table's vertices. Points of an arc carry the rounding of
/// its radius, so with a radius a million times the table's size they are known to ten digits of that size.
const FLATTEST: f64 = 1e6;

/// Least ratio of the semi-axes of an ellipse. With this one, its two sides are closer together than rounding of coordinates ([`slack`])
/// only within 3·10⁻¹¹ of its longer semi-axis from its ends.
const THINNEST: f64 = 1.0 / (1_u64 << 32) as f64;

/// Least width of a piece, in units of the table's size. Hits are compared as fractions of products of lengths: the numerator and denominator
/// for an ellipse are, in units of its shorter semi-axis (which [`THINNEST`] bounds), squares of distances in the table, so that with pieces
/// of this width the products of two of them are up to 10²⁷⁸.
const SMALLEST: f64 = 1e-60;

/// Where pieces of a table touch.
struct Contacts {
    /// The points where an end lies on a piece other than the one before or after it, and where a stretch that two have in common begins
    /// or ends.
    junctions: Vec<Vector2<f64>>,
    /// The error that two pieces run along each other with the table on different sides, and are not known as the two sides of one wall: a
    /// path that has hit the one could be beyond the other.
    faces: Option<Error>,
}

impl Contacts {
    /// Adds where two pieces with these numbers touch, but for a joint of one with the next. Returns the error that they cross, if they
    /// do.
    fn add(
        &mut self,
        pieces: [&dyn Piece; 2],
        [first, second]: [usize; 2],
        is_joint: impl Fn(&Meeting) -> bool,
    ) -> Option<Error> {
        let found = meetings(pieces[0], pieces[1]);
        if self.faces.is_none() && pieces.iter().any(|p| !p.has_two_sides()) {
            self.faces = side_by_side(pieces, &found).map(|at| Error::Faces { first, second, at: at.into() });
        }
        let mut error = None;
        for m in found {
            let crossing = Error::Crossing { first, second, at: m.point.into() };
            match m.kind {
                MeetingKind::Crossing => error = Some(crossing),
                MeetingKind::Overlap => {
                    let [t, u] = pieces.map(|p| direction_at(p, &m.point));
                    // two sides of one wall may coincide, the same side twice may not; a wall without thickness already has both
                    if t.dot(&u) > 0.0 || pieces.iter().any(|p| p.tips().is_some()) {
                        error = Some(crossing);
                    }
                    self.junctions.push(m.point);
                }
                MeetingKind::End if is_joint(&m) => {}
                MeetingKind::End => self.junctions.push(m.point),
                MeetingKind::Tangency => {}
            }
        }
        error
    }
}

impl Table {
    /// Checks that the boundary bounds a table: no piece is shorter or flatter than rounding, no two pieces cross (they may touch),
    /// and the table lies on the left of all of them.
    ///
    /// Outermost loops run counter-clockwise and holes clockwise, unless the table is [unbounded](Table::unbounded). A closed curve
    /// that is one piece says itself on which side the table lies, so a circle in the open plane may have the table outside. Ten pieces or a
    /// million are checked in about a microsecond each, unless the boxes around many of them overlap. [`Table::joined`] removes stretches that
    /// loops have in common with the table on neither side.
    ///
    /// # Errors
    /// [`Error::TooShort`], [`Error::Small`], [`Error::Flat`], [`Error::Thin`], [`Error::InfiniteOnLattice`], [`Error::SelfCrossing`],
    /// [`Error::Crossing`], [`Error::Spike`], [`Error::Faces`], [`Error::Collapsed`], [`Error::Orientation`] or [`Error::OneSided`], with the
    /// numbers of the pieces and about where.
    pub fn validate(&self) -> Result<(), Error> {
        let vertices = self.pieces().iter().filter_map(Piece::ends).flatten();
        let size = vertices.map(|v| v.amax()).filter(|x| x.is_finite()).fold(0.0, f64::max);
        let least = SMALLEST * self.reach();
        for (piece, p) in self.pieces().iter().enumerate() {
            if let Figure::Arc { radius, .. } = p.figure()
                && radius > FLATTEST * size
            {
                return Err(Error::Flat { piece, radius, size });
            }
            let length = p.length();
            if length <= slack([p.extent().size()]) {
                return Err(Error::TooShort { piece, length });
            }
            let Extent { min, max } = p.extent();
            let width = (max - min).amax();
            if width < least {
                return Err(Error::Small { piece, width, least });
            }
            if !length.is_finite() && !self.is_along_lattice(&p.figure()) {
                return Err(Error::InfiniteOnLattice { piece });
            }
            if let Some(Shape::Ellipse(ellipse)) = p.shape() {
                let [a, b] = ellipse.semi_axes();
                let (width, least) = (a.min(b), (THINNEST * a.max(b)).max(slack([p.extent().size()])));
                if width < least {
                    return Err(Error::Thin { piece, width, least });
                }
            } else if p.figure() == Figure::Other
                && p.tips().is_none() // its faces coincide
                && let Some(at) = self_crossing(&**p)
            {
                return Err(Error::SelfCrossing { piece, at: at.into() });
            }
        }
        let sight = Sight::new(self, 0.0);
        let Contacts { junctions, faces } = self.contacts(&sight)?;
        for point in junctions {
            alternate(sight.copies(), &point)?;
        }
        faces.map_or(Ok(()), Err)?;
        self.orientation(&sight)?;
        self.sides_of_a_torus()
    }

    /// The greatest finite coordinate of a piece or of a lattice vector.
    fn reach(&self) -> f64 {
        let vectors = self.shortest().into_iter().flat_map(Lattice::vectors).map(Vector2::amax);
        self.pieces().iter().map(|p| p.extent().size()).chain(vectors).fold(0.0, f64::max)
    }

    /// Whether an infinite piece is allowed on the lattice: only a line along the only lattice vector.
    fn is_along_lattice(&self, figure: &Figure) -> bool {
        let Some(lattice) = self.shortest() else { return true };
        match (figure, lattice.vectors()) {
            (Figure::Line { direction, .. }, [a]) => {
                direction.perp(a).abs() <= 4.0 * f64::EPSILON * libm::hypot(a.x, a.y)
            }
            _ => false,
        }
    }

    /// Fails where two pieces cross.
    fn contacts(&self, sight: &Sight) -> Result<Contacts, Error> {
        let copies = sight.copies();
        let mut follows = vec![None; self.pieces().len()];
        for chain in &sight.chains {
            for w in chain.windows(2) {
                follows[w[0]] = Some(w[1]);
            }
            if self.is_closed(chain) {
                follows[chain[chain.len() - 1]] = Some(chain[0]);
            }
        }
        let joint = |i: usize, j: usize, m: &Meeting| {
            let ends = |k: usize| self.pieces()[k].ends();
            follows[i] == Some(j)
                && ends(i).is_some_and(|[_, b]| b == m.point)
                && ends(j).is_some_and(|[a, _]| a == m.point)
        };
        let mut contacts = Contacts { junctions: vec![], faces: None };
        let mut error = None;
        for index in copies.order() {
            let (copy, extent) = copies.get(index);
            if copy.cell != [0.0; 2] {
                continue;
            }
            let (i, reach) = (copy.number, slack([extent.size()]));
            copies.search(
                |e| e.meets(extent, reach),
                |other| {
                    let (other, _) = copies.get(other);
                    let j = other.number;
                    // each pair once
                    if error.is_some() || j < i || (j == i && other.cell <= [0.0; 2]) {
                        return;
                    }
                    let is_joint = |m: &Meeting| other.cell == [0.0; 2] && (joint(i, j, m) || joint(j, i, m));
                    error = contacts.add([&*copy.piece, &*other.piece], [i, j], is_joint);
                },
            );
            if let Some(error) = error {
                return Err(error);
            }
        }
        let mut seen = HashSet::new();
        contacts.junctions.retain(|p| seen.insert(key(*p)));
        Ok(contacts)
    }

    /// Fails where a piece has the table on its right.
    fn orientation(&self, sight: &Sight) -> Result<(), Error> {
        let chains = &sight.chains;
        let (width, area) = (|k: usize| sight.width(k), |k: usize| sight.area(k));
        let collapsed = |k: usize| area(k).abs() <= slack([sight.extents[k].size()]) * width(k);
        // in the plane, the widest loop lies in no other; of equally wide ones that touch it, it has the largest area; a two-sided wall
        // may be wider, but nothing lies in it
        let wider = |&a: &usize, &b: &usize| {
            width(a).total_cmp(&width(b)).then_with(|| area(a).abs().total_cmp(&area(b).abs()))
        };
        let outermost = (0..chains.len()).filter(|&k| area(k) != 0.0).max_by(wider);
        if let Some(k) = outermost
            && self.shortest().is_none()
            && chains.iter().all(|c| self.is_closed(c))
            && chains[k].len() > 1
        {
            let (piece, area) = (chains[k][0], area(k));
            match (self.unbounded, collapsed(k)) {
                (false, true) if area != 0.0 => return Err(Error::Collapsed { piece, area }),
                (true, false) if area > 0.0 => return Err(Error::Orientation { piece }),
                (false, false) if area < 0.0 => return Err(Error::Orientation { piece }),
                _ => {}
            }
        }
        let infinite = sight.infinite();
        // of two loops that disagree, the inner one is named; on a lattice, where the table mostly lies around the loops, one with the
        // table inside
        let disagree = |a: &Wall, b: &Wall| {
            let [first, second] = [a, b].map(|wall| {
                let k = sight.chain_of[wall.number];
                let room = self.shortest().is_some() && self.is_closed(&chains[k]) && area(k) > 0.0;
                (!room, width(k))
            });
            Error::Orientation { piece: if second < first { b.number } else { a.number } }
        };
        // a wall behind which there is no other; all that lies around is one region
        let mut last: Option<Wall> = None;
        let surrounded = infinite.is_empty() && self.shortest().is_none();
        for k in 0..chains.len() {
            let others = [(k + 1) % chains.len()].into_iter().chain(infinite.iter().copied());
            let aims = [Aim::Inward, Aim::Outward].into_iter().chain(others.filter(|&other| other != k).map(Aim::At));
            for aim in aims {
                // only as far as the next chain: among thousands, a line through the whole table meets dozens
                let enough = |wall: &Wall| {
                    let there = sight.chain_of[wall.number];
                    if let Aim::At(other) = aim { there == other } else { there != k }
                };
                let Some((walls, escapes)) = sight.look(k, aim, enough) else { continue };
                // a wall seen from the table must not lead into it
                let mut pairs = walls.iter().zip(&walls[1..]);
                if let Some((from, hit)) = pairs.find(|(from, hit)| sight.is_table_behind(from) == hit.into_table) {
                    return Err(disagree(from, hit));
                }
                if let (true, true, Some(wall)) = (escapes, surrounded, walls.last()) {
                    let other = *last.get_or_insert(*wall);
                    if sight.is_table_behind(wall) != sight.is_table_behind(&other) {
                        return Err(disagree(&other, wall));
                    }
                }
            }
        }
        Ok(())
    }

    /// Fails where walls around a flat torus have the table on their left and, going round the torus the other way, on their right: walls
    /// that bound a region lead back as far as they lead out.
    fn sides_of_a_torus(&self) -> Result<(), Error> {
        let Some(lattice) = self.shortest().filter(|lattice| lattice.vectors().len() == 2) else { return Ok(()) };
        let steps = self.pieces().iter().filter_map(Piece::ends).map(|[a, b]| b - a);
        if lattice.rounded(&steps.sum()) == [0.0; 2] {
            return Ok(());
        }
        let around = self.chains().into_iter().rfind(|chain| !self.is_closed(chain));
        around.map_or(Ok(()), |chain| Err(Error::OneSided { piece: chain[0] }))
    }
}

/// About where a closed outline crosses itself, if it does. Such an outline may enclose as much area on its left as on its right without
/// being flat.
pub(crate) fn crosses_itself(outline: Vec<Box<dyn Piece>>) -> Option<[f64; 2]> {
    let table = Table::new(outline).ok()?;
    match table.validate() {
        Err(Error::SelfCrossing { at, .. }) => Some(at),
        Err(Error::Crossing { first, second, at }) => {
            let [a, b] = [first, second].map(|i| &*table.pieces()[i]);
            // an outline that runs twice along one stretch does not cross itself there
            meetings(a, b).iter().all(|m| m.kind != MeetingKind::Overlap).then_some(at)
        }
        _ => None,
    }
}
