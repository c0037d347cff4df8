//! A step allocates nothing: of three identical impacts with the same encounter, on fresh sites of
//! one plate, the third runs from its first step to its exit in the buffers that the others grew.
//! (The first begins without a step length to go by, so that only the second and the third take
//! the same steps.) A contact that needs a longer candidate list than any before it may allocate.

mod counting;
mod soft;

use abrade::{
    Ball, Body, ElasticLaw, Encounter, EncounterSettings, FlowLaw, HertzConvention, HexStrip, Hull,
    Inertia, Instant, Lateral, Loads, Observer, Piece, Placed, Polyhedron, Removal, Shape, State,
    Surface, SurfaceLaws, Until,
};
use counting::counted;
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use soft::soft;

/// Allocations seen up to the first step, and up to the last.
#[derive(Default)]
struct Watch {
    first: Option<usize>,
    last: usize,
    steps: usize,
}

impl Observer for Watch {
    fn observe(&mut self, _: &Instant<'_, '_>) {
        self.last = counted();
        self.first.get_or_insert(self.last);
        self.steps += 1;
    }
}

const PITCH: f64 = 0.03;

/// Allocations of three impacts, from the first observed step of each on.
fn allocations(shape: Shape, elastic: ElasticLaw, flow: FlowLaw, removal: Removal) -> [usize; 3] {
    let inflation = match elastic {
        ElasticLaw::HertzNodes { node_radius, .. } => node_radius,
        _ => 0.0,
    };
    let laws = SurfaceLaws { elastic, flow, removal, ..SurfaceLaws::of(soft()) };
    let strip = HexStrip { length: 8.0, width: 3.0, pitch: PITCH, rest_area: None };
    let mut surface = Surface::hex_strip(strip, laws).expect("a plate");
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 0.2));
    let height = inflation + 1e-6 - shape.lowest(&rotation, &Vector3::z());
    let fired = |x: f64| State {
        position: Point3::new(x, 0.0, height),
        rotation,
        velocity: Vector3::new(0.7, 0.0, -0.7),
        spin: Vector3::zeros(),
    };
    let inertia = Inertia::of_ball(0.5, 0.04);
    let mut body = Body { shape, inertia, state: fired(0.0), rotation_locked: false };
    let settings = EncounterSettings { ledger: true, ..Default::default() };
    let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
    // Two columns of the lattice make its period along x.
    let period = 2.0 * PITCH * 0.75f64.sqrt();
    [-40.0, 0.0, 40.0].map(|periods| {
        body.state = fired(periods * period);
        let mut watch = Watch::default();
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        let advance = encounter
            .advance(&mut body, &mut placed, &Loads::default(), 20.0, Until::FirstExit, &mut watch)
            .expect("an impact");
        assert!(advance.exited && watch.steps > 20, "{} steps", watch.steps);
        watch.last - watch.first.expect("a step")
    })
}

fn check(name: &str, shape: Shape, elastic: ElasticLaw, flow: FlowLaw) {
    let removal = Removal::AttackAngle { critical: 0.5 };
    let [first, second, third] = allocations(shape, elastic, flow, removal);
    println!("{name}: {first}, {second} and {third} allocations");
    assert_eq!(third, 0, "{name}");
    assert!(first > 0, "{name}: the counter counts nothing");
}

fn clump() -> Shape {
    let balls = [[0.25, 0.0, 0.0, 0.3], [-0.25, 0.05, 0.0, 0.25], [0.0, -0.1, 0.2, 0.3]]
        .map(|[x, y, z, radius]| Piece::Ball(Ball { centre: Point3::new(x, y, z), radius }));
    Shape::union(balls.into()).expect("a clump")
}

fn cube() -> Shape {
    let (hull, ..) = Hull::solid(&Polyhedron::Cube.vertices(0.8), 1.0).expect("a cube");
    Shape::hull(hull)
}

/// Fails for a buffer, a list of answers or a copy of a law made anew in every step.
#[test]
fn a_step_allocates_nothing() {
    let ball = || Shape::ball(0.5).expect("a ball");
    let springs = || ElasticLaw::Foundation { stiffness: Some(100.0) };
    let hertz =
        || ElasticLaw::HertzNodes { node_radius: 0.01, convention: HertzConvention::ElasticPair };
    let paper = || FlowLaw::CapozzaHanley { lateral: Lateral::Projected };
    let pressure = || FlowLaw::NormalPressure {};
    check("ball on a foundation", ball(), springs(), paper());
    check("ball on Hertz nodes", ball(), hertz(), paper());
    check("ball, rigid", ball(), ElasticLaw::Rigid, pressure());
    check("clump on a foundation", clump(), springs(), pressure());
    check("cube on a foundation", cube(), springs(), paper());
    check("cube, rigid", cube(), ElasticLaw::Rigid, pressure());
}
