#include "editor/document/line_edits.h"

#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

TEST(LineEdits, ATextAddsTheLineAndTheLanguageThatItNeeds) {
  const bake::LineTable table = WithText({}, "hail", "keeper", "la", "Salvete!");
  ASSERT_EQ(table.lines.size(), 1u);
  EXPECT_EQ(table.languages, std::vector<std::string>{"la"});
  EXPECT_EQ(table.lines[0].speaker, "keeper");
  EXPECT_EQ(table.lines[0].text.at("la"), "Salvete!");
}

TEST(LineEdits, AnEmptyTextIsTakenAwayAndTheLineStays) {
  bake::LineTable table = WithText({}, "hail", "keeper", "la", "Salvete!");
  table = WithText(table, "hail", "girl", "la", "");
  ASSERT_EQ(table.lines.size(), 1u);
  EXPECT_TRUE(table.lines[0].text.empty());
  EXPECT_EQ(table.lines[0].speaker, "keeper") << "whose line it is";
}

TEST(LineEdits, WhatWasWrittenIsReadAgain) {
  bake::LineTable table = WithText({}, "hail", "keeper", "la", "\"Salvēte\", hospitēs;\nquid?");
  table = WithText(table, "hail", "keeper", "it", "Salve");
  table = WithLine(table, "later", "girl");
  const Result<bake::LineTable> again = bake::ParseLinesCsv(bake::FormatLinesCsv(table), "lines");
  ASSERT_TRUE(again.ok()) << again.message();
  EXPECT_EQ(*again, table);
}

TEST(LineEdits, AFreeIdIsNobodysYet) {
  bake::LineTable table;
  EXPECT_EQ(FreeLineId(table, "keeper"), "keeper1");
  table = WithLine(table, "keeper1", "keeper");
  EXPECT_EQ(FreeLineId(table, "keeper"), "keeper2");
  EXPECT_EQ(WithLine(table, "keeper1", "girl"), table) << "a line is added once";
}

}  // namespace
}  // namespace lararium::editor
