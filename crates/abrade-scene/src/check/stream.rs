//! Checks of streams, as of their first body and of where the others start.

use std::collections::BTreeMap;
use std::path::Path;

use abrade::{ParameterError, TriangleMesh};

use super::{Checker, not_negative};
use crate::place;
use crate::scene::{Motion, SceneBody, Stream};
use crate::solid::Solid;
use crate::spans::ScenePath;
use crate::stream::MOST;

/// The bodies of all streams.
#[derive(Default)]
pub(super) struct Streamed {
    pub bodies: BTreeMap<String, SceneBody>,
    pub solids: BTreeMap<String, Solid>,
    /// Their names, by stream.
    pub names: BTreeMap<String, Vec<String>>,
}

impl Checker<'_> {
    pub(super) fn check_streams(
        &mut self,
        folder: &Path,
        meshes: &BTreeMap<String, TriangleMesh>,
        notes: &mut Vec<String>,
    ) -> Streamed {
        let mut streamed = Streamed::default();
        for (name, stream) in &self.scene.streams {
            let path = ScenePath::of(["streams", name]);
            let before = self.problems.len();
            self.check_flow(&path, stream);
            if self.problems.len() > before {
                continue;
            }
            let bodies: Vec<_> = stream.bodies(name).collect();
            let Some((first, body)) = bodies.first() else { continue };
            let solid = self.check_body(&path, first, body, folder, meshes, notes);
            let Some(solid) = solid else { continue };
            self.check_names(&path, &bodies);
            for (body_name, body) in &bodies[1..] {
                if self.problems.len() > before {
                    break;
                }
                self.check_outside(&path, body_name, body, &solid, meshes);
            }
            let names: Vec<String> = bodies.iter().map(|(name, _)| name.clone()).collect();
            streamed.solids.extend(names.iter().map(|name| (name.clone(), solid.clone())));
            streamed.bodies.extend(bodies);
            streamed.names.insert(name.clone(), names);
        }
        streamed
    }

    /// How many come, when, how far apart, and how fast.
    fn check_flow(&mut self, path: &ScenePath, stream: &Stream) {
        let count = f64::from(stream.count);
        self.ranges(
            path,
            [
                ParameterError::within("count", count, 1.0, f64::from(MOST)),
                ParameterError::positive("every", stream.every),
                not_negative("spread", stream.spread),
            ],
        );
        let motion = path.join("motion");
        match stream.motion {
            Motion::Fixed | Motion::Drive { .. } => {
                let message = format!("`{path}` does not fly");
                self.refuse(&motion, message, "expected `Free(..)` or `Impact(..)`");
            }
            Motion::Free { .. } | Motion::Impact { .. } => {
                let speed = place::velocity(&stream.motion).0.norm();
                let length = speed * stream.every * count;
                if speed == 0.0 {
                    let message = format!("`{path}` has no speed, so its bodies lie in one place");
                    self.refuse(&motion, message, "must have a speed above zero");
                } else if !length.is_finite() {
                    let message = format!("the bodies of `{path}` lie in a row without end");
                    self.refuse(&motion, message, "must be slower, or `every` shorter");
                }
            }
        }
    }

    /// Bodies of streams are called like no other body and no surface.
    fn check_names(&mut self, path: &ScenePath, bodies: &[(String, SceneBody)]) {
        let scene = self.scene;
        let taken =
            |name: &&String| scene.bodies.contains_key(*name) || scene.surfaces.contains_key(*name);
        if let Some(name) = bodies.iter().map(|(name, _)| name).find(taken) {
            let message = format!("the stream `{path}` has a body `{name}`, and so has the scene");
            self.refuse(path, message, "rename the stream");
        }
    }
}
