//! Files that were right and are so no longer: scenes, clumps and meshes of which pieces are left
//! out, doubled, swapped or set to extremes. What can still be read is built. Nothing panics, and
//! nothing that is read gives a number that is none.
//!
//! `PROPTEST_CASES=20000 cargo test --release -p abrade-scene --test scene mutations` looks longer.

use std::path::{Path, PathBuf};

use abrade::{Ball, TriangleMesh, UnionInertia};
use abrade_scene::clump::{self, ClumpFile, Format, Given};
use abrade_scene::{Checked, load_text};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use super::SCENE;

/// Nodes and bodies up to which a scene that can still be read is built.
const NODES: f64 = 2e4;
const BODIES: usize = 200;

/// What stands in the place of a token.
const EXTREMES: [&str; 26] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "NaN",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "5e-324",
    "1e-160",
    "1e9",
    "4294967296",
    "18446744073709551616",
    "\"1 um\"",
    "\"1e12 GPa\"",
    "\"-5 deg\"",
    "\"\"",
    "()",
    "[]",
    "{}",
    "None",
    "Rigid",
    "true",
    "\"plate\"",
];

/// One change of a row of tokens.
#[derive(Clone, Debug)]
enum Change {
    Drop { at: usize, count: usize },
    Double { at: usize, count: usize },
    Swap { at: usize, with: usize },
    Set { at: usize, to: String },
}

fn change() -> impl Strategy<Value = Change> {
    let extreme = prop::sample::select(EXTREMES.as_slice()).prop_map(str::to_owned);
    let number = any::<f64>().prop_map(|x| format!("{x:e}"));
    let to = prop_oneof![2 => extreme, 1 => number];
    let (at, with) = (any::<usize>(), any::<usize>());
    prop_oneof![
        1 => (at, 1usize..6).prop_map(|(at, count)| Change::Drop { at, count }),
        1 => (at, 1usize..30).prop_map(|(at, count)| Change::Double { at, count }),
        1 => (at, with).prop_map(|(at, with)| Change::Swap { at, with }),
        5 => (at, to).prop_map(|(at, to)| Change::Set { at, to }),
    ]
}

/// Words, numbers and strings, each whole; everything else glyph by glyph.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let (mut in_string, mut in_word) = (false, false);
    for glyph in text.chars() {
        let is_word = glyph.is_alphanumeric() || "._-+".contains(glyph);
        match tokens.last_mut() {
            Some(last) if in_string || (in_word && is_word) => last.push(glyph),
            _ => tokens.push(glyph.to_string()),
        }
        in_word = !in_string && is_word;
        in_string ^= glyph == '"';
    }
    tokens
}

fn is_value(token: &str) -> bool {
    token.starts_with(|glyph: char| glyph.is_ascii_digit() || "\"-.".contains(glyph))
}

fn mutated(text: &str, changes: &[Change]) -> String {
    let mut tokens = tokens(text);
    for change in changes {
        let count = tokens.len().max(1);
        match change {
            _ if tokens.is_empty() => {}
            Change::Drop { at, count: n } => {
                let at = at % count;
                tokens.drain(at..(at + n).min(count));
            }
            Change::Double { at, count: n } => {
                let at = at % count;
                let twice = tokens[at..(at + n).min(count)].to_vec();
                tokens.splice(at..at, twice);
            }
            Change::Swap { at, with } => tokens.swap(at % count, with % count),
            Change::Set { at, to } => {
                let values: Vec<_> = (0..count).filter(|&i| is_value(&tokens[i])).collect();
                let at = values.get(at % values.len().max(1)).copied().unwrap_or(at % count);
                tokens[at].clone_from(to);
            }
        }
    }
    tokens.concat()
}

/// Builds what is small enough, and looks at it.
fn build(checked: &Checked) {
    let size = checked.size();
    let nodes: f64 = size.surfaces.values().map(|surface| surface.nodes).sum();
    if nodes > NODES || checked.scene.bodies.len() > BODIES {
        return;
    }
    let Ok(built) = checked.build() else { return };
    for body in built.bodies.values() {
        assert!(body.state.is_finite() && body.inertia.mass > 0.0, "{body:?}");
    }
}

fn load(text: &str, folder: &Path, sets: &[String]) {
    match load_text("scene.ron", text.to_owned(), folder.to_owned(), sets) {
        Ok(checked) => build(&checked),
        Err(error) => {
            assert!(!error.problems.is_empty());
            let _ = error.to_string();
        }
    }
}

fn scenes() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut folders = vec![root];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("scenes") {
            let path = entry.expect("an entry").path();
            match path.extension() {
                _ if path.is_dir() => folders.push(path),
                Some(extension) if extension == "ron" => found.push(path),
                _ => {}
            }
        }
    }
    found.sort();
    found
}

