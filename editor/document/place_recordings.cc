#include "editor/document/place_recordings.h"

#include <array>
#include <string>
#include <utility>

#include "editor/document/document_fields.h"

namespace lararium::editor {

namespace {

using geometry::CameraModel;

Result<CameraModel> ParseIntrinsics(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(
      view.CheckFields({"width", "height", "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"}));
  constexpr int kMaxSize = 65536;
  CameraModel camera;
  LARARIUM_ASSIGN_OR_RETURN(const int64_t width, view.Integer("width", 1, kMaxSize));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t height, view.Integer("height", 1, kMaxSize));
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
  const std::array<std::pair<const char*, double*>, 8> fields = {{{"fx", &camera.fx},
                                                                  {"fy", &camera.fy},
                                                                  {"cx", &camera.cx},
                                                                  {"cy", &camera.cy},
                                                                  {"k1", &camera.k1},
                                                                  {"k2", &camera.k2},
                                                                  {"p1", &camera.p1},
                                                                  {"p2", &camera.p2}}};
  for (const auto& [key, value] : fields) {
    LARARIUM_ASSIGN_OR_RETURN(*value, view.Number(key));
  }
  if (const Status status = camera.Validate(); !status.ok()) {
    return status.At(view.place());
  }
  return camera;
}

Json FormatIntrinsics(const CameraModel& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx}, {"fy", camera.fy},
          {"cx", camera.cx},       {"cy", camera.cy},         {"k1", camera.k1}, {"k2", camera.k2},
          {"p1", camera.p1},       {"p2", camera.p2}};
}

Result<SessionDocument> ParseSession(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"source", "intrinsics"}));
  SessionDocument session;
  LARARIUM_ASSIGN_OR_RETURN(const JsonView source, view.Field("source"));
  LARARIUM_ASSIGN_OR_RETURN(session.source, ParseSource(source));
  if (view.Has("intrinsics")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("intrinsics"));
    LARARIUM_ASSIGN_OR_RETURN(session.intrinsics, ParseIntrinsics(field));
  }
  return session;
}

}  // namespace

Result<SourceDocument> ParseSource(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"video", "images"}));
  if (view.Has("video") == view.Has("images")) {
    return view.Problem("must name either a video or a folder of images");
  }
  const bool video = view.Has("video");
  LARARIUM_ASSIGN_OR_RETURN(std::string path, view.Text(video ? "video" : "images"));
  return SourceDocument{video ? SourceDocument::Kind::kVideo : SourceDocument::Kind::kImages,
                        std::move(path)};
}

Json FormatSource(const SourceDocument& source) {
  return {{source.kind == SourceDocument::Kind::kVideo ? "video" : "images", source.path}};
}

Result<PlaceRecordings> ParseRecordings(const JsonView& view) {
  PlaceRecordings recordings;
  if (view.Has("training")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("training"));
    LARARIUM_ASSIGN_OR_RETURN(recordings.training, ParseSource(field));
  }
  if (view.Has("intrinsics")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("intrinsics"));
    LARARIUM_ASSIGN_OR_RETURN(recordings.intrinsics, ParseIntrinsics(field));
  }
  if (view.Has("added")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("added"));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, field.Array(kMaxAddedSessions));
    for (const JsonView& entry : list) {
      LARARIUM_ASSIGN_OR_RETURN(SessionDocument session, ParseSession(entry));
      recordings.added.push_back(std::move(session));
    }
  }
  return recordings;
}

Json FormatRecordings(const PlaceRecordings& recordings) {
  Json json = Json::object();
  if (!recordings.training.empty()) {
    json["training"] = FormatSource(recordings.training);
  }
  if (recordings.intrinsics) {
    json["intrinsics"] = FormatIntrinsics(*recordings.intrinsics);
  }
  for (const SessionDocument& session : recordings.added) {
    Json entry = {{"source", FormatSource(session.source)}};
    if (session.intrinsics) {
      entry["intrinsics"] = FormatIntrinsics(*session.intrinsics);
    }
    json["added"].push_back(std::move(entry));
  }
  return json;
}

PlaceRecordings RecordingsOf(const PlaceDocument& place) {
  return {place.training, place.intrinsics, place.added};
}

void SetRecordings(const PlaceRecordings& recordings, PlaceDocument& place) {
  while (place.added.size() > recordings.added.size()) {
    ForgetSession(place, static_cast<uint32_t>(place.added.size()));
  }
  place.training = recordings.training;
  place.intrinsics = recordings.intrinsics;
  place.added = recordings.added;
}

size_t PicksInSessionsFrom(const PlaceDocument& place, uint32_t session) {
  size_t count = 0;
  ForEachAnchor(place, [&](const stage::Anchor& anchor) {
    count += static_cast<size_t>(
        std::count_if(anchor.picks.begin(), anchor.picks.end(),
                      [&](const stage::Pick& pick) { return pick.session >= session; }));
  });
  return count;
}

}  // namespace lararium::editor
