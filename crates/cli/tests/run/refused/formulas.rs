//! What is refused about formulas, and in which words.

use std::fs;

use assert_cmd::Command;

use crate::Folder;

#[test]
fn a_polar_formula_without_a_radius_somewhere_is_refused_at_once() {
    let folder = Folder::new("no-radius");
    for (formula, column, message) in [
        ("2+0.2*sqrt(sin(t)+0.99)", 26, "near t = 4.5743: sqrt of the negative number"),
        ("2+0.2*asin(sin(t)*1.0000001)", 26, "near t = 1.5706: asin of 1.00000008"),
        ("2+0.5*sqrt(cos(2*t))", 26, "near t = 0.7946: sqrt of the negative number"),
        ("2+0.5*cos(t)^0.5", 32, "near t = 1.5800: the negative number"),
        ("2+0.2*cos(t)^1.5", 32, "to the power 1.5, which is not an integer"),
        ("2+0.2*cos(t)^(1/3)", 32, "near t = 1.5800: the negative number"),
        ("2+0.2*sqrt(cos(t))", 26, "near t = 1.5800: sqrt of the negative number"),
        ("2+sqrt(1-2)*cos(t)", 22, "sqrt of the negative number -1"),
        ("2+3*cos(t)", 19, "r(φ) must be positive and finite at every angle; near φ = 2.3017 it is -0.00"),
        ("2+0.2*sqrt(1-cos(t)^2)", 19, "write kinks with abs"),
        ("2+0.1*atan(tan(t))", 19, "the curve is open: r(φ) jumps from 2.157"),
        ("2+0.1*atan2(sin(t),cos(t))", 19, "at φ = 3.1416"),
        ("1e160*(2+cos(t))", 19, "lengths lie between 1e-150 and 1e150"),
        ("1e-160*(2+cos(t))", 19, "lengths lie between 1e-150 and 1e150"),
    ] {
        let scene = format!(
            "law = \"no-slip\"\n[[table.boundary]]\ncurve = {{ polar = \"{formula}\" }}\n\
             [[orbit]]\nposition = [0.01, 0.02]\nvelocity = [1, 0.35]\n[run]\ncollisions = 3000\n"
        );
        fs::write(folder.0.join("scene.toml"), scene).unwrap();
        let mut command = Command::cargo_bin("billiards").unwrap();
        let minute = std::time::Duration::from_secs(60);
        let output = command.current_dir(&folder.0).args(["run", "scene.toml"]).timeout(minute).output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{formula}: {text}");
        assert!(text.contains(&format!("scene.toml:3:{column}: error: ")), "{formula}: {column} expected in\n{text}");
        assert!(text.contains(message), "{formula}: \"{message}\" expected in\n{text}");
    }
}

#[test]
fn what_a_formula_lacks_is_told_with_the_place_and_the_mend() {
    let folder = Folder::new("formulas");
    for (curve, radius, place, message, mend) in [
        (
            "implicit = \"x^2+y^2-0.3*abs(x+0.1*y)-1\", within = [[-1.6, -1.6], [1.6, 1.6]]",
            0.2,
            "5:10",
            "a disk of radius 0.2: piece 0 has a cusp or a kink near (",
            "a formula of t with abs",
        ),
        ("polar = \"2+0.1*asin(sin(t))\"", 0.0, "3:19", "r(φ) has a kink near φ = 1.5708", "write kinks with abs"),
        ("polar = \"1+0.3*abs(cos(t))^0.9\"", 0.1, "5:10", "piece 0 has a cusp or a kink near (", "take radius = 0"),
        ("polar = \"1+0.1*abs(cos(3*t))^0.5\"", 0.03, "5:10", "piece 0 has a cusp or a kink near (", "take radius = 0"),
        ("polar = \"1-0.2*abs(sin(2*t))^0.5\"", 0.1, "5:10", "piece 0 has a cusp or a kink near (", "take radius = 0:"),
        ("polar = \"1+0.3*abs(cos(t))^1.1\"", 0.02, "5:10", "piece 0 has a cusp or a kink near (", "take radius = 0"),
        ("polar = \"2-0.3*abs(cos(1.5*t+0.2))^1.2\"", 0.1, "5:10", "radius of curvature is smaller", "another radius"),
        (
            "implicit = \"(x-333.3)^2+(y-77.7)^2-1\", within = [[-1000, -1000], [1000, 1000]]",
            0.0,
            "3:22",
            "no curve was found in the box",
            "draw that box closer",
        ),
        ("implicit = \"x^2+y^2-1\", within = [[-2, -2], [0.3, 2]]", 0.0, "3:22", "stay in its box", "`within` larger"),
    ] {
        let scene = format!(
            "law = \"specular\"\n[[table.boundary]]\ncurve = {{ {curve} }}\n[particle]\nradius = {radius:?}\n\
             [[orbit]]\nposition = [0.01, 0.02]\nvelocity = [1, 0.35]\n[run]\ncollisions = 30\n"
        );
        let output = folder.run(&scene, &[]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{curve}: {text}");
        assert!(text.contains(&format!("scene.toml:{place}: error: ")), "{curve}: {place} expected in\n{text}");
        assert!(
            text.contains(message) && text.contains(mend),
            "{curve}: \"{message}\", \"{mend}\" expected in\n{text}"
        );
    }
}

#[test]
fn what_stands_on_part_of_a_curve_by_a_formula_is_refused_with_a_mend_that_works() {
    let folder = Folder::new("stands-on-a-formula");
    let wave = |from: u32, to: u32| format!("{{ x = \"t\", y = \"0.125*sin(pi*t/2)^2\", over = [{from}, {to}] }}");
    let scene = |floor: &[String]| {
        let floor = floor.join(", ");
        let stone = format!("{{ line_to = [1.5, 1.25] }}, {{ line_to = [2, 0] }}, {}", wave(2, 1));
        format!(
            "law = \"specular\"\n[[table.boundary]]\nloop = {{ from = [0, 0], edges = [{floor}, {{ line_to = [4, 3] }}, \
             {{ line_to = [0, 3] }}, {{ line_to = [0, 0] }}] }}\n[[table.boundary]]\n\
             loop = {{ domain = \"outside\", from = [1, 0.125], edges = [{stone}] }}\n\
             [[orbit]]\nposition = [1.5, 2]\nvelocity = [0.1, 1]\n[run]\ncollisions = 10\n"
        )
    };
    let output = folder.run(&scene(&[wave(0, 4)]), &[]);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("let the stretch be an edge of its own in both"), "{told}");
    assert_eq!(folder.done(&scene(&[wave(0, 1), wave(1, 2), wave(2, 4)]), &[])["collisions"], 10);
}
