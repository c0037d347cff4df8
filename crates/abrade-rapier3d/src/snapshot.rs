//! A [`WearWorld`] to bytes and back, beside Rapier's world, for binary formats of serde: what
//! outlives a step, so that a run that goes on from it gives the same bits.
//!
//! The events of the last step are not kept. What is read is checked: whatever the bytes are, they
//! give an error or a world that a step can be taken with. What belongs to Rapier's world is not:
//! a surface whose proxy is gone, or a body, is left alone as it is in any step.

use abrade::{Ledger, State, Surface, Worn};
use nalgebra::Isometry3;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::ColliderHandle;
use rapier::math::Pose;
use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Error as _, Serialize, Serializer};

use crate::collision::{Bore, PairKey};
use crate::cut::Cut;
use crate::drive::DrivenBody;
use crate::guard::Taken;
use crate::quasi_static::Pressing;
use crate::query_collider::{Shown, ShownParts};
use crate::scalar;
use crate::settings::{Counters, WearSettings};
use crate::surface::{SurfaceId, WornCollider};
use crate::tool::Tool;
use crate::tracked::Tracked;
use crate::world::{Reasons, WearWorld};

/// Round-off of unit vectors that have turned for long.
const UNIT: f64 = 1e-6;

#[derive(serde::Serialize)]
struct Written<'a> {
    settings: &'a WearSettings,
    surfaces: &'a [WornCollider],
    taken: &'a Taken,
    bodies: &'a [Option<Tracked>],
    registered: &'a [RigidBodyHandle],
    driven: &'a [DrivenBody],
    tools: &'a [Tool],
    counters: &'a Counters,
    closed: &'a Ledger,
    reasons: &'a Reasons,
    bores: Vec<(&'a PairKey, &'a Bore)>,
}

#[derive(serde::Deserialize)]
struct Read {
    settings: WearSettings,
    surfaces: Vec<WornCollider>,
    taken: Taken,
    bodies: Vec<Option<Tracked>>,
    registered: Vec<RigidBodyHandle>,
    driven: Vec<DrivenBody>,
    tools: Vec<Tool>,
    counters: Counters,
    closed: Ledger,
    reasons: Reasons,
    bores: Vec<(PairKey, Bore)>,
}

/// Between two steps; in the middle of one it is refused.
impl Serialize for WearWorld {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.current.dt != 0.0 {
            return Err(S::Error::custom("a step of the wear world is under way"));
        }
        // Every field is named: a new one is either written or made anew by every step.
        let Self {
            settings,
            surfaces,
            bodies,
            taken,
            registered,
            driven,
            tools,
            counters,
            closed,
            reasons,
            bores,
            obstacles: _,
            neighbours: _,
            changed: _,
            lies: _,
            candidates: _,
            glances: _,
            picked: _,
            integrated: _,
            steered: _,
            held: _,
            sleepers: _,
            before: _,
            events: _,
            current: _,
            last_step: _,
        } = self;
        Written {
            settings,
            surfaces,
            taken,
            bodies,
            registered,
            driven,
            tools,
            counters,
            closed,
            reasons,
            bores: bores.iter().collect(),
        }
        .serialize(to)
    }
}

impl<'de> Deserialize<'de> for WearWorld {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let read = Read::deserialize(from)?;
        read.check().map_err(D::Error::custom)?;
        let Read {
            settings,
            surfaces,
            taken,
            bodies,
            registered,
            driven,
            tools,
            counters,
            closed,
            reasons,
            bores,
        } = read;
        let bores = bores.into_iter().collect();
        let empty = Self::new(settings);
        Ok(Self {
            surfaces,
            taken,
            bodies,
            registered,
            driven,
            tools,
            counters,
            closed,
            reasons,
            bores,
            ..empty
        })
    }
}

impl Serialize for WornCollider {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self {
            surface,
            proxy,
            offset,
            exact,
            shown,
            refused,
            bounds: _,
            inflation: _,
            broken: _,
        } = self;
        let shown = shown.as_ref().map(Shown::parts);
        (&**surface, proxy, offset, exact, shown, refused).serialize(to)
    }
}

impl<'de> Deserialize<'de> for WornCollider {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        type Exact = Option<(Pose, Isometry3<f64>)>;
        type Tiles = Option<ShownParts>;
        type Parts = (Surface, ColliderHandle, Isometry3<f64>, Exact, Tiles, Option<Worn>);
        let (surface, proxy, offset, exact, shown, refused) = Parts::deserialize(from)?;
        let exact_frame = exact.as_ref().map(|(_, frame)| frame);
        if ![Some(&offset), exact_frame].into_iter().flatten().all(is_frame) {
            return Err(D::Error::custom("the place of a surface is none"));
        }
        let shown = match shown {
            Some(parts) => {
                let fault = || D::Error::custom("query colliders are not those of their surface");
                Some(Shown::of_parts(&surface, parts).ok_or_else(fault)?)
            }
            None => None,
        };
        Ok(Self { exact, shown, refused, ..Self::new(surface, proxy, offset) })
    }
}

