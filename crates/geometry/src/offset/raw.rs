//! All pieces moved inwards, before they are cut and selected.
use super::{
    Origin,
    moved::{Moved, Part},
    swallowtail::{ParallelOf, SelfCrossing},
    tips::Tips,
    tolerances,
    vertices::{Site, Vertices, minus},
};
use crate::{
    Error, Figure, Piece, Table,
    joints::{Joint, joints},
    piece::rounding,
    plane::{GOLDEN_SECTION, is_finite, slack},
    shapes::{self, Parallel, curve::rising_root},
};
use nalgebra::Vector2;
use std::sync::Arc;

/// A corner that turns by less than this (radians) is smooth: the vertex moves along the mean normal, and the distance
/// `R` is off by `R` times an eighth of the square, which is rounding.
const SMOOTH: f64 = 2e-7;

/// A convex corner also counts as smooth where the moved sides reach beyond each other by no more than this many times the rounding of
/// coordinates, since the sides are then parallel within rounding.
const SHALLOW: f64 = 4.0;

/// A re-entrant corner also counts as smooth where the arc about it is no longer than this many times the tolerance within which points
/// computed twice agree: anything this short is not a piece.
const SHORT: f64 = 4.0;

/// The moved pieces, and their ends as vertices.
#[derive(Debug)]
pub(super) struct RawBoundary {
    pub(super) pieces: Vec<Moved>,
    pub(super) vertices: Vertices,
}

/// The moved ends of a piece.
type Ends = [Option<(Vector2<f64>, Site)>; 2];

pub(super) fn raw(table: &Table, radius: f64) -> Result<RawBoundary, Error> {
    let mut vertices = Vertices::new(table.shortest());
    let mut pieces: Vec<Moved> = vec![];
    let mut ends: Vec<Ends> = vec![[None; 2]; table.pieces().len()];
    let tolerance = tolerances::general(table, radius);
    for joint in joints(table) {
        if let Some(arc) = turn(table, radius, &joint, tolerance, &mut vertices, &mut ends)? {
            pieces.push(arc);
        }
    }
    let mut tips = Tips::default();
    for (i, piece) in table.pieces().iter().enumerate() {
        if let Some(ends) = piece.tips() {
            tips.faces(ends, i, radius, &mut vertices, &mut pieces)?;
            continue;
        }
        // ends without a neighbour to share them, or at a convex corner
        for (k, end) in piece.ends().into_iter().flatten().enumerate() {
            if ends[i][k].is_none() && is_finite(&end) {
                let moved = end + piece.closest(&end).normal * radius;
                ends[i][k] = Some((moved, vertices.add(moved)));
            }
        }
        if piece.figure() == Figure::Other {
            parallels(piece, i, radius, ends[i], tolerance, &mut vertices, &mut pieces)?;
        } else if let Some(moved) = shifted(&**piece, radius, ends[i].map(|e| e.map(|(p, _)| p)))? {
            pieces.push(Moved {
                piece: moved,
                origin: Origin::Piece(i),
                ends: ends[i].map(|e| e.map(|(_, site)| site)),
                part: None,
            });
        }
    }
    tips.arcs(radius, &mut pieces)?;
    Ok(RawBoundary { pieces, vertices })
}

/// Moves a corner: it becomes a shared vertex where the boundary is smooth, and an arc where it is re-entrant. Points that are computed
/// twice may differ by the tolerance \[L\].
fn turn(
    table: &Table,
    radius: f64,
    joint: &Joint,
    tolerance: f64,
    vertices: &mut Vertices,
    ends: &mut [Ends],
) -> Result<Option<Moved>, Error> {
    let &Joint { before, after, cell, vertex } = joint;
    let [p, q] = [before, after].map(|i| &table.pieces()[i]);
    let there = vertex - vertices.translation(cell);
    let (n, m) = (p.closest(&vertex).normal, q.closest(&there).normal);
    let angle = joint.turn(table);
    let shift = vertices.translation(cell);
    let of_arcs = rounding(&**p).max(rounding(&**q));
    let shallow = if angle > 0.0 {
        let rounding = slack([p.extent().size(), q.extent().size(), radius]).max(of_arcs);
        0.5 * radius * angle * angle <= SHALLOW * rounding
    } else {
        -radius * angle <= SHORT * tolerance.max(4.0 * of_arcs)
    };
    if angle.abs() <= SMOOTH || shallow {
        let point = vertex + (n + m) * (radius / (n + m).norm());
        let site = vertices.add(point);
        ends[before][1] = Some((point, site));
        ends[after][0] = Some((point - shift, site.moved(minus(cell))));
        return Ok(None);
    }
    if angle > 0.0 {
        return Ok(None);
    }
    let (a, b) = (vertex + n * radius, vertex + m * radius);
    let (from, to) = (vertices.add(a), vertices.add(b));
    ends[before][1] = Some((a, from));
    ends[after][0] = Some((b - shift, to.moved(minus(cell))));
    if a == b {
        return Ok(None); // the disk is smaller than rounding
    }
    Ok(Some(Moved {
        piece: Arc::new(shapes::Arc::with_radius(vertex, radius, a, b, false)?),
        origin: Origin::Corner { before, after },
        ends: [Some(from), Some(to)],
        part: None,
    }))
}

