// Answers from the files that keep.js has kept, and otherwise from the network. `?fresh` asks the network in any case.
// In the cache `lararium SCOPE`, the file `current` names the cache of the version that is whole.
self.addEventListener('install', () => self.skipWaiting());

async function answer(request) {
  const url = new URL(request.url);
  if (url.search === '?fresh') {
    return fetch(request);
  }
  const {scope} = registration;
  const current = await (await caches.match(`${scope}current`, {cacheName: `lararium ${scope}`}))?.text();
  const kept = current === undefined ? undefined : await caches.match(request, {cacheName: current});
  // Pieces are named by their content, so those of another version are as good.
  return kept ?? (url.pathname.includes('/show/') ? await caches.match(request) : undefined) ?? fetch(request);
}

self.addEventListener('fetch', (event) => {
  if (event.request.method === 'GET' && event.request.url.startsWith(registration.scope)) {
    event.respondWith(answer(event.request));
  }
});
