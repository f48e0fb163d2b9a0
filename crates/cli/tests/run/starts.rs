//! Starts on walls and in corners.

use std::f64::consts::PI;

use super::Folder;

/// A scene with these walls, a start for each position and velocity, and one collision of each orbit.
fn scene(walls: &str, starts: &[([f64; 2], [f64; 2])], output: &str) -> String {
    let orbit = |(x, v): &([f64; 2], [f64; 2])| format!("[[orbit]]\nposition = {x:?}\nvelocity = {v:?}\nspin = 0.5\n");
    let orbits: String = starts.iter().map(orbit).collect();
    format!("law = \"no-slip\"\n{walls}\n{orbits}[run]\ncollisions = 1\n{output}")
}

const RECORD: &str = "[output]\ncollisions = \"csv\"\n";

fn line(to: &[&str]) -> String {
    to.iter().map(|to| format!("{{ line_to = {to} }}")).collect::<Vec<_>>().join(", ")
}

fn boundary(entries: &[&str]) -> String {
    let entries: Vec<_> = entries.iter().map(|entry| format!("[[table.boundary]]\n{entry}\n")).collect();
    entries.concat()
}

/// A loop of straight edges.
fn polygon(vertices: &[&str]) -> String {
    let to = [&vertices[1..], &vertices[..1]].concat();
    format!("loop = {{ from = {}, edges = [{}] }}", vertices[0], line(&to))
}

/// Checks that paths from a point on walls in these directions (times π) hit what they hit if they start a little later.
fn run_as_if_they_had_started_later(folder: &Folder, walls: &str, from: [f64; 2], angles: &[f64]) {
    let velocities = || angles.iter().map(|angle| [libm::cos(PI * angle), libm::sin(PI * angle)]);
    let starts = |time: f64| -> Vec<_> { velocities().map(|v| ([0, 1].map(|i| from[i] + time * v[i]), v)).collect() };
    let later = 1.0 / 1024.0;
    assert_eq!(folder.done(&scene(walls, &starts(later), RECORD), &[])["stops"]["finished"], angles.len(), "{walls}");
    let beside = folder.rows();
    // side by side, and one by one
    assert_eq!(folder.done(&scene(walls, &starts(0.0), ""), &[])["stops"]["finished"], angles.len(), "{walls}");
    assert_eq!(folder.done(&scene(walls, &starts(0.0), RECORD), &[])["stops"]["finished"], angles.len(), "{walls}");
    for ((row, beside), angle) in folder.rows().iter().zip(&beside).zip(angles) {
        assert_eq!((row[0], row[3]), (beside[0], beside[3]), "{walls} {angle}: {row:?} {beside:?}");
        // time and spin position count from the start
        let off =
            [row[2] - later - beside[2], row[4] - 0.5 * later - beside[4], row[5] - beside[5], row[6] - beside[6]];
        assert!(off.iter().all(|off| off.abs() < row[2].max(1.0) * 1e-12), "{walls} {angle}: {row:?} {beside:?}");
    }
}

