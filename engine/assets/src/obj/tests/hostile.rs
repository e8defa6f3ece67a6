//! Files that are damaged, cut short, or no models at all.

use std::fs;

use rand::Rng;
use rand::seq::IndexedRandom;

use super::{Fixture, SQUARE, check, warnings};
use crate::{TextureId, fuzz};

#[test]
fn damaged_pictures_become_the_placeholder() {
    let fixture = Fixture::new();
    fixture.png("whole.png", |x, y| [x as u8, y as u8, 7, 255]);
    let whole = fs::read(fixture.folder.path().join("whole.png")).unwrap();
    fixture.write("cut.png", &whole[..whole.len() / 2]);
    fixture.write("empty.png", "");
    fixture.write("text.png", "I am a picture");
    let names = ["whole", "cut", "empty", "text"];
    let library: String = names
        .iter()
        .map(|name| format!("newmtl {name}\nmap_Kd {name}.png\n"))
        .collect();
    fixture.write("a.mtl", library);
    let faces: String = names
        .iter()
        .map(|name| format!("usemtl {name}\nf 1 2 3\n"))
        .collect();
    let model = fixture.model(format!("mtllib a.mtl\n{SQUARE}{faces}"));
    assert_eq!(model.textures.len(), 1);
    let placeholders = model
        .materials
        .iter()
        .map(|material| material.base_color_texture);
    let placeholder = Some(TextureId::PLACEHOLDER);
    assert_eq!(
        placeholders.collect::<Vec<_>>(),
        [Some(TextureId(1)), placeholder, placeholder, placeholder]
    );
    let found = warnings(&model);
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(found[0].starts_with("cut.png: "), "{found:?}");
    assert_eq!(
        found[1],
        "empty.png: the file is empty; save or copy it again"
    );
    assert!(
        found[2].starts_with("text.png: this is no picture"),
        "{found:?}"
    );
}

#[test]
fn hostile_files_give_one_line_each() {
    let fixture = Fixture::new();
    for (content, expected) in [
        ("", "x.obj: the file is empty; save or copy it again"),
        (
            "hello\n",
            "x.obj: there are no vertices in it; is it an OBJ file, and complete?",
        ),
        (
            SQUARE,
            "x.obj: there are no faces in it; export the model with its faces",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
            "x.obj: no face has an area, so there is nothing to draw; export the model again",
        ),
        (
            "v 0 0 0\nv 1 nan 0\n",
            "x.obj, line 2: a vertex has the coordinate nan; export the model again",
        ),
        (
            "v 0 0 1e999\n",
            "x.obj, line 1: a vertex has the coordinate 1e999; export the model again",
        ),
        (
            "v 0 0 1e30\n",
            "x.obj, line 1: the coordinate 1e30 is too large; scale the model down",
        ),
        (
            "v 0 0 0\nv 1 0",
            "x.obj, line 2: a vertex needs three numbers; is the file complete?",
        ),
        ("v 1,5 0 0\n", "x.obj, line 1: `1,5` is no number"),
        (
            "v 0 0 0\nf 1 1 x\n",
            "x.obj, line 2: `x` is no number of a vertex",
        ),
        (
            "v 0 0 0\nf 1 1 1/1/1/1\n",
            "x.obj, line 2: `1/1/1/1` is no corner of a face",
        ),
        (
            "v 0 0 0\nf 1 1 /1\n",
            "x.obj, line 2: a face names texture coordinate 1, and the file has 0; is the file complete?",
        ),
        ("v 0 0 0\nf 1 1 //\n", "x.obj, line 2: `//` names no vertex"),
        (
            "v 0 0 0\n\nf 1 1 2\nf 1 1 3\n",
            "x.obj, line 3: a face names vertex 2, and the file has 1; is the file complete?",
        ),
        (
            "v 0 0 0\nf 1 1 0\n",
            "x.obj, line 2: a face names vertex 0, and the file has 1; is the file complete?",
        ),
        (
            "v 0 0 0\nf 1 1 -2\n",
            "x.obj, line 2: a face names vertex -2, and the file has 1; is the file complete?",
        ),
        (
            "v 0 0 0\nf 1 1 99999999999999999999\n",
            "x.obj, line 2: `99999999999999999999` is no number of a vertex",
        ),
        (
            "v 0 0 0\nf 1 1 1//7\n",
            "x.obj, line 2: a face names normal 7, and the file has 0; is the file complete?",
        ),
    ] {
        let found = fixture.refused(content);
        // What is named first may be checked in another order.
        if content.contains(" /1\n") {
            assert!(
                found == expected || found == "x.obj, line 2: `/1` names no vertex",
                "{found}"
            );
        } else {
            assert_eq!(found, expected, "{content:?}");
        }
    }
    fixture.png("p.png", |_, _| [9; 4]);
    let png = fs::read(fixture.folder.path().join("p.png")).unwrap();
    let message = "x.obj: this is a binary file, no OBJ or MTL text; export the model as OBJ";
    assert_eq!(fixture.refused(png), message);
    fs::create_dir(fixture.folder.path().join("folder.obj")).unwrap();
    let message = fixture.load("folder.obj").unwrap_err().to_string();
    assert!(
        message.ends_with("folder.obj is a folder; name a file in it"),
        "{message}"
    );
    let message = fixture.load("gone.obj").unwrap_err().to_string();
    assert!(
        message.starts_with("there is no file `gone.obj`"),
        "{message}"
    );
}

