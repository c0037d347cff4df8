//! A step of the plug-in allocates nothing for tools once the buffers have grown; what Rapier does in
//! between is its own.

#[path = "../../abrade/tests/counting/mod.rs"]
mod counting;

use abrade_rapier3d::abrade::{HexStrip, Material, Surface, SurfaceLaws};
use abrade_rapier3d::rapier::prelude::*;
use abrade_rapier3d::{WearSettings, WearWorld, WorldView};
use counting::counted;

/// Steps in which buffers grow, and steps after them.
const FIRST: usize = 20;
const LATER: usize = 40;
/// Rapier's step takes its list of the bodies that were changed with it: to set the pose of a tool
/// begins a new one.
const BY_RAPIER: usize = 1;

/// Fails for a copy of the tool, or a list of the surfaces that it is near, made anew in every step.
#[test]
fn a_step_of_a_tool_allocates_nothing() {
    let ball = ColliderBuilder::ball(1e-3);
    let cube = ColliderBuilder::cuboid(1e-3, 1e-3, 1e-3);
    for (name, tool) in [("ball", ball), ("cube", cube)] {
        let mut world = PhysicsWorld::default();
        world.integration_parameters.dt = 1.0 / 240.0;
        let proxy = ColliderBuilder::cuboid(0.015, 0.003, 0.01).translation(Vector::Z * -0.01);
        let proxy = world.colliders.insert(proxy);
        let mut wear = WearWorld::new(WearSettings::default());
        let plate = wear.insert_on_top(plate(), proxy, &mut world.colliders).expect("a proxy");
        let body = RigidBodyBuilder::kinematic_velocity_based()
            .translation(Vector::new(-0.0165, 0.013e-3, 0.8e-3))
            .linvel(Vector::X * 0.1);
        let (body, _) = world.insert(body, tool);
        wear.add_tool(body, &world.bodies).expect("a kinematic body");
        let mut steps = Vec::new();
        for _ in 0..FIRST + LATER {
            let before = counted();
            let guard = wear.begin_step(WorldView::of(&mut world), &());
            let begun = counted() - before;
            world.step_with_events(&guard, &());
            let before = counted();
            wear.end_step(WorldView::of(&mut world)).expect("a step inside the model");
            steps.push(begun + counted() - before);
        }
        println!("{name}: {steps:?}, W {:e}", wear[plate].wear_volume());
        let (first, later) = steps.split_at(FIRST);
        assert!(wear.in_contact(body) && first.iter().any(|&count| count > BY_RAPIER), "{name}");
        assert!(later.iter().all(|&count| count <= BY_RAPIER), "{name}: {later:?}");
    }
}

fn plate() -> Surface {
    let (hardness, young) = (2e8, Some(1e10));
    let material = Material { hardness, shear_ratio: 0.25, young, poisson: 0.3, friction: 0.3 };
    let strip = HexStrip { length: 30e-3, width: 6e-3, pitch: 0.1e-3, rest_area: None };
    Surface::hex_strip(strip, SurfaceLaws::of(material)).expect("a plate")
}
