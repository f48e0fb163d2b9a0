//! Tables of pieces that another table has.

use super::*;

/// First hits, and the kind of walls that gave them.
struct Hits<'a>(&'a [Line<2>]);

impl WithWalls<2> for Hits<'_> {
    type Output = (&'static str, Vec<Option<geometry::Hit<2>>>);
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        (core::any::type_name::<W>(), self.0.iter().map(|path| walls.hit(path)).collect())
    }
}

/// All that a piece says of itself.
fn told(piece: &dyn Piece) -> String {
    let own = (piece.ends(), piece.extent(), piece.length(), piece.area());
    format!("{own:?} {:?} {:?} {:?} {:?}", piece.shape(), piece.graphs(), piece.figure(), piece.tips())
}

#[test]
fn a_table_of_the_pieces_of_a_table_has_its_walls_to_the_last_bit() {
    let mut random = Random(21);
    let mut all = planar();
    all.push(("torus".into(), tables::sinai_torus(0.25, 1.0).unwrap()));
    let screen = geometry::parry::parry2d_f64::shape::Segment::new([-0.3, 0.1].into(), [0.2, 0.3].into());
    let mut room = vec![Box::new(Circle::new(Vector2::zeros(), 1.0, true).unwrap()) as Box<dyn Piece>];
    let pose = nalgebra::Isometry2::identity();
    room.extend(geometry::parry::pieces(&screen, &pose, geometry::parry::Side::Outside).unwrap());
    all.push(("screen".into(), Table::new(room).unwrap()));
    for (name, table) in &all {
        let pieces = table.pieces().iter().map(|piece| Box::new(piece.clone()) as Box<dyn Piece>).collect();
        let again = Table::periodic(pieces, table.lattice().cloned()).unwrap();
        for (piece, same) in table.pieces().iter().zip(again.pieces()) {
            assert_eq!(told(&**piece), told(&**same), "{name}");
        }
        assert_eq!(table.corners(), again.corners(), "{name}");
        let paths = paths(table, 100, &mut random);
        assert_eq!(table.with_walls(Hits(&paths)), again.with_walls(Hits(&paths)), "{name}");
    }
}
