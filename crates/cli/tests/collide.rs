//! `billiards collide`: the certified collisions through the command line, and what each mistake is called.

#![allow(clippy::unwrap_used, reason = "a test that cannot read its data has failed")]

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use billiards_cli::commands::collide;
use billiards_cli::document::Source;
use proptest::prelude::*;
use serde_json::{Value, json};

/// The files give 45 digits; the numbers in a case are of order 1 to 2²⁰, so 1e-12 leaves a factor of 1e3 over rounding.
const TOLERANCE: f64 = 1e-12;

const TOML: &str = r#"
dim = 2
law = "no-slip"
contact_point = [0, 0]
normal = [0, 3]
bodies = [{ mass = 1, position = [0, 1], inertia = "1/2" }, { mass = "inf" }]
pre = [{ v = [0, -1], w = 3 }, { v = [0, 0], w = 0 }]
"#;

const SPATIAL: &str = r"
dim = 3
rough = [[1, 0, 0]]
contact_point = [0, 0, 0]
normal = [0, 0, 1]
[[bodies]]
mass = 2
position = [0, 0, 1]
inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
[[bodies]]
mass = 3
position = [0, 0.5, -1]
S = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
[[pre]]
v = [0, 0, -1]
w = [1, 2, 3]
[[pre]]
v = [0, 0, 0]
w = [0, 0, 0]
";

/// A folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("billiards-collide-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Exit status, standard output and standard error of `billiards collide`.
fn execute(file: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("billiards").unwrap().arg("collide").arg(file).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn collide_text(name: &str, text: &str, arguments: &[&str]) -> (i32, String, String) {
    let folder = folder(name);
    let file = folder.join("contact.toml");
    std::fs::write(&file, text).unwrap();
    let done = execute(&file, arguments);
    std::fs::remove_dir_all(folder).unwrap();
    done
}

/// All numbers of a value, in order; a certified number counts by its decimals.
fn numbers(value: &Value, into: &mut Vec<f64>) {
    match value {
        Value::Number(x) => into.push(x.as_f64().unwrap()),
        Value::Object(entries) => numbers(&entries["dec"], into),
        Value::String(text) => into.push(text.parse().unwrap()),
        Value::Array(items) => items.iter().for_each(|item| numbers(item, into)),
        other => panic!("{other}"),
    }
}

fn distance(found: &Value, expected: &Value) -> f64 {
    let (mut a, mut b) = (vec![], vec![]);
    numbers(found, &mut a);
    numbers(expected, &mut b);
    assert_eq!(a.len(), b.len(), "{found} {expected}");
    let norm = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(&b).map(|(a, b)| a - b)) / norm(&mut b.iter().copied()).max(f64::MIN_POSITIVE)
}

fn matches_every_certified_number(dimension: usize, expected_count: usize) {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/collisions");
    let text = std::fs::read_to_string(data.join(format!("cases_{dimension}d.json"))).unwrap();
    let cases: Value = serde_json::from_str(&text).unwrap();
    let folder = folder(&format!("certified-{dimension}"));
    let mut count = 0;
    for case in cases["cases"].as_array().unwrap() {
        for result in case["results"].as_array().unwrap() {
            let mut contact = case.clone();
            contact["rough"] = result["rough"].clone();
            let file = folder.join("contact.json");
            std::fs::write(&file, contact.to_string()).unwrap();
            let (status, out, err) = execute(&file, &["--json"]);
            assert_eq!(status, 0, "{err}");
            let found: Value = serde_json::from_str(&out).unwrap();
            assert_eq!((&found["k"], &found["strict"]), (&result["k"], &json!(true)), "{}", case["id"]);
            let mut compared = vec![
                distance(&found["impulse_on_body_1"], &result["impulse_on_body_1"]),
                distance(&found["u_minus"], &result["u_minus"]),
                distance(&found["u_plus"], &result["u_plus"]),
                distance(&found["energy_before"], &case["energy"]),
                distance(&found["energy_after"], &case["energy"]),
            ];
            for i in 0..2 {
                compared.push(distance(&found["post"][i]["v"], &result["post"][i]["v"]));
                compared.push(distance(&found["post"][i]["w"], &result["post"][i]["w"]));
            }
            assert!(compared.iter().all(|x| *x <= TOLERANCE), "{} k = {}: {compared:?}", case["id"], result["k"]);
            count += 1;
        }
    }
    std::fs::remove_dir_all(folder).unwrap();
    assert_eq!(count, expected_count, "every k from 0 to N-1 of every case");
}

