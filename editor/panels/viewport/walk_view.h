#pragma once

// Paths of walking people on the floor in a viewport: beginning, course, a mark for each second,
// and end. The ends can be moved with the pointer and with keys.

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

#include "editor/check/walk_paths.h"
#include "editor/panels/viewport/occluder_rays.h"
#include "editor/panels/viewport/view_camera.h"
#include "editor/panels/widgets/editor_actions.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

struct PanelContext;

// The walks that the views show, and the end that is being moved.
struct WalkHandles {
  // The selection in the timeline, if it is a single item or a single task of the dry run.
  std::optional<drama::TimelineItem> item;
  std::optional<uint32_t> task;

  struct Handle {
    drama::TimelineItem item;
    bool begins = false;  // The place where a person appears; otherwise the end of a walk.

    friend bool operator==(const Handle&, const Handle&) = default;
  };
  std::optional<Handle> chosen;  // The handle that keys move.
  struct Drag {
    Handle handle;
    Eigen::Vector2d pressed = Eigen::Vector2d::Zero();  // Window pixel.
    // From the pressed point on the floor to the handle; stage, metres.
    glm::vec2 grip = glm::vec2(0.0f);
    glm::vec2 place = glm::vec2(0.0f);  // The handle's present position; stage, metres.
    bool moved = false;                 // Moved farther than a click allows.
    bool given_up = false;              // The drag was cancelled.
  };
  std::optional<Drag> drag;
};

class WalkView {
 public:
  // Shows the walk that is selected in the timeline and, with thinner lines, other walks of that
  // person and walks of the selected person. hovered: the pointer is over the view. Returns true
  // while the ends use the pointer.
  bool Show(const PanelContext& context, const ViewCamera& view, bool hovered, ImDrawList& draw);

 private:
  using Handle = WalkHandles::Handle;
  struct Shown {
    editor::WalkPath path;
    ImVec4 colour;
    bool chosen = false;
    std::vector<glm::vec2> way;    // Closely spaced points of the path.
    std::vector<glm::vec2> ticks;  // The position at each second.
  };
  // The inputs of walks_.
  struct Basis {
    int64_t script = -1;
    int64_t run = -1;
    bool run_is_current = false;
    std::vector<std::string> people;
    std::optional<drama::TimelineItem> item;
    std::optional<uint32_t> task;

    friend bool operator==(const Basis&, const Basis&) = default;
  };

  void Update(const editor::Workspace& workspace,
              const Selection& selection,
              const WalkHandles& walks);
  // Computes the walk for the present position of the dragged end.
  void FollowDrag(const editor::Workspace& workspace, const WalkHandles::Drag& drag);
  std::optional<Handle> HandleBelow(const ViewCamera& view, const Eigen::Vector2d& pixel) const;
  std::optional<glm::vec2> PlaceOf(const Handle& handle) const;
  void Press(const ViewCamera& view,
             const Handle& handle,
             WalkHandles& walks,
             EditorActions& actions) const;
  void Drag(editor::Workspace& workspace,
            const ViewOptions& options,
            WalkHandles& walks,
            const ViewCamera& view) const;
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
  bool followed_ = false;  // walks_ show a drag.
};

}  // namespace lararium::panels
