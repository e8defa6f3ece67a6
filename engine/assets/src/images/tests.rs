#![allow(clippy::unwrap_used)]
use std::fs;
use std::io::Cursor;

use image::{DynamicImage, ImageFormat};

use super::*;
use crate::TextureFormat;

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn gradient() -> DynamicImage {
    let pixel = |x, y| image::Rgba([(x * 7) as u8, (y * 11) as u8, 128, 255]);
    DynamicImage::ImageRgba8(image::RgbaImage::from_fn(33, 17, pixel))
}

#[test]
fn png_and_exr_come_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("práctica ñ.png");
    let bytes: Vec<u8> = (0..7 * 5 * 4).map(|i| (i * 37) as u8).collect();
    save_png(&path, 7, 5, &bytes).unwrap();
    let picture = read_picture(&path).unwrap();
    assert_eq!((picture.width, picture.height), (7, 5));
    assert_eq!(picture.pixels, Pixels::Rgba8(bytes));

    let path = folder.path().join("x.exr");
    let mut values: Vec<f32> = (0..7 * 5 * 4).map(|i| (i as f32 - 40.0) * 0.1).collect();
    values[..5].copy_from_slice(&[1e30, -1e-30, f32::INFINITY, 0.1, f32::MIN_POSITIVE]);
    save_exr(&path, 7, 5, &values).unwrap();
    assert_eq!(read_picture(&path).unwrap().pixels, Pixels::RgbaF32(values));
    // Nothing but the two files: no temporary one is left.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn the_same_picture_in_all_formats() {
    let image = gradient();
    let rgb = DynamicImage::ImageRgb8(image.to_rgb8());
    let expected = image.to_rgba8().into_raw();
    for (format, image) in [
        (ImageFormat::Png, &image),
        (ImageFormat::Tga, &image),
        (ImageFormat::Bmp, &rgb),
    ] {
        let path = format!("x.{}", format.extensions_str()[0]);
        let picture = decode_picture(&path, &encoded(image, format)).unwrap();
        assert_eq!(picture.pixels, Pixels::Rgba8(expected.clone()), "{path}");
    }
    // JPEG loses a little.
    let Pixels::Rgba8(found) = decode_picture("x.jpg", &encoded(&rgb, ImageFormat::Jpeg))
        .unwrap()
        .pixels
    else {
        panic!("8 bits a channel")
    };
    let error: u32 = found
        .iter()
        .zip(&expected)
        .map(|(a, b)| u32::from(a.abs_diff(*b)))
        .sum();
    assert!(error < 4 * expected.len() as u32, "{error}");
    // The content decides, not the name.
    assert!(decode_picture("x.jpg", &encoded(&image, ImageFormat::Png)).is_ok());
}

#[test]
fn sixteen_bits_and_grey_keep_their_values() {
    let wide = image::ImageBuffer::from_fn(3, 1, |x, _| {
        image::Luma([[0_u16, 32_896, 65_535][x as usize]])
    });
    let bytes = encoded(&DynamicImage::ImageLuma16(wide), ImageFormat::Png);
    let picture = decode_picture("x.png", &bytes).unwrap();
    let expected = vec![0, 0, 0, 255, 128, 128, 128, 255, 255, 255, 255, 255];
    assert_eq!(picture.pixels, Pixels::Rgba8(expected));

    let grey =
        image::GrayAlphaImage::from_fn(2, 1, |x, _| image::LumaA([[10, 250][x as usize], 7]));
    let bytes = encoded(&DynamicImage::ImageLumaA8(grey), ImageFormat::Png);
    let picture = decode_picture("x.png", &bytes).unwrap();
    assert_eq!(
        picture.pixels,
        Pixels::Rgba8(vec![10, 10, 10, 7, 250, 250, 250, 7])
    );
}

