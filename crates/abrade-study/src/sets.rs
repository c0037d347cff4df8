//! Changes of a scene, in the words of `--set`, so that every run of a study can be made again by
//! hand.

use abrade::ElasticLaw;
use abrade_scene::scene::{Geometry, Placement, SceneSurface};
use abrade_scene::{Checked, path};

/// The surfaces as the scene writes them: of copies the one that is copied.
pub(crate) fn written_surfaces(checked: &Checked) -> Vec<(String, &SceneSurface)> {
    let copy_of = |name: &String| {
        checked.copied.iter().find(|(_, copies)| copies.contains(name)).map(|(of, _)| of.clone())
    };
    let mut surfaces: Vec<(String, &SceneSurface)> = Vec::new();
    for (name, surface) in &checked.scene.surfaces {
        let name = copy_of(name).unwrap_or_else(|| name.clone());
        if surfaces.last().is_none_or(|(last, _)| *last != name) {
            surfaces.push((name, surface));
        }
    }
    surfaces
}

/// `PATH=VALUE` of a number, to five digits.
pub(crate) fn number(path: &str, value: f64) -> String {
    let rounded = format!("{value:.4e}").parse().unwrap_or(value);
    format!("{path}={rounded:e}")
}

/// Makes the nodes of every surface `factor` times as far apart. Empty where no surface has a pitch
/// to be chosen.
pub(crate) fn pitch(checked: &Checked, factor: f64) -> Vec<String> {
    let mut sets = Vec::new();
    for (name, surface) in written_surfaces(checked) {
        let path = path(&["surfaces", &name, "geometry"]);
        let mut scale = |pitch: f64| sets.push(number(&format!("{path}.pitch"), pitch * factor));
        match &surface.geometry {
            Geometry::HexStrip { pitch: Some(pitch), rest_area, .. } => {
                scale(*pitch);
                if let Some(area) = rest_area {
                    sets.push(number(&format!("{path}.rest_area"), area * factor * factor));
                }
            }
            Geometry::HexStrip { nodes: Some(nodes), rest_area, .. } => {
                let nodes = (f64::from(*nodes) / (factor * factor)).round().max(1.0);
                sets.push(format!("{path}.nodes={nodes}"));
                if let Some(area) = rest_area {
                    sets.push(number(&format!("{path}.rest_area"), area * factor * factor));
                }
            }
            Geometry::Sphere { pitch, .. }
            | Geometry::Cylinder { pitch, .. }
            | Geometry::Tube { pitch, .. }
            | Geometry::Bend { pitch, .. }
            | Geometry::Capsule { pitch, .. }
            | Geometry::Cuboid { pitch, .. }
            | Geometry::Mesh { pitch: Some(pitch), .. } => scale(*pitch),
            // The nodes are those of the file.
            Geometry::HexStrip { .. } | Geometry::Mesh { .. } | Geometry::HeightField { .. } => {}
        }
    }
    sets
}

/// Makes the surfaces whose stiffness the scene gives `factor` times as stiff.
pub(crate) fn stiffness(checked: &Checked, factor: f64) -> Vec<String> {
    let mut sets = Vec::new();
    for (name, surface) in written_surfaces(checked) {
        if let ElasticLaw::Foundation { stiffness: Some(stiffness) } = surface.elastic {
            let path = path(&["surfaces", &name, "elastic", "stiffness"]);
            sets.push(number(&path, stiffness * factor));
        }
    }
    sets
}

/// Makes Young's modulus `factor` times as large where the stiffness of a surface follows from it.
pub(crate) fn young(checked: &Checked, factor: f64) -> Vec<String> {
    let follows = |surface: &SceneSurface| match surface.elastic {
        ElasticLaw::Foundation { stiffness } => stiffness.is_none(),
        ElasticLaw::HertzNodes { .. } => true,
        ElasticLaw::Rigid => false,
    };
    let surfaces = || checked.scene.surfaces.values();
    let mut sets = Vec::new();
    for (name, material) in &checked.scene.materials {
        let counts = surfaces().any(|surface| surface.material == *name && follows(surface));
        if let Some(young) = material.young.filter(|_| counts) {
            sets.push(number(&path(&["materials", name, "young"]), young * factor));
        }
    }
    sets
}

/// Shares of a cell of the lattice, along and across, of a low-discrepancy sequence (M. Roberts,
/// 2018) whose first place is that of the scene.
fn place_in_cell(landing: u32) -> [f64; 2] {
    let golden = 1.324_717_957_244_746_f64;
    [1.0 / golden, 1.0 / (golden * golden)].map(|step| (step * f64::from(landing)).fract())
}

/// True where all bodies are placed on one plate, which is alike everywhere.
fn is_alike_everywhere(checked: &Checked) -> bool {
    let mut plates: Vec<&String> = Vec::new();
    for body in checked.scene.bodies.values() {
        let Placement::OnSurface { surface, .. } = &body.position else { return false };
        plates.push(surface);
    }
    plates.dedup();
    let [plate] = plates[..] else { return false };
    let surface = checked.scene.surfaces.get(plate);
    checked.streamed.is_empty()
        && surface.is_some_and(|s| s.hardness_map.is_none() && s.regions.is_empty())
}

/// Lets every body that is placed on a plate start elsewhere in the lattice's cell, without
/// changing anything that a plate without nodes would see; empty where that cannot be, and for the
/// landing 0, which is the scene's own.
pub(crate) fn landing(checked: &Checked, landing: u32) -> Vec<String> {
    if landing == 0 || !is_alike_everywhere(checked) {
        return Vec::new();
    }
    let size = checked.size();
    let [along, across] = place_in_cell(landing);
    let mut sets = Vec::new();
    for (name, body) in &checked.scene.bodies {
        let Placement::OnSurface { surface, at, .. } = &body.position else { continue };
        let Some(pitch) = size.surfaces.get(surface).map(|size| size.pitch) else { continue };
        // Two columns of nodes make a cell.
        let x = at[0] + along * pitch * 3f64.sqrt();
        let y = at[1] + across * pitch;
        let at = path(&["bodies", name, "position", "at"]);
        sets.push(format!("{at}=({x:e}, {y:e})"));
    }
    sets
}

/// The changes as arguments of the command line, each quoted for the shell.
pub(crate) fn told(sets: &[String]) -> String {
    let quoted = |set: &String| format!("--set '{}'", set.replace('\'', r"'\''"));
    sets.iter().map(quoted).collect::<Vec<_>>().join(" ")
}
