//! `[[table.boundary]]`: a boundary piece by piece.

mod entry;

use core::f64::consts::TAU;

use super::{choice, direction, law, list, point, shapes, text};
use crate::document::{
    Item, Problems, Section, Spanned, coordinate_formula, formula, lengths, polar_formula, positive, real,
};
use crate::expression::Expression;

pub use entry::{Border, Curve, Domain, Edge, EdgePath, Entry, Side, Turn};

const DOMAINS: [(&str, Domain); 2] = [("inside", Domain::Inside), ("outside", Domain::Outside)];
const PLANAR: &[&str] = &["loop", "chain", "circle", "ellipse", "line", "ray", "curve", "shape", "outline"];
const SPATIAL: &[&str] = &["sphere", "plane", "shape", "mesh"];

/// The kinds of walls in a dimension.
pub(super) fn kinds(dimension: usize) -> &'static [&'static str] {
    if dimension == 2 { PLANAR } else { SPATIAL }
}

pub(super) fn read(item: &Item, dimension: usize, problems: &mut Problems) -> Option<Entry> {
    let mut section = Section::new(item, "[[table.boundary]]", problems)?;
    let law = law::at_most_one(&mut section, dimension, problems);
    let (other, example) = if dimension == 2 { (3, example_of("circle")) } else { (2, example_of("sphere")) };
    let keys: Vec<_> = section.others().map(|(key, _)| key).collect();
    let wall_in = |dimension| keys.iter().find(|key| kinds(dimension).contains(&&key.value[..]));
    if let (None, Some(key)) = (wall_in(dimension), wall_in(other)) {
        let what = format!("a \"{}\" is a wall of tables in {other} dimensions", key.value);
        problems.add_with_help(key.span, what, format!("set dimension = {other} in [table]"));
        return None;
    }
    let found = section.one_of(kinds(dimension), example, problems);
    let border = found.and_then(|(key, item)| match key {
        "outline" => text(item, "write for instance \"room.svg\"", problems).map(|file| Border::Outline { file }),
        _ => border(key, Section::inline(item, key, example_of(key), problems)?, dimension, problems),
    });
    section.finish(problems);
    let span = found.map_or(item.span, |(_, item)| item.span);
    Some(Entry { span, border: border?, law })
}

/// How to write a kind of wall.
fn example_of(key: &str) -> &'static str {
    match key {
        "chain" => "chain = { from = [0, 0], edges = [{ line_to = [1, 0] }] }",
        "circle" => "circle = { center = [0, 0], radius = 1 }",
        "sphere" => "sphere = { center = [0, 0, 0], radius = 1 }",
        "ellipse" => "ellipse = { center = [0, 0], semi_axes = [2, 1] }",
        "line" => "line = { through = [0, 0], direction = [1, 0] }",
        "ray" => "ray = { from = [0, 0], direction = [1, 0] }",
        "curve" => "curve = { polar = \"2 + 0.2*cos(5*t)\" }",
        "plane" => "plane = { through = [0, 0, 0], normal = [0, 0, 1] }",
        "mesh" => "mesh = { file = \"rock.obj\" }",
        "shape" => "shape = { name = \"ball\", radius = 1 }",
        _ => "loop = { from = [0, 0], edges = [{ line_to = [1, 0] }, { line_to = [0, 1] }, { line_to = [0, 0] }] }",
    }
}

