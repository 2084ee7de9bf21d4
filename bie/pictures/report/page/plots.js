// Histories as SVG, with a cursor at the time of the vesicle.

const plotWidth = 520, plotHeight = 300;
const margin = { left: 66, right: 14, top: 30, bottom: 42 };

class HistoryPlot {
  /**
   * @param panel   title, unit, "log" and curves over times
   * @param onTime  called with the time that was clicked
   */
  constructor(panel, timeUnit, onTime) {
    this.panel = panel;
    this.timeUnit = timeUnit;
    const times = panel.time, values = panel.curves.flatMap((curve) => curve.values).filter((v) => this.shows(v));
    this.x = [times[0], times[times.length - 1]];
    if (this.x[0] === this.x[1]) this.x = [this.x[0] - 0.5, this.x[1] + 0.5];
    this.y = this.range(values);
    this.figure = element("figure", {}, this.drawing(), this.legend());
    this.svg.addEventListener("click", (event) => onTime(this.timeAt(event)));
    this.svg.addEventListener("pointermove", (event) => this.mark(this.timeAt(event)));
    this.svg.addEventListener("pointerleave", () => this.mark(this.time));
  }

  shows(value) {
    return value !== null && (!this.panel.log || value > 0);
  }

  range(values) {
    if (values.length === 0) return [this.panel.log ? 0.1 : 0, 1];
    let lower = Infinity, upper = -Infinity;
    for (const value of values) [lower, upper] = [Math.min(lower, value), Math.max(upper, value)];
    if (this.panel.log) {
      // Below this share of the largest, values are rounding.
      lower = Math.max(lower, upper * 1e-14);
      return [10 ** Math.floor(Math.log10(lower)), 10 ** Math.ceil(Math.log10(upper) + 1e-9)];
    }
    // A constant up to rounding has no scale of its own.
    const size = Math.max(Math.abs(lower), Math.abs(upper)) || 1;
    if (upper - lower < 1e-6 * size) [lower, upper] = [lower - 0.05 * size, upper + 0.05 * size];
    const room = 0.06 * (upper - lower);
    return [lower - room, upper + room];
  }

  px(time) {
    return margin.left + (time - this.x[0]) / (this.x[1] - this.x[0]) * (plotWidth - margin.left - margin.right);
  }

  py(value) {
    const f = this.panel.log ? Math.log10 : (v) => v, [lower, upper] = this.y.map(f);
    const share = Math.max(-0.02, (f(value) - lower) / (upper - lower));
    return plotHeight - margin.bottom - share * (plotHeight - margin.top - margin.bottom);
  }

  timeAt(event) {
    const box = this.svg.getBoundingClientRect();
    const share = ((event.clientX - box.left) / box.width * plotWidth - margin.left) /
      (plotWidth - margin.left - margin.right);
    return this.x[0] + Math.max(0, Math.min(1, share)) * (this.x[1] - this.x[0]);
  }

  ticks() {
    if (!this.panel.log) return roundTicks(...this.y, 5);
    const [lower, upper] = this.y.map((v) => Math.round(Math.log10(v)));
    const step = Math.max(1, Math.ceil((upper - lower) / 5)), ticks = [];
    for (let power = lower; power <= upper; power += step) ticks.push(10 ** power);
    return ticks;
  }

