//! Straight walls of the moved boundary have the directions of the drawn ones, however short they become.
use super::*;
use geometry::Line;

/// The normal at the hit of a path.
struct NormalOf(Line<2>);
impl WithWalls<2> for NormalOf {
    type Output = Vector2<f64>;
    fn run<W: Walls<2>>(self, walls: &W) -> Vector2<f64> {
        walls.hit(&self.0).unwrap().normal
    }
}

/// Whether every straight piece has the normal of the piece that it comes from, asked itself and by the fastest walls.
fn keeps_normals(drawn: &Table, radius: f64) -> f64 {
    let offset = drawn.offset(radius).unwrap();
    let mut shortest = f64::INFINITY;
    for (piece, origin) in offset.table.pieces().iter().zip(&offset.origins) {
        let (Figure::Segment { .. }, Origin::Piece(from)) = (piece.figure(), origin) else { continue };
        let middle = piece.point_at(0.5 * piece.length());
        let normal = piece.closest(&middle).normal;
        let from = &drawn.pieces()[*from];
        let [a, b] = from.ends().or_else(|| from.tips()).unwrap();
        let truth = v(a.y - b.y, b.x - a.x).normalize();
        // of a wall without thickness one of two
        let truth = truth * 1.0_f64.copysign(truth.dot(&normal));
        assert!((normal - truth).amax() <= 2.0 * f64::EPSILON, "{normal:?} {truth:?}");
        let path = Line { point: middle + normal * (0.25 * radius), velocity: -normal };
        let hit = offset.table.with_walls(NormalOf(path));
        assert!((hit - truth).amax() <= 2.0 * f64::EPSILON, "{hit:?} {truth:?}");
        shortest = piece.length().min(shortest);
    }
    shortest
}

#[test]
fn a_short_side_that_is_left_has_the_direction_of_the_whole() {
    let sides = [[0.0, 0.0], [3.0, 0.25], [3.25, 0.75], [2.5, 3.0], [0.0, 3.0]];
    let convex = table(polygon(&sides));
    assert!(keeps_normals(&convex, 0.572_642_398_131_691_6) < 1e-6);
    // with an obstacle, and in a row of more sides than composite walls take
    let drawn = [polygon(&sides), vec![circle(1.4, 1.5, 0.1, false)]].into_iter().flatten().collect();
    assert!(keeps_normals(&table(drawn), 0.572_642_398_131_691_6) < 1e-6);
    let toothed: Vec<[f64; 2]> =
        (0..40).map(|k| 0.157 * f64::from(k)).map(|angle| [3.0 * libm::cos(angle), 2.0 * libm::sin(angle)]).collect();
    assert!(keeps_normals(&table(polygon(&toothed)), 1.0) < 0.2);
}

#[test]
fn the_sides_of_a_hexagon_that_is_nearly_filled_are_as_steep_as_before() {
    assert!(keeps_normals(&tables::hexagon(1.0).unwrap(), 0.866_024_537_759_034_8) < 2e-6);
}

#[test]
fn the_faces_of_a_short_wall_without_thickness_are_parallel_to_it() {
    let wall = Screen::new(v(7.9996, 10.1), v(8.0004, 10.1003)).unwrap();
    let drawn = table(vec![circle(8.0, 10.0, 3.0, true), Box::new(wall)]);
    assert!(keeps_normals(&drawn, 0.125) < 0.002);
}
