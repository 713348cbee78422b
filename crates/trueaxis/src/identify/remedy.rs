//! What would tell apart what cannot be told apart.

use super::confusion::Confusion;
use super::design::{Design, Unknown};
use super::term::Basis;
use crate::measure::Campaign;
use crate::measure::instrument::SetupError;

/// The cheapest further set-up that resolves a confusion, in words.
pub fn remedies(campaign: &Campaign, design: &Design, confusion: &Confusion) -> Option<String> {
    let members = || confusion.members.iter().filter_map(|(k, _)| design.unknown(*k));
    let setup = |wanted: fn(&SetupError) -> bool| {
        members().find_map(|u| match u {
            Unknown::Setup(instrument, unknown) if wanted(&unknown.error) => Some(instrument),
            _ => None,
        })
    };
    let low_order = |u: Unknown<'_>| match u {
        Unknown::Term(term) => matches!(
            term.basis,
            Basis::Legendre { degree: 1, .. }
                | Basis::Cosine(1)
                | Basis::Sine(1)
                | Basis::Hat { .. }
        ),
        Unknown::Setup(..) => false,
    };
    if confusion.members.len() == 1 {
        return Some("readings where it acts: move the other axes, or leave it out".to_owned());
    }
    if members().any(low_order) {
        let words = "begin the motion at the next order (\"polynomial 2-3\", \"fourier 2-3\"): the \
                     lowest one counts as location error (ISO 230-7)";
        return Some(words.to_owned());
    }
    if let Some(instrument) = setup(|e| matches!(e, SetupError::ToolPoint(_))) {
        let kind = instrument.kind;
        return Some(format!("a second {} of another length", kind.tool_point()));
    }
    if let Some(instrument) = setup(|e| matches!(e, SetupError::Zero(_) | SetupError::Scale)) {
        let kind = instrument.kind;
        return Some(format!(
            "a calibrated {}: unknown = {{ {} = \"1 um\" }} states its uncertainty",
            kind.zero(),
            kind.zero()
        ));
    }
    if let Some(instrument) = setup(|e| matches!(e, SetupError::ReferencePoint(_))) {
        let kind = instrument.kind;
        return Some(format!(
            "a second place of the {}, 100 mm or more away, and a second length of the {}",
            kind.reference_point(),
            kind.tool_point()
        ));
    }
    let minimal = "location = \"minimal\" seeks one of them only; or state what is known of one: \
                   [unknown.prior]";
    (!campaign.terms.is_empty()).then(|| minimal.to_owned())
}
