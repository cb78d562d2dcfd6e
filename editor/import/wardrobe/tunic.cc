#include "editor/import/wardrobe/tunic.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <optional>

#include "editor/import/wardrobe/drape.h"
#include "editor/import/wardrobe/folds.h"
#include "editor/import/wardrobe/girdle.h"
#include "editor/import/wardrobe/outline.h"
#include "editor/import/wardrobe/skin_weights.h"
#include "shared/core/random.h"

namespace lararium::import {
namespace {

constexpr float kCoarseParticles = 1150.0f;  // Approximate count.
constexpr float kAboveSkin = 0.012f;
constexpr float kAboveCloth = 0.026f;
constexpr float kGapOverCloth = 0.018f;
constexpr float kFoldWidth = 0.13f;    // Width of one fold of a skirt, metres around the body.
constexpr float kDeepestFold = 0.05f;  // Metres, half of the distance from trough to crest.
constexpr uint8_t kFront = 0;
constexpr uint8_t kBack = 1;

// The line over shoulders and arms on which the upper edge of the cloth rests, from the middle
// outward: height and side position as functions of length.
class ShoulderLine {
 public:
  // `above` is the height above the skin, metres.
  ShoulderLine(const FittedBody& body, const PosedBody& posed, float above) {
    const std::vector<float> head = HeadShare(body);
    const std::vector<bool> is_body = IsBody(body);
    const glm::vec3 wrist = JointPlace(body, posed, "r_wrist");
    depth_ = JointPlace(body, posed, "r_shoulder").z;
    const size_t bins = static_cast<size_t>(wrist.x / kBin);
    std::vector<float> top(bins + 1, 0.0f);
    for (size_t v = 0; v < posed.positions.size(); ++v) {
      const glm::vec3& p = posed.positions[v];
      const size_t bin = static_cast<size_t>(std::abs(p.x) / kBin);
      if (is_body[v] && head[v] < 0.5f && bin <= bins) {
        top[bin] = std::max(top[bin], p.y);
      }
    }
    float highest = *std::max_element(top.begin(), top.end());
    for (float& y : top) {
      highest = y = std::min(highest, y > 0.0f ? y : highest);
    }
    float length = 0.0f;
    for (size_t b = 0; b <= bins; ++b) {
      places_.emplace_back(kBin * static_cast<float>(b), top[b] + above);
      length += b > 0 ? glm::distance(places_[b], places_[b - 1]) : 0.0f;
      lengths_.push_back(length);
    }
  }

  // x and y at this length from the middle; negative lengths are on the left of the person.
  glm::vec2 At(float s) const {
    const float length = std::min(std::abs(s), lengths_.back());
    const size_t next = std::max<size_t>(
        1, size_t(std::lower_bound(lengths_.begin(), lengths_.end(), length) - lengths_.begin()));
    const float f = (length - lengths_[next - 1]) / (lengths_[next] - lengths_[next - 1]);
    const glm::vec2 p = glm::mix(places_[next - 1], places_[next], f);
    const float beyond = std::abs(s) - length;
    return {std::copysign(p.x + 0.7f * beyond, s), p.y - 0.7f * beyond};
  }
  float LengthTo(float x) const {
    const size_t bin = std::min(places_.size() - 1, static_cast<size_t>(x / kBin));
    return lengths_[bin];
  }
  float depth() const { return depth_; }

 private:
  static constexpr float kBin = 0.015f;
  float depth_ = 0.0f;
  std::vector<glm::vec2> places_;
  std::vector<float> lengths_;
};

bool HasCloth(std::span<const DrapedGarment> worn) {
  return std::any_of(worn.begin(), worn.end(),
                     [](const DrapedGarment& garment) { return !garment.reach.empty(); });
}

// Measurements of the two rectangles, metres.
struct TunicCut {
  float half_width = 0.4f;   // Below the waist.
  float half_top = 0.3f;     // Along the shoulders.
  float neck = 0.13f;        // Half of the opening.
  float neck_front = 0.05f;  // Depth of the neckline.
  float neck_back = 0.015f;
  float arm = 0.28f;  // Opening at the side, from the top.
  float shoulder = 0.18f;
  float hem_height = 0.5f;  // Above the floor, without belt.
  size_t columns = 0;
  size_t rows = 0;
};

class TunicDraper {
 public:
  TunicDraper(const GarmentPattern& pattern,
              const FittedBody& body,
              std::span<const DrapedGarment> worn,
              const Progress& progress)
      : pattern_(pattern),
        progress_(progress),
        body_(body),
        bound_(PoseBody(body, {})),
        standing_(PoseBody(body, StandingTurns(body, 1.0f))),
        over_cloth_(HasCloth(worn)),
        line_(body, bound_, over_cloth_ ? kAboveCloth : kAboveSkin),
        walls_(standing_) {
    Measure();
    // Garments below are thin, and removed where they are covered.
    material_.gap = over_cloth_ ? kGapOverCloth : material_.gap;
    material_.own_gap = std::min(0.016f, 0.45f * thread_);
  }

