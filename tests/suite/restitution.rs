//! Impacts below yield with a coefficient of restitution: the asked one, at every speed.

use abrade::{
    Ball, Body, ElasticLaw, Encounter, EncounterSettings, HexStrip, Inertia, Instant, Ledger,
    Loads, Observer, Piece, Placed, Polyhedron, Shape, State, Surface, SurfaceLaws, Until,
};
use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

use crate::rig::{Impact, hertz, laws, paper, projected};
use crate::theory::hull;

const RADIUS: f64 = 3e-3;

/// Least increment of each dissipated energy over a step.
#[derive(Debug, Default)]
struct Least {
    last: Ledger,
    damping: f64,
    friction: f64,
    wear: f64,
}

impl Observer for Least {
    fn observe(&mut self, instant: &Instant<'_, '_>) {
        let now = *instant.ledger.expect("a ledger");
        let last = std::mem::replace(&mut self.last, now);
        self.damping = self.damping.min(now.damping - last.damping);
        self.friction = self.friction.min(now.friction - last.friction);
        self.wear = self.wear.min(now.wear - last.wear);
    }
}

fn plate(elastic: ElasticLaw, restitution: f64) -> Surface {
    let strip = HexStrip { length: 3e-3, width: 3e-3, pitch: 0.05e-3, rest_area: None };
    let laws = SurfaceLaws { restitution, ..laws(6.6e9, elastic, projected()) };
    Surface::hex_strip(strip, laws).expect("a plate")
}

fn foundation() -> ElasticLaw {
    ElasticLaw::Foundation { stiffness: None }
}

fn ball(gap: f64, speed: f64, inflation: f64) -> Body {
    let mut state = State::at(Point3::new(7e-6, 11e-6, RADIUS + inflation + gap));
    state.velocity.z = -speed;
    let shape = Shape::ball(RADIUS).expect("a ball");
    Body { shape, inertia: Inertia::of_ball(RADIUS, 2500.0), state, rotation_locked: false }
}

/// A normal impact: the speed after over the speed before, and the ledger.
fn bounce(elastic: ElasticLaw, restitution: f64, speed: f64, accuracy: f64) -> (f64, Ledger) {
    let inflation = if elastic == foundation() { 0.0 } else { 0.25e-3 };
    let mut surface = plate(elastic, restitution);
    let mut body = ball(1e-10, speed, inflation);
    let settings = EncounterSettings { accuracy, ledger: true, ..Default::default() };
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let mut least = Least::default();
    let done = encounter
        .advance(&mut body, &mut placed, &Loads::default(), 1.0, Until::FirstExit, &mut least)
        .expect("an impact");
    assert!(done.exited && least.damping >= 0.0, "{least:?}");
    assert_eq!(surface.wear_volume(), 0.0, "above yield");
    (body.state.velocity.norm() / speed, *encounter.ledger())
}

/// Fails for a damping whose effect depends on the speed, the law or the number of nodes.
#[test]
fn a_ball_below_yield_rebounds_with_the_asked_restitution() {
    for elastic in [foundation(), hertz()] {
        for asked in [0.3, 0.5, 0.9] {
            for speed in [0.002, 0.02, 0.2] {
                let (got, ledger) = bounce(elastic.clone(), asked, speed, 1e-3);
                let energy = 0.5 * Inertia::of_ball(RADIUS, 2500.0).mass * speed * speed;
                let open = ledger.numerical() / energy;
                println!("{elastic:?} {asked} at {speed} m/s: {got:.5}, numerical {open:.1e}");
                assert!((got / asked - 1.0).abs() < 0.02, "{got} for {asked}");
            }
        }
    }
}

