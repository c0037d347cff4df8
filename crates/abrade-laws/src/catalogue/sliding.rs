//! The laws of wear along a slide by name.

use abrade::quantity::{ANGLE, FORCE, LENGTH};

use super::{PASCAL, PLAIN, VOLUME, condition};
use crate::law::{Allowed, Given, Law, Output, Parameter, Status, Value};
use crate::sliding::{Archard, cone_section, groove_section};

const HARDNESS: Parameter =
    condition("hardness", PASCAL, Allowed::Positive, "hardness of the softer surface");
const LOAD: Parameter =
    condition("load", (Some(FORCE), "N"), Allowed::NotNegative, "load along the normal");
const WAY: Parameter =
    condition("way", (Some(LENGTH), "m"), Allowed::NotNegative, "way of the slide");
const WEAR_COEFFICIENT: Parameter = condition(
    "coefficient",
    PLAIN,
    Allowed::NotNegative,
    "K: 1e-8 to 1e-4 where wear is mild, 1e-3 to 1e-1 where it is abrasive",
);

const SECTION: Output = Output { name: "section", unit: "m2" };

pub(super) const LAWS: &[Law] = &[
    Law {
        name: "archard",
        title: "Archard (1953): volume worn along a slide",
        formula: "K F s / H",
        output: VOLUME,
        parameters: &[LOAD, WAY, HARDNESS, WEAR_COEFFICIENT],
        status: Status::Seen,
        from_memory: None,
        source: "J. Appl. Phys. 24 (1953) 981-988. Texts differ by 3 in what they call K: some write \
                 V = K F s / (3 H). Load times way, which is friction work only where friction is \
                 the same everywhere",
        value: Value::Number(|given| archard(given).volume(given["load"], given["way"])),
    },
    Law {
        name: "archard-depth",
        title: "Archard (1953): depth worn along a slide",
        formula: "K p s / H",
        output: Output { name: "depth", unit: "m" },
        parameters: &[
            condition("pressure", PASCAL, Allowed::NotNegative, "pressure on the place"),
            WAY,
            HARDNESS,
            WEAR_COEFFICIENT,
        ],
        status: Status::Derived,
        from_memory: None,
        source: "the law of archard over the area that bears",
        value: Value::Number(|given| archard(given).depth(given["pressure"], given["way"])),
    },
    Law {
        name: "cone-groove",
        title: "Groove of a rigid cone under a load (Rabinowicz 1965)",
        formula: "2 F tan(theta) / (pi H)",
        output: SECTION,
        parameters: &[
            LOAD,
            HARDNESS,
            condition(
                "flank",
                (Some(ANGLE), "rad"),
                Allowed::Angle,
                "theta, from surface to flank",
            ),
        ],
        status: Status::Derived,
        from_memory: None,
        source: "the front half of the contact bears the load at the hardness",
        value: Value::Number(|given| {
            cone_section(given["load"], given["hardness"], given["flank"])
        }),
    },
    Law {
        name: "ball-groove",
        title: "Groove of a rigid ball under a load",
        formula: "R^2 asin(a/R) - a sqrt(R^2 - a^2); a^2 = 2 F / (pi H)",
        output: SECTION,
        parameters: &[
            LOAD,
            HARDNESS,
            condition("radius", (Some(LENGTH), "m"), Allowed::Positive, "R of the ball"),
        ],
        status: Status::Derived,
        from_memory: None,
        source: "the front half of the contact bears the load at the hardness",
        value: Value::Number(|given| {
            groove_section(given["load"], given["hardness"], given["radius"])
        }),
    },
];

fn archard(given: &Given<'_>) -> Archard {
    Archard { coefficient: given["coefficient"], hardness: given["hardness"] }
}
