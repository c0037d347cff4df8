//! Contact models against values computed by others, and against each other.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use abrade_laws::contact::{
    Advice, Before, Bradley, CohesionArea, Contact, ContactError, ContactModel, Dmt, Hertz, Jkr,
    MaugisDugdale, Pair, Side, SimplifiedJkr, branches, maugis_lambda, tabor,
};
use abrade_laws::{Law, laws};

/// R* [m], E* [Pa], w [J/m2] of the reference.
const RADIUS: f64 = 1e-3;
const MODULUS: f64 = 1e9;
const ADHESION: f64 = 0.1;

fn pair() -> Pair {
    Pair::new(RADIUS, MODULUS).unwrap()
}

fn jkr() -> Jkr {
    Jkr::new(pair(), ADHESION).unwrap()
}

fn assert_close(name: &str, value: f64, wanted: f64) {
    println!("{name}: {value:e}, {:.1e} off", value / wanted - 1.0);
    assert!((value / wanted - 1.0).abs() < 1e-9, "{name}: {value:e} for {wanted:e}");
}

fn rows(name: &str) -> Vec<csv::StringRecord> {
    let path = format!("{}/../../tests/reference/{name}.csv", env!("CARGO_MANIFEST_DIR"));
    csv::Reader::from_path(path).unwrap().records().map(Result::unwrap).collect()
}

/// Fails for a wrong constant, power or sign of any model, and for E* in the place of 4 E*/3, whose
/// values the table has, too.
#[test]
fn the_models_give_the_values_of_the_reference() {
    let hertz = Hertz::new(pair());
    let (dmt, simple) =
        (Dmt::new(pair(), ADHESION).unwrap(), SimplifiedJkr::new(pair(), ADHESION).unwrap());
    let bradley = Bradley::new(RADIUS, ADHESION, 0.3e-9).unwrap();
    let jkr = jkr();
    let force = |model: &dyn ContactModel, d: f64| model.at(d, Before::Touching).unwrap().force;
    let part = jkr.parting();
    let [a, rest, torn] = [1.0, 0.0, part.pull_off].map(|load| jkr.radius_under(load).unwrap());
    let hertz_at = hertz.radius_under(1.0).unwrap().powi(2) / RADIUS;
    let tears = part.tears_at.unwrap();
    let ours: [(&str, f64); 22] = [
        ("Hertz a(F=1N,R=1mm,E*=1GPa)", hertz.radius_under(1.0).unwrap()),
        ("Hertz delta", hertz_at),
        ("Hertz p0", hertz.peak_pressure(1.0).unwrap()),
        ("Hertz F(delta)=4/3 E* sqrt(R) d^1.5", force(&hertz, hertz_at)),
        ("JKR pull-off -1.5 pi w R", part.pull_off),
        ("JKR a(F=1N)", a),
        ("JKR check F(a)=4E*a^3/3R-sqrt(8 pi w E* a^3)", jkr.force_with(a).unwrap()),
        ("JKR delta(a)=a^2/R-sqrt(2 pi w a/E*)", jkr.displacement_with(a).unwrap()),
        ("JKR a at F=0: (9 pi w R^2/2E*)^(1/3)", rest),
        ("JKR a at pull-off (9 pi w R^2/8E*)^(1/3)", torn),
        ("JKR delta at load-control pull-off", part.pull_off_at),
        ("JKR delta at displacement-control tear-off = -(3/4)(pi^2 w^2 R/E*^2)^(1/3)", tears),
        (
            "closed form",
            -0.75 * (PI * PI * ADHESION * ADHESION * RADIUS / MODULUS / MODULUS).cbrt(),
        ),
        ("JKR F at displacement-control tear-off = -5/6 pi w R", force(&jkr, tears)),
        ("SJKR (a^2=R d, correct coeffs) F at d=10um", force(&simple, 1e-5)),
        ("SJKR pull-off (=-1.5 pi w R)", simple.parting().pull_off),
        ("SJKR delta at pull-off (>0!)", simple.parting().pull_off_at),
        ("DMT pull-off -2 pi w R", dmt.parting().pull_off),
        ("DMT a(F=1N) (3R/4E*(F+2 pi w R))^(1/3)", dmt.radius_under(1.0).unwrap()),
        ("Bradley F(z=z0) = -2 pi w R", bradley.force_over(0.3e-9).unwrap()),
        ("Bradley F(2 z0)", force(&bradley, -0.3e-9)),
        ("Tabor mu=(R w^2/(E*^2 z0^3))^(1/3), z0=0.3nm", tabor(&pair(), ADHESION, 0.3e-9).unwrap()),
    ];
    let ours: BTreeMap<_, _> = ours.into_iter().collect();
    let rest_gap = 1.0 - bradley.parting().rests_at / 0.3e-9;
    let mut read = 0;
    for row in rows("contact_models") {
        let (name, wanted) = (row[0].trim(), row[1].parse::<f64>().unwrap());
        match ours.get(name) {
            Some(value) => assert_close(name, *value, wanted),
            None if name.starts_with("Bradley zero-force") => assert_close(name, rest_gap, wanted),
            // What a formula with E* for K gives: a tenth or more off, and said so in the docs.
            None => {
                assert!(name.starts_with("BLOG"), "{name} is not compared");
                continue;
            }
        }
        read += 1;
    }
    assert_eq!(read, ours.len() + 1);
}

