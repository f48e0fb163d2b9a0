//! Tables and starts of every kind.

use super::{Folder, SQUARE};

#[test]
fn a_time_limit_ends_orbits_at_that_time() {
    let folder = Folder::new("time");
    let summary = folder.done(&SQUARE.replace("collisions = 3", "time = 2.25"), &[]);
    assert_eq!((summary["time"].as_f64(), summary["collisions"].as_u64()), (Some(4.5), Some(4)));
    assert!(folder.rows().iter().all(|row| row[2] <= 2.25));
}

#[test]
fn positions_on_a_lattice_stay_in_the_unit_cell_and_cells_add_up() {
    let folder = Folder::new("lattice");
    let scene = |position: &str| {
        format!(
            "law = \"specular\"\n[table]\nname = \"sinai-torus\"\nradius = 0.25\n[[orbit]]\nposition = {position}\n\
             velocity = [1, 0.125]\n[run]\ncollisions = 20\n[output]\ncollisions = \"csv\"\n"
        )
    };
    folder.done(&scene("[0.125, 0.25]"), &[]);
    let header = folder.read("out/collisions.csv").lines().next().unwrap().to_owned();
    assert_eq!(header, "orbit,n,t,piece,x0,x1,x2,v0,v1,v2,cell1,cell2");
    let home = folder.rows();
    assert!(home.iter().all(|row| (0.0..1.0).contains(&row[5]) && (0.0..1.0).contains(&row[6])));
    // the first flight: position + cell is where the straight line from the start leads
    let lifted = [home[0][5] + home[0][10], home[0][6] + home[0][11]];
    assert!(
        (lifted[0] - (0.125 + home[0][2])).abs() < 1e-14 && (lifted[1] - (0.25 + 0.125 * home[0][2])).abs() < 1e-14
    );
    // the same start three cells on and two down: the same orbit there
    folder.done(&scene("[3.125, -1.75]"), &[]);
    for (there, here) in folder.rows().iter().zip(&home) {
        assert_eq!(there[..10], here[..10]);
        assert_eq!([there[10], there[11]], [here[10] + 3.0, here[11] - 2.0]);
    }
}

#[test]
fn orbits_on_a_lattice_are_the_same_in_every_basis_and_lie_in_its_own_unit_cell() {
    let folder = Folder::new("basis");
    let rows = |second: [f64; 2], center: &str, start: &str, end: &str| {
        folder.done(
            &format!(
                "law = \"no-slip\"\n[table]\nlattice = [[1, 0], {second:?}]\n[[table.boundary]]\n\
                 circle = {{ center = {center}, radius = 0.25, domain = \"outside\" }}\n[[orbit]]\nposition = {start}\n\
                 velocity = [1, 0.125]\n[run]\n{end}\n[output]\ncollisions = \"csv\"\npictures = [\"orbit\"]\n"
            ),
            &[],
        );
        folder.rows()
    };
    let lifted = |row: &[f64], second: [f64; 2]| [row[5] + row[10] + row[11] * second[0], row[6] + row[11] * second[1]];
    for center in ["[0.5, 0.5]", "[0, 0]"] {
        for end in ["collisions = 30", "time = 25"] {
            let start = if center == "[0, 0]" { "[-8.375, 3.75]" } else { "[-7.875, 4.25]" };
            let upright = rows([0.0, 1.0], center, start, end);
            assert!(upright.iter().all(|row| (0.0..1.0).contains(&row[5]) && (0.0..1.0).contains(&row[6])), "{center}");
            for second in [[20.0, 1.0], [-1000.0, 1.0]] {
                let lean = rows(second, center, start, end);
                assert_eq!(lean.len(), upright.len());
                for (a, b) in lean.iter().zip(&upright) {
                    // orbit, number, time, piece, spin position, spin and velocity to the last bit
                    assert_eq!((&a[..5], &a[7..10]), (&b[..5], &b[7..10]), "{center} {second:?}");
                    // in the unit cell that is asked for, of which coordinates are rounded
                    let along = a[5] - a[6] * second[0];
                    let rounding = 4.0 * f64::EPSILON * second[0].abs();
                    assert!((0.0..1.0).contains(&a[6]) && (-rounding..=1.0 + rounding).contains(&along), "{a:?}");
                    let ([x, y], [u, v]) = (lifted(a, second), lifted(b, [0.0, 1.0]));
                    assert!(
                        (x - u).abs() <= rounding * 8.0 && (y - v).abs() <= rounding,
                        "{center} {second:?} {a:?} {b:?}"
                    );
                }
            }
        }
    }
    // the first flight leads along a straight line, from the start as it was given
    let row = &rows([20.0, 1.0], "[0, 0]", "[-8.375, 3.75]", "collisions = 1")[0];
    let [x, y] = lifted(row, [20.0, 1.0]);
    assert!((x + 8.375 - row[2]).abs() < 1e-13 && (y - 3.75 - 0.125 * row[2]).abs() < 1e-13, "{row:?}");
}

