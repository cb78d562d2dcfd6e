#include "shared/group/group_feed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shared/drama/timeline_text.h"

namespace lararium::group {
namespace {

constexpr int64_t kMarkersEvery = 50;  // Messages.

}  // namespace

void GroupFeed::SetShow(std::string show, std::vector<GroupOwn::Marker> markers) {
  const std::lock_guard lock(mutex_);
  own_.show = std::move(show);
  own_.markers = std::move(markers);
}

void GroupFeed::SetVisited(bool visited) {
  const std::lock_guard lock(mutex_);
  own_.visited = visited;
}

std::string GroupFeed::TakeOwn() {
  const std::optional<show::DramaGroup::Own> told = group_.TakeOwn();
  if (!told) {
    return "";
  }
  GroupOwn own;
  {
    const std::lock_guard lock(mutex_);
    own.show = own_.show;
    own.visited = own_.visited;
    if (messages_++ % kMarkersEvery == 0) {
      own.markers = own_.markers;
    }
  }
  const drama::Visitor& visitor = told->visitor;
  own.visitor = EntryOf(visitor);
  std::string_view keys = visitor.keys;
  for (std::string_view key = drama::TakeKey(keys); !key.empty(); key = drama::TakeKey(keys)) {
    if (key.size() <= kMostGroupKey && own.keys.size() < kMostGroupKeys) {
      own.keys.emplace_back(key);
    }
  }
  own.minute =
      visitor.hour < 0.0f ? -1 : std::min(static_cast<int>(visitor.hour * 60.0f), 24 * 60 - 1);
  own.restart = told->restart;
  if (told->mark) {
    own.mark_run = told->mark->run;
    own.mark = {told->mark->tick, told->mark->hash};
  }
  own.places = log_.Places();
  return FormatGroupMessage(own);
}

void GroupFeed::Take(std::string_view bytes) {
  const Result<GroupMessage> message = ParseGroupMessage(bytes);
  if (!message.ok()) {
    return;
  }
  if (const auto* part = std::get_if<GroupLogPart>(&*message)) {
    if (!log_.Has(part->before)) {
      return;  // A message was lost; the link notices.
    }
    const std::optional<GroupLog::Change> change = log_.Take(part->before.count, part->part, true);
    if (change) {
      changed_ = changed_.value_or(*change);
      changed_->index = std::min(changed_->index, change->index);
      changed_->tick = std::min(changed_->tick, change->tick);
    }
    return;
  }
  const auto* news = std::get_if<GroupClockNews>(&*message);
  if (news == nullptr) {
    return;
  }
  const auto piece = [&](size_t i) {
    return show::DramaGroup::Piece{news->pieces[i].since, news->pieces[i].seconds,
                                   news->pieces[i].rate};
  };
  const show::DramaGroup::Clock clock = {
      news->run, piece(0), news->pieces.size() > 1 ? std::optional(piece(1)) : std::nullopt};
  std::optional<show::DramaGroup::Revision> revision;
  if (changed_) {
    if (reader_.read() > changed_->index) {
      reader_ = {};  // The log is read again, because it has changed there.
    }
    revision.emplace();
    reader_.Read(log_, revision->entries);
    revision->tick = std::max(changed_->tick, 1);
    std::erase_if(revision->entries,
                  [&](const auto& entry) { return entry.tick < revision->tick; });
    changed_.reset();
  }
  group_.Update(clock, revision);
}

std::vector<GroupOwn::Marker> MarkersOf(std::string_view script) {
  std::vector<GroupOwn::Marker> markers;
  const auto text = drama::TimelineText::Read(std::string(script), "drama");
  for (size_t lane = 0; text.ok() && lane < text->lanes().size(); ++lane) {
    const drama::TimelineLane& items = text->lanes()[lane];
    for (size_t item = 0; items.kind == drama::LaneKind::kMarkers && item < items.size(); ++item) {
      const std::optional<Json> name = text->Field({lane, item}, "name");
      if (name && name->is_string() && markers.size() < kMostGroupMarkers) {
        markers.push_back({name->get<std::string>().substr(0, kMostGroupKey),
                           std::llround(items.at[item] * drama::Drama::kTicksPerSecond)});
      }
    }
  }
  return markers;
}

}  // namespace lararium::group
