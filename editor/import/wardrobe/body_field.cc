#include "editor/import/wardrobe/body_field.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace lararium::import {

// A triangle with the normals of its corners and sides (side k is from corner k to k + 1).
struct FieldTriangle {
  std::array<glm::vec3, 3> corners;
  std::array<glm::vec3, 3> corner_normals;
  std::array<glm::vec3, 3> side_normals;
  glm::vec3 normal;
};

namespace {

constexpr float kUnset = 1e3f;
constexpr float kRounding = 1e-5f;  // Metres.

struct Nearest {
  glm::vec3 point;
  glm::vec3 normal;  // Normal of the feature that contains the point.
};

// The nearest point of a triangle (Ericson, "Real-Time Collision Detection", 5.1.5).
Nearest NearestOn(const FieldTriangle& t, const glm::vec3& p) {
  const auto& [a, b, c] = t.corners;
  const glm::vec3 ab = b - a;
  const glm::vec3 ac = c - a;
  const glm::vec3 ap = p - a;
  const float d1 = glm::dot(ab, ap);
  const float d2 = glm::dot(ac, ap);
  if (d1 <= 0.0f && d2 <= 0.0f) {
    return {a, t.corner_normals[0]};
  }
  const glm::vec3 bp = p - b;
  const float d3 = glm::dot(ab, bp);
  const float d4 = glm::dot(ac, bp);
  if (d3 >= 0.0f && d4 <= d3) {
    return {b, t.corner_normals[1]};
  }
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
    return {a + ab * (d1 / (d1 - d3)), t.side_normals[0]};
  }
  const glm::vec3 cp = p - c;
  const float d5 = glm::dot(ab, cp);
  const float d6 = glm::dot(ac, cp);
  if (d6 >= 0.0f && d5 <= d6) {
    return {c, t.corner_normals[2]};
  }
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
    return {a + ac * (d2 / (d2 - d6)), t.side_normals[2]};
  }
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
    return {b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), t.side_normals[1]};
  }
  const float denominator = 1.0f / (va + vb + vc);
  return {a + ab * (vb * denominator) + ac * (vc * denominator), t.normal};
}

float AngleAt(const glm::vec3& corner, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 u = b - corner;
  const glm::vec3 v = c - corner;
  const float lengths = std::sqrt(glm::dot(u, u) * glm::dot(v, v));
  return lengths > 0.0f ? std::acos(std::clamp(glm::dot(u, v) / lengths, -1.0f, 1.0f)) : 0.0f;
}

std::vector<FieldTriangle> WithNormals(std::span<const glm::vec3> positions,
                                       std::span<const Triangle> triangles) {
  std::vector<glm::vec3> corner_normals(positions.size(), glm::vec3(0.0f));
  std::map<std::pair<uint32_t, uint32_t>, glm::vec3> side_normals;
  std::vector<glm::vec3> normals;
  for (const Triangle& t : triangles) {
    const glm::vec3 cross =
        glm::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
    const float length = glm::length(cross);
    normals.push_back(length > 0.0f ? cross / length : glm::vec3(0.0f));
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k];
      const uint32_t b = t[(k + 1) % 3];
      corner_normals[a] +=
          AngleAt(positions[a], positions[b], positions[t[(k + 2) % 3]]) * normals.back();
      side_normals.try_emplace({std::min(a, b), std::max(a, b)}, 0.0f).first->second +=
          normals.back();
    }
  }
  std::vector<FieldTriangle> result;
  for (size_t i = 0; i < triangles.size(); ++i) {
    FieldTriangle t;
    t.normal = normals[i];
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = triangles[i][k];
      const uint32_t b = triangles[i][(k + 1) % 3];
      t.corners[k] = positions[a];
      t.corner_normals[k] = corner_normals[a];
      t.side_normals[k] = side_normals[{std::min(a, b), std::max(a, b)}];
    }
    result.push_back(t);
  }
  return result;
}

}  // namespace

BodyField::BodyField(std::span<const glm::vec3> extent, float cell, float band)
    : cell_(cell), band_(band) {
  glm::vec3 low(1e9f);
  glm::vec3 high(-1e9f);
  for (const glm::vec3& p : extent) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 margin(band + 2.0f * cell);
  origin_ = low - margin;
  for (int k = 0; k < 3; ++k) {
    size_[k] = static_cast<int>(std::ceil((high[k] - low[k] + 2.0f * margin[k]) / cell)) + 1;
  }
  distance_.assign(size_t(size_[0]) * size_t(size_[1]) * size_t(size_[2]), kUnset);
}

