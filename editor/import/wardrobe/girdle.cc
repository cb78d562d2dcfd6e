#include "editor/import/wardrobe/girdle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "editor/import/wardrobe/skin_weights.h"

namespace lararium::import {
namespace {

constexpr int kGirdleColumns = 72;  // Points around the waist.

// Distance of the outer cloth from the middle at each angle near a height.
std::vector<float> OuterRadius(const Girth& girth, const Sheet& worn, float height, float slab) {
  std::vector<float> radius;
  for (int k = 0; k < kGirdleColumns; ++k) {
    radius.push_back(girth.Radius(glm::two_pi<float>() * k / kGirdleColumns) + 0.012f);
  }
  for (const glm::vec3& p : worn.positions) {
    const float out = glm::length(glm::vec2(p.x - girth.middle().x, p.z - girth.middle().z));
    const float angle = girth.AngleOf(p);
    const int k = static_cast<int>(
                      std::floor(angle / glm::two_pi<float>() * kGirdleColumns + kGirdleColumns)) %
                  kGirdleColumns;
    if (std::abs(p.y - height) < slab && out < girth.Radius(angle) + 0.08f) {
      radius[k] = std::max(radius[k], out);
      radius[(k + 1) % kGirdleColumns] = std::max(radius[(k + 1) % kGirdleColumns], out);
    }
  }
  for (int round = 0; round < 3; ++round) {
    const std::vector<float> before = radius;
    for (int k = 0; k < kGirdleColumns; ++k) {
      radius[k] = 0.25f * before[(k + kGirdleColumns - 1) % kGirdleColumns] + 0.5f * before[k] +
                  0.25f * before[(k + 1) % kGirdleColumns];
    }
  }
  return radius;
}

}  // namespace

Girdle MeasureGirdle(const GarmentPattern& pattern, const Measures& measures) {
  Girdle girdle;
  girdle.height = measures.Of("waist");
  if (const auto& design = pattern.design->girdle) {
    girdle.tied = measures.IsTrue(design->when, true);
    girdle.height = measures.Value(design->height, "girdle: height", 0.2f, 2.0f);
    girdle.lift = measures.Value(design->lift, "girdle: lift", 0.0f, 0.3f);
    girdle.half = 0.5f * measures.Value(design->width, "girdle: width", 0.0f, 0.3f);
    girdle.round = measures.IsTrue(design->round, false);
    girdle.colour = design->shade * pattern.Colour(design->colour);
  }
  return girdle;
}

Trim TieGirdle(const Girdle& girdle,
               const FittedBody& body,
               const PosedBody& standing,
               const Sheet& worn) {
  const float height = girdle.height;
  const float half = girdle.half;
  const bool cord = girdle.round;
  const float thick = cord ? 0.009f : 0.004f;
  const Girth girth(body, standing, height, 0.025f);
  const std::vector<float> radius = OuterRadius(girth, worn, height, half + 0.012f);
  Trim trim;
  trim.colour = girdle.colour;
  // Around the waist: a section of five points from the lower edge over the outside to the
  // upper edge.
  GridPanel ring;
  ring.columns = kGirdleColumns + 1;
  ring.rows = 5;
  const auto section = [&](float k, size_t row) {
    const float turn = glm::pi<float>() * static_cast<float>(row) / 4.0f;
    return glm::vec2(thick * (cord ? std::sin(turn) : std::min(1.0f, 2.0f * std::sin(turn))),
                     half * std::cos(turn)) +
           glm::vec2(0.001f, cord ? 0.0015f * std::sin(40.0f * k) : 0.0f);
  };
  ring.flat = [&](size_t column, size_t row) {
    return glm::vec2(girth.Length() * static_cast<float>(column) / kGirdleColumns,
                     half * static_cast<float>(row) / 2.0f);
  };
  ring.place = [&](size_t column, size_t row) {
    const float angle = glm::two_pi<float>() * static_cast<float>(column) / kGirdleColumns;
    const glm::vec2 out = section(angle, row);
    const float r = radius[column % kGirdleColumns] + out.x;
    return girth.middle() + glm::vec3(r * std::sin(angle), out.y, r * std::cos(angle));
  };
  AddPanel(trim.sheet, ring, 0);
  std::vector<std::array<uint32_t, 2>> seam;
  for (uint32_t row = 0; row < 5; ++row) {
    seam.push_back({row * (kGirdleColumns + 1), row * (kGirdleColumns + 1) + kGirdleColumns});
  }
  Sew(trim.sheet, seam);
  // The ends hang from the knot, slightly left of the middle.
  const float knot = glm::pi<float>() + 0.12f;
  for (const int end : {-1, 1}) {
    GridPanel strap;
    const float length = cord ? 0.16f : 0.13f;
    strap.columns = 5;
    strap.rows = 7;
    const float lean = 0.05f * static_cast<float>(end) + 0.02f;
    strap.flat = [&](size_t column, size_t row) {
      return glm::vec2(0.01f * static_cast<float>(column), length * static_cast<float>(row) / 6.0f);
    };
    strap.place = [&](size_t column, size_t row) {
      const float down = static_cast<float>(row) / 6.0f;
      const float turn = glm::pi<float>() * (static_cast<float>(column) / 4.0f - 0.5f);
      const float wide = cord ? 0.006f : 0.011f;
      const float angle = knot + lean * (0.35f + 1.3f * down);
      const glm::vec3 out(std::sin(angle), 0.0f, std::cos(angle));
      const glm::vec3 side(std::cos(angle), 0.0f, -std::sin(angle));
      const float y = height + 0.004f - length * down;
      float r = girth.Radius(angle) + 0.012f;
      for (const glm::vec3& p : worn.positions) {
        if (std::abs(p.y - y) < 0.02f && glm::dot(p - girth.middle(), out) > 0.0f &&
            std::abs(glm::dot(p - girth.middle(), side)) < 0.025f) {
          r = std::max(r, glm::dot(p - girth.middle(), out));
        }
      }
      const glm::vec3 at(girth.middle().x, y, girth.middle().z);
      return at + out * (r + 0.006f + 0.004f * std::cos(turn)) + side * (wide * std::sin(turn));
    };
    AddPanel(trim.sheet, strap, 0);
  }
  // The knot is a small flattened ball.
  GridPanel ball;
  ball.columns = 9;
  ball.rows = 6;
  const int k = static_cast<int>(knot / glm::two_pi<float>() * kGirdleColumns) % kGirdleColumns;
  const glm::vec3 out(std::sin(knot), 0.0f, std::cos(knot));
  const glm::vec3 side(std::cos(knot), 0.0f, -std::sin(knot));
  const glm::vec3 centre = girth.middle() + out * (radius[k] + thick);
  const float size = cord ? 0.013f : 0.019f;
  ball.flat = [](size_t column, size_t row) { return 0.01f * glm::vec2(column, row); };
  ball.place = [&](size_t column, size_t row) {
    const float a = glm::two_pi<float>() * static_cast<float>(column) / 8.0f;
    const float b = glm::pi<float>() * static_cast<float>(row) / 5.0f;
    return centre +
           size * (0.6f * std::sin(b) * std::cos(a) * out - std::sin(b) * std::sin(a) * side +
                   0.9f * std::cos(b) * glm::vec3(0, 1, 0));
  };
  AddPanel(trim.sheet, ball, 0);
  const std::vector<float> distances =
      TakeWeights(body, standing, WeightSource::kTrunk, trim.sheet);
  SmoothWeights(trim.sheet, 3, distances);
  return trim;
}

}  // namespace lararium::import
