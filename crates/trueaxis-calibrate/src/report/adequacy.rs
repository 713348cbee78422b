//! Whether the listed errors explain the readings, in text.

use super::identification::rms_words;
use crate::identify::adequacy::{Adequacy, Kind, LEVEL, LackOfFit};
use crate::identify::score::Rms;
use trueaxis_measure::unknowns::design::Design;
use trueaxis_measure::unknowns::unlisted::Follows;
use trueaxis_report::{Section, Table};

/// What the test of the residual says, and how much is not listed.
pub(super) fn adequacy_remarks(adequacy: &Adequacy) -> Vec<String> {
    let mut remarks = vec![test_words(&adequacy.lack)];
    if adequacy.noise > 1.0 {
        remarks.push(format!(
            "the noise is {:.2} times as large as stated; the uncertainties are enlarged by it",
            adequacy.noise
        ));
    }
    if adequacy.kinds.iter().any(|k| k.times > 0.0) {
        remarks.push(
            "errors that are not listed are part of the uncertainties, as large as the residual shows"
                .to_owned(),
        );
    }
    remarks
}

/// What a kind of error follows, as a word.
pub(super) fn follows(design: &Design, kind: &Kind) -> String {
    match kind.follows {
        Follows::Axis(axis) => design.machine.axes()[axis].name.to_string(),
        Follows::Arrangement => "arrangement".to_owned(),
        Follows::Approach => "approach".to_owned(),
        Follows::Time => "time".to_owned(),
    }
}

/// How much of the residual each kind would explain alone.
pub(super) fn kinds_words(design: &Design, adequacy: &Adequacy) -> String {
    let all = adequacy.kinds.iter().filter(|k| k.share > 0.005);
    let all = all.map(|k| format!("{} {:.0} %", follows(design, k), 100.0 * k.share));
    match all.collect::<Vec<_>>().join(", ") {
        none if none.is_empty() => {
            "No kind of error that is not listed would explain any of the residual.".to_owned()
        }
        some => format!(
            "Of the squares of the residual, errors that are not listed would explain, each kind alone (by what it \
             follows): {some}."
        ),
    }
}

fn test_words(lack: &LackOfFit) -> String {
    let relation = if lack.is_found() { "more" } else { "not more" };
    let percent = 100.0 * LEVEL;
    match lack.of_repeats {
        None => format!(
            "χ² of the residual = {:.1} with {:.0} degrees of freedom: {relation} than {:.1}, which {percent} % of \
             good campaigns exceed",
            lack.statistic, lack.freedom, lack.limit
        ),
        Some(repeats) => format!(
            "F of the residual against the repeatability = {:.2} with {:.0} and {repeats:.0} degrees of freedom: \
             {relation} than {:.2}, which {percent} % of good campaigns exceed",
            lack.statistic, lack.freedom, lack.limit
        ),
    }
}

/// How well readings are predicted.
pub(super) fn predictor_section<'a>(design: &Design, adequacy: &Adequacy) -> Option<Section<'a>> {
    let predictor = adequacy.predictor.as_ref()?;
    let axes = design.machine.axes();
    let row = |what: String, listed: Option<&Rms>, all: &Rms| {
        [what, listed.map_or(String::new(), rms_words), rms_words(all), format!("{:.2}", all.noise)]
    };
    let mut rows = vec![row("in sample".to_owned(), None, &predictor.in_sample)];
    rows.extend(predictor.held_out.iter().map(|held| {
        let what = match held.axis {
            None => format!("held out: a part of the places, {} times", held.parts),
            Some(axis) => {
                format!("held out: one angle of {}, {} times", axes[axis].name, held.parts)
            }
        };
        row(what, Some(&held.listed), &held.predicted)
    }));
    let head = ["residual of the prediction", "listed errors", "all errors", "times the noise"];
    let note = "All errors: those that are listed and those that are not, each with a prior. It predicts where no single \
                error can be named; the sizes of the priors were found without what was held out.";
    Some(Section::new("Prediction").table(Table::new(head).rows(rows).note(note.to_owned())))
}
