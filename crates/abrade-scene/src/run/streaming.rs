//! Which bodies are in the world: those of streams come when they are due and go when they meet
//! nothing any more, so that a step costs as much as there is in flight.

use std::collections::VecDeque;

use nalgebra::{Point3, Vector3};

use crate::build::Built;
use crate::check::Checked;
use crate::run::RunError;
use crate::run::bodies::{Bodies, Track};
use crate::run::engine::Engine;

/// Part of a step by which a body may come too soon: it is not worth a step of its own.
const SLIVER: f64 = 1e-9;

/// Bodies by their indices.
pub(crate) struct Presences {
    /// Those in the world, in the order of their indices.
    pub live: Vec<usize>,
    /// Those that wait, the next one first, with their times [s].
    waiting: VecDeque<(f64, usize)>,
    /// Bodies of streams.
    count: usize,
    /// Box in the world around all surfaces and all starts [m].
    corners: [Point3<f64>; 2],
    gravity: Vector3<f64>,
}

impl Presences {
    pub(crate) fn new(checked: &Checked, built: &Built) -> Self {
        let names = || built.bodies.keys().enumerate();
        let live = names().filter(|(_, name)| !checked.due.contains_key(*name));
        let waiting = names().filter_map(|(index, name)| Some((*checked.due.get(name)?, index)));
        let mut waiting: Vec<_> = waiting.collect();
        waiting.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let starts = built.bodies.values().map(|body| body.state.position);
        let surfaces = built.surfaces.values().flat_map(|surface| {
            let ends = surface.surface.bounds();
            (0..8).map(move |corner| {
                let [x, y, z] = [0, 1, 2].map(|axis| ends[corner >> axis & 1][axis]);
                surface.pose * Point3::new(x, y, z)
            })
        });
        let none = [Point3::from([f64::MAX; 3]), Point3::from([f64::MIN; 3])];
        Self {
            live: live.map(|(index, _)| index).collect(),
            count: waiting.len(),
            waiting: waiting.into(),
            corners: starts
                .chain(surfaces)
                .fold(none, |[low, high], p| [low.inf(&p), high.sup(&p)]),
            gravity: checked.scene.gravity.into(),
        }
    }

    /// True where a body of this `reach` [m] that moves away from all surfaces meets nothing that is
    /// to come.
    fn is_outside(&self, place: &Point3<f64>, reach: f64) -> bool {
        let [low, high] = &self.corners;
        let axes = 0..3;
        match self.gravity == Vector3::zeros() {
            true => axes
                .into_iter()
                .any(|axis| place[axis] + reach < low[axis] || place[axis] - reach > high[axis]),
            false => {
                // Past the corner of the box that lies lowest.
                let pull = &self.gravity;
                let lowest: f64 =
                    axes.map(|axis| (pull[axis] * low[axis]).max(pull[axis] * high[axis])).sum();
                place.coords.dot(pull) - reach * pull.norm() > lowest
            }
        }
    }
}

impl Bodies {
    /// Lets the bodies come that are due at `time` [s]; the time until the next one is [s].
    pub(crate) fn bring_due(
        &mut self,
        engine: &mut dyn Engine,
        time: f64,
        step: f64,
    ) -> Result<f64, RunError> {
        let presences = &mut self.presences;
        while let Some(&(due, body)) = presences.waiting.front() {
            if due > time + SLIVER * step {
                return Ok(due - time);
            }
            presences.waiting.pop_front();
            engine.bring(body)?;
            let at = presences.live.partition_point(|&live| live < body);
            presences.live.insert(at, body);
        }
        Ok(f64::INFINITY)
    }

    /// True for a body that has come and not gone.
    pub(crate) fn is_there(&self, body: usize) -> bool {
        self.presences.live.binary_search(&body).is_ok()
    }

    /// The bodies that have come and not gone.
    pub(crate) fn present(&self) -> impl Iterator<Item = &Track> {
        self.presences.live.iter().map(|&body| &self.tracks[body])
    }

    /// Part of the bodies of streams that has come [-]; none without streams.
    pub(crate) fn share_come(&self) -> Option<f64> {
        let all = self.presences.count;
        (all > 0).then(|| 1.0 - self.presences.waiting.len() as f64 / all as f64)
    }

    /// True when no body is to come.
    pub(crate) fn all_have_come(&self) -> bool {
        self.presences.waiting.is_empty()
    }

    /// Takes out the bodies of streams that meet nothing any more, at `time` [s].
    pub(crate) fn let_go(&mut self, engine: &mut dyn Engine, time: f64) {
        let going = self.presences.live.iter().copied().filter(|&body| {
            let track = &self.tracks[body];
            track.is_streamed
                && self.presences.is_outside(&engine.state(body).position, track.reach)
                && !engine.has_ledger(body)
                && self.is_away(engine, body, time)
        });
        let going: Vec<usize> = going.collect();
        for &body in &going {
            engine.take_out(body);
        }
        self.presences.live.retain(|body| going.binary_search(body).is_err());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a grain that gravity will bring back being taken out above the box, and for one that
    /// has fallen past everything staying for ever.
    #[test]
    fn under_gravity_bodies_leave_downwards() {
        let at = |gravity: f64| Presences {
            live: Vec::new(),
            waiting: VecDeque::new(),
            count: 0,
            corners: [Point3::new(-1.0, -1.0, 0.0), Point3::new(1.0, 1.0, 2.0)],
            gravity: Vector3::new(0.0, 0.0, gravity),
        };
        let [above, beside, below] =
            [[0.0, 0.0, 9.0], [9.0, 0.0, 1.0], [9.0, 0.0, -1.0]].map(Point3::from);
        let falls = at(-9.8);
        assert_eq!(
            [above, beside, below].map(|place| falls.is_outside(&place, 0.5)),
            [false, false, true]
        );
        let floats = at(0.0);
        assert!([above, beside, below].iter().all(|place| floats.is_outside(place, 0.5)));
        assert!(!floats.is_outside(&Point3::new(1.4, 0.0, 0.0), 0.5));
    }
}
