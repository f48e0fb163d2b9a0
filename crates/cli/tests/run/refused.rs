//! What is refused, and in which words.

mod files;
mod formulas;
mod imports;
mod walls;

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
fn errors_give_lengths_in_the_units_of_the_scene() {
    let folder = Folder::new("units");
    let scene = "law = \"specular\"\ntable = { name = \"moon\", radius = 1000, bite_radius = 750, bite_distance = 5000 }\n\
                 orbit = [{ position = [0, 0], velocity = [1, 0] }]\nrun = { collisions = 1 }";
    let text = String::from_utf8(folder.run(scene, &[]).stderr).unwrap();
    assert!(text.contains("scene.toml:2:"), "{text}");
    assert!(text.contains("bite_distance must be") && text.contains("not 5000"), "{text}");
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
