//! What the command line says.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::failure::Failure;
use crate::output_folder;

/// Plastic wear of surfaces struck by rigid bodies.
#[derive(Parser)]
#[command(name = "abrade", version)]
pub(crate) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What to do.
#[derive(Subcommand)]
pub(crate) enum Command {
    /// Run a scene.
    Run(RunArguments),
    /// Check scenes, studies and maps and say how large they are; nothing is run, nothing is written.
    Check(CheckArguments),
    /// Make a study: many runs, compared.
    #[command(subcommand)]
    Study(StudyCommand),
    /// Make an erosion study in parts: some of its cases, anywhere, and merge them.
    Sweep(SweepArguments),
    /// Asperities that collide: one collision, or a map of regimes.
    #[command(subcommand)]
    Adhesive(AdhesiveCommand),
    /// Make a page that shows a finished run: worn surface, bodies, time, cross-section.
    View(ViewArguments),
    /// Look over a clump file, or convert it.
    Clump(ClumpArguments),
    /// List the closed-form laws of wear, or evaluate one.
    Laws(LawsArguments),
    /// Print the JSON schema of a scene or a study, or its field reference.
    Schema(SchemaArguments),
}

/// A scene and its changes.
#[derive(Args)]
pub(crate) struct SceneArguments {
    /// Scene file (RON).
    pub(crate) scene: PathBuf,
    /// Change a value of the scene, as in bodies.ball.motion.speed="30 m/s"; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) sets: Vec<String>,
}

/// Arguments of `check`.
#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Files of `run`, `study erosion`, `adhesive run` and `adhesive map` (RON). A scene alone is told in
    /// rows, each of several files in a line.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Change a value of every file, as in bodies.ball.motion.speed="30 m/s"; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) sets: Vec<String>,
}

/// Arguments of `run`.
#[derive(Args)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Folder for the results; a run that is there is replaced, files of anything else are refused
    /// [default: runs/<name of the file without .ron>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Floating-point numbers of the engine.
    #[arg(long, value_enum, default_value_t = Precision::F64)]
    pub(crate) precision: Precision,
    /// Print the summary file's content, and nothing else.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Arguments of `view`.
#[derive(Args)]
pub(crate) struct ViewArguments {
    /// Folder of the run, as `abrade run` names it.
    pub(crate) folder: PathBuf,
    /// File to write [default: view.html in the folder].
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
}

/// What a study asks.
#[derive(Subcommand)]
pub(crate) enum StudyCommand {
    /// How the error falls with the run time: runs the scene at ladders of accuracy, pitch, engine
    /// precision and step, resolver and stiffness, and compares each with the finest run.
    Convergence(ConvergenceArguments),
    /// How much grains of several forms wear a plate, by angle and speed: means with intervals, and
    /// ratios to a sphere. Goes on where it was broken off.
    Erosion(FileArguments),
}

/// The file of a study of erosion, its changes, and where its results go.
#[derive(Args)]
pub(crate) struct FileArguments {
    /// Study file (RON).
    pub(crate) study: PathBuf,
    /// Change a value of the study, as in samples.most=256 or density="2650 kg/m3"; may be
    /// repeated.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) sets: Vec<String>,
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
}

/// Where the cases of a study or a map go, and on how many threads they are made.
#[derive(Args)]
pub(crate) struct PlaceArguments {
    /// Folder for the results; cases that are there are kept, tables are replaced, folders of runs and files
    /// of anything else of the same names are refused [default: runs/<name of the file without .ron>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Threads [default: one per core].
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) jobs: Option<u16>,
}

impl PlaceArguments {
    /// Sets the threads; returns the folder for the results of the file at `path`.
    pub(crate) fn begin(&self, path: &Path) -> Result<PathBuf, Failure> {
        if let Some(jobs) = self.jobs {
            let pool =
                rayon::ThreadPoolBuilder::new().num_threads(usize::from(jobs)).build_global();
            pool.context("no threads").map_err(Failure::Run)?;
        }
        Ok(output_folder::chosen(self.out.as_deref(), path))
    }
}

/// Arguments of `sweep`: a study, and which part of it is made.
#[derive(Args)]
pub(crate) struct SweepArguments {
    #[command(flatten)]
    pub(crate) file: FileArguments,
    #[command(flatten)]
    pub(crate) part: PartArguments,
}

