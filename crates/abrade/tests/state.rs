//! Bytes of a running contact: going on from them gives the same bits as going on without, and no
//! bytes whatever lead to a panic.

mod soft;

use abrade::{
    Advance, Ball, Body, Drive, DriveSolution, Driven, ElasticLaw, Encounter, EncounterSettings,
    HertzConvention, HexStrip, Hull, Inertia, Loads, PhysicsError, Piece, Placed, Polyhedron,
    Shape, State, Surface, SurfaceLaws, TriangleMesh, Until,
};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use soft::soft;

/// All that a run goes on from.
#[derive(Clone, Serialize, Deserialize)]
struct Run<E> {
    surface: Surface,
    body: Body,
    contact: E,
}

/// What carries a body through time.
trait Carrier: Clone + Serialize + DeserializeOwned {
    fn go(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>; 1],
        time: f64,
    ) -> Result<Advance, PhysicsError>;
}

impl Carrier for Encounter {
    fn go(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>; 1],
        time: f64,
    ) -> Result<Advance, PhysicsError> {
        let loads = Loads { gravity: Vector3::new(0.1, 0.0, -0.1), ..Loads::default() };
        self.advance(body, placed, &loads, time, Until::Duration, &mut ())
    }
}

impl Carrier for Driven {
    fn go(
        &mut self,
        body: &mut Body,
        placed: &mut [Placed<'_>; 1],
        time: f64,
    ) -> Result<Advance, PhysicsError> {
        self.advance(body, placed, time, &mut ())
    }
}

impl<E: Carrier> Run<E> {
    fn go(&mut self, time: f64) -> Result<Advance, PhysicsError> {
        let mut placed = [Placed::at_rest(&mut self.surface, Isometry3::identity())];
        self.contact.go(&mut self.body, &mut placed, time)
    }

    fn bytes(&self) -> Vec<u8> {
        postcard::to_stdvec(self).expect("bytes")
    }
}

/// Steps that a run may take: damaged ones may ask for any number of them.
const MANY: u64 = 3000;
const FEW: u64 = 150;

const HERTZ: ElasticLaw =
    ElasticLaw::HertzNodes { node_radius: 0.02, convention: HertzConvention::ElasticPair };
const SPRINGS: ElasticLaw = ElasticLaw::Foundation { stiffness: Some(100.0) };

fn plate(elastic: ElasticLaw, restitution: f64) -> Surface {
    let laws = SurfaceLaws { elastic, restitution, ..SurfaceLaws::of(soft()) };
    let strip = HexStrip { length: 2.0, width: 1.6, pitch: 0.08, rest_area: None };
    Surface::hex_strip(strip, laws).expect("a plate")
}

fn shapes() -> [(&'static str, Shape, ElasticLaw); 5] {
    let ball = || Shape::ball(0.5).expect("a ball");
    let balls = [[0.25, 0.0, 0.0, 0.3], [-0.25, 0.05, 0.0, 0.25], [0.0, -0.1, 0.2, 0.3]]
        .map(|[x, y, z, radius]| Piece::Ball(Ball { centre: Point3::new(x, y, z), radius }));
    let (hull, ..) = Hull::solid(&Polyhedron::Cube.vertices(0.8), 1.0).expect("a cube");
    [
        ("ball on a foundation", ball(), SPRINGS),
        ("ball on Hertz nodes", ball(), HERTZ),
        ("clump", Shape::union(balls.into()).expect("a clump"), SPRINGS),
        ("cube", Shape::hull(hull.clone()), SPRINGS),
        ("cube on Hertz nodes", Shape::hull(hull), HERTZ),
    ]
}

/// A body just above the plate, on its way down.
fn landing(shape: Shape, elastic: ElasticLaw, restitution: f64, step_limit: u64) -> Run<Encounter> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 0.2));
    let lift = if elastic == HERTZ { 0.02 } else { 0.0 };
    let surface = plate(elastic, restitution);
    let state = State {
        position: Point3::new(0.01, 0.02, lift + 1e-4 - shape.lowest(&rotation, &Vector3::z())),
        rotation,
        velocity: Vector3::new(0.5, 0.0, -0.5),
        spin: Vector3::new(0.1, 0.4, 0.0),
    };
    let inertia = Inertia::of_ball(0.5, 0.04);
    let body = Body { shape, inertia, state, rotation_locked: false };
    let settings = EncounterSettings { ledger: true, step_limit, ..Default::default() };
    let contact = Encounter::new(&body, [&surface], settings).expect("an encounter");
    Run { surface, body, contact }
}

