//! `billiards run` as a user meets it: what is written, what is refused, and what does not change a result.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

#[cfg(unix)]
mod interrupted;
mod refused;
mod rooms;
mod same;
mod scale;
mod shown;
mod starts;
mod tables;
mod written;

use std::fs;
use std::path::PathBuf;
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
