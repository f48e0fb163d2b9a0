//! Drawings and meshes beside the scene file.

use billiards::geometry::Error;

use crate::document::{Diagnostic, Spanned, bytes_of, with_file_meant};
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
    let bytes = bytes_of(&path).map_err(|error| {
        let diagnostic = complain(format!("cannot read {}: {error}", path.display()));
        Box::new(with_file_meant(*diagnostic, &error, &path))
    })?;
    reader(&bytes).map_err(|error| {
        let what = if error == Error::Empty { "it contains no walls".into() } else { error.to_string() };
        complain(format!("{}: {what}", path.display()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Source, Span};
    use crate::scene::Request;

    #[test]
    fn a_drawing_longer_than_a_scene_may_be_is_refused() {
        let folder = std::env::temp_dir().join(format!("billiards-drawing-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let scene = "law = \"specular\"\ntable = { name = \"square\" }\nrun = { collisions = 1 }\n[[orbit]]\nposition = [0, 0]\nvelocity = [1, 0]";
        let source = Source::new(&folder.join("x.toml").display().to_string(), scene);
        let scene = Scene::parse(&source, &Request::default()).unwrap();
        let drawing = Spanned::new(String::from("x.svg"), Span::default());
        let length = |of: u64| {
            std::fs::File::create(folder.join("x.svg")).unwrap().set_len(of).unwrap();
            read(&scene, &drawing, "", &[("svg", |bytes| Ok(bytes.len()))])
        };
        let [short, long] = [1000, (1 << 30) + 1].map(length);
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(short.unwrap(), 1000);
        assert!(long.unwrap_err().what.ends_with("it is longer than 1073741824 bytes"));
    }
}