  DrapedGarment Drape() {
    LayOut();
    SettleInBindPose();
    TieBelt(bound_, 160);
    // A garment on straps has no weights of the arms.
    const std::vector<float> distances = TakeWeights(
        body_, bound_, HasStraps() ? WeightSource::kArmless : WeightSource::kSkirted, sheet_);
    SmoothWeights(sheet_, 8, distances);
    LowerArms();
    DrapedGarment result;
    for (int round = 0; round < 2; ++round) {
      LevelHem();
      TieBelt(standing_, 40);
      LayFolds();
    }
    KeepHemLine();
    Divide(1, sheet_, result);
    LayFolds();
    SettleFine();
    std::copy_n(sheet_.positions.begin(), result.coarse_positions.size(),
                result.coarse_positions.begin());
    Finish(result);
    return result;
  }

 private:
  void Measure() {
    const auto place = [&](const char* joint) { return JointPlace(body_, bound_, joint); };
    const glm::vec3 shoulder = place("r_shoulder");
    const float upper_arm = glm::distance(shoulder, place("r_elbow"));
    const float hip = place("r_hip").y;
    const float knee = place("r_knee").y;
    float widest = 0.0f;
    for (float y = knee; y < shoulder.y; y += 0.03f) {
      widest = std::max(widest, Girth(body_, standing_, y, 0.03f).Length());
    }
    cut_.shoulder = line_.LengthTo(shoulder.x);
    const float sleeve = pattern_.sleeve == Sleeve::kNone    ? 0.12f
                         : pattern_.sleeve == Sleeve::kShort ? 0.62f
                                                             : 1.0f;
    cut_.half_top = cut_.shoulder + sleeve * upper_arm;
    cut_.neck = 0.72f * cut_.shoulder;
    cut_.neck_front = 0.28f * cut_.shoulder;
    if (HasStraps()) {
      cut_.half_top = 0.97f * cut_.shoulder;
      cut_.neck = 0.70f * cut_.shoulder;
      cut_.neck_front = 0.85f * cut_.shoulder;
      cut_.neck_back = 0.35f * cut_.shoulder;
    }
    // Long sleeves are sewn on; short ones are formed by the width of the cloth.
    const bool sewn_on = pattern_.sleeve == Sleeve::kElbow;
    cut_.half_width = std::max(sewn_on ? 0.0f : cut_.half_top, 0.25f * pattern_.ease * widest);
    // A long sleeve is narrow, so that the hand is not caught in it.
    cut_.arm = HasStraps() ? 0.55f * upper_arm
               : sewn_on   ? 0.68f * upper_arm
                           : std::max(0.85f * upper_arm, 0.6f * cut_.half_top);
    cut_.hem_height = pattern_.hem < 1.0f ? glm::mix(hip, knee, pattern_.hem)
                                          : glm::mix(knee, 0.0f, pattern_.hem - 1.0f);
    belt_height_ = BeltHeight(pattern_, body_);
    const float blouse = pattern_.belt == Belt::kNone ? 0.0f : pattern_.blouse;
    longest_ = line_.At(0.0f).y - cut_.hem_height + blouse;
    thread_ =
        std::clamp(std::sqrt(4.0f * cut_.half_width * longest_ / kCoarseParticles), 0.026f, 0.05f);
    // An even number of intervals, so that there is a middle column.
    cut_.columns = 2 * static_cast<size_t>(std::round(cut_.half_width / thread_)) + 1;
    cut_.rows = static_cast<size_t>(std::round(longest_ / thread_)) + 1;
  }

