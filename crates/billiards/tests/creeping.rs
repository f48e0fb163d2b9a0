//! Particles that a law slows down, or that start along a wall: they end there, and neither leave the table nor bounce on rounding.
use billiards::collision_laws::laws::Restitution;
use billiards::geometry::{
    Piece, Table, Vector2,
    parry::{Room, Side, SolidSpec},
    shapes::{
        Arc, Circle, FullLine, Segment,
        curve::{Interval, Polar, PolarFormula},
    },
    tables, walls,
};
use billiards::laws::{Custom, Disk, PerPiece, Specular};
use billiards::observe::{Collision, Observer, Watch};
use billiards::{
    Billiard, Canonical, Clock, Collisions, Conserved, Orbit, Outcome, Planar, Start, Starts, Stop, Time, Timed, run,
};
use core::ops::ControlFlow;
use std::collections::BTreeMap;

/// Slows the motion along the normal down, and the slip.
fn damping() -> Disk {
    Disk::new(&Restitution::new(0.5, -0.5).unwrap(), 0.5_f64.sqrt()).unwrap()
}

#[test]
fn what_creeps_along_a_focusing_wall_grazes_and_does_not_escape() {
    for table in [
        tables::mushroom(1.0, 0.5, 0.75),
        tables::flower(5, 1.0, 1.0),
        tables::moon(1.0, 0.8, 1.0),
        tables::stadium(1.0, 1.0),
        tables::ellipse([2.0, 1.0]),
    ] {
        let table = table.unwrap();
        let starts = Canonical::new(&table, 1.0, 1).unwrap();
        let billiard = Planar { table: table.clone(), law: damping() };
        let starts: Vec<Start<2, 1>> = (0..64).map(|k| starts.start(k)).collect();
        let mut alone = vec![];
        for start in &starts {
            let mut orbit: Orbit<f64, 2, 1, Conserved<f64, 2>> = start.orbit(());
            let outcome = billiard.run(&mut orbit, &Collisions(10_000), &mut ());
            assert!(matches!(outcome.stop, Stop::Grazing | Stop::Corner), "{outcome:?}");
            assert!(outcome.collisions < 1000, "{outcome:?}");
            alone.push(outcome);
        }
        let mut beside = BTreeMap::new();
        let mut orbits = starts.iter().map(|start| {
            let orbit: Orbit<f64, 2, 1, Conserved<f64, 2>> = start.orbit(());
            orbit
        });
        billiard.run_side_by_side(&mut orbits, &Collisions(10_000), &mut (), &mut |f| {
            beside.insert(f.index, f.outcome);
        });
        assert_eq!(beside.into_values().collect::<Vec<_>>(), alone);
    }
}

#[test]
fn what_creeps_along_a_rounded_solid_grazes_within_some_dozens_of_collisions() {
    for solid in [
        SolidSpec::Cylinder { radius: 1.0, height: 2.0, rounding: 0.5 },
        SolidSpec::Cone { radius: 1.0, height: 2.0, rounding: 0.5 },
        SolidSpec::Cuboid { size: [1.0; 3], rounding: 0.5 },
    ] {
        let room = Room::new(vec![solid.solid([0.0; 3], Side::Inside).unwrap()]);
        let law = Custom::ball(Restitution::new(0.5, -0.5).unwrap(), 0.4_f64.sqrt()).unwrap();
        let billiard = Billiard { walls: &walls::ByLane(&room), law: &law };
        let mut orbit: Orbit<f64, 3, 3> = Orbit::new([0.1, 0.05, -0.1], [0.6, 0.3, 0.2], [0.0; 3], ());
        let outcome = run(&billiard, &mut orbit, &Collisions(10_000), &mut ());
        assert_eq!(outcome.stop, Stop::Grazing, "{solid:?}");
        assert!(outcome.collisions < 200, "{solid:?}: {outcome:?}");
    }
}

