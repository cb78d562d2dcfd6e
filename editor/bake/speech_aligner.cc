#include "editor/bake/speech_aligner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "editor/bake/speech_features.h"
#include "shared/core/random.h"

namespace lararium::bake {
namespace {

constexpr int kThirds = 3;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The constants of the model (speech_aligner.h), tuned on synthesised voices that differ from
// the reference (tests/acceptance/speech_alignment.py).
constexpr float kWeight = 0.12f;      // w
constexpr float kWorst = 4.0f;        // c
constexpr float kSpread = 0.45f;      // s
constexpr float kAdaptation = 12.0f;  // tau, frames
constexpr int kRounds = 3;
constexpr float kPauseCost = 6.0f;    // Cost of a pause that the synthesis lacks.
constexpr float kNoPauseCost = 2.0f;  // Cost of omitting a pause of the synthesis.
// Standard deviation in seconds of word times from another method.
constexpr float kWordSpread = 0.03f;
// Largest cost of such a time, because it may be completely wrong.
constexpr float kWordWorst = 18.0f;
constexpr int kShortest = 2;         // Shortest sound, in frames.
constexpr float kLongest = 5.0f;     // Longest sound relative to its expected duration.
constexpr double kBand = 2.0;        // Seconds by which a boundary may deviate from a steady pace.
constexpr double kBandShare = 0.25;  // The same as a share of the whole.
constexpr double kWidestBand = 10.0;
constexpr float kSilence = 1e-4f;  // full scale 1

// ---- input ----

// Normalises the voice and adds a faint hiss that makes all silences equal.
std::vector<Features> Hear(const std::vector<float>& samples, int rate) {
  Sound sound{rate, samples};
  Normalize(sound);
  constexpr float kHiss = 0.0006f;  // 44 dB below the voice
  Random random(20);
  for (float& sample : sound.samples) {
    sample += kHiss * static_cast<float>(2.0 * random.Uniform() - 1.0);
  }
  return ComputeFeatures(sound.samples, rate);
}

// Frames that belong to no pause: within 3 nepers (26 dB) of the loud ones.
std::vector<bool> LoudFrames(const std::vector<Features>& frames) {
  std::vector<float> energies;
  for (const Features& frame : frames) {
    energies.push_back(frame[kEnergy]);
  }
  const auto loud = energies.begin() + std::ssize(energies) * 9 / 10;
  std::nth_element(energies.begin(), loud, energies.end());
  std::vector<bool> is_loud;
  for (const Features& frame : frames) {
    is_loud.push_back(frame[kEnergy] > *loud - 3.0f);
  }
  return is_loud;
}

// Scales features to mean 0 and deviation 1 over the loud frames.
void Standardise(const std::vector<bool>& is_loud, std::vector<Features>& frames) {
  for (size_t f = 0; f < kFeatureCount; ++f) {
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (size_t t = 0; t < frames.size(); ++t) {
      if (is_loud[t]) {
        sum += static_cast<double>(frames[t][f]);
        squares += static_cast<double>(frames[t][f]) * static_cast<double>(frames[t][f]);
        ++count;
      }
    }
    const double mean = sum / std::max(count, 1);
    const double deviation = std::sqrt(std::max(squares / std::max(count, 1) - mean * mean, 1e-6));
    for (Features& frame : frames) {
      frame[f] = static_cast<float>((static_cast<double>(frame[f]) - mean) / deviation);
    }
  }
}

struct Voice {
  std::vector<Features> frames;  // standardised
  int loud_frames = 0;
};

Voice Listen(const std::vector<float>& samples, int rate) {
  Voice voice;
  voice.frames = Hear(samples, rate);
  const std::vector<bool> is_loud = LoudFrames(voice.frames);
  voice.loud_frames = static_cast<int>(std::count(is_loud.begin(), is_loud.end(), true));
  Standardise(is_loud, voice.frames);
  return voice;
}

// ---- the model ----

struct Segment {
  std::string ipa;  // Empty for a pause, which is optional.
  int word = -1;
  bool expected = true;  // The synthesis has this pause.
  float frames = 0.0f;   // Duration in the synthesis.
  double middle = 0.0;   // Middle in the synthesis, seconds.
  std::array<Features, kThirds> means = {};
  std::optional<int> begin;  // Frame, if another method gave it.
};

Features Mean(std::span<const Features> frames) {
  Features mean = {};
  for (const Features& frame : frames) {
    for (size_t f = 0; f < kFeatureCount; ++f) {
      mean[f] += frame[f] / static_cast<float>(frames.size());
    }
  }
  return mean;
}

// A third of the frames [begin, end), at least one frame.
std::span<const Features> Third(std::span<const Features> frames, int begin, int end, int third) {
  const int count = end - begin;
  const int from = std::min(begin + third * count / kThirds, static_cast<int>(frames.size()) - 1);
  const int to = std::max(begin + (third + 1) * count / kThirds, from + 1);
  return frames.subspan(
      static_cast<size_t>(from),
      std::min(static_cast<size_t>(to - from), frames.size() - static_cast<size_t>(from)));
}

int FrameOf(double seconds) { return static_cast<int>(std::lround(seconds / kFeatureStep)); }

// Sounds with an optional pause before, after and between words.
std::vector<Segment> MakeSegments(const SpokenText& reference, const Voice& voice) {
  std::vector<Segment> segments;
  const auto add_pause = [&](bool expected) {
    if (segments.empty() || !segments.back().ipa.empty()) {
      Segment& pause = segments.emplace_back();
      pause.expected = expected;
    }
  };
  add_pause(true);
  int word = -1;
  for (const Phoneme& phoneme : reference.phonemes) {
    if (phoneme.ipa.empty()) {
      add_pause(true);
      continue;
    }
    if (phoneme.word != word) {
      add_pause(false);
      word = phoneme.word;
    }
    Segment& sound = segments.emplace_back();
    sound.ipa = phoneme.ipa;
    sound.word = phoneme.word;
    const int begin = FrameOf(phoneme.begin);
    const int end = FrameOf(phoneme.end);
    sound.frames = std::max(static_cast<float>((phoneme.end - phoneme.begin) / kFeatureStep), 2.0f);
    sound.middle = 0.5 * (phoneme.begin + phoneme.end);
    for (int k = 0; k < kThirds; ++k) {
      sound.means[static_cast<size_t>(k)] = Mean(Third(voice.frames, begin, end, k));
    }
  }
  add_pause(true);
  return segments;
}

void AnchorWords(const WordTimes& words, std::vector<Segment>& segments) {
  int word = -1;
  for (Segment& segment : segments) {
    if (segment.word >= 0 && segment.word != word) {
      word = segment.word;
      if (static_cast<size_t>(word) < words.size() && words[static_cast<size_t>(word)]) {
        segment.begin = FrameOf(*words[static_cast<size_t>(word)]);
      }
    }
  }
}

// The model of pauses: the mean of the quietest twentieth of the recording.
Features QuietestFrames(const std::vector<Features>& frames) {
  std::vector<Features> sorted = frames;
  const auto count = std::max<std::ptrdiff_t>(std::ssize(sorted) / 20, 1);
  std::nth_element(sorted.begin(), sorted.begin() + count - 1, sorted.end(),
                   [](const Features& a, const Features& b) { return a[kEnergy] < b[kEnergy]; });
  return Mean(std::span(sorted).first(static_cast<size_t>(count)));
}

float Cost(const Features& frame, const Features& mean) {
  float sum = 0.0f;
  for (size_t f = 0; f < kFeatureCount; ++f) {
    const float away = frame[f] - mean[f];
    sum += away * away;
  }
  return std::min(kWorst, kWeight * sum);
}

// ---- dynamic programming ----

// Finds the boundaries of segments in a recording with the least cost.
class Search {
 public:
  Search(const std::vector<Segment>& segments,
         const std::vector<Features>& frames,
         const Features& quiet,
         float pace,
         double reference_seconds)
      : segments_(segments), frames_(frames), pace_(pace), count_(std::ssize(frames)) {
    for (const Features& frame : frames) {
      quiet_sum_.push_back((quiet_sum_.empty() ? 0.0 : quiet_sum_.back()) +
                           static_cast<double>(Cost(frame, quiet)));
    }
    quiet_sum_.insert(quiet_sum_.begin(), 0.0);
    const double seconds = static_cast<double>(count_) * kFeatureStep;
    stretch_ = seconds / std::max(reference_seconds, 0.1);
    band_ = FrameOf(std::min(std::max(kBand, kBandShare * seconds), kWidestBand));
  }

