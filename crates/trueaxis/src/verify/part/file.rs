//! The file of measured parts.

use super::points::Reading;
use super::{
    CmmPoints, Measurements, PartRule, PartStudy, PredictedValue, PredictionSource, TypedRow,
};
use std::path::Path;
use trueaxis_input::{Diagnostics, Dimension, Files, Item, Section, SourceText};
use trueaxis_machine::chain::Link;
use trueaxis_machine::file::read_pose;
use trueaxis_part::{Shape, TestPieceFile};
use trueaxis_predict::predict::{DatumAxis, Study, read_study};

/// Reads a file of measured parts with all that it names.
pub fn read_part(files: &Files, path: &Path) -> (Option<PartStudy>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a file of measured parts (TOML)", &mut problems) else {
        return (None, problems);
    };
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let read = source.read(|root| read(root, path));
    problems.append(source.finish());
    (read.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<PartStudy> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = root.require("name", "say what was measured").and_then(|i| i.text());
    let rule = root.section("decision", read_rule).unwrap_or(Some(PartRule::DEFAULT));
    let Some((piece, mut prediction)) = read_prediction(root, folder) else {
        // The rest needs the test piece; do not call it unknown.
        root.entries();
        return None;
    };
    let cmm = root.section("cmm", |s| read_points(s, folder, &piece));
    let typed = root.section("measured", |s| read_typed(s, &piece));
    let measured = match (cmm, typed) {
        (Some(points), None) => Measurements::Points(Box::new(points?)),
        (None, Some((source, rows))) => Measurements::Typed { source, rows },
        (Some(_), Some(_)) => {
            let message = "either points or typed indices".to_owned();
            root.error("contradiction", message, "leave [cmm] or [measured] out");
            return None;
        }
        (None, None) => {
            let hint =
                "[cmm] points = \"points.csv\", or [measured] roundness_mzc_mm = [\"0.0380 mm\"]";
            root.error("missing-key", "what was measured?".to_owned(), hint);
            return None;
        }
    };
    let tolerances = match &mut prediction {
        PredictionSource::Study(study) => {
            match &measured {
                Measurements::Points(points) if points.best_fit => {
                    study.reference.datum = DatumAxis::BestFit;
                }
                _ => {}
            }
            study.tolerances.clone()
        }
        PredictionSource::Typed { .. } => piece.tolerances.clone(),
    };
    let (name, path) = (name?.to_owned(), path.to_owned());
    let rule = rule?;
    check_u(root, &measured, rule, &piece);
    Some(PartStudy { name, path, piece, tolerances, prediction, measured, rule })
}

impl PartRule {
    /// ISO 14253-1 with U = 2 u.
    pub const DEFAULT: Self = Self { guarded: true, coverage_factor: 2.0 };
}

/// A guard band of nothing would pass what is not known.
fn check_u(root: &Section<'_>, measured: &Measurements, rule: PartRule, piece: &TestPieceFile) {
    let Measurements::Typed { rows, .. } = measured else { return };
    let names = piece.piece().index_names();
    let without = rows.iter().filter(|r| r.u_mm.is_none() && names[r.index].decisive);
    let names: Vec<_> = without.map(|r| names[r.index].key).collect();
    if rule.guarded && !names.is_empty() {
        let message =
            format!("ISO 14253-1 needs u of every measured index; none for {}", names.join(" "));
        let hint = "[measured] u = \"1 um\" (that of the measuring machine), or [decision] rule = \"simple\"";
        root.error("no-uncertainty", message, hint);
    }
}

