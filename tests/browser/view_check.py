#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sample in a report's page, in headless Chromium: what is drawn is what the frame says, and it keeps up with a hand.

Usage: view_check.py TANGENCY_DEM FOLDER
Runs a dense sample of 125 bodies with frames of contacts and, for the times, one of 10,000 in FOLDER. Along rays drawn
at random the body that a click finds, and what the picture has there, is compared with the frame as it is read here. Then
the page is used: colours, chains, cut, frames, hands, a wall. Last come times with 10,000 bodies: of pictures while the view turns, and of
the same bodies as meshes of 320 triangles beside. On a machine with other work the time of the graphics' own
process counts, where that is less. Ends with 1 at the first fault. Packages: .ci/setup browser
"""
import base64
import os
import pathlib
import random
import re
import statistics
import struct
import subprocess
import sys
import zlib

from browser import Browser

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from checks import require  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
SEED, RAYS, MARKED = 20261201, 1500, 125
DOUBT = 0.05  # of a body: nearer to its outline a ray proves nothing, since a pixel is not a point
NEAR = 1e-2  # length: of two bodies in contact, or cut where they overlap, single precision need not tell the first
QUICK = 250.0  # ms: the bar of a picture while the view turns
SPHEROIDS = """schema = 1
[cell]
[particles.spheroid]
count = {count}
mean_radius = 10.0
elongation = 1.4285714285714286
density = 1000.0
[contact]
normal_stiffness = 1.5e10
shear_stiffness = 1.5e10
friction_coefficient = 0.5
[[stage]]
kind = "place"
seed = 1
"""
PRESSED = """[[stage]]
kind = "compress"
mean_stress = 10e6
max_strain_rate = 0.02
[output]
frame_interval = 1000
contact_frames = true
"""


def report_of(tool, folder, name, scene):
    """The page of a run, and its directory."""
    out = folder / name
    (folder / f"{name}.toml").write_text(scene, encoding="utf-8")
    for command in (["run", folder / f"{name}.toml", "--out", out, "--replace", "--quiet"], ["report", out]):
        subprocess.run([tool, *map(str, command)], check=True, stdout=subprocess.DEVNULL)
    return out / "report.html", out


def arrays_of(frame):
    """The arrays of a .vtp file by name, rows of numbers: read by the script of the demo, which shares no code with the page."""
    text = subprocess.run([sys.executable, HERE.parents[1] / "bench" / "demo" / "frame_text.py", frame], check=True, capture_output=True,
                          text=True).stdout
    arrays = {}
    for name, rows in re.findall(r'<DataArray Name="([^"]*)">\n(.*?)</DataArray>', text, re.S):
        arrays[name] = [[float(x) for x in row.split()] for row in rows.splitlines()]
    return arrays


def big_endian(frame):
    """The same .vtp file as a machine of the other order of bytes writes it."""
    head, appended = frame.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
    parts, tail = [], 0

    def turn(tag):
        nonlocal tail
        offset, size = int(tag[2]), 8 if b'"Float64"' in tag[1] else 4
        blocks = int.from_bytes(appended[offset:offset + 8], "little")
        counts = struct.unpack_from(f"<{3 + blocks}Q", appended, offset)
        place, packed = offset + 8 * len(counts), []
        for length in counts[3:]:
            numbers = zlib.decompress(appended[place:place + length])
            packed.append(zlib.compress(b"".join(numbers[k:k + size][::-1] for k in range(0, len(numbers), size))))
            place += length
        part = struct.pack(f">{len(counts)}Q", *counts[:3], *map(len, packed)) + b"".join(packed)
        at, tail = tail, tail + len(part)
        parts.append(part)
        return tag[1] + b'offset="%d"' % at
    head = re.sub(rb'(<DataArray [^>]*)offset="(\d+)"', turn, head.replace(b"LittleEndian", b"BigEndian"))
    return head + b'<AppendedData encoding="raw">\n_' + b"".join(parts) + b"</AppendedData></VTKFile>"


def is_read_in_both_orders(browser, out):
    frame = sorted((out / "frames").glob("*.vtp"), key=lambda file: file.stat().st_size)[-1]
    both = [base64.b64encode(whole).decode() for whole in (frame.read_bytes(), big_endian(frame))]
    told = browser.run(ALL_NUMBERS, *both)
    require(len(told[0]) > 5 and told[0] == told[1], f"{frame.name} of a big-endian machine is read otherwise")


def turned(q, v):
    """v in the axes of a body: R' v, R of the quaternion x, y, z, w."""
    x, y, z, w = q
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)), (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
            (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)))
    return [sum(a * b for a, b in zip(row, v)) for row in rows]


