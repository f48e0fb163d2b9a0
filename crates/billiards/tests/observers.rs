//! What the observers see, against closed forms.
use billiards::{
    Angle, Canonical, CanonicalSpatial, Cell, Clock, Collision, Collisions, Conserved, Ensemble, Error, Grid, Merge,
    Orbit, Planar, Starts, Stop, Time,
    laws::{Disk, Specular},
    observe::{
        Density, EnergyDrift, FirstReturn, FreePath, Invariant, Nearest, Period, PlanarRow, Record, ReducedPortrait,
        Survival, VelocityPortrait,
    },
};
use collision_laws::laws::{NoSlip, Restitution};
use core::{f64::consts::FRAC_1_SQRT_2, ops::ControlFlow};
use geometry::tables;
use serde_json::Value;
use std::{path::Path, sync::Arc};

fn closed_forms() -> Value {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/closed_forms.json");
    serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap()
}
fn number(v: &Value) -> f64 {
    v.as_str().unwrap().parse().unwrap()
}
fn no_slip(gamma_squared: f64) -> Disk {
    Disk::new(&NoSlip, gamma_squared.sqrt()).unwrap()
}
fn orbit(x: [f64; 2], v: [f64; 2], v0: f64) -> Orbit<f64, 2, 1, Conserved<f64, 2>> {
    Orbit::new(x, v, [v0], ())
}

#[test]
fn caustics_and_flight_times_of_a_circle_are_those_of_the_closed_form() {
    let forms = closed_forms();
    let cases = forms["circle"].as_array().unwrap();
    assert!(!cases.is_empty());
    for case in cases {
        let circle = Planar { table: tables::circle(1.0).unwrap(), law: no_slip(number(&case["gamma_squared"])) };
        let velocity = &case["post_velocity"];
        let [v0, tau, n] = ["v0", "tau", "n"].map(|key| number(&velocity[key]));
        // on the right of the circle: ν = (−1, 0), t = (0, −1)
        let mut orbit = orbit([1.0, 0.0], [-n, -tau], v0);
        let mut seen = (Nearest::to([0.0, 0.0], &orbit), FreePath::new());
        seen.1.follow(&orbit);
        assert_eq!(circle.run(&mut orbit, &Collisions(1000), &mut seen).stop, Stop::Finished);
        let [r1, r2] = [0, 1].map(|i| number(&case["caustic_radii"][i]).abs());
        let [t1, t2] = [0, 1].map(|i| number(&case["flight_times"][i]));
        let planar =
            [number(&velocity["tau"]), number(&case["other_post_velocity"]["tau"])].map(|tau| libm::hypot(tau, n));
        // a thousand collisions, a few roundings each
        let tolerance = 4000.0 * f64::EPSILON;
        assert!((seen.0.distance() - r1.min(r2)).abs() < tolerance);
        assert!((seen.1.time().mean - 0.5 * (t1 + t2)).abs() < tolerance * t1);
        assert!((seen.1.length().mean - 0.5 * (t1 * planar[0] + t2 * planar[1])).abs() < tolerance * t1);
    }
}

#[test]
fn every_orbit_that_stays_in_a_wedge_of_these_angles_has_the_predicted_period() {
    let forms = closed_forms();
    let cases = forms["wedge_periodic"].as_array().unwrap();
    assert!(cases.len() >= 5);
    for (case, size) in cases.iter().flat_map(|case| [1.0, 1024.0].map(|size| (case, size))) {
        let (theta, gamma_squared) = (number(&case["theta"]), number(&case["gamma_squared"]));
        let wedge = Planar { table: tables::wedge(theta).unwrap(), law: no_slip(gamma_squared) };
        // about the axis of periodicity (sin(θ/2)/γ, 1, 0), by half of the radius of the cap of velocities that stay
        let axis = [libm::sin(0.5 * theta) / gamma_squared.sqrt(), 1.0, 0.0];
        let length = libm::hypot(axis[0], 1.0);
        let off = 0.5 * libm::tan(number(&case["cap_angular_radius"]));
        let [v0, v1] = [axis[0] / length - 0.6 * off / length, axis[1] / length + 0.6 * off * axis[0] / length];
        // as many lengths a time as a length has units
        let mut orbit = orbit([0.0, size], [v1 * size, 0.8 * off * size], v0 * size);
        let mut period = Period::new(1e-11, size);
        assert_eq!(wedge.run(&mut orbit, &Collisions(1000), &mut period).stop, Stop::Observer, "θ = {theta}");
        let found = period.found().unwrap();
        assert_eq!(found.period, case["reduced_period"].as_u64().unwrap(), "θ = {theta}");
        assert_eq!(found.drift_free, case["x0_drift_free"].as_bool().unwrap(), "θ = {theta}: {found:?}");
    }
}

