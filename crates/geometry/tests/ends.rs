//! Ends that are one vertex but for rounding.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
mod formulas;

use formulas::Parabola;
use geometry::{
    Error, Piece, Table, Vector2,
    parry::{Placed, ShapeSpec, Side},
    shapes::{Ray, Segment, curve::ParametricCurve},
};

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}
fn ray(from: Vector2<f64>, along: Vector2<f64>, left: bool) -> Box<dyn Piece> {
    Box::new(Ray::new(from, along, left).unwrap())
}

/// A height field between two rays along its base, whose starts are computed here in another way, and these starts.
fn landscape(center: Vector2<f64>, angle: f64, scale: f64) -> (Vec<Box<dyn Piece>>, [Vector2<f64>; 2]) {
    let heights = vec![0.1, 1.0, 0.0, 0.5];
    let field = ShapeSpec::HeightField { heights, scale: [2.0 * scale, scale] };
    let placed = Placed { shape: field, translation: (center * scale).into(), rotation: angle };
    let (sin, cos) = libm::sincos(angle);
    let [across, up] = [v(cos, sin), v(-sin, cos)];
    let starts = [(1.0, 0.5), (-1.0, 0.1)].map(|(x, y)| (center + across * x + up * y) * scale);
    let mut pieces = placed.pieces(Side::Outside).unwrap();
    pieces.extend([ray(starts[0], across, true), ray(starts[1], -across, false)]);
    (pieces, starts)
}

#[test]
fn rays_go_on_where_a_height_field_ends_but_for_rounding() {
    let mut off = 0;
    for (k, t) in (0..300).map(|k| (k, k as f64)) {
        let center = v(0.1 * libm::floor(17.0 * libm::sin(t)), 0.1 * libm::floor(9.0 * libm::cos(3.0 * t)));
        for (angle, scale) in [(0.0, 1.0), (core::f64::consts::FRAC_PI_6, 1.0), (0.1 * t, 1e-40), (0.3 * t, 1e30)] {
            let (mut pieces, starts) = landscape(center, angle, scale);
            let is_off =
                pieces[..3].iter().flat_map(|piece| piece.ends().unwrap()).filter(|p| starts.contains(p)).count() < 2;
            off += usize::from(is_off);
            // in whatever order
            pieces.rotate_left(k % 5);
            let table = Table::new(pieces).unwrap_or_else(|error| panic!("{center} {angle} {scale}: {error}"));
            assert_eq!(table.validate(), Ok(()), "{center} {angle} {scale}");
            assert_eq!(table.chains().len(), 1);
            // rays stay where they are
            let from = table.pieces().iter().flat_map(|p| p.ends().unwrap()).filter(|p| starts.contains(p)).count();
            assert_eq!(from, 4, "{center} {angle} {scale}");
        }
    }
    assert!(off > 500, "{off}");
}

#[test]
fn ends_farther_apart_than_rounding_are_open() {
    let (pieces, [start, _]) = landscape(v(0.3, 0.2), 0.0, 1.0);
    let mut pieces: Vec<_> =
        pieces.into_iter().take(3).chain([ray(start + v(0.0, 1e-13), v(1.0, 0.0), true)]).collect();
    pieces.push(ray(v(-0.7, 0.3), v(-1.0, 0.0), false));
    assert!(matches!(Table::new(pieces), Err(Error::Open { gap, .. }) if gap > 0.9e-13 && gap < 1.1e-13));
}

#[test]
fn two_rays_meet_in_one_vertex() {
    let apart = |by: f64| vec![ray(v(1.0, 1.0 + by), v(0.0, 1.0), false), ray(v(1.0, 1.0), v(1.0, 0.0), true)];
    for by in [f64::EPSILON, -f64::EPSILON, 4.0 * f64::EPSILON] {
        let table = Table::new(apart(by)).unwrap();
        assert_eq!((table.validate(), table.chains().len()), (Ok(()), 1));
    }
    assert!(Table::new(apart(1e-12)).is_err());
}

#[test]
fn a_curve_given_by_a_formula_keeps_its_ends() {
    let ends = [v(0.0, 0.0), v(1.0, 1.0)];
    let off = v(f64::EPSILON, 0.0);
    let curve = || Box::new(ParametricCurve::along(Parabola, [0.0, 1.0], ends).unwrap().remove(0)) as Box<dyn Piece>;
    let rest = |from, to| vec![Box::new(Segment::new(from, to).unwrap()) as Box<dyn Piece>];
    let closed = |mut pieces: Vec<Box<dyn Piece>>| {
        pieces.push(curve());
        let table = Table::new(pieces)?;
        assert_eq!(table.validate(), Ok(()));
        let mut vertices = table.pieces().iter().filter_map(Piece::ends).flatten().filter(|p| p.amax().is_finite());
        Ok::<_, Error>(vertices.all(|p| ends.contains(&p)))
    };
    assert_eq!(closed(rest(ends[1] + off, ends[0] - off)), Ok(true));
    assert_eq!(closed(vec![ray(ends[0] - off, v(-1.0, 0.0), false), ray(ends[1] + off, v(0.0, 1.0), true)]), Ok(true));
}
