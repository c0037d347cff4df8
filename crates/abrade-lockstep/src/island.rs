//! The island and its steps.

use abrade::{Met, PhysicsError, Placed, State};
use rapier::dynamics::{
    GenericJoint, LockedAxes, Multibody, MultibodyJoint, RigidBody, RigidBodyHandle,
};
use rapier::math::Vector;
use rapier::pipeline::{ActiveHooks, PhysicsWorld};

use crate::calm::Seen;
use crate::convert::{state, to_vector};
use crate::filter::{Filter, Proxy, Wearing};
use crate::pairs::Pairs;
use crate::parameters::{refine, refine_joint};
use crate::rewind::{Rewind, chains};
use crate::round::{is_ball, is_round};
use crate::wearer::Wearer;

/// Parts of an advance that no step is longer than.
const COARSEST: f64 = 16.0;
/// Angle [rad] by which no body turns in a step, where joints hold and where none does, round bodies
/// apart: within a step Rapier's joints are straight.
const TURN_HELD: f64 = 0.002;
const TURN_FREE: f64 = 0.1;
/// Iterations of the solver in a step that begins without known impulses, in which a light body may
/// bear a heavy one, and in a step that has a blow.
const FIRST: usize = 256;
const BLOW: usize = 32;
/// A contact at rest is struck when its impulse exceeds what it carried before by this factor.
const STRUCK: f64 = 1.5;

/// What an island is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IslandSettings {
    /// Steps after which an advance is given up.
    pub step_limit: u64,
    /// Steps after which the island is put to rest on Rapier's contacts, for the rest of the
    /// advance.
    pub budget: u64,
    /// Normal speed below which a body that rings on its springs rests [m/s]; zero for never.
    pub rest_speed: f64,
}

/// What an advance did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Done {
    /// Steps taken.
    pub steps: u64,
}

/// An island of bodies in a world of its own.
pub struct Island {
    world: PhysicsWorld,
    wearers: Vec<Wearer>,
    /// Force and torque of the embedder on each dynamic body.
    loads: Vec<(RigidBodyHandle, Vector, Vector)>,
    filter: Filter,
    pairs: Pairs,
    rewind: Rewind,
    settings: IslandSettings,
    /// Bodies whose turning matters, and the angle by which they turn in a step at most [rad].
    turning: Vec<RigidBodyHandle>,
    turn: f64,
    /// Longest step [s].
    coarsest: f64,
    /// Length of the last step [s], if its impulses are those of the next one but for their length.
    known: Option<f64>,
    /// The next step stops a body.
    stops: bool,
    /// Its budget is spent: nothing wakes it.
    is_out: bool,
}

impl Island {
    /// An island of everything in `world`, in which the `wearers` wear the surfaces that stand on
    /// `proxies`. User forces of its bodies act on through the whole advance.
    pub fn new(
        mut world: PhysicsWorld,
        wearers: Vec<Wearer>,
        proxies: Vec<Proxy>,
        settings: IslandSettings,
    ) -> Self {
        refine(&mut world.integration_parameters);
        for (_, joint) in world.impulse_joints.iter_mut() {
            refine_joint(&mut joint.data);
        }
        let indices: Vec<_> = chains(&world.multibody_joints).map(|(index, _)| index).collect();
        for index in indices {
            let multibody = world.multibody_joints.get_multibody_mut(index);
            multibody.into_iter().flat_map(Multibody::links_mut).for_each(|link| {
                refine_joint(&mut link.joint.data);
            });
        }
        for proxy in &proxies {
            let hooks = ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS;
            if let Some(collider) = world.colliders.get_mut(proxy.collider) {
                collider.set_active_hooks(hooks);
            }
        }
        let loads = |(handle, rb): (RigidBodyHandle, &RigidBody)| {
            rb.is_dynamic().then(|| (handle, rb.user_force(), rb.user_torque()))
        };
        let loads = world.bodies.iter().filter_map(loads).collect();
        let pairs = Pairs::of(&world, &proxies);
        let filter = Filter::new(proxies);
        let rewind = Rewind::default();
        // No time passes: bodies get their masses, joints their places.
        world.integration_parameters.dt = 0.0;
        world.step_with_events(&filter, &());
        let joints = &world.multibody_joints;
        let is_held = !world.impulse_joints.is_empty() || chains(joints).next().is_some();
        let matters = |(handle, rb): (RigidBodyHandle, &RigidBody)| {
            let own = wearers.iter().find(|wearer| wearer.handle == handle);
            let is_round =
                is_round(rb, &world.colliders) && own.is_none_or(|own| is_ball(&own.body.shape));
            (is_held || !is_round).then_some(handle)
        };
        let turning = world.bodies.iter().filter_map(matters).collect();
        let turn = if is_held { TURN_HELD } else { TURN_FREE };
        Self {
            world,
            wearers,
            loads,
            filter,
            pairs,
            rewind,
            settings,
            turning,
            turn,
            coarsest: 0.0,
            known: None,
            stops: false,
            is_out: false,
        }
    }

