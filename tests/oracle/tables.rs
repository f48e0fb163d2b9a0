//! Tables, as the fastest walls for them answer.
use super::curve::{Cut, Meeting, Oval, Truth, truth_of};
use super::curves::{Bulge, Cardioid, Kinked, Limacon, Offset, Peanut, Quartic, Softened};
use super::errors::Subject;
use super::number::{Vector, add, small, sub, vector};
use super::subjects::{Frame, cardioid, formulas};
use billiards::geometry::{
    Error, Figure, FundamentalCell, Line, Piece, Table, Vector2, WallHit, Walls, WithWalls,
    shapes::{
        Arc, Circle, Ellipse, EllipticArc, FullLine, Parallel, Ray, Segment,
        curve::{Interval, Polar, PolarFormula},
    },
    tables,
};
use core::f64::consts::PI;
use std::sync::Arc as Shared;

/// The piece of a figure in a frame.
fn framed(figure: &Figure, frame: &Frame) -> Result<Box<dyn Piece>, Error> {
    let at = |p: &Vector2<f64>| frame.point(p.x, p.y);
    Ok(match figure {
        Figure::Segment { ends: [a, b] } => Box::new(Segment::new(at(a), at(b))?),
        Figure::Ray { from, direction, left } => Box::new(Ray::new(at(from), *direction, *left)?),
        Figure::Line { through, direction } => Box::new(FullLine::new(at(through), *direction)?),
        Figure::Arc { center, radius, ends: [a, b], inside } => {
            Box::new(Arc::with_radius(at(center), radius * frame.scale, at(a), at(b), *inside)?)
        }
        Figure::Circle { center, radius, inside } => Box::new(Circle::new(at(center), radius * frame.scale, *inside)?),
        Figure::Other => return Err(Error::Empty),
    })
}

/// The sides of the square between these coordinates.
fn square([low, high]: [f64; 2]) -> Result<Vec<Box<dyn Piece>>, Error> {
    let corners = [[low, low], [high, low], [high, high], [low, high]].map(Vector2::from);
    let side =
        |k: usize| -> Result<Box<dyn Piece>, Error> { Ok(Box::new(Segment::new(corners[k], corners[(k + 1) % 4])?)) };
    (0..4).map(side).collect()
}

/// A star with so many points.
fn star(points: usize) -> Result<Table, Error> {
    let corner = |k: usize| {
        let angle = PI * (k as f64 + 0.1) / points as f64;
        let radius = if k.is_multiple_of(2) { 1.0 } else { 0.6 };
        Vector2::new(radius * libm::cos(angle), radius * libm::sin(angle))
    };
    let side = |k: usize| -> Result<Box<dyn Piece>, Error> {
        Ok(Box::new(Segment::new(corner(k), corner((k + 1) % (2 * points)))?))
    };
    Table::new((0..2 * points).map(side).collect::<Result<_, _>>()?)
}