/// Two balls in the `format`, as this program writes them.
fn clump_text(format: Format) -> String {
    let ball = |x: f64, radius: f64| Ball { centre: Point3::new(x, 0.1, -0.2), radius };
    let spheres = vec![ball(0.0, 1.0), ball(1.3, 0.7), ball(-0.4, 0.9)];
    let union = UnionInertia::of_balls(&spheres).expect("a union");
    let path = PathBuf::from("clump.txt");
    let file = ClumpFile { path, format, spheres, given: Given::default() };
    clump::write(&file, format, 2500.0, &union)
}

/// A box as bytes of a file with the `ending`.
fn mesh_bytes(ending: &str) -> Vec<u8> {
    let mesh = TriangleMesh::cuboid(Vector3::new(1e-3, 2e-3, 1e-3), 1e-3).expect("a box");
    let corner = |id: u32| mesh.vertices()[id as usize];
    if ending == "obj" {
        let vertices = mesh.vertices().iter().map(|v| format!("v {} {} {}\n", v.x, v.y, v.z));
        let face = |[a, b, c]: &[u32; 3]| format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        let faces = mesh.triangles().iter().map(face);
        return vertices.chain(faces).collect::<String>().into_bytes();
    }
    let mut bytes = vec![0; 80];
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for triangle in mesh.triangles() {
        bytes.extend([0; 12]);
        for corner in triangle.map(corner) {
            bytes.extend(corner.iter().flat_map(|x| (*x as f32).to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// Damage to bytes: a place, and what stands there then.
fn damage() -> impl Strategy<Value = Vec<(usize, Vec<u8>)>> {
    let number = any::<f32>().prop_map(|x| x.to_le_bytes().to_vec());
    let few = prop::collection::vec(any::<u8>(), 0..3);
    let text = prop::sample::select(EXTREMES.as_slice()).prop_map(|text| text.as_bytes().to_vec());
    let bytes = prop_oneof![number, few, text];
    prop::collection::vec((any::<usize>(), bytes), 1..4)
}

/// Fewer than usual, unless the environment says how many: a scene takes a tenth of a second.
fn config() -> ProptestConfig {
    let config = ProptestConfig::default();
    match std::env::var_os("PROPTEST_CASES") {
        Some(_) => config,
        None => ProptestConfig { cases: 48, ..config },
    }
}

proptest! {
    #![proptest_config(config())]

    /// Fails for a scene that is let through and then cannot be built.
    #[test]
    fn scenes_with_pieces_changed(
        scene in prop::sample::select(scenes()),
        changes in prop::collection::vec(change(), 1..4),
    ) {
        let text = std::fs::read_to_string(&scene).expect("a scene");
        load(&mutated(&text, &changes), scene.parent().expect("a folder"), &[]);
    }

    /// Fails for a clump that is read with a radius or a mass that is no number.
    #[test]
    fn clumps_with_pieces_changed(
        format in prop::sample::select(vec![Format::Xyzr, Format::Csv, Format::Kratos, Format::Lammps]),
        changes in prop::collection::vec(change(), 1..4),
    ) {
        let text = mutated(&clump_text(format), &changes);
        let Ok(file) = clump::parse(Path::new("clump.txt"), &text) else { return Ok(()) };
        for ball in &file.spheres {
            prop_assert!(ball.radius > 0.0 && ball.radius.is_finite());
            prop_assert!(ball.centre.iter().all(|x| x.is_finite()));
        }
        if let Ok(report) = file.report() {
            prop_assert!(report.overlap_share().is_finite(), "{text}");
        }
    }

    /// Fails for a mesh that is read and then hangs or breaks on its way to a surface.
    #[test]
    fn meshes_with_bytes_changed(
        ending in prop::sample::select(vec!["stl", "obj"]),
        damage in damage(),
        cut in prop::option::weighted(0.1, any::<usize>()),
        pitch in prop::sample::select(vec!["1e-3", "5e-4", "1e-9", "1"]),
    ) {
        let mut bytes = mesh_bytes(ending);
        for (at, new) in &damage {
            let at = at % bytes.len();
            let end = (at + new.len().max(1)).min(bytes.len());
            bytes.splice(at..end, new.iter().copied());
        }
        bytes.truncate(cut.map_or(bytes.len(), |cut| cut % bytes.len()));
        let folder = std::env::temp_dir().join(format!("abrade-mutations-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join(format!("mesh.{ending}")), &bytes).expect("a file");
        let geometry = format!("surfaces.plate.geometry=Mesh(file: \"mesh.{ending}\", pitch: {pitch})");
        load(SCENE, &folder, &[geometry]);
    }
}
