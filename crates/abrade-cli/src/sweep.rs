//! `abrade sweep`.

use std::fmt::Write as _;

use abrade_report::quantity_text::digits;
use abrade_study::erosion;

use crate::arguments::SweepArguments;
use crate::erosion::{Opened, open};
use crate::failure::Failure;
use crate::say;
use crate::study::failure;

/// Makes the part of the study that is asked for, or merges the parts.
pub(crate) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    let opened = open(&arguments.file)?;
    if arguments.part.list {
        return list(&opened);
    }
    if let Some(folders) = &arguments.part.merge {
        opened.make_way()?;
        for folder in folders {
            erosion::gather(&opened.file, &opened.beside, folder, &opened.out).map_err(failure)?;
        }
        return opened.tell(&[]);
    }
    let all = opened.file.cases().len();
    let cases = arguments.part.choose(opened.file.cases(), |case| case.number)?;
    let unmade = opened.make(&cases)?;
    let there = opened.file.cases().iter().filter(|case| opened.has(case)).count();
    let place = say::place(&opened.out);
    say::say(&format!("{} in {place}\n", say::of_cases(there, all)))?;
    match unmade.is_empty() {
        true => Ok(()),
        false => Err(opened.lacks(all - there, &unmade)),
    }
}

fn list(opened: &Opened) -> Result<(), Failure> {
    let mut text = String::new();
    for case in opened.file.cases() {
        let stage = opened.stage(&case);
        let angle = digits(case.angle.to_degrees());
        let speed = digits(case.speed);
        let _ = writeln!(
            text,
            "{:>5}  {stage:<5}  {angle:>5} deg {speed:>8} m/s  {}",
            case.number, case.grain
        );
    }
    say::say(&text)
}
