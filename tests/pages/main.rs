//! What is written about the program holds: commands and figures of the pages, and the layers of the code.

mod layers;
#[cfg(feature = "cli")]
mod pages;
