//! What is refused about drawings, maps and meshes, and in which words.

use std::fs;

use crate::Folder;

#[test]
fn a_file_without_walls_is_told_to_have_none() {
    let folder = Folder::new("no-walls");
    fs::write(folder.0.join("points.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\n").unwrap();
    fs::write(folder.0.join("nothing.json"), "{ \"type\": \"FeatureCollection\", \"features\": [] }").unwrap();
    for (table, start, file) in [
        ("dimension = 3, boundary = [{ mesh = { file = \"points.obj\" } }]", "[0, 0, 1]", "points.obj"),
        ("boundary = [{ outline = \"nothing.json\" }]", "[0, 1]", "nothing.json"),
    ] {
        let orbit = format!("orbit = [{{ position = {start}, velocity = {start} }}]");
        let scene = format!("law = \"specular\"\ntable = {{ {table} }}\n{orbit}\nrun = {{ collisions = 1 }}\n");
        let output = folder.run(&scene, &[]);
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(told.contains(&format!("{file}: it contains no walls")), "{told}");
        assert_eq!(output.status.code(), Some(2));
    }
}

/// What is told about a scene beside which a file lies.
fn told(border: &str, file: &str, text: &str) -> String {
    let folder = Folder::new("told-about-a-file");
    fs::write(folder.0.join(file), text).unwrap();
    let table = if file.ends_with("obj") { "[table]\ndimension = 3\n" } else { "" };
    let start =
        if file.ends_with("obj") { "[0.5, 0.5, 0.5]\nvelocity = [1, 0.2, 0.3]" } else { "[1, 1]\nvelocity = [1, 0.3]" };
    let scene = format!(
        "law = \"specular\"\n{table}[[table.boundary]]\n{border}\n[[orbit]]\nposition = {start}\n[run]\ncollisions = 1\n"
    );
    let output = folder.run(&scene, &[]);
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn errors_about_a_drawing_name_its_elements_and_a_wall_drawn_twice() {
    let drawing = |third: &str| {
        let rect = "<rect x='2' y='-6' width='2' height='2'/>";
        format!("<svg xmlns='http://www.w3.org/2000/svg'><rect y='-9' width='9' height='9'/>\n{rect}\n\n{third}</svg>")
    };
    let twice = told("outline = \"d.svg\"", "d.svg", &drawing("<rect x='2' y='-6' width='2' height='2'/>"));
    assert!(twice.contains(" coincide near "), "{twice}");
    assert!(twice.contains(" is from line 2, <rect>, piece ") && twice.contains(" is from line 4, <rect>"), "{twice}");
    assert!(twice.contains("help: the same wall is drawn twice: leave one out"), "{twice}");
    let across = told("outline = \"d.svg\"", "d.svg", &drawing("<circle cx='4' cy='-5' r='0.5'/>"));
    assert!(across.contains(" cross near ") && across.contains("is from line 4, <circle>"), "{across}");
}

#[test]
fn a_short_piece_of_a_map_is_told_with_its_position_and_its_point() {
    let ring =
        "[[500000, 5400000], [500010, 5400000], [500010, 5400000.00000001], [500010, 5400010], [500000, 5400000]]";
    let map = format!("{{\"type\": \"Polygon\", \"coordinates\": [{ring}]}}");
    let told = told("outline = \"g.json\"", "g.json", &map);
    assert!(told.contains("near (500010, 5400000); piece 1 is from coordinates[0][1]"), "{told}");
}

#[test]
fn errors_about_a_mesh_name_the_line_of_the_face() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    let sides = "f 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let mesh = "mesh = { file = \"m.obj\", domain = \"inside\" }";
    let twice = told(mesh, "m.obj", &format!("{vertices}f 4 3 2 1\n{sides}f 4 3 2 1\n"));
    assert!(twice.contains("m.obj, line 15: the face occurs twice: remove one of the two"), "{twice}");
    let wrong = told(mesh, "m.obj", &format!("{vertices}f 1 2 3 4\n{sides}"));
    assert!(
        wrong.contains("m.obj, line 9: the face runs along an edge in the same direction as its neighbour"),
        "{wrong}"
    );
}
