// A static file server for tests, as `python3 -m http.server`.
import {createServer} from 'node:http';
import {readFile} from 'node:fs/promises';
import {extname, join, normalize} from 'node:path';

const kTypes = {'.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css',
  '.wasm': 'application/wasm', '.txt': 'text/plain'};

/// Returns {address, close}. It answers 404 for paths in `missing`.
export async function serve(folder, missing = new Set()) {
  const server = createServer(async (request, reply) => {
    const path = normalize(new URL(request.url, 'http://localhost').pathname);
    const file = join(folder, path.endsWith('/') ? path + 'index.html' : path);
    try {
      if (missing.has(path)) throw new Error('missing');
      const bytes = await readFile(file);
      reply.writeHead(200, {'content-type': kTypes[extname(file)] ?? 'application/octet-stream'});
      reply.end(bytes);
    } catch {
      reply.writeHead(404).end();
    }
  });
  await new Promise(ready => server.listen(0, 'localhost', ready));
  return {address: `http://localhost:${server.address().port}/`, close: () => { server.close(); server.closeAllConnections(); }};
}
