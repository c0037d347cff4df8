//! Surfaces as the scene's file has them: of one that has copies, all together. Files are written
//! by entry, so that a hundred copies are no hundred files.

use crate::check::Checked;

/// A surface of the scene's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    /// Its name in the file.
    pub name: String,
    /// Indices of its copies, or its own [-]; at least one.
    pub members: Vec<usize>,
    /// True when it has copies.
    pub is_copied: bool,
}

/// The entries, by name.
pub(crate) fn entries(checked: &Checked) -> Vec<Entry> {
    let index = |name: &String| checked.scene.surfaces.keys().position(|key| key == name);
    let copied = checked.copied.iter().map(|(name, copies)| {
        let members = copies.iter().filter_map(index).collect();
        Entry { name: name.clone(), members, is_copied: true }
    });
    let mut entries: Vec<_> = copied.collect();
    let is_copy = |index: usize| entries.iter().any(|entry| entry.members.contains(&index));
    let own = checked.scene.surfaces.keys().enumerate().filter(|(index, _)| !is_copy(*index));
    let own: Vec<_> = own
        .map(|(index, name)| Entry { name: name.clone(), members: vec![index], is_copied: false })
        .collect();
    entries.extend(own);
    entries.sort_by(|a, b| a.name.cmp(&b.name));
    entries
}

/// Name of a surface's files among those of all `entries`, without their ends.
pub(crate) fn stem(entries: &[Entry], entry: &Entry) -> String {
    match entries.len() {
        1 => "surface".to_owned(),
        _ => format!("surface_{}", entry.name),
    }
}
