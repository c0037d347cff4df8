//! What a case came to, and the laws that it broke.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::case::{Case, Flow, Precision, Target};
use crate::run::{self, End, Record};

/// Every so many cases one is run twice.
const TWICE: u64 = 16;
/// Share of the energy at the start that time integration may make or lose.
pub const NUMERICAL: f64 = 0.05;
/// Rounding of an energy [-].
const ROUNDING: f64 = 1e-9;
/// The same where Rapier's velocities in `f32` are all there is.
const ROUNDING_SINGLE: f64 = 1e-5;

#[derive(Clone, Debug)]
pub struct Finding {
    pub case: Case,
    pub end: End,
    /// Share of the energy at the start that time integration made or lost [-].
    pub numerical: f64,
    /// Energy at the end over that at the start [-], with what Rapier gave where it took over.
    pub left: f64,
    pub steps: u64,
    /// Contacts that began.
    pub touches: u32,
    /// Energies over that at the start [-]: numerical, wear, friction, stored, history, and H times
    /// the volume in normal flow.
    pub shares: [f64; 6],
    pub broken: Vec<String>,
}

pub fn of(case: Case) -> Finding {
    let number = case.number;
    let run = |case: &Case| catch_unwind(AssertUnwindSafe(|| run::run(case)));
    let nothing = |end, broken| Finding {
        case: case.clone(),
        end,
        numerical: 0.0,
        left: 1.0,
        steps: 0,
        touches: 0,
        shares: [0.0; 6],
        broken,
    };
    let record = match run(&case) {
        Err(_) => return nothing(End::Apart, vec!["it panics".to_owned()]),
        Ok(Err(end)) => return nothing(end, Vec::new()),
        Ok(Ok(record)) => record,
    };
    let mut broken = record.broken.clone();
    broken.extend(laws(&case, &record));
    if number.is_multiple_of(TWICE) {
        let again = run(&case).ok().and_then(Result::ok);
        if !again.is_some_and(|again| is_same(&record, &again)) {
            broken.push("a second run gives other bits".to_owned());
        }
    }
    let energy = record.inertia.kinetic_energy(&record.start);
    let numerical = record.ledger.numerical().abs() / energy;
    let left = record.inertia.kinetic_energy(&record.last) / energy;
    let ledger = &record.ledger;
    let price = case.hardness * record.worn_normal;
    let energies =
        [ledger.numerical(), ledger.wear, ledger.friction, ledger.elastic, ledger.history, price];
    let shares = energies.map(|e| e / energy);
    Finding {
        case,
        end: record.end,
        numerical,
        left,
        steps: record.steps,
        touches: record.touches,
        shares,
        broken,
    }
}

fn is_same(one: &Record, other: &Record) -> bool {
    let bits = |record: &Record| {
        let state = &record.last;
        let numbers = state.position.iter().chain(state.rotation.coords.iter());
        let numbers = numbers.chain(state.velocity.iter()).chain(state.spin.iter());
        let ledger = [record.ledger.wear, record.ledger.friction, record.wear_volume];
        let numbers = numbers.chain(&record.depths).chain(&ledger);
        numbers.map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    one.end == other.end && one.steps == other.steps && bits(one) == bits(other)
}

fn laws(case: &Case, record: &Record) -> Vec<String> {
    let mut broken = Vec::new();
    let mut law = |holds: bool, what: &dyn Fn() -> String| {
        if !holds {
            broken.push(what());
        }
    };
    let ledger = &record.ledger;
    let [start, last] =
        [&record.start, &record.last].map(|state| record.inertia.kinetic_energy(state));
    let is_single = case.precision == Precision::Single;
    let rounding = if is_single { ROUNDING_SINGLE } else { ROUNDING } * (start + record.drawn);
    let numerical = ledger.numerical().abs();
    law(record.wear_volume >= 0.0, &|| format!("wear of {:e} m3", record.wear_volume));
    // Sinking nodes may drag the body along: what friction takes is then below zero, but never more
    // than the wear has taken.
    let friction = match case.flow {
        Flow::CapozzaHanley => ledger.friction,
        Flow::NormalPressure => ledger.friction + ledger.wear,
    };
    for (name, energy) in [
        ("friction", friction),
        ("wear", ledger.wear),
        ("damping", ledger.damping),
        ("elastic", ledger.elastic),
    ] {
        law(energy >= -ROUNDING * start, &|| format!("{name} of {energy:e} J of {start:e}"));
    }
    let price = case.hardness * record.worn_normal;
    law(price <= ledger.wear * (1.0 + ROUNDING) + ROUNDING * start, &|| {
        format!("H W of {price:e} J for {:e} J of wear, of {start:e}", ledger.wear)
    });
    let is_whole = record.end.is_normal() || record.end == End::Long;
    if !is_whole {
        if record.end == End::Apart {
            law(!is_through(case, record), &|| "the body is under a plate it never touched".into());
        }
        return broken;
    }
    let allowed = NUMERICAL;
    let given_up = start + ledger.external_work + ledger.elastic_start
        - last
        - ledger.elastic
        - ledger.adhesion;
    law(given_up >= -(numerical + rounding), &|| {
        format!("{:.3e} of the energy was gained", -given_up / start)
    });
    law(numerical <= allowed * (start + record.drawn), &|| {
        format!("time integration made {:.3e} of the energy", ledger.numerical() / start)
    });
    let change = last - start;
    // Beyond the nodes Rapier may hold the body on the proxy.
    law(!record.within || (ledger.kinetic_change - change).abs() <= rounding, &|| {
        format!(
            "kinetic energy changed by {:e}, the ledger says {:e} of {start:e} J",
            change, ledger.kinetic_change
        )
    });
    law(record.depths.iter().all(|depth| *depth <= 2.0 * case.size), &|| {
        "a node is deeper than the body is large".into()
    });
    broken
}

/// True when the middle of the body lies under the top of a plate.
fn is_through(case: &Case, record: &Record) -> bool {
    let at = &record.last.position;
    let radius = case.contact_radius();
    case.target == Target::Strip && at.z < 0.0 && at.x.abs().max(at.y.abs()) < radius
}
