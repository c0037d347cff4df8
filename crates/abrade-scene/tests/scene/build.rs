//! Bodies and surfaces lie and move where the scene says.

use abrade::Piece;
use nalgebra::{Point3, Vector3};

use super::checked;

fn near(found: Vector3<f64>, expected: [f64; 3], size: f64) {
    assert!((found - Vector3::from(expected)).norm() < 1e-12 * size, "{found} {expected:?}");
}

#[test]
fn a_ball_hangs_its_gap_above_the_nodes_and_flies_into_them() {
    let built = checked(&["bodies.ball.position.at=(\"1 mm\", \"-2 mm\")"]).build().unwrap();
    let ball = &built.bodies["ball"];
    near(ball.state.position.coords, [1e-3, -2e-3, 3.001e-3], 1e-3);
    let part = 35.0 * 0.5f64.sqrt();
    near(ball.state.velocity, [part, 0.0, -part], 35.0);
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 27e-9 * 2500.0;
    assert!((ball.inertia.mass / mass - 1.0).abs() < 1e-12);
    assert_eq!(built.surfaces["plate"].surface.nodes().len(), 231 * 80);
}

#[test]
fn node_spheres_lift_the_body_by_their_radius() {
    let hertz = "surfaces.plate.elastic=HertzNodes(node_radius: \"0.25 mm\")";
    let built = checked(&[hertz]).build().unwrap();
    near(built.bodies["ball"].state.position.coords, [0.0, 0.0, 3.251e-3], 1e-3);
}

/// A cube on its edge: its lowest point is half a diagonal below the centre.
#[test]
fn a_turned_cube_hangs_by_its_edge() {
    let arguments = [
        "bodies.ball.shape=Cuboid(size: (\"2 mm\", \"8 mm\", \"2 mm\"))",
        "bodies.ball.rotation.angle=45 deg",
    ];
    let built = checked(&arguments).build().unwrap();
    let body = &built.bodies["ball"];
    near(body.state.position.coords, [0.0, 0.0, 2f64.sqrt() * 1e-3 + 1e-6], 1e-3);
    let inertia = body.inertia;
    let expected = inertia.mass * (4e-6 + 4e-6) / 12.0;
    assert!((inertia.tensor[(1, 1)] / expected - 1.0).abs() < 1e-9, "{inertia:?}");
}

#[test]
fn azimuth_turns_the_direction_about_the_normal() {
    let built = checked(&["bodies.ball.motion.azimuth=90 deg"]).build().unwrap();
    let part = 35.0 * 0.5f64.sqrt();
    near(built.bodies["ball"].state.velocity, [0.0, part, -part], 35.0);
}

/// A scene turned and moved as a whole is the same scene: what counts in the surface's axes goes
/// with the surface.
#[test]
fn what_stands_on_a_surface_goes_with_it() {
    let moved = [
        "surfaces.plate.position=(10, -3, 2)",
        "surfaces.plate.rotation=AxisAngle(axis: (1, 2, 3), angle: \"70 deg\")",
    ];
    let still = ["bodies.ball.rotation.angle=20 deg", "bodies.ball.motion.spin=(1, 2, 3)"];
    let here = checked(&still).build().unwrap();
    let there = checked(&[moved, still].concat()).build().unwrap();
    let pose = there.surfaces["plate"].pose;
    let seen = there.bodies["ball"].state.seen_from(&pose);
    let expected = here.bodies["ball"].state;
    near(seen.position.coords, expected.position.coords.into(), 10.0);
    near(seen.velocity, expected.velocity.into(), 35.0);
    near(seen.spin, expected.spin.into(), 1.0);
    assert!(seen.rotation.angle_to(&expected.rotation) < 1e-7);
}

#[test]
fn a_clump_is_placed_about_its_centre_of_mass() {
    let clump = "bodies.ball.shape=Clump(spheres: [(5, 0, 0, 1), (9, 0, 0, 1)])";
    let built = checked(&[clump, "bodies.ball.motion=Free()"]).build().unwrap();
    let body = &built.bodies["ball"];
    let centres: Vec<Point3<f64>> = body
        .shape
        .pieces()
        .iter()
        .map(|piece| match piece {
            Piece::Ball(ball) => ball.centre,
            Piece::Hull(_) => Point3::origin(),
        })
        .collect();
    near(centres[0].coords, [-2.0, 0.0, 0.0], 1.0);
    near(centres[1].coords, [2.0, 0.0, 0.0], 1.0);
    near(body.state.position.coords, [0.0, 0.0, 1.000001], 1.0);
}

#[test]
fn a_driven_body_weighs_what_the_drive_says_and_does_not_turn() {
    let drive = "bodies.ball.motion=Drive(indent_to: 100, mass: \"33.5 g\")";
    let body = &checked(&[drive]).build().unwrap().bodies["ball"];
    assert_eq!(body.inertia.mass, 33.5 * 1e-3);
    assert!(body.rotation_locked);
    assert_eq!(body.state.velocity, Vector3::zeros());
}

#[test]
fn a_body_that_touches_a_plate_far_away_does_not_start_inside_it() {
    for far in ["(10, 10, 10)", "(1000, -1000, 1000)"] {
        checked(&[
            &format!("surfaces.plate.position={far}"),
            "surfaces.plate.rotation=Random(seed: 3)",
            "bodies.ball.position.gap=0",
        ]);
    }
}
