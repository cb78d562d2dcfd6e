#include "shared/stage/acoustics_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/core/json.h"

namespace lararium::stage {
namespace {

using ::testing::HasSubstr;

Result<Acoustics> Parse(const char* text) {
  const Json json = Json::parse(text);
  return ParseFields<Acoustics>(JsonView(json, "place"));
}

TEST(Acoustics, SurvivesARoundTrip) {
  Acoustics acoustics;
  acoustics.reverb = Reverb::kStoneRoom;
  acoustics.reverb_db = -3.0f;
  acoustics.ambience = {{"street", -6.0f, std::nullopt}, {"fountain", 2.0f, glm::vec3(1, 2, 3)}};
  const Json json = FormatFields(acoustics);
  const auto parsed = ParseFields<Acoustics>(JsonView(json, "place"));
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(FormatFields(*parsed), json);
  EXPECT_EQ(parsed->ambience[1].position, glm::vec3(1, 2, 3));
  EXPECT_FALSE(parsed->ambience[0].position.has_value());
}

TEST(Acoustics, EverythingMayBeMissing) {
  const auto parsed = Parse("{}");
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(parsed->reverb, Reverb::kNone);
  EXPECT_TRUE(parsed->ambience.empty());
}

TEST(Acoustics, ErrorsSayWhatIsWrongAndWhatThereIs) {
  EXPECT_THAT(Parse(R"({"reverb": "cathedral"})").message(), HasSubstr("vault"));
  EXPECT_THAT(Parse(R"({"echo": 1})").message(), HasSubstr("\"echo\""));
  EXPECT_FALSE(Parse("[]").ok());
  EXPECT_FALSE(Parse(R"({"ambience": [{}]})").ok());
  EXPECT_FALSE(Parse(R"({"ambience": [{"sound": "a", "at": [0, 0]}]})").ok());
  EXPECT_FALSE(Parse(R"({"ambience": [{"sound": "a", "at": [0, 0, 1e9]}]})").ok());
  EXPECT_FALSE(Parse(R"({"ambience": [{"sound": "a", "gain_db": 60}]})").ok());
  EXPECT_FALSE(Parse(R"({"reverb_db": 1e99})").ok());
}

}  // namespace
}  // namespace lararium::stage
