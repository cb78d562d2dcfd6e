#pragma once

// One person at one moment as the show draws it: standing, walking or in a clip, with simulated
// hair and cloth.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/animator.h"
#include "shared/human/cloth.h"
#include "shared/human/spring.h"
#include "shared/render/render_scene.h"

namespace lararium::editor {

// The pose and expression of a person. StudioPose::Shape::shape is an index into Human::face.
struct StudioPose {
  struct Shape {
    size_t shape = 0;
    float weight = 1.0f;
  };
  int clip = -1;      // Index into Human::clips; below 0: idle motion or walking.
  double time = 0.0;  // Seconds into the clip.
  double walk = 0.0;  // Seconds of walking straight ahead; 0: stands. Ignored with a clip.
  std::vector<Shape> shapes;
};

class PosedPerson {
 public:
  // human must be valid (Human::Validate). Simulates a few seconds before the pose.
  PosedPerson(std::shared_ptr<const human::Human> human, const StudioPose& pose);

  // Changes the face; body, hair and cloth stay.
  void SetShapes(std::span<const StudioPose::Shape> shapes);

  const human::Human& human() const { return animator_.human(); }
  std::span<const glm::mat4> actor_from_joint() const { return actor_from_joint_; }
  std::span<const glm::mat4> skin() const { return skin_; }
  // The vertices that the renderer needs besides skin(): cloth and the morphed face.
  std::span<const render::SceneVertices> vertices() const { return vertices_; }
  // The positions of each mesh as drawn, without the face's shapes; metres, actor frame.
  std::vector<std::vector<glm::vec3>> ComputePositions() const;

 private:
  struct Vertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
  };

  void Live(const StudioPose& pose);
  void Tick(float speed);
  void Step(float elapsed);
  void TurnByShapes();
  void Draw();
  void Morph();
  Vertices& MakeRoom(uint32_t mesh);

  human::Animator animator_;
  human::AnimationState animation_state_;
  human::ClothModel cloth_model_;
  human::ClothState cloth_;
  human::SpringModel spring_model_;
  human::SpringState springs_;
  glm::vec3 root_ = glm::vec3(0.0f);  // Stage frame, metres.
  std::vector<StudioPose::Shape> shapes_;
  std::vector<human::JointTransform> pose_;
  std::vector<glm::mat4> actor_from_joint_;
  std::vector<glm::mat4> skin_;
  // Parallel to the meshes; empty for meshes that only skinning moves.
  std::vector<Vertices> moved_;
  std::vector<render::SceneVertices> vertices_;  // Views of moved_.
};

}  // namespace lararium::editor
