#include "editor/bake/sound_synthesis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "shared/core/check.h"
#include "shared/core/random.h"

namespace lararium::bake {
namespace {

using std::numbers::pi;
using Samples = std::vector<double>;

constexpr int kRate = 48'000;
constexpr double kHighestPeak = 0.7;  // -3 dB

size_t Frames(double seconds) { return static_cast<size_t>(std::llround(seconds * kRate)); }
double FromDb(double db) { return std::pow(10.0, db / 20.0); }

// Waiting time of a Poisson process.
double Wait(Random& random, double per_second) {
  return -std::log(1.0 - random.Uniform()) / per_second;
}

double LogUniform(Random& random, double low, double high) {
  return low * std::pow(high / low, random.Uniform());
}

// Second-order sections (Bristow-Johnson, "Cookbook formulae for audio EQ biquad filter
// coefficients").
struct Biquad {
  double b0, b1, b2, a1, a2;

  static Biquad Make(double hertz, double q, double b0, double b1, double b2) {
    const double w = 2.0 * pi * hertz / kRate;
    const double alpha = std::sin(w) / (2.0 * q);
    const double a0 = 1.0 + alpha;
    return {b0 / a0, b1 / a0, b2 / a0, -2.0 * std::cos(w) / a0, (1.0 - alpha) / a0};
  }
  static Biquad LowPass(double hertz, double q = 0.7071) {
    const double c = 1.0 - std::cos(2.0 * pi * hertz / kRate);
    return Make(hertz, q, 0.5 * c, c, 0.5 * c);
  }
  static Biquad HighPass(double hertz, double q = 0.7071) {
    const double c = 1.0 + std::cos(2.0 * pi * hertz / kRate);
    return Make(hertz, q, 0.5 * c, -c, 0.5 * c);
  }
  static Biquad BandPass(double hertz, double q) {
    const double alpha = std::sin(2.0 * pi * hertz / kRate) / (2.0 * q);
    return Make(hertz, q, alpha, 0.0, -alpha);
  }

