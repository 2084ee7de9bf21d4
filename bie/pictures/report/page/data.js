// Data of the report, and numbers as text.

/** Number with at most `digits` significant digits, powers of ten where they are shorter. */
function textOf(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) {
    const [digitsPart, power] = value.toExponential(digits - 1).split("e");
    const factor = Math.abs(Number(digitsPart)) === 1 ? "" : `${Math.abs(Number(digitsPart))}·`;
    return `${value < 0 ? "−" : ""}${factor}10${superscript(Number(power))}`;
  }
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

function superscript(power) {
  const digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  return String(power).replace("-", "⁻").replace(/\d/g, (digit) => digits[digit]);
}

function withUnit(text, unit) {
  return unit ? `${text} ${unit}` : text;
}

/** Round values (1, 2 or 5 times a power of ten apart) between two bounds, about `count` of them. */
function roundTicks(lower, upper, count) {
  const length = upper - lower;
  if (!(length > 0)) return [lower];
  const least = length / count;
  const power = 10 ** Math.floor(Math.log10(least));
  const spacing = power * [1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9));
  const ticks = [];
  for (let i = Math.ceil(lower / spacing - 1e-9); i * spacing <= upper + 1e-9 * length; ++i) ticks.push(i * spacing);
  return ticks;
}

/** Texts of evenly spaced values, all with the decimals that their distance needs. */
function tickTexts(ticks) {
  const size = Math.max(...ticks.map(Math.abs));
  if (ticks.length < 2 || size >= 1e5 || size < 1e-3) return ticks.map((tick) => textOf(tick));
  const decimals = Math.max(0, -Math.floor(Math.log10(ticks[1] - ticks[0]) + 1e-9));
  return ticks.map((tick) => tick.toFixed(decimals).replace("-", "−").replace(/^−(0\.?0*)$/, "$1"));
}

/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
function roundBelow(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * [5, 2, 1].find((factor) => factor * power <= length);
}

/** Text with indices: "κ_B" becomes κ with a small B below. */
function withIndices(text) {
  return text.split(/(_[A-Za-zκ∞]+)/).filter((part) => part !== "").map((part) =>
    (part.length > 1 && part[0] === "_" ? element("sub", { text: part.slice(1) }) : part));
}

/** Coefficients of every snapshot: 16-bit integers, little endian, each component in parts of its own scale. */
class Coefficients {
  constructor(field, degrees) {
    const bytes = Uint8Array.from(atob(field.data), (letter) => letter.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    let position = 0;
    this.snapshots = degrees.map((degree, snapshot) => field.scale[snapshot].map((scale) => {
      const values = new Float32Array((degree + 1) ** 2);
      for (let i = 0; i < values.length; ++i, position += 2) values[i] = view.getInt16(position, true) * scale / 32767;
      return values;
    }));
  }

  /** Components of a snapshot, each an array of (p + 1)² coefficients. */
  at(snapshot) {
    return this.snapshots[snapshot];
  }
}

/** An element with attributes, properties in words ("text", or "rich" with indices) and children. */
function element(name, attributes = {}, ...children) {
  const space = element.svg.has(name) ? "http://www.w3.org/2000/svg" : "http://www.w3.org/1999/xhtml";
  const node = document.createElementNS(space, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "text") node.textContent = value;
    else if (key === "rich") node.append(...withIndices(value));
    else node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}
element.svg = new Set(["svg", "path", "line", "rect", "text", "circle", "g", "title", "clipPath"]);
