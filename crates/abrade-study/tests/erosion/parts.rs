//! Cases are made in parts, in any order, and again.

use std::path::{Path, PathBuf};

use abrade_scene::Progress;
use abrade_study::StudyError;
use abrade_study::erosion::{self, Case, StudyFile};

use crate::{make, study, text};

const GRAINS: &str = "\"sphere\": (form: Sphere), \"grit\": (form: Grit(points: 8))";
const ANGLES: &str = "\"20 deg\", \"70 deg\"";

fn small() -> StudyFile {
    study(&text(GRAINS, ANGLES, 6))
}

/// The file of `case` below the results folder `out`, in which it is.
fn path_of(case: &Case, out: &Path) -> PathBuf {
    let entries = std::fs::read_dir(out.join("cases")).expect("cases").flatten();
    let is_it = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).expect("a case");
        let line = text.lines().next().expect("a head");
        let head: serde_json::Value = serde_json::from_str(line).expect("a head");
        head["grain"] == case.grain && head["angle_rad"] == case.angle
    };
    entries.map(|entry| entry.path()).find(is_it).expect("the case")
}

fn table(file: &StudyFile, out: &Path) -> String {
    let result = erosion::result(file, Path::new(""), out).expect("a result");
    erosion::write(&result, Path::new(""), out).expect("files");
    std::fs::read_to_string(out.join("cases.csv")).expect("a table")
}

/// Fails for a case that depends on those before it, on the number of threads, or on the digits that its
/// file keeps.
#[test]
fn shards_that_are_merged_give_the_bits_of_one_machine() {
    let file = small();
    let folder = tempfile::tempdir().expect("a folder");
    let out = |name: &str| folder.path().join(name);
    let whole = out("whole");
    make(&file, &file.cases(), &whole);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    one.install(|| {
        for (first, name) in [(1, "b"), (0, "a")] {
            let mut cases: Vec<Case> = file.cases();
            cases.retain(|case| case.number % 2 == first);
            cases.reverse();
            make(&file, &cases, &out(name));
        }
    });
    let merged = out("merged");
    for name in ["a", "b"] {
        erosion::gather(&file, Path::new(""), &out(name), &merged).expect("its cases");
    }
    let table_of_whole = table(&file, &whole);
    assert_eq!(table(&file, &merged), table_of_whole);
    assert_eq!(table_of_whole.lines().count(), 5);
    for name in [
        "report.html",
        "wear.png",
        "ratio.png",
        "debris.png",
        "craters.png",
        "grains.csv",
        "cases.jsonl",
    ] {
        assert!(merged.join(name).exists(), "{name}");
    }
    let missing = erosion::gather(&file, Path::new(""), &out("nowhere"), &merged);
    assert!(missing.unwrap_err().to_string().contains("holds no case"));
}

/// Stops at once.
struct Stop;

impl Progress for Stop {
    fn advance(&mut self, _: f64, _: Option<f64>) -> bool {
        false
    }
}

/// Fails for a study that begins anew, that keeps half a case, or that takes the cases of another study for
/// its own.
#[test]
fn a_study_goes_on_where_it_was_broken_off() {
    let file = small();
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path();
    let cases = file.cases();
    make(&file, &cases[..2], out);
    let path = path_of(&cases[1], out);
    let (text_before, made) = (std::fs::read(&path).expect("a case"), std::fs::metadata(&path));
    let written = made.expect("a case").modified().expect("a time");
    let stopped = erosion::make(&file, Path::new(""), &cases, out, &mut Stop);
    assert!(matches!(stopped, Err(StudyError::Interrupted)), "{stopped:?}");
    assert!(!erosion::is_made(&file, Path::new(""), &cases[2], out));
    make(&file, &cases, out);
    let again = std::fs::metadata(&path).expect("a case").modified().expect("a time");
    assert_eq!((written, text_before.clone()), (again, std::fs::read(&path).expect("a case")));
    // A file that is cut off is made again, to the same bytes.
    std::fs::write(&path, &text_before[..text_before.len() / 2]).expect("a file");
    assert!(!erosion::is_made(&file, Path::new(""), &cases[1], out));
    make(&file, &cases, out);
    assert_eq!(std::fs::read(&path).expect("a case"), text_before);
    let mut other = file.clone();
    other.target.material.hardness *= 1.01;
    assert!(!erosion::is_made(&other, Path::new(""), &cases[1], out));
}