#[test]
fn what_has_lost_all_speed_stalls_before_its_squares_vanish() {
    let law = Disk::new(&Restitution::new(0.5, -0.5).unwrap(), 0.5_f64.sqrt()).unwrap();
    for table in [tables::square(1.0), tables::hexagon(1.0), tables::sinai(1.0, 0.25)] {
        let billiard = Planar { table: table.unwrap(), law };
        let mut orbit: Orbit<f64, 2, 1, (), Clock> = Orbit::new([0.3, 0.6], [0.6, 0.35], [0.2], Clock::new(0.0));
        let outcome = billiard.run(&mut orbit, &Collisions(10_000), &mut ());
        assert_eq!(outcome.stop, Stop::Stalled);
        let speed = libm::hypot(orbit.velocity[0], orbit.velocity[1]);
        assert!((1e-160..1.5e-154).contains(&speed), "{speed:e}");
        assert!(orbit.track.time() < 1e160, "{:e}", orbit.track.time());
    }
}

#[test]
fn what_is_left_along_a_wall_grazes_at_once_wherever_it_comes_from() {
    let law = Disk::new(&Restitution::new(0.0, 0.0).unwrap(), 0.5_f64.sqrt()).unwrap();
    for table in [
        tables::equilateral(1.0),
        tables::polygon(7, 1.0),
        tables::polygon(20, 1.0),
        tables::stadium(1.0, 1.0),
        tables::mushroom(1.0, 0.5, 0.75),
        tables::flower(5, 1.0, 1.0),
        tables::ellipse([2.0, 1.0]),
        tables::sinai(1.0, 0.25),
    ] {
        let table = table.unwrap();
        let starts = Canonical::new(&table, 1.0, 1).unwrap();
        let billiard = Planar { table: table.clone(), law };
        for k in 0..2000 {
            let mut orbit: Orbit<f64, 2, 1> = starts.start(k).orbit(());
            let outcome = billiard.run(&mut orbit, &Collisions(10), &mut ());
            assert!(
                matches!(outcome.stop, Stop::Grazing | Stop::Corner) && outcome.collisions <= 1,
                "{k}: {outcome:?}"
            );
        }
    }
}

#[test]
fn nothing_escapes_from_a_closed_table_time_runs_forwards_and_hits_are_where_the_time_says() {
    /// The velocity after the last collision, where it was, and when.
    struct Last(Option<(Vector2<f64>, Vector2<f64>)>, f64);
    impl<K> Observer<2, 1, K, Clock> for Last {
        fn collision(&mut self, collision: &Collision<'_, 2, 1, K, Clock>) -> ControlFlow<()> {
            let Collision { hit, orbit, .. } = collision;
            assert!(hit.time >= 0.0 && orbit.track.time() >= self.1);
            let [position, velocity] = [orbit.position, orbit.velocity].map(Vector2::from);
            if let Some((from, along)) = self.0 {
                let off = (from + along * hit.time - position).norm();
                assert!(off < 2e-14, "{off:e} from {from:?} along {along:?}, {:e} later", hit.time);
            }
            *self = Last(Some((position, velocity)), orbit.track.time());
            ControlFlow::Continue(())
        }
    }
    for (normal, tangential) in [(0.001, 0.5), (1e-6, 0.5), (1e-10, -1.0)] {
        let law = Disk::new(&Restitution::new(normal, tangential).unwrap(), 0.5_f64.sqrt()).unwrap();
        for table in [
            tables::equilateral(1.0),
            tables::polygon(20, 1.0),
            tables::polygon(64, 1.0),
            tables::mushroom(1.0, 0.5, 0.75),
            tables::stadium(1.0, 1.0),
            tables::flower(5, 1.0, 1.0),
        ] {
            let table = table.unwrap();
            let starts = Canonical::new(&table, 1.0, 1).unwrap();
            let billiard = Planar { table: table.clone(), law };
            for k in 0..2000 {
                let mut orbit: Orbit<f64, 2, 1, (), Clock> = starts.start(k).orbit(Clock::new(0.0));
                let outcome = billiard.run(&mut orbit, &Collisions(300), &mut Last(None, 0.0));
                assert_ne!(outcome.stop, Stop::Escaped, "{normal} {tangential}: start {k}, {outcome:?}");
            }
        }
    }
}

