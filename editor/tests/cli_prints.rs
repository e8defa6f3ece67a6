//! `lesson print`: one page that needs nothing else.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::collections::BTreeSet;
use std::fs;

use cli_support::run_in;

/// What stands in an attribute, each time that it is there.
fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let begin = format!(" {name}=\"");
    let parts = page.split(begin.as_str()).skip(1);
    parts.map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn a_lesson_is_one_page_in_each_language() {
    let place = tempfile::tempdir().unwrap();
    for (language, title, licensed) in [
        ("en", "First light", "The text is under"),
        ("es", "Primera luz", "El texto está bajo la licencia"),
    ] {
        let arguments = [
            "lesson",
            "print",
            "1",
            "--out",
            "out/page.html",
            "--language",
            language,
        ];
        run_in(place.path(), &arguments, &[]).succeeded();
        let page = fs::read_to_string(place.path().join("out/page.html")).unwrap();
        assert!(page.contains(&format!("<html lang=\"{language}\">")));
        assert!(page.contains(&format!("<h1>{title}</h1>")), "{title}");
        assert!(page.contains(licensed) && page.contains(">CC-BY-4.0</a>"));

        // Nothing is fetched: pictures are inside, and links lead within the page or are read only.
        assert!(!page.contains("<script") && !page.contains("<link") && !page.contains("url("));
        let sources = attributes(&page, "src");
        assert_eq!(sources.len(), 2, "two pictures");
        assert!(
            sources
                .iter()
                .all(|source| source.starts_with("data:image/png;base64,iVBOR"))
        );
        let ids: BTreeSet<&str> = attributes(&page, "id").into_iter().collect();
        assert!(ids.contains("lambert"));
        for link in attributes(&page, "href") {
            match link.strip_prefix('#') {
                Some(place) => assert!(ids.contains(place), "{link}"),
                None => assert!(link.starts_with("https://"), "{link}"),
            }
        }

        // Formulas are drawn in the colour of the text, without their paper, and can be read aloud.
        let formulas: Vec<&str> = page.split("<svg ").skip(1).collect();
        assert_eq!(formulas.len(), 5);
        assert!(page.contains("aria-label=\"L = ρ E / π\""));
        assert!(page.contains("fill=\"currentColor\"") && !page.contains("class=\"paper\""));
        // Listings are there as they are in their files, with all signs.
        assert!(page.contains("let to_light = light.position - point.position;"));
        assert!(
            page.contains("lightbench lesson start 1 --into ") && page.contains(" &amp;&amp; cd ")
        );
        // Without a student the numbers are those of nobody.
        assert!(page.contains("<td class=\"number\">35 °</td>"));
        assert!(page.contains("<td class=\"number\">21</td>"), "all points");
    }
}

#[test]
fn a_page_has_the_students_numbers_and_says_what_is_wrong() {
    let place = tempfile::tempdir().unwrap();
    let student = ["--id", "ana <b>"];
    let page = |id: &[&str]| {
        let mut arguments = vec!["lesson", "print", "01-first-light", "--out", "page.html"];
        arguments.extend(id);
        run_in(place.path(), &arguments, &[]).succeeded();
        fs::read_to_string(place.path().join("page.html")).unwrap()
    };
    let (hers, nobodys) = (page(&student), page(&[]));
    assert!(hers.contains("The numbers of ana &lt;b&gt;") && !hers.contains("<b>"));
    assert_ne!(attributes(&hers, "class").len(), 0);
    let numbers = |page: &str| {
        let rows = page.split("<td class=\"number\">").skip(1).take(3);
        rows.map(|rest| rest.split('<').next().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    // Three numbers of eleven, eight and seventeen: the same are drawn for one in 1500 names.
    assert_ne!(numbers(&hers), numbers(&nobodys));
    assert_eq!(numbers(&hers), numbers(&page(&student)));

    let arguments = ["lesson", "print", "77", "--out", "page.html"];
    run_in(place.path(), &arguments, &[]).failed(1, &["there is no lesson `77`"]);
    let arguments = ["lesson", "print", "1"];
    run_in(place.path(), &arguments, &[]).failed(2, &["--out"]);
}
