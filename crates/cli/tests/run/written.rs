//! What a run writes: record, summary, pictures.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use billiards_cli::commands::guide::GUIDE;
use lanes::Double;
use serde_json::Value;

use super::{Folder, SQUARE, same::CHAOS};

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
fn the_rows_of_a_long_orbit_are_numbered_through() {
    let folder = Folder::new("long");
    folder.done(SQUARE, &["-n", "9000"]);
    let numbers = |row: &Vec<f64>| [row[0], row[1]];
    let expected: Vec<_> =
        [0.0, 1.0].into_iter().flat_map(|orbit| (1..=9000).map(move |n| [orbit, f64::from(n)])).collect();
    assert!(folder.rows().iter().map(numbers).eq(expected));
}

#[test]
fn a_title_is_shown_and_not_obeyed_by_the_terminal() {
    let folder = Folder::new("title");
    let scene = format!("title = \"\\u001b[31mred\\nor not\"\n{SQUARE}");
    for command in [&["run", "scene.toml"][..], &["check", "scene.toml"]] {
        fs::write(folder.0.join("scene.toml"), &scene).unwrap();
        let output = Command::cargo_bin("billiards").unwrap().current_dir(&folder.0).args(command).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert_eq!(text.lines().next(), Some(" [31mred or not"), "{command:?}");
    }
}