void BodyField::Add(std::span<const glm::vec3> positions, std::span<const Triangle> triangles) {
  BodyField own = *this;
  std::fill(own.distance_.begin(), own.distance_.end(), kUnset);
  for (const FieldTriangle& t : WithNormals(positions, triangles)) {
    own.AddTriangle(t);
  }
  for (size_t i = 0; i < distance_.size(); ++i) {
    distance_[i] = std::min(distance_[i], own.distance_[i]);
  }
}

void BodyField::AddTriangle(const FieldTriangle& t) {
  const auto& [a, b, c] = t.corners;
  const glm::vec3 low = (glm::min(glm::min(a, b), c) - band_ - origin_) / cell_;
  const glm::vec3 high = (glm::max(glm::max(a, b), c) + band_ - origin_) / cell_;
  const glm::vec3 middle = (a + b + c) / 3.0f;
  const float radius =
      std::max({glm::distance(a, middle), glm::distance(b, middle), glm::distance(c, middle)});
  int first[3] = {};
  int last[3] = {};
  for (int k = 0; k < 3; ++k) {
    first[k] = std::max(0, static_cast<int>(std::ceil(low[k])));
    last[k] = std::min(size_[k] - 1, static_cast<int>(std::floor(high[k])));
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const glm::vec3 p = origin_ + cell_ * glm::vec3(x, y, z);
        float& stored = distance_[Index(x, y, z)];
        // The triangle is no nearer than its plane and the sphere about it, to within rounding.
        const float reach = std::min(band_, std::abs(stored)) + kRounding;
        const glm::vec3 from_middle = p - middle;
        if (std::abs(glm::dot(p - a, t.normal)) > reach ||
            glm::dot(from_middle, from_middle) > (reach + radius) * (reach + radius)) {
          continue;
        }
        const Nearest nearest = NearestOn(t, p);
        const glm::vec3 offset = p - nearest.point;
        const float distance = glm::length(offset);
        if (distance <= band_ && distance < std::abs(stored)) {
          stored = std::copysign(distance, glm::dot(offset, nearest.normal));
        }
      }
    }
  }
}

// Cells without a near surface that are connected to the border of the grid are outside.
void BodyField::Finish() {
  constexpr float kInside = -kUnset;
  std::vector<size_t> open;
  const auto reach = [&](int x, int y, int z) {
    if (x >= 0 && y >= 0 && z >= 0 && x < size_[0] && y < size_[1] && z < size_[2] &&
        distance_[Index(x, y, z)] == kUnset) {
      distance_[Index(x, y, z)] = band_;
      open.push_back(Index(x, y, z));
    }
  };
  reach(0, 0, 0);  // The border is connected, because no surface comes near it.
  while (!open.empty()) {
    const size_t i = open.back();
    open.pop_back();
    const int x = static_cast<int>(i % size_t(size_[0]));
    const int y = static_cast<int>(i / size_t(size_[0]) % size_t(size_[1]));
    const int z = static_cast<int>(i / size_t(size_[0]) / size_t(size_[1]));
    for (const int step : {-1, 1}) {
      reach(x + step, y, z);
      reach(x, y + step, z);
      reach(x, y, z + step);
    }
  }
  for (float& distance : distance_) {
    distance = distance == kUnset || distance == kInside ? -band_ : distance;
  }
}

FieldSample BodyField::Sample(const glm::vec3& point) const {
  const glm::vec3 q = (point - origin_) / cell_;
  int i[3];
  float f[3];
  for (int k = 0; k < 3; ++k) {
    if (!(q[k] >= 0.0f) || q[k] >= static_cast<float>(size_[k] - 1)) {
      return {};
    }
    i[k] = static_cast<int>(q[k]);
    f[k] = q[k] - static_cast<float>(i[k]);
  }
  const size_t row = size_t(size_[0]);
  const size_t slice = row * size_t(size_[1]);
  const float* d = &distance_[Index(i[0], i[1], i[2])];
  const float x00 = glm::mix(d[0], d[1], f[0]);
  const float x10 = glm::mix(d[row], d[row + 1], f[0]);
  const float x01 = glm::mix(d[slice], d[slice + 1], f[0]);
  const float x11 = glm::mix(d[slice + row], d[slice + row + 1], f[0]);
  const float y0 = glm::mix(x00, x10, f[1]);
  const float y1 = glm::mix(x01, x11, f[1]);
  FieldSample sample;
  sample.distance = glm::mix(y0, y1, f[2]);
  const auto step_x = [&](size_t at) { return d[at + 1] - d[at]; };
  const glm::vec3 gradient(glm::mix(glm::mix(step_x(0), step_x(row), f[1]),
                                    glm::mix(step_x(slice), step_x(slice + row), f[1]), f[2]),
                           glm::mix(x10 - x00, x11 - x01, f[2]), y1 - y0);
  const float length = glm::length(gradient);
  if (length > 1e-6f) {
    sample.outward = gradient / length;
  }
  return sample;
}

}  // namespace lararium::import
