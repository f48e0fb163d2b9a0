//! The named tables: their geometry, their parameters, and what is wrong with bad ones.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use core::f64::consts::PI;
use geometry::{
    Boundary, Error, Extent, Figure, Landing, Lattice, Line, Outline, Piece, SVector, Table, Vector2, Vector3, WallHit,
    Walls, WithWalls,
    parry::{Room, Side, SolidSpec},
    shapes::{Arc, Bump, Circle, Ellipse, FullLine, Ray, Segment},
    tables::{self, Build, Kind, Value, Values},
    walls,
};
use serde_json::Value as Json;

fn data(path: &str) -> Json {
    let path = format!("{}/../../tests/data/{path}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))).unwrap()
}

fn typical(name: &str) -> Table {
    let entry = tables::find(name).unwrap();
    entry.planar(&entry.typical()).unwrap()
}

/// The tables of the reference data by the names that they have there.
fn reference(name: &str) -> Table {
    let torus = |radius: f64| tables::sinai_torus(radius, 1.0).unwrap();
    match name {
        "wedge_pi3" => tables::wedge(PI / 3.0).unwrap(),
        "wedge_1" => tables::wedge(1.0).unwrap(),
        "wedge_p8" => tables::wedge(libm::acos(0.5 - 1.5 * libm::cos(PI / 4.0))).unwrap(),
        "sinai_square" => typical("sinai"),
        "sinai_torus_r14" => torus(0.25),
        "sinai_torus_r38" => torus(0.375),
        name => typical(name),
    }
}

/// A number of the reference data: exactly where its expression is a dyadic fraction, else its nearest `f64`.
fn number(json: &Json) -> (f64, bool) {
    let (expression, decimal) = (json["expr"].as_str().unwrap(), json["dec"].as_str().unwrap());
    let denominator = expression.split_once('/').map_or("1", |(_, d)| d);
    let dyadic = expression.chars().all(|c| c.is_ascii_digit() || "-/".contains(c))
        && denominator.parse::<u32>().is_ok_and(u32::is_power_of_two);
    (decimal.parse().unwrap(), dyadic)
}

/// Dyadic numbers must be met exactly, others to 1 ulp of 1: they are functions of correctly rounded arguments.
fn close(ours: f64, theirs: &Json, what: &str) {
    let (theirs, exact) = number(theirs);
    let bound = if exact { 0.0 } else { f64::EPSILON };
    assert!((ours - theirs).abs() <= bound, "{what}: {ours} is not {theirs}");
}

fn close_point(ours: Vector2<f64>, theirs: &Json, what: &str) {
    close(ours.x, &theirs[0], what);
    close(ours.y, &theirs[1], what);
}

#[test]
fn named_tables_have_the_geometry_of_the_reference_orbits() {
    let mut seen = vec![];
    for orbit in data("traj_index.json").as_array().unwrap() {
        let name = orbit["table"].as_str().unwrap().to_string();
        if seen.contains(&name) {
            continue;
        }
        let table = data(orbit["file"].as_str().unwrap())["table"].clone();
        let ours = reference(&name);
        let pieces = table["pieces"].as_array().unwrap();
        assert_eq!(ours.pieces().len(), pieces.len(), "{name}");
        for (i, (piece, theirs)) in ours.pieces().iter().zip(pieces).enumerate() {
            assert_eq!(theirs["index"], i);
            let what = format!("{name}, piece {i}");
            match (piece.figure(), theirs["kind"].as_str().unwrap()) {
                (Figure::Segment { ends: [a, b] }, "segment") => {
                    close_point(a, &theirs["a"], &what);
                    close_point(b, &theirs["b"], &what);
                }
                (Figure::Line { through, direction }, "line") => {
                    close_point(through, &theirs["origin"], &what);
                    close_point(direction, &theirs["direction"], &what);
                }
                (Figure::Ray { from, direction, left }, "ray") => {
                    close_point(from, &theirs["origin"], &what);
                    close_point(direction, &theirs["direction"], &what);
                    assert_eq!(left, theirs["domain"] == "left", "{what}");
                }
                (Figure::Circle { center, radius, inside }, "arc") => {
                    assert_eq!(theirs["full"], true, "{what}");
                    close_point(center, &theirs["center"], &what);
                    close(radius, &theirs["radius"], &what);
                    assert_eq!(inside, theirs["side"] == "focusing", "{what}");
                }
                (Figure::Arc { center, radius, ends, inside }, "arc") => {
                    assert_eq!(theirs["full"], false, "{what}");
                    close_point(center, &theirs["center"], &what);
                    close(radius, &theirs["radius"], &what);
                    assert_eq!(inside, theirs["side"] == "focusing", "{what}");
                    // theirs run counter-clockwise, ours with the table on the left
                    let [a, b] = if inside { ends } else { [ends[1], ends[0]] };
                    close_point(a, &theirs["from"], &what);
                    close_point(b, &theirs["to"], &what);
                    let more = piece.length() > PI * radius * (1.0 + 4.0 * f64::EPSILON);
                    assert_eq!(theirs["more_than_half_circle"], more, "{what}");
                }
                (Figure::Other, "ellipse") => {
                    let extent = piece.extent();
                    close(extent.max.x, &theirs["a"], &what);
                    close(extent.max.y, &theirs["b"], &what);
                    assert_eq!(extent.min, -extent.max, "{what}");
                }
                (figure, kind) => panic!("{what} is {figure:?}, not a {kind}"),
            }
        }
        seen.push(name);
    }
    assert_eq!(seen.len(), 18);
}

#[test]
fn areas_and_perimeters_have_their_closed_forms() {
    let closed_forms = data("closed_forms.json");
    let mean_free = closed_forms["mean_free"].as_object().unwrap();
    assert_eq!(mean_free.len(), 14);
    for (name, values) in mean_free {
        let table = reference(name);
        for (what, ours) in [("area", table.area()), ("perimeter", table.perimeter())] {
            let exact: f64 = values[what].as_str().unwrap().parse().unwrap();
            // sums of at most eight terms that are right to an ulp or two
            assert!((ours / exact - 1.0).abs() <= 1e-15, "{what} of {name}: {ours} is not {exact}");
        }
    }
}

#[test]
fn areas_and_perimeters_of_the_others_too() {
    let near = |ours: f64, exact: f64| assert!((ours / exact - 1.0).abs() <= 2e-15, "{ours} is not {exact}");
    let lorentz = tables::lorentz(0.4, 2.0).unwrap();
    near(lorentz.area(), 2.0 * 3.0_f64.sqrt() - PI * 0.16);
    near(lorentz.perimeter(), 0.8 * PI);
    for (n, side) in [(3, 1.0), (5, 2.0), (7, 0.1), (24, 1.0)] {
        let flat = n as f64 * side * side / (4.0 * libm::tan(PI / n as f64));
        near(tables::polygon(n, side).unwrap().area(), flat);
        near(tables::polygon(n, side).unwrap().perimeter(), n as f64 * side);
        let bent = tables::perturbed_polygon(n, side, 0.03).unwrap();
        near(bent.area(), flat + 16.0 / 35.0 * 0.03 * n as f64 * side * side);
        assert!(bent.perimeter() > n as f64 * side);
    }
    // chord 1 and sagitta 1/8: radius 17/16, half angle asin 8/17
    let segment =
        0.5 * (17.0 / 16.0) * (17.0 / 16.0) * (2.0 * libm::asin(8.0 / 17.0) - 2.0 * (8.0 / 17.0) * (15.0 / 17.0));
    near(tables::channel(1.0, 1.0, 0.125).unwrap().area(), 1.0 - 2.0 * segment);
    near(tables::channel(1.0, 1.0, -0.125).unwrap().area(), 1.0 + 2.0 * segment);
    near(tables::channel(1.0, 1.0, -0.125).unwrap().perimeter(), 4.0 * (17.0 / 16.0) * libm::asin(8.0 / 17.0));
    near(tables::channel(3.0, 0.5, 0.0).unwrap().area(), 1.5);
}

#[test]
fn tables_scale_by_powers_of_two_to_the_last_bit() {
    for entry in tables::all() {
        for factor in [0.25, 2.0, 1_099_511_627_776.0] {
            let values = entry.typical();
            let scaled = entry.scaled(&values, factor);
            match entry.build {
                Build::Planar(build) => {
                    let (small, large) = (build(&values).unwrap(), build(&scaled).unwrap());
                    assert_eq!(large.corners().len(), small.corners().len());
                    for (s, l) in small.corners().iter().zip(large.corners()) {
                        assert_eq!(s * factor, *l, "{}", entry.name);
                    }
                    for (s, l) in small.pieces().iter().zip(large.pieces()) {
                        assert_eq!(s.length() * factor, l.length(), "{}", entry.name);
                    }
                    if small.area().is_finite() {
                        assert_eq!(small.area() * factor * factor, large.area(), "{}", entry.name);
                    }
                }
                Build::Spatial(build) => {
                    let (small, large) = (build(&values).unwrap(), build(&scaled).unwrap());
                    assert_eq!(small.volume() * factor * factor * factor, large.volume(), "{}", entry.name);
                }
            }
        }
    }
}

#[test]
fn figures_have_their_symmetries_exactly() {
    for n in 3..=24 {
        for table in [tables::polygon(n, 1.0), tables::flower(n, 0.75, 1.0), tables::perturbed_polygon(n, 1.0, 0.1)] {
            let corners: Vec<Vector2<f64>> = table.unwrap().pieces().iter().map(|p| p.ends().unwrap()[0]).collect();
            for c in &corners {
                let has = |x: f64, y: f64| corners.iter().any(|d| d.x == x && d.y == y);
                assert!(has(c.x, -c.y), "{n}: {c}");
                if n % 2 == 0 {
                    assert!(has(-c.x, c.y) && has(-c.x, -c.y), "{n}: {c}");
                }
            }
        }
    }
    let corners = |t: &Table| -> Vec<Vector2<f64>> { t.pieces().iter().map(|p| p.ends().unwrap()[0]).collect() };
    assert_eq!(corners(&tables::hexagon(1.0).unwrap()), corners(&tables::polygon(6, 1.0).unwrap()));
    assert_eq!(corners(&tables::flower(4, 1.25, 2.0).unwrap())[0], Vector2::new(1.0, -1.0));
}

#[test]
fn every_table_lies_on_the_left_of_its_boundary() {
    for entry in tables::all().iter().filter(|e| e.dimension() == 2) {
        let table = entry.planar(&entry.typical()).unwrap();
        for (i, piece) in table.pieces().iter().enumerate() {
            let length = if piece.length().is_finite() { piece.length() } else { 2.0 };
            // rays may run towards their end
            let off = |s: f64| (piece.closest(&piece.point_at(s)).point - piece.point_at(s)).norm();
            let s = if off(length) < 1e-9 { 1.0 } else { -1.0 };
            for fraction in [0.2, 0.4, 0.6, 0.8] {
                let at = piece.closest(&piece.point_at(s * fraction * length));
                let (inner, outer) = (at.point + at.normal * 1e-3, at.point - at.normal * 1e-3);
                assert!(table.contains(&inner) && !table.contains(&outer), "{}, piece {i}", entry.name);
                assert!((table.signed_distance(&inner) - 1e-3).abs() < 1e-15, "{}, piece {i}", entry.name);
                assert!((table.signed_distance(&outer) + 1e-3).abs() < 1e-15, "{}, piece {i}", entry.name);
            }
        }
    }
}

#[test]
fn the_registry_has_the_tables_of_the_manual() {
    let listed: Vec<(&str, Vec<&str>)> =
        tables::all().iter().map(|e| (e.name, e.parameters.iter().map(|p| p.name).collect())).collect();
    for (name, parameters) in [
        ("strip", vec!["width"]),
        ("wedge", vec!["angle"]),
        ("circle", vec!["radius"]),
        ("ellipse", vec!["semi_axes"]),
        ("square", vec!["side"]),
        ("rectangle", vec!["size"]),
        ("equilateral", vec!["side"]),
        ("isosceles", vec!["base", "height"]),
        ("triangle", vec!["vertices"]),
        ("hexagon", vec!["side"]),
        ("polygon", vec!["sides", "side"]),
        ("perturbed-polygon", vec!["sides", "side", "amount"]),
        ("stadium", vec!["half_length", "radius"]),
        ("mushroom", vec!["cap_radius", "stem_width", "stem_height"]),
        ("pocket", vec!["size", "pocket_radius", "pocket_depth"]),
        ("moon", vec!["radius", "bite_radius", "bite_distance"]),
        ("flower", vec!["petals", "petal_radius"]),
        ("sinai", vec!["side", "radius"]),
        ("sinai-torus", vec!["radius"]),
        ("lorentz", vec!["radius", "spacing"]),
        ("channel", vec!["length", "height", "sagitta"]),
        ("slab", vec!["height"]),
        ("box", vec!["size"]),
        ("ball", vec!["radius"]),
    ] {
        let (_, ours) = listed.iter().find(|(n, _)| *n == name).unwrap_or_else(|| panic!("no {name}"));
        assert!(parameters.iter().all(|p| ours.contains(p)), "{name} has {ours:?}");
    }
    let required = |name: &str| {
        let entry = tables::find(name).unwrap();
        entry.parameters.iter().filter(|p| p.required).map(|p| p.name).collect::<Vec<_>>()
    };
    assert_eq!(required("stadium"), Vec::<&str>::new());
    assert_eq!(required("channel"), ["sagitta"]);
}

#[test]
fn wrong_parameters_are_named() {
    let fails = |table: &str, values: Values| tables::find(table).unwrap().planar(&values).unwrap_err();
    let with = |name: &str, value: f64| Values::new().with(name, value);
    // (table, values, parameter at fault)
    for (table, values, at_fault) in [
        ("stadium", with("radius", 0.0), "radius"),
        ("stadium", with("half_length", -1.0), "half_length"),
        ("stadium", with("radius", f64::NAN), "radius"),
        ("wedge", with("angle", PI), "angle"),
        ("mushroom", with("stem_width", 2.0), "stem_width"),
        ("pocket", with("pocket_depth", 0.625), "pocket_depth"),
        ("pocket", Values::new().with("size", vec![0.25, 1.0]), "size"),
        ("moon", with("bite_distance", 1.75), "bite_distance"),
        ("moon", with("bite_distance", 0.25), "bite_distance"),
        ("flower", with("petal_radius", 0.99), "petal_radius"),
        ("flower", with("petals", 1.0), "petals"),
        ("sinai", with("radius", 0.5), "radius"),
        ("sinai-torus", with("radius", 0.5), "radius"),
        ("lorentz", with("radius", 0.5), "radius"),
        ("channel", with("sagitta", 0.5), "sagitta"),
        ("channel", with("sagitta", -0.5), "sagitta"),
        ("channel", with("sagitta", 0.3).with("height", 0.5), "sagitta"),
        ("polygon", with("sides", 2.0), "sides"),
        ("polygon", with("sides", 3.5), "sides"),
        ("polygon", with("sides", -3.0), "sides"),
        ("polygon", with("sides", 1e12), "sides"),
        ("perturbed-polygon", with("amount", -0.7), "amount"),
        ("ellipse", Values::new().with("semi_axes", vec![1.0, f64::INFINITY]), "semi_axes"),
        ("rectangle", Values::new().with("size", vec![1.0, 0.0]), "size"),
    ] {
        let error = fails(table, values.clone());
        let (name, value) = match &error {
            Error::Parameter { name, value, .. } => (*name, value.to_string()),
            Error::Count { name, value, .. } => (*name, value.to_string()),
            other => panic!("{table}: {other}"),
        };
        assert_eq!(name, at_fault, "{table}: {error}");
        let text = error.to_string();
        assert!(text.starts_with(at_fault) && text.contains(&value), "{text}");
    }
    assert_eq!(fails("polygon", with("sides", 2.0)).to_string(), "sides must be between 3 and 1000000, not 2");
    let error = fails("stadium", with("width", 1.0));
    assert_eq!(error.to_string(), "stadium has no parameter width; it has half_length, radius");
    assert_eq!(fails("wedge", Values::new()), Error::Missing { name: "angle" });
    assert_eq!(fails("rectangle", with("size", 1.0)).to_string(), "size must be a list of 2 numbers, not 1");
    let three = Values::new().with("size", vec![1.0; 3]);
    assert_eq!(fails("rectangle", three).to_string(), "size must be a list of 2 numbers, not a list of 3 numbers");
    let four = Values::new().with("vertices", vec![[0.0, 0.0]; 4]);
    let said = "vertices must be a list of 3 points [x1, x2], not a list of 4 points";
    assert_eq!(fails("triangle", four).to_string(), said);
    assert_eq!(
        [Kind::Lengths(4), Kind::Points(4)].map(Kind::form),
        ["a list of 4 numbers", "a list of 4 points [x1, x2]"]
    );
    let clockwise = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]];
    assert_eq!(fails("triangle", Values::new().with("vertices", clockwise)), Error::Orientation { piece: 0 });
    let flat = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
    assert_eq!(fails("triangle", Values::new().with("vertices", flat)), Error::Orientation { piece: 0 });
    assert_eq!(fails("ball", Values::new()), Error::Dimension { table: "ball", dimension: 3 });
    assert!(tables::find("rhombus").is_none());
}

