//! What bounds a table, and what does not.
use core::f64::consts::PI;
use geometry::{
    Description, Error, Lattice, Outline, Piece, Table, Turn, Vector2,
    shapes::{Arc, Circle, Ellipse, FullLine, Ray, Screen, Segment},
    tables,
};

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}
/// The polygon with the given vertices.
fn polygon(vertices: &[[f64; 2]]) -> Vec<Box<dyn Piece>> {
    let next = |i: usize| vertices[(i + 1) % vertices.len()];
    let side = |(i, &a): (usize, &[f64; 2])| Segment::new(a.into(), next(i).into()).unwrap();
    vertices.iter().enumerate().map(side).map(|s| Box::new(s) as Box<dyn Piece>).collect()
}
fn square(x: f64, y: f64, side: f64, counter_clockwise: bool) -> Vec<Box<dyn Piece>> {
    let mut corners = [[x, y], [x + side, y], [x + side, y + side], [x, y + side]];
    if !counter_clockwise {
        corners.reverse();
    }
    polygon(&corners)
}
fn disk(x: f64, y: f64, radius: f64, inside: bool) -> Box<dyn Piece> {
    Box::new(Circle::new(v(x, y), radius, inside).unwrap())
}
fn check(loops: impl IntoIterator<Item = Vec<Box<dyn Piece>>>) -> Result<(), Error> {
    Table::new(loops.into_iter().flatten().collect()).unwrap().validate()
}

#[test]
fn places_are_told_in_few_digits() {
    let crossing = |at| Error::Crossing { first: 0, second: 1, at }.to_string();
    assert_eq!(crossing([2.0, -4.898_587_196_589_413e-16]), "pieces 0 and 1 cross near (2, 0)");
    assert_eq!(crossing([1.0 / 3.0, -2e-7]), "pieces 0 and 1 cross near (0.333333, -2e-7)");
    assert_eq!(crossing([1e-150, -10.0]), "pieces 0 and 1 cross near (0, -10)");
}

#[test]
fn tables_of_every_kind_are_valid() {
    let big = || square(0.0, 0.0, 4.0, true);
    assert_eq!(check([big()]), Ok(()));
    // a hole, a disk, a room in the hole, a room beside
    let loops = [
        big(),
        square(1.0, 1.0, 2.0, false),
        square(1.5, 1.5, 0.5, true),
        vec![disk(0.5, 0.5, 0.25, false)],
        square(9.0, 0.0, 1.0, true),
    ];
    assert_eq!(check(loops), Ok(()));
    // disks in the open plane
    assert_eq!(check([vec![disk(0.0, 0.0, 1.0, false), disk(3.0, 0.0, 1.0, false)]]), Ok(()));
    let ellipse = Ellipse::new(v(0.3, 0.1), [2.0, 1.0], 0.4, true).unwrap();
    assert_eq!(check([vec![Box::new(ellipse) as Box<dyn Piece>, disk(0.3, 0.1, 0.5, false)]]), Ok(()));
}

#[test]
fn a_table_said_to_be_unbounded_lies_around_its_outermost_loops() {
    let check = |loops: Vec<Vec<Box<dyn Piece>>>| {
        Table::new(loops.into_iter().flatten().collect()).unwrap().unbounded().validate()
    };
    assert_eq!(check(vec![square(0.0, 0.0, 1.0, false)]), Ok(()));
    assert_eq!(check(vec![square(0.0, 0.0, 1.0, false), square(3.0, 0.5, 2.0, false)]), Ok(()));
    assert_eq!(check(vec![square(0.0, 0.0, 1.0, false), vec![disk(3.0, 0.0, 1.0, false)]]), Ok(()));
    // a wall with two sides has neither inside nor outside
    assert_eq!(check(vec![polygon(&[[0.1, 0.2], [1.3, 0.7], [2.1, 0.3], [1.3, 0.7]])]), Ok(()));
    let around = check(vec![square(0.0, 0.0, 1.0, true)]);
    assert_eq!(around, Err(Error::Orientation { piece: 0 }));
    let both = check(vec![square(0.0, 0.0, 1.0, true), square(3.0, 0.5, 2.0, false)]);
    assert!(matches!(both, Err(Error::Orientation { piece: 0..4 })), "{both:?}");
}

#[test]
fn infinite_tables_are_valid() {
    let line = |y: f64, x: f64| Box::new(FullLine::new(v(0.0, y), v(x, 0.0)).unwrap()) as Box<dyn Piece>;
    assert_eq!(check([vec![line(0.0, 1.0), line(1.0, -1.0)]]), Ok(()));
    assert_eq!(check([vec![line(0.0, 1.0)]]), Ok(()));
    assert_eq!(check([vec![line(0.0, 1.0), disk(0.0, 2.0, 1.5, false)]]), Ok(()));
    let ray = |x: f64, y: f64, left: bool| Box::new(Ray::new(v(0.0, 0.0), v(x, y), left).unwrap()) as Box<dyn Piece>;
    assert_eq!(check([vec![ray(1.0, 2.0, true), ray(-1.0, 2.0, false)]]), Ok(()));
    // however thin, as long as its walls differ
    for x in [1e-15, 1e-3] {
        assert_eq!(check([vec![ray(x, 1.0, true), ray(-x, 1.0, false)]]), Ok(()));
    }
    for x in [1e-150, 1e-16, 4e-16] {
        let thin = check([vec![ray(x, 1.0, true), ray(-x, 1.0, false)]]);
        assert!(matches!(thin, Err(Error::Faces { .. })), "{x:e}: {thin:?}");
        assert_eq!(check([vec![ray(x, 1.0, false), ray(-x, 1.0, true)]]), Ok(()));
    }
    // the outside of a wedge
    assert_eq!(check([vec![ray(1.0, 2.0, false), ray(-1.0, 2.0, true)]]), Ok(()));
}