/// Tables of common figures, whose walls are of every kind.
fn all_tables() -> Result<Vec<(&'static str, f64, Table)>, Error> {
    // a stadium lying askew
    let turned = |p: &Vector2<f64>| Vector2::new(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y);
    let askew: Vec<Box<dyn Piece>> = tables::stadium(1.0, 1.0)?
        .pieces()
        .iter()
        .map(|piece| -> Result<Box<dyn Piece>, Error> {
            Ok(match piece.figure() {
                Figure::Arc { center, radius, ends: [a, b], inside } => {
                    Box::new(Arc::with_radius(turned(&center), radius, turned(&a), turned(&b), inside)?)
                }
                Figure::Segment { ends: [a, b] } => Box::new(Segment::new(turned(&a), turned(&b))?),
                _ => return Err(Error::Empty),
            })
        })
        .collect::<Result<_, _>>()?;
    let line = |x: f64, y: f64| FullLine::new(Vector2::new(x, 0.0), Vector2::new(0.0, y));
    let upright = Table::new(vec![Box::new(line(1.0, 1.0)?), Box::new(line(0.25, -1.0)?)])?;
    let slanting = |x: f64, y: f64, by: f64| FullLine::new(Vector2::new(x, y), Vector2::new(3.0, 1.0) * by);
    let between = Table::new(vec![Box::new(slanting(0.1, -0.2, 1.0)?), Box::new(slanting(-0.5, 0.6, -2.0)?)])?;
    let disk = |x: f64, y: f64, r: f64, inside| Circle::new(Vector2::new(x, y), r, inside);
    let ring = Table::new(vec![Box::new(disk(0.0, 0.0, 1.0, true)?), Box::new(disk(0.3, -0.2, 0.4, false)?)])?;
    let outer: Vec<Box<dyn Piece>> = square([-1.0, 1.0])?;
    let disks: [Box<dyn Piece>; 2] = [Box::new(disk(0.4, 0.3, 0.25, false)?), Box::new(disk(-0.5, -0.2, 0.4, false)?)];
    let two_disks = Table::new(outer.into_iter().chain(disks).collect())?;
    Ok(vec![
        ("strip (Slab)", 1.0, tables::strip(1.0)?),
        ("upright strip (Slab)", 1.0, upright),
        ("strip askew (Strip)", 1.0, between),
        ("rectangle (Cuboid)", 2.0, tables::rectangle([2.0, 1.0])?),
        ("hexagon (Zonogon)", 1.0, tables::hexagon(1.0)?),
        ("pentagon (ConvexPolygon)", 1.0, tables::polygon(5, 1.0)?),
        ("wedge (ConvexPolygon)", 1.0, tables::wedge(1.0)?),
        ("stadium (Capsule)", 2.0, tables::stadium(1.0, 1.0)?),
        ("stadium askew (Rotated)", 2.0, Table::new(askew)?),
        ("circle (Sphere)", 1.0, tables::circle(1.0)?),
        ("sinai (Cuboid, Scatterer)", 1.0, tables::sinai(1.0, 0.25)?),
        ("sinai, radius 1/100", 1.0, tables::sinai(1.0, 0.01)?),
        ("ring (Sphere, Scatterer)", 1.0, ring),
        ("two disks in a square (Cuboid, Pieces)", 1.0, two_disks),
        ("star (Polygon)", 1.0, star(5)?),
        ("star with many sides (Polygon)", 1.0, star(120)?),
        ("pocket (Pieces)", 1.0, tables::pocket([2.0, 1.0], 0.25, 0.4)?),
        ("moon (Pieces)", 1.0, tables::moon(1.0, 0.75, 1.0)?),
        ("mushroom (Pieces)", 1.0, tables::mushroom(1.0, 0.5, 0.75)?),
        ("flower (Pieces)", 1.5, tables::flower(4, 1.25, 2.0)?),
        ("flower with many petals (List)", 1.0, tables::flower(40, 0.1, 0.15)?),
    ])
}

/// What answers for walls.
type Answer<'a> = &'a dyn Fn(&Line<2>) -> WallHit<f64, 2>;

struct Ask<'a>(&'a mut dyn FnMut(Answer<'_>));

impl WithWalls<2> for Ask<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) {
        (self.0)(&|path| walls.first_hit::<f64>(&path.point.into(), &path.velocity.into()));
    }
}

/// A piece and its translates by a lattice, as far as two cells away; hits lie in the table's cell.
pub(crate) struct Repeated {
    pub(crate) piece: Box<dyn Truth>,
    pub(crate) cell: FundamentalCell,
}

impl Repeated {
    fn translations(&self) -> impl Iterator<Item = [f64; 2]> {
        let lattice = self.cell.lattice();
        let cells = |k: usize| if k < lattice.vectors().len() { -2..=2 } else { 0..=0 };
        let pairs = cells(0).flat_map(move |i| cells(1).map(move |j| [i, j].map(f64::from)));
        pairs.map(|cell| lattice.translation(cell).into())
    }
}

impl Truth for Repeated {
    fn meet(&self, x: &Vector, v: &Vector) -> Meeting {
        let mut all = Meeting::default();
        for by in self.translations().map(vector) {
            let Meeting { crossings, inward, touches } = self.piece.meet(&sub(x, &by), v);
            all.crossings.extend(crossings);
            all.inward.extend(inward);
            all.touches.extend(touches);
        }
        for crossing in &mut all.crossings {
            let near = Vector2::from(crossing.point.each_ref().map(small));
            let (_, cells) = self.cell.home(&near);
            crossing.point = sub(&crossing.point, &vector(self.cell.given().translation(cells).into()));
        }
        all
    }
    fn vertices(&self) -> Vec<Vector> {
        let vertices = self.piece.vertices();
        self.translations().flat_map(|by| vertices.iter().map(|p| add(p, &vector(by))).collect::<Vec<_>>()).collect()
    }
}

