//! Bodies that something else leads, whatever the contact does to them: tools.

use abrade::{
    Advance, Body, Carrier, ElasticLaw, Encounter, EncounterSettings, FlowLaw, HexStrip, Inertia,
    Lateral, Ledger, Loads, Material, Placed, Polyhedron, Shape, State, Surface, SurfaceLaws,
    Until,
};
use nalgebra::{Isometry3, Matrix3, Point3, UnitQuaternion, Vector3};

use crate::theory::hull;

const RADIUS: f64 = 3e-3;
const DEPTH: f64 = 0.1e-3;
const HARDNESS: f64 = 1.7e9;
const SPEED: f64 = 0.5;
const STRIP: HexStrip = HexStrip { length: 8e-3, width: 4e-3, pitch: 0.1e-3, rest_area: None };

/// A body that is led through the whole of a plate, at a depth.
#[derive(Clone)]
struct Cut {
    shape: Shape,
    laws: SurfaceLaws,
    /// Along the plate [m/s], and about the centre [rad/s].
    speed: f64,
    spin: Vector3<f64>,
    /// Of the plate, which may be led the other way.
    plate: f64,
    /// Length of a call [s].
    step: f64,
}

/// What is left of it.
struct Groove {
    surface: Surface,
    ledger: Ledger,
    total: Advance,
    end: State,
}

fn laws(elastic: ElasticLaw, flow: FlowLaw, friction: f64) -> SurfaceLaws {
    let (shear_ratio, young, poisson) = (0.25, Some(200e9), 0.3);
    let material = Material { hardness: HARDNESS, shear_ratio, young, poisson, friction };
    SurfaceLaws { elastic, flow, ..SurfaceLaws::of(material) }
}

fn sprung() -> SurfaceLaws {
    let flow = FlowLaw::CapozzaHanley { lateral: Lateral::Projected };
    laws(ElasticLaw::Foundation { stiffness: None }, flow, 0.3)
}

fn rigid(friction: f64) -> SurfaceLaws {
    laws(ElasticLaw::Rigid, FlowLaw::NormalPressure {}, friction)
}

impl Cut {
    fn of_ball(laws: SurfaceLaws) -> Self {
        let shape = Shape::ball(RADIUS).expect("a ball");
        let spin = Vector3::zeros();
        Self { shape, laws, speed: SPEED, spin, plate: 0.0, step: 1.0 / 60.0 }
    }

    fn of_cube(laws: SurfaceLaws) -> Self {
        let (shape, _) = hull(&Polyhedron::Cube.vertices(2e-3), 1.0);
        Self { shape, ..Self::of_ball(laws) }
    }

    /// Way of the body over the plate [m].
    fn way(&self) -> f64 {
        STRIP.length + 2.0 * (self.shape.bounding_radius() + DEPTH)
    }

    fn run(&self) -> Groove {
        let mut surface = Surface::hex_strip(STRIP, self.laws.clone()).expect("a plate");
        let lowest = self.shape.lowest(&UnitQuaternion::identity(), &Vector3::z());
        let at = Point3::new(-0.5 * self.way(), 0.013e-3, -lowest - DEPTH);
        let velocity = Vector3::x() * self.speed;
        let mut body = Body {
            shape: self.shape.clone(),
            inertia: Inertia::immovable(),
            state: State { velocity, spin: self.spin, ..State::at(at) },
            rotation_locked: false,
        };
        let settings = EncounterSettings { ledger: true, ..Default::default() };
        let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
        let velocity = -Vector3::x() * self.plate;
        let state = State { velocity, ..State::at(Point3::origin()) };
        let carrier = Carrier { state, inertia: None, loads: Loads::default() };
        let carrier = (self.plate != 0.0).then_some(carrier);
        let pose = Isometry3::identity();
        let mut placed = [Placed { surface: &mut surface, pose, carrier, skin: None }];
        // None of this may change its motion, or be booked.
        let loads = Loads {
            gravity: -Vector3::z() * 9.81,
            force: Vector3::repeat(100.0),
            torque: Vector3::repeat(1.0),
            linear_damping: 3.0,
            angular_damping: 3.0,
        };
        let mut total = Advance::default();
        let duration = self.way() / (self.speed + self.plate);
        for _ in 0..(duration / self.step).ceil() as u32 {
            let step = encounter
                .advance(&mut body, &mut placed, &loads, self.step, Until::Duration, &mut ())
                .expect("a cut");
            total.impulse += step.impulse;
            total.twist += step.twist;
        }
        assert!(!encounter.is_open());
        let ledger = *encounter.ledger();
        surface.settle();
        Groove { surface, ledger, total, end: body.state }
    }
}