def heights(arrays, start, way, plane):
    """Where a ray leaves each body that it meets, the greatest first: (t, body, how clearly). Of bodies that a plane
    {n, w} cuts only n.p <= w is there."""
    found = []
    for body, (centre, q, axes) in enumerate(zip(arrays["points"], arrays["orientation"], arrays["semi_axes"])):
        p = [x / r for x, r in zip(turned(q, [a - b for a, b in zip(start, centre)]), axes)]
        u = [x / r for x, r in zip(turned(q, way), axes)]
        uu, pu, pp = (sum(a * b for a, b in zip(v, w)) for v, w in ((u, u), (p, u), (p, p)))
        clear = 1 - (pp - pu * pu / uu)  # 1 in the middle of the outline, 0 on it
        if clear < -DOUBT:
            continue
        half = (max(clear, DOUBT) / uu) ** 0.5
        t = -pu / uu + half
        if plane:
            slope = sum(a * b for a, b in zip(plane["n"], way))
            cut = (plane["w"] - sum(a * b for a, b in zip(plane["n"], start))) / slope  # slope > 0: it faces the eye
            depth = (cut - (-pu / uu - half)) / half  # 0 where the plane is at the back of the body, 2 at its front
            if depth < -DOUBT:
                continue
            clear = min(clear, abs(depth), key=abs)
            t = min(t, cut)
        found.append((t, body, clear))
    return sorted(found, reverse=True)


RAY = """const v = await sample, box = v.canvas.getBoundingClientRect(), unit = 2 * v.half / box.height, m = matrixOf(v.turn);
const gl = v.renderer.gl, size = v.fullSize, scene = v.scene;
scene.picked = -1; scene.show.edges = false; v.renderer.draw(size, scene, true);
const pixels = new Uint8Array(4 * size[0] * size[1]);
gl.readPixels(0, 0, ...size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
return given[0].map(([fx, fy]) => {
  const i = Math.floor(fx * size[0]), j = Math.floor(fy * size[1]), x = (i + 0.5) / size[0] * box.width, y = (j + 0.5) / size[1] * box.height;
  const aside = timesTransposed(m, [(x - box.width / 2) * unit, (y - box.height / 2) * unit, 0]);
  const at = 4 * (j * size[0] + i);
  return { start: v.middle.map((p, k) => p + aside[k]), way: timesTransposed(m, [0, 0, 1]), hit: v.bodyAt(box.left + x, box.top + box.height - y),
           at, white: pixels[at] + pixels[at + 1] + pixels[at + 2] === 765 };
});"""
# The numbers of all arrays of files, which are given as base64.
ALL_NUMBERS = """return Promise.all(given.map(async (text) => {
  const file = new VtkFile(text);
  return Promise.all(file.arrays.map(async ({ of, name }) => [of, name, ...(await file.numbers(of, name))]));
}));"""
# What is picked when a pointer that came down elsewhere is lifted over the middle.
RELEASED = """const { canvas } = await sample, box = canvas.getBoundingClientRect();
(await sample).picked = -1;
canvas.dispatchEvent(new PointerEvent("pointerup", { pointerId: 9, clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 }));
return (await sample).picked;"""
# Pixels at the rim of the picture that something is drawn on.
AT_THE_RIM = """const v = await sample, gl = v.renderer.gl, [width, height] = v.fullSize;
v.renderer.draw([width, height], v.scene, true);
const pixels = new Uint8Array(4 * width * height);
gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
return Array.from({ length: width * height }, (_, k) => k).filter((k) => {
  const [x, y] = [k % width, Math.floor(k / width)], is_rim = x === 0 || y === 0 || x === width - 1 || y === height - 1;
  return is_rim && pixels[4 * k] + pixels[4 * k + 1] + pixels[4 * k + 2] < 765;
}).length;"""
# The bodies of given[0], of each whether its mark changes the picture at the places given[1].
MARKS = """const v = await sample, gl = v.renderer.gl, size = v.fullSize, scene = v.scene;
scene.show.edges = false;
const picture = (body) => {
  const pixels = new Uint8Array(4 * size[0] * size[1]);
  scene.picked = body; v.renderer.draw(size, scene, true);
  gl.readPixels(0, 0, ...size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels;
};
const plain = picture(-1);
return given[0].map((body) => { const marked = picture(body); return given[1].map((at) => plain[at + 1] !== marked[at + 1]); });"""


