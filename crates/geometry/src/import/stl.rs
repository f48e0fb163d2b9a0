//! Surfaces from STL.
use crate::{Error, parry::SolidSpec};
use std::io::Cursor;

/// The triangles of an STL file, binary or text: a [`SolidSpec::TriMesh`].
///
/// STL has coordinates in single precision, and they are taken as they are; what its normals say is not asked for, but the corners of
/// each triangle must go round counter-clockwise as seen from outside (a closed surface may be inside out).
///
/// ```
/// use geometry::{import, parry::Side};
/// let facet = |a: &str, b: &str, c: &str| {
///     format!("facet normal 0 0 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
/// };
/// let [o, x, y, z] = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
/// let facets = [facet(o, y, x), facet(o, x, z), facet(o, z, y), facet(x, y, z)].concat();
/// let corner = import::stl(format!("solid corner\n{facets}endsolid corner\n").as_bytes())?;
/// let room = corner.solid([0.0; 3], Side::Inside)?;
/// assert_eq!(room.distance(&[0.25, 0.25, 0.125].into()), 0.125);
/// # Ok::<(), geometry::Error>(())
/// ```
///
/// # Errors
/// [`Error::Import`] for what is no STL, [`Error::Empty`] where there is no triangle.
pub fn stl(bytes: &[u8]) -> Result<SolidSpec, Error> {
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| Error::Import {
        place: "the file".into(),
        problem: format!("it is neither the text nor the binary form of STL to its end: {error}"),
    })?;
    if mesh.faces.is_empty() {
        return Err(Error::Empty);
    }
    let vertices = mesh.vertices.iter().map(|v| [v[0], v[1], v[2]].map(f64::from)).collect();
    let triangles = mesh.faces.iter().map(|face| face.vertices).collect();
    Ok(SolidSpec::TriMesh { vertices, triangles, margin: 0.0 })
}
