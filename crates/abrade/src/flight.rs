//! Flight between contacts: how long a body may move before it can touch a node.

use nalgebra::{Point3, Vector3};

use crate::adhesion::Glue;
use crate::body::{Body, State};
use crate::contact::Contact;
use crate::encounter::{Loads, Placed};
use crate::extent::{bounds, clearance};
use crate::shape::Piece;
use crate::surface::Surface;

/// Reach of the columns that a flight looks at, in pitches.
const COLUMNS_PITCH: f64 = 4.0;

/// Time [s] in which a body that moves as `local` as seen from the surface `placed`, with an `acceleration` at
/// most [m/s2], cannot touch it; zero when it may touch at once. A time up to `floor` [s] may be too long.
pub(crate) fn free_time(
    contact: &mut Contact,
    glue: Option<&mut Glue>,
    placed: &Placed<'_>,
    body: &Body,
    local: &State,
    acceleration: f64,
    floor: f64,
) -> f64 {
    let surface = &*placed.surface;
    let range = glue.as_ref().map_or(0.0, |glue| glue.range());
    let apart = box_time(surface, body, local, acceleration, contact.inflation() + range);
    if apart > 0.0 {
        return apart;
    }
    let mut speed = local.velocity.norm() + local.spin.norm() * turning_reach(body);
    if let Some((centre, radius)) = surface.ball() {
        let velocity = local.velocity + local.spin.cross(&(centre - local.position));
        speed = speed.min(velocity.norm() + local.spin.norm() * radius);
    }
    let drawn = glue.map_or(f64::INFINITY, |glue| {
        glue.time_to_reach(surface, &body.shape, local, speed, acceleration)
    });
    touch_time(contact, placed, body, local, [speed, acceleration], floor).min(drawn)
}

/// Time [s] in which a body, none of whose points is faster than `speed` [m/s] and which nothing
/// accelerates by more than `acceleration` [m/s2], cannot touch a node. A time up to `floor` [s] may be too long.
fn touch_time(
    contact: &mut Contact,
    placed: &Placed<'_>,
    body: &Body,
    local: &State,
    [speed, acceleration]: [f64; 2],
    floor: f64,
) -> f64 {
    let surface = &*placed.surface;
    let margin = 0.5 * surface.pitch();
    let patch = match contact {
        Contact::Springs(patch) => patch,
        Contact::Columns(columns) => {
            columns.cover(surface, &body.shape, local, COLUMNS_PITCH * surface.pitch());
            let time = |room| time_to_close(room, speed, acceleration);
            return time(columns.room(surface, &body.shape, local, |room| time(room) > floor));
        }
        Contact::Mutual(mutual) => {
            let Some(skin) = &placed.skin else { return 0.0 };
            // The skin of a ball turns with it.
            let speed = local.velocity.norm() + local.spin.norm() * body.shape.bounding_radius();
            mutual.cover(placed, body, local, 2.0 * margin);
            let slack = mutual.slack(&body.shape, local).max(0.0);
            let covered = time_to_close(slack, speed, acceleration);
            return mutual.time_to_touch(skin, local, speed, acceleration).min(covered);
        }
    };
    patch.cover(surface, &body.shape, local, margin);
    let covered = time_to_close(patch.slack(&body.shape, local).max(0.0), speed, acceleration);
    patch.time_to_touch(local, speed, acceleration).min(covered)
}

/// Time until the boxes of the body and the nodes can meet [s].
pub(crate) fn box_time(
    surface: &Surface,
    body: &Body,
    local: &State,
    acceleration: f64,
    inflation: f64,
) -> f64 {
    if let Some((centre, radius)) = surface.ball() {
        return ball_time(body, local, &centre, [radius, inflation], acceleration);
    }
    let turning = local.spin.norm() * turning_reach(body);
    let time = |(gap, approach)| time_to_close(gap, approach + turning, acceleration);
    gaps(surface, body, local, inflation).map(time).into_iter().fold(0.0, f64::max)
}

