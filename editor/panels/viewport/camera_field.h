#pragma once

// The choice of a camera: a connected one, a number, or a video that is played like a camera.

#include <filesystem>
#include <string>
#include <vector>

#include "shared/capture/camera_list.h"

namespace lararium::panels {

class CameraField {
 public:
  // Shows rows within BeginProperties(). camera: in the format of editor::OpenFilmCamera().
  // Suggests the first connected camera where number 0 does not exist. folder: the base of relative
  // paths.
  void Show(std::string& camera, const std::filesystem::path& folder);
  // Shows a hint below the rows.
  void DrawHint() const;

 private:
  void Look(std::string& camera);
  void DrawList(std::string& camera, float width);
  const capture::ConnectedCamera* Chosen(const std::string& camera) const;

  std::vector<capture::ConnectedCamera> cameras_;
  bool looked_ = false;
  bool typed_ = false;  // A number or a video was typed, instead of choosing from the list.
};

}  // namespace lararium::panels
