//! Outlines from drawings and maps.
use core::f64::consts::PI;
use geometry::parry::SolidSpec;
use geometry::{Error, Figure, Piece, Table, Vector2, Vector3, import};
use proptest::prelude::*;

fn drawing(body: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\">\n{body}\n</svg>")
}
fn pieces(body: &str) -> Vec<Box<dyn Piece>> {
    import::svg(&drawing(body), import::TOLERANCE).unwrap_or_else(|e| panic!("{body}: {e}")).walls
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
    let coarse = import::svg(&drawing(&format!("<path d=\"{d}\"/>")), 1e-3).unwrap().walls;
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
fn a_length_in_any_unit_is_what_css_makes_of_it() {
    for inch in ["96", "96px", "1in", "72pt", "6pc", "25.4mm", "2.54cm", "101.6Q"] {
        let square = table(&format!("<rect width='{inch}' height='{inch}'/>"));
        assert!(is_near(square.area(), 96.0 * 96.0), "{inch}: {}", square.area());
    }
}

#[test]
fn corners_and_arcs_of_no_radius_are_straight() {
    for radii in ["rx='0' ry='1'", "rx='1' ry='0'"] {
        let rect = table(&format!("<rect width='4' height='3' {radii}/>"));
        assert_eq!((rect.area(), rect.pieces().len(), rect.corners().len()), (12.0, 4, 4), "{radii}");
    }
    for arc in ["A0 5 0 0 1 4 0", "A5 0 0 0 1 4 0", "A0 0 0 0 1 4 0", "A5 5 0 0 1 0 0L4 0"] {
        let triangle = path(&format!("M0 0{arc}L4 3Z"));
        assert_eq!((triangle.area(), triangle.pieces().len()), (6.0, 3), "{arc}");
    }
}

#[test]
fn a_skew_keeps_areas_and_moves_a_side_by_the_tangent_of_its_angle() {
    let width = |transform: &str| {
        let skewed = table(&format!("<rect width='4' height='3' transform='{transform}'/>"));
        assert!(is_near(skewed.area(), 12.0), "{transform}: {}", skewed.area());
        skewed.extent().max - skewed.extent().min
    };
    let [x, y] = [width("skewX(30)"), width("skewY(-60)")];
    assert!(is_near(x.x, 4.0 + 3.0 / 3.0_f64.sqrt()) && is_near(x.y, 3.0), "{x}");
    assert!(is_near(y.x, 4.0) && is_near(y.y, 3.0 + 4.0 * 3.0_f64.sqrt()), "{y}");
}

#[test]
fn a_rectangle_of_negative_size_is_refused() {
    for size in ["width='-1' height='1'", "width='1' height='-1'"] {
        let (_, said) = problem(&format!("<rect {size}/>"));
        assert_eq!(said, "width and height must not be negative");
    }
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
    assert_eq!(import::svg(doctype, 1e-9).unwrap().walls.len(), 4);
}

#[test]
fn styles_hide_outlines_or_are_refused() {
    // what drawing programs write is read
    let t = table(
        "<style>.a:hover{fill:red;/* r:3px; */stroke-width:2}.b{display:inline;transform:none}</style>
         <i:namedview xmlns:i='http://x'><i:rect width='9' height='9'/></i:namedview>
         <i:rect xmlns:i='http://x' width='9' height='9'/><image width='9' height='9'/>
         <g style='fill:none;stroke:#000;visibility:visible'><rect class='a' width='2' height='2'/></g>
         <g visibility='hidden'><circle r='1'/><rect x='5' width='1' height='1' style='visibility:visible'/></g>
         <circle r='7' style='display:none !important'/><circle r='8' visibility='collapse'/>
         <switch><foreignObject requiredExtensions='e'/><rect x='8' width='3' height='1'/><circle r='1'/></switch>",
    );
    assert_eq!(t.area(), 8.0);
    for (body, words) in [
        ("<rect width='1' height='1' style='transform: scale(3)'/>", "\"transform\" is read from an attribute only"),
        ("<rect style='width:2px;height:2px'/>", "\"width\" is read from an attribute only"),
        ("<rect width='1' height='1' transform='rotate(9)' transform-origin='1 1'/>", "transform-origin"),
        ("<style>.h{display:none}</style><circle r='1'/>", "this one sets \"display\""),
        ("<style>@media all { circle { r: 3px } }</style><circle r='1'/>", "this one sets \"r\""),
        ("<defs><style><![CDATA[.h { visibility : hidden }]]></style></defs><circle r='1'/>", "\"visibility\""),
    ] {
        let (place, what) = problem(body);
        assert!(place.starts_with("line 2, <") && what.contains(words), "{body}: {place}: {what}");
    }
    let foreign = "<svg xmlns='http://x'><rect width='1' height='1'/></svg>";
    assert!(import::svg(foreign, 1e-9).is_err());
    let page = "<svg style='width:100%;height:auto'><rect width='1' height='1'/></svg>";
    assert_eq!(import::svg(page, 1e-9).unwrap().walls.len(), 4);
}

#[test]
fn an_outline_whose_parts_cancel_crosses_itself() {
    for (d, at) in [
        ("M0 0L100 100L100 0L0 100Z", [50.0, -50.0]),
        // at a vertex
        ("M0 0L-1 -1L-1 1L0 0L1 -1L1 1Z", [0.0, 0.0]),
    ] {
        let error = Table::new(pieces(&format!("<path d='{d}'/>"))).unwrap().validate();
        assert!(matches!(error, Err(Error::Crossing { at: found, .. }) if found == at), "{d}: {error:?}");
    }
    for flat in ["M0 0L1 1", "M0 0L1 0L0 0L1 0Z", "M0 0A1 1 0 0 1 2 0A1 1 0 0 0 0 0"] {
        assert_eq!(problem(&format!("<path d='{flat}'/>")).1, "the outline encloses no area", "{flat}");
    }
}

#[test]
fn an_open_outline_is_closed_where_it_is_filled_and_refused_elsewhere() {
    let open = "d='M0 0H2V2'";
    for filled in [
        format!("<path {open}/>"),
        format!("<path fill='red' {open}/>"),
        format!("<g fill='none'><path style='fill:blue' {open}/></g>"),
        // closed it is, filled or not
        "<path fill='none' d='M0 0H2V2Z'/>".into(),
        "<path fill='none' d='M0 0H2V2L0 0'/>".into(),
        "<polygon fill='none' points='0 0 2 0 2 2'/>".into(),
        "<polyline points='0 0 2 0 2 2'/>".into(),
    ] {
        let t = table(&filled);
        assert!(t.pieces().len() == 3 && t.area() == 2.0, "{filled}");
    }
    for hollow in [
        format!("<path fill='none' {open}/>"),
        format!("<path style='stroke:#000;fill:none' {open}/>"),
        format!("<g fill='none'><path fill='inherit' {open}/></g>"),
        "<path fill='none' d='M0 0H2V2ZM5 5H7V7'/>".into(),
        "<polyline fill='none' points='0 0 2 0 2 2'/>".into(),
    ] {
        let (place, what) = problem(&hollow);
        assert!(place.starts_with("line 2, <"), "{place}");
        assert!(
            what.starts_with("the outline is open and nothing fills it: close it (a path with Z)"),
            "{hollow}: {what}"
        );
    }
}

#[test]
fn an_open_outline_that_a_style_sheet_may_leave_unfilled_is_refused() {
    let sheet = "<style>.a { stroke: #000; FILL: none }</style>";
    for open in [
        "<polyline class='a' points='0 0 2 0 2 2'/>",
        // sheets override attributes and what is inherited
        "<polyline class='a' fill='red' points='0 0 2 0 2 2'/>",
        "<g style='fill:red'><path class='a' d='M0 0H2V2'/></g>",
        "<g style='fill:red'><path class='a' style='fill:inherit' d='M0 0H2V2'/></g>",
    ] {
        let (place, what) = problem(&format!("{sheet}{open}"));
        assert!(place.starts_with("line 2, <p"), "{place}");
        assert!(
            what.contains("style sheets, which are not read, leave some outlines without a fill"),
            "{open}: {what}"
        );
    }
    for mended in [
        "<path class='a' d='M0 0H2V2Z'/>",
        "<polygon class='a' points='0 0 2 0 2 2'/>",
        "<polyline class='a' style='fill:red' points='0 0 2 0 2 2'/>",
    ] {
        assert_eq!(table(&format!("{sheet}{mended}")).area(), 2.0, "{mended}");
    }
    // other sheets have no say
    assert_eq!(table("<style>.a{fill:red}</style><polyline class='a' points='0 0 2 0 2 2'/>").area(), 2.0);
}

#[test]
fn every_piece_and_every_triangle_knows_its_place_in_the_file() {
    let shown = |places: &[import::Place]| places.iter().map(ToString::to_string).collect::<Vec<_>>();
    let drawn = import::svg(&drawing("<circle r='9'/>\n<path d='M0 0H2V2Z'/>"), import::TOLERANCE).unwrap();
    assert_eq!(shown(&drawn.places), ["line 2, <circle>", "line 3, <path>", "line 3, <path>", "line 3, <path>"]);
    // a position written twice starts no piece, and the outline is turned round
    let ring = "[[[0, 0], [0, 0], [0, 3], [4, 3], [4, 3], [4, 0], [0, 0]]]";
    let map = import::geojson(&format!("{{\"type\": \"Polygon\", \"coordinates\": {ring}}}")).unwrap();
    let names = [5, 4, 2, 1].map(|n| format!("coordinates[0][{n}]"));
    assert_eq!(shown(&map.places), names);
    // the piece that the file draws from a position ends there now
    let ends: Vec<_> = map.walls.iter().map(|piece| piece.ends().unwrap()[1]).collect();
    assert_eq!(ends, [[4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [0.0, 0.0]].map(Vector2::from));
    let faces = import::obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n\nf 1 4 \\\n 2\n").unwrap();
    assert_eq!(shown(&faces.places), ["line 5", "line 5", "line 7"]);
    let facet = "facet\nouter\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let facets = import::stl(format!("solid\n{facet}{facet}endsolid\n").as_bytes()).unwrap();
    assert_eq!(shown(&facets.places), ["line 2", "line 9"]);
    let binary = [&[0; 80][..], &2_u32.to_le_bytes(), &[0; 100]].concat();
    let places = shown(&import::stl(&binary).unwrap().places);
    assert_eq!(places, ["facet 0, counted from 0", "facet 1, counted from 0"]);
}

#[test]
fn mistakes_are_named_with_line_and_element() {
    let (place, what) = problem("<g>\n<path d='M0 0L1'/></g>");
    assert_eq!(place, "line 3, <path>");
    assert!(what.contains("expected a number") && what.contains("the end"), "{what}");
    for (body, words) in [
        ("<path d='L1 1'/>", "must start with M"),
        ("<path d='M0 0X'/>", "expected a path command at character 5"),
        ("<path d='M0 0A1 1 0 2 0 1 1'/>", "flag"),
        ("<path d='M0 0L1e999 0'/>", "expected a number between -1e150 and 1e150 at character 6, found \"1e999 0\""),
        ("<circle r='1e999'/>", "r=\"1e999\" must be a number between -1e150 and 1e150"),
        ("<path d='M0 0L1 1'/>", "encloses no area"),
        ("<line x2='1'/>", "bounds nothing"),
        ("<use href='#a'/>", "expand"),
        ("<circle r='-1'/>", "negative"),
        ("<circle r='5%'/>", "absolute unit"),
        ("<rect width='x' height='1'/>", "width"),
        ("<g transform='spin(3)'/>", "spin(3)"),
        ("<g transform='rotate(3'/>", "parenthesis"),
        ("<g transform='scale(2) rotate(20deg)'/>", "transform: expected a number at character 19, found \"deg\""),
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
        let t = Table::new(import::geojson(text).unwrap().walls).unwrap();
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
    let many = r#"{"type": "MultiPolygon", "coordinates": [[[[0,0],[1,0],[1,1],[0,1],[0,0]]], [[[5,0],[6,0],[6,2],[5,2],[5,0]]]]}"#;
    check(many, 3.0, 2);
    check(&format!("\u{feff}{many}"), 3.0, 2);
    // an island in the hole of another polygon
    let island = r#"{"type": "MultiPolygon", "coordinates": [
        [[[0,0],[9,0],[9,9],[0,9],[0,0]], [[1,1],[8,1],[8,8],[1,8],[1,1]]], [[[2,2],[4,2],[4,3],[2,2]]]]}"#;
    check(island, 33.0, 2);
}

#[test]
fn rings_where_they_bound_no_table_are_refused_with_their_place() {
    let square = |at: f64, size: f64| {
        let end = at + size;
        format!("[[{at},{at}],[{end},{at}],[{end},{end}],[{at},{end}],[{at},{at}]]")
    };
    for (polygons, at, words) in [
        (
            format!("[{}, {}]", square(0.0, 4.0), square(5.0, 1.0)),
            "coordinates[0][1]",
            "this hole lies outside its polygon",
        ),
        (format!("[{}], [{}]", square(0.0, 4.0), square(1.0, 1.0)), "coordinates[1][0]", "lies inside another one"),
        ("[[[0,0],[1,0],[1,1]]]".into(), "coordinates[0][0]", "repeat its first position"),
    ] {
        let text = format!(r#"{{"type": "MultiPolygon", "coordinates": [{polygons}]}}"#);
        match import::geojson(&text) {
            Err(Error::Import { place, problem }) => {
                assert!(place == at && problem.contains(words), "{place}: {problem}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn a_key_that_a_map_has_twice_is_named_with_its_place() {
    let square = "[[[0, 0], [1, 0], [1, 1], [0, 0]]]";
    for (text, line, key) in [
        (format!("{{\"type\": \"Polygon\",\n\"coordinates\": {square},\n\"coordinates\": [[]]}}"), 3, "coordinates"),
        (
            format!(
                "{{\"type\": \"Feature\",\n\"properties\": {{\"a\": [{{\"b\": 1,\n \"b\": null}}]}},\n\
                 \"geometry\": {{\"type\": \"Polygon\", \"coordinates\": {square}}}}}"
            ),
            3,
            "b",
        ),
    ] {
        match import::geojson(&text) {
            Err(Error::Import { place, problem }) => {
                assert!(place.starts_with(&format!("line {line}, column ")), "{place}");
                assert_eq!(problem, format!("the key {key:?} occurs twice: keep one of them"));
            }
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn mistakes_in_maps_are_named_with_their_place() {
    for (text, at, words) in [
        ("{", "line 1, column 1", "EOF"),
        ("[]", "the file", "type"),
        (r#"{"type": "Point", "coordinates": [0, 0]}"#, "the file", "\"Point\" bounds no table"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0], [1, "x"]]]}"#, "coordinates[0][1]", "two finite numbers"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [0, 0]]]}"#, "coordinates[0]", "no area"),
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

/// The volume that a surface encloses (divergence theorem), and its number of triangles.
fn volume(surface: &SolidSpec) -> (f64, usize) {
    let SolidSpec::TriMesh { vertices, triangles, .. } = surface else { panic!("{surface:?}") };
    let signed = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|k| Vector3::from(vertices[k]));
        a.dot(&b.cross(&c)) / 6.0
    };
    (triangles.iter().map(signed).sum(), triangles.len())
}

fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().concat()
}

/// A prism over a polygon, its end caps written from a corner of choice.
fn prism(corners: &[[f64; 2]], first: usize) -> String {
    let n = corners.len();
    let vertex = |[x, y]: &[f64; 2], z: i32| format!("v {x} {y} {z}\n");
    let vertices = joined([0, 1].iter().flat_map(|z| corners.iter().map(move |corner| vertex(corner, *z))));
    let face = |order: Vec<usize>| format!("f{}\n", joined(order.iter().map(|k| format!(" {}", k + 1))));
    let top = face((0..n).map(|k| n + (first + k) % n).collect());
    let bottom = face((0..n).rev().map(|k| (first + k) % n).collect());
    let sides = joined((0..n).map(|k| (k, (k + 1) % n)).map(|(a, b)| face(vec![a, b, n + b, n + a])));
    format!("{vertices}{top}{bottom}{sides}")
}

#[test]
fn dented_faces_enclose_what_they_bound() {
    let ell = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let comb: Vec<[f64; 2]> = (0..40).map(|k| [0.1 * f64::from(k), if k % 2 == 0 { 0.3 } else { 2.0 }]).collect();
    let comb = [vec![[3.9, 0.1], [0.0, 0.1]], comb].concat();
    let comb: Vec<_> = comb.into_iter().map(|[x, y]| [x, -y]).collect();
    // a ring, cut open along a line
    let ring = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
    ];
    // corners in the middle of straight edges
    let flat = [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3], [-0.3, 0.3], [-0.2, 0.2], [-0.1, 0.1], [0.0, 0.1]];
    for polygon in [&ell[..], &comb, &ring, &flat] {
        let n = polygon.len();
        let area = (0..n).map(|k| (polygon[k], polygon[(k + 1) % n])).map(|([a, b], [c, d])| 0.5 * (a * d - b * c));
        let area: f64 = area.sum();
        for first in 0..n {
            let (volume, triangles) = volume(&import::obj(&prism(polygon, first)).unwrap().walls);
            assert_eq!(triangles, 2 * (n - 2) + 2 * n, "{polygon:?} from {first}");
            assert!((volume - area).abs() < 1e-14 * area, "{polygon:?} from {first}: {volume} {area}");
        }
    }
    // not only the volume: the point (1.5, 1.5) is outside
    for first in 0..6 {
        let solid =
            import::obj(&prism(&ell, first)).unwrap().walls.solid([0.0; 3], geometry::parry::Side::Outside).unwrap();
        assert_eq!(solid.distance(&[1.5, 1.5, 0.5].into()), 0.5, "from {first}");
    }
}

#[test]
fn obj_lines_may_end_in_any_of_the_usual_ways() {
    let corner = "# a corner\nv 0 0 0\nv 1 0 \\\n 0\nv 0 1 0\nv 0 0 1\n\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    for end in ["\n", "\r\n", "\r"] {
        let text = corner.replace('\n', end);
        assert_eq!(volume(&import::obj(&text).unwrap().walls), (1.0 / 6.0, 4), "{end:?}");
        match import::obj(&text.replace("f 2 3 4", "f 2 3 5")) {
            Err(Error::Import { place, .. }) => assert_eq!(place, "line 11", "{end:?}"),
            other => panic!("{end:?}: {other:?}"),
        }
    }
}

#[test]
fn obj_statements_are_read_as_they_are_written() {
    let corner = "\u{feff}# a corner\no a\nv 0 0 0 1\nv 1 0 \\\n 0\nv 0 1 0\ng b\nv 0 0 1 0.5 0.5 0.5\nvn 0 0 1\nvt 0 0\nl 1 2\np 1\n\
                  usemtl x\nf 1/1/1 3//1 2/1\nf 1 2 4\nf -4 -1 -2\nf 2 3 4 # the last\n";
    assert_eq!(volume(&import::obj(corner).unwrap().walls), (1.0 / 6.0, 4));
    let vertices = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 3 0\n";
    for (statement, words) in [
        ("f 1 2", "at least three corners, not 2"),
        ("f 1 2 5", "there is no vertex 5: the file has 4"),
        ("f 1 2 0", "\"0\" is not a corner"),
        ("f 1 2 -5", "\"-5\" is not a corner"),
        ("f 1 2 x", "\"x\" is not a corner"),
        ("f 1 3 2 4", "do not form a simple polygon"),
        ("f 1 1 1 1", "do not form a simple polygon"),
        ("v 1e200 0 0", "\"1e200\" is not a coordinate"),
        ("v 1 nan 0", "\"nan\" is not a coordinate"),
        ("v 1 1", "three coordinates, not 2"),
        ("surf 0 1 0 1 1 2 3 4", "curved surfaces are not read"),
    ] {
        match import::obj(&format!("{vertices}{statement}\nf 1 2 3\n")) {
            Err(Error::Import { place, problem }) => {
                assert!(place == "line 5" && problem.contains(words), "{place}: {problem}");
            }
            other => panic!("{statement}: {other:?}"),
        }
    }
    assert!(matches!(import::obj(vertices), Err(Error::Empty)));
    assert!(matches!(import::obj("v 1e-200 0 0\n"), Err(Error::Import { .. })));
}

#[test]
fn stl_is_read_to_its_end_or_refused() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0_f32]];
    let facets = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|t: [usize; 3]| t.map(|k| corners[k]));
    let facet = |corners: &[[f32; 3]; 3]| {
        let lines: String =
            corners.iter().map(|[x, y, z]| format!("  VERTEX {x} {y} -{z}\n").replace("--", "")).collect();
        format!("facet normal 0 0 0\n outer loop\n{lines} endloop\nendfacet\n")
    };
    let solid =
        |facets: &[[[f32; 3]; 3]]| format!("solid\n{}endsolid a b\n", facets.iter().map(facet).collect::<String>());
    let two = format!("\u{feff}{}{}", solid(&facets[..1]), solid(&facets[1..]));
    let read = import::stl(two.as_bytes()).unwrap().walls;
    assert_eq!(volume(&read), (-1.0 / 6.0, 4));
    assert!(matches!(read, SolidSpec::TriMesh { vertices, .. } if vertices.len() == 4));

    let mut binary = [&b"solid and yet binary"[..], &[b' '; 60], &4_u32.to_le_bytes()].concat();
    for facet in &facets {
        binary.extend([0; 12]);
        binary.extend(facet.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        binary.extend([0; 2]);
    }
    assert_eq!(volume(&import::stl(&binary).unwrap().walls), (1.0 / 6.0, 4));

    let refused = |bytes: &[u8], at: &str, words: &str| match import::stl(bytes) {
        Err(Error::Import { place, problem }) => assert!(place == at && problem.contains(words), "{place}: {problem}"),
        other => panic!("{other:?}"),
    };
    let mut few = binary.clone();
    few[..5].copy_from_slice(b"bytes");
    few[80] = 2;
    refused(&few, "the file", "2 facets are announced, which take 184 bytes; it has 284");
    few[80] = 5;
    refused(&few, "the file", "5 facets are announced");
    few[80] = 4;
    few[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    refused(&few, "the file", "facet 0 is not a finite number");
    let text = solid(&facets);
    refused(text.split("endsolid").next().unwrap().as_bytes(), "the file", "ends before \"endsolid\"");
    refused(text.replacen("VERTEX 0 0", "VERTEX 0", 1).as_bytes(), "line 4", "three finite numbers");
    refused(text.replacen("endloop", "VERTEX 0 0 0", 1).as_bytes(), "line 7", "expected \"endloop\"");
    refused(format!("{text}rest").as_bytes(), &format!("line {}", text.lines().count() + 1), "expected \"solid\"");
    assert!(matches!(import::stl(b"solid a\nendsolid\n"), Err(Error::Empty)));
}

#[test]
fn texts_of_stl_keep_all_their_digits() {
    let corners = ["0 0 0", "0.1 1e-17 3", "0.10000000000000002 1 0.3333333333333333", "1e100 0 0"];
    let facet = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|k| corners[k]);
        format!("facet\nouter\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
    };
    let text = format!("solid\n{}{}endsolid\n", facet([0, 1, 2]), facet([3, 1, 2]));
    let SolidSpec::TriMesh { vertices, triangles, .. } = import::stl(text.as_bytes()).unwrap().walls else { panic!() };
    let written = corners.map(|corner| corner.split(' ').map(|x| x.parse::<f64>().unwrap()).collect::<Vec<_>>());
    assert_eq!(vertices.iter().map(|v| v.to_vec()).collect::<Vec<_>>(), written);
    assert_eq!(triangles, [[0, 1, 2], [3, 1, 2]]);
}

#[test]
fn a_face_of_thousands_of_corners_is_cut_into_triangles() {
    // a thin corridor that goes up and down: half of its corners point inwards
    let half = 1500;
    let side = |up: f64| (0..half).map(move |k| Vector3::new(f64::from(k), f64::from(k % 2) * 10.0 + up, 0.0));
    let corners: Vec<_> = side(0.0).chain(side(0.05).collect::<Vec<_>>().into_iter().rev()).collect();
    let vertices = joined(corners.iter().map(|p| format!("v {} {} 0\n", p.x, p.y)));
    let face = joined((1..=corners.len()).map(|k| format!(" {k}")));
    let SolidSpec::TriMesh { vertices, triangles, .. } = import::obj(&format!("{vertices}f{face}\n")).unwrap().walls
    else {
        panic!()
    };
    assert_eq!(triangles.len(), corners.len() - 2);
    let area = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|k| Vector3::from(vertices[k]));
        0.5 * (b - a).cross(&(c - a)).z
    };
    assert!(triangles.iter().all(|t| area(t) > 0.0));
    let sum: f64 = triangles.iter().map(area).sum();
    assert!((sum - 0.05 * f64::from(half - 1)).abs() < 1e-10, "{sum}");
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
            && let Ok(table) = Table::new(pieces.walls)
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
    fn surfaces_of_any_kind_are_read_or_refused(
        faces in prop::collection::vec(prop::collection::vec(1..9_usize, 3..9), 1..4),
        points in prop::collection::vec([-3..4_i32, -3..4, -1..2], 8),
        text in "[svfacetndrlop0-9 .\\n\\\\/-]{0,80}",
    ) {
        let face = |corners: &Vec<usize>| format!("f {}\n", format!("{corners:?}").replace(['[', ',', ']'], ""));
        let vertices = joined(points.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")));
        let _ = import::obj(&format!("{vertices}{}", joined(faces.iter().map(face))));
        let _ = import::obj(&text);
        let _ = import::stl(text.as_bytes());
        let _ = import::stl(format!("solid {text}").as_bytes());
    }

    #[test]
    fn json_of_any_kind_is_read_or_refused(text in "[\\[\\]{}\":,a-zA-Z0-9. ]{0,80}", kind in "Polygon|MultiPolygon|Feature") {
        let _ = import::geojson(&text);
        let _ = import::geojson(&format!("{{\"type\": \"{kind}\", \"coordinates\": [[[{text}]]], \"geometry\": [{text}]}}"));
    }
}
