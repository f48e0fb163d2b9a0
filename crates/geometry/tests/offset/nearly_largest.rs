//! Disks that all but fill the table.
use super::*;
use geometry::shapes::curve::{Interval, Polar, PolarFormula};

/// `r = 1.5 + 0.2 cos 3φ`
#[derive(Clone, Copy, Debug)]
struct Clover;

impl PolarFormula for Clover {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(3.0 * angle);
        [1.5 + 0.2 * cos, -0.6 * sin, -1.8 * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [sin, cos] = (angle * 3.0).sin_cos();
        [cos * 0.2 + 1.5, sin * -0.6, cos * -1.8]
    }
}

#[test]
fn the_larger_a_disk_the_less_is_left_of_it_until_rounding_decides_and_then_nothing() {
    let clover = table(Polar::new(v(0.0, 0.0), Clover, true).unwrap().pieces());
    let ellipse = Box::new(Ellipse::new(v(0.1, 0.2), [2.0, 1.0], 0.3, true).unwrap());
    for (name, drawn, largest) in [
        ("ellipse", table(vec![ellipse]), 1.0),
        ("clover", clover, 1.3),
        ("triangle", tables::equilateral(1.0).unwrap(), 3_f64.sqrt() / 6.0),
        ("moon", tables::moon(1.0, 0.5, 0.75).unwrap(), 0.625),
    ] {
        let mut last = 0;
        for k in 8..60 {
            let radius = largest * (1.0 - 1.5 * libm::ldexp(1.0, -k));
            let now = match drawn.offset(radius) {
                Ok(left) => {
                    assert!(left.table.area() < drawn.area() * libm::ldexp(1.0, -(k - 4)), "{name}, {radius}");
                    0
                }
                Err(Error::Undecided { .. }) => 1,
                Err(Error::NothingLeft { largest, .. }) if largest <= radius => 2,
                Err(error) => panic!("{name}, {radius}: {error}"),
            };
            assert!(last <= now, "{name}, {radius}: {now} after {last}");
            last = now;
        }
        assert!(last > 0, "{name}");
    }
}

#[test]
fn what_is_left_between_curves_is_wider_than_their_rounding_or_refused() {
    let clover = table(Polar::new(v(0.0, 0.0), Clover, true).unwrap().pieces());
    for (room, fits) in [(1e-6, true), (1e-9, true), (1e-11, false), (1e-12, false), (1e-13, false)] {
        let left = clover.offset(1.3 * (1.0 - room));
        assert!(if fits { left.is_ok() } else { matches!(left, Err(Error::Undecided { .. })) }, "{room}: {left:?}");
    }
}
