//! A machine file by a few answers: the template of its kind with other numbers in it.

use crate::Kind;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// What is known of a new machine. Without an answer it is as in the template.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// What its rotary axes carry.
    pub kind: Kind,
    /// Its name.
    pub name: String,
    /// Linear axes that carry the workpiece: `Y`.
    pub workpiece: Vec<char>,
    /// The rotary axis that tilts: `A` or `B`.
    pub tilting: Option<char>,
    /// Travels by axis, from and to. Unit: mm or deg.
    pub travels: BTreeMap<char, Travel>,
    /// Axes whose plus is against ISO 841.
    pub reversed: Vec<char>,
    /// The place of the reference line of Z at Z = 0 above the origin of the machine frame, mm.
    pub height_mm: Option<f64>,
}

/// How far an axis goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Travel {
    /// From and to. Unit: mm or deg.
    Between(f64, f64),
    /// All around.
    Unlimited,
}

/// An answer that no machine has.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WrongAnswer {
    /// The name has characters that a TOML text does not take.
    #[error("the name of a machine cannot contain {0:?}")]
    Name(char),
    /// No axis has this name.
    #[error("a machine of this kind has no axis {0}")]
    Axis(char),
    /// Its end is not above its beginning.
    #[error("the travel of {0} does not go from a smaller to a larger number")]
    Travel(char),
    /// A linear axis turns all around.
    #[error("only a rotary axis is unlimited, {0} is linear")]
    Unlimited(char),
    /// The height is not a number.
    #[error("the height is not a number")]
    Height,
}

/// The machine file.
///
/// # Errors
/// The first answer that does not fit the kind.
///
/// ```
/// use trueaxis_templates::{Answers, Kind, Travel, machine_file};
/// let answers = Answers {
///     workpiece: vec!['Y'],
///     tilting: Some('B'),
///     travels: [('X', Travel::Between(0.0, 850.0))].into(),
///     reversed: vec!['C'],
///     ..Answers::of(Kind::TableTable, "mill 7")
/// };
/// let text = machine_file(&answers).unwrap();
/// assert!(text.contains("chain = \"w C' B' Y' b X Z t\"") && text.contains("travel = [\"0 mm\", \"850 mm\"]"));
/// assert!(text.contains("[axis.C]\nsense = 1\n") && text.contains("EX0B = ") && !text.contains("0A ="));
/// ```
pub fn machine_file(answers: &Answers) -> Result<String, WrongAnswer> {
    let axes = answers.axes();
    if let Some(wrong) = answers.name.chars().find(|c| c.is_control() || matches!(c, '"' | '\\')) {
        return Err(WrongAnswer::Name(wrong));
    }
    let named = answers.workpiece.iter().filter(|axis| !"XYZ".contains(**axis));
    let named = named.chain(answers.travels.keys()).chain(&answers.reversed);
    if let Some(axis) = named.into_iter().find(|axis| !axes.contains(axis)) {
        return Err(WrongAnswer::Axis(*axis));
    }
    for (axis, travel) in &answers.travels {
        match travel {
            // NaN goes nowhere.
            Travel::Between(from, to) if !(to > from && (to - from).is_finite()) => {
                return Err(WrongAnswer::Travel(*axis));
            }
            Travel::Unlimited if "XYZ".contains(*axis) => {
                return Err(WrongAnswer::Unlimited(*axis));
            }
            _ => {}
        }
    }
    if answers.height_mm.is_some_and(|height| !height.is_finite()) {
        return Err(WrongAnswer::Height);
    }
    let template = answers.kind.machine().replace("NAME", &answers.name);
    let template = match answers.tilting {
        Some(to) => renamed(&template, answers.kind.tilting(), to)?,
        None => template,
    };
    Ok(filled(&template, answers))
}

impl Answers {
    /// A machine of this kind and name as in its template.
    pub fn of(kind: Kind, name: &str) -> Self {
        Self {
            kind,
            name: name.to_owned(),
            workpiece: if kind == Kind::ThreeAxis { vec!['X', 'Y'] } else { Vec::new() },
            tilting: None,
            travels: BTreeMap::new(),
            reversed: Vec::new(),
            height_mm: None,
        }
    }

    /// Its axes.
    fn axes(&self) -> Vec<char> {
        let tilting = self.kind.tilting().map(|usual| self.tilting.unwrap_or(usual));
        let turning = tilting.map(|_| 'C');
        ['X', 'Y', 'Z'].into_iter().chain(turning).chain(tilting).collect()
    }

