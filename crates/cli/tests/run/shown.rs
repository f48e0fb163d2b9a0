//! What pictures show: the numbers of the record, at their places.

use std::fs;

use super::{Folder, SQUARE, same::CHAOS};

/// The numbers in a text.
fn numbers(text: &str) -> Vec<f64> {
    text.split(|c: char| !(c.is_ascii_digit() || "-.".contains(c))).filter_map(|word| word.parse().ok()).collect()
}

/// The places of the dots of a portrait.
fn dots(svg: &str) -> Vec<[f64; 2]> {
    let paths = svg.split("<path d=\"").filter_map(|path| path.split('"').next());
    let dots = paths.filter(|path| path.contains("h0")).flat_map(|path| path.split("h0")).map(numbers);
    dots.filter_map(|place| place.first_chunk().copied()).collect()
}

/// Whether each of these places is one of the others, as nearly as dots are drawn.
fn are_among(places: &[[f64; 2]], others: &[[f64; 2]]) -> bool {
    places.iter().all(|a| others.iter().any(|b| (a[0] - b[0]).abs() < 0.06 && (a[1] - b[1]).abs() < 0.06))
}

#[test]
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "numbers of cells")]
fn counts_are_those_of_the_points_in_the_record() {
    let folder = Folder::new("counts");
    // few points, shown as dots, and many
    for collisions in [100, 30_000] {
        let scene = SQUARE.replace("specular", "no-slip").replace("[0, -1]", "[0.3, -1]");
        let scene = scene.replace("collisions = 3", &format!("collisions = {collisions}"));
        folder.done(&(scene + "pictures = [\"velocity-counts\", \"phase-counts\"]\n"), &[]);
        let cells = [1000 * 1000, 1000 * 769];
        let mut expected = cells.map(|cells| vec![0; cells]);
        for row in folder.rows() {
            let ([x1, x2], [spin, v1, v2]) = ([row[5], row[6]], [row[7], row[8], row[9]]);
            let (s, slides) = match row[3] {
                0.0 => (x1, -v1),
                1.0 => (1.0 + x2, -v2),
                2.0 => (3.0 - x1, v1),
                _ => (4.0 - x2, v2),
            };
            let speed = (spin * spin + v1 * v1 + v2 * v2).sqrt();
            let cell = |x: f64, width: f64, number: f64| (x / width * number) as usize;
            expected[0][cell(slides / speed + 1.06, 2.12, 1000.0) * 1000 + cell(spin / speed + 1.06, 2.12, 1000.0)] +=
                1;
            expected[1][cell(slides / speed + 1.0, 2.0, 769.0) * 1000 + cell(s, 4.0, 1000.0)] += 1;
        }
        for (name, expected) in ["velocity", "phase"].iter().zip(expected) {
            let npy = fs::read(folder.0.join(format!("out/{name}-counts.npy"))).unwrap();
            let data = &npy[10 + usize::from(u16::from_le_bytes([npy[8], npy[9]]))..];
            let counts: Vec<i64> = data.as_chunks().0.iter().map(|bytes| i64::from_le_bytes(*bytes)).collect();
            assert_eq!(counts.iter().sum::<i64>(), 2 * collisions, "{name}");
            assert!(counts == expected, "{name} {collisions}");
        }
    }
}

