//! Time of a node evaluation beside its limit: a bare loop over the same steps of the same impact,
//! with the formulas written straight and no options.
//!
//! `cargo bench -p abrade --features bench --bench inner` prints a table, then criterion's times. A
//! node evaluation is one node that carries force in one step. `all`: the bare loop asks the same
//! candidates. `touched`: it is given only those in which something changes, so that it pays for
//! no search at all. `run`: the whole impact or scratch over its node evaluations. Times are the
//! least of many passes, taken in turns; before that both loops must give the same force, torque and
//! drops.

#[path = "../impacts/cases.rs"]
#[expect(dead_code, reason = "the impacts of the other bench, of which some are taken")]
mod cases;
#[path = "../impacts/sampling.rs"]
mod sampling;

mod bare_ball;
mod bare_hull;
mod whole;

use std::hint::black_box;
use std::time::Instant;

use abrade::probe::{Outcome, Recording};
use abrade::{DriveSolution, ElasticLaw};
use criterion::{BatchSize, Criterion};

use bare_ball::BareBall;
use bare_hull::BareHull;
use cases::{Case, cube, dodecahedron, foundation, paper, pebble, projected, unit};
use sampling::criterion;
use whole::Scratch;

/// Steps of an impact that are taken.
const STEPS: usize = 50;
/// Passes over each, of which the fastest counts.
const PASSES: usize = 100;
/// How closely both loops agree, relative to the largest number of the step: the roots of their
/// drops are found to 1e-9.
const AGREEMENT: f64 = 1e-9;

/// The limit of one step.
trait Bare {
    /// Takes the step.
    fn run(&mut self) -> Outcome;
    /// Depths by which the candidates sank in it [m].
    fn drops(&self) -> Vec<f64>;
    /// Leaves out the candidates in which the last run changed nothing.
    fn narrow(&mut self);
}

fn main() {
    let mut criterion = criterion(1, 20);
    println!(
        "{:32} {:>8} {:>10} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}",
        "step",
        "nodes",
        "candidates",
        "ns each",
        "all",
        "ratio",
        "touched",
        "ratio",
        "run",
        "ratio"
    );
    let ball = paper("ball, Foundation", foundation(), projected(), 45.0, Some(0.15e-3));
    let limit = compare(&mut criterion, &ball, BareBall::new);
    for (name, (shape, inertia)) in
        [("cube", cube()), ("hull of 12 faces", dodecahedron()), ("hull of 100 faces", pebble(100))]
    {
        let springs = ElasticLaw::Foundation { stiffness: Some(1e3) };
        for (law, elastic) in [("Foundation", springs), ("Rigid", ElasticLaw::Rigid)] {
            let name = format!("{name}, {law}");
            let mut case = unit(&name, shape.clone(), inertia, elastic, 0.02);
            case.laws.flow = projected();
            case.laws.material.friction = 0.3;
            compare(&mut criterion, &case, BareHull::new);
        }
    }
    scratches(&mut criterion, limit);
    criterion.final_summary();
}

/// Scratches of a ball, whose node evaluations have the `limit` [ns] of an impact's.
fn scratches(criterion: &mut Criterion, limit: f64) {
    let increment = 10e-6;
    let solutions = [
        ("dynamic", DriveSolution::Dynamic),
        ("balanced", DriveSolution::QuasiStatic { increment }),
    ];
    for (name, solution) in solutions {
        let name = format!("scratch, {name}");
        let (run, nodes) = whole::scratch(solution);
        println!("{name:32} {nodes:>8} {limit:>55.1} {run:>8.1} {:>8.2}", run / limit);
        criterion.bench_function(&name, |bencher| {
            let new = || Scratch::new(solution);
            bencher.iter_batched_ref(new, Scratch::slide, BatchSize::PerIteration);
        });
    }
}

/// Prints how long the steps of an impact take; the limit of a node evaluation [ns].
fn compare<B: Bare>(
    criterion: &mut Criterion,
    case: &Case,
    new: impl Fn(&Recording, usize) -> B,
) -> f64 {
    let mut real =
        Recording::of(case.body.clone(), case.plate(), case.settings).expect("an impact");
    real.thin_out(real.len().div_ceil(STEPS));
    let of_all = || (0..real.len()).map(|i| new(&real, i)).collect::<Vec<_>>();
    let (mut all, mut touched) = (of_all(), of_all());
    let (mut nodes, mut candidates) = (0, 0);
    for (i, (all, touched)) in all.iter_mut().zip(&mut touched).enumerate() {
        let outcome = real.run(i);
        assert_same(&outcome, &all.run());
        let drops = real.drops(i);
        let deepest = drops.iter().copied().fold(0.0, f64::max);
        assert_close(&drops, &all.drops(), deepest);
        touched.run();
        touched.narrow();
        assert_same(&outcome, &touched.run());
        nodes += outcome.touching;
        candidates += drops.len();
    }
    let mut spent = [0.0; 3];
    for (i, (all, touched)) in all.iter_mut().zip(&mut touched).enumerate() {
        let least = least_times([&mut || real.run(i), &mut || all.run(), &mut || touched.run()]);
        spent = std::array::from_fn(|k| spent[k] + least[k] / nodes as f64);
    }
    let [real_time, of_all, of_touched] = spent;
    let run = whole::impact(case);
    println!(
        "{:32} {nodes:>8} {candidates:>10} {real_time:>8.1} {of_all:>8.1} {:>8.2} \
         {of_touched:>8.1} {:>8.2} {run:>8.1} {:>8.2}",
        case.name,
        real_time / of_all,
        real_time / of_touched,
        run / of_touched
    );
    let middle = real.len() / 2;
    let mut group = criterion.benchmark_group(&case.name);
    group.bench_function("abrade", |bencher| bencher.iter(|| real.run(middle)));
    group.bench_function("limit", |bencher| bencher.iter(|| touched[middle].run()));
    group.finish();
    of_touched
}

/// Least time of each of the loops over one step, taken in turns [ns]. Each is taken twice and
/// timed once: in a run the candidates of a step are those of the step before, and so in the cache.
fn least_times<const N: usize>(mut loops: [&mut dyn FnMut() -> Outcome; N]) -> [f64; N] {
    let mut least = [f64::INFINITY; N];
    for _ in 0..PASSES {
        for (least, step) in least.iter_mut().zip(&mut loops) {
            black_box(step());
            let start = Instant::now();
            black_box(step());
            *least = least.min(1e9 * start.elapsed().as_secs_f64());
        }
    }
    least
}

fn assert_same(a: &Outcome, b: &Outcome) {
    assert_eq!(a.touching, b.touching);
    assert_close(a.push.as_slice(), b.push.as_slice(), a.push.norm());
    assert_close(a.torque.as_slice(), b.torque.as_slice(), a.torque.norm());
}

fn assert_close(a: &[f64], b: &[f64], scale: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= AGREEMENT * scale, "{a:e} and {b:e} at a scale of {scale:e}");
    }
}
