//! The calibration of a probe in text and on a page, and its tables.

use super::probe_pictures::{hits_picture, latitudes_picture, scores_picture};
use crate::identify::probe::datums::{eccentricity, xy_datum, z_datum};
use crate::identify::probe::{
    Calibration, FormError, GaugeKind, Hit, LobingModel, Score, Spread, Study, Stylus, TableRow,
};
use std::fmt::Write;
use trueaxis_geometry::Vec3;
use trueaxis_report::{Report, Section, Table};

/// Directions of the table on the page.
const SHOWN: usize = 12;

/// Directions of the harmonics of a spline.
const FINE: usize = 720;

/// One harmonic of the pre-travel.
pub(super) struct Harmonic {
    pub order: usize,
    /// Power of the sine of the latitude (spheres).
    pub axial: usize,
    pub cosine_mm: f64,
    pub sine_mm: f64,
    /// Of each of the two, mm.
    pub u_mm: f64,
}

impl Harmonic {
    pub fn amplitude_mm(&self) -> f64 {
        match self.order {
            0 => self.cosine_mm,
            _ => self.cosine_mm.hypot(self.sine_mm),
        }
    }

    /// The direction of the first lobe, rad.
    pub fn phase_rad(&self) -> f64 {
        match self.order {
            0 => 0.0,
            order => self.sine_mm.atan2(self.cosine_mm) / order as f64,
        }
    }
}

/// The harmonics of the pre-travel; the first stands in the offset.
pub(super) fn harmonics(found: &Calibration) -> Vec<Harmonic> {
    let fit = &found.fit;
    if fit.lobing.model == LobingModel::Spline {
        return harmonics_of_spline(found);
    }
    let mut all: Vec<Harmonic> = Vec::new();
    for (j, (term, value)) in fit.lobing.terms.iter().zip(&fit.coefficients_mm).enumerate() {
        if term.sine {
            if let Some(last) = all.last_mut() {
                last.sine_mm = *value;
            }
            continue;
        }
        let scatter = fit.s_mm() * fit.cofactor[(j, j)].max(0.0).sqrt();
        let first = term.order == 0 && term.axial == 0;
        all.push(Harmonic {
            order: term.order,
            axial: term.axial,
            cosine_mm: *value,
            sine_mm: 0.0,
            u_mm: if first { scatter.hypot(found.gauge.u_radius_mm) } else { scatter },
        });
    }
    all
}

fn harmonics_of_spline(found: &Calibration) -> Vec<Harmonic> {
    let steps = 0..FINE;
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / FINE as f64;
    let travel: Vec<f64> = steps
        .clone()
        .map(|i| found.fit.travel_mm(Vec3::new(angle(i).cos(), angle(i).sin(), 0.0)))
        .collect();
    let count = found.before_mm.len() as f64;
    let most = found.fit.lobing.size / 2;
    let of = |order: usize, wave: fn(f64) -> f64| {
        let sum: f64 = steps.clone().map(|i| travel[i] * wave(order as f64 * angle(i))).sum();
        sum * if order == 0 { 1.0 } else { 2.0 } / FINE as f64
    };
    let harmonic = |order: usize| Harmonic {
        order,
        axial: 0,
        cosine_mm: of(order, f64::cos),
        sine_mm: if order == 0 { 0.0 } else { of(order, f64::sin) },
        u_mm: found.fit.s_mm() * (if order == 0 { 1.0 } else { 2.0 } / count).sqrt(),
    };
    (0..=most).filter(|k| *k != 1).map(harmonic).collect()
}

pub(super) fn um(mm: f64) -> f64 {
    mm * 1e3
}

/// What the calibration is worth, in one sentence.
fn verdict(found: &Calibration) -> String {
    let share = 100.0 * (1.0 - found.held_out.rms_mm / found.before.rms_about_mean());
    format!(
        "stylus `{}`: radii range over {:.2} µm as measured, {:.2} µm in directions that the model has \
         not seen; {share:.0} % of the rms is gone",
        found.stylus,
        um(found.before.range_mm),
        um(found.held_out.range_mm),
    )
}

/// The name of one size of a model.
pub(super) fn size_words(score: &Score) -> String {
    match (score.model, score.size) {
        (LobingModel::Fourier, 0) => "mean and offset only".to_owned(),
        (LobingModel::Fourier, order) => format!("harmonics to {order}"),
        (LobingModel::Spline, knots) => format!("spline, {knots} knots"),
    }
}

pub(super) fn is_chosen(found: &Calibration, score: &Score) -> bool {
    let lobing = &found.fit.lobing;
    (score.model, score.size) == (lobing.model, lobing.size)
}

