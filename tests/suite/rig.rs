//! Set-ups shared by the tests: the paper's plate and bodies, one impact at a time.

use abrade::{
    Body, ElasticLaw, Encounter, EncounterSettings, FlowLaw, HertzConvention, HexStrip, Inertia,
    Lateral, Loads, Material, Observer, Placed, Shape, State, Surface, SurfaceLaws, Until,
};
use nalgebra::{Isometry3, Point3, Vector3};

/// A ball fired at a plate.
#[derive(Clone)]
pub struct Impact {
    pub radius: f64,
    pub density: f64,
    pub speed: f64,
    /// From the surface [deg].
    pub angle: f64,
    pub at: [f64; 2],
    pub strip: HexStrip,
    pub laws: SurfaceLaws,
    pub accuracy: f64,
}

/// What is left of it.
pub struct Outcome {
    pub surface: Surface,
    pub body: Body,
    pub advance: abrade::Advance,
    pub restitution: f64,
    pub rebound_angle: f64,
}

pub fn laws(hardness: f64, elastic: ElasticLaw, flow: FlowLaw) -> SurfaceLaws {
    let material =
        Material { hardness, shear_ratio: 0.25, young: Some(200e9), poisson: 0.3, friction: 0.5 };
    SurfaceLaws { elastic, flow, ..SurfaceLaws::of(material) }
}

pub fn hertz() -> ElasticLaw {
    ElasticLaw::HertzNodes { node_radius: 0.25e-3, convention: HertzConvention::ElasticPair }
}

pub fn projected() -> FlowLaw {
    FlowLaw::CapozzaHanley { lateral: Lateral::Projected }
}

pub fn paper_lattice() -> HexStrip {
    HexStrip::with_nodes(93.5e-3, 16.8e-3, 5012.0)
}

/// The ball of Figs. 5 to 7, or that of Fig. 4 ("normal"), on the paper's lattice.
pub fn paper(case: &str, angle: f64, at: [f64; 2]) -> Impact {
    let (radius, density, speed, hardness) = match case {
        "normal" => (10e-3, 8000.0, 45.0, 1.7e9),
        _ => (3e-3, 2500.0, 35.0, 6.6e9),
    };
    let laws = laws(hardness, hertz(), projected());
    Impact { radius, density, speed, angle, at, strip: paper_lattice(), laws, accuracy: 2e-4 }
}

impl Impact {
    pub fn run(&self) -> Outcome {
        let surface = Surface::hex_strip(self.strip, self.laws.clone()).expect("a plate");
        self.run_on(surface)
    }

    pub fn run_on(&self, surface: Surface) -> Outcome {
        self.run_at(surface, Isometry3::identity())
    }

    /// With the plate, and the impact on it, turned and moved as a whole.
    pub fn run_at(&self, surface: Surface, pose: Isometry3<f64>) -> Outcome {
        self.run_seen(surface, pose, false, &mut ())
    }

    /// With the ledger on, every step shown to `observer`.
    pub fn watch(&self, observer: &mut dyn Observer) -> Outcome {
        let surface = Surface::hex_strip(self.strip, self.laws.clone()).expect("a plate");
        self.run_seen(surface, Isometry3::identity(), true, observer)
    }

    fn run_seen(
        &self,
        mut surface: Surface,
        pose: Isometry3<f64>,
        ledger: bool,
        observer: &mut dyn Observer,
    ) -> Outcome {
        let inflation = match self.laws.elastic {
            ElasticLaw::HertzNodes { node_radius, .. } => node_radius,
            _ => 0.0,
        };
        let mut state =
            State::at(Point3::new(self.at[0], self.at[1], self.radius + inflation + 1e-10));
        let angle = self.angle.to_radians();
        state.velocity = Vector3::new(angle.cos(), 0.0, -angle.sin()) * self.speed;
        let mut body = Body {
            shape: Shape::ball(self.radius).expect("a ball"),
            inertia: Inertia::of_ball(self.radius, self.density),
            state: state.placed_by(&pose),
            rotation_locked: false,
        };
        let settings = EncounterSettings { accuracy: self.accuracy, ledger, ..Default::default() };
        let mut encounter = Encounter::new(&body, [&surface], settings).expect("an encounter");
        let mut placed = [Placed::at_rest(&mut surface, pose)];
        let advance = encounter
            .advance(&mut body, &mut placed, &Loads::default(), 1e-3, Until::FirstExit, observer)
            .expect("an impact");
        let v = body.state.seen_from(&pose).velocity;
        Outcome {
            restitution: v.norm() / self.speed,
            rebound_angle: v.z.atan2(v.xy().norm()).to_degrees(),
            surface,
            body,
            advance,
        }
    }
}
