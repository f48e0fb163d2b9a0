//! Outlines from SVG drawings.
mod affine;
mod path;
mod style;

use super::{
    biarc::Fit,
    contour::{Contour, Drawing, Edge, Form, Oval, Pen, Role, in_range, oriented},
};
use crate::{Error, plane::slack};
use affine::Affine;
use nalgebra::Vector2;
use path::{Draw, Subpath};
use roxmltree::{Document, Node, ParsingOptions};

/// The outlines of an SVG drawing.
///
/// The elements `path`, `polygon`, `polyline`, `rect`, `circle` and `ellipse` are read, with the transformations of elements and groups
/// given as attributes; open outlines that are filled are closed by a straight edge, as filling does. Hidden elements, texts, images and
/// elements of other namespaces are left out. Colours (except `fill="none"` on an open outline), fill rules, clips and the view box are
/// ignored: lengths are user units, and absolute units (`mm`, `in`, …) are converted at 96 per inch. The x₂ axis of a table points up, that
/// of a drawing down: `y` becomes `−y`, so that both look the same. Bézier curves become arcs within `tolerance` times the greatest
/// coordinate ([`TOLERANCE`](super::TOLERANCE) is a good one).
///
/// # Errors
/// [`Error::Import`] with line and element for what cannot be read, for a straight `line`, which bounds nothing, for an open outline that
/// is not filled, or may be left unfilled by a style sheet, for a `use`, which should be expanded by the drawing program, and for styles
/// that place, form or (in a style sheet) hide outlines; [`Error::Empty`] for a drawing without outlines; [`Error::Parameter`] unless the
/// tolerance is between 10⁻¹⁴ and 1.
pub fn svg(text: &str, tolerance: f64) -> Result<Drawing, Error> {
    if !(1e-14..=1.0).contains(&tolerance) {
        return Err(Error::Parameter { name: "tolerance", must: "between 1e-14 and 1", value: tolerance });
    }
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| {
        let place = format!("line {}, column {}", e.pos().row, e.pos().col);
        Error::Import { place, problem: e.to_string() }
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" || root.tag_name().namespace().is_some_and(|name| name != NAMESPACE) {
        return Err(Element::of(&root).fail("an SVG drawing must have <svg> as its outermost element"));
    }
    let outlines = outlines(root)?;
    let size = outlines.iter().flat_map(Outline::points).fold(0.0, |m: f64, p| m.max(p.amax()));
    let fit = Fit { tolerance: tolerance * size, size };
    let mut contours = vec![];
    for outline in &outlines {
        contours.extend(outline.contour(&fit)?);
    }
    oriented(contours)
}

/// Everything that is drawn, in the order of the file.
fn outlines<'a>(root: Node<'a, 'a>) -> Result<Vec<Outline>, Error> {
    let is_own = |node: &Node| node.is_element() && node.tag_name().namespace() == root.tag_name().namespace();
    root.descendants().filter(is_own).try_for_each(|node| rules_nothing(&node))?;
    let may_hollow = root.descendants().filter(is_own).any(|node| style::hollows(sheet(&node)));
    let mut outlines = vec![];
    // an explicit stack, which deep nesting cannot overflow
    let mut open = vec![(root, Inherited { here: Affine::FLIP, is_visible: true, is_filled: true })];
    while let Some((node, outer)) = open.pop() {
        let name = node.tag_name().name();
        if !GROUPS.contains(&name) && !DRAWN.contains(&name)
            || style::value(&node, "display").as_deref() == Some("none")
        {
            continue;
        }
        let own = outer.within(&node)?;
        if GROUPS.contains(&name) {
            let here = if node == root { own.here } else { own.here.after(&nested(&node)?) };
            let children = node.children().filter(is_own);
            // of a switch, the first child without conditions is meant for all readers
            let conditions = ["requiredExtensions", "requiredFeatures", "systemLanguage"];
            let is_for_all = |node: &Node| !conditions.iter().any(|name| node.has_attribute(*name));
            let children: Vec<_> = match name {
                "switch" => children.filter(is_for_all).take(1).collect(),
                _ => children.collect(),
            };
            open.extend(children.into_iter().rev().map(|child| (child, Inherited { here, ..own })));
        } else if own.is_visible {
            let fill = match own.is_filled {
                false => Fill::None,
                // a sheet overrides attributes and what is inherited
                true if may_hollow && !style::fills(&node) => Fill::Unknown,
                true => Fill::Some,
            };
            outlines.extend(element(name, &node)?.into_iter().map(|drawn| Outline {
                element: Element::of(&node),
                drawn,
                here: own.here,
                fill,
            }));
        }
    }
    Ok(outlines)
}

