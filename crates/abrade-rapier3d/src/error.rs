//! What can go wrong, with the bodies and surfaces it concerns.

use abrade::PhysicsError;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::ColliderHandle;
use thiserror::Error;

use crate::surface::SurfaceId;

/// How the core leads a kinematic body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Led {
    /// By [`WearWorld::drive`](crate::WearWorld::drive).
    #[error("driven")]
    Driven,
    /// As the embedder leads it, since [`WearWorld::add_tool`](crate::WearWorld::add_tool).
    #[error("a tool")]
    Tool,
}

/// An error of a wear world.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WearError {
    /// The proxy collider does not exist.
    #[error("there is no collider {collider:?} to put a wear surface on")]
    NoSuchCollider {
        /// The handle given.
        collider: ColliderHandle,
    },
    /// The proxy collider carries a wear surface already.
    #[error("collider {collider:?} carries wear surface {surface} already")]
    ColliderTaken {
        /// The handle given.
        collider: ColliderHandle,
        /// The surface on it.
        surface: SurfaceId,
    },
    /// The surface is of another world.
    #[error("there is no wear surface {surface} in this world")]
    NoSuchSurface {
        /// The name given.
        surface: SurfaceId,
    },
    /// The body does not exist, or is not dynamic.
    #[error("there is no dynamic body {body:?}")]
    NoSuchBody {
        /// The handle given.
        body: RigidBodyHandle,
    },
    /// The body does not exist, or is not kinematic.
    #[error("there is no kinematic body {body:?}")]
    NotKinematic {
        /// The handle given.
        body: RigidBodyHandle,
    },
    /// The body is kinematic, but led by its velocity.
    #[error("body {body:?} is led by its velocity: a driven body must be led by its position")]
    NotByPosition {
        /// The handle given.
        body: RigidBodyHandle,
    },
    /// The body is driven, or a tool, already: a kinematic body has one drive, or is a tool.
    #[error(
        "body {body:?} is {led} already: a kinematic body has one drive or is a tool, not both"
    )]
    LedAlready {
        /// The body.
        body: RigidBodyHandle,
        /// What it is.
        led: Led,
    },
    /// A contact left the reach of the model; Rapier kept the body's contact for that step, or the
    /// body was stopped in its crater.
    #[error("body {body:?} on wear surface {surface}: {source}")]
    Physics {
        /// The body.
        body: RigidBodyHandle,
        /// The surface, or the first of those that it was near.
        surface: SurfaceId,
        /// Why.
        source: PhysicsError,
    },
}
