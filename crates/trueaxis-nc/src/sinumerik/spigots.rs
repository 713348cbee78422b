//! CYCLE76 and CYCLE77: rectangular and circular spigots.

use super::Run;
use super::milling::digit;
use super::swivel::Parameters;
use crate::text::program::Fault;
use trueaxis_cycles::mill::Heights;
use trueaxis_cycles::outline::Outline;
use trueaxis_cycles::spigot::Spigot;

impl Run<'_> {
    /// CYCLE76(RTP, RFP, SDIS, DP, DPR, LENG, WID, CRAD, PA, PO, STA, MID, FAL, FALD, FFP1, FFD, CDIR, VARI, AP1, AP2, FS,
    /// ZFS, GMODE, DMODE, AMODE) and CYCLE77 with the diameter alone for LENG to CRAD, without STA and AP2.
    ///
    /// AP1 and AP2 are the size of the blank: the tool starts outside it on the positive first axis, and goes to the
    /// spigot and away on half circles, once around in each layer. Units of VARI: 1 roughing, 2 finishing.
    ///
    /// # Source
    /// See the table of sources in `docs/cycles.md`.
    pub(super) fn spigot(
        &mut self,
        name: &'static str,
        parameters: &Parameters<'_>,
    ) -> Result<(), Fault> {
        let at = parameters.at;
        let is_round = name == "CYCLE77";
        // Where PA, MID and AP1 stand, and GMODE.
        let (center, m) = if is_round { (6, 8) } else { (8, 11) };
        let blank = m + 7;
        let modes = blank + if is_round { 3 } else { 4 };
        let (kind, reference) = (parameters.or_zero(m + 6)?, parameters.or_zero(modes)?);
        let what = match (digit(kind, 0), digit(reference, 3)) {
            (1 | 2, 0 | 1) => None,
            (5, _) => Some(format!("the chamfer of {name} (VARI)")),
            (1 | 2, _) => Some(format!("{name} by one of its corners (GMODE)")),
            _ => Some(format!("{name} with this VARI")),
        };
        if let Some(what) = what {
            self.missing(&what, at);
            return Ok(());
        }
        if !self.in_plane(name, parameters.or_zero(modes + 1)?, at) {
            return Ok(());
        }
        let deep = parameters.number(4)?.filter(|d| *d != 0.0);
        let end = parameters.number(3)?;
        let depth = match digit(parameters.or_zero(modes + 2)?, 0) {
            _ if deep.is_some() => [deep, None],
            1 => [end, None],
            _ => [None, end],
        };
        let layer = parameters.or_zero(m)?;
        let cut = self.cut(name, parameters, depth, layer, [Some(m + 3), Some(m + 4)])?;
        let Some(cut) = cut else { return Ok(()) };
        let unit = self.core.modes.unit_mm();
        let own = |i: usize| parameters.or_zero(i).map(|v| v.abs() * unit);
        let rough = digit(kind, 0) == 1;
        let left = |v: f64| if rough { v } else { 0.0 };
        let (side, floor) = (left(own(m + 1)?), left(own(m + 2)?));
        let half = own(5)? / 2.0;
        let wall = match is_round {
            true => Outline::Circle { radius_mm: half },
            false => Outline::Rectangle {
                half_mm: [half, own(6)? / 2.0],
                corner_mm: own(7)?,
                angle_deg: parameters.or_zero(10)?,
            },
        };
        let clear = own(2)?;
        // Off the blank by SDIS, or off the spigot where no blank is stated.
        let beyond = (own(blank)? / 2.0).max(half + side) + clear - half - side;
        let start_mm = if beyond > 0.0 { beyond } else { cut.tool_mm };
        let outline = wall.inside(0.0).and_then(|w| w.inside(-(cut.tool_mm + side)));
        let center = self.cycle_point(parameters, center)?;
        let ccw = self.goes_ccw(parameters.or_zero(m + 5)?, false);
        let spigot = outline.map(|outline| Spigot { center, outline, start_mm, ccw });
        let bottom_mm = (cut.heights.bottom_mm + floor).min(cut.heights.top_mm);
        let strokes = spigot.and_then(|s| s.strokes(&Heights { bottom_mm, ..cut.heights }));
        let begin = spigot.map_or(center, |s| s.start());
        self.carry_out(&cut, begin, strokes, at)
    }
}
