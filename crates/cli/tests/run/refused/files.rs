//! What is refused about command lines, folders and files, and in which words.

use std::fs;

use assert_cmd::Command;

use crate::{Folder, SQUARE};

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
