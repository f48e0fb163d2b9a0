//! Triangles from meshes.
use geometry::parry::SolidSpec;
use geometry::{Error, Vector3, import};
use proptest::prelude::*;

/// The volume that a surface encloses (divergence theorem), and its number of triangles.
fn volume(surface: &SolidSpec) -> (f64, usize) {
    let SolidSpec::TriMesh { vertices, triangles, .. } = surface else { panic!("{surface:?}") };
    let signed = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|k| Vector3::from(vertices[k]));
        a.dot(&b.cross(&c)) / 6.0
    };
    (triangles.iter().map(signed).sum(), triangles.len())
}

fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().concat()
}

/// A prism over a polygon, its end caps written from a corner of choice.
fn prism(corners: &[[f64; 2]], first: usize) -> String {
    let n = corners.len();
    let vertex = |[x, y]: &[f64; 2], z: i32| format!("v {x} {y} {z}\n");
    let vertices = joined([0, 1].iter().flat_map(|z| corners.iter().map(move |corner| vertex(corner, *z))));
    let face = |order: Vec<usize>| format!("f{}\n", joined(order.iter().map(|k| format!(" {}", k + 1))));
    let top = face((0..n).map(|k| n + (first + k) % n).collect());
    let bottom = face((0..n).rev().map(|k| (first + k) % n).collect());
    let sides = joined((0..n).map(|k| (k, (k + 1) % n)).map(|(a, b)| face(vec![a, b, n + b, n + a])));
    format!("{vertices}{top}{bottom}{sides}")
}

#[test]
fn dented_faces_enclose_what_they_bound() {
    let ell = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let comb: Vec<[f64; 2]> = (0..40).map(|k| [0.1 * f64::from(k), if k % 2 == 0 { 0.3 } else { 2.0 }]).collect();
    let comb = [vec![[3.9, 0.1], [0.0, 0.1]], comb].concat();
    let comb: Vec<_> = comb.into_iter().map(|[x, y]| [x, -y]).collect();
    // a ring, cut open along a line
    let ring = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
    ];
    // corners in the middle of straight edges
    let flat = [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3], [-0.3, 0.3], [-0.2, 0.2], [-0.1, 0.1], [0.0, 0.1]];
    for polygon in [&ell[..], &comb, &ring, &flat] {
        let n = polygon.len();
        let area = (0..n).map(|k| (polygon[k], polygon[(k + 1) % n])).map(|([a, b], [c, d])| 0.5 * (a * d - b * c));
        let area: f64 = area.sum();
        for first in 0..n {
            let (volume, triangles) = volume(&import::obj(&prism(polygon, first)).unwrap().walls);
            assert_eq!(triangles, 2 * (n - 2) + 2 * n, "{polygon:?} from {first}");
            assert!((volume - area).abs() < 1e-14 * area, "{polygon:?} from {first}: {volume} {area}");
        }
    }
    // not only the volume: the point (1.5, 1.5) is outside
    for first in 0..6 {
        let solid =
            import::obj(&prism(&ell, first)).unwrap().walls.solid([0.0; 3], geometry::parry::Side::Outside).unwrap();
        assert_eq!(solid.distance(&[1.5, 1.5, 0.5].into()), 0.5, "from {first}");
    }
}

#[test]
fn obj_lines_may_end_in_any_of_the_usual_ways() {
    let corner = "# a corner\nv 0 0 0\nv 1 0 \\\n 0\nv 0 1 0\nv 0 0 1\n\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    for end in ["\n", "\r\n", "\r"] {
        let text = corner.replace('\n', end);
        assert_eq!(volume(&import::obj(&text).unwrap().walls), (1.0 / 6.0, 4), "{end:?}");
        match import::obj(&text.replace("f 2 3 4", "f 2 3 5")) {
            Err(Error::Import { place, .. }) => assert_eq!(place, "line 11", "{end:?}"),
            other => panic!("{end:?}: {other:?}"),
        }
    }
}

