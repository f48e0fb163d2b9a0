//! JSON into [`Item`]s: a parser that knows lines and columns, duplicate keys and a depth limit.

use super::{Item, Problems, Source, Span, Spanned, Value};

/// Deepest accepted nesting.
const MAX_LEVELS: usize = 80;

/// Parses a JSON document (RFC 8259). The first syntax error is recorded, and then nothing is returned; duplicate keys
/// are recorded and the document is still returned.
pub fn parse(problems: &mut Problems) -> Option<Item> {
    let source = problems.source().clone();
    let mut parser = Parser { source: &source, at: 0, levels: 0, duplicates: Vec::new() };
    let parsed = parser.document();
    for (name, span) in parser.duplicates {
        problems.add(span, format!("duplicate key \"{name}\""));
    }
    match parsed {
        Ok(item) => Some(item),
        Err((span, what)) => {
            problems.add(span, what);
            None
        }
    }
}

/// Advice with its examples written as in JSON.
///
/// ```
/// use billiards_cli::document::in_json;
/// assert_eq!(in_json("write for instance pre = [{ v = [0, -1] }]"), "write for instance \"pre\": [{ \"v\": [0, -1] }]");
/// ```
pub fn in_json(advice: &str) -> String {
    let mut parts = advice.split(" = ");
    let mut text = String::from(parts.next().unwrap_or_default());
    for part in parts {
        let is_of_key = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let key = text.trim_end_matches(is_of_key).len();
        text = format!("{}\"{}\": {part}", &text[..key], &text[key..]);
    }
    text
}

type Fault = (Span, String);

#[derive(Debug)]
struct Parser<'a> {
    source: &'a Source,
    at: usize,
    levels: usize,
    duplicates: Vec<(String, Span)>,
}

