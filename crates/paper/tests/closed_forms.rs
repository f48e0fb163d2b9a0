//! The closed forms of the wedge against values to 50 digits.
use paper::wedge;
use serde_json::Value;
use std::path::Path;

fn number(v: &Value) -> f64 {
    v.as_str().expect("a number as text").parse().expect("a number")
}

/// A few roundings of a number; angles of an arccosine lose the more the nearer its argument is to 1, not near here.
fn close(what: &str, ours: f64, v: &Value) {
    let certified = number(v);
    assert!(
        (ours - certified).abs() <= 8.0 * f64::EPSILON * certified.abs().max(1.0),
        "{what}: {ours} for {certified}"
    );
}

#[test]
fn wedges_agree_with_fifty_digits() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/closed_forms.json");
    let data: Value = serde_json::from_str(&std::fs::read_to_string(file).expect("the file")).expect("JSON");
    let entries = |name: &str| data[name].as_array().expect("a list").clone();
    let mut compared = 0;
    for (entry, periodic) in entries("wedge_nonperiodic")
        .iter()
        .map(|e| (e, false))
        .chain(entries("wedge_periodic").iter().map(|e| (e, true)))
    {
        let (theta, gamma_squared) = (number(&entry["theta"]), number(&entry["gamma_squared"]));
        close("δ", wedge::delta(theta, gamma_squared), &entry["delta"]);
        close("ρ", wedge::inradius(theta, gamma_squared), &entry["cap_angular_radius"]);
        let [b0, b1, b2] = wedge::axis(theta, gamma_squared);
        close("axis", b0 / b1, &entry["axis_x0dot_over_x1dot_update2"]);
        assert_eq!(b2, 0.0);
        if periodic {
            let q = u32::try_from(entry["q"].as_u64().expect("q")).expect("a small number");
            close("area", 2.0 * wedge::non_escape_area(theta, gamma_squared, Some(q)), &entry["nonescape_area_total"]);
            let p = entry["p"].as_f64().expect("p");
            let opening =
                wedge::opening(core::f64::consts::PI * p / f64::from(q), gamma_squared).expect("an angle below π");
            close("θ", opening, &entry["theta"]);
            assert_eq!(
                q,
                u32::try_from(entry["nonescape_polygon_sides"].as_u64().expect("sides")).expect("a small number")
            );
        } else {
            let area = 2.0 * wedge::non_escape_area(theta, gamma_squared, None);
            close("area", area, &entry["nonescape_area_total_if_nonperiodic"]);
        }
        compared += 1;
    }
    assert!(compared >= 9);
}
