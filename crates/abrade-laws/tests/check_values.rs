//! The laws against values computed by others.

use abrade_laws::{Finnie1960, Law, LawError, Status, laws};

/// Every number of "m=1e-6kg U=50 alpha=30 F=21kN"; angles in degrees.
fn numbers(text: &str) -> Vec<(&str, f64)> {
    let fields = text.split_whitespace().filter_map(|field| field.split_once('='));
    let value = |text: &str| {
        let end = text.find(|c: char| !"0123456789.+-e".contains(c)).unwrap_or(text.len());
        let thousand = if text[end..].starts_with('k') && &text[end..] != "kg" { 1e3 } else { 1.0 };
        match &text[..end] {
            // The angle at which the law changes branch, rounded.
            "18.4349" => (1.0f64 / 3.0).atan().to_degrees(),
            number => thousand * number.parse::<f64>().expect("a number"),
        }
    };
    fields.map(|(name, text)| (name, value(text))).collect()
}

/// What the letters of a row stand for.
type Letters = &'static [(&'static str, &'static str)];

/// The law of a row, what its letters stand for, and the factor from its unit to the law's.
fn entry(row: &str) -> Option<(&'static str, Letters, f64)> {
    let names: [(&str, &'static str, Letters, f64); 20] = [
        (
            "Archard V",
            "archard",
            &[("K", "coefficient"), ("F", "load"), ("s", "way"), ("H", "hardness")],
            1.0,
        ),
        (
            "Archard depth",
            "archard-depth",
            &[("K", "coefficient"), ("p", "pressure"), ("s", "way"), ("H", "hardness")],
            1.0,
        ),
        (
            "Finnie1960",
            "finnie-1960",
            &[
                ("m", "mass"),
                ("U", "speed"),
                ("alpha", "angle"),
                ("p", "pressure"),
                ("psi", "depth_ratio"),
                ("K", "force_ratio"),
                ("c", "cutting"),
            ],
            1.0,
        ),
        (
            "Finnie1972",
            "finnie-1972",
            &[("m", "mass"), ("U", "speed"), ("alpha", "angle"), ("p", "pressure")],
            1.0,
        ),
        ("Oka SiO2", "oka-quartz", OKA, 1e-9),
        ("Oka SiC", "oka-carbide", OKA, 1e-9),
        ("Oka glass", "oka-glass", OKA, 1e-9),
        (
            "DNV steel",
            "dnv",
            &[("U", "speed"), ("alpha", "angle"), ("K", "factor"), ("n", "power")],
            1.0,
        ),
        ("E/CRC", "ecrc", BRINELL, 1.0),
        ("Ahlert", "ahlert", BRINELL, 1.0),
        (
            "Bitter W_D",
            "bitter",
            &[
                ("m", "mass"),
                ("U", "speed"),
                ("a", "angle"),
                ("eps", "deformation_energy"),
                ("K", "threshold"),
            ],
            1.0,
        ),
        ("Bitter v_el", "bitter-threshold", &[("y", "yield"), ("rho", "density")], 1.0),
        (
            "Bitter W_C",
            "bitter",
            &[
                ("m", "mass"),
                ("U", "speed"),
                ("a", "angle"),
                ("rho_c", "cutting_energy"),
                ("K", "threshold"),
                ("y", "yield"),
                ("rho", "density"),
            ],
            1.0,
        ),
        (
            "Neilson-Gilchrist",
            "neilson-gilchrist",
            &[
                ("m", "mass"),
                ("U", "speed"),
                ("a", "angle"),
                ("phi", "cutting_energy"),
                ("eps", "deformation_energy"),
                ("a0", "stopping_angle"),
                ("K", "threshold"),
            ],
            1.0,
        ),
        ("Tabakoff-Grant quartz-Al", "tabakoff-grant-aluminium", SPEED_AND_ANGLE, 1e-3),
        ("Tabakoff-Grant quartz-steel", "tabakoff-grant-steel", SPEED_AND_ANGLE, 1e-3),
        ("Arabnejad", "arabnejad", &[("U", "speed"), ("alpha", "angle"), ("Fs", "sharpness")], 1.0),
        (
            "Preston",
            "preston",
            &[("kp", "factor"), ("P", "pressure"), ("v", "speed"), ("t", "time")],
            1.0,
        ),
        ("Rabinowicz", "cone-groove", &[("F", "load"), ("H", "hardness"), ("theta", "flank")], 1.0),
        (
            "Sphere scratch",
            "ball-groove",
            &[("F", "load"), ("R", "radius"), ("H", "hardness")],
            1.0,
        ),
    ];
    let found = names.into_iter().find(|(start, ..)| row.starts_with(start))?;
    Some((found.1, found.2, found.3))
}

/// What the rows of Bitter leave out, for the other row has it: the compliance of E = 72e9/.17 and
/// 200e9/.3, and an energy that nothing takes.
const BITTER: [(&str, f64); 6] = [
    ("deformation_energy", 1e300),
    ("cutting_energy", 1e300),
    ("threshold", 0.7),
    ("yield", 1e9),
    ("density", 2650.0),
    ("compliance", (1.0 - 0.17 * 0.17) / 72e9 + 0.91 / 200e9),
];
const SPEED_AND_ANGLE: Letters = &[("U", "speed"), ("alpha", "angle")];
const OKA: Letters = &[("U", "speed"), ("D", "diameter"), ("Hv", "hardness"), ("alpha", "angle")];
const BRINELL: Letters =
    &[("U", "speed"), ("alpha", "angle"), ("BH", "brinell"), ("Fs", "sharpness")];

fn law(name: &str) -> &'static Law {
    laws().find(|law| law.name == name).expect("a law")
}

