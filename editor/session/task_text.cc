#include "editor/session/task_text.h"

#include "editor/text/text.h"
#include "shared/core/lower_case.h"

namespace lararium::editor {

std::string TaskText(TaskKind kind, const BackgroundTask::State& state) {
  const char* name = TaskName(kind);
  std::string text = Tr(name);
  // A task with only one step has the step's name.
  if (!state.step.empty() && state.step != LowerCase(name)) {
    text += std::string(": ") + Tr(state.step.c_str());
  }
  if (state.count > 0) {
    text += " " + Text(Tr("(%d of %d)"), state.number, state.count);
  }
  if (const auto left = EstimateSecondsLeft(state.fraction, state.seconds)) {
    text += ", " + Text(Tr("%s left"), FormatDuration(*left).c_str());
  }
  return text;
}

}  // namespace lararium::editor
