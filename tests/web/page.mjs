// Throws, exports and recovers a pot in a browser, by mouse, keys and fingers alone, and judges the
// downloads with the native program, ADMesh and PrusaSlicer:
// node tests/web/page.mjs SITE CLAYSTACK PICTURES [chromium|firefox]
// tests/web_page.sh installs what it needs and calls it. Firefox does the main path.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {inflateRawSync} from 'node:zlib';
import {beginBowl, choose, chord, downloaded as downloadedIn, drag, drop, launch as launchIn, openPage as openPageIn, pause} from './browser.mjs';
import {browsersKeys, clipboard, followedTheme, hiddenTab, untouchedLink, versions} from './browsing.mjs';
import {readAndPressed} from './controls.mjs';
import {gamepad, partsOfOneController, pen, saved, spaceMouse} from './devices.mjs';
import {failing, keysAndButtons, oddFiles, oddLinks, otherScreen, palms, typedByFinger} from './odd_input.mjs';
import {serve} from './server.mjs';
import {clearedStorage, closedWithoutStorage, listedWorks, lostGraphics, pickedAgain, reloadedLink, savedPot, twoTabs, twoTabsWithoutLocks, unreadStorage} from './storage.mjs';

const [site, claystack, pictures] = process.argv.slice(2, 5).map(path => resolve(path));
const which = process.argv[5] ?? 'chromium';
const drawings = resolve('samples/drawings');
mkdirSync(pictures, {recursive: true});
const folder = mkdtempSync(join(tmpdir(), 'claystack-web-'));
const server = await serve(site);
const kDesktop = {width: 1280, height: 800};
const kPhoneBowl = [100, 250], kPhoneClay = [315, 372], kPhonePanels = [30, 533];
const kPhone = {width: 390, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2};

const launch = flags => launchIn(which, folder, flags);
const openPage = (browser, size, hash = '', address = server.address) =>
  openPageIn(browser, folder, address + hash, size);
const downloaded = name => downloadedIn(folder, name);
const picture = (page, name) =>
  page.screenshot({path: join(pictures, (which === 'chromium' ? '' : which + '-') + name + '.png')});

function native(...words) {
  const ran = spawnSync(claystack, words, {encoding: 'utf8', cwd: folder});
  assert.equal(ran.status, 0, `claystack ${words.join(' ')}: ${ran.stdout}${ran.stderr}`);
  return ran.stdout;
}

/// Programs of other authors find a closed solid in the STL.
function judge(stl) {
  const admesh = execFileSync('admesh', [stl], {encoding: 'utf8'});
  for (const name of ['Edges fixed', 'Facets removed', 'Facets reversed', 'Backwards edges'])
    assert.match(admesh, new RegExp(`${name}\\s*: +0\\b`), admesh);
  assert.match(admesh, /Number of parts\s*: +1\b/);
  const slicer = execFileSync('prusa-slicer', ['--info', stl], {encoding: 'utf8'});
  assert.match(slicer, /manifold = yes/);
}

