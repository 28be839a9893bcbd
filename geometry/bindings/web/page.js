// SPDX-License-Identifier: MIT
// The playground: what a hand does to the pair, and what the kernel says of it.

const START = {
  "Needle and disc": [0, 0, 0, 2, 0.5, 0.5, 0.9, 0.1, 0.3, 0.2, 1.9, 0.4, 0.9, 1.2, 1.2, 0.3, 0.8, 0.4, -0.3, 0.1],
  "Apart, but their spheres overlap": [0, 0, 0, 2, 0.5, 0.5, 1, 0, 0, 0, 0, 1.5, 0.2, 2, 0.6, 0.5, 1, 0, 0, 0.15],
  "An exact touch": [0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 3, 0, 0, 2, 1, 1, 1, 0, 0, 0],
  "The next double after a touch": [0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 3.0000000000000004, 0, 0, 2, 1, 1, 1, 0, 0, 0],
  "One in the other, touching": [0.5, 0, 0, 0.5, 0.5, 0.5, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0],
  "Deep in each other": [0, 0, 0, 2, 1, 0.6, 1, 0, 0, 0, 0.3, 0.2, 0.1, 0.7, 1.8, 1, 0.9, 0.2, 0.1, 0.4],
};

const element = (name) => document.getElementById(name);
const state = { pair: null, selected: "b", mode: "move", spheres: false, language: "C++", answer: null };
const drawing = new Drawing(element("scene"));

const pairOf = (numbers) => ({ a: bodyOf(numbers.slice(0, 10)), b: bodyOf(numbers.slice(10)) });
const short = (x) => (x === null ? "" : String(Number(x.toPrecision(7))));
const error = (x) => (x === null ? "" : x === 0 ? "0" : x.toExponential(1));

/** One answer and one picture, however often the pair has changed since the last. */
const changed = oncePerPicture(show);

function show() {
  try {
    state.answer = tangency.kernel.answer(pairNumbers(state.pair));
  } catch (fault) {
    state.answer = { refused: fault.message };
  }
  showAnswer(state.answer);
  if (!state.answer.refused) drawing.draw(state.pair, state);  // else the picture stays that of the last pair
  showNumbers();
  element("csv").textContent = csvOf(state.pair);
  element("code").textContent = CODE[state.language](state.pair);
  clearTimeout(addressing);
  addressing = setTimeout(address, REST);
}

/** Milliseconds without a change after which the address follows. Chosen: browsers refuse some hundred changes in a row. */
const REST = 150;
let addressing = null;
const address = () => history.replaceState(null, "", linkOf(state.pair));

function gapLine(gap) {
  return gap === null || gap === 0 ? "" : gap > 0 ? ` Distance ${short(gap)}.` : ` Depth ${short(-gap)}.`;
}

function showAnswer(answer) {
  element("says").textContent = answer.refused ?? SAYS[answer.relation] + (answer.inner ? ` Inside: ${answer.inner.toUpperCase()}.` : "") +
    gapLine(answer.gaps["common-normal"].gap);
  element("relation").textContent = answer.refused ? "" : answer.relation;
  const rows = [], spheres = sphereGap(state.pair);
  for (const [name, gap] of Object.entries(answer.gaps ?? {})) {
    const normal = gap.gap === null ? "" : [gap.nx, gap.ny, gap.nz].map((x) => x.toFixed(4)).join(" ");
    rows.push([name, gap.gap === null ? gap.status : short(gap.gap), error(gap.gap_error), normal, gap.status]);
  }
  if (!answer.refused) rows.push(["spheres", short(spheres), "", "", ""]);
  element("gaps").replaceChildren(...rows.map(([name, gap, bound, normal, status]) => {
    const row = document.createElement("tr");
    row.title = MEANS[name];
    const cells = [name === "spheres" ? "bounding spheres" : name, gap + (status === "local" ? " (local)" : ""), bound, normal];
    row.append(...cells.map((text, k) => Object.assign(document.createElement(k ? "td" : "th"), { textContent: text })));
    return row;
  }));
  showPoints(answer, spheres);
}

function showPoints(answer, spheres) {
  const gap = answer.gaps?.["common-normal"];
  const point = (name) => ["x", "y", "z"].map((axis) => short(gap[`${name}.${axis}`])).join(", ");
  element("points").textContent = !gap || gap.gap === null ? "" :
    `Witness points: on A ${point("pa")}; on B ${point("pb")}.` +
    (answer.F === null ? "" : ` Scaled by ${short(answer.mu)} about their centres, both just touch.`);
  const apart = answer.relation === "separate", wrong = !answer.refused && spheres <= 0 && apart;
  element("spheres-say").textContent = answer.refused ? "" : spheres > 0 ? "Bounding spheres say: apart. So are the bodies." :
    wrong ? "Bounding spheres overlap, though the bodies are apart: spheres alone would have claimed a contact." :
      "Bounding spheres meet: they leave the question open.";
}

/** The fields, but for the one that is being written in. */
function showNumbers() {
  for (const field of document.querySelectorAll("#numbers input"))
    if (field !== document.activeElement) field.value = textOf(state.pair[field.dataset.body][field.dataset.name]);
}