#[test]
fn an_ellipse_may_be_flat_but_not_so_flat_that_its_sides_cannot_be_told_apart_at_any_scale() {
    for scale in [1.0, libm::ldexp(1.0, -300), libm::ldexp(1.0, 300)] {
        let with = |x: f64, axes: [f64; 2], inside: bool| {
            let ellipse = Ellipse::new(v(x, 0.25 * x) * scale, axes.map(|axis| axis * scale), 0.3, inside).unwrap();
            check([vec![Box::new(ellipse) as Box<dyn Piece>]])
        };
        for (width, is_valid) in [(1e-9, true), (2.4e-10, true), (2.2e-10, false), (1e-12, false), (1e-100, false)] {
            for axes in [[1.0, width], [width, 1.0]] {
                let found = [true, false].map(|inside| with(0.0, axes, inside));
                let thin = |error: &_| matches!(error, Err(Error::Thin { piece: 0, .. }));
                assert!(
                    found.iter().all(|f| if is_valid { *f == Ok(()) } else { thin(f) }),
                    "{scale:e} {axes:?} {found:?}"
                );
            }
        }
        // far away, where coordinates are rounded more
        assert_eq!([3e-9, 1e-9].map(|width| with(100.0, [1.0, width], false)), [Ok(()), Ok(())], "{scale:e}");
        let least = 16.0 * f64::EPSILON * 1e6 * scale;
        let Err(Error::Thin { width, least: told, .. }) = with(1e6, [1.0, 3e-9], false) else { panic!("{scale:e}") };
        assert!(width == 3e-9 * scale && (told / least - 1.0).abs() < 1e-5, "{told:e} {least:e}");
    }
}

#[test]
fn walls_with_the_table_on_the_right_are_named() {
    assert_eq!(check([square(0.0, 0.0, 1.0, false)]), Err(Error::Orientation { piece: 0 }));
    let hole = check([square(0.0, 0.0, 4.0, true), square(1.0, 1.0, 1.0, true)]);
    assert!(matches!(hole, Err(Error::Orientation { piece: 4..=7 })), "{hole:?}");
    let room = check([square(0.0, 0.0, 4.0, true), vec![disk(2.0, 2.0, 1.0, true)]]);
    assert_eq!(room, Err(Error::Orientation { piece: 4 }));
    let line = |y: f64, x: f64| Box::new(FullLine::new(v(0.0, y), v(x, 0.0)).unwrap()) as Box<dyn Piece>;
    assert!(matches!(check([vec![line(0.0, 1.0), line(1.0, 1.0)]]), Err(Error::Orientation { .. })));
    assert!(matches!(check([vec![line(0.0, 1.0), disk(0.0, -3.0, 1.0, false)]]), Err(Error::Orientation { .. })));
}

#[test]
fn a_two_sided_wall_beside_a_loop_does_not_make_it_an_obstacle() {
    let (a, b) = ([-1.0, 2.0], [4.0, 2.5]);
    let screen = || vec![Box::new(Screen::new(a.into(), b.into()).unwrap()) as Box<dyn Piece>];
    let there_and_back = || polygon(&[a, b]);
    for wall in [screen(), there_and_back()] {
        assert_eq!(check([square(0.0, 0.0, 1.0, false), wall]), Err(Error::Orientation { piece: 0 }));
    }
    for wall in [screen(), there_and_back()] {
        let table = Table::new(square(0.0, 0.0, 1.0, false).into_iter().chain(wall).collect()).unwrap();
        assert_eq!(table.unbounded().validate(), Ok(()));
    }
}

#[test]
fn a_two_sided_wall_has_the_table_on_both_sides_wherever_it_stands() {
    let mut random = Random(11);
    for k in 0..6000 {
        let [a, b] = [0; 2].map(|_| v(random.between(-4.0, 4.0), random.between(-4.0, 4.0)));
        let screen = Box::new(Screen::new(a, b).unwrap()) as Box<dyn Piece>;
        let wall = if k % 2 == 0 { polygon(&[a.into(), b.into()]) } else { vec![screen] };
        let found = check([vec![disk(0.0, 0.0, 6.0, true)], wall]);
        assert_eq!(found, Ok(()), "{k}: {a} {b}");
    }
    // some of them in the cells of a grid
    for k in 0..200 {
        let mut walls = vec![];
        for cell in 0..16 {
            let [x, y] = [cell % 4, cell / 4].map(|i| f64::from(i) - 2.0);
            let [a, b] = [0; 2].map(|_| v(x + random.between(0.0, 1.0), y + random.between(0.0, 1.0)));
            walls.push(Box::new(Screen::new(a, b).unwrap()) as Box<dyn Piece>);
        }
        assert_eq!(check([vec![disk(0.0, 0.0, 3.0, true)], walls]), Ok(()), "{k}");
    }
}

