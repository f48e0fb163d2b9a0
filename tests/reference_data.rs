//! The certified reference data lie complete in `tests/data`.
use std::path::Path;

#[test]
fn every_trajectory_of_the_index_is_there() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let index = std::fs::read_to_string(data.join("traj_index.json")).unwrap();
    let index: Vec<serde_json::Value> = serde_json::from_str(&index).unwrap();
    assert_eq!(index.len(), 80);
    for entry in index {
        let file = data.join(entry["file"].as_str().unwrap());
        assert!(file.is_file(), "{} is missing", file.display());
    }
}
