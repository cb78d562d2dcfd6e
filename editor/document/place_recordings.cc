#include "editor/document/place_recordings.h"

#include <string>
#include <utility>

#include "editor/document/document_fields.h"

namespace lararium::editor {

namespace {

using geometry::CameraModel;

void DescribeIntrinsics(Fields& fields, CameraModel& camera) {
  constexpr int kMaxSize = 65536;
  fields.RefuseUnknown();
  fields.Integer("width", camera.width, 1, kMaxSize);
  fields.Integer("height", camera.height, 1, kMaxSize);
  fields.Number("fx", camera.fx);
  fields.Number("fy", camera.fy);
  fields.Number("cx", camera.cx);
  fields.Number("cy", camera.cy);
  fields.Number("k1", camera.k1);
  fields.Number("k2", camera.k2);
  fields.Number("p1", camera.p1);
  fields.Number("p2", camera.p2);
  if (const Status status = camera.Validate(); !status.ok()) {
    fields.Check(status.At(fields.where()));
  }
}

void DescribeSourceObject(Fields& fields, SourceDocument& source) {
  using Kind = SourceDocument::Kind;
  fields.RefuseUnknown();
  const bool video = fields.Has("video", source.kind == Kind::kVideo);
  const bool images = fields.Has("images", source.kind != Kind::kVideo);
  fields.Require(video != images, "must name either a video or a folder of images");
  fields.Text(video ? "video" : "images", source.path);
  if (fields.reading()) {
    source.kind = video ? Kind::kVideo : Kind::kImages;
  }
}

void DescribeSession(Fields& fields, SessionDocument& session) {
  fields.RefuseUnknown();
  fields.Object("source", session.source, DescribeSourceObject);
  fields.Object("intrinsics", session.intrinsics, DescribeIntrinsics);
}

}  // namespace

void DescribeSource(Fields& fields, std::string_view name, SourceDocument& source) {
  if (fields.Has(name, !source.empty())) {
    fields.Object(name, source, DescribeSourceObject);
  }
}

void DescribeFields(Fields& fields, PlaceRecordings& recordings) {
  DescribeSource(fields, "training", recordings.training);
  fields.Object("intrinsics", recordings.intrinsics, DescribeIntrinsics);
  fields.List(Optional("added", !recordings.added.empty()), recordings.added, kMaxAddedSessions,
              DescribeSession);
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
