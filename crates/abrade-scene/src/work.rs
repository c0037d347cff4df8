//! How many contact steps a run takes, and how many nodes go through the laws: orders of
//! magnitude, from the energy of each body, its load and the stop rule. The factors are from the
//! scenes that come with abrade.

use std::collections::BTreeMap;

use abrade::{ElasticLaw, Material, Piece, calibrated_yield};

use crate::check::Checked;
use crate::scene::{Geometry, Motion, SceneBody, SceneSurface, Solution, Stop, SurfaceMotion};
use crate::size::SurfaceSize;
use crate::solid::Solid;

/// Steps of a blow on springs, times the step fraction.
const STEPS_OF_BLOW: f64 = 20.0;
/// Times that over those of a body without faces, whose columns open and close one by one.
const FACES: f64 = 10.0;
/// Blows of a body in a bore, from wall to wall.
const BLOWS_IN_BORE: f64 = 10.0;
/// Steps of a body under its weight over those that its frequency and the step fraction ask for.
const PRESSED: f64 = 3.0;
/// Nodes under a body that its weight has pressed in.
const NODES_PRESSED: f64 = 50.0;
/// Cost of a node with adhesion over that without.
const ADHERING: f64 = 10.0;

/// What a run has to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Work {
    /// Contact steps.
    pub(crate) steps: f64,
    /// Nodes taken through the laws, by what one costs.
    pub(crate) evaluations: f64,
}

impl Work {
    fn new(steps: f64, nodes: f64) -> Self {
        Self { steps, evaluations: steps * nodes }
    }

    fn plus(self, other: Self) -> Self {
        Self { steps: self.steps + other.steps, evaluations: self.evaluations + other.evaluations }
    }

    fn times(self, factor: f64) -> Self {
        Self { steps: factor * self.steps, evaluations: factor * self.evaluations }
    }
}

impl Checked {
    /// The work of the whole run, with `sizes` of the surfaces.
    pub(crate) fn work(&self, sizes: &BTreeMap<String, SurfaceSize>) -> Work {
        let contacts = self.scene.surfaces.iter();
        let contacts: BTreeMap<_, _> = contacts
            .filter_map(|(name, surface)| Some((name, self.contact(name, surface, sizes)?)))
            .collect();
        let bodies = self.scene.bodies.iter().filter_map(|(name, body)| {
            let contact = contacts.get(self.met_by(body)?)?;
            Some(contact.of_body(self.solids.get(name)?, &body.motion))
        });
        let free = self.scene.surfaces.iter().filter_map(|(name, surface)| {
            let SurfaceMotion::Free { .. } = surface.motion else { return None };
            let contact = contacts.get(name)?;
            Some(contact.blow(NODES_PRESSED).plus(contact.pressed(contact.own_radius())))
        });
        bodies.chain(free).fold(Work::default(), Work::plus)
    }

    fn contact<'a>(
        &'a self,
        name: &str,
        surface: &'a SceneSurface,
        sizes: &'a BTreeMap<String, SurfaceSize>,
    ) -> Option<Contact<'a>> {
        let run = &self.scene.run;
        let [x, y, z] = self.scene.gravity;
        Some(Contact {
            material: self.scene.materials.get(&surface.material)?,
            surface,
            size: sizes.get(name)?,
            most_radius: self.size_of_solid(name),
            // eta: step times frequency that the accuracy asks for.
            step_fraction: (0.1 * (run.accuracy / 3e-3).sqrt()).min(0.7),
            step: run.step,
            limit: match run.stop {
                Stop::Time { limit } => limit,
                _ => 0.0,
            },
            gravity: x.hypot(y).hypot(z),
        })
    }

    /// The surface that a body is placed on, else the first one.
    fn met_by(&self, body: &SceneBody) -> Option<&String> {
        let surfaces = &self.scene.surfaces;
        match body.position.surface() {
            Some(surface) => surfaces.get_key_value(surface).map(|(name, _)| name),
            None => surfaces.keys().next(),
        }
    }
}

/// A surface, and what asks for steps of a body that touches it.
struct Contact<'a> {
    material: &'a Material,
    surface: &'a SceneSurface,
    size: &'a SurfaceSize,
    /// Radius of a ball of its volume [m].
    most_radius: f64,
    step_fraction: f64,
    /// Step of the engine, and how long it is stepped where that is known [s].
    step: f64,
    limit: f64,
    gravity: f64,
}