async function throwAndExport(browser) {
  const page = await openPage(browser, kDesktop);
  await pause(1500);
  await picture(page, 'gallery');
  await beginBowl(page);
  await page.says('checked: proved');
  await pause(2500);
  const lump = await page.lastLine('work started');
  await drag(page);
  await page.mouse.up();
  await page.says('stroke ended');
  await page.says('checked: proved', 2);
  await pause(2500);
  const thrown = await page.lastLine('stroke ended');
  console.log('  longest time without a frame after the lump appeared and after the stroke: ' +
              `${lump.gap.toFixed(0)} and ${thrown.gap.toFixed(0)} ms`);
  await picture(page, 'thrown');
  await chord(page, 'KeyZ', 'Control');
  await page.says('action: edit.undo');
  await page.says('checked: proved', 3);
  await chord(page, 'KeyZ', 'Control', 'Shift');
  await page.says('action: edit.redo');
  await page.says('checked: proved', 4);
  await chord(page, 'KeyE', 'Control');
  await page.says('export previewed');
  await page.mouse.click(330, 108);  // STL
  await page.mouse.click(561, 137);  // Pot
  await pause(1500);
  await picture(page, 'export');
  await chord(page, 'Enter', 'Control');
  await page.says('exported:', 3);
  const begun = await page.lastLine('export started'), ended = await page.lastLine('exported:');
  console.log(`  3MF, STL and pot exported in ${((ended.at - begun.at) / 1000).toFixed(2)} s; ` +
              `longest time without a frame ${begun.gap.toFixed(0)} ms`);
  const stl = await downloaded('bowl.stl'), pot = await downloaded('bowl.pot.json');
  await downloaded('bowl.3mf');
  native('check', stl);
  judge(stl);
  native('export', '-q', pot, 'native.stl');
  assert.ok(readFileSync(stl).equals(readFileSync(join(folder, 'native.stl'))),
    'expected the STL of the native program');
  await page.keyboard.press('Escape');
  await chord(page, 'KeyS', 'Control');
  await page.says('action: file.save');
  await pause(1000);
  await picture(page, 'save');
  await page.keyboard.press('Enter');
  await page.says('saved:');
  await page.shows('pot', /^Saved bowl\.work$/);  // a page has no folders
  const work = await downloaded('bowl.work');
  native('throw', '-q', work, '-o', 'replayed.pot.json');
  assert.ok(readFileSync(pot).equals(readFileSync(join(folder, 'replayed.pot.json'))),
    'expected the pot that the native program replays from the recorded work');
  assert.deepEqual([...page.hosts], [server.address], 'expected requests to the own server only');
  assert.deepEqual(page.problems, []);
  await page.close();
  console.log('thrown, undone, redone, exported: the same STL and pot as the native program');
}

/// The pot that the link of the page carries, as `throw` writes it with the ending .pot.cbor.
async function linked(page) {
  await page.click('#link');
  await page.waitForFunction(() => location.hash.startsWith('#pot='));
  const hash = await page.evaluate(() => location.hash);
  return {hash, pot: inflateRawSync(Buffer.from(hash.slice('#pot='.length), 'base64url'))};
}

/// Opens files by picking and by dropping; a link in the profile of another person.
async function files(browser) {
  const page = await openPage(browser, kDesktop);
  await choose(page, '#open', join(folder, 'bowl.work'));
  await page.says('opened: ');
  native('throw', '-q', 'bowl.work', '-o', 'linked.pot.cbor');
  const expected = readFileSync(join(folder, 'linked.pot.cbor'));
  const {hash, pot} = await linked(page);
  assert.ok(pot.equals(expected), 'expected the pot of the native program in the link');

  const report = native('check', '--json', 'bowl.stl');
  const shows = text => page.waitForFunction(text =>
    document.getElementById('report-text').textContent === text, {timeout: 60000}, text)
    .catch(async () => assert.equal(await page.$eval('#report-text', e => e.textContent), text));
  await choose(page, '#check', join(folder, 'bowl.stl'));
  await shows(report);
  await picture(page, 'report');
  await page.keyboard.press('Enter');  // Close
  native('throw', '-q', 'bowl.work', '-o', 'formats.pot.json');
  for (const ending of ['obj', 'drc', 'ply', '3mf', 'glb']) {
    native('export', '-q', 'formats.pot.json', 'formats.' + ending);
    await choose(page, '#check', join(folder, 'formats.' + ending));
    await shows(native('check', '--json', 'formats.' + ending));
    await page.keyboard.press('Escape');
  }
  const open = readFileSync(join(folder, 'bowl.stl')).subarray(0, -50);  // lacks a triangle
  open.writeUInt32LE(open.readUInt32LE(80) - 1, 80);
  writeFileSync(join(folder, 'open.stl'), open);
  await drop(page, join(folder, 'open.stl'));
  await shows(spawnSync(claystack, ['check', '--json', 'open.stl'], {encoding: 'utf8', cwd: folder}).stdout);
  assert.match(await page.$eval('#report-verdict', e => e.textContent), /^Not sound/);
  await page.keyboard.press('Escape');
  await drop(page, join(folder, 'bowl.3mf'));  // with its pot
  await page.says('opened: bowl.3mf');
  assert.deepEqual(page.problems, []);
  await page.close();

  const stranger = await browser.createBrowserContext();
  const other = await openPage(stranger, kDesktop, hash);
  await other.says('opened: ');
  await pause(1500);
  await picture(other, 'link');
  assert.ok((await linked(other)).pot.equals(expected), 'expected the same pot from the link');
  assert.deepEqual(other.problems, []);
  await stranger.close();
  console.log('picked, dropped, linked: the same pot and reports as the native program');
}