/// `1 + a |cos φ|`
#[derive(Clone, Debug)]
struct Lens(f64);

impl PolarFormula for Lens {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(angle);
        let a = self.0.copysign(cos);
        [1.0 + a * cos, -a * sin, -a * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let (sin, cos) = (angle.sin(), angle.cos());
        if cos.contains(0.0) {
            let slope = sin * self.0;
            return [cos.abs() * self.0 + 1.0, slope.union(-slope), Interval::ENTIRE];
        }
        let a = self.0.copysign(cos.low);
        [cos * a + 1.0, sin * -a, cos * -a]
    }
}

/// `1 + a |cos φ|^(5/2)`
#[derive(Clone, Debug)]
struct Soft(f64);

impl PolarFormula for Soft {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(angle);
        let (size, root) = (cos.abs(), libm::sqrt(cos.abs()));
        let second = self.0 * (3.75 * root * sin * sin - 2.5 * size * size * root);
        [1.0 + self.0 * size * size * root, -2.5 * self.0 * cos * root * sin, second]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let (sin, cos) = (angle.sin(), angle.cos());
        let (size, root) = (cos.abs(), cos.abs().sqrt());
        let second = sin.square() * root * (3.75 * self.0) + size.square() * root * (-2.5 * self.0);
        [size.square() * root * self.0 + 1.0, cos * root * sin * (-2.5 * self.0), second]
    }
}

