//! Where a surface of triangles ends.
use super::Mesh;
use crate::edges::sides;
use nalgebra::Vector3;
use std::collections::HashSet;

/// A gap no wider than this fraction of the size is a crack between triangles that should meet: files may have single precision.
const CRACK: f64 = 1e-6;

/// About as many places are looked at on all edges of the rim together; a gap between walls that is much narrower is not found.
const PLACES: f64 = 1000.0;

/// A place on the rim, and unit vectors away from it.
pub(crate) struct OnRim {
    pub(crate) point: Vector3<f64>,
    /// The normal, into the table.
    pub(crate) normal: Vector3<f64>,
    /// In the surface, across the rim.
    pub(crate) outward: Vector3<f64>,
}

/// A side of a triangle without another triangle beyond it.
struct OpenSide {
    triangle: usize,
    start: Vector3<f64>,
    /// From its start to its end, in units of the mesh's size.
    along: Vector3<f64>,
}

impl Mesh {
    /// Places along the open sides of triangles, less those where another triangle follows after a crack.
    pub(crate) fn rim(&self) -> impl Iterator<Item = OnRim> {
        let open = if self.closed { vec![] } else { self.open_sides() };
        let length: f64 = open.iter().map(|side| side.along.norm()).sum();
        let places = move |OpenSide { triangle, start, along }| {
            let count = libm::ceil(PLACES * (along.norm() / length));
            let normal = self.normals[triangle];
            let outward = (along / along.norm()).cross(&normal);
            let place = move |i: f64| OnRim { point: start + along * self.size * ((i + 0.5) / count), normal, outward };
            let numbers = (0_u32..).map(f64::from).take_while(move |i| *i < count);
            numbers.map(place).filter(move |place| !self.is_continued(triangle, &place.point))
        };
        open.into_iter().flat_map(places)
    }

    fn open_sides(&self) -> Vec<OpenSide> {
        let known: HashSet<[usize; 2]> = self.triangles.iter().copied().flat_map(sides).collect();
        let of = |triangle: usize| sides(self.triangles[triangle]).map(|side| (triangle, side));
        let open = (0..self.triangles.len()).flat_map(of).filter(|(_, [a, b])| !known.contains(&[*b, *a]));
        let described = |(triangle, [a, b]): (usize, [usize; 2])| {
            let [start, end] = [a, b].map(|v| self.vertices[v]);
            OpenSide { triangle, start, along: (end - start) / self.size }
        };
        open.map(described).collect()
    }

    /// Whether a point at an open side of a triangle lies on another triangle as well.
    fn is_continued(&self, k: usize, point: &Vector3<f64>) -> bool {
        let reach = CRACK * self.size;
        let mut found = false;
        self.tree.search(
            |e| e.distance(point) <= 2.0 * reach,
            |other| found = found || (other != k && self.has_on_it(other, point, reach)),
        );
        found
    }
}