def same_as_the_frame(browser, out, cut):
    """Ray by ray; those within some pixels of an outline are left out. @param cut: the choice in the page"""
    plane = browser.run("const v = await sample; v.cut.value = given[0]; return v.plane", cut)
    cycle = browser.run("const v = await sample; return v.frames[v.place].cycle")
    arrays = arrays_of(out / "frames" / f"{cycle}.vtp")
    generator = random.Random(SEED)
    rays = browser.run(RAY, [[generator.uniform(0.3, 0.7), generator.random()] for _ in range(RAYS)])
    seen = {"bodies": 0, "nothing": 0, "in doubt": 0}
    certain = []
    for ray in rays:
        met = heights(arrays, ray["start"], ray["way"], plane)
        # What counts is the first body that is met for certain, if no doubtful one lies before it.
        if met and (abs(met[0][2]) <= DOUBT or (len(met) > 1 and met[0][0] - met[1][0] < NEAR)):
            seen["in doubt"] += 1
            continue
        true = met[0][1] if met else -1
        require(ray["hit"] == true, f"seed {SEED}: a click finds body {ray['hit']}, the frame has {true} there")
        require(ray["white"] == (true < 0), f"seed {SEED}: the picture is {'white' if ray['white'] else 'not white'} where the frame has {true}")
        seen["nothing" if true < 0 else "bodies"] += 1
        certain.append((ray["at"], true))
    marked_alone(browser, certain)
    require(seen["bodies"] > 40 and seen["nothing"] > 50, f"too few rays count: {seen}")
    print(f"{len(rays)} rays, seed {SEED}, {f'cut {cut}' if cut else 'no cut'}: " + ", ".join(f"{count} {what}" for what, count in seen.items()) + "; click and picture are as in the frame")


def marked_alone(browser, certain):
    """The picture has each body where it is in front, and nowhere else: a mark changes it there alone."""
    bodies = sorted({body for _, body in certain if body >= 0})[:MARKED]
    for body, changes in zip(bodies, browser.run(MARKS, bodies, [at for at, _ in certain])):
        for (_, true), changed in zip(certain, changes):
            require(changed == (true == body), f"seed {SEED}: the picture has body {body} {'' if changed else 'not '}where the frame has {true}")


def picked_is_drawn(browser):
    """The body that is picked is marked, and its values are the frame's."""
    box = browser.run("const b = (await sample).canvas.getBoundingClientRect(); return [b.width, b.height]")
    require(browser.run(RELEASED) == -1, "a hand that was put down beside the picture picks a body when it is lifted over it")
    browser.drag("canvas", (box[0] / 2, box[1] / 2), (0, 0))
    browser.run("await new Promise(requestAnimationFrame); await new Promise((next) => setTimeout(next, 0))")
    picked = browser.run("return (await sample).picked")
    rows = browser.run("return [...document.querySelectorAll('.sample table tr')].map((row) => row.innerText)")
    require(picked >= 0 and rows and rows[0].split() == ["id", str(picked)], f"a click in the middle shows {rows[:1]}")


