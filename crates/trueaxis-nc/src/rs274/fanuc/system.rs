//! The system variables of FANUC.

use crate::execution::mistakes;
use crate::moves::{Axis, CompensationSide, Event, FeedMode, PathControl, Plane, Position};
use crate::rs274::Run;
use crate::rs274::code::{Cycle, Motion};
use crate::rs274::radius::RADIUS_WEAR;
use crate::text::program::{Fault, Item, Program};

/// A table of positions that FANUC variables stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Table {
    External,
    /// By its index in the list of offsets.
    Offset(usize),
    Length(u32),
    Wear(u32),
    /// Radius or its wear: kept as an ordinary variable.
    Radius,
}

/// What a variable stands for: a table and its axis.
///
/// # Source
/// Haas Automation, "Mill Operator's Manual", "Macro Variables Table": #2001 length, #2201 its wear; #10001 and above are
/// general-purpose variables and signals.
fn table(number: u32, haas: bool) -> Option<(Table, usize)> {
    let of = |first: u32, index: u32| {
        let (entry, axis) = ((number - first) / 20, (number - first) % 20);
        (axis < 9).then_some((Table::Offset((index + entry) as usize), axis as usize))
    };
    match number {
        5201..=5209 => Some((Table::External, (number - 5201) as usize)),
        5221..=5329 => of(5221, 0),
        7001..=7949 => of(7001, 9),
        14_001..=19_989 => of(14_001, 9),
        10_001..=13_999 if haas => None,
        2001..=2200 if haas => Some((Table::Length(number - 2000), 2)),
        2201..=2400 if haas => Some((Table::Wear(number - 2200), 2)),
        2001..=2200 => Some((Table::Wear(number - 2000), 2)),
        10_001..=10_999 => Some((Table::Wear(number - 10_000), 2)),
        2201..=2400 => Some((Table::Length(number - 2200), 2)),
        11_001..=11_999 => Some((Table::Length(number - 11_000), 2)),
        2401..=2800 | 12_001..=12_999 | 13_001..=13_999 => Some((Table::Radius, 0)),
        _ => None,
    }
}

