//! `laws` and `laws contact`.

use super::Folder;

/// Fails for a law that takes degrees for radians or a unit for another, for a list that is not walked through, and for
/// one that is told in a unit in which nobody gave it.
#[test]
fn a_law_is_evaluated_where_it_is_asked_for() {
    let folder = Folder::new("laws");
    let given = ["mass=1 mg", "speed=50 m/s", "pressure=2.7 GPa"];
    let finnie =
        |rest: &[&str]| folder.abrade(&[&["laws", "finnie-1960"], &given[..], rest].concat());
    assert_eq!(finnie(&["angle=30 deg"]).out, "volume [m3] = 5.787e-14\n");
    let said = finnie(&["angle=30 deg, 90 deg", "--csv"]);
    let rows: Vec<_> = said.out.lines().collect();
    assert_eq!(rows[..2], ["angle [deg],volume [m3]", "30,5.787037037037038e-14"]);
    assert_eq!(rows.len(), 3);
    for mixed in ["angle=30 deg, 1", "angle=30deg, 1 rad"] {
        let said = finnie(&[mixed, "--csv"]);
        let rows: Vec<_> = said.out.lines().collect();
        assert_eq!(
            rows[..2],
            ["angle [rad],volume [m3]", "0.5235987755982988,5.787037037037038e-14"]
        );
    }
    // Of two values in two words the last would count alone.
    for twice in [
        &["laws", "finnie-1960", "mass=1 mg", "angle=10 deg", "angle=20 deg"][..],
        &["laws", "contact", "jkr", "radius=1 mm", "radius=2 mm"],
    ] {
        let said = folder.abrade(twice);
        assert_eq!(said.code, Some(2), "{}", said.out);
        assert!(said.err.contains("is given twice; several values go into one"), "{}", said.err);
    }
    let said = folder.abrade(&["laws", "--list"]);
    for law in ["archard\n", "oka-quartz\n", "status: seen; from memory"] {
        assert!(said.out.contains(law), "{}", said.out);
    }
}

/// Fails for a list that nobody can look over, and for a law that is not in it.
#[test]
fn laws_are_listed_in_a_line_each() {
    let folder = Folder::new("law titles");
    let told = folder.abrade(&["laws", "--list"]).out;
    // Of all that is told of a law, its name alone begins a line.
    let names: Vec<_> =
        told.lines().filter(|line| !line.is_empty() && !line.starts_with(' ')).collect();
    let titles = folder.abrade(&["laws"]).out;
    let lines: Vec<_> = titles.lines().take_while(|line| !line.is_empty()).collect();
    let firsts: Vec<_> = lines.iter().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(firsts, names);
    assert!(
        titles.ends_with("its value\n") && titles.contains("abrade laws NAME --list"),
        "{titles}"
    );
}

#[test]
fn what_a_law_cannot_take_is_bad_input() {
    let folder = Folder::new("bad laws");
    let error = |arguments: &[&str]| {
        let said = folder.abrade(&[&["laws"], arguments].concat());
        assert_eq!(said.code, Some(2));
        said.err
    };
    let said = error(&["finie-1960"]);
    let near =
        "error: there is no law `finie-1960`; did you mean `finnie-1960`? There are finnie-1960, ";
    assert!(said.starts_with(near), "{said}");
    assert_eq!(error(&["dnv", "speed=50"]), "error: dnv needs `angle`: angle from the surface\n");
    let said = error(&["dnv", "speed=50", "angle=30 mm"]);
    assert!(said.starts_with("error: `angle`: `mm` does not measure an angle; "), "{said}");
    let said = error(&["dnv", "speed=50, 60", "angle=0.1, 0.2"]);
    assert_eq!(said, "error: `speed` and `angle` are lists; one parameter may be\n");
}

/// The pair of the reference: R 1 mm, E* 1 GPa, w 0.1 J/m2.
const PAIR: [&str; 3] = ["radius=1 mm", "modulus=1 GPa", "adhesion=0.1 J/m2"];

/// The numbers of a table's columns.
fn columns(csv: &str) -> Vec<Vec<f64>> {
    let rows = csv.lines().skip(1);
    rows.map(|row| row.split(',').map(|field| field.parse().unwrap()).collect()).collect()
}