#[test]
fn purposes_and_high_dynamic_range_choose_the_format() {
    let png = encoded(&gradient(), ImageFormat::Png);
    let color = decode_texture("x.png", &png, Purpose::Color).unwrap();
    let data = decode_texture("x.png", &png, Purpose::Data).unwrap();
    assert_eq!(color.format, TextureFormat::Rgba8Srgb);
    assert_eq!(data.format, TextureFormat::Rgba8Linear);
    assert_eq!(color.mips[0], data.mips[0]);
    assert_eq!(color.mips.len(), 6);

    let values: Vec<f32> = [0.25, 2.0, 1e6, 1.0].repeat(6);
    let exr = encode_exr("x.exr", 3, 2, &values).unwrap();
    let texture = decode_texture("x.exr", &exr, Purpose::Color).unwrap();
    assert_eq!(texture.format, TextureFormat::Rgba16Float);
    assert_eq!(
        texture.pixel(0, 2, 1).unwrap().to_array(),
        [0.25, 2.0, 65504.0, 1.0]
    );

    let float = image::Rgb32FImage::from_pixel(16, 4, image::Rgb([0.5, 4.0, 100.0]));
    let hdr = encoded(&DynamicImage::ImageRgb32F(float), ImageFormat::Hdr);
    let texture = decode_texture("sky.hdr", &hdr, Purpose::Color).unwrap();
    assert_eq!(texture.format, TextureFormat::Rgba16Float);
    let pixel = texture.pixel(0, 3, 3).unwrap();
    // A shared exponent for 100 leaves steps of 0.5.
    assert!((pixel.z - 100.0).abs() < 0.5 && (pixel.y - 4.0).abs() <= 0.5);
}

/// A chunk of a PNG with its checksum.
fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut body = kind.to_vec();
    body.extend(data);
    let crc = !body.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    });
    let mut chunk = (data.len() as u32).to_be_bytes().to_vec();
    chunk.extend(body);
    chunk.extend(crc.to_be_bytes());
    chunk
}

#[test]
fn a_header_that_claims_too_much_is_refused_at_once() {
    let side = 60_000_u32.to_be_bytes();
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    png.extend(chunk(
        b"IHDR",
        &[&side[..], &side, &[8, 6, 0, 0, 0]].concat(),
    ));
    png.extend(chunk(b"IDAT", b""));
    let mut bmp = encoded(
        &DynamicImage::ImageRgb8(gradient().to_rgb8()),
        ImageFormat::Bmp,
    );
    bmp[18..26].copy_from_slice(&[0x60, 0xea, 0, 0, 0x60, 0xea, 0, 0]);
    let mut tga = encoded(&gradient(), ImageFormat::Tga);
    tga[12..16].copy_from_slice(&[0x60, 0xea, 0x60, 0xea]);
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n".to_vec();
    let mut exr = encode_exr("x.exr", 4, 4, &[0.5; 64]).unwrap();
    let wide = [59_999_u32.to_le_bytes(); 2].concat();
    for name in [
        &b"dataWindow\0box2i\0\x10\0\0\0"[..],
        b"displayWindow\0box2i\0\x10\0\0\0",
    ] {
        let at = exr
            .windows(name.len())
            .position(|window| window == name)
            .unwrap();
        exr[at + name.len() + 8..at + name.len() + 16].copy_from_slice(&wide);
    }
    let mut jpeg = encoded(
        &DynamicImage::ImageRgb8(gradient().to_rgb8()),
        ImageFormat::Jpeg,
    );
    let frame = jpeg
        .windows(2)
        .position(|pair| pair == [0xff, 0xc0])
        .unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0xea, 0x60, 0xea, 0x60]);
    for (path, bytes) in [
        ("x.png", png),
        ("x.bmp", bmp),
        ("x.tga", tga),
        ("x.hdr", hdr),
        ("x.exr", exr),
        ("x.jpg", jpeg),
    ] {
        let message = decode_picture(path, &bytes).unwrap_err().to_string();
        assert_eq!(
            message,
            format!("{path}: the picture has more than 8192 pixels a side; make it smaller")
        );
    }
}