    /// A squareness of the template under the name of the axis that it turns. Of two axes on one side of the bed that is the one
    /// farther from it: an error of the nearer one would turn both.
    fn squareness(&self, line: &str) -> Option<String> {
        let pairs = [("EC0", ['X', 'Y']), ("EA0", ['Y', 'Z']), ("EB0", ['X', 'Z'])];
        let (name, value) = line.split_once(" = ")?;
        let of = |(angle, axes): &(&str, [char; 2])| {
            axes.iter().any(|axis| name == format!("{angle}{axis}"))
        };
        let (angle, [first, second]) = pairs.into_iter().find(of)?;
        let both = [first, second].iter().all(|axis| self.workpiece.contains(axis));
        Some(format!("{angle}{} = {value}", if both { first } else { second }))
    }

    /// A comment of the template that states what was answered otherwise.
    fn comment<'l>(&self, line: &'l str) -> Cow<'l, str> {
        let usual = Self::of(self.kind, &self.name).workpiece;
        if line.starts_with("# A three-axis milling machine") && self.workpiece != usual {
            return "# A three-axis milling machine.".into();
        }
        match self.height_mm.filter(|_| line.starts_with("# At Z = 0")) {
            Some(height) => {
                let usual = if line.contains("500 mm") { "500 mm" } else { "600 mm" };
                line.replace(usual, &format!("{height} mm")).into()
            }
            None => line.into(),
        }
    }

    /// From the workpiece over the bed to the tool; linear axes stand next to the bed.
    fn chain(&self) -> String {
        let tilting = self.tilting.or(self.kind.tilting()).unwrap_or('A');
        let (table, head) = match self.kind {
            Kind::ThreeAxis => (String::new(), String::new()),
            Kind::TableTable => (format!("C' {tilting}' "), String::new()),
            Kind::HeadHead => (String::new(), format!("C {tilting} ")),
            Kind::HeadTable => ("C' ".to_owned(), format!("{tilting} ")),
        };
        let carries = |axis: &char| self.workpiece.contains(axis);
        // X stands on Y under the workpiece, Y on X above the bed.
        let below: String = "XYZ".chars().filter(carries).map(|axis| format!("{axis}' ")).collect();
        let above: String =
            "XYZ".chars().filter(|axis| !carries(axis)).map(|axis| format!("{axis} ")).collect();
        format!("w {table}{below}b {above}{head}t")
    }
}

/// The tilting axis and its errors under another letter: what is across to x is across to y.
fn renamed(template: &str, usual: Option<char>, to: char) -> Result<String, WrongAnswer> {
    let Some(from) = usual.filter(|_| matches!(to, 'A' | 'B')) else {
        return Err(WrongAnswer::Axis(to));
    };
    if from == to {
        return Ok(template.to_owned());
    }
    let across = |letter: char| if letter == 'A' { ('Y', 'B') } else { ('X', 'A') };
    let ((was_offset, was_tilt), (offset, tilt)) = (across(from), across(to));
    let words = [
        (format!("[axis.{from}]"), format!("[axis.{to}]")),
        (format!("{from}' tilts"), format!("{to}' tilts")),
        (format!("{from} tilts"), format!("{to} tilts")),
        (format!("axis of {from}"), format!("axis of {to}")),
        (format!("head {from}."), format!("head {to}.")),
        (format!("axes of {from} and C"), format!("axes of {to} and C")),
        (format!("where {from} and C"), format!("where {to} and C")),
        (format!("where C and {from}"), format!("where C and {to}")),
        (format!("E{was_offset}0{from}"), format!("E{offset}0{to}")),
        (format!("EZ0{from}"), format!("EZ0{to}")),
        (format!("E{was_tilt}0{from}"), format!("E{tilt}0{to}")),
        (format!("EC0{from}"), format!("EC0{to}")),
    ];
    let renamed = words.iter().fold(template.to_owned(), |text, (was, is)| text.replace(was, is));
    // The offset of the spindle to a tilting axis is across it; a fork head has both offsets already.
    let tool = (format!("E{was_offset}0t"), format!("E{offset}0t"));
    let has_both = renamed.contains("EX0t") && renamed.contains("EY0t");
    Ok(if has_both { renamed } else { renamed.replace(&tool.0, &tool.1) })
}

