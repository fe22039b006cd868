// The works after unusual events: a second tab, a reload, storage that was cleared or cannot be
// read.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {beginBowl, choose, chord, closeClean, drag, openBowl, pause} from './browser.mjs';

/// A second tab, for example a link that is opened, does not replace the works of the first one.
export async function twoTabs({open}) {
  const first = await open();
  const context = first.browserContext();
  await beginBowl(first);
  await first.says('checked: proved');
  await pause(1000);
  const second = await open('', context);
  await second.shows('status', /^Claystack is open in another tab, so this tab stores no works\. /);
  await first.bringToFront();
  await drag(first);
  await first.mouse.up();
  await first.says('stroke ended');
  await pause(2000);  // it is stored
  const late = await open('', context);
  await late.shows('status', /^Claystack is open in another tab/);
  assert.deepEqual((await late.announced()).filter(line => line.startsWith('recovery offered')), [],
    'expected no offer of a work that is open in another tab');
  await late.close();
  await first.close();
  await second.bringToFront();
  await second.mouse.move(400, 300);
  await pause(2000);
  await second.close();
  const third = await open('', context);
  await third.says('recovery offered: 1');
  await pause(1500);
  await chord(third, 'KeyR', 'Control');
  await third.says('recovered: ');
  await third.click('#words');
  assert.match(await third.$eval('#report-text', element => element.textContent), /Strokes: 1\n/);
  assert.deepEqual([...first.problems, ...second.problems, ...late.problems, ...third.problems], []);
  await context.close();
}

/// Without https browsers have no locks: the second tab asks, and the first one answers.
export async function twoTabsWithoutLocks({open}) {
  const withoutLocks = () => Object.defineProperty(Navigator.prototype, 'locks', {value: undefined});
  const first = await open('', null, withoutLocks);
  await first.says('window open');
  const second = await open('', first.browserContext(), withoutLocks);
  await second.says('window open');
  await second.shows('status', /^Claystack is open in another tab, so this tab stores no works\. /);
  assert.equal(await first.evaluate(() => stores), true);
  assert.equal(await second.evaluate(() => stores), false);
  await first.browserContext().close();
}

/// A pot that is saved as a file does not stay in the storage, as a work does.
export async function savedPot({open}) {
  const page = await openBowl(open);
  await chord(page, 'KeyS', 'Control');
  await page.says('action: file.save');
  await pause(1000);
  await chord(page, 'KeyA', 'Control');
  await page.keyboard.type('kept.pot.json');
  await pause(500);
  await page.keyboard.press('Enter');
  await page.says('saved: /home/web_user/kept.pot.json');
  assert.equal(await page.evaluate(() => studio.FS.analyzePath('/home/web_user/kept.pot.json').exists), false);
  await closeClean(page);
}

/// A tab that stores nothing asks before it is closed with an unsaved work.
export async function closedWithoutStorage({open}) {
  const first = await open();
  const second = await open('', first.browserContext());
  await second.shows('status', /^Claystack is open in another tab/);
  await beginBowl(second);
  await drag(second);
  await second.mouse.up();
  await second.says('stroke ended');
  let asked = 0;
  second.on('dialog', dialog => {
    ++asked;
    dialog.accept();
  });
  await second.close({runBeforeUnload: true});
  for (let i = 0; i < 50 && asked === 0; ++i) await pause(100);
  assert.equal(asked, 1, 'expected a question before an unsaved work is lost');
  await first.browserContext().close();
}

/// Files in the storage of the page.
const stored = page => page.evaluate(() => studio.FS.readdir('/home/web_user').filter(name => name.startsWith('test-')));
const put = (page, ...names) => page.evaluate(async names => {
  for (const name of names) studio.FS.writeFile('/home/web_user/' + name, name);
  ask();
}, names);
const kStored = 1500;  // ms, until files are stored

/// The user clears the data of the site while the page is open: it stores its files again. A file that
/// goes while it is being stored is no fault.
export async function clearedStorage({open}) {
  const page = await open();
  await put(page, 'test-1');
  await pause(kStored);
  const data = await page.createCDPSession();
  await data.send('Storage.clearDataForOrigin',
    {origin: new URL(page.url()).origin, storageTypes: 'indexeddb'});
  await put(page, 'test-2');
  await pause(2 * kStored);
  await page.evaluate(async () => {
    studio.FS.writeFile('/home/web_user/test-3', '3');
    while (storing) await new Promise(done => setTimeout(done, 1));
    changed = true;
    store();
    studio.FS.unlink('/home/web_user/test-3');
  });
  await pause(kStored);
  assert.equal(await page.$eval('#status', element => element.textContent), '');
  await page.reload();
  await page.says('window open');
  assert.deepEqual(await stored(page), ['test-1', 'test-2']);
  await closeClean(page);
}

