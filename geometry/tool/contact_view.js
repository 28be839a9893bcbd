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

const changed = oncePerPicture(draw);

function fit() {
  drawing.camera.fit(pair, ...drawing.size);
  changed();
}

/** One pointer turns; two pointers and the wheel come nearer. */
function listen() {
  listenToHands(element("scene"), {
    drag: (dx, dy) => (drawing.camera.follow(dx, dy), changed()),
    nearer: (factor) => (drawing.camera.zoom(factor), changed()),
  });
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
