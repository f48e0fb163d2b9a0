//! Cusps within a piece.
use super::*;
use core::f64::consts::TAU;
use geometry::shapes::curve::{Interval, ParametricCurve, ParametricFormula, Polar, PolarFormula};

/// `r = 2 − a |sin(n φ + c)|ᵖ`: cusps for `p < 1`.
#[derive(Clone, Copy, Debug)]
struct Cusps {
    size: f64,
    waves: f64,
    phase: f64,
    power: f64,
}

impl PolarFormula for Cusps {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let Cusps { size, waves, phase, power } = *self;
        let (sin, cos) = libm::sincos(waves * angle + phase);
        let [base, slope] = [sin.abs(), waves * cos * libm::copysign(1.0, sin)];
        let value = libm::pow(base, power);
        let first = power * libm::pow(base, power - 1.0) * slope;
        let second =
            power * (power - 1.0) * libm::pow(base, power - 2.0) * slope * slope - power * value * waves * waves;
        [2.0 - size * value, -size * first, -size * second]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let Cusps { size, waves, phase, power } = *self;
        // where nothing widens the angle, the arcs between the cusps are found
        let angle = if (waves, phase) == (1.0, 0.0) { angle } else { angle * waves + phase };
        let [sin, cos] = angle.sin_cos();
        let value = sin.abs().powf(power.into());
        if sin.contains(0.0) {
            return [value * -size + 2.0, Interval::ENTIRE, Interval::ENTIRE];
        }
        let (base, slope) = (sin.abs(), cos * waves * libm::copysign(1.0, sin.low));
        let first = base.powf((power - 1.0).into()) * slope * power;
        let second = base.powf((power - 2.0).into()) * slope.square() * (power * (power - 1.0))
            + value * (-power * waves * waves);
        [value * -size + 2.0, first * -size, second * -size]
    }
}

fn curve<F: PolarFormula + Clone + 'static>(formula: F, inside: bool) -> Table {
    table(Polar::new(v(0.125, -0.25), formula, inside).unwrap().pieces())
}

#[test]
fn a_disk_goes_right_between_the_flanks_of_cusps_or_not_at_all() {
    for (power, waves, size) in [(0.5, 1.5, 0.2), (0.5, 10.0, 0.0655), (0.4, 2.0, 0.1), (0.75, 1.0, 0.3)] {
        for phase in [1.076, 0.3] {
            let drawn = curve(Cusps { size, waves, phase, power }, true);
            assert_eq!(drawn.pieces().len(), 1);
            for radius in [0.01, 0.05, 0.4] {
                match drawn.offset(radius) {
                    Ok(_) => drop(check("cusps", &drawn, radius)),
                    Err(Error::RoughPiece { piece: 0, at }) => {
                        let tip = v(at[0] - 0.125, at[1] + 0.25).norm();
                        assert!((tip - 2.0).abs() < 1e-4, "{power} {waves} {radius}: {tip}");
                    }
                    Err(error) => panic!("{power} {waves} {radius}: {error}"),
                }
            }
        }
    }
}

