//! Is this a table? What a set of pieces must satisfy before a particle may run in it.
use crate::{
    Error, Extent, Figure, Meeting, MeetingKind, Piece, Table,
    copies::{Copies, finite_extent},
    intersect::{direction_at, self_crossing},
    meetings,
    plane::slack,
    shapes::Ray,
};
use nalgebra::Vector2;
use std::collections::HashSet;

/// Directions that differ by less than this (radians) are told apart by curvature instead.
const SAME_DIRECTION: f64 = 1e-9;

impl Table {
    /// Checks that the boundary bounds a table: no piece is shorter than rounding, no two pieces cross (they may touch),
    /// and the table lies on the left of all of them.
    ///
    /// Outermost loops run counter-clockwise and holes clockwise. A closed curve that is one piece says itself on which
    /// side the table lies, so a circle in the open plane may have the table outside. Ten pieces or a million are
    /// checked in about a microsecond each.
    ///
    /// # Errors
    /// [`Error::TooShort`], [`Error::InfiniteOnLattice`], [`Error::SelfCrossing`], [`Error::Crossing`] or
    /// [`Error::Orientation`], with the numbers of the pieces and about where.
    pub fn validate(&self) -> Result<(), Error> {
        let size = finite_size(self.pieces());
        for (piece, p) in self.pieces().iter().enumerate() {
            let length = p.length();
            if length <= slack([p.extent().size()]) {
                return Err(Error::TooShort { piece, length });
            }
            if !length.is_finite() && !self.is_along_lattice(&p.figure()) {
                return Err(Error::InfiniteOnLattice { piece });
            }
            if p.figure() == Figure::Other
                && let Some(at) = self_crossing(&**p)
            {
                return Err(Error::SelfCrossing { piece, at: at.into() });
            }
        }
        let copies = Copies::new(self.pieces(), self.lattice(), &finite_extent(self.pieces()), slack([size]));
        let junctions = self.crossings(&copies)?;
        for point in junctions {
            alternates(&copies, &point)?;
        }
        self.orientation(&copies, size)
    }

    /// Whether an infinite piece may stand on the lattice: a line along the only lattice vector.
    fn is_along_lattice(&self, figure: &Figure) -> bool {
        let Some(lattice) = self.lattice() else { return true };
        match (figure, lattice.vectors()) {
            (Figure::Line { direction, .. }, [a]) => {
                direction.perp(a).abs() <= 4.0 * f64::EPSILON * libm::hypot(a.x, a.y)
            }
            _ => false,
        }
    }

