// The page among the habits of a browser: its theme, hidden tabs, the clipboard, keys that end a
// program, links that are reloaded, and a server that gets a new version of the page.
import assert from 'node:assert/strict';
import {cpSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {beginBowl, chord, closeClean, drag, openBowl, pause} from './browser.mjs';
import {serve} from './server.mjs';

const kStored = 1500;  // ms, until files are stored
const theme = page => page.evaluate(() => document.documentElement.dataset.theme);
const light = page => page.evaluate(() => {  // a pixel of the window, in its upper left corner
  const gl = canvas.getContext('webgl2'), pixel = new Uint8Array(4);
  gl.readPixels(2, canvas.height - 3, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  return pixel[0] > 128;
});
const prefer = (page, value) => page.emulateMediaFeatures([{name: 'prefers-color-scheme', value}]);

/// The window and the controls around it follow the browser, also once other settings were stored.
export async function followedTheme({open}) {
  const page = await open();
  const shows = async name => {
    await page.waitForFunction(name => document.documentElement.dataset.theme === name, {timeout: 10000}, name);
    for (let i = 0; i < 50 && await light(page) !== (name === 'light'); ++i) await pause(100);
    assert.equal(await light(page), name === 'light', `expected the window in its ${name} theme`);
  };
  await prefer(page, 'light');
  await shows('light');
  await prefer(page, 'dark');
  await shows('dark');
  await beginBowl(page);
  await page.keyboard.press('KeyW');  // the wall map: a setting
  await page.says('action: view.wall_map');
  await pause(3000);  // it is stored
  await page.reload();
  await page.says('window open');
  await prefer(page, 'light');
  await shows('light');
  await closeClean(page);
}

/// The tab is hidden in the middle of a stroke: the stroke ends and is stored at once, not with the
/// next interval, which a hidden page may never have.
export async function hiddenTab({open}) {
  const page = await openBowl(open, '', null, () => { window.setInterval = () => 0; });
  const context = page.browserContext();
  await drag(page);
  await page.evaluate(() => {
    Object.defineProperty(document, 'hidden', {value: true});
    document.dispatchEvent(new Event('visibilitychange'));
  });
  await pause(kStored);
  await page.close();
  const again = await open('', context);
  await again.says('recovery offered: 1');
  await pause(kStored);
  await chord(again, 'KeyR', 'Control');
  await again.says('recovered: ');
  await again.click('#words');
  assert.match(await again.$eval('#report-text', element => element.textContent), /Strokes: 1\n/);
  await context.close();
}

/// Text goes from the page into a field of the window, and back.
export async function clipboard({open}) {
  const page = await open();
  await beginBowl(page);
  await page.evaluate(() => {
    window.copied = [];
    Object.defineProperty(navigator, 'clipboard', {value: {writeText: async text => { window.copied.push(text); }}});
  });
  await chord(page, 'KeyS', 'Control');
  await page.says('action: file.save');
  await pause(1000);
  await chord(page, 'KeyA', 'Control');
  await page.evaluate(() => {
    const clipboardData = new DataTransfer();
    clipboardData.setData('text', 'pasted.work');
    canvas.dispatchEvent(new ClipboardEvent('paste', {clipboardData, bubbles: true}));
  });
  await pause(500);
  await chord(page, 'KeyA', 'Control');
  await chord(page, 'KeyC', 'Control');
  await page.waitForFunction(() => window.copied.includes('pasted.work'), {timeout: 10000});
  await page.keyboard.press('Enter');
  await page.says('saved: /home/web_user/pasted.work');
  await closeClean(page);
}

/// Ctrl+Q does not end the frames of a page. Keys of the browser do not reach the program.
export async function browsersKeys({open}) {
  const page = await openBowl(open);
  const before = await theme(page);
  await page.evaluate(() => {  // real ones would leave the page
    for (const key of ['q', 'l', 'r'])
      canvas.dispatchEvent(new KeyboardEvent('keydown', {key, ctrlKey: true, bubbles: true, cancelable: true}));
  });
  await pause(1000);
  await page.keyboard.press('F1');
  await page.says('action: help.keys');
  const actions = (await page.announced()).filter(line => line.startsWith('action: '));
  assert.deepEqual(actions.slice(-1), ['action: help.keys']);
  assert.ok(!actions.some(line => /quit|theme|recover/.test(line)), actions.join('; '));
  assert.equal(await theme(page), before);
  await closeClean(page);
}

/// A link without strokes since then opens again after a reload.
export async function untouchedLink({open}) {
  const first = await openBowl(open);
  await first.click('#link');
  await first.waitForFunction(() => location.hash.startsWith('#pot='));
  const hash = await first.evaluate(() => location.hash);
  await first.browserContext().close();
  const page = await open(hash);
  await page.says('opened: ');
  await pause(kStored);
  await page.reload();
  await page.says('opened: ');
  await closeClean(page);
}

/// The server gets another version while the page is open, or while its files are being fetched.
export async function versions({openAt, folder, site}) {
  const copy = join(folder, 'versions');
  cpSync(site, copy, {recursive: true});
  writeFileSync(join(copy, 'worker.js'), readFileSync(join(copy, 'worker.js'), 'utf8')
    .replace(/const kVersion = '[0-9a-f]+'/, `const kVersion = '${'0'.repeat(16)}'`));
  const own = await serve(copy);
  const page = await openAt(own.address);
  await page.says('window open');
  await beginBowl(page);
  await page.shows('status', /the server has another version of this page now: reload it$/);
  await pause(3000);
  assert.deepEqual(await page.evaluate(() => caches.keys()), [], 'expected no mixture of versions for offline use');
  assert.ok(!(await page.announced()).includes('ready offline'));
  await page.browserContext().close();
  own.close();
}
