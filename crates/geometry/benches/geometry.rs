//! Nanoseconds per first hit of a piece, and the time it takes to build, check and index large outlines.

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use geometry::{
    Line, Piece, Vector2,
    parry::Index,
    shapes::{Arc, Circle, Ellipse, FullLine, Ray, Segment},
    tables,
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

fn outlines(criterion: &mut Criterion) {
    let paths = paths();
    let mut group = criterion.benchmark_group("outline");
    group.sample_size(10);
    for sides in [1000, 100_000] {
        let table = tables::polygon(sides, 1.0).expect("a number of sides");
        let extents = || table.pieces().iter().map(|piece| piece.extent());
        group.bench_with_input(BenchmarkId::new("build", sides), &sides, |b, &sides| {
            b.iter(|| tables::polygon(sides, 1.0));
        });
        group.bench_function(BenchmarkId::new("validate", sides), |b| b.iter(|| table.validate()));
        group.bench_function(BenchmarkId::new("index", sides), |b| {
            b.iter_batched(|| extents().collect::<Vec<_>>(), Index::new, BatchSize::LargeInput);
        });
        let index = Index::new(extents());
        group.bench_function(BenchmarkId::new("first hit of 256 paths through the index", sides), |b| {
            let first = |path: &Line<2>| index.first(path, |i| table.pieces()[i].crossing(path)).map_or(0, |(i, _)| i);
            b.iter(|| paths.iter().map(|path| first(black_box(path))).sum::<usize>());
        });
    }
    group.finish();
}

criterion_group!(benches, first_hit, outlines);
criterion_main!(benches);
