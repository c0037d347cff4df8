//! Going on in another process.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs, process};

use super::cases::{self, CASES, Case};
use super::save::Save;
use crate::plugin::abrade::{Surface, SurfaceLaws, TriangleMesh};
use crate::plugin::rapier::prelude::*;
use crate::plugin::{WearSettings, WearWorld, scalar};

/// Where the other process finds the bytes, and how many steps it takes.
const BYTES: &str = "ABRADE_SNAPSHOT_BYTES";
const STEPS: &str = "ABRADE_SNAPSHOT_STEPS";

/// What another process makes of the bytes in so many steps.
fn elsewhere(case: &Case, bytes: &[u8]) -> String {
    let name = format!("{}-{}", case.name.replace(' ', "-"), process::id());
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, bytes).expect("a file");
    let run = Command::new(env::current_exe().expect("this test"))
        .args(["--exact", "snapshot::process::goes_on_elsewhere", "--ignored"])
        .env(BYTES, &path)
        .env(STEPS, case.after.to_string())
        .output()
        .expect("another process");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stdout));
    let outcome = fs::read_to_string(path.with_extension("out")).expect("an outcome");
    for path in [path.with_extension("out"), path] {
        fs::remove_file(path).expect("a file of ours");
    }
    outcome
}

/// The other process.
#[test]
#[ignore = "the other process of the test below; cargo test --release -p abrade-rapier3d \
            --features serde-serialize --test snapshot_f32 another_process"]
fn goes_on_elsewhere() {
    let Some(path) = env::var_os(BYTES).map(PathBuf::from) else { return };
    let steps = env::var(STEPS).expect("the steps").parse().expect("a number");
    let mut save = Save::read(&fs::read(&path).expect("the bytes"));
    fs::write(path.with_extension("out"), save.outcome(steps)).expect("a file");
}

/// Fails for a state that is left out, for what another process lays elsewhere in memory, and for
/// a body that is derived or begun anew because it was read.
#[test]
fn another_process_goes_on_to_the_bit() {
    for case in &CASES {
        let mut save = case.begun();
        let bytes = save.bytes();
        assert!(Save::read(&bytes).bytes() == bytes, "{}: bytes change by being read", case.name);
        let here = case.finish(&mut save);
        let there = elsewhere(case, &bytes);
        let differing = here.lines().zip(there.lines()).find(|(a, b)| a != b);
        let shown = differing.map(|(a, b)| [a, b].map(|l| l.chars().take(600).collect::<String>()));
        assert!(here == there, "{}: {shown:#?}", case.name);
    }
}

/// Fails for a save in the middle of a step, whose rest would be lost.
#[test]
fn a_step_under_way_is_not_saved() {
    use crate::plugin::WorldView;
    let mut save = CASES[0].begun();
    let _ = save.wear.begin_step(WorldView::of(&mut save.world), &());
    assert!(postcard::to_stdvec(&save.wear).is_err());
    save.wear.end_step(WorldView::of(&mut save.world)).expect("a step");
    assert!(postcard::to_stdvec(&save.wear).is_ok());
}

/// Fails for query colliders that are forgotten: those in Rapier's bytes would stay as they were,
/// in front of others; and for what has worn since the last look, if it is forgotten or taken for
/// all there is.
#[test]
fn query_colliders_are_known_again() {
    let mut save = CASES[0].begun();
    let (plate, _) = save.wear.surfaces().next().expect("a plate");
    let tiles = save.wear.sync_colliders(plate, &mut save.world.colliders).expect("a proxy");
    save.run(1);
    let mut read = Save::read(&save.bytes());
    let count = read.world.colliders.len();
    let [made, here] = [&mut read, &mut save]
        .map(|save| save.wear.sync_colliders(plate, &mut save.world.colliders).expect("a proxy"));
    assert!(made == here && made > 0 && made < tiles, "{made} and {here} of {tiles}");
    assert_eq!(read.wear.query_colliders(plate), save.wear.query_colliders(plate));
    assert_eq!(read.world.colliders.len(), count);
}

/// Fails for tiles of a solid that are shared out anew or made anew because they were read, and
/// for an order of facets that is taken without being looked at.
#[test]
fn tiles_of_a_solid_are_known_again() {
    let laws = SurfaceLaws::of(cases::STEEL);
    let mesh = TriangleMesh::sphere(0.05, 2e-3).expect("a sphere");
    let surface = Surface::mesh(&mesh, laws).expect("a surface");
    let mut world = PhysicsWorld::default();
    let proxy = world.colliders.insert(ColliderBuilder::ball(scalar::narrow(0.05)));
    let mut wear = WearWorld::new(WearSettings::default());
    let id = wear.insert(surface, proxy, &mut world.colliders).expect("a proxy");
    let tiles = wear.sync_colliders(id, &mut world.colliders).expect("a proxy");
    let bytes = Save { world, wear }.bytes();
    let mut read = Save::read(&bytes);
    let mut sync = || read.wear.sync_colliders(id, &mut read.world.colliders).expect("a proxy");
    assert!(tiles > 10 && sync() == 0);
    assert_eq!(read.wear.query_colliders(id).len(), tiles);
    // A facet that is named twice leaves another one out. The order stands near the end.
    let wear = postcard::to_stdvec(&read.wear).expect("bytes");
    let refused = |at: usize| {
        let mut damaged = wear.clone();
        damaged[at] ^= 1;
        postcard::from_bytes::<WearWorld>(&damaged).is_err()
    };
    let facets = 2 * mesh.vertices().len() - 4;
    let order = wear.len() - facets..wear.len() - 200;
    assert!(order.step_by(facets / 3).all(refused));
}
