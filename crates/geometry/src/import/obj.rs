//! Surfaces from Wavefront OBJ.
//!
//! The reader is our own: `tobj` cuts non-convex faces into a wrong surface, and does not report the line of an error.
use super::{
    contour::in_range,
    ears,
    place::{Imported, Place},
};
use crate::{Error, parry::SolidSpec, plane::LENGTHS};
use nalgebra::Vector3;

/// The faces of an OBJ file: a [`SolidSpec::TriMesh`], and for each of its triangles the line of the face. All objects and groups are taken
/// together; textures, normals, materials, points and lines are ignored. Faces of more than three corners are cut into triangles; they
/// need not be convex but must not cross themselves, and where they are not flat, their triangles are the surface.
///
/// The corners of each face must go round counter-clockwise as seen from outside (a closed surface may be inside out).
///
/// ```
/// use geometry::{import, parry::Side};
/// let pyramid = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1\n\
///                f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
/// let room = import::obj(pyramid)?.walls.solid([0.0; 3], Side::Inside)?;
/// assert_eq!(room.distance(&[1.0, 1.0, 0.25].into()), 0.25);
/// # Ok::<(), geometry::Error>(())
/// ```
///
/// # Errors
/// [`Error::Import`] with the line of the problem, [`Error::Empty`] where there is no face.
pub fn obj(text: &str) -> Result<Imported<SolidSpec>, Error> {
    let (mut points, mut faces) = (vec![], vec![]);
    for (line, words) in statements(text.trim_start_matches('\u{feff}')) {
        let located = |problem: String| Error::Import { place: format!("line {line}"), problem };
        match words.split_first() {
            Some((&"v", numbers)) => points.push(point(numbers).map_err(located)?),
            Some((&"f", corners)) => {
                let corners: Result<Vec<_>, _> = corners.iter().map(|word| corner(word, points.len())).collect();
                faces.push((line, corners.map_err(located)?));
            }
            Some((&("surf" | "bsp" | "bzp" | "cdc" | "cdp"), _)) => {
                return Err(located("curved surfaces are not read: export them as polygonal faces".into()));
            }
            _ => {}
        }
    }
    in_range(points.iter().flatten(), "the file")?;
    let (mut vertices, mut triangles, mut places) = (vec![], vec![], vec![]);
    // vertices that belong to no face are left out
    let mut numbers: Vec<Option<usize>> = vec![None; points.len()];
    for (line, corners) in faces {
        let located = |problem: String| Error::Import { place: format!("line {line}"), problem };
        if corners.len() < 3 {
            return Err(located(format!("a face has at least three corners, not {}", corners.len())));
        }
        if let Some(missing) = corners.iter().find(|&&k| k >= points.len()) {
            return Err(located(format!("there is no vertex {}: the file has {}", missing + 1, points.len())));
        }
        let polygon: Vec<_> = corners.iter().map(|&k| points[k]).collect();
        let Some(cut) = ears::triangles(&polygon) else {
            let problem = "the corners of this face do not form a simple polygon: cut it into triangles";
            return Err(located(problem.into()));
        };
        for triangle in cut {
            places.push(Place::Line(line));
            triangles.push(triangle.map(|k| {
                *numbers[corners[k]].get_or_insert_with(|| {
                    vertices.push(polygon[k].into());
                    vertices.len() - 1
                })
            }));
        }
    }
    if triangles.is_empty() {
        return Err(Error::Empty);
    }
    Ok(Imported { walls: SolidSpec::TriMesh { vertices, triangles, margin: 0.0 }, places })
}

/// The words of each statement, and the number of its first line: a line that ends in a backslash goes on in the next one.
fn statements(text: &str) -> Vec<(usize, Vec<&str>)> {
    let mut statements: Vec<(usize, Vec<&str>)> = vec![];
    let mut goes_on = false;
    // lines end in LF, CRLF or, in old files, CR alone
    let lines = text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'));
    for (k, line) in lines.enumerate() {
        let line = line.split('#').next().unwrap_or("").trim_end();
        let (line, more) = line.strip_suffix('\\').map_or((line, false), |line| (line, true));
        match statements.last_mut() {
            Some((_, words)) if goes_on => words.extend(line.split_whitespace()),
            _ => statements.push((k + 1, line.split_whitespace().collect())),
        }
        goes_on = more;
    }
    statements
}

/// The coordinates of a vertex; a weight or a colour may follow.
fn point(numbers: &[&str]) -> Result<Vector3<f64>, String> {
    if numbers.len() < 3 {
        return Err(format!("a vertex has three coordinates, not {}", numbers.len()));
    }
    let mut point = Vector3::zeros();
    for (x, text) in point.iter_mut().zip(numbers) {
        match text.parse::<f64>() {
            Ok(value) if value.abs() <= *LENGTHS.end() => *x = value,
            _ => return Err(format!("{text:?} is not a coordinate: write a number between -1e150 and 1e150")),
        }
    }
    Ok(point)
}

/// The vertex of a corner such as `7`, `7/1/2` or `-1`, counted from 0; negative numbers count back from the last of `count` vertices.
fn corner(word: &str, count: usize) -> Result<usize, String> {
    let number = word.split('/').next().unwrap_or("");
    let vertex = match number.parse::<i64>() {
        Ok(k) if k > 0 => usize::try_from(k - 1).ok(),
        Ok(k) if k < 0 => usize::try_from(k.unsigned_abs()).ok().and_then(|back| count.checked_sub(back)),
        _ => None,
    };
    vertex.ok_or_else(|| {
        format!(
            "{word:?} is not a corner: write the number of a vertex: 1, 2, … from the first, or -1, -2, … from the last"
        )
    })
}