  // Position along the upper edge.
  float Across(size_t column) const { return cut_.half_top * Share(column); }
  // From -1 at the left seam of the person to 1 at the right.
  float Share(size_t column) const {
    return 2.0f * static_cast<float>(column) / static_cast<float>(cut_.columns - 1) - 1.0f;
  }
  // Below the arms the cloth is wider.
  float HalfWidth(float down) const {
    const bool narrows = cut_.half_width < cut_.half_top;
    const float share = narrows ? glm::smoothstep(0.6f * cut_.arm, cut_.arm + 0.10f, down)
                                : glm::smoothstep(0.5f * cut_.arm, cut_.arm + 0.25f, down);
    return glm::mix(cut_.half_top, cut_.half_width, share);
  }
  // Length of the cloth before the hem is levelled.
  float FirstLength(float s) const {
    return longest_ - line_.At(0.0f).y + line_.At(std::min(std::abs(s), cut_.shoulder)).y;
  }
  float Top(uint8_t panel, float s) const {
    const float depth = panel == kFront ? cut_.neck_front : cut_.neck_back;
    const float share = std::min(1.0f, std::abs(s) / cut_.neck);
    return depth * (1.0f - share * share);
  }

  void LayOut() {
    Random random(pattern_.seed);
    const float front = 0.06f + 0.5f * ChestDepth();
    for (const uint8_t panel : {kFront, kBack}) {
      GridPanel grid;
      grid.columns = cut_.columns;
      grid.rows = cut_.rows;
      grid.mirrored = panel == kFront;
      grid.flat = [&, panel](size_t column, size_t row) {
        const float s = Across(column);
        const float share = static_cast<float>(row) / static_cast<float>(cut_.rows - 1);
        const float down = glm::mix(Top(panel, s), FirstLength(s), share);
        return glm::vec2(Share(column) * HalfWidth(down), down);
      };
      grid.place = [&, panel](size_t column, size_t row) {
        const glm::vec2 flat = grid.flat(column, row);
        const glm::vec2 top = line_.At(Across(column));
        const float away = front * std::min(1.0f, flat.y / 0.15f);
        const float ripple = 0.004f * static_cast<float>(random.Normal());
        return glm::vec3(top.x + flat.x - Across(column),
                         top.y - std::max(0.0f, flat.y - 0.7f * away),
                         line_.depth() + (panel == kFront ? -away : away) + ripple);
      };
      first_[panel] = AddPanel(sheet_, grid, panel);
    }
    SewUp();
  }

  float ChestDepth() const {
    float deepest = 0.0f;
    for (float y = belt_height_ - 0.2f; y < line_.At(0.0f).y - 0.1f; y += 0.04f) {
      const Girth girth(body_, bound_, y, 0.02f);
      deepest = std::max(deepest, girth.Radius(0.0f) + girth.Radius(glm::pi<float>()));
    }
    return deepest;
  }

  uint32_t Vertex(uint8_t panel, size_t column, size_t row) const {
    return first_[panel] + static_cast<uint32_t>(row * cut_.columns + column);
  }

  void SewUp() {
    std::vector<std::array<uint32_t, 2>> seams;
    for (size_t c = 0; c < cut_.columns; ++c) {
      const float s = Across(c);
      const bool bare = pattern_.one_shoulder && s > 0.0f;
      if (std::abs(s) >= cut_.neck && !bare && IsPinned(s)) {
        seams.push_back({Vertex(kFront, c, 0), Vertex(kBack, c, 0)});
      }
    }
    for (size_t r = 0; r < cut_.rows; ++r) {
      for (const size_t c : {size_t{0}, cut_.columns - 1}) {
        if (sheet_.flat[Vertex(kFront, c, r)].y >= cut_.arm) {
          seams.push_back({Vertex(kFront, c, r), Vertex(kBack, c, r)});
        }
      }
    }
    Sew(sheet_, seams);
  }

  // The sleeve of a woman's dress is pinned along the arm and gapes between the pins.
  bool IsPinned(float s) const {
    if (pattern_.kind != GarmentKind::kStola || HasStraps()) {
      return true;
    }
    const float along = (std::abs(s) - cut_.neck) / (cut_.half_top - cut_.neck);
    const float phase = along * 3.0f - std::floor(along * 3.0f);
    return along < 0.06f || along > 0.97f || phase < 0.34f;
  }
  // A stola without sleeves hangs from two straps over a tunic with sleeves.
  bool HasStraps() const {
    return pattern_.kind == GarmentKind::kStola && pattern_.sleeve == Sleeve::kNone;
  }

