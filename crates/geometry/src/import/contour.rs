//! Closed outlines, turned the right way.
use super::place::{Imported, Place};
use crate::{
    BoxTree, Error, Extent, Landing, Meeting, MeetingKind, Piece, enclosed_area, meetings,
    plane::{GOLDEN_SECTION, LENGTHS, MUST_HAVE_SQUARE, slack},
    shapes::{Arc, Circle, Ellipse, EllipticArc, Ray, Segment},
    sight::is_hit,
    validate::crosses_itself,
};
use nalgebra::Vector2;
use std::sync;

/// Semi-axes whose relative difference is less than this make a circle: transformations are rounded.
const ROUND: f64 = 1e-12;

/// An outline narrower than this part of its greatest coordinate is far from the origin: moved to it, it has at least three more digits,
/// which may show the shape that rounding hides. One that is wider and has no area but for rounding is on average less than `4·10⁻¹²` of
/// its width thick: no digits bring that back.
const FAR: f64 = 1e-3;

/// An ellipse, or the one that an arc is part of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Oval {
    pub(super) center: Vector2<f64>,
    pub(super) semi_axes: [f64; 2],
    /// Direction of the first semi-axis (radians).
    pub(super) angle: f64,
}

impl Oval {
    fn scaled(&self, factor: f64) -> Oval {
        Oval { center: self.center * factor, semi_axes: self.semi_axes.map(|a| a * factor), angle: self.angle }
    }

    fn size(&self) -> f64 {
        self.semi_axes.into_iter().fold(self.center.amax(), f64::max)
    }

    fn radius(&self) -> Option<f64> {
        let [a, b] = self.semi_axes;
        ((a - b).abs() <= ROUND * a.max(b)).then(|| (a * b).sqrt())
    }

    fn whole(&self, inside: bool) -> Result<Box<dyn Piece>, Error> {
        Ok(match self.radius() {
            Some(radius) => Box::new(Circle::new(self.center, radius, inside)?),
            None => Box::new(Ellipse::new(self.center, self.semi_axes, self.angle, inside)?),
        })
    }
}

/// An edge from one vertex to the next.
#[derive(Clone, Copy, Debug)]
pub(super) enum Edge {
    Line,
    Arc { oval: Oval, counter_clockwise: bool },
}

impl Edge {
    fn scaled(&self, factor: f64) -> Edge {
        match *self {
            Edge::Line => Edge::Line,
            Edge::Arc { oval, counter_clockwise } => Edge::Arc { oval: oval.scaled(factor), counter_clockwise },
        }
    }

    fn piece(&self, from: Vector2<f64>, to: Vector2<f64>, reversed: bool) -> Result<Box<dyn Piece>, Error> {
        let (a, b) = if reversed { (to, from) } else { (from, to) };
        Ok(match *self {
            Edge::Line => Box::new(Segment::new(a, b)?),
            Edge::Arc { oval, counter_clockwise } => {
                let inside = counter_clockwise != reversed;
                if oval.radius().is_some() {
                    Box::new(Arc::new(oval.center, a, b, inside)?)
                } else {
                    let ellipse = Ellipse::new(oval.center, oval.semi_axes, oval.angle, inside)?;
                    Box::new(EllipticArc::new(ellipse, a, b)?)
                }
            }
        })
    }
}

/// The form of a closed outline.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// A start, and edges with the vertices that they lead to; the last one leads back.
    Path(Vector2<f64>, Vec<(Edge, Vector2<f64>)>),
    Oval(Oval),
}

impl Form {
    fn scaled(&self, factor: f64) -> Form {
        match self {
            Form::Path(start, edges) => {
                let scaled = |(edge, to): &(Edge, Vector2<f64>)| (edge.scaled(factor), to * factor);
                Form::Path(start * factor, edges.iter().map(scaled).collect())
            }
            Form::Oval(oval) => Form::Oval(oval.scaled(factor)),
        }
    }

