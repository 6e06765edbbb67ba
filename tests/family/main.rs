//! Every family against independent oracles, published numbers and reference data; and what places its curves in the
//! user's plane.

mod any_spiral;
mod blocks;
mod boxes;
mod cubic_oracle;
mod cubic_properties;
mod cubic_region;
mod cubic_vectors;
#[cfg(target_arch = "x86_64")]
mod ieee;
mod oracle;
mod ph_oracle;
mod ph_path;
mod ph_path_region;
mod ph_region;
mod ph_vectors;
mod question;
mod reach_oracle;
mod reach_region;
mod reach_vectors;
mod transition;
mod trig_oracle;
mod trig_region;
mod trig_vectors;