/// What was touched, in words.
fn gauge_words(found: &Calibration) -> String {
    let gauge = &found.gauge;
    let kind = match gauge.kind {
        GaugeKind::Ring => "ring",
        GaugeKind::Sphere => "sphere",
    };
    let centre = match gauge.centre_mm {
        Some(_) => format!("centre known ± {:.2} µm", um(gauge.u_centre_mm)),
        None => "centre unknown".to_owned(),
    };
    let turns: Vec<String> =
        found.orientations_rad.iter().map(|o| format!("{:.0}", o.to_degrees())).collect();
    format!(
        "{kind} of {} ± {} mm, {centre}; {} hits, spindle at {} deg",
        2.0 * gauge.radius_mm,
        2.0 * gauge.u_radius_mm,
        found.before_mm.len(),
        turns.join(", ")
    )
}

fn scatter_words(found: &Calibration) -> String {
    format!(
        "one hit scatters by s = {:.3} µm ({} degrees of freedom); U = {:.2} u covers 95 %",
        um(found.fit.s_mm()),
        found.fit.freedom(),
        found.coverage_factor
    )
}

fn offset_words(found: &Calibration) -> String {
    let Some(offset) = &found.offset else {
        return "offset: not observable with these hits (centre unknown, one orientation)"
            .to_owned();
    };
    let names = ["x", "y", "z"].into_iter().enumerate().take(offset.coordinates);
    let parts: Vec<String> = names
        .map(|(k, name)| {
            let (value, u) = (um(offset.value_mm[k]), um(offset.u_mm[k]));
            format!("{name} {value:.3} ± {u:.3} µm")
        })
        .collect();
    let [bx, by] = found.four_hit_bias_mm().map(um);
    format!(
        "offset ball − spindle (spindle at 0): {}; four hits alone would say {bx:+.2}, {by:+.2} µm more",
        parts.join(", ")
    )
}

fn form_words(found: &Calibration, form: &FormError) -> String {
    let (name, hits) = form_name(found);
    format!(
        "{name} (after ISO 230-10; {hits} hits there, {} here; not checked on the page): {:.2} µm as \
         measured, {:.2} µm corrected",
        found.before_mm.len(),
        um(form.before_mm),
        um(form.after_mm)
    )
}

pub(super) fn form_name(found: &Calibration) -> (&'static str, usize) {
    match found.gauge.kind {
        GaugeKind::Ring => ("P_FTU,2D", 36),
        GaugeKind::Sphere => ("P_FTU,3D", 25),
    }
}

/// The study with the calibration of each stylus, in text and on a page.
pub fn probe_report<'a>(study: &Study, all: &[Calibration]) -> Report<'a> {
    Report::new(&study.name)
        .section(Section::new("Datums").list(datums(study)))
        .sections(all.iter().zip(&study.styli).flat_map(|(found, stylus)| sections(found, stylus)))
}

fn datums(study: &Study) -> Vec<String> {
    let dial = study.eccentricity.as_ref().and_then(eccentricity).map(|dial| {
        let ([x, y], [ux, uy]) = (dial.offset_mm.map(um), dial.u_mm.map(um));
        format!(
            "dial on the ball: offset {x:.2} ± {ux:.2}, {y:.2} ± {uy:.2} µm; run-out {:.2} µm",
            um(dial.runout_mm)
        )
    });
    let z = study.z_datum.as_ref().map(z_datum).map(|z| {
        format!(
            "Z datum: length of the probe {:.4} ± {:.4} mm; ring at Z {:.4} mm; range of the triggers \
             {:.2} µm",
            z.length_mm,
            z.u_length_mm,
            z.top_mm,
            um(z.range_mm)
        )
    });
    let xy = study.xy_datum.as_ref().map(xy_datum).map(|xy| {
        let ([x, y], [dx, dy]) = (xy.offset_mm.map(um), xy.ball_diameter_mm);
        format!(
            "four hits: offset {x:.2}, {y:.2} µm; the ball acts like {dx:.4} mm in X, {dy:.4} mm in Y"
        )
    });
    dial.into_iter().chain(z).chain(xy).collect()
}

fn sections<'a>(found: &Calibration, stylus: &Stylus) -> [Section<'a>; 5] {
    let name = &found.stylus;
    let mut facts = vec![gauge_words(found), scatter_words(found)];
    facts.extend(found.check.as_ref().map(|check| {
        format!("{:.0} % of the fresh hits lie within U (95 %)", 100.0 * check.covered)
    }));
    facts.push(offset_words(found));
    facts.extend(found.form.as_ref().map(|form| form_words(found, form)));
    facts.extend(found.repeats.as_ref().map(|repeats| {
        format!(
            "repeated hits in {} directions: s {:.2} µm, largest range {:.2} µm",
            repeats.directions,
            um(repeats.s_mm),
            um(repeats.range_mm)
        )
    }));
    let picture = match found.gauge.kind {
        GaugeKind::Ring => hits_picture(found, stylus),
        GaugeKind::Sphere => latitudes_picture(found),
    };
    [
        Section::new(format!("Stylus `{name}`: deviations of the radius"))
            .paragraph(verdict(found))
            .table(spreads(found))
            .list(facts),
        Section::from(picture),
        Section::new(format!("Stylus `{name}`: pre-travel by direction of motion"))
            .table(harmonics_table(found)),
        scores(found),
        directions(found).on_page(),
    ]
}

