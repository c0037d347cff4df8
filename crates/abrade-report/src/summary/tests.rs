//! The keys that outsiders read, and what they hold.

use nalgebra::{Point3, Vector3};

use super::*;

/// A summary with every map filled.
fn sample() -> Summary {
    Summary {
        scene: "a \"ball\"".into(),
        abrade: "0.1.0".into(),
        complete: true,
        precision: "f64".into(),
        resolver: ResolverCounts { micro: 12, ..Default::default() },
        resolver_reasons: BTreeMap::new(),
        wall: 0.25,
        setup: 0.01,
        simulated: 1.2e-5,
        steps: 60,
        node_evaluations: 5012,
        surfaces: BTreeMap::from([("plate".into(), SurfaceSummary::default())]),
        bodies: BTreeMap::from([("ball".into(), BodySummary::of(&State::at(Point3::origin())))]),
        energy: Some(EnergySummary::default()),
        erosion: None,
        error_estimate: ErrorEstimate::default(),
        warnings: Vec::new(),
        stop: None,
        laws: Some(LawsSummary {
            predicted: BTreeMap::from([("dnv".into(), 1e-12)]),
            ..LawsSummary::default()
        }),
    }
}

/// Every `"key":` of `text`, in order.
fn keys(text: &str) -> Vec<&str> {
    let lines = text.lines().filter_map(|line| line.trim().strip_prefix('"'));
    lines.filter_map(|line| line.split_once("\":")).map(|(key, _)| key).collect()
}

/// A program that renamed a field, dropped an absent value or sorted the keys would break every
/// script that reads the file; the list is typed from the interface page, not from the structs.
#[test]
fn the_keys_are_those_of_the_interface_in_its_order() {
    let text = sample().to_json().expect("writable");
    let expected = "scene abrade complete precision resolver micro quasi_static lockstep \
        collision resolver_reasons wall_s setup_s simulated_s steps node_evaluations \
        surfaces plate nodes wear_volume_m3 \
        wear_volume_normal_m3 wear_volume_lateral_m3 wear_volume_archard_m3 removed_volume_m3 chip_volume_m3 \
        max_depth_m worn_nodes touching_nodes peak_normal_force_N indented_area_m2 wear_rate_m2 motion \
        bodies ball position_m rotation_xyzw velocity_m_s spin_rad_s restitution rebound_angle_deg \
        restitution_normal mean_force_N energy initial_J kinetic_J elastic_J friction_J wear_J damping_J \
        external_work_J history_J adhesion_J numerical_J erosion error_estimate time pitch basis \
        warnings stop laws impacts wear_volume_m3 predicted_m3 dnv";
    assert_eq!(keys(&text), expected.split_whitespace().collect::<Vec<_>>());
}

/// A program that skipped `None` would leave readers with a missing key.
#[test]
fn absent_values_are_null() {
    let summary = Summary { energy: None, ..sample() };
    let json: serde_json::Value =
        serde_json::from_str(&summary.to_json().expect("writable")).expect("JSON");
    assert!(json.as_object().expect("a map")["energy"].is_null());
    assert!(json["surfaces"]["plate"].as_object().expect("a map")["wear_rate_m2"].is_null());
    assert!(json["surfaces"]["plate"].as_object().expect("a map")["motion"].is_null());
    assert!(json["error_estimate"].as_object().expect("a map")["pitch"].is_null());
    assert!(json["bodies"]["ball"].as_object().expect("a map")["restitution"].is_null());
}

/// A program that took the sum over the nodes for the volume, which is not that of a renewed
/// surface, counted all nodes as worn or swapped the parts would pass a test of the keys alone.
#[test]
fn a_surface_tells_its_volumes_and_its_worn_nodes() {
    let nodes = Nodes {
        rest_position: vec![Point3::origin(); 3],
        normal: vec![Vector3::z(); 3],
        rest_area: vec![2.0, 3.0, 5.0],
        depth: vec![0.5, 0.0, 0.25],
    };
    let worn =
        Worn { normal: 1.5, lateral: 0.75, chip: 0.125, removed: 2.25, ..Default::default() };
    let summary = SurfaceSummary::of(&nodes, 2.375, &worn);
    assert_eq!(summary.wear_volume, 2.375);
    assert_eq!((summary.wear_volume_normal, summary.wear_volume_lateral), (1.5, 0.75));
    assert_eq!((summary.removed_volume, summary.chip_volume), (2.25, 0.125));
    assert_eq!((summary.max_depth, summary.worn_nodes, summary.nodes), (0.5, 2, 3));
}

/// A program that wrote the quaternion as w, x, y, z would pass for the identity of a reader who
/// only looks at its norm.
#[test]
fn the_scalar_part_of_a_rotation_stands_last() {
    assert_eq!(BodySummary::of(&State::at(Point3::origin())).rotation_xyzw, [0.0, 0.0, 0.0, 1.0]);
}

/// A program that rounded numbers on the way would not read back the same.
#[test]
fn the_file_reads_back_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("summary.json");
    let summary = Summary { wall: 0.1 + 0.2, stop: Some("all rebounded".into()), ..sample() };
    summary.write(&path).expect("writable");
    let text = fs::read_to_string(&path).expect("there");
    assert_eq!(serde_json::from_str::<Summary>(&text).expect("JSON"), summary);
}

/// Fails for a key that is written under one name and read under another, and for a half file that
/// passes for a run.
#[test]
fn a_summary_reads_back_as_it_was() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("summary.json");
    sample().write(&path).expect("writable");
    assert_eq!(Summary::read(&path).expect("readable"), sample());
    fs::write(&path, "{\"scene\": \"half\"}").expect("writable");
    let error = Summary::read(&path).expect_err("half");
    assert!(error.to_string().contains("missing field `abrade`"), "{error}");
}
