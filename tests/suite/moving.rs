//! Surfaces that move: the same contact seen from two frames, momentum and energy of the pair.

use abrade::{
    Ball, Body, Carrier, ElasticLaw, Encounter, EncounterSettings, FlowLaw, HexStrip, Inertia,
    Lateral, Ledger, Loads, Material, Piece, Placed, Polyhedron, Shape, State, Surface,
    SurfaceLaws, Until,
};
use nalgebra::{Isometry3, Matrix3, Point3, UnitQuaternion, Vector3};

use crate::theory::hull;

const MASS: f64 = 0.02;

/// Bodies about one unit across.
fn bodies() -> Vec<(&'static str, Shape, Inertia)> {
    let (cube, heavy) = hull(&Polyhedron::Cube.vertices(1.0), MASS);
    let clump = [[0.25, 0.0, 0.0, 0.3], [-0.25, 0.05, 0.0, 0.25], [0.0, -0.1, 0.2, 0.3]];
    let balls =
        clump.map(|[x, y, z, radius]| Piece::Ball(Ball { centre: Point3::new(x, y, z), radius }));
    let tensor = Matrix3::from_diagonal(&Vector3::new(0.6e-3, 1.3e-3, 1.5e-3));
    let density = MASS / (std::f64::consts::PI / 6.0);
    vec![
        ("ball", Shape::ball(0.5).expect("a ball"), Inertia::of_ball(0.5, density)),
        ("cube", cube, heavy),
        ("clump", Shape::union(balls.into()).expect("a clump"), Inertia { mass: MASS, tensor }),
    ]
}

/// Laws of every way in which a contact is computed.
fn laws() -> Vec<(&'static str, SurfaceLaws)> {
    let material = Material {
        hardness: 1.0,
        shear_ratio: 0.25,
        young: Some(100.0),
        poisson: 0.3,
        friction: 0.2,
    };
    let sprung = SurfaceLaws {
        elastic: ElasticLaw::Foundation { stiffness: Some(300.0) },
        flow: FlowLaw::CapozzaHanley { lateral: Lateral::Projected },
        ..SurfaceLaws::of(material.clone())
    };
    let rigid = SurfaceLaws {
        elastic: ElasticLaw::Rigid,
        flow: FlowLaw::NormalPressure {},
        ..SurfaceLaws::of(material)
    };
    let damped = SurfaceLaws { restitution: 0.6, ..sprung.clone() };
    vec![("springs", sprung), ("rigid", rigid), ("damped", damped)]
}

/// A body and the plate that it meets, each in its state.
struct Meeting {
    shape: Shape,
    inertia: Inertia,
    laws: SurfaceLaws,
    state: State,
    pose: Isometry3<f64>,
    carrier: Option<Carrier>,
    /// Of the plate's nodes.
    pitch: f64,
}

/// What is left of a meeting.
struct Parting {
    surface: Surface,
    body: Body,
    carrier: Option<Carrier>,
    ledger: Ledger,
}

impl Meeting {
    /// A body that comes down at unit speed, 60 degrees from the surface, turning.
    fn new(shape: &Shape, inertia: Inertia, laws: &SurfaceLaws) -> Self {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 0.2));
        let lowest = shape.lowest(&rotation, &Vector3::z());
        let state = State {
            position: Point3::new(0.003, 0.001, 1e-3 - lowest),
            rotation,
            velocity: Vector3::new(0.5, 0.0, -0.75f64.sqrt()),
            spin: Vector3::new(0.1, 0.4, -0.3),
        };
        let pose = Isometry3::identity();
        Self {
            shape: shape.clone(),
            inertia,
            laws: laws.clone(),
            state,
            pose,
            carrier: None,
            pitch: 0.03,
        }
    }

    /// Through `time` in calls of `step`.
    fn run(self, time: f64, step: f64) -> Parting {
        let strip = HexStrip { length: 3.0, width: 2.0, pitch: self.pitch, rest_area: None };
        let mut surface = Surface::hex_strip(strip, self.laws).expect("a plate");
        let mut body = Body {
            shape: self.shape,
            inertia: self.inertia,
            state: self.state,
            rotation_locked: false,
        };
        let settings = EncounterSettings { ledger: true, accuracy: 1e-3, ..Default::default() };
        let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
        let mut placed =
            [Placed { surface: &mut surface, pose: self.pose, carrier: self.carrier, skin: None }];
        for _ in 0..(time / step).round() as u32 {
            let (loads, until) = (Loads::default(), Until::Duration);
            encounter
                .advance(&mut body, &mut placed, &loads, step, until, &mut ())
                .expect("a contact");
        }
        let [Placed { carrier, .. }] = placed;
        Parting { ledger: *encounter.ledger(), surface, body, carrier }
    }
}

/// Every body under every law.
fn cases() -> Vec<(String, Meeting)> {
    let mut cases = Vec::new();
    for (body, shape, inertia) in bodies() {
        for (name, laws) in laws() {
            cases.push((format!("{body} {name}"), Meeting::new(&shape, inertia, &laws)));
        }
    }
    cases
}

/// A carrier of the plate at `state`.
fn carrier(state: State, inertia: Option<Inertia>) -> Option<Carrier> {
    Some(Carrier { state, inertia, loads: Loads::default() })
}

/// A plate of `mass` about its centre, which lies 0.1 below the nodes and a little aside.
fn slab(mass: f64) -> (State, Inertia) {
    let tensor = Matrix3::from_diagonal(&Vector3::new(0.4, 0.8, 1.1)) * mass;
    (State::at(Point3::new(0.05, -0.03, -0.1)), Inertia { mass, tensor })
}

