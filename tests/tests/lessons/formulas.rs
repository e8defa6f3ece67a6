//! The formulas of the texts are drawn from the TeX beside them, by RaTeX.
//!
//! `LIGHTBENCH_UPDATE=1` (`./x docs`) draws them anew instead of comparing them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use lightbench::lab::lesson::{
    FORMULA_INK, FORMULAS, Language, formula_without_paper, has_glyphs_only,
};
use lightbench::lab::svg;
use ratex_layout::{LayoutOptions, layout, to_display_list};
use ratex_svg::{SvgOptions, render_to_svg};
use ratex_types::MathStyle;

use super::all;

/// Units of an SVG for the size of a letter: somewhat more than the text around it has.
const LETTER: f64 = 20.0;
/// Units of paper around the formula.
const MARGIN: f64 = 6.0;
/// What RaTeX draws with.
const BLACK: &str = "rgba(0,0,0,1)";

/// A formula of one colour on white paper: so it can be read on any page, and who shows it otherwise
/// takes the paper away.
fn drawn(tex: &str) -> String {
    let parsed = ratex_parser::parse(tex).unwrap_or_else(|error| panic!("{tex}: {error}"));
    let options = LayoutOptions {
        style: MathStyle::Display,
        ..LayoutOptions::default()
    };
    let list = to_display_list(&layout(&parsed, &options));
    let options = SvgOptions {
        font_size: LETTER,
        padding: MARGIN,
        embed_glyphs: true,
        ..SvgOptions::default()
    };
    let whole = render_to_svg(&list, &options);
    let body = whole.split_once('>').unwrap().1;
    let body = body.strip_suffix("</svg>").unwrap();
    let plain = format!(" fill=\"{BLACK}\" fill-rule=\"nonzero\" stroke=\"none\"");
    let body = body.replace(&plain, "").replace(BLACK, FORMULA_INK);
    let body = rounded(&body).replace("/><", "/>\n<");
    let length = |units: f64| (100.0 * (units * LETTER + 2.0 * MARGIN)).round() / 100.0;
    let (width, height) = (length(list.width), length(list.height + list.depth));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\">\n\
         <rect class=\"paper\" width=\"{width}\" height=\"{height}\" rx=\"4\" fill=\"#ffffff\"/>\n\
         <g fill=\"{FORMULA_INK}\">\n{body}\n</g>\n</svg>\n"
    )
}

/// All numbers with two decimals: a hundredth of a pixel is seen by nobody.
fn rounded(text: &str) -> String {
    let mut whole = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        let length = rest[at..].find(|c: char| !c.is_ascii_digit() && c != '.');
        let (before, after) = rest.split_at(at);
        let (number, after) = after.split_at(length.unwrap_or(after.len()));
        whole.push_str(before);
        match number.parse::<f64>() {
            // A number within a name or a colour is none.
            Ok(value) if number.contains('.') => {
                whole.push_str(&((100.0 * value).round() / 100.0).to_string());
            }
            _ => whole.push_str(number),
        }
        rest = after;
    }
    whole + rest
}

/// The formulas of a lesson's folder, by their names.
fn sources(folder: &Path, ending: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(folder.join(FORMULAS)).into_iter().flatten();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names
        .filter_map(|name| Some(name.strip_suffix(ending)?.to_owned()))
        .collect()
}

#[test]
fn formulas_are_what_their_sources_say() {
    let update = std::env::var_os("LIGHTBENCH_UPDATE").is_some();
    let mut count = 0;
    for (folder, lesson) in all() {
        let names = sources(&folder, ".tex");
        for name in &names {
            let file = folder.join(format!("{FORMULAS}{name}.svg"));
            let tex = fs::read_to_string(file.with_extension("tex")).unwrap();
            let svg = drawn(tex.trim());
            let file_name = file.display();
            assert!(
                has_glyphs_only(&svg),
                "{file_name}: a sign of `{}` is in no font of RaTeX",
                tex.trim()
            );
            if update {
                fs::write(&file, &svg).unwrap();
            }
            let kept = fs::read_to_string(&file).unwrap_or_default();
            assert!(
                kept == svg,
                "{file_name} is not what {name}.tex says; draw it anew with `./x docs`"
            );
            // Ink and nothing else is left without the paper.
            let picture = svg::draw(&formula_without_paper(&kept, "#ffffff"), 1.0).unwrap();
            let inked = picture.pixels.iter().filter(|pixel| pixel[3] > 128);
            assert!(inked.count() > 20, "{file_name} is empty");
            let corner = picture.pixels[0];
            assert_eq!(corner[3], 0, "{file_name} has paper left");
            count += 1;
        }
        assert_eq!(names, sources(&folder, ".svg"), "{}", lesson.name);
        for (_, language) in Language::ALL {
            let text = lesson.text(language).unwrap();
            let used: BTreeSet<String> = text
                .links()
                .iter()
                .filter_map(|link| link.target.strip_prefix(FORMULAS)?.strip_suffix(".svg"))
                .map(str::to_owned)
                .collect();
            // Those with words are drawn once for each language.
            let others = Language::ALL.iter().filter(|(_, other)| *other != language);
            let endings: Vec<String> = others.map(|(code, _)| format!(".{code}")).collect();
            let is_others = |name: &str| endings.iter().any(|ending| name.ends_with(ending));
            let mut known = names.clone();
            known.retain(|name| !is_others(name));
            assert_eq!(used, known, "{}: {}", lesson.name, text.file);
        }
    }
    // Of one lesson there may be none.
    let all_lessons = std::env::var_os("LIGHTBENCH_LESSON").is_none();
    assert!(count >= 10 || !all_lessons, "{count}");
}

#[test]
fn formulas_say_in_words_what_they_show() {
    for (_, lesson) in all() {
        for (_, language) in Language::ALL {
            let text = lesson.text(language).unwrap();
            for line in text.markdown.lines() {
                if let Some((before, _)) = line.split_once(&format!("]({FORMULAS}")) {
                    let words = before.rsplit_once("![").map_or("", |(_, words)| words);
                    assert!(words.len() > 2, "{}: {line}", lesson.name);
                }
            }
        }
    }
}
