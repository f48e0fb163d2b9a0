//! Outlines from drawings and maps.
use core::f64::consts::PI;
use geometry::{Error, Figure, Piece, Table, Vector2, import};
use proptest::prelude::*;

fn drawing(body: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\">\n{body}\n</svg>")
}
fn pieces(body: &str) -> Vec<Box<dyn Piece>> {
    import::svg(&drawing(body), import::TOLERANCE).unwrap_or_else(|e| panic!("{body}: {e}"))
}
fn table(body: &str) -> Table {
    let table = Table::new(pieces(body)).unwrap_or_else(|e| panic!("{body}: {e}"));
    assert_eq!(table.validate(), Ok(()), "{body}");
    table
}
fn path(d: &str) -> Table {
    table(&format!("<path d=\"{d}\"/>"))
}
fn problem(body: &str) -> (String, String) {
    match import::svg(&drawing(body), import::TOLERANCE) {
        Err(Error::Import { place, problem }) => (place, problem),
        other => panic!("{body}: {other:?}"),
    }
}
fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * (1.0 + b.abs())
}

#[test]
fn drawings_keep_their_look_with_y_up() {
    // a flag on the upper right of its pole
    let flag = path("M 0 0 L 4 0 L 4 2 L 1 2 L 1 5 L 0 5 Z");
    let e = flag.extent();
    assert_eq!((e.min, e.max), (Vector2::new(0.0, -5.0), Vector2::new(4.0, 0.0)));
    assert!(flag.contains(&Vector2::new(3.0, -1.0)) && !flag.contains(&Vector2::new(3.0, -4.0)));
}

#[test]
fn every_path_command_draws() {
    let square = path("M1,1 L3,1 L3,3 L1,3 Z");
    for d in [
        "M1 1H3V3H1Z",
        "m1 1h2v2h-2z",
        "m 1,1 l 2,0 0,2 -2,0 z",
        "M1 1 3 1 3 3 1 3",
        "M1 1L3 1 3 3 1 3 1 1",
        "M+1.0e0,10e-1h2 v+2 h-.2e1z",
        "M1 1C1 1 3 1 3 1L3 3L1 3Z",
    ] {
        let other = path(d);
        assert!(is_near(other.area(), 4.0), "{d}: {}", other.area());
        assert_eq!(other.extent(), square.extent(), "{d}");
    }
    // arcs: flags without separators, relative, and too small radii that are enlarged
    for d in ["M0 0A1 1 0 0 1 2 0Z", "m0 0a1 1 0 012 0z", "M0 0a.1.1 0 0 1 2 0z"] {
        let half = path(d);
        assert!(is_near(half.area(), 0.5 * PI), "{d} {}", half.area());
        let is_unit_arc = |p: &std::sync::Arc<dyn Piece>| matches!(p.figure(), Figure::Arc { radius: 1.0, .. });
        assert!(half.pieces().iter().any(is_unit_arc), "{d} {half:?}");
    }
    // the large arc, and the other side
    let large = path("M0 0A1 1 0 1 1 1 1Z");
    assert!(is_near(large.area(), 0.75 * PI + 0.5));
    let small = path("M0 0A1 1 0 0 0 1 1Z");
    assert!(is_near(small.area(), 0.25 * PI - 0.5));
}

#[test]
fn smooth_commands_reflect_their_control_points() {
    let long = path("M0 0C0 1 1 2 2 2C3 2 4 1 4 0Z");
    let short = path("M0 0C0 1 1 2 2 2S4 1 4 0Z");
    assert_eq!(long.area(), short.area());
    let long = path("M0 0Q1 2 2 2Q3 2 4 0Z");
    let short = path("M0 0Q1 2 2 2T4 0Z");
    assert_eq!(long.area(), short.area());
}