/// Fails for a branch, root or minimum of the transition that is not Maugis'.
#[test]
fn the_transition_from_dmt_to_jkr_is_that_of_the_reference() {
    let rows = rows("maugis_dugdale_pulloff");
    assert_eq!(rows.len(), 13);
    let unit = maugis_lambda(&pair(), ADHESION, 1.0).unwrap();
    for row in rows {
        let [lambda, mu, force, radius, fit] =
            [0, 1, 2, 3, 4].map(|i| row[i].parse::<f64>().unwrap());
        let model = MaugisDugdale::new(pair(), ADHESION, lambda / unit).unwrap();
        let by_tabor = MaugisDugdale::with_tabor(pair(), ADHESION, mu).unwrap();
        assert_close("lambda", by_tabor.lambda(), lambda);
        let part = model.parting();
        let reduced = part.pull_off / (PI * ADHESION * RADIUS);
        assert_close(&format!("lambda {lambda}"), reduced, force);
        let at = model.at(part.pull_off_at, Before::Touching).unwrap();
        let wide = (PI * ADHESION * RADIUS * RADIUS / (4.0 / 3.0 * MODULUS)).cbrt();
        println!("  A {:e} for {radius:e}", at.radius / wide);
        // The table's place was found by trial, where the force is flat: at lambda 0.01 the root of the
        // slope, in forty digits, is 0.020910249889948.
        assert!((at.radius / wide / radius - 1.0).abs() < 1e-5, "{:e}", at.radius / wide);
        assert!((reduced / fit - 1.0).abs() < 0.02, "the fit of Carpick, Ogletree and Salmeron");
    }
}

/// Every model at a scale at which its curve is not a straight line.
fn all() -> Vec<(&'static str, Box<dyn ContactModel>)> {
    let maugis = |tabor| Box::new(MaugisDugdale::with_tabor(pair(), ADHESION, tabor).unwrap());
    vec![
        ("Hertz", Box::new(Hertz::new(pair()))),
        ("JKR", Box::new(jkr())),
        ("simplified JKR", Box::new(SimplifiedJkr::new(pair(), ADHESION).unwrap())),
        ("cohesion area", Box::new(CohesionArea::new(pair(), 1e7, 2.0).unwrap())),
        ("DMT", Box::new(Dmt::new(pair(), ADHESION).unwrap())),
        ("Bradley", Box::new(Bradley::new(RADIUS, ADHESION, 0.3e-9).unwrap())),
        ("Maugis-Dugdale 0.05", maugis(0.05)),
        ("Maugis-Dugdale 0.5", maugis(0.5)),
        ("Maugis-Dugdale 1", maugis(1.0)),
        ("Maugis-Dugdale 20", maugis(20.0)),
    ]
}

fn unloading(model: &dyn ContactModel, displacement: f64) -> Contact {
    model.at(displacement, Before::Touching).unwrap()
}

/// Work against the force of the unloading branch from a displacement down to `size` less, by places that
/// are closer to the end, where the slope may be infinite; no place may lack what it `holds`.
fn pull_along(
    model: &dyn ContactModel,
    from: f64,
    size: f64,
    holds: &dyn Fn(&Contact) -> bool,
) -> f64 {
    let count = 20_000;
    let parts = (0..count).map(|i| {
        let [near, middle, far] = [0.0, 0.5, 1.0].map(|k| (f64::from(i) + k) / f64::from(count));
        let contact = unloading(model, from - size * (1.0 - middle * middle));
        assert!(holds(&contact), "{contact:?}");
        size * (far * far - near * near) * contact.force
    });
    -parts.sum::<f64>()
}

