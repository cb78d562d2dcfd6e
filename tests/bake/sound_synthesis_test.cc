#include "editor/bake/sound_synthesis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace lararium::bake {
namespace {

double RmsDb(std::span<const float> samples) {
  double sum = 0.0;
  for (const float sample : samples) {
    sum += static_cast<double>(sample) * static_cast<double>(sample);
  }
  return 10.0 * std::log10(sum / static_cast<double>(samples.size()) + 1e-20);
}

// Power at a frequency (Goertzel), averaged over pieces of 4096 samples.
double PowerAt(const Sound& sound, double hertz) {
  constexpr size_t kPiece = 4096;
  const double w = 2.0 * std::numbers::pi * hertz / sound.rate;
  double power = 0.0;
  size_t pieces = 0;
  for (size_t begin = 0; begin + kPiece <= sound.samples.size(); begin += kPiece, ++pieces) {
    double re = 0.0, im = 0.0;
    for (size_t i = 0; i < kPiece; ++i) {
      const double window =
          0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / kPiece);
      const double x = window * static_cast<double>(sound.samples[begin + i]);
      re += x * std::cos(w * static_cast<double>(i));
      im += x * std::sin(w * static_cast<double>(i));
    }
    power += re * re + im * im;
  }
  return power / static_cast<double>(pieces);
}

TEST(SynthesizeSound, EverySoundIsTheSameEachTimeAndHasItsLevel) {
  for (const BuiltInSound& built_in : BuiltInSounds()) {
    const Sound sound = SynthesizeSound(built_in.name);
    EXPECT_EQ(sound.rate, 48'000);
    EXPECT_EQ(sound.samples, SynthesizeSound(built_in.name).samples) << built_in.name;
    // Softer than speech, and no peak near full scale.
    EXPECT_LT(RmsDb(sound.samples), -25.0) << built_in.name;
    EXPECT_GT(RmsDb(sound.samples), -60.0) << built_in.name;
    for (const float sample : sound.samples) {
      ASSERT_LE(std::abs(sample), 0.71f) << built_in.name;
    }
  }
}

TEST(SynthesizeSound, NamesAreUniqueAndInOrder) {
  std::set<std::string_view> names;
  for (const BuiltInSound& sound : BuiltInSounds()) {
    EXPECT_TRUE(names.empty() || *names.rbegin() < sound.name);
    EXPECT_TRUE(names.insert(sound.name).second);
  }
  EXPECT_GE(names.size(), 7u);
}

// The restart of a loop is inaudible: the step there is as small as any other.
TEST(SynthesizeSound, LoopsHaveNoSeam) {
  for (const BuiltInSound& built_in : BuiltInSounds()) {
    if (!built_in.loops) {
      continue;
    }
    const std::vector<float> samples = SynthesizeSound(built_in.name).samples;
    std::vector<float> steps;
    for (size_t i = 1; i < samples.size(); ++i) {
      steps.push_back(std::abs(samples[i] - samples[i - 1]));
    }
    const float seam = std::abs(samples.front() - samples.back());
    const auto usual = steps.begin() + static_cast<std::ptrdiff_t>(0.999 * steps.size());
    std::nth_element(steps.begin(), usual, steps.end());
    EXPECT_LE(seam, *usual) << built_in.name;
    // The level continues too.
    const std::span all(samples);
    EXPECT_NEAR(RmsDb(all.first(24'000)), RmsDb(all.last(24'000)), 8.0) << built_in.name;
  }
}

// Bubbles of 0.4 to 6 mm ring from 540 Hz up (Minnaert); most of the sound is there.
TEST(SynthesizeSound, PouredLiquidSingsWhereItsBubblesDo) {
  const Sound pour = SynthesizeSound("pour");
  double low = 0.0, middle = 0.0;
  for (double hertz = 60.0; hertz < 400.0; hertz += 20.0) {
    low += PowerAt(pour, hertz);
  }
  for (double hertz = 600.0; hertz < 2000.0; hertz += 20.0) {
    middle += PowerAt(pour, hertz);
  }
  EXPECT_GT(middle, 20.0 * low);
}

// Distant speech has the formants of voices, but no high frequencies.
TEST(SynthesizeSound, AStreetIsAsDullAsItIsFar) {
  const Sound street = SynthesizeSound("street");
  EXPECT_GT(PowerAt(street, 500.0), 100.0 * PowerAt(street, 6000.0));
}

// Bursts are short and loud compared with the burning.
TEST(SynthesizeSound, AFireCrackles) {
  const Sound fire = SynthesizeSound("brazier");
  float peak = 0.0f;
  for (const float sample : fire.samples) {
    peak = std::max(peak, std::abs(sample));
  }
  EXPECT_GT(20.0 * std::log10(static_cast<double>(peak)) - RmsDb(fire.samples), 20.0);
}

}  // namespace
}  // namespace lararium::bake
