//! Shapes as plain data.
#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests panic where they fail, and claim exact values")]
use core::f64::consts::{FRAC_PI_2, PI};
use geometry::{
    Error, Table, Vector2,
    parry::{Placed, ShapeSpec, Side},
};

fn area(shape: ShapeSpec) -> f64 {
    Table::new(Placed::from(shape).pieces(Side::Inside).unwrap()).unwrap().area()
}
fn field(shape: ShapeSpec) -> String {
    match Placed::from(shape).pieces(Side::Inside) {
        Err(Error::Field { field, .. } | Error::SamePoint { field, .. }) => field,
        other => panic!("{other:?}"),
    }
}
const TRIANGLE: [[f64; 2]; 3] = [[0.0, 0.0], [0.0, 3.0], [4.0, 0.0]];
const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

#[test]
fn every_description_builds_its_shape() {
    let r = 0.5;
    let cases = [
        (ShapeSpec::Ball { radius: 2.0 }, 4.0 * PI),
        (ShapeSpec::Cuboid { half_extents: [1.0, 2.0] }, 8.0),
        (ShapeSpec::Capsule { a: [0.0, 0.0], b: [2.0, 0.0], radius: r }, 2.0 + PI * r * r),
        (ShapeSpec::Triangle { vertices: TRIANGLE }, 6.0),
        (ShapeSpec::Polyline { vertices: SQUARE.to_vec(), closed: true }, 1.0),
        (ShapeSpec::ConvexPolygon { vertices: SQUARE.to_vec() }, 1.0),
        (ShapeSpec::RoundCuboid { half_extents: [1.0, 1.0], border_radius: r }, 4.0 + 8.0 * r + PI * r * r),
        (ShapeSpec::RoundTriangle { vertices: TRIANGLE, border_radius: r }, 6.0 + 12.0 * r + PI * r * r),
        (ShapeSpec::RoundConvexPolygon { vertices: SQUARE.to_vec(), border_radius: r }, 1.0 + 4.0 * r + PI * r * r),
        (ShapeSpec::TriMesh { vertices: SQUARE.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]] }, 1.0),
    ];
    for (shape, expected) in cases {
        // sums of a few terms of order 10
        assert!((area(shape.clone()) - expected).abs() < 1e-14, "{shape:?}");
    }
    let floor = Placed::from(ShapeSpec::HalfSpace { normal: [0.0, 3.0] }).pieces(Side::Outside).unwrap();
    assert_eq!(floor[0].closest(&Vector2::new(1.0, 2.0)).normal, Vector2::y());
    let hills = ShapeSpec::HeightField { heights: vec![0.0, 1.0, 0.0], scale: [2.0, 1.0] };
    assert_eq!(Placed::from(hills).pieces(Side::Outside).unwrap().len(), 2);
    let wall = ShapeSpec::Segment { a: [0.0, 0.0], b: [1.0, 0.0] };
    assert_eq!(Placed::from(wall).pieces(Side::Outside).unwrap().len(), 1);
}

#[test]
fn shapes_are_turned_first_and_moved_then() {
    let tower =
        Placed { shape: ShapeSpec::Cuboid { half_extents: [2.0, 1.0] }, translation: [10.0, 0.0], rotation: FRAC_PI_2 };
    let table = Table::new(tower.pieces(Side::Inside).unwrap()).unwrap();
    let extent = table.extent();
    assert!((extent.min - Vector2::new(9.0, -2.0)).norm() < 1e-15);
    assert!((extent.max - Vector2::new(11.0, 2.0)).norm() < 1e-15);
}

#[test]
fn a_compound_is_the_union_of_its_members_where_they_are() {
    let at = |x: f64, shape: ShapeSpec| Placed { shape, translation: [x, 0.0], rotation: 0.0 };
    let pair = ShapeSpec::Compound(vec![
        at(0.0, ShapeSpec::Cuboid { half_extents: [1.0, 1.0] }),
        at(1.0, ShapeSpec::Compound(vec![at(0.0, ShapeSpec::Cuboid { half_extents: [1.0, 0.5] })])),
    ]);
    assert!((area(pair) - 5.0).abs() < 1e-14);
}

