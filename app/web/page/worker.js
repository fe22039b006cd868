// A worker with its own copy of the module `claystack`. Messages:
//   {question: bytes}                  -> {stage: text} ..., {answer: bytes}
//   {words: [...], files: [{name, bytes}]} -> {status, out, err}: one command of the program
'use strict';
importScripts('claystack.js');

const made = claystack({
  print: line => { out += line + '\n'; },
  printErr: line => { err += line + '\n'; },
  onStage: stage => postMessage({stage}),
});
let out = '', err = '';

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
  for (const {name, bytes} of files) module.FS.writeFile('/' + name, bytes);
  module.FS.chdir('/');
  const status = module.callMain(words);
  for (const {name} of files) module.FS.unlink('/' + name);
  postMessage({status, out, err});
}

onmessage = async ({data}) => {
  const module = await made;
  if (data.question) answer(module, data.question);
  else command(module, data);
};
