//! The data of a page against the files that it was made of.

use std::collections::BTreeMap;
use std::io::Read as _;
use std::path::Path;

use abrade::{Ball, Nodes, State};
use abrade_report::summary::{
    BodySummary, EnergySummary, ErrorEstimate, ResolverCounts, SurfaceSummary,
};
use abrade_report::vtp::{PlacedBody, VtpFile, write_bodies, write_surface};
use abrade_report::{Mesh, Series, Summary};
use abrade_view::{Page, ViewError};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;
use tempfile::TempDir;

const INSTANTS: usize = 4;
const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [2, 1, 3]];

/// A square of four nodes 1 mm apart, far from the world's origin, worn a third more each instant.
fn nodes(instant: usize) -> Nodes {
    let at = [(0.0, 0.0), (1e-3, 0.0), (0.0, 1e-3), (1e-3, 1e-3)];
    Nodes {
        rest_position: at.map(|(x, y)| Point3::new(7.0 + x, y, 0.0)).to_vec(),
        normal: vec![Vector3::z(); 4],
        rest_area: vec![0.25e-6; 4],
        depth: [0.0, 1.0, 2.0, 3.0].map(|share| share * 1e-5 * instant as f64 / 3.0).to_vec(),
    }
}

/// A turn about a place beside the square, and a way.
fn pose(instant: usize) -> Isometry3<f64> {
    let share = instant as f64;
    let there = Isometry3::translation(7.0, 0.01 * share, 0.0);
    there
        * Isometry3::rotation(Vector3::new(0.2, 0.0, 0.9) * share)
        * Isometry3::translation(-7.0, 0.0, 0.0)
}

fn body_state(instant: usize) -> State {
    let pose = pose(instant);
    State { rotation: pose.rotation, ..State::at(Point3::new(7.0, 0.0, 1e-3 * instant as f64)) }
}

fn summary(names: &[&str], nodes: usize) -> Summary {
    let surface = SurfaceSummary { nodes, ..Default::default() };
    let body = BodySummary::of(&State::at(Point3::origin()));
    Summary {
        scene: "<b>A & \"B\"</script>".into(),
        abrade: "0.1.0".into(),
        complete: true,
        precision: "f64".into(),
        resolver: ResolverCounts::default(),
        resolver_reasons: BTreeMap::new(),
        wall: 1.0,
        setup: 0.0,
        simulated: 5e-5,
        steps: 1,
        node_evaluations: 1,
        surfaces: BTreeMap::from([("plate".into(), surface)]),
        bodies: names.iter().map(|name| ((*name).into(), body)).collect(),
        energy: None,
        erosion: None,
        error_estimate: ErrorEstimate::default(),
        warnings: Vec::new(),
        stop: None,
        laws: None,
    }
}

/// A run of one plate that is led and turned, and of a ball and a cube.
fn run() -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let corners = (0..8_u32).map(|i| {
        let side = |bit: u32| if i & bit == 0 { -1e-3 } else { 1e-3 };
        Point3::new(side(1), side(2), side(4))
    });
    let cube = Mesh::of_convex(&corners.collect::<Vec<_>>()).expect("a cube is not flat");
    let meshes = [Mesh::of_ball(&Ball { centre: Point3::origin(), radius: 1e-3 }), cube];
    let mut surfaces = Series::new(path, "surface");
    let mut bodies = Series::new(path, "bodies");
    for instant in 0..INSTANTS {
        let time = 1e-5 * instant as f64;
        let file = surfaces.next_path();
        write_surface(&file, &nodes(instant), None, &pose(instant), &TRIANGLES).expect("writable");
        surfaces.push(time);
        let state = body_state(instant);
        let placed = meshes.each_ref().map(|mesh| PlacedBody { mesh, state: &state });
        write_bodies(&bodies.next_path(), &placed).expect("writable");
        bodies.push(time);
    }
    surfaces.write().expect("writable");
    bodies.write().expect("writable");
    summary(&["ball", "cube"], 4).write(&path.join("summary.json")).expect("writable");
    folder
}

/// The JSON in the page.
fn data(page: &Page) -> Value {
    let (_, rest) = page.html.split_once("id=\"data\">").expect("the data");
    let (json, _) = rest.split_once("</script>").expect("the end of the data");
    serde_json::from_str(json).expect("JSON")
}

