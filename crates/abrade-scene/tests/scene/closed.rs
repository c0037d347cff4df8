//! Closed surfaces: from words and files to nodes, and bodies in their frames.

use std::path::PathBuf;

use abrade_scene::scene::{Geometry, MeshFormat, Output};
use abrade_scene::{Checked, SceneError, StandIn, load_text};
use nalgebra::{Point3, Vector3};

/// The corners (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1); the last facet is turned inside out.
const CORNER: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n";

const SCENE: &str = r#"(version: 1, name: "closed",
    materials: {"m": (hardness: "1 GPa", young: "120 GPa")},
    surfaces: {"s": (material: "m", geometry: GEOMETRY, position: ("1 m", 0, 0),
        rotation: AxisAngle(axis: (0.0, 0.0, 1.0), angle: "90 deg"))},
    bodies: {"b": (shape: Ball(radius: "1 mm"), density: 2500.0,
        position: InFrame(surface: "s", point: ("50 mm", 0, "2 mm")),
        motion: Free(velocity: ("-3 m/s", 0, 0)))})"#;

fn load(geometry: &str, folder: PathBuf, sets: &[&str]) -> Result<Checked, SceneError> {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    load_text("closed", SCENE.replace("GEOMETRY", geometry), folder, &sets)
}

fn checked(geometry: &str) -> Checked {
    load(geometry, PathBuf::new(), &[]).unwrap_or_else(|error| panic!("{geometry}: {error}"))
}

/// A folder of the test's own with `files` (name, bytes).
fn folder(test: &str, files: &[(&str, &[u8])]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("closed").join(test);
    std::fs::create_dir_all(&path).unwrap();
    for (name, bytes) in files {
        std::fs::write(path.join(name), bytes).unwrap();
    }
    path
}

