//! Programs that make the hits of a study: the ring, its four hits, the plane face; as measured, or corrected by the
//! control itself.
//!
//! ```text
//!     up ─ centre of the ring ─ down ─ for every direction: stand-off, two touches, log, centre ─ up
//! ```
//!
//! The spindle is held at one orientation. Positions are those of the machine, as in the programs of a surface.

mod correction;
mod read_back;
mod settings;
mod words;

pub use correction::Correction;
pub use read_back::probe_stations;
pub use settings::{Face, ProgramSettings};
pub(super) use settings::{fits, read_program};

use super::file::{Study, Stylus};
use super::hit::{GaugeKind, Side};
use crate::plan::program::ProgramError;
use crate::plan::touch::{LogName, declare, heidenhain};
use std::f64::consts::TAU;
use trueaxis_nc::Control;
use trueaxis_nc::moves::{Axis, Feed, FeedMode};
use trueaxis_writer::{Block, Heading, Target, ToolCall, Writer, axis_coordinates};
use words::{TwoStage, Value, assign, number, trigger, two_stage};

/// A program or a file that it needs.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbeFile {
    /// Its name.
    pub name: String,
    /// What it is for, in words.
    pub purpose: String,
    /// Its content.
    pub text: Vec<u8>,
    /// Hits that it makes; none: it is no program of its own.
    pub hits: Option<usize>,
}

/// Why a program is not written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProbeProgramError {
    /// It cannot be written in the words of the control.
    #[error(transparent)]
    Words(#[from] ProgramError),
    /// The study does not say enough, or nonsense.
    #[error("{0}")]
    Study(String),
}

impl From<trueaxis_writer::WriteError> for ProbeProgramError {
    fn from(error: trueaxis_writer::WriteError) -> Self {
        Self::Words(error.into())
    }
}

/// What a set of programs is written for.
#[derive(Debug, Clone, Copy)]
pub struct ProgramOf<'a> {
    /// The study, with `[program]`.
    pub study: &'a Study,
    /// The stylus.
    pub stylus: &'a Stylus,
    /// The control.
    pub control: Control,
    /// What the control subtracts from each hit; `None`: hits as they are.
    pub correction: Option<&'a Correction>,
    /// Written to be read back where no interpreter has the words of a touch.
    pub is_stand_in: bool,
}

/// All programs of a study with the files that they need.
///
/// # Errors
/// [`ProbeProgramError`].
pub fn probe_programs(of: &ProgramOf<'_>) -> Result<Vec<ProbeFile>, ProbeProgramError> {
    let (study, settings) = (of.study, settings_of(of)?);
    let corrected = of.correction.is_some();
    let said = if corrected { ", each hit corrected by the control" } else { "" };
    let log = |raw: LogName, own: LogName| if corrected { own } else { raw };
    let mut files = Vec::new();
    let n = settings.directions;
    let angles: Vec<f64> = (0..n).map(|i| TAU * i as f64 / n as f64).collect();
    let name = log(words::RING_LOG, words::CORRECTED_LOG);
    let text = Written::new(of, settings, name)?.around(&angles, false)?;
    let purpose = format!("{n} directions in the ring{said}");
    files.push(named(of, name, purpose, text, n));
    files.extend(masks(of, name));
    let name = log(words::FOUR_LOG, words::FOUR_CORRECTED_LOG);
    let quarters: Vec<f64> = [0.0, 0.5, 0.25, 0.75].map(|part| TAU * part).to_vec();
    let text = Written::new(of, settings, name)?.around(&quarters, true)?;
    files.push(named(of, name, format!("offset of the ball by X+, X-, Y+, Y-{said}"), text, 4));
    files.extend(masks(of, name));
    if let (Some(face), Some(steps)) = (&settings.face, &study.z_datum) {
        let name = log(words::PLANE_LOG, words::PLANE_CORRECTED_LOG);
        let top_mm = super::datums::z_datum(steps).top_mm;
        let text = Written::new(of, settings, name)?.down(face, top_mm)?;
        let purpose = match of.correction.is_some_and(|c| c.length_mm.is_some()) {
            true => "height of the plane face, the length of the probe subtracted".to_owned(),
            false => "length of the probe on the plane face".to_owned(),
        };
        files.push(named(of, name, purpose, text, face.hits));
        files.extend(masks(of, name));
    }
    if let Some(correction) = of.correction {
        let made = correction.files(of.control).map_err(ProbeProgramError::Study)?;
        files.extend(made.into_iter().map(|(name, text)| ProbeFile {
            name,
            purpose: "the table of corrections and what applies it to a hit".to_owned(),
            text: text.into_bytes(),
            hits: None,
        }));
    }
    Ok(files)
}

