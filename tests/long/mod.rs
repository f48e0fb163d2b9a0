//! What never changes along an orbit, and how well long orbits keep it.
//!
//! Shared by `tests/long_runs.rs` and `examples/long_runs.rs`.
use billiards::collision_laws::laws::{NoSlip, Specular};
use billiards::geometry::{
    Error, GOLDEN_RATIO, Table, Vector2,
    shapes::{Ellipse, FullLine},
    tables,
};
use billiards::observe::EnergyDrift;
use billiards::{Angle, Clock, Collisions, Conserved, Orbit, Planar, Timed, laws::Disk};

/// γ² = 1/2, a uniform disk.
pub(crate) const GAMMA: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// An orbit of which time and spin position are tracked.
pub(crate) type Tracked = Orbit<f64, 2, 1, Conserved<f64, 2>, (Clock, Angle)>;

/// An orbit at its start.
pub(crate) fn start(position: [f64; 2], velocity: [f64; 2], spin: f64) -> Tracked {
    Orbit::new(position, velocity, [spin], (Clock::new(0.0), Angle::new(0.0)))
}

/// A table and a law with quantities that are conserved from every second collision to the next.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) billiard: Planar<Disk>,
    /// The start of an orbit, by its number.
    pub(crate) start: fn(u32) -> Tracked,
    /// The quantities right after a collision, each in units of its size.
    pub(crate) quantities: fn(&Tracked) -> Vec<f64>,
}

fn specular() -> Disk {
    Disk::new(&Specular, GAMMA).unwrap()
}
fn no_slip() -> Disk {
    Disk::new(&NoSlip, GAMMA).unwrap()
}

/// A number in [0, 1) that looks random, different for each orbit and each `k`.
pub(crate) fn any(orbit: u32, k: u32) -> f64 {
    let golden = GOLDEN_RATIO * f64::from(orbit * 8 + k + 1);
    golden - golden.floor()
}

/// A velocity and a spin of size one, not along an axis.
fn heading(orbit: u32) -> ([f64; 2], f64) {
    let (angle, spin) = (6.0 * any(orbit, 0) + 0.1, 0.9 * (any(orbit, 1) - 0.5));
    ([libm::cos(angle), libm::sin(angle)], spin)
}

/// The right angle of opening of the wedge.
const WEDGE: f64 = 1.0;

/// `(v₀, v·t, v·ν)` on the unit circle.
fn on_circle(o: &Tracked) -> [f64; 3] {
    let ([x, y], [vx, vy]) = (o.position, o.velocity);
    let r = libm::hypot(x, y);
    [o.spin[0], (vx * y - vy * x) / r, -(vx * x + vy * y) / r]
}

fn momentum(o: &Tracked, about: [f64; 2]) -> f64 {
    (o.position[0] - about[0]) * o.velocity[1] - (o.position[1] - about[1]) * o.velocity[0]
}

