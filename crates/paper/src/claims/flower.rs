//! The flower.
use super::arc_survival::{limit, survival};
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{fly, from_boundary, no_slip},
    random::Stream,
    statistics::standard_error_of_share,
};
use billiards::geometry::{Perimeter, tables};
use core::ops::ControlFlow;

pub(super) const CLAIM: Claim = Claim {
    name: "flower",
    place: "Section 3.3",
    statement: "By Remark 2 the no-slip flower is not ergodic, and by this remark and their parallel sides neither are pocket billiards.",
    verdict: Verdict::False(
        "Remark 2 does not hold, so it shows nothing about the flower: the share of orbits still on a petal after N hits is C/N, with the constant of the claim arc-survival. \
         For pocket billiards the parallel sides alone prevent ergodicity: see parallel-sides.",
    ),
    general_gamma: Some("For every γ (derived, not measured)."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (samples, most) = (effort.of(400_000, 8_000_000), effort.of(250, 6250));
    let flower = no_slip(tables::flower(4, 1.25, 2.0), UNIFORM);
    let perimeter = Perimeter::of(&flower.table).expect("a finite boundary");
    let mut survival = survival(most);
    for sample in 0..samples {
        let mut stream = Stream::new(190, sample);
        let at = perimeter.point(stream.uniform());
        let mut hits = 0;
        fly(&flower, from_boundary(at, stream.in_disk()), most, &mut |bounce| {
            if bounce.piece != at.piece {
                return ControlFlow::Break(());
            }
            hits = bounce.n;
            ControlFlow::Continue(())
        });
        survival.add(hits as u64);
    }
    // a side of 2 is the chord of a petal
    let limit = limit(2.0 * libm::asin(1.0 / 1.25), UNIFORM);
    let quantity = |(n, count): (u64, u64)| {
        let (share, n) = (count as f64 / samples as f64, n as f64);
        let error = n * standard_error_of_share(limit / n, samples);
        let label = format!("{n} × share still on its petal after {n} hits");
        // hits come in pairs: a correction of relative size 2/n
        Quantity::sampled_near(label, n * share, error, limit, 2.0 / n * limit)
    };
    Measurement { quantities: survival.survivors().map(quantity).collect() }
}
