//! Where on segments and arcs collisions are, many at a time.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use billiards::geometry::{Figure, Piece, Table};
use lanes::{Lane, Mask};

/// Most pieces that are told apart one after another.
const MOST: usize = 16;

/// The unrolled boundary of a table of a few segments and arcs.
#[derive(Clone, Debug)]
pub(super) struct Stretches {
    /// Each with the number of its piece, in ascending order.
    straights: Vec<(f64, Straight)>,
    bends: Vec<(f64, Bend)>,
}

/// A segment: the point `x` of it is at `start + slope·x`.
#[derive(Clone, Copy, Debug)]
struct Straight<F = f64> {
    slope: [F; 2],
    start: F,
}

/// An arc: the point of it with the unit normal `ν` is at `start + radius θ`, where `(cos θ, sin θ) = (cosine·ν, sine·ν)`.
#[derive(Clone, Copy, Debug)]
struct Bend<F = f64> {
    cosine: [F; 2],
    sine: [F; 2],
    radius: F,
    /// θ at its end.
    sweep: F,
    start: F,
}

impl Stretches {
    /// Those of a table whose pieces begin at these arc lengths, in a picture with so much width per length; `None` if there
    /// are other pieces, copies of them, or too many.
    pub(super) fn of(table: &Table, offsets: &[f64], unit: f64) -> Option<Self> {
        if table.lattice().is_some() || table.pieces().len() > MOST {
            return None;
        }
        let mut all = Stretches { straights: vec![], bends: vec![] };
        for (number, (piece, offset)) in table.pieces().iter().zip(offsets).enumerate() {
            let (number, start) = (number as f64, offset * unit);
            match piece.figure() {
                Figure::Segment { ends: [a, b] } => {
                    let slope = (b - a).normalize() * unit;
                    all.straights.push((number, Straight { slope: slope.into(), start: start - slope.dot(&a) }));
                }
                Figure::Arc { radius, inside, .. } | Figure::Circle { radius, inside, .. } => {
                    let (first, turn) = (piece.landing_at(0.0).normal, if inside { 1.0 } else { -1.0 });
                    let bend = Bend {
                        cosine: first.into(),
                        sine: [-turn * first.y, turn * first.x],
                        radius: radius * unit,
                        sweep: piece.length() / radius,
                        start,
                    };
                    all.bends.push((number, bend));
                }
                _ => return None,
            }
        }
        Some(all)
    }

    /// Whether a piece is told where a point of it is without a search.
    pub(super) fn knows(piece: &dyn Piece) -> bool {
        matches!(piece.figure(), Figure::Segment { .. } | Figure::Arc { .. } | Figure::Circle { .. })
    }

    /// Whether unit normals are asked for.
    pub(super) fn bend(&self) -> bool {
        !self.bends.is_empty()
    }

    /// Where points of these pieces are that have these unit normals.
    #[inline(always)]
    pub(super) fn at<F: Lane>(&self, point: [F; 2], normal: impl FnOnce() -> [F; 2], piece: F) -> F {
        let zero = piece.same(0.0);
        let beyond = |number: f64| zero.same(number - 0.5).lt(piece);
        let straight = self.straights.split_first().map(|((_, first), others)| {
            others.iter().fold(first.all(zero), |one, (number, other)| one.or(beyond(*number), &other.all(zero)))
        });
        let straight = straight.map_or(zero, |straight| straight.at(point));
        let Some(((number, first), others)) = self.bends.split_first() else { return straight };
        let only = |number: f64| beyond(number) & piece.lt(zero.same(number + 0.5));
        let (mut bend, mut bends) = (first.all(zero), only(*number));
        for (number, other) in others {
            bend = bend.or(beyond(*number), &other.all(zero));
            bends = bends | only(*number);
        }
        bends.select(bend.at(normal()), straight)
    }
}

impl Straight {
    /// The same in as many lanes as `zero` has.
    #[inline(always)]
    fn all<F: Lane>(&self, zero: F) -> Straight<F> {
        Straight { slope: self.slope.map(|x| zero.same(x)), start: zero.same(self.start) }
    }
}

impl<F: Lane> Straight<F> {
    /// This one, or `other` where `second`.
    #[inline(always)]
    fn or(self, second: F::Mask, other: &Self) -> Self {
        let ([a1, a2], [b1, b2]) = (self.slope, other.slope);
        Straight {
            slope: [second.select(b1, a1), second.select(b2, a2)],
            start: second.select(other.start, self.start),
        }
    }

    #[inline(always)]
    fn at(&self, [x, y]: [F; 2]) -> F {
        self.start + (self.slope[0] * x + self.slope[1] * y)
    }
}

impl Bend {
    /// The same in as many lanes as `zero` has.
    #[inline(always)]
    fn all<F: Lane>(&self, zero: F) -> Bend<F> {
        let all = |x: f64| zero.same(x);
        Bend {
            cosine: self.cosine.map(all),
            sine: self.sine.map(all),
            radius: all(self.radius),
            sweep: all(self.sweep),
            start: all(self.start),
        }
    }
}

impl<F: Lane> Bend<F> {
    /// This one, or `other` where `second`.
    #[inline(always)]
    fn or(self, second: F::Mask, other: &Self) -> Self {
        let pair = |[a1, a2]: [F; 2], [b1, b2]: [F; 2]| [second.select(b1, a1), second.select(b2, a2)];
        Bend {
            cosine: pair(self.cosine, other.cosine),
            sine: pair(self.sine, other.sine),
            radius: second.select(other.radius, self.radius),
            sweep: second.select(other.sweep, self.sweep),
            start: second.select(other.start, self.start),
        }
    }

    #[inline(always)]
    fn at(&self, [n1, n2]: [F; 2]) -> F {
        let ([c1, c2], [s1, s2]) = (self.cosine, self.sine);
        let angle = angle(c1 * n1 + c2 * n2, s1 * n1 + s2 * n2);
        // rounding may take a point beyond the ends
        let before = (self.sweep * 0.5 + PI).lt(angle);
        let angle = before.select(angle.same(0.0), angle.min(self.sweep));
        self.start + self.radius * angle
    }
}

/// `arcsin s / s` in powers of `s²`, for `s² ≤ ½`, by which `arcsin s` is right to 3.2·10⁻⁷: of such polynomials the best.
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
    // in pairs, which do not wait for each other
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
    use billiards::geometry::tables;

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
            assert_eq!(stretches.straights.len() + stretches.bends.len(), table.pieces().len());
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
    fn other_pieces_copies_and_many_pieces_have_none() {
        let of = |table: Table| Stretches::of(&table, &table.arc_length_offsets(), 1.0);
        assert!(of(tables::ellipse([2.0, 1.0]).unwrap()).is_none());
        assert!(of(tables::sinai_torus(0.3, 1.0).unwrap()).is_none());
        assert!(of(tables::polygon(MOST + 1, 1.0).unwrap()).is_none());
        assert!(of(tables::polygon(MOST, 1.0).unwrap()).is_some());
    }
}