/// Directions between two, times π.
fn between([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    (1..40).map(move |k| from + (to - from) * (f64::from(k) + 0.013) / 40.0)
}

#[test]
fn a_path_leaves_a_corner_in_every_direction_into_the_table() {
    let folder = Folder::new("corners");
    let room = polygon(&["[-4, -4]", "[4, -4]", "[4, 4]", "[-4, 4]"]);
    let lens = "loop = { from = [1, 0], edges = [{ arc_to = [-1, 0], center = [0, 1], turn = \"cw\" }, \
                { arc_to = [1, 0], center = [0, -1], turn = \"cw\" }] }";
    let tables = [
        // walls, a corner, and the polar angles between which the table lies there
        (boundary(&[&polygon(&["[0, 0]", "[2, 0]", "[2, 1]", "[1, 1]", "[1, 2]", "[0, 2]"])]), [1.0, 1.0], [0.5, 2.0]),
        (boundary(&[&room, &polygon(&["[1, 0]", "[0, -1]", "[-1, 0]", "[0, 1]"])]), [1.0, 0.0], [-0.75, 0.75]),
        // tapering to a needle
        (boundary(&[&room, &polygon(&["[3, 0]", "[0, -0.25]", "[0, 0]"])]), [3.0, 0.0], [-0.973_535, 1.0]),
        (boundary(&[&room, lens]), [1.0, 0.0], [-0.75, 0.75]),
        // a vertex on an edge of the cell
        (
            "[table]\nlattice = [[1, 0]]\n".to_owned()
                + &boundary(&[
                    &format!("chain = {{ from = [0, 0.25], edges = [{}] }}", line(&["[0.5, 0]", "[1, 0.25]"])),
                    &format!("chain = {{ from = [1, 1], edges = [{}] }}", line(&["[0, 1]"])),
                ]),
            [0.0, 0.25],
            [-0.147_583, 1.147_583],
        ),
        (
            "[table]\nlattice = [[1, 0], [0, 1]]\n".to_owned()
                + &boundary(&[&polygon(&["[0.75, 0.5]", "[0.5, 0.25]", "[0.25, 0.5]", "[0.5, 0.75]"])]),
            [0.75, 0.5],
            [-0.75, 0.75],
        ),
        ("[table]\nname = \"mushroom\"\n".to_owned(), [0.25, 0.0], [0.0, 1.5]),
        ("[table]\nname = \"mushroom\"\n".to_owned(), [-0.25, 0.0], [-0.5, 1.0]),
        // two obstacles that touch at a vertex, and one that stands on a wall
        (
            boundary(&[&room, &polygon(&["[1, 0]", "[0, -1]", "[0, 1]"]), &polygon(&["[1, 0]", "[2, 1]", "[2, -1]"])]),
            [1.0, 0.0],
            [0.25, 0.75],
        ),
        (boundary(&[&room, &polygon(&["[0, -4]", "[-1, -3]", "[1, -3]"])]), [0.0, -4.0], [0.0, 0.25]),
    ];
    for (walls, corner, sector) in tables {
        let [from, to] = sector;
        let flat = [1e-4, 1e-6].into_iter().flat_map(|off| [from + off, to - off]);
        let angles: Vec<f64> = between(sector).chain(flat).collect();
        run_as_if_they_had_started_later(&folder, &walls, corner, &angles);
    }
}

#[test]
fn the_first_hit_from_a_corner_is_as_exact_as_any() {
    let folder = Folder::new("corner-exact");
    let walls = boundary(&[&polygon(&["[0, 0]", "[2, 0]", "[2, 1]", "[1, 1]", "[1, 2]", "[0, 2]"])]);
    folder.done(&scene(&walls, &[([1.0; 2], [1.0, -0.5]), ([1.0; 2], [-0.5, 1.0])], RECORD), &[]);
    let hits: Vec<_> = folder.rows().iter().map(|row| [row[2], row[3], row[4], row[5], row[6]]).collect();
    assert_eq!(hits, [[1.0, 1.0, 0.5, 2.0, 0.5], [1.0, 4.0, 0.5, 0.5, 2.0]]);
}

#[test]
fn a_path_that_all_but_follows_a_wall_leaves_the_corner() {
    let folder = Folder::new("corner-flat");
    let walls = boundary(&[&polygon(&["[0, 0]", "[2, 0]", "[2, 1]", "[1, 1]", "[1, 2]", "[0, 2]"])]);
    // past the end of the wall above the corner or of that beside it, and away from these walls
    let flat =
        |slope: f64| [[1.0, -slope], [-slope, 1.0], [-1.0, slope], [slope, -1.0], [-1.0, -slope], [-slope, -1.0]];
    for slope in [1e-3, 1e-6, 1e-9, 1e-12] {
        let starts = flat(slope).map(|velocity| ([1.0; 2], velocity));
        assert_eq!(folder.done(&scene(&walls, &starts, RECORD), &[])["stops"]["finished"], 6, "{slope}");
        for (row, piece) in folder.rows().iter().zip([1.0, 4.0, 5.0, 0.0, 5.0, 0.0]) {
            assert!(row[3] == piece && (row[2] - 1.0).abs() < 1e-15, "{slope}: {row:?}");
        }
    }
}

#[test]
fn a_start_on_a_wall_with_two_sides_moves_to_either_side_however_it_is_drawn() {
    let folder = Folder::new("two-sides");
    let room = "circle = { center = [0, 0], radius = 2 }";
    let there_and_back = "loop = { from = [-0.5, 0], edges = [{ line_to = [0.5, 0] }, { line_to = [-0.5, 0] }] }";
    let arc = "loop = { from = [0, -1], edges = [{ arc_to = [0, 1], center = [0, 0], turn = \"ccw\" }, \
               { arc_to = [0, -1], center = [0, 0], turn = \"cw\" }] }";
    let circles =
        ["circle = { center = [0, 0], radius = 1 }", "circle = { center = [0, 0], radius = 1, domain = \"outside\" }"];
    let lines = [
        "line = { through = [0, 0], direction = [1, 0] }",
        "line = { through = [0, 0], direction = [-1, 0] }",
        "line = { through = [0, 3], direction = [-1, 0] }",
        "line = { through = [0, -3], direction = [1, 0] }",
    ];
    let curves = [
        room,
        "curve = { x = \"cos(t)\", y = \"sin(t)/2\" }",
        "curve = { x = \"cos(t)\", y = \"sin(t)/2\", domain = \"outside\" }",
    ];
    let shape = "shape = { name = \"segment\", from = [-0.5, 0], to = [0.5, 0] }";
    let [up, left] = [[0.0, 1.0], [-0.5, 0.5]];
    for (walls, at, sides) in [
        (&[room, shape][..], [0.25, 0.0], [up, [1.0, 2.0]]),
        (&[room, there_and_back], [0.25, 0.0], [up, [1.0, 2.0]]),
        (&[room, arc], [1.0, 0.0], [left, [0.5, 1.5]]),
        (&[room, circles[0], circles[1]], [0.0, 1.0], [up, [1.0, 2.0]]),
        (&lines, [0.25, 0.0], [up, [1.0, 2.0]]),
        (&curves, [0.0, 0.5], [up, [1.0, 2.0]]),
        // at a tip, in all directions but one
        (&[room, shape], [0.5, 0.0], [[-1.0, 0.0], [0.0, 1.0]]),
        (&[room, there_and_back], [0.5, 0.0], [[-1.0, 0.0], [0.0, 1.0]]),
        (&[room, arc], [0.0, 1.0], [[-1.0, 0.0], [0.0, 1.0]]),
    ] {
        let angles: Vec<f64> = sides.into_iter().flat_map(between).collect();
        run_as_if_they_had_started_later(&folder, &boundary(walls), at, &angles);
    }
    for walls in [shape, there_and_back] {
        let told = |at: [f64; 2]| folder.run(&scene(&boundary(&[room, walls]), &[(at, [-1.0, 0.0])], ""), &[]).stderr;
        for at in [[0.25, 0.0], [0.5, 0.0]] {
            assert!(String::from_utf8(told(at)).unwrap().contains("does not move into the table"), "{walls} {at:?}");
        }
        folder.done(&scene(&boundary(&[room, walls]), &[([0.5, 0.0], [1.0, 0.0])], ""), &[]);
    }
}

#[test]
fn a_start_straight_ahead_of_a_tip_or_a_cusp_of_an_obstacle_is_in_the_table() {
    let folder = Folder::new("ahead-of-tips");
    let room = "circle = { center = [0, 0], radius = 8 }";
    let star = "loop = { domain = \"outside\", from = [0, 1], edges = [\
                { arc_to = [1, 0], center = [1, 1], turn = \"ccw\" }, { arc_to = [0, -1], center = [1, -1], turn = \"ccw\" }, \
                { arc_to = [-1, 0], center = [-1, -1], turn = \"ccw\" }, { arc_to = [0, 1], center = [-1, 1], turn = \"ccw\" }] }";
    for walls in [
        "shape = { name = \"segment\", from = [0, 0], to = [1, 0] }",
        "loop = { from = [0, 0], edges = [{ line_to = [1, 0] }, { line_to = [0, 0] }] }",
        "loop = { from = [0, 0], edges = [{ x = \"t\", y = \"0\", over = [0, 1] }, { line_to = [0, 0] }] }",
        star,
    ] {
        let told = folder.done(&scene(&boundary(&[room, walls]), &[([1.5, 0.0], [0.3, 0.7])], ""), &[]);
        assert_eq!(told["stops"]["finished"], 1, "{walls}");
    }
    // whereas ahead of a cusp of the table itself there is none
    let inside = "loop = { from = [0, 1], edges = [\
                  { arc_to = [-1, 0], center = [-1, 1], turn = \"cw\" }, { arc_to = [0, -1], center = [-1, -1], turn = \"cw\" }, \
                  { arc_to = [1, 0], center = [1, -1], turn = \"cw\" }, { arc_to = [0, 1], center = [1, 1], turn = \"cw\" }] }";
    let output = folder.run(&scene(&boundary(&[inside]), &[([1.5, 0.0], [0.3, 0.7])], ""), &[]);
    assert!(String::from_utf8(output.stderr).unwrap().contains("the start lies outside the table, 0.5 beyond piece"));
}

#[test]
fn an_orbit_goes_on_from_every_row_of_its_record() {
    let folder = Folder::new("go-on");
    let tilted = polygon(&["[-0.1, -0.3]", "[0.7, 2.1]", "[-3, 1]"]);
    let shifted = polygon(&["[0.9, 0.7]", "[1.7, 3.1]", "[-2, 2]"]);
    let lattice = |second: &str, walls: &str| format!("[table]\nlattice = [[1, 0], {second}]\n{}", boundary(&[walls]));
    let disk = "[particle]\ngamma_squared = 0.5\nradius = 0.1\n";
    for (walls, start) in [
        (boundary(&[&tilted]), [-0.5, 0.9]),
        (boundary(&[&shifted]), [0.5, 1.9]),
        (boundary(&["circle = { center = [0, 1], radius = 1 }"]), [-0.5, 0.9]),
        (boundary(&["ellipse = { center = [0.3, 0.2], semi_axes = [2, 1], angle = 0.3 }"]), [-0.5, 0.3]),
        (boundary(&["curve = { x = \"sin(t)+0.2*sin(2*t)\", y = \"1-cos(t)\" }"]), [0.1, 0.7]),
        (boundary(&["curve = { polar = \"1+0.9*cos(t)\" }"]), [0.5, 0.3]),
        (disk.to_owned() + &boundary(&[&tilted]), [-0.5, 0.9]),
        (disk.to_owned() + &boundary(&["curve = { x = \"sin(t)+0.2*sin(2*t)\", y = \"1-cos(t)\" }"]), [0.1, 0.7]),
        (lattice("[0, 1]", "circle = { center = [0.5, 0.5], radius = 0.45, domain = \"outside\" }"), [0.0, 0.1]),
        (lattice("[-1000, 1]", "circle = { center = [0.5, 0.5], radius = 0.45, domain = \"outside\" }"), [0.0, 0.1]),
    ] {
        let first = scene(&walls, &[(start, [0.6, 0.9])], RECORD);
        folder.done(&first.replace("collisions = 1\n", "collisions = 120\n"), &[]);
        let rows = folder.rows();
        let orbit = |row: &Vec<f64>| {
            format!("[[orbit]]\nposition = {:?}\nvelocity = {:?}\nspin = {:?}\n", &row[5..7], &row[8..10], row[7])
        };
        let orbits: String = rows.iter().map(orbit).collect();
        let again = format!("law = \"no-slip\"\n{walls}\n{orbits}[run]\ncollisions = 1\n{RECORD}");
        assert_eq!(folder.done(&again, &[])["stops"]["finished"], rows.len(), "{walls}");
        let size = rows.iter().flat_map(|row| &row[5..7]).fold(1.0, |m: f64, x| m.max(x.abs()));
        for (pair, again) in rows.windows(2).zip(folder.rows()) {
            let (before, next) = (&pair[0], &pair[1]);
            let flight = (next[2] - before[2]).max(1.0);
            let off = (5..10).map(|i| (next[i] - again[i]).abs()).fold(0.0, f64::max);
            assert!(next[3] == again[3] && off < 1e-11 * size * flight, "{walls}: {next:?} {again:?}");
        }
    }
}

#[test]
fn a_path_along_a_wall_that_bends_away_leaves_it() {
    let folder = Folder::new("tangential");
    let room = "circle = { center = [0, 0], radius = 4 }";
    let walls = |wall: &str| boundary(&[room, wall]);
    for wall in [
        "circle = { center = [0, 0], radius = 1, domain = \"outside\" }",
        "ellipse = { center = [0, 0], semi_axes = [1, 2], domain = \"outside\" }",
    ] {
        let starts = [([1.0, 0.0], [0.0, 1.0]), ([1.0, 0.0], [0.0, -1.0])];
        assert_eq!(folder.done(&scene(&walls(wall), &starts, RECORD), &[])["stops"]["finished"], 2, "{wall}");
        for row in folder.rows() {
            assert!(row[3] == 0.0 && (row[2] - libm::sqrt(15.0)).abs() < 1e-14, "{wall}: {row:?}");
        }
    }
    let told = folder.run(&scene(&boundary(&[room]), &[([4.0, 0.0], [0.0, 1.0])], ""), &[]).stderr;
    assert!(String::from_utf8(told).unwrap().contains("does not move into the table"));
}

#[test]
fn a_path_between_walls_that_touch_leaves_them_along_their_tangent() {
    let folder = Folder::new("touch");
    let walls = boundary(&[
        "circle = { center = [0, 0], radius = 4 }",
        "circle = { center = [1, 0], radius = 1, domain = \"outside\" }",
        "circle = { center = [-1, 0], radius = 1, domain = \"outside\" }",
    ]);
    folder.done(&scene(&walls, &[([0.0; 2], [0.0, 1.0]), ([0.0; 2], [0.0, -1.0])], RECORD), &[]);
    let hits: Vec<_> = folder.rows().iter().map(|row| [row[2], row[3], row[6]]).collect();
    assert_eq!(hits, [[4.0, 0.0, 4.0], [4.0, 0.0, -4.0]]);
    for velocity in [[1e-3, 1.0], [1.0, 0.125], [-1.0, 0.0]] {
        let told = folder.run(&scene(&walls, &[([0.0; 2], velocity)], ""), &[]).stderr;
        assert!(String::from_utf8(told).unwrap().contains("does not move into the table"), "{velocity:?}");
    }
}

#[test]
fn a_start_in_a_corner_within_rounding_of_the_next_wall_is_told_so_and_how_to_start() {
    let folder = Folder::new("corner-tiny");
    let place = |x: f64, y: f64| format!("[{:?}, {:?}]", 1.0 + 4e-14 * x, 1.0 + 4e-14 * y);
    let vertices =
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-1.0, 1.0]].map(|[x, y]| place(x, y));
    let walls = boundary(&[&polygon(&vertices.each_ref().map(String::as_str))]);
    let velocity = [2.0, -1.0];
    let told = String::from_utf8(folder.run(&scene(&walls, &[([1.0; 2], velocity)], ""), &[]).stderr).unwrap();
    assert!(told.contains("the start lies on piece 2, and rounding hides whether it gets away from there"), "{told}");
    assert!(told.contains("help: move the start a little along its velocity"), "{told}");
    folder.done(&scene(&walls, &[([1.0 + 1.6e-14, 1.0 - 0.8e-14], velocity)], ""), &[]);
}
