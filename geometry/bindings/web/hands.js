// SPDX-License-Identifier: MIT
// What mice and fingers do on a canvas, in one way for every page: one pointer drags, two pointers and the wheel come nearer.

/** Pixels that a pointer may walk in a click. Chosen: a hand is not quite still. */
const STILL = 4;
/** A turn of the screen's frame that follows the hand: a radian for 150 pixels. */
const handTurn = (dx, dy) => turnAbout([dy, dx, 0], Math.hypot(dx, dy) / 150);

/**
 * Listens on an element. Places are pixels from its upper left corner, x to the right, y downwards; dx, dy from the last place to this one.
 * @param on what is called, of which nearer alone may not be left out:
 *   grasp(place)         a first pointer has come down
 *   drag(dx, dy, event)  it moves, and is the only one
 *   slide(dx, dy)        two pointers move together
 *   nearer(factor)       two pointers part, or the wheel turns: by > 1 nearer, by < 1 farther
 *   click(event)         one pointer has come and gone, and has hardly moved
 */
function listenToHands(element, on) {
  const pointers = new Map();
  let walked = 0;
  const placeOf = (event) => {
    const box = element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const down = (event) => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, placeOf(event));
    walked = pointers.size === 1 ? 0 : Infinity;
    if (pointers.size === 1) on.grasp?.(placeOf(event));
  };
  const moved = (event) => {
    const before = pointers.get(event.pointerId), now = placeOf(event);
    if (!before) return;
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    walked += Math.hypot(dx, dy);
    pointers.set(event.pointerId, now);
    if (pointers.size === 1) on.drag?.(dx, dy, event);
    if (pointers.size !== 2) return;
    const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    const span = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]);
    on.slide?.(dx / 2, dy / 2);
    if (span(before) > 0) on.nearer(span(now) / span(before));
  };
  element.addEventListener("pointerdown", down);
  element.addEventListener("pointermove", moved);
  element.addEventListener("pointerup", (event) => {
    const wasHere = pointers.delete(event.pointerId);  // it came down here, not beside
    if (wasHere && walked < STILL) on.click?.(event);
  });
  element.addEventListener("pointercancel", (event) => pointers.delete(event.pointerId));
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    on.nearer(Math.exp(-event.deltaY / 600));
  }, { passive: false });
}

/** A function that asks for one picture, however often it is called before the browser draws. */
function oncePerPicture(draw) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => ((waiting = false), draw()));
  };
}
