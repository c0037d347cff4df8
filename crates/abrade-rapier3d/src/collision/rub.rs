//! One of two that is pressed against the surface that stands, from step to step.

use abrade::{
    Advance, Body, EncounterSettings, Hold, Inertia, Ledger, PhysicsError, Placed, Pressed, State,
};
use nalgebra::{Isometry3, Matrix3, Vector3};
use rapier::geometry::Collider;
use rapier::parry::shape::TypedShape;

use crate::collision::blow::Blow;
use crate::collision::passage::Passage;
use crate::collision::two::{Roles, Two};
use crate::micro::{self, Volumes};
use crate::quasi_static::{LIMIT, SAMPLES};
use crate::surface::{SurfaceId, WornCollider};

/// Pitches beyond the worn depths that one sinks at most in an increment.
const REACH: f64 = 2.0;
/// Most angle between two balances of the load [rad].
const ANGLE: f64 = 0.05;
/// Pitches of its way for which a contact should not be broken.
const YOUNG: f64 = 50.0;
/// Radii of the surface that stands by which it stays on the part of a wall that is known.
const PART: f64 = 0.5;

/// A contact of two that is pressed.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Rub {
    /// The surface that stands, and whether it is that of the first collider of the pair.
    stands: SurfaceId,
    first_stands: bool,
    pressed: Pressed,
    /// In the frame of the surface that stands, at the height at which the load is balanced.
    body: Body,
    /// Frame of the body in that of its collider.
    local: Isometry3<f64>,
    /// Frame of the surface in that of its collider.
    offset: Isometry3<f64>,
    /// Where the surface began in the frame of the other collider, and how far it may go from there
    /// [m].
    began: Isometry3<f64>,
    reach: f64,
    /// Way since then [m].
    way: f64,
}

/// A way under a load, in a step.
pub(crate) struct Stretch<'a> {
    pub passage: &'a Passage,
    /// Frame of the second collider in that of the first where it begins, and how far it goes [m].
    pub start: Isometry3<f64>,
    pub way: f64,
    /// Unit normal from the first to the second, in the world.
    pub normal: Vector3<f64>,
    /// Load [N], and the time of the step [s].
    pub load: f64,
    pub dt: f64,
}

impl Rub {
    /// The contact of `two`, whose `other` collider is at the start of a stretch, as Rapier sees it.
    pub fn new(
        two: &Two,
        other: &Collider,
        stretch: &Stretch<'_>,
        blow: &Blow,
        surfaces: &[WornCollider],
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let Stretch { passage, start, .. } = stretch;
        let Roles { stands, first_stands, .. } = two.roles;
        let worn = &surfaces[stands.0];
        let back = blow.back(worn.surface.pitch());
        let shape = other.shape().as_typed_shape();
        let is_cut = matches!(shape, TypedShape::HalfSpace(_) | TypedShape::Cuboid(_));
        let reach = if is_cut { PART * worn.bounds.half().norm() } else { f64::INFINITY };
        let offset = passage.frame(first_stands, 1.0).inverse() * two.frame;
        let local = seen(&passage.at(1.0), first_stands).inverse() * offset * two.body.state.pose();
        // Without effect on the balance of a load.
        let inertia = Inertia { mass: blow.mass, tensor: Matrix3::identity() };
        let body = Body { inertia, rotation_locked: false, ..two.body.clone() };
        let pressed = Pressed::new(&body, [&*worn.surface], settings)?;
        let (began, way) = (seen(start, first_stands).inverse(), 0.0);
        let mut rub =
            Self { stands, first_stands, pressed, body, local, offset, began, reach, way };
        rub.body.state = rub.state(start);
        rub.body.state.position -= rub.down(stretch, 0.0) * back;
        Ok(rub)
    }

    /// True while what it knows of a wall reaches to where the second collider is at `pose` in the
    /// frame of the first.
    pub fn holds(&self, pose: &Isometry3<f64>) -> bool {
        let place = seen(pose, self.first_stands).inverse().translation.vector;
        (place - self.began.translation.vector).norm() < self.reach
    }

