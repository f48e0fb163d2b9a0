//! Reading a table key by key, so that no key goes unnoticed.

use super::{Item, Problems, Span, Spanned, Value};
use crate::spelling;

/// A table of an input file while it is read.
///
/// Every key that is requested counts as known; [`finish`](Self::finish) then reports unknown keys in the file, and missing
/// ones.
#[derive(Debug)]
pub struct Section<'a> {
    name: String,
    span: Span,
    entries: &'a [(Spanned<String>, Item)],
    known: Vec<&'a str>,
    missing: Vec<Missing<'a>>,
}

/// A missing key, unless a misspelt one turns out to stand for it.
#[derive(Debug)]
struct Missing<'a> {
    keys: Vec<&'a str>,
    what: String,
    help: String,
}

impl<'a> Section<'a> {
    /// Starts to read a table with its own header, such as `[[orbit]]`, which is its name in messages. Anything else is recorded
    /// as an error.
    pub fn new(item: &'a Item, name: &str, problems: &mut Problems) -> Option<Self> {
        Self::read(item, name, format!("write {name} on a line of its own, and its keys below"), problems)
    }

    /// The same for a table within braces; `example` shows one.
    pub fn inline(item: &'a Item, name: &str, example: &str, problems: &mut Problems) -> Option<Self> {
        Self::read(item, name, format!("write for instance {example}"), problems)
    }

    fn read(item: &'a Item, name: &str, help: String, problems: &mut Problems) -> Option<Self> {
        match &item.value {
            Value::Table(entries) => {
                Some(Self { name: name.into(), span: item.span, entries, known: Vec::new(), missing: Vec::new() })
            }
            other => {
                problems.add_with_help(item.span, format!("{name} must be a table, found {}", other.kind()), help);
                None
            }
        }
    }

    /// The name of this table in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where the table stands: its header, or its braces.
    pub fn span(&self) -> Span {
        self.span
    }

    /// The value of a key that may be absent.
    pub fn optional(&mut self, key: &'a str) -> Option<&'a Item> {
        if !self.known.contains(&key) {
            self.known.push(key);
        }
        self.entries.iter().find(|(k, _)| k.value == key).map(|(_, item)| item)
    }

    /// The value of a key that must be there; `example` shows how to write it.
    pub fn required(&mut self, key: &'a str, example: &str) -> Option<&'a Item> {
        let found = self.optional(key);
        if found.is_none() {
            self.missing.push(Missing {
                keys: vec![key],
                what: format!("{} lacks the key \"{key}\"", self.name),
                help: format!("write for instance {example}"),
            });
        }
        found
    }

    /// The one present of several keys of which exactly one must be given, and its name; `example` shows how to write one.
    pub fn one_of(&mut self, keys: &[&'a str], example: &str, problems: &mut Problems) -> Option<(&'a str, &'a Item)> {
        let found = self.at_most_one_of(keys, problems);
        let any = self.entries.iter().any(|(k, _)| keys.contains(&k.value.as_str()));
        if !any {
            let what = format!("{} needs {}", self.name, alternatives(keys, "or"));
            let help = format!("write for instance {example}");
            self.missing.push(Missing { keys: keys.to_vec(), what, help });
        }
        found
    }

    /// The one present of several keys of which at most one may be given, and its name.
    pub fn at_most_one_of(&mut self, keys: &[&'a str], problems: &mut Problems) -> Option<(&'a str, &'a Item)> {
        let present: Vec<_> = keys.iter().filter_map(|&key| Some((key, self.optional(key)?))).collect();
        if present.len() > 1 {
            let names: Vec<_> = present.iter().map(|p| p.0).collect();
            let both = if names.len() == 2 { "both " } else { "" };
            let what = format!("{} has {both}{}", self.name, alternatives(&names, "and"));
            let later = self.entries.iter().map(|(k, _)| k).filter(|k| names.contains(&k.value.as_str()));
            let span = later.map(|k| k.span).max().unwrap_or(self.span);
            problems.add_with_help(span, what, "keep one of them");
            return None;
        }
        present.first().copied()
    }

    /// The entries not requested so far, for tables with free keys.
    pub fn others(&self) -> impl Iterator<Item = &'a (Spanned<String>, Item)> {
        self.entries.iter().filter(|(k, _)| !self.known.contains(&k.value.as_str()))
    }

    /// Reports unknown keys and missing ones.
    pub fn finish(self, problems: &mut Problems) {
        self.report(true, problems);
    }

    /// Reports missing keys, and unknown ones only where they look like a known one: for a table whose possible keys are hidden
    /// by an earlier mistake.
    pub fn finish_leniently(self, problems: &mut Problems) {
        self.report(false, problems);
    }

    fn report(self, strict: bool, problems: &mut Problems) {
        let unknown: Vec<_> = self.others().map(|(key, _)| key).collect();
        let mut mended = Vec::new();
        let absent = |k: &&str| self.entries.iter().all(|(e, _)| e.value != *k);
        let absent: Vec<&str> = self.known.iter().copied().filter(absent).collect();
        for key in unknown {
            // A misspelt key most likely stands for one that is missing.
            let near = spelling::closest(&key.value, absent.iter().copied())
                .or_else(|| spelling::closest(&key.value, self.known.iter().copied()));
            let what = format!("unknown key \"{}\" in {}", key.value, self.name);
            let help = match near {
                Some(near) => {
                    mended.push(near);
                    format!("did you mean \"{near}\"?")
                }
                None if strict => format!("known keys: {}", self.known.join(", ")),
                None => continue,
            };
            problems.add_stray(key.span, &key.value, what, help);
        }
        // only tables with a header of their own: a key cannot be moved to a curve or an edge
        if self.name.starts_with('[') {
            problems.learn(format!("under {}", self.name), &self.known);
        }
        for Missing { keys, what, help } in self.missing {
            if keys.iter().any(|key| mended.contains(key)) {
                continue;
            }
            problems.add_with_help(self.span, what, help);
        }
    }
}

/// `"a", "b" or "c"`.
fn alternatives(keys: &[&str], conjunction: &str) -> String {
    let quoted: Vec<_> = keys.iter().map(|key| format!("\"{key}\"")).collect();
    match &quoted[..] {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} {conjunction} {last}", first.join(", ")),
    }
}