  // The upper edge supports the cloth.
  void AddTethers(Draper& draper) const {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < cut_.columns; ++c) {
        const uint32_t top = Vertex(panel, c, 0);
        for (size_t r = 1; r < cut_.rows; ++r) {
          const uint32_t v = Vertex(panel, c, r);
          draper.Tether(sheet_.particle[v], sheet_.particle[top],
                        1.03f * (sheet_.flat[v].y - sheet_.flat[top].y));
        }
      }
    }
  }

  void SettleInBindPose() {
    const BodyField field = FieldOf(bound_, 0.015f, 0.045f);
    Draper draper(sheet_, material_, progress_);
    AddTethers(draper);
    draper.damping = 0.04f;
    draper.Run(240, field);
  }

  void LowerArms() {
    constexpr int kPoses = 12;
    Draper draper(sheet_, material_, progress_);
    AddTethers(draper);
    const Girth girth(body_, standing_, belt_height_, 0.025f);
    const std::vector<float> angles = GatheredAngles(girth);
    std::optional<ArmWalls> walls;
    if (tied_) {
      draper.Gather(belted_);
      draper.rule = [&](std::vector<glm::vec3>& x) {
        Girdle(girth, angles, belt_heights_, 1.0f, x);
        KeepFromHands(*walls, x);
      };
    }
    PosedBody from = bound_;
    for (int i = 1; i <= kPoses; ++i) {
      const float share = static_cast<float>(i) / kPoses;
      PosedBody to = PoseBody(body_, StandingTurns(body_, share));
      sheet_.positions = Carried(sheet_, from.skin, to.skin);
      draper.Rest();
      walls.emplace(to);
      draper.Run(i == kPoses ? 100 : 12, FieldOf(to, 0.015f, 0.045f, false));
      from = std::move(to);
    }
  }

  // Pulls the cloth at the height of the belt, minus what blouses over it, onto the waist.
  void TieBelt(const PosedBody& posed, int steps) {
    Draper draper(sheet_, material_, progress_);
    AddTethers(draper);
    HoldShoulders(draper);
    draper.gravity = 2.0f;
    const BodyField field = FieldOf(posed, 0.0125f, 0.04f, false);
    if (pattern_.belt == Belt::kNone) {
      if (&posed == &standing_) {
        draper.rule = [this](std::vector<glm::vec3>& x) { KeepFromHands(walls_, x); };
      }
      draper.Run(steps, field);
      return;
    }
    const Girth girth(body_, standing_, belt_height_, 0.025f);
    if (belted_.empty()) {
      ChooseBelted();
      coarse_belted_ = belted_;
    }
    draper.Gather(belted_);
    const std::vector<float> angles = GatheredAngles(girth);
    int calls = 0;
    draper.rule = [&](std::vector<glm::vec3>& x) {
      const float tightness = tied_ ? 1.0f : std::min(1.0f, static_cast<float>(++calls) / 600.0f);
      Girdle(girth, angles, belt_heights_, tightness, x);
      if (tied_) {
        KeepFromHands(walls_, x);
      }
    };
    draper.Run(steps, field);
    tied_ = true;
  }

