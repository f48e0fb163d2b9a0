//! Files that a run would replace by its own although it reads them.

use std::fs;
use std::path::{Path, PathBuf};

use super::Simulation;
use crate::document::Diagnostic;
use crate::whole_file::folder_of;

impl Simulation {
    /// Every file that the scene reads, itself among them, and a run into this folder would replace.
    pub fn overwritten(&self, folder: &Path) -> Vec<Diagnostic> {
        let written: Vec<PathBuf> = self.outputs(folder).iter().filter_map(|path| place(path)).collect();
        let is_lost = |path: &Path| {
            let places = [place(path), fs::canonicalize(path).ok()];
            places.iter().flatten().any(|place| written.contains(place))
        };
        let source = &self.scene.source;
        let what = "this run would write a file of its own in place of this one, which it reads";
        let scene = is_lost(source.path()).then(|| Diagnostic::of_file(source.name(), what));
        let files = self.scene.table.files().filter(|file| is_lost(&source.beside(&file.value)));
        let lost = scene.into_iter().chain(files.map(|file| source.diagnostic(file.span, what)));
        lost.map(|diagnostic| diagnostic.with_help("name another folder for what is written: --out DIR")).collect()
    }
}

/// Where a file is, whatever the path that leads there; of a link, where the link itself is. `None` where there is nothing.
fn place(path: &Path) -> Option<PathBuf> {
    if path.is_symlink() {
        Some(fs::canonicalize(folder_of(path)).ok()?.join(path.file_name()?))
    } else {
        fs::canonicalize(path).ok()
    }
}
