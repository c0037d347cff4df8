//! Pitches, ranges and steps that are plainly too coarse for what a scene is to show, told before anything runs:
//! of scenes of one plate at rest, where what comes to it is known.

use std::f64::consts::PI;

use abrade::{HexStrip, Piece, State};
use abrade_report::quantity_text::{digits, length, time};

use crate::check::Checked;
use crate::place;
use crate::scene::{SceneSurface, SurfaceMotion};
use crate::solid::Solid;
use crate::spans::path;
use crate::way;

/// Radius of a contact in pitches below which it is carried by a few nodes [-].
const FEW: f64 = 2.0;

/// Width of the rim of a contact in pitches below which its adhesion is not resolved ([`abrade::Adhesion`]) [-].
const RIM: f64 = 5.0;

/// Bodies of a stream that are on their way at once, in the beam that one of them fills, from which on they meet each
/// other [-].
const MET: f64 = 0.5;

/// Velocity along the normal over the whole below which a body goes along the plate [-].
const LEVEL: f64 = 1e-9;

/// The only surface of a scene, a plate at rest.
struct Plate<'a> {
    name: &'a str,
    surface: &'a SceneSurface,
    strip: HexStrip,
    hardness: f64,
}

/// What to say of them.
pub(crate) fn notes(checked: &Checked) -> Vec<String> {
    let Some(plate) = Plate::of(checked) else { return Vec::new() };
    let bodies = checked.scene.bodies.keys().filter(|name| !checked.is_streamed(name));
    let single = bodies.filter_map(|name| {
        let solid = checked.solids.get(name)?;
        let what = path(&["bodies", name]);
        let contact = plate.contact(solid, &plate.state(checked, name)?);
        [plate.coarse(&what, contact?), plate.rim(&what, solid)].into_iter().flatten().next()
    });
    let streams =
        checked.streamed.iter().filter_map(|(name, names)| crowd(checked, &plate, name, names));
    single.chain(streams).collect()
}

impl<'a> Plate<'a> {
    fn of(checked: &'a Checked) -> Option<Self> {
        let mut surfaces = checked.scene.surfaces.iter();
        let (Some((name, surface)), None) = (surfaces.next(), surfaces.next()) else { return None };
        let strip = place::strip(&surface.geometry)?;
        let hardness = checked.scene.materials.get(&surface.material)?.hardness;
        let is_at_rest = surface.motion == SurfaceMotion::Fixed;
        is_at_rest.then_some(Self { name, surface, strip, hardness })
    }

    /// How the body called `name` comes to the plate, seen from it: where it starts, at the speed along the normal that
    /// gravity gives it on its way; none for one that does not come down.
    fn state(&self, checked: &Checked, name: &String) -> Option<State> {
        let (body, solid) = (checked.scene.bodies.get(name)?, checked.solids.get(name)?);
        let frame = place::home(self.surface)?;
        let mut state = checked.start(body, solid)?.seen_from(&frame);
        let comes_down = state.velocity.z < -LEVEL * state.velocity.norm();
        let pull = -frame.inverse_transform_vector(&checked.scene.gravity.into()).z;
        let fall = (state.position.z - solid.shape.bounding_radius()).max(0.0);
        state.velocity.z = -(state.velocity.z.powi(2) + 2.0 * pull * fall).max(0.0).sqrt();
        (comes_down && way::comes(checked, name) != Some(false)).then_some(state)
    }

    /// Radius of the contact that a ball comes to whose energy along the normal goes into its crater,
    /// (2 R m v^2 / (pi H))^(1/4) [m]; none for what is no ball.
    fn contact(&self, solid: &Solid, state: &State) -> Option<f64> {
        let [Piece::Ball(ball)] = solid.shape.pieces() else { return None };
        let energy = solid.inertia.mass * state.velocity.z.powi(2);
        Some((2.0 * ball.radius * energy / (PI * self.hardness)).powf(0.25).min(ball.radius))
    }

    /// That a contact of that `radius` [m] is carried by a few nodes.
    fn coarse(&self, what: &str, radius: f64) -> Option<String> {
        let pitch = self.strip.pitch;
        (radius < FEW * pitch).then(|| {
            format!(
                "the contact of `{what}` on `{}` is about {} in radius, and the pitch {}: take a quarter of the radius \
                 or less",
                self.name,
                length(radius),
                length(pitch)
            )
        })
    }

    /// That the rim in which adhesion acts is too narrow, sqrt(2 R range) wide.
    fn rim(&self, what: &str, solid: &Solid) -> Option<String> {
        let [Piece::Ball(ball)] = solid.shape.pieces() else { return None };
        let range = self.surface.adhesion.as_ref()?.range;
        let (rim, pitch) = ((2.0 * ball.radius * range).sqrt(), self.strip.pitch);
        (rim < RIM * pitch).then(|| {
            format!(
                "the rim in which adhesion draws `{what}` to `{}` is {} wide, and the pitch {}: it should be \
                 {RIM} pitches or more",
                self.name,
                length(rim),
                length(pitch)
            )
        })
    }
}

/// That bodies of a stream meet each other on their way, in steps in which each goes farther than its size.
fn crowd(checked: &Checked, plate: &Plate<'_>, name: &str, names: &[String]) -> Option<String> {
    let first = names.first()?;
    let (solid, state) = (checked.solids.get(first)?, plate.state(checked, first)?);
    let last = checked.due.get(names.last()?)?;
    let every = (last - checked.due.get(first)?) / (names.len() as f64 - 1.0);
    // Down to the plate and back.
    let way = 2.0 * state.position.z.max(0.0) / -state.velocity.z;
    let met = (way / every).min(names.len() as f64);
    let size = 2.0 * solid.shape.bounding_radius();
    let (step, needed) = (checked.scene.run.step, size / state.velocity.norm());
    // A beam is a disc of this radius across its way.
    let spread = checked.scene.streams.get(name)?.spread;
    let beside = (size / spread.max(size)).powi(2);
    (met * beside > MET && step > needed).then(|| {
        format!(
            "about {} bodies of `{}` are on their way at once and may meet, and in a step of {} each goes {} times its \
             size: what they do to each other depends on the step; give `run.step` of {} or less",
            digits(met),
            path(&["streams", name]),
            time(step),
            digits(step / needed),
            time(needed)
        )
    })
}
