// Fingers on the canvas. Over the pot one is the left button of a mouse, and two turn the view and
// zoom. Over panels one presses or scrolls.
'use strict';

const kPressMs = 90;        // a second finger that arrives within it makes a gesture, not a press
const kPressPx = 6;         // or the first finger moves by more
const kNotchRatio = 9 / 8;  // of the distance of two fingers: a step of the mouse wheel
const kScrollPx = 80;       // of a finger over a panel: a step of the mouse wheel

/// `mouse` moves and presses: {move(x, y), press(button, down), scroll(steps), overPot()}; 0 is the
/// left button, 2 the middle one. Places are those of the page [px].
class Fingers {
  constructor(mouse) {
    this.mouse = mouse;
    this.down = new Map();  // places by pointer
    this.state = 'none';    // none, waiting, pressing, turning, scrolling, ended
  }

  /// The middle of the first two fingers, and their distance; of one, its place.
  pair() {
    const [a, b = a] = [...this.down.values()];
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, far: Math.hypot(a.x - b.x, a.y - b.y)};
  }

  press() {
    clearTimeout(this.timer);
    if (this.state !== 'waiting') return;
    this.state = 'pressing';
    this.mouse.press(0, true);
  }

  begin(event) {
    this.down.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (this.down.size === 1) {
      this.state = 'waiting';
      this.first = {x: event.clientX, y: event.clientY};
      this.mouse.move(event.clientX, event.clientY);
      this.timer = setTimeout(() => { if (this.mouse.overPot()) this.press(); }, kPressMs);
    } else if (this.down.size === 2) {
      clearTimeout(this.timer);
      if (this.state === 'pressing') this.mouse.press(0, false);
      if (this.state === 'scrolling' || this.state === 'ended') return;
      this.last = this.pair();
      this.mouse.move(this.last.x, this.last.y);
      this.state = this.mouse.overPot() ? 'turning' : 'scrolling';
      if (this.state === 'turning') this.mouse.press(2, true);
    }
  }

  move(event) {
    if (!this.down.has(event.pointerId)) return;
    this.down.set(event.pointerId, {x: event.clientX, y: event.clientY});
    const right = Math.abs(event.clientX - this.first.x), down = Math.abs(event.clientY - this.first.y);
    if (this.state === 'waiting' && Math.hypot(right, down) > kPressPx) {
      if (down > right && !this.mouse.overPot()) {
        this.state = 'scrolling';
        this.last = this.pair();
      } else {
        this.press();
      }
    }
    if (this.state === 'pressing') this.mouse.move(event.clientX, event.clientY);
    if (this.state !== 'scrolling' && (this.state !== 'turning' || this.down.size < 2)) return;
    const now = this.pair();
    if (this.state === 'turning') {
      this.mouse.move(now.x, now.y);
      if (now.far > 0 && this.last.far > 0)
        this.mouse.scroll(Math.log(now.far / this.last.far) / Math.log(kNotchRatio));
    } else {
      this.mouse.scroll((now.y - this.last.y) / kScrollPx);
    }
    this.last = now;
  }

  touching() { return this.down.size > 0; }

  /// False: the finger did nothing. `cancelled`: the system has taken the finger, so it was no tap.
  end(event, cancelled = false) {
    if (!this.down.delete(event.pointerId)) return false;
    if (this.state === 'waiting' && !cancelled) this.press();  // a tap
    this.release();
    return true;
  }

  /// Another pointer goes on alone.
  stop() {
    this.down.clear();
    this.release();
  }

  release() {
    clearTimeout(this.timer);
    if (this.state === 'pressing') this.mouse.press(0, false);
    if (this.state === 'turning') this.mouse.press(2, false);
    this.state = this.down.size > 0 ? 'ended' : 'none';  // the fingers that are left do nothing
  }
}
