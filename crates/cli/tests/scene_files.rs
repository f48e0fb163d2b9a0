//! Scene files: what is accepted, and what each mistake is called.

#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests claim exact values")]

use billiards_cli::document::{Diagnostic, Source};
use billiards_cli::scene::{
    Border, Curve, Domain, EdgePath, LawKind, Limit, RecordFormat, Request, SHAPES, Scene, Starts, TABLES, TableShape,
    Turn,
};
use billiards_cli::simulation::Simulation;
use proptest::prelude::*;

const NAMED: &str = r#"
title = "No-slip stadium"
law   = "no-slip"

[table]
name = "stadium"
half_length = 1
radius = "2/2"

[particle]
radius  = 0
inertia = "uniform-disk"

[[orbit]]
position = [0.1, "sqrt(2)/4"]
velocity = [0.6, 0.8]
spin     = 0.25
angle    = 0

[run]
collisions = 1000

[output]
collisions = "csv"
pictures   = ["orbit", "velocity-portrait"]
"#;

/// A scene with no more sections than it needs.
const SQUARE: &str = r#"
law = "specular"
table = { name = "square" }
orbit = [{ position = [0.25, 0.5], velocity = [1, 0.5] }]
run = { collisions = 1 }
"#;

const BOUNDARY: &str = r#"
law = "no-slip"
[table]
lattice = [[10, 0], [0, 10]]
[[table.boundary]]
loop = { from = [-1, -1], edges = [
  { line_to = [1, -1] },
  { arc_to = [1, 1], center = [1, 0], turn = "ccw" },
  { line_to = [-1, 1], law = "specular" },
  { arc_to = [-1, -1], center = [-1, 0], turn = "ccw" },
] }
[[table.boundary]]
circle = { center = [0, 0], radius = 0.25, domain = "outside" }
[[table.boundary]]
ellipse = { center = [0, 0], semi_axes = [2, 1], angle = 0, domain = "inside" }
[[table.boundary]]
line = { through = [0, 0], direction = [1, 0] }
[[table.boundary]]
ray = { from = [0, 0], direction = ["sin(pi/6)", "cos(pi/6)"], domain = "left" }
[[table.boundary]]
curve = { polar = "1+0.2*cos(5*t)" }
law = { name = "restitution", normal = 0.9, tangential = 0 }
[[table.boundary]]
curve = { implicit = "x^2/4+y^2-1", within = [[-3, -2], [3, 2]], domain = "outside" }
[[table.boundary]]
shape = { name = "capsule", from = [0, 0], to = [1, 0], radius = 0.1 }
[[table.boundary]]
outline = "island.svg"
[ensemble]
count = 1e5
seed = 18446744073709551615
sample = "canonical"
[run]
time = 250.0
"#;

const SPATIAL: &str = r#"
rough = [[1, 2, -3]]
[table]
dimension = 3
name = "box"
laws = { 4 = "specular", 5 = { name = "random", rank = 1 } }
[particle]
gamma_squared = "2/5"
[[orbit]]
position = [0.5, 0.5, 0.5]
velocity = [0.6, 0, 0.8]
spin = [0, 0.25, 0]
[run]
collisions = 10
"#;

fn parse(text: &str) -> Result<Scene, Vec<String>> {
    Scene::parse(&Source::new("x.toml", text), &Request::default()).map_err(|errors| {
        errors
            .iter()
            .map(|e| {
                let (line, column) = e.place.as_ref().map_or((0, 0), |p| (p.line, p.column));
                format!("{line}:{column}: {}", e.what)
            })
            .collect()
    })
}

/// The valid scene with one replacement, and the errors of that.
fn errors_of(valid: &str, old: &str, new: &str) -> Vec<String> {
    assert!(valid.contains(old), "{old}");
    parse(&valid.replacen(old, new, 1)).expect_err(new)
}

