// The functions that sound_graph.cc calls, with the nodes of Web Audio. Each source that has a place goes through a filter
// for what is high, its gain and a panner with head-related transfer functions, and beside them through a second filter and
// gain into the room's reverberation. A source that moves with the head goes through a gain only. Parameters change by ramps
// of the context's own time, so that a busy page does not click. This linker loses variables that are taken out of an object
// by a pattern.
mergeInto(LibraryManager.library, {
  $webAudio: {
    graph: null,

    // The parameters of a source in the order of `Values` in sound_graph.cc.
    parameters: (nodes) => {
      return nodes.map((param) => ({param, value: 0, time: 0}));
    },

    placed: (source) => {
      const graph = webAudio.graph;
      const context = graph.context;
      const shelf = {type: 'highshelf', frequency: 5000};
      const high = new BiquadFilterNode(context, shelf);
      const reverbHigh = new BiquadFilterNode(context, shelf);
      const gain = new GainNode(context);
      const reverbGain = new GainNode(context);
      // The graph computes distance and cone itself; the panner turns only.
      const panner = new PannerNode(context, {panningModel: 'HRTF', distanceModel: 'inverse', rolloffFactor: 0, positionZ: -1});
      high.connect(gain).connect(panner).connect(graph.into);
      reverbHigh.connect(reverbGain).connect(graph.room);
      source.placed = {inputs: [high, reverbHigh], parameters: webAudio.parameters([gain.gain, panner.positionX,
        panner.positionY, panner.positionZ, high.gain, reverbGain.gain, reverbHigh.gain])};
    },

    locked: (source) => {
      const gain = new GainNode(webAudio.graph.context);
      gain.connect(webAudio.graph.into);
      source.locked = {inputs: [gain], parameters: webAudio.parameters([gain.gain])};
    },

    // Sets a parameter now if the source has just begun, and by a ramp otherwise.
    change: (entry, value, begin, end, fresh) => {
      const param = entry.param;
      if (fresh) {
        param.setValueAtTime(value, begin);
        end = begin;
      } else if (value !== entry.value) {
        if (entry.time < begin) {
          param.setValueAtTime(entry.value, begin);
        }
        param.linearRampToValueAtTime(value, end);
      } else {
        return;
      }
      entry.value = value;
      entry.time = end;
    },

    // samples: 16 bits, interleaved.
    buffer: (samples, frames, channels, rate) => {
      const buffer = new AudioBuffer({length: frames, numberOfChannels: channels, sampleRate: rate});
      const at = samples >> 1;
      for (let channel = 0; channel < channels; ++channel) {
        const data = buffer.getChannelData(channel);
        for (let i = 0; i < frames; ++i) {
          data[i] = HEAP16[at + i * channels + channel] / 32768;
        }
      }
      return buffer;
    },

    start: (index, buffer, when, offset, loop, keepsOnset) => {
      const context = webAudio.graph.context;
      const source = webAudio.graph.sources[index];
      const late = context.currentTime - when;
      // With MixerOptions::late_start, this is max_lag.
      const skipped = late > 0 && !(keepsOnset && late <= 0.025) ? late : 0;
      if (!loop && offset + skipped >= buffer.duration) {
        return;
      }
      const node = new AudioBufferSourceNode(context, {buffer, loop});
      source.now.inputs.forEach((input) => node.connect(input));
      source.nodes.add(node);
      node.onended = () => {
        node.disconnect();
        source.nodes.delete(node);
      };
      node.start(Math.max(when, 0), loop ? (offset + skipped) % buffer.duration : offset + skipped);
    },
  },

  lararium_audio_open__deps: ['$webAudio'],
  lararium_audio_open: function() {
    const out = Module['audioOut'];
    if (!out) {
      return 0;
    }
    const context = out.context;
    // Peaks stay below full scale.
    const limiter = new DynamicsCompressorNode(context, {threshold: -1, knee: 0, ratio: 20, attack: 0.001, release: 0.1});
    const into = new GainNode(context);
    into.connect(limiter).connect(out);
    webAudio.graph = {context, into, limiter, room: new GainNode(context), convolver: null, buffers: [null], sources: [],
      head: context.currentTime};
    return context.sampleRate;
  },

  lararium_audio_close__deps: ['$webAudio'],
  lararium_audio_close: function() {
    const graph = webAudio.graph;
    graph.sources.forEach((source) => source.nodes.forEach((node) => node.stop()));
    if (graph.convolver) {
      graph.convolver.disconnect();
    }
    graph.limiter.disconnect();
    webAudio.graph = null;
  },

  lararium_audio_buffer__deps: ['$webAudio'],
  lararium_audio_buffer: function(samples, frames, channels, rate) {
    return webAudio.graph.buffers.push(webAudio.buffer(samples, frames, channels, rate)) - 1;
  },

  // placed: whether the source has a place or moves with the head.
  lararium_audio_place__deps: ['$webAudio'],
  lararium_audio_place: function(index, placed) {
    const sources = webAudio.graph.sources;
    const source = sources[index] = sources[index] || {nodes: new Set(), placed: null, locked: null};
    const kind = placed ? 'placed' : 'locked';
    if (!source[kind]) {
      webAudio[kind](source);
    }
    source.now = source[kind];
    source.fresh = true;
  },

  lararium_audio_play__deps: ['$webAudio'],
  lararium_audio_play: function(index, buffer, seconds, loops) {
    const graph = webAudio.graph;
    webAudio.start(index, graph.buffers[buffer], graph.head, seconds, Boolean(loops), seconds === 0);
  },

  lararium_audio_queue__deps: ['$webAudio'],
  lararium_audio_queue: function(index, samples, frames, channels, rate, when) {
    webAudio.start(index, webAudio.buffer(samples, frames, channels, rate), when, 0, false, false);
  },

  lararium_audio_stop__deps: ['$webAudio'],
  lararium_audio_stop: function(index) {
    const graph = webAudio.graph;
    graph.sources[index].nodes.forEach((node) => node.stop(graph.head));
  },

  lararium_audio_set__deps: ['$webAudio'],
  lararium_audio_set: function(index, values, seconds) {
    const head = webAudio.graph.head;
    const source = webAudio.graph.sources[index];
    source.now.parameters.forEach((entry, i) => webAudio.change(entry, HEAPF32[(values >> 2) + i], head, head + seconds, source.fresh));
    source.fresh = false;
  },

  // samples: the left ear's response, then the right ear's; no frames: no reverberation.
  lararium_audio_reverb__deps: ['$webAudio'],
  lararium_audio_reverb: function(samples, frames) {
    const graph = webAudio.graph;
    if (graph.convolver) {
      graph.convolver.disconnect();
    }
    graph.room.disconnect();
    if (frames === 0) {
      graph.convolver = null;
      return;
    }
    const buffer = new AudioBuffer({length: frames, numberOfChannels: 2, sampleRate: graph.context.sampleRate});
    for (let ear = 0; ear < 2; ++ear) {
      const at = (samples >> 2) + ear * frames;
      buffer.copyToChannel(HEAPF32.subarray(at, at + frames), ear);
    }
    graph.convolver = new ConvolverNode(graph.context, {buffer, disableNormalization: true});
    graph.room.connect(graph.convolver).connect(graph.into);
  },

  lararium_audio_advance__deps: ['$webAudio'],
  lararium_audio_advance: function(seconds) {
    webAudio.graph.head += seconds;
  },

  lararium_audio_times__deps: ['$webAudio'],
  lararium_audio_times: function(times) {
    // The limiter looks ahead by six milliseconds.
    const graph = webAudio.graph;
    const context = graph.context;
    HEAPF64.set([graph.head, context.currentTime, (context.outputLatency || context.baseLatency || 0) + 0.006], times >> 3);
  },
});
