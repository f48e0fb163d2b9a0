//! `billiards bench`: what it promises is there, and nothing is lost under stress.
#![allow(clippy::unwrap_used, reason = "tests")]

use assert_cmd::Command;
use billiards_cli::bench::case::CASES;
use billiards_cli::bench::law::Law;
use billiards_cli::bench::method::METHODS;
use billiards_cli::bench::score::{Exam, Score};
use billiards_cli::bench::stress::{self, Tally};
use billiards_cli::bench::{Effort, chart};
use serde_json::Value;

fn bench(words: &[&str]) -> Vec<u8> {
    let output = Command::cargo_bin("billiards").unwrap().arg("bench").args(words).assert().success();
    output.get_output().stdout.clone()
}

#[test]
fn the_numbers_of_a_table_are_json_with_the_promised_keys() {
    let all: Value = serde_json::from_slice(&bench(&["--quick", "--json", "--only", "circle"])).unwrap();
    assert_eq!((all["law"].as_str(), all["quick"].as_bool()), (Some("no-slip"), Some(true)));
    let scores = all["scores"].as_array().unwrap();
    // 10², 10³ and 10⁴ pieces with either kind of normals, and everything else once
    assert_eq!(scores.len(), METHODS.len() - 2 + 6);
    for score in scores {
        assert_eq!(score["table"], "circle");
        assert!(METHODS.iter().any(|method| score["method"] == method.name));
        assert!(score["ns_per_collision"].as_f64().unwrap() > 0.0);
        let stops: Vec<_> = score["errors"].as_array().unwrap().iter().map(|e| e["collisions"].as_u64()).collect();
        assert_eq!(stops, [Some(1), Some(10), Some(100)]);
        assert_eq!(score["drift"]["invariant"]["name"], "normal speed");
        for key in ["pieces", "build_seconds", "drift", "lost", "failures"] {
            assert!(score.get(key).is_some(), "{key}");
        }
    }
}

#[test]
fn a_table_of_that_name_must_exist() {
    let output = Command::cargo_bin("billiards").unwrap().args(["bench", "--only", "stadum"]).assert().code(2);
    assert!(String::from_utf8_lossy(&output.get_output().stderr).contains("stadium"));
}

#[test]
fn a_case_under_stress_is_told_its_option() {
    let output = Command::cargo_bin("billiards").unwrap().args(["bench", "--only", "needle"]).assert().code(2);
    assert!(String::from_utf8_lossy(&output.get_output().stderr).contains("help: add --stress"));
}

fn scores(table: &str, law: Law, methods: &[&str]) -> Vec<Score> {
    scores_with(Effort::Quick, table, law, methods)
}

fn scores_with(effort: Effort, table: &str, law: Law, methods: &[&str]) -> Vec<Score> {
    let case = CASES.iter().find(|entry| entry.name == table).unwrap().build().unwrap();
    let exam = Exam::new(&case, law, effort).unwrap();
    let wanted = METHODS.iter().filter(|method| methods.contains(&method.name));
    wanted
        .flat_map(|method| (method.sizes)(&case, effort).into_iter().map(move |pieces| (method, pieces)))
        .map(|(method, pieces)| exam.score(method, pieces).unwrap())
        .collect()
}

#[test]
fn exact_pieces_are_right_to_rounding_on_every_table_and_for_both_laws() {
    for table in CASES {
        for law in [Law::NoSlip, Law::Specular] {
            // a landing point is right to 2 ulp; ten collisions of a flower make a few hundred of them, of a stadium a few thousand,
            // which scatter so much that it takes many orbits to tell
            for score in scores_with(Effort::Full, table.name, law, &["exact"]) {
                assert!(score.errors[0].median < 1e-15, "{}: {:?}", table.name, score.errors);
                assert!(score.errors[1].median < 1e-12, "{}: {:?}", table.name, score.errors);
            }
            for score in scores(table.name, law, &["exact"]) {
                assert!(score.drift.energy < 4e-15, "{}: {:?}", table.name, score.drift);
                assert!(score.lost.ordinary.is_empty() && score.lost.grazing.is_empty(), "{}: {score:?}", table.name);
            }
        }
    }
}

#[test]
fn a_polyline_errs_by_its_step_with_flat_normals_and_by_its_square_with_interpolated_ones() {
    let scores = scores("circle", Law::NoSlip, &["polyline, flat normals", "polyline, interpolated normals"]);
    let error = |i: usize| scores[i].errors[1].median;
    // a hundred times as many pieces; the errors of 16 orbits scatter by less than 4
    let [flat, interpolated] = [error(0) / error(2), error(3) / error(5)];
    assert!((25.0..400.0).contains(&flat), "{flat}");
    assert!((2500.0..40_000.0).contains(&interpolated), "{interpolated}");
}

