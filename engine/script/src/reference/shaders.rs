//! The reference of the shader library, from the files themselves.

use std::fmt::Write as _;

use lightbench_assets::files::{FileError, Files};

use super::functions::wrapped;

/// The folder of the modules.
const FOLDER: &str = "shaders/lib";

/// The page, as Markdown: each module with what its header says and what it declares.
///
/// # Errors
/// A module that can't be read.
pub fn shaders(files: &Files) -> Result<String, FileError> {
    let mut modules = Vec::new();
    for file in files.list(FOLDER, "wgsl")? {
        let text = files.read_text(&file.path)?;
        modules.push(Module::read(file.path, &text));
    }
    let mut text = String::from(
        "# The shader library\n\n\
         <!-- Written by `lightbench docs shaders`. Change the comments in shaders/lib instead. \
         -->\n\n",
    );
    text += include_str!("prose/shaders.txt");
    text += "\n| module | what it is for | functions |\n| --- | --- | --- |\n";
    for module in &modules {
        let link = module.name.replace("::", "");
        let functions: Vec<String> = module.functions.iter().map(|f| format!("`{f}`")).collect();
        // Writing to a text can't fail.
        let _ = writeln!(
            text,
            "| [`{}`](#{link}) | {} | {} |",
            module.name,
            module.purpose,
            functions.join(", ")
        );
    }
    for module in &modules {
        text += &module.markdown();
    }
    Ok(text)
}

/// One file of the library.
#[derive(Debug, Default)]
struct Module {
    path: String,
    /// As in `lightbench::scene`.
    name: String,
    /// The first paragraph of the header.
    purpose: String,
    /// The rest of it: paragraphs and items of a list.
    header: Vec<String>,
    /// Names that choose a variant of it.
    defines: Vec<String>,
    functions: Vec<String>,
    /// Everything that it declares, without the bodies of functions.
    declarations: String,
}

impl Module {
    fn read(path: String, text: &str) -> Self {
        let mut module = Self {
            path,
            ..Self::default()
        };
        let (header, rest) = text.split_once("#define_import_path").unwrap_or(("", text));
        let (name, rest) = rest.split_once('\n').unwrap_or((rest, ""));
        name.trim().clone_into(&mut module.name);
        module.read_header(header);
        module.read_defines(rest);
        module.read_declarations(rest);
        module
    }

    /// Paragraphs end at empty lines; `In:` and `Out:` begin items, which go on with indented
    /// lines.
    fn read_header(&mut self, header: &str) {
        let mut parts: Vec<String> = vec![String::new()];
        for line in header.lines() {
            let line = line.strip_prefix("//").unwrap_or(line);
            let line = line.strip_prefix(' ').unwrap_or(line);
            let starts_item = ["In:", "Out:"].iter().any(|item| line.starts_with(item));
            let in_item = parts.last().is_some_and(|part| part.starts_with("- "));
            let ends_item = in_item && !line.starts_with(' ');
            if line.trim().is_empty() || starts_item || ends_item {
                parts.push(String::new());
            }
            let Some(part) = parts.last_mut() else {
                continue;
            };
            if starts_item {
                part.push_str("- ");
            } else if !part.is_empty() {
                part.push(' ');
            }
            part.push_str(&line.split_whitespace().collect::<Vec<_>>().join(" "));
        }
        let mut parts = parts.into_iter().filter(|part| !part.trim().is_empty());
        self.purpose = parts.next().unwrap_or_default();
        self.header = parts.collect();
    }

    fn read_defines(&mut self, text: &str) {
        for line in text.lines() {
            let values = line
                .split("#{")
                .skip(1)
                .filter_map(|rest| rest.split('}').next());
            let line = line.trim();
            let flag = ["#ifdef ", "#if "].iter().find_map(|word| {
                let rest = line.strip_prefix(word)?;
                rest.split_whitespace().next()
            });
            for name in values.chain(flag) {
                if !self.defines.iter().any(|known| known == name) {
                    self.defines.push(name.to_owned());
                }
            }
        }
    }

    /// Keeps what stands outside of functions' bodies, with its comments.
    fn read_declarations(&mut self, text: &str) {
        let mut in_body = false;
        // Memory of a workgroup is no business of who calls the functions.
        let hidden = ["#import", "var<workgroup>"];
        let hidden = |line: &str| hidden.iter().any(|start| line.starts_with(start));
        let mut lines: Vec<&str> = Vec::new();
        for line in text.lines() {
            if in_body {
                in_body = line != "}";
                continue;
            }
            if let Some(rest) = line.strip_prefix("fn ") {
                let name = rest.split('(').next().unwrap_or_default();
                // Each variant of a module declares it again.
                if !self.functions.iter().any(|known| known == name) {
                    self.functions.push(name.to_owned());
                }
            }
            let in_signature = lines.last().is_some_and(|last| last.ends_with(['(', ',']));
            let opens = line.starts_with("fn ") || (in_signature && line.starts_with(')'));
            match line.strip_suffix(" {") {
                Some(signature) if opens => {
                    lines.push(signature);
                    in_body = true;
                }
                _ if hidden(line) => {
                    while lines.last().is_some_and(|line| line.starts_with("//")) {
                        lines.pop();
                    }
                }
                _ => lines.push(line),
            }
        }
        leave_out_empty_variants(&mut lines);
        // Where something was left out, one empty line is enough.
        lines.dedup_by(|a, b| a.is_empty() && b.is_empty());
        self.declarations = lines.join("\n").trim().to_owned();
    }

    fn markdown(&self) -> String {
        let mut text = format!(
            "\n## `{}`\n\n{}",
            self.name,
            wrapped(&format!("`{}`. {}", self.path, self.purpose))
        );
        let mut in_list = false;
        for part in &self.header {
            let item = part.starts_with("- ");
            if !(item && in_list) {
                text.push('\n');
            }
            in_list = item;
            text += &wrapped(part);
        }
        if !self.defines.is_empty() {
            let names: Vec<String> = self
                .defines
                .iter()
                .map(|name| format!("`{name}`"))
                .collect();
            let _ = write!(
                text,
                "\nDefined by the pass, or by the engine for a material: {}.\n",
                names.join(", ")
            );
        }
        let _ = write!(text, "\n```wgsl\n{}\n```\n", self.declarations);
        text
    }
}

/// Takes out `#ifdef`s in which nothing is declared.
fn leave_out_empty_variants(lines: &mut Vec<&str>) {
    let starts = |line: &str, word: &str| line.starts_with(word);
    while let Some(end) = (0..lines.len()).find(|&end| {
        let before = lines[..end].iter().rev().find(|line| !line.is_empty());
        starts(lines[end], "#endif") && before.is_some_and(|line| starts(line, "#if"))
    }) {
        let begin = (0..end).rev().find(|&at| starts(lines[at], "#if"));
        lines.drain(begin.unwrap_or(end)..=end);
    }
}
