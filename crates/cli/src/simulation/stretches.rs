//! Arc lengths of collisions on segments and arcs, many at a time.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use billiards::geometry::{Figure, Piece, Table};
use lanes::{Lane, Mask};

/// Most pieces, which are tested one after another.
const MOST: usize = 16;

/// The unrolled boundary of a table of a few segments and arcs.
///
/// The point `x` of a segment is at `start + slope·x`. The point of an arc with the unit normal `ν` is at `start + radius θ`,
/// where `(cos θ, sin θ) = (cosine·ν, sine·ν)` and `0 ≤ θ ≤ sweep`.
#[derive(Clone, Debug)]
pub(super) struct Stretches {
    /// `slope` and `start`.
    segments: Vec<Stretch<3>>,
    /// `cosine`, `sine`, `radius`, `sweep` and `start`.
    arcs: Vec<Stretch<7>>,
}

/// The number of a piece, and the coefficients that give the arc length of its points.
type Stretch<const K: usize> = (f64, [f64; K]);

impl Stretches {
    /// The stretches of a table whose pieces begin at these arc lengths, in a picture with `unit` of width per length; `None`
    /// if there are other pieces, copies of them, or too many.
    pub(super) fn of(table: &Table, offsets: &[f64], unit: f64) -> Option<Self> {
        if table.lattice().is_some() || table.pieces().len() > MOST {
            return None;
        }
        let mut stretches = Stretches { segments: vec![], arcs: vec![] };
        for (number, (piece, offset)) in table.pieces().iter().zip(offsets).enumerate() {
            let (number, start) = (number as f64, offset * unit);
            match piece.figure() {
                Figure::Segment { ends: [a, b] } => {
                    let slope = (b - a).normalize() * unit;
                    stretches.segments.push((number, [slope.x, slope.y, start - slope.dot(&a)]));
                }
                Figure::Arc { radius, inside, .. } | Figure::Circle { radius, inside, .. } => {
                    let (first, turn) = (piece.landing_at(0.0).normal, if inside { 1.0 } else { -1.0 });
                    let [cosine, sine] = [[first.x, first.y], [-turn * first.y, turn * first.x]];
                    let sweep = piece.length() / radius;
                    stretches
                        .arcs
                        .push((number, [cosine[0], cosine[1], sine[0], sine[1], radius * unit, sweep, start]));
                }
                _ => return None,
            }
        }
        Some(stretches)
    }

    /// Whether the arc length of a point of a piece is found without a search.
    pub(super) fn knows(piece: &dyn Piece) -> bool {
        matches!(piece.figure(), Figure::Segment { .. } | Figure::Arc { .. } | Figure::Circle { .. })
    }

    /// Whether unit normals are needed.
    pub(super) fn want_normals(&self) -> bool {
        !self.arcs.is_empty()
    }

    /// The positions of points of these pieces with these unit normals.
    #[inline(always)]
    pub(super) fn at<F: Lane>(&self, point: [F; 2], normal: impl FnOnce() -> [F; 2], piece: F) -> F {
        let zero = piece.same(0.0);
        let on_segment = match of_pieces(&self.segments, piece) {
            Some(segment) => on_segment(segment, point),
            None => zero,
        };
        let Some(arc) = of_pieces(&self.arcs, piece) else { return on_segment };
        let mut on_arcs = zero.never();
        for (number, _) in &self.arcs {
            on_arcs = on_arcs | (zero.same(number - 0.5).lt(piece) & piece.lt(zero.same(number + 0.5)));
        }
        on_arcs.select(on_arc(arc, normal()), on_segment)
    }
}

/// The coefficients of the piece in each lane, or of another piece where it is not among these; `None` if there are none.
#[inline(always)]
fn of_pieces<F: Lane, const K: usize>(stretches: &[Stretch<K>], piece: F) -> Option<[F; K]> {
    let ((_, first), others) = stretches.split_first()?;
    let mut numbers = all(first, piece);
    for (number, other) in others {
        numbers = piece.same(number - 0.5).lt(piece).choose(all(other, piece), numbers);
    }
    Some(numbers)
}

/// Numbers in as many lanes as `like` has.
#[inline(always)]
fn all<F: Lane, const K: usize>(numbers: &[f64; K], like: F) -> [F; K] {
    // not a closure, which the compiler may leave as a separate function that is not compiled for the instruction set
    let mut all = [like; K];
    for i in 0..K {
        all[i] = like.same(numbers[i]);
    }
    all
}

/// The position of a point on a segment.
#[inline(always)]
fn on_segment<F: Lane>([slope1, slope2, start]: [F; 3], [x1, x2]: [F; 2]) -> F {
    start + (slope1 * x1 + slope2 * x2)
}

/// The position on an arc of the point with a unit normal.
#[inline(always)]
fn on_arc<F: Lane>([cosine1, cosine2, sine1, sine2, radius, sweep, start]: [F; 7], [n1, n2]: [F; 2]) -> F {
    let angle = angle(cosine1 * n1 + cosine2 * n2, sine1 * n1 + sine2 * n2);
    // rounding may take a point beyond the ends
    let before = (sweep * 0.5 + PI).lt(angle);
    let angle = before.select(angle.same(0.0), angle.min(sweep));
    start + radius * angle
}

