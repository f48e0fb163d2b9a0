//! The certified trajectories of `tests/data`, through the command line: each as the built-in table and as an explicit
//! boundary whose formulas are those of the file.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data")
}

fn references(folder: &str, count: usize) -> Vec<(String, Value)> {
    let mut files: Vec<_> = fs::read_dir(data().join(folder)).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    assert_eq!(files.len(), count);
    let read = |path: &PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        (name, serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap())
    };
    files.iter().map(read).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}

/// `["1/2", "0"]`, from numbers given as formulas or as decimals.
fn vector(value: &Value) -> String {
    let spell = |x: &Value| format!("\"{}\"", x.as_str().unwrap_or_else(|| x["expr"].as_str().unwrap()));
    format!("[{}]", value.as_array().unwrap().iter().map(spell).collect::<Vec<_>>().join(", "))
}

/// The built-in table of a file.
fn named(table: &Value) -> String {
    let name = table["name"].as_str().unwrap();
    let (name, parameters) = match name {
        "sinai_square" => ("sinai", "radius = 0.25"),
        "sinai_torus_r14" => ("sinai-torus", "radius = 0.25"),
        "sinai_torus_r38" => ("sinai-torus", "radius = \"3/8\""),
        "wedge_pi3" | "wedge_1" | "wedge_p8" => {
            ("wedge", &*format!("angle = \"{}\"", table["theta"]["expr"].as_str().unwrap()))
        }
        "pocket" => ("pocket", "pocket_radius = \"5/16\"\npocket_depth = \"9/16\""),
        "isosceles" => ("isosceles", "height = 1.25"),
        other => (other, ""),
    };
    format!("[table]\nname = \"{name}\"\n{parameters}\n")
}

/// The same table piece by piece.
fn explicit(table: &Value) -> String {
    let mut text = String::from("[table]\n");
    if table.get("torus").is_some() {
        text += "lattice = [[1, 0], [0, 1]]\n";
    }
    // a run of segments and arcs, each of which starts where the one before it ends, is a loop
    let mut first: Option<(String, String)> = None;
    let mut edges: Vec<String> = vec![];
    for piece in table["pieces"].as_array().unwrap() {
        let center = || vector(&piece["center"]);
        let edge = match piece["kind"].as_str().unwrap() {
            "segment" => Some((&piece["a"], &piece["b"], format!("line_to = {}", vector(&piece["b"])))),
            "arc" if piece["full"] != true => {
                // from and to are given counter-clockwise; the domain lies on the left of the traversal
                let focusing = piece["side"] == "focusing";
                let (from, to, turn) = if focusing { ("from", "to", "ccw") } else { ("to", "from", "cw") };
                let shape = format!("arc_to = {}, center = {}, turn = \"{turn}\"", vector(&piece[to]), center());
                Some((&piece[from], &piece[to], shape))
            }
            "arc" => {
                let domain = if piece["side"] == "focusing" { "inside" } else { "outside" };
                let radius = piece["radius"]["expr"].as_str().unwrap();
                let _ = writeln!(
                    text,
                    "[[table.boundary]]\ncircle = {{ center = {}, radius = \"{radius}\", domain = \"{domain}\" }}",
                    center()
                );
                None
            }
            "ellipse" => {
                let _ = writeln!(
                    text,
                    "[[table.boundary]]\nellipse = {{ center = [0, 0], semi_axes = {} }}",
                    vector(&Value::Array(vec![piece["a"].clone(), piece["b"].clone()]))
                );
                None
            }
            "line" => {
                let (through, direction) = (vector(&piece["origin"]), vector(&piece["direction"]));
                let _ = writeln!(text, "[[table.boundary]]\nline = {{ through = {through}, direction = {direction} }}");
                None
            }
            "ray" => {
                let (from, direction) = (vector(&piece["origin"]), vector(&piece["direction"]));
                let domain = piece["domain"].as_str().unwrap();
                let _ = writeln!(
                    text,
                    "[[table.boundary]]\nray = {{ from = {from}, direction = {direction}, domain = \"{domain}\" }}"
                );
                None
            }
            other => panic!("unknown piece {other}"),
        };
        if let Some((from, to, shape)) = edge {
            let (start, _) = first.get_or_insert_with(|| (decimals(from), vector(from)));
            let closes = decimals(to) == *start;
            edges.push(format!("{{ {shape} }}"));
            if closes {
                let from = first.take().unwrap().1;
                let _ = writeln!(
                    text,
                    "[[table.boundary]]\nloop = {{ from = {from}, edges = [\n  {},\n] }}",
                    edges.join(",\n  ")
                );
                edges.clear();
            }
        }
    }
    assert!(edges.is_empty(), "{text}");
    text
}

