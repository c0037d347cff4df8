//! Checks of streams, as of their first body and of where the others start.

use std::collections::BTreeMap;
use std::path::Path;

use abrade::{ParameterError, TriangleMesh};

use super::{Checker, not_negative};
use crate::grain;
use crate::place;
use crate::scene::{Motion, SceneBody, Sizes, Stream};
use crate::solid::{self, Solid, SolidTrouble};
use crate::spans::ScenePath;
use crate::stream::{self, Coming, Kind, MOST};

/// The bodies of all streams.
#[derive(Default)]
pub(super) struct Streamed {
    pub bodies: BTreeMap<String, SceneBody>,
    pub solids: BTreeMap<String, Solid>,
    /// Their names, by stream.
    pub names: BTreeMap<String, Vec<String>>,
    /// When they come, by name [s].
    pub due: BTreeMap<String, f64>,
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
            self.check_sizes(&path, stream);
            if self.problems.len() > before {
                continue;
            }
            let solids = self.check_kinds(&path, name, stream, folder, notes);
            if self.problems.len() > before {
                continue;
            }
            let kinds: Vec<_> = stream
                .kinds()
                .zip(&solids)
                .map(|((_, share), solid)| kind(share, solid, stream.density))
                .collect();
            let comings: Vec<_> = stream.bodies(name, &kinds).collect();
            self.check_names(&path, &comings);
            if !comings.iter().all(|coming| coming.due.is_finite()) {
                let message = format!("some bodies of `{path}` never come");
                self.refuse(&path, message, "must come sooner");
            }
            let mut names = Vec::new();
            for coming in comings {
                let solid = match made(&coming, &solids[coming.kind], stream, folder) {
                    Ok(solid) => solid,
                    Err(trouble) => {
                        self.refuse_shape(&path, trouble);
                        break;
                    }
                };
                self.check_outside(&path, &coming.name, &coming.body, &solid, meshes);
                if self.problems.len() > before {
                    break;
                }
                names.push(coming.name.clone());
                streamed.due.insert(coming.name.clone(), coming.due);
                streamed.solids.insert(coming.name.clone(), solid);
                streamed.bodies.insert(coming.name, coming.body);
            }
            streamed.names.insert(name.clone(), names);
        }
        streamed
    }

    /// How many come, when, how far apart, and how fast.
    fn check_flow(&mut self, path: &ScenePath, stream: &Stream) {
        let Stream { every, rate, mass_rate, .. } = *stream;
        if [every, rate, mass_rate].iter().flatten().count() != 1 {
            let message = format!("`{path}` must say when its bodies come, in one way");
            self.refuse(path, message, "give one of `every`, `rate` and `mass_rate`");
        }
        let positive = |field, value: Option<f64>| {
            value.and_then(|value| ParameterError::positive(field, value))
        };
        let right = std::f64::consts::FRAC_PI_2;
        self.ranges(
            path,
            [
                ParameterError::within("count", f64::from(stream.count), 1.0, f64::from(MOST)),
                positive("density", stream.density),
                positive("every", every),
                positive("rate", rate),
                positive("mass_rate", mass_rate),
                not_negative("spread", stream.spread),
                ParameterError::within("divergence", stream.divergence, 0.0, right),
            ],
        );
        let motion = path.join("motion");
        match stream.motion {
            Motion::Fixed | Motion::Drive { .. } => {
                let message = format!("`{path}` does not fly");
                self.refuse(&motion, message, "expected `Free(..)` or `Impact(..)`");
            }
            Motion::Free { .. } | Motion::Impact { .. } => {
                if place::velocity(&stream.motion).0.norm() == 0.0 {
                    let message = format!("`{path}` has no speed, so its bodies lie in one place");
                    self.refuse(&motion, message, "must have a speed above zero");
                }
            }
        }
    }

    /// The numbers of its sizes.
    fn check_sizes(&mut self, path: &ScenePath, stream: &Stream) {
        let Some(sizes) = &stream.sizes else { return };
        if stream.density.is_none() {
            let message = format!("`{path}` has sizes, which need a density");
            self.refuse(path, message, "`density` must be given");
        }
        let path = path.join("sizes");
        match *sizes {
            Sizes::Fixed { diameter } => {
                self.ranges(&path, [ParameterError::positive("diameter", diameter)]);
            }
            Sizes::Uniform { from, to } => self.ranges(&path, between(from, to)),
            Sizes::Normal { mean, deviation, from, to } => {
                self.ranges(&path, between(from, to));
                // A tenth of a deviation about the middle holds one draw in 25 at least.
                self.ranges(
                    &path,
                    [
                        ParameterError::within("mean", mean, from, to),
                        ParameterError::within("deviation", deviation, 0.0, 10.0 * (to - from)),
                    ],
                );
            }
            Sizes::LogNormal { median, deviation, from, to } => {
                self.ranges(&path, between(from, to));
                let most = 10.0 * (to / from).ln().clamp(0.0, 1.0);
                self.ranges(
                    &path,
                    [
                        ParameterError::within("median", median, from, to),
                        ParameterError::within("deviation", deviation, 0.0, most),
                    ],
                );
            }
            Sizes::Sieves { ref fractions } => {
                let path = path.join("fractions");
                for (i, sieve) in fractions.iter().enumerate() {
                    let path = path.join(i.to_string());
                    self.ranges(&path, between(sieve.from, sieve.to));
                    self.ranges(&path, [not_negative("mass", sieve.mass)]);
                }
                let mass: f64 = fractions.iter().map(|sieve| sieve.mass).sum();
                if !(mass.is_finite() && mass > 0.0) {
                    let message = format!("`{path}` holds no mass");
                    self.refuse(
                        &path,
                        message,
                        "one fraction at least must have a mass above zero",
                    );
                }
            }
        }
    }

    /// The solids of its shapes, as large as they are written.
    fn check_kinds(
        &mut self,
        path: &ScenePath,
        name: &str,
        stream: &Stream,
        folder: &Path,
        notes: &mut Vec<String>,
    ) -> Vec<Solid> {
        if stream.shape.is_some() != stream.shapes.is_empty() {
            let message = format!("`{path}` must have either `shape` or `shapes`");
            self.refuse(path, message, "not both, not neither");
            return Vec::new();
        }
        let shares = stream.shapes.iter().map(|kind| kind.share);
        if shares.clone().any(|share| not_negative("share", share).is_some())
            || stream.shape.is_none() && shares.sum::<f64>() <= 0.0
        {
            let path = path.join("shapes");
            let message = format!("`{path}` has shares that make no whole");
            self.refuse(&path, message, "must be finite, not below zero, and one above it");
            return Vec::new();
        }
        let mut solids = Vec::new();
        for (index, (shape, _)) in stream.kinds().enumerate() {
            let body = stream.body(shape.clone());
            if index == 0 {
                self.check_motion(path, &body);
                self.check_place(path, &body);
            }
            let path = match &stream.shape {
                Some(_) => path.clone(),
                None => path.join("shapes").join(index.to_string()),
            };
            solids.extend(self.check_solid(&path, name, &body, folder, notes));
        }
        solids
    }

    /// Bodies of streams are called like no other body and no surface.
    fn check_names(&mut self, path: &ScenePath, comings: &[Coming]) {
        let scene = self.scene;
        let taken =
            |name: &&String| scene.bodies.contains_key(*name) || scene.surfaces.contains_key(*name);
        if let Some(name) = comings.iter().map(|coming| &coming.name).find(taken) {
            let message = format!("the stream `{path}` has a body `{name}`, and so has the scene");
            self.refuse(path, message, "rename the stream");
        }
    }
}

