//! Two wearing bodies: the nodes of each against the surface of the other.

use abrade::{
    Body, Carrier, ElasticLaw, Encounter, EncounterSettings, FlowLaw, HexStrip, Inertia, Instant,
    Lateral, Ledger, Loads, Material, Observer, PhysicsError, Placed, Shape, Skin, State, Surface,
    SurfaceLaws, TriangleMesh, Until,
};
use nalgebra::{Isometry3, Point3, Vector3};

const MASS: f64 = 0.02;
const RADIUS: f64 = 0.5;
/// Speed of approach of the pair [m/s].
const SPEED: f64 = 0.5;

fn laws(hardness: f64, flow: FlowLaw, friction: f64) -> SurfaceLaws {
    let material =
        Material { hardness, shear_ratio: 0.25, young: Some(100.0), poisson: 0.3, friction };
    let elastic = ElasticLaw::Foundation { stiffness: Some(300.0 * hardness) };
    SurfaceLaws { elastic, flow, ..SurfaceLaws::of(material) }
}

fn frictionless(hardness: f64) -> SurfaceLaws {
    laws(hardness, FlowLaw::NormalPressure {}, 0.0)
}

/// A sphere, turned so that no node comes to lie on the axis of the pair, and its mirror image.
fn twins(pitch: f64) -> [TriangleMesh; 2] {
    let turn = Isometry3::rotation(Vector3::new(0.7, -1.1, 0.4));
    let sphere = TriangleMesh::sphere(RADIUS, pitch).expect("a sphere").moved(&turn);
    let mirrored = sphere.vertices().iter().map(|x| Point3::new(x.x, x.y, -x.z)).collect();
    let facets = sphere.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect();
    let image = TriangleMesh::new(mirrored, facets).expect("its image");
    [sphere, image]
}

fn inertia() -> Inertia {
    Inertia::of_ball(RADIUS, MASS / (4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3)))
}

/// The largest force of a contact.
#[derive(Default)]
struct Peak(f64);

impl Observer for Peak {
    fn observe(&mut self, instant: &Instant<'_, '_>) {
        self.0 = self.0.max(instant.force.norm());
    }
}

/// A sphere on a carrier, and the one that comes down on it along z.
struct Pair {
    /// Surfaces of the one on the carrier and of the body.
    surfaces: [Surface; 2],
    states: [State; 2],
}

struct Parting {
    surfaces: [Surface; 2],
    states: [State; 2],
    ledger: Ledger,
    force: f64,
    /// Kinetic energies of the pair before and after [J].
    energy: [f64; 2],
}

impl Pair {
    /// Head on, each at half the speed of approach.
    fn new([below, above]: [&TriangleMesh; 2], laws: [SurfaceLaws; 2]) -> Self {
        let [first, second] = laws;
        let surface = |mesh, laws| Surface::mesh(mesh, laws).expect("a surface");
        let at = |side: f64| State {
            velocity: Vector3::z() * (-0.5 * SPEED * side),
            ..State::at(Point3::new(0.0, 0.0, side * (RADIUS + 1e-3)))
        };
        Self {
            surfaces: [surface(below, first), surface(above, second)],
            states: [at(-1.0), at(1.0)],
        }
    }

    fn body(&self) -> Body {
        let shape = Shape::ball(RADIUS).expect("a ball");
        Body { shape, inertia: inertia(), state: self.states[1], rotation_locked: false }
    }

    /// Until they part. With `wears` both may wear, else only the one on the carrier, which the body
    /// strikes as a perfect ball.
    fn run(self, wears: bool) -> Result<Parting, PhysicsError> {
        let mut body = self.body();
        let [mut below, mut above] = self.surfaces;
        let settings = EncounterSettings { ledger: true, ..Default::default() };
        let pose = self.states[0].pose();
        let (state, loads) = (self.states[0], Loads::default());
        let carrier = Some(Carrier { state, inertia: Some(inertia()), loads });
        let skin = Skin { surface: &mut above, pose: Isometry3::identity() };
        let mut encounter = match wears {
            true => Encounter::of_two(&body, &skin, &below, settings)?,
            false => Encounter::new(&body, [&below], settings)?,
        };
        skin.surface.settle();
        let skin = wears.then_some(skin);
        let energy = |states: [&State; 2]| -> f64 {
            states.iter().map(|state| inertia().kinetic_energy(state)).sum()
        };
        let before = energy([&state, &body.state]);
        let mut placed = [Placed { surface: &mut below, pose, carrier, skin }];
        let mut peak = Peak::default();
        let until = Until::FirstExit;
        encounter.advance(&mut body, &mut placed, &loads, 10.0, until, &mut peak)?;
        let [Placed { carrier, .. }] = placed;
        let states = [carrier.expect("a carrier").state, body.state];
        Ok(Parting {
            surfaces: [below, above],
            ledger: *encounter.ledger(),
            force: peak.0,
            energy: [before, energy([&states[0], &states[1]])],
            states,
        })
    }
}

