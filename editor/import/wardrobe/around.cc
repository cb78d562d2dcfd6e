#include "editor/import/wardrobe/around.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "editor/import/wardrobe/drape.h"
#include "editor/import/wardrobe/folds.h"
#include "editor/import/wardrobe/girdle.h"
#include "editor/import/wardrobe/measures.h"
#include "editor/import/wardrobe/outline.h"
#include "editor/import/wardrobe/skin_weights.h"
#include "shared/core/random.h"
#include "shared/core/units.h"

namespace lararium::import {
namespace {

class AroundDraper {
 public:
  AroundDraper(const GarmentPattern& pattern,
               const Piece& piece,
               const FittedBody& body,
               std::span<const DrapedGarment> worn,
               const Progress& progress)
      : pattern_(pattern),
        piece_(piece),
        progress_(progress),
        body_(body),
        standing_(PoseBody(body, StandingTurns(body, 1.0f))),
        worn_(SheetsOf(worn)),
        limb_(piece.about != About::kTrunk),
        measures_(pattern, body, standing_, 0.012f),
        wave_(static_cast<int>(Value(piece.folds, "folds", 1.0f, 60.0f, 14.0f)), pattern.seed + 5) {
    hem_ = Value(piece.hem, "hem", 0.0f, 2.0f);
    top_ = Value(piece.top, "top", hem_ + 0.05f, 2.0f);
    corners_ = Value(piece.corners, "corners", -0.5f, 0.5f);
    fullness_ = Value(piece.fullness, "fullness", 1.0f, 3.0f, 1.0f);
    ease_ = Value(piece.ease, "ease", 0.0f, 0.3f);
    ease_hem_ = Value(piece.ease_hem, "ease_hem", 0.0f, 0.3f, ease_);
    const float from = Value(piece.from, "from", -360.0f, 360.0f);
    const float to = Value(piece.to, "to", from + 10.0f, from + 360.0f, from + 360.0f);
    closed_ = to > from + 359.9f;
    middle_ = kPiF * (0.5f * (from + to) / 180.0f);
    half_turn_ = kPiF * (0.5f * (to - from) / 180.0f);
    girdle_ = MeasureGirdle(pattern, measures_);
    girdle_.tied &= !limb_ && pattern.design->Find(Placement::kFront) == nullptr;
    waist_ = measures_.Of("waist");
    if (!limb_) {
      outlines_.emplace_back(body, standing_, worn_, false);
    }
    for (size_t side = 0; limb_ && side < 2; ++side) {
      constexpr const char* kJoints[2][2] = {{"l_hip", "r_hip"}, {"l_shoulder", "r_shoulder"}};
      outlines_.emplace_back(body, standing_, kJoints[piece.about == About::kArms][side]);
    }
    const float height = 0.5f * (top_ + hem_);
    for (int i = -30; i < 30; ++i) {
      width_ += fullness_ * glm::distance(Curve(0, float(i) / 30.0f, 0.0f, height),
                                          Curve(0, float(i + 1) / 30.0f, 0.0f, height));
    }
    depth_ = FoldDepth(
        [&](float share, float out) { return Curve(0, 2.0f * share - 1.0f, out, height); }, wave_,
        0.0f, 1.0f, width_, 0.03f);
  }

  Result<DrapedGarment> Drape() {
    LARARIUM_RETURN_IF_ERROR(measures_.error());
    LayOut();
    DrapedGarment result;
    Settle(100, 0.0125f, 0.014f);
    const std::vector<float> distances =
        TakeWeights(body_, standing_,
                    piece_.about == About::kArms   ? WeightSource::kArms
                    : piece_.about == About::kLegs ? WeightSource::kLegs
                                                   : WeightSource::kArmless,
                    sheet_);
    SmoothWeights(sheet_, limb_ ? 2 : 8, distances);
    Divide(1, sheet_, result);
    Settle(40, 0.01f, 0.008f);
    std::copy_n(sheet_.positions.begin(), result.coarse_positions.size(),
                result.coarse_positions.begin());
    Finish(result);
    return result;
  }

 private:
  float Value(const Formula& formula,
              const char* field,
              float least,
              float most,
              float otherwise = 0.0f) const {
    return measures_.Value(formula, "piece \"" + piece_.name + "\": " + field, least, most,
                           otherwise);
  }

  // Cloth about the trunk hangs from its top, and cloth about a limb lies close to it.
  glm::vec3 Curve(size_t tube, float across, float out, float height) const {
    const Outline& outline = outlines_[tube];
    const float angle = middle_ + half_turn_ * across;
    const float down = (top_ - height) / (top_ - hem_);
    const float radius = limb_
                             ? outline.Radius(angle, height) + pattern_.design->fabric.material.gap
                             : outline.Hanging(angle, top_, height) + 0.014f;
    return outline.Place(angle, radius + glm::mix(ease_, ease_hem_, down) + out, height);
  }

