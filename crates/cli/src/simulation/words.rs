//! Numbers and points in readable form.

use crate::document::spell;

/// A number to six digits.
pub(crate) fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    spell(rounded)
}

/// A point or vector; a coordinate that is negligible, at the digits shown, beside the others and beside some length is shown as
/// 0.
pub(crate) fn point(p: &[f64], beside: f64) -> String {
    let size = p.iter().fold(beside, |m: f64, x| m.max(x.abs()));
    let clean = |x: &f64| if x.abs() < 1e-12 * size { 0.0 } else { *x };
    format!("({})", p.iter().map(|x| short(clean(x))).collect::<Vec<_>>().join(", "))
}

/// `1 piece`, `2 pieces`.
pub(crate) fn plural(n: u64, one: &str) -> String {
    if n == 1 { format!("1 {one}") } else { format!("{n} {one}s") }
}