#[test]
fn a_line_along_the_only_vector_of_a_lattice_is_as_long_as_that() {
    let scene = |walls: [&str; 2]| {
        format!(
            "law = \"no-slip\"\n[table]\nlattice = [[2, 1]]\n[[table.boundary]]\n{}\n[[table.boundary]]\n{}\n[ensemble]\ncount = 20\n\
             [run]\ncollisions = 50\n[output]\ncollisions = \"csv\"\n",
            walls[0], walls[1]
        )
    };
    let lines =
        ["line = { through = [0, 0], direction = [1, 0.5] }", "line = { through = [0, 2], direction = [-6, -3] }"];
    let chains = [
        "chain = { from = [0, 0], edges = [{ line_to = [2, 1] }] }",
        "chain = { from = [0, 2], edges = [{ line_to = [-2, 1] }] }",
    ];
    let folder = Folder::new("line-on-lattice");
    // an ensemble is uniform on walls of finite length
    folder.done(&scene(lines), &[]);
    let rows = folder.rows();
    assert_eq!(rows.len(), 1000);
    folder.done(&scene(chains), &[]);
    assert!(rows == folder.rows());
}

#[test]
fn a_piece_may_have_a_law_of_its_own() {
    let folder = Folder::new("laws");
    let scene = r#"
law = "no-slip"
[[table.boundary]]
loop = { from = [0, 0], edges = [
  { line_to = [1, 0], law = "specular" },
  { line_to = [1, 1] },
  { line_to = [0, 1] },
  { line_to = [0, 0] },
] }
[[orbit]]
position = [0.25, 0.5]
velocity = [0.25, -1]
spin = 0.5
[run]
collisions = 2
[output]
collisions = "csv"
"#;
    folder.done(scene, &[]);
    let rows = folder.rows();
    assert_eq!((rows[0][3], &rows[0][7..]), (0.0, &[0.5, 0.25, 1.0][..]), "smooth floor");
    assert_eq!(rows[1][3], 2.0);
    assert!(rows[1][7] != 0.5, "rough ceiling");
    // the law of the command line takes the place of the scene's, not of the piece's
    folder.done(&scene.replace("law = \"specular\"", "law = \"no-slip\""), &["--law", "specular"]);
    let rows = folder.rows();
    assert!(rows[0][7] != 0.5);
    assert_eq!(rows[1][7], rows[0][7]);
}

#[test]
fn the_law_of_an_entry_is_that_of_all_its_pieces() {
    let folder = Folder::new("entry-laws");
    let svg = "<svg xmlns='http://www.w3.org/2000/svg'><path d='M-1 -1H1V1H-1Z'/></svg>";
    std::fs::write(folder.0.join("room.svg"), svg).unwrap();
    for entry in [
        "outline = \"room.svg\"",
        "shape = { name = \"cuboid\", size = [2, 2], domain = \"inside\" }",
        "curve = { polar = \"1 + 0.1*abs(cos(t))\" }",
        "loop = { from = [-1, -1], edges = [{ line_to = [1, -1] }, { line_to = [0, 1] }, { line_to = [-1, -1] }] }",
    ] {
        let spins = |own: &str| {
            folder.done(
                &format!(
                    "law = \"no-slip\"\ntable = {{ boundary = [{{ {entry}{own} }}] }}\nrun = {{ collisions = 3 }}\n\
                     orbit = [{{ position = [0, 0], velocity = [1, 0.25], spin = 0.5 }}]\noutput = {{ collisions = \"csv\" }}\n"
                ),
                &[],
            );
            folder.rows().iter().map(|row| (row[7] - 0.5).abs() < 1e-9).collect::<Vec<_>>()
        };
        assert_eq!(spins(", law = \"specular\""), [true; 3], "{entry}");
        assert!(!spins("")[0], "{entry}");
    }
}

