//! Mean free paths.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{canonical, fly, no_slip, specular},
};
use billiards::{
    geometry::{Error, Table, tables},
    observe::{Mean, Moments},
};
use core::{f64::consts::PI, ops::ControlFlow};

pub(super) const CLAIM: Claim = Claim {
    name: "mean-free-path",
    place: "beyond the paper",
    statement: "Over the canonical measure the mean flight between collisions on a table of area A and perimeter P is 4A/P in (x₀, x₁, x₂), πA/P in the plane, \
                and 2A/P in |x₀|, after any number of collisions and for every strict law.",
    verdict: Verdict::Holds,
    general_gamma: Some("As stated: neither γ nor the law enters."),
    measure,
};

/// Mean flight `n`: its length in three dimensions, in the plane, and in `|x₀|`.
fn flights(table: &Result<Table, Error>, smooth: bool, n: usize, samples: usize) -> [Mean; 3] {
    let billiard = if smooth { specular(table.clone()) } else { no_slip(table.clone(), UNIFORM) };
    let mut means = [Moments::default(); 3];
    for start in (0..samples).map(canonical(&billiard, 160 + n as u64)) {
        let (mut time, mut v) = (0.0, start.v);
        fly(&billiard, start, n, &mut |bounce| {
            if bounce.n == n {
                let flight = bounce.time - time;
                means[0].add(flight);
                means[1].add(flight * libm::hypot(v[1], v[2]));
                means[2].add(flight * v[0].abs());
            }
            (time, v) = (bounce.time, bounce.state.v);
            ControlFlow::Continue(())
        });
    }
    means.map(|flights| flights.mean())
}

fn measure(effort: Effort) -> Measurement {
    let samples = effort.of(10_000, 400_000);
    let mut quantities = vec![];
    for (name, table) in [
        ("circle", tables::circle(1.0)),
        ("equilateral triangle", tables::equilateral(1.0)),
        ("stadium", tables::stadium(1.0, 1.0)),
        ("mushroom", tables::mushroom(1.0, 0.5, 0.75)),
        ("flower", tables::flower(4, 1.25, 2.0)),
        ("Sinai", tables::sinai(1.0, 0.25)),
        // a finite horizon, R > √3/4: without one the variance is infinite
        ("triangular Lorentz gas", tables::lorentz(0.45, 1.0)),
    ] {
        let shape = table.as_ref().expect("a table with parameters in range");
        let scale = shape.area() / shape.perimeter();
        // the first flight knows nothing of the law; nor would the fifth in a circle, where two collisions undo each other
        for (law, smooth, n) in [("either law", false, 1), ("no-slip", false, 6), ("specular", true, 6)] {
            let means = flights(&table, smooth, n, samples);
            for ((what, expected), mean) in [("time", 4.0), ("planar path", PI), ("|Δx₀|", 2.0)].into_iter().zip(means)
            {
                let label = format!("{name}, {law}, flight {n}: mean {what} × P/A");
                quantities.push(Quantity::sampled(label, mean.mean / scale, mean.standard_error / scale, expected));
            }
        }
    }
    quantities.into()
}
