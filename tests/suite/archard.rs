//! Archard's wear: what slides over a surface below its hardness.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use abrade::{
    Archard, Body, ElasticLaw, Encounter, EncounterSettings, HertzConvention, HexStrip, Hold,
    Inertia, Ledger, Loads, Material, Placed, Pressed, Shape, State, Surface, SurfaceLaws,
    TriangleMesh, Until, cuboid_vertices,
};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::theory::hull;

const HARDNESS: f64 = 1e9;

fn laws(coefficient: f64, friction: f64) -> SurfaceLaws {
    let (shear_ratio, poisson) = (0.25, 0.34);
    let material =
        Material { hardness: HARDNESS, shear_ratio, young: Some(110e9), poisson, friction };
    SurfaceLaws { archard: Some(Archard { coefficient }), ..SurfaceLaws::of(material) }
}

fn body(shape: Shape, at: Point3<f64>) -> Body {
    Body {
        shape,
        inertia: Inertia::of_ball(1e-3, 8e3),
        state: State::at(at),
        rotation_locked: true,
    }
}

/// Slides `body` by `way` [m] along x, pressed down by `load` [N], in `count` increments.
fn slide(body: &mut Body, surface: &mut Surface, load: f64, way: f64, count: u32) -> Ledger {
    let settings = EncounterSettings { ledger: true, ..EncounterSettings::default() };
    let mut pressed = Pressed::new(body, [&*surface], settings).expect("it fits");
    let mut placed = [Placed::at_rest(surface, Isometry3::identity())];
    let hold = Hold {
        load: -Vector3::z() * load,
        duration: 1.0,
        increment: way / f64::from(count),
        limit: u64::from(2 * count),
        reach: None,
    };
    let mut end = body.state;
    end.position.x += way;
    pressed.advance(body, &mut placed, &end, &hold, &mut ()).expect("a slide");
    *pressed.ledger()
}

/// Height of the cap of a `volume` [m3] of a sphere: V = pi h^2 (R - h/3).
fn cap(volume: f64, radius: f64) -> f64 {
    (0..20).fold(0.0, |height, _| (volume / (PI * (radius - height / 3.0))).sqrt())
}

/// Fails for a loss that is not K F s / H, for one by another slip or another load than the body's, for
/// a pin that is not worn flat, and for a node that is worn twice where it flows as well.
#[test]
fn a_pin_is_worn_to_a_cap() {
    let (radius, load, way, coefficient) = (3e-3, 20.0, 30e-3, 1e-2);
    let mesh = TriangleMesh::sphere(radius, 0.06e-3).expect("a sphere");
    let (plate, _) = hull(&cuboid_vertices(&Vector3::new(40e-3, 2e-3, 1e-3)), 1.0);
    for friction in [0.0, 0.2] {
        let mut pin = Surface::mesh(&mesh, laws(coefficient, friction)).expect("a pin");
        let mut disc = body(plate.clone(), Point3::new(-15e-3, 0.0, radius + 1e-3));
        slide(&mut disc, &mut pin, load, way, 3000);
        let (expected, worn) = (coefficient * load * way / HARDNESS, pin.worn());
        let miss = worn.archard / expected - 1.0;
        let height = cap(pin.wear_volume(), radius);
        let nodes = pin.nodes();
        let off = (0..nodes.len()).map(|i| {
            let up = nodes.rest_position[i].z / radius;
            let cap = if up > 0.0 { radius - (radius - height) / up } else { 0.0 };
            (nodes.depth[i] - cap.max(0.0)).abs() / height
        });
        let off = off.fold(0.0, f64::max);
        let flowed = worn.normal / worn.displaced();
        println!("friction {friction}: {miss:.1e}, cap {off:.1e}, of it flow {flowed:.1e}");
        assert!(miss.abs() < 1e-6, "{miss:e}");
        assert!(off < 1e-2, "{off:e}");
        let twice = worn.displaced() / pin.wear_volume() - 1.0;
        assert!(flowed > 1e-5 && twice.abs() < 1e-12, "{flowed:e} {twice:e}");
    }
}

