//! The command `billiards`.
fn main() {}