#[test]
fn bezier_curves_become_smooth_arcs_within_the_tolerance() {
    // the usual four curves for a circle; area 8 ∫… of one quarter is exact by Green
    let k = 0.552_284_749_830_793_4;
    let d = format!("M1 0C1 {k} {k} 1 0 1C-{k} 1 -1 {k} -1 0C-1 -{k} -{k} -1 0 -1C{k} -1 1 -{k} 1 0Z");
    let round = path(&d);
    let quarter = {
        // ½∮(x dy − y dx) of a cubic from (1, 0) to (0, 1): (3/20)·(…)
        let c = [[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]];
        let cross = |i: usize, j: usize| c[i][0] * c[j][1] - c[i][1] * c[j][0];
        0.5 * (0.6 * cross(0, 1)
            + 0.3 * cross(0, 2)
            + 0.1 * cross(0, 3)
            + 0.3 * cross(1, 2)
            + 0.3 * cross(1, 3)
            + 0.6 * cross(2, 3))
    };
    // an error of 1e-9 along a perimeter of 2π
    assert!((round.area() - 4.0 * quarter).abs() < 2.0 * PI * 1e-9, "{} {}", round.area(), 4.0 * quarter);
    assert_eq!(round.corners().len(), 0);
    let bezier = |s: f64| {
        let r = 1.0 - s;
        let x = r * r * r + 3.0 * r * r * s + 3.0 * r * s * s * k;
        let y = 3.0 * r * r * s * k + 3.0 * r * s * s + s * s * s;
        Vector2::new(x, -y)
    };
    for i in 0..1000 {
        let p = bezier(f64::from(i) / 1000.0);
        let off = (round.closest(&p).1.point - p).norm();
        assert!(off <= 1e-9, "{i}: {off:e}");
    }
    // a coarse tolerance needs few arcs
    let coarse = import::svg(&drawing(&format!("<path d=\"{d}\"/>")), 1e-3).unwrap();
    assert!(coarse.len() <= 16 && round.pieces().len() < 2000, "{} {}", coarse.len(), round.pieces().len());
    // curves with inflections, loops of control points and straight parts
    for d in ["M0 0C1 3 2 -3 3 0L1.5 -40Z", "M0 0C2.5 4 0.5 4 3 0Z", "M0 0C1 0 2 0 3 0L0 3Z"] {
        path(d);
    }
}

#[test]
fn shapes_are_exact() {
    let rect = table("<rect x='1' y='2' width='4' height='3'/>");
    assert_eq!((rect.area(), rect.pieces().len()), (12.0, 4));
    let rounded = table("<rect width='4' height='3' rx='1'/>");
    assert!(is_near(rounded.area(), 12.0 - 4.0 + PI));
    assert_eq!((rounded.pieces().len(), rounded.corners().len()), (8, 0));
    // radii at their limit leave no straight edges
    let pill = table("<rect width='4' height='2' rx='9' ry='9'/>");
    assert!(is_near(pill.area(), 2.0 * PI), "{}", pill.area());
    let circle = table("<circle cx='1' cy='2' r='10mm'/>");
    let radius = 960.0 / 25.4;
    assert!(matches!(circle.pieces()[0].figure(), Figure::Circle { center, radius: r, inside: true }
            if center == Vector2::new(1.0, -2.0) && is_near(r, radius)));
    assert!(is_near(table("<ellipse rx='2' ry='1'/>").area(), 2.0 * PI));
    assert_eq!(table("<polygon points='0,0 4,0 4,3'/>").area(), 6.0);
    assert_eq!(table("<polyline points='0 0 4 0 4 3'/>").area(), 6.0);
}

#[test]
fn transformations_move_outlines() {
    let at = |transform: &str| table(&format!("<circle r='1' cx='2' transform='{transform}'/>"));
    let figure = |t: &Table| t.pieces()[0].figure();
    for (transform, x, y, r) in [
        ("translate(3,4)", 5.0, -4.0, 1.0),
        ("translate(3)", 5.0, 0.0, 1.0),
        ("rotate(90)", 0.0, -2.0, 1.0),
        ("rotate(90 2 0)", 2.0, 0.0, 1.0),
        ("scale(2) translate(1 1)", 6.0, -2.0, 2.0),
        ("scale(-1, 1)", -2.0, 0.0, 1.0),
        ("matrix(0 2 -2 0 1 1)", 1.0, -5.0, 2.0),
    ] {
        let found = figure(&at(transform));
        assert_eq!(found, Figure::Circle { center: Vector2::new(x, y), radius: r, inside: true }, "{transform}");
    }
    // other maps make ellipses, of the right area
    for (transform, factor) in [("scale(3,1)", 3.0), ("skewX(40)", 1.0), ("rotate(30) scale(1 2)", 2.0)] {
        assert!(is_near(at(transform).area(), factor * PI), "{transform}");
    }
    let group = table("<g transform='scale(2)'><g transform='translate(1)'><rect width='1' height='1'/></g></g>");
    assert_eq!(group.extent().min, Vector2::new(2.0, -2.0));
    // half an ellipse, sheared: an affine map scales areas by its determinant
    let half = table("<path d='M-2 0A2 1 0 0 1 2 0Z' transform='matrix(1 0.5 -0.25 2 7 7)'/>");
    assert!(is_near(half.area(), PI * 2.125));
}

