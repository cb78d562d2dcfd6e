#include "editor/panels/timeline_panel.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

#include "editor/app/line_edits.h"
#include "editor/app/timeline_fields.h"
#include "editor/panels/text.h"
#include "editor/panels/theme.h"
#include "editor/panels/timeline_draw.h"
#include "editor/panels/timeline_inspector.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

using app::TextOf;
using drama::LaneKind;
using drama::TaskRecord;
using drama::TimelineItem;
using drama::TimelineLane;
using drama::TimelineText;

namespace {

// Logical pixels.
constexpr float kRow = 24.0f;
constexpr float kSpeechRow = 42.0f;
constexpr float kRuler = 26.0f;
constexpr float kGutter = 176.0f;
constexpr float kInspector = 300.0f;
constexpr float kEdge = 6.0f;       // of an item, that trims
constexpr float kLeastItem = 9.0f;  // as wide as an item is at least
constexpr float kClick = 4.0f;      // the mouse moves further in a drag
constexpr float kSnapReach = 8.0f;

constexpr double kFrame = 1.0 / 30.0;  // seconds, of the keys
constexpr double kLongNatural = 60.0;  // items without a length last no longer than that
constexpr double kNudge = 0.1;

uint64_t KeyOf(const TimelineItem& item) { return uint64_t{item.lane} << 40 | item.item; }

std::string Shorten(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string PointText(const Json& point) {
  return Shorten(point.value("x", 0.0)) + ", " + Shorten(point.value("z", 0.0));
}

// What an item says in a few words.
std::string LabelOf(LaneKind kind, const Json& fields) {
  const auto point = [&](const char* key) {
    const auto found = fields.find(key);
    return found != fields.end() && found->is_object() ? PointText(*found) : "";
  };
  switch (kind) {
    case LaneKind::kGaze: {
      const std::string target = TextOf(fields, "target");
      return !target.empty() ? target : point("target");
    }
    case LaneKind::kUses: {
      const std::string action = TextOf(fields, "action");
      const std::string object = TextOf(fields, "object");
      return action.empty() || object.empty() ? action + object : action + " " + object;
    }
    case LaneKind::kClips:
    case LaneKind::kWalks: {
      const std::string clip = TextOf(fields, "clip");
      const std::string to = point("to");
      const std::string from = point("from");
      const std::string where = !to.empty()                     ? "\xe2\x86\x92 " + to
                                : !from.empty() && clip.empty() ? Text(Tr("at %s"), from.c_str())
                                : fields.contains("hide")       ? Tr("leaves")
                                                                : "";
      return clip.empty() || where.empty() ? clip + where : clip + " " + where;
    }
    default:
      return TextOf(fields, app::NamingField(kind));
  }
}

std::string BlockLabel(const TaskRecord& task, bool of_object) {
  std::string action = task.action;
  for (const char* prefix : {"say ", "gesture ", "express ", "use ", "play "}) {
    if (action.starts_with(prefix)) {
      action = action.substr(std::string_view(prefix).size());
      break;
    }
  }
  std::replace(action.begin(), action.end(), '_', ' ');
  return of_object ? task.actor + ": " + action
                   : action + (task.object.empty() ? "" : " " + task.object);
}

// A line of the actor that the timeline does not have yet, else a new one.
std::string LineFor(const app::Workspace& workspace, const std::string& actor) {
  const bake::LineTable none;
  const auto& table = workspace.document().lines;
  const bake::LineTable& lines = table != nullptr ? *table : none;
  for (const bake::Line& line : lines.lines) {
    const bool named = workspace.script().text().find('"' + line.id + '"') != std::string::npos;
    if (line.speaker == actor && !actor.empty() && !named) {
      return line.id;
    }
  }
  return app::FreeLineId(lines, actor.empty() ? "text" : actor);
}

// What a new item says before it was edited.
Json NewFields(const app::Workspace& workspace,
               LaneKind kind,
               const std::string& actor,
               double at) {
  Json fields = {{"at", at}};
  const app::StageWords none;
  const app::StageWords& words =
      workspace.drama_run() != nullptr ? workspace.drama_run()->words : none;
  const auto first = [](const auto& list, const char* otherwise) {
    return list.empty() ? std::string(otherwise) : list.front().name;
  };
  switch (kind) {
    case LaneKind::kSpeech:
    case LaneKind::kCaptions:
      fields["line"] = LineFor(workspace, actor);
      break;
    case LaneKind::kGestures:
    case LaneKind::kClips: {
      const app::StageWords::Person* person = words.FindPerson(actor);
      fields["clip"] = person != nullptr ? first(person->clips, "idle") : "idle";
      if (kind == LaneKind::kClips) {
        fields["length"] = 2.0;
      }
      break;
    }
    case LaneKind::kWalks:
      fields["to"] = {{"x", 0.0}, {"z", -1.0}};
      break;
    case LaneKind::kUses:
      fields["object"] = first(words.things, "object");
      break;
    case LaneKind::kGaze:
      fields["target"] = "visitor";
      fields["length"] = 3.0;
      break;
    case LaneKind::kExpressions:
      fields["expression"] = "joy";
      fields["intensity"] = 0.7;
      fields["length"] = 3.0;
      break;
    case LaneKind::kLights: {
      fields["light"] = "lamp";
      for (const app::StageWords::Thing& thing : words.things) {
        if (thing.burns) {
          fields["light"] = thing.name;
          break;
        }
      }
      fields["level"] = 0.5;
      fields["length"] = 3.0;
      break;
    }
    case LaneKind::kSounds:
      fields["sound"] = words.sounds.empty() ? "bell" : words.sounds.front();
      break;
    case LaneKind::kMarkers:
      fields["name"] = "marker";
      break;
  }
  return fields;
}

// How long something that an item told took when it was played; 0: it is not known.
double PlayedSeconds(std::span<const TaskRecord> tasks, const TimelineLane& lane, double at) {
  constexpr double kLate = 0.05;  // seconds: it begins with a tick
  auto task = std::lower_bound(tasks.begin(), tasks.end(), at - 1e-6,
                               [](const TaskRecord& t, double time) { return t.began < time; });
  for (; task != tasks.end() && task->began <= at + kLate; ++task) {
    if (task->from_timeline && task->actor == lane.actor && LaneOfTask(*task) == lane.kind) {
      return task->ended - task->began;
    }
  }
  return 0.0;
}

bool ToggleButton(const char* label, bool& on, const std::string& tip) {
  ImGui::PushStyleColor(ImGuiCol_Button, on ? Colours().chosen : Colours().frame);
  const bool pressed = ImGui::Button(label);
  ImGui::PopStyleColor();
  if (pressed) {
    on = !on;
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s", tip.c_str());
  }
  return pressed;
}

}  // namespace

// ---- what is shown ----

void TimelinePanel::Refresh(const app::Workspace& workspace) {
  const app::ScriptDocument& script = workspace.script();
  const std::vector<app::CastDocument>& cast = workspace.document().cast;
  if (script.revision() == script_ && workspace.drama_run_number() == run_ &&
      cast.size() == cast_) {
    FillShown();
    return;
  }
  const bool new_run = workspace.drama_run_number() != run_;
  script_ = script.revision();
  run_ = workspace.drama_run_number();
  cast_ = cast.size();
  faces_.clear();
  std::vector<std::string> people;
  for (const app::CastDocument& member : cast) {
    people.push_back(member.name);
  }
  const std::span<const TaskRecord> tasks =
      workspace.drama_run() != nullptr ? std::span<const TaskRecord>(workspace.drama_run()->tasks)
                                       : std::span<const TaskRecord>();
  rows_ = MakeRows(script.timeline(), people, tasks);
  if (new_run) {
    block_.reset();
    if (!objects_folded_at_first_ && !tasks.empty()) {
      objects_folded_at_first_ = true;
      for (const TimelineRow& row : rows_) {
        if (row.of_object) {
          folded_.insert("object " + row.group);
        }
      }
    }
  }
  if (script.timeline() != nullptr) {
    KeepValid(*script.timeline(), selection_);
  } else {
    selection_.clear();
  }
  FillShown();
}

const TimelinePanel::Face& TimelinePanel::FaceOf(const app::Workspace& workspace,
                                                 const TimelineItem& item) {
  const auto [entry, is_new] = faces_.try_emplace(KeyOf(item));
  Face& face = entry->second;
  if (!is_new) {
    return face;
  }
  const TimelineText& text = *workspace.script().timeline();
  const TimelineLane& lane = text.lanes()[item.lane];
  Json fields = Json::object();
  for (drama::TimelineField& field : text.Fields(item)) {
    fields[field.key] = std::move(field.value);
  }
  face.label = LabelOf(lane.kind, fields);
  face.line = TextOf(fields, "line");
  const app::DramaRun* run = workspace.drama_run();
  if (run == nullptr || lane.length[item.item] > 0.0) {
    return face;
  }
  if (!face.line.empty()) {
    const app::StageWords::Line* line = run->words.FindLine(face.line);
    face.natural = line != nullptr ? line->seconds : 0.0;
  } else if (lane.kind == LaneKind::kGestures) {
    face.natural = run->words.ClipSeconds(lane.actor, TextOf(fields, "clip"));
  } else if (lane.kind == LaneKind::kWalks || lane.kind == LaneKind::kUses) {
    face.natural = PlayedSeconds(run->tasks, lane, lane.at[item.item]);
  }
  face.natural = std::min(face.natural, kLongNatural);
  return face;
}

TimeSpan TimelinePanel::Shown(const app::Workspace& workspace, const TimelineItem& item) {
  const TimelineLane& lane = workspace.script().timeline()->lanes()[item.lane];
  TimeSpan span{lane.at[item.item], lane.at[item.item] + lane.length[item.item]};
  if (lane.length[item.item] <= 0.0 && lane.kind != LaneKind::kMarkers) {
    span.end = span.begin + FaceOf(workspace, item).natural;
  }
  if (drag_.by != 0.0 && Contains(selection_, item)) {
    if (drag_.kind == Drag::Kind::kMove) {
      span.begin += drag_.by;
      span.end += drag_.by;
    } else if (drag_.kind == Drag::Kind::kTrimBegin) {
      span.begin = std::clamp(span.begin + drag_.by, 0.0, std::max(span.end - kShortest, 0.0));
    } else if (drag_.kind == Drag::Kind::kTrimEnd) {
      span.end = std::max(span.end + drag_.by, span.begin + kShortest);
    }
  }
  return span;
}

std::pair<float, float> TimelinePanel::Extent(const TimeSpan& span) const {
  const float x0 = scale_.XOf(span.begin);
  return {x0, std::max(scale_.XOf(span.end), x0 + Px(kLeastItem))};
}

// ---- the mouse ----

TimelinePanel::Hit TimelinePanel::HitAt(const app::Workspace& workspace,
                                        const ImVec2& mouse,
                                        float rows_top) {
  Hit hit;
  hit.row = RowAt(mouse.y - rows_top);
  if (hit.row < 0 || mouse.x < scale_.left) {
    return hit;
  }
  const TimelineRow& row = *shown_[static_cast<size_t>(hit.row)];
  const double before = scale_.TimeAt(mouse.x - Px(kLeastItem));
  const double after = scale_.TimeAt(mouse.x + Px(1));
  const auto covers = [&](const TimeSpan& span) {
    const auto [x0, x1] = Extent(span);
    if (mouse.x < x0 || mouse.x > x1) {
      return false;
    }
    const float edge = std::min(Px(kEdge), 0.3f * (x1 - x0));
    hit.part = mouse.x < x0 + edge   ? Hit::Part::kBegin
               : mouse.x > x1 - edge ? Hit::Part::kEnd
                                     : Hit::Part::kBody;
    return true;
  };
  // Of several the one that is drawn last.
  if (row.kind == TimelineRow::Kind::kItems) {
    for (const size_t lane : row.lanes) {
      found_.clear();
      workspace.script().timeline()->Query(lane, before - kLongNatural, after, found_);
      for (auto item = found_.rbegin(); item != found_.rend() && !hit.item; ++item) {
        if (covers(Shown(workspace, {lane, *item}))) {
          hit.item = {lane, *item};
        }
      }
    }
    if (hit.item && row.lane == LaneKind::kMarkers) {
      hit.part = Hit::Part::kBody;
    }
  } else if (row.kind == TimelineRow::Kind::kBlocks && workspace.drama_run() != nullptr) {
    found_.clear();
    row.index.Query(before, after, found_);
    for (auto block = found_.rbegin(); block != found_.rend() && !hit.block; ++block) {
      const TaskRecord& task = workspace.drama_run()->tasks[row.blocks[*block]];
      if (covers({task.began, task.ended})) {
        hit.block = row.blocks[*block];
        hit.part = Hit::Part::kBody;
      }
    }
  }
  return hit;
}

void TimelinePanel::BeginDrag(app::Workspace& workspace,
                              EditorState& state,
                              const Hit& hit,
                              float rows_top) {
  const ImGuiIO& io = ImGui::GetIO();
  state.focus = Focus::kTimeline;
  drag_ = {};
  drag_.from = scale_.TimeAt(io.MousePos.x);
  drag_.from_y = io.MousePos.y - rows_top;
  drag_.before = selection_;
  const bool adds = io.KeyCtrl || io.KeyShift;
  if (hit.block) {
    selection_.clear();
    block_ = hit.block;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      GoToScript(workspace, state);
    }
    return;
  }
  block_.reset();
  if (!hit.item) {
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && hit.row >= 0 &&
        shown_[static_cast<size_t>(hit.row)]->kind == TimelineRow::Kind::kItems) {
      const TimelineRow& row = *shown_[static_cast<size_t>(hit.row)];
      workspace.SetTime(std::max(drag_.from, 0.0));
      Add(workspace, row.lane, row.group);
      return;
    }
    drag_.kind = Drag::Kind::kBox;
    if (!adds) {
      selection_.clear();
    }
    return;
  }
  if (adds) {
    Toggle(selection_, *hit.item);
    return;
  }
  if (!Contains(selection_, *hit.item)) {
    selection_ = {*hit.item};
  }
  drag_.grabbed = *hit.item;
  drag_.kind = hit.part == Hit::Part::kBegin ? Drag::Kind::kTrimBegin
               : hit.part == Hit::Part::kEnd ? Drag::Kind::kTrimEnd
                                             : Drag::Kind::kMove;
  // What it is drawn to: the playhead, and the ends of all that stays.
  drag_.marks = {0.0, workspace.time()};
  const TimelineText& text = *workspace.script().timeline();
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    const TimelineLane& in = text.lanes()[lane];
    for (size_t i = 0; i < in.size(); ++i) {
      if (!Contains(selection_, {lane, i})) {
        drag_.marks.push_back(in.at[i]);
        drag_.marks.push_back(in.at[i] + in.length[i]);
      }
    }
  }
  if (const app::DramaRun* run = workspace.drama_run()) {
    for (const TaskRecord& task : run->tasks) {
      if (!task.from_timeline) {
        drag_.marks.push_back(task.began);
        drag_.marks.push_back(task.ended);
      }
    }
  }
}

