// The program claystack as WebAssembly, in the present folder: node tests/web/claystack.mjs MODULE
// ARGUMENTS. MODULE is build/web/app/claystack.js.
import {createRequire} from 'node:module';
import {resolve} from 'node:path';

const [module, ...words] = process.argv.slice(2);
const claystack = createRequire(import.meta.url)(resolve(module));
const made = await claystack({
  preRun: [m => {
    m.FS.mkdir('/folder');
    m.FS.mount(m.NODEFS, {root: process.cwd()}, '/folder');
    m.FS.chdir('/folder');
  }],
  print: line => process.stdout.write(line + '\n'),
  printErr: line => process.stderr.write(line + '\n'),
});
process.exitCode = made.callMain(words);
