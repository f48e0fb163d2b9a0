//! Closed curves of which all is left.
use super::*;

#[test]
fn the_parallel_of_a_whole_curve_is_one_closed_piece() {
    // however small the disk is, and wherever rounding puts the places where its parts meet
    let mut random = spread(11);
    for _ in 0..400 {
        let [x, y, angle] = [random(), random(), 3.0 * random()];
        let [a, b] = [0.05 + 0.2 * random(), 0.05 + 0.2 * random()];
        let radius = 1e-3 * random();
        for inside in [true, false] {
            let ellipse = Ellipse::new(v(x, y), [a, b], angle, inside).unwrap();
            let drawn = table(vec![Box::new(ellipse)]);
            let offset = drawn.offset(radius).unwrap().table;
            let closed = offset.pieces().len() == 1 && offset.pieces()[0].ends().is_none();
            assert!(closed, "{ellipse:?} {radius}: {:?}", offset.pieces());
        }
    }
}