#[test]
fn portraits_show_each_collision_at_its_arc_length_and_velocity() {
    let folder = Folder::new("places");
    let side = 4.0;
    let scene = SQUARE.replace("\"square\"", "\"square\"\nside = 4").replace("collisions = 3", "collisions = 7")
        + "pictures = [\"velocity-portrait\", \"phase-portrait\"]\n";
    for law in ["\"specular\"", "\"no-slip\"", "{ name = \"restitution\", normal = 0.5, tangential = 0.25 }"] {
        folder.done(&scene.replace("\"specular\"", law), &[]);
        let (mut velocities, mut reduced) = (vec![], vec![]);
        for row in folder.rows() {
            let ([x1, x2], [spin, v1, v2]) = ([row[5], row[6]], [row[7], row[8], row[9]]);
            // counter-clockwise around the square, from the corner at the origin
            let (s, along) = match row[3] {
                0.0 => (x1, v1),
                1.0 => (side + x2, v2),
                2.0 => (3.0 * side - x1, -v1),
                _ => (4.0 * side - x2, -v2),
            };
            let speed = (spin * spin + v1 * v1 + v2 * v2).sqrt();
            // the tangent is the normal turned left: the boundary runs against it
            let (rolls, slides) = (spin / speed, -along / speed);
            // both frames are 192.8 points wide: the disk with its margin 2.12, the other one 2.6
            velocities.push([127.4 + 192.8 / 2.12 * rolls, 99.4 - 192.8 / 2.12 * slides]);
            reduced.push([31.0 + 192.8 * s / (4.0 * side), 3.0 + 192.8 / 2.6 * (1.0 - slides)]);
        }
        for (name, expected) in [("velocity", velocities), ("phase", reduced)] {
            let found = dots(&folder.read(&format!("out/{name}-portrait.svg")));
            assert!(are_among(&found, &expected) && are_among(&expected, &found), "{law}: {found:?} {expected:?}");
        }
    }
    let svg = folder.read("out/phase-portrait.svg");
    // lines part the sides, and numbers stand at their arc lengths
    for x in ["79.2", "127.4", "175.6"] {
        assert!(svg.contains(&format!("<path d=\"M{x} 151.308L{x} 3\"")), "{x}: {svg}");
    }
    for (s, x) in [("0", "31"), ("5", "91.25"), ("10", "151.5"), ("15", "211.75")] {
        let number = format!("<text x=\"{x}\" y=\"159.933\" font-size=\"7.5\" text-anchor=\"middle\">{s}</text>");
        assert!(svg.contains(&number), "{s}: {svg}");
    }
}

/// A scene in which numbers between bars are lengths, speeds or times, by the letters after them.
fn of_size(scene: &str, length: f64, speed: f64) -> String {
    let unit = |letter: &str| match letter {
        "L" => length,
        "V" => speed,
        _ => length / speed,
    };
    let number = |text: &str| {
        let (number, letter) = text.split_at(text.len() - 1);
        format!("{:e}", number.parse::<f64>().unwrap() * unit(letter))
    };
    scene.split('|').enumerate().map(|(i, part)| if i % 2 == 0 { part.into() } else { number(part) }).collect()
}

#[test]
fn an_orbit_is_drawn_alike_at_every_size_and_speed() {
    let folder = Folder::new("alike");
    let room = r#"
table = { boundary = [
  { loop = { from = ["|0L|", "|0L|"], edges = [
    { line_to = ["|3L|", "|0L|"] }, { arc_to = ["|3L|", "|2L|"], center = ["|3L|", "|1L|"], turn = "ccw" }, { line_to = ["|1L|", "|2L|"] },
    { arc_to = ["|0L|", "|1L|"], center = ["|0L|", "|2L|"], turn = "cw" }, { line_to = ["|0L|", "|0L|"] } ] } },
  { circle = { center = ["|2L|", "|1L|"], radius = "|0.25L|", domain = "outside" } },
  { ellipse = { center = ["|3L|", "|1L|"], semi_axes = ["|0.5L|", "|0.25L|"], domain = "outside" } } ] }
orbit = [{ position = ["|0.5L|", "|0.5L|"], velocity = ["|0.75V|", "|0.5V|"], spin = "|0.25V|" }]
"#;
    let torus = r#"
[table]
lattice = [["|1L|", "|0L|"], ["|3.5L|", "|1L|"]]
[[table.boundary]]
circle = { center = ["|0L|", "|0L|"], radius = "|0.25L|", domain = "outside" }
[[orbit]]
position = ["|-8.375L|", "|3.75L|"]
velocity = ["|1V|", "|0.125V|"]
"#;
    let hall = r#"
[table]
dimension = 3
[[table.boundary]]
sphere = { center = ["|0L|", "|0L|", "|0L|"], radius = "|3L|" }
[[table.boundary]]
plane = { through = ["|0L|", "|0L|", "|-1L|"], normal = [0, 1, 2] }
[[table.boundary]]
shape = { name = "cuboid", center = ["|1L|", "|1L|", "|1L|"], size = ["|1L|", "|0.5L|", "|0.75L|"] }
[[orbit]]
position = ["|0L|", "|0L|", "|0L|"]
velocity = ["|1V|", "|0.5V|", "|0.25V|"]
"#;
    for table in [room, torus, hall] {
        let scene = format!(
            "law = \"no-slip\"\nparticle = {{ radius = \"|0.0625L|\", gamma_squared = 0.5 }}\n\
             run = {{ time = \"|40T|\" }}\noutput = {{ pictures = [\"orbit\"] }}\n{table}"
        );
        let drawn = |length: f64, speed: f64| {
            folder.done(&of_size(&scene, length, speed), &[]);
            folder.read("out/orbit.svg")
        };
        let one = drawn(1.0, 1.0);
        for (length, speed) in [(2.0, 1.0), (1.0, 0.125), (libm::ldexp(1.0, -40), libm::ldexp(1.0, 70))] {
            assert!(drawn(length, speed) == one, "{length} {speed} {table}");
        }
    }
}

