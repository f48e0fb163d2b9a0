//! Explicit boundaries in space.

use std::f64::consts::PI;

use assert_cmd::Command;

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

/// The error of the last collision of the first orbit, as the summary tells it.
fn told(folder: &Folder, scene: &str) -> f64 {
    folder.done(scene, &[])["horizon"]["orbits"][0]["error"].as_f64().unwrap()
}

#[test]
fn the_horizon_of_a_slab_is_that_of_its_planes_upright_and_askew() {
    let folder = Folder::new("slabs");
    let scene = |table: &str, position: [f64; 3], velocity: [f64; 3]| {
        format!(
            "law = \"specular\"\n[table]\ndimension = 3\n{table}[[orbit]]\nposition = {position:?}\n\
             velocity = {velocity:?}\n[run]\ncollisions = 2000\n"
        )
    };
    let plane = |through: [f64; 3], normal: [f64; 3]| {
        format!("[[table.boundary]]\nplane = {{ through = {through:?}, normal = {normal:?} }}\n")
    };
    let (position, velocity) = ([0.0, 0.0, 0.5], [1.0, 0.3, 0.0037]);
    let named = told(&folder, &scene("name = \"slab\"\n", position, velocity));
    let turned = |[x, y, z]: [f64; 3]| [x, 0.6 * y - 0.8 * z, 0.8 * y + 0.6 * z];
    for (of_what, turn) in [("upright", &(|p| p) as &dyn Fn([f64; 3]) -> [f64; 3]), ("askew", &turned)] {
        let planes =
            plane(turn([0.0; 3]), turn([0.0, 0.0, 1.0])) + &plane(turn([0.0, 0.0, 1.0]), turn([0.0, 0.0, -1.0]));
        let error = told(&folder, &scene(&planes, turn(position), turn(velocity)));
        assert!((0.3..3.0).contains(&(error / named)), "{of_what}: {error:e}, named {named:e}");
    }
}

