//! Obstacles so near a curved wall that a disk passes between them only just, or not at all.
use super::*;

fn with_obstacles(semi_axes: [f64; 2], obstacles: &[[[f64; 2]; 3]]) -> Table {
    let wall: Box<dyn Piece> = Box::new(Ellipse::new(v(0.0, 0.0), semi_axes, 0.0, true).unwrap());
    table(core::iter::once(wall).chain(obstacles.iter().flat_map(|triangle| polygon(triangle))).collect())
}

#[test]
fn walls_that_a_parallel_ends_short_of_do_not_bound_the_region_of_centres() {
    let obstacles = [
        [[0.3017, -0.6022], [0.2552, -0.6433], [0.1863, -0.6694]],
        [[-1.2147, 0.3098], [-1.2727, 0.3949], [-1.1733, 0.2598]],
    ];
    let drawn = with_obstacles([2.0, 0.6843], &obstacles);
    let offset = check("a triangle beside an ellipse", &drawn, 0.2);
    // the sum over 200000 columns of the height of what is left in them
    assert!((offset.table.area() - 2.520_961_92).abs() < 1e-7, "{}", offset.table.area());
    // straight down, the disk meets the long side of the triangle, its third piece, before the ellipse
    let path = Line { point: v(0.11, -0.3), velocity: v(0.0, -1.0) };
    let hits = offset.table.pieces().iter().map(|piece| piece.crossing(&path).time());
    let (first, time) = hits.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    assert_eq!(offset.origins[first], Origin::Piece(3));
    let [from, to] = [v(0.1863, -0.6694), v(0.3017, -0.6022)];
    let normal = v(from.y - to.y, to.x - from.x).normalize();
    let expected = ((path.point - from).dot(&normal) - 0.2) / normal.y;
    assert!((time - expected).abs() < 4.0 * f64::EPSILON, "{time} {expected}");
}

#[test]
fn a_disk_of_any_radius_goes_round_a_triangle_beside_an_ellipse() {
    let cases = [
        ([2.0, 0.8], [[0.764, -0.663], [0.535, -0.587], [0.448, -0.477]], &[0.001, 0.005, 0.01, 0.02, 0.03][..]),
        ([2.0, 1.778], [[-1.8993, -0.4788], [-1.832, -0.51], [-1.8933, -0.5018]], &[0.03]),
        ([2.0, 1.4784], [[0.7911, 1.312], [0.7587, 1.3559], [0.8501, 1.3185]], &[0.01]),
        ([2.0, 0.7055], [[0.9378, -0.6099], [0.8878, -0.5863], [1.0112, -0.5572]], &[0.03]),
        ([2.0, 1.2614], [[0.4905, -1.138], [0.3809, -0.9333], [0.4562, -1.051]], &[0.2]),
        ([2.0, 0.8003], [[0.7637, -0.6633], [0.535, -0.5868], [0.4484, -0.4766]], &[0.01]),
    ];
    for (semi_axes, triangle, radii) in cases {
        for &radius in radii {
            check("a triangle beside an ellipse", &with_obstacles(semi_axes, &[triangle]), radius);
        }
    }
}
