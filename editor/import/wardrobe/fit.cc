#include "editor/import/wardrobe/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "editor/import/wardrobe/drape.h"
#include "editor/import/wardrobe/posed_body.h"

namespace lararium::import {
namespace {

constexpr float kDeepInBody = 0.01f;  // metres
constexpr float kFarFromBody = 0.6f;  // metres
// Limits of PieceFit. Today's garments stay below them on all presets.
constexpr float kMostMedian = 1.25f;
constexpr float kMost99 = 2.6f;
constexpr float kMostStretch = 10.0f;
constexpr float kMostInside = 0.03f;
constexpr float kLeastArea = 0.3f;
constexpr float kMostArea = 1.5f;

constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kParts = {
    {{"shoulder", "upper arm"},
     {"elbow", "forearm"},
     {"wrist", "hand"},
     {"sternoclavicular", "shoulder"},
     {"acromioclavicular", "shoulder"},
     {"hip", "thigh"},
     {"knee", "shin"},
     {"ankle", "foot"},
     {"vc", "neck"},
     {"vt", "chest"},
     {"vl", "waist"},
     {"sacroiliac", "hips"}}};

// The part of the body with which a particle moves.
std::string PartOf(const Sheet& sheet, const FittedBody& body, uint32_t particle) {
  const std::span<const float> weights = sheet.WeightsOf(particle);
  const size_t strongest =
      size_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
  std::string_view joint = body.skeleton.names[strongest];
  const std::string side = joint.starts_with("l_")   ? "left "
                           : joint.starts_with("r_") ? "right "
                                                     : "";
  joint.remove_prefix(side.empty() ? 0 : 2);
  const auto* part = std::find_if(kParts.begin(), kParts.end(),
                                  [&](const auto& p) { return joint.starts_with(p.first); });
  return side + std::string(part == kParts.end() ? joint : part->second);
}

// The seam at a vertex; empty if it is not sewn.
std::string SeamAt(const Sheet& sheet, std::span<const Seam> seams, uint32_t vertex) {
  const uint32_t particle = sheet.particle[vertex];
  for (size_t v = 0; v < sheet.flat.size(); ++v) {
    if (sheet.particle[v] == particle && sheet.panel[v] % kBand != sheet.panel[vertex] % kBand) {
      for (const Seam& seam : seams) {
        const bool left = seam.edge == Seam::Edge::kLeftTop || seam.edge == Seam::Edge::kLeftSide;
        const bool top = seam.edge == Seam::Edge::kLeftTop || seam.edge == Seam::Edge::kRightTop;
        if (left == (sheet.flat[vertex].x < 0.0f) && top == (sheet.flat[vertex].y < 0.05f)) {
          return ", seam \"" + seam.name + "\"";
        }
      }
    }
  }
  return {};
}

std::string Percent(float share) {
  return std::to_string(static_cast<int>(std::round(100.0f * share))) + " %";
}

}  // namespace

StandingField::StandingField(const FittedBody& body)
    : StandingField(PoseBody(body, StandingTurns(body, 1.0f))) {}

StandingField::StandingField(const PosedBody& standing)
    : field(FieldOf(standing, 0.01f, 0.03f)), low(1e9f), high(-1e9f) {
  for (const Triangle& t : standing.triangles) {
    low = glm::min(low, standing.positions[t[0]]);
    high = glm::max(high, standing.positions[t[0]]);
  }
}

std::vector<PieceFit> MeasureFit(const DrapedGarment& draped,
                                 std::span<const Piece> pieces,
                                 std::span<const Seam> seams,
                                 const FittedBody& body,
                                 const StandingField& standing) {
  const Sheet& sheet = draped.sheet;
  std::vector<PieceFit> fits;
  const auto piece_of = [&](uint32_t vertex) {
    return std::min<size_t>(sheet.panel[vertex] % kBand, pieces.size() - 1);
  };
  for (size_t piece = 0; !draped.coarse_triangles.empty() && piece < pieces.size(); ++piece) {
    PieceFit fit;
    fit.piece = pieces[piece].name;
    std::vector<float> stretches;
    uint32_t tightest = 0;
    float now = 0.0f;
    float cut = 0.0f;
    for (const Triangle& t : sheet.triangles) {
      if (piece_of(t[0]) != piece) {
        continue;
      }
      const auto side = [&](int k) {
        return std::pair(
            sheet.positions[sheet.particle[t[k]]] - sheet.positions[sheet.particle[t[0]]],
            sheet.flat[t[k]] - sheet.flat[t[0]]);
      };
      const auto [u, flat_u] = side(1);
      const auto [v, flat_v] = side(2);
      now += glm::length(glm::cross(u, v));
      cut += std::abs(flat_u.x * flat_v.y - flat_u.y * flat_v.x);
      for (int k = 0; k < 3; ++k) {
        const uint32_t a = t[k];
        const uint32_t b = t[(k + 1) % 3];
        const glm::vec2 flat = sheet.flat[b] - sheet.flat[a];
        if (IsAcrossThreads(flat)) {
          continue;
        }
        const float stretch =
            glm::distance(sheet.positions[sheet.particle[a]], sheet.positions[sheet.particle[b]]) /
            std::max(glm::length(flat), 1e-4f);
        stretches.push_back(std::isfinite(stretch) ? stretch : 1e9f);
        if (stretches.back() > fit.stretch_most) {
          fit.stretch_most = stretches.back();
          tightest = a;
        }
      }
    }
    if (stretches.empty()) {
      continue;
    }
    fit.area = now / std::max(cut, 1e-6f);
    std::sort(stretches.begin(), stretches.end());
    fit.stretch = stretches[stretches.size() / 2];
    fit.stretch_99 = stretches[stretches.size() * 99 / 100];
    fit.stretched_at =
        PartOf(sheet, body, sheet.particle[tightest]) + SeamAt(sheet, seams, tightest);
    float deepest = kDeepInBody;
    size_t count = 0;
    size_t inside = 0;
    for (uint32_t v = 0; v < sheet.flat.size(); ++v) {
      if (piece_of(v) != piece) {
        continue;
      }
      ++count;
      const glm::vec3& p = sheet.positions[sheet.particle[v]];
      if (!(glm::distance(p, glm::clamp(p, standing.low, standing.high)) < kFarFromBody)) {
        ++fit.lost;
        continue;
      }
      const float depth = -standing.field.Sample(p).distance;
      inside += depth > kDeepInBody ? 1 : 0;
      if (depth > deepest) {
        deepest = depth;
        fit.inside_at = PartOf(sheet, body, sheet.particle[v]);
      }
    }
    fit.inside = static_cast<float>(inside) / static_cast<float>(count);
    fits.push_back(std::move(fit));
  }
  return fits;
}

Status CheckFit(std::span<const PieceFit> fits, const GarmentDesign& design) {
  for (const PieceFit& fit : fits) {
    const auto error = [&](const std::string& problem, std::string_view remedy) {
      return Status::Error(design.file.string(), "piece \"" + fit.piece + "\" " + problem, remedy);
    };
    if (fit.lost > 0) {
      return error("has left the body with " + std::to_string(fit.lost) + " points",
                   "give it a narrower neck, or sew more of its edges");
    }
    if (!(fit.stretch <= kMostMedian && fit.stretch_99 <= kMost99 &&
          fit.stretch_most <= kMostStretch && fit.area <= kMostArea)) {
      return error("is stretched to " + Percent(fit.stretch_most) + " at the " + fit.stretched_at +
                       " (half of it to " + Percent(fit.stretch) + " and more)",
                   "make it wider or longer there, or sew less of its edges");
    }
    if (fit.area < kLeastArea) {
      return error("is crumpled to " + Percent(fit.area) + " of its area", "make it narrower");
    }
    if (fit.inside > kMostInside) {
      return error("is more than 1 cm deep in the body with " + Percent(fit.inside) +
                       " of its points, deepest at the " + fit.inside_at,
                   "make it wider there");
    }
  }
  return {};
}

}  // namespace lararium::import
