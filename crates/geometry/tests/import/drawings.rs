//! Outlines from drawings.
use core::f64::consts::PI;
use geometry::{Error, Figure, Piece, Table, Vector2, import};
use proptest::prelude::*;

pub(super) fn drawing(body: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\">\n{body}\n</svg>")
}
fn pieces(body: &str) -> Vec<Box<dyn Piece>> {
    let read = import::svg(&drawing(body), import::TOLERANCE).and_then(|drawing| drawing.pieces(1.0));
    read.unwrap_or_else(|e| panic!("{body}: {e}")).walls
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
/// That of an arc.
fn center(piece: &dyn Piece) -> Option<Vector2<f64>> {
    match piece.figure() {
        Figure::Arc { center, .. } => Some(center),
        _ => None,
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
    let coarse = import::svg(&drawing(&format!("<path d=\"{d}\"/>")), 1e-3).unwrap().pieces(1.0).unwrap().walls;
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
fn where_a_radius_is_half_a_side_that_side_is_left_out_whatever_its_coordinates() {
    // area of a rectangle without the corners of an ellipse
    let area = |[w, h]: [f64; 2], [rx, ry]: [f64; 2]| w * h - (4.0 - PI) * rx * ry;
    for (given, size, radii, pieces) in [
        ("x='10.3' y='5.7' width='40' height='12.2' rx='6.1'", [40.0, 12.2], [6.1, 6.1], 6),
        ("x='12.7' y='3.3' width='25.4' height='10.1' rx='20'", [25.4, 10.1], [12.7, 5.05], 4),
        ("x='0.2' width='0.1' height='1' rx='0.05'", [0.1, 1.0], [0.05, 0.05], 6),
        ("x='0.7' width='2' height='0.6' ry='1'", [2.0, 0.6], [1.0, 0.3], 4),
        // as a program may have computed it
        ("x='0.7' width='2.1' height='0.6' rx='1.0499999999999996' ry='0.1'", [2.1, 0.6], [1.05, 0.1], 6),
    ] {
        let pill = table(&format!("<rect {given}/>"));
        assert_eq!((pill.pieces().len(), pill.corners().len()), (pieces, 0), "{given}");
        let exact = area(size, radii);
        assert!((pill.area() - exact).abs() < 1e-13 * exact, "{given}: {} {exact}", pill.area());
    }
}

#[test]
fn an_arc_a_little_short_of_half_a_turn_is_as_high_as_its_ends_say() {
    // the ends are nearer than a diameter by δ = 5·10⁻¹³, and the centre is lower than they are by √(δ − δ²/4), or higher
    for (large, height) in [(0, 0.999_999_292_89), (1, 1.000_000_707_11)] {
        let top = path(&format!("M0 0A1 1 0 {large} 1 1.9999999999995 0Z")).extent().max.y;
        // the end is rounded, by 2·10⁻¹⁶
        assert!((top - height).abs() < 1e-9, "{top} {height}");
    }
}

#[test]
fn an_arc_is_half_a_circle_where_its_ends_are_a_diameter_apart_but_for_rounding() {
    for start in 1..200 {
        for radius in 1..20 {
            // of one decimal, and so rounded
            let [x, r, end] =
                [start, radius, start + 2 * radius].map(|tenths| format!("{}.{}", tenths / 10, tenths % 10));
            let middle = f64::from(start + radius) / 10.0;
            for (d, middle) in [
                (format!("M{x} 0.7A{r} {r} 0 0 1 {end} 0.7Z"), Vector2::new(middle, -0.7)),
                (format!("M0.7 {end}A{r} {r} 33 0 1 0.7 {x}Z"), Vector2::new(0.7, -middle)),
            ] {
                let drawn = pieces(&format!("<path d=\"{d}\"/>"));
                let [center] = drawn.iter().filter_map(|p| center(&**p)).collect::<Vec<_>>()[..] else { panic!("{d}") };
                assert!((center - middle).norm() < 1e-15 * middle.norm(), "{d}: {center} {middle}");
            }
        }
    }
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

/// A large room, and in it regions that have stretches in common, which bound nothing.
fn joined(regions: &str) -> Table {
    let table = Table::new(pieces(&format!("<rect x='-4' y='-4' width='8' height='8'/>{regions}"))).unwrap();
    assert!(matches!(table.validate(), Err(Error::Spike { .. })), "{regions}: {:?}", table.validate());
    let (joined, _) = table.joined().unwrap();
    assert_eq!(joined.validate(), Ok(()), "{regions}");
    joined
}

#[test]
fn regions_with_a_curved_border_in_common_are_one_obstacle() {
    for (there, back) in [
        ("C -0.5 0.5 0.5 0.5 1 0", "C 0.5 0.5 -0.5 0.5 -1 0"),
        ("C -0.7 0.9 0.1 -1.3 1 0", "C 0.1 -1.3 -0.7 0.9 -1 0"),
        ("C -0.6 0.1 0.4 0.4 1 0", "C 0.4 0.4 -0.6 0.1 -1 0"),
        ("A 1 0.5 0 0 0 1 0", "A 1 0.5 0 0 1 -1 0"),
        ("A 1 1 0 0 0 1 0", "A 1 1 0 0 1 -1 0"),
    ] {
        let upper = format!("<path d='M -1 0 {there} L 1.5 0 L 0 -2.5 L -1.5 0 Z'/>");
        for lower in [
            format!("<path d='M -1 0 {there} L 1.5 0 L 0 2.5 L -1.5 0 Z'/>"),
            format!("<path d='M 1 0 {back} L -1.5 0 L 0 2.5 L 1.5 0 Z'/>"),
        ] {
            for regions in [format!("{upper}{lower}"), format!("{lower}{upper}")] {
                let table = joined(&regions);
                assert!(is_near(table.area(), 64.0 - 7.5), "{there}: {}", table.area());
                assert!([1.0, -1.0].iter().all(|y| !table.contains(&Vector2::new(0.0, *y))));
            }
        }
    }
}

#[test]
fn a_region_all_around_which_there_are_others_is_an_obstacle_like_them() {
    // an eye, and what is above and below it
    let [lid, bag] = ["C -0.5 -1 0.5 -1 1 0", "C -0.5 1 0.5 1 1 0"];
    let [up, down] = ["C 0.5 -1 -0.5 -1 -1 0", "C 0.5 1 -0.5 1 -1 0"];
    let eye = format!("<path d='M -1 0 {bag} {up} Z'/>");
    let above = format!("<path d='M -1 0 {lid} L 1.5 0 L 1.5 -2 L -1.5 -2 L -1.5 0 Z'/>");
    let below = format!("<path d='M 1 0 {down} L -1.5 0 L -1.5 2 L 1.5 2 L 1.5 0 Z'/>");
    for regions in [[&eye, &above, &below], [&above, &eye, &below], [&below, &above, &eye]] {
        let table = joined(&regions.map(String::as_str).concat());
        assert!(is_near(table.area(), 64.0 - 12.0), "{}", table.area());
    }
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
    assert_eq!(import::svg(doctype, 1e-9).unwrap().pieces(1.0).unwrap().walls.len(), 4);
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
    assert_eq!(import::svg(page, 1e-9).unwrap().pieces(1.0).unwrap().walls.len(), 4);
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
        if let Ok(drawn) = import::svg(&drawing(&format!("<path d=\"M0 0{d}\"/>")), 1e-3)
            && let Ok(table) = drawn.pieces(1.0).and_then(|pieces| Table::new(pieces.walls))
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
}

#[test]
fn a_drawing_in_a_unit_of_a_power_of_two_is_the_same_to_the_last_digit() {
    let body = "<rect x='-9' y='-5' width='18' height='10' rx='1.3'/><circle cx='0.1' cy='0.7' r='2.3'/>
        <ellipse cx='-4.1' cy='0.3' rx='0.3' ry='1.1' transform='rotate(20)'/>
        <path d='M5 0A1.7 0.6 30 0 1 6 1L6.3 -1Z'/><path d='M3 3C4 3 4 4 3 4Z'/>";
    let drawn = import::svg(&drawing(body), import::TOLERANCE).unwrap();
    assert_eq!(drawn.size(), 9.0);
    let ten = drawn.pieces(1.0).unwrap();
    for exponent in [-400, -3, 400] {
        let unit = libm::ldexp(1.0, exponent);
        let scaled = drawn.pieces(unit).unwrap();
        assert_eq!((scaled.walls.len(), &scaled.places), (ten.walls.len(), &ten.places));
        for (piece, one) in scaled.walls.iter().zip(&ten.walls) {
            assert_eq!(piece.length(), one.length() * unit);
            for part in [0.0, 0.1, 0.6, 1.0] {
                let [at, there] = [&piece, &one].map(|p| p.landing_at(p.length() * part));
                assert_eq!((at.point, at.normal), (there.point * unit, there.normal), "{one:?}");
            }
        }
    }
}

#[test]
fn outlines_of_any_size_are_nested_alike() {
    let nested = |size: f64| {
        let square = |half: f64| {
            let [a, b] = [-half * size, half * size];
            format!("<polygon points='{a:e},{a:e} {b:e},{a:e} {b:e},{b:e} {a:e},{b:e}'/>")
        };
        let oval = format!("<ellipse cx='{:e}' cy='0' rx='{:e}' ry='{:e}'/>", -7.0 * size, 0.5 * size, size);
        let body = [square(8.0), square(5.0), square(2.0), oval].concat();
        let read = import::svg(&drawing(&body), import::TOLERANCE).unwrap();
        let pieces = read.pieces(1.0 / size).unwrap();
        pieces.walls.iter().map(|piece| piece.landing_at(0.0).normal.map(f64::signum)).collect::<Vec<_>>()
    };
    for size in [1e149, 1e100, 1e-100, 1e-150] {
        assert_eq!(nested(size), nested(1.0), "{size:e}");
    }
}
