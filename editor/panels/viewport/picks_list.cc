#include "editor/panels/viewport/picks_list.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "editor/document/picked_images.h"
#include "editor/jobs/check_points.h"
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
                                                const Selection& selection,
                                                const PickTarget& picks,
                                                const AlignView& align) {
  std::vector<const stage::Anchor*> anchors;
  if (const editor::OccluderDocument* drawn = OccluderInWork(workspace, selection)) {
    for (const stage::Anchor& corner : drawn->corners) {
      anchors.push_back(&corner);
    }
  } else if (const editor::CheckPointDocument* checked = SelectedCheckPoint(workspace, selection)) {
    if (const auto* picks = editor::FindCheckPicks(*workspace.project().place(), checked->name)) {
      anchors.push_back(picks);
    }
  } else if (const ModelPairInWork work = PairInWork(workspace, selection, align);
             work.occluder != nullptr) {
    anchors.push_back(&work.occluder->model_pairs[work.pair].anchor);
  } else {
    const AnchorEntry& entry = AnchorEntries()[static_cast<size_t>(picks.anchor)];
    anchors.push_back(&(workspace.project().place()->picks.*entry.anchor));
  }
  return anchors;
}

std::vector<Line> LinesInWork(const editor::Workspace& workspace,
                              const Selection& selection,
                              const PickTarget& picks,
                              const AlignView& align) {
  std::vector<Line> lines;
  const auto& database = workspace.map().loaded().database;
  if (workspace.project().place() == nullptr || database == nullptr) {
    return lines;
  }
  const std::vector<const stage::Anchor*> anchors =
      AnchorsInWork(workspace, selection, picks, align);
  for (size_t corner = 0; corner < anchors.size(); ++corner) {
    for (const PickedImage& image : editor::PickedImagesOf(*anchors[corner], *database)) {
      lines.push_back({image, corner});
    }
  }
  return lines;
}

std::vector<PickedImage> ImagesInWork(const editor::Workspace& workspace,
                                      const Selection& selection,
                                      const PickTarget& picks,
                                      const AlignView& align) {
  std::vector<PickedImage> images;
  for (const Line& line : LinesInWork(workspace, selection, picks, align)) {
    images.push_back(line.image);
  }
  return images;
}

void Remove(editor::Workspace& workspace,
            const Selection& selection,
            const PickTarget& picks,
            const AlignView& align,
            const Line& line) {
  const auto command = [](const Sentence& of) { return Sentence("remove a pick of %s", {of}); };
  const stage::Pick pick = line.image.pick;
  if (const editor::OccluderDocument* drawn = OccluderInWork(workspace, selection)) {
    const std::string name = drawn->name;
    workspace.project().EditOccluder(command(name), name, [&](editor::OccluderDocument& occluder) {
      editor::RemoveCornerPick(occluder, line.corner, pick);
    });
  } else if (const editor::CheckPointDocument* checked = SelectedCheckPoint(workspace, selection)) {
    const std::string name = checked->name;
    workspace.project().EditPlace(command(name), [&](editor::PlaceDocument& place) {
      editor::RemoveCheckPick(place, name, pick);
    });
  } else if (const ModelPairInWork work = PairInWork(workspace, selection, align);
             work.occluder != nullptr) {
    const std::string name = work.occluder->name;
    workspace.project().EditOccluder(command(name), name, [&, pair = work.pair](auto& occluder) {
      editor::RemovePick(occluder.model_pairs[pair].anchor, pick);
    });
  } else {
    const AnchorEntry& entry = AnchorEntries()[static_cast<size_t>(picks.anchor)];
    workspace.project().EditPlace(
        command(Sentence(entry.label)),
        [&](editor::PlaceDocument& place) { editor::RemovePick(place.picks.*entry.anchor, pick); });
  }
}