/// Fails for a damping that is an artefact of the step.
#[test]
fn the_restitution_converges_with_the_accuracy() {
    for elastic in [foundation(), hertz()] {
        let miss = |accuracy: f64| {
            let (got, ledger) = bounce(elastic.clone(), 0.5, 0.1, accuracy);
            println!("{elastic:?} {accuracy:e}: {got:.7} {:e}", ledger.numerical());
            (got / 0.5 - 1.0).abs()
        };
        let misses = [1e-1, 1e-2, 1e-3, 1e-4].map(miss);
        let falls = |pair: &[f64]| pair[1] < 0.7 * pair[0];
        assert!(misses.windows(2).all(falls) && misses[3] < 2e-3, "{misses:?}");
    }
}

/// Fails for a damping that a body at rest on its springs does not feel.
#[test]
fn a_dropped_ball_comes_to_rest_and_wears_nothing() {
    for elastic in [foundation(), hertz()] {
        let inflation = if elastic == foundation() { 0.0 } else { 0.25e-3 };
        let mut surface = plate(elastic, 0.5);
        let height = 1e-6;
        let mut body = ball(height, 0.0, inflation);
        // Over a node: elsewhere the lattice is a slope, on which a ball rolls off.
        (body.state.position.x, body.state.position.y) = (0.0, 0.0);
        let settings = EncounterSettings { ledger: true, ..Default::default() };
        let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
        let loads = Loads { gravity: -9.81 * Vector3::z(), ..Default::default() };
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        let mut least = Least::default();
        // All bounces together take (1 + e) / (1 - e) = 3 times the fall of 0.45 ms.
        let done = encounter
            .advance(&mut body, &mut placed, &loads, 5e-3, Until::Duration, &mut least)
            .expect("a drop");
        let (ledger, speed) = (encounter.ledger(), body.state.velocity.norm());
        let open = ledger.numerical() / ledger.damping;
        println!("{speed:e} m/s after {} steps, numerical {open:e}, {ledger:?}", done.steps);
        assert!(encounter.in_contact() && speed < 1e-6 * (2.0 * 9.81 * height).sqrt());
        assert_eq!(surface.wear_volume(), 0.0);
        assert!(least.damping >= 0.0 && open.abs() < 5e-3, "{least:?} {ledger:?}");
    }
}

/// Fails for tangential springs that go on for ever.
#[test]
fn a_ball_that_cannot_turn_stops_sideways_too() {
    let mut surface = plate(foundation(), 0.5);
    let mut body = ball(1e-10, 1e-3, 0.0);
    body.rotation_locked = true;
    body.state.velocity.x = 1e-3;
    let settings = EncounterSettings { ledger: true, ..Default::default() };
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    let loads = Loads { gravity: -9.81 * Vector3::z(), ..Default::default() };
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let mut least = Least::default();
    encounter
        .advance(&mut body, &mut placed, &loads, 5e-3, Until::Duration, &mut least)
        .expect("a landing");
    let (ledger, speed) = (encounter.ledger(), body.state.velocity.norm());
    println!("{speed:e} m/s, {ledger:?}, numerical {:e}", ledger.numerical());
    assert!(encounter.in_contact() && speed < 1e-8);
    assert!(least.damping >= 0.0 && least.friction >= 0.0, "{least:?}");
    assert!(ledger.numerical().abs() < 5e-3 * ledger.damping, "{ledger:?}");
}

/// The impact of `rig` above yield.
#[test]
fn above_yield_the_flow_takes_nearly_all_and_the_ledger_closes() {
    let impact = |restitution: f64| {
        let base = paper("oblique", 60.0, [0.0; 2]);
        let strip = HexStrip { length: 3e-3, width: 3e-3, pitch: 0.05e-3, rest_area: None };
        let laws = SurfaceLaws { restitution, ..laws(6.6e9, foundation(), projected()) };
        let mut least = Least::default();
        let case = Impact { strip, laws, accuracy: 1e-3, ..base };
        let end = case.watch(&mut least);
        let energy = 0.5 * end.body.inertia.mass * case.speed * case.speed;
        let open = least.last.numerical() / energy;
        let wear = end.surface.wear_volume();
        println!("{restitution}: W {wear:e} COR {} numerical {open:.1e}", end.restitution);
        assert!(least.damping >= 0.0 && least.friction >= 0.0 && least.wear >= 0.0, "{least:?}");
        assert!(open.abs() < 5e-3, "{open}");
        wear
    };
    let (undamped, damped) = (impact(1.0), impact(0.5));
    assert!(damped < undamped && damped > 0.75 * undamped, "{damped:e} {undamped:e}");
}