/// Laws without a row that gives their value.
const ELSEWHERE: [&str; 5] = ["tabor", "maugis-lambda", "contact-modulus", "evans", "huang"];

/// Fails for a power of the speed, of the angle or of the diameter that is not the law's.
#[test]
fn laws_to_be_fitted_have_their_powers() {
    let ratio = |name: &str, given: &[(&'static str, f64)], change: (&'static str, f64)| {
        let value = |change| {
            let given = given.iter().copied().chain(change);
            law(name).evaluate(given).expect("a value")
        };
        value(Some(change)) / value(None)
    };
    let evans = [
        ("speed", 10.0),
        ("radius", 1e-4),
        ("density", 2650.0),
        ("toughness", 1e6),
        ("hardness", 1e9),
        ("factor", 1.0),
    ];
    // The reference has this ratio as 8.97969638647.
    for (change, power) in [
        (("speed", 20.0), 19.0 / 6.0),
        (("radius", 2e-4), 11.0 / 3.0),
        (("density", 5300.0), 19.0 / 12.0),
        (("toughness", 2e6), -4.0 / 3.0),
        (("hardness", 2e9), -0.25),
    ] {
        assert!((ratio("evans", &evans, change).log2() - power).abs() < 1e-12, "{change:?}");
    }
    let cut = [
        ("speed", 10.0),
        ("angle", 0.3),
        ("diameter", 1e-4),
        ("cutting", 1.0),
        ("deformation", 0.0),
    ];
    assert!((ratio("huang", &cut, ("speed", 20.0)).log2() - 2.375).abs() < 1e-12);
    assert!((ratio("huang", &cut, ("diameter", 2e-4)).log2() - 0.5).abs() < 1e-12);
    let deep = [
        ("speed", 10.0),
        ("angle", 0.3),
        ("diameter", 1e-4),
        ("cutting", 0.0),
        ("deformation", 1.0),
    ];
    assert!((ratio("huang", &deep, ("speed", 20.0)).log2() - 2.3).abs() < 1e-12);
}

/// Fails for a law from memory that does not say so.
#[test]
fn what_is_from_memory_says_so() {
    let names: Vec<_> = laws()
        .filter(|law| law.status == Status::Memory)
        .map(|law| {
            assert!(
                law.from_memory.is_some() && law.source.contains("from memory"),
                "{}",
                law.name
            );
            law.name
        })
        .collect();
    assert_eq!(names.len(), 8, "{names:?}");
}

/// Fails for a branch that leaps where a particle stops along the surface.
#[test]
fn bitter_goes_on_where_the_particle_stops() {
    let at = |angle: f64| {
        let given = BITTER.into_iter().chain([("cutting_energy", 2.5e10), ("mass", 1e-6)]);
        law("bitter").evaluate(given.chain([("speed", 100.0), ("angle", angle)])).expect("a value")
    };
    let values: Vec<f64> = (0..90_000).map(|i| at(f64::from(i) * 1e-3f64.to_radians())).collect();
    let most = values.iter().copied().fold(0.0, f64::max);
    let leap = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    // The two branches differ by what K1 keeps: 1e-4 of the most.
    assert!(leap < 3e-4 * most, "{leap:e} of {most:e}");
    assert!(values.iter().all(|value| *value >= 0.0));
    assert_eq!(values[0], 0.0);
}

/// Fails for a wrong constant, branch, unit or power of any law.
#[test]
fn the_laws_give_the_values_of_the_reference() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/reference/wear_laws.csv");
    let mut reader = csv::Reader::from_path(path).expect("the table");
    let mut seen = std::collections::BTreeSet::new();
    for row in reader.records() {
        let row = row.expect("a row");
        let Some((name, letters, factor)) = entry(row[0].trim()) else { continue };
        let given: Vec<_> = numbers(&row[1])
            .into_iter()
            .filter_map(|(letter, value)| {
                let parameter = letters.iter().find(|(known, _)| *known == letter)?.1;
                Some((parameter, value * scale(name, parameter)))
            })
            .collect();
        assert_eq!(given.len(), letters.len(), "{row:?}");
        let left_out = BITTER.into_iter().filter(|(known, _)| law(name).find(known).is_ok());
        let left_out = left_out.filter(|_| name.starts_with("bitter"));
        let value = law(name).evaluate(left_out.chain(given)).expect("a value");
        let wanted = factor * row[2].parse::<f64>().expect("a number");
        println!("{name} {}: {value:e}, {:.1e} off", &row[1], value / wanted - 1.0);
        assert!((value / wanted - 1.0).abs() < 1e-9, "{row:?}: {value:e}");
        seen.insert(name);
    }
    // Models of contacts have tables of their own, and `contact.rs` reads them.
    let others = laws().filter(|law| law.is_contact() || ELSEWHERE.contains(&law.name));
    assert_eq!(seen.len() + others.count(), laws().count(), "{seen:?}");
}