#[test]
fn a_named_table_and_an_orbit_are_read() {
    let scene = parse(NAMED).unwrap();
    assert_eq!(scene.title.as_deref(), Some("No-slip stadium"));
    assert_eq!((scene.dimension, scene.law.kind), (2, LawKind::NoSlip));
    let TableShape::Named { model, arguments, .. } = &scene.table.shape else { panic!() };
    assert_eq!((model.name, arguments.number("radius"), arguments.number("half_length")), ("stadium", 1.0, 1.0));
    assert_eq!((scene.particle.radius.value, scene.particle.gamma_squared.value), (0.0, 0.5));
    let Starts::Orbits(orbits) = &scene.starts else { panic!() };
    assert_eq!(orbits[0].position.value, [0.1, 2f64.sqrt() / 4.0]);
    assert_eq!((&orbits[0].velocity.value[..], &orbits[0].spin.value[..]), (&[0.6, 0.8][..], &[0.25][..]));
    assert!(matches!(scene.limit, Some(Limit::Collisions(n)) if n.value == 1000));
    assert_eq!(scene.output.collisions, Some(RecordFormat::Csv));
    assert_eq!(scene.output.pictures.iter().map(|p| p.0).collect::<Vec<_>>(), ["orbit", "velocity-portrait"]);
}

#[test]
fn values_remember_where_they_stand() {
    let scene = parse(NAMED).unwrap();
    let Starts::Orbits(orbits) = &scene.starts else { panic!() };
    let place = scene.source.diagnostic(orbits[0].position.span, "outside the table").place.unwrap();
    assert_eq!((place.line, place.column), (15, 12));
    assert_eq!(scene.source.slice(orbits[0].velocity.span), "[0.6, 0.8]");
}

#[test]
fn every_kind_of_boundary_entry_is_read() {
    let scene = parse(BOUNDARY).unwrap();
    let TableShape::Boundary(entries) = &scene.table.shape else { panic!() };
    assert_eq!((entries.len(), scene.table.lattice.len()), (9, 2));
    let Border::Loop { edges, .. } = &entries[0].border else { panic!() };
    let EdgePath::Arc { turn, .. } = edges[1].path else { panic!() };
    assert_eq!(turn, Turn::CounterClockwise);
    assert_eq!(edges[2].law.as_ref().unwrap().kind, LawKind::Specular);
    assert_eq!(entries[5].law.as_ref().unwrap().kind, LawKind::Restitution { normal: 0.9, tangential: 0.0 });
    let Border::Curve { curve: Curve::Polar { radius, .. }, domain: Domain::Inside, .. } = &entries[5].border else {
        panic!()
    };
    assert_eq!(radius.evaluate(&[0.0]), 1.2);
    let Border::Curve { curve: Curve::Implicit { function, within }, domain: Domain::Outside, .. } = &entries[6].border
    else {
        panic!()
    };
    assert_eq!((function.evaluate(&[2.0, 1.0]), within.value), (1.0, [[-3.0, -2.0], [3.0, 2.0]]));
    let Border::Shape { lengths, domain: Domain::Outside, .. } = &entries[7].border else { panic!() };
    assert!(lengths.contains(&0.1), "{lengths:?}");
    let Starts::Ensemble(ensemble) = &scene.starts else { panic!() };
    assert_eq!((ensemble.count.value, ensemble.seed, ensemble.sample.value), (100_000, u64::MAX, "canonical"));
    assert!(matches!(scene.limit, Some(Limit::Time(t)) if t.value == 250.0));
}

#[test]
fn a_scene_in_space_is_read() {
    let scene = parse(SPATIAL).unwrap();
    assert_eq!((scene.dimension, scene.law.kind), (3, LawKind::Rough(vec![vec![1.0, 2.0, -3.0]])));
    assert_eq!(scene.particle.gamma_squared.value, 0.4);
    assert_eq!(scene.table.laws[1].law, LawKind::Random { rank: 1, seed: 0 });
    let Starts::Orbits(orbits) = &scene.starts else { panic!() };
    assert_eq!(orbits[0].spin.value, [0.0, 0.25, 0.0]);
}

