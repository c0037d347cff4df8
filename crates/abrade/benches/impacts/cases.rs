//! The impacts that are timed: one body, one plate, landings that repeat on fresh sites of the
//! lattice, so that every one of them meets the same undeformed surface.

use abrade::{
    Advance, Ball, Body, ElasticLaw, Encounter, EncounterSettings, FlowLaw, HertzConvention,
    HexStrip, Hull, Inertia, Lateral, Loads, Material, Piece, Placed, Polyhedron, Shape, State,
    Surface, SurfaceLaws, Until,
};
use nalgebra::{Isometry3, Matrix3, Point3, UnitQuaternion, Vector3};

/// A body fired at a plate.
#[derive(Clone)]
pub struct Case {
    pub name: String,
    pub body: Body,
    pub strip: HexStrip,
    pub laws: SurfaceLaws,
    pub settings: EncounterSettings,
    /// Landing from a node [m].
    pub at: [f64; 2],
    /// Distance of fresh sites [m], at least.
    pub apart: f64,
}

/// A plate and the sites on it that are still fresh.
pub struct Range {
    case: Case,
    surface: Surface,
    sites: Vec<[f64; 2]>,
    next: usize,
}

impl Case {
    /// The same impact with another target for the time error.
    pub fn with_accuracy(mut self, accuracy: f64) -> Self {
        self.settings.accuracy = accuracy;
        self
    }

    /// Same impact, plate of another extent.
    pub fn on(mut self, strip: HexStrip) -> Self {
        self.strip = strip;
        self
    }

    pub fn plate(&self) -> Surface {
        Surface::hex_strip(self.strip, self.laws.clone()).expect("a plate")
    }

    /// Displaced volume [m3] of a single landing.
    pub fn wear(&self) -> f64 {
        let mut range = Range::new(self.clone());
        range.fire();
        range.surface.wear_volume()
    }
}

impl Range {
    pub fn new(case: Case) -> Self {
        let surface = case.plate();
        let sites = sites(&case, &surface);
        Self { case, surface, sites, next: 0 }
    }

    /// Takes a fresh plate where the next landing needs one.
    pub fn make_ready(&mut self) {
        if self.next == self.sites.len() {
            self.surface = self.case.plate();
            self.next = 0;
        }
    }

    /// One impact from first touch to exit, a new encounter included.
    pub fn fire(&mut self) -> Advance {
        let [x, y] = self.sites[self.next];
        self.next += 1;
        let mut body = self.case.body.clone();
        body.state.position.x = x + self.case.at[0];
        body.state.position.y = y + self.case.at[1];
        let surface = &mut self.surface;
        let mut encounter = Encounter::new(&body, [&*surface], self.case.settings).expect("laws");
        let mut placed = [Placed::at_rest(surface, Isometry3::identity())];
        encounter
            .advance(&mut body, &mut placed, &Loads::default(), 1e9, Until::FirstExit, &mut ())
            .expect("an impact")
    }
}

/// Nodes far enough from each other and from the edges; the middle one first.
fn sites(case: &Case, surface: &Surface) -> Vec<[f64; 2]> {
    let pitch = surface.pitch();
    let across = 2.0 * pitch * 0.75f64.sqrt();
    let [low, high] = surface.bounds();
    let strides = [across, pitch].map(|period| (case.apart / period).ceil() * period);
    let reach = |a: usize| {
        let room = (high[a].min(-low[a]) - case.apart).max(0.0);
        (room / strides[a]) as i64
    };
    let [columns, rows] = [reach(0).min(40), reach(1).min(40)];
    let place = |i: i64, j: i64| [i as f64 * strides[0], j as f64 * strides[1]];
    let mut sites: Vec<_> =
        (-columns..=columns).flat_map(|i| (-rows..=rows).map(move |j| (i, j))).collect();
    sites.sort_by_key(|(i, j)| i * i + j * j);
    sites.into_iter().map(|(i, j)| place(i, j)).collect()
}

pub fn projected() -> FlowLaw {
    FlowLaw::CapozzaHanley { lateral: Lateral::Projected }
}

pub fn hertz() -> ElasticLaw {
    ElasticLaw::HertzNodes { node_radius: 0.25e-3, convention: HertzConvention::ElasticPair }
}

pub fn foundation() -> ElasticLaw {
    ElasticLaw::Foundation { stiffness: None }
}

