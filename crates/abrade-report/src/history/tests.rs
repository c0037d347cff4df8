//! The table read back with a reader that knows nothing of the writer.

use std::collections::BTreeMap;
use std::fs;

use nalgebra::Point3;

use super::*;

fn columns() -> Columns {
    Columns {
        bodies: vec!["ball".into()],
        surfaces: vec!["plate".into(), "cube".into()],
        carriers: vec!["cube".into()],
        energies: true,
    }
}

fn body() -> BodyRow {
    let state = State {
        velocity: Vector3::new(4.0, 5.0, 6.0),
        spin: Vector3::new(7.0, 8.0, 9.0),
        ..State::at(Point3::new(1.0, 2.0, 0.1 + 0.2))
    };
    BodyRow { state, force: Vector3::new(-1e4, 1e-9, 12.0) }
}

/// A program that put a value under its neighbour's name, or rounded it, would pass a test that
/// only counts columns.
#[test]
fn every_value_stands_under_its_name_and_reads_back_exactly() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("history.csv");
    let mut history = History::create(&path, columns()).expect("writable");
    let energies = EnergySummary { kinetic: 0.5, numerical: -1e-12, ..Default::default() };
    let surface = SurfaceRow { wear_volume: 1.25e-13, max_depth: 3e-6 };
    let cube =
        State { spin: Vector3::new(0.0, 0.0, 12.0), ..State::at(Point3::new(7.0, 0.0, 0.0)) };
    let row = Row {
        time: 1e-6,
        bodies: &[body()],
        surfaces: &[surface, SurfaceRow { wear_volume: 2.5e-13, ..surface }],
        carriers: &[cube],
        energies: Some(&energies),
    };
    history.push(&row).expect("writable");
    assert!(!path.exists(), "the final name must wait for the end");
    history.finish().expect("renamed");

    let mut table = csv::Reader::from_path(&path).expect("there");
    let rows: Vec<BTreeMap<String, f64>> =
        table.deserialize().collect::<Result<_, _>>().expect("numbers");
    assert_eq!(rows.len(), 1);
    let expected = [
        ("time_s", 1e-6),
        ("ball_x_m", 1.0),
        ("ball_z_m", 0.1 + 0.2),
        ("ball_vy_m_s", 5.0),
        ("ball_wz_rad_s", 9.0),
        ("ball_fx_N", -1e4),
        ("ball_fy_N", 1e-9),
        ("plate_wear_volume_m3", 1.25e-13),
        ("plate_max_depth_m", 3e-6),
        ("cube_wear_volume_m3", 2.5e-13),
        ("cube_x_m", 7.0),
        ("cube_wz_rad_s", 12.0),
        ("kinetic_J", 0.5),
        ("numerical_J", -1e-12),
    ];
    for (name, value) in expected {
        assert_eq!(rows[0][name], value, "{name}");
    }
}

/// A program that wrote whatever it was given would shift every later column.
#[test]
fn a_row_that_does_not_fit_the_header_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("history.csv");
    let mut history = History::create(&path, columns()).expect("writable");
    let (bodies, surfaces) = (&[body()][..], &[SurfaceRow::default(); 2][..]);
    let (carriers, energies) = (&[body().state][..], Some(&EnergySummary::default()));
    let whole = Row { time: 0.0, bodies, surfaces, carriers, energies };
    let error = history.push(&Row { bodies: &[], ..whole }).expect_err("a body is missing");
    assert!(matches!(error, ReportError::Row { what: "bodies", expected: 1, found: 0, .. }));
    for row in [Row { energies: None, ..whole }, Row { carriers: &[], ..whole }] {
        assert!(history.push(&row).is_err(), "{row:?}");
    }
    history.push(&whole).expect("nothing is missing");
}

/// A program that removed an unfinished history would lose what an interrupted run had written.
#[test]
fn an_unfinished_history_stays_under_its_temporary_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("history.csv");
    drop(History::create(&path, columns()).expect("writable"));
    let entry = fs::read_dir(folder.path()).expect("there").next().expect("one file");
    let name = entry.expect("readable").file_name();
    assert!(name.to_string_lossy().ends_with(".partial"), "{name:?}");
    assert!(!path.exists());
}

/// Fails for a reader that takes the columns of another body, whose name ends alike, or the speed
/// for the place.
#[test]
fn places_are_found_by_the_body_and_read_back_exactly() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("history.csv");
    let names = ["a_ball".to_owned(), "ball".to_owned()];
    let columns = Columns { bodies: names.to_vec(), ..Columns::default() };
    let mut history = History::create(&path, columns).expect("writable");
    let at = |x: f64| BodyRow { state: State::at(Point3::new(x, 2.0 * x, 0.1 + 0.2)), ..body() };
    for time in [0.0, 1.0] {
        let bodies = [at(-7.0), at(time)];
        let (surfaces, carriers, energies) = (&[], &[], None);
        let row = Row { time, bodies: &bodies, surfaces, carriers, energies };
        history.push(&row).expect("writable");
    }
    history.finish().expect("renamed");
    let places = read_places(&path, &names[1..]).expect("readable");
    let expected = [0.0, 1.0].map(|x| Point3::new(x, 2.0 * x, 0.1 + 0.2));
    assert_eq!(places, [expected.to_vec()]);
    let error = read_places(&path, &["cube".into()]).expect_err("no such body");
    assert!(error.to_string().contains("cube_x_m"), "{error}");
}
