//! Drawings and meshes beside the scene file.

use billiards::geometry::Error;

use crate::document::{Diagnostic, Spanned, with_file_meant};
use crate::scene::Scene;

/// A reader of the bytes of a file.
pub(super) type Reader<T> = fn(&[u8]) -> Result<T, Error>;

/// Reads a file with the reader for its lower-case extension; `kinds` says for which files there are readers.
pub(super) fn read<T>(
    scene: &Scene,
    file: &Spanned<String>,
    kinds: &str,
    readers: &[(&str, Reader<T>)],
) -> Result<T, Box<Diagnostic>> {
    let complain = |what: String| Box::new(scene.source.diagnostic(file.span, what));
    let path = scene.source.beside(&file.value);
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    // checked first: something without a reader need not be a file, and may be endless
    let reader = readers.iter().find(|(of, _)| *of == ending).ok_or_else(|| complain(kinds.into()))?.1;
    let bytes = std::fs::read(&path).map_err(|error| {
        let diagnostic = complain(format!("cannot read {}: {error}", path.display()));
        Box::new(with_file_meant(*diagnostic, &error, &path))
    })?;
    reader(&bytes).map_err(|error| {
        let what = if error == Error::Empty { "it contains no walls".into() } else { error.to_string() };
        complain(format!("{}: {what}", path.display()))
    })
}
