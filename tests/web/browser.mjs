// A browser with the page in it, for the tests: starts it, opens pages, waits for their
// announcements. Chromium by CDP, Firefox by WebDriver BiDi.
import assert from 'node:assert/strict';
import {existsSync, readdirSync} from 'node:fs';
import {join} from 'node:path';
import puppeteer from 'puppeteer-core';

export const pause = ms => new Promise(done => setTimeout(done, ms));

/// `name`: chromium or firefox. A computer without a graphics card draws by SwiftShader or Mesa; for
/// the latter Firefox needs a screen, as of xvfb-run. Downloads go to `folder`.
export async function launch(name, folder, flags = []) {
  if (name === 'firefox')
    return puppeteer.launch({
      browser: 'firefox', executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr',
      headless: false, protocolTimeout: 300000, env: {...process.env, LIBGL_ALWAYS_SOFTWARE: '1'},
      extraPrefsFirefox: {'webgl.force-enabled': true, 'browser.download.folderList': 2,
        'browser.download.dir': folder, 'browser.download.useDownloadDir': true,
        'browser.download.always_ask_before_handling_new_types': false,
        'browser.download.alwaysOpenPanel': false},
    });
  return puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true,
    protocolTimeout: 300000, userDataDir: join(folder, 'profile'),
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist', ...flags],
  });
}

/// A page at `url` that has opened its window. `says(text)` waits until it has announced the text.
export async function openPage(browser, folder, url, size, before = null) {
  const page = await browser.newPage();
  page.hosts = new Set();
  page.problems = [];
  page.on('request', request => {
    if (/^https?:/.test(request.url())) page.hosts.add(new URL(request.url()).origin + '/');
  });
  page.on('pageerror', error => page.problems.push(error.message));
  page.on('console', line => { if (line.type() === 'error') page.problems.push(line.text()); });
  // For each announced line [ms]: its time, the longest time without a frame since then, and the
  // time of the wheel since then, of which a frame counts for 100 ms at most.
  await page.evaluateOnNewDocument(() => {
    window.announced = [];
    let last = 0;
    const frame = now => {
      for (const line of window.announced) {
        line.gap = Math.max(line.gap, now - last);
        line.turned += Math.min(100, now - last);
      }
      last = now;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    document.addEventListener('DOMContentLoaded', () => new MutationObserver(changes => {
      for (const change of changes)
        for (const line of change.addedNodes)
          window.announced.push({text: line.textContent, at: performance.now(), gap: 0, turned: 0});
    }).observe(document.getElementById('events') ?? document, {childList: true}));
  });
  if (before) await page.evaluateOnNewDocument(before);
  page.lastLine = text => page.evaluate(text =>
    window.announced.findLast(line => line.text.startsWith(text)), text);
  page.announced = () => page.$$eval('#events p', lines => lines.map(line => line.textContent));
  page.says = (text, count = 1) => page.waitForFunction((text, count) =>
    document.getElementById('events').textContent.split(text).length > count,
    {timeout: 120000}, text, count).catch(async () =>
      assert.fail(`expected '${text}', found: ${(await page.announced()).join('; ')}`));
  /// Waits until the text of an element matches.
  page.shows = (id, pattern) => page.waitForFunction((id, source) =>
    new RegExp(source).test(document.getElementById(id).textContent),
    {timeout: 120000}, id, pattern.source).catch(async () =>
      assert.match(await page.$eval('#' + id, element => element.textContent), pattern));
  await page.setViewport(size);
  if (!(await page.browser().version()).startsWith('firefox')) {
    const downloads = await page.browser().target().createCDPSession();
    await downloads.send('Browser.setDownloadBehavior', {behavior: 'allow', downloadPath: folder,
      browserContextId: page.browserContext().id});
  }
  await page.goto(url);
  if (before) return page;
  await page.says('window open');
  console.log(`  window open after ${((await page.lastLine('window open')).at / 1000).toFixed(2)} s`);
  return page;
}

/// Clicks on "Throw it" of the bowl, again if a slow page has not drawn the gallery yet.
export async function beginBowl(page) {
  const begun = () => page.waitForFunction(() =>
    document.getElementById('events').textContent.includes('work started: bowl'),
    {timeout: 6000}).then(() => true, () => false);
  for (let i = 0; i < 10; ++i) {
    await pause(1000);
    await page.mouse.click(302, 470);  // also where a message below has two lines
    if (await begun()) return;
  }
  await page.says('work started: bowl');
}

/// A page of `open` with the lump of the bowl, checked.
export async function openBowl(open, ...how) {
  const page = await open(...how);
  await page.says('window open');
  await beginBowl(page);
  await page.says('checked: proved');
  return page;
}

/// Closes the page with its works. It had no problems.
export async function closeClean(page) {
  assert.deepEqual(page.problems, []);
  await page.browserContext().close();
}

export async function chord(page, key, ...held) {
  for (const mod of held) await page.keyboard.down(mod);
  await page.keyboard.press(key);
  for (const mod of held.reverse()) await page.keyboard.up(mod);
}

export async function choose(page, button, file) {
  const [chooser] = await Promise.all([page.waitForFileChooser(), page.click(button)]);
  await chooser.accept([file]);
}

export async function drop(page, ...files) {
  const events = await page.createCDPSession();
  const data = {items: [], files, dragOperationsMask: 1};
  for (const type of ['dragEnter', 'dragOver', 'drop'])
    await events.send('Input.dispatchDragEvent', {type, x: 640, y: 400, data});
}

/// Presses at the right of the lump of the bowl and pushes the wall inwards; the button stays down.
export async function drag(page) {
  await page.mouse.move(790, 522);
  await pause(300);
  await page.mouse.down();
  await page.says('stroke started');
  for (let x = 790; x >= 735; x -= 2) {
    await page.mouse.move(x, 522 - (790 - x) / 4);
    await pause(30);
  }
}

export async function downloaded(folder, name) {
  const unfinished = [join(folder, name + '.part'), join(folder, name + '.crdownload')];
  for (let i = 0; i < 900; ++i, await pause(100))
    if (existsSync(join(folder, name)) && !unfinished.some(existsSync)) break;
  assert.ok(existsSync(join(folder, name)),
    `expected the download ${name}, found ${readdirSync(folder).join(', ')}`);
  await pause(300);
  return join(folder, name);
}