/// Thousands of damaged files: whatever they say, there is a model that can be
/// drawn or one line that says why not.
#[test]
fn damaged_files_never_panic() {
    let mut random = fuzz::random();
    let fixture = Fixture::new();
    fixture.png("a.png", |x, y| [x as u8 * 9, y as u8, 0, 255]);
    let library = "newmtl a\nKd 1 0.5 0\nKs 0.1 0.1 0.1\nNs 20\nmap_Kd a.png\nnewmtl b c\nKd 0 0 1\nd 0.5\nbump -bm 2 a.png\n";
    let model = "mtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nv 0.5 0.5 2e-3\nvt 0 0\nvt 1 0\nvt 1 1\n\
                 vn 0 0 1\nvn 0.6 0 0.8\nusemtl a\nf 1/1/1 2/2/1 3/3/2 4/1/2\nusemtl b c\nf 1//1 2//2 5//1\n\
                 s 1\nf -5 -4 -3 -1 5\nf 3 4 5 \\\n1\ng x\nl 1 2\n";
    let words = [
        "nan",
        "-1",
        "0",
        "1e38",
        "-1e-45",
        "inf",
        "/",
        "//",
        "1//",
        "v",
        "f",
        "vt",
        "vn",
        "usemtl",
        "mtllib",
        "\\",
        "\n",
        "#",
        "9999999999",
        "-9999999999",
        "1/1/1/1",
        "newmtl",
        "Kd",
        "map_Kd",
        "..",
        "\u{0}",
        "ñ",
        "\t",
        "",
    ];
    let mutate = |random: &mut rand_pcg::Pcg64, text: &str| -> Vec<u8> {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for _ in 0..random.random_range(1..4) {
            let line = random.random_range(0..lines.len());
            let mut parts: Vec<&str> = lines[line].split(' ').collect();
            let part = random.random_range(0..parts.len());
            match random.random_range(0..6) {
                0 => parts[part] = words.choose(random).unwrap(),
                1 => parts.insert(part, words.choose(random).unwrap()),
                2 => drop(parts.remove(part)),
                3 => parts.truncate(part),
                4 => {
                    let other = random.random_range(0..parts.len());
                    parts.swap(part, other);
                }
                _ => {
                    let other = random.random_range(0..lines.len());
                    lines.swap(line, other);
                    continue;
                }
            }
            lines[line] = parts.join(" ");
        }
        let mut bytes = lines.join("\n").into_bytes();
        if random.random_bool(0.2) {
            let at = random.random_range(0..bytes.len().max(1));
            bytes.truncate(at);
        }
        if random.random_bool(0.2) && !bytes.is_empty() {
            let at = random.random_range(0..bytes.len());
            bytes[at] = random.random();
        }
        bytes
    };
    let (mut drawn, mut refused) = (0, 0);
    let rounds = fuzz::rounds(4000, 1_000_000);
    for _ in 0..rounds {
        fixture.write("x.obj", mutate(&mut random, model));
        fixture.write("x.mtl", mutate(&mut random, library));
        match fixture.load("x.obj") {
            Ok(model) => {
                check(&model);
                drawn += 1;
            }
            Err(error) => {
                let message = error.to_string();
                assert!(
                    !message.contains('\n') && message.contains("x.obj"),
                    "{message}"
                );
                refused += 1;
            }
        }
    }
    println!("{drawn} drawn, {refused} refused");
    // Both happen often, or the damage is too great or too small to tell.
    assert!(drawn > rounds / 5 && refused > rounds / 5);
}
