//! The cases of a study: `study = "FILE"`, or several in `[case]`.

use crate::cases::{Case, Output, Product, State};
use crate::inputs::{Input, Varied, influence_name};
use std::path::Path;
use trueaxis::input::{Diagnostics, Section, Severity};
use trueaxis::machine::Machine;
use trueaxis::machine::axis::AxisKind;
use trueaxis::machine::errors::Influence;
use trueaxis::machine::heat::Conditions;
use trueaxis::predict::drawing::{LinearPart, PartStudy, is_part_study, read_part_study};
use trueaxis::predict::holes::{Applied, HoleStudy, is_hole_study, read_hole_study};
use trueaxis::predict::{Setting, Study, read_study};

/// What a case names, as it was read.
enum Kind {
    Piece(Box<Study>),
    Holes(Box<HoleStudy>),
    Part(Box<PartStudy>),
}

/// A case before the inputs are in its machine.
pub(super) struct Named {
    name: String,
    file: String,
    kind: Kind,
}

/// The cases that a study names.
pub(super) fn named_cases(root: &Section<'_>, folder: &Path) -> Option<Vec<Named>> {
    let one = root.get("study");
    let many = root.get("case");
    if one.is_some() == many.is_some() {
        let message = "the study says not what every machine makes".to_owned();
        let hint = "study = \"nas979.toml\" (as for `predict`), or several: [case] \"upright\" = \"a.toml\"";
        root.error("one-study", message, hint);
        return None;
    }
    let named: Vec<(String, String)> = match (one, many) {
        (Some(item), _) => {
            let file = item.text()?;
            vec![(file.to_owned(), file.to_owned())]
        }
        (_, Some(item)) => item.section("case", |s| {
            let file = |(key, _, item): &(&str, _, trueaxis::input::Item<'_>)| {
                Some(((*key).to_owned(), item.text()?.to_owned()))
            };
            s.entries().iter().map(file).collect::<Option<Vec<_>>>()
        })??,
        _ => return None,
    };
    if named.is_empty() {
        root.error("bad-count", "no case is named".to_owned(), "[case] \"upright\" = \"a.toml\"");
        return None;
    }
    let read = |(name, file): (String, String)| {
        let kind = read_kind(root, &folder.join(&file))?;
        Some(Named { name, file, kind })
    };
    // All of them are read, so that all problems are reported.
    let all: Vec<Option<Named>> = named.into_iter().map(read).collect();
    all.into_iter().collect()
}

fn read_kind(root: &Section<'_>, path: &Path) -> Option<Kind> {
    let files = root.files();
    let mut problems = Diagnostics::new();
    let kind = if is_hole_study(files, path) {
        problems.keep(read_hole_study(files, path)).map(|s| Kind::Holes(Box::new(s)))
    } else if is_part_study(files, path) {
        problems.keep(read_part_study(files, path)).map(|s| Kind::Part(Box::new(s)))
    } else {
        problems.keep(read_study(files, path)).map(|s| Kind::Piece(Box::new(s)))
    };
    root.take_over(problems);
    kind
}

impl Named {
    /// Its machine.
    pub fn machine(&self) -> &Machine {
        match &self.kind {
            Kind::Piece(study) => &study.machine,
            Kind::Holes(study) => &study.machine,
            Kind::Part(study) => &study.mounted,
        }
    }

    /// Whether the machine knows the sensors that are varied, and all that it needs.
    fn check_sensors(&self, root: &Section<'_>, inputs: &[Input]) -> Option<()> {
        let Some(conditions) = mean_conditions(inputs) else { return Some(()) };
        let mut problems = Diagnostics::new();
        let warm = self.machine().at(&conditions, &mut problems);
        let wrong = problems.iter().find(|d| d.severity == Severity::Error);
        if let Some(wrong) = wrong {
            root.error(wrong.code, format!("`{}`: {}", self.name, wrong.message), &wrong.hint);
            return None;
        }
        if warm?.unknown_growth(&conditions).is_some() {
            let message = format!(
                "`{}`: the temperature of the workpiece is not varied, and what its study says of temperatures does not hold here",
                self.name
            );
            let hint = "[[input]] temperature = \"workpiece\", value = { uniform = [\"19 degC\", \"21 degC\"] }";
            root.error("no-workpiece-temperature", message, hint);
            return None;
        }
        Some(())
    }