#[test]
fn scale_does_not_matter() {
    for s in [1e-150, 1e-9, 1.0, 1e140] {
        let hexagon = (0..6).map(|k| PI / 3.0 * f64::from(k)).map(|a| [s * libm::cos(a), s * libm::sin(a)]).collect();
        let perimeter = |shape| Table::new(Placed::from(shape).pieces(Side::Inside).unwrap()).unwrap().perimeter() / s;
        let length = perimeter(ShapeSpec::RoundConvexPolygon { vertices: hexagon, border_radius: 0.1 * s });
        assert!((length - (6.0 + 0.2 * PI)).abs() < 1e-14, "{s:e}: {length}");
    }
}

#[test]
fn a_closed_polygon_that_touches_itself_in_a_vertex_is_refused_with_the_vertex() {
    let polygon = |vertices: &[[f64; 2]]| ShapeSpec::Polyline { vertices: vertices.to_vec(), closed: true };
    // two triangles that meet, and a square with an antenna
    let pinched = polygon(&[[0.0, 0.0], [1.0, -0.5], [1.0, 0.5], [0.0, 0.0], [-1.0, 0.5], [-1.0, -0.5]]);
    let antenna = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 2.0], [1.0, 1.0], [0.0, 1.0]]);
    let beside = Placed { translation: [5.0, 0.0], ..ShapeSpec::Ball { radius: 1.0 }.into() };
    for (shape, at) in [(pinched, [0.0, 0.0]), (antenna, [1.0, 1.0])] {
        for shape in [shape.clone(), ShapeSpec::Compound(vec![beside.clone(), shape.into()])] {
            for side in [Side::Inside, Side::Outside] {
                let error = Placed::from(shape.clone()).pieces(side).unwrap_err();
                assert_eq!(error, Error::TouchingOutline { at });
            }
        }
    }
    // a vertex twice in a row is one
    let square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]);
    assert_eq!(Table::new(Placed::from(square).pieces(Side::Inside).unwrap()).unwrap().area(), 1.0);
}

#[test]
fn wrong_fields_are_named() {
    assert_eq!(field(ShapeSpec::Ball { radius: -1.0 }), "radius");
    assert_eq!(field(ShapeSpec::Ball { radius: f64::NAN }), "radius");
    assert_eq!(field(ShapeSpec::Cuboid { half_extents: [1.0, 0.0] }), "half_extents[1]");
    let open = vec![[0.0, 0.0], [f64::INFINITY, 0.0], [1.0, 1.0]];
    assert_eq!(field(ShapeSpec::Polyline { vertices: open, closed: true }), "vertices[1][0]");
    assert_eq!(field(ShapeSpec::Polyline { vertices: vec![[0.0; 2]], closed: false }), "vertices");
    let dart = vec![[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]];
    assert_eq!(field(ShapeSpec::ConvexPolygon { vertices: dart }), "vertices");
    let star = (0..5).map(|k| 0.8 * PI * f64::from(k)).map(|a| [libm::cos(a), libm::sin(a)]).collect();
    assert_eq!(field(ShapeSpec::ConvexPolygon { vertices: star }), "vertices");
    assert_eq!(field(ShapeSpec::Triangle { vertices: [[0.0; 2], [1.0, 0.0], [2.0, 0.0]] }), "vertices");
    assert_eq!(field(ShapeSpec::HalfSpace { normal: [0.0, 0.0] }), "normal");
    let mesh = ShapeSpec::TriMesh { vertices: SQUARE.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 4]] };
    assert_eq!(field(mesh), "triangles[1]");
    assert_eq!(field(ShapeSpec::Segment { a: [1.0, 0.0], b: [1.0, 0.0] }), "b");
    assert_eq!(field(ShapeSpec::Compound(vec![])), "compound");
    let inner = Placed { shape: ShapeSpec::Ball { radius: 0.0 }, translation: [0.0; 2], rotation: 0.0 };
    let nested = ShapeSpec::Compound(vec![ShapeSpec::Ball { radius: 1.0 }.into(), inner]);
    assert_eq!(field(nested), "compound[1].radius");
}
