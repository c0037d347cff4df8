//! Results from elsewhere: a `summary.json`, whole or with some of its values alone. Its wear volumes
//! are summed up, as those of a run are; its bodies are found by their names.

use std::path::Path;

use serde_json::Value;

use crate::convergence::quantities::{BodyQuantities, Quantities, norm};
use crate::error::StudyError;

/// Reads the file; also gives its name in words.
pub(crate) fn read(path: &Path) -> Result<(Quantities, String), StudyError> {
    let fault = |reason: String| StudyError::Reference { path: path.to_owned(), reason };
    let text =
        std::fs::read_to_string(path).map_err(|error| fault(abrade_scene::unread(path, &error)))?;
    let value: Value = serde_json::from_str(&text).map_err(|error| fault(error.to_string()))?;
    let quantities = quantities(&value);
    if quantities == Quantities::default() {
        let expected = "it holds no `surfaces.<name>.wear_volume_m3`, nor another value of a \
                        `summary.json` that runs are compared by";
        return Err(fault(expected.to_owned()));
    }
    Ok((quantities, path.display().to_string()))
}

fn quantities(value: &Value) -> Quantities {
    let surfaces = || named(value, "surfaces").map(|(_, surface)| surface);
    let number = |of: &Value, key: &str| of.get(key).and_then(Value::as_f64);
    let largest = |key: &str| surfaces().filter_map(|s| number(s, key)).fold(0.0, f64::max);
    let vector = |of: &Value, key: &str| -> Option<[f64; 3]> {
        let entries = of.get(key)?;
        let [x, y, z] = [0, 1, 2].map(|i| entries.get(i).and_then(Value::as_f64));
        Some([x?, y?, z?])
    };
    let body = |(name, body): (&String, &Value)| {
        let velocity = vector(body, "velocity_m_s").unwrap_or_default();
        let quantities = BodyQuantities {
            restitution: number(body, "restitution"),
            angle: number(body, "rebound_angle_deg"),
            spin: vector(body, "spin_rad_s"),
            speed: norm(velocity),
            reach: 0.0,
        };
        (name.clone(), quantities)
    };
    Quantities {
        wear: surfaces().filter_map(|s| number(s, "wear_volume_m3")).sum(),
        depth: largest("max_depth_m"),
        force: largest("peak_normal_force_N"),
        rate: surfaces().find_map(|s| number(s, "wear_rate_m2")),
        bodies: named(value, "bodies").map(body).collect(),
    }
}

/// The entries of a map.
fn named<'a>(value: &'a Value, key: &str) -> impl Iterator<Item = (&'a String, &'a Value)> {
    value.get(key).and_then(Value::as_object).into_iter().flatten()
}
