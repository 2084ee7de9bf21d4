// The vesicle in 3D: plain WebGL, orthographic.

const vertexShader = `
attribute vec3 position, normal;
attribute float value;
uniform mat3 rotation;
uniform vec3 scale;
uniform vec2 range;
varying vec3 seen;
varying float shade;
void main() {
  seen = rotation * normal;
  shade = (value - range.x) / (range.y - range.x);
  gl_Position = vec4(scale * (rotation * position) * vec3(1.0, 1.0, -1.0), 1.0);
}`;

const fragmentShader = `
precision mediump float;
varying vec3 seen;
varying float shade;
uniform sampler2D colours;
void main() {
  // A wall has no normals, and hides nothing from behind.
  if (dot(seen, seen) < 0.25) {
    if (!gl_FrontFacing) discard;
    gl_FragColor = vec4(0.85, 0.85, 0.85, 1.0);
    return;
  }
  vec3 n = normalize(seen);
  vec3 base = texture2D(colours, vec2(clamp(shade, 0.002, 0.998), 0.5)).rgb;
  vec3 light = normalize(vec3(-0.45, 0.6, 0.85));
  float turned = 0.5 + 0.5 * dot(n, light);
  float diffuse = 0.5 + 0.5 * turned * turned;
  float gloss = 0.10 * pow(max(dot(n, normalize(light + vec3(0.0, 0.0, 1.0))), 0.0), 40.0);
  gl_FragColor = vec4(min(base * diffuse + gloss, 1.0), 1.0);
}`;

const home = { azimuth: 14, elevation: 16 };
const steepest = 90;

class Viewer {
  /** @param radius  of a ball around the origin that holds all shapes */
  constructor(canvas, radius) {
    this.canvas = canvas;
    this.radius = radius;
    this.mesh = null;
    this.reset();
    this.gl = canvas.getContext("webgl", { alpha: true, antialias: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error("no WebGL");
    this.prepare();
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => {
      this.prepare();
      if (this.palette) this.setColours(this.palette);
      if (this.mesh) this.setMesh(this.mesh);
      this.draw();
    });
  }

  reset() {
    Object.assign(this, home, { zoom: 1 });
  }

  prepare() {
    const gl = this.gl;
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(`WebGL: ${gl.getProgramInfoLog(program)}`);
    }
    gl.useProgram(program);
    this.uniforms = Object.fromEntries(["rotation", "scale", "range"].map((name) =>
      [name, gl.getUniformLocation(program, name)]));
    this.buffers = {};
    for (const [name, size] of [["position", 3], ["normal", 3], ["value", 1]]) {
      this.buffers[name] = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
      const place = gl.getAttribLocation(program, name);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.enable(gl.DEPTH_TEST);
  }

  /** @param palette  evenly spaced colours, red, green and blue in 0 … 255 */
  setColours(palette) {
    this.palette = palette;
    const gl = this.gl, width = 256, pixels = new Uint8Array(4 * width);
    for (let i = 0; i < width; ++i) {
      const position = i / (width - 1) * (palette.length - 1);
      const node = Math.min(Math.floor(position), Math.max(palette.length - 2, 0)), t = position - node;
      const next = palette[Math.min(node + 1, palette.length - 1)];
      for (let c = 0; c < 3; ++c) pixels[4 * i + c] = (1 - t) * palette[node][c] + t * next[c];
      pixels[4 * i + 3] = 255;
    }
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, width, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  }

  /** @param mesh  positions, normals, values, triangles and the range of the colours */
  setMesh(mesh) {
    const gl = this.gl;
    for (const [name, values] of [["position", mesh.positions], ["normal", mesh.normals], ["value", mesh.values]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    }
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.triangles, gl.DYNAMIC_DRAW);
    this.mesh = mesh;
  }

  /** Rows: right, up and towards the eye, which is turned by the azimuth from the −y axis towards +x. */
  frame() {
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    const eye = [Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e)];
    const right = [Math.cos(a), Math.sin(a), 0];
    return [right, cross(eye, right), eye];
  }

  /** Pixels of the page for one unit of length. */
  scale() {
    return this.zoom * Math.min(this.canvas.clientWidth, this.canvas.clientHeight) / (2.1 * this.radius);
  }

  turn(azimuth, elevation) {
    this.azimuth = (this.azimuth + azimuth) % 360;
    this.elevation = Math.max(-steepest, Math.min(steepest, this.elevation + elevation));
  }

  enlarge(factor) {
    this.zoom = Math.max(0.2, Math.min(20, this.zoom * factor));
  }

