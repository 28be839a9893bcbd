// SPDX-License-Identifier: MIT
// The page of one pair: `tangency contact --view` has answered, and here it is drawn.

const element = (name) => document.getElementById(name);
const data = JSON.parse(element("pair").textContent);
const pair = { a: bodyOf(data.a), b: bodyOf(data.b) };
const drawing = new Drawing(element("scene"));

/** What is drawn: the points and the normal of the method that is chosen. */
function draw() {
  drawing.draw(pair, { spheres: element("with-spheres").checked, answer: { gaps: { "common-normal": data.gaps[element("method").value] } } });
}

/** One picture, however often the hand has moved since the last. */
let waiting = false;
function changed() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => ((waiting = false), draw()));
}

function fit() {
  drawing.camera.fit(pair, ...drawing.size);
  changed();
}

/** One finger or a mouse turns; two fingers and the wheel come nearer. */
function listen() {
  const scene = element("scene"), pointers = new Map(), place = (event) => [event.offsetX, event.offsetY];
  scene.addEventListener("pointerdown", (event) => {
    scene.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
  });
  scene.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId), now = place(event);
    if (!before) return;
    const others = [...pointers.keys()].filter((id) => id !== event.pointerId).map((id) => pointers.get(id));
    if (others.length === 0) drawing.camera.follow(now[0] - before[0], now[1] - before[1]);
    const span = (p) => Math.hypot(p[0] - others[0][0], p[1] - others[0][1]);
    if (others.length === 1 && span(before) > 0) drawing.camera.zoom(span(now) / span(before));
    pointers.set(event.pointerId, now);
    changed();
  });
  for (const end of ["pointerup", "pointercancel"]) scene.addEventListener(end, (event) => pointers.delete(event.pointerId));
  scene.addEventListener("wheel", (event) => {
    event.preventDefault();
    drawing.camera.zoom(Math.exp(-event.deltaY / 600)), changed();
  }, { passive: false });
  for (const name of ["method", "with-spheres"]) element(name).addEventListener("change", changed);
  element("fit").addEventListener("click", fit);
  window.addEventListener("resize", changed);
}

for (const [name, { status }] of Object.entries(data.gaps))
  element("method").append(Object.assign(new Option(name), { disabled: status !== "ok" && status !== "local" }));
for (const row of document.querySelectorAll("#gaps tr")) row.title = MEANS[row.dataset.method];
element("says").textContent = SAYS[data.gaps["common-normal"].relation];
listen();
fit();
