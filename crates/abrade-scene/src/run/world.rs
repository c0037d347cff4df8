//! A scene in a Rapier world. Compiled once per precision: `super::plug` is the plug-in.

use std::collections::{BTreeMap, HashMap};

use abrade::{Body, Drive, Driven, Ledger, Piece, State, Surface, Until};
use nalgebra::{Isometry3, Vector3};

use super::plug;
use super::plug::rapier::dynamics::{MassProperties, RigidBodyBuilder, RigidBodyHandle};
use super::plug::rapier::geometry::{ColliderBuilder, TriMeshFlags};
use super::plug::rapier::math::Real;
use super::plug::rapier::pipeline::PhysicsWorld;
use super::plug::{
    MicroStep, SurfaceId, WearError, WearEvent, WearObserver, WearSettings, WearWorld, scalar,
};
use crate::build::{Built, BuiltSurface, StandIn};
use crate::carrier::BuiltCarrier;
use crate::run::RunError;
use crate::run::engine::{Counts, Ended, Engine, Met, Sample, Stepped, Stretch, Watch};
use crate::run::extent::{length_unit, volume_sum};
use crate::scene::Resolve;

/// Thickness of a plate's proxy in lengths of the plate.
const THICKNESS: f64 = 0.2;

/// A scene in a Rapier world.
pub(crate) struct World {
    world: PhysicsWorld,
    wear: WearWorld,
    surfaces: Vec<SurfaceId>,
    surface_names: Vec<String>,
    /// The bodies that moving surfaces are on.
    carriers: Vec<Option<RigidBodyHandle>>,
    bodies: Vec<Presence>,
    body_names: Vec<String>,
    /// Only looked up, so its order reaches no number.
    indices: HashMap<RigidBodyHandle, usize>,
    driven: Vec<bool>,
}

/// Where a body is.
enum Presence {
    /// Its time has not come.
    Waits(Box<Body>),
    There(RigidBodyHandle),
    /// It has left, in this state.
    Gone(State),
}

impl Presence {
    fn handle(&self) -> Option<RigidBodyHandle> {
        match self {
            Self::There(handle) => Some(*handle),
            Self::Waits(_) | Self::Gone(_) => None,
        }
    }
}

/// What a scene asks of its world.
pub(crate) struct Wishes<'a> {
    pub gravity: [f64; 3],
    pub accuracy: f64,
    pub resolve: Resolve,
    pub ledger: bool,
    pub until: Until,
    /// Drives by body name, with the index of the surface.
    pub drives: &'a BTreeMap<String, (usize, Drive)>,
    /// When bodies of streams come, by name [s].
    pub due: &'a BTreeMap<String, f64>,
}

impl World {
    pub(crate) fn new(built: Built, wishes: &Wishes<'_>) -> Result<Self, RunError> {
        let mut world = PhysicsWorld {
            gravity: scalar::to_vector(&Vector3::from(wishes.gravity)),
            ..PhysicsWorld::default()
        };
        let parameters = &mut world.integration_parameters;
        parameters.normalized_max_linear_velocity = Real::MAX;
        parameters.length_unit = scalar::narrow(length_unit(&built));
        let settings = WearSettings {
            accuracy: wishes.accuracy,
            ledger: wishes.ledger,
            until: wishes.until,
            resolve: match wishes.resolve {
                Resolve::Auto => plug::Resolve::Auto,
                Resolve::Micro => plug::Resolve::Micro,
                Resolve::QuasiStatic => plug::Resolve::QuasiStatic,
                Resolve::Lockstep => plug::Resolve::Lockstep,
            },
            ..WearSettings::default()
        };
        let mut scene = Self {
            world,
            wear: WearWorld::new(settings),
            surfaces: Vec::new(),
            surface_names: Vec::new(),
            carriers: Vec::new(),
            bodies: Vec::new(),
            body_names: Vec::new(),
            indices: HashMap::new(),
            driven: Vec::new(),
        };
        for (name, surface) in built.surfaces {
            scene.surface_names.push(name);
            scene.add_surface(surface)?;
        }
        for (name, body) in built.bodies {
            let (drive, waits) = (wishes.drives.get(&name), wishes.due.contains_key(&name));
            scene.body_names.push(name);
            scene.driven.push(drive.is_some());
            let index = scene.bodies.len();
            scene.bodies.push(Presence::Gone(body.state));
            match waits {
                true => scene.bodies[index] = Presence::Waits(Box::new(body)),
                false => scene.add_body(index, body, drive)?,
            }
        }
        Ok(scene)
    }

