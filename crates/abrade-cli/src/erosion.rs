//! `abrade study erosion`.

use std::path::{Path, PathBuf};

use abrade_study::erosion::{self, Case, StudyFile};
use anyhow::Context;

use crate::arguments::ErosionArguments;
use crate::failure::Failure;
use crate::progress::Bar;
use crate::study::failure;
use crate::{interrupt, output_folder, say};

/// A study, and where its files and its results lie.
pub(crate) struct Opened {
    pub(crate) file: StudyFile,
    /// Folder of the study's file.
    pub(crate) beside: PathBuf,
    /// Folder of its results.
    pub(crate) out: PathBuf,
}

/// Makes all cases that are not there, writes the tables, says what came of it.
pub(crate) fn erosion(arguments: &ErosionArguments) -> Result<(), Failure> {
    let opened = open(arguments)?;
    opened.make(&opened.file.cases())?;
    opened.tell()
}

/// Reads and checks the study.
pub(crate) fn open(arguments: &ErosionArguments) -> Result<Opened, Failure> {
    let file = erosion::load(&arguments.study, &arguments.sets)?;
    let beside = arguments.study.parent().unwrap_or(Path::new("")).to_owned();
    let out = output_folder::chosen(arguments.out.as_deref(), &file.name);
    if let Some(jobs) = arguments.jobs {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(jobs)).build_global();
        pool.context("no threads").map_err(Failure::Run)?;
    }
    Ok(Opened { file, beside, out })
}

impl Opened {
    /// Makes those of `cases` that are not there.
    pub(crate) fn make(&self, cases: &[Case]) -> Result<(), Failure> {
        output_folder::make(&self.out)?;
        let stop = interrupt::flag();
        let mut bar = Bar::new(&stop);
        let made = erosion::make(&self.file, &self.beside, cases, &self.out, &mut bar);
        bar.clear();
        match made.map_err(failure)? {
            true => Ok(()),
            false => Err(Failure::Interrupted),
        }
    }

    /// Writes the tables of the cases that are there, and shows them.
    pub(crate) fn tell(&self) -> Result<(), Failure> {
        let result = erosion::result(&self.file, &self.beside, &self.out).map_err(failure)?;
        output_folder::make(&self.out)?;
        erosion::write(&result, &self.beside, &self.out).map_err(failure)?;
        let place = self.out.display();
        say::say(&format!(
            "{}\nreport.html, cases.csv and grains.csv are in {place}\n",
            result.table()
        ))?;
        match result.missing() {
            0 => Ok(()),
            missing => {
                let all = self.file.cases().len();
                let error = anyhow::anyhow!("{missing} of {all} cases are missing");
                Err(Failure::Run(error))
            }
        }
    }
}
