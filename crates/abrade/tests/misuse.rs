//! What the public API answers to values and surfaces that it was not made for.

mod soft;

use abrade::{
    Adhesion, Body, Carried, Changes, Drive, DriveSolution, Driven, ElasticLaw, Encounter,
    EncounterSettings, HertzConvention, HexStrip, Hold, Inertia, Ledger, Loads, PhysicsError,
    Placed, Pressed, Shape, State, Surface, SurfaceLaws, TriangleMesh, Until,
};
use nalgebra::{Isometry3, Point3, Vector3};
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

/// Fails for a drive that is over and goes on: its velocity would be no number.
#[test]
fn a_drive_that_only_indents_stays_where_it_is() {
    let (mut body, mut surface) = (ball(), plate(1.0));
    let settings = EncounterSettings::default();
    let mut driven = Driven::new(&mut body, &surface, drive(0.0, 0.0), settings).expect("a drive");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    driven.indent(&mut body, &mut placed, &mut ()).expect("an indentation");
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
