// Files, links, keys and buttons that few people use, the keyboard of a phone, and a program that
// stops: the page reports what it cannot do.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {copyFileSync, mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {beginBowl, choose, chord, closeClean, drop, openBowl, pause} from './browser.mjs';

const clearStatus = page => page.evaluate(() => { document.getElementById('status').textContent = ''; });

/// Notes the calls of functions of the program from now on. Returns a function: the calls so far.
async function noteCalls(page, ...names) {
  await page.evaluate(names => {
    window.calls = [];
    for (const name of names) {
      const real = studio[name];
      const noted = (...words) => {
        window.calls.push(words);
        return real(...words);
      };
      // Emscripten's functions replace themselves in their first call.
      Object.defineProperty(studio, name, {get: () => noted, set() {}});
    }
  }, names);
  return () => page.evaluate(() => window.calls.splice(0));
}

/// Several files, a folder, files without a pot, and meshes with names like options.
export async function oddFiles({open, folder, drawings, claystack}) {
  const page = await open();
  await drop(page, join(drawings, 'jug.svg'), join(drawings, 'jug.svg'));
  await page.shows('status', /^Expected one file, found 2: drop one file at a time$/);
  mkdirSync(join(folder, 'a folder'));
  await drop(page, join(folder, 'a folder'));
  await page.shows('status', /^a folder: could not be read: /);
  for (const [name, text] of [['empty.pot.json', ''], ['list.pot.json', '[]'], ['picture.png', '\x89PNG'], ['x'.repeat(240) + '.work', '']]) {
    writeFileSync(join(folder, name), text);
    await drop(page, join(folder, name));
    await page.shows('pot', new RegExp(`^${name}(:\\d+)?: .`));
  }
  // The second mesh replaces the first, whose late report is not shown.
  await drop(page, join(folder, 'bowl.stl'));
  writeFileSync(join(folder, 'second.stl'), 'solid second');
  await drop(page, join(folder, 'second.stl'));
  await page.shows('report-title', /^second\.stl$/);
  await page.shows('report-verdict', /^The file could not be read$/);
  await pause(2000);
  assert.equal(await page.$eval('#report-verdict', e => e.textContent), 'The file could not be read');
  await page.keyboard.press('Escape');
  for (const name of ['-x.stl', '--help.stl', 'dev']) {
    if (name === 'dev') writeFileSync(join(folder, name), '');
    else copyFileSync(join(folder, 'bowl.stl'), join(folder, name));
    await choose(page, '#check', join(folder, name));
    const {stdout} = spawnSync(claystack, ['check', '--json', '--', name], {encoding: 'utf8', cwd: folder});
    assert.ok(stdout.length > 0);
    await page.waitForFunction(text => document.getElementById('report-text').textContent === text, {timeout: 60000}, stdout)
      .catch(async () => assert.equal(await page.$eval('#report-text', e => e.textContent), stdout));
    await page.keyboard.press('Escape');
  }
  await closeClean(page);
}

/// Links that were cut off or changed; and links that are put into the address of an open page.
export async function oddLinks({open}) {
  const page = await open('#pot=');
  await page.shows('status', /^The link holds no pot: it was cut off or changed$/);
  await beginBowl(page);
  await page.evaluate(() => { by('link').click(); by('link').click(); });  // before the first one is done
  await page.shows('status', /^The address of this page now holds the pot/);
  const link = await page.evaluate(() => location.hash);
  for (const hash of [link.slice(0, -9), link + '.', '#pot=%20', '#pot=' + 'A'.repeat(9000)]) {
    await clearStatus(page);
    await page.evaluate(hash => { location.hash = hash; }, hash);
    await page.shows('status', /^The link holds no pot: it was cut off or changed$/);
  }
  await page.evaluate(hash => { location.hash = hash; }, link);
  await page.says('opened: ');
  await closeClean(page);
}

/// Two buttons at once, keys of other layouts, a key that is held while the focus goes, touchpads.
export async function keysAndButtons({open}) {
  const page = await openBowl(open);
  let calls = await noteCalls(page, '_claystack_button');
  await page.mouse.move(400, 300);
  for (const [way, button] of [['down', 'right'], ['down', 'left'], ['up', 'right'], ['up', 'left']])
    await page.mouse[way]({button});
  const kLeft = 0, kRight = 1;
  assert.deepEqual((await calls()).map(([index, pressed]) => [index, pressed]),
    [[kRight, true], [kLeft, true], [kRight, false], [kLeft, false]]);

  calls = await noteCalls(page, '_claystack_key', '_claystack_text');
  await chord(page, 'Slash', 'Shift');  // ?
  await page.waitForFunction(() => studio._claystack_dialog_open());
  await page.keyboard.press('Escape');
  await calls();
  const kEqual = 61, kHome = 268, kShift = 1, kControl = 2;  // GLFW's codes and the bits of input.hpp
  await chord(page, 'Equal', 'Shift', 'Control');
  assert.deepEqual((await calls())[0], [kEqual, true, false, kShift | kControl]);
  await page.keyboard.down('Home');
  await calls();
  await page.focus('#open');
  assert.deepEqual(await calls(), [[kHome, false, false, 0]]);
  await page.keyboard.up('Home');
  await page.focus('#canvas');
  await page.evaluate(() => document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown',
    {key: '@', ctrlKey: true, altKey: true, modifierAltGraph: true})));
  assert.deepEqual(await calls(), [['@'.charCodeAt(0), true, false, 0], ['@'.charCodeAt(0)]]);

  calls = await noteCalls(page, '_claystack_scroll');
  for (let i = 0; i < 20; ++i) await page.mouse.wheel({deltaY: -5});
  const turned = (await calls()).reduce((sum, [steps]) => sum + steps, 0);
  assert.ok(Math.abs(turned - 1) < 1e-6, `expected one step from 100 px of a touchpad, found ${turned}`);
  await page.mouse.wheel({deltaY: 120});
  assert.deepEqual(await calls(), [[-1]]);
  await closeClean(page);
}

