//! The certified trajectories of a ball in space (`tests/data/traj3d`), by two ways of the same laws.
use billiards::{
    BallLaw, Clock, Collision, Collisions, Conserved, Orbit, Spatial, Stop,
    laws::{Custom, RoughBall, Specular},
    observe::{Record, SpatialRow, Watch},
};
use collision_laws::{AnyLaw, laws};
use core::ops::ControlFlow;
use geometry::tables::{self, SpatialTable};
use nalgebra::Vector3;
use serde_json::Value;
use std::path::Path;

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| v.as_str().unwrap().parse().unwrap())
}
fn vector(v: &Value) -> [f64; 3] {
    core::array::from_fn(|i| number(&v[i]))
}

type Start = [[f64; 3]; 3];

fn orbit(start: Start) -> Orbit<f64, 3, 3, Conserved<f64, 3>, Clock> {
    Orbit::new(start[0], start[1], start[2], Clock::new(0.0))
}

fn rows<L: BallLaw<3, 3>>(billiard: &Spatial<L>, start: Start, collisions: u64) -> Vec<SpatialRow> {
    let mut rows = vec![];
    let mut record = Record::new(|row: SpatialRow| {
        rows.push(row);
        ControlFlow::Continue(())
    });
    let outcome = billiard.run(&mut orbit(start), &Collisions(collisions), &mut record);
    assert_eq!(outcome.stop, Stop::Finished);
    rows
}

fn state(row: &SpatialRow) -> impl Iterator<Item = f64> {
    row.x.into_iter().chain(row.v).chain(row.w)
}

/// For each collision, the largest growth so far of a small change of any initial coordinate: the condition number.
///
/// The change is 2⁻²⁶, half of the digits, so that what is seen of it is right to about 1e-8.
fn amplification<L: BallLaw<3, 3>>(billiard: &Spatial<L>, start: Start, rows_of_start: &[SpatialRow]) -> Vec<f64> {
    let delta = libm::exp2(-26.0);
    let mut amp = vec![0.0_f64; rows_of_start.len()];
    for i in 0..9 {
        let mut near = start;
        near[i / 3][i % 3] += delta;
        let changed = rows(billiard, near, rows_of_start.len() as u64);
        for ((amp, a), b) in amp.iter_mut().zip(rows_of_start).zip(&changed) {
            *amp = amp.max(state(a).zip(state(b)).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt() / delta);
        }
    }
    for k in 1..amp.len() {
        amp[k] = amp[k].max(amp[k - 1]);
    }
    amp
}

/// Every collision within 16 n ε max(1, amplification), the tolerance of the planar files: an f64 run of n collisions makes a
/// few roundings in each, and each grows with the condition number. Returns the worst error in units of that.
fn compare<L: BallLaw<3, 3>>(billiard: &Spatial<L>, reference: &Value) -> f64 {
    let expected = reference["collisions"].as_array().unwrap();
    let initial = &reference["initial"];
    let start = ["x", "v", "W"].map(|key| vector(&initial[key]));
    let got = rows(billiard, start, expected.len() as u64);
    let amp = amplification(billiard, start, &got);
    // the files number the planes of a slab as those of a box
    let first_piece = if billiard.table.pieces().len() == 2 { 4 } else { 0 };
    let mut worst = 0.0_f64;
    for ((row, want), amp) in got.iter().zip(expected).zip(amp) {
        assert_eq!(row.n, want["n"].as_u64().unwrap());
        assert_eq!(row.piece as u64 + first_piece, want["piece"].as_u64().unwrap(), "piece at {}", row.n);
        let bound = 16.0 * row.n as f64 * f64::EPSILON * amp.max(1.0);
        assert!(bound < 1e-3, "within the horizon of an f64");
        let t = number(&want["t"]);
        let time = (row.t - t).abs() / (bound * t.max(1.0));
        let coordinates = ["x", "v", "W"].iter().flat_map(|key| vector(&want[*key]));
        let state = state(row).zip(coordinates).map(|(got, want)| (got - want).abs() / bound);
        let error = state.fold(time, f64::max);
        assert!(error <= 1.0, "collision {}: {error} of the tolerance", row.n);
        worst = worst.max(error);
    }
    worst
}

fn table(domain: &str) -> SpatialTable {
    if domain.starts_with("unit ball") {
        tables::ball(1.0)
    } else if domain.starts_with("[0,1]^3") {
        tables::cuboid([1.0; 3])
    } else {
        tables::slab(1.0)
    }
    .unwrap()
}

#[test]
fn every_reference_trajectory_in_space_is_reproduced() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/traj3d");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    assert_eq!(files.len(), 9);
    for file in files {
        let reference: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
        assert_eq!(reference["gamma_squared"], "2/5");
        let gamma = 0.4_f64.sqrt();
        let table = table(reference["domain"].as_str().unwrap());
        let (fast, custom) = match reference["law"].as_str().unwrap() {
            "k0" => (compare(&Spatial { table: table.clone(), law: Specular }, &reference), AnyLaw::new(Specular)),
            "k1" => {
                let rough = Vector3::from(vector(&reference["rough"]));
                let law = RoughBall::along(gamma, rough).unwrap();
                let same = AnyLaw::new(laws::RoughPlane::new(&[rough]).unwrap());
                (compare(&Spatial { table: table.clone(), law }, &reference), same)
            }
            _ => {
                let law = RoughBall::no_slip(gamma).unwrap();
                (compare(&Spatial { table: table.clone(), law }, &reference), AnyLaw::new(laws::NoSlip))
            }
        };
        let custom = compare(&Spatial { table, law: Custom::ball(custom, gamma).unwrap() }, &reference);
        println!("{}: {fast:.3} and {custom:.3} of the tolerance", file.file_stem().unwrap().to_string_lossy());
    }
}

#[test]
fn the_spin_about_the_normal_never_changes() {
    let slab = Spatial { table: tables::slab(1.0).unwrap(), law: RoughBall::no_slip(0.4_f64.sqrt()).unwrap() };
    let mut watch = Watch::new(|c: &Collision<'_, 3, 3, _, _>| {
        assert_eq!(c.orbit.spin[2], 0.25);
        ControlFlow::Continue(())
    });
    let start = [[0.0, 0.0, 0.5], [0.25, 0.5, -0.75], [0.5, -0.125, 0.25]];
    slab.run(&mut orbit(start), &Collisions(1000), &mut watch);
}