#[test]
fn every_built_in_table_is_read_with_its_required_parameters_alone() {
    for model in TABLES.iter() {
        let extra = match model.name {
            "wedge" => "angle = \"pi/3\"",
            "triangle" => "vertices = [[0, 0], [1, 0], [0, 1]]",
            "polygon" => "sides = 7",
            "perturbed-polygon" => "amount = 0.01",
            "lorentz" => "radius = 0.4",
            "channel" => "sagitta = 0.1",
            _ => "",
        };
        let (n, zeros) = (model.dimension, ["0"].repeat(model.dimension).join(", "));
        let text = format!(
            "law = \"specular\"\ntable = {{ dimension = {n}, name = \"{}\", {extra} }}\n\
             orbit = [{{ position = [{zeros}], velocity = [{}] }}]\nrun = {{ time = 1 }}",
            model.name,
            zeros.replacen('0', "1", 1)
        );
        parse(&text).unwrap_or_else(|e| panic!("{}: {e:?}", model.name));
    }
}

#[test]
fn the_command_line_takes_the_place_of_law_and_limit() {
    let bare = NAMED.replace("law   = \"no-slip\"", "").replace("[run]\ncollisions = 1000", "");
    let source = Source::new("x.toml", &bare);
    assert_eq!(Scene::parse(&source, &Request::default()).unwrap_err().len(), 2);
    let request = Request { law: Some(LawKind::Specular), collisions: Some(7), needs_limit: true };
    let scene = Scene::parse(&source, &request).unwrap();
    assert_eq!(scene.law.kind, LawKind::Specular);
    assert!(matches!(scene.limit, Some(Limit::Collisions(n)) if n.value == 7));
    let request = Request { law: Some(LawKind::Specular), ..Request { needs_limit: false, ..Request::default() } };
    assert!(Scene::parse(&source, &request).unwrap().limit.is_none());
    let replaced = Request { collisions: Some(7), ..Request::default() };
    let scene = Scene::parse(&Source::new("x.toml", NAMED), &replaced).unwrap();
    assert!(matches!(scene.limit, Some(Limit::Collisions(n)) if n.value == 7));
}