def controls(browser, pictures):
    changed = """const v = await sample, before = v.canvas.toDataURL(); {}
      while (v.asked) await new Promise((next) => setTimeout(next, 20));
      v.drawNow(false); return v.canvas.toDataURL() !== before"""
    columns = browser.run("return (await sample).frame.columns")
    require({"contacts", "velocity", "velocity x", "type"} <= set(columns), f"columns: {columns}")
    for what, script in (
            ("another column", "v.colour.value = 'semi_axes'; v.colour.dispatchEvent(new Event('change')); await v.findRange(); await v.colourBodies();"
                               "v.colour.value = 'velocity'; await v.findRange(); await v.colourBodies();"),
            ("a cut", "v.cut.value = 'x'; v.cut.dispatchEvent(new Event('change'));"),
            ("its place", "v.cutAt.value = 0.3; v.cutAt.dispatchEvent(new Event('input'));"),
            ("smaller bodies", "v.size.value = 0.4; v.size.dispatchEvent(new Event('input'));"),
            ("force chains", "v.withChains.click();"),
            ("another frame", "await v.show(0);")):
        require(browser.run(changed.replace("{}", script)), f"{what} changes nothing")
    browser.run("const v = await sample; await v.show(v.frames.length - 1); v.cut.value = ''; v.cut.dispatchEvent(new Event('change'));"
                "v.drawNow(false); v.section.scrollIntoView()")
    browser.picture(pictures / "chains.png")
    browser.run("const v = await sample; v.playOrStop()")
    browser.run("const v = await sample, from = v.place; while (v.place === from) await new Promise((next) => setTimeout(next, 20)); await v.playOrStop()")


def walls(browser, page):
    """A [[wall]] is drawn where it is: its outline, around the cell's middle, in its plane and on faces of the cell."""
    browser.open(page)
    frame = browser.run("const { edges, cell, walls } = (await sample).frame; return { edges, cell: [...cell], walls: [...walls] }")
    require(len(frame["walls"]) == 4, f"the frame has the walls {frame['walls']}")
    n, w, sizes = frame["walls"][:3], frame["walls"][3], [frame["cell"][4 * k] for k in range(3)]
    points = [frame["edges"][k:k + 3] for k in range(72, len(frame["edges"]), 3)]
    require(len(points) == 8, f"the outline of a plane through four edges of the cell has {len(points)} ends")
    for p in points:
        require(abs(sum(a * b for a, b in zip(n, p)) - w) < 1e-12, f"{p} is not in the wall")
        require(sum(min(abs(x), abs(x - size)) < 1e-12 for x, size in zip(p, sizes)) >= 2, f"{p} is on no edge of the cell")
    require(all(sum(p == q for q in points) == 2 for p in points), "the outline is not closed")


def plane(browser, page):
    """A sample of the plane is seen from the front and fills the picture, though the third edge of its cell is a unit."""
    browser.open(page)
    turn, half, cell = browser.run("const v = await sample; return [v.turn, v.half, [...v.frame.cell]]")
    require(turn == [1, 0, 0, 0] and half < max(cell[0], cell[4]), f"a plane cell of {cell[0]} by {cell[4]} is seen by {turn} with half a height of {half}")


def looks(browser, page, pictures):
    for width, height in ((1200, 900), (400, 800)):
        browser.size(width, height, touch=width < 600)
        browser.open(page)
        browser.run("const v = await sample; v.section.scrollIntoView(); v.drawNow(false)")
        wide = browser.run("return document.documentElement.scrollWidth")
        require(wide <= width, f"at {width} pixels the page is {wide} wide")
        require(browser.run(AT_THE_RIM) == 0, f"at {width} pixels the picture cuts the sample")
        browser.picture(pictures / f"view-{width}.png")
    before = browser.run("return (await sample).turn")
    browser.drag(".sample canvas", (150, 150), (60, 30), kind="touch")
    require(browser.run("return (await sample).turn") != before, "a finger does not turn the sample")


def graphics_process(browser):
    """Chromium's process that draws."""
    parents = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                parents.setdefault(int(pathlib.Path("/proc", entry, "stat").read_text().rsplit(")", 1)[1].split()[1]), []).append(int(entry))
            except OSError:
                pass  # it has ended
    todo = [browser.driver.service.process.pid]
    while todo:
        pid = todo.pop()
        todo += parents.get(pid, [])
        if b"--type=gpu-process" in pathlib.Path("/proc", str(pid), "cmdline").read_bytes():
            return pid
    return sys.exit("view_check: Chromium has no process for graphics")