/// `study = "…"`, or `test_piece = "…"` with or without `[predicted]`.
fn read_prediction(root: &Section<'_>, folder: &Path) -> Option<(TestPieceFile, PredictionSource)> {
    let (study, piece) = (root.get("study"), root.get("test_piece"));
    match (study, piece) {
        (Some(study), None) => {
            if let Some(item) = root.get("predicted") {
                let message = "the study predicts; [predicted] is for typed values".to_owned();
                item.error("contradiction", message, "leave it or `study` out");
            }
            let path = folder.join(study.text()?);
            let (read, problems) = read_study(root.files(), &path);
            root.take_over(problems);
            let study: Study = read?;
            Some((study.test_piece.clone(), PredictionSource::Study(Box::new(study))))
        }
        (None, Some(item)) => {
            let piece = TestPieceFile::named_in(root, &folder.join(item.text()?))?;
            let typed = root.section("predicted", |s| read_predicted(s, &piece));
            let none = || (String::new(), vec![None; piece.piece().index_names().len()]);
            let (source, values_mm) = typed.unwrap_or_else(none);
            Some((piece, PredictionSource::Typed { source, values_mm }))
        }
        (Some(_), Some(item)) => {
            let message = "the study names the test piece already".to_owned();
            item.error("contradiction", message, "leave `test_piece` or `study` out");
            None
        }
        (None, None) => {
            let hint = "study = \"study.toml\" (it is predicted), or test_piece = \"piece.toml\" with \
                        [predicted]";
            root.error("missing-key", "what was the part to be?".to_owned(), hint);
            None
        }
    }
}

/// The position of an index among those of the test piece.
fn index_of(
    section: &Section<'_>,
    piece: &TestPieceFile,
    key: &str,
    item: &Item<'_>,
) -> Option<usize> {
    let names = piece.piece().index_names();
    let found = names.iter().position(|n| n.key == key);
    if found.is_none() {
        let known: Vec<_> = names.iter().map(|n| n.key).collect();
        let message = format!("the test piece has no index `{key}`");
        let hint = format!("its indices: {}", known.join(", "));
        section.error_at(item.place(), "unknown-index", message, &hint);
    }
    found
}

/// `source = "…"`, `roundness_mzc_mm = "0.029 mm"` or `"0.029 ± 0.001 mm"`.
fn read_predicted(
    section: &Section<'_>,
    piece: &TestPieceFile,
) -> (String, Vec<Option<PredictedValue>>) {
    let source = section.text("source").unwrap_or_default().to_owned();
    let mut values = vec![None; piece.piece().index_names().len()];
    for (key, _, item) in section.entries() {
        if key == "source" {
            continue;
        }
        let (index, value) =
            (index_of(section, piece, key, &item), item.measured(Dimension::Length));
        if let (Some(index), Some(value)) = (index, value) {
            values[index] = Some((value.value, value.u));
        }
    }
    (source, values)
}

/// `source`, `u = "1 um"` of all, and per index a list, or `{ values, mean, u, angles, over, note }`.
fn read_typed(section: &Section<'_>, piece: &TestPieceFile) -> (String, Vec<TypedRow>) {
    let source = section.text("source").unwrap_or_default().to_owned();
    let u_mm = section.get("u").and_then(|i| positive(&i, Dimension::Length));
    let mut rows: Vec<TypedRow> = Vec::new();
    for (key, _, item) in section.entries() {
        if ["source", "u"].contains(&key) {
            continue;
        }
        let index = index_of(section, piece, key, &item);
        let row = match item.is_table() {
            true => item.section(&section.path(key), |s| read_row(s, piece)).flatten(),
            false => lengths(&item).map(TypedRow::of),
        };
        if let (Some(index), Some(row)) = (index, row) {
            rows.push(TypedRow { index, u_mm: row.u_mm.or(u_mm), ..row });
        }
    }
    let counts: Vec<usize> = rows.iter().map(|r| r.values_mm.len()).collect();
    if counts.iter().any(|n| Some(n) != counts.first()) {
        let message = format!("the indices have {counts:?} values: one for each part is expected");
        section.error("ragged-row", message, "give every index as many values as there are parts");
    }
    (source, rows)
}

impl TypedRow {
    fn of(values_mm: Vec<f64>) -> Self {
        Self { index: 0, values_mm, printed_mean_mm: None, u_mm: None, note: String::new() }
    }
}

