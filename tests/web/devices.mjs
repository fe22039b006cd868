// Pen, gamepad and 3Dconnexion controller in the page. The motion at the clay is read from the
// recorded work: its poses are the tool's path, in mm and ms. Expected speeds: docs/studio.md, "Pen
// and gamepad", and docs/devices.md.
import assert from 'node:assert/strict';
import {readdirSync, readFileSync, rmSync} from 'node:fs';
import {basename, join} from 'node:path';
import {beginBowl, chord, downloaded, pause} from './browser.mjs';

const kQuantumMm = 2 ** -16;  // of positions in a work

/// Partial sums.
const summed = steps => steps.reduce((all, step) => [...all, (all.at(-1) ?? 0) + step], []);

/// The poses {ms, x, y, rho} of a block (samples/schema/session.schema.json): one number where all
/// agree, else a first place, a first difference, and second differences.
function posesOf({n, t_us, dt_us, x, y, z}) {
  const places = axis => (Array.isArray(axis) ? summed([axis[0], ...summed(axis.slice(1))])
    : Array(n).fill(axis)).map(count => count * kQuantumMm);
  const steps = Array.isArray(dt_us) ? dt_us : Array(n - 1).fill(dt_us);
  const [xs, ys, zs] = [x, y, z].map(places);
  return summed([t_us, ...steps]).map((us, i) =>
    ({ms: us / 1000, x: xs[i], y: ys[i], rho: Math.hypot(xs[i], zs[i])}));
}

/// The strokes of a work, each its poses.
function strokesOf(work) {
  const strokes = [];
  for (const line of readFileSync(work, 'utf8').split('\n').filter(Boolean).map(JSON.parse)) {
    if ('parent' in line) strokes.push([]);
    if ('n' in line) strokes.at(-1).push(...posesOf(line));
  }
  return strokes.filter(stroke => stroke.length > 0);  // not the lump
}

/// The poses while a quantity of theirs goes from one value up to another, for the first time.
function part(poses, of, from, to) {
  const first = poses.findIndex(pose => of(pose) >= from), end = poses.findIndex(pose => of(pose) >= to);
  assert.ok(first >= 0 && end > first,
    `expected a stroke that goes from ${from} to ${to}, found ${Math.max(...poses.map(of)).toFixed(1)}`);
  return poses.slice(first, end);
}

/// Mean speed of a quantity of the poses [mm/s].
function speed(poses, of) {
  return 1000 * (of(poses.at(-1)) - of(poses[0])) / (poses.at(-1).ms - poses[0].ms);
}

/// The median speed between poses: an event that the browser delivers late does not change it.
function steadySpeed(poses, of) {
  const speeds = poses.slice(1).map((pose, i) => speed([poses[i], pose], of)).sort((a, b) => a - b);
  return speeds[Math.floor(speeds.length / 2)];
}

function near(found, expected, relative, what) {
  assert.ok(Math.abs(found - expected) <= relative * Math.abs(expected),
    `${what}: expected ${expected.toFixed(2)}, found ${found.toFixed(2)}`);
}

/// Waits for a time of the wheel [ms]: a frame counts for 100 ms at most (WebHost).
const turns = (page, ms) => page.evaluate(ms => new Promise(done => {
  let left = ms, last = performance.now();
  const frame = now => {
    left -= Math.min(100, Math.max(0, now - last));
    last = now;
    if (left > 0) requestAnimationFrame(frame); else done();
  };
  requestAnimationFrame(frame);
}), ms);

/// The lump of the bowl on the wheel; `before` runs before the scripts of the page.
async function lump(open, before) {
  const page = await open(before);
  await beginBowl(page);
  await page.says('checked: proved');
  return page;
}

