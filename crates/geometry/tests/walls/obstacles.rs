//! Obstacles in containers of every kind.
use super::*;

/// A container of each kind around a disk, around two, and around a disk and a pillar, moved and magnified.
pub(super) fn containers(by: Vector2<f64>, size: f64) -> Vec<(&'static str, Table)> {
    let at = move |x: f64, y: f64| by + Vector2::new(x, y) * size;
    let askew = move |x: f64, y: f64| at(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y);
    let boxed = |sides: Vec<Segment>| sides.into_iter().map(|s| Box::new(s) as _).collect::<Vec<Box<dyn Piece>>>();
    let half = libm::sqrt(0.75);
    let hexagon = [[1.0, 0.0], [0.5, half], [-0.5, half], [-1.0, 0.0], [-0.5, -half], [0.5, -half]];
    let hexagon = || boxed(polygon(hexagon.map(|[x, y]| at(x, y))));
    let square = || boxed(polygon([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[x, y]| askew(x, y))));
    let stadium = |at: &dyn Fn(f64, f64) -> Vector2<f64>| {
        let outline = Outline::from(at(-0.5, -1.0))
            .line_to(at(0.5, -1.0))
            .and_then(|o| o.arc_to(at(0.5, 1.0), at(0.5, 0.0), Turn::CounterClockwise))
            .and_then(|o| o.line_to(at(-0.5, 1.0)))
            .and_then(|o| o.arc_to(at(-0.5, -1.0), at(-0.5, 0.0), Turn::CounterClockwise));
        outline.unwrap().close().unwrap()
    };
    let circle =
        |x: f64, r: f64, inside| Box::new(Circle::new(at(x, 0.1), r * size, inside).unwrap()) as Box<dyn Piece>;
    let disk = || vec![circle(0.1, 0.3, false)];
    let two = || vec![circle(0.4, 0.3, false), circle(-0.4, 0.3, false)];
    let pillar = || boxed(polygon([at(-0.1, -0.6), at(-0.1, -0.5), at(0.1, -0.5), at(0.1, -0.6)]));
    let around = |container: Vec<Box<dyn Piece>>, obstacles: Vec<Box<dyn Piece>>| {
        Table::new(container.into_iter().chain(obstacles).collect()).unwrap()
    };
    let both = || disk().into_iter().chain(pillar()).collect();
    vec![
        ("disk in a hexagon", around(hexagon(), disk())),
        ("disks in a hexagon", around(hexagon(), two())),
        ("disk in a square askew", around(square(), disk())),
        ("disk and pillar in a square askew", around(square(), both())),
        ("disk in a stadium", around(stadium(&at), disk())),
        ("disk and pillar in a stadium", around(stadium(&at), both())),
        ("disk in a stadium askew", around(stadium(&askew), disk())),
        ("disks in a disk", around(vec![circle(0.0, 1.2, true)], two())),
    ]
}

/// Containers without end.
pub(super) fn endless() -> [(&'static str, Table); 2] {
    let v = Vector2::new;
    let disk = |x: f64, y: f64| Box::new(Circle::new(v(x, y), 0.3, false).unwrap()) as Box<dyn Piece>;
    let ray = |x: f64, left: bool| Box::new(Ray::new(v(0.0, -1.5), v(x, 1.0), left).unwrap()) as Box<dyn Piece>;
    let line = |y: f64, x: f64| Box::new(FullLine::new(v(0.0, y), v(x, 0.0)).unwrap()) as Box<dyn Piece>;
    let table = |pieces: Vec<Box<dyn Piece>>| Table::new(pieces).unwrap();
    [
        ("disk in a wedge", table(vec![ray(-1.0, false), ray(1.0, true), disk(0.1, 0.2)])),
        ("disks in a strip", table(vec![line(-0.5, 1.0), disk(0.4, 0.1), line(1.5, -2.0), disk(-0.4, 0.3)])),
    ]
}

#[test]
fn containers_of_every_kind_hold_obstacles() {
    for (name, table) in containers(Vector2::new(0.125, -0.75), 1.0) {
        let walls = table.with_walls(NameOf);
        assert!(walls.contains("Enclosure") || walls.contains("Around"), "{name}: {walls}");
    }
}