/// The second start has no server.
async function offline(browser) {
  const own = await serve(site);
  const context = await browser.createBrowserContext();
  const page = await openPage(context, kDesktop, '', own.address);
  await page.says('ready offline');
  own.close();
  await assert.rejects(fetch(own.address));
  await page.goto(own.address + 'index.html');
  await page.says('window open');
  await beginBowl(page);
  await page.says('checked: proved');  // by the worker, whose files are kept too
  await context.close();
  console.log('started without the server');
}

/// Two folders of a server have pages of different versions: both start without it.
async function offlineBeside(browser) {
  const both = join(folder, 'both');
  for (const name of ['one', 'two']) cpSync(site, join(both, name), {recursive: true});
  writeFileSync(join(both, 'two', 'offline.js'), readFileSync(join(both, 'two', 'offline.js'), 'utf8').replace(/[0-9a-f]{16}/, '0'.repeat(16)));
  const own = await serve(both);
  const context = await browser.createBrowserContext();
  for (const name of ['one', 'two']) {
    const page = await openPage(context, kDesktop, name + '/', own.address);
    await page.says('ready offline');
    await page.close();
  }
  own.close();
  for (const name of ['one', 'two']) await openPage(context, kDesktop, name + '/', own.address);
  await context.close();
  console.log('two pages of one server started without it');
}

/// A file that the server lacks when the page starts: a message with its name.
async function incomplete(browser) {
  for (const [name, fault] of [
    ['page.js', ' could not be loaded'], ['storage.js', ': the server answers 404'],
    ['claystack-page.data', ': the server answers 404'], ['claystack-page.wasm', ': the server answers 404'],
  ]) {
    const own = await serve(site, new Set(['/' + name]));
    const page = await openPageIn(browser, folder, own.address, kDesktop, () => {});
    await page.shows('message', new RegExp(`^Claystack could not start: ${name}${fault}$`));
    await page.close();
    own.close();
  }
  const own = await serve(site, new Set(['/worker.js', '/style.css']));  // it starts without them
  const page = await openPage(browser, kDesktop, '', own.address);
  await page.evaluate(() => checkMesh({name: 'some.stl', bytes: new Uint8Array(1)}));
  await page.shows('report-text', /^worker.js could not be loaded$/);
  await page.close();
  own.close();
  console.log('a file that the server lacks is named');
}

/// A server that fails: the page reports it, and tries again.
async function repeated(browser) {
  const missing = new Set(['/claystack.wasm']);
  const own = await serve(site, missing);
  const context = await browser.createBrowserContext();
  const page = await openPage(context, kDesktop, '', own.address);
  await beginBowl(page);
  await page.says('error: worker: claystack.wasm: the server answers 404');
  await pause(1000);
  await page.shows('pot', /Not checked: the browser/);
  await picture(page, 'not-checked');
  missing.clear();
  await drag(page);
  await page.mouse.up();
  await page.says('checked: proved');
  own.close();
  await context.close();
  console.log('a file that the server did not send is requested again');
}

/// Kills the browser in the middle of a stroke.
async function recover() {
  let browser = await launch();
  const page = await openPage(browser, kDesktop);
  await beginBowl(page);
  const {hash} = await linked(page);
  await drag(page);
  await pause(2500);
  const {turned} = await page.lastLine('stroke started');
  browser.process().kill('SIGKILL');
  await pause(1000);
  browser = await launch();
  const again = await openPage(browser, kDesktop);
  await again.says('recovery offered: 1');
  await pause(1500);
  await picture(again, 'recovery');
  await chord(again, 'KeyR', 'Control');
  await again.says('recovered: ');
  const strokes = await saved(again, folder);
  assert.equal(strokes.length, 1);
  const lost = turned - (strokes[0].at(-1).ms - strokes[0][0].ms);
  assert.ok(lost <= 1000, `expected at most the last second to be lost, found ${lost} ms`);
  console.log(`killed in a stroke: recovered but for the last ${lost.toFixed(0)} ms`);

  await drag(again);
  await pause(2500);
  browser.process().kill('SIGKILL');
  await pause(1000);
  browser = await launch();
  const other = await openPage(browser, kDesktop, hash);
  await other.says('recovery offered: 1');
  await other.shows('status', /^Unsaved works from before: 1\. File > New offers them\.$/);
  await browser.close();
  console.log('a link names the works that wait');
}

