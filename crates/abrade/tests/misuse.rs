//! What the public API answers to values and surfaces that it was not made for.

mod soft;

use abrade::{
    Adhesion, Body, Carried, Changes, Drive, DriveSolution, Driven, ElasticLaw, Encounter,
    EncounterSettings, HertzConvention, HexStrip, Hold, Inertia, Instant, Ledger, Loads, Observer,
    PhysicsError, Placed, Pressed, Shape, State, Surface, SurfaceLaws, TriangleMesh, Until,
};
use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use soft::soft;

fn laws(elastic: ElasticLaw) -> SurfaceLaws {
    SurfaceLaws { elastic, ..SurfaceLaws::of(soft()) }
}

const SPRINGS: ElasticLaw = ElasticLaw::Foundation { stiffness: Some(100.0) };

fn plate(length: f64) -> Surface {
    let strip = HexStrip { length, width: 1.0, pitch: 0.05, rest_area: None };
    Surface::hex_strip(strip, laws(SPRINGS)).expect("a plate")
}

/// A ball of radius 0.5 just above the plate, on its way down.
fn ball() -> Body {
    let mut state = State::at(Point3::new(0.0, 0.0, 0.5 + 1e-6));
    state.velocity.z = -0.5;
    let shape = Shape::ball(0.5).expect("a ball");
    Body { shape, inertia: Inertia::of_ball(0.5, 0.04), state, rotation_locked: false }
}

fn is_unsupported<T>(result: Result<T, PhysicsError>) -> bool {
    matches!(result, Err(PhysicsError::Unsupported { .. }))
}

fn drive(speed: f64, distance: f64) -> Drive {
    let solution = DriveSolution::QuasiStatic { increment: 0.01 };
    Drive { indent_to: 0.02, load: 0.02, speed, distance, mass: 0.02, solution }
}

/// Fails for a slide without a speed, which has no end.
#[test]
fn a_slide_needs_a_speed() {
    let made = Driven::new(&mut ball(), &plate(1.0), drive(0.0, 0.1), Default::default());
    assert!(is_unsupported(made));
}

/// The highest speed that is shown [m/s].
#[derive(Default)]
struct Seen(f64);

impl Observer for Seen {
    fn observe(&mut self, instant: &Instant<'_, '_>) {
        self.0 = self.0.max(instant.state.velocity.norm());
    }
}

/// Fails for a drive that is over and goes on: its velocity would be no number; and for an indentation that is
/// shown at a pace of its own.
#[test]
fn a_drive_that_only_indents_stays_where_it_is() {
    let (mut body, mut surface) = (ball(), plate(1.0));
    let settings = EncounterSettings::default();
    let mut driven = Driven::new(&mut body, &surface, drive(0.0, 0.0), settings).expect("a drive");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let mut seen = Seen::default();
    driven.indent(&mut body, &mut placed, &mut seen).expect("an indentation");
    assert_eq!(seen.0, 0.0, "it takes no time");
    let before = body.state;
    driven.advance(&mut body, &mut placed, 0.1, &mut ()).expect("nothing");
    assert_eq!(before, body.state);
}

#[test]
fn a_hold_needs_a_finite_load() {
    let (mut body, mut surface) = (ball(), plate(1.0));
    let mut pressed = Pressed::new(&body, [&surface], Default::default()).expect("a body");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let end = body.state;
    for load in [f64::NAN, f64::INFINITY] {
        let load = Vector3::z() * -load;
        let hold = Hold { load, duration: 1.0, increment: 0.01, limit: 10, reach: None };
        assert!(is_unsupported(pressed.advance(&mut body, &mut placed, &end, &hold, &mut ())));
    }
}

#[test]
fn an_accuracy_out_of_range_is_refused() {
    for accuracy in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let settings = EncounterSettings { accuracy, ..Default::default() };
        assert!(is_unsupported(Encounter::new(&ball(), [&plate(1.0)], settings)), "{accuracy}");
    }
}

/// Fails for candidates that are looked up in a surface that lacks them.
#[test]
fn a_carried_body_leaves_other_surfaces_alone() {
    let (body, mut surface, mut other) = (ball(), plate(1.0), plate(0.3));
    let mut carried = Carried::new(&body, [&surface], Default::default()).expect("a body");
    let loads = Loads::default();
    let placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    carried.step(&body, &placed, &loads);
    let mut placed = [Placed::at_rest(&mut other, Isometry3::identity())];
    assert_eq!(carried.step(&body, &placed, &loads), 0.0);
    assert_eq!(carried.overlaps(&body, &placed), Vec::<f64>::new());
    assert_eq!(carried.grip(&body, &placed, 1e-3).force, Vector3::zeros());
    carried.let_go(&mut placed);
    assert!(is_unsupported(carried.meet(&body, &placed, &body.state, 1e-3)));
}

/// Fails for a flight that takes a solid for as large as its nodes, without the radius at which they
/// are felt: the ball then begins its contact inside.
#[test]
fn a_ball_comes_upon_the_corner_of_a_solid_with_large_nodes() {
    let elastic =
        ElasticLaw::HertzNodes { node_radius: 0.05, convention: HertzConvention::ElasticPair };
    let block = TriangleMesh::cuboid(Vector3::repeat(0.4), 0.1).expect("a block");
    let mut surface = Surface::mesh(&block, laws(elastic)).expect("a surface");
    let mut body = ball();
    let out = Vector3::repeat(1.0).normalize();
    body.state = State::at(Point3::from(out * (0.4 * 3f64.sqrt() + 0.5 + 0.3)));
    body.state.velocity = -out;
    let mut encounter =
        Encounter::new(&body, [&surface], Default::default()).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let (loads, until) = (Loads::default(), Until::FirstExit);
    let ended = encounter.advance(&mut body, &mut placed, &loads, 5.0, until, &mut ());
    assert!(ended.expect("a blow").exited);
    assert!(surface.wear_volume() > 0.0);
}

