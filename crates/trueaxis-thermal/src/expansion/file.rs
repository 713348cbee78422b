//! The file of laser runs, and the table that it names.

use super::{LaserKeys, Run, Runs, ScaleKeys};
use std::path::Path;
use trueaxis_input::plausible::{Quantity, Standing};
use trueaxis_input::{CsvTable, Diagnostics, Dimension, Files, Section, SourceText, Unit};
use trueaxis_machine::heat::REFERENCE_CELSIUS;

/// Temperatures nearer than this say little about an expansion, K.
const LITTLE_K: f64 = 1.0;

/// Reads the file of an identification, and the table that it names.
pub fn read_runs(files: &Files, path: &Path) -> (Option<Runs>, Diagnostics) {
    let mut problems = Diagnostics::new();
    let Some(text) = files.text(path, "a file of laser runs (TOML)", &mut problems) else {
        return (None, problems);
    };
    parse_runs(files, path, &text)
}

/// The same of a text; its table is looked for beside `path`.
pub fn parse_runs(files: &Files, path: &Path, text: &str) -> (Option<Runs>, Diagnostics) {
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, text);
    let runs = source.read(|root| read(root, path));
    let problems = source.finish();
    (runs.filter(|_| !problems.has_errors()), problems)
}

fn read(root: &Section<'_>, path: &Path) -> Option<Runs> {
    let name = root.require("name", "say which scale this is").and_then(|i| i.text());
    let hint = "a CSV table with position_mm and one column per run, such as cold_um";
    let table_path = root.require("table", hint).and_then(|i| i.text());
    let table = table_path.and_then(|p| {
        let path = path.parent().unwrap_or(Path::new("")).join(p);
        let mut problems = Diagnostics::new();
        let text = root.files().text(&path, "a CSV table of laser runs", &mut problems);
        let shown = path.display().to_string();
        let table = text.map(|text| CsvTable::parse(&shown, &text, &mut problems));
        let sound = !problems.has_errors();
        root.take_over(problems);
        table.filter(|_| sound)
    });
    root.text("source");
    let scale = read_scale(root, path);
    let laser = read_laser(root);
    root.require("run", "[run.cold] temperature = \"29.3 degC\"");
    let mut temperatures = Vec::new();
    let mut stated = 0;
    root.section("run", |section| {
        for (key, _, item) in section.entries() {
            stated += 1;
            let read = |s: &Section<'_>| {
                let hint = "of the scale during the run, such as \"29.3 ± 0.1 degC\"";
                s.require("temperature", hint)?.measured_unjudged(Dimension::Temperature)
            };
            let celsius = item.section(&section.path(key), read).flatten();
            temperatures.extend(celsius.map(|t| (key.to_owned(), t)));
        }
    });
    let (name, table) = (name?.to_owned(), table?);
    let mut problems = Diagnostics::new();
    let positions_mm = column(&table, "position", &mut problems);
    let positions = positions_mm.clone().unwrap_or_default();
    let mut runs = Vec::new();
    for (name, celsius) in temperatures {
        let errors_mm = column(&table, &name, &mut problems);
        if let Some(errors_mm) = &errors_mm {
            let place = |row| table.row_place(row);
            let errors = (name.as_str(), errors_mm.as_slice());
            root.limits().judge_error_column(extent(&positions), errors, place, &mut problems);
        }
        runs.extend(errors_mm.map(|errors_mm| Run { name, celsius, errors_mm }));
    }
    let positions_mm = positions_mm.unwrap_or_default();
    for column in &table.columns {
        let name = column.name.rsplit_once('_').map_or(&*column.name, |(name, _)| name);
        if name != "position" && !runs.iter().any(|r| r.name == name) && !problems.has_errors() {
            let message = format!("column `{}` is not used", column.name);
            let hint = format!("[run.{name}] temperature = \"25 ± 0.1 degC\" would make it a run");
            problems.warn("unused-column", column.place.clone(), message, &hint);
        }
    }
    // Where some could not be read, that was reported; they are not too few besides.
    if runs.len() == stated {
        check(root, &positions_mm, &runs);
    }
    root.take_over(problems);
    let mut runs = Runs { name, positions_mm, runs, scale, laser };
    undo_compensation(&mut runs);
    Some(runs)
}

fn read_scale(root: &Section<'_>, path: &Path) -> ScaleKeys {
    let folder = path.parent().unwrap_or(Path::new(""));
    let keys = ScaleKeys {
        axis: root.text("axis").map(str::to_owned),
        machine: root.text("machine").map(|name| folder.join(name)),
        fixed_mm: root.quantity("fixed_point", Dimension::Length),
        sensor: root.text("sensor").map(str::to_owned),
        reference_celsius: root
            .get("reference_temperature")
            .and_then(|i| i.unjudged(Dimension::Temperature)),
        date: root.get("date").and_then(|d| d.date_or_text()),
    };
    if keys.reference_celsius.is_some_and(|c| is_temperature(root, c, Standing::Impossible)) {
        let message = "no machine has this reference_temperature".to_owned();
        root.error("impossible-temperature", message, "°C = (°F − 32)/1.8");
    }
    if keys.machine.is_some() && keys.axis.is_none() {
        let message = "which axis of the machine this scale belongs to is not stated".to_owned();
        root.error("missing-key", message, "write axis = \"Y\"");
    }
    keys
}

