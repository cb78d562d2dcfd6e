#include "shared/show/lod_streamer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "shared/core/background.h"

namespace lararium::show {
namespace {

// Detail to read relative to the detail requested.
constexpr float kFiner = 0.7f;

bool IsWhole(const human::Human& human) {
  return std::all_of(human.meshes.begin(), human.meshes.end(),
                     [](const auto& mesh) { return mesh.error == 0.0f; });
}

Result<LodStreamer::Person> ReadFiner(const ReadPerson& read, size_t cast, float finest) {
  LARARIUM_ASSIGN_OR_RETURN(DrawnPerson drawn, read(cast, finest));
  return LodStreamer::Person{cast, CharacterMesh(std::move(drawn.human)), std::move(drawn.light)};
}

}  // namespace

float FinestDetail(const render::Quality& quality, int width) {
  constexpr float kNear = 1.15f;         // metres
  constexpr float kFocalOfWidth = 0.8f;  // Focal length in picture widths, for most cameras.
  return quality.detail_px * kNear / (kFocalOfWidth * static_cast<float>(width));
}

LodStreamer::LodStreamer(ReadPerson read, std::span<const CastMember> cast, Log& log)
    : read_(std::move(read)), log_(log) {
  for (const CastMember& member : cast) {
    finest_.push_back(!read_ || IsWhole(*member.human) ? 0.0f : member.finest);
  }
}

void LodStreamer::Want(size_t cast, float detail) {
  if (detail >= finest_[cast] || reading_.valid()) {
    return;
  }
  reading_cast_ = cast;
  reading_finest_ = kFiner * detail;
  reading_ = std::async(BackgroundLaunch(), ReadFiner, std::cref(read_), cast, reading_finest_);
}

LodStreamer::Reading LodStreamer::reading() const {
  if (!reading_.valid()) {
    return Reading::kNobody;
  }
  const bool done = reading_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
  return done ? Reading::kDone : Reading::kSomebody;
}

std::optional<LodStreamer::Person> LodStreamer::Take() {
  if (reading() != Reading::kDone) {
    return std::nullopt;
  }
  Result<Person> person = reading_.get();
  if (!person.ok()) {
    finest_[reading_cast_] = 0.0f;
    log_.Warn("{}", person.message());
    return std::nullopt;
  }
  const human::Human& human = *person->figure.human;
  finest_[reading_cast_] = IsWhole(human) ? 0.0f : reading_finest_;
  return std::move(person).value();
}

}  // namespace lararium::show
