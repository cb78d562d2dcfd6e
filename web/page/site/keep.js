// Keeps the folder on the device, so that the show plays without a network. A version is kept whole or not at all: its
// files are collected in a cache of their own, and the service worker uses it only after all have arrived and were checked.
import {unpack} from './folder.js';

const base = new URL('./', import.meta.url).href;
const names = `lararium ${base}`;  // The cache that names the current one, and how the names of the others begin.

const digest = async (bytes) => Array.from(new Uint8Array(await crypto.subtle.digest('SHA-256', bytes)),
  (byte) => byte.toString(16).padStart(2, '0')).join('');

const isPiece = (url) => url.startsWith(`${base}show/`) && !url.includes('manifest');

// A file as the server has it now; undefined: without a network, or if it is not there. What the browser has fetched a
// moment ago is not fetched again.
async function fetchFresh(url, cache) {
  const bypass = navigator.serviceWorker.controller !== null && !isPiece(url) ? '?fresh' : '';
  const response = await fetch(url + bypass, {cache}).catch(() => undefined);
  return response?.ok ? response : undefined;
}

const readCurrent = async () => (await caches.match(`${base}current`, {cacheName: names}))?.text();

// The files of a version: {url, sha256, packed}. needed: names of members.
function filesOf({page, members}, needed) {
  return [
    ...page.map(({name, sha256}) => ({url: base + name, sha256, packed: false})),
    ...members.filter(({name}) => needed.includes(name)).map(
      ({sha256, packed}) => ({url: `${base}show/${sha256}`, sha256, packed: packed !== undefined})),
  ];
}

const store = async (cache, url, response) => cache.put(
  url, new Response(await response.blob(), {headers: {'content-type': response.headers.get('content-type') ?? ''}}));

async function isWhole({sha256, packed}, response) {
  try {
    const blob = await response.clone().blob();
    return sha256 === await digest(packed ? await unpack(blob) : await blob.arrayBuffer());
  } catch {  // A damaged file cannot be unpacked.
    return false;
  }
}

// Collects the files. Throws if one is not there or is another one, or if there is no room.
async function collect(files, cache, current) {
  for (const file of files) {
    if (await cache.match(file.url)) {
      continue;
    }
    let response = current && await caches.match(file.url, {cacheName: current});
    // Pieces never change, so the browser's own cache will do unless it holds what was not copied whole.
    for (const cached of isPiece(file.url) ? ['force-cache', 'reload'] : ['no-cache']) {
      response = response && await isWhole(file, response) ? response : await fetchFresh(file.url, cached);
    }
    if (!response || !await isWhole(file, response)) {
      throw new Error(`${file.url} is not the file of this version`);
    }
    await store(cache, file.url, response);
  }
}

// Keeps the version that the server has now, in this language, if it is signed with the folder's key.
async function keepNow(folder, show, language) {
  await navigator.serviceWorker.register(new URL('service_worker.js', base));
  const current = await readCurrent();
  const [manifest, signature] = await Promise.all(
    ['manifest.json', 'manifest.sig'].map((name) => fetchFresh(`${base}show/${name}`, 'no-cache')));
  if (manifest === undefined || signature === undefined) {
    return;
  }
  const text = new Uint8Array(await manifest.clone().arrayBuffer());
  const needed = show.findNeeded(
    {text, signature: new Uint8Array(await signature.clone().arrayBuffer()), key: folder.key}, language);
  const name = `${names} ${await digest(text)}`;
  for (const other of await caches.keys()) {
    if (other.startsWith(`${names} `) && other !== name && other !== current) {
      await caches.delete(other);
    }
  }
  const cache = await caches.open(name);
  try {
    await collect(filesOf(JSON.parse(new TextDecoder().decode(text)), needed), cache, current);
    await store(cache, base, await cache.match(`${base}index.html`));
    await store(cache, `${base}show/manifest.json`, manifest);
    await store(cache, `${base}show/manifest.sig`, signature);
    await (await caches.open(names)).put(`${base}current`, new Response(name));
  } catch (error) {
    if (name !== current) {
      await caches.delete(name);
    }
    throw error;
  }
}

// The show goes on if it cannot be kept; only the console tells why.
export async function keep(folder, show, language = {}) {
  if ('caches' in globalThis && navigator.serviceWorker !== undefined) {
    await keepNow(folder, show, language).catch((error) => console.info(`The show is not kept on this device: ${error.message}`));
  }
}
