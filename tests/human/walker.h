#pragma once

#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "shared/human/human.h"

namespace lararium::human {

// A human with a single joint at the origin, so that cloth on it hangs in the world frame.
Human OneJointHuman();

// A sheet of columns x rows quads in the plane z = 0 of the first joint, from (0, top) to the right
// and down. Each quad is split along alternating diagonals. No particle is pinned; reach is 100 m.
Cloth Sheet(int columns, int rows, float cell, float top);

// A walker of capsules (pelvis, chest, legs, arms) in a skirt from waist to shins.
// Joints: 0 pelvis, 1 chest, 2 l_thigh, 3 l_shin, 4 r_thigh, 5 r_shin, 6 l_arm,
// 7 l_forearm, 8 r_arm, 9 r_forearm.
Human SkirtedWalker(int columns, int rows);

// The walker's pose at a time: it walks at 1.3 m/s in a circle of 2 m, and every ten seconds it
// bows, crouches or lifts its arms.
struct WalkerPose {
  std::vector<JointTransform> pose;
  std::vector<glm::mat4> actor_from_joint;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
};
void PoseWalker(const Human& human, double time, WalkerPose& walker);

// Largest depth in metres of points of the cloth's triangles (corners, midpoints of edges, centre)
// inside a capsule; 0 in the bind pose.
float DeepestPenetration(const Human& human,
                         std::span<const glm::vec3> particles,
                         std::span<const glm::mat4> actor_from_joint);

}  // namespace lararium::human
