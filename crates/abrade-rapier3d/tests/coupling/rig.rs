//! A Rapier world with one wear plate, and a ball for it: the "impact" set-up of the paper on the
//! default foundation.

use crate::plugin::abrade::{
    Advance, Body, Encounter, EncounterSettings, HexStrip, Inertia, Loads, Material, Placed, Shape,
    State, Surface, SurfaceLaws, Until,
};
use crate::plugin::rapier::math::Vector;
use crate::plugin::rapier::prelude::*;
use crate::plugin::{Resolve, SurfaceId, WearEvent, WearSettings, WearWorld, scalar};
use nalgebra::{Isometry3, Point3, Vector3};

/// Radius of the ball [m].
pub const RADIUS: f64 = 3e-3;
/// Density of the ball [kg/m3].
pub const DENSITY: f64 = 2500.0;
/// Distance between the ball and the plate at the start [m].
pub const GAP: f64 = 1e-6;
/// Half the thickness of the plate's proxy [m].
pub const HALF_THICKNESS: f64 = 0.01;

/// Rapier's world, the wear beside it, and the plate.
pub struct Rig {
    pub world: PhysicsWorld,
    pub wear: WearWorld,
    pub plate: SurfaceId,
    pub proxy: ColliderHandle,
}

/// Of the plate under one ball.
pub const STRIP: HexStrip =
    HexStrip { length: 30e-3, width: 12e-3, pitch: 0.1e-3, rest_area: None };

pub fn surface() -> Surface {
    plate(STRIP)
}

fn plate(strip: HexStrip) -> Surface {
    plate_of(strip, 1.0)
}

/// A plate whose springs give back a share of the speed below yield.
pub fn plate_of(strip: HexStrip, restitution: f64) -> Surface {
    let material = Material {
        hardness: 6.6e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.5,
    };
    let laws = SurfaceLaws { restitution, ..SurfaceLaws::of(material) };
    Surface::hex_strip(strip, laws).expect("a plate")
}

impl Rig {
    /// A plate whose top is at `origin`, no gravity, steps of `dt` [s].
    pub fn new(origin: Vector3<f64>, dt: f64) -> Self {
        Self::resolved_by(Resolve::Auto, origin, dt)
    }

    /// The same, with the given resolvers.
    pub fn resolved_by(resolve: Resolve, origin: Vector3<f64>, dt: f64) -> Self {
        Self::of(surface(), [15e-3, 6e-3], resolve, origin, dt)
    }

    /// Resolved by Micro, with that many steps of a contact in one of `dt` [s] at most.
    pub fn limited(step_limit: u64, dt: f64) -> Self {
        let mut rig = Self::new(Vector3::zeros(), dt);
        let resolve = Resolve::Micro;
        rig.wear = WearWorld::new(WearSettings { resolve, step_limit, ..WearSettings::default() });
        let plate = rig.wear.insert_on_top(surface(), rig.proxy, &mut rig.world.colliders);
        rig.plate = plate.expect("a proxy");
        rig
    }

    /// Asserts that the last step was one in which a contact began and failed, and that what it wore is told.
    pub fn assert_that_failure_tells_wear(&self) {
        let events = self.wear.events();
        let [WearEvent::Started { .. }, WearEvent::Ended { volume, .. }, WearEvent::Failed { .. }] =
            events
        else {
            panic!("{events:?}")
        };
        let displaced = self.wear[self.plate].worn().displaced();
        assert!(displaced > 0.0 && (volume / displaced - 1.0).abs() < 1e-9, "{volume:e}");
    }

    /// A plate for many balls, at the origin.
    pub fn wide(dt: f64) -> Self {
        let strip = HexStrip { length: 150e-3, width: 150e-3, pitch: 0.5e-3, rest_area: None };
        Self::of(plate(strip), [75e-3; 2], Resolve::Micro, Vector3::zeros(), dt)
    }

    pub fn of(
        surface: Surface,
        half: [f64; 2],
        resolve: Resolve,
        origin: Vector3<f64>,
        dt: f64,
    ) -> Self {
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        world.integration_parameters.dt = scalar::narrow(dt);
        let h = scalar::narrow(HALF_THICKNESS);
        let below = scalar::to_vector(&(origin - Vector3::z() * HALF_THICKNESS));
        let cuboid = ColliderBuilder::cuboid(scalar::narrow(half[0]), scalar::narrow(half[1]), h);
        let proxy = world.colliders.insert(cuboid.translation(below));
        let settings = WearSettings { ledger: true, resolve, ..WearSettings::default() };
        let mut wear = WearWorld::new(settings);
        let plate = wear.insert_on_top(surface, proxy, &mut world.colliders).expect("a proxy");
        Self { world, wear, plate, proxy }
    }

    /// A ball in Rapier alone, at `at` [m], with `velocity` [m/s].
    pub fn ball(&mut self, at: Vector3<f64>, velocity: Vector3<f64>) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic()
            .translation(scalar::to_vector(&at))
            .linvel(scalar::to_vector(&velocity));
        let ball = ColliderBuilder::ball(scalar::narrow(RADIUS)).density(scalar::narrow(DENSITY));
        self.world.insert(body, ball).0
    }

    /// State of a body in the plate's frame.
    pub fn state(&self, body: RigidBodyHandle) -> State {
        let frame = self.wear.frame(self.plate, &self.world.colliders).expect("the plate");
        self.wear.state_from(&frame, body, &self.world.bodies).expect("the body")
    }

    pub fn step(&mut self) {
        self.wear.step(&mut self.world, &(), &()).expect("a step inside the model");
    }

    /// The collider of a body that has one.
    pub fn collider(&self, body: RigidBodyHandle) -> ColliderHandle {
        self.world.bodies[body].colliders()[0]
    }
}

/// A velocity of `speed` [m/s] at `angle` [deg] from the plate, towards +x.
pub fn towards_plate(speed: f64, angle: f64) -> Vector3<f64> {
    let (sin, cos) = angle.to_radians().sin_cos();
    Vector3::new(speed * cos, 0.0, -speed * sin)
}

/// The ball of the core, `GAP` above the plate, in the plate's frame.
pub fn body(velocity: Vector3<f64>) -> Body {
    let state = State::at(Point3::new(0.0, 0.0, RADIUS + GAP));
    Body {
        shape: Shape::ball(RADIUS).expect("a ball"),
        inertia: Inertia::of_ball(RADIUS, DENSITY),
        state: State { velocity, ..state },
        rotation_locked: false,
    }
}

/// What the core makes of the impact on its own, from a state in the plate's frame: velocity
/// [m/s], spin [rad/s], wear volume [m3].
pub fn by_core(start: State) -> (Vector3<f64>, Vector3<f64>, f64) {
    let (mut body, mut surface) = (body(start.velocity), surface());
    body.state = start;
    let settings = EncounterSettings::default();
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let until = Until::Duration;
    let advance: Advance = encounter
        .advance(&mut body, &mut placed, &Loads::default(), 1e-3, until, &mut ())
        .expect("an impact");
    assert!(advance.contact_time > 0.0);
    (body.state.velocity, body.state.spin, surface.wear_volume())
}
