//! Limits of time.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use billiards::geometry::{Vector2, walls::Sphere};
use billiards::laws::Specular;
use billiards::{Billiard, Clock, Collisions, Orbit, Time, Timed, run, run_side_by_side};

/// In a circle: the time of a collision is a sum whose rounding goes either way.
#[test]
fn a_run_up_to_the_time_of_a_collision_includes_it() {
    let circle = Sphere::new(Vector2::zeros(), 1.0, 0).unwrap();
    let billiard = Billiard { walls: &circle, law: &Specular };
    let start = || Orbit::<f64, 2, 0, (), Clock>::new([0.1, 0.2], [0.6, 0.77], [], Clock::new(0.0));
    let mut orbit = start();
    let times: Vec<f64> = (0..2000)
        .map(|_| {
            run(&billiard, &mut orbit, &Collisions(1), &mut ());
            orbit.track.time()
        })
        .collect();
    let collisions = |limit: f64| {
        let alone = run(&billiard, &mut start(), &Time(limit), &mut ()).collisions;
        let mut together = vec![];
        let starts = (0..9).map(|_| start());
        run_side_by_side(&billiard, &mut starts.into_iter(), &Time(limit), &mut (), &mut |finished| {
            together.push(finished.outcome.collisions);
        });
        assert!(together.iter().all(|count| *count == alone), "{limit}: {together:?} {alone}");
        alone
    };
    for (n, time) in (1..).zip(times) {
        assert_eq!([time.next_down(), time, time.next_up()].map(collisions), [n - 1, n, n], "{time}");
    }
}
