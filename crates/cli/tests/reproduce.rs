//! `billiards reproduce`: the page is whole, the same every time, and tells what it cannot find.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use billiards_cli::reproduce::page::{self, Measured};
use billiards_cli::reproduce::{Effort, figures};
use paper::{Measurement, Quantity};

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("billiards-reproduce-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn reproduce(words: &[&str], out: &Path) -> assert_cmd::assert::Assert {
    Command::cargo_bin("billiards").unwrap().arg("reproduce").args(words).arg("--out").arg(out).assert()
}

#[test]
fn every_figure_is_well_formed_the_same_every_time_and_that_of_the_gallery() {
    for figure in figures::all() {
        let once = (figure.draw)(Effort::Quick).unwrap_or_else(|e| panic!("{}: {e}", figure.name)).to_string();
        let options = roxmltree::ParsingOptions { nodes_limit: u32::MAX, ..Default::default() };
        roxmltree::Document::parse_with_options(&once, options).unwrap_or_else(|e| panic!("{}: {e}", figure.name));
        // Outside of the pixels in base 64.
        let mut parts = once.split("base64,");
        let before = parts.next().into_iter();
        let mut drawn = before.chain(parts.filter_map(|part| part.split_once('"')).map(|(_, rest)| rest));
        assert!(drawn.all(|part| !part.contains("NaN")), "{}", figure.name);
        let twice = (figure.draw)(Effort::Quick).unwrap().to_string();
        assert!(once == twice, "{}", figure.name);
        let gallery = format!("{}/../../docs/gallery/{}.svg", env!("CARGO_MANIFEST_DIR"), figure.name);
        let kept = fs::read_to_string(gallery).unwrap();
        assert!(once == kept, "{}: draw the gallery anew, as docs/GALLERY.md says", figure.name);
    }
}

#[test]
fn names_are_unique_among_figures_and_among_claims() {
    let figures: Vec<_> = figures::all().iter().map(|f| f.name).collect();
    let claims: Vec<_> = paper::claims::all().iter().map(|c| c.name).collect();
    for names in [figures, claims] {
        let unique: std::collections::BTreeSet<_> = names.iter().collect();
        assert_eq!(unique.len(), names.len());
    }
}

