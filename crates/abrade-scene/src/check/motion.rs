//! Checks of how bodies move.

use abrade::ParameterError;

use super::{Checker, finite, not_negative, vector};
use crate::scene::{Motion, Placement, SceneBody, Solution};
use crate::spans::ScenePath;

impl Checker<'_> {
    pub(super) fn check_motion(&mut self, path: &ScenePath, body: &SceneBody) {
        let motion = path.join("motion");
        match &body.motion {
            Motion::Fixed => {}
            Motion::Impact { speed, angle, azimuth, spin } => self.ranges(
                &motion,
                [
                    not_negative("speed", *speed),
                    ParameterError::within("angle", *angle, 0.0, std::f64::consts::FRAC_PI_2),
                    (!azimuth.is_finite()).then(|| finite("azimuth", *azimuth)),
                    vector("spin", spin),
                ],
            ),
            Motion::Free { velocity, spin } => {
                self.ranges(&motion, [vector("velocity", velocity), vector("spin", spin)]);
            }
            Motion::Drive { .. } => self.check_drive(path, &motion, body),
        }
    }

    fn check_drive(&mut self, path: &ScenePath, motion: &ScenePath, body: &SceneBody) {
        let Motion::Drive { indent_to, load, speed, distance, rate_over, mass, solution } =
            &body.motion
        else {
            return;
        };
        let positive =
            |field, value: &Option<f64>| value.and_then(|v| ParameterError::positive(field, v));
        let before = self.problems.len();
        self.ranges(
            motion,
            [
                ParameterError::positive("indent_to", *indent_to),
                positive("load", load),
                not_negative("speed", *speed),
                not_negative("distance", *distance),
                positive("rate_over", rate_over),
                positive("mass", mass),
            ],
        );
        if let Solution::QuasiStatic { increment } = solution {
            self.ranges(&motion.join("solution"), [positive("increment", increment)]);
        }
        if self.problems.len() == before {
            if *distance > 0.0 && *speed == 0.0 {
                let message = format!("`{motion}` slides a distance at no speed");
                self.refuse(&motion.join("speed"), message, "`speed` must be above zero");
            }
            if rate_over.is_some_and(|over| over > *distance) {
                let message = format!("`{motion}.rate_over` is longer than the path");
                self.refuse(&motion.join("rate_over"), message, "must be at most `distance`");
            }
        }
        if !matches!(body.position, Placement::OnSurface { .. }) && !self.is_on_closed(body) {
            let message = format!("`{path}` is driven, so it must start on a surface");
            self.refuse(&path.join("position"), message, "expected `OnSurface(..)`");
        }
    }

    /// True for a body in the frame of a closed surface, where no drive can be.
    fn is_on_closed(&self, body: &SceneBody) -> bool {
        let surface = body.position.surface().and_then(|name| self.scene.surfaces.get(name));
        surface.is_some_and(|surface| surface.geometry.is_closed())
    }
}