#[test]
fn typical_values_have_the_form_of_their_kind() {
    for entry in tables::all() {
        assert_eq!(entry.complete(&entry.typical()), Ok(entry.typical()));
        for parameter in entry.parameters {
            match (parameter.kind, &parameter.value) {
                (Kind::Lengths(n), Value::List(list)) => assert_eq!(list.len(), n),
                (Kind::Points(n), Value::Points(points)) => assert_eq!(points.len(), n),
                (Kind::Lengths(_) | Kind::Points(_), value) | (_, value @ (Value::List(_) | Value::Points(_))) => {
                    panic!("{}: {value:?}", parameter.name)
                }
                _ => {}
            }
        }
    }
}

#[test]
fn tables_in_space_know_their_size_and_where_they_are() {
    let p = |x: f64, y: f64, z: f64| SVector::from([x, y, z]);
    let cuboid = tables::cuboid([1.0, 2.0, 3.0]).unwrap();
    assert_eq!((cuboid.volume(), cuboid.surface_area(), cuboid.pieces().len()), (6.0, 22.0, 6));
    assert_eq!(cuboid.signed_distance(&p(0.5, 0.25, 1.0)), 0.25);
    assert_eq!(cuboid.signed_distance(&p(4.0, -4.0, 1.0)), -5.0);
    let ball = tables::ball(2.0).unwrap();
    assert!((ball.volume() - 32.0 / 3.0 * PI).abs() < 1e-14 && (ball.surface_area() - 16.0 * PI).abs() < 1e-14);
    assert_eq!(ball.signed_distance(&p(0.0, 3.0, 4.0)), -3.0);
    assert!(ball.contains(&p(1.0, 1.0, 1.0)) && !ball.contains(&p(0.0, 0.0, 2.0)));
    let slab = tables::slab(1.0).unwrap();
    assert_eq!((slab.volume(), slab.signed_distance(&p(1e9, 0.0, 0.75))), (f64::INFINITY, 0.25));
    assert_eq!(slab.pieces(), ["floor", "ceiling"]);
}