  // For each particle, the angle around the waist to which its thread is gathered, so that the
  // folds spread.
  std::vector<float> GatheredAngles(const Girth& girth) const {
    std::vector<float> angles(sheet_.positions.size(), 0.0f);
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      const float quarter = 0.25f * sheet_.flat[v].x / HalfWidth(sheet_.flat[v].y);
      angles[sheet_.particle[v]] =
          girth.AngleAt(sheet_.panel[v] == kFront ? 0.5f - quarter : quarter);
    }
    return angles;
  }

  void ChooseBelted() {
    const float lifted = belt_height_ - pattern_.blouse;
    for (const glm::vec3& p : sheet_.positions) {
      const float off = p.y - lifted;
      belted_.push_back(std::abs(off) < 0.6f * thread_);
      belt_heights_.push_back(belt_height_ + std::clamp(off, -0.012f, 0.012f));
    }
  }

  // For each column of a panel, the distance from the top at which the belt crosses it.
  std::vector<float> BeltLine(uint8_t panel) const {
    std::vector<float> line(cut_.columns, 0.0f);
    for (size_t c = 0; c < cut_.columns; ++c) {
      float count = 0.0f;
      for (size_t r = 0; r < cut_.rows; ++r) {
        const uint32_t v = Vertex(panel, c, r);
        if (coarse_belted_[sheet_.particle[v]]) {
          line[c] += sheet_.flat[v].y;
          count += 1.0f;
        }
      }
      line[c] = count > 0.0f ? line[c] / count : c > 0 ? line[c - 1] : longest_ * 0.4f;
    }
    return line;
  }

  // Depths of the folds at heights below the belt, from the width of the cloth.
  std::vector<float> FoldDepths(const Girth& girth,
                                const Outline& outline,
                                const FoldWave& wave,
                                float step) const {
    std::vector<float> depths;
    for (float down = 0.0f; down < belt_height_; down += step) {
      const float height = belt_height_ - down;
      const float length = 4.0f * HalfWidth(cut_.arm + 0.25f);
      const auto curve = [&](float share, float out) {
        const float angle = girth.AngleAt(share);
        return outline.Place(
            angle, outline.Hanging(angle, belt_height_, height) + material_.gap + out, 0.0f);
      };
      depths.push_back(FoldDepth(curve, wave, 0.0f, 1.0f, length, kDeepestFold));
    }
    return depths;
  }

  // Lays folds all around below the belt. Without them the cloth would stand off like a bell,
  // because the simulation gives that shape no cost.
  void LayFolds() {
    if (pattern_.belt == Belt::kNone) {
      return;
    }
    constexpr float kStep = 0.03f;
    const Girth girth(body_, standing_, belt_height_, 0.025f);
    const Outline outline(body_, standing_, {}, false);
    const int count = std::max(
        6, static_cast<int>(
               std::round(Girth(body_, standing_, HipHeight(), 0.03f).Length() / kFoldWidth)));
    const FoldWave wave(count, pattern_.seed);
    const std::vector<float> depths = FoldDepths(girth, outline, wave, kStep);
    const std::array<std::vector<float>, 2> belt = {BeltLine(kFront), BeltLine(kBack)};
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      const glm::vec2& flat = sheet_.flat[v];
      const float share = std::clamp(0.5f * flat.x / HalfWidth(flat.y) + 0.5f, 0.0f, 0.9999f);
      const float column = share * static_cast<float>(cut_.columns - 1);
      const std::vector<float>& line = belt[sheet_.panel[v]];
      const size_t at = static_cast<size_t>(column);
      const float down = flat.y - glm::mix(line[at], line[at + 1], column - static_cast<float>(at));
      const float laid = glm::smoothstep(0.01f, 0.06f, down);
      if (laid <= 0.0f) {
        continue;
      }
      const float quarter = 0.5f * (share - 0.5f);
      const float round = sheet_.panel[v] == kFront ? 0.5f - quarter : quarter;
      const float angle = girth.AngleAt(round);
      const float height = belt_height_ - down;
      const size_t level = std::min(depths.size() - 1, static_cast<size_t>(down / kStep));
      const float depth = depths[level] * glm::smoothstep(0.0f, 0.15f, down);
      const float radius = outline.Hanging(angle, belt_height_, height) + material_.gap +
                           depth * (1.0f + wave.At(round - std::floor(round)));
      glm::vec3& x = sheet_.positions[sheet_.particle[v]];
      x = glm::mix(x, outline.Place(angle, radius, height), laid);
    }
  }

  float HipHeight() const { return JointPlace(body_, standing_, "r_hip").y; }

  // Shortens or lengthens the cloth where the hem is too low or too high.
  void LevelHem() {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < cut_.columns; ++c) {
        const uint32_t hem = Vertex(panel, c, cut_.rows - 1);
        const float change = sheet_.positions[sheet_.particle[hem]].y - cut_.hem_height;
        const float top = sheet_.flat[Vertex(panel, c, 0)].y;
        const float from = top + 0.55f * (sheet_.flat[hem].y - top);
        const float longer = std::max(0.3f, 1.0f + change / (sheet_.flat[hem].y - from));
        for (size_t r = 0; r < cut_.rows; ++r) {
          float& down = sheet_.flat[Vertex(panel, c, r)].y;
          down = down > from ? from + longer * (down - from) : down;
        }
      }
    }
  }

  void KeepHemLine() {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < cut_.columns; ++c) {
        hem_[panel].push_back(sheet_.flat[Vertex(panel, c, cut_.rows - 1)].y);
      }
    }
  }

  void Girdle(const Girth& girth,
              const std::vector<float>& angles,
              const std::vector<float>& height,
              float tightness,
              std::vector<glm::vec3>& x) const {
    for (size_t p = 0; p < belted_.size(); ++p) {
      if (!belted_[p]) {
        continue;
      }
      const float at = girth.AngleOf(x[p]);
      const float round = std::remainder(angles[p] - at, glm::two_pi<float>());
      const float angle = at + 0.15f * tightness * round;
      const float now =
          glm::length(glm::vec2(x[p].x - girth.middle().x, x[p].z - girth.middle().z));
      const float wanted = girth.Radius(angle) + material_.gap;
      const float radius = std::min(now, glm::mix(now, wanted, 0.3f * tightness));
      x[p] = glm::mix(x[p],
                      girth.middle() + radius * glm::vec3(std::sin(angle), 0.0f, std::cos(angle)),
                      glm::vec3(1.0f, 0.0f, 1.0f));
      x[p].y = glm::mix(x[p].y, height[p], 0.3f * tightness);
    }
  }

  // Keeps forearms and hands outside of the skirt.
  void KeepFromHands(const ArmWalls& walls, std::vector<glm::vec3>& x) const {
    for (glm::vec3& p : x) {
      if (p.y < belt_height_ - 0.02f) {
        walls.Keep(p);
      }
    }
  }

  void SettleFine() {
    DrapeMaterial fine = material_;
    fine.own_gap = 0.5f * material_.own_gap;
    Draper draper(sheet_, fine, progress_);
    AddTethers(draper);
    HoldShoulders(draper);
    draper.gravity = 1.2f;
    const Girth girth(body_, standing_, belt_height_, 0.025f);
    std::vector<float> height;
    std::vector<float> angles;
    if (pattern_.belt != Belt::kNone) {
      belted_.assign(sheet_.positions.size(), false);
      for (size_t p = 0; p < sheet_.positions.size(); ++p) {
        const glm::vec3& x = sheet_.positions[p];
        const float out = glm::length(glm::vec2(x.x - girth.middle().x, x.z - girth.middle().z));
        belted_[p] =
            std::abs(x.y - belt_height_) < 0.014f && out < girth.Radius(girth.AngleOf(x)) + 0.03f;
        height.push_back(x.y);
      }
      draper.Gather(belted_);
      angles = GatheredAngles(girth);
    }
    draper.rule = [&](std::vector<glm::vec3>& x) {
      Girdle(girth, angles, height, 1.0f, x);
      KeepFromHands(walls_, x);
    };
    draper.floor = true;
    draper.TakeLengths(1.0f);
    draper.Run(50, FieldOf(standing_, 0.01f, 0.03f));
  }

  // Pins the shoulders at their current positions.
  void HoldShoulders(Draper& draper) const {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < cut_.columns; ++c) {
        const float s = std::abs(Across(c));
        const uint32_t particle = sheet_.particle[Vertex(panel, c, 0)];
        if (s >= cut_.neck && s <= cut_.shoulder + 0.02f) {
          draper.pins.push_back({particle, sheet_.positions[particle], 0.3f});
        }
      }
    }
  }

  void Finish(DrapedGarment& result) {
    result.skin = standing_.skin;
    result.wraps = true;
    if (HasStraps()) {
      result.cover_margin = 0.012f;
      result.covers_trunk_below = JointPlace(body_, standing_, "r_shoulder").y - 0.8f * cut_.arm;
    }
    // A hem that reaches the floor hides everything below.
    result.loose_margin = std::clamp(0.4f * cut_.hem_height, 0.05f, 0.18f);
    SetReach(result);
    WeaveBands();
    result.dye = Dye();
    if (pattern_.belt != Belt::kNone) {
      result.trims.push_back(TieGirdle(pattern_, body_, standing_, sheet_, belt_height_));
    }
    result.sheet = std::move(sheet_);
  }

  // Cloth below the belt swings, more towards the hem.
  void SetReach(DrapedGarment& result) const {
    const float top = pattern_.belt == Belt::kNone
                          ? JointPlace(body_, standing_, "r_hip").y + 0.05f
                          : std::min(belt_height_, JointPlace(body_, standing_, "vl1").y);
    for (const glm::vec3& p : sheet_.positions) {
      const float below = top - 0.05f - p.y;
      result.reach.push_back(below <= 0.0f ? 0.0f : 0.02f + 0.8f * below);
    }
    // Sleeves hang from the arm, and move more freely further from shoulder and upper edge.
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      const glm::vec2& flat = sheet_.flat[v];
      const float out = std::abs(flat.x) - cut_.shoulder - 0.03f;
      const float down = flat.y - 0.03f;
      if (out > 0.0f && down > 0.0f && flat.y < cut_.arm + 0.02f) {
        result.reach[sheet_.particle[v]] = std::min(0.06f, 0.5f * std::min(out, down));
      }
    }
  }

  // Stripes and borders are complete columns and rows of the sheet.
  void WeaveBands() {
    const size_t columns = 2 * (cut_.columns - 1);  // Columns of the divided sheet.
    const float spacing = 2.0f * cut_.half_top / static_cast<float>(columns);
    const float width = pattern_.stripes == Stripes::kNarrow  ? 0.026f
                        : pattern_.stripes == Stripes::kBroad ? 0.07f
                                                              : 0.0f;
    const float first = std::round((0.68f * cut_.neck - 0.5f * width) / spacing);
    const float last = first + std::max(1.0f, std::round(width / spacing));
    MarkBands(sheet_, [&](uint8_t panel, const glm::vec2& middle) {
      const float from_middle =
          0.5f * std::abs(middle.x) / HalfWidth(middle.y) * static_cast<float>(columns);
      const bool striped = width > 0.0f && from_middle > first && from_middle < last;
      const float rows = FromHem(panel, middle) / HemRow(panel, middle);
      return striped || (pattern_.border && rows > 1.0f && rows < 4.0f);
    });
  }

  size_t NearestColumn(const glm::vec2& flat) const {
    const float share = std::clamp(0.5f * (flat.x / HalfWidth(flat.y) + 1.0f), 0.0f, 1.0f);
    return static_cast<size_t>(share * static_cast<float>(cut_.columns - 1) + 0.5f);
  }
  float FromHem(uint8_t panel, const glm::vec2& flat) const {
    return hem_[panel][NearestColumn(flat)] - flat.y;
  }
  // Distance of the rows of the divided sheet at the hem.
  float HemRow(uint8_t panel, const glm::vec2& flat) const {
    const size_t column = NearestColumn(flat);
    const float above = sheet_.flat[Vertex(panel, column, cut_.rows - 2)].y;
    return 0.5f * (hem_[panel][column] - above);
  }

  std::function<glm::vec3(uint8_t, const glm::vec2&)> Dye() const {
    const std::array<std::vector<float>, 2> hem = {hem_[kFront], hem_[kBack]};
    return [hem, pattern = pattern_, half_width = cut_.half_width](uint8_t panel,
                                                                   const glm::vec2& flat) {
      const std::vector<float>& line = hem[panel & ~kBand];
      const float share = std::clamp(0.5f * (flat.x / half_width + 1.0f), 0.0f, 1.0f);
      const float from_hem =
          line[static_cast<size_t>(share * static_cast<float>(line.size() - 1) + 0.5f)] - flat.y;
      const bool banded = (panel & kBand) != 0;
      const float soil = pattern.wear * std::clamp(1.0f - from_hem / 0.2f, 0.0f, 1.0f);
      return (banded ? pattern.stripe_colour : pattern.colour) * (1.0f - 0.35f * soil);
    };
  }

  const GarmentPattern pattern_;
  const Progress& progress_;
  const FittedBody& body_;
  PosedBody bound_;
  PosedBody standing_;
  bool over_cloth_;
  ShoulderLine line_;
  ArmWalls walls_;
  DrapeMaterial material_;
  TunicCut cut_;
  float belt_height_ = 1.0f;
  float thread_ = 0.036f;  // Metres between the rows of the coarse sheet.
  float longest_ = 1.0f;
  uint32_t first_[2] = {0, 0};
  Sheet sheet_;
  std::vector<bool> belted_;
  std::vector<bool> coarse_belted_;  // Values of the sheet before it was divided.
  std::vector<float> belt_heights_;
  bool tied_ = false;
  std::vector<float> hem_[2];
};

}  // namespace

Result<DrapedGarment> DrapeTunic(const GarmentPattern& pattern,
                                 const FittedBody& body,
                                 std::span<const DrapedGarment> worn,
                                 const Progress& progress) {
  return TunicDraper(pattern, body, worn, progress).Drape();
}

}  // namespace lararium::import