/// `[program]`, and whether it fits the gauge.
fn settings_of<'a>(of: &ProgramOf<'a>) -> Result<&'a ProgramSettings, ProbeProgramError> {
    let study = of.study;
    let wrong = |text: &str| Err(ProbeProgramError::Study(text.to_owned()));
    let Some(settings) = &study.program else {
        return wrong("the study has no [program]: z, clear_z, tool, directions, touch_feed");
    };
    if study.gauge.kind != GaugeKind::Ring || study.gauge.side != Side::Inside {
        return wrong("programs are written for the inside of a ring");
    }
    if study.gauge.centre_mm.is_none() {
        return wrong(
            "the programs need the centre of the ring: centre = \"120 80 mm\", found with a dial",
        );
    }
    fits(settings, &study.gauge, of.stylus.ball_radius_mm).map_err(ProbeProgramError::Study)?;
    if settings.orientation_rad != 0.0 && of.control == Control::Fanuc {
        return wrong(
            "FANUC has no standard word for a spindle orientation other than that of M19 (0 deg)",
        );
    }
    Ok(settings)
}

fn named(
    of: &ProgramOf<'_>,
    log: LogName,
    purpose: String,
    text: Vec<u8>,
    hits: usize,
) -> ProbeFile {
    let name = format!("{}.{}", log.stem, crate::plan::extension(of.control));
    ProbeFile { name, purpose, text, hits: Some(hits) }
}

/// The masks of FN 16.
fn masks(of: &ProgramOf<'_>, log: LogName) -> Vec<ProbeFile> {
    if of.control != Control::Heidenhain {
        return Vec::new();
    }
    let column = |word: &str, q: u32, decimals: usize| heidenhain::Column {
        word: word.to_owned(),
        q,
        decimals,
    };
    let plane = log == words::PLANE_LOG || log == words::PLANE_CORRECTED_LOG;
    let mut columns = vec![column("H", heidenhain::KEPT[0], 0)];
    let result = heidenhain::RESULT;
    if plane {
        columns.push(column("Z", result + 2, 4));
    } else {
        columns.push(column("D", heidenhain::KEPT[1], 5));
        columns.push(column("S", heidenhain::KEPT[2], 5));
        let (x, y) = match of.correction {
            None => (result, result + 1),
            Some(_) => (q_of(Value::X), q_of(Value::Y)),
        };
        columns.extend([column("X", x, 4), column("Y", y, 4), column("Z", result + 2, 4)]);
        if of.correction.is_some() {
            columns.push(column("E", q_of(Value::Dr), 5));
        }
    }
    let mut files = heidenhain::masks(log, &columns);
    let results: &[(&str, Value)] = match (plane, log.stem.starts_with("four")) {
        (true, _) => &[("Z", Value::FirstResult), ("V", Value::SecondResult)],
        (_, true) => &[
            ("X", Value::FirstResult),
            ("Y", Value::SecondResult),
            ("U", Value::ThirdResult),
            ("V", Value::FourthResult),
        ],
        _ => &[],
    };
    let results: Vec<heidenhain::Column> =
        results.iter().map(|(word, v)| column(word, q_of(*v), 4)).collect();
    files.extend(heidenhain::result_mask(log, &results));
    let of_mask = |(name, text): (String, String)| ProbeFile {
        name,
        purpose: "a mask of FN 16".to_owned(),
        text: text.into_bytes(),
        hits: None,
    };
    files.into_iter().map(of_mask).collect()
}

fn q_of(value: Value) -> u32 {
    value.name(Control::Heidenhain)[1..].parse().unwrap_or(0)
}

/// A program in the making.
struct Written<'a> {
    of: &'a ProgramOf<'a>,
    settings: &'a ProgramSettings,
    log: LogName,
    writer: Writer,
    hits: usize,
}

