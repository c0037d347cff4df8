//! Worlds to bytes and back, in f64.

use abrade_rapier3d_f64 as plugin;

mod snapshot;
