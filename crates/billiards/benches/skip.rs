//! What each thing that a scene may use costs, and that it costs nothing where it is not used: pairs of runs that differ
//! in one thing, by turns on the same thread, in nanoseconds of processor time per collision.
//!
//! What is absent is an absent type, so the first number of each pair is that of a program which has never heard of it.
#![allow(clippy::print_stdout, reason = "prints a table")]

use billiards::collision_laws::laws::NoSlip;
use billiards::geometry::{Table, Vector2, Walls, tables, walls};
use billiards::laws::{Disk, PerPiece, RoughBall, Specular};
use billiards::observe::{Density, LaneObserver, Noted, Observer, PlanarRow, Record, VelocityPortrait};
use billiards::{
    Angle, BallLaw, Billiard, Canonical, CanonicalSpatial, Clock, Collisions, Conserved, Free, Keeping, Motion, Orbit,
    Starts, Track, Tracking, run, run_side_by_side,
};
use lanes::Lane;
use std::ops::ControlFlow;
use std::time::Duration;

/// Orbits of a run, collisions of each, and runs of each kind, of which the median counts.
const ORBITS: u64 = 64;
const COLLISIONS: u64 = 1000;
const ROUNDS: usize = 51;

type Start<const N: usize, const S: usize> = ([f64; N], [f64; N], [f64; S]);
type Run<'a> = Box<dyn FnMut() -> u64 + 'a>;

/// One orbit after another.
fn single<'a, B, const N: usize, const S: usize, K, T, O>(
    motion: &'a B,
    starts: &'a [Start<N, S>],
    track: T,
    mut observer: O,
) -> Run<'a>
where
    B: Motion<N, S>,
    K: Keeping<N, S> + 'a,
    T: Track<f64, N, S> + Clone + 'a,
    O: Observer<N, S, K, T> + 'a,
{
    Box::new(move || {
        let mut made = 0;
        for (x, v, w) in starts {
            let mut orbit = Orbit::<f64, N, S, K, T>::new(*x, *v, *w, track.clone());
            made += run(motion, &mut orbit, &Collisions(COLLISIONS), &mut observer).collisions;
        }
        made
    })
}

/// All orbits side by side.
fn many<'a, B, const N: usize, const S: usize, K, T, O>(
    motion: &'a B,
    starts: &'a [Start<N, S>],
    track: T,
    mut observer: O,
) -> Run<'a>
where
    B: Motion<N, S>,
    K: Keeping<N, S> + 'a,
    T: Tracking<N, S> + Track<f64, N, S> + 'a,
    O: LaneObserver<N, S, K, T> + 'a,
{
    Box::new(move || {
        let mut made = 0;
        let orbit = |(x, v, w): &Start<N, S>| Orbit::<f64, N, S, K, T>::new(*x, *v, *w, track.clone());
        run_side_by_side(motion, &mut starts.iter().map(orbit), &Collisions(COLLISIONS), &mut observer, &mut |f| {
            made += f.outcome.collisions;
        });
        made
    })
}

/// Processor time of this thread.
#[cfg(unix)]
fn now() -> Duration {
    use nix::time::{ClockId, clock_gettime};
    clock_gettime(ClockId::CLOCK_THREAD_CPUTIME_ID).map_or(Duration::ZERO, Duration::from)
}

/// Time, where there is no clock of threads.
#[cfg(not(unix))]
fn now() -> Duration {
    std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default()
}

fn row<'a>(name: &str, how: &str, mut without: Run<'a>, mut with: Run<'a>) {
    let mut times = [vec![], vec![]];
    for _ in 0..ROUNDS {
        for (times, run) in times.iter_mut().zip([&mut without, &mut with]) {
            let begun = now();
            let made = run();
            times.push(now().saturating_sub(begun).as_secs_f64() * 1e9 / made as f64);
        }
    }
    let [without, with] = times.map(|mut of_runs| {
        of_runs.sort_by(f64::total_cmp);
        of_runs[ROUNDS / 2]
    });
    println!("| {name} | {how} | {without:.1} | {with:.1} |");
}

fn disks(table: &Table) -> Vec<Start<2, 1>> {
    let canonical = Canonical::new(table, 1.0, 1).expect("a finite table");
    (0..ORBITS).map(|i| canonical.start(i)).map(|s| (s.position, s.velocity, s.spin)).collect()
}

/// Counts the velocities of all collisions, speeds being one.
struct Portrait {
    density: Density,
    noted: Noted,
}