def processor_ms(pid):
    fields = pathlib.Path("/proc", str(pid), "stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * 1000 / os.sysconf("SC_CLK_TCK")


def times(browser, page):
    browser.size(1200, 900)
    browser.open(page)
    name, count, full = browser.run("const v = await sample; v.drawNow(false); return [v.renderer.name, v.frame.count, v.fullSize]")
    pid = graphics_process(browser)
    browser.run("(await sample).times.length = 0")
    begin = processor_ms(pid)
    for turn in range(3):
        browser.drag(".sample canvas", (300, 200), (150, 20 * turn), steps=8)
    browser.run("const v = await sample; while (v.asked) await new Promise((next) => setTimeout(next, 20))")
    spent = processor_ms(pid) - begin
    moving = [time for time in browser.run("return (await sample).times") if time["moving"]]
    require(len(moving) >= 3, f"{len(moving)} pictures while a hand turned the view")
    walls = [time["ms"] for time in moving]
    each = spent / len(browser.run("return (await sample).times"))
    print(f"{count} bodies, {name}: {len(moving)} pictures while it turned, median {statistics.median(walls):.0f} ms, longest {max(walls):.0f} ms, "
          f"{each:.0f} ms of processors each; {min(t['pixels'] for t in moving)} to {max(t['pixels'] for t in moving)} of {full[0] * full[1]} pixels")
    require(min(statistics.median(walls), each) <= QUICK, f"a picture takes more than {QUICK} ms while the view turns")
    return pid, full


def beside_meshes(browser, pid, full):
    browser.run("const element = document.createElement('script'); element.textContent = given[0]; document.head.append(element)",
                (HERE / "meshes.js").read_text(encoding="utf-8"))
    browser.run("const v = await sample; window.made = await meshes(v); made.draw(given[0], v.scene); v.renderer.draw(given[0], v.scene, true)", full)
    spent = {}
    for what, call in (("view", "v.renderer.draw(given[0], v.scene, true)"), ("meshes", "made.draw(given[0], v.scene)")):
        begin = processor_ms(pid)
        walls = browser.run(f"const v = await sample, all = []; for (let k = 0; k < 3; ++k) all.push({call}); return all", full)
        spent[what] = (min(walls), (processor_ms(pid) - begin) / 3)
    triangles = browser.run("return made.triangles")
    print(f"full picture, {full[0]} x {full[1]}: view {spent['view'][0]:.0f} ms ({spent['view'][1]:.0f} of processors), instanced meshes of "
          f"{triangles} triangles {spent['meshes'][0]:.0f} ms ({spent['meshes'][1]:.0f})")
    require(spent["view"][1] <= 0.5 * spent["meshes"][1], "the view takes more than half of what meshes take")


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: view_check.py TANGENCY_DEM FOLDER")
    tool, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    page, out = report_of(tool, folder, "pressed", SPHEROIDS.format(count=125) + PRESSED)
    slope, _ = report_of(tool, folder, "slope", (HERE.parents[1] / "dem" / "scenes" / "slope.toml").read_text(encoding="utf-8"))
    flat, _ = report_of(tool, folder, "flat", SPHEROIDS.format(count=100).replace("[cell]", "[cell]\ndimensions = 2").replace(
        "_radius = 10.0", "_radius = 0.001").replace("1.5e10", "1e5"))
    many, _ = report_of(tool, folder, "many", SPHEROIDS.format(count=10_000))
    with Browser() as browser:
        browser.size(1200, 900)
        browser.open(page)
        require(browser.run("return (await sample) !== null"), "the sample is not drawn")
        for cut in ("", "y", "-x"):  # those that face the eye
            same_as_the_frame(browser, out, cut)
        browser.run("(await sample).cut.value = ''")
        picked_is_drawn(browser)
        is_read_in_both_orders(browser, out)
        controls(browser, folder)
        looks(browser, page, folder)
        walls(browser, slope)
        plane(browser, flat)
        pid, full = times(browser, many)
        beside_meshes(browser, pid, full)
        browser.picture(folder / "many.png")
        complaints = browser.complaints()
        require(not complaints, "the console says: " + "; ".join(complaints))
    print(f"controls, hands, 1200 and 400 pixels: as they should be; pictures in {folder}")


main()
