#pragma once

// The drama's text while it is edited: what is written, and what of it the timeline
// shows.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::app {

class ScriptDocument {
 public:
  // place: what messages call the text.
  ScriptDocument(std::string text, std::string place);

  const std::string& text() const { return *text_; }
  // The same to be kept.
  std::shared_ptr<const std::string> snapshot() const { return text_; }
  // nullptr where the text cannot be read, which problem() says.
  const drama::TimelineText* timeline() const { return timeline_ ? &*timeline_ : nullptr; }
  const Status& problem() const { return problem_; }
  // When the last item of the timeline ends, seconds.
  double duration() const { return duration_; }
  // Another number after each change.
  int64_t revision() const { return revision_; }

  // Changes the timeline as one edit: all of it, or nothing where that fails.
  Result<drama::TextEdit> Change(const std::function<Status(drama::TimelineText&)>& change);
  // Any other text.
  drama::TextEdit Replace(std::string text);
  // Such as the reverse of an edit before. Fails where the text is not as it was then.
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

}  // namespace lararium::app
