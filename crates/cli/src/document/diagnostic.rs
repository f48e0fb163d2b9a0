//! Errors in input files: what is wrong, where, and how to fix it.

use std::fmt;

use super::{Source, Span};

/// Longest part of a source line that is shown, in characters.
const SHOWN: usize = 120;

/// A line and column of a file, and what stands there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The line, or the part of it around the column, without control characters.
    excerpt: String,
    /// Characters of the excerpt before the column.
    indent: usize,
    /// Characters to underline, at least one.
    width: usize,
}

/// One error in an input file.
///
/// Shown as
/// ```text
/// scenes/x.toml:12:1: error: unknown key "velocty" in [[orbit]]
///    12 | velocty = [0.6, 0.8]
///       | ^^^^^^^
/// help: did you mean "velocity"?
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file, as the user named it.
    pub file: String,
    /// What is at fault in the file; absent if all of it is.
    at: Option<(Source, Span)>,
    /// What is wrong, in lower case.
    pub what: String,
    /// How to fix it.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error about a file as a whole.
    pub fn of_file(file: &str, what: impl Into<String>) -> Self {
        Self { file: file.into(), at: None, what: what.into(), help: None }
    }

    pub(super) fn at(source: &Source, span: Span, what: String) -> Self {
        Self { file: source.name().into(), at: Some((source.clone(), span)), what, help: None }
    }

    /// Where in the file; absent if the file as a whole is at fault. The file is read from its beginning for each place: of many errors
    /// only the few that are shown need theirs.
    pub fn place(&self) -> Option<Place> {
        self.at.as_ref().map(|(source, span)| Place::new(source.text(), *span))
    }

    /// Adds advice on how to fix it.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl Place {
    fn new(text: &str, span: Span) -> Self {
        // a byte order mark is not a character of the first line
        let text_start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let start = floor_char_boundary(text, span.start).max(text_start);
        let end = floor_char_boundary(text, span.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(text_start, |i| i + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
        let before = text[line_start..start].chars().count();
        let marked = text[start..end.min(line_end)].chars().count();
        // Of a very long line, show the part around the column.
        let skipped = before.saturating_sub(SHOWN / 2);
        let excerpt: String = text[line_start..line_end].chars().skip(skipped).take(SHOWN).collect();
        let excerpt = plain(&excerpt);
        Self {
            line: 1 + text[..start].matches('\n').count(),
            column: before + 1,
            excerpt: excerpt.trim_end().into(),
            indent: before - skipped,
            width: marked.clamp(1, SHOWN / 2),
        }
    }
}

/// One line of text that is safe to show on a terminal: each control character is replaced by a
/// blank.
///
/// ```
/// assert_eq!(billiards_cli::document::plain("red \u{1b}[31m\nor not"), "red  [31m or not");
/// ```
pub fn plain(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

fn floor_char_boundary(text: &str, mut at: usize) -> usize {
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (file, what) = (plain(&self.file), plain(&self.what));
        match &self.place() {
            None => write!(f, "{file}: error: {what}")?,
            Some(place) => {
                let Place { line, column, excerpt, indent, width } = place;
                writeln!(f, "{file}:{line}:{column}: error: {what}")?;
                writeln!(f, "{line:>5} | {excerpt}")?;
                write!(f, "      | {:indent$}{:^>width$}", "", "")?;
            }
        }
        match &self.help {
            Some(help) => write!(f, "\nhelp: {}", plain(help)),
            None => Ok(()),
        }
    }
}

/// Collects the errors of one file, so that all of them can be shown at once.
#[derive(Clone, Debug)]
pub struct Problems {
    source: Source,
    found: Vec<(Span, Diagnostic)>,
    /// Places of the file, and which keys may stand there.
    homes: Vec<(String, Vec<String>)>,
    /// Which errors are about keys that their table does not have, and the keys.
    strays: Vec<(usize, String)>,
}

impl Problems {
    /// No problems yet.
    pub fn new(source: &Source) -> Self {
        Self { source: source.clone(), found: Vec::new(), homes: Vec::new(), strays: Vec::new() }
    }

    /// The file being read.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Records an error.
    pub fn add(&mut self, span: Span, what: impl Into<String>) {
        self.found.push((span, self.source.diagnostic(span, what)));
    }

    /// Records an error and how to fix it.
    pub fn add_with_help(&mut self, span: Span, what: impl Into<String>, help: impl Into<String>) {
        self.found.push((span, self.source.diagnostic(span, what).with_help(help)));
    }

    /// Records that these keys may stand in this place: `under [run]`.
    pub(crate) fn learn(&mut self, place: impl Into<String>, keys: &[&str]) {
        let place = place.into();
        if !self.homes.iter().any(|home| home.0 == place && home.1 == keys) {
            self.homes.push((place, keys.iter().map(|&key| key.into()).collect()));
        }
    }

    /// Records a key that its table may not have; the help applies if no other place has it either.
    pub(crate) fn add_stray(&mut self, span: Span, key: &str, what: impl Into<String>, help: impl Into<String>) {
        self.strays.push((self.found.len(), key.into()));
        self.add_with_help(span, what, help);
    }

    /// Whether nothing is wrong so far.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// The errors in the order of the file.
    pub fn into_diagnostics(mut self) -> Vec<Diagnostic> {
        for (index, key) in &self.strays {
            let mut places: Vec<&str> = vec![];
            for (place, _) in self.homes.iter().filter(|(_, keys)| keys.contains(key)) {
                if !places.contains(&place.as_str()) {
                    places.push(place);
                }
            }
            if !places.is_empty() {
                let places = places.join(" or ").replace(" or under ", " or ");
                self.found[*index].1.help = Some(format!("\"{key}\" goes {places}"));
            }
        }
        self.found.sort_by_key(|(span, _)| span.start);
        self.found.into_iter().map(|(_, diagnostic)| diagnostic).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagnostic_shows_line_column_caret_and_help() {
        let source = Source::new("x.toml", "a = 1\nvelocty = [0, 1]\n");
        let shown =
            source.diagnostic(Span::new(6, 13), "unknown key").with_help("did you mean \"velocity\"?").to_string();
        assert_eq!(
            shown,
            "x.toml:2:1: error: unknown key\n    2 | velocty = [0, 1]\n      | ^^^^^^^\nhelp: did you mean \"velocity\"?"
        );
    }

    #[test]
    fn columns_count_characters_and_spans_may_lie_anywhere() {
        let source = Source::new("x", "\u{3b3}\u{b2} = \u{1b}\tx");
        let place = source.diagnostic(Span::new(7, 8), "").place().unwrap();
        assert_eq!((place.line, place.column, place.excerpt.as_str()), (1, 6, "\u{3b3}\u{b2} =   x"));
        for start in 0..20 {
            for end in 0..20 {
                let _ = source.diagnostic(Span::new(start, end), "").to_string();
            }
        }
    }

    #[test]
    fn places_are_right_up_to_the_end_of_a_long_file() {
        let line = "\t\u{3b3} = [1,\t2]\r\n";
        let text = format!("\u{feff}{}\u{1d6fe}\u{b2}x", line.repeat(10_000));
        let source = Source::new("x", &text);
        let place = |at: usize| source.diagnostic(Span::new(at, at + 1), "").place().unwrap();
        let of_line = |k: usize| "\u{feff}".len() + k * line.len();
        let two = line.find('2').unwrap();
        for k in [0, 1, 2, 4999, 9998, 9999] {
            for (byte, column) in [(0, 1), (1, 2), (two, 10), (two + 2, 12)] {
                let place = place(of_line(k) + byte);
                assert_eq!((place.line, place.column, place.excerpt.as_str()), (k + 1, column, " \u{3b3} = [1, 2]"));
            }
        }
        for (byte, column) in [(0, 1), (4, 2), (6, 3), (7, 4), (100, 4)] {
            let place = place(of_line(10_000) + byte);
            assert_eq!((place.line, place.column, place.excerpt.as_str()), (10_001, column, "\u{1d6fe}\u{b2}x"));
        }
    }

    #[test]
    fn of_many_equal_sections_the_keys_are_kept_once() {
        let mut problems = Problems::new(&Source::new("x", ""));
        for k in 0..1000 {
            problems.learn("under [[orbit]]", &["position", "velocity"]);
            problems.learn("under [run]", &["collisions", "time"][..=(k % 2)]);
        }
        assert_eq!(problems.homes.len(), 3);
    }

    #[test]
    fn of_a_long_line_the_part_around_the_column_is_shown() {
        let text = "x".repeat(10_000);
        let shown = Source::new("x", &text).diagnostic(Span::new(5000, 5001), "here").to_string();
        assert!(shown.lines().all(|line| line.len() < SHOWN + 20), "{shown}");
    }
}