/// The paper's oblique impact: R 3 mm, 35 m/s.
pub fn paper(
    name: &str,
    elastic: ElasticLaw,
    flow: FlowLaw,
    angle: f64,
    pitch: Option<f64>,
) -> Case {
    let strip = match pitch {
        None => HexStrip::with_nodes(93.5e-3, 16.8e-3, 5012.0),
        Some(pitch) => HexStrip { length: 16e-3, width: 12e-3, pitch, rest_area: None },
    };
    let inflation = if pitch.is_none() { 0.25e-3 } else { 0.0 };
    let radius = 3e-3;
    let material = Material {
        hardness: 6.6e9,
        shear_ratio: 0.25,
        young: Some(200e9),
        poisson: 0.3,
        friction: 0.5,
    };
    let body = fired(
        Shape::ball(radius).expect("a ball"),
        Inertia::of_ball(radius, 2500.0),
        UnitQuaternion::identity(),
        angle,
        35.0,
        inflation,
    );
    Case {
        name: format!("{name} {angle} deg"),
        body,
        strip,
        laws: SurfaceLaws { elastic, flow, ..SurfaceLaws::of(material) },
        settings: EncounterSettings { accuracy: 3e-3, ..Default::default() },
        at: [0.173662e-3, 0.300792e-3],
        apart: 1.6e-3,
    }
}

/// A unit body of mass `0.02 H L^3 / v^2` in the units of rigid-plastic theory.
pub fn unit(name: &str, shape: Shape, inertia: Inertia, elastic: ElasticLaw, pitch: f64) -> Case {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 0.2));
    let material = Material {
        hardness: 1.0,
        shear_ratio: 0.25,
        young: Some(1e3),
        poisson: 0.3,
        friction: 0.0,
    };
    let flow = FlowLaw::NormalPressure {};
    let laws = SurfaceLaws { elastic, flow, ..SurfaceLaws::of(material) };
    Case {
        name: name.into(),
        body: fired(shape, inertia, rotation, 30.0, 1.0, 0.0),
        strip: HexStrip { length: 3.4, width: 2.4, pitch, rest_area: None },
        laws,
        settings: EncounterSettings { accuracy: 3e-3, ..Default::default() },
        at: [0.003, 0.001],
        apart: 2.0,
    }
}

pub fn cube() -> (Shape, Inertia) {
    solid(Polyhedron::Cube)
}

/// Twelve faces: its corners are the middles of an icosahedron's.
pub fn dodecahedron() -> (Shape, Inertia) {
    let (icosahedron, ..) =
        Hull::solid(&Polyhedron::Icosahedron.vertices(1.0), 1.0).expect("a solid");
    let corners = icosahedron.vertices();
    let middle = |facet: &[u32; 3]| {
        Point3::from(facet.iter().map(|&i| corners[i as usize].coords).sum::<Vector3<f64>>() / 3.0)
    };
    of_mass(&icosahedron.facets().iter().map(middle).collect::<Vec<_>>())
}

/// A hull of as many faces as corners of a spiral around a ball touch: 2 n - 4 of n corners.
pub fn pebble(faces: usize) -> (Shape, Inertia) {
    let count = faces / 2 + 2;
    let corner = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (turn, radius) = (2.399_963 * i as f64, (1.0 - z * z).sqrt());
        Point3::new(radius * turn.cos(), radius * turn.sin(), z) * 0.6
    };
    of_mass(&(0..count).map(corner).collect::<Vec<_>>())
}

pub fn solid(kind: Polyhedron) -> (Shape, Inertia) {
    of_mass(&kind.vertices(1.0))
}

fn of_mass(corners: &[Point3<f64>]) -> (Shape, Inertia) {
    let (hull, inertia, _) = Hull::solid(corners, 1.0).expect("a solid");
    let scale = 0.02 / inertia.mass;
    (Shape::hull(hull), Inertia { mass: 0.02, tensor: inertia.tensor * scale })
}

pub fn ball() -> (Shape, Inertia) {
    let density = 0.02 / (std::f64::consts::PI / 6.0);
    (Shape::ball(0.5).expect("a ball"), Inertia::of_ball(0.5, density))
}

pub fn clump() -> (Shape, Inertia) {
    let balls = [[0.25, 0.0, 0.0, 0.3], [-0.25, 0.05, 0.0, 0.25], [0.0, -0.1, 0.2, 0.3]]
        .map(|[x, y, z, radius]| Piece::Ball(Ball { centre: Point3::new(x, y, z), radius }));
    let tensor = Matrix3::from_diagonal(&Vector3::new(0.6e-3, 1.3e-3, 1.5e-3));
    (Shape::union(balls.into()).expect("a clump"), Inertia { mass: 0.02, tensor })
}

fn fired(
    shape: Shape,
    inertia: Inertia,
    rotation: UnitQuaternion<f64>,
    angle: f64,
    speed: f64,
    inflation: f64,
) -> Body {
    let height = inflation - shape.lowest(&rotation, &Vector3::z());
    let gap = 1e-9 * shape.bounding_radius();
    let mut state = State::at(Point3::new(0.0, 0.0, height + gap));
    let angle = angle.to_radians();
    state.rotation = rotation;
    state.velocity = Vector3::new(angle.cos(), 0.0, -angle.sin()) * speed;
    Body { shape, inertia, state, rotation_locked: false }
}
