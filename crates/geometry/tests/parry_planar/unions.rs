//! Unions of shapes: outlines without what lies inside.
use super::*;

fn compound(members: &[(f64, f64, SharedShape)]) -> Compound {
    Compound::new(members.iter().map(|(x, y, s)| (Pose::translation(*x, *y), s.clone())).collect())
}

#[test]
fn balls_of_a_compound_that_touch_are_all_walls() {
    // at the point opposite the start of a circle, too, and three in a row
    for others in [&[2.0][..], &[-2.0], &[2.0, -2.0]] {
        let ball = |x: &f64| (*x, 0.0, SharedShape::ball(1.0));
        let members: Vec<_> = [0.0].iter().chain(others).map(ball).collect();
        let outline = pieces(&compound(&members), &Isometry2::identity(), Side::Outside).unwrap();
        let table = Table::new(outline).unwrap();
        assert!((table.area() + PI * members.len() as f64).abs() < 1e-14, "{others:?}");
    }
    // one inside another that it touches is part of it
    let within = compound(&[(0.0, 0.0, SharedShape::ball(1.0)), (-0.5, 0.0, SharedShape::ball(0.5))]);
    let outline = pieces(&within, &Isometry2::identity(), Side::Outside).unwrap();
    assert!((Table::new(outline).unwrap().area() + PI).abs() < 1e-14);
}

#[test]
fn overlapping_members_of_a_compound_become_the_outline_of_their_union() {
    let cross = compound(&[(0.0, 0.0, SharedShape::cuboid(2.0, 0.5)), (0.0, 0.0, SharedShape::cuboid(0.5, 2.0))]);
    let cross = table(&cross, Side::Inside);
    assert!((cross.area() - 7.0).abs() < 1e-14);
    assert!((cross.perimeter() - 16.0).abs() < 1e-14);
    assert_eq!(cross.pieces().len(), 12);

    // two unit disks at distance 1: area 4π/3 + √3/2, arcs of 4π/3 each
    let lens = compound(&[(-0.5, 0.0, SharedShape::ball(1.0)), (0.5, 0.0, SharedShape::ball(1.0))]);
    let lens = table(&lens, Side::Inside);
    assert!((lens.area() - (4.0 * PI / 3.0 + libm::sqrt(3.0) / 2.0)).abs() < 1e-14);
    assert!((lens.perimeter() - 8.0 * PI / 3.0).abs() < 1e-14);

    // a mushroom: a disk on a stem
    let mushroom = compound(&[(0.0, 0.0, SharedShape::ball(1.0)), (0.0, -1.0, SharedShape::cuboid(0.25, 1.0))]);
    let mushroom = table(&mushroom, Side::Inside);
    // stem below the circle: width 1/2, from −2 to −√(1 − 1/16), less the circular segment
    let (half, angle) = (0.25, libm::asin(0.25));
    let below = 2.0 * half * (2.0 - libm::cos(angle)) - (angle - libm::sin(2.0 * angle) / 2.0);
    assert!((mushroom.area() - (PI + below)).abs() < 1e-14, "{}", mushroom.area() - (PI + below));
}

#[test]
fn members_that_touch_back_to_back_are_open_to_each_other() {
    let row = compound(&[(0.0, 0.0, SharedShape::cuboid(0.5, 0.5)), (1.0, 0.0, SharedShape::cuboid(0.5, 0.5))]);
    let row = table(&row, Side::Inside);
    assert_eq!((row.area(), row.perimeter()), (2.0, 6.0));
    // a smaller one against the middle of a side
    let step = compound(&[(0.0, 0.0, SharedShape::cuboid(0.5, 0.5)), (0.75, 0.0, SharedShape::cuboid(0.25, 0.25))]);
    let step = table(&step, Side::Inside);
    assert_eq!((step.area(), step.perimeter()), (1.25, 5.0));
    // one inside the other, and the same one twice
    let inside = compound(&[
        (0.0, 0.0, SharedShape::cuboid(2.0, 2.0)),
        (0.0, 0.0, SharedShape::ball(1.0)),
        (0.0, 0.0, SharedShape::cuboid(2.0, 2.0)),
    ]);
    let inside = table(&inside, Side::Inside);
    assert_eq!((inside.area(), inside.pieces().len()), (16.0, 4));
    // apart
    let apart = compound(&[(0.0, 0.0, SharedShape::ball(1.0)), (5.0, 0.0, SharedShape::ball(2.0))]);
    assert_eq!(table(&apart, Side::Outside).pieces().len(), 2);
}