    /// Goes along; returns the volumes displaced, also before an error.
    pub fn advance(
        &mut self,
        stretch: &Stretch<'_>,
        surfaces: &mut [WornCollider],
        done: &mut Advance,
    ) -> (Volumes, Result<(), PhysicsError>) {
        let Stretch { passage, start, way, load, dt, .. } = *stretch;
        self.way += way;
        let mut placed = self.place(surfaces);
        let surface = &placed[0].surface;
        let pitch = surface.pitch();
        let angle = start.rotation.angle_to(&passage.at(1.0).rotation);
        let parts = (way * SAMPLES / pitch).max(angle / ANGLE).ceil().clamp(1.0, LIMIT as f64);
        let increment = pitch / SAMPLES;
        // Farther down, another side of the surface would carry the load.
        let reach = Some(REACH * pitch + surface.deepest());
        let mut result = Ok(());
        for part in 1..=parts as u32 {
            let share = f64::from(part) / parts;
            let end = self.state(&passage.at(share));
            let load = self.down(stretch, share) * load;
            let hold = Hold { load, duration: dt / parts, increment, limit: 1, reach };
            match self.pressed.advance(&mut self.body, &mut placed, &end, &hold, &mut ()) {
                Ok(advance) => {
                    done.steps += advance.steps;
                    done.node_evaluations += advance.node_evaluations;
                }
                Err(error) => {
                    result = Err(error);
                    break;
                }
            }
        }
        let [Placed { surface, .. }] = placed;
        (vec![(self.stands, surface.settle().displaced())], result)
    }

    /// The surface, to be worn.
    fn place<'a>(&self, surfaces: &'a mut [WornCollider]) -> [Placed<'a>; 1] {
        micro::place(surfaces, self.stands, (Isometry3::identity(), None))
    }

    /// Ends the contact: overhangs break off. Returns its ledger, and the volumes that broke off.
    pub fn end(mut self, surfaces: &mut [WornCollider]) -> (Ledger, Volumes) {
        let broken = micro::end(surfaces, &[self.stands], None, |placed| self.pressed.end(placed));
        (*self.pressed.ledger(), broken)
    }

    pub fn ledger(&self) -> &Ledger {
        self.pressed.ledger()
    }

    /// True for a contact with `surface`.
    pub fn is_on(&self, surface: SurfaceId) -> bool {
        self.stands == surface
    }

    /// True for one that has not gone far yet, and would miss what was broken off.
    pub fn is_young(&self, surfaces: &[WornCollider]) -> bool {
        self.way < YOUNG * surfaces[self.stands.0].surface.pitch()
    }

    /// State of the body, in the frame of the surface, where the second collider is at `pose` in the
    /// frame of the first.
    fn state(&self, pose: &Isometry3<f64>) -> State {
        let seat = self.offset.inverse() * seen(pose, self.first_stands) * self.local;
        State { rotation: seat.rotation, ..State::at(seat.translation.vector.into()) }
    }

    /// Unit normal into the surface after a share of the step.
    fn down(&self, stretch: &Stretch<'_>, share: f64) -> Vector3<f64> {
        let first = self.first_stands;
        let into = if first { -stretch.normal } else { stretch.normal };
        (stretch.passage.frame(first, share) * self.offset).inverse_transform_vector(&into)
    }
}

/// Frame of the other collider in that of the one that stands, from that of the second in the first.
fn seen(pose: &Isometry3<f64>, first_stands: bool) -> Isometry3<f64> {
    if first_stands { *pose } else { pose.inverse() }
}

#[cfg(feature = "serde-serialize")]
impl Rub {
    /// The surface that stands.
    pub fn surface(&self) -> SurfaceId {
        self.stands
    }

    /// True for frames that Rapier's numbers can say, of surfaces that it was made with.
    pub fn is_sound(&self, surfaces: &[WornCollider]) -> bool {
        use crate::snapshot::{is_frame, is_state};
        let frames = [&self.local, &self.offset, &self.began].into_iter().all(is_frame);
        let lengths = self.way >= 0.0 && self.reach > 0.0;
        let stands = &*surfaces[self.stands.0].surface;
        frames
            && lengths
            && is_state(&self.body.state, &Isometry3::identity())
            && self.pressed.is_made_for([stands])
    }
}
