#pragma once

// One person at one moment as the show draws them: standing, walking or in a clip, with
// hair and cloth where they have come to by then.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/cloth.h"
#include "shared/human/performance.h"
#include "shared/human/spring.h"
#include "shared/render/render_scene.h"

namespace lararium::app {

// A person as they are to be shown. Shapes are given by index into Human::face.
struct StudioPose {
  struct Shape {
    size_t shape = 0;
    float weight = 1.0f;
  };
  int clip = -1;      // index into Human::clips; none: the body moves by itself
  double time = 0.0;  // seconds into the clip
  double walk = 0.0;  // seconds of walking straight ahead; 0: stands; not with a clip
  std::vector<Shape> shapes;
};

class PosedPerson {
 public:
  // human is valid (Human::Validate). Simulates some seconds of the person's life.
  PosedPerson(std::shared_ptr<const human::Human> human, const StudioPose& pose);

  // Another face; body, hair and cloth stay.
  void SetShapes(std::span<const StudioPose::Shape> shapes);

  const human::Human& human() const { return performer_.human(); }
  std::span<const glm::mat4> actor_from_joint() const { return actor_from_joint_; }
  std::span<const glm::mat4> skin() const { return skin_; }
  // What the renderer needs besides skin(): cloth and the morphed face.
  std::span<const render::SceneVertices> vertices() const { return vertices_; }
  // Of each mesh as drawn, but for the face's shapes; metres, actor frame.
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

  human::Performer performer_;
  human::Performance performance_;
  human::ClothModel cloth_model_;
  human::ClothState cloth_;
  human::SpringModel spring_model_;
  human::SpringState springs_;
  glm::vec3 root_ = glm::vec3(0.0f);  // stage, metres
  std::vector<StudioPose::Shape> shapes_;
  std::vector<human::JointTransform> pose_;
  std::vector<glm::mat4> actor_from_joint_;
  std::vector<glm::mat4> skin_;
  std::vector<Vertices> moved_;  // parallel to the meshes; empty where nothing moves them
  std::vector<render::SceneVertices> vertices_;  // of moved_
};

}  // namespace lararium::app
