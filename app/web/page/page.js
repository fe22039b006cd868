// The page around the module: frames, files, links, start.
'use strict';

const kIdleMs = 500;       // interval of frames without input
const kMostLinkBytes = 8192;
const kZipEnd = 70000;     // bytes; its comment takes up to 65535
const kMeshes = /\.(stl|obj|ply|off|glb|drc|3mf|step|stp)$/i;

const kVersion = '@VERSION@';  // of the page: app/web/site.cmake

const by = id => document.getElementById(id);
const canvas = by('canvas');
let studio = null;
let controls = null;  // of the window, for screen readers

function say(text) { by('message').textContent = text; }
function status(text) { by('status').textContent = text; }

// ---- frames ------------------------------------------------------------------------------------

let asked = false, idle = 0, halted = false;
function ask() {
  if (asked || halted || !studio || document.hidden) return;
  asked = true;
  clearTimeout(idle);
  requestAnimationFrame(now => {
    asked = false;
    frame(now);
    keyboard.follow();
  });
}

function frame(now) {
  if (halted) return;
  let more = false;
  try {
    if (window.devicePixelRatio !== ratio) resize();  // on another screen; few browsers report it
    more = studio._claystack_frame(now);
  } catch (error) {
    return halt(error);
  }
  changed = true;
  markLink();
  if (more) ask();
  else idle = setTimeout(ask, kIdleMs);
}

/// A fault of the program. The work is stored, and no frame follows.
function halt(error) {
  if (halted) return;
  halted = true;
  changed = true;
  store();
  const why = error instanceof WebAssembly.Exception ? 'the browser may have too little memory'
    : error?.message ?? error;
  say(`Claystack has stopped: ${why}. Reload the page` +
    (kept() ? ': it offers the work again.' : '. The work was not stored.'));
}

/// Faults of the program outside of a frame: in an event, or in an answer of a worker.
function isFault(error) {
  return error instanceof WebAssembly.Exception || error instanceof WebAssembly.RuntimeError;
}

/// A place for this number of bytes in the memory of the program.
function room(bytes) {
  const place = studio._malloc(bytes || 1);
  if (!place) throw new WebAssembly.RuntimeError('the browser has too little memory');
  return place;
}

let ratio = 0;  // of the canvas: pixels of the screen per px of the page
function resize() {
  ratio = window.devicePixelRatio;
  const box = canvas.getBoundingClientRect();
  canvas.width = Math.max(1, Math.round(box.width * ratio));
  canvas.height = Math.max(1, Math.round(box.height * ratio));
  studio._claystack_resize(canvas.width, canvas.height, ratio);
  ask();
}

// ---- files -------------------------------------------------------------------------------------

function withText(text, use) {
  const place = studio.stringToNewUTF8(text);
  if (!place) throw new WebAssembly.RuntimeError('the browser has too little memory');
  try { return use(place); } finally { studio._free(place); }
}

/// In the current folder of the program, see prepareFiles.
function storeIn(name, bytes) {
  const path = name.replace(/[/\0]/g, '_');
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
  if (navigator.userActivation?.isActive === false) {  // the browser would ignore it, without an event
    status('The browser opens its file picker only after a click or key: try again');
    return then(null);
  }
  const input = document.createElement('input');
  input.type = 'file';
  input.onchange = async () => then(input.files[0] ? await contents(input.files[0]) : null);
  input.oncancel = () => then(null);
  input.click();
}

/// A 3MF by Claystack has its pot in it. The directory at the end of a ZIP file names the parts.
function holdsPot(name, bytes) {
  return /\.3mf$/i.test(name) &&
    new TextDecoder('latin1').decode(bytes.subarray(-kZipEnd)).includes('Metadata/claystack.pot.cbor');
}

function open({name, bytes}) {
  if (kMeshes.test(name) && !holdsPot(name, bytes)) return checkMesh({name, bytes});
  withText(storeIn(name, bytes), path => studio._claystack_open(path));
  ask();
}

function baseName(path) { return path.slice(path.lastIndexOf('/') + 1); }

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
  /// Whether this tab stores the works, so that it offers the works of a crash.
  stores() { return stores; },
  /// For people who do not see the picture.
  announce(text) { by('pot').textContent = text; },
  showControls(json) { controls?.show(JSON.parse(json)); },
  copy(text) { navigator.clipboard?.writeText(text).catch(() => {}); },
  /// Whether the worker has sent this file of an export.
  has(path) { return exported.has(baseName(path)); },
  /// Works stay in the storage of the browser too; exports and saved pots do not.
  download(path) {
    const name = baseName(path), sent = exported.get(name);
    save(name, sent ?? studio.FS.readFile(path));
    if (sent) exported.delete(name);
    else if (!/\.work$/i.test(path)) studio.FS.unlink(path);
    else keepStorage();
  },
  setTheme(name) { document.documentElement.dataset.theme = name; },
  pick() {
    pickFile(file => withText(file ? storeIn(file.name, file.bytes) : '', path => {
      studio._claystack_picked(path);
      ask();
    }));
  },
  sendReport(number, data) { mouse3d?.sendReport(number, data).catch(() => {}); },
  post(slot, question) { worker(slot).post({question}, [question.buffer]); },
  stop: stopWorker,
};