impl Run<'_> {
    /// System variables of FANUC; axes are numbered X Y Z A B C U V W.
    ///
    /// # Source
    /// FANUC Series 30i operator's manual, "Custom macro", system variables; tool offsets as in
    /// memory C.
    pub(in crate::rs274) fn fanuc_variable(&self, number: u32) -> Option<f64> {
        let frames = &self.frames;
        let of = |position: &Position, first: u32| self.shown(position, (number - first) as usize);
        if let Some((table, axis)) = table(number, self.is_haas()) {
            let length = |entry: u32| frames.tools.get(&entry).copied().unwrap_or_default();
            let wear = |entry: u32| frames.wear.get(&entry).copied().unwrap_or_default();
            return match table {
                Table::External => self.shown(&self.external(), axis),
                Table::Offset(index) => {
                    let work = frames.offsets.get(index).copied().unwrap_or_default();
                    self.shown(&work.offset, axis)
                }
                Table::Length(entry) => self.shown(&length(entry), axis),
                Table::Wear(entry) => Some(wear(entry) / self.core.modes.unit_mm()),
                Table::Radius => {
                    let radius = self.core.radii.get(&number.saturating_sub(13_000)).copied();
                    let known = radius.filter(|_| number > 13_000);
                    let own = self.globals.get(&number).copied();
                    known.map(|r| r / self.core.modes.unit_mm()).or(own).or(Some(0.0))
                }
            };
        }
        match number {
            5001..=5009 => of(&frames.position, 5001),
            5021..=5029 => of(&self.axis_positions(), 5021),
            5041..=5049 => of(&frames.position, 5041),
            5061..=5069 => of(&self.modes.skip, 5061),
            5081..=5089 => of(&frames.tool, 5081),
            5101..=5109 => Some(0.0),
            4001..=4030 => self.modal_code(number - 4000),
            4101..=4130 => self.modal_word(number - 4100),
            4201..=4230 => self.modal_code(number - 4200),
            4301..=4330 => self.modal_word(number - 4300),
            1000..=1035 | 3001 | 3002 | 3011 | 3012 => {
                self.guessed.set(Some(number));
                Some(0.0)
            }
            _ => None,
        }
    }

    /// The code of a modal group.
    fn modal_code(&self, group: u32) -> Option<f64> {
        let (modes, common) = (&self.modes, &self.core.modes);
        let [scale, rotation, polar, mirror] = modes.transforms.codes();
        let cycle = match modes.motion {
            Some(Motion::Cycle(cycle)) => cycle_code(cycle),
            _ => 80.0,
        };
        let either = |condition: bool, yes: f64, no: f64| if condition { yes } else { no };
        Some(match group {
            1 => match modes.base {
                Motion::Rapid => 0.0,
                Motion::ArcClockwise => 2.0,
                Motion::ArcCounterClockwise => 3.0,
                Motion::Thread => 33.0,
                _ => 1.0,
            },
            2 => match common.plane {
                Plane::Xy => 17.0,
                Plane::Zx => 18.0,
                Plane::Yz => 19.0,
            },
            3 => either(common.incremental, 91.0, 90.0),
            5 => match common.feed.mode {
                FeedMode::InverseTime => 93.0,
                FeedMode::PerMinute => 94.0,
                FeedMode::PerRevolution => 95.0,
            },
            6 => either(common.inches, 20.0, 21.0),
            7 => match modes.compensation {
                CompensationSide::Off => 40.0,
                CompensationSide::Left => 41.0,
                CompensationSide::Right => 42.0,
            },
            8 => modes.length_code,
            9 => cycle,
            10 => either(modes.retract_to_r, 99.0, 98.0),
            11 => scale,
            12 => either(modes.macros.is_empty(), 67.0, 66.0),
            14 => match self.frames.active {
                index if index < 6 => 54.0 + index as f64,
                _ => 54.1,
            },
            15 => either(modes.path == PathControl::ExactStop, 61.0, 64.0),
            16 => rotation,
            17 => polar,
            22 => mirror,
            _ => return None,
        })
    }

    /// The last value of a modal word.
    fn modal_word(&self, which: u32) -> Option<f64> {
        let (modes, common) = (&self.modes, &self.core.modes);
        let [m, n, d, o] = modes.last;
        Some(match which {
            7 => d,
            9 => common.feed.value / common.unit_mm(),
            11 => f64::from(modes.length_number.unwrap_or(0)),
            13 => m,
            14 => n,
            15 => o,
            19 => common.speed,
            20 => f64::from(common.selected),
            30 => self.frames.active.saturating_sub(8) as f64,
            _ => return None,
        })
    }

    /// Sets a system variable; `false` if the number is an ordinary variable.
    pub(in crate::rs274) fn write_system(
        &mut self,
        number: u32,
        value: f64,
        offset: usize,
    ) -> Result<bool, Fault> {
        let value = if value.is_nan() { 0.0 } else { value };
        if let Some((table, axis)) = table(number, self.is_haas()) {
            let rotary = Axis::ALL[axis].is_rotary();
            let value = if rotary { value } else { value * self.core.modes.unit_mm() };
            match table {
                Table::External => {
                    let mut external = self.external();
                    external.0[axis] = value;
                    self.change_external(external);
                }
                Table::Offset(index) => {
                    let work = self.frames.offsets.get(index).copied().unwrap_or_default();
                    let mut place = work.offset;
                    place.0[axis] = value;
                    self.change_offset(index, place);
                }
                Table::Length(entry) => {
                    let mut length = self.frames.tools.get(&entry).copied().unwrap_or_default();
                    length.0[axis] = value;
                    self.frames.tools.insert(entry, length);
                }
                Table::Wear(entry) => {
                    self.frames.wear.insert(entry, value);
                }
                Table::Radius => {
                    if number > 13_000 {
                        let radius_mm = value * self.core.modes.unit_mm();
                        self.core.radii.insert(number - 13_000, radius_mm);
                    } else if number > RADIUS_WEAR {
                        self.globals.insert(number, value);
                    } else {
                        return Ok(false);
                    }
                }
            }
            return Ok(true);
        }
        match number {
            3000 => {
                let text = format!("{value} {}", self.remark);
                Err(self.core.for_good(mistakes::alarm(&text, offset)))
            }
            3006 => {
                let text = self.remark.clone();
                self.core.emit(Event::Message(text));
                self.core.emit(Event::Stop { optional: false });
                Ok(true)
            }
            3001..=3005 | 3007..=3008 | 1100..=1135 => {
                self.core.emit(Event::Note("a system variable without effect on the path"));
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    /// Says that a variable was read whose value only the running control has.
    pub(in crate::rs274) fn system_reads(&mut self, at: usize) {
        if let Some(number) = self.guessed.take() {
            let message =
                format!("the value of #{number} exists only while the control runs: 0 is assumed");
            let hint = "times and signals are not simulated";
            self.core.warn("unknown-at-runtime", number, at, message, hint);
        }
    }

    /// Keeps the comment of a block that sets #3000 or #3006.
    pub(in crate::rs274) fn keep_remark(&mut self, program: &Program, items: &[Item]) {
        const LONGEST: usize = 80;
        self.remark.clear();
        let comment =
            items.iter().find_map(|i| if let Item::Comment(s) = i { Some(s) } else { None });
        if let Some(span) = comment {
            let text = &program.source()[span.clone()];
            let text = String::from_utf8_lossy(&text[..text.len().min(LONGEST)]).into_owned();
            self.remark = text.trim_matches(['(', ')']).to_owned();
        }
    }
}

fn cycle_code(cycle: Cycle) -> f64 {
    match cycle {
        Cycle::ChipBreaking => 73.0,
        Cycle::TapLeft => 74.0,
        Cycle::FineBore => 76.0,
        Cycle::Drill => 81.0,
        Cycle::DrillDwell => 82.0,
        Cycle::Peck => 83.0,
        Cycle::TapRight => 84.0,
        Cycle::Bore => 85.0,
        Cycle::BoreStop => 86.0,
        Cycle::BackBore => 87.0,
        Cycle::BoreManual => 88.0,
        Cycle::BoreDwell => 89.0,
    }
}
