#pragma once

// Speech, expressions and blinks of a face.

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

// The common set of fifteen visemes: sil PP FF TH DD kk CH SS nn RR aa E ih oh ou.
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

// The mouth shapes of a spoken line over time.
struct VisemeTrack {
  struct Key {
    float time = 0.0f;  // seconds; the key lasts until the next one
    Viseme viseme = Viseme::kSil;
    float strength = 1.0f;  // 0..1
  };
  std::vector<Key> keys;  // ascending in time
  float duration = 0.0f;  // seconds; the last key ends here

  Status Validate(const std::string& where) const;
};

// Returns the share of each viseme at a time, each 0..1 and together at most 1. Neighbouring
// visemes overlap by dominance functions (Cohen & Massaro, Modeling Coarticulation in Synthetic
// Visual Speech, 1993). A pure function of time.
std::array<float, kVisemeCount> SampleVisemes(const VisemeTrack& track, double time);

// The complete state of a face, as plain values.
struct Face {
  std::array<float, kVisemeCount> visemes = {};  // Target shares; set them before each update.
  // Shares shown; they follow `visemes` within hundredths of a second.
  std::array<float, kVisemeCount> mouth = {};
  std::array<float, kExpressionCount> expressions = {};  // Intensities shown.
  std::array<float, kExpressionCount> goals = {};  // Intensities that `expressions` moves towards.
  float change_per_second = 2.0f;
  // For an eased change: the intensities at its start, and how long it has run.
  std::array<float, kExpressionCount> from = {};
  float changed_for = 0.0f;  // seconds
  Ease ease = Ease::kLinear;

  friend bool operator==(const Face&, const Face&) = default;
};

// Moves to one expression at an intensity 0..1 within the given number of seconds.
void SetExpression(
    Face& face, Expression expression, float intensity, float seconds, Ease ease = Ease::kLinear);
void UpdateFace(Face& face, float seconds);
Face Interpolate(const Face& previous, const Face& current, float alpha);

// Constants of one person's face; build once.
struct FaceModel {
  static constexpr int kNone = -1;

  std::array<int, kVisemeCount> visemes;  // indices into Human::face
  std::array<int, kExpressionCount> expressions;
  std::array<int, 2> blinks;  // index: side (kRight, kLeft)
  // For each morph: the share of its motion that is near the mouth.
  std::vector<float> mouth_share;  // Share of each morph's motion that visemes move too.
};
FaceModel MakeFaceModel(const Human& human);

// Computes the weights of the shapes of Human::face and of the morphs that they combine. Speech has
// priority at the mouth: an expression's morph is reduced by the share of its motion that visemes
// also move. lids: 0 is open, 1 is closed.
void ComputeFaceWeights(const FaceModel& model,
                        const Human& human,
                        const Face& face,
                        float lids,
                        std::span<float> shape_weights,
                        std::span<float> morph_weights);

// Turns the joints that shapes turn, such as jaw and lids.
void ApplyFaceTurns(const Human& human,
                    std::span<const float> shape_weights,
                    std::span<JointTransform> pose);

}  // namespace lararium::human