/// Fails for a rest, a least force, a tear or a work that the curve itself does not have.
#[test]
fn what_parts_the_bodies_is_what_their_curve_says() {
    for (name, model) in all() {
        let part = model.parting();
        let size = part.rests_at - part.tears_at.unwrap_or(-20.0 * 0.3e-9);
        let scale = part.pull_off.abs();
        if name == "Hertz" {
            assert_eq!((size, scale, part.work), (0.0, 0.0, 0.0));
            continue;
        }
        let rest = unloading(model.as_ref(), part.rests_at);
        assert!(rest.force.abs() < 1e-9 * scale, "{name}: {:e} at rest", rest.force);
        let least = unloading(model.as_ref(), part.pull_off_at);
        assert!((least.force - part.pull_off).abs() < 1e-9 * scale, "{name}: {:e}", least.force);
        let holds = |contact: &Contact| contact.force >= part.pull_off - 1e-9 * scale;
        let work = pull_along(model.as_ref(), part.rests_at, size, &holds);
        println!("{name}: work {:e} J, {:.1e} off", part.work, work / part.work - 1.0);
        // Of Bradley's force that reaches on for ever, what is beyond 20 z0.
        let tail = match name {
            "Bradley" => 8.0 / 3.0 * PI * ADHESION * RADIUS * 0.3e-9 / 21.0,
            _ => 0.0,
        };
        assert!(((work + tail) / part.work - 1.0).abs() < 1e-5, "{name}: {work:e}");
        if let (Some(touch), Some(tear)) = (part.touches_at, part.tears_at) {
            let loss = pull_along(model.as_ref(), touch, touch - tear, &holds);
            assert!((loss - part.loss).abs() <= 1e-5 * part.loss, "{name}: {loss:e}");
        }
        if let Some(tear) = part.tears_at {
            let beyond = unloading(model.as_ref(), tear - 1e-6 * size);
            assert_eq!((beyond.force, beyond.after), (0.0, Before::Apart), "{name}");
            assert_eq!(
                unloading(model.as_ref(), tear + 1e-6 * size).after,
                Before::Touching,
                "{name}"
            );
        }
    }
}

/// Fails for a contact without memory, for one that holds before it has touched, and for a tear on the
/// way in.
#[test]
fn jkr_holds_beyond_contact_only_what_was_touching() {
    let model = jkr();
    let ways: Vec<f64> = (-40..=10).map(|i| 1e-9 * f64::from(i)).collect();
    let walk = branches(&model, ways).unwrap();
    let tear = model.parting().tears_at.unwrap();
    for (i, d) in walk.displacements.iter().enumerate() {
        let [up, down] = [walk.loading[i], walk.unloading[i]];
        assert_eq!(up.force != 0.0, *d >= 0.0, "coming together at {d:e}");
        assert_eq!(down.force != 0.0, *d >= tear, "parting at {d:e}");
        assert!(*d < 0.0 || up == down, "one curve in contact");
    }
    let first = model.at(0.0, Before::Apart).unwrap().force;
    assert_close("JKR at first touch", first, -4.0 / 3.0 * PI * ADHESION * RADIUS);
}

