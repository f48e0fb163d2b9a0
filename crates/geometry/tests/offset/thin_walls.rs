//! Disks around walls without thickness.
use super::*;

#[test]
fn a_slit_has_a_round_tip() {
    let slit = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 4.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]]);
    let offset = check("slit", &table(slit), 0.25);
    let tip = offset.table.pieces().iter().find(|p| matches!(p.figure(), Figure::Arc { .. })).unwrap();
    assert!((tip.length() - 0.25 * PI).abs() < 1e-15);
}

/// Walls without thickness from each point to the next.
fn screens(points: &[[f64; 2]]) -> Vec<Box<dyn Piece>> {
    points.windows(2).map(|w| Box::new(Screen::new(w[0].into(), w[1].into()).unwrap()) as _).collect()
}

#[test]
fn walls_without_thickness_have_round_tips() {
    // in a disk, and alone in the open plane: a stadium is taken away
    for (angle, length) in [(0.0_f64, 1.0), (0.7, 2.0), (-2.1, 0.25)] {
        let [a, b] = [-0.5, 0.5].map(|k| v(0.3, -0.2) + v(libm::cos(angle), libm::sin(angle)) * (k * length));
        let wall = || screens(&[a.into(), b.into()]);
        let off =
            check("wall in a disk", &table(wall().into_iter().chain([circle(0.0, 0.0, 3.0, true)]).collect()), 0.125);
        let left = PI * 2.875 * 2.875 - (PI * 0.125 * 0.125 + 0.25 * length);
        assert!((off.table.area() - left).abs() < 1e-13);
        assert_eq!(off.table.pieces().len(), 5);
        let alone = table(wall()).offset(0.125).unwrap();
        assert!((alone.table.area() + PI * 0.125 * 0.125 + 0.25 * length).abs() < 1e-14);
        assert!(alone.origins.iter().all(|origin| origin.piece() == 0));
        assert_eq!(table(wall()).unbounded().offset(0.125).unwrap().table.validate(), Ok(()));
    }
    // chains of them with corners, one straight, a star, and some that end on walls, on one another or in corners
    let room = || polygon(&[[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]);
    let zigzag = [[-1.0, 0.0], [0.0, 0.25], [0.5, -0.5], [1.0, 0.5]];
    let straight = [[-1.0, -0.3], [0.1, 0.03], [1.0, 0.3]];
    let chains: [&[&[[f64; 2]]]; 6] = [
        &[&zigzag],
        &[&straight],
        &[&[[0.0, 0.0], [1.0, 0.2]], &[[0.0, 0.0], [-0.7, 0.9]], &[[0.0, 0.0], [-0.1, -1.0]]],
        &[&[[-2.0, 0.5], [1.0, 0.5]]],
        &[&[[0.0, -1.0], [0.0, 1.0]], &[[0.0, 0.0], [1.0, 0.0]], &[[0.0, 0.5], [-0.7, 1.0]]],
        &[&[[-2.0, -2.0], [0.0, 0.0]], &[[2.0, -2.0], [1.0, 0.0]]],
    ];
    for chain in chains {
        for radius in [1e-3, 0.125, 0.25] {
            let walls = chain.iter().flat_map(|points| screens(points));
            let drawn = table(room().into_iter().chain(walls).collect());
            drawn.validate().unwrap();
            check("walls in a room", &drawn, radius).table.validate().unwrap();
        }
    }
    // by a chain of two in a line passes no corner
    let drawn = table(room().into_iter().chain(screens(&straight)).collect());
    assert_eq!(drawn.offset(0.125).unwrap().table.pieces().len(), 4 + 6);
}

#[test]
fn a_thin_wall_has_no_kink_that_a_disk_cannot_be_followed_around() {
    // one that lies on the floor makes no table, and which of the two a disk touches is not decided
    let floor = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    let drawn = table(floor.into_iter().chain(screens(&[[2.0, 0.0], [1.0, 0.0]])).collect());
    for radius in [0.01, 0.25, 1.0] {
        assert!(matches!(drawn.offset(radius), Err(Error::Undecided { .. })), "{radius}");
    }
}