/// H W of both [J].
fn price(parting: &Parting) -> f64 {
    let of = |s: &Surface| s.laws().material.hardness * s.worn().displaced();
    parting.surfaces.iter().map(of).sum()
}

/// Fails for a pair in which one side is treated in another way than the other, for a force that is
/// counted for each of the surfaces, and for drops that both take in full.
#[test]
fn equal_spheres_wear_each_other_alike() {
    let twins = twins(0.03);
    let laws = || [frictionless(1.0), frictionless(1.0)];
    let one = Pair::new([&twins[0], &twins[1]], laws()).run(false).expect("a contact");
    let both = Pair::new([&twins[0], &twins[1]], laws()).run(true).expect("a contact");
    let [below, above] = &both.surfaces;
    let deepest = below.worn().max_depth;
    let mirror = |i: usize| (below.depth(i) - above.depth(i)).abs();
    let worst = (0..below.nodes().len()).map(mirror).fold(0.0, f64::max);
    let lost = both.energy[0] - both.energy[1];
    let closed = price(&both) / lost - 1.0;
    let ratio = |a: f64, b: f64| a / b - 1.0;
    let force = ratio(both.force, one.force);
    let volume = ratio(price(&both), price(&one));
    let leaving = both.states[1].velocity.z - both.states[0].velocity.z;
    let parted = ratio(leaving, one.states[1].velocity.z - one.states[0].velocity.z);
    println!(
        "deepest {deepest:.5}, mirror {:.1e}, H W / E - 1 = {closed:.1e}; against one that wears: \
         force {force:.1e}, volume {volume:.1e}, restitution {parted:.1e}",
        worst / deepest
    );
    assert!(deepest > 0.01 && worst < 1e-6 * deepest);
    assert!(closed.abs() < 1e-3);
    assert!(force.abs() < 0.02 && volume.abs() < 0.01);
}

/// Fails for nodes of the harder that sink, and for a softer one that meets something else than the
/// sphere.
#[test]
fn of_two_hardnesses_only_the_softer_wears() {
    let twins = twins(0.03);
    for hard in [0, 1] {
        let laws = [0, 1].map(|at| frictionless(if at == hard { 2.0 } else { 1.0 }));
        let pair = Pair::new([&twins[0], &twins[1]], laws).run(true).expect("a contact");
        let soft = Pair::new([&twins[0], &twins[1]], [frictionless(1.0), frictionless(1.0)]);
        let ball = soft.run(false).expect("a contact");
        let [worn, whole] = [1 - hard, hard].map(|at| pair.surfaces[at].worn());
        let closed = price(&pair) / (pair.energy[0] - pair.energy[1]) - 1.0;
        let volume = worn.displaced() / ball.surfaces[0].worn().displaced() - 1.0;
        let depth = worn.max_depth / ball.surfaces[0].worn().max_depth - 1.0;
        println!(
            "hard {hard}: H W / E - 1 = {closed:.1e}, as under a ball {volume:.1e} {depth:.1e}"
        );
        assert_eq!(whole.displaced(), 0.0);
        assert!(closed.abs() < 1e-3 && volume.abs() < 0.01 && depth.abs() < 0.02);
    }
}

/// Fails for a force that does not act on both, or acts on them at two places.
#[test]
fn a_pair_keeps_its_momentum() {
    let twins = twins(0.04);
    for hardness in [[1.0, 1.0], [1.0, 2.0], [2.0, 1.0]] {
        let flow = FlowLaw::CapozzaHanley { lateral: Lateral::Projected };
        let laws = hardness.map(|h| laws(h, flow.clone(), 0.2));
        let mut pair = Pair::new([&twins[0], &twins[1]], laws);
        pair.states[1].position.x += 0.3;
        pair.states[1].velocity.y += 0.1;
        pair.states[1].spin = Vector3::new(0.2, 1.0, -0.4);
        pair.states[0].spin = Vector3::new(-0.5, 0.1, 0.7);
        let momenta = |states: &[State; 2]| {
            let linear = |s: &State| s.velocity * MASS;
            let angular =
                |s: &State| s.position.coords.cross(&linear(s)) + inertia().tensor * s.spin;
            let sum = |of: &dyn Fn(&State) -> Vector3<f64>| of(&states[0]) + of(&states[1]);
            [sum(&linear), sum(&angular)]
        };
        let before = momenta(&pair.states);
        let parting = pair.run(true).expect("a contact");
        let after = momenta(&parting.states);
        let scale = [MASS * SPEED, MASS * SPEED * RADIUS];
        let missed = [0, 1].map(|i| (after[i] - before[i]).norm() / scale[i]);
        let ledger = parting.ledger;
        let left = ledger.numerical() / parting.energy[0];
        let [linear, angular] = missed;
        println!("{hardness:?}: momentum {linear:.1e}, {angular:.1e}, energy {left:.1e}");
        assert!(linear < 1e-12 && angular < 1e-12);
        assert!(left.abs() < 1e-3, "{left}");
        assert!(parting.energy[1] < parting.energy[0] && price(&parting) > 0.0);
    }
}

