#![allow(clippy::unwrap_used)]

use super::pictures::place;
use super::*;
use crate::report::sample::{comparison, picture, pipeline, series, with};

fn said(c: &Comparison, topic: Topic) -> String {
    let all = summarize(c, &Analysis::of(c));
    let of: Vec<String> = all
        .into_iter()
        .filter(|s| s.topic == topic)
        .map(|s| s.text)
        .collect();
    of.join(" | ")
}

/// Pipelines a, b, … with the given GPU frame times and equal pictures. Five processes measured as many
/// frames each, or one measured them where there are fewer than five.
fn timed(times: &[Vec<f64>]) -> Comparison {
    let pipelines = times.iter().enumerate().map(|(i, samples)| {
        let name = char::from(b'a' + i as u8).to_string();
        let mut p = pipeline(&name, &name.to_uppercase(), 10.0, picture(32, 18, 0.0, 0.3));
        p.frame_gpu_ms = Some(samples.clone());
        p.process_frames = match samples.len() as u32 {
            few @ 0..5 => vec![few],
            many => vec![many / 5; 5],
        };
        p
    });
    with(pipelines.collect())
}

/// The same times in another order, so that the processes of two pipelines have nothing in common.
fn other(mut times: Vec<f64>) -> Vec<f64> {
    times.reverse();
    times
}

#[test]
fn nothing_and_one() {
    assert_eq!(
        said(&with(Vec::new()), Topic::Speed),
        "No pipeline was measured."
    );
    assert_eq!(said(&with(Vec::new()), Topic::Caution), "");
    let text = said(&timed(&[series(10.0, 1.0, 60)]), Topic::Speed);
    assert!(
        text.starts_with("Only A was measured, so there is nothing to compare it with"),
        "{text}"
    );
    assert!(text.contains("95 % interval"), "{text}");
    let text = said(&timed(&[vec![10.0; 3]]), Topic::Speed);
    assert!(text.contains("too few for an interval"), "{text}");
}

#[test]
fn a_clear_winner_is_named_with_its_interval() {
    let c = timed(&[series(30.0, 1.0, 60), series(10.0, 1.0, 60)]);
    let text = said(&c, Topic::Speed);
    assert!(text.starts_with("B is 3.0"), "{text}");
    assert!(
        text.contains("times (interval 2.9") && text.contains("as fast as A"),
        "{text}"
    );
    let c = timed(&[
        series(30.0, 1.0, 60),
        series(10.0, 1.0, 60),
        series(20.0, 1.0, 60),
    ]);
    let text = said(&c, Topic::Speed);
    assert!(
        text.starts_with("B is the fastest of 3 pipelines and 2.0"),
        "{text}"
    );
    assert!(text.contains("as fast as C"), "{text}");
}

#[test]
fn overlapping_intervals_decide_nothing() {
    let c = timed(&[series(10.0, 8.0, 20), other(series(10.6, 8.0, 20))]);
    let text = said(&c, Topic::Speed);
    assert!(
        text.starts_with("The data do not decide which of A and B is the fastest"),
        "{text}"
    );
    assert!(!text.contains("as fast as"), "{text}");
    // Two leaders that can't be told apart, and a third that is behind.
    let c = timed(&[
        series(10.0, 8.0, 20),
        other(series(10.6, 8.0, 20)),
        series(90.0, 1.0, 20),
    ]);
    let text = said(&c, Topic::Speed);
    assert!(
        text.starts_with(
            "A has the smallest median of 3 pipelines; the data do not decide whether it is \
             faster than B. The medians are 9.96 ms and 10.6 ms (GPU time on a software driver; \
             interval of the ratio "
        ),
        "{text}"
    );
    assert!(
        text.ends_with("A is faster than the rest, of which C is next with 90.0 ms."),
        "{text}"
    );
    // One is the same, one is open, one is behind.
    let c = timed(&[
        series(10.0, 0.2, 60),
        series(10.1, 0.2, 60),
        other(series(11.0, 9.0, 60)),
        series(30.0, 0.2, 60),
    ]);
    let text = said(&c, Topic::Speed);
    assert!(
        text.starts_with(
            "A has the smallest median of 4 pipelines; B takes the same time within 5 %; the data \
             do not decide whether it is faster than C. "
        ),
        "{text}"
    );
}

#[test]
fn equal_times_are_called_equal_only_within_the_margin() {
    let c = timed(&[series(10.0, 0.2, 60), series(10.1, 0.2, 60)]);
    let text = said(&c, Topic::Speed);
    assert!(
        text.starts_with("A and B take the same time within 5 %"),
        "{text}"
    );
    // A difference of 10 % with a spread as small is a difference.
    let text = said(
        &timed(&[series(10.0, 0.2, 60), series(11.0, 0.2, 60)]),
        Topic::Speed,
    );
    assert!(text.starts_with("A is 1.10 times"), "{text}");
}

