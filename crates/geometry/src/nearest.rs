//! Which of several pieces is nearest to a point, and so determines on which side of the boundary the point lies.
use crate::{Landing, Piece, plane::slack};
use core::mem::replace;
use nalgebra::Vector2;

/// Distances whose relative difference is no more than this are equal up to rounding.
const SAME: f64 = 1e-12;

/// Curvatures of curves given by formulas, and of parallels, are correct to ten digits or more; no two that are meant to differ are
/// as close as this relative difference.
pub(crate) const ALIKE: f64 = 1e-6;

/// The sides of a tip are compared at this fraction of their lengths from it: far enough for those of a flat cusp to be apart.
const AWAY: f64 = 0.125;

/// Whether two distances, or squares of them, are equal up to rounding.
fn equal(a: f64, b: f64) -> bool {
    a <= b * (1.0 + SAME) && b <= a * (1.0 + SAME)
}

/// A piece, seen from a point.
struct Foot<'a> {
    number: usize,
    piece: &'a dyn Piece,
    landing: Landing,
    /// Square of the distance.
    square: f64,
    /// How far the point lies on the table's side of the tangent at the foot.
    height: f64,
}

impl<'a> Foot<'a> {
    fn new((number, piece): (usize, &'a dyn Piece), point: &Vector2<f64>) -> Foot<'a> {
        let landing = piece.closest(point);
        let off = point - landing.point;
        Foot { number, piece, landing, square: off.norm_squared(), height: landing.normal.dot(&off) }
    }

    /// Whether this piece rather than the other one decides on which side the point lies.
    fn decides_before(&self, other: &Foot) -> bool {
        if !equal(self.square, other.square) {
            return self.square < other.square;
        }
        let [own, its] = [self.height.abs(), other.height.abs()];
        let alike = (own - its).abs() <= SAME * self.square.sqrt();
        if alike && (self.height < 0.0) != (other.height < 0.0) {
            return self.lies_before(other);
        }
        // at a shared vertex the piece that the point faces decides
        own > its
    }

    /// Whether this piece lies between the point and another piece that touches it at the common foot and has the table on its other
    /// side.
    fn lies_before(&self, other: &Foot) -> bool {
        // the piece that bends more towards the point is nearer to all other points around it
        let [own, its] = [self, other].map(|foot| {
            let curvature = foot.piece.curvature(&foot.landing.point);
            if foot.height < 0.0 { -curvature } else { curvature }
        });
        if (own - its).abs() <= ALIKE * (own.abs() + its.abs()) {
            // two sides of one wall, with the table on both
            return self.height > other.height;
        }
        own > its
    }

    /// Whether both pieces end at the common foot in a tip that points straight at the point, so that both are seen edge on.
    fn shares_a_tip_with(&self, other: &Foot) -> bool {
        let is_edge_on = |foot: &Foot| foot.height.abs() <= SAME * foot.square.sqrt();
        self.square > 0.0 && equal(self.square, other.square) && is_edge_on(self) && is_edge_on(other)
    }

    /// Of two pieces that end in one tip: whether the table lies between them, as in a cusp, and not around them.
    fn has_table_before(&self, other: &Foot) -> bool {
        let Some([start, end]) = self.piece.ends() else { return false };
        let step = AWAY * self.piece.length().min(other.piece.length());
        let [to_start, to_end] = [start, end].map(|vertex| (vertex - self.landing.point).norm_squared());
        let at = self.piece.point_at(if to_start <= to_end { step } else { self.piece.length() - step });
        let foot = other.piece.closest(&at);
        (at - foot.point).dot(&foot.normal) > slack([other.piece.extent().size()])
    }
}

/// The nearest of some pieces.
pub(crate) struct Nearest {
    pub(crate) number: usize,
    /// Its closest point, and the inward normal there.
    pub(crate) landing: Landing,
    /// Whether the point lies behind it, where no table is.
    pub(crate) is_outside: bool,
}

/// The nearest of some pieces, and on which side of the boundary that they form the point lies, even where several are equally near.
pub(crate) fn nearest_of<'a>(
    pieces: impl Iterator<Item = (usize, &'a dyn Piece)>,
    point: &Vector2<f64>,
) -> Option<Nearest> {
    let mut feet = pieces.map(|piece| Foot::new(piece, point));
    let mut best = feet.next()?;
    let mut opposite: Option<Foot> = None;
    for foot in feet {
        let rest = if foot.decides_before(&best) { replace(&mut best, foot) } else { foot };
        opposite = [Some(rest), opposite].into_iter().flatten().find(|other| best.shares_a_tip_with(other));
    }
    let is_outside = match &opposite {
        Some(other) => best.has_table_before(other),
        None => best.height < 0.0,
    };
    Some(Nearest { number: best.number, landing: best.landing, is_outside })
}

#[cfg(test)]
mod tests {
    use crate::{
        Outline, Piece, Table, Vector2,
        shapes::{Arc, Circle, Ellipse},
    };

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }
    fn circle(center: [f64; 2], radius: f64, inside: bool) -> Box<dyn Piece> {
        Box::new(Circle::new(center.into(), radius, inside).unwrap())
    }
    fn polygon(vertices: &[[f64; 2]]) -> Vec<Box<dyn Piece>> {
        let start = Outline::from(vertices[0].into());
        let ends = vertices[1..].iter().chain([&vertices[0]]);
        ends.fold(start, |outline, &end| outline.line_to(end.into()).unwrap()).close().unwrap()
    }
    fn table(pieces: Vec<Box<dyn Piece>>) -> Table {
        Table::new(pieces).unwrap()
    }

    #[test]
    fn behind_walls_that_touch_lies_no_table() {
        // whichever of the walls comes first
        for first in [0, 1] {
            let order = |mut pieces: Vec<Box<dyn Piece>>| {
                pieces.rotate_left(first);
                table(pieces)
            };
            let mut room = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
            room.push(circle([0.5, 0.5], 0.5, false));
            let room = order(room);
            for at in [v(0.5, 0.25), v(0.75, 0.5), v(0.25, 0.5), v(0.5, 0.75), v(0.5, 0.5)] {
                assert!(!room.contains(&at), "{at}");
            }
            assert!(room.contains(&v(0.05, 0.05)));
            let pipe = order(vec![circle([0.0; 2], 2.0, true), circle([1.0, 0.0], 1.0, false)]);
            for x in [0.25, 1.0, 1.2, 1.5, 1.999] {
                assert!(!pipe.contains(&v(x, 0.0)), "{x}");
                assert!(pipe.contains(&v(-x, 0.0)), "{x}");
            }
            // two obstacles, and an ellipse with curvature 2 in a circle with 1
            let two = order(vec![circle([0.0; 2], 1.0, false), circle([2.0, 0.0], 1.0, false)]);
            for x in [0.2, 0.9, 1.1, 1.8] {
                assert!(!two.contains(&v(x, 0.0)), "{x}");
            }
            let ellipse = Box::new(Ellipse::new(v(0.5, 0.0), [0.5, 0.5], 0.0, false).unwrap());
            let oval = order(vec![circle([0.0; 2], 1.0, true), ellipse]);
            assert!(!oval.contains(&v(0.75, 0.0)) && oval.contains(&v(-0.5, 0.0)));
        }
    }

    #[test]
    fn both_sides_of_a_slit_are_table() {
        let (a, b) = (v(1.0, 0.5), v(0.5, 0.5));
        for bulge in [false, true] {
            // straight, and around (0.75, 0)
            let mut pieces = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
            let side = |a, b| polygon(&[[0.0; 2], a, b]).swap_remove(1);
            pieces.splice(1..2, [side([1.0, 0.0], [1.0, 0.5]), side([1.0, 0.5], [1.0, 1.0])]);
            let arc = |a, b, inside| Box::new(Arc::new(v(0.75, 0.0), a, b, inside).unwrap()) as Box<dyn Piece>;
            pieces.splice(
                2..2,
                if bulge {
                    [arc(a, b, true), arc(b, a, false)]
                } else {
                    [side(a.into(), b.into()), side(b.into(), a.into())]
                },
            );
            let slit = table(pieces);
            assert_eq!(slit.validate(), Ok(()));
            for y in [0.3, 0.45, 0.6, 0.7] {
                assert!(slit.contains(&v(0.75, y)), "{y}");
                assert!(!slit.contains(&v(1.25, y)), "{y}");
            }
        }
    }

    #[test]
    fn straight_ahead_of_a_tip_lies_table_unless_the_tip_is_one_of_the_table() {
        let turned = |p: Vector2<f64>, k: u32| {
            let (sin, cos) = libm::sincos(0.7 * f64::from(k));
            v(0.3, -0.2) + v(cos * p.x - sin * p.y, sin * p.x + cos * p.y)
        };
        // a star of four arcs, the table around it or in it, and a wall without thickness
        let star = |k: u32, inside: bool| {
            let at = |x: f64, y: f64| turned(v(x, y), k);
            let tips = [at(1.0, 0.0), at(0.0, 1.0), at(-1.0, 0.0), at(0.0, -1.0)];
            let centers = [at(1.0, 1.0), at(-1.0, 1.0), at(-1.0, -1.0), at(1.0, -1.0)];
            let arc = |i: usize| {
                let ends = [tips[i], tips[(i + 1) % 4]];
                let [a, b] = if inside { ends } else { [ends[1], ends[0]] };
                Box::new(Arc::new(centers[i], a, b, !inside).unwrap()) as Box<dyn Piece>
            };
            (0..4).map(arc).collect::<Vec<_>>()
        };
        let wall = |k: u32| polygon(&[[-1.0, 0.0], [1.0, 0.0]].map(|p| turned(p.into(), k).into()));
        for k in 0..200 {
            for far in [1e-9, 0.1, 0.5, 3.0] {
                for aside in [0.0, 1e-16, -1e-16, 1e-14, -1e-14] {
                    let at = turned(v(1.0 + far, far * aside), k);
                    assert!(table(star(k, false)).contains(&at), "{k} {far} {aside}");
                    assert!(!table(star(k, true)).contains(&at), "{k} {far} {aside}");
                    assert!(table(wall(k)).contains(&at), "{k} {far} {aside}");
                }
            }
        }
    }
}
