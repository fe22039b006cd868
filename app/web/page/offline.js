// Service worker: keeps the files of the page, so that it also starts without its server. A new
// version of the page is installed beside the old one, completely or not at all, and is used once
// no page of the old one is open: the files of two versions never mix.
'use strict';

const kPage = `claystack ${registration.scope} `;  // another folder of this server has its own page
const kCache = kPage + '@VERSION@';  // of all files: app/web/site.cmake
const kFiles = '@FILES@'.split(' ').map(file => file.split('='));  // names and their SHA-256

/// While a new version is copied to the server, the server may return files of both versions.
async function verified(name, hash) {
  const answer = await fetch(new Request(name, {cache: 'no-cache'}));
  const found = await crypto.subtle.digest('SHA-256', await answer.clone().arrayBuffer());
  const code = [...new Uint8Array(found)].map(byte => byte.toString(16).padStart(2, '0')).join('');
  if (!answer.ok || code !== hash) throw new Error(`${name}: expected the file of this version`);
  return answer;
}

async function install() {
  const cache = await caches.open(kCache);
  try {
    for (const [name, hash] of kFiles) await cache.put(name, await verified(name, hash));
  } catch (error) {
    await caches.delete(kCache);
    throw error;
  }
}

async function activate() {
  for (const name of await caches.keys())
    if (name.startsWith(kPage) && name !== kCache) await caches.delete(name);
  // A page that loaded files of another version from the server continues to load them from there.
  if (location.search === '?@VERSION@') await self.clients.claim();
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