fn border(key: &str, mut section: Section<'_>, n: usize, problems: &mut Problems) -> Option<Border> {
    let origin = if n == 2 { "[0, 0]" } else { "[0, 0, 0]" };
    let border = match key {
        "loop" | "chain" => {
            let from = section.required("from", "from = [0, 0]").and_then(|item| point(item, n, problems));
            let edges = section
                .required("edges", "edges = [{ line_to = [1, 0] }, ...]")
                .and_then(|item| edges(item, key == "loop", problems));
            let closed = key == "loop";
            let domain = if closed { section.optional("domain") } else { None };
            let domain = domain.map_or(Some(None), |item| choice(item, "domain", &DOMAINS, problems).map(Some));
            (|| Some(Border::Loop { from: from?, edges: edges?, closed, domain: domain? }))()
        }
        "circle" | "sphere" => {
            let center =
                section.required("center", &format!("center = {origin}")).and_then(|item| point(item, n, problems));
            let radius = section.required("radius", "radius = 1").and_then(|item| positive(item, problems));
            let domain = domain(&mut section, Domain::Inside, problems);
            (|| Some(Border::Circle { center: center?, radius: radius?, domain: domain? }))()
        }
        "ellipse" => {
            let center = section.required("center", "center = [0, 0]").and_then(|item| point(item, n, problems));
            let semi_axes =
                section.required("semi_axes", "semi_axes = [2, 1]").and_then(|item| lengths(item, 2, problems));
            let angle =
                section.optional("angle").map_or(Some(Spanned::new(0.0, section.span())), |item| real(item, problems));
            let domain = domain(&mut section, Domain::Inside, problems);
            (|| Some(Border::Ellipse { center: center?, semi_axes: semi_axes?, angle: angle?, domain: domain? }))()
        }
        "line" => {
            let through = section.required("through", "through = [0, 0]").and_then(|item| point(item, n, problems));
            let direction =
                section.required("direction", "direction = [1, 0]").and_then(|item| direction(item, n, problems));
            (|| Some(Border::Line { through: through?, direction: direction? }))()
        }
        "ray" => {
            let from = section.required("from", "from = [0, 0]").and_then(|item| point(item, n, problems));
            let direction =
                section.required("direction", "direction = [1, 0]").and_then(|item| direction(item, n, problems));
            let sides = [("left", Side::Left), ("right", Side::Right)];
            let domain =
                section.optional("domain").map_or(Some(Side::Left), |item| choice(item, "side", &sides, problems));
            (|| Some(Border::Ray { from: from?, direction: direction?, domain: domain? }))()
        }
        "plane" => {
            let through = section.required("through", "through = [0, 0, 0]").and_then(|item| point(item, n, problems));
            let normal = section.required("normal", "normal = [0, 0, 1]").and_then(|item| direction(item, n, problems));
            (|| Some(Border::Plane { through: through?, normal: normal? }))()
        }
        "curve" => return curve(section, problems),
        "mesh" => {
            let file = section
                .required("file", "file = \"rock.obj\"")
                .and_then(|item| text(item, "write for instance \"rock.obj\"", problems));
            let unit = section.optional("unit").map_or(Some(1.0), |item| Some(positive(item, problems)?.value));
            let center = section
                .optional("center")
                .map_or(Some(Spanned::new(vec![0.0; 3], section.span())), |item| point(item, n, problems));
            let domain = domain(&mut section, Domain::Outside, problems);
            (|| Some(Border::Mesh { file: file?, unit: unit?, center: center?, domain: domain? }))()
        }
        _ => return shape(section, n, problems),
    };
    section.finish(problems);
    border
}

fn shape(mut section: Section<'_>, n: usize, problems: &mut Problems) -> Option<Border> {
    let read =
        section.required("name", "name = \"capsule\"").and_then(|item| shapes::read(&mut section, item, n, problems));
    let domain = domain(&mut section, Domain::Outside, problems);
    let Some((shape, lengths)) = read else {
        // Which keys belong to an unknown shape is unknown too.
        section.finish_leniently(problems);
        return None;
    };
    section.finish(problems);
    Some(Border::Shape { shape, lengths, domain: domain? })
}

fn domain(section: &mut Section<'_>, default: Domain, problems: &mut Problems) -> Option<Domain> {
    section.optional("domain").map_or(Some(default), |item| choice(item, "domain", &DOMAINS, problems))
}

fn curve(mut section: Section<'_>, problems: &mut Problems) -> Option<Border> {
    const KINDS: &[&str] = &["polar", "x", "implicit"];
    let domain = domain(&mut section, Domain::Inside, problems);
    if lacks_x(&mut section, KINDS) {
        section.finish(problems);
        return None;
    }
    let Some(found) = section.one_of(KINDS, "polar = \"2 + 0.2*cos(5*t)\"", problems) else {
        // keys of any kind
        for key in ["y", "over", "center", "within"] {
            section.optional(key);
        }
        section.finish(problems);
        return None;
    };
    let curve = curve_of(found, &mut section, problems);
    section.finish(problems);
    let (curve, formula) = curve?;
    Some(Border::Curve { curve, formula, domain: domain? })
}

