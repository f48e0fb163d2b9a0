//! Long orbits keep what is conserved; `examples/long_runs.rs` measures the same at full length.
mod long;
mod phase;

use long::{cases, drifts, energies, energy_drift, exponent, restored_drift, unfolding_error};

/// 10³ … 10⁵ collisions, four per decade.
const CHECKPOINTS: [u64; 9] = [1000, 1778, 3162, 5624, 10_000, 17_782, 31_622, 56_234, 100_000];

#[test]
fn time_is_so_exact_that_a_place_in_the_square_at_time_100_000_is_right() {
    // two hundred thousand flights: a sum with rounding would be off by about 10⁻⁸
    let error = unfolding_error(100_000).unwrap();
    assert!(error <= 1e-11, "{error:e}");
}

#[test]
fn energy_is_kept_to_the_last_digit() {
    for (name, billiard) in energies().unwrap() {
        // restored at every sixteenth collision, to four units of 2⁻⁵³, the rounding of the velocity's own components, which one
        // collision rounds by twice as much again, and half as much more where the normal is an arc's (1.3·10⁻¹⁵, of a thousand looks)
        // or a scatterer's (1.6·10⁻¹⁵)
        let restored = energy_drift(&billiard, 800_000, 100);
        assert!(restored <= 15.0 * 0.5 * f64::EPSILON, "{name}: {restored:e}");
        // in between, that and what seventeen collisions round: about 4·10⁻¹⁶ each, at worst all alike
        let anywhere = energy_drift(&billiard, 100_000, 100_000);
        assert!(anywhere <= 1e-14, "{name}: {anywhere:e}");
    }
}

#[test]
fn a_restored_state_has_the_energy_of_the_start_wherever_it_is_asked_for() {
    for (name, billiard) in energies().unwrap() {
        let drift = restored_drift(&billiard, 10_000);
        assert!(drift <= 4e-16, "{name}: {drift:e}");
    }
}

#[test]
fn energy_does_not_drift() {
    for (name, billiard) in energies().unwrap() {
        let [early, late] = [10_000, 1_000_000].map(|n| energy_drift(&billiard, n, n));
        // the largest of a hundred times as many roundings of one collision is a little larger, a drift a hundred times
        assert!(late <= 2.5 * early.max(2e-16), "{name}: {early:e}, then {late:e}");
    }
}

#[test]
fn energy_does_not_drift_when_orbits_are_resumed_over_and_over() {
    for (name, billiard) in energies().unwrap() {
        // twenty thousand runs: what each of them rounds once more would add up to 10⁻¹²
        let drift = energy_drift(&billiard, 100_000, 10_000);
        assert!(drift <= 1e-14, "{name}: {drift:e}");
    }
}

#[test]
fn invariants_wander_like_a_random_walk_at_most() {
    // √N at most, and at a rate that leaves an rms of 10⁻¹² at 10⁷
    for case in cases().unwrap() {
        let drifts = drifts(&case, 64, &CHECKPOINTS);
        let exponent = exponent(&CHECKPOINTS, &drifts);
        // ½, and what 64 orbits scatter about that
        assert!(exponent <= 0.6, "{}: N^{exponent:.2}, {:e}", case.name, drifts[8]);
        assert!(drifts[8] <= 1e-13, "{}: {:e}", case.name, drifts[8]);
    }
}

#[test]
fn the_angle_on_a_circle_follows_the_closed_form() {
    for (name, law, gamma) in phase::laws() {
        let error = phase::error(law, gamma, 10_000_000, 10_000_000).unwrap();
        // at most linear in the number of collisions, so below 10⁻⁷ at 10⁹: 5·10⁻¹⁷ for each, half a rounding of the angle
        assert!(error <= 5e-10, "{name}: {error:e}");
    }
}

#[test]
fn the_angle_on_a_circle_follows_the_closed_form_when_orbits_are_resumed_over_and_over() {
    for (name, law, gamma) in phase::laws() {
        // ten thousand runs, of which each rounds the place once more: 10⁻¹⁶ at random. If they rounded the velocity too, their
        // turns would be off by up to √10⁴ times as much, in each of 10⁶ collisions
        let error = phase::error(law, gamma, 1_000_000, 100).unwrap();
        assert!(error <= 1e-10, "{name}: {error:e}");
    }
}