#[test]
fn the_horizon_knows_how_large_the_numbers_of_a_wall_are() {
    let folder = Folder::new("large");
    let cube = "[[table.boundary]]\nshape = { name = \"cuboid\", size = [4, 4, 4], domain = \"inside\" }\n";
    for wall in [
        "sphere = { center = [0, 0, -1000000001], radius = 1e9, domain = \"outside\" }",
        "plane = { through = [0, 6e8, -8e8], normal = [0, 0.8, 0.6] }",
    ] {
        let error = told(
            &folder,
            &format!(
                "law = \"specular\"\n[table]\ndimension = 3\n{cube}[[table.boundary]]\n{wall}\n[[orbit]]\n\
                 position = [0.1, 0.2, 0.3]\nvelocity = [0.01, -0.5, -0.8]\n[run]\ncollisions = 3\n"
            ),
        );
        // an ulp of 10⁹ is 10⁻⁷
        assert!(error > 1e-8, "{wall}: {error:e}");
    }
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
    let bent = 0.5 * (1.5 * PI + 3.0 * 2.0_f64.sqrt() * (PI - libm::acos(1.0 / 3.0_f64.sqrt())));
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

/// A box with a wall of another kind in it, a pyramid whose coordinates single precision holds.
fn around(pyramid: &str) -> String {
    format!(
        "law = \"no-slip\"\n[table]\ndimension = 3\n[[table.boundary]]\n\
         shape = {{ name = \"cuboid\", size = [8, 8, 8], domain = \"inside\" }}\n[[table.boundary]]\n{pyramid}\n\
         [particle]\nradius = 0.25\ninertia = \"uniform-ball\"\n\
         [ensemble]\ncount = 20\nseed = 3\n[run]\ncollisions = 20\n[output]\ncollisions = \"csv\"\n"
    )
}

#[test]
fn triangles_come_from_a_file() {
    let folder = Folder::new("mesh");
    let inline = "shape = { name = \"trimesh\", points = [[0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1], [1, 1, 2]], \
                  triangles = [[3, 2, 1], [3, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]] }";
    folder.done(&around(inline), &[]);
    let expected = folder.read("out/collisions.csv");
    assert!(expected.lines().any(|row| row.split(',').nth(3) == Some("1")), "the pyramid is hit");
    let obj = "o pyramid\nv 0 0 0\nv 200 0 0\nv 200 200 0\nv 0 200 0\nv 100 100 100\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    std::fs::write(folder.0.join("pyramid.obj"), obj).unwrap();
    let corners = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 1]];
    let facet = |t: [usize; 3]| {
        let vertices = t.map(|k| format!("vertex {} {} {}\n", corners[k][0], corners[k][1], corners[k][2])).concat();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let facets = [[3, 2, 1], [3, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]].map(facet).concat();
    std::fs::write(folder.0.join("pyramid.STL"), format!("solid pyramid\n{facets}endsolid pyramid\n")).unwrap();
    for mesh in ["file = \"pyramid.obj\", unit = 0.01", "file = \"pyramid.STL\""] {
        folder.done(&around(&format!("mesh = {{ {mesh}, center = [0, 0, 1] }}")), &[]);
        assert_eq!(folder.read("out/collisions.csv"), expected, "{mesh}");
        let file = mesh.split('"').nth(1).unwrap();
        let hash = billiards_cli::sha256::hex(&std::fs::read(folder.0.join(file)).unwrap());
        assert_eq!(folder.summary("out")["inputs"], serde_json::json!({ file: hash }));
    }
    // without its last face
    std::fs::write(folder.0.join("open.obj"), obj.rsplit_once("f 4").unwrap().0).unwrap();
    let open = around("mesh = { file = \"open.obj\", unit = 0.01 }");
    let orbit = "[[orbit]]\nposition = [0, 0, -3]\nvelocity = [1, 0, 0]\n";
    std::fs::write(folder.0.join("open.toml"), open.replace("[ensemble]\ncount = 20\nseed = 3\n", orbit)).unwrap();
    let mut check = Command::cargo_bin("billiards").unwrap();
    let told = check.current_dir(&folder.0).args(["check", "open.toml"]).output().unwrap();
    let told = String::from_utf8(told.stdout).unwrap();
    assert!(told.contains("1  open.obj          open along 3 edges\n") && told.contains("0  cuboid\n"), "{told}");
    let output = folder.run(&open, &[]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("scene.toml:11:1") && told.contains("piece 1 is an open surface that ends inside the room"));
    let refused = |file: &str, what: &str| {
        let output = folder.run(&around(&format!("mesh = {{ file = \"{file}\" }}")), &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(what) && told.contains("scene.toml:7:17"), "{told}");
    };
    std::fs::write(folder.0.join("broken.obj"), obj.replace("f 2 3 5", "f 2 3 six")).unwrap();
    std::fs::write(folder.0.join("short.stl"), [1; 200]).unwrap();
    std::fs::write(folder.0.join("huge.obj"), obj.replace("v 0 0 0", "v 0 0 1e200")).unwrap();
    refused("huge.obj", "line 2: \"1e200\" is not a coordinate");
    refused("pyramid.obj\", unit = \"1e149", "the largest coordinate of pyramid.obj is 2e151");
    refused("none.obj", "cannot read");
    refused("scene.toml", "a mesh is read from a .stl or .obj file");
    refused("broken.obj", "line 9: ");
    refused("short.stl", "valid STL neither as text nor as binary");
}

