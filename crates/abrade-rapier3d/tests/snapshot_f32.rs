//! Worlds to bytes and back, in f32.

use abrade_rapier3d as plugin;

mod snapshot;
