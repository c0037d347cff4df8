//! Studies of a small scene, each run for real.

use std::path::{Path, PathBuf};

use abrade_scene::{Precision, Progress, RunOptions};
use abrade_study::StudyError;
use abrade_study::convergence::{Plan, Study, Variant, convergence};

const SCENE: &str = r#"(
    version: 1,
    name: "A ball",
    materials: { "steel": (hardness: "1.7 GPa", young: "200 GPa", friction: 0.3) },
    surfaces: {
        "plate.1": (
            material: "steel",
            geometry: HexStrip(length: "4 mm", width: "3 mm", pitch: "0.1 mm"),
        ),
    },
    bodies: {
        "the ball.": (
            shape: Ball(radius: "3 mm"),
            density: 2500.0,
            position: OnSurface(surface: "plate.1", gap: "1 um"),
            motion: Impact(speed: "35 m/s", angle: "60 deg"),
        ),
    },
)"#;

struct Patient;

impl Progress for Patient {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        true
    }
}

fn scene(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("scene.ron");
    std::fs::write(&path, text).unwrap();
    path
}

fn study(folder: &Path, sets: &[String], plan: Plan) -> Result<Study, StudyError> {
    let plan = Plan { folder: folder.join("study"), budget: 1e3, ..plan };
    convergence(&scene(folder, SCENE), sets, &plan, &mut Patient)
}

/// A study that compared runs with one of another setting, or with the mean where landings pair
/// off, would see no error fall, or the lattice's in the place of the time step's.
#[test]
fn errors_fall_with_the_accuracy_and_with_the_pitch() {
    let folder = tempfile::tempdir().unwrap();
    let variants = vec![Variant::Accuracy, Variant::Pitch];
    let study = study(folder.path(), &[], Plan { variants, ..Plan::default() }).unwrap();
    let [accuracy, pitch] = &study.curves[..] else { panic!("{:?}", study.curves) };
    assert!(accuracy.order.unwrap() > 0.3, "{:?}", accuracy.order);
    assert!(pitch.order.unwrap() > 1.0, "{:?}", pitch.order);
    for curve in &study.curves {
        let errors: Vec<f64> = curve.rows.iter().filter_map(|row| row.errors.wear).collect();
        assert_eq!(errors.len(), curve.rows.len());
        assert!(errors[0] > 5.0 * errors[errors.len() - 3], "{errors:?}");
    }
    // The finest run of the accuracies is their reference, landing by landing.
    assert_eq!(accuracy.rows.last().unwrap().errors.wear, Some(0.0));
    // Neither it nor the one before it, which it hardly exceeds, tells of the order.
    let fitted: Vec<bool> = accuracy.rows.iter().rev().map(|row| row.is_fitted).collect();
    assert_eq!(fitted[..3], [false, false, true]);
    let table = study.table();
    assert!(table.contains("for 1 %: ") && table.contains("error ~ pitch^"), "{table}");
}

/// One whose rows named other changes than those that were run could not be checked by hand.
#[test]
fn a_row_is_run_again_by_its_changes() {
    let folder = tempfile::tempdir().unwrap();
    let variants = vec![Variant::Pitch];
    let plan = Plan { variants, landings: 1, ..Plan::default() };
    let slower = r#"bodies."the ball.".motion.speed=30 m/s"#.to_owned();
    study(folder.path(), std::slice::from_ref(&slower), plan).unwrap();
    let mut table = csv::Reader::from_path(folder.path().join("study/study.csv")).unwrap();
    let head = table.headers().unwrap().clone();
    let column = |name: &str| head.iter().position(|column| column == name).unwrap();
    let (sets, wear) = (column("arguments"), column("wear_volume_m3"));
    let row = table.records().nth(1).unwrap().unwrap();
    let sets = row[sets].strip_prefix("--set '").and_then(|sets| sets.strip_suffix('\''));
    let sets: Vec<String> = sets.unwrap().split("' --set '").map(str::to_owned).collect();
    assert_eq!(sets[0], slower);
    let checked = abrade_scene::load(&folder.path().join("scene.ron"), &sets).unwrap();
    let options = RunOptions { folder: folder.path().join("again"), precision: Precision::Double };
    let run = abrade_scene::run(&checked, &options, &mut Patient).unwrap();
    assert_eq!(run.summary.surfaces["plate.1"].wear_volume, row[wear].parse::<f64>().unwrap());
}