/// Fails for a study that makes its cases again because it was given one more, or that takes one of other impacts
/// for its own; and for one that loses cases of what it was before.
#[test]
fn cases_are_known_wherever_they_stand() {
    let few = small();
    let folder = tempfile::tempdir().expect("a folder");
    let (out, beside) = (folder.path(), Path::new(""));
    make(&few, &few.cases(), out);
    // Another angle, grain and speed before those that are there, so that no case keeps its number.
    let grains = format!("\"cube\": (form: Polyhedron(kind: Cube)), {GRAINS}");
    let more = text(&grains, &format!("\"10 deg\", {ANGLES}"), 6).replace("[98.1]", "[50.0, 98.1]");
    let more = study(&more.replace("name: \"", "name: \"more "));
    let is_there = |case: &Case| erosion::is_made(&more, beside, case, out);
    let id = |case: &Case| (case.grain.clone(), case.speed, case.angle);
    let is_old = |case: &Case| few.cases().iter().any(|old| id(old) == id(case));
    let cases = more.cases();
    assert_eq!(cases.len(), 18);
    assert!(cases.iter().all(|case| is_there(case) == is_old(case)));
    assert_eq!(erosion::others(&more, beside, out), 0);
    let before = table(&few, out);
    let mut finer = few.clone();
    finer.accuracy = 1e-4;
    assert!(!few.cases().iter().any(|case| erosion::is_made(&finer, beside, case, out)));
    assert_eq!(erosion::others(&finer, beside, out), 4);
    make(&finer, &few.cases(), out);
    assert_eq!(table(&few, out), before);
}

/// Keeps what it is told.
#[derive(Default)]
struct Told {
    shares: Vec<f64>,
    over: Vec<usize>,
}

impl Progress for Told {
    fn advance(&mut self, _: f64, share: Option<f64>) -> bool {
        self.shares.extend(share);
        true
    }

    fn cases(&mut self, over: usize, _: usize) {
        self.over.push(over);
    }
}

/// Fails for cases that are there and count by their place among the others, so that the share of the work leaps,
/// and for what another process has kept of one of them that stays for ever.
#[test]
fn cases_that_are_there_count_from_the_start() {
    let file = small();
    let folder = tempfile::tempdir().expect("a folder");
    let cases = file.cases();
    make(&file, &cases[2..], folder.path());
    let orphan = path_of(&cases[3], folder.path()).with_extension("begun.jsonl");
    std::fs::write(&orphan, "{}").expect("a file");
    let mut told = Told::default();
    erosion::make(&file, Path::new(""), &cases, folder.path(), &mut told).expect("cases");
    assert_eq!(told.over, [2, 3]);
    assert!(told.shares[0] > 0.5 && told.shares.is_sorted(), "{:?}", told.shares);
    assert!(!orphan.exists());
}

/// Fails for a case that begins anew, that goes on over a plate that is not the one it has worn, or that looks
/// at its interval elsewhere when it goes on; and for one that trusts half a file.
#[test]
fn a_case_goes_on_within_itself_with_the_same_bits() {
    let text = text("\"grit\": (form: Grit(points: 8))", "\"40 deg\"", 70);
    let text = text.replace("most: 70)", "most: 400, interval: 0.06), resolution: 3.0");
    for plate in ["Fresh", "Worn(width: \"0.3 mm\")"] {
        let file = study(&text.replace("speeds:", &format!("plate: {plate}, speeds:")));
        let (cases, folder) = (file.cases(), tempfile::tempdir().expect("a folder"));
        let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
        make(&file, &cases, &whole);
        let bytes = |out: &Path| std::fs::read(path_of(&cases[0], out)).expect("a case");
        let name = path_of(&cases[0], &whole).with_extension("begun.jsonl");
        let begun = parts.join("cases").join(name.file_name().expect("a name"));
        let lines = |text: &str| text.lines().count();
        let mut count = 0;
        // A share of the case each time; the second finds half a file.
        for round in 0..3 {
            let stopped = erosion::make(&file, Path::new(""), &cases, &parts, &mut Stop);
            assert!(matches!(stopped, Err(StudyError::Interrupted)), "{plate} {stopped:?}");
            let text = std::fs::read_to_string(&begun).expect("what has begun");
            assert!(lines(&text) > count, "{plate}");
            count = if round == 0 { 0 } else { lines(&text) };
            if round == 0 {
                std::fs::write(&begun, &text[..text.len() / 2]).expect("a file");
            }
        }
        make(&file, &cases, &parts);
        assert!(bytes(&whole) == bytes(&parts), "{plate}");
        assert!(!begun.exists(), "{plate}");
        assert!(bytes(&whole).split(|byte| *byte == b'\n').count() > count, "{plate}");
    }
}

