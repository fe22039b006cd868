// Keeps the works in the storage of the browser, and the files of the page for a start without its
// server.
'use strict';

const kHome = '/home/web_user';
const kStoreMs = 200;      // interval at which changes are stored
const kAskMs = 300;        // another tab usually answers within this time
const kClaimMs = 2000;     // a page that was reloaded leaves the storage within this time

/// Shown in the window too.
function warn(text) {
  status(text);
  withText(text, place => studio._claystack_notice(place));
  ask();
}

function reason(error) {
  if (error.name === 'QuotaExceededError') return 'its storage is full';
  return String(error.message || error.name || error).replace(/\.$/, '');
}

let stores = false, unread = null;  // this tab stores; the error of reading the stored works

/// Whether the work survives a reload.
function kept() { return stores && !failing(); }

/// Only one tab stores works: a second one would replace the works of the first. The promise
/// resolves when that is decided.
function claimStorage() {
  return new Promise(decided => {
    const decide = own => { stores = own; decided(); };
    if (!navigator.locks) return askTabs(decide);
    const late = new AbortController();
    setTimeout(() => late.abort(), kClaimMs);
    navigator.locks.request('claystack storage', {signal: late.signal}, () => {
      decide(true);
      return new Promise(() => {});  // as long as the page is open
    }).catch(() => decide(!late.signal.aborted));
  });
}

/// Browsers have locks only on https and localhost. Elsewhere the tabs ask each other; if two open
/// at the same moment, both store. A tab that gets its answer late stops storing.
function askTabs(decide) {
  if (!window.BroadcastChannel) return decide(true);
  const tabs = new BroadcastChannel('claystack storage'), me = Math.random();
  let waiting = true;
  const end = own => {
    waiting = false;
    decide(own);
  };
  tabs.onmessage = ({data: {asks, answers}}) => {
    if (asks && stores) tabs.postMessage({answers: asks});
    if (answers !== me) return;
    if (waiting) return end(false);
    stores = false;
    if (studio) warnOfOtherTab();
  };
  tabs.postMessage({asks: me});
  setTimeout(() => { if (waiting) end(true); }, kAskMs);
}

function warnOfOtherTab() {
  warn('Claystack is open in another tab, so this tab stores no works. ' +
    'Save the work as a file (Ctrl+S), or close the other tab and reload this page.');
}

/// Before the program starts: prepares the stored works, and the folder of opened files. The
/// program names a file in its current folder without the folder.
function prepareFiles(module, claimed) {
  module.FS.mkdirTree(kHome);
  module.FS.mount(module.IDBFS, {}, kHome);
  module.FS.mkdir('/opened');
  module.FS.chdir('/opened');
  module.addRunDependency('storage');
  // Not before: the tab that leaves the storage may still write to it.
  claimed.then(() => module.FS.syncfs(true, error => {
    // Storing makes the storage equal to the files of this tab: works that were not read would be deleted.
    if (error) [stores, unread] = [false, error];
    module.removeRunDependency('storage');
  }));
}

function listenToStorage() {
  if (unread)
    warn(`The browser cannot read the works that it stored: ${reason(unread)}. This tab stores none, ` +
      'so that those remain. Reload this page to try again, or save the work as a file (Ctrl+S).');
  else if (!stores) warnOfOtherTab();
  setInterval(store, kStoreMs);
  // The title of an unsaved work begins with a star.
  window.addEventListener('beforeunload', event => {
    if (!kept() && document.title.startsWith('*')) event.preventDefault();
  });
}

// The time of the first failed write, and whether the user was warned. A first failure may have a
// short cause: a file that the program has just deleted, or a storage that the user has just
// cleared.
const kTroubleMs = 500;
let failedAt = null, warned = false;
const failing = () => warned;

let changed = false, storing = false;
function store() {
  if (!stores || !changed || storing || !studio) return;
  changed = false;
  storing = true;
  studio.FS.syncfs(false, error => {
    storing = false;
    if (error) return notStored(error);
    if (warned) status('The work is stored again');
    [failedAt, warned] = [null, false];
    if (document.hidden) store();  // changes since then: a hidden page may be frozen soon
  });
}

function notStored(error) {
  changed = true;
  studio.IDBFS.quit();  // opened again next time: the user may have cleared the storage
  failedAt ??= performance.now();
  if (warned || performance.now() - failedAt < kTroubleMs) return;
  warned = true;
  warn(`The browser cannot store the work: ${reason(error)}. What it stored before remains. ` +
    'Save the work as a file (Ctrl+S).');
}

let askedToKeep = false;
/// After the first save: asks the browser not to delete the storage when the disk is full. Firefox
/// asks the user, so a page that was only looked at does not ask.
function keepStorage() {
  if (askedToKeep) return;
  askedToKeep = true;
  navigator.storage?.persist?.().then(persistent =>
    page.log(persistent ? 'storage: persistent' : 'storage: the browser may delete it')).catch(() => {});
}

/// Keeps the files of the page, so that the next start needs no server. Browsers permit this only
/// on https and localhost.
async function keepOffline() {
  try {
    await navigator.serviceWorker?.register('offline.js?' + kVersion);
    if (await navigator.serviceWorker?.ready) page.log('ready offline');
  } catch (error) {
    page.log('not ready offline: ' + error.message);
  }
}