#[test]
fn planar_collisions_match_the_certified_ones() {
    matches_every_certified_number(2, 24);
}

#[test]
fn spatial_collisions_match_the_certified_ones() {
    matches_every_certified_number(3, 36);
}

#[test]
fn collisions_in_four_dimensions_match_the_certified_ones() {
    matches_every_certified_number(4, 20);
}

#[test]
fn collisions_in_five_dimensions_match_the_certified_ones() {
    matches_every_certified_number(5, 15);
}

#[test]
fn a_dropped_spinning_disk_is_sent_sideways() {
    // v0 = γ ω with γ² = 1/2, c = 1/3, s = 2√2/3: ω⁺ = −ω/3, and v⁺ = s γ ω t with t = J ν = (−1, 0), so (−2, 1) and −1.
    let (status, out, _) = collide_text("drop", TOML, &["--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(status, 0);
    assert!(distance(&found["post"][0]["v"], &json!([-2.0, 1.0])) < 1e-15, "{found}");
    assert!(distance(&found["post"][0]["w"], &json!(-1.0)) < 1e-15, "{found}");
    let (status, out, err) = collide_text("drop-table", TOML, &[]);
    assert_eq!((status, err.as_str()), (0, ""));
    assert!(out.contains("law: no-slip (k = 1)") && out.contains("yes, every axiom holds"), "{out}");
}

#[test]
fn the_largest_defect_is_told_as_it_is() {
    let contact = "dim = 3\nrough = [[1, 2, -3]]\ncontact_point = [0, 0, 0]\nnormal = [0, 0, 1]\nbodies = [\
        { mass = 1, position = [0, 0.2, 1], inertia = [[0.4, 0, 0], [0, 0.4, 0], [0, 0, 0.4]] }, \
        { mass = 3, position = [0.1, 0.3, -2], S = [[1, 0, 0], [0, 2, 0], [0, 0, 3]] }]\n\
        pre = [{ v = [0.3, 1, -1], w = [0.3, 1, 2] }, { v = [0, 0, 1], w = [0, 0.1, 0] }]\n";
    let (_, json, _) = collide_text("defects", contact, &["--json"]);
    let (_, text, _) = collide_text("defects-table", contact, &[]);
    let found: Value = serde_json::from_str(&json).unwrap();
    let defects = found["defects"].as_object().unwrap().iter().map(|(name, x)| (name, x.as_f64().unwrap()));
    let (name, largest) = defects.max_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap();
    assert!(largest > 0.0 && text.contains(&format!("the largest defect is {largest:.1e} ({name})")), "{json}{text}");
}

#[test]
fn a_body_that_stays_where_it_is_has_infinite_mass_however_that_is_written() {
    let expected = collide_text("fixed", TOML, &["--json"]);
    for (k, mass) in ["inf", "\"infinity\""].iter().enumerate() {
        let text = TOML.replace("\"inf\"", mass);
        assert_eq!(collide_text(&format!("fixed-{k}"), &text, &["--json"]), expected, "{mass}");
    }
}

#[test]
fn nothing_is_printed_as_minus_zero() {
    // the impulse on the wall is the opposite of (0, −2)
    let bodies = "[{ mass = \"inf\" }, { mass = 1, position = [0, -1], inertia = \"1/2\" }]";
    let text = format!(
        "dim = 2\nlaw = \"no-slip\"\ncontact_point = [0, 0]\nnormal = [0, 1]\nbodies = {bodies}\n\
         pre = [{{ v = [0, 0], w = 0 }}, {{ v = [0, 1], w = 0 }}]\n"
    );
    let (status, out, _) = collide_text("zero", &text, &[]);
    assert!(status == 0 && out.contains("(0, 2)") && !out.contains("-0"), "{out}");
}

#[test]
fn a_law_that_loses_energy_is_not_strict() {
    let text = TOML.replace("\"no-slip\"", "{ name = \"restitution\", normal = 0.5, tangential = 0 }");
    let (status, out, _) = collide_text("restitution", &text, &[]);
    assert!(status == 0 && out.contains("no, it breaks: energy"), "{out}");
    let (_, out, _) = collide_text("restitution-json", &text, &["--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&found["strict"], &found["k"]), (&json!(false), &Value::Null));
}

#[test]
fn rough_directions_may_stand_as_a_law() {
    let beside = collide_text("beside", SPATIAL, &["--json"]);
    let within = SPATIAL.replace("rough = [[1, 0, 0]]", "law = { rough = [[1, 0, 0]] }");
    assert_eq!(collide_text("within", &within, &["--json"]), beside);
    // directions that agree in their first three coordinates are not parallel
    let unit = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let body = |x: f64| json!({ "mass": 1, "position": [x, 0, 0, 0], "S": unit });
    let still = json!({ "v": [0, 0, 0, 0], "w": vec![vec![0; 4]; 4] });
    let contact = json!({
        "dim": 4, "law": { "rough": [[0, 1, 0, 0], [0, 1, 0, 1]] }, "contact_point": [0, 0, 0, 0], "normal": [1, 0, 0, 0],
        "bodies": [body(1.0), body(-1.0)], "pre": [{ "v": [-1, 0, 0, 0], "w": still["w"] }, still],
    });
    let (status, out, err) = collide_text("four", &contact.to_string(), &["--json"]);
    assert!(status == 0 && out.contains("\"k\": 2"), "{out}{err}");
}

#[test]
fn spins_beyond_space_are_told_by_their_entries() {
    let unit = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let body = |x: f64| json!({ "mass": 1, "position": [x, 0, 0, 0], "S": unit });
    // of body 1, axis 1 turns towards axis 2, and axis 3 towards axis 4 twice as fast
    let spin = json!([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, -2], [0, 0, 2, 0]]);
    let contact = json!({
        "dim": 4, "law": "specular", "contact_point": [0, 0, 0, 0], "normal": [1, 0, 0, 0], "bodies": [body(0.0), body(0.0)],
        "pre": [{ "v": [-1, 0, 0, 0], "w": spin }, { "v": [0, 0, 0, 0], "w": vec![vec![0; 4]; 4] }],
    });
    let (_, out, err) = collide_text("entries", &contact.to_string(), &[]);
    assert!(out.contains("(1, 0, 0, 0, 0, 2)"), "{out}{err}");
    assert!(
        out.contains("entries 21, 31, 32, 41, 42, 43 (row, column) of the matrix; 21 turns axis 1 towards axis 2"),
        "{out}"
    );
    let (_, out, _) = collide_text("entries", &contact.to_string(), &["--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    let angular = &found["momenta_before"]["angular"];
    assert!(distance(angular, &json!([2, 0, 0, 0, 0, 4])) < 1e-14, "{angular}");
}

#[test]
fn a_law_without_friction_needs_no_inertia_to_speak_of() {
    let slim = TOML.replace("\"1/2\"", "1e-20").replace("v = [0, -1]", "v = [1, -1.5]");
    for law in ["\"specular\"", "{ name = \"restitution\", normal = 1, tangential = -1 }"] {
        let (status, out, err) = collide_text("slim", &slim.replace("\"no-slip\"", law), &["--json"]);
        assert_eq!((status, err.as_str()), (0, ""), "{law}");
        let found: Value = serde_json::from_str(&out).unwrap();
        assert_eq!((&found["post"][0]["v"], &found["strict"]), (&json!([1.0, 1.5]), &json!(true)), "{law}");
    }
}

#[test]
fn free_bodies_keep_their_momenta() {
    let (_, out, _) = collide_text("momenta", SPATIAL, &["--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    // A few roundings of numbers of order ten.
    for which in ["linear", "angular"] {
        assert!(distance(&found["momenta_after"][which], &found["momenta_before"][which]) < 1e-14, "{found}");
    }
    assert_eq!((&found["k"], &found["strict"]), (&json!(1), &json!(true)));
}

#[test]
fn bodies_and_directions_that_cannot_be_are_told_the_mend() {
    let tensor = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
    for (text, old, new, help) in [
        (TOML, "\"1/2\"", "-1", "write a number above 0"),
        (TOML, "\"1/2\"", "0", "write a number above 0"),
        (TOML, ", { mass = \"inf\" }]", "]", "write one for body 1 and one for body 2"),
        (TOML, "[{ v = [0, -1], w = 3 }, { v = [0, 0], w = 0 }]", "3", "write two entries in brackets"),
        (TOML, "inertia = \"1/2\"", "S = 3", "write 2 rows of 2 numbers"),
        (TOML, "law = \"no-slip\"", "rough = 3", "as in [[1, 0]]"),
        (TOML, "[0, 3]", "[0, 0]", "write the direction from body 2 towards body 1"),
        (SPATIAL, tensor, "[[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]", "write the same number in row i, column j"),
        (SPATIAL, tensor, "[[1, 0, 0], [0, -1, 0], [0, 0, 1]]", "a rod in space needs some thickness"),
        (SPATIAL, &format!("inertia = {tensor}"), "S = [[1, 2, 0], [2, 1, 0], [0, 0, 1]]", "all eigenvalues of S"),
        (SPATIAL, &format!("inertia = {tensor}"), "S = [[1, 0, 0], [0, 0, 0], [0, 0, 0]]", "a rod in space"),
        (SPATIAL, "[[1, 0, 0]]", "[[0, 0, 2]]", "write one that is not along the normal"),
        (SPATIAL, "[[1, 0, 0]]", "[[1, 0, 0], [2, 0, 5]]", "leave it out: it adds nothing"),
    ] {
        assert!(text.contains(old), "{old}");
        let (_, _, err) = collide_text("mend", &text.replacen(old, new, 1), &[]);
        let told = err.split_once("\nhelp: ").map(|(_, told)| told);
        assert!(told.is_some_and(|told| told.contains(help)), "{new}: {err}");
    }
    let unit = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let body = json!({ "mass": 1, "position": [0, 0, 0, 0], "S": unit });
    let motion = json!({ "v": [-1, 0, 0, 0], "w": unit });
    let contact = json!({
        "dim": 4, "law": "specular", "contact_point": [0, 0, 0, 0], "normal": [1, 0, 0, 0], "bodies": [body, { "mass": "inf" }],
        "pre": [motion, { "v": [0, 0, 0, 0], "w": vec![vec![0; 4]; 4] }],
    });
    let (_, _, err) = collide_text("mend", &contact.to_string(), &[]);
    assert!(err.contains("help: write 0 on the diagonal"), "{err}");
}

#[test]
fn the_energy_of_what_moves_is_not_called_zero() {
    let energy = |speed: &str, law: &str| {
        let slow = TOML.replace("v = [0, -1], w = 3", &format!("v = [0, -{speed}], w = 0")).replace("\"no-slip\"", law);
        let (_, out, err) = collide_text("slow", &slow, &[]);
        let line = out.lines().find(|line| line.starts_with("kinetic energy")).unwrap_or_else(|| panic!("{err}"));
        line["kinetic energy".len()..]
            .split("   ")
            .map(str::trim)
            .filter(|x| !x.is_empty())
            .map(String::from)
            .collect::<Vec<_>>()
    };
    assert_eq!(energy("1e-170", "\"no-slip\""), ["below 2.3e-308"; 2]);
    assert_eq!(energy("1e-150", "\"no-slip\""), ["5e-301"; 2]);
    let stopped = "{ name = \"restitution\", normal = 0, tangential = 0 }";
    assert_eq!(energy("1e-170", stopped), ["below 2.3e-308", "0"]);
}

#[test]
fn each_mistake_has_status_2_and_its_own_message() {
    let mut wrong = Vec::new();
    for (name, text, old, new, expected) in [
        ("apart", TOML, "[0, -1]", "[0, 1]", "not approaching"),
        ("sliding", TOML, "[0, -1]", "[1, 0]", "not approaching"),
        ("fixed", TOML, "mass = 1", "mass = \"inf\"", "7:14: error: a fixed body"),
        (
            "both",
            TOML,
            "{ mass = 1, position = [0, 1], inertia = \"1/2\" }, { mass = \"inf\" }]\npre = [{ v = [0, -1], w = 3 }",
            "{ mass = inf }, { mass = \"inf\" }]\npre = [{ v = [0, 0], w = 0 }",
            "both bodies are fixed",
        ),
        ("inertia", TOML, "\"1/2\"", "-1", "6:52: error: the moment of inertia must be positive"),
        ("mass", TOML, "mass = 1", "mass = 0", "6:20: error: 0 is not positive"),
        ("normal", TOML, "[0, 3]", "[0, 0]", "5:10: error: the normal of the contact plane has no direction"),
        ("nan", TOML, "[0, 3]", "[0, nan]", "NaN"),
        ("missing", TOML, "pre =", "prae =", "did you mean \"pre\"?"),
        ("law", TOML, "\"no-slip\"", "\"noslip\"", "unknown law"),
        ("dim", TOML, "dim = 2", "dim = 6", "2:7: error: 6 is not a whole number from 2 to 5"),
        ("scene", TOML, "dim = 2", "[table]", "2:2: error: a contact has no table: this file is a scene"),
        ("dim as well", TOML, "dim = 2", "dim = 2.5", "2:7: error: 2.5 is not a whole number from 2 to 5"),
        ("three", TOML, "w = 0 }]", "w = 0 }, { v = [0, 0], w = 0 }]", "pre must have two entries, not 3"),
        (
            "unsymmetric",
            SPATIAL,
            "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n[[bodies",
            "[[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]\n[[bodies",
            "9:11: error: the inertia is not symmetric",
        ),
        (
            "unsymmetric S",
            SPATIAL,
            "inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n[[bodies",
            "S = [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]\n[[bodies",
            "9:5: error: S, the second moments, is not symmetric",
        ),
        ("one direction", SPATIAL, "[[1, 0, 0]]", "[1, 0, 0]", "help: write [[1, 0, 0]]"),
        ("law 3", TOML, "\"no-slip\"", "3", "error: a law is a string or a table, not an integer"),
        (
            "indefinite",
            SPATIAL,
            "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n[[bodies",
            "[[1, 0, 0], [0, -1, 0], [0, 0, 1]]\n[[bodies",
            "the inertia is not positive",
        ),
        (
            "slender",
            SPATIAL,
            "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n[[bodies",
            "[[1, 0, 0], [0, 1, 0], [0, 0, 1e-17]]\n[[bodies",
            "9:11: error: the principal moments of inertia range from 1e-17 to 1.0: the smallest is lost in rounding",
        ),
        ("many", SPATIAL, "[[1, 0, 0]]", "[[1, 0, 0], [0, 1, 0], [1, 1, 0]]", "3 rough directions are too many"),
        ("dependent", SPATIAL, "[[1, 0, 0]]", "[[1, 0, 0], [2, 0, 5]]", "3:21: error: rough direction 1 depends"),
        ("along", SPATIAL, "[[1, 0, 0]]", "[[0, 0, 2]]", "3:10: error: rough direction 0 is along the normal"),
        ("thin", TOML, "mass = 1,", "mass = 1e150,", "6:56: error: the inverse contact mass is singular"),
        (
            "random",
            TOML,
            "\"no-slip\"",
            "\"random\"",
            "help: write { name = \"random\", rank = 1, seed = 0 } in place of",
        ),
        ("slim", TOML, "\"1/2\"", "1e-20", "body 1 has too little inertia for its lever arm"),
        (
            "slim mended",
            TOML,
            "\"1/2\"",
            "1e-20",
            "help: give body 1 more inertia, or a position nearer to the contact",
        ),
        (
            "huge",
            TOML,
            "mass = 1, position = [0, 1], inertia = \"1/2\" }, { mass = \"inf\" }]\npre = [{ v = [0, -1]",
            "mass = 1e10, position = [0, 1], inertia = 1e10 }, { mass = \"inf\" }]\npre = [{ v = [0, -1e150]",
            "6:10: error: masses, lengths and speeds",
        ),
        (
            "pair",
            SPATIAL,
            "inertia =",
            "S = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\ninertia =",
            "both \"inertia\" and \"S\"",
        ),
    ] {
        assert!(text.contains(old), "{name}");
        let text = text.replacen(old, new, 1);
        let (status, out, err) = collide_text(name, &text, &[]);
        if (status, out.as_str()) != (2, "") || !err.contains(expected) {
            wrong.push(format!("{name}: status {status}\n  expected {expected}\n  found {err}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn examples_of_what_is_missing_make_a_contact_in_every_dimension() {
    let examples = |text: &str| -> Vec<String> {
        let (status, _, err) = collide_text("examples", text, &[]);
        assert_eq!(status, 2, "{text}");
        err.lines().filter_map(|line| Some(line.strip_prefix("help: write for instance ")?.to_owned())).collect()
    };
    let works = |text: &str| {
        let (status, _, err) = collide_text("followed", text, &[]);
        assert_eq!(status, 0, "{text}{err}");
    };
    for n in 2..=5 {
        let law = format!("dim = {n}\nlaw = \"no-slip\"\n");
        let keys = examples(&law);
        assert_eq!(keys.len(), 4, "{keys:?}");
        works(&format!("{law}{}\n", keys.join("\n")));
        // key by key within a body and a velocity
        let [bodies, _, _, motions] = &keys[..] else { panic!("{keys:?}") };
        let body =
            examples(&format!("{law}{}\nbodies = [{{ mass = 1 }}, {{ mass = \"inf\" }}]\n", keys[1..].join("\n")));
        let of_motion = examples(&format!("{law}{}\npre = [{{}}, {{ w = 1 }}]\n", keys[..3].join("\n")));
        assert!(body.len() == 2 && of_motion.len() >= 3, "{body:?} {of_motion:?}");
        let (body, motion) = (body.join(", "), of_motion[..2].join(", "));
        assert!(bodies.contains(&format!("{{ mass = 1, {body} }}")) && motions.contains(&format!("{{ {motion} }}")));
    }
}

#[test]
fn a_fixed_body_that_turns_is_told_how_to_turn_about_a_fixed_center() {
    let turning = TOML.replace("w = 0", "w = 0.5");
    let (_, _, err) = collide_text("turning", &turning, &[]);
    assert!(err.contains("7:50: error: a fixed body (mass = \"inf\") must have spin zero"), "{err}");
    assert!(
        err.contains("write w = 0; what turns about a fixed center has mass = 1e150, a position and a finite inertia"),
        "{err}"
    );
    let rotor = turning.replace("mass = \"inf\"", "mass = 1e150, position = [1, -1], inertia = 0.5");
    let (status, out, err) = collide_text("rotor", &rotor, &["--json"]);
    assert_eq!(status, 0, "{err}");
    let found: Value = serde_json::from_str(&out).unwrap();
    let body = &found["post"][1];
    assert!(
        body["w"] != json!(0.5) && body["v"].as_array().unwrap().iter().all(|v| v.as_f64().unwrap().abs() < 1e-140),
        "{body}"
    );
}

#[test]
fn a_contact_in_json_is_mended_in_json() {
    let (status, _, err) = collide_text("json", "{ \"dim\": 2, \"law\": \"no-slip\" }", &[]);
    let help = "help: write for instance \"pre\": [{ \"v\": [0, -1], \"w\": 0 }, { \"v\": [0, 0], \"w\": 0 }]\n";
    assert!(status == 2 && err.contains(help) && !err.contains(" = "), "{err}");
    let (_, _, err) = collide_text("toml", "dim = 2\nlaw = \"no-slip\"\n", &[]);
    assert!(err.contains("help: write for instance pre = [{ v = [0, -1], w = 0 }"), "{err}");
}

#[test]
fn a_spin_that_is_not_skew_is_refused() {
    let zeros = |n: usize| json!(vec![vec![0; n]; n]);
    let unit = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let body = |x: f64| json!({ "mass": 1, "position": [0, 0, 0, x], "S": unit });
    let mut spin = zeros(4);
    spin[0][1] = json!(1);
    let contact = json!({
        "dim": 4, "law": "no-slip", "contact_point": [0, 0, 0, 0], "normal": [0, 0, 0, 1],
        "bodies": [body(1.0), body(-1.0)],
        "pre": [{ "v": [0, 0, 0, -1], "w": spin }, { "v": [0, 0, 0, 0], "w": zeros(4) }],
    });
    let (status, _, err) = collide_text("skew", &contact.to_string(), &[]);
    assert!(status == 2 && err.contains("the spin is not skew"), "{err}");
}

#[test]
fn a_file_that_is_missing_or_not_text_has_status_2() {
    let (status, _, err) = execute(Path::new("no/such/file.toml"), &[]);
    assert!(status == 2 && err.contains("no/such/file.toml: error: cannot read it"), "{err}");
    let folder = folder("bytes");
    let file = folder.join("contact.toml");
    std::fs::write(&file, b"dim = 2\n\xff").unwrap();
    let (status, _, err) = execute(&file, &[]);
    assert!(status == 2 && err.contains(":2:1: error: the byte 0xFF is not UTF-8"), "{err}");
    std::fs::remove_dir_all(folder).unwrap();
}

proptest! {
    #[test]
    fn no_mutation_of_a_contact_file_makes_the_command_panic(
        which in 0..3usize,
        changes in proptest::collection::vec(
            (any::<usize>(), 0..8usize, prop_oneof![
                any::<String>(),
                proptest::sample::select(vec!["nan", "\"inf\"", "1e150", "-1e-150", "0", "[]", "{}", "2", "3", "\"1/0\"", "null", ","])
                    .prop_map(String::from),
            ]),
            1..4,
        ),
    ) {
        let json = r#"{"dim": 2, "law": "specular", "contact_point": [0, 0], "normal": [0, 1],
            "bodies": [{"mass": 1, "position": [0, 1], "S": [[1, 0], [0, 1]]}, {"mass": "inf"}],
            "pre": [{"v": [0, -1], "w": 0}, {"v": [0, 0], "w": 0}]}"#;
        let mut bytes = [TOML, SPATIAL, json][which].as_bytes().to_vec();
        for (at, length, new) in &changes {
            let at = at % (bytes.len() + 1);
            bytes.splice(at..(at + length).min(bytes.len()), new.bytes());
        }
        if let Ok(source) = Source::from_bytes("x", &bytes) {
            for as_json in [false, true] {
                let mut out = Vec::new();
                if let Err(failure) = collide::run(&source, as_json, &mut out) {
                    prop_assert_eq!((failure.status(), out.len()), (2, 0));
                    prop_assert!(!failure.to_string().is_empty());
                }
            }
        }
    }
}