#[test]
fn a_wall_is_compared_with_all_that_lie_behind_it() {
    // a room, which any line to the disk leaves through its far side first
    let room = || square(0.0, 0.0, 1.0, true);
    assert_eq!(check([room(), vec![disk(-2.0, 0.5, 0.25, false)]]), Err(Error::Orientation { piece: 4 }));
    assert_eq!(check([room(), vec![disk(-2.0, 0.5, 0.25, true)]]), Ok(()));
    // where a wall without end leaves no one region all around
    let below = || vec![Box::new(FullLine::new(v(0.0, -10.0), v(-1.0, 0.0)).unwrap()) as Box<dyn Piece>];
    assert_eq!(check([room(), vec![disk(-2.0, 0.5, 0.25, true)], below()]), Ok(()));
    for x in [-2.0, -1.0, 2.5] {
        let found = check([room(), vec![disk(x, 0.5, 0.25, false)], below()]);
        assert!(matches!(found, Err(Error::Orientation { .. })), "{x}: {found:?}");
    }
}

#[test]
fn of_any_disjoint_or_nested_disks_those_that_alternate_are_a_table() {
    let mut random = Random(5);
    let [mut good, mut bad] = [0, 0];
    for _ in 0..1000 {
        let mut disks: Vec<[f64; 3]> = vec![];
        for _ in 0..2 + random.below(6) {
            let [x, y] = [0; 2].map(|_| random.between(-2.0, 2.0));
            let r = random.between(0.05, 1.5);
            let clear = |[u, s, q]: &[f64; 3]| {
                let d = libm::hypot(x - u, y - s);
                d > r + q + 0.01 || d < (r - q).abs() - 0.01
            };
            if disks.iter().all(clear) {
                disks.push([x, y, r]);
            }
        }
        let depth = |k: usize| {
            let [x, y, r] = disks[k];
            disks.iter().filter(|[u, s, q]| *q > r && libm::hypot(x - u, y - s) < q - r).count()
        };
        // the table is all around, or not; and one disk may disagree
        let around = random.below(2) == 1;
        let wrong = (random.below(2) == 1).then(|| random.below(disks.len()));
        let inside = |k: usize| ((depth(k) % 2 == 0) != around) != (wrong == Some(k));
        let pieces: Vec<_> = (0..disks.len()).map(|k| disk(disks[k][0], disks[k][1], disks[k][2], inside(k))).collect();
        let found = check([pieces]);
        if wrong.is_some() && disks.len() > 1 {
            bad += 1;
            assert!(matches!(found, Err(Error::Orientation { .. })), "{disks:?} {wrong:?} {around}");
        } else {
            good += 1;
            assert_eq!(found, Ok(()), "{disks:?} {around}");
        }
    }
    assert!(good > 300 && bad > 300, "{good} {bad}");
}

/// Random numbers.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "less than a small number")]
    fn below(&mut self, n: usize) -> usize {
        (self.uniform() * n as f64) as usize
    }
}

#[test]
fn crossing_walls_are_named_with_their_place() {
    let bow = check([polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])]);
    assert_eq!(bow, Err(Error::Crossing { first: 1, second: 3, at: [0.5, 0.5] }));
    let disks = check([vec![disk(0.0, 0.0, 5.0, true), disk(0.0, 0.0, 1.0, false), disk(1.0, 0.0, 1.0, false)]]);
    assert!(matches!(disks, Err(Error::Crossing { first: 1, second: 2, .. })));
    let out = check([square(0.0, 0.0, 1.0, true), vec![disk(1.0, 0.5, 0.25, false)]]);
    assert!(matches!(out, Err(Error::Crossing { first: 1, second: 4, .. })));
    let ellipse = Box::new(Ellipse::new(v(0.5, 0.5), [0.6, 0.25], 0.0, false).unwrap()) as Box<dyn Piece>;
    let out = check([square(0.0, 0.0, 1.0, true), vec![ellipse]]);
    assert!(matches!(out, Err(Error::Crossing { second: 4, .. })), "{out:?}");
    // the same wall twice
    let twice = check([vec![disk(0.0, 0.0, 1.0, true), disk(0.0, 0.0, 1.0, true)]]);
    assert!(matches!(twice, Err(Error::Crossing { first: 0, second: 1, .. })));
}

#[test]
fn a_crossing_through_a_vertex_is_a_crossing() {
    // a diamond whose vertex lies on, or beyond, the wall of a square
    let diamond = |x: f64| polygon(&[[x, 0.5], [x - 0.25, 0.25], [x - 0.5, 0.5], [x - 0.25, 0.75]]);
    let touching = [square(0.0, 0.0, 1.0, true), diamond(1.0)];
    assert_eq!(check(touching), Ok(()));
    // two loops through each other's vertices
    let a = polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]]);
    let b = polygon(&[[1.0, 3.0], [0.5, 2.5], [1.0, 2.0], [1.0, 1.0], [1.5, 1.0], [1.5, 2.5]]);
    assert!(matches!(check([a, b]), Err(Error::Crossing { .. })));
}

