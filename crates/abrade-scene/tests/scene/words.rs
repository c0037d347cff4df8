//! The words of a scene mean what they say: units, defaults, alternatives.

use abrade::{ElasticLaw, FlowLaw, HertzConvention, Lateral, Polyhedron, Removal};
use abrade_scene::load_text;
use abrade_scene::scene::*;

use super::{checked, refusal, set};

#[test]
fn the_scene_of_the_interface_page_is_read() {
    let scene = checked(&[]).scene;
    assert_eq!(scene.materials["plate"].hardness, 6.6e9);
    assert_eq!(
        scene.surfaces["plate"].geometry,
        Geometry::HexStrip {
            length: 30.0 * 1e-3,
            width: 12.0 * 1e-3,
            pitch: Some(0.15 * 1e-3),
            nodes: None,
            rest_area: None
        }
    );
    let body = &scene.bodies["ball"];
    assert_eq!(body.shape, SceneShape::Ball { radius: 3.0 * 1e-3 });
    assert_eq!(
        body.motion,
        Motion::Impact {
            speed: 35.0,
            angle: 45.0 * std::f64::consts::PI / 180.0,
            azimuth: 0.0,
            spin: [0.0; 3]
        }
    );
    assert_eq!(scene.outputs[0], Output::History { every: 1e-6 });
    assert_eq!(scene.outputs[1], Output::Surface { at: Some(Moment::End), every: None });
}

#[test]
fn what_a_scene_leaves_out_has_the_stated_default() {
    let text = r#"(version: 1, name: "least",
        materials: {"m": (hardness: 1e9, young: 2e11)},
        surfaces: {"s": (material: "m", geometry: HexStrip(length: 0.1, width: 0.1, nodes: 100))},
        bodies: {"b": (shape: Ball(radius: 1e-3), density: 1.0, position: OnSurface(surface: "s"))})"#;
    let scene = load_text("least", text.into(), Default::default(), &[]).unwrap().scene;
    assert_eq!(scene.gravity, [0.0; 3]);
    assert_eq!(scene.run.step, 1.0 / 240.0);
    assert_eq!((scene.run.accuracy, scene.run.stop), (1e-3, Stop::AllRebounded));
    let surface = &scene.surfaces["s"];
    assert_eq!(surface.flow, FlowLaw::CapozzaHanley { lateral: Lateral::Projected });
    assert_eq!(surface.elastic, ElasticLaw::Foundation { stiffness: None });
    assert_eq!((&surface.motion, &surface.removal), (&SurfaceMotion::Fixed, &Removal::All));
    assert_eq!(surface.restitution, 1.0);
    let body = &scene.bodies["b"];
    assert_eq!(body.motion, Motion::Free { velocity: [0.0; 3], spin: [0.0; 3] });
    let own = OnSurfaceDefaults { at: [0.0, 0.0], gap: 0.0 };
    let Placement::OnSurface { at, gap, .. } = body.position else { panic!("{body:?}") };
    assert_eq!(own, OnSurfaceDefaults { at, gap });
}

#[derive(Debug, PartialEq)]
struct OnSurfaceDefaults {
    at: [f64; 2],
    gap: f64,
}

