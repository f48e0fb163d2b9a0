//! What is refused, and in which words.

use std::fs;

use assert_cmd::Command;

use super::{Folder, SQUARE, scale::stadium};

/// A flat torus with a disk.
const TORUS: &str = r#"law = "specular"
[table]
lattice = [[1, 0], [0, 1]]
[[table.boundary]]
circle = { center = [0.5, 0.5], radius = 0.25, domain = "outside" }
[[orbit]]
position = [0, 0.125]
velocity = [1, 0]
[run]
collisions = 1
"#;

/// A table drawn by hand.
const HAND: &str = r#"law = "no-slip"
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

#[test]
fn of_very_many_mistakes_the_first_are_shown_and_the_others_counted() {
    let folder = Folder::new("many-mistakes");
    for (count, end) in [(20, "float64"), (21, "\n\nand 1 more error\n"), (3000, "\n\nand 2980 more errors\n")] {
        let orbits = "[[orbit]]\nposition = [0.5, 0.5]\nvelocity = [\"np.float64(1)\", 0]\n".repeat(count);
        let output = folder.run(&SQUARE.replacen("[[orbit]]", &format!("{orbits}[[orbit]]"), 1), &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), told.matches("error: ").count()), (Some(2), 20), "{told}");
        assert!(told.contains(end) && told.contains("more error") == (count > 20), "{told}");
    }
}

