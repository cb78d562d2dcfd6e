#include "shared/render/passes/key_light.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lararium::render {

KeyLight EstimateKeyLight(const light::ShRgb& radiance) {
  KeyLight key;
  const glm::vec3 luminance(0.2126f, 0.7152f, 0.0722f);
  const glm::vec3 linear(glm::dot(radiance[3], luminance), glm::dot(radiance[1], luminance),
                         glm::dot(radiance[2], luminance));
  const float length = glm::length(linear);
  if (!(length > 1e-6f)) {
    return key;
  }
  key.direction = linear / length;
  const auto basis = light::EvaluateShBasis(key.direction);
  glm::vec3 product(0.0f);
  float square = 0.0f;
  for (int i = 1; i < light::kPlainShCount; ++i) {
    product += radiance[i] * basis[i];
    square += basis[i] * basis[i];
  }
  // The uniform light is the rest of the constant band, which must not become negative.
  key.irradiance =
      glm::clamp(product / square, glm::vec3(0.0f), glm::max(radiance[0], 0.0f) / basis[0]);
  return key;
}

}  // namespace lararium::render