impl Parser<'_> {
    fn rest(&self) -> &[u8] {
        &self.source.text().as_bytes()[self.at..]
    }

    fn peek(&self) -> Option<u8> {
        self.rest().first().copied()
    }

    fn skip_space(&mut self) {
        self.at += self.rest().iter().take_while(|b| b" \t\r\n".contains(b)).count();
    }

    fn accept(&mut self, byte: u8) -> bool {
        let found = self.peek() == Some(byte);
        self.at += usize::from(found);
        found
    }

    fn fault<T>(&self, expected: &str) -> Result<T, Fault> {
        let found = match self.source.text()[self.at..].chars().next() {
            Some(c) => format!("{c:?}"),
            None => "the end of the file".into(),
        };
        Err((Span::new(self.at, self.at + 1), format!("expected {expected}, found {found}")))
    }

    fn document(&mut self) -> Result<Item, Fault> {
        if self.source.text().starts_with('\u{feff}') {
            self.at = '\u{feff}'.len_utf8();
        }
        let item = self.item()?;
        self.skip_space();
        if self.peek().is_some() { self.fault("the end of the file") } else { Ok(item) }
    }

    fn item(&mut self) -> Result<Item, Fault> {
        self.skip_space();
        let start = self.at;
        let value = match self.peek() {
            Some(b'{') => self.nested(Self::table)?,
            Some(b'[') => self.nested(Self::list)?,
            Some(b'"') => Value::Text(self.text()?),
            Some(b'-' | b'0'..=b'9') => self.number()?,
            _ => self.word()?,
        };
        Ok(Spanned::new(value, Span::new(start, self.at)))
    }

    fn nested(&mut self, read: fn(&mut Self) -> Result<Value, Fault>) -> Result<Value, Fault> {
        if self.levels == MAX_LEVELS {
            return Err((Span::new(self.at, self.at + 1), format!("more than {MAX_LEVELS} levels of nesting")));
        }
        self.at += 1;
        self.levels += 1;
        let value = read(self);
        self.levels -= 1;
        value
    }

    fn list(&mut self) -> Result<Value, Fault> {
        let mut items = Vec::new();
        self.skip_space();
        if self.accept(b']') {
            return Ok(Value::List(items));
        }
        loop {
            items.push(self.item()?);
            self.skip_space();
            if self.accept(b']') {
                return Ok(Value::List(items));
            }
            if !self.accept(b',') {
                return self.fault("\",\" or \"]\"");
            }
        }
    }

    fn table(&mut self) -> Result<Value, Fault> {
        let mut entries: Vec<(Spanned<String>, Item)> = Vec::new();
        self.skip_space();
        if self.accept(b'}') {
            return Ok(Value::Table(entries));
        }
        loop {
            self.skip_space();
            let start = self.at;
            if self.peek() != Some(b'"') {
                return self.fault("a key in double quotes");
            }
            let name = self.text()?;
            let key = Spanned::new(name, Span::new(start, self.at));
            self.skip_space();
            if !self.accept(b':') {
                return self.fault("\":\"");
            }
            let item = self.item()?;
            if entries.iter().any(|(known, _)| known.value == key.value) {
                self.duplicates.push((key.value, key.span));
            } else {
                entries.push((key, item));
            }
            self.skip_space();
            if self.accept(b'}') {
                return Ok(Value::Table(entries));
            }
            if !self.accept(b',') {
                return self.fault("\",\" or \"}\"");
            }
        }
    }

    fn word(&mut self) -> Result<Value, Fault> {
        for (word, value) in [("true", Value::Boolean(true)), ("false", Value::Boolean(false)), ("null", Value::Null)] {
            if self.rest().starts_with(word.as_bytes()) {
                self.at += word.len();
                return Ok(value);
            }
        }
        self.fault("a value")
    }

    fn number(&mut self) -> Result<Value, Fault> {
        let start = self.at;
        let length = self.rest().iter().take_while(|b| b.is_ascii_digit() || b"+-.eE".contains(b)).count();
        self.at += length;
        let literal = &self.source.text()[start..self.at];
        let digits = literal.strip_prefix('-').unwrap_or(literal).as_bytes();
        // What Rust reads beyond JSON's grammar: leading zeros, a leading or trailing point.
        let well_formed = digits.first().is_some_and(u8::is_ascii_digit)
            && !(digits[0] == b'0' && digits.get(1).is_some_and(u8::is_ascii_digit))
            && literal.split('.').skip(1).all(|tail| tail.as_bytes().first().is_some_and(u8::is_ascii_digit));
        let value = literal.parse().map(Value::Integer).or_else(|_| literal.parse().map(Value::Float));
        match value {
            Ok(value) if well_formed => Ok(value),
            _ => Err((Span::new(start, self.at), format!("{literal} is not a number"))),
        }
    }

    /// The string that starts here, quotes included.
    fn text(&mut self) -> Result<String, Fault> {
        let start = self.at;
        let mut escaped = false;
        let length = self.rest()[1..].iter().position(|&b| {
            let end = b == b'"' && !escaped;
            escaped = b == b'\\' && !escaped;
            end || b == b'\n'
        });
        let Some(length) = length.filter(|n| self.rest()[n + 1] == b'"') else {
            return Err((Span::new(start, start + 1), "this string is never closed".into()));
        };
        self.at += length + 2;
        let span = Span::new(start, self.at);
        serde_json::from_str(self.source.slice(span)).map_err(|_| (span, "not a valid JSON string".into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<Value, String> {
        let mut problems = Problems::new(&Source::new("x.json", text));
        let item = parse(&mut problems);
        match problems.into_diagnostics().first() {
            None => Ok(item.unwrap().value),
            Some(d) => Err(format!("{}: {}", d.place().map_or(0, |p| p.column), d.what)),
        }
    }

    #[test]
    fn documents_are_read() {
        let Ok(Value::Table(entries)) = read(r#" {"a": [1, -2.5e1, "x\u00e9\"", true, null], "b": {}} "#) else {
            panic!()
        };
        let Value::List(items) = &entries[0].1.value else { panic!() };
        let values: Vec<_> = items.iter().map(|i| i.value.clone()).collect();
        assert_eq!(
            values,
            [
                Value::Integer(1),
                Value::Float(-25.0),
                Value::Text("x\u{e9}\"".into()),
                Value::Boolean(true),
                Value::Null
            ]
        );
    }

    #[test]
    fn syntax_errors_name_their_column() {
        for (text, expected) in [
            ("[1, 2", "6: expected \",\" or \"]\", found the end of the file"),
            ("{a: 1}", "2: expected a key in double quotes, found 'a'"),
            ("[01]", "2: 01 is not a number"),
            ("[1.]", "2: 1. is not a number"),
            ("[nan]", "2: expected a value, found 'n'"),
            ("[\"x]", "2: this string is never closed"),
            ("[\"\\q\"]", "2: not a valid JSON string"),
            ("{\"a\":1,\"a\":2}", "8: duplicate key \"a\""),
            ("1 2", "3: expected the end of the file, found '2'"),
            ("", "1: expected a value, found the end of the file"),
        ] {
            assert_eq!(read(text), Err(expected.into()), "{text}");
        }
        assert!(read(&"[".repeat(100_000)).unwrap_err().contains("levels"));
    }

    proptest! {
        #[test]
        fn every_document_reads_as_serde_json_reads_it(text in r#"[\[\]{}:,"a1.e\-+ \\u0]{0,12}"#) {
            let theirs = serde_json::from_str::<serde_json::Value>(&text);
            let ours = read(&text);
            let lenient = ours.as_ref().is_err_and(|e| e.contains("duplicate"));
            // serde_json refuses numbers beyond the range of a double; our number reader does that later.
            let huge = theirs.as_ref().is_err_and(|e| e.to_string().contains("out of range"));
            prop_assert!(lenient || huge || theirs.is_ok() == ours.is_ok(), "{:?} {:?}", theirs, ours);
        }
    }
}
