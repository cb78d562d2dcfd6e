#include "shared/stage/paradata.h"

#include <gmock/gmock.h>

namespace lararium::stage {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kFull[] = R"({
 "schema": 1, "author": "A museum", "licence": "CC0-1.0",
 "sources": {"cil": "CIL IV 1679"},
 "claims": {
  "objects": {"cup": {"certainty": "inferred", "source": ["cil"],
                      "text": {"it": "Una coppa", "la": "Poculum"}}},
  "people": {"keeper": {"certainty": "attested", "author": "B", "licence": "MIT",
                        "text": {"en": "He"}}},
  "lines": {"vale": {}}}})";

std::string Problem(const std::string& text) {
  const auto parsed = ParseParadata(text, "paradata.json");
  return parsed.ok() ? "" : parsed.message();
}

TEST(Paradata, IsReadAndWrittenAsItWas) {
  const auto parsed = ParseParadata(kFull, "paradata.json");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->author, "A museum");
  const Claim* cup = parsed->Find(Subject::kObject, "cup");
  ASSERT_NE(cup, nullptr);
  EXPECT_EQ(cup->certainty, Certainty::kInferred);
  EXPECT_THAT(cup->sources, ElementsAre("cil"));
  EXPECT_EQ(parsed->Find(Subject::kPerson, "keeper")->licence, "MIT");
  EXPECT_EQ(parsed->Find(Subject::kLine, "vale")->certainty, Certainty::kUnsaid);
  EXPECT_EQ(parsed->Find(Subject::kObject, "keeper"), nullptr);
  const std::string text = FormatParadata(*parsed);
  const auto again = ParseParadata(text, "again");
  ASSERT_TRUE(again.ok()) << again.message();
  EXPECT_EQ(FormatParadata(*again), text);
}

TEST(Paradata, AVisitorReadsTheirLanguageOrEnglishOrAny) {
  Claim claim;
  EXPECT_EQ(claim.Text("it"), "");
  claim.text = {{"fr", "une coupe"}};
  EXPECT_EQ(claim.Text("it"), "une coupe");
  claim.text["en"] = "a cup";
  EXPECT_EQ(claim.Text("it"), "a cup");
  claim.text["it"] = "una coppa";
  EXPECT_EQ(claim.Text("it"), "una coppa");
}

TEST(Paradata, BadTextsAreRefusedWithTheirPlaceAndARemedy) {
  EXPECT_THAT(Problem("{"), HasSubstr("not valid JSON"));
  EXPECT_THAT(Problem("[]"), HasSubstr("must be an object"));
  EXPECT_THAT(Problem(R"({"schema": 2})"), HasSubstr("newer Lararium"));
  EXPECT_THAT(Problem(R"({"schema": 1, "claim": {}})"), HasSubstr("\"claim\" is not known"));
  EXPECT_THAT(Problem(R"({"schema": 1, "claims": {"persons": {}}})"), HasSubstr("'persons'"));
  EXPECT_THAT(Problem(R"({"schema": 1, "claims": {"people": {"": {}}}})"), HasSubstr("name"));
  EXPECT_THAT(Problem(R"({"schema": 1, "claims": {"people": {"a": {"certainty": "sure"}}}})"),
              HasSubstr("claims.people.a: \"certainty\" is 'sure'; choose attested"));
  EXPECT_THAT(Problem(R"({"schema": 1, "claims": {"people": {"a": {"certainty": ""}}}})"),
              HasSubstr("claims.people.a: \"certainty\" is ''; choose attested"));
  EXPECT_THAT(Problem(R"({"schema": 1, "claims": {"people": {"a": {"source": ["b"]}}}})"),
              HasSubstr("there is no source 'b'"));
  EXPECT_THAT(Problem(R"({"schema": 1, "claims": {"people": {"a": {"text": {"english": "b"}}}}})"),
              testing::IsEmpty());  // BCP 47 allows it.
  EXPECT_THAT(Problem(R"({"schema": 1, "claims": {"people": {"a": {"text": {"e n": "b"}}}}})"),
              HasSubstr("not a valid language tag"));
  EXPECT_THAT(Problem(R"({"schema": 1, "author": "\u001b[31m"})"), HasSubstr("control characters"));
  EXPECT_THAT(Problem(R"({"schema": 1, "sources": {"a\u0007": "b"}})"),
              HasSubstr("control characters"));
  EXPECT_THAT(Problem(R"({"schema": 1, "author": ")" + std::string(5000, 'a') + "\"}"),
              HasSubstr("longer than"));
}

}  // namespace
}  // namespace lararium::stage
