//! Bodies that are stuck in their craters.

use abrade::{
    Advance, Body, ElasticLaw, Encounter, EncounterSettings, FlowLaw, HexStrip, Hull, Loads,
    Material, Placed, Polyhedron, Shape, State, Surface, SurfaceLaws, Until,
};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

/// An octahedron of 2 mm that comes down at 50 m/s, does not turn and stays in its crater: what is done in
/// each of the given durations [s].
fn jam(elastic: ElasticLaw, friction: f64, durations: &[f64]) -> Vec<Advance> {
    let (hull, inertia, _) =
        Hull::solid(&Polyhedron::Octahedron.vertices(2e-3), 2500.0).expect("a hull");
    let shape = Shape::hull(hull);
    let material =
        Material { hardness: 1e9, shear_ratio: 0.25, young: Some(200e9), poisson: 0.3, friction };
    let flow = FlowLaw::NormalPressure {};
    let laws = SurfaceLaws { elastic, flow, ..SurfaceLaws::of(material) };
    let strip = HexStrip { length: 8e-3, width: 6e-3, pitch: 1e-4, rest_area: None };
    let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
    let rotation = UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3);
    let height = 1e-9 - shape.lowest(&rotation, &Vector3::z());
    let mut state = State { rotation, ..State::at(Point3::new(0.0, 0.0, height)) };
    state.velocity.z = -50.0;
    let mut body = Body { shape, inertia, state, rotation_locked: true };
    let settings = EncounterSettings { step_limit: 40_000, ..Default::default() };
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    let loads = Loads::default();
    let advance = |&time: &f64| {
        encounter
            .advance(&mut body, &mut placed, &loads, time, Until::Duration, &mut ())
            .expect("no more steps than it takes to come to rest")
    };
    durations.iter().map(advance).collect()
}

/// Fails for a body at rest that goes on at the rate of its springs, and for one whose way gets smaller
/// from step to step until its square is none.
#[test]
fn a_body_that_is_held_takes_no_steps() {
    for (elastic, friction) in
        [(ElasticLaw::Foundation { stiffness: None }, 1.5), (ElasticLaw::Rigid, 0.0)]
    {
        let done = jam(elastic, friction, &[1.0, 1e6, 1e60, 1e200]);
        let steps: Vec<_> = done.iter().map(|advance| advance.steps).collect();
        assert!(steps[2..] == [1, 1] && done[3].contact_time == 1e200, "{steps:?}");
    }
}
