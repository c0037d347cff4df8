//! Every contact, at every step, in f32.

use abrade_rapier3d as plugin;

mod contacts;