#[test]
fn walls_may_touch() {
    // a disk on the floor, two disks against each other, a slit, a pinch between two rooms
    let big = || square(0.0, 0.0, 4.0, true);
    assert_eq!(check([big(), vec![disk(1.0, 0.5, 0.5, false), disk(2.0, 0.5, 0.5, false)]]), Ok(()));
    let slit = polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    assert_eq!(check([slit]), Ok(()));
    let rooms = [square(0.0, 0.0, 1.0, true), square(1.0, 0.25, 0.5, true)];
    assert_eq!(check(rooms), Ok(()));
}

#[test]
fn a_spike_out_of_the_table_is_refused_and_a_slit_into_it_is_none() {
    // a stretch there and back, from the corner of a square; as long as it is, in two parts, bent, at the tip of another one
    let spikes: [&[[f64; 2]]; 5] = [
        &[[2.0, 0.0]],
        &[[3.0, 0.0], [2.0, 0.0]],
        &[[1.5, -0.5], [2.0, -0.25], [1.5, -0.5]],
        &[[2.0, 0.0], [2.0, 1.0], [2.0, 0.0]],
        &[[1.25, 0.25]],
    ];
    for spike in spikes {
        let corners =
            |out: &[[f64; 2]]| [&[[0.0, 0.0], [1.0, 0.0]], out, &[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]].concat();
        let found = check([polygon(&corners(spike))]);
        assert!(matches!(found, Err(Error::Spike { piece: 0..=4, .. })), "{spike:?}: {found:?}");
        // the same into the square
        let inward: Vec<_> = spike.iter().map(|[x, y]| [1.4 - 0.4 * x, 0.25 * x + 0.4 * y]).collect();
        let start = [1.0, 0.25];
        let corners = [&[[0.0, 0.0], [1.0, 0.0], start][..], &inward, &[start, [1.0, 1.0], [0.0, 1.0]]].concat();
        assert_eq!(check([polygon(&corners)]), Ok(()), "{inward:?}");
    }
    // into a hole, into a hole of a torus, out of a half-plane, of an arc
    let hole = || polygon(&[[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0], [2.0, 1.0], [2.0, 2.0], [2.0, 1.0]]);
    assert!(matches!(check([square(0.0, 0.0, 4.0, true), hole()]), Err(Error::Spike { piece: 8..=9, .. })));
    let lattice = Lattice::new(&[v(4.0, 0.0), v(1.0, 4.0)]).unwrap();
    let torus = Table::periodic(hole(), Some(lattice)).unwrap().validate();
    assert!(matches!(torus, Err(Error::Spike { piece: 4..=5, .. })), "{torus:?}");
    let floor = |depth: f64| {
        let ray = |x: f64, left: bool| Box::new(Ray::new(v(0.0, 0.0), v(x, 0.0), left).unwrap()) as Box<dyn Piece>;
        let side = |y: [f64; 2]| Box::new(Segment::new(v(0.0, y[0]), v(0.0, y[1])).unwrap()) as Box<dyn Piece>;
        check([vec![ray(-1.0, false), side([0.0, depth]), side([depth, 0.0]), ray(1.0, true)]])
    };
    assert!(matches!(floor(-1.0), Err(Error::Spike { .. })));
    assert_eq!(floor(1.0), Ok(()));
    let (a, b, c) = (v(1.0, 0.0), v(0.0, 1.0), v(-1.0, 0.0));
    let arc = |a, b, inside| Box::new(Arc::new(v(0.0, 0.0), a, b, inside).unwrap()) as Box<dyn Piece>;
    let line = |a, b| Box::new(Segment::new(a, b).unwrap()) as Box<dyn Piece>;
    let [low, high] = [v(-2.0, 0.0), v(-2.0, -1.0)];
    let bent = vec![
        line(c, low),
        line(low, high),
        line(high, v(0.0, -1.0)),
        line(v(0.0, -1.0), a),
        arc(a, b, true),
        arc(b, a, false),
        line(a, c),
    ];
    assert!(matches!(check([bent]), Err(Error::Spike { piece: 4..=5, .. })));
}

#[test]
fn a_loop_flatter_than_rounding_encloses_nothing() {
    let isosceles = |height: f64| tables::isosceles(1.0, height).unwrap().validate();
    assert_eq!(isosceles(1e-12), Ok(()));
    assert!(matches!(isosceles(1e-18), Err(Error::Collapsed { piece: 0, .. })));
    let flat = polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 1e-17]]);
    assert!(matches!(check([flat]), Err(Error::Collapsed { piece: 0, .. })));
    // there and back is a wall without thickness, and so is an obstacle as flat as that
    assert_eq!(check([polygon(&[[0.0, 0.0], [1.0, 0.3]])]), Ok(()));
    for sign in [-1.0, 1.0] {
        let flat = || polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, sign * 1e-17]]);
        assert_eq!(check([vec![disk(0.0, 0.0, 9.0, true)], flat()]), Ok(()));
        assert_eq!(Table::new(flat()).unwrap().unbounded().validate(), Ok(()));
    }
}

