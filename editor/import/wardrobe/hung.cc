#include "editor/import/wardrobe/hung.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <utility>

#include "editor/import/wardrobe/drape.h"
#include "editor/import/wardrobe/folds.h"
#include "editor/import/wardrobe/girdle.h"
#include "editor/import/wardrobe/measures.h"
#include "editor/import/wardrobe/outline.h"
#include "editor/import/wardrobe/shoulder_line.h"
#include "editor/import/wardrobe/skin_weights.h"
#include "shared/core/random.h"

namespace lararium::import {
namespace {

constexpr float kCoarseParticles = 1150.0f;  // Approximate count.
constexpr float kAboveSkin = 0.012f;
constexpr float kAboveCloth = 0.026f;
constexpr float kGapOverCloth = 0.018f;
constexpr uint8_t kFront = 0;
constexpr uint8_t kBack = 1;

bool HasCloth(std::span<const DrapedGarment> worn) {
  return std::any_of(worn.begin(), worn.end(),
                     [](const DrapedGarment& garment) { return !garment.reach.empty(); });
}

// A step of the width of a piece.
struct CutWidth {
  float down;
  float half;
};

// Measurements of one piece, metres.
struct PieceCut {
  std::vector<CutWidth> widths;
  float neck = 0.13f;  // Half of the opening.
  float neck_depth = 0.05f;
  float hem_height = 0.5f;  // Above the floor, without belt.

  float HalfWidth(float down) const {
    for (size_t k = 1; k < widths.size(); ++k) {
      if (down < widths[k].down) {
        return glm::mix(widths[k - 1].half, widths[k].half,
                        glm::smoothstep(widths[k - 1].down, widths[k].down, down));
      }
    }
    return widths.back().half;
  }
  float HalfTop() const { return widths.front().half; }
  float HalfBottom() const { return widths.back().half; }
};

class HungDraper {
 public:
  HungDraper(const GarmentPattern& pattern,
             std::span<const Piece> pieces,
             const FittedBody& body,
             std::span<const DrapedGarment> worn,
             const Progress& progress,
             bool hold = false)
      : pattern_(pattern),
        pieces_(pieces),
        worn_(worn),
        progress_(progress),
        hold_(hold),
        body_(body),
        bound_(PoseBody(body, {})),
        standing_(PoseBody(body, StandingTurns(body, 1.0f))),
        over_cloth_(HasCloth(worn)),
        line_(body, bound_, over_cloth_ ? kAboveCloth : kAboveSkin),
        walls_(standing_),
        measures_(pattern, body, bound_, over_cloth_ ? kAboveCloth : kAboveSkin),
        material_(pattern.design->fabric.material) {
    Measure();
    // Garments below are thin, and removed where they are covered.
    material_.gap = over_cloth_ ? kGapOverCloth : material_.gap;
    material_.own_gap = std::min(0.016f, 0.45f * thread_);
  }

