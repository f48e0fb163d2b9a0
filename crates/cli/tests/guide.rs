//! The guide tells the truth: each of its examples is read, and nothing that a scene can name is missing.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

use billiards_cli::commands::{collide, guide::GUIDE};
use billiards_cli::contact_file::ContactFile;
use billiards_cli::document::Source;
use billiards_cli::picture::PICTURES;
use billiards_cli::record::FORMATS;
use billiards_cli::scene::{INERTIAS, LAWS, Request, SAMPLES, Scene};
use billiards_cli::simulation::{Control, Simulation};

/// The examples.
fn examples() -> Vec<&'static str> {
    GUIDE.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

/// A part of a scene, with what it lacks.
fn completed(example: &str) -> String {
    let has = |starts: &[&str]| example.lines().any(|line| starts.iter().any(|start| line.starts_with(start)));
    let mut scene = String::new();
    if !has(&["law", "rough"]) {
        scene += "law = \"no-slip\"\n";
    }
    scene += example;
    if !has(&["[table]", "[[table."]) {
        scene += "\n[table]\nname = \"stadium\"\n";
    }
    if !has(&["[[orbit]]", "[ensemble]"]) {
        scene += "\n[ensemble]\ncount = 10\n";
    }
    if !has(&["[run]"]) {
        scene += "\n[run]\ncollisions = 10\n";
    }
    scene
}

#[test]
fn every_example_of_the_guide_is_a_scene() {
    let examples = examples();
    assert!(examples.len() > 10);
    for example in examples {
        if example.starts_with("dim") {
            let contact = ContactFile::parse(&Source::new("contact.toml", example)).unwrap();
            // u = (3, -1), and a disk resists with a third of its mass along the floor
            let impulse = collide::outcome(&contact).unwrap().impulse;
            assert!((impulse[0] + 2.0).abs() < 1e-15 && (impulse[1] - 2.0).abs() < 1e-15, "{impulse:?}");
            continue;
        }
        let text = completed(example);
        let said = |errors: Vec<_>| -> String { errors.iter().map(ToString::to_string).collect() };
        let scene = Scene::parse(&Source::new("scene.toml", &text), &Request::default());
        let scene = scene.unwrap_or_else(|errors: Vec<billiards_cli::document::Diagnostic>| panic!("{}", said(errors)));
        let simulation = Simulation::new(scene).unwrap_or_else(|errors| panic!("{}\n{text}", said(errors)));
        let described = simulation.describe();
        assert!(!described.starts.is_empty(), "{text}");
        let folder = std::env::temp_dir().join(format!("billiards-guide-{}", std::process::id()));
        let done = simulation.run(&folder, &Control::new(1)).unwrap();
        std::fs::remove_dir_all(folder).unwrap();
        assert!(done.summary.collisions > 0, "there is nothing to see: {text}");
    }
}

#[test]
fn the_guide_names_all_that_a_scene_can_name() {
    let pictures = PICTURES.iter().map(|picture| picture.name);
    let samples = SAMPLES.iter().map(|(name, _)| *name);
    let words = LAWS.iter().map(|law| law.name).chain(INERTIAS.iter().map(|i| i.name)).chain(pictures).chain(samples);
    let words = words.chain(FORMATS.iter().map(|format| format.name));
    for word in words.chain(["finished", "corner", "grazing", "escaped", "stalled", "interrupted"]) {
        let named = ["`", "\"", ".", "\\\""].iter().any(|quote| GUIDE.contains(&format!("{quote}{word}")));
        assert!(named, "{word}");
    }
    for key in
        ["loop", "chain", "circle", "ellipse", "line", "ray", "curve", "shape", "outline", "sphere", "plane", "mesh"]
    {
        assert!(GUIDE.contains(&format!("{key} = ")), "{key}");
    }
}
