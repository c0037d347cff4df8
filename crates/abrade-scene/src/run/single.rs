//! The engine in `f32`, what games use.

use abrade_rapier3d as plug;

#[path = "world.rs"]
pub(crate) mod world;
