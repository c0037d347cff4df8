//! Spheres that stand for a solid with faces: each touches a face from within, and goes where what
//! there is so far is farthest from the surface.

use abrade::{Ball, Hull};
use nalgebra::{Point3, Vector3};

/// How well spheres stand for a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Largest distance of a point of the solid's surface from the spheres [m]; they do not stand out
    /// of it.
    pub error: f64,
    /// Mean radius of the spheres that are nearest to its corners [m].
    pub tip_radius: f64,
}

impl Fit {
    /// It in words.
    pub(crate) fn note(&self) -> String {
        let Self { error, tip_radius } = self;
        format!(
            "the spheres stay up to {error:.2e} m below its surface, tips have radii of \
             {tip_radius:.2e} m"
        )
    }

    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { error: self.error * factor, tip_radius: self.tip_radius * factor }
    }
}

/// Points along the longest edge of a facet.
const STEPS: u32 = 48;
/// Radius of a new sphere over the distance that it is to close, at least: half of it leaves 0.37 of
/// the distance at the corner of a cube, and a tenth would leave no room to go on.
const LEAST: f64 = 0.5;

/// A point of the surface, and the largest sphere within that touches it there.
struct Sample {
    point: Point3<f64>,
    ball: Ball,
}

/// `count` spheres within `hull`, at least one.
pub(super) fn spheres(hull: &Hull, count: usize) -> (Vec<Ball>, Fit) {
    let samples = samples(hull);
    let largest = |a: &&Sample, b: &&Sample| a.ball.radius.total_cmp(&b.ball.radius);
    let mut balls: Vec<Ball> = samples.iter().max_by(largest).map(|s| s.ball).into_iter().collect();
    let mut gaps = vec![f64::INFINITY; samples.len()];
    let close = |gaps: &mut Vec<f64>, ball: &Ball| {
        for (gap, sample) in gaps.iter_mut().zip(&samples) {
            *gap = gap.min(apart(ball, &sample.point));
        }
    };
    balls.iter().for_each(|ball| close(&mut gaps, ball));
    while balls.len() < count {
        let Some((at, gap)) = farthest(&gaps) else { break };
        let point = samples[at].point;
        let large = samples.iter().map(|s| s.ball).filter(|ball| ball.radius >= LEAST * gap);
        let nearest = |a: &Ball, b: &Ball| apart(a, &point).total_cmp(&apart(b, &point));
        let Some(ball) = large.min_by(nearest) else { break };
        if apart(&ball, &point) >= gap {
            break;
        }
        close(&mut gaps, &ball);
        balls.push(ball);
    }
    let error = farthest(&gaps).map_or(0.0, |(_, gap)| gap);
    let tip_radius = tip_radius(hull, &balls);
    (balls, Fit { error, tip_radius })
}

fn apart(ball: &Ball, point: &Point3<f64>) -> f64 {
    ((point - ball.centre).norm() - ball.radius).max(0.0)
}

fn farthest(gaps: &[f64]) -> Option<(usize, f64)> {
    let all = gaps.iter().copied().enumerate();
    all.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, gap)| *gap > 0.0)
}

fn tip_radius(hull: &Hull, balls: &[Ball]) -> f64 {
    let at = |corner: &Point3<f64>| {
        let nearest = |a: &&Ball, b: &&Ball| apart(a, corner).total_cmp(&apart(b, corner));
        balls.iter().min_by(nearest).map_or(0.0, |ball| ball.radius)
    };
    let corners = hull.vertices();
    corners.iter().map(at).sum::<f64>() / corners.len() as f64
}

/// Points all over the facets, their corners among them.
fn samples(hull: &Hull) -> Vec<Sample> {
    let corner = |i: u32| hull.vertices()[i as usize];
    let longest = hull.facets().iter().flat_map(|&[a, b, c]| {
        [[a, b], [b, c], [c, a]].map(|[i, j]| (corner(i) - corner(j)).norm())
    });
    let pace = longest.fold(0.0, f64::max) / f64::from(STEPS);
    let mut samples = Vec::new();
    for facet in hull.facets() {
        let [a, b, c] = facet.map(corner);
        let (u, v) = (b - a, c - a);
        let Some(normal) = u.cross(&v).try_normalize(0.0) else { continue };
        let steps = (u.norm().max(v.norm()).max((u - v).norm()) / pace).ceil().max(1.0) as u32;
        for i in 0..=steps {
            for j in 0..=steps - i {
                let share = |k: u32| f64::from(k) / f64::from(steps);
                let point = a + u * share(i) + v * share(j);
                samples.push(Sample { point, ball: touching(hull, &point, &normal) });
            }
        }
    }
    samples
}

/// The largest ball within `hull` that touches its surface at `point`, where `normal` points out. A
/// plane at a distance d from the point and with a normal n of its own bounds the radius by
/// d / (1 - n . normal).
fn touching(hull: &Hull, point: &Point3<f64>, normal: &Vector3<f64>) -> Ball {
    let bound = |plane: &abrade::Plane| {
        let distance = (plane.offset - plane.normal.dot(&point.coords)).max(0.0);
        let bend = 1.0 - plane.normal.dot(normal);
        if bend < 1e-9 { f64::INFINITY } else { distance / bend }
    };
    let radius = hull.planes().iter().map(bound).fold(f64::INFINITY, f64::min);
    Ball { centre: point - normal * radius, radius }
}