#[test]
fn a_half_space_with_a_bump_has_two_rays() {
    let bumpy =
        compound(&[(0.0, 0.0, SharedShape::new(HalfSpace::new(Vector::Y))), (0.0, 0.0, SharedShape::ball(1.0))]);
    let walls = pieces(&bumpy, &here(), Side::Outside).unwrap();
    assert_eq!(walls.len(), 3);
    for x in [-3.0, -0.5, 0.7, 4.0] {
        let path = Line { point: Vector2::new(x, 5.0), velocity: Vector2::new(0.0, -1.0) };
        let height = if f64::abs(x) < 1.0 { libm::sqrt(1.0 - x * x) } else { 0.0 };
        let (_, time) = first(&walls, &path).unwrap();
        assert!((time - (5.0 - height)).abs() < 1e-14, "at {x}");
        let up = Line { point: Vector2::new(x, -5.0), velocity: Vector2::new(0.0, 1.0) };
        assert!(first(&walls, &up).is_none());
    }
}

#[test]
fn random_unions_agree_with_their_members_everywhere() {
    // the union contains a point exactly where a member does; checked away from the outline
    let mut random = Random(3);
    for round in 0..60 {
        let count = 2 + round % 4;
        let members: Vec<(f64, f64, SharedShape)> = (0..count)
            .map(|_| {
                let shape = match random.below(4) {
                    0 => SharedShape::ball(random.between(0.2, 1.0)),
                    1 => SharedShape::cuboid(random.between(0.2, 1.0), random.between(0.2, 1.0)),
                    2 => SharedShape::capsule(
                        Vector::new(random.between(-1.0, 1.0), 0.0),
                        Vector::new(0.0, random.between(-1.0, 1.0)),
                        random.between(0.2, 0.5),
                    ),
                    _ => SharedShape::round_cuboid(random.between(0.2, 0.8), random.between(0.2, 0.8), 0.2),
                };
                (random.between(-1.0, 1.0), random.between(-1.0, 1.0), shape)
            })
            .collect();
        let union = table(&compound(&members), Side::Inside);
        for _ in 0..300 {
            let p = Vector2::new(random.between(-2.5, 2.5), random.between(-2.5, 2.5));
            if union.signed_distance(&p).abs() < 1e-6 {
                continue;
            }
            let any = members.iter().any(|(x, y, s)| {
                // rounded shapes as parry sees them go through an iteration good to 1e-8
                s.contains_local_point(Vector::new(p.x - x, p.y - y))
            });
            assert_eq!(union.contains(&p), any, "round {round} at {p}");
        }
    }
}

/// All points within a radius of a polygon, or of all its edges but the last.
fn rounded(corners: &[[f64; 2]], closed: bool, radius: f64) -> Placed {
    let n = corners.len();
    let edges = (0..if closed { n } else { n - 1 }).map(|i| [corners[i], corners[(i + 1) % n]]);
    let mut members: Vec<Placed> = edges.map(|[a, b]| ShapeSpec::Capsule { a, b, radius }.into()).collect();
    if closed {
        members.push(ShapeSpec::Polyline { vertices: corners.to_vec(), closed }.into());
    }
    ShapeSpec::Compound(members).into()
}