#[test]
fn a_loop_closes_where_its_last_edge_ends_within_rounding() {
    let folder = Folder::new("closes");
    let scene = |end: &str| {
        format!(
            "law = \"specular\"\ntable = {{ boundary = [{{ loop = {{ from = [0.1, 0.3], edges = [{{ line_to = [2, 0] }}, \
             {{ line_to = [1, 2] }}, {{ line_to = [0.1, {end}] }}] }} }}] }}\nrun = {{ collisions = 30 }}\n\
             orbit = [{{ position = [1, 1], velocity = [1, 0.25] }}]\n"
        )
    };
    assert_eq!(folder.done(&scene("0.30000000000000004"), &[])["stops"]["finished"], 1);
    let told = String::from_utf8(folder.run(&scene("0.3000000000001"), &[]).stderr).unwrap();
    assert!(told.contains("the loop is open"), "{told}");
}

#[test]
fn a_turned_height_field_goes_on_in_rays_that_start_where_it_ends_within_rounding() {
    let folder = Folder::new("height-field");
    let scene = "law = \"specular\"\n[[table.boundary]]\n\
         shape = { name = \"heightfield\", heights = [0.25, 1, 0, 0.5], size = [3, 1], angle = \"pi/6\" }\n\
         [[table.boundary]]\nray = { from = [\"1.5*cos(pi/6)-0.5*sin(pi/6)\", \"1.5*sin(pi/6)+0.5*cos(pi/6)\"], \
         direction = [\"cos(pi/6)\", \"sin(pi/6)\"] }\n[[table.boundary]]\n\
         ray = { from = [\"-1.5*cos(pi/6)-0.25*sin(pi/6)\", \"-1.5*sin(pi/6)+0.25*cos(pi/6)\"], \
         direction = [\"-cos(pi/6)\", \"-sin(pi/6)\"], domain = \"right\" }\n\
         [[orbit]]\nposition = [-1, \"sqrt(3)\"]\nvelocity = [0.5, \"-sqrt(3)/2\"]\n[run]\ncollisions = 3\n";
    assert!(folder.done(scene, &[])["collisions"].as_u64() >= Some(1));
}

#[test]
fn a_disk_rolls_along_a_straight_formula_from_cell_to_cell() {
    let folder = Folder::new("straight-formula");
    let rows = |edge: &str| {
        folder.done(
            &format!(
                "law = \"no-slip\"\n[table]\nlattice = [[1, 0]]\n[[table.boundary]]\n\
                 chain = {{ from = [0, 0], edges = [{edge}] }}\n[[table.boundary]]\n\
                 chain = {{ from = [1, 1], edges = [{{ line_to = [0, 1] }}] }}\n[particle]\nradius = 0.05\n\
                 gamma_squared = 0.5\n[[orbit]]\nposition = [0.3, 0.5]\nvelocity = [1, 0.3]\n[run]\ncollisions = 15\n\
                 [output]\ncollisions = \"csv\"\n"
            ),
            &[],
        );
        folder.rows()
    };
    let [drawn, formula] = ["{ line_to = [1, 0] }", "{ x = \"t\", y = \"0\", over = [0, 1] }"].map(rows);
    assert_eq!(drawn.len(), formula.len());
    let numbers = drawn.iter().flatten().zip(formula.iter().flatten());
    assert!(numbers.clone().count() > 100 && numbers.clone().all(|(a, b)| (a - b).abs() < 1e-11));
}

#[test]
fn a_shape_is_turned_by_its_angle() {
    let folder = Folder::new("turned");
    folder.done(
        "law = \"specular\"\ntable = { boundary = [{ shape = { name = \"cuboid\", size = [2, 0.5], angle = \"pi/2\" } }] }\n\
         orbit = [{ position = [3, 0.75], velocity = [-1, 0] }]\nrun = { collisions = 1 }\noutput = { collisions = \"csv\" }\n",
        &[],
    );
    let [row] = &folder.rows()[..] else { panic!("one collision") };
    assert!((row[5] - 0.25).abs() < 1e-15, "{row:?}");
}

#[test]
fn orbits_of_an_ensemble_have_the_speed_that_is_asked_for_or_one() {
    let folder = Folder::new("speed");
    for (asked, speed) in [("", 1.0), (", speed = 2.5", 2.5)] {
        folder.done(
            &format!(
                "law = \"no-slip\"\ntable = {{ name = \"circle\" }}\nensemble = {{ count = 5{asked} }}\n\
                 run = {{ collisions = 2 }}\noutput = {{ collisions = \"csv\" }}\n"
            ),
            &[],
        );
        for row in folder.rows() {
            let found = row[7..10].iter().map(|v| v * v).sum::<f64>().sqrt();
            assert!((found / speed - 1.0).abs() < 1e-15, "{asked}: {row:?}");
        }
    }
}

