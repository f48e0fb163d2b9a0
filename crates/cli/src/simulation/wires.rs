//! Walls in space as lines on a page: outlines as seen from far away, edges, and the visible parts of planes.

use billiards::geometry::parry::{Side, SolidSpec};
use billiards::geometry::{Error, Vector3};

use super::mesh;
use crate::picture::{Solid, Stroke};

/// Number of points of an outline.
const POINTS: u32 = 512;

/// A wall in space, in the scene's unit.
#[derive(Clone, Debug)]
pub(crate) struct Wall {
    /// Its shape.
    pub(crate) spec: SolidSpec,
    /// Where it is.
    pub(crate) center: [f64; 3],
    /// Where the table lies.
    pub(crate) side: Side,
}

impl Wall {
    /// The same wall, all lengths multiplied by a power of two.
    pub(crate) fn scaled(&self, factor: f64) -> Wall {
        Wall { spec: self.spec.scaled(factor), center: self.center.map(|x| x * factor), side: self.side }
    }

    /// The wall for the centre of a ball that moves on the table's side of this one.
    pub(crate) fn of_centres(&self, radius: f64) -> Result<Wall, Error> {
        let (spec, shift) = self.spec.parallel(self.side, radius)?;
        Ok(Wall { spec, center: [0, 1, 2].map(|i| self.center[i] + shift[i]), side: self.side })
    }

    /// The unit normal of a plane into the table; of any other wall, nothing.
    fn normal(&self) -> Option<Vector3<f64>> {
        let SolidSpec::HalfSpace { normal } = &self.spec else { return None };
        let normal = Vector3::from(*normal) * super::scale::to_unity(*normal);
        Some(normal / if self.side == Side::Outside { normal.norm() } else { -normal.norm() })
    }

    fn place(&self, point: &Vector3<f64>) -> [f64; 3] {
        [0, 1, 2].map(|i| self.center[i] + point[i])
    }
}

/// The projection of space onto the page, and the two directions of space that run along the page and up it.
pub(crate) struct View {
    pub(crate) place: fn([f64; 3]) -> [f64; 2],
    pub(crate) page: [Vector3<f64>; 2],
}

/// Walls as they are drawn.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wires {
    /// The insides of obstacles.
    pub(crate) solids: Vec<Solid>,
    /// Outlines and edges.
    pub(crate) lines: Vec<Stroke>,
}

/// The lines of walls; for planes, the part between the others in a box.
pub(crate) fn of(walls: &[Wall], shown: [[f64; 3]; 2], view: &View) -> Wires {
    let mut wires = Wires::default();
    for wall in walls {
        if wall.normal().is_some() {
            wires.lines.extend(part(wall, walls, shown, view));
        } else {
            solid(wall, view, &mut wires);
        }
    }
    wires
}

/// Outline and edges of a body, the outline filled if it is an obstacle.
fn solid(wall: &Wall, view: &View, wires: &mut Wires) {
    let seen = |points: &[Vector3<f64>]| -> Stroke {
        Stroke::Chain(points.iter().map(|point| (view.place)(wall.place(point))).collect())
    };
    let mut fill = |edge: Vec<Stroke>| {
        if wall.side == Side::Outside {
            wires.solids.push(Solid { edge, is_hollow: false });
        }
    };
    if let SolidSpec::TriMesh { vertices, triangles, margin } = &wall.spec {
        // surfaces parallel to triangles are not drawn
        if *margin == 0.0 {
            let mesh = mesh::seen(vertices, triangles, &view.page[0].cross(&view.page[1]));
            mesh.areas.iter().for_each(|area| fill(area.iter().map(|chain| seen(chain)).collect()));
            wires.lines.extend(mesh.lines.iter().map(|chain| seen(chain)));
        }
        return;
    }
    let around = |k: u32| {
        let (sin, cos) = turned(k);
        wall.spec.farthest(&(view.page[0] * cos + view.page[1] * sin))
    };
    let outline = seen(&(0..=POINTS).filter_map(around).collect::<Vec<_>>());
    fill(vec![outline.clone()]);
    wires.lines.push(outline);
    wires.lines.extend(wall.spec.edges().iter().map(|edge| seen(edge)));
    if let SolidSpec::Ball { radius } = wall.spec {
        let on_equator = |k: u32| {
            let (sin, cos) = turned(k);
            Vector3::new(radius * cos, radius * sin, 0.0)
        };
        wires.lines.push(seen(&(0..=POINTS).map(on_equator).collect::<Vec<_>>()));
    }
}

/// Sine and cosine of `k` parts of a turn.
fn turned(k: u32) -> (f64, f64) {
    libm::sincos(core::f64::consts::TAU * f64::from(k % POINTS) / f64::from(POINTS))
}

