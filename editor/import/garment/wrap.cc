#include "editor/import/garment/wrap.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "editor/import/garment/drape.h"
#include "editor/import/garment/girdle.h"
#include "editor/import/garment/skin_weights.h"
#include "shared/core/random.h"

namespace lararium::import {
namespace {

constexpr float kPi = glm::pi<float>();
// Angles about the body's axis, as Girth's: 0 back, then right, front and left.
constexpr float kRight = 0.5f * kPi;
constexpr float kFrontAngle = kPi;
constexpr float kLeft = 1.5f * kPi;

std::vector<const Sheet*> SheetsOf(std::span<const DrapedGarment> worn) {
  std::vector<const Sheet*> sheets;
  for (const DrapedGarment& garment : worn) {
    sheets.push_back(&garment.sheet);
  }
  return sheets;
}

// The dressed body as cloth lies round it: convex at every height, and hanging.
class Outline {
 public:
  // arms: of which sides they are wrapped in.
  Outline(const FittedBody& body,
          const PosedBody& posed,
          std::span<const Sheet* const> worn,
          bool left_arm) {
    const std::vector<float> arm = ArmShare(body);
    const std::vector<float> head = HeadShare(body);
    const std::vector<bool> is_body = IsBody(body);
    std::vector<std::vector<glm::vec2>> slabs;
    const auto add = [&](const glm::vec3& p) {
      const size_t level = static_cast<size_t>(std::max(0.0f, p.y) / kLevel);
      slabs.resize(std::max(slabs.size(), level + 2));
      for (size_t at = level > 0 ? level - 1 : 0; at <= level + 1; ++at) {
        slabs[at].emplace_back(p.x, p.z);
      }
    };
    for (size_t v = 0; v < posed.positions.size(); ++v) {
      const bool wrapped_arm = left_arm && body.base.positions[v].x < 0.0f && !posed.forearm[v];
      if (is_body[v] && head[v] < 0.5f && (arm[v] < 0.3f || wrapped_arm)) {
        add(posed.positions[v]);
      }
    }
    const float free_side = JointPlace(body, posed, "r_shoulder").x;
    const glm::vec3 waist = JointPlace(body, posed, "vl1");
    for (const Sheet* sheet : worn) {
      for (const glm::vec3& p : sheet->positions) {
        if (p.x < (p.y > waist.y - 0.1f ? 0.8f : 1.1f) * free_side) {
          add(p);
        }
      }
    }
    middle_ = {0.0f, waist.z - 0.02f};
    for (std::vector<glm::vec2>& slab : slabs) {
      radius_.push_back(slab.empty() ? std::vector<float>(kAngles, 0.0f)
                                     : HullRadius(slab, middle_, kAngles));
    }
  }

  float Radius(float angle, float height) const {
    const float level = std::clamp(height / kLevel - 0.5f, 0.0f, float(radius_.size() - 1) - 0.01f);
    const size_t at = static_cast<size_t>(level);
    return glm::mix(AtLevel(at, angle), AtLevel(at + 1, angle), level - float(at));
  }
  // Cloth that hangs from a height: it leans in but little below what it lies on.
  float Hanging(float angle, float from, float height) const {
    float radius = 0.0f;
    for (float y = from; y > height - 1e-4f; y -= kLevel) {
      radius = std::max(Radius(angle, y), radius - 0.22f * kLevel);
    }
    return radius;
  }
  glm::vec3 Place(float angle, float radius, float height) const {
    return {middle_.x + radius * std::sin(angle), height, middle_.y + radius * std::cos(angle)};
  }

 private:
  static constexpr float kLevel = 0.02f;
  static constexpr int kAngles = 72;

  float AtLevel(size_t level, float angle) const {
    float turn = angle / glm::two_pi<float>();
    turn = (turn - std::floor(turn)) * kAngles;
    const int k = static_cast<int>(turn) % kAngles;
    const std::vector<float>& radius = radius_[level];
    return glm::mix(radius[k], radius[(k + 1) % kAngles], turn - std::floor(turn));
  }

