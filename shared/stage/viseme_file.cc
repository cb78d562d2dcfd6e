#include "shared/stage/viseme_file.h"

#include <cmath>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::stage {
namespace {

constexpr double kMaxVisemeSeconds = 3600.0;
constexpr size_t kMaxKeys = 100'000;
constexpr size_t kMaxVisemeBytes = size_t{16} << 20;

// Seconds and strengths are written to a tenth of a thousandth, so that the file is easy to read.
void DescribeRounded(Fields& fields, const FieldKey& key, float& value, double max) {
  double rounded = std::round(value * 1e4) / 1e4;
  fields.Number(key, rounded, 0.0, max);
  if (fields.reading()) {
    value = static_cast<float>(rounded);
  }
}

void DescribeViseme(Fields& fields, human::VisemeTrack::Key& key) {
  DescribeRounded(fields, "t", key.time, kMaxVisemeSeconds);
  std::string name(human::NameOf(key.viseme));
  fields.Text("viseme", name, 16);
  const auto viseme = human::VisemeNamed(name);
  fields.Require(viseme.has_value(), "there is no viseme '" + name + "'",
                 "use sil PP FF TH DD kk CH SS nn RR aa E ih oh ou");
  if (fields.reading()) {
    key.viseme = viseme.value_or(key.viseme);
  }
  DescribeRounded(fields, Optional("strength", key.strength != 1.0f), key.strength, 1.0);
}

void DescribeTrack(Fields& fields, human::VisemeTrack& track) {
  fields.Schema(1);
  DescribeRounded(fields, "duration", track.duration, kMaxVisemeSeconds);
  float before = 0.0f;
  fields.List("visemes", track.keys, kMaxKeys, [&](Fields& entry, human::VisemeTrack::Key& key) {
    DescribeViseme(entry, key);
    entry.Require(key.time >= before, "begins before the one before it", "sort them by \"t\"");
    before = key.time;
  });
}

}  // namespace

Result<human::VisemeTrack> ParseVisemes(std::string_view text, const std::string& where) {
  if (text.size() > kMaxVisemeBytes) {
    return Status::Error(where, "is longer than 16 MiB");
  }
  LARARIUM_ASSIGN_OR_RETURN(
      human::VisemeTrack track,
      ParseFields<human::VisemeTrack>(text, where, DescribeTrack, UnknownFields::kIgnore));
  LARARIUM_RETURN_IF_ERROR(track.Validate(where));
  return track;
}

std::string FormatVisemes(const human::VisemeTrack& track) {
  return FormatFields(track, DescribeTrack).dump(1) + "\n";
}

}  // namespace lararium::stage
