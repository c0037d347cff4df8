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
mod finer;
mod run;
mod single;
mod solid;
mod table;

use std::sync::atomic::{AtomicU64, Ordering};

use abrade::PhysicsError;
use case::Case;
use finding::Finding;
use run::End;

/// Cases from `first` on, in the order of their numbers.
fn findings(first: u64, count: u64) -> Vec<Finding> {
    findings_of(Case::numbered, first, count)
}

/// The same for cases of another make.
fn findings_of(make: fn(u64) -> Case, first: u64, count: u64) -> Vec<Finding> {
    spread(count, |i| finding::of(make(first + i)))
}

/// `count` answers in their order, worked out on all processors.
fn spread<T: Send>(count: u64, answer: impl Fn(u64) -> T + Sync) -> Vec<T> {
    let next = AtomicU64::new(0);
    let work = || {
        let mut found = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= count {
                return found;
            }
            found.push((i, answer(i)));
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<(u64, T)> = std::thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        running.into_iter().flat_map(|thread| thread.join().expect("no case panics here")).collect()
    });
    all.sort_by_key(|(i, _)| *i);
    all.into_iter().map(|(_, answer)| answer).collect()
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
    let findings = match asked("EXTREME_CASE") {
        Some(number) => findings(number, 1),
        None => findings(0, 500),
    };
    if let [only] = &findings[..] {
        println!("{only:#?}");
    }
    println!("{}", table::of(&findings));
    assert_lawful(&findings);
}

/// Fails for adhesion that gives or takes energy, that no step is short enough for, or whose range the
/// plug-in does not see. `EXTREME_COUNT` and `EXTREME_FIRST` ask for others, `EXTREME_CASE` for one.
#[test]
fn extremes_that_adhere() {
    let [first, count] = match asked("EXTREME_CASE") {
        Some(number) => [number, 1],
        None => [asked("EXTREME_FIRST").unwrap_or(0), asked("EXTREME_COUNT").unwrap_or(150)],
    };
    let findings = findings_of(Case::sticky, first, count);
    if let [only] = &findings[..] {
        println!("{only:#?}");
    }
    println!("{}", table::of(&findings));
    let is_known = |finding: &Finding| {
        STICKY_BROKEN.contains(&finding.case.number) && !finding.broken.is_empty()
    };
    let found = findings.iter().filter(|finding| is_known(finding)).count();
    let asked = STICKY_BROKEN.iter().filter(|&&n| (first..first + count).contains(&n)).count();
    assert_eq!(found, asked, "a case that is known to break a law holds it: take it off the list");
    let others: Vec<_> = findings.into_iter().filter(|finding| !is_known(finding)).collect();
    assert_lawful(&others);
}

/// A body as light as nothing is on a surface that adheres, whose energy does not close: docs/limits.md.
const STICKY_BROKEN: [u64; 1] = [105];

/// Cases that need what few others do: springs that are lost unpaid (819, 19497),
/// nodes that give way late or between two balls (2573, 4391, 4925, 7857, 18333), a body that passes
/// over the border of its plate (6642, 10787), one that flies far after its last spring (17955), and two
/// beside their plates that cut its last nodes far down (53679, 98809).
const RARE: [u64; 12] =
    [819, 2573, 4391, 4925, 6642, 7857, 10787, 17955, 18333, 19497, 53679, 98809];

/// Fails for energy that is booked by the loads before and after a fall and not by what springs let
/// go, for debts that outlive their springs, for a plate whose proxy brakes what does not reach it, and
/// for a flight that is led by the last force of a contact, and for a crater deeper than its body.
#[test]
fn extremes_of_rare_kinds() {
    let findings: Vec<_> = RARE.into_iter().flat_map(|number| findings(number, 1)).collect();
    assert_lawful(&findings);
    for finding in findings {
        // They are within 0.4 %.
        assert!(finding.numerical < 0.01, "{}: {:e}", finding.case.number, finding.numerical);
    }
}

/// Cases whose springs come out of balance little by little.
const CREEPING: [u64; 3] = [45, 271, 994];

/// Fails for a contact that is given up as out of balance while a smaller step would have kept it.
#[test]
fn extremes_that_creep_out_of_balance_take_smaller_steps() {
    let findings: Vec<_> = CREEPING.into_iter().flat_map(|number| findings(number, 1)).collect();
    assert_lawful(&findings);
    for finding in findings {
        let given_up = matches!(finding.end, End::Failed(PhysicsError::Unbalanced { .. }));
        assert!(!given_up, "{}", finding.case.number);
    }
}

/// Prints how cases end that had no result, once their steps are finer or may be many more:
/// `EXTREME_COUNT` cases from `EXTREME_FIRST` on, or `EXTREME_CASE`. Fails for a second run that breaks a
/// law.
#[test]
#[ignore = "a quarter of an hour on two cores; \
            cargo test --release --test extremes -- --ignored again --nocapture"]
fn cases_without_a_result_run_again() {
    let [first, count] = match asked("EXTREME_CASE") {
        Some(number) => [number, 1],
        None => [asked("EXTREME_FIRST").unwrap_or(0), asked("EXTREME_COUNT").unwrap_or(1000)],
    };
    let firsts = findings(first, count);
    let pairs: Vec<_> = spread(firsts.len() as u64, |i| {
        let first = &firsts[i as usize];
        finer::again(first).map(|second| (first.clone(), second))
    });
    let pairs: Vec<_> = pairs.into_iter().flatten().collect();
    if let (Some(number), [(_, only)]) = (asked("EXTREME_CASE"), &pairs[..]) {
        println!("{number}: {only:#?}");
    }
    println!("{}", finer::table(&pairs));
    assert_lawful(&pairs.into_iter().map(|(_, second)| second).collect::<Vec<_>>());
}

/// A number from the environment.
fn asked(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|text| text.parse().ok())
}

/// The same, for more: `EXTREME_COUNT` cases from `EXTREME_FIRST` on. The rows of its cases and the
/// map go to target/extremes, and the map into docs where `EXTREME_DOCS` is set.
#[test]
#[ignore = "forty minutes on two cores; \
            cargo test --release --test extremes -- --ignored hundred_thousand --nocapture"]
fn extremes_of_a_hundred_thousand_cases() {
    let first = asked("EXTREME_FIRST").unwrap_or(0);
    let findings = findings(first, asked("EXTREME_COUNT").unwrap_or(100_000));
    println!("{}", table::of(&findings));
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let kept = root.join("target/extremes");
    std::fs::create_dir_all(&kept).expect("target/extremes");
    let rows = kept.join(format!("cases-{first}.csv"));
    std::fs::write(&rows, table::rows(&findings)).expect("a file of cases");
    let map = if std::env::var_os("EXTREME_DOCS").is_some() { root.join("docs") } else { kept };
    std::fs::write(map.join("limits.csv"), table::csv(&findings)).expect("limits.csv");
    std::fs::write(map.join("limits.svg"), chart::of(&findings)).expect("limits.svg");
    assert_lawful(&findings);
}
