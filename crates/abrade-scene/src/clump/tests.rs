//! Each format is read as its programs write it, and a bad line is named.

use proptest::prelude::*;

use super::*;

fn read_text(text: &str) -> Result<ClumpFile, ClumpError> {
    parse(Path::new("clump.txt"), text)
}

fn spheres(text: &str) -> Vec<[f64; 4]> {
    let clump = read_text(text).unwrap();
    clump.spheres.iter().map(|s| [s.centre.x, s.centre.y, s.centre.z, s.radius]).collect()
}

fn refusal(text: &str) -> String {
    read_text(text).unwrap_err().to_string()
}

#[test]
fn rows_are_read_whatever_separates_them() {
    let expected = [[0.375, 0.25, -0.0, 0.216506], [-0.25, 0.0, 1.0, 0.433013]];
    for text in [
        "  0.375000,  0.250000, -0.000000,  0.216506\n -0.250000,  0.000000, 1,  0.433013\n",
        "# CLUMP\r\n0.375\t0.25\t-0\t0.216506\r\n\r\n-0.25 0 1 0.433013 # last\r\n",
        "x,y,z,r\n0.375,0.25,-0.0,0.216506\n-0.25,0,1,0.433013",
        "radius;z;y;x\n0.216506;-0.0;0.25;0.375\n0.433013;1;0;-0.25",
        "\u{feff}X Y Z R\n3.75e-1 .25 -0 0.216506 1\n-.25 0. 1. 0.433013 2\n",
        "c1 c2 c3 c4\n0.375 0.25 -0 0.216506\n-0.25 0 1 0.433013\n",
    ] {
        assert_eq!(spheres(text), expected, "{text}");
    }
}

#[test]
fn a_bad_line_is_named_with_its_text() {
    assert_eq!(
        refusal("0 0 0 1\n0 0 zero 1\n"),
        "clump.txt:2: `zero` is not a finite number; the line is `0 0 zero 1`"
    );
    assert_eq!(
        refusal("0 0 0 1\n\n1 2 3\n"),
        "clump.txt:3: it has 3 columns, 4 (x, y, z, radius) are expected; the line is `1 2 3`"
    );
    assert_eq!(
        refusal("0 0 0 -1\n"),
        "clump.txt:1: the radius -1 is not above zero; the line is `0 0 0 -1`"
    );
    assert_eq!(
        refusal("0 0 0 inf"),
        "clump.txt:1: `inf` is not a finite number; the line is `0 0 0 inf`"
    );
    assert_eq!(refusal("# nothing\n"), "`clump.txt` has no spheres");
}

const KRATOS: &str = "//\n//   Cluster Name: \"pair\"\n//\n\nName\npair\n\nBegin centers_and_radii\n\
    -0.5 0 0 1\n0.5 0 0 1\nEnd centers_and_radii\n\nParticle_center_and_diameter\n0.1 0 0 3\n\n\
    Size\n3\n\nVolume\n5.5\n\nInertia per unit mass\n0.4\n0.6\n0.6\n";

#[test]
fn a_kratos_cluster_gives_its_own_properties() {
    let clump = read_text(KRATOS).unwrap();
    assert_eq!(clump.format, Format::Kratos);
    assert_eq!(spheres(KRATOS), [[-0.5, 0.0, 0.0, 1.0], [0.5, 0.0, 0.0, 1.0]]);
    assert_eq!(clump.given.volume, Some(5.5));
    assert_eq!(clump.given.centre, Some(Point3::new(0.1, 0.0, 0.0)));
    let report = clump.report().unwrap();
    let own = clump.properties(Source::File, Some(2.0), &report.union).unwrap();
    assert_eq!(own.inertia.mass, 11.0);
    assert_eq!(own.inertia.tensor, Matrix3::from_diagonal(&[4.4, 6.6, 6.6].map(|t: f64| t).into()));
    assert!(refusal(&KRATOS.replace("End centers_and_radii", "")).contains("Particle_center"));
}

#[test]
fn a_lammps_molecule_gives_its_own_properties() {
    let text = "a pair # of spheres\n\n2 atoms\n11 mass\n0.1 0 0 com\n4.4 6.6 6.6 0 0 0 inertia\n\n\
        Coords\n\n2 0.5 0 0\n1 -0.5 0 0\n\nTypes\n\n1 1\n2 1\n\nDiameters\n\n1 2\n2 2\n";
    let text = text.replacen("a pair # of", "# a pair of", 1);
    let clump = read_text(&text).unwrap();
    assert_eq!(clump.format, Format::Lammps);
    assert_eq!(spheres(&text), [[-0.5, 0.0, 0.0, 1.0], [0.5, 0.0, 0.0, 1.0]]);
    assert_eq!(clump.given.mass, Some(11.0));
    assert_eq!(clump.given.tensor_per_mass.unwrap()[(1, 1)], 6.6 / 11.0);
    assert_eq!(
        refusal(&text.replace("2 0.5 0 0", "3 0.5 0 0")),
        "clump.txt:10: there is no atom 3 among 2; the line is `3 0.5 0 0`"
    );
    assert!(refusal(&text.replace("2 2\n", "")).contains("atom 2 has no `Diameters`"));
}

#[test]
fn what_is_written_is_read_back() {
    let clump = read_text("-0.5 0 0 1\n0.7 0.1 0.3 0.8\n").unwrap();
    let union = clump.report().unwrap().union;
    for format in [Format::Xyzr, Format::Csv, Format::MClump, Format::Kratos, Format::Lammps] {
        let text = write(&clump, format, 2500.0, &union);
        let back = read_text(&text).unwrap();
        assert_eq!(back.spheres, clump.spheres, "{}", format.name());
        let report = back.report().unwrap();
        for difference in [report.volume_difference, report.inertia_difference] {
            assert!(
                difference.is_none_or(|d| d.abs() < 1e-12),
                "{}: {difference:?}",
                format.name()
            );
        }
    }
}

#[test]
fn an_mclump_folder_gives_mass_and_inertia() {
    let folder = std::env::temp_dir().join(format!("abrade-mclump-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("Clump")).unwrap();
    std::fs::create_dir_all(folder.join("Inertia")).unwrap();
    std::fs::write(folder.join("Clump/Clump.txt"), "-1,0,0,1\n1,0,0,1\n").unwrap();
    std::fs::write(folder.join("Inertia/Mass.txt"), "8.0\n").unwrap();
    std::fs::write(folder.join("Inertia/TOI.txt"), "3.2,0,0\n0,11.2,0\n0,0,11.2\n").unwrap();
    let by_folder = read(&folder).unwrap();
    let by_file = read(&folder.join("Clump/Clump.txt")).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!(by_folder, by_file);
    assert_eq!(by_folder.format, Format::MClump);
    assert!(by_folder.report().unwrap().inertia_difference.unwrap() < 1e-12);
}

#[test]
fn the_overlap_is_counted_once() {
    let report = read_text("0 0 0 1\n1 0 0 1\n9 0 0 1\n").unwrap().report().unwrap();
    assert_eq!(report.overlapping_pairs, 1);
    let lens = 5.0 / 12.0 * std::f64::consts::PI;
    assert!((report.overlap_share() - lens / (4.0 * std::f64::consts::PI)).abs() < 1e-5);
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(
        head in prop::sample::select(vec!["", "Begin centers_and_radii\n", "2 atoms\nCoords\n", "x y z r\n"]),
        body in r"([0-9.eE+-]{1,4}|[ ,;\n\t#]|Diameters|Volume\n|atoms|mass|inertia|nan|inf|µ){0,60}",
    ) {
        let _ = read_text(&format!("{head}{body}"));
    }
}
