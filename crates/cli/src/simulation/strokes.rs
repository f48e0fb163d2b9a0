//! Walls as pictures draw them.

use billiards::geometry::{Figure, Lattice, Piece, Table, Vector2, enclosed_area};

use crate::picture::{Solid, Stroke};

/// Number of parts of a curve that is neither straight nor circular; there are more where chords deviate from it.
const PARTS: u32 = 512;
/// Chords deviate from a curve by less than this fraction of its size: in a picture, by less than a twentieth of a point.
const OFF: f64 = 2e-4;
/// How many times a part may be cut into three.
const CUTS: u32 = 4;
/// Number of points of a piece that are sampled on its way through a cell, and the least and the greatest total number.
const PER_CELL: f64 = 256.0;
const FEWEST: f64 = 16.0;
const MOST: f64 = 1e5;

/// The walls of a table, all lengths divided by `factor`. On a lattice, all copies that reach into the unit cell, whole loops
/// together.
pub(crate) fn of(table: &Table, factor: f64) -> Vec<Stroke> {
    let mut seen = vec![vec![]; table.pieces().len()];
    for chain in table.chains() {
        let alone = chain.iter().map(core::slice::from_ref);
        let together: Vec<&[usize]> = if table.is_closed(&chain) { vec![&chain] } else { alone.collect() };
        for numbers in together {
            let shifts = copies(table, numbers);
            for &number in numbers {
                seen[number].clone_from(&shifts);
            }
        }
    }
    let mut strokes = vec![];
    for (piece, shifts) in table.pieces().iter().zip(&seen) {
        let points = points(&**piece);
        strokes.extend(shifts.iter().map(|by| stroke(&**piece, &points, by, factor)));
    }
    strokes
}

/// The insides of all loops that are obstacles, and the hollows in these, larger ones first.
pub(crate) fn solids(table: &Table, factor: f64) -> Vec<Solid> {
    let area = |chain: &[usize]| enclosed_area(chain.iter().map(|&number| &*table.pieces()[number]));
    let chains = table.chains().into_iter().filter(|chain| table.is_closed(chain));
    let mut loops: Vec<(f64, Vec<usize>)> = chains.map(|chain| (area(&chain), chain)).collect();
    loops.sort_by(|(a, _), (b, _)| b.abs().total_cmp(&a.abs()));
    let solid = |(area, chain): &(f64, Vec<usize>)| {
        let points: Vec<_> = chain.iter().map(|&number| points(&*table.pieces()[number])).collect();
        let edge = |by: &Vector2<f64>| {
            let pieces = chain.iter().zip(&points);
            pieces.map(|(&number, points)| stroke(&*table.pieces()[number], points, by, factor)).collect()
        };
        copies(table, chain).iter().map(|by| Solid { edge: edge(by), is_hollow: *area > 0.0 }).collect::<Vec<_>>()
    };
    // loops larger than all obstacles surround them
    loops.iter().skip_while(|(area, _)| *area > 0.0).flat_map(solid).collect()
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

/// The translations of visible copies of pieces that move together: those where any of the pieces reaches into the unit cell of a
/// lattice.
fn copies(table: &Table, numbers: &[usize]) -> Vec<Vector2<f64>> {
    let pieces = numbers.iter().map(|&number| &table.pieces()[number]);
    let Some(lattice) = table.lattice().filter(|_| pieces.clone().all(|piece| piece.length().is_finite())) else {
        return numbers.first().map_or(vec![], |&number| table.translations(number).collect());
    };
    // back from every cell that contains points; points on the edges of cells are left out
    let back = |point: Vector2<f64>| lattice.reduce(&point).1.map(|cells| 0.0 - cells);
    let mut cells: Vec<[f64; 2]> = vec![];
    for piece in pieces {
        cells.extend(samples(&**piece, lattice).map(back));
        cells.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        cells.dedup();
    }
    cells.into_iter().map(|cell| lattice.translation(cell)).collect()
}

/// Points of a piece, several in every cell that it crosses for some length.
fn samples<'a>(piece: &'a dyn Piece, lattice: &Lattice) -> impl Iterator<Item = Vector2<f64>> + use<'a> {
    let length = piece.length();
    let longest = lattice.vectors().iter().map(Vector2::norm).fold(0.0, f64::max);
    // the distance across a cell, which may be thin
    let cell = longest.min(lattice.cell_area() / longest);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a hundred thousand")]
    let many = (PER_CELL * length / cell).clamp(FEWEST, MOST) as u32;
    (0..many).map(move |k| piece.point_at(length * (f64::from(k) + 0.5) / f64::from(many)))
}

