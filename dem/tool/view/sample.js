// SPDX-License-Identifier: MIT
// A frame as bodies: columns to colour by, force chains, the body under a finger.

/** Arrays that say how a body is drawn, not what is true of it. */
const NOT_A_COLUMN = ["axes", "orientation"];
const SPACE = ["x", "y", "z"];

/** Half the width of the widest chain, to the mean semi-axis of the bodies. Chosen: chains are told apart, and bodies seen between. */
const WIDEST = 0.2;

class Frame {
  /** @param particles, chains  VtkFile; chains may be null */
  constructor(particles, chains) { Object.assign(this, { particles, chains }); }

  async read() {
    const [centres, orientations, axes, cell, walls, dimensions] = await Promise.all([
      this.particles.numbers("Points", "Points"), this.particles.numbers("PointData", "orientation"),
      this.particles.numbers("PointData", "semi_axes"), this.particles.numbers("FieldData", "cell"),
      this.particles.numbers("FieldData", "walls"), this.particles.numbers("FieldData", "dimensions")]);
    Object.assign(this, { centres, orientations, axes, cell, walls: walls ?? [], count: axes.length / 3, isPlane: dimensions?.[0] === 2 });
    if (this.isPlane) this.cell = cell.map((x, k) => (k < 6 ? x : 0));  // its third edge is a unit
    return this;
  }

  /** Names of columns: of a vector its size and its components. */
  get columns() {
    return this.particles.of("PointData").filter(({ name }) => !NOT_A_COLUMN.includes(name)).flatMap(({ name, components }) =>
      components === 1 ? [name] : [name, ...SPACE.slice(0, components).map((axis, k) => (name === "semi_axes" ? `${name} ${k + 1}` : `${name} ${axis}`))]);
  }

  async column(title) {
    const array = this.particles.of("PointData").filter(({ name }) => title === name || title.startsWith(name + " "))
      .sort((p, q) => q.name.length - p.name.length)[0];
    const numbers = await this.particles.numbers("PointData", array.name), { components } = array;
    const last = title.slice(array.name.length + 1), place = SPACE.indexOf(last) >= 0 ? SPACE.indexOf(last) : Number(last) - 1;
    return Float64Array.from({ length: this.count }, (_, i) => {
      if (components === 1) return numbers[i];
      if (title !== array.name) return numbers[components * i + place];
      return Math.hypot(...numbers.subarray(components * i, components * (i + 1)));
    });
  }

  /** The edges of the cell, two ends each. */
  get edges() {
    const at = (i, j, k) => SPACE.map((_, axis) => i * this.cell[axis] + j * this.cell[3 + axis] + k * this.cell[6 + axis]);
    const places = [];
    for (const [p, q] of [[0, 0], [0, 1], [1, 0], [1, 1]])
      places.push(...at(0, p, q), ...at(1, p, q), ...at(p, 0, q), ...at(p, 1, q), ...at(p, q, 0), ...at(p, q, 1));
    for (let k = 0; k < this.walls.length; k += 4) places.push(...this.outlineOf([...this.walls.subarray(k, k + 3)], this.walls[k + 3], places.slice(0, 72)));
    return places;
  }

  /** The outline of the plane n.p = w within the cell, two ends each; none where it lies outside. @param edges of the cell */
  outlineOf(n, w, edges) {
    const met = [];
    for (let k = 0; k < edges.length; k += 6) {
      const [p, q] = [edges.slice(k, k + 3), edges.slice(k + 3, k + 6)], [from, to] = [dot(n, p) - w, dot(n, q) - w];
      if (from * to > 0 || from === to) continue;
      const place = p.map((x, axis) => x + (q[axis] - x) * from / (from - to)), near = 1e-9 * Math.hypot(...this.cell);
      if (!met.some((other) => Math.hypot(...other.map((x, axis) => x - place[axis])) < near)) met.push(place);  // edges share corners
    }
    if (met.length < 3) return [];
    const middle = SPACE.map((_, axis) => met.reduce((sum, p) => sum + p[axis], 0) / met.length);
    const u = met[0].map((x, axis) => x - middle[axis]), v = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]];
    const angle = (p) => { const d = p.map((x, axis) => x - middle[axis]); return Math.atan2(dot(d, v), dot(d, u)); };
    met.sort((p, q) => angle(p) - angle(q));
    return met.flatMap((p, k) => [...p, ...met[(k + 1) % met.length]]);
  }

  get middle() { return SPACE.map((_, axis) => (this.cell[axis] + this.cell[3 + axis] + this.cell[6 + axis]) / 2); }

  /** Force chains as the renderer takes them; null without contacts. Half the width goes with the root of the force: its square counts. */
  async lines() {
    if (!this.chains) return null;
    const places = await this.chains.numbers("Points", "Points"), forces = await this.chains.numbers("CellData", "normal_force");
    const largest = forces.reduce((most, x) => Math.max(most, x), 0), mean = this.axes.reduce((sum, r) => sum + r, 0) / this.axes.length;
    const strong = Array.from(forces.keys()).filter((k) => forces[k] > 0), numbers = new Float32Array(8 * strong.length);
    strong.forEach((k, i) => {
      const share = forces[k] / largest;
      numbers.set(places.subarray(6 * k, 6 * k + 3), 8 * i), numbers[8 * i + 3] = WIDEST * mean * Math.sqrt(share);
      numbers.set(places.subarray(6 * k + 3, 6 * k + 6), 8 * i + 4), numbers[8 * i + 7] = share;
    });
    return { largest, numbers };
  }

  /**
   * The body whose surface a ray meets first; -1 where none.
   * @param from, way  the ray p = from + t way in space, way towards the eye, unit
   * @param plane {n, w}: of n.p <= w alone; null for all
   * @param size of bodies, to their own
   */
  hit(from, way, plane, size) {
    let best = -1, nearest = -Infinity;
    const slope = plane ? dot(plane.n, way) : 0, level = plane ? plane.w - dot(plane.n, from) : 0;
    for (let i = 0; i < this.count; ++i) {
      const [qx, qy, qz, qw] = this.orientations.subarray(4 * i, 4 * i + 4), turn = matrixOf([qw, qx, qy, qz]);
      const d = SPACE.map((_, k) => from[k] - this.centres[3 * i + k]);
      const scaled = (v) => timesTransposed(turn, v).map((x, k) => x / (size * this.axes[3 * i + k]));
      const p = scaled(d), u = scaled(way), uu = dot(u, u), pu = dot(p, u), root = pu * pu - uu * (dot(p, p) - 1);
      if (root < 0) continue;
      let t = (-pu + Math.sqrt(root)) / uu;
      if (plane && slope * t > level) {
        if (slope <= 0 || level / slope < (-pu - Math.sqrt(root)) / uu) continue;
        t = level / slope;
      }
      if (t > nearest) [best, nearest] = [i, t];
    }
    return best;
  }
}

const dot = (v, w) => v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
