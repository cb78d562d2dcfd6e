#include "editor/export/otio.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace lararium::exporter {
namespace {

constexpr double kRate = 120.0;

int64_t Ticks(double seconds) { return std::llround(seconds * kRate); }

Json Time(int64_t ticks) {
  return {
      {"OTIO_SCHEMA", "RationalTime.1"}, {"rate", kRate}, {"value", static_cast<double>(ticks)}};
}

Json Range(int64_t begin, int64_t length) {
  return {{"OTIO_SCHEMA", "TimeRange.1"}, {"start_time", Time(begin)}, {"duration", Time(length)}};
}

// The fields that all items have.
Json Item(const char* schema, const std::string& name) {
  return {{"OTIO_SCHEMA", schema},     {"name", name},
          {"source_range", nullptr},   {"effects", Json::array()},
          {"markers", Json::array()},  {"enabled", true},
          {"metadata", Json::object()}};
}

Json Metadata(const TimelineBlock& block) { return {{"lararium", block.metadata}}; }

Json Marker(const TimelineBlock& block, const char* colour) {
  return {{"OTIO_SCHEMA", "Marker.2"},
          {"name", block.name},
          {"color", colour},
          {"comment", ""},
          {"marked_range", Range(Ticks(block.begin), 0)},
          {"metadata", Metadata(block)}};
}

Json Reference(const TimelineBlock& block) {
  Json reference = {{"OTIO_SCHEMA", "MissingReference.1"},
                    {"name", ""},
                    {"available_range", nullptr},
                    {"available_image_bounds", nullptr},
                    {"metadata", Json::object()}};
  if (!block.media.empty()) {
    reference["OTIO_SCHEMA"] = "ExternalReference.1";
    reference["target_url"] = block.media;
    if (block.media_seconds > 0.0) {
      reference["available_range"] = Range(0, Ticks(block.media_seconds));
    }
  }
  return reference;
}

Json Clip(const TimelineBlock& block, int64_t length) {
  Json clip = Item("Clip.2", block.name);
  clip["source_range"] = Range(0, length);
  clip["metadata"] = Metadata(block);
  clip["media_references"] = {{"DEFAULT_MEDIA", Reference(block)}};
  clip["active_media_reference_key"] = "DEFAULT_MEDIA";
  return clip;
}

// A track that is being filled from its beginning.
struct OpenTrack {
  Json json;
  int64_t end = 0;  // End of the last block on it.
};

OpenTrack BeginTrack(const TimelineTrack& track, size_t number) {
  OpenTrack open;
  open.json =
      Item("Track.1", track.name + (number > 1 ? " " + std::to_string(number) : std::string()));
  open.json["kind"] = track.audio ? "Audio" : "Video";
  open.json["children"] = Json::array();
  return open;
}

void Append(const TimelineBlock& block, OpenTrack& track) {
  const int64_t begin = Ticks(block.begin);
  const int64_t length = std::max<int64_t>(Ticks(block.end) - begin, 1);
  if (begin > track.end) {
    Json gap = Item("Gap.1", "");
    gap["source_range"] = Range(0, begin - track.end);
    track.json["children"].push_back(std::move(gap));
  }
  track.json["children"].push_back(Clip(block, length));
  track.end = begin + length;
}

// Appends blocks in sequence, each to the first free track.
void AppendTracks(const TimelineTrack& track, Json& children) {
  std::vector<const TimelineBlock*> blocks;
  for (const TimelineBlock& block : track.blocks) {
    blocks.push_back(&block);
  }
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const auto* a, const auto* b) { return a->begin < b->begin; });
  std::vector<OpenTrack> open;
  open.push_back(BeginTrack(track, 1));
  for (const TimelineBlock* block : blocks) {
    if (!(block->end > block->begin)) {
      open.front().json["markers"].push_back(Marker(*block, "ORANGE"));
      continue;
    }
    auto free = std::find_if(open.begin(), open.end(), [&](const OpenTrack& candidate) {
      return candidate.end <= Ticks(block->begin);
    });
    if (free == open.end()) {
      free = open.insert(open.end(), BeginTrack(track, open.size() + 1));
    }
    Append(*block, *free);
  }
  for (OpenTrack& finished : open) {
    children.push_back(std::move(finished.json));
  }
}

}  // namespace

Json FormatOtio(const ShowTimeline& timeline) {
  Json stack = Item("Stack.1", "tracks");
  stack["children"] = Json::array();
  for (const TimelineTrack& track : timeline.tracks) {
    AppendTracks(track, stack["children"]);
  }
  for (const TimelineBlock& marker : timeline.markers) {
    stack["markers"].push_back(Marker(marker, "GREEN"));
  }
  return {{"OTIO_SCHEMA", "Timeline.1"},
          {"name", timeline.title},
          {"global_start_time", Time(0)},
          {"tracks", std::move(stack)},
          {"metadata", Json::object()}};
}

}  // namespace lararium::exporter