/// Drawings become pots; a fallen pot is exported too.
async function drawn(browser) {
  const page = await openPage(browser, kDesktop);
  await pause(1000);
  await drop(page, join(drawings, 'jug.svg'));
  await page.says('drawing: ');
  await pause(1000);
  await picture(page, 'drawing');
  await chord(page, 'Enter', 'Control', 'Shift');
  await page.says('imported: ');
  await page.says('checked: ');
  await pause(1000);
  await picture(page, 'drawn');
  const printed = native('import', join(drawings, 'jug.svg'), '-o', 'jug.pot.json');
  await page.click('#words');
  const words = await page.$eval('#report-text', element => element.textContent);
  assert.match(words, new RegExp(`Height: ${/([\d.]+ mm) high/.exec(printed)[1]}\\n`));
  await page.keyboard.press('Escape');
  assert.deepEqual(page.problems, []);
  await page.close();
  console.log('a drawing was dropped and stands on the wheel');
}

/// The texts for people who do not see the picture; and the Tab key reaches every control.
async function words(browser) {
  const page = await openPage(browser, kDesktop);
  await choose(page, '#open', join(folder, 'bowl.work'));
  await page.shows('pot', /^bowl.work: .* high, .* wide, .* g\. Solid clay$/);
  const facts = JSON.parse(native('throw', '--json', 'bowl.work', '-o', 'words.pot.cbor'));
  await page.click('#words');
  const report = await page.$eval('#report-text', element => element.textContent);
  assert.match(report, new RegExp(`Height: ${facts.height_mm.toFixed(1)} mm`));
  assert.match(report, /Unaccounted for: 0\n/);
  await page.keyboard.press('Escape');
  await page.focus('#canvas');
  const withHid = await page.evaluate(() => !document.getElementById('hid').hidden);
  for (const id of ['open', 'check', 'words', 'link', ...(withHid ? ['hid'] : []), 'about']) {
    await page.keyboard.press('Tab');
    assert.equal(await page.evaluate(() => document.activeElement.id), id);
  }
  await page.keyboard.press('Enter');
  assert.ok(await page.$eval('#about-text', dialog => dialog.open));
  await page.keyboard.press('Escape');
  for (const element of await page.$$eval('canvas, button', all => all.map(each =>
    each.getAttribute('aria-label') ?? each.textContent))) assert.ok(element.trim().length > 2);
  assert.deepEqual(page.problems, []);
  await page.close();
  console.log('the pot in words; keys reach the controls of the page');
}

/// Limits the storage of the page [bytes]; undefined: no limit. Chromium relies on the space that it
/// has found for half a minute or longer, so a limit holds at once in a new browser only.
async function storageLimit(browser) {
  const storage = await (await browser.newPage()).createCDPSession();
  return quotaSize => storage.send('Storage.overrideQuotaForOrigin',
    {origin: server.address.slice(0, -1), quotaSize});
}

