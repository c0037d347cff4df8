//! When a body rests: how it comes down on its surfaces, and whether it moves along them.

use abrade::Body;
use nalgebra::Isometry3;
use rapier::dynamics::RigidBody;

use crate::approach::{Strike, strike_speed};
use crate::gate::{self, Course, Lie};
use crate::pull::mass;
use crate::quasi_static::holds;
use crate::scalar;
use crate::start::Scene;
use crate::surface::SurfaceId;
use crate::tracked::Tracked;

/// Share of the rest speed below which a body does not move along.
const CREEP: f64 = 0.05;
/// Share of its radius by which a body at rest may be above its surface.
const CLOSE: f64 = 0.02;

impl Scene<'_> {
    /// True for a body that comes down on its surfaces no faster than what pulls it there makes it
    /// in a step: it would be back on them within the step.
    pub fn rests(&self, rb: &RigidBody, tracked: &Tracked) -> bool {
        let can_hold = |id: &SurfaceId| gate::can_hold(self.lies, self.surfaces, *id);
        if tracked.is_in_blow() || !tracked.near.iter().all(can_hold) {
            return false;
        }
        let course = Course::of(rb, tracked, &scalar::vector(self.world.gravity));
        let pull = |id: &SurfaceId| {
            Some(-self.frame(*id)?.inverse_transform_vector(&course.acceleration).z)
        };
        let pull = tracked.near.iter().filter_map(pull).fold(0.0, f64::max);
        let rest_speed = pull * self.dt;
        let Some(body) = tracked.body() else { return false };
        let close = CLOSE * tracked.radius;
        let strike = self.strike(body, &course, &tracked.near);
        if strike.is_none_or(|strike| strike.speed >= rest_speed || strike.gap > close) {
            return false;
        }
        // What moves along and ploughs is braked by it, which Rapier's contact would not do.
        let load = pull * mass(rb, Some(tracked));
        let firm = |id: &SurfaceId| holds(&self.surfaces[id.0].surface, load);
        let limit = CREEP * rest_speed;
        let stays = |id: &SurfaceId| {
            self.frame(*id).is_some_and(|frame| along(&course, &frame, tracked.radius) < limit)
        };
        tracked.near.iter().all(|id| stays(id) || firm(id))
    }

    /// How a body comes down on its surfaces in this step, if it does.
    pub fn strike(&self, body: &Body, course: &Course, surfaces: &[SurfaceId]) -> Option<Strike> {
        let on = |id: &SurfaceId| {
            let frame = self.frame(*id)?;
            let pull = -frame.inverse_transform_vector(&course.acceleration).z;
            let level = self.surfaces[id.0].bounds.high.z;
            strike_speed(body, &course.state, &frame, level, pull.max(0.0), self.sight)
        };
        surfaces.iter().filter_map(on).reduce(Strike::and)
    }

    fn frame(&self, id: SurfaceId) -> Option<Isometry3<f64>> {
        Lie::find(self.lies, id).map(|lie| lie.pose)
    }
}

/// Speed at which the points of a body of `radius` [m] move along the plane of `frame` [m/s], unless
/// it tilts.
fn along(course: &Course, frame: &Isometry3<f64>, radius: f64) -> f64 {
    let velocity = frame.inverse_transform_vector(&course.state.velocity);
    let spin = frame.inverse_transform_vector(&course.state.spin);
    velocity.xy().norm() + spin.z.abs() * radius
}
