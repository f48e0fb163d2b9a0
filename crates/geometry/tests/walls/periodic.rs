//! Walls of the plane modulo a lattice.

use super::*;

/// Lattice walls against all translates of the pieces around the origin.
struct CompareLifted<'a> {
    name: &'a str,
    table: &'a Table,
    paths: &'a [Line<2>],
}

impl WithWalls<2> for CompareLifted<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) {
        let lattice = self.table.lattice().unwrap();
        let mut pieces: Vec<(usize, std::sync::Arc<dyn Piece>)> = vec![];
        let second = if lattice.vectors().len() == 2 { -9..=9 } else { 0..=0 };
        for (i, piece) in self.table.pieces().iter().enumerate() {
            for (a, b) in (-9..=9).flat_map(|a| second.clone().map(move |b| (a, b))) {
                let by = lattice.translation([f64::from(a), f64::from(b)]);
                pieces.push((i, std::sync::Arc::new(Translated::new(piece.clone(), by))));
            }
        }
        let lifted = List::new(pieces, &[]);
        let mut compared = 0;
        for path in self.paths {
            let speed = path.velocity.norm();
            let Some(a) = lifted.hit(path).filter(|a| a.time * speed < 5.0) else { continue };
            let b = walls.hit(path).unwrap();
            let cos = path.velocity.dot(&a.normal).abs() / speed;
            // as for composite walls, and at each of at most 12 crossings of a cell's edge 2 ulp more
            let bound = (16.0 + 24.0) * f64::EPSILON * 5.0 / cos;
            let context = || format!("{}: {path:?} {a:?} {b:?}", self.name);
            assert_eq!(a.piece, b.piece, "{}", context());
            assert!((a.time - b.time).abs() * speed <= bound, "{}", context());
            let apart = a.point - b.point;
            assert!((apart - lattice.translation(lattice.nearest(&apart))).norm() <= bound, "{}", context());
            compared += 1;
        }
        assert!(compared * 2 > self.paths.len());
    }
}

#[test]
fn lattice_walls_agree_with_all_translates() {
    let mut random = Random(8);
    for name in ["sinai-torus", "lorentz", "channel"] {
        let entry = tables::find(name).unwrap();
        let table = entry.planar(&entry.typical()).unwrap();
        let paths = orbit_starts(&table, 1000, &mut random);
        table.with_walls(CompareLifted { name, table: &table, paths: &paths });
    }
}

#[test]
fn a_hit_at_a_joint_of_the_lattice_is_a_corner() {
    // the cusps of a channel with dispersing walls, where one cell meets the next
    let table = tables::channel(1.0, 1.0, 0.25).unwrap();
    assert_eq!(table.corners().len(), 4);
    let hit =
        table.with_walls(Ask(Line { point: Vector2::new(0.75, 0.5), velocity: Vector2::new(0.25, -0.5) })).unwrap();
    assert!(hit.corner, "{hit:?}");
    // and where an arc meets an arc of its own circle there is none
    let circle = Outline::from(Vector2::new(1.0, 0.0))
        .arc_to(Vector2::new(-1.0, 0.0), Vector2::zeros(), Turn::CounterClockwise)
        .and_then(|o| o.arc_to(Vector2::new(1.0, 0.0), Vector2::zeros(), Turn::CounterClockwise));
    assert!(Table::new(circle.unwrap().close().unwrap()).unwrap().corners().is_empty());
    assert!(Arc::new(Vector2::zeros(), Vector2::new(1.0, 0.0), Vector2::new(1.0, 0.0), true).is_err());
}