#[test]
fn loops_are_turned_the_right_way() {
    for inner in ["M1 1h1v1h-1z", "M1 1v1h1v-1z"] {
        for outer in ["M0 0h4v4h-4z", "M0 0v4h4v-4z"] {
            let t = path(&format!("{outer} {inner}"));
            assert_eq!(t.area(), 15.0);
            let t = path(&format!("{inner} {outer}"));
            assert_eq!(t.area(), 15.0);
        }
    }
    // an island in the hole
    let island = table("<rect width='8' height='8'/><circle cx='4' cy='4' r='3'/><circle cx='4' cy='4' r='1'/>");
    assert!(is_near(island.area(), 64.0 - 8.0 * PI));
    assert_eq!(island.components().len(), 2);
    // a hole with arcs and elliptic arcs disperses
    let hole = path("M-9-9h18v18h-18z M-2 0A2 2 0 0 1 2 0A2 1 0 0 1 -2 0Z");
    assert!(is_near(hole.area(), 324.0 - 3.0 * PI));
    assert!(matches!(hole.pieces()[4].figure(), Figure::Arc { inside: false, .. } | Figure::Other));
}

#[test]
fn only_outlines_are_drawn() {
    let t = table(
        "<!-- a comment --><title>x</title><defs><circle r='1'/></defs><text>hi</text>
         <rect width='2' height='2' style='fill: red'/><circle r='5' display='none'/><path d=''/>
         <g style='display : none'><rect width='9' height='9'/></g><rect width='0' height='5'/>",
    );
    assert_eq!(t.pieces().len(), 4);
    assert!(matches!(import::svg(&drawing(""), 1e-9), Err(Error::Empty)));
    let doctype = "<?xml version='1.0'?><!DOCTYPE svg PUBLIC \"a\" \"b\"><svg><rect width='1' height='1'/></svg>";
    assert_eq!(import::svg(doctype, 1e-9).unwrap().len(), 4);
}

#[test]
fn mistakes_are_named_with_line_and_element() {
    let (place, what) = problem("<g>\n<path d='M0 0L1'/></g>");
    assert_eq!(place, "line 3, <path>");
    assert!(what.contains("a number is wanted") && what.contains("the end"), "{what}");
    for (body, words) in [
        ("<path d='L1 1'/>", "must start with M"),
        ("<path d='M0 0X'/>", "a path command is wanted at character 5"),
        ("<path d='M0 0A1 1 0 2 0 1 1'/>", "flag"),
        ("<path d='M0 0L1e999 0'/>", "a number"),
        ("<path d='M0 0L1 1'/>", "encloses no area"),
        ("<line x2='1'/>", "bounds nothing"),
        ("<use href='#a'/>", "expand"),
        ("<circle r='-1'/>", "negative"),
        ("<circle r='5%'/>", "absolute unit"),
        ("<rect width='x' height='1'/>", "width"),
        ("<g transform='spin(3)'/>", "spin(3)"),
        ("<g transform='rotate(3'/>", "parenthesis"),
        ("<polygon points='0 0 1'/>", "a number"),
        ("<circle r='1e200' transform='scale(1e200)'/>", "coordinate is inf"),
        // no tolerance is met by curves of these sizes
        ("<path d='M 0 0 C 1e300 0 -1e300 1e300 1 -1 z'/>", "between 1e-150 and 1e150"),
        ("<path d='M 0 0 C 1e-170 0 0 1e-170 1e-170 1e-170 z'/>", "between 1e-150 and 1e150"),
        ("<rect x='1e16' width='3' height='3'/>", "so far from the origin"),
    ] {
        let (place, what) = problem(body);
        assert!(place.starts_with("line 2, <") && what.contains(words), "{body}: {place}: {what}");
    }
    let broken = import::svg("<svg>\n<g></svg>", 1e-9).unwrap_err();
    assert!(matches!(&broken, Error::Import { place, .. } if place.starts_with("line 2, column ")), "{broken}");
    assert!(import::svg("<html/>", 1e-9).is_err());
    assert!(matches!(import::svg(&drawing("<circle r='1'/>"), 0.0), Err(Error::Parameter { name: "tolerance", .. })));
}

