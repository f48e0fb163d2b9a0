//! What shows only once the table is drawn.

use super::{SQUARE, parse};
use billiards_cli::document::{Diagnostic, Source};
use billiards_cli::scene::{Request, SHAPES, Scene};
use billiards_cli::simulation::Simulation;

/// What is wrong with a table, once it is drawn, and how to mend it.
fn drawn_wrong(table: &str) -> (String, String) {
    let orbit = "[[orbit]]\nposition = [0.1, 0.05]\nvelocity = [0.6, 0.8]\n[run]\ncollisions = 1\n";
    let scene = parse(&format!("law = \"specular\"\n{table}\n{orbit}")).unwrap_or_else(|e| panic!("{table}: {e:?}"));
    let errors = Simulation::new(scene).expect_err(table);
    (errors[0].what.clone(), errors[0].help.clone().unwrap_or_default())
}

#[test]
fn pieces_of_a_built_in_table_are_mended_by_its_parameters() {
    for table in ["name = \"mushroom\"\nstem_width = \"2-1e-15\"", "name = \"stadium\"\nhalf_length = 1e-17"] {
        let (what, help) = drawn_wrong(&format!("[table]\n{table}"));
        assert!(what.contains("has a length of only") && help.contains("parameters"), "{table}: {what}; {help}");
    }
}

#[test]
fn errors_of_formulas_give_lengths_in_the_units_of_the_scene() {
    let polar = |formula: &str| drawn_wrong(&format!("[[table.boundary]]\ncurve = {{ polar = \"{formula}\" }}"));
    for (formula, expected) in [
        ("1+0.1*cos(t/2)", "r(2π) must be r(0) = 1.1, not 0.9"),
        ("1+abs(t)", "r(2π) must be r(0) = 1, not 7.283185307179586"),
        ("1000*(1+0.1*cos(t/2))", "r(2π) must be r(0) = 1100, not 900"),
        ("1+0.2*tan(t/4)^2", "r(φ) must be positive and finite at every angle; near φ = 0.0008 it may be inf"),
        ("(1-cos(t))^2", "r(φ) must be positive and finite at every angle; near φ = 0.0008 it may be -0"),
    ] {
        let (what, help) = polar(formula);
        assert!(what.ends_with(expected), "{formula}: {what}");
        let advice = if expected.contains("r(2π)") { "period 2π" } else { "in a cusp, as 1 + cos(t)" };
        assert!(help.contains(advice), "{formula}: {help}");
    }
    // the radius falls by at most √3/2 over a sector of 2π/4096, and it is that in the middle of one of the first two below 0
    let (what, _) = polar("0.5+cos(t)");
    let least: f64 = what.rsplit(' ').next().and_then(|x| x.parse().ok()).expect("a number");
    assert!((-0.0015..=0.0).contains(&least), "{what}");
}

#[test]
fn curves_by_their_points_are_told_what_they_must_do() {
    for (curve, expected, mend) in [
        ("x = \"t\", y = \"t^2\"", "must come back to where it starts; this fails near t = 6.28319", "run once around"),
        ("x = \"cos(t)\", y = \"sin(t)\", over = [0, 3]", "this fails near t = 3.0", "run once around"),
        (
            "x = \"cos(t-sin(2*t)/2)\", y = \"sin(t-sin(2*t)/2)\"",
            "x' and y' both 0, except at the tip of a cusp like that of (t^2, t^3); this fails near t = ",
            "take a parameter that does not stand still",
        ),
        ("x = \"cos(t)\", y = \"sin(t)+0.1*sqrt(1-sin(t-1)^2)\"", "this fails near t = ", "write kinks with abs"),
        (
            "x = \"cos(t)\", y = \"sin(t)+0.1*sqrt(abs(sin(t-1)))\"",
            "have finite derivatives x' and y'; this fails near t = 1.0",
            "where it is vertical",
        ),
        ("x = \"cos(t)\", y = \"sin(2*t)\"", "crosses itself near", "change its formula"),
        ("x = \"cos(t)+0.6*cos(2*t)\", y = \"sin(t)+0.6*sin(2*t)\"", "crosses itself near", "change its formula"),
    ] {
        let (what, help) = drawn_wrong(&format!("[[table.boundary]]\ncurve = {{ {curve} }}"));
        assert!(what.contains(expected) && help.contains(mend), "{curve}: {what}; {help}");
    }
    for (edges, expected, mend) in [
        (
            "{ x = \"t\", y = \"1.5+t^2\", over = [-1, 1] }, { line_to = [-1, 1] }",
            "starts 1.5 away",
            "the edge before it",
        ),
        (
            "{ line_to = [1, 1] }, { x = \"t\", y = \"1+sqrt(1-t^2)\", over = [1, -1] }",
            "must have finite derivatives x' and y'; this fails near t = -1.0",
            "as cos(t) and sin(t) do",
        ),
        ("{ x = \"t\", y = \"t^2\", over = [-1, 1] }, { line_to = [-1, 2] }", "its last edge ends 1 away", "\"from\""),
        ("{ line_to = [0, 0] }, { x = \"-t\", y = \"2*t-t^2\", over = [0, 1.5] }", "ends 0.559017 away", "\"from\""),
    ] {
        let (what, help) = drawn_wrong(&format!("[[table.boundary]]\nloop = {{ from = [-1, 1], edges = [{edges}] }}"));
        assert!(what.contains(expected) && help.contains(mend), "{edges}: {what}; {help}");
    }
}

