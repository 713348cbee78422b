//! A form evaluation for programs: the document `trueaxis/evaluate-form/1`.

use super::form::FormShown;
use crate::form::Decision;
use serde::Serialize;
use trueaxis_form::{Proof, Reference, Source};
use trueaxis_report::JsonSchema;

const UM: f64 = 1e3;

/// The form of points: `trueaxis/evaluate-form/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FormDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/evaluate-form/1"))]
    pub schema: &'static str,
    /// The version of the program.
    pub version: &'static str,
    /// The file of the points.
    pub file: &'a str,
    /// `line`, `plane`, `circle`, `sphere`, `cylinder` or `cone`.
    pub element: &'static str,
    /// What its form deviation is called, such as `roundness`.
    pub deviation: &'static str,
    /// How many points the file has.
    pub points: usize,
    /// The normal of the plane of a profile or circle, if it is known. Unit: 1.
    pub plane_normal: Option<[f64; 3]>,
    /// The filter; null if there is none.
    pub filter: Option<String>,
    /// The reference element that decides: `LSC`, `MZC`, `MCC` or `MIC`.
    pub reference: &'static str,
    /// The form deviation by it, µm.
    pub form_um: f64,
    /// Its expanded uncertainty, µm; null if nothing is known of the points.
    #[serde(rename = "U_um")]
    pub expanded_um: Option<f64>,
    /// The tolerance, µm; null if there is none.
    pub tolerance_um: Option<f64>,
    /// `pass`, `fail` or `undecided` by ISO 14253-1; null without a tolerance.
    pub decision: Option<&'static str>,
    /// The least-squares element.
    pub least_squares: LeastSquaresEntry,
    /// Every reference element.
    pub references: Vec<ReferenceEntry>,
    /// Angle with points, degrees; null for lines and planes.
    pub covered_deg: Option<f64>,
    /// Deviations of the points from the deciding element, after the filter, µm.
    pub deviations_um: Vec<f64>,
}

/// The least-squares element with standard uncertainties (k = 1); null where nothing is known of the points.
#[derive(Debug, Serialize, JsonSchema)]
pub struct LeastSquaresEntry {
    /// Centre, or point of the element next to the middle of the points, mm.
    pub point_mm: [f64; 3],
    /// Its standard uncertainty, mm.
    pub point_u_mm: Option<[f64; 3]>,
    /// Direction of the line or axis, or normal; null for a sphere. Unit: 1.
    pub direction: Option<[f64; 3]>,
    /// Its standard uncertainty. Unit: 1.
    pub direction_u: Option<[f64; 3]>,
    /// Angle to the nearest axis of the frame, degrees; null for a sphere.
    pub tilt_deg: Option<f64>,
    /// That axis.
    pub tilt_to: Option<char>,
    /// Its standard uncertainty, degrees.
    pub tilt_u_deg: Option<f64>,
    /// Radius, of a cone at its point; null for lines and planes, mm.
    pub radius_mm: Option<f64>,
    /// Its standard uncertainty, mm.
    pub radius_u_mm: Option<f64>,
    /// Half of the angle at the apex of a cone, degrees.
    pub half_angle_deg: Option<f64>,
    /// Its standard uncertainty, degrees.
    pub half_angle_u_deg: Option<f64>,
    /// Apex of a cone, mm.
    pub apex_mm: Option<[f64; 3]>,
    /// Standard deviation of the residuals, µm.
    pub residual_um: f64,
    /// Their degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Standard deviation along the normal of a circle, if its plane was fitted, µm.
    pub axial_residual_um: Option<f64>,
    /// Standard uncertainty of a point that the others follow from, µm.
    pub point_uncertainty_um: Option<f64>,
    /// Where it comes from: `stated`, `scatter`, or `scatter, larger than stated`.
    pub uncertainty_from: Option<&'static str>,
    /// k for U of these values. Unit: 1.
    pub coverage_factor: Option<f64>,
}

/// One reference element.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ReferenceEntry {
    /// `LSC`, `MZC`, `MCC` or `MIC`.
    pub reference: &'static str,
    /// The form deviation, µm.
    pub form_um: f64,
    /// Its expanded uncertainty, µm.
    #[serde(rename = "U_um")]
    pub expanded_um: Option<f64>,
    /// Its standard deviation by noise of the points, µm.
    pub noise_u_um: Option<f64>,
    /// What noise adds to it at most, µm.
    pub noise_bias_um: Option<f64>,
    /// Centre, or point of the element, mm.
    pub point_mm: [f64; 3],
    /// Direction or normal; null for a sphere. Unit: 1.
    pub direction: Option<[f64; 3]>,
    /// Radius; null for lines and planes, mm.
    pub radius_mm: Option<f64>,
    /// Half of the angle at the apex of a cone, degrees.
    pub half_angle_deg: Option<f64>,
    /// `global`, `bound`, `local` or `none`; null for least squares.
    pub proof: Option<&'static str>,
    /// With `bound`: no other element has a smaller form deviation (inscribed: larger radius) than this, mm.
    pub bound_mm: Option<f64>,
    /// With `local`: starts that were tried, and those that came to this result.
    pub starts: Option<[usize; 2]>,
    /// The points that hold it.
    pub contacts: Vec<ContactEntry>,
}