/// The legs of the orbit of a colour.
fn legs<'a>(svg: &'a str, colour: &str) -> &'a str {
    let orbit = svg.split(&format!("<g fill=\"none\" stroke=\"{colour}\"")).nth(1).unwrap_or_default();
    orbit.split("</g>").next().unwrap_or_default()
}

#[test]
fn orbits_share_the_legs_that_are_drawn() {
    let folder = Folder::new("legs");
    // on a lattice a leg is folded into several
    let torus = CHAOS.replace("name = \"sinai\"", "name = \"sinai-torus\"\nradius = 0.1").replace("20000", "9000");
    for scene in [CHAOS, &torus] {
        for output in ["", "collisions = \"npy\"\n"] {
            folder.done(&format!("{scene}[output]\npictures = [\"orbit\"]\n{output}"), &[]);
            let svg = folder.read("out/orbit.svg");
            assert_eq!(["#144a87", "#c14a24"].map(|colour| legs(&svg, colour).matches('L').count()), [10_000; 2]);
        }
    }
}

#[test]
fn the_flight_up_to_the_end_of_time_is_drawn() {
    let folder = Folder::new("flight");
    let square = SQUARE.replace("collisions = 3", "time = 1") + "pictures = [\"orbit\"]\n";
    let torus = "law = \"no-slip\"\ntable = { name = \"sinai-torus\" , radius = 0.25 }\nrun = { time = 1.5 }\n\
                 orbit = [{ position = [0.125, 0.125], velocity = [1, 0.0625] }]\noutput = { pictures = [\"orbit\"] }\n";
    for (scene, end) in [(&square[..], [0.75, 0.75]), (torus, [0.625, 0.21875])] {
        folder.done(scene, &[]);
        let svg = folder.read("out/orbit.svg");
        let last = numbers(legs(&svg, "#144a87").rsplit('L').next().unwrap());
        // 220.8 points between margins of 3, and a thousandth around
        let place = [end[0], 1.0 - end[1]].map(|x| 3.0 + 220.8 * (x + 1e-3) / 1.002);
        assert!((last[0] - place[0]).abs() < 2e-3 && (last[1] - place[1]).abs() < 2e-3, "{last:?} {place:?}");
    }
}

#[test]
fn walls_are_drawn_along_their_segments_and_arcs_and_all_of_them_is_shown() {
    let folder = Folder::new("walls");
    let scene = r#"
law = "no-slip"
[[table.boundary]]
loop = { from = [0, 0], edges = [
  { line_to = [2, 0] }, { arc_to = [2, 2], center = [2, 1], turn = "ccw" }, { line_to = [1, 2] },
  { arc_to = [0, 1], center = [0, 2], turn = "cw" }, { line_to = [0, 0] } ] }
[[orbit]]
position = [1, 0.5]
velocity = [1, 0]
[run]
collisions = 1
[output]
pictures = ["orbit"]
"#;
    folder.done(scene, &[]);
    let svg = folder.read("out/orbit.svg");
    let walls = svg.split("<path d=\"").find(|path| path.contains("stroke=\"#1a1a1a\"")).unwrap();
    // 220.8 points between margins of 3 for a width of 3, and a thousandth of that around; each arc in two halves, the flag
    // before its end is 1 where it turns clockwise
    let scale = 220.8 / 3.006;
    let place = |[x, y]: [f64; 2]| [3.0 + (x + 0.003) * scale, 3.0 + (2.003 - y) * scale];
    let arc = |to: [f64; 2], flag: f64| [&[scale, scale, 0.0, 0.0, flag][..], &place(to)].concat();
    let (slant, half) = (0.5_f64.sqrt(), [place([0.0, 0.0]), place([2.0, 0.0])].concat());
    let up = [arc([3.0, 1.0], 0.0), arc([2.0, 2.0], 0.0), place([1.0, 2.0]).into()].concat();
    let down = [arc([slant, 2.0 - slant], 1.0), arc([0.0, 1.0], 1.0), place([0.0, 0.0]).into()].concat();
    let (found, expected) = (numbers(walls.split('"').next().unwrap()), [half, up, down].concat());
    assert_eq!(found.len(), expected.len(), "{walls}");
    assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 2e-3), "{found:?} {expected:?}");
}

