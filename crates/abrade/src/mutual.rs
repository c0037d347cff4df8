//! Two worn surfaces that meet: the nodes of each against the facets of the other.
//!
//! The softer flows, and the nodes of the harder are not asked: its facets are what they meet. Of
//! equals the nodes of each carry half the force. While they are in contact a node goes all of its
//! way, as if it alone were to wear: so the motion pays for the volume to round-off, whatever the
//! meshes are. Of that volume half is the node's, half that of the corners of the facet that it leans
//! on. What the two have come to look like is seen where the lists of a contact are made anew; the
//! springs keep their overlaps then.
//!
//! Two sets of nodes that meet what the other has worn at every step would each have to fit the
//! other's facets: of stiff springs, thinner than the facets are rough, the motion pays for less than
//! sinks.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use crate::body::{Body, State};
use crate::encounter::{Placed, Skin};
use crate::error::PhysicsError;
use crate::extent::{bounds, clearance};
use crate::inner_loop::Reaction;
use crate::laws::{ElasticLaw, FlowLaw, Lateral};
use crate::ledger::Ledger;
use crate::node_law::Motion;
use crate::patch::Patch;
use crate::shape::Shape;
use crate::surface::Surface;

/// Distance within which nodes find facets, in pitches and in yield overlaps: they touch no deeper,
/// and no farther off is a step of flight seen.
const REACH_PITCH: f64 = 0.3;
const REACH_YIELD: f64 = 4.0;
/// Part of the reach of its lists within which a body approaches.
const APPROACH: f64 = 0.5;
/// Share of the bounding radius by which nodes of a body may lie outside of its shape.
const OUTSIDE: f64 = 1e-6;

/// The contact of a body's own surface with another.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Mutual {
    /// The nodes of the surface that the body meets, unless they are the harder ones.
    forth: Option<Patch>,
    /// The nodes of the body's own, unless they are the harder ones; in their frame, with the other
    /// surface as the striker.
    back: Option<Patch>,
    /// Pose of the body at which the lists were made, and how far it may move from it [m].
    #[cfg_attr(feature = "state", serde(skip))]
    made: Option<(State, f64)>,
    /// Numbers of nodes of the body's own, and how often it had been renewed.
    skin: (usize, u32),
    #[cfg_attr(feature = "state", serde(skip))]
    lists: Lists,
    read: Option<[Point3<f64>; 2]>,
    /// A node was touched in the last trial, and in the contact that goes on.
    #[cfg_attr(feature = "state", serde(skip))]
    touches: bool,
    goes_on: bool,
}

/// Facets near the contact: of the surface that is met, and of the body's own.
#[derive(Clone, Debug, Default)]
struct Lists {
    met: Vec<[u32; 3]>,
    own: Vec<[u32; 3]>,
}

/// The shares of the force that the nodes of two surfaces of the given hardnesses carry.
fn shares(first: f64, second: f64) -> [f64; 2] {
    match first.total_cmp(&second) {
        std::cmp::Ordering::Less => [1.0, 0.0],
        std::cmp::Ordering::Equal => [0.5, 0.5],
        std::cmp::Ordering::Greater => [0.0, 1.0],
    }
}

/// True for two surfaces of which each can wear the other, by their laws: `Foundation`, without `Eq5`,
/// restitution and Archard's law, and with one hardness for all of their nodes.
pub fn can_meet(one: &Surface, other: &Surface) -> bool {
    [one, other].iter().all(|surface| {
        let laws = surface.laws();
        let sprung = matches!(laws.elastic, ElasticLaw::Foundation { .. });
        let literal = laws.flow == (FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 });
        let plain = laws.restitution >= 1.0 && laws.archard.is_none();
        sprung && !literal && plain && surface.hardness_factors().is_none()
    })
}