  Result<DrapedGarment> Drape() {
    LARARIUM_RETURN_IF_ERROR(measures_.error());
    LayOut();
    SettleInBindPose();
    TieBelt(bound_, 160);
    const std::vector<float> distances = TakeWeights(
        body_, bound_, follows_arms_ ? WeightSource::kSkirted : WeightSource::kArmless, sheet_);
    SmoothWeights(sheet_, 8, distances);
    LowerArms();
    if (!hold_ && HasSlidOff()) {
      return HungDraper(pattern_, pieces_, body_, worn_, progress_, true).Drape();
    }
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
  // Measures each piece, and the widest of both decides the grid that they share.
  void Measure() {
    const GarmentDesign& design = *pattern_.design;
    float half_width = 0.0f;
    for (const uint8_t panel : {kFront, kBack}) {
      const Piece& piece = pieces_[panel];
      const std::string what = "piece \"" + piece.name + "\": ";
      PieceCut& cut = cut_[panel];
      for (const Piece::Width& width : piece.widths) {
        cut.widths.push_back({measures_.Value(width.down, what + "down", -1.0f, 3.0f),
                              measures_.Value(width.half, what + "half", 0.05f, 3.0f)});
      }
      cut.neck = measures_.Value(piece.neck, what + "neck", 0.01f, 1.0f);
      cut.neck_depth = measures_.Value(piece.neck_depth, what + "neck_depth", 0.0f, 0.6f);
      cut.hem_height = measures_.Value(piece.hem, what + "hem", 0.0f, 2.0f);
      half_width = std::max(half_width, cut.HalfBottom());
    }
    shoulder_ = measures_.Of("shoulder");
    follows_arms_ = measures_.IsTrue(design.follows_arms, true);
    girdle_ = MeasureGirdle(pattern_, measures_);
    girdle_.tied &= design.Find(Placement::kFront) == &pieces_[kFront];
    for (const Seam& seam : design.seams) {
      if (!IsMine(seam)) {
        continue;
      }
      const bool side = seam.edge == Seam::Edge::kLeftSide || seam.edge == Seam::Edge::kRightSide;
      const float from = measures_.Value(seam.from, "seam \"" + seam.name + "\": from", 0.0f, 3.0f);
      arm_ = side ? from : arm_;
    }
    longest_ = line_.At(0.0f).y - std::min(cut_[kFront].hem_height, cut_[kBack].hem_height) +
               (girdle_.tied ? girdle_.lift : 0.0f);
    thread_ = std::clamp(std::sqrt(4.0f * half_width * longest_ / kCoarseParticles), 0.026f, 0.05f);
    // An even number of intervals, so that there is a middle column.
    columns_ = 2 * static_cast<size_t>(std::round(half_width / thread_)) + 1;
    rows_ = static_cast<size_t>(std::round(longest_ / thread_)) + 1;
  }

  bool IsMine(const Seam& seam) const {
    return seam.pieces[0] == pieces_[kFront].name || seam.pieces[0] == pieces_[kBack].name;
  }

  // Position along the upper edge.
  float Across(uint8_t panel, size_t column) const { return cut_[panel].HalfTop() * Share(column); }
  // From -1 at the left seam of the person to 1 at the right.
  float Share(size_t column) const {
    return 2.0f * static_cast<float>(column) / static_cast<float>(columns_ - 1) - 1.0f;
  }
  // Length of the cloth before the hem is levelled.
  float FirstLength(float s) const {
    return longest_ - line_.At(0.0f).y + line_.At(std::min(std::abs(s), shoulder_)).y;
  }
  float Top(uint8_t panel, float s) const {
    const float share = std::min(1.0f, std::abs(s) / cut_[panel].neck);
    return cut_[panel].neck_depth * (1.0f - share * share);
  }

  void LayOut() {
    Random random(pattern_.seed);
    const float front = 0.06f + 0.5f * ChestDepth();
    for (const uint8_t panel : {kFront, kBack}) {
      GridPanel grid;
      grid.columns = columns_;
      grid.rows = rows_;
      grid.mirrored = panel == kFront;
      grid.flat = [&, panel](size_t column, size_t row) {
        const float s = Across(panel, column);
        const float share = static_cast<float>(row) / static_cast<float>(rows_ - 1);
        const float down = glm::mix(Top(panel, s), FirstLength(s), share);
        return glm::vec2(Share(column) * cut_[panel].HalfWidth(down), down);
      };
      grid.place = [&, panel](size_t column, size_t row) {
        const glm::vec2 flat = grid.flat(column, row);
        const glm::vec2 top = line_.At(Across(panel, column));
        const float away = front * std::min(1.0f, flat.y / 0.15f);
        const float ripple = 0.004f * static_cast<float>(random.Normal());
        return glm::vec3(top.x + flat.x - Across(panel, column),
                         top.y - std::max(0.0f, flat.y - 0.7f * away),
                         line_.depth() + (panel == kFront ? -away : away) + ripple);
      };
      first_[panel] = AddPanel(sheet_, grid, panel);
    }
    SewUp();
  }

  float ChestDepth() const {
    float deepest = 0.0f;
    for (float y = girdle_.height - 0.2f; y < line_.At(0.0f).y - 0.1f; y += 0.04f) {
      const Girth girth(body_, bound_, y, 0.02f);
      deepest = std::max(deepest, girth.Radius(0.0f) + girth.Radius(glm::pi<float>()));
    }
    return deepest;
  }

  uint32_t Vertex(uint8_t panel, size_t column, size_t row) const {
    return first_[panel] + static_cast<uint32_t>(row * columns_ + column);
  }

  void SewUp() {
    std::vector<std::array<uint32_t, 2>> pairs;
    for (const Seam& seam : pattern_.design->seams) {
      if (IsMine(seam) && measures_.IsTrue(seam.when, true)) {
        SewSeam(seam, pairs);
      }
    }
    Sew(sheet_, pairs);
  }

  // Pins are narrower than the threads are apart, so each part of a seam is sewn at its nearest
  // thread at least. Cloth without them slips off the body.
  void SewSeam(const Seam& seam, std::vector<std::array<uint32_t, 2>>& pairs) const {
    const float from = measures_.Value(seam.from, "from", 0.0f, 3.0f);
    const bool right = seam.edge == Seam::Edge::kRightTop || seam.edge == Seam::Edge::kRightSide;
    const bool side = seam.edge == Seam::Edge::kLeftSide || seam.edge == Seam::Edge::kRightSide;
    const float length = (side ? longest_ : cut_[kFront].HalfTop()) - from;
    const float slack = seam.parts.empty() ? 0.0f : 0.5f * thread_;
    std::vector<std::pair<float, std::array<uint32_t, 2>>>
        places;  // Shares of the seam, 0..1, and pairs there.
    const auto add = [&](float at, size_t column, size_t row) {
      if (at >= from - slack) {
        places.push_back(
            {(at - from) / length, {Vertex(kFront, column, row), Vertex(kBack, column, row)}});
      }
    };
    for (size_t row = 0; side && row < rows_; ++row) {
      const size_t column = right ? columns_ - 1 : 0;
      add(sheet_.flat[Vertex(kFront, column, row)].y, column, row);
    }
    for (size_t column = 0; !side && column < columns_; ++column) {
      const float out = Across(kFront, column);
      if ((out > 0.0f) == right) {
        add(std::abs(out), column, 0);
      }
    }
    const auto sew = [&](float first, float last) {
      const auto beside = [&](float along) {
        return std::max({first - along, along - last, 0.0f});
      };
      float nearest = 1e9f;
      for (const auto& [along, pair] : places) {
        nearest = std::min(nearest, beside(along));
      }
      for (const auto& [along, pair] : places) {
        if (beside(along) <= nearest) {
          pairs.push_back(pair);
        }
      }
    };
    for (const Seam::Part& part : seam.parts) {
      sew(measures_.Value(part.from, "from", 0.0f, 1.0f),
          measures_.Value(part.to, "to", 0.0f, 1.0f));
    }
    if (seam.parts.empty()) {
      sew(-1e9f, 1e9f);
    }
  }

  // The upper edge supports the cloth.
  void AddTethers(Draper& draper) const {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < columns_; ++c) {
        const uint32_t top = Vertex(panel, c, 0);
        for (size_t r = 1; r < rows_; ++r) {
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
    if (hold_) {
      HoldShoulders(draper);
    }
    draper.Run(240, field);
  }

  // Cloth that is wide at the neck or pinned in few places slides from the shoulders down the arms,
  // which are as steep as a roof in the bind pose. It is laid again then, and its shoulders are
  // held.
  bool HasSlidOff() const {
    for (size_t c = 0; c < columns_; ++c) {
      const float s = Across(kFront, c);
      const glm::vec3& p = sheet_.positions[sheet_.particle[Vertex(kFront, c, 0)]];
      if (std::abs(s) >= cut_[kFront].neck && std::abs(s) <= shoulder_ &&
          p.y < line_.At(s).y - 0.1f) {
        return true;
      }
    }
    return false;
  }

  void LowerArms() {
    constexpr int kPoses = 12;
    Draper draper(sheet_, material_, progress_);
    AddTethers(draper);
    const Girth girth(body_, standing_, girdle_.height, 0.025f);
    const std::vector<float> angles = GatheredAngles(girth);
    std::optional<ArmWalls> walls;
    if (tied_) {
      draper.Gather(belted_);
      draper.rule = [&](std::vector<glm::vec3>& x) {
        Gird(girth, angles, belt_heights_, 1.0f, x);
        KeepFromHands(*walls, x);
      };
    }
    PosedBody from = bound_;
    for (int i = 1; i <= kPoses; ++i) {
      const float share = static_cast<float>(i) / kPoses;
      PosedBody to = PoseBody(body_, StandingTurns(body_, share));
      sheet_.positions = Carried(sheet_, from.skin, to.skin);
      draper.Rest();
      draper.pins.clear();
      if (hold_) {
        HoldShoulders(draper);
      }
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
    if (!girdle_.tied) {
      if (&posed == &standing_) {
        draper.rule = [this](std::vector<glm::vec3>& x) { KeepFromHands(walls_, x); };
      }
      draper.Run(steps, field);
      return;
    }
    const Girth girth(body_, standing_, girdle_.height, 0.025f);
    if (belted_.empty()) {
      ChooseBelted();
      coarse_belted_ = belted_;
    }
    draper.Gather(belted_);
    const std::vector<float> angles = GatheredAngles(girth);
    int calls = 0;
    draper.rule = [&](std::vector<glm::vec3>& x) {
      const float tightness = tied_ ? 1.0f : std::min(1.0f, static_cast<float>(++calls) / 600.0f);
      Gird(girth, angles, belt_heights_, tightness, x);
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
      const float quarter =
          0.25f * sheet_.flat[v].x / cut_[sheet_.panel[v]].HalfWidth(sheet_.flat[v].y);
      angles[sheet_.particle[v]] =
          girth.AngleAt(sheet_.panel[v] == kFront ? 0.5f - quarter : quarter);
    }
    return angles;
  }

  void ChooseBelted() {
    const float lifted = girdle_.height - girdle_.lift;
    for (const glm::vec3& p : sheet_.positions) {
      const float off = p.y - lifted;
      belted_.push_back(std::abs(off) < 0.6f * thread_);
      belt_heights_.push_back(girdle_.height + std::clamp(off, -0.012f, 0.012f));
    }
  }

  // For each column of a panel, the distance from the top at which the belt crosses it.
  std::vector<float> BeltLine(uint8_t panel) const {
    std::vector<float> line(columns_, 0.0f);
    for (size_t c = 0; c < columns_; ++c) {
      float count = 0.0f;
      for (size_t r = 0; r < rows_; ++r) {
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
    for (float down = 0.0f; down < girdle_.height; down += step) {
      const float height = girdle_.height - down;
      const float length = 2.0f * (cut_[kFront].HalfBottom() + cut_[kBack].HalfBottom());
      const auto curve = [&](float share, float out) {
        const float angle = girth.AngleAt(share);
        return outline.Place(
            angle, outline.Hanging(angle, girdle_.height, height) + material_.gap + out, 0.0f);
      };
      depths.push_back(
          FoldDepth(curve, wave, 0.0f, 1.0f, length, pattern_.design->fabric.deepest_fold));
    }
    return depths;
  }

  // Lays folds all around below the belt. Without them the cloth would stand off like a bell,
  // because the simulation gives that shape no cost.
  void LayFolds() {
    if (!girdle_.tied) {
      return;
    }
    constexpr float kStep = 0.03f;
    const Girth girth(body_, standing_, girdle_.height, 0.025f);
    const Outline outline(body_, standing_, {}, false);
    const int count = std::max(
        6, static_cast<int>(std::round(Girth(body_, standing_, HipHeight(), 0.03f).Length() /
                                       pattern_.design->fabric.fold_width)));
    const FoldWave wave(count, pattern_.seed);
    const std::vector<float> depths = FoldDepths(girth, outline, wave, kStep);
    const std::array<std::vector<float>, 2> belt = {BeltLine(kFront), BeltLine(kBack)};
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      const glm::vec2& flat = sheet_.flat[v];
      const float share =
          std::clamp(0.5f * flat.x / cut_[sheet_.panel[v]].HalfWidth(flat.y) + 0.5f, 0.0f, 0.9999f);
      const float column = share * static_cast<float>(columns_ - 1);
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
      const float height = girdle_.height - down;
      const size_t level = std::min(depths.size() - 1, static_cast<size_t>(down / kStep));
      const float depth = depths[level] * glm::smoothstep(0.0f, 0.15f, down);
      const float radius = outline.Hanging(angle, girdle_.height, height) + material_.gap +
                           depth * (1.0f + wave.At(round - std::floor(round)));
      glm::vec3& x = sheet_.positions[sheet_.particle[v]];
      x = glm::mix(x, outline.Place(angle, radius, height), laid);
    }
  }

  float HipHeight() const { return JointPlace(body_, standing_, "r_hip").y; }

  // Shortens or lengthens the cloth where the hem is too low or too high.
  void LevelHem() {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < columns_; ++c) {
        const uint32_t hem = Vertex(panel, c, rows_ - 1);
        const float change = sheet_.positions[sheet_.particle[hem]].y - cut_[panel].hem_height;
        const float top = sheet_.flat[Vertex(panel, c, 0)].y;
        const float from = top + 0.55f * (sheet_.flat[hem].y - top);
        const float longer = std::max(0.3f, 1.0f + change / (sheet_.flat[hem].y - from));
        for (size_t r = 0; r < rows_; ++r) {
          float& down = sheet_.flat[Vertex(panel, c, r)].y;
          down = down > from ? from + longer * (down - from) : down;
        }
      }
    }
  }

  void KeepHemLine() {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < columns_; ++c) {
        hem_[panel].push_back(sheet_.flat[Vertex(panel, c, rows_ - 1)].y);
      }
    }
  }