// How far a drag goes that the mouse took so far.
void TimelinePanel::SnapDrag(const app::Workspace& workspace, double by) {
  const TimelineText& text = *workspace.script().timeline();
  const double by_before = std::exchange(drag_.by, 0.0);
  const TimeSpan grabbed = Shown(workspace, drag_.grabbed);
  drag_.by = by_before;
  drag_.snapped_to = -1.0;
  if (snap_ && !ImGui::GetIO().KeyAlt) {
    const RulerStep step = ChooseStep(scale_.seconds_per_px, Px(76));
    const double grid = step.seconds / step.parts;
    const double reach = Px(kSnapReach) * scale_.seconds_per_px;
    double best = reach;
    const auto draw_to = [&](double time) {
      const double to = Snap(time + by, drag_.marks, grid, reach);
      if (to != time + by && std::abs(to - time - by) < best) {
        best = std::abs(to - time - by);
        drag_.snapped_to = to;
      }
      return to - time - by;
    };
    const bool begins = drag_.kind != Drag::Kind::kTrimEnd;
    const bool ends = drag_.kind != Drag::Kind::kTrimBegin && grabbed.end > grabbed.begin;
    const double of_begin = begins ? draw_to(grabbed.begin) : 0.0;
    const double of_end = ends ? draw_to(grabbed.end) : 0.0;
    const bool end_nearer =
        of_end != 0.0 && (of_begin == 0.0 || std::abs(of_end) < std::abs(of_begin));
    by += end_nearer ? of_end : of_begin;
  }
  if (drag_.kind == Drag::Kind::kMove) {
    const double allowed = ClampMove(text, selection_, by, ripple_);
    drag_.snapped_to = allowed == by ? drag_.snapped_to : -1.0;
    by = allowed;
  }
  drag_.by = by;
}

