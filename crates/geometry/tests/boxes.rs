//! The tree of boxes over very many pieces.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
mod nasty;
mod random;

use core::f64::consts::PI;
use geometry::{
    BoxTree, Crossing, Extent, Landing, Line, Piece, Vector2, Vector3,
    shapes::{Arc, Circle, FullLine},
};
use nasty::{paths, rough};
use random::Random;

/// The first piece by asking each: of equal times the lowest number.
fn brute(pieces: &[impl Piece], path: &Line<2>) -> Option<(usize, u64)> {
    let mut first = None;
    let mut soonest = f64::INFINITY;
    for (i, piece) in pieces.iter().enumerate() {
        let time = piece.crossing(path).time();
        if time < soonest {
            (first, soonest) = (Some(i), time);
        }
    }
    first.map(|i| (i, soonest.to_bits()))
}
fn bits(found: Option<(usize, f64)>) -> Option<(usize, u64)> {
    found.map(|(i, time)| (i, time.to_bits()))
}

#[test]
fn the_tree_equals_asking_every_piece_bit_for_bit() {
    let mut random = Random(4);
    for (n, size) in [(1, 1.0), (8, 1e150), (9, 1.0), (40, 1e-150), (64, 1.0), (65, 1e-12), (333, 1.0), (2049, 1e100)] {
        let pieces = rough(n.max(3), size, &mut random);
        let pieces = &pieces[..n];
        let tree = BoxTree::new(pieces.iter().map(Piece::extent));
        for path in paths(pieces, 2000, &mut random) {
            let found = tree.first(&path, |i| pieces[i].crossing(&path));
            assert_eq!(bits(found), brute(pieces, &path), "{n} pieces of size {size:e}, {path:?}");
        }
    }
}

#[test]
fn no_path_is_lost() {
    // inside a closed polygon something is always hit: 10⁵ bounces, and from each wall a path aimed at a vertex, seen or
    // not. (What starts at a vertex itself is in a corner, and no business of the tree.)
    let mut random = Random(5);
    let pieces = rough(2000, 1.0, &mut random);
    let tree = BoxTree::new(pieces.iter().map(Piece::extent));
    let ask = |path: &Line<2>| tree.first(path, |i| pieces[i].crossing(path));
    let mut path = Line { point: Vector2::zeros(), velocity: Vector2::new(0.6, 0.8) };
    for k in 0..100_000 {
        let (i, time) = ask(&path).unwrap_or_else(|| panic!("lost bounce {k}: {path:?}"));
        let Landing { point, normal } = pieces[i].landing(&path, time);
        let aimed = Line { point, velocity: pieces[random.below(2000)].point_at(0.0) - point };
        // (not along the wall just hit, to its own end)
        if aimed.velocity.dot(&normal) > 1e-9 {
            assert!(ask(&aimed).is_some(), "lost at a vertex, bounce {k}: {aimed:?}");
        }
        path = Line { point, velocity: path.velocity - normal * (2.0 * path.velocity.dot(&normal)) };
    }
}

#[test]
fn infinite_and_curved_pieces_are_found_too() {
    let floor = FullLine::new(Vector2::zeros(), Vector2::x()).unwrap();
    let mut pieces: Vec<Box<dyn Piece>> = vec![Box::new(floor)];
    let mut random = Random(6);
    for k in 0..300 {
        let center = Vector2::new(f64::from(k % 20), 1.0 + f64::from(k / 20));
        if k % 2 == 0 {
            pieces.push(Box::new(Circle::new(center, 0.2, false).unwrap()));
        } else {
            let [a, b] = [Vector2::x(), -Vector2::x()].map(|d| center + d * 0.25);
            pieces.push(Box::new(Arc::new(center, a, b, false).unwrap()));
        }
    }
    let tree = BoxTree::new(pieces.iter().map(|p| p.extent()));
    for _ in 0..3000 {
        let angle = random.between(0.0, 2.0 * PI);
        let point = Vector2::new(random.between(0.0, 20.0), random.between(0.0, 16.0));
        let path = Line { point, velocity: Vector2::new(libm::cos(angle), libm::sin(angle)) };
        let found = tree.first(&path, |i| pieces[i].crossing(&path));
        let times: Vec<f64> = pieces.iter().map(|piece| piece.crossing(&path).time()).collect();
        let soonest = times.iter().copied().fold(f64::INFINITY, f64::min);
        let first = times.iter().position(|&t| t == soonest && t < f64::INFINITY);
        assert_eq!(bits(found), first.map(|i| (i, soonest.to_bits())));
    }
}

#[test]
fn in_space_the_first_ball_is_found_among_thousands() {
    let mut random = Random(8);
    let mut anywhere = || Vector3::from_fn(|_, _| random.between(-1.0, 1.0));
    let balls: Vec<Vector3<f64>> = (0..3000).map(|_| anywhere()).collect();
    let radius = 0.02;
    let tree = BoxTree::new(balls.iter().map(|c| Extent { min: c.add_scalar(-radius), max: c.add_scalar(radius) }));
    let mut hits = 0;
    for _ in 0..2000 {
        let path = Line { point: anywhere(), velocity: anywhere() };
        // where the path comes nearest to the middle, if it comes into the ball
        let crossing = |i: usize| {
            let to = balls[i] - path.point;
            let (num, den) = (to.dot(&path.velocity), path.velocity.norm_squared());
            let inside = (to * den - path.velocity * num).norm() < radius * den && num > 0.0;
            if inside { Crossing { num, den } } else { Crossing::NEVER }
        };
        let brute = (0..balls.len()).map(|i| (i, crossing(i).time())).filter(|(_, t)| *t < f64::INFINITY);
        let first = brute.min_by(|a, b| a.1.total_cmp(&b.1));
        assert_eq!(bits(tree.first(&path, crossing)), bits(first));
        hits += usize::from(first.is_some());
    }
    assert!(hits > 500, "{hits}");
}

#[test]
fn an_empty_tree_finds_nothing() {
    let tree = BoxTree::new([]);
    let path = Line { point: Vector2::zeros(), velocity: Vector2::x() };
    assert!(tree.first(&path, |_| Crossing::NEVER).is_none());
}
