//! A wear surface on its proxy collider, and where it lies.

use std::fmt;
use std::sync::Arc;

use abrade::{RenewError, Surface, Worn};
use nalgebra::{Isometry3, Point3};
use rapier::geometry::{Collider, ColliderHandle, ColliderSet};
use rapier::math::Pose;

use crate::extent::Extent;
use crate::query_collider::Shown;
use crate::scalar;

/// Names a wear surface of a [`WearWorld`](crate::WearWorld).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfaceId(pub(crate) usize);

impl fmt::Display for SurfaceId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// Growth of what has worn after which a refused renewal is tried again.
const AGAIN: f64 = 1.1;

/// Box around the undeformed nodes, in the surface's frame.
fn bounds(surface: &Surface) -> Extent {
    let [low, high]: [Point3<f64>; 2] = surface.bounds();
    Extent { low, high }
}

/// A surface and the collider that stands for it.
pub(crate) struct WornCollider {
    /// Shared with its leaves, for as long as those last.
    pub surface: Arc<Surface>,
    pub proxy: ColliderHandle,
    /// The surface's frame in the proxy's.
    pub offset: Isometry3<f64>,
    /// The exact frame in the world, for as long as the proxy has this pose.
    pub exact: Option<(Pose, Isometry3<f64>)>,
    /// Box around the undeformed nodes, in the surface's frame.
    pub bounds: Extent,
    /// How far from a node a body feels it [m].
    pub inflation: f64,
    /// What rays and characters see of it.
    pub shown: Option<Shown>,
    /// How worn it was when it could last not be renewed.
    pub refused: Option<Worn>,
    /// Overhangs have broken off in the step under way: what was read of it before no longer holds.
    pub broken: bool,
}

impl WornCollider {
    pub fn new(surface: Surface, proxy: ColliderHandle, offset: Isometry3<f64>) -> Self {
        let inflation = surface.laws().reach();
        let bounds = bounds(&surface);
        let surface = Arc::new(surface);
        let (exact, shown, refused, broken) = (None, None, None, false);
        Self { surface, proxy, offset, exact, bounds, inflation, shown, refused, broken }
    }

    /// True when the surface is due for renewal, and has worn by a good part since that was last
    /// refused: to try costs as much as to do it.
    pub fn is_due(&self) -> bool {
        let further =
            |refused: &Worn| self.surface.worn().displaced() > AGAIN * refused.displaced();
        self.surface.is_due_for_renewal() && self.refused.as_ref().is_none_or(further)
    }

    /// Renews the surface; returns the volume that the solid has lost since the renewal before
    /// [m3].
    pub fn renew(&mut self) -> Result<f64, RenewError> {
        let lost = self.surface.nodes().wear_volume();
        let renewed = self.owned().renew();
        self.refused = renewed.is_err().then(|| self.surface.worn());
        self.bounds = bounds(&self.surface);
        renewed.map(|_| lost)
    }

    /// Lays the surface's frame where the proxy's pose cannot say exactly.
    pub fn place(&mut self, proxy: &Collider, pose: Isometry3<f64>) {
        self.exact = Some((*proxy.position(), pose));
    }

    /// The proxy, if bodies can meet it: it is there, enabled and no sensor.
    pub fn live_proxy<'a>(&self, colliders: &'a ColliderSet) -> Option<&'a Collider> {
        colliders.get(self.proxy).filter(|proxy| proxy.is_enabled() && !proxy.is_sensor())
    }

    /// The surface's frame in the world.
    pub fn pose(&self, proxy: &Collider) -> Isometry3<f64> {
        match &self.exact {
            Some((seen, exact)) if seen == proxy.position() => *exact,
            _ => scalar::pose(proxy.position()) * self.offset,
        }
    }

    /// Books what broke off where a contact ended; returns the volume [m3].
    pub fn settle_end(&mut self) -> f64 {
        let volume = self.owned().settle().displaced();
        self.broken |= volume > 0.0;
        volume
    }

    /// The surface, to be worn.
    pub fn owned(&mut self) -> &mut Surface {
        Arc::get_mut(&mut self.surface).expect("a leaf lasts no longer than its run")
    }
}
