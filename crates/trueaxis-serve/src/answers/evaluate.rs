//! Readings judged by the standards.

use crate::body::{Body, short};
use crate::desk::{Desk, Job, Reply};
use crate::frame::{Array, Frame};
use crate::refusal::{Refusal, diagnostics_json};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use trueaxis::files;
use trueaxis::files::disk;
use trueaxis::input::{Diagnostics, Dimension, parse_quantity};
use trueaxis::report::{Evaluation, Picture, Table, evaluation_json, evaluation_text, remarks};
use trueaxis::verify::conditions::{Conditions, read_conditions};
use trueaxis::verify::import::Import;
use trueaxis::verify::{Evaluated, Readings, Standard, evaluate_text, iso230_3};

/// The standards.
pub(super) fn standards(_: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    Body::of(body, &[])?;
    let list = Standard::ALL.iter().map(|s| json!({ "key": s.key(), "title": s.title() }));
    Ok(Reply::Json(list.collect()))
}

/// Readings with their result.
pub(super) struct Judged {
    standard: Standard,
    file: String,
    conditions: Conditions,
    conditions_file: Option<PathBuf>,
    evaluated: Evaluated,
    problems: Diagnostics,
}

impl Judged {
    pub(super) fn told<T>(&self, tell: impl FnOnce(&Evaluation<'_>) -> T) -> T {
        let remarks = remarks(&self.problems);
        tell(&Evaluation {
            standard: self.standard,
            file: &self.file,
            conditions: &self.conditions,
            evaluated: &self.evaluated,
            remarks: &remarks,
        })
    }
}

/// Evaluates what the request names.
pub(super) fn judged(desk: &Desk, body: &Body<'_>) -> Result<Judged, Refusal> {
    let standard = standard(body.text("standard")?)?;
    let mut problems = Diagnostics::new();
    let path = body.optional_text("path")?.map(|name| desk.project.path(name)).transpose()?;
    let (file, text) = match &path {
        Some(path) => {
            let text = disk().text(path, "a table of readings (CSV)", &mut problems);
            (path.display().to_string(), text)
        }
        None => (body.text("name")?.to_owned(), Some(body.text("text")?.to_owned())),
    };
    let named = body.optional_text("conditions")?.map(|n| desk.project.path(n)).transpose()?;
    let beside = path.as_deref().map(|path| path.with_extension("toml"));
    let conditions_file = named.or(beside.filter(|beside| files::is_file(beside)));
    let mut conditions = read_conditions(&disk(), conditions_file.as_deref(), &mut problems);
    if let Some(radius_mm) = quantity(body, "radius", Dimension::Length)? {
        conditions.circle.radius_mm = Some(radius_mm);
    }
    let window_s = quantity(body, "window", Dimension::Time)?.unwrap_or(iso230_3::HOUR_S);
    let import = import(body, Path::new(&file))?;
    let conditions_name = conditions_file.as_ref().map(|p| p.display().to_string());
    let result = text.map(|text| {
        let readings = Readings {
            standard,
            file: &file,
            text: &text,
            import,
            feature: body.optional_text("feature").ok().flatten(),
            conditions: &conditions,
            conditions_file: conditions_name.as_deref().unwrap_or("the conditions"),
            window_s,
        };
        evaluate_text(&readings, &mut problems)
    });
    match result.filter(|_| !problems.has_errors()) {
        Some((Some(evaluated), conditions)) => {
            Ok(Judged { standard, file, conditions, conditions_file, evaluated, problems })
        }
        _ => Err(Refusal::unusable(&problems)),
    }
}

fn standard(key: &str) -> Result<Standard, Refusal> {
    Standard::ALL.into_iter().find(|s| s.key() == key).ok_or_else(|| {
        let all = Standard::ALL.map(Standard::key).join(", ");
        Refusal::bad(format!("`{}` is no standard that is known", short(key)), &all)
    })
}

fn import(body: &Body<'_>, file: &Path) -> Result<Import, Refusal> {
    let Some(key) = body.optional_text("import")? else { return Ok(Import::of(file)) };
    Import::ALL.into_iter().find(|import| import.key() == key).ok_or_else(|| {
        let all = Import::ALL.map(Import::key).join(", ");
        Refusal::bad(format!("`{}` is no form that is known", short(key)), &all)
    })
}

fn quantity(body: &Body<'_>, key: &str, dimension: Dimension) -> Result<Option<f64>, Refusal> {
    let Some(text) = body.optional_text(key)? else { return Ok(None) };
    match parse_quantity(text, dimension) {
        Ok(value) if value > 0.0 => Ok(Some(value)),
        Ok(_) => Err(Refusal::bad(format!("`{key}` is due as a positive quantity"), "")),
        Err(e) => Err(Refusal::new(400, e.code(), format!("{key}: {e}"), &e.hint())),
    }
}

/// Tables and pictures as data.
pub(super) fn evaluate(desk: &Desk, body: &Value, _: &Job) -> Result<Reply, Refusal> {
    let known =
        ["standard", "path", "name", "text", "import", "feature", "conditions", "radius", "window"];
    let judged = judged(desk, &Body::of(body, &known)?)?;
    let mut drawn = Drawn::default();
    let (mut document, text, contents) =
        judged.told(|e| (evaluation_json(e), evaluation_text(e), e.contents()));
    document["diagnostics"] = diagnostics_json(&judged.problems).into();
    let pictures: Value = contents.pictures.iter().map(|picture| drawn.picture(picture)).collect();
    let file = judged.conditions_file.as_ref().and_then(|path| desk.project.name_of(path));
    let frame = Frame::new()
        .say("document", document)
        .say("text", json!(text))
        .say("conditions_file", json!(file))
        .say("figures", contents.results.iter().map(table_json).collect())
        .say("details", contents.details.iter().map(table_json).collect())
        .say("pictures", pictures)
        .say("remarks", remarks(&judged.problems).into())
        .say("diagnostics", diagnostics_json(&judged.problems).into())
        .with("line", Array::F64(drawn.line))
        .with("points", Array::F64(drawn.points));
    Ok(Reply::Frame(frame))
}

fn table_json((title, table): &(String, Table)) -> Value {
    let words: Vec<bool> = (0..table.headings.len()).map(|i| table.has_words(i)).collect();
    json!({
        "title": title,
        "note": table.note,
        "headings": table.headings,
        "rows": table.rows.iter().map(|row| &row.cells).collect::<Vec<_>>(),
        "words": words,
    })
}

/// The numbers of all pictures, and where each piece of them stands.
#[derive(Default)]
struct Drawn {
    /// x, y and half the width of the band.
    line: Vec<f64>,
    /// x and y.
    points: Vec<f64>,
}

impl Drawn {
    fn line(&mut self, line: &[(f64, f64, f64)]) -> Value {
        let first = self.line.len() / 3;
        self.line.extend(line.iter().flat_map(|(x, y, half)| [x, y, half]));
        json!([first, line.len()])
    }

    fn points(&mut self, points: &[(f64, f64)]) -> Value {
        let first = self.points.len() / 2;
        self.points.extend(points.iter().flat_map(|(x, y)| [x, y]));
        json!([first, points.len()])
    }

    fn picture(&mut self, picture: &Picture) -> Value {
        match picture {
            Picture::Scatter(s) => {
                let bands = s.bands.iter().map(|band| {
                    json!({
                        "label": band.label,
                        "colour": band.colour,
                        "line": self.line(&band.line),
                        "points": self.points(&band.points),
                    })
                });
                let bands: Value = bands.collect();
                json!({
                    "kind": "scatter",
                    "title": s.title,
                    "note": s.note,
                    "x": s.x,
                    "y": s.y,
                    "from_zero": s.from_zero,
                    "bands": bands,
                    "dashed": self.points(&s.dashed),
                })
            }
            Picture::Polar(p) => {
                let lines = p.lines.iter().map(|line| {
                    json!({
                        "label": line.label,
                        "colour": line.colour,
                        "points": self.points(&line.points),
                    })
                });
                let lines: Value = lines.collect();
                json!({ "kind": "polar", "title": p.title, "note": p.note, "lines": lines })
            }
        }
    }
}