/// A table and the truth about each of its pieces.
type Known = (&'static str, f64, Table, Vec<Box<dyn Truth>>);

/// Tables of other curves; formulas in the plain frame only.
fn of_curves(frame: &Frame) -> Result<Vec<Known>, Error> {
    let at = |x, y| frame.point(x, y);
    let by = |x: f64| x * frame.scale;
    let mut all: Vec<Known> = vec![];
    let center = at(0.3, -0.2);
    let axes = [by(1.5), by(0.75)];
    let oval = |arc| Cut::new(Oval::new(center.into(), axes, 0.7, true, arc));
    let ellipse = Ellipse::new(center, axes, 0.7, true)?;
    all.push(("ellipse (Pieces)", 1.5, Table::new(vec![Box::new(ellipse)])?, vec![Box::new(oval(None))]));

    let [a, b] = [by(1.0), by(3.0)].map(|s| ellipse.point_at(s));
    let (arc, chord) = (EllipticArc::new(ellipse, a, b)?, Segment::new(b, a)?);
    let truths: Vec<Box<dyn Truth>> = vec![Box::new(oval(Some([a, b].map(Into::into)))), truth_of(&chord)];
    all.push(("part of an ellipse (Pieces)", 1.5, Table::new(vec![Box::new(arc), Box::new(chord)])?, truths));

    let distance = by(0.125);
    let moved = Parallel::new(Shared::new(ellipse), distance, [0.0, ellipse.length()], None)?;
    let truth = Offset { base: Oval::new(center.into(), axes, 0.7, true, None), distance };
    all.push((
        "parallel of an ellipse (Graphs)",
        1.5,
        Table::new(vec![Box::new(moved)])?,
        vec![Box::new(Cut::new(truth))],
    ));

    if frame.shift == [0.0; 2] {
        let bent = tables::perturbed_polygon(5, by(1.0), 0.0625)?;
        let truths = bent.pieces().iter().map(|side| -> Box<dyn Truth> {
            let [a, b] = side.ends().expect("a side has ends").map(|end| vector(end.into()));
            Box::new(Cut::new(Bulge { a, b, height: by(0.0625) }))
        });
        let truths = truths.collect();
        all.push(("perturbed pentagon (Graphs)", 1.0, bent, truths));
    }
    if frame.name != "plain" {
        return Ok(all);
    }
    let truths: [Box<dyn Truth>; 3] =
        [Box::new(Cut::new(Quartic)), Box::new(Cut::new(Peanut(0.25))), Box::new(Cut::new(Limacon(0.25)))];
    let named = [
        ("formula x⁴ + y⁴ = 1 (Graphs)", 1.0),
        ("formula 1 + ¼ cos 2φ (Graphs)", 1.25),
        ("points e(t) + ¼ e(2t) (Graphs)", 1.25),
    ];
    for ((piece, truth), (name, extent)) in formulas()?.into_iter().zip(truths).zip(named) {
        all.push((name, extent, Table::new(vec![piece])?, vec![truth]));
    }
    let truths: Vec<Box<dyn Truth>> = vec![Box::new(Cut::new(Cardioid(0))), Box::new(Cut::new(Cardioid(1)))];
    all.push(("points e(t) + ½ e(2t), with a cusp (Graphs)", 1.5, Table::new(cardioid()?)?, truths));
    let [_, peanut, _] = formulas()?;
    let length = peanut.length();
    let moved = Parallel::new(peanut.into(), 0.125, [0.0, length], None)?;
    let truth = Cut::new(Offset { base: Peanut(0.25), distance: 0.125 });
    all.push(("parallel of 1 + ¼ cos 2φ (Graphs)", 1.25, Table::new(vec![Box::new(moved)])?, vec![Box::new(truth)]));

    let soft = Polar::new(Vector2::zeros(), Soft(0.25), true)?;
    let truth = Cut::new(Softened(0.25));
    all.push(("formula 1 + ¼ |cos φ|^2.5 (Graphs)", 1.25, Table::new(vec![Box::new(soft)])?, vec![Box::new(truth)]));

    let lens = Polar::new(Vector2::zeros(), Lens(0.25), true)?.pieces();
    // the arc from one kink to the other lies on the left
    let half = |piece: &dyn Piece| usize::from(piece.point_at(0.5 * piece.length()).x < 0.0);
    let truths = lens
        .iter()
        .map(|piece| -> Box<dyn Truth> { Box::new(Cut::new(Kinked { amount: 0.25, half: half(&**piece) })) });
    let truths = truths.collect();
    all.push(("formula 1 + ¼ |cos φ| (Graphs)", 1.25, Table::new(lens)?, truths));
    Ok(all)
}

/// Tables on a lattice, larger or smaller.
fn on_lattices(frame: &Frame) -> Result<Vec<(&'static str, f64, Table)>, Error> {
    let by = |x: f64| x * frame.scale;
    Ok(vec![
        ("sinai torus (Periodic)", 1.0, tables::sinai_torus(by(0.3), by(1.0))?),
        ("lorentz gas (Periodic)", 1.0, tables::lorentz(by(0.45), by(1.0))?),
        ("channel, dispersing (Periodic)", 1.0, tables::channel(by(1.0), by(0.75), by(0.125))?),
        ("channel, focusing (Periodic)", 1.0, tables::channel(by(1.0), by(0.75), by(-0.25))?),
    ])
}

/// Shows every table in a frame.
///
/// # Errors
/// None, but that the library's constructors may have some.
pub(crate) fn each_table(frame: &Frame, mut show: impl FnMut(&Subject<'_>)) -> Result<(), Error> {
    let mut all = of_curves(frame)?;
    for (name, extent, table) in all_tables()? {
        let pieces = table.pieces().iter().map(|piece| framed(&piece.figure(), frame)).collect::<Result<_, _>>()?;
        let table = Table::new(pieces)?;
        let truth = table.pieces().iter().map(|piece| truth_of(&**piece)).collect();
        all.push((name, extent, table, truth));
    }
    // a lattice begins at the origin
    let repeated = if frame.shift == [0.0; 2] { on_lattices(frame)? } else { vec![] };
    for (name, extent, table) in repeated {
        let cell = table.cell().ok_or(Error::Empty)?.clone();
        let once = |piece: &Shared<dyn Piece>| -> Box<dyn Truth> {
            Box::new(Repeated { piece: truth_of(&**piece), cell: cell.clone() })
        };
        let truth = table.pieces().iter().map(once).collect();
        all.push((name, extent, table, truth));
    }
    for (name, extent, table, truth) in all {
        let mut truth = Some(truth);
        table.with_walls(Ask(&mut |hit| {
            let pieces: Vec<&dyn Piece> = table.pieces().iter().map(|piece| &**piece).collect();
            let truth = truth.take().unwrap_or_default();
            // a path starts in the table's cell
            let in_cell = |x: &Vector2<f64>| table.cell().is_none_or(|cell| cell.home(x).1 == [0.0; 2]);
            let (size, extent, inside) =
                (frame.size(extent), extent * frame.scale, &|x: &Vector2<f64>| table.contains(x) && in_cell(x));
            // as far as the translates
            let reach = if table.lattice().is_some() { extent } else { f64::INFINITY };
            show(&Subject { name, size, extent, pieces, truth, inside, reach, hit });
        }));
    }
    Ok(())
}
