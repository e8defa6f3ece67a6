// The picture viewer: all pictures of a point, drawn on one canvas from their pixels.
(() => {
  const id = (name) => document.getElementById(name);
  const viewer = id("viewer");
  if (!viewer) return;
  const [left, right, slider, zoom] = ["view-a", "view-b", "view-x", "view-zoom"].map(id);
  const [gain, exposure] = ["view-gain", "view-exposure"].map(id);
  const [stage, canvas, status, pixel] = ["view-stage", "view-canvas", "view-status", "view-pixel"].map(id);
  const [choice, boxes] = ["view-choice", "view-boxes"].map(id);
  const context = canvas.getContext("2d");
  const shots = [...document.querySelectorAll(".shot")];

  // Pixels of an image, exactly as they are in the file.
  const pixels = async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const sheet = document.createElement("canvas");
    [sheet.width, sheet.height] = [image.naturalWidth, image.naturalHeight];
    const pen = sheet.getContext("2d", { willReadFrequently: true });
    pen.drawImage(image, 0, 0);
    return pen.getImageData(0, 0, sheet.width, sheet.height);
  };
  const reference = (shot) =>
    shots.find((other) => other.dataset.reference && other.dataset.point === shot.dataset.point);

  // Decoded pictures by their ids; a few points' worth stay.
  const kept = new Map();
  const load = (shot) => {
    if (!kept.has(shot.id)) {
      if (kept.size > 60) kept.delete(kept.keys().next().value);
      kept.set(shot.id, decode(shot));
    }
    return kept.get(shot.id);
  };
  const decode = async (shot) => {
    const picture = await pixels(shot.dataset.delta ?? shot.src);
    if (shot.dataset.delta) {
      const base = (await load(reference(shot))).picture;
      for (let i = 0; i < picture.data.length; i++) {
        picture.data[i] = i % 4 === 3 ? 255 : (picture.data[i] + base.data[i]) & 255;
      }
    }
    const linear = document.querySelector(`img.linear[data-of="${shot.id}"]`);
    return { picture, linear: linear ? halves(await pixels(linear.src)) : null };
  };
  // Half floats, whose high bytes lie above their low bytes: IEEE 754-2019, binary16.
  const halves = (bytes) => {
    const count = bytes.data.length / 2;
    const values = new Float32Array(count);
    for (let i = 0; i < count; i++) {
      const bits = (bytes.data[i] << 8) | bytes.data[count + i];
      const [exponent, fraction] = [(bits >> 10) & 31, bits & 1023];
      const size = exponent === 0 ? fraction * 2 ** -24
        : exponent === 31 ? (fraction ? NaN : Infinity)
        : (1 + fraction / 1024) * 2 ** (exponent - 15);
      values[i] = bits & 32768 ? -size : size;
    }
    return values;
  };
  // The transfer function of sRGB, IEC 61966-2-1.
  const coded = (x) => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
  const exposed = ({ picture, linear }, stops) => {
    if (!linear || stops === 0) return picture;
    const shown = new ImageData(picture.width, picture.height);
    const scale = 2 ** stops;
    for (let i = 0; i < linear.length; i++) {
      const x = linear[i] * scale;
      shown.data[i] = i % 4 === 3 ? 255 : Number.isNaN(x) ? 0 : coded(Math.min(Math.max(x, 0), 1));
    }
    return shown;
  };
  const less = (a, b, factor) => {
    const shown = new ImageData(a.width, a.height);
    for (let i = 0; i < a.data.length; i++) {
      shown.data[i] = i % 4 === 3 ? 255 : Math.abs(a.data[i] - b.data[i]) * factor;
    }
    return shown;
  };

  // Canvases fill themselves in: pictures that are held as differences.
  const fill = async (some) => {
    for (const shot of some.filter((shot) => shot.dataset.delta && !shot.dataset.filled)) {
      const { picture } = await load(shot);
      [shot.width, shot.height] = [picture.width, picture.height];
      shot.getContext("2d").putImageData(picture, 0, 0);
      shot.dataset.filled = "true";
    }
  };

  let mode = "split";
  let flipped = false;
  let [centreX, centreY] = [0.5, 0.5];
  let shown = null;
  const current = () => (id("point")?.value ?? shots[0].dataset.point) || "1";
  const here = () => shots.filter((shot) => shot.dataset.point === current() || !id("point"));
  const byId = (name) => shots.find((shot) => shot.id === name);

  const chosen = () => [...boxes.querySelectorAll("input:checked")].map((box) => byId(box.value));
  // Fills the lists of pictures, keeping what was chosen where the point has it too.
  const list = () => {
    const stem = (name) => name.replace(/-\d+$/, "");
    const several = Boolean(id("point"));
    const same = (select) => here().find((shot) => several && stem(shot.id) === stem(select.value));
    const before = [left, right].map(same);
    const pictures = here().filter((shot) => shot.dataset.kind === "picture");
    const usual = [pictures[0], pictures[1] ?? here()[1] ?? pictures[0]];
    [left, right].forEach((select, i) => {
      select.replaceChildren(...here().map((shot) => new Option(shot.dataset.label, shot.id)));
      select.value = (before[i] ?? usual[i] ?? here()[0]).id;
    });
    boxes.replaceChildren(...here().map((shot) => {
      const [label, box] = [document.createElement("label"), document.createElement("input")];
      [box.type, box.value, box.checked] = ["checkbox", shot.id, pictures.slice(0, 4).includes(shot)];
      box.addEventListener("change", draw);
      label.append(box, shot.dataset.label);
      return label;
    }));
  };

  const sheetOf = (data) => {
    const sheet = document.createElement("canvas");
    [sheet.width, sheet.height] = [data.width, data.height];
    sheet.getContext("2d").putImageData(data, 0, 0);
    return sheet;
  };
  // The part of a picture that is seen, and how large a pixel of it is.
  const view = (picture, width, height) => {
    const fit = Math.min(width / picture.width, height / picture.height);
    const scale = Number(zoom.value) || fit;
    const [w, h] = [Math.min(width / scale, picture.width), Math.min(height / scale, picture.height)];
    const clamp = (c, part, all) => Math.min(Math.max(c * all - part / 2, 0), all - part);
    return { scale, x: clamp(centreX, w, picture.width), y: clamp(centreY, h, picture.height), w, h };
  };
  const paint = (data, [x, y, width, height], part, from = 0, to = 1) => {
    context.imageSmoothingEnabled = part.scale < 1;
    context.save();
    context.beginPath();
    context.rect(x + from * width, y, (to - from) * width, height);
    context.clip();
    context.drawImage(sheetOf(data), part.x, part.y, part.w, part.h, x, y, part.w * part.scale, part.h * part.scale);
    context.restore();
  };

  let turn = 0;
  const draw = async () => {
    const mine = ++turn;
    const [a, b] = [byId(left.value), byId(right.value)];
    if (!a || !b) return;
    const wanted = mode === "grid" ? chosen() : [a, b];
    const loaded = await Promise.all(wanted.map(load));
    // A later call has overtaken this one.
    if (mine !== turn || loaded.length === 0) return;
    const stops = Number(exposure.value);
    const first = loaded[0].picture;
    const columns = mode === "grid" ? Math.ceil(Math.sqrt(loaded.length)) : 1;
    const rows = Math.ceil(loaded.length / columns);
    const lines = mode === "grid" ? rows : 1;
    const ratio = devicePixelRatio || 1;
    const width = Math.max(Math.round(stage.clientWidth * ratio), 1);
    const gap = mode === "grid" ? Math.round(4 * ratio) : 0;
    const cell = [Math.floor((width - gap * (columns - 1)) / columns), 0];
    cell[1] = Math.round(cell[0] * (first.height / first.width));
    const caption = mode === "grid" ? Math.round(20 * ratio) : 0;
    [canvas.width, canvas.height] = [width, (cell[1] + caption) * lines];
    const part = view(first, cell[0], cell[1]);
    const data = loaded.map((one) => exposed(one, stops));
    const sameSize = data.every((one) => one.width === first.width && one.height === first.height);
    const place = (i) => [(i % columns) * (cell[0] + gap), Math.floor(i / columns) * (cell[1] + caption), ...cell];
    const cut = Number(slider.value) / 100;
    if (mode === "grid") {
      data.forEach((one, i) => {
        const [x, y] = place(i);
        paint(one, [x, y + caption, ...cell], part);
        context.fillStyle = "#fff";
        context.font = `${13 * ratio}px system-ui, sans-serif`;
        context.fillText(wanted[i].dataset.label, x + 4 * ratio, y + 14 * ratio, cell[0] - 8 * ratio);
      });
      status.textContent = `Side by side, moved and zoomed together: ${wanted.map((s) => s.dataset.label).join(", ")}.`;
    } else if (mode === "difference" && sameSize) {
      paint(less(data[0], data[1], 2 ** Number(gain.value)), place(0), part);
      status.textContent = `Difference of ${a.dataset.label} and ${b.dataset.label}, times ${2 ** Number(gain.value)}.`;
    } else if (mode === "flip") {
      paint(data[flipped ? 1 : 0], place(0), part);
      status.textContent = `Shown: ${(flipped ? b : a).dataset.label}. Press F for the other.`;
    } else {
      paint(data[1], place(0), part);
      paint(data[0], place(0), part, 0, cut);
      context.fillStyle = "#fff";
      context.fillRect(cut * cell[0] - ratio, 0, 2 * ratio, cell[1]);
      context.fillStyle = "#000";
      context.fillRect(cut * cell[0] + ratio, 0, ratio, cell[1]);
      status.textContent = `Left of the divider: ${a.dataset.label}. Right of it: ${b.dataset.label}.`;
    }
    const linear = loaded.some((one) => one.linear);
    exposure.disabled = !linear;
    exposure.closest("label").title = linear ? "" : "No picture in linear light is held for these.";
    if (linear && stops !== 0) status.textContent += ` Linear light times 2^${stops}, without the tone curve.`;
    shown = { wanted, loaded, part, columns, cell, gap, caption, ratio };
    viewer.dataset.drawn = String(mine);
  };

  const press = (name) => {
    flipped = name === "flip" && mode === "flip" ? !flipped : false;
    mode = name;
    for (const other of ["split", "flip", "difference", "grid"]) {
      id(`view-${other}`).setAttribute("aria-pressed", String(other === mode));
    }
    slider.disabled = mode !== "split";
    gain.disabled = mode !== "difference";
    choice.hidden = mode !== "grid";
    draw();
  };
  const label = (input, text) => { id(`${input.id}-value`).textContent = text; };
  const values = () => {
    label(slider, `${Number(slider.value).toFixed(0)} %`);
    label(gain, String(2 ** Number(gain.value)));
    label(exposure, exposure.value);
    draw();
  };

  // The pixel under the pointer.
  const at = (event) => {
    if (!shown) return null;
    const box = canvas.getBoundingClientRect();
    const { part, columns, cell, gap, caption, ratio } = shown;
    const [x, y] = [(event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio];
    const column = Math.min(Math.floor(x / (cell[0] + gap)), columns - 1);
    const row = Math.floor(y / (cell[1] + caption));
    const px = Math.floor(part.x + (x - column * (cell[0] + gap)) / part.scale);
    const py = Math.floor(part.y + (y - row * (cell[1] + caption) - caption) / part.scale);
    return { px, py, share: x / cell[0] };
  };
  const say = ({ px, py }) => {
    const { width, height } = shown.loaded[0].picture;
    if (px < 0 || py < 0 || px >= width || py >= height) return;
    const texts = shown.loaded.map((one, i) => {
      if (px >= one.picture.width || py >= one.picture.height) return "";
      const from = 4 * (py * one.picture.width + px);
      const rgb = [...one.picture.data.slice(from, from + 3)].join(" ");
      const light = one.linear
        ? `, linear ${[...one.linear.slice(from, from + 3)].map((v) => v.toPrecision(4)).join(" ")}` : "";
      return `${shown.wanted[i].dataset.label}: ${rgb}${light}`;
    });
    pixel.textContent = `Pixel ${px}, ${py} – ${texts.filter(Boolean).join("; ")}`;
  };
  let grabbed = null;
  stage.addEventListener("pointermove", (event) => {
    const found = at(event);
    if (!found) return;
    say(found);
    if (grabbed && Number(zoom.value)) {
      const { picture } = shown.loaded[0];
      const { scale } = shown.part;
      centreX = grabbed.x - ((event.clientX - grabbed.clientX) * shown.ratio) / scale / picture.width;
      centreY = grabbed.y - ((event.clientY - grabbed.clientY) * shown.ratio) / scale / picture.height;
      hold();
    } else if (grabbed && mode === "split") {
      slider.value = 100 * found.share;
      values();
    }
  });
  stage.addEventListener("pointerdown", (event) => {
    if (!event.isPrimary) return;
    grabbed = { x: centreX, y: centreY, clientX: event.clientX, clientY: event.clientY };
    stage.setPointerCapture(event.pointerId);
    if (mode === "split" && !Number(zoom.value)) {
      slider.value = 100 * (at(event)?.share ?? 0.5);
      values();
    }
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => { grabbed = null; });
  // The part that is seen stays within the picture.
  const hold = () => {
    centreX = Math.min(Math.max(centreX, 0), 1);
    centreY = Math.min(Math.max(centreY, 0), 1);
    draw();
  };
  const magnify = (step) => {
    zoom.selectedIndex = Math.min(Math.max(zoom.selectedIndex + step, 0), zoom.options.length - 1);
    draw();
  };
  // Letters act only while the viewer has the focus.
  viewer.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || ["SELECT", "INPUT"].includes(event.target.tagName)) return;
    const key = event.key.toLowerCase();
    const modes = { s: "split", f: "flip", d: "difference", g: "grid" };
    if (modes[key]) press(modes[key]);
    else if (key === "+" || key === "=") magnify(1);
    else if (key === "-") magnify(-1);
    else if (event.target === stage && key.startsWith("arrow")) {
      const [dx, dy] = { arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, -1], arrowdown: [0, 1] }[key];
      if (Number(zoom.value)) {
        [centreX, centreY] = [centreX + dx * 0.05, centreY + dy * 0.05];
        hold();
      } else if (dx) {
        slider.value = Number(slider.value) + dx;
        values();
      }
      event.preventDefault();
    }
  });
  for (const input of [slider, gain, exposure]) input.addEventListener("input", values);
  for (const select of [left, right, zoom]) select.addEventListener("change", () => draw());
  for (const name of ["split", "flip", "difference", "grid"]) id(`view-${name}`).addEventListener("click", () => press(name));
  document.addEventListener("point", () => { list(); draw(); fill(here()); });
  addEventListener("resize", () => draw());

  viewer.hidden = false;
  list();
  press("split");
  values();
  // Those that are seen first.
  fill(here()).then(() => fill(shots));
})();