fn read_row(section: &Section<'_>, piece: &TestPieceFile) -> Option<TypedRow> {
    let over = section.get("over").map(|i| (i, positive(&i, Dimension::Length)));
    let over_mm = over.as_ref().and_then(|o| o.1);
    let (values, angles) = (section.get("values"), section.get("angles"));
    let values_mm = match (&values, &angles) {
        (Some(item), None) => lengths(item),
        (None, Some(item)) => {
            if over.is_none() {
                let message = "an angle becomes a deviation over which length?".to_owned();
                item.error("missing-key", message, "over = \"25 mm\"");
            }
            quantities(item, Dimension::Angle)
                .map(|all| all.iter().map(|a| a.tan() * over_mm.unwrap_or(0.0)).collect())
        }
        _ => {
            let message = "the values of the parts are needed, as lengths or as angles".to_owned();
            section.error(
                "missing-key",
                message,
                "values = [\"0.0380 mm\"], or angles with `over`",
            );
            None
        }
    };
    let mut note = section.text("note").unwrap_or_default().to_owned();
    let printed_mean_mm = section.get("mean").and_then(|i| {
        let mean = positive(&i, Dimension::Length)?;
        check_mean(&i, mean, values_mm.as_deref()?);
        Some(mean)
    });
    let u_mm = section.get("u").and_then(|i| positive(&i, Dimension::Length));
    if let (Some((item, _)), Some(over_mm)) = (over, over_mm) {
        let Shape::Cone(cone) = &piece.shape;
        let heights = &cone.size().angularity_heights_mm;
        let ours = heights.last().unwrap_or(&0.0) - heights.first().unwrap_or(&0.0);
        if (ours - over_mm).abs() > 1e-6 {
            let message = format!(
                "measured over {over_mm} mm, predicted over {ours} mm: not the same quantity"
            );
            let hint = "their ratio is that of the source, not a measure of the prediction";
            item.warn("other-length", message, hint);
            note = [note, format!("over {over_mm} mm, predicted over {ours} mm")].join(" ");
        }
    }
    let values_mm = values_mm?;
    Some(TypedRow { index: 0, values_mm, printed_mean_mm, u_mm, note: note.trim().to_owned() })
}

/// A printed mean may be rounded, not another one.
fn check_mean(item: &Item<'_>, mean_mm: f64, values_mm: &[f64]) {
    let ours = values_mm.iter().sum::<f64>() / values_mm.len().max(1) as f64;
    if (ours - mean_mm).abs() > 0.5e-4 + 1e-9 {
        let message = format!("the mean of the values is {ours:.6} mm, not {mean_mm} mm");
        item.error(
            "other-mean",
            message,
            "a mean may differ by its rounding to 0.1 µm only: check the values",
        );
    }
}

fn lengths(item: &Item<'_>) -> Option<Vec<f64>> {
    quantities(item, Dimension::Length)
}

fn quantities(item: &Item<'_>, dimension: Dimension) -> Option<Vec<f64>> {
    let items = if item.is_list() { item.list()? } else { vec![*item] };
    let mut found = Vec::with_capacity(items.len());
    for item in &items {
        let value = item.quantity(dimension)?;
        if value < 0.0 {
            let message = "a form or a position of a feature is not negative".to_owned();
            item.error("negative", message, "write its size");
            return None;
        }
        found.push(value);
    }
    if found.is_empty() {
        item.error("no-readings", "there is no value".to_owned(), "one value for each part");
        return None;
    }
    Some(found)
}

fn positive(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value <= 0.0 {
        item.error("not-positive", "this must be above zero".to_owned(), "check its sign");
    }
    Some(value).filter(|v| *v > 0.0)
}

fn not_negative(item: &Item<'_>, dimension: Dimension) -> Option<f64> {
    let value = item.quantity(dimension)?;
    if value < 0.0 {
        item.error("negative", "this must not be negative".to_owned(), "check its sign");
    }
    Some(value).filter(|v| *v >= 0.0)
}

