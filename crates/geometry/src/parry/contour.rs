//! The outlines of parry's planar shapes, as exact figures.
use super::convert::{Frame, from_glam2};
use crate::{
    Error, Extent, Figure, Piece,
    edges::{chains, merged, sides},
    plane::{cross, key, slack},
    shapes::{Arc, Circle, FullLine, Ray, Segment},
    validate::crosses_itself,
};
use nalgebra::Vector2;
use parry2d_f64::{
    math::Vector as Glam,
    shape::{Polyline, TriMesh, TypedShape, Voxels},
};
use std::collections::{HashMap, HashSet};

/// The outline of a shape.
#[derive(Clone, Debug)]
pub(crate) struct Contour {
    /// The kind of shape, for messages.
    pub(crate) name: &'static str,
    /// The boundary of its interior, traversed with the interior on the left.
    pub(crate) figures: Vec<Figure>,
    /// Segments that are walls on both sides.
    pub(crate) screens: Vec<[Vector2<f64>; 2]>,
}

/// The exact piece for a figure.
pub(crate) fn piece_of(figure: &Figure) -> Result<Box<dyn Piece>, Error> {
    Ok(match *figure {
        Figure::Segment { ends: [a, b] } => Box::new(Segment::new(a, b)?),
        Figure::Ray { from, direction, left } => Box::new(Ray::new(from, direction, left)?),
        Figure::Line { through, direction } => Box::new(FullLine::new(through, direction)?),
        Figure::Arc { center, radius, ends: [a, b], inside } => {
            Box::new(Arc::with_radius(center, radius, a, b, inside)?)
        }
        Figure::Circle { center, radius, inside } => Box::new(Circle::new(center, radius, inside)?),
        Figure::Other => return Err(Error::Empty),
    })
}

/// The same figure with the table on its other side.
pub(crate) fn reversed(figure: &Figure) -> Figure {
    match *figure {
        Figure::Segment { ends: [a, b] } => Figure::Segment { ends: [b, a] },
        Figure::Ray { from, direction, left } => Figure::Ray { from, direction, left: !left },
        Figure::Line { through, direction } => Figure::Line { through, direction: -direction },
        Figure::Arc { center, radius, ends: [a, b], inside } => {
            Figure::Arc { center, radius, ends: [b, a], inside: !inside }
        }
        Figure::Circle { center, radius, inside } => Figure::Circle { center, radius, inside: !inside },
        Figure::Other => Figure::Other,
    }
}

impl Contour {
    fn solid(name: &'static str, figures: Vec<Figure>) -> Contour {
        Contour { name, figures, screens: vec![] }
    }

    /// The same outline, of a closed polygon: it must bound an inside, which has no place for walls on both sides.
    pub(crate) fn closed(self) -> Result<Contour, Error> {
        let mut ends: HashMap<[u64; 2], usize> = HashMap::new();
        for point in self.screens.as_flattened() {
            *ends.entry(key(*point)).or_default() += 1;
        }
        // where most edges meet; the first of such places
        let meets = self.screens.as_flattened().iter().rev().max_by_key(|point| ends.get(&key(**point)));
        if let Some(at) = meets { Err(Error::TouchingOutline { at: (*at).into() }) } else { Ok(self) }
    }

    /// A convex polygon (or a segment, as two points), in either sense, with a border around it.
    pub(crate) fn convex(name: &'static str, points: &[Vector2<f64>], radius: f64, frame: &Frame<2>) -> Contour {
        Contour::solid(name, rounded(points, radius, frame))
    }