/// Bits of an oblique impact of a ball that cannot turn, as an undamped surface gives them: it
/// takes square roots and no other function, so that they are those of every platform.
const UNDAMPED: [u64; 3] = [0x3da8_aad9_7779_f596, 0xc001_3262_d11e_8b6d, 0x4030_1c16_ed5f_6585];

/// Fails for a damping that touches surfaces without it.
#[test]
fn a_restitution_of_one_changes_no_bit() {
    let mut surface = plate(foundation(), 1.0);
    let mut body = ball(1e-10, 28.0, 0.0);
    body.state.velocity.x = 20.0;
    body.rotation_locked = true;
    let mut encounter =
        Encounter::new(&body, [&surface], EncounterSettings::default()).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    encounter
        .advance(&mut body, &mut placed, &Loads::default(), 1.0, Until::FirstExit, &mut ())
        .expect("an impact");
    let v = body.state.velocity;
    assert_eq!([surface.wear_volume(), v.x, v.z].map(f64::to_bits), UNDAMPED);
}

/// Bodies that are no balls: a cube flat on the plate and a clump on three feet.
fn others() -> Vec<(&'static str, Shape, Inertia)> {
    let mass = 0.02;
    let (cube, cube_inertia) = hull(&Polyhedron::Cube.vertices(1.0), mass);
    let feet = [[0.3, 0.0, 0.0], [-0.15, 0.26, 0.0], [-0.15, -0.26, 0.0]]
        .map(|[x, y, z]| Piece::Ball(Ball { centre: Point3::new(x, y, z), radius: 0.25 }));
    let tensor = Matrix3::from_diagonal(&Vector3::new(0.9e-3, 0.9e-3, 1.5e-3));
    vec![
        ("cube", cube, cube_inertia),
        ("clump", Shape::union(feet.into()).expect("a clump"), Inertia { mass, tensor }),
    ]
}

/// Fails for faces or clumps that are not damped, or that make energy.
#[test]
fn a_cube_and_a_clump_rebound_with_the_asked_restitution() {
    for (name, shape, inertia) in others() {
        for asked in [0.3, 0.5, 0.9] {
            let mut laws = laws(1.0, ElasticLaw::Foundation { stiffness: Some(50.0) }, projected());
            (laws.material.friction, laws.restitution) = (0.0, asked);
            let strip = HexStrip { length: 2.0, width: 2.0, pitch: 0.04, rest_area: None };
            let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
            let height = 1e-9 - shape.lowest(&Default::default(), &Vector3::z());
            let mut state = State::at(Point3::new(0.0, 0.0, height));
            let speed = 0.1;
            state.velocity.z = -speed;
            let mut body = Body { shape: shape.clone(), inertia, state, rotation_locked: false };
            let settings = EncounterSettings { ledger: true, ..Default::default() };
            let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
            let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
            let mut least = Least::default();
            let done = encounter
                .advance(
                    &mut body,
                    &mut placed,
                    &Loads::default(),
                    9.0,
                    Until::FirstExit,
                    &mut least,
                )
                .expect("an impact");
            let got = body.state.velocity.z / speed;
            let open = encounter.ledger().numerical() / (0.5 * inertia.mass * speed * speed);
            println!("{name} {asked}: {got:.5}, {} steps, numerical {open:.1e}", done.steps);
            assert!(done.exited && surface.wear_volume() == 0.0);
            assert!((got / asked - 1.0).abs() < 0.02, "{name}: {got} for {asked}");
            assert!(least.damping >= 0.0 && open.abs() < 2e-2, "{name} {asked}: {open:e}");
        }
    }
}
