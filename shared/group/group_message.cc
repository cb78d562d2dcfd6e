#include "shared/group/group_message.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>

#include "shared/core/flatbuffer_blocks.h"
#include "shared/group/group_generated.h"

namespace lararium::group {
namespace {

using flatbuffers::FlatBufferBuilder;

constexpr char kGroupWhere[] = "message of the group";
constexpr FlatbufferKind kGroupKind = {"group", 1, "update the players of the group"};
constexpr size_t kMostNameBytes = 64 + kPage.size();
constexpr size_t kMostShowBytes = 128;
constexpr size_t kMostPlaces = 64;
constexpr int64_t kMostTick = int64_t{24} * 3600 * 120;
constexpr int64_t kMostMicroseconds = int64_t{1} << 56;

bool IsTime(int64_t time) { return time > -kMostMicroseconds && time < kMostMicroseconds; }
bool IsTick(int64_t tick) { return tick >= 0 && tick <= kMostTick; }

// Texts have no control characters, and keys no blanks.
bool IsText(const std::string& text, size_t most, char first) {
  return text.size() <= most && std::all_of(text.begin(), text.end(), [first](char c) {
           return static_cast<unsigned char>(c) >= static_cast<unsigned char>(first) && c != 0x7f;
         });
}
bool IsKey(const std::string& text) { return !text.empty() && IsText(text, kMostGroupKey, '!'); }

GroupPlace PlaceOf(const group_fb::Place* place) {
  return place == nullptr ? GroupPlace() : GroupPlace{place->count(), place->hash()};
}
GroupMark MarkOf(const group_fb::Mark* mark) {
  return mark == nullptr ? GroupMark() : GroupMark{mark->tick(), mark->hash()};
}

// Pieces have padding, so that they are copied field by field.
void ReadPieces(const flatbuffers::Vector<const group_fb::Piece*>* from,
                BlockReader& reader,
                std::vector<GroupPiece>& to) {
  for (flatbuffers::uoffset_t i = 0; from != nullptr && i < from->size(); ++i) {
    if (!reader.Take(sizeof(group_fb::Piece))) {
      return;
    }
    to.push_back({from->Get(i)->since(), from->Get(i)->tick(), from->Get(i)->held()});
  }
}

bool IsValid(const GroupEntries& entries) {
  size_t text = 0;
  for (const GroupEntry& entry : entries.entries) {
    if (static_cast<int>(entry.kind) >= GroupEntry::kKinds || !IsTick(entry.tick)) {
      return false;
    }
    if (entry.has_text() && (text == entries.texts.size() || !IsKey(entries.texts[text++]))) {
      return false;
    }
  }
  return entries.entries.size() <= kMostGroupEntries && text == entries.texts.size();
}

bool IsValid(const std::vector<GroupPlace>& places) { return places.size() <= kMostPlaces; }

GroupBeat ReadMessage(const group_fb::Beat& from, BlockReader& reader) {
  GroupBeat beat;
  beat.boot = from.boot();
  beat.sent = from.sent();
  beat.since = from.since();
  beat.guide = from.guide();
  beat.ready = from.ready();
  beat.leads = from.leads();
  beat.visited = from.visited();
  reader.Read(from.leader(), beat.leader);
  reader.Read(from.show(), beat.show);
  beat.epoch = from.epoch();
  beat.run = from.run();
  beat.log = PlaceOf(from.log());
  beat.mark = MarkOf(from.mark());
  beat.followers = from.followers();
  beat.time = from.time();
  ReadPieces(from.pieces(), reader, beat.pieces);
  reader.ReadTables(from.echoes(), beat.echoes,
                    [](const group_fb::Echo& one, BlockReader& in, GroupBeat::Echo& echo) {
                      in.Read(one.name(), echo.name);
                      echo.sent = one.sent();
                      echo.received = one.received();
                    });
  return beat;
}
bool IsValid(const GroupBeat& beat) {
  return IsTime(beat.sent) && IsTime(beat.since) && IsTime(beat.time) &&
         beat.leads == !beat.pieces.empty() && beat.pieces.size() <= 2 &&
         beat.epoch < std::numeric_limits<uint64_t>::max() / 2 && IsTick(beat.mark.tick) &&
         IsText(beat.leader, kMostNameBytes, ' ') && IsText(beat.show, kMostShowBytes, ' ') &&
         beat.echoes.size() <= kMostGroupMembers + kMostGroupPages &&
         std::all_of(beat.pieces.begin(), beat.pieces.end(),
                     [](const GroupPiece& p) { return IsTime(p.since) && IsTick(p.tick); }) &&
         std::all_of(beat.echoes.begin(), beat.echoes.end(), [](const GroupBeat::Echo& echo) {
           return IsTime(echo.sent) && IsTime(echo.received) &&
                  IsText(echo.name, kMostNameBytes, ' ');
         });
}

GroupLogPart ReadMessage(const group_fb::Log& from, BlockReader& reader) {
  GroupLogPart log;
  log.epoch = from.epoch();
  log.run = from.run();
  log.before = PlaceOf(from.before());
  reader.Read(from.entries(), log.part.entries);
  reader.Read(from.texts(), log.part.texts);
  return log;
}
bool IsValid(const GroupLogPart& log) { return IsValid(log.part); }

GroupEvents ReadMessage(const group_fb::Events& from, BlockReader& reader) {
  GroupEvents events;
  events.boot = from.boot();
  reader.Read(from.entries(), events.events.entries);
  reader.Read(from.texts(), events.events.texts);
  return events;
}
bool IsValid(const GroupEvents& events) {
  const auto& entries = events.events.entries;
  return IsValid(events.events) && entries.size() <= kMostGroupKeys + 1 &&
         std::all_of(entries.begin(), entries.end(),
                     [](const GroupEntry& entry) { return entry.kind <= GroupEntry::Kind::kKey; });
}

GroupAsk ReadMessage(const group_fb::Ask& from, BlockReader& reader) {
  GroupAsk ask;
  reader.Read(from.places(), ask.places);
  return ask;
}
bool IsValid(const GroupAsk& ask) { return IsValid(ask.places); }

GroupWish ReadMessage(const group_fb::Wish& from, BlockReader& reader) {
  GroupWish wish;
  wish.boot = from.boot();
  wish.sent = from.sent();
  wish.what = static_cast<GroupWish::What>(from.what());
  reader.Read(from.marker(), wish.marker);
  return wish;
}
bool IsValid(const GroupWish& wish) {
  return IsTime(wish.sent) && static_cast<int>(wish.what) < GroupWish::kWhats &&
         IsText(wish.marker, kMostGroupKey, ' ');
}

GroupOwn ReadMessage(const group_fb::Own& from, BlockReader& reader) {
  GroupOwn own;
  reader.Read(from.show(), own.show);
  if (from.visitor() != nullptr) {
    std::memcpy(static_cast<void*>(&own.visitor), from.visitor(), sizeof(own.visitor));
  }
  reader.Read(from.keys(), own.keys);
  own.minute = from.minute();
  own.restart = from.restart();
  own.visited = from.visited();
  own.mark_run = from.mark_run();
  own.mark = MarkOf(from.mark());
  reader.Read(from.places(), own.places);
  reader.ReadTables(from.markers(), own.markers,
                    [](const group_fb::Marker& one, BlockReader& in, GroupOwn::Marker& marker) {
                      in.Read(one.name(), marker.name);
                      marker.tick = one.tick();
                    });
  return own;
}
bool IsValid(const GroupOwn& own) {
  return IsText(own.show, kMostShowBytes, ' ') && own.visitor.kind <= GroupEntry::Kind::kLost &&
         own.keys.size() <= kMostGroupKeys &&
         std::all_of(own.keys.begin(), own.keys.end(), IsKey) && own.minute >= -1 &&
         own.minute < 24 * 60 && IsTick(own.mark.tick) && IsValid(own.places) &&
         own.markers.size() <= kMostGroupMarkers &&
         std::all_of(own.markers.begin(), own.markers.end(), [](const GroupOwn::Marker& marker) {
           return IsTick(marker.tick) && IsText(marker.name, kMostGroupKey, ' ');
         });
}

GroupClockNews ReadMessage(const group_fb::Clock& from, BlockReader& reader) {
  GroupClockNews clock;
  clock.run = from.run();
  reader.Read(from.pieces(), clock.pieces);
  return clock;
}
bool IsValid(const GroupClockNews& clock) {
  return !clock.pieces.empty() && clock.pieces.size() <= 2 &&
         std::all_of(clock.pieces.begin(), clock.pieces.end(),
                     [](const GroupClockNews::Piece& piece) {
                       return std::isfinite(piece.since) && std::isfinite(piece.seconds) &&
                              piece.rate >= 0.0 && piece.rate < 2.0;
                     });
}

std::vector<group_fb::Piece> PiecesOf(const GroupBeat& beat) {
  std::vector<group_fb::Piece> pieces;
  for (const GroupPiece& piece : beat.pieces) {
    pieces.emplace_back(piece.since, piece.tick, piece.held);
  }
  return pieces;
}

// Writes the one table of a message.
class Writer {
 public:
  std::string bytes() const {
    return {reinterpret_cast<const char*>(builder_.GetBufferPointer()), builder_.GetSize()};
  }