impl Contact<'_> {
    /// What a body asks for over the whole run.
    fn of_body(&self, solid: &Solid, motion: &Motion) -> Work {
        let has_faces = solid.shape.pieces().iter().any(|piece| matches!(piece, Piece::Hull(_)));
        let on_columns = !matches!(self.surface.elastic, ElasticLaw::HertzNodes { .. });
        let faces = if has_faces && on_columns { FACES } else { 1.0 };
        match *motion {
            Motion::Fixed => Work::default(),
            Motion::Impact { speed, angle, .. } => {
                self.flight(solid, speed * angle.sin(), speed * angle.cos()).times(faces)
            }
            Motion::Free { velocity: [x, y, z], .. } => {
                self.flight(solid, z.abs(), x.hypot(y)).times(faces)
            }
            Motion::Drive { indent_to, load, speed, distance, ref solution, .. } => {
                let load = load.unwrap_or(indent_to).max(indent_to);
                let area = load / self.material.hardness;
                let nodes = (area / self.size.rest_area).max(1.0);
                let steps = match solution {
                    Solution::QuasiStatic { increment } => {
                        let increment = increment.unwrap_or(0.125 * self.size.pitch);
                        3.0 * (1.0 + distance / increment)
                    }
                    Solution::Dynamic {} => {
                        let stiffness = self.stiffness(solid.shape.bounding_radius()) * area;
                        let frequency = (stiffness / solid.inertia.mass).sqrt();
                        let time = if speed > 0.0 { distance / speed } else { 0.0 };
                        (STEPS_OF_BLOW + time * frequency) / self.step_fraction
                    }
                };
                Work::new(steps, nodes)
            }
        }
    }

    /// A body that strikes, and then lies under its weight for as long as the run lasts.
    fn flight(&self, solid: &Solid, down: f64, along: f64) -> Work {
        let radius = solid.shape.bounding_radius();
        let blows = match self.surface.geometry {
            Geometry::Tube { .. } | Geometry::Bend { .. } => BLOWS_IN_BORE,
            _ => 1.0,
        };
        self.impact(solid, down, along).times(blows).plus(self.pressed(radius))
    }

    /// A ball of the body's size that ploughs in until its energy is spent against H.
    fn impact(&self, solid: &Solid, down: f64, along: f64) -> Work {
        let radius = solid.shape.bounding_radius();
        let hardness = self.material.hardness;
        let pi = std::f64::consts::PI;
        let time = (solid.inertia.mass / (2.0 * pi * radius * hardness)).sqrt();
        let (depth, slide) = (down * time, along * time * pi);
        let contact = (2.0 * radius * depth).sqrt().min(radius);
        let nodes = ((pi * contact * contact) / self.size.rest_area).max(1.0);
        match self.surface.elastic {
            ElasticLaw::Rigid => Work::new((depth + slide) / (0.1 * self.size.pitch) + 1.0, nodes),
            _ => self.blow(nodes),
        }
    }

    /// A blow on springs under which there are `nodes`.
    fn blow(&self, nodes: f64) -> Work {
        let nodes = if self.surface.adhesion.is_some() { ADHERING * nodes } else { nodes };
        Work::new(STEPS_OF_BLOW / self.step_fraction, nodes)
    }

    /// A body of this `radius` [m] under its weight: it sways by the yield depth H / k_w, at
    /// sqrt(g k_w / H).
    fn pressed(&self, radius: f64) -> Work {
        if self.gravity == 0.0 {
            return Work::default();
        }
        let frequency = (self.gravity * self.stiffness(radius) / self.material.hardness).sqrt();
        let each = (PRESSED * self.step * frequency / self.step_fraction).max(1.0);
        Work::new(self.limit / self.step * each, NODES_PRESSED)
    }

    /// Radius of the surface's own solid [m]; that of the nodes' distance for a plate, which is
    /// never asked.
    fn own_radius(&self) -> f64 {
        if self.most_radius.is_finite() { self.most_radius } else { self.size.pitch }
    }

    /// Stiffness of the surface per area under a body of this `radius` [m] [Pa/m].
    fn stiffness(&self, radius: f64) -> f64 {
        match self.surface.elastic {
            ElasticLaw::Foundation { stiffness: Some(stiffness) } => stiffness,
            ElasticLaw::Foundation { stiffness: None } => {
                let radius = radius.min(self.most_radius);
                self.material.hardness / calibrated_yield(self.material, radius)
            }
            _ => self.material.hardness / (1e-3 * radius),
        }
    }
}
