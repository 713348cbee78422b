//! A certificate as text and page, in the order of the topics of ISO/TR 16907.

use super::certificate_pictures::{after_figure, before_and_after_figure};
use crate::verify::certificate::applied::AppliedCompensation;
use crate::verify::certificate::inputs::Input;
use crate::verify::certificate::{
    Agreement, Certificate, Circumstances, PoseResult, Rule, Study, UncertaintySource,
};
use std::f64::consts::PI;
use trueaxis_correct::compensate::tables::{Compiled, shown};
use trueaxis_geometry::Vec3;
use trueaxis_machine::axis::{Axis, AxisKind, Command, Travel};
use trueaxis_machine::compensate::Scope;
use trueaxis_machine::describe::{command_words, unit};
use trueaxis_machine::errors::{Component, Curve, ErrorKind, StatedError, Uncertainty};
use trueaxis_part::tolerance::Outcome;
use trueaxis_report::numbers::{fixed, rounded};
use trueaxis_report::{Columns, Report, Section, Standing, Table};

/// A verdict in its colour.
pub(super) fn standing(outcome: Outcome) -> Standing {
    match outcome {
        Outcome::Pass => Standing::Good,
        Outcome::Fail => Standing::Bad,
        Outcome::Undecided => Standing::Open,
    }
}

/// The rule in words.
pub(super) fn rule(study: &Study) -> String {
    let (limit, k) = (study.decision.limit_mm * 1e3, study.decision.coverage_factor);
    let kept = match study.decision.rule {
        Rule::Simple => "d ≤ limit (simple acceptance)".to_owned(),
        Rule::GuardBand => format!("d + U ≤ limit, U = k·u with k = {k} (ISO 14253-1)"),
    };
    format!("at every pose {kept}; limit {limit:.1} µm, d the length of the measured tip deviation")
}

/// A certificate as text and page.
pub fn certificate_report<'a>(study: &'a Study, certificate: &'a Certificate) -> Report<'a> {
    let topics: [(&str, Topic<'a>); 7] = [
        ("Kinematic representation", |study, _, section| kinematics(study, section)),
        ("Errors", |study, _, section| errors(study, section)),
        ("Determination", |study, _, section| determination(study, section)),
        ("Compensation", |study, _, section| compensation(study, section)),
        ("Application", |study, _, section| application(study, section)),
        ("Validation", validation),
        ("Documentation", |study, _, section| documentation(study, section)),
    ];
    let sections = topics.into_iter().enumerate().map(|(i, (title, topic))| {
        topic(study, certificate, Section::new(format!("{}. {title}", i + 1)))
    });
    let word = certificate.outcome.word().to_uppercase();
    let head = study.head.as_ref().map(|head| {
        let (lines, instruments) = head.shown();
        paragraphs(Section::new("Certificate"), lines).table(instruments)
    });
    Report::new(&study.name)
        .line(
            "Certificate of a volumetric compensation, in the order of the topics of ISO/TR 16907",
        )
        .verdict(standing(certificate.outcome), word, &certificate.reason)
        .sections(head)
        .sections(sections)
}

type Topic<'a> = fn(&'a Study, &'a Certificate, Section<'a>) -> Section<'a>;

/// A section with a paragraph for each line.
fn paragraphs<'a>(section: Section<'a>, lines: Vec<String>) -> Section<'a> {
    lines.into_iter().fold(section, Section::paragraph)
}

fn kinematics<'a>(study: &Study, section: Section<'a>) -> Section<'a> {
    let machine = &study.machine;
    let mut lines = vec![
        machine.name().to_owned(),
        format!("chain from the workpiece to the tool: {}", machine.chain_text()),
    ];
    if !machine.source().is_empty() {
        lines.push(machine.source().to_owned());
    }
    let active = machine.active_compensation();
    if !active.is_empty() {
        let names: Vec<String> = active.iter().map(ToString::to_string).collect();
        lines.push(format!("compensated in the control before, and left so: {}", names.join(" ")));
    }
    lines.push(format!("zone of the certificate: {}", zone(study)));
    paragraphs(section, lines)
}

