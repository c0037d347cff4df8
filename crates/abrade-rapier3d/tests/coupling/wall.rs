//! Dynamic bodies that wear on what does not.

use crate::plugin::abrade::Hull;
use crate::plugin::abrade::{
    Body, Carrier, Encounter, EncounterSettings, Inertia, Loads, Material, Placed, Shape, State,
    Surface, SurfaceLaws, TriangleMesh, Until, cuboid_vertices,
};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{SurfaceId, WearEvent, WearSettings, WearWorld, scalar};
use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};

const EDGE: f64 = 0.02;
const DENSITY: f64 = 2000.0;

fn cube(restitution: f64) -> Surface {
    let material = Material {
        hardness: 1e7,
        shear_ratio: 0.25,
        young: Some(1e9),
        poisson: 0.3,
        friction: 0.3,
    };
    let laws = SurfaceLaws { restitution, ..SurfaceLaws::of(material) };
    let mesh = TriangleMesh::cuboid(Vector3::repeat(0.5 * EDGE), EDGE / 10.0).expect("a cube");
    Surface::mesh(&mesh, laws).expect("a surface")
}

fn inertia() -> Inertia {
    let mass = DENSITY * EDGE.powi(3);
    Inertia { mass, tensor: Matrix3::from_diagonal_element(mass * EDGE * EDGE / 6.0) }
}

/// A floor whose top is z = 0, and a wearing cube above it in `state`.
struct Rig {
    world: PhysicsWorld,
    wear: WearWorld,
    id: SurfaceId,
    cube: RigidBodyHandle,
}

impl Rig {
    fn new(state: &State, restitution: f64, gravity: f64, dt: f64) -> Self {
        let n = scalar::narrow;
        let mut world =
            PhysicsWorld { gravity: Vector::Z * n(-gravity), ..PhysicsWorld::default() };
        world.integration_parameters.dt = n(dt);
        world.integration_parameters.length_unit = n(EDGE);
        world.integration_parameters.normalized_max_linear_velocity = n(1e6);
        let floor = ColliderBuilder::cuboid(n(3.0), n(3.0), n(0.1));
        world.colliders.insert(floor.translation(Vector::Z * n(-0.1)));
        let body = RigidBodyBuilder::dynamic()
            .translation(scalar::to_vector(&state.position.coords))
            .rotation(scalar::to_vector(&state.rotation.scaled_axis()))
            .linvel(scalar::to_vector(&state.velocity))
            .angvel(scalar::to_vector(&state.spin));
        let half = n(0.5 * EDGE);
        let proxy = ColliderBuilder::cuboid(half, half, half).density(n(DENSITY));
        let (body, proxy) = world.insert(body, proxy);
        let mut wear = WearWorld::new(WearSettings { ledger: true, ..WearSettings::default() });
        let id = wear.insert(cube(restitution), proxy, &mut world.colliders).expect("a proxy");
        Self { world, wear, id, cube: body }
    }

    fn step(&mut self) {
        self.wear.step(&mut self.world, &(), &()).expect("a step inside the model");
    }

    fn state(&self) -> State {
        self.wear.state(self.cube, &self.world.bodies).expect("the cube")
    }
}

fn thrown() -> State {
    State {
        position: Point3::new(0.0, 0.0, 0.025),
        rotation: UnitQuaternion::from_scaled_axis(Vector3::new(0.4, 0.3, 0.1)),
        velocity: Vector3::new(2.0, 1.0, -10.0),
        spin: Vector3::new(20.0, -30.0, 10.0),
    }
}