#[test]
fn every_alternative_is_read() {
    let scene = checked(&[
        "surfaces.plate.elastic=HertzNodes(node_radius: \"0.25 mm\", convention: RigidBody)",
        "surfaces.plate.flow=NormalPressure()",
        "surfaces.plate.removal=AttackAngle(critical: \"35 deg\")",
        "surfaces.plate.geometry=HexStrip(length: \"30 mm\", width: 0.012, nodes: 5012)",
        "bodies.ball.shape=Polyhedron(kind: Tetrahedron, edge: \"1 mm\")",
        "bodies.ball.rotation=Random(seed: 7)",
        "bodies.ball.rotation_locked=true",
        "bodies.ball.motion=Drive(indent_to: \"21 kN\", load: \"20 kN\", speed: \"0.2 m/s\", \
         distance: \"80 mm\", rate_over: \"8 mm\", mass: 0.0335, solution: QuasiStatic())",
        "run=(stop: Time(limit: \"0.4 s\"), step: \"1/60 s\")",
        "outputs=[Surface(every: \"1 ms\"), Bodies, Picture, Energy, Report]",
    ])
    .scene;
    let surface = &scene.surfaces["plate"];
    assert_eq!(
        surface.elastic,
        ElasticLaw::HertzNodes { node_radius: 0.25 * 1e-3, convention: HertzConvention::RigidBody }
    );
    let body = &scene.bodies["ball"];
    assert_eq!(
        body.shape,
        SceneShape::Polyhedron { kind: Polyhedron::Tetrahedron, edge: 1.0 * 1e-3 }
    );
    let Motion::Drive { indent_to, mass, solution, .. } = &body.motion else { panic!("{body:?}") };
    assert_eq!((*indent_to, *mass), (21e3, Some(0.0335)));
    assert_eq!(*solution, Solution::QuasiStatic { increment: None });
    assert_eq!((scene.run.step, &scene.run.stop), (1.0 / 60.0, &Stop::Time { limit: 0.4 }));

    for argument in [
        "bodies.ball.motion=Drive(indent_to: 21e3, solution: Dynamic())",
        "bodies.ball.motion=Free(velocity: (\"1 m/s\", 0, 0.0), spin: (0, \"10 rpm\", 0))",
        "bodies.ball.rotation=Quaternion(xyzw: (0.0, 0.0, 0.0, 2.0))",
        "bodies.ball.position=At(point: (0, 0, \"1 m\"))",
        "bodies.ball.shape=Cuboid(size: (\"1 mm\", \"2 mm\", 0.003))",
        "bodies.ball.shape=ConvexHull(points: [(0,0,0), (1,0,0), (0,1,0), (0,0,1)])",
        "bodies.ball.shape=Clump(spheres: [(0, 0, 0, \"1 mm\"), (\"1 mm\", 0, 0, \"1 mm\")])",
        "surfaces.plate.elastic=Rigid",
        "surfaces.plate.elastic.stiffness=1 GPa/mm",
        "surfaces.plate.flow.lateral=Eq5",
        "surfaces.plate.removal=Fraction(of: 0.1)",
        "surfaces.plate.motion=Kinematic(velocity: (\"1 m/s\", 0, 0), spin: (0, 0, \"60 rpm\"))",
        "surfaces.plate.motion=Reciprocating(amplitude: (\"5 mm\", 0, 0), frequency: \"0.3 Hz\", phase: \"90 deg\")",
        "surfaces.plate.motion=Rocking(axis: (0, 1, 0), angle: \"10 deg\", frequency: \"20 rpm\")",
        "surfaces.plate.motion=Path(points: [(time: 0), (time: \"1 s\", shift: (\"1 mm\", 0, 0))])",
        "bodies.ball.motion=Fixed",
        "run.stop=FirstExit",
        "run.stop=Impacts(count: 10000)",
        "run.resolve=Micro",
    ] {
        checked(&[argument]);
    }
}

/// Fails for an output that is offered and then refused.
#[test]
fn every_output_that_is_offered_is_written() {
    let refusal = refusal(&["outputs.0=Checkpoint"]);
    assert!(refusal.contains("Checkpoint"), "{refusal}");
    let offered = abrade_scene::fields();
    assert!(offered.iter().any(|field| field.path == "outputs.<i> = Report"));
    assert!(offered.iter().all(|field| !field.meaning.contains("not available")));
}

#[test]
fn all_faults_of_a_scene_are_named_at_once() {
    let error = set(&[
        "materials.plate.friction=-1",
        "surfaces.plate.material=\"plat\"",
        "bodies.ball.position.surface=\"plato\"",
        "bodies.ball.density=0",
        "bodies.ball.rotation.axis=(0, 0, 0)",
        "bodies.ball.motion.angle=91 deg",
        "run.stop=Distance",
        "outputs.1.every=1",
    ])
    .unwrap_err();
    assert_eq!(error.problems.len(), 8, "{error}");
}

