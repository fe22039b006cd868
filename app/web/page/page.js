// Connects the page with the module: events, frames, files, workers, storage.
'use strict';

const kHome = '/home/web_user';
const kIdleMs = 500;       // interval of frames without input
const kStoreMs = 400;      // interval at which changes are stored
const kClaimTries = 5, kClaimMs = 500;  // a page that was reloaded leaves the storage meanwhile
const kMostLinkBytes = 8192;
const kNotchPx = 100, kNotchLines = 3;  // of the mouse wheel
const kPinchPx = 12;       // of a pinch, as much as a notch
const kMeshes = /\.(stl|obj|ply|off|glb|drc|3mf|step|stp)$/i;
const kShift = 1, kControl = 2, kAlt = 4;

const by = id => document.getElementById(id);
const canvas = by('canvas');
let studio = null;

function say(text) { by('message').textContent = text; }
function status(text) { by('status').textContent = text; }

// ---- frames ------------------------------------------------------------------------------------

let asked = false, idle = 0;
function ask() {
  if (asked || !studio || document.hidden) return;
  asked = true;
  clearTimeout(idle);
  requestAnimationFrame(now => {
    asked = false;
    frame(now);
    keyboard.follow();
  });
}

function frame(now) {
  let more = false;
  try {
    more = studio._claystack_frame(now);
  } catch (error) {
    asked = true;  // draws no more
    return say(`Claystack has stopped: ${error.message ?? error}. Reload the page: it offers the work again.`);
  }
  changed = true;
  if (more) ask();
  else idle = setTimeout(ask, kIdleMs);
}

function resize() {
  const scale = window.devicePixelRatio || 1;
  const box = canvas.getBoundingClientRect();
  canvas.width = Math.max(1, Math.round(box.width * scale));
  canvas.height = Math.max(1, Math.round(box.height * scale));
  studio._claystack_resize(canvas.width, canvas.height, scale);
  ask();
}

// ---- pointer: mouse, pen, touch ----------------------------------------------------------------

function mods(event) {
  if (event.getModifierState?.('AltGraph')) return event.shiftKey ? kShift : 0;
  return (event.shiftKey ? kShift : 0) | (event.ctrlKey || event.metaKey ? kControl : 0) |
         (event.altKey ? kAlt : 0);
}

function point(event) {
  const box = canvas.getBoundingClientRect();
  studio._claystack_pointer((event.clientX - box.left) * canvas.width / box.width,
                            (event.clientY - box.top) * canvas.height / box.height,
                            event.pointerType === 'pen' ? event.pressure : -1);
}

const kButtonBits = [1, 2, 4];  // left, right, middle: the order of the program
const down = new Set();
function button(index, pressed, event) {
  if (pressed === down.has(index)) return;
  if (pressed) down.add(index); else down.delete(index);
  studio._claystack_button(index, pressed, mods(event));
  ask();
}

/// The browser reports the first button as `pointerdown`, and further ones as moves.
function mouse(event) {
  point(event);
  kButtonBits.forEach((bit, index) => button(index, (event.buttons & bit) !== 0, event));
}

/// Steps of the wheel. Touchpads report many small parts of a step, and a pinch as the wheel with Ctrl.
function wheelSteps(event) {
  const notch = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? (event.ctrlKey ? kPinchPx : kNotchPx)
    : event.deltaMode === WheelEvent.DOM_DELTA_LINE ? kNotchLines : 1;
  return Math.max(-1, Math.min(1, -event.deltaY / notch));
}

const fingers = new Fingers({
  move(x, y) { point({clientX: x, clientY: y}); ask(); },
  press(index, pressed) { button(index, pressed, {}); },
  scroll(steps) { studio._claystack_scroll(steps); ask(); },
  overPot() { return studio._claystack_over_pot(); },
});

function listenToPointer() {
  canvas.addEventListener('pointerdown', event => {
    canvas.focus();
    canvas.setPointerCapture(event.pointerId);
    event.preventDefault();  // a touch is not a mouse as well, which would move the focus later
    if (event.pointerType === 'touch') return fingers.begin(event);
    mouse(event);
  });
  canvas.addEventListener('pointermove', event => {
    if (event.pointerType === 'touch') return fingers.move(event);
    for (const part of event.getCoalescedEvents?.().slice(-1) ?? []) event = part;
    if (down.size > 0) mouse(event); else point(event);
    ask();
  });
  canvas.addEventListener('pointerup', event => {
    if (event.pointerType !== 'touch') return mouse(event);
    fingers.end(event);
    if (!studio._claystack_over_pot()) keyboard.tapped();
  });
  canvas.addEventListener('pointercancel', event => {
    if (event.pointerType === 'touch') fingers.end(event);
    for (const b of [...down]) button(b, false, event);
  });
  canvas.addEventListener('wheel', event => {
    studio._claystack_scroll(wheelSteps(event));
    ask();
    event.preventDefault();
  }, {passive: false});
  canvas.addEventListener('contextmenu', event => event.preventDefault());
}

// ---- files -------------------------------------------------------------------------------------

