//! The document of a path adapted to a blank.

use super::adapt::{AdaptReport, Spread};
use crate::compensate::adapt::{MapCell, remaining_wall};
use serde::Serialize;
use trueaxis_geometry::Vec3;
use trueaxis_report::JsonSchema;

/// A path moved onto a measured blank: `trueaxis/compensate-adapt/1`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct AdaptDocument<'a> {
    /// Which document this is.
    #[schemars(extend("const" = "trueaxis/compensate-adapt/1"))]
    pub schema: &'static str,
    /// The name of the study.
    pub name: &'a str,
    /// The name of the machine.
    pub machine: &'a str,
    /// The file of the path.
    pub path: &'a str,
    /// `good`, `not applied` (words of the path are not) or `not to be cut`.
    pub verdict: &'static str,
    /// Words of the path that can change motion, spindle or coolant and are not applied; the exit status is then 1.
    pub not_applied: usize,
    /// What speaks against the path.
    pub findings: Vec<FindingEntry<'a>>,
    /// How the blank lies.
    pub registration: RegistrationEntry,
    /// The form of the blank.
    pub field: FieldEntry,
    /// The places of the path.
    pub places: PlacesEntry,
    /// The wall that remains.
    pub wall: WallEntry,
    /// The wall place by place.
    pub map: Vec<CellEntry>,
    /// The program of the adapted path; null if none was asked for.
    pub program: Option<ProgramEntry<'a>>,
}

/// What speaks against the path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FindingEntry<'a> {
    /// Its name for programs.
    pub code: &'a str,
    /// The line of the path where it is worst.
    pub line: u32,
    /// At how many places it is so.
    pub places: usize,
    /// What was found.
    pub message: &'a str,
}

/// How the blank lies, with standard uncertainties.
#[derive(Debug, Serialize, JsonSchema)]
pub struct RegistrationEntry {
    /// Which of its freedoms the path follows.
    pub follow: &'static str,
    /// The point about which it turns, mm.
    pub centre_mm: [f64; 3],
    /// The shift, µm.
    pub shift_um: [f64; 3],
    /// Its standard uncertainty, µm.
    pub u_shift_um: [f64; 3],
    /// The turn, µrad.
    pub turn_urad: [f64; 3],
    /// Its standard uncertainty, µrad.
    pub u_turn_urad: [f64; 3],
    /// The freedoms that no reading determines, held at zero.
    pub held: Vec<String>,
}

/// The form of the blank as a smooth field.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FieldEntry {
    /// How many points were probed.
    pub points: usize,
    /// The length over which the form changes, mm.
    pub length_mm: f64,
    /// The standard deviation of the form, µm.
    pub form_um: f64,
    /// The standard deviation of a reading, µm.
    pub noise_um: f64,
    /// The standard uncertainty that all readings share, in full part of that of the field, µm.
    pub common_um: f64,
    /// Each point predicted by all others: root mean square of the difference, µm.
    pub left_out_rms_um: f64,
    /// The share of these differences within U (k = 2). Unit: 1.
    pub left_out_within_u2: f64,
    /// The factor by which the uncertainty was raised. Unit: 1.
    pub raised: f64,
    /// Points that do not fit.
    pub outliers: Vec<OutlierEntry>,
}

/// A point that does not fit.
#[derive(Debug, Serialize, JsonSchema)]
pub struct OutlierEntry {
    /// Its number. Unit: 1.
    pub point: f64,
    /// Its line in the table.
    pub line: u32,
    /// Reading − field, µm.
    pub residual_um: f64,
    /// The same in its standard uncertainty. Unit: 1.
    pub z: f64,
}

/// The places of the path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct PlacesEntry {
    /// How many there are.
    pub all: usize,
    /// At how many the cutter touches the part.
    pub cut: usize,
    /// The smallest and the largest move along the normal, µm.
    pub moved_um: [f64; 2],
    /// The largest standard uncertainty of the move, µm.
    pub largest_u_um: f64,
}

/// The wall that remains.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WallEntry {
    /// The nominal thickness, mm.
    pub thickness_mm: f64,
    /// The layer to be removed, mm.
    pub layer_mm: f64,
    /// The least thickness, mm.
    pub least_mm: f64,
    /// Where the map comes from.
    pub source: String,
    /// As programmed.
    pub before: WallSpread,
    /// Adapted.
    pub after: WallSpread,
    /// The smallest and the largest distance from an equal layer, µm.
    pub off_equal_layer_um: [f64; 2],
}

/// The wall over all places of the map.
#[derive(Debug, Serialize, JsonSchema)]
pub struct WallSpread {
    /// The thinnest, mm.
    pub min_mm: f64,
    /// The mean, mm.
    pub mean_mm: f64,
    /// The thickest, mm.
    pub max_mm: f64,
    /// At how many places it is cut through.
    pub cut_through: usize,
    /// How many places the map has.
    pub places: usize,
}

/// One place of the map.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CellEntry {
    /// Where it is, mm.
    pub at_mm: [f64; 3],
    /// The blank there, µm along the normal.
    pub blank_um: f64,
    /// The field there, µm along the normal.
    pub field_um: f64,
    /// Its standard uncertainty, µm.
    pub u_field_um: f64,
    /// The wall as programmed, mm.
    pub wall_before_mm: f64,
    /// The wall adapted, mm.
    pub wall_after_mm: f64,
    /// Its standard uncertainty, mm.
    pub u_wall_mm: f64,
}