/// Fails for a branch of the transition that is not a solution of Maugis' own equations, or that leaps
/// where the contact closes.
#[test]
fn the_transition_solves_maugis_equations() {
    let k = 4.0 / 3.0 * MODULUS;
    let short = ((PI * ADHESION / k).powi(2) * RADIUS).cbrt();
    let wide = (PI * ADHESION * RADIUS * RADIUS / k).cbrt();
    for tabor in [0.01, 0.1, 0.5, 0.6, 2.0, 30.0] {
        let model = MaugisDugdale::with_tabor(pair(), ADHESION, tabor).unwrap();
        let lambda = model.lambda();
        let part = model.parting();
        let tear = part.tears_at.unwrap() / short;
        let mut last: Option<Contact> = None;
        for i in 0..2000 {
            let reduced = tear + 1e-12 + 4.0 * (f64::from(i) / 2000.0).powi(2);
            let contact = unloading(&model, reduced * short);
            if let Some(last) = last {
                // The curve's slope is infinite at the tear; ways grow with the distance from it.
                let leap = (contact.force - last.force).abs() / (PI * ADHESION * RADIUS);
                assert!(leap < 0.05, "tabor {tabor} leaps by {leap} at {reduced}");
            }
            last = Some(contact);
            let a = contact.radius / wide;
            if a < 1e-3 {
                continue;
            }
            // From displacement and radius: m; then both other equations.
            let root = (a * a - reduced) / (4.0 / 3.0 * lambda * a);
            let m = (1.0 + root * root).sqrt();
            let angle = root.atan();
            let first = 0.5 * lambda * a * a * (root + (m * m - 2.0) * angle)
                + 4.0 / 3.0 * lambda * lambda * a * (root * angle - m + 1.0);
            let force = a.powi(3) - lambda * a * a * (root + m * m * angle);
            let ours = contact.force / (PI * ADHESION * RADIUS);
            // In JKR's limit the equations themselves are differences of near equals.
            assert!((first - 1.0).abs() < 1e-7, "tabor {tabor}: {first} at {reduced}");
            assert!(
                (force - ours).abs() < 1e-7 * (1.0 + ours.abs()),
                "tabor {tabor}: {force}, {ours}"
            );
        }
    }
}

/// Fails for a transition that ends elsewhere than at the models it lies between, and for advice that
/// takes one where it is far off.
#[test]
fn the_transition_ends_at_dmt_and_at_jkr() {
    let dmt = Dmt::new(pair(), ADHESION).unwrap();
    let far = |tabor: f64, model: &dyn ContactModel| {
        let ours = MaugisDugdale::with_tabor(pair(), ADHESION, tabor).unwrap();
        let pairs = [0.1e-7, 0.5e-7, 1e-7].map(|d| (unloading(&ours, d), unloading(model, d)));
        let forces = pairs.map(|(a, b)| (a.force - b.force).abs() / model.parting().pull_off.abs());
        forces.into_iter().fold(0.0, f64::max)
    };
    // To DMT as the root of lambda: the ring of attraction is then wide beside the contact.
    let [near, nearer] = [1e-3, 1e-5].map(|tabor| far(tabor, &dmt));
    assert!(nearer < 0.02 && (near / nearer - 10.0).abs() < 1.0, "{near}, {nearer}");
    let [near, nearer] = [1e2, 1e3].map(|tabor| far(tabor, &jkr()));
    assert!(nearer < 1e-3 && near / nearer > 9.0, "{near}, {nearer}");
    let pull =
        |tabor| MaugisDugdale::with_tabor(pair(), ADHESION, tabor).unwrap().parting().pull_off;
    let [low, high] = Advice::LIMITS;
    println!(
        "{} of DMT, {} of JKR",
        pull(low) / dmt.parting().pull_off,
        pull(high) / jkr().parting().pull_off
    );
    assert!((pull(low) / dmt.parting().pull_off - 0.97).abs() < 5e-3);
    assert!((pull(high) / jkr().parting().pull_off - 1.004).abs() < 1e-3);
    let names = [0.09, 1.0, 5.1].map(|mu| Advice::of(mu).name());
    assert_eq!(names, ["dmt", "maugis-dugdale", "jkr"]);
    // 7.09 (w^5 R^4 / E*^2)^(1/3) is lost when bodies that JKR holds part (Thornton & Ning, 1998).
    let unit = (ADHESION.powi(5) * RADIUS.powi(4) / MODULUS / MODULUS).cbrt();
    assert!((jkr().parting().loss / unit - 7.09).abs() < 5e-3, "{}", jkr().parting().loss / unit);
}

/// Fails for radii or moduli that are added and not their inverses.
#[test]
fn a_pair_is_softer_and_smaller_than_its_sides() {
    let steel = Side { radius: 2e-3, young: 200e9, poisson: 0.3 };
    let ball = Side { radius: 1e-3, young: 70e9, poisson: 0.22 };
    let pair = Pair::of([steel, ball]).unwrap();
    assert_close("R", pair.radius(), 2e-3 / 3.0);
    assert_close("E*", pair.modulus(), 1.0 / (0.91 / 200e9 + 0.9516 / 70e9));
    let flat = Pair::of([steel, Side::RIGID_FLAT]).unwrap();
    assert_close("flat", flat.radius(), 2e-3);
    assert_close("rigid", flat.modulus(), 200e9 / 0.91);
}

