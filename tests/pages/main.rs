//! What is written about the program holds: commands and figures of the pages, and the layers of the code. Lines are
//! short.

mod layers;
mod lines;
#[cfg(feature = "cli")]
mod pages;