/// Which part of a study is made.
#[derive(Args)]
pub(crate) struct PartArguments {
    /// Make this case alone, by its number from 0; one that is there already is left as it is.
    #[arg(long, value_name = "K", group = "part")]
    pub(crate) case: Option<usize>,
    /// Make every Nth case, from case I on, with I from 0 to N - 1.
    #[arg(long, value_name = "I/N", group = "part", value_parser = shard)]
    pub(crate) shard: Option<[usize; 2]>,
    /// Write the tables of all cases in the results folder, and in these folders if any are given.
    #[arg(long, value_name = "DIR", num_args = 0.., group = "part")]
    pub(crate) merge: Option<Vec<PathBuf>>,
    /// List the cases, and say which are there.
    #[arg(long, group = "part")]
    pub(crate) list: bool,
}

impl PartArguments {
    /// Whether all cases are meant.
    pub(crate) fn is_whole(&self) -> bool {
        self.case.is_none() && self.shard.is_none()
    }

    /// Those of `cases` that are meant.
    pub(crate) fn choose<C>(
        &self,
        mut cases: Vec<C>,
        number: impl Fn(&C) -> usize,
    ) -> Result<Vec<C>, Failure> {
        if let Some(case) = self.case {
            if !cases.iter().any(|other| number(other) == case) {
                let all = cases.len();
                let error = anyhow::anyhow!("there is no case {case}: there are {all}, from 0");
                return Err(Failure::Input(error));
            }
            cases.retain(|other| number(other) == case);
        }
        if let Some([first, pace]) = self.shard {
            cases.retain(|case| number(case) % pace == first);
        }
        Ok(cases)
    }
}

fn shard(text: &str) -> Result<[usize; 2], String> {
    let parts = text.split_once('/').and_then(|(i, n)| Some([i.parse().ok()?, n.parse().ok()?]));
    parts.filter(|[i, n]| i < n).ok_or_else(|| "expected I/N with I from 0 to N - 1".to_owned())
}

/// What is made of asperities.
#[derive(Subcommand)]
pub(crate) enum AdhesiveCommand {
    /// Run a collision and say what became of the asperities.
    Run(AdhesiveRunArguments),
    /// Make a map: many collisions over ratios of strength and adhesion, and where grinding begins. Goes on
    /// where it was broken off.
    Map(MapArguments),
}

/// Arguments of `adhesive run`.
#[derive(Args)]
pub(crate) struct AdhesiveRunArguments {
    /// Scene file of two asperities (RON).
    pub(crate) scene: PathBuf,
    /// Change a value of the scene, as in bodies.overlap=0.3 or solid.adhesion="200 MPa"; may be
    /// repeated.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) sets: Vec<String>,
    /// Folder for the results; a run that is there is replaced, files of anything else are refused
    /// [default: runs/<name of the file without .ron>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print the summary file's content, and nothing else.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Arguments of `adhesive map`: a map, and which part of it is made.
#[derive(Args)]
pub(crate) struct MapArguments {
    /// Map file (RON).
    pub(crate) map: PathBuf,
    /// Change a value of the map, as in bodies.overlap=0.3 or gaps="[1.2, 1.5]"; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) sets: Vec<String>,
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
    #[command(flatten)]
    pub(crate) part: PartArguments,
}

/// Arguments of `study convergence`.
#[derive(Args)]
pub(crate) struct ConvergenceArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Folder for the results; a study that is there is replaced, files of anything else of the same names
    /// are refused [default: runs/<name of the file without .ron>_convergence].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// What to vary; may be repeated [default: everything].
    #[arg(long, value_enum, value_name = "WHAT")]
    pub(crate) vary: Vec<Vary>,
    /// Places in the cell of a plate's lattice that every setting starts from; errors are root mean
    /// squares over them.
    #[arg(long, value_name = "COUNT", default_value_t = 4,
          value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) landings: u32,
    /// Seconds after which no finer setting is begun; a run that takes longer is given up.
    #[arg(long, value_name = "SECONDS", default_value_t = 120.0,
          allow_negative_numbers = true, value_parser = above_zero)]
    pub(crate) budget: f64,
    /// Compare with this `summary.json`, or part of one, in the place of the finest run.
    #[arg(long, value_name = "FILE")]
    pub(crate) reference: Option<PathBuf>,
}

/// What a study of convergence varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Vary {
    /// The target of the time error.
    Accuracy,
    /// The distance of the nodes.
    Pitch,
    /// Pitch and accuracy together.
    Both,
    /// The target of the time error, with an engine in f32.
    Precision,
    /// The step of the engine and the resolver.
    Step,
    /// The stiffness of the surfaces, or Young's modulus where it follows from that.
    Stiffness,
}

/// A finite number above zero.
fn above_zero(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|x| x.is_finite() && *x > 0.0);
    number.ok_or_else(|| "expected a number above zero".to_owned())
}

