//! The byte model on cases that are worked out by hand in the comments.
#![allow(clippy::unwrap_used)]

mod support;

use lightbench_render::description::*;
use lightbench_render::targets::Targets;
use lightbench_render::traffic::{Traffic, traffic};
use lightbench_render::{PipelineDesc, Place};
use support::{gpu, named, pass, read, target, writes};

/// 8 × 4 pixels: 32 of them.
const SIZE: (u32, u32) = (8, 4);

fn depth(name: &str, load: Load, write: bool) -> DepthAttachment {
    DepthAttachment {
        load,
        write,
        ..DepthAttachment::new(name, Place::default())
    }
}

fn multisampled(name: &str, format: &str) -> TargetDesc {
    TargetDesc {
        samples: 4,
        ..target(name, format)
    }
}

fn shaped(name: &str, format: &str, shape: Shape, mips: Mips) -> TargetDesc {
    TargetDesc {
        size: TargetSize::Absolute(4, 4),
        shape,
        mips,
        ..target(name, format)
    }
}

const CLEAR: Load = Load::Clear([0.0; 4]);

#[test]
fn passes_move_what_their_formats_say() {
    let desc = PipelineDesc {
        targets: vec![
            target("hdr", "rgba16float"),
            target("other", "rgba16float"),
            target("albedo", "rgba8unorm"),
            target("depth", "depth32float"),
            target("marks", "depth32float-stencil8"),
            multisampled("samples", "rgba16float"),
            multisampled("sample_depth", "depth32float"),
            shaped("pyramid", "r32float", Shape::Flat, Mips::All),
            shaped("map", "depth32float", Shape::Array(6), Mips::Count(1)),
        ],
        buffers: vec![BufferDesc {
            name: "list".into(),
            at: Place::default(),
            size: BufferSize::Words(10),
            grows_with: None,
        }],
        ..PipelineDesc::default()
    };
    let gpu = gpu(false);
    let targets = Targets::new(&gpu, &desc, None, SIZE, 0, &[10]);
    let check = |what: &str, pass: &PassDesc, coverage: f64, expected: Traffic| {
        assert_eq!(traffic(pass, &targets, coverage), expected, "{what}");
    };

    // Writes 8 + 4 bytes a pixel and 4 of depth; cleared depth is not read. 32 · (8 + 4 + 4) = 512.
    // A fragment writes 12, tests 4, writes 4.
    let mut g_buffer = pass("a", PassKind::Geometry(Geometry::default()), "x.wgsl");
    g_buffer.colors = vec![
        writes("hdr", CLEAR, Blend::Replace),
        writes("albedo", CLEAR, Blend::Replace),
    ];
    g_buffer.depth = Some(depth("depth", CLEAR, true));
    let expected = Traffic {
        read: 0,
        written: 512,
        stencil: 0,
        loaded: 0,
        stored: 512,
        pixels: 32,
        fragment_bytes: 20,
    };
    check("a G-buffer", &g_buffer, 1.0, expected);
    // 40 fragments are 8 more than the pixels: 160 bytes.
    assert_eq!(expected.overdraw(40), 160);
    assert_eq!(expected.overdraw(30), 0);

    // The same again over what is there: depth is read (128); attachments are loaded.
    let mut again = g_buffer.clone();
    again.colors.iter_mut().for_each(|c| c.load = Load::Keep);
    again.depth = Some(depth("depth", Load::Keep, true));
    let kept = Traffic {
        read: 128,
        loaded: 512,
        ..expected
    };
    check("what is kept", &again, 1.0, kept);

    // Lights that cover the picture two and a half times: 80 fragments read 4 + 4 of the surface,
    // blend 8 of light, both ways. The shader reads depth, so the test costs nothing more.
    let mut lights = pass("b", PassKind::Lights(Lights::default()), "x.wgsl");
    lights.reads = vec![read("albedo"), read("depth")];
    lights.colors = vec![writes("hdr", Load::Keep, Blend::Add)];
    lights.depth = Some(depth("depth", Load::Keep, false));
    let lit = Traffic {
        read: 80 * (4 + 4 + 8),
        written: 80 * 8,
        stencil: 0,
        loaded: 32 * (8 + 4),
        stored: 32 * 8,
        pixels: 80,
        fragment_bytes: 8 + 8 + 4,
    };
    check("light volumes", &lights, 2.5, lit);

    // With stencil each covered pixel is marked and tested, a byte each, and depth is read.
    lights.kind = PassKind::Lights(Lights {
        stencil: LightStencil::TwoPass,
        ..Lights::default()
    });
    lights.reads = vec![read("albedo")];
    lights.depth = Some(depth("marks", Load::Keep, false));
    let marked = Traffic {
        stencil: 160,
        ..lit
    };
    check("marked light volumes", &lights, 2.5, marked);

    // A fullscreen pass that tests and replaces stencil, and has no depth test: 2 bytes a pixel.
    let mut mark = pass("c", PassKind::Fullscreen, "x.wgsl");
    let mut stencil = Stencil::new(Place::default());
    stencil.compare = Compare::Equal;
    stencil.pass = StencilOperation::Replace;
    mark.depth = Some(DepthAttachment {
        compare: Compare::Always,
        stencil: Some(stencil),
        ..depth("marks", Load::Keep, false)
    });
    let expected = Traffic {
        stencil: 64,
        loaded: 128,
        pixels: 32,
        ..Traffic::default()
    };
    check("stencil", &mark, 1.0, expected);

    // Four samples: 32 · 4 · (8 + 4) = 1536 written. Dropped samples are not: 512 of depth remain,
    // and the mean of 256.
    let mut samples = pass("d", PassKind::Geometry(Geometry::default()), "x.wgsl");
    samples.colors = vec![writes("samples", CLEAR, Blend::Replace)];
    samples.depth = Some(depth("sample_depth", CLEAR, true));
    let expected = Traffic {
        read: 0,
        written: 1536,
        stored: 1536,
        pixels: 32,
        fragment_bytes: 4 * (8 + 4 + 4),
        ..Traffic::default()
    };
    check("four samples", &samples, 1.0, expected);
    samples.colors[0].store = false;
    samples.colors[0].resolve = named("other");
    let expected = Traffic {
        written: 512 + 256,
        stored: 512 + 256,
        ..expected
    };
    check("dropped samples", &samples, 1.0, expected);

    // What does not fill its picture is cleared all the same: half of 256 is drawn, half cleared.
    let mut half = pass("e", PassKind::Lights(Lights::default()), "x.wgsl");
    half.colors = vec![writes("hdr", CLEAR, Blend::Replace)];
    let expected = Traffic {
        written: 256,
        stored: 256,
        pixels: 16,
        fragment_bytes: 8,
        ..Traffic::default()
    };
    check("a cleared half", &half, 0.5, expected);

    // Buffers travel whole: 40 bytes read, 40 written; a texel of 8 bytes a pixel updated.
    let mut compute = pass(
        "f",
        PassKind::Compute(Dispatch::Groups(Amount::Fixed(1, 1, 1))),
        "x.wgsl",
    );
    let update = |name: &str| Update {
        target: name.into(),
        variable: name.into(),
        at: Place::default(),
        slice: Slice::default(),
        one_layer: false,
    };
    compute.reads = vec![read("list"), read("albedo")];
    compute.updates = vec![update("list"), update("hdr")];
    let expected = Traffic {
        read: 40 + 128,
        written: 40 + 256,
        ..Traffic::default()
    };
    check("a dispatch", &compute, 1.0, expected);

    // 64 bytes each way.
    let moved = |kind| pass("g", kind, "");
    let both = |bytes| Traffic {
        read: bytes,
        written: bytes,
        ..Traffic::default()
    };
    let (from, to) = (read("hdr"), read("other"));
    let copy = PassKind::Copy {
        from: from.clone(),
        to: to.clone(),
    };
    check("a copy", &moved(copy), 1.0, both(256));
    check(
        "history",
        &moved(PassKind::History { from, to }),
        1.0,
        both(256),
    );
    let resolve = PassKind::Resolve {
        from: read("samples"),
        to: read("hdr"),
    };
    let expected = Traffic {
        read: 1024,
        written: 256,
        ..Traffic::default()
    };
    check("a resolve", &moved(resolve), 1.0, expected);

    // Levels of 16, 4 and 1 texels of 4 bytes: reads 80, writes 20.
    let mips = PassKind::Mips {
        target: read("pyramid"),
        reduction: Reduction::Max,
    };
    let expected = Traffic {
        read: 80,
        written: 20,
        ..Traffic::default()
    };
    check("mips", &moved(mips), 1.0, expected);

    // A colour of 256 bytes, a buffer of 40, depth of 128; its stencil of 32 apart.
    let mut clear = pass("h", PassKind::Clear, "");
    clear.colors = vec![writes("hdr", CLEAR, Blend::Replace)];
    clear.updates = vec![update("list")];
    let mut stencil = Stencil::new(Place::default());
    stencil.load = StencilClear::To(1);
    clear.depth = Some(DepthAttachment {
        stencil: Some(stencil),
        ..depth("marks", CLEAR, true)
    });
    let expected = Traffic {
        written: 256 + 40 + 128,
        stencil: 32,
        ..Traffic::default()
    };
    check("a clear", &clear, 1.0, expected);

    // Two views of 16 texels of 4 bytes, each layer once.
    let shadow = Shadow {
        views: ShadowViews::Lights(ShadowLights::Spot),
        faces: Faces::Material,
        near: Shadow::NEAR,
    };
    let mut shadow = pass("i", PassKind::Shadow(shadow), "");
    shadow.depth = Some(depth("map", CLEAR, true));
    let expected = Traffic {
        written: 128,
        stored: 128,
        pixels: 32,
        fragment_bytes: 8,
        ..Traffic::default()
    };
    check("two shadow views", &shadow, 2.0, expected);
}
