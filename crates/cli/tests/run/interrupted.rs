//! Runs that are told to end.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::{Folder, same::CHAOS};

/// Starts a run of a scene, with further arguments; results come into `out`.
fn begin(folder: &Folder, scene: &str, arguments: &[&str]) -> Child {
    fs::write(folder.0.join("scene.toml"), scene).unwrap();
    let mut run = Command::new(assert_cmd::cargo::cargo_bin("billiards"));
    let run = run.current_dir(&folder.0).args(["run", "scene.toml", "--out", "out"]).args(arguments);
    run.stdout(Stdio::null()).spawn().unwrap()
}

/// Sends a signal to a run.
fn signal(run: &Child, name: &str) {
    let sent = Command::new("kill").args(["-s", name, &run.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

/// Whether a run that is started here hears of Ctrl-C: not where these tests run in the background of a script, which ignores it.
fn hears_ctrl_c() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    mask(&status, "SigIgn:").is_none_or(|mask| mask >> 1 & 1 == 0)
}

/// A set of signals in the status of a process, as Linux tells it: the first signal in the lowest bit.
fn mask(status: &str, name: &str) -> Option<u64> {
    let mask = status.lines().find_map(|line| line.strip_prefix(name))?;
    u64::from_str_radix(mask.trim(), 16).ok()
}

/// The exit status of a run that should end by now.
fn end(run: &mut Child) -> i32 {
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(20) {
        if let Some(status) = run.try_wait().unwrap() {
            return status.code().unwrap();
        }
        sleep(Duration::from_millis(20));
    }
    run.kill().unwrap();
    panic!("the run goes on");
}

/// Waits until the handler of signals of a run is in place (only Linux tells), and orbits are on their way.
fn under_way(run: &Child) {
    let caught = || {
        let status = fs::read_to_string(format!("/proc/{}/status", run.id())).unwrap_or_default();
        mask(&status, "SigCgt:").is_none_or(|mask| mask >> 14 & 1 == 1)
    };
    let begun = Instant::now();
    while !caught() && begun.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(10));
    }
    sleep(Duration::from_millis(1500));
}

/// Of a run that would take weeks.
#[test]
fn an_interrupted_run_keeps_what_is_done() {
    let folder = Folder::new("interrupt");
    let mut run = begin(&folder, CHAOS, &["-n", "1e12", "--threads", "1"]);
    under_way(&run);
    signal(&run, "TERM");
    assert_eq!(end(&mut run), 0);
    let summary = folder.summary("out");
    assert_eq!(summary["stops"]["interrupted"], 2);
    assert!(summary["collisions"].as_u64().unwrap() > 1000);
}

/// What `timeout` and shells do that tell a program and its group.
#[test]
fn two_signals_at_once_are_one_request() {
    let folder = Folder::new("twice");
    let scene = format!("{CHAOS}\n[output]\ncollisions = \"csv\"\n");
    for kind in ["INT", "TERM"].into_iter().filter(|kind| *kind == "TERM" || hears_ctrl_c()) {
        let mut run = begin(&folder, &scene, &["-n", "1e12", "--threads", "1"]);
        under_way(&run);
        signal(&run, kind);
        signal(&run, kind);
        assert_eq!(end(&mut run), 0, "{kind}");
        assert_eq!(folder.summary("out")["stops"]["interrupted"], 2);
        assert_eq!(fs::read_dir(folder.0.join("out")).unwrap().count(), 2);
        fs::remove_dir_all(folder.0.join("out")).unwrap();
    }
}

/// As under `nohup`.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_is_ignored_from_the_start_stays_ignored() {
    let folder = Folder::new("nohup");
    fs::write(folder.0.join("scene.toml"), CHAOS).unwrap();
    let command = "trap '' HUP; exec \"$0\" run scene.toml -n 1e12 --threads 1 --out out";
    let mut shell = Command::new("sh");
    let shell = shell.current_dir(&folder.0).args(["-c", command]).arg(assert_cmd::cargo::cargo_bin("billiards"));
    let mut run = shell.stdout(Stdio::null()).spawn().unwrap();
    under_way(&run);
    signal(&run, "HUP");
    sleep(Duration::from_millis(1500));
    assert!(run.try_wait().unwrap().is_none(), "the run has ended");
    signal(&run, "TERM");
    assert_eq!(end(&mut run), 0);
    assert_eq!(folder.summary("out")["stops"]["interrupted"], 2);
}

