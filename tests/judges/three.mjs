// three.mjs NODE_MODULES PICTURE FILE...: loads GLB and 3MF files with three.js in Chromium without a
// screen (CHROMIUM names it), prints for each the volume [mm3] and whether it has vertex colours, and
// saves a picture of them side by side.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { createRequire } from 'node:module';

const [modules, picture, ...files] = process.argv.slice(2);
const { chromium } = createRequire(import.meta.url)(path.join(modules, 'playwright-core'));

const page = `<!doctype html><body style="margin:0"><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}
</script><script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const loader = new GLTFLoader()
  .setDRACOLoader(new DRACOLoader().setDecoderPath('/three/examples/jsm/libs/draco/gltf/'))
  .setMeshoptDecoder(MeshoptDecoder);

function measured(scene) {
  let volume = 0, colours = false;
  scene.updateMatrixWorld(true);
  scene.traverse(mesh => {
    if (!mesh.isMesh) return;
    const at = mesh.geometry.attributes.position, index = mesh.geometry.index;
    colours ||= mesh.geometry.attributes.color !== undefined;
    const corner = i => new THREE.Vector3().fromBufferAttribute(at, index ? index.getX(i) : i)
      .applyMatrix4(mesh.matrixWorld);
    for (let i = 0; i < (index ?? at).count; i += 3)
      volume += corner(i).dot(corner(i + 1).cross(corner(i + 2))) / 6;
  });
  return { volume: 1e9 * volume, colours };
}

window.load = async count => {
  const renderer = new THREE.WebGLRenderer({ antialias: true });
  renderer.setSize(300 * count, 300);
  document.body.append(renderer.domElement);
  const all = new THREE.Scene(), results = [];
  all.background = new THREE.Color(0xf4f2ee);
  all.add(new THREE.HemisphereLight(0xffffff, 0x888888, 2), new THREE.DirectionalLight(0xffffff, 2));
  for (let i = 0; i < count; ++i) {
    const { scene } = await loader.loadAsync('/files/' + i);
    results.push(measured(scene));
    const size = new THREE.Box3().setFromObject(scene).getSize(new THREE.Vector3()).length();
    scene.scale.setScalar(1 / size);
    scene.traverse(mesh => mesh.isMesh && mesh.geometry.computeVertexNormals());
    scene.position.set(i - (count - 1) / 2, -0.3, 0);
    all.add(scene);
  }
  const camera = new THREE.OrthographicCamera(-count / 2, count / 2, 0.5, -0.5, 0.1, 10);
  camera.position.set(0, 1.2, 3);
  camera.lookAt(0, 0, 0);
  renderer.render(all, camera);
  return results;
};
window.ready = true;
</script>`;

const server = http.createServer((request, response) => {
  const name = decodeURIComponent(request.url);
  const file = name.startsWith('/files/') ? files[Number(name.slice(7))] : path.join(modules, name);
  if (name === '/') return response.writeHead(200, { 'content-type': 'text/html' }).end(page);
  if (!file || !fs.existsSync(file)) return response.writeHead(404).end();
  const type = file.endsWith('.js') ? 'text/javascript' : file.endsWith('.wasm') ? 'application/wasm'
    : 'application/octet-stream';
  response.writeHead(200, { 'content-type': type }).end(fs.readFileSync(file));
}).listen(0, '127.0.0.1');
await new Promise(done => server.once('listening', done));

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
try {
  const tab = await browser.newPage({ viewport: { width: 300 * files.length, height: 300 } });
  const problems = [];
  tab.on('pageerror', error => problems.push(error.message));
  await tab.goto(`http://127.0.0.1:${server.address().port}/`);
  await tab.waitForFunction(() => window.ready, null, { timeout: 60000 });
  const results = await tab.evaluate(count => window.load(count), files.length);
  await tab.screenshot({ path: picture });
  if (problems.length > 0) throw new Error(problems.join('; '));
  console.log(JSON.stringify(results));
} finally {
  await browser.close();
  server.close();
}
