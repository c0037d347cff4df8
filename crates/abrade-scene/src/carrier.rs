//! The bodies that moving surfaces are on, at the start.

use abrade::{Inertia, State, TriangleMesh};
use nalgebra::{Isometry3, Point3};

use crate::led_path::LedPath;
use crate::scene::SurfaceMotion;

/// The body that a surface moves with. Its axes are those of the surface's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuiltCarrier {
    /// State at the start, in the world.
    pub state: State,
    /// Mass and inertia of a free body; none of a led one.
    pub inertia: Option<Inertia>,
    /// Where the state's position lies in the surface's frame [m]: at the centre of mass of a free
    /// body, at the origin for a led one.
    pub centre_local: Point3<f64>,
}

impl BuiltCarrier {
    /// The carrier of a surface whose frame lies at `pose`; none for one at rest, and for a free
    /// plate. A free body has the mass of `mesh`, a led one the velocity of its `path`.
    pub(crate) fn new(
        motion: &SurfaceMotion,
        pose: &Isometry3<f64>,
        path: Option<&LedPath>,
        mesh: Option<&TriangleMesh>,
    ) -> Option<Self> {
        let (velocity, spin, inertia, centre_local) = match *motion {
            SurfaceMotion::Fixed => return None,
            SurfaceMotion::Kinematic { velocity, spin } => {
                (velocity.into(), spin.into(), None, Point3::origin())
            }
            SurfaceMotion::Reciprocating { .. }
            | SurfaceMotion::Rocking { .. }
            | SurfaceMotion::Path { .. } => {
                let [velocity, spin] = path?.velocity_spin(0.0);
                (velocity, spin, None, Point3::origin())
            }
            SurfaceMotion::Free { density, velocity, spin } => {
                let (inertia, centre) = mesh?.mass_properties(density);
                (velocity.into(), spin.into(), Some(inertia), centre)
            }
        };
        let state =
            State { position: pose * centre_local, rotation: pose.rotation, velocity, spin };
        Some(Self { state, inertia, centre_local })
    }

    /// Where the surface's frame lies in the world when the body is in `state`.
    pub fn frame(&self, state: &State) -> Isometry3<f64> {
        state.pose() * Isometry3::from(-self.centre_local.coords)
    }

    /// Kinetic energy of the body in `state` [J]; zero for a led one, whose motion is given.
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        self.inertia.map_or(0.0, |inertia| inertia.kinetic_energy(state))
    }
}