/// Saves the work and returns its strokes.
export async function saved(page, folder) {
  for (const name of readdirSync(folder)) if (name.endsWith('.work')) rmSync(join(folder, name));
  await page.focus('#canvas');
  await chord(page, 'KeyS', 'Control');
  await page.says('action: file.save');
  await pause(500);
  await page.keyboard.press('Enter');
  await page.says('saved: ');
  // Beside an older bowl.work in the page's storage it is bowl-2.work.
  const {text} = await page.lastLine('saved: ');
  return strokesOf(await downloaded(folder, basename(text.slice('saved: '.length))));
}

// The lump is a cylinder of 48 mm radius and 40 mm height. Strokes are made at half of its height, by
// the first tool, a ball of 10 mm radius, at the first speed of the wheel. The hand presses with up to
// 80 mm/s.
const kLumpMm = 48, kLumpHighMm = 40, kBallMm = 10, kTurnsPerS = 2, kHandMmPerS = 80;
const depth = pose => kLumpMm + kBallMm - pose.rho;

/// Speed of the tool into the clay [mm/s] between two depths.
function bite(stroke, depths) {
  const poses = part(stroke, depth, ...depths);
  for (const {y} of poses)
    assert.ok(y >= kBallMm && y <= kLumpHighMm - kBallMm, `expected the whole ball beside the lump, found it at ${y}`);
  return steadySpeed(poses, depth);
}

/// The expected speed of a press [mm/s] whose target is far within the clay, at this depth. In one
/// turn of the wheel the clay yields to the height of the tool times the bite, 0.5 to 20 mm by the
/// strength, in equal ratios. The tool meets it with a chord, and goes no faster than the hand.
function expectedBite(strength, depth) {
  const yields = 0.5 * 40 ** strength * kTurnsPerS * 2 * kBallMm;  // mm2/s
  return Math.min(kHandMmPerS, yields / (2 * Math.sqrt(depth * (2 * kBallMm - depth))));
}

/// The speeds of strokes with these strengths.
function checkBites(strokes, strengths, what) {
  const kDepths = [3, 5], kMeanDepth = 4;
  assert.equal(strokes.length, strengths.length);
  const found = strokes.map(stroke => bite(stroke, kDepths));
  const expected = strengths.map(strength => expectedBite(strength, kMeanDepth));
  const shown = values => values.map(v => v.toFixed(1)).join(', ');
  console.log(`  ${what}: ${shown(found)} mm/s into the clay, expected ${shown(expected)}`);
  // Clay that bulges lengthens the chord.
  found.forEach((v, i) => near(v, expected[i], 0.08, `${what}, strength ${strengths[i].toFixed(2)} [mm/s]`));
}

// Places of the pointer [px]: beside the lump, at its surface, and about 20 mm within it, at half of
// its height. The view stands still when the timeline appears over it.
const kBesidePx = 790, kSurfacePx = 782, kWithinPx = 700, kHalfHeightPx = 345;

/// A firmer pen goes faster into the clay.
export async function pen({open, folder}) {
  const page = await lump(open);
  const events = await page.createCDPSession();
  const stroke = async (force, count) => {
    const event = (type, x, more) => events.send('Input.dispatchMouseEvent',
      {type, x, y: kHalfHeightPx, pointerType: 'pen', force, button: 'left', clickCount: 1, buttons: 1, ...more});
    await event('mouseMoved', kBesidePx, {button: 'none', buttons: 0, force: 0});
    await pause(300);
    await event('mousePressed', kBesidePx);
    // The hand slows down in contact, from the next event of the pen on.
    for (const x of [kSurfacePx, kWithinPx, kWithinPx - 1, kWithinPx]) {
      await event('mouseMoved', x);
      await turns(page, 400);
    }
    await turns(page, 2500);
    await event('mouseReleased', kWithinPx, {buttons: 0});
    await page.says('stroke ended', count);
    await chord(page, 'KeyZ', 'Control');
    await page.says('action: edit.undo', count);
  };
  const kForces = [0.2, 0.5, 0.9];
  for (const [i, force] of kForces.entries()) await stroke(force, i + 1);
  checkBites(await saved(page, folder), kForces, 'pen');
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}

