#![allow(clippy::unwrap_used)]
use super::*;

fn free() -> Free {
    Free {
        eye: Vec3::new(0.1, -2.0e-7, 12345.678),
        yaw: 1.0 / 3.0,
        pitch: -0.7,
        orbit: 5.5,
        fov_y: std::f32::consts::FRAC_PI_3,
        near: 0.1,
        far: f32::INFINITY,
    }
}

fn view(camera: Eye) -> Viewpoint {
    Viewpoint {
        scene: "scripts/scenes/my rooms/a=b 100%.rhai".to_owned(),
        scene_settings: Settings::new()
            .with("lights", "64")
            .with("title", "práctica\tone\nline = 2"),
        pipeline: "deferred_shading".to_owned(),
        pipeline_settings: Settings::new().with("exposure", "-0.5"),
        camera,
        time: 1.0 / 3.0,
        size: (637, 359),
    }
}

#[test]
fn what_is_written_reads_back_to_the_last_bit() {
    let flat = Flat {
        side: Side::Right,
        center: Vec3::new(1.0e-20, 2.0, -3.5e7),
        height: 0.1,
        reach: 7.25,
    };
    for camera in [
        Eye::Scene,
        Eye::Named("lamp cam".to_owned()),
        Eye::Free(free()),
        Eye::Side(flat),
    ] {
        let view = view(camera);
        let text = view.to_string();
        assert_eq!(text.lines().count(), 1, "{text}");
        assert_eq!(text.parse::<Viewpoint>().unwrap(), view, "{text}");
        // What mail programs do to long lines.
        let broken = format!("  {}\n", text.replace(' ', "\n  "));
        assert_eq!(broken.parse::<Viewpoint>().unwrap(), view);
    }
}

#[test]
fn a_short_view_has_defaults() {
    let text = "lightbench-view-1 scene=atrium pipeline=deferred_shading";
    let view: Viewpoint = text.parse().unwrap();
    assert_eq!(
        (view.camera, view.time, view.size),
        (Eye::Scene, 0.0, (640, 360))
    );
}

#[test]
fn what_is_no_view_is_explained() {
    let lens = "camera.eye=0,0,0 camera.turn=0,0 camera.orbit=1";
    for (text, words) in [
        ("", "this is no view"),
        ("hello", "begins with `lightbench-view-1`"),
        ("lightbench-view-2 scene=a", "version 2 of its format"),
        ("lightbench-view-x scene=a", "no version"),
        ("… pipeline=p", "does not say its `scene`"),
        ("… scene=a", "does not say its `pipeline`"),
        ("… scene= pipeline=p", "does not say its `scene`"),
        ("… scene=a scene=b pipeline=p", "`scene` is there twice"),
        (
            "… scene=a scene.x=1 scene.x=2 pipeline=p",
            "`scene.x` is there twice",
        ),
        ("… scene=a pipeline=p scene.=2", "no parameter is named"),
        ("… scene=a pipeline=p lights=4", "a view has no `lights`"),
        ("… scene=a pipeline=p lights", "each part is name=value"),
        ("… scene=%zz pipeline=p", "two digits"),
        ("… scene=%ff pipeline=p", "two digits"),
        ("… scene=a pipeline=p time=-1", "from 0 to 86400"),
        ("… scene=a pipeline=p time=NaN", "from 0 to 86400"),
        ("… scene=a pipeline=p size=640", "written as 640x360"),
        ("… scene=a pipeline=p size=0x5", "written as 640x360"),
        ("… scene=a pipeline=p size=99999x5", "no side is longer"),
        ("… scene=a pipeline=p camera=x", "one of scene, named"),
        ("… scene=a pipeline=p camera=named", "its `camera.name`"),
        (
            "… scene=a pipeline=p camera.eye=1,2,3",
            "means nothing with camera=scene",
        ),
        (
            "… scene=a pipeline=p camera=free camera.eye=1,2",
            "its `camera.turn`",
        ),
    ] {
        let text = text.replace('…', "lightbench-view-1");
        let error = text.parse::<Viewpoint>().unwrap_err().to_string();
        assert!(error.contains(words), "{text}: {error}");
    }
    for (camera, words) in [
        (format!("{lens} camera.lens=0,0.1,9"), "between 0 and 3.14"),
        (
            format!("{lens} camera.lens=1,0.1,0.1"),
            "the nearer one first",
        ),
        (
            format!("{lens} camera.lens=1,inf,inf"),
            "the nearer one first",
        ),
        (format!("{lens} camera.lens=1,2"), "3 numbers"),
        (format!("{lens} camera.lens=1,2,3,4"), "3 numbers"),
        (
            format!("{lens} camera.lens=1,1,9").replace("turn=0,0", "turn=0,2"),
            "straight up",
        ),
        (
            format!("{lens} camera.lens=1,1,9").replace("eye=0,0,0", "eye=0,inf,0"),
            "not finite",
        ),
    ] {
        let text = format!("lightbench-view-1 scene=a pipeline=p camera=free {camera}");
        let error = text.parse::<Viewpoint>().unwrap_err().to_string();
        assert!(error.contains(words), "{text}: {error}");
    }
    let long = format!("lightbench-view-1 scene={}", "a".repeat(LONGEST));
    assert!(
        long.parse::<Viewpoint>()
            .unwrap_err()
            .to_string()
            .contains("too long")
    );
}

#[test]
fn any_text_is_read_or_refused() {
    let text = view(Eye::Free(free())).to_string();
    // Cut anywhere and with any character in any place, nothing stops the program.
    for at in 0..text.len() {
        if text.is_char_boundary(at) {
            let _ = text[..at].parse::<Viewpoint>();
            let mut other = text.clone();
            other.insert(at, '%');
            let _ = other.parse::<Viewpoint>();
        }
    }
}
