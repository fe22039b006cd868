// Prints the status that manifold-3d gives a binary STL: NoError, or the reason.
//
//   node manifold_status.mjs FOLDER_OF_MANIFOLD_3D FILE.stl
//
// Vertices at the same place are merged, as in every reader of STL.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { join } from "node:path";

const [folder, file] = process.argv.slice(2);
const { default: Module } = await import(pathToFileURL(join(folder, "manifold.js")));
const wasm = await Module();
wasm.setup();

const bytes = readFileSync(file);
const count = bytes.readUInt32LE(80);
const points = [], numbers = new Map(), triVerts = new Uint32Array(3 * count);
for (let k = 0; k < 3 * count; ++k) {
  const at = 84 + 50 * Math.floor(k / 3) + 12 + 12 * (k % 3);
  const place = [0, 4, 8].map((i) => bytes.readFloatLE(at + i) + 0);
  const key = place.join(" ");
  if (!numbers.has(key)) {
    numbers.set(key, numbers.size);
    points.push(...place);
  }
  triVerts[k] = numbers.get(key);
}
const mesh = new wasm.Mesh({ numProp: 3, vertProperties: new Float32Array(points), triVerts });
try {
  console.log(new wasm.Manifold(mesh).status());
} catch (error) {
  console.log(error.code ?? error.message);
}
