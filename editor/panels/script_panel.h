#pragma once

// The drama as it is written: drama.lua with its words coloured, line numbers, and what is
// wrong with a line beside it.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/lua_colours.h"
#include "shared/core/sentence.h"

namespace lararium::panels {

class ScriptPanel {
 public:
  void ShowTools(app::Workspace& workspace, EditorState& state);
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  void Refresh(app::Workspace& workspace);
  void CollectProblems(const app::Workspace& workspace);
  void ShowField(app::Workspace& workspace, EditorState& state);
  void DrawText(const struct FieldView& view);
  void DrawGutter(const struct FieldView& view);
  void EndTyping(app::Workspace& workspace);
  size_t LineAt(size_t offset) const;

  std::string buffer_;                      // what the field holds
  int64_t revision_ = -1;                   // of the script that it was taken from
  std::optional<drama::TextEdit> outside_;  // what made it of the text before, not by typing
  int64_t problems_of_ = -1;                // run and revision that problems_ are of
  size_t problem_count_ = 0;
  std::vector<size_t> lines_;                      // where each begins
  std::vector<ColouredWord> words_;                // of buffer_
  std::map<int, std::vector<Sentence>> problems_;  // by line, from 1
  size_t cursor_ = 0;                              // bytes
  size_t typed_line_ = 0;
  double since_typed_ = 0.0;  // seconds
  bool typing_ = false;
  int64_t go_to_ = -1;  // byte that the cursor is to go to
  bool focus_field_ = false;
};

}  // namespace lararium::panels
