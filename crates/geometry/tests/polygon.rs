//! Straight sides tested eight at a time against sides asked one by one.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
mod nasty;
mod random;

use geometry::{Hit, Line, Piece, Table, Vector2, Walls, WithWalls, shapes::Segment, walls::Polygon};
use lanes::{Kernel, Lane, Mask};
use nasty::{paths, rough};
use random::Random;

/// Within how much of the size a landing is in a corner: what all walls promise.
const CORNER: f64 = 8.0 * f64::EPSILON;

/// The first hit by asking each side: of equal times the lowest number. Every `every`-th vertex is a corner.
fn brute(sides: &[Segment], every: usize, path: &Line<2>) -> Option<Hit<2>> {
    let mut first = None;
    let mut time = f64::INFINITY;
    for (i, side) in sides.iter().enumerate() {
        let t = side.crossing(path).time();
        if t < time {
            (first, time) = (Some(i), t);
        }
    }
    let piece = first?;
    let landing = sides[piece].landing(path, time);
    let corners = sides.iter().step_by(every).map(|s| s.point_at(0.0).amax());
    let near = CORNER * corners.fold(path.point.amax(), f64::max);
    let ends = [piece, (piece + 1) % sides.len()];
    let own = ends.into_iter().filter(|i| i % every == 0).map(|i| sides[i].point_at(0.0));
    let corner = own.into_iter().any(|c| (landing.point - c).amax() <= near);
    Some(Hit { time, point: landing.point, normal: landing.normal, piece, corner })
}

fn bits(hit: Option<Hit<2>>) -> Option<([u64; 5], usize, bool)> {
    hit.map(|h| {
        let [p, n] = [h.point, h.normal];
        ([h.time, p.x, p.y, n.x, n.y].map(f64::to_bits), h.piece, h.corner)
    })
}

/// All sides, with the numbers that they have in their order or in another.
fn walls(sides: &[Segment], corners: &[Vector2<f64>], order: impl Iterator<Item = usize>) -> Polygon {
    let sides: Vec<(usize, Segment)> = order.map(|i| (i, sides[i])).collect();
    Polygon::new(&sides, corners)
}

#[test]
fn eight_at_a_time_equal_one_by_one_bit_for_bit() {
    let mut random = Random(14);
    let sizes = [1.0, 1e-150, 1e150, 1e-9];
    for (k, n) in [3, 7, 8, 9, 64, 65, 250, 500, 513, 2049].into_iter().enumerate() {
        let sides = rough(n, sizes[k % 4], &mut random);
        let corners: Vec<Vector2<f64>> = sides.iter().map(|s| s.point_at(0.0)).collect();
        let in_order = walls(&sides, &corners, 0..n);
        let each = in_order.clone().without_tree();
        // every third one, as in a table with several loops; and every second vertex is none
        let mixed = walls(&sides, &corners, (0..n).step_by(3).chain((0..n).filter(|i| i % 3 != 0)));
        let half: Vec<Vector2<f64>> = corners.iter().copied().step_by(2).collect();
        let smooth = walls(&sides, &half, 0..n);
        let mut hits = 0;
        for path in paths(&sides, 2000, &mut random) {
            let expected = brute(&sides, 1, &path);
            hits += usize::from(expected.is_some());
            assert_eq!(bits(in_order.hit(&path)), bits(expected), "{n} sides, {path:?}");
            assert_eq!(bits(each.hit(&path)), bits(expected), "{n} sides without a tree, {path:?}");
            assert_eq!(bits(mixed.hit(&path)), bits(expected), "{n} sides in another order, {path:?}");
            let expected = brute(&sides, 2, &path);
            assert_eq!(bits(smooth.hit(&path)), bits(expected), "{n} sides, every second vertex smooth, {path:?}");
        }
        assert!(hits > 1000, "{hits}");
    }
}

/// First hits in lanes, against those of single paths.
struct InLanes<'a>(&'a Polygon, &'a [Line<2>]);

impl Kernel for InLanes<'_> {
    type Output = ();
    fn run<F: Lane>(self, zero: F) {
        for paths in self.1.chunks_exact(F::LANES) {
            let at = |i: usize| zero.each(|k| paths[k].point[i]);
            let to = |i: usize| zero.each(|k| paths[k].velocity[i]);
            let all = self.0.first_hit(&[at(0), at(1)], &[to(0), to(1)]);
            for (k, path) in paths.iter().enumerate() {
                let one = self.0.first_hit::<f64>(&path.point.into(), &path.velocity.into());
                assert_eq!(all.time.lane(k).to_bits(), one.time.to_bits());
                if one.time < f64::INFINITY {
                    assert_eq!(all.point.map(|p| p.lane(k).to_bits()), one.point.map(f64::to_bits));
                    assert_eq!(all.normal.map(|n| n.lane(k).to_bits()), one.normal.map(f64::to_bits));
                    assert_eq!((all.piece.lane(k), all.corner.at(k)), (one.piece, one.corner));
                }
            }
        }
    }
}

#[test]
fn lanes_have_the_bits_of_single_paths() {
    let mut random = Random(15);
    for n in [20, 3000] {
        let sides = rough(n, 1.0, &mut random);
        let corners: Vec<Vector2<f64>> = sides.iter().map(|s| s.point_at(0.0)).collect();
        lanes::dispatch(InLanes(&walls(&sides, &corners, 0..n), &paths(&sides, 4096, &mut random)));
    }
}

/// Long orbits, by reflection: nothing slips through.
struct Bounce(usize);

impl WithWalls<2> for Bounce {
    type Output = usize;
    fn run<W: Walls<2>>(self, walls: &W) -> usize {
        let mut path = Line { point: Vector2::new(0.01, 0.02), velocity: Vector2::new(0.6, 0.8) };
        for k in 0..self.0 {
            let Some(hit) = walls.hit(&path) else { return k };
            path.point = hit.point;
            path.velocity -= hit.normal * (2.0 * path.velocity.dot(&hit.normal));
        }
        self.0
    }
}

#[test]
fn no_orbit_leaves_a_table_of_many_sides_with_holes() {
    let mut random = Random(16);
    let outer = rough(2000, 1.0, &mut random);
    let hole = |center: Vector2<f64>, sides: usize| {
        let corners: Vec<Vector2<f64>> =
            rough(sides, 0.1, &mut Random(sides as u64)).iter().map(|s| s.point_at(0.0) + center).collect();
        (0..sides).rev().map(move |k| Segment::new(corners[(k + 1) % sides], corners[k]).unwrap())
    };
    let pieces = outer.into_iter().chain(hole(Vector2::new(0.4, 0.1), 100)).chain(hole(Vector2::new(-0.3, -0.4), 9));
    let table = Table::new(pieces.map(|s| Box::new(s) as Box<dyn Piece>).collect()).unwrap();
    table.validate().unwrap();
    assert_eq!(table.chains().len(), 3);
    assert_eq!(table.with_walls(Bounce(100_000)), 100_000);
}