  void LayOut() {
    Random random(pattern_.seed, 5);
    std::vector<std::array<uint32_t, 2>> seam;
    for (uint8_t tube = 0; tube < outlines_.size(); ++tube) {
      GridPanel grid;
      grid.columns = 23;
      grid.rows = 1 + static_cast<size_t>(std::round(
                          (top_ - hem_) / ((limb_ ? 0.03f : 0.05f) * body_.height / 1.7f)));
      const auto share = [&](size_t column, size_t row) {
        return glm::vec2(float(column) / float(grid.columns - 1),
                         float(row) / float(grid.rows - 1));
      };
      grid.flat = [&](size_t column, size_t row) {
        if (!limb_) {
          return glm::vec2(width_, top_ - hem_) * share(column, row);
        }
        // A foot is wider than its ankle, so cloth about a limb is cut by its surface.
        glm::vec2 flat(0.0f);
        for (size_t k = 0; k < column; ++k) {
          flat.x += glm::distance(grid.place(k, row), grid.place(k + 1, row));
        }
        for (size_t k = 0; k < row; ++k) {
          flat.y += glm::distance(grid.place(column, k), grid.place(column, k + 1));
        }
        return flat;
      };
      grid.place = [&](size_t column, size_t row) {
        const glm::vec2 at = share(column, row);
        // Gathered on the cord, slightly longer at the corners.
        const float across = 2.0f * at.x - 1.0f;
        const float height = glm::mix(top_, hem_ - corners_ * across * across, at.y);
        const float fold = depth_ * glm::mix(0.3f, 1.0f, glm::smoothstep(0.0f, 0.5f, at.y));
        const float ripple = limb_ ? 0.0f : 0.001f * float(random.Normal());
        return Curve(tube, across, fold * (1.0f + wave_.At(at.x)) + ripple, height);
      };
      const uint32_t first = AddPanel(sheet_, grid, tube);
      for (uint32_t row = 0; closed_ && row < grid.rows; ++row) {
        const uint32_t left = first + row * uint32_t(grid.columns);
        seam.push_back({left, left + uint32_t(grid.columns) - 1});
      }
    }
    Sew(sheet_, seam);
  }

  void Settle(int steps, float cell, float own_gap) {
    DrapeMaterial material = pattern_.design->fabric.material;
    material.own_gap = limb_ ? 0.0f : own_gap;
    const BodyField field =
        FieldOf(standing_, cell, 3.0f * cell, piece_.about == About::kArms, worn_);
    Draper draper(sheet_, material, progress_);
    // A tube is stretched over its limb, and would otherwise sag into creases above the foot.
    draper.TakeLengths(limb_ ? 1.0f : 1.01f);
    draper.gravity = limb_ ? 0.0f : 1.5f;
    draper.floor = true;
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      if (sheet_.flat[v].y < 1e-4f) {
        draper.pins.push_back({sheet_.particle[v], sheet_.positions[sheet_.particle[v]], 1.0f});
      }
    }
    draper.Run(steps, field);
  }

  void Finish(DrapedGarment& result) {
    result.skin = standing_.skin;
    for (const glm::vec3& p : sheet_.positions) {
      const float below = limb_ ? 0.0f : std::min(top_ - 0.05f, waist_) - p.y;
      result.reach.push_back(below <= 0.0f ? 0.0f : 0.015f + 0.5f * below);
    }
    result.dye = [length = top_ - hem_, dyer = Dyer(pattern_, measures_)](
                     uint8_t, const glm::vec2& flat) { return dyer.At(false, length - flat.y); };
    if (girdle_.tied) {
      // The girdle goes around the garment and the garments below.
      Sheet all = sheet_;
      for (const Sheet* below : worn_) {
        all.positions.insert(all.positions.end(), below->positions.begin(), below->positions.end());
      }
      result.trims.push_back(TieGirdle(girdle_, body_, standing_, all));
    }
    result.sheet = std::move(sheet_);
    result.cover_margin = 0.03f;
  }

  const GarmentPattern& pattern_;
  const Piece& piece_;
  const Progress& progress_;
  const FittedBody& body_;
  PosedBody standing_;
  std::vector<const Sheet*> worn_;
  bool limb_;
  Measures measures_;
  FoldWave wave_;
  std::vector<Outline> outlines_;  // The trunk, or the left and the right limb.
  Girdle girdle_;
  float hem_ = 0.5f;
  float top_ = 1.0f;
  float waist_ = 1.0f;
  float corners_ = 0.02f;
  float fullness_ = 1.22f;  // Width of the cloth relative to its span.
  float ease_ = 0.0f;       // Distance from the body at the top, beside the cloth's thickness.
  float ease_hem_ = 0.0f;
  bool closed_ = false;
  float middle_ = kPiF;  // Angle of the middle of the cloth.
  float half_turn_ = 0.5f * kPiF;
  float width_ = 0.0f;  // Width of the cloth halfway down.
  float depth_ = 0.01f;
  Sheet sheet_;
};

}  // namespace

Result<DrapedGarment> DrapeAround(const GarmentPattern& pattern,
                                  const Piece& piece,
                                  const FittedBody& body,
                                  std::span<const DrapedGarment> worn,
                                  const Progress& progress) {
  return AroundDraper(pattern, piece, body, worn, progress).Drape();
}

}  // namespace lararium::import