/// A piece of known figure, moved; `None` where it shrinks to nothing.
fn shifted(piece: &dyn Piece, radius: f64, ends: [Option<Vector2<f64>>; 2]) -> Result<Option<Arc<dyn Piece>>, Error> {
    let left = |d: Vector2<f64>| Vector2::new(-d.y, d.x);
    // a focusing arc whose radius equals that of the disk, up to rounding, becomes a point
    let reduced = |r: f64, inside: bool, center: Vector2<f64>| {
        let moved = if inside { r - radius } else { r + radius };
        (moved > slack([center.x, center.y, r])).then_some(moved)
    };
    Ok(match (piece.figure(), ends) {
        (Figure::Segment { ends: [start, _] }, [Some(a), Some(b)]) if a != b => {
            Some(Arc::new(shapes::Segment::of_line(a, b, piece.closest(&start).normal.into())?))
        }
        (Figure::Ray { from, direction, left: is_left }, _) => {
            let n = if is_left { left(direction) } else { -left(direction) };
            Some(Arc::new(shapes::Ray::new(from + n * radius, direction, is_left)?))
        }
        (Figure::Line { through, direction }, _) => {
            Some(Arc::new(shapes::FullLine::new(through + left(direction) * radius, direction)?))
        }
        (Figure::Arc { center, radius: r, inside, .. }, [Some(a), Some(b)]) if a != b => {
            match reduced(r, inside, center) {
                Some(moved) => Some(Arc::new(shapes::Arc::with_radius(center, moved, a, b, inside)?)),
                None => None,
            }
        }
        (Figure::Circle { center, radius: r, inside }, _) => match reduced(r, inside, center) {
            Some(moved) => Some(Arc::new(shapes::Circle::new(center, moved, inside)?)),
            None => None,
        },
        _ => None,
    })
}

/// Number of places where the curvature is evaluated, and of parts of a regular curve (so that a curve that meets itself is cut).
const PLACES: usize = 256;
const PARTS: usize = 4;

/// Places along a curve, with the value of a function there, in order: so dense that its sign usually changes at most once between
/// neighbours. Where the function comes near 0 and turns back, its extremum is sought and added if it lies beyond 0.
fn places(length: f64, function: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let at = |k: usize| length * (k as f64 / PLACES as f64);
    let even: Vec<_> = (0..=PLACES).map(|k| (at(k), function(at(k)))).collect();
    let mut places = even.clone();
    for (k, &(_, value)) in even.iter().enumerate() {
        let [(low, before), (high, after)] = [even[k.saturating_sub(1)], even[(k + 1).min(PLACES)]];
        let sign = if value > 0.0 { 1.0 } else { -1.0 };
        let fall = [before, after].map(|other| sign * (other - value));
        let turns = fall[0] >= 0.0 && fall[1] >= 0.0;
        // the parabola through the three values exceeds the middle one by no more than their differences
        if turns
            && sign * value < 4.0 * (fall[0] + fall[1])
            && let Some(found) = beyond_zero(|s| sign * function(s), low, high)
        {
            places.push((found, function(found)));
        }
    }
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    places
}

