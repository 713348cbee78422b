//! The computation as one writes it first: homogeneous matrices, link by link.

use nalgebra::{Matrix4, Vector3, Vector4};
use trueaxis_machine::axis::{Axis, AxisKind, Command};
use trueaxis_machine::errors::{Curve, StatedError};
use trueaxis_machine::{ErrorFrame, Machine};

/// Six errors to a matrix.
pub type ErrorMatrix = fn(&[f64; 6]) -> Matrix4<f64>;

/// One body with its constant matrices and its splines.
struct PlainBody {
    placement: Matrix4<f64>,
    mounting: Matrix4<f64>,
    /// Placement and location errors.
    actual_placement: Matrix4<f64>,
    axis: Option<(usize, Axis)>,
    is_moving: bool,
    splines: Option<PlainSplines>,
}

/// Six splines over the same even knots: as kind to the plain way as to the fast one.
struct PlainSplines {
    from: f64,
    per_step: f64,
    knots: Vec<f64>,
    pieces: [Vec<[f64; 4]>; 6],
}

impl PlainSplines {
    fn of(stated: &[Option<StatedError>; 6]) -> Option<Self> {
        let spline = |stated: &Option<StatedError>| match &stated.as_ref()?.mean {
            Curve::Table { spline, .. } => Some(spline.clone()),
            _ => None,
        };
        let first = spline(&stated[0])?;
        let (from, to) = first.range();
        let per_step = first.pieces().len() as f64 / (to - from);
        let pieces =
            stated.each_ref().map(|s| spline(s).map_or(Vec::new(), |s| s.pieces().to_vec()));
        Some(Self { from, per_step, knots: first.knots().to_vec(), pieces })
    }

    fn at(&self, q: f64) -> [f64; 6] {
        let last = self.pieces[0].len() - 1;
        let i = (((q - self.from) * self.per_step) as usize).min(last);
        let h = q - self.knots[i];
        std::array::from_fn(|k| {
            let [c0, c1, c2, c3] = self.pieces[k][i];
            ((c3 * h + c2) * h + c1) * h + c0
        })
    }
}

/// What a pose gives.
pub struct PlainDeviation {
    /// Nominal tip.
    pub nominal_tip_mm: Vector3<f64>,
    /// Nominal axis.
    pub nominal_axis: Vector3<f64>,
    /// Actual minus nominal tip.
    pub tip_mm: Vector3<f64>,
    /// Actual minus nominal axis.
    pub axis: Vector3<f64>,
}

/// A machine as a list of matrices.
pub struct PlainMachine {
    workpiece: Vec<PlainBody>,
    tool: Vec<PlainBody>,
    tip: Vector4<f64>,
    error: ErrorMatrix,
}

impl PlainMachine {
    /// Takes the matrices out of a machine.
    pub fn of(machine: &Machine, error: ErrorMatrix) -> Self {
        let location = |stated: &Option<StatedError>| match stated.as_ref().map(|s| &s.mean) {
            Some(Curve::Constant(value)) => *value,
            _ => 0.0,
        };
        let mut workpiece: Vec<PlainBody> = machine
            .bodies()
            .iter()
            .map(|body| (body, matrix(body.placement.linear(), body.placement.shift_mm())))
            .map(|(body, placement)| PlainBody {
                placement,
                mounting: matrix(body.mounting.linear(), body.mounting.shift_mm()),
                actual_placement: placement * error(&body.location.each_ref().map(location)),
                axis: body.axis.map(|i| (i, machine.axes()[i].clone())),
                is_moving: body.error_frame == ErrorFrame::Moving,
                splines: PlainSplines::of(&body.motion),
            })
            .collect();
        let tool = workpiece.split_off(machine.workpiece_side());
        workpiece.reverse();
        let tip = machine.tip_mm();
        Self { workpiece, tool, tip: Vector4::new(tip.x, tip.y, tip.z, 1.0), error }
    }

    /// Nominal and actual product, and their difference.
    pub fn deviation(&self, command: &Command) -> PlainDeviation {
        let [nominal_workpiece, actual_workpiece] = product(&self.workpiece, command, self.error);
        let [nominal_tool, actual_tool] = product(&self.tool, command, self.error);
        let nominal = rigid_inverse(&nominal_workpiece) * nominal_tool;
        let actual = rigid_inverse(&actual_workpiece) * actual_tool;
        let z = Vector4::new(0.0, 0.0, 1.0, 0.0);
        let (tip, axis) = (nominal * self.tip, nominal * z);
        PlainDeviation {
            nominal_tip_mm: tip.xyz(),
            nominal_axis: axis.xyz(),
            tip_mm: (actual * self.tip - tip).xyz(),
            axis: (actual * z - axis).xyz(),
        }
    }
}

fn product(bodies: &[PlainBody], command: &Command, error: ErrorMatrix) -> [Matrix4<f64>; 2] {
    let mut products = [Matrix4::identity(); 2];
    for body in bodies {
        let (mut nominal, mut actual) = (body.placement, body.actual_placement);
        if let Some((index, axis)) = &body.axis {
            let q = command[*index];
            let joint = joint(axis, q);
            let motion = body.splines.as_ref().map_or(Matrix4::identity(), |s| error(&s.at(q)));
            nominal *= joint;
            actual *= if axis.kind == AxisKind::Rotary && !body.is_moving {
                motion * joint
            } else {
                joint * motion
            };
        }
        products[0] *= nominal * body.mounting;
        products[1] *= actual * body.mounting;
    }
    products
}

fn joint(axis: &Axis, q: f64) -> Matrix4<f64> {
    let q = axis.sense * q;
    match axis.kind {
        AxisKind::Linear => Matrix4::new_translation(&(axis.direction * q)),
        AxisKind::Rotary => Matrix4::new_rotation(axis.direction * q),
    }
}

fn matrix(linear: &nalgebra::Matrix3<f64>, shift: &Vector3<f64>) -> Matrix4<f64> {
    linear.to_homogeneous().append_translation(shift)
}

fn rigid_inverse(pose: &Matrix4<f64>) -> Matrix4<f64> {
    let back = pose.fixed_view::<3, 3>(0, 0).transpose();
    let shift = back * pose.fixed_view::<3, 1>(0, 3);
    matrix(&back, &-shift)
}

/// `shift · Rz(c)·Ry(b)·Rx(a)`
pub fn exact(&[x, y, z, a, b, c]: &[f64; 6]) -> Matrix4<f64> {
    let ((sa, ca), (sb, cb), (sc, cc)) = (a.sin_cos(), b.sin_cos(), c.sin_cos());
    Matrix4::new(
        cb * cc,
        sa * sb * cc - ca * sc,
        ca * sb * cc + sa * sc,
        x,
        cb * sc,
        sa * sb * sc + ca * cc,
        ca * sb * sc - sa * cc,
        y,
        -sb,
        sa * cb,
        ca * cb,
        z,
        0.0,
        0.0,
        0.0,
        1.0,
    )
}

/// `shift · (I + [ε]×)`: cheaper than the same computation, shown beside it.
pub fn small_angle(&[x, y, z, a, b, c]: &[f64; 6]) -> Matrix4<f64> {
    Matrix4::new(1.0, -c, b, x, c, 1.0, -a, y, -b, a, 1.0, z, 0.0, 0.0, 0.0, 1.0)
}