/// One that took the first number it found for the reference, or its own finest run all the same,
/// would have no error of a half here.
#[test]
fn errors_count_from_a_file_where_one_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("truth.json");
    std::fs::write(&file, r#"{"surfaces": {"any": {"wear_volume_m3": 1.0}}}"#).unwrap();
    let variants = vec![Variant::Accuracy];
    let plan = || Plan {
        variants: variants.clone(),
        landings: 1,
        reference: Some(file.clone()),
        ..Plan::default()
    };
    let seen = study(folder.path(), &[], plan()).unwrap();
    let row = &seen.curves[0].rows[2];
    let expected = 1.0 - row.mean.wear;
    assert_eq!((row.errors.wear, row.total), (Some(expected), Some(expected)));
    assert_eq!((row.errors.depth, row.errors.restitution), (None, None));
    for (text, told) in [("{", "EOF"), ("{}", "wear_volume_m3")] {
        std::fs::write(&file, text).unwrap();
        let fault = study(folder.path(), &[], plan()).unwrap_err().to_string();
        assert!(fault.contains(told) && fault.contains("truth.json"), "{fault}");
    }
}

/// One that gave up at the first setting that the scene cannot have, or that hid it, would not name
/// it.
#[test]
fn a_setting_that_cannot_be_run_is_a_row() {
    let folder = tempfile::tempdir().unwrap();
    let sets = [r#"surfaces."plate.1".geometry.pitch=2 mm"#.to_owned()];
    let variants = vec![Variant::Pitch];
    let plan = Plan { variants, landings: 1, ..Plan::default() };
    let study = study(folder.path(), &sets, plan).unwrap();
    let rows = &study.curves[0].rows;
    assert!(rows[0].failure.is_some(), "{rows:?}");
    assert!(rows.last().unwrap().failure.is_none());
    assert!(study.table().contains(rows[0].failure.as_ref().unwrap().as_str()));
}

/// One that forgot the budget would run every setting; one that ran none could compare nothing.
#[test]
fn the_budget_leaves_finer_settings_out() {
    let folder = tempfile::tempdir().unwrap();
    let plan = Plan {
        variants: vec![Variant::Pitch],
        landings: 1,
        budget: 0.05,
        folder: folder.path().join("study"),
        ..Plan::default()
    };
    let path = scene(folder.path(), SCENE);
    let study = convergence(&path, &[], &plan, &mut Patient).unwrap();
    let (ran, left_out) = (study.curves[0].rows.len(), study.curves[0].left_out);
    assert!(ran >= 1 && left_out >= 1 && ran + left_out == 9, "{ran} {left_out}");
    assert!(plan.folder.join("study.png").exists());
}

/// One whose finest run was the cheapest for an error that only it can tell, or whose reference was
/// the last of some ladder and not the finest of all, would name the setting that it compares with.
#[test]
fn the_reference_is_no_setting_to_take() {
    let folder = tempfile::tempdir().unwrap();
    let variants = vec![Variant::Young, Variant::Accuracy, Variant::Pitch];
    let seen = study(folder.path(), &[], Plan { variants, ..Plan::default() }).unwrap();
    assert!(seen.reference.contains("geometry.pitch=2.5e-5'"), "{}", seen.reference);
    for cheapest in &seen.cheapest {
        let Some((_, rung, ..)) = &cheapest.setting else { continue };
        assert!(rung.pitch > 1.9 * 0.25, "{cheapest:?}");
    }
    assert!(seen.cheapest[0].setting.is_some());
    // On one pitch alone, the table says what its errors do not hold.
    let variants = vec![Variant::Young];
    let seen = study(folder.path(), &[], Plan { variants, ..Plan::default() }).unwrap();
    assert!(seen.reference.contains("do not hold that of the pitch"), "{}", seen.reference);
    assert!(seen.cheapest.iter().all(|cheapest| cheapest.setting.is_none()));
}

/// Keeps the table as it was when it was asked last; one that is not patient breaks off once there is
/// one.
struct Reader {
    table: PathBuf,
    seen: String,
    patient: bool,
}

impl Progress for Reader {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        self.seen = std::fs::read_to_string(&self.table).unwrap_or_default();
        self.patient || self.seen.is_empty()
    }
}

