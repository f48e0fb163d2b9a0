//! `NumPy` arrays: the NPY format 1.0, whose data follow a header in text.

/// The header of an array whose elements have the type `kind`, as `NumPy` writes it, such as `'<f8'`, and whose `shape` is a tuple, such
/// as `(3, 4)`. Blanks in either are kept, so that a number in it may be replaced later.
pub fn header(kind: &str, shape: &str) -> Vec<u8> {
    let mut text = format!("{{'descr': {kind}, 'fortran_order': False, 'shape': {shape}, }}");
    // Magic string, version and length take 10 bytes; with them the header is a multiple of 64 long and ends in a newline.
    let unpadded = 10 + text.len() + 1;
    text.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    text.push('\n');
    let length = u16::try_from(text.len()).unwrap_or(u16::MAX);
    [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..], text.as_bytes()].concat()
}