#[test]
fn a_strip_orbit_that_turns_by_an_irrational_angle_has_no_period() {
    let strip = Planar { table: tables::strip(1.0).unwrap(), law: no_slip(0.5) };
    let mut period = Period::new(1e-9, 1.0);
    let outcome = strip.run(&mut orbit([0.0, 0.5], [0.3, 0.8], 0.1), &Collisions(10_000), &mut period);
    assert_eq!((outcome.stop, period.found()), (Stop::Finished, None));
}

#[test]
fn a_period_on_the_torus_is_seen_across_the_edge_of_the_cell() {
    // along a lattice vector from disk to disk of the Sinai torus; they face each other over the edge of the cell
    let table = tables::sinai_torus(0.25, 1.0).unwrap();
    let lattice = table.lattice().unwrap().clone();
    let torus = Planar { table, law: Specular };
    let mut period = Period::new(1e-12, 1.0).modulo(lattice);
    let outcome = torus.run(&mut orbit([0.0, 0.5], [1.0, 0.0], 0.0), &Collisions(10), &mut period);
    assert_eq!((outcome.stop, period.found().map(|found| found.period)), (Stop::Observer, Some(2)));
}

#[test]
fn a_period_and_a_first_return_are_counted_over_several_runs() {
    // from the middle of each side to that of the next: top, right, floor, left
    let square = Planar { table: tables::square(1.0).unwrap(), law: Specular };
    for first in [1, 2] {
        let mut diamond = orbit([0.0, 0.5], [1.0, 1.0], 0.0);
        let mut floor = FirstReturn::to(|c: &Collision<'_, 2, 1, _, _>| c.piece() == 0);
        square.run(&mut diamond, &Collisions(first), &mut floor);
        square.run(&mut diamond, &Collisions(9), &mut floor);
        assert_eq!(floor.found().map(|entry| (entry.collisions, entry.time)), Some((3, 1.5)), "after {first}");
        // it goes on to the next entry, which is not the first
        assert_eq!(square.run(&mut diamond, &Collisions(9), &mut floor).stop, Stop::Observer);
        assert_eq!(floor.found().map(|entry| entry.collisions), Some(3), "after {first}");

        let mut diamond = orbit([0.0, 0.5], [1.0, 1.0], 0.0);
        let mut period = Period::new(1e-12, 1.0);
        square.run(&mut diamond, &Collisions(first), &mut period);
        square.run(&mut diamond, &Collisions(9), &mut period);
        assert_eq!(period.found().map(|found| found.period), Some(4), "after {first}");
        // it goes on to the next return, which is not the first
        assert_eq!(square.run(&mut diamond, &Collisions(9), &mut period).stop, Stop::Observer);
        assert_eq!(period.found().map(|found| found.period), Some(4), "after {first}");
    }
}

#[test]
fn energy_drift_is_the_energy_that_is_missing() {
    let law = Disk::new(&Restitution::new(0.5, -1.0).unwrap(), FRAC_1_SQRT_2).unwrap();
    let strip = Planar { table: tables::strip(1.0).unwrap(), law };
    let mut falling = Orbit::<_, 2, 1>::new([0.0, 0.5], [0.0, -1.0], [0.0], ());
    let mut drift = EnergyDrift::of(&falling);
    strip.run(&mut falling, &Collisions(2), &mut drift);
    assert_eq!(drift.largest(), 1.0 - 1.0 / 16.0);
    // a drift of 2⁻⁵² in one component is seen, not rounded away; and so it is at any speed
    for scale in [-498, 0, 498].map(|exponent| libm::ldexp(1.0, exponent)) {
        let at = |v: f64| Orbit::<f64, 2, 1>::new([0.0, 0.5], [0.0, v * scale], [0.0], ());
        let mut drift = EnergyDrift::of(&at(1.0 + f64::EPSILON));
        let specular = Planar { table: tables::strip(1.0).unwrap(), law: Specular };
        specular.run(&mut at(1.0), &Collisions(1), &mut drift);
        assert!((drift.largest() - 2.0 * f64::EPSILON).abs() < 8.0 * f64::EPSILON * f64::EPSILON, "{scale}");
    }
}

#[test]
fn energy_drift_begins_anew_with_each_orbit() {
    let specular = Planar { table: tables::strip(1.0).unwrap(), law: Specular };
    let at = |v: f64| Orbit::<f64, 2, 1>::new([0.0, 0.5], [0.0, v], [0.0], ());
    let mut drift = EnergyDrift::new();
    for speed in [1.0, 2.0, 3.0] {
        drift.next_orbit();
        specular.run(&mut at(speed), &Collisions(3), &mut drift);
    }
    assert_eq!(drift.largest(), 0.0);
    // one that is followed is compared with its start, not with its first collision
    drift.next_orbit();
    drift.follow(&at(2.0));
    specular.run(&mut at(1.0), &Collisions(3), &mut drift);
    assert_eq!(drift.largest(), 0.75);
}

#[test]
fn portraits_pass_the_next_orbit_on() {
    #[derive(Default)]
    struct Orbits(u64);
    impl<A> Extend<A> for Orbits {
        fn extend<I: IntoIterator<Item = A>>(&mut self, _: I) {}
    }
    impl Merge for Orbits {
        fn merge(self, other: Self) -> Self {
            Orbits(self.0 + other.0)
        }
        fn next_orbit(&mut self) {
            self.0 += 1;
        }
    }
    let table = tables::strip(1.0).unwrap();
    let mut both = (VelocityPortrait::new(Orbits(0)), ReducedPortrait::new(&table, Orbits(0)));
    both.next_orbit();
    assert_eq!((both.0.points().0, both.1.states().0), (1, 1));
}

#[test]
fn the_keeper_keeps_the_energy_of_a_long_orbit() {
    let stadium = Planar { table: tables::stadium(1.0, 1.0).unwrap(), law: no_slip(0.5) };
    let mut orbit = orbit([0.1, 0.2], [0.6, 0.3], 0.4);
    let mut drift = EnergyDrift::of(&orbit);
    stadium.run(&mut orbit, &Collisions(100_000), &mut drift);
    // a few roundings each for the collisions in a row along a cap that are too flat to be repaired well at once; without
    // the keeper it would be some 1e5 ε
    assert!(drift.largest() < 64.0 * f64::EPSILON, "{:e}", drift.largest());
}

#[test]
fn drifts_of_an_invariant_are_their_largest_and_their_root_mean_square() {
    let strip = Planar { table: tables::strip(1.0).unwrap(), law: Specular };
    let count = || Invariant::new(|c: &Collision<'_, 2, 1, _, _>| c.n as f64);
    let run =
        |invariant: &mut Invariant<_>, n| strip.run(&mut orbit([0.0, 0.5], [0.0, 1.0], 0.0), &Collisions(n), invariant);
    let mut counted = count();
    run(&mut counted, 5);
    assert_eq!((counted.largest_drift(), counted.rms_drift()), (4.0, 7.5_f64.sqrt()));
    let mut scaled = count().relative_to(2.0);
    run(&mut scaled, 5);
    assert_eq!(scaled.largest_drift(), 2.0);
    // together with an orbit of three collisions: drifts 1, 2, 3, 4 and 1, 2
    let mut other = count();
    run(&mut other, 3);
    let both = counted.merge(other);
    assert!((both.rms_drift() - (35.0_f64 / 6.0).sqrt()).abs() < 1e-15);
}

#[test]
fn conserved_quantities_are_found_conserved() {
    // |angular momentum about the apex| of a wedge, under every strict law
    for law in [no_slip(0.5), Disk::new(&Specular, 0.5).unwrap()] {
        let wedge = Planar { table: tables::wedge(1.0).unwrap(), law };
        let mut momentum = Invariant::new(|c: &Collision<'_, 2, 1, _, _>| {
            let ([x1, x2], [v1, v2]) = (c.orbit.position, c.orbit.velocity);
            (x1 * v2 - x2 * v1).abs()
        });
        let outcome = wedge.run(&mut orbit([0.0, 1.0], [0.8, 0.1], 0.6), &Collisions(1000), &mut momentum);
        // a few roundings per collision, each relative to |x| |v|, here at most ten times the momentum
        let bound = 40.0 * outcome.collisions as f64 * f64::EPSILON;
        assert!(momentum.largest_drift() < bound, "{momentum:?}");
    }
}

#[test]
fn a_portrait_holds_the_velocities_of_the_reduced_phase_space() {
    let table = tables::pocket([2.0, 1.0], 0.3125, 0.5625).unwrap();
    let billiard = Planar { table: table.clone(), law: no_slip(0.5) };
    let mut seen = (VelocityPortrait::new(vec![]), ReducedPortrait::new(&table, vec![]));
    billiard.run(&mut orbit([-0.5, 0.1], [3.0, 1.25], 2.0), &Collisions(500), &mut seen);
    let (points, states) = (seen.0.into_points(), seen.1.into_states());
    assert_eq!((points.len(), states.len()), (500, 500));
    for ([v0, vt], state) in points.iter().zip(&states) {
        let unit = state.at_unit_speed();
        assert!((unit.v0 - v0).abs() + (unit.vt - vt).abs() < 4.0 * f64::EPSILON);
        assert!(libm::hypot(unit.v0, unit.vt) < 1.0);
    }
}

#[test]
fn statistics_of_an_ensemble_do_not_depend_on_the_number_of_threads() {
    let stadium = Planar { table: tables::stadium(1.0, 1.0).unwrap(), law: no_slip(0.5) };
    let canonical = Canonical::new(&stadium.table, 1.0, 5).unwrap();
    let empty = || (VelocityPortrait::new(Density::disk(64)), (FreePath::new(), Survival::at([1, 20])));
    let statistics = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            Ensemble::of(500).in_blocks_of(16).run(empty, |i, seen| {
                let start = canonical.start(i);
                let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new(start.position, start.velocity, start.spin, ());
                let mut observers = (&mut seen.0, &mut seen.1.0);
                observers.1.follow(&orbit);
                let outcome = stadium.run(&mut orbit, &Collisions(20), &mut observers);
                seen.1.1.add(outcome.collisions);
            })
        })
    };
    let [(portrait, (paths, survival)), (same_portrait, (same_paths, same_survival))] = [statistics(1), statistics(3)];
    assert_eq!(portrait.points(), same_portrait.points());
    assert_eq!((paths.time(), paths.length()), (same_paths.time(), same_paths.length()));
    assert_eq!(survival, same_survival);
    assert_eq!((portrait.points().total(), survival.survivors().last()), (10_000, Some((20, 500))));
}

