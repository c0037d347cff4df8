//! The engine in `f64`.

use abrade_rapier3d_f64 as plug;

#[path = "world.rs"]
pub(crate) mod world;
