//! What a run remembers of its bodies for the summary and the stop rule.

use abrade::{Inertia, State};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::build::{Built, BuiltSurface};
use crate::carrier::BuiltCarrier;
use crate::check::Checked;
use crate::led_path::LedPath;
use crate::run::engine::{Engine, Met, Sample, Stepped, Stretch};
use crate::run::erosion::Erosion;
use crate::run::streaming::Presences;
use crate::run::touch::{Target, Touches, touch};
use crate::scene::{Motion, Output};

/// Speed over the body's largest speed below which it counts as resting.
const REST: f64 = 1e-6;
/// Part of a step that is left to a corner of a path and not worth a step of its own.
const SLIVER: f64 = 1e-6;

/// All bodies, in the scene's order, and where the surfaces lie.
pub(crate) struct Bodies {
    pub tracks: Vec<Track>,
    /// Frames of the surfaces in the world, now, and what they move with.
    pub frames: Vec<Isometry3<f64>>,
    pub carriers: Vec<Option<BuiltCarrier>>,
    /// Paths of the surfaces, and boxes in the world that hold all places along them [m].
    paths: Vec<Option<(LedPath, [Point3<f64>; 2])>>,
    /// Corners of the boxes around closed surfaces, in their frames [m]; none for flat ones.
    pub solids: Vec<Option<[Point3<f64>; 2]>>,
    /// Contacts that have ended.
    pub impacts: u64,
    /// Touches and impacts, where the scene asks for them.
    pub touches: Option<Touches>,
    /// Bodies left to the engine near a surface, with the reason and how often.
    pub refused: Vec<(String, String, u64)>,
    surface_names: Vec<String>,
    pub(super) presences: Presences,
    pub erosion: Erosion,
    struck: Struck,
}

/// One body.
pub(crate) struct Track {
    pub name: String,
    /// One of a stream: a picture has no room for its name.
    pub is_streamed: bool,
    /// True from the first touch on.
    has_struck: bool,
    pub inertia: Inertia,
    pub start: State,
    /// Distance of its farthest point from its centre of mass [m].
    pub reach: f64,
    /// Frame whose z is the normal of the flat surface that the body is aimed at; none for a
    /// closed one.
    pub aim: Option<Isometry3<f64>>,
    /// Velocity before the first contact [m/s].
    pub approach: Option<Vector3<f64>>,
    /// Where its centre of mass was at the first touch, in the frames of the surfaces that it met.
    pub landings: Vec<(usize, Point3<f64>)>,
    /// Impulse of the surfaces [N s] and time in contact [s].
    pub impulse: Vector3<f64>,
    pub contact_time: f64,
    pub slide: Option<Slide>,
    last_velocity: Vector3<f64>,
    top_speed: f64,
}

/// Bodies of streams that strike for the first time in the step under way.
#[derive(Default)]
struct Struck {
    count: u64,
    /// Their mass [kg].
    mass: f64,
}

impl Struck {
    /// Takes note that a body touches a surface.
    fn add(&mut self, track: &mut Track) {
        if track.is_streamed && !std::mem::replace(&mut track.has_struck, true) {
            self.count += 1;
            self.mass += track.inertia.mass;
        }
    }
}

/// The slide of a driven body.
pub(crate) struct Slide {
    pub distance: f64,
    /// Length at the end over which the wear rate is taken [m].
    pub rate_over: f64,
    pub surface: usize,
    /// Volume of the surface when the last `rate_over` began, and now [m3].
    pub rate_from: Option<f64>,
    pub volume: f64,
    travelled: f64,
    start: Vector3<f64>,
    /// Where it slides to: the surface's x, in the world.
    heading: Vector3<f64>,
    force_sum: Vector3<f64>,
    /// The last force of the surface on it [N].
    force: Vector3<f64>,
}

impl Track {
    /// Whether its next contact step tells what the summary says of it: its first touch, or its slide.
    pub(crate) fn learns(&self) -> bool {
        self.approach.is_none() || self.slide.is_some()
    }
}

