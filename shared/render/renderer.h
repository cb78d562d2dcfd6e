#pragma once

// Draws people and props into the camera's image. OpenGL 3.3 core, or ES 3.0.
//
// Passes: occluders into depth only; people and props, skinned on the GPU and lit by spherical
// harmonics, in linear light with 16-bit floats and several samples; the shadows that real
// surfaces catch; the camera's image, undistorted; then people and shadows over it, only within
// the pixels that they cover. Models outside the picture are skipped.

#include <memory>

#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/human/human.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"
#include "shared/stage/prop.h"

namespace lararium::render {

class Renderer {
 public:
  // Needs a current context. Call all other members on the thread of that context.
  static Result<std::unique_ptr<Renderer>> Create(const Quality& quality = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // The argument must be valid (TriangleMesh::Validate, Human::Validate, Prop::Validate). Adding a
  // person or prop fails if one of its textures cannot be decoded. Its encoded textures are kept
  // in memory, because a finer version may be decoded later.
  MeshHandle AddMesh(const geometry::TriangleMesh& mesh);
  Result<ModelHandle> AddHuman(const std::shared_ptr<const human::Human>& human);
  Result<ModelHandle> AddProp(const std::shared_ptr<const stage::Prop>& prop);
  void RemoveMesh(MeshHandle mesh);
  void RemoveModel(ModelHandle model);

  // Compiles the shaders for shadows on real surfaces. If this is not called, the first picture
  // with such a shadow compiles them and takes longer.
  Status PrepareCaughtShadows();

  // Takes effect with the next picture.
  void SetQuality(const Quality& quality);

  // Fills the whole target. After an error (a removed model, missing matrices, out of memory) the
  // content of the target is undefined.
  Status Draw(const RenderScene& scene, const RenderTarget& target);

  // For Quality::half_rate: draws one half of a new layer of people and shadows, then a picture
  // with the layer that was finished last, warped to the picture's pose. Pass the same scene as
  // `people` to both halves, kShadows first. `picture` provides the image, the cameras and the
  // opacity.
  enum class Half { kShadows, kPeople };
  Status DrawHalf(Half half,
                  const RenderScene& people,
                  const RenderScene& picture,
                  const RenderTarget& target);
  // True if the layer that was finished last can be warped to this picture: it was drawn for the
  // same size and from nearly the same pose.
  bool CanCarryLayer(const RenderScene& picture, const RenderTarget& target) const;

  // Reads the coverage of people and props in the layer that was drawn last: CV_8UC1, 0 to 255,
  // before CameraLook softens it.
  void ReadCoverage(cv::Mat& coverage) const;

  // For comparisons with path-traced references: draws people and props alone, hidden by
  // occluders, at the display's size. rgba: CV_32FC4, linear radiance times coverage, and coverage,
  // before exposure, gain and the camera's response; the precision is that of 16-bit floats.
  Status DrawLinear(const RenderScene& scene, cv::Mat& rgba);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::render
