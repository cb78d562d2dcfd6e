// Writes a folder for browsers as a .larshow file, for programs that read only these (shared/bundle/zip_layout.h).
import {readFileSync, writeFileSync} from 'node:fs';
import {crc32, gunzipSync} from 'node:zlib';

const ALIGNMENT = 64;

// The fields that the headers in front of members and in the directory share.
function common(bytes, nameSize, extraSize) {
  const fields = Buffer.alloc(26);
  fields.writeUInt16LE(10, 0);
  fields.writeUInt16LE(1 << 5 | 1, 8);
  fields.writeUInt32LE(crc32(bytes), 10);
  fields.writeUInt32LE(bytes.length, 14);
  fields.writeUInt32LE(bytes.length, 18);
  fields.writeUInt16LE(nameSize, 22);
  fields.writeUInt16LE(extraSize, 24);
  return fields;
}

export function writeLarshow(folder, file) {
  const manifest = readFileSync(`${folder}/show/manifest.json`);
  const members = [['manifest.json', manifest], ...JSON.parse(manifest).members.map(({name, sha256, packed}) => {
    const bytes = readFileSync(`${folder}/show/${sha256}`);
    return [name, packed === undefined ? bytes : gunzipSync(bytes)];
  })];
  const parts = [];
  const directory = [];
  let offset = 0;
  for (const [name, bytes] of members) {
    const text = Buffer.from(name);
    const shortest = offset + 30 + text.length + 6;
    const extra = Buffer.alloc(6 + (ALIGNMENT - shortest % ALIGNMENT) % ALIGNMENT);
    extra.writeUInt16LE(0xd935, 0);
    extra.writeUInt16LE(extra.length - 4, 2);
    extra.writeUInt16LE(ALIGNMENT, 4);
    parts.push(Buffer.from('PK\x03\x04'), common(bytes, text.length, extra.length), text, extra, bytes);
    const rest = Buffer.alloc(14);
    rest.writeUInt32LE(offset, 10);
    directory.push(Buffer.from('PK\x01\x02'), Buffer.from([63, 0]), common(bytes, text.length, 0), rest, text);
    offset += 30 + text.length + extra.length + bytes.length;
  }
  const central = Buffer.concat(directory);
  const end = Buffer.alloc(22);
  end.write('PK\x05\x06', 'latin1');
  end.writeUInt16LE(members.length, 8);
  end.writeUInt16LE(members.length, 10);
  end.writeUInt32LE(central.length, 12);
  end.writeUInt32LE(offset, 16);
  writeFileSync(file, Buffer.concat([...parts, central, end]));
}