/// Fails for springs under a flat face, or of nodes that are spheres, that another law wears. A spring
/// sticks before it slips, so what is worn under friction is less than the load times the way.
#[test]
fn a_flat_pin_wears_a_plate() {
    let (load, way, coefficient) = (50.0, 4e-3, 1e-3);
    let (shape, _) = hull(&cuboid_vertices(&Vector3::new(1e-3, 0.7e-3, 1e-3)), 1.0);
    let node_radius = 0.1e-3;
    let hertz = ElasticLaw::HertzNodes { node_radius, convention: HertzConvention::ElasticPair };
    let foundation = ElasticLaw::Foundation { stiffness: None };
    let laws = |elastic: &ElasticLaw, friction| SurfaceLaws {
        elastic: elastic.clone(),
        ..laws(coefficient, friction)
    };
    let wear = |laws: SurfaceLaws, inflation: f64| {
        let strip = HexStrip { length: 10e-3, width: 3e-3, pitch: 0.1e-3, rest_area: None };
        let mut plate = Surface::hex_strip(strip, laws).expect("a plate");
        let mut pin = body(shape.clone(), Point3::new(-2e-3, 0.0, 1e-3 + inflation));
        let ledger = slide(&mut pin, &mut plate, load, way, 400);
        assert!(plate.worn().displaced() == plate.worn().archard, "below the hardness");
        (plate.worn().archard * HARDNESS / coefficient, ledger.friction)
    };
    let [smooth, rough] = [0.0, 0.2].map(|friction| wear(laws(&hertz, friction), node_radius));
    let [whole, stuck] = [smooth, rough].map(|(worn, _)| 1.0 - worn / (load * way));
    let faces = wear(laws(&foundation, 0.2), 0.0);
    let by_friction = faces.0 * 0.2 / faces.1 - 1.0;
    println!("nodes {whole:.1e}, with friction {stuck:.1e}; faces {by_friction:.1e} of friction");
    assert!(whole.abs() < 1e-6 && stuck > 0.0 && stuck < 1e-4, "{whole:e} {stuck:e}");
    assert!(by_friction.abs() < 1e-9, "{by_friction:e}");
}

/// Fails for flow that takes a node to its cap before the loss lets its spring down: below the hardness
/// it would flow for ever.
#[test]
fn a_load_just_below_the_hardness_does_not_flow() {
    let (way, count, coefficient, node_radius) = (1e-3, 40, 0.02, 0.1e-3);
    let (shape, _) = hull(&cuboid_vertices(&Vector3::new(4e-3, 4e-3, 1e-3)), 1.0);
    let elastic = ElasticLaw::HertzNodes { node_radius, convention: HertzConvention::ElasticPair };
    let laws = SurfaceLaws { elastic, ..laws(coefficient, 0.0) };
    let strip = HexStrip { length: 1e-3, width: 1e-3, pitch: 0.1e-3, rest_area: None };
    let mut plate = Surface::hex_strip(strip, laws).expect("a plate");
    let load = 0.95 * HARDNESS * plate.nodes().rest_area.iter().sum::<f64>();
    let mut pin = body(shape, Point3::new(0.0, 0.0, 1e-3 + node_radius));
    slide(&mut pin, &mut plate, load, way, count);
    let worn = plate.worn();
    let depth = worn.archard / f64::from(count) * HARDNESS / load;
    let miss = worn.archard * HARDNESS / (coefficient * load * way) - 1.0;
    println!("{miss:.1e} at {depth:e} m an increment, flow {:e}", worn.normal);
    assert!(miss.abs() < 1e-6 && worn.normal == 0.0, "{miss:e} {:e}", worn.normal);
}