/// Particles that cross a million cells of a lattice from one collision to the next. A few meet a corridor and escape; the one of the
/// first scene goes on for three thousand collisions.
#[test]
fn an_interruption_does_not_wait_for_many_slow_collisions() {
    let folder = Folder::new("slow");
    let table = "law = \"specular\"\n[table]\nname = \"sinai-torus\"\nradius = 1e-6\n";
    for (count, limit, output) in [
        (1, "collisions = 10000", ""),
        (100, "collisions = 10000", ""),
        (100, "time = 1e12", ""),
        (100, "collisions = 10000", "[output]\npictures = [\"phase-portrait\"]\n"),
    ] {
        let scene = format!("{table}[ensemble]\ncount = {count}\nseed = 4\n[run]\n{limit}\n{output}");
        let mut run = begin(&folder, &scene, &["--threads", "1"]);
        under_way(&run);
        signal(&run, "TERM");
        assert_eq!(end(&mut run), 0, "{count} {limit} {output}");
        let stops = &folder.summary("out")["stops"];
        let (interrupted, escaped) = (stops["interrupted"].as_u64().unwrap(), stops["escaped"].as_u64().unwrap_or(0));
        assert!(interrupted + escaped == count && escaped <= count / 5, "{count} {limit} {output}: {stops}");
    }
}

/// In a flat torus the path along a corridor is given up after half a second, and a thousand of them are one piece of work.
#[test]
fn an_interruption_waits_for_one_orbit_and_not_for_a_thousand() {
    let folder = Folder::new("thousand");
    // the digits of the first sixteen are looked at before
    let near = "[[orbit]]\nposition = [0, 0.5]\nvelocity = [1, 0]\n".repeat(16);
    let far = "[[orbit]]\nposition = [0, 0]\nvelocity = [1, 1e-9]\n".repeat(1000);
    let table = "law = \"specular\"\n[table]\nname = \"sinai-torus\"\nradius = 0.1\n";
    let scene = format!("{table}{near}{far}[run]\ncollisions = 1\n[output]\ncollisions = \"csv\"\n");
    let mut run = begin(&folder, &scene, &["--threads", "1"]);
    under_way(&run);
    signal(&run, "TERM");
    assert_eq!(end(&mut run), 0);
    let summary = folder.summary("out");
    assert!(summary["stops"]["interrupted"].as_u64().unwrap() > 900, "{summary}");
    assert_eq!(summary["collisions"], 16);
}

/// Long flights past square obstacles: the digits last, but each collision is examined for milliseconds.
#[test]
fn an_interruption_does_not_wait_for_the_horizons() {
    let folder = Folder::new("horizons");
    let orbit = |k| format!("[[orbit]]\nposition = [0, 0]\nvelocity = [0.6, 0.812345{k}]\n");
    let orbits = (0..16).map(orbit).collect::<Vec<_>>().concat();
    let obstacle = "loop = { from = [0.5, 0.5], edges = [{ line_to = [0.5, 0.5001] }, { line_to = [0.5001, 0.5001] }, \
                    { line_to = [0.5001, 0.5] }, { line_to = [0.5, 0.5] }], domain = \"outside\" }";
    let scene = format!(
        "law = \"specular\"\n[table]\nlattice = [[1, 0], [0, 1]]\n[[table.boundary]]\n{obstacle}\n{orbits}[run]\ncollisions = 5000\n"
    );
    let mut run = begin(&folder, &scene, &["--threads", "1"]);
    under_way(&run);
    signal(&run, "TERM");
    assert_eq!(end(&mut run), 0);
    let summary = folder.summary("out");
    assert!(summary["horizon"]["orbits"].as_array().unwrap().len() < 16, "{summary}");
    assert_eq!((summary["stops"]["interrupted"].as_u64(), summary["collisions"].as_u64()), (Some(16), Some(0)));
}

/// A path along the corridors between forty disks in each cell is given up after seconds.
#[test]
fn a_second_request_ends_a_run_at_once_and_leaves_no_part_of_a_file() {
    let folder = Folder::new("at-once");
    let disk = |k: i32| {
        let x = (f64::from(k) + 0.5) / 40.0;
        format!("[[table.boundary]]\ncircle = {{ center = [{x}, 0.5], radius = 0.0075, domain = \"outside\" }}\n")
    };
    let disks = (0..40).map(disk).collect::<Vec<_>>().concat();
    // the digits of the first sixteen are looked at before
    let near = "[[orbit]]\nposition = [0.0125, 0]\nvelocity = [0, 1]\n".repeat(16);
    let far = "[[orbit]]\nposition = [0, 0]\nvelocity = [1, 1e-9]\n".repeat(1000);
    let table = format!("law = \"specular\"\n[table]\nlattice = [[1, 0], [0, 1]]\n{disks}");
    let scene = format!("{table}{near}{far}[run]\ncollisions = 1\n[output]\ncollisions = \"csv\"\n");
    let mut run = begin(&folder, &scene, &[]);
    let files = || fs::read_dir(folder.0.join("out")).map_or(0, Iterator::count);
    sleep(Duration::from_millis(500));
    let begun = Instant::now();
    while files() == 0 && begun.elapsed().as_secs() < 60 {
        sleep(Duration::from_millis(10));
    }
    assert_eq!(files(), 1, "the record has not been begun");
    sleep(Duration::from_millis(100));
    signal(&run, "TERM");
    sleep(Duration::from_millis(700));
    assert!(run.try_wait().unwrap().is_none(), "the run has ended already");
    signal(&run, "TERM");
    assert_eq!(end(&mut run), 130);
    assert_eq!(files(), 0);
}
