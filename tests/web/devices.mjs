// Pen, gamepad and 3Dconnexion controller in the page. What reaches the clay is read from the
// recorded work: its poses are the tool's path, in mm and ms. Expected speeds: docs/studio.md, "Pen
// and gamepad", and docs/devices.md.
import assert from 'node:assert/strict';
import {readFileSync, rmSync} from 'node:fs';
import {join} from 'node:path';
import {chord, downloaded, pause} from './browser.mjs';

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

/// The poses from the one at which `begun` becomes true, for `ms`.
function part(stroke, begun, ms) {
  const first = stroke.findIndex(begun);
  assert.ok(first >= 0, 'expected a stroke that goes that far');
  const poses = stroke.slice(first).filter(pose => pose.ms <= stroke[first].ms + ms);
  assert.ok(poses.at(-1).ms - poses[0].ms > 0.8 * ms, 'expected a stroke that lasts longer');
  return poses;
}

/// Mean speed of a quantity of the poses [mm/s].
function speed(poses, of) {
  return 1000 * (of(poses.at(-1)) - of(poses[0])) / (poses.at(-1).ms - poses[0].ms);
}

const inward = pose => -pose.rho;

function near(found, expected, relative, what) {
  assert.ok(Math.abs(found - expected) <= relative * Math.abs(expected),
    `${what}: expected ${expected.toFixed(2)}, found ${found.toFixed(2)}`);
}

/// The lump of the bowl on the wheel; `before` runs before the scripts of the page.
async function lump(open, before) {
  const page = await open(before);
  await pause(1000);
  await page.mouse.click(302, 465);
  await page.says('work started: bowl');
  await page.says('checked: proved');
  return page;
}

/// Saves the work and returns its strokes.
async function saved(page, folder) {
  rmSync(join(folder, 'bowl.work'), {force: true});
  await page.focus('#canvas');
  await chord(page, 'KeyS', 'Control');
  await page.says('action: file.save');
  await pause(500);
  await page.keyboard.press('Enter');
  await page.says('saved:');
  return strokesOf(await downloaded(folder, 'bowl.work'));
}

// The tool, a ball of 10 mm radius, touches the lump of 45 mm radius at 55 mm.
const kTouchMm = 55.0, kWhileMs = 300;
/// How fast the tool goes into the clay.
function bite(stroke) {
  return speed(part(stroke, pose => pose.rho < kTouchMm - 0.5, kWhileMs), inward);
}

/// The hand halves its step of 80 mm/s until the clay permits it, at most five times. A soft press
/// (1 mm per turn) ends there, at 2.5 mm/s; a firm one (14 mm per turn) is permitted eight times as
/// much or more.
function softAndFirm([soft, firm], what) {
  near(soft, 80 / 2 ** 5, 0.2, `${what}, soft [mm/s]`);
  assert.ok(firm > 4 * soft, `${what}: expected a firm press to be faster, found ${firm} and ${soft}`);
}

/// A firmer pen goes faster into the clay.
export async function pen({open, folder}) {
  const page = await lump(open);
  const events = await page.createCDPSession();
  const kInto = 700;  // px: about 17 mm into the lump
  const stroke = async (force, count) => {
    const event = (type, x, more) => events.send('Input.dispatchMouseEvent',
      {type, x, y: 522, pointerType: 'pen', force, button: 'left', clickCount: 1, ...more});
    await event('mouseMoved', 790, {button: 'none', force: 0});
    await pause(300);
    await event('mousePressed', 790, {buttons: 1});
    for (let x = 790; x >= kInto; x -= 5) {
      await event('mouseMoved', x, {buttons: 1});
      await pause(20);
    }
    await pause(1500);
    await event('mouseReleased', kInto, {buttons: 0});
    await page.says('stroke ended', count);
    await chord(page, 'KeyZ', 'Control');
    await page.says('action: edit.undo', count);
  };
  const kForces = [0.2, 0.9];
  await stroke(kForces[0], 1);
  await stroke(kForces[1], 2);
  const found = (await saved(page, folder)).map(bite);
  console.log(`  pen at ${kForces}: ${found.map(v => v.toFixed(1)).join(', ')} mm/s into the clay`);
  softAndFirm(found, 'pen');
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}

