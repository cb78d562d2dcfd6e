#include "editor/panels/viewport/camera_field.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

std::string NameOf(const capture::ConnectedCamera& camera) {
  return Text("%s (%d)",
              camera.problem.empty() ? camera.name.c_str() : Tr("A camera that cannot be opened"),
              camera.number);
}

}  // namespace

const capture::ConnectedCamera* CameraField::Chosen(const std::string& camera) const {
  const auto chosen = std::find_if(
      cameras_.begin(), cameras_.end(),
      [&](const capture::ConnectedCamera& c) { return std::to_string(c.number) == camera; });
  return chosen == cameras_.end() ? nullptr : &*chosen;
}

void CameraField::Look(std::string& camera) {
  cameras_ = capture::ConnectedCameras();
  const bool proposed = camera == "0";  // The initial value of the field.
  if (proposed && !cameras_.empty() && Chosen(camera) == nullptr) {
    camera = std::to_string(cameras_.front().number);
  }
  typed_ = Chosen(camera) == nullptr;
}

void CameraField::DrawList(std::string& camera, float width) {
  const char* const other = Tr("Another number, or a video");
  const capture::ConnectedCamera* chosen = typed_ ? nullptr : Chosen(camera);
  ImGui::SetNextItemWidth(width);
  const bool open =
      ImGui::BeginCombo("##cameras", chosen != nullptr ? NameOf(*chosen).c_str() : other);
  if (!open) {
    Tooltip(chosen != nullptr && !chosen->problem.empty()
                ? chosen->problem
                : Tr("The camera that is used, of those that are connected"));
    return;
  }
  for (const capture::ConnectedCamera& one : cameras_) {
    if (ImGui::Selectable(NameOf(one).c_str(), &one == chosen)) {
      camera = std::to_string(one.number);
      typed_ = false;
    }
    if (!one.problem.empty()) {
      Tooltip(one.problem);
    }
  }
  typed_ |= ImGui::Selectable(other, typed_);
  ImGui::EndCombo();
}

void CameraField::Show(std::string& camera, const std::filesystem::path& folder) {
  if (!std::exchange(looked_, true) || ImGui::IsWindowAppearing()) {
    Look(camera);
  }
  const char* const again = Tr("Look again");
  const float button = WidestButton(std::array{again}, 0.0f);
  const float right = button + ImGui::GetStyle().ItemSpacing.x;
  PropertyLabel(Tr("Camera"));
  if (cameras_.empty()) {
    PathField("camera", camera, folder, FileType::kVideo, right);
  } else {
    DrawList(camera, ImGui::GetContentRegionAvail().x - right);
  }
  ImGui::SameLine();
  if (ImGui::Button(again, ImVec2(button, 0))) {
    Look(camera);
  }
  Tooltip(Tr("Looks which cameras are connected now"));
  if (typed_ && !cameras_.empty()) {
    PropertyLabel(Tr("Number, video"));
    PathField("camera", camera, folder, FileType::kVideo);
  }
}

void CameraField::DrawHint() const {
  if (cameras_.empty()) {
    Hint(Tr("No camera is connected: plug one in and look again, or take a video."));
  } else if (typed_) {
    Hint(Tr("The camera's number, 0 for the first; or a video, to try it without one."));
  }
}

}  // namespace lararium::panels
