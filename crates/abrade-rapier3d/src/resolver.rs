//! The ways in which a contact can be resolved.

/// Which resolvers a world may use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub enum Resolve {
    /// Per body and step, the cheapest that is right: Micro for a body that nothing but wear
    /// surfaces touches, Lockstep for a blow that joints or other bodies have a part in,
    /// QuasiStatic for what lies, leans, slides or rolls; on closed and on moving surfaces that others
    /// are among, Collision.
    #[default]
    Auto,
    /// Micro alone: a body that it cannot carry is left to Rapier and wears nothing. Under every setting Micro
    /// takes tools, and free solids that strike a wall: no other resolver does.
    Micro,
    /// QuasiStatic alone, blows included.
    QuasiStatic,
    /// Lockstep, with the springs always on: the reference, at its price. What no island can hold
    /// goes to QuasiStatic, and says so.
    Lockstep,
}

/// A way to resolve a contact over a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub enum Resolver {
    /// The core's integrator carries the body through the step on its own.
    Micro,
    /// Rapier keeps the contact, laid on the worn surface; nodes move by the balance of the load
    /// that it carried. On closed and on moving surfaces among others, contact by contact.
    QuasiStatic,
    /// The body and all that it touches or is jointed to are stepped finely in a private world.
    Lockstep,
    /// Rapier keeps the contact; what it gave as a blow is run by the core as a collision of two,
    /// which wears them both.
    Collision,
}

impl Resolver {
    /// Its name, to count by.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Micro => "micro",
            Self::QuasiStatic => "quasi_static",
            Self::Lockstep => "lockstep",
            Self::Collision => "collision",
        }
    }
}