  void operator()(const GroupBeat& beat) {
    const auto pieces = builder_.CreateVectorOfStructs(PiecesOf(beat));
    const auto echoes = WriteTables(
        builder_, beat.echoes, [](FlatBufferBuilder& builder, const GroupBeat::Echo& echo) {
          return group_fb::CreateEcho(builder, builder.CreateString(echo.name), echo.sent,
                                      echo.received);
        });
    const group_fb::Place log(beat.log.count, beat.log.hash);
    const group_fb::Mark mark(beat.mark.tick, beat.mark.hash);
    const auto table = group_fb::CreateBeat(
        builder_, beat.boot, beat.sent, beat.since, beat.guide, beat.ready, beat.leads,
        beat.visited, builder_.CreateString(beat.leader), builder_.CreateString(beat.show),
        beat.epoch, beat.run, &log, &mark, beat.followers, beat.time, pieces, echoes);
    Close([&](group_fb::MessageBuilder& message) { message.add_beat(table); });
  }
  void operator()(const GroupLogPart& log) {
    const group_fb::Place before(log.before.count, log.before.hash);
    const auto table = group_fb::CreateLog(builder_, log.epoch, log.run, &before,
                                           WriteBlock<group_fb::Entry>(builder_, log.part.entries),
                                           builder_.CreateVectorOfStrings(log.part.texts));
    Close([&](group_fb::MessageBuilder& message) { message.add_log(table); });
  }
  void operator()(const GroupEvents& events) {
    const auto table = group_fb::CreateEvents(
        builder_, events.boot, WriteBlock<group_fb::Entry>(builder_, events.events.entries),
        builder_.CreateVectorOfStrings(events.events.texts));
    Close([&](group_fb::MessageBuilder& message) { message.add_events(table); });
  }
  void operator()(const GroupAsk& ask) {
    const auto table =
        group_fb::CreateAsk(builder_, WriteBlock<group_fb::Place>(builder_, ask.places));
    Close([&](group_fb::MessageBuilder& message) { message.add_ask(table); });
  }
  void operator()(const GroupWish& wish) {
    const auto table =
        group_fb::CreateWish(builder_, wish.boot, wish.sent, static_cast<uint8_t>(wish.what),
                             builder_.CreateString(wish.marker));
    Close([&](group_fb::MessageBuilder& message) { message.add_wish(table); });
  }
  void operator()(const GroupOwn& own) {
    group_fb::Entry visitor;
    std::memcpy(static_cast<void*>(&visitor), &own.visitor, sizeof(visitor));
    const group_fb::Mark mark(own.mark.tick, own.mark.hash);
    const auto markers = WriteTables(
        builder_, own.markers, [](FlatBufferBuilder& builder, const GroupOwn::Marker& marker) {
          return group_fb::CreateMarker(builder, builder.CreateString(marker.name), marker.tick);
        });
    const auto table = group_fb::CreateOwn(
        builder_, builder_.CreateString(own.show), &visitor,
        builder_.CreateVectorOfStrings(own.keys), own.minute, own.restart, own.visited,
        own.mark_run, &mark, WriteBlock<group_fb::Place>(builder_, own.places), markers);
    Close([&](group_fb::MessageBuilder& message) { message.add_own(table); });
  }
  void operator()(const GroupClockNews& clock) {
    const auto table = group_fb::CreateClock(
        builder_, clock.run, WriteBlock<group_fb::ClockPiece>(builder_, clock.pieces));
    Close([&](group_fb::MessageBuilder& message) { message.add_clock(table); });
  }