#[test]
fn tangents_of_a_rounded_polygon_end_where_its_arcs_do() {
    // stars of 4 to 11 corners, every second one drawn in, each at its own angle and size
    let mut random = Random(5);
    for round in 0..200_i32 {
        let n = 4 + round % 8;
        let (size, phase) = (libm::pow(10.0, random.between(-3.0, 3.0)), random.between(0.0, PI));
        let corners: Vec<[f64; 2]> = (0..n)
            .map(|i| {
                let length = size * if i % 2 == 1 { random.between(0.4, 0.6) } else { random.between(0.8, 1.0) };
                let angle = phase + 2.0 * PI * f64::from(i) / f64::from(n);
                [length * libm::cos(angle), length * libm::sin(angle)]
            })
            .collect();
        let radius = 0.02 * size;
        let (mut area, mut perimeter, mut arcs) = (0.0, 0.0, 0);
        for i in 0..corners.len() {
            let [a, b, c] = [0, 1, 2].map(|k| Vector2::from(corners[(i + k) % corners.len()]));
            let ([p, q], length) = ([b - a, c - b], (b - a).norm());
            let turn = libm::atan2(p.perp(&q), p.dot(&q));
            let around = if turn > 0.0 { turn } else { 2.0 * libm::tan(0.5 * turn) };
            arcs += usize::from(turn > 0.0);
            area += 0.5 * a.perp(&b) + radius * length + 0.5 * radius * radius * around;
            perimeter += length + radius * around;
        }
        let pieces = rounded(&corners, true, radius).pieces(Side::Inside).unwrap();
        assert_eq!(pieces.len(), corners.len() + arcs, "round {round}");
        let table = Table::new(pieces).unwrap_or_else(|e| panic!("round {round}: {e}"));
        assert!((table.area() - area).abs() < 1e-13 * size * size, "round {round}: {}", table.area() - area);
        assert!(
            (table.perimeter() - perimeter).abs() < 1e-13 * size,
            "round {round}: {}",
            table.perimeter() - perimeter
        );
        let chain = rounded(&corners, false, radius).pieces(Side::Outside).unwrap();
        Table::new(chain).unwrap_or_else(|e| panic!("round {round}, open: {e}"));
    }
}

#[test]
fn a_union_of_thousands_of_members_is_one_outline() {
    let n = 2000;
    let corner = |i: usize| {
        let angle = 2.0 * PI * i as f64 / n as f64;
        let length = 1.0 + 0.1 * libm::sin(7.0 * angle);
        [length * libm::cos(angle), length * libm::sin(angle)]
    };
    let corners: Vec<[f64; 2]> = (0..n).map(corner).collect();
    // a second; ten minutes if every part asked every part of every member
    let pieces = rounded(&corners, true, 0.05).pieces(Side::Inside).unwrap();
    let arcs = pieces.iter().filter(|p| matches!(p.figure(), Figure::Arc { .. })).count();
    assert_eq!(pieces.len(), n + arcs);
}

#[test]
fn what_lies_below_a_height_field_or_behind_a_half_space_is_hidden_however_far_from_its_outline() {
    let field = SharedShape::new(HeightField::new(vec![0.0, 0.0, 0.0], Vector::new(4.0, 1.0)));
    let half = SharedShape::new(HalfSpace::new(Vector::Y));
    for (other, count) in [(field, 2), (half, 1)] {
        for (height, visible) in [(-50.0, 0), (50.0, 1)] {
            let ball = (0.5, height, SharedShape::ball(1.0));
            let union = compound(&[(0.0, 0.0, other.clone()), ball]);
            assert_eq!(pieces(&union, &here(), Side::Outside).unwrap().len(), count + visible, "{height}");
        }
    }
}

#[test]
fn a_short_side_of_a_member_stays_and_is_judged_as_that_of_a_shape_alone() {
    let placed = |shape, x| Placed { shape, translation: [x, 0.0], rotation: 0.0 };
    for (x, short) in [(0.0, false), (1e6, false), (1e8, true)] {
        let border_radius = 1e-7;
        let cuboid = || placed(ShapeSpec::RoundCuboid { half_extents: [0.5; 2], border_radius }, x);
        let ball = placed(ShapeSpec::Ball { radius: 0.5 }, x + 5.0);
        let made = [cuboid(), ShapeSpec::Compound(vec![ball, cuboid()]).into()]
            .map(|shape: Placed| Table::new(shape.pieces(Side::Outside).unwrap()).unwrap().unbounded());
        assert_eq!(made.each_ref().map(|table| table.pieces().len()), [8, 9]);
        assert_eq!(made[0].corners(), made[1].corners());
        for table in made {
            assert_eq!(matches!(table.validate(), Err(Error::TooShort { .. })), short, "{x}");
        }
    }
}

