//! Checks of the paths along which surfaces are led.

use std::path::Path;

use abrade::ParameterError;
use abrade_report::quantity_text::count;
use nalgebra::{Unit, UnitQuaternion, Vector3};

use super::{Checker, finite, vector};
use crate::led_path::{LedPath, Legs, PathFault, Swing, Way, Waypoint};
use crate::number_rows::{Line, Rows};
use crate::place;
use crate::problem::Problem;
use crate::scene::{PathPoint, Rotation, SceneSurface, SurfaceMotion};
use crate::spans::ScenePath;

/// What its file is called in messages.
const PATH: &str = "path";
/// Least number of steps in a period.
const LEAST_STEPS: f64 = 20.0;
/// Least number of steps in a period over the angle of a rocking surface [1/rad]: a quarter turn in
/// a step.
const STEPS_PER_ANGLE: f64 = 4.0;
/// What the digits of a message leave open of the number of steps [-].
const ROUNDED: f64 = 1e-3;
/// Share of the largest velocity by which it may be off within a step without a note.
const WORTH_A_NOTE: f64 = 0.01;
/// Sine of the angle below which two axes count as one.
const PARALLEL: f64 = 1e-9;

/// Where the points of a path are written.
enum Written {
    Scene,
    File { name: String, lines: Vec<Line> },
}

impl Checker<'_> {
    /// Checks the path of the surface at `path`; None when it has none or is refused.
    pub(super) fn check_led_path(
        &mut self,
        path: &ScenePath,
        name: &str,
        surface: &SceneSurface,
        folder: &Path,
        notes: &mut Vec<String>,
    ) -> Option<LedPath> {
        let motion = path.join("motion");
        let before = self.problems.len();
        let way = match &surface.motion {
            SurfaceMotion::Fixed | SurfaceMotion::Kinematic { .. } | SurfaceMotion::Free { .. } => {
                return None;
            }
            SurfaceMotion::Reciprocating { amplitude, frequency, phase } => {
                self.ranges(&motion, [vector("amplitude", amplitude)]);
                let swing = Swing { frequency: *frequency, phase: *phase };
                self.check_swing(&motion, name, &swing, LEAST_STEPS, notes);
                Way::Reciprocating(Vector3::from(*amplitude), swing)
            }
            SurfaceMotion::Rocking { axis, angle, frequency, phase } => {
                let axis = place::direction(Vector3::from(*axis));
                if axis.is_none() {
                    self.no_direction(&motion.join("axis"));
                }
                self.ranges(&motion, [(!angle.is_finite()).then(|| finite("angle", *angle))]);
                let swing = Swing { frequency: *frequency, phase: *phase };
                let least = LEAST_STEPS.max(STEPS_PER_ANGLE * angle.abs());
                self.check_swing(&motion, name, &swing, least, notes);
                Way::Rocking(Unit::new_unchecked(axis?), *angle, swing)
            }
            SurfaceMotion::Path { points, file, scale, repeat } => {
                let (points, written) =
                    self.check_points(&motion, points, file.as_ref(), *scale, folder)?;
                match Legs::new(points, *repeat) {
                    Ok(legs) => Way::Through(legs),
                    Err(fault) => {
                        self.refuse_path(&motion, fault, written);
                        return None;
                    }
                }
            }
        };
        let home = place::home(surface)?;
        (self.problems.len() == before).then(|| LedPath::new(home, way))
    }

    /// A swing must be followed in at least so many steps in a period.
    fn check_swing(
        &mut self,
        motion: &ScenePath,
        name: &str,
        swing: &Swing,
        least: f64,
        notes: &mut Vec<String>,
    ) {
        let Swing { frequency, phase } = *swing;
        let positive = ParameterError::positive("frequency", frequency);
        let is_positive = positive.is_none();
        self.ranges(motion, [positive, (!phase.is_finite()).then(|| finite("phase", phase))]);
        let step = self.scene.run.step;
        let share = frequency * step;
        if is_positive && share * least > 1.0 + ROUNDED {
            let run = ScenePath::of(["run", "step"]);
            let marks = vec![
                self.mark(
                    &motion.join("frequency"),
                    format!("a period of {:.3e} s", 1.0 / frequency),
                ),
                self.mark(&run, format!("a step of {step:.3e} s")),
            ];
            let message = format!("`{motion}` has fewer than {least:.0} steps in a period");
            let most = 1.0 / (least * frequency);
            let help = Some(format!("`run.step` must be at most {most:.3e} s"));
            self.problems.push(Problem { message, marks, help });
        }
        let off = std::f64::consts::PI * share;
        if off > WORTH_A_NOTE {
            notes.push(format!(
                "surface `{name}`: its velocity within a step is off by up to {:.1} % of the largest, \
                 by half of that with half of `run.step`",
                100.0 * off
            ));
        }
    }

    /// The points of a path, from the scene or from a file.
    fn check_points(
        &mut self,
        motion: &ScenePath,
        points: &[PathPoint],
        file: Option<&String>,
        scale: f64,
        folder: &Path,
    ) -> Option<(Vec<Waypoint>, Written)> {
        let Some(file) = file else { return Some((self.written(motion, points)?, Written::Scene)) };
        if !points.is_empty() {
            let message = format!("`{motion}` must have either `points` or `file`");
            self.refuse(motion, message, "give one of them");
            return None;
        }
        let wrong_scale = ParameterError::positive("scale", scale);
        let is_wrong = wrong_scale.is_some();
        self.ranges(motion, [wrong_scale]);
        let path = motion.join("file");
        let Rows { rows, lines } = self.read_rows(&path, PATH, folder, file)?;
        let mut points = Vec::with_capacity(rows.len());
        for (row, line) in rows.iter().zip(&lines) {
            match waypoint(row, scale) {
                Ok(point) => points.push(point),
                Err(fault) => {
                    self.refuse_row(&path, PATH, line.clone(), fault);
                    return None;
                }
            }
        }
        (!is_wrong).then(|| (points, Written::File { name: file.clone(), lines }))
    }

    /// The points as the scene writes them.
    fn written(&mut self, motion: &ScenePath, points: &[PathPoint]) -> Option<Vec<Waypoint>> {
        let before = self.problems.len();
        let mut found = Vec::with_capacity(points.len());
        for (i, point) in points.iter().enumerate() {
            let path = motion.join("points").join(i.to_string());
            let time = (!point.time.is_finite()).then(|| finite("time", point.time));
            self.ranges(&path, [time, vector("shift", &point.shift)]);
            let Some(rotation) = place::rotation(&point.rotation) else {
                self.no_direction(&path.join("rotation"));
                continue;
            };
            if i > 0
                && let Some(turn) = turn_as_written(&points[i - 1].rotation, &point.rotation)
                && turn >= std::f64::consts::PI
            {
                let degrees = turn.to_degrees();
                let message =
                    format!("`{path}` is turned by {degrees} deg from the point before it");
                let label = "must be below 180 deg: put points between";
                self.refuse(&path.join("rotation"), message, label);
            }
            found.push(Waypoint { time: point.time, shift: point.shift.into(), rotation });
        }
        (self.problems.len() == before).then_some(found)
    }

    fn refuse_path(&mut self, motion: &ScenePath, fault: PathFault, written: Written) {
        let (number, field, label) = match fault {
            PathFault::TooFew => (None, "", "needs at least 2 points"),
            PathFault::Open => (None, "", "must end where it begins, since it repeats"),
            PathFault::NotLater(number) => {
                (Some(number), "time", "must be later than the one before")
            }
            PathFault::HalfTurn(number) => (
                Some(number),
                "rotation",
                "is half a turn from the one before: put a point between",
            ),
        };
        match (written, number) {
            (Written::File { mut lines, .. }, Some(number)) => {
                self.refuse_row(&motion.join("file"), PATH, lines.swap_remove(number), label);
            }
            (Written::File { name, .. }, None) => {
                self.refuse(&motion.join("file"), format!("the path `{name}` is none"), label);
            }
            (Written::Scene, Some(number)) => {
                let path = motion.join("points").join(number.to_string());
                let message = match fault {
                    PathFault::HalfTurn(_) => {
                        format!("`{path}.{field}` can be reached either way around")
                    }
                    _ => format!("`{path}.{field}` is out of order"),
                };
                self.refuse(&path.join(field), message, label);
            }
            (Written::Scene, None) => {
                self.refuse(&motion.join("points"), format!("`{motion}` is no path"), label);
            }
        }
    }
}

