//! Numbers of input files: literals or formulas, finite and of a sensible size.

use core::f64::consts::PI;
use core::ops::RangeInclusive;

use billiards::geometry::shapes::curve::Interval;

use super::{Item, Problems, Span, Spanned, Value};
use crate::expression::{self, Expression};

/// Smallest accepted length or speed.
pub const SMALLEST: f64 = 1e-150;
/// Largest accepted length, coordinate or speed: squares of such numbers still are finite.
pub const LARGEST: f64 = 1e150;
/// Number of parameters at which the size of a curve is examined.
const PLACES: u32 = 64;
/// Largest accepted count.
const LARGEST_COUNT: u64 = 1_000_000_000_000;

/// A finite number of any size: a literal, or a string that holds an expression.
pub fn number(item: &Item, problems: &mut Problems) -> Option<Spanned<f64>> {
    let x = match &item.value {
        Value::Integer(n) => *n as f64,
        Value::Float(x) if x.is_finite() => *x,
        Value::Float(x) => {
            let what = if x.is_nan() { "NaN is not a number" } else { "the number is infinite" };
            problems.add_with_help(item.span, what, "write a finite number");
            return None;
        }
        Value::Text(text) => match expression::value(text) {
            Ok(x) => x,
            Err(error) => {
                complain(text, item.span, &error, problems);
                return None;
            }
        },
        other => {
            let help = "write for instance 0.5 or \"sqrt(2)/2\"";
            problems.add_with_help(item.span, format!("expected a number, found {}", other.kind()), help);
            return None;
        }
    };
    Some(Spanned::new(x, item.span))
}

/// A formula in the given variables.
pub fn formula(text: &Spanned<String>, variables: &[&str], problems: &mut Problems) -> Option<Expression> {
    match Expression::parse(&text.value, variables) {
        Ok(expression) => Some(expression),
        Err(error) => {
            complain(&text.value, text.span, &error, problems);
            None
        }
    }
}

/// A radius as a formula in the polar angle `t`, with a real value in every direction.
pub fn polar_formula(text: &Spanned<String>, problems: &mut Problems) -> Option<Expression> {
    let help = "r must be a positive finite number for every t from 0 to 2*pi";
    let radius = real_formula(text, [0.0, 2.0 * PI], help, problems)?;
    if let Some((at, r)) = beyond(&radius) {
        let what = format!("near t = {at:.4} the radius is {}", spell(r));
        problems.add_with_help(text.span, what, format!("lengths lie between {SMALLEST:e} and {LARGEST:e}"));
        return None;
    }
    Some(radius)
}

/// A coordinate as a formula in the parameter `t`, with a real value all over a range.
pub fn coordinate_formula(text: &Spanned<String>, over: [f64; 2], problems: &mut Problems) -> Option<Expression> {
    let help = "a coordinate must be a finite number for every t of the curve";
    let coordinate = real_formula(text, over, help, problems)?;
    let mut places = (0..=PLACES).map(|k| over[0] + (over[1] - over[0]) * f64::from(k) / f64::from(PLACES));
    if let Some(at) = places.find(|t| coordinate.evaluate(&[*t]).abs() > LARGEST) {
        let what = format!("near t = {at:.4} the coordinate is {}", spell(coordinate.evaluate(&[at])));
        problems.add_with_help(text.span, what, format!("write a formula that stays below {LARGEST:e}"));
        return None;
    }
    Some(coordinate)
}

/// A formula in `t` with a real value all over a range.
fn real_formula(text: &Spanned<String>, over: [f64; 2], help: &str, problems: &mut Problems) -> Option<Expression> {
    let real = formula(text, &["t"], problems)?;
    if let Some((mut error, at)) = real.unreal(Interval::new(over[0], over[1])) {
        error.what = format!("near t = {at:.4}: {}", error.what);
        error.help = Some(help.into());
        complain(&text.value, text.span, &error, problems);
        return None;
    }
    Some(real)
}

/// An angle at which a radius is outside the range of lengths, and the radius there.
fn beyond(radius: &Expression) -> Option<(f64, f64)> {
    let angles = (0..PLACES).map(|k| 2.0 * PI * f64::from(k) / f64::from(PLACES));
    let mut radii = angles.map(|angle| (angle, radius.evaluate(&[angle])));
    radii.find(|(_, r)| *r > LARGEST || (0.0 < *r && *r < SMALLEST))
}

/// Records an error of an expression, at its own column where the string is written without escapes.
fn complain(text: &str, span: Span, error: &expression::Error, problems: &mut Problems) {
    let raw = problems.source().slice(span);
    let verbatim = raw.get(1..raw.len().saturating_sub(1)) == Some(text);
    let place = if verbatim {
        let offset = text.char_indices().nth(error.column - 1).map_or(text.len(), |(i, _)| i);
        let width = text[offset..].chars().next().map_or(1, char::len_utf8);
        Span::new(span.start + 1 + offset, span.start + 1 + offset + width)
    } else {
        span
    };
    let what = if verbatim {
        error.what.clone()
    } else {
        format!("{} (column {} of the expression)", error.what, error.column)
    };
    match &error.help {
        Some(help) => problems.add_with_help(place, what, help.clone()),
        None => problems.add(place, what),
    }
}

/// A coordinate, angle or the like: at most [`LARGEST`] in absolute value.
pub fn real(item: &Item, problems: &mut Problems) -> Option<Spanned<f64>> {
    let x = number(item, problems)?;
    if x.value.abs() > LARGEST {
        let what = format!("{} is larger than {LARGEST:e}", spell(x.value.abs()));
        problems.add_with_help(item.span, what, format!("write a number between -{LARGEST:e} and {LARGEST:e}"));
        return None;
    }
    Some(x)
}

