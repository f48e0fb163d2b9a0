//! Arcs that are all but straight, of which a circle is as large as the rest is small; Bézier curves become such arcs.
use super::*;
use geometry::{import, shapes::Bump};

/// The greatest radius or coordinate: points of arcs are known to its rounding.
fn greatest(drawn: &Table) -> f64 {
    let radii =
        drawn.pieces().iter().map(|piece| if let Figure::Arc { radius, .. } = piece.figure() { radius } else { 0.0 });
    radii.fold(size(drawn), f64::max)
}

/// Disks from small ones to all but the largest have an offset by the definition.
fn check_all(name: &str, drawn: &Table) {
    let largest = drawn.largest_disk().radius;
    for part in [1e-6, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999_999] {
        // sides that meet at an angle within rounding are off by several roundings
        check_of_size(name, drawn, part * largest, 4.0 * greatest(drawn));
    }
    // the largest one touches several walls at once, and rounding decides
    let touching = drawn.offset(largest);
    assert!(
        matches!(touching, Ok(_) | Err(Error::Undecided { .. } | Error::NothingLeft { .. })),
        "{name}: {touching:?}"
    );
}

/// An edge from `a` to `b` on a circle of the given radius.
fn bent(outline: Outline, [a, b]: [Vector2<f64>; 2], radius: f64, inside: bool) -> Outline {
    let chord = b - a;
    let height = (radius * radius - 0.25 * chord.norm_squared()).sqrt();
    let inwards = v(-chord.y, chord.x) / chord.norm();
    let center = (a + b) * 0.5 + inwards * if inside { height } else { -height };
    outline.arc_to(b, center, if inside { Turn::CounterClockwise } else { Turn::Clockwise }).unwrap()
}

#[test]
fn a_quadrilateral_may_have_sides_that_are_bent_however_little() {
    let mut random = spread(11);
    for k in 0..60 {
        let radius = libm::pow(10.0, 1.0 + f64::from(k) / 12.0);
        let corners = [0.0, 1.0, 2.0, 3.0].map(|quarter| {
            let angle = 0.5 * PI * (quarter + 0.5 * random());
            v(2.0, 1.0) + v(libm::cos(angle), libm::sin(angle)) * (0.5 + 0.5 * random())
        });
        // one side, or all
        let count = if k % 3 == 0 { 4 } else { 1 };
        let mut outline = Outline::from(corners[0]);
        for i in 0..4 {
            let ends = [corners[i], corners[(i + 1) % 4]];
            outline = if i < count {
                bent(outline, ends, radius * (1.0 + random()), random() < 0.5)
            } else {
                outline.line_to(ends[1]).unwrap()
            };
        }
        check_all(&format!("quadrilateral {k} with arcs of radius {radius}"), &table(outline.close().unwrap()));
    }
}

#[test]
fn flat_arcs_may_go_on_in_one_another_at_any_small_angle() {
    // a floor of two arcs that turn, where they meet, to either side by less than is known of them, and by more
    let mut random = spread(12);
    for radius in [1e2, 1e3, 1e4, 1e5] {
        for turn in [-1e-4, -1e-5, -3e-6, -1e-6, -3e-7, -1e-7, 0.0, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4] {
            for [first, second] in [[true, true], [true, false], [false, true], [false, false]] {
                let middle = v(1.0 + random(), 0.0);
                let ends = [v(0.0, 0.0), v(3.0, 0.0)];
                let signed = |inside: bool| if inside { 1.0 } else { -1.0 };
                // the chords lean so that the tangents differ by the turn
                let sweeps = [(middle - ends[0]).norm() * signed(first), (ends[1] - middle).norm() * signed(second)];
                let lean = turn - 0.5 * (sweeps[0] + sweeps[1]) / radius;
                let height = lean * sweeps[0].abs() * sweeps[1].abs() / 3.0;
                let middle = middle - v(0.0, height);
                let floor = bent(Outline::from(ends[0]), [ends[0], middle], radius, first);
                let floor = bent(floor, [middle, ends[1]], radius, second);
                let room = floor.line_to(v(3.0, 2.0)).unwrap().line_to(v(0.0, 2.0)).unwrap();
                let room = table(room.line_to(ends[0]).unwrap().close().unwrap());
                for disk in [1e-5, 1e-3, 0.1, 0.9] {
                    let name = format!("arcs of radius {radius} that turn by {turn}, {first} {second}");
                    check_of_size(&name, &room, disk, 4.0 * radius);
                }
            }
        }
    }
}

