//! Results as a table.

use super::{Found, check};
use crate::Error;
use crate::part::Part;

const HEADINGS: &str =
    "characteristic,kind,feature,datums,value_mm,u_mm,low_mm,high_mm,used,outcome\n";

/// A row for each characteristic: values and limits as the part file has them, of a size its deviations; `low_mm` of a zone is empty.
/// `used` is the share of the tolerance ([`crate::part::Limits::used`]), unit: 1. Numbers have all their digits. Cells are quoted as RFC 4180
/// asks, lines end with a line feed as in all tables of this project. A name that a spreadsheet would take for a formula begins
/// with an apostrophe.
///
/// # Errors
/// As [`super::results`].
pub fn results_csv(part: &Part, found: &[Found]) -> Result<String, Error> {
    check(part, found)?;
    let mut text = HEADINGS.to_owned();
    for (asked, found) in part.characteristics.iter().zip(found) {
        let datums: Vec<String> = asked.datums.iter().map(|d| d.label(&part.features)).collect();
        let (low_mm, high_mm) = asked.limits.ends_mm();
        let low = low_mm.map_or(String::new(), |v| v.to_string());
        text += &format!(
            "{},{},{},{},{},{},{low},{high_mm},{},{}\n",
            cell(&asked.name),
            asked.kind.key(),
            cell(&asked.of),
            cell(&datums.join("|")),
            found.value_mm,
            found.u_mm,
            asked.limits.used(found.value_mm),
            found.outcome.word(),
        );
    }
    Ok(text)
}

/// A text that is none of a program: names come from files of others.
fn cell(text: &str) -> String {
    let is_formula = text.trim_start().starts_with(['=', '+', '-', '@']);
    let text = if is_formula { format!("'{text}") } else { text.to_owned() };
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::cell;

    #[test]
    fn cells_by_hand() {
        let cells = ["top", "a,b", "a \"b\"", "a\nb", "=1+1", "-x", "@a,b", " +1"].map(cell);
        let due =
            ["top", "\"a,b\"", "\"a \"\"b\"\"\"", "\"a\nb\"", "'=1+1", "'-x", "\"'@a,b\"", "' +1"];
        assert_eq!(cells, due);
    }
}