    /// The outline of a single shape; `None` where it does not consist of segments and arcs. Compounds are handled
    /// by [`super::union`].
    pub(crate) fn of(shape: &TypedShape<'_>, frame: &Frame<2>) -> Result<Option<Contour>, Error> {
        let place = |v: Glam| frame.point(&from_glam2(v));
        let polygon = |points: &[Glam], radius: f64| {
            let points: Vec<Vector2<f64>> = points.iter().map(|&p| from_glam2(p)).collect();
            rounded(&points, radius, frame)
        };
        let corners = |h: Glam| [[-h.x, -h.y], [h.x, -h.y], [h.x, h.y], [-h.x, h.y]].map(|[x, y]| Glam::new(x, y));
        Ok(Some(match shape {
            TypedShape::Ball(ball) => Contour::solid(
                "ball",
                vec![Figure::Circle { center: frame.translation, radius: ball.radius, inside: true }],
            ),
            TypedShape::Cuboid(cuboid) => Contour::solid("cuboid", polygon(&corners(cuboid.half_extents), 0.0)),
            TypedShape::Capsule(capsule) => {
                Contour::solid("capsule", polygon(&[capsule.segment.a, capsule.segment.b], capsule.radius))
            }
            TypedShape::Triangle(t) => Contour::solid("triangle", polygon(&[t.a, t.b, t.c], 0.0)),
            TypedShape::ConvexPolygon(p) => Contour::solid("convex polygon", polygon(p.points(), 0.0)),
            TypedShape::RoundCuboid(r) => {
                Contour::solid("round cuboid", polygon(&corners(r.inner_shape.half_extents), r.border_radius))
            }
            TypedShape::RoundTriangle(r) => {
                let t = &r.inner_shape;
                Contour::solid("round triangle", polygon(&[t.a, t.b, t.c], r.border_radius))
            }
            TypedShape::RoundConvexPolygon(r) => {
                Contour::solid("round convex polygon", polygon(r.inner_shape.points(), r.border_radius))
            }
            TypedShape::HalfSpace(half) => {
                // the solid lies behind the normal: on the left of the normal turned by a quarter counter-clockwise
                let n = frame.direction(&from_glam2(half.normal));
                let direction = Vector2::new(-n.y, n.x);
                Contour::solid("half-space", vec![Figure::Line { through: frame.translation, direction }])
            }
            TypedShape::Segment(s) => {
                Contour { name: "segment", figures: vec![], screens: vec![[place(s.a), place(s.b)]] }
            }
            TypedShape::HeightField(field) => {
                // parry's cells compute their two ends separately, up to one ulp apart, so we compute the vertices
                // ourselves
                let (heights, scale) = (field.heights(), field.scale());
                let cells = heights.len() - 1;
                let vertex =
                    |i: usize| place(Glam::new((i as f64 / cells as f64 - 0.5) * scale.x, heights[i] * scale.y));
                let present = (0..cells).rev().filter(|&i| !field.is_segment_removed(i));
                // the solid lies below: on the left when going towards −x
                let upward = scale.x > 0.0;
                let ends = |i| if upward { [vertex(i + 1), vertex(i)] } else { [vertex(i), vertex(i + 1)] };
                Contour::solid("height field", present.map(|i| Figure::Segment { ends: ends(i) }).collect())
            }
            TypedShape::Polyline(line) => polyline(line, frame)?,
            TypedShape::TriMesh(mesh) => Contour::solid("triangle mesh", mesh_outline(mesh, frame)?),
            TypedShape::Voxels(voxels) => Contour::solid("voxels", voxel_outline(voxels, frame)),
            TypedShape::Compound(_) | TypedShape::Custom(_) => return Ok(None),
        }))
    }
}

fn segments(ends: impl IntoIterator<Item = [Vector2<f64>; 2]>) -> Vec<Figure> {
    ends.into_iter().filter(|[a, b]| a != b).map(|ends| Figure::Segment { ends }).collect()
}

/// Half the sum of `p × q` over the edges of a closed polygon: its area, positive if counter-clockwise.
fn area(points: &[Vector2<f64>]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(p, q)| cross((p - origin).into(), (q - origin).into())).sum::<f64>()
}