/// The curve given by this key, and its formula as written.
fn curve_of(
    found: (&str, &Item),
    section: &mut Section<'_>,
    problems: &mut Problems,
) -> Option<(Curve, Spanned<String>)> {
    Some(match found {
        ("polar", item) => {
            let center = section
                .optional("center")
                .map_or(Some(Spanned::new(vec![0.0; 2], section.span())), |item| point(item, 2, problems));
            let text = text(item, "write for instance \"2 + 0.2*cos(5*t)\"", problems)?;
            let radius = polar_formula(&text, problems)?;
            (Curve::Polar { radius, center: center? }, text)
        }
        ("x", x) => {
            let over = section
                .optional("over")
                .map_or(Some(Spanned::new([0.0, TAU], section.span())), |item| range(item, problems));
            let y = section.required("y", "y = \"sin(t)\"");
            let over = over?;
            if over.value[0] > over.value[1] {
                let help = "write the lower end first: a closed curve may run either way";
                problems.add_with_help(over.span, "the range of a closed curve runs downwards", help);
                return None;
            }
            let (point, text) = coordinates([x, y?], over.value, problems)?;
            (Curve::Parametric { point, over }, text)
        }
        (_, item) => {
            let within = section
                .required("within", "within = [[-3, -2], [3, 2]], a box that contains the curve")
                .and_then(|item| corners(item, problems));
            let text = text(item, "write for instance \"x^2/9 + y^2/4 - 1\"", problems)?;
            let function = formula(&text, &["x", "y"], problems)?;
            (Curve::Implicit { function, within: within? }, text)
        }
    })
}

/// Whether a curve given by coordinates is meant of which only the second one is there; the first is then reported as missing.
fn lacks_x(section: &mut Section<'_>, kinds: &[&str]) -> bool {
    let given = |key: &str| section.others().any(|(k, _)| k.value == key);
    let lacks = given("y") && !kinds.iter().any(|kind| given(kind));
    if lacks {
        section.required("x", "x = \"cos(t)\"");
        section.optional("y");
        section.optional("over");
    }
    lacks
}

/// Formulas of both coordinates, and the first as written.
fn coordinates(
    items: [&Item; 2],
    over: [f64; 2],
    problems: &mut Problems,
) -> Option<([Expression; 2], Spanned<String>)> {
    let [x, y] = items.map(|item| {
        let text = text(item, "write for instance \"2*cos(t)\"", problems)?;
        Some((coordinate_formula(&text, over, problems)?, text))
    });
    let ((x, text), (y, _)) = (x?, y?);
    Some(([x, y], text))
}

/// Two parameters that differ.
fn range(item: &Item, problems: &mut Problems) -> Option<Spanned<[f64; 2]>> {
    let ends: Vec<_> =
        list(item, "a range", "[0, \"2*pi\"]", problems)?.iter().map(|item| real(item, problems)).collect();
    let ends: Vec<_> = ends.into_iter().collect::<Option<_>>()?;
    match ends[..] {
        [from, to] if from.value != to.value => Some(Spanned::new([from.value, to.value], item.span)),
        _ => {
            problems.add_with_help(item.span, "a range has two ends that differ", "write for instance [0, \"2*pi\"]");
            None
        }
    }
}

/// Two opposite corners of a box, the lower left one first.
fn corners(item: &Item, problems: &mut Problems) -> Option<Spanned<[[f64; 2]; 2]>> {
    let corners: Vec<_> =
        list(item, "a box", "[[-3, -2], [3, 2]]", problems)?.iter().map(|item| point(item, 2, problems)).collect();
    let corners: Vec<_> = corners.into_iter().collect::<Option<_>>()?;
    match &corners.iter().map(|corner| &corner.value[..]).collect::<Vec<_>>()[..] {
        [[a, b], [c, d]] if a < c && b < d => Some(Spanned::new([[*a, *b], [*c, *d]], item.span)),
        _ => {
            problems.add(item.span, "a box is given by its lower left and its upper right corner");
            None
        }
    }
}