/// True for a frame that Rapier's numbers can say.
pub(crate) fn is_frame(frame: &Isometry3<f64>) -> bool {
    let unit = (frame.rotation.norm() - 1.0).abs() < UNIT;
    unit && frame.translation.vector.iter().all(|x| scalar::holds(*x))
}

/// True for a state, given in `frame`, that Rapier's numbers can say.
pub(crate) fn is_state(state: &State, frame: &Isometry3<f64>) -> bool {
    let state = state.placed_by(frame);
    let parts = [state.position.coords, state.velocity, state.spin];
    is_frame(frame) && parts.iter().flat_map(|part| part.iter()).all(|x| scalar::holds(*x))
}

/// True for a number, not below zero, that Rapier can hold.
fn is_size(x: f64) -> bool {
    x >= 0.0 && scalar::holds(x)
}

fn require(holds: bool, what: &'static str) -> Result<(), &'static str> {
    if holds { Ok(()) } else { Err(what) }
}

impl Read {
    fn check(&self) -> Result<(), &'static str> {
        let accuracy = self.settings.accuracy;
        require(accuracy.is_finite() && accuracy > 0.0, "the accuracy is out of range")?;
        require(self.taken.is_of(&self.surfaces), "a proxy is missing or taken twice")?;
        require(self.counters.are_sound(), "a counter is out of range")?;
        for (index, tracked) in self.bodies.iter().enumerate() {
            let Some(tracked) = tracked else { continue };
            let (own, _) = tracked.handle.into_raw_parts();
            require(own as usize == index, "a body is not in its place")?;
            self.check_body(tracked)?;
        }
        let bores = self.bores.iter().all(|(_, bore)| bore.is_sound(&self.surfaces));
        require(bores, "what a contact bears is out of range")?;
        let identity = Isometry3::identity();
        let mut driven = self.driven.iter();
        let sound =
            driven.all(|d| self.have(&[d.surface()]) && is_state(&d.state(&identity), &identity));
        require(sound, "a driven body is out of range")?;
        let cuts = self.tools.iter().flat_map(|tool| &tool.cuts);
        let sound = |cut: &Cut| cut.is_sound() && cut.surfaces().all(|id| self.have(&[id]));
        require(cuts.into_iter().all(sound), "a tool cuts a surface that is not there")
    }

    fn check_body(&self, tracked: &Tracked) -> Result<(), &'static str> {
        // The radius of what is everywhere is infinite.
        let loads = tracked.borne.iter().map(|(_, load)| *load);
        let sizes = tracked.radius >= 0.0 && loads.chain([tracked.friction]).all(is_size);
        require(sizes, "a size or load of a body is out of range")?;
        let state = tracked.shadow.as_ref().is_none_or(|shadow| shadow.is_sound());
        require(state, "a state is out of range")?;
        let borne = tracked.borne.iter().all(|(id, _)| self.have(&[*id]));
        let live = tracked.live.as_ref().is_none_or(|live| {
            let skin = live.skin.as_ref().is_none_or(|(_, pose)| is_frame(pose));
            self.have(&live.all()) && skin && live.frame.as_ref().is_none_or(is_frame)
        });
        let wall = tracked
            .against
            .as_ref()
            .is_none_or(|against| self.have(&[against.surface]) && against.is_sound());
        require(wall, "a body strikes a wall that cannot be")?;
        let mut booked = tracked.contact.iter().flat_map(|contact| contact.surfaces());
        let named = borne && live && booked.all(|id| self.have(&[id]));
        require(named, "a body bears on a surface that is not there")?;
        let wearer = tracked.wearer.as_ref().is_none_or(|(ids, wearer)| {
            self.have(ids) && wearer.contact().is_made_for(self.named(ids))
        });
        let fits = |pressing: &Pressing| {
            let ids = [pressing.surface];
            self.have(&ids) && pressing.is_sound(self.named(&ids))
        };
        let fitting = wearer && tracked.pressing.iter().all(fits);
        require(fitting, "a contact is not with the surface that it names")
    }

    /// True when all of these surfaces are there.
    fn have(&self, ids: &[SurfaceId]) -> bool {
        ids.iter().all(|id| id.0 < self.surfaces.len())
    }

    fn named(&self, ids: &[SurfaceId]) -> impl Iterator<Item = &Surface> {
        ids.iter().map(|id| &*self.surfaces[id.0].surface)
    }
}