/// What an element has from those around it.
#[derive(Clone, Copy)]
struct Inherited {
    here: Affine,
    is_visible: bool,
    is_filled: bool,
}

impl Inherited {
    /// The same with what an element changes.
    fn within(self, node: &Node) -> Result<Inherited, Error> {
        if let Some(property) = style::placing(node) {
            let problem =
                format!("{property:?} is read from an attribute only, not from a style: write it as an attribute");
            return Err(Element::of(node).fail(problem));
        }
        if node.has_attribute("transform-origin") {
            return Err(
                Element::of(node).fail("a transform-origin is not read: include its translations in the transform")
            );
        }
        let is_visible = match style::value(node, "visibility").as_deref() {
            None | Some("inherit") => self.is_visible,
            Some(visibility) => visibility == "visible",
        };
        let is_filled = match style::value(node, "fill").as_deref() {
            None | Some("inherit") => self.is_filled,
            Some(fill) => fill != "none",
        };
        let own = affine::parse(node.attribute("transform").unwrap_or("")).map_err(|e| Element::of(node).fail(e))?;
        Ok(Inherited { here: self.here.after(&own), is_visible, is_filled })
    }
}

const NAMESPACE: &str = "http://www.w3.org/2000/svg";

/// Elements whose children are drawn.
const GROUPS: [&str; 4] = ["svg", "g", "a", "switch"];

/// Elements that are drawn themselves.
const DRAWN: [&str; 8] = ["path", "polygon", "polyline", "circle", "ellipse", "rect", "line", "use"];

/// Line and name of an element.
#[derive(Clone, Debug)]
struct Element(String);

impl Element {
    fn of(node: &Node) -> Element {
        let line = node.document().text_pos_at(node.range().start).row;
        Element(format!("line {line}, <{}>", node.tag_name().name()))
    }
    fn fail(&self, problem: impl Into<String>) -> Error {
        Error::Import { place: self.0.clone(), problem: problem.into() }
    }
}

/// The text of a style sheet; of any other element, nothing.
fn sheet<'a>(node: &Node<'a, '_>) -> &'a str {
    if node.tag_name().name() == "style" { node.text().unwrap_or("") } else { "" }
}

/// Fails for a style sheet that would place, form or hide outlines.
fn rules_nothing(node: &Node) -> Result<(), Error> {
    style::ruling(sheet(node)).map_or(Ok(()), |property| {
        let problem = format!(
            "style sheets are not read, and this one sets {property:?}: let the drawing program write it as an attribute of each element"
        );
        Err(Element::of(node).fail(problem))
    })
}

/// The placement of a nested drawing.
fn nested(node: &Node) -> Result<Affine, Error> {
    if node.tag_name().name() != "svg" {
        return Ok(Affine::IDENTITY);
    }
    if node.attribute("viewBox").is_some() {
        return Err(Element::of(node).fail("a nested drawing may be moved but must not have a viewBox"));
    }
    Ok(Affine::translation(length(node, "x", 0.0)?, length(node, "y", 0.0)?))
}