    /// The case with the inputs in its machine.
    pub fn with(self, root: &Section<'_>, inputs: &[Input]) -> Option<Case> {
        self.refuse_what_cannot_vary(root, inputs)?;
        self.check_sensors(root, inputs)?;
        let put = |machine: &Machine| match with_inputs(machine, inputs) {
            Ok(machine) => Some(machine),
            Err((input, why)) => {
                let message = format!("`{}` cannot be put into `{}`: {why}", input, self.name);
                root.error("no-such-error", message, "errors that the machine of every case has");
                None
            }
        };
        let known = self.machine().clone();
        let product = match self.kind {
            Kind::Piece(mut study) => {
                study.machine = put(&study.machine)?;
                Product::Piece(study)
            }
            Kind::Holes(mut study) => {
                study.machine = put(&study.machine)?;
                Product::Holes(study)
            }
            Kind::Part(mut study) => {
                study.job.machine = put(&study.job.machine)?;
                study.mounted = study.job.setup.mounted(&study.job.machine);
                let mut problems = Diagnostics::new();
                let linear = LinearPart::new(&study, &mut problems);
                root.take_over(problems);
                Product::Part(Box::new((*study, linear?)))
            }
        };
        let outputs = outputs(&product);
        let (name, file) = (self.name, self.file);
        Some(Case { name, file, product, known, input_of: Vec::new(), outputs })
    }

    fn refuse_what_cannot_vary(&self, root: &Section<'_>, inputs: &[Input]) -> Option<()> {
        let refuse = |message: String, hint: &str| {
            root.error("cannot-vary", message, hint);
            None
        };
        for input in inputs.iter().filter(|i| i.changes_state()) {
            let (what, case) = (&input.name, &self.name);
            let heats = matches!(input.varied, Varied::Temperatures(_) | Varied::Log(_));
            match &self.kind {
                Kind::Part(_) => {
                    let message = format!(
                        "`{what}` cannot be varied for the part `{case}`: it is cut once, and follows errors"
                    );
                    return refuse(message, "errors of the machine; or a case for each set-up");
                }
                Kind::Holes(_) if !heats => {
                    let message = format!("`{what}` cannot be varied for the holes `{case}`");
                    return refuse(message, "errors and temperatures; or a case for each place");
                }
                Kind::Piece(study) if !heats && study.program.is_some() => {
                    let message =
                        format!("`{case}` is cut by a program, which would not follow `{what}`");
                    return refuse(
                        message,
                        "leave `program` out of its study: the ideal path follows",
                    );
                }
                Kind::Piece(study) if !sets(study, input) => {
                    let message = format!(
                        "`{what}` changes nothing in `{case}`: its zero is perfect, or there is no such rotary axis"
                    );
                    return refuse(
                        message,
                        "the letter of a rotary axis; [setting] without perfect = true",
                    );
                }
                Kind::Piece(study) if heats && study.temperatures.is_some() => {
                    let message = format!(
                        "`{case}` follows a log of temperatures, and `{what}` states others"
                    );
                    return refuse(message, "leave one of them out");
                }
                Kind::Holes(study) if study.temperatures.is_some() => {
                    let message = format!(
                        "`{case}` follows a log of temperatures, and `{what}` states others"
                    );
                    return refuse(message, "leave one of them out");
                }
                _ => {}
            }
        }
        match &self.kind {
            Kind::Holes(study) if study.applied == Applied::Acted => {
                let message = format!(
                    "`{}` has a record of what acted: that is one part, which is made",
                    self.name
                );
                refuse(message, "[compensation] applied = \"comprehensive\"")
            }
            Kind::Holes(study) if study.temperatures.is_some() => {
                let message = format!("the holes of `{}` follow a log of temperatures", self.name);
                refuse(
                    message,
                    "state the temperatures in [temperature]; or [[input]] log = \"hall.csv\"",
                )
            }
            Kind::Piece(study) if study.servo.is_some() => {
                let message =
                    format!("`{}` has [servo]: a study of many machines has no feeds", self.name);
                refuse(message, "leave [servo] out")
            }
            _ => Some(()),
        }
    }
}

