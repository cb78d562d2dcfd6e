// The page as a device of a museum's fleet (docs/file-formats.md#topics-of-a-fleet), over MQTT by WebSocket. Nothing that the
// visitor sees waits for it, and no failure of it is shown.
import {WISHES} from './show.js';

const ONLINE = '{"online": true}';
const OFFLINE = '{"online": false}';
const FORGET = {messageExpiryInterval: 60};  // Seconds after which the broker forgets a page that is gone.
const TAKEN_OVER = 0x8e;  // Another window has this name now.
const PUBLISH_MS = 1000;
const STEP_MS = 20;
const MINUTE_MS = 60000;
const LOST_MS = 1000;  // A loss that is shorter does not count.
const COMMAND_BYTES = 1024;
const COMMANDS_A_SECOND = 16;
const SIZES = ['normal', 'large', 'largest'];
const CONTRASTS = ['normal', 'high'];

// A random name, which a browser keeps for a day, so that nothing relates the visits of two days.
function pageName() {
  const day = new Date().toDateString();
  const kept = (() => {
    try {
      return JSON.parse(localStorage.getItem('lararium fleet'));
    } catch {
      return null;  // The browser may forbid storage.
    }
  })();
  if (kept?.day === day && /^[0-9a-f]{16}$/.test(kept.name)) {
    return kept.name;
  }
  const name = Array.from(crypto.getRandomValues(new Uint8Array(8)), (byte) => byte.toString(16).padStart(2, '0')).join('');
  try {
    localStorage.setItem('lararium fleet', JSON.stringify({day, name}));
  } catch {
    // A browser without storage keeps the name for this visit only.
  }
  return name;
}

async function loadMqtt() {
  await new Promise((resolve, reject) => {
    const script = document.createElement('script');
    Object.assign(script, {src: new URL('mqtt.min.js', import.meta.url), onload: resolve, onerror: () => reject(new Error('mqtt.min.js does not arrive'))});
    document.head.append(script);
  });
  return globalThis.mqtt;
}

// The quality of tracking, for the fields `tracking` and `picture` of the state.
class Tally {
  began = performance.now();
  frames = [];  // The last minute's frames: [milliseconds, tracked].
  count = 0;
  tracked = 0;
  losses = 0;
  seen = this.began;  // The time of the last pose.
  last = {state: 'searching', reason: 'none', confidence: 0};

  add(last) {
    const now = performance.now();
    const tracked = last.pose !== null;
    this.losses += tracked && this.tracked > 0 && now - this.seen > LOST_MS ? 1 : 0;
    this.seen = tracked ? now : this.seen;
    this.last = last;
    ++this.count;
    this.tracked += tracked ? 1 : 0;
    this.frames.push([now, tracked]);
    while (this.frames[0][0] < now - MINUTE_MS) {
      this.frames.shift();
    }
  }

  describe() {
    const now = performance.now();
    const share = (part, whole) => whole === 0 ? 0 : part / whole;
    const recent = this.frames.filter(([at]) => at > now - 2000).length;
    const {state, reason, confidence} = this.last;
    return {
      frames_per_second: recent / 2,
      up_seconds: (now - this.began) / 1000,
      tracking: {state, reason, confidence, lost_seconds: state === 'tracking' ? 0 : (now - this.seen) / 1000,
        tracked: share(this.tracked, this.count), tracked_minute: share(this.frames.filter(([, tracked]) => tracked).length, this.frames.length),
        losses: this.losses},
    };
  }
}

// The commands of the staff to a page, as functions of the field `value`; undefined: this page cannot do it.
function commandsOf({about, show, choices, change, restart, findAnew}) {
  const loudness = (step) => change({volume: Math.min(1, Math.max(0, Math.round(10 * choices.values.volume + step) / 10))});
  const offered = (values, key) => (value) => values.includes(value) && change({[key]: value});
  const index = (names, key) => (value) => names.includes(value) && change({[key]: names.indexOf(value)});
  const flag = (key) => (value) => typeof value === 'boolean' && change({[key]: value});
  return {
    restart, find_anew: findAnew, louder: () => loudness(1), quieter: () => loudness(-1),
    volume: (value) => value >= 0 && value <= 1 && change({volume: value}),
    language: offered(about.spoken, 'spoken'), captions: offered([...about.captions, 'off'], 'captions'),
    caption_size: index(SIZES, 'size'), caption_contrast: index(CONTRASTS, 'contrast'),
    descriptions: about.descriptions ? flag('descriptions') : undefined, reduced_motion: flag('reducedMotion'),
    hold: () => show.hold(true), resume: () => show.hold(false), go_to: (value) => typeof value === 'string' && show.goTo(value),
  };
}

export class Fleet {
  // options: {address, group, password}. page: {about, show, choices, sound, change, restart, findAnew}.
  constructor({address, group = '', password}, page) {
    Object.assign(this, {address, group, password, page});
    this.name = pageName();
    const base = `lararium/${new URL(address.replace('wss:', 'https:')).pathname.slice(1)}`;
    const own = `${base}/device/page/${this.name}`;
    this.topics = {state: `${own}/state`, presence: `${own}/presence`,
      commands: [`${own}/do`, ...(group === '' ? [] : [`${base}/group/${group}/do`])]};
    this.commands = commandsOf(page);
    this.together = page.show.joinGroup(this.name);
    const together = `${base}/group/${group}`;
    this.topics.group = !this.together ? undefined : {
      all: `${together}/all/page/${this.name}`,
      to: (other) => `${together}/to/${other}/page/${this.name}`,
      heard: ['+', 'page/+'].flatMap((others) => [
        `${together}/all/${others}`, `${together}/to/page/${this.name}/${others}`, `${base}/device/${others}/presence`]),
    };
    this.tally = new Tally();
    this.second = {began: 0, count: 0};
  }

