//! Every scene in `scenes/` runs, under its own law, under the specular one and under no-slip.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

use core::f64::consts::PI;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use billiards_cli::document::Source;
use billiards_cli::scene::{Request, Scene, TABLES};
use billiards_cli::simulation::Simulation;
use serde_json::Value;

fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files
}

fn billiards() -> Command {
    Command::cargo_bin("billiards").unwrap()
}

/// Runs a scene into a folder of its own; what it printed, the summary and the names of the files.
fn run(scene: &Path, law: Option<&str>) -> (String, Value, BTreeSet<String>) {
    let name = scene.file_stem().unwrap().to_string_lossy();
    let folder = format!("billiards-scenes-{}-{name}-{}", std::process::id(), law.unwrap_or("own"));
    let folder = std::env::temp_dir().join(folder);
    let mut command = billiards();
    command.arg("run").arg(scene).arg("--out").arg(&folder);
    if let Some(law) = law {
        command.args(["--law", law]);
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    let summary = serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap();
    let files = fs::read_dir(&folder).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    fs::remove_dir_all(folder).unwrap();
    (String::from_utf8(output.stdout).unwrap(), summary, files)
}

#[test]
fn every_scene_runs_under_every_law_and_conserves_energy() {
    for scene in scenes() {
        for law in [None, Some("specular"), Some("no-slip")] {
            let (printed, summary, files) = run(&scene, law);
            let name = scene.display();
            assert!(files.contains("summary.json"), "{name}");
            assert!(files.len() >= 2, "{name}: nothing but a summary: {files:?}");
            assert!(printed.contains(summary["title"].as_str().unwrap()), "{name}: {printed}");
            assert!(summary["collisions"].as_u64().unwrap() > 0, "{name}");
            if let Some(law) = law {
                assert_eq!(summary["law"], law, "{name}");
            }
            if !summary["law"].as_str().unwrap().starts_with("restitution") {
                let drift = summary["energy_drift"].as_f64().unwrap();
                assert!(drift <= 4e-16, "{name}, {law:?}: energy drifts by {drift:e}");
            }
            let ends = summary["stops"].as_object().unwrap();
            let orbits: u64 = ends.values().map(|count| count.as_u64().unwrap()).sum();
            assert_eq!(summary["orbits"].as_u64(), Some(orbits), "{name}");
            assert!(ends.keys().all(|stop| stop == "finished" || stop == "escaped"), "{name}, {law:?}: {ends:?}");
        }
    }
}

#[test]
fn every_built_in_table_has_a_scene_of_its_name() {
    let names: BTreeSet<_> =
        scenes().iter().map(|file| file.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    for table in TABLES.iter() {
        assert!(names.contains(table.name), "{}", table.name);
    }
}

#[test]
fn every_scene_is_described_by_check() {
    for scene in scenes() {
        let output = billiards().arg("check").arg(&scene).output().unwrap();
        assert!(output.status.success(), "{}: {}", scene.display(), String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains("law") && text.contains("engine") && text.contains("starts at"), "{text}");
        let output = billiards().arg("check").arg(&scene).arg("--json").output().unwrap();
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(!json["pieces"].as_array().unwrap().is_empty(), "{}", scene.display());
        let space = json["dimension"] == 3;
        // infinite tables have none, and in space only tables with a name have one
        let name = scene.file_stem().unwrap().to_str().unwrap();
        let is_known = if space { ["ball", "box"].contains(&name) } else { !["strip", "wedge"].contains(&name) };
        for (measure, of_space) in [("area", false), ("perimeter", false), ("volume", true), ("surface", true)] {
            assert_eq!(json["walls"][measure].is_number(), is_known && space == of_space, "{name}: {measure}");
        }
    }
}

#[test]
fn areas_within_formulas_of_limited_smoothness_are_right_to_rounding() {
    // 4ab Γ(1+1/n)²/Γ(1+2/n), from 30 digits
    for (formula, area) in [
        ("abs(x/3)^2.5 + abs(y/2)^2.5 - 1", 20.285_612_175_224_3),
        ("abs(x)^3.5 + abs(y)^3.5 - 1", 3.635_880_811_933_636_6),
        ("abs(x)^5 + abs(y)^5 - 1", 3.800_600_555_953_747),
        ("x^4 + y^4 - 1/4", 1.854_074_677_301_371_9),
    ] {
        let curve = format!("curve = {{ implicit = \"{formula}\", within = [[-4, -4], [4, 4]] }}");
        let text = format!(
            "law = \"specular\"\ntable = {{ boundary = [{{ {curve} }}] }}\n{}",
            "run = { collisions = 1 }\norbit = [{ position = [0, 0], velocity = [1, 0] }]"
        );
        let parsed = Scene::parse(&Source::new("x.toml", &text), &Request::default()).unwrap();
        let told = serde_json::to_value(Simulation::new(parsed).unwrap().describe()).unwrap();
        let told = told["walls"]["area"].as_f64().unwrap();
        assert!((told / area - 1.0).abs() < 8.0 * f64::EPSILON, "{formula}: {told}, not {area}");
    }
}

/// What `check` prints of a scene.
fn checked(name: &str, scene: &str) -> String {
    let path = std::env::temp_dir().join(format!("billiards-scenes-{}-{name}.toml", std::process::id()));
    fs::write(&path, scene).unwrap();
    let output = billiards().arg("check").arg(&path).output().unwrap();
    fs::remove_file(path).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn what_is_told_of_a_table_is_in_numbers_and_plain_words() {
    let start = "[[orbit]]\nposition = [0.25, 0.5, 0.25]\nvelocity = [0.6, 0.8, 0.1]\n";
    let cuboid = format!("law = \"specular\"\n[table]\ndimension = 3\nname = \"box\"\nsize = [1, 2.5, 0.75]\n{start}");
    let told = checked("box", &cuboid);
    for wall in ["x1 = 0\n", "x1 = 1\n", "x2 = 2.5\n", "x3 = 0.75\n"] {
        assert!(told.contains(wall), "{wall} expected in {told}");
    }
    let room = "law = \"specular\"\n[table]\ndimension = 3\n[[table.boundary]]\nsphere = { center = [0, 0, 0], radius = 2 }\n\
                [[table.boundary]]\nshape = { name = \"cuboid\", size = [0.1, 0.1, 0.1] }\n";
    let told = checked("around", &format!("{room}{start}"));
    let engine = told.lines().find(|line| line.contains("engine")).unwrap();
    assert!(engine.ends_with(" Solids") && !engine.contains('\''), "{engine}");
}

#[test]
fn a_start_is_told_where_it_is_in_the_unit_of_the_scene() {
    let orbit = |third: &str| {
        format!(
            "law = \"no-slip\"\nparticle = {{ radius = 0.25, gamma_squared = 0.5 }}\nrun = {{ collisions = 3 }}\n\
             orbit = [{{ position = [0.5, 3{third}], velocity = [0, 1{third}] }}]\n"
        )
    };
    for (table, third) in
        [("name = \"rectangle\", size = [1, 8]", ""), ("dimension = 3, name = \"box\", size = [1, 8, 1]", ", 0.5")]
    {
        let told = checked("start", &format!("{}table = {{ {table} }}\n", orbit(third)));
        let place = format!("starts at (0.5, 3{third}), 0.25 from a wall; hits piece");
        assert!(told.contains(&place), "{told}");
    }
}

#[test]
fn the_largest_disk_of_a_lattice_lies_in_the_unit_cell() {
    let start = "[[orbit]]\nposition = [0.5, 0.01]\nvelocity = [0.6, 0.8]\n";
    for (name, table) in [
        ("lorentz", "name = \"lorentz\"\nradius = 0.3\n"),
        ("sinai-torus", "name = \"sinai-torus\"\nradius = 0.25\n"),
        (
            "skew",
            "lattice = [[1, 0], [3.5, 1]]\n[[table.boundary]]\n\
             circle = { center = [0, 0], radius = 0.3, domain = \"outside\" }\n",
        ),
    ] {
        let told = checked(name, &format!("law = \"specular\"\n[table]\n{table}{start}"));
        let center = told.split("centred near (").nth(1).unwrap().split(')').next().unwrap();
        let [x, y] = {
            let mut numbers = center.split(", ").map(|x| x.parse::<f64>().unwrap());
            [(); 2].map(|()| numbers.next().unwrap())
        };
        let [across, up] = match name {
            "lorentz" => [x - y / libm::sqrt(3.0), 2.0 * y / libm::sqrt(3.0)],
            "skew" => [x - 3.5 * y, y],
            _ => [x, y],
        };
        assert!((-1e-5..1.0).contains(&across) && (-1e-5..1.0).contains(&up), "{name}: {center}");
    }
}

#[test]
fn the_mean_free_time_is_that_of_the_law() {
    // of a Lorentz gas πA/P, where the centre keeps its speed, and 4A/P where all velocities mix
    for (name, law, told, silent) in [
        ("lorentz", "specular", "0.255392 = pi area/perimeter, at unit speed of the centre", "spin included"),
        ("lorentz", "no-slip", "0.325175 = 4 area/perimeter, at unit speed, spin included", "of the centre"),
        ("can", "specular", "engine", "mean free"),
    ] {
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenes/{name}.toml"));
        let output = billiards().arg("check").arg(&scene).args(["--law", law]).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(text.contains(told) && !text.contains(silent), "{text}");
    }
}

#[test]
fn the_mean_free_time_is_that_without_spin_where_nothing_turns_velocity_into_it() {
    let folder = std::env::temp_dir().join(format!("billiards-scenes-{}-keeps-spin", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let plane = "name = \"square\"\n[[orbit]]\nposition = [0.3, 0.4]\nvelocity = [0.6, 0.8]\n";
    let space = "dimension = 3\nname = \"box\"\nsize = [1, 2, 3]\n[[orbit]]\nposition = [0.3, 0.4, 0.2]\nvelocity = [0.6, 0.8, 0.1]\n";
    let random = |rank| format!("{{ name = \"random\", rank = {rank} }}");
    let point = "[particle]\ninertia = \"point\"\n";
    let tiny = "[particle]\ngamma_squared = 1e-12\n";
    for (table, law, particle, keeps) in [
        (plane, "\"specular\"".into(), "", true),
        (plane, "\"no-slip\"".into(), "", false),
        (plane, "\"no-slip\"".into(), point, true),
        (plane, "\"no-slip\"".into(), tiny, false),
        (plane, "{ rough = [] }".into(), "", true),
        (plane, "{ rough = [[1, 0]] }".into(), "", false),
        (plane, random(0), "", true),
        (plane, random(1), "", false),
        (space, "\"no-slip\"".into(), "", false),
        (space, "\"no-slip\"".into(), point, true),
        (space, "{ rough = [] }".into(), "", true),
        (space, "{ rough = [[1, 0, 0]] }".into(), "", false),
        (space, "{ rough = [[1, 0, 0]] }".into(), point, true),
        (space, random(0), "", true),
        (space, random(1), "", false),
        (space, random(1), point, true),
        (space, random(1), tiny, false),
    ] {
        let scene = folder.join("scene.toml");
        fs::write(&scene, format!("law = {law}\n[table]\n{table}{particle}")).unwrap();
        let output = billiards().arg("check").arg(&scene).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        let (with, without) = (text.contains("spin included"), text.contains("at unit speed of the centre"));
        assert_eq!((with, without), (!keeps, keeps), "{law} {particle}: {text}");
    }
    // of one side alone, the others are rough
    let scene = folder.join("scene.toml");
    fs::write(&scene, format!("law = \"no-slip\"\n[table]\nlaws = {{ 1 = \"specular\" }}\n{plane}")).unwrap();
    let output = billiards().arg("check").arg(&scene).output().unwrap();
    assert!(String::from_utf8(output.stdout).unwrap().contains("spin included"));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_mean_free_time_is_told_of_each_part() {
    let folder = std::env::temp_dir().join(format!("billiards-scenes-{}-parts", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let room = |x: f64, width: f64| {
        let right = x + width;
        format!(
            "[[table.boundary]]\nloop = {{ from = [{x}, 0], edges = [{{ line_to = [{right}, 0] }}, \
             {{ line_to = [{right}, 1] }}, {{ line_to = [{x}, 1] }}, {{ line_to = [{x}, 0] }}] }}\n"
        )
    };
    let orbit = "[[orbit]]\nposition = [0.3, 0.4]\nvelocity = [0.6, 0.8]\n";
    let scene = folder.join("scene.toml");
    // π/4 in the square, π/3 in the rectangle, and 3π/10 of both
    fs::write(&scene, format!("law = \"specular\"\n{}{}{orbit}", room(0.0, 1.0), room(2.0, 2.0))).unwrap();
    let output = billiards().arg("check").arg(&scene).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let told = "  mean free   time 0.942478 = pi area/perimeter, at unit speed of the centre\n              \
                in its parts 0.785398, 1.0472\n";
    assert!(text.contains(told), "{text}");
    // where a disk of some radius fits, too
    let disk = "[particle]\nradius = 0.25\ninertia = \"uniform-disk\"\n";
    fs::write(&scene, format!("law = \"no-slip\"\n{}{}{orbit}{disk}", room(0.0, 1.0), room(2.0, 2.0))).unwrap();
    let output = billiards().arg("check").arg(&scene).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("in its parts 0.5, 0.75\n"), "{text}");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn points_of_an_ensemble_have_no_spin() {
    let folder = std::env::temp_dir().join(format!("billiards-scenes-{}-points", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let (scene, out) = (folder.join("scene.toml"), folder.join("out"));
    for (table, sample, dimension) in [
        ("name = \"square\"", "canonical", 2),
        ("name = \"square\"", "grid", 2),
        ("dimension = 3\nname = \"ball\"", "canonical", 3),
    ] {
        let text = format!(
            "law = \"specular\"\n[table]\n{table}\n[particle]\ninertia = \"point\"\n[ensemble]\ncount = 20\nspeed = 2\n\
             sample = \"{sample}\"\n[output]\ncollisions = \"csv\"\n"
        );
        fs::write(&scene, text).unwrap();
        let output = billiards().arg("check").arg(&scene).output().unwrap();
        let told = String::from_utf8(output.stdout).unwrap();
        assert!(told.contains("at unit speed of the centre") && !told.contains("spin included"), "{told}");
        assert!(
            billiards()
                .arg("run")
                .arg(&scene)
                .arg("--out")
                .arg(&out)
                .args(["-n", "3"])
                .output()
                .unwrap()
                .status
                .success()
        );
        let record = fs::read_to_string(out.join("collisions.csv")).unwrap();
        assert_eq!(record.lines().count(), 61);
        for row in record.lines().skip(1) {
            let row: Vec<f64> = row.split(',').map(|x| x.parse().unwrap()).collect();
            let (velocity, spin) = if dimension == 2 { (&row[8..10], &row[7..8]) } else { (&row[7..10], &row[10..13]) };
            assert!(spin.iter().all(|w| *w == 0.0), "{row:?}");
            assert!((velocity.iter().map(|v| v * v).sum::<f64>() - 4.0).abs() < 1e-14, "{row:?}");
        }
    }
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn there_is_no_mean_free_time_where_no_measure_is_invariant() {
    let folder = std::env::temp_dir().join(format!("billiards-scenes-{}-free-time", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let start = "[[orbit]]\nposition = [0.3, 0.4]\nvelocity = [0.6, 0.8]\n";
    let own = "laws = { 2 = { name = \"restitution\", normal = 0.9, tangential = 0 } }\n";
    let law = |normal: &str, tangential: &str| {
        format!("{{ name = \"restitution\", normal = {normal}, tangential = {tangential} }}")
    };
    for (law, own, told) in [
        (law("0.9", "0"), "", None),
        (law("1", "0.5"), "", None),
        ("\"no-slip\"".into(), own, None),
        // elastic ones are strict
        (law("1", "1"), "", Some("1 = 4 area/perimeter, at unit speed, spin included")),
        (law("1", "-1"), "", Some("0.785398 = pi area/perimeter, at unit speed of the centre")),
    ] {
        let scene = folder.join("scene.toml");
        fs::write(&scene, format!("law = {law}\n[table]\nname = \"square\"\n{own}{start}")).unwrap();
        let output = billiards().arg("check").arg(&scene).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && text.contains("engine"), "{text}");
        assert!(told.map_or(!text.contains("mean free"), |told| text.contains(told)), "{law} {own}: {text}");
    }
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_polar_formula_may_come_to_0_in_a_cusp_and_between_petals() {
    let folder = std::env::temp_dir().join(format!("billiards-scenes-{}-cusp", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    for (curve, area) in [
        ("polar = \"1+sin(t)\"", 1.5 * PI),
        ("polar = \"1e100*(1-cos(t-0.3))\", center = [3e99, 0]", 1.5e200 * PI),
        ("polar = \"abs(sin(t/2-0.7))\", center = [0, 1.1]", 0.5 * PI),
        ("polar = \"abs(cos(2*t))\", center = [0, 0.75]", 0.5 * PI),
        ("polar = \"3*abs(sin(5*t))\", center = [0, -1]", 4.5 * PI),
    ] {
        let start = "[[orbit]]\nposition = [0, 1]\nvelocity = [0.6, 0.8]\n";
        let scene = folder.join("scene.toml");
        fs::write(&scene, format!("law = \"specular\"\n[[table.boundary]]\ncurve = {{ {curve} }}\n{start}")).unwrap();
        let output = billiards().arg("check").arg(&scene).arg("--json").output().unwrap();
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        let found = told["walls"]["area"].as_f64().unwrap();
        assert!((found / area - 1.0).abs() < 1e-14, "{curve}: {found}");
    }
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_scene_has_the_same_results_twice_and_on_any_number_of_threads() {
    let scene = scenes().into_iter().find(|scene| scene.ends_with("isosceles.toml")).unwrap();
    let folder = std::env::temp_dir().join(format!("billiards-scenes-{}-twice", std::process::id()));
    let mut kept: Vec<(Value, Vec<u8>)> = vec![];
    for (i, threads) in ["1", "1", "3"].into_iter().enumerate() {
        let out = folder.join(i.to_string());
        let status = billiards().arg("run").arg(&scene).arg("--out").arg(&out).args(["--threads", threads]).output();
        assert!(status.unwrap().status.success());
        let mut summary: Value = serde_json::from_str(&fs::read_to_string(out.join("summary.json")).unwrap()).unwrap();
        for key in ["seconds", "ns_per_collision", "threads", "host", "date", "command"] {
            assert!(summary.as_object_mut().unwrap().remove(key).is_some(), "{key}");
        }
        kept.push((summary, fs::read(out.join("velocity-portrait.svg")).unwrap()));
    }
    assert!(kept.windows(2).all(|pair| pair[0] == pair[1]));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_orbits_of_every_scene_have_the_same_bits_in_lanes() {
    for scene in scenes() {
        let source = Source::read(&scene).unwrap();
        let parsed = Scene::parse(&source, &Request::default()).unwrap();
        let same = Simulation::new(parsed).unwrap().same_bits();
        let same = same.unwrap_or_else(|error| panic!("{}: {error}", scene.display()));
        assert!(same.collisions > 0, "{}", scene.display());
    }
}

#[test]
fn check_tells_that_orbits_have_the_same_bits() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/mushroom.toml");
    let check = |more: &[&str]| {
        let output = billiards().arg("check").arg(&scene).args(more).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(check(&["--same-bits"]).contains("same bits   of 40 orbits"));
    let json: Value = serde_json::from_str(&check(&["--same-bits", "--json"])).unwrap();
    assert_eq!((&json["dimension"], &json["same_bits"]["orbits"]), (&2.into(), &40.into()));
    let without: Value = serde_json::from_str(&check(&["--json"])).unwrap();
    assert!(without["dimension"] == 2 && without.get("same_bits").is_none());
}