#[test]
fn the_chart_is_well_formed() {
    let text = chart::draw(&scores("square", Law::Specular, &["exact", "textbook f32"])).to_string();
    let document = roxmltree::Document::parse(&text).unwrap();
    let texts: Vec<_> = document.descendants().filter_map(|node| node.text()).collect();
    assert!(["exact", "textbook f32", "square"].iter().all(|name| texts.contains(name)) && !text.contains("NaN"));
}

/// Runs a case and finds nothing lost.
fn under_stress(name: &str, most_error: f64) -> Tally {
    let tally = stress::cases(Some(name))[0].run(Effort::Quick).result.unwrap();
    assert_eq!(tally.lost, 0, "{tally:?}");
    assert!(tally.orbits > 0 && tally.error <= most_error, "{tally:?}");
    tally
}

/// Energy is restored every sixteenth collision: what up to sixteen of them round off is there, at random, a dozen roundings of ½ ulp
/// each: 4 times that, and as much again for the worst of many orbits.
const ENERGY: f64 = 8.0 * 12.0 * 0.5 * f64::EPSILON;

#[test]
fn a_thin_wedge_lets_a_specular_particle_go_after_three_million_collisions() {
    // one rounding per collision
    assert!(under_stress("thin specular wedge", 3.2e6 * f64::EPSILON).collisions > 3_000_000);
}

#[test]
fn a_thin_wedge_holds_a_no_slip_particle_at_its_momentum() {
    // the law's matrix is orthogonal to an ulp, and what it misses of the energy in 10⁴ collisions the engine adds to the
    // normal part of the velocity, of which the flattest start has a tenth
    under_stress("thin no-slip wedge", 1e4 * f64::EPSILON * 100.0);
}

#[test]
fn names_of_cases_can_be_listed_between_commas() {
    assert!(stress::CASES.iter().all(|case| !case.name.contains(',')));
}

#[test]
fn nothing_is_lost_in_a_needle() {
    under_stress("needle", ENERGY);
}

#[test]
fn nothing_is_lost_where_arcs_nearly_touch() {
    under_stress("narrow gaps", ENERGY);
    under_stress("thin horns", ENERGY);
    under_stress("cusp", ENERGY);
}

#[test]
fn the_limits_of_gamma_are_reached() {
    // ten collisions at 2γ and 2/γ with γ = 10^±12
    under_stress("gamma to 0", 1e-10);
    under_stress("gamma to infinity", 1e-10);
}

#[test]
fn mass_ratios_do_not_matter() {
    // a cross product, a sum and a product on the way to the impulse and back
    under_stress("mass ratios", 32.0 * f64::EPSILON);
}

#[test]
fn units_do_not_matter_at_all() {
    under_stress("tables of size 1e+-150", 0.0);
    under_stress("speeds of 1e+-150", 0.0);
}

#[test]
fn starts_next_to_walls_and_vertices_stay_inside() {
    under_stress("starts next to a wall", ENERGY);
    under_stress("starts next to a vertex", ENERGY);
}

#[test]
fn a_hundred_thousand_pieces_are_an_outline_like_any_other() {
    under_stress("a million pieces", ENERGY);
}

#[test]
fn a_stress_report_is_json() {
    let all: Value = serde_json::from_slice(&bench(&["--stress", "--quick", "--json", "--only", "cusp"])).unwrap();
    let case = &all["cases"][0];
    assert_eq!((case["name"].as_str(), case["lost"].as_u64()), (Some("cusp"), Some(0)));
    assert!(case["stops"].is_object() && case["worst_error"].is_number());
}

#[test]
fn files_are_written_though_nobody_reads_what_is_printed() {
    let folder = std::env::temp_dir().join(format!("billiards-bench-{}", std::process::id()));
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("billiards"));
    command.args(["bench", "--stress", "--quick", "--only", "cusp", "--out"]).arg(&folder);
    let mut child = command.stdout(std::process::Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    let all: Value = serde_json::from_slice(&std::fs::read(folder.join("stress.json")).unwrap()).unwrap();
    assert_eq!(all["cases"][0]["name"], "cusp");
    std::fs::remove_dir_all(&folder).unwrap();
    // and where they cannot be, that is told before the work
    let file = std::env::temp_dir().join(format!("billiards-bench-file-{}", std::process::id()));
    std::fs::write(&file, "").unwrap();
    let told = Command::cargo_bin("billiards").unwrap().args(["bench", "--json", "--out"]).arg(&file).output().unwrap();
    assert_eq!(told.status.code(), Some(1));
    assert!(told.stdout.is_empty() && String::from_utf8(told.stderr).unwrap().contains("bench.json"));
    std::fs::remove_file(&file).unwrap();
}