#[test]
fn damaged_pictures_give_one_line() {
    let image = gradient();
    let rgb = DynamicImage::ImageRgb8(image.to_rgb8());
    let whole = [
        ("x.png", encoded(&image, ImageFormat::Png)),
        ("x.tga", encoded(&image, ImageFormat::Tga)),
        ("x.bmp", encoded(&rgb, ImageFormat::Bmp)),
        ("x.jpg", encoded(&rgb, ImageFormat::Jpeg)),
        (
            "x.hdr",
            encoded(
                &DynamicImage::ImageRgb32F(image.to_rgb32f()),
                ImageFormat::Hdr,
            ),
        ),
        ("x.exr", encode_exr("", 8, 8, &[0.5; 256]).unwrap()),
    ];
    for (path, bytes) in &whole {
        decode_picture(path, bytes).unwrap();
        // Cut anywhere. JPEG alone may give what it has.
        for part in 0..16 {
            let cut = &bytes[..bytes.len() * part / 16];
            if let Err(error) = decode_picture(path, cut) {
                let message = error.to_string();
                assert!(
                    message.starts_with(path) && !message.contains('\n'),
                    "{message}"
                );
            } else {
                assert!(
                    *path == "x.jpg" && part > 0,
                    "{path} cut to {part}/16 was accepted"
                );
            }
        }
    }
    let message = decode_picture("x.png", b"").unwrap_err().to_string();
    assert_eq!(message, "x.png: the file is empty; save or copy it again");
    let message = decode_picture("x.png", b"hello, world, this is text")
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("no picture in a known format"),
        "{message}"
    );
    let cut = &whole[0].1[..100];
    let message = decode_picture("x.png", cut).unwrap_err().to_string();
    assert!(message.contains("save or copy it again"), "{message}");
}

#[test]
fn flipped_bytes_never_panic() {
    use rand::Rng;
    let mut random = crate::fuzz::random();
    let image = gradient();
    let rgb = DynamicImage::ImageRgb8(image.to_rgb8());
    let whole = [
        ("x.png", encoded(&image, ImageFormat::Png)),
        ("x.tga", encoded(&image, ImageFormat::Tga)),
        ("x.bmp", encoded(&rgb, ImageFormat::Bmp)),
        ("x.jpg", encoded(&rgb, ImageFormat::Jpeg)),
        (
            "x.hdr",
            encoded(
                &DynamicImage::ImageRgb32F(image.to_rgb32f()),
                ImageFormat::Hdr,
            ),
        ),
        ("x.exr", encode_exr("", 8, 8, &[0.5; 256]).unwrap()),
    ];
    for (path, bytes) in &whole {
        for _ in 0..crate::fuzz::rounds(400, 200_000) {
            let mut damaged = bytes.clone();
            for _ in 0..random.random_range(1..6) {
                let at = random.random_range(0..damaged.len().min(400));
                damaged[at] = random.random();
            }
            let _ = decode_picture(path, &damaged);
        }
    }
}

#[test]
fn several_pictures_come_in_their_order() {
    let folder = tempfile::tempdir().unwrap();
    for shade in 0..9_u8 {
        save_png(
            folder.path().join(format!("{shade}.png")),
            1,
            1,
            &[shade; 4],
        )
        .unwrap();
    }
    fs::write(folder.path().join("4.png"), "no picture").unwrap();
    let files = crate::files::Files::with_project(folder.path()).unwrap();
    let names: Vec<String> = (0..10).map(|shade| format!("{shade}.png")).collect();
    let paths: Vec<_> = names
        .iter()
        .map(|name| (name.as_str(), Purpose::Data))
        .collect();
    let progress = crate::Progress::new();
    let textures = load_textures(&files, &paths, &progress).unwrap();
    assert_eq!(progress.fraction(), 1.0);
    for (shade, texture) in textures.into_iter().enumerate() {
        match (shade, texture) {
            (4, Err(error)) => assert!(error.to_string().starts_with("4.png: "), "{error}"),
            (9, Err(error)) => assert!(error.to_string().contains("no file `9.png`"), "{error}"),
            (_, texture) => {
                let texture = texture.unwrap();
                assert_eq!(
                    (texture.mips[0][0], &texture.name),
                    (shade as u8, &names[shade])
                );
            }
        }
    }
    progress.cancel();
    assert!(load_textures(&files, &paths, &progress).is_err());
}

#[test]
fn wrong_lengths_and_places_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    assert!(save_png(folder.path().join("x.png"), 2, 2, &[0; 15]).is_err());
    assert!(save_exr(folder.path().join("x.exr"), 0, 0, &[]).is_err());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    let message = save_png(folder.path().join("no/x.png"), 1, 1, &[0; 4])
        .unwrap_err()
        .to_string();
    assert!(
        message.ends_with("no: there is no such file or folder"),
        "{message}"
    );
    let message = read_picture(folder.path()).unwrap_err().to_string();
    assert!(
        message.ends_with("is a folder; name a file in it"),
        "{message}"
    );
}
