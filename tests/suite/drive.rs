//! Indentation and scratching.

use abrade::{
    Body, Drive, DriveSolution, Driven, ElasticLaw, EncounterSettings, FlowLaw, HexStrip, Inertia,
    Lateral, Placed, Shape, State, Surface,
};
use nalgebra::{Isometry3, Point3};

use crate::rig::{hertz, laws, paper_lattice, projected};
use crate::table::{number, read};

/// The paper's indenter over a plate.
pub fn indenter(at: [f64; 2], inflation: f64) -> Body {
    let mut body = Body {
        shape: Shape::ball(10e-3).expect("a ball"),
        inertia: Inertia::of_ball(10e-3, 8000.0),
        state: State::at(Point3::new(at[0], at[1], 10e-3 + inflation + 1e-9)),
        rotation_locked: true,
    };
    body.inertia.mass = 0.0335;
    body
}

/// Fails for a wrong load balance, effective area or onset.
#[test]
fn indentation_agrees_with_the_reference() {
    let mut misses = Vec::new();
    for row in read("indentation") {
        let stiffness = |k: f64| ElasticLaw::Foundation { stiffness: Some(k) };
        let area = paper_lattice().rest_area.expect("an area");
        let node = (area * 1.7e9
            / (2.0 * 200e9 / (3.0 * 0.91) * (0.25e-3 * 10e-3 / 10.25e-3f64).sqrt()))
        .powf(2.0 / 3.0);
        let (elastic, inflation) = match row["law"].as_str() {
            "paperHertz_E*110" => (hertz(), 0.25e-3),
            "paperHertz_E*220" => (
                ElasticLaw::HertzNodes {
                    node_radius: 0.25e-3,
                    convention: abrade::HertzConvention::RigidBody,
                },
                0.25e-3,
            ),
            "WinklerPaperCal" => (stiffness(1.7e9 / (0.8 * node)), 0.0),
            _ => (ElasticLaw::Foundation { stiffness: None }, 0.0),
        };
        let pitch = number(&row, "d_mm") * 1e-3;
        let strip = match inflation > 0.0 {
            true => paper_lattice(),
            false => HexStrip { length: 10e-3, width: 10e-3, pitch, rest_area: None },
        };
        let p = strip.pitch;
        let at = match row["landing"].as_str() {
            "top" => [0.0, 0.0],
            "hollow" => [p / 12f64.sqrt(), p / 2.0],
            _ => [0.0, p / 2.0],
        };
        let mut surface =
            Surface::hex_strip(strip, laws(1.7e9, elastic, projected())).expect("a plate");
        let mut body = indenter(at, inflation);
        let start = body.state.position.z;
        let drive = Drive {
            indent_to: 21e3,
            load: 21e3,
            speed: 0.2,
            distance: 0.0,
            mass: 0.0335,
            solution: DriveSolution::Dynamic,
        };
        let mut driven =
            Driven::new(&mut body, &surface, drive, EncounterSettings::default()).expect("a drive");
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        let done = driven.indent(&mut body, &mut placed, &mut ()).expect("an indentation");
        let (area, expected) =
            (surface.worn().indented_area * 1e6, number(&row, "A_ind_at_21kN_mm2"));
        let line = format!(
            "{} {}: area {area:.4} / {expected} W {:.4} / {} depth {:.4} / {} force {:.1} steps {}",
            row["law"],
            row["landing"],
            surface.wear_volume() * 1e9,
            row["W_at_21kN_mm3"],
            (start - body.state.position.z) * 1e3,
            row["depth_at_21kN_mm"],
            driven.force().z,
            done.steps
        );
        println!("{line}");
        if (area / expected - 1.0).abs() > 0.02 {
            misses.push(line);
        }
    }
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}