/// Every table in space, typical.
fn spatial() -> impl Iterator<Item = tables::SpatialTable> {
    let entries = tables::all().iter().filter(|entry| entry.dimension() == 3);
    entries.map(|entry| entry.spatial(&entry.typical()).unwrap())
}

/// Points in a table in space and around it, on no plane of symmetry.
fn points_about(table: &tables::SpatialTable) -> impl Iterator<Item = Vector3<f64>> {
    let Extent { min, max } = table.extent();
    let [low, high] = [min, max].map(|corner| corner.map(|x| x.clamp(-1.0e3, 1.0e3)));
    let shares = [-0.21, 0.03, 0.26, 0.57, 0.83, 0.98, 1.3];
    let along = move |axis: usize, share: f64| low[axis] + (high[axis] - low[axis]) * share;
    let shares = move |by: f64| shares.into_iter().map(move |share| share + by);
    shares(0.0).flat_map(move |x| {
        shares(0.003).flat_map(move |y| shares(0.011).map(move |z| Vector3::new(along(0, x), along(1, y), along(2, z))))
    })
}

#[test]
fn a_point_is_in_a_table_in_space_where_it_is_before_all_walls_and_as_far_off_as_the_nearest() {
    for table in spatial() {
        let name = table.name();
        let solids: Vec<_> =
            table.solids().iter().map(|(spec, center, side)| spec.solid(*center, *side).unwrap()).collect();
        let (mut inside, mut outside) = (0, 0);
        for point in points_about(&table) {
            let walls = table.walls_at(&point);
            let numbers: Vec<_> = walls.iter().map(|wall| wall.piece).collect();
            assert_eq!(numbers, (0..table.pieces().len()).collect::<Vec<_>>(), "{name}");
            let nearest = walls.iter().min_by(|a, b| a.distance.total_cmp(&b.distance)).unwrap();
            let solid = solids
                .iter()
                .map(|solid| solid.closest(&point))
                .min_by(|a, b| a.distance.total_cmp(&b.distance))
                .unwrap();
            let contains = table.contains(&point);
            assert_eq!(contains, nearest.distance > 0.0, "{name} {point:?}: {walls:?}");
            assert_eq!(contains, solid.distance > 0.0, "{name} {point:?}: {solid:?}");
            let near = 8.0 * nearest.slack;
            assert!((table.signed_distance(&point) - solid.distance).abs() <= near, "{name} {point:?}: {solid:?}");
            if contains {
                assert_eq!(nearest.distance, table.signed_distance(&point), "{name} {point:?}");
                assert!((nearest.normal.normalize() - solid.normal).norm() < 1e-15, "{name} {point:?}");
                inside += 1;
            } else {
                outside += 1;
            }
        }
        assert!(inside > 20 && outside > 20, "{name}: {inside}, {outside}");
    }
}

