//! Walls with the table on both sides, where they end: nothing slips through between them and what they meet.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use geometry::{
    Outline, Piece, Table, Vector2, WallHit, Walls, WithWalls,
    shapes::{Circle, Screen},
};
use lanes::{Kernel, Lane};

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

/// The circle around all.
const OUT: usize = 0;

/// The circle around all, piece [`OUT`].
fn circle() -> Vec<Box<dyn Piece>> {
    vec![Box::new(Circle::new(v(0.5, 0.5), 5.0, true).unwrap())]
}

/// Up to so many specular collisions from a place in a direction, or up to one with the circle around all; the last hit.
struct Run([f64; 2], [f64; 2], usize);

impl WithWalls<2> for Run {
    type Output = (Vec<usize>, WallHit<f64, 2>);
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        let Run(mut at, mut velocity, most) = self;
        let mut pieces = vec![];
        loop {
            let hit = walls.first_hit(&at, &velocity);
            pieces.push(hit.number());
            if hit.corner || hit.number() == OUT || pieces.len() == most {
                return (pieces, hit);
            }
            let n = Vector2::from(hit.unit_normal());
            let reflected = Vector2::from(velocity) - n * (2.0 * n.dot(&Vector2::from(velocity)));
            (at, velocity) = (hit.point, reflected.into());
        }
    }
}

fn turned(p: Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (sin, cos) = libm::sincos(angle);
    v(cos * p.x - sin * p.y, sin * p.x + cos * p.y)
}

/// In a circle, piece 0, a square cage: of four walls without thickness, or of walls there and back.
fn cage(angle: f64, there_and_back: bool) -> Table {
    let at = [v(-1.0, -1.0), v(1.0, -1.0), v(1.0, 1.0), v(-1.0, 1.0)].map(|p| turned(p, angle) + v(0.3, -0.2));
    let mut pieces = circle();
    for (k, a) in at.iter().enumerate() {
        // not all in the same sense
        let b = at[(k + 1) % 4];
        let [a, b] = if k == 1 { [b, *a] } else { [*a, b] };
        if there_and_back {
            pieces.extend(Outline::from(a).line_to(b).unwrap().line_to(a).unwrap().close().unwrap());
        } else {
            pieces.push(Box::new(Screen::new(a, b).unwrap()));
        }
    }
    Table::new(pieces).unwrap()
}

#[test]
fn no_orbit_leaves_a_cage_of_walls_without_thickness_through_its_vertices() {
    for there_and_back in [false, true] {
        let mut ended = [0; 2];
        for k in 0..60 {
            let angle = 0.1 + 0.1 * f64::from(k);
            let table = cage(angle, there_and_back);
            for (aim, aside) in [0.0, 1e-15, -1e-15, 1e-14, -1e-14, 1e-13, 1e-12].into_iter().enumerate() {
                let from = turned(v(0.2, 0.1), angle) + v(0.3, -0.2);
                let vertex = turned(v(1.0, 1.0), angle) + v(0.3, -0.2);
                let d = vertex - from;
                let (pieces, hit) = table.with_walls(Run(from.into(), [d.x - aside * d.y, d.y + aside * d.x], 8));
                assert!(pieces.iter().all(|&piece| piece != OUT), "{angle} aside {aside}: {pieces:?}");
                ended[usize::from(aim > 5)] += u32::from(hit.corner);
            }
        }
        // at the vertex itself all end, and a thousand roundings beside it none
        assert!(ended[0] >= 60 && ended[1] == 0, "{ended:?}");
    }
}

#[test]
fn no_orbit_gets_out_of_a_needle_of_two_walls() {
    for angle in [1e-2, 1e-3, 1e-4] {
        let tip = v(0.3, 0.7);
        let ends = [0.0, angle].map(|along| tip + turned(v(2.0, 0.0), along));
        let mut pieces = circle();
        pieces.extend(ends.map(|end| Box::new(Screen::new(end, tip).unwrap()) as Box<dyn Piece>));
        let table = Table::new(pieces).unwrap();
        for aside in [0.0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11] {
            let from = tip + turned(v(1.0, 0.0), 0.5 * angle);
            let d = turned(tip - from, aside);
            let (pieces, hit) = table.with_walls(Run(from.into(), d.into(), 100_000));
            // it turns around after some π/angle hits, or ends at the tip
            let inside = pieces.len();
            assert!(hit.corner || inside as f64 * angle > 1.5, "{angle} aside {aside}: {inside}");
            if !hit.corner {
                let leaves = Vector2::from(hit.point) - tip;
                let along = libm::atan2(leaves.y, leaves.x);
                assert!((-1e-9..=angle + 1e-9).contains(&along), "{angle} aside {aside}: {along}");
            }
        }
    }
}

