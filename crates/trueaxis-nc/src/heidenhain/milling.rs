//! Milling cycles where the tool stands: 208 bore milling, 251 rectangular and 252 circular pocket, 253 slot, 262
//! thread.

use std::collections::BTreeMap;

use super::Run;
use crate::execution::milling::Mill;
use crate::execution::mistakes;
use crate::moves::{Feed, FeedMode, MoveKind};
use crate::text::program::Fault;
use trueaxis_cycles::Point;
use trueaxis_cycles::mill::{Heights, Stroke, bore};
use trueaxis_cycles::outline::Outline;
use trueaxis_cycles::pocket::{Insert, Pocket};

/// The cycles of this file.
pub(super) const MILLING: [u32; 7] = [204, 208, 251, 252, 253, 254, 262];

/// A milling cycle with its parameters and what they come to; lengths in mm.
pub(super) struct Milled<'a> {
    pub number: u32,
    values: &'a BTreeMap<u32, f64>,
    mm: f64,
    feed_unit: f64,
    pub tool_mm: f64,
    pub at: usize,
}

impl Milled<'_> {
    pub fn value(&self, q: u32) -> f64 {
        self.values.get(&q).copied().unwrap_or(0.0)
    }

    pub fn length(&self, q: u32) -> f64 {
        self.value(q) * self.mm
    }

    /// A feed, or another one where it is not stated.
    pub fn feed(&self, q: u32, other: u32) -> Feed {
        let value = if self.value(q) > 0.0 { self.value(q) } else { self.value(other) };
        Feed { mode: FeedMode::PerMinute, value: value * self.feed_unit }
    }

    /// The set-up clearance, the surface, the depth, and the deepest layer.
    pub fn heights(&self, layer: u32) -> Heights {
        let surface = self.length(203);
        Heights {
            safe_mm: surface + self.length(200).abs(),
            top_mm: surface,
            bottom_mm: surface + self.length(201),
            layer_mm: self.length(layer).abs(),
        }
    }

    /// The height where the tool is left.
    pub fn clear(&self) -> f64 {
        self.length(203) + self.length(200).abs().max(self.length(204))
    }
}

/// Strokes with their feeds in the plane and in depth.
pub(super) type Passes = Vec<(Vec<Stroke>, [Feed; 2])>;