#[test]
fn mistakes_of_few_words_are_told_the_mend() {
    for (valid, old, new, mend) in [
        (NAMED, "sqrt(2)/4", "sqrt(2)/0", "the divisor must not be 0"),
        (NAMED, "sqrt(2)/4", "sqrt(-1)", "its argument must not be negative"),
        (NAMED, "sqrt(2)/4", "ln(0)", "its argument must be positive"),
        (NAMED, "sqrt(2)/4", "exp(1000)", "doubles end at 1.8e308"),
        (NAMED, "sqrt(2)/4", "1e999", "doubles end at 1.8e308"),
        (NAMED, "collisions = 1000", "", "collisions = 1000"),
        (NAMED, "inertia = \"uniform-disk\"", "", "inertia = \"uniform-disk\""),
        (NAMED, "\"csv\"", "true", "known: csv, jsonl, npy"),
        (NAMED, "\"orbit\"", "1", "known: orbit, velocity-portrait, phase-portrait"),
        (NAMED, "\"stadium\"", "1", "known: "),
        (NAMED, "[0.6, 0.8]", "[0, 0]", "write for instance [1, 0]"),
        (NAMED, "[0.6, 0.8]", "[1e-160, 0]", "make it longer"),
        (NAMED, "radius  = 0", "radius = 1e-151", "write a larger number"),
        (NAMED, "name = \"stadium\"", "", "name = \"stadium\""),
        (NAMED, "law   = \"no-slip\"", "", "law = \"no-slip\""),
        (BOUNDARY, "line_to = [1, -1]", "curve_to = [1, -1]", "line_to = [1, 0]"),
        (NAMED, "\"no-slip\"", "3", "\"no-slip\", or { name = \"restitution\""),
        (NAMED, "\"no-slip\"", "[\"no-slip\"]", "\"no-slip\", or { name = \"restitution\""),
        (NAMED, "\"no-slip\"", "{ name = \"specular\", foo = 1 }", "known keys: name, rough"),
        (NAMED, "law   = \"no-slip\"", "rough = [1, 0]", "write [[1, 0]]"),
        (SPATIAL, "[[1, 2, -3]]", "[1, \"2\", -3]", "write [[1, \"2\", -3]]"),
        (NAMED, "sqrt(2)/4", "log(2)", "write ln(x)"),
        (NAMED, "sqrt(2)/4", "sqroot(2)", "known: sqrt, abs"),
        (NAMED, "sqrt(2)/4", "two", "atan2, pi"),
        (BOUNDARY, "1+0.2*cos(5*t)", "1+0.2*cos(5*x)", "atan2, pi, t"),
        (BOUNDARY, "circle =", "sphere =", "say dimension = 3 in [table]"),
        (BOUNDARY, "circle =", "mesh =", "say dimension = 3 in [table]"),
        (SPATIAL, "name = \"box\"", "boundary = [{ circle = {} }]", "say dimension = 2 in [table]"),
    ] {
        assert!(valid.contains(old), "{old}");
        let source = Source::new("x.toml", &valid.replacen(old, new, 1));
        let errors = Scene::parse(&source, &Request::default()).unwrap_err();
        let mends = |error: &Diagnostic| error.help.as_ref().is_some_and(|help| help.contains(mend));
        assert!(errors.iter().any(mends), "{new}: {mend} expected in {errors:?}");
        assert!(
            errors.iter().all(|error| error.help.as_deref() != Some("known keys: name, rough, name")),
            "{errors:?}"
        );
    }
}

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
        (BOUNDARY, "line_to = [1, -1]", "curve_to = [1, -1]", "7:3: an edge needs \"line_to\" or \"arc_to\""),
        (BOUNDARY, "[1, 0] }\n", "[0, 0] }\n", "17:40: the zero vector has no direction"),
        (BOUNDARY, "1+0.2*cos(5*t)", "1+0.2*cos(5*x)", "21:32: unknown name \"x\""),
        (BOUNDARY, "[[-3, -2], [3, 2]]", "[[3, -2], [-3, 2]]", "24:46: a box is given by"),
        (BOUNDARY, "within = [[-3, -2], [3, 2]], ", "", "24:9: curve lacks the key \"within\""),
        (BOUNDARY, "name = \"capsule\", ", "", "26:9: shape lacks the key \"name\""),
        (BOUNDARY, "count = 1e5", "count = 1e13", "30:9: 10000000000000 is not a whole number from 1 to 1e12"),
        (BOUNDARY, "seed = 18446744073709551615", "seed = -1", "31:8: a seed is a whole number"),
        (BOUNDARY, "seed = 18446744073709551615", "seed = \"1/2\"", "31:8: a seed is a whole number"),
        (BOUNDARY, "seed = 18446744073709551615", "seed = 1e20", "31:8: a seed is a whole number"),
        (SPATIAL, "[table]\n", "[table]\nlattice = [[1, 0, 0]]\n", "4:11: tables in space have no lattice"),
        (BOUNDARY, "\"canonical\"", "\"random\"", "32:10: unknown sample \"random\""),
        (BOUNDARY, "[[10, 0], [0, 10]]", "[]", "4:11: a lattice has 1 or 2 translations, not 0"),
        (BOUNDARY, "domain = \"outside\"", "domain = \"out\"", "13:53: unknown domain \"out\""),
        (SPATIAL, "[[1, 2, -3]]", "[[1, 2]]", "2:10: expected 3 numbers, found 2"),
        (SPATIAL, "[[1, 2, -3]]", "[[1, 2, -3], [-2, -4, 6]]", "2:22: this rough direction is parallel to the first"),
        (SPATIAL, "[[1, 2, -3]]", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "2:9: 3 rough directions, but"),
        (SPATIAL, "dimension = 3", "dimension = 4", "4:13: the dimension is 2 or 3"),
        (SPATIAL, "rank = 1", "rank = 3", "6:56: in dimension 3 the rank is at most 2"),
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
        (SPATIAL, "[[1, 2, -3]]", "[1, 2, -3]"),
        (BOUNDARY, "circle =", "sphere ="),
        (SQUARE, "name = \"square\"", "circle = { center = [0, 0], radius = 1 }"),
    ] {
        let errors = errors_of(valid, old, new);
        assert_eq!(errors.len(), 1, "{new}: {errors:?}");
    }
}