/// The first hit of a path in space.
struct HitInSpace(Line<3>);

impl WithWalls<3> for HitInSpace {
    type Output = WallHit<f64, 3>;
    fn run<W: Walls<3>>(self, walls: &W) -> WallHit<f64, 3> {
        walls.first_hit(&self.0.point.into(), &self.0.velocity.into())
    }
}

#[test]
fn what_is_hit_in_space_is_the_wall_of_that_number_there() {
    for table in spatial() {
        let name = table.name();
        for (k, point) in points_about(&table).enumerate().filter(|(_, point)| table.contains(point)) {
            let k = k as f64;
            let velocity = Vector3::new(libm::sin(k), libm::sin(2.0 * k + 1.0), libm::cos(3.0 * k));
            let hit = table.with_walls(HitInSpace(Line { point, velocity }));
            let (at, normal) = (point + velocity * hit.time, Vector3::from(hit.normal).normalize());
            let wall = table.walls_at(&at).into_iter().find(|wall| wall.piece == hit.number()).unwrap();
            assert!(wall.distance.abs() <= 8.0 * wall.slack, "{name} {point:?}: {wall:?}");
            assert!((wall.normal.normalize() - normal).norm() < 1e-14, "{name} {point:?}: {wall:?} {normal:?}");
        }
    }
}