#[test]
fn spin_that_never_becomes_velocity_makes_nothing_graze() {
    for table in [tables::circle(1.0), tables::square(1.0), tables::stadium(1.0, 1.0), tables::hexagon(1.0)] {
        let billiard =
            Planar { table: table.unwrap(), law: Disk::new(&billiards::collision_laws::laws::Specular, 0.5).unwrap() };
        for spin in [1e16, 1e20, 1e90] {
            let mut orbit: Orbit<f64, 2, 1> = Orbit::new([0.125, 0.25], [0.6, 0.7], [spin], ());
            assert_eq!(billiard.run(&mut orbit, &Collisions(100), &mut ()).stop, Stop::Finished);
            let lossy = Planar {
                table: billiard.table.clone(),
                law: Disk::new(&Restitution::new(0.9, -1.0).unwrap(), 0.5).unwrap(),
            };
            let mut orbit: Orbit<f64, 2, 1> = Orbit::new([0.125, 0.25], [0.6, 0.7], [spin], ());
            assert_eq!(lossy.run(&mut orbit, &Collisions(10), &mut ()).stop, Stop::Finished);
        }
    }
}

#[test]
fn pieces_that_are_all_specular_by_whatever_name_leave_spin_alone_as_one_law_does() {
    let [smooth, named] = [Disk::new(&Specular, 0.5), Disk::new(&Restitution::new(1.0, -1.0).unwrap(), 0.5)];
    let law = PerPiece::new(smooth.unwrap(), [named.unwrap()]);
    for table in [tables::circle(1.0), tables::square(1.0), tables::strip(1.0)] {
        let table = table.unwrap();
        let end = |law: &dyn Fn(&mut Orbit<f64, 2, 1>) -> Outcome| {
            let mut orbit: Orbit<f64, 2, 1> = Orbit::new([0.125, 0.25], [0.6, 0.7], [1e20], ());
            (law(&mut orbit), orbit)
        };
        let each =
            end(&|orbit| Planar { table: table.clone(), law: law.clone() }.run(orbit, &Collisions(100), &mut ()));
        assert_eq!(each.0.stop, Stop::Finished);
        let one = end(&|orbit| Planar { table: table.clone(), law: Specular }.run(orbit, &Collisions(100), &mut ()));
        let off = |i: usize| (each.1.position[i] - one.1.position[i]).abs();
        assert!(off(0) + off(1) < 1e-12 && each.1.spin == one.1.spin, "{each:?} {one:?}");
    }
}