#[test]
fn an_orbit_of_an_ensemble_does_not_go_on_with_the_flight_of_another() {
    let square = Planar { table: tables::square(1.0).unwrap(), law: no_slip(0.5) };
    let canonical = Canonical::new(&square.table, 1.0, 1).unwrap();
    let index = |c: &Collision<'_, 2, 1, (), ()>| c.n as f64;
    for block in [1, 7, 256] {
        let empty = || (FreePath::new(), Invariant::new(index).relative_to(1.0));
        let (paths, counted) = Ensemble::of(100).in_blocks_of(block).run(empty, |i, seen| {
            square.run(&mut canonical.start(i).orbit::<(), ()>(()), &Collisions(10), seen);
        });
        // the first flight of each orbit has no start that was seen, and its first collision is what the others drift from
        assert_eq!((paths.time().count, paths.length().count), (900, 900), "in blocks of {block}");
        assert!((counted.rms_drift() - (285.0_f64 / 9.0).sqrt()).abs() < 1e-14, "in blocks of {block}");
    }
}

#[test]
fn survivors_of_a_hole_decay_by_its_share_of_the_boundary() {
    // specular stadium with a hole of 1/20 of the boundary: the first collision finds it with the canonical probability
    let stadium = Planar { table: tables::stadium(1.0, 1.0).unwrap(), law: Specular };
    let canonical = Canonical::new(&stadium.table, 1.0, 9).unwrap();
    let width = stadium.table.perimeter() / 20.0;
    let survival = Ensemble::of(20_000).run(
        || Survival::at([1, 2, 3]),
        |i, survival| {
            let start = canonical.start(i);
            let mut orbit = Orbit::<_, 2, 1>::new(start.position, start.velocity, start.spin, ());
            let mut hole = FirstReturn::to(|c: &Collision<'_, 2, 1, _, _>| {
                c.piece() == 0 && c.orbit.position[0].abs() < 0.5 * width
            });
            stadium.run(&mut orbit, &Collisions(3), &mut hole);
            survival.add(hole.found().map_or(3, |entry| entry.collisions - 1));
        },
    );
    let survivors: Vec<u64> = survival.survivors().map(|(_, count)| count).collect();
    // the share that the first collision loses is binomial with mean 1000 and deviation 31: 5 deviations, probability 6e-7
    let lost = survival.orbits() - survivors[0];
    assert!(lost.abs_diff(1000) < 155, "{lost}");
    assert!(survivors[0] > survivors[1] && survivors[1] > survivors[2]);
}

