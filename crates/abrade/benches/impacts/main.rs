//! Time, node evaluations and error in W of one impact, per law and shape.
//!
//! `cargo bench -p abrade --bench impacts` prints one table of all three, then criterion's times
//! side by side; a word after `--` picks cases (`-- plate`). An impact is timed from a new
//! encounter to its exit, on a fresh site; the table gives the least time of its runs. The error in W is
//! against the same landing at an accuracy of 1e-6; for `Rigid` the pitch sets the step and it is
//! zero. What optional parts cost is counted, not timed: `benches/pay.sh`.

mod cases;
mod sampling;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::BenchmarkId;

use cases::{
    Case, Range, ball, clump, cube, dodecahedron, foundation, hertz, paper, pebble, projected, unit,
};
use sampling::criterion;

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let mut criterion = criterion(2, 20);
    let cases = every_case();
    if !words.iter().any(|word| word == "--list" || word == "--test") {
        let picked = words[1..].iter().find(|word| !word.starts_with('-'));
        let fits = |case: &&Case| picked.is_none_or(|word| case.name.contains(word));
        print_table(cases.iter().filter(fits));
    }
    let mut group = criterion.benchmark_group("impact");
    for case in cases {
        group.bench_with_input(BenchmarkId::from_parameter(&case.name), &case, |bencher, case| {
            bencher.iter_custom(|count| time(case, count));
        });
    }
    group.finish();
    criterion.final_summary();
}

fn every_case() -> Vec<Case> {
    let pressure = || abrade::FlowLaw::NormalPressure {};
    let fine = Some(0.15e-3);
    let mut cases = vec![
        paper("paper HertzNodes", hertz(), projected(), 30.0, None),
        paper("paper HertzNodes", hertz(), projected(), 45.0, None),
        paper("paper Foundation 0.15 mm", foundation(), projected(), 30.0, fine),
        paper("paper Foundation 0.15 mm", foundation(), projected(), 45.0, fine),
        paper("paper Foundation NormalPressure 0.15 mm", foundation(), pressure(), 45.0, fine),
    ];
    let literal = || abrade::FlowLaw::CapozzaHanley { lateral: abrade::Lateral::Eq5 };
    let rigid = || abrade::ElasticLaw::Rigid;
    let mut soft =
        paper("paper HertzNodes NormalPressure 1.7 GPa", hertz(), pressure(), 90.0, None);
    soft.laws.material.hardness = 1.7e9;
    cases.extend([
        soft,
        paper("paper HertzNodes Eq5", hertz(), literal(), 45.0, None),
        paper("paper Foundation Eq5 0.15 mm", foundation(), literal(), 45.0, fine),
        paper("paper Rigid 0.15 mm", rigid(), projected(), 45.0, fine),
        paper("paper Rigid NormalPressure 0.15 mm", rigid(), pressure(), 45.0, fine),
    ]);
    for (columns, nodes) in [(70.0, "5e3"), (220.0, "5e4"), (700.0, "5e5"), (2200.0, "5e6")] {
        let case = paper("", hertz(), projected(), 45.0, None);
        let pitch = case.strip.pitch;
        let strip = abrade::HexStrip {
            length: columns * pitch * 0.75f64.sqrt(),
            width: columns * pitch,
            ..case.strip
        };
        cases.push(Case { name: format!("plate of {nodes} nodes"), ..case.on(strip) });
    }
    let springs = || abrade::ElasticLaw::Foundation { stiffness: Some(1e3) };
    let (shape, inertia) = clump();
    cases.push(unit("clump Foundation 1/40", shape.clone(), inertia, springs(), 0.025));
    cases.push(unit("clump Rigid 1/50", shape, inertia, abrade::ElasticLaw::Rigid, 0.02));
    let (shape, inertia) = ball();
    cases.push(unit("ball Rigid 1/50", shape, inertia, abrade::ElasticLaw::Rigid, 0.02));
    let (shape, inertia) = cube();
    cases.push(unit("cube Foundation 1/50", shape.clone(), inertia, springs(), 0.02));
    for (name, (shape, inertia)) in [("12", dodecahedron()), ("100", pebble(100))] {
        let name = format!("hull of {name} faces Foundation 1/50");
        cases.push(unit(&name, shape, inertia, springs(), 0.02));
    }
    for (name, pitch) in [("1/50", 0.02), ("1/100", 0.01)] {
        let rigid = abrade::ElasticLaw::Rigid;
        cases.push(unit(&format!("cube Rigid {name}"), shape.clone(), inertia, rigid, pitch));
    }
    cases
}

/// Wall time of `count` impacts.
fn time(case: &Case, count: u64) -> Duration {
    let mut range = Range::new(case.clone());
    let mut spent = Duration::ZERO;
    for _ in 0..count {
        range.make_ready();
        let start = Instant::now();
        black_box(range.fire());
        spent += start.elapsed();
    }
    spent
}

/// Least time of several runs, with what it bought.
fn print_table<'a>(cases: impl Iterator<Item = &'a Case>) {
    println!(
        "{:46} {:>12} {:>12} {:>12} {:>12}",
        "impact", "time [us]", "evaluations", "ns each", "error in W"
    );
    for case in cases {
        let mut range = Range::new(case.clone());
        let (mut least, mut spent, mut runs) = (Duration::MAX, Duration::ZERO, 0);
        let mut evaluations = 0;
        while runs < 3 || (spent < Duration::from_millis(300) && runs < 1000) {
            range.make_ready();
            let start = Instant::now();
            evaluations = black_box(range.fire()).node_evaluations;
            let time = start.elapsed();
            (least, spent, runs) = (least.min(time), spent + time, runs + 1);
        }
        let limit = case.clone().with_accuracy(1e-6).wear();
        let error = case.wear() / limit - 1.0;
        let nanoseconds = least.as_secs_f64() * 1e9;
        println!(
            "{:46} {:>12.1} {:>12} {:>12.1} {:>12.1e}",
            case.name,
            nanoseconds * 1e-3,
            evaluations,
            nanoseconds / evaluations as f64,
            error
        );
    }
}
