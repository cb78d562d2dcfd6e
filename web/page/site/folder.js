// The show as a folder of files: a signed manifest, and each member as a file of its own that is named by its hash.
import {Problem} from './camera.js';

const AT_ONCE = 6;  // Files that are fetched at the same time.

const absent = () => new Problem('no_show');
const altered = (error) => Object.assign(new Problem('altered'), {cause: error});

// The bytes of a file. onbytes(count) is called as they arrive.
async function fetchBytes(url, onbytes = () => {}, cache = 'default') {
  try {
    const response = await fetch(new URL(url, import.meta.url), {cache});
    if (!response.ok) {
      throw absent();
    }
    const parts = [];
    for (const reader = response.body.getReader(); ;) {
      const {done, value} = await reader.read();
      if (done) {
        return new Blob(parts);
      }
      parts.push(value);
      onbytes(value.length);
    }
  } catch {
    throw absent();
  }
}

export async function unpack(blob) {
  return new Uint8Array(await new Response(blob.stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
}

// Compiles a program, which folders hold compressed and the build does not.
async function compileProgram(url) {
  const blob = await fetchBytes(url);
  const [first, second] = new Uint8Array(await blob.slice(0, 2).arrayBuffer());
  return WebAssembly.compile(first === 0x1f && second === 0x8b ? await unpack(blob) : await blob.arrayBuffer());
}

// Compiles the show's program and the tracker's.
export const compilePrograms = () => Promise.all(['module.wasm', 'lararium-tracker/module.wasm'].map((url) => compileProgram(url)));

export class Folder {
  // What the show is, is known at once; openShow() verifies it.
  static async open() {
    const folder = new Folder();
    const unsigned = () => new Blob();  // The program refuses it.
    [folder.text, folder.signature, folder.key] = await Promise.all((await Promise.all(
      [fetchBytes('show/manifest.json'), fetchBytes('show/manifest.sig').catch(unsigned), fetchBytes('museum.pub').catch(unsigned)]))
      .map(async (blob) => new Uint8Array(await blob.arrayBuffer())));
    try {
      const {title, spoken, captions, descriptions = [], sounds = [], members, fleet} = JSON.parse(new TextDecoder().decode(folder.text));
      folder.about = {title, spoken: spoken.map(({name}) => name), captions, descriptions: descriptions.length > 0,
        sounds: sounds.length + spoken.length > 0, fleet};
      folder.members = new Map(members.map((member) => [member.name, member]));
    } catch (error) {
      throw altered(error);
    }
    return folder;
  }

  missing(show, stage, languages) {
    return show.findMissing(stage, languages).map((name) => this.members.get(name));
  }

  // The bytes that supply() would fetch.
  bytesOf(show, stage, languages) {
    return this.missing(show, stage, languages).reduce((sum, {packed, size}) => sum + (packed ?? size), 0);
  }

  // Gives the show what a stage needs in these languages and lacks. onbytes(count) is called as bytes arrive. Returns whether
  // the show lacked anything.
  async supply(show, stage, languages, onbytes = () => {}) {
    const members = this.missing(show, stage, languages);
    const lacking = members.length > 0;
    const add = async ({name, sha256, packed}, ...options) => {
      const blob = await fetchBytes(`show/${sha256}`, ...options);
      try {
        show.addPiece(name, packed === undefined ? new Uint8Array(await blob.arrayBuffer()) : await unpack(blob));
      } catch (error) {
        throw altered(error);
      }
    };
    const work = async () => {
      for (let member; (member = members.shift()) !== undefined;) {
        // The browser's cache may hold what was not copied whole.
        await add(member, onbytes).catch(() => add(member, undefined, 'reload'));
      }
    };
    try {
      await Promise.all(Array.from({length: AT_ONCE}, work));
    } catch (error) {
      members.length = 0;  // The others stop.
      throw error;
    }
    return lacking;
  }

  // Verifies the manifest.
  async openShow(Show, program) {
    try {
      return await Show.open(this, program);
    } catch (error) {
      throw altered(error);
    }
  }
}