#[test]
fn rows_know_the_cell_only_where_it_is_tracked() {
    let table = tables::sinai_torus(0.25, 1.0).unwrap();
    let lattice = Arc::new(table.lattice().unwrap().clone());
    let torus = Planar { table, law: no_slip(0.5) };
    let mut rows = vec![];
    let mut record = Record::new(|row: PlanarRow| {
        rows.push(row);
        if rows.len() < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    // straight to the next disk on the right, and back
    let track = (Clock::new(0.0), (Angle::new(0.5), Cell::new(lattice, 0.0)));
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([0.75, 0.5], [1.0, 0.0], [0.25], track);
    let outcome = torus.run(&mut orbit, &Collisions(10), &mut record);
    assert_eq!((outcome.stop, outcome.collisions), (Stop::Observer, 3));
    let first = rows[0];
    assert_eq!((first.n, first.t, first.x0, first.cell), (1, 0.5, 0.625, Some([1, 0])));
    assert!((first.x[0] - 0.25).abs() < 1e-15);

    let track = (Clock::new(0.0), Angle::new(0.0));
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([0.75, 0.5], [1.0, 0.0], [0.25], track);
    let mut record = Record::new(|row: PlanarRow| {
        assert_eq!(row.cell, None);
        ControlFlow::Continue(())
    });
    torus.run(&mut orbit, &Collisions(2), &mut record);
}

#[test]
fn rows_have_the_energy_of_the_start_to_the_last_digit() {
    let stadium = Planar { table: tables::stadium(1.0, 1.0).unwrap(), law: no_slip(0.7) };
    let track = (Clock::new(0.0), Angle::new(0.0));
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([0.1, 0.2], [0.6, 0.8], [0.5], track);
    let mut record = Record::new(|PlanarRow { v0, v: [v1, v2], .. }| {
        let square = v0 * v0 + v1 * v1 + v2 * v2;
        assert!((square - 1.25).abs() <= 2.0 * f64::EPSILON, "{square}");
        ControlFlow::Continue(())
    });
    assert_eq!(stadium.run(&mut orbit, &Collisions(10_000), &mut record).collisions, 10_000);
}

#[test]
fn a_grid_has_one_start_in_every_cell_of_equal_measure() {
    let table = tables::stadium(1.0, 1.0).unwrap();
    let grid = Grid::new(&table, 2.0, [4, 3, 5]).unwrap();
    assert_eq!(grid.count(), 60);
    let (mut radii, mut cells) = ([0; 3], std::collections::HashSet::new());
    for i in 0..60 {
        let start = grid.start(i);
        assert!(table.signed_distance(&start.position.into()).abs() < 1e-15);
        let [v1, v2] = start.velocity;
        assert!((start.spin[0] * start.spin[0] + v1 * v1 + v2 * v2 - 4.0).abs() < 1e-14);
        let normal = table.closest(&start.position.into()).1.normal;
        let vn = 0.5 * (v1 * normal.x + v2 * normal.y);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "r² is between 0 and 1")]
        let ring = ((1.0 - vn * vn) * 3.0) as usize;
        radii[ring] += 1;
        // the start is in the middle of r² and of φ
        let (cos, sin) = (start.spin[0], v2 * normal.x - v1 * normal.y);
        let turns = (libm::atan2(sin, cos) / core::f64::consts::TAU).rem_euclid(1.0) * 5.0;
        assert!((turns.fract() - 0.5).abs() < 1e-12 && (((1.0 - vn * vn) * 3.0).fract() - 0.5).abs() < 1e-12);
        let place = start.position.map(f64::to_bits);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "less than five")]
        cells.insert((place, ring, turns as usize));
    }
    assert_eq!(radii, [20; 3]); // rings of equal r² have equal shares
    let places: std::collections::HashSet<_> = cells.iter().map(|(place, ..)| *place).collect();
    assert_eq!((cells.len(), places.len()), (60, 4));
    assert!(Grid::new(&table, 1.0, [0, 1, 1]).is_err() && Canonical::new(&table, -1.0, 0).is_err());
}

