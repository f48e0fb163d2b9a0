//! The canonical measure of planar no-slip billiards.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{Billiard, canonical, fly, no_slip, specular},
    random::Stream,
    statistics::{Range, worst},
};
use billiards::{ReducedState, collision_laws::check::jacobian_determinant, geometry::tables, observe::Moments};
use core::ops::ControlFlow;
use nalgebra::{DVector, dvector};

pub(super) const CLAIM: Claim = Claim {
    name: "planar-measure",
    place: "Theorem 1.2",
    statement: "The billiard map of a planar no-slip billiard preserves the canonical billiard measure: in arc length and the velocities (v₀, vₜ) at unit \
                speed, Lebesgue measure.",
    verdict: Verdict::Holds,
    general_gamma: Some("Holds for every γ, and for every field of strict laws: see the claim measure-of-fields."),
    measure,
};

/// The step of the difference quotients of order 6. The map varies on a scale of a hundredth or more where no hit is flat, which leaves
/// (2e-4/1e-2)⁶ = 6e-11 times constants of order 10³ at the worst; rounding, 1e-16/2e-4, is less.
const STEP: f64 = 2e-4;
const TOLERANCE: f64 = 1e-7;

/// `|det| − 1` of one step of the map at a state; `None` near a corner or where a hit is flat.
fn defect(billiard: &Billiard, state: &ReducedState) -> Option<f64> {
    let next = billiard.map(state).ok()?;
    let steep = |s: &ReducedState| s.v0 * s.v0 + s.vt * s.vt < 0.8;
    if !(steep(state) && steep(&next)) {
        return None;
    }
    let step = |x: &DVector<f64>| {
        let image = billiard.map(&ReducedState { s: x[0], v0: x[1], vt: x[2], speed: 1.0, ..*state });
        // another piece is another formula, and so is a lap of a closed one
        let lap = 0.5 * billiard.table.pieces()[next.piece].length();
        let same = |y: &ReducedState| y.piece == next.piece && (y.s - next.s).abs() < lap;
        image.ok().filter(same).map_or(dvector![f64::NAN, f64::NAN, f64::NAN], |y| dvector![y.s, y.v0, y.vt])
    };
    let determinant = jacobian_determinant(step, &dvector![state.s, state.v0, state.vt], STEP);
    (!determinant.is_nan()).then(|| determinant.abs() - 1.0)
}

fn measure(effort: Effort) -> Measurement {
    let samples = effort.of(100, 2000);
    let mut quantities = vec![];
    let all = |gamma_squared: f64| {
        let tables = [
            ("circle", no_slip(tables::circle(1.0), gamma_squared)),
            ("stadium", no_slip(tables::stadium(1.0, 1.0), gamma_squared)),
            ("Sinai", no_slip(tables::sinai(1.0, 0.25), gamma_squared)),
            ("ellipse", no_slip(tables::ellipse([2.0, 1.0]), gamma_squared)),
        ];
        tables.map(|(name, billiard)| (format!("{name}, γ² = {gamma_squared}"), billiard))
    };
    let smooth = ("stadium, specular".to_string(), specular(tables::stadium(1.0, 1.0)));
    let mut fewest = Range::EMPTY;
    for (name, billiard) in all(UNIFORM).into_iter().chain(all(0.85)).chain([smooth]) {
        let mut defects = vec![];
        for sample in 0..samples {
            let mut stream = Stream::new(120, sample);
            let piece = sample % billiard.table.pieces().len();
            let s = stream.between(0.01, 0.99) * billiard.table.pieces()[piece].length();
            let [v0, vt] = stream.in_disk();
            defects.extend(defect(&billiard, &ReducedState { piece, s, v0, vt, speed: 1.0 }));
        }
        fewest.add(defects.len() as f64);
        quantities.push(Quantity::residual(
            format!("{name}: | |det| − 1 | at {} random states", defects.len()),
            worst(defects.into_iter().map(f64::abs)),
            TOLERANCE,
        ));
    }
    // both hits are steep with a probability of 0.64, and few states are near a corner
    let enough = 0.4 * samples as f64;
    quantities.push(Quantity::at_least("random states fit for difference quotients, fewest", fewest.min, enough, 0.0));
    // a sample of the measure, 20 collisions later, is one again: in the disk each square has the mean 1/4
    let stadium = no_slip(tables::stadium(1.0, 1.0), UNIFORM);
    let (mut spin, mut tangent, mut product) = (Moments::default(), Moments::default(), Moments::default());
    for start in (0..effort.of(20_000, 1_000_000)).map(canonical(&stadium, 121)) {
        fly(&stadium, start, 20, &mut |bounce| {
            if bounce.n == 20 {
                let (v0, vt) = (bounce.state.v[0], bounce.tangential_velocity());
                spin.add(v0 * v0);
                tangent.add(vt * vt);
                product.add(v0 * vt);
            }
            ControlFlow::Continue(())
        });
    }
    let [spin, tangent, product] = [spin, tangent, product].map(|sample| sample.mean());
    quantities.extend([
        Quantity::sampled(
            "stadium, 20 collisions after a canonical start: mean v₀²",
            spin.mean,
            spin.standard_error,
            0.25,
        ),
        Quantity::sampled("mean vₜ²", tangent.mean, tangent.standard_error, 0.25),
        Quantity::sampled("mean v₀ vₜ", product.mean, product.standard_error, 0.0),
    ]);
    quantities.into()
}