  void Gird(const Girth& girth,
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
      if (p.y < girdle_.height - 0.02f) {
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
    const Girth girth(body_, standing_, girdle_.height, 0.025f);
    std::vector<float> height;
    std::vector<float> angles;
    if (girdle_.tied) {
      belted_.assign(sheet_.positions.size(), false);
      for (size_t p = 0; p < sheet_.positions.size(); ++p) {
        const glm::vec3& x = sheet_.positions[p];
        const float out = glm::length(glm::vec2(x.x - girth.middle().x, x.z - girth.middle().z));
        belted_[p] =
            std::abs(x.y - girdle_.height) < 0.014f && out < girth.Radius(girth.AngleOf(x)) + 0.03f;
        height.push_back(x.y);
      }
      draper.Gather(belted_);
      angles = GatheredAngles(girth);
    }
    draper.rule = [&](std::vector<glm::vec3>& x) {
      Gird(girth, angles, height, 1.0f, x);
      KeepFromHands(walls_, x);
    };
    draper.floor = true;
    draper.TakeLengths(1.0f);
    draper.Run(50, FieldOf(standing_, 0.01f, 0.03f));
  }

  // Pins the shoulders at their current positions.
  void HoldShoulders(Draper& draper) const {
    for (const uint8_t panel : {kFront, kBack}) {
      for (size_t c = 0; c < columns_; ++c) {
        const float s = std::abs(Across(panel, c));
        const uint32_t particle = sheet_.particle[Vertex(panel, c, 0)];
        if (s >= cut_[panel].neck && s <= shoulder_ + 0.02f) {
          draper.pins.push_back({particle, sheet_.positions[particle], 0.3f});
        }
      }
    }
  }

  void Finish(DrapedGarment& result) {
    result.skin = standing_.skin;
    result.wraps = true;
    if (!follows_arms_) {
      result.cover_margin = 0.012f;
      if (cut_[kFront].hem_height < measures_.Of("knee")) {
        result.covers_trunk_below = JointPlace(body_, standing_, "r_shoulder").y - 0.8f * arm_;
      }
    }
    // A hem that reaches the floor hides everything below.
    result.loose_margin = std::clamp(0.4f * cut_[kFront].hem_height, 0.05f, 0.18f);
    SetReach(result);
    WeaveBands();
    result.dye = Dye();
    if (girdle_.tied) {
      result.trims.push_back(TieGirdle(girdle_, body_, standing_, sheet_));
    }
    result.sheet = std::move(sheet_);
  }

  // Cloth below the belt swings, more towards the hem.
  void SetReach(DrapedGarment& result) const {
    const float top = !girdle_.tied
                          ? JointPlace(body_, standing_, "r_hip").y + 0.05f
                          : std::min(girdle_.height, JointPlace(body_, standing_, "vl1").y);
    for (const glm::vec3& p : sheet_.positions) {
      const float below = top - 0.05f - p.y;
      result.reach.push_back(below <= 0.0f ? 0.0f : 0.02f + 0.8f * below);
    }
    // Sleeves hang from the arm, and move more freely further from shoulder and upper edge.
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      const glm::vec2& flat = sheet_.flat[v];
      const float out = std::abs(flat.x) - shoulder_ - 0.03f;
      const float down = flat.y - 0.03f;
      if (out > 0.0f && down > 0.0f && flat.y < arm_ + 0.02f) {
        result.reach[sheet_.particle[v]] = std::min(0.06f, 0.5f * std::min(out, down));
      }
    }
  }