/// One that wrote its rows at the end alone would lose all of them when it is killed; one that asks
/// only during runs is not broken off where a run takes a single step.
#[test]
fn the_rows_of_a_ladder_are_there_while_the_next_one_runs() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), SCENE);
    for patient in [true, false] {
        let plan = Plan {
            variants: vec![Variant::Pitch, Variant::Accuracy],
            landings: 1,
            folder: folder.path().join(format!("study {patient}")),
            ..Plan::default()
        };
        let table = plan.folder.join("study.csv");
        let mut reader = Reader { table, seen: String::new(), patient };
        let study = convergence(&path, &[], &plan, &mut reader).unwrap();
        let rows = reader.seen.lines().skip(1);
        assert_eq!(rows.clone().count(), study.curves[0].rows.len());
        assert!(rows.clone().all(|row| row.starts_with("pitch,")), "{}", reader.seen);
        assert_eq!(study.interrupted, !patient);
        assert_eq!(study.curves[1].rows.len(), if patient { 9 } else { 1 });
    }
}

/// One that changed a modulus which no stiffness follows, or called the one by the other's name,
/// would show what softer springs do where none are softer.
#[test]
fn what_is_varied_of_the_springs_has_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let plan = || Plan {
        variants: vec![Variant::Stiffness, Variant::Young],
        landings: 1,
        ..Plan::default()
    };
    let follows = study(folder.path(), &[], plan()).unwrap();
    let [young] = &follows.curves[..] else { panic!("{:?}", follows.curves) };
    assert!(young.variant == Variant::Young && young.rows[0].rung.sets[0].contains("young="));
    // Both ends are beyond what the stiffness of `Foundation` follows.
    let table = follows.table();
    assert!(table.contains("settings alike"), "{table}");
    let given = [r#"surfaces."plate.1".elastic=Foundation(stiffness: 1e15)"#.to_owned()];
    let given = study(folder.path(), &given, plan()).unwrap();
    let [stiffness] = &given.curves[..] else { panic!("{:?}", given.curves) };
    assert!(stiffness.variant == Variant::Stiffness);
    assert!(stiffness.rows[0].rung.sets[0].contains("elastic.stiffness="));
    let rigid = [r#"surfaces."plate.1".elastic=Rigid"#.to_owned()];
    let fault = study(folder.path(), &rigid, plan()).unwrap_err().to_string();
    assert!(fault.contains("nothing of what is to be varied"), "{fault}");
}

/// One that held an accuracy within its range would show another than it says.
#[test]
fn an_accuracy_out_of_range_is_a_row_that_was_refused() {
    let folder = tempfile::tempdir().unwrap();
    let plan = Plan { variants: vec![Variant::Both], landings: 1, ..Plan::default() };
    let seen = study(folder.path(), &["run.accuracy=0.1".to_owned()], plan).unwrap();
    let first = &seen.curves[0].rows[0];
    assert!(first.failure.as_ref().is_some_and(|why| why.contains("accuracy")), "{first:?}");
    assert!(seen.curves[0].rows[8].failure.is_none());
}

/// One that paired bodies by their places would take one for another.
#[test]
fn bodies_of_a_reference_are_found_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("truth.json");
    let text = r#"{"bodies": {"a": {"restitution": 0.9}, "the ball.": {"restitution": 0.5}}}"#;
    std::fs::write(&file, text).unwrap();
    let plan = Plan {
        variants: vec![Variant::Accuracy],
        landings: 1,
        reference: Some(file),
        ..Plan::default()
    };
    let seen = study(folder.path(), &[], plan).unwrap();
    let row = &seen.curves[0].rows[0];
    let restitution = row.mean.bodies["the ball."].restitution.unwrap();
    assert_eq!(row.errors.restitution, Some((restitution - 0.5).abs()));
    assert_eq!((row.errors.wear, row.errors.spin), (None, None));
}
