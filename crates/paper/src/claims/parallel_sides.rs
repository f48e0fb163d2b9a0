//! Tables with two parallel sides.
use super::strip_width::phase;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{Billiard, State, bounces, fly, no_slip},
    random::Stream,
    strip::{centre, ladder},
};
use billiards::{
    Stop,
    geometry::{Error, Table, Vector2, tables},
};
use core::ops::ControlFlow;

pub(super) const CLAIM: Claim = Claim {
    name: "parallel-sides",
    place: "Section 1, Figure 5, and Section 3.3",
    statement: "The no-slip stadium is not ergodic, however short its straight sides: near the orbit perpendicular to them a set of positive measure \
                stays between them. The same holds for the stem of the mushroom and for the pocketed rectangle.",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "An orbit that starts between two parallel sides at a distance d stays if the width dℓ√(1+γ²)/γ about its middle fits on them, \
                         which is an open condition; if β/π is irrational and it does not fit, the orbit leaves. (Measured for γ² = 1/2, derived for others.)",
    ),
    measure,
};

/// Two parallel sides of a table: a strip, cut off.
struct Sides {
    name: &'static str,
    table: Result<Table, Error>,
    /// Distance and length of the sides.
    gap: f64,
    length: f64,
    /// Where the lower side of the strip starts, and whether it runs along x₂ in place of x₁.
    from: [f64; 2],
    upright: bool,
}

impl Sides {
    /// A state of the strip `0 < x₂ < gap`, on the table.
    fn place(&self, state: State) -> State {
        let turn = |[a, b]: [f64; 2]| if self.upright { [-b, a] } else { [a, b] };
        let State { x: [x0, x1, x2], v: [v0, v1, v2] } = state;
        let ([x1, x2], [v1, v2]) = (turn([x1, x2]), turn([v1, v2]));
        State { x: [x0, self.from[0] + x1, self.from[1] + x2], v: [v0, v1, v2] }
    }

    /// The numbers of the two sides.
    fn pieces(&self, table: &Table) -> [usize; 2] {
        [0.0, self.gap].map(|x2| {
            let State { x: [_, a, b], .. } = self.place(State { x: [0.0, 0.5 * self.length, x2], v: [0.0; 3] });
            table.closest(&Vector2::new(a, b)).0
        })
    }
}

/// How an orbit ends that is followed until it hits something other than the two sides.
fn watched(billiard: &Billiard, pieces: [usize; 2], start: State, most: usize) -> Stop {
    fly(billiard, start, most, &mut |bounce| {
        if pieces.contains(&bounce.piece) { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    })
}

/// The tables.
fn cases() -> [Sides; 4] {
    [
        Sides {
            name: "stadium",
            table: tables::stadium(1.0, 1.0),
            gap: 2.0,
            length: 2.0,
            from: [-1.0, -1.0],
            upright: false,
        },
        Sides {
            name: "stadium with sides of 0.02",
            table: tables::stadium(0.01, 1.0),
            gap: 2.0,
            length: 0.02,
            from: [-0.01, -1.0],
            upright: false,
        },
        Sides {
            name: "mushroom",
            table: tables::mushroom(1.0, 0.5, 0.75),
            gap: 0.5,
            length: 0.75,
            from: [0.25, -0.75],
            upright: true,
        },
        Sides {
            name: "pocketed rectangle",
            table: tables::pocket([2.0, 1.0], 0.3125, 0.5625),
            gap: 2.0,
            length: 1.0,
            from: [2.0, 0.0],
            upright: true,
        },
    ]
}

/// Which orbits stay between the sides of a table.
fn staying(sides: &Sides, samples: usize, collisions: u32) -> [Quantity; 3] {
    let gamma_squared = UNIFORM;
    let half_width = 0.5 * libm::sqrt(1.0 + gamma_squared) / libm::sqrt(gamma_squared);
    let billiard = no_slip(sides.table.clone(), gamma_squared);
    let strip = no_slip(tables::strip(sides.gap), gamma_squared);
    let pieces = sides.pieces(&billiard.table);
    // slopes that have a chance to fit: those of flights shorter than the sides
    let steepest = sides.length / sides.gap;
    // an orbit fills its width up to the square of this
    let phase = phase(f64::from(collisions));
    let (mut fit, mut fitting_leave, mut others_stay) = (0, 0, 0);
    for sample in 0..samples {
        let mut stream = Stream::new(140, sample);
        let [a, b] = stream.in_disk();
        let scale = steepest.min(1.0);
        let (v0, v1) = (a * scale, b * scale);
        let x1 = sides.length * stream.uniform();
        let start = State { x: [0.0, x1, 0.0], v: [v0, v1, libm::sqrt(1.0 - v0 * v0 - v1 * v1)] };
        let two = bounces(&strip, start, 2);
        let (middle, reach) = (centre(gamma_squared, &two[0], &two[1])[1], half_width * sides.gap * ladder(&start));
        let fits = middle - reach > 0.0 && middle + reach < sides.length;
        let stop = watched(&billiard, pieces, sides.place(start), collisions as usize);
        fit += usize::from(fits);
        fitting_leave += usize::from(fits && stop != Stop::Finished);
        let by_far =
            middle - reach * (1.0 - phase * phase) < 0.0 || middle + reach * (1.0 - phase * phase) > sides.length;
        others_stay += usize::from(by_far && stop != Stop::Observer);
    }
    let label = |what: &str| format!("{}: {what}", sides.name);
    let share = fit as f64 / samples as f64;
    [
        // some to follow: forty of the smaller sample
        Quantity::at_least(label("share of steep enough starts on a side whose width fits on it"), share, 0.02, 0.0),
        Quantity::count(label(&format!("of these {fit}, not staying for {collisions} collisions")), fitting_leave, 0),
        Quantity::count(label("starts whose width does not fit, not seen to leave"), others_stay, 0),
    ]
}

fn measure(effort: Effort) -> Measurement {
    let (samples, collisions) = (effort.of(2000, 20_000), effort.of(2000, 20_000));
    cases().iter().flat_map(|sides| staying(sides, samples, collisions)).collect::<Vec<_>>().into()
}
