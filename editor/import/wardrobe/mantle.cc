#include "editor/import/wardrobe/mantle.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "editor/import/wardrobe/drape.h"
#include "editor/import/wardrobe/measures.h"
#include "editor/import/wardrobe/outline.h"
#include "editor/import/wardrobe/skin_weights.h"
#include "shared/core/random.h"
#include "shared/core/units.h"

namespace lararium::import {
namespace {

// Angles about the axis of the body, as in Girth: 0 is the back, then right, front and left.
constexpr float kLeft = 1.5f * kPiF;

constexpr float kUnsoiled = 10.0f;  // Metres from the hem.

// A knot of a curve through points at increasing angles, with smooth steps between them.
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
               const Piece& piece,
               const FittedBody& body,
               std::span<const DrapedGarment> worn,
               const Progress& progress)
      : pattern_(pattern),
        progress_(progress),
        body_(body),
        standing_(PoseBody(body, StandingTurns(body, 1.0f))),
        worn_(SheetsOf(worn)),
        outline_(body, standing_, worn_, true),
        measures_(pattern, body, standing_, 0.012f),
        scale_(body.height / 1.7f) {
    const std::string what = "piece \"" + piece.name + "\": ";
    hem_ = measures_.Value(piece.hem, what + "hem", 0.0f, 2.0f);
    sinus_ = measures_.IsTrue(piece.sinus, false);
    if (pattern.design->bands) {
      border_ = measures_.IsTrue(pattern.design->bands->border, false);
    }
    colour_ = pattern.Colour(pattern.design->fabric.colour);
    knee_ = measures_.Of("knee");
    for (const Piece::Knot& knot : piece.path) {
      const float least = upper_.empty() ? -360.0f : upper_.back().angle * 180.0f / kPiF + 1.0f;
      const float angle = measures_.Value(knot.at, what + "path: at", least, 720.0f);
      upper_.push_back({angle * kPiF / 180.0f,
                        measures_.Value(knot.height, what + "path: height", hem_ + 0.05f, 2.5f)});
    }
  }

  Result<DrapedGarment> Drape() {
    LARARIUM_RETURN_IF_ERROR(measures_.error());
    LayOut();
    DrapeMaterial material = pattern_.design->fabric.material;
    material.own_gap = 0.016f;
    DrapedGarment result;
    Settle(material, 40, 0.0125f);
    const std::vector<float> distances =
        TakeWeights(body_, standing_, WeightSource::kMantle, sheet_);
    SmoothWeights(sheet_, 8, distances);
    Divide(2, sheet_, result);
    held_.assign(sheet_.positions.size(), false);
    LayFine();
    material.own_gap = 0.006f;
    Settle(material, 16, 0.01f);
    Finish(result);
    return result;
  }

 private:
  static constexpr float kFirst = -0.70f * kPiF;
  static constexpr float kLast = 1.78f * kPiF;
  static constexpr float kSinusFirst = 0.20f * kPiF;
  static constexpr float kSinusLast = kLeft + 0.10f;

  // The first turn is below the second.
  float Layer(float angle) const {
    return 0.012f + 0.018f * std::clamp((angle + kPiF) / (2.2f * kPiF), 0.0f, 1.0f);
  }

  // A row of folds, from -1 in the hollows to 1 on the narrow crests.
  static float Crests(float phase) {
    return 1.0f - 2.0f * std::pow(std::abs(std::sin(0.5f * phase)), 0.8f);
  }

  // Folds run down and away from the left shoulder, over back and chest.
  float Fold(float angle, float down) const {
    const float line = angle + 0.9f * std::cos(angle) * (1.0f - down);
    const float wave = Crests(11.0f * line + 0.9f * std::sin(2.0f * line)) +
                       0.55f * Crests(19.0f * line + 1.3f * std::sin(3.0f * line) + 2.0f);
    return (0.007f + 0.011f * down) * wave;
  }

