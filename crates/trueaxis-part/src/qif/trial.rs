//! A trial of the draft by the reader of part files: what that refuses is left out with its reason.

use super::text::{Unknown, Writer};
use super::{Draft, LeftOut};
use crate::part::Part;
use std::path::Path;
use trueaxis_input::{Diagnostic, Severity, SourceText};

/// A mistake of a feature hides those of its characteristics, so a second round finds them; more are for safety.
const ROUNDS: usize = 10;

/// Takes out of a draft what the reader of part files refuses; values that are not known have stand-ins.
pub(super) fn judge(draft: &mut Draft) {
    for _ in 0..ROUNDS {
        if draft.characteristics.is_empty() {
            return;
        }
        let writer = Writer::write(draft, Unknown::StoodIn);
        let source = SourceText::new("draft", &writer.text);
        source.read(|root| Part::read(root, Path::new("")));
        let found = source.finish();
        let is_error = |p: &&Diagnostic| p.severity == Severity::Error;
        let errors: Vec<&Diagnostic> = found.iter().filter(is_error).collect();
        if errors.is_empty() {
            return;
        }
        refuse(draft, &writer, &errors);
    }
}

fn refuse(draft: &mut Draft, writer: &Writer, errors: &[&Diagnostic]) {
    let first = writer.characteristic_lines.first().copied().unwrap_or(usize::MAX);
    // The last one that begins before the line of an error.
    let block = |lines: &[usize], line: usize| lines.iter().rposition(|start| *start <= line);
    let mut features: Vec<Option<String>> = vec![None; draft.features.len()];
    let mut asked: Vec<Option<String>> = vec![None; draft.characteristics.len()];
    for error in errors {
        let line = error.place.line;
        let slot = match line < first {
            true => block(&writer.feature_lines, line).and_then(|k| features.get_mut(k)),
            false => block(&writer.characteristic_lines, line).and_then(|k| asked.get_mut(k)),
        };
        match slot {
            Some(slot) => *slot = slot.take().or(Some(error.message.clone())),
            // A text that cannot be read at all keeps nothing.
            None => asked.fill(Some(error.message.clone())),
        }
    }
    let mut kept = Vec::new();
    for (one, refused) in std::mem::take(&mut draft.characteristics).into_iter().zip(asked) {
        let all = one.datums.iter().flat_map(|d| &d.features).chain([&one.of]);
        let of_feature = all.filter_map(|i| {
            let reason = features[*i].as_ref()?;
            Some(format!("feature {}: {reason}", draft.features[*i].id))
        });
        let Some(reason) = refused.or_else(|| of_feature.into_iter().next()) else {
            kept.push(one);
            continue;
        };
        let name = one.name.as_ref().map(|n| format!(" \"{n}\"")).unwrap_or_default();
        let what = format!("{}{name}", one.kind.name());
        draft.left_out.push(LeftOut { id: one.id, what, reason, place: one.place });
    }
    draft.characteristics = kept;
    let good: Vec<bool> = features.iter().map(Option::is_none).collect();
    keep(draft, &good);
}

/// Keeps these features only; no characteristic may name another one.
pub(super) fn keep(draft: &mut Draft, kept: &[bool]) {
    let mut index = Vec::new();
    let mut count = 0;
    for is_kept in kept {
        index.push(count);
        count += usize::from(*is_kept);
    }
    let mut each = kept.iter();
    draft.features.retain(|_| each.next().copied().unwrap_or(false));
    for asked in &mut draft.characteristics {
        asked.of = index[asked.of];
        let datums = asked.datums.iter_mut().flat_map(|d| &mut d.features);
        datums.for_each(|d| *d = index[*d]);
    }
}
