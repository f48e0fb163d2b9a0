//! Nanoseconds per collision of the engine's loops, table by table: one orbit at a time, and many in vector registers.

use billiards::{
    Billiard, Canonical, CanonicalSpatial, Collisions, Conserved, Orbit, Planar, Start, Starts,
    collision_laws::laws::{NoSlip, Specular},
    geometry::{
        Piece, Table, Vector2, Walls, WithWalls,
        parry::{Room, Side, SolidSpec},
        shapes::{
            Ellipse, Segment,
            curve::{Interval, Polar, PolarFormula},
        },
        tables,
        walls::{ByLane, Few, Graphs, List},
    },
    laws::{Disk, RoughBall},
    run, run_side_by_side,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// Orbits of a round, and collisions of each: of long ones the CPU learns the order of the walls.
const ORBITS: u64 = 512;
const COLLISIONS: u64 = 1000;
const LONG: u64 = 10_000;

fn all_tables() -> [(&'static str, Table); 9] {
    let table = |made: Result<Table, billiards::geometry::Error>| made.expect("sizes of a table");
    [
        ("circle", table(tables::circle(1.0))),
        ("strip", table(tables::strip(1.0))),
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

fn tables_and_laws(criterion: &mut Criterion) {
    let laws = [
        ("specular", Disk::new(&Specular, 0.5_f64.sqrt()).unwrap()),
        ("no-slip", Disk::new(&NoSlip, 0.5_f64.sqrt()).unwrap()),
    ];
    for (law_name, law) in laws {
        let mut group = criterion.benchmark_group(law_name);
        group.throughput(Throughput::Elements(ORBITS * LONG)).sample_size(20);
        for (name, table) in all_tables() {
            // starts in the strip, which has no end, are those of a square that fits
            let part = if name == "strip" { tables::square(1.0) } else { Ok(table.clone()) }.expect("a table");
            let canonical = Canonical::new(&part, 1.0, 1).expect("a finite table");
            let starts: Vec<Start<2, 1>> = (0..ORBITS).map(|i| canonical.start(i)).collect();
            let billiard = Planar { table: table.clone(), law };
            group.bench_function(format!("{name}, one by one"), |b| {
                b.iter(|| {
                    let one = |s: &Start<2, 1>| {
                        let mut orbit = orbit(s);
                        billiard.run(&mut orbit, &Collisions(LONG), &mut ()).collisions
                    };
                    starts.iter().map(one).sum::<u64>()
                });
            });
            group.bench_function(format!("{name}, side by side"), |b| {
                b.iter(|| {
                    let mut made = 0;
                    let mut orbits = starts.iter().map(orbit);
                    billiard.run_side_by_side(&mut orbits, &Collisions(LONG), &mut (), &mut |f| {
                        made += f.outcome.collisions;
                    });
                    made
                });
            });
        }
    }
}

/// The polygon with so many sides between points of a flower, r = 1 + cos(5φ)/5.
fn flower(sides: u32) -> Table {
    let corner = |k: u32| {
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * (f64::from(k % sides) + 0.25) / f64::from(sides));
        // cos 5φ by Chebyshev's polynomial
        Vector2::new(cos, sin) * (1.0 + 0.2 * cos * (5.0 - cos * cos * (20.0 - 16.0 * cos * cos)))
    };
    let side = |k: u32| Box::new(Segment::new(corner(k), corner(k + 1)).expect("two corners")) as Box<dyn Piece>;
    Table::new((0..sides).map(side).collect()).expect("a closed outline")
}

fn many_sides(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flower polygon");
    group.throughput(Throughput::Elements(ORBITS * COLLISIONS)).sample_size(10);
    for sides in [8, 16, 32, 100, 1000, 10_000, 100_000, 1_000_000] {
        let table = flower(sides);
        let starts: Vec<Start<2, 1>> = {
            let canonical = Canonical::new(&table, 1.0, 1).expect("a finite table");
            (0..ORBITS).map(|i| canonical.start(i)).collect()
        };
        let billiard = Planar { table, law: Disk::new(&NoSlip, 0.5_f64.sqrt()).unwrap() };
        group.bench_function(format!("{sides} sides, one by one"), |b| {
            b.iter(|| {
                let one = |s: &Start<2, 1>| billiard.run(&mut orbit(s), &Collisions(COLLISIONS), &mut ()).collisions;
                starts.iter().map(one).sum::<u64>()
            });
        });
        group.bench_function(format!("{sides} sides, side by side"), |b| {
            b.iter(|| {
                let mut made = 0;
                let mut orbits = starts.iter().map(orbit);
                billiard.run_side_by_side(&mut orbits, &Collisions(COLLISIONS), &mut (), &mut |f| {
                    made += f.outcome.collisions;
                });
                made
            });
        });
    }
}

/// The rectangle 6 × 4 about an ellipse with these semi-axes: most hits are not on it.
fn around_an_ellipse(semi_axes: [f64; 2]) -> Result<Table, billiards::geometry::Error> {
    let corners = [[-3.0, -2.0], [3.0, -2.0], [3.0, 2.0], [-3.0, 2.0]].map(Vector2::from);
    let mut pieces: Vec<Box<dyn Piece>> = vec![Box::new(Ellipse::new(Vector2::new(0.5, 0.5), semi_axes, 0.03, false)?)];
    for k in 0..4 {
        pieces.push(Box::new(Segment::new(corners[k], corners[(k + 1) % 4])?));
    }
    Table::new(pieces)
}

/// Tables as walls that know nothing but their pieces: in lanes, and one lane after another.
fn as_pieces(criterion: &mut Criterion) {
    let table = |made: Result<Table, billiards::geometry::Error>| made.expect("sizes of a table");
    let all = [
        ("stadium", table(tables::stadium(1.0, 1.0))),
        ("mushroom", table(tables::mushroom(1.0, 1.0, 1.0))),
        ("moon", table(tables::moon(1.0, 0.75, 1.0))),
        ("flower", table(tables::flower(4, 1.25, 2.0))),
        ("pocket", table(tables::pocket([2.0, 1.0], 0.3125, 0.5625))),
        ("ellipse", table(tables::ellipse([2.0, 1.0]))),
        ("slim ellipse in a box", table(around_an_ellipse([0.4, 0.01]))),
    ];
    for (name, table) in all {
        let pieces: Vec<_> = table.pieces().iter().cloned().enumerate().collect();
        let shapes: Vec<_> = pieces.iter().filter_map(|(i, piece)| Some((*i, piece.shape()?))).collect();
        on(criterion, &format!("{name} (few)"), &table, &Few::new(&shapes, table.corners()));
        on(criterion, &format!("{name} (list)"), &table, &List::new(pieces, table.corners()));
    }
}

/// `r = 1 + a cos nφ`
#[derive(Clone, Copy, Debug)]
struct Clover {
    a: f64,
    n: f64,
}

impl PolarFormula for Clover {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(self.n * angle);
        [1.0 + self.a * cos, -self.n * self.a * sin, -self.n * self.n * self.a * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [sin, cos] = (angle * self.n).sin_cos();
        [cos * self.a + 1.0, sin * (-self.n * self.a), cos * (-self.n * self.n * self.a)]
    }
}

/// Curves given by formulas, as polynomial graphs and by the majorant method.
fn curves(criterion: &mut Criterion) {
    for (a, n) in [(0.1, 3.0), (0.2, 5.0), (0.05, 20.0)] {
        let curve = Polar::new(Vector2::zeros(), Clover { a, n }, true).expect("a radius that is positive");
        let graphs: Vec<_> = curve.graphs().expect("a smooth curve").into_iter().map(|graph| (0, graph)).collect();
        let table = Table::new(vec![Box::new(curve)]).expect("a closed curve");
        on(criterion, &format!("1 + {a} cos {n} phi (graphs)"), &table, &Graphs::new(&graphs, &[]));
        on(criterion, &format!("1 + {a} cos {n} phi (list)"), &table, &table.list([0]));
    }
}

fn on(criterion: &mut Criterion, name: &str, table: &Table, walls: &impl Walls<2>) {
    let mut group = criterion.benchmark_group("pieces");
    group.throughput(Throughput::Elements(ORBITS * COLLISIONS)).sample_size(20);
    let canonical = Canonical::new(table, 1.0, 1).expect("a finite table");
    let starts: Vec<Start<2, 1>> = (0..ORBITS).map(|i| canonical.start(i)).collect();
    let billiard = Billiard { walls, law: &Disk::new(&NoSlip, 0.5_f64.sqrt()).unwrap() };
    group.bench_function(format!("{name}, one by one"), |b| {
        b.iter(|| {
            let one = |s: &Start<2, 1>| run(&billiard, &mut orbit(s), &Collisions(COLLISIONS), &mut ()).collisions;
            starts.iter().map(one).sum::<u64>()
        });
    });
    group.bench_function(format!("{name}, side by side"), |b| {
        b.iter(|| {
            let mut made = 0;
            run_side_by_side(&billiard, &mut starts.iter().map(orbit), &Collisions(COLLISIONS), &mut (), &mut |f| {
                made += f.outcome.collisions;
            });
            made
        });
    });
}

/// Rooms in space, by the walls that they find and by the exact answers of their solids.
fn rooms(criterion: &mut Criterion) {
    let hull = |points: &[[f64; 3]]| SolidSpec::ConvexHull { points: points.into(), rounding: 0.0 };
    let tetrahedron = hull(&[[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]);
    let axes = |a: f64| {
        [[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [0.0, 0.0, a], [0.0, 0.0, -a]]
    };
    let capsule = SolidSpec::Capsule { from: [0.0, 0.0, -1.0], to: [0.0, 0.0, 1.0], radius: 1.0 };
    let ball = (SolidSpec::Ball { radius: 1.0 }, Side::Inside);
    let floor = (SolidSpec::HalfSpace { normal: [0.0, 0.0, 1.0] }, Side::Outside);
    let cube = |size: f64| SolidSpec::Cuboid { size: [size; 3], rounding: 0.0 };
    let drum = SolidSpec::Cylinder { radius: 1.0, height: 4.0, rounding: 0.0 };
    let rooms = [
        ("tetrahedron", vec![(tetrahedron, Side::Inside)]),
        ("octahedron", vec![(hull(&axes(1.4)), Side::Inside)]),
        ("capsule", vec![(capsule, Side::Inside)]),
        ("half a ball", vec![ball, floor]),
        ("cylinder across a cube", vec![(cube(4.0), Side::Inside), (drum, Side::Outside)]),
        ("cube in a cube", vec![(cube(4.0), Side::Inside), (cube(1.0), Side::Outside)]),
    ];
    for (name, solids) in rooms {
        let solids = solids.iter().map(|(spec, side)| spec.solid([0.0; 3], *side).expect("a solid"));
        let room = Room::new(solids.collect());
        let surface = room.surface().expect("a bounded room");
        let canonical = CanonicalSpatial::new(&surface, 1.0, 1).expect("a speed");
        let starts: Vec<Start<3, 3>> = (0..ORBITS).map(|i| canonical.start(i)).collect();
        let mut group = criterion.benchmark_group("rooms");
        group.throughput(Throughput::Elements(ORBITS * COLLISIONS)).sample_size(20);
        let mut bench = |name: String, run: &mut dyn FnMut() -> u64| {
            group.bench_function(name, |b| b.iter(&mut *run));
        };
        room.with_walls(InRoom { name: name.into(), starts: &starts, bench: &mut bench });
        InRoom { name: format!("{name} (exact)"), starts: &starts, bench: &mut bench }.run(&ByLane(&room));
    }
}

/// Measures orbits between walls in space, one by one and side by side.
struct InRoom<'a> {
    name: String,
    starts: &'a [Start<3, 3>],
    bench: &'a mut dyn FnMut(String, &mut dyn FnMut() -> u64),
}

impl WithWalls<3> for InRoom<'_> {
    type Output = ();
    fn run<W: Walls<3>>(self, walls: &W) {
        let InRoom { name, starts, bench } = self;
        let billiard = Billiard { walls, law: &RoughBall::no_slip(0.4_f64.sqrt()).expect("a ball") };
        let orbit = |start: &Start<3, 3>| start.orbit::<(), ()>(());
        bench(format!("{name}, one by one"), &mut || {
            let one = |s: &Start<3, 3>| run(&billiard, &mut orbit(s), &Collisions(COLLISIONS), &mut ()).collisions;
            starts.iter().map(one).sum()
        });
        bench(format!("{name}, side by side"), &mut || {
            let mut made = 0;
            run_side_by_side(&billiard, &mut starts.iter().map(orbit), &Collisions(COLLISIONS), &mut (), &mut |f| {
                made += f.outcome.collisions;
            });
            made
        });
    }
}

criterion_group!(benches, tables_and_laws, many_sides, as_pieces, curves, rooms);
criterion_main!(benches);
