//! A wedge of a millionth of a radian.

use billiards::geometry::tables;
use billiards::{Outcome, Start, Stop};

use super::super::Effort;
use super::super::law::Law;
use super::super::method::exact::{orbit, with_engine};
use super::super::state::{State, worse};
use super::{Entry, Tally};
use crate::simulation::Until;

pub(super) const SPECULAR: Entry = Entry {
    name: "thin specular wedge",
    summary: "into a wedge of 1e-6 rad and out again: as many collisions as wedge angles fit into the turn of the path",
    run: specular,
};

pub(super) const NO_SLIP: Entry = Entry {
    name: "thin no-slip wedge",
    summary: "along a wedge of 1e-6 rad: the angular momentum about the apex keeps its magnitude",
    run: no_slip,
};

/// Angle of the wedge.
const ANGLE: f64 = 1e-6;

/// The name of the known quantity.
const MOMENTUM: &str = "angular momentum about the apex";

/// `|x × v|`: every strict law conserves it, since an impulse on a wall of the wedge only reverses its sign.
fn momentum(s: &State<f64>) -> f64 {
    (s.position[0] * s.velocity[1] - s.position[1] * s.velocity[0]).abs()
}

/// Its change relative to `|x| |v|`, whose rounding it has.
fn moved(first: &State<f64>, now: &State<f64>) -> f64 {
    let length = |x: &[f64; 3]| libm::hypot(x[0], x[1]);
    (momentum(now) - momentum(first)).abs() / (length(&now.position) * length(&now.velocity))
}

/// From height 1 above the apex, at angles to the way down.
fn starts(many: u32) -> impl Iterator<Item = Start<2, 1>> {
    (0..many).map(move |k| {
        let (sin, cos) = libm::sincos(0.1 + f64::from(k) / f64::from(many));
        Start { position: [0.0, 1.0], velocity: [sin, -cos], spin: [0.0] }
    })
}

/// The path unfolds to a straight line, which turns by π − 2ψ as seen from the apex before it is at the same
/// height again.
fn specular(effort: Effort) -> Result<Tally, Box<dyn std::error::Error>> {
    let wedge = tables::wedge(ANGLE)?;
    let mut tally = Tally { known: MOMENTUM, ..Tally::default() };
    let many = if effort == Effort::Quick { 1 } else { 8 };
    let law = Law::Specular.planar();
    for start in starts(many) {
        let first = State::from_parts(&start.position, &start.velocity, &start.spin);
        let mut orbit = orbit::<2, 1>(&first);
        let until = Until { collisions: 4_000_000, time: f64::INFINITY };
        let Outcome { stop, collisions } = with_engine(&wedge, &law, |engine| engine.bare(&mut orbit, until));
        let now = State::from_parts(&orbit.position, &orbit.velocity, &orbit.spin);
        tally.error = worse(tally.error, moved(&first, &now));
        // in the end the straight line of the unfolded path has the angle π − ψ to the upward direction
        let turned = core::f64::consts::PI - libm::atan2(start.velocity[0], -start.velocity[1]);
        let right = libm::floor(turned / ANGLE + 0.5);
        tally.lost += u64::from(stop != Stop::Escaped || (collisions as f64 - right).abs() > 1.0);
        tally.orbits += 1;
        tally.collisions += collisions;
        *tally.stops.entry(stop.name()).or_default() += 1;
    }
    Ok(tally)
}

fn no_slip(effort: Effort) -> Result<Tally, Box<dyn std::error::Error>> {
    let wedge = tables::wedge(ANGLE)?;
    let collisions = if effort == Effort::Quick { 10_000 } else { 100_000 };
    let trial = super::Trial { table: &wedge, law: Law::NoSlip.planar(), collisions, open: true };
    let starts: Vec<_> = starts(16).collect();
    Ok(Tally { known: MOMENTUM, ..trial.watch(&starts, &moved) })
}
