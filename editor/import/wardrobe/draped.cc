#include "editor/import/wardrobe/draped.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace lararium::import {

std::vector<JointTurn> StandingTurns(const FittedBody& body, float share) {
  std::vector<JointTurn> turns = ArmsLowered(body, 0.3f, share);
  // The ankles are slightly further apart than the hip joints.
  for (const bool right : {false, true}) {
    const auto place = [&](const char* r, const char* l) {
      return glm::vec3(
          glm::inverse(body.skeleton.joint_from_actor[JointNumber(body, right ? r : l)])[3]);
    };
    const glm::vec3 hip = place("r_hip", "l_hip");
    const glm::vec3 ankle = place("r_ankle", "l_ankle");
    const float now = std::atan2(ankle.x - hip.x, hip.y - ankle.y);
    const float wanted = std::atan2(0.35f * hip.x, hip.y - ankle.y);
    const glm::quat turn = glm::angleAxis(share * (wanted - now), glm::vec3(0.0f, 0.0f, 1.0f));
    turns.emplace_back(right ? "r_hip" : "l_hip", turn);
    turns.emplace_back(right ? "r_ankle" : "l_ankle", glm::inverse(turn));
  }
  return turns;
}

void Divide(int times, Sheet& sheet, DrapedGarment& garment) {
  garment.coarse_positions = sheet.positions;
  garment.coarse_triangles = sheet.ParticleTriangles();
  for (int i = 0; i < times; ++i) {
    sheet = Subdivided(sheet);
  }
  const size_t share = sheet.triangles.size() / garment.coarse_triangles.size();
  garment.coarse_of.clear();
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    garment.coarse_of.push_back(static_cast<uint32_t>(t / share));
  }
}

std::vector<const Sheet*> SheetsOf(std::span<const DrapedGarment> worn) {
  std::vector<const Sheet*> sheets;
  for (const DrapedGarment& garment : worn) {
    sheets.push_back(&garment.sheet);
  }
  return sheets;
}

}  // namespace lararium::import