fn spreads(found: &Calibration) -> Table {
    let row = |name: &str, spread: &Spread| {
        let [range, rms] = [spread.range_mm, spread.rms_mm].map(|v| format!("{:.3}", um(v)));
        [name.to_owned(), range, rms]
    };
    let table = Table::new(["µm", "range", "rms"])
        .row(row("as measured", &found.before))
        .row(row("offset alone subtracted", &found.offset_only))
        .row(row("corrected, hits of the calibration", &found.after))
        .row(row("corrected, directions held out", &found.held_out));
    table.rows(found.check.iter().flat_map(|check| {
        [row("fresh hits, as measured", &check.before), row("fresh hits, corrected", &check.after)]
    }))
}

fn harmonics_table(found: &Calibration) -> Table {
    let row = |h: Harmonic| {
        let order = match h.axial {
            0 => h.order.to_string(),
            p => format!("{} · (sin λ)^{p}", h.order),
        };
        let phase = match h.order {
            0 => "–".to_owned(),
            _ => format!("{:.2}", h.phase_rad().to_degrees()),
        };
        [order, format!("{:.3}", um(h.amplitude_mm())), format!("{:.3}", um(h.u_mm)), phase]
    };
    let headings = ["order", "amplitude, µm", "u, µm", "first lobe, deg"];
    Table::new(headings).rows(harmonics(found).into_iter().map(row)).note(
        "Directions of motion as the probe sees them. The first harmonic is the offset: no hit \
         separates the two.",
    )
}

fn scores<'a>(found: &Calibration) -> Section<'a> {
    let mut table = Table::new(["rms, µm", "parameters", "in sample", "held out", ""]);
    for score in &found.scores {
        let [in_sample, held_out] =
            [score.in_sample_mm, score.held_out_mm].map(|v| format!("{:.3}", um(v)));
        let row = [size_words(score), score.parameters.to_string(), in_sample, held_out];
        table = match is_chosen(found, score) {
            true => table.bold_row(row.into_iter().chain(["chosen".to_owned()])),
            false => table.row(row),
        };
    }
    Section::from(scores_picture(found)).table(table)
}

fn directions<'a>(found: &Calibration) -> Section<'a> {
    let orientation = found.orientations_rad.first().copied().unwrap_or(0.0);
    let row = |r: TableRow| {
        let (s, c) = r.direction_rad.sin_cos();
        let d = um(r.deviation_mm);
        let angle = format!("{:.1}", r.direction_rad.to_degrees());
        let [d, x, y, u] =
            [d, no_minus(d * c), no_minus(d * s), um(r.u_mm)].map(|v| format!("{v:.2}"));
        [angle, d, x, y, u]
    };
    let degrees = orientation.to_degrees();
    let title = format!("Stylus `{}`: direction table, spindle at {degrees:.0} deg", found.stylus);
    let headings = ["direction, deg", "dR, µm", "dX, µm", "dY, µm", "u, µm"];
    Section::new(title).table(
        Table::new(headings).rows(found.table(SHOWN, orientation).into_iter().map(row)).note(
            "Corrected point = measured point − dR along the direction of motion. All directions: --table.",
        ),
    )
}

/// No minus before what rounds to zero.
fn no_minus(um: f64) -> f64 {
    if um.abs() < 0.005 { 0.0 } else { um }
}

/// The direction table as CSV: what to subtract along the direction of motion.
pub fn probe_table_csv(found: &Calibration, steps: usize, orientation_rad: f64) -> String {
    let mut text = format!(
        "# stylus {}, spindle at {:.3} deg; corrected point = measured point - dR along the direction of \
         motion\n# the ball radius to calculate with is the stated one: {} mm\nangle_deg,dR_um,dX_um,dY_um,u_um\n",
        found.stylus,
        orientation_rad.to_degrees(),
        found.ball_radius_mm
    );
    for row in found.table(steps, orientation_rad) {
        let (s, c) = row.direction_rad.sin_cos();
        let d = um(row.deviation_mm);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{:.6},{d:.4},{:.4},{:.4},{:.4}",
            row.direction_rad.to_degrees(),
            d * c,
            d * s,
            um(row.u_mm)
        );
    }
    text
}

/// Corrected hits as CSV: the touched points, with the standard uncertainty of the correction.
pub fn corrected_csv(found: &Calibration, hits: &[Hit], points: &[Vec3]) -> String {
    let mut text = "point_x_mm,point_y_mm,point_z_mm,i,j,k,orientation_deg,u_um\n".to_owned();
    for (hit, p) in hits.iter().zip(points) {
        let (u, turn) = (hit.direction, hit.orientation_rad.to_degrees());
        let uncertainty = um(found.deviation(u, hit.orientation_rad).u_mm);
        let _ = writeln!(
            text,
            "{:.6},{:.6},{:.6},{:.9},{:.9},{:.9},{turn:.6},{uncertainty:.4}",
            p.x, p.y, p.z, u.x, u.y, u.z
        );
    }
    text
}
