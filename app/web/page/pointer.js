// The pointer on the canvas: mouse and pen; fingers by touch.js.
'use strict';

const kNotchPx = 100, kNotchLines = 3;  // of the mouse wheel
const kPinchPx = 12;       // of a pinch, as much as a notch
const kShift = 1, kControl = 2, kAlt = 4;

function mods(event) {
  if (event.getModifierState?.('AltGraph')) return event.shiftKey ? kShift : 0;
  return (event.shiftKey ? kShift : 0) | (event.ctrlKey || event.metaKey ? kControl : 0) |
         (event.altKey ? kAlt : 0);
}

function point(event) {
  const box = canvas.getBoundingClientRect();
  studio._claystack_pointer((event.clientX - box.left) * canvas.width / box.width,
                            (event.clientY - box.top) * canvas.height / box.height,
                            event.pointerType === 'pen' ? event.pressure : -1);
}

const kButtonBits = [1, 2, 4];  // left, right, middle: the order of the program
const down = new Set();
function button(index, pressed, event) {
  if (pressed === down.has(index)) return;
  if (pressed) down.add(index); else down.delete(index);
  studio._claystack_button(index, pressed, mods(event));
  ask();
}

/// The browser reports the first button as `pointerdown`, and further ones as moves.
function mouse(event) {
  point(event);
  kButtonBits.forEach((bit, index) => button(index, (event.buttons & bit) !== 0, event));
}

/// Steps of the wheel. Touchpads report many small parts of a step, and a pinch as the wheel with Ctrl.
function wheelSteps(event) {
  const notch = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? (event.ctrlKey ? kPinchPx : kNotchPx)
    : event.deltaMode === WheelEvent.DOM_DELTA_LINE ? kNotchLines : 1;
  return Math.max(-1, Math.min(1, -event.deltaY / notch));
}

const fingers = new Fingers({
  move(x, y) { point({clientX: x, clientY: y}); ask(); },
  press(index, pressed) { button(index, pressed, {}); },
  scroll(steps) { studio._claystack_scroll(steps); ask(); },
  overPot() { return studio._claystack_over_pot(); },
});

function listenToPointer() {
  canvas.addEventListener('pointerdown', event => {
    canvas.focus();
    canvas.setPointerCapture(event.pointerId);
    event.preventDefault();  // else a touch also sends mouse events, which move the focus later
    if (event.pointerType !== 'touch') {
      fingers.stop();  // the palm of the hand that holds a pen
      mouse(event);
    } else if (down.size === 0 || fingers.touching()) {
      fingers.begin(event);
    }
  });
  canvas.addEventListener('pointermove', event => {
    if (event.pointerType === 'touch') return fingers.move(event);
    for (const part of event.getCoalescedEvents?.().slice(-1) ?? []) event = part;
    if (down.size > 0) mouse(event); else point(event);
    ask();
  });
  canvas.addEventListener('pointerup', event => {
    if (event.pointerType !== 'touch') return mouse(event);
    if (fingers.end(event) && !studio._claystack_over_pot()) keyboard.tapped();
  });
  canvas.addEventListener('pointercancel', event => {
    if (event.pointerType === 'touch') return fingers.end(event, true);
    for (const b of [...down]) button(b, false, event);
  });
  canvas.addEventListener('wheel', event => {
    studio._claystack_scroll(wheelSteps(event));
    ask();
    event.preventDefault();
  }, {passive: false});
  canvas.addEventListener('contextmenu', event => event.preventDefault());
}