void JumpTo(uint32_t keyframe, ViewOptions& options, PickTarget& picks, Input& input) {
  picks.keyframe = static_cast<int>(keyframe);
  options.view = ViewKind::kPicks;
  input.focus = Focus::kViews;  // Delete then removes this pick.
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
              ViewOptions& options,
              PickTarget& picks,
              Input& input,
              const Line& line,
              bool corners) {
  const std::optional<uint32_t>& keyframe = line.image.keyframe;
  bool remove = false;
  const auto delete_here = [&] {
    remove |= ImGui::IsItemFocused() && input.keyboard.walks() && !input.dialog_open &&
              std::any_of(input.keys.begin(), input.keys.end(), [](const KeyPress& press) {
                return ActionOf(KeyScope::kPicks, press) == KeyAction::kRemovePick;
              });
  };
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string name = NameOf(workspace, line, corners);
  const std::string shown = Elided(name, ImGui::GetContentRegionAvail().x);
  const bool selected =
      options.view == ViewKind::kPicks && keyframe && static_cast<int>(*keyframe) == picks.keyframe;
  ImGui::PushStyleColor(ImGuiCol_Text, keyframe ? Colours().text : Colours().dim);
  ImGui::AlignTextToFramePadding();
  if (ImGui::Selectable((shown + "##image").c_str(), selected,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap,
                        ImVec2(0, ImGui::GetFrameHeight())) &&
      keyframe) {
    JumpTo(*keyframe, options, picks, input);
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

void DrawPicksList(editor::Workspace& workspace,
                   const Selection& selection,
                   ViewOptions& options,
                   PickTarget& picks,
                   const AlignView& align,
                   Input& input) {
  const std::vector<Line> lines = LinesInWork(workspace, selection, picks, align);
  if (lines.empty() || !ImGui::BeginTable("picks", 3, ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn(Tr("Picked in"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(Tr("Error"), ImGuiTableColumnFlags_WidthFixed, Px(76));
  ImGui::TableSetupColumn("##remove", ImGuiTableColumnFlags_WidthFixed, Px(28));
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  const bool corners = OccluderInWork(workspace, selection) != nullptr;
  const Line* removed = nullptr;
  for (const Line& line : lines) {
    ImGui::PushID(static_cast<int>(&line - lines.data()));
    if (DrawLine(workspace, options, picks, input, line, corners)) {
      removed = &line;
    }
    ImGui::PopID();
  }
  ImGui::EndTable();
  if (removed != nullptr) {
    Remove(workspace, selection, picks, align, *removed);
  }
}

void HandlePickKeys(editor::Workspace& workspace,
                    const Selection& selection,
                    PickTarget& picks,
                    const AlignView& align,
                    const Input& input) {
  if (ImGui::GetIO().WantTextInput || input.dialog_open || input.focus != Focus::kViews ||
      input.keyboard.walks()) {
    return;
  }
  constexpr int kFar = 10;  // Images; the step with Shift.
  const int last = static_cast<int>(workspace.map().loaded().database->keyframes.size()) - 1;
  const auto jump = [&](int direction) {
    const auto next = editor::NextPicked(ImagesInWork(workspace, selection, picks, align),
                                         static_cast<uint32_t>(picks.keyframe), direction);
    picks.keyframe = next ? static_cast<int>(*next) : picks.keyframe;
  };
  for (const KeyPress& press : input.keys) {
    const int step = (press.modifiers & GLFW_MOD_SHIFT) != 0 ? kFar : 1;
    switch (ActionOf(KeyScope::kPicks, press)) {
      case KeyAction::kImageBefore:
        picks.keyframe = std::max(picks.keyframe - step, 0);
        break;
      case KeyAction::kImageAfter:
        picks.keyframe = std::min(picks.keyframe + step, last);
        break;
      case KeyAction::kPickedBefore:
        jump(-1);
        break;
      case KeyAction::kPickedAfter:
        jump(1);
        break;
      case KeyAction::kRemovePick: {
        const std::vector<Line> lines = LinesInWork(workspace, selection, picks, align);
        // Of several corners in this image, the one that was picked last.
        const auto here = std::find_if(lines.rbegin(), lines.rend(), [&](const Line& line) {
          return line.image.keyframe && static_cast<int>(*line.image.keyframe) == picks.keyframe;
        });
        if (here != lines.rend()) {
          Remove(workspace, selection, picks, align, *here);
        }
        break;
      }
      default:
        break;
    }
  }
}

void DrawPickSteps(const editor::Workspace& workspace,
                   const Selection& selection,
                   ViewOptions& options,
                   PickTarget& picks,
                   const AlignView& align,
                   Input& input) {
  const std::vector<PickedImage> images = ImagesInWork(workspace, selection, picks, align);
  const auto keyframe = static_cast<uint32_t>(picks.keyframe);
  const auto button = [&](const char* id, ImGuiDir towards, int direction, KeyAction action) {
    const std::optional<uint32_t> next = editor::NextPicked(images, keyframe, direction);
    ImGui::BeginDisabled(!next);
    if (ImGui::ArrowButton(id, towards) && next) {
      JumpTo(*next, options, picks, input);
    }
    ImGui::EndDisabled();
    Tooltip(WithKey(TextOf(action).c_str(), action));
  };
  button("picked before", ImGuiDir_Left, -1, KeyAction::kPickedBefore);
  ImGui::SameLine(0.0f, Px(4));
  button("picked after", ImGuiDir_Right, 1, KeyAction::kPickedAfter);
}

}  // namespace lararium::panels