/// `X 0 … 6200 mm, …`
fn zone(study: &Study) -> String {
    let one = |axis: &Axis| match axis.travel {
        Travel::Between(from, to) => {
            let number = |q| rounded(trueaxis_machine::describe::shown(axis, q));
            format!("{} {} … {} {}", axis.name, number(from), number(to), unit(axis))
        }
        _ if axis.kind == AxisKind::Rotary => format!("{} all around", axis.name),
        _ => format!("{} without stated ends", axis.name),
    };
    study.zone.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// One row for the six errors of a body: constant or moving.
fn errors<'a>(study: &Study, section: Section<'a>) -> Section<'a> {
    let machine = &study.machine;
    let headings = ["errors of", "EX µm", "EY µm", "EZ µm", "EA µrad", "EB µrad", "EC µrad"];
    let note = "value ± standard uncertainty; of error motions the smallest and the largest over the zone, and the \
                largest uncertainty";
    let mut table = Table::new(headings).note(note);
    let (mut all, mut motions) = (0, 0);
    for (i, body) in machine.bodies().iter().enumerate() {
        for kind in [ErrorKind::Location, ErrorKind::Motion] {
            let stated = Component::ALL.map(|component| body.stated(kind, component));
            let count = stated.iter().flatten().count();
            if count == 0 {
                continue;
            }
            all += count;
            let name = match kind {
                ErrorKind::Location => format!("E·0{}", body.name),
                ErrorKind::Motion => format!("E·{}", body.name),
            };
            motions += if kind == ErrorKind::Motion { count } else { 0 };
            let cells = Component::ALL.iter().zip(stated);
            let cells = cells.map(|(component, error)| {
                let scale = if component.is_rotation() { 1e6 } else { 1e3 };
                error.map_or("–".to_owned(), |error| cell(study, i, error, scale))
            });
            table.push(std::iter::once(name).chain(cells));
        }
    }
    let line = format!("{all} errors with their uncertainties, {motions} of them error motions");
    section.paragraph(line).table(table)
}

/// `-5.9 … 22.0 ± 0.5`
fn cell(study: &Study, body: usize, error: &StatedError, scale: f64) -> String {
    let number = |v: f64| fixed(v * scale, 1);
    let value = match (&error.mean, reach(study, body, error)) {
        (Curve::Constant(value), _) => number(*value),
        (_, Some([low, high])) => format!("{} … {}", number(low), number(high)),
        _ => "–".to_owned(),
    };
    match &error.u {
        Some(u) => format!("{value} ± {}", number(largest(u))),
        None => value,
    }
}

/// The largest u of an error, mm or rad.
pub(super) fn largest(u: &Uncertainty) -> f64 {
    match u {
        Uncertainty::Constant(u) => *u,
        Uncertainty::Table(spline) => {
            let (from, to) = spline.range();
            let at = |i: u32| spline.at(from + (to - from) * f64::from(i) / 100.0);
            (0..=100).map(at).fold(0.0, f64::max)
        }
    }
}

fn reach(study: &Study, body: usize, stated: &StatedError) -> Option<[f64; 2]> {
    let axis = study.machine.bodies()[body].axis?;
    let (from, to) = match (study.zone[axis].travel, &stated.mean) {
        (Travel::Between(from, to), _) => (from, to),
        (_, Curve::Table { spline, .. }) => spline.range(),
        _ => (-PI, PI),
    };
    let at = |i: u32| stated.at(from + (to - from) * f64::from(i) / 100.0, 0.0).ok();
    let values = (0..=100).filter_map(at);
    Some(values.fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(v), high.max(v)]))
        .filter(|[low, high]| low <= high)
}

fn circumstances(c: &Circumstances) -> Vec<String> {
    let temperature = match c.temperature_c.u {
        Some(u) => format!("{} ± {u} °C (u)", c.temperature_c.value),
        None => format!("{} °C", c.temperature_c.value),
    };
    vec![
        c.method.clone(),
        format!("{}, {}, at {temperature}", c.date, c.by),
        format!("instrument: {}; calibration: {}", c.instrument, c.calibration),
    ]
}

fn determination<'a>(study: &Study, section: Section<'a>) -> Section<'a> {
    let mut lines = circumstances(&study.determination);
    lines.push(match &study.determined {
        UncertaintySource::Stated => "uncertainties as the machine file states them: errors independent of each \
                               other, each wrong by one factor along its whole curve"
            .to_owned(),
        UncertaintySource::Campaign { name, readings, terms, left_out, verdict } => format!(
            "uncertainties with all that the results have in common, from the campaign \"{name}\": {terms} \
             terms from {readings} readings, {left_out} more were not supported by them and count as nothing; \
             {verdict}"
        ),
    });
    lines.push(format!("{} poses were used", study.used.len()));
    paragraphs(section, lines)
}

