//! An input file and places in it.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{Diagnostic, with_file_meant};

/// Longest accepted file (bytes): no real input is longer, whereas endless ones such as `/dev/zero`
/// are.
const LONGEST: u64 = 1 << 30;

/// Stands for standard input in place of a path.
pub const STANDARD_INPUT: &str = "-";

/// The text of an input file under the name the user gave. Cheap to clone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    name: Arc<str>,
    /// The name as the system has it, which need not be Unicode.
    path: Arc<Path>,
    text: Arc<str>,
}

impl Source {
    /// A source from a text already in memory.
    pub fn new(name: &str, text: &str) -> Self {
        Self { name: name.into(), path: Path::new(name).into(), text: text.into() }
    }

    /// Reads a file, or standard input where the path is `-`; files beside that are those of the current folder.
    ///
    /// # Errors
    /// The file cannot be read, is longer than a gibibyte, or is not UTF-8.
    pub fn read(path: &Path) -> Result<Self, Box<Diagnostic>> {
        let is_standard = path == Path::new(STANDARD_INPUT);
        let name = if is_standard { "standard input".into() } else { path.display().to_string() };
        let bytes = if is_standard { up_to(LONGEST, io::stdin()) } else { bytes_of(path) };
        let bytes = bytes.map_err(|error| {
            let diagnostic = Diagnostic::of_file(&name, format!("cannot read it: {error}"));
            Box::new(with_file_meant(diagnostic, &error, path))
        })?;
        Ok(Self { path: path.into(), ..Self::from_bytes(&name, &bytes)? })
    }

    /// A source from the bytes of a file.
    ///
    /// # Errors
    /// The bytes are not UTF-8.
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, Box<Diagnostic>> {
        match std::str::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, text)),
            Err(error) => {
                let readable = Self::new(name, &String::from_utf8_lossy(bytes));
                let at = error.valid_up_to();
                let what = format!("the byte 0x{:02X} is not UTF-8 text", bytes[at]);
                Err(Box::new(readable.diagnostic(Span::new(at, at + 1), what).with_help("save the file as UTF-8")))
            }
        }
    }

    /// The name the user gave, usually a path.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The path that the user gave.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A file of this name beside the source.
    pub fn beside(&self, file: &str) -> PathBuf {
        self.path.with_file_name(file)
    }

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text in a span.
    pub fn slice(&self, span: Span) -> &str {
        self.text.get(span.start..span.end).unwrap_or("")
    }

    /// An error that points at a place in this source.
    pub fn diagnostic(&self, span: Span, what: impl Into<String>) -> Diagnostic {
        Diagnostic::at(self, span, what.into())
    }
}

/// The bytes of an input file.
///
/// # Errors
/// It cannot be read, or is longer than a gibibyte.
pub(crate) fn bytes_of(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    // known before it is read, unless it is endless
    if file.metadata()?.len() > LONGEST { Err(too_long(LONGEST)) } else { up_to(LONGEST, file) }
}

fn too_long(longest: u64) -> io::Error {
    io::Error::new(io::ErrorKind::FileTooLarge, format!("it is longer than {longest} bytes"))
}

/// All that can be read, if it is not longer than this.
fn up_to(longest: u64, from: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = vec![];
    if from.take(longest + 1).read_to_end(&mut bytes)? as u64 > longest {
        return Err(too_long(longest));
    }
    Ok(bytes)
}

/// A range of bytes of a source.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// The bytes from `start` up to but not including `end`.
    pub const fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// The smallest span that contains both.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        Self::new(self.start.min(other.start), self.end.max(other.end))
    }
}

impl From<std::ops::Range<usize>> for Span {
    fn from(range: std::ops::Range<usize>) -> Self {
        Self::new(range.start, range.end)
    }
}

/// A value and its place in the source.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Where it was written.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// A value at a place.
    pub const fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }

    /// The same place with another value.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Spanned<U> {
        Spanned::new(f(self.value), self.span)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_whole_or_found_too_long() {
        let path = std::env::temp_dir().join(format!("billiards-source-{}", std::process::id()));
        std::fs::write(&path, b"four").unwrap();
        let [long, short] = [4, 3].map(|longest| up_to(longest, File::open(&path).unwrap()));
        std::fs::remove_file(&path).unwrap();
        assert_eq!(long.unwrap(), b"four");
        assert_eq!(short.unwrap_err().to_string(), "it is longer than 3 bytes");
    }

    #[test]
    #[cfg(unix)]
    fn a_file_without_end_is_too_long() {
        assert!(up_to(1000, File::open("/dev/zero").unwrap()).is_err());
    }
}
