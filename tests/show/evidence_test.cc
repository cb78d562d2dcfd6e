#include "shared/show/evidence.h"

#include <gmock/gmock.h>

#include "tests/stage/test_human.h"

namespace lararium::show {
namespace {

using stage::Certainty;
using stage::Subject;

ShowContent TwoPeople() {
  ShowContent content;
  content.cast = {{"keeper", test::MakeTestHuman(), "Placidus"},
                  {"girl", test::MakeTestHuman(), ""}};
  content.language = "it";
  auto& people = content.paradata.claims[static_cast<size_t>(Subject::kPerson)];
  people["keeper"].certainty = Certainty::kAttested;
  people["keeper"].text = {{"en", "His name is known."}, {"it", "Il nome è noto."}};
  return content;
}

// The camera stands at the stage's origin and looks along -Z.
StagedFrame Seeing(std::initializer_list<glm::vec3> feet) {
  StagedFrame staged;
  staged.camera.camera_from_stage = geometry::Rigid3{{0.0, 1.0, 0.0, 0.0}, Eigen::Vector3d::Zero()};
  uint32_t cast = 0;
  for (const glm::vec3& at : feet) {
    StagedActor& actor = staged.people.actors.emplace_back();
    actor.cast = cast++;
    actor.stage_from_actor[3] = glm::vec4(at, 1.0f);
  }
  return staged;
}

TEST(Evidence, EachCertaintyHasAColourAndStripesOfItsOwn) {
  const Evidence evidence(TwoPeople());
  const render::SceneMark known = evidence.MarkOfActor(0, 720);
  const render::SceneMark unknown = evidence.MarkOfActor(1, 720);
  EXPECT_NE(known.colour, unknown.colour);
  EXPECT_GT(known.share, 0.5f);
  EXPECT_EQ(known.stripe_px, 18.0f);
  Evidence view(TwoPeople());
  const render::Legend& legend = view.LegendOf(Seeing({}));
  ASSERT_EQ(legend.entries.size(), stage::kCertaintyCount);
  for (size_t i = 0; i < legend.entries.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      EXPECT_NE(legend.entries[i].colour, legend.entries[j].colour);
      EXPECT_NE(legend.entries[i].text, legend.entries[j].text);
    }
  }
  EXPECT_EQ(legend.entries[0].text, "attestato");
}

TEST(Evidence, SaysWhatIsKnownOfWhomTheVisitorLooksAt) {
  Evidence evidence(TwoPeople());
  // The people's chests are at the camera's height.
  const render::Legend& left =
      evidence.LegendOf(Seeing({{0.1f, -1.2f, -3.0f}, {1.5f, -1.2f, -3.0f}}));
  EXPECT_EQ(left.title, "Placidus: attestato");
  EXPECT_EQ(left.text, "Il nome è noto.");
  const render::Legend& right =
      evidence.LegendOf(Seeing({{-1.5f, -1.2f, -3.0f}, {0.0f, -1.2f, -3.0f}}));
  EXPECT_EQ(right.title, "non documentato");
  EXPECT_EQ(right.text, "");
  EXPECT_EQ(evidence.LegendOf(Seeing({{0.0f, -1.2f, 3.0f}})).title, "") << "behind the camera";
  StagedFrame lost = Seeing({{0.0f, -1.2f, -3.0f}});
  lost.camera.camera_from_stage.reset();
  EXPECT_EQ(evidence.LegendOf(lost).title, "");
}

TEST(Evidence, WhoStandsInFrontHidesWhoIsBehind) {
  Evidence evidence(TwoPeople());
  EXPECT_EQ(evidence.LegendOf(Seeing({{0.05f, -1.2f, -2.0f}, {0.0f, -1.2f, -4.0f}})).title,
            "Placidus: attestato");
  Evidence other(TwoPeople());
  EXPECT_EQ(other.LegendOf(Seeing({{0.0f, -1.2f, -4.0f}, {0.05f, -1.2f, -2.0f}})).title,
            "non documentato");
}

TEST(Evidence, WhoIsLookedAtStaysUntilSomebodyElseIsClearlyNearer) {
  Evidence evidence(TwoPeople());
  const auto title = [&](float first, float second) {
    return std::string(
        evidence.LegendOf(Seeing({{first, -1.2f, -3.0f}, {second, -1.2f, -3.0f}})).title);
  };
  EXPECT_EQ(title(0.10f, -0.15f), "Placidus: attestato");
  EXPECT_EQ(title(0.15f, -0.10f), "Placidus: attestato");
  EXPECT_EQ(title(0.25f, 0.0f), "non documentato");
  EXPECT_EQ(title(0.10f, -0.15f), "non documentato");
}

TEST(Evidence, WordsAreThoseOfTheLanguageOrEnglish) {
  EXPECT_EQ(EvidenceWord(Certainty::kInferred, "la"), "coniectum");
  EXPECT_EQ(EvidenceWord(Certainty::kInferred, "de-CH"), "erschlossen");
  EXPECT_EQ(EvidenceWord(Certainty::kInferred, "xx"), "inferred");
  EXPECT_EQ(EvidenceWord(Certainty::kInferred, ""), "inferred");
}

}  // namespace
}  // namespace lararium::show
