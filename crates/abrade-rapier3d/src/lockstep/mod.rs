//! The Lockstep resolver: a body with its island, copied as it was before the step into a private
//! world in `f64`, stepped finely through the same time, and handed back over what Rapier made of
//! it.

#![allow(unused_qualifications, reason = "in the f64 package the two engines are one")]

mod articulation;
mod cast;
mod copy;
mod members;
mod widen;

use std::collections::BTreeMap;

use abrade::{Body, PhysicsError, Placed, Surface};
use abrade_lockstep::rapier as fine;
use abrade_lockstep::{Done, Island, IslandSettings, Proxy, Wearer};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::RigidBodyHandle;

use crate::event::Refusal;
use crate::gate::Lie;
use crate::held::Held;
use crate::lockstep::articulation::{Since, articulations, motion};
pub(crate) use crate::lockstep::cast::meeting;
use crate::lockstep::copy::{Twin, copy};
use crate::lockstep::members::Members;
pub(crate) use crate::lockstep::members::gather;
use crate::micro::placed;
use crate::resolver::Resolve;
use crate::shadow::Shadow;
use crate::surface::SurfaceId;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::WearWorld;
use crate::{gate, scalar, shadow, steer};

/// Steps of an island in a step of the embedder, times its bodies, after which it is put to rest:
/// a fraction of a second.
const BUDGET: u64 = 24_000;
/// Share of its kinetic energy that an island may gain before it is taken for wrong.
const GAIN: f64 = 0.02;

/// Why an island was not resolved.
pub(crate) enum Lost {
    Refused(Refusal),
    Failed(RigidBodyHandle, PhysicsError),
}