    /// Puts the surface on a collider of the undeformed solid.
    fn add_surface(&mut self, built: BuiltSurface) -> Result<(), RunError> {
        let (proxy, offset) = match built.stand_in {
            StandIn::Plate => box_below(&built.surface),
            solid => (solid_collider(solid, &built.surface)?, Isometry3::identity()),
        };
        let (carrier, proxy) = match &built.carrier {
            Some(carrier) => {
                // The body's mass is given: its collider adds none.
                let proxy = proxy.position(scalar::to_pose(&offset)).density(0.0);
                let body = carrier_body(carrier, &built.pose);
                let (body, proxy) = self.world.insert(body, proxy);
                let rb = &mut self.world.bodies[body];
                rb.recompute_mass_properties_from_colliders(&self.world.colliders);
                (Some(body), proxy)
            }
            None => {
                let proxy = proxy.position(scalar::to_pose(&(built.pose * offset)));
                (None, self.world.colliders.insert(proxy))
            }
        };
        self.carriers.push(carrier);
        let colliders = &mut self.world.colliders;
        let placed = self.wear.insert_at(built.surface, proxy, offset.inverse(), colliders);
        let id = placed.map_err(|error| self.explain(error))?;
        let exact = self.wear.place_surface(id, built.pose, &self.world.colliders);
        exact.map_err(|error| self.explain(error))?;
        self.surfaces.push(id);
        Ok(())
    }

    fn add_body(
        &mut self,
        index: usize,
        body: Body,
        drive: Option<&(usize, Drive)>,
    ) -> Result<(), RunError> {
        let fixed = body.inertia.is_immovable();
        let builder = match drive {
            Some(_) => RigidBodyBuilder::kinematic_position_based(),
            None if fixed => RigidBodyBuilder::fixed(),
            None => RigidBodyBuilder::dynamic(),
        };
        let mut builder = builder
            .pose(scalar::to_pose(&body.state.pose()))
            .linvel(scalar::to_vector(&body.state.velocity))
            .angvel(scalar::to_vector(&body.state.spin));
        if body.rotation_locked {
            builder = builder.lock_rotations();
        }
        let handle = self.world.bodies.insert(builder);
        let density = match fixed {
            true => 1.0,
            false => scalar::narrow(body.inertia.mass / volume_sum(&body.shape)),
        };
        for piece in body.shape.pieces() {
            let Some(collider) = collider(piece) else { continue };
            let collider = collider.density(density);
            self.world.colliders.insert_with_parent(collider, handle, &mut self.world.bodies);
        }
        self.indices.insert(handle, index);
        self.bodies[index] = Presence::There(handle);
        let done = match drive {
            Some((surface, drive)) => {
                let id = self.surfaces[*surface];
                self.wear.frame(id, &self.world.colliders).and_then(|frame| {
                    let state = body.state.seen_from(&frame);
                    let body = Body { state, ..body };
                    self.wear.drive(id, handle, body, *drive, &self.world.bodies)
                })
            }
            None if fixed => Ok(()),
            None => self.wear.place(handle, body, &mut self.world.bodies, &self.world.colliders),
        };
        done.map_err(|error| self.explain(error))
    }

