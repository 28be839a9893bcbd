// SPDX-License-Identifier: GPL-3.0-or-later
// What the view is timed against: the same bodies as instanced meshes of 320 triangles, lit alike, in the same
// browser and with as many pixels. meshes(view) returns draw(pixels, scene), the milliseconds of a picture.

function icosphere() {
  const g = (1 + Math.sqrt(5)) / 2, points = [];
  for (const [a, b] of [[1, g], [-1, g], [1, -g], [-1, -g]]) points.push([0, a, b], [a, b, 0], [b, 0, a]);
  const apart = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  let faces = [];
  for (let i = 0; i < 12; ++i) for (let j = i + 1; j < 12; ++j) for (let k = j + 1; k < 12; ++k)
    if ([[i, j], [j, k], [k, i]].every(([p, q]) => apart(points[p], points[q]) < 2.1)) faces.push([i, j, k]);
  const places = points.map((p) => p.map((x) => x / Math.hypot(...p)));
  for (let turn = 0; turn < 2; ++turn) {
    const between = new Map(), middle = (i, j) => {
      const key = Math.min(i, j) + "," + Math.max(i, j);
      if (!between.has(key)) {
        const sum = places[i].map((x, axis) => x + places[j][axis]), size = Math.hypot(...sum);
        between.set(key, places.push(sum.map((x) => x / size)) - 1);
      }
      return between.get(key);
    };
    faces = faces.flatMap(([i, j, k]) => {
      const [a, b, c] = [middle(i, j), middle(j, k), middle(k, i)];
      return [[i, a, c], [a, j, b], [c, b, k], [a, b, c]];
    });
  }
  return { places, faces };
}

const MESH_VERTEX = COMMON + `
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 centre;
layout(location = 2) in vec4 orientation;
layout(location = 3) in vec3 axes;
layout(location = 4) in float value;
out vec3 normal;
flat out float shade;
` + BODY_VERTEX.match(/mat3 rotation[^]*?\n}\n/)[0] + `
void main() {
  mat3 a = turn * rotation(orientation);
  vec3 p = turn * (centre - middle) + a * (axes * corner);
  normal = a * (corner / axes);
  shade = value;
  gl_Position = vec4(p.xy * scale, -p.z / reach, 1.0);
}`;
const MESH_FRAGMENT = COMMON + LIGHT + "in vec3 normal; flat in float shade; void main() { colour = vec4(lit(shade, normalize(normal)), 1.0); }";

async function meshes(view) {
  const canvas = document.createElement("canvas"), renderer = new Renderer(canvas), { gl } = renderer, { frame } = view;
  const { places, faces } = icosphere(), program = renderer.program(MESH_VERTEX, MESH_FRAGMENT);
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  for (const [place, components, numbers] of [[0, 3, places.flat()], [1, 3, frame.centres], [2, 4, frame.orientations], [3, 3, frame.axes], [4, 1, await view.shades()]]) {
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, components, gl.FLOAT, false, 0, 0);
    gl.vertexAttribDivisor(place, place === 0 ? 0 : 1);
  }
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(faces.flat()), gl.STATIC_DRAW);
  const draw = (pixels, scene) => {
    const begin = performance.now();
    if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
    gl.viewport(0, 0, ...pixels);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    renderer.use(program, scene, pixels);
    gl.bindVertexArray(array);
    gl.drawElementsInstanced(gl.TRIANGLES, 3 * faces.length, gl.UNSIGNED_SHORT, 0, frame.count);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - begin;
  };
  return { draw, canvas, triangles: faces.length };
}