#[test]
fn a_rough_direction_along_the_normal_of_a_straight_wall_of_any_kind_is_smooth() {
    let folder = Folder::new("normal");
    let keeps_spin = |walls: &str, direction: [f64; 2]| {
        let scene = format!(
            "rough = [{direction:?}]\ntable = {{ boundary = [{{ {walls} }}] }}\nrun = {{ collisions = 1 }}\n\
             orbit = [{{ position = [2, 1], velocity = [0.25, -1], spin = 0.5 }}]\noutput = {{ collisions = \"csv\" }}\n"
        );
        folder.done(&scene, &[]);
        (folder.rows()[0][7] - 0.5).abs() < 1e-12
    };
    for walls in [
        "line = { through = [0, 0], direction = [1, 0] }",
        "ray = { from = [0, 0], direction = [1, 0] } }, { ray = { from = [0, 0], direction = [0, 1], domain = \"right\" }",
        "loop = { from = [0, 0], edges = [{ line_to = [4, 0] }, { line_to = [4, 4] }, { line_to = [0, 0] }] }",
        "loop = { from = [0, 0], edges = [{ x = \"t\", y = \"0*t\", over = [0, 4] }, { line_to = [4, 4] }, { line_to = [0, 0] }] }",
        "shape = { name = \"segment\", from = [0, 0], to = [4, 0] }",
        "loop = { from = [0, 0], edges = [{ line_to = [4, 0] }, { line_to = [0, 0] }] }",
        "shape = { name = \"polyline\", points = [[-1, 5], [0, 0], [4, 0]] }",
    ] {
        assert!(keeps_spin(walls, [0.0, -3.0]), "{walls}");
        assert!(!keeps_spin(walls, [0.001, -3.0]), "{walls}");
    }
    // within rounding
    for k in 1..20 {
        let across = 0.1 * f64::from(k);
        let askew = format!("line = {{ through = [2, 0], direction = [7, {k}] }}");
        assert!(keeps_spin(&askew, [-across, 0.7]), "{k}");
        assert!(!keeps_spin(&askew, [-across, 0.700_000_001]), "{k}");
    }
    // and far from the origin
    let scene = |[x, y]: [f64; 2]| {
        let at = |dx: f64, dy: f64| format!("[{}, {}]", x + dx, y + dy);
        format!(
            "rough = [[0.6, 0.8]]\n[[table.boundary]]\nloop = {{ from = {}, edges = [{{ line_to = {} }}, {{ line_to = {} }}, \
             {{ line_to = {} }}, {{ line_to = {} }}] }}\n[[orbit]]\nposition = {}\nvelocity = [-0.6, -0.79]\n[run]\n\
             collisions = 1\n[output]\ncollisions = \"csv\"\n",
            at(0.1, 0.3),
            at(0.18, 0.24),
            at(0.3, 0.4),
            at(0.22, 0.46),
            at(0.1, 0.3),
            at(0.2, 0.35)
        )
    };
    for place in [[0.0, 0.0], [100.0, 50.0], [-3.0, 70.0]] {
        folder.done(&scene(place), &[]);
        assert_eq!(folder.rows()[0][7], 0.0, "{place:?}");
    }
}

#[test]
fn a_disk_of_positive_radius_moves_within_the_walls_that_are_drawn() {
    let folder = Folder::new("disk");
    let scene = SQUARE.replace("[table]", "[particle]\nradius = 0.125\n[table]");
    folder.done(&scene, &[]);
    let rows = folder.rows();
    assert_eq!((rows[0][3], rows[0][5]), (1.0, 0.875), "the centre is a radius away from the wall it touches");
    assert_eq!(&rows[3][..7], &[1.0, 1.0, 0.375, 0.0, 0.0, 0.5, 0.125]);
}

#[test]
fn orbits_that_all_escape_are_no_failure() {
    let folder = Folder::new("escape");
    let scene = "law = \"no-slip\"\ntable = { boundary = [{ circle = { center = [0, 0], radius = 1, domain = \"outside\" } }] }\n\
                 orbit = [{ position = [2, 0], velocity = [1, 0] }, { position = [3, 0], velocity = [-1, 0] }]\n\
                 run = { collisions = 10 }\noutput = { pictures = [\"orbit\"] }";
    let summary = folder.done(scene, &[]);
    assert_eq!((summary["stops"]["escaped"].as_u64(), summary["collisions"].as_u64()), (Some(2), Some(1)));
}

