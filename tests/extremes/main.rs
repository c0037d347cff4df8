//! The extreme matrix: bodies from dust to boulders, materials from jelly to diamond, creeping and
//! at five kilometres a second, in real worlds of Rapier in both precisions. Every run ends with a
//! result that obeys the laws of nature, or with a typed error that says why; never with a panic,
//! a number that is none, a hang, or a wrong answer that looks like a right one.
//!
//! A case is made from its number alone: `EXTREME_CASE=417 cargo test --release --test extremes
//! five_hundred -- --nocapture` shows one.

mod case;
mod chart;
mod double;
mod finding;
mod run;
mod single;
mod solid;
mod table;

use std::sync::atomic::{AtomicU64, Ordering};

use finding::Finding;

/// Cases from `first` on, spread over the processors, in the order of their numbers.
fn findings(first: u64, count: u64) -> Vec<Finding> {
    let next = AtomicU64::new(first);
    let work = || {
        let mut found = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= first + count {
                return found;
            }
            found.push(finding::of(number));
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<Finding> = std::thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        running.into_iter().flat_map(|thread| thread.join().expect("no case panics here")).collect()
    });
    all.sort_by_key(|finding| finding.case.number);
    all
}

fn assert_lawful(findings: &[Finding]) {
    let broken: Vec<_> = findings.iter().filter(|finding| !finding.broken.is_empty()).collect();
    for finding in broken.iter().take(40) {
        println!("{:?}\n  ended {:?}: {}", finding.case, finding.end, finding.broken.join("; "));
    }
    assert!(broken.is_empty(), "{} of {} cases break a law", broken.len(), findings.len());
}

/// Fails for a contact that gains energy, wears more than was given up, fills a crater, ends in a
/// panic or without end, and for a body that falls through its plate.
#[test]
fn extremes_of_five_hundred_cases() {
    let findings = match std::env::var("EXTREME_CASE").ok().and_then(|text| text.parse().ok()) {
        Some(number) => findings(number, 1),
        None => findings(0, 500),
    };
    if let [only] = &findings[..] {
        println!("{only:#?}");
    }
    println!("{}", table::of(&findings));
    assert_lawful(&findings);
}

/// The same, for more, with the map of docs/limits.md. `EXTREME_COUNT` takes another number.
#[test]
#[ignore = "long: 100 000 cases; writes docs/limits.csv and docs/limits.svg"]
fn extremes_of_a_hundred_thousand_cases() {
    let count = std::env::var("EXTREME_COUNT").ok().and_then(|text| text.parse().ok());
    let findings = findings(0, count.unwrap_or(100_000));
    println!("{}", table::of(&findings));
    let docs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    std::fs::write(docs.join("limits.csv"), table::csv(&findings)).expect("docs/limits.csv");
    std::fs::write(docs.join("limits.svg"), chart::of(&findings)).expect("docs/limits.svg");
    assert_lawful(&findings);
}
