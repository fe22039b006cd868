// The time of a tick, in any program that throws. In contact: the time to throw a session on its
// lump, less the time to play it where there is no clay to touch, by the number of ticks in contact
// (the reading of the session is in both). On average: the time to throw it, the reading of the
// session included, by the number of all ticks.
import {readFileSync} from 'node:fs';

/// {name, scene, empty, session, ticks}: the samples with the rules of clay, and without them.
export function samplesOf(folder) {
  return [['', 'rules'], ['paper/', 'no rules']].flatMap(([sub, title]) =>
    ['bowl', 'vase', 'bottle', 'cylinder'].map(name => {
      const scene = readFileSync(`${folder}/${sub}${name}.scene.json`, 'utf8');
      const empty = JSON.parse(scene);
      Object.assign(empty.lump, {rings: 1, outer_radius_mm: 0.1});
      delete empty.clay;
      const session = readFileSync(`${folder}/${sub}${name}.session`, 'utf8');
      return {name: `${name}, ${title}`, scene, empty: JSON.stringify(empty), session};
    }));
}

/// `thrown(scene)`: throws the session of the sample on that scene, text both, and returns
/// {seconds, contacts, ticks}. The least of `runs` each: {contact, average} [us].
export async function tickUs(sample, thrown, runs = 5) {
  let full = {seconds: Infinity}, empty = Infinity;
  for (let i = 0; i < runs; ++i) {
    const withClay = await thrown(sample.scene);
    if (withClay.seconds < full.seconds) full = withClay;
    empty = Math.min(empty, (await thrown(sample.empty)).seconds);
  }
  return {contact: 1e6 * (full.seconds - empty) / full.contacts, average: 1e6 * full.seconds / full.ticks};
}