/// Fails for a branch without memory, for displacements that are not those asked for, and for a table
/// whose columns are swapped.
#[test]
fn a_contact_is_tabulated_on_both_branches() {
    let folder = Folder::new("contact");
    let asked =
        [&["laws", "contact", "jkr"], &PAIR[..], &["displacement=10 nm, -20 nm, -40 nm"]].concat();
    let said = folder.abrade(&[&asked[..], &["--csv"]].concat());
    assert_eq!(said.code, Some(0), "{}", said.err);
    let rows = columns(&said.out);
    let [apart, between, touching] = [&rows[0], &rows[1], &rows[2]];
    assert_eq!((rows.len(), apart[0]), (3, -40e-9));
    assert_eq!(apart[1..], [0.0; 4]);
    assert_eq!(between[1..3], [0.0; 2]);
    assert!(between[3] < -4.6e-4 && between[3] > -4.7124e-4, "{between:?}");
    assert_eq!(touching[1..3], touching[3..]);
    let said = folder.abrade(&[&asked[..], &["distance=0.3 nm"]].concat());
    for line in [
        "pull-off force -471 uN at a displacement of -16.7 nm",
        "holds from 0 nm on as they come together, to -34.7 nm as they part",
        "Tabor's parameter 71.8: this model holds",
    ] {
        assert!(said.out.contains(line), "{}", said.out);
    }
    assert_eq!(folder.files(), ["scene.ron"]);
}

/// Fails for two sides that are not reduced, or reduced to those of one.
#[test]
fn a_contact_takes_the_materials_of_its_sides() {
    let folder = Folder::new("sides");
    let force = |given: &[&str]| {
        let fixed = ["laws", "contact", "hertz", "displacement=1 um", "--csv"];
        let said = folder.abrade(&[&fixed[..], given].concat());
        assert_eq!(said.code, Some(0), "{}", said.err);
        columns(&said.out)[0][1]
    };
    let pair = force(&["young=200 GPa, 70 GPa", "poisson=0.3, 0.22", "radius=2 mm, 1 mm"]);
    let modulus = 1.0 / (0.91 / 200e9 + 0.9516 / 70e9);
    let wanted = 4.0 / 3.0 * modulus * (2e-3f64 / 3.0).sqrt() * 1e-9;
    assert!((pair / wanted - 1.0).abs() < 1e-12, "{pair} for {wanted}");
    let rigid = force(&["young=200 GPa", "poisson=0.3", "radius=2 mm"]);
    let wanted = 4.0 / 3.0 * (200e9 / 0.91) * 2e-3f64.sqrt() * 1e-9;
    assert!((rigid / wanted - 1.0).abs() < 1e-12, "{rigid} for {wanted}");
}

/// Fails for a picture that is not written, or not without a word, and for limits that are not DMT's and JKR's.
#[test]
fn contacts_and_their_limits_are_drawn() {
    let folder = Folder::new("contact pictures");
    let curve = [
        &["laws", "contact", "maugis-dugdale"],
        &PAIR[..],
        &["strength=0.1 GPa", "--out", "a.png"],
    ];
    let said = folder.abrade(&curve.concat());
    assert!(said.out.ends_with("\na.png\n"), "{}{}", said.out, said.err);
    let said = folder.abrade(&["laws", "contact", "--limits", "--csv", "--out", "b.png"]);
    let rows = columns(&said.out);
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    assert_eq!([first[2], first[4]], [-2.0, -1.5]);
    assert!((first[3] + 2.0).abs() < 1e-4 && (last[3] + 1.5).abs() < 1e-4, "{first:?}, {last:?}");
    assert!(rows.windows(2).all(|pair| pair[0][3] < pair[1][3]));
    let list = folder.abrade(&["laws", "contact"]).out;
    assert!(list.contains("abrade laws contact --limits --out FILE.png"), "{list}");
    let nothing = folder.abrade(&["laws", "contact", "--out", "c.png"]);
    assert_eq!(nothing.code, Some(2));
    assert!(nothing.err.contains("name a model, or ask for --limits"), "{}", nothing.err);
    assert_eq!(folder.files(), ["a.png", "b.png", "scene.ron"]);
}

#[test]
fn what_a_contact_cannot_take_is_bad_input() {
    let folder = Folder::new("bad contacts");
    let error = |arguments: &[&str]| {
        let said = folder.abrade(&[&["laws", "contact"], arguments].concat());
        assert_eq!(said.code, Some(2));
        said.err
    };
    let said = error(&["jkrr"]);
    assert!(
        said.starts_with("error: there is no contact model `jkrr`; did you mean `jkr`? There are "),
        "{said}"
    );
    let said = error(&["hertz", "raduis=1 mm"]);
    assert!(said.ends_with("; did you mean `radius`?\n"), "{said}");
    let said = error(&["hertz", "radius=1 mm"]);
    assert!(said.starts_with("error: hertz needs `modulus`: "), "{said}");
    let said = error(&["hertz", "radius=1 mm", "young=1 GPa"]);
    assert_eq!(said, "error: `young` and `poisson` are needed of the same sides\n");
    let said = error(&[&["jkr", "--out", "a.svg"], &PAIR[..]].concat());
    assert!(said.contains("expected a file that ends in .png"), "{said}");
    let bradley =
        ["bradley", "radius=1 mm", "adhesion=0.1", "distance=0.3 nm", "displacement=1 nm"];
    let said = error(&bradley);
    assert!(said.contains("rigid surfaces keep a gap"), "{said}");
    assert_eq!(folder.files(), ["scene.ron"]);
}