#[test]
fn a_grid_of_points_has_one_start_in_every_cell_of_place_and_tangential_velocity() {
    let table = tables::stadium(1.0, 1.0).unwrap();
    // all but one of the cells of 8 places and 7 velocities
    let grid = Grid::of_points(&table, 2.0, 55).unwrap();
    assert_eq!(grid.count(), 55);
    let mut cells = std::collections::HashSet::new();
    for i in 0..55 {
        let start = grid.start(i);
        let [v1, v2] = start.velocity;
        assert!((v1 * v1 + v2 * v2 - 4.0).abs() < 1e-14);
        let normal = table.closest(&start.position.into()).1.normal;
        assert!(v1 * normal.x + v2 * normal.y > 0.0);
        let vt = 0.5 * (v2 * normal.x - v1 * normal.y);
        let cell = (vt + 1.0) * 3.5;
        assert!((cell.fract() - 0.5).abs() < 1e-12, "{cell}");
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "less than seven")]
        cells.insert((start.position.map(f64::to_bits), cell as usize));
    }
    let places: std::collections::HashSet<_> = cells.iter().map(|(place, _)| *place).collect();
    assert_eq!((cells.len(), places.len()), (55, 8));
    for too_many in [u64::MAX, u64::MAX - 1, 1 << 63] {
        assert!(matches!(Grid::of_points(&table, 2.0, too_many), Err(Error::Grid)), "{too_many}");
    }
}

