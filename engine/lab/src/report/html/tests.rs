#![allow(clippy::unwrap_used)]

use super::*;
use crate::report::sample;

/// Checks that every element is closed in order and that attributes are quoted, and returns the
/// names of all elements. Covers what [`Writer`] can produce.
fn parse(page: &str) -> Vec<String> {
    const VOID: [&str; 4] = ["meta", "img", "input", "link"];
    let body = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
    let (mut open, mut seen) = (Vec::<String>::new(), Vec::new());
    let mut rest = body;
    while let Some(start) = rest.find('<') {
        rest = &rest[start + 1..];
        let end = rest.find('>').unwrap();
        let (tag, after) = (&rest[..end], &rest[end + 1..]);
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name), "closes {name}");
            continue;
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.split(' ').next().unwrap().to_owned();
        assert!(name.chars().all(|c| c.is_ascii_alphanumeric()), "{tag}");
        if matches!(name.as_str(), "style" | "script") {
            rest = &rest[rest.find(&format!("</{name}>")).unwrap()..];
        }
        if !VOID.contains(&name.as_str()) {
            open.push(name.clone());
        }
        seen.push(name);
    }
    assert!(open.is_empty(), "left open: {open:?}");
    seen
}

fn attribute_values<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let key = format!(" {name}=\"");
    page.match_indices(&key)
        .map(|(at, _)| page[at + key.len()..].split('"').next().unwrap())
        .collect()
}

#[test]
fn the_page_is_well_formed_and_complete_without_network_or_script() {
    let page = page(&sample::comparison()).unwrap();
    let tags = parse(&page);
    assert_eq!(tags.iter().filter(|t| *t == "img").count(), 3);
    assert_eq!(tags.iter().filter(|t| *t == "h1").count(), 1);
    assert!(
        attribute_values(&page, "src")
            .iter()
            .all(|s| s.starts_with("data:image/png;base64,"))
    );
    for word in ["http://", "https://", "@import", "url(//"] {
        assert!(!page.contains(word), "{word}");
    }
    let ids = attribute_values(&page, "id");
    let unique: std::collections::HashSet<_> = ids.iter().collect();
    assert_eq!(ids.len(), unique.len(), "ids repeat");
    for target in attribute_values(&page, "href") {
        assert!(ids.contains(&target.strip_prefix('#').unwrap()), "{target}");
    }
    for target in attribute_values(&page, "fill")
        .iter()
        .filter_map(|f| f.strip_prefix("url(#"))
    {
        assert!(ids.contains(&target.trim_end_matches(')')), "{target}");
    }
    // What a reader needs within two minutes.
    for words in [
        "as fast as",
        "FLIP",
        "Example CPU 9000",
        "Mesa 22.3.6",
        "lightbench compare atrium",
        "software driver",
        "modelled",
        "SHA-256",
    ] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn every_time_on_a_software_driver_is_labelled() {
    let mut c = sample::comparison();
    let page_soft = page(&c).unwrap();
    for label in attribute_values(&page_soft, "aria-label") {
        if label.contains("time") || label.contains("Times") {
            assert!(label.contains("software driver"), "{label}");
        }
    }
    c.adapter.software = false;
    let page_hard = page(&c).unwrap();
    // Nothing but the definitions may mention one then.
    assert!(!page_hard.contains("software driver"));
}

#[test]
fn hostile_names_stay_text() {
    let mut c = sample::comparison();
    let hostile = "</style></script><script>alert(1)</script>\" onload=\"x()'&amp;";
    c.title = hostile.into();
    c.scene = hostile.into();
    c.command_line = hostile.into();
    c.adapter.name = hostile.into();
    c.machine.cpu = hostile.into();
    c.inputs[0].path = hostile.into();
    for p in &mut c.pipelines {
        p.title = hostile.into();
        p.description = hostile.into();
        p.gpu_why_not = Some(hostile.into());
        p.features_needed = vec![hostile.into()];
        for pass in &mut p.passes {
            pass.name = hostile.into();
            pass.kind = hostile.into();
            pass.why_not = Some(hostile.into());
        }
        for target in &mut p.targets {
            target.name = hostile.into();
            target.format = hostile.into();
        }
    }
    let page = page(&c).unwrap();
    let tags = parse(&page);
    assert_eq!(tags.iter().filter(|t| *t == "script").count(), 1);
    assert!(attribute_values(&page, "onload").is_empty());
}

#[test]
fn poor_data_still_makes_a_page() {
    let empty = sample::with(Vec::new());
    assert!(page(&empty).unwrap().contains("No pipeline was measured."));
    let mut c = sample::comparison();
    for p in &mut c.pipelines {
        p.frame_gpu_ms = None;
        p.frame_cpu_ms = vec![f64::NAN];
        p.picture = None;
        p.heat_map = None;
        p.difference = None;
        p.targets.clear();
        for pass in &mut p.passes {
            pass.gpu_ms = None;
            pass.cpu_ms.clear();
            pass.fragments = None;
        }
    }
    c.size = [0, 0];
    c.title.clear();
    parse(&page(&c).unwrap());
    c.pipelines[0].passes.clear();
    c.reference = "nobody".into();
    parse(&page(&c).unwrap());
}