#[test]
fn a_start_on_a_wall_is_accepted_if_it_moves_inwards() {
    let folder = Folder::new("wall");
    let start = |position: &str, velocity: &str| {
        SQUARE
            .replace("[0.25, 0.5]", position)
            .replace("[0.5, 0.25]", velocity)
            .replace("name = \"square\"", "name = \"mushroom\"")
            .replace("[0.5, 0.5]", "[0, 0.5]")
    };
    let refused = |position: &str, velocity: &str| {
        let output = folder.run(&start(position, velocity), &[]);
        assert_eq!(output.status.code(), Some(2), "{position} {velocity}");
        String::from_utf8(output.stderr).unwrap()
    };
    folder.done(&start("[0.5, 0]", "[0.5, 0.25]"), &[]);
    assert!(refused("[0.5, 0]", "[0.5, -0.25]").contains("does not move into the table"));
    assert!(refused("[0.5, 0]", "[0.5, 0]").contains("does not move into the table"));
    // at a corner that points out of the table, into it for both walls; at a re-entrant one, for either
    folder.done(&start("[1, 0]", "[-0.5, 0.25]"), &[]);
    assert!(refused("[1, 0]", "[0.5, 0.25]").contains("does not move into the table"));
    folder.done(&start("[0.25, 0]", "[0.5, 0.25]"), &[]);
    // whichever of the two walls the path passes
    for (position, velocity, side) in [("[0.25, 0]", "[-0.5, -0.125]", -1.0), ("[-0.25, 0]", "[0.5, -0.125]", 1.0)] {
        assert_eq!(folder.done(&start(position, velocity), &[])["stops"]["finished"], 2, "{position}");
        let hit = &folder.rows()[0];
        assert_eq!([hit[2], hit[5], hit[6]], [1.0, 0.25 * side, -0.125], "{position}");
    }
    assert!(refused("[0.25, 0]", "[0.5, -0.25]").contains("does not move into the table"));
    // the wall is named through which it would leave
    let corner = |velocity: &str| {
        let scene = SQUARE.replace("[0.25, 0.5]", "[0, 0]").replace("[0.5, 0.25]", velocity);
        String::from_utf8(folder.run(&scene, &[]).stderr).unwrap()
    };
    assert!(corner("[-0.88, 0.48]").contains("lies on piece 3 and"), "{}", corner("[-0.88, 0.48]"));
    assert!(corner("[0.88, -0.48]").contains("lies on piece 0 and"), "{}", corner("[0.88, -0.48]"));
    // within rounding of a wall is on it, whichever side
    folder.done(&start("[0.5, 1e-17]", "[0.5, 0.25]"), &[]);
    folder.done(&start("[0.5, -1e-17]", "[0.5, 0.25]"), &[]);
    assert!(refused("[0.5, -1e-9]", "[0.5, 0.25]").contains("outside the table"));
}

#[test]
fn a_start_on_a_wall_without_thickness_moves_to_either_side_of_it() {
    let folder = Folder::new("either-side");
    let scene = "law = \"specular\"\n[[table.boundary]]\ncircle = { center = [0, 0], radius = 2 }\n[[table.boundary]]\n\
                 shape = { name = \"polyline\", points = [[-0.5, 0], [0, 0], [0.5, 0.25]] }\n[[orbit]]\nposition = POSITION\n\
                 velocity = VELOCITY\n[run]\ncollisions = 1\n[output]\ncollisions = \"csv\"\n";
    for position in ["[-0.25, 0]", "[0, 0]"] {
        for (velocity, side) in [("[0.25, 1]", 1.0), ("[0.25, -1]", -1.0)] {
            folder.done(&scene.replace("POSITION", position).replace("VELOCITY", velocity), &[]);
            let row = folder.rows().swap_remove(0);
            assert!(row[3] == 0.0 && row[6] * side > 1.0, "{position} {velocity}: {row:?}");
        }
        let along = folder.run(&scene.replace("POSITION", "[-0.25, 0]").replace("VELOCITY", "[1, 0]"), &[]);
        assert_eq!(along.status.code(), Some(2));
    }
}

