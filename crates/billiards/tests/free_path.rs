//! Mean free times and paths over the canonical measure, at the first flight and after several collisions.
use billiards::{
    BallLaw, Canonical, CanonicalSpatial, Collisions, Ensemble, Orbit, Planar, Spatial, Starts,
    laws::{Disk, RoughBall, Specular},
    observe::{FreePath, Mean},
};
use collision_laws::laws::NoSlip;
use core::f64::consts::{FRAC_1_SQRT_2, PI};
use geometry::{
    Table,
    tables::{self, SpatialTable},
};
use serde_json::Value;
use std::path::Path;

/// Orbits per comparison. The standard error of a mean is its own estimate from the sample.
const ORBITS: u64 = 20_000;

/// A sample mean of 20 000 independent flights is normal to good accuracy: 5 standard errors are exceeded with probability
/// 6e-7, so that all 60 comparisons of this file together raise a false alarm with probability 4e-5. The seeds are fixed.
fn close(what: &str, got: Mean, expected: f64) {
    assert_eq!(got.count, ORBITS);
    let errors = (got.mean - expected) / got.standard_error;
    assert!(errors.abs() < 5.0, "{what}: {got:?} for {expected}, {errors} standard errors off");
}

/// The flight after `n` collisions of each orbit: independent of one another, and distributed alike for all n.
fn planar<L: BallLaw<2, 1>>(table: &Table, law: L, n: u64) -> FreePath<2, 1> {
    let billiard = Planar { table: table.clone(), law };
    let canonical = Canonical::new(table, 1.0, 11 + n).unwrap();
    Ensemble::of(ORBITS).run(FreePath::new, |i, paths| {
        let start = canonical.start(i);
        let mut orbit = Orbit::<_, 2, 1>::new(start.position, start.velocity, start.spin, ());
        billiard.run(&mut orbit, &Collisions(n), &mut ());
        paths.follow(&orbit);
        billiard.run(&mut orbit, &Collisions(1), paths);
    })
}

fn spatial<L: BallLaw<3, 3>>(table: &SpatialTable, law: L, n: u64) -> FreePath<3, 3> {
    let canonical = CanonicalSpatial::new(table, 1.0, 11 + n).unwrap();
    let billiard = Spatial { table: table.clone(), law };
    Ensemble::of(ORBITS).run(FreePath::new, |i, paths| {
        let start = canonical.start(i);
        let mut orbit = Orbit::<_, 3, 3>::new(start.position, start.velocity, start.spin, ());
        billiard.run(&mut orbit, &Collisions(n), &mut ());
        paths.follow(&orbit);
        billiard.run(&mut orbit, &Collisions(1), paths);
    })
}

#[test]
fn the_mean_free_time_is_four_areas_over_the_perimeter() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/closed_forms.json");
    let forms: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    // no torus with free corridors: there the variance of the flights is infinite
    let tables = [
        ("square", tables::square(1.0)),
        ("equilateral", tables::equilateral(1.0)),
        ("hexagon", tables::hexagon(1.0)),
        ("isosceles", tables::isosceles(1.0, 1.25)),
        ("circle", tables::circle(1.0)),
        ("stadium", tables::stadium(1.0, 1.0)),
        ("mushroom", tables::mushroom(1.0, 0.5, 0.75)),
        ("sinai_square", tables::sinai(1.0, 0.25)),
    ];
    for (name, table) in tables {
        let table = table.unwrap();
        let number = |key: &str| forms["mean_free"][name][key].as_str().unwrap().parse::<f64>().unwrap();
        let time = number("noslip_or_specular_mean_dt_unit_speed_in_x0x1x2");
        let length = number("mean_planar_path");
        assert!((time - 4.0 * table.area() / table.perimeter()).abs() < 1e-14 * time);
        for (law, n, paths) in [
            ("specular", 5, planar(&table, Specular, 5)),
            ("no-slip", 0, planar(&table, Disk::new(&NoSlip, FRAC_1_SQRT_2), 0)),
            ("no-slip", 5, planar(&table, Disk::new(&NoSlip, FRAC_1_SQRT_2), 5)),
        ] {
            close(&format!("time, {name}, {law}, after {n}"), paths.time(), time);
            close(&format!("length, {name}, {law}, after {n}"), paths.length(), length);
        }
    }
}

#[test]
fn in_space_it_is_fifteen_pi_eighths_of_volume_over_surface() {
    for table in [tables::cuboid([1.0, 2.0, 0.5]).unwrap(), tables::ball(1.5).unwrap()] {
        let ratio = table.volume() / table.surface_area();
        let rough = RoughBall::no_slip(0.4_f64.sqrt());
        for (law, paths) in [("specular", spatial(&table, Specular, 3)), ("no-slip", spatial(&table, rough, 3))] {
            close(&format!("time, {}, {law}", table.name()), paths.time(), 15.0 * PI / 8.0 * ratio);
            close(&format!("length, {}, {law}", table.name()), paths.length(), 4.0 * ratio);
        }
    }
}
