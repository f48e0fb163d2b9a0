//! Particles that creep along smooth curves far from the origin, where positions are rounded by more than such a curve bends away: they end
//! there as they would at the origin.
use billiards::collision_laws::laws::Restitution;
use billiards::geometry::{
    Piece, Table, Vector2,
    shapes::curve::{Interval, ParametricCurve, ParametricFormula, Polar, PolarFormula},
};
use billiards::laws::{Disk, Specular};
use billiards::observe::{Collision, Observer};
use billiards::{Canonical, Collisions, Orbit, Planar, Start, Starts, Stop};
use core::{f64::consts::PI, ops::ControlFlow};
use std::collections::BTreeMap;

const OFFSETS: [f64; 4] = [0.0, 4.0, 64.0, 1024.0];

/// `r = scale (1.75 + 0.21875 cos 6φ + 0.15625 sin 5φ)`: it bends inwards in places.
#[derive(Clone, Debug)]
struct Waves {
    scale: f64,
}

impl PolarFormula for Waves {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let [(sin6, cos6), (sin5, cos5)] = [6.0, 5.0].map(|n| libm::sincos(n * angle));
        let jet =
            [1.75 + 0.21875 * cos6 + 0.15625 * sin5, 0.78125 * cos5 - 1.3125 * sin6, -7.875 * cos6 - 3.90625 * sin5];
        jet.map(|x: f64| x * self.scale)
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [[sin6, cos6], [sin5, cos5]] = [6.0, 5.0].map(|n| (angle * n).sin_cos());
        let jet =
            [cos6 * 0.21875 + sin5 * 0.15625 + 1.75, cos5 * 0.78125 - sin6 * 1.3125, -(cos6 * 7.875) - sin5 * 3.90625];
        jet.map(|x| x * self.scale)
    }
}

/// The same curve about a centre, point by point.
#[derive(Clone, Debug)]
struct Traced {
    center: f64,
    waves: Waves,
}

impl ParametricFormula for Traced {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let ([r, rate, bend], (sin, cos)) = (self.waves.jet(t), libm::sincos(t));
        let [along, across] = [bend - r, 2.0 * rate];
        [
            [self.center + r * cos, self.center + r * sin],
            [rate * cos - r * sin, rate * sin + r * cos],
            [along * cos - across * sin, along * sin + across * cos],
        ]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let ([r, rate, bend], [sin, cos]) = (self.waves.jet_over(t), t.sin_cos());
        let [along, across] = [bend - r, rate * 2.0];
        [
            [r * cos + self.center, r * sin + self.center],
            [rate * cos - r * sin, rate * sin + r * cos],
            [along * cos - across * sin, along * sin + across * cos],
        ]
    }
}

fn polar(center: f64, scale: f64) -> Table {
    let curve = Polar::new(Vector2::repeat(center * scale), Waves { scale }, true).unwrap();
    Table::new(curve.pieces()).unwrap()
}

fn parametric(center: f64, scale: f64) -> Table {
    let formula = Traced { center: center * scale, waves: Waves { scale } };
    let curve = ParametricCurve::around(formula, [0.0, 2.0 * PI], true).unwrap();
    Table::new(curve.into_iter().map(|arc| Box::new(arc) as Box<dyn Piece>).collect()).unwrap()
}

/// How far flights lead out of the table.
struct Outside {
    center: f64,
    last: Option<Vector2<f64>>,
    deepest: f64,
}

impl<K, T> Observer<2, 1, K, T> for Outside {
    fn collision(&mut self, collision: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
        let here = Vector2::from(collision.orbit.position).add_scalar(-self.center);
        if let Some(last) = self.last {
            for k in 1..16 {
                let p = last + (here - last) * (f64::from(k) / 16.0);
                let [radius, ..] = Waves { scale: 1.0 }.jet(libm::atan2(p.y, p.x));
                self.deepest = self.deepest.max(libm::hypot(p.x, p.y) - radius);
            }
        }
        self.last = Some(here);
        ControlFlow::Continue(())
    }
}

const STARTS: u64 = 200;
const MOST: Collisions = Collisions(2000);

