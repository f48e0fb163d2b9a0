//! Nanoseconds per first hit of a piece, and the time it takes to build, check and search large outlines.

use core::f64::consts::TAU;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use geometry::{
    BoxTree, Crossing, Extent, Line, Piece, Table, Vector2, Walls,
    shapes::{Arc, Circle, Ellipse, FullLine, Ray, Segment},
    walls::Polygon,
};
use std::hint::black_box;

/// Paths from around the origin in all directions.
fn paths() -> Vec<Line<2>> {
    let path = |k: u32| {
        let (sin, cos) = libm::sincos(0.1 + 0.37 * f64::from(k));
        Line { point: Vector2::new(0.2 * sin, 0.1 * cos), velocity: Vector2::new(cos, sin) }
    };
    (0..256).map(path).collect()
}

fn pieces() -> Vec<(&'static str, Box<dyn Piece>)> {
    let v = Vector2::new;
    let expect = "the sizes of a shape";
    vec![
        ("segment", Box::new(Segment::new(v(1.0, -1.0), v(1.0, 1.0)).expect(expect))),
        ("ray", Box::new(Ray::new(v(1.0, 0.0), v(0.0, 1.0), true).expect(expect))),
        ("line", Box::new(FullLine::new(v(1.0, 0.0), v(0.0, 1.0)).expect(expect))),
        ("circle", Box::new(Circle::new(v(0.0, 0.0), 1.0, true).expect(expect))),
        ("arc", Box::new(Arc::new(v(0.0, 0.0), v(0.0, -1.0), v(0.0, 1.0), true).expect(expect))),
        ("ellipse", Box::new(Ellipse::new(v(0.0, 0.0), [2.0, 1.0], 0.3, true).expect(expect))),
    ]
}

fn first_hit(criterion: &mut Criterion) {
    let paths = paths();
    let mut group = criterion.benchmark_group("first hit");
    group.throughput(Throughput::Elements(paths.len() as u64));
    for (name, piece) in pieces() {
        group.bench_function(name, |b| {
            b.iter(|| paths.iter().filter(|path| piece.crossing(black_box(path)).time() < f64::INFINITY).count());
        });
        group.bench_function(format!("{name}, with its landing"), |b| {
            b.iter(|| {
                let land = |path: &Line<2>| {
                    let time = piece.crossing(black_box(path)).time();
                    if time < f64::INFINITY { piece.landing(path, time).point.x } else { 0.0 }
                };
                paths.iter().map(land).sum::<f64>()
            });
        });
    }
    group.finish();
}

/// The polygon with `sides` sides between points of a flower, r = 1 + cos(5φ)/5.
fn flower(sides: u32) -> Table {
    let corner = |k: u32| {
        let (sin, cos) = libm::sincos(TAU * (f64::from(k % sides) + 0.25) / f64::from(sides));
        // cos 5φ by Chebyshev's polynomial
        Vector2::new(cos, sin) * (1.0 + 0.2 * cos * (5.0 - cos * cos * (20.0 - 16.0 * cos * cos)))
    };
    let side = |k: u32| Box::new(Segment::new(corner(k), corner(k + 1)).expect("two corners")) as Box<dyn Piece>;
    Table::new((0..sides).map(side).collect()).expect("a closed outline")
}

fn polygon(table: &Table) -> Polygon {
    let side = |[a, b]: [Vector2<f64>; 2]| Segment::new(a, b).expect("a side");
    let sides: Vec<_> = table.pieces().iter().map(|piece| side(piece.ends().expect("a side"))).enumerate().collect();
    Polygon::new(&sides, table.corners())
}

fn outlines(criterion: &mut Criterion) {
    let paths = paths();
    let mut group = criterion.benchmark_group("outline");
    group.sample_size(10);
    for sides in [1000, 100_000, 1_000_000] {
        let table = flower(sides);
        let extents: Vec<Extent> = table.pieces().iter().map(Piece::extent).collect();
        group.bench_with_input(BenchmarkId::new("table", sides), &sides, |b, &sides| b.iter(|| flower(sides)));
        if sides <= 100_000 {
            group.bench_function(BenchmarkId::new("validate", sides), |b| b.iter(|| table.validate()));
        }
        group.bench_function(BenchmarkId::new("tree of boxes", sides), |b| {
            b.iter(|| BoxTree::new(extents.iter().copied()));
        });
        group.bench_function(BenchmarkId::new("walls of straight sides", sides), |b| b.iter(|| polygon(&table)));
        group.throughput(Throughput::Elements(paths.len() as u64));
        let walls = polygon(&table);
        group.bench_function(BenchmarkId::new("first hit, straight sides", sides), |b| {
            b.iter(|| paths.iter().filter(|path| walls.hit(black_box(path)).is_some()).count());
        });
        let list = table.list(0..table.pieces().len());
        group.bench_function(BenchmarkId::new("first hit, any pieces", sides), |b| {
            b.iter(|| paths.iter().filter(|path| list.hit(black_box(path)).is_some()).count());
        });
    }
    group.finish();
}

/// From how many pieces on a tree of boxes is faster than asking each.
fn each_or_tree(criterion: &mut Criterion) {
    let paths = paths();
    let mut group = criterion.benchmark_group("each or tree");
    group.throughput(Throughput::Elements(paths.len() as u64)).sample_size(10);
    for sides in [8, 12, 16, 20, 24, 32, 48] {
        let table = flower(sides);
        let pieces = table.pieces();
        let each = |path: &Line<2>| {
            let sooner = |first: Crossing, other: Crossing| if other.before(&first) { other } else { first };
            pieces.iter().map(|piece| piece.crossing(path)).fold(Crossing::NEVER, sooner).time()
        };
        group.bench_function(BenchmarkId::new("any pieces, each", sides), |b| {
            b.iter(|| paths.iter().map(|path| each(black_box(path))).sum::<f64>());
        });
        let tree = BoxTree::new(pieces.iter().map(Piece::extent));
        let first = |path: &Line<2>| tree.first(path, |i| pieces[i].crossing(path)).map_or(0.0, |(_, time)| time);
        group.bench_function(BenchmarkId::new("any pieces, tree", sides), |b| {
            b.iter(|| paths.iter().map(|path| first(black_box(path))).sum::<f64>());
        });
    }
    for sides in [128, 192, 256, 384, 512] {
        let walls = polygon(&flower(sides));
        for (name, walls) in [("each", walls.clone().without_tree()), ("as chosen", walls)] {
            group.bench_function(BenchmarkId::new(format!("straight sides, {name}"), sides), |b| {
                b.iter(|| paths.iter().filter(|path| walls.hit(black_box(path)).is_some()).count());
            });
        }
    }
    group.finish();
}

criterion_group!(benches, first_hit, outlines, each_or_tree);
criterion_main!(benches);
