//! A case in a world of Rapier, in the precision of `super::plugin`.

use abrade::{Body, Inertia, Ledger, State, Surface};
use nalgebra::{Point3, Vector3};

use super::plugin::rapier::math::{Real, Vector};
use super::plugin::rapier::prelude::*;
use super::plugin::{SurfaceId, WearEvent, WearSettings, WearWorld, scalar};
use crate::case::{Case, Form, Means, Target};
use crate::run::{Step, World};
use crate::solid::{self, CLUMP};

/// Roundings of a coordinate that Rapier needs between body and surface.
const CLEARANCE: f64 = 16.0;
/// Longest flight of a body that is not registered [s].
const FLIGHT: f64 = 0.5;

pub struct Trial {
    world: PhysicsWorld,
    wear: WearWorld,
    surface: SurfaceId,
    body: RigidBodyHandle,
    inertia: Inertia,
}

impl Trial {
    /// The world before its first step, or what it cannot be built of.
    pub fn new(case: &Case) -> Result<Self, String> {
        let (surface, half) = solid::surface(case).map_err(|unbuilt| unbuilt.name())?;
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        // Rapier's own speed limits would take energy from what flies.
        world.integration_parameters.normalized_max_linear_velocity = Real::MAX;
        let [x, y, z] = [half.x, half.y, half.z].map(scalar::narrow);
        let proxy = match case.target {
            Target::Strip | Target::Cuboid => ColliderBuilder::cuboid(x, y, z),
            Target::Sphere => ColliderBuilder::ball(z),
        };
        let below = scalar::to_vector(&(case.origin() - Vector3::z() * half.z));
        let proxy = world.colliders.insert(proxy.translation(below));
        let Means { accuracy, step_limit, .. } = case.means;
        let settings =
            WearSettings { ledger: true, accuracy, step_limit, ..WearSettings::default() };
        let mut wear = WearWorld::new(settings);
        let inserted = match case.target {
            Target::Strip => wear.insert_on_top(surface, proxy, &mut world.colliders),
            Target::Cuboid | Target::Sphere => wear.insert(surface, proxy, &mut world.colliders),
        };
        let surface = inserted.expect("a proxy");
        let top = match case.target {
            Target::Strip => 0.0,
            Target::Cuboid | Target::Sphere => half.z,
        };
        let mut trial = Self {
            world,
            wear,
            surface,
            body: RigidBodyHandle::invalid(),
            inertia: Inertia::immovable(),
        };
        trial.put(case, top)?;
        Ok(trial)
    }

    /// Puts the body above the middle of the surface, whose top is at `top` in its frame [m].
    fn put(&mut self, case: &Case, top: f64) -> Result<(), String> {
        let shape = solid::shape(case);
        let velocity = case.velocity();
        let down = -velocity.z;
        let rounding = scalar::ROUNDING * (case.origin().norm() + case.size + top);
        let is_exact = case.registered || CLEARANCE * rounding > FLIGHT * down;
        let clearance = if is_exact { 1e-9 * case.size } else { CLEARANCE * rounding };
        let gap = (case.gap_steps * case.dt * down).max(clearance);
        // The lowest point comes down on the middle.
        let lowest = solid::lowest(case, &shape);
        let above = Vector3::z() * (top + gap) - Vector3::x() * (velocity.x * gap / down);
        let position = Point3::from(above - lowest);
        let state = State { position, rotation: case.rotation, velocity, spin: Vector3::zeros() };
        let frame = self.wear.frame(self.surface, &self.world.colliders).expect("the surface");
        let place = state.placed_by(&frame).pose();
        let builder = RigidBodyBuilder::dynamic()
            .allow_fast_rotation(true)
            .can_sleep(false)
            .pose(scalar::to_pose(&place))
            .linvel(scalar::to_vector(&velocity));
        self.body = self.world.bodies.insert(builder);
        for collider in colliders(case)? {
            self.world.insert_collider(collider, Some(self.body));
        }
        let rb = &mut self.world.bodies[self.body];
        rb.recompute_mass_properties_from_colliders(&self.world.colliders);
        let local = &rb.mass_properties().local_mprops;
        let tensor = scalar::matrix(&local.reconstruct_inertia_matrix());
        self.inertia = Inertia { mass: scalar::wide(local.mass()), tensor };
        if is_exact {
            let body = Body { shape, inertia: self.inertia, state, rotation_locked: false };
            let (bodies, colliders) = (&mut self.world.bodies, &self.world.colliders);
            let placed = self.wear.place_on(self.surface, self.body, body, bodies, colliders);
            placed.expect("a dynamic body");
        }
        Ok(())
    }
}

fn colliders(case: &Case) -> Result<Vec<ColliderBuilder>, String> {
    let half = 0.5 * case.size;
    let n = scalar::narrow;
    match case.form {
        Form::Ball => Ok(vec![ColliderBuilder::ball(n(half)).mass(n(case.mass))]),
        Form::Clump => {
            let whole: f64 = CLUMP.iter().map(|(_, radius)| radius.powi(3)).sum();
            let ball = |&(x, radius): &(f64, f64)| {
                let at = scalar::to_vector(&Vector3::new(half * x, 0.0, 0.0));
                let mass = case.mass * radius.powi(3) / whole;
                ColliderBuilder::ball(n(half * radius)).translation(at).mass(n(mass))
            };
            Ok(CLUMP.iter().map(ball).collect())
        }
        Form::Cube => {
            let side = n(half / 3f64.sqrt());
            Ok(vec![ColliderBuilder::cuboid(side, side, side).mass(n(case.mass))])
        }
        Form::Needle | Form::Plate => {
            let corners: Vec<Vector> =
                solid::corners(case).iter().map(|p| scalar::to_vector(&p.coords)).collect();
            let hull = ColliderBuilder::convex_hull(&corners).ok_or("Rapier builds no hull")?;
            Ok(vec![hull.mass(n(case.mass))])
        }
    }
}

impl World for Trial {
    fn step(&mut self, dt: f64) -> Step {
        self.world.integration_parameters.dt = scalar::narrow(dt);
        let mut step = Step::default();
        if let Err(error) = self.wear.step(&mut self.world, &(), &()) {
            step.error = Some(error.to_string());
        }
        for event in self.wear.events() {
            match event {
                WearEvent::Started { .. } => step.started += 1,
                WearEvent::Failed { error, .. } => step.failed = Some(error.clone()),
                WearEvent::NotResolved { reason, .. } => step.refused = Some(reason.name()),
                _ => {}
            }
        }
        step
    }

    fn state(&self) -> State {
        let frame = self.wear.frame(self.surface, &self.world.colliders).expect("the surface");
        self.wear.state_from(&frame, self.body, &self.world.bodies).expect("the body")
    }

    fn inertia(&self) -> &Inertia {
        &self.inertia
    }

    fn surface(&self) -> &Surface {
        &self.wear[self.surface]
    }

    fn ledger(&self) -> Ledger {
        self.wear.ledger()
    }

    fn steps(&self) -> u64 {
        self.wear.counters().steps
    }

    fn is_near(&self) -> bool {
        self.wear.in_encounter(self.body)
    }

    fn resolvers(&self) -> Vec<String> {
        self.wear.reasons().map(|(by, why, count)| format!("{by:?} {why} {count}")).collect()
    }
}
