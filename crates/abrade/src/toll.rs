//! What a step of the swept rule takes from a body.

use nalgebra::{Isometry3, Vector3};

/// Impulses on a body over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Push {
    /// Impulse [N s] and impulsive torque about the centre of mass [N m s].
    pub impulse: Vector3<f64>,
    pub torque: Vector3<f64>,
    /// The impulses of the nodes, each along its normal [N s]; of columns alone.
    pub normal: f64,
    /// Energy that slip under these impulses dissipates [J].
    pub friction: f64,
}

/// What a step takes from the body.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Toll {
    /// Of the faces that sweep, and the price of the removed volume [J].
    pub flow: Push,
    pub wear: f64,
    /// Of the springs, the change of their energy [J], and the part of it lost sideways.
    pub spring: Push,
    pub elastic: f64,
    pub lost: f64,
    /// Of what they took, the part that Archard's law wore off [J].
    pub archard: f64,
    /// Sum of stiffnesses along the face normals [N/m].
    pub stiffness: f64,
    /// Sum of the effective areas of the columns that flow [m2].
    pub flow_area: f64,
    /// Columns that pay or carry force.
    pub touching: usize,
}

impl Push {
    pub(crate) fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        self.impulse += pose * other.impulse;
        self.torque += pose * other.torque;
        self.normal += other.normal;
        self.friction += other.friction;
    }

    /// Scaled, friction included.
    pub(crate) fn scaled(&self, scale: f64) -> Self {
        Self {
            impulse: self.impulse * scale,
            torque: self.torque * scale,
            normal: self.normal * scale,
            friction: self.friction * scale,
        }
    }
}

impl Toll {
    /// Adds the toll of another surface, whose frame is `pose`.
    pub(crate) fn add(&mut self, other: &Self, pose: &Isometry3<f64>) {
        self.flow.add(&other.flow, pose);
        self.spring.add(&other.spring, pose);
        self.wear += other.wear;
        self.elastic += other.elastic;
        self.lost += other.lost;
        self.archard += other.archard;
        self.stiffness += other.stiffness;
        self.touching += other.touching;
    }
}
