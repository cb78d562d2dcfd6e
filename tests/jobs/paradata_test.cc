#include "editor/jobs/paradata.h"

#include <gmock/gmock.h>

#include "editor/jobs/baking.h"
#include "editor/jobs/credits.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ParadataTest : public ::testing::Test {
 protected:
  ParadataTest() {
    document_.title = "A bar";
    document_.credits = "Filmed by M";
    document_.cast.resize(1);
    document_.cast[0].name = "keeper";
    document_.cast[0].clips = {{"nod", "nod.bvh", false}};
    document_.objects.resize(1);
    document_.objects[0].name = "cup";
    document_.objects[0].model = "cup";
    document_.places.resize(1);
    document_.places[0].name = "bar";
    document_.places[0].occluders.resize(1);
    document_.places[0].occluders[0].name = "wall";
    document_.places[0].occluders[0].file = "wall.glb";
    Write("lines.csv", "id,speaker,la\nkeeper,,Placidus\nsalvete,keeper,Salvēte!\n");
    Write("drama.lua", "track{markers = {{at = 1, name = \"noon\"}, {at = 2, name = \"noon\"}}}\n");
  }

  void Write(const char* file, std::string_view text) {
    ASSERT_TRUE(WriteFileAtomically(folder_ / file, text).ok());
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_.path()};
  ProjectDocument document_;
};

TEST_F(ParadataTest, ListsEverythingThatClaimsAreAbout) {
  std::vector<std::string> names;
  for (const ProjectSubject& subject : ListSubjects(paths_, document_)) {
    if (subject.needs_claim) {
      names.push_back(std::string(NameOf(subject.subject)) + " " + subject.name);
    }
  }
  EXPECT_THAT(names,
              ElementsAre("people keeper", "clips keeper/nod", "objects cup", "lines salvete",
                          "places bar", "occluders bar/wall", "scenes drama", "scenes noon"));
}

TEST_F(ParadataTest, WhatHasNoneIsListed) {
  EXPECT_TRUE(LoadParadata(paths_)->empty());
  ParadataReport report = CheckParadata(paths_, document_);
  EXPECT_THAT(EnglishOf(report.problems), IsEmpty());
  EXPECT_THAT(EnglishOf(report.warnings),
              Contains(HasSubstr("how certain these lines are: salvete")));
  Write("paradata.json",
        R"({"schema": 1, "claims": {"lines": {"salvete": {"certainty": "imagined"}},
            "objects": {"cup": {"author": "B"}}}})");
  report = CheckParadata(paths_, document_);
  EXPECT_THAT(EnglishOf(report.problems), IsEmpty());
  EXPECT_THAT(EnglishOf(report.warnings), Not(Contains(HasSubstr("these lines"))));
  EXPECT_THAT(EnglishOf(report.warnings), Contains(HasSubstr("these objects")));
  EXPECT_EQ(report.json["imagined"], 1);
  EXPECT_EQ(report.json["without"]["objects"], Json::array({"cup"}));
}

TEST_F(ParadataTest, LanguagesOfCaptionsThatATextLacksAreTold) {
  Write("lines.csv", "id,speaker,la,en\nsalvete,keeper,Salvēte!,Greetings!\n");
  Write("paradata.json",
        R"({"schema": 1, "claims": {"people": {"keeper": {"text": {"en": "He"}}},
            "objects": {"cup": {}}}})");
  const ParadataReport report = CheckParadata(paths_, document_);
  EXPECT_THAT(EnglishOf(report.warnings),
              Contains(HasSubstr("no text in 'la' for these, so visitors read another "
                                 "language: keeper")));
  EXPECT_THAT(EnglishOf(report.warnings), Not(Contains(HasSubstr("no text in 'en'"))));
}

TEST_F(ParadataTest, ClaimsAboutNothingAndSourcesOfNothingAreTold) {
  Write("paradata.json",
        R"({"schema": 1, "sources": {"cil": "CIL"},
            "claims": {"objects": {"cop": {}}, "sounds": {"street": {}}}})");
  const ParadataReport report = CheckParadata(paths_, document_);
  EXPECT_THAT(EnglishOf(report.problems),
              ElementsAre("paradata.json: claims.objects: 'cop' is not in the project; correct "
                          "its name"));
  EXPECT_THAT(EnglishOf(report.warnings),
              Contains("paradata.json: no claim cites the source 'cil'"));
  Write("paradata.json", "{");
  EXPECT_THAT(EnglishOf(CheckParadata(paths_, document_).problems),
              Contains(HasSubstr("not valid JSON")));
}

TEST_F(ParadataTest, CreditsNameAuthorsLicencesLettersVoicesAndSources) {
  EXPECT_THAT(MakeCredits(paths_, document_).message(), HasSubstr("keeper"));
  document_.cast[0].clips.clear();
  document_.places.clear();
  NoProgress progress;
  for (const BakeWhat what : {BakeWhat::kUnlitPeople, BakeWhat::kAllButPeople}) {
    const auto baked = Bake(paths_, document_, progress, what);
    ASSERT_TRUE(baked.ok()) << baked.message();
  }
  Write("paradata.json",
        R"({"schema": 1, "author": "The museum", "licence": "CC0-1.0",
            "sources": {"cil": "CIL IV 1679"},
            "claims": {"objects": {"cup": {"certainty": "inferred", "source": ["cil"]}},
                       "lines": {"salvete": {"certainty": "imagined", "author": "B"}}}})");
  const auto credits = MakeCredits(paths_, document_);
  ASSERT_TRUE(credits.ok()) << credits.message();
  const std::string& text = credits->text;
  EXPECT_THAT(text, HasSubstr("A bar\nFilmed by M\n"));
  EXPECT_THAT(text, HasSubstr("Lararium's built-in figure, Apache-2.0 (keeper)"));
  EXPECT_THAT(text, HasSubstr("Modelled for Lararium after finds in Pompeii, Apache-2.0 (cup)"));
  EXPECT_THAT(text, HasSubstr("The museum; CC0-1.0 (objects cup)"));
  EXPECT_THAT(text, HasSubstr("B; CC0-1.0 (lines salvete)"));
  EXPECT_THAT(text, HasSubstr("CIL IV 1679 (objects cup)"));
  EXPECT_THAT(text, HasSubstr("eSpeak NG 1."));
  EXPECT_THAT(text, HasSubstr("(keeper (la))"));
  EXPECT_THAT(text, HasSubstr("Inter"));
  EXPECT_THAT(text, HasSubstr("SIL Open Font License"));
  EXPECT_EQ(credits->json["certainty"], Json({{"inferred", 1}, {"imagined", 1}}));
  EXPECT_EQ(credits->json["sources"][0]["reference"], "CIL IV 1679");
  EXPECT_EQ(credits->json["fonts"].size(), 1u);
}

}  // namespace
}  // namespace lararium::editor