impl Bodies {
    pub(crate) fn new(checked: &Checked, built: &Built) -> Self {
        let frames: Vec<_> = built.surfaces.values().map(|surface| surface.pose).collect();
        let solids: Vec<_> = built
            .surfaces
            .values()
            .map(|built| (!built.surface.is_flat()).then(|| built.surface.bounds()))
            .collect();
        let asks = checked.scene.outputs.iter().any(|o| matches!(o, Output::Laws { .. }));
        let index = |name: &str| built.surfaces.keys().position(|key| key == name);
        let tracks = built.bodies.iter().map(|(name, body)| {
            let scene = &checked.scene.bodies[name];
            let surface = scene.position.surface().and_then(|name| index(name));
            let slide = match &scene.motion {
                Motion::Drive { distance, rate_over, .. } => Some(Slide {
                    distance: *distance,
                    rate_over: rate_over.unwrap_or(0.5 * distance).min(*distance),
                    surface: surface.unwrap_or(0),
                    rate_from: None,
                    volume: 0.0,
                    travelled: 0.0,
                    start: body.state.position.coords,
                    heading: surface.map_or(Vector3::x(), |i| frames[i] * Vector3::x()),
                    force_sum: Vector3::zeros(),
                    force: Vector3::zeros(),
                }),
                _ => None,
            };
            let aim = surface.or(if frames.is_empty() { None } else { Some(0) });
            let aim = aim.filter(|&i| solids[i].is_none());
            Track {
                name: name.clone(),
                is_streamed: checked.is_streamed(name),
                has_struck: false,
                inertia: body.inertia,
                start: body.state,
                reach: body.shape.bounding_radius(),
                aim: aim.map(|i| frames[i]),
                approach: None,
                landings: Vec::new(),
                impulse: Vector3::zeros(),
                contact_time: 0.0,
                slide,
                last_velocity: body.state.velocity,
                top_speed: body.state.velocity.norm(),
            }
        });
        Self {
            tracks: tracks.collect(),
            frames: frames.clone(),
            paths: built.surfaces.values().map(path_and_box).collect(),
            carriers: built.surfaces.values().map(|surface| surface.carrier).collect(),
            solids: solids.clone(),
            impacts: 0,
            touches: asks.then(|| Touches::new(built.bodies.len())),
            refused: Vec::new(),
            surface_names: built.surfaces.keys().cloned().collect(),
            presences: Presences::new(checked, built),
            erosion: Erosion::new(checked),
            struck: Struck::default(),
        }
    }

    /// Time [s] from `time` to the next corner of a path, in steps of `step` [s].
    pub(crate) fn until_corner(&self, time: f64, step: f64) -> f64 {
        let paths = self.paths.iter().flatten();
        let until = paths.map(|(path, _)| path.until_corner(time, SLIVER * step));
        until.fold(f64::INFINITY, f64::min)
    }

    /// Gives the surfaces with a path their velocities for a step of `dt` [s] from `time` [s].
    pub(crate) fn lead(&self, engine: &mut dyn Engine, [time, dt]: [f64; 2], step: f64) {
        for (surface, path) in self.paths.iter().enumerate() {
            let Some((path, _)) = path else { continue };
            let [from, to] = [time, time + dt].map(|time| path.at(time));
            engine.lead(surface, &Stretch { from, to, dt, recover: step });
        }
    }