// ---- links -------------------------------------------------------------------------------------

/// Of an entry of the browser's history whose pot is an unsaved work of this tab: after a reload the
/// program offers that work, with the strokes since then. Without strokes the link opens again.
const kOpened = {opened: true};

/// After each frame. The title of an unsaved work begins with a star.
function markLink() {
  const unsaved = document.title.startsWith('*');
  if (location.hash.startsWith('#pot=') && Boolean(history.state?.opened) !== unsaved)
    history.replaceState(unsaved ? kOpened : null, '');
}

async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function copyLink() {
  if (!window.CompressionStream) return status('This browser cannot make links: save the pot as a file');
  const path = '/link.pot.cbor';
  if (!withText(path, place => studio._claystack_write_pot(place)))
    return status('There is no pot on the wheel');
  const pot = studio.FS.readFile(path);
  studio.FS.unlink(path);
  const packed = await through(new CompressionStream('deflate-raw'), pot);
  const characters = Math.ceil(packed.length * 4 / 3);
  if (characters > kMostLinkBytes)
    return status(`The pot takes ${characters} characters; a link holds ${kMostLinkBytes}. Save it instead.`);
  const code = btoa(String.fromCharCode(...packed)).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
  history.replaceState(null, '', '#pot=' + code);
  markLink();
  const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
  status('The address of this page now holds the pot; ' + (copied ? 'it is copied' : 'copy it from the address bar'));
}

async function openLink() {
  if (!location.hash.startsWith('#pot=')) return;
  const code = location.hash.slice('#pot='.length);
  if (!window.DecompressionStream) return status('This browser cannot read links; a recent one can');
  try {
    if (code.length > kMostLinkBytes) throw new Error('too long');
    const packed = Uint8Array.from(atob(code.replace(/-/g, '+').replace(/_/g, '/')), c => c.charCodeAt(0));
    open({name: 'link.pot.cbor', bytes: await through(new DecompressionStream('deflate-raw'), packed)});
    const works = studio._claystack_recoverable();
    if (works > 0) status(`Unsaved works from before: ${works}. File > New offers them.`);
  } catch (error) {
    status('The link holds no pot: it was cut off or changed');
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

/// A stroke under way ends, and is stored.
function hide() {
  if (halted) return;
  studio._claystack_hide();
  changed = true;
  store();
}

async function start() {
  const lack = missing();
  if (lack) return say(`This browser does not offer ${lack}. Claystack needs a recent Chromium, Firefox or Safari.`);
  const claimed = claimStorage();
  const light = matchMedia('(prefers-color-scheme: light)');
  const coarse = matchMedia('(pointer: coarse)').matches;
  const made = await claystackPage({
    canvas, page, arguments: [light.matches ? 'light' : 'dark', coarse ? 'fingers' : 'mouse'],
    preRun: [module => prepareFiles(module, claimed)],
    print: line => page.log(line), printErr: line => console.warn(line),
  });
  if (by('message').textContent !== 'Loading...') return;
  studio = made;
  say('');
  listenToPointer();
  listenToKeys();
  controls = new WindowControls(canvas, id => {
    studio._claystack_press(id);
    ask();
  }, text => { by('opened').textContent = text; });
  listenToGamepads();
  listenToHid();
  new ResizeObserver(resize).observe(canvas);
  window.addEventListener('resize', resize);
  resize();
  light.onchange = () => {
    studio._claystack_prefers(light.matches);
    ask();
  };
  document.addEventListener('visibilitychange', () => {
    if (document.hidden) hide();
    ask();
  });
  window.addEventListener('pagehide', hide);
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
    say('The browser has closed the graphics context. ' + (kept() ? 'The work is stored: reload the page.'
      : 'The work is not stored: press Ctrl+S and Enter, which saves it as a file. Then reload the page.'));
  });
  by('about').onclick = () => by('about-text').showModal();
  listenToStorage();
  keepOffline();
  canvas.focus();
  if (!kept() || !history.state?.opened) openLink();
  window.addEventListener('hashchange', openLink);
  (window.requestIdleCallback ?? setTimeout)(() => compiled().catch(() => {}));  // before the first check
}

/// Browsers report a file that failed to load only in their list of requests.
function notStarted(error) {
  const [lost] = performance.getEntriesByType('resource').filter(file => file.responseStatus >= 400);
  const why = lost ? `${lost.name.split('/').pop()}: the server answers ${lost.responseStatus}` : error?.message ?? error;
  say('Claystack could not start: ' + why);
}

window.addEventListener('error', event => { if (studio && isFault(event.error)) halt(event.error); });
window.addEventListener('unhandledrejection', event => {
  if (!studio) notStarted(event.reason);
  else if (isFault(event.reason)) halt(event.reason);
});
start().catch(notStarted);
