//! Runs `abrade run` and reads its summary; reads tables.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

pub type Row = BTreeMap<String, String>;

/// The repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The summary of a shipped scene under the given changes.
pub fn run(scene: &str, sets: &[String]) -> Value {
    run_with(scene, sets, &[])
}

/// As [`run`], with more arguments.
pub fn run_with(scene: &str, sets: &[String], arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    run_into(folder.path(), scene, sets, arguments)
}

/// As [`run`], with the results in `folder`.
pub fn run_to(folder: &Path, scene: &str, sets: &[String]) -> Value {
    run_into(folder, scene, sets, &[])
}

fn run_into(folder: &Path, scene: &str, sets: &[String], arguments: &[&str]) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_abrade"));
    command.arg("run").arg(root().join("scenes").join(scene)).arg("--json");
    command.arg("--out").arg(folder).args(arguments);
    for set in sets {
        command.args(["--set", set]);
    }
    let output = command.output().expect("the command runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{scene} {sets:?}: {errors}");
    serde_json::from_slice(&output.stdout).expect("a summary")
}

/// Number at a dotted path of a summary.
pub fn at(summary: &Value, path: &str) -> f64 {
    let found = path.split('.').try_fold(summary, |value, key| match value {
        Value::Array(list) => list.get(key.parse::<usize>().ok()?),
        _ => value.get(key),
    });
    found.and_then(Value::as_f64).unwrap_or_else(|| panic!("no number at {path}"))
}

/// Three numbers at a path.
pub fn vector(summary: &Value, path: &str) -> [f64; 3] {
    std::array::from_fn(|i| at(summary, &format!("{path}.{i}")))
}

/// The numbers under `name` in a history.
pub fn column(history: &Path, name: &str) -> Vec<f64> {
    let mut reader = csv::Reader::from_path(history).expect("a history");
    let rows = reader.deserialize().map(|row| row.expect("a row"));
    rows.map(|row: Row| number(&row, name)).collect()
}

/// Rows of a reference table.
pub fn table(name: &str) -> Vec<Row> {
    let path = root().join(format!("tests/reference/{name}.csv"));
    let mut reader = csv::Reader::from_path(path).expect("a table");
    reader.deserialize().map(|row| row.expect("a row")).collect()
}

/// Number in a row.
pub fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} = {}", row[column]))
}

/// Root mean square.
pub fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// Collects the rows that miss, and fails with all of them.
#[derive(Default)]
pub struct Verdict(Vec<String>);

impl Verdict {
    /// Notes a row; `fine` says whether it holds.
    pub fn row(&mut self, fine: bool, line: String) {
        println!("{line}");
        if !fine {
            self.0.push(line);
        }
    }

    /// Fails unless every row held.
    pub fn close(self) {
        assert!(self.0.is_empty(), "\n{}", self.0.join("\n"));
    }
}