    /// The error with the scene's names; the body of a surface has that of the surface.
    fn explain(&self, error: WearError) -> RunError {
        let what = error.to_string();
        let WearError::Physics { body, surface, source } = error else {
            return RunError::Engine { what };
        };
        let carried = || self.carriers.iter().position(|carrier| *carrier == Some(body));
        let name = match self.indices.get(&body) {
            Some(&index) => self.body_names.get(index),
            None => carried().and_then(|index| self.surface_names.get(index)),
        };
        let Some(body) = name else { return RunError::Engine { what } };
        let surface = self.surfaces.iter().position(|id| *id == surface);
        RunError::Physics {
            body: body.clone(),
            surface: surface.and_then(|i| self.surface_names.get(i)).cloned().unwrap_or_default(),
            reason: source,
        }
    }
}

impl Engine for World {
    fn lead(&mut self, surface: usize, stretch: &Stretch) {
        let Some(body) = self.carriers[surface] else { return };
        let substeps = self.world.integration_parameters.num_solver_iterations as f64;
        let Some(rb) = self.world.bodies.get_mut(body) else { return };
        let [velocity, spin] = velocities(stretch, &scalar::pose(rb.position()), substeps);
        rb.set_linvel(scalar::to_vector(&velocity), true);
        rb.set_angvel(scalar::to_vector(&spin), true);
    }

    fn step(&mut self, dt: f64, watch: &mut dyn Watch) -> Result<Stepped, RunError> {
        self.world.integration_parameters.dt = scalar::narrow(dt);
        let (indices, surfaces) = (&self.indices, &self.surfaces);
        let mut relay = Relay { watch, indices, surfaces, last: None };
        let report = self.wear.step_observed(&mut self.world, &(), &(), &mut relay);
        let report = report.map_err(|error| self.explain(error))?;
        let mut stepped = Stepped {
            dt: report.dt,
            exited: report.exited.is_some(),
            ended: Vec::new(),
            started: Vec::new(),
            worn: Vec::new(),
            refused: Vec::new(),
        };
        let surface_index =
            |id: SurfaceId| self.surfaces.iter().position(|other| *other == id).unwrap_or(0);
        for event in self.wear.events() {
            match event {
                WearEvent::Started { body, surface } => {
                    let begun = self.indices.get(body).map(|&b| (b, surface_index(*surface)));
                    stepped.started.extend(begun);
                }
                WearEvent::Ended { body, impulse, volume, contact_time, .. } => {
                    let index = self.indices.get(body).copied();
                    stepped.worn.extend(index.map(|b| (b, *volume)));
                    let ended =
                        Ended { body: index, impulse: *impulse, contact_time: *contact_time };
                    // A contact with several surfaces ends once for each, with the joint impulse.
                    if stepped.ended.last() != Some(&ended) {
                        stepped.ended.push(ended);
                    }
                }
                WearEvent::NotResolved { body, surface, reason } => stepped.refused.push((
                    self.indices.get(body).copied(),
                    surface_index(*surface),
                    reason.to_string(),
                )),
                WearEvent::Resolved { .. }
                | WearEvent::NoIsland { .. }
                | WearEvent::Renewed { .. }
                | WearEvent::NotRenewed { .. }
                | WearEvent::Failed { .. } => {}
            }
        }
        Ok(stepped)
    }

    fn bring(&mut self, body: usize) -> Result<(), RunError> {
        let Presence::Waits(waiting) = &self.bodies[body] else { return Ok(()) };
        let waiting = (**waiting).clone();
        self.add_body(body, waiting, None)
    }

    fn take_out(&mut self, body: usize) {
        let Some(handle) = self.bodies[body].handle() else { return };
        self.bodies[body] = Presence::Gone(self.state(body));
        self.indices.remove(&handle);
        self.world.remove_body(handle);
    }

    fn state(&self, body: usize) -> State {
        let handle = match &self.bodies[body] {
            Presence::Waits(body) => return body.state,
            Presence::Gone(state) => return *state,
            Presence::There(handle) => *handle,
        };
        let state = match self.driven[body] {
            true => self.wear.driven_state(handle, &self.world.colliders),
            false => self.wear.state(handle, &self.world.bodies),
        };
        state.unwrap_or_else(|| State::at(nalgebra::Point3::origin()))
    }