impl Mutual {
    /// The contact of `skin`, within `shape`, with `surface`.
    pub(crate) fn new(
        shape: &Shape,
        skin: &Skin<'_>,
        surface: &Surface,
        keeps_ledger: bool,
    ) -> Result<Self, PhysicsError> {
        if !can_meet(surface, skin.surface) {
            return Err(PhysicsError::Unsupported {
                what: "two surfaces that meet need the elastic law Foundation, a flow law for any \
                       shape, no restitution, no Archard's law, and one hardness each",
            });
        }
        let out = |x: &Point3<f64>| clearance(shape, &State::at(Point3::origin()), x);
        let corners = skin.surface.nodes().rest_position.iter();
        let outermost = corners.map(|x| out(&(skin.pose * x))).fold(f64::NEG_INFINITY, f64::max);
        if skin.surface.is_flat() || outermost > OUTSIDE * shape.bounding_radius() {
            return Err(PhysicsError::Unsupported {
                what: "a body's own surface must be that of a solid within the body's shape",
            });
        }
        let hardness = |surface: &Surface| surface.laws().material.hardness;
        let [met, own] = shares(hardness(surface), hardness(skin.surface));
        let patch = |on: &Surface, by: &Surface, offset, share| {
            (share > 0.0).then(|| Patch::of_two(on, by, offset, share, keeps_ledger))
        };
        Ok(Self {
            forth: patch(surface, skin.surface, skin.pose, met),
            back: patch(skin.surface, surface, Isometry3::identity(), own),
            made: None,
            skin: (skin.surface.nodes().len(), skin.surface.renewals()),
            lists: Lists::default(),
            read: None,
            touches: false,
            goes_on: false,
        })
    }

    /// False for another surface of the body than it was made with. Lets go of one that was renewed
    /// out of contact.
    pub(crate) fn fits(&mut self, skin: &Skin<'_>, touched: bool) -> bool {
        let (nodes, renewals) = (skin.surface.nodes().len(), skin.surface.renewals());
        if self.skin.1 != renewals && !touched {
            self.let_go();
            self.skin.1 = renewals;
        }
        self.skin == (nodes, renewals)
    }

    fn patches(&self) -> impl Iterator<Item = &Patch> {
        self.forth.iter().chain(&self.back)
    }

    /// Smallest overlap at which a node yields [m].
    pub(crate) fn yield_overlap(&self) -> f64 {
        self.patches().map(Patch::yield_overlap).fold(f64::INFINITY, f64::min)
    }

    /// How far the body may move before [`Mutual::cover`] lists anew [m].
    pub(crate) fn slack(&self, shape: &Shape, local: &State) -> f64 {
        // A contact should not begin with lists that are soon used up.
        let part = if self.goes_on { 1.0 } else { APPROACH };
        let travel = |at: &State| {
            let turn = at.rotation.angle_to(&local.rotation);
            (local.position - at.position).norm() + turn * shape.bounding_radius()
        };
        let left = |(at, margin): &(State, f64)| part * margin - travel(at);
        self.made.as_ref().map_or(-1.0, left)
    }

    /// Makes sure that the lists cover the `body` at `local`, where a step ends; `margin` [m] is the reach
    /// of new ones.
    pub(crate) fn cover(&mut self, placed: &Placed<'_>, body: &Body, local: &State, margin: f64) {
        let shape = &body.shape;
        let Some(skin) = &placed.skin else { return };
        if self.slack(shape, local) >= 0.0 {
            return;
        }
        self.made = Some((*local, margin));
        let met = &*placed.surface;
        let [low, high] = met.facet_box(&bounds(shape, local, margin));
        let [from, to] = self.read.unwrap_or([low, high]);
        self.read = Some([from.inf(&low), to.sup(&high)]);
        let seat = local.pose() * skin.pose;
        self.lists.meet(met, shape, local, margin);
        let [low, high] = self.lists.region(met, &seat, margin);
        self.lists.own.clear();
        skin.surface.visit_facets(&low, &high, |corners| self.lists.own.push(corners));
        self.lists.own.sort_unstable();
        let began = body.state.seen_from(&placed.pose);
        let reach = REACH_PITCH * met.pitch() + REACH_YIELD * self.yield_overlap();
        let (Lists { met: facets, own }, on) = (&self.lists, self.goes_on);
        if let Some(forth) = &mut self.forth {
            let near = |x: &Point3<f64>| clearance(shape, local, x) < margin;
            forth.meet([met, skin.surface], [facets, own], near, reach, on.then_some(&began));
        }
        if let Some(back) = &mut self.back {
            let near = |x: &Point3<f64>| (0..3).all(|a| x[a] >= low[a] && x[a] <= high[a]);
            let other = striker(&(began.pose() * skin.pose));
            back.meet([skin.surface, met], [own, facets], near, reach, on.then_some(&other));
        }
    }

