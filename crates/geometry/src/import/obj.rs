//! Surfaces from Wavefront OBJ.
use crate::{Error, parry::SolidSpec};
use tobj::{LoadError, LoadOptions};

/// The faces of an OBJ file: a [`SolidSpec::TriMesh`]. All objects and groups together; textures, normals and materials are not asked
/// for, and faces of more than three corners are cut into triangles from the first of them.
///
/// The corners of each face must go round counter-clockwise as seen from outside (a closed surface may be inside out).
///
/// ```
/// use geometry::{import, parry::Side};
/// let pyramid = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1\n\
///                f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
/// let room = import::obj(pyramid)?.solid([0.0; 3], Side::Inside)?;
/// assert_eq!(room.distance(&[1.0, 1.0, 0.25].into()), 0.25);
/// # Ok::<(), geometry::Error>(())
/// ```
///
/// # Errors
/// [`Error::Import`] with the line of what is wrong, [`Error::Empty`] where there is no face.
pub fn obj(text: &str) -> Result<SolidSpec, Error> {
    let options = LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..LoadOptions::default() };
    let mut rest = text.as_bytes();
    // materials bound nothing
    let read = tobj::load_obj_buf(&mut rest, &options, |_| Err(LoadError::OpenFileFailed));
    let (models, _) = read.map_err(|error| {
        // the reader stops behind the line that it does not understand
        let line = text[..text.len() - rest.len()].lines().count();
        Error::Import { place: format!("line {line}"), problem: format!("{error}") }
    })?;
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for mesh in models.iter().map(|model| &model.mesh) {
        let first = vertices.len();
        vertices.extend(mesh.positions.chunks_exact(3).map(|p| [p[0], p[1], p[2]]));
        let number = |k: u32| first + k as usize;
        triangles.extend(mesh.indices.chunks_exact(3).map(|t| [number(t[0]), number(t[1]), number(t[2])]));
    }
    if triangles.is_empty() {
        return Err(Error::Empty);
    }
    Ok(SolidSpec::TriMesh { vertices, triangles, margin: 0.0 })
}
