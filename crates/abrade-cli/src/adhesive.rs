//! `abrade adhesive`.

use std::fmt::Write as _;
use std::path::PathBuf;

use abrade_report::quantity_text::count;
use abrade_study::adhesive::{self, MapFile};

use crate::arguments::{AdhesiveRunArguments, MapArguments, PartArguments};
use crate::failure::{Failure, Rest};
use crate::progress::Bar;
use crate::study::failure;
use crate::{earlier, interrupt, kind, output_folder, say};

/// Runs a scene of two asperities and says what became of them.
pub(crate) fn run(arguments: &AdhesiveRunArguments) -> Result<(), Failure> {
    let file = kind::asperities(&arguments.scene, &arguments.sets)?;
    let folder = output_folder::chosen(arguments.out.as_deref(), &arguments.scene);
    earlier::make_way_for_run(&folder, &file.name, arguments.out.is_some())?;
    output_folder::make(&folder)?;
    let stop = interrupt::flag();
    file.notes().iter().for_each(|note| say::aside(&format!("note: {note}")));
    let mut bar = Bar::new(&stop);
    let ended = adhesive::run(&file, &folder, &mut bar);
    bar.clear();
    let ended = ended.map_err(failure)?;
    match arguments.json {
        true => say::say(&format!("{:#}\n", ended.summary.to_json()))?,
        false => {
            let (text, place) = (ended.summary.text(), say::place(&folder));
            say::say(&format!(
                "{text}elements.pvd, links.pvd, timeseries.csv, {} and summary.json are in {place}\n",
                adhesive::PICTURE
            ))?;
        }
    }
    match (ended.failure, ended.interrupted) {
        (Some(error), _) => Err(Failure::Run(error.into())),
        (None, true) => Err(Failure::Interrupted(Rest::Figures)),
        (None, false) => Ok(()),
    }
}

/// End of the file of a case.
const CASE: &str = ".json";
/// Files of a map beside those of its cases.
const TABLES: [&str; 4] = ["cases.csv", "points.csv", "boundary.csv", "map.png"];

/// A map, and where its results lie.
struct Opened {
    file: MapFile,
    out: PathBuf,
}

/// Makes a map, or the part of it that is asked for.
pub(crate) fn map(MapArguments { map, sets, place, part }: &MapArguments) -> Result<(), Failure> {
    let file = kind::map(map, sets)?;
    let out = place.begin(map)?;
    let opened = Opened { file, out };
    if part.list {
        return opened.list();
    }
    if let Some(folders) = &part.merge {
        earlier::make_way_for_cases(&opened.out, CASE, &TABLES)?;
        for folder in folders {
            adhesive::gather(&opened.file, folder, &opened.out).map_err(failure)?;
        }
        return opened.tell();
    }
    opened.file.notes().iter().for_each(|note| say::aside(&format!("note: {note}")));
    opened.make(part)?;
    match part.is_whole() {
        true => opened.tell(),
        false => opened.count(),
    }
}

impl Opened {
    fn make(&self, part: &PartArguments) -> Result<(), Failure> {
        let cases = part.choose(self.file.cases(), |case| case.number)?;
        earlier::make_way_for_cases(&self.out, CASE, &TABLES)?;
        output_folder::make(&self.out)?;
        earlier::tell_others(adhesive::others(&self.file, &self.out), &self.out);
        let stop = interrupt::flag();
        let mut bar = Bar::of_cases(&stop);
        let made = adhesive::make(&self.file, &cases, &self.out, &mut bar);
        bar.clear();
        made.map_err(failure)
    }

    fn list(&self) -> Result<(), Failure> {
        let mut text = String::new();
        for case in self.file.cases() {
            let _ = writeln!(
                text,
                "{:>5}  {:<5}  a {:<5} sigma_j {:>9.3e} Pa  sigma_0/sigma_j {:<6} gap {}",
                case.number,
                self.state(&case),
                case.strength_ratio,
                case.shear_strength,
                case.adhesion_ratio,
                case.gap
            );
        }
        say::say(&text)
    }

    fn count(&self) -> Result<(), Failure> {
        let cases = self.file.cases();
        let there = cases.iter().filter(|case| self.has(case)).count();
        let (all, place) = (cases.len(), say::place(&self.out));
        say::say(&format!("{} in {place}\n", say::of_cases(there, all)))
    }

    /// Whether `case` is there, in a word.
    fn state(&self, case: &adhesive::Case) -> &'static str {
        match self.has(case) {
            true if adhesive::ended_early(&self.file, case, &self.out) => "early",
            true => "there",
            false => "-",
        }
    }

    /// True where `case` is there.
    fn has(&self, case: &adhesive::Case) -> bool {
        adhesive::is_made(&self.file, case, &self.out)
    }

    /// Writes the files of the cases that are there, if any is, and shows them.
    fn tell(&self) -> Result<(), Failure> {
        let all = self.file.cases();
        if !all.iter().any(|case| self.has(case)) {
            return Err(self.lacks(all.len()));
        }
        let map = adhesive::result(&self.file, &self.out);
        output_folder::make(&self.out)?;
        adhesive::write(&map, &self.out).map_err(failure)?;
        let place = say::place(&self.out);
        say::say(&format!(
            "{}\ncases.csv, points.csv, boundary.csv and map.png are in {place}\n",
            map.table()
        ))?;
        match (map.missing(), map.fruitless()) {
            (0, 0) => Ok(()),
            (0, none) => Err(Failure::Run(anyhow::anyhow!(
                "no case of {none} of {} came to its end; a map that is made again tries them again",
                count(map.points.len(), "point", "points")
            ))),
            (missing, _) => Err(self.lacks(missing)),
        }
    }

    /// That `missing` cases are.
    fn lacks(&self, missing: usize) -> Failure {
        let all = self.file.cases().len();
        Failure::Run(anyhow::anyhow!("{} missing", say::of_cases(missing, all)))
    }
}