#[test]
fn a_boundary_is_open_where_a_piece_starts_as_where_one_ends() {
    let ray = |x: f64, left: bool| Box::new(Ray::new(v(0.0, 0.0), v(x, 1.0), left).unwrap()) as Box<dyn Piece>;
    let open = |pieces: Vec<Box<dyn Piece>>| Table::new(pieces).map(|_| ()).unwrap_err();
    assert_eq!(open(vec![ray(1.0, false)]), Error::Open { piece: 0, starts: false, gap: f64::INFINITY });
    assert_eq!(open(vec![ray(1.0, true)]), Error::Open { piece: 0, starts: true, gap: f64::INFINITY });
    let side = Segment::new(v(0.0, 2.0), v(0.0, 0.0)).unwrap();
    assert_eq!(open(vec![Box::new(side), ray(1.0, true)]), Error::Open { piece: 0, starts: true, gap: 2.0 });
    // two tables that touch at a vertex, one of them closed; and a chain that goes on in the next cell
    let kite = polygon(&[[0.0, 0.0], [-1.0, -1.0], [1.0, -2.0]]);
    let touching = kite.into_iter().chain([ray(-1.0, false), ray(1.0, true)]).collect();
    assert!(Table::new(touching).is_ok());
    let wave = polygon(&[[0.1, 0.0], [0.7, 0.2], [1.1, 0.0]]).into_iter().take(2).collect();
    assert!(Table::periodic(wave, Some(Lattice::new(&[v(1.0, 0.0)]).unwrap())).is_ok());
}

#[test]
fn a_piece_within_rounding_is_too_short() {
    let sides = polygon(&[[1e6, 0.0], [1e6 + 1.0, 0.0], [1e6 + 1.0, 1.0], [1e6 + 1.0 - 2e-10, 1.0], [1e6, 1.0]]);
    assert!(matches!(check([sides]), Err(Error::TooShort { piece: 2, .. })));
}

#[test]
fn the_cells_of_a_lattice_are_seen() {
    let torus = |radius: f64| {
        let lattice = Lattice::new(&[v(1.0, 0.0), v(0.5, 1.0)]).unwrap();
        Table::periodic(vec![disk(0.5, 0.5, radius, false)], Some(lattice)).unwrap().validate()
    };
    assert_eq!(torus(0.3), Ok(()));
    assert_eq!(torus(0.5), Ok(()));
    assert!(matches!(torus(0.6), Err(Error::Crossing { first: 0, second: 0, .. })));
    let channel = |upper: [Vector2<f64>; 2]| {
        let walls =
            [[v(0.0, 0.0), v(1.0, 0.0)], upper].map(|[a, b]| Box::new(Segment::new(a, b).unwrap()) as Box<dyn Piece>);
        let lattice = Lattice::new(&[v(1.0, 0.0)]).unwrap();
        Table::periodic(walls.into(), Some(lattice)).unwrap().validate()
    };
    assert_eq!(channel([v(1.0, 1.0), v(0.0, 1.0)]), Ok(()));
    assert!(matches!(channel([v(0.0, 1.0), v(1.0, 1.0)]), Err(Error::Orientation { .. })));
    let line = Box::new(FullLine::new(v(0.0, 0.0), v(1.0, 1.0)).unwrap()) as Box<dyn Piece>;
    let lattice = Lattice::new(&[v(1.0, 0.0)]).unwrap();
    let across = Table::periodic(vec![line], Some(lattice)).unwrap().validate();
    assert_eq!(across, Err(Error::InfiniteOnLattice { piece: 0 }));
}

#[test]
fn of_any_disks_on_a_torus_those_that_alternate_are_a_table() {
    let mut random = Random(7);
    let [mut good, mut bad] = [0, 0];
    for _ in 0..600 {
        let vectors = match random.below(3) {
            0 => vec![v(3.0, 0.0)],
            1 => vec![v(3.0, 0.0), v(0.0, 3.0)],
            _ => vec![v(3.0, random.between(-1.0, 1.0)), v(random.between(-4.0, 4.0), 3.0)],
        };
        let lattice = Lattice::new(&vectors).unwrap();
        let away = |x: f64, y: f64, from: [f64; 2]| {
            let translations = (-9..=9).flat_map(|i| (-9..=9).map(move |j| [i, j].map(f64::from)));
            translations.map(|c| (v(x, y) - v(from[0], from[1]) - lattice.translation(c)).norm()).fold(9.0, f64::min)
        };
        let mut disks: Vec<[f64; 3]> = vec![];
        for _ in 0..2 + random.below(6) {
            let [x, y] = [0; 2].map(|_| random.between(-4.0, 4.0));
            let r = random.between(0.05, 1.2);
            let clear = |&[u, s, q]: &[f64; 3]| {
                let d = away(x, y, [u, s]);
                d > r + q + 0.01 || d < (r - q).abs() - 0.01
            };
            if disks.iter().all(clear) {
                disks.push([x, y, r]);
            }
        }
        let depth = |k: usize| {
            let [x, y, r] = disks[k];
            disks.iter().filter(|&&[u, s, q]| q > r && away(x, y, [u, s]) < q - r).count()
        };
        let around = random.below(2) == 1;
        let wrong = (random.below(2) == 1).then(|| random.below(disks.len()));
        let inside = |k: usize| ((depth(k) % 2 == 0) != around) != (wrong == Some(k));
        let pieces: Vec<_> = (0..disks.len()).map(|k| disk(disks[k][0], disks[k][1], disks[k][2], inside(k))).collect();
        let found = Table::periodic(pieces, Some(lattice.clone())).unwrap().validate();
        if matches!(found, Err(Error::Crossing { .. })) {
            continue; // of two that are one in another, the outer one may cross its translates
        }
        if wrong.is_some() && disks.len() > 1 {
            bad += 1;
            assert!(
                matches!(found, Err(Error::Orientation { .. })),
                "{found:?}: {disks:?} {wrong:?} {around} {lattice:?}"
            );
        } else {
            good += 1;
            assert_eq!(found, Ok(()), "{disks:?} {around} {lattice:?}");
        }
    }
    assert!(good > 200 && bad > 150, "{good} {bad}");
}