/// The program of the adapted path.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ProgramEntry<'a> {
    /// Where it goes.
    pub file: &'a str,
    /// Whether it was written: only if its proof holds and nothing speaks against the path.
    pub written: bool,
    /// Blocks that move the tool along the path.
    pub blocks: usize,
    /// The largest distance of the tip, read back, from the adapted path, µm.
    pub tip_on_path_um: f64,
    /// Of the tool axis, deg.
    pub axis_on_path_deg: f64,
}

fn xyz(v: &Vec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

impl<'a> AdaptDocument<'a> {
    /// The document of an adapted path.
    pub fn of(report: &AdaptReport<'a>) -> Self {
        let (study, adaptation) = (report.study, report.adaptation);
        let moved = report.moved();
        let findings = adaptation.findings.iter();
        Self {
            schema: "trueaxis/compensate-adapt/1",
            name: &study.name,
            machine: study.machine.name(),
            path: study.path.name(),
            verdict: match (report.is_sound(), report.not_applied) {
                (true, 0) => "good",
                (true, _) => "not applied",
                (false, _) => "not to be cut",
            },
            not_applied: report.not_applied,
            findings: findings
                .map(|f| FindingEntry {
                    code: f.code,
                    line: f.line,
                    places: f.places,
                    message: &f.message,
                })
                .collect(),
            registration: RegistrationEntry::of(report),
            field: FieldEntry::of(report),
            places: PlacesEntry {
                all: adaptation.places.len(),
                cut: report.cut_places(),
                moved_um: [moved.min * 1e3, moved.max * 1e3],
                largest_u_um: report.most_u_mm() * 1e3,
            },
            wall: WallEntry::of(report),
            map: adaptation.map.iter().map(|c| CellEntry::of(report, c)).collect(),
            program: report.program.map(|p| ProgramEntry {
                file: &p.file,
                written: p.written,
                blocks: p.blocks,
                tip_on_path_um: p.tip_mm * 1e3,
                axis_on_path_deg: p.axis_rad.to_degrees(),
            }),
        }
    }
}

impl RegistrationEntry {
    fn of(report: &AdaptReport<'_>) -> Self {
        let r = &report.adaptation.field.registration;
        Self {
            follow: report.study.follow.name(),
            centre_mm: xyz(&r.freedoms.center_mm),
            shift_um: xyz(&(r.shift_mm() * 1e3)),
            u_shift_um: xyz(&(r.u_shift_mm() * 1e3)),
            turn_urad: xyz(&(r.turn_rad() * 1e6)),
            u_turn_urad: xyz(&(r.u_turn_rad() * 1e6)),
            held: r.held_words(),
        }
    }
}

impl FieldEntry {
    fn of(report: &AdaptReport<'_>) -> Self {
        let (study, field) = (report.study, &report.adaptation.field);
        let outliers = field.outliers.iter().map(|o| {
            let point = &study.points[o.index];
            let residual_um = o.residual_mm * 1e3;
            OutlierEntry { point: point.number, line: point.line, residual_um, z: o.z }
        });
        Self {
            points: study.points.len(),
            length_mm: field.covariance.length_mm,
            form_um: field.covariance.form_mm * 1e3,
            noise_um: study.noise_mm * 1e3,
            common_um: field.common_mm * 1e3,
            left_out_rms_um: field.left_out_rms_mm * 1e3,
            left_out_within_u2: field.share_within(2.0),
            raised: field.raised,
            outliers: outliers.collect(),
        }
    }
}

impl WallEntry {
    fn of(report: &AdaptReport<'_>) -> Self {
        let wall = &report.study.wall;
        let off = Spread::of(report.adaptation.map.iter().map(|c| report.off_mm(c)));
        let spread = |after: bool| {
            let s = report.walls(after);
            WallSpread {
                min_mm: s.min,
                mean_mm: s.mean,
                max_mm: s.max,
                cut_through: report.through(after),
                places: report.adaptation.map.len(),
            }
        };
        Self {
            thickness_mm: wall.thickness_mm,
            layer_mm: wall.layer_mm,
            least_mm: wall.least_mm,
            source: report.map_source(),
            before: spread(false),
            after: spread(true),
            off_equal_layer_um: [off.min * 1e3, off.max * 1e3],
        }
    }
}

impl CellEntry {
    fn of(report: &AdaptReport<'_>, cell: &MapCell) -> Self {
        let (deviation_mm, u_mm) = (cell.field.deviation_mm, cell.field.u_mm);
        Self {
            at_mm: xyz(&cell.after.at_mm),
            blank_um: cell.after.blank_mm * 1e3,
            field_um: deviation_mm * 1e3,
            u_field_um: u_mm * 1e3,
            wall_before_mm: cell.before.wall_mm,
            wall_after_mm: cell.after.wall_mm,
            u_wall_mm: remaining_wall(report.study, deviation_mm, u_mm).u_mm,
        }
    }
}
