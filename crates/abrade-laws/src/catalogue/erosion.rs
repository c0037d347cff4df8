//! The laws of erosion by name.

use abrade::quantity::{ANGLE, LENGTH, MASS, SPEED};

use super::{PASCAL, PLAIN, VOLUME, condition, constant};
use crate::erosion::{Dnv, Finnie1960, Finnie1972, Grit, Impact, Oka, Steel, SteelCurve};
use crate::law::{Allowed, Given, Law, Output, Parameter, Status, Value};

pub(super) const IMPACT_MASS: Parameter =
    condition("mass", (Some(MASS), "kg"), Allowed::Positive, "mass of the particle");
pub(super) const IMPACT_SPEED: Parameter =
    condition("speed", (Some(SPEED), "m/s"), Allowed::NotNegative, "speed of the particle");
pub(super) const IMPACT_ANGLE: Parameter =
    condition("angle", (Some(ANGLE), "rad"), Allowed::Angle, "angle from the surface");
const FLOW_PRESSURE: Parameter = condition(
    "pressure",
    PASCAL,
    Allowed::Positive,
    "plastic flow pressure of the surface; its hardness, where no better is known",
);
const BRINELL: Parameter =
    condition("brinell", PLAIN, Allowed::Positive, "Brinell hardness of the surface, kgf/mm2");
const VICKERS: Parameter =
    condition("hardness", PASCAL, Allowed::Positive, "Vickers hardness of the surface");
const DIAMETER: Parameter =
    condition("diameter", (Some(LENGTH), "m"), Allowed::Positive, "diameter of the particles");
pub(super) const SHARPNESS: Parameter = condition(
    "sharpness",
    PLAIN,
    Allowed::Share,
    "F_s: 1 for angular grains, 0.53 for rounded, 0.2 for round ones",
);
const FORCE_RATIO: Parameter =
    constant("force_ratio", 2.0, Allowed::Positive, "K: vertical over horizontal force");

pub(super) const RATIO: Output = Output { name: "mass over mass of particles", unit: "kg/kg" };
const PER_MASS: Output = Output { name: "volume over mass of particles", unit: "m3/kg" };

