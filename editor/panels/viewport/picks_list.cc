#include "editor/panels/viewport/picks_list.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "editor/document/picked_images.h"
#include "editor/jobs/check_points.h"
#include "editor/panels/viewport/align_panel.h"
#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/pick_view.h"
#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

using editor::PickedImage;

struct Line {
  PickedImage image;
  size_t corner = 0;  // Index of an occluder's corner; otherwise 0.
};

// The anchors that are being picked: the corners of an occluder, a check point, a point of a model,
// or otherwise a point of the stage, as in the pick view.
std::vector<const stage::Anchor*> AnchorsInWork(const editor::Workspace& workspace,
                                                const EditorState& state) {
  std::vector<const stage::Anchor*> anchors;
  if (const editor::OccluderDocument* drawn = OccluderInWork(workspace, state)) {
    for (const stage::Anchor& corner : drawn->corners) {
      anchors.push_back(&corner);
    }
  } else if (const editor::CheckPointDocument* checked = SelectedCheckPoint(workspace, state)) {
    if (const auto* picks = editor::FindCheckPicks(*workspace.project().place(), checked->name)) {
      anchors.push_back(picks);
    }
  } else if (const ModelPairInWork work = PairInWork(workspace, state); work.occluder != nullptr) {
    anchors.push_back(&work.occluder->model_pairs[work.pair].anchor);
  } else {
    const AnchorEntry& entry = AnchorEntries()[static_cast<size_t>(state.anchor)];
    anchors.push_back(&(workspace.project().place()->picks.*entry.anchor));
  }
  return anchors;
}

std::vector<Line> LinesInWork(const editor::Workspace& workspace, const EditorState& state) {
  std::vector<Line> lines;
  const auto& database = workspace.map().loaded().database;
  if (workspace.project().place() == nullptr || database == nullptr) {
    return lines;
  }
  const std::vector<const stage::Anchor*> anchors = AnchorsInWork(workspace, state);
  for (size_t corner = 0; corner < anchors.size(); ++corner) {
    for (const PickedImage& image : editor::PickedImagesOf(*anchors[corner], *database)) {
      lines.push_back({image, corner});
    }
  }
  return lines;
}

std::vector<PickedImage> ImagesInWork(const editor::Workspace& workspace,
                                      const EditorState& state) {
  std::vector<PickedImage> images;
  for (const Line& line : LinesInWork(workspace, state)) {
    images.push_back(line.image);
  }
  return images;
}

void Remove(editor::Workspace& workspace, const EditorState& state, const Line& line) {
  const auto command = [](const Sentence& of) { return Sentence("remove a pick of %s", {of}); };
  const stage::Pick pick = line.image.pick;
  if (const editor::OccluderDocument* drawn = OccluderInWork(workspace, state)) {
    const std::string name = drawn->name;
    workspace.project().EditOccluder(command(name), name, [&](editor::OccluderDocument& occluder) {
      editor::RemoveCornerPick(occluder, line.corner, pick);
    });
  } else if (const editor::CheckPointDocument* checked = SelectedCheckPoint(workspace, state)) {
    const std::string name = checked->name;
    workspace.project().EditPlace(command(name), [&](editor::PlaceDocument& place) {
      editor::RemoveCheckPick(place, name, pick);
    });
  } else if (const ModelPairInWork work = PairInWork(workspace, state); work.occluder != nullptr) {
    const std::string name = work.occluder->name;
    workspace.project().EditOccluder(command(name), name, [&, pair = work.pair](auto& occluder) {
      editor::RemovePick(occluder.model_pairs[pair].anchor, pick);
    });
  } else {
    const AnchorEntry& entry = AnchorEntries()[static_cast<size_t>(state.anchor)];
    workspace.project().EditPlace(
        command(Sentence(entry.label)),
        [&](editor::PlaceDocument& place) { editor::RemovePick(place.picks.*entry.anchor, pick); });
  }
}

void JumpTo(uint32_t keyframe, EditorState& state) {
  state.keyframe = static_cast<int>(keyframe);
  state.view = ViewKind::kPicks;
  state.focus = Focus::kViews;  // Delete then removes this pick.
}

std::string NameOf(const editor::Workspace& workspace, const Line& line, bool corners) {
  std::string name = editor::NameOfImage(line.image.pick);
  if (line.image.pick.session != 0) {
    name += ", " + SessionName(*workspace.project().place(), line.image.pick.session);
  }
  return corners ? Text(Tr("Corner %zu: %s"), line.corner + 1, name.c_str()) : name;
}

