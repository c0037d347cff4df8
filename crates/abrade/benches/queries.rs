//! Time in which a shape answers for a node, beside its limit: the formula alone, over the same
//! points.
//!
//! `cargo bench -p abrade --features bench --bench queries` prints a table, then criterion's times.
//! `springs`: overlap of a node, after the question whether there is one. `columns`: lowest point
//! of the body on the node's line. Both sums must agree with the bare ones.

#[path = "impacts/cases.rs"]
#[expect(dead_code, reason = "the shapes of the other benches")]
mod cases;
#[path = "impacts/sampling.rs"]
mod sampling;

use std::hint::black_box;
use std::time::Instant;

use abrade::probe::Asked;
use abrade::{Ball, Piece, Shape, State};
use criterion::Criterion;
use nalgebra::{Point3, UnitQuaternion, Vector3};

use cases::{ball, cube, dodecahedron, pebble};
use sampling::criterion;

const PASSES: usize = 1000;

fn main() {
    let mut criterion = criterion(1, 20);
    let shapes = [
        ("ball", ball().0),
        ("cuboid", cube().0),
        ("hull of 12 faces", dodecahedron().0),
        ("hull of 100 faces", pebble(100).0),
        ("clump of 8 balls", balls(8)),
    ];
    println!(
        "{:20} {:>12} {:>8} {:>8} {:>12} {:>8} {:>8}",
        "shape", "springs [ns]", "limit", "ratio", "columns [ns]", "limit", "ratio"
    );
    for (name, shape) in shapes {
        compare(&mut criterion, name, &shape);
    }
    criterion.final_summary();
}

/// Balls on the corners of a cube, overlapping.
fn balls(count: usize) -> Shape {
    let side = |i: usize, a: usize| if i >> a & 1 == 0 { -0.25 } else { 0.25 };
    let ball = |i| Ball { centre: Point3::from([0, 1, 2].map(|a| side(i, a))), radius: 0.3 };
    Shape::union((0..count).map(|i| Piece::Ball(ball(i))).collect()).expect("a clump")
}

/// The shape 5 % of its size inside a plate, over the nodes within reach of it.
fn compare(criterion: &mut Criterion, name: &str, shape: &Shape) {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, 0.5, 0.2));
    let mut state = State::at(Point3::origin());
    state.rotation = rotation;
    state.position.z = -0.05 - shape.lowest(&rotation, &Vector3::z());
    let pitch = 0.02;
    let place =
        |i: i32| Point3::new(pitch * f64::from(i % 30 - 15), pitch * f64::from(i / 30 - 15), 0.0);
    let points: Vec<_> = (0..900).map(place).collect();
    let (asked, bare) = (Asked::new(shape, &state), Bare::new(shape, &state));
    let pairs = [
        (asked.touches(&points), bare.touches(&points)),
        (asked.spans(&points), bare.spans(&points)),
    ];
    for (a, b) in pairs {
        assert!((a - b).abs() < 1e-9 * a.abs() && a != 0.0, "{name}: {a:e} and {b:e}");
    }
    let mut least = [f64::INFINITY; 4];
    for _ in 0..PASSES {
        let times = [
            time(|| asked.touches(&points)),
            time(|| bare.touches(&points)),
            time(|| asked.spans(&points)),
            time(|| bare.spans(&points)),
        ];
        least = std::array::from_fn(|k| least[k].min(times[k] / points.len() as f64));
    }
    let [touch, touch_limit, span, span_limit] = least;
    println!(
        "{name:20} {touch:>12.1} {touch_limit:>8.1} {:>8.2} {span:>12.1} {span_limit:>8.1} {:>8.2}",
        touch / touch_limit,
        span / span_limit
    );
    let mut group = criterion.benchmark_group(name);
    group.bench_function("springs", |bencher| bencher.iter(|| asked.touches(&points)));
    group.bench_function("springs, limit", |bencher| bencher.iter(|| bare.touches(&points)));
    group.bench_function("columns", |bencher| bencher.iter(|| asked.spans(&points)));
    group.bench_function("columns, limit", |bencher| bencher.iter(|| bare.spans(&points)));
    group.finish();
}

