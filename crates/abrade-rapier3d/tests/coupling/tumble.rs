//! A cube that is thrown on a floor again and again, and wears to a pebble.

use crate::plugin::abrade::{Material, State, Surface, SurfaceLaws, TriangleMesh};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{SurfaceId, WearEvent, WearSettings, WearWorld, scalar};
use nalgebra::{Isometry3, Matrix3, Point3, Translation3, UnitQuaternion, Vector3};

/// Edge of the cube [m].
pub const EDGE: f64 = 0.02;
/// Density of the cube [kg/m3].
pub const DENSITY: f64 = 2000.0;

/// Numbers from 0 to 1 that follow no pattern.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A vector of the unit ball.
    fn vector(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| 2.0 * self.next() - 1.0);
            if v.norm() <= 1.0 {
                return v;
            }
        }
    }
}

/// A floor whose top is z = 0, and a wearing cube that is thrown on it.
pub struct Tumbler {
    pub world: PhysicsWorld,
    pub wear: WearWorld,
    pub id: SurfaceId,
    pub cube: RigidBodyHandle,
    /// Of a throw, towards the floor [m/s].
    pub speed: f64,
    numbers: Numbers,
}

fn surface() -> Surface {
    let material = Material {
        hardness: 1e7,
        shear_ratio: 0.25,
        young: Some(2e8),
        poisson: 0.3,
        friction: 0.3,
    };
    let mesh = TriangleMesh::cuboid(Vector3::repeat(0.5 * EDGE), EDGE / 10.0).expect("a cube");
    Surface::mesh(&mesh, SurfaceLaws::of(material)).expect("a surface")
}

/// The worn mesh, checked in full: closed, and without a facet that is turned over.
fn mesh(surface: &Surface) -> TriangleMesh {
    let nodes = surface.nodes();
    let vertices = (0..nodes.len()).map(|i| nodes.position(i)).collect();
    TriangleMesh::new(vertices, surface.triangles()).expect("a mesh that bounds a solid")
}

fn sphericity(mesh: &TriangleMesh) -> f64 {
    (36.0 * std::f64::consts::PI * mesh.volume().powi(2)).cbrt() / mesh.area()
}

impl Tumbler {
    pub fn new(proxy: ColliderBuilder, body: RigidBodyBuilder, settings: WearSettings) -> Self {
        let n = scalar::narrow;
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        world.integration_parameters.dt = n(1.0 / 240.0);
        world.integration_parameters.length_unit = n(EDGE);
        let floor = ColliderBuilder::cuboid(n(3.0), n(3.0), n(0.1));
        world.colliders.insert(floor.translation(Vector::Z * n(-0.1)));
        let (cube, proxy) = world.insert(body.translation(Vector::Z * n(EDGE)), proxy);
        // What is added to the colliders' mass would count from Rapier's first step on.
        world.bodies[cube].recompute_mass_properties_from_colliders(&world.colliders);
        let mut wear = WearWorld::new(settings);
        let id = wear.insert(surface(), proxy, &mut world.colliders).expect("a proxy");
        Self { world, wear, id, cube, speed: 2.0, numbers: Numbers(7) }
    }

    /// A cube of the usual density.
    pub fn cuboid() -> Self {
        let half = scalar::narrow(0.5 * EDGE);
        let proxy = ColliderBuilder::cuboid(half, half, half).density(scalar::narrow(DENSITY));
        Self::new(proxy, RigidBodyBuilder::dynamic(), WearSettings::default())
    }

    /// Puts the cube, turned at random, just above the floor, on its way down.
    pub fn aim(&mut self) {
        let turn = UnitQuaternion::from_scaled_axis(self.numbers.vector() * 4.0);
        let nodes = self.wear[self.id].nodes();
        let height = |i: usize| (turn * nodes.position(i)).z;
        let lowest = (0..nodes.len()).map(height).fold(f64::INFINITY, f64::min);
        let at = Translation3::new(0.0, 0.0, 1e-3 * EDGE - lowest);
        let rb = &mut self.world.bodies[self.cube];
        rb.set_position(scalar::to_pose(&Isometry3::from_parts(at, turn)), true);
        let velocity = (self.numbers.vector() * 0.5 - Vector3::z()) * self.speed;
        rb.set_linvel(scalar::to_vector(&velocity), true);
        rb.set_angvel(scalar::to_vector(&(self.numbers.vector() * 20.0)), true);
    }

