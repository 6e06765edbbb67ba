//! Atlases from recipe to picture: the file, the pipeline that fills it, recipes, pictures, and those that are shipped.

mod cells;
#[cfg(feature = "cli")]
mod crude;
mod file;
mod outline;
#[cfg(feature = "cli")]
mod panels;
mod pipeline;
#[cfg(feature = "cli")]
mod plot;
#[cfg(feature = "cli")]
mod recipes;
#[cfg(feature = "cli")]
mod shipped;
#[cfg(feature = "cli")]
mod smooth;