/// A translated piece, drawn through its [`points`] if it is neither straight nor circular.
fn stroke(piece: &dyn Piece, points: &[Vector2<f64>], by: &Vector2<f64>, factor: f64) -> Stroke {
    let out = |p: Vector2<f64>| [(p.x + by.x) / factor, (p.y + by.y) / factor];
    match piece.figure() {
        Figure::Segment { ends: [a, b] } => Stroke::Segment(out(a), out(b)),
        Figure::Line { through, direction } => Stroke::Line(out(through), direction.into()),
        Figure::Ray { from, direction, .. } => Stroke::Ray(out(from), direction.into()),
        Figure::Circle { center, radius, .. } => Stroke::Circle { center: out(center), radius: radius / factor },
        Figure::Arc { center, radius, ends: [a, _], inside } => {
            let start = libm::atan2(a.y - center.y, a.x - center.x);
            let sweep = piece.length() / radius;
            let sweep = if inside { sweep } else { -sweep };
            Stroke::Arc { center: out(center), radius: radius / factor, start, sweep }
        }
        Figure::Other => Stroke::Chain(points.iter().map(|point| out(*point)).collect()),
    }
}

/// A point of a curve, and the arc length there.
type Place = (f64, Vector2<f64>);

/// Points so close together that chords between them cannot be told from the curve; none where no chords are drawn.
fn points(piece: &dyn Piece) -> Vec<Vector2<f64>> {
    if piece.figure() != Figure::Other {
        return vec![];
    }
    let (length, extent) = (piece.length(), piece.extent());
    let off = OFF * (extent.max - extent.min).amax();
    let at = |s: f64| (s, piece.point_at(s));
    let mut from = at(0.0);
    let mut points = vec![from.1];
    for k in 1..=PARTS {
        let to = at(length * f64::from(k) / f64::from(PARTS));
        go_on(&at, from, to, off, CUTS, &mut points);
        from = to;
    }
    points
}

