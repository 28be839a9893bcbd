// SPDX-License-Identifier: MIT
// The sample in a report's page: controls, hands, and how many pixels a picture gets.

/** Milliseconds a picture may take while something moves. Chosen: below half of the 250 that still feel like turning. */
const QUICK = 100;
/** Of the full width and height, the least. Chosen: bodies are still told apart. */
const COARSEST = 0.1;
/** Milliseconds without a move after which the full picture is drawn. */
const REST = 180;

const make = (tag, properties = {}, ...inside) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...inside);
  return element;
};
/** A number to read; the frame has more digits. */
const shown = (x) => (Number.isInteger(x) && Math.abs(x) < 1e6 ? String(x) : Number(x).toPrecision(6));
/** What arrays of a frame are in, of the units that a scene may name; what is not here is a number alone. */
const MEASURED_IN = { Points: ["length"], semi_axes: ["length"], velocity: ["length", "time"] };

class SampleView {
  /** @param section where it is drawn @param frames [{cycle, time, particles, chains}], the files as base64 */
  constructor(section, frames) {
    Object.assign(this, { section, frames, place: frames.length - 1, read: new Map(), times: [], quality: 1, picked: -1 });
    this.turn = normalised([0.86, 0.42, 0.25, 0.13]);
    this.makeControls();
    this.renderer = new Renderer(this.canvas);
    this.listen();
  }

  /** A number with its unit, where the scene has one for it. @param of  "time", "force" and so on */
  named(x, of) { return [shown(x), this.section.dataset[of]].filter(Boolean).join(" "); }

  /** The unit of an array of the frame, or of one of its columns: "mm/s"; "" where there is none. */
  unitOf(title) { return (MEASURED_IN[title.split(" ")[0]] ?? []).map((of) => this.section.dataset[of]).filter(Boolean).join("/"); }

  makeControls() {
    const { section } = this, range = (properties) => make("input", { type: "range", ...properties });
    this.canvas = make("canvas", { ariaLabel: "The sample in space" });
    this.colour = make("select"), this.least = make("span"), this.most = make("span"), this.bar = make("span", { className: "bar" });
    const stops = RAMP.map((rgb) => `rgb(${rgb})`).join(",");
    this.bar.style.background = `linear-gradient(to right, ${stops})`;
    this.withBodies = make("input", { type: "checkbox", checked: true });
    this.withChains = make("input", { type: "checkbox" });
    this.widest = make("span");
    this.size = range({ min: 0.1, max: 1, step: 0.05, value: 1, ariaLabel: "Size of the bodies" });
    this.cut = make("select", { ariaLabel: "Clipping plane" }, new Option("no cut", ""), ...["x", "y", "z", "-x", "-y", "-z"].map((way) => new Option(`cut ${way}`, way)));
    this.cutAt = range({ min: 0, max: 1, step: 0.01, value: 0.5, ariaLabel: "Place of the cut", disabled: true });
    this.play = make("button", { textContent: "Play" });
    this.slider = range({ min: 0, max: this.frames.length - 1, step: 1, value: this.place, ariaLabel: "Frame" });
    this.when = make("span");
    this.values = make("table");
    this.note = make("p", { className: "note" });
    const film = make("div", { className: "row" }, this.play, this.slider, this.when);
    film.hidden = this.frames.length < 2;
    section.append(
      this.canvas, film,
      make("div", { className: "row" }, make("label", {}, "colour ", this.colour), make("span", {}, this.least, " ", this.bar, " ", this.most)),
      make("div", { className: "row" }, make("label", {}, this.withBodies, " bodies"), make("label", {}, "size ", this.size),
           make("label", {}, this.withChains, " force chains"), this.widest, this.cut, this.cutAt, make("button", { textContent: "From the front", onclick: () => this.front() })),
      make("p", { className: "note", textContent: "Drag: turn. Wheel or two fingers: nearer. Drag with the right button or with shift: move. Click: a particle's values." }),
      this.values, this.note);
  }

  async show(place) {
    const first = this.frame === undefined, wanted = (this.wanted = place);
    const frame = await this.frameAt(place);
    if (wanted !== this.wanted) return;  // another was asked for meanwhile
    Object.assign(this, { place, frame });
    const { cycle, time } = this.frames[place];
    this.slider.value = place;
    this.when.textContent = `cycle ${cycle}, time ${this.named(time, "time")}`;
    if (first) {
      this.colour.append(...frame.columns.map((name) => new Option(name)));
      this.colour.value = frame.columns.includes("contacts") ? "contacts" : frame.columns[0];
      await this.findRange();
      this.fit();
      if (frame.isPlane) this.turn = [1, 0, 0, 0];
    }
    await this.upload();
    this.redraw();
  }