#[test]
fn a_run_replaces_no_file_that_its_scene_reads() {
    const DRAWING: &str = "<svg><rect width='4' height='2'/></svg>";
    let folder = Folder::new("own-input");
    let wall = "[[table.boundary]]\noutline = \"orbit.svg\"\n";
    let orbit = "[[orbit]]\nposition = [1, -1]\nvelocity = [1, 0.5]\n[run]\ncollisions = 3\n";
    let scene = format!("law = \"specular\"\n{wall}{orbit}[output]\npictures = [\"orbit\"]\n");
    fs::write(folder.0.join("orbit.svg"), DRAWING).unwrap();
    let run = |name: &str, out: &str| {
        fs::write(folder.0.join(name), &scene).unwrap();
        let mut command = Command::cargo_bin("billiards").unwrap();
        let output = command.current_dir(&folder.0).args(["run", name, "--out", out]).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    fs::create_dir(folder.0.join("deep")).unwrap();
    for (name, out, places) in [
        ("scene.toml", ".", &["scene.toml:3:11: error: this run would write a file of its own"][..]),
        ("scene.toml", "deep/..", &["scene.toml:3:11: error: "]),
        ("summary.json", ".", &["summary.json: error: this run", "summary.json:3:11: error: "]),
    ] {
        let (status, told) = run(name, out);
        assert!(status == Some(2) && places.iter().all(|place| told.contains(place)), "{told}");
        assert!(told.contains("--out DIR"), "{told}");
        assert_eq!((&folder.read("orbit.svg")[..], &folder.read(name)), (DRAWING, &scene));
    }
    assert_eq!(run("scene.toml", "out").0, Some(0));
    #[cfg(unix)]
    {
        // a link of the drawing's name is replaced, but not what it leads to; a drawing behind a link is
        std::os::unix::fs::symlink("../orbit.svg", folder.0.join("deep/orbit.svg")).unwrap();
        assert_eq!(run("scene.toml", "deep").0, Some(0));
        assert_eq!(folder.read("orbit.svg"), DRAWING);
        fs::rename(folder.0.join("orbit.svg"), folder.0.join("deep/orbit.svg")).unwrap();
        std::os::unix::fs::symlink("deep/orbit.svg", folder.0.join("orbit.svg")).unwrap();
        assert_eq!(["deep", "."].map(|out| run("scene.toml", out).0), [Some(2); 2]);
        assert_eq!(folder.read("orbit.svg"), DRAWING);
    }
}

#[test]
fn a_folder_in_place_of_a_file_is_told_before_the_work() {
    for name in ["summary.json", "collisions.csv", "orbit.svg", "velocity-portrait.png", "phase-portrait.svg"] {
        let folder = Folder::new("folder-for-file");
        fs::create_dir_all(folder.0.join("out").join(name)).unwrap();
        let pictures = "pictures = [\"orbit\", \"velocity-portrait\", \"phase-portrait\"]\n";
        let output = folder.run(&format!("{SQUARE}{pictures}"), &[]);
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(told.contains(&format!("{name} is a folder, not a file")), "{told}");
        assert_eq!(output.status.code(), Some(1));
        assert_eq!(fs::read_dir(folder.0.join("out")).unwrap().count(), 1, "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_made_is_told_with_a_mend() {
    let folder = Folder::new("no-folder");
    fs::write(folder.0.join("scene.toml"), SQUARE).unwrap();
    let long = "x".repeat(300);
    for (out, mend) in [(&*long, "a shorter name"), ("/proc/x", "name another one, --out DIR")] {
        let mut command = Command::cargo_bin("billiards").unwrap();
        let output = command.current_dir(&folder.0).args(["run", "scene.toml", "--out", out]).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(
            output.status.code() == Some(1) && told.lines().nth(1).is_some_and(|help| help.contains(mend)),
            "{told}"
        );
    }
}

#[test]
fn a_file_without_walls_is_told_to_have_none() {
    let folder = Folder::new("no-walls");
    fs::write(folder.0.join("points.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\n").unwrap();
    fs::write(folder.0.join("nothing.json"), "{ \"type\": \"FeatureCollection\", \"features\": [] }").unwrap();
    for (table, start, file) in [
        ("dimension = 3, boundary = [{ mesh = { file = \"points.obj\" } }]", "[0, 0, 1]", "points.obj"),
        ("boundary = [{ outline = \"nothing.json\" }]", "[0, 1]", "nothing.json"),
    ] {
        let orbit = format!("orbit = [{{ position = {start}, velocity = {start} }}]");
        let scene = format!("law = \"specular\"\ntable = {{ {table} }}\n{orbit}\nrun = {{ collisions = 1 }}\n");
        let output = folder.run(&scene, &[]);
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(told.contains(&format!("{file}: it contains no walls")), "{told}");
        assert_eq!(output.status.code(), Some(2));
    }
}

#[test]
fn a_circle_too_far_from_the_origin_is_told_to_move_nearer() {
    let folder = Folder::new("far-circle");
    let scene = "law = \"specular\"\n[[table.boundary]]\ncircle = { center = [1e15, 0], radius = 0.25 }\n[[orbit]]\nposition = [1e15, 0]\n\
                 velocity = [1, 0]\n[run]\ncollisions = 3\n";
    fs::write(folder.0.join("scene.toml"), scene).unwrap();
    let output =
        Command::cargo_bin("billiards").unwrap().current_dir(&folder.0).args(["run", "scene.toml"]).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains("scene.toml:3") && text.contains("move it nearer to the origin"), "{text}");
}

#[test]
fn what_is_wrong_is_said_with_its_place_and_nothing_is_written() {
    let folder = Folder::new("errors");
    let stadium = stadium(1.0, 1.0);
    let cases: &[(&str, &str, &str, &str, &str)] = &[
        // scene, what stands there, what to write instead, place, message
        (
            &stadium,
            "position = [1.25e-1, 2.5e-1]",
            "position = [0, 2]",
            "scene.toml:7:12",
            "the start lies outside the table",
        ),
        (
            HAND,
            "  { line_to = [1, 0] },",
            "  { line_to = [2, 0] },\n  { line_to = [1, 0] },",
            "scene.toml:5:3",
            "piece 1 runs there and back near (1, 0), where the table lies on neither side of it",
        ),
        (
            HAND,
            "circle = { center = [0.5, 0.5], radius = 0.25, domain = \"outside\" }",
            "ray = { from = [3, 0], direction = [1, 0] }",
            "scene.toml:10:7",
            "the boundary is open: piece 4 starts 2.0 away from the nearest end of another piece",
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
        (HAND, "radius = 0.25", "radius = 0.6", "scene.toml:10:10", "cross"),
        (HAND, "  { line_to = [0, 0] },\n", "", "scene.toml:6:15", "the loop is open"),
        (HAND, "[1, 1] },", "[1, 0] },", "scene.toml:5:3", "no length"),
        (
            HAND,
            "radius = 0.25, domain = \"outside\"",
            "radius = 0.25, domain = \"inside\"",
            "scene.toml:10:10",
            "table on its",
        ),
        (
            HAND,
            "circle = { center = [0.5, 0.5], radius = 0.25, domain = \"outside\" }",
            "curve = { implicit = \"abs(x-1)+abs(y)-1\", within = [[-1, -2], [3, 2]] }",
            "scene.toml:10:22",
            "be smooth",
        ),
        (
            HAND,
            "circle = { center = [0.5, 0.5], radius = 0.25, domain = \"outside\" }",
            "shape = { name = \"polyline\", points = [[0.2, 0.2], [0.4, 0.2], [0.3, 0.4], [0.2, 0.2]] }",
            "scene.toml:10:76",
            "would be solid inside",
        ),
        (HAND, "[0.125, 0.125]", "[0.5, 0.5]", "scene.toml:12:12", "outside the table"),
        (HAND, "[run]", "[output]\npictures = [\"orbits\"]\n[run]", "scene.toml:15:13", "did you mean \"orbit\"?"),
        (HAND, "velocity = [1, 0]", "velocity = [0, 0]", "scene.toml:13:12", "zero vector"),
        (HAND, "velocity = [1, 0]", "velocity = [nan, 0]", "scene.toml:13:13", "NaN"),
        (HAND, "velocity = [1, 0]", "velocity = [\"1+\", 0]", "scene.toml:13:16", "expression ends"),
        (
            HAND,
            "[[table.boundary]]\nloop",
            "[table]\nlaws = { 5 = \"specular\" }\n[[table.boundary]]\nloop",
            "scene.toml:3:10",
            "there is no piece 5",
        ),
    ];
    refused(&folder, cases);
}

#[test]
fn a_start_from_which_rounding_decides_what_is_hit_is_told_to_come_nearer() {
    let folder = Folder::new("remote");
    let disk = "[[table.boundary]]\ncircle = { center = [0, 0], radius = 1, domain = \"outside\" }\n";
    let tiny = disk.replace("radius = 1", "radius = 1e-4");
    let sphere = "[table]\ndimension = 3\n[[table.boundary]]\nsphere = { center = [0, 0, 0], radius = 1, domain = \"outside\" }\n";
    let cuboid = "[table]\ndimension = 3\n[[table.boundary]]\nshape = { name = \"cuboid\", size = [2, 2, 2] }\n";
    let scene = |walls: &str, position: &str, velocity: &str| {
        format!(
            "law = \"specular\"\n{walls}[[orbit]]\nposition = {position}\nvelocity = {velocity}\n[run]\ncollisions = 1\n\
             [output]\ncollisions = \"csv\"\n"
        )
    };
    for (walls, position, velocity) in [
        (disk, "[1e16, 0.25]", "[-1, 0]"),
        (disk, "[1e30, 0.25]", "[-1, 0]"),
        (disk, "[1e120, 0.25]", "[-1, 0]"),
        (&tiny, "[1e150, 0]", "[-1, 0]"),
        (sphere, "[1e16, 0.25, 0.5]", "[-1, 0, 0]"),
        (cuboid, "[1e16, 0.25, 0.5]", "[-1, 0, 0]"),
        (cuboid, "[1e130, 0.25, 0.5]", "[-1, 0, 0]"),
    ] {
        let told = String::from_utf8(folder.run(&scene(walls, position, velocity), &[]).stderr).unwrap();
        assert!(
            told.contains("rounding decides what it hits") && told.contains("help: move the start along"),
            "{told}"
        );
    }
    let told = String::from_utf8(folder.run(&scene(disk, "[1e16, 0.25]", "[-1, 0]"), &[]).stderr).unwrap();
    assert!(
        told.contains("scene.toml:5:12") && told.contains("multiples of 2, and all bounded walls together are 2"),
        "{told}"
    );
    // as it is told, and where there is nothing to be decided
    folder.done(&scene(disk, "[1e3, 0.25]", "[-1, 0]"), &[]);
    let hit = &folder.rows()[0];
    assert!((hit[5] - libm::sqrt(0.9375)).abs() < 1e-12 && (hit[6] - 0.25).abs() < 1e-12, "{hit:?}");
    let below = format!("{disk}[[table.boundary]]\nline = {{ through = [0, -2], direction = [1, 0] }}\n");
    for (walls, position, velocity, stop) in [
        (disk, "[1e16, 0.25]", "[1, 0]", "escaped"),
        (disk, "[1e16, 0.25]", "[-1, 1]", "escaped"),
        (&below, "[1e16, 1000]", "[0, -1]", "finished"),
    ] {
        assert_eq!(folder.done(&scene(walls, position, velocity), &[])["stops"][stop], 1, "{position} {velocity}");
    }
}

#[test]
fn rays_too_close_together_to_be_told_apart_are_no_wedge() {
    let folder = Folder::new("thin-wedge");
    let scene = |table: &str| {
        format!(
            "law = \"no-slip\"\n{table}\n[[orbit]]\nposition = [0, 1]\nvelocity = [0.6, -0.8]\n[run]\ncollisions = 3\n\
             [output]\ncollisions = \"csv\"\n"
        )
    };
    let wedge = |angle: f64| scene(&format!("[table]\nname = \"wedge\"\nangle = {angle:e}"));
    let rays = |x: f64| {
        let ray = |x: f64, side: &str| {
            format!("[[table.boundary]]\nray = {{ from = [0, 0], direction = [{x:e}, 1], domain = \"{side}\" }}\n")
        };
        scene(&(ray(x, "left") + &ray(-x, "right")))
    };
    for angle in [1e-150, 1e-16, 3e-16, 8e-16] {
        for thin in [wedge(angle), rays(0.5 * angle)] {
            let told = String::from_utf8(folder.run(&thin, &[]).stderr).unwrap();
            assert!(
                told.contains("pieces 0 and 1 run along each other") && told.contains("help: "),
                "{angle:e}: {told}"
            );
        }
    }
    for thin in [wedge(1e-15), rays(5e-16)] {
        assert_eq!(folder.done(&thin, &[])["stops"]["finished"], 1);
        let hit = &folder.rows()[0];
        assert!(hit[3] == 0.0 && (hit[2] / (5e-16 / 0.6) - 1.0).abs() < 1e-9, "{hit:?}");
    }
}

#[test]
fn a_line_or_ray_with_the_table_on_its_right_is_told_to_be_turned() {
    let folder = Folder::new("turned");
    let scene = |walls: &[String], at: &str| {
        let walls = walls.iter().map(|wall| format!("[[table.boundary]]\n{wall}\n")).collect::<Vec<_>>().concat();
        format!("law = \"specular\"\n{walls}[[orbit]]\nposition = {at}\nvelocity = [0.6, 0.8]\n[run]\ncollisions = 1\n")
    };
    let told = |scene: &str| String::from_utf8(folder.run(scene, &[]).stderr).unwrap();
    let line = |height: u32, x: i32| format!("line = {{ through = [0, {height}], direction = [{x}, 0] }}");
    let same = told(&scene(&[line(0, 1), line(1, 1)], "[0, 2]"));
    assert!(same.contains("has the table on its right") && same.contains("help: reverse its `direction`"), "{same}");
    for (walls, at, stop) in
        [([line(0, -1), line(1, 1)], "[0, 2]", "escaped"), ([line(0, 1), line(1, -1)], "[0, 0.5]", "finished")]
    {
        assert_eq!(folder.done(&scene(&walls, at), &[])["stops"][stop], 1);
    }
    let wedge = |height: u32, sides: [&str; 2]| {
        [("1", sides[0]), ("-1", sides[1])]
            .map(|(x, side)| format!("ray = {{ from = [0, {height}], direction = [{x}, 1], domain = \"{side}\" }}"))
    };
    let both = |upper: [&str; 2]| [wedge(0, ["left", "right"]), wedge(1, upper)].concat();
    let inside = told(&scene(&both(["left", "right"]), "[0, 0.5]"));
    assert!(
        inside.contains("has the table on its right") && inside.contains("help: exchange \"left\" and"),
        "{inside}"
    );
    folder.done(&scene(&both(["right", "left"]), "[0, 0.5]"), &[]);
}

#[test]
fn what_is_too_far_away_for_a_lattice_is_told() {
    let cases = [
        (
            TORUS,
            "center = [0.5, 0.5]",
            "center = [1e16, 0]",
            "scene.toml:5:10",
            "piece 0 lies 1e16 cells of the lattice away",
        ),
        (
            TORUS,
            "position = [0, 0.125]",
            "position = [0, 1e20]",
            "scene.toml:7:12",
            "lies 1e20 cells of the lattice away",
        ),
    ];
    refused(&Folder::new("far-away"), &cases);
}

/// Each of these scenes, with something else in place of what stands there, is refused with a place and a message.
fn refused(folder: &Folder, cases: &[(&str, &str, &str, &str, &str)]) {
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
fn a_polar_formula_without_a_radius_somewhere_is_refused_at_once() {
    let folder = Folder::new("no-radius");
    for (formula, column, message) in [
        ("2+0.2*sqrt(sin(t)+0.99)", 26, "near t = 4.5743: sqrt of the negative number"),
        ("2+0.2*asin(sin(t)*1.0000001)", 26, "near t = 1.5706: asin of 1.00000008"),
        ("2+0.5*sqrt(cos(2*t))", 26, "near t = 0.7946: sqrt of the negative number"),
        ("2+0.5*cos(t)^0.5", 32, "near t = 1.5800: the negative number"),
        ("2+0.2*cos(t)^1.5", 32, "to the power 1.5, which is not an integer"),
        ("2+0.2*cos(t)^(1/3)", 32, "near t = 1.5800: the negative number"),
        ("2+0.2*sqrt(cos(t))", 26, "near t = 1.5800: sqrt of the negative number"),
        ("2+sqrt(1-2)*cos(t)", 22, "sqrt of the negative number -1"),
        ("2+3*cos(t)", 19, "r(φ) must be positive and finite at every angle; near φ = 2.3017 it is -0.00"),
        ("2+0.2*sqrt(1-cos(t)^2)", 19, "write kinks with abs"),
        ("2+0.1*atan(tan(t))", 19, "the curve is open: r(φ) jumps from 2.157"),
        ("2+0.1*atan2(sin(t),cos(t))", 19, "at φ = 3.1416"),
        ("1e160*(2+cos(t))", 19, "lengths lie between 1e-150 and 1e150"),
        ("1e-160*(2+cos(t))", 19, "lengths lie between 1e-150 and 1e150"),
    ] {
        let scene = format!(
            "law = \"no-slip\"\n[[table.boundary]]\ncurve = {{ polar = \"{formula}\" }}\n\
             [[orbit]]\nposition = [0.01, 0.02]\nvelocity = [1, 0.35]\n[run]\ncollisions = 3000\n"
        );
        fs::write(folder.0.join("scene.toml"), scene).unwrap();
        let mut command = Command::cargo_bin("billiards").unwrap();
        let minute = std::time::Duration::from_secs(60);
        let output = command.current_dir(&folder.0).args(["run", "scene.toml"]).timeout(minute).output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{formula}: {text}");
        assert!(text.contains(&format!("scene.toml:3:{column}: error: ")), "{formula}: {column} expected in\n{text}");
        assert!(text.contains(message), "{formula}: \"{message}\" expected in\n{text}");
    }
}

#[test]
fn what_a_formula_lacks_is_told_with_the_place_and_the_mend() {
    let folder = Folder::new("formulas");
    for (curve, radius, place, message, mend) in [
        (
            "implicit = \"x^2+y^2-0.3*abs(x+0.1*y)-1\", within = [[-1.6, -1.6], [1.6, 1.6]]",
            0.2,
            "5:10",
            "a disk of radius 0.2: piece 0 has a kink near (",
            "write kinks with abs",
        ),
        ("polar = \"2+0.1*asin(sin(t))\"", 0.0, "3:19", "r(φ) has a kink near φ = 1.5708", "write kinks with abs"),
        ("polar = \"1+0.3*abs(cos(t))^0.9\"", 0.1, "5:10", "piece 0 has a kink near (", "take radius = 0"),
        ("polar = \"1+0.1*abs(cos(3*t))^0.5\"", 0.03, "5:10", "piece 0 has a kink near (", "take radius = 0"),
        ("polar = \"1+0.3*abs(cos(t))^1.1\"", 0.02, "5:10", "piece 0 has a kink near (", "take radius = 0"),
        ("polar = \"2-0.3*abs(cos(1.5*t+0.2))^1.2\"", 0.1, "5:10", "radius of curvature is smaller", "another radius"),
        (
            "implicit = \"(x-333.3)^2+(y-77.7)^2-1\", within = [[-1000, -1000], [1000, 1000]]",
            0.0,
            "3:22",
            "no curve was found in the box",
            "draw that box closer",
        ),
        ("implicit = \"x^2+y^2-1\", within = [[-2, -2], [0.3, 2]]", 0.0, "3:22", "stay in its box", "`within` larger"),
    ] {
        let scene = format!(
            "law = \"specular\"\n[[table.boundary]]\ncurve = {{ {curve} }}\n[particle]\nradius = {radius:?}\n\
             [[orbit]]\nposition = [0.01, 0.02]\nvelocity = [1, 0.35]\n[run]\ncollisions = 30\n"
        );
        let output = folder.run(&scene, &[]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{curve}: {text}");
        assert!(text.contains(&format!("scene.toml:{place}: error: ")), "{curve}: {place} expected in\n{text}");
        assert!(
            text.contains(message) && text.contains(mend),
            "{curve}: \"{message}\", \"{mend}\" expected in\n{text}"
        );
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
fn a_file_that_is_not_there_is_mended_by_the_name_of_one_that_is() {
    let folder = Folder::new("misnamed");
    fs::write(folder.0.join("outlines.svg"), "<svg/>").unwrap();
    let wall = "law = \"specular\"\n[[table.boundary]]\noutline = \"outline.svg\"\n\
                [[orbit]]\nposition = [0, 0]\nvelocity = [1, 0]\n[run]\ncollisions = 1\n";
    let text = String::from_utf8(folder.run(wall, &[]).stderr).unwrap();
    assert!(text.contains("scene.toml:3:11: error: cannot read") && text.contains("outlines.svg\"?"), "{text}");
    let mut command = Command::cargo_bin("billiards").unwrap();
    let output = command.current_dir(&folder.0).args(["run", "scen.toml"]).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.starts_with("scen.toml: error: cannot read it: "), "{text}");
    assert!(text.ends_with("\nhelp: did you mean \"scene.toml\"?\n"), "{text}");
}

#[test]
fn a_folder_that_cannot_be_written_is_a_failure() {
    let folder = Folder::new("blocked");
    fs::write(folder.0.join("out"), "a file where a folder should be").unwrap();
    let output = folder.run(SQUARE, &[]);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(
        text.starts_with("error: out:")
            && text.contains("help: there is a file, or a link that leads nowhere, where a folder should be"),
        "{text}"
    );
    assert_eq!(folder.read("out"), "a file where a folder should be");
}

#[test]
fn advice_names_what_the_scene_has_and_works_when_followed() {
    let folder = Folder::new("advice");
    let scene =
        |table: &str| format!("law = \"specular\"\n[table]\n{table}\n[ensemble]\ncount = 10\n[run]\ncollisions = 10\n");
    let entry = |entry: &str| format!("[[table.boundary]]\n{entry}");
    let square = "loop = { from = [0, 0], edges = [{ line_to = [1, 0], law = \"specular\" }, { line_to = [0, 1] }, \
                  { line_to = [0, 0] }] }";
    for (table, place, message, help) in [
        ("name = \"lorentz\"".into(), "2:1", "radius", "radius = 0.45"),
        ("name = \"channel\"".into(), "2:1", "sagitta", "sagitta = 0.125"),
        ("name = \"wedge\"".into(), "2:1", "angle", "angle = 1"),
        (
            "name = \"triangle\"\nvertices = [[0, 0], [0, 1], [1, 0]]".into(),
            "4:12",
            "the vertices run clockwise",
            "exchange two of them",
        ),
        (
            "name = \"triangle\"\nvertices = [[0, 0], [1, 0], [2, 0]]".into(),
            "4:12",
            "the vertices lie on one line",
            "move one of them off it",
        ),
        ("name = \"isosceles\"\nheight = 1e15".into(), "3:8", "run along each other", "it is less thin"),
        ("name = \"wedge\"\nangle = 5e-16".into(), "3:8", "run along each other", "it is less thin"),
        (
            entry("ellipse = { center = [0, 0], semi_axes = [1000, 1e-8] }"),
            "4:11",
            "its shorter semi-axis is 1e-8, and must be at least 2.32831e-7",
            "make it less flat",
        ),
        ("name = \"ellipse\"\nsemi_axes = [1e80, 1e-80]".into(), "3:8", "too flat", "it is less thin"),
        ("name = \"ellipse\"\nsemi_axes = [1e100, 1e-100]".into(), "3:8", "too flat", "it is less thin"),
        (
            entry("shape = { name = \"segment\", from = [0, 0], to = [0, 0] }"),
            "4:9",
            "to must be another point than from",
            "",
        ),
        (
            entry("shape = { name = \"triangle\", points = [[0, 0], [1, 0], [2, 0]] }"),
            "4:9",
            "points must be the corners of a convex polygon",
            "",
        ),
        (
            entry("curve = { polar = \"1e160\" }"),
            "4:19",
            "near t = 0.0000 the radius is 1e160",
            "between 1e-150 and 1e150",
        ),
        (entry("curve = { polar = \"1+0.1*cos(100000*t)\" }"), "4:19", "thousands of times", "take fewer waves"),
        (
            format!("laws = {{ 0 = \"no-slip\" }}\n{}", entry(square)),
            "3:10",
            "piece 0 has a law of its own where it is drawn",
            "leave out one of the two laws",
        ),
        (
            "name = \"circle\"\nradius = -1".into(),
            "4:10",
            "-1 is not positive",
            "write a number between 1e-150 and 1e150",
        ),
        ("name = \"circle\"\nradius = true".into(), "4:10", "expected a number", "write for instance 0.5"),
        ("name = \"strip\"".into(), "4:1", "the length of the walls is infinite", "one by one: [[orbit]]"),
        ("name = \"wedge\"\nangle = 1".into(), "5:1", "the length of the walls is infinite", "one by one: [[orbit]]"),
        (
            format!("dimension = 3\n{}", entry("plane = { through = [0, 0, 0], normal = [0, 0, 1] }")),
            "6:1",
            "the area of the walls is infinite",
            "one by one: [[orbit]]",
        ),
        (
            entry(
                "ellipse = { center = [0, 0], semi_axes = [2, 1] }\n[[table.boundary]]\ncircle = { center = [2, 0], radius = 0.5, domain = \"outside\" }",
            ),
            "6:10",
            "pieces 0 and 1 cross near (1.78475, ",
            "may touch but not cross",
        ),
        (
            entry("curve = { implicit = \"(x^2+y^2-1)*((x-4)^2+y^2-1)\", within = [[-2, -2], [6, 2]] }"),
            "4:22",
            "must be the only one in its box; this fails near (",
            "draw the box `within` closer",
        ),
    ] {
        let output = folder.run(&scene(&table), &[]);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{table}: {told}");
        let (what, mend) = told.split_once("help: ").unwrap_or((&told, ""));
        assert!(what.contains(message) && mend.contains(help), "{table}: {told}");
        assert!(what.contains(&format!("scene.toml:{place}: error: ")), "{table}: {place} expected in {told}");
    }
    for name in ["lorentz", "channel"] {
        let told = String::from_utf8(folder.run(&scene(&format!("name = \"{name}\"")), &[]).stderr).unwrap();
        let mend = told.split_once("write for instance ").map_or("", |(_, mend)| mend).lines().next().unwrap();
        folder.done(&scene(&format!("name = \"{name}\"\n{mend}")), &[]);
    }
}

#[test]
fn a_start_at_a_wall_is_told_its_number_as_drawn() {
    // the region of centres has eight pieces, the table six
    let folder = Folder::new("as-drawn");
    for (x, message) in [
        ("0.125", "the disk touches piece 5 and does not move into the table"),
        ("0.1", "its centre would be 0.025 beyond the limit set by piece 5"),
    ] {
        let scene = format!(
            "law = \"specular\"\ntable = {{ name = \"pocket\" }}\nparticle = {{ radius = 0.125 }}\n\
             orbit = {{ position = [{x}, 0.5], velocity = [-1, 0] }}\nrun = {{ collisions = 1 }}"
        );
        let text = String::from_utf8(folder.run(&scene, &[]).stderr).unwrap();
        assert!(text.contains(message), "{text}");
    }
}

#[test]
fn a_scene_whose_name_is_none_for_a_folder_needs_one() {
    let folder = Folder::new("dots");
    for name in ["...toml", "..toml"] {
        fs::write(folder.0.join(name), SQUARE).unwrap();
        let run = |arguments: &[&str]| {
            let mut command = Command::cargo_bin("billiards").unwrap();
            command.current_dir(&folder.0).args(["run", name]).args(arguments).output().unwrap()
        };
        let output = run(&[]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(text.starts_with(&format!("{name}: error: ")) && text.contains("--out DIR"), "{text}");
        assert!(!folder.0.join("out").exists() && !folder.0.join("summary.json").exists());
        assert!(run(&["--out", "named"]).status.success());
    }
}

#[test]
fn a_spin_beside_which_the_velocity_is_lost_is_refused() {
    let folder = Folder::new("spin");
    let plane = |spin: &str| {
        format!(
            "law = \"specular\"\ntable = {{ name = \"circle\" }}\nrun = {{ collisions = 100 }}\n[[orbit]]\nposition = [0.125, 0.25]\n\
             velocity = [0.6e-50, 0.8e-50]\nspin = {spin}\n"
        )
    };
    let space = "law = \"no-slip\"\ntable = { name = \"ball\", dimension = 3 }\nrun = { collisions = 3 }\n[[orbit]]\n\
                 position = [0, 0.1, 0.2]\nvelocity = [1e-60, 0, 0]\nspin = [0, 0, 1e50]\n";
    for scene in [&plane("-1.1e50"), &plane("1e150"), space] {
        let output = folder.run(scene, &[]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(text.contains("scene.toml:7:8: error: the spin, ") && text.contains("make the spin smaller"), "{text}");
    }
    // a spin just above the limit is not rounded to it
    let said = String::from_utf8(folder.run(&plane("1.01e50"), &[]).stderr).unwrap();
    assert!(said.contains("the spin, 1.01e50, is more than 1e100 times the speed of the centre, 1e-50\n"), "{said}");
    assert!(folder.done(&plane("1e50"), &[])["energy_drift"].as_f64().unwrap() <= 4e-16);
}

#[test]
#[cfg(target_os = "linux")]
fn help_that_cannot_be_written_is_a_failure() {
    use std::process::{Command, Stdio};
    for arguments in [&["--help"][..], &["run", "--help"], &["help", "check"], &["--version"]] {
        let command = || {
            let mut command = Command::new(assert_cmd::cargo::cargo_bin("billiards"));
            command.args(arguments).stderr(Stdio::piped());
            command
        };
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command().stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(output.stderr.starts_with(b"error: "), "{arguments:?}");
        // a reader that has seen enough
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = command().stdout(writer).output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{arguments:?}");
    }
}

/// What is told about a scene beside which a file lies.
fn told(border: &str, file: &str, text: &str) -> String {
    let folder = Folder::new("told-about-a-file");
    fs::write(folder.0.join(file), text).unwrap();
    let table = if file.ends_with("obj") { "[table]\ndimension = 3\n" } else { "" };
    let start =
        if file.ends_with("obj") { "[0.5, 0.5, 0.5]\nvelocity = [1, 0.2, 0.3]" } else { "[1, 1]\nvelocity = [1, 0.3]" };
    let scene = format!(
        "law = \"specular\"\n{table}[[table.boundary]]\n{border}\n[[orbit]]\nposition = {start}\n[run]\ncollisions = 1\n"
    );
    let output = folder.run(&scene, &[]);
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn errors_about_a_drawing_name_its_elements_and_a_wall_drawn_twice() {
    let drawing = |third: &str| {
        let rect = "<rect x='2' y='-6' width='2' height='2'/>";
        format!("<svg xmlns='http://www.w3.org/2000/svg'><rect y='-9' width='9' height='9'/>\n{rect}\n\n{third}</svg>")
    };
    let twice = told("outline = \"d.svg\"", "d.svg", &drawing("<rect x='2' y='-6' width='2' height='2'/>"));
    assert!(twice.contains(" coincide near "), "{twice}");
    assert!(twice.contains(" is from line 2, <rect>, piece ") && twice.contains(" is from line 4, <rect>"), "{twice}");
    assert!(twice.contains("help: the same wall is drawn twice: leave one out"), "{twice}");
    let across = told("outline = \"d.svg\"", "d.svg", &drawing("<circle cx='4' cy='-5' r='0.5'/>"));
    assert!(across.contains(" cross near ") && across.contains("is from line 4, <circle>"), "{across}");
}

#[test]
fn what_stands_on_part_of_a_curve_by_a_formula_is_refused_with_a_mend_that_works() {
    let folder = Folder::new("stands-on-a-formula");
    let wave = |from: u32, to: u32| format!("{{ x = \"t\", y = \"0.125*sin(pi*t/2)^2\", over = [{from}, {to}] }}");
    let scene = |floor: &[String]| {
        let floor = floor.join(", ");
        let stone = format!("{{ line_to = [1.5, 1.25] }}, {{ line_to = [2, 0] }}, {}", wave(2, 1));
        format!(
            "law = \"specular\"\n[[table.boundary]]\nloop = {{ from = [0, 0], edges = [{floor}, {{ line_to = [4, 3] }}, \
             {{ line_to = [0, 3] }}, {{ line_to = [0, 0] }}] }}\n[[table.boundary]]\n\
             loop = {{ domain = \"outside\", from = [1, 0.125], edges = [{stone}] }}\n\
             [[orbit]]\nposition = [1.5, 2]\nvelocity = [0.1, 1]\n[run]\ncollisions = 10\n"
        )
    };
    let output = folder.run(&scene(&[wave(0, 4)]), &[]);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("let the stretch be an edge of its own in both"), "{told}");
    assert_eq!(folder.done(&scene(&[wave(0, 1), wave(1, 2), wave(2, 4)]), &[])["collisions"], 10);
}

#[test]
fn a_short_piece_of_a_map_is_told_with_its_position_and_its_point() {
    let ring =
        "[[500000, 5400000], [500010, 5400000], [500010, 5400000.00000001], [500010, 5400010], [500000, 5400000]]";
    let map = format!("{{\"type\": \"Polygon\", \"coordinates\": [{ring}]}}");
    let told = told("outline = \"g.json\"", "g.json", &map);
    assert!(told.contains("near (500010, 5400000); piece 1 is from coordinates[0][1]"), "{told}");
}

#[test]
fn errors_about_a_mesh_name_the_line_of_the_face() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    let sides = "f 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let mesh = "mesh = { file = \"m.obj\", domain = \"inside\" }";
    let twice = told(mesh, "m.obj", &format!("{vertices}f 4 3 2 1\n{sides}f 4 3 2 1\n"));
    assert!(twice.contains("m.obj, line 15: the face occurs twice: remove one of the two"), "{twice}");
    let wrong = told(mesh, "m.obj", &format!("{vertices}f 1 2 3 4\n{sides}"));
    assert!(
        wrong.contains("m.obj, line 9: the face runs along an edge in the same direction as its neighbour"),
        "{wrong}"
    );
}

#[test]
fn sides_of_a_wall_that_differ_by_more_than_rounding_are_refused() {
    let folder = Folder::new("faces");
    let scene = |radius: &str| {
        format!(
            "law = \"specular\"\n[[table.boundary]]\ncircle = {{ center = [0, 0], radius = 2 }}\n\
             [[table.boundary]]\ncircle = {{ center = [0.1, 0.2], radius = 0.77 }}\n\
             [[table.boundary]]\ncurve = {{ polar = \"{radius}\", center = [0.1, 0.2], domain = \"outside\" }}\n\
             [[orbit]]\nposition = [-1.4, 0.1]\nvelocity = [0.9, 0.4]\n[run]\ncollisions = 20\n\
             [output]\ncollisions = \"csv\"\n"
        )
    };
    let told = String::from_utf8(folder.run(&scene("0.77+4e-15"), &[]).stderr).unwrap();
    assert!(told.contains("scene.toml:7:9") && told.contains("pieces 1 and 2 run along each other near ("), "{told}");
    assert!(told.contains("help: cut both sides at the same places and describe them alike"), "{told}");
    // and one is like the other
    folder.done(&scene("0.77"), &[]);
    let times: Vec<f64> = folder.rows().iter().map(|row| row[2]).collect();
    assert!(times.windows(2).all(|t| t[1] - t[0] > 1e-3), "{times:?}");
}
