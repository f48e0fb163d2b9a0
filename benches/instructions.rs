//! Instructions of the hot functions, counted by valgrind: the same on every run, so that a change of a percent is seen.
//!
//! ```sh
//! cargo install gungraun-runner --version 0.20.0   # once; and valgrind
//! cargo bench --features gungraun --bench instructions
//! ```
#![allow(missing_docs, reason = "made by macros")]
use billiards::collision_laws::laws::NoSlip;
use billiards::geometry::{Table, tables};
use billiards::laws::Disk;
use billiards::observe::Density;
use billiards::{Canonical, Collisions, Conserved, Orbit, Planar, Start, Starts};
use gungraun::{library_benchmark, library_benchmark_group, main};
use std::hint::black_box;

const ORBITS: u64 = 64;
const COLLISIONS: u64 = 50;

type Ready = (Planar<Disk>, Vec<Start<2, 1>>);

fn ready(table: Result<Table, billiards::geometry::Error>) -> Ready {
    let table = table.expect("sizes of a table");
    let canonical = Canonical::new(&table, 1.0, 1).expect("a finite table");
    let starts = (0..ORBITS).map(|i| canonical.start(i)).collect();
    (Planar { table: table.clone(), law: Disk::new(&NoSlip, 0.5_f64.sqrt()).unwrap() }, starts)
}

fn orbit(start: &Start<2, 1>) -> Orbit<f64, 2, 1, Conserved<f64, 2>> {
    start.orbit(())
}

#[library_benchmark]
#[bench::circle(ready(tables::circle(1.0)))]
#[bench::square(ready(tables::square(1.0)))]
#[bench::hexagon(ready(tables::hexagon(1.0)))]
#[bench::stadium(ready(tables::stadium(1.0, 1.0)))]
#[bench::sinai(ready(tables::sinai(1.0, 0.25)))]
#[bench::mushroom(ready(tables::mushroom(1.0, 0.5, 0.75)))]
#[bench::ellipse(ready(tables::ellipse([2.0, 1.0])))]
fn one_by_one((billiard, starts): Ready) -> u64 {
    let run = |start: &Start<2, 1>| billiard.run(&mut orbit(start), &Collisions(COLLISIONS), &mut ()).collisions;
    black_box(starts.iter().map(run).sum())
}

#[library_benchmark]
#[bench::circle(ready(tables::circle(1.0)))]
#[bench::square(ready(tables::square(1.0)))]
#[bench::hexagon(ready(tables::hexagon(1.0)))]
#[bench::stadium(ready(tables::stadium(1.0, 1.0)))]
#[bench::sinai(ready(tables::sinai(1.0, 0.25)))]
#[bench::mushroom(ready(tables::mushroom(1.0, 0.5, 0.75)))]
fn side_by_side((billiard, starts): Ready) -> u64 {
    let mut made = 0;
    let finished = &mut |finished: billiards::Finished<2, 1, _, ()>| made += finished.outcome.collisions;
    billiard.run_side_by_side(&mut starts.iter().map(orbit), &Collisions(COLLISIONS), &mut (), finished);
    black_box(made)
}

#[library_benchmark]
#[bench::disk(Density::disk(200))]
fn density(mut density: Density) -> u64 {
    for i in 0..10_000_u32 {
        density.add([f64::from(i % 101) * 0.01, f64::from(i % 97) * 0.01]);
    }
    black_box(density.outside())
}

library_benchmark_group!(name = hot, benchmarks = [one_by_one, side_by_side, density]);
main!(library_benchmark_groups = hot);