#[test]
fn a_seed_may_be_a_text_like_all_numbers() {
    for (seed, expected) in [("\"18446744073709551615\"", u64::MAX), ("\"2^10\"", 1024), ("1e3", 1000), ("0", 0)] {
        let text = BOUNDARY.replace("seed = 18446744073709551615", &format!("seed = {seed}"));
        let scene = Scene::parse(&Source::new("x.toml", &text), &Request::default()).unwrap();
        let Starts::Ensemble(ensemble) = &scene.starts else { panic!("an ensemble") };
        assert_eq!(ensemble.seed, expected, "{seed}");
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

#[test]
fn mistakes_are_shown_with_caret_and_help() {
    let text = NAMED.replace("velocity = [", "velocty = [");
    let errors = Scene::parse(&Source::new("scenes/x.toml", &text), &Request::default()).unwrap_err();
    assert_eq!(
        errors[0].to_string(),
        "scenes/x.toml:16:1: error: unknown key \"velocty\" in [[orbit]]\n   16 | velocty = [0.6, 0.8]\n      | ^^^^^^^\n\
         help: did you mean \"velocity\"?"
    );
}

/// The valid scene with one replacement, and what that is told to do.
fn help_with(valid: &str, old: &str, new: &str) -> String {
    assert!(valid.contains(old), "{old}");
    let text = valid.replacen(old, new, 1);
    let errors = Scene::parse(&Source::new("x.toml", &text), &Request::default()).expect_err(new);
    errors[0].help.clone().unwrap_or_else(|| panic!("{new}: no help with {errors:?}"))
}

#[test]
fn laws_with_parameters_work_where_they_are_told_to_go() {
    for (valid, old) in [(SPATIAL, "\"specular\""), (NAMED, "\"no-slip\"")] {
        for law in ["rough", "random", "restitution"] {
            let word = format!("\"{law}\"");
            let help = help_with(valid, old, &word);
            let table = help.strip_prefix("write ").and_then(|help| help.strip_suffix(&format!(" in place of {word}")));
            parse(&valid.replacen(old, table.expect("a table"), 1)).unwrap_or_else(|e| panic!("{help}: {e:?}"));
        }
    }
    assert_eq!(help_with(SPATIAL, "4 =", "04 ="), "write 4");
    let rough = parse(&SPATIAL.replacen("\"specular\"", "{ rough = [[1, 0, 0]] }", 1)).unwrap();
    assert_eq!(rough.table.laws[0].law, LawKind::Rough(vec![vec![1.0, 0.0, 0.0]]));
    let all = parse(&NAMED.replacen("\"no-slip\"", "{ rough = [[1, 0]] }", 1)).unwrap();
    assert_eq!(all.law.kind, LawKind::Rough(vec![vec![1.0, 0.0]]));
}

#[test]
fn the_law_rough_is_told_for_the_plane_and_for_space() {
    let help = "rough".parse::<LawKind>().unwrap_err();
    for (valid, old, law) in
        [(NAMED, "law   = \"no-slip\"", "rough = [[1, 0]]"), (SPATIAL, "rough = [[1, 2, -3]]", "rough = [[1, 2, -3]]")]
    {
        assert!(help.contains(law), "{help}");
        parse(&valid.replacen(old, law, 1)).unwrap();
    }
}

#[test]
fn examples_for_missing_parameters_make_a_shape() {
    for model in SHAPES.iter().filter(|model| model.name != "compound") {
        let n = model.dimension;
        let far = ["50"].repeat(n).join(", ");
        // in the plane the outside of a polygon is a table only within something else
        let around = match (n, model.name) {
            (3, _) | (_, "half-space") => "",
            _ => "[[table.boundary]]\ncircle = { center = [0, 0], radius = 100 }\n",
        };
        let scene = |more: &str| {
            format!(
                "law = \"specular\"\n[table]\ndimension = {n}\n{around}[[table.boundary]]\n\
                 shape = {{ name = \"{}\"{more} }}\n[[orbit]]\nposition = [{far}]\nvelocity = [{far}]\n[run]\ntime = 1\n",
                model.name
            )
        };
        let errors = Scene::parse(&Source::new("x.toml", &scene("")), &Request::default()).expect_err(model.name);
        let examples = errors.iter().map(|e| e.help.as_ref()?.strip_prefix("write for instance "));
        let examples: Vec<&str> = examples.collect::<Option<_>>().unwrap_or_else(|| panic!("{errors:?}"));
        let followed = parse(&scene(&format!(", {}", examples.join(", "))));
        let followed = followed.unwrap_or_else(|e| panic!("{}: {examples:?}: {e:?}", model.name));
        if model.name == "heightfield" {
            continue; // a graph bounds a table only with other pieces
        }
        Simulation::new(followed).unwrap_or_else(|e| panic!("{}: {examples:?}: {e:?}", model.name));
    }
}

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
        ("1-cos(t)+0", "r(φ) must be positive and finite at every angle; near φ = 0.0008 it may be -1e-323"),
    ] {
        let (what, help) = polar(formula);
        assert!(what.ends_with(expected), "{formula}: {what}");
        assert_eq!(help.contains("period 2π"), expected.contains("r(2π)"), "{formula}: {help}");
    }
    // the radius falls by at most √3/2 over a sector of 2π/4096, and it is that in the middle of one of the first two below 0
    let (what, _) = polar("0.5+cos(t)");
    let least: f64 = what.rsplit(' ').next().and_then(|x| x.parse().ok()).expect("a number");
    assert!((-0.0015..=0.0).contains(&least), "{what}");
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
    assert!(model.summary.starts_with("a graph") && model.summary.contains("its ends need rays"), "{}", model.summary);
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
fn a_key_in_the_wrong_place_is_sent_to_its_own() {
    for (text, key, help) in [
        (NAMED.replace("[particle]", "spin = 1\n[particle]"), "spin", "\"spin\" goes under [[orbit]]"),
        (NAMED.replace("title =", "pictures = []\ntitle ="), "pictures", "\"pictures\" goes under [output]"),
        (NAMED.replace("[output]", "purpose = 1\n[output]"), "purpose", "known keys: collisions, time"),
        // parameters of tables may have the names of other keys, and sections need not be there
        (NAMED.replace("title =", "radius = 0.1\ntitle ="), "radius", "\"radius\" goes under [table] or [particle]"),
        (format!("radius = 0.1\n{SQUARE}"), "radius", "\"radius\" goes under [particle]"),
        (format!("seed = 1\n{SQUARE}"), "seed", "\"seed\" goes under [ensemble]"),
        (format!("{SQUARE}count = 1\n"), "count", "\"count\" goes under [ensemble]"),
        (format!("{SQUARE}sample = \"grid\"\n"), "sample", "\"sample\" goes under [ensemble]"),
        (format!("{SQUARE}speed = 1\n"), "speed", "\"speed\" goes under [ensemble]"),
        (format!("laws = {{ 0 = \"specular\" }}\n{SQUARE}"), "laws", "\"laws\" goes under [table]"),
        (format!("circle = {{ radius = 1 }}\n{SQUARE}"), "circle", "\"circle\" goes under [[table.boundary]]"),
        (format!("{NAMED}title = \"x\"\n"), "title", "\"title\" goes at the top of the file, before all sections"),
        (
            NAMED.replace("[table]", "[table]\nlaw = \"specular\""),
            "law",
            "\"law\" goes at the top of the file, before all sections",
        ),
        (format!("pictures = []\n{SQUARE}"), "pictures", "\"pictures\" goes under [output]"),
        (
            format!("radius = 0.1\n{}", SQUARE.replace("square", "stadium")),
            "radius",
            "\"radius\" goes under [table] or [particle]",
        ),
    ] {
        let errors = Scene::parse(&Source::new("x.toml", &text), &Request::default()).unwrap_err();
        assert!(errors.len() == 1 && errors[0].what.contains(key), "{errors:?}");
        assert_eq!(errors[0].help.as_deref(), Some(help));
    }
}

#[test]
fn columns_begin_after_a_byte_order_mark() {
    let text = format!("\u{feff}xaw = 1{SQUARE}");
    let errors = Scene::parse(&Source::new("x.toml", &text), &Request::default()).unwrap_err();
    let shown = errors[0].to_string();
    assert!(shown.starts_with("x.toml:1:1: error: unknown key \"xaw\""), "{shown}");
    assert!(shown.contains("\n    1 | xaw = 1\n      | ^^^\n"), "{shown}");
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
        assert!(errors[0].what.contains(" is read from a file ."), "{errors:?}");
    }
}