/// Continues along a curve, by a straight line if the curve is within `off` of the chord at two places in between.
fn go_on(at: &dyn Fn(f64) -> Place, from: Place, to: Place, off: f64, cuts: u32, points: &mut Vec<Vector2<f64>>) {
    let along = to.1 - from.1;
    // not at simple fractions of the way, where a wave as long as a part would not be noticed
    let [a, b] = [0.382, 0.618].map(|part| at(from.0 + part * (to.0 - from.0)));
    let is_off = |(_, point): Place| {
        let way = point - from.1;
        let part = (way.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        let part = if part.is_nan() { 0.0 } else { part };
        (way - along * part).norm() > off
    };
    if cuts > 0 && (is_off(a) || is_off(b)) {
        for (from, to) in [(from, a), (a, b), (b, to)] {
            go_on(at, from, to, off, cuts - 1, points);
        }
    } else {
        points.push(to.1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use billiards::geometry::shapes::curve::{Interval, Polar, PolarFormula};
    use billiards::geometry::{Outline, Turn, shapes};

    fn lattice(vectors: [[f64; 2]; 2]) -> Lattice {
        Lattice::new(&vectors.map(Vector2::from)).unwrap()
    }

    fn circle(center: [f64; 2], radius: f64) -> Box<dyn Piece> {
        Box::new(shapes::Circle::new(center.into(), radius, false).unwrap())
    }

    fn centers(strokes: &[Stroke]) -> Vec<[f64; 2]> {
        let of = |stroke: &Stroke| if let Stroke::Circle { center, .. } = stroke { Some(*center) } else { None };
        strokes.iter().filter_map(of).collect()
    }

    #[test]
    fn a_wall_given_in_a_cell_far_away_is_drawn_at_home() {
        let table = Table::periodic(vec![circle([5.5, 3.5], 0.25)], Some(lattice([[1.0, 0.0], [0.0, 1.0]]))).unwrap();
        assert_eq!(centers(&of(&table, 1.0)), [[0.5, 0.5]]);
        let solids = solids(&table, 1.0);
        assert_eq!((solids.len(), centers(&solids[0].edge)), (1, vec![[0.5, 0.5]]));
    }

    #[test]
    fn a_lean_cell_is_drawn_with_the_copies_in_its_middle() {
        let table = Table::periodic(vec![circle([0.0, 0.0], 0.25)], Some(lattice([[1.0, 0.0], [5.0, 1.0]]))).unwrap();
        let mut drawn = centers(&of(&table, 2.0));
        drawn.sort_by(|a, b| a.partial_cmp(b).unwrap());
        // those on its lower side and beside it, and those on its upper side
        let (below, above) = ([0.0, 0.5, 1.0].map(|x| [x, 0.0]), [2.0, 2.5, 3.0].map(|x| [x, 0.5]));
        assert_eq!(drawn, [below, above].concat());
    }

    #[test]
    fn obstacles_of_several_pieces_are_outlined_wherever_they_are_filled() {
        let v = Vector2::new;
        let mut square = Outline::from(v(-0.1, -0.2));
        for corner in [v(-0.1, 0.3), v(0.4, 0.3), v(0.4, -0.2), v(-0.1, -0.2)] {
            square = square.line_to(corner).unwrap();
        }
        let square = square.close().unwrap();
        let table = Table::periodic(square, Some(lattice([[1.0, 0.0], [0.0, 1.0]]))).unwrap();
        let solids = solids(&table, 1.0);
        assert_eq!(solids.len(), 4);
        let drawn = of(&table, 1.0);
        assert_eq!(drawn.len(), 16);
        assert!(solids.iter().flat_map(|solid| &solid.edge).all(|side| drawn.contains(side)));
    }

    #[test]
    fn walls_through_very_many_cells_are_drawn_in_each() {
        let v = Vector2::new;
        let mut triangle = Outline::from(v(0.1, 0.0));
        for corner in [v(0.1, 0.000_05), v(0.9, 0.9), v(0.1, 0.0)] {
            triangle = triangle.line_to(corner).unwrap();
        }
        let triangle = triangle.close().unwrap();
        let table = Table::periodic(triangle, Some(lattice([[1.0, 0.0], [0.0, 0.0001]]))).unwrap();
        let many = of(&table, 1.0).len();
        assert!((27_000..27_010).contains(&many), "{many}");
    }

    /// `r = 1 + 0.05 cos(n φ)`
    #[derive(Debug)]
    struct Wavy(f64);

    impl PolarFormula for Wavy {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let (sin, cos) = libm::sincos(self.0 * angle);
            [1.0 + 0.05 * cos, -0.05 * self.0 * sin, -0.05 * self.0 * self.0 * cos]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let (sin, cos) = ((angle * self.0).sin(), (angle * self.0).cos());
            [cos * 0.05 + 1.0, sin * (-0.05 * self.0), cos * (-0.05 * self.0 * self.0)]
        }
    }

    #[test]
    fn curves_are_cut_as_finely_as_they_wave() {
        for waves in [3.0, 100.0, 512.0] {
            let curve = Polar::new(Vector2::zeros(), Wavy(waves), true).unwrap();
            let points = points(&curve);
            assert_eq!(points.len() == 1 + PARTS as usize, waves == 3.0, "{waves}: {}", points.len());
            for ends in points.windows(2) {
                let middle = (ends[0] + ends[1]) * 0.5;
                let off = (curve.closest(&middle).point - middle).norm();
                assert!(off < 1.1 * OFF * 2.1, "{waves}: {off}");
            }
        }
    }

    #[test]
    fn obstacles_of_several_pieces_are_filled_and_their_hollows_are_not() {
        let v = Vector2::new;
        let square = |s: f64, outwards: bool| {
            let mut corners = [v(-s, -s), v(s, -s), v(s, s), v(-s, s)];
            if outwards {
                corners.reverse();
            }
            let mut outline = Outline::from(corners[3]);
            for corner in corners {
                outline = outline.line_to(corner).unwrap();
            }
            outline.close().unwrap()
        };
        let capsule = Outline::from(v(9.0, 1.0)).line_to(v(10.0, 1.0)).unwrap();
        let capsule = capsule.arc_to(v(10.0, -1.0), v(10.0, 0.0), Turn::Clockwise).unwrap();
        let capsule = capsule.line_to(v(9.0, -1.0)).unwrap().arc_to(v(9.0, 1.0), v(9.0, 0.0), Turn::Clockwise).unwrap();
        let mut pieces: Vec<Box<dyn Piece>> = vec![];
        for (half_side, outwards) in [(1.0, false), (2.0, true), (20.0, false)] {
            pieces.extend(square(half_side, outwards));
        }
        pieces.extend(capsule.close().unwrap());
        let drawn = solids(&Table::new(pieces).unwrap(), 1.0);
        let seen: Vec<_> = drawn.iter().map(|solid| (solid.edge.len(), solid.is_hollow)).collect();
        // a square, the capsule, the hollow in the square
        assert_eq!(seen, [(4, false), (4, false), (4, true)]);
        assert!(matches!(drawn[1].edge[1], Stroke::Arc { .. }));
    }
}
