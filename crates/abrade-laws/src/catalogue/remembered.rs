//! Laws that were written down from memory, by name. None of them is the law of a paper that was read
//! here; what is from memory is told by status and `from_memory`.

use abrade::quantity::{ANGLE, DENSITY, LENGTH, SPEED, TIME};

use super::erosion::{
    IMPACT_ANGLE, IMPACT_MASS, IMPACT_SPEED, RATIO, SHARPNESS, heavy_impact, impact,
};
use super::{PASCAL, PLAIN, VOLUME, condition, constant};
use crate::erosion::{
    Arabnejad, Bitter, Evans, Huang, NeilsonGilchrist, TabakoffGrant, bitter_threshold,
};
use crate::law::{Allowed, Given, Law, Output, Parameter, Status, Value};
use crate::sliding::preston_depth;

const NOT_READ: &str = "from memory; the papers of those it is named after were not read here. \
                        Agrees with values written down from memory elsewhere";

const DEFORMATION_ENERGY: Parameter = condition(
    "deformation_energy",
    PASCAL,
    Allowed::Positive,
    "work of deformation per volume, J/m3",
);
const CUTTING_ENERGY: Parameter =
    condition("cutting_energy", PASCAL, Allowed::Positive, "work of cutting per volume, J/m3");
const THRESHOLD: Parameter = condition(
    "threshold",
    (Some(SPEED), "m/s"),
    Allowed::NotNegative,
    "K: speed along the normal below which nothing is deformed for good",
);
const YIELD: Parameter =
    condition("yield", PASCAL, Allowed::Positive, "y: yield pressure of the surface");
const PARTICLE_DENSITY: Parameter = condition(
    "density",
    (Some(DENSITY), "kg/m3"),
    Allowed::Positive,
    "rho: density of the particle",
);
const COMPLIANCE: Parameter = condition(
    "compliance",
    (None, "1/Pa"),
    Allowed::Positive,
    "q: (1 - nu^2)/E of particle and surface, added",
);

