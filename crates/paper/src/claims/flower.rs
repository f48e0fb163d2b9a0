//! The flower.
use super::arc_survival::{limit, survival};
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{canonical, fly, no_slip},
    statistics::standard_error_of_share,
};
use billiards::geometry::{Vector2, tables};
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
    let mut survival = survival(most);
    for start in (0..samples).map(canonical(&flower, 190)) {
        let [_, x1, x2] = start.x;
        let (petal, _) = flower.table.closest(&Vector2::new(x1, x2));
        let mut hits = 0;
        fly(&flower, start, most, &mut |bounce| {
            if bounce.piece != petal {
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
