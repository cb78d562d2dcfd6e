#include "editor/panels/timeline/timeline_commands.h"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "editor/panels/widgets/text.h"

namespace lararium::panels {

using drama::TimelineItem;
using drama::TimelineText;

namespace {

std::vector<double> NaturalsOf(const editor::Workspace& workspace,
                               const TimelineSelection& selection,
                               TimelineItems& items) {
  std::vector<double> naturals;
  for (const TimelineItem& item : selection.items()) {
    naturals.push_back(std::max(items.FaceOf(workspace, item).natural, editor::kShortest));
  }
  return naturals;
}

std::string NameOfSelected(const editor::Workspace& workspace,
                           const TimelineSelection& selection,
                           TimelineItems& items) {
  if (selection.items().size() == 1) {
    const std::string& label = items.FaceOf(workspace, selection.items().front()).label;
    return label.empty() ? Tr("an item") : label;
  }
  return TrCount("%d item", "%d items", static_cast<int>(selection.items().size()));
}

}  // namespace

void DeleteSelected(editor::Workspace& workspace,
                    TimelineSelection& selection,
                    TimelineItems& items,
                    bool ripple) {
  if (!selection.HasItems()) {
    return;
  }
  const std::string name = NameOfSelected(workspace, selection, items);
  const bool done = workspace.project().EditTimeline(
      Sentence("delete %s", {name}),
      [&](TimelineText& text) { return editor::DeleteItems(text, selection.items(), ripple); });
  if (done) {
    selection.ClearItems();
  }
}

void CopySelected(const editor::Workspace& workspace, const TimelineSelection& selection) {
  if (selection.HasItems()) {
    ImGui::SetClipboardText(
        editor::FormatCopied(
            editor::CopyItems(*workspace.project().script().timeline(), selection.items()))
            .c_str());
  }
}

void PasteCopied(editor::Workspace& workspace, TimelineSelection& selection) {
  const char* clipboard = ImGui::GetClipboardText();
  const auto copied = clipboard != nullptr ? editor::ParseCopied(clipboard) : std::nullopt;
  if (!copied || copied->empty()) {
    return;
  }
  editor::ItemSet added;
  const bool done = workspace.project().EditTimeline(Sentence("paste"), [&](TimelineText& text) {
    return editor::PasteItems(text, *copied, workspace.playback().time(), added);
  });
  if (done) {
    selection.SetItems(added);
  }
}

void DuplicateSelected(editor::Workspace& workspace,
                       TimelineSelection& selection,
                       TimelineItems& items) {
  if (!selection.HasItems()) {
    return;
  }
  const TimelineText& text = *workspace.project().script().timeline();
  double end = 0.0;
  for (const TimelineItem& item : selection.items()) {
    end = std::max(end, items.SpanOf(workspace, item).end);
  }
  const std::vector<editor::CopiedItem> copied = editor::CopyItems(text, selection.items());
  const double at = std::max(end, editor::SpanOf(text, selection.items()).begin + 0.5);
  editor::ItemSet added;
  const bool done = workspace.project().EditTimeline(
      Sentence("duplicate %s", {NameOfSelected(workspace, selection, items)}),
      [&](TimelineText& changed) { return editor::PasteItems(changed, copied, at, added); });
  if (done) {
    selection.SetItems(added);
  }
}

void ShiftSelected(editor::Workspace& workspace,
                   const TimelineSelection& selection,
                   TimelineItems& items,
                   double seconds,
                   bool ripple) {
  if (selection.HasItems()) {
    workspace.project().EditTimeline(
        Sentence("move %s", {NameOfSelected(workspace, selection, items)}),
        [&](TimelineText& text) {
          return editor::MoveItems(text, selection.items(), seconds, ripple);
        });
  }
}

void TrimSelected(editor::Workspace& workspace,
                  const TimelineSelection& selection,
                  TimelineItems& items,
                  bool begins,
                  double seconds,
                  bool ripple) {
  const std::vector<double> naturals = NaturalsOf(workspace, selection, items);
  workspace.project().EditTimeline(
      Sentence("trim %s", {NameOfSelected(workspace, selection, items)}), [&](TimelineText& text) {
        return begins ? editor::TrimBegins(text, selection.items(), naturals, seconds)
                      : editor::TrimEnds(text, selection.items(), naturals, seconds, ripple);
      });
}

void TrimToPlayhead(editor::Workspace& workspace,
                    const TimelineSelection& selection,
                    TimelineItems& items,
                    bool begins,
                    bool ripple) {
  if (selection.HasItems()) {
    const editor::TimeSpan span = items.SpanOf(workspace, selection.items().front());
    TrimSelected(workspace, selection, items, begins,
                 workspace.playback().time() - (begins ? span.begin : span.end), ripple);
  }
}

}  // namespace lararium::panels