  // Stripes and borders are complete columns and rows of the sheet.
  void WeaveBands() {
    if (!pattern_.design->bands) {
      return;
    }
    const BandDesign& bands = *pattern_.design->bands;
    const size_t columns = 2 * (columns_ - 1);  // Columns of the divided sheet.
    const float spacing = 2.0f * cut_[kFront].HalfTop() / static_cast<float>(columns);
    const float width = measures_.Value(bands.stripe_width, "bands: stripe_width", 0.0f, 0.5f);
    const float at = measures_.Value(bands.stripe_at, "bands: stripe_at", 0.0f, 2.0f);
    const float first = std::round((at - 0.5f * width) / spacing);
    const float last = first + std::max(1.0f, std::round(width / spacing));
    const bool border = measures_.IsTrue(bands.border, false);
    MarkBands(sheet_, [&](uint8_t panel, const glm::vec2& middle) {
      const float from_middle =
          0.5f * std::abs(middle.x) / cut_[panel].HalfWidth(middle.y) * static_cast<float>(columns);
      const bool striped = width > 0.0f && from_middle > first && from_middle < last;
      const float rows = FromHem(panel, middle) / HemRow(panel, middle);
      return striped || (border && rows > bands.border_from && rows < bands.border_to);
    });
  }

  size_t NearestColumn(uint8_t panel, const glm::vec2& flat) const {
    const float share =
        std::clamp(0.5f * (flat.x / cut_[panel].HalfWidth(flat.y) + 1.0f), 0.0f, 1.0f);
    return static_cast<size_t>(share * static_cast<float>(columns_ - 1) + 0.5f);
  }
  float FromHem(uint8_t panel, const glm::vec2& flat) const {
    return hem_[panel][NearestColumn(panel, flat)] - flat.y;
  }
  // Distance of the rows of the divided sheet at the hem.
  float HemRow(uint8_t panel, const glm::vec2& flat) const {
    const size_t column = NearestColumn(panel, flat);
    const float above = sheet_.flat[Vertex(panel, column, rows_ - 2)].y;
    return 0.5f * (hem_[panel][column] - above);
  }