#[test]
fn a_start_between_parts_of_a_mesh_or_along_its_face_is_refused() {
    let folder = Folder::new("touching");
    // two cubes of edge 1 that share a part of a side
    let corners = |low: [f64; 3]| (0..8).map(move |k| [0, 1, 2].map(|i| low[i] + f64::from(k >> i & 1)));
    let points: Vec<[f64; 3]> = corners([0.0; 3]).chain(corners([1.0, 0.25, 0.25])).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let cube = |first: usize| {
        sides.iter().flat_map(move |[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]].map(|t| t.map(|k| k + first)))
    };
    let triangles: Vec<[usize; 3]> = cube(0).chain(cube(8)).collect();
    let refused = |radius: f64, position: [f64; 3], velocity: [f64; 3]| {
        let scene = format!(
            "law = \"no-slip\"\n[table]\ndimension = 3\n[[table.boundary]]\n\
             sphere = {{ center = [1, 0.5, 0.5], radius = 4 }}\n[[table.boundary]]\n\
             shape = {{ name = \"trimesh\", points = {points:?}, triangles = {triangles:?} }}\n\
             [particle]\nradius = {radius}\ninertia = \"uniform-ball\"\n\
             [[orbit]]\nposition = {position:?}\nvelocity = {velocity:?}\n[run]\ncollisions = 2\n"
        );
        let output = folder.run(&scene, &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.success() || told.contains("the start lies on a wall and does not move into the table"),
            "{told}"
        );
        !output.status.success()
    };
    for velocity in [[1.0, 0.1, 0.1], [-1.0, 0.1, 0.1]] {
        assert!(refused(0.0, [1.0, 0.65, 0.6], velocity));
    }
    assert!(!refused(0.0, [1.0, 0.125, 0.125], [1.0, 0.1, 0.1]) && refused(0.0, [1.0, 0.125, 0.125], [-1.0, 0.1, 0.1]));
    for radius in [0.0, 0.125] {
        for [y, z] in [[0.07, 0.49], [0.3, 0.2], [0.65, 0.41], [0.88, 0.6]] {
            for [vy, vz] in [[-0.32, 0.29], [0.3, 0.4], [-1.1, -0.7], [0.0, 1.0]] {
                assert!(refused(radius, [-radius, y, z], [0.0, vy, vz]), "{radius} {y} {z} {vy} {vz}");
            }
        }
    }
}

#[test]
fn the_volume_in_which_a_centre_moves_is_told_as_that() {
    let folder = Folder::new("centres");
    let told = |particle: &str, form: &[&str]| {
        let scene = format!(
            "law = \"specular\"\n[table]\ndimension = 3\nname = \"ball\"\n{particle}[[orbit]]\nposition = [0, 0, 0]\n\
             velocity = [1, 0, 0]\n[run]\ncollisions = 1\n"
        );
        std::fs::write(folder.0.join("ball.toml"), scene).unwrap();
        let mut check = Command::cargo_bin("billiards").unwrap();
        let told = check.current_dir(&folder.0).args(["check", "ball.toml"]).args(form).output().unwrap();
        String::from_utf8(told.stdout).unwrap()
    };
    let with_radius = "[particle]\nradius = 0.1\n";
    let (point, ball) = (told("", &[]), told(with_radius, &[]));
    // 4π/3, and 0.9³ of it
    assert!(point.contains("volume      4.18879\n") && !point.contains("centre moves"), "{point}");
    let of_centre = "a ball of radius 0.1; volume and surface are of the region in which its centre moves";
    assert!(ball.contains("volume      3.05363\n") && ball.contains(of_centre), "{ball}");
    for (particle, radius) in [("", 0.0), (with_radius, 0.1)] {
        let json: serde_json::Value = serde_json::from_str(&told(particle, &["--json"])).unwrap();
        let is = |found: &serde_json::Value, expected: f64| (found.as_f64().unwrap() / expected - 1.0).abs() < 1e-15;
        let is_ball = |region: &serde_json::Value, radius: f64| {
            let volume = 4.0 / 3.0 * PI * radius * radius * radius;
            is(&region["surface"], 4.0 * PI * radius * radius)
                && [&region["volume"], &region["parts"][0]].iter().all(|found| is(found, volume))
        };
        assert!(is_ball(&json["walls"], 1.0), "{json}");
        assert_eq!(json["centres"].is_null(), radius == 0.0, "{json}");
        assert!(radius == 0.0 || is_ball(&json["centres"], 1.0 - radius), "{json}");
    }
}

