//! Starts within one unit in the last place of a wall or a vertex.

use billiards::Start;
use billiards::geometry::{Table, Vector2, tables};

use super::super::Effort;
use super::super::law::Law;
use super::{Entry, Tally, Trial};

pub(super) const WALLS: Entry = Entry {
    name: "starts next to a wall",
    summary: "starts on the walls of every bounded table, shifted by -1, 0 or 1 ulp in each coordinate, moving inwards",
    run: |effort| on(effort, |table| points_of_walls(table, if effort == Effort::Quick { 3 } else { 16 })),
};

pub(super) const VERTICES: Entry = Entry {
    name: "starts next to a vertex",
    summary: "starts at the corners of every bounded table, shifted by -1, 0 or 1 ulp in each coordinate, moving inwards",
    run: |effort| on(effort, |table| table.corners().to_vec()),
};

fn points_of_walls(table: &Table, many: u32) -> Vec<Vector2<f64>> {
    let share = |k: u32| (f64::from(k) + 0.37) / f64::from(many);
    let along = |k: u32| table.pieces().iter().map(move |piece| piece.point_at(piece.length() * share(k)));
    (0..many).flat_map(along).collect()
}

/// The nine points around one.
fn around(p: &Vector2<f64>) -> impl Iterator<Item = Vector2<f64>> {
    let near = |x: f64| [x.next_down(), x, x.next_up()];
    let (xs, ys) = (near(p.x), near(p.y));
    (0..9).map(move |k| Vector2::new(xs[k % 3], ys[k / 3]))
}

fn on(effort: Effort, points: impl Fn(&Table) -> Vec<Vector2<f64>>) -> Result<Tally, Box<dyn std::error::Error>> {
    let collisions = if effort == Effort::Quick { 30 } else { 1000 };
    let mut tally = Tally::default();
    for entry in tables::all().iter().filter(|entry| entry.dimension() == 2) {
        let table = entry.planar(&entry.typical())?;
        if table.lattice().is_some() || !table.perimeter().is_finite() {
            continue;
        }
        let mut starts = vec![];
        for point in points(&table) {
            let normals = normals(&table, &point);
            let middle = normals.iter().fold(Vector2::zeros(), |sum, normal| sum + normal).normalize();
            let turned = |angle: f64| {
                let (sin, cos) = libm::sincos(angle);
                Vector2::new(middle.x * cos - middle.y * sin, middle.x * sin + middle.y * cos)
            };
            let all = [-0.7, -0.2, 0.0, 0.2, 0.7].map(turned);
            let inwards = |v: &&Vector2<f64>| normals.iter().all(|normal| v.dot(normal) > 0.01);
            for velocity in all.iter().filter(inwards) {
                let start = |at: Vector2<f64>| Start { position: at.into(), velocity: (*velocity).into(), spin: [0.3] };
                starts.extend(around(&point).map(start));
            }
        }
        tally.join(Trial { table: &table, law: Law::NoSlip.planar(), collisions, open: false }.run(&starts));
    }
    Ok(tally)
}

/// The normals of the walls that meet at a point of the boundary.
fn normals(table: &Table, point: &Vector2<f64>) -> Vec<Vector2<f64>> {
    let size = point.amax().max(1.0);
    let closest = table.pieces().iter().map(|piece| piece.closest(point));
    closest.filter(|landing| (landing.point - point).amax() <= 1e-9 * size).map(|landing| landing.normal).collect()
}