fn billiard(table: Table, normal: f64) -> (Planar<Disk>, Vec<Start<2, 1>>) {
    let starts = Canonical::new(&table, 1.0, 3).unwrap();
    let starts = (0..STARTS).map(|k| starts.start(k)).collect();
    (Planar { table, law: Disk::new(&Restitution::new(normal, -0.265_625).unwrap(), 0.5).unwrap() }, starts)
}

#[test]
fn what_creeps_along_a_curve_grazes_and_does_not_go_through_it_however_far_from_the_origin() {
    let mut wrong = vec![];
    for (name, table) in [("polar", polar as fn(f64, f64) -> Table), ("parametric", parametric)] {
        for center in OFFSETS {
            for normal in [0.5625, 0.25, 0.03125] {
                let (billiard, starts) = billiard(table(center, 1.0), normal);
                for (k, start) in starts.iter().enumerate() {
                    let mut orbit: Orbit<f64, 2, 1> = start.orbit(());
                    let mut outside = Outside { center, last: None, deepest: 0.0 };
                    let stop = billiard.run(&mut orbit, &MOST, &mut outside).stop;
                    if stop != Stop::Grazing || outside.deepest > 1e-9 {
                        wrong.push(format!(
                            "{name} at {center}, {normal}, {k}: {stop:?}, {:e} outside",
                            outside.deepest
                        ));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} orbits: {:#?}", wrong.len(), &wrong[..wrong.len().min(9)]);
}

#[test]
fn how_creeping_ends_depends_neither_on_the_unit_of_length_nor_on_other_orbits() {
    for table in [polar as fn(f64, f64) -> Table, parametric] {
        let (near, starts) = billiard(table(64.0, 1.0), 0.5625);
        let alone: Vec<_> = starts
            .iter()
            .map(|start| {
                let mut orbit: Orbit<f64, 2, 1> = start.orbit(());
                let outcome = near.run(&mut orbit, &MOST, &mut ());
                (orbit, outcome)
            })
            .collect();
        for scale in [libm::exp2(-40.0), libm::exp2(40.0)] {
            let (billiard, starts) = billiard(table(64.0, scale), 0.5625);
            for (start, (same, outcome)) in starts.iter().zip(&alone) {
                let mut orbit: Orbit<f64, 2, 1> = start.orbit(());
                assert_eq!(billiard.run(&mut orbit, &MOST, &mut ()), *outcome);
                assert_eq!(orbit.position, same.position.map(|x| x * scale));
                assert_eq!(orbit.velocity, same.velocity);
            }
        }
        let mut beside = BTreeMap::new();
        let mut orbits = starts.iter().map(|start| -> Orbit<f64, 2, 1> { start.orbit(()) });
        near.run_side_by_side(&mut orbits, &MOST, &mut (), &mut |f| {
            beside.insert(f.index, (f.orbit, f.outcome));
        });
        assert_eq!(beside.into_values().collect::<Vec<_>>(), alone);
    }
}

/// `r = 1.75 + 0.03125 cos 3φ`: convex, and no circle.
#[derive(Clone, Debug)]
struct Trefoil;

impl PolarFormula for Trefoil {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(3.0 * angle);
        [1.75 + 0.03125 * cos, -0.09375 * sin, -0.28125 * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [sin, cos] = (angle * 3.0).sin_cos();
        [cos * 0.03125 + 1.75, sin * -0.09375, cos * -0.28125]
    }
}

#[test]
fn who_starts_along_a_smooth_curve_meets_no_corner_however_far_from_the_origin() {
    for center in OFFSETS {
        let curve = Polar::new(Vector2::repeat(center), Trefoil, true).unwrap();
        let starts: Vec<_> = (0..48).map(|k| curve.landing_at(curve.length() * (f64::from(k) / 48.0))).collect();
        let billiard = Planar { table: Table::new(curve.pieces()).unwrap(), law: Specular };
        for slope in [1e-8, 1e-7, 3e-7, 1e-6] {
            for start in &starts {
                let [n1, n2] = start.normal.into();
                let velocity = [n2 + slope * n1, slope * n2 - n1];
                let mut orbit: Orbit<f64, 2, 1> = Orbit::new(start.point.into(), velocity, [0.0], ());
                let stop = billiard.run(&mut orbit, &Collisions(50), &mut ()).stop;
                assert!(matches!(stop, Stop::Grazing | Stop::Finished), "{center} {slope:e} {start:?}: {stop:?}");
            }
        }
    }
}