  // Height at which the hem is cut: it rises towards the ends, which are the corners of the
  // semicircle.
  float Hem(float angle) const {
    const float rise_front = 1.0f - glm::smoothstep(-0.70f * kPiF, -0.45f * kPiF, angle);
    const float rise_back = glm::smoothstep(1.4f * kPiF, 1.78f * kPiF, angle);
    const float left_hand = std::exp(-std::pow((angle - kLeft) / 0.5f, 2.0f)) +
                            std::exp(-std::pow((angle + 0.5f * kPiF) / 0.5f, 2.0f));
    return hem_ + scale_ * ((sinus_ ? -0.04f : 0.10f) * rise_front + 0.25f * rise_back +
                            (sinus_ ? 0.0f : 0.05f) * left_hand);
  }

  // Radius of cloth that does not follow every edge of its support.
  float Around(float angle, float top, float height) const {
    float sum = 0.0f;
    for (int k = -2; k <= 2; ++k) {
      sum += outline_.Hanging(angle + 0.035f * kPiF * float(k), top, height);
    }
    return 0.2f * sum;
  }

  // A point of the cloth around the body. `along` is the share of its width and `down` of its
  // length, 0..1; folds = 0 means without folds.
  glm::vec3 WrapPlace(float along, float down, float folds) const {
    const float angle = glm::mix(kFirst, kLast, along);
    const float top = HeightAt(upper_, angle);
    const float height = glm::mix(top, Hem(angle), down);
    // At the top, folds are flat on the shoulder.
    const float rise = glm::smoothstep(0.0f, 0.12f, down);
    const float radius = Around(angle, top, height) + Layer(angle) * glm::mix(0.4f, 1.0f, rise) +
                         0.012f * down + folds * rise * Fold(angle, down);
    return outline_.Place(angle, radius, height);
  }

  // The bow below the balteus: all its folds come from the left shoulder and go behind the
  // right hip; the lowest hangs before the right knee.
  glm::vec3 SinusPlace(float along, float down, float folds) const {
    const float angle = glm::mix(kSinusFirst, kSinusLast, along);
    const float top = HeightAt(upper_, angle) + 0.012f;
    const float bow = std::pow(std::max(0.0f, std::sin(kPiF * std::pow(along, 0.85f))), 0.75f);
    const float deepest = HeightAt(upper_, 0.62f * kPiF) - knee_ - 0.02f;
    const float height = top - down * (0.04f + bow * deepest);
    const float wave = Crests(glm::two_pi<float>() * 4.0f * std::pow(down, 0.85f) +
                              0.9f * std::sin(4.0f * along) + 1.2f) +
                       0.4f * Crests(glm::two_pi<float>() * 7.0f * down + 2.5f * along);
    const float radius = Around(angle, top, height) + Layer(angle) + 0.028f + 0.03f * bow * down +
                         folds * (0.005f + 0.013f * bow) * wave;
    return outline_.Place(angle, radius, height);
  }

  // A panel of cloth; its flat coordinates determine its position on the body.
  struct Panel {
    size_t columns;
    size_t rows;
    glm::vec2 size;  // metres
  };

  void LayOut() {
    Random random(pattern_.seed, 3);
    panels_ = {{33, 12, glm::vec2(3.1f, 1.1f) * scale_}};
    if (sinus_) {
      panels_.push_back({17, 7, glm::vec2(1.5f, 0.55f) * scale_});
    }
    for (uint8_t panel = 0; panel < panels_.size(); ++panel) {
      const Panel& cloth = panels_[panel];
      GridPanel grid;
      grid.columns = cloth.columns;
      grid.rows = cloth.rows;
      const auto share = [&cloth](size_t column, size_t row) {
        return glm::vec2(float(column) / float(cloth.columns - 1),
                         float(row) / float(cloth.rows - 1));
      };
      grid.flat = [&](size_t column, size_t row) { return cloth.size * share(column, row); };
      grid.place = [&](size_t column, size_t row) {
        const glm::vec2 at = share(column, row);
        return Place(panel, at, 0.0f) + 0.001f * float(random.Normal());
      };
      const uint32_t first = AddPanel(sheet_, grid, panel);
      held_.resize(sheet_.positions.size(), false);
      for (size_t c = 0; c < grid.columns; ++c) {
        held_[first + c] = true;
      }
      // Both ends of the bow are held by the layers over them.
      for (size_t r = 0; panel == 1 && r < grid.rows; ++r) {
        held_[first + r * grid.columns] = true;
        held_[first + (r + 1) * grid.columns - 1] = true;
      }
    }
  }