#[test]
fn formulas_of_coordinates_are_read_with_their_range() {
    let read = |curve: &str| {
        let orbit = "[[orbit]]\nposition = [0, 0]\nvelocity = [0.6, 0.8]\n[run]\ncollisions = 1\n";
        parse(&format!("law = \"specular\"\n[[table.boundary]]\ncurve = {{ {curve} }}\n{orbit}"))
    };
    for (curve, expected) in [
        ("x = \"cos(t)\"", "curve lacks the key \"y\""),
        ("x = \"cos(t)\", y = \"sqrt(cos(t))\"", "sqrt of the negative number"),
        ("x = \"1e200*cos(t)\", y = \"sin(t)\"", "near t = 0.0000 the coordinate is 1e200"),
        ("x = \"cos(t)\", y = \"sin(t)\", over = [0, 0]", "a range has two ends that differ"),
        ("x = \"cos(t)\", y = \"sin(t)\", over = [0]", "a range has two ends that differ"),
        ("x = \"cos(t)\", y = \"sin(t)\", over = [1, 0]", "the range of a closed curve runs downwards"),
        ("x = \"cos(u)\", y = \"sin(t)\"", "unknown name \"u\""),
        ("x = \"cos(t)\", y = \"sin(t)\", polar = \"1\"", "curve has both \"polar\" and \"x\""),
    ] {
        let errors = read(curve).expect_err(curve);
        assert!(errors.iter().any(|error| error.contains(expected)), "{curve}: {errors:?}");
    }
    // what is there of the points tells what is meant
    let errors = read("y = \"sin(t)\", over = [0, 1]").expect_err("there is no x");
    assert!(errors.len() == 1 && errors[0].contains("curve lacks the key \"x\""), "{errors:?}");
    let edges = "{ line_to = [0, 0] }, { y = \"t\", over = [0, 1] }";
    let errors = parse(&format!(
        "law = \"specular\"\n[[table.boundary]]\nloop = {{ from = [-1, 1], edges = [{edges}] }}\n\
         [[orbit]]\nposition = [0, 0]\nvelocity = [0.6, 0.8]\n[run]\ncollisions = 1\n"
    ));
    let errors = errors.expect_err("there is no x");
    assert!(errors.len() == 1 && errors[0].contains("an edge lacks the key \"x\""), "{errors:?}");
    assert!(read("x = \"cos(2*pi*t)\", y = \"sin(2*pi*t)\", over = [0, 1]").is_ok());
}

#[test]
fn a_triangle_has_three_corners_as_a_shape_too() {
    for (n, corners) in [(4, "[0, 0], [1, 0], [1, 1], [0, 1]"), (2, "[0, 0], [1, 0]")] {
        for rounding in ["", ", rounding = 0.25"] {
            let shape = format!("shape = {{ name = \"triangle\", points = [{corners}]{rounding} }}");
            let errors =
                parse(&SQUARE.replace("name = \"square\"", &format!("boundary = [{{ {shape} }}]"))).expect_err(corners);
            assert!(errors[0].contains(&format!("expected 3 points, found {n}")), "{errors:?}");
        }
    }
}

#[test]
fn a_polygon_that_crosses_itself_is_told_where_with_a_rounding_too() {
    for (rounding, expected) in
        [("", "pieces 0 and 2 cross near (0.5, 0.5)"), (", rounding = 0.05", "crosses itself near (0.5, 0.5)")]
    {
        let (what, help) = drawn_wrong(&format!(
            "[[table.boundary]]\nshape = {{ name = \"polygon\", points = [[0, 0], [1, 1], [1, 0], [0, 1]]{rounding} }}"
        ));
        assert!(what.ends_with(expected) && help.contains("touch but not cross"), "{what}; {help}");
    }
}