/// The storage is full: a message, and the files that were stored before remain. As soon as there
/// is room the work is stored again.
async function quota() {
  const kFull = /^The browser cannot store the work: its storage is full\. What it stored before remains/;
  const kLeft = 1000;  // bytes, less than a work takes
  let browser = await launch();
  let limit = await storageLimit(browser);
  await limit(kLeft);
  let page = await openPage(browser, kDesktop);
  await beginBowl(page);
  await page.says('checked: proved');
  await page.shows('status', kFull);
  await limit(undefined);
  await page.shows('status', /^The work is stored again$/);
  await drag(page);
  await page.mouse.up();
  await page.says('stroke ended');
  await pause(3000);  // it is stored
  browser.process().kill('SIGKILL');
  await pause(1000);

  browser = await launch();
  limit = await storageLimit(browser);
  await limit(kLeft);
  page = await openPage(browser, kDesktop);
  await page.says('recovery offered: 1');
  await pause(1500);
  await chord(page, 'KeyR', 'Control');
  await page.says('recovered: ');
  await drag(page);
  await page.mouse.up();
  await page.says('stroke ended');
  await page.shows('status', kFull);
  await pause(1000);
  await picture(page, 'full');
  browser.process().kill('SIGKILL');
  await pause(1000);

  browser = await launch();
  page = await openPage(browser, kDesktop);
  await page.says('recovery offered: 1');
  await pause(1500);
  await chord(page, 'KeyR', 'Control');
  await page.says('recovered: ');
  assert.equal((await saved(page, folder)).length, 1, 'expected the stroke stored before');
  await browser.close();
  console.log('storage full: a message; the work stored before it is offered again');
}

/// The page names the feature that a browser lacks.
async function lacking() {
  const browser = await launch();
  const cases = [
    [/does not offer WebGL 2/, () => {
      const get = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === 'webgl2' ? null : get.call(this, kind, ...rest);
      };
    }],
    [/does not offer WebAssembly with exceptions/, () => { WebAssembly.validate = bytes => bytes.length !== 28; }],
    [/does not offer WebAssembly with vectors/, () => { WebAssembly.validate = bytes => bytes.length !== 31; }],
    [/does not offer WebAssembly\./, () => { delete window.WebAssembly; }],
  ];
  for (const [pattern, before] of cases) {
    const page = await openPageIn(browser, folder, server.address, kDesktop, before);
    await page.shows('message', pattern);
    await page.close();
  }
  await browser.close();
  console.log('a browser that lacks something says what');
}

/// Fingers: a tap, a stroke, and two that turn the view and zoom, of the pot and not of the page.
async function phone(browser) {
  const stranger = await browser.createBrowserContext();  // no work to recover
  const page = await openPage(stranger, kPhone);
  await pause(2000);
  await picture(page, 'phone-gallery');
  const touch = await page.createCDPSession();
  const fingers = (type, ...places) => touch.send('Input.dispatchTouchEvent', {type,
    touchPoints: places.map(([x, y], id) => ({x, y, id}))});
  const tap = async (x, y) => {
    await fingers('touchStart', [x, y]);
    await pause(150);
    await fingers('touchEnd');
    await pause(300);
  };
  await tap(...kPhoneBowl);
  await page.says('work started: bowl');
  await page.says('checked: proved');
  await pause(2000);
  await picture(page, 'phone');
  const strokes = async () => (await page.announced()).filter(line => line === 'stroke started').length;
  const before = await page.screenshot();
  await fingers('touchStart', [180, 300], [260, 300]);
  for (let i = 1; i <= 20; ++i) {
    await fingers('touchMove', [180 - 2 * i, 300 + i], [260 + 2 * i, 300 + i]);
    await pause(30);
  }
  await fingers('touchEnd');
  await pause(1500);
  await picture(page, 'phone-turned');
  assert.ok(!Buffer.from(before).equals(Buffer.from(await page.screenshot())), 'expected another view');
  assert.equal(await strokes(), 0, 'expected no stroke from two fingers');
  assert.equal(await page.evaluate(() => visualViewport.scale), 1, 'expected no zoom of the page');
  await fingers('touchStart', kPhoneClay);
  for (let i = 1; i <= 25; ++i) {
    await fingers('touchMove', [kPhoneClay[0] - i, kPhoneClay[1]]);
    await pause(40);
  }
  await fingers('touchEnd');
  await page.says('stroke ended');
  await page.says('checked: ', 2);
  await pause(1500);
  await tap(...kPhonePanels);
  await pause(1500);
  await picture(page, 'phone-panels');
  // The controls of the page are large enough for a finger.
  for (const size of await page.$$eval('footer button:not([hidden])', all => all.map(each => each.getBoundingClientRect().height)))
    assert.ok(size >= 40, `expected 40 px, found ${size}`);
  await typedByFinger(page, tap);
  assert.deepEqual(page.problems, []);
  await stranger.close();
  console.log('thrown and named by finger; two fingers turn the view');
}