/// A point that holds an element.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ContactEntry {
    /// Its number, from 1, after the filter.
    pub point: usize,
    /// `outer` or `inner`.
    pub side: &'static str,
    /// Its multiplier. Unit: 1.
    pub weight: f64,
}

impl<'a> FormDocument<'a> {
    /// The document of an evaluation.
    pub fn of(shown: &FormShown<'a>) -> Self {
        let found = shown.found;
        let deciding = found.deciding();
        Self {
            schema: "trueaxis/evaluate-form/1",
            version: trueaxis_report::VERSION,
            file: shown.file,
            element: found.fitted.element.key(),
            deviation: found.fitted.element.deviation_name(),
            points: found.points_read,
            plane_normal: found.normal.map(Into::into),
            filter: found.filter.map(crate::form::Filter::text),
            reference: deciding.criterion.key(),
            form_um: found.form_mm() * UM,
            expanded_um: found.expanded_mm(deciding.criterion).map(|u| u * UM),
            tolerance_um: found.tolerance_mm.map(|t| t * UM),
            decision: found.decision().map(|d| match d {
                Decision::Pass => "pass",
                Decision::Fail => "fail",
                Decision::Undecided => "undecided",
            }),
            least_squares: least_squares(shown),
            references: found.fitted.references.iter().map(|r| reference(shown, r)).collect(),
            covered_deg: found.cover.angle_rad.map(f64::to_degrees),
            deviations_um: found.deviations_mm().into_iter().map(|d| d * UM).collect(),
        }
    }
}

fn least_squares(shown: &FormShown<'_>) -> LeastSquaresEntry {
    let found = shown.found;
    let (fitted, shape, u) = (&found.fitted, found.fitted.shape(), found.uncertainty);
    let has_direction = shape.direction.norm() > 0.5;
    let has_radius = shape.radius_mm > 0.0;
    let is_cone = fitted.element == crate::form::Element::Cone;
    let tilt = found.tilt();
    LeastSquaresEntry {
        point_mm: shape.point_mm.into(),
        point_u_mm: u.map(|u| u.point_mm),
        direction: has_direction.then(|| shape.direction.into()),
        direction_u: u.filter(|_| has_direction).map(|u| u.direction),
        tilt_deg: tilt.map(|t| t.0.to_degrees()),
        tilt_to: tilt.map(|t| t.1),
        tilt_u_deg: tilt.and_then(|_| found.tilt_u_rad()).map(f64::to_degrees),
        radius_mm: has_radius.then_some(shape.radius_mm),
        radius_u_mm: u.filter(|_| has_radius).map(|u| u.radius_mm),
        half_angle_deg: is_cone.then(|| shape.half_angle_rad.to_degrees()),
        half_angle_u_deg: u.filter(|_| is_cone).map(|u| u.half_angle_rad.to_degrees()),
        apex_mm: shape.apex_mm().map(Into::into),
        residual_um: fitted.residual_deviation_mm * UM,
        degrees_of_freedom: fitted.degrees_of_freedom,
        axial_residual_um: fitted.axial_deviation_mm.map(|(s, _)| s * UM),
        point_uncertainty_um: u.map(|u| u.of_point.u_mm * UM),
        uncertainty_from: u.map(|u| match u.of_point.source {
            Source::Stated => "stated",
            Source::Scatter => "scatter",
            Source::Neighbours => "neighbours",
            Source::LargerScatter => "scatter, larger than stated",
        }),
        coverage_factor: u.map(|u| u.of_point.coverage),
    }
}

fn reference(shown: &FormShown<'_>, r: &Reference) -> ReferenceEntry {
    let found = shown.found;
    let noise = found.noise.iter().find(|(c, _)| *c == r.criterion).map(|(_, n)| *n);
    let is_cone = found.fitted.element == crate::form::Element::Cone;
    let contact = |c: &trueaxis_form::Contact| ContactEntry {
        point: c.index + 1,
        side: if c.is_outer { "outer" } else { "inner" },
        weight: c.weight,
    };
    ReferenceEntry {
        reference: r.criterion.key(),
        form_um: r.form_mm() * UM,
        expanded_um: found.expanded_mm(r.criterion).map(|u| u * UM),
        noise_u_um: noise.map(|n| n.u_mm * UM),
        noise_bias_um: noise.map(|n| n.bias_mm * UM),
        point_mm: r.shape.point_mm.into(),
        direction: (r.shape.direction.norm() > 0.5).then(|| r.shape.direction.into()),
        radius_mm: (r.shape.radius_mm > 0.0).then_some(r.shape.radius_mm),
        half_angle_deg: is_cone.then(|| r.shape.half_angle_rad.to_degrees()),
        proof: r.proof.map(|p| match p {
            Proof::Global => "global",
            Proof::Bound(_) => "bound",
            Proof::Local { .. } => "local",
            Proof::None => "none",
        }),
        bound_mm: match r.proof {
            Some(Proof::Bound(mm)) => Some(mm),
            _ => None,
        },
        starts: match r.proof {
            Some(Proof::Local { starts, agreed }) => Some([starts, agreed]),
            _ => None,
        },
        contacts: r.contacts.iter().map(contact).collect(),
    }
}