/// A convex polygon (or a segment, as two points) with a border of the given width around it.
fn rounded(points: &[Vector2<f64>], radius: f64, frame: &Frame<2>) -> Vec<Figure> {
    /// Two edges whose directions differ by less than this count as one: their arc would be shorter than the
    /// rounding of its ends.
    const STRAIGHT: f64 = 1e-12;
    let mut points: Vec<Vector2<f64>> = points.to_vec();
    if area(&points) < 0.0 {
        points.reverse();
    }
    points.dedup();
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    if let [center] = points[..] {
        return vec![Figure::Circle { center: frame.point(&center), radius, inside: true }];
    }
    let n = points.len();
    if radius == 0.0 {
        return segments((0..n).map(|i| [frame.point(&points[i]), frame.point(&points[(i + 1) % n])]));
    }
    // outward normals of the edges i → i+1
    let normals: Vec<Vector2<f64>> = (0..n)
        .map(|i| {
            let d = points[(i + 1) % n] - points[i];
            Vector2::new(d.y, -d.x) / libm::hypot(d.x, d.y)
        })
        .collect();
    // the arc around vertex i, from the end of edge i−1 to the start of edge i
    let joint = |i: usize| {
        let (before, after) = (normals[(i + n - 1) % n], normals[i % n]);
        let at = points[i % n];
        let bends = before.dot(&after) < 0.0 || cross(before.into(), after.into()) > STRAIGHT;
        let (a, b) = (frame.point(&(at + before * radius)), frame.point(&(at + after * radius)));
        if bends { (a, b, true) } else { (a, a, false) }
    };
    let mut figures = vec![];
    for i in 0..n {
        let (_, from, _) = joint(i);
        let (to, turned, bends) = joint(i + 1);
        figures.push(Figure::Segment { ends: [from, to] });
        if bends {
            let center = frame.point(&points[(i + 1) % n]);
            figures.push(Figure::Arc { center, radius, ends: [to, turned], inside: true });
        }
    }
    figures
}

/// Segments along directed edges in the order of traversal, loop after loop; `place` finds the points by their numbers.
fn chained(edges: &[[usize; 2]], place: impl Fn(usize) -> Vector2<f64>) -> Vec<Figure> {
    let chains = chains(edges);
    segments(chains.iter().flat_map(|chain| chain.windows(2)).map(|w| [place(w[0]), place(w[1])]))
}

/// Closed loops bound an interior (nested ones alternate: an island in a hole in a solid); all else is a screen.
fn polyline(line: &Polyline, frame: &Frame<2>) -> Result<Contour, Error> {
    let points: Vec<Vector2<f64>> = line.vertices().iter().map(|&p| frame.point(&from_glam2(p))).collect();
    let id = merged(points.iter().copied());
    let mut edges: Vec<[usize; 2]> =
        line.indices().iter().map(|&[a, b]| [id[a as usize], id[b as usize]]).filter(|[a, b]| a != b).collect();
    // an edge traversed there and back is one wall
    let mut known = HashSet::new();
    edges.retain(|&[a, b]| known.insert([a.min(b), a.max(b)]));
    let mut at: HashMap<usize, Vec<usize>> = HashMap::new(); // edges at each vertex
    for (k, e) in edges.iter().enumerate() {
        for &v in e {
            at.entry(v).or_default().push(k);
        }
    }
    let mut used = vec![false; edges.len()];
    let (mut loops, mut screens) = (vec![], vec![]);
    for k in 0..edges.len() {
        if used[k] {
            continue;
        }
        // the connected component of this edge
        let (mut component, mut open) = (vec![], vec![k]);
        used[k] = true;
        while let Some(k) = open.pop() {
            component.push(k);
            for &j in edges[k].iter().flat_map(|v| &at[v]) {
                if !used[j] {
                    used[j] = true;
                    open.push(j);
                }
            }
        }
        component.sort_unstable();
        let closed = component.len() > 2 && component.iter().all(|&k| edges[k].iter().all(|v| at[v].len() == 2));
        if !closed {
            screens.extend(component.iter().map(|&k| edges[k].map(|v| points[v])));
            continue;
        }
        let (mut vertex, mut edge) = (edges[k][0], k);
        let mut corner = vec![];
        for _ in 0..component.len() {
            corner.push(points[vertex]);
            vertex = if edges[edge][0] == vertex { edges[edge][1] } else { edges[edge][0] };
            edge = at[&vertex].iter().copied().find(|&j| j != edge).unwrap_or(edge);
        }
        loops.push(corner);
    }
    let around = |p: &Vector2<f64>, polygon: &[Vector2<f64>]| {
        let next = polygon.iter().cycle().skip(1);
        let crossed = |(a, b): (&Vector2<f64>, &Vector2<f64>)| {
            (a.y > p.y) != (b.y > p.y) && (cross((b - a).into(), (p - a).into()) > 0.0) == (b.y > a.y)
        };
        polygon.iter().zip(next).filter(|&e| crossed(e)).count() % 2 == 1
    };
    let mut figures = vec![];
    for (i, own) in loops.iter().enumerate() {
        let depth = loops.iter().enumerate().filter(|&(j, other)| j != i && around(&own[0], other)).count();
        let counter_clockwise = depth % 2 == 0;
        let mut own = own.clone();
        let n = own.len();
        let sides = |own: &[Vector2<f64>]| segments((0..n).map(|k| [own[k], own[(k + 1) % n]]));
        let width = Extent::of(own.iter().copied());
        let flat = area(&own).abs() <= slack([width.size()]) * (width.max - width.min).amax();
        // a self-crossing is reported later, with its location, when the table is validated
        if flat && crosses_itself(sides(&own).iter().map(piece_of).collect::<Result<_, _>>()?).is_none() {
            let why = "a closed part of it encloses no area: for a wall without thickness, list its vertices once, from tip to tip";
            return Err(Error::Shape { shape: "polyline", why });
        }
        if (area(&own) > 0.0) != counter_clockwise {
            own[1..].reverse();
        }
        figures.extend(sides(&own));
    }
    Ok(Contour { name: "polyline", figures, screens })
}

