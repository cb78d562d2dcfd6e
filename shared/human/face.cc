#include "shared/human/face.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/human/human.h"
#include "shared/human/turns.h"

namespace lararium::human {
namespace {

constexpr std::array<std::string_view, kVisemeCount> kVisemeNames = {
    "sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"};
constexpr std::array<std::string_view, kExpressionCount> kExpressionNames = {
    "neutral", "joy", "sadness", "anger", "fear", "disgust", "surprise"};

// Dominance of each viseme: lips must close for PP and touch the teeth for FF, while shapes of
// tongue and palate are hardly visible. The values are ours, in the order of Cohen & Massaro's
// magnitudes.
constexpr std::array<float, kVisemeCount> kDominance = {
    0.7f, 3.0f, 2.4f, 1.4f, 1.0f, 0.7f, 1.8f, 1.2f, 0.8f, 1.1f, 1.3f, 1.2f, 1.0f, 1.5f, 1.7f};
constexpr float kSpread = 0.055f;  // Seconds in which dominance falls to 1/e.
// A segment is fully dominant except at its two ends: the share of its duration that each end
// takes, and the upper limit in seconds.
constexpr float kEdgeShare = 0.2f;
constexpr float kLongestEdge = 0.04f;
constexpr float kWindow = 0.35f;  // Seconds beyond which a segment has no influence.

template <size_t N>
std::optional<size_t> IndexOf(const std::array<std::string_view, N>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt
                              : std::optional(static_cast<size_t>(found - names.begin()));
}

// Weighs segments of speech by their dominance at one moment.
class Coarticulation {
 public:
  explicit Coarticulation(float time) : time_(time) {}

  void Add(Viseme viseme, float strength, float begin, float end) {
    const size_t v = static_cast<size_t>(viseme);
    const float middle = 0.5f * (begin + end);
    const float length = end - begin;
    const float full = 0.5f * length - std::min(kEdgeShare * length, kLongestEdge);
    const float away = std::max(std::abs(time_ - middle) - full, 0.0f);
    const float dominance = kDominance[v] * std::exp(-away / kSpread);
    sum_ += dominance;
    shares_[v] += dominance * strength;
  }

  std::array<float, kVisemeCount> Shares() const {
    std::array<float, kVisemeCount> shares = shares_;
    for (float& share : shares) {
      share /= std::max(sum_, 1e-12f);
    }
    return shares;
  }

