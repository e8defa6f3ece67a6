//! The parts of a text that are shown in colours of their own: of Rhai and of WGSL.
//!
//! This is no parser. It tells words, numbers, texts and comments apart, also in files with
//! mistakes, and so fast that a file is read anew at each letter that is typed.

use std::ops::Range;

/// What a part of a text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Nothing special.
    Plain,
    /// A word of the language.
    Keyword,
    /// A type.
    Type,
    /// A name that is called.
    Call,
    /// A number, or true and false.
    Number,
    /// A text in quotes.
    Text,
    /// A remark for people.
    Comment,
    /// An attribute, or a directive of the composer of shaders.
    Directive,
}

/// What a file is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// Scripts.
    Rhai,
    /// Shaders.
    Wgsl,
    /// Anything else, which has no colours.
    Other,
}

impl Language {
    /// By the end of a file's name.
    pub fn of(path: &str) -> Self {
        match path.rsplit_once('.') {
            Some((_, "rhai")) => Self::Rhai,
            Some((_, "wgsl")) => Self::Wgsl,
            _ => Self::Other,
        }
    }

    /// What a comment to the end of the line begins with.
    pub fn comment(self) -> &'static str {
        match self {
            Self::Rhai | Self::Wgsl => "//",
            Self::Other => "#",
        }
    }
}

// The Rhai Book, "Keywords".
const RHAI_KEYWORDS: [&str; 29] = [
    "as",
    "break",
    "catch",
    "const",
    "continue",
    "do",
    "else",
    "export",
    "fn",
    "for",
    "global",
    "if",
    "import",
    "in",
    "is_shared",
    "let",
    "loop",
    "new",
    "private",
    "return",
    "static",
    "switch",
    "this",
    "throw",
    "try",
    "until",
    "var",
    "while",
    "with",
];

// WGSL (W3C), sections "Keyword Summary" and "Predeclared Types".
const WGSL_KEYWORDS: [&str; 27] = [
    "alias",
    "break",
    "case",
    "const",
    "const_assert",
    "continue",
    "continuing",
    "default",
    "diagnostic",
    "discard",
    "else",
    "enable",
    "fn",
    "for",
    "if",
    "let",
    "loop",
    "override",
    "requires",
    "return",
    "struct",
    "switch",
    "var",
    "while",
    "function",
    "private",
    "workgroup",
];

const WGSL_TYPES: [&str; 13] = [
    "array",
    "atomic",
    "bool",
    "f16",
    "f32",
    "i32",
    "ptr",
    "sampler",
    "sampler_comparison",
    "u32",
    "storage",
    "uniform",
    "binding_array",
];

/// Calls `tell` for each part of the text, in order and without gaps.
pub fn read(language: Language, text: &str, tell: &mut impl FnMut(Range<usize>, Kind)) {
    if language == Language::Other {
        tell(0..text.len(), Kind::Plain);
        return;
    }
    let mut reader = Reader {
        language,
        text,
        bytes: text.as_bytes(),
        at: 0,
    };
    let mut plain = 0;
    while reader.at < text.len() {
        let start = reader.at;
        let kind = reader.next();
        if kind == Kind::Plain {
            continue;
        }
        if plain < start {
            tell(plain..start, Kind::Plain);
        }
        tell(start..reader.at, kind);
        plain = reader.at;
    }
    if plain < text.len() {
        tell(plain..text.len(), Kind::Plain);
    }
}

struct Reader<'a> {
    language: Language,
    text: &'a str,
    bytes: &'a [u8],
    at: usize,
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