/// Floating-point numbers of the engine; wear is always computed in f64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Precision {
    /// 32 bits.
    F32,
    /// 64 bits.
    F64,
}

impl From<Precision> for abrade_scene::Precision {
    fn from(precision: Precision) -> Self {
        match precision {
            Precision::F32 => Self::Single,
            Precision::F64 => Self::Double,
        }
    }
}

/// Arguments of `laws`.
#[derive(Args)]
#[command(args_conflicts_with_subcommands = true)]
pub(crate) struct LawsArguments {
    #[command(subcommand)]
    pub(crate) command: Option<LawsCommand>,
    /// Name of the law; without one, their names and titles are listed.
    pub(crate) name: Option<String>,
    /// Its conditions and constants, as in angle="30 deg"; bare numbers are in SI. One may be a list,
    /// as in angle="10 deg, 20 deg".
    #[arg(value_name = "NAME=VALUE")]
    pub(crate) given: Vec<String>,
    /// Tell formula, constants, status and source in the place of a value; without a name, of all
    /// laws.
    #[arg(long, conflicts_with = "csv")]
    pub(crate) list: bool,
    /// Print the value as a table with commas.
    #[arg(long)]
    pub(crate) csv: bool,
}

/// What is asked of laws beside a value.
#[derive(Subcommand)]
pub(crate) enum LawsCommand {
    /// Tabulate and draw a model of a contact: force and contact radius against displacement, coming
    /// together and parting, and what it takes to part.
    Contact(ContactArguments),
}

/// Arguments of `laws contact`.
#[derive(Args)]
pub(crate) struct ContactArguments {
    /// Name of the model; without one, all are listed.
    pub(crate) model: Option<String>,
    /// Its constants, as in radius="1 mm" modulus="1 GPa" adhesion="0.1 J/m2"; bare numbers are in SI. In
    /// the place of modulus: young and poisson, and in that of radius two radii, each of one side or of
    /// both, as in young="200 GPa, 70 GPa"; a side that is left out is a rigid flat. A list of
    /// displacement makes the rows of the table; distance, z0, tells which model holds.
    #[arg(value_name = "NAME=VALUE")]
    pub(crate) given: Vec<String>,
    /// The pull-off force of DMT, Maugis-Dugdale and JKR against Tabor's parameter, in the place of a
    /// model's curve.
    #[arg(long, conflicts_with_all = ["model", "given"])]
    pub(crate) limits: bool,
    /// Draw it into this file (PNG).
    #[arg(long, value_name = "FILE", value_parser = png)]
    pub(crate) out: Option<PathBuf>,
    /// Print the table alone, with commas.
    #[arg(long)]
    pub(crate) csv: bool,
}

/// A file that ends in `.png`.
fn png(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("expected a file that ends in .png".to_owned()) }
}

/// Arguments of `clump`.
#[derive(Args)]
pub(crate) struct ClumpArguments {
    /// Clump file, or the folder of an MClump clump.
    pub(crate) file: PathBuf,
    /// Density [kg/m3].
    #[arg(long, value_name = "DENSITY", allow_negative_numbers = true, default_value_t = 1000.0)]
    pub(crate) density: f64,
    /// Factor from the file's lengths to metres.
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, default_value_t = 1.0)]
    pub(crate) scale: f64,
    /// Write the clump in this format.
    #[arg(long, value_enum, value_name = "FORMAT", requires = "out")]
    pub(crate) convert: Option<ConvertFormat>,
    /// File to write.
    #[arg(long, value_name = "FILE", requires = "convert")]
    pub(crate) out: Option<PathBuf>,
}

/// Formats a clump can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ConvertFormat {
    /// Lines of x, y, z, radius.
    Xyzr,
    /// The same with commas and a header.
    Csv,
    /// Kratos cluster (.clu).
    Kratos,
    /// LAMMPS molecule.
    Lammps,
}

/// Arguments of `schema`.
#[derive(Args)]
pub(crate) struct SchemaArguments {
    /// Print the field reference in text: path, kind, unit, default, meaning; with a PREFIX, of the
    /// paths that begin with it, as in bodies.ball.motion.
    #[arg(long, value_name = "PREFIX")]
    pub(crate) fields: Option<Option<String>>,
    /// The form of an erosion study in the place of that of a scene.
    #[arg(long, group = "form")]
    pub(crate) study: bool,
    /// The form of a scene of two asperities.
    #[arg(long, group = "form")]
    pub(crate) adhesive: bool,
    /// The form of a map of their regimes.
    #[arg(long, group = "form")]
    pub(crate) map: bool,
}
