//! Files of cases. Each is called by the fingerprint of what its case was made of, so that a case is found again
//! wherever it stands in its study, and takes the place of no other one.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Folder of the cases below the results folder `out`.
pub(crate) fn folder(out: &Path) -> PathBuf {
    out.join("cases")
}

/// Number of cases in the results folder `out`, whole or begun, that have none of these `fingerprints`.
pub(crate) fn others(out: &Path, fingerprints: &BTreeSet<String>) -> usize {
    let entries = std::fs::read_dir(folder(out)).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let case = |name: String| {
        let (stem, end) = name.split_once('.')?;
        ["json", "jsonl", "begun.jsonl"].contains(&end).then(|| stem.to_owned())
    };
    let cases: BTreeSet<String> = names.filter_map(case).collect();
    cases.difference(fingerprints).count()
}