#[test]
fn a_grid_starts_at_no_vertex_of_a_regular_polygon() {
    for table in [tables::square(1.0).unwrap(), tables::hexagon(1.0).unwrap()] {
        let billiard = Planar { law: no_slip(0.5), table };
        for count in [8, 27, 729, 1000] {
            let grid = Grid::with_count(&billiard.table, 1.0, count).unwrap();
            for i in 0..count {
                let start = grid.start(i);
                let mut orbit = Orbit::<_, 2, 1, (), ()>::new(start.position, start.velocity, start.spin, ());
                let outcome = billiard.run(&mut orbit, &Collisions(2), &mut ());
                assert_eq!(outcome.stop, Stop::Finished, "{} {count} {i}", billiard.table.pieces().len());
            }
        }
    }
}

#[test]
fn starts_that_do_not_fill_a_grid_leave_out_no_part_of_the_boundary() {
    let table = tables::rectangle([2.0, 1.0]).unwrap();
    // in a grid of 4 × 4 × 3
    let grid = Grid::with_count(&table, 1.0, 40).unwrap();
    assert_eq!(grid.count(), 40);
    let mut places: Vec<[u64; 2]> = (0..40).map(|i| grid.start(i).position.map(f64::to_bits)).collect();
    places.sort_unstable();
    let starts: Vec<usize> = places.chunk_by(|a, b| a == b).map(<[_]>::len).collect();
    assert_eq!(starts, [10; 4]);
}