/// Fails for a contact plane that is not half-way, whatever the pitch.
#[test]
fn the_craters_of_equals_are_as_deep_as_the_theory() {
    // Shallow beside the radius: pi R* d^2 H = E for the approach d of two spheres that flow,
    // R* = R / 2, of which each loses half.
    let slow = 0.2;
    let energy = 0.25 * MASS * (slow * SPEED).powi(2);
    let depth = 0.5 * (energy / (std::f64::consts::PI * 0.5 * RADIUS)).sqrt();
    let miss = |pitch: f64| {
        let twins = twins(pitch);
        let elastic = ElasticLaw::Foundation { stiffness: Some(3000.0) };
        let laws = || SurfaceLaws { elastic: elastic.clone(), ..frictionless(1.0) };
        let mut pair = Pair::new([&twins[0], &twins[1]], [laws(), laws()]);
        pair.states.iter_mut().for_each(|state| state.velocity *= slow);
        let pair = pair.run(true).expect("a contact");
        let done = 1.0 - pair.energy[1] / pair.energy[0];
        pair.surfaces[0].worn().max_depth / (depth * done.sqrt()) - 1.0
    };
    let misses = [0.03, 0.015, 0.0075].map(miss);
    println!("{misses:.4?}");
    assert!(misses[2].abs() < 0.01, "{misses:?}");
}

/// Fails for a wall that a wearing body meets as if it were convex, and for a lattice of which other
/// facets are met than its own.
#[test]
fn a_sphere_and_what_it_falls_on_wear_alike() {
    let sphere = TriangleMesh::sphere(RADIUS, 0.03).expect("a sphere");
    let tube = TriangleMesh::tube(1.5 * RADIUS, 2.0 * RADIUS, 2.4 * RADIUS, 0.03).expect("a tube");
    let bore = Surface::mesh(&tube, frictionless(1.0)).expect("a bore");
    let strip = HexStrip { length: 1.2, width: 1.2, pitch: 0.03, rest_area: None };
    let plate = Surface::hex_strip(strip, frictionless(1.0)).expect("a plate");
    for (name, mut below, height) in
        [("bore", bore, Vector3::x() * 1.5 * RADIUS), ("plate", plate, Vector3::zeros())]
    {
        let down = if name == "bore" { Vector3::x() } else { -Vector3::z() };
        let position = Point3::from(height - down * (RADIUS + 1e-3));
        let state = State { velocity: down * 0.5, ..State::at(position) };
        let shape = Shape::ball(RADIUS).expect("a ball");
        let mut body = Body { shape, inertia: inertia(), state, rotation_locked: false };
        let mut own = Surface::mesh(&sphere, frictionless(1.0)).expect("a surface");
        let skin = Skin { surface: &mut own, pose: Isometry3::identity() };
        let settings = EncounterSettings { ledger: true, ..Default::default() };
        let mut encounter =
            Encounter::of_two(&body, &skin, &below, settings).expect("an encounter");
        let pose = Isometry3::identity();
        let mut placed = [Placed { surface: &mut below, pose, carrier: None, skin: Some(skin) }];
        let (loads, until) = (Loads::default(), Until::FirstExit);
        let before = inertia().kinetic_energy(&body.state);
        encounter.advance(&mut body, &mut placed, &loads, 10.0, until, &mut ()).expect("a contact");
        let lost = before - inertia().kinetic_energy(&body.state);
        let volumes = [below, own].map(|surface| surface.worn().displaced());
        let closed = (volumes[0] + volumes[1]) / lost - 1.0;
        let apart = volumes[0] / volumes[1] - 1.0;
        println!("{name}: volumes {volumes:?}, apart by {apart:.1e}, H W / E - 1 = {closed:.1e}");
        assert!(closed.abs() < 1e-3 && apart.abs() < 1e-9);
    }
}
/// Fails for two sets of nodes that each have to fit the other's facets: springs thinner than those
/// are rough then let more sink than the motion pays for.
#[test]
fn unlike_meshes_pay_for_what_they_lose_however_stiff() {
    let sphere = &twins(0.04)[0];
    let other = sphere.moved(&Isometry3::rotation(Vector3::new(1.0, -0.4, 2.0)));
    for stiffness in [300.0, 4000.0] {
        let elastic = ElasticLaw::Foundation { stiffness: Some(stiffness) };
        let laws = || SurfaceLaws { elastic: elastic.clone(), ..frictionless(1.0) };
        let pair = Pair::new([sphere, &other], [laws(), laws()]).run(true).expect("a contact");
        let closed = price(&pair) / (pair.energy[0] - pair.energy[1]) - 1.0;
        let [below, above] = pair.surfaces.map(|surface| surface.worn().displaced());
        println!("{stiffness} Pa/m: H W / E - 1 = {closed:.1e}");
        assert!(closed.abs() < 1e-3 && (below / above - 1.0).abs() < 1e-9);
    }
}
