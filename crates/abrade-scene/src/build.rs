//! From a checked scene to surfaces and bodies, in the world.

use std::collections::BTreeMap;

use abrade::{Body, State, Surface, SurfaceError};
use nalgebra::Isometry3;
use thiserror::Error;

use crate::carrier::BuiltCarrier;
use crate::check::Checked;
use crate::led_path::LedPath;
use crate::place;
use crate::scene::{Geometry, Motion, SceneBody, SceneSurface};
use crate::solid::Solid;

/// A scene, ready to run.
#[derive(Clone, Debug)]
pub struct Built {
    /// Surfaces by name.
    pub surfaces: BTreeMap<String, BuiltSurface>,
    /// Bodies by name; states are in world axes.
    pub bodies: BTreeMap<String, Body>,
}

/// A surface and where it lies.
#[derive(Clone, Debug)]
pub struct BuiltSurface {
    /// The surface.
    pub surface: Surface,
    /// Its frame in the world, at the start.
    pub pose: Isometry3<f64>,
    /// The body that it moves with; none for a surface at rest.
    pub carrier: Option<BuiltCarrier>,
    /// What it is led along, if it has a path.
    pub path: Option<LedPath>,
    /// What the engine has in its place.
    pub stand_in: StandIn,
}

/// The undeformed solid below a surface, as simply as a physics engine can have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StandIn {
    /// A box whose top is the plate.
    Plate,
    /// A ball about the origin of the surface's frame.
    Ball {
        /// Radius [m].
        radius: f64,
    },
    /// A box about the origin.
    Cuboid {
        /// Half of its edges [m].
        half_extents: [f64; 3],
    },
    /// Everything near a line along z, whose middle is the origin.
    Capsule {
        /// Radius [m].
        radius: f64,
        /// Half the length of the line [m].
        half_length: f64,
    },
    /// The facets between the nodes.
    Facets,
}

/// A checked scene that still cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BuildError {
    /// A surface cannot be built.
    #[error("the surface `{name}` cannot be built: {error}")]
    Surface {
        /// Name of the surface.
        name: String,
        /// Why not.
        error: SurfaceError,
    },
    /// A name, rotation or pitch is missing: the scene was changed after its check.
    #[error("`{name}` is not the scene that was checked")]
    Unchecked {
        /// Name of the surface or body.
        name: String,
    },
}

impl StandIn {
    fn of(geometry: &Geometry) -> Self {
        match *geometry {
            Geometry::HexStrip { .. } => Self::Plate,
            Geometry::Sphere { radius, .. } => Self::Ball { radius },
            Geometry::Cuboid { half_extents, .. } => Self::Cuboid { half_extents },
            Geometry::Capsule { radius, length, .. } => {
                Self::Capsule { radius, half_length: 0.5 * length }
            }
            Geometry::Cylinder { .. }
            | Geometry::Tube { .. }
            | Geometry::Bend { .. }
            | Geometry::HeightField { .. }
            | Geometry::Mesh { .. } => Self::Facets,
        }
    }
}

impl Checked {
    /// Builds the surfaces' nodes and puts every body in its place.
    ///
    /// # Errors
    /// A surface that `abrade` refuses, or a scene that was changed after its check.
    pub fn build(&self) -> Result<Built, BuildError> {
        let unchecked = |name: &str| BuildError::Unchecked { name: name.to_owned() };
        let mut surfaces = BTreeMap::new();
        for (name, surface) in &self.scene.surfaces {
            surfaces.insert(name.clone(), self.build_surface(name, surface)?);
        }
        let mut bodies = BTreeMap::new();
        for (name, body) in &self.scene.bodies {
            let solid = self.solids.get(name).ok_or_else(|| unchecked(name))?;
            let body = self.build_body(body, solid).ok_or_else(|| unchecked(name))?;
            bodies.insert(name.clone(), body);
        }
        Ok(Built { surfaces, bodies })
    }

    fn build_surface(
        &self,
        name: &str,
        surface: &SceneSurface,
    ) -> Result<BuiltSurface, BuildError> {
        let unchecked = || BuildError::Unchecked { name: name.to_owned() };
        let material = self.scene.materials.get(&surface.material).ok_or_else(unchecked)?;
        let path = self.paths.get(name);
        let pose = place::start(surface, path).ok_or_else(unchecked)?;
        let laws = surface.laws(material);
        let stand_in = StandIn::of(&surface.geometry);
        let mesh = self.meshes.get(name);
        let carrier = BuiltCarrier::new(&surface.motion, &pose, path, mesh);
        let surface = match mesh {
            Some(mesh) => Surface::mesh(mesh, laws),
            None => {
                let strip = place::strip(&surface.geometry).ok_or_else(unchecked)?;
                Surface::hex_strip(strip, laws)
            }
        };
        let refused = |error| BuildError::Surface { name: name.to_owned(), error };
        let mut surface = surface.map_err(refused)?;
        if let Some(factors) = self.hardness.get(name) {
            surface.set_hardness_factors(factors.clone()).map_err(refused)?;
        }
        Ok(BuiltSurface { surface, pose, carrier, path: path.cloned(), stand_in })
    }

    /// State of a body at the start, in the world; none for a scene that was changed after its check.
    pub(crate) fn start(&self, body: &SceneBody, solid: &Solid) -> Option<State> {
        let surface = match body.position.surface() {
            Some(name) => Some((self.scene.surfaces.get(name)?, self.paths.get(name))),
            None => None,
        };
        let local = place::local_state(body, solid, surface.map(|(surface, _)| surface))?;
        match surface {
            Some((surface, path)) => Some(local.placed_by(&place::start(surface, path)?)),
            None => Some(local),
        }
    }

    fn build_body(&self, body: &SceneBody, solid: &Solid) -> Option<Body> {
        let state = self.start(body, solid)?;
        let driven = matches!(body.motion, Motion::Drive { .. });
        Some(Body {
            shape: solid.shape.clone(),
            inertia: solid.inertia,
            state,
            rotation_locked: body.rotation_locked || driven,
        })
    }
}