function withText(text, use) {
  const place = studio.stringToNewUTF8(text);
  try { return use(place); } finally { studio._free(place); }
}

function storeIn(name, bytes) {
  const folder = '/opened';
  if (!studio.FS.analyzePath(folder).exists) studio.FS.mkdir(folder);
  const path = folder + '/' + name.replace(/[/\0]/g, '_');
  studio.FS.writeFile(path, bytes);
  return path;
}

/// {name, bytes}; null: the browser cannot read it, for example because it is a folder.
async function contents(file) {
  try {
    return {name: file.name, bytes: new Uint8Array(await file.arrayBuffer())};
  } catch (error) {
    status(`${file.name}: could not be read: ${error.message}`);
    return null;
  }
}

function pickFile(then) {
  const input = document.createElement('input');
  input.type = 'file';
  input.onchange = async () => then(input.files[0] ? await contents(input.files[0]) : null);
  input.oncancel = () => then(null);
  input.click();
}

function open({name, bytes}) {
  if (kMeshes.test(name)) return checkMesh({name, bytes});
  withText(storeIn(name, bytes), path => studio._claystack_open(path));
  ask();
}

function save(name, bytes) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// Functions that the program calls (Module.page).
const page = {
  log(line) {
    const text = document.createElement('p');
    text.textContent = line;
    by('events').append(text);
    while (by('events').childElementCount > 50) by('events').firstChild.remove();
  },
  fail(text) { say(text); },
  /// For people who do not see the picture.
  announce(text) { by('pot').textContent = text; },
  copy(text) { navigator.clipboard?.writeText(text).catch(() => {}); },
  /// Works stay in the storage of the browser too; exports do not.
  download(path) {
    save(path.slice(path.lastIndexOf('/') + 1), studio.FS.readFile(path));
    if (!path.endsWith('.work')) studio.FS.unlink(path);
  },
  pick() {
    pickFile(file => withText(file ? storeIn(file.name, file.bytes) : '', path => {
      studio._claystack_picked(path);
      ask();
    }));
  },
  sendReport(number, data) { mouse3d?.sendReport(number, data).catch(() => {}); },
  post(slot, question) { worker(slot).postMessage({question}, [question.buffer]); },
  stop(slot) {
    workers[slot]?.terminate();
    workers[slot] = null;
  },
};

// ---- workers -----------------------------------------------------------------------------------

const workers = [];  // by slot, see PageWorker; each begins with its first question
function answered(slot, bytes) {
  const place = studio._malloc(bytes.length || 1);
  studio.HEAPU8.set(bytes, place);
  studio._claystack_answered(slot, place, bytes.length);
  studio._free(place);
  ask();
}

/// The module `claystack`, compiled once for all workers: a promise.
let code = null;
function compiled() {
  code ??= (async () => {
    const file = await fetch('claystack.wasm');
    if (!file.ok) throw new Error(`claystack.wasm: the server answers ${file.status}`);
    // A server that names another type of content refuses streaming.
    return WebAssembly.compileStreaming(file.clone()).catch(async () => WebAssembly.compile(await file.arrayBuffer()));
  })();
  code.catch(() => { code = null; });  // the next worker tries again
  return code;
}

function newWorker(take, fail) {
  const made = new Worker('worker.js');
  made.onmessage = ({data}) => { if (data.failure) fail(data.failure); else take(data); };
  made.onerror = event => {
    event.preventDefault();
    fail(event.message);
  };
  compiled().then(code => made.postMessage({code}), error => fail(error.message));
  return made;
}

function worker(slot) {
  workers[slot] ??= newWorker(data => {
    if (data.answer) answered(slot, data.answer);
    else if (data.stage) withText(data.stage, text => studio._claystack_stage(slot, text));
    ask();
  }, failure => {
    page.log('error: worker: ' + failure);
    page.stop(slot);
    answered(slot, new Uint8Array());
  });
  return workers[slot];
}

let checker = null;  // of the report on screen

function stopChecker() {
  checker?.terminate();
  checker = null;
}

function showReport(title, verdict, text) {
  stopChecker();
  by('report-title').textContent = title;
  by('report-verdict').textContent = verdict;
  by('report-text').textContent = text;
  by('report').onclose = stopChecker;
  by('report').showModal();
}

function checkMesh(file) {
  showReport(file.name, 'Checking on this machine; the file is not sent anywhere...', '');
  const done = (verdict, text) => {
    stopChecker();
    by('report-verdict').textContent = verdict;
    by('report-text').textContent = text;
  };
  checker = newWorker(data => done(
    data.status === 0 ? 'Sound: one closed solid without self-intersections'
      : data.status === 1 ? 'Not sound: the report says why' : 'The file could not be read',
    data.out || data.err),
  failure => done('The check stopped: the browser may have too little memory, or lacks a file', failure));
  checker.postMessage({words: ['check', '--json', '--', file.name], files: [file]}, [file.bytes.buffer]);
}

// ---- links -------------------------------------------------------------------------------------

