#include "editor/document/script_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

using drama::TimelineText;
using testing::HasSubstr;

constexpr const char* kScript = "track{markers = {\n  {at = 1, name = \"a\"},\n}}\n";

TEST(ScriptDocument, AChangeOfTheTimelineIsOneEditOfTheText) {
  ScriptDocument script(kScript, "drama.lua");
  const int64_t before = script.revision();
  const auto edit = script.Change([](TimelineText& text) {
    LARARIUM_RETURN_IF_ERROR(text.Set({0, 0}, "at", 2.5).status());
    return text.Insert(0, {{"at", 4.0}, {"name", "b"}}).status();
  });
  ASSERT_TRUE(edit.ok());
  EXPECT_NE(script.revision(), before);
  EXPECT_THAT(script.text(), HasSubstr("{at = 2.5, name = \"a\"}"));
  EXPECT_EQ(script.timeline()->lanes()[0].size(), 2u);
  EXPECT_EQ(script.duration(), 4.0);
  ASSERT_TRUE(script.Apply(edit->Reverse()).ok());
  EXPECT_EQ(script.text(), kScript);
}

TEST(ScriptDocument, AChangeThatFailsLeavesAllAsItWas) {
  ScriptDocument script(kScript, "drama.lua");
  const int64_t before = script.revision();
  EXPECT_FALSE(script
                   .Change([](TimelineText& text) {
                     LARARIUM_RETURN_IF_ERROR(text.Set({0, 0}, "at", 2.0).status());
                     return text.Set({0, 0}, "at", -1.0).status();
                   })
                   .ok());
  EXPECT_EQ(script.text(), kScript);
  EXPECT_EQ(script.revision(), before);
}

TEST(ScriptDocument, ATextThatCannotBeReadIsKeptAndSaysWhy) {
  ScriptDocument script("local a = \"no end", "drama.lua");
  EXPECT_EQ(script.timeline(), nullptr);
  EXPECT_THAT(script.problem().message(), HasSubstr("drama.lua:1:"));
  EXPECT_FALSE(script.Change([](TimelineText&) { return Status(); }).ok());
  const drama::TextEdit edit = script.Replace(kScript);
  EXPECT_NE(script.timeline(), nullptr);
  ASSERT_TRUE(script.Apply(edit.Reverse()).ok());
  EXPECT_EQ(script.timeline(), nullptr);
}

TEST(ScriptDocument, AnEditOfAnotherTextIsRefused) {
  ScriptDocument script(kScript, "drama.lua");
  EXPECT_FALSE(script.Apply({2, "zzz", "y"}).ok());
  EXPECT_FALSE(script.Apply({999, "", "y"}).ok());
  EXPECT_EQ(script.text(), kScript);
}

}  // namespace
}  // namespace lararium::editor