/// The numbers of the answers in the lines of the template.
fn filled(template: &str, answers: &Answers) -> String {
    let mut text = String::new();
    let mut block = None;
    for line in template.lines() {
        if line.starts_with('[') {
            block = line.strip_prefix("[axis.").and_then(|rest| rest.chars().next());
        }
        if let Some(squareness) = answers.squareness(line) {
            text += &squareness;
            text.push('\n');
            continue;
        }
        let line = &*answers.comment(line);
        let travel = block.and_then(|axis| answers.travels.get(&axis));
        let is = |key: &str| line.starts_with(&format!("{key} = "));
        match travel {
            _ if is("chain") => text += &format!("chain = \"{}\"", answers.chain()),
            Some(travel) if is("travel") => text += &travel_line(*travel, block),
            _ => match answers.height_mm.filter(|_| block == Some('Z') && is("placement")) {
                Some(height) => text += &format!("placement = \"0 0 {height} mm\""),
                None => text += line,
            },
        }
        text.push('\n');
        let begins = line.starts_with("[axis.");
        if begins && block.is_some_and(|axis| answers.reversed.contains(&axis)) {
            // ISO 841: a body that carries the tool moves to plus, one that carries the workpiece to minus.
            let on_table = block.is_some_and(|axis| answers.chain().contains(&format!("{axis}'")));
            text += if on_table { "sense = 1\n" } else { "sense = -1\n" };
        }
    }
    text
}

fn travel_line(travel: Travel, axis: Option<char>) -> String {
    let unit = if axis.is_some_and(|axis| "XYZ".contains(axis)) { "mm" } else { "deg" };
    match travel {
        Travel::Unlimited => "travel = \"unlimited\"".to_owned(),
        Travel::Between(from, to) => format!("travel = [\"{from} {unit}\", \"{to} {unit}\"]"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_answers_it_is_the_template() {
        for kind in Kind::ALL {
            let text = machine_file(&Answers::of(kind, "mill")).unwrap();
            assert_eq!(text, kind.machine().replace("NAME", "mill"));
        }
    }

    #[test]
    fn an_axis_keeps_its_errors_under_its_other_letter() {
        for kind in [Kind::TableTable, Kind::HeadHead, Kind::HeadTable] {
            let usual = kind.tilting().unwrap();
            let other = if usual == 'A' { 'B' } else { 'A' };
            let text =
                machine_file(&Answers { tilting: Some(other), ..Answers::of(kind, "m") }).unwrap();
            let back = renamed(&text, Some(other), usual).unwrap();
            let chain = |text: &str| text.lines().filter(|l| !l.starts_with("chain")).count();
            assert_eq!(chain(&back), chain(kind.machine()));
            for gone in [format!("0{usual} ="), format!("axis.{usual}"), format!("axis of {usual}")]
            {
                assert!(!text.contains(&gone), "{gone}: {text}");
            }
        }
    }

    #[test]
    fn answers_that_no_machine_has_are_refused() {
        let of = |change: &dyn Fn(&mut Answers)| {
            let mut answers = Answers::of(Kind::ThreeAxis, "m");
            change(&mut answers);
            machine_file(&answers).unwrap_err()
        };
        assert_eq!(of(&|a| a.name = "a\"b".to_owned()), WrongAnswer::Name('"'));
        assert_eq!(of(&|a| a.reversed = vec!['C']), WrongAnswer::Axis('C'));
        assert_eq!(of(&|a| a.tilting = Some('A')), WrongAnswer::Axis('A'));
        assert_eq!(of(&|a| a.workpiece = vec!['C']), WrongAnswer::Axis('C'));
        let travel = |travel| move |a: &mut Answers| a.travels = [('X', travel)].into();
        assert_eq!(of(&travel(Travel::Between(1.0, 1.0))), WrongAnswer::Travel('X'));
        assert_eq!(of(&travel(Travel::Between(f64::NAN, 1.0))), WrongAnswer::Travel('X'));
        assert_eq!(of(&travel(Travel::Between(0.0, f64::INFINITY))), WrongAnswer::Travel('X'));
        assert_eq!(of(&travel(Travel::Unlimited)), WrongAnswer::Unlimited('X'));
        assert_eq!(of(&|a| a.height_mm = Some(f64::NAN)), WrongAnswer::Height);
    }
}
