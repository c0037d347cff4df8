//! The second run of a case that ended without a result: with steps as fine, or as many, as it asks for.

use std::collections::BTreeMap;
use std::fmt::Write;

use abrade::PhysicsError;

use crate::case::{Case, Means};
use crate::finding::{self, Finding};
use crate::run::End;

/// For a contact that ended where its steps were too coarse for it: they are ten times shorter, and
/// where sizes limit them as many.
const FINE: Means = Means { accuracy: 1e-5, step_limit: 100_000, long: 200_000 };
/// For one that ended because it takes too many.
const MANY: Means = Means { step_limit: 200_000, long: 400_000, ..Means::USUAL };

/// What the second run of a case may spend; None where a smaller step has no part in its end.
fn means(end: &End) -> Option<Means> {
    match end {
        End::Failed(error) => match error {
            PhysicsError::Unbalanced { .. }
            | PhysicsError::NotFinite { .. }
            | PhysicsError::StepVanished { .. } => Some(FINE),
            PhysicsError::TooManySteps { .. } | PhysicsError::LoadNotReached { .. } => Some(MANY),
            PhysicsError::Engulfed { .. }
            | PhysicsError::StartsInside { .. }
            | PhysicsError::Unsupported { .. } => None,
        },
        End::Long | End::HandedOn(_) | End::Refused(_) => Some(MANY),
        End::Rebounded | End::Stays | End::Apart | End::Unbuilt(_) => None,
    }
}

/// The finding of a second run, with the means that the end of the first asks for.
pub fn again(first: &Finding) -> Option<Finding> {
    let means = means(&first.end)?;
    Some(finding::of(Case { means, ..first.case.clone() }))
}

/// How the cases of each end came out at last.
pub fn table(pairs: &[(Finding, Finding)]) -> String {
    let mut ends: BTreeMap<[&str; 2], Vec<u64>> = BTreeMap::new();
    for (first, second) in pairs {
        ends.entry([first.end.name(), second.end.name()]).or_default().push(first.case.number);
    }
    let mut text = String::new();
    for ([first, second], numbers) in ends {
        let few = &numbers[..numbers.len().min(8)];
        let _ = writeln!(text, "{first:>16} -> {second:<16} {:>6} {few:?}", numbers.len());
    }
    text
}