impl<'a> Written<'a> {
    fn new(
        of: &'a ProgramOf<'a>,
        settings: &'a ProgramSettings,
        log: LogName,
    ) -> Result<Self, ProbeProgramError> {
        let mut writer = Writer::new(of.control);
        let about = format!("{}, stylus {}", of.study.name, of.stylus.name);
        let name = log.stem.replace('-', "_");
        let comments = [about.as_str()];
        let heading = Heading::of_measuring(&name, &comments);
        if let Some(text) = declare(of.control) {
            writer.write(&Block::Text(text))?;
        }
        writer.write(&Block::Start(&heading))?;
        let call = ToolCall { number: settings.tool, text: "touch probe", ..ToolCall::default() };
        writer.write(&Block::Tool(&call))?;
        let angle = settings.orientation_rad.to_degrees() + 0.0;
        let orient = match of.control {
            Control::Fanuc => "M19".to_owned(),
            Control::Haas => format!("M19 P{angle:.1}"),
            Control::LinuxCnc => format!("M19 R{angle:.3}"),
            Control::Sinumerik840d => format!("SPOS={angle:.3}"),
            Control::Heidenhain => {
                format!("CYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE{angle:+.3}\nM19")
            }
        };
        writer.write(&Block::Text(&orient))?;
        if of.correction.is_some() {
            let table = match of.control {
                Control::Fanuc | Control::Haas => "G65 P7061",
                Control::LinuxCnc => "o<trueaxis_table> call",
                Control::Sinumerik840d => "TRUEAXIS_TABLE",
                Control::Heidenhain => "; the table stands in TRUEAXIS_CORRECT.H",
            };
            writer.write(&Block::Text(table))?;
        }
        writer.write(&Block::Text(&log.open(of.control)))?;
        let text = "TOUCH PROBE IN THE SPINDLE, ROTARY AXES AT 0, ALL CLEAR";
        writer.write(&Block::Stop { optional: false, message: Some(text) })?;
        Ok(Self { of, settings, log, writer, hits: 0 })
    }

    /// Hits in the ring; with `sums` the offset is computed of four.
    fn around(mut self, angles_rad: &[f64], sums: bool) -> Result<Vec<u8>, ProbeProgramError> {
        let (gauge, s) = (&self.of.study.gauge, self.settings);
        let centre = gauge.centre_mm.unwrap_or_default();
        let ball = self.of.stylus.ball_radius_mm;
        let contact = gauge.contact_mm(ball);
        self.rapid(&[(Axis::Z, s.clear_z_mm)])?;
        self.rapid(&[(Axis::X, centre.x), (Axis::Y, centre.y)])?;
        self.line([centre.x, centre.y, s.z_mm])?;
        for (i, angle) in angles_rad.iter().enumerate() {
            let at = |r: f64| [centre.x + r * angle.cos(), centre.y + r * angle.sin(), s.z_mm];
            let (from_mm, to_mm) = (at(contact - s.stand_off_mm), at(contact + s.beyond_of(ball)));
            self.line(from_mm)?;
            self.touch(from_mm, to_mm)?;
            let kept = self.kept_in_ring(*angle, from_mm);
            self.writer.write(&Block::Text(&kept))?;
            if sums {
                let [x, y] = self.place_names();
                let text =
                    assign(self.of.control, Value::Kept(i as u32), if i < 2 { &x } else { &y });
                self.writer.write(&Block::Text(&text))?;
            }
            self.line([centre.x, centre.y, s.z_mm])?;
        }
        self.line([centre.x, centre.y, s.clear_z_mm])?;
        if sums {
            let text = self.offset([centre.x, centre.y], gauge.radius_mm);
            self.writer.write(&Block::Text(&text))?;
        }
        self.end()
    }

    /// Hits on a plane face from above.
    fn down(mut self, face: &Face, top_mm: f64) -> Result<Vec<u8>, ProbeProgramError> {
        let (s, control) = (self.settings, self.of.control);
        let [x, y] = face.place_mm;
        let at = |gap: f64| [x, y, top_mm + face.length_mm + gap];
        let ball = self.of.stylus.ball_radius_mm;
        let (from_mm, to_mm) = (at(s.stand_off_mm), at(-s.beyond_of(ball)));
        if s.clear_z_mm <= from_mm[2] {
            return Err(ProbeProgramError::Study(format!(
                "clear_z ({} mm) is not above the face: the spindle stands at {:.3} mm before the touch",
                s.clear_z_mm, from_mm[2]
            )));
        }
        self.rapid(&[(Axis::Z, s.clear_z_mm)])?;
        self.rapid(&[(Axis::X, x), (Axis::Y, y)])?;
        let z = trigger(control, 2);
        let sum = Value::FirstResult.name(control);
        for i in 0..face.hits {
            self.line(from_mm)?;
            self.touch(from_mm, to_mm)?;
            let text = self.kept_on_face();
            let sum = match i {
                0 => z.clone(),
                _ => format!("{sum} + {z}"),
            };
            let text = format!("{text}\n{}", assign(control, Value::FirstResult, &sum));
            self.writer.write(&Block::Text(&text))?;
            self.line(from_mm)?;
        }
        self.line([x, y, s.clear_z_mm])?;
        // Length: mean less the top. With a length: height of the face, and what it is off.
        let [less, expected] = match self.of.correction.and_then(|c| c.length_mm) {
            Some(length) => [length, top_mm],
            None => [top_mm, face.length_mm],
        };
        let mean = format!("{sum} / {} - {}", face.hits, number(less));
        let text = format!(
            "{}\n{}\n{}",
            assign(control, Value::FirstResult, &mean),
            assign(control, Value::SecondResult, &format!("{sum} - {}", number(expected))),
            self.result(&[("Z", Value::FirstResult), ("V", Value::SecondResult)])
        );
        self.writer.write(&Block::Text(&text))?;
        self.end()
    }

