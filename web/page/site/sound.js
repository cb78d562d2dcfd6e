// The page's output for sound. The show's graph (shared/audio/web) plays into `out`.
export class Sound {
  // Call this in the handler of a tap or key: browsers let no sound begin otherwise.
  begin() {
    if (this.context === undefined) {
      try {
        this.context = new AudioContext({sampleRate: 48000, latencyHint: 'interactive'});
      } catch {
        return;  // This browser plays no sound.
      }
      this.out = new GainNode(this.context, {gain: 0});
      this.out.connect(this.context.destination);
    }
    this.context.resume().catch(() => {});
  }

  // volume: 0 to 1. Perceived loudness is about logarithmic; the square of the volume approximates that.
  setVolume(volume) {
    if (this.out !== undefined && this.volume !== volume) {
      this.volume = volume;
      this.out.gain.setTargetAtTime(volume ** 2, this.context.currentTime, 0.02);
    }
  }

  // Sound stands where it is until begin().
  suspend() {
    this.context?.suspend().catch(() => {});
  }
}
