//! Every point turns about an axis by an angle of its own: the kinematics of all vortices.
//!
//! x = c + Q(α) d (+ Z), with d the arm from the axis to X, Q the rotation about z by
//! α = g(t) h(R²) ζ(Z), R = |d|, and S the turn by 90°, so that Q′ = Q S. From Q″ = −Q off the axis,
//! with a, b any two of X, Y, Z, t and e_a = ∂d/∂a:
//!
//! x,a = Q (e_a + S d α,a),
//! x,ab = Q (S (e_a α,b + e_b α,a + d α,ab) − d α,a α,b).
//!
//! ∇α has no hoop component, so det F = 1. In terms of r, θ, z this is the generalised vortex of
//! Kamojjala, Brannon, Sadeghirad & Guilkey 2015 (doi:10.1007/s00366-013-0342-x); h as a function of
//! R² spares the division by R on the axis.

use super::common::ANGULAR_FREQUENCY;
use super::{Exact, Material, sine};
use crate::Error;
use crate::parameter::{Parameters, number, parameters};
use nalgebra::{Matrix3, Matrix3x4, Matrix4, Vector3, Vector4};
use std::f64::consts::PI;

/// The turn by 90° about z.
const QUARTER: Matrix3<f64> = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0);

/// Where a point is, and the factors of its angle α = g(t) h(R²) ζ(Z), each with its first and second derivative.
pub(super) struct Place {
    /// The arm d from the axis (m).
    pub(super) arm: [f64; 2],
    /// h(R²) and its derivatives by R² (-, 1/m², 1/m⁴).
    pub(super) profile: [f64; 3],
    /// ζ(Z) (-, 1/m, 1/m²).
    pub(super) height: [f64; 3],
}

/// ζ of a motion in the plane.
pub(super) const PLANE: [f64; 3] = [1.0, 0.0, 0.0];

/// The motion of a point.
pub(super) struct Twist {
    /// Arm d from the axis (m).
    arm: Vector3<f64>,
    /// Q(α).
    rotation: Matrix3<f64>,
    /// α,a with a = X, Y, Z, t (rad/m, rad/s).
    gradient: Vector4<f64>,
    /// α,ab.
    hessian: Matrix4<f64>,
}

impl Twist {
    /// The motion of a point with g(t) (rad, rad/s, rad/s²).
    fn new([g, g_t, g_tt]: [f64; 3], place: &Place) -> Self {
        let Place { arm: [x, y], profile: [h, h_s, h_ss], height: [z, z_z, z_zz] } = *place;
        let arm = Vector3::new(x, y, 0.0);
        let axis = Vector3::z();
        let (sin, cos) = (g * h * z).sin_cos();
        let space = 2.0 * h_s * g * z * arm + h * g * z_z * axis;
        let plane = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
        let across = 2.0 * h_s * g * z_z * (arm * axis.transpose() + axis * arm.transpose());
        let space_space = g * z * (2.0 * h_s * plane + 4.0 * h_ss * arm * arm.transpose())
            + across
            + h * g * z_zz * axis * axis.transpose();
        let space_time = 2.0 * h_s * g_t * z * arm + h * g_t * z_z * axis;
        let mut hessian = space_space.to_homogeneous();
        hessian.fixed_view_mut::<3, 1>(0, 3).copy_from(&space_time);
        hessian.fixed_view_mut::<1, 3>(3, 0).copy_from(&space_time.transpose());
        hessian[(3, 3)] = h * g_tt * z;
        Self {
            arm,
            rotation: Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0),
            gradient: space.push(h * g_t * z),
            hessian,
        }
    }

    /// u = (Q − I) d (m).
    pub(super) fn displacement(&self) -> Vector3<f64> {
        self.rotation * self.arm - self.arm
    }

    /// x,a: F in the first three columns, v (m/s) in the last.
    pub(super) fn first_derivatives(&self) -> Matrix3x4<f64> {
        self.rotation * (Matrix3x4::identity() + QUARTER * self.arm * self.gradient.transpose())
    }

    /// x,ab of each component of x.
    pub(super) fn second_derivatives(&self) -> [Matrix4<f64>; 3] {
        let turned = self.rotation * QUARTER;
        let (tangent, radius) = (turned * self.arm, self.rotation * self.arm);
        let square = self.gradient * self.gradient.transpose();
        [0, 1, 2].map(|i| {
            let edge = turned.row(i).transpose().push(0.0) * self.gradient.transpose();
            edge + edge.transpose() + tangent[i] * self.hessian - radius[i] * square
        })
    }

    /// F.
    pub(super) fn deformation_gradient(&self) -> Matrix3<f64> {
        self.first_derivatives().fixed_columns::<3>(0).into_owned()
    }

    /// v (m/s).
    pub(super) fn velocity(&self) -> Vector3<f64> {
        self.first_derivatives().column(3).into_owned()
    }

    /// P = μ R Q (E_Θ ⊗ ∇α + ∇α ⊗ E_Θ) (Pa), with R E_Θ = S d.
    pub(super) fn first_piola(&self, mu: f64) -> Matrix3<f64> {
        let shear = QUARTER * self.arm * self.gradient.xyz().transpose();
        mu * self.rotation * (shear + shear.transpose())
    }

    /// b = b_r e_r + b_θ e_θ (m/s²), e_r and e_θ at the turned place:
    ///
    /// b_r = −R α_t² + (μ/ρ₀) R |∇α|², b_θ = R α_tt − (μ/ρ₀) (2 α_R + R Δα),
    ///
    /// with R e_r = Q d, R e_θ = Q S d, α_R e_θ = Q S ∇α and Δα = α_RR + α_R/R + α_ZZ.
    pub(super) fn body_force(&self, material: &Material) -> Vector3<f64> {
        let c2 = material.mu / material.density;
        let gradient = self.gradient.xyz();
        let laplacian = self.hessian.fixed_view::<3, 3>(0, 0).trace();
        let radial = c2 * gradient.norm_squared() - self.gradient.w.powi(2);
        let hoop = self.hessian[(3, 3)] - c2 * laplacian;
        self.rotation * (radial * self.arm + QUARTER * (hoop * self.arm - 2.0 * c2 * gradient))
    }
}