#[test]
fn a_ball_has_room_in_a_table_in_space_until_its_centre_has_nowhere_to_be() {
    for table in spatial() {
        let name = table.name();
        // from points of the table, the largest ball around them that fits
        let largest = points_about(&table).map(|point| table.signed_distance(&point)).fold(0.0, f64::max);
        let radius = 0.25 * largest;
        let (centres, origin) = table.offset(radius).unwrap();
        assert_eq!(centres.name(), name);
        for point in points_about(&table) {
            let (less, all) = (centres.signed_distance(&(point - origin)), table.signed_distance(&point));
            assert_eq!(less > 0.0, all > radius, "{name} {point:?}: {less} {all}");
            // beyond edges, the walls that have been moved are farther
            assert!(
                less <= 0.0 || (less - (all - radius)).abs() <= 1e-15 * (1.0 + point.amax()),
                "{name}: {less} {all}"
            );
        }
        assert!(table.offset(largest).is_ok(), "{name}");
        let Err(Error::NothingLeft { largest: least, .. }) = table.offset(3.0 * largest) else { panic!("{name}") };
        assert!(table.offset(least * (1.0 - 1e-9)).is_ok(), "{name}");
        assert_eq!(table.offset(least).unwrap_err(), Error::NothingLeft { radius: least, largest: least });
        assert_eq!(table.offset(-1.0).unwrap_err(), Error::Radius { radius: -1.0 });
        assert_eq!(table.offset(0.0).unwrap().0.extent(), table.extent());
    }
}

