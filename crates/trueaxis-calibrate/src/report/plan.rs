//! A plan in text and on a page.

use super::identification::unobservable_section;
use super::identification_pictures::{Bar, bars};
use super::stages::planned_section;
use super::surface::issues;
use crate::plan::{Chosen, Expected, PlanReport, PlannedPath, tools};
use trueaxis_geometry::Vec3;
use trueaxis_motion::report::clock;
use trueaxis_report::{Columns, Figure, Report, Section, Table};

/// Width of a view, pixels.
const VIEW_PX: f64 = 240.0;
/// How long the tool axis is drawn, mm.
const STROKE_MM: f64 = 40.0;

/// Three digits that count.
fn figure(value: f64) -> String {
    let digits = match value.abs() {
        v if v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        v if v >= 0.9995 => 2,
        _ => 3,
    };
    format!("{value:.digits$}")
}

/// The plan in text and on a page.
pub fn plan_report<'a>(answer: &'a PlanReport) -> Report<'a> {
    let campaign = &answer.plan.campaign;
    let machine = &campaign.machine;
    let e = &answer.expectation;
    let unobservable = match e.unobservable.is_empty() {
        true => Section::new("").paragraph("All unknowns are observable."),
        false => unobservable_section("Not observable", &e.unobservable),
    };
    Report::new(&campaign.name)
        .line(format!("{}, {}", machine.name(), machine.chain_text()))
        .section(path_section(answer))
        .section(seen_section(answer))
        .sections(planned_section(&answer.design, &answer.stages))
        .section(expected_section(answer))
        .sections(answer.chosen.as_ref().map(|chosen| chosen_section(answer, chosen)))
        .section(unobservable)
        .sections(answer.paths.iter().map(|planned| {
            let tools = tools(campaign, &planned.path.stations);
            views(format!("Path {}", planned.path.name), &tools).on_page()
        }))
}

fn path_section<'a>(answer: &PlanReport) -> Section<'a> {
    let mut lines = Vec::new();
    let rows = answer.paths.iter().map(|planned| {
        let path = &planned.path;
        let how = match path.feed_mm_per_s {
            Some(feed) => format!("moving at {:.0} mm/min", feed * 60.0),
            None => format!("standing {} s at each", figure(path.dwell_s)),
        };
        let [runs, verdict] = match &planned.check {
            Err(why) => [String::new(), format!("no program: {why}")],
            Ok(check) => {
                lines.extend(issues(check).iter().map(|line| format!("{}: {line}", path.name)));
                let safe = if check.is_sound() { "nothing in the way" } else { "NOT SAFE" };
                [clock(check.duration_s), safe.to_owned()]
            }
        };
        [path.name.clone(), path.stations.len().to_string(), how, runs, verdict]
    });
    let table = Table::new(["path", "stations", "readings", "run time", "program"]).rows(rows);
    Section::new("Paths and their programs").table(table).list(lines)
}

fn seen_section<'a>(answer: &PlanReport) -> Section<'a> {
    let heads = answer.paths.iter().map(|planned| {
        let name: String = planned.path.name.chars().take(16).collect();
        format!("{name} ({})", planned.channels.join(", "))
    });
    let names = answer.paths.first().into_iter().flat_map(|p| &p.seen).map(|s| s.name.clone());
    let rows = names.enumerate().map(|(k, name)| {
        let readings = answer.paths.iter().map(|planned| readings(planned, k));
        std::iter::once(name).chain(readings).collect::<Vec<_>>()
    });
    Section::new("Largest reading, µm or µrad, for 10 µm or 10 µrad of each error").table(
        Table::new(std::iter::once("error".to_owned()).chain(heads))
            .rows(rows)
            .most_on_terminal(usize::MAX),
    )
}

/// The channels of one error on one path, µm or µrad.
fn readings(planned: &PlannedPath, k: usize) -> String {
    let one = |v: &f64| match v * 1e3 {
        v if v < 5e-4 => "–".to_owned(),
        v => figure(v),
    };
    let scale = |v: &f64| if planned.channels == ["angle"] { v * 1e3 } else { *v };
    let largest = planned.seen.get(k).map(|s| s.largest.iter().map(|v| one(&scale(v))).collect());
    largest.map_or_else(String::new, |all: Vec<String>| all.join(" "))
}