impl LaneObserver<2, 1, Free, ()> for Portrait {
    type View<F: Lane> = F::Mask;
    fn nobody<F: Lane>(&self, zero: F) -> F::Mask {
        zero.never()
    }
    fn begin<F: Lane>(&mut self, view: &mut F::Mask, here: F::Mask, _: u64, _: &Orbit<f64, 2, 1, Free, ()>) {
        *view = *view | here;
    }
    fn end<F: Lane>(&mut self, view: &mut F::Mask, here: F::Mask) {
        *view = *view & !here;
    }
    #[inline(always)]
    fn collision<F: Lane>(&mut self, view: &mut F::Mask, hit: &walls::WallHit<F, 2>, orbit: &Orbit<F, 2, 1, Free, ()>) {
        let ([v1, v2], [n1, n2]) = (orbit.velocity, hit.normal);
        let point = [orbit.spin[0], (v2 * n1 - v1 * n2) * hit.inverse];
        let cells = self.density.cells(point, orbit.spin[0].same(self.density.layer(0)), *view);
        self.noted.note(&mut self.density, cells);
    }
}

fn on<'a, W: Walls<N>, L: BallLaw<N, S>, const N: usize, const S: usize>(
    walls: &'a W,
    law: &'a L,
) -> Billiard<'a, W, L> {
    Billiard { walls, law }
}

const ALONE: &str = "one orbit";
const TOGETHER: &str = "side by side";

/// Things that an orbit or a law may have.
fn of_orbits(no_slip: Disk) {
    let stadium = tables::stadium(1.0, 1.0).expect("a table");
    let capsule = walls::Capsule::new(Vector2::zeros(), 1.0, 1.0, [0, 1, 2, 3]).expect("walls");
    let starts = disks(&stadium);
    let points: Vec<Start<2, 0>> = starts.iter().map(|(x, v, _)| (*x, *v, [])).collect();

    let specular = on::<_, _, 2, 0>(&capsule, &Specular);
    let spinning = on::<_, _, 2, 1>(&capsule, &Specular);
    let name = "spin, under the specular law";
    row(
        name,
        ALONE,
        single::<_, 2, 0, Free, _, _>(&specular, &points, (), ()),
        single::<_, 2, 1, Free, _, _>(&spinning, &starts, (), ()),
    );
    row(
        name,
        TOGETHER,
        many::<_, 2, 0, Free, _, _>(&specular, &points, (), ()),
        many::<_, 2, 1, Free, _, _>(&spinning, &starts, (), ()),
    );

    let rough = on::<_, _, 2, 1>(&capsule, &no_slip);
    let plain = || single::<_, 2, 1, Free, _, _>(&rough, &starts, (), ());
    let plain_many = || many::<_, 2, 1, Free, _, _>(&rough, &starts, (), ());
    row("energy kept", ALONE, plain(), single::<_, 2, 1, Conserved<f64, 2>, _, _>(&rough, &starts, (), ()));
    row("energy kept", TOGETHER, plain_many(), many::<_, 2, 1, Conserved<f64, 2>, _, _>(&rough, &starts, (), ()));

    let clock = Clock::new(0.0);
    row("time", ALONE, plain(), single::<_, 2, 1, Free, _, _>(&rough, &starts, clock, ()));
    row("time", TOGETHER, plain_many(), many::<_, 2, 1, Free, _, _>(&rough, &starts, clock, ()));
    let timed = || single::<_, 2, 1, Free, _, _>(&rough, &starts, clock, ());
    let track = (clock, Angle::new(0.0));
    row("spin position", ALONE, timed(), single::<_, 2, 1, Free, _, _>(&rough, &starts, track, ()));

    let mut rows = Vec::with_capacity(1024);
    let record = Record::new(|row: PlanarRow| {
        if rows.len() == 1024 {
            rows.clear();
        }
        rows.push(row);
        ControlFlow::Continue(())
    });
    let turning = single::<_, 2, 1, Free, _, _>(&rough, &starts, track, ());
    row("record, into memory", ALONE, turning, single::<_, 2, 1, Free, _, _>(&rough, &starts, track, record));
    let portrait = VelocityPortrait::new(Density::disk(1000));
    row("density portrait", ALONE, plain(), single::<_, 2, 1, Free, _, _>(&rough, &starts, (), portrait));
    let density = Density::disk(1000);
    let portrait = Portrait { noted: Noted::new(&density), density };
    row("density portrait", TOGETHER, plain_many(), many::<_, 2, 1, Free, _, _>(&rough, &starts, (), portrait));

    let own = PerPiece::new(no_slip, [no_slip; 3]);
    let own = on::<_, _, 2, 1>(&capsule, &own);
    row("a law for each piece", ALONE, plain(), single::<_, 2, 1, Free, _, _>(&own, &starts, (), ()));
    row("a law for each piece", TOGETHER, plain_many(), many::<_, 2, 1, Free, _, _>(&own, &starts, (), ()));
}

