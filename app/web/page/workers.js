// Workers: the jobs of the window, and the check of a mesh with its report.
'use strict';

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
    fail(event.message || 'worker.js could not be loaded');
  };
  compiled().then(code => made.postMessage({code}), error => fail(error.message));
  return made;
}

function stopWorker(slot) {
  workers[slot]?.terminate();
  workers[slot] = null;
}

function worker(slot) {
  workers[slot] ??= newWorker(data => {
    if (data.answer) answered(slot, data.answer);
    else if (data.stage) withText(data.stage, text => studio._claystack_stage(slot, text));
    ask();
  }, failure => {
    page.log('error: worker: ' + failure);
    stopWorker(slot);
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