#[test]
fn every_row_has_the_energy_of_the_start() {
    let folder = Folder::new("energy");
    for table in ["stadium", "circle", "sinai"] {
        for law in ["specular", "no-slip"] {
            folder.done(
                &format!(
                    "law = \"{law}\"\n[table]\nname = \"{table}\"\n[[orbit]]\nposition = [0.1, 0.2]\n\
                     velocity = [0.6, 0.8]\nspin = 0.25\n[run]\ncollisions = 2000\n[output]\ncollisions = \"csv\"\n"
                ),
                &[],
            );
            let square =
                |velocity: &[f64]| velocity.iter().fold(Double::new(0.0), |sum, v| sum.plus(Double::product(*v, *v)));
            // v0 = γ R ω of a uniform disk of unit radius
            let start = square(&[0.6, 0.8, 0.25]);
            for row in folder.rows() {
                let drift = square(&row[7..10]).plus(-start).value() / start.value();
                assert!(drift.abs() <= 4e-16, "{table}, {law}: {drift:e} in {row:?}");
            }
        }
    }
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
fn the_horizon_has_the_time_of_the_collision_that_it_names() {
    let folder = Folder::new("when");
    let ensemble = "[ensemble]\ncount = 16\nseed = 3\n[output]\ncollisions = \"csv\"\n";
    let restitution = "{ name = \"restitution\", normal = 0.5, tangential = -1 }";
    for (law, table) in [("\"no-slip\"", "sinai"), ("\"specular\"", "square"), (restitution, "circle")] {
        let scene = |run: &str| format!("law = {law}\ntable = {{ name = \"{table}\" }}\nrun = {{ {run} }}\n{ensemble}");
        let horizons = |run: &str| folder.done(&scene(run), &[])["horizon"]["orbits"].as_array().unwrap().clone();
        let orbits = horizons("collisions = 60");
        let rows = folder.rows();
        let row = |known: &Value| {
            rows.iter()
                .find(|row| Some(row[0]) == known["orbit"].as_f64() && Some(row[1]) == known["collisions"].as_f64())
        };
        for known in &orbits {
            assert_eq!(known["time"].as_f64(), Some(row(known).unwrap()[2]), "{table}: {known}");
        }
        // where the limit is the time of a collision, the last bit decides whether that collision counts
        let times: Vec<f64> = orbits.iter().take(4).map(|known| row(known).unwrap()[2]).collect();
        for time in times {
            let again = horizons(&format!("time = {time}"));
            let rows = folder.rows();
            for known in again.iter().filter(|known| known["lost"] == false) {
                let made = rows.iter().filter(|row| Some(row[0]) == known["orbit"].as_f64()).count();
                assert_eq!(known["collisions"].as_u64(), Some(made as u64), "{table}, {time}: {known}");
            }
        }
    }
}

#[test]
fn the_time_of_all_orbits_is_summed_without_rounding() {
    let folder = Folder::new("total");
    let scene =
        "law = \"specular\"\ntable = { name = \"circle\" }\nensemble = { count = 100000 }\nrun = { time = 0.1 }\n";
    assert_eq!(folder.done(scene, &[])["time"].as_f64(), Some(10_000.0));
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
    // and none that the guide does not name
    for key in summary.as_object().unwrap().keys() {
        assert!(GUIDE.contains(&format!("`{key}`")), "{key}");
    }
    assert_eq!((summary["collisions"].as_u64(), summary["stops"]["finished"].as_u64()), (Some(6), Some(2)));
    assert_eq!(summary["energy_drift"].as_f64(), Some(0.0));
    let [seconds, each] = ["seconds", "ns_per_collision"].map(|key| summary[key].as_f64().unwrap());
    assert!((each * 6e-9 / seconds - 1.0).abs() < 1e-9, "{seconds} {each}");
    assert_eq!(summary["version"], env!("CARGO_PKG_VERSION"));
    // the hash of the file as it is, whatever the command line says beside it
    let hash = summary["scene"].clone();
    assert_eq!(hash.as_str().unwrap().len(), 64);
    assert_eq!(folder.done(SQUARE, &["--law", "no-slip", "-n", "2"])["scene"], hash);
    assert_ne!(folder.done(&SQUARE.replace("0.125", "0.25"), &[])["scene"], hash);
}

#[test]
fn the_summary_says_what_was_run() {
    let folder = Folder::new("what");
    let keys = ["table", "seed", "collisions_per_orbit", "time_per_orbit", "orbits"];
    let told = |scene: &str, arguments: &[&str]| {
        let summary = folder.done(scene, arguments);
        keys.map(|key| summary[key].clone())
    };
    let none = Value::Null;
    assert_eq!(told(SQUARE, &[]), ["square".into(), 0.into(), 3.into(), none.clone(), 2.into()]);
    let walls = "boundary = [{ circle = { center = [0, 0], radius = 1 } }]";
    let scene = format!(
        "law = \"no-slip\"\ntable = {{ {walls} }}\nensemble = {{ count = 5, seed = 7 }}\nrun = {{ time = 2.5 }}\n"
    );
    assert_eq!(told(&scene, &[]), ["boundary".into(), 7.into(), none.clone(), 2.5.into(), 5.into()]);
    assert_eq!(told(&scene, &["-n", "4"]), ["boundary".into(), 7.into(), 4.into(), none, 5.into()]);
}

#[test]
fn the_energy_of_the_summary_is_that_of_the_orbit_that_drifts_most() {
    let folder = Folder::new("drift");
    let slanting = ("position = [0.25, 0.5], velocity = [0.5, 0.25], spin = 0.125", 0.328_125);
    let straight = ("position = [0.5, 0.5], velocity = [0, -1]", 1.0);
    for [first, second] in [[slanting, straight], [straight, slanting]] {
        let scene = format!(
            "law = {{ name = \"restitution\", normal = 0.5, tangential = 0.25 }}\ntable = {{ name = \"square\" }}\n\
             orbit = [{{ {} }}, {{ {} }}]\nrun = {{ collisions = 3 }}\noutput = {{ collisions = \"csv\" }}\n",
            first.0, second.0
        );
        let told = folder.done(&scene, &[])["energy_drift"].as_f64().unwrap();
        let rows = folder.rows();
        // the third row is the last of the first orbit, the sixth that of the second
        let [a, b] = [(&rows[2], first.1), (&rows[5], second.1)]
            .map(|(row, start)| 1.0 - row[7..10].iter().map(|v| v * v).sum::<f64>() / start);
        assert!((told - a.max(b)).abs() < 1e-14 && (a - b).abs() > 0.01, "{told} {a} {b}");
    }
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

/// Under a law that takes energy an orbit ends creeping along the wall, and there by its own bits only.
#[test]
fn no_digits_are_told_of_collisions_that_an_orbit_does_not_make() {
    let folder = Folder::new("creeping");
    let law = "law = { name = \"restitution\", normal = 0.9, tangential = 0.2 }\n";
    let output = "[ensemble]\ncount = 16\nseed = 7\n[run]\ncollisions = 400\n[output]\ncollisions = \"csv\"\npictures = [\"orbit\"]\n";
    for table in [
        "[table]\ndimension = 3\n[[table.boundary]]\nsphere = { center = [0, 0, 0], radius = 3 }\n",
        "[[table.boundary]]\ncurve = { polar = \"1 + 0.1*abs(cos(t))\" }\n",
        "[table]\nname = \"circle\"\n",
        "[table]\nname = \"ellipse\"\n",
    ] {
        let summary = folder.done(&format!("{law}{table}{output}"), &[]);
        let mut made = [0; 16];
        for row in folder.rows() {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the number of an orbit")]
            let orbit = row[0] as usize;
            made[orbit] += 1;
        }
        let mut lost = 0;
        for (known, made) in summary["horizon"]["orbits"].as_array().unwrap().iter().zip(made) {
            let collisions = known["collisions"].as_u64().unwrap();
            let is_lost = known["lost"] == true;
            assert!(collisions + u64::from(is_lost) <= made, "{table}: {known} of {made}");
            assert!(is_lost || collisions == made, "{table}: {known} of {made}");
            lost += usize::from(is_lost);
        }
        assert!(summary["stops"]["grazing"].as_u64().unwrap() > 0, "{table}");
        assert_eq!(folder.read("out/orbit.svg").matches("r=\"1.5\" fill=\"#ffffff\"").count(), lost, "{table}");
    }
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

#[cfg(target_os = "linux")]
#[test]
fn a_run_that_cannot_write_all_its_files_leaves_those_of_an_earlier_one() {
    let folder = Folder::new("all-or-none");
    let scene = format!("{SQUARE}pictures = [\"orbit\", \"velocity-portrait\"]\n");
    folder.done(&scene, &[]);
    let names = ["collisions.csv", "orbit.svg", "velocity-portrait.svg", "summary.json"];
    let kept = || names.map(|name| folder.read(&format!("out/{name}")));
    let earlier = kept();
    fs::write(folder.0.join("other.toml"), scene.replace("[0.5, 0.25]", "[-0.5, 0.25]")).unwrap();
    // no file may be longer than a thousand bytes or two: the record is not, and the portrait is
    let line = "ulimit -f 2; exec \"$0\" run other.toml --out out";
    let binary = assert_cmd::cargo::cargo_bin("billiards");
    let mut shell = std::process::Command::new("sh");
    let output = shell.current_dir(&folder.0).args(["-c", line]).arg(binary).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(1) && told.starts_with("error: out: File too large"), "{told}");
    assert_eq!(kept(), earlier);
    assert_eq!(fs::read_dir(folder.0.join("out")).unwrap().count(), names.len());
}

/// Otherwise the files of two runs could be mixed.
#[cfg(unix)]
#[test]
fn a_run_names_its_files_when_no_other_process_does_in_the_folder() {
    let folder = Folder::new("in-turn");
    fs::write(folder.0.join("scene.toml"), SQUARE).unwrap();
    fs::create_dir(folder.0.join("out")).unwrap();
    let locked = fs::File::open(folder.0.join("out")).unwrap();
    locked.lock().unwrap();
    let started = || {
        std::process::Command::new(assert_cmd::cargo::cargo_bin("billiards"))
            .current_dir(&folder.0)
            .args(["run", "scene.toml", "--out", "out"])
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap()
    };
    let summary = folder.0.join("out/summary.json");
    let mut run = started();
    std::thread::sleep(std::time::Duration::from_secs(1));
    assert!(!summary.exists());
    locked.unlock().unwrap();
    assert!(run.wait().unwrap().success() && summary.exists());
    // and it does not wait for ever
    locked.lock().unwrap();
    fs::remove_file(&summary).unwrap();
    assert!(started().wait().unwrap().success() && summary.exists());
    assert_eq!(fs::read_dir(folder.0.join("out")).unwrap().count(), 2);
}

#[cfg(target_os = "linux")]
#[test]
fn where_standard_output_is_full_that_is_said_and_that_the_files_are_complete() {
    let folder = Folder::new("full-output");
    fs::write(folder.0.join("scene.toml"), SQUARE).unwrap();
    for (arguments, complete) in [
        (&["run", "scene.toml", "--out", "out"][..], "\nhelp: the files in out are complete"),
        (&["check", "scene.toml"], ""),
        (&["guide"], ""),
        (&["tables"], ""),
        (&["--help"], ""),
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("billiards"));
        let output = command.current_dir(&folder.0).args(arguments).stdout(full).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        let full = "error: standard output cannot be written: No space left on device (os error 28)";
        assert_eq!((output.status.code(), told), (Some(1), format!("{full}{complete}\n")), "{arguments:?}");
    }
    assert!(folder.0.join("out/summary.json").exists() && folder.0.join("out/collisions.csv").exists());
}

#[test]
fn a_scene_can_come_from_standard_input() {
    let folder = Folder::new("standard-input");
    fs::write(folder.0.join("room.svg"), "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0H1V1H0Z'/></svg>")
        .unwrap();
    let scene = "law = \"specular\"\ntable = { boundary = [{ outline = \"room.svg\" }] }\nrun = { collisions = 5 }\n\
                 orbit = [{ position = [0.5, -0.5], velocity = [1, 0.5] }]\n";
    let given = |scene: &str, arguments: &[&str]| {
        let mut command = Command::cargo_bin("billiards").unwrap();
        let output = command.current_dir(&folder.0).args(arguments).write_stdin(scene).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    assert_eq!(given(scene, &["run", "-", "--out", "out"]), (Some(0), String::new()));
    assert_eq!(folder.summary("out")["collisions"], 5);
    assert_eq!(given(scene, &["check", "-"]), (Some(0), String::new()));
    let (status, told) = given(scene, &["run", "-"]);
    assert!(status == Some(2) && told.starts_with("standard input: error: ") && told.contains("--out DIR"), "{told}");
    let (status, told) = given(&scene.replace("specular", "specula"), &["run", "-", "--out", "out"]);
    assert!(status == Some(2) && told.starts_with("standard input:1:7: error: "), "{told}");
}

#[cfg(target_os = "linux")]
#[test]
fn where_the_record_cannot_be_written_all_threads_end() {
    let folder = Folder::new("threads-end");
    let scene = "law = \"no-slip\"\ntable = { name = \"stadium\" }\nensemble = { count = 8 }\n\
                 output = { collisions = \"csv\" }\n";
    fs::write(folder.0.join("scene.toml"), scene).unwrap();
    // by then those that run the later orbits wait for room
    let line = "ulimit -f 80000; exec timeout -s KILL 60 \"$0\" run scene.toml -n 1e12 --threads 5 --out out";
    let binary = assert_cmd::cargo::cargo_bin("billiards");
    let mut shell = std::process::Command::new("sh");
    let output = shell.current_dir(&folder.0).args(["-c", line]).arg(binary).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.code() == Some(1) && told.starts_with("error: out: File too large"),
        "{:?} {told}",
        output.status
    );
    assert_eq!(fs::read_dir(folder.0.join("out")).map_or(0, Iterator::count), 0);
}

#[test]
fn the_command_of_a_summary_can_be_given_to_a_shell() {
    let folder = Folder::new("command");
    let name = "sp ace'q.toml";
    fs::write(folder.0.join(name), SQUARE).unwrap();
    let mut command = Command::cargo_bin("billiards").unwrap();
    let arguments = ["run", name, "--out", "out", "-n", "2"];
    assert!(command.current_dir(&folder.0).args(arguments).output().unwrap().status.success());
    let command = folder.summary("out")["command"].as_str().unwrap().to_owned();
    assert!(command.ends_with(r" run 'sp ace'\''q.toml' --out out -n 2"), "{command}");
}

#[test]
fn a_summary_names_the_files_of_its_run() {
    let folder = Folder::new("files");
    let scene = format!("{CHAOS}\n[output]\npictures = [\"orbit\"]\ncollisions = \"npy\"\n");
    let summary = folder.done(&scene, &["-n", "100"]);
    assert_eq!(summary["files"], serde_json::json!(["collisions.npy", "orbit.svg"]));
}

#[cfg(unix)]
#[test]
fn names_of_files_need_not_be_unicode() {
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new("names");
    let name = std::ffi::OsStr::from_bytes(b"caf\xe9");
    let scene = folder.0.join(name).join("scene.toml");
    fs::create_dir(folder.0.join(name)).unwrap();
    fs::write(
        &scene,
        "law = \"specular\"\ntable = { boundary = [{ outline = \"room.svg\" }] }\nrun = { collisions = 5 }\n\
                       orbit = [{ position = [0.5, -0.5], velocity = [1, 0.5] }]\n",
    )
    .unwrap();
    fs::write(
        scene.with_file_name("room.svg"),
        "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0H1V1H0Z'/></svg>",
    )
    .unwrap();
    let mut command = assert_cmd::Command::cargo_bin("billiards").unwrap();
    let output = command.arg("run").arg(&scene).arg("--out").arg(folder.0.join(name).join("out")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let summary = fs::read(folder.0.join(name).join("out").join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&summary).unwrap();
    assert_eq!(summary["collisions"], 5);
}

#[test]
fn the_flight_into_a_corner_is_drawn_to_the_corner() {
    let folder = Folder::new("corner");
    let plain = "law = \"specular\"\n[[orbit]]\nposition = [0.25, 0.25]\nvelocity = [1, 1]\n[run]\ncollisions = 3\n\
                 [output]\npictures = [\"orbit\"]\n[table]\n";
    let square = format!("{plain}name = \"square\"\n");
    // through the corner of the cell to the copy of the corner that lies in the next one
    let torus = format!(
        "{plain}lattice = [[1, 0], [0, 1]]\n[[table.boundary]]\nloop = {{ domain = \"outside\", from = [0.125, 0.125], \
         edges = [{{ line_to = [0.125, 0.1875] }}, {{ line_to = [0.1875, 0.1875] }}, {{ line_to = [0.1875, 0.125] }}, \
         {{ line_to = [0.125, 0.125] }}] }}\n"
    );
    for (scene, corner) in [(square, [1.0, 1.0]), (torus, [0.125, 0.125])] {
        assert_eq!(folder.done(&scene, &[])["stops"]["corner"], 1);
        let svg = folder.read("out/orbit.svg");
        let orbit = svg.split("stroke=\"#144a87\"").nth(1).unwrap().split("</g>").next().unwrap();
        let [x, y]: [f64; 2] = {
            let mut numbers = orbit.rsplit('L').next().unwrap().split('"').next().unwrap().split(' ');
            [(); 2].map(|()| numbers.next().unwrap().parse().unwrap())
        };
        // the cell is all of the picture: 220.8 points between margins of 3, and a thousandth around
        let place = [corner[0], 1.0 - corner[1]].map(|x| 3.0 + 220.8 * (x + 1e-3) / 1.002);
        assert!((x - place[0]).abs() < 2e-3 && (y - place[1]).abs() < 2e-3, "{x} {y} for {place:?}: {orbit}");
    }
}