#[test]
fn half_the_least_width_of_a_table_in_space_is_the_radius_of_its_largest_ball() {
    for (table, largest) in [(tables::slab(1.0), 0.5), (tables::cuboid([3.0, 1.0, 2.0]), 0.5), (tables::ball(2.0), 2.0)]
    {
        assert_eq!(table.unwrap().offset(largest).unwrap_err(), Error::NothingLeft { radius: largest, largest });
    }
}

#[test]
fn on_a_lattice_the_arc_length_is_that_on_the_translate_that_is_there() {
    let v = |x: f64, y: f64| Vector2::new(x, y);
    let lattice = Lattice::new(&[v(1.0, 0.0), v(0.0, 1.0)]).unwrap();
    // far from the cell in which it is hit; from its right end it is traversed clockwise
    let disk = Circle::new(v(2.5, -3.5), 0.25, false).unwrap();
    let table = Table::periodic(vec![Box::new(disk)], Some(lattice)).unwrap();
    for (x, y, quarters) in [(0.75, 0.5, 0.0), (0.5, 0.25, 1.0), (0.25, 0.5, 2.0), (0.5, 0.75, 3.0)] {
        let point = v(x, y);
        let s = table.arc_length(0, &Landing { point, normal: (point - v(0.5, 0.5)).normalize() });
        assert!((s - quarters * 0.125 * PI).abs() < 1e-15, "({x}, {y}): {s}");
        assert_eq!(table.curvature(0, &v(x, y)), -4.0);
    }
    assert_eq!(table.arc_length(7, &Landing { point: v(0.0, 0.0), normal: v(1.0, 0.0) }), 0.0);
    let home = table.translations(0).find(|by| (v(2.5, -3.5) + by - v(0.5, 0.5)).amax() < 1e-15);
    assert!(home.is_some());
}

/// The normal at the hit of a path.
struct NormalOf(Line<2>);
impl WithWalls<2> for NormalOf {
    type Output = Vector2<f64>;
    fn run<W: Walls<2>>(self, walls: &W) -> Vector2<f64> {
        walls.hit(&self.0).unwrap().normal
    }
}

#[test]
fn the_sides_of_regular_polygons_have_the_directions_of_the_figure_however_short() {
    for (n, side) in [(3, 1.0), (5, 1.0), (6, 0.7), (7, 1.0), (16, 0.1), (17, 0.1), (1000, 0.01), (3000, 0.002)] {
        let table = tables::polygon(n, side).unwrap();
        for (k, piece) in table.pieces().iter().enumerate() {
            let (sin, cos) = libm::sincos((2 * k + 1) as f64 * PI / n as f64);
            let outward = Vector2::new(cos, sin);
            // the angle of the comparison carries two roundings
            let near = 8.0 * f64::EPSILON;
            assert!((piece.closest(&outward).normal + outward).amax() <= near, "{n} {k}");
            let hit = table.with_walls(NormalOf(Line { point: Vector2::zeros(), velocity: outward }));
            assert!((hit + outward).amax() <= near, "{n} {k}: {hit:?}");
        }
    }
}