  // Gives the begin of each segment, then the end; empty if the text does not fit.
  std::vector<int> Run() {
    cost_.assign(static_cast<size_t>(count_) + 1, kInfinity);
    cost_[0] = 0.0f;
    came_from_.assign(segments_.size(), {});
    for (size_t i = 0; i < segments_.size(); ++i) {
      next_.assign(cost_.size(), kInfinity);
      came_from_[i].assign(cost_.size(), -1);
      if (segments_[i].ipa.empty()) {
        PassPause(i);
      } else {
        PassSound(i);
      }
      cost_.swap(next_);
    }
    return Trace();
  }

 private:
  // A pause has any length, or is absent.
  void PassPause(size_t i) {
    const bool expected = segments_[i].expected;
    float inside = kInfinity;
    int began = -1;
    for (int t = 0; t <= count_; ++t) {
      const auto at = static_cast<size_t>(t);
      if (t > 0) {
        inside += static_cast<float>(quiet_sum_[at] - quiet_sum_[at - 1]);
      }
      const float leave_out = cost_[at] + (expected ? kNoPauseCost : 0.0f);
      const float enter = cost_[at] + (expected ? 0.0f : kPauseCost);
      if (leave_out <= inside) {
        next_[at] = leave_out;
        came_from_[i][at] = t;
      } else {
        next_[at] = inside;
        came_from_[i][at] = began;
      }
      if (enter < inside) {
        inside = enter;
        began = t;
      }
    }
  }

