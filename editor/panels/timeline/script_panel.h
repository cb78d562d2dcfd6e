#pragma once

// The text of drama.lua with syntax colours, line numbers, and the problems of each line.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/panels/timeline/lua_colours.h"
#include "editor/panels/widgets/input.h"
#include "editor/session/workspace.h"
#include "shared/core/sentence.h"

namespace lararium::panels {

class ScriptPanel {
 public:
  void DrawTools(editor::Workspace& workspace);
  // Moves the cursor to a line, from 1, when the panel is shown next.
  void GoToLine(int line) { asked_line_ = line; }
  void Show(editor::Workspace& workspace, Input& input);

 private:
  void Refresh(editor::Workspace& workspace);
  void CollectProblems(const editor::Workspace& workspace);
  void DrawField(editor::Workspace& workspace, Input& input);
  void DrawText(const struct FieldView& view);
  void DrawGutter(const struct FieldView& view);
  void EndTyping(editor::Workspace& workspace);
  size_t LineAt(size_t offset) const;

  std::string buffer_;                      // The content of the field.
  int64_t revision_ = -1;                   // Revision of the script that buffer_ was taken from.
  std::optional<drama::TextEdit> outside_;  // The last change that was not made by typing.
  int64_t problems_of_ = -1;                // Number of the dry run that problems_ belong to.
  size_t problem_count_ = 0;
  std::vector<size_t> lines_;                      // The beginning of each line.
  std::vector<ColouredWord> words_;                // Syntax of buffer_.
  std::map<int, std::vector<Sentence>> problems_;  // Keyed by line number, from 1.
  size_t cursor_ = 0;                              // Bytes.
  size_t typed_line_ = 0;
  double since_typed_ = 0.0;  // Seconds.
  bool typing_ = false;
  int64_t go_to_ = -1;  // Byte to which the cursor moves next.
  int asked_line_ = 0;  // See GoToLine(); 0: none.
  bool focus_field_ = false;
};

}  // namespace lararium::panels