#[test]
fn a_section_without_keys_is_as_good_as_none() {
    let scene = format!("{}[run]\n[output]\n", SQUARE.replace("run = { collisions = 1 }\n", ""));
    let parse = |needs_limit, collisions| {
        Scene::parse(&Source::new("x.toml", &scene), &Request { needs_limit, collisions, ..Request::default() })
    };
    assert_eq!(parse(false, None).unwrap().limit, None);
    assert!(parse(true, Some(5)).unwrap().limit.is_some());
    let errors = parse(true, None).unwrap_err();
    assert_eq!(errors[0].what, "[run] needs \"collisions\" or \"time\"");
}

#[test]
fn dotted_keys_and_brackets_nested_without_end_are_refused() {
    let n = 200_000;
    for text in [
        format!("{}b = 1", "a.".repeat(n)),
        format!("[{}a]", "a.".repeat(n)),
        format!("a = {}", "[".repeat(n)),
        format!("a = {}1{}", "[".repeat(n), "]".repeat(n)),
        format!("a = {}", "{ b = ".repeat(n)),
        format!("law = \"{}\"", "x".repeat(n)),
    ] {
        assert!(parse(&text).is_err());
    }
}

/// One change to a text: replace `length` bytes at a place by something else.
fn mutate(text: &str, changes: &[(usize, usize, String)]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (at, length, new) in changes {
        let at = at % (bytes.len() + 1);
        let end = (at + length).min(bytes.len());
        bytes.splice(at..end, new.bytes());
    }
    bytes
}