fn read_laser(root: &Section<'_>) -> LaserKeys {
    let read = root.section("laser", |laser| {
        let u = laser.get("u").and_then(|item| {
            let u = item.quantity(Dimension::Length)?;
            if u < 0.0 {
                let hint = "a standard uncertainty is zero or positive";
                item.error("negative-uncertainty", "the uncertainty is negative".into(), hint);
            }
            (u >= 0.0).then_some(u)
        });
        LaserKeys {
            instrument: laser.text("instrument").map(str::to_owned),
            u_mm: u,
            material_per_k: laser.quantity_of("material_expansion", Quantity::Expansion),
        }
    });
    read.unwrap_or_default()
}

/// What a laser with material compensation has subtracted is added again: it shows lengths as they would
/// be at 20 °C if they belonged to a body of that material, as warm as the scale.
///
/// ```text
///     e = reading + α_m (p − p_0)(T − 20 °C)                                docs/model.md eq. 180
/// ```
fn undo_compensation(data: &mut Runs) {
    let Some(per_k) = data.laser.material_per_k else { return };
    let zero_mm = data.zero_mm();
    for run in &mut data.runs {
        let warm = run.celsius.value - REFERENCE_CELSIUS;
        for (e, p) in run.errors_mm.iter_mut().zip(&data.positions_mm) {
            *e += per_k * (p - zero_mm) * warm;
        }
    }
}

/// The column `NAME_unit`, in mm.
fn column(table: &CsvTable, name: &str, problems: &mut Diagnostics) -> Option<Vec<f64>> {
    for column in &table.columns {
        let Some((_, unit)) = column.name.rsplit_once('_').filter(|(n, _)| *n == name) else {
            continue;
        };
        return match Unit::find(unit, Dimension::Length) {
            Ok(unit) => Some(column.values.iter().map(|v| unit.to_inner(*v)).collect()),
            Err(error) => {
                let place = column.place.clone();
                problems.error(error.code(), place, error.to_string(), &error.hint());
                None
            }
        };
    }
    let place = trueaxis_input::Place::whole(&table.file);
    let message = format!("the table has no column for `{name}`");
    problems.error("missing-column", place, message, &format!("its heading is `{name}_um`"));
    None
}

/// From the lowest to the highest position.
fn extent(positions_mm: &[f64]) -> f64 {
    let ends = positions_mm
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    (ends.1 - ends.0).max(0.0)
}

/// Whether a temperature stands there, by the ranges of the file.
fn is_temperature(root: &Section<'_>, celsius: f64, standing: Standing) -> bool {
    root.limits().standing(Quantity::Temperature, celsius) == standing
}

fn check(root: &Section<'_>, positions_mm: &[f64], runs: &[Run]) {
    let spread = |values: &[f64]| {
        let (low, high) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        high - low
    };
    if positions_mm.len() < 3 || spread(positions_mm) <= 0.0 {
        let message =
            format!("{} positions cannot separate a slope from noise", positions_mm.len());
        root.error("too-few-positions", message, "measure at three positions or more");
    }
    if runs.len() < 2 {
        let message = "expansion cannot be determined at one temperature".to_owned();
        root.error("too-few-runs", message, "measure at two temperatures or more");
        return;
    }
    check_repeats(root, positions_mm, runs);
    let celsius: Vec<f64> = runs.iter().map(|r| r.celsius.value).collect();
    match spread(&celsius) {
        d if d <= 0.0 => {
            let message = "all runs have the same temperature".to_owned();
            root.error("same-temperature", message, "measure at two temperatures or more");
        }
        d if d < LITTLE_K => {
            let message = format!("the temperatures differ by {d:.2} K only");
            root.warn("little-difference", message, "some K apart the coefficient is far surer");
        }
        _ => {}
    }
    for run in runs.iter().filter(|r| is_temperature(root, r.celsius.value, Standing::Odd)) {
        let celsius = run.celsius.value;
        let message = format!("`{}`: {celsius} °C is warm for a scale", run.name);
        let hint = format!("is it Fahrenheit? that would be {:.1} °C", (celsius - 32.0) / 1.8);
        root.warn("warm-scale", message, &hint);
    }
    for run in runs.iter().filter(|r| is_temperature(root, r.celsius.value, Standing::Impossible)) {
        let message = format!("`{}`: {} °C has no machine", run.name, run.celsius.value);
        root.error("impossible-temperature", message, "°C = (°F − 32)/1.8");
    }
}

/// The same row twice is a copy, not a second reading: it would make the coefficient look more certain.
fn check_repeats(root: &Section<'_>, positions_mm: &[f64], runs: &[Run]) {
    let row = |i: usize| {
        let numbers = runs.iter().filter_map(move |r| r.errors_mm.get(i).copied());
        std::iter::once(positions_mm[i]).chain(numbers).map(f64::to_bits).collect::<Vec<u64>>()
    };
    let mut seen = std::collections::HashSet::new();
    if let Some(i) = (0..positions_mm.len()).find(|i| !seen.insert(row(*i))) {
        let message =
            format!("the row of {} mm stands there twice with the same readings", positions_mm[i]);
        root.error(
            "reading-twice",
            message,
            "remove the copy; readings that were taken again differ",
        );
    }
}
