//! A few shapes, asked together or one by one.

use super::{leaks::AllHit, side_by_side::SameBits, *};

/// The same pieces as shapes that are asked in lanes, and asked one by one.
fn few_and_list(pieces: &[(usize, std::sync::Arc<dyn Piece>)], corners: &[Vector2<f64>]) -> (Few, List) {
    let shapes: Vec<_> = pieces.iter().map(|(number, piece)| (*number, piece.shape().unwrap())).collect();
    (Few::new(&shapes, corners), List::new(pieces.to_vec(), corners))
}

/// What a hit is, to the last bit: the signs of zeros are different bits.
fn bits(hit: Option<geometry::Hit<2>>) -> Option<(usize, bool, [u64; 5])> {
    let geometry::Hit { time, point, normal, piece, corner } = hit?;
    Some((piece, corner, [time, point.x, point.y, normal.x, normal.y].map(f64::to_bits)))
}

fn assert_same_hits(name: &str, few: &Few, list: &List, paths: &[Line<2>]) {
    for path in paths {
        let (together, alone) = (few.hit(path), list.hit(path));
        assert_eq!(bits(together), bits(alone), "{name}: {path:?} {together:?} {alone:?}");
    }
    SameBits { name, paths }.run(few);
}

#[test]
fn a_few_shapes_are_hit_as_their_list_to_the_last_bit() {
    let mut random = Random(9);
    for (name, table) in &planar() {
        let pieces: Vec<_> = table.pieces().iter().cloned().enumerate().collect();
        if pieces.iter().any(|(_, piece)| piece.shape().is_none()) {
            continue;
        }
        let (few, list) = few_and_list(&pieces, table.corners());
        let mut paths = paths(table, 500, &mut random);
        paths.extend(aimed(table, &mut random));
        assert_same_hits(name, &few, &list, &paths);
    }
}

/// Some shapes of each kind, a chain of segments and arcs among them; and the vertices of that.
fn jumble(random: &mut Random, scale: f64) -> (Vec<Box<dyn Piece>>, Vec<Vector2<f64>>) {
    let mut vertex = || Vector2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * scale;
    let vertices: Vec<Vector2<f64>> = (0..6).map(|_| vertex()).collect();
    let [a, b, c] = [vertex(), vertex(), vertex()];
    let mut pieces: Vec<Box<dyn Piece>> = vec![];
    for k in 0..vertices.len() {
        let (from, to) = (vertices[k], vertices[(k + 1) % vertices.len()]);
        let (chord, inside) = (to - from, random.uniform() < 0.5);
        let across = Vector2::new(-chord.y, chord.x) * random.between(-1.5, 1.5);
        pieces.push(if random.uniform() < 0.4 {
            Box::new(Segment::new(from, to).unwrap())
        } else {
            Box::new(Arc::new((from + to) * 0.5 + across, from, to, inside).unwrap())
        });
    }
    for inside in [true, false] {
        let [r, s] = [random.between(0.1, 0.7), random.between(0.1, 0.7)];
        let ellipse = Ellipse::new(b, [r * scale, s * scale], random.between(0.0, 6.3), inside).unwrap();
        let [from, to] = [random.uniform(), random.uniform()].map(|u| ellipse.point_at(u * ellipse.length()));
        pieces.push(Box::new(Circle::new(a, r * scale, inside).unwrap()));
        pieces.push(Box::new(ellipse));
        pieces.push(Box::new(EllipticArc::new(ellipse, from, to).unwrap()));
        pieces.push(Box::new(Ray::new(c, a - c, inside).unwrap()));
    }
    pieces.push(Box::new(FullLine::new(c * 2.0, b).unwrap()));
    pieces.push(Box::new(Screen::new(c, vertices[0]).unwrap()));
    pieces.push(Box::new(Screen::new(vertices[0], a).unwrap()));
    (pieces, vertices)
}

#[test]
fn random_lists_of_shapes_are_hit_as_asked_one_by_one_to_the_last_bit() {
    let mut random = Random(10);
    let (mut hits, mut corners) = (0, 0);
    for k in 0..60 {
        let scale = libm::exp2(random.between(-40.0, 40.0));
        let (all, vertices) = jumble(&mut random, scale);
        // not all kinds at once, or the nearest hide the others
        let keep = [1.0, 0.5, 0.2][k % 3];
        let pieces: Vec<_> = all.into_iter().filter(|_| random.uniform() < keep).map(std::sync::Arc::from).collect();
        let pieces: Vec<_> = pieces.into_iter().enumerate().collect();
        let (few, list) = few_and_list(&pieces, &vertices);
        let mut paths: Vec<Line<2>> = vec![];
        for _ in 0..200 {
            let point = Vector2::new(random.between(-1.5, 1.5), random.between(-1.5, 1.5)) * scale;
            let velocity = random.velocity() * scale;
            paths.push(Line { point, velocity });
            paths.push(Line { point, velocity: vertices[k % vertices.len()] - point });
            // from where it ends, and from far away
            if let Some(hit) = list.hit(&Line { point, velocity }) {
                paths.push(Line { point: hit.point, velocity });
                paths.push(Line { point: hit.point, velocity: random.velocity() });
            }
            paths.push(Line { point: point - velocity * 1e3, velocity });
        }
        let found: Vec<_> = paths.iter().filter_map(|path| list.hit(path)).collect();
        (hits, corners) = (hits + found.len(), corners + found.iter().filter(|hit| hit.corner).count());
        assert_same_hits(&format!("jumble {k}"), &few, &list, &paths);
    }
    assert!(hits > 20_000 && corners > 300, "{hits} {corners}");
}

#[test]
fn shapes_beside_other_pieces_are_hit_in_the_right_order() {
    // a square with one side that is no shape: it has a bump
    let v = Vector2::new;
    let corners = [v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)];
    let side = |i: usize| -> Box<dyn Piece> {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        if i == 1 { Box::new(Bump::new(a, b, -0.25).unwrap()) } else { Box::new(Segment::new(a, b).unwrap()) }
    };
    let table = Table::new((0..4).map(side).collect()).unwrap();
    let mut random = Random(11);
    let (mut paths, aimed) = (paths(&table, 2000, &mut random), aimed(&table, &mut random));
    table.with_walls(AllHit { name: "bump", table: &table, paths: &aimed });
    paths.extend(aimed);
    table.with_walls(Compare { name: "bump", table: &table, paths: &paths });
    table.with_walls(SameBits { name: "bump", paths: &paths });
    let list = table.list(0..4);
    assert!(paths.iter().filter(|path| list.hit(path).is_some_and(|hit| hit.piece == 1)).count() > 500);
}
