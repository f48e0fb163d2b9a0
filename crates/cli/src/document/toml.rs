//! TOML into [`Item`]s.

use ::toml::de::{DeInteger, DeTable, DeValue};

use super::{Item, Problems, Span, Spanned, Value};

/// Parses a TOML document. Syntax errors are recorded; `None` means that nothing sensible could be read.
///
/// Duplicate keys are recorded too, and the rest of the document is still returned, so that all else that is wrong with
/// it can be reported in the same go.
pub fn parse(problems: &mut Problems) -> Option<Item> {
    let source = problems.source().clone();
    let (document, errors) = DeTable::parse_recoverable(source.text());
    let place = |error: &::toml::de::Error| error.span().map_or(Span::default(), Span::from);
    let line = |span: Span| source.text().get(..span.start).map_or(0, |before| before.matches('\n').count());
    let (duplicates, faults): (Vec<_>, Vec<_>) = errors.iter().partition(|e| e.message().starts_with("duplicate key"));
    // One slip often upsets the lines that follow: of a run of lines with faults, the first complaint is the one that helps.
    let mut upset = None;
    for fault in &faults {
        let (span, after) = (place(fault), upset);
        upset = Some(line(span) + 1);
        if after.is_none_or(|after| line(span) > after) {
            problems.add(span, fault.message());
        }
    }
    if !faults.is_empty() {
        return None;
    }
    for duplicate in duplicates {
        let span = place(duplicate);
        problems.add(span, format!("duplicate key \"{}\"", source.slice(span)));
    }
    let whole = Span::new(0, 0);
    Some(Spanned::new(table(document.into_inner()), whole))
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
        Err(_) => Value::Float(integer.as_str().parse().unwrap_or(f64::NAN)),
    }
}