/// Fails for a led body that slows down, for work that is booked by another velocity than that of
/// the body and of the plate, and for springs whose steps nothing bounds: without a mass they have no
/// frequency.
#[test]
fn what_leads_a_tool_pays_for_its_groove() {
    let pressure =
        laws(ElasticLaw::Foundation { stiffness: None }, FlowLaw::NormalPressure {}, 0.3);
    let spin = Vector3::new(20.0, 300.0, -50.0);
    let ball = Cut::of_ball(sprung());
    let spun = Cut { spin, ..Cut::of_ball(pressure) };
    let cases = [
        ("ball", ball.clone(), 2e-4),
        ("spun ball", spun, 2e-4),
        ("ball and led plate", Cut { plate: SPEED, speed: 0.0, ..ball.clone() }, 2e-4),
        ("both led", Cut { plate: 0.3 * SPEED, speed: 0.7 * SPEED, ..ball }, 2e-4),
        ("rigid ball", Cut::of_ball(rigid(0.3)), 1e-6),
        ("rigid cube", Cut::of_cube(rigid(0.3)), 1e-9),
        ("sprung cube", Cut::of_cube(sprung()), 1e-9),
    ];
    for (name, cut, limit) in cases {
        let Groove { surface, ledger, total, end } = cut.run();
        let work = ledger.external_work;
        let led = total.impulse.x * (cut.speed + cut.plate) + total.twist.dot(&cut.spin);
        let numerical = ledger.numerical() / work;
        println!("{name}: {work:.4} J, numerical {numerical:.1e}, W {:e}", surface.wear_volume());
        assert_eq!((end.velocity, end.spin), (Vector3::x() * cut.speed, cut.spin), "{name}");
        assert!(work > 0.0 && (led / work + 1.0).abs() < 1e-9, "{name}: {led} J of {work} J");
        assert!(ledger.elastic == 0.0 && ledger.kinetic_change == 0.0, "{name}: {ledger:?}");
        assert!(surface.wear_volume() > 0.0 && ledger.wear > 0.0, "{name}");
        assert!(numerical.abs() < limit, "{name}: {numerical:e}");
    }
}

/// Fails for a groove of another section than the tool's, and for a force that is not what the volume
/// costs: H per volume without friction, whatever the face.
#[test]
fn a_rigid_tool_cuts_its_own_section() {
    let angle = (1.0 - DEPTH / RADIUS).acos();
    let segment = RADIUS * RADIUS * (angle - angle.sin() * angle.cos());
    let cases =
        [("ball", Cut::of_ball(rigid(0.0)), segment), ("cube", Cut::of_cube(rigid(0.0)), 2e-7)];
    for (name, cut, section) in cases {
        let Groove { surface, total, .. } = cut.run();
        let wear = surface.wear_volume() / (section * STRIP.length) - 1.0;
        let force = -total.impulse.x * cut.speed / (HARDNESS * surface.worn().displaced()) - 1.0;
        println!("{name}: W {wear:.1e} F {force:.1e}");
        assert!(wear.abs() < 1e-2, "{name}: W {wear:e}");
        assert!(force.abs() < 1e-5, "{name}: F {force:e}");
        assert!(total.impulse.z >= 0.0, "{name}");
    }
}

/// Fails for steps that go by time where nothing has an inertia, and for those that the calls cut.
#[test]
fn a_groove_knows_neither_the_speed_nor_the_calls() {
    let cut = Cut::of_ball(sprung());
    let wear = |cut: &Cut| cut.run().surface.wear_volume();
    let once = wear(&cut);
    for (speed, step, limit) in
        [(SPEED, 1.0 / 240.0, 1e-6), (SPEED, 1e-3, 1e-6), (100.0, 1.0 / 60.0, 1e-6)]
    {
        let miss = wear(&Cut { speed, step, ..cut.clone() }) / once - 1.0;
        println!("{speed} m/s in {step:.1e} s: {miss:.1e}");
        assert!(miss.abs() < limit, "{speed} m/s in {step:e} s: {miss:e}");
    }
}

/// Fails for a tool that its workpiece does not feel, or that takes up energy: a led ball throws a
/// plate that is free.
#[test]
fn a_tool_drives_what_is_free_before_it() {
    let mass = 2e-3;
    let mut surface = Surface::hex_strip(STRIP, sprung()).expect("a plate");
    let velocity = Vector3::new(3.0, 0.0, -5.0);
    let state = State::at(Point3::new(0.0, 0.0, RADIUS + 1e-6));
    let mut body = Body {
        shape: Shape::ball(RADIUS).expect("a ball"),
        inertia: Inertia::immovable(),
        state: State { velocity, ..state },
        rotation_locked: false,
    };
    let settings = EncounterSettings { ledger: true, ..Default::default() };
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    let tensor = Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 3.0)) * (mass * 1e-5);
    let inertia = Inertia { mass, tensor };
    let state = State::at(Point3::new(0.0, 0.0, -1e-3));
    let carrier = Some(Carrier { state, inertia: Some(inertia), loads: Loads::default() });
    let pose = Isometry3::identity();
    let mut placed = [Placed { surface: &mut surface, pose, carrier, skin: None }];
    let loads = Loads::default();
    let done = encounter
        .advance(&mut body, &mut placed, &loads, 1e-4, Until::Duration, &mut ())
        .expect("a blow");
    let plate = placed[0].carrier.expect("the plate").state;
    let ledger = encounter.ledger();
    let miss = (plate.velocity * mass + done.impulse).norm() / done.impulse.norm();
    let numerical = ledger.numerical() / ledger.external_work;
    println!("{:?}, p {miss:.1e}, numerical {numerical:.1e}", plate.velocity);
    assert_eq!(body.state.velocity, velocity);
    assert!(plate.velocity.z < -5.0 && !encounter.in_contact(), "{:?}", plate.velocity);
    assert!(miss < 1e-12, "{miss:e}");
    assert!(ledger.wear > 0.0 && numerical.abs() < 2e-3, "{numerical:e} {ledger:?}");
}