/// A closed path of three to eight Bézier curves around the middle of a drawing of 300 × 300; none where it crosses itself.
fn bezier_outline(seed: u32, tolerance: f64) -> Option<Table> {
    let mut random = spread(seed);
    let n = 3 + seed as usize % 6;
    let vertices: Vec<Vector2<f64>> = (0..n)
        .map(|k| {
            let angle = 2.0 * PI * (k as f64 + 0.6 * random()) / n as f64;
            v(150.0, 150.0) + v(libm::cos(angle), libm::sin(angle)) * (60.0 + 85.0 * random())
        })
        .collect();
    // as drawn, smooth nodes are smooth to so many digits
    let digits = [0, 1, 3, 6, 12][seed as usize / 6 % 5];
    let place = |p: Vector2<f64>| format!("{:.digits$} {:.digits$}", p.x, p.y);
    let mut path = vec![format!("M{}", place(vertices[0]))];
    let tangents: Vec<Vector2<f64>> = (0..n).map(|k| vertices[(k + 1) % n] - vertices[(k + n - 1) % n]).collect();
    for k in 0..n {
        let next = (k + 1) % n;
        let [a, b] = [vertices[k], vertices[next]];
        let (chord, across) = (b - a, v(a.y - b.y, b.x - a.x));
        let mut beside = |most: f64| across * (most * (random() - 0.5));
        let [start, end] = match seed / 30 % 4 {
            0 => [a + chord / 3.0 + beside(0.4), b - chord / 3.0 + beside(0.4)],
            // all but straight
            1 => [a + chord / 3.0 + beside(1e-3), b - chord / 3.0 + beside(1e-3)],
            2 => [a + tangents[k] * 0.2, b - tangents[next] * 0.2],
            // with control points on vertices
            _ => [
                if k % 2 == 0 { a } else { a + tangents[k] * 0.2 },
                if k % 3 == 0 { b } else { b - tangents[next] * 0.2 },
            ],
        };
        path.push(format!("C{} {} {}", place(start), place(end), place(b)));
    }
    let drawing = format!("<svg xmlns='http://www.w3.org/2000/svg'><path d='{}Z'/></svg>", path.concat());
    let drawn = table(import::svg(&drawing, tolerance).unwrap().pieces(1.0).unwrap().walls);
    drawn.validate().is_ok().then_some(drawn)
}

#[test]
fn bezier_outlines_take_every_disk_that_fits() {
    let mut count = 0;
    for seed in (0..120).step_by(5) {
        let Some(drawn) = bezier_outline(seed, 1e-3) else { continue };
        check_all(&format!("outline {seed}"), &drawn);
        count += 1;
    }
    assert!(count > 18, "{count}");
}

#[test]
fn outlines_as_fine_as_scenes_read_them_take_every_disk_that_fits() {
    // of hundreds of arcs
    for seed in (0..120).step_by(7) {
        let Some(drawn) = bezier_outline(seed, import::TOLERANCE) else { continue };
        let largest = drawn.largest_disk().radius;
        for part in [1e-4, 0.01, 0.1, 0.3, 0.9] {
            let offset = drawn.offset(part * largest).unwrap_or_else(|e| panic!("outline {seed}, part {part}: {e}"));
            assert_eq!(offset.table.validate(), Ok(()), "outline {seed}, part {part}");
        }
    }
}

#[test]
fn flat_arcs_may_stand_beside_curves_of_other_kinds() {
    let mut random = spread(17);
    for k in 0..30 {
        let radius = libm::pow(10.0, 1.0 + f64::from(k) / 8.0);
        let corners = [0.0, 1.0, 2.0, 3.0].map(|quarter| {
            let angle = 0.5 * PI * (quarter + 0.5 * random());
            v(2.0, 1.0) + v(libm::cos(angle), libm::sin(angle)) * (0.5 + 0.5 * random())
        });
        let side = |i: usize| [corners[i], corners[(i + 1) % 4]];
        let outline = bent(Outline::from(corners[0]), side(0), radius, k % 2 == 0);
        let bump = |i: usize, height: f64| Box::new(Bump::new(side(i)[0], side(i)[1], height).unwrap());
        let outline = outline.piece(bump(1, 0.1 * random())).unwrap();
        let outline = bent(outline, side(2), radius * (1.0 + random()), k % 3 == 0);
        let drawn = table(outline.piece(bump(3, -0.1 * random())).unwrap().close().unwrap());
        check_all(&format!("flat arcs of radius {radius} beside bumps"), &drawn);
    }
}