/// From the unit of a row to SI.
fn scale(law: &str, parameter: &str) -> f64 {
    match (law, parameter) {
        (_, "angle" | "flank" | "stopping_angle") => std::f64::consts::PI / 180.0,
        (_, "diameter") => 1e-6,
        ("oka-quartz" | "oka-carbide" | "oka-glass", "hardness") => 1e9,
        ("ball-groove", "radius") => 1e-2,
        _ => 1.0,
    }
}

/// Fails for a peak that is not where the law has it.
#[test]
fn finnie_takes_most_where_he_says() {
    let law = Finnie1960::of(2.7e9);
    let at = |angle| law.volume(&abrade_laws::Impact { mass: 1e-6, speed: 50.0, angle });
    let peak = law.peak_angle();
    assert!((peak.to_degrees() - 16.845).abs() < 1e-3);
    assert!(at(peak) > at(peak - 1e-3) && at(peak) > at(peak + 1e-3));
}

/// Fails for a groove of a small ball that is lost in round-off, and for one deeper than the ball.
#[test]
fn a_groove_of_little_load_goes_as_its_three_halfth_power() {
    let section = |load| abrade_laws::groove_section(load, 1e9, 1.0);
    for load in [1e-12, 1e-6, 1e-3, 1.0, 1500.0] {
        let exponent = (section(1.01 * load) / section(load)).ln() / 1.01f64.ln();
        assert!((exponent - 1.5).abs() < 1e-6, "{load}: {exponent}");
    }
    assert_eq!(section(1e12), std::f64::consts::FRAC_PI_2);
}

/// Fails for a law that takes what it does not know, or goes on without what it needs.
#[test]
fn what_is_wrong_is_named_with_what_was_allowed() {
    let archard = law("archard");
    let given = [("load", 10.0), ("way", 1e3), ("hardness", 1e9), ("coefficient", 1e-4)];
    let error = |change: (&'static str, f64)| {
        archard.evaluate(given.into_iter().chain([change])).expect_err("refused").to_string()
    };
    assert_eq!(
        error(("speed", 1.0)),
        "archard has no parameter `speed`; it has `load`, `way`, `hardness`, `coefficient`"
    );
    assert_eq!(error(("hardness", 0.0)), "`hardness` is 0; allowed is a finite number above zero");
    assert_eq!(
        error(("load", f64::NAN)),
        "`load` is NaN; allowed is a finite number, zero or above"
    );
    let glass = [("speed", 1.0), ("angle", 0.5), ("hardness", 0.5), ("diameter", 1e-3)];
    let law = law("oka-glass").evaluate(glass);
    assert_eq!(law, Err(LawError::NotFinite { law: "oka-glass" }));
    assert_eq!(
        archard.evaluate(given[..2].iter().copied()),
        Err(LawError::Missing {
            law: "archard",
            name: "hardness",
            meaning: "hardness of the softer surface"
        })
    );
}

/// Fails for an entry whose formula asks for a parameter that it does not list, and for a constant
/// without a value.
#[test]
fn every_entry_is_whole() {
    for law in laws() {
        let usual = |unit| if unit == "Pa" { 1e9 } else { 0.5 };
        let conditions = law.parameters.iter().filter(|p| p.default.is_none());
        let given = conditions.map(|p| match p.name {
            // Less than the distance over which rigid surfaces keep apart.
            "displacement" => (p.name, 0.2),
            name => (name, usual(p.unit)),
        });
        assert!(law.evaluate(given).expect("a value").is_finite(), "{}", law.name);
        assert_eq!(laws().filter(|other| other.name == law.name).count(), 1, "{}", law.name);
    }
}
