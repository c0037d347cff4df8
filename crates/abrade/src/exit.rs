//! Where a contact begins and ends: clear at the start, over once the body is out, given up when
//! the body is below the surface.

use nalgebra::Vector3;

use crate::body::{Body, State};
use crate::contact::Contact;
use crate::encounter::{Loads, Placed};
use crate::error::PhysicsError;
use crate::extent::{bounds, clearance};
use crate::flight::{rise_time, separation, top_speed};
use crate::integrate::Integrator;
use crate::settle::Pull;
use crate::surface::Surface;

/// Overlap at the first step, in bounding radii, above which a body counts as started inside.
const INSIDE: f64 = 1e-3;
/// Increments by which a body that lies in a surface is lifted until it is clear of it.
const LIFTS: usize = 60;
/// Way of a body between two looks at whether it is clear of a mesh, in pitches.
const RISE_PITCH: f64 = 0.25;
/// Share of the kinetic energy before contact below which a body counts as stopped.
const STOPPED: f64 = 1e-9;
/// Share of it below which what is left of the motion of a body in contact is lost in rounding.
const HELD: f64 = 1e-20;
/// Depth beside a strip from which what touches it is engulfed, in bounding radii.
const BESIDE: f64 = 2.0;

impl Integrator {
    /// After a contact: time until the whole body is above the undeformed surfaces [s], so that a
    /// flight step ends there.
    pub(crate) fn rise_time(&self, body: &Body, surfaces: &[Placed<'_>]) -> f64 {
        if !self.touched {
            return f64::INFINITY;
        }
        let times = surfaces.iter().enumerate().map(|(i, placed)| {
            let local = placed.sees(&body.state);
            match placed.surface.is_flat() {
                true => rise_time(placed.surface, body, &local, self.reach(i)),
                false => RISE_PITCH * placed.surface.pitch() / top_speed(placed, body),
            }
        });
        times.fold(f64::INFINITY, f64::min)
    }

    /// The body must not lie inside a surface before it has touched it. Flight ends where the boxes of
    /// both meet, up to round-off: a face that comes flat against a border holds its nodes there.
    pub(crate) fn start_clear(
        &mut self,
        body: &Body,
        surfaces: &[Placed<'_>],
    ) -> Result<(), PhysicsError> {
        let limit = INSIDE * body.shape.bounding_radius();
        let meets = |placed: &Placed<'_>| {
            let local = placed.sees(&body.state);
            separation(placed.surface, body, &local, 0.0) <= -limit
        };
        let overlaps = self.overlaps(body, surfaces).zip(surfaces);
        let inside = overlaps.filter(|(depth, placed)| *depth > limit && meets(placed));
        match inside.map(|(depth, _)| depth).reduce(f64::max) {
            Some(depth) => Err(PhysicsError::StartsInside { depth }),
            None => Ok(()),
        }
    }

    /// Lifts a body that an engine has left inside the surfaces, against `down`, until it is clear of
    /// them.
    pub(crate) fn lift(&mut self, body: &mut Body, surfaces: &[Placed<'_>], down: &Vector3<f64>) {
        for _ in 0..LIFTS {
            let depth = self.overlaps(body, surfaces).fold(0.0, f64::max);
            if depth == 0.0 {
                break;
            }
            body.state.position -= down * depth;
        }
    }

    /// True for a body out of contact and wholly above every undeformed surface.
    pub(crate) fn contact_is_over(&self, body: &Body, surfaces: &[Placed<'_>]) -> bool {
        !self.touching
            && surfaces.iter().enumerate().all(|(i, placed)| {
                let local = placed.sees(&body.state);
                let reach = self.reach(i);
                separation(placed.surface, body, &local, reach) >= 0.0
                    || is_clear(placed.surface, body, &local, reach)
            })
    }

    /// True for a body that has been brought to rest and that no spring pushes out again.
    pub(crate) fn has_stopped(&self, body: &Body, surfaces: &[Placed<'_>]) -> bool {
        let little = STOPPED * self.energy_before;
        self.touched
            && self.relative_energy(body, surfaces) < little
            && (self.contacts.iter().all(Contact::is_rigid) || self.is_unsprung(little))
    }

    /// True while no spring pushes the body, and what columns do would give it `little` [J] at most
    /// in a step: springs under columns push it out again where it turns.
    fn is_unsprung(&self, little: f64) -> bool {
        let zero = Vector3::zeros();
        let kick = self.pull.force * self.next_dt;
        self.pull.spring_force == zero
            && self.pull.spring_torque == zero
            && 0.5 * kick.norm_squared() * self.dynamics.inverse_mass <= little
    }

    /// True for a body that nothing but its contacts acts on, with surfaces at rest, and that they hold where
    /// it is: it has next to no motion left, and their forces give it none. No step would change that.
    pub(crate) fn is_held(&self, body: &Body, surfaces: &[Placed<'_>], loads: &Loads) -> bool {
        let little = HELD * self.energy_before;
        let straight = 0.5 * body.state.velocity.norm_squared();
        // What moves at all is seen at the lowest price.
        if straight >= little * self.dynamics.inverse_mass || !self.touching {
            return false;
        }
        if self.relative_energy(body, surfaces) >= little {
            return false;
        }
        let is_led = self.dynamics.is_guided() || self.dynamics.is_immovable();
        if is_led || !self.surfaces_rest() || *loads != Loads::default() {
            return false;
        }
        let Pull { force, torque, .. } = &self.pull;
        let turn = self.dynamics.turn(&body.state.rotation, torque);
        let square =
            force.norm_squared() * self.dynamics.inverse_mass + self.dynamics.work(torque, &turn);
        0.5 * square * self.next_dt * self.next_dt <= little
    }

    /// Kinetic energy of a body over the material that it leans on most [J].
    pub(crate) fn relative_energy(&self, body: &Body, surfaces: &[Placed<'_>]) -> f64 {
        if self.surfaces_rest() {
            return body.inertia.kinetic_energy(&body.state);
        }
        let [below, _] = self.motion_below(body, surfaces);
        let velocity = body.state.velocity - below;
        body.inertia.kinetic_energy(&State { velocity, ..body.state })
    }

    pub(crate) fn end_contact(&mut self, surfaces: &mut [Placed<'_>]) {
        for (contact, placed) in self.contacts.iter_mut().zip(surfaces) {
            contact.end(placed.surface);
        }
        self.short = 0.0;
        self.touching = false;
        self.touched = false;
    }

    /// An error when the centre of mass is below an undeformed surface, of a body without one of its
    /// own. A body that hangs over the edge of a strip may slip past it; what touches nodes from far
    /// below cuts them deeper than itself.
    pub(crate) fn check_depth(
        &self,
        body: &Body,
        surfaces: &[Placed<'_>],
    ) -> Result<(), PhysicsError> {
        let deep = BESIDE * body.shape.bounding_radius();
        // Of several surfaces it is not known which of them it touches.
        let beside = if self.touching && surfaces.len() == 1 { deep } else { f64::INFINITY };
        for placed in surfaces {
            // The middle of a ring lies in what it turns on.
            if placed.skin.is_some() {
                continue;
            }
            let local = placed.pose.inverse_transform_point(&body.state.position);
            let depth = placed.surface.depth_of(&local, beside);
            if depth > 0.0 {
                return Err(PhysicsError::Engulfed { depth });
            }
        }
        Ok(())
    }

    /// Distance between the boxes of the body and of the first surface [m].
    pub(crate) fn gap(&self, body: &Body, surfaces: &[Placed<'_>]) -> f64 {
        let placed = &surfaces[0];
        let local = placed.sees(&body.state);
        separation(placed.surface, body, &local, self.reach(0))
    }

    /// How far from the nodes of the surface `i` a body feels them [m].
    fn reach(&self, i: usize) -> f64 {
        self.contacts[i].inflation() + self.range(i)
    }
}

/// True for a body that no undeformed node of a mesh lies in. Flat surfaces go by their plane.
fn is_clear(surface: &Surface, body: &Body, local: &State, inflation: f64) -> bool {
    if surface.is_flat() {
        return false;
    }
    let [low, high] = bounds(&body.shape, local, inflation);
    let rest = &surface.nodes().rest_position;
    let mut clear = true;
    surface.grid().visit(&low, &high, |i| {
        clear &= clearance(&body.shape, local, &rest[i]) >= inflation;
    });
    clear
}