/// What of the pose is compensated.
pub(super) fn scope(scope: Scope) -> &'static str {
    match scope {
        Scope::Pose => "position and orientation",
        Scope::Position => "position",
    }
}

fn compensation<'a>(study: &Study, section: Section<'a>) -> Section<'a> {
    match &study.applied {
        AppliedCompensation::Program(compensator) => {
            let what = scope(compensator.scope());
            let line = format!(
                "NC program: {what} of every pose solved with the identified errors, in all axes"
            );
            section.paragraph(line)
        }
        AppliedCompensation::Tables { compiled, control, .. } => {
            let machine = &study.machine;
            let headings = ["axis", "moves", "nodes", "largest", "lost between the nodes"];
            let mut table = Table::new(headings);
            for made in &compiled.tables {
                let [input, output] =
                    [made.table.input, made.table.output].map(|i| &machine.axes()[i]);
                table.push([
                    input.name.to_string(),
                    output.name.to_string(),
                    made.table.nodes.len().to_string(),
                    shown(output, made.largest),
                    shown(output, made.loss),
                ]);
            }
            let line = format!(
                "{} tables of {}, compiled from the identified errors and read back",
                compiled.tables.len(),
                control.key()
            );
            paragraphs(section.paragraph(line), besides_tables(compiled)).table(table)
        }
    }
}

/// What the control holds besides tables.
fn besides_tables(compiled: &Compiled) -> Vec<String> {
    let mut lines = Vec::new();
    let names: Vec<String> = compiled.known.iter().map(|k| k.known.error.to_string()).collect();
    if !names.is_empty() {
        lines.push(format!("errors that the control's own chain knows: {}", names.join(" ")));
    }
    if let Some(joints) = &compiled.joints {
        let axes: Vec<String> = joints.0.iter().map(|j| j.axis.to_string()).collect();
        lines.push(format!("kinematic parameters of {}", axes.join(" and ")));
    }
    if let Some(gridded) = &compiled.grid {
        lines.push(format!("a grid of {} points", gridded.grid.values.len()));
    }
    if !compiled.lines.is_empty() {
        lines.push(format!("{} straight lines for the temperatures", compiled.lines.len()));
    }
    lines
}

fn application<'a>(study: &Study, section: Section<'a>) -> Section<'a> {
    let a = &study.application;
    let mut lines: Vec<String> = a.method.iter().cloned().collect();
    let when: Vec<&str> = [&a.date, &a.by].into_iter().flatten().map(String::as_str).collect();
    if !when.is_empty() {
        lines.push(when.join(", "));
    }
    lines.push(match (&a.loaded, &study.applied) {
        (Some(folder), _) => {
            format!("loaded tables ({folder}): SHA-256 of every file is that of the compiled one")
        }
        (None, AppliedCompensation::Tables { .. }) => {
            "what the control has loaded was not compared".to_owned()
        }
        (None, AppliedCompensation::Program(_)) => {
            "the control runs the compensated program as it is".to_owned()
        }
    });
    paragraphs(section, lines).table(hashes(&a.files))
}

fn hashes(files: &[Input]) -> Table {
    let rows = files.iter().map(|f| [f.name.as_str(), f.role, f.sha256.as_str()]);
    Table::new(["file", "what it is", "SHA-256"]).rows(rows)
}

