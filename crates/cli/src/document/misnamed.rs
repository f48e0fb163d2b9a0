//! Files that are not there under the name the user gave.

use std::io;
use std::path::Path;

use super::Diagnostic;
use crate::spelling::closest;
use crate::whole_file::folder_of;

/// Adds the name of the file that may have been meant to the error that another one could not be read.
pub fn with_file_meant(diagnostic: Diagnostic, error: &io::Error, path: &Path) -> Diagnostic {
    match meant(path).filter(|_| error.kind() == io::ErrorKind::NotFound) {
        Some(file) => diagnostic.with_help(format!("did you mean \"{file}\"?")),
        None => diagnostic,
    }
}

/// The file in the same folder whose name differs from this one only by its extension, or else only
/// slightly.
fn meant(path: &Path) -> Option<String> {
    let files = folder_of(path).read_dir().ok()?.filter_map(Result::ok).filter(|entry| !entry.path().is_dir());
    let mut names: Vec<_> = files.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    let stem = path.file_stem()?;
    let same = names.iter().find(|name| Path::new(name).file_stem() == Some(stem)).map(String::as_str);
    let name = same.or_else(|| closest(path.file_name()?.to_str()?, names.iter().map(String::as_str)))?;
    Some(path.with_file_name(name).display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_of_another_ending_or_the_nearest_name_is_meant() {
        let folder = std::env::temp_dir().join(format!("billiards-misnamed-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("hexagons.toml")).unwrap();
        for name in ["hexagon.toml", "square.toml", "stella.obj"] {
            std::fs::write(folder.join(name), "").unwrap();
        }
        let found = |name: &str| meant(&folder.join(name));
        let told = ["hexgon.toml", "hexagon", "square.json", "Square.toml", "stela.obj", "zebra.toml"].map(found);
        let nowhere = meant(&folder.join("scenes/square.toml"));
        std::fs::remove_dir_all(&folder).unwrap();
        let file = |name: &str| Some(folder.join(name).display().to_string());
        let [hexagon, square] = ["hexagon.toml", "square.toml"].map(file);
        assert_eq!(told, [hexagon.clone(), hexagon, square.clone(), square, file("stella.obj"), None]);
        assert_eq!(nowhere, None);
    }
}
