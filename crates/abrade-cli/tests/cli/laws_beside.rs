//! `Laws(..)` among the outputs of a scene: closed-form laws beside the impacts of a run.

use std::f64::consts::PI;

use abrade_laws::{Dnv, Finnie1960, Grit, Impact, Oka, Steel, SteelCurve};

use super::Folder;

/// Balls of 1 mm, one after the other, that strike a plate.
const STREAM: &str = r#"(
  version: 1,
  name: "stream",
  materials: { "steel": (hardness: "2 GPa", young: "200 GPa", friction: 0.3) },
  surfaces: {
    "plate": (
      material: "steel",
      geometry: HexStrip(length: "8 mm", width: "6 mm", pitch: "0.1 mm"),
    ),
  },
  bodies: {},
  streams: {
    "grit": (
      shape: Ball(radius: "0.5 mm"),
      density: 2650.0,
      count: 12,
      every: "1 ms",
      position: InFrame(surface: "plate", point: ("-2 mm", 0, "3 mm")),
      motion: Free(velocity: ("30 m/s", 0, "-25 m/s")),
      spread: "1 mm",
    ),
  },
  run: (step: "0.2 ms"),
  outputs: [Laws(
    names: ["finnie-1960", "oka-quartz", "dnv", "ecrc"],
    surface_density: "7800 kg/m3",
    given: { "sharpness": 0.5 },
  )],
)"#;

/// A ball that strikes a solid ball off its axis, which itself moves towards it.
const MOVING: &str = r#"(
  version: 1,
  name: "moving",
  materials: { "steel": (hardness: "2 GPa", young: "200 GPa", friction: 0.3) },
  surfaces: {
    "ball": (
      material: "steel",
      geometry: Sphere(radius: "3 mm", pitch: "0.15 mm"),
      motion: Kinematic(velocity: (0, 0, "10 m/s")),
    ),
  },
  bodies: {
    "grain": (
      shape: Ball(radius: "0.5 mm"),
      density: 2650.0,
      position: At(point: ("1.75 mm", 0, "4 mm")),
      motion: Free(velocity: (0, 0, "-20 m/s")),
    ),
  },
  run: (step: "10 us", stop: Impacts(count: 1)),
  outputs: [Laws(names: ["finnie-1960"])],
)"#;

/// The table of a run, its columns by name, and the summary.
fn run(folder: &Folder, scene: &str) -> (Vec<csv::StringRecord>, Vec<String>, serde_json::Value) {
    let said = folder.abrade(&["run", scene, "--out", "out", "--json"]);
    assert_eq!(said.code, Some(0), "{}", said.err);
    let mut table = csv::Reader::from_path(folder.0.join("out/impacts.csv")).unwrap();
    let head = table.headers().unwrap().iter().map(str::to_owned).collect();
    (table.records().map(Result::unwrap).collect(), head, serde_json::from_str(&said.out).unwrap())
}

