//! TOML into [`Item`]s.

use ::toml::de::{DeInteger, DeTable, DeValue};

use super::{Item, Problems, Span, Spanned, Value};

/// Parses a TOML document. Syntax errors are recorded; `None` means that nothing sensible could be read.
///
/// Duplicate keys are recorded too, and the rest of the document is still returned, so that everything else that is wrong
/// with it can be reported at the same time.
pub fn parse(problems: &mut Problems) -> Option<Item> {
    let source = problems.source().clone();
    let (document, errors) = DeTable::parse_recoverable(source.text());
    let place = |error: &::toml::de::Error| error.span().map_or(Span::default(), Span::from);
    let (duplicates, faults): (Vec<_>, Vec<_>) = errors.iter().partition(|e| e.message().starts_with("duplicate key"));
    // One slip often upsets the lines that follow: of a run of faulty lines, only the first error is helpful.
    let mut last = None;
    for fault in &faults {
        let span = place(fault);
        let between = |last: Span| source.text().get(last.start..span.start);
        if last.replace(span).is_some_and(|last| between(last).is_none_or(|text| text.matches('\n').count() <= 1)) {
            continue;
        }
        let there = source.text().get(span.start..).unwrap_or_default();
        let fault = said(fault.message());
        match mend(fault, there) {
            Some(help) => problems.add_with_help(span, fault, help),
            None => problems.add(span, fault),
        }
    }
    if !faults.is_empty() {
        return None;
    }
    report_duplicates(duplicates.into_iter().map(place), problems);
    let whole = Span::new(0, 0);
    Some(Spanned::new(table(document.into_inner()), whole))
}

/// Records repeated keys, by their places. Under a repeated header they are read as further keys of the first one, which is no
/// mistake of its own.
fn report_duplicates(places: impl Iterator<Item = Span>, problems: &mut Problems) {
    let source = problems.source().clone();
    let text = |from, to| source.text().get(from..to).unwrap_or_default();
    let is_header = |line: &str| line.trim_start().starts_with('[');
    let mut under_repeated = None;
    for span in places {
        if under_repeated.is_some_and(|last| !text(last, span.start).split('\n').skip(1).any(is_header)) {
            under_repeated = Some(span.end);
            continue;
        }
        under_repeated = text(0, span.start).rsplit('\n').next().is_some_and(is_header).then_some(span.end);
        let key = source.slice(span).trim_matches(['"', '\'']);
        problems.add(span, format!("duplicate key \"{key}\""));
    }
}

/// The parser's message. It takes a word that begins with n, i, t or f for a misspelt `nan`, `inf`, `true` or `false`.
fn said(fault: &str) -> &str {
    let is_of_word = ["invalid float, expected `", "invalid boolean"].iter().any(|of_word| fault.starts_with(of_word));
    if is_of_word { "string values must be quoted" } else { fault }
}

/// How to fix a number that is invalid in TOML, from the parser's message and the text at that place.
fn mend(fault: &str, there: &str) -> Option<&'static str> {
    let says = |beginning| fault.starts_with(beginning);
    if says("string values must be quoted") {
        Some(r#"write texts and expressions in quotes, as in "no-slip" or "sqrt(2)/2""#)
    } else if says("invalid mantissa") || says("invalid fraction") {
        Some("write digits before and after the point, as in 0.5 or 2.0")
    } else if says("unexpected leading zero") {
        Some("write the number without zeros in front")
    } else if says("unexpected key or value") && there.starts_with(',') {
        Some("write a point before the decimals, as in 0.5, and a list in brackets, as in [1, 0]")
    } else if says("invalid key-value pair") && there.starts_with('{') {
        Some("this file is read as TOML, not as JSON: write key = value on lines without braces around them")
    } else {
        None
    }
}

fn table(table: DeTable<'_>) -> Value {
    let entry = |(key, value): (::toml::Spanned<_>, _)| {
        let span = key.span().into();
        let name: std::borrow::Cow<'_, str> = key.into_inner();
        (Spanned::new(name.into_owned(), span), item(value))
    };
    Value::Table(table.into_iter().map(entry).collect())
}

