//! The example that reads a report.

use std::path::Path;
use std::process::Command;

use lightbench_lab::report::write_study;
use lightbench_lab::statistics::Summary;

use super::data;

#[test]
fn the_example_reads_what_a_report_writes() {
    let folder = tempfile::tempdir().unwrap();
    let mut study = data::study(3, 2, [32, 18]);
    write_study(&mut study, folder.path()).unwrap();
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/read_report.py");
    let Ok(output) = Command::new("python3")
        .arg(example)
        .arg(folder.path())
        .output()
    else {
        return;
    };
    let said = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    // Its medians of the frames are ours.
    for point in &study.points {
        for p in &point.comparison.pipelines {
            let median = Summary::of(p.gpu_samples().unwrap()).unwrap().median;
            let expected = format!("{} {} {median:.3}", point.key, p.name);
            assert!(said.contains(&expected), "{expected} in\n{said}");
        }
    }
}
