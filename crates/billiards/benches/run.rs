//! Nanoseconds per collision of the engine's loops, table by table: one orbit at a time, and many in vector registers.

use billiards::{
    Canonical, Collisions, Conserved, Orbit, Planar, Start, Starts,
    collision_laws::laws::{NoSlip, Specular},
    geometry::{Table, tables},
    laws::Disk,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Orbits of a round, and collisions of each.
const ORBITS: u64 = 512;
const COLLISIONS: u64 = 20;

fn all_tables() -> [(&'static str, Table); 8] {
    let table = |made: Result<Table, billiards::geometry::Error>| made.expect("sizes of a table");
    [
        ("circle", table(tables::circle(1.0))),
        ("ellipse", table(tables::ellipse([2.0, 1.0]))),
        ("square", table(tables::square(1.0))),
        ("triangle", table(tables::equilateral(1.0))),
        ("hexagon", table(tables::hexagon(1.0))),
        ("stadium", table(tables::stadium(1.0, 1.0))),
        ("sinai", table(tables::sinai(1.0, 0.25))),
        ("mushroom", table(tables::mushroom(1.0, 0.5, 0.75))),
    ]
}

fn orbit(start: &Start<2, 1>) -> Orbit<f64, 2, 1, Conserved<f64, 2>> {
    start.orbit(())
}

fn run(criterion: &mut Criterion) {
    let laws = [("specular", Disk::new(&Specular, 0.5_f64.sqrt())), ("no-slip", Disk::new(&NoSlip, 0.5_f64.sqrt()))];
    for (law_name, law) in laws {
        let mut group = criterion.benchmark_group(law_name);
        group.throughput(Throughput::Elements(ORBITS * COLLISIONS)).sample_size(20);
        for (name, table) in all_tables() {
            let canonical = Canonical::new(&table, 1.0, 1).expect("a finite table");
            let starts: Vec<Start<2, 1>> = (0..ORBITS).map(|i| canonical.start(i)).collect();
            let billiard = Planar { table: table.clone(), law };
            group.bench_function(format!("{name}, one by one"), |b| {
                b.iter(|| {
                    let one = |s: &Start<2, 1>| {
                        let mut orbit = orbit(s);
                        billiard.run(&mut orbit, &Collisions(COLLISIONS), &mut ()).collisions
                    };
                    starts.iter().map(one).sum::<u64>()
                });
            });
            group.bench_function(format!("{name}, side by side"), |b| {
                b.iter(|| {
                    let mut made = 0;
                    let mut orbits = starts.iter().map(orbit);
                    billiard.run_side_by_side(&mut orbits, COLLISIONS, &mut (), &mut |f| made += f.outcome.collisions);
                    made
                });
            });
        }
    }
}

criterion_group!(benches, run);
criterion_main!(benches);