/// What the page reads of a gamepad, before its scripts run. The test sets axes and buttons.
function fakePad() {
  const pad = {id: 'Test Pad (Vendor: 045e Product: 028e)', index: 0, connected: true, mapping: 'standard',
    axes: [0, 0, 0, 0], buttons: Array.from({length: 17}, () => ({pressed: false, value: 0}))};
  navigator.getGamepads = () => [pad, null, null, null];
  window.hold = (button, value) => { pad.buttons[button] = {pressed: value > 0.5, value}; };
  window.lean = (axis, value) => { pad.axes[axis] = value; };
  window.plug = () => window.dispatchEvent(new Event('gamepadconnected'));
}

/// Part of the full speed of a stick.
const rate = (way, dead) => ((way - dead) / (1 - dead)) ** 2;

/// The trigger presses, the stick moves the tool, the buttons undo and redo.
export async function gamepad({open, folder}) {
  const page = await lump(open, fakePad);
  const kRight = 7, kUndo = 4, kRedo = 5, kX = 0;  // of the standard layout
  const hold = (button, value) => page.evaluate((b, v) => window.hold(b, v), button, value);
  const lean = (axis, value) => page.evaluate((a, v) => window.lean(a, v), axis, value);
  await page.evaluate(() => window.plug());
  await pause(500);
  const press = async (pulled, count) => {
    await page.mouse.move(870, 522);
    await page.mouse.move(860, 522);  // beside the lump, at about 78 mm
    await pause(300);
    await hold(kRight, pulled);
    await page.says('stroke started', count);
    await lean(kX, -0.5);
    await pause(2500);
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
  const found = strokes.map(bite), air = strokes.map(stroke =>
    speed(part(stroke, pose => pose.rho < stroke[0].rho - 4, kWhileMs), inward));
  console.log(`  stick at 0.5: ${air.map(v => v.toFixed(1)).join(', ')} mm/s; trigger at ${kPulls}: ` +
              `${found.map(v => v.toFixed(1)).join(', ')} mm/s into the clay`);
  for (const v of air) near(v, 150 * rate(0.5, 0.15), 0.1, 'speed of the stick beside the clay [mm/s]');
  softAndFirm(found, 'trigger');
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}

/// What the page finds by WebHID, before its scripts run: a SpaceMouse Compact. `report` sends the
/// bytes of the device.
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

/// A report of the three translations: 16 bits each, low byte first; x right, y to the user, z down.
function translation(x, y, z) {
  const bytes = Buffer.alloc(7);
  bytes[0] = 1;
  [x, y, z].forEach((value, i) => bytes.writeInt16LE(value, 1 + 2 * i));
  return [...bytes];
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
    await page.evaluate((bytes, ms) => new Promise(done => {
      const timer = setInterval(() => window.report(bytes), 8);
      setTimeout(() => { clearInterval(timer); done(); }, ms);
    }), translation(...cap), ms);
    await page.evaluate(bytes => window.report(bytes), translation(0, 0, 0));
    await pause(400);
  };
  await move(900, 0, 0, -350);   // up
  await move(1200, 0, 0, 175);   // down, at half of the cap
  await move(1500, -350, 0, 0);  // left, into the clay
  await page.evaluate(() => window.unplug());
  await page.says('stroke ended');
  const poses = (await saved(page, folder)).flat();
  const highest = poses.reduce((best, pose, i) => pose.y > poses[best].y ? i : best, 0);
  const rises = part(poses, pose => pose.y > poses[0].y + 5, 300);
  const sinks = part(poses.slice(highest), pose => pose.y < poses[highest].y - 2, 300);
  const goes = part(poses.slice(highest), pose => pose.x < poses[highest].x - 5, 300);
  const found = [speed(rises, pose => pose.y), -speed(sinks, pose => pose.y), -speed(goes, pose => pose.x)];
  console.log(`  cap up, half down, left: ${found.map(v => v.toFixed(1)).join(', ')} mm/s`);
  const kFull = 80, kHalf = kFull * rate(0.5, 0.05);
  near(found[0], kFull, 0.1, 'speed upwards [mm/s]');
  near(found[1], kHalf, 0.1, 'speed downwards [mm/s]');
  near(found[2], kFull, 0.1, 'speed to the left [mm/s]');
  await page.click('#words');
  const report = await page.$eval('#report-text', element => element.textContent);
  assert.match(report, /Unaccounted for: 0\n/);
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}
