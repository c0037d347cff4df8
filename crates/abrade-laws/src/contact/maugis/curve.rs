//! The curve of Maugis and Dugdale in reduced quantities: contact radius A and radius of attraction C over
//! (pi w R^2 / K)^(1/3), force over pi w R, displacement over (pi^2 w^2 R / K^2)^(1/3), K = 4 E*/3.
//!
//! With m = C / A = 1 / cos u, and cos^2 u taken into C, Maugis' equations read
//!
//! ```text
//! (lambda C^2 / 2) [sin u cos u + u - 2 u cos^2 u] + (4 lambda^2 C / 3) [u sin u - 1 + cos u] = 1
//! force = A^3 - lambda C^2 [sin u cos u + u],   displacement = A^2 - (4/3) lambda C sin u
//! ```
//!
//! which stay finite as the contact closes, u = pi / 2. From there on C alone goes on, to zero: a uniform
//! pull sigma0 over a circle c raises its middle by 2 sigma0 c / E* and its edge by 4 sigma0 c / (pi E*)
//! (Johnson, Contact mechanics, section 3.4), and the gap at the edge is w / sigma0:
//!
//! ```text
//! displacement = C^2 / 2 - (8 / 3 pi) lambda C - 2 / (pi lambda),   force = -(pi / 2) lambda C^2
//! ```

use std::f64::consts::{FRAC_PI_2, PI};

/// Below this angle differences are summed as series [rad].
const SMALL: f64 = 0.05;
/// Angle of contacts under any load [rad].
const LEAST_ANGLE: f64 = 1e-100;
/// Halvings of an interval of logarithms: to the last bit.
const HALVINGS: usize = 64;
/// Parabolas by which the work in contact is summed.
const PLACES: usize = 400;

/// A point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub displacement: f64,
    pub force: f64,
    /// A.
    pub contact: f64,
}

/// The part of the curve that lasts where the displacement is led: from deep in contact to where the
/// displacement is least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Curve {
    lambda: f64,
    /// u where the contact ends or the bodies tear.
    last_angle: f64,
    /// Least displacement.
    tears: f64,
}

impl Curve {
    pub(super) fn of(lambda: f64) -> Self {
        let closing = reach(lambda, FRAC_PI_2);
        if closing >= turning(lambda) {
            let tears = apart(lambda, turning(lambda)).displacement;
            return Self { lambda, last_angle: FRAC_PI_2, tears };
        }
        let last_angle = first(FRAC_PI_2, |u| slopes(lambda, u)[0] >= 0.0);
        Self { lambda, last_angle, tears: touching(lambda, last_angle).displacement }
    }

    /// Displacement at which the attraction begins: the gap w / sigma0.
    pub(super) fn touches(&self) -> f64 {
        -2.0 / (PI * self.lambda)
    }

    /// Least displacement.
    pub(super) fn tears(&self) -> f64 {
        self.tears
    }

    /// The point at a displacement, [`Self::tears`] or above.
    pub(super) fn at(&self, displacement: f64) -> Point {
        if displacement < touching(self.lambda, self.last_angle).displacement {
            return Point { displacement, ..apart(self.lambda, self.reach_apart(displacement)) };
        }
        self.find(|point| point.displacement <= displacement)
    }

    /// The point without force.
    pub(super) fn rest(&self) -> Point {
        self.find(|point| point.force <= 0.0)
    }

    /// The point of the least force; while the bodies do not touch the pull only shrinks.
    pub(super) fn least_force(&self) -> Point {
        touching(self.lambda, first(FRAC_PI_2, |u| slopes(self.lambda, u)[1] >= 0.0))
    }

    /// Work from a displacement to the least: force times displacement by Simpson's rule, over the angle
    /// in contact, in closed form after it.
    pub(super) fn work_from(&self, displacement: f64) -> f64 {
        let angle = self.angle(|point| point.displacement <= displacement);
        let step = (self.last_angle - angle) / PLACES as f64;
        let at = |half: usize| touching(self.lambda, angle + 0.5 * step * half as f64);
        let places = 0..PLACES;
        let in_contact: f64 =
            places.map(|place| parabola([2 * place, 2 * place + 1, 2 * place + 2].map(at))).sum();
        if self.last_angle < FRAC_PI_2 {
            return in_contact;
        }
        let turning = turning(self.lambda);
        let part = |c: f64| c.powi(3) * (0.25 * c - turning / 3.0);
        let from = reach(self.lambda, FRAC_PI_2).min(self.reach_apart(displacement));
        in_contact + FRAC_PI_2 * self.lambda * (part(from) - part(turning))
    }

