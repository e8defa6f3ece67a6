//! Pictures of targets against values computed here.
#![allow(clippy::unwrap_used)]

use lightbench_assets::files::Files;
use lightbench_render::description::{PassDesc, PassKind, PipelineDesc, TargetDesc, TargetSize};
use lightbench_render::frame::Frame;
use lightbench_render::inspect::{
    BINS, Between, Channels, ColorMap, Inspection, Inspector, Measured,
};
use lightbench_render::readback::read_bytes;
use lightbench_render::targets::Targets;
use lightbench_render::{Format, Gpu, GpuOptions, Place};

/// The picture of one texel of a target of that format, cleared to a value.
fn look(gpu: &Gpu, format: &str, clear: [f64; 4], change: impl FnOnce(&mut Inspection)) -> [u8; 4] {
    let desc = PipelineDesc {
        targets: vec![TargetDesc {
            size: TargetSize::Absolute(3, 2),
            ..TargetDesc::new(
                "target",
                Place::default(),
                Format::from_name(format).unwrap(),
            )
        }],
        ..PipelineDesc::default()
    };
    let targets = Targets::new(gpu, &desc, None, (3, 2), 0, &[]);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    fill(&mut encoder, &targets, clear);

    let mut request = Inspection::suited(&desc, 1, "target", 10.0).unwrap();
    change(&mut request);
    let mut inspector = Inspector::new(gpu);
    inspector.look(&Files::shipped(), Some(request));
    let mut frame = Frame::default();
    (frame.data.near, frame.data.far) = (0.5, 50.0);
    let pass = PassDesc::new("any", Place::default(), PassKind::Clear);
    let mut after = |index| {
        let between = Between {
            index,
            pass: &pass,
            list: None,
            targets: &targets,
            frame: &frame,
        };
        inspector.after_pass(&between, &mut encoder);
        inspector.picture().is_some()
    };
    assert!(!after(0), "that was another pass");
    assert!(after(1));
    assert_eq!(inspector.take_problem(), None);
    gpu.queue.submit([encoder.finish()]);
    let bytes = read_bytes(gpu, inspector.picture().unwrap()).unwrap();
    gpu.check().unwrap();
    assert_eq!(bytes.len(), 3 * 2 * 4);
    assert!(bytes.chunks(4).all(|texel| texel == &bytes[..4]));
    [bytes[0], bytes[1], bytes[2], bytes[3]]
}

/// Clears the target to a value: the first of `clear` for depth.
fn fill(encoder: &mut wgpu::CommandEncoder, targets: &Targets, clear: [f64; 4]) {
    let target = targets.get("target").unwrap();
    let depth = target.texture.format().has_depth_aspect();
    let [r, g, b, a] = clear;
    let color = (!depth).then_some(wgpu::RenderPassColorAttachment {
        view: &target.view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
            store: wgpu::StoreOp::Store,
        },
    });
    let depth = depth.then_some(wgpu::RenderPassDepthStencilAttachment {
        view: &target.view,
        depth_ops: Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(r as f32),
            store: wgpu::StoreOp::Store,
        }),
        stencil_ops: None,
    });
    let colors = [color];
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: if depth.is_some() { &[] } else { &colors },
        depth_stencil_attachment: depth,
        ..Default::default()
    });
}

/// IEC 61966-2-1, to 8 bits.
fn srgb(linear: f64) -> u8 {
    let coded = if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    };
    (coded * 255.0).round() as u8
}

fn gpu() -> Gpu {
    Gpu::open(&GpuOptions::default()).unwrap()
}

#[test]
fn light_is_coded_as_srgb_and_ranges_are_stretched() {
    let gpu = gpu();
    let value = [0.25, 0.5, 1.5, 1.0];
    let shown = look(&gpu, "rgba16float", value, |_| {});
    assert_eq!(shown, [srgb(0.25), srgb(0.5), 255, 255]);
    let shown = look(&gpu, "rgba16float", value, |inspection| {
        (inspection.low, inspection.high) = (0.25, 2.25);
    });
    assert_eq!(shown, [0, srgb(0.125), srgb(0.625), 255]);
}

#[test]
fn single_channels_are_grey_and_integers_keep_their_steps() {
    let gpu = gpu();
    let shown = look(&gpu, "rgba8unorm", [0.2, 0.4, 0.6, 0.8], |inspection| {
        inspection.channels = Channels::Alpha;
    });
    assert_eq!(shown, [204, 204, 204, 255]);
    let shown = look(&gpu, "rg16uint", [65535.0, 13107.0, 0.0, 0.0], |_| {});
    assert_eq!(shown, [255, 51, 0, 255]);
    let shown = look(&gpu, "r8uint", [51.0, 0.0, 0.0, 0.0], |_| {});
    assert_eq!(shown, [51, 51, 51, 255]);
}

#[test]
fn depth_is_shown_as_a_distance() {
    let gpu = gpu();
    // A surface 4 m away: reversed depth is near · (far − z) / (z · (far − near)).
    let depth = 0.5 * (50.0 - 4.0) / (4.0 * (50.0 - 0.5));
    let shown = look(&gpu, "depth32float", [depth, 0.0, 0.0, 0.0], |inspection| {
        inspection.map = ColorMap::Data;
        (inspection.low, inspection.high) = (0.0, 8.0);
    });
    assert!(
        (127..=128).contains(&shown[0]) && shown[0] == shown[2],
        "{shown:?}"
    );
    // What nothing covers is at the far plane, beyond the range.
    let far = look(&gpu, "depth32float", [0.0; 4], |inspection| {
        inspection.map = ColorMap::Data;
    });
    assert_eq!(far, [255, 255, 255, 255]);
}