#[test]
fn no_point_is_so_far_outside_that_it_seems_to_lie_inside() {
    let all = [
        tables::square(1.0).unwrap(),
        tables::hexagon(1.0).unwrap(),
        tables::equilateral(1.0).unwrap(),
        tables::stadium(1.0, 1.0).unwrap(),
        tables::sinai(1.0, 0.25).unwrap(),
        tables::mushroom(1.0, 0.5, 0.75).unwrap(),
        tables::strip(1.0).unwrap(),
    ];
    for table in &all {
        for far in [1e11, 1e12, 1e13, 1e16, 1e100, 1e150] {
            for (x, y) in [(0.5, far), (0.5, -far), (-0.3 * far, far), (far, -far)] {
                let at = Vector2::new(x, y);
                assert!(!table.contains(&at), "{table:?} {at}");
                let distance = table.signed_distance(&at);
                assert!(distance < -0.9 * far, "{table:?} {at}: {distance}");
            }
        }
        assert!(!table.contains(&Vector2::new(0.3, f64::NAN)) && !table.contains(&Vector2::new(0.5, f64::INFINITY)));
    }
    let outside = Table::new(vec![Box::new(Circle::new(Vector2::zeros(), 1.0, false).unwrap())]).unwrap();
    assert!(outside.contains(&Vector2::new(1e13, 1e14)));
    let plane = Table::new(vec![Box::new(FullLine::new(Vector2::zeros(), Vector2::x()).unwrap())]).unwrap();
    assert!(plane.contains(&Vector2::new(1.0, 1e15)) && !plane.contains(&Vector2::new(1.0, -1e15)));
}

#[test]
fn in_space_too_what_is_no_place_is_not_in_the_table() {
    for table in [tables::slab(1.0), tables::cuboid([1.0; 3]), tables::ball(1.0)] {
        let table = table.unwrap();
        assert!(table.contains(&[0.25; 3].into()));
        for nowhere in [[f64::NAN, 0.25, 0.25], [0.25, f64::INFINITY, 0.25], [0.25, 0.25, f64::NEG_INFINITY]] {
            assert!(!table.contains(&nowhere.into()), "{nowhere:?}");
        }
    }
}

/// The first hit of one path.
struct FirstHit(Line<2>);

impl WithWalls<2> for FirstHit {
    type Output = WallHit<f64, 2>;
    fn run<W: Walls<2>>(self, walls: &W) -> WallHit<f64, 2> {
        walls.first_hit(&self.0.point.into(), &self.0.velocity.into())
    }
}