#[test]
fn obj_statements_are_read_as_they_are_written() {
    let corner = "\u{feff}# a corner\no a\nv 0 0 0 1\nv 1 0 \\\n 0\nv 0 1 0\ng b\nv 0 0 1 0.5 0.5 0.5\nvn 0 0 1\nvt 0 0\nl 1 2\np 1\n\
                  usemtl x\nf 1/1/1 3//1 2/1\nf 1 2 4\nf -4 -1 -2\nf 2 3 4 # the last\n";
    assert_eq!(volume(&import::obj(corner).unwrap().walls), (1.0 / 6.0, 4));
    let vertices = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 3 0\n";
    for (statement, words) in [
        ("f 1 2", "at least three corners, not 2"),
        ("f 1 2 5", "there is no vertex 5: the file has 4"),
        ("f 1 2 0", "\"0\" is not a corner"),
        ("f 1 2 -5", "\"-5\" is not a corner"),
        ("f 1 2 x", "\"x\" is not a corner"),
        ("f 1 3 2 4", "do not form a simple polygon"),
        ("f 1 1 1 1", "do not form a simple polygon"),
        ("v 1e200 0 0", "\"1e200\" is not a coordinate"),
        ("v 1 nan 0", "\"nan\" is not a coordinate"),
        ("v 1 1", "three coordinates, not 2"),
        ("surf 0 1 0 1 1 2 3 4", "curved surfaces are not read"),
    ] {
        match import::obj(&format!("{vertices}{statement}\nf 1 2 3\n")) {
            Err(Error::Import { place, problem }) => {
                assert!(place == "line 5" && problem.contains(words), "{place}: {problem}");
            }
            other => panic!("{statement}: {other:?}"),
        }
    }
    assert!(matches!(import::obj(vertices), Err(Error::Empty)));
    assert!(matches!(import::obj("v 1e-200 0 0\n"), Err(Error::Import { .. })));
}

#[test]
fn stl_is_read_to_its_end_or_refused() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0_f32]];
    let facets = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|t: [usize; 3]| t.map(|k| corners[k]));
    let facet = |corners: &[[f32; 3]; 3]| {
        let lines: String =
            corners.iter().map(|[x, y, z]| format!("  VERTEX {x} {y} -{z}\n").replace("--", "")).collect();
        format!("facet normal 0 0 0\n outer loop\n{lines} endloop\nendfacet\n")
    };
    let solid =
        |facets: &[[[f32; 3]; 3]]| format!("solid\n{}endsolid a b\n", facets.iter().map(facet).collect::<String>());
    let two = format!("\u{feff}{}{}", solid(&facets[..1]), solid(&facets[1..]));
    let read = import::stl(two.as_bytes()).unwrap().walls;
    assert_eq!(volume(&read), (-1.0 / 6.0, 4));
    assert!(matches!(read, SolidSpec::TriMesh { vertices, .. } if vertices.len() == 4));

    let mut binary = [&b"solid and yet binary"[..], &[b' '; 60], &4_u32.to_le_bytes()].concat();
    for facet in &facets {
        binary.extend([0; 12]);
        binary.extend(facet.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        binary.extend([0; 2]);
    }
    assert_eq!(volume(&import::stl(&binary).unwrap().walls), (1.0 / 6.0, 4));

    let refused = |bytes: &[u8], at: &str, words: &str| match import::stl(bytes) {
        Err(Error::Import { place, problem }) => assert!(place == at && problem.contains(words), "{place}: {problem}"),
        other => panic!("{other:?}"),
    };
    let mut few = binary.clone();
    few[..5].copy_from_slice(b"bytes");
    few[80] = 2;
    refused(&few, "the file", "2 facets are announced, which take 184 bytes; it has 284");
    few[80] = 5;
    refused(&few, "the file", "5 facets are announced");
    few[80] = 4;
    few[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    refused(&few, "the file", "facet 0 is not a finite number");
    let text = solid(&facets);
    refused(text.split("endsolid").next().unwrap().as_bytes(), "the file", "ends before \"endsolid\"");
    refused(text.replacen("VERTEX 0 0", "VERTEX 0", 1).as_bytes(), "line 4", "three finite numbers");
    refused(
        text.replace("VERTEX 0 0", "VERTEX 0 1e300").as_bytes(),
        "the file",
        "which is not between 1e-150 and 1e150",
    );
    refused(text.replacen("endloop", "VERTEX 0 0 0", 1).as_bytes(), "line 7", "expected \"endloop\"");
    refused(format!("{text}rest").as_bytes(), &format!("line {}", text.lines().count() + 1), "expected \"solid\"");
    assert!(matches!(import::stl(b"solid a\nendsolid\n"), Err(Error::Empty)));
}

#[test]
fn texts_of_stl_keep_all_their_digits() {
    let corners = ["0 0 0", "0.1 1e-17 3", "0.10000000000000002 1 0.3333333333333333", "1e100 0 0"];
    let facet = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|k| corners[k]);
        format!("facet\nouter\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
    };
    let text = format!("solid\n{}{}endsolid\n", facet([0, 1, 2]), facet([3, 1, 2]));
    let SolidSpec::TriMesh { vertices, triangles, .. } = import::stl(text.as_bytes()).unwrap().walls else { panic!() };
    let written = corners.map(|corner| corner.split(' ').map(|x| x.parse::<f64>().unwrap()).collect::<Vec<_>>());
    assert_eq!(vertices.iter().map(|v| v.to_vec()).collect::<Vec<_>>(), written);
    assert_eq!(triangles, [[0, 1, 2], [3, 1, 2]]);
}