#[test]
fn where_a_band_is_closed_lines_go_across_it() {
    let folder = Folder::new("band");
    let scene = "law = \"no-slip\"\ntable = { lattice = [[2, 0]], boundary = [{ line = { through = [0, 0], direction = [1, 0] } }, \
                 { line = { through = [0, 1], direction = [-1, 0] } }] }\norbit = [{ position = [1, 0.5], velocity = [0, 1] }]\n\
                 run = { collisions = 1 }\noutput = { pictures = [\"orbit\"] }\n";
    folder.done(scene, &[]);
    let svg = folder.read("out/orbit.svg");
    let guides = svg.split("<path d=\"").find(|path| path.contains("stroke=\"#8a8a8a\"")).unwrap();
    let ends = numbers(guides.split('"').next().unwrap());
    assert_eq!(ends.len(), 8, "{guides}");
    // 220.8 points between margins of 3 for a width of 2, and a thousandth of that around
    let scale = 220.8 / 2.004;
    let [left, right] = [0.0, 2.0].map(|x| 3.0 + (x + 0.002) * scale);
    for (end, x) in ends.chunks_exact(2).zip([left, left, right, right]) {
        assert!((end[0] - x).abs() < 2e-3, "{ends:?}");
    }
    let height = 1.004 * scale;
    assert!(ends.chunks_exact(4).all(|line| ((line[1] - line[3]).abs() - height).abs() < 2e-3), "{ends:?}");
}

#[test]
fn rays_are_drawn_from_their_ends_on() {
    let folder = Folder::new("rays");
    let scene = "law = \"no-slip\"\ntable = { boundary = [{ ray = { from = [0, 0], direction = [1, 0] } }, \
                 { ray = { from = [0, 0], direction = [0, 1], domain = \"right\" } }] }\nrun = { collisions = 1 }\n\
                 orbit = [{ position = [2, 1], velocity = [-1, -1] }]\noutput = { pictures = [\"orbit\"] }\n";
    folder.done(scene, &[]);
    let svg = folder.read("out/orbit.svg");
    let walls = svg.split("<path d=\"").find(|path| path.contains("stroke=\"#1a1a1a\"")).unwrap();
    let ends = numbers(walls.split('"').next().unwrap());
    // from the corner to the right, and up
    let [x, y] = [ends[0], ends[1]];
    assert!(ends[2] > x && ends[3] == y && ends[4..6] == [x, y] && ends[6] == x && ends[7] < y, "{walls}");
    assert_eq!(ends.len(), 8, "{walls}");
}

#[test]
fn the_line_of_an_orbit_has_one_leg_for_each_collision() {
    let folder = Folder::new("one-leg-each");
    let scene = "law = \"specular\"\ntable = { name = \"square\" }\nrun = { collisions = 5 }\n\
                 orbit = [{ position = [0.25, 0.5], velocity = [0.5, 0.3] }]\noutput = { pictures = [\"orbit\"] }\n";
    folder.done(scene, &[]);
    let svg = folder.read("out/orbit.svg");
    let points = legs(&svg, "#144a87").split("d=\"").nth(1).and_then(|path| path.split('"').next()).unwrap();
    assert_eq!(numbers(points).len(), 2 * 6, "{points}");
}

#[test]
fn on_a_lattice_the_lines_of_an_orbit_are_as_long_as_its_way() {
    let folder = Folder::new("way");
    for (start, time) in [([0.125, 0.0], 40.0), ([7.0, -3.125], 0.5), ([0.0, 0.0], 3.0)] {
        let scene = format!(
            "law = \"specular\"\ntable = {{ name = \"sinai-torus\", radius = 0.25 }}\nrun = {{ time = {time} }}\n\
             orbit = [{{ position = {start:?}, velocity = [-0.6, 0.8] }}]\noutput = {{ pictures = [\"orbit\"] }}\n"
        );
        let summary = folder.done(&scene, &[]);
        let svg = folder.read("out/orbit.svg");
        let chains = legs(&svg, "#144a87").split('M').skip(1).map(|chain| numbers(chain.split('"').next().unwrap()));
        let length: f64 = chains
            .flat_map(|chain| {
                let points: Vec<_> = chain.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
                points
                    .windows(2)
                    .map(|ends| libm::hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]))
                    .collect::<Vec<_>>()
            })
            .sum();
        let way = length * 1.002 / 220.8;
        assert!((way - time).abs() < 1e-3 * time, "{start:?} {time}: {way} {summary}");
    }
}