  glm::vec2 middle_ = glm::vec2(0.0f);
  std::vector<std::vector<float>> radius_;
};

// A curve through points at rising angles, with smooth steps between them.
struct Knot {
  float angle;
  float height;
};
float HeightAt(std::span<const Knot> knots, float angle) {
  for (size_t k = 1; k < knots.size(); ++k) {
    if (angle <= knots[k].angle || k + 1 == knots.size()) {
      const float f = std::clamp(
          (angle - knots[k - 1].angle) / (knots[k].angle - knots[k - 1].angle), 0.0f, 1.0f);
      return glm::mix(knots[k - 1].height, knots[k].height, f * f * (3.0f - 2.0f * f));
    }
  }
  return knots[0].height;
}

class MantleDraper {
 public:
  MantleDraper(const GarmentPattern& pattern,
               const FittedBody& body,
               std::span<const DrapedGarment> worn)
      : pattern_(pattern),
        body_(body),
        standing_(PoseBody(body, StandingTurns(body, 1.0f))),
        worn_(SheetsOf(worn)),
        outline_(body, standing_, worn_, true),
        toga_(pattern.kind == GarmentKind::kToga),
        scale_(body.height / 1.7f) {
    const auto y = [&](const char* joint) { return JointPlace(body_, standing_, joint).y; };
    hem_ = pattern.hem < 1.0f ? glm::mix(y("r_hip"), y("r_knee"), pattern.hem)
                              : glm::mix(y("r_knee"), 0.0f, pattern.hem - 1.0f);
    shoulder_ = ShoulderTop() + 0.012f;
    hip_ = y("r_hip");
    const float waist = y("vl1");
    const float chest = y("vt4");
    upper_ = {{-0.72f * kPi, glm::mix(chest, shoulder_, 0.35f)},
              {-0.5f * kPi, shoulder_ - 0.012f},
              {-0.2f * kPi, glm::mix(chest, shoulder_, 0.75f)},
              {0.15f * kPi, glm::mix(chest, waist, 0.0f)},
              {kRight, glm::mix(chest, waist, toga_ ? 0.85f : 0.5f)},
              {0.8f * kPi, glm::mix(chest, waist, toga_ ? 0.55f : 0.2f)},
              {1.2f * kPi, glm::mix(chest, shoulder_, 0.45f)},
              {kLeft, shoulder_ + 0.008f},
              {1.75f * kPi, shoulder_ - 0.03f * scale_}};
  }

  DrapedGarment Drape() {
    LayRound();
    if (toga_) {
      LaySinus();
    }
    DrapeMaterial material;
    material.gap = 0.012f;
    material.own_gap = 0.018f;
    material.bend = 0.02f;
    material.friction = 0.8f;
    DrapedGarment result;
    Settle(material, 110, 0.0125f);
    const std::vector<float> distances =
        TakeWeights(body_, standing_, WeightSource::kMantle, sheet_);
    SmoothWeights(sheet_, 8, distances);
    result.coarse_particles = sheet_.positions.size();
    result.coarse_triangles = sheet_.ParticleTriangles();
    std::vector<std::array<uint32_t, 2>> parents;
    sheet_ = Subdivided(sheet_, &parents);
    std::vector<bool> held;
    for (const auto& [a, b] : parents) {
      held.push_back(held_[a] && held_[b]);
    }
    held_ = std::move(held);
    material.own_gap = 0.010f;
    Settle(material, 60, 0.01f);
    Finish(result);
    return result;
  }

 private:
  static constexpr float kFirst = -0.70f * kPi;
  static constexpr float kLast = 1.78f * kPi;

  // Of the left shoulder, half way to the neck.
  float ShoulderTop() const {
    const float side = 0.55f * JointPlace(body_, standing_, "l_shoulder").x;
    const std::vector<float> head = HeadShare(body_);
    const std::vector<bool> is_body = IsBody(body_);
    float top = 0.0f;
    for (size_t v = 0; v < standing_.positions.size(); ++v) {
      const glm::vec3& p = standing_.positions[v];
      if (is_body[v] && head[v] < 0.5f && std::abs(p.x - side) < 0.012f) {
        top = std::max(top, p.y);
      }
    }
    return top;
  }

  // The first turn lies below the second.
  float Layer(float angle) const {
    return 0.016f + 0.018f * std::clamp((angle + kPi) / (2.2f * kPi), 0.0f, 1.0f);
  }

  // Folds that run down from the shoulder: deeper below, and where much is gathered.
  float Fold(float along, float down) const {
    const float wave = std::sin(along) + 0.6f * std::sin(1.73f * along + 1.1f) +
                       0.4f * std::sin(2.9f * along + 2.3f);
    return (0.006f + 0.016f * down) * wave;
  }

