//! The JSON file against its documentation.

use std::collections::BTreeSet;

use lightbench_lab::report::{SCHEMA, read_json, write_study};
use serde_json::Value;

use super::data;

const DOCUMENTATION: &str = include_str!("../../docs/report.md");

fn fields(value: &Value, into: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) => {
            for (name, value) in map {
                into.insert(name.clone());
                fields(value, into);
            }
        }
        Value::Array(items) => items.iter().for_each(|item| fields(item, into)),
        _ => {}
    }
}

#[test]
fn every_field_and_column_is_documented() {
    let folder = tempfile::tempdir().unwrap();
    let mut study = data::study(2, 2, [32, 18]);
    let files = write_study(&mut study, folder.path()).unwrap();
    let text = std::fs::read_to_string(&files.json).unwrap();
    let mut found = BTreeSet::new();
    fields(&serde_json::from_str(&text).unwrap(), &mut found);
    assert!(found.len() > 80, "{found:?}");
    for path in &files.csv {
        let table = std::fs::read_to_string(path).unwrap();
        let header = table.lines().next().unwrap();
        found.extend(
            header
                .split(',')
                .filter(|c| !c.starts_with("at_"))
                .map(str::to_owned),
        );
    }
    let missing: Vec<&String> = found
        .iter()
        .filter(|name| !DOCUMENTATION.contains(&format!("`{name}`")))
        .collect();
    assert!(missing.is_empty(), "not in docs/report.md: {missing:?}");
    assert!(DOCUMENTATION.contains(&format!("schema {SCHEMA}")));

    // Written and read, the data are the same, but for pixels, which the file does not hold.
    let mut read = read_json(&files.json).unwrap();
    for (read, point) in read.points.iter_mut().zip(&study.points) {
        for (read, p) in read
            .comparison
            .pipelines
            .iter_mut()
            .zip(&point.comparison.pipelines)
        {
            (read.picture, read.heat_map) = (p.picture.clone(), p.heat_map.clone());
            read.linear = p.linear.clone();
            for (read, view) in read.views.iter_mut().zip(&p.views) {
                read.picture = view.picture.clone();
            }
        }
    }
    assert_eq!(read, study);
}