  void PassSound(size_t i) {
    const Segment& segment = segments_[i];
    SumCosts(segment);
    const float expected = std::max(pace_ * segment.frames, 2.0f);
    const int longest = std::max(static_cast<int>(kLongest * expected), 3 * kShortest);
    lengths_.resize(static_cast<size_t>(longest) + 1);
    for (int d = kShortest; d <= longest; ++d) {
      const float ratio = std::log(static_cast<float>(d) / expected);
      lengths_[static_cast<size_t>(d)] = ratio * ratio / (2.0f * kSpread * kSpread);
    }
    const int steady = FrameOf(segment.middle * stretch_);
    const int first = std::max(steady - band_, kShortest);
    const int last = std::min(steady + band_, static_cast<int>(count_));
    for (int t = first; t <= last; ++t) {
      float best = kInfinity;
      int from = -1;
      for (int d = kShortest; d <= std::min(longest, t); ++d) {
        const float before = cost_[static_cast<size_t>(t - d)];
        if (before >= best) {
          continue;
        }
        const float cost = before + lengths_[static_cast<size_t>(d)] + AnchorCost(segment, t - d) +
                           SoundCost(t - d, t);
        if (cost < best) {
          best = cost;
          from = t - d;
        }
      }
      next_[static_cast<size_t>(t)] = best;
      came_from_[i][static_cast<size_t>(t)] = from;
    }
  }

  void SumCosts(const Segment& segment) {
    for (size_t k = 0; k < kThirds; ++k) {
      std::vector<double>& sum = sums_[k];
      sum.assign(static_cast<size_t>(count_) + 1, 0.0);
      for (size_t t = 0; t < static_cast<size_t>(count_); ++t) {
        sum[t + 1] = sum[t] + static_cast<double>(Cost(frames_[t], segment.means[k]));
      }
    }
  }

  float SoundCost(int begin, int end) const {
    double cost = 0.0;
    int from = begin;
    for (int k = 0; k < kThirds; ++k) {
      const int to = begin + (k + 1) * (end - begin) / kThirds;
      cost += sums_[static_cast<size_t>(k)][static_cast<size_t>(to)] -
              sums_[static_cast<size_t>(k)][static_cast<size_t>(from)];
      from = to;
    }
    return static_cast<float>(cost);
  }

  static float AnchorCost(const Segment& segment, int begin) {
    if (!segment.begin) {
      return 0.0f;
    }
    const float away =
        static_cast<float>(begin - *segment.begin) * static_cast<float>(kFeatureStep) / kWordSpread;
    return std::min(0.5f * away * away, kWordWorst);
  }

  std::vector<int> Trace() const {
    if (!(cost_[static_cast<size_t>(count_)] < kInfinity)) {
      return {};
    }
    std::vector<int> boundaries(segments_.size() + 1);
    boundaries.back() = static_cast<int>(count_);
    for (size_t i = segments_.size(); i-- > 0;) {
      boundaries[i] = came_from_[i][static_cast<size_t>(boundaries[i + 1])];
    }
    return boundaries;
  }