void TimelinePanel::SelectBox(const app::Workspace& workspace, double to, float y) {
  selection_ = drag_.before;
  if (!ImGui::GetIO().KeyCtrl && !ImGui::GetIO().KeyShift) {
    selection_.clear();
  }
  const double begin = std::min(drag_.from, to);
  const double end = std::max(drag_.from, to);
  const float low = std::min(drag_.from_y, y);
  const float high = std::max(drag_.from_y, y);
  for (size_t r = 0; r < shown_.size(); ++r) {
    const TimelineRow& row = *shown_[r];
    if (tops_[r] > high || tops_[r + 1] < low) {
      continue;
    }
    for (const size_t lane : row.lanes) {
      found_.clear();
      workspace.script().timeline()->Query(lane, begin - kLongNatural, end, found_);
      for (const uint32_t item : found_) {
        if (Shown(workspace, {lane, item}).end >= begin) {
          selection_.push_back({lane, item});
        }
      }
    }
  }
  std::sort(selection_.begin(), selection_.end());
  selection_.erase(std::unique(selection_.begin(), selection_.end()), selection_.end());
}

void TimelinePanel::UpdateDrag(app::Workspace& workspace, float rows_top) {
  const ImGuiIO& io = ImGui::GetIO();
  const double now = scale_.TimeAt(io.MousePos.x);
  const float y = io.MousePos.y - rows_top;
  drag_.moved |= ImGui::IsMouseDragging(ImGuiMouseButton_Left, Px(kClick));
  if (!drag_.moved || workspace.script().timeline() == nullptr) {
    return;
  }
  switch (drag_.kind) {
    case Drag::Kind::kMove:
    case Drag::Kind::kTrimBegin:
    case Drag::Kind::kTrimEnd:
      SnapDrag(workspace, now - drag_.from);
      break;
    case Drag::Kind::kBox:
      SelectBox(workspace, now, y);
      break;
    default:
      break;
  }
}

std::vector<double> TimelinePanel::Naturals(const app::Workspace& workspace) {
  std::vector<double> naturals;
  for (const TimelineItem& item : selection_) {
    naturals.push_back(std::max(FaceOf(workspace, item).natural, kShortest));
  }
  return naturals;
}

std::string TimelinePanel::NameOfSelection(const app::Workspace& workspace) {
  if (selection_.size() == 1) {
    const std::string& label = FaceOf(workspace, selection_.front()).label;
    return label.empty() ? Tr("an item") : label;
  }
  return TrCount("%d item", "%d items", static_cast<int>(selection_.size()));
}

void TimelinePanel::EndDrag(app::Workspace& workspace) {
  const Drag drag = std::exchange(drag_, Drag());
  if (!drag.moved || drag.by == 0.0 || workspace.script().timeline() == nullptr) {
    if (!drag.moved && drag.kind == Drag::Kind::kMove) {
      selection_ = {drag.grabbed};  // a click on one of several
    }
    return;
  }
  const std::string name = NameOfSelection(workspace);
  const std::vector<double> naturals = Naturals(workspace);
  if (drag.kind == Drag::Kind::kMove) {
    workspace.EditTimeline(Text(Tr("move %s"), name.c_str()), [&](TimelineText& text) {
      return MoveItems(text, selection_, drag.by, ripple_);
    });
  } else if (drag.kind == Drag::Kind::kTrimBegin) {
    workspace.EditTimeline(Text(Tr("trim %s"), name.c_str()), [&](TimelineText& text) {
      return TrimBegins(text, selection_, naturals, drag.by);
    });
  } else if (drag.kind == Drag::Kind::kTrimEnd) {
    workspace.EditTimeline(Text(Tr("trim %s"), name.c_str()), [&](TimelineText& text) {
      return TrimEnds(text, selection_, naturals, drag.by, ripple_);
    });
  }
}

void TimelinePanel::HandleWheel() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl && io.MouseWheel != 0.0f) {
    Zoom(scale_, std::pow(0.8, io.MouseWheel), std::max(io.MousePos.x, scale_.left));
    return;
  }
  const float sideways = io.KeyShift ? io.MouseWheel + io.MouseWheelH : io.MouseWheelH;
  if (sideways != 0.0f) {
    scale_.first = std::max(scale_.first - sideways * Px(60) * scale_.seconds_per_px, 0.0);
  } else if (io.MouseWheel != 0.0f) {
    ImGui::SetScrollY(ImGui::GetScrollY() - io.MouseWheel * Px(2 * kRow));
  }
}

