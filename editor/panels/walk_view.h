#pragma once

// Walks of people as paths on the floor, in a viewport: where each begins, how it goes, each
// second of it, and where it ends; its ends can be dragged and moved by keys.

#include <imgui.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/walk_paths.h"
#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/occluder_rays.h"

namespace lararium::panels {

class WalkView {
 public:
  // Shows the walk that is chosen in the timeline, and thinner the others of the same person and
  // those of the person who is selected. hovered: the pointer is over the view. True while the
  // ends want the pointer for themselves.
  bool Show(app::Workspace& workspace,
            EditorState& state,
            const ViewCamera& view,
            bool hovered,
            ImDrawList& draw);

 private:
  using Handle = WalkHandles::Handle;
  struct Shown {
    app::WalkPath path;
    ImVec4 colour;
    bool chosen = false;
    std::vector<glm::vec2> way;    // points close to each other
    std::vector<glm::vec2> ticks;  // where they are at each second of it
  };
  // What the walks were worked out from.
  struct Basis {
    int64_t script = -1;
    int64_t run = -1;
    bool run_is_current = false;
    std::vector<std::string> people;
    std::optional<drama::TimelineItem> item;
    std::optional<uint32_t> task;

    friend bool operator==(const Basis&, const Basis&) = default;
  };

  void Update(const app::Workspace& workspace, const EditorState& state);
  // The walk as it would be with the end where it is dragged.
  void FollowDrag(const app::Workspace& workspace, const WalkHandles::Drag& drag);
  std::optional<Handle> HandleBelow(const ViewCamera& view, const Eigen::Vector2d& pixel) const;
  std::optional<glm::vec2> PlaceOf(const Handle& handle) const;
  void Press(const ViewCamera& view, const Handle& handle, EditorState& state) const;
  void Drag(app::Workspace& workspace, EditorState& state, const ViewCamera& view) const;
  void Draw(const Shown& walk,
            const WalkHandles& state,
            const ViewCamera& view,
            ImDrawList& draw) const;
  void DrawWay(const Shown& walk, const ViewCamera& view, ImDrawList& draw) const;
  void DrawEnd(const Shown& walk,
               const WalkHandles& state,
               const ViewCamera& view,
               ImDrawList& draw) const;

  geometry::Similarity3 world_from_stage_;
  OccluderRays occluders_;
  Basis basis_;
  std::vector<Shown> walks_;
  bool followed_ = false;  // walks_ show a drag
};

}  // namespace lararium::panels