proptest! {
    #[test]
    fn no_mutation_of_a_valid_scene_makes_the_reader_panic(
        which in 0..3usize,
        changes in proptest::collection::vec(
            (any::<usize>(), 0..12usize, prop_oneof![
                any::<String>(),
                "[\\[\\]{}=,.\"'\\n #a-z0-9\\-]{0,6}",
                proptest::sample::select(vec!["nan", "inf", "1e999", "-1", "[]", "{}", "[[", "]]", "\"\"", "true", "'''", "1979-05-27",
                    "law", "rough", "loop", "edges", "= 0", "0x10", "9999999999999999999999999999999999999999999"])
                    .prop_map(String::from),
            ]),
            1..4,
        ),
    ) {
        let bytes = mutate([NAMED, BOUNDARY, SPATIAL][which], &changes);
        if let Ok(source) = Source::from_bytes("x.toml", &bytes)
            && let Err(errors) = Scene::parse(&source, &Request::default())
        {
            prop_assert!(!errors.is_empty());
            for error in errors {
                let _ = error.to_string();
            }
        }
    }

    #[test]
    fn no_bytes_make_the_reader_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        if let Ok(source) = Source::from_bytes("x.toml", &bytes) {
            prop_assert!(Scene::parse(&source, &Request::default()).is_err());
        }
    }
}