#[test]
fn an_observer_that_has_seen_enough_does_not_hide_that_an_orbit_ends() {
    let table = tables::circle(1.0).unwrap();
    let billiard = Planar { table, law: damping() };
    let start: Orbit<f64, 2, 1> = Orbit::new([0.05, 0.55], [0.6, 0.37], [0.4], ());
    let (mut whole, mut bit) = (start, start);
    let at_once = billiard.run(&mut whole, &Collisions(1000), &mut ());
    assert_eq!(at_once.stop, Stop::Grazing);
    // collision by collision: the last one is no place to go on from
    let mut enough = Watch::new(|_: &Collision<'_, 2, 1, (), ()>| ControlFlow::Break(()));
    for n in 1..at_once.collisions {
        assert_eq!(billiard.run(&mut bit, &Collisions(1000), &mut enough).stop, Stop::Observer, "{n}");
    }
    let last = billiard.run(&mut bit, &Collisions(1000), &mut enough);
    assert_eq!((last.stop, last.collisions), (Stop::Grazing, 1));
}

/// The circle of radius 1, as a formula.
#[derive(Debug)]
struct One;

impl PolarFormula for One {
    fn jet(&self, _: f64) -> [f64; 3] {
        [1.0, 0.0, 0.0]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let zero = angle * 0.0;
        [zero + 1.0, zero, zero]
    }
}

#[test]
fn who_starts_along_a_focusing_wall_grazes_and_does_not_go_through() {
    let ends = [Vector2::new(1.0, 0.0), Vector2::new(-1.0, 0.0)];
    let dome: Vec<Box<dyn Piece>> = vec![
        Box::new(Arc::new(Vector2::zeros(), ends[0], ends[1], true).unwrap()),
        Box::new(Segment::new(ends[1], ends[0]).unwrap()),
    ];
    let formula: Box<dyn Piece> = Box::new(Polar::new(Vector2::zeros(), One, true).unwrap());
    for table in [Table::new(dome).unwrap(), Table::new(vec![formula]).unwrap()] {
        let billiard = Planar { table, law: Specular };
        for slope in [1e-8, 1e-9, 1e-12, 1e-15, 0.0] {
            let mut orbit: Orbit<f64, 2, 1> = Orbit::new([0.0, 1.0], [1.0, -slope], [0.0], ());
            let stop = billiard.run(&mut orbit, &Collisions(1000), &mut ()).stop;
            assert!(matches!(stop, Stop::Grazing | Stop::Finished), "{slope:e}: {stop:?}");
            assert!((libm::hypot(orbit.position[0], orbit.position[1]) - 1.0).abs() < 1e-15, "{slope:e}");
            // nor where time ends
            let mut timed: Orbit<f64, 2, 1, (), Clock> = Orbit::new([0.0, 1.0], [1.0, -slope], [0.0], Clock::new(0.0));
            let until_then = billiard.run(&mut timed, &Time(1e9), &mut ()).stop;
            assert!(stop != Stop::Grazing || until_then == Stop::Grazing, "{slope:e}: {until_then:?}");
        }
    }
}

#[test]
fn what_is_over_is_over_and_what_has_no_wall_ahead_ends_with_time() {
    let ends = [Vector2::new(1.0, 0.0), Vector2::new(-1.0, 0.0)];
    let dome: Vec<Box<dyn Piece>> = vec![
        Box::new(Arc::new(Vector2::zeros(), ends[0], ends[1], true).unwrap()),
        Box::new(Segment::new(ends[1], ends[0]).unwrap()),
    ];
    let dome = Planar { table: Table::new(dome).unwrap(), law: Specular };
    let along_the_wall = || Orbit::<f64, 2, 1, (), Clock>::new([0.0, 1.0], [1.0, 0.0], [0.0], Clock::new(0.0));
    let stop = |time: f64| dome.run(&mut along_the_wall(), &Time(time), &mut ()).stop;
    assert_eq!([1.0, 1e9].map(stop), [Stop::Grazing; 2]);
    // what is over is over, whatever lies ahead
    assert_eq!([-1.0, f64::NAN].map(stop), [Stop::Finished; 2]);
    let both = |limit| dome.run(&mut along_the_wall(), &limit, &mut ()).stop;
    assert_eq!(both((Collisions(0), Time(1.0))), Stop::Finished);
    assert_eq!(both((Collisions(9), Time(f64::INFINITY))), Stop::Grazing);
    // where there is no wall, time ends in the open
    let post: Box<dyn Piece> = Box::new(Circle::new(Vector2::new(0.0, -1.0), 1.0, false).unwrap());
    let plane = Planar { table: Table::new(vec![post]).unwrap(), law: Specular };
    assert_eq!(plane.run(&mut along_the_wall(), &Time(1.0), &mut ()).stop, Stop::Finished);
    assert_eq!(plane.run(&mut along_the_wall(), &Time(f64::INFINITY), &mut ()).stop, Stop::Escaped);
}

#[test]
fn who_leaves_a_wall_flat_that_does_not_focus_escapes_where_nothing_is_ahead() {
    let floor: Box<dyn Piece> = Box::new(FullLine::new(Vector2::new(0.0, 1.0), Vector2::new(1.0, 0.0)).unwrap());
    let disk: Box<dyn Piece> = Box::new(Circle::new(Vector2::new(0.0, -1.0), 2.0, false).unwrap());
    for wall in [floor, disk] {
        let billiard = Planar { table: Table::new(vec![wall]).unwrap(), law: Specular };
        for slope in [1e-9, 1e-12] {
            let mut orbit: Orbit<f64, 2, 1> = Orbit::new([0.0, 1.0], [1.0, slope], [0.0], ());
            assert_eq!(billiard.run(&mut orbit, &Collisions(10), &mut ()).stop, Stop::Escaped);
        }
    }
}