/// A file that the browser cannot read at the start: the tab stores nothing, so that no file is lost.
export async function unreadStorage({open}) {
  const first = await open();
  const context = first.browserContext();
  await put(first, 'test-1', 'test-2', 'test-3');
  await pause(kStored);
  await first.close();
  const second = await open('', context, () => {
    const get = IDBObjectStore.prototype.get;
    IDBObjectStore.prototype.get = function (key) {
      const request = get.call(this, key);
      if (!key.endsWith('test-2')) return request;
      const failed = {};
      request.onsuccess = () => failed.onerror({target: {error: new DOMException('planted.', 'DataError')}, preventDefault() {}});
      return failed;
    };
  });
  await second.says('window open');
  await second.shows('status', /^The browser cannot read the works that it stored: planted\. This tab stores none/);
  await pause(kStored);
  await second.close();
  const third = await open('', context);
  assert.deepEqual(await stored(third), ['test-1', 'test-2', 'test-3']);
  assert.deepEqual([...first.problems, ...second.problems, ...third.problems], []);
  await context.close();
}

/// The browser takes the graphics away: the page reports whether the work is stored.
export async function lostGraphics({open}) {
  const first = await open();
  const second = await open('', first.browserContext());
  for (const [page, text] of [[first, /The work is stored: reload the page\.$/], [second, /The work is not stored: press Ctrl\+S and Enter/]]) {
    await page.bringToFront();
    await page.evaluate(() => canvas.getContext('webgl2').getExtension('WEBGL_lose_context').loseContext());
    await page.shows('message', text);
  }
  await first.browserContext().close();
}

/// A work that was picked, and then chosen again among the files opened last, is saved into the storage.
export async function pickedAgain({open, folder}) {
  const page = await open();
  await choose(page, '#open', join(folder, 'bowl.work'));
  await page.says('opened: bowl.work');
  await page.evaluate(() => withText('/opened/bowl.work', path => studio._claystack_open(path)));
  await page.says('opened: /opened/bowl.work');
  await page.focus('#canvas');
  await chord(page, 'KeyS', 'Control');
  await page.says('saved: /home/web_user/bowl.work');
  await closeClean(page);
}

/// The list has all works, more than the menu of recent files; one is deleted after a question.
export async function listedWorks({open, folder}) {
  const works = page => page.evaluate(() =>
    studio.FS.readdir('/home/web_user').filter(name => name.endsWith('.work')).length);
  const page = await open();
  await choose(page, '#open', join(folder, 'bowl.work'));
  await page.says('opened: bowl.work');
  await page.evaluate(() => {
    const bytes = studio.FS.readFile('/opened/bowl.work');
    for (let i = 0; i < 10; ++i) studio.FS.writeFile(`/home/web_user/pot-${i}.work`, bytes);
  });
  await page.focus('#canvas');
  await page.keyboard.press('F10');
  for (let i = 0; i < 11; ++i) {
    await pause(60);
    await page.keyboard.press('ArrowDown');
  }
  await page.keyboard.press('Enter');
  await page.says('action: file.works');
  await pause(500);
  const asked = () => page.$eval('#events', events => events.textContent.includes('prompt: delete'));
  for (let y = 120; y < 700 && !await asked(); y += 9) {  // down the buttons at the right
    await page.mouse.click(822, y);
    await pause(150);
  }
  assert.ok(await asked(), 'expected a question after a click on a button of the list');
  assert.equal(await works(page), 10);
  await chord(page, 'KeyD', 'Control', 'Shift');
  for (let i = 0; i < 50 && await works(page) === 10; ++i) await pause(100);
  await pause(kStored);
  await page.reload();
  await page.says('window open');
  assert.equal(await works(page), 9);
  await closeClean(page);
}

/// A reload of a page whose address holds a pot offers the work, with the strokes since then.
export async function reloadedLink({open}) {
  const page = await openBowl(open);
  await page.click('#link');
  await page.shows('status', /^The address of this page now holds the pot/);
  await drag(page);
  await page.mouse.up();
  await page.says('stroke ended');
  await pause(kStored);
  await page.reload();
  await page.says('recovery offered: 1');
  await pause(kStored);
  assert.deepEqual((await page.announced()).filter(line => line.startsWith('opened: ')), []);
  await closeClean(page);
}