  async frameAt(place) {
    if (!this.read.has(place)) {
      const { particles, chains } = this.frames[place];
      if (this.read.size > 8) this.read.delete(this.read.keys().next().value);
      this.read.set(place, new Frame(new VtkFile(particles), chains ? new VtkFile(chains) : null).read());
    }
    return this.read.get(place);
  }

  async upload() {
    const { frame } = this;
    await this.colourBodies();
    this.renderer.setEdges(frame.edges);
    const lines = await frame.lines();
    this.withChains.disabled = lines === null;
    this.withChains.parentElement.title = lines === null ? "This frame has no contacts: contact_frames = true in [output] writes them" : "";
    this.widest.textContent = lines === null ? "no contacts in this frame" : `strongest: ${this.named(lines.largest, "force")}; the width goes with the root of the force`;
    this.renderer.setChains(lines?.numbers ?? []);
    await this.showValues();
  }

  async colourBodies() {
    const { centres, orientations, axes } = this.frame;
    this.renderer.setBodies({ centres, orientations, axes, values: await this.shades() });
  }

  /** Least and greatest of the column in this frame: kept while frames play, so that colours keep their meaning. */
  async findRange() {
    const values = await this.frame.column(this.colour.value);
    this.range = [values.reduce((p, q) => Math.min(p, q), Infinity), values.reduce((p, q) => Math.max(p, q), -Infinity)];
    [this.least.textContent, this.most.textContent] = this.range.map(shown);
    this.most.append(" ", this.unitOf(this.colour.value));
  }

  async shades() {
    const values = await this.frame.column(this.colour.value), [least, most] = this.range;
    return Float32Array.from(values, (x) => (most > least ? (x - least) / (most - least) : 0.5));
  }

  fit() {
    const { frame } = this, cell = frame.cell, { clientWidth, clientHeight } = this.canvas;
    const diagonal = (p, q) => Math.hypot(...[0, 1, 2].map((k) => cell[k] + p * cell[3 + k] + q * cell[6 + k]));
    const across = Math.max(diagonal(1, 1), diagonal(1, -1), diagonal(-1, 1), diagonal(-1, -1));
    const largest = frame.axes.reduce((most, r) => Math.max(most, r), 0);
    this.middle = frame.middle;
    this.half = (0.52 * across + largest) * Math.max(1, clientHeight / clientWidth);  // of the picture's height, length
    this.reach = 4 * (across + largest);
  }

  front() {
    this.turn = [1, 0, 0, 0];
    this.fit();
    this.redraw();
  }

  get plane() {
    const way = this.cut.value, axis = SPACE.indexOf(way.slice(-1));
    if (way === "") return null;
    const sign = way.startsWith("-") ? -1 : 1, edge = [0, 1, 2].map((k) => this.frame.cell[3 * k + axis]);
    const low = edge.reduce((sum, x) => sum + Math.min(x, 0), 0), high = edge.reduce((sum, x) => sum + Math.max(x, 0), 0);
    const n = SPACE.map((_, k) => (k === axis ? sign : 0));
    return { n, w: sign * (low + (high - low) * Number(this.cutAt.value)) };
  }

  get scene() {
    const turn = matrixOf(this.turn), { plane } = this;
    const seen = plane ? [...times(turn, plane.n), plane.w - dot(plane.n, this.middle)] : [0, 0, 0, 0];
    return { turn, middle: this.middle, scale: 1 / this.half, reach: this.reach, plane: seen, size: Number(this.size.value), picked: this.picked,
             show: { edges: true, bodies: this.withBodies.checked, chains: this.withChains.checked && !this.withChains.disabled } };
  }

  get fullSize() {
    const sharp = Math.min(window.devicePixelRatio || 1, 2);
    return [this.canvas.clientWidth, this.canvas.clientHeight].map((x) => Math.max(1, Math.round(x * sharp)));
  }