  // Where the hem is cut away: it rises towards the ends, which the semicircle's corners
  // are.
  float Hem(float angle) const {
    const float rise_front = 1.0f - glm::smoothstep(-0.70f * kPi, -0.45f * kPi, angle);
    const float rise_back = glm::smoothstep(1.4f * kPi, 1.78f * kPi, angle);
    const float left_hand = std::exp(-std::pow((angle - kLeft) / 0.5f, 2.0f)) +
                            std::exp(-std::pow((angle + 0.5f * kPi) / 0.5f, 2.0f));
    return hem_ + scale_ * ((toga_ ? -0.04f : 0.10f) * rise_front + 0.25f * rise_back +
                            (toga_ ? 0.0f : 0.05f) * left_hand);
  }

  void LayRound() {
    Random random(pattern_.seed, 3);
    GridPanel grid;
    grid.columns = 58;
    grid.rows = 19;
    const auto angle_of = [&](size_t column) {
      return glm::mix(kFirst, kLast, float(column) / float(grid.columns - 1));
    };
    grid.flat = [&](size_t column, size_t row) {
      return glm::vec2(0.055f * scale_ * float(column), 0.06f * scale_ * float(row));
    };
    grid.place = [&](size_t column, size_t row) {
      const float angle = angle_of(column);
      const float top = HeightAt(upper_, angle);
      const float down = float(row) / float(grid.rows - 1);
      const float height = glm::mix(top, Hem(angle), down);
      const float radius = outline_.Hanging(angle, top, height) + Layer(angle) +
                           Fold(5.5f * angle + 0.8f * down, down) + 0.01f * down +
                           0.002f * float(random.Normal());
      return outline_.Place(angle + 0.015f * std::sin(9.0f * angle), radius, height);
    };
    const uint32_t first = AddPanel(sheet_, grid, 0);
    held_.assign(sheet_.positions.size(), false);
    for (size_t c = 0; c < grid.columns; ++c) {
      held_[first + c] = true;
    }
  }

  // Rows from the balteus down to the bow's lowest edge: they all come from the left
  // shoulder and go behind the right hip.
  void LaySinus() {
    Random random(pattern_.seed, 4);
    GridPanel grid;
    grid.columns = 30;
    grid.rows = 11;
    const float knee = JointPlace(body_, standing_, "r_knee").y;
    const auto angle_of = [&](size_t column) {
      return glm::mix(0.22f * kPi, kLeft + 0.12f, float(column) / float(grid.columns - 1));
    };
    grid.flat = [&](size_t column, size_t row) {
      return glm::vec2(0.05f * scale_ * float(column), 0.055f * scale_ * float(row));
    };
    grid.place = [&](size_t column, size_t row) {
      const float angle = angle_of(column);
      const float along = float(column) / float(grid.columns - 1);
      const float top = HeightAt(upper_, angle) + 0.012f;
      const float down = float(row) / float(grid.rows - 1);
      // The bow: deepest before the right thigh.
      const float bow = std::pow(std::max(0.0f, std::sin(kPi * std::pow(along, 0.8f))), 0.85f);
      const float deepest = HeightAt(upper_, 0.62f * kPi) - knee - 0.02f;
      const float height = top - down * (0.03f + bow * deepest);
      const float fold = (0.010f + 0.014f * bow) *
                         std::sin(11.0f * down + 2.2f * along + 0.7f * std::sin(5.0f * along));
      const float radius = outline_.Hanging(angle, top, height) + Layer(angle) + 0.030f +
                           0.02f * bow * down + fold + 0.0015f * float(random.Normal());
      return outline_.Place(angle, radius, height);
    };
    const uint32_t first = AddPanel(sheet_, grid, 1);
    held_.resize(sheet_.positions.size(), false);
    for (size_t c = 0; c < grid.columns; ++c) {
      held_[first + c] = true;
    }
    // Both ends are caught under what lies over them.
    for (size_t r = 0; r < grid.rows; ++r) {
      held_[first + r * grid.columns] = true;
      held_[first + r * grid.columns + grid.columns - 1] = true;
    }
  }

  void Settle(const DrapeMaterial& material, int steps, float cell) {
    const BodyField field = FieldOver(standing_, worn_, cell, 3.0f * cell);
    Draper draper(sheet_, material);
    draper.TakeLengths(1.035f);
    draper.gravity = 1.5f;
    draper.damping = 0.1f;
    draper.floor = true;
    for (uint32_t p = 0; p < sheet_.positions.size(); ++p) {
      if (held_[p]) {
        draper.pins.push_back({p, sheet_.positions[p], 0.5f});
      }
    }
    draper.Run(steps, field);
  }