#[test]
fn rooms_that_cannot_be_filled_are_refused() {
    let folder = Folder::new("rooms-refused");
    let tilted = "plane = { through = [0, 0, 4], normal = [0, 0, -1] }";
    let shape = "shape = { name = \"cylinder\", radius = 2, height = 3, center = [5, 0, -1], domain = \"inside\" }";
    let sphere = "sphere = { center = [5.5, 0, -1], radius = 0.5, domain = \"outside\" }";
    for (radius, this, instead, place, what) in [
        (0.0, shape, tilted, "11:1", "the area of the walls is infinite: there is no uniform distribution on it"),
        (0.0, sphere, "sphere = { center = [0, 0, 0], radius = 0.5 }", "11:1", "nothing is left of the walls"),
        (
            1.5,
            "",
            "",
            "9:10",
            "a ball of radius 1.5 has no room to move in the table; its radius must be less than 1.5",
        ),
        (1.2, "", "", "9:10", "a ball of radius 1.2 has no room to move between the walls"),
        (0.0, "seed = 3", "sample = \"grid\"", "13:10", "in space, the sample must be \"canonical\""),
    ] {
        let scene = can(radius).replacen(this, instead, 1);
        let output = folder.run(&scene, &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(what) && told.contains(&format!("scene.toml:{place}")), "{told}");
    }
}

#[test]
fn a_ball_for_which_there_is_no_place_is_told_so_wherever_it_starts() {
    let folder = Folder::new("rooms-no-place");
    let walls =
        ["sphere = { center = [0, 0, 0], radius = 1 }", "plane = { through = [0, 0, 0.5], normal = [0, 0, 1] }"];
    let scene = |radius: f64, height: f64| {
        one(&walls, &format!("[0, 0, {height}]"), "[1, 0, 0.5]") + &format!("[particle]\nradius = {radius}\n")
    };
    let told = |radius: f64, height: f64| String::from_utf8(folder.run(&scene(radius, height), &[]).stderr).unwrap();
    // the largest one has radius 1/4
    for height in [0.75, 0.9, 3.0] {
        let told = told(0.3, height);
        assert!(told.contains("a ball of radius 0.3 has no room to move between the walls"), "{told}");
        assert!(told.contains("help: make the radius smaller"), "{told}");
    }
    let elsewhere = told(0.2, 0.6);
    assert!(elsewhere.contains("does not fit there") && elsewhere.contains("help: move the start into"), "{elsewhere}");
    assert_eq!(folder.done(&scene(0.2, 0.75), &[])["stops"]["finished"], 1);
}

/// A room with these walls and one orbit.
fn one(walls: &[&str], position: &str, velocity: &str) -> String {
    let walls = walls.iter().map(|wall| format!("[[table.boundary]]\n{wall}\n")).collect::<Vec<_>>().concat();
    format!(
        "law = \"specular\"\n[table]\ndimension = 3\n{walls}[[orbit]]\nposition = {position}\nvelocity = {velocity}\n\
         [run]\ncollisions = 1\n"
    )
}

#[test]
fn a_start_on_a_wall_is_on_it_within_the_rounding_of_the_wall() {
    let folder = Folder::new("rooms-rounding");
    for (wall, position, velocity) in [
        ("plane = { through = [1e3, -1e3, 0.3], normal = [1, 1, 1] }", "[0.3, 0, 0]", "[1, 1, 1]"),
        ("shape = { name = \"cuboid\", center = [100.1, 0, 0], size = [199.4, 3, 3] }", "[0.4, 0, 0.1]", "[-1, 0, 0]"),
    ] {
        let around = "sphere = { center = [0, 0, 0], radius = 5000 }";
        let summary = folder.done(&one(&[wall, around], position, velocity), &[]);
        assert_eq!(summary["stops"]["finished"], 1, "{wall}");
    }
}

