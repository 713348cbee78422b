//! What is written after identification holds at the temperature of the error table in whose place it stands: the scale of
//! the machine grows from there (docs/model.md eq. 81).

mod library;

use library::{disk, root};
use trueaxis_calibrate::identify::errors::identify;
use trueaxis_calibrate::identify::machine_file::{MachineFile, machine_file};
use trueaxis_calibrate::identify::predictor_file::predictor_file;
use trueaxis_calibrate::identify::records::{Options, Records};
use trueaxis_input::Diagnostics;
use trueaxis_machine::Machine;
use trueaxis_machine::file::Tables;
use trueaxis_measure::measure::virtual_campaign::{measure, read_virtual};
use trueaxis_measure::measure::{Campaign, Readings, read_campaign};
use trueaxis_measure::unknowns::design::Design;

const COVARIANCE: &str = "covariance.toml";
/// The scales are at 30.5 and 31.2 °C.
const CAMPAIGN: &str = r#"
name = "laser on the gantry"
machine = "gantry.toml"
[temperature]
scale_x = "30.5 degC"
scale_y = "31.2 degC"
scale_z = "30.5 degC"
workpiece = "30.5 degC"
[unknown.motion]
EXX = "polynomial 1-6 + reversal"
EYY = "polynomial 1-6 + reversal"
[instrument.laser-x]
kind = "laser-line"
direction = "1 0 0"
noise = "0.5 um"
reads = "deviation"
[instrument.laser-y]
kind = "laser-line"
direction = "0 1 0"
noise = "0.5 um"
reads = "deviation"
[[path]]
name = "X"
kind = "targets"
instrument = "laser-x"
axis = "X"
from = "10 mm"
to = "3490 mm"
count = 11
runs = 3
[[path]]
name = "Y"
kind = "targets"
instrument = "laser-y"
axis = "Y"
from = "10 mm"
to = "2290 mm"
count = 11
runs = 3
"#;

/// The tables of a machine file that was made, and those beside the old one.
struct Beside(Vec<(String, String)>);

impl Tables for Beside {
    fn text(&self, name: &str) -> Result<String, String> {
        match self.0.iter().find(|(made, _)| made == name) {
            Some((_, text)) => Ok(text.clone()),
            None => {
                let path = root().join("machines/gantry-001").join(name);
                std::fs::read_to_string(path).map_err(|error| error.to_string())
            }
        }
    }
}

/// The machine of a new file under the conditions of the campaign.
fn warm(campaign: &Campaign, made: &MachineFile, covariance: &str) -> Machine {
    let mut tables = made.tables.clone();
    tables.push((COVARIANCE.to_owned(), covariance.to_owned()));
    let (machine, problems) = Machine::check("new.toml", &made.text, &Beside(tables));
    let machine = machine.unwrap_or_else(|| panic!("{problems:?}\n{}", made.text));
    let conditions = campaign.conditions.as_ref().expect("temperatures");
    let mut problems = Diagnostics::new();
    let warm = machine.at(conditions, &mut problems);
    warm.unwrap_or_else(|| panic!("{problems:?}\n{}", made.text))
}

/// Both predict every reading alike: the design with its values, and the machine of a file with the set-ups.
fn same(readings: &Readings, (design, values): (&Design, &[f64]), machine: &Machine) {
    let again = Design::new(machine, Vec::new(), design.instruments.clone());
    let setups = &values[design.terms.len()..];
    for i in 0..readings.len() {
        let due = design.read(readings, i, values).expect("on the travel");
        let read = again.read(readings, i, setups).expect("on the travel");
        let apart = due.iter().zip(read).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        assert!(apart < 1e-6, "{:?}: {apart} mm", readings.commands[i]);
    }
}

/// The table of Y states its temperature where it stands or, here, with the scale.
fn gantry(celsius: f64, with_the_scale: bool) -> String {
    let path = root().join("machines/gantry-001/machine.toml");
    let text = std::fs::read_to_string(path).expect("the gantry");
    let text = text.replace("28.4 degC\" }", &format!("{celsius} degC\" }}"));
    if !with_the_scale {
        return text;
    }
    text.replace(", temperature = \"29.3 degC\"", "")
        .replace("sensors = { scale_y", "table_temperature = \"29.3 degC\"\nsensors = { scale_y")
}

#[test]
fn law_the_written_machine_predicts_what_the_fit_predicts_whatever_the_temperature_of_the_table() {
    let folder = root().join("machines/gantry-001");
    let path = folder.join("laser.toml");
    for (celsius, with_the_scale) in [(28.4, false), (20.0, true), (33.25, true)] {
        let old = gantry(celsius, with_the_scale);
        let texts =
            [(path.clone(), CAMPAIGN.to_owned()), (folder.join("gantry.toml"), old.clone())];
        let files = disk().with_texts(texts);
        let (read, _) = read_campaign(&files, &path, |root, c| read_virtual(root, c, Some(7)));
        let (campaign, real) = read.expect("a campaign");
        let readings = measure(&campaign, &real).expect("readings").readings;
        let records = Records::bare(readings.clone());
        let options = Options { predicts: true, scores: false, ..Options::default() };
        let mut problems = Diagnostics::new();
        let found = identify(&campaign, &options, &records, &mut problems);
        let found = found.unwrap_or_else(|| panic!("{problems:?}"));
        let beside = Beside(Vec::new());

        let made = machine_file(&campaign, &found, None, &old, &beside).expect("a machine file");
        let machine = warm(&campaign, &made, "");
        same(&readings, (&found.design, found.fit.values.as_slice()), &machine);

        let predictor = found.adequacy.predictor.as_ref().expect("a prediction");
        let names = (old.as_str(), COVARIANCE);
        let made = predictor_file((&campaign, &found), (&records, None), names, &beside);
        let made = made.unwrap_or_else(|reason| panic!("{reason}"));
        let machine = warm(&campaign, &made.machine, &made.covariance);
        same(&readings, (&predictor.design, predictor.values.as_slice()), &machine);
    }
}
