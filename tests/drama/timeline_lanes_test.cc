#include "shared/drama/timeline_lanes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/drama/timeline_text.h"
#include "tests/drama/drama_fixture.h"

namespace lararium::drama {
namespace {

using testing::IsEmpty;
using testing::Not;

class EveryLane : public DramaTest, public testing::WithParamInterface<LaneSpec> {
 protected:
  const LaneSpec& lane_ = GetParam();
};

Json SampleOf(const LaneField& field) {
  switch (field.type) {
    case FieldType::kText:
      return field.choices.empty() ? Json("sample") : Json(field.choices.back());
    case FieldType::kNumber:
      return field.most;
    case FieldType::kYesNo:
      return true;
    case FieldType::kColour:
      return Json::array({1.0, 0.5, 0.25});
    case FieldType::kPoint:
      break;
  }
  return {{"x", 1.0}, {"z", -2.0}};
}

TEST_P(EveryLane, HasASpecWhoseFieldsTheReaderAccepts) {
  EXPECT_EQ(&SpecOf(lane_.kind) - LaneSpecs().data(), static_cast<ptrdiff_t>(lane_.kind));
  EXPECT_EQ(SpecOf(lane_.kind).name, lane_.name);
  EXPECT_EQ(LaneNamed(lane_.name), lane_.kind);
  Json item = Json::object();
  for (const auto fields : {ItemFields(), std::span<const LaneField>(lane_.fields)}) {
    for (const LaneField& field : fields) {
      EXPECT_FALSE(item.contains(field.key)) << field.key << " is stated twice";
      item[field.key] = SampleOf(field);
    }
  }
  const auto text = TimelineText::Read(
      "track{actor = 'keeper', " + std::string(lane_.name) + " = {" + LuaLiteral(item) + "}}",
      "drama.lua");
  ASSERT_TRUE(text.ok()) << text.message();
  EXPECT_THAT(text->problems(), IsEmpty());
  ASSERT_EQ(text->lanes().size(), 1u);
  EXPECT_EQ(text->lanes()[0].kind, lane_.kind);
  for (const TimelineField& field : text->Fields({0, 0})) {
    EXPECT_EQ(field.value, item[field.key]) << field.key;
  }
}

TEST(TimelineLanes, OnlyStandingUpNeedsNoObject) {
  const LaneSpec& uses = SpecOf(LaneKind::kUses);
  EXPECT_THAT(RequiredFields(uses, Json{{"action", "stand"}}), IsEmpty());
  EXPECT_EQ(RequiredFields(uses, Json{{"action", "sit"}}), std::vector<std::string_view>{"object"});
  EXPECT_EQ(RequiredFields(uses, Json::object()), std::vector<std::string_view>{"object"});
}

TEST_P(EveryLane, StatesFieldsAndValuesThatExist) {
  EXPECT_NE(FindField(lane_, lane_.content), nullptr);
  for (const std::string_view key : RequiredFields(lane_, Json::object())) {
    EXPECT_NE(FindField(lane_, key), nullptr) << key;
  }
  for (const std::string_view key : lane_.label) {
    EXPECT_NE(FindField(lane_, key), nullptr) << key;
  }
  for (const LaneField& field : lane_.fields) {
    EXPECT_EQ(ProblemOf(field, SampleOf(field)), "") << field.key;
    EXPECT_THAT(ProblemOf(field, Json::array()), Not(IsEmpty())) << field.key;
    if (!field.initial.is_null()) {
      EXPECT_EQ(ProblemOf(field, field.initial), "") << field.key;
    }
    if (field.type == FieldType::kNumber && field.missing == nullptr) {
      EXPECT_EQ(ProblemOf(field, field.fallback), "") << field.key;
    }
    EXPECT_TRUE(field.unless == nullptr || FindField(lane_, field.unless) != nullptr);
  }
}

TEST_P(EveryLane, IsKnownToTrack) {
  const auto drama =
      Make("track{actor = 'keeper', " + std::string(lane_.name) + " = {}}\nfunction main() end");
  ASSERT_NE(drama, nullptr);
  EXPECT_EQ(FirstError(*drama), "");
}

INSTANTIATE_TEST_SUITE_P(Of,
                         EveryLane,
                         testing::ValuesIn(LaneSpecs().begin(), LaneSpecs().end()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(LaneOfTask, IsTheLaneWhoseItemsActLikeThat) {
  EXPECT_EQ(LaneOfTask("say salvete"), LaneKind::kSpeech);
  EXPECT_EQ(LaneOfTask("walk_to"), LaneKind::kWalks);
  EXPECT_EQ(LaneOfTask(""), LaneKind::kWalks) << "an item that only places a person";
  EXPECT_EQ(LaneOfTask("caption salvete"), LaneKind::kCaptions);
  EXPECT_EQ(LaneOfTask("use open"), LaneKind::kUses);
  EXPECT_EQ(LaneOfTask("take"), LaneKind::kUses);
}

}  // namespace
}  // namespace lararium::drama