#[test]
fn maps_become_tables() {
    let polygon = r#"{"type": "Polygon", "coordinates": [
        [[0, 0], [0, 4], [4, 4], [4, 0], [0, 0]],
        [[1, 1], [2, 1, 99], [2, 2], [1, 2], [1, 1]]]}"#;
    let check = |text: &str, area: f64, parts: usize| {
        let t = Table::new(import::geojson(text).unwrap()).unwrap();
        assert_eq!(t.validate(), Ok(()));
        assert_eq!((t.area(), t.components().len()), (area, parts));
    };
    check(polygon, 15.0, 1);
    check(&format!(r#"{{"type": "Feature", "properties": null, "geometry": {polygon}}}"#), 15.0, 1);
    let features = format!(
        r#"{{"type": "FeatureCollection", "features": [{{"type": "Feature", "geometry": null}},
            {{"type": "Feature", "geometry": {{"type": "GeometryCollection", "geometries": [{polygon}]}}}}]}}"#
    );
    check(&features, 15.0, 1);
    let many = r#"{"type": "MultiPolygon", "coordinates": [[[[0,0],[1,0],[1,1],[0,1]]], [[[5,0],[6,0],[6,2],[5,2]]]]}"#;
    check(many, 3.0, 2);
}

#[test]
fn mistakes_in_maps_are_named_with_their_place() {
    for (text, at, words) in [
        ("{", "line 1, column 1", "EOF"),
        ("[]", "the file", "type"),
        (r#"{"type": "Point", "coordinates": [0, 0]}"#, "the file", "\"Point\" bounds no table"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0], [1, "x"]]]}"#, "coordinates[0][1]", "two finite numbers"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0], [1, 1]]]}"#, "coordinates[0]", "no area"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0]]]}"#, "coordinates[0]", "three different"),
        (
            r#"{"type": "Polygon", "coordinates": [[[0, 0], [1e200, 0], [0, 1e200]]]}"#,
            "coordinates[0]",
            "between 1e-150 and 1e150",
        ),
        (
            r#"{"type": "Polygon", "coordinates": [[[0, 0], [1e-200, 0], [0, 1e-200]]]}"#,
            "coordinates[0]",
            "between 1e-150 and 1e150",
        ),
        (
            r#"{"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": {"type": "Polygon"}}]}"#,
            "features[0].geometry",
            "must be a list",
        ),
    ] {
        match import::geojson(text) {
            Err(Error::Import { place, problem }) => {
                assert!(place == at && problem.contains(words), "{place}: {problem}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
    assert!(matches!(import::geojson(r#"{"type": "FeatureCollection", "features": []}"#), Err(Error::Empty)));
}

proptest! {
    // whatever is in the file, there is a table or an error
    #[test]
    fn path_data_of_any_kind_is_read_or_refused(d in "[MmLlHhVvCcSsQqTtAaZz0-9eE.,+\\- ]{0,60}") {
        let _ = import::svg(&drawing(&format!("<path d=\"{d}\"/>")), 1e-3);
    }

    #[test]
    fn paths_of_plausible_commands_are_read_or_refused(
        commands in prop::collection::vec(("[MLHVCSQTAZmlhvcsqtaz]", prop::collection::vec(-9..9_i32, 0..8)), 1..12),
    ) {
        let d: String = commands.iter().map(|(c, n)| format!("{c}{n:?}").replace(['[', ']'], " ")).collect();
        if let Ok(pieces) = import::svg(&drawing(&format!("<path d=\"M0 0{d}\"/>")), 1e-3)
            && let Ok(table) = Table::new(pieces)
        {
            let _ = table.validate();
        }
    }

    #[test]
    fn xml_of_any_kind_is_read_or_refused(text in "[<>/a-z\"'= &;!\\[\\]0-9\\n]{0,80}", attribute in "\\PC{0,20}") {
        let _ = import::svg(&text, 1e-3);
        let _ = import::svg(&drawing(&text), 1e-3);
        let _ = import::svg(&drawing(&format!("<rect width=\"{attribute}\" transform=\"{attribute}\"/>")), 1e-3);
    }

    #[test]
    fn json_of_any_kind_is_read_or_refused(text in "[\\[\\]{}\":,a-zA-Z0-9. ]{0,80}", kind in "Polygon|MultiPolygon|Feature") {
        let _ = import::geojson(&text);
        let _ = import::geojson(&format!("{{\"type\": \"{kind}\", \"coordinates\": [[[{text}]]], \"geometry\": [{text}]}}"));
    }
}
