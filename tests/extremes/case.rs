//! What a case is, and how it is drawn from its number.

use std::f64::consts::TAU;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Seed of the matrix.
const SEED: u64 = 0x6162_7261_6465;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    Single,
    Double,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Ball,
    Cube,
    Needle,
    Plate,
    Clump,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    Strip,
    Cuboid,
    Sphere,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elastic {
    Foundation,
    Rigid,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    CapozzaHanley,
    NormalPressure,
}

/// What a run may spend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Means {
    /// Target relative error of the wear volume [-].
    pub accuracy: f64,
    /// Contact steps of one step of the embedder.
    pub step_limit: u64,
    /// Contact steps of a case after which it counts as long.
    pub long: u64,
}

impl Means {
    /// Of the matrix.
    pub const USUAL: Self = Self { accuracy: 1e-3, step_limit: 4_000, long: 8_000 };
}

/// One body that strikes one surface.
#[derive(Clone, Debug)]
pub struct Case {
    pub number: u64,
    pub precision: Precision,
    /// A kilometre from the origin.
    pub far: bool,
    /// Its exact state is registered; else Rapier's rounded one is all there is.
    pub registered: bool,
    pub form: Form,
    pub target: Target,
    pub elastic: Elastic,
    pub flow: Flow,
    /// [Pa]
    pub young: f64,
    /// [Pa]
    pub hardness: f64,
    /// Largest extent of the body [m].
    pub size: f64,
    /// [kg]
    pub mass: f64,
    /// [m/s]
    pub speed: f64,
    /// From the surface [deg].
    pub angle: f64,
    /// mu [-]
    pub friction: f64,
    /// mu_a [-]
    pub shear_ratio: f64,
    /// Of the embedder's world [s].
    pub dt: f64,
    pub rotation: UnitQuaternion<f64>,
    /// Distance between body and surface at the start, in the way of one `dt`.
    pub gap_steps: f64,
    /// Traction over hardness, and range over the contact radius [-], of a surface that adheres.
    pub adhesion: Option<[f64; 2]>,
    pub means: Means,
}

/// Numbers from a seed: splitmix64 (Steele, Lea & Flood 2014).
struct Draw(u64);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in the logarithm.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.within(low.ln(), high.ln()).exp()
    }

    fn chance(&mut self, share: f64) -> bool {
        self.within(0.0, 1.0) < share
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[(self.bits() % from.len() as u64) as usize]
    }

    /// Uniform over all turns (Shoemake 1992).
    fn turn(&mut self) -> UnitQuaternion<f64> {
        let [u, a, b] = [self.within(0.0, 1.0), self.within(0.0, TAU), self.within(0.0, TAU)];
        let (s, c) = ((1.0 - u).sqrt(), u.sqrt());
        let [x, y, z, w] = [s * a.sin(), s * a.cos(), c * b.sin(), c * b.cos()];
        UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z))
    }
}

impl Case {
    pub fn numbered(number: u64) -> Self {
        let mut draw = Draw(SEED ^ number.wrapping_mul(0xd134_2543_de82_ef95));
        draw.bits();
        let form = draw.pick(&[Form::Ball, Form::Cube, Form::Needle, Form::Plate, Form::Clump]);
        let size = draw.decades(1e-6, 10.0);
        // Half of them of a stuff that there is, half as heavy or light as no stuff is.
        let mass = match draw.chance(0.5) {
            true => (draw.decades(100.0, 2e4) * size.powi(3)).clamp(1e-15, 1e6),
            false => draw.decades(1e-15, 1e6),
        };
        Self {
            number,
            precision: draw.pick(&[Precision::Single, Precision::Double]),
            far: draw.chance(0.5),
            registered: draw.chance(0.5),
            form,
            target: draw.pick(&[
                Target::Strip,
                Target::Strip,
                Target::Strip,
                Target::Strip,
                Target::Cuboid,
                Target::Sphere,
            ]),
            elastic: draw.pick(&[Elastic::Foundation, Elastic::Foundation, Elastic::Rigid]),
            flow: draw.pick(&[Flow::CapozzaHanley, Flow::CapozzaHanley, Flow::NormalPressure]),
            young: draw.decades(1e6, 1e13),
            hardness: draw.decades(1e3, 1e11),
            size,
            mass,
            speed: draw.decades(1e-4, 5e3),
            angle: match draw.chance(0.3) {
                true => draw.decades(0.1, 10.0),
                false => draw.within(0.1, 90.0),
            },
            friction: draw.within(0.0, 2.0),
            shear_ratio: draw.within(0.0, 1.5),
            dt: draw.decades(1e-7, 1.0 / 30.0),
            rotation: draw.turn(),
            gap_steps: draw.within(0.3, 3.0),
            adhesion: None,
            means: Means::USUAL,
        }
    }

    /// The same case on a surface that adheres.
    pub fn sticky(number: u64) -> Self {
        let mut draw = Draw(!SEED ^ number.wrapping_mul(0xd134_2543_de82_ef95));
        draw.bits();
        let adhesion = Some([draw.decades(1e-3, 0.99), draw.decades(1e-3, 1.0)]);
        Self { adhesion, elastic: Elastic::Foundation, ..Self::numbered(number) }
    }

    /// [m/s], +x and downwards.
    pub fn velocity(&self) -> Vector3<f64> {
        let (sin, cos) = self.angle.to_radians().sin_cos();
        Vector3::new(self.speed * cos, 0.0, -self.speed * sin)
    }

    /// Where the top of the surface lies in the world [m].
    pub fn origin(&self) -> Vector3<f64> {
        match self.far {
            true => Vector3::new(600.0, -640.0, 480.0),
            false => Vector3::zeros(),
        }
    }

    /// Radius of a ball that would leave about such a crater [m].
    pub fn radius(&self) -> f64 {
        0.5 * self.size
            * match self.form {
                Form::Ball | Form::Cube | Form::Clump => 1.0,
                Form::Needle => 0.1,
                Form::Plate => 0.5,
            }
    }

    /// Depth to which a ball of that radius would be expected to come [m]: rigid-plastic, or
    /// elastic where that is deeper.
    pub fn depth(&self) -> f64 {
        let (radius, down) = (self.radius(), self.velocity().z.abs());
        let plastic = down * (self.mass / (TAU * radius * self.hardness)).sqrt();
        let elastic = (self.mass * down * down / (self.young * radius.sqrt())).powf(0.4);
        plastic.max(elastic.min(1e-2 * radius)).min(radius)
    }

    /// Radius of the contact that goes with it [m].
    pub fn contact_radius(&self) -> f64 {
        (2.0 * self.radius() * self.depth()).sqrt().min(self.radius())
    }
}
