//! The angle at which an orbit in a circle hits, against the closed form in 200 bits.
//!
//! Shared by `tests/long_runs.rs` and `examples/long_runs.rs`.
#[path = "../oracle/number.rs"]
#[allow(dead_code, reason = "the oracle uses the rest")]
mod number;

use crate::long::{GAMMA, start};
use billiards::collision_laws::laws::{NoSlip, Specular};
use billiards::geometry::{Error, tables};
use billiards::{Collisions, Planar, laws::Disk};
use number::{Vector, add, big, cross, dot, left, norm, root, scale, small, vector};

/// The laws, by name, each with the γ at which no-slip is the same.
pub(crate) fn laws() -> [(&'static str, Disk, f64); 2] {
    [("no-slip", Disk::new(&NoSlip, GAMMA).unwrap(), GAMMA), ("specular", Disk::new(&Specular, GAMMA).unwrap(), 0.0)]
}

/// `a b` as complex numbers.
fn times(a: &Vector, b: &Vector) -> Vector {
    [&a[0] * &b[0] - &a[1] * &b[1], &a[0] * &b[1] + &a[1] * &b[0]]
}

/// Starts: position, velocity, spin.
pub(crate) const STARTS: [([f64; 2], [f64; 2], f64); 4] = [
    ([0.125, 0.25], [0.8125, 0.40625], 0.3125),
    ([-0.3, 0.1], [0.1, 0.7], -0.4),
    ([0.05, -0.6], [-0.9, 0.2], 1.3),
    ([0.7, 0.3], [0.31, -0.57], 0.123),
];

/// How far the worst of some orbits in the unit circle is off the place that the closed form has after so many collisions, if
/// they are run in parts of `part`.
pub(crate) fn error(law: Disk, gamma: f64, collisions: u64, part: u64) -> Result<f64, Error> {
    STARTS.iter().try_fold(0.0, |worst: f64, start| Ok(worst.max(off(law, gamma, start, collisions, part)?)))
}

/// How far an orbit in the unit circle is off the place that the closed form has after an even number of collisions.
///
/// The velocity in the collision frame has period two, and per collision the place turns by `2 θ + π`, with
/// `tan θ = v·t / v·ν` after it: two turns are one multiplication by `((n + iτ₁)(n + iτ₂))² / …`.
fn off(
    law: Disk,
    gamma: f64,
    &([x, y], v, w): &([f64; 2], [f64; 2], f64),
    collisions: u64,
    part: u64,
) -> Result<f64, Error> {
    let collisions = collisions - collisions % 2 + 1;
    let circle = Planar { table: tables::circle(1.0)?, law };
    let mut orbit = start([x, y], v, w);
    let mut made = 0;
    while made < collisions {
        let outcome = circle.run(&mut orbit, &Collisions(part.min(collisions - made)), &mut ());
        assert!(outcome.collisions > 0, "{outcome:?}");
        made += outcome.collisions;
    }

    // the first hit: |x + t v| = 1
    let (x, v) = (vector([x, y]), vector(v));
    let (a, b, c) = (dot(&v, &v), dot(&x, &v), dot(&x, &x) - big(1.0));
    let time = (root(&(&b * &b - &a * c)) - b) / a;
    let hit = add(&x, &scale(&v, &time));
    let normal = scale(&hit, &big(-1.0));
    let (n, tangent) = (-dot(&v, &normal), dot(&v, &left(&normal)));
    // after the first collision, and after the second
    let square = big(gamma) * big(gamma);
    let (sin, cos) = (big(2.0) * big(gamma) / (big(1.0) + &square), (big(1.0) - &square) / (big(1.0) + square));
    let first = &sin * big(w) + cos * &tangent;
    let mut turn = times(&[n.clone(), first], &[n, tangent]);
    turn = times(&turn, &turn);
    turn = scale(&turn, &(big(1.0) / norm(&turn)));
    let mut place = hit;
    let mut power = collisions / 2;
    while power > 0 {
        if power % 2 == 1 {
            place = times(&place, &turn);
        }
        turn = times(&turn, &turn);
        power /= 2;
    }
    let at = vector(orbit.position);
    Ok(libm::atan2(small(&cross(&place, &at)), small(&dot(&place, &at))).abs())
}
