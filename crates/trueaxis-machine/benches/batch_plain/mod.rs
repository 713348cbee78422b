//! The computation as one writes it first: homogeneous matrices, link by link.

use nalgebra::{Matrix4, Rotation3, Unit, Vector3, Vector4};
use trueaxis_machine::axis::{Axis, AxisKind, Command};
use trueaxis_machine::chain::ChainBody;
use trueaxis_machine::errors::{Curve, StatedError};
use trueaxis_machine::{ErrorFrame, Machine};

/// Six errors to a matrix.
pub trait ErrorMatrix {
    /// The matrix.
    fn of(errors: &[f64; 6]) -> Matrix4<f64>;
}

/// `shift · Rz(c)·Ry(b)·Rx(a)`
pub struct Exact;

/// `shift · (I + [ε]×)`: cheaper than the same computation, shown for comparison.
pub struct SmallAngle;

/// One body; what stands between two axes and never moves is one matrix.
struct PlainBody {
    /// Mounting of the body before and placement of this one.
    placement: Matrix4<f64>,
    /// The same with the location errors.
    actual_placement: Matrix4<f64>,
    axis: Option<PlainAxis>,
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

/// An axis with its direction as nalgebra wants it.
struct PlainAxis {
    index: usize,
    kind: AxisKind,
    direction: Unit<Vector3<f64>>,
    sense: f64,
}

impl PlainAxis {
    fn of(axis: &Axis, index: usize) -> Self {
        let direction = Unit::new_unchecked(axis.direction);
        Self { index, kind: axis.kind, direction, sense: axis.sense }
    }

    fn joint(&self, q: f64) -> Matrix4<f64> {
        let q = self.sense * q;
        match self.kind {
            AxisKind::Linear => Matrix4::new_translation(&(self.direction.into_inner() * q)),
            AxisKind::Rotary => Rotation3::from_axis_angle(&self.direction, q).to_homogeneous(),
        }
    }
}

/// One side of the bed, from the bed outwards.
struct PlainSide {
    bodies: Vec<PlainBody>,
    /// The mounting of the last body.
    end: Matrix4<f64>,
}

impl PlainSide {
    fn of<'a, E: ErrorMatrix>(
        machine: &Machine,
        bodies: impl Iterator<Item = &'a ChainBody>,
    ) -> Self {
        let location = |stated: &Option<StatedError>| match stated.as_ref().map(|s| &s.mean) {
            Some(Curve::Constant(value)) => *value,
            _ => 0.0,
        };
        let mut side = Self { bodies: Vec::new(), end: Matrix4::identity() };
        for body in bodies {
            let placement = side.end * matrix(body.placement.linear(), body.placement.shift_mm());
            side.bodies.push(PlainBody {
                placement,
                actual_placement: placement * E::of(&body.location.each_ref().map(location)),
                axis: body.axis.map(|i| PlainAxis::of(&machine.axes()[i], i)),
                is_moving: body.error_frame == ErrorFrame::Moving,
                splines: PlainSplines::of(&body.motion),
            });
            side.end = matrix(body.mounting.linear(), body.mounting.shift_mm());
        }
        side
    }

    /// Nominal and actual product.
    fn products<E: ErrorMatrix>(&self, command: &Command) -> [Matrix4<f64>; 2] {
        let [mut nominal, mut actual] = [Matrix4::<f64>::identity(); 2];
        for body in &self.bodies {
            nominal *= body.placement;
            actual *= body.actual_placement;
            let Some(axis) = &body.axis else { continue };
            let q = command[axis.index];
            let joint = axis.joint(q);
            nominal *= joint;
            let Some(splines) = &body.splines else {
                actual *= joint;
                continue;
            };
            let motion = E::of(&splines.at(q));
            let is_fixed = axis.kind == AxisKind::Rotary && !body.is_moving;
            actual *= if is_fixed { motion * joint } else { joint * motion };
        }
        [nominal * self.end, actual * self.end]
    }
}

/// A machine as matrices.
pub struct PlainMachine {
    workpiece: PlainSide,
    tool: PlainSide,
    tip: Vector4<f64>,
}

impl PlainMachine {
    /// Takes the matrices out of a machine.
    pub fn of<E: ErrorMatrix>(machine: &Machine) -> Self {
        let (workpiece, tool) = machine.bodies().split_at(machine.workpiece_side());
        let tip = machine.tip_mm();
        Self {
            workpiece: PlainSide::of::<E>(machine, workpiece.iter().rev()),
            tool: PlainSide::of::<E>(machine, tool.iter()),
            tip: Vector4::new(tip.x, tip.y, tip.z, 1.0),
        }
    }

    /// Nominal and actual product, and their difference.
    pub fn deviation<E: ErrorMatrix>(&self, command: &Command) -> PlainDeviation {
        let [nominal_workpiece, actual_workpiece] = self.workpiece.products::<E>(command);
        let [nominal_tool, actual_tool] = self.tool.products::<E>(command);
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

fn matrix(linear: &nalgebra::Matrix3<f64>, shift: &Vector3<f64>) -> Matrix4<f64> {
    linear.to_homogeneous().append_translation(shift)
}

fn rigid_inverse(pose: &Matrix4<f64>) -> Matrix4<f64> {
    let back = pose.fixed_view::<3, 3>(0, 0).transpose();
    let shift = back * pose.fixed_view::<3, 1>(0, 3);
    matrix(&back, &-shift)
}

impl ErrorMatrix for Exact {
    #[inline]
    fn of(&[x, y, z, a, b, c]: &[f64; 6]) -> Matrix4<f64> {
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
}

impl ErrorMatrix for SmallAngle {
    #[inline]
    fn of(&[x, y, z, a, b, c]: &[f64; 6]) -> Matrix4<f64> {
        Matrix4::new(1.0, -c, b, x, c, 1.0, -a, y, -b, a, 1.0, z, 0.0, 0.0, 0.0, 1.0)
    }
}