/// The gamepad that the page reads, made before its scripts run. The test sets axes and buttons.
function fakePad() {
  const pad = {id: 'Test Pad (Vendor: 045e Product: 028e)', index: 0, connected: true, mapping: 'standard',
    axes: [0, 0, 0, 0], buttons: Array.from({length: 17}, () => ({pressed: false, value: 0}))};
  navigator.getGamepads = () => [pad, null, null, null];
  window.hold = (button, value) => { pad.buttons[button] = {pressed: value > 0.5, value}; };
  window.lean = (axis, value) => { pad.axes[axis] = value; };
  window.plug = (other = {}) => window.dispatchEvent(
    Object.assign(new Event('gamepadconnected'), {gamepad: {...pad, ...other}}));
}

/// Part of the full speed of a stick.
const rate = (way, dead) => ((way - dead) / (1 - dead)) ** 2;

/// The trigger presses, the stick moves the tool, the buttons undo and redo.
export async function gamepad({open, folder}) {
  const page = await lump(open, fakePad);
  const kRight = 7, kUndo = 4, kRedo = 5, kX = 0;  // of the standard layout
  const kHalf = 0.5, kFast = 0.9;                  // deflections of the stick
  const hold = (button, value) => page.evaluate((b, v) => window.hold(b, v), button, value);
  const lean = (axis, value) => page.evaluate((a, v) => window.lean(a, v), axis, value);
  await page.evaluate(() => window.plug({id: 'Odd Pad (Vendor: 1234)', mapping: ''}));
  await page.shows('status', /Odd Pad: the browser knows no layout for this gamepad/);
  await page.evaluate(() => window.plug());
  await pause(500);
  const press = async (pulled, count) => {
    await page.mouse.move(870, kHalfHeightPx);
    await page.mouse.move(860, kHalfHeightPx);  // beside the lump
    await pause(300);
    await hold(kRight, pulled);
    await page.says('stroke started', count);
    await lean(kX, -kHalf);
    await turns(page, 500);  // about 13 of 20 mm to the lump
    await lean(kX, -kFast);  // faster than the clay yields
    await turns(page, 2600);
    await lean(kX, 0);
    await hold(kRight, 0);
    await page.says('stroke ended', count);
    await hold(kUndo, 1);
    await page.says('action: edit.undo', count);
    await hold(kUndo, 0);
    await pause(300);
  };
  const kPulls = [0.3, 0.9];
  await press(kPulls[0], 1);
  await press(kPulls[1], 2);
  await hold(kRedo, 1);
  await page.says('action: edit.redo');
  await hold(kRedo, 0);
  const strokes = await saved(page, folder);
  const stick = 150 * rate(kHalf, 0.15);
  const air = strokes.map(stroke => speed(part(stroke, depth, depth(stroke[0]) + 2, depth(stroke[0]) + 10), depth));
  console.log(`  stick at ${kHalf}: ${air.map(v => v.toFixed(1)).join(', ')} mm/s, expected ${stick.toFixed(1)}`);
  for (const v of air) near(v, stick, 0.1, 'speed of the stick beside the clay [mm/s]');
  checkBites(strokes, kPulls.map(pulled => (pulled - 0.05) / 0.95), 'trigger');
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}

/// The device that the page finds by WebHID, made before its scripts run: a SpaceMouse Compact.
/// `report` sends the bytes of the device.
function fakeHid() {
  const device = {vendorId: 0x256f, productId: 0xc635, productName: 'SpaceMouse Compact', opened: false,
    async open() { this.opened = true; }, async close() { this.opened = false; }, async sendReport() {}};
  const hid = new EventTarget();
  hid.getDevices = async () => [];
  hid.requestDevice = async ({filters}) => {
    window.filters = filters;
    return [device];
  };
  Object.defineProperty(navigator, 'hid', {value: hid});
  // A report begins with its number; WebHID passes that on beside the bytes.
  window.report = bytes => device.oninputreport({reportId: bytes[0],
    data: new DataView(Uint8Array.from([0xee, ...bytes.slice(1)]).buffer, 1)});
  window.unplug = () => hid.dispatchEvent(Object.assign(new Event('disconnect'), {device}));
}

