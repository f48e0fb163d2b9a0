//! Between which of the walls that meet at a point a path leads away from there.

use core::f64::consts::PI;

use billiards::geometry::{Piece, Vector2};

/// Directions that differ by less than this (radians) are those of walls that touch or coincide.
const TOUCHING: f64 = 1e-8;

/// Curvatures whose relative difference is no more than this are equal.
const ALIKE: f64 = 1e-6;

/// A wall that leaves a point, as seen along a path from there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    piece: usize,
    /// The angle from the velocity to the wall, counter-clockwise, from −π to π.
    angle: f64,
    /// The curvature [L⁻¹], positive where the wall bends to the left.
    bend: f64,
    /// Whether the table lies on its left, and whether on its other side, too.
    left: bool,
    double: bool,
    /// Whether the piece ends at the point.
    is_end: bool,
}

impl Ray {
    /// The angle from the path to the wall \[rad\], from 0 to 2π, and the curvature away from the path, if one looks to its `left` or right.
    fn seen(&self, left: bool) -> (f64, f64) {
        let sign = if left { 1.0 } else { -1.0 };
        let (angle, bend) = (sign * self.angle, sign * self.bend);
        (if angle > 0.0 || angle == 0.0 && bend > 0.0 { angle } else { angle + 2.0 * PI }, bend)
    }

    /// Whether the path leads along the wall, to the last bit.
    fn is_along(&self) -> bool {
        self.angle == 0.0
    }
}

/// How a piece leaves a point that lies on it, as seen along a path with this velocity; `is_there` tells whether an end of the piece is
/// that point.
pub(super) fn rays(
    (number, piece): (usize, &dyn Piece),
    point: &Vector2<f64>,
    velocity: &Vector2<f64>,
    is_there: impl Fn(&Vector2<f64>) -> bool,
) -> Vec<Ray> {
    let here = piece.closest(point);
    let (curvature, double) = (piece.curvature(&here.point), piece.has_two_sides());
    let ray = |along: Vector2<f64>, left: bool, is_end: bool| {
        let angle = libm::atan2(velocity.perp(&along), velocity.dot(&along));
        Ray { piece: number, angle, bend: if left { curvature } else { -curvature }, left, double, is_end }
    };
    // a piece has the table on its left
    let forward = |normal: Vector2<f64>| Vector2::new(normal.y, -normal.x);
    let along = forward(here.normal);
    if let Some([a, b]) = piece.tips() {
        let ends = if is_there(&a) {
            vec![b - a]
        } else if is_there(&b) {
            vec![a - b]
        } else {
            vec![]
        };
        let leaving = if ends.is_empty() { vec![along, -along] } else { ends.clone() };
        let both = |along| [ray(along, true, !ends.is_empty()), ray(along, false, !ends.is_empty())];
        return leaving.into_iter().flat_map(both).collect();
    }
    match piece.ends().map(|ends| ends.map(|end| is_there(&end))) {
        Some([true, true]) => {
            let [first, last] = [0.0, piece.length()].map(|s| forward(piece.landing_at(s).normal));
            vec![ray(first, true, true), ray(-last, false, true)]
        }
        Some([true, false]) => vec![ray(along, true, true)],
        Some([false, true]) => vec![ray(-along, false, true)],
        _ => vec![ray(along, true, false), ray(-along, false, false)],
    }
}

/// The piece behind which a path leads, or along which it runs; `None` if it leads into the table.
pub(super) fn in_the_way(rays: &[Ray]) -> Option<usize> {
    if let Some(ray) = rays.iter().find(|ray| ray.is_along() && ray.bend == 0.0) {
        return Some(ray.piece);
    }
    let bounds = [true, false].into_iter().filter_map(|left| bound(rays, left));
    let behind = bounds.filter_map(|(angle, piece)| Some((angle, piece?)));
    behind.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, piece)| piece)
}

/// Whether a path may seem to hit one of these walls at once although it leads into the table: past the end of a piece, or along one.
pub(super) fn may_be_hit_at_once(rays: &[Ray]) -> bool {
    rays.iter().any(|ray| ray.is_end || ray.is_along())
}

/// The angle from a path to the first wall on its left or on its right, and the piece if the path is behind that.
fn bound(rays: &[Ray], left: bool) -> Option<(f64, Option<usize>)> {
    let first = rays.iter().map(|ray| ray.seen(left).0).reduce(f64::min)?;
    // of walls that touch, the first one bends most towards the path
    let touching = || rays.iter().filter(|ray| ray.seen(left).0 <= first + TOUCHING);
    let nearest = touching().min_by(|a, b| a.seen(left).1.total_cmp(&b.seen(left).1))?;
    let same = |ray: &&Ray| (ray.bend - nearest.bend).abs() <= ALIKE * (ray.bend.abs() + nearest.bend.abs());
    // of a wall with two sides, one faces the path
    let faces = |ray: &Ray| ray.left != left;
    let is_free = faces(nearest) || nearest.double && touching().filter(same).any(|ray| ray.double && faces(ray));
    Some((first, (!is_free).then_some(nearest.piece)))
}