#[test]
fn one_figure_makes_its_page_and_its_picture() {
    let out = folder("one");
    reproduce(&["--quick", "--only", "strip"], &out).success();
    let mut files: Vec<_> =
        fs::read_dir(&out).unwrap().map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
    files.sort();
    assert_eq!(files, ["strip.html", "strip.svg"]);
    let page = fs::read_to_string(out.join("strip.html")).unwrap();
    assert!(page.contains("<code>billiards reproduce --quick --only strip</code>"), "the command of this picture");
    assert!(page.contains("src=\"data:image/svg+xml,%3C?xml") && page.contains("href=\"strip.svg\""));
    let addresses = page.split("http").skip(1).filter(|rest| !rest.starts_with("://www.w3.org/2000/svg%22"));
    assert!(!page.contains("<script") && addresses.count() == 0, "the page needs nothing from elsewhere");
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn one_claim_is_measured_with_its_verdict() {
    let out = folder("claim");
    fs::create_dir_all(&out).unwrap();
    let whole = ["index.html", "claims.json"];
    for name in whole {
        fs::write(out.join(name), "of a whole run").unwrap();
    }
    reproduce(&["--quick", "--only", "strip-width"], &out).success();
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(out.join("strip-width.json")).unwrap()).unwrap();
    let claim = &json["claims"][0];
    assert_eq!((claim["name"].as_str(), claim["consistent"].as_bool()), (Some("strip-width"), Some(true)));
    assert!(claim["measured"].as_array().is_some_and(|m| !m.is_empty()));
    assert!(fs::read_to_string(out.join("strip-width.html")).unwrap().contains("id=\"claim-strip-width\""));
    assert!(whole.iter().all(|name| fs::read_to_string(out.join(name)).unwrap() == "of a whole run"));
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn the_page_prints_the_inequality_that_was_tried() {
    let quantities = vec![
        Quantity::at_least("narrow", 0.99, 1.0, 0.02),
        Quantity::at_most("wide", 0.9, 1.0, -0.05),
        Quantity::differs("apart", 0.75, 0.5, 0.125),
        Quantity::sampled_near("near", 0.5, 0.0625, 0.25, 0.1875),
    ];
    let measured = Measured { claim: &paper::claims::all()[0], measurement: Measurement { quantities } };
    let page = page::html(&[], &[measured], &[], Effort::Quick);
    for text in
        ["0.99 ≥ 0.98", "0.9 ≤ 0.95", "0.75 differs from 0.5 by more than 0.125", "expected 0.25, known to 0.1875"]
    {
        assert!(page.contains(text), "{text}");
    }
    assert!(!page.contains("disagrees</b>"));
}

#[test]
fn every_link_within_the_page_has_its_goal() {
    for claim in paper::claims::all() {
        let measurement = Measurement { quantities: vec![] };
        let page = page::html(&[], &[Measured { claim, measurement }], &[], Effort::Quick);
        let goals = page.split("href=\"#").skip(1).filter_map(|rest| rest.split_once('"')).map(|(goal, _)| goal);
        let goals: Vec<_> = goals.collect();
        assert!(!goals.is_empty());
        assert!(goals.iter().all(|goal| page.contains(&format!("id=\"{goal}\""))), "{}: {goals:?}", claim.name);
    }
}

#[test]
fn a_page_and_claims_that_are_not_all_say_so() {
    let page = |left_out: &[&str]| page::html(&[], &[], left_out, Effort::Quick);
    assert!(page(&["hexagon", "strip-width"]).contains("interrupted.</b> Not on this page: hexagon, strip-width."));
    assert!(!page(&[]).contains("interrupted"));
    assert_eq!(page::claims_json(&[], &["hexagon"])["left_out"][0], "hexagon");
    assert_eq!(page::claims_json(&[], &[]).get("left_out"), None);
}

#[cfg(unix)]
#[test]
fn an_interrupted_reproduction_fails() {
    let out = folder("interrupted");
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("billiards"));
    let command = command.args(["reproduce", "--quick", "--out"]).arg(&out).stderr(std::process::Stdio::piped());
    let run = command.spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    let sent = std::process::Command::new("kill").args(["-s", "TERM", &run.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let output = run.wait_with_output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(1) && told.contains("error: interrupted: "), "{told}");
    if let Ok(page) = fs::read_to_string(out.join("index.html")) {
        assert!(page.contains("The computation was interrupted"));
    }
    let _ = fs::remove_dir_all(out);
}

#[test]
fn an_unknown_name_is_bad_input_and_writes_nothing() {
    let out = folder("unknown");
    let output = reproduce(&["--only", "hexagn"], &out).failure().code(2).get_output().clone();
    assert!(String::from_utf8(output.stderr).unwrap().contains("hexagon"));
    assert!(!out.exists());
}

#[test]
fn the_list_names_all() {
    let output = Command::cargo_bin("billiards").unwrap().args(["reproduce", "--list"]).assert().success();
    let text = String::from_utf8(output.get_output().stdout.clone()).unwrap();
    assert!(figures::all().iter().all(|f| text.contains(f.name)));
    assert!(paper::claims::all().iter().all(|c| text.contains(c.name)));
}

#[test]
fn the_gallery_shows_every_figure_with_its_command() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let [readme, gallery] = ["README.md", "docs/GALLERY.md"].map(|name| fs::read_to_string(root.join(name)).unwrap());
    for figure in figures::all() {
        let (file, command) = (format!("gallery/{}.svg", figure.name), format!("--quick --only {}", figure.name));
        assert!(root.join("docs").join(&file).is_file(), "docs/{file} is missing");
        assert!(readme.contains(&format!("docs/{file}")) && readme.contains(&command), "README: {}", figure.name);
        assert!(gallery.contains(&file) && gallery.contains(&command), "GALLERY: {}", figure.name);
    }
}
