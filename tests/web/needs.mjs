// What the tests of programs for browsers share.
import {createReadStream, existsSync} from 'node:fs';
import {createServer} from 'node:http';
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

// Serves files without special headers until close(). fileOf(path): the file, or undefined.
export async function serve(fileOf) {
  const server = createServer((request, response) => {
    const file = fileOf(request.url);
    if (file === undefined || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, {'content-type': TYPES[extname(file)] ?? 'application/octet-stream'});
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return {
    origin: `http://127.0.0.1:${server.address().port}`,
    close() {
      server.closeAllConnections();
      server.close();
    },
  };
}
