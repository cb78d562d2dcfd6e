#include "editor/document/script_document.h"

#include <utility>

namespace lararium::editor {

using drama::TextEdit;
using drama::TimelineText;

ScriptDocument::ScriptDocument(std::string text, std::string where) : place_(std::move(where)) {
  Set(std::move(text));
}

void ScriptDocument::Set(std::string text) {
  text_ = std::make_shared<const std::string>(text);
  ++revision_;
  Result<TimelineText> timeline = TimelineText::Read(std::move(text), place_);
  problem_ = timeline.status();
  timeline_.reset();
  duration_ = 0.0;
  if (timeline.ok()) {
    timeline_ = *std::move(timeline);
    duration_ = timeline_->Duration();
  }
}

void ScriptDocument::Set(TimelineText timeline) {
  text_ = std::make_shared<const std::string>(timeline.text());
  timeline_ = std::move(timeline);
  duration_ = timeline_->Duration();
  problem_ = Status();
  ++revision_;
}

Result<TextEdit> ScriptDocument::Change(const std::function<Status(TimelineText&)>& change) {
  LARARIUM_RETURN_IF_ERROR(problem_);
  TimelineText changed = *timeline_;
  LARARIUM_RETURN_IF_ERROR(change(changed));
  TextEdit edit = drama::Difference(*text_, changed.text());
  Set(std::move(changed));
  return edit;
}

TextEdit ScriptDocument::Replace(std::string text) {
  TextEdit edit = drama::Difference(*text_, text);
  Set(std::move(text));
  return edit;
}

Status ScriptDocument::Apply(const TextEdit& edit) {
  if (edit.offset > text_->size() ||
      text_->compare(edit.offset, edit.removed.size(), edit.removed) != 0) {
    return Status::Error(place_, "has changed since this edit was made");
  }
  std::string text = *text_;
  text.replace(edit.offset, edit.removed.size(), edit.inserted);
  Set(std::move(text));
  return Status();
}

}  // namespace lararium::editor