/// Nanoseconds that `work` takes.
fn time(work: impl FnOnce() -> f64) -> f64 {
    let start = Instant::now();
    black_box(work());
    1e9 * start.elapsed().as_secs_f64()
}

/// Balls and the planes of at most one hull, in the frame of the points.
struct Bare {
    balls: Vec<(Point3<f64>, f64)>,
    planes: Vec<(Vector3<f64>, f64)>,
}

impl Bare {
    fn new(shape: &Shape, state: &State) -> Self {
        let mut bare = Self { balls: Vec::new(), planes: Vec::new() };
        for piece in shape.pieces() {
            match piece {
                Piece::Ball(ball) => {
                    let centre = state.position + state.rotation * ball.centre.coords;
                    bare.balls.push((centre, ball.radius));
                }
                Piece::Hull(hull) => bare.planes.extend(hull.planes().iter().map(|plane| {
                    let normal = state.rotation * plane.normal;
                    (normal, plane.offset + normal.dot(&state.position.coords))
                })),
            }
        }
        bare
    }

    #[inline(never)]
    fn touches(&self, points: &[Point3<f64>]) -> f64 {
        match self.planes.is_empty() {
            true => points.iter().map(|x| self.deepest_ball(x)).sum(),
            false => points.iter().map(|x| self.deep_face(x)).sum(),
        }
    }

    #[inline(never)]
    fn spans(&self, points: &[Point3<f64>]) -> f64 {
        match self.planes.is_empty() {
            true => points.iter().map(|x| self.lowest_ball(x)).sum(),
            false => points.iter().filter_map(|x| self.clip(x)).map(|(low, _)| low).sum(),
        }
    }

    #[inline(always)]
    fn deepest_ball(&self, x: &Point3<f64>) -> f64 {
        let depth = |(centre, radius): &(Point3<f64>, f64)| {
            let square = (x - centre).norm_squared();
            if square < radius * radius { radius - square.sqrt() } else { 0.0 }
        };
        self.balls.iter().map(depth).fold(0.0, f64::max)
    }

    #[inline(always)]
    fn lowest_ball(&self, x: &Point3<f64>) -> f64 {
        let low = |(centre, radius): &(Point3<f64>, f64)| {
            let r: Vector3<f64> = centre - x;
            let square = radius * radius - r.xy().norm_squared();
            if square > 0.0 { r.z - square.sqrt() } else { f64::INFINITY }
        };
        let lowest = self.balls.iter().map(low).fold(f64::INFINITY, f64::min);
        if lowest < f64::INFINITY { lowest } else { 0.0 }
    }

    /// Where the vertical through `x` enters the hull from below, and through which face.
    #[inline(always)]
    fn clip(&self, x: &Point3<f64>) -> Option<(f64, f64)> {
        let (mut low, mut high, mut overlap) = (f64::NEG_INFINITY, f64::INFINITY, 0.0);
        for (normal, offset) in &self.planes {
            let room = offset - normal.dot(&x.coords);
            if normal.z < 0.0 {
                let bound = room / normal.z;
                if bound > low {
                    (low, overlap) = (bound, room);
                }
            } else if normal.z > 0.0 {
                high = high.min(room / normal.z);
            } else if room < 0.0 {
                return None;
            }
            if low >= high {
                return None;
            }
        }
        Some((low, overlap))
    }

    /// Overlap with the deep face of a point inside the hull.
    #[inline(always)]
    fn deep_face(&self, x: &Point3<f64>) -> f64 {
        let (mut low, mut overlap) = (f64::NEG_INFINITY, 0.0);
        for (normal, offset) in &self.planes {
            let room = offset - normal.dot(&x.coords);
            if room <= 0.0 {
                return 0.0;
            }
            if normal.z < 0.0 && room < low * normal.z {
                (low, overlap) = (room / normal.z, room);
            }
        }
        overlap
    }
}
