// SPDX-License-Identifier: MIT
// A pair drawn on a canvas, without perspective: the outline of an ellipsoid is then an ellipse, and exact.

const STEPS = 96;  // points of a curve; chosen: no corner is seen at 1,000 pixels
const COLOURS = { a: "38,104,170", b: "196,92,24" };

/** Where one looks from: a turn of space into the frame of the screen (x right, y up, z towards the eye). */
class Camera {
  constructor() { Object.assign(this, { turn: normalised([0.82, 0.42, 0.34, 0.1]), centre: [0, 0, 0], scale: 1 }); }

  /** Shows both bodies whole. */
  fit({ a, b }, width, height) {
    const reach = (body) => Math.max(body.r1, body.r2, body.r3);
    const d = [b.x - a.x, b.y - a.y, b.z - a.z];
    const size = Math.hypot(...d);
    const from = Math.min(-reach(a), size - reach(b)), to = Math.max(reach(a), size + reach(b));
    const along = size > 0 ? (from + to) / 2 / size : 0;
    this.centre = [a.x + d[0] * along, a.y + d[1] * along, a.z + d[2] * along];
    this.scale = 0.45 * Math.min(width, height) / ((to - from) / 2);
  }

  /** Turns with the hand. */
  follow(dx, dy) { this.turn = normalised(product(handTurn(dx, dy), this.turn)); }
  zoom(factor) { this.scale *= Math.min(Math.max(factor, 0.5), 2); }

  get matrix() { return matrixOf(this.turn); }
}

/** A vector on the screen, in the unit of length; its third component points to the eye. */
class Projection {
  constructor(camera, width, height) { Object.assign(this, { camera, matrix: camera.matrix, width, height }); }

  vector(v) { return times(this.matrix, v); }
  place(p) {
    const [x, y, z] = this.vector(p.map((value, k) => value - this.camera.centre[k]));
    return [this.width / 2 + this.camera.scale * x, this.height / 2 - this.camera.scale * y, z];
  }
  /** The axis vectors of a body, of semi-axis length. */
  axes(body) {
    const turn = matrixOf([body.qw, body.qx, body.qy, body.qz]);
    return ["r1", "r2", "r3"].map((name, k) => this.vector(turn.map((row) => row[k] * body[name])));
  }
}

/** The points of the outline of a body, from its centre: L (cos t, sin t), L L' the outline's matrix. */
function outline(axes) {
  const entry = (i, j) => axes.reduce((sum, u) => sum + u[i] * u[j], 0);
  const low = Math.sqrt(entry(0, 0)), across = low > 0 ? entry(0, 1) / low : 0;
  const rest = Math.sqrt(Math.max(0, entry(1, 1) - across * across));
  return Array.from({ length: STEPS }, (_, k) => {
    const t = (2 * Math.PI * k) / STEPS;
    return [low * Math.cos(t), across * Math.cos(t) + rest * Math.sin(t)];
  });
}

class Drawing {
  constructor(canvas) { Object.assign(this, { canvas, camera: new Camera() }); }

  get size() { return [this.canvas.clientWidth, this.canvas.clientHeight]; }
  get projection() { return new Projection(this.camera, ...this.size); }

  /** @param show {spheres, selected, answer}; a body that is selected has handles */
  draw(pair, show) {
    const [width, height] = this.size, sharp = window.devicePixelRatio || 1;
    this.canvas.width = width * sharp, this.canvas.height = height * sharp;
    const pen = (this.pen = this.canvas.getContext("2d"));
    pen.scale(sharp, sharp);
    if (!Number.isFinite(this.camera.scale)) this.camera.fit(pair, width, height);  // it was that of a pair that is none
    this.at = this.projection;
    const names = ["a", "b"].sort((p, q) => this.depth(pair[p]) - this.depth(pair[q]));
    for (const name of names) this.body(pair[name], name, name === show.selected);
    if (show.spheres) for (const name of names) this.sphere(pair[name], name);
    if (show.selected) this.handles(pair[show.selected], show.selected);
    const gap = show.answer?.gaps?.["common-normal"];
    if (gap && gap.gap !== null) this.contact(gap);
  }

  depth(body) { return this.at.place([body.x, body.y, body.z])[2]; }

  curve(centre, points, closed) {
    const { pen } = this, { scale } = this.at.camera;
    pen.beginPath();
    for (const [x, y] of points) pen.lineTo(centre[0] + scale * x, centre[1] - scale * y);
    if (closed) pen.closePath();
  }

  body(body, name, selected) {
    const { pen } = this, centre = this.at.place([body.x, body.y, body.z]), axes = this.at.axes(body);
    const reach = this.at.camera.scale * Math.max(body.r1, body.r2, body.r3);
    if (![...centre, reach].every(Number.isFinite)) return;  // too far away or too large to be seen
    const light = pen.createRadialGradient(centre[0] - 0.35 * reach, centre[1] - 0.45 * reach, 0, centre[0], centre[1], 1.2 * reach);
    light.addColorStop(0, `rgba(${COLOURS[name]},.18)`), light.addColorStop(1, `rgba(${COLOURS[name]},.55)`);
    this.curve(centre, outline(axes), true);
    pen.fillStyle = light, pen.fill();
    pen.strokeStyle = `rgb(${COLOURS[name]})`, pen.lineWidth = selected ? 2.5 : 1.5, pen.stroke();
    for (const [i, j] of [[0, 1], [1, 2], [2, 0]]) this.meridian(centre, axes[i], axes[j], name);
  }