fn bytes(text: &Value) -> Vec<u8> {
    let packed = STANDARD.decode(text.as_str().expect("a text")).expect("base64");
    let mut bytes = Vec::new();
    flate2::read::ZlibDecoder::new(&packed[..]).read_to_end(&mut bytes).expect("zlib");
    bytes
}

fn f32s(text: &Value) -> Vec<f32> {
    let (words, rest) = (bytes(text), 4);
    words.chunks_exact(rest).map(|w| f32::from_le_bytes(w.try_into().expect("four"))).collect()
}

/// The points of a solid at an instant [m], in the world: what the page's script computes.
fn placed(data: &Value, solid: &Value, instant: usize) -> Vec<Point3<f64>> {
    let shown = &solid["instants"][instant];
    let shape = &solid["shapes"][shown["shape"].as_u64().expect("a number") as usize];
    let (local, poses) = (f32s(&shape["local"]), f32s(&shown["poses"]));
    let part = match &shape["part"] {
        Value::Null => vec![0; local.len() / 3],
        part => f32s(part).into_iter().map(f32::to_bits).collect(),
    };
    let origin = data["origin_m"].as_array().expect("three numbers");
    let origin = Vector3::from_iterator(origin.iter().map(|x| x.as_f64().expect("a number")));
    let point = |(local, part): (&[f32], &u32)| {
        let pose: Vec<f64> =
            poses[7 * *part as usize..][..7].iter().map(|x| f64::from(*x)).collect();
        let rotation =
            UnitQuaternion::new_normalize(Quaternion::new(pose[6], pose[3], pose[4], pose[5]));
        let local = Vector3::from_iterator(local.iter().map(|x| f64::from(*x)));
        Point3::new(pose[0], pose[1], pose[2]) + origin + rotation * local
    };
    local.chunks_exact(3).zip(&part).map(point).collect()
}

fn assert_near(found: &[Point3<f64>], expected: &[Point3<f64>]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        // Seven digits of a view of 0.03 m.
        assert!((found - expected).norm() < 1e-8, "{found} {expected}");
    }
}

/// Fails for depths that are scaled, thinned, shifted by an instant or rounded twice.
#[test]
fn depths_are_those_of_the_files_to_the_last_bit() {
    let folder = run();
    let page = Page::of_run(folder.path()).expect("a page");
    assert_eq!((page.instants, page.nodes, page.bodies), (INSTANTS, 4, 2));
    let data = data(&page);
    let surface = &data["surfaces"][0];
    assert_eq!(surface["name"], "plate");
    for instant in 0..INSTANTS {
        let file = folder.path().join(format!("surface_{instant:04}.vtp"));
        let depths = VtpFile::open(&file).and_then(|file| file.scalars("depth_m")).expect("there");
        let written = f32s(&surface["instants"][instant]["depth"]);
        let bits = |value: f32| value.to_bits();
        let expected: Vec<_> = depths.iter().map(|depth| bits(*depth as f32)).collect();
        assert_eq!(written.into_iter().map(bits).collect::<Vec<_>>(), expected);
        let most = depths.iter().copied().fold(0.0, f64::max);
        assert_eq!(surface["max_depths_m"][instant].as_f64(), Some(most));
        assert_eq!(data["times_s"][instant].as_f64(), Some(1e-5 * instant as f64));
    }
}

/// Fails for a motion that is left out, turned the wrong way or told from another origin, for two
/// bodies of one pose, and for coordinates that lose their digits 7 m from the world's origin.
#[test]
fn surfaces_and_bodies_are_where_the_files_say() {
    let folder = run();
    let page = Page::of_run(folder.path()).expect("a page");
    let data = data(&page);
    assert_eq!(data["surfaces"][0]["shapes"].as_array().expect("shapes").len(), 1);
    assert_eq!(data["bodies"]["names"], serde_json::json!(["ball", "cube"]));
    for instant in 0..INSTANTS {
        let rest: Vec<_> = nodes(0).rest_position.iter().map(|at| pose(instant) * at).collect();
        assert_near(&placed(&data, &data["surfaces"][0], instant), &rest);
        let file = folder.path().join(format!("bodies_{instant:04}.vtp"));
        let points = VtpFile::open(&file).and_then(|file| file.points()).expect("there");
        assert_near(&placed(&data, &data["bodies"], instant), &points);
    }
}

