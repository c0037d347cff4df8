//! The engine in `f64`.

use abrade_rapier3d_f64 as plug;

#[allow(clippy::duplicate_mod, reason = "one source, two precisions")]
#[path = "world.rs"]
pub(crate) mod world;