/// A length in user units; `or` where it is not given.
fn length(node: &Node, name: &str, or: f64) -> Result<f64, Error> {
    let Some(text) = node.attribute(name) else { return Ok(or) };
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '%');
    // "1e3" has no unit, "1em" has
    let (number, unit) = match text.parse::<f64>() {
        Ok(_) => (text, ""),
        Err(_) => (digits, &text[digits.len()..]),
    };
    let scale = match unit {
        "" | "px" => 1.0,
        "in" => 96.0,
        "pt" => 96.0 / 72.0,
        "pc" => 16.0,
        "mm" => 96.0 / 25.4,
        "cm" => 96.0 / 2.54,
        "Q" => 96.0 / 101.6,
        _ => {
            return Err(
                Element::of(node).fail(format!("{name}=\"{text}\" must be a number, with an absolute unit if any"))
            );
        }
    };
    match number.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value * scale),
        _ => Err(Element::of(node).fail(format!("{name}=\"{text}\" must be a number between -1e150 and 1e150"))),
    }
}

/// An outline in the coordinates of its element.
#[derive(Clone, Debug)]
enum Drawn {
    Path(Subpath),
    Oval { center: Vector2<f64>, radii: [f64; 2] },
}

/// The outlines that an element draws.
fn element(name: &str, node: &Node) -> Result<Vec<Drawn>, Error> {
    let v = Vector2::new;
    let fail = |problem: String| Err(Element::of(node).fail(problem));
    Ok(match name {
        "path" => {
            let subpaths = path::parse(node.attribute("d").unwrap_or("")).map_err(|e| Element::of(node).fail(e))?;
            subpaths.into_iter().map(Drawn::Path).collect()
        }
        "polygon" | "polyline" => {
            let points = path::points(node.attribute("points").unwrap_or("")).map_err(|e| Element::of(node).fail(e))?;
            let Some((first, rest)) = points.split_first() else { return Ok(vec![]) };
            vec![Drawn::Path(Subpath {
                start: *first,
                edges: rest.iter().map(|&p| Draw::Line(p)).collect(),
                closed: name == "polygon",
            })]
        }
        "circle" | "ellipse" => {
            let center = v(length(node, "cx", 0.0)?, length(node, "cy", 0.0)?);
            let radii = match name {
                "circle" => [length(node, "r", 0.0)?; 2],
                _ => [length(node, "rx", 0.0)?, length(node, "ry", 0.0)?],
            };
            if radii.iter().any(|&r| r < 0.0) {
                return fail("a radius must not be negative".into());
            }
            // radius 0 draws nothing
            if radii.contains(&0.0) {
                return Ok(vec![]);
            }
            vec![Drawn::Oval { center, radii }]
        }
        "rect" => {
            let [x, y] = [length(node, "x", 0.0)?, length(node, "y", 0.0)?];
            let [w, h] = [length(node, "width", 0.0)?, length(node, "height", 0.0)?];
            if w < 0.0 || h < 0.0 {
                return fail("width and height must not be negative".into());
            }
            if w == 0.0 || h == 0.0 {
                return Ok(vec![]);
            }
            // a single radius stands for both
            let given =
                |name: &str| node.attribute(name).filter(|r| *r != "auto").map(|_| length(node, name, 0.0)).transpose();
            let (rx, ry) = (given("rx")?, given("ry")?);
            let (rx, ry) = (rx.or(ry).unwrap_or(0.0).min(0.5 * w), ry.or(rx).unwrap_or(0.0).min(0.5 * h));
            if rx < 0.0 || ry < 0.0 {
                return fail("a radius must not be negative".into());
            }
            let corner = |to| Draw::Arc { radii: [rx, ry], tilt: 0.0, large: false, sweep: true, to };
            let (right, bottom) = (x + w, y + h);
            let ([left_end, right_end], [top_end, bottom_end]) = (straight([x, right], rx), straight([y, bottom], ry));
            let edges = if rx == 0.0 || ry == 0.0 {
                [v(right, y), v(right, bottom), v(x, bottom)].map(Draw::Line).to_vec()
            } else {
                vec![
                    Draw::Line(v(right_end, y)),
                    corner(v(right, top_end)),
                    Draw::Line(v(right, bottom_end)),
                    corner(v(right_end, bottom)),
                    Draw::Line(v(left_end, bottom)),
                    corner(v(x, bottom_end)),
                    Draw::Line(v(x, top_end)),
                    corner(v(left_end, y)),
                ]
            };
            let start = if rx == 0.0 || ry == 0.0 { v(x, y) } else { v(left_end, y) };
            vec![Drawn::Path(Subpath { start, edges, closed: true })]
        }
        "line" => return fail("a straight line bounds nothing: an outline must enclose an area".into()),
        _ => {
            let problem = "references are not followed: expand them (\"unlink clones\") in the drawing program";
            return fail(problem.into());
        }
    })
}