  void Finish(DrapedGarment& result) {
    result.skin = standing_.skin;
    for (size_t p = 0; p < sheet_.positions.size(); ++p) {
      const float below = hip_ - 0.04f - sheet_.positions[p].y;
      result.reach.push_back(below <= 0.0f || held_[p] ? 0.0f : 0.02f + 0.5f * below);
    }
    const GarmentPattern pattern = pattern_;
    const float rows = 0.06f * scale_ * 18.0f;
    const float bow = 0.055f * scale_ * 10.0f;
    const float row = 0.03f * scale_;  // of the divided sheet
    MarkBands(sheet_, [&](uint8_t panel, const glm::vec2& middle) {
      return pattern.border && (panel == 0 ? rows : bow) - middle.y < 1.99f * row;
    });
    result.dye = [=](uint8_t panel, const glm::vec2& flat) {
      const bool is_wrap = (panel & ~kBand) == 0;
      const float from_hem = (is_wrap ? rows : bow) - flat.y;
      const float soil =
          is_wrap ? pattern.wear * std::clamp(1.0f - from_hem / 0.2f, 0.0f, 1.0f) : 0.0f;
      return ((panel & kBand) != 0 ? pattern.stripe_colour : pattern.colour) * (1.0f - 0.3f * soil);
    };
    result.covers_left_of = JointPlace(body_, standing_, "l_shoulder").x - 0.005f;
    result.covers_above = JointPlace(body_, standing_, "l_elbow").y - 0.05f;
    result.loose_margin = std::clamp(0.4f * hem_, 0.05f, 0.18f);
    if (toga_) {
      result.trims.push_back(RollBalteus());
    }
    result.sheet = std::move(sheet_);
  }

  // The rolled edge: a tube with twisted folds along the upper edge.
  Trim RollBalteus() const {
    Trim trim;
    trim.colour = pattern_.colour;
    GridPanel roll;
    roll.columns = 56;
    roll.rows = 15;
    roll.mirrored = false;
    const auto middle = [&](float along) {
      const float angle = glm::mix(0.1f * kPi, kLeft + 0.25f, along);
      const float top = HeightAt(upper_, angle);
      return outline_.Place(
          angle, outline_.Hanging(angle, top + 0.01f, top) + Layer(angle) + 0.034f, top + 0.004f);
    };
    roll.flat = [&](size_t column, size_t row) {
      return glm::vec2(0.025f * float(column), 0.012f * float(row));
    };
    roll.place = [&](size_t column, size_t row) {
      const float along = float(column) / float(roll.columns - 1);
      const float turn = glm::two_pi<float>() * float(row) / float(roll.rows - 1);
      const glm::vec3 at = middle(along);
      const glm::vec3 ahead = glm::normalize(middle(along + 0.01f) - middle(along - 0.01f));
      const glm::vec3 out = glm::normalize(glm::vec3(at.x, 0.0f, at.z) -
                                           ahead * glm::dot(ahead, glm::vec3(at.x, 0.0f, at.z)));
      const glm::vec3 up = glm::cross(ahead, out);
      const float ends = std::min(1.0f, 4.0f * std::min(along, 1.0f - along) + 0.12f);
      const float twist = 1.0f + 0.16f * std::sin(3.0f * turn + 26.0f * along) +
                          0.08f * std::sin(5.0f * turn - 17.0f * along + 1.0f);
      const float size = 0.030f * scale_ * ends * twist;
      return at + size * (0.75f * std::cos(turn) * out + 1.15f * std::sin(turn) * up);
    };
    const uint32_t first = AddPanel(trim.sheet, roll, 0);
    std::vector<std::array<uint32_t, 2>> seam;
    for (uint32_t c = 0; c < roll.columns; ++c) {
      seam.push_back({first + c, first + uint32_t(roll.rows - 1) * uint32_t(roll.columns) + c});
    }
    Sew(trim.sheet, seam);
    const std::vector<float> distances =
        TakeWeights(body_, standing_, WeightSource::kMantle, trim.sheet);
    SmoothWeights(trim.sheet, 6, distances);
    return trim;
  }

