//! Elements of XML as text.

use trueaxis_geometry::Vec3;

/// A document that is being written.
pub(super) struct Xml {
    pub text: String,
    open: Vec<String>,
}

impl Xml {
    /// The content of a root element.
    pub fn new() -> Self {
        Self { text: String::new(), open: Vec::new() }
    }

    fn begin(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.text += &"  ".repeat(self.open.len() + 1);
        self.text += &format!("<{name}");
        for (key, value) in attributes {
            self.text += &format!(" {key}=\"{}\"", escaped(value));
        }
    }

    pub fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.begin(name, attributes);
        self.text += ">\n";
        self.open.push(name.to_owned());
    }

    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.text += &format!("{}</{name}>\n", "  ".repeat(self.open.len() + 1));
        }
    }

    /// An element with a text alone.
    pub fn leaf(&mut self, name: &str, attributes: &[(&str, &str)], text: &str) {
        self.begin(name, attributes);
        self.text += &match text.is_empty() {
            true => "/>\n".to_owned(),
            false => format!(">{}</{name}>\n", escaped(text)),
        };
    }

    pub fn id(&mut self, name: &str, id: usize) {
        self.leaf(name, &[], &id.to_string());
    }

    /// A list of references.
    pub fn ids(&mut self, name: &str, ids: &[usize]) {
        self.open(name, &[("n", &ids.len().to_string())]);
        for id in ids {
            self.id("Id", *id);
        }
        self.close();
    }

    pub fn decimal(&mut self, name: &str, value: f64) {
        self.leaf(name, &[], &decimal(value));
    }

    pub fn vector(&mut self, name: &str, vector: &Vec3) {
        self.leaf(name, &[], &vector_text(vector));
    }

    /// A text for which QIF has no place of its own.
    pub fn attribute(&mut self, name: &str, value: &str) {
        self.open("Attributes", &[("n", "1")]);
        self.leaf("AttributeStr", &[("name", name), ("value", value)], "");
        self.close();
    }
}

/// A number for a type `decimal`, which has no exponent and of which a reader need not take more than 18 digits: to 1 fm and 1 prad.
pub(super) fn decimal(value: f64) -> String {
    let text = format!("{value:.12}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Places and directions have the type `double` and are written in full.
fn vector_text(vector: &Vec3) -> String {
    // The sum has no negative zero.
    let words: Vec<String> = vector.iter().map(|c| (c + 0.0).to_string()).collect();
    words.join(" ")
}

/// What XML has a meaning for is escaped. What it has no place for becomes a space: control characters, and ends of lines, which a
/// reader would turn into spaces anyway.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_texts_by_hand() {
        assert_eq!(
            [30.0042, -0.01, 0.0, -1e-15, 1e-12].map(decimal),
            ["30.0042", "-0.01", "0", "0", "0.000000000001"]
        );
        assert_eq!(vector_text(&Vec3::new(-0.0, 0.1, -2.0)), "0 0.1 -2");
        assert_eq!(escaped("a<b & \"ü\"\n]]>"), "a&lt;b &amp; &quot;ü&quot; ]]&gt;");
    }
}