#[test]
fn a_disk_goes_about_the_tips_of_cusps_although_no_angle_is_theirs() {
    // the square root bends on a radius of 0.01
    let radius = 0.001;
    for power in [0.5, 1.0 / 3.0, 0.25] {
        for size in [0.2, -0.2] {
            let inside = size < 0.0;
            let formula = Cusps { size, waves: 1.0, phase: 0.0, power };
            let mut pieces = Polar::new(v(0.125, -0.25), formula, inside).unwrap().pieces();
            assert_eq!(pieces.len(), 2, "{power} {size}");
            if !inside {
                pieces.push(circle(0.0, 0.0, 4.0, true));
            }
            let drawn = table(pieces);
            check("cusps", &drawn, 0.1);
            let centres = drawn.offset(radius).unwrap().table;
            for side in [1.0, -1.0] {
                let tip = v(0.125 + side * 2.0, -0.25);
                for end in drawn.pieces().iter().filter_map(Piece::ends).flatten() {
                    let off = (end - tip).norm();
                    assert!(!(2e-15..3.0).contains(&off), "{power} {size}: {end}");
                }
                // r = 2 ± a ε^p at the nearest angles: in between, the curve is a needle, and a disk above it touches its side
                let spike = 0.2 * libm::pow(f64::EPSILON, power);
                for part in [0.01, 0.1, 0.3, 0.5, 0.7, 0.9] {
                    let beside = tip.x - side * spike * part * size.signum();
                    let path = geometry::Line { point: v(beside, tip.y + 0.0015), velocity: v(0.0, -1.0) };
                    let time = centres.pieces().iter().map(|p| p.crossing(&path).time()).fold(f64::INFINITY, f64::min);
                    assert!((time - (0.0015 - radius)).abs() < 1e-14, "{power} {size} {side} {part}: {time}");
                    let touched = drawn.pieces().iter().map(|p| p.closest(&path.at(time)));
                    let off = touched.map(|foot| (foot.point - v(beside, tip.y)).norm()).fold(f64::INFINITY, f64::min);
                    // not right below it, as the side bends
                    assert!(off < 0.125 * spike * part + 2e-15, "{power} {size} {side} {part}: {off}");
                }
            }
        }
    }
}

#[test]
fn where_a_disk_is_not_followed_about_cusps_one_of_them_is_named_whatever_the_radius() {
    for power in [0.25, 0.5, 0.75] {
        for (waves, phase) in [(2.0, 0.0), (1.0, 0.3), (0.5, 0.0)] {
            for size in [0.2, -0.2] {
                let drawn = curve(Cusps { size, waves, phase, power }, size < 0.0);
                for radius in [0.01, 0.1, 0.3] {
                    let Err(Error::RoughPiece { piece: 0, at }) = drawn.offset(radius) else {
                        panic!("{power} {waves} {phase} {size} {radius}: {:?}", drawn.offset(radius).err());
                    };
                    let tip = v(at[0] - 0.125, at[1] + 0.25).norm();
                    assert!((tip - 2.0).abs() < 1e-3, "{power} {waves} {phase} {size} {radius}: {tip}");
                }
            }
        }
    }
}

/// `(1 + k) e(t) − e((1 + k) t)`, `e(t) = (cos t, sin t)`: a cycloid about a circle with `k` cusps, or in one with `−k`.
#[derive(Debug)]
struct Cycloid(f64);

impl ParametricFormula for Cycloid {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let k = 1.0 + self.0;
        let ((sin, cos), (wave, crest)) = (libm::sincos(t), libm::sincos(k * t));
        [
            [k * cos - crest, k * sin - wave],
            [k * (wave - sin), k * (cos - crest)],
            [k * (k * crest - cos), k * (k * wave - sin)],
        ]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let k = 1.0 + self.0;
        let ([sin, cos], [wave, crest]) = (t.sin_cos(), (t * k).sin_cos());
        [
            [cos * k - crest, sin * k - wave],
            [(wave - sin) * k, (cos - crest) * k],
            [(crest * k - cos) * k, (wave * k - sin) * k],
        ]
    }
}

#[test]
fn a_disk_goes_right_about_the_tips_of_cycloids_and_between_their_flanks() {
    for cusps in [1.0, 2.0, -3.0, -4.0_f64] {
        let pieces = ParametricCurve::around(Cycloid(cusps), [0.0, TAU], true).unwrap();
        let drawn = table(pieces.into_iter().map(|piece| Box::new(piece) as _).collect());
        for radius in [1e-3, 0.1, 0.45, 0.9] {
            let centres = check("cycloid", &drawn, radius).table;
            let (tips, pieces) = (cusps.abs(), centres.pieces().len() as f64);
            // about tips that point into the table there are arcs; the cardioid has a vertex also where its range begins
            assert_eq!(pieces, if cusps > 0.0 { tips.max(2.0) + tips } else { tips }, "{cusps} {radius}");
        }
    }
}