/// A body just above a block that another one has worn, and that was renewed since.
fn onto_a_renewed_block(step_limit: u64) -> Run<Encounter> {
    let down = Isometry3::translation(0.0, 0.0, -0.3);
    let block = TriangleMesh::cuboid(Vector3::new(0.8, 0.7, 0.3), 0.1).expect("a block");
    let laws = plate(SPRINGS, 1.0).laws().clone();
    let mut run = landing(Shape::ball(0.5).expect("a ball"), SPRINGS, 1.0, MANY);
    run.surface = Surface::mesh(&block.moved(&down), laws).expect("a surface");
    // Hard and soft nodes in turn.
    let factors = (0..run.surface.nodes().len()).map(|i| [1.0, 1.5][i % 2]).collect();
    run.surface.set_hardness_factors(factors).expect("factors");
    let contact = |run: &Run<Encounter>, step_limit: u64| {
        let settings = EncounterSettings { ledger: true, step_limit, ..Default::default() };
        Encounter::new(&run.body, [&run.surface], settings).expect("an encounter")
    };
    run.contact = contact(&run, MANY);
    let body = run.body.clone();
    run.go(1.5).expect("a blow");
    run.surface.renew().expect("a renewal");
    run.body = body;
    run.contact = contact(&run, step_limit);
    run
}

/// A body pressed in and ready to slide.
fn scratch(elastic: ElasticLaw, solution: DriveSolution, step_limit: u64) -> Run<Driven> {
    let mut surface = plate(elastic.clone(), 1.0);
    let mut body = landing(Shape::ball(0.5).expect("a ball"), elastic, 1.0, step_limit).body;
    let (indent_to, load) = (0.02, 0.02);
    let drive = Drive { indent_to, load, speed: 0.2, distance: 0.4, mass: 0.02, solution };
    let settings = EncounterSettings { ledger: true, step_limit, ..Default::default() };
    let mut contact = Driven::new(&mut body, &surface, drive, settings).expect("a drive");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    contact.indent(&mut body, &mut placed, &mut ()).expect("an indentation");
    Run { surface, body, contact }
}

/// Goes on from bytes and without; both must end in the same bytes.
fn goes_on<E: Carrier>(name: &str, mut run: Run<E>, times: [f64; 2]) {
    run.go(times[0]).expect("the first part");
    let bytes = run.bytes();
    let mut read: Run<E> = postcard::from_bytes(&bytes).expect(name);
    assert!(read.bytes() == bytes, "{name}: bytes change by being read");
    let [direct, resumed] =
        [&mut run, &mut read].map(|run| run.go(times[1]).expect("the second part"));
    println!("{name}: {} bytes, {} steps", bytes.len(), direct.steps);
    assert!(direct.steps > 5 && run.surface.wear_volume() > 0.0, "{name}");
    assert_eq!(direct, resumed, "{name}");
    assert!(run.bytes() == read.bytes(), "{name}");
    assert_eq!(run.surface.worn(), read.surface.worn(), "{name}");
    let depths = |s: &Surface| (0..s.nodes().len()).map(|i| s.worn_depth(i)).collect::<Vec<_>>();
    assert_eq!(depths(&run.surface), depths(&read.surface), "{name}");
    assert_eq!(run.surface.is_due_for_renewal(), read.surface.is_due_for_renewal(), "{name}");
}

