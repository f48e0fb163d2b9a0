//! The moved pieces, cut where they meet, and the parts of them that bound the region of centres.
use super::{
    Origin,
    moved::Moved,
    raw::RawBoundary,
    tolerances::Tolerances,
    vertices::{Site, Vertices, minus},
};
use crate::{
    Error, Figure, MeetingKind, Piece, Table,
    copies::{Copies, Translate, finite_extent},
    intersect::direction_at,
    joints::{Branch, leftmost},
    meetings,
    shapes::{self, Parallel, Translated},
};
use nalgebra::Vector2;
use std::sync::Arc;

/// A meeting at an end with directions that differ by less than this (radians) says nothing about sides: where curves touch is known
/// only to the square root of rounding, 10⁻⁸.
const TANGENT: f64 = 1e-6;

/// A place where a moved piece is cut.
#[derive(Clone, Copy, Debug)]
struct Cut {
    /// Arc length.
    s: f64,
    site: Site,
    /// Whether the piece leaves the zone that is too near the boundary, and whether it enters it: it crosses another moved piece to its
    /// left, or to its right.
    leaves: bool,
    enters: bool,
}

/// The room beside a point of a moved piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Room {
    /// None: it is too near the boundary, in a corridor as wide as the disk, or behind a wall.
    None,
    /// The point is in front of all walls that the disk touches there.
    Clear,
    /// The point is in front of one of the walls that the disk touches there and behind another one.
    AmongWalls,
}

/// Part of a moved piece between cuts.
#[derive(Clone, Copy, Debug)]
struct Section {
    raw: usize,
    /// The last of several parts of one parallel curve; otherwise `raw`.
    last: usize,
    range: [f64; 2],
    sites: [Option<Site>; 2],
}

pub(super) struct Arrangement<'a> {
    table: &'a Table,
    radius: f64,
    raw: Vec<Moved>,
    vertices: Vertices,
    cuts: Vec<Vec<Cut>>,
    tolerances: Tolerances,
}

/// The pieces of a loop, with their origins.
type Loop = Vec<(Box<dyn Piece>, Origin)>;

