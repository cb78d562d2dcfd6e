// What a show is, from the manifest of its .larshow file: a ZIP archive without compression, whose first member it is.

// Returns {title, spoken, captions, descriptions, sounds}, or undefined if more of the file's bytes are needed.
export function parseAbout(bytes) {
  const header = 30;  // Bytes of a member's local header before its name.
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < header) {
    return undefined;
  }
  const begin = header + view.getUint16(26, true) + view.getUint16(28, true);
  const end = begin + view.getUint32(18, true);
  if (bytes.length < end) {
    return undefined;
  }
  const {title, spoken = [], captions = [], descriptions = [], sounds = []} =
    JSON.parse(new TextDecoder().decode(bytes.subarray(begin, end)));
  return {title, spoken: spoken.map(({name}) => name), captions, descriptions: descriptions.length > 0,
    sounds: sounds.length + spoken.length > 0};
}

// Reads the beginning of a show only. Returns undefined if it does not arrive; loading it says so later.
export async function readAbout(url) {
  const stop = new AbortController();
  try {
    const response = await fetch(url, {signal: stop.signal});
    let bytes = new Uint8Array();
    for (const reader = response.body.getReader(); response.ok;) {
      const {done, value} = await reader.read();
      if (done) {
        break;
      }
      const longer = new Uint8Array(bytes.length + value.length);
      longer.set(bytes);
      longer.set(value, bytes.length);
      bytes = longer;
      const about = parseAbout(bytes);
      if (about !== undefined) {
        return about;
      }
    }
  } catch {
    // The network fails, or the file is no show.
  } finally {
    stop.abort();
  }
  return undefined;
}
