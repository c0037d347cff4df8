//! Checks of the run and the outputs.

use abrade::ParameterError;

use super::Checker;
use crate::scene::{Motion, Output, Stop, SurfaceMotion};
use crate::spans::ScenePath;

/// Longest step of the engine [s]: in one of 10 s a ball at 35 m/s loses its rebound.
const LONGEST_STEP: f64 = 1.0;

impl Checker<'_> {
    pub(super) fn check_run(&mut self) {
        self.check_stop();
        let path = ScenePath::of(["run"]);
        let run = &self.scene.run;
        self.ranges(
            &path,
            [
                ParameterError::within("accuracy", run.accuracy, 1e-6, 0.5),
                ParameterError::within("step", run.step, f64::MIN_POSITIVE, LONGEST_STEP),
            ],
        );
        let outputs = &self.scene.outputs;
        let is_laws = |output: &Output| matches!(output, Output::Laws { .. });
        for (i, output) in outputs.iter().enumerate() {
            let path = ScenePath::of(["outputs".to_owned(), i.to_string()]);
            if is_laws(output) && outputs[..i].iter().any(is_laws) {
                self.refuse(&path, "`Laws` stands twice".into(), "one names all laws");
            }
            self.check_output(&path, output);
        }
    }

    fn check_stop(&mut self) {
        let path = ScenePath::of(["run", "stop"]);
        match self.scene.run.stop {
            Stop::Time { limit } => self.ranges(&path, [ParameterError::positive("limit", limit)]),
            Stop::Impacts { count: 0 } => {
                let allowed = "at least 1".to_owned();
                self.out_of_range(&path, &ParameterError { field: "count", value: 0.0, allowed });
            }
            Stop::Distance => {
                let drives = |motion: &Motion| matches!(motion, Motion::Drive { .. });
                if !self.scene.bodies.values().any(|body| drives(&body.motion)) {
                    let message = "`Distance` stops a driven body, and no body is driven".into();
                    self.refuse(&path, message, "no body has the motion `Drive(..)`");
                }
            }
            Stop::AllRebounded | Stop::FirstExit | Stop::Impacts { .. } => {
                self.check_rebounds(&path)
            }
        }
    }

    /// A rule that waits for bodies to leave needs one that can.
    fn check_rebounds(&mut self, path: &ScenePath) {
        let scene = self.scene;
        let moves = scene.surfaces.values().any(|surface| surface.motion != SurfaceMotion::Fixed);
        let still = scene.streams.is_empty()
            && scene.bodies.values().all(|body| body.motion == Motion::Fixed);
        if moves && still {
            let message = "the run would be over at once: no body can leave a surface".into();
            self.refuse(path, message, "expected `Time(limit: ..)`");
        }
    }

    fn check_output(&mut self, path: &ScenePath, output: &Output) {
        match output {
            Output::History { every } => {
                self.ranges(path, [ParameterError::positive("every", *every)]);
            }
            Output::Surface { at: Some(_), every: Some(_) } => {
                let message = format!("`{path}` has both `at` and `every`");
                self.refuse(path, message, "give one of them");
            }
            Output::Surface { every, .. } => {
                let error = every.and_then(|every| ParameterError::positive("every", every));
                self.ranges(path, [error]);
            }
            Output::Laws { names, surface_density, given } => {
                self.check_impact_laws(path, names, *surface_density, given);
            }
            Output::Bodies
            | Output::Mesh { .. }
            | Output::Picture
            | Output::Energy
            | Output::Report => {}
        }
    }
}
