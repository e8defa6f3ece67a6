//! Writing HTML and SVG with everything escaped.

/// Attributes of an element.
pub type Attributes<'a> = &'a [(&'a str, &'a str)];

/// Builds a document. Text and attribute values are always escaped; only [`Writer::constant`]
/// takes markup, and only text that was compiled in.
#[derive(Default)]
pub struct Writer {
    out: String,
}

impl Writer {
    /// An element with content.
    pub fn element(&mut self, tag: &str, attributes: Attributes, content: impl FnOnce(&mut Self)) {
        self.start(tag, attributes);
        content(self);
        self.end(tag);
    }

    /// An element with plain text.
    pub fn leaf(&mut self, tag: &str, attributes: Attributes, text: &str) {
        self.element(tag, attributes, |w| w.text(text));
    }

    /// An element that HTML knows to be empty, such as `img` or `meta`.
    pub fn void(&mut self, tag: &str, attributes: Attributes) {
        self.start(tag, attributes);
    }

    /// Text, escaped.
    pub fn text(&mut self, text: &str) {
        for c in text.chars() {
            match c {
                '&' => self.out.push_str("&amp;"),
                '<' => self.out.push_str("&lt;"),
                '>' => self.out.push_str("&gt;"),
                '"' => self.out.push_str("&quot;"),
                '\'' => self.out.push_str("&#39;"),
                // HTML allows no other control characters, not even escaped.
                '\t' | '\n' => self.out.push(c),
                c if c.is_control() => self.out.push('\u{FFFD}'),
                c => self.out.push(c),
            }
        }
    }

    /// Markup, style or script that is part of the program.
    pub fn constant(&mut self, markup: &'static str) {
        self.out.push_str(markup);
    }

    /// A drawing that another writer finished, and which is escaped already.
    pub(crate) fn drawing(&mut self, svg: &str) {
        self.out.push_str(svg);
    }

    /// The document so far.
    pub fn finish(self) -> String {
        self.out
    }

    fn start(&mut self, tag: &str, attributes: Attributes) {
        self.out.push('<');
        self.out.push_str(tag);
        for (name, value) in attributes {
            self.out.push(' ');
            self.out.push_str(name);
            self.out.push_str("=\"");
            self.text(value);
            self.out.push('"');
        }
        self.out.push('>');
    }

    fn end(&mut self, tag: &str) {
        self.out.push_str("</");
        self.out.push_str(tag);
        self.out.push('>');
        // A line end after blocks keeps the source readable and changes no layout.
        if !matches!(
            tag,
            "a" | "b" | "code" | "span" | "strong" | "text" | "tspan" | "small"
        ) {
            self.out.push('\n');
        }
    }
}

/// A picture as a `data:` address of a PNG file (RFC 2397, base 64 of RFC 4648).
pub fn data_uri(png: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut uri = String::with_capacity(22 + png.len().div_ceil(3) * 4);
    uri.push_str("data:image/png;base64,");
    for chunk in png.chunks(3) {
        let byte = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            if digit <= chunk.len() {
                uri.push(char::from(DIGITS[(bits >> (18 - 6 * digit) & 63) as usize]));
            } else {
                uri.push('=');
            }
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_escaped() {
        let mut w = Writer::default();
        let hostile = "<script>alert('1\"&')</script>\u{0}";
        w.leaf("p", &[("title", hostile)], hostile);
        let text = w.finish();
        assert_eq!(text.matches('<').count(), 2, "{text}");
        assert!(text.contains("&lt;script&gt;alert(&#39;1&quot;&amp;&#39;)"));
        assert!(!text.contains('\u{0}'));
    }

    #[test]
    fn base64_of_the_rfc() {
        // RFC 4648, section 10.
        for (plain, coded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(
                data_uri(plain.as_bytes()),
                format!("data:image/png;base64,{coded}")
            );
        }
    }
}