/// Time until the body can come within `inflation` of the ball around a solid [s]. Where it is large
/// beside the solid, only what is near counts: within a radius of that.
fn ball_time(
    body: &Body,
    local: &State,
    centre: &Point3<f64>,
    [radius, inflation]: [f64; 2],
    acceleration: f64,
) -> f64 {
    let gap = clearance(&body.shape, local, centre) - radius - inflation;
    let velocity = local.velocity + local.spin.cross(&(centre - local.position));
    let near = velocity.norm() + local.spin.norm() * (2.0 * radius + inflation);
    let whole = local.velocity.norm() + local.spin.norm() * turning_reach(body);
    time_to_close(gap.min(radius), near.min(whole), acceleration)
}

/// Largest gap between the box around the body and the box around the nodes [m]; negative when
/// they meet.
pub(crate) fn separation(surface: &Surface, body: &Body, local: &State, inflation: f64) -> f64 {
    gaps(surface, body, local, inflation)
        .into_iter()
        .map(|(gap, _)| gap)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Time until the body's box leaves the box of the nodes on the side where it moves out of it
/// [s]; infinite for a body that is clear or does not rise.
pub(crate) fn rise_time(surface: &Surface, body: &Body, local: &State, inflation: f64) -> f64 {
    let leaving = |(a, (gap, approach)): (usize, (f64, f64))| {
        if gap < 0.0 && approach < 0.0 {
            let time = gap / approach * (1.0 + f64::EPSILON) + f64::MIN_POSITIVE;
            // The gap may be finer than the position: a step that moves nothing would be asked
            // for again, for ever.
            let at = local.position[a];
            let stuck = at + local.velocity[a] * time == at;
            if stuck { time - f64::EPSILON * at.abs() / approach } else { time }
        } else {
            f64::INFINITY
        }
    };
    let gaps = gaps(surface, body, local, inflation);
    gaps.into_iter().enumerate().map(leaving).fold(f64::INFINITY, f64::min)
}

/// Per axis: the gap between the boxes, and the speed at which it closes.
fn gaps(surface: &Surface, body: &Body, local: &State, inflation: f64) -> [(f64, f64); 3] {
    let [low, high] = bounds(&body.shape, local, inflation);
    let [bottom, top] = surface.bounds();
    std::array::from_fn(|a| {
        let (above, below) = (low[a] - top[a], bottom[a] - high[a]);
        let v: &Vector3<f64> = &local.velocity;
        if above >= below { (above, -v[a]) } else { (below, v[a]) }
    })
}

/// Shortest time in which `gap` closes at `speed`, under `acceleration` at the worst.
pub(crate) fn time_to_close(gap: f64, speed: f64, acceleration: f64) -> f64 {
    if gap <= 0.0 {
        return 0.0;
    }
    let root = (speed * speed + 2.0 * acceleration * gap).sqrt();
    // The stable form of the root of gap = speed t + acceleration t^2 / 2.
    let time = if speed > 0.0 { 2.0 * gap / (speed + root) } else { (root - speed) / acceleration };
    if time.is_nan() { f64::INFINITY } else { time }
}

/// Bound of the speed of any point of the body as the surface sees it [m/s], where they can meet:
/// what lies outside of a solid does not matter to it.
pub(crate) fn top_speed(placed: &Placed<'_>, body: &Body) -> f64 {
    let [velocity, spin] = placed.relative(&body.state);
    let fastest = velocity.norm() + spin.norm() * body.shape.bounding_radius();
    let Some((centre, radius)) = placed.surface.ball() else { return fastest };
    let arm = placed.pose * centre - body.state.position;
    fastest.min((velocity + spin.cross(&arm)).norm() + spin.norm() * radius)
}

/// Bound of the acceleration between body and surface out of contact [m/s2].
pub(crate) fn acceleration(placed: &Placed<'_>, body: &Body, loads: &Loads) -> f64 {
    let carrier = placed.carrier.as_ref().map_or(0.0, |c| c.acceleration(&body.state));
    loads.acceleration(&body.inertia) + carrier
}

/// Lever by which spin moves the body's outline [m].
fn turning_reach(body: &Body) -> f64 {
    match body.shape.pieces() {
        [Piece::Ball(ball)] => ball.centre.coords.norm(),
        _ => body.shape.bounding_radius(),
    }
}