/// Fails for a force, a gate, a step or a turning point that goes by the body's own velocity
/// instead of that over the surface.
#[test]
fn a_struck_plate_wears_as_one_that_strikes() {
    let boost = Vector3::new(-0.7, 0.4, 1.3);
    for (name, case) in cases() {
        let at_rest = Meeting { carrier: None, ..copy(&case) }.run(0.6, 0.05);
        for free in [false, true] {
            let (mut state, inertia) = slab(1e6 * MASS);
            state.velocity = boost;
            let mut moving = copy(&case);
            moving.state.velocity += boost;
            moving.carrier = carrier(state, free.then_some(inertia));
            let end = moving.run(0.6, 0.05);
            let [w, v] = [
                end.surface.wear_volume() / at_rest.surface.wear_volume() - 1.0,
                (end.body.state.velocity - boost - at_rest.body.state.velocity).norm(),
            ];
            println!("{name} free {free}: W {w:.1e} v {v:.1e}");
            assert!(w.abs() < 1e-4 && v < 1e-3, "{name} free {free}: W {w:e} v {v:e}");
        }
    }
}

/// Fails for a reaction with a wrong lever or of another instant than the force.
#[test]
fn a_body_and_its_free_plate_keep_their_momentum() {
    for (name, mut case) in cases() {
        let (mut state, inertia) = slab(3.0 * MASS);
        state.spin = Vector3::new(-0.05, 0.02, 0.1);
        case.carrier = carrier(state, Some(inertia));
        let momentum = |body: (&State, &Inertia), plate: (&State, &Inertia)| {
            let of = |(state, inertia): (&State, &Inertia)| {
                let p = state.velocity * inertia.mass;
                let spin = state.rotation.inverse_transform_vector(&state.spin);
                let turning = state.rotation * (inertia.tensor * spin);
                [p, state.position.coords.cross(&p) + turning]
            };
            let (a, b) = (of(body), of(plate));
            [a[0] + b[0], a[1] + b[1]]
        };
        let (start, mass) = (case.state, case.inertia);
        let before = momentum((&start, &mass), (&state, &inertia));
        let end = case.run(0.6, 0.05);
        let plate = end.carrier.expect("the plate").state;
        let after = momentum((&end.body.state, &mass), (&plate, &inertia));
        let scale = MASS * start.velocity.norm();
        let [p, l] = [0, 1].map(|i| (after[i] - before[i]).norm() / scale);
        let energy = mass.kinetic_energy(&start);
        let numerical = end.ledger.numerical() / energy;
        println!("{name}: p {p:.1e} L {l:.1e} numerical {numerical:.1e}");
        assert!(plate.velocity.norm() > 0.05, "{name}: the plate did not move");
        assert!(p < 1e-9, "{name}: p {p:e}");
        assert!(l < 1e-9, "{name}: L {l:e}");
        let allowed = if name.ends_with("rigid") { 1e-7 } else { 3e-3 };
        assert!(numerical.abs() < allowed, "{name}: {numerical:e}");
    }
}

fn copy(case: &Meeting) -> Meeting {
    let Meeting { shape, inertia, laws, state, pose, carrier, pitch } = case;
    Meeting {
        shape: shape.clone(),
        inertia: *inertia,
        laws: laws.clone(),
        state: *state,
        pose: *pose,
        carrier: *carrier,
        pitch: *pitch,
    }
}

/// Fails for a spin of the plate that is left out of the slip, or counted with the wrong sign.
#[test]
fn a_turning_plate_turns_a_ball_as_a_still_plate_slows_it() {
    let spin = Vector3::z() * 3.0;
    let [(_, shape, inertia), ..] = &bodies()[..] else { panic!("a ball") };
    for (name, laws) in laws() {
        let mut case = Meeting::new(shape, *inertia, &laws);
        // The lattice turns below the ball, so that other nodes are met.
        case.pitch = 0.015;
        case.state.velocity = -Vector3::z();
        case.state.position = Point3::new(0.0, 0.0, 0.501);
        let mut still = copy(&case);
        still.state.spin = -spin;
        let still = still.run(0.6, 0.05);
        case.state.spin = Vector3::zeros();
        let turning = State { spin, ..State::at(Point3::new(0.0, 0.0, -0.1)) };
        case.carrier = carrier(turning, None);
        let end = case.run(0.6, 0.05);
        let w = end.surface.wear_volume() / still.surface.wear_volume() - 1.0;
        let [taken, slowed] = [end.body.state.spin.z, spin.z + still.body.state.spin.z];
        println!("{name}: W {w:.1e} spin {taken:.4} {slowed:.4}");
        assert!(w.abs() < 2e-3 && slowed > 0.1, "{name}: W {w:e}, slowed by {slowed}");
        assert!((taken / slowed - 1.0).abs() < 1e-2, "{name}: {taken} {slowed}");
    }
}

/// Fails for a plate of infinite mass that is asked for the work of its loads, or braked by its damping,
/// where one without a mass is led.
#[test]
fn a_plate_that_nothing_moves_is_a_led_plate() {
    let (_, case) = cases().swap_remove(0);
    let motion = State { velocity: Vector3::new(-0.3, 0.2, 0.4), ..slab(1.0).0 };
    let loads = Loads { torque: Vector3::x(), linear_damping: 2.0, ..Loads::default() };
    let [led, immovable] = [None, Some(Inertia::immovable())].map(|inertia| {
        let carrier = Some(Carrier { state: motion, inertia, loads });
        Meeting { carrier, ..copy(&case) }.run(0.6, 0.05)
    });
    assert!(led.ledger.external_work != 0.0 && led.surface.wear_volume() > 0.0);
    assert_eq!(led.carrier.expect("a plate").state, immovable.carrier.expect("a plate").state);
    assert_eq!(led.ledger, immovable.ledger);
}