/// Fails for a renewed solid that is drawn with the nodes that it had before.
#[test]
fn a_surface_that_is_laid_out_anew_gets_a_shape_of_its_own() {
    let folder = run();
    let mut renewed = nodes(2);
    renewed.rest_position[3].x += 2e-4;
    let file = folder.path().join("surface_0002.vtp");
    write_surface(&file, &renewed, None, &pose(2), &TRIANGLES).expect("writable");
    let page = Page::of_run(folder.path()).expect("a page");
    let data = data(&page);
    let shapes: Vec<_> =
        (0..INSTANTS).map(|at| data["surfaces"][0]["instants"][at]["shape"].as_u64()).collect();
    assert_eq!(shapes, [0, 0, 1, 2].map(Some));
    let rest: Vec<_> = renewed.rest_position.iter().map(|at| pose(2) * at).collect();
    assert_near(&placed(&data, &data["surfaces"][0], 2), &rest);
}

/// Fails for a page whose scene's name closes a script or opens an element, and for one that asks
/// for anything outside itself.
#[test]
fn names_are_text_and_nothing_is_loaded() {
    let folder = run();
    let Page { html, .. } = Page::of_run(folder.path()).expect("a page");
    assert!(html.contains("<h1>&lt;b&gt;A &amp; &quot;B&quot;&lt;/script&gt;</h1>"));
    assert_eq!(html.matches("</script>").count(), 3);
    assert_eq!(
        data(&Page { html: html.clone(), instants: 0, nodes: 0, bodies: 0 })["summary"]["scene"],
        "<b>A & \"B\"</script>"
    );
    for asks in [" src=", "<link rel=\"stylesheet\"", "@import", "import("] {
        assert!(!html.contains(asks), "{asks}");
    }
    assert!(!html.contains("{{"), "a mark is left");
}

fn error_of(folder: &Path) -> ViewError {
    Page::of_run(folder).expect_err("no page")
}

/// Fails for a message that leaves out what to do, and for a page of files that do not belong
/// together.
#[test]
fn what_cannot_be_shown_is_named() {
    let empty = tempfile::tempdir().expect("a temporary folder");
    assert!(matches!(error_of(empty.path()), ViewError::NoRun { .. }));
    summary(&[], 4).write(&empty.path().join("summary.json")).expect("writable");
    let error = error_of(empty.path()).to_string();
    assert!(error.contains("add `Surface(every: \"1 us\"), Bodies` to the `outputs`"), "{error}");

    let folder = run();
    let path = folder.path().join("summary.json");
    summary(&["ball", "cube"], 5).write(&path).expect("writable");
    assert!(matches!(error_of(folder.path()), ViewError::Mixed { found: 4, expected: 5, .. }));
    summary(&["ball"], 4).write(&path).expect("writable");
    let error = error_of(folder.path());
    assert!(matches!(error, ViewError::Mixed { what: "bodies", found: 2, expected: 1, .. }));
    summary(&["ball", "cube"], 4).write(&path).expect("writable");
    std::fs::remove_file(folder.path().join("surface_0001.vtp")).expect("there");
    assert!(error_of(folder.path()).to_string().contains("cannot read"));
}

/// Fails for a page of the longer list, whose last instant has no bodies.
#[test]
fn a_run_that_broke_off_is_shown_as_far_as_it_got() {
    let folder = run();
    let mut shorter = Series::new(folder.path(), "bodies");
    shorter.push(0.0);
    shorter.push(1e-5);
    shorter.write().expect("writable");
    assert_eq!(Page::of_run(folder.path()).expect("a page").instants, 2);
    std::fs::remove_file(folder.path().join("bodies.pvd")).expect("there");
    let page = Page::of_run(folder.path()).expect("a page");
    assert_eq!((page.instants, page.bodies), (INSTANTS, 0));
    assert!(data(&page)["bodies"].is_null());
}

/// Fails for a list of energies that does not add up because one is left out.
#[test]
fn the_page_lists_every_energy_of_the_summary() {
    let folder = run();
    let html = Page::of_run(folder.path()).expect("a page").html;
    let energies = serde_json::to_value(EnergySummary::default()).expect("JSON");
    for key in energies.as_object().expect("a map").keys() {
        assert!(html.contains(&format!("{key}: \"")), "{key}");
    }
}