#[test]
fn both_of_two_observers_and_all_of_three_see_the_last_collision() {
    /// Counts collisions, up to so many.
    struct Stops(u64, u64);
    impl Stops {
        fn after(most: u64) -> Self {
            Stops(0, most)
        }
    }
    impl<K, T> billiards::Observer<2, 1, K, T> for Stops {
        fn collision(&mut self, c: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
            self.0 = c.n;
            if c.n == self.1 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }
    struct Sees(u64);
    impl<K, T> billiards::Observer<2, 1, K, T> for Sees {
        fn collision(&mut self, c: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
            self.0 = c.n;
            ControlFlow::Continue(())
        }
    }
    let circle = Planar { table: tables::circle(1.0).unwrap(), law: no_slip(0.5) };
    let [mut a, mut b] = [orbit([0.5, 0.0], [0.1, 0.7], 0.2); 2];
    let (mut first, mut last) = ((Stops::after(3), Sees(0)), (Sees(0), Stops::after(3)));
    assert_eq!(circle.run(&mut a, &Collisions(9), &mut first).stop, Stop::Observer);
    assert_eq!(circle.run(&mut b, &Collisions(9), &mut last).stop, Stop::Observer);
    assert_eq!([first.0.0, first.1.0, last.0.0, last.1.0], [3; 4]);
    for stopping in 0..3 {
        let most = |k: usize| if k == stopping { 3 } else { 9 };
        let mut three = (Stops::after(most(0)), Stops::after(most(1)), Stops::after(most(2)));
        let mut orbit = orbit([0.5, 0.0], [0.1, 0.7], 0.2);
        assert_eq!(circle.run(&mut orbit, &Collisions(9), &mut three).stop, Stop::Observer, "{stopping}");
        assert_eq!([three.0.0, three.1.0, three.2.0], [3; 3], "{stopping}");
    }
}

#[test]
fn of_three_observers_it_is_enough_if_one_looks_at_the_orbit() {
    fn looks(observer: &impl billiards::Observer<2, 1, (), ()>) -> bool {
        observer.looks()
    }
    let drift = EnergyDrift::new;
    assert!(looks(&(drift(), (), ())) && looks(&((), drift(), ())) && looks(&((), (), drift())));
    assert!(!looks(&((), (), ())));
}

#[test]
fn a_path_from_beyond_a_wall_by_rounding_comes_no_nearer_to_a_point_than_it_is() {
    let square = Planar { table: tables::square(1.0).unwrap(), law: Specular };
    let mut orbit = orbit([1.0_f64.next_up(), 0.5], [1.0, 0.0], 0.0);
    let mut nearest = Nearest::to([1.5, 0.5], &orbit);
    square.run(&mut orbit, &Collisions(1), &mut nearest);
    assert!((nearest.distance() - 0.5).abs() < 1e-15);
}

#[test]
fn a_path_passes_a_point_at_its_distance_across_the_path() {
    let square = Planar { table: tables::square(1.0).unwrap(), law: Specular };
    let mut orbit = orbit([0.1, 0.1], [0.6, 0.8], 0.0);
    let mut nearest = Nearest::to([0.5, 0.2], &orbit);
    square.run(&mut orbit, &Collisions(1), &mut nearest);
    assert!((nearest.distance() - (0.4 * 0.8 - 0.1 * 0.6)).abs() < 1e-15, "{}", nearest.distance());
}

#[test]
fn a_drift_below_the_rounding_of_the_energy_is_told() {
    // squares of speed 1 + 2⁻⁶⁰ and (1 + ε)²
    let (start, now) =
        (orbit([0.0; 2], [1.0, libm::ldexp(1.0, -30)], 0.0), orbit([0.0; 2], [1.0 + f64::EPSILON, 0.0], 0.0));
    let expected = 2.0 * f64::EPSILON + (f64::EPSILON * f64::EPSILON - libm::ldexp(1.0, -60));
    assert_eq!(EnergyDrift::of(&start).now(&now), expected);
}

#[test]
fn starts_in_space_at_another_speed_are_the_same_faster() {
    let box_ = tables::cuboid([1.0, 2.0, 0.5]).unwrap();
    let [slow, fast] = [1.0, 4.0].map(|speed| CanonicalSpatial::new(&box_, speed, 7).unwrap());
    let mut faces = std::collections::HashSet::new();
    for i in 0..100 {
        let (slow, fast) = (slow.start(i), fast.start(i));
        for (axis, size) in [1.0, 2.0, 0.5].into_iter().enumerate() {
            let (x, v) = (slow.position[axis], slow.velocity[axis]);
            if x == 0.0 || x == size {
                assert!(if x == 0.0 { v > 0.0 } else { v < 0.0 }, "into the box");
                faces.insert((axis, x == 0.0));
            }
        }
        assert_eq!(fast.position, slow.position);
        assert_eq!((fast.velocity, fast.spin), (slow.velocity.map(|v| 4.0 * v), slow.spin.map(|w| 4.0 * w)));
        let square = slow.velocity.iter().chain(&slow.spin).map(|v| v * v).sum::<f64>();
        assert!((square - 1.0).abs() < 1e-15);
    }
    assert_eq!(faces.len(), 6);
}

#[test]
fn a_time_that_is_no_number_is_over_at_once() {
    let billiard = Planar { table: tables::square(1.0).unwrap(), law: Disk::new(&NoSlip, 0.7).unwrap() };
    let mut orbit: Orbit<f64, 2, 1, (), Clock> = Orbit::new([0.5, 0.5], [0.6, 0.8], [0.0], Clock::new(0.0));
    let outcome = billiard.run(&mut orbit, &Time(f64::NAN), &mut ());
    assert_eq!((outcome.stop, outcome.collisions), (Stop::Finished, 0));
}