    /// C at a displacement at which the bodies do not touch.
    fn reach_apart(&self, displacement: f64) -> f64 {
        let middle = turning(self.lambda);
        let room = middle * middle + 2.0 * (displacement - self.touches());
        middle + room.max(0.0).sqrt()
    }

    /// The first point from deep in contact on for which something `holds`.
    fn find(&self, holds: impl Fn(&Point) -> bool) -> Point {
        touching(self.lambda, self.angle(holds))
    }

    /// Its angle.
    fn angle(&self, holds: impl Fn(&Point) -> bool) -> f64 {
        first(self.last_angle, |u| holds(&touching(self.lambda, u)))
    }
}

/// The first angle up to `last` for which something `holds`, or the last. The logarithm is halved: in the
/// limit of JKR all happens near zero.
fn first(last: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let [mut low, mut high] = [LEAST_ANGLE, last];
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        match holds(middle) {
            true => high = middle,
            false => low = middle,
        }
    }
    high
}

/// Integral of -force over the displacement along a parabola through three points, the displacement
/// falling.
fn parabola([a, b, c]: [Point; 3]) -> f64 {
    let [start, middle, end] = [0.0, 0.5, 1.0].map(|t: f64| {
        let slope = (4.0 * t - 3.0) * a.displacement
            + 4.0 * (1.0 - 2.0 * t) * b.displacement
            + (4.0 * t - 1.0) * c.displacement;
        let force = [a, b, c][(2.0 * t) as usize].force;
        force * slope
    });
    (start + 4.0 * middle + end) / 6.0
}

/// C in contact at an angle: the positive root of the first equation.
fn reach(lambda: f64, u: f64) -> f64 {
    let (square, line) = factors(lambda, u);
    2.0 / (line + (line * line + 4.0 * square).sqrt())
}

/// Factors of C^2 and C in the first equation.
fn factors(lambda: f64, u: f64) -> (f64, f64) {
    let (sine, cosine) = u.sin_cos();
    // sin u - u cos u = sum over k of (-1)^(k+1) 2k u^(2k+1) / (2k+1)!.
    let [a, b, c] = [1.0 / 30.0, 1.0 / 840.0, 1.0 / 45360.0];
    let rest = match u < SMALL {
        true => u.powi(3) * (1.0 / 3.0 - u * u * (a - u * u * (b - u * u * c))),
        false => sine - u * cosine,
    };
    let square = 0.5 * lambda * (cosine * rest + u * sine * sine);
    let line = 4.0 / 3.0 * lambda * lambda * (u * sine - 2.0 * (0.5 * u).sin().powi(2));
    (square, line)
}

/// The contact at an angle.
fn touching(lambda: f64, u: f64) -> Point {
    let (sine, cosine) = u.sin_cos();
    let reach = reach(lambda, u);
    let contact = if u < FRAC_PI_2 { reach * cosine } else { 0.0 };
    Point {
        displacement: contact * contact - 4.0 / 3.0 * lambda * reach * sine,
        force: contact.powi(3) - lambda * reach * reach * (sine * cosine + u),
        contact,
    }
}

/// Attraction without contact over a circle.
fn apart(lambda: f64, reach: f64) -> Point {
    Point {
        displacement: reach * (0.5 * reach - turning(lambda)) - 2.0 / (PI * lambda),
        force: -FRAC_PI_2 * lambda * reach * reach,
        contact: 0.0,
    }
}

/// C at which the displacement without contact is least.
fn turning(lambda: f64) -> f64 {
    8.0 / (3.0 * PI) * lambda
}

/// Slopes of displacement and force over the angle, in contact. With a C^2 + b C = 1 for the first
/// equation, a' = lambda u sin 2u and b' = (4 lambda^2 / 3) u cos u.
fn slopes(lambda: f64, u: f64) -> [f64; 2] {
    let (sine, cosine) = u.sin_cos();
    let c = reach(lambda, u);
    let (square, line) = factors(lambda, u);
    let turn = 4.0 / 3.0 * lambda;
    let change = lambda * u * (2.0 * u).sin() * c * c + turn * lambda * u * cosine * c;
    let slope = -change / (2.0 * square * c + line);
    let contact = slope * cosine - c * sine;
    let a = c * cosine;
    let displacement = 2.0 * a * contact - turn * (slope * sine + c * cosine);
    let pull = 2.0 * c * slope * (sine * cosine + u) + 2.0 * c * c * cosine * cosine;
    [displacement, 3.0 * a * a * contact - lambda * pull]
}