#[test]
fn a_heightfield_is_said_to_need_pieces_at_its_ends_and_has_enough_with_them() {
    let model = SHAPES.iter().find(|model| model.name == "heightfield").unwrap();
    assert!(
        model.summary.starts_with("a graph") && model.summary.contains("at its ends it must be continued by rays"),
        "{}",
        model.summary
    );
    let field = "[[table.boundary]]\nshape = { name = \"heightfield\", heights = [0, 0.5, 0], size = [2, 1] }\n";
    let (what, help) = drawn_wrong(field);
    assert!(what.starts_with("the boundary is open") && help.contains("with a ray"), "{what}; {help}");
    let rays = "[[table.boundary]]\nray = { from = [1, 0], direction = [1, 0] }\n\
                [[table.boundary]]\nray = { from = [-1, 0], direction = [-1, 0], domain = \"right\" }\n";
    for table in [format!("{field}{rays}"), format!("[table]\nlattice = [[2, 0]]\n{field}")] {
        let orbit = "[[orbit]]\nposition = [0, 2]\nvelocity = [0.25, -1]\n[run]\ncollisions = 1\n";
        let scene = parse(&format!("law = \"specular\"\n{table}{orbit}")).unwrap();
        Simulation::new(scene).unwrap_or_else(|e| panic!("{table}: {e:?}"));
    }
}

#[test]
fn entries_may_stand_on_one_another() {
    let square = "[[table.boundary]]\nshape = { name = \"cuboid\", size = [4, 4], domain = \"inside\" }\n";
    let desk = "[[table.boundary]]\nloop = { from = [-0.5, -2], edges = [{ line_to = [-0.5, -1] }, { line_to = [0.5, -1] }, \
                { line_to = [0.5, -2] }, { line_to = [-0.5, -2] }] }\nlaw = \"specular\"\n";
    let cuboid = |x: f64, size: f64| {
        format!("[[table.boundary]]\nshape = {{ name = \"cuboid\", size = [{size}, 1], center = [{x}, 0] }}\n")
    };
    let scene = |table: &str, position: &str, laws: &str| {
        let law = "law = \"no-slip\"\n[table]\n";
        let orbit = format!("[[orbit]]\nposition = {position}\nvelocity = [0.6, 0.8]\n[run]\ncollisions = 1\n");
        Simulation::new(parse(&format!("{law}{laws}{table}{orbit}")).unwrap())
    };
    for table in [
        format!("{square}{desk}"),
        format!("{square}{}{}", cuboid(0.35, 0.7), cuboid(1.1, 0.8)),
        format!("{}{}", cuboid(0.35, 0.7), cuboid(1.1, 0.8)),
    ] {
        scene(&table, "[-1, -1]", "").unwrap_or_else(|e| panic!("{table}: {e:?}"));
    }
    let both = format!("{square}{desk}");
    let wrong = |errors: Vec<Diagnostic>| errors[0].what.clone();
    let inside = scene(&both, "[0, -1.5]", "").expect_err("in the desk");
    assert!(wrong(inside).contains("outside the table"));
    // the floor is two pieces, of which the desk has three; what has a law keeps it
    let law = |piece: usize| scene(&both, "[-1, -1]", &format!("laws = {{ {piece} = \"specular\" }}\n"));
    assert!((0..5).all(|piece| law(piece).is_ok()));
    assert!((5..8).all(|piece| wrong(law(piece).expect_err("a law")).contains("has a law of its own")));
    assert!(wrong(law(8).expect_err("no piece")).contains("the table has 8"));
}

#[test]
fn a_formula_that_is_positive_inside_is_told_to_change_its_sign() {
    let table = |formula: &str| {
        format!("[[table.boundary]]\ncurve = {{ implicit = \"{formula}\", within = [[-2, -2], [2, 2]] }}")
    };
    let (what, help) = drawn_wrong(&table("1-x^2-y^2"));
    assert_eq!(what, "the formula must be negative inside its curve; it is positive there");
    assert!(help.starts_with("change the sign of the formula"), "{help}");
}

#[test]
fn what_nobody_can_read_is_refused_before_it_is_read() {
    for table in [
        "[[table.boundary]]\noutline = \"none.dxf\"\n",
        "[table]\ndimension = 3\n[[table.boundary]]\nmesh = { file = \"none\" }\n",
    ] {
        let start = if table.contains('3') { "[0, 0, 0]\nvelocity = [1, 0, 0]" } else { "[0, 0]\nvelocity = [1, 0]" };
        let text = format!("law = \"specular\"\n{table}[[orbit]]\nposition = {start}\n[run]\ncollisions = 1\n");
        let scene = Scene::parse(&Source::new("x.toml", &text), &Request::default()).unwrap();
        let errors = Simulation::new(scene).unwrap_err();
        assert!(errors[0].what.contains(" is read from a ."), "{errors:?}");
    }
}
