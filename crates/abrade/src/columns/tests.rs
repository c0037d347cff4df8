//! Columns that a body leaves behind on a long way.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use crate::body::{Body, Inertia, State};
use crate::contact::Contact;
use crate::encounter::{EncounterSettings, Loads, Placed, Until};
use crate::hull::Hull;
use crate::integrate::Integrator;
use crate::layout::HexStrip;
use crate::material::Material;
use crate::shape::Shape;
use crate::surface::{Surface, SurfaceLaws};

const PITCH: f64 = 0.1e-3;
/// Depth of a groove [m].
const DEPTH: f64 = 4.3 * PITCH;
/// Half the width of a tool at its foot, and its height [m].
const FOOT: f64 = 1e-3;
const HEIGHT: f64 = 1.5e-3;
/// Turn of a tool about its height [rad].
const TURN: f64 = 0.05;
const SPEED: f64 = 1.0;
/// Length of a plate [m].
const LENGTH: f64 = 30e-3;

/// A tool that is led through a plate.
struct Led {
    surface: Surface,
    body: Body,
    integrator: Integrator,
}

impl Led {
    /// A tool with the half width `head` [m] at its upper end, turned by `turn` [rad], before a border of
    /// the plate.
    fn new(head: f64, turn: f64) -> Self {
        let material = Material {
            hardness: 2e8,
            shear_ratio: 0.25,
            young: Some(1e10),
            poisson: 0.3,
            friction: 0.3,
        };
        let strip = HexStrip { length: LENGTH, width: 4e-3, pitch: PITCH, rest_area: None };
        let surface = Surface::hex_strip(strip, SurfaceLaws::of(material)).expect("a plate");
        let square = |half: f64, z: f64| {
            [(-half, half), (-half, -half), (half, half), (half, -half)]
                .map(|(x, y)| Point3::new(x, y, z))
        };
        let corners = [square(FOOT, 0.0), square(head, HEIGHT)].concat();
        let (hull, ..) = Hull::solid(&corners, 8000.0).expect("a hull");
        let shape = Shape::hull(hull);
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::z() * turn);
        let z = -DEPTH - shape.lowest(&rotation, &Vector3::z());
        let from = Point3::new(-0.5 * LENGTH - 1.2 * FOOT, 0.013e-3, z);
        let state = State { rotation, velocity: Vector3::x() * SPEED, ..State::at(from) };
        let body = Body { shape, inertia: Inertia::immovable(), state, rotation_locked: false };
        let settings = EncounterSettings::default();
        let integrator = Integrator::new(&body, [&surface], settings).expect("an integrator");
        Self { surface, body, integrator }
    }

    /// Goes on along a `way` [m], back where it is below zero; numbers of the columns that are listed
    /// then, and the wear volume [m3].
    fn go(&mut self, way: f64) -> (usize, f64) {
        let Self { surface, body, integrator } = self;
        body.state.velocity = Vector3::x() * SPEED.copysign(way);
        let (loads, time) = (Loads::default(), way.abs() / SPEED);
        let mut placed = [Placed::at_rest(surface, Isometry3::identity())];
        integrator
            .advance(body, &mut placed, &loads, time, Until::Duration, &mut ())
            .expect("a groove");
        let Contact::Columns(columns) = &integrator.contacts[0] else { panic!("a hull") };
        (columns.columns.len(), surface.wear_volume())
    }

    /// Least and largest depth of the nodes over which the whole of the foot has gone, between two
    /// places on its way [m].
    fn depths(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let half = FOOT * (TURN.cos() + TURN.sin()) - 0.5 * PITCH;
        let nodes = self.surface.nodes();
        let (mut least, mut largest) = (f64::INFINITY, 0.0f64);
        for (x, &depth) in nodes.rest_position.iter().zip(&nodes.depth) {
            if x.x > from && x.x < to && (x.y - self.body.state.position.y).abs() < half {
                (least, largest) = (least.min(depth), largest.max(depth));
            }
        }
        [least, largest]
    }
}

/// Fails for columns that stay listed all along a groove, and for nodes that do not know their depths
/// when a tool comes back to them.
#[test]
fn a_groove_is_no_longer_listed_and_is_not_paid_for_again() {
    let mut led = Led::new(FOOT, TURN);
    let parts: Vec<_> = (0..8).map(|_| led.go(3e-3)).collect();
    println!("{parts:?}");
    let listed = |part: usize| parts[part].0 as f64;
    assert!((listed(7) / listed(2) - 1.0).abs() < 0.05, "{parts:?}");
    let worn = parts[7].1;
    assert!((worn - parts[2].1) / (5.0 * (parts[2].1 - parts[1].1)) > 0.99, "{parts:?}");
    let (_, back) = led.go(-20e-3);
    println!("{:e}", back / worn - 1.0);
    assert!((back / worn - 1.0).abs() < 1e-9, "{back:e} after {worn:e} m3");
}

/// Fails for overhangs that are forgotten where a tool has left them, and do not break off when the
/// contact ends.
#[test]
fn overhangs_stay_until_the_contact_ends() {
    let mut led = Led::new(0.3 * FOOT, TURN);
    led.go(24e-3);
    let places = [-10e-3, 0.0];
    let [least, floor] = led.depths(places);
    assert!(least < 0.6 * floor && floor > 0.9 * DEPTH, "{least:e} and {floor:e} m");
    let mut placed = [Placed::at_rest(&mut led.surface, Isometry3::identity())];
    led.integrator.let_go(&mut placed);
    let [least, largest] = led.depths(places);
    println!("{:e}", 1.0 - least / largest);
    assert!(1.0 - least / largest < 1e-9 && largest == floor, "{least:e} and {largest:e} m");
}

/// Fails for a tool that is taken for one that starts inside where its flat front meets a border.
#[test]
fn a_flat_front_enters_by_a_border() {
    for ahead in [1.2, 1.3, 1.7] {
        let mut led = Led::new(FOOT, 0.0);
        led.body.state.position.x = -0.5 * LENGTH - ahead * FOOT;
        let (_, worn) = led.go((ahead - 1.0) * FOOT + 5e-3);
        let [least, floor] = led.depths([-0.5 * LENGTH, -0.5 * LENGTH + 4e-3]);
        let section = 2.0 * FOOT * floor * 5e-3;
        assert!(
            least == floor && (worn / section - 1.0).abs() < 0.05,
            "{worn:e} of {section:e} m3"
        );
    }
}