fn expected_section<'a>(answer: &'a PlanReport) -> Section<'a> {
    let e = &answer.expectation;
    let figures = ["µm", "µrad", "µm/m"].into_iter().filter_map(|unit| {
        let bar = |e: &'a Expected| {
            let (its, scale) = answer.design.shown_unit(e.unknown);
            let value = e.u.filter(|_| its == unit)? * 2.0 * scale;
            let text = format!("{} {unit}", figure(value));
            Some(Bar { name: &e.name, value, half: 0.0, text })
        };
        let all: Vec<Bar<'a>> = e.unknowns.iter().filter_map(bar).collect();
        (!all.is_empty()).then(|| Figure::new(format!("U (k = 2), {unit}"), move || Ok(bars(&all))))
    });
    let rows = e.unknowns.iter().map(|expected| {
        let (unit, scale) = answer.design.shown_unit(expected.unknown);
        let [u, expanded, unit] = match expected.u {
            Some(u) => [figure(u * scale), figure(2.0 * u * scale), unit.to_owned()],
            None => ["–", "not observable", ""].map(str::to_owned),
        };
        [expected.name.clone(), u, expanded, unit]
    });
    Section::new("Uncertainty to expect")
        .paragraph(format!(
            "{} of {} combinations are observable, condition {}",
            e.rank,
            e.unknowns.len(),
            figure(e.condition)
        ))
        .grid(Columns::AsFit, figures)
        .table(Table::new(["", "u", "U (k = 2)", ""]).rows(rows).most_on_terminal(usize::MAX))
}

fn chosen_section<'a>(answer: &PlanReport, chosen: &Chosen) -> Section<'a> {
    let mut section = Section::new("Chosen poses").paragraph(format!(
        "{} of {} poses, {} readings, {} (by per_hit and per_pose), {} exchanges",
        chosen.poses,
        chosen.candidates,
        chosen.stations.len(),
        clock(chosen.time_s),
        chosen.history.len().saturating_sub(1)
    ));
    if chosen.blocked > 0 {
        let blocked = chosen.blocked;
        section = section.paragraph(format!(
            "{blocked} poses were left out: the tool would run into something or leave the travel"
        ));
    }
    let Some((count, grid)) = &chosen.grid else { return section };
    let rows = chosen.expectation.unknowns.iter().zip(&grid.unknowns).map(|(a, b)| {
        let (unit, scale) = answer.design.shown_unit(a.unknown);
        let one =
            |u: Option<f64>| u.map_or("not observable".to_owned(), |u| figure(2.0 * u * scale));
        [a.name.clone(), one(a.u), one(b.u), unit.to_owned()]
    });
    let headings =
        ["U (k = 2)".to_owned(), "chosen".to_owned(), format!("grid of {count}"), String::new()];
    section.table(Table::new(headings).rows(rows).most_on_terminal(usize::MAX))
}

/// The stations from above, from the front and from the right: the tool point, and the tool axis as
/// a stroke.
fn views<'a>(title: String, tools: &[(Vec3, Vec3)]) -> Section<'a> {
    let points = || tools.iter().flat_map(|(p, u)| [*p, p + u * STROKE_MM]);
    let low = points().fold(Vec3::repeat(f64::INFINITY), |a, b| a.inf(&b));
    let high = points().fold(Vec3::repeat(f64::NEG_INFINITY), |a, b| a.sup(&b));
    let middle = (low + high) * 0.5;
    let scale = 0.9 * VIEW_PX / (high - low).max().max(1.0);
    let place = |p: &Vec3, right: usize, up: usize| {
        let of = |i: usize, sign: f64| 0.5 * VIEW_PX + sign * (p[i] - middle[i]) * scale;
        [of(right, 1.0), of(up, -1.0)]
    };
    let view = |(title, right, up): (&str, usize, usize)| {
        let mut svg = format!(
            "<svg viewBox=\"0 0 {VIEW_PX} {VIEW_PX}\" role=\"img\"><rect width=\"{VIEW_PX}\" \
             height=\"{VIEW_PX}\" fill=\"none\" stroke=\"#bbb\"/>"
        );
        for (p, u) in tools {
            let ([x1, y1], [x2, y2]) =
                (place(p, right, up), place(&(p + u * STROKE_MM), right, up));
            svg += &format!(
                "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#0072b2\" \
                 stroke-width=\"0.8\"/><circle cx=\"{x1:.1}\" cy=\"{y1:.1}\" r=\"1.8\" fill=\"#d55e00\"/>"
            );
        }
        Figure::new(title, move || Ok(format!("{svg}</svg>")))
    };
    let panels = [
        ("from above: X, Y", 0, 1),
        ("from the front: X, Z", 0, 2),
        ("from the right: Y, Z", 1, 2),
    ];
    Section::new(title)
        .note(format!(
            "Tool point and tool axis on the workpiece; the frame is {} mm wide.",
            figure(VIEW_PX / scale)
        ))
        .grid(Columns::Three, panels.map(view))
}