/// Fails for a slide whose steps miss the distance by their rounding, and which ends with a step of the rest:
/// the height over that time is no velocity.
#[test]
fn steps_that_add_up_to_the_distance_are_all_of_the_slide() {
    for (steps, distance) in [(200, 2e-4), (7, 1e-4), (1000, 1e-3)] {
        let elastic = ElasticLaw::Foundation { stiffness: None };
        let strip = HexStrip { length: 4e-3, width: 2e-3, pitch: 0.1e-3, rest_area: None };
        let mut surface =
            Surface::hex_strip(strip, laws(1.7e9, elastic, projected())).expect("a plate");
        let mut body = indenter([-1e-3, 0.0], 0.0);
        let drive = Drive {
            indent_to: 200.0,
            load: 200.0,
            speed: 0.01,
            distance,
            mass: 0.0335,
            solution: DriveSolution::QuasiStatic { increment: distance },
        };
        let mut driven =
            Driven::new(&mut body, &surface, drive, EncounterSettings::default()).expect("a drive");
        let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
        driven.indent(&mut body, &mut placed, &mut ()).expect("an indentation");
        let dt = distance / 0.01 / f64::from(steps);
        for step in 1..=steps {
            driven.advance(&mut body, &mut placed, dt, &mut ()).expect("a slide");
            assert_eq!(driven.is_done(), step == steps, "{step} of {steps}");
            assert!(body.state.velocity.norm() < 0.02, "{}", body.state.velocity);
        }
    }
}

/// LAMMPS' lattice: a pitch of 0.6 mm with the paper's area per node.
fn lammps_lattice() -> HexStrip {
    let area = paper_lattice().rest_area;
    HexStrip { length: 93.5e-3, width: 16.8e-3, pitch: 0.6e-3, rest_area: area }
}

struct Scratch {
    strip: HexStrip,
    lateral: Lateral,
    shear_ratio: f64,
    rigid_body: bool,
    load: f64,
    at: [f64; 2],
    distance: f64,
    rate_over: f64,
    solution: DriveSolution,
    accuracy: f64,
}

/// Rates [m2]: over the last `rate_over`, and the mean; and the steps.
fn scratch(case: &Scratch) -> ([f64; 2], u64, abrade::Ledger) {
    let elastic = ElasticLaw::HertzNodes {
        node_radius: 0.25e-3,
        convention: match case.rigid_body {
            true => abrade::HertzConvention::RigidBody,
            false => abrade::HertzConvention::ElasticPair,
        },
    };
    let mut laws = laws(1.7e9, elastic, FlowLaw::CapozzaHanley { lateral: case.lateral });
    laws.material.shear_ratio = case.shear_ratio;
    let mut surface = Surface::hex_strip(case.strip, laws).expect("a plate");
    let mut body = indenter(case.at, 0.25e-3);
    let drive = Drive {
        indent_to: case.load,
        load: case.load,
        speed: 0.2,
        distance: case.distance,
        mass: 0.0335,
        solution: case.solution,
    };
    let settings =
        EncounterSettings { accuracy: case.accuracy, ledger: true, ..Default::default() };
    let mut driven = Driven::new(&mut body, &surface, drive, settings).expect("a drive");
    let mut placed = [Placed::at_rest(&mut surface, Isometry3::identity())];
    driven.indent(&mut body, &mut placed, &mut ()).expect("an indentation");
    let start = placed[0].surface.wear_volume();
    let lead = (case.distance - case.rate_over) / 0.2;
    let mut steps = driven.advance(&mut body, &mut placed, lead, &mut ()).expect("a slide").steps;
    let before = placed[0].surface.wear_volume();
    steps += driven.advance(&mut body, &mut placed, 1.0, &mut ()).expect("a slide").steps;
    assert!(driven.is_done());
    let end = placed[0].surface.wear_volume();
    ([(end - before) / case.rate_over, (end - start) / case.distance], steps, *driven.ledger())
}

