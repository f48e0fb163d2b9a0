//! Where in a file pieces and triangles come from.
use crate::drawings::drawing;
use geometry::{Vector2, import};

#[test]
fn every_piece_and_every_triangle_knows_its_place_in_the_file() {
    let shown = |places: &[import::Place]| places.iter().map(ToString::to_string).collect::<Vec<_>>();
    let drawn = import::svg(&drawing("<circle r='9'/>\n<path d='M0 0H2V2Z'/>"), import::TOLERANCE)
        .unwrap()
        .pieces(1.0)
        .unwrap();
    assert_eq!(shown(&drawn.places), ["line 2, <circle>", "line 3, <path>", "line 3, <path>", "line 3, <path>"]);
    // a position written twice starts no piece, and the outline is turned round
    let ring = "[[[0, 0], [0, 0], [0, 3], [4, 3], [4, 3], [4, 0], [0, 0]]]";
    let map =
        import::geojson(&format!("{{\"type\": \"Polygon\", \"coordinates\": {ring}}}")).unwrap().pieces(1.0).unwrap();
    let names = [5, 4, 2, 1].map(|n| format!("coordinates[0][{n}]"));
    assert_eq!(shown(&map.places), names);
    // the piece that the file draws from a position ends there now
    let ends: Vec<_> = map.walls.iter().map(|piece| piece.ends().unwrap()[1]).collect();
    assert_eq!(ends, [[4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [0.0, 0.0]].map(Vector2::from));
    let faces = import::obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n\nf 1 4 \\\n 2\n").unwrap();
    assert_eq!(shown(&faces.places), ["line 5", "line 5", "line 7"]);
    let facet = "facet\nouter\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let facets = import::stl(format!("solid\n{facet}{facet}endsolid\n").as_bytes()).unwrap();
    assert_eq!(shown(&facets.places), ["line 2", "line 9"]);
    let binary = [&[0; 80][..], &2_u32.to_le_bytes(), &[0; 100]].concat();
    let places = shown(&import::stl(&binary).unwrap().places);
    assert_eq!(places, ["facet 0, counted from 0", "facet 1, counted from 0"]);
}
