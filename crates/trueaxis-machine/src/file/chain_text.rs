//! The order of the bodies as written in the machine file: `w C' A' b X Y Z t`.

use crate::axis::AxisSide;
use crate::errors::BodyName;

/// The chain as read: axes from the workpiece to the tool, and how many carry the workpiece.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainText {
    /// Axes in order from the workpiece to the tool.
    pub axes: Vec<BodyName>,
    /// The number of bodies between the workpiece and the bed.
    pub workpiece_side: usize,
    /// The assumption made where the text does not state the order.
    pub notice: Option<String>,
}

impl ChainText {
    /// Reads `w C' A' b X Y Z t`, or the short forms `WYXZCAT` and `ZX'Y'A'C'`.
    ///
    /// ```
    /// use trueaxis_machine::file::ChainText;
    /// let gantry = ChainText::parse("WYXZCAT").unwrap();
    /// assert_eq!(gantry.long_form(), "w b Y X Z C A t");
    /// assert!(gantry.notice.is_some()); // the place of the bed was assumed
    /// ```
    ///
    /// # Errors
    /// A sentence that states the error in the text.
    pub fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let parsed =
            if text.contains(char::is_whitespace) { parse_long(text) } else { parse_short(text) }?;
        check(&parsed.axes)?;
        Ok(parsed)
    }

    /// What an axis carries.
    pub fn carries(&self, index: usize) -> AxisSide {
        if index < self.workpiece_side { AxisSide::Workpiece } else { AxisSide::Tool }
    }

    /// The long form, with primes and bed.
    pub fn long_form(&self) -> String {
        let mut text = String::from("w");
        for (i, axis) in self.axes.iter().enumerate() {
            if i == self.workpiece_side {
                text += " b";
            }
            let prime = if i < self.workpiece_side { "'" } else { "" };
            text += &format!(" {axis}{prime}");
        }
        if self.workpiece_side == self.axes.len() {
            text += " b";
        }
        text + " t"
    }
}

fn parse_long(text: &str) -> Result<ChainText, String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let [first, middle @ .., last] = &words[..] else {
        return Err("the chain is empty".into());
    };
    if *first != "w" || *last != "t" {
        return Err("the chain must begin with `w` (workpiece) and end with `t` (tool)".into());
    }
    let mut axes = Vec::new();
    let mut bed = None;
    for word in middle {
        if *word == "b" {
            if bed.replace(axes.len()).is_some() {
                return Err("the bed `b` occurs twice in the chain".into());
            }
            continue;
        }
        let (name, primed) = split_prime(word);
        if primed && bed.is_some() {
            return Err(format!("`{word}` has a prime, but is on the tool side of the bed"));
        }
        axes.push(axis_name(name)?);
    }
    let notice = bed.is_none().then(|| {
        "the chain does not name the bed `b`; it is assumed directly after the workpiece".to_owned()
    });
    Ok(ChainText { axes, workpiece_side: bed.unwrap_or(0), notice })
}

fn parse_short(text: &str) -> Result<ChainText, String> {
    let mut words: Vec<String> = Vec::new();
    for c in text.chars() {
        match (c, words.last_mut()) {
            ('\'' | '’' | '′', Some(word)) => word.push('\''),
            ('\'' | '’' | '′', None) => {
                return Err("the chain begins with a prime, without a letter before it".into());
            }
            _ => words.push(c.to_string()),
        }
    }
    let from_workpiece = matches!(words.first().map(String::as_str), Some("W" | "w"))
        && matches!(words.last().map(String::as_str), Some("T" | "t"));
    if from_workpiece {
        let last = words.len() - 1;
        (words[0], words[last]) = ("w".into(), "t".into());
        return parse_long(&words.join(" "));
    }
    parse_machine_type(&words)
}

/// `ZX'Y'A'C'`: the tool side from the bed on, then the primed axes from the bed on. The order of
/// the linear axes among themselves is not in such a name; in Lei and Hsu 2003 (Eq 20) the last
/// one is on the bed.
fn parse_machine_type(words: &[String]) -> Result<ChainText, String> {
    let (mut linear, mut rotary, mut tool) = (Vec::new(), Vec::new(), Vec::new());
    for word in words {
        let (name, primed) = split_prime(word);
        let axis = axis_name(name)?;
        match (primed, axis.is_rotary()) {
            (false, _) => tool.push(axis),
            (true, true) => rotary.push(axis),
            (true, false) => linear.push(axis),
        }
    }
    let mut axes: Vec<_> = rotary.into_iter().rev().chain(linear).collect();
    let workpiece_side = axes.len();
    axes.extend(tool);
    let notice = Some(
        "the name states neither the bed nor the order of the linear axes; the last primed axis \
         is assumed on the bed, as in Lei and Hsu 2003"
            .to_owned(),
    );
    Ok(ChainText { axes, workpiece_side, notice })
}

fn split_prime(word: &str) -> (&str, bool) {
    let name = word.trim_end_matches(['\'', '’', '′']);
    (name, name.len() < word.len())
}

fn axis_name(word: &str) -> Result<BodyName, String> {
    let mut letters = word.chars();
    match (letters.next().and_then(BodyName::new), letters.next()) {
        (Some(name), None) if name.is_axis() => Ok(name),
        _ => {
            Err(format!("unknown axis `{word}`; axes are X Y Z U V W (linear) and A B C (rotary)"))
        }
    }
}

fn check(axes: &[BodyName]) -> Result<(), String> {
    for (i, axis) in axes.iter().enumerate() {
        if axes[..i].contains(axis) {
            return Err(format!("two axes are named {axis}"));
        }
    }
    if !(3..=crate::axis::MAX_AXES).contains(&axes.len()) {
        return Err(format!("the chain has {} axes, expected 3 to 6", axes.len()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_forms_print_the_long_one() {
        let long = |text: &str| ChainText::parse(text).unwrap().long_form();
        assert_eq!(long("ZX'Y'A'C'"), "w C' A' X' Y' b Z t");
        assert_eq!(long(" WYXZCAT\n"), "w b Y X Z C A t");
        assert_eq!(long("w C A b X Y Z t"), "w C' A' b X Y Z t");
        assert_eq!(long("w X Y Z C A t"), "w b X Y Z C A t");
        assert_eq!(long("w X' Y' Z' b t"), "w X' Y' Z' b t");
    }

    #[test]
    fn refusals_name_the_fault() {
        let fault = |text: &str| ChainText::parse(text).unwrap_err();
        assert_eq!(fault("w b X Y X t"), "two axes are named X");
        assert!(fault("w b X Y Q t").starts_with("unknown axis `Q`"));
        assert!(fault("w b X C' Z t").contains("prime"));
        assert!(fault("w b X Y t").contains("3 to 6"));
        assert!(fault("w b X b Y Z t").contains("twice"));
        assert!(fault("'").contains("prime"));
        assert!(ChainText::parse("").is_err());
    }
}