impl<'a> Arrangement<'a> {
    pub(super) fn new(table: &'a Table, radius: f64, boundary: RawBoundary) -> Arrangement<'a> {
        let RawBoundary { pieces: raw, vertices } = boundary;
        let tolerances = Tolerances::new(table, radius, &raw, &vertices);
        let mut all = Arrangement { table, radius, cuts: vec![vec![]; raw.len()], raw, vertices, tolerances };
        all.cut();
        all.unite();
        all
    }

    /// Finds all meetings.
    fn cut(&mut self) {
        let pieces: Vec<Arc<dyn Piece>> = self.raw.iter().map(|r| r.piece.clone()).collect();
        let copies = Copies::new(&pieces, self.table.shortest(), &finite_extent(&pieces), self.tolerances.widest);
        for index in copies.order() {
            let (copy, extent) = copies.get(index);
            if copy.cell != [0.0; 2] {
                continue;
            }
            let i = copy.number;
            let mut others = vec![];
            copies.search(|e| e.meets(extent, self.tolerances.widest), |other| others.push(other));
            for other in others {
                let (other, _) = copies.get(other);
                let j = other.number;
                if j < i || (j == i && other.cell <= [0.0; 2]) {
                    continue;
                }
                for m in meetings(&*copy.piece, &*other.piece) {
                    let [t, u] = [&copy.piece, &other.piece].map(|p| direction_at(&**p, &m.point));
                    // with equal directions neither crosses to the other side; with opposite ones the region is pinched here
                    if m.kind == MeetingKind::Tangency && t.dot(&u) > 0.0 {
                        continue;
                    }
                    // the left of a moved piece is away from its wall; the right is too near to it
                    let leftward = u.perp(&t);
                    let clear = match m.kind {
                        MeetingKind::Crossing => true,
                        MeetingKind::End => leftward.abs() > TANGENT && !self.go_on([i, j], other.cell, m.point),
                        MeetingKind::Tangency | MeetingKind::Overlap => false,
                    };
                    let (left, right) = (clear && leftward > 0.0, clear && leftward < 0.0);
                    let site = self.vertices.add(m.point);
                    self.tolerances.of_vertices.push(self.tolerances.of_raw[i].max(self.tolerances.of_raw[j]));
                    self.cuts[i].push(Cut { s: m.at[0], site, leaves: left, enters: right });
                    let site = site.moved(minus(other.cell));
                    self.cuts[j].push(Cut { s: m.at[1], site, leaves: right, enters: left });
                }
            }
        }
        for (raw, cuts) in self.raw.iter().zip(&mut self.cuts) {
            let last = if raw.ends[0].is_some() { raw.piece.length() } else { 0.0 };
            for (end, s) in [(raw.ends[0], 0.0), (raw.ends[1], last)] {
                cuts.extend(end.map(|site| Cut { s, site, leaves: false, enters: false }));
            }
            cuts.sort_by(|a, b| a.s.total_cmp(&b.s));
        }
    }

    /// Whether two pieces, the second one in another cell, continue one another at a point: a small angle there, within what counts as
    /// smooth, says nothing about sides.
    fn go_on(&self, [i, j]: [usize; 2], cell: [f64; 2], point: Vector2<f64>) -> bool {
        let tolerance = self.tolerances.of_raw[i].max(self.tolerances.of_raw[j]);
        let its: Vec<Site> = self.raw[j].ends.iter().flatten().map(|site| site.moved(cell)).collect();
        let mut own = self.raw[i].ends.iter().flatten();
        own.any(|site| its.contains(site) && (self.vertices.at(*site) - point).amax() <= tolerance)
    }

    /// Merges vertices that differ by rounding, and cuts at the same vertex.
    fn unite(&mut self) {
        self.vertices.unite_near(&self.tolerances.of_vertices);
        for ((raw, cuts), tolerance) in self.raw.iter().zip(&mut self.cuts).zip(&self.tolerances.of_raw) {
            let mut single: Vec<Cut> = vec![];
            let length = raw.piece.length();
            for cut in cuts.drain(..) {
                // anything this short is not a piece
                if let Some(last) = single.last_mut().filter(|last| cut.s - last.s <= 4.0 * tolerance) {
                    self.vertices.unite(last.site, cut.site);
                    // the piece's own end is known to the last digit, meetings with others there are not
                    if cut.s == 0.0 || cut.s == length {
                        last.s = cut.s;
                    }
                    last.leaves |= cut.leaves;
                    last.enters |= cut.enters;
                } else {
                    single.push(cut);
                }
            }
            if raw.piece.ends().is_none() && single.len() > 1 {
                let (first, last) = (single[0], single[single.len() - 1]);
                if first.s + length - last.s <= 4.0 * tolerance {
                    self.vertices.unite(first.site, last.site);
                    single[0].leaves |= last.leaves;
                    single[0].enters |= last.enters;
                    single.pop();
                }
            }
            if raw.piece.ends().is_none() && single.len() == 1 {
                // a circle cut once gets a second vertex opposite, since an arc needs two distinct ends
                let s = single[0].s + 0.5 * length;
                let site = self.vertices.add(raw.piece.point_at(s));
                single.push(Cut { s, site, leaves: false, enters: false });
            }
            *cuts = single;
        }
    }

    /// The loops of the region of centres.
    pub(super) fn loops(&self) -> Result<Vec<Loop>, Error> {
        let sections = self.kept();
        let mut chains = self.chains(&sections)?;
        for chain in &mut chains {
            self.join(chain);
        }
        // loop by loop, each from its lowest origin
        let rank = |s: &Section| {
            let origin = self.raw[s.raw].origin;
            (origin.piece(), origin, s.raw)
        };
        for chain in &mut chains {
            if chain.closed.is_some() {
                let first = (0..chain.sections.len()).min_by_key(|&k| rank(&chain.sections[k].0)).unwrap_or(0);
                chain.rotate(first);
            }
        }
        chains.sort_by_key(|chain| chain.sections.iter().map(|(s, _)| rank(s)).min());
        let mut loops = vec![];
        for chain in &chains {
            let mut pieces = self.pieces(chain)?;
            if chain.closed.is_none() {
                pieces.sort_by_key(|(_, origin)| (origin.piece(), *origin));
            }
            loops.push(pieces);
        }
        Ok(loops)
    }

    /// The sections that are as far from the boundary as they should be.
    fn kept(&self) -> Vec<Section> {
        let pieces: Vec<Arc<dyn Piece>> = self.raw.iter().map(|r| r.piece.clone()).collect();
        let reach = self.radius + 2.0 * self.tolerances.widest;
        let drawn = Copies::new(self.table.pieces(), self.table.shortest(), &finite_extent(&pieces), reach);
        let mut kept = vec![];
        for (raw, (r, cuts)) in self.raw.iter().zip(&self.cuts).enumerate() {
            let length = r.piece.length();
            let mut pairs: Vec<[Option<Cut>; 2]> = cuts.windows(2).map(|w| [Some(w[0]), Some(w[1])]).collect();
            match (cuts.first(), cuts.last()) {
                (Some(&first), Some(&last)) => {
                    if r.piece.ends().is_none() {
                        pairs.push([Some(last), Some(Cut { s: first.s + length, ..first })]);
                    } else if !length.is_finite() {
                        // add the parts that reach to infinity
                        if r.ends[0].is_none() {
                            pairs.insert(0, [None, Some(first)]);
                        }
                        if r.ends[1].is_none() {
                            pairs.push([Some(last), None]);
                        }
                    }
                }
                _ => pairs.push([None, None]),
            }
            for pair in pairs {
                let hidden = pair[0].is_some_and(|c| c.enters) || pair[1].is_some_and(|c| c.leaves);
                let range = match pair.map(|c| c.map(|c| c.s)) {
                    [Some(a), Some(b)] => [a, b],
                    [Some(a), None] => [a, f64::INFINITY],
                    [None, Some(b)] => [f64::NEG_INFINITY, b],
                    [None, None] if length.is_finite() => [0.0, length],
                    [None, None] => [f64::NEG_INFINITY, f64::INFINITY],
                };
                if !hidden && self.is_clear(&drawn, raw, range) {
                    kept.push(Section { raw, last: raw, range, sites: pair.map(|c| c.map(|c| c.site)) });
                }
            }
        }
        kept
    }

    /// Whether a section is at the right distance from the boundary, with room beside it: this is tested at its middle, and at further
    /// points where the middle may happen to be in line with a place where walls touch, like the middle of the arc around a tip.
    fn is_clear(&self, drawn: &Copies, number: usize, [low, high]: [f64; 2]) -> bool {
        let raw = &self.raw[number];
        let step = self.radius.max(self.tolerances.general / f64::EPSILON);
        let room_at = |share: f64| {
            let at = match (low.is_finite(), high.is_finite()) {
                (true, true) => low + share * (high - low),
                (true, false) => low + 2.0 * share * step,
                (false, true) => high - 2.0 * share * step,
                (false, false) => (2.0 * share - 1.0) * step,
            };
            self.room_at(drawn, number, at)
        };
        let is_tip = matches!(raw.origin, Origin::Corner { before, after } if before == after);
        match room_at(0.5) {
            Room::None => false,
            Room::Clear if !is_tip => true,
            Room::Clear | Room::AmongWalls => [0.125, 0.875].into_iter().all(|share| room_at(share) != Room::None),
        }
    }

    /// The room beside a point of a moved piece.
    fn room_at(&self, drawn: &Copies, number: usize, at: f64) -> Room {
        let piece = &*self.raw[number].piece;
        let at = piece.point_at(at);
        if drawn.nearest(&at, self.radius - self.tolerances.widest).is_some() {
            return Room::None;
        }
        // walls on both sides: a corridor exactly as wide as the disk is closed; and an arc around the tip of a wall that ends on
        // another one may be behind that other wall
        let normal = piece.closest(&at).normal;
        let (mut near, mut pinched, mut before, mut behind) = (false, false, false, false);
        drawn.search(
            |e| e.distance(&at) <= self.radius + self.tolerances.widest,
            |index| {
                let Translate { piece: wall, number: drawn, .. } = drawn.get(index).0;
                let tolerance = self.tolerances.of_ended[number].max(self.tolerances.of_drawn[*drawn]);
                let landing = wall.closest(&at);
                let off = at - landing.point;
                let distance = libm::hypot(off.x, off.y);
                if distance > self.radius + tolerance {
                    return;
                }
                let [ends, tips] = [wall.ends(), wall.tips()];
                let mut ends = ends.iter().chain(&tips).flatten();
                let at_end = ends.any(|end| (end - landing.point).amax() <= tolerance);
                let side = off.dot(&landing.normal);
                near |= distance < self.radius - tolerance;
                pinched |= off.dot(&normal) < -0.5 * self.radius;
                before |= side > 0.5 * self.radius && !at_end;
                behind |= side < -0.5 * self.radius && !at_end;
            },
        );
        match (before, behind) {
            _ if near || pinched => Room::None,
            (_, false) => Room::Clear,
            (true, true) => Room::AmongWalls,
            (false, true) => Room::None,
        }
    }

    /// Links the sections into chains.
    fn chains(&self, sections: &[Section]) -> Result<Vec<Chain>, Error> {
        let root = |site: Site| self.vertices.find(site);
        let mut starting: std::collections::HashMap<usize, Vec<usize>> = std::collections::HashMap::new();
        for (k, s) in sections.iter().enumerate() {
            if let Some(site) = s.sites[0] {
                starting.entry(root(site).vertex).or_default().push(k);
            }
        }
        let undecided = |site: Site| Error::Undecided { radius: self.radius, at: self.vertices.at(site).into() };
        let branch = |s: &Section, end: usize| {
            let point = s.sites[end].map_or_else(Vector2::zeros, |site| self.vertices.at(site));
            Branch::of(&*self.raw[s.raw].piece, &point)
        };
        let mut next = vec![None; sections.len()];
        let mut has_previous = vec![false; sections.len()];
        for (k, s) in sections.iter().enumerate() {
            let Some(end) = s.sites[1] else { continue };
            let candidates = starting.get(&root(end).vertex).ok_or_else(|| undecided(end))?;
            let outgoing = candidates.iter().map(|&c| branch(&sections[c], 0));
            let c = candidates[leftmost(branch(s, 1), outgoing).ok_or_else(|| undecided(end))?];
            if has_previous[c] {
                return Err(undecided(end));
            }
            has_previous[c] = true;
            next[k] = Some(c);
        }
        for (s, has) in sections.iter().zip(&has_previous) {
            if let Some(start) = s.sites[0].filter(|_| !has) {
                return Err(undecided(start));
            }
        }
        let mut used = vec![false; sections.len()];
        let mut chains = vec![];
        let heads = (0..sections.len()).filter(|&k| !has_previous[k]).chain(0..sections.len());
        for head in heads.collect::<Vec<_>>() {
            if used[head] {
                continue;
            }
            let mut chain = Chain { sections: vec![], closed: None };
            let (mut at, mut cell) = (head, [0.0; 2]);
            loop {
                used[at] = true;
                chain.sections.push((sections[at], cell));
                let Some(following) = next[at] else {
                    // a circle without cuts has no next section, and needs none
                    break;
                };
                // the next section starts where this one ends, in whatever cell
                if let (Some(end), Some(start)) = (sections[at].sites[1], sections[following].sites[0]) {
                    let (end, start) = (root(end), root(start));
                    cell = [0, 1].map(|k| cell[k] + end.cell[k] - start.cell[k]);
                }
                if following == head {
                    chain.closed = Some(cell);
                    break;
                }
                at = following;
            }
            chains.push(chain);
        }
        Ok(chains)
    }

    /// Merges neighbouring sections that were separated by a cut which turned out to be unnecessary.
    fn join(&self, chain: &mut Chain) {
        let continues = |(a, cell): &(Section, [f64; 2]), (b, next): &(Section, [f64; 2])| {
            let [p, q] = [a.last, b.raw].map(|raw| &self.raw[raw]);
            let length = p.piece.length();
            let wraps = p.piece.ends().is_none() && a.range[1] == b.range[0] + length;
            let same = a.last == b.raw && (a.range[1] == b.range[0] || wraps);
            let parts = match (&p.part, &q.part) {
                // not where one part ends at the beginning of another by chance, as where the curve touches itself
                (Some(p), Some(q)) => p.leads_to(q, [a.last, b.raw]) && a.range[1] == length && b.range[0] == 0.0,
                _ => false,
            };
            cell == next && (same || parts)
        };
        if chain.closed == Some([0.0; 2]) {
            // start with a section that does not continue the one before
            let count = chain.sections.len();
            let start = (0..count).find(|&k| !continues(&chain.sections[(k + count - 1) % count], &chain.sections[k]));
            if let Some(start) = start {
                chain.rotate(start);
            } else {
                // a closed curve as a whole
                chain.sections.truncate(1);
                chain.sections[0].0.sites = [None; 2];
                return;
            }
        }
        // the arc length of a closed curve begins anew at its seam, which stays a vertex where not all of the curve is left
        let is_seam = |a: &Section, b: &Section| {
            let [p, q] = [a.last, b.raw].map(|raw| self.raw[raw].part.as_ref().map(|part| part.parallel.base_range()));
            p.zip(q).is_some_and(|([_, end], [start, _])| start < end)
        };
        let mut joined: Vec<(Section, [f64; 2])> = vec![];
        for &(section, cell) in &chain.sections {
            match joined.last_mut() {
                Some((last, _)) if continues(&(*last, cell), &(section, cell)) && !is_seam(last, &section) => {
                    last.sites[1] = section.sites[1];
                    last.range[1] = section.range[1];
                    last.last = section.last;
                }
                _ => joined.push((section, cell)),
            }
        }
        chain.sections = joined;
    }

    /// The pieces of a chain, with shared vertices.
    fn pieces(&self, chain: &Chain) -> Result<Loop, Error> {
        let mut made: Loop = vec![];
        let place = |site: Option<Site>, cell: [f64; 2]| site.map(|site| self.vertices.at(site.moved(cell)));
        let Some(&(first, cell)) = chain.sections.first() else { return Ok(made) };
        let start = place(first.sites[0], cell);
        let mut from = start;
        for (k, (section, cell)) in chain.sections.iter().enumerate() {
            let last = k + 1 == chain.sections.len();
            let closes = last && chain.closed == Some([0.0; 2]);
            let to = if closes { start } else { place(section.sites[1], *cell) };
            let piece = self.piece(section, *cell, [from, to]).map_err(|error| match (error, to.or(from)) {
                // the rest of a piece between vertices that are equal up to rounding
                (Error::ZeroLength | Error::OffRadius { .. }, Some(at)) => {
                    Error::Undecided { radius: self.radius, at: at.into() }
                }
                (other, _) => other,
            })?;
            made.push((piece, self.raw[section.raw].origin));
            from = to;
        }
        Ok(made)
    }

    /// A section between its vertices.
    fn piece(
        &self,
        section: &Section,
        cell: [f64; 2],
        ends: [Option<Vector2<f64>>; 2],
    ) -> Result<Box<dyn Piece>, Error> {
        let raw = &self.raw[section.raw];
        let shift = self.vertices.translation(cell);
        let somewhere = raw.piece.point_at(if section.range[0].is_finite() { section.range[0] } else { 0.0 });
        let undecided = Error::Undecided { radius: self.radius, at: (somewhere + shift).into() };
        Ok(match (raw.piece.figure(), ends) {
            (Figure::Segment { .. } | Figure::Ray { .. } | Figure::Line { .. }, [Some(a), Some(b)]) => {
                Box::new(shapes::Segment::of_line(a, b, raw.piece.closest(&(a - shift)).normal.into())?)
            }
            (Figure::Ray { direction, left, .. }, [Some(a), None] | [None, Some(a)]) => {
                Box::new(shapes::Ray::new(a, direction, left)?)
            }
            (Figure::Line { direction, .. }, [Some(a), None]) => Box::new(shapes::Ray::new(a, direction, true)?),
            (Figure::Line { direction, .. }, [None, Some(b)]) => Box::new(shapes::Ray::new(b, -direction, false)?),
            (Figure::Line { through, direction }, [None, None]) => Box::new(shapes::FullLine::new(through, direction)?),
            (
                Figure::Arc { center, radius, inside, .. } | Figure::Circle { center, radius, inside },
                [Some(a), Some(b)],
            ) => Box::new(shapes::Arc::with_radius(center + shift, radius, a, b, inside)?),
            (Figure::Circle { center, radius, inside }, _) => {
                Box::new(shapes::Circle::new(center + shift, radius, inside)?)
            }
            (_, [Some(a), Some(b)]) if raw.part.is_some() => {
                let parallels = [section.raw, section.last].map(|k| self.raw[k].part.as_ref().map(|p| &p.parallel));
                let [Some(first), Some(last)] = parallels else { return Err(undecided) };
                let range = [first.base_parameter(section.range[0]), last.base_parameter(section.range[1])];
                // translate the base and not the parallel, so that its ends are the vertices to the last digit
                Box::new(Parallel::new(translated(first.base(), shift), self.radius, range, Some([a, b]))?)
            }
            (_, [None, None]) => {
                let Some(part) = &raw.part else { return Err(undecided) };
                let base = translated(part.parallel.base(), shift);
                let length = base.length();
                Box::new(Parallel::new(base, self.radius, [0.0, length], None)?)
            }
            _ => return Err(undecided),
        })
    }
}

fn translated(piece: &Arc<dyn Piece>, by: Vector2<f64>) -> Arc<dyn Piece> {
    if by == Vector2::zeros() { Arc::clone(piece) } else { Arc::new(Translated::new(Arc::clone(piece), by)) }
}

/// Sections that follow each other.
struct Chain {
    /// The sections, each with the cell it is moved to.
    sections: Vec<(Section, [f64; 2])>,
    /// By how many lattice vectors it is moved after one round, if it is closed.
    closed: Option<[f64; 2]>,
}

impl Chain {
    /// Lets a closed chain begin elsewhere.
    fn rotate(&mut self, first: usize) {
        let period = self.closed.unwrap_or_default();
        for (_, cell) in &mut self.sections[..first] {
            *cell = [0, 1].map(|k| cell[k] + period[k]);
        }
        self.sections.rotate_left(first);
        if let Some(&(_, origin)) = self.sections.first() {
            for (_, cell) in &mut self.sections {
                *cell = [0, 1].map(|k| cell[k] - origin[k]);
            }
        }
    }
}
