// A worker with its own copy of the module `claystack`. Messages:
//   {code: the compiled module, version}   comes once, before or after the first question
//   {question: bytes}                      -> {stage: text} ..., {answer: bytes, files: [{name, bytes}]}
//   {words: [...], files: [{name, bytes}]} -> {status, out, err}: one command of the program
// {failure: text}: it cannot answer, for example because the browser has too little memory.
'use strict';
importScripts('claystack.js?@VERSION@');

const kVersion = '@VERSION@';  // of the page: app/web/site.cmake

let out = '', err = '', provide;
const made = new Promise(done => { provide = done; }).then(code => new Promise((done, fail) => {
  claystack({
    print: line => { out += line + '\n'; },
    printErr: line => { err += line + '\n'; },
    onStage: stage => postMessage({stage}),
    instantiateWasm(imports, use) {
      WebAssembly.instantiate(code, imports).then(instance => use(instance, code)).catch(fail);
      return {};
    },
  }).then(done, fail);
}));

/// The files of an export, taken out of the module.
function exported(module) {
  const folder = '/exported';
  if (!module.FS.analyzePath(folder).exists) return [];
  const names = module.FS.readdir(folder).filter(name => name !== '.' && name !== '..');
  return names.map(name => {
    const bytes = module.FS.readFile(`${folder}/${name}`);
    module.FS.unlink(`${folder}/${name}`);
    return {name, bytes};
  });
}

function answer(module, question) {
  const place = module._malloc(question.length);
  if (!place) throw new Error('the browser has too little memory');
  module.HEAPU8.set(question, place);
  const begin = module._claystack_answer(place, question.length);
  module._free(place);
  const bytes = module.HEAPU8.slice(begin, begin + module._claystack_answer_bytes());
  const files = exported(module);
  postMessage({answer: bytes, files}, [bytes.buffer, ...files.map(file => file.bytes.buffer)]);
}

function command(module, {words, files}) {
  out = err = '';
  module.FS.mkdirTree('/files');  // of any name
  module.FS.chdir('/files');
  for (const {name, bytes} of files) module.FS.writeFile(name, bytes);
  const status = module.callMain(words);
  for (const {name} of files) module.FS.unlink(name);
  postMessage({status, out, err});
}

onmessage = async ({data}) => {
  if (data.code && data.version === kVersion) return provide(data.code);
  if (data.code) return postMessage({failure: 'the server has another version of this page now: reload it'});
  try {
    const module = await made;
    if (data.question) answer(module, data.question);
    else command(module, data);
  } catch (error) {
    postMessage({failure: error instanceof WebAssembly.Exception ? 'the browser may have too little memory'
      : String(error?.message ?? error)});
  }
};
