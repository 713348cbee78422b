//! The calibration of a probe as text, JSON and tables.

use crate::identify::probe::datums::{eccentricity, xy_datum, z_datum};
use crate::identify::probe::{
    Calibration, FormError, GaugeKind, Hit, LobingModel, Score, Spread, Study,
};
use std::fmt::Write;
use trueaxis_geometry::Vec3;

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
pub(super) fn verdict(found: &Calibration) -> String {
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
pub(super) fn gauge_words(found: &Calibration) -> String {
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

/// The study with the calibration of each stylus, for people.
pub fn probe_text(study: &Study, all: &[Calibration]) -> String {
    let mut text = format!("{}\n", study.name);
    datums_text(&mut text, study);
    for found in all {
        stylus_text(&mut text, found);
    }
    text
}

fn datums_text(text: &mut String, study: &Study) {
    // Writing to a String cannot fail.
    if let Some(dial) = study.eccentricity.as_ref().and_then(eccentricity) {
        let [x, y] = dial.offset_mm.map(um);
        let [ux, uy] = dial.u_mm.map(um);
        let _ = writeln!(
            text,
            "\n  dial on the ball   offset {x:.2} ± {ux:.2}, {y:.2} ± {uy:.2} µm; run-out {:.2} µm",
            um(dial.runout_mm)
        );
    }
    if let Some(z) = study.z_datum.as_ref().map(z_datum) {
        let _ = writeln!(
            text,
            "\n  Z datum            length of the probe {:.4} ± {:.4} mm; ring at Z {:.4} mm; range of the \
             triggers {:.2} µm",
            z.length_mm,
            z.u_length_mm,
            z.top_mm,
            um(z.range_mm)
        );
    }
    if let Some(xy) = study.xy_datum.as_ref().map(xy_datum) {
        let [x, y] = xy.offset_mm.map(um);
        let [dx, dy] = xy.ball_diameter_mm;
        let _ = writeln!(
            text,
            "\n  four hits          offset {x:.2}, {y:.2} µm; the ball acts like {dx:.4} mm in X, {dy:.4} mm \
             in Y"
        );
    }
}

fn stylus_text(text: &mut String, found: &Calibration) {
    let _ = writeln!(text, "\nstylus `{}`: {}\n", found.stylus, gauge_words(found));
    let _ = writeln!(text, "  deviations of the radius, µm             range      rms");
    let mut line = |name: &str, spread: &Spread| {
        let (range, rms) = (um(spread.range_mm), um(spread.rms_mm));
        let _ = writeln!(text, "  {name:<38} {range:>7.2}  {rms:>7.2}");
    };
    line("as measured", &found.before);
    line("offset alone taken off", &found.offset_only);
    line("corrected, hits of the calibration", &found.after);
    line("corrected, directions held out", &found.held_out);
    if let Some(check) = &found.check {
        line("fresh hits, as measured", &check.before);
        line("fresh hits, corrected", &check.after);
    }
    let _ = writeln!(text, "\n  {}", scatter_words(found));
    if let Some(check) = &found.check {
        let share = 100.0 * check.covered;
        let _ = writeln!(text, "  {share:.0} % of the fresh hits lie within U (95 %)");
    }
    let _ = writeln!(text, "  {}", offset_words(found));
    if let Some(form) = &found.form {
        let _ = writeln!(text, "  {}", form_words(found, form));
    }
    if let Some(repeats) = &found.repeats {
        let _ = writeln!(
            text,
            "  repeated hits in {} directions: s {:.2} µm, largest range {:.2} µm",
            repeats.directions,
            um(repeats.s_mm),
            um(repeats.range_mm)
        );
    }
    let _ = writeln!(text, "\n  pre-travel, µm     order    amplitude        u   first lobe, deg");
    for h in harmonics(found) {
        let order = match h.axial {
            0 => h.order.to_string(),
            p => format!("{} (sin λ)^{p}", h.order),
        };
        let _ = write!(text, "  {order:>22} {:>12.3} {:>8.3}", um(h.amplitude_mm()), um(h.u_mm));
        let phase = format!("{:>12.2}", h.phase_rad().to_degrees());
        let _ = writeln!(text, "{}", if h.order == 0 { "" } else { &phase });
    }
    let _ = writeln!(text, "\n  rms, µm                        parameters  in sample   held out");
    for score in &found.scores {
        let mark = if is_chosen(found, score) { "->" } else { "  " };
        let _ = writeln!(
            text,
            "  {mark} {:<27} {:>9} {:>10.3} {:>10.3}",
            size_words(score),
            score.parameters,
            um(score.in_sample_mm),
            um(score.held_out_mm)
        );
    }
}

pub(super) fn scatter_words(found: &Calibration) -> String {
    format!(
        "one hit scatters by s = {:.3} µm ({} degrees of freedom); U = {:.2} u covers 95 %",
        um(found.fit.s_mm()),
        found.fit.freedom(),
        found.coverage_factor
    )
}

pub(super) fn offset_words(found: &Calibration) -> String {
    let Some(offset) = &found.offset else {
        return "offset: not told by these hits (centre unknown, one orientation)".to_owned();
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

pub(super) fn form_words(found: &Calibration, form: &FormError) -> String {
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
