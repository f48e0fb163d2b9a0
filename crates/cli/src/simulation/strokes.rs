//! Walls as pictures draw them.

use billiards::geometry::{Figure, Lattice, Piece, Table, Vector2};

use crate::picture::Stroke;

/// Points of a curve that is neither straight nor circular: nearer than the eye can tell.
const POINTS: u32 = 512;

/// The walls of a table, all lengths divided by `factor`. On a lattice, all copies that reach into the unit cell.
pub(crate) fn of(table: &Table, factor: f64) -> Vec<Stroke> {
    let shifts = table.lattice().map_or(vec![Vector2::zeros()], |lattice| shifts(table, lattice));
    shifts.iter().flat_map(|by| table.pieces().iter().map(|piece| stroke(&**piece, by, factor))).collect()
}

/// The edges of the unit cell of a lattice, all lengths divided by `factor`.
pub(crate) fn of_cell(lattice: &Lattice, factor: f64) -> Vec<Stroke> {
    let out = |v: Vector2<f64>| [v.x / factor, v.y / factor];
    let corner = |a: f64, b: f64| out(lattice.translation([a, b]));
    match lattice.vectors() {
        [a] => {
            let across = [-a.y, a.x];
            vec![Stroke::Line(corner(0.0, 0.0), across), Stroke::Line(corner(1.0, 0.0), across)]
        }
        _ => [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]
            .windows(2)
            .map(|ends| Stroke::Segment(corner(ends[0][0], ends[0][1]), corner(ends[1][0], ends[1][1])))
            .collect(),
    }
}

/// Translations that bring part of the walls into the unit cell.
fn shifts(table: &Table, lattice: &Lattice) -> Vec<Vector2<f64>> {
    let steps = [-1.0, 0.0, 1.0];
    let second = if lattice.vectors().len() == 2 { &steps[..] } else { &[0.0] };
    let all = steps.iter().flat_map(|a| second.iter().map(|b| lattice.translation([*a, *b])));
    all.filter(|by| table.pieces().iter().any(|piece| reaches_cell(&**piece, by, lattice))).collect()
}

/// Whether a translated piece has a point in the unit cell, its edges left out.
fn reaches_cell(piece: &dyn Piece, by: &Vector2<f64>, lattice: &Lattice) -> bool {
    let length = piece.length();
    let point = |k: u32| piece.point_at(length * (f64::from(k) + 0.5) / f64::from(POINTS)) + by;
    length.is_finite() && (0..POINTS).any(|k| lattice.reduce(&point(k)).1 == [0.0, 0.0])
}

fn stroke(piece: &dyn Piece, by: &Vector2<f64>, factor: f64) -> Stroke {
    let out = |p: Vector2<f64>| [(p.x + by.x) / factor, (p.y + by.y) / factor];
    match piece.figure() {
        Figure::Segment { ends: [a, b] } => Stroke::Segment(out(a), out(b)),
        Figure::Line { through, direction } => Stroke::Line(out(through), direction.into()),
        Figure::Ray { from, direction, .. } => Stroke::Ray(out(from), direction.into()),
        Figure::Circle { center, radius, inside } => {
            Stroke::Circle { center: out(center), radius: radius / factor, solid: !inside }
        }
        Figure::Arc { center, radius, ends: [a, _], inside } => {
            let start = libm::atan2(a.y - center.y, a.x - center.x);
            let sweep = piece.length() / radius;
            let sweep = if inside { sweep } else { -sweep };
            Stroke::Arc { center: out(center), radius: radius / factor, start, sweep }
        }
        Figure::Other => {
            let length = piece.length();
            let points = (0..=POINTS).map(|k| out(piece.point_at(length * f64::from(k) / f64::from(POINTS)))).collect();
            Stroke::Chain { points, solid: piece.ends().is_none() && piece.area() < 0.0 }
        }
    }
}
