// Workers: the jobs of the window, and the check of a mesh with its report.
'use strict';

/// Files of the last export by their names, until they are offered as downloads: they do not pass
/// through the memory of the window, which would stop its picture.
const exported = new Map();

const workers = [];  // by slot, see PageWorker; each begins with its first question
function answered(slot, bytes, files) {
  if (files.length > 0) exported.clear();
  for (const {name, bytes} of files) exported.set(name, bytes);
  const place = room(bytes.length);
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

/// It may be stopped: a late message of it is then no answer to a later question.
class PageWorker {
  constructor(take, fail) {
    const unlessStopped = use => (...all) => { if (this.worker) use(...all); };
    this.worker = new Worker('worker.js?' + kVersion);
    this.worker.onmessage = unlessStopped(({data}) => { if (data.failure) fail(data.failure); else take(data); });
    this.worker.onerror = event => {
      event.preventDefault();
      unlessStopped(fail)(event.message || 'worker.js could not be loaded');
    };
    compiled().then(unlessStopped(code => this.post({code, version: kVersion})),
      unlessStopped(error => fail(error.message)));
  }
  post(message, parts = []) { this.worker.postMessage(message, parts); }
  stop() {
    this.worker?.terminate();
    this.worker = null;
  }
}

function stopWorker(slot) {
  workers[slot]?.stop();
  workers[slot] = null;
}

function worker(slot) {
  workers[slot] ??= new PageWorker(data => {
    if (data.answer) answered(slot, data.answer, data.files);
    else if (data.stage) withText(data.stage, text => studio._claystack_stage(slot, text));
    ask();
  }, failure => {
    page.log('error: worker: ' + failure);
    status('A job of the page failed: ' + failure);
    stopWorker(slot);
    answered(slot, new Uint8Array(), []);
  });
  return workers[slot];
}

let checker = null;  // of the report on screen

function stopChecker() {
  checker?.stop();
  checker = null;
}

function showReport(title, verdict, text) {
  stopChecker();
  by('report-title').textContent = title;
  by('report-verdict').textContent = verdict;
  by('report-text').textContent = text;
  by('report').onclose = stopChecker;
  if (!by('report').open) by('report').showModal();
}

function checkMesh(file) {
  showReport(file.name, 'Checking on this machine; the file is not sent anywhere...', '');
  const done = (verdict, text) => {
    stopChecker();
    by('report-verdict').textContent = verdict;
    by('report-text').textContent = text;
  };
  checker = new PageWorker(data => done(
    data.status === 0 ? 'Sound: one closed solid without self-intersections'
      : data.status === 1 ? 'Not sound: the report lists the faults' : 'The file could not be read',
    data.out || data.err),
  failure => done('The check stopped: the browser may have too little memory, or lacks a file', failure));
  checker.post({words: ['check', '--json', '--', file.name], files: [file]}, [file.bytes.buffer]);
}
