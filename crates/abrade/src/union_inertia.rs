//! Volume, centre and inertia of a union of balls: where balls overlap, the matter counts once.
//!
//! Balls that overlap none are summed in closed form. A group that overlaps is cut by lines along
//! z: along a line the union is a set of intervals, integrated exactly; across, the midpoint rule
//! on a square grid. For a ball of radius R and a grid of h its relative error is about
//! 0.3 (h/R)^2 (Poisson summation of the chord function). Every group is integrated on two grids,
//! and their difference is reported as the error.

use nalgebra::{Matrix3, Point3, Vector3};

use crate::error::{ParameterError, ShapeError};
use crate::shape::Ball;

/// Intervals that the fine grid cuts out of a group of overlapping balls.
const FINE: f64 = 1.5e6;
/// The same for the coarse grid, which only serves the error estimate.
const COARSE: f64 = 4e5;

/// Mass properties of a union of balls of unit density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnionInertia {
    /// Volume [m3].
    pub volume: f64,
    /// Centre of mass [m].
    pub centre: Point3<f64>,
    /// Inertia tensor about the centre of mass, per density [m5].
    pub tensor: Matrix3<f64>,
    /// Estimated relative error of volume and tensor [-]; zero when no balls overlap.
    pub error: f64,
}

impl UnionInertia {
    /// Mass properties of the union of `balls`.
    ///
    /// # Errors
    /// No ball, or a ball whose centre or radius is out of range, so far that volume or inertia is no
    /// number.
    pub fn of_balls(balls: &[Ball]) -> Result<Self, ShapeError> {
        let Some(first) = balls.first() else {
            return Err(ShapeError::Empty { what: "the union has no balls" });
        };
        check(balls)?;
        let origin = first.centre.coords;
        let scale = balls.iter().map(|ball| ball.radius).fold(0.0, f64::max);
        let near: Vec<Ball> = balls
            .iter()
            .map(|ball| Ball {
                centre: Point3::from((ball.centre.coords - origin) / scale),
                radius: ball.radius / scale,
            })
            .collect();
        let (mut fine, mut coarse) = (Moments::default(), Moments::default());
        for group in overlapping_groups(&near) {
            match group[..] {
                [lone] => {
                    let exact = Moments::of_ball(&near[lone]);
                    fine.add(&exact);
                    coarse.add(&exact);
                }
                _ => {
                    let group: Vec<Ball> = group.iter().map(|&i| near[i]).collect();
                    fine.add(&Moments::on_grid(&group, FINE));
                    coarse.add(&Moments::on_grid(&group, COARSE));
                }
            }
        }
        let found = fine.about_centre();
        let sized = Self {
            volume: found.volume * scale.powi(3),
            centre: Point3::from(found.centre.coords * scale + origin),
            tensor: found.tensor * scale.powi(5),
            error: found.difference(&coarse.about_centre()),
        };
        let can_be_said = sized.volume > 0.0 && sized.tensor.trace() > 0.0 && sized.is_finite();
        can_be_said.then_some(sized).ok_or_else(|| out_of_range(balls, scale).into())
    }

    fn is_finite(&self) -> bool {
        let numbers = self.tensor.iter().chain(self.centre.iter()).chain([&self.volume]);
        numbers.into_iter().all(|x| x.is_finite())
    }

    fn difference(&self, other: &Self) -> f64 {
        let volume = (self.volume - other.volume).abs() / self.volume;
        let tensor = (self.tensor - other.tensor).norm() / self.tensor.norm();
        volume.max(tensor)
    }
}