#[test]
fn a_start_on_an_edge_must_leave_all_faces_of_a_container() {
    let folder = Folder::new("rooms-edge");
    let cuboid = "shape = { name = \"cuboid\", size = [1, 1, 1], domain = \"inside\" }";
    for velocity in ["[-1, 1, 0]", "[1, -1, 0]", "[-1, -1, 0.5]"] {
        let output = folder.run(&one(&[cuboid], "[-0.5, -0.5, 0]", velocity), &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains("scene.toml:7:12") && told.contains("does not move into the table"), "{told}");
    }
    assert_eq!(folder.done(&one(&[cuboid], "[-0.5, -0.5, 0]", "[1, 2, 0]"), &[])["stops"]["finished"], 1);
}

#[test]
fn a_start_on_an_edge_of_an_obstacle_may_leave_past_any_of_its_faces() {
    let folder = Folder::new("rooms-past-edge");
    let around = "sphere = { center = [0, 0, 0], radius = 5 }";
    for (obstacle, position, past, into) in [
        ("name = \"cylinder\", radius = 1, height = 2", "[1, 0, 1]", "[1, 0.5, -1]", "[-1, 0.5, -1]"),
        ("name = \"cone\", radius = 1, height = 2", "[0, 0, 1]", "[-1, 0, -1]", "[-0.25, 0, -1]"),
        (
            "name = \"convex-hull\", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]",
            "[0.5, 0, 0]",
            "[0.2, -1, 0.3]",
            "[0.2, 1, 0.3]",
        ),
    ] {
        let walls = [around, &format!("shape = {{ {obstacle} }}")];
        let summary = folder.done(&one(&walls, position, past), &[]);
        assert_eq!(summary["stops"]["finished"], 1, "{obstacle}");
        let output = folder.run(&one(&walls, position, into), &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && told.contains("does not move into the table"), "{told}");
    }
}

#[test]
fn a_start_that_moves_along_a_wall_in_space_is_refused() {
    let folder = Folder::new("rooms-along");
    let floor = "plane = { through = [0, 0, 0], normal = [0, 0, 1] }";
    let output = folder.run(&one(&[floor], "[1, 2, 0]", "[1, -0.5, 0]"), &[]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("does not move into the table"), "{told}");
    assert_eq!(folder.done(&one(&[floor], "[1, 2, 0]", "[1, -0.5, 1e-9]"), &[])["stops"]["escaped"], 1);
}

#[test]
fn a_start_outside_two_walls_is_told_of_the_one_it_is_farther_beyond() {
    let folder = Folder::new("rooms-farther");
    let [x, y] =
        ["[1, 0, 0]", "[0, 1, 0]"].map(|normal| format!("plane = {{ through = [0, 0, 0], normal = {normal} }}"));
    for (walls, piece) in [([&x[..], &y], 1), ([&y, &x], 0)] {
        let output = folder.run(&one(&walls, "[-0.25, -0.5, 0]", "[1, 1, 0]"), &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains(&format!("0.5 beyond piece {piece}")), "{told}");
    }
}

#[test]
fn a_start_outside_is_told_of_which_piece_and_by_how_much() {
    let folder = Folder::new("rooms-outside");
    let walls = [
        "sphere = { center = [0, 0, 0], radius = 2 }",
        "sphere = { center = [0, 0, 0], radius = 0.5, domain = \"outside\" }",
    ];
    for (radius, position, what) in [
        (0.0, "[0.25, 0, 0]", "the start lies outside the table, 0.25 beyond piece 1"),
        (0.0, "[2.5, 0, 0]", "the start lies outside the table, 0.5 beyond piece 0"),
        (
            0.25,
            "[0.5, 0, 0]",
            "a ball of radius 0.25 does not fit there: its centre would be 0.25 beyond the limit set by piece 1",
        ),
    ] {
        let scene =
            one(&walls, position, "[1, 0, 0]").replace("[run]", &format!("[particle]\nradius = {radius}\n[run]"));
        let output = folder.run(&scene, &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(what) && told.contains("move the start"), "{told}");
    }
}