impl Reader<'_> {
    fn peek(&self, ahead: usize) -> u8 {
        self.bytes.get(self.at + ahead).copied().unwrap_or(0)
    }

    fn skip_while(&mut self, fits: impl Fn(u8) -> bool) {
        while self.bytes.get(self.at).is_some_and(|byte| fits(*byte)) {
            self.at += 1;
        }
    }

    /// Reads one part and says what it is.
    fn next(&mut self) -> Kind {
        match (self.peek(0), self.peek(1)) {
            (b'/', b'/') => {
                self.skip_while(|byte| byte != b'\n');
                Kind::Comment
            }
            (b'/', b'*') => self.block_comment(),
            (b'"', _) if self.language == Language::Rhai => self.quoted(b'"'),
            (b'\'', _) if self.language == Language::Rhai => self.quoted(b'\''),
            (b'`', _) if self.language == Language::Rhai => self.template(),
            (b'#', b'"' | b'#') if self.language == Language::Rhai => self.raw_text(),
            (b'@' | b'#', next) if self.language == Language::Wgsl && is_word(next) => {
                self.at += 1;
                self.skip_while(is_word);
                Kind::Directive
            }
            (b'0'..=b'9', _) => self.number(),
            (byte, _) if is_word(byte) => self.word(),
            _ => {
                self.at += 1;
                Kind::Plain
            }
        }
    }

    /// Block comments are nested in both languages.
    fn block_comment(&mut self) -> Kind {
        let mut depth = 0;
        while self.at < self.bytes.len() {
            match (self.peek(0), self.peek(1)) {
                (b'/', b'*') => {
                    depth += 1;
                    self.at += 2;
                }
                (b'*', b'/') => {
                    depth -= 1;
                    self.at += 2;
                    if depth == 0 {
                        break;
                    }
                }
                _ => self.at += 1,
            }
        }
        self.at = self.at.min(self.bytes.len());
        Kind::Comment
    }

    /// To the quote, or to the end of the line where it is missing.
    fn quoted(&mut self, quote: u8) -> Kind {
        self.at += 1;
        while self.at < self.bytes.len() {
            match self.peek(0) {
                // A backslash at the end of a line goes on in the next.
                b'\\' => self.at = self.next_letter(self.at + 1),
                b'\n' => break,
                byte => {
                    self.at += 1;
                    if byte == quote {
                        break;
                    }
                }
            }
        }
        Kind::Text
    }

    /// Behind the letter that begins at a byte.
    fn next_letter(&self, at: usize) -> usize {
        let mut next = (at + 1).min(self.bytes.len());
        while !self.text.is_char_boundary(next) {
            next += 1;
        }
        next
    }

    /// A text over several lines, with expressions in `${ }`, which may hold texts themselves.
    fn template(&mut self) -> Kind {
        self.at += 1;
        while self.at < self.bytes.len() {
            match (self.peek(0), self.peek(1)) {
                (b'`', b'`') => self.at += 2,
                (b'`', _) => {
                    self.at += 1;
                    break;
                }
                (b'$', b'{') => {
                    self.at += 2;
                    self.expression();
                }
                _ => self.at += 1,
            }
        }
        Kind::Text
    }

    /// To the brace that closes an expression in a text.
    fn expression(&mut self) {
        let mut depth = 1;
        while self.at < self.bytes.len() && depth > 0 {
            match self.peek(0) {
                b'{' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' => {
                    depth -= 1;
                    self.at += 1;
                }
                _ => _ = self.next(),
            }
        }
    }

    /// `#"…"#`, with any number of signs; a map begins with `#{`.
    fn raw_text(&mut self) -> Kind {
        let rest = &self.text[self.at..];
        let signs = rest.len() - rest.trim_start_matches('#').len();
        let Some(inner) = rest[signs..].strip_prefix('"') else {
            self.at += signs;
            return Kind::Plain;
        };
        let end = format!("\"{}", "#".repeat(signs));
        let length = inner.find(&end).map_or(inner.len(), |at| at + end.len());
        self.at += signs + 1 + length;
        Kind::Text
    }

    fn number(&mut self) -> Kind {
        let hexadecimal = self.peek(0) == b'0' && matches!(self.peek(1), b'x' | b'X');
        let part = |reader: &mut Self| {
            let mut before = 0;
            while let Some(&byte) = reader.bytes.get(reader.at) {
                let exponent = if hexadecimal { b'p' } else { b'e' };
                let sign = matches!(byte, b'+' | b'-') && before == exponent;
                if !sign && !is_word(byte) {
                    break;
                }
                before = byte.to_ascii_lowercase();
                reader.at += 1;
            }
        };
        part(self);
        // A range has two dots, and a method's name begins with a letter.
        let next = self.peek(1);
        if self.peek(0) == b'.' && next != b'.' && !next.is_ascii_alphabetic() && next != b'_' {
            self.at += 1;
            part(self);
        }
        Kind::Number
    }

    fn word(&mut self) -> Kind {
        let start = self.at;
        self.skip_while(is_word);
        let word = &self.text[start..self.at];
        if matches!(word, "true" | "false") {
            return Kind::Number;
        }
        let (keywords, is_type): (&[&str], bool) = match self.language {
            Language::Wgsl => (&WGSL_KEYWORDS, is_wgsl_type(word)),
            _ => (&RHAI_KEYWORDS, false),
        };
        if keywords.contains(&word) {
            Kind::Keyword
        } else if is_type {
            Kind::Type
        } else if self.peek(0) == b'(' {
            Kind::Call
        } else {
            Kind::Plain
        }
    }
}

