//! Outlines from maps.
use geometry::{Error, Table, import};
use proptest::prelude::*;

#[test]
fn maps_become_tables() {
    let polygon = r#"{"type": "Polygon", "coordinates": [
        [[0, 0], [0, 4], [4, 4], [4, 0], [0, 0]],
        [[1, 1], [2, 1, 99], [2, 2], [1, 2], [1, 1]]]}"#;
    let check = |text: &str, area: f64, parts: usize| {
        let t = Table::new(import::geojson(text).unwrap().pieces(1.0).unwrap().walls).unwrap();
        assert_eq!(t.validate(), Ok(()));
        assert_eq!((t.area(), t.components().len()), (area, parts));
    };
    check(polygon, 15.0, 1);
    check(&format!(r#"{{"type": "Feature", "properties": null, "geometry": {polygon}}}"#), 15.0, 1);
    let features = format!(
        r#"{{"type": "FeatureCollection", "features": [{{"type": "Feature", "geometry": null}},
            {{"type": "Feature", "geometry": {{"type": "GeometryCollection", "geometries": [{polygon}]}}}}]}}"#
    );
    check(&features, 15.0, 1);
    let many = r#"{"type": "MultiPolygon", "coordinates": [[[[0,0],[1,0],[1,1],[0,1],[0,0]]], [[[5,0],[6,0],[6,2],[5,2],[5,0]]]]}"#;
    check(many, 3.0, 2);
    check(&format!("\u{feff}{many}"), 3.0, 2);
    // an island in the hole of another polygon
    let island = r#"{"type": "MultiPolygon", "coordinates": [
        [[[0,0],[9,0],[9,9],[0,9],[0,0]], [[1,1],[8,1],[8,8],[1,8],[1,1]]], [[[2,2],[4,2],[4,3],[2,2]]]]}"#;
    check(island, 33.0, 2);
    // a polygon that fills the hole of another one: the wall between them is one on both sides
    let enclave = r#"{"type": "MultiPolygon", "coordinates": [
        [[[0,0],[9,0],[9,9],[0,9],[0,0]], [[1,1],[8,1],[8,8],[1,8],[1,1]]], [[[1,1],[8,1],[8,8],[1,8],[1,1]]]]}"#;
    check(enclave, 81.0, 2);
}

#[test]
fn rings_where_they_bound_no_table_are_refused_with_their_place() {
    let square = |at: f64, size: f64| {
        let end = at + size;
        format!("[[{at},{at}],[{end},{at}],[{end},{end}],[{at},{end}],[{at},{at}]]")
    };
    for (polygons, at, words) in [
        (
            format!("[{}, {}]", square(0.0, 4.0), square(5.0, 1.0)),
            "coordinates[0][1]",
            "this hole lies outside its polygon",
        ),
        (format!("[{}], [{}]", square(0.0, 4.0), square(1.0, 1.0)), "coordinates[1][0]", "lies inside another one"),
        ("[[[0,0],[1,0],[1,1]]]".into(), "coordinates[0][0]", "repeat its first position"),
    ] {
        let text = format!(r#"{{"type": "MultiPolygon", "coordinates": [{polygons}]}}"#);
        match import::geojson(&text) {
            Err(Error::Import { place, problem }) => {
                assert!(place == at && problem.contains(words), "{place}: {problem}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn a_key_that_a_map_has_twice_is_named_with_its_place() {
    let square = "[[[0, 0], [1, 0], [1, 1], [0, 0]]]";
    for (text, line, key) in [
        (format!("{{\"type\": \"Polygon\",\n\"coordinates\": {square},\n\"coordinates\": [[]]}}"), 3, "coordinates"),
        (
            format!(
                "{{\"type\": \"Feature\",\n\"properties\": {{\"a\": [{{\"b\": 1,\n \"b\": null}}]}},\n\
                 \"geometry\": {{\"type\": \"Polygon\", \"coordinates\": {square}}}}}"
            ),
            3,
            "b",
        ),
    ] {
        match import::geojson(&text) {
            Err(Error::Import { place, problem }) => {
                assert!(place.starts_with(&format!("line {line}, column ")), "{place}");
                assert_eq!(problem, format!("the key {key:?} occurs twice: keep one of them"));
            }
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn mistakes_in_maps_are_named_with_their_place() {
    for (text, at, words) in [
        ("{", "line 1, column 1", "EOF"),
        ("[]", "the file", "type"),
        (r#"{"type": "Point", "coordinates": [0, 0]}"#, "the file", "\"Point\" bounds no table"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0], [1, "x"]]]}"#, "coordinates[0][1]", "two finite numbers"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [0, 0]]]}"#, "coordinates[0]", "no area"),
        (r#"{"type": "Polygon", "coordinates": [[[0, 0]]]}"#, "coordinates[0]", "three different"),
        (
            r#"{"type": "Polygon", "coordinates": [[[0, 0], [1e200, 0], [0, 1e200]]]}"#,
            "coordinates[0]",
            "between 1e-150 and 1e150",
        ),
        (
            r#"{"type": "Polygon", "coordinates": [[[0, 0], [1e-200, 0], [0, 1e-200]]]}"#,
            "coordinates[0]",
            "between 1e-150 and 1e150",
        ),
        (
            r#"{"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": {"type": "Polygon"}}]}"#,
            "features[0].geometry",
            "must be a list",
        ),
    ] {
        match import::geojson(text) {
            Err(Error::Import { place, problem }) => {
                assert!(place == at && problem.contains(words), "{place}: {problem}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
    assert!(matches!(import::geojson(r#"{"type": "FeatureCollection", "features": []}"#), Err(Error::Empty)));
}

proptest! {
    #[test]
    fn json_of_any_kind_is_read_or_refused(text in "[\\[\\]{}\":,a-zA-Z0-9. ]{0,80}", kind in "Polygon|MultiPolygon|Feature") {
        let _ = import::geojson(&text);
        let _ = import::geojson(&format!("{{\"type\": \"{kind}\", \"coordinates\": [[[{text}]]], \"geometry\": [{text}]}}"));
    }
}