fn item(value: ::toml::Spanned<DeValue<'_>>) -> Item {
    let span = value.span().into();
    let value = match value.into_inner() {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(integer) => whole(&integer),
        DeValue::Float(float) => Value::Float(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(boolean) => Value::Boolean(boolean),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(items) => Value::List(items.into_iter().map(item).collect()),
        DeValue::Table(entries) => table(entries),
    };
    Spanned::new(value, span)
}

/// An integer; beyond 128 bits the nearest double.
fn whole(integer: &DeInteger<'_>) -> Value {
    match i128::from_str_radix(integer.as_str(), integer.radix()) {
        Ok(n) => Value::Integer(n),
        Err(_) if integer.radix() == 10 => Value::Float(integer.as_str().parse().unwrap_or(f64::NAN)),
        Err(_) => Value::Float(nearest(integer.as_str(), integer.radix())),
    }
}

/// The double nearest to a whole number, written with a power of two for a radix.
fn nearest(digits: &str, radix: u32) -> f64 {
    let bits = radix.trailing_zeros();
    let (mut leading, mut left) = (0_u128, 0_i32);
    for digit in digits.chars().filter_map(|digit| digit.to_digit(radix)) {
        if leading >> 120 == 0 {
            leading = leading << bits | u128::from(digit);
        } else {
            // far beyond the digits of a double: these only matter as a non-zero remainder
            leading |= u128::from(digit != 0);
            left = left.saturating_add_unsigned(bits);
        }
    }
    libm::ldexp(leading as f64, left)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Source;

    fn value(number: &str) -> Value {
        let mut problems = Problems::new(&Source::new("x.toml", &format!("a = {number}")));
        let Some(Value::Table(mut entries)) = parse(&mut problems).map(|item| item.value) else { panic!("{number}") };
        entries.remove(0).1.value
    }

    #[test]
    fn a_number_as_other_languages_write_it_is_told_how_to_be_written() {
        for (number, mend) in [
            ("1/2", "in quotes"),
            ("sqrt(2)", "in quotes"),
            (".5", "before and after the point"),
            ("-.5", "before and after the point"),
            ("5.", "before and after the point"),
            ("[1, .5]", "before and after the point"),
            ("01", "without zeros"),
            ("0,5", "a point before the decimals"),
        ] {
            let mut problems = Problems::new(&Source::new("x.toml", &format!("a = {number}\n")));
            assert!(parse(&mut problems).is_none(), "{number}");
            let help = problems.into_diagnostics().swap_remove(0).help.unwrap_or_default();
            assert!(help.contains(mend), "{number}: {help}");
        }
    }

    #[test]
    fn a_word_without_quotes_is_told_to_be_quoted_whatever_letter_it_begins_with() {
        for word in ["no-slip", "npy", "inside", "isosceles", "triangle", "truth", "flower", "specular", "-nobody"] {
            let mut problems = Problems::new(&Source::new("x.toml", &format!("a = {word}\n")));
            assert!(parse(&mut problems).is_none(), "{word}");
            let fault = problems.into_diagnostics().swap_remove(0);
            assert!(fault.what.starts_with("string values must be quoted"), "{word}: {}", fault.what);
            assert!(fault.help.unwrap_or_default().contains("in quotes"), "{word}");
        }
        for (number, mend) in [("1.5.2", None), ("nan", None)] {
            let mut problems = Problems::new(&Source::new("x.toml", &format!("a = {number}\n")));
            parse(&mut problems);
            assert_eq!(problems.into_diagnostics().first().and_then(|fault| fault.help.as_deref()), mend, "{number}");
        }
    }

    #[test]
    fn a_repeated_key_is_told_without_its_quotes_and_a_repeated_header_once() {
        let told = |text: &str| {
            let mut problems = Problems::new(&Source::new("x.toml", text));
            parse(&mut problems).unwrap();
            let told = problems.into_diagnostics();
            told.into_iter().map(|told| format!("{}: {}", told.place().unwrap().line, told.what)).collect::<Vec<_>>()
        };
        let keys = "a = 1\n\"a\" = 2\n'a' = 3\n\"b c\" = 4\n\"b c\" = 5\n";
        let of = |line: u32, key: &str| format!("{line}: duplicate key \"{key}\"");
        assert_eq!(told(keys), [of(2, "a"), of(3, "a"), of(5, "b c")]);
        let tables = "[t]\na = 1\nb = [\n[2]]\n[ t ] # again\na = 3\nb = 4\n\n[u]\nc = 5\nc = 6\n[t]\na = 7\n[t]\n";
        assert_eq!(told(tables), [of(5, "t"), of(11, "c"), of(12, "t"), of(14, "t")]);
    }

    #[test]
    fn of_a_run_of_faulty_lines_the_first_is_reported() {
        let (good, faulty) = ("\"\u{3b3}\u{b2}\" = 1\r\n", "a = .5 # \u{3b3}\r\n");
        let text = format!("{good}{}{good}{faulty}{}{}", faulty.repeat(3), good.repeat(1000), faulty.trim_end());
        let mut problems = Problems::new(&Source::new("x.toml", &text));
        assert!(parse(&mut problems).is_none());
        let lines = problems.into_diagnostics().iter().map(|fault| fault.place().unwrap().line).collect::<Vec<_>>();
        assert_eq!(lines, [2, 6, 1007]);
    }

    #[test]
    fn whole_numbers_beyond_128_bits_are_the_nearest_double_in_every_radix() {
        let zeros = "0".repeat(32);
        let power = |n: i32| libm::ldexp(1.0, n);
        for (number, x) in [
            (format!("0x1{zeros}"), power(128)),
            (format!("0x{}", "f".repeat(34)), power(136)),
            (format!("-1{zeros}0000000"), -1e39),
            (format!("0o1{zeros}{zeros}"), power(192)),
            (format!("0b1{zeros}{zeros}{zeros}{zeros}{zeros}"), power(160)),
            // half an ulp above, and a bit more
            (format!("0x10000_0000_0000_08{zeros}"), power(128 + 56)),
            (format!("0x10000_0000_0000_08{zeros}1"), power(132 + 56) * (1.0 + f64::EPSILON)),
            (format!("0x1{}", "0".repeat(400)), f64::INFINITY),
        ] {
            assert_eq!(value(&number), Value::Float(x), "{number}");
        }
        assert_eq!(value("0x7fff_ffff_ffff_ffff_ffff_ffff_ffff_ffff"), Value::Integer(i128::MAX));
    }
}