/// Pairs of balls that overlap, each named once, the smaller index first, in order.
pub fn overlapping_pairs(balls: &[Ball]) -> Vec<[usize; 2]> {
    let low = |i: usize| balls[i].centre.x - balls[i].radius;
    let mut order: Vec<usize> = (0..balls.len()).collect();
    order.sort_by(|&a, &b| low(a).total_cmp(&low(b)));
    let mut pairs = Vec::new();
    for (at, &i) in order.iter().enumerate() {
        let end = balls[i].centre.x + balls[i].radius;
        for &j in order[at + 1..].iter().take_while(|&&j| low(j) < end) {
            let distance = (balls[i].centre - balls[j].centre).norm();
            if distance < balls[i].radius + balls[j].radius {
                pairs.push([i.min(j), i.max(j)]);
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Indices of the balls, grouped so that balls of different groups do not overlap.
fn overlapping_groups(balls: &[Ball]) -> Vec<Vec<usize>> {
    let mut leader: Vec<usize> = (0..balls.len()).collect();
    fn lead(leader: &mut [usize], mut i: usize) -> usize {
        while leader[i] != i {
            leader[i] = leader[leader[i]];
            i = leader[i];
        }
        i
    }
    for [a, b] in overlapping_pairs(balls) {
        let (a, b) = (lead(&mut leader, a), lead(&mut leader, b));
        leader[a.max(b)] = a.min(b);
    }
    let mut groups = vec![Vec::new(); balls.len()];
    for i in 0..balls.len() {
        groups[lead(&mut leader, i)].push(i);
    }
    groups.retain(|group| !group.is_empty());
    groups
}

/// Integrals of 1, x and x x^T over a solid, about a fixed origin.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    volume: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Moments {
    fn of_ball(ball: &Ball) -> Self {
        let volume = 4.0 / 3.0 * std::f64::consts::PI * ball.radius.powi(3);
        let own = Matrix3::from_diagonal_element(0.2 * ball.radius * ball.radius);
        let centre = ball.centre.coords;
        let second = (own + centre * centre.transpose()) * volume;
        Self { volume, first: centre * volume, second }
    }

    /// The union of `balls` on a grid whose lines cut about `intervals` intervals out of them.
    fn on_grid(balls: &[Ball], intervals: f64) -> Self {
        let disc = |b: &Ball| std::f64::consts::PI * b.radius * b.radius;
        let h = (balls.iter().map(disc).sum::<f64>() / intervals).sqrt();
        let (low, high) = extent(balls, 1);
        let origin = extent(balls, 0).0;
        let mut found = Self::default();
        if h == 0.0 {
            return found;
        }
        let mut cuts = Vec::new();
        for row in 0..((high - low) / h).ceil() as usize {
            let y = low + (row as f64 + 0.5) * h;
            cut_row(balls, y, origin, h, &mut cuts);
            let mut rest = &cuts[..];
            while let Some(first) = rest.first() {
                let [_, length, mean, square] = first_interval(&mut rest);
                let x = origin + (first.column as f64 + 0.5) * h;
                found.add_stick(x, y, [length, mean, square].map(|moment| moment * h * h));
            }
        }
        found
    }

    /// A stick along z at (x, y) with these moments of order 0, 1, 2 along it.
    fn add_stick(&mut self, x: f64, y: f64, [m0, m1, m2]: [f64; 3]) {
        self.volume += m0;
        self.first += Vector3::new(x * m0, y * m0, m1);
        let (xy, xz, yz) = (x * y * m0, x * m1, y * m1);
        self.second += Matrix3::new(x * x * m0, xy, xz, xy, y * y * m0, yz, xz, yz, m2);
    }

    fn add(&mut self, other: &Self) {
        self.volume += other.volume;
        self.first += other.first;
        self.second += other.second;
    }

    fn about_centre(&self) -> UnionInertia {
        let centre = self.first / self.volume;
        let second = self.second - centre * centre.transpose() * self.volume;
        let tensor = Matrix3::from_diagonal_element(second.trace()) - second;
        UnionInertia { volume: self.volume, centre: centre.into(), tensor, error: 0.0 }
    }
}

/// Where a line along z runs inside a ball.
#[derive(Clone, Copy, Debug)]
struct Cut {
    column: u32,
    low: f64,
    high: f64,
}

/// Cuts of the lines of one row, by column and height.
fn cut_row(balls: &[Ball], y: f64, origin: f64, h: f64, cuts: &mut Vec<Cut>) {
    cuts.clear();
    for ball in balls {
        let dy = y - ball.centre.y;
        let disc = ball.radius * ball.radius - dy * dy;
        if disc <= 0.0 {
            continue;
        }
        let half = disc.sqrt();
        let first = ((ball.centre.x - half - origin) / h - 0.5).ceil().max(0.0) as u32;
        let last = ((ball.centre.x + half - origin) / h - 0.5).floor();
        for column in (first..).take_while(|&column| f64::from(column) <= last) {
            let dx = origin + (f64::from(column) + 0.5) * h - ball.centre.x;
            let chord = (disc - dx * dx).max(0.0).sqrt();
            let z = ball.centre.z;
            cuts.push(Cut { column, low: z - chord, high: z + chord });
        }
    }
    cuts.sort_unstable_by(|a, b| a.column.cmp(&b.column).then(a.low.total_cmp(&b.low)));
}

/// Takes the first interval of the union off `cuts`: column, length, and moments of order 1 and 2.
fn first_interval(cuts: &mut &[Cut]) -> [f64; 4] {
    let Cut { column, low, mut high } = cuts[0];
    let mut taken = 1;
    while let Some(next) = cuts.get(taken) {
        if next.column != column || next.low > high {
            break;
        }
        high = high.max(next.high);
        taken += 1;
    }
    *cuts = &cuts[taken..];
    let square = high * high + high * low + low * low;
    [f64::from(column), high - low, 0.5 * (high - low) * (high + low), (high - low) * square / 3.0]
}

/// Lowest and highest coordinate of the balls along an axis.
fn extent(balls: &[Ball], axis: usize) -> (f64, f64) {
    balls.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), ball| {
        let (c, r) = (ball.centre[axis], ball.radius);
        (low.min(c - r), high.max(c + r))
    })
}

/// What keeps volume and inertia of sound balls, the largest of radius `scale` [m], from being numbers:
/// that radius if that ball alone has none, else the place that is farthest from the first ball.
fn out_of_range(balls: &[Ball], scale: f64) -> ParameterError {
    let lone = Moments::of_ball(&Ball { centre: Point3::origin(), radius: scale });
    let moment = lone.second.trace();
    let from = |x: f64, axis: usize| (x - balls[0].centre[axis]).abs();
    let coordinates = balls.iter().flat_map(|ball| ball.centre.iter().copied().enumerate());
    let farthest = coordinates.max_by(|(a, x), (b, y)| from(*x, *a).total_cmp(&from(*y, *b)));
    let (field, value) = match farthest {
        Some((a, x)) if from(x, a) > 0.0 && moment > 0.0 && moment.is_finite() => ("centre", x),
        _ => ("radius", scale),
    };
    let allowed = "such that volume and inertia are numbers".into();
    ParameterError { field, value, allowed }
}

fn check(balls: &[Ball]) -> Result<(), ShapeError> {
    for ball in balls {
        if let Some(error) = ParameterError::positive("radius", ball.radius) {
            return Err(error.into());
        }
        if let Some(&value) = ball.centre.iter().find(|x| !x.is_finite()) {
            let error = ParameterError { field: "centre", value, allowed: "finite".into() };
            return Err(error.into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
