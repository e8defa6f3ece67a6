"use strict";
// The page reads without this script. It copies the command, sorts tables and shows one point of a
// study at a time.
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

  // The number that a cell begins with, or that follows a sign of difference; units of bytes count.
  const UNITS = { B: 1, KiB: 1024, MiB: 1024 ** 2, GiB: 1024 ** 3, TiB: 1024 ** 4 };
  const value = (text) => {
    const found = text.replace(/\u202f/g, "").match(/^[^\d+−-]*([+−-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?)\s*([KMGT]?i?B)?/);
    return found ? Number(found[1].replace("−", "-")) * (UNITS[found[2]] ?? 1) : NaN;
  };
  const compare = (numeric) => (a, b) => {
    if (!numeric) return a.localeCompare(b, undefined, { numeric: true });
    const [x, y] = [value(a), value(b)];
    return x - y;
  };
  // Each heading becomes a button that sorts by its column: up, then down, then as it was.
  const sortable = (table) => {
    const body = table.tBodies[0];
    const original = [...body.rows];
    if (original.length < 2) return;
    const headings = [...table.tHead.rows[0].cells];
    headings.forEach((heading, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.className = "sort";
      button.textContent = heading.textContent;
      heading.replaceChildren(button);
      heading.setAttribute("aria-sort", "none");
      button.addEventListener("click", () => {
        const was = heading.getAttribute("aria-sort");
        const now = { none: "ascending", ascending: "descending", descending: "none" }[was];
        for (const other of headings) other.setAttribute("aria-sort", "none");
        heading.setAttribute("aria-sort", now);
        const order = compare(heading.classList.contains("n"));
        const text = (row) => row.cells[column]?.textContent ?? "";
        const missing = (row) => heading.classList.contains("n") && Number.isNaN(value(text(row)));
        // Rows without a number stay below, whichever way the column is sorted.
        const rows = now === "none" ? original : [...original].sort((a, b) =>
          missing(a) - missing(b) || (missing(a) ? 0 : order(text(a), text(b)) * (now === "ascending" ? 1 : -1)));
        body.append(...rows);
      });
    });
  };
  document.querySelectorAll("figure.data table").forEach(sortable);

  const point = id("point");
  if (point) {
    id("chooser").hidden = false;
    const show = () => {
      document.querySelectorAll(".at").forEach((part) => {
        part.classList.toggle("away", point.value !== "" && part.id !== `at-${point.value}`);
      });
      document.dispatchEvent(new CustomEvent("point", { detail: point.value }));
    };
    point.addEventListener("change", show);
    show();
    // The contents lead to the point that is shown.
    document.querySelectorAll("nav a").forEach((link) => {
      const name = link.getAttribute("href").replace(/^#|-\d+$/g, "");
      link.addEventListener("click", () => {
        const number = point.value || "1";
        if (id(`${name}-${number}`)) link.setAttribute("href", `#${name}-${number}`);
      });
    });
  }
})();
