//! Outlines and surfaces from files.

mod drawings;
mod maps;
mod meshes;
mod places;
