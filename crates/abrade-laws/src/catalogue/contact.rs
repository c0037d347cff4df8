//! The models of a contact by name, and what they are made with.

use abrade::quantity::{AREA_ENERGY, LENGTH};

use super::{PASCAL, PLAIN, condition, constant};
use crate::contact::{
    Bradley, CohesionArea, ContactError, ContactModel, Dmt, Hertz, Jkr, MaugisDugdale, Pair, Side,
    SimplifiedJkr, maugis_lambda, tabor,
};
use crate::law::{Allowed, DISPLACEMENT, Given, Law, Output, Parameter, Status, Value};

const RADIUS: Parameter = condition(
    "radius",
    (Some(LENGTH), "m"),
    Allowed::Positive,
    "R: reduced radius, 1/R = 1/R1 + 1/R2; of a ball on a flat the ball's",
);
const MODULUS: Parameter = condition(
    "modulus",
    PASCAL,
    Allowed::Positive,
    "E*: contact modulus, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2",
);
const ADHESION: Parameter = condition(
    "adhesion",
    (Some(AREA_ENERGY), "J/m2"),
    Allowed::Positive,
    "w: work of adhesion, what parts a unit of area",
);
const OVERLAP: Parameter = condition(
    DISPLACEMENT,
    (Some(LENGTH), "m"),
    Allowed::Any,
    "d: overlap of the undeformed surfaces, negative for a gap; what touched before still holds",
);
const DISTANCE: Parameter = condition(
    "distance",
    (Some(LENGTH), "m"),
    Allowed::Positive,
    "z0: equilibrium distance of the surfaces, some 0.15 to 0.4 nm",
);
const STRENGTH: Parameter = condition(
    "strength",
    PASCAL,
    Allowed::Positive,
    "sigma0: attraction within reach; 1.03 w/z0 is that of Lennard-Jones surfaces",
);
const PUSH: Output = Output { name: "force", unit: "N" };