    /// Fails where two pieces cross. The points where an end lies on a piece other than the one before or after it.
    fn crossings(&self, copies: &Copies) -> Result<Vec<Vector2<f64>>, Error> {
        let mut follows = vec![usize::MAX; self.pieces().len()];
        for chain in self.chains() {
            for w in chain.windows(2) {
                follows[w[0]] = w[1];
            }
            if self.is_closed(&chain) {
                follows[chain[chain.len() - 1]] = chain[0];
            }
        }
        let joint = |i: usize, j: usize, m: &Meeting| {
            let ends = |k: usize| self.pieces()[k].ends();
            follows[i] == j && ends(i).is_some_and(|[_, b]| b == m.point) && ends(j).is_some_and(|[a, _]| a == m.point)
        };
        let mut junctions = vec![];
        let mut error = None;
        for &index in copies.order() {
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
                    for m in meetings(&*copy.piece, &*other.piece) {
                        let crossing = Error::Crossing { first: i, second: j, at: m.point.into() };
                        match m.kind {
                            MeetingKind::Crossing => error = Some(crossing),
                            MeetingKind::Overlap => {
                                let [t, u] = [&copy.piece, &other.piece].map(|p| direction_at(&**p, &m.point));
                                // two sides of one wall may coincide, one side twice may not
                                if t.dot(&u) > 0.0 {
                                    error = Some(crossing);
                                }
                            }
                            MeetingKind::End if other.cell == [0.0; 2] && (joint(i, j, &m) || joint(j, i, &m)) => {}
                            MeetingKind::End => junctions.push(m.point),
                            MeetingKind::Tangency => {}
                        }
                    }
                },
            );
            if let Some(error) = error {
                return Err(error);
            }
        }
        let mut seen = HashSet::new();
        junctions.retain(|p| seen.insert([p.x.to_bits(), p.y.to_bits()]));
        Ok(junctions)
    }

    /// Fails where a piece has the table on its right.
    fn orientation(&self, copies: &Copies, size: f64) -> Result<(), Error> {
        let chains = self.chains();
        let mut chain_of = vec![0; self.pieces().len()];
        for (k, chain) in chains.iter().enumerate() {
            for &i in chain {
                chain_of[i] = k;
            }
        }
        let extent =
            |chain: &[usize]| chain.iter().map(|&i| self.pieces()[i].extent()).fold(Extent::EMPTY, Extent::union);
        let area = |chain: &[usize]| chain.iter().map(|&i| self.pieces()[i].area()).sum::<f64>();
        let width = |chain: &[usize]| {
            let e = extent(chain);
            (e.max.x - e.min.x) + (e.max.y - e.min.y)
        };
        // in the plane, the widest loop lies in no other
        let outermost = chains.iter().max_by(|a, b| width(a).total_cmp(&width(b)));
        if let Some(chain) = outermost
            && self.lattice().is_none()
            && chains.iter().all(|c| self.is_closed(c))
            && chain.len() > 1
            && area(chain) < 0.0
        {
            return Err(Error::Orientation { piece: chain[0] });
        }
        let infinite = chains.iter().filter(|c| !extent(c).is_finite());
        for (k, chain) in chains.iter().enumerate() {
            let aims = [Aim::Inward, Aim::Outward].into_iter();
            let next = (chains.len() > 1).then(|| &chains[(k + 1) % chains.len()]);
            let others = next.into_iter().chain(infinite.clone()).filter(|other| *other != chain);
            for aim in aims.chain(others.map(|other| Aim::At(other))) {
                let Some((from, hit)) = self.look(copies, chain, &aim, size) else { continue };
                // of two loops that disagree, the inner one is named
                let inner = width(&chains[chain_of[hit]]) < width(chain);
                return Err(Error::Orientation { piece: if inner { hit } else { from } });
            }
        }
        Ok(())
    }

    /// Looks from a chain, and returns where from and which piece is seen if that piece has its table on the other side.
    fn look(&self, copies: &Copies, chain: &[usize], aim: &Aim, size: f64) -> Option<(usize, usize)> {
        // some places may look at a corner; irrational parts of the length soon find one that does not
        for k in 0..16_usize {
            let (i, at) = self.place(chain, k, 0.381_966_011_250_105, size);
            let normal = self.pieces()[i].closest(&at).normal;
            let direction = match aim {
                Aim::Inward => normal,
                Aim::Outward => -normal,
                Aim::At(other) => self.place(other, k, 0.618_033_988_749_895, size).1 - at,
            };
            let Ok(ray) = Ray::new(at, direction, true) else { continue };
            // a look along the wall itself is on neither side
            let into_table = direction.dot(&normal);
            if into_table.abs() <= 1e-6 * libm::hypot(direction.x, direction.y) {
                continue;
            }
            match first_seen(copies, i, &ray, &at, slack([size])) {
                Seen::Nothing => return None,
                Seen::Unclear => {}
                Seen::Piece { number, from_table } => {
                    return (from_table != (into_table > 0.0)).then_some((i, number));
                }
            }
        }
        None
    }

    /// The `k`-th of 16 places spread over a chain.
    pub(crate) fn place(&self, chain: &[usize], k: usize, part: f64, size: f64) -> (usize, Vector2<f64>) {
        let i = chain[k * chain.len() / 16];
        let piece = &self.pieces()[i];
        let part = part + 0.236_067_977_499_79 * (k as f64 / 16.0);
        let length = piece.length();
        let from_end = piece.ends().is_some_and(|[a, _]| a.iter().all(|x| x.is_finite()));
        let s = match (length.is_finite(), from_end) {
            (true, _) => length * part,
            (false, true) => size * part,
            (false, false) => -size * part,
        };
        (i, piece.point_at(s))
    }
}

/// Where to look from a boundary.
enum Aim<'a> {
    Inward,
    Outward,
    At(&'a [usize]),
}

/// Greatest finite coordinate of some pieces; 1 where there is none (two lines through the origin).
fn finite_size(pieces: &[std::sync::Arc<dyn Piece>]) -> f64 {
    let of_figure = |p: &dyn Piece| match p.figure() {
        Figure::Line { through, .. } => through.amax(),
        _ => p.extent().size(),
    };
    let size = pieces.iter().map(|p| of_figure(&**p)).fold(0.0, f64::max);
    if size > 0.0 { size } else { 1.0 }
}

