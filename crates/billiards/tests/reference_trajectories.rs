//! The certified planar trajectories of `tests/data/traj`, within the tolerance of its README.
use billiards::{
    Angle, Cell, Clock, Collision, Collisions, Conserved, Observer, Orbit, Planar, Timed, laws::Disk, laws::PerPiece,
};
use collision_laws::laws::{NoSlip, Specular};
use core::ops::ControlFlow;
use geometry::{Lattice, Table, tables};
use serde_json::Value;
use std::{path::Path, sync::Arc};

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| v.as_str().unwrap().parse().unwrap())
}
fn vector<const N: usize>(v: &Value) -> [f64; N] {
    core::array::from_fn(|i| number(&v[i]))
}

fn table(name: &str) -> Table {
    let theta = 0.5 - 1.5 * libm::cos(core::f64::consts::FRAC_PI_4);
    match name {
        "strip" => tables::strip(1.0),
        "circle" => tables::circle(1.0),
        "square" => tables::square(1.0),
        "equilateral" => tables::equilateral(1.0),
        "hexagon" => tables::hexagon(1.0),
        "isosceles" => tables::isosceles(1.0, 1.25),
        "stadium" => tables::stadium(1.0, 1.0),
        "mushroom" => tables::mushroom(1.0, 0.5, 0.75),
        "sinai_square" => tables::sinai(1.0, 0.25),
        "sinai_torus_r14" => tables::sinai_torus(0.25, 1.0),
        "sinai_torus_r38" => tables::sinai_torus(0.375, 1.0),
        "moon" => tables::moon(1.0, 0.75, 1.0),
        "pocket" => tables::pocket([2.0, 1.0], 0.3125, 0.5625),
        "flower" => tables::flower(4, 1.25, 2.0),
        "ellipse" => tables::ellipse([2.0, 1.0]),
        "wedge_pi3" => tables::wedge(core::f64::consts::FRAC_PI_3),
        "wedge_1" => tables::wedge(1.0),
        "wedge_p8" => tables::wedge(libm::acos(theta)),
        other => panic!("unknown reference table {other}"),
    }
    .unwrap()
}

type Track = (Clock, (Angle, Cell));

struct Compare<'a> {
    expected: &'a [Value],
    amplification: f64,
    worst: f64,
    compared: usize,
}

impl<K> Observer<2, 1, K, Track> for Compare<'_> {
    fn collision(&mut self, c: &Collision<'_, 2, 1, K, Track>) -> ControlFlow<()> {
        let expected = &self.expected[usize::try_from(c.n).unwrap() - 1];
        self.amplification = self.amplification.max(number(&expected["amp"]));
        let bound = 16.0 * c.n as f64 * f64::EPSILON * self.amplification.max(1.0);
        if bound >= 1e-3 {
            return ControlFlow::Break(());
        }
        let o = c.orbit;
        let (clock, (angle, cell)) = &o.track;
        let got =
            [clock.time(), angle.0.value(), o.position[0], o.position[1], o.spin[0], o.velocity[0], o.velocity[1]];
        let (x, v): ([f64; 3], [f64; 3]) = (vector(&expected["x"]), vector(&expected["v"]));
        let want = [number(&expected["t"]), x[0], x[1], x[2], v[0], v[1], v[2]];
        assert_eq!(c.piece() as u64, expected["piece"].as_u64().unwrap(), "piece at {}", c.n);
        if let Some(want) = expected.get("cell") {
            assert_eq!([want[0].as_f64().unwrap(), want[1].as_f64().unwrap()], cell.cell, "cell at {}", c.n);
        }
        for (i, (got, want)) in got.iter().zip(want).enumerate() {
            // time and spin position add up: relative to their own size
            let scale = if i < 2 { want.abs().max(1.0) } else { 1.0 };
            let error = (got - want).abs() / (bound * scale);
            self.worst = self.worst.max(error);
            assert!(error <= 1.0, "collision {}: {got} for {want}, {error} of the tolerance", c.n);
        }
        self.compared += 1;
        ControlFlow::Continue(())
    }
}

#[test]
fn every_reference_trajectory_is_reproduced() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data");
    let mut files: Vec<_> = std::fs::read_dir(data.join("traj")).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    assert_eq!(files.len(), 80);
    let mut failures = vec![];
    for file in files {
        let reference: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
        let gamma = {
            let text = reference["gamma_squared"].as_str().unwrap();
            let (p, q) = text.split_once('/').unwrap_or((text, "1"));
            libm::sqrt(p.parse::<f64>().unwrap() / q.parse::<f64>().unwrap())
        };
        let table = table(reference["table"]["name"].as_str().unwrap());
        let lattice =
            table.lattice().cloned().unwrap_or_else(|| Lattice::new(&[geometry::Vector2::new(1e9, 0.0)]).unwrap());
        let law = match reference["law"].as_str().unwrap() {
            "noslip" => Disk::new(&NoSlip, gamma).unwrap(),
            _ => Disk::new(&Specular, gamma).unwrap(),
        };
        let billiard = Planar { table, law: PerPiece::new(law, []) };
        let (x, v): ([f64; 3], [f64; 3]) = (vector(&reference["initial"]["x"]), vector(&reference["initial"]["v"]));
        let track = (Clock::new(0.0), (Angle::new(x[0]), Cell::new(Arc::new(lattice), 0.0)));
        let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([x[1], x[2]], [v[1], v[2]], [v[0]], track);
        let expected = reference["collisions"].as_array().unwrap();
        let mut compare = Compare { expected, amplification: 1.0, worst: 0.0, compared: 0 };
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        let result = std::panic::catch_unwind(core::panic::AssertUnwindSafe(|| {
            billiard.run(&mut orbit, &Collisions(expected.len() as u64), &mut compare)
        }));
        println!("{name}: {} collisions, worst {:.3} of the tolerance", compare.compared, compare.worst);
        match result {
            Ok(outcome) if compare.compared >= 5.min(expected.len()) => {
                if reference["ended"] == "escaped_to_infinity" {
                    let mut more = orbit.clone();
                    let next = billiard.run(&mut more, &Collisions(u64::MAX), &mut ());
                    assert_eq!(next.stop, billiards::Stop::Escaped, "{name}: {outcome:?}");
                }
            }
            _ => failures.push(name),
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}
