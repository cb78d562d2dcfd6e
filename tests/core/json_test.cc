#include "shared/core/json.h"

#include <gtest/gtest.h>

#include "tests/support/test_files.h"

namespace lararium {
namespace {

TEST(Json, SyntaxErrorsNameThePlace) {
  const Result<Json> json = ParseJson("{\"a\": 1,}", "x.json");
  ASSERT_FALSE(json.ok());
  EXPECT_EQ(json.message().rfind("x.json: not valid JSON: ", 0), 0u) << json.message();
  EXPECT_NE(json.message().find("line 1"), std::string::npos) << json.message();
}

TEST(Json, DeepNestingIsAnErrorOrAValueNeverACrash) {
  const std::string open(100'000, '[');
  EXPECT_FALSE(ParseJson(open, "deep").ok());
}

TEST(Json, SavesWithSortedKeys) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(SaveJson(folder / "a.json", {{"b", 1}, {"a", 2}}).ok());
  EXPECT_EQ(LoadJson(folder / "a.json").value().dump(), "{\"a\":2,\"b\":1}");
}

TEST(Json, KeepsStringsThatAreNoUtf8) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"caf\xe9.mp4", "\xff\xfe", "caf\xc3\xa9", "\xee\xbe\x80 private",
                                 "cut \xe2\x82", "plain"}) {
    ASSERT_TRUE(SaveJson(folder / "a.json", {{"file", name}, {name, {name, 1}}}).ok());
    const Json read = LoadJson(folder / "a.json").value();
    EXPECT_EQ(read.at("file"), name);
    EXPECT_EQ(read.at(name).at(0), name);
    // Programs that write ASCII only keep the name as well.
    const std::string ascii = Json::parse(DumpJson(read)).dump(-1, ' ', true);
    EXPECT_EQ(ParseJson(ascii, "ascii").value(), read);
  }
}

TEST(JsonView, ErrorsNameTheField) {
  const Json json = {{"stage", {{"scale", "big"}, {"axes", {1, 2}}}}};
  const JsonView view(json, "p.json");
  const JsonView stage = view.Field("stage").value();
  EXPECT_EQ(stage.Number("scale").message(), "p.json: stage.scale: must be a finite number");
  EXPECT_EQ(stage.Number("none").message(), "p.json: stage: the field \"none\" is missing");
  EXPECT_EQ(stage.Numbers("axes", 3).message(), "p.json: stage.axes: must be a list of 3 numbers");
}

TEST(JsonView, TheFileMayHaveAnyName) {
  const Json json = {{"stage", {{"scale", "big"}}}};
  for (const std::string file : {"A place: one.json", "a: b", "Chapel", "x.json"}) {
    const JsonView stage = JsonView(json, file).Field("stage").value();
    EXPECT_EQ(stage.place(), file + ": stage");
    EXPECT_EQ(stage.Number("scale").message(), file + ": stage.scale: must be a finite number");
  }
}

TEST(JsonView, ElementsOfAListCarryTheirIndex) {
  const Json json = {{{"name", 1}}, {{"sizes", {1, "x"}}}};
  const std::vector<JsonView> list = JsonView(json, "p.json").Array().value();
  EXPECT_EQ(list[0].Text("name").message(), "p.json[0]: name: must be a text");
  EXPECT_EQ(list[1].Numbers("sizes", 2).message(), "p.json[1]: sizes[1]: must be a finite number");
}

TEST(JsonView, ChecksRanges) {
  const Json json = {{"n", 5}, {"big", 1e300}, {"huge", 18446744073709551615ULL}, {"t", "abc"}};
  const JsonView view(json, "p.json");
  EXPECT_EQ(view.Integer("n", 0, 5).value(), 5);
  EXPECT_FALSE(view.Integer("n", 0, 4).ok());
  EXPECT_FALSE(view.Integer("big", 0, 4).ok());
  EXPECT_FALSE(view.Integer("huge", 0, 4).ok());
  EXPECT_FALSE(view.Number("big", 0, 1).ok());
  EXPECT_FALSE(view.Text("t", 2).ok());
  EXPECT_EQ(view.Text("t", 3).value(), "abc");
}

}  // namespace
}  // namespace lararium
