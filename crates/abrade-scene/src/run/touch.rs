//! How bodies came upon surfaces: what a law needs to know of an impact. Kept where a scene asks for it.

use abrade::{State, Surface};
use nalgebra::{Isometry3, Vector3};

/// How a body came upon a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch {
    /// Time since the run began [s].
    pub time: f64,
    /// Speed over the surface [m/s].
    pub speed: f64,
    /// Angle from the surface [rad]; zero for a centre that moves away.
    pub angle: f64,
    pub surface: usize,
}

/// An impact that is over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Struck {
    pub body: usize,
    pub touch: Touch,
    /// Volume displaced on all surfaces [m3].
    pub volume: f64,
}

/// Open contacts, by body, and the impacts that ended in the last step.
pub(crate) struct Touches {
    open: Vec<Option<Touch>>,
    over: Vec<Struck>,
}

/// A surface that a body may have struck.
pub(crate) struct Target<'a> {
    pub index: usize,
    pub surface: &'a Surface,
    pub frame: Isometry3<f64>,
    /// The body that it moves with.
    pub carrier: Option<State>,
}

impl Touches {
    pub(crate) fn new(bodies: usize) -> Self {
        Self { open: vec![None; bodies], over: Vec::new() }
    }

    /// True while the next touch of a body is to be seen.
    pub(crate) fn awaits(&self, body: usize) -> bool {
        self.open[body].is_none()
    }

    /// Notes that a body touches, unless it does already.
    pub(crate) fn begin(&mut self, body: usize, touch: Option<Touch>) {
        let open = &mut self.open[body];
        *open = open.or(touch);
    }

    /// Takes in the contacts that ended in a step, each a body and a volume [m3]; of a body that struck
    /// several surfaces together, one after the other.
    pub(crate) fn end(&mut self, worn: impl Iterator<Item = (usize, f64)>) {
        self.over.clear();
        for (body, volume) in worn {
            match (self.open[body].take(), self.over.last_mut()) {
                (Some(touch), _) => self.over.push(Struck { body, touch, volume }),
                (None, Some(last)) if last.body == body => last.volume += volume,
                (None, _) => {}
            }
        }
    }

    /// Forgets a touch that came to nothing.
    pub(crate) fn drop_idle(&mut self, touches: impl Fn(usize) -> bool) {
        for (body, open) in self.open.iter_mut().enumerate() {
            if open.is_some() && !touches(body) {
                *open = None;
            }
        }
    }

    /// The impacts that ended in the last step.
    pub(crate) fn over(&self) -> &[Struck] {
        &self.over
    }
}

/// The touch of a body in a `state`, of which the velocity is that before it, at `time` [s]: with the
/// target whose nearest node is nearest to its centre.
pub(crate) fn touch<'a>(
    targets: impl Iterator<Item = Target<'a>>,
    state: &State,
    time: f64,
) -> Option<Touch> {
    let near = targets.map(|target| (nearest(&target, state), target));
    let ((_, normal), target) = near.min_by(|a, b| a.0.0.total_cmp(&b.0.0))?;
    let under = target.carrier.map_or_else(Vector3::zeros, |carrier| {
        carrier.velocity + carrier.spin.cross(&(state.position - carrier.position))
    });
    let velocity = state.velocity - under;
    let down = -velocity.dot(&(target.frame * normal));
    let angle = down.max(0.0).atan2((velocity.norm_squared() - down * down).max(0.0).sqrt());
    Some(Touch { time, speed: velocity.norm(), angle, surface: target.index })
}

/// Distance of the body's centre from the target [m], and the normal there, in the target's frame.
fn nearest(target: &Target<'_>, state: &State) -> (f64, Vector3<f64>) {
    let centre = target.frame.inverse_transform_point(&state.position);
    if target.surface.is_flat() {
        return (centre.z.abs(), Vector3::z());
    }
    let nodes = target.surface.nodes();
    let far = |i: &usize| (target.surface.position(*i) - centre).norm_squared();
    let node = (0..nodes.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
    node.map_or((f64::INFINITY, Vector3::z()), |i| (far(&i).sqrt(), nodes.normal[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOUCH: Touch = Touch { time: 0.0, speed: 1.0, angle: 0.5, surface: 0 };

    /// Fails for an impact on two surfaces that counts twice, and for a volume that goes to another body.
    #[test]
    fn an_impact_ends_once() {
        let mut touches = Touches::new(3);
        touches.begin(0, Some(TOUCH));
        touches.begin(0, Some(Touch { speed: 9.0, ..TOUCH }));
        touches.begin(1, Some(TOUCH));
        assert!(!touches.awaits(0) && touches.awaits(2));
        touches.end([(0, 1.0), (0, 2.0), (2, 4.0), (1, 8.0)].into_iter());
        let over = [(0, 3.0), (1, 8.0)].map(|(body, volume)| Struck { body, touch: TOUCH, volume });
        assert_eq!(touches.over(), over);
        touches.begin(2, Some(TOUCH));
        touches.drop_idle(|_| false);
        assert!(touches.awaits(2));
    }
}
