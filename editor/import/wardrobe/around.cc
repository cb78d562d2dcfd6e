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
               const FittedBody& body,
               std::span<const DrapedGarment> worn,
               const Progress& progress)
      : pattern_(pattern),
        progress_(progress),
        body_(body),
        standing_(PoseBody(body, StandingTurns(body, 1.0f))),
        worn_(SheetsOf(worn)),
        outline_(body, standing_, worn_, false),
        measures_(pattern, body, standing_, 0.012f),
        wave_(Folds(), pattern.seed + 5) {
    const auto value = [&](const Formula& formula, const char* field, float least, float most) {
      return measures_.Value(formula, What() + field, least, most);
    };
    const Piece& piece = Cut();
    hem_ = value(piece.hem, "hem", 0.0f, 2.0f);
    top_ = value(piece.top, "top", hem_ + 0.05f, 2.0f);
    corners_ = value(piece.corners, "corners", -0.5f, 0.5f);
    fullness_ = value(piece.fullness, "fullness", 1.0f, 3.0f);
    const float from = value(piece.from, "from", -360.0f, 360.0f);
    const float to = value(piece.to, "to", from + 10.0f, from + 360.0f);
    middle_ = kPiF * (0.5f * (from + to) / 180.0f);
    half_turn_ = kPiF * (0.5f * (to - from) / 180.0f);
    girdle_ = MeasureGirdle(pattern, measures_);
    waist_ = measures_.Of("waist");
    MeasureFolds();
  }

  Result<DrapedGarment> Drape() {
    LARARIUM_RETURN_IF_ERROR(measures_.error());
    LayOut();
    DrapedGarment result;
    Settle(100, 0.0125f, 0.014f);
    const std::vector<float> distances =
        TakeWeights(body_, standing_, WeightSource::kArmless, sheet_);
    SmoothWeights(sheet_, 8, distances);
    Divide(1, sheet_, result);
    Settle(40, 0.01f, 0.008f);
    std::copy_n(sheet_.positions.begin(), result.coarse_positions.size(),
                result.coarse_positions.begin());
    Finish(result);
    return result;
  }

 private:
  const Piece& Cut() const { return pattern_.design->pieces[0]; }
  std::string What() const { return "piece \"" + Cut().name + "\": "; }
  int Folds() const {
    return static_cast<int>(measures_.Value(Cut().folds, What() + "folds", 1.0f, 60.0f));
  }

  float Angle(float across) const { return middle_ + half_turn_ * across; }
  glm::vec3 Curve(float across, float out, float height) const {
    const float angle = Angle(across);
    return outline_.Place(angle, outline_.Hanging(angle, top_, height) + 0.014f + out, height);
  }

  void MeasureFolds() {
    const float middle = 0.5f * (top_ + hem_);
    const auto curve = [&](float share, float out) {
      return Curve(2.0f * share - 1.0f, out, middle);
    };
    float span = 0.0f;
    for (int i = 0; i < 60; ++i) {
      span += glm::distance(curve(float(i) / 60.0f, 0.0f), curve(float(i + 1) / 60.0f, 0.0f));
    }
    width_ = fullness_ * span;
    depth_ = FoldDepth(curve, wave_, 0.0f, 1.0f, width_, 0.03f);
  }

  void LayOut() {
    Random random(pattern_.seed, 5);
    GridPanel grid;
    grid.columns = 23;
    grid.rows = 1 + static_cast<size_t>(std::round((top_ - hem_) / (0.05f * body_.height / 1.7f)));
    grid.flat = [&](size_t column, size_t row) {
      return glm::vec2(width_ * float(column) / float(grid.columns - 1),
                       (top_ - hem_) * float(row) / float(grid.rows - 1));
    };
    grid.place = [&](size_t column, size_t row) {
      const float share = float(column) / float(grid.columns - 1);
      const float down = float(row) / float(grid.rows - 1);
      // Gathered on the cord, slightly longer at the corners.
      const float across = 2.0f * share - 1.0f;
      const float height = glm::mix(top_, hem_ - corners_ * across * across, down);
      const float fold = depth_ * glm::mix(0.3f, 1.0f, glm::smoothstep(0.0f, 0.5f, down));
      return Curve(across, fold * (1.0f + wave_.At(share)) + 0.001f * float(random.Normal()),
                   height);
    };
    AddPanel(sheet_, grid, 0);
  }

  void Settle(int steps, float cell, float own_gap) {
    DrapeMaterial material = pattern_.design->fabric.material;
    material.own_gap = own_gap;
    const BodyField field = FieldOver(standing_, worn_, cell, 3.0f * cell);
    Draper draper(sheet_, material, progress_);
    draper.TakeLengths(1.01f);
    draper.gravity = 1.5f;
    for (uint32_t p = 0; p < sheet_.positions.size(); ++p) {
      if (sheet_.flat[p].y < 1e-4f) {
        draper.pins.push_back({p, sheet_.positions[p], 1.0f});
      }
    }
    draper.Run(steps, field);
  }

  void Finish(DrapedGarment& result) {
    result.skin = standing_.skin;
    for (const glm::vec3& p : sheet_.positions) {
      const float below = std::min(top_ - 0.05f, waist_) - p.y;
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
  const Progress& progress_;
  const FittedBody& body_;
  PosedBody standing_;
  std::vector<const Sheet*> worn_;
  Outline outline_;
  Measures measures_;
  FoldWave wave_;
  Girdle girdle_;
  float hem_ = 0.5f;
  float top_ = 1.0f;
  float waist_ = 1.0f;
  float corners_ = 0.02f;
  float fullness_ = 1.22f;  // Width of the cloth relative to its span.
  float middle_ = kPiF;     // Angle of the middle of the cloth.
  float half_turn_ = 0.5f * kPiF;
  float width_ = 0.6f;
  float depth_ = 0.01f;
  Sheet sheet_;
};

}  // namespace

Result<DrapedGarment> DrapeAround(const GarmentPattern& pattern,
                                  const FittedBody& body,
                                  std::span<const DrapedGarment> worn,
                                  const Progress& progress) {
  return AroundDraper(pattern, body, worn, progress).Drape();
}

}  // namespace lararium::import