  const std::vector<Segment>& segments_;
  const std::vector<Features>& frames_;
  float pace_;
  std::ptrdiff_t count_;
  double stretch_ = 1.0;
  int band_ = 0;
  std::vector<double> quiet_sum_;
  // Cost of all segments so far, by the frame at which the last one ends.
  std::vector<float> cost_;
  std::vector<float> next_;
  std::vector<std::vector<int>> came_from_;
  std::array<std::vector<double>, kThirds> sums_;
  std::vector<float> lengths_;
};

// Moves the means of each kind of sound towards the aligned frames.
void Adapt(const std::vector<Features>& frames,
           const std::vector<int>& boundaries,
           const std::vector<std::array<Features, kThirds>>& first_means,
           std::vector<Segment>& segments) {
  struct Heard {
    Features sum = {};
    float count = 0.0f;
  };
  std::map<std::string, std::array<Heard, kThirds>> heard;
  for (size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].ipa.empty()) {
      continue;
    }
    for (int k = 0; k < kThirds; ++k) {
      Heard& of_sound = heard[segments[i].ipa][static_cast<size_t>(k)];
      for (const Features& frame : Third(frames, boundaries[i], boundaries[i + 1], k)) {
        for (size_t f = 0; f < kFeatureCount; ++f) {
          of_sound.sum[f] += frame[f];
        }
        of_sound.count += 1.0f;
      }
    }
  }
  for (size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].ipa.empty()) {
      continue;
    }
    for (size_t k = 0; k < kThirds; ++k) {
      const Heard& of_sound = heard[segments[i].ipa][k];
      for (size_t f = 0; f < kFeatureCount; ++f) {
        segments[i].means[k][f] =
            (kAdaptation * first_means[i][k][f] + of_sound.sum[f]) / (kAdaptation + of_sound.count);
      }
    }
  }
}

std::vector<Phoneme> PhonemesOf(const std::vector<Segment>& segments,
                                const std::vector<int>& boundaries,
                                double duration) {
  std::vector<Phoneme> phonemes;
  for (size_t i = 0; i < segments.size(); ++i) {
    if (boundaries[i + 1] > boundaries[i]) {
      phonemes.push_back({segments[i].ipa, boundaries[i] * kFeatureStep,
                          boundaries[i + 1] * kFeatureStep, segments[i].word});
    }
  }
  phonemes.back().end = duration;
  return phonemes;
}

}  // namespace

Result<std::vector<Phoneme>> AlignSpeech(const Sound& recording,
                                         const SpokenText& reference,
                                         const WordTimes& words) {
  const bool silent = std::all_of(recording.samples.begin(), recording.samples.end(),
                                  [](float sample) { return std::abs(sample) < kSilence; });
  if (silent) {
    return Status::Error("speech", "the recording is silent", "record the line again");
  }
  std::vector<float> spoken;
  for (const int16_t sample : reference.samples) {
    spoken.push_back(static_cast<float>(sample) / 32768.0f);
  }
  // Both need the same sample rate to have the same bands.
  const int rate = std::min(recording.rate, reference.rate);
  const Voice reference_voice = Listen(Resample(spoken, reference.rate, rate), rate);
  const Voice voice = Listen(Resample(recording.samples, recording.rate, rate), rate);
  std::vector<Segment> segments = MakeSegments(reference, reference_voice);
  const auto sounds = std::count_if(segments.begin(), segments.end(),
                                    [](const Segment& segment) { return !segment.ipa.empty(); });
  if (std::ssize(voice.frames) < kShortest * sounds) {
    return Status::Error("speech", "the recording is too short for its text",
                         "check that it is the recording of this line");
  }
  AnchorWords(words, segments);
  std::vector<std::array<Features, kThirds>> first_means;
  for (const Segment& segment : segments) {
    first_means.push_back(segment.means);
  }
  const float pace = static_cast<float>(std::max(voice.loud_frames, 1)) /
                     static_cast<float>(std::max(reference_voice.loud_frames, 1));
  const Features quiet = QuietestFrames(voice.frames);
  std::vector<int> boundaries;
  for (int round = 0; round < kRounds; ++round) {
    Search search(segments, voice.frames, quiet, pace, reference.duration());
    boundaries = search.Run();
    if (boundaries.empty()) {
      return Status::Error("speech", "the text cannot be found in the recording",
                           "check that it is the recording of this line");
    }
    Adapt(voice.frames, boundaries, first_means, segments);
  }
  return PhonemesOf(segments, boundaries, recording.duration());
}

}  // namespace lararium::bake