/// A place where a function that falls and rises again is not positive, if there is one, by golden-section search towards its minimum.
fn beyond_zero(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> Option<f64> {
    let [mut a, mut b] = [low + GOLDEN_SECTION * (high - low), high - GOLDEN_SECTION * (high - low)];
    let [mut at_a, mut at_b] = [function(a), function(b)];
    // to the square root of rounding: a minimum cannot be located more closely
    for _ in 0..40 {
        if at_a <= 0.0 {
            return Some(a);
        }
        if at_b <= 0.0 {
            return Some(b);
        }
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = low + GOLDEN_SECTION * (high - low);
            at_a = function(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = high - GOLDEN_SECTION * (high - low);
            at_b = function(b);
        }
    }
    None
}

/// The ranges of a curve in which a function is positive, in order.
fn positive(length: f64, function: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let root = |low: f64, high: f64, sign: f64| rising_root(|s| [sign * function(s), 0.0], [low, high]);
    let mut ranges: Vec<[f64; 2]> = vec![];
    let mut from = (function(0.0) > 0.0).then_some(0.0);
    for w in places(length, &function).windows(2) {
        let [(low, _), (high, there)] = [w[0], w[1]];
        let is_positive = there > 0.0;
        match from {
            None if is_positive => from = Some(root(low, high, 1.0)),
            Some(start) if !is_positive => {
                ranges.push([start, root(low, high, -1.0)]);
                from = None;
            }
            _ => {}
        }
    }
    ranges.extend(from.map(|start| [start, length]));
    ranges
}

/// The ranges in which the parallel of a curve is regular, between its cusps (where it meets centres of curvature of the curve), each with
/// the vertices that are known at its ends. Points that are computed twice may differ by the tolerance \[L\].
fn regular(parallel: &ParallelOf, ends: Ends, tolerance: f64, vertices: &mut Vertices) -> (Vec<[f64; 2]>, Vec<Ends>) {
    let length = parallel.base.length();
    let is_closed = parallel.base.ends().is_none();
    let seam = is_closed.then(|| {
        let point = parallel.point(0.0);
        (point, vertices.add(point))
    });
    let mut ranges = positive(length, |s| parallel.stretch(s));
    let at_end = |s: f64, k: usize| if s == [0.0, length][k] { seam.or(ends[k]) } else { None };
    let mut known: Vec<Ends> = ranges.iter().map(|range| [0, 1].map(|k| at_end(range[k], k))).collect();
    let count = ranges.len();
    for (k, next) in (0..count).map(|k| (k, (k + 1) % count)).filter(|(_, next)| is_closed || *next > 0) {
        if known[k][1].is_none()
            && known[next][0].is_none()
            && let Some(SelfCrossing { at: [s, t], point }) = parallel.tail([ranges[k][1], ranges[next][0]], tolerance)
            && ranges[k][0] < s
            && t < ranges[next][1]
        {
            let vertex = Some((point, vertices.add(point)));
            (ranges[k][1], known[k][1]) = (s, vertex);
            (ranges[next][0], known[next][0]) = (t, vertex);
        }
    }
    (ranges, known)
}

/// The regular parts of the parallel of a curve.
fn parallels(
    base: &Arc<dyn Piece>,
    number: usize,
    radius: f64,
    ends: Ends,
    tolerance: f64,
    vertices: &mut Vertices,
    pieces: &mut Vec<Moved>,
) -> Result<(), Error> {
    let length = base.length();
    if !length.is_finite() {
        return Err(Error::Parameter { name: "length", must: "finite for a curved piece to be offset", value: length });
    }
    let parallel = ParallelOf { base: &**base, distance: radius };
    let (ranges, known) = regular(&parallel, ends, tolerance, vertices);
    for ([low, high], [first, last]) in ranges.into_iter().zip(known) {
        let curve = pieces.len();
        // the place may not be right above the end: next to a corner that counts as smooth, the normal is not the mean one
        let short = 0.25 * (high - low);
        let from = first.map_or(low, |(place, _)| low + parallel.ahead(low, place).clamp(0.0, short));
        let to = last.map_or(high, |(place, _)| high + parallel.ahead(high, place).clamp(-short, 0.0));
        let cuts = (1..PARTS).map(|k| from + (to - from) * (k as f64 / PARTS as f64));
        let mut vertex = |s: f64, known: Option<(Vector2<f64>, Site)>| {
            known.unwrap_or_else(|| {
                let point = parallel.point(s);
                (point, vertices.add(point))
            })
        };
        let mut start = (from, vertex(from, first));
        for s in cuts.chain([to]) {
            let end = (s, vertex(s, if s == to { last } else { None }));
            let parallel =
                Parallel::new(base.clone(), radius, [start.0, s], Some([start.1.0, end.1.0])).map_err(|error| {
                    if let Error::Kink { at } = error { Error::RoughPiece { piece: number, at } } else { error }
                })?;
            pieces.push(Moved {
                piece: Arc::new(parallel.clone()),
                origin: Origin::Piece(number),
                ends: [Some(start.1.1), Some(end.1.1)],
                part: Some(Part { parallel, curve }),
            });
            start = end;
        }
    }
    Ok(())
}
