//! Touches of HEIDENHAIN Klartext: touch probe cycle 3 in the plane, 4 in space, and a log by FN 16.
//!
//! ```text
//!     Q13 = -1
//!     TCH PROBE 4.0 MEASURING IN 3-D          X, Y, Z in Q10 to Q12, from the machine zero; Q13 stays -1 or becomes -1
//!     …                                       where nothing was touched
//!     FN 9: IF +Q13 EQU -1 GOTO LBL 99        the alarm stands at LBL 99
//!     FN 16: F-PRINT mask / log               one line; the mask names the parameters
//! ```
//!
//! A place that lies farther from the end of the touch than its whole way is not in the machine frame, and goes to
//! the alarm as well.
//!
//! # Source
//! Public: FN 16 with mask and output file; FN 14 with error 1014 (touch point inaccessible); FN 9, FN 11, FN 13;
//! that FN 18 reads system data. From memory of the manuals "Touch probe cycles" of the iTNC 530 and TNC 640, not
//! checked on a page: the lines of cycles 3 and 4, the −1 in their fourth result, `REFERENCE SYSTEM:1` (machine zero),
//! `MB` (the way back), `ID20 NR1` (the tool in the spindle), the form `%9.4F` of a mask (iTNC 530: `%9.4LF`) and its
//! word `M_CLOSE`.

use super::LogName;

/// The first of the four results of a touch: X, Y, Z and whether there was one.
pub(crate) const RESULT: u32 = 10;
/// Of the tool that is in the spindle.
pub(crate) const TOOL: u32 = 3;
/// Parameters for what is kept beside the place.
pub(crate) const KEPT: [u32; 6] = [1, 2, 21, 22, 23, 24];
/// How far the place is from the end of the touch.
const OFF: u32 = 14;
/// The label of the alarm, and that after it.
const ALARM: u32 = 99;
const BEGIN: u32 = 98;
/// Where masks and logs are.
const FOLDER: &str = "TNC:\\TRUEAXIS";
/// Directions nearer to the plane than this are in it.
const LEVEL: f64 = 1e-9;

/// A touch from a place to another at the latest, machine coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Probing {
    pub from_mm: [f64; 3],
    pub to_mm: [f64; 3],
    /// Another greatest way than that between the two; the place is judged by them all the same.
    pub way_mm: Option<f64>,
    pub mm_per_min: f64,
    /// How far the control goes back after it.
    pub back_mm: f64,
    /// A motion to the end stands for the touch.
    pub is_stand_in: bool,
}

/// A word of a line of the log with the parameter that it shows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Column {
    pub word: String,
    pub q: u32,
    pub decimals: usize,
}

fn file(log: LogName, part: &str) -> String {
    format!("{}{part}", log.stem.to_ascii_uppercase().replace('-', "_"))
}

fn print(log: LogName, part: &str) -> String {
    format!("FN 16: F-PRINT {FOLDER}\\{}.A / {FOLDER}\\{}.TXT", file(log, part), file(log, ""))
}

/// The alarm, jumped over, and the heading of the log.
pub(crate) fn open(log: LogName) -> String {
    format!(
        "FN 9: IF +0 EQU +0 GOTO LBL {BEGIN}\nLBL {ALARM}\n; NO TOUCH, OR NOT FROM THE MACHINE ZERO\nSTOP\n\
         FN 14: ERROR=1014\nLBL {BEGIN}\nFN 18: SYSREAD Q{TOOL} = ID20 NR1\n{}",
        print(log, "_START")
    )
}

/// A line with what the control has computed.
pub(crate) fn result(log: LogName) -> String {
    print(log, "_RESULT")
}

/// The mask of that line; none where nothing is computed.
pub(crate) fn result_mask(log: LogName, columns: &[Column]) -> Option<(String, String)> {
    let text = format!("\"RESULT {}\n", mask_line(columns.iter()));
    (!columns.is_empty()).then(|| (format!("{}.A", file(log, "_RESULT")), text))
}

/// The end of the log.
pub(crate) fn close(log: LogName) -> String {
    print(log, "_END")
}

