//! What differs from machine to machine of the same control: start, tool call, tool-centre point
//! and end, as text with blanks that the user can edit.

use crate::WriteError;
use minijinja::{AutoEscape, Environment, UndefinedBehavior, context};
use std::fmt;
use std::sync::Arc;
use trueaxis_nc::Control;

/// The template of each control as it comes.
pub const BUILT_IN: [(Control, &str); 5] = [
    (Control::Fanuc, include_str!("templates/fanuc.j2")),
    (Control::Haas, include_str!("templates/haas.j2")),
    (Control::LinuxCnc, include_str!("templates/linuxcnc.j2")),
    (Control::Sinumerik840d, include_str!("templates/sinumerik.j2")),
    (Control::Heidenhain, include_str!("templates/heidenhain.j2")),
];

/// The blocks that a template must have.
const BLOCKS: [&str; 5] = ["start", "tool", "tip_on", "tip_off", "end"];

/// Steps that a template may take; more is an endless loop.
const FUEL: u64 = 100_000;

/// Start, tool call, tool-centre point and end of programs.
///
/// A template is text in the language of Jinja with the blocks `start`, `tool`, `tip_on`, `tip_off`
/// and `end`; [`BUILT_IN`] shows the names that it can fill in.
#[derive(Clone)]
pub struct Templates {
    environment: Arc<Environment<'static>>,
}

impl fmt::Debug for Templates {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Templates")
    }
}

/// What the blanks are filled with.
#[derive(Debug, Clone, Default)]
pub(super) struct Values {
    pub name: String,
    pub number: String,
    pub comments: Vec<String>,
    pub machine_coordinates: bool,
    pub tolerance: String,
    pub tool: u32,
    /// The number of the length of the tool in the control, H.
    pub offset: u32,
    /// The edge of the tool, D of SINUMERIK.
    pub edge: u32,
    pub text: String,
    pub speed: String,
    pub vectors: bool,
    pub length: bool,
}

impl Templates {
    /// Those that come with a control.
    pub fn of(control: Control) -> Self {
        let text = BUILT_IN.iter().find(|(c, _)| *c == control).map_or("", |(_, text)| text);
        // why: the four texts are constants, and a test reads each of them.
        Self::parse(text).expect("the built-in templates are valid")
    }

    /// Those of the user.
    ///
    /// # Errors
    /// [`WriteError::Template`] with the line, if the text is no template or lacks a block.
    pub fn parse(text: &str) -> Result<Self, WriteError> {
        let mut environment = Environment::new();
        environment.set_undefined_behavior(UndefinedBehavior::Strict);
        environment.set_auto_escape_callback(|_| AutoEscape::None);
        environment.set_fuel(Some(FUEL));
        environment
            .add_template_owned("template".to_owned(), text.to_owned())
            .map_err(|e| WriteError::Template(shown(&e)))?;
        let templates = Self { environment: Arc::new(environment) };
        for block in BLOCKS {
            templates.render(block, &Values::default())?;
        }
        Ok(templates)
    }

    pub(super) fn render(&self, block: &str, values: &Values) -> Result<String, WriteError> {
        let values = context! {
            name => values.name.clone(),
            number => values.number.clone(),
            comments => values.comments.clone(),
            machine_coordinates => values.machine_coordinates,
            tolerance => values.tolerance.clone(),
            tool => values.tool,
            offset => values.offset,
            edge => values.edge,
            text => values.text.clone(),
            speed => values.speed.clone(),
            vectors => values.vectors,
            length => values.length,
        };
        let fault = |e: &minijinja::Error| WriteError::Template(shown(e));
        let template = self.environment.get_template("template").map_err(|e| fault(&e))?;
        let mut whole = template.render_captured(values).map_err(|e| fault(&e))?;
        whole.with_state_mut(|state| state.render_block(block)).map_err(|e| fault(&e))
    }
}

fn shown(error: &minijinja::Error) -> String {
    let what = error.detail().map_or_else(|| error.kind().to_string(), str::to_owned);
    match error.line() {
        Some(line) => format!("line {line}: {what}"),
        None => what,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_templates_are_sound() {
        for (_, text) in BUILT_IN {
            Templates::parse(text).unwrap();
        }
    }

    #[test]
    fn unusable_templates_are_reported() {
        let all = "{% block start %}{% endblock %}{% block tool %}{% endblock %}\
                   {% block tip_on %}{% endblock %}{% block tip_off %}{% endblock %}";
        let why = |text: String| Templates::parse(&text).unwrap_err().to_string();
        assert!(why(all.to_owned()).contains("end"), "{}", why(all.to_owned()));
        let endless = "{% for i in range(100000) %}{% for j in range(100000) %}x{% endfor %}\
                       {% endfor %}";
        why(format!("{all}{{% block end %}}{endless}{{% endblock %}}"));
        let unknown = format!("{all}{{% block end %}}\n{{{{ nmae }}}}{{% endblock %}}");
        assert!(why(unknown.clone()).starts_with("the template"), "{}", why(unknown));
    }
}
