//! The shared tests of the plug-in, in f32.

use abrade_rapier3d as plugin;

mod coupling;
