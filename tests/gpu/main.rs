//! The GPU evaluator: its engine, its arithmetic, its shaders, and its agreement with the CPU.
#![cfg(feature = "gpu")]

#[path = "../adapters/mod.rs"]
mod adapters;
mod agreement;
mod arithmetic;
mod engine;
mod shaders;
