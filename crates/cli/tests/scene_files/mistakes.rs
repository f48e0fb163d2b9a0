//! Each mistake has its message and its place.

use super::{BOUNDARY, NAMED, SPATIAL, SQUARE, errors_of, parse};
use billiards_cli::document::Source;
use billiards_cli::scene::{Request, Scene};

#[test]
fn a_number_of_sides_is_told_its_range() {
    for (table, range) in [("polygon\", sides", "3"), ("flower\", petals", "2")] {
        for n in ["2.5", "1", "1000001"] {
            let scene = format!(
                "law = \"specular\"\ntable = {{ name = \"{table} = {n} }}\nensemble = {{ count = 1 }}\nrun = {{ collisions = 1 }}"
            );
            let errors = Scene::parse(&Source::new("x.toml", &scene), &Request::default()).unwrap_err();
            assert_eq!(errors[0].what, format!("{n} is not a whole number from {range} to 1000000"));
        }
    }
}

#[test]
fn a_point_is_given_no_spin_and_no_angle() {
    let point = NAMED.replacen("\"uniform-disk\"", "\"point\"", 1);
    assert_eq!(parse(&point).unwrap_err(), ["17:12: a point has no spin: its \u{3b3}\u{b2} is 0"]);
    parse(&point.replacen("0.25", "0", 1)).unwrap();
    let turned = point.replacen("spin     = 0.25\nangle    = 0", "angle = \"pi/2\"", 1);
    assert_eq!(parse(&turned).unwrap_err(), ["17:9: a point has no angle: its \u{3b3}\u{b2} is 0"]);
    let ball = SPATIAL.replacen("\"2/5\"", "\"1 - 1\"", 1);
    assert_eq!(parse(&ball).unwrap_err(), ["12:8: a point has no spin: its \u{3b3}\u{b2} is 0"]);
    parse(&ball.replacen("[0, 0.25, 0]", "[0, 0, 0]", 1)).unwrap();
}

