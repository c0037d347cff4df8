//! How the results of a study were made, in sentences: laws, plate, samples, resolution.

use abrade::{ElasticLaw, FlowLaw, Lateral, Removal};
use abrade_report::quantity_text::{digits, length};

use super::file::{Plate, Sequence, StudyFile};

/// A line for each part of the file that the numbers hang on.
pub(crate) fn lines(file: &StudyFile) -> Vec<String> {
    let (target, samples) = (&file.target, &file.samples);
    vec![
        format!(
            "Flow {}, elastic {}, {}; hardness {} GPa, friction {}.",
            flow(&target.flow),
            elastic(&target.elastic),
            removal(&target.removal),
            digits(target.material.hardness / 1e9),
            digits(target.material.friction)
        ),
        format!(
            "{} Each impact ends when the whole grain is out of the plate for the first time.",
            plate(&file.plate)
        ),
        format!(
            "Samples {}, seed {}, at least {}, at most {}, until the interval of the displaced volume is \
             {} % wide on either side; the same samples for every case.",
            sequence(samples.sequence),
            samples.seed,
            samples.least,
            samples.most,
            digits(100.0 * samples.interval)
        ),
        format!(
            "{} pitches in the edge of a cube of E0/H; accuracy {}.",
            digits(file.resolution),
            digits(file.accuracy)
        ),
    ]
}

fn flow(law: &FlowLaw) -> &'static str {
    match law {
        FlowLaw::CapozzaHanley { lateral: Lateral::Projected } => {
            "CapozzaHanley with projected lateral drops"
        }
        FlowLaw::CapozzaHanley { lateral: Lateral::Eq5 } => {
            "CapozzaHanley with lateral drops by Eq. 5"
        }
        FlowLaw::NormalPressure {} => "NormalPressure",
    }
}

fn elastic(law: &ElasticLaw) -> String {
    match law {
        ElasticLaw::Foundation { stiffness: None } => {
            "Foundation of calibrated stiffness".to_owned()
        }
        ElasticLaw::Foundation { stiffness: Some(stiffness) } => {
            format!("Foundation of {} Pa/m", digits(*stiffness))
        }
        ElasticLaw::HertzNodes { node_radius, .. } => {
            format!("HertzNodes with node radius {}", length(*node_radius))
        }
        ElasticLaw::Rigid => "Rigid".to_owned(),
    }
}

fn removal(rule: &Removal) -> String {
    match rule {
        Removal::All => "all displaced is debris".to_owned(),
        Removal::Fraction { of } => format!("{} % of the displaced is debris", digits(100.0 * of)),
        Removal::AttackAngle { critical } => {
            format!("debris where faces attack steeper than {} deg", digits(critical.to_degrees()))
        }
    }
}

fn plate(plate: &Plate) -> String {
    match plate {
        Plate::Fresh => "Every impact finds a fresh plate.".to_owned(),
        Plate::Worn { width } => format!(
            "Impacts are spread over a square of {}, and find it as those before have left it.",
            length(*width)
        ),
    }
}

fn sequence(sequence: Sequence) -> &'static str {
    match sequence {
        Sequence::LowDiscrepancy => "of low discrepancy",
        Sequence::Random => "at random",
    }
}
