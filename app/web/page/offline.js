// Service worker: keeps the files of the page, so that it also starts without its server. A new
// version of the page is installed beside the old one and serves once no page is open: the files of
// two versions never mix.
'use strict';

const kPage = `claystack ${registration.scope} `;  // another folder of this server has its own page
const kCache = kPage + '@VERSION@';  // of all files: app/web/site.cmake
const kFiles = '@FILES@'.split(' ');

async function install() {
  const cache = await caches.open(kCache);
  await cache.addAll(kFiles.map(file => new Request(file, {cache: 'no-cache'})));
}

async function activate() {
  for (const name of await caches.keys())
    if (name.startsWith(kPage) && name !== kCache) await caches.delete(name);
  await self.clients.claim();
}

async function answer(request) {
  const cache = await caches.open(kCache);
  const path = new URL(request.url).pathname.replace(/\/index\.html$/, '/');
  return await cache.match(path) ?? fetch(request);
}

self.addEventListener('install', event => event.waitUntil(install()));
self.addEventListener('activate', event => event.waitUntil(activate()));
self.addEventListener('fetch', event => {
  if (event.request.method === 'GET' && new URL(event.request.url).origin === location.origin)
    event.respondWith(answer(event.request));
});
