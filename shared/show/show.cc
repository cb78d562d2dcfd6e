#include "shared/show/show.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/core/check.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::show {
namespace {

constexpr double kTicksPerSecond = drama::Drama::kTicksPerSecond;
// Further ahead than this, seeking is cheaper than playing through.
constexpr double kSeekAheadSeconds = 2.0;

}  // namespace

Result<std::unique_ptr<Show>> Show::Create(ShowContent content,
                                           const drama::DramaOptions& options,
                                           Log& log) {
  CHECK(!content.places.empty());
  std::unique_ptr<Show> show(new Show(std::move(content)));
  for (const CastMember& member : show->content_.cast) {
    LARARIUM_ASSIGN_OR_RETURN(const stage::ActorId id, show->stage_.Add(member.name, member.human));
    show->actor_ids_.push_back(id);
    show->performers_.emplace_back(show->stage_.Find(id)->model);
  }
  show->PrepareFloor(log);
  LARARIUM_ASSIGN_OR_RETURN(show->drama_,
                            drama::Drama::Create(show->content_.drama, show->content_.drama_file,
                                                 show->stage_, options, log));
  show->stage_.Capture(show->current_);
  show->previous_ = show->current_;
  return show;
}

// The show goes on where nobody can walk, but for the walks.
void Show::PrepareFloor(Log& log) {
  std::vector<stage::Place> places;
  for (const ShowPlace& place : content_.places) {
    places.push_back(place.stage);
  }
  if (const Status status = stage_.SetFloor({}, places); !status.ok()) {
    log.warn("{}", status.message());
  }
}

void Show::TickOnce() {
  std::swap(previous_, current_);
  drama_->Tick();
  stage_.Capture(current_);
  ++tick_;
}

void Show::AdvanceTo(double time) {
  const auto wanted = static_cast<int64_t>(std::ceil(time * kTicksPerSecond - 1e-9));
  const bool behind = wanted < tick_;
  const bool far_ahead = static_cast<double>(wanted - tick_) > kSeekAheadSeconds * kTicksPerSecond;
  if (behind || far_ahead) {
    // Stop one tick early, so that both snapshots are of this time.
    const int64_t before = std::max<int64_t>(wanted - 1, 0);
    if (drama_->Seek(static_cast<double>(before) / kTicksPerSecond).ok()) {
      tick_ = before;
      stage_.Capture(current_);
      previous_ = current_;
    }
  }
  while (tick_ < wanted) {
    TickOnce();
  }
}

void Show::Locate(vision::TrackedFrame tracked, StagedFrame& staged) {
  staged.camera_from_stage.reset();
  if (tracked.camera_from_map) {
    CHECK(tracked.map < content_.places.size());
    if (tracked.map != place_) {
      gain_filter_.Reset();
    }
    place_ = tracked.map;
    staged.camera_from_stage =
        stage::CameraFromStage(content_.places[place_].stage, *tracked.camera_from_map);
    staged.gain = gain_filter_.Update(tracked.gain, tracked.frame.capture_time);
    stage_.SetVisitor(geometry::ToGlm(staged.camera_from_stage->Center()));
  } else {
    gain_filter_.Reset();
    stage_.SetVisitor(std::nullopt);
  }
  staged.place = place_;
  staged.tracked = std::move(tracked);
}

void Show::StageFrame(vision::TrackedFrame tracked, double time, StagedFrame& staged) {
  time = std::clamp(time, 0.0, drama::Drama::kMaxTime);
  AdvanceTo(time);
  const double behind = static_cast<double>(tick_) - time * kTicksPerSecond;  // 0..1 ticks
  stage::Interpolate(previous_, current_, static_cast<float>(std::clamp(1.0 - behind, 0.0, 1.0)),
                     drawn_);

  staged.time = time;
  Locate(std::move(tracked), staged);
  staged.actors.clear();
  staged.skin.clear();
  for (uint32_t cast = 0; cast < actor_ids_.size(); ++cast) {
    const auto entry =
        std::find_if(drawn_.actors.begin(), drawn_.actors.end(),
                     [&](const auto& candidate) { return candidate.actor == actor_ids_[cast]; });
    if (entry == drawn_.actors.end() || !entry->state.visible) {
      continue;
    }
    performers_[cast].Pose(entry->state.performance);
    const std::span<const glm::mat4> skin = performers_[cast].skin();
    staged.actors.push_back({cast, stage::StageFromActor(entry->state),
                             static_cast<uint32_t>(staged.skin.size()),
                             static_cast<uint32_t>(skin.size())});
    staged.skin.insert(staged.skin.end(), skin.begin(), skin.end());
  }
}

}  // namespace lararium::show