/// Fails for flow that is worn again, and for wear that stops where nodes flow.
#[test]
fn a_ball_that_ploughs_wears_its_groove_as_well() {
    let (load, way, coefficient) = (100.0, 6e-3, 1e-2);
    let groove = |archard: bool| {
        let laws = laws(coefficient, 0.2);
        let laws = SurfaceLaws { archard: laws.archard.clone().filter(|_| archard), ..laws };
        let strip = HexStrip { length: 10e-3, width: 2e-3, pitch: 0.04e-3, rest_area: None };
        let mut plate = Surface::hex_strip(strip, laws).expect("a plate");
        let mut pin = body(Shape::ball(3e-3).expect("a ball"), Point3::new(-3e-3, 0.0, 3e-3));
        slide(&mut pin, &mut plate, load, way, 600);
        plate
    };
    let [alone, both] = [false, true].map(groove);
    let (plain, worn) = (alone.worn(), both.worn());
    let share = worn.archard / (coefficient * load * way / HARDNESS) - 1.0;
    let flow = (worn.normal + worn.lateral) / plain.displaced();
    let twice = worn.displaced() / both.wear_volume() - 1.0;
    println!("worn {share:.1e} off K F s / H; flow {flow} of the flow alone; {twice:.1e} too much");
    // The faces of the groove lean: their loads slide less far than the ball, and are more than its.
    assert!(share.abs() < 2e-2, "{share:e}");
    assert!(plain.archard == 0.0 && plain.displaced() > worn.archard, "{plain:?}");
    assert!(flow > 0.5 && flow < 1.0 && twice.abs() < 1e-12, "{flow} {twice:e}");
}

/// Fails for energy that wear gives or takes unbooked, and for slip that wears what friction does not
/// know of.
#[test]
fn a_glance_below_yield_wears_by_its_friction() {
    let (cube, inertia) = hull(&cuboid_vertices(&Vector3::repeat(1e-3)), 6.4e-5);
    let ball = (Shape::ball(1e-3).expect("a ball"), Inertia::of_ball(1e-3, 8e3));
    for (name, (shape, inertia)) in [("ball", ball), ("cube", (cube, inertia))] {
        let coefficient = 0.1;
        let strip = HexStrip { length: 6e-3, width: 4e-3, pitch: 0.02e-3, rest_area: None };
        let elastic = ElasticLaw::Foundation { stiffness: Some(1e13) };
        let laws = SurfaceLaws { elastic, ..laws(coefficient, 0.2) };
        let mut plate = Surface::hex_strip(strip, laws).expect("a plate");
        let mut state = State::at(Point3::new(0.0, 0.0, 1e-3 + 1e-9));
        state.velocity = Vector3::new(1.0, 0.0, -1.0) * FRAC_1_SQRT_2;
        let mut body = Body { shape, inertia, state, rotation_locked: true };
        let energy = body.inertia.kinetic_energy(&body.state);
        let settings =
            EncounterSettings { ledger: true, accuracy: 1e-4, ..EncounterSettings::default() };
        let mut encounter = Encounter::new(&body, [&plate], settings).expect("it fits");
        let mut placed = [Placed::at_rest(&mut plate, Isometry3::identity())];
        let loads = Loads::default();
        encounter
            .advance(&mut body, &mut placed, &loads, 1.0, Until::FirstExit, &mut ())
            .expect("it leaves");
        let (ledger, worn) = (*encounter.ledger(), plate.worn());
        let by_friction = worn.archard * HARDNESS / coefficient * 0.2 / ledger.friction - 1.0;
        let numerical = ledger.numerical() / energy;
        let parts = [ledger.wear / energy, ledger.friction / energy, worn.normal];
        println!("{name}: {by_friction:.1e} of friction, numerical {numerical:.1e}, {parts:?}");
        assert!(by_friction.abs() < 2e-2 && numerical.abs() < 1e-4, "{name}");
        assert!(worn.archard > 0.0 && ledger.wear > 0.0, "{name}");
    }
}