    /// The bodies that wear.
    pub fn wearers(&self) -> &[Wearer] {
        &self.wearers
    }

    /// Takes the island through `duration` [s]. `watch` sees it after every step, with the time
    /// gone by [s].
    ///
    /// A body whose crater gets deeper than it is stops there ([`Wearer::beyond`]).
    ///
    /// # Errors
    /// A state that is not finite, or too many steps.
    pub fn advance(
        &mut self,
        surfaces: &mut [Placed<'_>],
        duration: f64,
        watch: &mut dyn FnMut(&Self, f64, &[Placed<'_>]),
    ) -> Result<Done, PhysicsError> {
        let mut done = Done::default();
        let mut time = 0.0;
        self.coarsest = duration / COARSEST;
        self.let_rest(surfaces);
        while time < duration {
            let remaining = duration - time;
            if done.steps >= self.settings.budget {
                return self.rest_out(surfaces, remaining, done);
            }
            let h = self.length(surfaces).min(self.turning()).min(self.coarsest).min(remaining);
            let h = self.pairs.limit(h, &self.world);
            let taken = self.step(surfaces, h)?;
            time = if taken == remaining { duration } else { time + taken };
            done.steps += 1;
            if done.steps > self.settings.step_limit {
                return Err(PhysicsError::TooManySteps { steps: done.steps });
            }
            watch(self, time, surfaces);
        }
        Ok(done)
    }

    /// Nodes taken through the law by the wearing bodies since they joined.
    pub fn node_evaluations(&self) -> u64 {
        self.wearers.iter().map(Wearer::node_evaluations).sum()
    }

    /// Takes the rest of an advance in long steps, every wearing body on a contact of Rapier's.
    fn rest_out(
        &mut self,
        surfaces: &mut [Placed<'_>],
        remaining: f64,
        mut done: Done,
    ) -> Result<Done, PhysicsError> {
        self.wearers.iter_mut().for_each(|w| w.calm.rests = true);
        self.mark();
        self.is_out = true;
        for _ in 0..COARSEST as usize {
            self.step(surfaces, remaining / COARSEST)?;
            done.steps += 1;
        }
        Ok(done)
    }

    /// Bodies that are slow at the start begin at rest; what slides along would wear.
    fn let_rest(&mut self, surfaces: &[Placed<'_>]) {
        let limit = self.settings.rest_speed;
        for wearer in &mut self.wearers {
            let still = wearer.normal_speed(surfaces) < limit;
            wearer.calm.rests = still && wearer.speed() < limit;
        }
        self.mark();
    }

    /// Tells the filter who rests.
    fn mark(&mut self) {
        self.filter.forget();
        self.filter.wearers.clear();
        let wearing =
            |w: &Wearer| Wearing { body: w.handle, rests: w.calm.rests, uses: w.uses.clone() };
        self.filter.wearers.extend(self.wearers.iter().map(wearing));
    }

    /// Length of the next step [s].
    fn length(&mut self, surfaces: &mut [Placed<'_>]) -> f64 {
        let on_springs = self.wearers.iter_mut().filter(|w| !w.calm.rests);
        on_springs.map(|w| w.step(surfaces)).fold(f64::INFINITY, f64::min)
    }

    /// Longest step in which no body turns too far [s].
    fn turning(&self) -> f64 {
        let turning = self.turning.iter().filter_map(|handle| self.world.bodies.get(*handle));
        self.turn / turning.map(|rb| rb.angvel().length()).fold(0.0, f64::max)
    }

    /// A step of at most `h` [s]; returns its length.
    fn step(&mut self, surfaces: &mut [Placed<'_>], h: f64) -> Result<f64, PhysicsError> {
        let mut h = h;
        let mut known = self.known;
        self.rewind.save(&self.world);
        loop {
            if h < f64::MIN_POSITIVE / f64::EPSILON {
                return Err(PhysicsError::StepVanished { step: h });
            }
            self.push(surfaces, h);
            let parameters = &mut self.world.integration_parameters;
            parameters.dt = h;
            // The impulses of the step before are those of its length; those of a blow, or of a step
            // that was taken back, say nothing. Without them one iteration does not reach through a
            // joint or a stack.
            parameters.warmstart_coefficient = known.map_or(0.0, |last| (h / last).min(1.0));
            parameters.num_internal_pgs_iterations = match known {
                _ if self.pairs.strikes => BLOW,
                Some(_) => 1,
                None => FIRST,
            };
            self.world.step_with_events(&self.filter, &());
            tell_links(&mut self.world);
            match self.follow(surfaces, h)? {
                Met::Fits => break,
                Met::TooLong(shorter) => {
                    self.rewind.restore(&mut self.world);
                    (h, known) = (shorter, None);
                }
            }
        }
        let stops = self.stop_the_lost(surfaces);
        let is_blow = self.pairs.strikes || stops || self.stops;
        (self.known, self.stops) = ((!is_blow).then_some(h), stops);
        self.watch_calm(surfaces, h);
        Ok(h)
    }

    /// Stops bodies that their surfaces can follow no further; true if there are any. What drives
    /// them on may be so heavy that Rapier's solver does not see it stopped by a contact: they are
    /// held. A link is not, but its articulation is stopped with it.
    fn stop_the_lost(&mut self, surfaces: &mut [Placed<'_>]) -> bool {
        let mut any = false;
        for wearer in &mut self.wearers {
            if !wearer.give_up(surfaces) {
                continue;
            }
            any = true;
            let is_link = self.world.multibody_joints.rigid_body_link(wearer.handle).is_some();
            let rb = self.world.bodies.get_mut(wearer.handle).filter(|_| !is_link);
            let Some(rb) = rb else { continue };
            rb.set_linvel(Vector::ZERO, false);
            rb.set_angvel(Vector::ZERO, false);
            rb.set_locked_axes(LockedAxes::all(), false);
        }
        if any {
            self.mark();
        }
        any
    }

    /// Sets the forces of the present instant.
    fn push(&mut self, surfaces: &mut [Placed<'_>], h: f64) {
        for (handle, force, torque) in &self.loads {
            let Some(rb) = self.world.bodies.get_mut(*handle) else { continue };
            rb.reset_forces(false);
            rb.reset_torques(false);
            rb.add_force(*force, true);
            rb.add_torque(*torque, true);
        }
        for wearer in self.wearers.iter_mut().filter(|w| !w.calm.rests) {
            wearer.grasp(surfaces, h);
            let Some(rb) = self.world.bodies.get_mut(wearer.handle) else { continue };
            rb.add_force(to_vector(&wearer.grip.force), true);
            rb.add_torque(to_vector(&wearer.grip.torque), true);
        }
    }

    /// Lets every surface follow, or none.
    fn follow(&mut self, surfaces: &mut [Placed<'_>], h: f64) -> Result<Met, PhysicsError> {
        if self.wearers.iter().any(|wearer| self.is_struck(wearer, h)) {
            self.wearers.iter_mut().for_each(|wearer| wearer.wake(surfaces));
            self.mark();
            return Ok(Met::TooLong(self.length(surfaces).min(0.5 * h)));
        }
        let world = &self.world;
        let end = |wearer: &Wearer| world.bodies.get(wearer.handle).map(state);
        for wearer in self.wearers.iter_mut().filter(|w| !w.calm.rests) {
            let Some(end) = end(wearer) else { continue };
            if let Met::TooLong(shorter) = wearer.meet(surfaces, &end, h)? {
                return Ok(Met::TooLong(shorter));
            }
        }
        let share = (h / self.coarsest).min(1.0);
        for wearer in self.wearers.iter_mut().filter(|w| w.calm.rests) {
            wearer.body.state = end(wearer).unwrap_or(wearer.body.state);
            let load = rest_impulse(world, &self.filter.proxies, wearer.handle) / h;
            wearer.bears += (load - wearer.bears) * share;
        }
        let mut on_springs = self.wearers.iter_mut().filter(|w| !w.calm.rests);
        on_springs.try_for_each(|w| w.follow(surfaces, h))?;
        Ok(Met::Fits)
    }

    /// Does a body at rest bear an impulse, in a step of `h` [s], that resting does not explain?
    fn is_struck(&self, wearer: &Wearer, h: f64) -> bool {
        if !wearer.calm.rests || self.is_out || wearer.beyond().is_some() {
            return false;
        }
        let jolt = wearer.body.inertia.mass * self.settings.rest_speed / self.coarsest;
        let impulse = rest_impulse(&self.world, &self.filter.proxies, wearer.handle);
        impulse > (STRUCK * wearer.bears + jolt) * h
    }

    /// Puts bodies that only ring to rest.
    fn watch_calm(&mut self, surfaces: &[Placed<'_>], h: f64) {
        let limit = self.settings.rest_speed;
        if limit <= 0.0 {
            return;
        }
        let mut changed = false;
        for wearer in self.wearers.iter_mut().filter(|w| !w.calm.rests) {
            let seen = Seen {
                speed: wearer.normal_speed(surfaces),
                limit,
                touches: wearer.contact.in_contact(),
                wears: wearer.wears,
                period: wearer.contact.period(),
                dt: h,
            };
            wearer.calm.watch(&seen);
            changed |= wearer.calm.rests;
        }
        if changed {
            self.mark();
        }
    }

    /// Kinetic energy of its bodies, and with their height [J].
    pub fn energies(&self) -> [f64; 2] {
        let world = &self.world;
        let kinetic: f64 = world.bodies.iter().map(|(_, rb)| rb.kinetic_energy()).sum();
        let height = |rb: &RigidBody| {
            -rb.mass() * rb.gravity_scale() * world.gravity.dot(rb.center_of_mass())
        };
        let dynamic = world.bodies.iter().filter(|(_, rb)| rb.is_dynamic());
        [kinetic, kinetic + dynamic.map(|(_, rb)| height(rb)).sum::<f64>()]
    }

    /// True when something beside gravity and contacts may do work on it: a motor, a kinematic body, a
    /// force of the embedder, or springs that were loaded when it was made.
    pub fn is_driven(&self) -> bool {
        let motors = |joint: &GenericJoint| !joint.motor_axes.is_empty();
        let springs = |joint: &MultibodyJoint| (0..6).any(|axis| joint.spring(axis).0 != 0.0);
        let drives =
            |joint: &MultibodyJoint| joint.kinematic || springs(joint) || motors(&joint.data);
        self.world.impulse_joints.iter().any(|(_, joint)| motors(&joint.data))
            || self.world.multibody_joints.iter().any(|(_, _, _, link)| drives(link.joint()))
            || self.world.bodies.iter().any(|(_, rb)| rb.is_kinematic())
            || self
                .loads
                .iter()
                .any(|(_, force, torque)| force.length() > 0.0 || torque.length() > 0.0)
            || self.wearers.iter().any(|wearer| wearer.contact.in_contact())
    }

    /// State of a body of its world.
    pub fn state(&self, body: RigidBodyHandle) -> Option<State> {
        self.world.bodies.get(body).map(state)
    }

    /// The bodies that wear, with their springs, to go on with another time.
    pub fn into_wearers(self) -> Vec<Wearer> {
        self.wearers
    }
}

/// Tells the links of articulations the velocities that the step has given their joints: Rapier does
/// so at the start of the next one.
fn tell_links(world: &mut PhysicsWorld) {
    for (_, multibody) in chains(&world.multibody_joints) {
        let rates = multibody.generalized_velocity();
        for link in multibody.links() {
            let motion = multibody.body_jacobian(link.link_id()) * rates;
            let [velocity, spin] =
                [0, 3].map(|at| Vector::new(motion[at], motion[at + 1], motion[at + 2]));
            if let Some(rb) = world.bodies.get_mut(link.rigid_body_handle())
                && rb.is_dynamic()
            {
                rb.set_linvel(velocity, false);
                rb.set_angvel(spin, false);
            }
        }
    }
}

/// Impulse of a body's contacts with proxies in the last step [N s].
fn rest_impulse(world: &PhysicsWorld, proxies: &[Proxy], body: RigidBodyHandle) -> f64 {
    let colliders = world.bodies.get(body).map_or(&[][..], RigidBody::colliders);
    let pairs = colliders.iter().flat_map(|own| {
        proxies.iter().filter_map(|proxy| world.narrow_phase.contact_pair(proxy.collider, *own))
    });
    pairs.map(|pair| pair.total_impulse().length()).sum()
}