void TimelinePanel::HandleMouse(app::Workspace& workspace,
                                EditorState& state,
                                float rows_top,
                                bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool active = ImGui::IsItemActive();
  const bool in_gutter = io.MousePos.x < scale_.left;
  if (hovered) {
    HandleWheel();
  }
  const Hit hit = hovered ? HitAt(workspace, io.MousePos, rows_top) : Hit();
  if (ImGui::IsItemActivated()) {
    if (io.MouseClicked[ImGuiMouseButton_Middle]) {
      drag_ = {};
      drag_.kind = Drag::Kind::kPan;
      drag_.pan_first = scale_.first;
      drag_.from_y = io.MousePos.x;
    } else if (io.MouseClicked[ImGuiMouseButton_Right] && !in_gutter) {
      state.focus = Focus::kTimeline;
      if (hit.item && !Contains(selection_, *hit.item)) {
        selection_ = {*hit.item};
        block_.reset();
      }
      context_ = hit;
      open_context_ = true;
      drag_ = {};
    } else if (in_gutter) {
      state.focus = Focus::kTimeline;
      if (hit.row >= 0 &&
          shown_[static_cast<size_t>(hit.row)]->kind == TimelineRow::Kind::kHeading) {
        const TimelineRow& row = *shown_[static_cast<size_t>(hit.row)];
        const std::string key = (row.of_object ? "object " : "person ") + row.group;
        if (folded_.erase(key) == 0) {
          folded_.insert(key);
        }
      }
      drag_ = {};
    } else {
      BeginDrag(workspace, state, hit, rows_top);
    }
  } else if (active && drag_.kind == Drag::Kind::kPan) {
    scale_.first =
        std::max(drag_.pan_first - (io.MousePos.x - drag_.from_y) * scale_.seconds_per_px, 0.0);
  } else if (active) {
    UpdateDrag(workspace, rows_top);
  }
  if (ImGui::IsItemDeactivated() && drag_.kind != Drag::Kind::kScrub) {
    EndDrag(workspace);
  }
  if (hovered && (hit.item || hit.block) && !active) {
    const bool edge = hit.part == Hit::Part::kBegin || hit.part == Hit::Part::kEnd;
    ImGui::SetMouseCursor(edge ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_Arrow);
    ShowTooltip(workspace, hit);
  }
}

void TimelinePanel::ShowTooltip(app::Workspace& workspace, const Hit& hit) {
  std::string title;
  std::string times;
  std::string hint;
  if (hit.item) {
    const TimeSpan span = Shown(workspace, *hit.item);
    const TimelineLane& lane = workspace.script().timeline()->lanes()[hit.item->lane];
    title = std::string(ItemTitle(lane.kind)) + ": " + FaceOf(workspace, *hit.item).label;
    times = FormatTime(span.begin, 0.01) + " \xe2\x80\x93 " + FormatTime(span.end, 0.01);
    hint = Text(Tr("line %zu of the script"), workspace.script().timeline()->LineOf(*hit.item));
  } else {
    const TaskRecord& task = workspace.drama_run()->tasks[*hit.block];
    title = task.actor + ": " + BlockLabel(task, false);
    times = FormatTime(task.began, 0.01) + " \xe2\x80\x93 " + FormatTime(task.ended, 0.01);
    hint = task.failed
               ? task.message
               : Text(Tr("by the script, %s; double-click to go there"), task.where.c_str());
  }
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(title.c_str());
  DimText(times);
  DimText(hint);
  ImGui::EndTooltip();
}

// ---- drawing ----

void TimelinePanel::DrawVoiceOf(const app::Workspace& workspace,
                                const std::string& line,
                                double begin,
                                const ImVec2& from,
                                const ImVec2& to,
                                ImU32 colour,
                                ImDrawList& draw) const {
  const app::DramaRun* run = workspace.drama_run();
  const app::StageWords::Line* voice = run != nullptr ? run->words.FindLine(line) : nullptr;
  if (voice != nullptr && !voice->peaks.empty()) {
    DrawVoice(draw, scale_, {voice->peaks, app::StageWords::Line::kPeaksPerSecond, voice->visemes},
              begin, from, to, colour);
  }
}

int TimelinePanel::RowAt(float y) const {
  const auto behind = std::upper_bound(tops_.begin(), tops_.end(), y);
  return behind == tops_.begin() || behind == tops_.end()
             ? -1
             : static_cast<int>(behind - tops_.begin()) - 1;
}

void TimelinePanel::FillShown() {
  shown_.clear();
  tops_ = {0.0f};
  bool folded = false;
  for (const TimelineRow& row : rows_) {
    if (row.kind == TimelineRow::Kind::kHeading) {
      folded = folded_.contains((row.of_object ? "object " : "person ") + row.group);
    } else if (folded) {
      continue;
    }
    shown_.push_back(&row);
    const bool speech = row.kind != TimelineRow::Kind::kHeading && row.lane == LaneKind::kSpeech;
    tops_.push_back(tops_.back() + Px(speech ? kSpeechRow : kRow));
  }
}

void TimelinePanel::DrawItems(const app::Workspace& workspace,
                              const TimelineRow& row,
                              float top,
                              float height,
                              const Hit& hit,
                              ImDrawList& draw) {
  const TimelineText& text = *workspace.script().timeline();
  const ImVec4 colour = LaneColour(row.lane);
  const float y0 = top + Px(2);
  const float y1 = top + height - Px(2);
  const double to = scale_.last();
  for (const size_t lane : row.lanes) {
    const TimelineLane& in = text.lanes()[lane];
    found_.clear();
    text.Query(lane, std::max(scale_.first - kLongNatural, 0.0), to, found_);
    float filled_to = scale_.left - 1.0f;
    for (const uint32_t number : found_) {
      const TimelineItem item{lane, number};
      const bool selected = Contains(selection_, item);
      // Where many lie in one pixel, one stands for all.
      const double end = in.at[number] + std::max(in.length[number], 0.0);
      const float plain_end = std::max(scale_.XOf(end), scale_.XOf(in.at[number]) + 1.0f);
      if (!selected && plain_end <= filled_to) {
        continue;
      }
      const bool dense = scale_.seconds_per_px > 0.5 && in.size() > 5000;
      const TimeSpan span =
          dense && !selected ? TimeSpan{in.at[number], end} : Shown(workspace, item);
      auto [x0, x1] = Extent(span);
      if (dense && !selected) {
        x1 = std::max(scale_.XOf(span.end), x0 + 1.0f);
      }
      filled_to = std::max(filled_to, x1 - (dense ? 0.0f : Px(kLeastItem)));
      if (x1 < scale_.left) {
        continue;
      }
      ItemLook look;
      look.selected = selected;
      look.hovered = hit.item && *hit.item == item;
      look.open_end = in.length[number] <= 0.0;
      const float width = x1 - x0;
      const bool labelled = width > Px(24);
      DrawItem(draw, ImVec2(std::max(x0, scale_.left - Px(8)), y0), ImVec2(x1 - 1.0f, y1), colour,
               labelled ? FaceOf(workspace, item).label : std::string(), look);
      if (row.lane == LaneKind::kMarkers) {
        const std::string& name = FaceOf(workspace, item).label;
        draw.AddText(ImVec2(x1 + Px(3), y0 + Px(1)), Packed(Colours().text), name.c_str());
      }
      if (row.lane == LaneKind::kSpeech && labelled) {
        DrawVoiceOf(workspace, FaceOf(workspace, item).line, span.begin, ImVec2(x0, y0 + Px(19)),
                    ImVec2(x1 - 1.0f, y1), Packed(Colours().window, 0.75f), draw);
      }
    }
  }
}

