// A worker with its own copy of the module `claystack`. Messages:
//   {code: the compiled module}            comes once, before or after the first question
//   {question: bytes}                      -> {stage: text} ..., {answer: bytes}
//   {words: [...], files: [{name, bytes}]} -> {status, out, err}: one command of the program
// {failure: text}: it cannot answer, for example because the browser has too little memory.
'use strict';
importScripts('claystack.js');

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

function answer(module, question) {
  const place = module._malloc(question.length);
  module.HEAPU8.set(question, place);
  const begin = module._claystack_answer(place, question.length);
  module._free(place);
  const bytes = module.HEAPU8.slice(begin, begin + module._claystack_answer_bytes());
  postMessage({answer: bytes}, [bytes.buffer]);
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
  if (data.code) return provide(data.code);
  try {
    const module = await made;
    if (data.question) answer(module, data.question);
    else command(module, data);
  } catch (error) {
    postMessage({failure: String(error?.message ?? error)});
  }
};
