//! The search for the sinking at which a contact carries a load. Knows nothing of bodies or nodes:
//! it asks for the excess of the force over the load, which rises with the sinking.

use crate::error::PhysicsError;
#[cfg(feature = "state")]
use crate::state::finite;

/// Relative tolerance of a load that is searched for. What rests is balanced time and again, and sinks by what
/// is too much each time.
pub(crate) const LOAD: f64 = 1e-6;
/// That of a slide, over the accuracy that is asked for.
const SLIDE: f64 = 1e-3;
/// Secants from where the last search ended, before a bracket is sought.
const SECANTS: usize = 8;
/// Steps between the ends of a bracket.
const STEPS: usize = 60;

/// Where a search ended; the next one may begin there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Balance {
    /// Sinking [m].
    pub sink: f64,
    /// Excess per sinking there [N/m].
    pub stiffness: f64,
}

/// A sinking [m] and the excess at it [N].
type Asked = [f64; 2];

/// Relative tolerance of the load on a body that slides on, at an `accuracy`.
pub(crate) fn slide_tolerance(accuracy: f64) -> f64 {
    LOAD.max(SLIDE * accuracy)
}

/// A search under way.
pub(crate) struct Search<F> {
    /// Excess [N] at a sinking [m].
    excess: F,
    load: f64,
    /// Relative tolerance of it.
    tolerance: f64,
    /// Excess at what was asked last [N].
    over: f64,
    /// Sinkings between which the balance lies.
    low: Option<Asked>,
    high: Option<Asked>,
}

impl<F: FnMut(f64) -> f64> Search<F> {
    /// A search for the balance of `load` [N], with a relative `tolerance`.
    pub(crate) fn new(load: f64, tolerance: f64, excess: F) -> Self {
        Self { excess, load, tolerance, over: f64::NAN, low: None, high: None }
    }

    /// The balance, first by secants from the `last` one, then within a bracket that begins at
    /// `scale` [m] to either side and ends before `limit` [m]. What was asked last is what is found.
    /// Where a `reach` [m] bounds the sinking, a load that is carried farther down, or only by a force
    /// that jumps past it, is not reached.
    pub(crate) fn find(
        mut self,
        last: Option<Balance>,
        scale: f64,
        limit: f64,
        reach: Option<f64>,
    ) -> Result<Balance, PhysicsError> {
        let limit = reach.map_or(limit, |reach| reach.min(limit));
        let found = match last.and_then(|last| self.follow(last, scale)) {
            Some(found) => found,
            None => {
                let low = self.low.map_or_else(|| self.enclose(-scale, limit), Ok)?;
                let high = self.high.map_or_else(|| self.enclose(scale, limit), Ok)?;
                self.between(low, high)
            }
        };
        let (load, depth) = (self.load, found.sink);
        match reach.is_some_and(|reach| self.over.abs() >= load || depth > reach) {
            true => Err(PhysicsError::LoadNotReached { load, depth }),
            false => Ok(found),
        }
    }

    /// The excess at a sinking [m].
    fn ask(&mut self, sink: f64) -> f64 {
        self.over = (self.excess)(sink);
        self.over
    }

    /// Secants, as long as they stay between the ends that they find and within `scale` [m], beyond
    /// which a body may get to where it carries the load again, but from below.
    fn follow(&mut self, last: Balance, scale: f64) -> Option<Balance> {
        let Balance { mut sink, mut stiffness } = last;
        let mut before: Option<Asked> = None;
        for _ in 0..SECANTS {
            let [low, high] = [(self.low, -scale), (self.high, scale)]
                .map(|(end, bound)| end.map_or(bound, |[sink, _]| sink));
            if !(low < sink && sink < high) {
                return None;
            }
            let over = self.ask(sink);
            if let Some([s, o]) = before {
                let slope = (over - o) / (sink - s);
                stiffness = if slope > 0.0 { slope } else { stiffness };
            }
            if self.is_balanced(over) {
                return Some(Balance { sink, stiffness });
            }
            if !over.is_finite() {
                return None;
            }
            let asked = Some([sink, over]);
            if over > 0.0 {
                self.high = asked;
            } else {
                self.low = asked;
            }
            before = asked;
            sink -= over / stiffness;
        }
        None
    }

    /// The end of a bracket on the side of `sink` [m].
    fn enclose(&mut self, mut sink: f64, limit: f64) -> Result<Asked, PhysicsError> {
        loop {
            let over = self.ask(sink);
            if over * sink.signum() >= 0.0 {
                return Ok([sink, over]);
            }
            if !over.is_finite() || sink.abs() > limit {
                return Err(PhysicsError::LoadNotReached { load: self.load, depth: sink });
            }
            sink *= 2.0;
        }
    }

    /// The balance within a bracket: regula falsi, and every fourth time bisection.
    pub(crate) fn between(&mut self, mut low: Asked, mut high: Asked) -> Balance {
        let mut count = 0;
        loop {
            let stiffness = (high[1] - low[1]) / (high[0] - low[0]);
            let share = low[1] / (low[1] - high[1]);
            let bisects = count % 4 == 3 || count == STEPS || !share.is_finite();
            let sink = low[0] + if bisects { 0.5 } else { share } * (high[0] - low[0]);
            let over = self.ask(sink);
            if self.is_balanced(over) || sink == low[0] || sink == high[0] || count == STEPS {
                return Balance { sink, stiffness };
            }
            let side = if over > 0.0 { &mut high } else { &mut low };
            *side = [sink, over];
            count += 1;
        }
    }

    fn is_balanced(&self, over: f64) -> bool {
        over.abs() < self.tolerance * self.load
    }
}

#[cfg(feature = "state")]
impl Balance {
    pub(crate) fn is_finite(&self) -> bool {
        finite(&[self.sink, self.stiffness])
    }
}