/// A type that the language has, or one that a shader declares: those begin with a capital letter.
fn is_wgsl_type(word: &str) -> bool {
    let begins = |what: &str| word.starts_with(what);
    let mut letters = word.bytes();
    let own = letters
        .next()
        .is_some_and(|first| first.is_ascii_uppercase())
        && letters.any(|letter| letter.is_ascii_lowercase());
    let sized = |what: &str| {
        let rest = word.strip_prefix(what).map(str::as_bytes);
        rest.is_some_and(|rest| {
            rest.first()
                .is_some_and(|size| (b'2'..=b'4').contains(size))
        })
    };
    own || WGSL_TYPES.contains(&word) || sized("vec") || sized("mat") || begins("texture_")
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbench::assets::files::Files;

    fn parts(language: Language, text: &str) -> Vec<(Kind, String)> {
        let mut parts = Vec::new();
        read(language, text, &mut |range, kind| {
            parts.push((kind, text[range].to_owned()));
        });
        parts
    }

    fn of(language: Language, text: &str, kind: Kind) -> Vec<String> {
        let parts = parts(language, text).into_iter();
        let fits = parts.filter(|(other, _)| *other == kind);
        fits.map(|(_, text)| text).collect()
    }

    #[test]
    fn scripts_are_told_apart() {
        let text =
            "let a = 0..10; // to 10\nfor i in 0x1f { spawn(`n ${a + `x}`} \"`).at(1.5e-3, .5) }";
        let rhai = |kind| of(Language::Rhai, text, kind);
        assert_eq!(rhai(Kind::Keyword), ["let", "for", "in"]);
        assert_eq!(rhai(Kind::Number), ["0", "10", "0x1f", "1.5e-3", "5"]);
        assert_eq!(rhai(Kind::Comment), ["// to 10"]);
        assert_eq!(rhai(Kind::Call), ["spawn", "at"]);
        assert_eq!(rhai(Kind::Text), ["`n ${a + `x}`} \"`"]);
        let text = "#{ a: \"x\\\"y\", b: 'c', c: #\"raw \" text\"#, d: \"open\nlet";
        let texts = ["\"x\\\"y\"", "'c'", "#\"raw \" text\"#", "\"open"];
        assert_eq!(of(Language::Rhai, text, Kind::Text), texts);
        assert_eq!(of(Language::Rhai, text, Kind::Keyword), ["let"]);
        assert_eq!(of(Language::Rhai, "3.max(4)", Kind::Call), ["max"]);
    }

    #[test]
    fn shaders_are_told_apart() {
        let text = "#import lib::a\n/* a /* b */ c */ @group(1) var<storage> t: texture_2d<f32>;\n\
                    fn f(v: vec3f, s: Surface) -> u32 { return 0xFFu + u32(1.0e+2f) + MAX; }";
        let wgsl = |kind| of(Language::Wgsl, text, kind);
        assert_eq!(wgsl(Kind::Directive), ["#import", "@group"]);
        assert_eq!(wgsl(Kind::Comment), ["/* a /* b */ c */"]);
        assert_eq!(wgsl(Kind::Keyword), ["var", "fn", "return"]);
        let types = [
            "storage",
            "texture_2d",
            "f32",
            "vec3f",
            "Surface",
            "u32",
            "u32",
        ];
        assert_eq!(wgsl(Kind::Type), types);
        assert_eq!(wgsl(Kind::Call), ["f"]);
        assert_eq!(wgsl(Kind::Number), ["1", "0xFFu", "1.0e+2f"]);
    }

    /// All shipped files and all that a person may have typed of them so far.
    #[test]
    fn the_parts_make_up_the_text_also_where_it_is_cut_off() {
        let files = Files::shipped();
        for (folder, ending, language) in [
            ("scripts", "rhai", Language::Rhai),
            ("shaders", "wgsl", Language::Wgsl),
        ] {
            for file in files.list(folder, ending).unwrap_or_default() {
                let text = files.read_text(&file.path).unwrap_or_default();
                for end in (0..=text.len()).rev().step_by(97).take(12) {
                    let Some(text) = text.get(..end) else {
                        continue;
                    };
                    let whole: String = parts(language, text)
                        .into_iter()
                        .map(|(_, part)| part)
                        .collect();
                    assert_eq!(whole, text, "{}", file.path);
                }
            }
        }
        for odd in [
            "\"\\", "\"\\é", "`${", "#\"", "##", "/*", "'", "`", "é(", "1.",
        ] {
            for language in [Language::Rhai, Language::Wgsl, Language::Other] {
                let whole: String = parts(language, odd)
                    .into_iter()
                    .map(|part| part.1)
                    .collect();
                assert_eq!(whole, odd);
            }
        }
    }
}
