#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "shared/core/random.h"
#include "shared/light/blocker_table.h"
#include "shared/light/receivers.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::light {

inline glm::vec3 RandomDirection(Random& random) {
  const double z = random.Uniform(-1.0, 1.0);
  const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

inline glm::quat RandomRotation(Random& random) {
  return glm::normalize(
      glm::quat{static_cast<float>(random.Normal()), static_cast<float>(random.Normal()),
                static_cast<float>(random.Normal()), static_cast<float>(random.Normal())});
}

inline ShRgb RandomCoefficients(Random& random) {
  ShRgb radiance;
  for (glm::vec3& coefficient : radiance) {
    coefficient = glm::vec3{random.Normal(), random.Normal(), random.Normal()};
  }
  return radiance;
}

// Directions of equal solid angle, 4 pi / count each (a Fibonacci spiral).
inline std::vector<glm::vec3> EvenDirections(int count) {
  std::vector<glm::vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
    const double radius = std::sqrt(1.0 - z * z);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

struct Ball {
  glm::vec3 centre;
  float radius;
};

// Balls or points in the format of the functions.
struct BallArrays {
  std::vector<float> x, y, z, radius;

  explicit BallArrays(const std::vector<Ball>& balls) {
    for (const Ball& ball : balls) {
      x.push_back(ball.centre.x);
      y.push_back(ball.centre.y);
      z.push_back(ball.centre.z);
      radius.push_back(ball.radius);
    }
  }
  Spheres spheres() const { return {x, y, z, radius}; }
};

struct PointArrays {
  std::vector<float> x, y, z;

  explicit PointArrays(const std::vector<glm::vec3>& points) {
    for (const glm::vec3& point : points) {
      x.push_back(point.x);
      y.push_back(point.y);
      z.push_back(point.z);
    }
  }
  Points points() const { return {x, y, z}; }
};

struct TurnArrays {
  std::vector<float> w, x, y, z;

  explicit TurnArrays(const std::vector<glm::quat>& turns) {
    for (const glm::quat& turn : turns) {
      w.push_back(turn.w);
      x.push_back(turn.x);
      y.push_back(turn.y);
      z.push_back(turn.z);
    }
  }
  Turns turns() const { return {w, x, y, z}; }
};

// visibility = exp(log visibility) of all receivers.
inline void ExpRows(const ShRows& log_visibility, ShRows& visibility) {
  const ShProductTable& products = ShProductTable::ForCount(log_visibility.count());
  for (size_t i = 0; i < log_visibility.receivers(); i += kLanes) {
    Lanes log[25], result[25];
    for (int k = 0; k < log_visibility.count(); ++k) {
      log[k] = Load(log_visibility.row(k) + i);
    }
    ExpSh(products, log, result);
    for (int k = 0; k < visibility.count(); ++k) {
      Store(result[k], visibility.row(k) + i);
    }
  }
}

}  // namespace lararium::light
