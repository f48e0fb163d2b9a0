//! The command `billiards`: scene files in, pictures, records and reports out. No physics lives here but in `bench`, which
//! compares the engine with a program as in textbooks.

#![cfg_attr(test, allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests claim exact values"))]

pub mod args;
pub mod bench;
pub mod commands;
pub mod contact_file;
pub mod document;
pub mod expression;
pub mod npy;
pub mod picture;
pub mod record;
pub mod reproduce;
pub mod scene;
pub mod sha256;
#[cfg(unix)]
pub mod signals;
pub mod simulation;
pub mod spelling;
pub mod whole_file;