  // The visit begins, or goes on.
  async begin() {
    this.playing = true;
    clearInterval(this.stepping);
    this.stepping = this.together ? setInterval(() => this.step(), STEP_MS) : undefined;
    this.mqtt ??= await loadMqtt();
    if (!this.playing || this.client !== undefined) {
      return;
    }
    const client = this.mqtt.connect(this.address, {
      protocolVersion: 5, clientId: this.name, username: 'visitors', password: this.password, clean: true, keepalive: 10,
      connectTimeout: 10000, reconnectPeriod: 3000, queueQoSZero: false, timerVariant: 'native',
      will: {topic: this.topics.presence, payload: OFFLINE, qos: 1, retain: true, properties: FORGET},
    });
    this.client = client;
    client.on('connect', () => {
      client.subscribe(this.topics.commands, {qos: 2});
      if (this.together) {
        client.subscribe(this.topics.group.heard, {qos: 1});
      }
      client.publish(this.topics.presence, ONLINE, {qos: 1, retain: true});
      this.publish();
    });
    client.on('message', (topic, payload, {retain}) => this.take(topic, payload, retain));
    client.on('disconnect', ({reasonCode}) => reasonCode === TAKEN_OVER && client.end(true));
    client.on('error', (error) => console.debug(error.message));
    this.timer = setInterval(() => this.publish(), PUBLISH_MS);
  }

  // The visit is over, or interrupted.
  end() {
    this.playing = false;
    clearInterval(this.timer);
    clearInterval(this.stepping);
    const {client} = this;
    this.client = undefined;
    if (client?.connected) {
      client.publish(this.topics.presence, OFFLINE, {qos: 1, retain: true, properties: FORGET});
      client.end();  // The message goes first.
    } else {
      client?.end(true);
    }
  }

  // Takes the tracker's answer about an image.
  saw(tracked) {
    this.tally.add(tracked);
  }

  // Exchanges messages between the show and the other members. Without a connection the show plays on alone.
  step() {
    for (const {to, bytes, reliable} of this.page.show.stepGroup()) {
      if (this.client?.connected) {  // Members repeat what is lost.
        this.client.publish(to === '' ? this.topics.group.all : this.topics.group.to(to), bytes, {qos: reliable ? 1 : 0});
      }
    }
  }

  publish() {
    if (this.client?.connected) {
      this.client.publish(this.topics.state, JSON.stringify(this.state()), {qos: 0, retain: true, properties: FORGET});
    }
  }

  // The state of a player (docs/file-formats.md#state-of-a-player).
  state() {
    const {about, show, choices: {values}, sound} = this.page;
    const {picture, ...known} = show.state();
    const {frames_per_second, ...tally} = this.tally.describe();
    return {
      schema: 1, answers: true, silent_seconds: 0, name: `page/${this.name}`, group: this.group, time: Math.floor(Date.now() / 1000),
      ...(this.together ? {drama: show.groupState()} : {}),
      player: {
        ...known, ...tally, picture: {...picture, frames_per_second}, kiosk: false, visitor: null,
        power: {celsius: null, battery: null, charging: null},
        sound: {volume: values.volume, audible: sound.context?.state === 'running'},
        language: values.spoken, languages: about.spoken, captions: values.captions, caption_languages: about.captions,
        caption_size: SIZES[values.size], caption_contrast: CONTRASTS[values.contrast],
        descriptions: about.descriptions ? values.descriptions : null, reduced_motion: values.reducedMotion, restarts: 0, warnings: [],
      },
    };
  }

  take(topic, payload, retain) {
    if (!this.playing || retain) {
      return;
    }
    if (this.topics.commands.includes(topic)) {
      this.obey(payload, topic !== this.topics.commands[0]);
    } else if (this.together) {
      this.hear(topic, payload);
    }
  }

  // The end of a topic is the name of the member that wrote it, for which the broker vouches.
  hear(topic, payload) {
    const isPresence = topic.endsWith('/presence');
    const name = /\/((?:page\/)?[\w-]{1,64})$/.exec(isPresence ? topic.slice(0, -'/presence'.length) : topic)?.[1];
    if (name === undefined) {
      return;
    }
    if (!isPresence) {
      this.page.show.takeMessage(name, payload);
    } else if (new TextDecoder().decode(payload) === OFFLINE) {
      this.page.show.setGone(name);
    }
  }

  // Anything may have been published as a command.
  obey(payload, toAll) {
    const now = performance.now();
    if (now - this.second.began > 1000) {
      this.second = {began: now, count: 0};
    }
    if (++this.second.count > COMMANDS_A_SECOND || payload.length > COMMAND_BYTES) {
      return;
    }
    try {
      const {do: what, value} = JSON.parse(new TextDecoder().decode(payload));
      if (this.together && WISHES.includes(what)) {
        this.page.show.want(what, what === 'go_to' ? String(value) : '', toAll);
      } else if (Object.hasOwn(this.commands, what)) {
        this.commands[what]?.(value);
        this.publish();
      }
    } catch (error) {
      console.debug(error.message);
    }
  }
}