/// The edges that belong to one triangle only.
fn mesh_outline(mesh: &TriMesh, frame: &Frame<2>) -> Result<Vec<Figure>, Error> {
    let points: Vec<Vector2<f64>> = mesh.vertices().iter().map(|&p| frame.point(&from_glam2(p))).collect();
    let id = merged(points.iter().copied());
    let mut edges = vec![];
    let mut inner = HashSet::new();
    for triangle in mesh.indices() {
        let mut t = triangle.map(|v| id[v as usize]);
        let signed = area(&t.map(|v| points[v]));
        if signed == 0.0 || signed.is_nan() {
            continue;
        }
        if signed < 0.0 {
            t.swap(1, 2);
        }
        for edge in sides(t) {
            inner.insert(edge);
            edges.push(edge);
        }
    }
    if edges.is_empty() {
        return Err(Error::Shape { shape: "triangle mesh", why: "it has no triangle of positive area" });
    }
    edges.retain(|&[a, b]| !inner.contains(&[b, a]));
    Ok(chained(&edges, |v| points[v]))
}

/// The sides of full cells that adjoin empty ones.
fn voxel_outline(voxels: &Voxels, frame: &Frame<2>) -> Vec<Figure> {
    let full: Vec<[i64; 2]> = voxels.voxels().map(|v| [v.grid_coords.x, v.grid_coords.y]).collect();
    let is_full: HashSet<[i64; 2]> = full.iter().copied().collect();
    let size = voxels.voxel_size();
    let mut vertices: Vec<[i64; 2]> = vec![];
    let mut number: HashMap<[i64; 2], usize> = HashMap::new();
    let mut edges = vec![];
    for [i, j] in full {
        let sides = [
            ([i, j - 1], [i, j], [i + 1, j]),
            ([i + 1, j], [i + 1, j], [i + 1, j + 1]),
            ([i, j + 1], [i + 1, j + 1], [i, j + 1]),
            ([i - 1, j], [i, j + 1], [i, j]),
        ];
        for (neighbour, a, b) in sides {
            if !is_full.contains(&neighbour) {
                edges.push([a, b].map(|v| {
                    *number.entry(v).or_insert_with(|| {
                        vertices.push(v);
                        vertices.len() - 1
                    })
                }));
            }
        }
    }
    let place = |v: usize| {
        let [i, j] = vertices[v];
        frame.point(&Vector2::new(i as f64 * size.x, j as f64 * size.y))
    };
    chained(&edges, place)
}
