//! Mitsuba's scene files: elements with an indent, and values as it writes them.

use glam::{Affine3A, DVec3};

/// A scene file while it is written.
#[derive(Debug, Default)]
pub struct Xml {
    text: String,
    open: Vec<&'static str>,
}

impl Xml {
    /// Opens an element.
    pub fn open(&mut self, name: &'static str, attributes: &[(&str, &str)]) {
        self.element(name, attributes, ">");
        self.open.push(name);
    }

    /// Closes the element that was opened last.
    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.indent();
            self.text.push_str(&format!("</{name}>\n"));
        }
    }

    /// An element without content.
    pub fn empty(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.element(name, attributes, "/>");
    }

    /// A named value, such as `<float name="fov" value="40"/>`.
    pub fn value(&mut self, kind: &str, name: &str, value: &str) {
        self.empty(kind, &[("name", name), ("value", value)]);
    }

    /// A named number.
    pub fn number(&mut self, name: &str, value: f64) {
        self.value("float", name, &short(value));
    }

    /// A named colour, linear Rec. 709.
    pub fn color(&mut self, name: &str, color: DVec3) {
        self.value("rgb", name, &list(&color.to_array()));
    }

    /// A named point.
    pub fn point(&mut self, name: &str, point: DVec3) {
        let [x, y, z] = point.to_array().map(short);
        self.empty("point", &[("name", name), ("x", &x), ("y", &y), ("z", &z)]);
    }

    /// A line for people.
    pub fn comment(&mut self, text: &str) {
        self.indent();
        // Two dashes would end it.
        self.text
            .push_str(&format!("<!-- {} -->\n", text.replace("--", "- -")));
    }

    /// A transform by its matrix.
    pub fn transform(&mut self, matrix: &Affine3A) {
        let m = matrix.matrix3;
        let t = matrix.translation;
        let rows = [
            [m.x_axis.x, m.y_axis.x, m.z_axis.x, t.x],
            [m.x_axis.y, m.y_axis.y, m.z_axis.y, t.y],
            [m.x_axis.z, m.y_axis.z, m.z_axis.z, t.z],
            [0.0, 0.0, 0.0, 1.0],
        ];
        let values = list(
            &rows
                .as_flattened()
                .iter()
                .map(|&v| v.into())
                .collect::<Vec<f64>>(),
        );
        self.open("transform", &[("name", "to_world")]);
        self.empty("matrix", &[("value", &values)]);
        self.close();
    }

    /// A transform that stands at one point and looks at another.
    pub fn look_at(&mut self, origin: DVec3, target: DVec3, up: DVec3) {
        self.open("transform", &[("name", "to_world")]);
        let [origin, target, up] = [origin, target, up].map(|v| list(&v.to_array()));
        let attributes = [("origin", &*origin), ("target", &*target), ("up", &*up)];
        self.empty("lookat", &attributes);
        self.close();
    }

    /// The text, with all elements closed.
    pub fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    fn element(&mut self, name: &str, attributes: &[(&str, &str)], end: &str) {
        self.indent();
        self.text.push_str(&format!("<{name}"));
        for (name, value) in attributes {
            self.text
                .push_str(&format!(" {name}=\"{}\"", escaped(value)));
        }
        self.text.push_str(end);
        self.text.push('\n');
    }

    fn indent(&mut self) {
        self.text.push_str(&"    ".repeat(self.open.len()));
    }
}

/// A number as single precision has it, which is what Mitsuba reads.
pub fn short(value: f64) -> String {
    (value as f32).to_string()
}

fn list(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().copied().map(short).collect();
    values.join(" ")
}

/// A value of an attribute (XML 1.0, section 2.4).
fn escaped(value: &str) -> String {
    let mut escaped = String::with_capacity(value.len());
    for character in value.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' => escaped.push_str("&quot;"),
            character if character.is_control() => escaped.push(' '),
            character => escaped.push(character),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_nest_and_values_are_escaped() {
        let mut xml = Xml::default();
        xml.open("scene", &[("version", "3.0.0")]);
        xml.value("string", "name", "a \"b\" & <c>\n");
        xml.comment("two -- dashes");
        xml.open("bsdf", &[("type", "diffuse")]);
        xml.color("reflectance", DVec3::new(0.5, 1.0, 0.25));
        assert_eq!(
            xml.finish(),
            "<scene version=\"3.0.0\">
    <string name=\"name\" value=\"a &quot;b&quot; &amp; &lt;c> \"/>
    <!-- two - - dashes -->
    <bsdf type=\"diffuse\">
        <rgb name=\"reflectance\" value=\"0.5 1 0.25\"/>
    </bsdf>
</scene>
"
        );
    }
}