/// Fails for impacts that each find a fresh plate, or for a plate whose craters are not those that the
/// impacts tell of: the second of two grains on one spot finds room that the first one made.
#[test]
fn a_worn_plate_keeps_what_it_has_lost() {
    let narrow = |plate: &str| {
        let text = text("\"sphere\": (form: Sphere)", "\"90 deg\"", 12);
        study(&text.replace("speeds:", &format!("plate: {plate}, speeds:")))
    };
    let made = |file: &StudyFile| {
        let case = crate::whole(file).cases.remove(0);
        ["wear_volume_m3", "depth_m"].map(|name| case.quantity(name).value)
    };
    let fresh = made(&narrow("Fresh"));
    let wide = made(&narrow("Worn(width: \"20 mm\")"));
    let crowded = made(&narrow("Worn(width: \"1 um\")"));
    // Craters that are far from each other are those of fresh plates.
    assert!((wide[0] / fresh[0] - 1.0).abs() < 1e-6, "{wide:?} {fresh:?}");
    // In one hole each goes deeper than the last one, and some leave it sideways.
    assert!(crowded[1] > 2.0 * fresh[1], "{crowded:?} {fresh:?}");
    assert!((0.9..1.0).contains(&(crowded[0] / fresh[0])), "{crowded:?} {fresh:?}");
}

/// Fails for a fault that is found late, without its place, or one at a time.
#[test]
fn faults_are_told_at_their_places_all_at_once() {
    let text = text(
        "\"cube\": (form: RoundedCube(radius: 0.7)), \"ball\": (form: Sphere, spheres: 3)",
        "\"0 deg\"",
        1,
    )
    .replace("1.7 GPa", "-1 GPa");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("study.ron");
    std::fs::write(&path, text).expect("a file");
    let error = erosion::load(&path, &[]).expect_err("faults").to_string();
    for told in [
        "study.ron:2:",
        "hardness",
        "`cube`",
        "below 0.5",
        "`ball`",
        "made of spheres",
        "angles.0",
        "least",
    ] {
        assert!(error.contains(told), "{told} is not in\n{error}");
    }
    let unknown =
        erosion::load(&path, &["samples.moste=3".into()]).expect_err("a word").to_string();
    assert!(unknown.contains("moste") && unknown.contains("most"), "{unknown}");
}

/// Fails for a case without a single result that ends the study, that is tried over and over, or that is told
/// as a number: at this speed every grain goes in as a whole.
#[test]
fn a_case_without_a_result_is_told_as_one() {
    let speeds = "speeds: [2000.0]";
    let file = study(&text(GRAINS, "\"90 deg\"", 6).replace("speeds: [98.1]", speeds));
    let folder = tempfile::tempdir().expect("a folder");
    let mut wide = file.clone();
    wide.samples.most = 600;
    for file in [&file, &wide] {
        let out = folder.path().join(file.samples.most.to_string());
        make(file, &file.cases(), &out);
        let result = erosion::result(file, Path::new(""), &out).expect("a result");
        for case in &result.cases {
            assert_eq!((case.impacts, case.missed.as_ref().map(|(count, _)| *count)), (0, Some(6)));
            assert_eq!(case.wear_ratio, None);
        }
        let table = result.table();
        assert!(table.contains("6 without a result") && !table.contains("NaN"), "{table}");
        erosion::write(&result, Path::new(""), &out).expect("files");
        let page = std::fs::read_to_string(out.join("report.html")).expect("a page");
        assert!(page.contains("sphere: no impact has a result."));
        assert!(page.contains("<td>-</td>") && !page.contains("NaN<") && !page.contains("NaN "));
        let csv = std::fs::read_to_string(out.join("cases.csv")).expect("a table");
        assert!(!csv.contains("NaN") && !csv.contains("inf"), "{csv}");
    }
}