#[test]
fn too_few_processes_decide_nothing() {
    let text = said(&timed(&[vec![10.0; 4], vec![30.0; 4]]), Topic::Speed);
    assert!(
        text.contains("too few processes measured for a comparison with B"),
        "{text}"
    );
    assert!(!text.contains("as fast as"), "{text}");
}

#[test]
fn missing_gpu_times_fall_back_to_the_cpu_and_say_so() {
    let mut c = timed(&[series(30.0, 1.0, 60), series(10.0, 1.0, 60)]);
    c.pipelines[0].frame_gpu_ms = None;
    c.pipelines[0].gpu_why_not = Some("the adapter has no timestamps".into());
    let text = said(&c, Topic::Speed);
    assert!(
        text.contains("CPU time") && !text.contains("GPU time"),
        "{text}"
    );
    let text = said(&c, Topic::Caution);
    assert!(
        text.contains("GPU times are missing for A (the adapter has no timestamps)."),
        "{text}"
    );
    assert!(text.contains("rests on the CPU times"), "{text}");
    c.pipelines[1].frame_cpu_ms.clear();
    let text = said(&c, Topic::Speed);
    assert!(
        text.starts_with("No frame times are common to all pipelines"),
        "{text}"
    );
}

#[test]
fn a_software_driver_and_unsteady_times_are_noted() {
    let mut c = timed(&[series(10.0, 9.0, 60), series(100.0, 1.0, 60)]);
    let text = said(&c, Topic::Caution);
    assert!(
        text.contains("software driver") && text.contains("times of A scatter"),
        "{text}"
    );
    assert!(said(&c, Topic::Speed).contains("GPU time on a software driver"));
    c.adapter.software = false;
    assert!(!said(&c, Topic::Caution).contains("software"));
    assert!(!said(&c, Topic::Speed).contains("software"));
}

#[test]
fn pictures_equal_different_and_unknown() {
    let c = timed(&[
        series(9.0, 1.0, 9),
        series(9.0, 1.0, 9),
        series(9.0, 1.0, 9),
    ]);
    assert_eq!(
        said(&c, Topic::Pictures),
        "The pictures of B and C equal that of A in every pixel."
    );
    let mut c = comparison();
    let text = said(&c, Topic::Pictures);
    assert!(
        text.starts_with(
            "The picture of Forward single pass differs from that of Deferred shading by FLIP 0."
        ),
        "{text}"
    );
    assert!(
        text.contains("The difference lies mostly along edges of the picture"),
        "{text}"
    );
    c.pipelines[1].difference = None;
    assert_eq!(
        said(&c, Topic::Pictures),
        "The pictures of Forward single pass were not compared."
    );
    c.reference = "nobody".into();
    assert!(said(&c, Topic::Pictures).starts_with("The reference nobody was not measured"));
}

#[test]
fn place_of_a_difference_is_named_only_when_it_holds() {
    let mut c = comparison();
    let d = c.pipelines[1].difference.as_mut().unwrap();
    d.location.edge_error = 0.5;
    d.location.thirds = [[1.0 / 9.0; 3]; 3];
    assert_eq!(place(d), "The difference is spread over the picture.");
    d.location.thirds[2][0] = 0.7;
    assert_eq!(
        place(d),
        "The difference lies mostly in the bottom left of the picture (70.0 % of it)."
    );
    // Much of the error lies on edges, but edges are most of the picture.
    d.location.edge_error = 0.8;
    d.location.edge_area = 0.7;
    assert!(!place(d).contains("edges"));
    d.location.edge_area = 0.2;
    assert!(place(d).contains(
        "along edges of the picture (80.0 % of it on 20.0 % of the pixels) and in the bottom left"
    ));
}

#[test]
fn many_differing_pictures_are_summed_up() {
    let shifts = [0.0, 0.002, 0.004, 0.006, 0.008, 0.01];
    let pipelines = shifts.iter().enumerate().map(|(i, shift)| {
        pipeline(
            &format!("p{i}"),
            "",
            10.0,
            picture(64, 36, *shift, 0.3 + shift),
        )
    });
    let text = said(&with(pipelines.collect()), Topic::Pictures);
    assert!(
        text.starts_with("5 pictures differ from that of p0; the least"),
        "{text}"
    );
    assert!(
        text.contains("The picture of p1 ") && text.contains("The picture of p5 "),
        "{text}"
    );
    assert!(!text.contains("The picture of p3 "), "{text}");
}

#[test]
fn memory_is_stated_with_bytes_a_pixel() {
    // Depth 5 and HDR 8 bytes a pixel; deferred also 4 and 8.
    let text = said(&comparison(), Topic::Memory);
    assert_eq!(
        text,
        "The targets take the least memory in Forward single pass, 182.8 KiB (13.0 bytes a \
         pixel), and the most in Deferred shading, 351.6 KiB (25.0 bytes a pixel)."
    );
    let mut one = comparison();
    one.pipelines.truncate(1);
    assert!(said(&one, Topic::Memory).starts_with("The targets of Deferred shading take 351.6"));
}
