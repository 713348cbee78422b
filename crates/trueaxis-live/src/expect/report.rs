//! A forecast for readers.

use super::{ExpectedAxis, ExpectedPoses, LiveExpectAnswer};
use serde_json::Value;
use trueaxis::input::Diagnostics;
use trueaxis::questions::{Answer, complete};
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table, document};

impl Answer for LiveExpectAnswer {
    fn document(&self, problems: &Diagnostics) -> Value {
        complete(document(&self.0), problems)
    }

    fn report(&self) -> Report<'_> {
        let shown = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |v| fixed(v, 1));
        let in_unit = |axis: &ExpectedAxis| {
            format!("{}, {}", axis.axis, if axis.unit == "um" { "µm" } else { "µrad" })
        };
        let axes = self.0.axes.iter().map(|axis| {
            [
                in_unit(axis),
                fixed(axis.before, 1),
                fixed(axis.after, 1),
                fixed(axis.by_age, 1),
                fixed(axis.by_increment, 1),
                shown(axis.moving),
                shown(axis.expanded_uncertainty),
            ]
        });
        let on_line = self.0.axes.iter().any(|axis| axis.on_line);
        let headings = [
            "axis",
            "before",
            "after",
            "of it: age of the sample",
            if on_line { "of it: increment, line" } else { "of it: increment" },
            "more while it moves",
            "U (k = 2)",
        ];
        let limits = self.0.axes.iter().map(|axis| {
            let fits = axis.needed <= axis.limit
                && axis.needed_per_s.is_none_or(|needed| needed <= axis.slew_per_s);
            [
                in_unit(axis),
                fixed(axis.needed, 1),
                fixed(axis.limit, 1),
                shown(axis.needed_per_s),
                fixed(axis.slew_per_s, 1),
                if fits { "" } else { "too small" }.to_owned(),
            ]
        });
        let needs = [
            "axis",
            "offset needed",
            "limit",
            "needed per second, at full speed",
            "slew per second",
            "",
        ];
        let turned = self
            .0
            .tool_axis_urad
            .map(|urad| format!("nor: {} µrad of the tool axis", fixed(urad, 1)));
        let report = Report::new(&self.0.name).line(format!("on the day of {}", self.0.log));
        if let Some(poses) = &self.0.poses {
            return self.of_poses(report, poses);
        }
        let others = self.0.other_tip_um.map(|um| {
            let um = fixed(um, 1);
            format!("not corrected by offsets of the axes: {um} µm of the tip (squareness, straightness, angles)")
        });
        let report = others.into_iter().fold(report, Report::line);
        let report = turned.into_iter().fold(report, |report, line| report.line(line));
        report
            .section(
                Section::new("Largest errors over the day").table(Table::new(headings).rows(axes)),
            )
            .section(Section::new("What the plan must allow").table(Table::new(needs).rows(limits)))
            .section(self.losses())
    }
}

impl LiveExpectAnswer {
    fn of_poses<'a>(&'a self, report: Report<'a>, poses: &'a ExpectedPoses) -> Report<'a> {
        let ExpectedPoses { tip_um, tip_by_age_um, tip_expanded_uncertainty_um: u, .. } = poses;
        let u = u.map_or_else(|| "–".to_owned(), |u| fixed(u, 1));
        let (none, row) = ("–".to_owned(), |of: &[f64; 2]| of.map(|v| fixed(v, 2)));
        let [before, after] = row(tip_um);
        let tip = ["tip, µm".to_owned(), before, after, fixed(*tip_by_age_um, 2), u];
        let axis = poses.tool_axis_urad.as_ref().map(|urad| {
            let [before, after] = row(urad);
            ["tool axis, µrad".to_owned(), before, after, none.clone(), none.clone()]
        });
        let headings = ["", "before", "after", "of it: age of the sample", "U (k = 2) before"];
        let note = format!(
            "The largest over {} rows of the log and {} poses of the whole travel, standing still.",
            poses.rows, poses.poses
        );
        let limits = poses.axes.iter().map(|axis| {
            let unit = if axis.unit == "um" { "µm" } else { "µrad" };
            let fits = if axis.needed <= axis.limit { "" } else { "too small" };
            let name = format!("{}, {unit}", axis.axis);
            [name, fixed(axis.needed, 1), fixed(axis.limit, 1), fits.to_owned()]
        });
        let table = Table::new(headings).rows([tip].into_iter().chain(axis)).note(note);
        report
            .section(Section::new("Tip and tool axis over the day").table(table))
            .section(
                Section::new("What the plan must allow")
                    .table(Table::new(["axis", "offset needed", "limit", ""]).rows(limits)),
            )
            .section(self.losses())
    }

    /// Largest errors of all axes, wherever on the day a sensor is lost.
    fn losses(&self) -> Section<'_> {
        let names: Vec<&str> = match &self.0.poses {
            Some(_) => vec!["tip", "tool axis"],
            None => self.0.axes.iter().map(|axis| axis.axis.as_str()).collect(),
        };
        let numbers = |values: &[f64]| {
            let pairs = names.iter().zip(values);
            let each = pairs.map(|(name, v)| format!("{name} {}", fixed(*v, 1)));
            each.collect::<Vec<_>>().join(", ")
        };
        let rows = self.0.losses.iter().map(|loss| {
            let then = loss
                .instead
                .as_ref()
                .map_or_else(|| "hold".to_owned(), |name| format!("{name} stands in"));
            let [ten, hour, rest] = [&loss.after_10_min, &loss.after_1_h, &loss.rest_of_day];
            [loss.sensor.clone(), then, numbers(ten), numbers(hour), numbers(rest)]
        });
        let headings = ["sensor", "then", "after 10 min", "after 1 h", "rest of the day"];
        let note = match &self.0.poses {
            Some(_) => "µm and µrad; the largest of all poses.",
            None => "µm and µrad; the largest errors of each axis.",
        };
        let table = Table::new(headings).rows(rows).note(note);
        Section::new("What the loss of a sensor costs").table(table)
    }
}
