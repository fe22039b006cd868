// Keeps the works in the storage of the browser, and the files of the page for a start without its
// server.
'use strict';

const kHome = '/home/web_user';
const kStoreMs = 400;      // interval at which changes are stored
const kClaimMs = 2000;     // a page that was reloaded leaves the storage within this time

/// Shown in the window too.
function warn(text) {
  status(text);
  withText(text, place => studio._claystack_notice(place));
  ask();
}

let stores = false;  // this tab

/// One tab alone stores: another one would replace the works by its own. Where browsers have no locks,
/// which need https or localhost, each tab stores. A promise: it is decided.
function claimStorage() {
  return new Promise(decided => {
    const decide = own => { stores = own; decided(); };
    if (!navigator.locks) return decide(true);
    const late = new AbortController();
    setTimeout(() => late.abort(), kClaimMs);
    navigator.locks.request('claystack storage', {signal: late.signal}, () => {
      decide(true);
      return new Promise(() => {});  // as long as the page is open
    }).catch(() => decide(!late.signal.aborted));
  });
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
    if (error) page.log('error: storage: ' + error);
    module.removeRunDependency('storage');
  }));
}

function listenToStorage() {
  if (!stores)
    warn('Claystack is open in another tab, so this tab stores no works. ' +
      'Save the work as a file (Ctrl+S), or close the other tab and reload this page.');
  setInterval(store, kStoreMs);
  // The title of an unsaved work begins with a star.
  window.addEventListener('beforeunload', event => {
    if ((!stores || warned) && document.title.startsWith('*')) event.preventDefault();
  });
}

let changed = false, storing = false, warned = false;
function store() {
  if (!stores || !changed || storing || !studio) return;
  changed = false;
  storing = true;
  studio.FS.syncfs(false, error => {
    storing = false;
    if (!error) {
      if (warned) status('The work is stored again');
      warned = false;
      return;
    }
    changed = true;
    if (warned) return;
    warned = true;
    const full = error.name === 'QuotaExceededError';
    warn('The browser cannot store the work: ' +
      (full ? 'its storage is full' : error.message || error.name || error) +
      '. What it stored before remains. Save the work as a file (Ctrl+S).');
  });
}

/// The next start needs no server. Browsers offer this on https and localhost alone.
async function keepOffline() {
  try {
    await navigator.serviceWorker?.register('offline.js');
    if (await navigator.serviceWorker?.ready) page.log('ready offline');
  } catch (error) {
    page.log('not ready offline: ' + error.message);
  }
}
