//! Copies of a surface: where they lie, what is said of them, and which files they leave.

use std::path::PathBuf;

use abrade_scene::scene::Rotation;
use abrade_scene::{Checked, Precision, Progress, RunOptions, load_text, run};

/// Six boxes over a floor, of which the upper ones fall on the lower ones.
const SCENE: &str = r#"(version: 1, name: "copies", gravity: (0, 0, -9.81),
    materials: {"m": (hardness: "1 MPa", young: "100 MPa", friction: 0.2)},
    surfaces: {"s": (material: "m",
        geometry: Cuboid(half_extents: ("5 mm", "5 mm", "5 mm"), pitch: "2 mm"),
        motion: Free(density: 2000, velocity: (0, 0, -1)),
        regions: [(hardness: "2 MPa", box: (from: (-1, -1, 0), to: (1, 1, 1)))],
        position: (0.1, -0.3, 0.0091), rotation: ROTATION,
        copies: Grid(counts: (3, 1, 2), spacing: (0.07, 0, 0.03)))},
    bodies: {"floor": (shape: Cuboid(size: (1, 1, 0.1)), position: At(point: (0.1, -0.3, -0.05)),
        motion: Fixed)},
    run: (stop: Time(limit: "5 ms"), step: "1 ms"),
    outputs: [Picture, Mesh(format: Obj), Surface(at: End), History(every: "1 ms")])"#;

fn checked(rotation: &str) -> Checked {
    let text = SCENE.replace("ROTATION", rotation);
    let checked = load_text("copies", text, PathBuf::new(), &[]);
    checked.unwrap_or_else(|error| panic!("{error}"))
}

struct Quiet;

impl Progress for Quiet {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        true
    }
}

/// Fails for an order of the numbers that runs along z first, for places that are summed step by step
/// (which rounds otherwise: 0.1 + 0.07 + 0.07), and for copies that are less than the first.
#[test]
fn copies_lie_on_a_grid_to_the_bit() {
    let checked = checked("Random(seed: 7)");
    assert_eq!(checked.copied["s"], ["s_1", "s_2", "s_3", "s_4", "s_5", "s_6"]);
    assert_eq!(checked.scene.surfaces.len(), 6);
    for (number, name) in checked.copied["s"].iter().enumerate() {
        let (along, up) = (number % 3, number / 3);
        let copy = &checked.scene.surfaces[name];
        let place = [0.1 + 0.07 * along as f64, -0.3, 0.0091 + 0.03 * up as f64];
        assert_eq!(copy.position.map(f64::to_bits), place.map(f64::to_bits), "{name}");
        assert_eq!(copy.rotation, Rotation::Random { seed: 7 + number as u64 });
        assert!(copy.copies.is_none() && checked.hardness.contains_key(name));
    }
    assert_eq!(checked.size().surfaces.len(), 6);
}

/// Fails for a picture, a mesh or a series of files per copy, for history columns of each, and for a
/// file that shows the first one alone.
#[test]
fn copies_share_their_files_and_wear_each_on_its_own() {
    let checked = checked("AxisAngle(axis: (1, 2, 0), angle: \"20 deg\")");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("copies");
    std::fs::remove_dir_all(&folder).ok();
    let options = RunOptions { folder: folder.clone(), precision: Precision::Double };
    let outcome = run(&checked, &options, &mut Quiet).expect("a run");
    assert!(outcome.failure.is_none(), "{:?}", outcome.failure);
    let files = std::fs::read_dir(&folder).expect("a folder");
    let mut files: Vec<_> =
        files.map(|file| file.expect("a file").file_name().into_string().expect("text")).collect();
    files.sort();
    let expected = [
        ".abrade-run",
        "history.csv",
        "summary.json",
        "surface.obj",
        "surface.png",
        "surface.pvd",
        "surface_0000.vtp",
    ];
    assert_eq!(files, expected);
    let vtp = std::fs::read(folder.join("surface_0000.vtp")).expect("a file");
    let nodes = outcome.summary.surfaces["s_1"].nodes;
    let head = String::from_utf8_lossy(&vtp[..400]).into_owned();
    assert!(head.contains(&format!("NumberOfPoints=\"{}\"", 6 * nodes)), "{head}");

    let history = std::fs::read_to_string(folder.join("history.csv")).expect("a history");
    let names = history.lines().next().expect("a header");
    let of_copies = names.split(',').filter(|name| name.starts_with("s_"));
    assert_eq!(of_copies.collect::<Vec<_>>(), ["s_wear_volume_m3", "s_max_depth_m"]);
    let worn = |name: &str| outcome.summary.surfaces[name].wear_volume;
    // The lower ones have struck the floor, within 5 ms; the upper ones are still falling.
    let lower = ["s_1", "s_2", "s_3"].map(worn);
    assert!(lower.iter().all(|worn| *worn > 0.0), "{lower:?}");
    assert_eq!(["s_4", "s_5", "s_6"].map(worn), [0.0; 3]);
}