  /** The curve of the surface in the plane of two axes: the part behind is faint. */
  meridian(centre, u, v, name) {
    const { pen } = this;
    const square = (w) => w.reduce((sum, x) => sum + x * x, 0);
    const towards = (t) => (Math.cos(t) * u[2]) / square(u) + (Math.sin(t) * v[2]) / square(v);
    pen.lineWidth = 1;
    for (let k = 0; k < STEPS; ++k) {
      const [from, to] = [k, k + 1].map((step) => (2 * Math.PI * step) / STEPS);
      pen.strokeStyle = `rgba(${COLOURS[name]},${towards((from + to) / 2) > 0 ? 0.8 : 0.2})`;
      this.curve(centre, [from, to].map((t) => [0, 1].map((i) => Math.cos(t) * u[i] + Math.sin(t) * v[i])), false);
      pen.stroke();
    }
  }

  sphere(body, name) {
    const { pen } = this, [x, y] = this.at.place([body.x, body.y, body.z]);
    pen.setLineDash([6, 5]), pen.lineWidth = 1.2, pen.strokeStyle = `rgb(${COLOURS[name]})`;
    pen.beginPath(), pen.arc(x, y, this.at.camera.scale * Math.max(body.r1, body.r2, body.r3), 0, 2 * Math.PI), pen.stroke();
    pen.setLineDash([]);
  }

  /** Witness points, what is between them, and the normal, from the middle. */
  contact(gap) {
    const { pen } = this;
    const a = this.at.place([gap["pa.x"], gap["pa.y"], gap["pa.z"]]), b = this.at.place([gap["pb.x"], gap["pb.y"], gap["pb.z"]]);
    const n = this.at.vector([gap.nx, gap.ny, gap.nz]), middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    const length = 0.16 * Math.min(...this.size), tip = [middle[0] + length * n[0], middle[1] - length * n[1]];
    pen.strokeStyle = pen.fillStyle = "#111", pen.lineWidth = 2.5;
    pen.beginPath(), pen.moveTo(...a.slice(0, 2)), pen.lineTo(...b.slice(0, 2)), pen.stroke();
    pen.lineWidth = 1.5;
    pen.beginPath(), pen.moveTo(...middle), pen.lineTo(...tip), pen.stroke();
    const size = Math.hypot(n[0], n[1]);
    if (size > 0.15) {
      const along = [n[0] / size, -n[1] / size], side = [-along[1], along[0]];
      pen.beginPath(), pen.moveTo(tip[0] + 3 * along[0], tip[1] + 3 * along[1]);
      for (const sign of [1, -1]) pen.lineTo(tip[0] - 7 * along[0] + sign * 4 * side[0], tip[1] - 7 * along[1] + sign * 4 * side[1]);
      pen.fill();
    }
    for (const [point, name] of [[a, "a"], [b, "b"]]) {
      pen.beginPath(), pen.arc(point[0], point[1], 4.5, 0, 2 * Math.PI);
      pen.fillStyle = `rgb(${COLOURS[name]})`, pen.fill(), pen.strokeStyle = "#fff", pen.lineWidth = 1.5, pen.stroke();
    }
  }

  /** Squares at the ends of the axes: to squash with. */
  handles(body, name) {
    const { pen } = this;
    for (const { place } of this.tips(body)) {
      pen.fillStyle = "#fff", pen.strokeStyle = `rgb(${COLOURS[name]})`, pen.lineWidth = 2;
      pen.beginPath(), pen.rect(place[0] - 5, place[1] - 5, 10, 10), pen.fill(), pen.stroke();
    }
  }

  /** The six ends of the axes, where they are and which way they lead on the screen. */
  tips(body) {
    const { projection } = this, centre = projection.place([body.x, body.y, body.z]);
    return projection.axes(body).flatMap((u, axis) => [1, -1].map((sign) => {
      const way = [sign * u[0] * this.camera.scale, -sign * u[1] * this.camera.scale];
      return { axis, way, place: [centre[0] + way[0], centre[1] + way[1], sign * u[2]] };
    }));
  }

  /** Which body is at a point of the screen: the nearer one; null where none is. */
  bodyAt(x, y, pair) {
    const { projection } = this;
    const hit = ["a", "b"].filter((name) => {
      const body = pair[name], [cx, cy] = projection.place([body.x, body.y, body.z]);
      const path = new Path2D();
      for (const [px, py] of outline(projection.axes(body))) path.lineTo(cx + this.camera.scale * px, cy - this.camera.scale * py);
      const pen = this.canvas.getContext("2d");
      pen.save(), pen.resetTransform();
      const inside = pen.isPointInPath(path, x, y);
      pen.restore();
      return inside;
    });
    this.at = projection;
    return hit.sort((p, q) => this.depth(pair[q]) - this.depth(pair[p]))[0] ?? null;
  }
}