  const GarmentPattern pattern_;
  const FittedBody& body_;
  PosedBody standing_;
  std::vector<const Sheet*> worn_;
  Outline outline_;
  bool toga_;
  float scale_;
  float hem_ = 0.3f;
  float shoulder_ = 1.4f;
  float hip_ = 0.9f;
  std::vector<Knot> upper_;
  Sheet sheet_;
  std::vector<bool> held_;
};

}  // namespace

Result<DrapedGarment> DrapeMantle(const GarmentPattern& pattern,
                                  const FittedBody& body,
                                  std::span<const DrapedGarment> worn) {
  return MantleDraper(pattern, body, worn).Drape();
}

Result<DrapedGarment> DrapeApron(const GarmentPattern& pattern,
                                 const FittedBody& body,
                                 std::span<const DrapedGarment> worn) {
  const PosedBody standing = PoseBody(body, StandingTurns(body, 1.0f));
  const std::vector<const Sheet*> sheets = SheetsOf(worn);
  const Outline outline(body, standing, sheets, false);
  const auto y = [&](const char* joint) { return JointPlace(body, standing, joint).y; };
  const float hip = y("r_hip");
  const float hem = pattern.hem < 1.0f ? glm::mix(hip, y("r_knee"), pattern.hem)
                                       : glm::mix(y("r_knee"), 0.0f, pattern.hem - 1.0f);
  const float top = BeltHeight(pattern, body) - 0.03f;
  const float girth = Girth(body, standing, top, 0.03f).Length();
  const float half_turn = 0.40f * kPi;
  DrapedGarment result;
  Sheet sheet;
  Random random(pattern.seed, 5);
  GridPanel grid;
  grid.columns = 19;
  grid.rows = 1 + static_cast<size_t>(std::round((top - hem) / (0.042f * body.height / 1.7f)));
  const float width = 0.48f * girth;
  grid.flat = [&](size_t column, size_t row) {
    return glm::vec2(width * float(column) / float(grid.columns - 1),
                     (top - hem) * float(row) / float(grid.rows - 1));
  };
  grid.place = [&](size_t column, size_t row) {
    const float across = 2.0f * float(column) / float(grid.columns - 1) - 1.0f;
    const float angle = kPi + half_turn * across;
    const float down = float(row) / float(grid.rows - 1);
    const float height = glm::mix(top, hem, down);
    const float fold = (0.004f + 0.014f * down) *
                       (std::sin(8.0f * across + 0.5f) + 0.5f * std::sin(15.0f * across));
    return outline.Place(
        angle,
        outline.Hanging(angle, top, height) + 0.016f + fold + 0.002f * float(random.Normal()),
        height);
  };
  AddPanel(sheet, grid, 0);
  DrapeMaterial material;
  material.gap = 0.012f;
  material.own_gap = 0.014f;
  for (const int level : {0, 1}) {
    const float cell = level == 0 ? 0.0125f : 0.01f;
    const BodyField field = FieldOver(standing, sheets, cell, 3.0f * cell);
    Draper draper(sheet, material);
    draper.TakeLengths(level == 0 ? 1.02f : 1.01f);
    draper.gravity = 1.5f;
    for (uint32_t p = 0; p < sheet.positions.size(); ++p) {
      if (sheet.flat[p].y < 1e-4f) {
        draper.pins.push_back({p, sheet.positions[p], 1.0f});
      }
    }
    draper.Run(level == 0 ? 120 : 60, field);
    if (level == 0) {
      const std::vector<float> distances =
          TakeWeights(body, standing, WeightSource::kSkirted, sheet);
      SmoothWeights(sheet, 8, distances);
      result.coarse_particles = sheet.positions.size();
      result.coarse_triangles = sheet.ParticleTriangles();
      sheet = Subdivided(sheet);
      material.own_gap = 0.008f;
    }
  }
  result.skin = standing.skin;
  for (const glm::vec3& p : sheet.positions) {
    const float below = std::min(top - 0.05f, y("vl1")) - p.y;
    result.reach.push_back(below <= 0.0f ? 0.0f : 0.015f + 0.5f * below);
  }
  const float length = top - hem;
  result.dye = [pattern, length](uint8_t, const glm::vec2& flat) {
    const float stain = pattern.wear * glm::smoothstep(0.35f, 1.0f, flat.y / length);
    return pattern.colour * (1.0f - 0.22f * stain);
  };
  GarmentPattern cord = pattern;
  cord.belt = Belt::kCord;
  cord.belt_colour = 0.85f * pattern.colour;
  // The cord goes over the garment and what is below.
  Sheet all = sheet;
  for (const Sheet* below : sheets) {
    all.positions.insert(all.positions.end(), below->positions.begin(), below->positions.end());
  }
  result.trims.push_back(TieGirdle(cord, body, standing, all, top - 0.008f));
  result.sheet = std::move(sheet);
  result.cover_margin = 0.045f;
  return result;
}

}  // namespace lararium::import
