#include "shared/stage/viseme_file.h"

#include <cmath>

#include "shared/core/json.h"

namespace lararium::stage {
namespace {

constexpr double kMaxVisemeSeconds = 3600.0;
constexpr size_t kMaxKeys = 100'000;
constexpr size_t kMaxTextBytes = size_t{16} << 20;

Result<human::VisemeTrack::Key> ReadKey(const JsonView& view) {
  human::VisemeTrack::Key key;
  LARARIUM_ASSIGN_OR_RETURN(const double time, view.Number("t", 0.0, kMaxVisemeSeconds));
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, view.Text("viseme", 16));
  const auto viseme = human::VisemeNamed(name);
  if (!viseme) {
    return view.Problem("there is no viseme '" + name + "'",
                        "use sil PP FF TH DD kk CH SS nn RR aa E ih oh ou");
  }
  key.time = static_cast<float>(time);
  key.viseme = *viseme;
  if (view.Has("strength")) {
    LARARIUM_ASSIGN_OR_RETURN(const double strength, view.Number("strength", 0.0, 1.0));
    key.strength = static_cast<float>(strength);
  }
  return key;
}

}  // namespace

Result<human::VisemeTrack> ParseVisemes(std::string_view text, const std::string& where) {
  if (text.size() > kMaxTextBytes) {
    return Status::Error(where, "is longer than 16 MiB");
  }
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, where));
  const JsonView root(json, where);
  LARARIUM_RETURN_IF_ERROR(root.Integer("schema", 1, 1).status());
  human::VisemeTrack track;
  LARARIUM_ASSIGN_OR_RETURN(const double duration, root.Number("duration", 0.0, kMaxVisemeSeconds));
  track.duration = static_cast<float>(duration);
  LARARIUM_ASSIGN_OR_RETURN(const JsonView list, root.Field("visemes"));
  LARARIUM_ASSIGN_OR_RETURN(const auto items, list.Array(kMaxKeys));
  track.keys.reserve(items.size());
  for (const JsonView& item : items) {
    LARARIUM_ASSIGN_OR_RETURN(const human::VisemeTrack::Key key, ReadKey(item));
    if (!track.keys.empty() && key.time < track.keys.back().time) {
      return item.Problem("begins before the one before it", "sort them by \"t\"");
    }
    track.keys.push_back(key);
  }
  LARARIUM_RETURN_IF_ERROR(track.Validate(where));
  return track;
}

std::string FormatVisemes(const human::VisemeTrack& track) {
  // Rounds to a tenth of a millisecond, so that the file is easy to read.
  const auto rounded = [](float seconds) { return std::round(seconds * 1e4) / 1e4; };
  Json json = {{"schema", 1}, {"duration", rounded(track.duration)}, {"visemes", Json::array()}};
  for (const human::VisemeTrack::Key& key : track.keys) {
    Json item = {{"t", rounded(key.time)}, {"viseme", human::NameOf(key.viseme)}};
    if (key.strength != 1.0f) {
      item["strength"] = rounded(key.strength);
    }
    json["visemes"].push_back(std::move(item));
  }
  return json.dump(1) + "\n";
}

}  // namespace lararium::stage