/// Fails for an entry of the catalogue that hands one constant on as another.
#[test]
fn the_catalogue_gives_what_the_models_give() {
    let given = [
        ("radius", RADIUS),
        ("modulus", MODULUS),
        ("adhesion", ADHESION),
        ("cohesion", 1e7),
        ("distance", 0.3e-9),
        ("strength", 2e8),
    ];
    let maugis = MaugisDugdale::new(pair(), ADHESION, 2e8).unwrap();
    let simple = SimplifiedJkr::new(pair(), ADHESION).unwrap();
    let models: [(&str, &dyn ContactModel); 7] = [
        ("hertz", &Hertz::new(pair())),
        ("jkr", &jkr()),
        ("simplified-jkr", &simple),
        ("cohesion-area", &CohesionArea::new(pair(), 1e7, 2.0).unwrap()),
        ("dmt", &Dmt::new(pair(), ADHESION).unwrap()),
        ("bradley", &Bradley::new(RADIUS, ADHESION, 0.3e-9).unwrap()),
        ("maugis-dugdale", &maugis),
    ];
    let find = |name: &str| laws().find(|law| law.name == name).unwrap();
    let take = |law: &Law| {
        let knows = |(name, _): &(&str, f64)| law.find(name).is_ok();
        given.into_iter().filter(knows).collect::<Vec<_>>()
    };
    for (name, model) in models {
        let law = find(name);
        let d = 0.1e-9;
        let value = law.evaluate(take(law).into_iter().chain([("displacement", d)])).unwrap();
        assert_eq!(value, unloading(model, d).force, "{name}");
        assert_eq!(law.contact(take(law)).unwrap().parting(), model.parting(), "{name}");
    }
    assert_eq!(laws().filter(|law| law.is_contact()).count(), models.len());
    for (name, wanted) in
        [("tabor", tabor(&pair(), ADHESION, 0.3e-9).unwrap()), ("maugis-lambda", maugis.lambda())]
    {
        assert_eq!(find(name).evaluate(take(find(name))).unwrap(), wanted);
    }
    let sides = [("young", 200e9), ("poisson", 0.3), ("young_2", 70e9), ("poisson_2", 0.22)];
    let modulus = find("contact-modulus").evaluate(sides).unwrap();
    assert_close("E*", modulus, 1.0 / (0.91 / 200e9 + 0.9516 / 70e9));
    assert!(find("archard").contact([]).is_err());
}

/// Fails for a model that goes on with what it cannot have.
#[test]
fn what_no_model_takes_is_refused_with_what_was_allowed() {
    let refused = |error: ContactError| error.to_string();
    assert_eq!(
        refused(Pair::new(-1.0, 1e9).unwrap_err()),
        "`radius` is -1e0; allowed is a finite number above zero"
    );
    assert!(Pair::of([Side::RIGID_FLAT; 2]).is_err());
    assert!(Pair::of([Side { radius: 1.0, young: 1e9, poisson: 0.6 }, Side::RIGID_FLAT]).is_err());
    assert!(Jkr::new(pair(), 0.0).is_err() && Dmt::new(pair(), f64::NAN).is_err());
    assert!(MaugisDugdale::with_tabor(pair(), ADHESION, 1e9).is_err());
    assert!(jkr().radius_under(-5e-4).is_err());
    let bradley = Bradley::new(RADIUS, ADHESION, 0.3e-9).unwrap();
    assert_eq!(
        refused(bradley.at(0.3e-9, Before::Apart).unwrap_err()),
        "`displacement` is 3e-10; allowed is a number below z0: rigid surfaces keep a gap"
    );
    for (name, model) in all() {
        for before in [Before::Apart, Before::Touching] {
            for d in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert!(model.at(d, before).is_err(), "{name} at {d}");
            }
            for d in [1e300, -1e300, 1e-300, -1e-300, 0.0] {
                if let Ok(contact) = model.at(d, before) {
                    assert!(
                        contact.force.is_finite() && contact.radius.is_finite(),
                        "{name} at {d}"
                    );
                }
            }
        }
    }
}
