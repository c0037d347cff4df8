//! Going on in another process.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs, process};

use super::cases::{CASES, Case};
use super::save::Save;

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

/// Fails for a query collider that is forgotten: the one in Rapier's bytes would stay as it was,
/// in front of a second one.
#[test]
fn a_query_collider_is_known_again() {
    let mut save = CASES[0].begun();
    let (plate, _) = save.wear.surfaces().next().expect("a plate");
    let shown = save.wear.sync_collider(plate, &mut save.world.colliders).expect("a proxy");
    save.run(1);
    let mut read = Save::read(&save.bytes());
    let count = read.world.colliders.len();
    assert_eq!(read.wear.sync_collider(plate, &mut read.world.colliders), Ok(shown));
    assert_eq!(read.world.colliders.len(), count);
}
