//! Style sheets and style attributes, as far as they affect outlines.
use roxmltree::Node;

/// Properties that place or form an outline; they are read from attributes only.
const PLACING: [&str; 21] = [
    "cx",
    "cy",
    "d",
    "height",
    "offset",
    "offset-distance",
    "offset-path",
    "offset-position",
    "offset-rotate",
    "r",
    "rotate",
    "rx",
    "ry",
    "scale",
    "transform",
    "transform-box",
    "transform-origin",
    "translate",
    "width",
    "x",
    "y",
];

/// The value of a property, in lower case: that in the style of an element or else that of its attribute.
pub(super) fn value(node: &Node, property: &str) -> Option<String> {
    declared(node, property).or_else(|| node.attribute(property).map(|value| value.trim().to_lowercase()))
}

/// The value of a property in the style of an element.
fn declared(node: &Node, property: &str) -> Option<String> {
    let style = node.attribute("style").map(declarations).unwrap_or_default();
    style.into_iter().rev().find(|(name, _)| name == property).map(|(_, value)| value)
}

/// Whether the style of an element itself fills it, whatever style sheets say.
pub(super) fn fills(node: &Node) -> bool {
    declared(node, "fill").is_some_and(|fill| fill != "none" && fill != "inherit")
}

/// Whether a style sheet leaves outlines without a fill.
pub(super) fn hollows(sheet: &str) -> bool {
    declarations(sheet).iter().any(|(name, value)| name == "fill" && value == "none")
}

/// A property in the style of an element that would place or form its outline.
pub(super) fn placing(node: &Node) -> Option<String> {
    // the size of the page is ignored
    let is_page = |name: &str| node.parent_element().is_none() && ["width", "height"].contains(&name);
    let style = node.attribute("style").map(declarations).unwrap_or_default();
    style.into_iter().find(|declared| is_placing(declared) && !is_page(&declared.0)).map(|(name, _)| name)
}

/// A property in a style sheet that would place, form or hide outlines.
pub(super) fn ruling(sheet: &str) -> Option<String> {
    let hides = |(name, value): &(String, String)| match name.as_str() {
        "display" => value.starts_with("none"),
        "visibility" => !value.starts_with("visible"),
        _ => false,
    };
    declarations(sheet).into_iter().find(|declared| is_placing(declared) || hides(declared)).map(|(name, _)| name)
}

fn is_placing((name, value): &(String, String)) -> bool {
    PLACING.contains(&name.trim_start_matches("-webkit-")) && value != "none"
}

/// Names and values of the declarations in the blocks of a style sheet, or in a style attribute, in lower case.
fn declarations(text: &str) -> Vec<(String, String)> {
    let mut plain = String::new();
    for (k, part) in text.split("/*").enumerate() {
        plain += if k == 0 { part } else { part.split_once("*/").map_or("", |(_, rest)| rest) };
    }
    let pairs = plain.split(['{', '}', ';']).filter_map(|declared| declared.split_once(':'));
    let value = |text: &str| text.split('!').next().unwrap_or("").trim().to_lowercase();
    pairs.map(|(name, text)| (name.trim().to_lowercase(), value(text))).collect()
}