    /// Looks at a contact step of an engine step that began at `begun` [s].
    pub(crate) fn see(&mut self, sample: &Sample<'_>, begun: f64) {
        if sample.force != Vector3::zeros() {
            self.see_touch(sample, begun);
        }
        let landed = |met: &Met<'_>| {
            let moved = self.carriers[met.index].zip(met.carrier);
            let frame = moved.map_or(self.frames[met.index], |(body, state)| body.frame(&state));
            (met.index, frame.inverse_transform_point(&sample.state.position))
        };
        let track = &mut self.tracks[sample.body];
        if sample.force != Vector3::zeros() && track.approach.is_none() {
            track.approach = Some(track.last_velocity);
            self.struck.add(track);
            track.landings = sample.surfaces.iter().map(landed).collect();
        }
        track.last_velocity = sample.state.velocity;
        if let Some(slide) = &mut track.slide {
            let volume = sample.surfaces.first().map_or(0.0, |met| met.surface.worn().displaced());
            slide.see(sample, volume);
        }
    }

    /// True while the next touch of a body is asked for.
    pub(crate) fn awaits_touch(&self, body: usize) -> bool {
        self.touches.as_ref().is_some_and(|touches| touches.awaits(body))
    }

    fn see_touch(&mut self, sample: &Sample<'_>, begun: f64) {
        let Some(touches) = self.touches.as_mut().filter(|t| t.awaits(sample.body)) else { return };
        let velocity = self.tracks[sample.body].last_velocity;
        let targets = sample.surfaces.iter().map(|met| {
            let moved = self.carriers[met.index].zip(met.carrier);
            let frame = moved.map_or(self.frames[met.index], |(body, state)| body.frame(&state));
            Target { index: met.index, surface: met.surface, frame, carrier: met.carrier }
        });
        let touch = touch(targets, &State { velocity, ..sample.state }, begun + sample.time);
        touches.begin(sample.body, touch);
    }

    /// Contacts that no contact step told of begin as the body moved when the step did; then those that
    /// are over.
    fn settle_touches(&mut self, engine: &dyn Engine, stepped: &Stepped, time: f64) {
        let Some(touches) = &mut self.touches else { return };
        for &(body, surface) in &stepped.started {
            let carrier = engine.carrier(surface);
            let frame = self.frames[surface];
            let target =
                Target { index: surface, surface: engine.surface(surface), frame, carrier };
            let velocity = self.tracks[body].last_velocity;
            let state = State { velocity, ..engine.state(body) };
            if touches.awaits(body) {
                touches.begin(body, touch(std::iter::once(target), &state, time));
            }
        }
        touches.end(stepped.worn.iter().copied());
        touches.drop_idle(|body| engine.in_contact(body));
    }

    /// Takes in what a step that began at `time` [s] did.
    pub(crate) fn settle(&mut self, engine: &dyn Engine, stepped: &Stepped, time: f64) {
        self.settle_touches(engine, stepped, time);
        for ended in &stepped.ended {
            self.impacts += 1;
            let Some(body) = ended.body else { continue };
            let track = &mut self.tracks[body];
            self.struck.add(track);
            track.impulse += ended.impulse;
            track.contact_time += ended.contact_time;
        }
        for (body, surface, why) in &stepped.refused {
            let surface = self.surface_names.get(*surface).map_or("", String::as_str);
            let what = match body {
                Some(body) => format!("`{}` on `{surface}`", self.tracks[*body].name),
                None => format!("`{surface}`"),
            };
            match self.refused.iter_mut().find(|(w, reason, _)| *w == what && reason == why) {
                Some((.., count)) => *count += 1,
                None => self.refused.push((what, why.clone(), 1)),
            }
        }
        let Struck { count, mass } = std::mem::take(&mut self.struck);
        if count > 0 {
            self.erosion.strike(engine, self.frames.len(), count, mass);
        }
        for &body in &self.presences.live {
            let track = &mut self.tracks[body];
            track.last_velocity = engine.state(body).velocity;
            track.top_speed = track.top_speed.max(track.last_velocity.norm());
        }
        for (surface, carrier) in self.carriers.iter().enumerate() {
            if let Some((body, state)) = carrier.zip(engine.carrier(surface)) {
                self.frames[surface] = body.frame(&state);
            }
        }
    }

    /// True where something leads a surface that the body met: its speeds say nothing of an impact.
    pub(crate) fn met_led(&self, track: &Track) -> bool {
        let is_led = |surface: usize| self.carriers[surface].is_some_and(|c| c.inertia.is_none());
        track.landings.iter().any(|(surface, _)| is_led(*surface))
    }

    /// Normal of the plate at rest that the body met first; none for any other surface, and for
    /// several.
    pub(crate) fn normal_met(&self, track: &Track) -> Option<Vector3<f64>> {
        let [(surface, _)] = track.landings[..] else { return None };
        let is_still = self.solids[surface].is_none() && self.carriers[surface].is_none();
        is_still.then(|| self.frames[surface] * Vector3::z())
    }

    /// Kinetic energy of the free bodies of surfaces, at the start [J].
    pub(crate) fn carried_at_start(&self) -> f64 {
        self.carriers.iter().flatten().map(|body| body.kinetic_energy(&body.state)).sum()
    }

    /// True when no body is to come, and every free one moves away from every surface, or rests, at
    /// `time` [s].
    pub(crate) fn all_away(&self, engine: &dyn Engine, time: f64) -> bool {
        let done = |&body: &usize| match &self.tracks[body].slide {
            Some(_) => engine.driven(body).is_some_and(abrade::Driven::is_done),
            None if self.tracks[body].inertia.is_immovable() => true,
            None => self.is_away(engine, body, time),
        };
        self.all_have_come() && self.presences.live.iter().all(done)
    }

    /// True when a body moves away from every surface, or rests, at `time` [s].
    pub(super) fn is_away(&self, engine: &dyn Engine, body: usize, time: f64) -> bool {
        let (track, state) = (&self.tracks[body], engine.state(body));
        let rests = state.velocity.norm() <= REST * track.top_speed;
        let parted = !engine.in_contact(body);
        (0..self.frames.len()).all(|surface| {
            let going = self.going(engine, surface, time);
            rests && !going.is_led() || parted && self.leaves(&going, &state, track.reach)
        })
    }

    /// Where a surface goes from `time` [s] on.
    fn going(&self, engine: &dyn Engine, surface: usize, time: f64) -> Going {
        match &self.paths[surface] {
            Some((path, _)) if path.is_over(time) => return Going::Stays(surface),
            Some((_, swept)) => return Going::Within(*swept),
            None => {}
        }
        let carried = self.carriers[surface].zip(engine.carrier(surface));
        carried.map_or(Going::Stays(surface), |(body, state)| Going::On {
            surface,
            velocity: state.velocity,
            spin: state.spin,
            centre_local: body.centre_local,
            is_led: body.inertia.is_none(),
        })
    }

    /// Away from a surface: rising over a plate, or below its plane; straight past the box around a
    /// solid, which for one that turns is the box around all its attitudes, and for a surface on a
    /// path the box around all its places.
    fn leaves(&self, going: &Going, state: &State, reach: f64) -> bool {
        let (surface, velocity, turns) = match going {
            Going::Within(swept) => return misses(state, reach, swept),
            Going::Stays(surface) => (*surface, Vector3::zeros(), None),
            Going::On { surface, velocity, spin, centre_local, .. } => {
                let turns = (*spin != Vector3::zeros()).then_some(*centre_local);
                (*surface, *velocity, turns)
            }
        };
        let frame = &self.frames[surface];
        let mut local = state.seen_from(frame);
        local.velocity -= frame.inverse_transform_vector(&velocity);
        match (&self.solids[surface], turns) {
            (None, _) => local.velocity.z >= 0.0 || local.position.z < 0.0,
            (Some(corners), None) => misses(&local, reach, corners),
            (Some(corners), Some(centre)) => misses(&local, reach, &turned(corners, &centre)),
        }
    }
}

