#pragma once

// Around the place: the map's points, the cameras that filmed it, the stage, the
// occluders and the actors, seen from anywhere. The world is the stage that the
// picks give.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "shared/render/overlay.h"
#include "shared/render/render_target.h"
#include "shared/render/renderer.h"

namespace lararium::panels {

class AroundView {
 public:
  // Needs the window's OpenGL context.
  static Result<std::unique_ptr<AroundView>> Create();
  ~AroundView();

  // Fills the current window.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  AroundView(std::unique_ptr<render::Renderer> renderer, std::unique_ptr<render::Overlay> overlay);

  // Brings what is uploaded up to date with what is loaded.
  void UpdateMap(const app::LoadedPlace& loaded);
  void UpdateOccluders(const app::Workspace& workspace);
  void UpdateActors(const app::Workspace& workspace);

  Status Draw(const app::Workspace& workspace,
              const EditorState& state,
              const ViewCamera& view,
              int width,
              int height);
  void DrawMeshes(const app::Workspace& workspace, const EditorState& state);
  void DrawFloor(const app::LoadedPlace& loaded);
  void Interact(EditorState& state, bool hovered, bool gizmo_busy, const Eigen::Vector2d& size);

  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<render::Overlay> overlay_;
  std::optional<render::RenderTarget> target_;

  std::shared_ptr<const vision::SceneDatabase> database_;
  geometry::Similarity3 map_from_picked_;
  std::vector<render::OverlayPoint> points_;
  std::vector<render::OverlayLine> cameras_;
  std::vector<render::OverlayLine> lines_;  // of the frame being drawn

  struct Ghost {
    std::string name;
    size_t vertices = 0;
    render::MeshHandle mesh;
  };
  std::vector<Ghost> occluders_;
  std::optional<render::MeshHandle> floor_;  // a square from -1 to 1 on y = 0
  std::shared_ptr<const app::PreviewPicture> actors_of_;
  std::vector<std::pair<render::MeshHandle, glm::mat4>> actors_;
  bool framed_ = false;  // the orbit was set to show the whole place
};

}  // namespace lararium::panels