/// Two diameters, the smaller one first.
fn between(from: f64, to: f64) -> [Option<ParameterError>; 2] {
    let order = (to < from || !to.is_finite()).then(|| ParameterError {
        field: "to",
        value: to,
        allowed: "finite and at least `from`".into(),
    });
    [ParameterError::positive("from", from), order]
}

fn kind(share: f64, solid: &Solid, density: Option<f64>) -> Kind {
    let mass = solid.inertia.mass;
    let volume = density.map_or(0.0, |density| mass / density);
    Kind { share, mass, diameter: grain::sphere_diameter(volume) }
}

/// The solid of a body; `blank` is that of its shape as large as it is written.
fn made(
    coming: &Coming,
    blank: &Solid,
    stream: &Stream,
    folder: &Path,
) -> Result<Solid, SolidTrouble> {
    let drawn = match stream::is_random(&coming.body.shape) {
        true => Some(solid::solid(&coming.body.shape, stream.density, None, folder)?.0),
        false => None,
    };
    let blank = drawn.as_ref().unwrap_or(blank);
    if stream.sizes.is_none() {
        return Ok(blank.clone());
    }
    let mass = blank.inertia.mass * coming.factor.powi(3);
    if !(mass.is_finite() && mass > 0.0) {
        return Err(SolidTrouble::Weight { mass });
    }
    let solid = grain::scaled(blank, coming.factor, 1.0)?;
    match solid::is_sound(&solid.inertia) {
        true => Ok(solid),
        false => Err(SolidTrouble::Weight { mass }),
    }
}