#[test]
fn the_open_dot_lies_where_the_last_known_collision_is() {
    let folder = Folder::new("known");
    let scene = "law = \"specular\"\ntable = { name = \"stadium\" }\nrun = { collisions = 100 }\n\
                 orbit = [{ position = [0.1, 0.2], velocity = [0.6, 0.8] }]\n\
                 output = { pictures = [\"orbit\"], collisions = \"csv\" }\n";
    let known = folder.done(scene, &[])["horizon"]["collisions"].as_u64().unwrap();
    let row = folder.rows().into_iter().find(|row| row[1] == known as f64).unwrap();
    // 220.8 points between margins of 3 for a width of 4, and a thousandth of that around
    let scale = 220.8 / 4.008;
    let place = [3.0 + (row[5] + 2.004) * scale, 3.0 + (1.004 - row[6]) * scale];
    let svg = folder.read("out/orbit.svg");
    let dot = svg.split("<circle ").find(|circle| circle.contains("r=\"1.5\" fill=\"#ffffff\"")).unwrap();
    let found = numbers(dot);
    assert!((found[0] - place[0]).abs() < 2e-3 && (found[1] - place[1]).abs() < 2e-3, "{dot} {place:?}");
}

#[test]
fn a_particle_of_some_radius_is_drawn_at_its_start_and_the_walls_of_its_centre_too() {
    let folder = Folder::new("centres");
    let (disk, ball) = ("name = \"square\"", "dimension = 3, name = \"box\"");
    for (table, third) in [(disk, ""), (ball, ", 0.25")] {
        for (radius, guides) in [("0", 0), ("0.125", 1)] {
            let scene = format!(
                "law = \"specular\"\ntable = {{ {table} }}\nparticle = {{ radius = {radius} }}\nrun = {{ collisions = 2 }}\n\
                 orbit = [{{ position = [0.25, 0.25{third}], velocity = [1, 0.5{third}] }}]\n\
                 output = {{ pictures = [\"orbit\"] }}\n"
            );
            folder.done(&scene, &[]);
            let svg = folder.read("out/orbit.svg");
            assert_eq!(svg.matches("stroke=\"#8a8a8a\"").count(), guides, "{table}");
            let circles =
                svg.split("<circle ").skip(1).filter(|circle| circle.contains("fill=\"none\" stroke=\"#144a87\""));
            assert_eq!(circles.count(), guides, "{table}");
        }
    }
}

#[test]
fn of_a_slab_all_is_shown_up_to_walls_that_are_not_far() {
    let folder = Folder::new("slab");
    let ball = |x: f64| format!("{{ shape = {{ name = \"ball\", center = [{x}, 0, 0.5], radius = 0.25 }} }}");
    let scene = format!(
        "law = \"specular\"\ntable = {{ dimension = 3, boundary = [{}, {}, {{ plane = {{ through = [0, 0, 0], normal = [0, 0, 1] }} }}, \
         {{ plane = {{ through = [0, 0, 1], normal = [0, 0, -1] }} }}] }}\nrun = {{ collisions = 3 }}\n\
         orbit = [{{ position = [0, 0, 0.5], velocity = [0, 0, 1] }}]\noutput = {{ pictures = [\"orbit\"] }}\n",
        ball(-2.5),
        ball(2.5)
    );
    folder.done(&scene, &[]);
    let svg = folder.read("out/orbit.svg");
    let balls: Vec<_> = svg.split("<path d=\"").filter(|path| path.contains("fill=\"#e6e6e6\"")).collect();
    assert_eq!(balls.len(), 2);
    for ball in balls {
        let outline = numbers(ball.split('"').next().unwrap());
        assert!(outline.chunks_exact(2).all(|p| (3.0..223.8).contains(&p[0]) && p[1] > 3.0), "{ball}");
    }
}