    /// The greatest of its lengths.
    fn size(&self) -> f64 {
        match self {
            Form::Path(start, edges) => {
                let of_edge = |(edge, to): &(Edge, Vector2<f64>)| match edge {
                    Edge::Line => to.amax(),
                    Edge::Arc { oval, .. } => oval.size().max(to.amax()),
                };
                edges.iter().map(of_edge).fold(start.amax(), f64::max)
            }
            Form::Oval(oval) => oval.size(),
        }
    }
}

/// Fails where the coordinates of an outline are so large or so small that areas would over- or underflow.
pub(super) fn in_range<'a>(coordinates: impl IntoIterator<Item = &'a f64>, place: &str) -> Result<(), Error> {
    let finite = |x: &f64| if x.is_nan() { f64::INFINITY } else { x.abs() };
    let size = coordinates.into_iter().map(finite).fold(0.0, f64::max);
    if size == 0.0 || LENGTHS.contains(&size) {
        return Ok(());
    }
    let problem = format!("its largest coordinate is {size:e}, which is not {MUST_HAVE_SQUARE}");
    Err(Error::Import { place: place.into(), problem })
}

/// The role of an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// An outer wall or a hole, depending on the outlines around it.
    Nested,
    Outer,
    Hole,
}

/// A closed outline, and where in the file it is.
#[derive(Clone, Debug)]
pub(super) struct Contour {
    pub(super) place: String,
    pub(super) form: Form,
    pub(super) role: Role,
    /// The position at which each edge starts, where the file lists positions.
    pub(super) positions: Vec<usize>,
}

impl Contour {
    fn pieces(&self, reversed: bool) -> Result<Vec<Box<dyn Piece>>, Error> {
        let located = |e: Error| Error::Import { place: self.place.clone(), problem: e.to_string() };
        match &self.form {
            Form::Oval(oval) => Ok(vec![oval.whole(!reversed).map_err(located)?]),
            Form::Path(start, edges) => {
                let mut from = *start;
                let mut pieces = vec![];
                for (edge, to) in edges {
                    pieces.push(edge.piece(from, *to, reversed).map_err(located)?);
                    from = *to;
                }
                if reversed {
                    pieces.reverse();
                }
                Ok(pieces)
            }
        }
    }
}

impl Contour {
    fn scaled(&self, factor: f64) -> Contour {
        Contour { form: self.form.scaled(factor), ..self.clone() }
    }

    /// Where each of its pieces is.
    fn places(&self, count: usize, reversed: bool) -> Vec<Place> {
        let outline: sync::Arc<str> = self.place.as_str().into();
        let place = |k: usize| match self.positions.get(k) {
            Some(position) => Place::Position(outline.clone(), *position),
            None => Place::Outline(outline.clone()),
        };
        let mut places: Vec<Place> = (0..count).map(place).collect();
        if reversed {
            places.reverse();
        }
        places
    }
}

/// A path drawn edge by edge: edges without length are left out, and the last vertex becomes the first one again.
#[derive(Debug)]
pub(super) struct Pen {
    start: Vector2<f64>,
    at: Vector2<f64>,
    edges: Vec<(Edge, Vector2<f64>)>,
}

impl Pen {
    pub(super) fn new(start: Vector2<f64>) -> Pen {
        Pen { start, at: start, edges: vec![] }
    }
    pub(super) fn at(&self) -> Vector2<f64> {
        self.at
    }
    pub(super) fn draw(&mut self, edge: Edge, to: Vector2<f64>) {
        if to != self.at {
            self.edges.push((edge, to));
            self.at = to;
        }
    }
    /// Whether the path is where it started, within rounding.
    pub(super) fn is_home(&self) -> bool {
        (self.at - self.start).amax() <= 4.0 * slack(self.at.iter().chain(self.start.iter()).copied())
    }
    /// The closed path; `None` where there is no edge.
    pub(super) fn close(mut self) -> Option<Form> {
        if !self.is_home() {
            self.draw(Edge::Line, self.start);
        } else if let Some(last) = self.edges.last_mut() {
            last.1 = self.start;
        }
        // snapping may leave an edge of zero length
        let edges = core::mem::take(&mut self.edges);
        let mut from = self.start;
        for (edge, to) in edges {
            if to != from {
                self.edges.push((edge, to));
            }
            from = to;
        }
        (!self.edges.is_empty()).then_some(Form::Path(self.start, self.edges))
    }
}

