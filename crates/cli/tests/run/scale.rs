//! Scenes of any size.

use std::fs;

use super::Folder;

/// A stadium of radius `length` with speeds near `speed`, both powers of two or decimal powers.
pub(super) fn stadium(length: f64, speed: f64) -> String {
    format!(
        "law = \"no-slip\"\n[table]\nname = \"stadium\"\nhalf_length = {length:e}\nradius = {length:e}\n\
         [[orbit]]\nposition = [{:e}, {:e}]\nvelocity = [{:e}, {:e}]\nspin = {:e}\nangle = {:e}\n\
         [run]\ncollisions = 300\n[output]\ncollisions = \"csv\"\npictures = [\"orbit\", \"phase-portrait\"]\n",
        0.125 * length,
        0.25 * length,
        0.5 * speed,
        0.75 * speed,
        0.25 * speed,
        0.5 * length
    )
}

#[test]
fn scenes_of_any_size_run_and_scale_to_the_last_digit() {
    let folder = Folder::new("scale");
    folder.done(&stadium(1.0, 1.0), &[]);
    let unit = folder.rows();
    for (a, b) in [(480, 480), (-480, 480), (480, -480), (-490, -490)] {
        let (length, speed) = (libm::ldexp(1.0, a), libm::ldexp(1.0, b));
        folder.done(&stadium(length, speed), &[]);
        for (row, one) in folder.rows().iter().zip(&unit) {
            let back: Vec<f64> = (0..10)
                .map(|i| match i {
                    2 => row[i] / length * speed,
                    4..=6 => row[i] / length,
                    7..=9 => row[i] / speed,
                    _ => row[i],
                })
                .collect();
            assert_eq!(&back, one, "lengths 2^{a}, speeds 2^{b}");
        }
    }
    for (length, speed) in [(1e150, 2e-150), (2e-150, 1e150), (2e-150, 2e-150), (1e150, 1e150)] {
        let summary = folder.done(&stadium(length, speed), &[]);
        assert!(summary["energy_drift"].as_f64().unwrap() <= 4e-16, "{length:e} {speed:e}");
        assert_eq!(summary["stops"]["finished"], 1);
    }
}

#[test]
fn a_time_much_longer_than_the_flights_of_the_spin_is_told() {
    let folder = Folder::new("long-time");
    let scene = "law = \"specular\"\n[table]\nname = \"strip\"\nwidth = 1e150\n[[orbit]]\nposition = [0, 1e149]\n\
                 velocity = [1e-50, 1e-140]\nspin = 1e40\n[run]\ncollisions = 1\n[output]\ncollisions = \"csv\"\n";
    folder.done(scene, &[]);
    let rows = folder.rows();
    let [time, x] = [rows[0][2], rows[0][5]];
    assert!((time / 9e289 - 1.0).abs() < 1e-12 && (x / 9e239 - 1.0).abs() < 1e-12, "{time:e} {x:e}");
}

#[test]
fn other_tables_run_at_any_size_too() {
    let folder = Folder::new("sizes");
    let tables = [
        "[[table.boundary]]\ncurve = { polar = \"LENGTH*(1 + 0.1*cos(3*t))\" }",
        "[[table.boundary]]\ncurve = { implicit = \"(x/LENGTH)^2/4 + (y/LENGTH)^2 - 1\", within = [[-3*L, -2*L], [3*L, 2*L]] }",
        "[[table.boundary]]\nshape = { name = \"cuboid\", size = [2*L, 2*L], rounding = 0.25*L, domain = \"inside\" }",
        "[table]\nname = \"wedge\"\nangle = 1",
        "[table]\nname = \"sinai-torus\"\nradius = 0.25*L\nside = 2*L",
        "[table]\nname = \"box\"\ndimension = 3\nsize = [1*L, 2*L, 1*L]",
    ];
    for length in ["1e-140", "1", "1e140"] {
        for table in tables {
            let mut text = String::new();
            // 3*L as TOML has it: a formula
            for (i, part) in table.replace("LENGTH", length).split('*').enumerate() {
                if i > 0 {
                    text.push('*');
                }
                text += part;
            }
            let text = expressions(&text, length);
            let space = table.contains("dimension");
            let third = if space { format!(", \"0.3*{length}\"") } else { String::new() };
            let velocity = if space { "[0.5, 0.25, 0.7]" } else { "[0.5, 0.25]" };
            let scene = format!(
                "law = \"no-slip\"\n{text}\n[[orbit]]\nposition = [\"0.1*{length}\", \"0.3*{length}\"{third}]\n\
                 velocity = {velocity}\n[run]\ncollisions = 50\n[output]\npictures = [\"orbit\"]\n"
            );
            let summary = folder.done(&scene, &[]);
            assert!(summary["energy_drift"].as_f64().unwrap() <= 4e-16, "{scene}");
        }
    }
}

