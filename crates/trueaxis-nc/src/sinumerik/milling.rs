//! POCKET3 and POCKET4: rectangular and circular pockets.

use super::swivel::Parameters;
use super::{Run, fault};
use crate::execution::milling::Mill;
use crate::execution::{check_feed, mistakes};
use crate::moves::{AxisSet, Feed, MoveKind, Plane, SpindleDirection};
use crate::text::program::Fault;
use trueaxis_cycles::Point;
use trueaxis_cycles::mill::{Heights, Stroke};
use trueaxis_cycles::outline::Outline;
use trueaxis_cycles::pocket::{Insert, Pocket};

/// One decimal digit of a parameter that has a meaning for each of them.
pub(super) fn digit(value: f64, place: u32) -> u64 {
    value.abs() as u64 / 10_u64.pow(place) % 10
}

/// What all milling cycles have in common.
pub(super) struct Cut {
    pub name: &'static str,
    pub tool_mm: f64,
    /// RTP.
    pub retract: f64,
    pub heights: Heights,
    /// In the plane and in depth.
    pub feeds: [Feed; 2],
}

impl Run<'_> {
    /// The radius of the cutter; `None`, with a warning, where it is not known.
    pub(super) fn cutter(&mut self, name: &str, at: usize) -> Option<f64> {
        let radius = self.core.radii.get(&self.core.modes.tool).copied().filter(|r| *r > 0.0);
        if radius.is_none() {
            let hint = "state its diameter in a set-up file: --setup";
            self.core.not_applied(&format!("{name} without the radius of the tool"), at, hint);
        }
        radius
    }

    /// A cycle, or its variant, that is known and not executed.
    pub(super) fn missing(&mut self, what: &str, at: usize) {
        let message = format!("{what} is not executed: its moves are missing from the path");
        let hint = "the other moves are those of the program";
        self.core.warn("not-executed", what, at, message, hint);
    }

    /// Whether a cycle works in the plane that is on; else it is reported as not executed.
    pub(super) fn in_plane(&mut self, name: &str, mode: f64, at: usize) -> bool {
        let plane = match digit(mode, 0) {
            1 => Plane::Xy,
            2 => Plane::Zx,
            3 => Plane::Yz,
            _ => return true,
        };
        let same = plane == self.core.modes.plane;
        if !same {
            self.missing(&format!("{name} in another plane than that of G17, G18, G19"), at);
        }
        same
    }

    /// Whether the cutter goes counter-clockwise: 0 climb and 1 conventional milling by the sense of the
    /// spindle, 2 as G2, 3 as G3.
    pub(super) fn goes_ccw(&self, direction: f64, inside: bool) -> bool {
        let reversed = self.core.modes.turning == SpindleDirection::CounterClockwise;
        match digit(direction, 0) {
            2 => false,
            3 => true,
            conventional => (conventional == 0) == (inside != reversed),
        }
    }

    /// The feeds of the plane and of the depth; one that is not written is that of the program, or the other.
    pub(super) fn cycle_feeds(
        &self,
        parameters: &Parameters<'_>,
        [flat, deep]: [Option<usize>; 2],
    ) -> Result<[Feed; 2], Fault> {
        let unit = if self.modes.feed_inches { 25.4 } else { 1.0 };
        let modal = self.core.modes.feed;
        let own = |index: Option<usize>, other: Feed| -> Result<Feed, Fault> {
            let value = index.map(|i| parameters.number(i)).transpose()?.flatten();
            let value = value.filter(|v| *v > 0.0).map_or(other.value, |v| v * unit);
            Ok(Feed { value, ..other })
        };
        let flat = own(flat, modal)?;
        let deep = own(deep, flat)?;
        for feed in [flat, deep] {
            check_feed(&feed, parameters.at)?;
        }
        Ok([flat, deep])
    }

    /// RTP, RFP and SDIS, and a depth: absolute, or counted from RFP.
    pub(super) fn cut(
        &mut self,
        name: &'static str,
        parameters: &Parameters<'_>,
        [from_surface, absolute]: [Option<f64>; 2],
        layer: f64,
        feeds: [Option<usize>; 2],
    ) -> Result<Option<Cut>, Fault> {
        let at = parameters.at;
        if self.core.has_radius() {
            return Err(mistakes::cycle_on_contour(name, at));
        }
        let unit = self.core.modes.unit_mm();
        let axis = self.core.modes.plane.axes()[2];
        let surface = parameters.or_zero(1)? * unit;
        let retract = parameters.number(0)?.map_or(self.chain.position[axis], |r| r * unit);
        let bottom = match (from_surface, absolute) {
            (Some(depth), _) => surface - depth.abs() * unit,
            (None, Some(depth)) => depth * unit,
            (None, None) => return Err(mistakes::missing_depth(at)),
        };
        let heights = Heights {
            safe_mm: surface + parameters.or_zero(2)?.abs() * unit,
            top_mm: surface,
            bottom_mm: bottom,
            layer_mm: layer.abs() * unit,
        };
        if bottom > surface || retract < surface {
            let message = "the bottom is above the surface, or the retraction plane below it";
            return Err(fault("cycle-heights", at, message, "check RTP, RFP and DP"));
        }
        let feeds = self.cycle_feeds(parameters, feeds)?;
        let Some(tool_mm) = self.cutter(name, at) else { return Ok(None) };
        Ok(Some(Cut { name, tool_mm, retract, heights, feeds }))
    }

    /// To a point at the retraction plane, then the strokes, and back to that plane.
    pub(super) fn carry_out(
        &mut self,
        cut: &Cut,
        begin: Point,
        strokes: Option<Vec<Stroke>>,
        at: usize,
    ) -> Result<(), Fault> {
        let Some(strokes) = strokes else {
            let subject =
                format!("{} that is smaller than the tool or has endless steps", cut.name);
            self.core.not_applied(&subject, at, "check the size, the tool and the infeeds");
            return Ok(());
        };
        self.go_over(cut, begin);
        self.mill(&strokes, cut.feeds, at)?;
        let [_, _, third] = self.core.modes.plane.axes();
        self.rapid_to(|to| to[third] = cut.retract);
        self.modes.tangent = None;
        Ok(())
    }

    /// To a point of the plane, at the retraction plane or above it.
    pub(super) fn go_over(&mut self, cut: &Cut, begin: Point) {
        let [first, second, third] = self.core.modes.plane.axes();
        self.rapid_to(|to| to[third] = to[third].max(cut.retract));
        self.rapid_to(|to| (to[first], to[second]) = (begin[0], begin[1]));
    }

    pub(super) fn rapid_to(&mut self, change: impl FnOnce(&mut crate::moves::Position)) {
        let (from, mut to) = (self.chain.position, self.chain.position);
        change(&mut to);
        if to != from {
            let named = crate::moves::Axis::ALL.into_iter().filter(|a| to[*a] != from[*a]);
            let named = named.fold(AxisSet::default(), AxisSet::with);
            self.core.emit_move(self.core.plain_move(MoveKind::Rapid, to, named));
            self.chain.position = to;
        }
    }

    /// A point of the plane; a coordinate that is not written is that of the tool.
    pub(super) fn cycle_point(
        &self,
        parameters: &Parameters<'_>,
        index: usize,
    ) -> Result<Point, Fault> {
        let unit = self.core.modes.unit_mm();
        let [first, second, _] = self.core.modes.plane.axes();
        let one = |i: usize, axis| -> Result<f64, Fault> {
            Ok(parameters.number(i)?.map_or(self.chain.position[axis], |v| v * unit))
        };
        Ok([one(index, first)?, one(index + 1, second)?])
    }

    /// POCKET3(RTP, RFP, SDIS, DP, LENG, WID, CRAD, PA, PO, STA, MID, FAL, FALD, FFP1, FFD, CDIR, VARI, MIDA, AP1,
    /// AP2, AD, RAD1, DP1, UMODE, FS, ZFS, GMODE, DMODE, AMODE) and POCKET4 with the size alone for LENG to CRAD,
    /// without STA and AP2.
    ///
    /// The size of POCKET4 is its radius, or its diameter where the hundreds of DMODE are 1. Units of VARI: 1
    /// roughing, 2 finishing of wall and floor, 4 of the wall; tens: into the material 0 with G0, 1 with G1, 2 on a
    /// helix (RAD1, DP1), 3 to and fro (RAD1 is the angle); thousands of POCKET4: 1 by helices. MIDA is in mm, or
    /// with 1 in the tens of AMODE in percent of the diameter of the tool; 0 is 80 %. With 1 in the units of AMODE
    /// DP counts from RFP.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`.
    pub(super) fn pocket(
        &mut self,
        name: &'static str,
        parameters: &Parameters<'_>,
    ) -> Result<(), Fault> {
        let at = parameters.at;
        let is_round = name == "POCKET4";
        // Where PA, MID (up to AP1) and AD (up to AMODE) stand.
        let (place, m, n) = if is_round { (5, 7, 16) } else { (7, 10, 20) };
        let [reference, mode, amounts] = [n + 6, n + 7, n + 8].map(|i| parameters.or_zero(i));
        let (reference, mode, amounts) = (reference?, mode?, amounts?);
        let kind = parameters.or_zero(m + 6)?;
        if !self.in_plane(name, mode, at) || self.pocket_variant(name, kind, reference, at) {
            return Ok(());
        }
        if is_round && mode != 0.0 {
            let size = if digit(mode, 2) == 1 { "diameter" } else { "radius" };
            let message =
                format!("the size of POCKET4 is read as its {size} by the hundreds of _DMODE");
            let hint = "this digit was not checked against a control: compare with the drawing";
            self.core.warn("pocket-size", 0, at, message, hint);
        }
        let deep = parameters.number(3)?;
        let depth = if digit(amounts, 0) == 1 { [deep, None] } else { [None, deep] };
        let feeds = [Some(m + 3), Some(m + 4)];
        let layer = parameters.or_zero(m)?;
        let Some(cut) = self.cut(name, parameters, depth, layer, feeds)? else { return Ok(()) };
        let center = self.cycle_point(parameters, place)?;
        let unit = self.core.modes.unit_mm();
        let own = |i: usize| parameters.or_zero(i).map(|v| v.abs() * unit);
        let (side, floor) = (own(m + 1)?, own(m + 2)?);
        let wall = match is_round {
            true => {
                let size = if digit(mode, 2) == 1 { 0.5 } else { 1.0 };
                Outline::Circle { radius_mm: own(4)? * size }
            }
            false => Outline::Rectangle {
                half_mm: [own(4)? / 2.0, own(5)? / 2.0],
                corner_mm: own(6)?,
                angle_deg: parameters.or_zero(9)?,
            },
        };
        let across = parameters.or_zero(m + 7)?.abs();
        let step_mm = match digit(amounts, 1) {
            _ if across == 0.0 => 1.6 * cut.tool_mm,
            1 => across / 50.0 * cut.tool_mm,
            _ => across * unit,
        };
        let radius = parameters.or_zero(n + 1)?.abs();
        let insert = match digit(kind, 1) {
            0 => Insert::Rapid,
            2 => Insert::Helix { radius_mm: radius * unit, pitch_mm: own(n + 2)? },
            3 => Insert::Ramp { angle_deg: radius },
            _ => Insert::Straight,
        };
        let ccw = self.goes_ccw(parameters.or_zero(m + 5)?, true);
        let strokes = |by: f64| {
            let outline = wall.inside(by)?;
            Some(Pocket { center, outline, cutter_mm: cut.tool_mm, step_mm, insert, ccw })
        };
        let path = pocket_path(kind, &cut, [side, floor], is_round, strokes);
        self.carry_out(&cut, center, path, at)
    }

    /// Reports a variant of a pocket that is not executed; whether it is one.
    fn pocket_variant(&mut self, name: &str, kind: f64, reference: f64, at: usize) -> bool {
        let what = match (digit(kind, 0), digit(reference, 3), digit(reference, 4)) {
            (1 | 2 | 4, 0 | 1, 0 | 1) => return false,
            (5, ..) => format!("the chamfer of {name} (VARI)"),
            (1 | 2 | 4, 0 | 1, _) => format!("{name} for what another tool has left (GMODE)"),
            (1 | 2 | 4, ..) => format!("{name} by one of its corners (GMODE)"),
            _ => format!("{name} with this VARI"),
        };
        self.missing(&what, at);
        true
    }
}

/// The strokes of a pocket by VARI, for outlines at a distance inside the wall.
fn pocket_path(
    kind: f64,
    cut: &Cut,
    [side, floor]: [f64; 2],
    is_round: bool,
    at_wall: impl Fn(f64) -> Option<Pocket>,
) -> Option<Vec<Stroke>> {
    let helical = is_round && digit(kind, 3) == 1;
    let tool = cut.tool_mm;
    let heights = cut.heights;
    if digit(kind, 0) == 1 {
        let rough =
            Heights { bottom_mm: (heights.bottom_mm + floor).min(heights.top_mm), ..heights };
        let pocket = at_wall(tool + side)?;
        return if helical { pocket.helices(&rough, false) } else { pocket.strokes(&rough) };
    }
    let pocket = at_wall(tool)?;
    let mut strokes =
        if helical { pocket.helices(&heights, true)? } else { pocket.wall(&heights)? };
    if digit(kind, 0) == 2 {
        let clear = heights.safe_mm - heights.top_mm;
        let above = Heights { top_mm: heights.bottom_mm + floor + clear, ..heights };
        strokes.extend(pocket.floor(&above)?);
    }
    Some(strokes)
}
