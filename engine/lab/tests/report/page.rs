//! The page of 13 pipelines at 4 points: its size, and that it works in a browser.

use std::collections::HashSet;

use lightbench_lab::report::write_study;

use super::{browser, data};

/// What a reader does, as a script that waits for the viewer to draw; it writes what it saw into
/// attributes of the body.
const READER: &str = r##"<script>
(async () => {
  const id = (name) => document.getElementById(name);
  const seen = document.body.dataset;
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const drawn = async (act) => {
    const before = Number(id("viewer").dataset.drawn ?? 0);
    act();
    for (let i = 0; i < 400 && Number(id("viewer").dataset.drawn ?? 0) <= before; i++) await wait(25);
  };
  const canvas = id("view-canvas");
  const pixels = (canvas) => {
    const sheet = document.createElement("canvas");
    [sheet.width, sheet.height] = [canvas.width, canvas.height];
    const pen = sheet.getContext("2d", { willReadFrequently: true });
    pen.drawImage(canvas, 0, 0);
    return pen.getImageData(0, 0, sheet.width, sheet.height).data;
  };
  const shown = () => {
    const all = pixels(canvas);
    let sum = 0;
    for (let i = 0; i < all.length; i += 4) sum = (sum * 31 + all[i] + 7 * all[i + 1]) % 1000003;
    return sum;
  };
  const set = (control, value, event) => { control.value = value; control.dispatchEvent(new Event(event)); };
  try {
    await drawn(() => set(id("view-x"), 0, "input"));
    const right = shown();
    await drawn(() => set(id("view-x"), 100, "input"));
    seen.slider = String(shown() !== right);
    seen.share = id("view-x-value").textContent;
    await drawn(() => id("view-flip").click());
    const first = shown();
    await drawn(() => id("view-flip").click());
    seen.flip = String(shown() !== first);
    await drawn(() => id("view-difference").click());
    seen.difference = id("view-status").textContent;
    await drawn(() => id("view-grid").click());
    seen.grid = id("view-status").textContent;
    await drawn(() => id("view-split").click());
    await drawn(() => set(id("view-zoom"), "4", "change"));
    const box = canvas.getBoundingClientRect();
    id("view-stage").dispatchEvent(new PointerEvent("pointermove", { clientX: box.left + 5, clientY: box.top + 5 }));
    seen.pixel = id("view-pixel").textContent;
    const before = shown();
    seen.hdr = String(!id("view-exposure").disabled);
    await drawn(() => set(id("view-exposure"), "-3", "input"));
    seen.exposure = String(shown() !== before);

    const table = document.querySelector("#answer table");
    const heading = [...table.tHead.rows[0].cells].find((cell) => cell.textContent.startsWith("Frame"));
    heading.querySelector("button").click();
    const column = [...table.tHead.rows[0].cells].indexOf(heading);
    const values = [...table.tBodies[0].rows].map((row) => parseFloat(row.cells[column].textContent));
    seen.sorted = String(values.every((v, i) => i === 0 || values[i - 1] <= v));
    seen.sort = heading.getAttribute("aria-sort");

    await drawn(() => set(id("point"), "3", "change"));
    seen.points = [...document.querySelectorAll(".at")].filter((at) => getComputedStyle(at).display !== "none")
      .map((at) => at.id).join(" ");
    const delta = document.querySelector("canvas.shot[data-point='3']");
    for (let i = 0; i < 8000 && delta && delta.dataset.filled !== "true"; i++) await wait(25);
    if (delta) {
      const rgb = pixels(delta);
      seen.delta = `${delta.id} ${[...rgb.slice(4 * 12345, 4 * 12345 + 3)].join(" ")}`;
    }
    seen.done = "true";
  } catch (error) {
    seen.done = String(error);
  }
})();
</script>"##;

/// The values of an attribute.
fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let key = format!(" {name}=\"");
    page.match_indices(&key)
        .map(|(at, _)| page[at + key.len()..].split('"').next().unwrap())
        .collect()
}

#[test]
fn thirteen_pipelines_at_four_points_work_in_a_browser() {
    let folder = tempfile::tempdir().unwrap();
    let mut study = data::study(13, 4, [640, 360]);
    let files = write_study(&mut study, folder.path()).unwrap();
    let page = std::fs::read_to_string(&files.html).unwrap();
    if let Some(kept) = std::env::var_os("LIGHTBENCH_KEEP_REPORT") {
        std::fs::copy(&files.html, kept).unwrap();
    }
    assert!(page.len() < 25_000_000, "{} bytes", page.len());
    // Questions and tables ask for counters by their names.
    assert!(page.contains("Lights on lists (lights_on_lists): "));

    // All references of the page and of its script lead somewhere.
    let ids = attributes(&page, "id");
    let unique: HashSet<&str> = ids.iter().copied().collect();
    assert_eq!(ids.len(), unique.len(), "ids repeat");
    for target in attributes(&page, "href") {
        let known = match target.strip_prefix('#') {
            Some(id) => unique.contains(id),
            None => folder.path().join(target).is_file(),
        };
        assert!(known, "{target}");
    }
    for reference in ["data-of", "for", "aria-labelledby"] {
        for target in attributes(&page, reference) {
            assert!(unique.contains(target), "{reference}: {target}");
        }
    }
    for word in ["http://", "https://", "@import"] {
        assert!(!page.contains(word), "{word}");
    }

    let copy = folder.path().join("read.html");
    std::fs::write(
        &copy,
        page.replacen("</body>", &format!("{READER}</body>"), 1),
    )
    .unwrap();
    let Some((document, errors)) = browser::open(&copy) else {
        return;
    };
    let said: Vec<&str> = errors
        .lines()
        .filter(|line| line.contains("CONSOLE"))
        .collect();
    assert!(said.is_empty(), "{said:?}");
    let body = document.find("<body").unwrap();
    let body = &document[body..];
    let body = &body[..body.find('>').unwrap()];
    let seen = |name: &str| {
        let key = format!("data-{name}=\"");
        let value = body.split(key.as_str()).nth(1);
        value.and_then(|rest| rest.split('"').next()).unwrap_or("")
    };
    assert_eq!(seen("done"), "true", "{body}");
    for what in ["slider", "flip", "sorted", "hdr", "exposure"] {
        assert_eq!(seen(what), "true", "{what}: {body}");
    }
    assert_eq!(seen("share"), "100 %");
    assert_eq!(seen("sort"), "ascending");
    assert_eq!(seen("points"), "at-3");
    assert!(seen("difference").contains("times 8"), "{body}");
    assert!(seen("grid").contains("forward multi pass"), "{body}");
    assert!(seen("pixel").starts_with("Pixel "), "{body}");
    // A picture that is held as a difference comes out as it was, to the bit.
    let delta = seen("delta");
    let (shot, rgb) = delta
        .split_once(' ')
        .expect("a picture is held as a difference");
    let number: usize = shot.split('-').nth(1).unwrap().parse().unwrap();
    let picture = study.points[2].comparison.pipelines[number]
        .picture
        .as_ref();
    let [r, g, b, _] = picture.unwrap().pixels[12_345];
    assert_eq!(rgb, format!("{r} {g} {b}"));
}