/// A length or speed: from [`SMALLEST`] to [`LARGEST`].
pub fn positive(item: &Item, problems: &mut Problems) -> Option<Spanned<f64>> {
    let x = number(item, problems)?;
    if (SMALLEST..=LARGEST).contains(&x.value) {
        return Some(x);
    }
    let within = format!("between {SMALLEST:e} and {LARGEST:e}");
    if x.value <= 0.0 {
        problems.add_with_help(
            item.span,
            format!("{} is not positive", spell(x.value)),
            format!("write a number {within}"),
        );
    } else {
        let size = if x.value < SMALLEST { "larger" } else { "smaller" };
        let help = format!("write a {size} number, in another unit if need be");
        problems.add_with_help(item.span, format!("{} is not {within}", spell(x.value)), help);
    }
    None
}

/// Zero, or a length from [`SMALLEST`] to [`LARGEST`].
pub fn nonnegative(item: &Item, problems: &mut Problems) -> Option<Spanned<f64>> {
    let x = number(item, problems)?;
    if x.value == 0.0 {
        return Some(x);
    }
    if x.value < 0.0 {
        let help = format!("write 0 or a number between {SMALLEST:e} and {LARGEST:e}");
        problems.add_with_help(item.span, format!("{} is negative", spell(x.value)), help);
        return None;
    }
    positive(item, problems)
}

/// A whole number from `least` to 10¹².
pub fn count(item: &Item, least: u64, problems: &mut Problems) -> Option<Spanned<u64>> {
    whole(item, least..=LARGEST_COUNT, problems)
}

/// A whole number in a range that ends at 10¹² or before.
pub fn whole(item: &Item, range: RangeInclusive<u64>, problems: &mut Problems) -> Option<Spanned<u64>> {
    let x = number(item, problems)?;
    let exact = match item.value {
        Value::Integer(n) => u64::try_from(n).ok(),
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within range: just checked")]
        _ if x.value % 1.0 == 0.0 && (0.0..=LARGEST_COUNT as f64).contains(&x.value) => Some(x.value as u64),
        _ => None,
    };
    let found = exact.filter(|n| range.contains(n));
    if found.is_none() {
        let (least, most) = (range.start(), *range.end());
        let most = if most == LARGEST_COUNT { "1e12".into() } else { most.to_string() };
        let nearest = libm::round(x.value).clamp(*least as f64, *range.end() as f64);
        problems.add_with_help(
            item.span,
            format!("{} is not a whole number from {least} to {most}", spell(x.value)),
            format!("write for instance {}", spell(nearest)),
        );
    }
    found.map(|n| Spanned::new(n, item.span))
}

/// 2⁵³: from here on, rounding to 53 bits may give another whole number than was meant.
const TOO_LONG: f64 = 9_007_199_254_740_992.0;

/// A whole number from 0 to 2⁶⁴ − 1.
pub fn seed(item: &Item, problems: &mut Problems) -> Option<u64> {
    let exact = match &item.value {
        Value::Integer(n) => u64::try_from(*n).ok(),
        Value::Text(digits) => digits.trim().parse().ok(),
        _ => None,
    };
    if exact.is_some() {
        return exact;
    }
    let x = number(item, problems)?.value;
    if matches!(item.value, Value::Text(_)) && x >= TOO_LONG {
        let help = "write its digits: the value of a formula is rounded to 53 bits";
        problems.add_with_help(item.span, "a seed given by a formula must be below 2^53", help);
        return None;
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within range: just checked")]
    let seed = (x % 1.0 == 0.0 && (0.0..18_446_744_073_709_551_616.0).contains(&x)).then_some(x as u64);
    if seed.is_none() {
        problems.add(item.span, "a seed is a whole number from 0 to 18446744073709551615");
    }
    seed
}

/// A vector or a point: an array of `dimension` coordinates.
pub fn vector(item: &Item, dimension: usize, problems: &mut Problems) -> Option<Spanned<Vec<f64>>> {
    array(item, dimension, real, &format!("[{}1]", "0, ".repeat(dimension.saturating_sub(1))), problems)
}

/// An array of so many lengths.
pub fn lengths(item: &Item, count: usize, problems: &mut Problems) -> Option<Spanned<Vec<f64>>> {
    array(item, count, positive, &format!("[{}]", vec!["1"; count].join(", ")), problems)
}

/// An array of exactly `count` numbers, each read by `read`; `example` shows one.
pub fn array(
    item: &Item,
    count: usize,
    read: fn(&Item, &mut Problems) -> Option<Spanned<f64>>,
    example: &str,
    problems: &mut Problems,
) -> Option<Spanned<Vec<f64>>> {
    let help = format!("write {count} numbers, for instance {example}");
    let Value::List(items) = &item.value else {
        let what = format!("expected an array of {count} numbers, found {}", item.value.kind());
        problems.add_with_help(item.span, what, help);
        return None;
    };
    let read: Vec<_> = items.iter().map(|item| read(item, problems)).collect();
    if items.len() != count {
        problems.add_with_help(item.span, format!("expected {count} numbers, found {}", items.len()), help);
        return None;
    }
    let values: Option<Vec<f64>> = read.into_iter().map(|x| x.map(|x| x.value)).collect();
    values.map(|values| Spanned::new(values, item.span))
}

/// A number as people write it: `0.25`, `1e-7`.
pub fn spell(x: f64) -> String {
    format!("{x:?}").trim_end_matches(".0").into()
}
