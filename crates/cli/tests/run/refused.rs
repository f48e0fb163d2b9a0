//! What is refused, and in which words.

use std::fs;

use assert_cmd::Command;

use super::{Folder, SQUARE, scale::stadium};

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
        (
            hand,
            "circle = { center = [0.5, 0.5], radius = 0.25, domain = \"outside\" }",
            "curve = { implicit = \"abs(x-1)+abs(y)-1\", within = [[-1, -2], [3, 2]] }",
            "scene.toml:10:22",
            "be smooth",
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
