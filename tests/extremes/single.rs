//! Worlds in `f32`.

use abrade_rapier3d as plugin;

#[path = "world.rs"]
mod world;

pub use world::Trial;