/// A palm beside a pen, before it and after it, does nothing; nor does a finger that the system takes.
export async function palms({open}) {
  const page = await open();
  const calls = await noteCalls(page, '_claystack_button', '_claystack_pointer');
  const events = await page.createCDPSession();
  const kPen = [300, 300], kPalm = [500, 500];
  const pen = (type, more) => events.send('Input.dispatchMouseEvent',
    {type, x: kPen[0], y: kPen[1], pointerType: 'pen', force: 0.5, button: 'left', clickCount: 1, buttons: 1, ...more});
  const palm = async (type, ...place) => events.send('Input.dispatchTouchEvent',
    {type, touchPoints: place.length > 0 ? [{x: place[0], y: place[1]}] : []});
  const kLong = 300;  // ms, more than a finger waits for a second one
  const pressed = async () => (await calls()).filter(words => typeof words[1] === 'boolean')
    .map(([index, isDown]) => [index, isDown]);

  await pen('mousePressed');
  await calls();
  await palm('touchStart', ...kPalm);
  await palm('touchMove', kPalm[0] + 50, kPalm[1]);
  await pause(kLong);
  await palm('touchEnd');
  assert.deepEqual(await calls(), [], 'expected nothing from a palm beside a pen');
  await pen('mouseReleased', {buttons: 0});
  assert.deepEqual(await pressed(), [[0, false]]);

  await palm('touchStart', ...kPalm);
  await pen('mousePressed');
  await pause(kLong);
  await palm('touchEnd');
  await pen('mouseReleased', {buttons: 0});
  assert.deepEqual(await pressed(), [[0, true], [0, false]], 'expected the press of the pen alone');

  await palm('touchStart', ...kPalm);
  await palm('touchCancel');
  await pause(kLong);
  assert.deepEqual(await pressed(), [], 'expected no tap from a finger that the system has taken');
  await closeClean(page);
}

/// The window goes to a screen with more pixels; a file is asked for without a click.
export async function otherScreen({open}) {
  const page = await open();
  const sizes = await noteCalls(page, '_claystack_resize', '_claystack_picked');
  const screen = await page.createCDPSession();
  await screen.send('Emulation.setDeviceMetricsOverride',
    {...page.viewport(), deviceScaleFactor: 2, mobile: false});
  await page.waitForFunction(() => window.calls.some(words => words[2] === 2), {timeout: 10000});
  await page.evaluate(() => {
    Object.defineProperty(navigator, 'userActivation', {value: {isActive: false}});
    page.pick();
  });
  await page.shows('status', /^The browser opens its file picker only after a click or key/);
  assert.equal((await sizes()).at(-1).length, 1, 'expected the answer that no file was picked');
  await closeClean(page);
}

/// On a phone a text field shows the keyboard of the screen: a field of the page has the focus. The
/// keyboard composes a word and corrects it.
export async function typedByFinger(page, tap) {
  const kNameField = [150, 377];
  await page.focus('#canvas');
  await chord(page, 'KeyS', 'Control');
  await page.says('action: file.save');
  await pause(1000);
  await tap(...kNameField);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'typed');
  await page.keyboard.press('End');
  const keyboard = await page.createCDPSession();
  await keyboard.send('Input.imeSetComposition', {text: '-tae', selectionStart: 4, selectionEnd: 4});
  await pause(300);
  await keyboard.send('Input.insertText', {text: '-tea.work'});
  await pause(500);
  await page.keyboard.press('Enter');
  await page.says('saved: /home/web_user/bowl.work-tea.work');
  await page.waitForFunction(() => document.activeElement.id === 'canvas');  // the keyboard goes
}

/// A fault of the program, in a frame or in an event: the page reports that it has stopped.
export async function failing({open}) {
  const page = await open();
  await page.evaluate(() => { studio._claystack_frame = () => { throw new Error('planted'); }; });
  await page.shows('message', /^Claystack has stopped: planted\. Reload the page/);
  await closeClean(page);
  const full = await open();
  await full.evaluate(() => {
    studio._malloc = () => 0;
    setTimeout(() => answered(0, new Uint8Array(8), []));
  });
  await full.shows('message', /^Claystack has stopped: the browser has too little memory\. Reload the page/);
  await full.browserContext().close();
}
