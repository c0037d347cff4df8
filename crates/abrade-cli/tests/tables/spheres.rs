//! Rigid-plastic spheres at 10, 20 and 40 nodes across the contact.

use crate::run::{Row, Verdict, at, number, rms, run, table, vector};
use crate::theory::{End, LANDINGS, errors, land, landing};

/// The landings of a row with so many nodes across the largest contact.
fn ends(scene: &str, row: &Row, travel: f64, nodes: f64, mut sets: Vec<String>) -> Vec<End> {
    let depth = number(row, "hmax");
    let across = 2.0 * (depth * (2.0 - depth)).sqrt();
    let pitch = across / nodes;
    // beta = (2/3) rho v^2 / H
    sets.push(format!("bodies.ball.density={}", 1.5e5 * number(row, "beta")));
    sets.push(format!("materials.plate.friction={}", number(row, "mu")));
    for (key, value) in [
        ("pitch", pitch),
        ("length", across + 2.0 * travel + 8.0 * pitch),
        ("width", across + 8.0 * pitch),
    ] {
        sets.push(format!("surfaces.plate.geometry.{key}={value} mm"));
    }
    let run = |place| land(scene, "ball", &[&sets[..], &[landing("ball", pitch, place)]].concat());
    LANDINGS.into_iter().map(run).collect()
}

/// Errors of some quantities at 10, 20 and 40 nodes, of every row so far.
#[derive(Default)]
struct Convergence(Vec<[Vec<f64>; 3]>);

impl Convergence {
    /// Adds a row and tells it.
    fn row<const N: usize>(
        &mut self,
        error: impl Fn(f64) -> [f64; N],
    ) -> ([f64; N], [f64; N], String) {
        let errors = [10.0, 20.0, 40.0].map(error);
        let line = (0..N).map(|i| {
            let [a, b, c] = errors.map(|e| e[i]);
            format!("  {a:.1e} {b:.1e} {c:.1e}")
        });
        self.0.push(errors.map(Vec::from));
        (errors[1], errors[2], line.collect())
    }

    /// Judges the slope of the rms over the rows.
    fn close(self, mut verdict: Verdict, names: &[&str]) {
        for (i, name) in names.iter().enumerate() {
            let of =
                |level: usize| rms(&self.0.iter().map(|row| row[level][i]).collect::<Vec<_>>());
            let [coarse, middle, fine] = [0, 1, 2].map(of);
            let slope = (coarse / fine).log2() / 2.0;
            verdict.row(
                slope >= 1.0,
                format!("{name}: rms {coarse:.1e} {middle:.1e} {fine:.1e}, slope {slope:.2}"),
            );
        }
        verdict.close();
    }
}

/// Every row. Fails for a flow law or a friction of the scene that does not reach the contact, and
/// for a depth that is not the body's.
#[test]
fn spheres_that_fall() {
    let (mut verdict, mut study) = (Verdict::default(), Convergence::default());
    for row in table("rigid_plastic_sphere_normal") {
        let flow = match row["law"].as_str() {
            "cap(paper)" => "CapozzaHanley(lateral: Projected)",
            _ => "NormalPressure()",
        };
        let (middle, _, line) = study.row(|nodes| {
            let sets = vec![format!("surfaces.plate.flow={flow}")];
            let ends = ends("sphere_normal", &row, 0.0, nodes, sets);
            let over =
                |error: &dyn Fn(&End) -> f64| rms(&ends.iter().map(error).collect::<Vec<_>>());
            [
                over(&|end| end.wear - number(&row, "WH_over_E0")),
                over(&|end| end.deepest / number(&row, "hmax") - 1.0),
            ]
        });
        verdict.row(
            middle[0] <= 1e-3 && middle[1] <= 1e-2,
            format!("{} beta {} mu {}: W, depth{line}", row["law"], row["beta"], row["mu"]),
        );
    }
    study.close(verdict, &["W", "depth"]);
}

/// Every row. Fails for a sphere whose crater is not Rickerby & Macmillan's, and for a rotation that
/// is locked or free where the table says otherwise. W is within 1e-3 at 40 nodes everywhere, at 20
/// in all rows but three: those at 75 degrees, where the sphere nearly stops, and one at 45.
#[test]
fn oblique_spheres() {
    let (mut verdict, mut study) = (Verdict::default(), Convergence::default());
    let mut over = 0;
    let plain = table("rigid_plastic_sphere_oblique");
    for row in plain.iter().chain(&table("rigid_plastic_sphere_oblique_friction")) {
        let (middle, fine, line) = study.row(|nodes| {
            let sets = vec![
                format!("bodies.ball.motion.angle={} deg", number(row, "alpha")),
                format!("bodies.ball.rotation_locked={}", row["rot"] == "0"),
            ];
            let ends = ends("sphere_oblique", row, number(row, "x_end"), nodes, sets);
            errors(&ends, row, ["vx", "", "vz"], ["", "omega", ""])
        });
        over += usize::from(middle[0] > 1e-3);
        verdict.row(
            fine[0] <= 1e-3 && fine[1] <= 1e-2 && fine[2] <= 1e-3,
            format!(
                "beta {} alpha {} mu {} rot {}: W, v, omega{line}",
                row["beta"], row["alpha"], row["mu"], row["rot"]
            ),
        );
    }
    assert!(over <= 3, "{over} rows above 1e-3 in W at 20 nodes");
    study.close(verdict, &["W", "v", "omega"]);
}

/// The scene as it is shipped, from one landing. Fails for a pitch at which it no longer gives the theory.
#[test]
fn the_shipped_oblique_sphere() {
    let mut verdict = Verdict::default();
    let plain = table("rigid_plastic_sphere_oblique");
    let rubbed = table("rigid_plastic_sphere_oblique_friction");
    let rows = plain.iter().chain(&rubbed);
    for row in rows.filter(|row| number(row, "beta") == 0.01) {
        let (alpha, mu) = (number(row, "alpha"), number(row, "mu"));
        let sets = [
            format!("bodies.ball.motion.angle={alpha} deg"),
            format!("materials.plate.friction={mu}"),
            format!("bodies.ball.rotation_locked={}", row["rot"] == "0"),
        ];
        let summary = run("theory/sphere_oblique.ron", &sets);
        let e0 = at(&summary, "energy.initial_J");
        let w = 1e9 * at(&summary, "surfaces.plate.wear_volume_m3") / e0;
        let v = vector(&summary, "bodies.ball.velocity_m_s");
        let (dw, dvx, dvz) = (
            w - number(row, "WH_over_E0"),
            v[0] / 100.0 - number(row, "vx"),
            v[2] / 100.0 - number(row, "vz"),
        );
        verdict.row(
            dw.abs() < 1e-3 && dvx.abs() < 1e-3 && dvz.abs() < 1e-3,
            format!(
                "alpha {alpha} mu {mu} rot {}: dW {dw:+.1e} dvx {dvx:+.1e} dvz {dvz:+.1e}",
                row["rot"]
            ),
        );
    }
    verdict.close();
}