/// Fails for a word that takes a diameter for a radius or a half for a whole.
#[test]
fn every_word_makes_the_solid_it_names() {
    let pi = std::f64::consts::PI;
    let cases = [
        (r#"Sphere(radius: "10 mm", pitch: "0.5 mm")"#, 4.0 / 3.0 * pi),
        (r#"Cylinder(radius: "10 mm", length: "30 mm", pitch: "0.5 mm")"#, 3.0 * pi),
        (r#"Tube(inner: "10 mm", outer: "20 mm", length: "30 mm", pitch: "0.5 mm")"#, 9.0 * pi),
        (
            r#"Bend(inner: "10 mm", outer: "20 mm", radius: "40 mm", angle: "90 deg",
                straight: "15 mm", pitch: "0.5 mm")"#,
            3.0 * pi * (2.0 * pi + 3.0),
        ),
        (r#"Capsule(radius: "10 mm", length: "30 mm", pitch: "0.5 mm")"#, (3.0 + 4.0 / 3.0) * pi),
        (r#"Cuboid(half_extents: ("5 mm", "10 mm", 0.02), pitch: "1 mm")"#, 8.0),
    ];
    for (text, volume) in cases {
        let checked = checked(text);
        let built = checked.build().unwrap();
        let surface = &built.surfaces["s"].surface;
        let mesh = &checked.meshes["s"];
        assert!((mesh.volume() / (volume * 1e-6) - 1.0).abs() < 5e-3, "{text}: {}", mesh.volume());
        assert_eq!(surface.nodes().rest_position, mesh.vertices());
        let size = checked.size().surfaces["s"];
        assert_eq!((size.nodes, size.columns_rows), (mesh.vertices().len() as f64, None));
        assert!((size.pitch / mesh.pitch() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn convex_solids_stand_in_for_themselves() {
    let stand_in = |text: &str| checked(text).build().unwrap().surfaces["s"].stand_in;
    let ball = stand_in(r#"Sphere(radius: "10 mm", pitch: "2 mm")"#);
    assert_eq!(ball, StandIn::Ball { radius: 10.0 * 1e-3 });
    let capsule = stand_in(r#"Capsule(radius: "10 mm", length: 0.5, pitch: "2 mm")"#);
    assert_eq!(capsule, StandIn::Capsule { radius: 10.0 * 1e-3, half_length: 0.25 });
    let tube = r#"Tube(inner: "10 mm", outer: "20 mm", length: "30 mm", pitch: "2 mm")"#;
    assert_eq!(stand_in(tube), StandIn::Facets);
}

/// Fails for a body placed in world axes, or lifted onto a top that a solid has not.
#[test]
fn a_body_lies_where_the_frame_of_the_surface_says() {
    let built = checked(r#"Sphere(radius: "10 mm", pitch: "2 mm")"#).build().unwrap();
    let state = built.bodies["b"].state;
    assert!((state.position - Point3::new(1.0, 0.05, 0.002)).norm() < 1e-12);
    assert!((state.velocity - Vector3::new(0.0, -3.0, 0.0)).norm() < 1e-12);
    let inside = ["bodies.b.position.point=(\"10.5 mm\", 0, 0)"];
    let sphere = r#"Sphere(radius: "10 mm", pitch: "0.5 mm")"#;
    let refusal = load(sphere, PathBuf::new(), &inside).unwrap_err().to_string();
    assert!(refusal.contains("inside the surface `s`; must lie outside of its solid"), "{refusal}");
}

/// Fails for a reader that keeps what it mended to itself, forgets the scale, or takes a corner of
/// another facet for another corner.
#[test]
fn a_mesh_file_is_mended_scaled_and_resampled() {
    let folder = folder("mended", &[("corner.obj", CORNER.as_bytes())]);
    let file = r#"Mesh(file: "corner.obj", scale: 0.001)"#;
    let as_it_is = load(file, folder.clone(), &[]).unwrap();
    let notes = ["surface `s`: the mesh `corner.obj`: 1 facet was turned"];
    assert_eq!(as_it_is.notes, notes);
    assert_eq!(as_it_is.meshes["s"].vertices().len(), 4);
    let finer = load(file, folder, &["surfaces.s.geometry.pitch=0.1 mm"]).unwrap();
    for checked in [&as_it_is, &finer] {
        assert!((checked.meshes["s"].volume() * 6e9 - 1.0).abs() < 1e-9);
    }
    let pitch = finer.size().surfaces["s"].pitch;
    assert!((pitch / 1e-4 - 1.0).abs() < 0.3, "{pitch}");
}

/// Fails for rows taken for columns, or heights in another unit than the file's.
#[test]
fn a_ground_is_made_of_the_rows_of_its_file() {
    let folder = folder("ground", &[("dunes.csv", b"# two rows along x\n1, 1, 2\n1, 1, 2\n")]);
    let field = r#"HeightField(file: "dunes.csv", spacing: ("10 mm", "5 mm"), base: "-1 mm",
        scale: 0.001)"#;
    let checked = load(field, folder, &[]).unwrap();
    let mesh = &checked.meshes["s"];
    assert_eq!(mesh.bounds()[1], Point3::new(20.0 * 1e-3, 5.0 * 1e-3, 2e-3));
    assert!((mesh.volume() / (5e-3 * (10e-3 * 2e-3 + 10e-3 * 2.5e-3)) - 1.0).abs() < 1e-9);
}

/// Fails for a map in another unit than the file's, one that is laid in the world's frame, and for
/// regions that it overrides.
#[test]
fn a_map_gives_a_solid_its_hardness() {
    let map = "# mm, mm, mm, Pa\n30, 0, 0, 3e9\n-30, 0, 0, 2e9\n";
    let folder = folder("mapped", &[("weld.csv", map.as_bytes())]);
    let block = r#"Cuboid(half_extents: (0.02, 0.01, 0.01), pitch: "2 mm")"#;
    let sets = [
        r#"surfaces.s.hardness_map=(file: "weld.csv", scale: 0.001)"#,
        "surfaces.s.regions=[(hardness: 5e9, box: (from: (-1, -1, 0.01), to: (1, 1, 1)))]",
    ];
    let built = load(block, folder, &sets).unwrap().build().unwrap();
    let surface = &built.surfaces["s"].surface;
    for (i, at) in surface.nodes().rest_position.iter().enumerate() {
        let by_map = if at.x < 0.0 { 2e9 } else { 3e9 };
        assert_eq!(surface.hardness(i), if at.z >= 0.01 { 5e9 } else { by_map }, "{at}");
    }
}

/// The hull of a body may come from the same files as a surface.
#[test]
fn the_hull_of_a_mesh_file_has_its_volume() {
    let folder = folder("hull", &[("corner.obj", CORNER.as_bytes())]);
    let sets = [
        "bodies.b.shape=ConvexHull(file: \"corner.obj\", scale: 0.01)",
        "bodies.b.position.point=(\"1 m\", 0, 0)",
    ];
    let sphere = r#"Sphere(radius: "10 mm", pitch: "2 mm")"#;
    let mass = load(sphere, folder, &sets).unwrap().solids["b"].inertia.mass;
    assert!((mass / (2500.0 * 1e-6 / 6.0) - 1.0).abs() < 1e-9, "{mass}");
}

#[test]
fn flat_words_do_not_go_with_solids() {
    let sphere = r#"Sphere(radius: "10 mm", pitch: "2 mm")"#;
    for (set, message) in [
        ("bodies.b.position=OnSurface(surface: \"s\")", "cannot lie on the surface `s`"),
        ("bodies.b.motion=Drive(indent_to: 5)", "cannot be driven over the surface `s`"),
    ] {
        let error = load(sphere, PathBuf::new(), &[set]).unwrap_err();
        assert_eq!(error.problems.len(), 1, "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn mesh_files_are_outputs() {
    let sphere = r#"Sphere(radius: "10 mm", pitch: "2 mm")"#;
    let set = ["outputs=[Mesh(format: Stl), Mesh(format: Obj)]"];
    let scene = load(sphere, PathBuf::new(), &set).unwrap().scene;
    let formats = [MeshFormat::Stl, MeshFormat::Obj].map(|format| Output::Mesh { format });
    assert_eq!(scene.outputs, formats);
    assert!(matches!(scene.surfaces["s"].geometry, Geometry::Sphere { .. }));
}