    fn surface(&self, surface: usize) -> &Surface {
        &self.wear[self.surfaces[surface]]
    }

    fn carrier(&self, surface: usize) -> Option<State> {
        self.wear.state(self.carriers[surface]?, &self.world.bodies)
    }

    fn in_contact(&self, body: usize) -> bool {
        self.bodies[body].handle().is_some_and(|handle| self.wear.in_contact(handle))
    }

    fn open_contact(&self, body: usize) -> Option<(Vector3<f64>, f64)> {
        self.wear.open_contact(self.bodies[body].handle()?)
    }

    fn has_ledger(&self, body: usize) -> bool {
        let near = |handle| self.wear.in_encounter(handle);
        self.driven[body] || self.bodies[body].handle().is_some_and(near)
    }

    fn driven(&self, body: usize) -> Option<&Driven> {
        self.wear.driven(self.bodies[body].handle()?)
    }

    fn ledger(&self) -> Ledger {
        self.wear.ledger()
    }

    fn counts(&self) -> Counts {
        let counters = self.wear.counters();
        Counts {
            micro: counters.micro,
            quasi_static: counters.quasi_static,
            lockstep: counters.lockstep,
            collision: counters.collision,
            reasons: self
                .wear
                .reasons()
                .map(|(by, why, count)| (format!("{}: {why}", by.name()), count))
                .collect(),
            steps: counters.steps,
            node_evaluations: counters.node_evaluations,
        }
    }
}

/// Passes contact steps on under the scene's indices.
struct Relay<'a> {
    watch: &'a mut dyn Watch,
    indices: &'a HashMap<RigidBodyHandle, usize>,
    surfaces: &'a [SurfaceId],
    /// The last body and its index: they come one after the other.
    last: Option<(RigidBodyHandle, usize)>,
}

impl WearObserver for Relay<'_> {
    fn micro_step(&mut self, step: &MicroStep<'_, '_>) {
        if self.last.is_none_or(|(last, _)| last != step.body) {
            self.last = self.indices.get(&step.body).map(|&index| (step.body, index));
        }
        let Some((_, body)) = self.last else { return };
        if !self.watch.looks_at(body) {
            return;
        }
        let index = |id: &SurfaceId| self.surfaces.iter().position(|other| other == id);
        let met = step.surfaces.iter().zip(step.instant.surfaces).filter_map(|(id, placed)| {
            let carrier = placed.carrier.as_ref();
            Some(Met {
                index: index(id)?,
                surface: &*placed.surface,
                carrier: carrier.map(|carrier| carrier.state.placed_by(step.frame)),
            })
        });
        let surfaces: Vec<Met<'_>> = met.collect();
        self.watch.sample(&Sample {
            body,
            time: step.time,
            state: step.state_world(),
            force: step.force_world(),
            surfaces: &surfaces,
            ledger: step.instant.ledger,
        });
    }

    fn watches(&self) -> bool {
        self.watch.watches()
    }
}

/// Rapier's body for a moving surface whose frame lies at `pose`.
fn carrier_body(carrier: &BuiltCarrier, pose: &Isometry3<f64>) -> RigidBodyBuilder {
    let builder = match &carrier.inertia {
        // Whatever its mass, it is led by this point; without one Rapier takes the collider's middle.
        None => {
            let centre = scalar::to_vector(&carrier.centre_local.coords);
            let one = MassProperties::new(centre, 1.0, scalar::to_vector(&Vector3::repeat(1.0)));
            RigidBodyBuilder::kinematic_velocity_based().additional_mass_properties(one)
        }
        Some(inertia) => {
            let (moments, turn) = inertia.principal();
            let properties = MassProperties::with_principal_inertia_frame(
                scalar::to_vector(&carrier.centre_local.coords),
                scalar::narrow(inertia.mass),
                scalar::to_vector(&moments),
                scalar::to_rotation(&turn),
            );
            RigidBodyBuilder::dynamic().additional_mass_properties(properties)
        }
    };
    builder
        .pose(scalar::to_pose(pose))
        .linvel(scalar::to_vector(&carrier.state.velocity))
        .angvel(scalar::to_vector(&carrier.state.spin))
}