pub(super) const LAWS: &[Law] = &[
    Law {
        name: "finnie-1960",
        title: "Finnie (1960): a sharp particle cuts a ductile surface, without turning",
        formula: "cutting m U^2 / (p depth_ratio K) {sin 2a - 6/K sin^2 a if tan a <= K/6; K cos^2 a / 6}",
        output: VOLUME,
        parameters: &[
            IMPACT_MASS,
            IMPACT_SPEED,
            IMPACT_ANGLE,
            FLOW_PRESSURE,
            constant("cutting", 1.0, Allowed::Share, "share of particles that cut"),
            constant(
                "depth_ratio",
                2.0,
                Allowed::Positive,
                "length of the contact over the depth of the cut",
            ),
            FORCE_RATIO,
        ],
        status: Status::Seen,
        from_memory: None,
        source: "Wear 3 (1960) 87-103; form and constants as in OpenFOAM's ParticleErosion. No \
                 wear at 90 deg, which measurements show",
        value: Value::Number(|given| {
            let law = Finnie1960 {
                flow_pressure: given["pressure"],
                cutting_share: given["cutting"],
                depth_ratio: given["depth_ratio"],
                force_ratio: given["force_ratio"],
            };
            law.volume(&heavy_impact(given))
        }),
    },
    Law {
        name: "finnie-1972",
        title: "Finnie (1972): the particle turns as it cuts",
        formula: "A cos^2 a if tan a > P/2, else (2A/P)(sin 2a - 2/P sin^2 a); P = K / (1 + m r^2/I), \
                  A = cutting m U^2 / (4 p (1 + m r^2/I))",
        output: VOLUME,
        parameters: &[
            IMPACT_MASS,
            IMPACT_SPEED,
            IMPACT_ANGLE,
            FLOW_PRESSURE,
            constant("cutting", 0.1, Allowed::Share, "share of particles that cut"),
            FORCE_RATIO,
            constant(
                "inertia_ratio",
                2.5,
                Allowed::NotNegative,
                "m r^2/I of the particle; 2.5 for a ball",
            ),
        ],
        status: Status::Derived,
        from_memory: None,
        source: "Wear 19 (1972) 81-90 is not read here; the form is derived from the motion of a \
                 particle that turns, the constants are those of COMSOL's manual",
        value: Value::Number(|given| {
            let law = Finnie1972 {
                flow_pressure: given["pressure"],
                cutting_share: given["cutting"],
                force_ratio: given["force_ratio"],
                inertia_ratio: given["inertia_ratio"],
            };
            law.volume(&heavy_impact(given))
        }),
    },
    oka("oka-quartz", "Oka (2005): quartz sand", |given| oka_of(given, Grit::QUARTZ)),
    oka("oka-carbide", "Oka (2005): silicon carbide", |given| oka_of(given, Grit::CARBIDE)),
    oka("oka-glass", "Oka (2005): glass beads", |given| oka_of(given, Grit::GLASS)),
    Law {
        name: "dnv",
        title: "DNV RP-O501: ductile surfaces",
        formula: "K U^n F(a); F = 9.370 a - 42.295 a^2 + 110.864 a^3 - 175.804 a^4 + 170.137 a^5 - \
                  98.398 a^6 + 31.211 a^7 - 4.170 a^8",
        output: RATIO,
        parameters: &[
            IMPACT_SPEED,
            IMPACT_ANGLE,
            constant(
                "factor",
                Dnv::STEEL.factor,
                Allowed::Positive,
                "K, with U in m/s; 5.8e-9 for aluminium",
            ),
            constant("power", Dnv::STEEL.power, Allowed::Positive, "n; 2.3 for aluminium"),
        ],
        status: Status::Seen,
        from_memory: None,
        source: "recommended practice DNV RP-O501; the defaults are those of steel",
        value: Value::Number(|given| {
            Dnv { factor: given["factor"], power: given["power"] }.ratio(&impact(given, 1.0))
        }),
    },
    Law {
        name: "ecrc",
        title: "Zhang et al. (2007), Erosion/Corrosion Research Center: steels",
        formula: "C BH^-0.59 F_s U^2.41 (5.4 a - 10.11 a^2 + 10.93 a^3 - 6.33 a^4 + 1.42 a^5)",
        output: RATIO,
        parameters: &[
            IMPACT_SPEED,
            IMPACT_ANGLE,
            BRINELL,
            SHARPNESS,
            constant("factor", SteelCurve::Zhang.factor(), Allowed::Positive, "C, with U in m/s"),
        ],
        status: Status::Seen,
        from_memory: None,
        source: "Wear 263 (2007) 330-338",
        value: Value::Number(|given| steel(given, SteelCurve::Zhang)),
    },
    Law {
        name: "ahlert",
        title: "Ahlert (1994), McLaury: steels",
        formula: "A BH^-0.59 F_s U^1.73 f(a); f = -33.4 a^2 + 17.9 a below 15 deg, else 1.239 cos^2 a \
                  sin a - 1.192 sin^2 a + 2.167",
        output: RATIO,
        parameters: &[
            IMPACT_SPEED,
            IMPACT_ANGLE,
            BRINELL,
            SHARPNESS,
            constant("factor", SteelCurve::Ahlert.factor(), Allowed::Positive, "A, with U in m/s"),
        ],
        status: Status::Seen,
        from_memory: Some("factor"),
        source: "constants of f as in the manual of Autodesk CFD, where y has the other sign; with \
                 this one f is continuous at 15 deg to 0.011",
        value: Value::Number(|given| steel(given, SteelCurve::Ahlert)),
    },
];

const fn oka(name: &'static str, title: &'static str, value: fn(&Given<'_>) -> f64) -> Law {
    Law {
        name,
        title,
        formula: "g(a) K Hv^k1 (U/V')^k2 (D/D')^k3; g = (sin a)^n1 [1 + Hv (1 - sin a)]^n2, n = s Hv^q, \
                  Hv in GPa",
        output: PER_MASS,
        parameters: &[IMPACT_SPEED, IMPACT_ANGLE, VICKERS, DIAMETER],
        status: Status::Seen,
        from_memory: Some("s and q of n1 and n2"),
        source: "Wear 259 (2005) 95-109; form, K and k as in the manual of EDEM",
        value: Value::Number(value),
    }
}

fn oka_of(given: &Given<'_>, grit: Grit) -> f64 {
    let law = Oka { hardness: given["hardness"], diameter: given["diameter"], grit };
    law.volume_per_mass(&impact(given, 1.0))
}

fn steel(given: &Given<'_>, curve: SteelCurve) -> f64 {
    let [factor, brinell, sharpness] = ["factor", "brinell", "sharpness"].map(|name| given[name]);
    Steel { curve, factor, brinell, sharpness }.ratio(&impact(given, 1.0))
}

pub(super) fn heavy_impact(given: &Given<'_>) -> Impact {
    impact(given, given["mass"])
}

pub(super) fn impact(given: &Given<'_>, mass: f64) -> Impact {
    Impact { mass, speed: given["speed"], angle: given["angle"] }
}