  drawing() {
    const { panel } = this, bottom = plotHeight - margin.bottom, right = plotWidth - margin.right;
    const nodes = [element("title", { text: this.summary() })];
    const title = withUnit(panel.title[0].toUpperCase() + panel.title.slice(1), panel.unit && `(${panel.unit})`);
    nodes.push(element("text", { class: "title", x: margin.left, y: 18, text: title }));
    const ticks = this.ticks(), texts = tickTexts(ticks);
    for (const [i, tick] of ticks.entries()) {
      const y = this.py(tick);
      nodes.push(element("line", { class: "grid", x1: margin.left, x2: right, y1: y, y2: y }));
      const text = panel.log ? `10${superscript(Math.round(Math.log10(tick)))}` : texts[i];
      nodes.push(element("text", { x: margin.left - 7, y: y + 4, "text-anchor": "end", text }));
    }
    const times = roundTicks(...this.x, 6), timeTexts = tickTexts(times);
    for (const [i, tick] of times.entries()) {
      const x = this.px(tick);
      nodes.push(element("line", { class: "grid", x1: x, x2: x, y1: margin.top, y2: bottom }));
      nodes.push(element("text", { x, y: bottom + 17, "text-anchor": "middle", text: timeTexts[i] }));
    }
    nodes.push(element("text", { x: (margin.left + right) / 2, y: plotHeight - 6, "text-anchor": "middle",
      text: withUnit("time", this.timeUnit && `(${this.timeUnit})`) }));
    nodes.push(element("rect", { class: "frame", x: margin.left, y: margin.top, width: right - margin.left,
      height: bottom - margin.top }));
    panel.curves.forEach((curve, i) => nodes.push(element("path", { class: `curve k${i}`, d: this.path(curve) })));
    this.cursor = element("line", { class: "cursor", y1: margin.top, y2: bottom });
    this.dots = panel.curves.map((_, i) => element("circle", { class: `dot k${i}`, r: 3.5 }));
    this.svg = element("svg", { viewBox: `0 0 ${plotWidth} ${plotHeight}`, role: "img", "aria-label": this.summary() },
      ...nodes, this.cursor, ...this.dots);
    return this.svg;
  }

  /** One polyline for each stretch of values that can be shown. */
  path(curve) {
    let text = "", open = false;
    curve.values.forEach((value, i) => {
      if (!this.shows(value)) {
        open = false;
        return;
      }
      text += `${open ? "L" : "M"}${this.px(this.panel.time[i]).toFixed(1)},${this.py(value).toFixed(1)}`;
      open = true;
    });
    return text;
  }

  /** The plot in words, for those who do not see it. */
  summary() {
    const parts = this.panel.curves.map((curve) => {
      const values = curve.values.filter((value) => value !== null);
      if (values.length === 0) return `${curve.label}: no values`;
      const told = [values[0], Math.min(...values), Math.max(...values), values[values.length - 1]];
      const [first, least, most, last] = told.map((value) => textOf(value));
      return `${curve.label}: starts at ${first}, lies between ${least} and ${most}, ends at ${last}`;
    });
    return `${this.panel.title} against time. ${parts.join(". ")}`;
  }

  legend() {
    const box = element("div", { class: "legend" });
    this.readings = this.panel.curves.map((curve, i) => {
      const reading = element("span");
      const sample = element("svg", { viewBox: "0 0 34 10", "aria-hidden": "true" },
        element("path", { class: `curve k${i}`, d: "M0,5H34" }));
      box.append(element("span", {}, sample, ...withIndices(curve.label), " ", reading));
      return reading;
    });
    return box;
  }

  /** The cursor stays at this time. */
  show(time) {
    this.time = time;
    this.mark(time);
  }

  /** Cursor, dots and readings at a time, between two rows on the straight line. */
  mark(time) {
    const x = this.px(time);
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
    this.panel.curves.forEach((curve, i) => {
      const value = this.valueAt(curve.values, time), shown = this.shows(value);
      this.dots[i].setAttribute("visibility", shown ? "visible" : "hidden");
      this.dots[i].setAttribute("cx", x);
      if (shown) this.dots[i].setAttribute("cy", this.py(value));
      this.readings[i].textContent = textOf(value);
    });
  }

  valueAt(values, time) {
    const times = this.panel.time;
    const after = times.findIndex((t) => t >= time);
    if (after === -1) return values[values.length - 1];
    // At a jump of the field two rows have the same time: the second has the values after it.
    if (after === 0 || times[after] === time) return values[times.lastIndexOf(times[after])];
    const [a, b] = [values[after - 1], values[after]];
    if (a === null || b === null) return null;
    return a + (b - a) * (time - times[after - 1]) / (times[after] - times[after - 1]);
  }
}
