//! Outlines and surfaces from files: drawings (SVG) and maps (`GeoJSON`) as pieces of a table, triangles (STL, OBJ) as walls in
//! space.
//!
//! Straight edges, circular arcs and elliptic arcs are imported exactly. Bézier curves become smoothly joined circular arcs
//! within a tolerance. Loops are oriented as a table needs them: an outline that lies in an even number of others is an outer
//! wall, any other one is a hole in it.
//!
//! ```
//! use geometry::{Table, import};
//! let drawing = r#"<svg xmlns="http://www.w3.org/2000/svg">
//!   <path d="M 0 0 h 4 v 2 h -4 z"/>
//!   <circle cx="2" cy="1" r="0.5"/>
//! </svg>"#;
//! let table = Table::new(import::svg(drawing, import::TOLERANCE)?.pieces(1.0)?.walls)?;
//! assert!((table.area() - (8.0 - core::f64::consts::PI / 4.0)).abs() < 1e-15);
//! # Ok::<(), geometry::Error>(())
//! ```
mod biarc;
mod contour;
mod distinct;
mod ears;
mod geojson;
mod obj;
mod place;
mod stl;
mod svg;

pub use contour::Drawing;
pub use geojson::geojson;
pub use obj::obj;
pub use place::{Imported, Place};
pub use stl::stl;
pub use svg::svg;

/// How far the arcs that replace Bézier curves may deviate from them, as a fraction of the size of the drawing.
pub const TOLERANCE: f64 = 1e-9;