#[test]
fn a_start_behind_an_open_mesh_is_told_so_with_what_to_do() {
    let folder = Folder::new("rooms-behind");
    std::fs::write(folder.0.join("front.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n").unwrap();
    let mesh = |domain: &str| format!("mesh = {{ file = \"front.obj\", domain = \"{domain}\" }}");
    let scene = |radius: f64, mesh: &str, height: f64| {
        let walls = ["sphere = { center = [0, 0, 0], radius = 3 }", mesh];
        one(&walls, &format!("[0, 0, {height:?}]"), "[1, 0, 0]")
            .replace("[run]", &format!("[particle]\nradius = {radius}\n[run]"))
    };
    for (domain, other, front) in [("outside", "inside", 1.0), ("inside", "outside", -1.0)] {
        for radius in [0.0, 0.25] {
            for height in [0.125, 1.5] {
                let output = folder.run(&scene(radius, &mesh(domain), -front * height), &[]);
                let told = String::from_utf8_lossy(&output.stderr);
                assert_eq!(output.status.code(), Some(2), "{told}");
                let what = format!("the start lies {height} behind piece 1, an open mesh");
                let help = format!("start in front of it, or exchange its sides with domain = \"{other}\"");
                assert!(told.contains(&what) && told.contains(&help), "{told}");
            }
            folder.done(&scene(radius, &mesh(domain), front * 1.5), &[]);
            folder.done(&scene(radius, &mesh(other), -front * 1.5), &[]);
        }
        // in front, but too near
        let output = folder.run(&scene(0.25, &mesh(domain), front * 0.125), &[]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains("its centre would be 0.125 beyond the limit set by piece 1"), "{told}");
    }
}

#[test]
fn a_wall_in_space_may_have_a_law_of_its_own() {
    let folder = Folder::new("laws-in-space");
    let orbit = "[[orbit]]\nposition = [0.5, 0.5, 0.5]\nvelocity = [0.25, 0, -1]\nspin = [0.5, 0.25, 0.125]\n\
                 [run]\ncollisions = 2\n[output]\ncollisions = \"csv\"\n";
    let planes = |own: [&str; 2]| {
        let plane = |at: u32, up: i32, own: &str| {
            format!("[[table.boundary]]\nplane = {{ through = [0, 0, {at}], normal = [0, 0, {up}] }}\n{own}\n")
        };
        format!("[table]\ndimension = 3\n{}{}", plane(0, 1, own[0]), plane(1, -1, own[1]))
    };
    let slab = |laws: &str| format!("[table]\nname = \"slab\"\ndimension = 3\nlaws = {{ {laws} }}\n");
    // the floor is hit first: whether a wall turns the spin
    let turns = |law: &str, table: &str| {
        folder.done(&format!("law = \"{law}\"\n{table}{orbit}"), &[]);
        let spins: Vec<_> = folder.rows().into_iter().map(|row| row[10..].to_vec()).collect();
        [spins[0] != [0.5, 0.25, 0.125], spins[1] != spins[0]]
    };
    for (law, other) in [("specular", "no-slip"), ("no-slip", "specular")] {
        let rough = law == "no-slip";
        let own = format!("law = \"{other}\"");
        assert_eq!(turns(law, &planes(["", ""])), [rough; 2]);
        assert_eq!(turns(law, &planes([&own, ""])), [!rough, rough], "{law}");
        assert_eq!(turns(law, &planes(["", &own])), [rough, !rough], "{law}");
        assert_eq!(turns(law, &slab(&format!("1 = \"{other}\""))), [rough, !rough], "{law}");
    }
}