/// Fails for a case that cannot be made and ends the study with it, or that nobody can name.
#[test]
fn a_case_that_cannot_be_made_leaves_the_others_alone() {
    let mut file = study(&text(GRAINS, "\"70 deg\"", 6));
    let folder = tempfile::tempdir().expect("a folder");
    let form = abrade_scene::scene::Form::Mesh { file: "gone.stl".into() };
    file.grains.get_mut("grit").expect("the grit").form = form;
    let cases = file.cases();
    let unmade = erosion::make(&file, Path::new(""), &cases, folder.path(), &mut crate::Quiet);
    let unmade = unmade.expect("the others");
    assert_eq!(unmade.len(), 1);
    let told = unmade[0].to_string();
    assert!(told.starts_with("case 0, grit at 98.1 m/s and 70 deg: "), "{told}");
    assert!(told.contains("gone.stl"), "{told}");
    assert!(erosion::is_made(&file, Path::new(""), &cases[1], folder.path()));
    let result = erosion::result(&file, Path::new(""), folder.path()).expect("the others");
    assert_eq!((result.missing(), result.cases.len(), result.grains.len()), (1, 1, 1));
    erosion::write(&result, Path::new(""), folder.path()).expect("files");
}

/// Counts how often it is asked.
struct Count(u32);

impl Progress for Count {
    fn advance(&mut self, _: f64, share: Option<f64>) -> bool {
        self.0 += 1;
        let share = share.expect("a share");
        assert!((share - f64::from(64 * self.0) / 300.0).abs() < 1e-12 || share == 1.0, "{share}");
        true
    }
}

/// Fails for a case that hears of an interrupt only when its fewest impacts are made.
#[test]
fn a_long_case_can_be_broken_off() {
    let file = study(&text("\"sphere\": (form: Sphere)", "\"90 deg\"", 300));
    let folder = tempfile::tempdir().expect("a folder");
    let mut count = Count(0);
    let made = erosion::make(&file, Path::new(""), &file.cases(), folder.path(), &mut count);
    assert_eq!((made.expect("impacts"), count.0), (vec![], 5));
}

/// Fails for faults that only turn up when the study is made, or not at all.
#[test]
fn what_cannot_be_made_is_refused_at_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("study.ron");
    std::fs::write(&path, text("\"sphere\": (form: Sphere)", "\"30 deg\"", 6)).expect("a file");
    let cases = [
        ("resolution=1000", "6.7e9 nodes", "at most"),
        ("target.elastic=Foundation(stiffness: -1.0)", "target.elastic.stiffness", "above zero"),
        ("target.elastic=HertzNodes(node_radius: 0.0)", "target.elastic.node_radius", "above zero"),
        ("speeds=[50, 60, 50]", "`speeds.2` is there twice", "leave it out"),
        ("angles=[\"30 deg\", \"30 deg\"]", "`angles.1` is there twice", "leave it out"),
    ];
    for (set, what, allowed) in cases {
        let error = erosion::load(&path, &[set.to_owned()]).expect_err(set).to_string();
        assert!(error.contains(what), "{set}: {error}");
        let told = format!("{:?}", erosion::load(&path, &[set.to_owned()]));
        assert!(told.contains(allowed), "{set}: {told}");
    }
    // What follows from a fault is none of its own.
    for set in ["speeds=[0]", "speeds=[-1]", "size.diameter=0", "angles=[0]"] {
        let error = erosion::load(&path, &[set.to_owned()]).expect_err(set);
        assert_eq!(error.problems.len(), 1, "{set}: {error}");
    }
}

/// Fails for a page that calls a ratio per mass one of masses, or of grains of one length one of equal mass.
#[test]
fn the_page_says_what_is_alike() {
    for (size, alike) in [("Volume", "of the same mass"), ("Feret", "of the same length")] {
        let text = text(
            "\"sphere\": (form: Sphere), \"cube\": (form: Polyhedron(kind: Cube))",
            "\"90 deg\"",
            6,
        );
        let file = study(&text.replace("Volume", size));
        let folder = tempfile::tempdir().expect("a folder");
        make(&file, &file.cases(), folder.path());
        let result = erosion::result(&file, Path::new(""), folder.path()).expect("a result");
        erosion::write(&result, Path::new(""), folder.path()).expect("files");
        let page = std::fs::read_to_string(folder.path().join("report.html")).expect("a page");
        assert!(page.contains("displaces, per mass,") && page.contains(alike), "{size}");
    }
}