#[test]
fn whoever_is_nowhere_hits_nothing() {
    let star = |k: u32| {
        let angle = f64::from(k) * core::f64::consts::TAU / 200.0;
        Vector2::new(libm::cos(angle), libm::sin(angle)) * (1.0 + 0.1 * f64::from(k % 2))
    };
    let outline = (0..200).fold(Outline::from(star(199)), |o, k| o.line_to(star(k)).unwrap());
    let disks = |k: usize| {
        let at = Vector2::new((k % 8) as f64, (k / 8) as f64) * 0.125;
        Box::new(Circle::new(at, 0.03, false).unwrap()) as Box<dyn Piece>
    };
    let torus = Lattice::new(&[Vector2::x(), Vector2::y()]).unwrap();
    let all = [
        Table::new(outline.close().unwrap()).unwrap(),
        tables::flower(30, 1.0, 1.0).unwrap(),
        Table::new((0..40).map(disks).collect()).unwrap(),
        Table::periodic((0..40).map(disks).collect(), Some(torus)).unwrap(),
    ];
    let odd = [0.25, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for (x, y) in odd.iter().flat_map(|x| odd.map(|y| (*x, y))) {
        let nowhere = Vector2::new(x, y);
        let paths = [(nowhere, Vector2::new(0.6, 0.8)), (Vector2::repeat(0.01), nowhere), (nowhere, nowhere)];
        for (point, velocity) in paths.into_iter().filter(|(x, v)| !(is_finite(x) && is_finite(v))) {
            for table in &all {
                let hit = table.with_walls(FirstHit(Line { point, velocity }));
                assert!(!(hit.time > 0.0 && hit.time < f64::INFINITY), "{point} {velocity}: {hit:?}");
            }
        }
    }
    let ball = SolidSpec::Ball { radius: 1.0 }.solid([0.0; 3], Side::Inside).unwrap();
    let room = Room::new(vec![ball]);
    for at in odd.into_iter().filter(|x| !x.is_finite()) {
        let path = Line { point: Vector3::new(at, 0.0, 0.0), velocity: Vector3::y() };
        assert!(room.first_hit(&path).is_none());
    }
}

fn is_finite(v: &Vector2<f64>) -> bool {
    v.iter().all(|x| x.is_finite())
}

#[test]
fn nothing_is_built_of_points_that_are_no_place() {
    for at in [Vector2::new(f64::NAN, 0.0), Vector2::new(0.0, f64::INFINITY)] {
        let refused = |error: Option<Error>| match error {
            Some(Error::Parameter { must: "finite", .. }) => {}
            other => panic!("{at}: {other:?}"),
        };
        refused(Circle::new(at, 1.0, true).err());
        refused(Segment::new(at, Vector2::x()).err());
        refused(Segment::new(Vector2::x(), at).err());
        refused(Bump::new(at, Vector2::x(), 0.1).err());
        refused(Arc::new(at, Vector2::x(), Vector2::y(), true).err());
        refused(Arc::new(Vector2::zeros(), at, Vector2::y(), true).err());
        refused(Ray::new(Vector2::zeros(), at, true).err());
        refused(FullLine::new(Vector2::zeros(), at).err());
        refused(FullLine::new(at, Vector2::x()).err());
        refused(Ray::new(at, Vector2::x(), true).err());
        refused(Ellipse::new(at, [1.0, 2.0], 0.0, true).err());
        refused(walls::Sphere::new(at, 1.0, 0).err());
        refused(walls::Scatterer::new(at, 1.0, 0).err());
        refused(walls::Scatterers::new([(at, 1.0, 0)]).err());
        refused(walls::Capsule::new(at, 1.0, 1.0, [0; 4]).err());
    }
}

#[test]
fn tables_whose_squares_are_no_numbers_are_refused() {
    for size in [1e-150, 1e150] {
        tables::circle(size).unwrap();
        tables::stadium(0.5 * size, 0.5 * size).unwrap();
    }
    for size in [1e-151, 1e151, 1e-300, 1e300] {
        let error = tables::circle(size).unwrap_err();
        assert!(matches!(error, Error::Length { .. }), "{error}");
        assert!(error.to_string().ends_with(&format!("between 1e-150 and 1e150, not {size:?}")), "{error}");
        let [x, y] = [Vector2::new(size, 0.0), Vector2::new(0.0, size)];
        let capsule = walls::Capsule::new(Vector2::zeros(), 1.0, size, [0; 4]).err();
        let can = walls::Cylinder::new(Vector3::zeros(), Vector3::x(), size, 1.0, 0).err();
        let disk = walls::Scatterer::new(Vector2::zeros(), size, 0).err();
        for error in
            [tables::ball(size).err(), capsule, can, disk, Lattice::new(&[x]).err(), Lattice::new(&[y, x]).err()]
        {
            assert!(matches!(error, Some(Error::Length { .. })), "{error:?}");
        }
    }
    // infinite lines through the origin have no size
    tables::wedge(1.0).unwrap();
}

/// A segment that does not know where it ends.
#[derive(Clone, Debug)]
struct Astray(geometry::shapes::Segment, [f64; 2]);

impl geometry::Piece for Astray {
    fn crossing(&self, path: &geometry::Line<2>) -> geometry::Crossing {
        self.0.crossing(path)
    }
    fn landing(&self, path: &geometry::Line<2>, time: f64) -> geometry::Landing {
        self.0.landing(path, time)
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.0.curvature(point)
    }
    fn length(&self) -> f64 {
        self.0.length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.0.point_at(s)
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.0.arc_length_at(point)
    }
    fn closest(&self, point: &Vector2<f64>) -> geometry::Landing {
        self.0.closest(point)
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        Some([self.1.into(); 2])
    }
    fn extent(&self) -> geometry::Extent {
        self.0.extent()
    }
    fn area(&self) -> f64 {
        self.0.area()
    }
}

#[test]
fn an_end_that_is_no_place_is_refused() {
    let segment = geometry::shapes::Segment::new(Vector2::zeros(), Vector2::new(1.0, 0.0)).unwrap();
    for end in [[f64::NAN, f64::NAN], [0.0, f64::NAN]] {
        let table = geometry::Table::new(vec![Box::new(Astray(segment, end))]);
        assert!(matches!(table, Err(Error::Parameter { must: "a number", .. })), "{table:?}");
    }
}

#[test]
fn a_triangle_is_counter_clockwise_wherever_it_lies() {
    let (a, b, c) = (Vector2::new(1.0, 9.0), Vector2::new(4.0, 6.0), Vector2::new(5.0, 10.0));
    for vertices in [[a, b, c], [b, c, a], [c, a, b]] {
        assert_eq!(tables::triangle(vertices).unwrap().area(), 7.5);
        let [a, b, c] = vertices;
        assert_eq!(tables::triangle([a, c, b]).unwrap_err(), Error::Orientation { piece: 0 });
    }
}
