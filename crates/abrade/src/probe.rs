//! For benches only (feature `bench`): the steps of a real impact, taken out of it, so that the loop
//! over the nodes can be timed alone and beside a bare one on the same data. Not for users.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::body::{Body, State};
use crate::contact::Contact;
use crate::encounter::{EncounterSettings, Loads, Placed, Until};
use crate::error::PhysicsError;
use crate::integrate::Integrator;
use crate::node_law::Motion;
use crate::query::{BodyQuery, Contactor, Query};
use crate::shape::Shape;
use crate::surface::{Surface, SurfaceLaws};
use crate::sweep::Swept;

/// The steps of an impact that touched something, with what they need to be taken again.
pub struct Recording {
    shape: Shape,
    surface: Surface,
    frames: Vec<Frame>,
}

/// A step as the contact saw it, before it was taken.
struct Frame {
    contact: Contact,
    /// Of columns: what was known of their distances before the step.
    marks: Vec<f64>,
    poses: [State; 2],
    motion: Motion,
}

/// A candidate and what it remembers, at the start of a step.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// Place [m], normal, area [m2] and hardness over that of the material [-].
    pub x: Point3<f64>,
    /// Outward unit normal.
    pub n: Vector3<f64>,
    /// Area [m2].
    pub area: f64,
    /// Hardness over that of the material [-].
    pub factor: f64,
    /// Of springs: tangential stretch [m], overlap [m], lateral load less its cap [N].
    pub stretch: Vector3<f64>,
    /// Overlap, or compression of a column's spring [m].
    pub overlap: f64,
    /// Normal and lateral load less their caps [N].
    pub excess: [f64; 2],
    /// Of columns: the mark on the body's way before which it cannot come to this one [m].
    pub mark: f64,
    /// Voids along the normal, sorted upwards [m]; the first `count` are filled.
    pub voids: [[f64; 2]; 4],
    /// Number of voids.
    pub count: usize,
}

/// What a step needs beside its candidates.
#[derive(Clone, Debug)]
pub struct Course {
    /// The body at the start and at the trial end.
    pub poses: [State; 2],
    /// Mid-step velocity [m/s] and spin [rad/s].
    pub velocity: Vector3<f64>,
    /// Spin [rad/s].
    pub spin: Vector3<f64>,
    /// Length [s].
    pub dt: f64,
    /// Of columns: the body's way at the end of the step [m].
    pub way: f64,
    /// Elastic coefficient of the body's first piece, and radius it is inflated by.
    pub coefficient: f64,
}

/// What a step does to the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Of springs, force at the end [N] and torque [N m]; of columns, impulse [N s] and its torque.
    pub push: Vector3<f64>,
    /// Torque about the centre of mass.
    pub torque: Vector3<f64>,
    /// Nodes that carry force.
    pub touching: usize,
}

impl Recording {
    /// Runs `body` against `surface` until it leaves and keeps every step in which a node carried
    /// force.
    ///
    /// # Errors
    /// As a run of an [`Encounter`](crate::Encounter).
    pub fn of(
        mut body: Body,
        mut surface: Surface,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let mut integrator = Integrator::new(&body, [&surface], settings)?;
        let mut frames = Vec::new();
        let loads = Loads::default();
        loop {
            let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
            let start = body.state;
            let (dt, flight) = integrator.next_step(&body, &placed, &loads);
            let before = integrator.contacts[0].clone();
            let trial = integrator.trial(&body, &placed, &loads, dt, flight);
            if trial.touching > 0 {
                let (velocity, spin) = (trial.shift / dt, trial.turn / dt);
                let motion = Motion { velocity, spin, drag: None, dt };
                let contact = integrator.contacts[0].clone();
                let marks = match (&before, &contact) {
                    (Contact::Columns(before), Contact::Columns(now)) => now.marks_of(before),
                    _ => Vec::new(),
                };
                frames.push(Frame { contact, marks, poses: [start, trial.state], motion });
            }
            let until = Until::FirstExit;
            if integrator.advance(&mut body, &mut placed, &loads, dt, until, &mut ())?.exited {
                break;
            }
        }
        Ok(Self { shape: body.shape, surface, frames })
    }