impl From<Refusal> for Lost {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

/// What an island's step did to one of its wearing bodies.
pub(crate) struct Share {
    pub body: RigidBodyHandle,
    /// Impulse of the surfaces on it [N s], in the world.
    pub impulse: Vector3<f64>,
    pub contact_time: f64,
    pub touches: bool,
    /// Load that it goes on to bear [N].
    pub bears: f64,
    /// Volume displaced on each surface [m3].
    pub worn: Vec<(SurfaceId, f64)>,
    /// Why its surfaces could follow it no further, if they could not.
    pub beyond: Option<PhysicsError>,
}

/// The surfaces of an island, in the order of their names.
fn surfaces_of(held: &[&Held]) -> Vec<SurfaceId> {
    let mut ids: Vec<SurfaceId> = held.iter().flat_map(|h| h.surfaces.iter().copied()).collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

impl WearWorld {
    /// Takes an island through the step, those of its members that are `held` wearing.
    pub(crate) fn lockstep(
        &mut self,
        mut members: Members,
        held: &[Held],
        world: &mut WorldView<'_>,
        rest_speed: f64,
    ) -> Result<(Vec<Share>, Done), Lost> {
        let held: Vec<&Held> = held.iter().filter(|h| members.holds(h.body)).collect();
        let ids = surfaces_of(&held);
        // Members may stand on other surfaces, which do not wear in the island.
        self.surfaces.iter().for_each(|worn| members.add_standing(worn.proxy));
        let copy = copy(&members, world, &self.before, &self.bodies)?;
        self.end_astray(&held);
        let lies = &self.lies;
        let seat = |id: &SurfaceId| Lie::find(lies, *id).map(|lie| (lie.pose, None));
        let seats: Vec<_> = ids.iter().filter_map(seat).collect();
        // Worn by way of leaves: nothing is, if the island comes to nothing.
        let leaf = |id: &SurfaceId| Surface::leaf(&self.surfaces[id.0].surface);
        let mut leaves: Vec<Surface> = ids.iter().map(leaf).collect();
        let mut placed = placed(leaves.iter_mut(), &seats);
        let (wearers, wearing) = self.wearers(&held, &ids, &copy, world, &mut placed)?;
        let proxies = self.proxies(&ids, &copy);
        let settings = self.island_settings(members.bodies.len(), rest_speed);
        let mut island = Island::new(copy.world, wearers, proxies, settings);
        let done = self.run(&mut island, &mut placed, held[0].body)?;
        let changes: Vec<_> = leaves.into_iter().map(Surface::into_changes).collect();
        for (id, changes) in ids.iter().zip(&changes) {
            self.surfaces[id.0].owned().apply(changes);
        }
        self.counters.node_evaluations += island.node_evaluations();
        self.hand_back(&island, &copy.bodies, &members, world);
        Ok((self.settle_island(island, &wearing), done))
    }

    /// The bodies of the island that wear its surfaces `ids`, on the springs that they have, and which
    /// of the `held` each of them is.
    fn wearers<'h>(
        &self,
        held: &[&'h Held],
        ids: &[SurfaceId],
        copy: &Twin,
        world: &WorldView<'_>,
        placed: &mut [Placed<'_>],
    ) -> Result<(Vec<Wearer>, Vec<&'h Held>), Lost> {
        let (mut wearers, mut wearing) = (Vec::new(), Vec::new());
        let gravity = scalar::vector(world.gravity);
        for held in held {
            let inner = copy.bodies.get(&held.body.into_raw_parts());
            let (Some(inner), Some(rb)) = (inner, world.bodies.get(held.body)) else { continue };
            let tracked = Tracked::find(&self.bodies, held.body);
            let body = tracked.and_then(Tracked::body);
            let (Some(state), Some(body)) = (self.before.of(held.body), body) else { continue };
            let uses = places(&held.surfaces, ids);
            let loads = gate::loads(rb, &gravity, &Isometry3::identity());
            // Kept as they are, should the island come to nothing.
            let mut wearer = match tracked.and_then(|tracked| tracked.wearer.clone()) {
                Some((_, mut wearer)) => {
                    wearer.body.state = *state;
                    wearer.resumed(*inner, loads, uses)
                }
                None => {
                    let body = Body { state: *state, ..body.clone() };
                    let settings = self.settings.encounter();
                    Wearer::new(*inner, body, loads, placed, uses, settings)
                        .map_err(|error| Lost::Failed(held.body, error))?
                }
            };
            wearer.bears = held.bore;
            wearers.push(wearer);
            wearing.push(*held);
        }
        Ok((wearers, wearing))
    }

    /// What the surfaces `ids` stand on in the island.
    fn proxies(&self, ids: &[SurfaceId], copy: &Twin) -> Vec<Proxy> {
        let proxy = |id: &SurfaceId| {
            let worn = &self.surfaces[id.0];
            let collider = *copy.standing.get(&worn.proxy.into_raw_parts())?;
            Some(Proxy { collider, friction: worn.surface.laws().material.friction })
        };
        ids.iter().filter_map(proxy).collect()
    }

    /// Settings of an island of `count` bodies.
    fn island_settings(&self, count: usize, rest_speed: f64) -> IslandSettings {
        let budget = match self.settings.resolve {
            Resolve::Lockstep => u64::MAX,
            _ => BUDGET / count.max(1) as u64,
        };
        IslandSettings { step_limit: self.settings.step_limit, budget, rest_speed }
    }

    /// Takes the island through the step; `first` is told as the body of an error.
    fn run(
        &self,
        island: &mut Island,
        placed: &mut [Placed<'_>],
        first: RigidBodyHandle,
    ) -> Result<Done, Lost> {
        let may_gain = self.settings.resolve == Resolve::Lockstep || island.is_driven();
        let [kinetic, before] = island.energies();
        let done = island
            .advance(placed, self.current.dt, &mut |_, _, _| ())
            .map_err(|error| Lost::Failed(first, error))?;
        match !may_gain && island.energies()[1] - before > GAIN * kinetic {
            true => Err(Refusal::Stiff.into()),
            false => Ok(done),
        }
    }

    /// Ends the springs of bodies that do not go on from where these were left, whatever velocity the
    /// embedder gave since.
    fn end_astray(&mut self, held: &[&Held]) {
        for held in held {
            let Some(state) = self.before.of(held.body) else { continue };
            let tracked = Tracked::slot(&mut self.bodies, held.body);
            let goes_on = tracked.wearer.as_ref().is_some_and(|(known, wearer)| {
                let was = &wearer.body.state;
                let same = was.position == state.position && was.rotation == state.rotation;
                same && *known == held.surfaces && !wearer.rests()
            });
            if !goes_on {
                tracked.end_wearer(&mut self.surfaces, &mut self.closed);
            }
        }
    }

    /// Sums up what the island did to its `wearing` bodies, and keeps their springs.
    fn settle_island(&mut self, island: Island, wearing: &[&Held]) -> Vec<Share> {
        let mut shares = Vec::new();
        for (wearer, held) in island.into_wearers().into_iter().zip(wearing) {
            self.closed += wearer.ledger_gained();
            shares.push(Share {
                body: held.body,
                impulse: wearer.impulse(),
                contact_time: wearer.contact_time(),
                touches: wearer.contact().in_contact(),
                bears: bears(&wearer),
                worn: held.surfaces.iter().copied().zip(wearer.worn().iter().copied()).collect(),
                beyond: wearer.beyond().cloned(),
            });
            let tracked = Tracked::slot(&mut self.bodies, held.body);
            tracked.wearer = Some((held.surfaces.clone(), wearer));
        }
        shares
    }

    /// Writes the members' states over what Rapier made of them.
    fn hand_back(
        &mut self,
        island: &Island,
        inner: &BTreeMap<(u32, u32), fine::dynamics::RigidBodyHandle>,
        members: &Members,
        world: &mut WorldView<'_>,
    ) {
        let end = |body: RigidBodyHandle| {
            inner.get(&body.into_raw_parts()).and_then(|inner| island.state(*inner))
        };
        for &body in &members.bodies {
            let (Some(rb), Some(state)) = (world.bodies.get_mut(body), end(body)) else { continue };
            if !rb.is_dynamic() {
                continue;
            }
            if rb.is_sleeping() && (state.velocity.norm() > 0.0 || state.spin.norm() > 0.0) {
                rb.wake_up(true);
            }
            let shadow = shadow::write(rb, Isometry3::identity(), state);
            Tracked::slot(&mut self.bodies, body).shadow = Some(shadow);
        }
        for index in articulations(members, world.multibody_joints) {
            let Some(multibody) = world.multibody_joints.get_multibody_mut(index) else { continue };
            let link = |body| articulation::link(body, world.bodies, end);
            let Some(motion) = motion(multibody, Since::Now, link) else { continue };
            motion.apply(multibody, world.bodies);
        }
        for &body in &members.bodies {
            let moved = world.bodies.get(body).filter(|rb| rb.is_dynamic() && end(body).is_some());
            let Some(rb) = moved else { continue };
            let tracked = Tracked::slot(&mut self.bodies, body);
            // An articulation closes its joints over the states, within roundings.
            let exact = |shadow: &Shadow| Shadow::of(rb, shadow.frame, shadow.state);
            tracked.shadow = tracked.shadow.as_ref().map(exact);
            steer::carry_colliders(rb, world.colliders);
        }
    }
}

/// Load that a wearing body goes on to bear [N]: in the next step it is no blow.
fn bears(wearer: &Wearer) -> f64 {
    match (wearer.rests(), wearer.is_slow()) {
        (true, _) => wearer.bears,
        (false, true) => wearer.contact().force().norm(),
        (false, false) => 0.0,
    }
}

/// The places of `own` among `ids`.
fn places(own: &[SurfaceId], ids: &[SurfaceId]) -> Vec<usize> {
    own.iter().filter_map(|id| ids.iter().position(|other| other == id)).collect()
}