    pub fn step(&mut self) {
        self.wear.step(&mut self.world, &(), &()).expect("a step inside the model");
    }

    /// Steps until the cube is away from the floor, or renewed; returns what happened.
    fn strike(&mut self) -> Vec<WearEvent> {
        let mut events = Vec::new();
        let mut away = 0;
        for _ in 0..100 {
            self.step();
            events.extend_from_slice(self.wear.events());
            let ended = events.iter().any(|event| matches!(event, WearEvent::Ended { .. }));
            away += usize::from(ended);
            if away > 2 || events.contains(&WearEvent::Renewed { surface: self.id }) {
                return events;
            }
        }
        panic!("the cube has not left the floor: {:?} {events:?}", self.state());
    }

    fn throw(&mut self) -> Vec<WearEvent> {
        self.aim();
        self.strike()
    }

    pub fn state(&self) -> State {
        self.wear.state(self.cube, &self.world.bodies).expect("the cube")
    }

    /// Mass, centre in the body's frame and inertia about it, as Rapier has them.
    pub fn weighed(&self) -> (f64, Point3<f64>, Matrix3<f64>) {
        let properties = self.world.bodies[self.cube].mass_properties().local_mprops;
        let tensor = scalar::matrix(&properties.reconstruct_inertia_matrix());
        let centre = scalar::vector(properties.local_com).into();
        (scalar::wide(properties.mass()), centre, tensor)
    }
}

/// Fails for a surface that is not renewed, or renewed in the middle of a contact; for volumes that
/// no node was charged with; for a mesh that folds; for a mass that stays, and for one that Rapier
/// makes of the proxy's shape.
#[test]
fn a_cube_wears_round_and_weighs_what_is_left_of_it() {
    let mut tumbler = Tumbler::cuboid();
    let start = mesh(&tumbler.wear[tumbler.id]);
    let (mut last, mut renewals, mut worst) = (start.volume(), 0, 0.0f64);
    for number in 0..300 {
        let events = tumbler.throw();
        let refused = |event: &&WearEvent| {
            matches!(event, WearEvent::NotResolved { .. } | WearEvent::NotRenewed { .. })
        };
        assert_eq!(events.iter().find(refused), None, "throw {number}");
        if !events.contains(&WearEvent::Renewed { surface: tumbler.id }) {
            continue;
        }
        renewals += 1;
        let surface = &tumbler.wear[tumbler.id];
        let mesh = mesh(surface);
        let lost = start.volume() - mesh.volume();
        worst = worst.max((surface.wear_volume() / lost - 1.0).abs());
        assert!(mesh.volume() < last, "throw {number}: the volume grew");
        last = mesh.volume();
        let (inertia, centre) = mesh.mass_properties(DENSITY);
        let (mass, com, tensor) = tumbler.weighed();
        // Rapier's roundings, and those of sums over the facets.
        let rounding = 64.0 * scalar::ROUNDING + 1e-12;
        assert!((mass / inertia.mass - 1.0).abs() < 10.0 * rounding, "throw {number}: {mass}");
        assert!((com - centre).norm() < rounding * EDGE, "throw {number}: {com} {centre}");
        let miss = (tensor - inertia.tensor).norm() / inertia.tensor.norm();
        assert!(miss < 10.0 * rounding, "throw {number}: {miss:e}");
    }
    let round = sphericity(&mesh(&tumbler.wear[tumbler.id]));
    println!(
        "{renewals} renewals, V {:.3}, sphericity {round:.3}, {worst:.1e}",
        last / start.volume()
    );
    assert_eq!(tumbler.wear[tumbler.id].renewals(), renewals);
    assert!(renewals > 20 && last < 0.95 * start.volume(), "{renewals} {last}");
    assert!(round > sphericity(&start) + 0.02, "{round}");
    assert!(worst < 1e-3, "{worst:e}");
}