#[test]
fn each_mistake_has_its_own_message_at_its_own_place() {
    let mut wrong = Vec::new();
    for (valid, old, new, expected) in [
        (NAMED, "velocity = [", "velocty = [", "16:1: unknown key \"velocty\" in [[orbit]]"),
        (NAMED, "velocity = [0.6, 0.8]", "", "14:1: [[orbit]] lacks the key \"velocity\""),
        (NAMED, "[0.6, 0.8]", "[0, 0]", "16:12: the zero vector has no direction"),
        (NAMED, "[0.6, 0.8]", "[0.6, 0.8, 1]", "16:12: expected 2 numbers, found 3"),
        (NAMED, "[0.6, 0.8]", "[0.6, nan]", "16:18: NaN is not a number"),
        (NAMED, "[0.6, 0.8]", "[-inf, 1]", "16:13: the number is infinite"),
        (NAMED, "[0.6, 0.8]", "[1e151, 1]", "16:13: 1e151 is larger than 1e150"),
        (NAMED, "[0.6, 0.8]", "[1e-160, 0]", "16:12: its length 1e-160 is not between 1e-150 and 1e150"),
        (NAMED, "sqrt(2)/4", "sqrt(2)/0", "15:26: division by zero"),
        (NAMED, "sqrt(2)/4", "sqt(2)/4", "15:19: unknown name \"sqt\""),
        (NAMED, "\"sqrt(2)/4\"", "true", "15:18: expected a number, found a boolean"),
        (NAMED, "radius = \"2/2\"", "radius = -1", "8:10: -1 is not positive"),
        (NAMED, "radius = \"2/2\"", "radius = 0", "8:10: 0 is not positive"),
        (NAMED, "radius = \"2/2\"", "radus = 1", "8:1: unknown key \"radus\" in [table]"),
        (NAMED, "radius  = 0", "radius = -0.5", "11:10: -0.5 is negative"),
        (NAMED, "radius  = 0", "radius = 1e-200", "11:10: 1e-200 is not between 1e-150 and 1e150"),
        (NAMED, "\"uniform-disk\"", "\"uniform\"", "12:11: unknown inertia \"uniform\""),
        (NAMED, "inertia", "gamma_squared = 1\ninertia", "13:1: [particle] has both \"inertia\" and \"gamma_squared\""),
        (NAMED, "\"stadium\"", "\"stadion\"", "6:8: unknown table \"stadion\""),
        (NAMED, "\"stadium\"", "\"slab\"", "6:8: the table \"slab\" is 3-dimensional"),
        (NAMED, "name = \"stadium\"", "", "5:1: [table] needs \"name\" or \"boundary\""),
        (NAMED, "\"no-slip\"", "\"noslip\"", "3:9: unknown law \"noslip\""),
        (NAMED, "law   = \"no-slip\"", "", "1:1: the scene needs \"law\" or \"rough\""),
        (NAMED, "title =", "rough = []\ntitle =", "4:1: the scene has both \"law\" and \"rough\""),
        (
            NAMED,
            "[particle]",
            "[ensemble]\ncount = 1\n[particle]",
            "16:3: the scene has both \"orbit\" and \"ensemble\"",
        ),
        (NAMED, "collisions = 1000", "collisions = 0", "21:14: 0 is not a whole number from 1 to 1e12"),
        (NAMED, "collisions = 1000", "collisions = 1.5", "21:14: 1.5 is not a whole number from 1 to 1e12"),
        (NAMED, "collisions = 1000", "collisions = 1\ntime = 2", "22:1: [run] has both \"collisions\" and \"time\""),
        (NAMED, "collisions = 1000", "", "20:1: [run] needs \"collisions\" or \"time\""),
        (NAMED, "[run]\ncollisions = 1000", "", "1:1: the scene lacks the key \"run\""),
        (NAMED, "\"csv\"", "\"xls\"", "24:14: unknown format \"xls\""),
        (NAMED, "\"orbit\"", "\"orbits\"", "25:15: unknown picture \"orbits\""),
        (NAMED, "\"velocity-portrait\"", "\"orbit\"", "25:24: the picture \"orbit\" is listed twice"),
        (NAMED, "angle    = 0", "angle = 0\nangle = 1", "19:1: duplicate key \"angle\""),
        (NAMED, "[table]", "[[table]]", "5:1: [table] must be a table, found an array"),
        (NAMED, "\"No-slip stadium\"", "3", "2:9: expected a string, found an integer"),
        (BOUNDARY, "turn = \"ccw\"", "turn = \"left\"", "8:46: unknown turn \"left\""),
        (BOUNDARY, ", turn = \"ccw\"", "", "8:3: an edge lacks the key \"turn\""),
        (BOUNDARY, "line_to = [1, -1]", "curve_to = [1, -1]", "7:3: an edge needs \"line_to\", \"arc_to\" or \"x\""),
        (BOUNDARY, "[1, 0] }\n", "[0, 0] }\n", "17:40: the zero vector has no direction"),
        (BOUNDARY, "1+0.2*cos(5*t)", "1+0.2*cos(5*x)", "21:32: unknown name \"x\""),
        (BOUNDARY, "[[-3, -2], [3, 2]]", "[[3, -2], [-3, 2]]", "24:46: a box is given by"),
        (BOUNDARY, "within = [[-3, -2], [3, 2]], ", "", "24:9: curve lacks the key \"within\""),
        (BOUNDARY, "name = \"capsule\", ", "", "26:9: shape lacks the key \"name\""),
        (BOUNDARY, "count = 1e5", "count = 1e13", "30:9: 10000000000000 is not a whole number from 1 to 1e12"),
        (BOUNDARY, "seed = 18446744073709551615", "seed = -1", "31:8: a seed is a whole number"),
        (BOUNDARY, "seed = 18446744073709551615", "seed = \"1/2\"", "31:8: a seed is a whole number"),
        (
            BOUNDARY,
            "seed = 18446744073709551615",
            "seed = \"2^53+1\"",
            "31:8: a seed given by a formula must be below 2^53",
        ),
        (BOUNDARY, "seed = 18446744073709551615", "seed = 1e20", "31:8: a seed is a whole number"),
        (SPATIAL, "[table]\n", "[table]\nlattice = [[1, 0, 0]]\n", "4:11: tables in space have no lattice"),
        (BOUNDARY, "\"canonical\"", "\"random\"", "32:10: unknown sample \"random\""),
        (BOUNDARY, "[[10, 0], [0, 10]]", "[]", "4:11: a lattice has 1 or 2 translations, not 0"),
        (BOUNDARY, "domain = \"outside\"", "domain = \"out\"", "13:53: unknown domain \"out\""),
        (SPATIAL, "[[1, 2, -3]]", "[[1, 2]]", "2:10: expected 3 numbers, found 2"),
        (SPATIAL, "[[1, 2, -3]]", "[[1, 2, -3], [-2, -4, 6]]", "2:22: this rough direction is parallel to the first"),
        (SPATIAL, "[[1, 2, -3]]", "[[1, 0, 0], [1, 1e-13, 0]]", "2:21: this rough direction is parallel to the first"),
        (SPATIAL, "[[1, 2, -3]]", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "2:9: 3 rough directions, but"),
        (SPATIAL, "dimension = 3", "dimension = 4", "4:13: the dimension must be 2 or 3"),
        (SPATIAL, "dimension = 3", "dimension = 2.5", "4:13: the dimension must be 2 or 3"),
        (SPATIAL, "rank = 1", "rank = 3", "6:56: 3 is not a whole number from 0 to 2"),
        (SPATIAL, "4 =", "floor =", "6:10: \"floor\" is not the number of a piece"),
        (SPATIAL, "4 =", "04 =", "6:10: \"04\" is not the number of a piece"),
        (SPATIAL, "4 =", "\"+4\" =", "6:10: \"+4\" is not the number of a piece"),
        (SPATIAL, "4 =", "5 =", "6:26: duplicate key \"5\""),
        (SPATIAL, "name = \"random\",", "name = \"random\", rough = [],", "6:49: law has both \"name\" and \"rough\""),
        (
            SPATIAL,
            "\"random\", rank = 1",
            "\"rough\", directions = []",
            "6:30: the law \"rough\" is given by its directions alone",
        ),
        (SPATIAL, "spin =", "angle = 0\nspin =", "12:1: unknown key \"angle\" in [[orbit]]"),
    ] {
        let errors = errors_of(valid, old, new);
        if !errors.iter().any(|e| e.starts_with(expected)) {
            wrong.push(format!("{new}\n  expected {expected}\n  found {errors:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn one_slip_gives_one_error() {
    for (valid, old, new) in [
        (NAMED, "velocity = [", "velocty = ["),
        (NAMED, "[table]", "[tabel]"),
        (NAMED, "position = [", "pos"),
        (NAMED, "\"stadium\"", "\"stadion\""),
        (NAMED, "name = \"stadium\"", "nam = \"stadium\""),
        (NAMED, "collisions = 1000", "collision = 1000"),
        (BOUNDARY, "loop =", "lop ="),
        (BOUNDARY, "[[table.boundary]]", "[[table.boundry]]"),
        (BOUNDARY, "{ line_to = [1, -1] },", "{ line_to = [1, -1] "),
        (SPATIAL, "dimension = 3", "dimensions = 3"),
        (SPATIAL, "dimension = 3", "dimension = true"),
        (SPATIAL, "dimension = 3", "dimension = 4"),
        (SPATIAL, "rough = [[1, 2, -3]]\n[table]\ndimension = 3", "dimension = 3\nrough = [[1, 2, -3]]\n[table]"),
        (SPATIAL, "[[1, 2, -3]]", "[1, 2, -3]"),
        (BOUNDARY, "circle =", "sphere ="),
        (SQUARE, "name = \"square\"", "circle = { center = [0, 0], radius = 1 }"),
    ] {
        let errors = errors_of(valid, old, new);
        assert_eq!(errors.len(), 1, "{new}: {errors:?}");
    }
}

#[test]
fn all_mistakes_are_reported_in_the_order_of_the_file() {
    let text =
        NAMED.replace("0.6", "nan").replace("\"no-slip\"", "\"noslip\"").replace("1000", "-1").replace("spin", "spn");
    let errors = parse(&text).unwrap_err();
    let lines: Vec<_> = errors.iter().map(|e| e.split(':').next().unwrap()).collect();
    assert_eq!(lines, ["3", "16", "17", "21"], "{errors:?}");
}