    fn touch(&mut self, from_mm: [f64; 3], to_mm: [f64; 3]) -> Result<(), ProbeProgramError> {
        self.hits += 1;
        let s = self.settings;
        let touch = TwoStage {
            hit: self.hits,
            from_mm,
            to_mm,
            back_mm: s.back_off_mm,
            fast_mm_per_min: s.fast_mm_per_min,
            slow_mm_per_min: s.touch_mm_per_min,
            is_stand_in: self.of.is_stand_in,
        };
        Ok(self.writer.write(&Block::Text(&two_stage(self.of.control, &touch)))?)
    }

    /// Where the hit is, as its log says it.
    fn place_names(&self) -> [String; 2] {
        let control = self.of.control;
        match self.of.correction {
            None => [trigger(control, 0), trigger(control, 1)],
            Some(_) => [Value::X.name(control), Value::Y.name(control)],
        }
    }

    /// The correction, if there is one, and the line of the log.
    fn kept_in_ring(&self, angle_rad: f64, from_mm: [f64; 3]) -> String {
        let control = self.of.control;
        let (hit, angle) = (self.hits, angle_rad.to_degrees());
        let turned = self.settings.orientation_rad.to_degrees() + 0.0;
        let [hx, hy, z] = [0, 1, 2].map(|axis| trigger(control, axis));
        let [sx, sy] = [number(from_mm[0]), number(from_mm[1])];
        let [x, y] = self.place_names();
        let dr = Value::Dr.name(control);
        let corrected = self.of.correction.is_some();
        let call = match (corrected, control) {
            (false, _) => String::new(),
            (true, Control::Fanuc | Control::Haas) => format!(
                "G65 P7060 A{hx} B{hy} I[{hx}-[{:.4}]] J[{hy}-[{:.4}]]\n",
                from_mm[0] + 0.0,
                from_mm[1] + 0.0
            ),
            (true, Control::LinuxCnc) => format!(
                "o<trueaxis_correct> call [{hx}] [{hy}] [{hx}-[{:.4}]] [{hy}-[{:.4}]]\n",
                from_mm[0] + 0.0,
                from_mm[1] + 0.0
            ),
            (true, Control::Sinumerik840d | Control::Heidenhain) => {
                let run = match control {
                    Control::Heidenhain => "CALL PGM TRUEAXIS_CORRECT.H",
                    _ => "TRUEAXIS_CORRECT",
                };
                let gives = [
                    (Value::HitX, hx.clone()),
                    (Value::HitY, hy.clone()),
                    (Value::WayX, format!("{hx} - {sx}")),
                    (Value::WayY, format!("{hy} - {sy}")),
                ];
                let lines = gives.map(|(v, text)| assign(control, v, &text)).join("\n");
                format!("{lines}\n{run}\n")
            }
        };
        let line = match control {
            Control::Fanuc | Control::Haas => {
                let e = if corrected { format!("*E{dr}[35]") } else { String::new() };
                format!(
                    "DPRNT[H{hit}*T#4120[40]*D{angle:.5}*S{turned:.5}*X{x}[44]*Y{y}[44]*Z{z}[44]{e}]"
                )
            }
            Control::LinuxCnc => {
                let e = if corrected { format!(" E{dr}") } else { String::new() };
                format!("(LOG,H{hit} T#5400 D{angle:.5} S{turned:.5} X{x} Y{y} Z{z}{e})")
            }
            Control::Sinumerik840d => {
                let e = if corrected { format!("<<\" E\"<<{dr}") } else { String::new() };
                self.log.write(&format!(
                    "\"H{hit} T\"<<$P_TOOLNO<<\" D{angle:.5} S{turned:.5} X\"<<{x}<<\" Y\"<<{y}<<\" Z\"<<{z}{e}"
                ))
            }
            Control::Heidenhain => {
                let kept = [hit as f64, angle, turned];
                let kept: Vec<(u32, f64)> = heidenhain::KEPT.into_iter().zip(kept).collect();
                heidenhain::keep(self.log, &kept)
            }
        };
        format!("{call}{line}")
    }