  /** The full picture soon, and in the meantime, where `moving`, one of as many pixels as time allows. */
  redraw(moving = false) {
    this.moving = moving || this.moving;
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = null;
      this.drawNow(this.moving);
      this.moving = false;
    });
  }

  drawNow(moving) {
    const full = this.fullSize, quality = moving ? this.quality : 1;
    const size = full.map((x) => Math.max(1, Math.round(x * quality)));
    const ms = this.renderer.draw(size, this.scene, true);
    this.times.push({ moving, ms, pixels: size[0] * size[1] });
    if (this.times.length > 1000) this.times.shift();
    // Pixels are most of the time; a step of at most 1.3 upwards keeps the pace even.
    const better = (moving ? quality : 1) * Math.sqrt(QUICK / ms);
    this.quality = Math.min(1, Math.max(COARSEST, moving ? Math.min(better, 1.3 * quality) : Math.min(better, this.times.length > 1 ? this.quality * 1.3 : 1)));
    clearTimeout(this.later);
    if (moving && quality < 1) this.later = setTimeout(() => this.redraw(), REST);
  }

  listen() {
    const { canvas } = this;
    listenToHands(canvas, {
      drag: (dx, dy, event) => (event.shiftKey || event.buttons === 2 ? this.slide(dx, dy) : this.follow(dx, dy)),
      slide: (dx, dy) => this.slide(dx, dy),
      nearer: (factor) => this.nearer(factor),
      click: (event) => this.pick(event),
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    this.colour.addEventListener("change", async () => {
      await this.findRange();
      await this.colourBodies();
      this.redraw();
    });
    this.cut.addEventListener("change", () => ((this.cutAt.disabled = this.cut.value === ""), this.redraw()));
    for (const range of [this.size, this.cutAt]) range.addEventListener("input", () => this.redraw(true));
    for (const box of [this.withBodies, this.withChains]) box.addEventListener("change", () => this.redraw());
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    this.play.addEventListener("click", () => this.playOrStop());
    window.addEventListener("resize", () => this.redraw());
    canvas.addEventListener("webglcontextlost", () => (this.note.textContent = "The graphics were taken away from this page. Load it again."));
  }

  nearer(factor) {
    this.half /= Math.min(Math.max(factor, 0.5), 2);
    this.redraw(true);
  }

  follow(dx, dy) {
    this.turn = normalised(product(handTurn(dx, dy), this.turn));
    this.redraw(true);
  }

  slide(dx, dy) {
    const unit = (2 * this.half) / this.canvas.clientHeight, way = timesTransposed(matrixOf(this.turn), [-dx * unit, dy * unit, 0]);
    this.middle = this.middle.map((x, k) => x + way[k]);
    this.redraw(true);
  }

  /** The body at a place of the window, in pixels of the page. */
  bodyAt(x, y) {
    if (!this.withBodies.checked) return -1;
    const box = this.canvas.getBoundingClientRect(), unit = (2 * this.half) / box.height, turn = matrixOf(this.turn);
    const aside = timesTransposed(turn, [(x - box.left - box.width / 2) * unit, (box.top + box.height / 2 - y) * unit, 0]);
    return this.frame.hit(this.middle.map((value, k) => value + aside[k]), timesTransposed(turn, [0, 0, 1]), this.plane, Number(this.size.value));
  }

  async pick(event) {
    this.picked = this.bodyAt(event.clientX, event.clientY);
    await this.showValues();
    this.redraw();
  }

  /** What the frame says of the body that was clicked. */
  async showValues() {
    if (this.picked < 0 || this.picked >= this.frame.count) return this.values.replaceChildren();
    const rows = [["id", [this.picked]]];
    for (const [section, { name, components }] of [["Points", { name: "Points", components: 3 }], ...this.frame.particles.of("PointData").map((array) => ["PointData", array])]) {
      if (name === "axes") continue;
      const numbers = await this.frame.particles.numbers(section, name), unit = this.unitOf(name);
      const title = name === "Points" ? "centre" : name === "orientation" ? "orientation x y z w" : name;
      rows.push([unit ? `${title} (${unit})` : title, numbers.subarray(components * this.picked, components * (this.picked + 1))]);
    }
    this.values.replaceChildren(...rows.map(([name, numbers]) => make("tr", {}, make("td", { textContent: name }), make("td", { textContent: Array.from(numbers, shown).join(", ") }))));
  }

  async playOrStop() {
    this.playing = !this.playing;
    this.play.textContent = this.playing ? "Stop" : "Play";
    while (this.playing) {
      const begin = performance.now();
      await this.show((this.place + 1) % this.frames.length);
      await new Promise((next) => setTimeout(next, Math.max(0, 150 - (performance.now() - begin))));
    }
  }
}

/** The sample of this page, once it has been drawn; null where it cannot be. */
const sample = (async () => {
  const section = document.querySelector(".sample");
  const texts = [...document.querySelectorAll("script.frame")];
  const of = (kind, cycle) => texts.find(({ dataset }) => dataset.kind === kind && dataset.cycle === cycle)?.textContent;
  const frames = texts.filter(({ dataset }) => dataset.kind === "particles").map(({ dataset, textContent }) => (
    { cycle: dataset.cycle, time: Number(dataset.time), particles: textContent, chains: of("chains", dataset.cycle) }));
  try {
    const view = new SampleView(section, frames);
    await view.show(frames.length - 1);
    return view;
  } catch (fault) {
    section.append(make("p", { className: "note", textContent: fault.message }));
    return null;
  }
})();
