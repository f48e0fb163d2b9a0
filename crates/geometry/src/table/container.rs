//! Chains of pieces that one composite wall can answer for.
use super::sides::Side;
use crate::{
    Figure,
    afar::NEWTON,
    plane::slack,
    shapes::Segment,
    walls::{Capsule, ConvexPolygon, Cuboid, Hull, Rotated, Seam, Slab, Sphere, Wedge, Zonogon},
};
use nalgebra::Vector2;

/// A composite wall with all pieces that it does not answer for, which lie inside.
#[derive(Debug)]
pub(super) struct Enclosed {
    pub(super) hull: Hull,
    /// Where its sides are several pieces.
    pub(super) seams: Vec<Seam>,
    /// The numbers of the pieces inside.
    pub(super) rest: Vec<usize>,
}

/// Chains of more pieces than this are better served piece by piece.
pub(super) const MOST_SIDES: usize = 16;

/// The wall that answers for the sides of a chain, if there is one.
pub(super) fn hull(sides: &[Side]) -> Option<Hull> {
    let figures: Vec<Figure> = sides.iter().map(|side| side.figure).collect();
    let pieces: Vec<usize> = sides.iter().map(|side| side.piece).collect();
    match figures[..] {
        [Figure::Circle { center, radius, inside: true }] => {
            return Sphere::new(center, radius, pieces[0]).ok().map(Hull::Disk);
        }
        [arriving, leaving] => {
            return Wedge::new([arriving, leaving], [pieces[0], pieces[1]]).ok().map(Hull::Wedge);
        }
        _ => {}
    }
    let straight: Option<Vec<Segment>> = sides.iter().map(|side| side.straight).collect();
    match straight {
        Some(sides) => polygon(&sides, &pieces),
        None => capsule(&figures, &pieces),
    }
}

fn polygon(sides: &[Segment], pieces: &[usize]) -> Option<Hull> {
    rectangle(sides, pieces)
        .or_else(|| Zonogon::numbered(sides, pieces).ok().map(Hull::Hexagon))
        .or_else(|| ConvexPolygon::numbered(sides, pieces).ok().map(Hull::Convex))
}

fn rectangle(sides: &[Segment], numbers: &[usize]) -> Option<Hull> {
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
        // the table lies between them
        let side = usize::from(n[axis] < 0.0);
        if s.start()[axis] != [low, high][side][axis] {
            return None;
        }
        pieces[axis][side] = numbers[k];
    }
    if pieces.iter().flatten().any(|&p| p == usize::MAX) {
        return None;
    }
    Cuboid::new(low, high, pieces).ok().map(Hull::Rectangle)
}

fn capsule(figures: &[Figure], numbers: &[usize]) -> Option<Hull> {
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
    let slack = slack([a, b, c, d].iter().flatten().copied());
    let near = |p: Vector2<f64>, q: Vector2<f64>| (p - q).amax() <= slack;
    let axis = head - tail;
    let length = libm::hypot(axis.x, axis.y);
    let across = Vector2::new(axis.y, -axis.x) * (radius / length);
    let fits = radius > length * NEWTON
        && (radius - r2).abs() <= slack
        && near(a, tail + across)
        && near(b, head + across)
        && near(c, head - across)
        && near(d, tail - across)
        && b == b1
        && c == c0
        && d == d1
        && a == a1;
    let pieces = [0, 1, 2, 3].map(|i| numbers[(k + i) % 4]);
    if !fits {
        return None;
    }
    let capsule = Capsule::new((head + tail) * 0.5, 0.5 * length, radius, pieces).ok()?;
    if axis.y == 0.0 && axis.x > 0.0 {
        return Some(Hull::Capsule(capsule));
    }
    Rotated::new(capsule, axis).ok().map(Hull::RotatedCapsule)
}

/// The room between two parallel lines along an axis.
pub(super) fn slab(figures: [Figure; 2], [i, j]: [usize; 2]) -> Option<Hull> {
    let [Figure::Line { through: p, direction: d }, Figure::Line { through: q, direction: e }] = figures else {
        return None;
    };
    for axis in 0..2 {
        let across = 1 - axis;
        // along the axis `across`, opposite to one another; the table on the left of each
        if d[axis] == 0.0 && e[axis] == 0.0 && d[across] == -e[across] {
            let first_is_low = if axis == 1 { d.x > 0.0 } else { d.y < 0.0 };
            let (low, high, pieces) =
                if first_is_low { (p[axis], q[axis], [i, j]) } else { (q[axis], p[axis], [j, i]) };
            return if axis == 1 {
                Slab::new(low, high, pieces).ok().map(Hull::Level)
            } else {
                Slab::new(low, high, pieces).ok().map(Hull::Upright)
            };
        }
    }
    None
}
