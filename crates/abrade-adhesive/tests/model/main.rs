//! The model against closed forms of continuum mechanics and against itself in the small-step limit.

mod conservation;
mod elasticity;
mod faces;
mod lattice;
mod plasticity;
mod refusals;
mod strength;