impl Run<'_> {
    /// A drilling or milling cycle where the tool stands.
    pub(super) fn machine_hole(
        &mut self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<(), Fault> {
        if number == 204 {
            return self.bore_back(values, at);
        }
        if self.has_depth_zero(number, values, at) {
            return Ok(());
        }
        if MILLING.contains(&number) {
            return self.mill_hole(number, values, at);
        }
        self.drill_hole(number, values, at)
    }

    /// The path of the centre of the cutter: pockets from the inside out in layers of at most Q202, bores by a
    /// helix with at most Q334 for each turn, then what Q215 says is finished. The tool plunges straight; what
    /// Q366 chooses instead is reported.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`. The step from ring to ring is Q370 times the radius of the
    /// tool, made even; the way from ring to ring is not described by the manuals.
    fn mill_hole(
        &mut self,
        number: u32,
        values: &BTreeMap<u32, f64>,
        at: usize,
    ) -> Result<(), Fault> {
        if self.core.has_radius() {
            return Err(mistakes::cycle_on_contour(&format!("cycle {number}"), at));
        }
        let Some(tool_mm) = self.modes.tool_radius_mm.filter(|r| *r > 0.0) else {
            let subject = format!("cycle {number} without the radius of the tool");
            self.core.not_applied(&subject, at, "state the radius: TOOL DEF 1 L+80 R+5");
            return Ok(());
        };
        let (mm, feed_unit) = (self.core.modes.unit_mm(), self.core.modes.unit_of_klartext_feed());
        let cycle = Milled { number, values, mm, feed_unit, tool_mm, at };
        let heights = cycle.heights(if number == 208 { 334 } else { 202 });
        if heights.bottom_mm >= heights.top_mm {
            return Err(mistakes::missing_depth(at));
        }
        let feeds = match number {
            208 => [206, 206],
            262 => [207, 207],
            _ => [206, 207],
        };
        for q in feeds {
            crate::execution::check_feed(&cycle.feed(q, 0), at)?;
        }
        if cycle.value(366) != 0.0 {
            let what = format!("Q366 of cycle {number}: the helix or ramp into the material");
            self.core.left_out(&what, at);
        }
        let passes = match number {
            208 => self.bored(&cycle),
            254 if cycle.value(367) != 0.0 => {
                let subject = "cycle 254 with Q367 other than 0";
                let hint = "state the centre of the arc: Q216, Q217 and Q367=0";
                self.core.not_applied(subject, at, hint);
                return Ok(());
            }
            254 => self.arc_slots(&cycle),
            262 => self.threaded(&cycle),
            _ => self.cleared(&cycle),
        };
        let Some(passes) = passes else {
            let subject =
                format!("cycle {number} that is smaller than the tool or has endless steps");
            self.core.not_applied(&subject, at, "check the size, the tool and the infeeds");
            return Ok(());
        };
        self.carry_out(&cycle, heights.safe_mm, &passes)
    }

    /// The control passes a cycle with DEPTH = 0 over: no move of it is executed, not even one to its start.
    ///
    /// # Source
    /// HEIDENHAIN, user's manuals "Machining Cycles" of TNC 640 and before: "If you program DEPTH = 0, the cycle
    /// will not be executed".
    fn has_depth_zero(&mut self, number: u32, values: &BTreeMap<u32, f64>, at: usize) -> bool {
        let depth = values.get(if number < 100 { &2 } else { &201 });
        // Cycle 240 may take its depth from a diameter, which is left out with a warning.
        let other = number == 240 && values.get(&343).is_some_and(|v| *v != 0.0);
        if other {
            self.core.left_out("Q343 of cycle 240: the depth by diameter", at);
        } else if depth == Some(&0.0) {
            let message = format!("cycle {number} has the depth 0: it is not executed");
            self.core.warn("cycle-depth-zero", number, at, message, "state a depth below 0");
        }
        depth == Some(&0.0)
    }

    /// To a height where the tool stands, then the passes, and up to where the tool is left.
    pub(super) fn carry_out(
        &mut self,
        cycle: &Milled<'_>,
        safe: f64,
        passes: &Passes,
    ) -> Result<(), Fault> {
        self.rise_to(safe, cycle.at)?;
        for (strokes, feeds) in passes {
            self.mill(strokes, *feeds, cycle.at)?;
        }
        self.rise_to(cycle.clear(), cycle.at)?;
        self.tangent = None;
        Ok(())
    }

    fn rise_to(&mut self, height: f64, at: usize) -> Result<(), Fault> {
        let mut place = self.frames.position;
        place[self.along()] = height;
        if place == self.frames.position {
            return Ok(());
        }
        self.step(MoveKind::Rapid, place, at)
    }

    /// Where the tool stands in the plane.
    pub(super) fn here(&self) -> Point {
        let [first, second, _] = self.core.modes.plane.axes();
        [self.frames.position[first], self.frames.position[second]]
    }

    fn bored(&self, cycle: &Milled<'_>) -> Option<Passes> {
        let radius = cycle.length(335).abs() / 2.0 - cycle.tool_mm;
        let ccw = cycle.value(351) >= 0.0;
        let deep = cycle.feed(206, 0);
        let heights = cycle.heights(334);
        let strokes = (radius > 0.0).then(|| bore(self.here(), radius, &heights, ccw))??;
        Some(vec![(strokes, [deep, deep])])
    }

    /// Pockets and slots. Q215: 0 everything, 1 roughing, 2 finishing, 3 of the floor, 4 of the wall; there is
    /// something to finish where an allowance (Q368, Q369) is stated.
    fn cleared(&self, cycle: &Milled<'_>) -> Option<Passes> {
        let (wall, offset) = wall(cycle);
        let here = self.here();
        let center = [here[0] + offset[0], here[1] + offset[1]];
        let (tool, side, floor) = (cycle.tool_mm, cycle.length(368), cycle.length(369));
        let overlap = if cycle.value(370) > 0.0 { cycle.value(370) } else { 1.0 };
        // Climb milling with M3 goes counter-clockwise within a pocket.
        let (ccw, step_mm) = (cycle.value(351) >= 0.0, tool * overlap);
        let pocket = |by: f64| {
            let outline = wall.inside(by)?;
            let insert = Insert::Straight;
            Some(Pocket { center, outline, cutter_mm: tool, step_mm, insert, ccw })
        };
        let (heights, deep) = (cycle.heights(202), cycle.feed(206, 0));
        let finish = [cycle.feed(385, 207), deep];
        let kind = cycle.value(215);
        let mut passes = Vec::new();
        if kind <= 1.0 {
            let bottom_mm = (heights.bottom_mm + floor).min(heights.top_mm);
            let rough = Heights { bottom_mm, ..heights };
            passes.push((pocket(tool + side)?.strokes(&rough)?, [cycle.feed(207, 0), deep]));
        }
        if [0.0, 2.0, 4.0].contains(&kind) && side > 0.0 {
            let steps = Heights { layer_mm: cycle.length(338).abs(), ..heights };
            passes.push((pocket(tool)?.wall(&steps)?, finish));
        }
        if [0.0, 2.0, 3.0].contains(&kind) && floor > 0.0 {
            let top_mm = heights.bottom_mm + floor + cycle.length(200).abs();
            passes.push((pocket(tool)?.floor(&Heights { top_mm, ..heights })?, finish));
        }
        Some(passes)
    }
}

/// The wall of a pocket or slot, and where its centre is from the tool: by Q367 in the middle, or with the tool
/// at a corner of a rectangle, or at an end of a slot or the centre of the circle there.
fn wall(cycle: &Milled<'_>) -> (Outline, Point) {
    let half = [218, 219].map(|q| cycle.length(q).abs() / 2.0);
    let place = cycle.value(367);
    let (outline, offset) = match cycle.number {
        252 => {
            return (Outline::Circle { radius_mm: cycle.length(223).abs() / 2.0 }, [0.0; 2]);
        }
        253 => {
            let corner_mm = half[0].min(half[1]);
            let inner = half[0] - half[1];
            let x = match place {
                1.0 => half[0],
                2.0 => inner,
                3.0 => -inner,
                4.0 => -half[0],
                _ => 0.0,
            };
            (Outline::Rectangle { half_mm: half, corner_mm, angle_deg: cycle.value(374) }, [x, 0.0])
        }
        _ => {
            let [a, b] = half;
            let offset = match place {
                1.0 => [a, b],
                2.0 => [-a, b],
                3.0 => [-a, -b],
                4.0 => [a, -b],
                _ => [0.0; 2],
            };
            let corner_mm = cycle.length(220).abs();
            (Outline::Rectangle { half_mm: half, corner_mm, angle_deg: cycle.value(224) }, offset)
        }
    };
    let Outline::Rectangle { angle_deg, .. } = outline else { return (outline, offset) };
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    (outline, [offset[0] * cos - offset[1] * sin, offset[0] * sin + offset[1] * cos])
}
