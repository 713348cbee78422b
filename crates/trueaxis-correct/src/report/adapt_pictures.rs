//! The maps of a path moved onto a probed blank.

use super::adapt::AdaptReport;
use super::adapt_maps::{Layout, Scale, heat_map};
use trueaxis_report::Figure;
use trueaxis_report::plots::round_step;

/// A number of each place of the map, by its index.
type Values<'a> = Box<dyn Fn(usize) -> f64 + 'a>;

/// The walls before and after; then the field, its uncertainty and what is off.
pub(super) fn pictures<'a>(report: AdaptReport<'a>) -> [Vec<Figure<'a>>; 2] {
    let map = &report.adaptation.map;
    let most_mm = report.walls(false).max.max(report.walls(true).max).max(1e-3);
    let wall = Scale::Wall { most_mm: round_step(most_mm) };
    let largest = |value: &dyn Fn(usize) -> f64| {
        round_step((0..map.len()).fold(0.1_f64, |m, i| m.max(value(i).abs())))
    };
    let figure = |title: &str, scale: Scale, value: Values<'a>| {
        Figure::new(title, move || heat_map(&Layout::of(map), scale, &*value))
    };
    let about = |title: &str, value: fn(&AdaptReport<'_>, usize) -> f64| {
        let value = move |i: usize| value(&report, i);
        figure(title, Scale::About { most_um: largest(&value) }, Box::new(value))
    };
    let u = |i: usize| 2e3 * map[i].field.u_mm;
    let mut others = vec![
        about("the field: how far the blank is off along the normals, µm", |r, i| {
            r.adaptation.map[i].field.deviation_mm * 1e3
        }),
        figure("its U (k = 2), µm", Scale::Up { most_um: largest(&u) }, Box::new(u)),
        about(
            "adapted: wall less the wanted wall, µm (ridges between the turns and chords included)",
            |r, i| r.off_mm(&r.adaptation.map[i]) * 1e3,
        ),
    ];
    if report.study.blank.is_some() {
        others.push(about("the field less the true blank, µm", |r, i| {
            let cell = &r.adaptation.map[i];
            (cell.field.deviation_mm - cell.after.blank_mm) * 1e3
        }));
    }
    let walls = vec![
        figure("as programmed: wall, mm", wall, Box::new(|i| map[i].before.wall_mm)),
        figure("adapted: wall, mm", wall, Box::new(|i| map[i].after.wall_mm)),
    ];
    [walls, others]
}
