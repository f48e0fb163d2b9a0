//! `billiards run` as a user meets it: what is written, what is refused, and what does not change a result.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// A folder for one test, removed with it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("billiards-run-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    /// Writes a scene and runs it with further arguments; results come into `out`.
    fn run(&self, scene: &str, arguments: &[&str]) -> Output {
        fs::write(self.0.join("scene.toml"), scene).unwrap();
        let mut command = Command::cargo_bin("billiards").unwrap();
        command.current_dir(&self.0).args(["run", "scene.toml", "--out", "out"]).args(arguments).output().unwrap()
    }

    /// The same, which must succeed; the summary.
    fn done(&self, scene: &str, arguments: &[&str]) -> Value {
        let output = self.run(scene, arguments);
        assert!(output.status.success(), "{}\n{scene}", String::from_utf8_lossy(&output.stderr));
        self.summary("out")
    }

    fn summary(&self, out: &str) -> Value {
        serde_json::from_str(&self.read(&format!("{out}/summary.json"))).unwrap()
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.join(file)).unwrap()
    }

    fn rows(&self) -> Vec<Vec<f64>> {
        let record = self.read("out/collisions.csv");
        record.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const SQUARE: &str = r#"
law = "specular"
[table]
name = "square"
[[orbit]]
position = [0.25, 0.5]
velocity = [0.5, 0.25]
spin = 0.125
angle = 1
[[orbit]]
position = [0.5, 0.5]
velocity = [0, -1]
[run]
collisions = 3
[output]
collisions = "csv"
"#;

#[test]
fn the_record_has_one_row_per_collision_in_the_order_of_the_orbits() {
    let folder = Folder::new("record");
    folder.done(SQUARE, &[]);
    // every number is dyadic, so the rows are exact: time since the start, x0 = angle + spin · time, velocity after
    assert_eq!(
        folder.read("out/collisions.csv"),
        "orbit,n,t,piece,x0,x1,x2,v0,v1,v2\n\
         0,1,1.5,1,1.1875,1,0.875,0.125,-0.5,0.25\n\
         0,2,2,2,1.25,0.75,1,0.125,-0.5,-0.25\n\
         0,3,3.5,3,1.4375,0,0.625,0.125,0.5,-0.25\n\
         1,1,0.5,0,0,0.5,0,0,0,1\n\
         1,2,1.5,2,0,0.5,1,0,0,-1\n\
         1,3,2.5,0,0,0.5,0,0,0,1\n"
    );
}

#[test]
fn the_summary_tells_after_how_many_collisions_the_digits_are_gone() {
    let folder = Folder::new("horizon");
    let orbit = "[[orbit]]\nposition = [0.1, 0.2]\nvelocity = [0.6, 0.8]\nspin = 0.25\n[run]\ncollisions = 1000\n\
                 [output]\npictures = [\"orbit\"]\n";
    let scene = |law: &str, table: &str| format!("law = \"{law}\"\n[table]\nname = \"{table}\"\n{orbit}");
    // the start is a filled dot, the last place that is known an open one
    let dots =
        || ["#144a87", "#ffffff"].map(|fill| folder.read("out/orbit.svg").matches(&format!("fill=\"{fill}\"")).count());
    // the stadium's exponent is 0.94 per collision: 36 of them make a table of an ulp
    let chaotic = folder.done(&scene("specular", "stadium"), &[])["horizon"].clone();
    let collisions = chaotic["collisions"].as_u64().unwrap();
    assert!((25..50).contains(&collisions), "{chaotic}");
    assert_eq!((&chaotic["orbits"][0]["lost"], &chaotic["orbits"][0]["time"]), (&Value::Bool(true), &chaotic["time"]));
    assert_eq!(dots(), [1, 1]);
    // in a circle errors grow like the square of the number of collisions
    let regular = folder.done(&scene("no-slip", "circle"), &[])["horizon"].clone();
    assert!(regular["collisions"].is_null() && regular["time"].is_null(), "{regular}");
    assert_eq!(regular["orbits"][0]["collisions"].as_u64(), Some(1000));
    assert!(regular["orbits"][0]["error"].as_f64().unwrap() < 1e-8, "{regular}");
    assert_eq!(dots(), [1, 0]);
}

#[test]
fn the_summary_has_every_promised_key() {
    let folder = Folder::new("summary");
    let summary = folder.done(SQUARE, &["--threads", "1"]);
    for key in
        ["scene", "version", "seed", "collisions", "seconds", "ns_per_collision", "energy_drift", "horizon", "stops"]
    {
        assert!(!summary[key].is_null(), "{key}");
    }
    assert_eq!((summary["collisions"].as_u64(), summary["stops"]["finished"].as_u64()), (Some(6), Some(2)));
    assert_eq!(summary["energy_drift"].as_f64(), Some(0.0));
    assert_eq!(summary["version"], env!("CARGO_PKG_VERSION"));
    // the hash of the file as it is, whatever the command line says beside it
    let hash = summary["scene"].clone();
    assert_eq!(hash.as_str().unwrap().len(), 64);
    assert_eq!(folder.done(SQUARE, &["--law", "no-slip", "-n", "2"])["scene"], hash);
    assert_ne!(folder.done(&SQUARE.replace("0.125", "0.25"), &[])["scene"], hash);
}

#[test]
fn the_command_line_overrides_law_and_limit_and_nothing_else() {
    let folder = Folder::new("override");
    folder.done(SQUARE, &["--law", "no-slip", "-n", "1"]);
    let rows = folder.rows();
    assert_eq!(rows.len(), 2);
    // a uniform disk: v0+ = -v0/3 + (2 sqrt 2/3) vt with vt = v2 on the right wall (t = J nu points down: vt = -v2)
    let s = 2.0 * 2.0_f64.sqrt() / 3.0;
    let expected = -0.125 / 3.0 + s * -0.25;
    assert!((rows[0][7] - expected).abs() <= 4.0 * f64::EPSILON, "{} {expected}", rows[0][7]);
    assert_eq!(rows[0][8], -0.5);
}

#[test]
fn output_goes_to_a_folder_named_after_the_scene() {
    let folder = Folder::new("default");
    fs::write(folder.0.join("my-scene.toml"), SQUARE).unwrap();
    let mut command = Command::cargo_bin("billiards").unwrap();
    let output = command.current_dir(&folder.0).args(["run", "my-scene.toml"]).output().unwrap();
    assert!(output.status.success());
    assert!(folder.0.join("out/my-scene/summary.json").exists());
    assert!(folder.0.join("out/my-scene/collisions.csv").exists());
}

#[test]
fn every_format_of_the_record_holds_the_same_rows() {
    let folder = Folder::new("formats");
    for format in ["jsonl", "npy"] {
        folder.done(&SQUARE.replace("\"csv\"", &format!("\"{format}\"")), &[]);
    }
    let lines: Vec<Value> =
        folder.read("out/collisions.jsonl").lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((lines.len(), lines[3]["orbit"].as_u64(), lines[2]["x0"].as_f64()), (6, Some(1), Some(1.4375)));
    let npy = fs::read(folder.0.join("out/collisions.npy")).unwrap();
    assert!(npy.starts_with(b"\x93NUMPY"));
    // ten columns of eight bytes after the header; x0 is the fifth
    let data = &npy[10 + usize::from(u16::from_le_bytes([npy[8], npy[9]]))..];
    assert_eq!(data.len(), 6 * 80);
    assert_eq!(data[2 * 80 + 32..2 * 80 + 40], 1.4375_f64.to_le_bytes());
}

const CHAOS: &str = r#"
law = "no-slip"
[table]
name = "sinai"
[[orbit]]
position = [0.1, 0.15]
velocity = [0.6, 0.8]
spin = 0.1
[[orbit]]
position = [0.2, 0.15]
velocity = [-0.6, 0.5]
[run]
collisions = 20000
"#;

#[test]
fn an_orbit_is_the_same_whether_or_not_anybody_watches() {
    let folder = Folder::new("watched");
    let kept = |output: &str, arguments: &[&str]| {
        let summary = folder.done(&format!("{CHAOS}\n[output]\n{output}"), arguments);
        ["collisions", "time", "energy_drift", "stops"].map(|key| summary[key].clone())
    };
    // after twenty thousand collisions in a dispersing table, one different bit would have changed everything
    let bare = kept("", &[]);
    assert_eq!(kept("collisions = \"csv\"", &["--threads", "1"]), bare);
    assert_eq!(kept("pictures = [\"orbit\"]", &["--threads", "2"]), bare);
    assert_eq!(kept("pictures = [\"velocity-portrait\", \"phase-portrait\"]", &[]), bare);
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let folder = Folder::new("threads");
    let scene = r#"
law = "no-slip"
table = { name = "stadium" }
ensemble = { count = 300, seed = 7 }
run = { time = 40 }
output = { collisions = "csv" }
"#;
    let records: Vec<String> = ["1", "2", "5"]
        .map(|threads| {
            folder.done(scene, &["--threads", threads]);
            folder.read("out/collisions.csv")
        })
        .into();
    assert!(records[0].lines().count() > 3000);
    assert!(records.windows(2).all(|pair| pair[0] == pair[1]));
    // the start of an orbit depends on the seed and its own number: fewer orbits are the first of many
    folder.done(&scene.replace("count = 300", "count = 3"), &[]);
    assert!(records[0].starts_with(&folder.read("out/collisions.csv")));
    folder.done(&scene.replace("seed = 7", "seed = 8"), &[]);
    assert_ne!(records[0], folder.read("out/collisions.csv"));
}

#[test]
fn portraits_do_not_depend_on_who_counts_the_points() {
    let folder = Folder::new("portraits");
    // enough points that they are counted, and as few that they are dots; laws that keep the speed and one that does not
    for (law, collisions) in
        [("no-slip", 250), ("no-slip", 30), ("{ name = \"restitution\", normal = 0.99, tangential = 0 }", 250)]
    {
        let pictures = "pictures = [\"velocity-portrait\", \"phase-portrait\"]";
        let scene = format!(
            "law = {}\n[table]\nname = \"stadium\"\n[ensemble]\ncount = 301\nseed = 5\n[run]\n\
             collisions = {collisions}\n[output]\n{pictures}\n",
            if law.starts_with('{') { law.into() } else { format!("\"{law}\"") }
        );
        let drawn = |scene: &str, threads: &str| {
            folder.done(scene, &["--threads", threads]);
            let files = ["velocity-portrait.svg", "phase-portrait.svg"];
            files.map(|file| folder.read(&format!("out/{file}")))
        };
        let one = drawn(&scene, "1");
        assert_eq!(one[0].contains("<image"), collisions == 250);
        assert!(drawn(&scene, "2") == one);
        assert!(drawn(&scene, "5") == one);
        // with a record, every orbit runs on its own
        assert!(drawn(&format!("{scene}collisions = \"npy\"\n"), "2") == one);
    }
}

#[test]
fn a_time_limit_ends_orbits_at_that_time() {
    let folder = Folder::new("time");
    let summary = folder.done(&SQUARE.replace("collisions = 3", "time = 2.25"), &[]);
    assert_eq!((summary["time"].as_f64(), summary["collisions"].as_u64()), (Some(4.5), Some(4)));
    assert!(folder.rows().iter().all(|row| row[2] <= 2.25));
}

/// A stadium of radius `length` with speeds near `speed`, both powers of two or decimal powers.
fn stadium(length: f64, speed: f64) -> String {
    format!(
        "law = \"no-slip\"\n[table]\nname = \"stadium\"\nhalf_length = {length:e}\nradius = {length:e}\n\
         [[orbit]]\nposition = [{:e}, {:e}]\nvelocity = [{:e}, {:e}]\nspin = {:e}\nangle = {:e}\n\
         [run]\ncollisions = 300\n[output]\ncollisions = \"csv\"\npictures = [\"orbit\", \"phase-portrait\"]\n",
        0.125 * length,
        0.25 * length,
        0.5 * speed,
        0.75 * speed,
        0.25 * speed,
        0.5 * length
    )
}

#[test]
fn scenes_of_any_size_run_and_scale_to_the_last_digit() {
    let folder = Folder::new("scale");
    folder.done(&stadium(1.0, 1.0), &[]);
    let unit = folder.rows();
    for (a, b) in [(480, 480), (-480, 480), (480, -480), (-490, -490)] {
        let (length, speed) = (2.0_f64.powi(a), 2.0_f64.powi(b));
        folder.done(&stadium(length, speed), &[]);
        for (row, one) in folder.rows().iter().zip(&unit) {
            let back: Vec<f64> = (0..10)
                .map(|i| match i {
                    2 => row[i] / length * speed,
                    4..=6 => row[i] / length,
                    7..=9 => row[i] / speed,
                    _ => row[i],
                })
                .collect();
            assert_eq!(&back, one, "lengths 2^{a}, speeds 2^{b}");
        }
    }
    for (length, speed) in [(1e150, 2e-150), (2e-150, 1e150), (2e-150, 2e-150), (1e150, 1e150)] {
        let summary = folder.done(&stadium(length, speed), &[]);
        assert!(summary["energy_drift"].as_f64().unwrap() < 1e-14, "{length:e} {speed:e}");
        assert_eq!(summary["stops"]["finished"], 1);
    }
}

#[test]
fn other_tables_run_at_any_size_too() {
    let folder = Folder::new("sizes");
    let tables = [
        "[[table.boundary]]\ncurve = { polar = \"LENGTH*(1 + 0.1*cos(3*t))\" }",
        "[[table.boundary]]\ncurve = { implicit = \"(x/LENGTH)^2/4 + (y/LENGTH)^2 - 1\", within = [[-3*L, -2*L], [3*L, 2*L]] }",
        "[[table.boundary]]\nshape = { name = \"cuboid\", size = [2*L, 2*L], rounding = 0.25*L, domain = \"inside\" }",
        "[table]\nname = \"wedge\"\nangle = 1",
        "[table]\nname = \"sinai-torus\"\nradius = 0.25*L\nside = 2*L",
        "[table]\nname = \"box\"\ndimension = 3\nsize = [1*L, 2*L, 1*L]",
    ];
    for length in ["1e-140", "1", "1e140"] {
        for table in tables {
            let mut text = String::new();
            // 3*L as TOML has it: a formula
            for (i, part) in table.replace("LENGTH", length).split('*').enumerate() {
                if i > 0 {
                    text.push('*');
                }
                text += part;
            }
            let text = expressions(&text, length);
            let space = table.contains("dimension");
            let third = if space { format!(", \"0.3*{length}\"") } else { String::new() };
            let velocity = if space { "[0.5, 0.25, 0.7]" } else { "[0.5, 0.25]" };
            let scene = format!(
                "law = \"no-slip\"\n{text}\n[[orbit]]\nposition = [\"0.1*{length}\", \"0.3*{length}\"{third}]\n\
                 velocity = {velocity}\n[run]\ncollisions = 50\n[output]\npictures = [\"orbit\"]\n"
            );
            let summary = folder.done(&scene, &[]);
            assert!(summary["energy_drift"].as_f64().unwrap() < 1e-14, "{scene}");
        }
    }
}

/// Numbers like `3*L` as strings that hold formulas.
fn expressions(text: &str, length: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find("*L") {
        let start = rest[..at].rfind(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).map_or(0, |i| i + 1);
        out.extend([&rest[..start], "\"", &rest[start..at], "*", length, "\""]);
        rest = &rest[at + 2..];
    }
    out + rest
}

#[test]
fn positions_on_a_lattice_stay_in_the_unit_cell_and_cells_add_up() {
    let folder = Folder::new("lattice");
    let scene = |position: &str| {
        format!(
            "law = \"specular\"\n[table]\nname = \"sinai-torus\"\nradius = 0.25\n[[orbit]]\nposition = {position}\n\
             velocity = [1, 0.125]\n[run]\ncollisions = 20\n[output]\ncollisions = \"csv\"\n"
        )
    };
    folder.done(&scene("[0.125, 0.25]"), &[]);
    let header = folder.read("out/collisions.csv").lines().next().unwrap().to_owned();
    assert_eq!(header, "orbit,n,t,piece,x0,x1,x2,v0,v1,v2,cell1,cell2");
    let home = folder.rows();
    assert!(home.iter().all(|row| (0.0..1.0).contains(&row[5]) && (0.0..1.0).contains(&row[6])));
    // the first flight: position + cell is where the straight line from the start leads
    let lifted = [home[0][5] + home[0][10], home[0][6] + home[0][11]];
    assert!(
        (lifted[0] - (0.125 + home[0][2])).abs() < 1e-14 && (lifted[1] - (0.25 + 0.125 * home[0][2])).abs() < 1e-14
    );
    // the same start three cells on and two down: the same orbit there
    folder.done(&scene("[3.125, -1.75]"), &[]);
    for (there, here) in folder.rows().iter().zip(&home) {
        assert_eq!(there[..10], here[..10]);
        assert_eq!([there[10], there[11]], [here[10] + 3.0, here[11] - 2.0]);
    }
}

#[test]
fn a_piece_may_have_a_law_of_its_own() {
    let folder = Folder::new("laws");
    let scene = r#"
law = "no-slip"
[[table.boundary]]
loop = { from = [0, 0], edges = [
  { line_to = [1, 0], law = "specular" },
  { line_to = [1, 1] },
  { line_to = [0, 1] },
  { line_to = [0, 0] },
] }
[[orbit]]
position = [0.25, 0.5]
velocity = [0.25, -1]
spin = 0.5
[run]
collisions = 2
[output]
collisions = "csv"
"#;
    folder.done(scene, &[]);
    let rows = folder.rows();
    assert_eq!((rows[0][3], &rows[0][7..]), (0.0, &[0.5, 0.25, 1.0][..]), "smooth floor");
    assert_eq!(rows[1][3], 2.0);
    assert!(rows[1][7] != 0.5, "rough ceiling");
    // the law of the command line takes the place of the scene's, not of the piece's
    folder.done(&scene.replace("law = \"specular\"", "law = \"no-slip\""), &["--law", "specular"]);
    let rows = folder.rows();
    assert!(rows[0][7] != 0.5);
    assert_eq!(rows[1][7], rows[0][7]);
}

#[test]
fn a_disk_of_positive_radius_moves_within_the_walls_that_are_drawn() {
    let folder = Folder::new("disk");
    let scene = SQUARE.replace("[table]", "[particle]\nradius = 0.125\n[table]");
    folder.done(&scene, &[]);
    let rows = folder.rows();
    assert_eq!((rows[0][3], rows[0][5]), (1.0, 0.875), "the centre is a radius away from the wall it touches");
    assert_eq!(&rows[3][..7], &[1.0, 1.0, 0.375, 0.0, 0.0, 0.5, 0.125]);
}

#[test]
fn orbits_that_all_escape_are_no_failure() {
    let folder = Folder::new("escape");
    let scene = "law = \"no-slip\"\ntable = { boundary = [{ circle = { center = [0, 0], radius = 1, domain = \"outside\" } }] }\n\
                 orbit = [{ position = [2, 0], velocity = [1, 0] }, { position = [3, 0], velocity = [-1, 0] }]\n\
                 run = { collisions = 10 }\noutput = { pictures = [\"orbit\"] }";
    let summary = folder.done(scene, &[]);
    assert_eq!((summary["stops"]["escaped"].as_u64(), summary["collisions"].as_u64()), (Some(2), Some(1)));
}

#[test]
fn a_start_on_a_wall_is_accepted_if_it_moves_inwards() {
    let folder = Folder::new("wall");
    let start = |position: &str, velocity: &str| {
        SQUARE
            .replace("[0.25, 0.5]", position)
            .replace("[0.5, 0.25]", velocity)
            .replace("name = \"square\"", "name = \"mushroom\"")
            .replace("[0.5, 0.5]", "[0, 0.5]")
    };
    let refused = |position: &str, velocity: &str| {
        let output = folder.run(&start(position, velocity), &[]);
        assert_eq!(output.status.code(), Some(2), "{position} {velocity}");
        String::from_utf8(output.stderr).unwrap()
    };
    folder.done(&start("[0.5, 0]", "[0.5, 0.25]"), &[]);
    assert!(refused("[0.5, 0]", "[0.5, -0.25]").contains("does not move into the table"));
    assert!(refused("[0.5, 0]", "[0.5, 0]").contains("does not move into the table"));
    // at a corner that points out of the table, into it for both walls; at a re-entrant one, for either
    folder.done(&start("[1, 0]", "[-0.5, 0.25]"), &[]);
    assert!(refused("[1, 0]", "[0.5, 0.25]").contains("does not move into the table"));
    folder.done(&start("[0.25, 0]", "[0.5, 0.25]"), &[]);
    folder.done(&start("[0.25, 0]", "[-0.5, -0.25]"), &[]);
    assert!(refused("[0.25, 0]", "[0.5, -0.25]").contains("does not move into the table"));
    // within rounding of a wall is on it, whichever side
    folder.done(&start("[0.5, 1e-17]", "[0.5, 0.25]"), &[]);
    folder.done(&start("[0.5, -1e-17]", "[0.5, 0.25]"), &[]);
    assert!(refused("[0.5, -1e-9]", "[0.5, 0.25]").contains("outside the table"));
}

#[test]
fn what_is_wrong_is_said_with_its_place_and_nothing_is_written() {
    let folder = Folder::new("errors");
    let stadium = stadium(1.0, 1.0);
    let hand = r#"law = "no-slip"
[[table.boundary]]
loop = { from = [0, 0], edges = [
  { line_to = [1, 0] },
  { line_to = [1, 1] },
  { line_to = [0, 1] },
  { line_to = [0, 0] },
] }
[[table.boundary]]
circle = { center = [0.5, 0.5], radius = 0.25, domain = "outside" }
[[orbit]]
position = [0.125, 0.125]
velocity = [1, 0]
[run]
collisions = 1
"#;
    let cases: &[(&str, &str, &str, &str, &str)] = &[
        // scene, what stands there, what to write instead, place, message
        (
            &stadium,
            "position = [1.25e-1, 2.5e-1]",
            "position = [0, 2]",
            "scene.toml:7:12",
            "the start lies outside the table",
        ),
        (&stadium, "radius = 1e0", "radius = -1", "scene.toml:5:10", "-1 is not positive"),
        (&stadium, "\"stadium\"", "\"stadiun\"", "scene.toml:3:8", "did you mean \"stadium\"?"),
        (&stadium, "half_length", "half_lenght", "scene.toml:4:1", "did you mean \"half_length\"?"),
        (
            &stadium,
            "[run]",
            "[particle]\nradius = 1.5\ninertia = \"hoop\"\n[run]",
            "scene.toml:12:10",
            "a disk of radius 1.5",
        ),
        (
            &stadium,
            "[run]",
            "[particle]\nradius = 0.9\ninertia = \"hoop\"\n[run]",
            "scene.toml:7:12",
            "a disk of radius 0.9 does not fit there",
        ),
        (
            &stadium,
            "[run]",
            "[particle]\nradius = 0.5\n[run]",
            "scene.toml:11:1",
            "[particle] needs \"inertia\" or \"gamma_squared\"",
        ),
        (hand, "radius = 0.25", "radius = 0.6", "scene.toml:10:10", "cross"),
        (hand, "  { line_to = [0, 0] },\n", "", "scene.toml:6:15", "the loop is open"),
        (hand, "[1, 1] },", "[1, 0] },", "scene.toml:5:3", "no length"),
        (
            hand,
            "radius = 0.25, domain = \"outside\"",
            "radius = 0.25, domain = \"inside\"",
            "scene.toml:10:10",
            "table on its",
        ),
        (hand, "[0.125, 0.125]", "[0.5, 0.5]", "scene.toml:12:12", "outside the table"),
        (hand, "[run]", "[output]\npictures = [\"orbits\"]\n[run]", "scene.toml:15:13", "did you mean \"orbit\"?"),
        (hand, "velocity = [1, 0]", "velocity = [0, 0]", "scene.toml:13:12", "zero vector"),
        (hand, "velocity = [1, 0]", "velocity = [nan, 0]", "scene.toml:13:13", "NaN"),
        (hand, "velocity = [1, 0]", "velocity = [\"1+\", 0]", "scene.toml:13:16", "expression ends"),
        (
            hand,
            "[[table.boundary]]\nloop",
            "[table]\nlaws = { 5 = \"specular\" }\n[[table.boundary]]\nloop",
            "scene.toml:3:10",
            "there is no piece 5",
        ),
    ];
    for (scene, from, to, place, message) in cases {
        assert!(scene.contains(from), "{from}");
        let output = folder.run(&scene.replacen(from, to, 1), &[]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{to}: {text}");
        assert!(text.contains(&format!("{place}: error: ")), "{to}: {place} expected in\n{text}");
        assert!(text.contains(message), "{to}: \"{message}\" expected in\n{text}");
        assert!(output.stdout.is_empty() && !folder.0.join("out").exists(), "{to}");
    }
}

#[test]
fn errors_give_lengths_in_the_units_of_the_scene() {
    let folder = Folder::new("units");
    let scene = "law = \"specular\"\ntable = { name = \"moon\", radius = 1000, bite_radius = 750, bite_distance = 5000 }\n\
                 orbit = [{ position = [0, 0], velocity = [1, 0] }]\nrun = { collisions = 1 }";
    let text = String::from_utf8(folder.run(scene, &[]).stderr).unwrap();
    assert!(text.contains("scene.toml:2:"), "{text}");
    assert!(text.contains("bite_distance must be") && text.contains("not 5000"), "{text}");
}

#[test]
fn a_command_line_that_makes_no_sense_is_bad_input() {
    let folder = Folder::new("usage");
    for arguments in [&["-n", "0"][..], &["-n", "1.5"], &["--law", "nonslip"], &["--threads", "0"], &["--nonsense"]] {
        assert_eq!(folder.run(SQUARE, arguments).status.code(), Some(2), "{arguments:?}");
    }
    let mut command = Command::cargo_bin("billiards").unwrap();
    let output = command.current_dir(&folder.0).args(["run", "missing.toml"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("missing.toml"));
}

#[test]
fn a_folder_that_cannot_be_written_is_a_failure() {
    let folder = Folder::new("blocked");
    fs::write(folder.0.join("out"), "a file where a folder should be").unwrap();
    let output = folder.run(SQUARE, &[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("error: out:"));
    assert_eq!(folder.read("out"), "a file where a folder should be");
}

/// Sends an interrupt to a run that would take weeks.
#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_is_done() {
    let folder = Folder::new("interrupt");
    fs::write(folder.0.join("scene.toml"), CHAOS).unwrap();
    let mut run = std::process::Command::new(assert_cmd::cargo::cargo_bin("billiards"))
        .current_dir(&folder.0)
        .args(["run", "scene.toml", "-n", "1e12", "--threads", "1"])
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    // only after the handler is in place: a file of another run tells nothing, so wait for the first second to pass
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let sent = std::process::Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    assert!(sent.success());
    assert_eq!(run.wait().unwrap().code(), Some(0));
    let summary = folder.summary("out/scene");
    assert_eq!(summary["stops"]["interrupted"], 2);
    assert!(summary["collisions"].as_u64().unwrap() > 1000);
}

#[test]
fn pictures_are_well_formed_and_dense_ones_come_as_pixels_too() {
    let folder = Folder::new("pictures");
    let scene = format!("{CHAOS}\n[output]\npictures = [\"orbit\", \"velocity-portrait\", \"phase-portrait\"]\n");
    folder.done(&scene, &[]);
    for name in ["orbit", "velocity-portrait", "phase-portrait"] {
        let svg = folder.read(&format!("out/{name}.svg"));
        let options = roxmltree::ParsingOptions { allow_dtd: false, ..roxmltree::ParsingOptions::default() };
        let document = roxmltree::Document::parse_with_options(&svg, options).unwrap();
        assert_eq!(document.root_element().tag_name().name(), "svg");
        let png: &Path = &folder.0.join(format!("out/{name}.png"));
        assert_eq!(png.exists(), name != "orbit", "{name}");
    }
}

#[test]
fn every_shape_bounds_a_table_from_outside() {
    let folder = Folder::new("shapes");
    let planar = [
        ("ball", "radius = 1"),
        ("cuboid", "size = [2, 1], angle = 0.3"),
        ("cuboid", "size = [2, 1], rounding = 0.25"),
        ("capsule", "from = [-1, 0], to = [1, 0.5], radius = 0.5"),
        ("segment", "from = [-1, 0], to = [1, 0.5]"),
        ("triangle", "points = [[-1, 0], [1, 0], [0, 1]]"),
        ("triangle", "points = [[-1, 0], [1, 0], [0, 1]], rounding = 0.25"),
        ("convex-polygon", "points = [[-1, 0], [0, -1], [1, 0], [0, 1]]"),
        ("convex-polygon", "points = [[-1, 0], [0, -1], [1, 0], [0, 1]], rounding = 0.25"),
        ("polygon", "points = [[-1, 0], [1, 0], [0, 0.25], [0, 1]]"),
        ("polygon", "points = [[-1, 0], [1, 0], [0, 0.25], [0, 1]], rounding = 0.125"),
        ("polyline", "points = [[-1, 0], [0, 0.25], [1, 0]]"),
        ("polyline", "points = [[-1, 0], [0, 0.25], [1, 0]], rounding = 0.125"),
        ("trimesh", "points = [[-1, 0], [1, 0], [0, 1], [0, -1]], triangles = [[0, 1, 2], [0, 3, 1]]"),
        (
            "compound",
            "shapes = [{ name = \"ball\", radius = 1 }, { name = \"cuboid\", size = [3, 0.5], center = [0, 0.5] }]",
        ),
    ];
    let solid = [
        ("ball", "radius = 1"),
        ("cuboid", "size = [2, 1, 1]"),
        ("cuboid", "size = [2, 1, 1], rounding = 0.25"),
        ("capsule", "from = [-1, 0, 0], to = [1, 0, 0], radius = 0.5"),
        ("cylinder", "radius = 1, height = 1"),
        ("cylinder", "radius = 1, height = 1, rounding = 0.125"),
        ("cone", "radius = 1, height = 1"),
        ("convex-hull", "points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
        ("half-space", "normal = [0, 0, -1], center = [0, 0, 2]"),
        (
            "trimesh",
            "points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], \
             triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]",
        ),
    ];
    let scene = |n: usize, name: &str, parameters: &str| {
        let (dimension, around, position, velocity) = if n == 2 {
            ("", "circle = { center = [0, 0], radius = 4 }", "[-2.5, -1.5]", "[0.8, 0.61]")
        } else {
            ("dimension = 3", "sphere = { center = [0, 0, 0], radius = 4 }", "[-2, -1, -1]", "[0.8, 0.41, 0.43]")
        };
        format!(
            "law = \"no-slip\"\n[table]\n{dimension}\n[[table.boundary]]\n{around}\n[[table.boundary]]\n\
             shape = {{ name = \"{name}\", {parameters} }}\n[[orbit]]\nposition = {position}\nvelocity = {velocity}\n\
             [run]\ncollisions = 200\n[output]\ncollisions = \"csv\"\npictures = [\"orbit\"]\n"
        )
    };
    for (n, shapes) in [(2, &planar[..]), (3, &solid[..])] {
        for (name, parameters) in shapes {
            let summary = folder.done(&scene(n, name, parameters), &[]);
            assert_eq!(summary["stops"]["finished"], 1, "{name} {parameters}: {}", summary["stops"]);
            assert!(summary["energy_drift"].as_f64().unwrap() < 1e-14, "{name} {parameters}");
            let pieces: Vec<f64> = folder.rows().iter().map(|row| row[3]).collect();
            assert!(pieces.contains(&0.0) && pieces.iter().any(|piece| *piece > 0.0), "{name} {parameters}: never hit");
        }
    }
}
