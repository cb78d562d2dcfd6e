#pragma once

// Alignment of an occluder's model with the real object: by points that are picked on the model and
// in the training images, and by the map's points on its surface.

#include <imgui.h>

#include <cstddef>

#include "editor/jobs/occluder_alignment.h"
#include "editor/panels/viewport/pick_target.h"
#include "editor/panels/viewport/view_camera.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"
#include "shared/stage/place.h"
#include "shared/vision/occluders.h"

namespace lararium::panels {

// The state of aligning an occluder's model.
struct AlignView {
  std::string occluder;        // The occluder that the other fields belong to.
  bool picking = false;        // The next click in a view picks a point of the model.
  std::optional<size_t> pair;  // The pair that is being picked in the training images.
  double search_m = train::RefineOptions().search_m;
  // The tree of the model as staged in tree_of.
  std::shared_ptr<const vision::OccluderTree> tree;
  std::shared_ptr<const stage::Place> tree_of;
  // The last report on the pairs, with its inputs.
  std::shared_ptr<const editor::ProjectDocument> document;
  std::shared_ptr<const vision::SceneDatabase> database;
  std::string place;
  geometry::Similarity3 map_from_picked;
  editor::AlignmentReport report;
};

// The part of the inspector for an occluder that is a model.
void DrawAlignment(editor::Workspace& workspace,
                   const Selection& selection,
                   ViewOptions& options,
                   PickTarget& picks,
                   AlignView& align,
                   Input& input,
                   const editor::OccluderDocument& occluder);

// The pair of the selected model that is being picked in the training images.
struct ModelPairInWork {
  const editor::OccluderDocument* occluder = nullptr;  // nullptr: none.
  size_t pair = 0;
};
ModelPairInWork PairInWork(const editor::Workspace& workspace,
                           const Selection& selection,
                           const AlignView& align);

// How the pairs of the selected model fit; computed again when an input has changed.
const editor::AlignmentReport& Alignment(const editor::Workspace& workspace,
                                         AlignView& align,
                                         const editor::OccluderDocument& occluder);

// Draws the point pairs of the selected model over a scene view, each with a line to the located
// pick. While the user picks a point on the model, also shows the point under the pointer and
// returns true; the view must then not use the pointer.
bool DrawModelPoints(editor::Workspace& workspace,
                     const Selection& selection,
                     ViewOptions& options,
                     AlignView& align,
                     const ViewCamera& view,
                     bool hovered,
                     ImDrawList& draw);

}  // namespace lararium::panels
