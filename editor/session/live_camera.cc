#include "editor/session/live_camera.h"

#include <utility>

#include "editor/jobs/filming.h"
#include "shared/capture/looped_source.h"

namespace lararium::editor {

Result<std::unique_ptr<capture::FrameSource>> OpenSteadily(
    const std::function<Result<std::unique_ptr<capture::FrameSource>>()>& open,
    std::shared_ptr<CameraPresence> presence) {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<capture::FrameSource> camera, open());
  *presence = true;
  return capture::MakeSteady(
      std::move(camera),
      capture::RealWorld(open, [presence = std::move(presence)](
                                   bool connected, const std::string&) { *presence = connected; }));
}

Result<std::unique_ptr<capture::FrameSource>> OpenLiveCamera(
    const std::string& camera, std::shared_ptr<CameraPresence> presence) {
  if (IsCameraNumber(camera)) {
    return OpenSteadily([camera] { return OpenFilmCamera(camera); }, std::move(presence));
  }
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<capture::FrameSource> recording,
                            capture::OpenVideo(camera));
  *presence = true;
  return AtItsOwnPace(capture::Loop(std::move(recording)));
}

}  // namespace lararium::editor