async function looks(browser) {
  const page = await openPage(browser, {width: 1280, height: 800, deviceScaleFactor: 2});
  await pause(3000);
  await picture(page, 'double');
  assert.deepEqual(page.problems, []);
  await page.close();
}

/// The guide plays its steps; plans are made beside the picture.
async function lesson(browser) {
  const context = await browser.createBrowserContext();
  const page = await openPage(context, kDesktop);
  await pause(1500);
  await page.mouse.click(302, 300);  // the card of the bowl
  await page.says('step: Open');
  await page.shows('pot', /\. Step 1 of \d+: Open\. ./);  // for people who do not see the picture
  const gaps = [await page.lastLine('work started')];
  await picture(page, 'lesson');  // no frame meanwhile
  await page.keyboard.press('KeyG');
  await page.says('stroke ended');
  await page.says('step: Widen');
  gaps.push(await page.lastLine('stroke ended'));
  console.log('  longest time without a frame while steps were planned: ' +
    `${gaps.map(line => line.gap.toFixed(0)).join(' and ')} ms`);
  assert.deepEqual(page.problems, []);
  await context.close();
  console.log('the guide played a step and planned the next');
}

/// Pen, gamepad and 3Dconnexion controller, see devices.mjs.
async function devices(browser) {
  const open = async before => {  // without the works of other tests
    const context = await browser.createBrowserContext();
    const page = await openPageIn(context, folder, server.address, kDesktop, before ?? (() => {}));
    await page.says('window open');
    return page;
  };
  for (const test of [pen, gamepad, spaceMouse, partsOfOneController]) await test({open, folder});
  console.log('pen, gamepad and 3D mouse reach the clay');
}

/// `tests` of another file, each with a function that opens a page without the works of others:
/// open(hash, context, before), see openPage.
async function each(browser, ...tests) {
  const open = async (hash = '', context = null, before = null) =>
    openPageIn(context ?? await browser.createBrowserContext(), folder, server.address + hash, kDesktop, before);
  for (const test of tests) await test({open, folder, drawings, claystack});
}

/// Unusual files, links, keys and buttons, see odd_input.mjs.
async function odd(browser) {
  await each(browser, oddFiles, oddLinks, keysAndButtons, palms, otherScreen, failing);
  console.log('unusual files, links, keys and fingers: a message, and no harm');
}

/// Themes, hidden tabs, keys, links and versions, see browsing.mjs.
async function browsing(browser) {
  await each(browser, followedTheme, hiddenTab, clipboard, browsersKeys, untouchedLink);
  const openAt = async address => openPageIn(await browser.createBrowserContext(), folder, address, kDesktop, () => {});
  await versions({openAt, folder, site});
  console.log('theme, hidden tab, clipboard, keys, links and versions of the browser');
}

/// The window for screen readers, see controls.mjs.
async function controls(browser) {
  await each(browser, readAndPressed);
  console.log('controls of panels, menus and dialogs: read and pressed');
}

/// The works after unusual events, see storage.mjs.
async function storage(browser) {
  await each(browser, twoTabs, twoTabsWithoutLocks, savedPot, closedWithoutStorage, clearedStorage, unreadStorage, lostGraphics, pickedAgain, listedWorks, reloadedLink);
  console.log('a second tab, a reload, cleared or unreadable storage: no work is lost');
}

const kAll = {throwAndExport, files, drawn, words, controls, phone, lesson, devices, odd, browsing, storage, offline, offlineBeside, incomplete, repeated, looks};
let failed = 0;
const only = process.env.ONLY?.split(',');  // some tests, by name
try {
  const browser = await launch();
  for (const [name, test] of Object.entries(which === 'firefox' ? {throwAndExport} : kAll))
    if (!only || only.includes(name)) await test(browser);
  await browser.close();
  if (which === 'chromium')
    for (const [name, test] of Object.entries({lacking, quota, recover}))
      if (!only || only.includes(name)) await test();
} catch (error) {
  failed = 1;
  console.error(error);
}
server.close();
rmSync(folder, {recursive: true, force: true});
process.exit(failed);
