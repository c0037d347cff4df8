//! Values that no solid has. Most are numbers without their unit: they are noted, and taken as they stand.

use abrade::Material;
use abrade_report::quantity_text::{digits, length};

use crate::check::Checked;
use crate::place;
use crate::scene::{Motion, SurfaceMotion};
use crate::spans::path;

/// Size of a body over that of the largest surface above which a unit was probably forgotten [-].
const LARGE: f64 = 10.0;

/// Speed of the fastest meteoroids [m/s].
const FASTEST: f64 = 8e4;

/// What solids have of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usual {
    unit: &'static str,
    from: f64,
    to: f64,
}

impl Usual {
    /// Hardness, from gels to above diamond [Pa].
    pub const HARDNESS: Self = Self { unit: "Pa", from: 1e4, to: 2e11 };
    /// Young's modulus, from soft rubber to above diamond, which has 1.2e12 [Pa].
    pub const YOUNG: Self = Self { unit: "Pa", from: 1e6, to: 2e12 };
    /// Density, from foams to above osmium, which has 22 600 [kg/m3].
    pub const DENSITY: Self = Self { unit: "kg/m3", from: 10.0, to: 3e4 };
    /// Diameter of grains, up to boulders [m].
    pub const GRAIN: Self = Self { unit: "m", from: 0.0, to: 10.0 };

    /// What to say of a `value` of the field at the path of these `names` that no solid has.
    pub fn note(&self, names: &[&str], value: f64) -> Option<String> {
        let Self { unit, from, to } = self;
        let than = match value {
            value if value < *from => "less",
            value if value > *to => "more",
            _ => return None,
        };
        let (field, value) = (path(names), digits(value));
        Some(format!(
            "`{field}` is {value} {unit}, {than} than any solid has: a bare number is in {unit}"
        ))
    }
}

/// What to say of the `material` at the path of these `names`.
pub fn material_notes<'a>(
    names: &'a [&'a str],
    material: &'a Material,
) -> impl Iterator<Item = String> + 'a {
    let fields = [
        ("hardness", Some(material.hardness), Usual::HARDNESS),
        ("young", material.young, Usual::YOUNG),
    ];
    fields
        .into_iter()
        .filter_map(move |(field, value, usual)| usual.note(&[names, &[field]].concat(), value?))
}

/// What to say of the values of a scene.
pub(crate) fn notes(checked: &Checked) -> Vec<String> {
    let scene = &checked.scene;
    let mut notes = Vec::new();
    for (name, material) in &scene.materials {
        notes.extend(material_notes(&["materials", name], material));
    }
    let mut density = |names: &[&str], density| {
        notes.extend(Usual::DENSITY.note(&[names, &["density"]].concat(), density));
    };
    for (name, surface) in &scene.surfaces {
        surface.density.into_iter().for_each(|rho| density(&["surfaces", name], rho));
        if let SurfaceMotion::Free { density: rho, .. } = surface.motion {
            density(&["surfaces", name, "motion"], rho);
        }
    }
    // That of a single body is how a scene gives it any mass.
    for (name, stream) in &scene.streams {
        stream.density.into_iter().for_each(|rho| density(&["streams", name], rho));
    }
    notes.extend(fast_bodies(checked));
    notes.extend(large_bodies(checked));
    notes
}

/// Bodies that are faster than any projectile.
fn fast_bodies(checked: &Checked) -> impl Iterator<Item = String> {
    let scene = &checked.scene;
    let bodies = scene.bodies.iter().filter(|(name, _)| !checked.is_streamed(name));
    let bodies = bodies.map(|(name, body)| (path(&["bodies", name, "motion"]), &body.motion));
    let streams = scene.streams.iter();
    let streams =
        streams.map(|(name, stream)| (path(&["streams", name, "motion"]), &stream.motion));
    bodies.chain(streams).filter_map(|(name, motion)| {
        let speed = place::velocity(motion).0.norm();
        (speed > FASTEST).then(|| {
            let speed = digits(speed);
            format!(
                "`{name}` is of {speed} m/s, faster than any projectile: a bare number is in m/s"
            )
        })
    })
}

/// Bodies that are much larger than all surfaces.
fn large_bodies(checked: &Checked) -> Vec<String> {
    let scene = &checked.scene;
    let strips = scene.surfaces.values().filter_map(|surface| place::strip(&surface.geometry));
    let solids = checked.meshes.values().map(|mesh| {
        let [low, high] = mesh.bounds();
        (high - low).norm()
    });
    let largest =
        strips.map(|strip| strip.length.max(strip.width)).chain(solids).fold(0.0, f64::max);
    let across = |name: &String| {
        let moves = scene.bodies.get(name).is_some_and(|body| body.motion != Motion::Fixed);
        let solid = checked.solids.get(name).filter(|_| moves);
        solid.map_or(0.0, |solid| 2.0 * solid.shape.bounding_radius())
    };
    let bodies = scene.bodies.keys().filter(|name| !checked.is_streamed(name));
    let bodies = bodies.map(|name| (path(&["bodies", name]), across(name)));
    let streams = checked.streamed.iter().map(|(name, names)| {
        (path(&["streams", name]), names.iter().map(across).fold(0.0, f64::max))
    });
    bodies
        .chain(streams)
        .filter(|(_, across)| *across > LARGE * largest && largest > 0.0)
        .map(|(name, across)| {
            let (across, largest) = (length(across), length(largest));
            format!(
                "`{name}` is {across} across, the largest surface {largest}: a bare number is in m"
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for a number without its unit that is taken for a value, and for a note about soft rubber, diamond,
    /// foam or gold.
    #[test]
    fn what_no_solid_has_is_noted_and_what_some_have_is_not() {
        let note = |usual: Usual, value| usual.note(&["materials", "a.b", "young"], value);
        let text =
            "`materials.\"a.b\".young` is 200 Pa, less than any solid has: a bare number is in Pa";
        assert_eq!(note(Usual::YOUNG, 200.0).as_deref(), Some(text));
        for (usual, value) in [
            (Usual::YOUNG, 2e6),
            (Usual::YOUNG, 1.2e12),
            (Usual::HARDNESS, 1e5),
            (Usual::HARDNESS, 1e11),
            (Usual::DENSITY, 20.0),
            (Usual::DENSITY, 19_300.0),
        ] {
            assert_eq!(note(usual, value), None);
        }
        for (usual, value) in [
            (Usual::YOUNG, 200e12),
            (Usual::HARDNESS, 7.0),
            (Usual::HARDNESS, 1.7e12),
            (Usual::DENSITY, 2.5),
            (Usual::DENSITY, 2.5e6),
            (Usual::GRAIN, 200.0),
        ] {
            assert!(note(usual, value).is_some(), "{value}");
        }
    }
}