 private:
  float time_;
  float sum_ = 0.0f;
  std::array<float, kVisemeCount> shares_ = {};
};

int FindShape(const Human& human, std::string_view name) {
  const auto found = std::find_if(human.face.begin(), human.face.end(),
                                  [name](const FaceShape& shape) { return shape.name == name; });
  return found == human.face.end() ? FaceModel::kNone
                                   : static_cast<int>(found - human.face.begin());
}

// How far visemes move each vertex of each mesh, metres.
using Motion = std::vector<std::vector<float>>;
Motion MouthMotion(const Human& human, const FaceModel& model) {
  Motion motion;
  for (const SkinnedMesh& mesh : human.meshes) {
    motion.emplace_back(mesh.positions.size(), 0.0f);
  }
  for (const int shape : model.visemes) {
    if (shape == FaceModel::kNone) {
      continue;
    }
    for (const FaceShape::Morph& part : human.face[static_cast<size_t>(shape)].morphs) {
      for (const MorphTarget::Part& mesh : human.morphs[part.morph].parts) {
        for (size_t i = 0; i < mesh.vertices.size(); ++i) {
          float& moved = motion[mesh.mesh][mesh.vertices[i]];
          moved = std::max(moved, std::abs(part.weight) * glm::length(mesh.position_deltas[i]));
        }
      }
    }
  }
  return motion;
}

// Returns the share of a morph's motion that is at vertices that speech moves.
float MouthShare(const MorphTarget& morph, const Motion& mouth) {
  constexpr float kMoved = 0.002f;  // metres that count as clear motion of the mouth
  float inside = 0.0f, all = 0.0f;
  for (const MorphTarget::Part& part : morph.parts) {
    for (size_t i = 0; i < part.vertices.size(); ++i) {
      const float length = glm::length(part.position_deltas[i]);
      all += length;
      inside += length * std::min(mouth[part.mesh][part.vertices[i]] / kMoved, 1.0f);
    }
  }
  return all > 0.0f ? inside / all : 0.0f;
}

}  // namespace

std::optional<Viseme> VisemeNamed(std::string_view name) {
  const auto index = IndexOf(kVisemeNames, name);
  return index ? std::optional(static_cast<Viseme>(*index)) : std::nullopt;
}

std::string_view NameOf(Viseme viseme) { return kVisemeNames[static_cast<size_t>(viseme)]; }

std::optional<Expression> ExpressionNamed(std::string_view name) {
  const auto index = IndexOf(kExpressionNames, name);
  return index ? std::optional(static_cast<Expression>(*index)) : std::nullopt;
}

std::string_view NameOf(Expression expression) {
  return kExpressionNames[static_cast<size_t>(expression)];
}

Status VisemeTrack::Validate(const std::string& where) const {
  float before = 0.0f;
  for (size_t i = 0; i < keys.size(); ++i) {
    const std::string key = where + ": viseme " + std::to_string(i);
    if (static_cast<int>(keys[i].viseme) >= kVisemeCount) {
      return Status::Error(key, "it is not one of the fifteen visemes");
    }
    if (!(keys[i].time >= before) || !(keys[i].time <= duration)) {
      return Status::Error(key, "its time is not between its neighbours'");
    }
    if (!(keys[i].strength >= 0.0f && keys[i].strength <= 1.0f)) {
      return Status::Error(key, "its strength is not in 0..1");
    }
    before = keys[i].time;
  }
  if (!std::isfinite(duration) || duration < 0.0f) {
    return Status::Error(where, "the duration of the visemes is not valid");
  }
  return Status();
}

std::array<float, kVisemeCount> SampleVisemes(const VisemeTrack& track, double time) {
  // Before and after the track there is silence.
  const float now =
      static_cast<float>(std::clamp(time, -1.0, static_cast<double>(track.duration) + 1.0));
  const float begin = track.keys.empty() ? track.duration : track.keys.front().time;
  Coarticulation mix(now);
  mix.Add(Viseme::kSil, 1.0f, std::min(begin, now) - 1.0f, begin);
  mix.Add(Viseme::kSil, 1.0f, track.duration, std::max(track.duration, now) + 1.0f);
  auto key = std::lower_bound(track.keys.begin(), track.keys.end(), now - kWindow,
                              [](const VisemeTrack::Key& k, float t) { return k.time < t; });
  key -= key != track.keys.begin() ? 1 : 0;  // The key before may last until now.
  for (; key != track.keys.end() && key->time < now + kWindow; ++key) {
    const float end = key + 1 == track.keys.end() ? track.duration : (key + 1)->time;
    mix.Add(key->viseme, key->strength, key->time, end);
  }
  return mix.Shares();
}

void SetExpression(Face& face, Expression expression, float intensity, float seconds, Ease ease) {
  face.goals = {};
  face.goals[static_cast<size_t>(expression)] = std::clamp(intensity, 0.0f, 1.0f);
  face.change_per_second = seconds > 0.0f ? 1.0f / seconds : 1e6f;
  face.from = face.expressions;
  face.changed_for = 0.0f;
  face.ease = ease;
}

void UpdateFace(Face& face, float seconds) {
  // Limits the speed, so that the mouth does not jump when speech begins or stops.
  constexpr float kMouthPerSecond = 18.0f;
  for (size_t i = 0; i < face.visemes.size(); ++i) {
    const float step = kMouthPerSecond * seconds;
    face.mouth[i] += std::clamp(face.visemes[i] - face.mouth[i], -step, step);
  }
  if (face.ease != Ease::kLinear) {
    face.changed_for += seconds;
    const float time = std::min(face.changed_for * face.change_per_second, 1.0f);
    const auto way = static_cast<float>(Eased(face.ease, time));
    for (size_t i = 0; i < face.goals.size(); ++i) {
      face.expressions[i] = glm::mix(face.from[i], face.goals[i], way);
    }
    return;
  }
  const float most = seconds * face.change_per_second;
  for (size_t i = 0; i < face.goals.size(); ++i) {
    face.expressions[i] += std::clamp(face.goals[i] - face.expressions[i], -most, most);
  }
}

Face Interpolate(const Face& previous, const Face& current, float alpha) {
  Face mixed = current;
  for (size_t i = 0; i < mixed.mouth.size(); ++i) {
    mixed.mouth[i] = glm::mix(previous.mouth[i], current.mouth[i], alpha);
  }
  for (size_t i = 0; i < mixed.expressions.size(); ++i) {
    mixed.expressions[i] = glm::mix(previous.expressions[i], current.expressions[i], alpha);
  }
  return mixed;
}

FaceModel MakeFaceModel(const Human& human) {
  FaceModel model;
  for (size_t i = 0; i < model.visemes.size(); ++i) {
    model.visemes[i] = FindShape(human, kVisemeNames[i]);
  }
  for (size_t i = 0; i < model.expressions.size(); ++i) {
    model.expressions[i] = FindShape(human, kExpressionNames[i]);
  }
  model.blinks = {FindShape(human, "blink_r"), FindShape(human, "blink_l")};
  const Motion mouth = MouthMotion(human, model);
  for (const MorphTarget& morph : human.morphs) {
    model.mouth_share.push_back(MouthShare(morph, mouth));
  }
  return model;
}

void ComputeFaceWeights(const FaceModel& model,
                        const Human& human,
                        const Face& face,
                        float lids,
                        std::span<float> shape_weights,
                        std::span<float> morph_weights) {
  CHECK(shape_weights.size() == human.face.size() && morph_weights.size() == human.morphs.size());
  std::fill(shape_weights.begin(), shape_weights.end(), 0.0f);
  std::fill(morph_weights.begin(), morph_weights.end(), 0.0f);
  const auto show = [&](int index, float weight, float mouth_taken) {
    if (index == FaceModel::kNone || weight <= 0.0f) {
      return;
    }
    const FaceShape& shape = human.face[static_cast<size_t>(index)];
    shape_weights[static_cast<size_t>(index)] += weight;
    for (const FaceShape::Morph& part : shape.morphs) {
      morph_weights[part.morph] +=
          weight * part.weight * (1.0f - mouth_taken * model.mouth_share[part.morph]);
    }
  };
  float speech = 0.0f;
  for (size_t i = 0; i < face.mouth.size(); ++i) {
    show(model.visemes[i], face.mouth[i], 0.0f);
    speech += static_cast<Viseme>(i) == Viseme::kSil ? 0.0f : face.mouth[i];
  }
  for (size_t i = 0; i < face.expressions.size(); ++i) {
    show(model.expressions[i], face.expressions[i], std::min(speech, 1.0f));
  }
  for (const int blink : model.blinks) {
    show(blink, lids, 0.0f);
  }
}

void ApplyFaceTurns(const Human& human,
                    std::span<const float> shape_weights,
                    std::span<JointTransform> pose) {
  for (size_t i = 0; i < human.face.size(); ++i) {
    if (shape_weights[i] <= 1e-4f) {
      continue;
    }
    for (const FaceShape::Turn& turn : human.face[i].turns) {
      glm::quat& rotation = pose[turn.joint].rotation;
      rotation = glm::normalize(rotation * Share(turn.rotation, std::min(shape_weights[i], 1.0f)));
    }
  }
}

}  // namespace lararium::human
