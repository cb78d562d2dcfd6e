#pragma once

// Speech, feelings and blinks on a face.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/ease.h"
#include "shared/core/status.h"
#include "shared/human/skeleton.h"

namespace lararium::human {

struct Human;

// The common set of fifteen: sil PP FF TH DD kk CH SS nn RR aa E ih oh ou.
enum class Viseme : uint8_t {
  kSil,
  kPP,
  kFF,
  kTH,
  kDD,
  kKk,
  kCH,
  kSS,
  kNn,
  kRR,
  kAa,
  kE,
  kIh,
  kOh,
  kOu
};
inline constexpr int kVisemeCount = 15;
std::optional<Viseme> VisemeNamed(std::string_view name);
std::string_view NameOf(Viseme viseme);

enum class Expression : uint8_t { kNeutral, kJoy, kSadness, kAnger, kFear, kDisgust, kSurprise };
inline constexpr int kExpressionCount = 7;
std::optional<Expression> ExpressionNamed(std::string_view name);
std::string_view NameOf(Expression expression);

// What a mouth does while something is said.
struct VisemeTrack {
  struct Key {
    float time = 0.0f;  // seconds; it lasts until the next key
    Viseme viseme = Viseme::kSil;
    float strength = 1.0f;  // 0..1
  };
  std::vector<Key> keys;  // ascending in time
  float duration = 0.0f;  // seconds; where the last key ends

  Status Validate(const std::string& place) const;
};

// The share of each viseme at a time, each 0..1, together at most 1: neighbours
// run into one another by dominance functions (Cohen & Massaro, Modeling
// Coarticulation in Synthetic Visual Speech, 1993). A pure function of time.
std::array<float, kVisemeCount> SampleVisemes(const VisemeTrack& track, double time);

// All that a face remembers; plain values.
struct Face {
  std::array<float, kVisemeCount> visemes = {};  // set before each update
  std::array<float, kVisemeCount> mouth = {};    // shown: follows within hundredths of a second
  std::array<float, kExpressionCount> expressions = {};  // shown
  std::array<float, kExpressionCount> goals = {};        // what they go to
  float change_per_second = 2.0f;
  // Where the change is eased: what it goes from, and how far it is.
  std::array<float, kExpressionCount> from = {};
  float changed_for = 0.0f;  // seconds
  Ease ease = Ease::kLinear;

  friend bool operator==(const Face&, const Face&) = default;
};

// Goes to one expression of an intensity 0..1 over so many seconds.
void SetExpression(
    Face& face, Expression expression, float intensity, float seconds, Ease ease = Ease::kLinear);
void UpdateFace(Face& face, float seconds);
Face Interpolate(const Face& previous, const Face& current, float alpha);

// What a face knows of one person; build once.
struct FaceModel {
  static constexpr int kNone = -1;

  std::array<int, kVisemeCount> visemes;  // indices into Human::face
  std::array<int, kExpressionCount> expressions;
  std::array<int, 2> blinks;       // by side: right, left
  std::vector<float> mouth_share;  // of each morph: how much of its motion is the mouth's
};
FaceModel MakeFaceModel(const Human& human);

// Weights of the shapes of Human::face, and of the morphs they add up to. Speech takes
// the mouth: an expression's morphs give way as far as they move what visemes move.
// lids: 0 open .. 1 closed.
void ComputeFaceWeights(const FaceModel& model,
                        const Human& human,
                        const Face& face,
                        float lids,
                        std::span<float> shape_weights,
                        std::span<float> morph_weights);

// Turns jaw, lids and whatever else shapes turn.
void ApplyFaceTurns(const Human& human,
                    std::span<const float> shape_weights,
                    std::span<JointTransform> pose);

}  // namespace lararium::human