/// Fails for a scratch whose lateral flow, load balance or start differs from LAMMPS'.
#[test]
fn scratches_agree_with_lammps_under_eq5() {
    let mut misses = Vec::new();
    for row in read("lammps_scratch") {
        // The full 0.4 s rows go through the command line, in abrade-cli's tests.
        if row["label"] != "prod" {
            continue;
        }
        let travel = number(&row, "travel_mm") * 1e-3;
        // Columns left of the start on LAMMPS' shorter strips do not matter.
        let case = Scratch {
            strip: lammps_lattice(),
            lateral: Lateral::Eq5,
            shear_ratio: number(&row, "mua"),
            rigid_body: row["kfac"] == "2",
            load: number(&row, "Fz"),
            at: [-79.0 * 0.75f64.sqrt() * lammps_lattice().pitch, 0.0],
            distance: travel,
            rate_over: 0.5 * travel,
            solution: DriveSolution::Dynamic,
            accuracy: 1e-2,
        };
        let ([_, mean], steps, ledger) = scratch(&case);
        let (got, expected) = (mean * 1e6, number(&row, "rate_mean_mm2"));
        let line = format!(
            "{} mua {} kfac {} {} N {} mm: rate {got:.6} / {expected} ({:+.2e}) steps {steps} numerical {:.1e} of {:.2e}",
            row["label"],
            row["mua"],
            row["kfac"],
            row["Fz"],
            row["travel_mm"],
            got / expected - 1.0,
            ledger.numerical(),
            ledger.external_work
        );
        println!("{line}");
        // At 1 kN one to three nodes flow, and LAMMPS' explicit step shows.
        let limit = if case.load < 5e3 { 0.05 } else { 0.02 };
        if (got / expected - 1.0).abs() > limit {
            misses.push(line);
        }
    }
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}

/// Fails for a quasi-static solution that balances another load or sinks out of step.
#[test]
fn quasi_static_scratches_agree_with_the_reference() {
    let mut misses = Vec::new();
    for row in read("scratch_loads_general_law") {
        if !row["law"].starts_with("paperHertz") {
            continue;
        }
        let pitch = paper_lattice().pitch;
        let increment = 0.125;
        let case = Scratch {
            strip: paper_lattice(),
            lateral: Lateral::Projected,
            shear_ratio: number(&row, "mua"),
            rigid_body: row["law"] == "paperHertzE220",
            load: number(&row, "load_N"),
            at: [(-80.0 * 0.75f64.sqrt() + 3f64.sqrt() / 6.0) * pitch, pitch / 4.0],
            distance: 12e-3,
            rate_over: 6e-3,
            solution: DriveSolution::QuasiStatic { increment: increment * pitch },
            accuracy: 1e-3,
        };
        let ([tail, _], steps, _) = scratch(&case);
        let (got, expected) = (tail * 1e6, number(&row, "W_per_len_mm2"));
        let line = format!(
            "{} mua {} {} N inc {increment}: {got:.6} / {expected} ({:+.2e}) {steps}",
            row["law"],
            row["mua"],
            row["load_N"],
            got / expected - 1.0
        );
        println!("{line}");
        if (got - expected).abs() > 0.02 * expected {
            misses.push(line);
        }
    }
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}

/// Fails for increments whose error does not vanish, and for a rate of either way that is off by more than
/// 0.1 %, which the 2 % of the tables let through.
#[test]
fn quasi_static_and_dynamic_scratches_come_to_the_same_rate() {
    let rate = |solution| {
        let case = Scratch {
            strip: lammps_lattice(),
            lateral: Lateral::Eq5,
            shear_ratio: 0.25,
            rigid_body: false,
            load: 10e3,
            at: [-79.0 * 0.75f64.sqrt() * lammps_lattice().pitch, 0.0],
            distance: 24e-3,
            rate_over: 8e-3,
            solution,
            accuracy: 1e-2,
        };
        scratch(&case).0[0]
    };
    let dynamic = rate(DriveSolution::Dynamic);
    let misses = [0.15e-3, 0.02e-3].map(|increment| {
        let miss = rate(DriveSolution::QuasiStatic { increment }) / dynamic - 1.0;
        println!("{increment:e} m: {miss:+.2e}");
        miss.abs()
    });
    assert!(misses[0] < 2e-2 && misses[1] < 1e-3, "{misses:?}");
}
