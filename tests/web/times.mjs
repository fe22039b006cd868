// Times of the program as WebAssembly beside those of the native program, in one run:
// node tests/web/times.mjs MODULE [NATIVE]. MODULE is build/web/app/claystack.js. Prints the time of a
// tick on average and in contact (ticks.mjs), and of an export of STL and 3MF with its proof. The least of five runs
// each. Times are those of the processor, so other work on the computer matters little.
import {spawnSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {samplesOf, tickUs} from './ticks.mjs';

const [module, native = resolve('build/release/app/claystack')] = process.argv.slice(2).map(path => resolve(path));
const claystack = createRequire(import.meta.url)(module);
let out = '', err = '';
const page = await claystack({print: line => { out += line; }, printErr: line => { err += line + '\n'; }});
const folder = mkdtempSync(join(tmpdir(), 'claystack-times-'));

const kThrow = ['throw', '-q', '--json', 'it.scene.json', '-s', 'it.session', '-o', 'it.pot.cbor'];
const kTimed = 'TIMEFORMAT="%U %S"; time "$@" 2>errors.txt';
/// write(name, text), and run(words): {seconds, text}, the output.
const programs = {
  WebAssembly: {
    write: (name, text) => page.FS.writeFile(name, text),
    run(words) {
      out = err = '';
      const begun = process.cpuUsage();
      if (page.callMain([...words]) !== 0) throw new Error(words.join(' ') + ': ' + err);
      const {user, system} = process.cpuUsage(begun);
      return {seconds: 1e-6 * (user + system), text: out};
    },
  },
  native: {
    write: (name, text) => writeFileSync(join(folder, name), text),
    run(words) {
      const ran = spawnSync('bash', ['-c', kTimed, 'bash', native, ...words], {cwd: folder, encoding: 'utf8'});
      if (ran.status !== 0) throw new Error(words.join(' '));
      const [user, system] = ran.stderr.trim().split(' ').map(Number);
      return {seconds: user + system, text: ran.stdout};
    },
  },
};

function thrownBy(program, sample) {
  return scene => {
    program.write('it.scene.json', scene);
    program.write('it.session', sample.session);
    const {seconds, text} = program.run(kThrow);
    const {contact_ticks: contacts, ticks} = JSON.parse(text);
    return {seconds, contacts, ticks};
  };
}

function exported(program) {
  let seconds = Infinity;
  for (let i = 0; i < 5; ++i)
    seconds = Math.min(seconds, program.run(['export', '-q', 'it.pot.cbor', 'it.stl', 'it.3mf']).seconds);
  return seconds;
}

for (const sample of samplesOf('samples')) {
  const line = [sample.name.padEnd(18)];
  for (const [name, program] of Object.entries(programs)) {
    const {average, contact} = await tickUs(sample, thrownBy(program, sample));
    thrownBy(program, sample)(sample.scene);
    line.push(`${name}: tick ${average.toFixed(2)} us, ` +
              `in contact ${contact.toFixed(2).padStart(5)} us, export ${exported(program).toFixed(3)} s`);
  }
  console.log(line.join('   '));
}
rmSync(folder, {recursive: true});