  draw() {
    if (!this.mesh) return;
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const scale = this.scale();
    this.paint(2 * scale / this.canvas.clientWidth, 2 * scale / this.canvas.clientHeight);
  }

  paint(across, upward) {
    const gl = this.gl, [right, up, eye] = this.frame();
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix3fv(this.uniforms.rotation, false, [0, 1, 2].flatMap((c) => [right[c], up[c], eye[c]]));
    gl.uniform3f(this.uniforms.scale, across, upward, 0.2 / this.radius);
    gl.uniform2f(this.uniforms.range, ...this.mesh.range);
    gl.drawElements(gl.TRIANGLES, this.mesh.triangles.length, gl.UNSIGNED_SHORT, 0);
  }

  /** The present mesh as a picture of its own, in the oblique view. */
  picture(width, height) {
    const kept = { azimuth: this.azimuth, elevation: this.elevation, zoom: this.zoom };
    this.reset();
    Object.assign(this.canvas, { width, height });
    const scale = 2 / (2.1 * this.radius);
    this.paint(scale * Math.min(1, height / width), scale * Math.min(1, width / height));
    const address = this.canvas.toDataURL("image/png");
    Object.assign(this, kept);
    return address;
  }
}

/**
 * A mesh with a square of a wall, seen from the side of the fluid alone.
 * @param height  of the origin above it
 */
function withWall(mesh, normal, height, half) {
  const first = mesh.values.length, aside = cross(normal, Math.abs(normal[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]);
  const along = aside.map((c) => half * c / Math.hypot(...aside)), across = cross(normal, along);
  const corner = (a, b) => normal.map((c, k) => a * along[k] + b * across[k] - height * c);
  const joined = (values, more) => {
    const all = new values.constructor(values.length + more.length);
    all.set(values);
    all.set(more, values.length);
    return all;
  };
  return {
    range: mesh.range,
    positions: joined(mesh.positions, [corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)].flat()),
    normals: joined(mesh.normals, Array(12).fill(0)),
    values: joined(mesh.values, Array(4).fill(mesh.range[0])),
    triangles: joined(mesh.triangles, [0, 1, 2, 0, 2, 3].map((i) => first + i)),
  };
}

/** Where axes, field and flow point, and how long a length is, over the picture. */
function drawOverlay(svg, viewer, run) {
  const width = svg.clientWidth, height = svg.clientHeight;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const frame = viewer.frame(), nodes = [], size = 40;
  // The field has a separate position, since it often points along an axis.
  const centres = { axis: [84, height - 88], flow: [84, height - 88], field: [150, height - 88] };
  const place = (v, kind = "axis") =>
    [centres[kind][0] + size * dot(frame[0], v), centres[kind][1] - size * dot(frame[1], v)];
  const line = (kind, from, to) => {
    const [a, b] = [place(from, kind), place(to, kind)];
    nodes.push(element("line", { class: kind, x1: a[0], y1: a[1], x2: b[0], y2: b[1] }));
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (kind === "axis") return b;
    if (length < 6) {
      // Towards the eye or away from it.
      nodes.push(element("circle", { class: kind, cx: b[0], cy: b[1], r: 3 }));
      return b;
    }
    const d = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    const corner = (side) => `${b[0] - 9 * d[0] + side * 4 * d[1]},${b[1] - 9 * d[1] - side * 4 * d[0]}`;
    nodes.push(element("path", { class: kind, d: `M${b[0]},${b[1]} L${corner(1)} L${corner(-1)} Z` }));
    return b;
  };
  const label = (text, at, dx = 0, dy = 0) => nodes.push(element("text", {
    class: "label", x: at[0] + dx, y: at[1] + dy + 5, "text-anchor": "middle", text }));
  for (const [name, axis] of [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]]) {
    line("axis", [0, 0, 0], axis);
    label(name, place(axis.map((c) => 1.28 * c)));
  }
  for (const arrow of run.arrows) {
    const tip = line(arrow.kind, arrow.from, arrow.to);
    if (arrow.label) label(arrow.label, tip, 15, 0);
  }
  const length = roundBelow(0.22 * width / viewer.scale());
  const pixels = length * viewer.scale(), right = width - 16, y = height - 20;
  nodes.push(element("line", { class: "scale", x1: right - pixels, x2: right, y1: y, y2: y }));
  for (const x of [right - pixels, right]) {
    nodes.push(element("line", { class: "scale", x1: x, x2: x, y1: y - 5, y2: y + 5 }));
  }
  label(withUnit(textOf(length), run.surface.unit), [right - pixels / 2, y - 17]);
  svg.replaceChildren(...nodes);
}
