// node group_test.mjs DEVICE_PROGRAM WEB_PROGRAM NODE
// Devices of a group exchange messages through a simulated broker in simulated time: two pages as WebAssembly, and a museum's
// device as a native program, which comes later. Checks that their dramas are at the same time, that states at equal ticks have
// equal hashes, and that no page leads while the device is there. Status 77: something that the test needs is absent.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {createInterface} from 'node:readline';
import {skipWithout} from './needs.mjs';

const [native, program, node] = process.argv.slice(2);
skipWithout([program, 'build the preset `web`'], [native, 'build the program']);
const FRAME = 1e6 / 60;
const DELAY = 25_000;  // Microseconds from one device through the broker to another.
const MOST_APART = 0.02;  // Seconds.

function check(good, text) {
  console.log(`${good ? 'ok  ' : 'MISS'} ${text}`);
  assert.ok(good, text);
}

// A program that answers each line with a line.
function member(name, seed, ahead, command, ...options) {
  const child = spawn(command, [...options, name, seed], {stdio: ['pipe', 'pipe', 'inherit']});
  const lines = createInterface({input: child.stdout})[Symbol.asyncIterator]();
  return {
    name,
    ahead,  // Microseconds of the member's clock when the test begins.
    async ask(line) {
      child.stdin.write(`${line}\n`);
      return (await lines.next()).value;
    },
    end: () => child.kill(),
  };
}

const members = [];
const flying = [];  // Messages on their way, {at, to, from, bytes}, in the order of `at`.
let now = 0;
const marks = new Map();  // The hash of each member's state, by run and tick.

async function play(seconds, keys = {}) {
  for (const end = now + 1e6 * seconds; now < end;) {
    now += FRAME;
    const due = flying.splice(0, flying.findIndex(({at}) => at > now) >>> 0);
    for (const member of members) {
      const take = due.filter(({to, from}) => from !== member.name && (to === '' || to === member.name)).map(({from, bytes}) => [from, bytes]);
      const answer = JSON.parse(await member.ask(JSON.stringify({now: Math.round(now) + member.ahead, take, keys: keys[member.name] ?? ''})));
      delete keys[member.name];
      flying.push(...answer.send.map(([to, bytes]) => ({at: now + DELAY, to, from: member.name, bytes})));
      Object.assign(member, {seconds: answer.seconds, leads: answer.leads, leader: answer.leader});
      for (const [at, hash] of Object.entries(answer.marks)) {
        marks.set(at, {...marks.get(at), [member.name]: hash});
      }
    }
  }
}

const apart = () => Math.max(...members.map(({seconds}) => seconds)) - Math.min(...members.map(({seconds}) => seconds));

// Counts the states that two members have noted, and those that differ.
function compare(some) {
  const both = [...marks.values()].map((hashes) => some.map((name) => hashes[name])).filter((hashes) => hashes.every((hash) => hash !== undefined));
  return {compared: both.length, different: both.filter(([first, ...others]) => others.some((other) => other !== first)).length};
}

const [first, second, tablet] = ['page/aaaa', 'page/bbbb', 'tablet-01'];
try {
  members.push(member(first, 1, 5_000_000, node, program), member(second, 2, 90_000_000_000, node, program));
  await play(8, {[first]: 'a'});
  check(members.filter(({leads}) => leads).length === 1, `pages without a device have one leader: ${members[0].leader}`);
  check(apart() <= MOST_APART, `they are ${(1000 * apart()).toFixed(1)} ms apart`);
  members.push(member(tablet, 3, 700_000_000, native));
  await play(6);
  check(members.every(({leader}) => leader === tablet), 'when a device comes, it leads');
  await play(14, {[second]: 'a', [tablet]: '/door,1'});
  check(members.every(({leader}) => leader === tablet), 'no page takes the lead from it');
  check(apart() <= MOST_APART, `all are ${(1000 * apart()).toFixed(1)} ms apart`);
  const pages = compare([first, second]);
  check(pages.compared > 15 && pages.different === 0, `${pages.compared} states of the pages are equal bit for bit`);
  const all = compare([first, second, tablet]);
  check(all.compared > 10 && all.different === 0, `${all.compared} states of pages and device are equal bit for bit`);
} finally {
  members.forEach(({end}) => end());
}