/// The closed outlines of a drawing or a map, each with the table on its left.
#[derive(Clone, Debug)]
pub struct Drawing {
    contours: Vec<Contour>,
    /// Whether each runs the other way round than in the file.
    turned: Vec<bool>,
}

impl Drawing {
    /// The outlines as pieces of a table, in their order, and where these are in the file. One unit of the file has the length `unit`
    /// \[L\].
    ///
    /// A power of two changes no digit: `unit = 1.0 / size` with [`Drawing::size`] rounded to one brings a drawing of any size to one near 1.
    ///
    /// # Errors
    /// [`Error::Import`] where a length over- or underflows in that unit.
    pub fn pieces(&self, unit: f64) -> Result<Imported<Vec<Box<dyn Piece>>>, Error> {
        let (mut walls, mut places) = (vec![], vec![]);
        for (contour, &reversed) in self.contours.iter().zip(&self.turned) {
            let pieces = contour.scaled(unit).pieces(reversed)?;
            places.extend(contour.places(pieces.len(), reversed));
            walls.extend(pieces);
        }
        Ok(Imported { walls, places })
    }

    /// The greatest coordinate of a vertex or a centre, or semi-axis of an ellipse, in units of the file.
    pub fn size(&self) -> f64 {
        self.contours.iter().map(|contour| contour.form.size()).fold(0.0, f64::max)
    }
}

/// Turns each outline so that the table is on its left.
pub(super) fn oriented(contours: Vec<Contour>) -> Result<Drawing, Error> {
    if contours.is_empty() {
        return Err(Error::Empty);
    }
    let mut loops = vec![];
    for contour in &contours {
        loops.push(contour.pieces(false)?);
    }
    let owners: Vec<usize> = loops.iter().enumerate().flat_map(|(k, l)| l.iter().map(move |_| k)).collect();
    let pieces: Vec<&dyn Piece> = loops.iter().flatten().map(|p| &**p).collect();
    let tree = BoxTree::new(pieces.iter().map(|p| p.extent()));
    let outlines = Outlines { pieces, owners, tree };
    let mut turned = vec![];
    for (k, contour) in contours.iter().enumerate() {
        let area = enclosed_area(loops[k].iter().map(|p| &**p));
        let size = loops[k].iter().map(|p| p.extent().size()).fold(0.0, f64::max);
        let extent = loops[k].iter().map(|p| p.extent()).fold(Extent::EMPTY, Extent::union);
        let width = (extent.max - extent.min).amax();
        // the vertices may be off by the rounding of their coordinates
        let far = width < FAR * size;
        let flat = area.is_nan() || area.abs() <= width * slack([size]);
        // a self-crossing is reported later, with its location, when the table is validated
        if flat && (far || crosses_itself(contour.pieces(false)?).is_none()) {
            let problem = if far {
                "the outline is so far from the origin that its shape is lost in the rounding of its coordinates: move it nearer"
            } else {
                "the outline encloses no area"
            };
            return Err(Error::Import { place: contour.place.clone(), problem: problem.into() });
        }
        let mut nested = nesting(&outlines, k, &loops[k], |on_wall| Some(on_wall.point));
        // a hole may be filled by a polygon, and is a hole nevertheless
        if contour.role == Role::Nested && !nested.is_clear {
            nested = nesting(&outlines, k, &loops[k], |on_wall| outlines.beside(on_wall, area));
        }
        let misplaced = |problem: &str| Error::Import { place: contour.place.clone(), problem: problem.into() };
        let hole = match (contour.role, nested) {
            (Role::Outer, Nesting { is_odd: true, is_clear: true }) => {
                return Err(misplaced(
                    "this polygon lies inside another one: make it a hole of that one, or leave one of them out",
                ));
            }
            (Role::Hole, Nesting { is_odd: false, is_clear: true }) => {
                return Err(misplaced(
                    "this hole lies outside its polygon: move it inside, or make it a polygon of its own",
                ));
            }
            (Role::Outer, _) => false,
            (Role::Hole, _) => true,
            (Role::Nested, Nesting { is_odd, .. }) => is_odd,
        };
        turned.push((area < 0.0) != hole);
    }
    Ok(Drawing { contours, turned })
}

