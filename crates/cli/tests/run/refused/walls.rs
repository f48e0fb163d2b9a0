//! What is refused about walls, and about starts at them, and in which words.

use std::fs;

use assert_cmd::Command;

use super::{TORUS, refused};
use crate::Folder;

#[test]
fn a_circle_too_far_from_the_origin_is_told_to_move_nearer() {
    let folder = Folder::new("far-circle");
    let scene = "law = \"specular\"\n[[table.boundary]]\ncircle = { center = [1e15, 0], radius = 0.25 }\n[[orbit]]\nposition = [1e15, 0]\n\
                 velocity = [1, 0]\n[run]\ncollisions = 3\n";
    fs::write(folder.0.join("scene.toml"), scene).unwrap();
    let output =
        Command::cargo_bin("billiards").unwrap().current_dir(&folder.0).args(["run", "scene.toml"]).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains("scene.toml:3") && text.contains("move it nearer to the origin"), "{text}");
}

#[test]
fn a_piece_too_small_for_its_table_is_told_to_be_larger() {
    let folder = Folder::new("small-circle");
    let scene = "law = \"specular\"\n[table]\nboundary = [\n  { circle = { center = [0, 0], radius = 4 } },\n  \
                 { circle = { center = [\"2e-140\", 0], radius = \"1e-140\", domain = \"outside\" } },\n]\n[[orbit]]\n\
                 position = [0.5, 0]\nvelocity = [1, 0]\n[run]\ncollisions = 3\n";
    fs::write(folder.0.join("scene.toml"), scene).unwrap();
    let output =
        Command::cargo_bin("billiards").unwrap().current_dir(&folder.0).args(["run", "scene.toml"]).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{text}");
    for part in ["scene.toml:5", "piece 1 is only 2e-140 wide, and must be at least 4e-60", "make it larger"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn what_is_too_far_away_for_a_lattice_is_told() {
    let cases = [
        (
            TORUS,
            "center = [0.5, 0.5]",
            "center = [1e16, 0]",
            "scene.toml:5:10",
            "piece 0 lies 1e16 cells of the lattice away",
        ),
        (
            TORUS,
            "position = [0, 0.125]",
            "position = [0, 1e20]",
            "scene.toml:7:12",
            "lies 1e20 cells of the lattice away",
        ),
    ];
    refused(&Folder::new("far-away"), &cases);
}

#[test]
fn a_line_or_ray_with_the_table_on_its_right_is_told_to_be_turned() {
    let folder = Folder::new("turned");
    let scene = |walls: &[String], at: &str| {
        let walls = walls.iter().map(|wall| format!("[[table.boundary]]\n{wall}\n")).collect::<Vec<_>>().concat();
        format!("law = \"specular\"\n{walls}[[orbit]]\nposition = {at}\nvelocity = [0.6, 0.8]\n[run]\ncollisions = 1\n")
    };
    let told = |scene: &str| String::from_utf8(folder.run(scene, &[]).stderr).unwrap();
    let line = |height: u32, x: i32| format!("line = {{ through = [0, {height}], direction = [{x}, 0] }}");
    let same = told(&scene(&[line(0, 1), line(1, 1)], "[0, 2]"));
    assert!(same.contains("has the table on its right") && same.contains("help: reverse its `direction`"), "{same}");
    for (walls, at, stop) in
        [([line(0, -1), line(1, 1)], "[0, 2]", "escaped"), ([line(0, 1), line(1, -1)], "[0, 0.5]", "finished")]
    {
        assert_eq!(folder.done(&scene(&walls, at), &[])["stops"][stop], 1);
    }
    let wedge = |height: u32, sides: [&str; 2]| {
        [("1", sides[0]), ("-1", sides[1])]
            .map(|(x, side)| format!("ray = {{ from = [0, {height}], direction = [{x}, 1], domain = \"{side}\" }}"))
    };
    let both = |upper: [&str; 2]| [wedge(0, ["left", "right"]), wedge(1, upper)].concat();
    let inside = told(&scene(&both(["left", "right"]), "[0, 0.5]"));
    assert!(
        inside.contains("has the table on its right") && inside.contains("help: exchange \"left\" and"),
        "{inside}"
    );
    folder.done(&scene(&both(["right", "left"]), "[0, 0.5]"), &[]);
}

#[test]
fn rays_too_close_together_to_be_told_apart_are_no_wedge() {
    let folder = Folder::new("thin-wedge");
    let scene = |table: &str| {
        format!(
            "law = \"no-slip\"\n{table}\n[[orbit]]\nposition = [0, 1]\nvelocity = [0.6, -0.8]\n[run]\ncollisions = 3\n\
             [output]\ncollisions = \"csv\"\n"
        )
    };
    let wedge = |angle: f64| scene(&format!("[table]\nname = \"wedge\"\nangle = {angle:e}"));
    let rays = |x: f64| {
        let ray = |x: f64, side: &str| {
            format!("[[table.boundary]]\nray = {{ from = [0, 0], direction = [{x:e}, 1], domain = \"{side}\" }}\n")
        };
        scene(&(ray(x, "left") + &ray(-x, "right")))
    };
    for angle in [1e-150, 1e-16, 3e-16, 8e-16] {
        for thin in [wedge(angle), rays(0.5 * angle)] {
            let told = String::from_utf8(folder.run(&thin, &[]).stderr).unwrap();
            assert!(
                told.contains("pieces 0 and 1 run along each other") && told.contains("help: "),
                "{angle:e}: {told}"
            );
        }
    }
    for thin in [wedge(1e-15), rays(5e-16)] {
        assert_eq!(folder.done(&thin, &[])["stops"]["finished"], 1);
        let hit = &folder.rows()[0];
        assert!(hit[3] == 0.0 && (hit[2] / (5e-16 / 0.6) - 1.0).abs() < 1e-9, "{hit:?}");
    }
}

#[test]
fn a_start_from_which_rounding_decides_what_is_hit_is_told_to_come_nearer() {
    let folder = Folder::new("remote");
    let disk = "[[table.boundary]]\ncircle = { center = [0, 0], radius = 1, domain = \"outside\" }\n";
    let tiny = disk.replace("radius = 1", "radius = 1e-4");
    let sphere = "[table]\ndimension = 3\n[[table.boundary]]\nsphere = { center = [0, 0, 0], radius = 1, domain = \"outside\" }\n";
    let cuboid = "[table]\ndimension = 3\n[[table.boundary]]\nshape = { name = \"cuboid\", size = [2, 2, 2] }\n";
    let scene = |walls: &str, position: &str, velocity: &str| {
        format!(
            "law = \"specular\"\n{walls}[[orbit]]\nposition = {position}\nvelocity = {velocity}\n[run]\ncollisions = 1\n\
             [output]\ncollisions = \"csv\"\n"
        )
    };
    for (walls, position, velocity) in [
        (disk, "[1e16, 0.25]", "[-1, 0]"),
        (disk, "[1e30, 0.25]", "[-1, 0]"),
        (disk, "[1e120, 0.25]", "[-1, 0]"),
        (&tiny, "[1e150, 0]", "[-1, 0]"),
        (sphere, "[1e16, 0.25, 0.5]", "[-1, 0, 0]"),
        (cuboid, "[1e16, 0.25, 0.5]", "[-1, 0, 0]"),
        (cuboid, "[1e130, 0.25, 0.5]", "[-1, 0, 0]"),
    ] {
        let told = String::from_utf8(folder.run(&scene(walls, position, velocity), &[]).stderr).unwrap();
        assert!(
            told.contains("rounding decides what it hits") && told.contains("help: move the start along"),
            "{told}"
        );
    }
    let told = String::from_utf8(folder.run(&scene(disk, "[1e16, 0.25]", "[-1, 0]"), &[]).stderr).unwrap();
    assert!(
        told.contains("scene.toml:5:12") && told.contains("multiples of 2, and all bounded walls together are 2"),
        "{told}"
    );
    // as it is told, and where there is nothing to be decided
    folder.done(&scene(disk, "[1e3, 0.25]", "[-1, 0]"), &[]);
    let hit = &folder.rows()[0];
    assert!((hit[5] - libm::sqrt(0.9375)).abs() < 1e-12 && (hit[6] - 0.25).abs() < 1e-12, "{hit:?}");
    let below = format!("{disk}[[table.boundary]]\nline = {{ through = [0, -2], direction = [1, 0] }}\n");
    for (walls, position, velocity, stop) in [
        (disk, "[1e16, 0.25]", "[1, 0]", "escaped"),
        (disk, "[1e16, 0.25]", "[-1, 1]", "escaped"),
        (&below, "[1e16, 1000]", "[0, -1]", "finished"),
    ] {
        assert_eq!(folder.done(&scene(walls, position, velocity), &[])["stops"][stop], 1, "{position} {velocity}");
    }
}

#[test]
fn a_start_at_a_wall_is_told_its_number_as_drawn() {
    // the region of centres has eight pieces, the table six
    let folder = Folder::new("as-drawn");
    for (x, message) in [
        ("0.125", "the disk touches piece 5 and does not move into the table"),
        ("0.1", "its centre would be 0.025 beyond the limit set by piece 5"),
    ] {
        let scene = format!(
            "law = \"specular\"\ntable = {{ name = \"pocket\" }}\nparticle = {{ radius = 0.125 }}\n\
             orbit = {{ position = [{x}, 0.5], velocity = [-1, 0] }}\nrun = {{ collisions = 1 }}"
        );
        let text = String::from_utf8(folder.run(&scene, &[]).stderr).unwrap();
        assert!(text.contains(message), "{text}");
    }
}

#[test]
fn sides_of_a_wall_that_differ_by_more_than_rounding_are_refused() {
    let folder = Folder::new("faces");
    let scene = |radius: &str| {
        format!(
            "law = \"specular\"\n[[table.boundary]]\ncircle = {{ center = [0, 0], radius = 2 }}\n\
             [[table.boundary]]\ncircle = {{ center = [0.1, 0.2], radius = 0.77 }}\n\
             [[table.boundary]]\ncurve = {{ polar = \"{radius}\", center = [0.1, 0.2], domain = \"outside\" }}\n\
             [[orbit]]\nposition = [-1.4, 0.1]\nvelocity = [0.9, 0.4]\n[run]\ncollisions = 20\n\
             [output]\ncollisions = \"csv\"\n"
        )
    };
    let told = String::from_utf8(folder.run(&scene("0.77+4e-15"), &[]).stderr).unwrap();
    assert!(told.contains("scene.toml:7:9") && told.contains("pieces 1 and 2 run along each other near ("), "{told}");
    assert!(told.contains("help: cut both sides at the same places and describe them alike"), "{told}");
    // and one is like the other
    folder.done(&scene("0.77"), &[]);
    let times: Vec<f64> = folder.rows().iter().map(|row| row[2]).collect();
    assert!(times.windows(2).all(|t| t[1] - t[0] > 1e-3), "{times:?}");
}

#[test]
fn a_size_too_small_beside_the_largest_length_is_told_to_be_so_in_the_units_of_the_scene() {
    let folder = Folder::new("beside-the-largest");
    let told = |table: &str, position: &str, velocity: &str| {
        let scene = format!(
            "law = \"specular\"\n[table]\n{table}[[orbit]]\nposition = {position}\nvelocity = {velocity}\n[run]\ncollisions = 3\n"
        );
        let output = folder.run(&scene, &[]);
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let ball =
        "dimension = 3\n[[table.boundary]]\nsphere = { center = [0, 0, 0], radius = 1e100, domain = \"inside\" }\n";
    let around = |shape: &str| {
        let table = format!("{ball}[[table.boundary]]\nshape = {{ {shape} }}\n");
        told(&table, "[5e99, 0, 0]", "[0.6, 0.8, 0]")
    };
    let strip = |vector: &str| {
        let line =
            |y: &str, x: i32| format!("[[table.boundary]]\nline = {{ through = [0, {y}], direction = [{x}, 0] }}\n");
        told(&format!("lattice = [[{vector}, 0]]\n{}{}", line("0", 1), line("1e100", -1)), "[0, 5e99]", "[0.6, 0.8]")
    };
    let beside = "must be between 1e-150 and 1e150 times the largest length of the scene";
    for (place, name, (code, text)) in [
        ("scene.toml:7:9", "radius", around("name = \"ball\", radius = 1e-60")),
        ("scene.toml:7:9", "height", around("name = \"cylinder\", radius = 1, height = 1e-60")),
        ("scene.toml:7:9", "height", around("name = \"cone\", radius = 1, height = 1e-60")),
        (
            "scene.toml:7:9",
            "the greatest coordinate of the boundary",
            around("name = \"convex-hull\", points = [[0, 0, 0], [1e-60, 0, 0], [0, 1e-60, 0], [0, 0, 1e-60]]"),
        ),
        ("scene.toml:3:12", "the greatest coordinate of a lattice vector", strip("1e-60")),
    ] {
        assert_eq!(code, Some(2), "{name}: {text}");
        assert!(text.contains(place) && text.contains(&format!("{name} {beside}")), "{name}: {text}");
        assert!(!text.contains("e-160") && !text.contains("e-161"), "{name}: {text}");
    }
    // as large as it is told to be
    let (code, text) = around("name = \"ball\", radius = 1e-50");
    assert_eq!(code, Some(0), "{text}");
}