function makeNumbers() {
  for (const name of BODY_COLUMNS) {
    const row = document.createElement("tr");
    row.append(Object.assign(document.createElement("th"), { textContent: name }));
    for (const body of ["a", "b"]) {
      const field = document.createElement("input");
      Object.assign(field, { type: "text", inputMode: "decimal", autocomplete: "off" });
      Object.assign(field.dataset, { body, name });
      field.setAttribute("aria-label", `${body}.${name}`);
      field.addEventListener("focus", () => (state.selected = body));
      field.addEventListener("input", () => {
        const value = field.value.trim() === "" ? NaN : Number(field.value);
        state.pair[body][name] = value;
        changed();
      });
      const cell = document.createElement("td");
      cell.append(field), row.append(cell);
    }
    element("numbers").append(row);
  }
}

// A drag does what the mode says to the body under it; at the ends of the axes it squashes, beside the bodies it turns the view.
let held = null;

function grasp([x, y]) {
  const near = drawing.tips(state.pair[state.selected]).filter(({ place }) => Math.hypot(place[0] - x, place[1] - y) < 14);
  near.sort((p, q) => q.place[2] - p.place[2]);
  if (near.length > 0) return { what: "squash", ...near[0] };
  const body = drawing.bodyAt(x, y, state.pair);
  if (body === null) return { what: "view" };
  state.selected = body;
  return { what: state.mode };
}

const ACTIONS = {
  view: (dx, dy) => drawing.camera.follow(dx, dy),
  move(dx, dy) {
    const body = state.pair[state.selected], { scale, matrix } = drawing.camera;
    const way = timesTransposed(matrix, [dx / scale, -dy / scale, 0]);
    CENTRE.forEach((name, k) => (body[name] += way[k]));
  },
  turn(dx, dy) {
    const body = state.pair[state.selected], view = drawing.camera.turn;
    const back = [view[0], -view[1], -view[2], -view[3]];
    const turn = product(product(back, handTurn(dx, dy)), view);
    const turned = normalised(product(turn, normalised(TURN.map((name) => body[name]))));
    TURN.forEach((name, k) => (body[name] = turned[k]));
  },
  squash(dx, dy) {
    const body = state.pair[state.selected], [wx, wy] = held.way, size = wx * wx + wy * wy;
    if (size < 1) return;  // the axis points to the eye
    const name = AXES[held.axis], factor = 1 + (dx * wx + dy * wy) / size;
    body[name] = Math.max(body[name] * factor, 1e-3 * Math.max(body.r1, body.r2, body.r3));
    held.way = held.way.map((x) => x * factor);
  },
};

function listen() {
  listenToHands(element("scene"), {
    grasp: (place) => ((held = grasp(place)), changed()),
    drag: (dx, dy) => (ACTIONS[held.what](dx, dy), changed()),
    nearer: (factor) => (drawing.camera.zoom(factor), changed()),
  });
  for (const button of document.querySelectorAll("[data-mode]"))
    button.addEventListener("click", () => pressed("mode", (state.mode = button.dataset.mode)));
  for (const button of document.querySelectorAll("[data-language]"))
    button.addEventListener("click", () => (pressed("language", (state.language = button.dataset.language)), changed()));
  element("with-spheres").addEventListener("change", (event) => ((state.spheres = event.target.checked), changed()));
  element("start").addEventListener("change", (event) => use(pairOf(START[event.target.value])));
  element("fit").addEventListener("click", () => (drawing.camera.fit(state.pair, ...drawing.size), changed()));
  element("copy").addEventListener("click", copyLink);
  window.addEventListener("resize", changed);
  window.addEventListener("hashchange", () => {
    const pair = pairOfLink(location.hash);
    if (pair) use(pair);
  });
}

async function copyLink() {
  address();
  try {
    await navigator.clipboard.writeText(location.href);
    element("copy").textContent = "Copied";
  } catch {
    element("copy").textContent = "Copy it from the address line";
  }
}

function pressed(name, value) {
  for (const button of document.querySelectorAll(`[data-${name}]`))
    button.setAttribute("aria-pressed", String(button.dataset[name] === value));
}

function use(pair) {
  state.pair = pair;
  drawing.camera.fit(pair, ...drawing.size);
  changed();
}

/** For programs that drive the page: tangency.ready resolves once it answers. */
const tangency = { state, START, linkOf, pairOfLink, csvOf, pairOf };
tangency.ready = Kernel.load(element("module").textContent).then((kernel) => {
  tangency.kernel = kernel;
  makeNumbers();
  element("start").append(...Object.keys(START).map((name) => new Option(name)));
  listen();
  const linked = pairOfLink(location.hash);
  if (linked) element("start").selectedIndex = -1;
  use(linked ?? pairOf(Object.values(START)[0]));
}).catch((fault) => {
  element("says").textContent = `This browser cannot run the kernel (${fault.message}). It needs WebAssembly and DecompressionStream.`;
  throw fault;
});
window.tangency = tangency;