void TimelinePanel::DrawBlocks(const app::Workspace& workspace,
                               const TimelineRow& row,
                               float top,
                               float height,
                               const Hit& hit,
                               ImDrawList& draw) {
  if (workspace.drama_run() == nullptr) {
    return;
  }
  const std::vector<TaskRecord>& tasks = workspace.drama_run()->tasks;
  const ImVec4 colour = LaneColour(row.lane);
  found_.clear();
  row.index.Query(scale_.first, scale_.last(), found_);
  for (const uint32_t number : found_) {
    const uint32_t block = row.blocks[number];
    const TaskRecord& task = tasks[block];
    const auto [x0, x1] = Extent({task.began, task.ended});
    ItemLook look;
    look.scripted = true;
    look.failed = task.failed && !task.expected;
    look.selected = block_ == block;
    look.hovered = hit.block == block;
    DrawItem(draw, ImVec2(std::max(x0, scale_.left - Px(8)), top + Px(3)),
             ImVec2(x1 - 1.0f, top + height - Px(3)), colour,
             x1 - x0 > Px(24) ? BlockLabel(task, row.of_object) : std::string(), look);
    if (row.lane == LaneKind::kSpeech && x1 - x0 > Px(24)) {
      DrawVoiceOf(workspace, BlockLabel(task, false), task.began, ImVec2(x0, top + Px(22)),
                  ImVec2(x1 - 1.0f, top + height - Px(3)), Packed(colour, 0.85f), draw);
    }
  }
}

void TimelinePanel::DrawGutter(const TimelineRow& row, const ImVec2& at, float width) const {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float text_y = at.y + 0.5f * (Px(kRow) - ImGui::GetTextLineHeight());
  const ImVec4 clip(at.x, at.y, at.x + width - Px(6), at.y + Px(kRow));
  const auto write = [&](float x, const ImVec4& colour, const std::string& text) {
    draw.AddText(nullptr, 0.0f, ImVec2(at.x + x, text_y), Packed(colour), text.c_str(), nullptr,
                 0.0f, &clip);
  };
  if (row.kind != TimelineRow::Kind::kHeading) {
    draw.AddRectFilled(ImVec2(at.x + Px(24), at.y + Px(7)),
                       ImVec2(at.x + Px(28), at.y + Px(kRow - 7)), Packed(LaneColour(row.lane)),
                       Px(1));
    const bool scripted = row.kind == TimelineRow::Kind::kBlocks;
    write(Px(36), Colours().dim,
          row.of_object ? Tr("used")
          : scripted    ? std::string(LaneTitle(row.lane)) + ", " + Tr("script")
                        : LaneTitle(row.lane));
    return;
  }
  const bool folded = folded_.contains((row.of_object ? "object " : "person ") + row.group);
  const ImVec2 c(at.x + Px(11), at.y + Px(0.5f * kRow));
  if (folded) {
    draw.AddTriangleFilled(ImVec2(c.x - Px(3), c.y - Px(5)), ImVec2(c.x - Px(3), c.y + Px(5)),
                           ImVec2(c.x + Px(4), c.y), Packed(Colours().dim));
  } else {
    draw.AddTriangleFilled(ImVec2(c.x - Px(5), c.y - Px(3)), ImVec2(c.x + Px(5), c.y - Px(3)),
                           ImVec2(c.x, c.y + Px(4)), Packed(Colours().dim));
  }
  write(Px(22), Colours().text, row.group.empty() ? Tr("Stage") : row.group);
}

void TimelinePanel::DrawRow(const app::Workspace& workspace,
                            const TimelineRow& row,
                            float top,
                            float height,
                            const Hit& hit,
                            ImDrawList& draw) {
  if (row.kind == TimelineRow::Kind::kHeading) {
    draw.AddRectFilled(ImVec2(scale_.left - Px(kGutter), top + Px(1)),
                       ImVec2(scale_.left + scale_.width, top + height - Px(1)),
                       Packed(Colours().frame, 0.45f));
    return;
  }
  draw.AddLine(ImVec2(scale_.left, top + height), ImVec2(scale_.left + scale_.width, top + height),
               Packed(Colours().line, 0.5f));
  draw.PushClipRect(ImVec2(scale_.left, top - 1), ImVec2(scale_.left + scale_.width, top + height),
                    true);
  if (row.kind == TimelineRow::Kind::kItems) {
    DrawItems(workspace, row, top, height, hit, draw);
  } else {
    DrawBlocks(workspace, row, top, height, hit, draw);
  }
  draw.PopClipRect();
}

void TimelinePanel::ShowRuler(app::Workspace& workspace, float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::Dummy(ImVec2(Px(kGutter), height));
  ImGui::SameLine(0.0f, 0.0f);
  scale_.left = at.x + Px(kGutter);
  scale_.width =
      std::max(ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize, Px(80));
  ImGui::InvisibleButton("ruler", ImVec2(scale_.width, height));
  if (ImGui::IsItemHovered()) {
    HandleWheel();
    if (!ImGui::IsItemActive()) {
      ImGui::SetTooltip("%s", Tr("Drag to go to another time. Ctrl and wheel: zoom."));
    }
  }
  if (ImGui::IsItemActive()) {
    workspace.SetPlaying(false);
    const RulerStep step = ChooseStep(scale_.seconds_per_px, Px(76));
    double time = std::max(scale_.TimeAt(ImGui::GetIO().MousePos.x), 0.0);
    if (ImGui::GetIO().KeyCtrl) {
      time = Snap(time, {}, step.seconds / step.parts, 1e9);
    }
    workspace.SetTime(time);
  }
  draw.PushClipRect(ImVec2(scale_.left, at.y), ImVec2(scale_.left + scale_.width, at.y + height),
                    true);
  DrawRuler(draw, scale_, at.y, height);
  if (drag_.snapped_to >= 0.0) {
    const float x = scale_.XOf(drag_.snapped_to);
    draw.AddLine(ImVec2(x, at.y), ImVec2(x, at.y + height), Packed(Colours().text, 0.8f), Px(1));
  }
  DrawPlayheadHandle(draw, scale_.XOf(workspace.time()), at.y, height);
  draw.PopClipRect();
}