  glm::vec3 Place(uint8_t panel, const glm::vec2& share, float folds) const {
    return panel == 0 ? WrapPlace(share.x, share.y, folds) : SinusPlace(share.x, share.y, folds);
  }

  // The drawn sheet is fine enough to show folds.
  void LayFine() {
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      const Panel& cloth = panels_[sheet_.panel[v]];
      sheet_.positions[sheet_.particle[v]] =
          Place(sheet_.panel[v], sheet_.flat[v] / cloth.size, 1.0f);
      if (sheet_.flat[v].y < 1e-4f) {
        held_[sheet_.particle[v]] = true;
      }
    }
  }

  void Settle(const DrapeMaterial& material, int steps, float cell) {
    const BodyField field = FieldOf(standing_, cell, 3.0f * cell, false, worn_);
    Draper draper(sheet_, material, progress_);
    draper.TakeLengths(1.01f);
    draper.gravity = 1.0f;
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
    // Cloth below the knee swings; above the knee, cloth rests on cloth.
    for (size_t p = 0; p < sheet_.positions.size(); ++p) {
      const float below = knee_ + 0.03f - sheet_.positions[p].y;
      result.reach.push_back(below <= 0.0f ? 0.0f : 0.015f + 0.5f * below);
    }
    for (size_t v = 0; v < sheet_.flat.size(); ++v) {
      if (sheet_.panel[v] == 1) {
        result.reach[sheet_.particle[v]] = 0.0f;
      }
    }
    const float rows = panels_[0].size.y;
    const float bow = sinus_ ? panels_[1].size.y : 0.0f;
    const float row = panels_[0].size.y / (4.0f * float(panels_[0].rows - 1));
    MarkBands(sheet_, [&](uint8_t panel, const glm::vec2& middle) {
      return border_ && (panel == 0 ? rows : bow) - middle.y < 2.99f * row;
    });
    result.dye = [rows, dyer = Dyer(pattern_, measures_)](uint8_t panel, const glm::vec2& flat) {
      const bool is_wrap = (panel & ~kBand) == 0;
      return dyer.At((panel & kBand) != 0, is_wrap ? rows - flat.y : kUnsoiled);
    };
    result.covers_left_of = JointPlace(body_, standing_, "l_shoulder").x - 0.005f;
    result.covers_above = JointPlace(body_, standing_, "l_elbow").y - 0.05f;
    result.loose_margin = std::clamp(0.4f * hem_, 0.05f, 0.18f);
    result.wraps = sinus_;  // A palla lets the stola below it swing.
    result.cover_margin = 0.03f;
    if (sinus_) {
      result.trims.push_back(RollBalteus());
      result.trims.push_back(PullUmbo());
      result.trims.push_back(ThrowEnd(result.trims));
    }
    result.sheet = std::move(sheet_);
  }

  // Middle of the balteus: 0 under the right arm, 1 on the left shoulder.
  glm::vec3 BalteusPlace(float along, float out, float up) const {
    const float angle = glm::mix(0.12f * kPiF, kLeft + 0.15f, along);
    const float top = HeightAt(upper_, angle);
    return outline_.Place(angle, Around(angle, top + 0.01f, top + up) + Layer(angle) + 0.026f + out,
                          top + up);
  }

  // The upper edge is gathered into a flat band of overlapping folds.
  Trim RollBalteus() const {
    Trim trim;
    trim.colour = colour_;
    GridPanel roll;
    roll.columns = 36;
    roll.rows = 25;
    roll.flat = [&](size_t column, size_t row) {
      return glm::vec2(0.03f * float(column), 0.011f * float(row));
    };
    roll.place = [&](size_t column, size_t row) {
      const float along = float(column) / float(roll.columns - 1);
      const float turn = glm::two_pi<float>() * float(row) / float(roll.rows - 1);
      const float ends = std::min(1.0f, 5.0f * std::min(along, 1.0f - along) + 0.25f);
      // Five folds on the outside, which vary in height slightly.
      const float up = std::sin(turn);
      const float folds = std::max(0.0f, std::cos(turn)) *
                          Crests(5.0f * kPiF * up + 1.5f * std::sin(5.0f * along) + 3.0f * along);
      const float out = 0.013f * std::cos(turn) + 0.0075f * folds;
      return BalteusPlace(along, scale_ * ends * out, scale_ * ends * 0.052f * up);
    };
    const uint32_t first = AddPanel(trim.sheet, roll, 0);
    std::vector<std::array<uint32_t, 2>> seam;
    for (uint32_t c = 0; c < roll.columns; ++c) {
      seam.push_back({first + c, first + uint32_t(roll.rows - 1) * uint32_t(roll.columns) + c});
    }
    Sew(trim.sheet, seam);
    TakeTrimWeights(trim);
    return trim;
  }

  // The umbo: cloth from below, pulled out over the balteus on the left breast so that it hangs
  // over it in small bows.
  Trim PullUmbo() const {
    Trim trim;
    trim.colour = colour_;
    GridPanel pouch;
    pouch.columns = 17;
    pouch.rows = 17;
    const float middle = 1.10f * kPiF;
    pouch.flat = [](size_t column, size_t row) { return 0.012f * glm::vec2(column, row); };
    pouch.place = [&](size_t column, size_t row) {
      const float across = 2.0f * float(column) / float(pouch.columns - 1) - 1.0f;
      const float down = float(row) / float(pouch.rows - 1);
      const float angle = middle + 0.17f * kPiF * across * (1.0f - 0.25f * down);
      const float top = HeightAt(upper_, angle) + 0.03f * scale_;
      const float bow = std::pow(1.0f - across * across, 0.7f);
      const float height = top - scale_ * (0.015f + 0.19f * bow) * down;
      const float bulge = 0.032f * std::sin(kPiF * std::min(1.0f, 0.12f + 0.8f * down)) * bow;
      const float folds = 0.006f * bow * Crests(glm::two_pi<float>() * 3.5f * down + 0.8f * across);
      const float radius =
          outline_.Hanging(angle, top, height) + Layer(angle) + 0.032f + scale_ * (bulge + folds);
      return outline_.Place(angle, radius, height);
    };
    AddPanel(trim.sheet, pouch, 0);
    TakeTrimWeights(trim);
    return trim;
  }

  // A ray of a strip over the left shoulder: its origin and direction, along which the covered
  // garments reach a certain distance. `across` is 0 at the neck, 1 on the upper arm; `along`
  // is in metres from the breast over the shoulder and down the back.
  struct Strip {
    glm::vec3 from = glm::vec3(0.0f);
    glm::vec3 out = glm::vec3(0.0f);  // Unit vector.

    static Strip At(const glm::vec3& joint, float scale, float across, float along) {
      constexpr float kBreast = 0.22f * kPiF;  // Angle above straight ahead.
      const float bend = 0.11f * scale;        // Metres of the path over the shoulder.
      const float angle = std::min(kBreast + along / bend, kPiF);
      const float down = std::max(0.0f, along - (kPiF - kBreast) * bend);
      Strip strip;
      strip.from = {glm::mix(0.26f, 1.45f, across) * joint.x, joint.y - 0.07f * scale - down,
                    joint.z};
      strip.out = {0.0f, std::sin(angle), -std::cos(angle)};
      return strip;
    }
    // Distance along the ray for a point near it; negative for other points.
    float Reach(const glm::vec3& place, float scale) const {
      const glm::vec3 d = place - from;
      const float reach = glm::dot(d, out);
      const glm::vec3 aside = d - reach * out;
      return glm::dot(aside, aside) < 0.035f * 0.035f * scale * scale ? reach : -1.0f;
    }
  };

  // The last end of the mantle, thrown over the left shoulder so that it hangs down the back
  // over all layers that meet there.
  Trim ThrowEnd(std::span<const Trim> trims) const {
    constexpr size_t kColumns = 25;
    constexpr size_t kRows = 33;
    const float length = 0.62f * scale_;
    const glm::vec3 joint = JointPlace(body_, standing_, "l_shoulder");
    std::vector<Strip> strips;
    std::vector<float> reaches;
    for (size_t row = 0; row < kRows; ++row) {
      for (size_t column = 0; column < kColumns; ++column) {
        const float across = float(column) / float(kColumns - 1);
        const float along = float(row) / float(kRows - 1);
        strips.push_back(
            Strip::At(joint, scale_, across, length * along * glm::mix(1.1f, 0.85f, across)));
        reaches.push_back(0.05f * scale_);
      }
    }
    const auto cover = [&](std::span<const glm::vec3> places) {
      for (const glm::vec3& place : places) {
        for (size_t i = 0; place.x < 0.0f && i < strips.size(); ++i) {
          reaches[i] = std::max(reaches[i], strips[i].Reach(place, scale_));
        }
      }
    };
    cover(sheet_.positions);
    for (const Trim& trim : trims) {
      cover(trim.sheet.positions);
    }
    SmoothGrid(kColumns, kRows, reaches);
    Trim end;
    end.colour = colour_;
    GridPanel grid;
    grid.columns = kColumns;
    grid.rows = kRows;
    grid.flat = [](size_t column, size_t row) { return 0.014f * glm::vec2(column, row); };
    grid.place = [&](size_t column, size_t row) {
      const float across = 2.0f * float(column) / float(kColumns - 1) - 1.0f;
      const float along = float(row) / float(kRows - 1);
      const size_t i = row * kColumns + column;
      const float folds = Crests(4.0f * kPiF * across + 1.1f * std::sin(4.0f * along)) +
                          0.4f * Crests(7.0f * kPiF * across + 2.0f);
      // Its edges turn down onto the layers that it covers.
      const float edge = std::pow(std::abs(across), 6.0f) + std::pow(1.0f - along, 12.0f);
      const float out = 0.010f + 0.006f * folds - 0.030f * std::min(edge, 1.0f);
      return strips[i].from + (reaches[i] + scale_ * out) * strips[i].out;
    };
    AddPanel(end.sheet, grid, 0);
    TakeTrimWeights(end);
    return end;
  }

  // Smooths the grid as cloth spans its support.
  static void SmoothGrid(size_t columns, size_t rows, std::vector<float>& values) {
    for (int round = 0; round < 24; ++round) {
      const std::vector<float> before = values;
      const auto at = [&](size_t row, size_t column) {
        return before[std::min(row, rows - 1) * columns + std::min(column, columns - 1)];
      };
      for (size_t r = 0; r < rows; ++r) {
        for (size_t c = 0; c < columns; ++c) {
          const float around = 0.25f * (at(r == 0 ? 0 : r - 1, c) + at(r + 1, c) +
                                        at(r, c == 0 ? 0 : c - 1) + at(r, c + 1));
          // Protrusions sink slowly, hollows fill at once.
          values[r * columns + c] = glm::mix(at(r, c), around, around > at(r, c) ? 1.0f : 0.5f);
        }
      }
    }
  }

  void TakeTrimWeights(Trim& trim) const {
    const std::vector<float> distances =
        TakeWeights(body_, standing_, WeightSource::kMantle, trim.sheet);
    SmoothWeights(trim.sheet, 6, distances);
  }

  const GarmentPattern& pattern_;
  const Progress& progress_;
  const FittedBody& body_;
  PosedBody standing_;
  std::vector<const Sheet*> worn_;
  Outline outline_;
  Measures measures_;
  bool sinus_ = false;
  bool border_ = false;
  glm::vec3 colour_ = glm::vec3(0.0f);
  float scale_;
  float hem_ = 0.3f;
  float knee_ = 0.5f;
  std::vector<Knot> upper_;
  std::vector<Panel> panels_;
  Sheet sheet_;
  std::vector<bool> held_;
};

}  // namespace

Result<DrapedGarment> DrapeMantle(const GarmentPattern& pattern,
                                  const Piece& piece,
                                  const FittedBody& body,
                                  std::span<const DrapedGarment> worn,
                                  const Progress& progress) {
  return MantleDraper(pattern, piece, body, worn, progress).Drape();
}

}  // namespace lararium::import