#[test]
fn on_a_lattice_the_loop_with_the_table_inside_is_named() {
    let lattice = || Some(Lattice::new(&[v(4.0, 0.0), v(0.0, 4.0)]).unwrap());
    let disks = |inside: [bool; 2]| {
        Table::periodic(vec![disk(0.0, 0.0, 0.5, inside[0]), disk(2.0, 2.0, 0.5, inside[1])], lattice())
            .unwrap()
            .validate()
    };
    assert_eq!(disks([false, true]), Err(Error::Orientation { piece: 1 }));
    assert_eq!(disks([true, false]), Err(Error::Orientation { piece: 0 }));
    assert_eq!([disks([false; 2]), disks([true; 2])], [Ok(()), Ok(())]);
}

#[test]
fn lines_of_sight_along_a_lattice_end_where_translates_are_unknown() {
    // a wall with a finely drawn underside, above an infinite floor and below half a plane
    let n = 8;
    let corner = |i: i32| v(4.0 * (1.0 - f64::from(i) / f64::from(n)), 1.0 + 0.1 * f64::from(i % 2));
    let side = |a, b| Box::new(Segment::new(a, b).unwrap()) as Box<dyn Piece>;
    for x in [0.0, 1.0, -1e3] {
        let floor = Box::new(FullLine::new(v(x, 0.0), v(1.0, 0.0)).unwrap()) as Box<dyn Piece>;
        let top = side(v(0.0, 2.0), v(4.0, 2.0));
        let pieces = [floor].into_iter().chain((0..n).map(|i| side(corner(i), corner(i + 1)))).chain([top]).collect();
        let channel = Table::periodic(pieces, Some(Lattice::new(&[v(4.0, 0.0)]).unwrap())).unwrap();
        assert_eq!(channel.validate(), Ok(()));
    }
}

#[test]
fn a_wall_around_a_torus_needs_one_that_leads_back() {
    let level = |y: f64, x: [f64; 2]| {
        let [a, b, c] = [x[0], 0.5 * (x[0] + x[1]), x[1]].map(|x| v(x, y));
        [[a, b], [b, c]].map(|[a, b]| Box::new(Segment::new(a, b).unwrap()) as Box<dyn Piece>)
    };
    let check = |walls: &[(f64, bool)], vectors: &[Vector2<f64>]| {
        let pieces =
            walls.iter().flat_map(|&(y, right)| level(y, if right { [0.0, 4.0] } else { [4.0, 0.0] })).collect();
        Table::periodic(pieces, Some(Lattice::new(vectors).unwrap())).unwrap().validate()
    };
    let torus = [v(4.0, 0.0), v(1.0, 4.0)];
    assert_eq!(check(&[(0.0, true)], &torus), Err(Error::OneSided { piece: 0 }));
    assert_eq!(check(&[(0.0, true), (1.0, false), (2.0, true)], &torus), Err(Error::OneSided { piece: 4 }));
    assert!(matches!(check(&[(0.0, true), (1.0, true)], &torus), Err(Error::Orientation { .. })));
    assert_eq!(check(&[(0.0, true), (1.0, false)], &torus), Ok(()));
    assert_eq!(check(&[(0.0, true), (0.0, false)], &torus), Ok(()));
    assert_eq!(check(&[(0.0, true)], &torus[..1]), Ok(()));
}

#[test]
fn checks_do_not_depend_on_scale_or_place() {
    for k in [-300, -40, 0, 40, 300] {
        let scale = libm::ldexp(1.0, k);
        let at = |x: f64, y: f64| v(x, y) * scale;
        let stadium = |bulge: Turn| {
            let cap = |outline: Outline, to, center| outline.arc_to(to, center, bulge);
            let o = Outline::from(at(-1.0, -1.0)).line_to(at(1.0, -1.0)).unwrap();
            let o = cap(o, at(1.0, 1.0), at(1.0, 0.0)).unwrap().line_to(at(-1.0, 1.0)).unwrap();
            cap(o, at(-1.0, -1.0), at(-1.0, 0.0)).unwrap().close().unwrap()
        };
        assert_eq!(check([stadium(Turn::CounterClockwise)]), Ok(()));
        // bulging inwards the caps touch in the middle
        assert_eq!(check([stadium(Turn::Clockwise)]), Ok(()));
    }
}

#[test]
fn every_named_table_is_valid() {
    for entry in geometry::tables::all().iter().filter(|e| e.dimension() == 2) {
        let table = entry.planar(&entry.typical()).unwrap();
        assert_eq!(table.validate(), Ok(()), "{}", entry.name);
    }
}