fn edges(item: &Item, closed: bool, problems: &mut Problems) -> Option<Vec<Edge>> {
    let items = list(item, "edges", "[{ line_to = [1, 0] }, { line_to = [0, 1] }, { line_to = [0, 0] }]", problems)?;
    let edges: Vec<_> = items.iter().map(|item| edge(item, problems)).collect();
    if edges.len() < 1 + usize::from(closed) {
        let least = if closed { "a loop has at least two edges" } else { "a chain has at least one edge" };
        problems.add(item.span, format!("{least}, not {}", edges.len()));
        return None;
    }
    edges.into_iter().collect()
}

fn edge(item: &Item, problems: &mut Problems) -> Option<Edge> {
    let mut section = Section::inline(item, "an edge", "{ line_to = [1, 0] }", problems)?;
    let law = law::at_most_one(&mut section, 2, problems);
    if lacks_x(&mut section, &["line_to", "arc_to", "x"]) {
        section.finish(problems);
        return None;
    }
    let path = match section.one_of(&["line_to", "arc_to", "x"], "line_to = [1, 0]", problems) {
        Some(("line_to", item)) => point(item, 2, problems).map(|to| EdgePath::Line { to }),
        Some(("x", x)) => {
            let y = section.required("y", "y = \"t^2\"");
            let over = section.required("over", "over = [0, 1]").and_then(|item| range(item, problems));
            (|| {
                let (y, over) = (y?, over?.value);
                let (point, text) = coordinates([x, y], over, problems)?;
                let [from, to] = over.map(|t| [0, 1].map(|i| point[i].evaluate(&[t])));
                Some(EdgePath::Curve { to: Spanned::new(to.into(), text.span), from, point, over })
            })()
        }
        Some((_, item)) => {
            let to = point(item, 2, problems);
            let center = section.required("center", "center = [0, 0]").and_then(|item| point(item, 2, problems));
            let turns = [("ccw", Turn::CounterClockwise), ("cw", Turn::Clockwise)];
            let turn =
                section.required("turn", "turn = \"ccw\"").and_then(|item| choice(item, "turn", &turns, problems));
            (|| Some(EdgePath::Arc { to: to?, center: center?, turn: turn? }))()
        }
        None => {
            section.finish_leniently(problems);
            return None;
        }
    };
    section.finish(problems);
    Some(Edge { span: item.span, path: path?, law })
}

#[cfg(test)]
mod tests {
    use crate::document::Source;
    use crate::scene::{Request, Scene};

    /// What is wrong with a scene that has this curve.
    fn faults(curve: &str) -> Vec<String> {
        let start = "[[orbit]]\nposition = [0, 0]\nvelocity = [1, 0]\n[run]\ncollisions = 1";
        let scene = format!("law = \"specular\"\n[[table.boundary]]\ncurve = {{ {curve} }}\n{start}");
        let faults = Scene::parse(&Source::new("x.toml", &scene), &Request::default()).err().unwrap_or_default();
        faults.into_iter().map(|fault| fault.what).collect()
    }

    #[test]
    fn of_a_curve_of_no_kind_or_of_several_no_key_of_any_kind_is_unknown() {
        let both = r#"polar = "1", x = "cos(t)", y = "sin(t)", over = [0, "2*pi"]"#;
        assert_eq!(faults(both), [r#"curve has both "polar" and "x""#]);
        let all =
            r#"polar = "1", x = "cos(t)", implicit = "x^2 + y^2 - 1", within = [[-2, -2], [2, 2]], center = [0, 0]"#;
        assert_eq!(faults(all), [r#"curve has "polar", "x" and "implicit""#]);
        for none in ["center = [0, 0]", "over = [0, 1]", "within = [[-2, -2], [2, 2]]"] {
            assert_eq!(faults(none), [r#"curve needs "polar", "x" or "implicit""#], "{none}");
        }
        let misspelt = faults(r#"polr = "1", center = [0, 0], colour = 3"#);
        assert_eq!(misspelt, [r#"unknown key "polr" in curve"#, r#"unknown key "colour" in curve"#]);
        assert_eq!(faults(r#"y = "sin(t)", over = [0, 1]"#), [r#"curve lacks the key "x""#]);
        assert_eq!(faults(r#"polar = "1", y = "sin(t)""#), [r#"unknown key "y" in curve"#]);
        assert_eq!(faults(r#"polar = "1""#), [""; 0]);
    }
}
