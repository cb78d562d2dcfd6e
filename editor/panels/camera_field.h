#pragma once

// Choosing a camera: of those that are connected, by its number, or a video that is played as one.

#include <filesystem>
#include <string>
#include <vector>

#include "shared/capture/camera_list.h"

namespace lararium::panels {

class CameraField {
 public:
  // Rows within BeginProperties(). camera: as app::OpenFilmCamera() takes it; where none has the
  // number 0, the first that is connected is proposed. folder: what relative paths start from.
  void Show(std::string& camera, const std::filesystem::path& folder);
  // What can be done here, below the rows.
  void ShowHint() const;

 private:
  void Look(std::string& camera);
  void ShowList(std::string& camera, float width);
  const capture::ConnectedCamera* Chosen(const std::string& camera) const;

  std::vector<capture::ConnectedCamera> cameras_;
  bool looked_ = false;
  bool typed_ = false;  // a number or a video, in place of one that is listed
};

}  // namespace lararium::panels
