// Fills the page and ties slider, picture and plots together.

class Report {
  constructor(run) {
    this.run = run;
    this.snapshot = 0;
    this.fillTexts();
    this.plots = run.history.panels.map((panel) =>
      new HistoryPlot(panel, run.history.unit, (time) => this.show(this.nearest(time))));
    byId("histories").append(...this.plots.map((plot) => plot.figure));
    if (this.plots.length === 0) byId("histories").append("The history has a single row: there is nothing to plot.");
    this.fields = run.surface.fields;
    byId("field").append(...this.fields.map((field, i) => element("option", { value: i, text: field.label })),
      element("option", { value: -1, text: "none" }));
    byId("field").value = this.fields.length > 0 ? 0 : -1;
    byId("time").max = run.surface.times.length - 1;
    this.position = new Coefficients(run.surface.position, run.surface.degrees);
    this.values = this.fields.map((field) => new Coefficients(field, run.surface.degrees));
    this.lattice = new SphereLattice(Math.max(...run.surface.degrees));
    this.triangles = this.lattice.triangles();
    this.prepareViewer();
    this.listen();
    this.drawShapes();
    this.show(0);
  }

  prepareViewer() {
    try {
      this.viewer = new Viewer(byId("view"), this.run.surface.radius);
    } catch (error) {
      complain(`This browser shows no 3D graphics (${error.message}); numbers and plots are complete. Pictures of the ` +
        "shapes: vehd plot.");
      for (const id of ["vesicle", "shapes"]) byId(id).closest("section").hidden = true;
    }
  }

  fillTexts() {
    const { run } = this;
    byId("headline").textContent = run.headline;
    const verdict = byId("verdict");
    verdict.textContent = run.verdict.text;
    verdict.className = run.verdict.state;
    byId("warnings").append(...run.verdict.warnings.map((text) => element("li", { text: `Outside the model: ${text}` })));
    byId("facts").append(...run.facts.map(([name, value]) =>
      element("div", {}, element("dt", { text: name }), element("dd", { text: value }))));
    fillTable(byId("limits"), ["number", "worst", "limit", "", "meaning"], run.verdict.limits.map((row) => [
      { code: row.name }, { number: textOf(row.worst, 3) }, { number: `${row.least ? "≥" : "≤"} ${textOf(row.limit)}` },
      { text: row.holds ? "✓ holds" : row.least ? "✗ below the limit" : "✗ above the limit", class: row.holds ? "ok" : "over" }, { text: row.meaning }]));
    byId("numbers").open = run.verdict.limits.some((row) => !row.holds);
    if (run.groups.length > 0) {
      fillTable(byId("groups"), ["", "", "value", "meaning"], run.groups.map((row) => [
        { rich: row.name }, { rich: row.symbol }, { number: withUnit(textOf(row.value), row.si && `= ${row.si}`) },
        { rich: row.meaning }]));
    }
    for (const table of run.scene.tables) {
      const body = element("table");
      fillTable(body, ["key", "value", "", "meaning"], table.rows.map((row) => [
        { code: row.key }, { code: row.value }, { rich: row.symbol }, { rich: row.meaning }]));
      body.className = "keys";
      byId("scene-tables").append(element("h3", {}, element("code", { text: `[${table.name}]` }), ` ${table.meaning}`),
        element("div", { class: "scroll" }, body));
    }
    byId("scene-text").textContent = run.scene.text;
    byId("footer").textContent = run.footer;
  }