/// `arcsin s / s` in powers of `s²`, for `s² ≤ ½`, which gives `arcsin s` to 3.2·10⁻⁷: the best polynomial of this degree.
const ARC_SINE: [f64; 6] = [
    0.999_994_358_521_305_2,
    0.166_959_262_661_985_8,
    0.070_704_963_408_604_55,
    0.071_042_944_446_023_6,
    -0.044_528_577_523_993_355,
    0.111_127_077_703_793_47,
];

/// The angle of the unit vector `(cos, sin)` in [0, 2π], to 3.2·10⁻⁷: a thousandth of a pixel.
#[inline(always)]
fn angle<F: Lane>(cos: F, sin: F) -> F {
    let zero = cos.same(0.0);
    let (a, b) = (cos.abs(), sin.abs());
    let small = a.min(b);
    let square = small * small;
    // in pairs, which do not depend on each other
    let [c0, c1, c2, c3, c4, c5] = ARC_SINE;
    let pair = |c: f64, d: f64| square * d + c;
    let fourth = square * square;
    let angle = small * (pair(c0, c1) + fourth * (pair(c2, c3) + fourth * pair(c4, c5)));
    let angle = a.lt(b).select(-angle + FRAC_PI_2, angle);
    let angle = cos.lt(zero).select(-angle + PI, angle);
    sin.lt(zero).select(-angle + TAU, angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::REDUCED_WIDTH;
    use billiards::geometry::{Landing, tables};

    #[test]
    fn angles_are_right_to_a_thousandth_of_a_pixel() {
        for k in 0..10_000 {
            let turn = f64::from(k) * 6.283e-4;
            let (sin, cos) = libm::sincos(turn);
            assert!((angle(cos, sin) - turn).abs() < 3.3e-7, "{turn}");
        }
    }

    #[test]
    fn points_are_where_their_pieces_say() {
        let tables = [
            tables::stadium(1.0, 1.0),
            tables::mushroom(1.0, 0.5, 0.75),
            tables::moon(1.0, 0.75, 1.0),
            tables::sinai(1.0, 0.25),
            tables::circle(0.5),
            tables::hexagon(1.0),
        ];
        for table in tables.map(Result::unwrap) {
            let (offsets, unit) = (table.arc_length_offsets(), REDUCED_WIDTH / table.perimeter());
            let stretches = Stretches::of(&table, &offsets, unit).unwrap();
            assert_eq!(stretches.segments.len() + stretches.arcs.len(), table.pieces().len());
            for (number, piece) in table.pieces().iter().enumerate() {
                for k in 0..=100 {
                    let landing = piece.landing_at(piece.length() * f64::from(k) * 0.01);
                    let fast = stretches.at(landing.point.into(), || landing.normal.into(), number as f64);
                    let exact = (offsets[number] + piece.arc_length_of(&landing)) * unit;
                    // a closed curve ends where it begins
                    let off = (fast - exact).abs();
                    let round = piece.ends().is_none() && (off - piece.length() * unit).abs() < 3e-7;
                    assert!(off < 3e-7 || round, "{table:?} {number} {k}: {fast} {exact}");
                }
            }
        }
    }

    #[test]
    fn points_that_rounding_takes_beyond_an_arc_are_at_its_end() {
        for table in [tables::stadium(1.0, 1.0), tables::moon(1.0, 0.75, 1.0)].map(Result::unwrap) {
            let offsets = table.arc_length_offsets();
            let stretches = Stretches::of(&table, &offsets, 1.0).unwrap();
            for (number, piece) in
                table.pieces().iter().enumerate().filter(|(_, piece)| piece.curvature(&piece.point_at(0.0)) != 0.0)
            {
                for end in [0.0, piece.length()] {
                    let Landing { point, normal } = piece.landing_at(end);
                    for turn in [-1e-9, 1e-9] {
                        let turned = [normal.x - turn * normal.y, normal.y + turn * normal.x];
                        let place = stretches.at(point.into(), || turned, number as f64) - offsets[number];
                        // the angle is accurate to 3.2·10⁻⁷, times a radius of at most 1
                        assert!((place - end).abs() < 1e-6, "{piece:?}: {place} for {end}");
                    }
                }
            }
        }
    }

    #[test]
    fn other_pieces_copies_and_many_pieces_have_none() {
        let of = |table: Table| Stretches::of(&table, &table.arc_length_offsets(), 1.0);
        assert!(of(tables::ellipse([2.0, 1.0]).unwrap()).is_none());
        assert!(of(tables::sinai_torus(0.3, 1.0).unwrap()).is_none());
        assert!(of(tables::polygon(MOST + 1, 1.0).unwrap()).is_none());
        assert!(of(tables::polygon(MOST, 1.0).unwrap()).is_some());
    }
}
