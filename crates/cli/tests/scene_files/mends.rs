//! What is wrong is told how to mend it, and the mends work.

use super::{BOUNDARY, NAMED, SPATIAL, SQUARE, parse};
use billiards_cli::document::{Diagnostic, Source};
use billiards_cli::picture::{Needs, PICTURES};
use billiards_cli::scene::{LawKind, Request, SHAPES, Scene};
use billiards_cli::simulation::Simulation;

#[test]
fn mistakes_of_few_words_are_told_the_mend() {
    for (valid, old, new, mend) in [
        (NAMED, "[0.6, 0.8]", "[0.6, 0.8, 0]", "write 2 numbers, for instance [0, 1]"),
        (SPATIAL, "[0, 0.25, 0]", "0.25", "write 3 numbers, for instance [0, 0, 1]"),
        (NAMED, "[\"orbit\", \"velocity-portrait\"]", "\"orbit\"", "write [\"orbit\"]"),
        (BOUNDARY, "[[10, 0], [0, 10]]", "10", "write for instance [[1, 0], [0, 1]]"),
        (BOUNDARY, "[[10, 0], [0, 10]]", "[10, 0]", "write [[10, 0]]"),
        (BOUNDARY, "[[-3, -2], [3, 2]]", "3", "write for instance [[-3, -2], [3, 2]]"),
        (NAMED, "[\"orbit\", \"velocity-portrait\"]", "1", "write for instance [\"orbit\"]"),
        (SPATIAL, "[[1, 2, -3]]", "1", "write for instance [[1, 0, 0]]"),
        (SPATIAL, "name = \"box\"\n", "", "name = \"box\""),
        (SPATIAL, "rank = 1", "rank = 2.5", "write for instance 2"),
        (SPATIAL, "[table]\n", "[table]\nlattice = [[1, 0, 0]]\n", "leave it out"),
        (NAMED, "sqrt(2)/4", "sqrt(2)/0", "the divisor must not be 0"),
        (NAMED, "sqrt(2)/4", "sqrt(-1)", "its argument must not be negative"),
        (NAMED, "sqrt(2)/4", "ln(0)", "its argument must be positive"),
        (NAMED, "sqrt(2)/4", "exp(1000)", "the largest double is 1.8e308"),
        (NAMED, "sqrt(2)/4", "1e999", "the largest double is 1.8e308"),
        (NAMED, "collisions = 1000", "", "collisions = 1000"),
        (NAMED, "inertia = \"uniform-disk\"", "", "inertia = \"uniform-disk\""),
        (NAMED, "\"csv\"", "true", "known: csv, jsonl, npy"),
        (NAMED, "\"orbit\"", "1", "known: orbit, velocity-portrait, phase-portrait, velocity-counts, phase-counts"),
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
        (BOUNDARY, "circle =", "sphere =", "set dimension = 3 in [table]"),
        (BOUNDARY, "circle =", "mesh =", "set dimension = 3 in [table]"),
        (SPATIAL, "name = \"box\"", "boundary = [{ circle = {} }]", "set dimension = 2 in [table]"),
        (NAMED, "law   = \"no-slip\"", "dimension = 2\nlaw = \"no-slip\"", "\"dimension\" goes under [table]"),
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
fn lengths_in_place_of_a_list_are_told_lengths() {
    let boundary = |wall: &str| format!("[[table.boundary]]\n{wall}\n");
    let wall = |n: usize, wall: &str| format!("[table]\ndimension = {n}\n{}", boundary(wall));
    for (table, wrong, at) in [
        ("[table]\nname = \"rectangle\"\nsize = LENGTHS\n".into(), "2", "0.1, 0.2"),
        ("[table]\nname = \"box\"\ndimension = 3\nsize = LENGTHS\n".into(), "[1, 2]", "0.1, 0.2, 0.3"),
        (boundary("ellipse = { center = [0, 0], semi_axes = LENGTHS }"), "3", "0.1, 0.2"),
        (wall(2, "shape = { name = \"cuboid\", size = LENGTHS, domain = \"inside\" }"), "3", "0.1, 0.2"),
        (wall(3, "shape = { name = \"cuboid\", size = LENGTHS, domain = \"inside\" }"), "3", "0.1, 0.2, 0.3"),
    ] {
        let scene = |lengths: &str| {
            let table = table.replace("LENGTHS", lengths);
            format!(
                "law = \"specular\"\n{table}[[orbit]]\nposition = [{at}]\nvelocity = [{at}]\n[run]\ncollisions = 1\n"
            )
        };
        let help = help_with(&scene(wrong), "law", "law");
        let example = help.split_once("for instance ").map_or("", |(_, example)| example);
        let followed = parse(&scene(example)).unwrap_or_else(|e| panic!("{help}: {e:?}"));
        Simulation::new(followed).unwrap_or_else(|e| panic!("{help}: {e:?}"));
    }
}

#[test]
fn a_single_entry_is_told_its_brackets() {
    let table = "[table]\nname = \"stadium\"\nhalf_length = 1\nradius = \"2/2\"";
    let entry = "[table.boundary]\ncircle = { center = [0, 0], radius = 1 }";
    assert_eq!(help_with(NAMED, table, entry), "write [[table.boundary]]");
    let name = "[table]\nboundary = \"stadium\"";
    assert_eq!(help_with(NAMED, table, name), "write [[table.boundary]], and its keys on the lines below");
    let long = format!("table = {{ boundary = {{ circle = {{ center = [0, 0], radius = 1{} }} }} }}", " ".repeat(60));
    assert_eq!(help_with(SQUARE, "table = { name = \"square\" }", &long), "put it in brackets, [ and ]");
}

#[test]
fn a_contact_file_in_place_of_a_scene_is_told_its_command() {
    let contact = "dim = 2\nlaw = \"no-slip\"\ncontact_point = [0, 0]\nnormal = [0, 1]\nbodies = []\npre = []\n";
    assert_eq!(
        parse(contact).unwrap_err(),
        ["3:1: a scene has no contact point: this file describes a single collision"]
    );
    assert_eq!(help_with(contact, "dim", "dim"), "compute it: billiards collide CONTACT");
}

#[test]
fn a_scene_in_json_is_told_to_be_toml() {
    for json in ["{}", "{\"law\": \"no-slip\",\n \"table\": {\"name\": \"square\"}}"] {
        let errors = Scene::parse(&Source::new("x.json", json), &Request::default()).unwrap_err();
        let told = errors[0].help.as_deref().unwrap_or_else(|| panic!("{errors:?}"));
        assert!(told.starts_with("this file is read as TOML, not as JSON"), "{told}");
    }
}

#[test]
fn a_point_that_spins_is_told_both_mends() {
    let point = NAMED.replacen("\"uniform-disk\"", "\"point\"", 1);
    let help = "leave \"spin\" out, or give [particle] for instance inertia = \"uniform-disk\"";
    assert_eq!(help_with(&point, "radius  = 0", "radius = 0.01"), help);
    let help = "leave \"spin\" out, or give [particle] for instance inertia = \"uniform-ball\"";
    assert_eq!(help_with(SPATIAL, "\"2/5\"", "0"), help);
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
fn a_table_in_braces_is_shown_by_an_example_that_works() {
    let orbit = |at: &str| format!("[[orbit]]\nposition = [{at}]\nvelocity = [{at}]\n[run]\ncollisions = 1\n");
    for (n, kinds, at) in [
        (2, &["loop", "circle", "ellipse", "line", "ray", "chain", "curve", "shape"][..], "0.1, 0.2"),
        (3, &["sphere", "plane", "mesh", "shape"], "0.1, 0.2, 0.3"),
    ] {
        for kind in kinds {
            let lattice = if *kind == "chain" { "lattice = [[1, 0]]\n" } else { "" };
            let scene = |wall: &str| {
                format!(
                    "law = \"specular\"\n[table]\ndimension = {n}\n{lattice}[[table.boundary]]\n{wall}\n{}",
                    orbit(at)
                )
            };
            let wrong = Scene::parse(&Source::new("x.toml", &scene(&format!("{kind} = 5"))), &Request::default());
            let errors = wrong.expect_err(kind);
            assert_eq!(errors[0].what, format!("{kind} must be a table, found an integer"));
            let example = errors[0].help.as_ref().and_then(|help| help.strip_prefix("write for instance "));
            parse(&scene(example.unwrap())).unwrap_or_else(|e| panic!("{example:?}: {e:?}"));
        }
    }
    let help = help_with(SQUARE, "{ name = \"square\" }", "\"square\"");
    assert_eq!(help, "write [table] on a line of its own, and its keys below");
}

#[test]
fn the_nearest_whole_number_in_range_is_offered_for_one_that_is_not() {
    for (wrong, nearest) in [("0", "1"), ("1.5", "2"), ("1e13", "1000000000000")] {
        let text = NAMED.replace("collisions = 1000", &format!("collisions = {wrong}"));
        let errors = Scene::parse(&Source::new("x.toml", &text), &Request::default()).unwrap_err();
        assert_eq!(errors[0].help, Some(format!("write for instance {nearest}")), "{wrong}");
    }
}

#[test]
fn pictures_that_a_table_in_space_lacks_are_told_what_they_need() {
    for picture in PICTURES {
        let text = SPATIAL.to_string() + &format!("[output]\npictures = [\"{}\"]\n", picture.name);
        let built = Simulation::new(parse(&text).unwrap());
        match picture.needs {
            Needs::Paths => assert!(built.is_ok(), "{}", picture.name),
            Needs::Velocities | Needs::Reduced => {
                let needs = "needs the reduced phase space, which only planar tables have";
                assert_eq!(built.unwrap_err()[0].what, format!("the picture \"{}\" {needs}", picture.name));
            }
        }
    }
}
