//! Whatever is no scene file is refused, and nothing panics.

use super::{BOUNDARY, NAMED, SPATIAL, parse};
use billiards_cli::document::Source;
use billiards_cli::scene::{Request, Scene};
use proptest::prelude::*;

#[test]
fn dotted_keys_and_brackets_nested_without_end_are_refused() {
    let n = 200_000;
    for text in [
        format!("{}b = 1", "a.".repeat(n)),
        format!("[{}a]", "a.".repeat(n)),
        format!("a = {}", "[".repeat(n)),
        format!("a = {}1{}", "[".repeat(n), "]".repeat(n)),
        format!("a = {}", "{ b = ".repeat(n)),
        format!("law = \"{}\"", "x".repeat(n)),
    ] {
        assert!(parse(&text).is_err());
    }
}

/// One change to a text: replace `length` bytes at a place by something else.
fn mutate(text: &str, changes: &[(usize, usize, String)]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (at, length, new) in changes {
        let at = at % (bytes.len() + 1);
        let end = (at + length).min(bytes.len());
        bytes.splice(at..end, new.bytes());
    }
    bytes
}

proptest! {
    #[test]
    fn no_mutation_of_a_valid_scene_makes_the_reader_panic(
        which in 0..3usize,
        changes in proptest::collection::vec(
            (any::<usize>(), 0..12usize, prop_oneof![
                any::<String>(),
                "[\\[\\]{}=,.\"'\\n #a-z0-9\\-]{0,6}",
                proptest::sample::select(vec!["nan", "inf", "1e999", "-1", "[]", "{}", "[[", "]]", "\"\"", "true", "'''", "1979-05-27",
                    "law", "rough", "loop", "edges", "= 0", "0x10", "9999999999999999999999999999999999999999999"])
                    .prop_map(String::from),
            ]),
            1..4,
        ),
    ) {
        let bytes = mutate([NAMED, BOUNDARY, SPATIAL][which], &changes);
        if let Ok(source) = Source::from_bytes("x.toml", &bytes)
            && let Err(errors) = Scene::parse(&source, &Request::default())
        {
            prop_assert!(!errors.is_empty());
            for error in errors {
                let _ = error.to_string();
            }
        }
    }

    #[test]
    fn no_bytes_make_the_reader_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        if let Ok(source) = Source::from_bytes("x.toml", &bytes) {
            prop_assert!(Scene::parse(&source, &Request::default()).is_err());
        }
    }
}