    fn kept_on_face(&self) -> String {
        let (control, hit) = (self.of.control, self.hits);
        let z = trigger(control, 2);
        match control {
            Control::Fanuc | Control::Haas => format!("DPRNT[H{hit}*T#4120[40]*Z{z}[44]]"),
            Control::LinuxCnc => format!("(LOG,H{hit} T#5400 Z{z})"),
            Control::Sinumerik840d => {
                self.log.write(&format!("\"H{hit} T\"<<$P_TOOLNO<<\" Z\"<<{z}"))
            }
            Control::Heidenhain => heidenhain::keep(self.log, &[(heidenhain::KEPT[0], hit as f64)]),
        }
    }

    /// o = c − ((A + B)/2, (C + D)/2), d = 2R − (A − B)                     docs/model.md eq. 144
    fn offset(&self, centre_mm: [f64; 2], ring_radius_mm: f64) -> String {
        let control = self.of.control;
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| Value::Kept(i).name(control));
        let [cx, cy] = centre_mm.map(number);
        let diameter = number(2.0 * ring_radius_mm);
        let lines = [
            assign(control, Value::FirstResult, &format!("{cx} - ( {a} + {b} ) / 2")),
            assign(control, Value::SecondResult, &format!("{cy} - ( {c} + {d} ) / 2")),
            assign(control, Value::ThirdResult, &format!("{diameter} - ( {a} - {b} )")),
            assign(control, Value::FourthResult, &format!("{diameter} - ( {c} - {d} )")),
            self.result(&[
                ("X", Value::FirstResult),
                ("Y", Value::SecondResult),
                ("U", Value::ThirdResult),
                ("V", Value::FourthResult),
            ]),
        ];
        lines.join("\n")
    }

    /// A line of the log with what the control has computed.
    fn result(&self, values: &[(&str, Value)]) -> String {
        let control = self.of.control;
        let words = |gap: &str, of: &dyn Fn(String) -> String| -> String {
            values.iter().map(|(w, v)| format!("{gap}{w}{}", of(v.name(control)))).collect()
        };
        match control {
            Control::Fanuc | Control::Haas => {
                format!("DPRNT[RESULT{}]", words("*", &|name| format!("{name}[44]")))
            }
            Control::LinuxCnc => format!("(LOG,RESULT{})", words(" ", &|name| name)),
            Control::Sinumerik840d => {
                let text = words(" ", &|name| format!("\"<<{name}<<\""));
                self.log.write(&format!("\"RESULT{text}\""))
            }
            Control::Heidenhain => heidenhain::result(self.log),
        }
    }

    fn rapid(&mut self, to: &[(Axis, f64)]) -> Result<(), ProbeProgramError> {
        let target = self.target(to);
        Ok(self.writer.write(&Block::Rapid(target))?)
    }

    fn line(&mut self, to: [f64; 3]) -> Result<(), ProbeProgramError> {
        let target = self.target(&[(Axis::X, to[0]), (Axis::Y, to[1]), (Axis::Z, to[2])]);
        let feed = Feed { mode: FeedMode::PerMinute, value: self.settings.feed_mm_per_min };
        Ok(self.writer.write(&Block::Line(target, feed))?)
    }

    fn target(&self, to: &[(Axis, f64)]) -> Target {
        let coordinates = axis_coordinates(self.of.control);
        let place = to.iter().fold(Target::default(), |t, (axis, value)| t.at(*axis, *value));
        Target { coordinates, ..place }
    }

    fn end(mut self) -> Result<Vec<u8>, ProbeProgramError> {
        let text = self.log.close(self.of.control, self.hits);
        self.writer.write(&Block::Text(&text))?;
        self.writer.write(&Block::End)?;
        Ok(self.writer.finish())
    }
}