/// Whether an input that varies how the zero is touched can do so.
fn sets(study: &Study, input: &Input) -> bool {
    let Varied::Setting(axis) = input.varied else { return true };
    let machine = &study.machine;
    let is_rotary = |i: usize| machine.axes()[i].kind == AxisKind::Rotary;
    study.reference.setting != Setting::Perfect && machine.axis_index(axis).is_some_and(is_rotary)
}

/// The temperatures in the middle of what is drawn; none if none are.
fn mean_conditions(inputs: &[Input]) -> Option<Conditions> {
    let mut conditions = None;
    for input in inputs {
        if let Varied::Log(log) = &input.varied {
            conditions = log.at(input.distribution.mean());
        }
    }
    for input in inputs {
        let Varied::Temperatures(sensors) = &input.varied else { continue };
        for sensor in sensors {
            let celsius = input.distribution.mean();
            conditions = Some(conditions.take().unwrap_or_default().with_reading(sensor, celsius));
        }
    }
    conditions
}

/// A machine with the means of all inputs, and what each of them adds.
fn with_inputs(machine: &Machine, inputs: &[Input]) -> Result<Machine, (String, String)> {
    let mut machine = machine.clone();
    let mut influences: Vec<Influence> = Vec::new();
    // Values first: a factor acts on what is stated then, and what is added is not multiplied.
    let order = |input: &&Input| match input.varied {
        Varied::Value(_) => 0,
        Varied::Scale(_) => 1,
        _ => 2,
    };
    let mut ordered: Vec<&Input> = inputs.iter().collect();
    ordered.sort_by_key(order);
    for input in ordered {
        let (next, influence) = input.put(machine).map_err(|why| (input.name.clone(), why))?;
        machine = next;
        influences.extend(influence);
    }
    Ok(machine.with_influences(influences))
}

impl Case {
    /// Its machine at the temperatures that are varied: what grows then is uncertain, too.
    pub(super) fn warm(&self, inputs: &[Input]) -> Machine {
        let state = State { conditions: mean_conditions(inputs), ..State::default() };
        // Whether it can be so warm was checked before.
        self.machine_at(&state).unwrap_or_else(|_| self.machine().clone())
    }

    /// Connects the uncertain quantities of its machine with the inputs.
    pub(super) fn connect(&mut self, inputs: &[Input]) {
        let input = |quantity: &String| {
            inputs.iter().position(|input| match &input.varied {
                Varied::Stated(name) => name == quantity,
                _ => influence_name(&input.name) == *quantity,
            })
        };
        self.input_of = self.warm(inputs).uncertain_quantities().iter().map(input).collect();
    }
}

/// What is found of a product.
fn outputs(product: &Product) -> Vec<Output> {
    let output = |at: usize, key: &str, title: &str, (low_mm, high_mm)| Output {
        key: key.to_owned(),
        title: title.to_owned(),
        low_mm,
        high_mm,
        at,
    };
    match product {
        Product::Piece(study) => {
            let names = study.piece().index_names().iter().enumerate();
            let of = |(at, name): (usize, &trueaxis::part::testpiece::IndexName)| {
                output(at, name.key, name.title(), (None, study.tolerances.limit_mm(name.key)))
            };
            names.map(of).collect()
        }
        Product::Holes(study) => {
            let worst = output(0, "worst_hole_mm", "worst hole", (None, study.tolerance_mm));
            let either = (study.location_tolerance_mm.map(|t| -t), study.location_tolerance_mm);
            let circle = output(1, "location_diameter_mm", "location diameter", either);
            match study.holes_mm.len() {
                0..3 => vec![worst],
                _ => vec![worst, circle],
            }
        }
        Product::Part(part) => {
            let all = part.1.part.characteristics.iter().enumerate();
            all.map(|(at, asked)| {
                let (low, high) = asked.limits.ends_mm();
                output(at, &format!("{}_mm", asked.name), &asked.name, (low, Some(high)))
            })
            .collect()
        }
    }
}