    /// Shortest time [s] in which a node of either can be touched.
    pub(crate) fn time_to_touch(
        &mut self,
        skin: &Skin<'_>,
        local: &State,
        speed: f64,
        acceleration: f64,
    ) -> f64 {
        let other = striker(&(local.pose() * skin.pose));
        let forth = self.forth.as_mut().map(|p| p.time_to_touch(local, speed, acceleration));
        let back = self.back.as_mut().map(|p| p.time_to_touch(&other, speed, acceleration));
        forth.into_iter().chain(back).fold(f64::INFINITY, f64::min)
    }

    /// Largest overlap of a node of either [m].
    pub(crate) fn deepest(&mut self, placed: &Placed<'_>, local: &State) -> f64 {
        let Some(skin) = &placed.skin else { return 0.0 };
        let seat = local.pose() * skin.pose;
        let other = striker(&seat);
        let forth = self.forth.as_mut().map(|p| p.deepest(local));
        let back = self.back.as_mut().map(|p| p.deepest(&other));
        forth.into_iter().chain(back).fold(0.0, f64::max)
    }

    /// Takes every node through a step that ends with the body at `local`; commits nothing. What
    /// the surfaces do to the body, in the frame of the one that it meets.
    pub(crate) fn trial(
        &mut self,
        placed: &Placed<'_>,
        local: &State,
        motion: &Motion,
        reach: f64,
    ) -> Reaction {
        let Some(skin) = &placed.skin else { return Reaction::default() };
        let mut sum = Reaction::default();
        if let Some(forth) = &mut self.forth {
            sum = *forth.trial(placed.surface.laws(), local, motion);
        }
        if let Some(back) = &mut self.back {
            let seat = local.pose() * skin.pose;
            let motion = turned_round(motion, local, &seat);
            let reaction = back.trial(skin.surface.laws(), &striker(&seat), &motion);
            sum.add(&on_body(reaction, local, &seat, reach), &Isometry3::identity());
        }
        let [forth, back] =
            [&self.forth, &self.back].map(|p| p.as_ref().map_or(0.0, Patch::normal_load));
        self.touches = sum.touching > 0;
        self.forth.iter_mut().for_each(|patch| patch.add_load(back));
        self.back.iter_mut().for_each(|patch| patch.add_load(forth));
        sum
    }

    /// Energies of the last trial; zeros unless they are kept.
    pub(crate) fn ledger(&self) -> Ledger {
        let mut patches = self.patches().map(Patch::ledger);
        let mut sum = patches.next().unwrap_or_default();
        patches.for_each(|ledger| sum += ledger);
        sum
    }

    /// Makes the last trial the state: nodes of both sink, and their facets with them.
    pub(crate) fn commit(&mut self, placed: &mut Placed<'_>) {
        let Some(skin) = &mut placed.skin else { return };
        let (met, own) = (&mut *placed.surface, &mut *skin.surface);
        if let (Some(forth), Some(back)) = (&self.forth, &self.back) {
            forth.hand_over(own);
            back.hand_over(met);
        }
        self.forth.iter_mut().for_each(|patch| patch.commit(met));
        self.back.iter_mut().for_each(|patch| patch.commit(own));
        self.goes_on |= self.touches;
    }