/// A point by its decimals, which are the same for the same number.
fn decimals(point: &Value) -> String {
    [0, 1].map(|i| point[i]["dec"].as_str().unwrap()).join(" ")
}

/// Runs a scene; the record and the summary.
fn run(name: &str, scene: &str) -> (Vec<Vec<f64>>, Value) {
    let folder = std::env::temp_dir().join(format!("billiards-reference-{}-{name}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("scene.toml");
    fs::write(&file, scene).unwrap();
    let mut command = Command::cargo_bin("billiards").unwrap();
    let output = command.arg("run").arg(&file).arg("--out").arg(&folder).args(["--threads", "1"]).output().unwrap();
    assert!(output.status.success(), "{name}: {}\n{scene}", String::from_utf8_lossy(&output.stderr));
    let record = fs::read_to_string(folder.join("collisions.csv")).unwrap();
    let rows = record.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    let summary = serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap();
    fs::remove_dir_all(folder).unwrap();
    (rows, summary)
}

/// What of a record differs from a planar reference by more than `tests/data/README.md` allows.
fn planar_fault(reference: &Value, rows: &[Vec<f64>], summary: &Value) -> Option<String> {
    let expected = reference["collisions"].as_array().unwrap();
    if rows.len() != expected.len() {
        return Some(format!("{} collisions for {}", rows.len(), expected.len()));
    }
    let stop = if reference["ended"] == "escaped_to_infinity" { "escaped" } else { "finished" };
    let mut amplification = 1.0_f64;
    for (row, expected) in rows.iter().zip(expected) {
        let n = number(&expected["n"]);
        amplification = amplification.max(number(&expected["amp"]));
        let bound = 16.0 * n * f64::EPSILON * amplification;
        if bound >= 1e-3 {
            // chaos has the word; piece sequences part from here on
            return None;
        }
        let (x, v) = (&expected["x"], &expected["v"]);
        let mut want = vec![0.0, n, number(&expected["t"]), number(&expected["piece"])];
        want.extend([&x[0], &x[1], &x[2], &v[0], &v[1], &v[2]].map(number));
        if let Some(cell) = expected.get("cell") {
            want.extend([number(&cell[0]), number(&cell[1])]);
        }
        for (i, (got, want)) in row.iter().zip(&want).enumerate() {
            // whole numbers are exact; time and x0 add up: relative to their own size
            let allowed = match i {
                0 | 1 | 3 | 10 | 11 => 0.0,
                2 | 4 => bound * want.abs().max(1.0),
                _ => bound,
            };
            if (got - want).abs() > allowed {
                return Some(format!("collision {n}, column {i}: {got} for {want}, allowed {allowed:e}"));
            }
        }
    }
    (summary["stops"][stop] != 1).then(|| format!("{} instead of {stop}", summary["stops"]))
}

fn planar_scene(reference: &Value, table: &str) -> String {
    let law = if reference["law"] == "noslip" { "no-slip" } else { "specular" };
    let (x, v) = (&reference["initial"]["x"], &reference["initial"]["v"]);
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    format!(
        "law = \"{law}\"\n{table}\n[particle]\ngamma_squared = \"{}\"\n[[orbit]]\nposition = [{}, {}]\n\
         velocity = [{}, {}]\nspin = {}\nangle = {}\n[run]\ncollisions = {}\n[output]\ncollisions = \"csv\"\n",
        text(&reference["gamma_squared"]),
        text(&x[1]),
        text(&x[2]),
        text(&v[1]),
        text(&v[2]),
        text(&v[0]),
        text(&x[0]),
        reference["requested"],
    )
}

#[test]
fn every_planar_trajectory_is_reproduced_on_the_built_in_table_and_on_the_same_boundary_drawn_by_hand() {
    let mut faults = String::new();
    for (name, reference) in references("traj", 80) {
        for (kind, table) in [("named", named(&reference["table"])), ("explicit", explicit(&reference["table"]))] {
            let (rows, summary) = run(&format!("{name}-{kind}"), &planar_scene(&reference, &table));
            if let Some(fault) = planar_fault(&reference, &rows, &summary) {
                let _ = writeln!(faults, "{name}, {kind}: {fault}");
            }
            assert!(number(&summary["energy_drift"]) <= 4e-16, "{name}, {kind}: {}", summary["energy_drift"]);
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

#[test]
fn disks_that_roll_along_drawn_walls_go_where_another_program_has_them() {
    let scenes = fs::read_to_string(data().join("rolling/scenes.json")).unwrap();
    let scenes: Vec<Value> = serde_json::from_str(&scenes).unwrap();
    assert_eq!(scenes.len(), 37);
    for (k, reference) in scenes.iter().enumerate() {
        let (rows, summary) = run(&format!("rolling-{k}"), reference["scene"].as_str().unwrap());
        assert_eq!(planar_fault(reference, &rows, &summary), None, "{k}:\n{}", reference["scene"]);
    }
}

/// `[[orbit]]` from a state (x, v, W); Rust and TOML agree on how a number is written.
fn orbit_in_space(state: [f64; 9]) -> String {
    let [x, v, w] = [0, 3, 6].map(|i| format!("[{:?}, {:?}, {:?}]", state[i], state[i + 1], state[i + 2]));
    format!("[[orbit]]\nposition = {x}\nvelocity = {v}\nspin = {w}\n")
}

#[test]
fn every_trajectory_in_space_is_reproduced() {
    // half of the digits, so that what is seen of the change is right to about 1e-8
    let delta = libm::ldexp(1.0, -26);
    for (name, reference) in references("traj3d", 9) {
        let table = name.split('_').next().unwrap();
        let law = match reference["law"].as_str().unwrap() {
            "k0" => "law = \"specular\"".to_owned(),
            "k1" => format!("rough = [{}]", vector(&reference["rough"])),
            _ => "law = \"no-slip\"".to_owned(),
        };
        let state =
            |from: &Value| -> [f64; 9] { std::array::from_fn(|i| number(&from[["x", "v", "W"][i / 3]][i % 3])) };
        // the orbit, and nine that start a little beside it: how much errors grow
        let start = state(&reference["initial"]);
        let beside = (0..9).map(|i| {
            let mut beside = start;
            beside[i] += delta;
            orbit_in_space(beside)
        });
        let scene = format!(
            "{law}\n[table]\ndimension = 3\nname = \"{table}\"\n[particle]\ngamma_squared = \"{}\"\n{}{}\
             [run]\ncollisions = {}\n[output]\ncollisions = \"csv\"\n",
            reference["gamma_squared"].as_str().unwrap(),
            orbit_in_space(start),
            beside.collect::<String>(),
            reference["count"],
        );
        let (rows, summary) = run(&name, &scene);
        let expected = reference["collisions"].as_array().unwrap();
        let count = expected.len();
        assert_eq!((rows.len(), &summary["stops"]["finished"]), (10 * count, &Value::from(10)), "{name}");
        let mut amplification = 1.0_f64;
        for (k, expected) in expected.iter().enumerate() {
            let row = &rows[k];
            for other in (1..10).map(|orbit| &rows[orbit * count + k]) {
                let square: f64 = row[4..].iter().zip(&other[4..]).map(|(a, b)| (a - b) * (a - b)).sum();
                amplification = amplification.max(square.sqrt() / delta);
            }
            let n = number(&expected["n"]);
            // as for the planar files: a few roundings per collision, each of which grows with the condition number
            let bound = 16.0 * n * f64::EPSILON * amplification;
            assert!(bound < 1e-3, "within the horizon of an f64");
            // the files count the slab's walls as those of a box
            let piece = number(&expected["piece"]) - if table == "slab" { 4.0 } else { 0.0 };
            let mut want = vec![0.0, n, number(&expected["t"]), piece];
            want.extend(state(expected));
            for (i, (got, want)) in row.iter().zip(&want).enumerate() {
                let allowed = match i {
                    0 | 1 | 3 => 0.0,
                    2 => bound * want.max(1.0),
                    _ => bound,
                };
                assert!((got - want).abs() <= allowed, "{name}, collision {n}, column {i}: {got} for {want}");
            }
        }
    }
}
