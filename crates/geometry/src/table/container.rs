//! Chains of pieces that one composite wall can answer for.
use super::sides::Side;
use crate::{
    Figure,
    afar::NEWTON,
    plane::slack,
    shapes::Segment,
    walls::{Capsule, ConvexPolygon, Cuboid, Hull, Rotated, Seam, Slab, Sphere, Strip, Wedge, Zonogon},
};
use nalgebra::Vector2;

/// A composite wall, with all pieces that it does not answer for, which lie inside it.
#[derive(Debug)]
pub(super) struct Enclosed {
    pub(super) container: Container,
    /// The seams, where a side consists of several pieces.
    pub(super) seams: Vec<Seam>,
    /// The numbers of the pieces inside.
    pub(super) rest: Vec<usize>,
}

/// Chains of more pieces than this are better served piece by piece.
pub(super) const MOST_SIDES: usize = 16;

/// A composite wall that encloses the particle. Those that are not a [`Hull`] have sides of one piece each, and nothing inside.
#[derive(Debug)]
pub(super) enum Container {
    Hull(Hull),
    Level(Slab<2, 1>),
    Upright(Slab<2, 0>),
    Strip(Strip),
    Hexagon(Zonogon<3>),
    Wedge(Wedge),
    Capsule(Capsule),
}

/// The wall that answers for the sides of a chain, if there is one; `alone`: nothing lies inside, and each side is one piece.
pub(super) fn container(sides: &[Side], alone: bool) -> Option<Container> {
    let figures: Vec<Figure> = sides.iter().map(|side| side.figure).collect();
    let pieces: Vec<usize> = sides.iter().map(|side| side.piece).collect();
    match figures[..] {
        [Figure::Circle { center, radius, inside: true }] => {
            return Sphere::new(center, radius, pieces[0]).ok().map(|disk| Container::Hull(Hull::Disk(disk)));
        }
        [arriving, leaving] => {
            let wedge = Wedge::new([arriving, leaving], [pieces[0], pieces[1]]);
            return wedge.ok().filter(|_| alone).map(Container::Wedge);
        }
        _ => {}
    }
    let straight: Option<Vec<Segment>> = sides.iter().map(|side| side.straight).collect();
    match straight {
        Some(sides) => polygon(&sides, &pieces, alone),
        None => capsule(&figures, &pieces, alone),
    }
}

fn polygon(sides: &[Segment], pieces: &[usize], alone: bool) -> Option<Container> {
    let hexagon = || Zonogon::numbered(sides, pieces).ok().filter(|_| alone).map(Container::Hexagon);
    let convex = || ConvexPolygon::numbered(sides, pieces).ok().map(|walls| Container::Hull(Hull::Convex(walls)));
    rectangle(sides, pieces).map(Container::Hull).or_else(hexagon).or_else(convex)
}

fn rectangle(sides: &[Segment], numbers: &[usize]) -> Option<Hull> {
    if sides.len() != 4 {
        return None;
    }
    let all: Vec<[f64; 2]> = sides.iter().map(Segment::start).collect();
    let bound = |i: usize, pick: fn(f64, f64) -> f64| all.iter().map(|p| p[i]).reduce(pick).unwrap_or(0.0);
    let (low, high) = ([bound(0, f64::min), bound(1, f64::min)], [bound(0, f64::max), bound(1, f64::max)]);
    // the walls in the order of the axes, lower before upper
    let mut pieces = [[None; 2]; 2];
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
        pieces[axis][side] = Some(numbers[k]);
    }
    let [[Some(left), Some(right)], [Some(below), Some(above)]] = pieces else { return None };
    Cuboid::new(low, high, [[left, right], [below, above]]).ok().map(Hull::Rectangle)
}

fn capsule(figures: &[Figure], numbers: &[usize], alone: bool) -> Option<Container> {
    // wherever the loop starts, in the order side, cap, side, cap
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
    if alone && axis.y == 0.0 && axis.x > 0.0 {
        return Some(Container::Capsule(capsule));
    }
    Rotated::new(capsule, axis).ok().map(|walls| Container::Hull(Hull::Capsule(walls)))
}

/// The region between two parallel lines.
pub(super) fn strip(figures: [Figure; 2], [i, j]: [usize; 2]) -> Option<Container> {
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
                Slab::new(low, high, pieces).ok().map(Container::Level)
            } else {
                Slab::new(low, high, pieces).ok().map(Container::Upright)
            };
        }
    }
    Strip::new(figures, [i, j]).ok().map(Container::Strip)
}