#[test]
fn false_colours_are_viridis_and_what_is_no_number_is_magenta() {
    let gpu = gpu();
    let shown = |value: f64| {
        look(&gpu, "r32float", [value, 0.0, 0.0, 0.0], |inspection| {
            inspection.map = ColorMap::FalseColor;
        })
    };
    // Entries 0, 128 and 255 of the published table.
    for (value, table) in [
        (0.0, [68, 1, 84]),
        (0.502, [33, 145, 140]),
        (1.0, [253, 231, 37]),
    ] {
        let color = shown(value);
        let near = |i: usize| u8::abs_diff(color[i], table[i]) <= 6;
        assert!(
            near(0) && near(1) && near(2),
            "{value}: {color:?}, not {table:?}"
        );
    }
    assert_eq!(shown(f64::NAN), [255, 0, 255, 255]);
}

/// What is measured of a target whose texels are these floats, over a range.
fn measure(gpu: &Gpu, texels: &[f32], (width, height): (u32, u32), range: [f32; 2]) -> Measured {
    let desc = PipelineDesc {
        targets: vec![TargetDesc {
            size: TargetSize::Absolute(width, height),
            ..TargetDesc::new(
                "target",
                Place::default(),
                Format::from_name("r32float").unwrap(),
            )
        }],
        ..PipelineDesc::default()
    };
    let targets = Targets::new(gpu, &desc, None, (width, height), 0, &[]);
    let texture = &targets.get("target").unwrap().texture;
    let values = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        // Rows of copies begin at multiples of 256 bytes.
        size: 256 * u64::from(height),
        usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    for (row, values_of_row) in texels.chunks(width as usize).enumerate() {
        let bytes: Vec<u8> = values_of_row.iter().flat_map(|v| v.to_le_bytes()).collect();
        gpu.queue.write_buffer(&values, 256 * row as u64, &bytes);
    }
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_texture(
        wgpu::TexelCopyBufferInfo {
            buffer: &values,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(256),
                rows_per_image: None,
            },
        },
        texture.as_image_copy(),
        texture.size(),
    );
    let mut request = Inspection::suited(&desc, 0, "target", 10.0).unwrap();
    [request.low, request.high] = range;
    let mut inspector = Inspector::new(gpu);
    inspector.measure(&Files::shipped(), request.clone());
    assert!(inspector.is_measuring());
    let frame = Frame::default();
    let pass = PassDesc::new("any", Place::default(), PassKind::Clear);
    let between = Between {
        index: 0,
        pass: &pass,
        list: None,
        targets: &targets,
        frame: &frame,
    };
    inspector.after_pass(&between, &mut encoder);
    inspector.end_frame(&mut encoder);
    assert_eq!(inspector.take_problem(), None);
    gpu.queue.submit([encoder.finish()]);
    inspector.submitted();
    assert_eq!(inspector.take_measured(), None, "nothing waits for it");
    gpu.wait(60).unwrap();
    let measured = inspector.take_measured().unwrap();
    assert!(!inspector.is_measuring());
    assert_eq!(measured.request, request);
    measured
}

#[test]
fn values_are_counted_where_they_belong() {
    let gpu = gpu();
    let texels = [-3.5, 0.0, 0.5, f32::NAN, 1.0, f32::INFINITY, 2.0, -0.0];
    let measured = measure(&gpu, &texels, (4, 2), [0.0, 1.0]);
    let [channel] = measured.channels.as_slice() else {
        panic!("{} channels", measured.channels.len());
    };
    assert_eq!(channel.range, Some([-3.5, 2.0]));
    assert_eq!(measured.range(), Some([-3.5, 2.0]));
    assert_eq!((channel.finite, channel.invalid), (6, 2));
    assert_eq!((channel.below, channel.above), (1, 1));
    let filled: Vec<(usize, u32)> = channel
        .bins
        .iter()
        .copied()
        .enumerate()
        .filter(|(_, count)| *count > 0)
        .collect();
    // Both zeros, the middle, and the upper end with the last part.
    assert_eq!(filled, [(0, 2), (BINS / 2, 1), (BINS - 1, 1)]);
    let nothing = measure(&gpu, &[f32::NAN; 8], (4, 2), [0.0, 1.0]);
    assert_eq!(nothing.range(), None);
    assert_eq!(nothing.channels[0].invalid, 8);
}

/// Many workgroups, which keep counts of their own, and sizes that fill none of them.
#[test]
fn all_texels_of_a_target_are_counted_once() {
    let gpu = gpu();
    let (width, height) = (61, 37);
    let texels: Vec<f32> = (0..width * height)
        .map(|index| ((index * 7919) % 1009) as f32 - 500.0)
        .collect();
    let range = [-250.0, 250.0];
    let measured = measure(&gpu, &texels, (width, height), range);
    let channel = &measured.channels[0];
    assert_eq!(channel.finite, width * height);
    let least = texels.iter().copied().fold(f32::INFINITY, f32::min);
    let most = texels.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    assert_eq!(channel.range, Some([least, most]));
    let count = |of: &dyn Fn(f32) -> bool| texels.iter().filter(|v| of(**v)).count() as u32;
    assert_eq!(channel.below, count(&|value| value < range[0]));
    assert_eq!(channel.above, count(&|value| value > range[1]));
    // A part is 7.8125 wide, which single precision has exactly.
    let wide = (range[1] - range[0]) / BINS as f32;
    for (bin, counted) in channel.bins.iter().enumerate() {
        let low = range[0] + bin as f32 * wide;
        let is_last = bin == BINS - 1;
        let inside =
            |value: f32| value >= low && (value < low + wide || is_last && value == range[1]);
        assert_eq!(*counted, count(&inside), "bin {bin}");
    }
}
