//! What happened to the contacts of a step. Filtered pairs raise no contact events of Rapier's;
//! these stand in for them.

use abrade::{PhysicsError, RenewError};
use nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::ColliderHandle;
use thiserror::Error;

use crate::resolver::{Resolve, Resolver};
use crate::surface::SurfaceId;

/// An event of the last step.
#[derive(Clone, Debug, PartialEq)]
pub enum WearEvent {
    /// A body came to bear on a wear surface.
    Started {
        /// The body.
        body: RigidBodyHandle,
        /// The surface.
        surface: SurfaceId,
    },
    /// A body left a wear surface. Contacts that follow each other within one step count as one.
    Ended {
        /// The body.
        body: RigidBodyHandle,
        /// The surface.
        surface: SurfaceId,
        /// Impulse on the body over the contact [N s], in the world; of all surfaces that it
        /// touched together. Of a contact that failed, without the step in which it did, as the time.
        impulse: Vector3<f64>,
        /// Volume displaced on this surface over the contact [m3].
        volume: f64,
        /// Time in contact [s].
        contact_time: f64,
    },
    /// A body is near a wear surface and was left to Rapier: whatever it touches does not wear.
    NotResolved {
        /// The body.
        body: RigidBodyHandle,
        /// The surface.
        surface: SurfaceId,
        /// Why.
        reason: Refusal,
    },
    /// Another resolver has taken a body over.
    Resolved {
        /// The body.
        body: RigidBodyHandle,
        /// Who resolves its contacts now.
        by: Resolver,
        /// Why Micro does not; `None` when it does.
        reason: Option<Refusal>,
    },
    /// A blow could not be taken in lockstep and was resolved by QuasiStatic.
    NoIsland {
        /// The body that struck.
        body: RigidBodyHandle,
        /// Why.
        reason: Refusal,
    },
    /// A contact left the reach of the model; the body was left to Rapier, or stopped in its crater.
    Failed {
        /// The body.
        body: RigidBodyHandle,
        /// The surface.
        surface: SurfaceId,
        /// Why.
        error: PhysicsError,
    },
    /// A worn solid has become the undeformed one: nodes have moved within the surface, and its
    /// proxy and the mass of its body have followed.
    Renewed {
        /// The surface.
        surface: SurfaceId,
    },
    /// A worn solid cannot be made the undeformed one; it wears on as it is, and is tried again
    /// once it has worn further.
    NotRenewed {
        /// The surface.
        surface: SurfaceId,
        /// Why.
        error: RenewError,
    },
}

/// Why a body was not carried by Micro, or an island not taken in lockstep.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub enum Refusal {
    /// It is held by a joint.
    #[error("the body is held by a joint")]
    Jointed,
    /// Some of its axes are locked: only all rotations at once may be.
    #[error("some of the body's axes are locked; only all rotations at once may be")]
    LockedAxes,
    /// Another collider is in its way.
    #[error("collider {collider:?} is in the body's way")]
    Obstructed {
        /// The first such collider.
        collider: ColliderHandle,
    },
    /// The surface is on a dynamic body that is jointed, has locked axes, or could meet something
    /// else in the step; or the body is near another surface besides.
    #[error("the wear surface is on a dynamic body that something else holds or could meet")]
    SurfaceMoves,
    /// A collider of the body is neither a ball, a cuboid, a convex polyhedron nor a compound of
    /// those.
    #[error("the shape of collider {collider:?} has no wear contact")]
    Shape {
        /// The collider.
        collider: ColliderHandle,
    },
    /// It has a closed surface of its own, which wears as the other does.
    #[error("the body wears as well as the surface")]
    Wears,
    /// It lies on a surface, or slides or rolls along it.
    #[error("the body lies on the surface, or slides or rolls along it")]
    Resting,
    /// Its springs are still loaded from a blow taken in lockstep.
    #[error("the body is in a blow that was begun in lockstep")]
    Blow,
    /// The world asks for another resolver.
    #[error("the world asks for another resolver")]
    Asked,
    /// A contact of its island was too stiff or too long for it.
    #[error("a contact of the island was too stiff, or took too many steps")]
    Stiff,
    /// An articulation (Rapier's multibody) that an island cannot hold: its root is kinematic, a link
    /// is disabled, or a joint that turns freely has limits, motors or springs and has turned about
    /// several axes.
    #[error(
        "an articulation of the island has a kinematic root, a disabled link, or a driven \
             joint that has turned freely"
    )]
    Multibody,
    /// Too many bodies hang together.
    #[error("more than {limit} bodies touch each other or are jointed")]
    Crowd {
        /// The most that are taken in lockstep.
        limit: usize,
    },
    /// It has no mass, or no solid collider.
    #[error("the body has no mass or no solid collider")]
    Massless,
    /// It lies in the surface already, as left by Rapier.
    #[error("the body lies inside the surface, as left by Rapier's contact")]
    Inside,
}

impl Refusal {
    /// One word for it, to count by.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Jointed => "jointed",
            Self::LockedAxes => "locked_axes",
            Self::Obstructed { .. } => "obstructed",
            Self::SurfaceMoves => "surface_moves",
            Self::Wears => "wears",
            Self::Shape { .. } => "shape",
            Self::Massless => "massless",
            Self::Inside => "inside",
            Self::Resting => "resting",
            Self::Blow => "blow",
            Self::Asked => "asked",
            Self::Stiff => "stiff",
            Self::Multibody => "multibody",
            Self::Crowd { .. } => "crowd",
        }
    }

    /// Why a contact that a resolver could not carry is left, if `resolve` lets it; none for an error of the
    /// embedder's world.
    pub(crate) fn of(error: &PhysicsError, resolve: Resolve) -> Option<Self> {
        match error {
            PhysicsError::StartsInside { .. } | PhysicsError::StepVanished { .. } => {
                Some(Self::Inside)
            }
            PhysicsError::TooManySteps { .. } if resolve == Resolve::Auto => Some(Self::Stiff),
            _ => None,
        }
    }

    /// True when no resolver can wear anything with the body.
    pub(crate) fn is_final(&self) -> bool {
        matches!(self, Self::SurfaceMoves | Self::Shape { .. } | Self::Massless)
    }
}
