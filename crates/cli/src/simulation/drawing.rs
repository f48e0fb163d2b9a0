//! Drawings and meshes beside the scene file.

use billiards::geometry::Error;

use crate::document::{Diagnostic, Spanned};
use crate::scene::Scene;

/// What a file holds, by the reader for the ending of its name in small letters; `kinds` says which files there are readers for.
pub(super) fn read<T>(
    scene: &Scene,
    file: &Spanned<String>,
    kinds: &str,
    reader: impl FnOnce(&str, &[u8]) -> Option<Result<T, Error>>,
) -> Result<T, Box<Diagnostic>> {
    let complain = |what: String| Box::new(scene.source.diagnostic(file.span, what));
    let path = scene.source.beside(&file.value);
    let bytes = std::fs::read(&path).map_err(|e| complain(format!("cannot read {}: {e}", path.display())))?;
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match reader(&ending, &bytes) {
        Some(held) => held.map_err(|error| complain(format!("{}: {error}", path.display()))),
        None => Err(complain(kinds.into())),
    }
}