    /// Number of steps.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// True without steps.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Keeps every `stride`-th step.
    pub fn thin_out(&mut self, stride: usize) {
        let mut i = 0;
        self.frames.retain(|_| {
            i += 1;
            i % stride == 0
        });
    }

    /// The laws.
    pub fn laws(&self) -> &SurfaceLaws {
        self.surface.laws()
    }

    /// The body's shape.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Takes step `i` again.
    #[inline(never)]
    pub fn run(&mut self, i: usize) -> Outcome {
        let Frame { contact, marks, poses, motion } = &mut self.frames[i];
        match contact {
            Contact::Springs(patch) => {
                let reaction = patch.trial(self.surface.laws(), &poses[1], motion);
                let (push, torque) = (reaction.force, reaction.torque);
                Outcome { push, torque, touching: reaction.touching }
            }
            Contact::Columns(columns) => {
                let [start, end] = &*poses;
                columns.set_marks(marks);
                let toll = columns.trial(&self.surface, &self.shape, [start, end], motion);
                Outcome {
                    push: toll.flow.impulse + toll.spring.impulse,
                    torque: toll.flow.torque + toll.spring.torque,
                    touching: toll.touching,
                }
            }
            Contact::Mutual(_) => Outcome::default(),
        }
    }

    /// Depth by which every candidate of step `i` sank when it was taken last [m].
    pub fn drops(&self, i: usize) -> Vec<f64> {
        match &self.frames[i].contact {
            Contact::Springs(patch) => patch.drops().collect(),
            Contact::Columns(columns) => columns.drops(),
            Contact::Mutual(_) => Vec::new(),
        }
    }

    /// The candidates of step `i`.
    pub fn candidates(&self, i: usize) -> Vec<Candidate> {
        let Frame { contact, marks, .. } = &self.frames[i];
        match contact {
            Contact::Springs(patch) => patch.recorded(),
            Contact::Columns(columns) => columns.recorded(marks),
            Contact::Mutual(_) => Vec::new(),
        }
    }

    /// What step `i` needs beside them.
    pub fn course(&self, i: usize) -> Course {
        let Frame { contact, poses, motion, .. } = &self.frames[i];
        let (way, coefficient) = match contact {
            Contact::Springs(patch) => (0.0, patch.coefficient()),
            Contact::Columns(columns) => {
                (columns.way(&self.shape, &poses[1]), columns.coefficient())
            }
            Contact::Mutual(_) => unreachable!("a recorded body has no surface of its own"),
        };
        let Motion { velocity, spin, dt, .. } = *motion;
        Course { poses: *poses, velocity, spin, dt, way, coefficient }
    }
}

/// A shape that can be asked about nodes.
pub struct Asked {
    query: BodyQuery,
    swept: Swept,
}

impl Asked {
    /// `shape` at `state`, over nodes whose normal is +z.
    pub fn new(shape: &Shape, state: &State) -> Self {
        let contactor = |piece: &_| Contactor { piece: Clone::clone(piece), coefficient: 1.0 };
        let contactors: Vec<_> = shape.pieces().iter().map(contactor).collect();
        let mut query = BodyQuery::new(&contactors, 0.0);
        query.place(state);
        let mut swept = Swept::default();
        swept.place(shape, state, state, Some(Vector3::z()));
        Self { query, swept }
    }

    /// Sum of the overlaps [m] of the nodes at `points`, by the query of springs.
    #[inline(never)]
    pub fn touches(&self, points: &[Point3<f64>]) -> f64 {
        match &self.query {
            BodyQuery::Ball(query) => overlaps(query, points),
            BodyQuery::Clump(query) => overlaps(query, points),
            BodyQuery::Mesh(query) => overlaps(query.as_ref(), points),
        }
    }

    /// Sum of the depths [m] of the body below `points`, by the query of columns.
    #[inline(never)]
    pub fn spans(&self, points: &[Point3<f64>]) -> f64 {
        let n = Vector3::z();
        points.iter().filter_map(|x| self.swept.span(x, &n, f64::INFINITY)).map(|s| s.low).sum()
    }
}

fn overlaps(query: &impl Query, points: &[Point3<f64>]) -> f64 {
    let n = Vector3::z();
    points.iter().filter(|x| query.near(x)).map(|x| query.touch(x, &n).overlap).sum()
}
