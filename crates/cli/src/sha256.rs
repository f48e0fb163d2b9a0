//! SHA-256 [FIPS 180-4]: identifies a scene by its content, with the same digest that `sha256sum`
//! prints.
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// The hash of some bytes, in hexadecimal digits.
///
/// ```
/// let abc = billiards_cli::sha256::hex(b"abc");
/// assert_eq!(abc, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
/// ```
pub fn hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}"); // a String takes everything
        text
    })
}