#[test]
fn a_face_of_thousands_of_corners_is_cut_into_triangles() {
    // a thin corridor that goes up and down: half of its corners point inwards
    let half = 1500;
    let side = |up: f64| (0..half).map(move |k| Vector3::new(f64::from(k), f64::from(k % 2) * 10.0 + up, 0.0));
    let corners: Vec<_> = side(0.0).chain(side(0.05).collect::<Vec<_>>().into_iter().rev()).collect();
    let vertices = joined(corners.iter().map(|p| format!("v {} {} 0\n", p.x, p.y)));
    let face = joined((1..=corners.len()).map(|k| format!(" {k}")));
    let SolidSpec::TriMesh { vertices, triangles, .. } = import::obj(&format!("{vertices}f{face}\n")).unwrap().walls
    else {
        panic!()
    };
    assert_eq!(triangles.len(), corners.len() - 2);
    let area = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|k| Vector3::from(vertices[k]));
        0.5 * (b - a).cross(&(c - a)).z
    };
    assert!(triangles.iter().all(|t| area(t) > 0.0));
    let sum: f64 = triangles.iter().map(area).sum();
    assert!((sum - 0.05 * f64::from(half - 1)).abs() < 1e-10, "{sum}");
}

proptest! {
    #[test]
    fn surfaces_of_any_kind_are_read_or_refused(
        faces in prop::collection::vec(prop::collection::vec(1..9_usize, 3..9), 1..4),
        points in prop::collection::vec([-3..4_i32, -3..4, -1..2], 8),
        text in "[svfacetndrlop0-9 .\\n\\\\/-]{0,80}",
    ) {
        let face = |corners: &Vec<usize>| format!("f {}\n", format!("{corners:?}").replace(['[', ',', ']'], ""));
        let vertices = joined(points.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")));
        let _ = import::obj(&format!("{vertices}{}", joined(faces.iter().map(face))));
        let _ = import::obj(&text);
        let _ = import::stl(text.as_bytes());
        let _ = import::stl(format!("solid {text}").as_bytes());
    }
}