/// Fails for adhesion that is booked where no ledger is asked for.
#[test]
fn a_contact_without_a_ledger_ends_with_zeros() {
    let mut laws = laws(SPRINGS);
    laws.adhesion = Some(Adhesion { work: 0.01, range: 0.05, pull_off: 2.0 });
    let strip = HexStrip { length: 1.0, width: 1.0, pitch: 0.05, rest_area: None };
    let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
    let mut body = ball();
    let mut encounter =
        Encounter::new(&body, [&surface], Default::default()).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let (loads, until) = (Loads::default(), Until::Duration);
    encounter.advance(&mut body, &mut placed, &loads, 0.05, until, &mut ()).expect("a contact");
    assert!(encounter.in_contact());
    encounter.end(&mut placed);
    assert_eq!(*encounter.ledger(), Ledger::default());
}

/// Fails for changes that lift a node.
#[test]
fn changes_never_raise_a_node() {
    let mut surface = plate(1.0);
    surface.apply(&Changes::to_depths(vec![(3, 0.02)]));
    surface.apply(&Changes::to_depths(vec![(3, 0.01), (4, 0.01)]));
    assert_eq!([surface.depth(3), surface.depth(4), surface.deepest()], [0.02, 0.01, 0.02]);
}

/// Fails for an indentation that digs on by the body's size each time it is tried again.
#[test]
fn a_load_that_is_not_reached_is_refused_where_the_body_is() {
    let (mut body, mut surface) = (ball(), plate(4.0));
    let drive = Drive { indent_to: 1e3, ..drive(0.0, 0.0) };
    let mut driven = Driven::new(&mut body, &surface, drive, Default::default()).expect("a drive");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let mut indent = |body: &mut Body| {
        let error = driven.indent(body, &mut placed, &mut ()).expect_err("a load out of reach");
        assert!(matches!(error, PhysicsError::LoadNotReached { .. }), "{error}");
        body.state
    };
    let first = indent(&mut body);
    assert!(first.position.z < 0.1, "{first:?}");
    assert_eq!(indent(&mut body), first);
}

/// Fails for a body that has been made the drive's by a drive that is refused.
#[test]
fn a_drive_that_is_refused_leaves_its_body_alone() {
    let mut body = ball();
    body.state.velocity.x = 3.0;
    let drive = Drive { mass: f64::NAN, ..drive(0.0, 0.0) };
    assert!(Driven::new(&mut body, &plate(1.0), drive, Default::default()).is_err());
    assert_eq!((body.state.velocity.x, body.rotation_locked), (3.0, false));
    assert_eq!(body.inertia, ball().inertia);
}

/// Fails for an inertia that lets torques turn a body backwards.
#[test]
fn an_inertia_that_is_not_positive_is_refused() {
    let tensor = |moments: [f64; 3]| Matrix3::from_diagonal(&Vector3::from(moments)) * 1e-3;
    let take = |tensor: Matrix3<f64>, rotation_locked: bool| {
        let inertia = Inertia { tensor, ..ball().inertia };
        let body = Body { inertia, rotation_locked, ..ball() };
        Encounter::new(&body, [&plate(1.0)], Default::default())
    };
    for moments in [[-1.0; 3], [1.0, 2.0, -2.0], [-1.0, -2.0, -2.0], [0.0; 3], [f64::NAN; 3]] {
        assert!(take(tensor(moments), false).is_err(), "{moments:?}");
    }
    assert!(take(tensor([1.0, 2.0, 2.5]), false).is_ok());
    assert!(take(tensor([0.0; 3]), true).is_ok(), "what does not turn needs no moments");
}

/// Fails for adhesion that draws nodes over the hardness of a soft seam, which no flow law bears.
#[test]
fn a_seam_softer_than_the_traction_of_adhesion_is_refused() {
    let mut laws = laws(SPRINGS);
    laws.adhesion = Some(Adhesion::new(0.01, 0.05));
    let strip = HexStrip { length: 1.0, width: 1.0, pitch: 0.05, rest_area: None };
    let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
    let mut factors = vec![1.0; surface.nodes().len()];
    factors[7] = 0.3;
    assert_eq!(surface.set_hardness_factors(factors.clone()), Ok(()));
    factors[7] = 0.1;
    let error = surface.set_hardness_factors(factors).expect_err("a traction of 0.2");
    assert!(error.to_string().contains("below the hardness, 1.0000000149011612e-1"), "{error}");
}

/// Fails for a panic where a radius is none, and for changes that reach for nodes which are not there.
#[test]
fn values_that_mean_nothing_do_not_panic() {
    for radius in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
        abrade::calibrated_yield(&soft(), radius);
    }
    let mut surface = plate(1.0);
    let nodes = surface.nodes().len();
    surface.apply(&Changes::to_depths(vec![(nodes as u32, 0.1), (u32::MAX, 0.1)]));
    assert_eq!(surface.deepest(), 0.0);
}