  listen() {
    byId("time").addEventListener("input", (event) => this.show(Number(event.target.value)));
    byId("play").addEventListener("click", () => this.play(!this.timer));
    for (const id of ["field", "own-range"]) byId(id).addEventListener("change", () => this.recolour());
    window.addEventListener("beforeprint", () => { byId("numbers").open = true; });
    byId("theme").addEventListener("click", () => {
      const root = document.documentElement;
      const now = root.dataset.theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
      root.dataset.theme = now === "dark" ? "light" : "dark";
    });
    if (!this.viewer) return;
    for (const button of document.querySelectorAll("[data-view]")) {
      button.addEventListener("click", () => this.look(button.dataset.view));
    }
    const view = byId("view");
    view.addEventListener("pointerdown", (event) => view.setPointerCapture(event.pointerId));
    view.addEventListener("pointermove", (event) => {
      if (!(event.buttons & 1)) return;
      this.viewer.turn(-0.5 * event.movementX, 0.5 * event.movementY);
      this.redraw();
    });
    view.addEventListener("wheel", (event) => {
      // The wheel scrolls the page until the picture is clicked.
      if (document.activeElement !== view) return;
      event.preventDefault();
      this.viewer.enlarge(Math.exp(-0.001 * event.deltaY));
      this.redraw();
    }, { passive: false });
    view.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.redraw()).observe(view);
  }

  key(event) {
    const step = 5, { viewer } = this;
    const actions = {
      ArrowLeft: () => viewer.turn(step, 0), ArrowRight: () => viewer.turn(-step, 0),
      ArrowUp: () => viewer.turn(0, -step), ArrowDown: () => viewer.turn(0, step),
      "+": () => viewer.enlarge(1.15), "=": () => viewer.enlarge(1.15), "-": () => viewer.enlarge(1 / 1.15),
      " ": () => this.play(!this.timer),
      ",": () => this.show(this.snapshot - 1), ".": () => this.show(this.snapshot + 1),
      x: () => this.look("x"), y: () => this.look("y"), z: () => this.look("z"), 0: () => this.look("home"),
    };
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in actions)) return;
    event.preventDefault();
    actions[event.key]();
    this.redraw();
  }

  /** From the positive end of an axis, z up; along z, y up. */
  look(view) {
    this.viewer.reset();
    const angles = { x: [90, 0], y: [180, 0], z: [0, 90] }[view];
    if (angles) [this.viewer.azimuth, this.viewer.elevation] = angles;
    this.redraw();
  }

  nearest(time) {
    const { times } = this.run.surface;
    return times.reduce((best, t, i) => (Math.abs(t - time) < Math.abs(times[best] - time) ? i : best), 0);
  }

  play(on) {
    clearInterval(this.timer);
    this.timer = null;
    const last = this.run.surface.times.length - 1;
    if (on && last > 0) {
      if (this.snapshot === last) this.show(0);
      // The whole run in about ten seconds, but each shape long enough to be seen and short enough to show motion.
      const pause = Math.max(40, Math.min(400, 10000 / (last + 1)));
      this.timer = setInterval(() => {
        this.show(this.snapshot + 1);
        if (this.snapshot === last) this.play(false);
      }, pause);
    }
    byId("play").textContent = this.timer ? "Pause" : "Play";
  }

  /** Shape, colours and plots of a snapshot. */
  show(snapshot) {
    const { surface, history } = this.run;
    this.snapshot = Math.max(0, Math.min(surface.times.length - 1, snapshot));
    const time = surface.times[this.snapshot];
    const text = `t = ${withUnit(textOf(time), history.unit)}`;
    byId("time").value = this.snapshot;
    byId("time").setAttribute("aria-valuetext", text);
    byId("clock").textContent = text;
    for (const plot of this.plots) plot.show(time);
    for (const shape of document.querySelectorAll("#shapes button")) {
      shape.setAttribute("aria-current", String(Number(shape.dataset.snapshot) === this.snapshot));
    }
    if (!this.viewer) return;
    this.viewer.setMesh(this.mesh(this.snapshot));
    this.drawBar();
    this.redraw();
    byId("view").setAttribute("aria-label", this.description(text));
  }

  description(time) {
    const field = this.fields[Number(byId("field").value)];
    const size = this.run.surface.extents[this.snapshot].map((extent) => textOf(extent, 3)).join(" by ");
    const colours = field ? `, coloured by ${field.label} from ${textOf(field.lowest[this.snapshot], 3)} to ` +
      textOf(field.highest[this.snapshot], 3) : "";
    return `Vesicle at ${time}, ${withUnit(size, this.run.surface.unit)} along x, y and z${colours}`;
  }

  mesh(snapshot) {
    const { lattice } = this;
    const positions = new Float32Array(3 * lattice.points), values = new Float32Array(lattice.points);
    this.position.at(snapshot).forEach((component, c) => lattice.synthesize(component, positions, c, 3));
    const field = Number(byId("field").value);
    if (field >= 0) lattice.synthesize(this.values[field].at(snapshot)[0], values);
    const { range, palette } = this.colours(field, snapshot);
    this.viewer.setColours(palette);
    const mesh = { positions, values, range, normals: lattice.normals(positions), triangles: this.triangles };
    const { wall, radius } = this.run.surface, farthest = 4;
    const height = wall ? wall.heights[snapshot] : Infinity;
    return height < farthest * radius ? withWall(mesh, wall.normal, height, 2 * radius) : mesh;
  }

  /** Range and colours of a field; symmetric about zero where it has both signs. */
  colours(number, snapshot) {
    const field = this.fields[number], { palettes } = this.run;
    if (!field) return { range: [-1, 1], palette: [[150, 176, 205], [150, 176, 205]] };
    let range = field.range;
    if (byId("own-range").checked) {
      range = [field.lowest[snapshot], field.highest[snapshot]];
      if (field.both_signs) range = [-1, 1].map((sign) => sign * Math.max(...range.map(Math.abs)));
      const size = Math.max(...range.map(Math.abs));
      if (range[1] - range[0] <= 1e-9 * size || size === 0) range = [range[0] - (size || 1), range[1] + (size || 1)];
    }
    return { range, palette: field.both_signs ? palettes.diverging : palettes.sequential };
  }

  drawBar() {
    const number = Number(byId("field").value), field = this.fields[number], bar = byId("bar");
    if (!field) {
      bar.replaceChildren();
      return;
    }
    const { range, palette } = this.colours(number, this.snapshot);
    const colours = palette.map((colour) => `rgb(${colour.map(Math.round).join(" ")})`).join(", ");
    const values = roundTicks(...range, 5), texts = tickTexts(values);
    const ticks = values.map((tick, i) => element("span", {
      style: `left: ${100 * (tick - range[0]) / (range[1] - range[0])}%`, text: texts[i] }));
    const isBeyond = !byId("own-range").checked && field.beyond;
    const beyond = isBeyond ? " (values beyond the ends have the colours of the ends)" : "";
    bar.replaceChildren(element("div", { rich: withUnit(field.label, field.unit && `(${field.unit})`) + beyond }),
      element("div", { class: "strip", style: `background: linear-gradient(to right, ${colours})` }),
      element("div", { class: "ticks" }, ...ticks));
  }

  recolour() {
    this.drawShapes();
    this.show(this.snapshot);
  }

  redraw() {
    if (!this.viewer) return;
    this.viewer.draw();
    drawOverlay(byId("overlay"), this.viewer, this.run);
  }

  /** A row of small pictures over the run; each leads to its time. */
  drawShapes() {
    if (!this.viewer) return;
    const { times } = this.run.surface, most = 6;
    const chosen = [...new Set(Array.from({ length: most }, (_, i) =>
      this.nearest(times[0] + (times[times.length - 1] - times[0]) * i / (most - 1))))];
    byId("shapes").replaceChildren(...chosen.map((snapshot) => {
      this.viewer.setMesh(this.mesh(snapshot));
      const text = `t = ${withUnit(textOf(times[snapshot]), this.run.history.unit)}`;
      const button = element("button", { type: "button", "data-snapshot": snapshot, "aria-label": `Show ${text}` },
        element("img", { alt: "", src: this.viewer.picture(360, 360) }), text);
      button.addEventListener("click", () => this.show(snapshot));
      return button;
    }));
  }
}

function byId(id) {
  return document.getElementById(id);
}

function complain(text) {
  byId("problem").textContent = text;
  byId("problem").hidden = false;
}

function fillTable(table, names, rows) {
  const cell = (content) => {
    if ("code" in content) return element("td", {}, element("code", { text: content.code }));
    if ("number" in content) return element("td", { class: "number", text: content.number });
    return element("td", content);
  };
  table.append(element("thead", {}, element("tr", {}, ...names.map((text) => element("th", { scope: "col", text })))),
    element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell)))));
}

try {
  window.vehdReport = new Report(JSON.parse(byId("run").textContent));
  document.documentElement.dataset.ready = "true";
} catch (error) {
  complain(`This report cannot be shown: ${error.message}`);
  throw error;
}