#[test]
fn a_wavy_loop_of_many_arcs_is_checked_piece_by_piece() {
    let n = 20_000;
    let vertex = |k: u32| {
        let angle = 2.0 * PI * f64::from(k % n) / f64::from(n);
        let r = 1.0 + 0.3 * libm::sin(5.0 * angle);
        v(r * libm::cos(angle), r * libm::sin(angle))
    };
    let side = |k: u32| Box::new(Segment::new(vertex(k), vertex(k + 1)).unwrap()) as Box<dyn Piece>;
    assert_eq!(check([(0..n).map(side).collect()]), Ok(()));
    // one vertex pulled across to the other side
    let pulled = |k: u32| if k % n == 777 { v(-1.5, 0.0) } else { vertex(k) };
    let side = |k: u32| Box::new(Segment::new(pulled(k), pulled(k + 1)).unwrap()) as Box<dyn Piece>;
    assert!(matches!(check([(0..n).map(side).collect()]), Err(Error::Crossing { .. })));
}

#[test]
fn an_arc_that_leaves_its_loop_crosses_it() {
    // a pocket wider than the square it opens into
    let (a, b) = (v(0.25, 1.0), v(0.75, 1.0));
    let pocket = Box::new(Arc::new(v(0.5, 0.75), b, a, true).unwrap()) as Box<dyn Piece>;
    let sides = [[v(0.0, 1.0), v(0.0, 0.0)], [v(0.0, 0.0), v(1.0, 0.0)], [v(1.0, 0.0), v(1.0, 1.0)], [v(1.0, 1.0), b]];
    let mut pieces: Vec<Box<dyn Piece>> =
        sides.map(|[p, q]| Box::new(Segment::new(p, q).unwrap()) as Box<dyn Piece>).into();
    pieces.push(pocket);
    pieces.push(Box::new(Segment::new(a, v(0.0, 1.0)).unwrap()));
    assert_eq!(check([pieces]), Ok(()));
}

#[test]
fn an_arc_a_million_times_the_table_is_told_to_be_a_segment() {
    let lens = |rise: f64| {
        let radius = 0.5 * (1.0 / rise + rise);
        let arc = |a: f64, y: f64| Arc::with_radius(v(0.0, y), radius, v(a, 0.0), v(-a, 0.0), true).unwrap();
        let below = Segment::new(v(-1.0, 0.0), v(1.0, 0.0)).unwrap();
        check([vec![Box::new(below) as Box<dyn Piece>, Box::new(arc(1.0, rise - radius))]])
    };
    assert_eq!(lens(1e-5), Ok(()));
    assert!(matches!(lens(1e-7), Err(Error::Flat { piece: 1, .. })));
    let sagitta = |sagitta: f64| tables::channel(1.0, 1.0, sagitta).map(|table| table.area());
    for flat in [9e-7, -9e-7, 1e-20, -1e-101] {
        assert!(matches!(sagitta(flat), Err(Error::Parameter { name: "sagitta", .. })), "{flat:e}");
    }
    for rise in [1e-6, -1e-6] {
        // 4/3 of the triangles between the chords and the walls, of which each is half the rise
        assert!((sagitta(rise).unwrap() - (1.0 - 4.0 / 3.0 * rise)).abs() < 1e-9, "{rise:e}");
    }
    assert_eq!(sagitta(0.0), Ok(1.0));
}

#[test]
fn pieces_that_reach_over_millions_of_cells_are_refused_and_fill_no_memory() {
    for (short, long) in [(v(1e-9, 0.0), v(0.0, 1.0)), (v(1.0, 0.0), v(1.0, 1e-12)), (v(1e-100, 0.0), v(0.0, 1e-100))] {
        let lattice = Lattice::new(&[short, long]).unwrap();
        let table = Table::periodic(vec![disk(0.5, 0.5, 0.25, false)], Some(lattice));
        assert!(matches!(table, Err(Error::ManyCells { piece: 0, .. })), "{short} {long}");
    }
}

#[test]
fn cells_as_thin_as_a_hair_fill_no_memory() {
    let lattice = Lattice::new(&[v(1.0, 0.0), v(1.0, 1e-9)]).unwrap();
    let table = Table::periodic(vec![disk(0.0, 0.0, 1e-10, false)], Some(lattice)).unwrap();
    assert_eq!(table.validate(), Ok(()));
    let Description { components, largest_disk, .. } = table.describe();
    assert_eq!(components.len(), 1);
    assert!((components[0].area - 1e-9).abs() < 1e-15);
    // between two columns of disks
    assert!((largest_disk.radius - 0.5).abs() < 1e-3, "{largest_disk:?}");
}

#[test]
fn disks_may_touch_a_circular_wall_from_inside_and_one_another_in_its_centre() {
    assert_eq!(check([vec![disk(0.0, 0.0, 1.0, true), disk(0.75, 0.0, 0.25, false)]]), Ok(()));
    let two = [1.0, -1.0].map(|x| disk(x, 0.0, 1.0, false));
    assert_eq!(check([vec![disk(0.0, 0.0, 5.0, true)], two.into()]), Ok(()));
}