/// `[cmm]`: points, probe, point_u, frame, datum_u, datum_tilt_u, condition.
fn read_points(section: &Section<'_>, folder: &Path, piece: &TestPieceFile) -> Option<CmmPoints> {
    let Shape::Cone(cone) = &piece.shape;
    let files = section.require("points", "a table with x_mm, y_mm, z_mm, or a list of them");
    let ball_radius_mm = read_probe(section);
    let hint = "the standard uncertainty of a point along the normal: point_u = \"0.7 um\"";
    let point_u = section.require("point_u", hint);
    let point_u_mm = point_u.and_then(|i| positive(&i, Dimension::Length));
    let frame = read_frame(section);
    let [datum_u_mm, datum_tilt_u_rad] =
        [("datum_u", Dimension::Length), ("datum_tilt_u", Dimension::Angle)]
            .map(|(key, of)| section.get(key).map_or(Some(0.0), |i| not_negative(&i, of)));
    let allowance_mm = read_condition(section, piece);
    let (workpiece_from_points, best_fit, frame) = frame?;
    let reading = Reading {
        cone,
        workpiece_from_points,
        ball_radius_mm: ball_radius_mm?,
        allowance_mm: allowance_mm?,
        point_u_mm: point_u_mm?,
    };
    let files = files?;
    let list = if files.is_list() { files.list()? } else { vec![files] };
    let mut parts = Vec::new();
    for item in &list {
        let mut problems = Diagnostics::new();
        let path = folder.join(item.text()?);
        parts.push(reading.read(section.files(), &path, &mut problems));
        section.take_over(problems);
    }
    if parts.is_empty() {
        files.error("no-readings", "no part was measured".to_owned(), "name a table of points");
    }
    Some(CmmPoints {
        parts: parts.into_iter().collect::<Option<_>>()?,
        point_u_mm: reading.point_u_mm,
        datum_u_mm: datum_u_mm?,
        datum_tilt_u_rad: datum_tilt_u_rad?,
        best_fit,
        frame,
    })
}

/// `probe = "corrected"`, or `"centres"` with `stylus_diameter`; the radius that is subtracted, mm.
fn read_probe(section: &Section<'_>) -> Option<f64> {
    let hint = "probe = \"corrected\" (points of the surface), or \"centres\" with stylus_diameter";
    let probe = section.require("probe", hint);
    let diameter = section.get("stylus_diameter");
    let probe = probe?;
    match (probe.text()?, diameter) {
        ("corrected", None) => Some(0.0),
        ("corrected", Some(item)) => {
            let message = "corrected points need no stylus".to_owned();
            item.error("contradiction", message, "leave it out, or probe = \"centres\"");
            None
        }
        ("centres", Some(item)) => positive(&item, Dimension::Length).map(|d| 0.5 * d),
        ("centres", None) => {
            probe.error("missing-key", "which stylus?".to_owned(), "stylus_diameter = \"3 mm\"");
            None
        }
        (other, _) => {
            probe.error("unknown-word", format!("`{other}` is no kind of points"), hint);
            None
        }
    }
}

/// `frame = "datum"` (default), `"best fit"`, or the pose of the workpiece in the frame of the points.
fn read_frame(section: &Section<'_>) -> Option<(Link, bool, String)> {
    let datum = || (Link::identity(), false, "datum".to_owned());
    let Some(item) = section.get("frame") else { return Some(datum()) };
    match item.as_text() {
        Some("datum") => Some(datum()),
        Some("best fit") => Some((Link::identity(), true, "best fit".to_owned())),
        _ => {
            let pose = read_pose(&item)?;
            Some((pose.inverse(), false, "datum, at the stated pose".to_owned()))
        }
    }
}

/// `condition = "condition 2"`: the step on which the points lie, by its allowance.
fn read_condition(section: &Section<'_>, piece: &TestPieceFile) -> Option<f64> {
    let Some(item) = section.get("condition") else { return Some(0.0) };
    let name = item.text()?;
    let found = piece.conditions.iter().find(|c| c.name == name);
    if found.is_none() {
        let known: Vec<_> = piece.conditions.iter().map(|c| c.name.as_str()).collect();
        let message = format!("the test piece has no condition `{name}`");
        item.error("unknown-word", message, &format!("its conditions: {}", known.join(", ")));
    }
    found.map(|c| c.allowance_mm)
}

/// `rule = "ISO 14253-1"` (default) or `"simple"`, `coverage_factor = 2`.
fn read_rule(section: &Section<'_>) -> Option<PartRule> {
    let coverage = section.get("coverage_factor");
    let coverage_factor = coverage.map_or(Some(2.0), |i| i.number().filter(|k| *k > 0.0));
    if let (Some(item), None) = (&coverage, coverage_factor) {
        item.error("not-positive", "the coverage factor is above zero".to_owned(), "k = 2");
    }
    let guarded = match section.get("rule") {
        None => true,
        Some(item) => match item.text()? {
            "ISO 14253-1" => true,
            "simple" => false,
            other => {
                let hint = "write simple or ISO 14253-1";
                item.error("unknown-word", format!("`{other}` is no rule of decision"), hint);
                return None;
            }
        },
    };
    Some(PartRule { guarded, coverage_factor: coverage_factor? })
}
