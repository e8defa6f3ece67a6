"use strict";
// The page is complete without this script. It adds the viewer that lays two pictures over each
// other, and a button that copies the command.
(() => {
  const id = (name) => document.getElementById(name);

  const copy = id("copy");
  if (copy && navigator.clipboard) {
    copy.hidden = false;
    copy.addEventListener("click", async () => {
      try {
        await navigator.clipboard.writeText(id("command").textContent);
        copy.textContent = "Copied";
      } catch {
        getSelection().selectAllChildren(id("command"));
        copy.textContent = "Selected: press Ctrl+C";
      }
    });
  }

  const viewer = id("viewer");
  const shots = [...document.querySelectorAll("img.shot")];
  if (!viewer || shots.length < 2) return;
  viewer.hidden = false;
  const [left, right, slider] = ["view-a", "view-b", "view-x"].map(id);
  const [flip, zoom, stage, layers] = ["view-flip", "view-zoom", "view-stage", "view-layers"].map(id);
  const status = id("view-status");
  for (const select of [left, right]) {
    shots.forEach((shot, i) => select.add(new Option(shot.dataset.label, i)));
  }
  const pictures = shots.map((shot, i) => (shot.id.startsWith("picture-") ? i : -1)).filter((i) => i >= 0);
  right.value = pictures[1] ?? 1;
  left.value = pictures[0] ?? 0;
  const [below, above] = [new Image(), new Image()];
  const divider = document.createElement("div");
  divider.className = "divider";
  layers.append(below, above, divider);

  // Below lies B, above it A, cut at the divider. Flipped, one picture covers all.
  let flipped = 0;
  const draw = () => {
    const [a, b] = [shots[left.value], shots[right.value]];
    if (below.src !== b.src) below.src = b.src;
    if (above.src !== a.src) above.src = a.src;
    above.alt = `A: ${a.dataset.label}`;
    below.alt = `B: ${b.dataset.label}`;
    const shown = flipped ? (flipped === 1 ? 100 : 0) : Number(slider.value);
    above.style.clipPath = `inset(0 ${100 - shown}% 0 0)`;
    divider.style.left = `${shown}%`;
    divider.hidden = flipped > 0;
    flip.setAttribute("aria-pressed", String(flipped > 0));
    slider.disabled = flipped > 0;
    status.textContent = flipped
      ? `Shown: ${(flipped === 1 ? a : b).dataset.label}. Flip again for the other; click the picture or press S for the divider.`
      : `Left of the divider: ${a.dataset.label}. Right of it: ${b.dataset.label}.`;
  };
  const toggle = () => { flipped = flipped === 1 ? 2 : 1; draw(); };
  const split = () => { flipped = 0; draw(); };
  // Fit to the page, then one and four screen pixels a pixel of the picture.
  const scales = [0, 1, 4];
  let scale = 0;
  const magnify = () => {
    scale = (scale + 1) % scales.length;
    layers.classList.toggle("exact", scale > 0);
    layers.style.width = scale > 0 ? `${above.naturalWidth * scales[scale]}px` : "";
    zoom.textContent = scale > 0 ? `Zoom ${scales[scale]}:1 (Z)` : "Zoom to fit (Z)";
  };
  for (const control of [left, right, slider]) control.addEventListener("input", draw);
  flip.addEventListener("click", toggle);
  zoom.addEventListener("click", magnify);
  const follow = (event) => {
    if (!event.isPrimary) return;
    const box = layers.getBoundingClientRect();
    slider.value = (100 * (event.clientX - box.left)) / box.width;
    split();
  };
  stage.addEventListener("pointermove", (event) => {
    if (!flipped) follow(event);
  });
  stage.addEventListener("pointerdown", follow);
  // Letters act only while the viewer has the focus.
  viewer.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    const key = event.key.toLowerCase();
    if (key === "f") toggle();
    else if (key === "s") split();
    else if (key === "z") magnify();
    else if (event.target === stage && (key === "arrowleft" || key === "arrowright")) {
      slider.value = Number(slider.value) + (key === "arrowleft" ? -1 : 1);
      split();
      event.preventDefault();
    }
  });
  draw();
})();
