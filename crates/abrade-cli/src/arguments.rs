//! What the command line says.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

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
    /// Check a scene and say how large it is; nothing is run, nothing is written.
    Check(SceneArguments),
    /// Look over a clump file, or convert it.
    Clump(ClumpArguments),
    /// Print the JSON schema of a scene, or its field reference.
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

/// Arguments of `run`.
#[derive(Args)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Folder for the results [default: runs/<scene name>].
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Floating-point numbers of the engine.
    #[arg(long, value_enum, default_value_t = Precision::F64)]
    pub(crate) precision: Precision,
    /// Print the summary file's content, and nothing else.
    #[arg(long)]
    pub(crate) json: bool,
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
    /// Print the field reference in text: path, kind, unit, default, meaning.
    #[arg(long)]
    pub(crate) fields: bool,
}