#[test]
fn ellipses_may_touch_straight_walls_and_one_another_but_not_cross() {
    let room = || polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    let oval =
        |x: f64, y: f64, axes, inside| Box::new(Ellipse::new(v(x, y), axes, 0.0, inside).unwrap()) as Box<dyn Piece>;
    for (i, j) in (1..=6).flat_map(|i| (1..=6).map(move |j| (i, j))) {
        let [a, b] = [i, j].map(|k| 0.25 * f64::from(k));
        for (x, y) in [(4.0 - a, 2.0), (a, 1.75), (2.0, b), (2.25, 4.0 - b)] {
            assert_eq!(check([room(), vec![oval(x, y, [a, b], false)]]), Ok(()), "{a} {b} at {x} {y}");
        }
        let deep = check([room(), vec![oval(4.0 - a + 1e-9, 2.0, [a, b], false)]]);
        assert!(matches!(deep, Err(Error::Crossing { second: 4, .. })), "{a} {b} {deep:?}");
        // in a larger one, less bent where they touch
        let larger = [2.0, 1.75];
        if a * larger[1] * larger[1] <= larger[0] * b * b {
            continue;
        }
        assert_eq!(
            check([vec![oval(0.0, 0.0, larger, true)], vec![oval(2.0 - a, 0.0, [a, b], false)]]),
            Ok(()),
            "{a} {b}"
        );
    }
}

#[test]
fn a_wall_without_thickness_along_another_wall_is_refused_whichever_way_it_is_drawn() {
    let room = || polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    let thin = |a: [f64; 2], b: [f64; 2]| Box::new(Screen::new(a.into(), b.into()).unwrap()) as Box<dyn Piece>;
    // on the floor, and on one another
    for (a, b) in [([1.0, 0.0], [2.0, 0.0]), ([0.0, 0.0], [4.0, 0.0])] {
        for [from, to] in [[a, b], [b, a]] {
            let along = check([room(), vec![thin(from, to)]]);
            assert!(matches!(along, Err(Error::Crossing { first: 0, second: 4, .. })), "{from:?} {to:?}: {along:?}");
            let raised = [from, to].map(|[x, y]| [x, y + 1.0]);
            let two = check([room(), vec![thin(raised[0], raised[1]), thin([1.5, 1.0], [3.0, 1.0])]]);
            assert!(matches!(two, Err(Error::Crossing { first: 4, second: 5, .. })), "{from:?} {to:?}: {two:?}");
        }
    }
    // on it, in line with it, and from one to the other
    let standing = vec![thin([1.0, 0.0], [1.0, 1.0]), thin([1.0, 1.0], [1.0, 2.0]), thin([1.0, 1.0], [0.0, 1.0])];
    assert_eq!(check([room(), standing]), Ok(()));
}

/// Small closed curves and polygons around a point: their names, and their pieces.
fn small(center: Vector2<f64>, size: f64, inside: bool) -> Vec<(&'static str, Vec<Box<dyn Piece>>)> {
    let ellipse = |axes: [f64; 2], angle: f64| {
        vec![Box::new(Ellipse::new(center, axes.map(|a| a * size), angle, inside).unwrap()) as Box<dyn Piece>]
    };
    let corner = |i: u32| {
        let (sin, cos) = libm::sincos(0.3 + 0.4 * PI * f64::from(if inside { i } else { 4 - i }));
        (center + v(cos, sin) * size).into()
    };
    vec![
        ("circle", vec![disk(center.x, center.y, size, inside)]),
        ("ellipse", ellipse([1.0, 0.6], 0.0)),
        ("turned ellipse", ellipse([0.3, 1.0], 0.7)),
        ("pentagon", polygon(&[0, 1, 2, 3, 4].map(corner))),
    ]
}

#[test]
fn an_obstacle_of_any_size_has_the_table_around_it() {
    for k in 0..71 {
        let size = libm::pow(10.0, -8.0 - 0.1 * f64::from(k));
        for center in [v(0.0, 0.0), v(-0.4, 0.02), v(0.1, 0.1), v(1e-6, -0.7), v(-0.81, 0.33)] {
            let room = || vec![disk(0.0, 0.0, 1.0, true)];
            for (what, obstacle) in small(center, size, false) {
                let checked = check([room(), obstacle]);
                let is_lost = matches!(checked, Err(Error::TooShort { .. } | Error::Thin { .. }));
                assert!(checked.is_ok() || (is_lost && size < 1e-14), "{what} of {size:e} at {center:?}: {checked:?}");
            }
            for (what, room_in_it) in small(center, size, true) {
                let checked = check([room(), room_in_it]);
                let is_lost = matches!(checked, Err(Error::TooShort { .. } | Error::Thin { .. }));
                let is_seen = matches!(checked, Err(Error::Orientation { piece: 1.. }));
                assert!(is_seen || (is_lost && size < 1e-14), "{what} of {size:e} at {center:?}: {checked:?}");
            }
        }
    }
}

#[test]
fn tiny_obstacles_inside_and_beside_each_other_are_told_apart() {
    for size in [1e-10, 2.9e-12, 1e-13] {
        let at = |x: f64| v(0.3 + x * size, -0.6);
        let room = || vec![disk(0.0, 0.0, 1.0, true)];
        for (what, beside) in [small(at(3.0), size, false).remove(0), small(at(3.0), size, false).remove(3)] {
            assert_eq!(check([room(), vec![disk(at(0.0).x, -0.6, size, false)], beside]), Ok(()), "{what} of {size:e}");
        }
        // a room in an obstacle
        for (what, obstacle) in [small(at(0.0), size, false).remove(0), small(at(0.0), size, false).remove(3)] {
            let inner = vec![disk(at(0.0).x, -0.6, 0.25 * size, true)];
            assert_eq!(check([room(), obstacle, inner]), Ok(()), "{what} of {size:e}");
        }
    }
}
