//! How many digits are left after millions of collisions?
//!
//! Expected: the energy is kept to the last digit whatever the length; the other invariants of integrable tables lose little; the time is
//! so exact that the position in a square at t = 10⁵ is right to 10⁻¹¹; and on a circle, after a hundred times as many collisions, the
//! angle differs from the closed form by at most 10⁻¹⁶ per collision (and 10⁻¹⁵ for each part of the run).
//!
//! `cargo run --release --example long_runs -- 10000000` for ten million collisions; the default is 10⁵.
#[path = "../tests/long/mod.rs"]
mod long;
#[path = "../tests/phase/mod.rs"]
mod phase;

use billiards::geometry::Error;

fn main() -> Result<(), Error> {
    let argument = std::env::args().nth(1);
    let count: u64 = argument.and_then(|count| count.parse().ok()).unwrap_or(100_000);
    // five per decade; even, so that both walls or both phases have had their turn
    let mut checkpoints: Vec<u64> = vec![];
    let mut n = 1000.0;
    while n <= count as f64 {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive and below 2⁵³")]
        checkpoints.push(2 * (0.5 * n) as u64);
        n *= libm::pow(10.0, 0.2);
    }
    let turns = 100 * count;
    for (name, law, gamma) in phase::laws() {
        for part in [turns, 4096] {
            let error = phase::error(law, gamma, turns, part)?;
            println!("circle, {name:<8}, error of the angle after {turns} collisions, {part} at a time   {error:.1e}");
            assert!(error <= 1e-16 * turns as f64 + 1e-15 * (turns / part) as f64, "{name}");
        }
    }
    println!("rms drift of conserved quantities in up to {count} collisions, over 32 orbits");
    for case in long::cases()? {
        let drifts = long::drifts(&case, 32, &checkpoints);
        let (last, exponent) = (drifts[drifts.len() - 1], long::exponent(&checkpoints, &drifts));
        println!("  {:<54} {last:.1e}, like N^{exponent:.2}", case.name);
        // a random walk
        assert!(last < 2e-12 * (1e-7 * count as f64).sqrt(), "{}", case.name);
    }
    println!("largest relative drift of the energy in {count} collisions, and of restored states in 10000");
    for (name, billiard) in long::energies()? {
        let (drift, restored) =
            (long::energy_drift(&billiard, count, 100_000), long::restored_drift(&billiard, 10_000));
        println!("  {name:<54} {drift:.1e}, {restored:.1e}");
        assert!(drift < 1e-14 && restored <= 4e-16, "{name}");
    }
    let error = long::unfolding_error(100_000)?;
    println!("unit square, error of the position at t = 1e5, 64 orbits   {error:.1e}");
    assert!(error <= 1e-10);
    Ok(())
}