#[test]
fn the_foot_of_a_wall_is_a_corner_from_either_side() {
    let room = || {
        let o = Outline::from(v(4.0, 0.0)).line_to(v(4.0, 3.0)).unwrap().line_to(v(0.0, 3.0)).unwrap();
        o.line_to(v(0.0, 0.0)).unwrap().line_to(v(4.0, 0.0)).unwrap().close().unwrap()
    };
    let tops = [v(2.0, 2.0), v(2.5, 2.0)];
    for top in tops {
        let loops = Outline::from(v(2.0, 0.0)).line_to(top).unwrap().line_to(v(2.0, 0.0)).unwrap().close().unwrap();
        let screen: Vec<Box<dyn Piece>> = vec![Box::new(Screen::new(v(2.0, 0.0), top).unwrap())];
        for wall in [loops, screen] {
            let table = Table::new(room().into_iter().chain(wall).collect()).unwrap();
            for k in 0..40 {
                let x = 0.1 * f64::from(k) + 0.05;
                if (x - 2.0).abs() < 0.6 {
                    continue;
                }
                for aside in [0.0, 1e-15, -1e-15] {
                    let (from, to) = (v(x, 0.25 + 0.01 * x), v(2.0, 0.0));
                    let d = to - from;
                    let run = Run(from.into(), [d.x - aside * d.y, d.y + aside * d.x], 3);
                    let (pieces, hit) = table.with_walls(run);
                    assert!(hit.corner && pieces.len() <= 2, "{top:?} from {x} aside {aside}: {pieces:?}");
                }
                // a little farther off it turns back
                let (from, to) = (v(x, 0.25), v(2.0 + 1e-12 * (x - 2.0), 0.0));
                let (pieces, hit) = table.with_walls(Run(from.into(), (to - from).into(), 3));
                assert!(!hit.corner && (hit.point[0] < 2.0) == (x < 2.0), "{from:?}: {pieces:?}");
            }
        }
    }
}

#[test]
fn the_tip_of_a_wall_is_a_corner_from_every_side_and_a_flat_vertex_between_two_is_none() {
    let (a, b, c) = (v(-2.0, 0.5), v(0.0, 0.5), v(1.0, 0.5));
    let screen = |a, b| Box::new(Screen::new(a, b).unwrap()) as Box<dyn Piece>;
    let within = |walls: Vec<Box<dyn Piece>>| Table::new(circle().into_iter().chain(walls).collect()).unwrap();
    let table = within(vec![screen(a, b)]);
    let chain = within(vec![screen(a, b), screen(b, c)]);
    let mut met = 0;
    for k in 0..64 {
        let angle = 0.05 + 0.1 * f64::from(k);
        let from = b + turned(v(1.5, 0.0), angle);
        let (pieces, hit) = table.with_walls(Run(from.into(), (b - from).into(), 1));
        // what rounding sends past it by an ulp may go on
        if pieces == [1] {
            assert!(hit.corner, "{angle}");
            met += 1;
        }
        // between two that go on as one there is no corner, and no way through
        let (pieces, hit) = chain.with_walls(Run(from.into(), (b - from).into(), 2));
        assert!(!hit.corner && pieces[0] != OUT && pieces[1] == OUT, "{angle}: {pieces:?}");
        let side = |p: Vector2<f64>| p.y > 0.5;
        assert_eq!(side(Vector2::from(hit.point)), side(from), "{angle}");
    }
    assert!(met > 20);
    for from in [v(0.0, 2.5), v(0.0, -1.5)] {
        let (pieces, hit) = table.with_walls(Run(from.into(), (b - from).into(), 1));
        assert!(hit.corner && pieces == [1], "{from:?}");
    }
}

#[test]
fn a_path_along_a_wall_without_thickness_ends_at_its_edge() {
    let there_and_back = |a, b| Outline::from(a).line_to(b).unwrap().line_to(a).unwrap().close().unwrap();
    let screen = |a, b| vec![Box::new(Screen::new(a, b).unwrap()) as Box<dyn Piece>];
    let (a, b) = (v(0.25, 0.5), v(0.75, 0.5));
    let beside = (0..30).flat_map(|k| screen(v(0.01 * f64::from(k), 2.0), v(0.01 * f64::from(k), 2.5)));
    for pieces in [
        circle().into_iter().chain(screen(a, b)).collect(),
        circle().into_iter().chain(there_and_back(a, b)).collect(),
        circle().into_iter().chain(screen(a, b)).chain(beside).collect::<Vec<_>>(),
    ] {
        let table = Table::new(pieces).unwrap();
        for (from, velocity, far) in [([-1.0, 0.5], [0.5, 0.0], 2.5), ([2.0, 0.5], [-2.0, 0.0], 0.625)] {
            let hit = table.with_walls(Run(from, velocity, 1)).1;
            assert!(hit.corner && hit.time == far, "{hit:?}");
            let hits = table.with_walls(SideBySide(from, velocity));
            assert!(hits.iter().all(|hit| hit.corner && hit.time == far && hit.piece > 0.0), "{hits:?}");
            // what leaves its other edge goes on
            let hit = table.with_walls(Run(from, velocity.map(|v| -v), 1)).1;
            assert!(!hit.corner && hit.number() == OUT, "{hit:?}");
        }
    }
}

/// The first hit of a path, in as many lanes as there are.
struct SideBySide([f64; 2], [f64; 2]);

impl WithWalls<2> for SideBySide {
    type Output = Vec<WallHit<f64, 2>>;
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        struct First<'a, W>(&'a W, SideBySide);
        impl<W: Walls<2>> Kernel for First<'_, W> {
            type Output = Vec<WallHit<f64, 2>>;
            fn run<F: Lane>(self, zero: F) -> Self::Output {
                let First(walls, SideBySide(x, v)) = self;
                let hit = walls.first_hit(&x.map(|x| zero.same(x)), &v.map(|v| zero.same(v)));
                (0..F::LANES).map(|lane| hit.one(lane)).collect()
            }
        }
        lanes::dispatch(First(walls, self))
    }
}