/// Where the straight part of a rectangle's side begins and ends between corners of this radius: a single coordinate where no more than
/// rounding is left of it.
fn straight([from, to]: [f64; 2], radius: f64) -> [f64; 2] {
    let [near, far] = [from + radius, to - radius];
    if far - near <= slack([from, to]) { [near; 2] } else { [near, far] }
}

/// Whether an outline is filled, and so closed where it is open.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fill {
    Some,
    None,
    /// A style sheet, which is not read, may say so or not.
    Unknown,
}

/// An outline, and the map that takes it into the table.
#[derive(Clone, Debug)]
struct Outline {
    element: Element,
    drawn: Drawn,
    here: Affine,
    fill: Fill,
}

impl Outline {
    /// Points from which its size is estimated.
    fn points(&self) -> Vec<Vector2<f64>> {
        let points = match &self.drawn {
            Drawn::Path(path) => core::iter::once(path.start).chain(path.edges.iter().flat_map(Draw::points)).collect(),
            Drawn::Oval { center, radii: [a, b] } => vec![center - Vector2::new(*a, *b), center + Vector2::new(*a, *b)],
        };
        points.into_iter().map(|p| self.here.apply(p)).collect()
    }

    /// The closed outline in the plane of the table; `None` for a path without edges.
    fn contour(&self, fit: &Fit) -> Result<Option<Contour>, Error> {
        in_range(self.points().iter().flatten(), &self.element.0)?;
        let oval = |center: Vector2<f64>, radii: [f64; 2], tilt: f64| {
            let (semi_axes, angle) = self.here.ellipse(radii, tilt);
            Oval { center: self.here.apply(center), semi_axes, angle }
        };
        let form = match &self.drawn {
            Drawn::Oval { center, radii } => Some(Form::Oval(oval(*center, *radii, 0.0))),
            Drawn::Path(path) => {
                let mut from = path.start;
                let mut pen = Pen::new(self.here.apply(from));
                for draw in &path.edges {
                    match *draw {
                        Draw::Line(to) => pen.draw(Edge::Line, self.here.apply(to)),
                        Draw::Cubic(b, c, d) => {
                            let [b, c, d] = [b, c, d].map(|p| self.here.apply(p));
                            let a = pen.at();
                            fit.cubic(&mut pen, [a, b, c, d]);
                        }
                        Draw::Arc { radii, tilt, large, sweep, to } => {
                            let end = self.here.apply(to);
                            match path::center(from, to, radii, tilt, large, sweep) {
                                Some((center, radii)) => {
                                    // the drawing's positive sense is clockwise on paper
                                    let counter_clockwise = sweep == (self.here.determinant() > 0.0);
                                    pen.draw(Edge::Arc { oval: oval(center, radii, tilt), counter_clockwise }, end);
                                }
                                None => pen.draw(Edge::Line, end),
                            }
                        }
                    }
                    from = draw.end();
                }
                let is_open = !path.closed && !pen.is_home();
                match self.fill {
                    Fill::None if is_open => {
                        let problem = "the outline is open and nothing fills it: close it (a path with Z), or give it a fill, \
                                       which closes it by a straight edge";
                        return Err(self.element.fail(problem));
                    }
                    Fill::Unknown if is_open => {
                        let problem = "the outline is open, and style sheets, which are not read, leave some outlines without a fill: \
                                       close it (a path with Z), or write its fill in its attribute \"style\"";
                        return Err(self.element.fail(problem));
                    }
                    _ => {}
                }
                pen.close()
            }
        };
        Ok(form.map(|form| Contour { place: self.element.0.clone(), form, role: Role::Nested, positions: vec![] }))
    }
}
