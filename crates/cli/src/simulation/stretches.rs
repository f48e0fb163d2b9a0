//! Arc lengths of collisions on segments and arcs, many at a time.

use core::f64::consts::{FRAC_PI_2, PI};

use billiards::geometry::{Figure, Piece, Table};
use lanes::{Lane, Mask, Rows};

/// Most pieces: as many as are looked up in two vectors.
const MOST: usize = 16;

/// The unrolled boundary of a table of a few segments and arcs.
///
/// The point `x` with the unit normal `ν` is at `start + slope·x + radius θ`, where `θ` is the angle from `middle` to `ν`. On a segment the
/// radius is 0; on an arc the slope is 0, and `|θ|` is at most `half`.
#[derive(Clone, Debug)]
pub(super) struct Stretches {
    /// For each piece `slope`, `start` and `half`.
    places: Rows,
    /// `middle`, and the radius, negative where the angle falls along the piece; `None` if all pieces are segments.
    turns: Option<Rows>,
}

impl Stretches {
    /// The stretches of a table whose pieces begin at these arc lengths, in a picture with `unit` of width per length; `None`
    /// if there are other pieces, copies of them, or too many.
    pub(super) fn of(table: &Table, offsets: &[f64], unit: f64) -> Option<Self> {
        if table.lattice().is_some() || table.pieces().len() > MOST {
            return None;
        }
        let (mut places, mut turns) = (vec![], vec![]);
        for (piece, offset) in table.pieces().iter().zip(offsets) {
            match piece.figure() {
                Figure::Segment { ends: [a, b] } => {
                    let slope = (b - a).normalize() * unit;
                    places.push([slope.x, slope.y, offset * unit - slope.dot(&a), 0.0]);
                    turns.push([1.0, 0.0, 0.0, 0.0]);
                }
                Figure::Arc { radius, inside, .. } | Figure::Circle { radius, inside, .. } => {
                    let half = 0.5 * piece.length();
                    let middle = piece.landing_at(half).normal;
                    places.push([0.0, 0.0, (offset + half) * unit, half / radius]);
                    turns.push([middle.x, middle.y, if inside { radius * unit } else { -radius * unit }, 0.0]);
                }
                _ => return None,
            }
        }
        let has_arcs = turns.iter().any(|[.., radius, _]| *radius != 0.0);
        Some(Stretches { places: Rows::new(places), turns: has_arcs.then(|| Rows::new(turns)) })
    }

    /// Whether the arc length of a point of a piece is found without a search.
    pub(super) fn knows(piece: &dyn Piece) -> bool {
        matches!(piece.figure(), Figure::Segment { .. } | Figure::Arc { .. } | Figure::Circle { .. })
    }

    /// Whether unit normals are needed.
    pub(super) fn want_normals(&self) -> bool {
        self.turns.is_some()
    }

    /// The positions of points of these pieces with these unit normals.
    #[inline(always)]
    pub(super) fn at<F: Lane>(&self, [x1, x2]: [F; 2], normal: impl FnOnce() -> [F; 2], piece: F) -> F {
        let [slope1, slope2, start, half] = self.places.at(piece);
        let along = start + (slope1 * x1 + slope2 * x2);
        let Some(turns) = &self.turns else { return along };
        let ([m1, m2, radius, _], [n1, n2]) = (turns.at(piece), normal());
        // rounding may take a point beyond the ends
        along + radius * angle(m1 * n1 + m2 * n2, m1 * n2 - m2 * n1, half)
    }
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

/// The angle of the unit vector `(cos, sin)` in [−π, π], to 3.2·10⁻⁷, a thousandth of a pixel; of at most this size.
#[inline(always)]
fn angle<F: Lane>(cos: F, sin: F, most: F) -> F {
    let (a, b) = (cos.abs(), sin.abs());
    let small = a.min(b);
    let square = small * small;
    // in pairs, which do not depend on each other
    let [c0, c1, c2, c3, c4, c5] = ARC_SINE;
    let pair = |c: f64, d: f64| square * d + c;
    let fourth = square * square;
    let angle = small * (pair(c0, c1) + fourth * (pair(c2, c3) + fourth * pair(c4, c5)));
    let angle = a.lt(b).select(-angle + FRAC_PI_2, angle);
    let angle = cos.lt(cos.same(0.0)).select(-angle + PI, angle);
    angle.min(most).copysign(sin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::REDUCED_WIDTH;
    use billiards::geometry::{Landing, tables};

    #[test]
    fn angles_are_right_to_a_thousandth_of_a_pixel() {
        for k in 0..10_000 {
            let turn = f64::from(k - 5000) * 6.283e-4;
            let (sin, cos) = libm::sincos(turn);
            assert!((angle(cos, sin, PI) - turn).abs() < 3.3e-7, "{turn}");
            assert!((angle(cos, sin, 1.0) - turn.clamp(-1.0, 1.0)).abs() < 3.3e-7, "{turn}");
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