#[test]
fn ensembles_start_on_both_faces_of_a_wall_without_thickness() {
    let folder = Folder::new("faces");
    for (shape, ends) in [
        ("name = \"segment\", from = [-0.5, 0], to = [0.5, 0]", [[-0.5, 0.0], [0.5, 0.0]]),
        ("name = \"polyline\", points = [[0.02, 0.9], [-0.1, 0.16]]", [[0.02, 0.9], [-0.1, 0.16]]),
    ] {
        let scene = format!(
            "law = \"specular\"\n[[table.boundary]]\ncircle = {{ center = [0, 0], radius = 2 }}\n[[table.boundary]]\n\
             shape = {{ {shape} }}\n[ensemble]\ncount = 10000\nseed = 9\n[run]\ncollisions = 1\n\
             [output]\ncollisions = \"csv\"\n"
        );
        folder.done(&scene, &[]);
        let [a, b] = ends;
        let along = [b[0] - a[0], b[1] - a[1]];
        let mut faces = [0.0; 2];
        // what starts on the wall comes to the circle next, and from there one goes back
        for row in folder.rows().iter().filter(|row| row[3] == 0.0) {
            let ([t, x, y], [v, w]) = ([row[2], row[5], row[6]], [row[8], row[9]]);
            let off = 2.0 * (v * x + w * y) / (x * x + y * y);
            let [v, w] = [v - off * x, w - off * y];
            let from = [x - t * v - a[0], y - t * w - a[1]];
            let beside = along[0] * from[1] - along[1] * from[0];
            let on = along[0] * from[0] + along[1] * from[1];
            if beside.abs() < 1e-12 && on > 0.0 && on < along[0] * along[0] + along[1] * along[1] {
                faces[usize::from(along[0] * w - along[1] * v < 0.0)] += 1.0;
            }
        }
        let length = libm::hypot(along[0], along[1]);
        let each = 10_000.0 * length / (2.0 * length + 4.0 * std::f64::consts::PI);
        assert!(faces.iter().all(|face: &f64| (face - each).abs() < 4.0 * each.sqrt()), "{faces:?}, {each} each");
    }
}