 private:
  template <typename Add>
  void Close(const Add& add) {
    group_fb::MessageBuilder message(builder_);
    message.add_version(kGroupKind.version);
    add(message);
    builder_.Finish(message.Finish(), group_fb::MessageIdentifier());
  }

  FlatBufferBuilder builder_;
};

}  // namespace

Result<GroupMessage> ParseGroupMessage(std::string_view bytes) {
  if (bytes.size() > kMostGroupBytes) {
    return Status::Error(kGroupWhere, "is longer than 60000 bytes");
  }
  const std::vector<char> aligned(bytes.begin(), bytes.end());
  LARARIUM_ASSIGN_OR_RETURN(
      const group_fb::Message* root,
      OpenFlatbuffer<group_fb::Message>(std::as_bytes(std::span(aligned)),
                                        group_fb::MessageIdentifier(), kGroupKind, kGroupWhere));
  BlockReader reader(bytes.size());
  GroupMessage message;
  bool valid = false;
  int tables = 0;
  const auto read = [&](const auto* table) {
    if (table != nullptr) {
      auto content = ReadMessage(*table, reader);
      valid = IsValid(content);
      message = std::move(content);
      ++tables;
    }
  };
  read(root->beat());
  read(root->log());
  read(root->events());
  read(root->ask());
  read(root->wish());
  read(root->own());
  read(root->clock());
  if (!reader.ok() || !valid || tables != 1) {
    return Status::Error(kGroupWhere, "has values that are not possible");
  }
  return message;
}

std::string FormatGroupMessage(const GroupMessage& message) {
  Writer writer;
  std::visit(writer, message);
  return writer.bytes();
}

}  // namespace lararium::group