/// Numbers like `3*L` as strings that hold formulas.
fn expressions(text: &str, length: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find("*L") {
        let start = rest[..at].rfind(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).map_or(0, |i| i + 1);
        out.extend([&rest[..start], "\"", &rest[start..at], "*", length, "\""]);
        rest = &rest[at + 2..];
    }
    out + rest
}

#[test]
fn a_polar_formula_says_how_large_a_scene_is() {
    let folder = Folder::new("polar-size");
    for (curve, radius) in [
        ("polar = \"1e100*(2-0.3*cos(3*t))\"", "1e-100"),
        ("polar = \"1e60*(2-0.3*cos(3*t))\", center = [1e-140, 0]", "0"),
        ("polar = \"1e-100*(2-0.3*cos(3*t))\"", "0"),
    ] {
        let scene = format!(
            "law = \"specular\"\n[[table.boundary]]\ncurve = {{ {curve} }}\n[particle]\nradius = {radius}\n\
             [ensemble]\ncount = 4\n[run]\ncollisions = 50\n"
        );
        assert_eq!(folder.done(&scene, &[])["stops"]["finished"], 4, "{curve}");
    }
}

/// Records of collisions in a unit of length, in that unit.
fn in_unit(rows: &[Vec<f64>], unit: f64, lengths: &[usize]) -> Vec<Vec<f64>> {
    let row = |row: &Vec<f64>| {
        row.iter().enumerate().map(|(i, x)| if lengths.contains(&i) { x / unit } else { *x }).collect::<Vec<f64>>()
    };
    rows.iter().map(row).collect()
}

#[test]
fn a_drawing_of_any_size_is_hit_and_scales_to_the_last_digit() {
    let folder = Folder::new("drawn-size");
    let rows = |unit: f64| {
        let ring = |corners: [[f64; 2]; 4]| {
            let at = |[x, y]: [f64; 2]| format!("[{:e}, {:e}]", x * unit, y * unit);
            let [a, b, c, d] = corners.map(at);
            format!("[{a}, {b}, {c}, {d}, {a}]")
        };
        let diamond = |x: f64| ring([[x - 1.0, 0.0], [x, 1.0], [x + 1.0, 0.0], [x, -1.0]]);
        let rings = [ring([[-8.0, -4.0], [8.0, -4.0], [8.0, 4.0], [-8.0, 4.0]]), diamond(2.0), diamond(-2.0)];
        let drawing = format!("{{\"type\": \"Polygon\", \"coordinates\": [{}]}}", rings.join(", "));
        fs::write(folder.0.join("two.geojson"), drawing).unwrap();
        let scene = format!(
            "law = \"specular\"\n[[table.boundary]]\noutline = \"two.geojson\"\n[particle]\nradius = {:e}\ninertia = \"hoop\"\n\
             [[orbit]]\nposition = [{:e}, {:e}]\nvelocity = [1, 0]\n[run]\ncollisions = 20\n[output]\ncollisions = \"csv\"\n",
            0.5 * unit,
            -6.0 * unit,
            0.125 * unit
        );
        folder.done(&scene, &[]);
        in_unit(&folder.rows(), unit, &[2, 4, 5, 6])
    };
    let one = rows(1.0);
    // the diamond on the left comes first, not the one behind it
    assert_eq!(one[0][3], 11.0);
    for exponent in [-480, -370, 370, 480] {
        assert_eq!(rows(libm::ldexp(1.0, exponent)), one, "2^{exponent}");
    }
}

#[test]
fn a_mesh_of_any_size_is_hit_and_scales_to_the_last_digit() {
    let folder = Folder::new("mesh-size");
    let octahedron = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
                      f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
    fs::write(folder.0.join("octahedron.obj"), octahedron).unwrap();
    let rows = |unit: f64| {
        let scene = format!(
            "law = \"no-slip\"\n[table]\ndimension = 3\n[[table.boundary]]\nsphere = {{ center = [0, 0, 0], radius = {:e} }}\n\
             [[table.boundary]]\nmesh = {{ file = \"octahedron.obj\", unit = {unit:e} }}\n[particle]\nradius = {:e}\n\
             inertia = \"uniform-ball\"\n[[orbit]]\nposition = [{:e}, {:e}, {:e}]\nvelocity = [-0.8, -0.2, -0.125]\n\
             [run]\ncollisions = 20\n[output]\ncollisions = \"csv\"\n",
            3.0 * unit,
            0.25 * unit,
            2.0 * unit,
            0.5 * unit,
            0.25 * unit
        );
        folder.done(&scene, &[]);
        in_unit(&folder.rows(), unit, &[2, 4, 5, 6])
    };
    let one = rows(1.0);
    assert!(one.iter().any(|row| row[3] == 1.0), "the mesh is hit");
    for exponent in [-480, -370, 370, 480] {
        assert_eq!(rows(libm::ldexp(1.0, exponent)), one, "2^{exponent}");
    }
}