    /// Lets every spring go.
    pub(crate) fn let_go(&mut self) {
        self.made = None;
        self.goes_on = false;
        [&mut self.forth, &mut self.back].into_iter().flatten().for_each(Patch::let_go);
    }

    /// Box around the undeformed nodes of the surface that is met whose depths were read.
    pub(crate) fn take_read(&mut self) -> Option<[Point3<f64>; 2]> {
        self.read.take()
    }
}

impl Lists {
    /// Lists the facets of `met` within `margin` [m] of `shape` at `local`.
    fn meet(&mut self, met: &Surface, shape: &Shape, local: &State, margin: f64) {
        self.met.clear();
        let [low, high] = bounds(shape, local, margin);
        let facets = &mut self.met;
        met.visit_facets(&low, &high, |corners| {
            let [a, b, c] = corners.map(|i| met.position(i as usize));
            let middle = nalgebra::center(&a, &nalgebra::center(&b, &c));
            let radius = [a, b, c].map(|p| (p - middle).norm()).into_iter().fold(0.0, f64::max);
            if clearance(shape, local, &middle) - radius < margin {
                facets.push(corners);
            }
        });
        facets.sort_unstable();
    }

    /// Box around those, grown by `margin` [m], in the frame at `seat`; a box without a point where
    /// there are none.
    fn region(&self, met: &Surface, seat: &Isometry3<f64>, margin: f64) -> [Point3<f64>; 2] {
        let mut low = Point3::from(Vector3::repeat(f64::INFINITY));
        let mut high = -low;
        for &corner in self.met.iter().flatten() {
            let x = seat.inverse_transform_point(&met.position(corner as usize));
            (low, high) = (low.inf(&x), high.sup(&x));
        }
        [low - Vector3::repeat(margin), high + Vector3::repeat(margin)]
    }
}

/// The surface that is met, as a striker seen from the frame at `seat` in its own.
fn striker(seat: &Isometry3<f64>) -> State {
    let pose = seat.inverse();
    State { rotation: pose.rotation, ..State::at(pose.translation.vector.into()) }
}

/// The motion of the surface that is met over the body's own, in the frame of that, which is at
/// `seat` at the end of the step: of its origin, as the body at `local` moves over it by `motion`.
fn turned_round(motion: &Motion, local: &State, seat: &Isometry3<f64>) -> Motion {
    let Motion { velocity, spin, drag, dt } = motion;
    let middle = local.position.coords - velocity * (0.5 * dt);
    let half_back = UnitQuaternion::from_scaled_axis(spin * (-0.5 * dt));
    let turn = (half_back * seat.rotation).inverse();
    let drag = drag.unwrap_or_default() - spin;
    Motion {
        velocity: turn * (spin.cross(&middle) - velocity),
        spin: turn * -spin,
        drag: (drag != Vector3::zeros()).then(|| turn * drag),
        dt: *dt,
    }
}

/// What a striker felt about its origin, given in the frame at `seat`, as what the body at `local`
/// feels. `reach` [m] bounds the levers of its forces.
fn on_body(felt: &Reaction, local: &State, seat: &Isometry3<f64>, reach: f64) -> Reaction {
    let [force, torque, push] = [felt.force, felt.torque, felt.push].map(|v| seat.rotation * v);
    Reaction {
        force: -force,
        torque: local.position.coords.cross(&force) - torque,
        push: -push,
        lever_squared: if felt.touching > 0 { reach * reach } else { 0.0 },
        ..*felt
    }
}

#[cfg(feature = "state")]
impl Mutual {
    /// True when every candidate of the surface that is met is one of `nodes`, and those of the
    /// body's own are some of it.
    pub(crate) fn lies_on(&self, nodes: usize) -> bool {
        let within = |patch: &Option<Patch>, nodes| patch.as_ref().is_none_or(|p| p.lies_on(nodes));
        self.patches().next().is_some()
            && within(&self.forth, nodes)
            && within(&self.back, self.skin.0)
    }
}
