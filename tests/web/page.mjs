// Throws, exports and recovers a pot in Chromium, by mouse and keys alone, and judges the downloads
// with the native program: node tests/web/page.mjs SITE CLAYSTACK PICTURES
// tests/web_page.sh installs what it needs and calls it.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {inflateRawSync} from 'node:zlib';
import puppeteer from 'puppeteer-core';
import {serve} from './server.mjs';

const [site, claystack, pictures] = process.argv.slice(2).map(path => resolve(path));
mkdirSync(pictures, {recursive: true});
const folder = mkdtempSync(join(tmpdir(), 'claystack-web-'));
const server = await serve(site);
const pause = ms => new Promise(done => setTimeout(done, ms));

// A computer without a graphics card draws by SwiftShader.
async function launch() {
  return puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true,
    userDataDir: join(folder, 'profile'),
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist'],
  });
}

/// A page that has opened its window. `says(text)` waits until the page has announced it.
async function openPage(browser, size, hash = '', address = server.address) {
  const page = await browser.newPage();
  const hosts = new Set();
  page.on('request', request => {
    if (/^https?:/.test(request.url())) hosts.add(new URL(request.url()).origin + '/');
  });
  page.problems = [];
  page.on('pageerror', error => page.problems.push(error.message));
  page.on('console', line => { if (line.type() === 'error') page.problems.push(line.text()); });
  page.hosts = hosts;
  // When the page announced each line, and the longest time without a frame since then [ms].
  await page.evaluateOnNewDocument(() => {
    window.announced = [];
    let last = 0;
    const frame = now => {
      for (const line of window.announced) line.gap = Math.max(line.gap, now - last);
      last = now;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    document.addEventListener('DOMContentLoaded', () => new MutationObserver(changes => {
      for (const change of changes)
        for (const line of change.addedNodes)
          window.announced.push({text: line.textContent, at: performance.now(), gap: 0});
    }).observe(document.getElementById('events') ?? document, {childList: true}));
  });
  page.lastLine = text => page.evaluate(text =>
    window.announced.findLast(line => line.text.startsWith(text)), text);
  page.announced = () => page.$$eval('#events p', lines => lines.map(line => line.textContent));
  await page.setViewport(size);
  const downloads = await page.browser().target().createCDPSession();
  await downloads.send('Browser.setDownloadBehavior', {behavior: 'allow', downloadPath: folder});
  page.says = (text, count = 1) => page.waitForFunction((text, count) =>
    document.getElementById('events').textContent.split(text).length > count,
    {timeout: 60000}, text, count).catch(async () =>
      assert.fail(`expected '${text}', found: ${(await page.announced()).join('; ')}`));
  await page.goto(address + hash);
  await page.says('window open');
  console.log(`  window open after ${((await page.lastLine('window open')).at / 1000).toFixed(2)} s`);
  return page;
}

async function chord(page, key, ...held) {
  for (const mod of held) await page.keyboard.down(mod);
  await page.keyboard.press(key);
  for (const mod of held.reverse()) await page.keyboard.up(mod);
}

async function downloaded(name) {
  for (let i = 0; i < 600 && !existsSync(join(folder, name)); ++i) await pause(100);
  assert.ok(existsSync(join(folder, name)), `expected the download ${name}`);
  await pause(300);
  return join(folder, name);
}

function native(...words) {
  const ran = spawnSync(claystack, words, {encoding: 'utf8', cwd: folder});
  assert.equal(ran.status, 0, `claystack ${words.join(' ')}: ${ran.stdout}${ran.stderr}`);
  return ran.stdout;
}

/// Presses at the right of the lump and pushes the wall inwards.
async function drag(page) {
  await page.mouse.move(790, 522);
  await pause(300);
  await page.mouse.down();
  await page.says('stroke started');
  for (let x = 790; x >= 735; x -= 2) {
    await page.mouse.move(x, 522 - (790 - x) / 4);
    await pause(30);
  }
}

async function throwAndExport(browser) {
  const page = await openPage(browser, {width: 1280, height: 800});
  await pause(1500);
  await page.screenshot({path: join(pictures, 'gallery.png')});
  await page.mouse.click(302, 465);  // Lump, of the bowl
  await page.says('work started: bowl');
  await page.says('checked: proved');
  await drag(page);
  await page.mouse.up();
  await page.says('stroke ended');
  await page.says('checked: proved', 2);
  await pause(1500);
  await page.screenshot({path: join(pictures, 'thrown.png')});
  await chord(page, 'KeyZ', 'Control');
  await page.says('action: edit.undo');
  await page.says('checked: proved', 3);
  await chord(page, 'KeyZ', 'Control', 'Shift');
  await page.says('action: edit.redo');
  await page.says('checked: proved', 4);
  await chord(page, 'KeyE', 'Control');
  await page.says('export previewed');
  await page.mouse.click(420, 132);  // STL
  await page.mouse.click(509, 165);  // Pot
  await pause(1500);
  await page.screenshot({path: join(pictures, 'export.png')});
  await chord(page, 'Enter', 'Control');
  await page.says('exported:', 3);
  const begun = await page.lastLine('export started'), ended = await page.lastLine('exported:');
  console.log(`  3MF, STL and pot exported in ${((ended.at - begun.at) / 1000).toFixed(2)} s; ` +
              `longest time without a frame ${begun.gap.toFixed(0)} ms`);
  const stl = await downloaded('bowl.stl'), pot = await downloaded('bowl.pot.json');
  await downloaded('bowl.3mf');
  native('check', stl);
  native('export', '-q', pot, 'native.stl');
  assert.ok(readFileSync(stl).equals(readFileSync(join(folder, 'native.stl'))),
    'expected the STL of the native program');
  await page.keyboard.press('Escape');
  await chord(page, 'KeyS', 'Control');
  await page.says('action: file.save');
  await pause(1000);
  await page.screenshot({path: join(pictures, 'save.png')});
  await page.keyboard.press('Enter');
  await page.says('saved:');
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

async function choose(page, button, file) {
  const [chooser] = await Promise.all([page.waitForFileChooser(), page.click(button)]);
  await chooser.accept([file]);
}

async function drop(page, file) {
  const events = await page.createCDPSession();
  const data = {items: [], files: [file], dragOperationsMask: 1};
  for (const type of ['dragEnter', 'dragOver', 'drop'])
    await events.send('Input.dispatchDragEvent', {type, x: 640, y: 400, data});
}

/// Opens files by picking and by dropping; a link in the profile of another person.
async function files(browser) {
  const page = await openPage(browser, {width: 1280, height: 800});
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
  await page.screenshot({path: join(pictures, 'report.png')});
  await page.keyboard.press('Enter');  // Close
  const open = readFileSync(join(folder, 'bowl.stl')).subarray(0, -50);  // lacks a triangle
  open.writeUInt32LE(open.readUInt32LE(80) - 1, 80);
  writeFileSync(join(folder, 'open.stl'), open);
  await drop(page, join(folder, 'open.stl'));
  await shows(spawnSync(claystack, ['check', '--json', 'open.stl'], {encoding: 'utf8', cwd: folder}).stdout);
  assert.match(await page.$eval('#report-verdict', e => e.textContent), /^Not sound/);
  assert.deepEqual(page.problems, []);
  await page.close();

  const stranger = await browser.createBrowserContext();
  const other = await openPage(stranger, {width: 1280, height: 800}, hash);
  await other.says('opened: ');
  await pause(1500);
  await other.screenshot({path: join(pictures, 'link.png')});
  assert.ok((await linked(other)).pot.equals(expected), 'expected the same pot from the link');
  assert.deepEqual(other.problems, []);
  await stranger.close();
  console.log('picked, dropped, linked: the same pot and reports as the native program');
}

/// The second start has no server.
async function offline(browser) {
  const own = await serve(site);
  const context = await browser.createBrowserContext();
  const page = await openPage(context, {width: 1280, height: 800}, '', own.address);
  await page.says('ready offline');
  own.close();
  await assert.rejects(fetch(own.address));
  await page.goto(own.address);
  await page.says('window open');
  await pause(1000);
  await page.mouse.click(302, 465);
  await page.says('checked: proved');  // by the worker, whose files are kept too
  await context.close();
  console.log('started without the server');
}

/// Kills the browser in the middle of a stroke.
async function recover() {
  let browser = await launch();
  const page = await openPage(browser, {width: 1280, height: 800});
  await pause(1000);
  await page.mouse.click(302, 465);
  await page.says('work started: bowl');
  await drag(page);
  await pause(2500);
  browser.process().kill('SIGKILL');
  await pause(1000);
  browser = await launch();
  const again = await openPage(browser, {width: 1280, height: 800});
  await again.says('recovery offered: 1');
  await pause(1500);
  await again.screenshot({path: join(pictures, 'recovery.png')});
  await browser.close();
  console.log('killed in a stroke: the work is offered again');
}

async function looks(browser) {
  for (const [name, size] of [['phone', {width: 390, height: 844, isMobile: true, hasTouch: true}],
      ['double', {width: 1280, height: 800, deviceScaleFactor: 2}]]) {
    const page = await openPage(browser, size);
    await pause(3000);
    await page.screenshot({path: join(pictures, name + '.png')});
    assert.deepEqual(page.problems, []);
    await page.close();
  }
}

let failed = 0;
try {
  const browser = await launch();
  await throwAndExport(browser);
  await files(browser);
  await offline(browser);
  await looks(browser);
  await browser.close();
  await recover();
} catch (error) {
  failed = 1;
  console.error(error);
}
server.close();
rmSync(folder, {recursive: true, force: true});
process.exit(failed);