/// Fails for a wall that Rapier pushes the cube off once more, one that is cut where the cube
/// meets it, and a cube that is not carried by its exact state.
#[test]
fn a_cube_wears_on_a_floor_as_in_the_core() {
    let mut surface = cube(1.0);
    let half = Vector3::new(3.0, 3.0, 0.1);
    let (hull, _, _) = Hull::solid(&cuboid_vertices(&half), 1.0).expect("a floor");
    let mut floor = Body {
        shape: Shape::hull(hull),
        inertia: Inertia::immovable(),
        state: State::at(Point3::new(0.0, 0.0, -0.1)),
        rotation_locked: false,
    };
    let settings = EncounterSettings::default();
    let mut encounter = Encounter::new(&floor, [&surface], settings).expect("an encounter");
    let (loads, until) = (Loads::default(), Until::Duration);
    let state = thrown();
    let carrier = Some(Carrier { state, inertia: Some(inertia()), loads });
    let mut placed = [Placed { surface: &mut surface, pose: state.pose(), carrier, skin: None }];
    encounter.advance(&mut floor, &mut placed, &loads, 1e-2, until, &mut ()).expect("a contact");
    let end = placed[0].carrier.expect("the cube").state;
    let wear = surface.wear_volume();
    for dt in [1.0 / 60.0, 1e-3, 1e-4] {
        let mut rig = Rig::new(&thrown(), 1.0, 0.0, dt);
        for _ in 0..(1e-2 / dt).ceil() as u32 {
            rig.step();
        }
        let state = rig.state();
        let dv = (state.velocity - end.velocity).norm() / 10.0;
        let dw = rig.wear[rig.id].wear_volume() / wear - 1.0;
        println!("dt {dt:.1e}: v {dv:.1e} W {dw:.1e} {:?}", rig.wear.counters());
        assert!(dv < 2e-3 && dw.abs() < 5e-3, "{dt:e}: {dv:e} {dw:e}");
    }
}

/// Fails for a cube that gains energy, sinks in, or is left to Rapier without a word.
#[test]
fn a_cube_comes_to_rest_on_a_floor_and_wears_at_every_bounce() {
    let mut rig = Rig::new(&thrown(), 0.5, 9.81, 1.0 / 60.0);
    let energy =
        |state: &State| inertia().kinetic_energy(state) + inertia().mass * 9.81 * state.position.z;
    let (mut last, mut worn, mut booked) = (energy(&thrown()), 0.0, 0.0);
    for _ in 0..45 {
        rig.step();
        let now = energy(&rig.state());
        // What time integration makes has a bucket of its own.
        let numerical = rig.wear.ledger().numerical();
        let gained = (numerical - booked).abs() + 1e-6 * energy(&thrown());
        assert!(now < last + gained, "{now} J after {last} J, {gained} J");
        booked = numerical;
        last = now;
        let volume = rig.wear[rig.id].wear_volume();
        assert!(volume >= worn);
        worn = volume;
        for event in rig.wear.events() {
            assert!(!matches!(event, WearEvent::NotResolved { .. }), "{event:?}");
        }
        assert!(rig.state().position.z > 0.3 * EDGE, "{:?}", rig.state());
    }
    let paid = 1e7 * worn / energy(&thrown());
    println!("H W / E {paid:.3}, {:?}, {:?}", rig.state(), rig.wear.counters());
    assert!((0.3..1.0).contains(&paid), "{paid}");
    println!("numerical {:.1e}", booked / energy(&thrown()));
    assert!(last < 0.02 * energy(&thrown()), "{last}");
    assert!(booked.abs() < 5e-3 * energy(&thrown()), "{booked}");
}

/// Fails for springs of a cube on a wall that go on storing energy once the cube was taken away.
#[test]
fn springs_on_a_wall_store_nothing_once_the_cube_is_away() {
    let mut rig = Rig::new(&thrown(), 1.0, 0.0, 1e-5);
    let energy = inertia().kinetic_energy(&thrown());
    while rig.wear.ledger().elastic < 1e-4 * energy {
        rig.step();
    }
    rig.world.bodies[rig.cube].set_translation(Vector::Z, true);
    rig.step();
    let ledger = rig.wear.ledger();
    assert!(ledger.elastic.abs() < 1e-12 * energy, "{ledger:?}");
}