/// Every integrable table of which all is known.
pub(crate) fn cases() -> Result<Vec<Case>, Error> {
    Ok(vec![
        Case {
            name: "circle, no-slip: v0, vt, vn and both caustics",
            billiard: Planar { table: tables::circle(1.0)?, law: no_slip() },
            start: |i| {
                let (v, w) = heading(i);
                start([0.4 * any(i, 2), 0.4 * any(i, 3)], v, w)
            },
            quantities: |o| {
                let [spin, tangent, normal] = on_circle(o);
                let (sin, cos) = (2.0 * GAMMA / (1.0 + GAMMA * GAMMA), (1.0 - GAMMA * GAMMA) / (1.0 + GAMMA * GAMMA));
                let caustic = |tangent: f64| tangent.abs() / libm::hypot(tangent, normal);
                vec![spin, tangent, normal, caustic(tangent), caustic(sin * spin + cos * tangent)]
            },
        },
        Case {
            name: "strip, no-slip: contact lines, ladder",
            billiard: Planar { table: tables::strip(1.0)?, law: no_slip() },
            start: |i| start([0.0, 0.5], [0.6 * any(i, 0) + 0.2, -0.8], 0.9 * (any(i, 1) - 0.5)),
            quantities: |o| {
                // between collisions with the lower wall the velocity (v0, v1) turns at the upper one, half a turn about (γ, 1)
                let line = o.position[0] - o.track.1.0.value() / GAMMA;
                let ladder = libm::hypot(o.velocity[0], o.spin[0]) / o.velocity[1];
                vec![line, ladder, o.velocity[1]]
            },
        },
        Case {
            name: "strip askew, no-slip: contact lines, ladder",
            billiard: Planar { table: strip_askew()?, law: no_slip() },
            start: |i| {
                let (along, across) = (0.6 * any(i, 0) + 0.2, -0.8);
                start([0.0; 2], askew([along, across]), 0.9 * (any(i, 1) - 0.5))
            },
            quantities: |o| {
                let [c, s] = ASKEW;
                let along = |[x, y]: [f64; 2]| x * c + y * s;
                let normal = o.velocity[1] * c - o.velocity[0] * s;
                let line = along(o.position) - o.track.1.0.value() / GAMMA;
                vec![line, libm::hypot(along(o.velocity), o.spin[0]) / normal, normal]
            },
        },
        Case {
            name: "wedge, no-slip: |v·b| and I",
            billiard: Planar { table: tables::wedge(WEDGE)?, law: no_slip() },
            // near the axis b, so that the orbit stays for ever
            start: |i| {
                let [b0, b1] = wedge_axis();
                start([0.1 * any(i, 0), 1.0], [b1, 0.3 * (any(i, 1) - 0.5)], b0)
            },
            quantities: |o| {
                let [b0, b1] = wedge_axis();
                let ([x, y], [vx, vy]) = (o.position, o.velocity);
                vec![(b0 * o.spin[0] + b1 * vx).abs(), (x * vy - y * vx).abs()]
            },
        },
        Case {
            name: "circle, specular: angular momentum",
            billiard: Planar { table: tables::circle(1.0)?, law: specular() },
            start: |i| {
                let (v, w) = heading(i);
                start([0.4 * any(i, 2), 0.4 * any(i, 3)], v, w)
            },
            quantities: |o| vec![momentum(o, [0.0; 2]), o.spin[0]],
        },
        Case {
            name: "ellipse, specular: product of momenta about the foci",
            billiard: Planar { table: tables::ellipse([2.0, 1.0])?, law: specular() },
            start: |i| {
                let (v, w) = heading(i);
                start([any(i, 2), 0.5 * any(i, 3)], v, w)
            },
            quantities: |o| {
                let c = 3.0_f64.sqrt();
                vec![momentum(o, [c, 0.0]) * momentum(o, [-c, 0.0])]
            },
        },
        Case {
            name: "ellipse askew, specular: the same",
            billiard: Planar { table: ellipse_askew()?, law: specular() },
            start: |i| {
                let (v, w) = heading(i);
                start([0.4 * any(i, 2), 0.4 * any(i, 3)], v, w)
            },
            quantities: |o| {
                let (sin, cos) = libm::sincos(TILT);
                let c = [0.75_f64.sqrt() * cos, 0.75_f64.sqrt() * sin];
                vec![momentum(o, c) * momentum(o, c.map(|c| -c))]
            },
        },
    ])
}

/// Along the walls of the strip askew; the sum of the squares of the components as rounded is not 1 to the last bit.
const ASKEW: [f64; 2] = [0.8, 0.6];

/// The vector with components along and across the walls of the strip askew.
fn askew([x, y]: [f64; 2]) -> [f64; 2] {
    let [c, s] = ASKEW;
    [x * c - y * s, x * s + y * c]
}

/// A strip of width 1 about the origin.
fn strip_askew() -> Result<Table, Error> {
    let line = |along: f64| FullLine::new(askew([0.0, -0.5 * along]).into(), Vector2::from(ASKEW) * along);
    Table::new(vec![Box::new(line(1.0)?), Box::new(line(-1.0)?)])
}

/// The angle of the ellipse askew.
const TILT: f64 = 0.7;

fn ellipse_askew() -> Result<Table, Error> {
    Table::new(vec![Box::new(Ellipse::new(Vector2::zeros(), [1.0, 0.5], TILT, true)?)])
}

/// The components of the unit vector b along v0 and x1.
fn wedge_axis() -> [f64; 2] {
    let b0 = libm::sin(0.5 * WEDGE) / GAMMA;
    let length = libm::hypot(b0, 1.0);
    [b0 / length, 1.0 / length]
}

