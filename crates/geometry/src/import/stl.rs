//! Surfaces from STL.
//!
//! The reader is our own: `stl_io` reads only the first solid of a text file, and trusts the length stated in a binary file.
use super::{
    contour::in_range,
    place::{Imported, Place},
};
use crate::{Error, parry::SolidSpec, plane::key};
use std::collections::HashMap;

/// The triangles of an STL file, binary or text: a [`SolidSpec::TriMesh`], and for each triangle its line or the number of its facet.
///
/// Binary files have coordinates in single precision, and texts as many digits as they have: all are taken as they are. The normals in
/// the file are ignored, but the corners of each triangle must go round counter-clockwise as seen from outside (a closed surface may be
/// inside out). All solids of a text file form one surface.
///
/// ```
/// use geometry::{import, parry::Side};
/// let facet = |a: &str, b: &str, c: &str| {
///     format!("facet normal 0 0 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
/// };
/// let [o, x, y, z] = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
/// let facets = [facet(o, y, x), facet(o, x, z), facet(o, z, y), facet(x, y, z)].concat();
/// let corner = import::stl(format!("solid corner\n{facets}endsolid corner\n").as_bytes())?.walls;
/// let room = corner.solid([0.0; 3], Side::Inside)?;
/// assert_eq!(room.distance(&[0.25, 0.25, 0.125].into()), 0.125);
/// # Ok::<(), geometry::Error>(())
/// ```
///
/// # Errors
/// [`Error::Import`] for a file that is not valid STL to its end, [`Error::Empty`] where there is no triangle.
pub fn stl(bytes: &[u8]) -> Result<Imported<SolidSpec>, Error> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let begins_as_text = text.trim_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case("solid"));
    // binary files may begin like this, too; they are recognised by their size
    let (facets, places) = match announced(bytes) {
        Some((count, size)) if bytes.len() as u64 == size || !begins_as_text => binary(bytes, count, size)?,
        _ => ascii(text)?,
    };
    if facets.is_empty() {
        return Err(Error::Empty);
    }
    in_range(facets.as_flattened().as_flattened(), "the file")?;
    let (mut vertices, mut numbers) = (vec![], HashMap::new());
    let mut number = |corner: [f64; 3]| {
        *numbers.entry(key(corner)).or_insert_with(|| {
            vertices.push(corner);
            vertices.len() - 1
        })
    };
    let triangles = facets.into_iter().map(|facet| facet.map(&mut number)).collect();
    Ok(Imported { walls: SolidSpec::TriMesh { vertices, triangles, margin: 0.0 }, places })
}

type Facet = [[f64; 3]; 3];

/// Facets and where they are.
type Facets = (Vec<Facet>, Vec<Place>);

const HEADER: usize = 84;
const FACET: usize = 50;

/// The number of facets that a binary file would have, and its size.
fn announced(bytes: &[u8]) -> Option<(u32, u64)> {
    let count = u32::from_le_bytes(bytes.get(HEADER - 4..HEADER)?.try_into().ok()?);
    Some((count, HEADER as u64 + FACET as u64 * u64::from(count)))
}

fn binary(bytes: &[u8], count: u32, size: u64) -> Result<Facets, Error> {
    let fail = |problem: String| Error::Import { place: "the file".into(), problem };
    if bytes.len() as u64 != size {
        let problem = format!(
            "it is valid STL neither as text nor as binary: {count} facets are announced, which take {size} bytes; it has {}",
            bytes.len()
        );
        return Err(fail(problem));
    }
    let facet = |(k, bytes): (usize, &[u8])| {
        // the normal comes first
        let number = |i: usize| f64::from(f32::from_le_bytes([0, 1, 2, 3].map(|b| bytes[12 + 4 * i + b])));
        let corners = [0, 3, 6].map(|i| [number(i), number(i + 1), number(i + 2)]);
        let is_finite = corners.as_flattened().iter().all(|x| x.is_finite());
        is_finite
            .then_some(corners)
            .ok_or_else(|| fail(format!("a coordinate of facet {k} is not a finite number: export the file again")))
    };
    let facets: Vec<Facet> = bytes[HEADER..].chunks_exact(FACET).enumerate().map(facet).collect::<Result<_, _>>()?;
    let places = (0..facets.len()).map(Place::Facet).collect();
    Ok((facets, places))
}

/// What the lines of a facet begin with.
const LINES: [&str; 7] = ["facet", "outer", "vertex", "vertex", "vertex", "endloop", "endfacet"];

fn ascii(text: &str) -> Result<Facets, Error> {
    let (mut facets, mut places, mut corners) = (vec![], vec![], vec![]);
    let (mut step, mut is_closed) = (0, true);
    for (k, line) in text.lines().enumerate() {
        let fail = |problem: String| Error::Import { place: format!("line {}", k + 1), problem };
        let words: Vec<&str> = line.split_whitespace().collect();
        let Some((first, numbers)) = words.split_first() else { continue };
        let is = |word: &str| first.eq_ignore_ascii_case(word);
        if step == 0 && (is("solid") || is("endsolid")) {
            is_closed = is("endsolid");
            continue;
        }
        if is_closed || !is(LINES[step]) {
            let wanted = if is_closed { "solid" } else { LINES[step] };
            return Err(fail(format!("expected {wanted:?}, found {first:?}")));
        }
        if is("vertex") {
            let coordinates = numbers.iter().map(|text| text.parse::<f64>().ok().filter(|x| x.is_finite()));
            let coordinates: Option<Vec<f64>> = coordinates.collect();
            let Some(&[x, y, z]) = coordinates.as_deref() else {
                return Err(fail(format!("a vertex has three finite numbers, not {:?}", numbers.join(" "))));
            };
            corners.push([x, y, z]);
        }
        if step == 0 {
            places.push(Place::Line(k + 1));
        }
        step = (step + 1) % LINES.len();
        if let (0, &[a, b, c]) = (step, &corners[..]) {
            facets.push([a, b, c]);
            corners.clear();
        }
    }
    if !is_closed {
        let problem = "the text ends before \"endsolid\": export the file again";
        return Err(Error::Import { place: "the file".into(), problem: problem.into() });
    }
    Ok((facets, places))
}