pub(super) const LAWS: &[Law] = &[
    Law {
        name: "bitter",
        title: "After Bitter: deformation and cutting, ductile surfaces",
        formula: "m (U sin a - K)^2 / (2 deformation_energy) + cut; cut = 2 m s (U cos a - s rho_c) while \
                  U cos a > 2 s rho_c, else m [U^2 cos^2 a - K1 (U sin a - K)^1.5] / (2 rho_c); \
                  s = C (U sin a - K)^2 / sqrt(U sin a), C = 0.288/y (rho/y)^0.25, \
                  K1 = 0.82 y^2 (y/rho)^0.25 q^2, rho_c = cutting_energy",
        output: VOLUME,
        parameters: &[
            IMPACT_MASS,
            IMPACT_SPEED,
            IMPACT_ANGLE,
            DEFORMATION_ENERGY,
            CUTTING_ENERGY,
            THRESHOLD,
            YIELD,
            PARTICLE_DENSITY,
            COMPLIANCE,
        ],
        status: Status::Memory,
        from_memory: Some("all but the form of the deformation"),
        source: NOT_READ,
        value: Value::Number(|given| {
            let law = Bitter {
                deformation_energy: given["deformation_energy"],
                cutting_energy: given["cutting_energy"],
                threshold: given["threshold"],
                yield_pressure: given["yield"],
                density: given["density"],
                compliance: given["compliance"],
            };
            law.volume(&heavy_impact(given))
        }),
    },
    Law {
        name: "bitter-threshold",
        title: "After Bitter: speed along the normal below which a contact is elastic",
        formula: "pi^2 / (2 sqrt(10)) y^2.5 rho^-0.5 q^2",
        output: Output { name: "speed", unit: "m/s" },
        parameters: &[YIELD, PARTICLE_DENSITY, COMPLIANCE],
        status: Status::Memory,
        from_memory: Some("all"),
        source: NOT_READ,
        value: Value::Number(|given| {
            bitter_threshold(given["yield"], given["density"], given["compliance"])
        }),
    },
    Law {
        name: "neilson-gilchrist",
        title: "After Neilson and Gilchrist: deformation and cutting",
        formula: "m (U sin a - K)^2 / (2 deformation_energy) + m U^2 cos^2 a / (2 cutting_energy) \
                  {sin(pi a / (2 stopping_angle)) below stopping_angle; 1}",
        output: VOLUME,
        parameters: &[
            IMPACT_MASS,
            IMPACT_SPEED,
            IMPACT_ANGLE,
            DEFORMATION_ENERGY,
            CUTTING_ENERGY,
            THRESHOLD,
            condition(
                "stopping_angle",
                (Some(ANGLE), "rad"),
                Allowed::Angle,
                "a0: angle above which the particle stops along the surface",
            ),
        ],
        status: Status::Memory,
        from_memory: Some("all"),
        source: NOT_READ,
        value: Value::Number(|given| {
            let law = NeilsonGilchrist {
                deformation_energy: given["deformation_energy"],
                cutting_energy: given["cutting_energy"],
                threshold: given["threshold"],
                stopping_angle: given["stopping_angle"],
            };
            law.volume(&heavy_impact(given))
        }),
    },
    tabakoff(
        "tabakoff-grant-aluminium",
        "After Tabakoff and Grant: quartz on aluminium",
        |given| TabakoffGrant::ALUMINIUM.ratio(&impact(given, 1.0)),
    ),
    tabakoff("tabakoff-grant-steel", "After Tabakoff and Grant: quartz on steel", |given| {
        TabakoffGrant::STEEL.ratio(&impact(given, 1.0))
    }),
    Law {
        name: "arabnejad",
        title: "After Arabnejad and others (2015): cutting and deformation, steels",
        formula: "cutting F_s U^2.41 {sin a (2 K cos a - sin a) / (2 K^2) if tan a <= K; cos^2 a / 2} + \
                  deformation (U sin a - threshold)^2",
        output: RATIO,
        parameters: &[
            IMPACT_SPEED,
            IMPACT_ANGLE,
            SHARPNESS,
            constant(
                "cutting",
                Arabnejad::CARBON_STEEL.cutting,
                Allowed::NotNegative,
                "C, with U in m/s; the defaults are those of carbon steel 1018",
            ),
            constant(
                "deformation",
                Arabnejad::CARBON_STEEL.deformation,
                Allowed::NotNegative,
                "D, with U in m/s",
            ),
            constant(
                "force_ratio",
                Arabnejad::CARBON_STEEL.force_ratio,
                Allowed::Positive,
                "K: vertical over horizontal force",
            ),
            constant(
                "threshold",
                Arabnejad::CARBON_STEEL.threshold,
                Allowed::NotNegative,
                "speed along the normal below which nothing is deformed for good, m/s",
            ),
        ],
        status: Status::Seen,
        from_memory: Some("the constants, and that F_s weighs the cut alone"),
        source: "form as in a program by others; the paper was not read here",
        value: Value::Number(|given| {
            let law = Arabnejad {
                cutting: given["cutting"],
                deformation: given["deformation"],
                force_ratio: given["force_ratio"],
                threshold: given["threshold"],
                sharpness: given["sharpness"],
            };
            law.ratio(&impact(given, 1.0))
        }),
    },
    Law {
        name: "huang",
        title: "After Huang and others (2008): jets; both factors are to be fitted",
        formula: "cutting d^0.5 U^2.375 cos^2 a (sin a)^0.375 + deformation (U sin a)^2.3",
        output: RATIO,
        parameters: &[
            IMPACT_SPEED,
            IMPACT_ANGLE,
            condition(
                "diameter",
                (Some(LENGTH), "m"),
                Allowed::Positive,
                "d: diameter of the particles",
            ),
            condition("cutting", PLAIN, Allowed::NotNegative, "with d in m and U in m/s"),
            condition("deformation", PLAIN, Allowed::NotNegative, "with U in m/s"),
        ],
        status: Status::Memory,
        from_memory: Some("form and exponents"),
        source: "from memory; the paper was not read here, and no value of others was compared",
        value: Value::Number(|given| {
            let law = Huang {
                cutting: given["cutting"],
                deformation: given["deformation"],
                diameter: given["diameter"],
            };
            law.ratio(&impact(given, 1.0))
        }),
    },
    Law {
        name: "evans",
        title: "After Evans and others: brittle surfaces, struck along the normal; the factor is to be fitted",
        formula: "factor U^(19/6) R^(11/3) rho^(19/12) K_c^(-4/3) H^(-1/4)",
        output: VOLUME,
        parameters: &[
            IMPACT_SPEED,
            condition("radius", (Some(LENGTH), "m"), Allowed::Positive, "R of the particle"),
            PARTICLE_DENSITY,
            condition(
                "toughness",
                (None, "Pa m^0.5"),
                Allowed::Positive,
                "K_c: fracture toughness of the surface",
            ),
            condition("hardness", PASCAL, Allowed::Positive, "H of the surface"),
            condition("factor", PLAIN, Allowed::Positive, "a pure number"),
        ],
        status: Status::Memory,
        from_memory: Some("all"),
        source: NOT_READ,
        value: Value::Number(|given| {
            let law = Evans {
                factor: given["factor"],
                radius: given["radius"],
                density: given["density"],
                toughness: given["toughness"],
                hardness: given["hardness"],
            };
            law.volume(given["speed"])
        }),
    },
    Law {
        name: "preston",
        title: "After Preston: depth polished off",
        formula: "factor p v t",
        output: Output { name: "depth", unit: "m" },
        parameters: &[
            condition("pressure", PASCAL, Allowed::NotNegative, "pressure of the pad"),
            condition(
                "speed",
                (Some(SPEED), "m/s"),
                Allowed::NotNegative,
                "speed of the pad along the surface",
            ),
            condition("time", (Some(TIME), "s"), Allowed::NotNegative, "how long"),
            condition("factor", (None, "1/Pa"), Allowed::Positive, "Preston's coefficient"),
        ],
        status: Status::Memory,
        from_memory: Some("all"),
        source: NOT_READ,
        value: Value::Number(|given| {
            let [factor, pressure, speed, time] =
                ["factor", "pressure", "speed", "time"].map(|name| given[name]);
            preston_depth(factor, pressure, speed * time)
        }),
    },
];

const fn tabakoff(name: &'static str, title: &'static str, value: fn(&Given<'_>) -> f64) -> Law {
    Law {
        name,
        title,
        formula: "1e-3 {[1 + k sin(pi a / (2 a0))]^2 (U/V1)^2 cos^2 a [1 - (1 - U sin a/V3)^2] + \
                  (U sin a/V2)^4}, k = k12 up to 2 a0, else 0",
        output: RATIO,
        parameters: &[IMPACT_SPEED, IMPACT_ANGLE],
        status: Status::Memory,
        from_memory: Some(
            "all; what was remembered of coal on steel differs from place to place and is left out",
        ),
        source: NOT_READ,
        value: Value::Number(value),
    }
}
