// SPDX-License-Identifier: MIT
// Draws a frame by WebGL2: bodies, force chains, edges of the cell.

/** Texels in a row of what items are read from. Chosen: every WebGL2 has 2048. */
const ROW = 2048;

// Viridis at nine places, from dark to bright; between them it is nearly linear.
const RAMP = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99],
              [170, 220, 50], [253, 231, 37]];

function rampColour(t) {
  const at = Math.min(Math.max(t, 0), 1) * (RAMP.length - 1), k = Math.min(Math.floor(at), RAMP.length - 2);
  return RAMP[k].map((from, i) => Math.round(from + (RAMP[k + 1][i] - from) * (at - k)));
}

class Renderer {
  /** @throws an Error with what to say where the browser has no WebGL2 */
  constructor(canvas) {
    this.canvas = canvas;
    const gl = (this.gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true }));
    if (!gl) throw new Error("This browser has no WebGL2: the sample is not drawn. The charts do not need it.");
    this.bodies = this.program(BODY_VERTEX, BODY_FRAGMENT);
    this.chains = this.program(CHAIN_VERTEX, CHAIN_FRAGMENT);
    this.edges = this.program(EDGE_VERTEX, EDGE_FRAGMENT);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(1, 1, 1, 1);
    this.makeRamp();
    this.made = {};
  }

  get name() {
    const told = this.gl.getExtension("WEBGL_debug_renderer_info");
    return this.gl.getParameter(told ? told.UNMASKED_RENDERER_WEBGL : this.gl.RENDERER);
  }

  program(vertex, fragment) {
    const { gl } = this, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text), gl.compileShader(shader), gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
        throw new Error(`The drawing program is refused: ${gl.getShaderInfoLog(shader)}`);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`The drawing program is refused: ${gl.getProgramInfoLog(program)}`);
    return program;
  }

  makeRamp() {
    const { gl } = this, width = 256;
    const bytes = new Uint8Array(Array.from({ length: width }, (_, k) => [...rampColour(k / (width - 1)), 255]).flat());
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, width, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    for (const name of ["TEXTURE_MIN_FILTER", "TEXTURE_MAG_FILTER"]) gl.texParameteri(gl.TEXTURE_2D, gl[name], gl.LINEAR);
    for (const name of ["TEXTURE_WRAP_S", "TEXTURE_WRAP_T"]) gl.texParameteri(gl.TEXTURE_2D, gl[name], gl.CLAMP_TO_EDGE);
  }

  /** Takes numbers for a kind of item in place of those before. @param numbers four a texel, `texels` an item */
  replace(name, numbers, texels) {
    const { gl } = this, rows = Math.max(1, Math.ceil(numbers.length / (4 * ROW)));
    if (this.made[name]) gl.deleteTexture(this.made[name].texture);
    const whole = new Float32Array(4 * ROW * rows);
    whole.set(numbers);
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE1), gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, ROW, rows, 0, gl.RGBA, gl.FLOAT, whole);
    for (const side of ["TEXTURE_MIN_FILTER", "TEXTURE_MAG_FILTER"]) gl.texParameteri(gl.TEXTURE_2D, gl[side], gl.NEAREST);
    gl.activeTexture(gl.TEXTURE0);
    this.made[name] = { texture, count: numbers.length / (4 * texels) };
  }

  setBodies({ centres, orientations, axes, values }) {
    const numbers = new Float32Array(12 * values.length);
    values.forEach((value, i) => {
      numbers.set(centres.subarray(3 * i, 3 * i + 3), 12 * i), numbers[12 * i + 3] = value;
      numbers.set(orientations.subarray(4 * i, 4 * i + 4), 12 * i + 4);
      numbers.set(axes.subarray(3 * i, 3 * i + 3), 12 * i + 8);
    });
    this.replace("bodies", numbers, 3);
  }
  setChains(numbers) { this.replace("chains", numbers, 2); }
  setEdges(places) {
    const { gl } = this;
    this.edgePlaces ??= gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.edgePlaces);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places), gl.STATIC_DRAW);
    this.made.edges = { count: places.length / 3 };
  }

  /**
   * @param pixels [width, height] of the picture
   * @param scene {turn (rows), middle, scale (length to half the picture's height), reach, plane, size, picked, show}
   * @returns milliseconds until the picture was there, where `timed`
   */
  draw(pixels, scene, timed) {
    const { gl, canvas } = this, begin = performance.now();
    if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
    gl.viewport(0, 0, ...pixels);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const name of ["edges", "bodies", "chains"]) {
      const made = this.made[name];
      if (!made || made.count === 0 || !scene.show[name]) continue;
      this.use(this[name], scene, pixels);
      if (name === "edges") {
        gl.bindBuffer(gl.ARRAY_BUFFER, this.edgePlaces);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
        gl.drawArrays(gl.LINES, 0, made.count);
        gl.disableVertexAttribArray(0);
      } else {
        gl.activeTexture(gl.TEXTURE1), gl.bindTexture(gl.TEXTURE_2D, made.texture), gl.activeTexture(gl.TEXTURE0);
        gl.drawArrays(gl.TRIANGLES, 0, 6 * made.count);
      }
    }
    if (!timed) return null;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for the picture
    return performance.now() - begin;
  }

  use(program, scene, [width, height]) {
    const { gl } = this, place = (name) => gl.getUniformLocation(program, name);
    gl.useProgram(program);
    gl.uniformMatrix3fv(place("turn"), true, scene.turn.flat());
    gl.uniform3fv(place("middle"), scene.middle);
    gl.uniform2f(place("scale"), (scene.scale * height) / width, scene.scale);
    gl.uniform1f(place("reach"), scene.reach);
    gl.uniform4fv(place("plane"), scene.plane);
    gl.uniform1f(place("size"), scene.size);
    gl.uniform1i(place("picked"), scene.picked);
    gl.uniform1i(place("ramp"), 0), gl.uniform1i(place("items"), 1);
  }
}