const kWholeCap = 350;  // counts of the full deflection

/// A report of the three translations: 16 bits each, low byte first; x right, y to the user, z down.
function translation(x, y, z) {
  const bytes = Buffer.alloc(7);
  bytes[0] = 1;
  [x, y, z].forEach((value, i) => bytes.writeInt16LE(value, 1 + 2 * i));
  return [...bytes];
}

/// A receiver has several parts, each a device of WebHID: the page opens one. The page reports that
/// a browser refuses.
export async function partsOfOneController({open}) {
  const page = await open(() => {
    const part = () => ({vendorId: 0x256f, productId: 0xc635, opened: false, async open() { this.opened = true; }});
    window.parts = [part(), part()];
    Object.defineProperty(navigator, 'hid', {value: Object.assign(new EventTarget(), {
      async getDevices() { return window.parts; },
      async requestDevice() { throw new DOMException('planted', 'SecurityError'); }})});
  });
  await page.waitForFunction(() => window.parts[0].opened);
  await page.click('#hid');
  await page.shows('status', /^No controller was connected: planted$/);
  assert.deepEqual(await page.evaluate(() => window.parts.map(part => part.opened)), [true, false]);
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}

/// The cap moves the tool: its reports are decoded by the program.
export async function spaceMouse({open, folder}) {
  const page = await lump(open, fakeHid);
  await page.click('#hid');
  await page.says('device: SpaceMouse Compact');
  const filters = await page.evaluate(() => window.filters);
  assert.ok(filters.some(each => each.vendorId === 0x256f && each.productId === 0xc635));
  // A controller sends reports as long as its cap is moved, here for some time.
  const move = async (ms, ...cap) => {
    await page.evaluate(bytes => { window.moved = setInterval(() => window.report(bytes), 8); }, translation(...cap));
    await turns(page, ms);
    await page.evaluate(bytes => {
      clearInterval(window.moved);
      window.report(bytes);
    }, translation(0, 0, 0));
    await turns(page, 300);
  };
  // The tool begins at a radius of 60 mm and a height of 75 mm.
  await move(350, 0, 0, -kWholeCap);         // up by about 45 mm
  await move(750, 0, 0, kWholeCap);          // down by about 96 mm, beside the lump
  await move(1000, -kWholeCap / 2, 0, 0);    // left into the clay, by about 29 mm
  await page.evaluate(() => window.unplug());
  await page.says('stroke ended');
  const strokes = await saved(page, folder);
  assert.equal(strokes.length, 1, 'expected one stroke that touches the clay');
  const [poses] = strokes;
  const up = pose => pose.y, down = pose => -pose.y, left = pose => -pose.x;
  const highest = poses.reduce((best, pose, i) => pose.y > poses[best].y ? i : best, 0), after = poses.slice(highest);
  const found = [steadySpeed(part(poses, up, 80, 105), up), steadySpeed(part(after, down, -105, -45), down),
    steadySpeed(part(after, left, -58, -45), left)];
  console.log(`  cap up, down, half left: ${found.map(v => v.toFixed(1)).join(', ')} mm/s`);
  const kWhole = 80 * 1.6, kHalf = kWhole * rate(0.5, 0.05);  // 80 mm/s of the hand, 1.6 mm per mm
  near(found[0], kWhole, 0.02, 'speed upwards [mm/s]');
  near(found[1], kWhole, 0.02, 'speed downwards [mm/s]');
  near(found[2], kHalf, 0.02, 'speed to the left [mm/s]');
  await page.click('#words');
  const report = await page.$eval('#report-text', element => element.textContent);
  assert.match(report, /Unaccounted for: 0\n/);
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}
