//! HOLES1, HOLES2 and CYCLE801: the cycle of MCALL at each hole of a pattern.

use super::swivel::Parameters;
use super::{Run, fault};
use crate::moves::{AxisSet, MoveKind};
use crate::text::program::Fault;
use trueaxis_cycles::Point;
use trueaxis_cycles::pattern::{Circle, Grid, MOST_HOLES, Row, from_nearer_end};

impl Run<'_> {
    /// Executes a pattern; `false` if the name is none.
    ///
    /// # Source
    /// SINUMERIK 840D sl Programming Manual "Cycles", drilling pattern cycles: HOLES1(SPCA, SPCO, STA1, FDIS,
    /// DBH, NUM) begins at the end of the row that is nearer to the tool; HOLES2(CPA, CPO, RAD, STA1, INDA,
    /// NUM), where INDA 0 divides the circle; CYCLE801(_SPCA, _SPCO, _STA, _DIS1, _DIS2, _NUM1, _NUM2) in rows
    /// along the first axis, here every second one backwards.
    pub(super) fn pattern(
        &mut self,
        name: &str,
        parameters: &Parameters<'_>,
    ) -> Result<bool, Fault> {
        let unit = self.core.modes.unit_mm();
        let mm = |i: usize| parameters.or_zero(i).map(|v| v * unit);
        let count = |i: usize| -> Result<u32, Fault> {
            let count = parameters.or_zero(i)?;
            if count < 0.0 || count > f64::from(MOST_HOLES) {
                let message = format!("expected a number of holes, found {count}");
                return Err(fault("bad-repeats", parameters.at, message, "write for example 6"));
            }
            Ok(count as u32)
        };
        let from = [mm(0)?, mm(1)?];
        let [first, second, _] = self.core.modes.plane.axes();
        let here = [self.chain.position[first], self.chain.position[second]];
        let holes = match name {
            "HOLES1" => {
                let angle_deg = parameters.or_zero(2)?;
                let (first_mm, spacing_mm) = (mm(3)?, mm(4)?);
                let row = Row { from, angle_deg, first_mm, spacing_mm, count: count(5)? };
                from_nearer_end(row.holes(), here)
            }
            "HOLES2" => {
                let (start_deg, step) = (parameters.or_zero(3)?, parameters.or_zero(4)?);
                let count = count(5)?;
                let step_deg = if step == 0.0 { 360.0 / f64::from(count.max(1)) } else { step };
                Circle { center: from, radius_mm: mm(2)?.abs(), start_deg, step_deg, count }.holes()
            }
            _ => {
                let counts = [count(5)?, count(6)?];
                let angle_deg = parameters.or_zero(2)?;
                Grid { from, angle_deg, spacing_mm: [mm(3)?, mm(4)?], counts }.holes()
            }
        };
        self.drill_pattern(&holes, parameters.at)
    }

    fn drill_pattern(&mut self, holes: &[Point], at: usize) -> Result<bool, Fault> {
        let call = self.modal_call.clone();
        let [first, second, _] = self.core.modes.plane.axes();
        for hole in holes {
            let mut over = self.chain.position;
            (over[first], over[second]) = (hole[0], hole[1]);
            let named = AxisSet::default().with(first).with(second);
            self.core.emit_move(self.core.plain_move(MoveKind::Rapid, over, named));
            self.chain.position = over;
            self.modes.tangent = None;
            let Some(call) = &call else { continue };
            let values: Vec<_> = call.arguments.iter().map(|a| a.value.clone()).collect();
            if !self.cycle(&call.name, &values, at)? {
                let hint = "write the holes one by one, or MCALL with a drilling cycle";
                let subject = format!("{} at the holes of a pattern", call.name);
                self.core.not_applied(&subject, at, hint);
                return Ok(true);
            }
        }
        Ok(true)
    }
}