#[test]
fn a_name_given_twice_is_refused() {
    let grain = |name: &str| {
        format!(
            "\"{name}\": (shape: Ball(radius: 1e-3), density: 1.0, count: 2, every: 1.0, \
             position: At(point: (0, 0, 1)), motion: Impact(speed: 1.0, angle: 1.0))"
        )
    };
    let twice = format!("streams: {{{}, {}}}", grain("a"), grain("a"));
    let twice = super::SCENE.replace("streams: {}", &twice);
    let error = load_text("x", twice, Default::default(), &[]).unwrap_err();
    assert!(error.to_string().contains("the name `a` is given twice; given again"), "{error}");
}

#[test]
fn alternatives_exclude_each_other() {
    for (argument, message) in [
        ("surfaces.plate.geometry.nodes=5", "must have either `pitch` or `nodes`"),
        ("bodies.ball.shape=ConvexHull()", "give either `points` or `file`"),
        ("bodies.ball.shape=Clump()", "give either `spheres` or `file`"),
        ("outputs.1.every=1 s", "has both `at` and `every`"),
    ] {
        let refusal = refusal(&[argument]);
        assert!(refusal.contains(message), "{refusal}");
    }
}

#[test]
fn a_drive_must_be_able_to_move() {
    let drive =
        |fields: &str| refusal(&[&format!("bodies.ball.motion=Drive(indent_to: 10, {fields})")]);
    assert!(drive("distance: 1").contains("slides a distance at no speed"));
    assert!(drive("distance: 1, speed: 1, rate_over: 2").contains("longer than the path"));
    assert!(drive("mass: -1").contains("`bodies.ball.motion.mass` is out of range"));
}

#[test]
fn a_restitution_is_one_that_springs_can_have() {
    let with = |text: &str| format!("surfaces.plate.restitution={text}");
    let scene = checked(&[&with("0.4")]);
    assert_eq!(scene.build().unwrap().surfaces["plate"].surface.laws().restitution, 0.4);
    for outside in ["0", "-0.5", "1.01"] {
        let refusal = refusal(&[&with(outside)]);
        let wanted = "`surfaces.plate.restitution` is out of range";
        assert!(refusal.contains(wanted), "{outside}: {refusal}");
    }
    let refusal = refusal(&[&with("0.5"), "surfaces.plate.elastic=Rigid"]);
    assert!(refusal.contains("`Rigid` has none"), "{refusal}");
}

/// Fails for regions that do not override each other in their order, for a box without its faces,
/// and for a hardness that is not the one asked for.
#[test]
fn regions_give_nodes_a_hardness_of_their_own() {
    let regions = |list: &str| checked(&[&format!("surfaces.plate.regions=[{list}]")]);
    let left = "(hardness: \"13.2 GPa\", box: (from: (-1, -1, 0), to: (0, 1, 0)))";
    let low = "(hardness: 3.3e9, box: (from: (-1, -1, 0), to: (1, \"-1 mm\", 0)))";
    let built = regions(&format!("{left}, {low}")).build().expect("a scene");
    let plate = &built.surfaces["plate"].surface;
    for (i, at) in plate.nodes().rest_position.iter().enumerate() {
        let expected = match (at.y <= -1e-3, at.x <= 0.0) {
            (true, _) => 3.3e9,
            (false, true) => 13.2e9,
            (false, false) => 6.6e9,
        };
        assert_eq!(plate.hardness(i), expected, "{at}");
    }
    assert_eq!(plate.least_hardness(), 3.3e9);
    assert!(
        checked(&[]).build().expect("a scene").surfaces["plate"]
            .surface
            .hardness_factors()
            .is_none()
    );
}