/// Where a surface, by its index, goes.
enum Going {
    /// Nowhere.
    Stays(usize),
    /// On with the body that it moves with, as that moves now: velocity [m/s] and spin [rad/s] of the
    /// body, whose centre is a point of the surface's frame [m].
    On {
        surface: usize,
        velocity: Vector3<f64>,
        spin: Vector3<f64>,
        centre_local: Point3<f64>,
        is_led: bool,
    },
    /// Anywhere in a box of the world, as its path wants.
    Within([Point3<f64>; 2]),
}

impl Going {
    /// True when a body at rest cannot know that it has seen the last of the surface.
    fn is_led(&self) -> bool {
        match self {
            Self::Stays(_) => false,
            Self::On { velocity, spin, is_led, .. } => {
                let still = *velocity == Vector3::zeros() && *spin == Vector3::zeros();
                *is_led && !still
            }
            Self::Within(_) => true,
        }
    }
}

/// The path of a surface and the box around all its places on it.
fn path_and_box(built: &BuiltSurface) -> Option<(LedPath, [Point3<f64>; 2])> {
    let path = built.path.clone()?;
    let swept = path.swept(&built.surface.bounds());
    Some((path, swept))
}

/// A box about `centre` that holds the box between the corners in every attitude.
fn turned([low, high]: &[Point3<f64>; 2], centre: &Point3<f64>) -> [Point3<f64>; 2] {
    let half = Vector3::repeat((low - centre).abs().sup(&(high - centre).abs()).norm());
    [centre - half, centre + half]
}