parameters! { pub const:
    ANGLE = "angle", "rad", "1", number(0.0, PI, false), "largest angle α₀";
}

/// Where and by which factors of α₀ sin ωt the points of a vortex turn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    /// As [`Exact::dimension`].
    pub(super) dimension: usize,
    /// As [`Exact::extent`].
    pub(super) extent: [[f64; 2]; 3],
    /// Function that gives the place of a reference point (m).
    pub(super) place: fn(&Vector3<f64>) -> Place,
}

/// A solution whose every point only turns: isochoric, with u, P and b independent of λ.
#[derive(Debug, Clone, Copy)]
pub struct Vortex {
    /// Density and moduli.
    pub material: Material,
    /// Largest angle α₀ (rad).
    pub angle: f64,
    /// Angular frequency ω (rad/s).
    pub angular_frequency: f64,
    shape: Shape,
}

impl Vortex {
    /// The vortex of a shape with the parameters of its solution.
    ///
    /// # Errors
    /// Moduli that the law does not allow.
    pub(super) fn new(p: &Parameters, shape: Shape) -> Result<Self, Error> {
        Ok(Self {
            material: Material::new(p)?,
            angle: p.number(ANGLE),
            angular_frequency: p.number(ANGULAR_FREQUENCY),
            shape,
        })
    }

    /// The motion of the point `x` (m) at time `t` (s).
    pub(super) fn twist(&self, x: &Vector3<f64>, t: f64) -> Twist {
        let growth = sine(self.angular_frequency, t).map(|s| self.angle * s);
        Twist::new(growth, &(self.shape.place)(x))
    }
}

impl Exact for Vortex {
    fn dimension(&self) -> usize {
        self.shape.dimension
    }

    fn material(&self) -> Material {
        self.material
    }

    fn extent(&self) -> [[f64; 2]; 3] {
        self.shape.extent
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.twist(x, t).displacement()
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.twist(x, t).velocity()
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        self.twist(x, t).deformation_gradient()
    }

    fn jacobian(&self, _: &Vector3<f64>, _: f64) -> f64 {
        1.0
    }

    fn first_piola(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        self.twist(x, t).first_piola(self.material.mu)
    }

    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.twist(x, t).body_force(&self.material)
    }
}