void TimelinePanel::ShowRows(app::Workspace& workspace, EditorState& state) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::BeginChild("rows", ImVec2(0, 0), false,
                    ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_AlwaysVerticalScrollbar);
  ImGui::PopStyleVar();
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 view = ImGui::GetWindowPos();
  const ImVec2 view_size = ImGui::GetWindowSize();
  rows_view_ = view_size.y;
  const float height = tops_.back();
  ImGui::InvisibleButton("items",
                         ImVec2(Px(kGutter) + scale_.width, std::max(height, view_size.y - Px(2))),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered();
  HandleMouse(workspace, state, origin.y, hovered);
  const Hit hit = hovered && drag_.kind == Drag::Kind::kNone
                      ? HitAt(workspace, ImGui::GetIO().MousePos, origin.y)
                      : Hit();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(ImVec2(scale_.left, view.y),
                    ImVec2(scale_.left + scale_.width, view.y + view_size.y), true);
  DrawGrid(draw, scale_, view.y, view.y + view_size.y);
  const float end = scale_.XOf(workspace.duration());
  draw.AddRectFilled(ImVec2(std::max(end, scale_.left), view.y),
                     ImVec2(scale_.left + scale_.width, view.y + view_size.y),
                     Packed(Colours().window, 0.45f));
  draw.PopClipRect();
  for (size_t i = static_cast<size_t>(std::max(RowAt(view.y - origin.y), 0)); i < shown_.size();
       ++i) {
    const float top = origin.y + tops_[i];
    if (top > view.y + view_size.y) {
      break;
    }
    DrawRow(workspace, *shown_[i], top, tops_[i + 1] - tops_[i], hit, draw);
    DrawGutter(*shown_[i], ImVec2(view.x, top), Px(kGutter));
  }
  draw.PushClipRect(ImVec2(scale_.left, view.y),
                    ImVec2(scale_.left + scale_.width, view.y + view_size.y), true);
  if (drag_.snapped_to >= 0.0) {
    const float x = scale_.XOf(drag_.snapped_to);
    draw.AddLine(ImVec2(x, view.y), ImVec2(x, view.y + view_size.y), Packed(Colours().text, 0.8f),
                 Px(1));
  }
  if (drag_.kind == Drag::Kind::kBox && drag_.moved) {
    const ImVec2 a(scale_.XOf(drag_.from), origin.y + drag_.from_y);
    const ImVec2& b = ImGui::GetIO().MousePos;
    const ImVec2 from(std::min(a.x, b.x), std::min(a.y, b.y));
    const ImVec2 to(std::max(a.x, b.x), std::max(a.y, b.y));
    draw.AddRectFilled(from, to, Packed(Colours().accent, 0.15f));
    draw.AddRect(from, to, Packed(Colours().accent, 0.8f));
  }
  DrawPlayhead(draw, scale_.XOf(workspace.time()), view.y, view.y + view_size.y);
  draw.PopClipRect();
  if (shown_.empty() || (rows_.size() <= 1 && workspace.document().cast.empty())) {
    const char* text = Tr("Nobody is on the stage yet. Add a person in the list at the left.");
    draw.AddText(ImVec2(scale_.left + Px(24), view.y + Px(34)), Packed(Colours().dim), text);
  }
  if (std::exchange(open_context_, false)) {
    ImGui::OpenPopup("item menu");
  }
  if (std::exchange(open_add_, false)) {
    ImGui::OpenPopup("add menu");
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(Px(8), Px(7)));  // of menus
  ShowContextMenu(workspace, state);
  if (ImGui::BeginPopup("add menu")) {
    ShowAddMenu(workspace);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void TimelinePanel::ShowKindMenu(app::Workspace& workspace, const std::string& actor) {
  for (const drama::LaneName& lane : drama::kLaneNames) {
    if (lane.of_actor == !actor.empty() && ImGui::MenuItem(ItemTitle(lane.kind))) {
      Add(workspace, lane.kind, actor);
    }
  }
}

void TimelinePanel::ShowAddMenu(app::Workspace& workspace) {
  DimText(Text(Tr("At %s"), FormatTime(workspace.time(), 0.01).c_str()));
  for (const app::CastDocument& member : workspace.document().cast) {
    if (ImGui::BeginMenu(member.name.c_str())) {
      ShowKindMenu(workspace, member.name);
      ImGui::EndMenu();
    }
  }
  ImGui::Separator();
  ShowKindMenu(workspace, "");
}

void TimelinePanel::ShowContextMenu(app::Workspace& workspace, EditorState& state) {
  if (!ImGui::BeginPopup("item menu")) {
    return;
  }
  const bool any = !selection_.empty();
  if (context_.block) {
    if (ImGui::MenuItem(Tr("Go to the script"), Tr("Enter"))) {
      block_ = context_.block;
      selection_.clear();
      GoToScript(workspace, state);
    }
  } else if (context_.item) {
    if (ImGui::MenuItem(Tr("Cut"), "Ctrl+X", false, any)) {
      Copy(workspace);
      Delete(workspace);
    }
    if (ImGui::MenuItem(Tr("Copy"), "Ctrl+C", false, any)) {
      Copy(workspace);
    }
    if (ImGui::MenuItem(Tr("Duplicate"), "Ctrl+D", false, any)) {
      Duplicate(workspace);
    }
    if (ImGui::MenuItem(Tr("Delete"), TrIn("key", "Delete"), false, any)) {
      Delete(workspace);
    }
    ImGui::Separator();
    if (ImGui::MenuItem(Tr("Begin at the playhead"), "[", false, any)) {
      TrimToPlayhead(workspace, true);
    }
    if (ImGui::MenuItem(Tr("End at the playhead"), "]", false, any)) {
      TrimToPlayhead(workspace, false);
    }
    ImGui::Separator();
    if (ImGui::MenuItem(Tr("Go to the script"), Tr("Enter"))) {
      GoToScript(workspace, state);
    }
  } else {
    if (ImGui::MenuItem(Tr("Paste"), "Ctrl+V")) {
      Paste(workspace);
    }
    ImGui::Separator();
    const TimelineRow* row = context_.row >= 0 && context_.row < static_cast<int>(shown_.size())
                                 ? shown_[static_cast<size_t>(context_.row)]
                                 : nullptr;
    if (row != nullptr && !row->of_object) {
      DimText(row->group.empty() ? Tr("Stage") : row->group);
      ShowKindMenu(workspace, row->group);
    } else {
      ShowAddMenu(workspace);
    }
  }
  ImGui::EndPopup();
}

// ---- commands ----

void TimelinePanel::Add(app::Workspace& workspace, LaneKind kind, const std::string& actor) {
  ItemSet added;
  const double at = std::round(workspace.time() * 100.0) / 100.0;
  const bool done =
      workspace.EditTimeline(Text(Tr("add %s"), ItemTitle(kind)), [&](TimelineText& text) {
        return AddItem(text, kind, actor, NewFields(workspace, kind, actor, at), added);
      });
  if (done) {
    selection_ = added;
    block_.reset();
    folded_.erase("person " + actor);
  }
}

void TimelinePanel::Delete(app::Workspace& workspace) {
  if (selection_.empty()) {
    return;
  }
  const std::string name = NameOfSelection(workspace);
  const bool done = workspace.EditTimeline(
      Text(Tr("delete %s"), name.c_str()),
      [&](TimelineText& text) { return DeleteItems(text, selection_, ripple_); });
  if (done) {
    selection_.clear();
  }
}

void TimelinePanel::Copy(const app::Workspace& workspace) {
  if (!selection_.empty()) {
    ImGui::SetClipboardText(
        FormatCopied(CopyItems(*workspace.script().timeline(), selection_)).c_str());
  }
}

void TimelinePanel::Paste(app::Workspace& workspace) {
  const char* clipboard = ImGui::GetClipboardText();
  const auto items = clipboard != nullptr ? ParseCopied(clipboard) : std::nullopt;
  if (!items || items->empty()) {
    return;
  }
  ItemSet added;
  const bool done = workspace.EditTimeline(Tr("paste"), [&](TimelineText& text) {
    return PasteItems(text, *items, workspace.time(), added);
  });
  if (done) {
    selection_ = added;
  }
}

void TimelinePanel::Duplicate(app::Workspace& workspace) {
  if (selection_.empty()) {
    return;
  }
  const TimelineText& text = *workspace.script().timeline();
  double end = 0.0;
  for (const TimelineItem& item : selection_) {
    end = std::max(end, Shown(workspace, item).end);
  }
  const std::vector<CopiedItem> copied = CopyItems(text, selection_);
  const double at = std::max(end, SpanOf(text, selection_).begin + 0.5);
  ItemSet added;
  const bool done = workspace.EditTimeline(
      Text(Tr("duplicate %s"), NameOfSelection(workspace).c_str()),
      [&](TimelineText& changed) { return PasteItems(changed, copied, at, added); });
  if (done) {
    selection_ = added;
  }
}

void TimelinePanel::Nudge(app::Workspace& workspace, double seconds) {
  if (!selection_.empty()) {
    workspace.EditTimeline(
        Text(Tr("move %s"), NameOfSelection(workspace).c_str()),
        [&](TimelineText& text) { return MoveItems(text, selection_, seconds, ripple_); });
  }
}

void TimelinePanel::TrimToPlayhead(app::Workspace& workspace, bool begins) {
  if (selection_.empty()) {
    return;
  }
  const std::vector<double> naturals = Naturals(workspace);
  const TimeSpan span = Shown(workspace, selection_.front());
  const std::string name = Text(Tr("trim %s"), NameOfSelection(workspace).c_str());
  workspace.EditTimeline(name, [&](TimelineText& text) {
    return begins ? TrimBegins(text, selection_, naturals, workspace.time() - span.begin)
                  : TrimEnds(text, selection_, naturals, workspace.time() - span.end, ripple_);
  });
}

void TimelinePanel::SelectAll(const app::Workspace& workspace) {
  selection_.clear();
  block_.reset();
  const auto lanes = workspace.script().timeline()->lanes();
  for (size_t lane = 0; lane < lanes.size(); ++lane) {
    for (size_t item = 0; item < lanes[lane].size(); ++item) {
      selection_.push_back({lane, item});
    }
  }
}

// To the item so many further in time in its line, or in the next line that has any.
void TimelinePanel::StepSelection(const app::Workspace& workspace, int items, int rows) {
  const TimelineText& text = *workspace.script().timeline();
  struct Place {
    TimelineItem item;
    double at = 0.0;
  };
  std::vector<std::vector<Place>> lines;
  size_t line = 0;
  size_t place = 0;
  bool known = false;
  for (const TimelineRow* row : shown_) {
    std::vector<Place> places;
    for (const size_t lane : row->lanes) {
      for (size_t i = 0; i < text.lanes()[lane].size(); ++i) {
        places.push_back({{lane, i}, text.lanes()[lane].at[i]});
      }
    }
    if (places.empty()) {
      continue;
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.at < b.at; });
    for (size_t i = 0; i < places.size(); ++i) {
      if (!selection_.empty() && places[i].item == selection_.back()) {
        known = true;
        line = lines.size();
        place = i;
      }
    }
    lines.push_back(std::move(places));
  }
  if (lines.empty()) {
    return;
  }
  double at = workspace.time();
  if (known) {
    at = lines[line][place].at;
    line = static_cast<size_t>(
        std::clamp<int>(static_cast<int>(line) + rows, 0, static_cast<int>(lines.size()) - 1));
  }
  const std::vector<Place>& in = lines[line];
  if (known && rows == 0) {
    place = static_cast<size_t>(
        std::clamp<int>(static_cast<int>(place) + items, 0, static_cast<int>(in.size()) - 1));
  } else {
    place = static_cast<size_t>(std::min_element(in.begin(), in.end(),
                                                 [at](const Place& a, const Place& b) {
                                                   return std::abs(a.at - at) < std::abs(b.at - at);
                                                 }) -
                                in.begin());
  }
  selection_ = {in[place].item};
  block_.reset();
  ScrollTo(scale_, in[place].at);
}

// The playhead to the next beginning or end of anything.
void TimelinePanel::JumpToEdge(app::Workspace& workspace, int direction) {
  constexpr double kSame = 1e-3;
  const double now = workspace.time();
  double best = direction > 0 ? workspace.duration() : 0.0;
  const auto offer = [&](double time) {
    if (direction > 0 ? time > now + kSame && time < best : time < now - kSame && time > best) {
      best = time;
    }
  };
  if (const TimelineText* text = workspace.script().timeline()) {
    for (const TimelineLane& lane : text->lanes()) {
      for (size_t i = 0; i < lane.size(); ++i) {
        offer(lane.at[i]);
        offer(lane.at[i] + lane.length[i]);
      }
    }
  }
  if (const app::DramaRun* run = workspace.drama_run()) {
    for (const TaskRecord& task : run->tasks) {
      offer(task.began);
      offer(task.ended);
    }
  }
  workspace.SetPlaying(false);
  workspace.SetTime(best);
  ScrollTo(scale_, best);
}

void TimelinePanel::GoToScript(const app::Workspace& workspace, EditorState& state) {
  int line = 0;
  if (!selection_.empty() && workspace.script().timeline() != nullptr) {
    line = static_cast<int>(workspace.script().timeline()->LineOf(selection_.front()));
  } else if (block_ && workspace.drama_run() != nullptr) {
    line = LineOfPlace(workspace.drama_run()->tasks[*block_].where,
                       workspace.paths().Drama().filename().string());
  }
  if (line > 0) {
    state.script_line = line;
    state.bottom = BottomTab::kScript;
  }
}

bool TimelinePanel::HandleSelectionKey(app::Workspace& workspace, KeyAction action) {
  switch (action) {
    case KeyAction::kSelectAll:
      SelectAll(workspace);
      return true;
    case KeyAction::kSelectNone:
      drag_ = {};
      selection_.clear();
      block_.reset();
      return true;
    case KeyAction::kSelectBefore:
      StepSelection(workspace, -1, 0);
      return true;
    case KeyAction::kSelectAfter:
      StepSelection(workspace, 1, 0);
      return true;
    case KeyAction::kSelectAbove:
      StepSelection(workspace, 0, -1);
      return true;
    case KeyAction::kSelectBelow:
      StepSelection(workspace, 0, 1);
      return true;
    default:
      return false;
  }
}

bool TimelinePanel::HandleTimeKey(app::Workspace& workspace, KeyAction action, bool shift) {
  const auto go = [&](double time) {
    workspace.SetPlaying(false);
    workspace.SetTime(std::clamp(time, 0.0, std::max(workspace.duration(), workspace.time())));
    ScrollTo(scale_, workspace.time());
  };
  switch (action) {
    case KeyAction::kBack:
      go(workspace.time() - (shift ? 1.0 : kFrame));
      return true;
    case KeyAction::kOn:
      go(workspace.time() + (shift ? 1.0 : kFrame));
      return true;
    case KeyAction::kBegin:
      go(0.0);
      return true;
    case KeyAction::kEnd:
      go(workspace.duration());
      return true;
    case KeyAction::kEdgeBack:
      JumpToEdge(workspace, -1);
      return true;
    case KeyAction::kEdgeOn:
      JumpToEdge(workspace, 1);
      return true;
    case KeyAction::kNearer:
      Zoom(scale_, 0.8, scale_.XOf(workspace.time()));
      return true;
    case KeyAction::kFurther:
      Zoom(scale_, 1.25, scale_.XOf(workspace.time()));
      return true;
    case KeyAction::kFit:
      ZoomToFit(scale_, workspace.duration());
      return true;
    default:
      return false;
  }
}

bool TimelinePanel::HandleEditKey(app::Workspace& workspace,
                                  EditorState& state,
                                  KeyAction action,
                                  bool shift) {
  switch (action) {
    case KeyAction::kAdd:
      open_add_ = true;
      return true;
    case KeyAction::kMarker:
      Add(workspace, LaneKind::kMarkers, "");
      return true;
    case KeyAction::kSnap:
      snap_ = !snap_;
      return true;
    case KeyAction::kRipple:
      ripple_ = !ripple_;
      return true;
    case KeyAction::kTrimBegin:
      TrimToPlayhead(workspace, true);
      return true;
    case KeyAction::kTrimEnd:
      TrimToPlayhead(workspace, false);
      return true;
    case KeyAction::kItemBack:
      Nudge(workspace, shift ? -1.0 : -kNudge);
      return true;
    case KeyAction::kItemOn:
      Nudge(workspace, shift ? 1.0 : kNudge);
      return true;
    case KeyAction::kCut:
      Copy(workspace);
      Delete(workspace);
      return true;
    case KeyAction::kCopy:
      Copy(workspace);
      return true;
    case KeyAction::kPaste:
      Paste(workspace);
      return true;
    case KeyAction::kDuplicate:
      Duplicate(workspace);
      return true;
    case KeyAction::kDelete:
      Delete(workspace);
      return true;
    case KeyAction::kGoToScript:
      GoToScript(workspace, state);
      return true;
    default:
      return false;
  }
}

void TimelinePanel::HandleKeys(app::Workspace& workspace, EditorState& state) {
  if (state.focus != Focus::kTimeline || state.bottom != BottomTab::kTimeline ||
      state.dialog != Dialog::kNone || ImGui::GetIO().WantTextInput ||
      workspace.script().timeline() == nullptr) {
    return;
  }
  Refresh(workspace);
  std::erase_if(state.keys, [&](const KeyPress& press) {
    const KeyAction action = ActionOf(KeyScope::kTimeline, press);
    const bool shift = (press.modifiers & GLFW_MOD_SHIFT) != 0;
    return HandleTimeKey(workspace, action, shift) || HandleSelectionKey(workspace, action) ||
           HandleEditKey(workspace, state, action, shift);
  });
}

// ---- the panel ----

void TimelinePanel::ShowTools(app::Workspace& workspace, EditorState& state) {
  const auto tip = [](const std::string& text) {
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("%s", text.c_str());
    }
  };
  if (ImGui::Button(workspace.playing() ? Tr("Pause") : Tr("Play"),
                    ImVec2(WidestButton(std::array{Tr("Pause"), Tr("Play")}, 70.0f), 0))) {
    workspace.SetPlaying(!workspace.playing());
  }
  tip(WithKey(Tr("Plays the drama"), KeyAction::kPlay));
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(FormatTime(workspace.time(), 0.01).c_str());
  ImGui::SameLine(0.0f, Px(4));
  DimText("/ " + FormatTime(workspace.duration(), 1.0));
  ImGui::SameLine(0.0f, Px(16));
  ImGui::BeginDisabled(workspace.script().timeline() == nullptr);
  if (ImGui::Button(Tr("Add"))) {
    open_add_ = true;
    state.focus = Focus::kTimeline;
  }
  tip(WithKey(Tr("Adds an item at the playhead"), KeyAction::kAdd));
  ImGui::EndDisabled();
  if (FitsBeside(std::array{Tr("Snap"), Tr("Ripple"), Tr("Fit"), "   "})) {
    ShowSwitches(workspace);
  } else {
    ShowSwitchMenu(workspace);
  }
}

