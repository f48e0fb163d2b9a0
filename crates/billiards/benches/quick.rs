//! quick
use billiards::{Billiard, Canonical, Collisions, Conserved, Orbit, Start, Starts, collision_laws::laws::NoSlip, geometry::{Table, Walls, WithWalls, tables, walls::{Few, List}}, laws::Disk, run, run_side_by_side};
use std::time::Instant;
fn cpu() -> f64 {
    let s = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    s.split(' ').next().unwrap().parse::<f64>().unwrap()
}
fn measure(name: &str, mut f: impl FnMut() -> u64) {
    f();
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let (t0, w0) = (cpu(), Instant::now());
        let mut made = 0;
        while w0.elapsed().as_secs_f64() < 0.12 { made += f(); }
        std::thread::yield_now();
        best = best.min((cpu() - t0) / made as f64);
    }
    print!("{name:>26} {best:7.2}");
}
type O = Orbit<f64, 2, 1, Conserved<f64, 2>>;
struct On<'a>(&'a str, &'a Table);
impl WithWalls<2> for On<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) { on(self.0, self.1, walls) }
}
fn on(name: &str, table: &Table, walls: &impl Walls<2>) {
    let canonical = Canonical::new(table, 1.0, 1).unwrap();
    let starts: Vec<Start<2, 1>> = (0..512).map(|i| canonical.start(i)).collect();
    let orbit = |s: &Start<2, 1>| -> O { s.orbit(()) };
    let billiard = Billiard { walls, law: &Disk::new(&NoSlip, 0.5_f64.sqrt()) };
    measure(&format!("{name} one"), || starts.iter().map(|s| run(&billiard, &mut orbit(s), &Collisions(200), &mut ()).collisions).sum());
    measure("side", || { let mut made = 0; run_side_by_side(&billiard, &mut starts.iter().map(orbit), 200, &mut |f| made += f.outcome.collisions); made });
    println!();
}
fn main() {
    let pick: Vec<String> = std::env::args().skip(1).collect();
    let t = |m: Result<Table, billiards::geometry::Error>| m.unwrap();
    let all = [
        ("stadium", t(tables::stadium(1.0, 1.0))),
        ("mushroom", t(tables::mushroom(1.0, 1.0, 1.0))),
        ("moon", t(tables::moon(1.0, 0.75, 1.0))),
        ("flower", t(tables::flower(4, 1.25, 2.0))),
        ("pocket", t(tables::pocket([2.0, 1.0], 0.3125, 0.5625))),
        ("ellipse", t(tables::ellipse([2.0, 1.0]))),
        ("hexagon", t(tables::hexagon(1.0))),
        ("sinai", t(tables::sinai(1.0, 0.25))),
        ("circle", t(tables::circle(1.0))),
        ("polygon20", t(tables::polygon(20, 1.0))),
        ("polygon70", t(tables::polygon(70, 1.0))),
        ("channel", t(tables::channel(1.0, 1.0, 0.25))),
        ("lorentz", t(tables::lorentz(0.25, 1.0).or_else(|_| tables::sinai_torus(0.25, 1.0)))),
    ];
    for (name, table) in all {
        if !pick.is_empty() && !pick.iter().any(|p| name.starts_with(p.as_str())) { continue; }
        table.with_walls(On(&format!("{name} table"), &table));
        if table.lattice().is_some() { continue; }
        let pieces: Vec<_> = table.pieces().iter().cloned().enumerate().collect();
        let shapes: Vec<_> = pieces.iter().filter_map(|(i, p)| Some((*i, p.shape()?))).collect();
        on(&format!("{name} few"), &table, &Few::new(&shapes, table.corners()));
        if std::env::var("LIST").is_ok() { on(&format!("{name} list"), &table, &List::new(pieces, table.corners())); }
    }
}
