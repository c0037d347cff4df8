//! Laws of nature that no table states: frames do not matter, runs repeat, wear only grows.

use abrade::{ElasticLaw, FlowLaw, Instant, Observer, Surface};
use nalgebra::{Isometry3, Vector3};

use crate::rig::{Impact, laws, paper, projected};

/// An oblique impact on a plate that is coarse but not tiny.
fn impact() -> Impact {
    let base = paper("oblique", 40.0, [0.02e-3, 0.01e-3]);
    let elastic = ElasticLaw::Foundation { stiffness: None };
    let strip = abrade::HexStrip { length: 3e-3, width: 3e-3, pitch: 0.05e-3, rest_area: None };
    Impact { strip, laws: laws(6.6e9, elastic, projected()), accuracy: 1e-3, ..base }
}

/// Fails for a direction or position that is left in the wrong frame.
#[test]
fn turning_and_moving_the_whole_scene_changes_nothing() {
    let case = impact();
    let plate = || Surface::hex_strip(case.strip, case.laws.clone()).expect("a plate");
    let here = case.run_on(plate());
    let pose = Isometry3::new(Vector3::new(3.0, -7.0, 5.0), Vector3::new(0.7, -1.9, 0.4));
    let there = case.run_at(plate(), pose);
    let (w, v) = (here.surface.wear_volume(), there.surface.wear_volume());
    assert!(w > 0.0 && (v / w - 1.0).abs() < 1e-9, "{:e}", v / w - 1.0);
    assert!((here.restitution - there.restitution).abs() < 1e-9);
}

/// Fails for an order that depends on addresses or hashes.
#[test]
fn a_run_repeats_to_the_bit() {
    let (a, b) = (impact().run(), impact().run());
    assert_eq!(a.surface.nodes(), b.surface.nodes());
    assert_eq!(a.body.state, b.body.state);
}

/// Sees that no node rises and no dissipated energy falls; friction may where sinking nodes drag the
/// body along.
#[derive(Default)]
struct Watch {
    drags: bool,
    depth: Vec<f64>,
    wear: f64,
    friction: f64,
}

impl Observer for Watch {
    fn observe(&mut self, instant: &Instant<'_, '_>) {
        let depth = &instant.surfaces[0].surface.nodes().depth;
        self.depth.resize(depth.len(), 0.0);
        assert!(depth.iter().zip(&self.depth).all(|(now, before)| now >= before));
        self.depth.clone_from(depth);
        let ledger = instant.ledger.expect("a ledger");
        assert!(ledger.wear >= self.wear);
        assert!(self.drags || ledger.friction >= self.friction);
        (self.wear, self.friction) = (ledger.wear, ledger.friction);
    }
}

/// Fails for wear that is undone on rebound, or an increment of the wrong sign.
#[test]
fn depth_wear_and_friction_only_grow() {
    let case = impact();
    let mut watch = Watch::default();
    case.watch(&mut watch);
    assert!(watch.wear > 0.0 && watch.friction > 0.0);
}

/// Fails for friction on a node's way down that is booked against the pressure's work: under strong
/// friction the wear then is less than the volume's price, and falls.
#[test]
fn under_a_pressure_normal_to_the_face_wear_is_hardness_times_volume_whatever_rubs() {
    for (friction, angle) in [(0.3, 60.0), (1.0, 40.0), (2.0, 15.0), (2.0, 80.0)] {
        let mut case = impact();
        case.angle = angle;
        case.laws.flow = FlowLaw::NormalPressure {};
        case.laws.material.friction = friction;
        let mut watch = Watch { drags: true, ..Watch::default() };
        let outcome = case.watch(&mut watch);
        let price = case.laws.material.hardness * outcome.surface.wear_volume();
        let miss = watch.wear / price - 1.0;
        assert!(miss.abs() < 1e-6, "mu {friction}, {angle} deg: {miss:e}");
    }
}
