//! Worlds in `f64`.
#![allow(clippy::duplicate_mod, reason = "one source for both precisions")]

use abrade_rapier3d_f64 as plugin;

#[path = "world.rs"]
mod world;

pub use world::Trial;
