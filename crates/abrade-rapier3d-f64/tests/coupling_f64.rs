//! The shared tests of the plug-in, in f64.

use abrade_rapier3d_f64 as plugin;

mod coupling;