#[test]
fn two_half_spaces_at_an_angle_are_bounded_by_two_rays() {
    let half = |x: f64, y: f64, normal: [f64; 2]| Placed {
        shape: ShapeSpec::HalfSpace { normal },
        translation: [x, y],
        rotation: 0.0,
    };
    // below y = (x − 1)/2 or y = 4 − x/4, alone and with a ball much nearer to the origin than where they meet
    let halves = || vec![half(5.0, 2.0, [-1.0, 2.0]), half(0.0, 4.0, [1.0, 4.0])];
    let ball = ShapeSpec::Ball { radius: 0.01 }.into();
    for members in [halves(), halves().into_iter().chain([ball]).collect()] {
        let walls = Placed::from(ShapeSpec::Compound(members)).pieces(Side::Outside).unwrap();
        assert_eq!(walls.len(), 2);
        for x in [1.0, 5.0, 6.5, 9.0] {
            let height = f64::max(0.5 * (x - 1.0), 4.0 - 0.25 * x);
            let path = Line { point: Vector2::new(x, 20.0), velocity: Vector2::new(0.0, -1.0) };
            let (_, time) = first(&walls, &path).unwrap();
            assert!((time - (20.0 - height)).abs() < 1e-14, "at {x}: {time}");
        }
    }
}

#[test]
fn sides_of_several_members_may_meet_in_one_point_at_any_angles() {
    let mut random = Random(5);
    for round in 0..300 {
        // from a right angle to 10⁻⁶
        let spread = libm::pow(10.0, -f64::from(round % 7));
        let shift = match round / 7 % 3 {
            0 => 0.0,
            1 => 3.0,
            _ => 1000.0,
        };
        let at = Vector2::new(shift + random.between(-1.0, 1.0), 0.4 * shift + random.between(-1.0, 1.0));
        let turn = random.between(0.0, 2.0 * PI);
        // triangles, each with a side that passes through the point
        let triangles: Vec<[Vector2<f64>; 3]> = (0..3 + round % 3)
            .map(|_| {
                let half = if random.unit() < 0.3 { PI } else { 0.0 };
                let (sin, cos) = libm::sincos(turn + half + spread * random.between(-1.5, 1.5));
                let (along, across) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
                let tip = at + along * random.between(-0.5, 0.5) + across * random.between(0.1, 1.0);
                [at + along * random.between(0.3, 2.0), tip, at - along * random.between(0.3, 2.0)]
            })
            .collect();
        let members = triangles.iter().map(|t| ShapeSpec::Triangle { vertices: t.map(Into::into) }.into()).collect();
        let pieces = Placed::from(ShapeSpec::Compound(members)).pieces(Side::Inside).unwrap();
        let union = Table::new(pieces).unwrap();
        assert_eq!(union.validate(), Ok(()), "{round}");
        for _ in 0..50 {
            let p = at + Vector2::new(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
            let inside = |t: &[Vector2<f64>; 3]| (0..3).all(|i| (t[(i + 1) % 3] - t[i]).perp(&(p - t[i])) > 0.0);
            if union.signed_distance(&p).abs() > 1e-9 {
                assert_eq!(union.contains(&p), triangles.iter().any(inside), "{round}: {p}");
            }
        }
    }
}

#[test]
fn balls_that_touch_are_whole() {
    let mut random = Random(7);
    for _ in 0..100 {
        let (r, angle) = (random.between(0.1, 0.9), random.between(0.0, 2.0 * PI));
        for (distance, count) in [(1.0 + r, 2), (1.0 - r, 1)] {
            let (x, y) = (distance * libm::cos(angle), distance * libm::sin(angle));
            let balls = [(0.0, 0.0, SharedShape::ball(1.0)), (x, y, SharedShape::ball(r))];
            let pieces = pieces(&compound(&balls), &here(), Side::Outside).unwrap();
            assert_eq!(pieces.len(), count, "{r} {angle}");
        }
    }
}

#[test]
fn a_polygon_in_a_union_that_crosses_itself_is_told_where() {
    for corners in [[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]], [[0.0, 0.0], [1.0, 1.0], [1.0, 0.5], [0.0, 0.5]]]
    {
        for side in [Side::Inside, Side::Outside] {
            let error = rounded(&corners, true, 0.05).pieces(side).unwrap_err();
            assert!(matches!(error, Error::CrossedOutline { at: [0.5, 0.5] }), "{error:?}");
        }
    }
    // one that touches itself is none
    let pinched = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]];
    assert!(rounded(&pinched, true, 0.05).pieces(Side::Inside).is_ok());
}
