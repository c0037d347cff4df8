//! `abrade study erosion`.

use std::path::{Path, PathBuf};

use abrade_study::erosion::{self, Case, Stage, StudyFile, Unmade};

use crate::arguments::FileArguments;
use crate::failure::Failure;
use crate::progress::Bar;
use crate::study::failure;
use crate::{earlier, interrupt, kind, output_folder, say};

/// Files of a study beside those of its cases.
const TABLES: [&str; 9] = [
    "report.html",
    "cases.csv",
    "cases.jsonl",
    "grains.csv",
    "wear.png",
    "ratio.png",
    "debris.png",
    "speed.png",
    "craters.png",
];

/// A study, and where its files and its results lie.
pub(crate) struct Opened {
    pub(crate) file: StudyFile,
    /// Folder of the study's file.
    pub(crate) beside: PathBuf,
    /// Folder of its results.
    pub(crate) out: PathBuf,
}

/// Makes all cases that are not there, writes the tables, says what came of it.
pub(crate) fn erosion(arguments: &FileArguments) -> Result<(), Failure> {
    let opened = open(arguments)?;
    let unmade = opened.make(&opened.file.cases())?;
    opened.tell(&unmade)
}

/// Reads and checks the study.
pub(crate) fn open(arguments: &FileArguments) -> Result<Opened, Failure> {
    let file = kind::erosion(&arguments.study, &arguments.sets)?;
    let beside = arguments.study.parent().unwrap_or(Path::new("")).to_owned();
    let out = arguments.place.begin(&arguments.study)?;
    Ok(Opened { file, beside, out })
}

impl Opened {
    /// Makes sure that the study may write into its folder.
    pub(crate) fn make_way(&self) -> Result<(), Failure> {
        earlier::make_way_for_cases(&self.out, ".jsonl", &TABLES)
    }

    /// Makes those of `cases` that are not there; returns those that cannot be made.
    pub(crate) fn make(&self, cases: &[Case]) -> Result<Vec<Unmade>, Failure> {
        self.make_way()?;
        output_folder::make(&self.out)?;
        earlier::tell_others(erosion::others(&self.file, &self.beside, &self.out), &self.out);
        for note in erosion::notes(&self.file) {
            say::aside(&format!("note: {note}"));
        }
        let stop = interrupt::flag();
        let mut bar = Bar::of_cases(&stop);
        let made = erosion::make(&self.file, &self.beside, cases, &self.out, &mut bar);
        bar.clear();
        made.map_err(failure)
    }

    /// Writes the tables of the cases that are there, if any is, and shows them; says why the `unmade` are missing.
    pub(crate) fn tell(&self, unmade: &[Unmade]) -> Result<(), Failure> {
        let all = self.file.cases();
        if !all.iter().any(|case| self.has(case)) {
            return Err(self.lacks(all.len(), unmade));
        }
        let result = erosion::result(&self.file, &self.beside, &self.out).map_err(failure)?;
        output_folder::make(&self.out)?;
        erosion::write(&result, &self.beside, &self.out).map_err(failure)?;
        let place = say::place(&self.out);
        say::say(&format!(
            "{}\nreport.html, cases.csv and grains.csv are in {place}\n",
            result.table()
        ))?;
        match result.missing() {
            0 => Ok(()),
            missing => Err(self.lacks(missing, unmade)),
        }
    }

    /// True where `case` is there.
    pub(crate) fn has(&self, case: &Case) -> bool {
        erosion::is_made(&self.file, &self.beside, case, &self.out)
    }

    /// How far `case` is.
    pub(crate) fn stage(&self, case: &Case) -> &'static str {
        match erosion::stage(&self.file, &self.beside, case, &self.out) {
            Stage::Made => "there",
            Stage::Begun => "begun",
            Stage::None => "-",
        }
    }

    /// That `missing` cases are, and why the `unmade` are.
    pub(crate) fn lacks(&self, missing: usize, unmade: &[Unmade]) -> Failure {
        let why: String = unmade.iter().map(|unmade| format!("\n  {unmade}")).collect();
        let all = self.file.cases().len();
        Failure::Run(anyhow::anyhow!("{} missing{why}", say::of_cases(missing, all)))
    }
}
