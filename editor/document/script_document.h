#pragma once

// The drama's text while it is edited, and the timeline that it contains.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::editor {

class ScriptDocument {
 public:
  // where: the name of the text in messages.
  ScriptDocument(std::string text, std::string where);

  const std::string& text() const { return *text_; }
  // The text, shared: it stays valid after later changes.
  std::shared_ptr<const std::string> snapshot() const { return text_; }
  // nullptr where the text cannot be parsed; problem() gives the reason.
  const drama::TimelineText* timeline() const { return timeline_ ? &*timeline_ : nullptr; }
  const Status& problem() const { return problem_; }
  // The end of the last item of the timeline, seconds.
  double duration() const { return duration_; }
  // Changes with each edit.
  int64_t revision() const { return revision_; }

  // Changes the timeline as one edit. On an error nothing changes.
  Result<drama::TextEdit> Change(const std::function<Status(drama::TimelineText&)>& change);
  // Replaces the whole text; the edit covers only the part that differs.
  drama::TextEdit Replace(std::string text);
  // Applies an edit, for example the reverse of an earlier one. Fails where the text does not match
  // the edit.
  Status Apply(const drama::TextEdit& edit);

 private:
  void Set(std::string text);
  void Set(drama::TimelineText timeline);

  std::string place_;
  std::shared_ptr<const std::string> text_;
  std::optional<drama::TimelineText> timeline_;
  Status problem_;
  double duration_ = 0.0;
  int64_t revision_ = 0;
};

}  // namespace lararium::editor
