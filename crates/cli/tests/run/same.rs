//! What does not change a result, and what does.

use std::fs;

use super::{Folder, SQUARE};

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

pub(super) const CHAOS: &str = r#"
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
fn orbits_side_by_side_make_as_many_collisions_as_are_asked_for() {
    let folder = Folder::new("blocks");
    let kept = |record: &str| {
        let summary = folder.done(
            &format!(
                "law = \"no-slip\"\ntable = {{ name = \"stadium\" }}\nensemble = {{ count = 20, seed = 5 }}\n\
                 run = {{ collisions = 5000 }}\n{record}\n"
            ),
            &[],
        );
        ["collisions", "time", "energy_drift", "stops"].map(|key| summary[key].clone())
    };
    let together = kept("");
    assert_eq!(together[0], 100_000);
    // those that are recorded run one by one
    assert_eq!(kept("output = { collisions = \"npy\" }"), together);
}

#[test]
fn orbits_that_are_drawn_at_first_run_on_side_by_side() {
    let folder = Folder::new("drawn-at-first");
    // a square around a disk, with a hole in its lower side: some orbits escape while they are drawn, others in their first block, others
    // later or never
    let piece = |piece: &str| format!("[[table.boundary]]\n{piece}\n");
    let table = [
        "ray = { from = [0.509, 0], direction = [-1, -1] }",
        "chain = { from = [0.51, 0], edges = [{ line_to = [1, 0] }, { line_to = [1, 1] }, { line_to = [0, 1] }, { line_to = [0, 0] }, \
         { line_to = [0.509, 0] }] }",
        "ray = { from = [0.51, 0], direction = [1, -1], domain = \"right\" }",
        "circle = { center = [0.5, 0.5], radius = 0.2, domain = \"outside\" }",
    ]
    .map(piece)
    .concat();
    let start = |k: u32| format!("[[orbit]]\nposition = [0.1, {}]\nvelocity = [0.6, 0.8]\n", 0.1 + 0.02 * f64::from(k));
    let starts: String = (0..40).map(start).collect();
    // with a time limit, those that have escaped fly on until then
    for (limit, escaped) in [("collisions = 10000", 36), ("time = 3000", 0)] {
        let kept = |record: &str, threads: &str| {
            let scene = format!(
                "law = \"specular\"\n{table}{starts}[run]\n{limit}\n[output]\npictures = [\"orbit\"]\n{record}\n"
            );
            let summary = folder.done(&scene, &["--threads", threads]);
            let picture = folder.read("out/orbit.svg");
            (["collisions", "time", "energy_drift", "stops"].map(|key| summary[key].clone()), picture)
        };
        // those that are recorded run one by one
        let recorded = kept("collisions = \"npy\"", "1");
        assert_eq!(recorded.0[3]["escaped"].as_u64().unwrap_or(0), escaped, "{limit}");
        for threads in ["1", "2"] {
            assert!(kept("", threads) == recorded, "{limit}");
        }
    }
}

#[test]
fn portraits_up_to_a_time_are_the_same_whether_or_not_their_orbits_are_recorded() {
    let folder = Folder::new("counted");
    for limit in ["time = 300", "collisions = 200"] {
        let kept = |record: &str, threads: &str| {
            let scene = format!(
                r#"
law = "no-slip"
table = {{ name = "stadium" }}
ensemble = {{ count = 400, seed = 5 }}
run = {{ {limit} }}
output = {{ pictures = ["velocity-portrait", "phase-portrait"]{record} }}
"#
            );
            let summary = folder.done(&scene, &["--threads", threads]);
            let portraits =
                ["velocity", "phase"].map(|of| fs::read(folder.0.join(format!("out/{of}-portrait.png"))).unwrap());
            (["collisions", "time", "energy_drift", "stops"].map(|key| summary[key].clone()), portraits)
        };
        // those that are recorded run one by one
        let recorded = kept(", collisions = \"npy\"", "1");
        assert!(recorded.0[0].as_u64() > Some(40_000), "{limit}: {recorded:?}");
        for threads in ["1", "2"] {
            assert!(kept("", threads) == recorded, "{limit}");
        }
    }
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
    let stadium = "[table]\nname = \"stadium\"";
    let thin = "[[table.boundary]]\ncircle = { center = [0, 0], radius = 2 }\n[[table.boundary]]\n\
                shape = { name = \"segment\", from = [-0.5, 0.1], to = [0.5, 0] }";
    // enough points that they are counted, and as few that they are dots; laws that keep the speed and one that does not; walls of which
    // points do not tell the face
    for (table, law, collisions) in [
        (stadium, "no-slip", 250),
        (stadium, "no-slip", 30),
        (stadium, "{ name = \"restitution\", normal = 0.99, tangential = 0 }", 250),
        (thin, "no-slip", 250),
    ] {
        let pictures = "pictures = [\"velocity-portrait\", \"phase-portrait\"]";
        let scene = format!(
            "law = {}\n{table}\n[ensemble]\ncount = 301\nseed = 5\n[run]\n\
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