/// The point of a line of a file.
fn waypoint(row: &[f64], scale: f64) -> Result<Waypoint, String> {
    let (time, shift, xyzw) = match *row {
        [t, x, y, z] => (t, [x, y, z], [0.0, 0.0, 0.0, 1.0]),
        [t, x, y, z, qx, qy, qz, qw] => (t, [x, y, z], [qx, qy, qz, qw]),
        _ => {
            let numbers = count(row.len(), "number", "numbers");
            return Err(format!("has {numbers}, not t, x, y, z, or these and qx, qy, qz, qw"));
        }
    };
    let rotation = place::rotation(&Rotation::Quaternion { xyzw });
    let rotation = rotation.ok_or_else(|| "the quaternion has no direction".to_owned())?;
    Ok(Waypoint { time, shift: Vector3::from(shift) * scale, rotation })
}

/// Angle [rad] between two rotations about one axis, as it is written: a full turn is no rest.
fn turn_as_written(from: &Rotation, to: &Rotation) -> Option<f64> {
    let about = |rotation: &Rotation| match *rotation {
        Rotation::AxisAngle { axis, angle } => {
            Some((place::direction(Vector3::from(axis))?, angle))
        }
        Rotation::Quaternion { .. } | Rotation::Random { .. } => None,
    };
    let still = |rotation: &Rotation| place::rotation(rotation) == Some(UnitQuaternion::identity());
    match (about(from), about(to)) {
        (Some((a, before)), Some((b, after))) => {
            let along = a.dot(&b);
            (a.cross(&b).norm() < PARALLEL).then(|| (after - along.signum() * before).abs())
        }
        (None, Some((_, angle))) if still(from) => Some(angle.abs()),
        (Some((_, angle)), None) if still(to) => Some(angle.abs()),
        _ => None,
    }
}