/// Number of tries to find a ray from an outline that touches no other one.
const RAYS: usize = 16;
/// A direction at 54° to the first axis: drawn sides often lie along the axes and their diagonals.
const AWAY: Vector2<f64> = Vector2::new(0.587_785_252_292_473, 0.809_016_994_374_947);

/// Whether an outline lies inside an odd number of others.
#[derive(Clone, Copy)]
struct Nesting {
    is_odd: bool,
    /// Whether a ray was found that touches no other outline, which may fail where outlines have parts in common.
    is_clear: bool,
}

/// An outline lies inside an odd number of others where a ray from it crosses them an odd number of times. It begins at a point of the
/// outline or, where that has all of its wall in common with others, at one beside it.
fn nesting(
    outlines: &Outlines,
    own: usize,
    outline: &[Box<dyn Piece>],
    from: impl Fn(&Landing) -> Option<Vector2<f64>>,
) -> Nesting {
    let mut nesting = Nesting { is_odd: false, is_clear: false };
    for k in 0..RAYS {
        let piece = &outline[k * outline.len() / RAYS];
        let on_wall = piece.landing_at(piece.length() * (GOLDEN_SECTION + k as f64 / (2 * RAYS) as f64));
        let seen = from(&on_wall).and_then(|from| outlines.seen(from, AWAY, |i| outlines.owners[i] != own));
        let Some(seen) = seen else { return nesting };
        let is_clear = seen.iter().all(|m| m.kind == MeetingKind::Crossing);
        nesting = Nesting { is_odd: seen.len() % 2 == 1, is_clear };
        if is_clear {
            break;
        }
    }
    nesting
}

/// The pieces of all outlines.
struct Outlines<'a> {
    pieces: Vec<&'a dyn Piece>,
    /// For each piece, the number of its outline.
    owners: Vec<usize>,
    tree: BoxTree,
}

impl Outlines<'_> {
    /// The meetings of a ray with some of the pieces; `None` where there is no such ray.
    fn seen(&self, from: Vector2<f64>, toward: Vector2<f64>, wanted: impl Fn(usize) -> bool) -> Option<Vec<Meeting>> {
        let ray = Ray::new(from, toward, true).ok()?;
        let reach = slack(from.iter().copied());
        let mut found = vec![];
        self.tree.search(
            |e| is_hit(e, &from, &toward, reach, f64::INFINITY),
            |i| {
                if wanted(i) {
                    found.extend(meetings(&ray, self.pieces[i]));
                }
            },
        );
        Some(found)
    }

    /// A point beside a wall of an outline, inside it, with no other wall in between; the outline runs counter-clockwise if its area is
    /// positive.
    fn beside(&self, on_wall: &Landing, area: f64) -> Option<Vector2<f64>> {
        let inward = on_wall.normal * area.signum();
        let here = 4.0 * slack(on_wall.point.iter().copied());
        let seen = self.seen(on_wall.point, inward, |_| true)?;
        let next = seen.iter().map(|m| m.at[0]).filter(|s| *s > here).min_by(f64::total_cmp)?;
        Some(on_wall.point + inward * (GOLDEN_SECTION * next))
    }
}
