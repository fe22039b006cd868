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

let stores = false, unread = null;  // this tab; why it could not read what was stored

/// Whether the work survives a reload.
function kept() { return stores && !failing(); }

/// One tab alone stores: another one would replace the works by its own. A promise: it is decided.
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

/// Browsers have locks on https and localhost alone. Elsewhere the tabs ask each other; of two that
/// open within the same moment both store. A tab that gets its answer late stores no more.
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

/// Before the program starts: what was stored, and the folder of files that are opened. The program
/// names a file in its current folder by its name alone.
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

// Since when it fails, and whether the user knows. A first failure may be a file that the program has
// just deleted, or a storage that the user has just cleared, so it is no problem for a moment.
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
    if (document.hidden) store();  // what came meanwhile: a hidden page may be frozen soon
  });
}

function notStored(error) {
  changed = true;
  studio.IDBFS.quit();  // opened anew next time: somebody may have cleared the storage
  failedAt ??= performance.now();
  if (warned || performance.now() - failedAt < kTroubleMs) return;
  warned = true;
  warn(`The browser cannot store the work: ${reason(error)}. What it stored before remains. ` +
    'Save the work as a file (Ctrl+S).');
}

/// The next start needs no server. Browsers offer this on https and localhost alone.
async function keepOffline() {
  try {
    await navigator.serviceWorker?.register('offline.js?' + kVersion);
    if (await navigator.serviceWorker?.ready) page.log('ready offline');
  } catch (error) {
    page.log('not ready offline: ' + error.message);
  }
}