/// Velocity [m/s] and spin [rad/s] that take a body, led and now at `pose`, through `stretch`; zero
/// where the path stands. Rapier turns by 2 atan(|spin| h / 2) in each of its substeps of h, so that
/// a spin of (2 / h) tan(turn / 2n) makes the whole turn in n of them.
fn velocities(stretch: &Stretch, pose: &Isometry3<f64>, substeps: f64) -> [Vector3<f64>; 2] {
    let Stretch { from, to, dt, recover } = stretch;
    let mut velocities = [Vector3::zeros(); 2];
    if *dt <= 0.0 {
        return velocities;
    }
    if from.translation != to.translation {
        let off = from.translation.vector - pose.translation.vector;
        velocities[0] = (to.translation.vector - from.translation.vector) / *dt + off / *recover;
    }
    if from.rotation != to.rotation {
        let off = (from.rotation * pose.rotation.inverse()).scaled_axis();
        let turn = (to.rotation * from.rotation.inverse()).scaled_axis();
        let half = turn.norm() / (2.0 * substeps);
        let share = if half > 0.0 { half.tan() / half } else { 1.0 };
        velocities[1] = turn * (share / dt) + off / *recover;
    }
    velocities
}

/// A box under the nodes of a plate, and its middle in the plate's frame.
fn box_below(surface: &Surface) -> (ColliderBuilder, Isometry3<f64>) {
    let [low, high] = surface.bounds();
    let size = high - low;
    let margin = surface.pitch();
    let thick = THICKNESS * size.amax() + margin;
    let middle = low + size * 0.5 - Vector3::z() * (0.5 * thick);
    let half = [0.5 * size.x + margin, 0.5 * size.y + margin, 0.5 * thick].map(scalar::narrow);
    let proxy = ColliderBuilder::cuboid(half[0], half[1], half[2]);
    (proxy, Isometry3::translation(middle.x, middle.y, middle.z))
}

/// The collider of a solid, in the frame of its surface.
fn solid_collider(solid: StandIn, surface: &Surface) -> Result<ColliderBuilder, RunError> {
    Ok(match solid {
        StandIn::Ball { radius } => ColliderBuilder::ball(scalar::narrow(radius)),
        StandIn::Cuboid { half_extents } => {
            let [x, y, z] = half_extents.map(scalar::narrow);
            ColliderBuilder::cuboid(x, y, z)
        }
        StandIn::Capsule { radius, half_length } => {
            ColliderBuilder::capsule_z(scalar::narrow(half_length), scalar::narrow(radius))
        }
        StandIn::Plate | StandIn::Facets => {
            let nodes = surface.nodes().rest_position.iter();
            let corners = nodes.map(|node| scalar::to_vector(&node.coords)).collect();
            let flags = TriMeshFlags::ORIENTED | TriMeshFlags::FIX_INTERNAL_EDGES;
            ColliderBuilder::trimesh_with_flags(corners, surface.triangles(), flags)
                .map_err(|error| RunError::Engine { what: error.to_string() })?
        }
    })
}

/// Rapier's collider for a piece about the centre of mass.
fn collider(piece: &Piece) -> Option<ColliderBuilder> {
    match piece {
        Piece::Ball(ball) => Some(
            ColliderBuilder::ball(scalar::narrow(ball.radius))
                .translation(scalar::to_vector(&ball.centre.coords)),
        ),
        Piece::Hull(hull) => {
            let points: Vec<_> =
                hull.vertices().iter().map(|v| scalar::to_vector(&v.coords)).collect();
            ColliderBuilder::convex_hull(&points)
        }
    }
}
