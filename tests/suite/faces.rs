//! Springs under faces stay in balance with their body, or the contact says that they do not.

use abrade::{
    Body, ElasticLaw, Encounter, EncounterSettings, HexStrip, Hull, Inertia, Ledger, Loads,
    Material, PhysicsError, Placed, Shape, State, Surface, SurfaceLaws, Until, cuboid_vertices,
};
use nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion, Vector3};

use crate::rig::projected;

/// A body with faces whose lowest corner comes down on the middle of a plate.
struct Case {
    corners: Vec<Point3<f64>>,
    mass: f64,
    xyzw: [f64; 4],
    velocity: Vector3<f64>,
    material: Material,
    strip: HexStrip,
}

impl Case {
    /// The ledger after the impact, over the energy at the start [-].
    fn run(&self) -> Result<f64, PhysicsError> {
        let (hull, inertia, _) = Hull::solid(&self.corners, 1.0).expect("a hull");
        let inertia =
            Inertia { mass: self.mass, tensor: inertia.tensor * (self.mass / inertia.mass) };
        let [x, y, z, w] = self.xyzw;
        let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        let lowest = hull.vertices().iter().map(|corner| rotation * corner.coords);
        let lowest = lowest.min_by(|a, b| a.z.total_cmp(&b.z)).expect("a corner");
        let start = Point3::from(Vector3::z() * (1e-3 * self.strip.pitch) - lowest);
        let state = State { rotation, velocity: self.velocity, ..State::at(start) };
        let shape = Shape::hull(hull);
        let mut body = Body { shape, inertia, state, rotation_locked: false };
        let elastic = ElasticLaw::Foundation { stiffness: None };
        let laws =
            SurfaceLaws { elastic, flow: projected(), ..SurfaceLaws::of(self.material.clone()) };
        let mut plate = Surface::hex_strip(self.strip, laws).expect("a plate");
        let settings = EncounterSettings { ledger: true, ..EncounterSettings::default() };
        let mut encounter = Encounter::new(&body, [&plate], settings)?;
        let mut placed = [Placed::at_rest(&mut plate, Isometry3::identity())];
        let time = 1e3 * self.strip.pitch / self.velocity.norm();
        let loads = Loads::default();
        encounter.advance(&mut body, &mut placed, &loads, time, Until::FirstExit, &mut ())?;
        let ledger: &Ledger = encounter.ledger();
        Ok(ledger.numerical() / inertia.kinetic_energy(&state))
    }
}

fn material(young: f64, hardness: f64, friction: f64) -> Material {
    Material { hardness, shear_ratio: 0.25, young: Some(young), poisson: 0.3, friction }
}

/// A thin plate that comes down on a corner, of friction so high that it hardly slips. Fails for
/// friction that turns the slip back within a step: it takes a quarter of the energy on top.
#[test]
fn friction_that_stops_a_face_takes_no_more_than_there_is() {
    let case = Case {
        corners: cuboid_vertices(&Vector3::new(16.6e-6, 16.6e-6, 0.83e-6)),
        mass: 1.48e-13,
        xyzw: [0.89063, 0.08685, -0.18568, -0.40591],
        velocity: Vector3::new(0.1039, 0.0, -0.0954),
        material: material(77.65e6, 7.395e6, 1.348),
        strip: HexStrip { length: 1.72e-6, width: 1.7e-6, pitch: 7.08e-8, rest_area: None },
    };
    let numerical = case.run().expect("an impact");
    assert!(numerical.abs() < 0.02, "{numerical:e}");
}

/// A needle on nodes as far apart as it is thick there: faces come upon whole columns at once, of which it never paid the springs.
/// Fails for a contact that goes on with energy out of nothing, twenty times its own.
#[test]
fn a_point_on_coarse_nodes_is_an_error_not_a_gain() {
    let axes = [Vector3::x(), 0.05 * Vector3::y(), 0.05 * Vector3::z()];
    let half = 2.28e-3;
    let tips = axes.iter().flat_map(|a| [Point3::from(half * a), Point3::from(-half * a)]);
    let case = Case {
        corners: tips.collect(),
        mass: 7.87e-5,
        xyzw: [0.54387, 0.52066, -0.65157, -0.09258],
        velocity: Vector3::new(1.977e-3, 0.0, -1.314e-3),
        material: material(2.56e6, 11.9e9, 0.34),
        strip: HexStrip { length: 117e-6, width: 110e-6, pitch: 4.57e-6, rest_area: None },
    };
    let error = case.run().expect_err("springs out of balance");
    assert!(matches!(error, PhysicsError::Unbalanced { .. }), "{error}");
}

