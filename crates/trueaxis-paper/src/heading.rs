//! The heading of a report from a TOML file: number, date, customer, machine, instruments, logo, signatures.

use std::path::Path;
use trueaxis_condition::certificate_head::{CertificateHead, read_head};
use trueaxis_input::{Diagnostics, Files, Item, Section, SourceText};
use trueaxis_report::{Heading, Logo, LogoKind};

/// A larger picture is no logo.
const LARGEST_LOGO_BYTES: usize = 4 << 20;
/// More lines for signatures do not fit on a page.
const MOST_SIGNATURES: usize = 12;

/// Keys of `[report]` beside those of a certificate, and how they are shown.
const MORE: [(&str, &str); 3] =
    [("machine", "machine"), ("conditions", "conditions"), ("remarks", "remarks")];

/// Reads `[report]` of a file; paths in it start in its folder. Nothing with errors.
///
/// ```
/// use trueaxis_input::{Diagnostics, Files};
/// use trueaxis_paper::read_heading;
/// let text = "[report]\nnumber = \"2026-117\"\ndate = 2026-11-28\noperator = \"A. Meyer\"\n";
/// let files = Files::none().with_texts([("r.toml".into(), text.to_owned())]);
/// let mut problems = Diagnostics::new();
/// let heading = read_heading(&files, "r.toml".as_ref(), &mut problems).unwrap();
/// assert_eq!(heading.entries[0], ("number".to_owned(), "2026-117".to_owned()));
/// assert_eq!(heading.entries[1], ("operator".to_owned(), "A. Meyer".to_owned()));
/// ```
pub fn read_heading(files: &Files, path: &Path, problems: &mut Diagnostics) -> Option<Heading> {
    let text = files.text(path, "the heading of a report (TOML)", problems)?;
    let file = path.display().to_string();
    let source = SourceText::from(files, &file, &text);
    let folder = path.parent().unwrap_or(Path::new(""));
    let heading = source.read(|root| {
        let section =
            root.require("report", "[report] number = \"2026-117\", date = 2026-11-28")?;
        section.section("report", |section| read(section, folder)).flatten()
    });
    let found = source.finish();
    let usable = !found.has_errors();
    problems.append(found);
    heading.filter(|_| usable)
}

fn read(section: &Section<'_>, folder: &Path) -> Option<Heading> {
    let more: Vec<_> = MORE
        .into_iter()
        .filter_map(|(key, name)| Some((name.to_owned(), section.text(key)?.to_owned())))
        .collect();
    let logo = section.get("logo").and_then(|item| read_logo(&item, folder));
    let signatures = section.get("signatures").map(|item| signatures(&item)).unwrap_or_default();
    let head = read_head(section)?;
    let table = (!head.instruments.is_empty()).then(|| head.instrument_table());
    let entries = entries(&head).chain(more).collect();
    Some(Heading { number: head.number, entries, table, logo, signatures })
}

fn entries(head: &CertificateHead) -> impl Iterator<Item = (String, String)> {
    head.entries().map(|(name, value)| (name.to_owned(), value.to_owned()))
}

fn read_logo(item: &Item<'_>, folder: &Path) -> Option<Logo> {
    let path = folder.join(item.text()?);
    let bytes = match item.files().read(&path) {
        Ok(bytes) => bytes,
        Err(why) => {
            let message = format!("the logo `{}` cannot be read: {why}", path.display());
            item.error("unreadable-file", message, "name an SVG, PNG or JPEG file beside this one");
            return None;
        }
    };
    let kind = LogoKind::of(&bytes).filter(|_| bytes.len() <= LARGEST_LOGO_BYTES);
    if kind.is_none() {
        let message =
            format!("the logo `{}` is not a whole picture of up to 4 MiB", path.display());
        item.error("bad-logo", message, "name an SVG, PNG or JPEG file");
    }
    Some(Logo { bytes, kind: kind? })
}

fn signatures(item: &Item<'_>) -> Vec<String> {
    let lines = item.list().unwrap_or_default();
    if lines.len() > MOST_SIGNATURES {
        let message = format!("{} signatures: a report has up to {MOST_SIGNATURES}", lines.len());
        item.error("bad-count", message, "signatures = [\"measured\", \"approved\"]");
    }
    lines.iter().filter_map(Item::text).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> (Option<Heading>, Vec<&'static str>) {
        let logo = ("logo.svg".into(), "<?xml version='1.0'?>\n<svg/>".to_owned());
        let cut = ("cut.svg".into(), "<svg><path d='M0 0".to_owned());
        let files = Files::none().with_texts([("r.toml".into(), text.to_owned()), logo, cut]);
        let mut problems = Diagnostics::new();
        let heading = read_heading(&files, "r.toml".as_ref(), &mut problems);
        (heading, problems.iter().map(|d| d.code).collect())
    }

    const HEAD: &str = "[report]\nnumber = '7'\ndate = '28.11.2026'\n";

    #[test]
    fn all_keys_are_shown_in_their_order() {
        let rest = "customer = 'C'\nmachine = 'M'\nmachine_serial = '12'\noperator = 'O'\nplace = 'P'\n\
             conditions = '20.1 degC'\nlogo = 'logo.svg'\nsignatures = ['measured', 'approved']\n\
             [[report.instrument]]\nname = 'laser'\ncertificate = 'K1'\ncalibrated = 2026-01-02\n";
        let (heading, found) = read_text(&format!("{HEAD}{rest}"));
        let heading = heading.unwrap();
        let names: Vec<_> = heading.entries.iter().map(|(name, _)| name.as_str()).collect();
        let order = ["number", "customer", "serial number of the machine", "operator", "place"];
        assert_eq!(names[..5], order);
        assert_eq!(names[5..], ["date", "machine", "conditions"]);
        assert_eq!(heading.signatures, ["measured", "approved"]);
        assert_eq!(heading.logo.unwrap().kind, LogoKind::Svg);
        assert_eq!(heading.table.unwrap().rows.len(), 1);
        assert!(found.is_empty(), "{found:?}");
    }

    #[test]
    fn mistakes_are_named() {
        let code = |rest: &str| read_text(&format!("{HEAD}{rest}")).1;
        assert_eq!(code("logo = 'no.svg'"), ["unreadable-file"]);
        assert_eq!(code("logo = 'r.toml'"), ["bad-logo"]);
        assert_eq!(code("logo = 'cut.svg'"), ["bad-logo"]);
        assert_eq!(code("signatures = 'me'"), ["wrong-type"]);
        assert_eq!(code("custommer = 'me'"), ["unknown-key"]);
        assert_eq!(read_text("").1, ["missing-key"]);
        assert_eq!(read_text("[report]\nnumber = '1'\ndate = '31.02.2026'\n").1, ["bad-date"]);
    }
}