/// The root of the mean square, over so many orbits, of the largest change of a quantity after each number of collisions.
pub(crate) fn drifts(case: &Case, orbits: u32, checkpoints: &[u64]) -> Vec<f64> {
    let mut squares = vec![0.0; checkpoints.len()];
    for i in 0..orbits {
        let mut orbit = (case.start)(i);
        // from the second collision, so that the same wall and the same phase are compared; in the strips from the lower wall
        let first = if case.name.starts_with("strip") { 3 } else { 2 };
        case.billiard.run(&mut orbit, &Collisions(first), &mut ());
        let before = (case.quantities)(&orbit);
        let mut made = 0;
        for (square, n) in squares.iter_mut().zip(checkpoints) {
            let outcome = case.billiard.run(&mut orbit, &Collisions(n - made), &mut ());
            assert_eq!(outcome.collisions, n - made, "{}: {:?}", case.name, outcome.stop);
            made = *n;
            let changes = (case.quantities)(&orbit).into_iter().zip(&before).map(|(now, before)| (now - before).abs());
            let worst = changes.fold(0.0, f64::max);
            *square += worst * worst / f64::from(orbits);
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// The exponent `p` of `drift ∝ Nᵖ`, by least squares in the logarithms.
pub(crate) fn exponent(checkpoints: &[u64], drifts: &[f64]) -> f64 {
    let points: Vec<[f64; 2]> =
        checkpoints.iter().zip(drifts).map(|(n, d)| [libm::log(*n as f64), libm::log(d.max(f64::EPSILON))]).collect();
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let [covariance, variance] =
        points.iter().fold([0.0; 2], |[c, v], p| [c + (p[0] - x) * (p[1] - y), v + (p[0] - x) * (p[0] - x)]);
    covariance / variance
}

/// Tables and laws whose energy is watched.
pub(crate) fn energies() -> Result<Vec<(String, Planar<Disk>)>, Error> {
    let mut all = vec![];
    for (law, disk) in [("no-slip", no_slip()), ("specular", specular())] {
        for (name, table) in [
            ("circle", tables::circle(1.0)?),
            ("square", tables::square(1.0)?),
            ("stadium", tables::stadium(1.0, 1.0)?),
            ("sinai", tables::sinai(1.0, 0.25)?),
        ] {
            all.push((format!("{name}, {law}"), Planar { table, law: disk }));
        }
    }
    Ok(all)
}

/// The largest relative change of the energy in so many collisions, looked at `looks` times; other orbits take over from
/// those that end in a corner.
pub(crate) fn energy_drift(billiard: &Planar<Disk>, collisions: u64, looks: u64) -> f64 {
    let mut worst: f64 = 0.0;
    let (mut left, mut i) = (collisions, 0);
    while left > 0 {
        let (v, w) = heading(i);
        i += 1;
        // in every one of these tables, and off the scatterer
        let mut orbit = start([0.13 + 0.05 * any(i, 2), 0.11], v, w);
        let mut drift = EnergyDrift::of(&orbit);
        let step = (collisions / looks).max(1);
        while left > 0 {
            if step == 1 {
                // an orbit of its own, not one that starts anew at every collision
                left -= billiard.run(&mut orbit, &Collisions(left), &mut drift).collisions;
                break;
            }
            let outcome = billiard.run(&mut orbit, &Collisions(step.min(left) - 1), &mut ());
            let last = billiard.run(&mut orbit, &Collisions(1), &mut drift);
            left -= (outcome.collisions + last.collisions).min(left);
            if last.collisions == 0 {
                break;
            }
        }
        worst = worst.max(drift.largest());
    }
    worst
}

/// The largest relative change of the energy of restored states, at every one of so many collisions.
pub(crate) fn restored_drift(billiard: &Planar<Disk>, collisions: u64) -> f64 {
    let (v, w) = heading(3);
    let mut orbit = start([0.13, 0.11], v, w);
    let first = EnergyDrift::of(&orbit);
    let mut worst: f64 = 0.0;
    for _ in 0..collisions {
        billiard.run(&mut orbit, &Collisions(1), &mut ());
        let mut seen = orbit;
        (seen.velocity, seen.spin) = orbit.restored();
        worst = worst.max(first.now(&seen));
    }
    worst
}

/// The error of the position in the unit square at a time, against unfolding in exact arithmetic: the largest of 64 orbits in all directions.
pub(crate) fn unfolding_error(time: u32) -> Result<f64, Error> {
    let square = Planar { table: tables::square(1.0)?, law: specular() };
    Ok((0..64).map(|k| unfolding_error_of(&square, time, 0.05 + 0.098 * f64::from(k))).fold(0.0, f64::max))
}

/// The same of an orbit in about this direction (radians).
fn unfolding_error_of(square: &Planar<Disk>, time: u32, direction: f64) -> f64 {
    // multiples of 2⁻³⁰: the unfolded place is a sum of exact products
    let unit = 1.0 / f64::from(1_u32 << 30);
    let (sin, cos) = libm::sincos(direction);
    let [x, v] =
        [[412_345_679.0 * unit, 287_654_321.0 * unit], [cos, sin]].map(|a| a.map(|a| libm::round(a / unit) * unit));
    let mut orbit = start(x, v, 0.0);
    square.run(&mut orbit, &billiards::Time(f64::from(time)), &mut ());
    let rest = (f64::from(time) - orbit.track.0.0.high) - orbit.track.0.0.low;
    assert!(rest >= 0.0 && orbit.track.time() <= f64::from(time));
    let mut worst: f64 = 0.0;
    for k in 0..2 {
        // in units of 2⁻³⁰, modulo two sides
        #[allow(clippy::cast_possible_truncation, reason = "whole numbers below 2³⁰")]
        let [place, speed] = [x[k] / unit, v[k] / unit].map(|a| a as i64);
        let period = 1_i64 << 31;
        let unfolded = (place + speed * i64::from(time)).rem_euclid(period);
        let folded = unfolded.min(period - unfolded) as f64 * unit;
        worst = worst.max((orbit.position[k] + rest * orbit.velocity[k] - folded).abs());
    }
    worst
}