/// An entry that gives the force of a model.
const fn model(
    [name, title, formula, source]: [&'static str; 4],
    parameters: &'static [Parameter],
    value: fn(&Given<'_>) -> Result<Box<dyn ContactModel>, ContactError>,
) -> Law {
    Law {
        name,
        title,
        formula,
        output: PUSH,
        parameters,
        status: Status::Seen,
        from_memory: None,
        source,
        value: Value::Contact(value),
    }
}

pub(super) const LAWS: &[Law] = &[
    model(
        [
            "hertz",
            "Hertz (1882): elastic contact without adhesion",
            "4/3 E* sqrt(R) d^1.5; a^2 = R d",
            "as in Johnson, Contact mechanics (1985), section 4.2",
        ],
        &[RADIUS, MODULUS, OVERLAP],
        |given| Ok(Box::new(Hertz::new(pair(given)?))),
    ),
    model(
        [
            "jkr",
            "Johnson, Kendall & Roberts (1971): adhesion inside the contact; large and soft bodies",
            "4 E* a^3 / (3 R) - sqrt(8 pi w E* a^3); d = a^2/R - sqrt(2 pi w a/E*)",
            "Proc. R. Soc. A 324 (1971) 301-313; form as in texts on discrete elements. With memory: what has touched holds up to a gap. Where a \
             text has a^3 = R/E* [..], it means 4 E*/3; its surface energy gamma is w",
        ],
        &[RADIUS, MODULUS, ADHESION, OVERLAP],
        |given| Ok(Box::new(Jkr::new(pair(given)?, given["adhesion"])?)),
    ),
    model(
        [
            "simplified-jkr",
            "JKR's force over Hertz' contact radius: no memory, no neck",
            "4/3 E* sqrt(R) d^1.5 - sqrt(8 pi w E*) (R d)^0.75",
            "a^2 = R d put into JKR's force. Where a text has E* sqrt(R) d^1.5 - sqrt(6 pi w E*) (R d)^0.75, \
             it means 4 E*/3. Not LIGGGHTS' sjkr, which is cohesion-area",
        ],
        &[RADIUS, MODULUS, ADHESION, OVERLAP],
        |given| Ok(Box::new(SimplifiedJkr::new(pair(given)?, given["adhesion"])?)),
    ),
    model(
        [
            "cohesion-area",
            "A pull k A in proportion to the overlap's area; LIGGGHTS' cohesion sjkr and sjkr2",
            "4/3 E* sqrt(R) d^1.5 - k area_factor pi R d",
            "manual of LIGGGHTS, gran cohesion sjkr and sjkr2. Nothing of JKR is in it: no work of adhesion, \
             and a pull-off force that goes as k^3",
        ],
        &[
            RADIUS,
            MODULUS,
            condition("cohesion", PASCAL, Allowed::Positive, "k: cohesion energy density, J/m3"),
            constant(
                "area_factor",
                2.0,
                Allowed::Positive,
                "A / (pi R d): 2 for sjkr to first order in d/R, 4 for sjkr2",
            ),
            OVERLAP,
        ],
        |given| {
            let model = CohesionArea::new(pair(given)?, given["cohesion"], given["area_factor"])?;
            Ok(Box::new(model))
        },
    ),
    model(
        [
            "dmt",
            "Derjaguin, Muller & Toporov (1975): adhesion around the contact; small and stiff bodies",
            "4/3 E* sqrt(R) d^1.5 - 2 pi w R, none without contact",
            "J. Colloid Interface Sci. 53 (1975) 314-326; form as in texts on discrete elements. Where a text has a surface energy gamma of the \
             pair, it means w",
        ],
        &[RADIUS, MODULUS, ADHESION, OVERLAP],
        |given| Ok(Box::new(Dmt::new(pair(given)?, given["adhesion"])?)),
    ),
    model(
        [
            "bradley",
            "Bradley (1932): rigid spheres that attract each other over a gap",
            "8/3 pi w R [(z/z0)^-8 / 4 - (z/z0)^-2]; gap z = z0 - d",
            "Phil. Mag. 13 (1932) 853-862; form as in texts on discrete elements. Its argument is the gap, also where a text calls it an overlap",
        ],
        &[RADIUS, ADHESION, DISTANCE, OVERLAP],
        |given| {
            let [radius, adhesion, distance] =
                ["radius", "adhesion", "distance"].map(|name| given[name]);
            Ok(Box::new(Bradley::new(radius, adhesion, distance)?))
        },
    ),
    model(
        [
            "maugis-dugdale",
            "Maugis (1992): a constant attraction over a distance w/sigma0, from DMT to JKR",
            "pi w R {A^3 - lambda A^2 [sqrt(m^2 - 1) + m^2 asec m]}; A and m = c/a by lambda and d",
            "J. Colloid Interface Sci. 150 (1992) 243-269; equations as in the package Adhesion of \
             ContactEngineering, attraction without contact derived. With memory",
        ],
        &[RADIUS, MODULUS, ADHESION, STRENGTH, OVERLAP],
        |given| {
            let model = MaugisDugdale::new(pair(given)?, given["adhesion"], given["strength"])?;
            Ok(Box::new(model))
        },
    ),
    Law {
        name: "tabor",
        title: "Tabor (1977): DMT holds below 0.1, JKR above 5, maugis-dugdale between",
        formula: "(R w^2 / (E*^2 z0^3))^(1/3)",
        output: Output { name: "parameter", unit: "-" },
        parameters: &[RADIUS, MODULUS, ADHESION, DISTANCE],
        status: Status::Seen,
        from_memory: Some("the limits 0.1 and 5, after Johnson & Greenwood (1997)"),
        source: "J. Colloid Interface Sci. 58 (1977) 2-13. At the limits the pull-off force of \
                 maugis-dugdale is 3 % off dmt, 0.3 % off jkr",
        value: Value::Number(|given| {
            number(pair(given).and_then(|p| tabor(&p, given["adhesion"], given["distance"])))
        }),
    },
    Law {
        name: "maugis-lambda",
        title: "Maugis (1992): his parameter, 1.157 times Tabor's for Lennard-Jones surfaces",
        formula: "2 sigma0 (R / (pi w K^2))^(1/3), K = 4/3 E*",
        output: Output { name: "parameter", unit: "-" },
        parameters: &[RADIUS, MODULUS, ADHESION, STRENGTH],
        status: Status::Seen,
        from_memory: None,
        source: "J. Colloid Interface Sci. 150 (1992) 243-269; as in the package Adhesion of ContactEngineering",
        value: Value::Number(|given| {
            number(
                pair(given).and_then(|p| maugis_lambda(&p, given["adhesion"], given["strength"])),
            )
        }),
    },
    Law {
        name: "contact-modulus",
        title: "Modulus of a contact from those of its two sides",
        formula: "1 / [(1 - poisson^2)/young + (1 - poisson_2^2)/young_2]",
        output: Output { name: "modulus", unit: "Pa" },
        parameters: &[
            condition("young", PASCAL, Allowed::Positive, "Young's modulus of a side"),
            condition("poisson", PLAIN, Allowed::Poisson, "its Poisson's ratio"),
            condition("young_2", PASCAL, Allowed::Positive, "Young's modulus of the other side"),
            condition("poisson_2", PLAIN, Allowed::Poisson, "its Poisson's ratio"),
        ],
        status: Status::Seen,
        from_memory: None,
        source: "Johnson, Contact mechanics (1985), section 4.2",
        value: Value::Number(|given| {
            let side = |young, poisson| Side { radius: 1.0, young, poisson };
            let sides = [
                side(given["young"], given["poisson"]),
                side(given["young_2"], given["poisson_2"]),
            ];
            number(Pair::of(sides).map(|pair| pair.modulus()))
        }),
    },
];

fn pair(given: &Given<'_>) -> Result<Pair, ContactError> {
    Pair::new(given["radius"], given["modulus"])
}

/// What the parameters' own ranges do not refuse is no number where the formula is none.
fn number(value: Result<f64, ContactError>) -> f64 {
    value.unwrap_or(f64::NAN)
}
