// Times of the program as WebAssembly: node tests/web/times.mjs MODULE. MODULE is
// build/web/app/claystack.js. Throws and exports samples in the memory of the module; prints the
// time of a tick, with the reading of the session and the writing of the pot in it, and of an export
// of STL and 3MF with its proof. The least of five runs each.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {resolve} from 'node:path';

const claystack = createRequire(import.meta.url)(resolve(process.argv[2]));
const module = await claystack({print: () => {}, printErr: line => console.error(line)});

function least(...words) {
  let seconds = Infinity;
  for (let i = 0; i < 5; ++i) {
    const begun = performance.now();
    const status = module.callMain([...words]);
    if (status !== 0) throw new Error(`${words.join(' ')}: exit status ${status}`);
    seconds = Math.min(seconds, (performance.now() - begun) / 1000);
  }
  return seconds;
}

for (const sample of ['bowl', 'vase', 'bottle', 'cylinder']) {
  for (const ending of ['.scene.json', '.session'])
    module.FS.writeFile(sample + ending, readFileSync(`samples/${sample}${ending}`));
  const ticks = readFileSync(`samples/${sample}.session`, 'utf8').trimEnd().split('\n').slice(1)
    .reduce((sum, line) => sum + JSON.parse(line).n, 0);
  const thrown = least('throw', '-q', `${sample}.scene.json`, '-o', `${sample}.pot.cbor`);
  const exported = least('export', '-q', `${sample}.pot.cbor`, `${sample}.stl`, `${sample}.3mf`);
  console.log(`${sample.padEnd(9)} ${ticks} ticks of ${(1e6 * thrown / ticks).toFixed(2)} us; ` +
              `exported in ${exported.toFixed(3)} s`);
}