  std::function<glm::vec3(uint8_t, const glm::vec2&)> Dye() const {
    const std::array<std::vector<float>, 2> hem = {hem_[kFront], hem_[kBack]};
    const std::array<float, 2> half = {cut_[kFront].HalfBottom(), cut_[kBack].HalfBottom()};
    return [hem, half, dyer = Dyer(pattern_, measures_)](uint8_t panel, const glm::vec2& flat) {
      const std::vector<float>& line = hem[panel & ~kBand];
      const float share = std::clamp(0.5f * (flat.x / half[panel & ~kBand] + 1.0f), 0.0f, 1.0f);
      const size_t column = static_cast<size_t>(share * static_cast<float>(line.size() - 1) + 0.5f);
      return dyer.At((panel & kBand) != 0, line[column] - flat.y);
    };
  }

  const GarmentPattern& pattern_;
  std::span<const Piece> pieces_;
  std::span<const DrapedGarment> worn_;
  const Progress& progress_;
  bool hold_;  // Holds the shoulders from the beginning.
  const FittedBody& body_;
  PosedBody bound_;
  PosedBody standing_;
  bool over_cloth_;
  ShoulderLine line_;
  ArmWalls walls_;
  Measures measures_;
  DrapeMaterial material_;
  PieceCut cut_[2];
  Girdle girdle_;
  float shoulder_ = 0.18f;  // Length along the shoulder line to the joint.
  float arm_ = 0.28f;       // Opening at the side, from the top.
  bool follows_arms_ = true;
  size_t columns_ = 0;
  size_t rows_ = 0;
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

Result<DrapedGarment> DrapeHung(const GarmentPattern& pattern,
                                std::span<const Piece> pieces,
                                const FittedBody& body,
                                std::span<const DrapedGarment> worn,
                                const Progress& progress) {
  return HungDraper(pattern, pieces, body, worn, progress).Drape();
}

}  // namespace lararium::import
