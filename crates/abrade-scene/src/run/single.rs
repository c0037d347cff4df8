//! The engine in `f32`, what games use.

use abrade_rapier3d as plug;

#[allow(clippy::duplicate_mod, reason = "one source, two precisions")]
#[path = "world.rs"]
pub(crate) mod world;
