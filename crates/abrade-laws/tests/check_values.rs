//! The laws against values computed by others.

use abrade_laws::{Finnie1960, Law, LawError, laws};

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
    let names: [(&str, &'static str, Letters, f64); 12] = [
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

const OKA: Letters = &[("U", "speed"), ("D", "diameter"), ("Hv", "hardness"), ("alpha", "angle")];
const BRINELL: Letters =
    &[("U", "speed"), ("alpha", "angle"), ("BH", "brinell"), ("Fs", "sharpness")];

fn law(name: &str) -> &'static Law {
    laws().find(|law| law.name == name).expect("a law")
}

/// Laws about contacts that give a number.
const CONTACT: [&str; 3] = ["tabor", "maugis-lambda", "contact-modulus"];

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
        let value = law(name).evaluate(given).expect("a value");
        let wanted = factor * row[2].parse::<f64>().expect("a number");
        println!("{name} {}: {value:e}, {:.1e} off", &row[1], value / wanted - 1.0);
        assert!((value / wanted - 1.0).abs() < 1e-9, "{row:?}: {value:e}");
        seen.insert(name);
    }
    // Models of contacts have tables of their own, and `contact.rs` reads them.
    let others = laws().filter(|law| law.is_contact() || CONTACT.contains(&law.name));
    assert_eq!(seen.len() + others.count(), laws().count(), "{seen:?}");
}

/// From the unit of a row to SI.
fn scale(law: &str, parameter: &str) -> f64 {
    match (law, parameter) {
        (_, "angle" | "flank") => std::f64::consts::PI / 180.0,
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