/// Fails for a state that is left out, or read in another order.
#[test]
fn a_run_goes_on_from_its_bytes_to_the_bit() {
    for restitution in [1.0, 0.5] {
        for (name, shape, elastic) in shapes() {
            let run = landing(shape, elastic, restitution, MANY);
            let mut probe = run.clone();
            probe.go(0.06).expect("the first part");
            assert!(probe.contact.in_contact(), "{name} is not in contact");
            goes_on(name, run, [0.06, 1.5]);
        }
    }
    let run = onto_a_renewed_block(MANY);
    assert_eq!(run.surface.renewals(), 1);
    let worn = |surface: &Surface| (0..surface.nodes().len()).any(|i| surface.worn_depth(i) > 0.0);
    assert!(worn(&run.surface) && run.surface.worn().max_depth > 0.0);
    goes_on("renewed block", run, [0.1, 1.5]);
    let (dynamic, creep) = (DriveSolution::Dynamic, DriveSolution::QuasiStatic { increment: 0.01 });
    goes_on("dynamic scratch", scratch(SPRINGS, dynamic, MANY), [0.3, 0.5]);
    for elastic in [SPRINGS, ElasticLaw::Rigid] {
        goes_on("creeping scratch", scratch(elastic, creep, MANY), [0.3, 0.5]);
    }
}

/// Fails for a check that is missing: what is read is advanced, whatever it is.
fn survives<E: Carrier>(mut run: Run<E>, time: f64) {
    run.go(time).expect("the first part");
    let bytes = run.bytes();
    let go_on = |bytes: &[u8]| match postcard::from_bytes::<Run<E>>(bytes) {
        Ok(mut read) => read.go(1e-3).is_ok(),
        Err(_) => false,
    };
    assert!(go_on(&bytes));
    for length in (0..bytes.len()).step_by(1 + bytes.len() / 300) {
        assert!(postcard::from_bytes::<Run<E>>(&bytes[..length]).is_err(), "{length} bytes");
    }
    // The beginning and the end, and a sample of what lies between.
    let stride = 1 + bytes.len() / 40;
    let near = |at: &usize| *at < 120 || bytes.len() - at < 400 || at.is_multiple_of(stride);
    for at in (0..bytes.len()).filter(near) {
        for bit in [0, 4, 6, 7] {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            go_on(&damaged);
        }
    }
}

#[test]
fn damaged_bytes_are_refused_or_can_be_stepped() {
    for (_, shape, elastic) in shapes().into_iter().skip(1).take(3) {
        survives(landing(shape, elastic, 0.5, FEW), 0.06);
    }
    survives(onto_a_renewed_block(FEW), 0.06);
    survives(scratch(SPRINGS, DriveSolution::Dynamic, FEW), 0.1);
    survives(scratch(SPRINGS, DriveSolution::QuasiStatic { increment: 0.01 }, FEW), 0.1);
}

/// Fails for candidates that are looked up in a surface that lacks them.
#[test]
fn another_surface_is_refused() {
    let [(_, shape, elastic), ..] = shapes();
    let mut run = landing(shape, elastic, 1.0, MANY);
    run.go(0.06).expect("the first part");
    let strip = HexStrip { length: 0.5, width: 0.5, pitch: 0.08, rest_area: None };
    run.surface = Surface::hex_strip(strip, run.surface.laws().clone()).expect("a plate");
    let error = run.go(0.1).unwrap_err();
    assert!(matches!(error, PhysicsError::Unsupported { .. }), "{error}");
}

/// Fails for a leaf that is written without the nodes of the surface below, or without its own wear.
#[test]
fn a_leaf_is_written_as_the_surface_that_it_has_become() {
    let [(_, shape, elastic), ..] = shapes();
    let mut run = landing(shape, elastic, 1.0, MANY);
    run.surface = Surface::leaf(&std::sync::Arc::new(run.surface));
    run.go(1.5).expect("a blow");
    let bytes = postcard::to_stdvec(&run.surface).expect("bytes");
    let read: Surface = postcard::from_bytes(&bytes).expect("a surface");
    assert!(run.surface.wear_volume() > 0.0);
    let depths = |s: &Surface| (0..s.nodes().len()).map(|i| s.depth(i)).collect::<Vec<_>>();
    assert_eq!(depths(&run.surface), depths(&read));
    assert_eq!(run.surface.sublattice_scatter(), read.sublattice_scatter());
}