/// A cube that comes down flat, above yield. Fails for a contact that is given up where the body turns,
/// with its springs full: then nothing comes back.
#[test]
fn a_flat_cube_gets_back_what_its_springs_hold() {
    let (half, speed, stiffness) = (1e-3, 200.0, 1e14);
    let material = material(200e9, 1.7e9, 0.0);
    let elastic = ElasticLaw::Foundation { stiffness: Some(stiffness) };
    let hardness = material.hardness;
    let laws = SurfaceLaws { elastic, flow: projected(), ..SurfaceLaws::of(material) };
    let strip = HexStrip { length: 4e-3, width: 4e-3, pitch: 0.1e-3, rest_area: None };
    let mut plate = Surface::hex_strip(strip, laws).expect("a plate");
    let (hull, inertia, _) =
        Hull::solid(&cuboid_vertices(&Vector3::repeat(half)), 8000.0).expect("a cube");
    let start = Point3::new(0.013e-3, 0.027e-3, half + 1e-9);
    let state = State { velocity: -Vector3::z() * speed, ..State::at(start) };
    let shape = Shape::hull(hull);
    let mut body = Body { shape, inertia, state, rotation_locked: true };
    let settings = EncounterSettings { ledger: true, ..EncounterSettings::default() };
    let mut encounter = Encounter::new(&body, [&plate], settings).expect("columns");
    let mut placed = [Placed::at_rest(&mut plate, Isometry3::identity())];
    let loads = Loads::default();
    let done = encounter
        .advance(&mut body, &mut placed, &loads, 1e-3, Until::FirstExit, &mut ())
        .expect("an impact");
    let nodes = placed[0].surface.nodes();
    let below = |x: &Point3<f64>| (x.x - start.x).abs() < half && (x.y - start.y).abs() < half;
    let places = nodes.rest_position.iter().zip(&nodes.rest_area);
    let area: f64 = places.filter(|(x, _)| below(x)).map(|(_, area)| area).sum();
    let held = 0.5 * hardness * hardness / stiffness * area;
    let left = inertia.kinetic_energy(&body.state);
    println!("{left:e} J of {held:e} J, worn {:e} J", encounter.ledger().wear);
    assert!(done.exited && body.state.velocity.z > 0.0);
    assert!(encounter.ledger().wear > 10.0 * held);
    assert!((left / held - 1.0).abs() < 0.02, "{left:e} of {held:e}");
}

/// Fails for a step that the springs place but whose weight falls as if they did not: the body hops
/// higher and higher.
#[test]
fn a_box_that_hops_under_its_weight_gains_nothing() {
    let (half, pitch, gravity) = (2e-3, 0.2e-3, 10.0);
    let (hull, inertia, _) =
        Hull::solid(&cuboid_vertices(&Vector3::repeat(half)), 8e3).expect("a box");
    let material =
        Material { hardness: 1e9, shear_ratio: 0.25, young: None, poisson: 0.3, friction: 0.0 };
    let stiffness = 1e12;
    let elastic = ElasticLaw::Foundation { stiffness: Some(stiffness) };
    let laws = SurfaceLaws { elastic, flow: projected(), ..SurfaceLaws::of(material) };
    let strip = HexStrip { length: 10e-3, width: 10e-3, pitch, rest_area: None };
    let mut plate = Surface::hex_strip(strip, laws).expect("a plate");
    // How deep the springs give way under the weight.
    let sunk = inertia.mass * gravity / (stiffness * 4.0 * half * half);
    let state = State::at(Point3::new(0.0, 0.0, half + sunk));
    let mut body = Body { shape: Shape::hull(hull), inertia, state, rotation_locked: true };
    let settings = EncounterSettings { ledger: true, ..EncounterSettings::default() };
    let mut encounter = Encounter::new(&body, [&plate], settings).expect("it fits");
    let mut placed = [Placed::at_rest(&mut plate, Isometry3::identity())];
    let loads = Loads { gravity: -Vector3::z() * gravity, ..Loads::default() };
    let time = 200.0 * (2.0 * sunk / gravity).sqrt();
    encounter
        .advance(&mut body, &mut placed, &loads, time, Until::Duration, &mut ())
        .expect("it hops");
    let gained = -encounter.ledger().numerical() / (body.inertia.mass * gravity * sunk);
    println!("after some 50 hops {gained:.1e} of the weight over its sinking");
    assert!(gained.abs() < 1e-2 && plate.wear_volume() == 0.0, "{gained:e}");
}