fn validation<'a>(
    study: &'a Study,
    certificate: &'a Certificate,
    section: Section<'a>,
) -> Section<'a> {
    let v = &study.validation;
    let axes = study.machine.axes();
    let mut lines = circumstances(&v.circumstances);
    let warmer = v.circumstances.temperature_c.value - study.determination.temperature_c.value;
    lines.push(format!("{warmer:+.1} K against the determination"));
    if let Some(zero) = &v.zero {
        lines.push(format!("instrument set to zero at {}", command_words(axes, zero)));
    }
    let um = |v: [f64; 2]| v.map(|v| format!("{:.1}", v * 1e3));
    let ([rms, rms_after], [most, most_after]) =
        (um(certificate.rms_mm), um(certificate.largest_mm));
    lines.extend([
        format!(
            "{} poses, none of them used before; a coordinate is read with U = {:.1} µm (k = {})",
            v.poses.len(),
            certificate.expanded_mm * 1e3,
            study.decision.coverage_factor
        ),
        format!("tip before: {rms} µm rms, {most} µm at most; after: {rms_after} µm rms, {most_after} µm at most"),
        format!(
            "predicted after: {:.1} µm rms, with the scatter of the readings {:.1} µm; at most {:.1} µm at all \
             poses together with 95 %",
            certificate.lengths.rms_mm * 1e3,
            (certificate.lengths.rms_mm.powi(2) + 3.0 * v.u_mm * v.u_mm).sqrt() * 1e3,
            certificate.lengths.largest_within_mm * 1e3
        ),
        agreement("before", certificate.agreement[0]),
        agreement("after", certificate.agreement[1]),
        format!(
            "over the zone ({} poses) predicted: {:.1} µm rms before, {:.1} µm after; nowhere more than {:.1} µm with \
             U, at {}",
            certificate.volume.poses,
            certificate.volume.rms_mm[0] * 1e3,
            certificate.volume.rms_mm[1] * 1e3,
            certificate.volume.largest_mm * 1e3,
            command_words(axes, &certificate.volume.at)
        ),
        format!("rule: {}", rule(study)),
    ]);
    paragraphs(section, lines)
        .grid(
            Columns::One,
            [before_and_after_figure(study, certificate), after_figure(study, certificate)],
        )
        .table(poses(study, certificate))
}

fn agreement(state: &str, found: Option<Agreement>) -> String {
    let Some(a) = found else { return format!("{state}: agreement cannot be tested") };
    let words = if a.holds() {
        "readings and prediction agree"
    } else {
        "readings and prediction DISAGREE"
    };
    format!(
        "{state}: {words}, χ² = {:.1} of {} numbers (above {:.1} by chance once in a hundred times)",
        a.chi_square, a.numbers, a.limit
    )
}

fn poses(study: &Study, certificate: &Certificate) -> Table {
    let axes = study.machine.axes();
    let rest = [
        "before",
        "after",
        "x y z",
        "predicted x y z",
        "±U",
        "95 %",
        "E_n before",
        "E_n",
        "verdict",
    ];
    let headings = axes.iter().map(|a| format!("{} {}", a.name, unit(a)));
    let headings = headings.chain(rest.map(str::to_owned));
    let rows = certificate.poses.iter().map(|p| pose_row(study, axes, p));
    Table::new(headings).rows(rows).note(
        "poses of the validation, µm; before, after: measured length of the tip deviation; x y z: measured after, \
         predicted ± U; 95 %: the predicted length is below it; E_n: |measured − predicted| over its U, the worst \
         coordinate",
    )
}

fn pose_row(study: &Study, axes: &[Axis], p: &PoseResult) -> Vec<String> {
    let three = |v: &Vec3| {
        let one = |v: &f64| fixed(v * 1e3, 1);
        v.iter().map(one).collect::<Vec<_>>().join(" ")
    };
    let [before, after] = p.lengths_mm().map(|d| format!("{:.1}", d * 1e3));
    let figures = [
        before,
        after,
        three(&p.measured.after_mm),
        three(&p.predicted.after.tip_mm),
        three(&(p.predicted.u_mm() * study.decision.coverage_factor)),
        format!("{:.1}", p.within_mm * 1e3),
        format!("{:.2}", p.e_n[0]),
        format!("{:.2}", p.e_n[1]),
        p.outcome.word().to_owned(),
    ];
    place(axes, &p.measured.command).into_iter().chain(figures).collect()
}

/// `X 3100 mm`: position and unit of an axis.
fn place(axes: &[Axis], at: &Command) -> Vec<String> {
    let one = |(axis, q): (&Axis, &f64)| {
        let digits = if unit(axis) == "mm" { 1 } else { 2 };
        fixed(trueaxis_machine::describe::shown(axis, *q), digits)
    };
    axes.iter().zip(at).map(one).collect()
}

fn documentation<'a>(study: &Study, section: Section<'a>) -> Section<'a> {
    let lines = vec![
        format!(
            "made by trueaxis {}; {} draws with seed {} (JCGM 101); the same inputs and version give the same bytes",
            trueaxis_report::VERSION, study.sampling.samples, study.sampling.seed
        ),
        "the temperatures are stated, not corrected for; the uncertainties hold at the temperature of the determination"
            .to_owned(),
    ];
    paragraphs(section, lines).table(hashes(&study.inputs))
}