/// The touch and its alarm.
pub(crate) fn probe(touch: &Probing) -> String {
    let way: Vec<f64> = touch.from_mm.iter().zip(touch.to_mm).map(|(a, b)| b - a).collect();
    let length = way.iter().map(|d| d * d).sum::<f64>().sqrt();
    let [x, y, z] = [0, 1, 2].map(|i| touch.to_mm[i] + 0.0);
    let mut text = format!("Q{} = -1\n", RESULT + 3);
    if touch.is_stand_in {
        text += &format!(
            "L X{x:+.4} Y{y:+.4} Z{z:+.4} R0 F{:.1} M91\nQ{} = {x:+.4}\nQ{} = {y:+.4}\nQ{} = {z:+.4}\nQ{} = +0\n",
            touch.mm_per_min,
            RESULT,
            RESULT + 1,
            RESULT + 2,
            RESULT + 3
        );
    } else {
        let (name, direction) = match way[2].abs() <= LEVEL * length {
            true => {
                let angle = way[1].atan2(way[0]).to_degrees() + 0.0;
                ("3.0 MEASURING", format!("3.2 X ANGLE:{angle:+.5}"))
            }
            false => {
                // Rounded first: no minus before a zero.
                let [i, j, k] = [0, 1, 2].map(|a| (1e7 * way[a] / length).round() / 1e7 + 0.0);
                ("4.0 MEASURING IN 3-D", format!("4.2 IX{i:+.7} IY{j:+.7} IZ{k:+.7}"))
            }
        };
        let cycle = &name[..1];
        text += &format!(
            "TCH PROBE {name}\nTCH PROBE {cycle}.1 Q{RESULT}\nTCH PROBE {direction}\n\
             TCH PROBE {cycle}.3 DIST{:+.4} F{:.1} MB{:.4} REFERENCE SYSTEM:1\n",
            touch.way_mm.unwrap_or(length),
            touch.mm_per_min,
            touch.back_mm
        );
    }
    let off: Vec<String> = [x, y, z]
        .iter()
        .zip(RESULT..)
        .map(|(to, q)| format!("ABS ( Q{q} - ( {to:+.4} ) )"))
        .collect();
    // The sum of three sides is at most √3 times the way.
    let most = 1.8 * length;
    text + &format!(
        "FN 9: IF +Q{} EQU -1 GOTO LBL {ALARM}\nQ{OFF} = {}\nFN 11: IF +Q{OFF} GT {most:+.4} GOTO LBL {ALARM}",
        RESULT + 3,
        off.join(" + ")
    )
}

/// Numbers for the line of the log, and the line.
pub(crate) fn keep(log: LogName, values: &[(u32, f64)]) -> String {
    let mut text = String::new();
    for (q, value) in values {
        let decimals = if value.fract() == 0.0 { 0 } else { 5 };
        text += &format!("Q{q} = {value:+.decimals$}\n");
    }
    text + &print(log, "")
}

/// The masks: heading, line with its parameters, end. The files of the masks with their text.
pub(crate) fn masks(log: LogName, columns: &[Column]) -> Vec<(String, String)> {
    let tool = Column { word: "T".to_owned(), q: TOOL, decimals: 0 };
    let line = format!("\"{}\n", mask_line(columns.iter().chain([&tool])));
    // The hits were counted in the first of the kept parameters.
    let end = format!("\"END %7.0F\",Q{};\nM_CLOSE;\n", KEPT[0]);
    let of = |part: &str, text: String| (format!("{}.A", file(log, part)), text);
    vec![of("_START", format!("\"{}\";\n", log.heading)), of("", line), of("_END", end)]
}

/// From after the first quotation mark to the end of the line.
fn mask_line<'c>(columns: impl Iterator<Item = &'c Column> + Clone) -> String {
    let words = columns.clone().map(|c| format!("{}%{}.{}F", c.word, 7 + c.decimals, c.decimals));
    let parameters = columns.map(|c| format!("Q{}", c.q));
    let [words, parameters] =
        [words.collect::<Vec<_>>().join(" "), parameters.collect::<Vec<_>>().join(",")];
    format!("{words}\",{parameters};")
}
