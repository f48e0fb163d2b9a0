//! Outlines from `GeoJSON`: polygons with holes.
use super::contour::{Contour, Drawing, Edge, Pen, Role, in_range, oriented};
use super::distinct::Distinct;
use crate::Error;
use nalgebra::Vector2;
use serde_json::Value;

/// The outlines of all polygons of a `GeoJSON` text.
///
/// `Polygon` and `MultiPolygon` are read, alone or in features and collections; other geometries do not bound anything and are an
/// error. Coordinates are taken as they are (a plane, not a sphere); a third one is ignored. Rings end with the position that they
/// begin with (RFC 7946, 3.1.6). Outer rings become counter-clockwise and holes clockwise, whatever their orientation in the file.
///
/// ```
/// use geometry::{Table, import};
/// let text = r#"{"type": "Polygon", "coordinates": [[[0, 0], [0, 3], [4, 0], [0, 0]]]}"#;
/// let table = Table::new(import::geojson(text)?.pieces(1.0)?.walls)?;
/// assert_eq!(table.area(), 6.0);
/// # Ok::<(), geometry::Error>(())
/// ```
///
/// # Errors
/// [`Error::Import`] with the place of the problem, [`Error::Empty`] where there is no polygon.
pub fn geojson(text: &str) -> Result<Drawing, Error> {
    let Distinct(value) = serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(|e| {
        let problem = e.to_string();
        let problem = problem.rsplit_once(" at line").map_or(problem.as_str(), |(what, _)| what).to_string();
        Error::Import { place: format!("line {}, column {}", e.line(), e.column()), problem }
    })?;
    let mut contours = vec![];
    object(&value, "the file", &mut contours)?;
    oriented(contours)
}

fn fail<T>(place: &str, problem: impl Into<String>) -> Result<T, Error> {
    Err(Error::Import { place: place.into(), problem: problem.into() })
}

fn object(value: &Value, place: &str, contours: &mut Vec<Contour>) -> Result<(), Error> {
    let kind = value.get("type").and_then(Value::as_str);
    let path = |name: &str| if place == "the file" { name.to_string() } else { format!("{place}.{name}") };
    let list = |name: &str| match value.get(name).and_then(Value::as_array) {
        Some(list) => Ok((path(name), list)),
        None => fail(place, format!("\"{name}\" must be a list")),
    };
    match kind {
        Some("FeatureCollection") => {
            let (path, list) = list("features")?;
            list.iter().enumerate().try_for_each(|(k, v)| object(v, &format!("{path}[{k}]"), contours))
        }
        Some("GeometryCollection") => {
            let (path, list) = list("geometries")?;
            list.iter().enumerate().try_for_each(|(k, v)| object(v, &format!("{path}[{k}]"), contours))
        }
        Some("Feature") => match value.get("geometry") {
            // a feature may have no geometry
            None | Some(Value::Null) => Ok(()),
            Some(geometry) => object(geometry, &path("geometry"), contours),
        },
        Some("Polygon") => {
            let (path, list) = list("coordinates")?;
            polygon(list, &path, contours)
        }
        Some("MultiPolygon") => {
            let (path, list) = list("coordinates")?;
            list.iter().enumerate().try_for_each(|(k, v)| {
                let place = format!("{path}[{k}]");
                match v.as_array() {
                    Some(rings) => polygon(rings, &place, contours),
                    None => fail(&place, "a polygon must be a list of rings"),
                }
            })
        }
        Some(other) => fail(place, format!("a {other:?} bounds no table; a Polygon or MultiPolygon does")),
        None => fail(place, "\"type\" must be the name of a GeoJSON object"),
    }
}

fn polygon(rings: &[Value], place: &str, contours: &mut Vec<Contour>) -> Result<(), Error> {
    for (k, ring) in rings.iter().enumerate() {
        let place = format!("{place}[{k}]");
        let Some(positions) = ring.as_array() else { return fail(&place, "a ring must be a list of positions") };
        let mut corners = vec![];
        for (n, position) in positions.iter().enumerate() {
            let coordinate = |i: usize| position.get(i).and_then(Value::as_f64).filter(|x| x.is_finite());
            let (Some(x), Some(y)) = (coordinate(0), coordinate(1)) else {
                return fail(&format!("{place}[{n}]"), "a position must be a list of at least two finite numbers");
            };
            corners.push(Vector2::new(x, y));
        }
        in_range(corners.iter().flatten(), &place)?;
        let Some((&start, rest)) = corners.split_first() else { return fail(&place, "a ring must not be empty") };
        if corners.last() != Some(&start) {
            let problem = "a ring must end where it begins: repeat its first position at its end";
            return fail(&place, problem);
        }
        let mut pen = Pen::new(start);
        let mut starts = vec![];
        for (n, &corner) in rest.iter().enumerate() {
            if corner != pen.at() {
                starts.push(n);
            }
            pen.draw(Edge::Line, corner);
        }
        match pen.close() {
            Some(form) => {
                let role = if k == 0 { Role::Outer } else { Role::Hole };
                contours.push(Contour { place, form, role, positions: starts });
            }
            None => return fail(&place, "a ring must have at least three different positions"),
        }
    }
    Ok(())
}
