//! Orbits side by side end where their time is up, as each does alone.
use billiards::{
    Billiard, Canonical, Clock, Collisions, Conserved, Finished, LaneLimit, Motion, Orbit, Outcome, Planar, Rolling,
    Start, Starts, Stop, Time, Timed, laws::Disk, run, run_side_by_side,
};
use collision_laws::laws::{NoSlip, Specular};
use geometry::{
    Table, tables,
    walls::{Cuboid, Pieces, Sphere, Wedge},
};
use lanes::Double;

type Disks = Orbit<f64, 2, 1, Conserved<f64, 2>, Clock>;
type Ended = Finished<2, 1, Conserved<f64, 2>, Clock>;

fn orbits(table: &Table) -> Vec<Disks> {
    let starts = Canonical::new(table, 1.0, 3).unwrap();
    (0..90).map(|k| starts.start(k).orbit(Clock::new(0.0))).collect()
}

/// How orbits end under a limit, in their order, which is how each ends alone.
fn ends(billiard: &impl Motion<2, 1>, orbits: &[Disks], limit: &impl LaneLimit<2, 1, Clock>) -> Vec<Ended> {
    let mut ended: Vec<Ended> = vec![];
    run_side_by_side(billiard, &mut orbits.iter().copied(), limit, &mut (), &mut |f| ended.push(f));
    ended.sort_by_key(|f| f.index);
    assert_eq!(ended.len(), orbits.len());
    for (orbit, lane) in orbits.iter().zip(&ended) {
        let mut alone = *orbit;
        let outcome = run(billiard, &mut alone, limit, &mut ());
        assert_eq!(lane.outcome, outcome, "{}", lane.index);
        let bits = |o: &Disks| {
            let ([x, y], [u, v], [w]) = (o.position, o.velocity, o.spin);
            [x, y, u, v, w, o.track.time()].map(f64::to_bits)
        };
        assert_eq!(bits(&lane.orbit), bits(&alone), "{}", lane.index);
    }
    ended
}

fn end_in_time(table: &Table, billiard: &impl Motion<2, 1>) {
    let all = orbits(table);
    let finished = |ended: &[Ended]| ended.iter().filter(|f| f.outcome.stop == Stop::Finished).count();
    // whichever comes first, and on from there
    let both = ends(billiard, &all, &(Collisions(30), Time(20.0)));
    let made = |some: fn(u64) -> bool| both.iter().any(|f| some(f.outcome.collisions));
    assert!(made(|n| n == 30) && made(|n| n < 30));
    let later: Vec<Disks> = both.iter().map(|f| f.orbit).collect();
    assert!(ends(billiard, &later, &(Collisions(30), Time(f64::INFINITY))).iter().any(|f| f.outcome.collisions == 30));
    ends(billiard, &later, &(Collisions(u64::MAX), Time(40.0)));
    for time in [20.0, 1e-3, 0.0, -1.0, f64::NAN] {
        let ended = ends(billiard, &all, &Time(time));
        assert!(finished(&ended) > 80, "{time}");
        assert!(ended.iter().all(|f| f.orbit.track.time() <= time.max(0.0)), "{time}");
    }
    // at a collision, but for rounding
    let at = ends(billiard, &all, &(Collisions(7), Time(f64::INFINITY)))[0].orbit.track.time();
    for (time, made) in [(at * (1.0 + 1e-15), 7), (at * (1.0 - 1e-15), 6)] {
        let ended = ends(billiard, &all, &Time(time));
        assert_eq!(ended[0].outcome, Outcome { stop: Stop::Finished, collisions: made });
    }
}

#[test]
fn orbits_end_where_their_time_is_up_with_the_bits_that_they_have_alone() {
    let law = Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap();
    let walls = Cuboid::new([0.0; 2], [1.0; 2], [[0, 1], [2, 3]]).unwrap();
    end_in_time(&tables::square(1.0).unwrap(), &Billiard { walls: &walls, law: &law });
    let walls = Sphere::new([0.0; 2].into(), 1.0, 0).unwrap();
    end_in_time(&tables::circle(1.0).unwrap(), &Rolling::new(&walls, &law));
    let mushroom = tables::mushroom(1.0, 0.5, 0.75).unwrap();
    let walls = Pieces::new(mushroom.pieces().iter().cloned().enumerate().collect(), mushroom.corners());
    end_in_time(&mushroom, &Billiard { walls: &walls, law: &law });
}

#[test]
fn what_hits_nothing_any_more_is_finished_where_time_is_limited_and_has_escaped_where_not() {
    let table = tables::wedge(1.0).unwrap();
    let figures: Vec<_> = table.pieces().iter().map(|piece| piece.figure()).collect();
    let walls = Wedge::new([figures[1], figures[0]], [1, 0]).unwrap();
    let law = Disk::new(&Specular, 1.0).unwrap();
    let billiard = Billiard { walls: &walls, law: &law };
    let away = |k: u32| Start { position: [0.0, 2.0], velocity: [0.1 * f64::from(k), 1.0], spin: [0.3] };
    let all: Vec<Disks> = (0..40).map(|k| away(k).orbit(Clock::new(0.0))).collect();
    for (time, stop) in [(f64::INFINITY, Stop::Escaped), (100.0, Stop::Finished)] {
        assert!(ends(&billiard, &all, &Time(time)).iter().all(|f| f.outcome.stop == stop), "{time}");
    }
}

#[test]
fn a_run_begins_with_a_clock_whose_parts_do_not_overlap() {
    let table = tables::square(1.0).unwrap();
    let billiard = Planar { table, law: Specular };
    // as 10⁹ flights that are all alike leave it
    let late = Clock(Double { high: 1e9, low: 0.375 });
    let start = Disks::new([0.5, 0.5], [0.0, 1.0], [0.0], late);
    let mut alone = start;
    billiard.run(&mut alone, &Collisions(2), &mut ());
    assert_eq!(alone.track.0, Double { high: 1e9 + 1.875, low: 0.0 });
    let mut beside = vec![];
    billiard.run_side_by_side(&mut [start; 40].into_iter(), &Collisions(2), &mut (), &mut |ended| beside.push(ended));
    assert!(beside.iter().all(|ended| ended.orbit.track == alone.track));
}