/// Fails for an impact that is missing or counted twice, for speed or angle of another instant than the
/// touch, for a law with another's conditions, and for sums of other rows.
#[test]
fn laws_stand_beside_the_impacts_of_a_run() {
    let folder = Folder::new("laws beside");
    folder.write("stream.ron", STREAM);
    let (rows, head, summary) = run(&folder, "stream.ron");
    let laws = ["finnie-1960", "oka-quartz", "dnv", "ecrc"];
    assert_eq!(head[6..8], ["wear_volume_m3", "finnie-1960_m3"]);
    assert_eq!(rows.len(), 12);
    let mass = 2650.0 * PI / 6.0 * 1e-9;
    let hardness = 2e9;
    let (mut sums, mut worn) = ([0.0; 4], 0.0);
    for (i, row) in rows.iter().enumerate() {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        assert!(row[1].starts_with("grit") && &row[2] == "plate", "{row:?}");
        let impact = Impact { mass: number(3), speed: number(4), angle: number(5).to_radians() };
        assert!((impact.mass / mass - 1.0).abs() < 1e-9, "{row:?}");
        assert!((impact.speed / 30f64.hypot(25.0) - 1.0).abs() < 1e-9, "{row:?}");
        assert!((impact.angle.tan() / (25.0 / 30.0) - 1.0).abs() < 1e-9, "{row:?}");
        // It falls 2.5 mm at 25 m/s, from a disc that is tilted.
        assert!((number(0) - 1e-3 * i as f64 - 1e-4).abs() < 5e-5, "{row:?}");
        let oka = Oka { hardness, diameter: 1e-3, grit: Grit::QUARTZ };
        let zhang = SteelCurve::Zhang;
        let brinell = hardness / 9.806_65e6;
        let steel = Steel { curve: zhang, factor: zhang.factor(), brinell, sharpness: 0.5 };
        let by_hand = [
            Finnie1960::of(hardness).volume(&impact),
            oka.volume_per_mass(&impact) * mass,
            Dnv::STEEL.ratio(&impact) * mass / 7800.0,
            steel.ratio(&impact) * mass / 7800.0,
        ];
        for (k, wanted) in by_hand.into_iter().enumerate() {
            assert!((number(7 + k) / wanted - 1.0).abs() < 1e-9, "{}: {row:?}", laws[k]);
            sums[k] += wanted;
        }
        worn += number(6);
    }
    let close = |key: &str, wanted: f64| {
        let value = summary.pointer(key).and_then(serde_json::Value::as_f64).expect(key);
        assert!((value / wanted - 1.0).abs() < 1e-9, "{key}: {value:e} for {wanted:e}");
    };
    assert_eq!(summary.pointer("/laws/impacts"), Some(&12.into()));
    close("/laws/wear_volume_m3", worn);
    close("/surfaces/plate/wear_volume_m3", worn);
    for (name, sum) in laws.into_iter().zip(sums) {
        close(&format!("/laws/predicted_m3/{name}"), sum);
    }
    let said = folder.abrade(&["run", "stream.ron", "--out", "out"]);
    assert!(said.out.contains("  laws    12 impacts over, displaced "), "{}", said.out);
    // Without laws: no table, and the same wear.
    let said =
        folder.abrade(&["run", "stream.ron", "--out", "bare", "--json", "--set", "outputs=[]"]);
    let bare: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert!(bare["laws"].is_null() && !folder.0.join("bare/impacts.csv").exists());
    close(
        "/surfaces/plate/wear_volume_m3",
        bare["surfaces"]["plate"]["wear_volume_m3"].as_f64().unwrap(),
    );
}

/// Fails for a speed that is not that over the surface, and for an angle from a plane in the place of the
/// solid's face.
#[test]
fn an_impact_is_seen_from_the_surface_that_it_strikes() {
    let folder = Folder::new("laws moving");
    folder.write("moving.ron", MOVING);
    let (rows, _, _) = run(&folder, "moving.ron");
    assert_eq!(rows.len(), 1);
    let number = |column: usize| rows[0][column].parse::<f64>().unwrap();
    assert!((number(4) / 30.0 - 1.0).abs() < 1e-6, "{:?}", rows[0]);
    // Centres are 3.5 mm apart, 1.75 mm off the axis: 30 degrees from the normal. Nodes are 0.15 mm apart.
    assert!((number(5) - 60.0).abs() < 1.5, "{:?}", rows[0]);
}

/// Fails for a law that the run could not feed, and for a name that is not looked at.
#[test]
fn laws_that_cannot_be_told_are_refused_before_anything_runs() {
    let folder = Folder::new("bad laws beside");
    let refusal = |laws: &str| {
        let said = folder.abrade(&["run", "scene.ron", "--set", &format!("outputs=[{laws}]")]);
        assert_eq!(said.code, Some(2), "{laws}");
        said.err
    };
    for (laws, wanted) in [
        (r#"Laws(names: ["finie-1960"])"#, "did you mean `finnie-1960`?"),
        (r#"Laws(names: ["archard"])"#, "there is no law of impacts `archard`"),
        (r#"Laws(names: [])"#, "`Laws` names no law"),
        (r#"Laws(names: ["dnv"])"#, "`surface_density` must be given beside it"),
        (r#"Laws(names: ["ecrc"], surface_density: 7800.0)"#, "ecrc needs `sharpness`"),
        (
            r#"Laws(names: ["ecrc"], surface_density: 7800.0, given: {"sharpnes": 1.0})"#,
            "did you mean `sharpness`?",
        ),
        (r#"Laws(names: ["finnie-1960"], given: {"cutting": 2.0})"#, "`cutting` is 2; allowed is"),
        (r#"Laws(names: ["finnie-1960"]), Laws(names: ["finnie-1972"])"#, "`Laws` stands twice"),
    ] {
        let said = refusal(laws);
        assert!(said.contains(wanted), "{laws}: {said}");
    }
    assert_eq!(folder.files(), ["scene.ron"]);
}