/// Things that a table may have.
fn of_tables(no_slip: Disk) {
    let stadium = tables::stadium(1.0, 1.0).expect("a table");
    let list = |table: &Table| (table.list(0..table.pieces().len()), disks(table));
    let (drawn, drawn_starts) = list(&stadium);
    let (centres, centres_starts) = list(&stadium.offset(0.25).expect("room for a disk").table);
    let (drawn, centres) = (on::<_, _, 2, 1>(&drawn, &no_slip), on::<_, _, 2, 1>(&centres, &no_slip));
    let name = "offset for a disk of radius 1/4, as a list of pieces";
    row(
        name,
        ALONE,
        single::<_, 2, 1, Free, _, _>(&drawn, &drawn_starts, (), ()),
        single::<_, 2, 1, Free, _, _>(&centres, &centres_starts, (), ()),
    );

    let polygon = |sides| list(&tables::polygon(sides, 1.0).expect("a polygon"));
    let ((few, few_starts), (many_sides, many_starts)) = (polygon(48), polygon(480));
    let (few, many_sides) = (on::<_, _, 2, 1>(&few, &no_slip), on::<_, _, 2, 1>(&many_sides, &no_slip));
    row(
        "tree of boxes: 48 sides without, 480 with it",
        ALONE,
        single::<_, 2, 1, Free, _, _>(&few, &few_starts, (), ()),
        single::<_, 2, 1, Free, _, _>(&many_sides, &many_starts, (), ()),
    );

    let disk = || walls::Scatterer::new(Vector2::new(0.5, 0.5), 0.25, 4).expect("a disk");
    let square = || walls::Cuboid::new([0.0; 2], [1.0; 2], [[3, 1], [0, 2]]).expect("a square");
    let sinai = walls::Around { container: square(), obstacles: disk() };
    let torus_table = tables::sinai_torus(0.25, 1.0).expect("a table");
    let torus = walls::Periodic::new(disk(), torus_table.lattice().expect("a lattice"));
    let sinai_starts = disks(&tables::sinai(1.0, 0.25).expect("a table"));
    let (sinai, torus) = (on::<_, _, 2, 1>(&sinai, &no_slip), on::<_, _, 2, 1>(&torus, &no_slip));
    let name = "lattice in place of a square's walls, about a disk";
    row(
        name,
        ALONE,
        single::<_, 2, 1, Free, _, _>(&sinai, &sinai_starts, (), ()),
        single::<_, 2, 1, Free, _, _>(&torus, &sinai_starts, (), ()),
    );
    row(
        name,
        TOGETHER,
        many::<_, 2, 1, Free, _, _>(&sinai, &sinai_starts, (), ()),
        many::<_, 2, 1, Free, _, _>(&torus, &sinai_starts, (), ()),
    );

    let cube = walls::Cuboid::new([0.0; 3], [1.0; 3], [[0, 1], [2, 3], [4, 5]]).expect("a cube");
    let cube_table = tables::cuboid([1.0; 3]).expect("a cube");
    let spatial = CanonicalSpatial::new(&cube_table, 1.0, 1).expect("a finite table");
    let balls: Vec<Start<3, 3>> =
        (0..ORBITS).map(|i| spatial.start(i)).map(|s| (s.position, s.velocity, s.spin)).collect();
    let (square, ball) = (square(), RoughBall::no_slip(0.4_f64.sqrt()).unwrap());
    let (square, cube) = (on::<_, _, 2, 1>(&square, &no_slip), on::<_, _, 3, 3>(&cube, &ball));
    let square_starts = disks(&tables::square(1.0).expect("a table"));
    let name = "third dimension: a cube in place of a square";
    row(
        name,
        ALONE,
        single::<_, 2, 1, Free, _, _>(&square, &square_starts, (), ()),
        single::<_, 3, 3, Free, _, _>(&cube, &balls, (), ()),
    );
    row(
        name,
        TOGETHER,
        many::<_, 2, 1, Free, _, _>(&square, &square_starts, (), ()),
        many::<_, 3, 3, Free, _, _>(&cube, &balls, (), ()),
    );
}

fn main() {
    println!("| what | how | without | with |\n|---|---|---|---|");
    let no_slip = Disk::new(&NoSlip, 0.5_f64.sqrt()).unwrap();
    of_orbits(no_slip);
    of_tables(no_slip);
}
