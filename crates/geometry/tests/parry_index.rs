//! The tree over very many pieces.
#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests panic where they fail, and claim exact values")]
mod parry_random;

use core::f64::consts::PI;
use geometry::{
    Crossing, Landing, Line, Piece, Vector2,
    parry::Index,
    shapes::{Arc, Circle, FullLine, Segment},
};
use parry_random::Random;

/// A star-shaped polygon of `n` corners with a rough edge.
fn rough(n: usize, size: f64, random: &mut Random) -> Vec<Segment> {
    let corners: Vec<Vector2<f64>> = (0..n)
        .map(|k| {
            let angle = 2.0 * PI * k as f64 / n as f64;
            let radius = size * (1.0 + 0.2 * libm::sin(5.0 * angle) + 0.5 / n as f64 * random.unit());
            Vector2::new(libm::cos(angle), libm::sin(angle)) * radius
        })
        .collect();
    (0..n).map(|k| Segment::new(corners[k], corners[(k + 1) % n]).unwrap()).collect()
}
fn brute(pieces: &[impl Piece], path: &Line<2>) -> Option<(usize, Crossing)> {
    let mut best = None;
    let mut first = Crossing::NEVER;
    for (i, piece) in pieces.iter().enumerate() {
        let crossing = piece.crossing(path);
        if crossing.before(&first) {
            first = crossing;
            best = Some((i, crossing));
        }
    }
    best
}
fn same(a: Option<(usize, Crossing)>, b: Option<(usize, Crossing)>) -> bool {
    let bits = |c: Option<(usize, Crossing)>| c.map(|(i, c)| (i, c.num.to_bits(), c.den.to_bits()));
    bits(a) == bits(b)
}

#[test]
fn the_tree_equals_asking_every_piece_bit_for_bit() {
    let mut random = Random(4);
    // a tiny table, an ordinary one, a huge one
    for (n, size) in [(3, 1.0), (40, 1e-12), (333, 1.0), (1000, 1e100)] {
        let pieces = rough(n, size, &mut random);
        let index = Index::new(pieces.iter().map(Piece::extent));
        let mut point = Vector2::zeros();
        for k in 0..3000 {
            let angle = random.between(0.0, 2.0 * PI);
            let mut velocity = Vector2::new(libm::cos(angle), libm::sin(angle)) * size;
            match k % 4 {
                // aimed at a vertex, along an axis, from far away, and on from the wall just hit
                0 => velocity = pieces[k % n].point_at(0.0) - point,
                1 => velocity = Vector2::new(0.0, size),
                2 => point = -velocity * 1e5,
                _ => {}
            }
            let path = Line { point, velocity };
            let found = index.first(&path, |i| pieces[i].crossing(&path));
            assert!(same(found, brute(&pieces, &path)), "{n} pieces, path {k}");
            point = match found {
                Some((i, crossing)) => pieces[i].landing(&path, crossing.time()).point,
                None => Vector2::zeros(),
            };
        }
    }
}

#[test]
fn no_path_is_lost() {
    // inside a closed polygon something is always hit: 10⁵ bounces, and from each wall a path aimed at a vertex, seen or
    // not. (What starts at a vertex itself is in a corner, and no business of the tree.)
    let mut random = Random(5);
    let pieces = rough(2000, 1.0, &mut random);
    let index = Index::new(pieces.iter().map(Piece::extent));
    let ask = |path: &Line<2>| index.first(path, |i| pieces[i].crossing(path));
    let mut path = Line { point: Vector2::zeros(), velocity: Vector2::new(0.6, 0.8) };
    for k in 0..100_000 {
        let (i, crossing) = ask(&path).unwrap_or_else(|| panic!("lost bounce {k}: {path:?}"));
        let Landing { point, normal } = pieces[i].landing(&path, crossing.time());
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
    let index = Index::new(pieces.iter().map(|p| p.extent()));
    for _ in 0..3000 {
        let angle = random.between(0.0, 2.0 * PI);
        let point = Vector2::new(random.between(0.0, 20.0), random.between(0.0, 16.0));
        let path = Line { point, velocity: Vector2::new(libm::cos(angle), libm::sin(angle)) };
        let found = index.first(&path, |i| pieces[i].crossing(&path));
        let mut first = (usize::MAX, Crossing::NEVER);
        for (i, piece) in pieces.iter().enumerate() {
            let crossing = piece.crossing(&path);
            if crossing.before(&first.1) {
                first = (i, crossing);
            }
        }
        assert!(same(found, (first.0 != usize::MAX).then_some(first)));

        let near = index.closest(&point, |i| pieces[i].closest(&point).point);
        let distance = |i: usize| (pieces[i].closest(&point).point - point).norm();
        let least = (0..pieces.len()).map(distance).fold(f64::INFINITY, f64::min);
        assert!(!near.is_empty());
        assert!(near.iter().all(|&i| distance(i) <= least * (1.0 + 1e-11)));
    }
}

#[test]
fn an_empty_tree_finds_nothing() {
    let index = Index::new([]);
    let path = Line { point: Vector2::zeros(), velocity: Vector2::x() };
    assert!(index.first(&path, |_| Crossing::NEVER).is_none());
    assert!(index.closest(&Vector2::zeros(), |_| Vector2::zeros()).is_empty());
}