#[test]
fn every_shape_bounds_a_table_from_outside() {
    let folder = Folder::new("shapes");
    let planar = [
        ("ball", "radius = 1"),
        ("cuboid", "size = [2, 1], angle = 0.3"),
        ("cuboid", "size = [2, 1], rounding = 0.25"),
        ("capsule", "from = [-1, 0], to = [1, 0.5], radius = 0.5"),
        ("segment", "from = [-1, 0], to = [1, 0.5]"),
        ("triangle", "points = [[-1, 0], [1, 0], [0, 1]]"),
        ("triangle", "points = [[-1, 0], [1, 0], [0, 1]], rounding = 0.25"),
        ("convex-polygon", "points = [[-1, 0], [0, -1], [1, 0], [0, 1]]"),
        ("convex-polygon", "points = [[-1, 0], [0, -1], [1, 0], [0, 1]], rounding = 0.25"),
        ("polygon", "points = [[-1, 0], [1, 0], [0, 0.25], [0, 1]]"),
        ("polygon", "points = [[-1, 0], [1, 0], [0, 0.25], [0, 1]], rounding = 0.125"),
        ("polyline", "points = [[-1, 0], [0, 0.25], [1, 0]]"),
        ("polyline", "points = [[-1, 0], [0, 0.25], [1, 0]], rounding = 0.125"),
        ("trimesh", "points = [[-1, 0], [1, 0], [0, 1], [0, -1]], triangles = [[0, 1, 2], [0, 3, 1]]"),
        (
            "compound",
            "shapes = [{ name = \"ball\", radius = 1 }, { name = \"cuboid\", size = [3, 0.5], center = [0, 0.5] }]",
        ),
    ];
    let solid = [
        ("ball", "radius = 1"),
        ("cuboid", "size = [2, 1, 1]"),
        ("cuboid", "size = [2, 1, 1], rounding = 0.25"),
        ("capsule", "from = [-1, 0, 0], to = [1, 0, 0], radius = 0.5"),
        ("cylinder", "radius = 1, height = 1"),
        ("cylinder", "radius = 1, height = 1, rounding = 0.125"),
        ("cone", "radius = 1, height = 1"),
        ("convex-hull", "points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
        ("half-space", "normal = [0, 0, -1], center = [0, 0, 2]"),
        (
            "trimesh",
            "points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], \
             triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]",
        ),
    ];
    let scene = |n: usize, name: &str, parameters: &str| {
        let (dimension, around, position, velocity) = if n == 2 {
            ("", "circle = { center = [0, 0], radius = 4 }", "[-2.5, -1.5]", "[0.8, 0.61]")
        } else {
            ("dimension = 3", "sphere = { center = [0, 0, 0], radius = 4 }", "[-2, -1, -1]", "[0.8, 0.41, 0.43]")
        };
        format!(
            "law = \"no-slip\"\n[table]\n{dimension}\n[[table.boundary]]\n{around}\n[[table.boundary]]\n\
             shape = {{ name = \"{name}\", {parameters} }}\n[[orbit]]\nposition = {position}\nvelocity = {velocity}\n\
             [run]\ncollisions = 200\n[output]\ncollisions = \"csv\"\npictures = [\"orbit\"]\n"
        )
    };
    for (n, shapes) in [(2, &planar[..]), (3, &solid[..])] {
        for (name, parameters) in shapes {
            let summary = folder.done(&scene(n, name, parameters), &[]);
            assert_eq!(summary["stops"]["finished"], 1, "{name} {parameters}: {}", summary["stops"]);
            assert!(summary["energy_drift"].as_f64().unwrap() <= 4e-16, "{name} {parameters}");
            let pieces: Vec<f64> = folder.rows().iter().map(|row| row[3]).collect();
            assert!(pieces.contains(&0.0) && pieces.iter().any(|piece| *piece > 0.0), "{name} {parameters}: never hit");
        }
    }
    // and as the only thing in the open plane, for points and for disks
    let around = "[[table.boundary]]\ncircle = { center = [0, 0], radius = 4 }\n";
    for (name, parameters) in planar {
        let alone = scene(2, name, parameters).replace(around, "");
        for scene in [alone.clone(), format!("particle = {{ radius = 0.1, inertia = \"hoop\" }}\n{alone}")] {
            let summary = folder.done(&scene, &[]);
            assert_eq!(summary["stops"]["escaped"], 1, "{name} {parameters}: {}", summary["stops"]);
            assert!(summary["collisions"].as_u64().unwrap() > 0, "{name} {parameters}: never hit");
        }
    }
}

#[test]
fn a_loop_that_says_so_is_an_obstacle_in_the_open_plane() {
    let folder = Folder::new("obstacle");
    let walled = |wall: &str, domain: &str, turned: bool| {
        let (first, last) = if turned { ("[0, 1]", "[1, 0]") } else { ("[1, 0]", "[0, 1]") };
        format!(
            "law = \"specular\"\n[[table.boundary]]\nloop = {{ from = [0, 0], {domain} edges = [{{ line_to = {first} }}, \
             {{ line_to = [1, 1] }}, {{ line_to = {last} }}, {{ line_to = [0, 0] }}] }}\n[[table.boundary]]\n\
             shape = {{ name = \"cuboid\", size = [1, 3], center = [3, 0.5] }}\n{wall}[[orbit]]\nposition = [2, 0.125]\n\
             velocity = [1, 0.25]\n[run]\ncollisions = 9\n[output]\ncollisions = \"csv\"\n"
        )
    };
    let thin = |end: &str| {
        let edges = format!("[{{ line_to = {end} }}, {{ line_to = [-4, -5] }}]");
        format!("[[table.boundary]]\nloop = {{ from = [-4, -5], edges = {edges} }}\n")
    };
    // whatever walls without thickness stand beside it: one that is smaller, one that is larger
    let walls = [String::new(), thin("[-3.5, -5]"), thin("[9, -5.5]")];
    for wall in &walls {
        let summary = folder.done(&walled(wall, "domain = \"outside\",", true), &[]);
        assert_eq!((summary["collisions"].as_u64(), summary["stops"]["escaped"].as_u64()), (Some(3), Some(1)));
        let hits: Vec<_> = folder.rows().iter().map(|row| (row[3], row[5])).collect();
        assert_eq!(hits, [(4.0, 2.5), (2.0, 1.0), (4.0, 2.5)], "{wall}");
        let told = String::from_utf8(folder.run(&walled(wall, "", true), &[]).stderr).unwrap();
        assert!(told.contains("domain = \"outside\""), "{wall}: {told}");
    }
    let scene = |domain: &str, turned: bool| walled("", domain, turned);
    for (domain, turned, message) in [
        ("domain = \"outside\",", false, "runs counter-clockwise, so that the domain is inside, and not outside"),
        ("domain = \"inside\",", true, "runs clockwise, so that the domain is outside, and not inside"),
    ] {
        let told = String::from_utf8(folder.run(&scene(domain, turned), &[]).stderr).unwrap();
        assert!(told.contains(message), "{domain}: {told}");
    }
}

#[test]
fn a_formula_with_many_kinks_is_cut_in_finite_time() {
    let folder = Folder::new("kinks");
    // between two kinks at t = 5.15 and 5.23 lies a point where stretches became as short as the rounding of t, and no shorter
    let scene = "law = \"no-slip\"\n[[table.boundary]]\ncurve = { polar = \"1+0.039243201245573456*abs(cos(8*t+1.22))\
                 +0.04406985515643899*abs(cos(6*t+1.61))+-0.11003802286883316*cos(7*t+2.34)\" }\n\
                 [ensemble]\ncount = 100\n[run]\ncollisions = 5\n";
    std::fs::write(folder.0.join("scene.toml"), scene).unwrap();
    let mut command = assert_cmd::Command::cargo_bin("billiards").unwrap();
    let minute = std::time::Duration::from_secs(60);
    command.current_dir(&folder.0).args(["run", "scene.toml"]).timeout(minute).assert().success();
}

#[test]
fn a_disk_rolls_around_the_corner_where_a_turn_of_a_formula_ends() {
    let folder = Folder::new("seam");
    for formula in ["1 + 0.2*t*(2*pi-t)", "1 + 0.2*abs(t)*abs(2*pi-t)"] {
        let scene = format!(
            "law = \"no-slip\"\n[[table.boundary]]\ncurve = {{ polar = \"{formula}\" }}\n[particle]\nradius = 0.2\n\
             inertia = \"hoop\"\n[[orbit]]\nposition = [0.2, 0.02]\nvelocity = [1, 0]\n[run]\ncollisions = 1\n\
             [output]\ncollisions = \"csv\"\n"
        );
        folder.done(&scene, &[]);
        // the corner is at (1, 0), and points into the table
        let row = &folder.rows()[0];
        let (x, y) = (row[5], row[6]);
        assert!((libm::hypot(x - 1.0, y) - 0.2).abs() < 1e-14 && (y - 0.02).abs() < 1e-15, "{formula}: {x} {y}");
    }
}

#[test]
fn a_kink_of_a_formula_that_touches_zero_elsewhere_is_a_corner_and_a_disk_rolls_around_it() {
    let folder = Folder::new("touching");
    // cos t + cos 2t changes its sign at ±π/3, and touches 0 at π
    let scene = |orbit: &str| {
        format!(
            "law = \"specular\"\n[[table.boundary]]\ncurve = {{ polar = \"1+0.15*abs(cos(t)+cos(2*t))\" }}\n{orbit}\n\
             [run]\ncollisions = 100\n[output]\ncollisions = \"csv\"\n"
        )
    };
    let into = "[[orbit]]\nposition = [0, 0]\nvelocity = [\"cos(pi/3)\", \"sin(pi/3)\"]";
    assert_eq!(folder.done(&scene(into), &[])["stops"]["corner"], 1);
    let disk = "[[orbit]]\nposition = [0.1, 0.2]\nvelocity = [0.6, 0.8]\n[particle]\nradius = 0.1";
    assert_eq!(folder.done(&scene(disk), &[])["stops"]["finished"], 1);
}

#[test]
fn a_disk_sees_the_bends_between_the_places_where_curvature_is_looked_at() {
    let folder = Folder::new("bends");
    let scene = "law = \"no-slip\"\n[[table.boundary]]\ncurve = { polar = \"1+-0.05418429947613218*abs(sin(1*t+0.82))+0.0689474497866048*cos(7*t+2.73)^3+0.05461552238\
                 660353*abs(cos(4*t+1.69))^1.5\" }\n\
                 [particle]\nradius = 0.13932201329324959\ninertia = \"hoop\"\n\
                 [ensemble]\ncount = 20000\n[run]\ncollisions = 5\n";
    let summary = folder.done(scene, &[]);
    assert_eq!(summary["stops"]["finished"], 20_000);
    // 4 area/perimeter; five standard errors are 1 %
    let mean = summary["time"].as_f64().unwrap() / summary["collisions"].as_f64().unwrap();
    assert!((mean / 1.54644 - 1.0).abs() < 0.01, "{mean}");
}