void TimelinePanel::ShowSwitches(const app::Workspace& workspace) {
  ImGui::SameLine();
  ToggleButton(Tr("Snap"), snap_,
               WithKey(Tr("Items are drawn to others, to the playhead and to the grid; not while "
                          "Alt is held"),
                       KeyAction::kSnap));
  ImGui::SameLine();
  ToggleButton(Tr("Ripple"), ripple_,
               WithKey(Tr("What comes later moves along"), KeyAction::kRipple));
  ImGui::SameLine();
  if (ImGui::Button(Tr("Fit"))) {
    ZoomToFit(scale_, workspace.duration());
  }
  if (ImGui::IsItemHovered()) {
    const char* does = Tr("Shows all of the drama; Ctrl and the wheel zoom");
    ImGui::SetTooltip("%s", WithKey(does, KeyAction::kFit).c_str());
  }
}

void TimelinePanel::ShowSwitchMenu(const app::Workspace& workspace) {
  ImGui::SameLine();
  if (ImGui::Button("\xe2\x80\xa6")) {
    ImGui::OpenPopup("switches");
  }
  if (ImGui::BeginPopup("switches")) {
    ImGui::MenuItem(Tr("Snap"), KeyText(KeyAction::kSnap).c_str(), &snap_);
    ImGui::MenuItem(Tr("Ripple"), KeyText(KeyAction::kRipple).c_str(), &ripple_);
    if (ImGui::MenuItem(Tr("Fit"), KeyText(KeyAction::kFit).c_str())) {
      ZoomToFit(scale_, workspace.duration());
    }
    ImGui::EndPopup();
  }
}

void TimelinePanel::Show(app::Workspace& workspace, EditorState& state) {
  Refresh(workspace);
  const ImVec2 available = ImGui::GetContentRegionAvail();
  const float inspector = std::min(Px(kInspector), 0.4f * available.x);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::BeginChild("canvas", ImVec2(available.x - inspector - Px(12), available.y), false,
                    ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoScrollbar);
  if (!fitted_ && workspace.duration() > 0.0 && scale_.width > 0.0f) {
    fitted_ = true;
    ZoomToFit(scale_, std::min(workspace.duration(), 120.0));
  }
  if (workspace.playing() && drag_.kind == Drag::Kind::kNone) {
    ScrollTo(scale_, workspace.time());
  }
  ShowRuler(workspace, Px(kRuler));
  ShowRows(workspace, state);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::SameLine(0.0f, Px(12));
  ImGui::BeginChild("item", ImVec2(0, available.y));
  ShowTimelineInspector(workspace, state, selection_, block_);
  ImGui::EndChild();
}

}  // namespace lararium::panels