// Draws a line; returns true where its pick is to be removed, by its button or by Delete while it
// has the keyboard focus.
bool DrawLine(const editor::Workspace& workspace,
              EditorState& state,
              const Line& line,
              bool corners) {
  const std::optional<uint32_t>& keyframe = line.image.keyframe;
  bool remove = false;
  const auto delete_here = [&] {
    remove |= ImGui::IsItemFocused() && state.keyboard.walks() && state.dialog == Dialog::kNone &&
              std::any_of(state.keys.begin(), state.keys.end(), [](const KeyPress& press) {
                return ActionOf(KeyScope::kPicks, press) == KeyAction::kRemovePick;
              });
  };
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string name = NameOf(workspace, line, corners);
  const std::string shown = Elided(name, ImGui::GetContentRegionAvail().x);
  const bool selected =
      state.view == ViewKind::kPicks && keyframe && static_cast<int>(*keyframe) == state.keyframe;
  ImGui::PushStyleColor(ImGuiCol_Text, keyframe ? Colours().text : Colours().dim);
  ImGui::AlignTextToFramePadding();
  if (ImGui::Selectable((shown + "##image").c_str(), selected,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap,
                        ImVec2(0, ImGui::GetFrameHeight())) &&
      keyframe) {
    JumpTo(*keyframe, state);
  }
  ImGui::PopStyleColor();
  delete_here();
  Tip(name + "\n" +
      (keyframe ? Tr("Shows its image; Delete removes the pick.")
                : Tr("The map has no such image now; Delete removes the pick.")));
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(line.image.error_px ? Text("%.2f px", *line.image.error_px).c_str() : "-");
  ImGui::TableNextColumn();
  remove |= ImGui::Button("\xc3\x97");
  delete_here();
  Tip(Tr("Removes this pick"));
  return remove;
}

}  // namespace

void DrawPicksList(editor::Workspace& workspace, EditorState& state) {
  const std::vector<Line> lines = LinesInWork(workspace, state);
  if (lines.empty() || !ImGui::BeginTable("picks", 3, ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn(Tr("Picked in"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(Tr("Error"), ImGuiTableColumnFlags_WidthFixed, Px(76));
  ImGui::TableSetupColumn("##remove", ImGuiTableColumnFlags_WidthFixed, Px(28));
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  const bool corners = OccluderInWork(workspace, state) != nullptr;
  const Line* removed = nullptr;
  for (const Line& line : lines) {
    ImGui::PushID(static_cast<int>(&line - lines.data()));
    if (DrawLine(workspace, state, line, corners)) {
      removed = &line;
    }
    ImGui::PopID();
  }
  ImGui::EndTable();
  if (removed != nullptr) {
    Remove(workspace, state, *removed);
  }
}

void HandlePickKeys(editor::Workspace& workspace, EditorState& state) {
  if (ImGui::GetIO().WantTextInput || state.dialog != Dialog::kNone ||
      state.focus != Focus::kViews || state.keyboard.walks()) {
    return;
  }
  constexpr int kFar = 10;  // Images; the step with Shift.
  const int last = static_cast<int>(workspace.map().loaded().database->keyframes.size()) - 1;
  const auto jump = [&](int direction) {
    const auto next = editor::NextPicked(ImagesInWork(workspace, state),
                                         static_cast<uint32_t>(state.keyframe), direction);
    state.keyframe = next ? static_cast<int>(*next) : state.keyframe;
  };
  for (const KeyPress& press : state.keys) {
    const int step = (press.modifiers & GLFW_MOD_SHIFT) != 0 ? kFar : 1;
    switch (ActionOf(KeyScope::kPicks, press)) {
      case KeyAction::kImageBefore:
        state.keyframe = std::max(state.keyframe - step, 0);
        break;
      case KeyAction::kImageAfter:
        state.keyframe = std::min(state.keyframe + step, last);
        break;
      case KeyAction::kPickedBefore:
        jump(-1);
        break;
      case KeyAction::kPickedAfter:
        jump(1);
        break;
      case KeyAction::kRemovePick: {
        const std::vector<Line> lines = LinesInWork(workspace, state);
        // Of several corners in this image, the one that was picked last.
        const auto here = std::find_if(lines.rbegin(), lines.rend(), [&](const Line& line) {
          return line.image.keyframe && static_cast<int>(*line.image.keyframe) == state.keyframe;
        });
        if (here != lines.rend()) {
          Remove(workspace, state, *here);
        }
        break;
      }
      default:
        break;
    }
  }
}

void DrawPickSteps(const editor::Workspace& workspace, EditorState& state) {
  const std::vector<PickedImage> images = ImagesInWork(workspace, state);
  const auto keyframe = static_cast<uint32_t>(state.keyframe);
  const auto button = [&](const char* id, ImGuiDir towards, int direction, KeyAction action) {
    const std::optional<uint32_t> next = editor::NextPicked(images, keyframe, direction);
    ImGui::BeginDisabled(!next);
    if (ImGui::ArrowButton(id, towards) && next) {
      JumpTo(*next, state);
    }
    ImGui::EndDisabled();
    Tooltip(WithKey(TextOf(action).c_str(), action));
  };
  button("picked before", ImGuiDir_Left, -1, KeyAction::kPickedBefore);
  ImGui::SameLine(0.0f, Px(4));
  button("picked after", ImGuiDir_Right, 1, KeyAction::kPickedAfter);
}

}  // namespace lararium::panels
