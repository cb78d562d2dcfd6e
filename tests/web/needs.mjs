// What the tests of programs for browsers share.
import {execFileSync} from 'node:child_process';
import {createReadStream, existsSync, rmSync} from 'node:fs';
import {createServer} from 'node:http';
import {connect, createServer as createNetServer} from 'node:net';
import {extname} from 'node:path';

// Ends the test as skipped (status 77) if a file is absent. needed: [file, how to get it].
export function skipWithout(...needed) {
  for (const [file, remedy] of needed) {
    if (!existsSync(file)) {
      console.log(`skipped: ${file} is absent; ${remedy}`);
      process.exit(77);
    }
  }
}

const TYPES = {'.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm'};

// Writes a project's folder for browsers, signed with a new key, and returns what the program says of it.
export function exportFolder(editor, project, page, folder, ...options) {
  const key = `${folder}-museum`;
  [folder, `${key}.key`, `${key}.pub`].forEach((old) => rmSync(old, {recursive: true, force: true}));
  execFileSync(editor, ['key', key], {stdio: 'ignore'});
  return updateFolder(editor, project, page, folder, key, ...options);
}

// Writes it again, signed with the key of `folder`, or of another one.
export function updateFolder(editor, project, page, folder, key = `${folder}-museum`, ...options) {
  return JSON.parse(execFileSync(
    editor, ['export', project, '--web', folder, '--page', page, '--sign', `${key}.key`, '--json', ...options], {encoding: 'utf8'}));
}

export const freePort = () => new Promise((resolve) => {
  const server = createNetServer().listen(0, '127.0.0.1', () => {
    const {port} = server.address();
    server.close(() => resolve(port));
  });
});

export const sleep = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

// Waits until a port is open.
export async function opened(port) {
  const tried = () => new Promise((resolve) => {
    const socket = connect(port, '127.0.0.1', () => resolve(true)).on('error', () => resolve(false));
    socket.on('connect', () => socket.destroy());
  });
  for (let i = 0; i < 300 && !await tried(); ++i) {
    await sleep(0.1);
  }
}

// The file of a folder that a path names.
export const fileIn = (folder, path) => path.includes('..') ? undefined : `${folder}${path === '/' ? '/index.html' : path}`;

// Serves files without special headers until close(). fileOf(path): the file or its bytes, or undefined, or a promise.
export async function serve(fileOf, port = 0) {
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname;
    const file = await fileOf(path);
    if (file === undefined || (typeof file === 'string' && !existsSync(file))) {
      response.writeHead(404).end();
      return;
    }
    const type = TYPES[extname(typeof file === 'string' ? file : path.replace(/\/$/, '/index.html'))] ?? 'application/octet-stream';
    response.writeHead(200, {'content-type': type});
    if (typeof file === 'string') {
      createReadStream(file).pipe(response);
    } else {
      response.end(file);
    }
  });
  await new Promise((resolve) => server.listen(port, '127.0.0.1', resolve));
  return {
    port: server.address().port,
    origin: `http://127.0.0.1:${server.address().port}`,
    close() {
      server.closeAllConnections();
      server.close();
    },
  };
}