/// The part of a plane that lies in a box and on the table's side of all other planes, as a closed chain.
fn part(wall: &Wall, walls: &[Wall], [low, high]: [[f64; 3]; 2], view: &View) -> Option<Stroke> {
    let normal = wall.normal()?;
    let [low, high] = [low, high].map(Vector3::from);
    let size = (high - low).norm();
    let middle = (low + high) * 0.5;
    let foot = middle - normal * normal.dot(&(middle - Vector3::from(wall.center)));
    let least = Vector3::from_fn(|i, _| if i == normal.iamin() { 1.0 } else { 0.0 });
    let along = normal.cross(&least).normalize() * size;
    let across = normal.cross(&along);
    let mut corners: Vec<Vector3<f64>> =
        [-along - across, along - across, along + across, across - along].map(|d| foot + d).into();
    // thinner than a line, so that a plane that is a side of the box is seen completely
    let little = 1e-6 * size;
    let axes = (0..3).flat_map(|i| {
        [(1.0, low), (-1.0, high)].map(|(sign, through)| {
            let mut normal = Vector3::zeros();
            normal[i] = sign;
            (normal, through)
        })
    });
    let others = walls.iter().filter_map(|other| Some((other.normal()?, Vector3::from(other.center))));
    for (normal, through) in axes.chain(others) {
        corners = clipped(&corners, |point| normal.dot(&(point - through)) + little);
    }
    corners.extend(corners.first().copied());
    Some(Stroke::Chain(corners.iter().map(|p| (view.place)((*p).into())).collect()))
}

/// The part of a polygon where a linear function is not negative.
fn clipped(corners: &[Vector3<f64>], height: impl Fn(&Vector3<f64>) -> f64) -> Vec<Vector3<f64>> {
    let mut left = vec![];
    for (k, b) in corners.iter().enumerate() {
        let a = &corners[(k + corners.len() - 1) % corners.len()];
        let [from, to] = [height(a), height(b)];
        if (from < 0.0) != (to < 0.0) {
            left.push(a + (b - a) * (from / (from - to)));
        }
        if to >= 0.0 {
            left.push(*b);
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: View =
        View { place: |[x, y, _]| [x, y], page: [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 1.0, 0.0)] };

    fn wall(spec: SolidSpec, center: [f64; 3], side: Side) -> Wall {
        Wall { spec, center, side }
    }
    fn points(strokes: &[Stroke]) -> Vec<[f64; 2]> {
        let of = |stroke: &Stroke| match stroke {
            Stroke::Chain(points) => points.clone(),
            other => panic!("{other:?}"),
        };
        strokes.iter().flat_map(of).collect()
    }

    #[test]
    fn of_a_plane_the_part_between_the_others_is_drawn() {
        // a prism over the triangle x, y > 0, x + y < 1, seen from above
        let plane = |normal, center| wall(SolidSpec::HalfSpace { normal }, center, Side::Outside);
        let walls = [
            plane([0.0, 0.0, 2.0], [0.0; 3]),
            plane([1.0, 0.0, 0.0], [0.0; 3]),
            plane([0.0, 1.0, 0.0], [0.0; 3]),
            plane([-1.0, -1.0, 0.0], [1.0, 0.0, 0.0]),
        ];
        let drawn = of(&walls, [[-5.0; 3], [5.0; 3]], &VIEW).lines;
        assert_eq!(drawn.len(), 4);
        let floor = points(&drawn[..1]);
        assert_eq!(floor.first(), floor.last());
        let is_near = |p: &[f64; 2], q: [f64; 2]| (p[0] - q[0]).abs() < 1e-4 && (p[1] - q[1]).abs() < 1e-4;
        for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] {
            assert!(floor.iter().any(|p| is_near(p, corner)), "{floor:?}");
        }
        assert!(points(&drawn).iter().all(|[x, y]| *x > -1e-4 && *y > -1e-4 && x + y < 1.0 + 1e-4));
    }

    #[test]
    fn the_plane_of_the_centres_is_a_radius_farther_in() {
        let plane = wall(SolidSpec::HalfSpace { normal: [0.0, 0.0, -2.0] }, [0.5, 0.5, 1.0], Side::Outside);
        let centres = plane.of_centres(0.25).unwrap();
        assert_eq!(centres.center, [0.5, 0.5, 0.75]);
        assert_eq!(centres.normal(), plane.normal());
    }

    #[test]
    fn outlines_go_round_and_obstacles_are_filled() {
        let capsule = SolidSpec::Capsule { from: [-1.0, 0.0, 5.0], to: [1.0, 0.0, -5.0], radius: 0.5 };
        let drawn = of(&[wall(capsule, [10.0, 0.0, 0.0], Side::Outside)], [[0.0; 3], [1.0; 3]], &VIEW);
        let [Stroke::Chain(points)] = &drawn.lines[..] else { panic!("{drawn:?}") };
        assert_eq!(drawn.solids, [Solid { edge: drawn.lines.clone(), is_hollow: false }]);
        assert_eq!(points.first(), points.last());
        for [x, y] in points {
            let off = libm::hypot((x - 10.0).abs().max(1.0) - 1.0, *y);
            assert!((off - 0.5).abs() < 1e-14, "{x} {y}");
        }
    }

    #[test]
    fn meshes_are_filled_if_they_are_obstacles() {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let mesh = SolidSpec::TriMesh { vertices, triangles, margin: 0.0 };
        for (side, filled) in [(Side::Outside, 1), (Side::Inside, 0)] {
            let drawn = of(&[wall(mesh.clone(), [0.0; 3], side)], [[0.0; 3], [1.0; 3]], &VIEW);
            assert_eq!(drawn.solids.len(), filled);
            assert!(drawn.lines.len() > 1);
        }
    }
}