/// What a look along a ray finds first.
enum Seen {
    Nothing,
    /// A corner, or a wall it grazes.
    Unclear,
    Piece {
        number: usize,
        /// Whether from the side of the table.
        from_table: bool,
    },
}

/// The first piece along a ray that starts on the piece `own`.
fn first_seen(copies: &Copies, own: usize, ray: &Ray, from: &Vector2<f64>, rounding: f64) -> Seen {
    let mut best = (f64::INFINITY, Seen::Nothing);
    let Figure::Ray { direction, .. } = ray.figure() else { return Seen::Unclear };
    copies.search(
        |e| is_hit(e, from, &direction, rounding),
        |index| {
            let (copy, _) = copies.get(index);
            for m in meetings(ray, &*copy.piece) {
                let s = m.at[0];
                let at_start = s <= 4.0 * rounding;
                if s > best.0 || (at_start && copy.number == own && copy.cell == [0.0; 2]) {
                    continue;
                }
                let facing = copy.piece.closest(&m.point).normal.dot(&direction);
                // grazing hits may be of either side
                let clear = m.kind == MeetingKind::Crossing && !at_start && facing.abs() > 1e-6 && s < best.0;
                let seen = Seen::Piece { number: copy.number, from_table: facing < 0.0 };
                best = (s, if clear { seen } else { Seen::Unclear });
            }
        },
    );
    best.1
}

/// Whether a ray meets a box, or comes close to it.
pub(crate) fn is_hit(extent: &Extent, from: &Vector2<f64>, direction: &Vector2<f64>, reach: f64) -> bool {
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
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

/// Fails unless boundaries that come into a point and go out of it alternate around it, as they do around every point
/// where tables touch. Otherwise two of them cross there.
fn alternates(copies: &Copies, point: &Vector2<f64>) -> Result<(), Error> {
    struct Branch {
        /// Direction away from the point, its angle, and the curvature to the left.
        angle: f64,
        curvature: f64,
        out: bool,
        number: usize,
    }
    let mut branches: Vec<Branch> = vec![];
    let here = Extent { min: *point, max: *point };
    let tolerance = 4.0 * slack(point.iter().copied());
    copies.search(
        |e| e.meets(&here, tolerance),
        |index| {
            let (copy, extent) = copies.get(index);
            let piece = &copy.piece;
            let near = tolerance.max(slack([extent.size()]));
            if (piece.closest(point).point - point).amax() > near {
                return;
            }
            let direction = direction_at(&**piece, point);
            let curvature = piece.curvature(point);
            let [starts, ends] = piece.ends().map_or([false; 2], |e| e.map(|end| (end - point).amax() <= near));
            let mut add = |out: bool| {
                let d = if out { direction } else { -direction };
                let curvature = if out { curvature } else { -curvature };
                branches.push(Branch { angle: libm::atan2(d.y, d.x), curvature, out, number: copy.number });
            };
            if !ends {
                add(true);
            }
            if !starts {
                add(false);
            }
        },
    );
    branches.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    // begin behind the widest gap, so that equal directions stay together
    let turn = core::f64::consts::TAU;
    let gap = |k: usize| {
        let last = if k == 0 { branches[branches.len() - 1].angle - turn } else { branches[k - 1].angle };
        branches[k].angle - last
    };
    let Some(first) = (0..branches.len()).max_by(|&i, &j| gap(i).total_cmp(&gap(j))) else { return Ok(()) };
    let start = branches[first].angle;
    for b in &mut branches {
        b.angle -= start;
        if b.angle < 0.0 {
            b.angle += turn;
        }
    }
    branches.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    // branches that leave in one direction bend away from each other
    let mut last = 0.0;
    let mut bundle = 0.0;
    for b in &mut branches {
        if b.angle - last > SAME_DIRECTION {
            bundle = b.angle;
        }
        (last, b.angle) = (b.angle, bundle);
    }
    branches.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.curvature.total_cmp(&b.curvature)));
    let alike = |a: &Branch, b: &Branch| {
        let both = a.curvature.abs() + b.curvature.abs();
        a.angle == b.angle && (a.curvature - b.curvature).abs() <= 1e-6 * both
    };
    if branches.windows(2).any(|w| alike(&w[0], &w[1])) {
        return Ok(()); // two sides of one wall: what lies between them has no room for a table
    }
    for k in 0..branches.len() {
        let (a, b) = (&branches[k], &branches[(k + 1) % branches.len()]);
        if a.out == b.out {
            return Err(Error::Crossing { first: a.number, second: b.number, at: (*point).into() });
        }
    }
    Ok(())
}
