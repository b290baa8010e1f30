//! What is shown: pictures, tables, files for other programs.

pub mod vtu;
