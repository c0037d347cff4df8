//! `abrade study`.

use abrade_study::StudyError;
use abrade_study::convergence::{Plan, Variant, convergence as study};

use crate::arguments::{ConvergenceArguments, Vary};
use crate::failure::{Failure, Rest};
use crate::progress::Bar;
use crate::{earlier, interrupt, kind, output_folder, say};

/// Runs the scene at ladders of settings and says what came of it.
pub(crate) fn convergence(arguments: &ConvergenceArguments) -> Result<(), Failure> {
    let scene = &arguments.scene;
    kind::scene(&scene.scene, &scene.sets)?;
    let folder = output_folder::chosen_for(arguments.out.as_deref(), &scene.scene, "_convergence");
    output_folder::probe(&folder)?;
    earlier::make_way_for_convergence(&folder)?;
    let plan = Plan {
        variants: variants(&arguments.vary),
        landings: arguments.landings,
        budget: arguments.budget,
        reference: arguments.reference.clone(),
        folder,
    };
    let stop = interrupt::flag();
    let mut bar = Bar::of_cases(&stop);
    let study = study(&scene.scene, &scene.sets, &plan, &mut bar);
    bar.clear();
    let study = study.map_err(failure)?;
    let place = say::place(&plan.folder);
    say::say(&format!("{}\nstudy.csv and study.png are in {place}\n", study.table()))?;
    match study.interrupted {
        true => Err(Failure::Interrupted(Rest::Figures)),
        false => Ok(()),
    }
}

fn variants(vary: &[Vary]) -> Vec<Variant> {
    let wanted = |variant: &Variant| {
        let vary_by = match variant {
            Variant::Accuracy => Vary::Accuracy,
            Variant::Pitch => Vary::Pitch,
            Variant::Both => Vary::Both,
            Variant::Single => Vary::Precision,
            Variant::Step(_) => Vary::Step,
            Variant::Stiffness | Variant::Young => Vary::Stiffness,
        };
        vary.is_empty() || vary.contains(&vary_by)
    };
    Variant::ALL.into_iter().filter(wanted).collect()
}

pub(crate) fn failure(error: StudyError) -> Failure {
    match error {
        StudyError::Scene(error) => Failure::Scene(error),
        StudyError::Interrupted => Failure::Interrupted(Rest::Cases),
        StudyError::Reference { .. } | StudyError::Grain { .. } | StudyError::NoCases { .. } => {
            Failure::Input(error.into())
        }
        StudyError::Adhesive(_) => Failure::Input(error.into()),
        StudyError::Run(_) | StudyError::Report(_) | StudyError::Nothing { .. } => {
            Failure::Run(error.into())
        }
    }
}
