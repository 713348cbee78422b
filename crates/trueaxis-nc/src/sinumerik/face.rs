//! CYCLE61 and CYCLE71: faces.

use super::Run;
use super::milling::digit;
use super::swivel::Parameters;
use crate::text::program::Fault;
use trueaxis_cycles::face::Face;
use trueaxis_cycles::mill::{Heights, Stroke};

impl Run<'_> {
    /// CYCLE61(RTP, RFP, SDIS, DP, PA, PO, LENG, WID, MID, MIDA, FALD, FFP1, VARI, LIM, DMODE, AMODE).
    ///
    /// Units of VARI: 1 roughing in layers, 2 finishing at once; tens: along the first (1, 3) or second axis (2, 4),
    /// 3 and 4 there and back. LIM: an edge that is not crossed, from the units on: the first axis at its negative
    /// and positive side, then the second. AMODE: units 1 DP from RFP; tens 1 MIDA in percent of the diameter;
    /// thousands and ten thousands 1: LENG and WID are the opposite corner.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`.
    pub(super) fn face(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let at = parameters.at;
        let (kind, amounts) = (parameters.or_zero(12)?, parameters.or_zero(15)?);
        if !self.in_plane("CYCLE61", parameters.or_zero(14)?, at) {
            return Ok(());
        }
        let unit = self.core.modes.unit_mm();
        let corner = self.cycle_point(parameters, 4)?;
        let size = |i: usize, place: u32| -> Result<f64, Fault> {
            let value = parameters.or_zero(6 + i)? * unit;
            Ok(if digit(amounts, place) == 1 { value - corner[i] } else { value })
        };
        let size_mm = [size(0, 3)?, size(1, 4)?];
        let limits = parameters.or_zero(13)?;
        let wall = |place: u32| digit(limits, place) == 1;
        let face = Face {
            corner,
            size_mm,
            angle_deg: 0.0,
            cutter_mm: 0.0,
            step_mm: parameters.or_zero(9)?.abs(),
            over_mm: parameters.or_zero(2)?.abs() * unit,
            over_across_mm: 0.0,
            along_second: matches!(digit(kind, 1), 2 | 4),
            back_and_forth: digit(kind, 1) >= 3,
            walls: [[wall(0), wall(1)], [wall(2), wall(3)]],
        };
        let percent = digit(amounts, 1) == 1;
        let from_surface = digit(amounts, 0) == 1;
        self.mill_face(
            "CYCLE61",
            parameters,
            face,
            [kind, 8.0, 10.0, 11.0],
            [percent, from_surface],
        )
    }

    /// CYCLE71(RTP, RFP, SDIS, DP, PA, PO, LENG, WID, STA, MID, MIDA, FDP, FALD, FFP1, VARI, FDP1): FDP is the way off the
    /// face at the ends of a stroke, FDP1 after the last one; VARI as in CYCLE61.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`.
    pub(super) fn old_face(&mut self, parameters: &Parameters<'_>) -> Result<(), Fault> {
        let unit = self.core.modes.unit_mm();
        let own = |i: usize| parameters.or_zero(i).map(|v| v * unit);
        let kind = parameters.or_zero(14)?;
        let face = Face {
            corner: self.cycle_point(parameters, 4)?,
            size_mm: [own(6)?, own(7)?],
            angle_deg: parameters.or_zero(8)?,
            cutter_mm: 0.0,
            step_mm: parameters.or_zero(10)?.abs(),
            over_mm: own(11)?.abs(),
            over_across_mm: own(15)?.abs(),
            along_second: matches!(digit(kind, 1), 2 | 4),
            back_and_forth: digit(kind, 1) >= 3,
            walls: [[false; 2]; 2],
        };
        self.mill_face("CYCLE71", parameters, face, [kind, 9.0, 12.0, 13.0], [false; 2])
    }

    /// A face whose cutter is not known yet and whose step is as written; where MID, FALD and FFP1 stand.
    fn mill_face(
        &mut self,
        name: &'static str,
        parameters: &Parameters<'_>,
        mut face: Face,
        [kind, layer, floor, feed]: [f64; 4],
        [percent, from_surface]: [bool; 2],
    ) -> Result<(), Fault> {
        let at = parameters.at;
        if !matches!((digit(kind, 0), digit(kind, 1)), (1 | 2, 1..=4)) {
            self.missing(&format!("{name} with this VARI"), at);
            return Ok(());
        }
        let deep = parameters.number(3)?;
        let depth = if from_surface { [deep, None] } else { [None, deep] };
        let finish = digit(kind, 0) == 2;
        let layer = if finish { 0.0 } else { parameters.or_zero(layer as usize)? };
        let feed = feed as usize;
        let cut = self.cut(name, parameters, depth, layer, [Some(feed), Some(feed)])?;
        let Some(cut) = cut else { return Ok(()) };
        let unit = self.core.modes.unit_mm();
        let allowance = if finish { 0.0 } else { parameters.or_zero(floor as usize)?.abs() * unit };
        face.cutter_mm = cut.tool_mm;
        face.step_mm = match face.step_mm {
            0.0 => 1.6 * cut.tool_mm,
            step if percent => step / 50.0 * cut.tool_mm,
            step => step * unit,
        };
        let bottom_mm = (cut.heights.bottom_mm + allowance).min(cut.heights.top_mm);
        let strokes = face.strokes(&Heights { bottom_mm, ..cut.heights });
        let begin = match strokes.as_ref().and_then(|s| s.first()) {
            Some(Stroke::Rapid([x, y, _])) => [*x, *y],
            _ => face.corner,
        };
        self.carry_out(&cut, begin, strokes, at)
    }
}