async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function copyLink() {
  const path = '/link.pot.cbor';
  if (!withText(path, place => studio._claystack_write_pot(place)))
    return status('There is no pot on the wheel');
  const packed = await through(new CompressionStream('deflate-raw'), studio.FS.readFile(path));
  studio.FS.unlink(path);
  const characters = Math.ceil(packed.length * 4 / 3);
  if (characters > kMostLinkBytes)
    return status(`The pot takes ${characters} characters; a link holds ${kMostLinkBytes}. Save it instead.`);
  const code = btoa(String.fromCharCode(...packed)).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
  history.replaceState(null, '', '#pot=' + code);
  const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
  status('The address of this page now holds the pot; ' + (copied ? 'it is copied' : 'copy it from the address bar'));
}

async function openLink() {
  if (!location.hash.startsWith('#pot=')) return;
  const code = location.hash.slice('#pot='.length);
  try {
    if (code.length > kMostLinkBytes) throw new Error('too long');
    const packed = Uint8Array.from(atob(code.replace(/-/g, '+').replace(/_/g, '/')), c => c.charCodeAt(0));
    open({name: 'link.pot.cbor', bytes: await through(new DecompressionStream('deflate-raw'), packed)});
  } catch (error) {
    status('The link holds no pot: it was cut off or changed');
  }
}

// ---- storage -----------------------------------------------------------------------------------

/// Shown in the window too.
function warn(text) {
  status(text);
  withText(text, place => studio._claystack_notice(place));
  ask();
}

/// One tab alone stores: another one would replace the works by its own. Where browsers have no locks,
/// which need https or localhost, each tab stores.
let stores = !navigator.locks;
function claimStorage(tries = kClaimTries) {
  navigator.locks?.request('claystack storage', {ifAvailable: true}, lock => {
    if (lock) {
      stores = true;
      return new Promise(() => {});  // as long as the page is open
    }
    if (tries > 1) return setTimeout(claimStorage, kClaimMs, tries - 1);
    warn('Claystack is open in another tab, so this tab stores no works. ' +
      'Save the work as a file (Ctrl+S), or close the other tab and reload this page.');
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

// ---- start -------------------------------------------------------------------------------------

function missing() {
  try {
    // A module with one empty function that has a `try` block.
    const exceptions = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11]);
    if (!WebAssembly.validate(exceptions)) return 'WebAssembly with exceptions';
    // A function that returns the first lane of a vector.
    const vectors = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);
    if (!WebAssembly.validate(vectors)) return 'WebAssembly with vectors (SIMD)';
  } catch { return 'WebAssembly'; }
  if (!document.createElement('canvas').getContext('webgl2')) return 'WebGL 2';
  return null;
}

async function start() {
  const lack = missing();
  if (lack) return say(`This browser does not offer ${lack}. Claystack needs a recent Chromium, Firefox or Safari.`);
  const light = matchMedia('(prefers-color-scheme: light)').matches;
  const coarse = matchMedia('(pointer: coarse)').matches;
  const made = await claystackPage({
    canvas, page, arguments: [light ? 'light' : 'dark', coarse ? 'fingers' : 'mouse'],
    preRun: [module => {
      module.FS.mkdirTree(kHome);
      module.FS.mount(module.IDBFS, {}, kHome);
      module.addRunDependency('storage');
      module.FS.syncfs(true, error => {
        if (error) page.log('error: storage: ' + error);
        module.removeRunDependency('storage');
      });
    }],
    print: line => page.log(line), printErr: line => console.warn(line),
  });
  if (by('message').textContent !== 'Loading...') return;
  studio = made;
  say('');
  listenToPointer();
  listenToKeys();
  listenToGamepads();
  listenToHid();
  new ResizeObserver(resize).observe(canvas);
  window.addEventListener('resize', resize);
  resize();
  document.addEventListener('visibilitychange', () => {
    if (document.hidden) {
      studio._claystack_hide();
      changed = true;
      store();
    }
    ask();
  });
  window.addEventListener('dragover', event => event.preventDefault());
  window.addEventListener('drop', async event => {
    event.preventDefault();
    const {files} = event.dataTransfer;
    if (files.length > 1) return status(`Expected one file, found ${files.length}: drop one file at a time`);
    const file = files.length === 1 ? await contents(files[0]) : null;
    if (file) open(file);
  });
  by('open').onclick = () => pickFile(file => file && open(file));
  by('check').onclick = () => pickFile(file => file && checkMesh(file));
  by('link').onclick = copyLink;
  by('words').onclick = () => showReport('The pot', '', studio.UTF8ToString(studio._claystack_report()));
  canvas.addEventListener('webglcontextlost', event => {
    event.preventDefault();
    changed = true;
    store();
    say('The browser has taken the graphics away. The work is stored: reload the page.');
  });
  by('about').onclick = () => by('about-text').showModal();
  claimStorage();
  setInterval(store, kStoreMs);
  keepOffline();
  canvas.focus();
  openLink();
  window.addEventListener('hashchange', openLink);
  (window.requestIdleCallback ?? setTimeout)(() => compiled().catch(() => {}));  // before the first check
}

start().catch(error => say('Claystack could not start: ' + (error.message ?? error)));
