//! The RTCP screen of the i5 control with the fields that Zhang et al. 2023 show in their Fig 2.
//!
//! The paper names the fields and their units and explains the centres (2.1.2). About which direction each angle
//! turns, and the unit of the two segment lengths, it does not say.

use super::calibration::Calibration;
use super::control::Names;
use super::segments::Segments;
use super::study::RtcpStudy;

/// A field of the screen.
#[derive(Debug, Clone, PartialEq)]
pub struct ScreenField {
    /// As it stands on the screen, in English.
    pub name: &'static str,
    /// As it is printed.
    pub printed: &'static str,
    /// The unit on the screen; `--` where the screen states none.
    pub unit: &'static str,
    /// What the picture shows.
    pub shown: &'static str,
    /// What to enter, as it is entered; `None` where the paper or the readings do not determine it.
    pub enter: Option<String>,
    /// Why, or why not.
    pub words: String,
}

const NO_DIRECTION: &str = "the paper does not state about which direction it turns: enter the angle that the \
                            manual of the control names, from the table of angle errors";

/// The fields, in the order of the screen; empty for another control.
pub fn screen(study: &RtcpStudy, found: &Calibration) -> Vec<ScreenField> {
    if study.slots.as_ref().is_none_or(|s| s.names != Names::I5) {
        return Vec::new();
    }
    let angle = |name, printed| ScreenField {
        name,
        printed,
        unit: "°",
        shown: "0.0000",
        enter: None,
        words: NO_DIRECTION.to_owned(),
    };
    let mut fields = vec![
        angle("first rotary axis, angle error 1", "第一旋转轴角度误差1"),
        angle("first rotary axis, angle error 2", "第一旋转轴角度误差2"),
        angle("first rotary axis, angle error 3", "第一旋转轴角度误差3"),
        angle("second rotary axis, angle error", "第二旋转轴角度误差"),
    ];
    fields.extend(centres(study, found));
    fields.extend(segments(study.segments.as_ref()));
    fields
}

/// The six coordinates of the two centres; the steps of 2.1.2 use four of them.
fn centres(study: &RtcpStudy, found: &Calibration) -> Vec<ScreenField> {
    const FIELDS: [(&str, &str, &str); 6] = [
        ("first rotary centre, X", "第一旋转中心坐标 X轴", "RTCP_OFFSET1_X"),
        ("first rotary centre, Y", "第一旋转中心坐标 Y轴", "RTCP_OFFSET1_Y"),
        ("first rotary centre, Z", "第一旋转中心坐标 Z轴", "RTCP_OFFSET1_Z"),
        ("second rotary centre, X", "第二旋转中心坐标 X轴", "RTCP_OFFSET2_X"),
        ("second rotary centre, Y", "第二旋转中心坐标 Y轴", "RTCP_OFFSET2_Y"),
        ("second rotary centre, Z", "第二旋转中心坐标 Z轴", "RTCP_OFFSET2_Z"),
    ];
    let decimals = usize::from(study.decimals);
    let one = |(name, printed, slot): (&'static str, &'static str, &'static str)| {
        let known = found.new.iter().find(|n| n.slot.name == slot);
        let enter = known.and_then(|n| n.new_mm).map(|(mm, _)| format!("{:.decimals$}", mm + 0.0));
        let words = match (known, &enter) {
            (None, _) => "not used by the steps of 2.1.2; the picture shows 0".to_owned(),
            (Some(n), Some(_)) => format!("{slot}: {}", n.slot.words),
            (Some(n), None) => {
                format!("{slot}: {}; the readings do not determine it", n.slot.words)
            }
        };
        ScreenField { name, printed, unit: "mm", shown: "0.0000", enter, words }
    };
    FIELDS.into_iter().map(one).collect()
}

fn segments(segments: Option<&Segments>) -> Vec<ScreenField> {
    const MISSING: &str = "state [segments] chord_error and distance";
    let rate = |length: Option<f64>| match (segments, length) {
        (None, _) => MISSING.to_owned(),
        (Some(_), None) => {
            "state `turned` and `along`, or its present value, in [segments]".to_owned()
        }
        (Some(s), Some(l)) => format!(
            "keeps the chord error up to {:.3} deg of both rotary axes together for each mm of path; taken \
             as mm: the screen states no unit",
            s.largest_turn_rad_per_mm(l).to_degrees()
        ),
    };
    let mm = |v: Option<f64>| v.map(|v| format!("{v:.4}"));
    let chord = segments.map(|s| s.chord_error_mm);
    let step = segments.map_or_else(
        || MISSING.to_owned(),
        |s| {
            format!(
                "at {} mm from the rotary axis a step of it is {:.4} deg at most",
                s.distance_mm,
                s.largest_step_rad().to_degrees()
            )
        },
    );
    // The control cuts until the chord error is kept, but no shorter: so the shortest one has to be short enough.
    let needed = segments.and_then(|s| Some(s.longest_mm(s.sharpest_rad_per_mm?)));
    let down = |mm: f64| (mm * 1e4).floor() / 1e4;
    let stated = segments.and_then(|s| s.shortest_mm);
    let shortest = match (stated, needed) {
        (Some(stated), Some(needed)) => Some(stated.min(down(needed))),
        (stated, needed) => stated.or(needed.map(down)),
    };
    let first = segments.and_then(|s| s.first_mm);
    let mut of_shortest = rate(shortest);
    if let Some(needed) = needed {
        of_shortest = format!("the sharpest turn of the path needs {needed:.4} mm; {of_shortest}");
    }
    let field = |name, printed, unit, shown, enter, words| ScreenField {
        name,
        printed,
        unit,
        shown,
        enter,
        words,
    };
    vec![
        field("chord error of segments", "分瓣弦高误差", "mm", "0.0010", mm(chord), step),
        field("shortest segment", "最小分段长度", "--", "0.1000", mm(shortest), of_shortest),
        field("first segment", "初始分段长度", "--", "0.9000", mm(first), rate(first)),
        field(
            "accuracy of the chord error",
            "弦高误差计算精度",
            "--",
            "10",
            None,
            "the paper states neither its meaning nor its unit: leave it as it is".to_owned(),
        ),
    ]
}