/// True when a body of this `reach` [m] that flies straight on never comes into the box between
/// `corners`.
fn misses(state: &State, reach: f64, [low, high]: &[Point3<f64>; 2]) -> bool {
    let (mut from, mut until) = (0.0f64, f64::INFINITY);
    for axis in 0..3 {
        let (at, speed) = (state.position[axis], state.velocity[axis]);
        let [near, far] = [low[axis] - reach - at, high[axis] + reach - at];
        if speed == 0.0 {
            if near >= 0.0 || far <= 0.0 {
                return true;
            }
            continue;
        }
        let [a, b] = [near / speed, far / speed];
        (from, until) = (from.max(a.min(b)), until.min(a.max(b)));
    }
    from >= until
}

impl Slide {
    fn see(&mut self, sample: &Sample<'_>, volume: f64) {
        let (before, from) = (self.travelled, self.volume);
        self.travelled = (sample.state.position.coords - self.start).dot(&self.heading);
        self.volume = volume;
        self.force_sum += sample.force * (self.travelled - before);
        self.force = sample.force;
        let threshold = self.distance - self.rate_over;
        let length = self.travelled - before;
        // Not before it slides: the indentation is no part of the rate.
        if self.rate_from.is_none() && length > 0.0 && self.travelled >= threshold {
            let share = (threshold - before) / length;
            self.rate_from = Some(from + share.clamp(0.0, 1.0) * (volume - from));
        }
    }

    /// Volume per distance over the last `rate_over` [m2].
    pub(crate) fn rate(&self) -> Option<f64> {
        let from = self.rate_from?;
        let over = self.travelled - (self.distance - self.rate_over);
        (over > 0.0).then(|| (self.volume - from) / over)
    }

    /// Mean force over the distance slid [N]; the last one of a body that only indents.
    pub(crate) fn mean_force(&self) -> Vector3<f64> {
        if self.travelled > 0.0 { self.force_sum / self.travelled } else { self.force }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a rule that takes a body between the walls of a box, or on its way to it, for
    /// one that leaves.
    #[test]
    fn a_body_leaves_a_solid_when_its_way_misses_the_box() {
        let corners = [Point3::new(-1.0, -1.0, -1.0), Point3::new(1.0, 1.0, 1.0)];
        let passes = |at: [f64; 3], v: [f64; 3]| {
            let state = State { velocity: v.into(), ..State::at(Point3::from(at)) };
            misses(&state, 0.5, &corners)
        };
        assert!(!passes([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]));
        assert!(!passes([0.0, 0.0, 9.0], [0.0, 0.0, -1.0]));
        assert!(passes([0.0, 0.0, 9.0], [0.0, 0.0, 1.0]));
        assert!(passes([1.6, 0.0, 9.0], [0.0, 0.0, -1.0]));
        assert!(!passes([1.4, 0.0, 9.0], [0.0, 0.0, -1.0]));
        assert!(passes([3.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    }
}
