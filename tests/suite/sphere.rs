//! Rigid-plastic spheres against closed forms and tight integrations: lengths in R, speeds in v,
//! H = 1, beta = m v^2 / (2 pi H R^3).

use abrade::{ElasticLaw, FlowLaw, HexStrip, Inertia, Lateral, Shape};
use nalgebra::{UnitQuaternion, Vector3};

use crate::table::{Row, number, read};
use crate::theory::{End, Shot, offsets};

/// The sphere of `row` on a plate with `nodes` of them across its largest contact.
fn sphere(row: &Row, angle: f64, travel: f64, nodes: f64) -> Shot {
    let depth = number(row, "hmax");
    let across = 2.0 * (depth * (2.0 - depth)).sqrt();
    let pitch = across / nodes;
    let density = 1.5 * number(row, "beta");
    Shot {
        shape: Shape::ball(1.0).expect("a ball"),
        inertia: Inertia::of_ball(1.0, density),
        rotation: UnitQuaternion::identity(),
        angle,
        strip: HexStrip {
            length: across + 2.0 * travel + 8.0 * pitch,
            width: across + 8.0 * pitch,
            pitch,
            rest_area: None,
        },
        friction: number(row, "mu"),
        elastic: ElasticLaw::Rigid,
        flow: FlowLaw::NormalPressure {},
        rotation_locked: false,
    }
}

/// Rms over landings of a sphere's `errors`.
pub fn rms<const N: usize>(shot: &Shot, errors: impl Fn(&End) -> [f64; N]) -> [f64; N] {
    let landings = offsets(shot.strip.pitch, 8);
    let ends: Vec<_> = landings.iter().map(|at| errors(&shot.land(*at))).collect();
    std::array::from_fn(|i| {
        (ends.iter().map(|e| e[i] * e[i]).sum::<f64>() / ends.len() as f64).sqrt()
    })
}

/// Errors at 10, 20 and 40 nodes across the contact, of the quantities `names`.
pub struct Study<const N: usize> {
    names: [&'static str; N],
    /// Allowed at 20 nodes, or 40.
    limits: [f64; N],
    judged: usize,
    errors: Vec<[[f64; 3]; N]>,
    misses: Vec<String>,
}

impl<const N: usize> Study<N> {
    pub fn new(names: [&'static str; N], nodes: usize, limits: [f64; N]) -> Self {
        let judged = usize::from(nodes == 40) + 1;
        Self { names, limits, judged, errors: Vec::new(), misses: Vec::new() }
    }

    pub fn row(&mut self, row: &str, error: impl Fn(f64) -> [f64; N]) {
        let [coarse, middle, fine] = [10.0, 20.0, 40.0].map(error);
        let mut line = row.to_string();
        for (i, name) in self.names.iter().enumerate() {
            line += &format!("  {name} {:.1e} {:.1e} {:.1e}", coarse[i], middle[i], fine[i]);
        }
        println!("{line}");
        self.errors.push(std::array::from_fn(|i| [coarse[i], middle[i], fine[i]]));
        let judged = [coarse, middle, fine][self.judged];
        if (0..N).any(|i| judged[i] > self.limits[i]) {
            self.misses.push(line);
        }
    }

    /// The slopes are of the rms over the rows.
    pub fn finish(mut self) {
        for (i, name) in self.names.iter().enumerate() {
            let rms = [0, 2].map(|k| {
                let squares: f64 = self.errors.iter().map(|e| e[i][k] * e[i][k]).sum();
                (squares / self.errors.len() as f64).sqrt()
            });
            let slope = (rms[0] / rms[1]).log2() / 2.0;
            let line = format!("{name}: rms {:.1e} to {:.1e}, slope {slope:.2}", rms[0], rms[1]);
            println!("{line}");
            if slope < 1.0 {
                self.misses.push(line);
            }
        }
        assert!(self.misses.is_empty(), "{}", self.misses.join("\n"));
    }
}

/// Fails for a wrong price, lever or friction of a ball in the swept rule. W is within 1e-3 E0 at
/// 40 nodes in every row, and at 20 nodes in all but three: those at 75 degrees, where the sphere is
/// nearly stopped, and one at 45.
#[test]
fn oblique_spheres_converge_to_the_theory() {
    let mut study = Study::new(["W", "v", "omega"], 40, [1e-3, 1e-2, 1e-3]);
    for table in ["rigid_plastic_sphere_oblique", "rigid_plastic_sphere_oblique_friction"] {
        for row in read(table) {
            let [beta, alpha, mu, rot] =
                ["beta", "alpha", "mu", "rot"].map(|column| number(&row, column));
            study.row(&format!("beta {beta:.6} alpha {alpha} mu {mu} rot {rot}"), |nodes| {
                let shot = sphere(&row, alpha, number(&row, "x_end"), nodes);
                rms(&Shot { rotation_locked: rot == 0.0, ..shot }, |end| {
                    let state = &end.state;
                    let miss = Vector3::new(number(&row, "vx"), 0.0, number(&row, "vz"));
                    [
                        end.paid / end.energy[0] - number(&row, "WH_over_E0"),
                        (state.velocity - miss).norm(),
                        state.spin.y - number(&row, "omega"),
                    ]
                })
            });
        }
    }
    let within = study.errors.iter().filter(|e| e[0][1] <= 1e-3).count();
    assert!(within + 3 >= study.errors.len(), "{within} of {} rows", study.errors.len());
    study.finish();
}

/// Fails for a wrong price of a face in either flow law, or friction outside the balance. The
/// deepest node lies off the sphere's path by up to a pitch, which costs second order.
#[test]
fn normal_spheres_converge_to_the_closed_forms() {
    let mut study = Study::new(["W", "depth"], 20, [1e-3, 1e-2]);
    for row in read("rigid_plastic_sphere_normal") {
        let flow = match row["law"].as_str() {
            "cap(paper)" => FlowLaw::CapozzaHanley { lateral: Lateral::Projected },
            _ => FlowLaw::NormalPressure {},
        };
        study.row(&format!("{} beta {} mu {}", row["law"], row["beta"], row["mu"]), |nodes| {
            let shot = Shot { flow: flow.clone(), ..sphere(&row, 90.0, 0.0, nodes) };
            rms(&shot, |end| {
                [
                    end.paid / end.energy[0] - number(&row, "WH_over_E0"),
                    end.surface.worn().max_depth / number(&row, "hmax") - 1.0,
                ]
            })
        });
    }
    study.finish();
}
