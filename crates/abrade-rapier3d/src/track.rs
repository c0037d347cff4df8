//! A path over a step of the embedder, cut into slices of time with a box for each, so that two
//! bodies may pass the same place one after the other.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::extent::Extent;

/// Slices of a step.
pub(crate) const SLICES: usize = 16;

/// Where something is in each slice of a step; nowhere in some of them, perhaps.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    slices: [Option<Extent>; SLICES],
}

impl Track {
    /// In no slice anywhere.
    pub fn nowhere() -> Self {
        Self { slices: [None; SLICES] }
    }

    /// In `extent` all the time.
    pub fn still(extent: Extent) -> Self {
        Self { slices: [Some(extent); SLICES] }
    }

    /// In the box that `extent` gives for a slice from one time to another [s], of a step of
    /// `dt` [s].
    pub fn over(dt: f64, mut extent: impl FnMut(f64, f64) -> Option<Extent>) -> Self {
        let at = |number: usize| dt * number as f64 / SLICES as f64;
        Self { slices: std::array::from_fn(|number| extent(at(number), at(number + 1))) }
    }

    /// In `extent` from one time to another [s], of a step of `dt` [s], and nowhere else.
    pub fn during([from, to]: [f64; 2], dt: f64, extent: Extent) -> Self {
        Self::over(dt, |start, end| (start < to && from < end).then_some(extent))
    }

    /// Box around the whole path, if there is one.
    pub fn whole(&self) -> Option<Extent> {
        self.slices.iter().flatten().copied().reduce(|a, b| a.joined(&b))
    }

    /// The boxes, slice by slice.
    pub fn slices(&self) -> &[Option<Extent>; SLICES] {
        &self.slices
    }

    /// The track with every box changed.
    pub fn map(&self, change: impl Fn(&Extent) -> Extent) -> Self {
        Self { slices: std::array::from_fn(|number| self.slices[number].as_ref().map(&change)) }
    }

    /// The track, along the axes of the outer frame, of this one placed by `frame`.
    pub fn placed_by(&self, frame: &Isometry3<f64>) -> Self {
        self.map(|extent| extent.placed_by(frame))
    }
}

/// Records the track of a point from instant to instant.
pub(crate) struct Trace {
    track: Track,
    /// Length of the step that is cut into slices [s].
    dt: f64,
    /// Acceleration in flight [m/s2]: between two instants the path bends.
    pull: Vector3<f64>,
    last: (f64, Point3<f64>),
}

impl Trace {
    pub fn new(from: Point3<f64>, pull: Vector3<f64>, dt: f64) -> Self {
        let mut track = Track::nowhere();
        track.slices[0] = Some(Extent { low: from, high: from });
        Self { track, dt, pull, last: (0.0, from) }
    }

    /// The point is at `to` at the `time` [s].
    pub fn go(&mut self, time: f64, to: &Point3<f64>) {
        let (began, from) = self.last;
        self.last = (time, *to);
        let (gone, pull) = (time - began, self.pull);
        // The parabola through both points.
        let at = |then: f64| {
            let share = (then / gone).clamp(0.0, 1.0);
            from + (to - from) * share - pull * (0.5 * gone * gone * share * (1.0 - share))
        };
        let slice = self.dt / SLICES as f64;
        for number in self.number(began)..=self.number(time) {
            let [start, end] = [number, number + 1].map(|n| n as f64 * slice - began);
            let ends = if gone > 0.0 { [at(start), at(end)] } else { [from, *to] };
            let part = Extent { low: ends[0].inf(&ends[1]), high: ends[0].sup(&ends[1]) };
            let bend = pull.abs() * (slice.min(gone).powi(2) / 8.0);
            self.hold(number, &Extent { low: part.low - bend, high: part.high + bend });
        }
    }

    /// The track of a point that stays where it is to the end of the step.
    pub fn finish(mut self) -> Track {
        let (time, at) = self.last;
        for number in self.number(time)..SLICES {
            self.hold(number, &Extent { low: at, high: at });
        }
        self.track
    }

    fn hold(&mut self, number: usize, part: &Extent) {
        let slice = &mut self.track.slices[number];
        *slice = Some(slice.map_or(*part, |extent| extent.joined(part)));
    }

    fn number(&self, time: f64) -> usize {
        ((time / self.dt * SLICES as f64) as usize).min(SLICES - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a slice that misses a part of the path, one that holds all of it, and a body
    /// that is nowhere once its steps have ended.
    #[test]
    fn a_trace_holds_the_path_slice_by_slice() {
        let (v, g) = (Vector3::new(2.0, 0.0, -3.0), Vector3::new(0.0, 0.0, -9.81));
        let (dt, stop) = (0.5, 0.4);
        let at = |t: f64| Point3::from(v * t + g * (0.5 * t * t));
        let mut trace = Trace::new(at(0.0), g, dt);
        for t in [0.01, 0.011, 0.3, 0.3, stop] {
            trace.go(t, &at(t));
        }
        let track = trace.finish();
        for i in 0..=1000 {
            let t = dt * i as f64 / 1000.0;
            let p = at(t.min(stop));
            let slice = track.slices()[((t / dt * SLICES as f64) as usize).min(SLICES - 1)];
            let slice = slice.expect("a box for every slice").grown(1e-12);
            assert!(slice.meets(&Extent { low: p, high: p }), "at {t} s");
            assert!(slice.half().x <= v.x * dt / SLICES as f64 + 1e-12);
        }
    }
}