  // Filters in place. A loop is filtered as if it had played for ever, so that its end
  // influences its beginning.
  void Run(Samples& samples, bool loops) const {
    double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;
    const auto step = [&](double x) {
      const double y = b0 * x + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2;
      x2 = x1;
      x1 = x;
      y2 = y1;
      y1 = y;
      return y;
    };
    if (loops) {
      for (const double x : samples) {
        step(x);
      }
    }
    for (double& sample : samples) {
      sample = step(sample);
    }
  }
};

Samples WhiteNoise(size_t frames, Random& random) {
  Samples noise(frames);
  for (double& sample : noise) {
    sample = random.Uniform(-1.0, 1.0);
  }
  return noise;
}

double RmsOf(const Samples& samples) {
  double sum = 0.0;
  for (const double sample : samples) {
    sum += sample * sample;
  }
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

// Adds a short sound; in a loop, it continues over the end at the beginning.
void AddAt(const Samples& event, double seconds, double gain, bool loops, Samples& samples) {
  const size_t begin = Frames(seconds);
  for (size_t i = 0; i < event.size(); ++i) {
    if (begin + i < samples.size() || loops) {
      samples[(begin + i) % samples.size()] += gain * event[i];
    }
  }
}

void Add(const Samples& more, double gain, Samples& samples) {
  for (size_t i = 0; i < samples.size(); ++i) {
    samples[i] += gain * more[i];
  }
}

void Scale(Samples& samples, double rms) {
  const double gain = rms / std::max(RmsOf(samples), 1e-12);
  for (double& sample : samples) {
    sample *= gain;
  }
}

// Slow noise from 0 to 1 whose end meets its beginning.
Samples Wandering(size_t frames, double hertz, Random& random) {
  const double seconds = static_cast<double>(frames) / kRate;
  const auto knots = std::max<size_t>(static_cast<size_t>(seconds * hertz), 2);
  Samples values(knots);
  for (double& value : values) {
    value = random.Uniform();
  }
  Samples samples(frames);
  for (size_t i = 0; i < frames; ++i) {
    const double at = static_cast<double>(i * knots) / static_cast<double>(frames);
    const auto knot = static_cast<size_t>(at);
    const double part = 0.5 - 0.5 * std::cos(pi * (at - static_cast<double>(knot)));
    samples[i] = values[knot] + part * (values[(knot + 1) % knots] - values[knot]);
  }
  return samples;
}

// A decaying tone of a body that was struck.
struct Mode {
  double hertz;
  double decay;  // seconds to 1/e
  double gain;
};

Samples Strike(std::span<const Mode> modes, double seconds) {
  Samples samples(Frames(seconds));
  for (const Mode& mode : modes) {
    for (size_t i = 0; i < samples.size(); ++i) {
      const double t = static_cast<double>(i) / kRate;
      samples[i] += mode.gain * std::exp(-t / mode.decay) * std::sin(2.0 * pi * mode.hertz * t);
    }
  }
  return samples;
}

// A brittle object that breaks: a burst of noise in a band.
Samples Burst(double hertz, double q, double decay, Random& random) {
  Samples samples = WhiteNoise(Frames(8.0 * decay), random);
  for (size_t i = 0; i < samples.size(); ++i) {
    samples[i] *= std::exp(-static_cast<double>(i) / kRate / decay);
  }
  Biquad::BandPass(hertz, q).Run(samples, false);
  return samples;
}

// Schroeder's reverberator ("Natural sounding artificial reverberation", JAES 1962):
// four combs, two all-passes.
Samples Reverberate(const Samples& dry, double seconds) {
  Samples sum(dry.size());
  const auto run = [&](const Samples& in, size_t delay, double gain, bool all_pass, Samples& out) {
    Samples line(delay);
    for (int pass = 0; pass < 2; ++pass) {  // The first pass fills the delay lines.
      for (size_t i = 0; i < in.size(); ++i) {
        double& slot = line[(i + static_cast<size_t>(pass) * in.size()) % delay];
        const double delayed = slot;
        slot = in[i] + gain * delayed;
        if (pass == 1) {
          out[i] += all_pass ? delayed - gain * slot : delayed;
        }
      }
    }
  };
  for (const double delay : {0.0297, 0.0371, 0.0411, 0.0437}) {
    run(dry, Frames(delay), std::pow(0.001, delay / seconds), false, sum);
  }
  for (const double delay : {0.005, 0.0017}) {
    Samples next(sum.size());
    run(sum, Frames(delay), 0.7, true, next);
    sum = std::move(next);
  }
  return sum;
}

// A fire has three components: it flutters, hisses and crackles (Farnell, Designing Sound, MIT
// Press 2010, "Fire").
Samples Brazier() {
  Random random(71);
  const size_t frames = Frames(12.0);
  Samples flutter = WhiteNoise(frames, random);
  Biquad::LowPass(110.0).Run(flutter, true);
  Biquad::HighPass(30.0).Run(flutter, true);
  Scale(flutter, 1.0);
  const Samples draught = Wandering(frames, 4.0, random);
  Samples hiss = WhiteNoise(frames, random);
  Biquad::BandPass(4500.0, 0.6).Run(hiss, true);
  Scale(hiss, 1.0);
  const Samples gas = Wandering(frames, 1.5, random);
  Samples fire(frames);
  for (size_t i = 0; i < frames; ++i) {
    fire[i] = 0.5 * (0.4 + 0.6 * draught[i]) * flutter[i] + 0.25 * std::pow(gas[i], 4.0) * hiss[i];
  }
  // Splinters burst in clusters; the energies of the bursts range over decades.
  for (double t = Wait(random, 2.2); t < 12.0; t += Wait(random, 2.2)) {
    double within = t;
    for (uint32_t left = 1 + random.Below(6); left > 0 && within < 12.0; --left) {
      const bool pop = random.Uniform() < 0.12;
      const double hertz = pop ? random.Uniform(300.0, 900.0) : LogUniform(random, 1200.0, 9000.0);
      const double decay = pop ? 0.012 : LogUniform(random, 0.0008, 0.006);
      AddAt(Burst(hertz, 1.2, decay, random), within, LogUniform(random, 1.0, 18.0), true, fire);
      within += Wait(random, 25.0);
    }
  }
  Scale(fire, FromDb(-34.0));
  return fire;
}

// A bubble rings at the frequency of Minnaert (1933), 3.26 m/s divided by its radius for air in
// water, damped and rising as in van den Doel, "Physically based models for liquid sounds", ACM
// TAP 2005, equations 4 to 9.
Samples Bubble(double radius, double rise) {
  const double hertz = 3.26 / radius;
  const double damping = 0.13 / radius + 0.0072 * std::pow(radius, -1.5);
  Samples samples(Frames(std::min(7.0 / damping, 0.2)));
  double phase = 0.0;
  for (size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i) / kRate;
    samples[i] = std::exp(-damping * t) * std::sin(phase);
    phase += 2.0 * pi * hertz * (1.0 + rise * damping * t) / kRate;
  }
  return samples;
}

Samples Pour() {
  Random random(72);
  constexpr double kSeconds = 4.0;
  Samples pour(Frames(kSeconds));
  const Samples stream = Wandering(pour.size(), 6.0, random);
  for (double t = Wait(random, 260.0); t < kSeconds; t += Wait(random, 260.0)) {
    // Small bubbles are numerous, large ones loud.
    const double radius = LogUniform(random, 0.0004, 0.006) * std::pow(random.Uniform(), 0.3);
    const double gain = std::pow(std::max(radius, 0.0002) / 0.006, 1.3) * random.Uniform();
    const double depth = 0.3 + 0.7 * stream[Frames(t) % pour.size()];
    AddAt(Bubble(std::max(radius, 0.0002), random.Uniform() < 0.3 ? 0.1 : 0.02), t, gain * depth,
          true, pour);
  }
  Samples splash = WhiteNoise(pour.size(), random);
  Biquad::BandPass(3200.0, 0.5).Run(splash, true);
  Scale(splash, 0.12 * RmsOf(pour));
  for (size_t i = 0; i < pour.size(); ++i) {
    pour[i] += (0.4 + 0.6 * stream[i]) * splash[i];
  }
  Scale(pour, FromDb(-29.0));
  return pour;
}

// A lid of fired clay slides on clay and is set down 0.3 s after the beginning.
Samples Lid() {
  Random random(73);
  Samples lid(Frames(0.6));
  Samples scrape = WhiteNoise(Frames(0.3), random);
  Biquad::BandPass(2300.0, 0.8).Run(scrape, false);
  for (size_t i = 0; i < scrape.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(scrape.size());
    scrape[i] *= std::pow(std::sin(pi * part), 2.0) * (0.6 + 0.4 * std::sin(2.0 * pi * 9.0 * part));
  }
  AddAt(scrape, 0.0, 0.35, false, lid);
  constexpr std::array<Mode, 6> kClay = {{{415.0, 0.030, 0.7},
                                          {640.0, 0.040, 1.0},
                                          {1130.0, 0.030, 0.8},
                                          {1870.0, 0.022, 0.5},
                                          {2950.0, 0.014, 0.35},
                                          {4250.0, 0.009, 0.2}}};
  const Samples clack = Strike(kClay, 0.25);
  AddAt(clack, 0.30, 1.0, false, lid);
  AddAt(clack, 0.365, 0.35, false, lid);
  AddAt(clack, 0.40, 0.12, false, lid);
  Scale(lid, FromDb(-27.0));
  return lid;
}

// A wooden hinge sticks and slips; then the door meets its frame.
Samples Door() {
  Random random(74);
  Samples door(Frames(2.0));
  constexpr std::array<Mode, 5> kPlanks = {{{290.0, 0.018, 1.0},
                                            {530.0, 0.016, 0.8},
                                            {870.0, 0.012, 0.7},
                                            {1390.0, 0.009, 0.4},
                                            {2150.0, 0.006, 0.25}}};
  const Samples slip = Strike(kPlanks, 0.08);
  for (double t = 0.05; t < 1.6;) {
    const double swing = std::sin(pi * (t - 0.05) / 1.55);  // Speed of the door.
    AddAt(slip, t, swing * random.Uniform(0.5, 1.0), false, door);
    t += random.Uniform(0.85, 1.15) / (14.0 + 48.0 * swing);
  }
  constexpr std::array<Mode, 4> kFrame = {
      {{68.0, 0.09, 1.0}, {127.0, 0.07, 0.8}, {236.0, 0.04, 0.5}, {480.0, 0.02, 0.3}}};
  AddAt(Strike(kFrame, 0.3), 1.68, 5.0, false, door);
  AddAt(Burst(900.0, 0.7, 0.006, random), 1.68, 2.0, false, door);
  Scale(door, FromDb(-30.0));
  return door;
}

// A pestle circles in a stone mortar once in two seconds and breaks grains.
Samples Grind() {
  Random random(75);
  constexpr double kSeconds = 2.0;
  Samples grind(Frames(kSeconds));
  constexpr std::array<Mode, 3> kStone = {
      {{760.0, 0.006, 0.5}, {1650.0, 0.004, 0.8}, {3100.0, 0.002, 0.6}}};
  const Samples knock = Strike(kStone, 0.03);
  for (double t = Wait(random, 700.0); t < kSeconds; t += Wait(random, 700.0)) {
    const double pressure = 0.55 - 0.45 * std::cos(2.0 * pi * t);
    if (random.Uniform() < 0.08) {
      AddAt(knock, t, pressure * LogUniform(random, 0.1, 1.0), true, grind);
    } else {
      AddAt(Burst(LogUniform(random, 1500.0, 6000.0), 1.0, 0.0009, random), t,
            pressure * LogUniform(random, 0.2, 2.0), true, grind);
    }
  }
  Scale(grind, FromDb(-31.0));
  return grind;
}

// A syllable of an invented language: glottal pulses through the formants of a vowel (means of
// Peterson & Barney, JASA 1952, men; higher for smaller heads).
Samples Syllable(double pitch, double head, Random& random) {
  constexpr std::array<std::array<double, 3>, 6> kVowels = {{{730, 1090, 2440},
                                                             {530, 1840, 2480},
                                                             {270, 2290, 3010},
                                                             {570, 840, 2410},
                                                             {300, 870, 2240},
                                                             {490, 1350, 1690}}};
  const auto& vowel = kVowels[random.Below(kVowels.size())];
  const double seconds = random.Uniform(0.14, 0.28);
  Samples pulses(Frames(seconds));
  const double glide = random.Uniform(-0.15, 0.1);
  double phase = 0.0;
  for (size_t i = 0; i < pulses.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(pulses.size());
    phase += pitch * (1.0 + glide * part) / kRate;
    if (phase >= 1.0) {
      phase -= 1.0;
      pulses[i] = 1.0;
    }
  }
  Biquad::LowPass(500.0).Run(pulses, false);
  Samples syllable(pulses.size());
  for (size_t formant = 0; formant < vowel.size(); ++formant) {
    Samples band = pulses;
    Biquad::BandPass(head * vowel[formant], 8.0).Run(band, false);
    Add(band, 1.0 / static_cast<double>(1 + formant), syllable);
  }
  for (size_t i = 0; i < syllable.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(syllable.size());
    syllable[i] *= std::pow(std::sin(pi * part), 0.7);
  }
  return syllable;
}

// Distant voices, a passer-by, and the background noise of a town.
Samples Street() {
  Random random(76);
  constexpr double kSeconds = 24.0;
  Samples voices(Frames(kSeconds));
  for (int speaker = 0; speaker < 11; ++speaker) {
    const bool low = speaker % 2 == 0;
    const double pitch = low ? random.Uniform(95.0, 140.0) : random.Uniform(170.0, 260.0);
    const double head = low ? 1.0 : 1.17;
    const double level = LogUniform(random, 0.3, 1.0);
    for (double t = Wait(random, 0.5); t < kSeconds; t += random.Uniform(0.4, 3.0)) {
      const double phrase = random.Uniform(0.8, 2.6);
      const double end = std::min(t + phrase, kSeconds);
      while (t < end) {
        const double falls = 1.0 - 0.25 * (t - (end - phrase)) / phrase;
        const Samples syllable = Syllable(pitch * falls * random.Uniform(0.94, 1.08), head, random);
        AddAt(syllable, t, level * random.Uniform(0.5, 1.0), true, voices);
        t += static_cast<double>(syllable.size()) / kRate * random.Uniform(0.8, 1.1);
      }
    }
  }
  Samples street = Reverberate(voices, 1.1);
  Scale(street, 1.0);
  Scale(voices, 0.5);
  Add(voices, 1.0, street);
  Biquad::LowPass(1800.0).Run(street, true);  // Corners and distance remove high frequencies.
  Samples steps(street.size());
  for (double t = 6.0; t < 12.0; t += random.Uniform(0.50, 0.56)) {
    const double near = std::sin(pi * (t - 6.0) / 6.0);
    AddAt(Burst(260.0, 0.8, 0.015, random), t, 6.0 * near, true, steps);
    AddAt(Burst(1900.0, 1.0, 0.004, random), t + 0.03, 2.0 * near, true, steps);
  }
  Add(steps, 1.0, street);
  Scale(street, 1.0);
  Samples air = WhiteNoise(street.size(), random);
  Biquad::LowPass(250.0).Run(air, true);
  Biquad::HighPass(40.0).Run(air, true);
  Scale(air, 0.35);
  Add(air, 1.0, street);
  Scale(street, FromDb(-37.0));
  return street;
}

// The background of a quiet room: moving air, with the low tones emphasised by the room.
Samples Room() {
  Random random(77);
  Samples room = WhiteNoise(Frames(10.0), random);
  Biquad::LowPass(180.0, 0.5).Run(room, true);
  Biquad::LowPass(900.0, 0.5).Run(room, true);
  Biquad::HighPass(35.0).Run(room, true);
  const Samples draught = Wandering(room.size(), 0.7, random);
  for (size_t i = 0; i < room.size(); ++i) {
    room[i] *= 0.8 + 0.4 * draught[i];
  }
  Scale(room, FromDb(-52.0));
  return room;
}

struct Generator {
  BuiltInSound sound;
  Samples (*make)();
};

constexpr std::array<Generator, 7> kGenerators = {{
    {{"brazier", "charcoal and splinters that burn", true}, Brazier},
    {{"door", "a wooden door on its hinges, shut at 1.7 s", false}, Door},
    {{"grind", "a pestle in a stone mortar", true}, Grind},
    {{"lid", "a clay lid, set down at 0.3 s", false}, Lid},
    {{"pour", "wine or water out of a jug", true}, Pour},
    {{"room", "the air of a quiet room", true}, Room},
    {{"street", "people far away and steps", true}, Street},
}};

}  // namespace

std::span<const BuiltInSound> BuiltInSounds() {
  static constexpr auto kSounds = [] {
    std::array<BuiltInSound, kGenerators.size()> sounds = {};
    for (size_t i = 0; i < sounds.size(); ++i) {
      sounds[i] = kGenerators[i].sound;
    }
    return sounds;
  }();
  return kSounds;
}

Sound SynthesizeSound(std::string_view name) {
  const auto found =
      std::find_if(kGenerators.begin(), kGenerators.end(),
                   [name](const Generator& generator) { return generator.sound.name == name; });
  CHECK(found != kGenerators.end());
  Samples samples = found->make();
  double peak = 0.0;
  for (const double sample : samples) {
    peak = std::max(peak, std::abs(sample));
  }
  const double gain = std::min(1.0, kHighestPeak / std::max(peak, 1e-12));
  Sound sound;
  sound.rate = kRate;
  for (const double sample : samples) {
    sound.samples.push_back(static_cast<float>(gain * sample));
  }
  return sound;
}

}  // namespace lararium::bake
