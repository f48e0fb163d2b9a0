//! Explicit boundaries in space.

use std::f64::consts::PI;

use super::Folder;

/// A can with a ball in it, for particles of some radius.
fn can(radius: f64) -> String {
    format!(
        "law = \"no-slip\"\n[table]\ndimension = 3\n[[table.boundary]]\n\
         shape = {{ name = \"cylinder\", radius = 2, height = 3, center = [5, 0, -1], domain = \"inside\" }}\n\
         [[table.boundary]]\nsphere = {{ center = [5.5, 0, -1], radius = 0.5, domain = \"outside\" }}\n\
         [particle]\nradius = {radius}\ninertia = \"uniform-ball\"\n\
         [ensemble]\ncount = 4000\nseed = 3\nspeed = 2\n[run]\ncollisions = 20\n"
    )
}

#[test]
fn an_ensemble_fills_a_room_of_any_shape() {
    let folder = Folder::new("rooms");
    for radius in [0.0, 0.25] {
        let summary = folder.done(&can(radius), &[]);
        assert!(summary["energy_drift"].as_f64().unwrap() <= 4e-16);
        let (r, h, b) = (2.0 - radius, 3.0 - 2.0 * radius, 0.5 + radius);
        let volume = PI * r * r * h - 4.0 / 3.0 * PI * b * b * b;
        let area = 2.0 * PI * r * (r + h) + 4.0 * PI * b * b;
        // at speed 2
        let expected = 15.0 / 16.0 * PI * volume / area;
        let mean = summary["time"].as_f64().unwrap() / summary["collisions"].as_f64().unwrap();
        // 80 000 flights, which scatter by about their mean: five standard errors are 2 %
        assert!((mean / expected - 1.0).abs() < 0.02, "{radius}: {mean} for {expected}");
        assert!(summary["stops"]["finished"].as_u64().unwrap() >= 3999, "{}", summary["stops"]);
    }
}

#[test]
fn a_ball_moves_around_triangles_and_in_a_hull() {
    let folder = Folder::new("triangles");
    let points = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], center = [5, 0, -1]";
    let mesh = format!(
        "shape = {{ name = \"trimesh\", points = {points}, triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }}"
    );
    let around = can(0.25).replace("sphere = { center = [5.5, 0, -1], radius = 0.5, domain = \"outside\" }", &mesh);
    let hull = format!("shape = {{ name = \"convex-hull\", points = {points}, domain = \"inside\" }}");
    let (start, end) = (around.find("shape").unwrap(), around.find("[particle]").unwrap());
    let within = format!("{}{hull}\n{}", &around[..start], &around[end..]).replace("radius = 0.25", "radius = 0.1");
    // the corner of a cube and Steiner's formula around it; within, the tetrahedron about the same inscribed ball
    let [volume, area] = [1.0 / 6.0, 1.5 + 0.75_f64.sqrt()];
    let bent = 0.5 * (1.5 * PI + 3.0 * 2.0_f64.sqrt() * (PI - (1.0 / 3.0_f64.sqrt()).acos()));
    let r: f64 = 0.25;
    let left = 1.0 - 0.1 * area / (3.0 * volume);
    let outer = [
        PI * 1.75 * 1.75 * 2.5 - (volume + area * r + bent * r * r + 4.0 / 3.0 * PI * r * r * r),
        2.0 * PI * 1.75 * (1.75 + 2.5) + area + 2.0 * bent * r + 4.0 * PI * r * r,
    ];
    for (scene, [volume, area]) in [(around, outer), (within, [volume * left * left * left, area * left * left])] {
        let summary = folder.done(&scene, &[]);
        assert!(summary["energy_drift"].as_f64().unwrap() <= 4e-16);
        let expected = 15.0 / 16.0 * PI * volume / area;
        let mean = summary["time"].as_f64().unwrap() / summary["collisions"].as_f64().unwrap();
        assert!((mean / expected - 1.0).abs() < 0.02, "{mean} for {expected} in {scene}");
    }
}

#[test]
fn rooms_that_cannot_be_filled_are_refused() {
    let folder = Folder::new("rooms-refused");
    let tilted = "plane = { through = [0, 0, 4], normal = [0, 0, -1] }";
    let shape = "shape = { name = \"cylinder\", radius = 2, height = 3, center = [5, 0, -1], domain = \"inside\" }";
    let sphere = "sphere = { center = [5.5, 0, -1], radius = 0.5, domain = \"outside\" }";
    for (radius, this, instead, place, what) in [
        (0.0, shape, tilted, "11:1", "the table is unbounded"),
        (0.0, sphere, "sphere = { center = [0, 0, 0], radius = 0.5 }", "11:1", "nothing is left of the walls"),
        (
            1.5,
            "",
            "",
            "9:10",
            "a ball of radius 1.5 has no room to move in the table; its radius must be less than 1.5",
        ),
        (0.0, "seed = 3", "sample = \"grid\"", "11:1", "in space, the sample is \"canonical\""),
    ] {
        let scene = can(radius).replacen(this, instead, 1);
        let output = folder.run(&scene, &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(what) && told.contains(&format!("scene.toml:{place}")), "{told}");
    }
}
