//! A contact model walked along: together on one branch, apart on the other.

use super::{Before, Contact, ContactError, ContactModel};

/// The two branches over the same displacements.
#[derive(Clone, Debug, PartialEq)]
pub struct Branches {
    /// Displacements, from the least to the largest [m].
    pub displacements: Vec<f64>,
    /// The contact at each as the bodies come together, from apart.
    pub loading: Vec<Contact>,
    /// The contact at each as they are parted from the largest.
    pub unloading: Vec<Contact>,
}

/// Walks `model` up and down `displacements` [m].
///
/// # Errors
/// What the model refuses.
pub fn branches(
    model: &dyn ContactModel,
    mut displacements: Vec<f64>,
) -> Result<Branches, ContactError> {
    displacements.sort_by(f64::total_cmp);
    let walk = |ways: &mut dyn Iterator<Item = &f64>| {
        let mut before = Before::Apart;
        let step = |displacement: &f64| {
            let contact = model.at(*displacement, before)?;
            before = contact.after;
            Ok(contact)
        };
        ways.map(step).collect::<Result<Vec<Contact>, ContactError>>()
    };
    let loading = walk(&mut displacements.iter())?;
    let mut unloading = walk(&mut displacements.iter().rev())?;
    unloading.reverse();
    Ok(Branches { displacements, loading, unloading })
}
