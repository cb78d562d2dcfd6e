#include "shared/core/sentence.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace lararium {
namespace {

const std::string kKeeper = "keeper";
const std::string kWine = "wine";

const char* Italian(const char* text) {
  const std::string_view english = text;
  if (english == "%s has the %s") {
    return "%2$s: lo ha %1$s";
  }
  if (english == "cup of %s") {
    return "coppa di %s";
  }
  return english == "%s %% of it" ? "il %s %%" : text;
}

TEST(Sentence, SaysItsPartsInTheirOrder) {
  const Sentence sentence("%s has the %s", {kKeeper, Sentence("cup of %s", {kWine})});
  EXPECT_EQ(sentence.English(), "keeper has the cup of wine");
}

TEST(Sentence, IsTranslatedWithItsPartsInTheOrderOfTheOtherLanguage) {
  const Sentence sentence("%s has the %s", {kKeeper, Sentence("cup of %s", {kWine})});
  EXPECT_EQ(sentence.Translated(Italian), "coppa di wine: lo ha keeper");
  EXPECT_EQ(Sentence("%s %% of it", {std::string("20")}).Translated(Italian), "il 20 %");
}

TEST(Sentence, LeavesTextsThatAreNoFormatsAsTheyAre) {
  const Sentence name(std::string("100%s %%"));
  EXPECT_EQ(name.English(), "100%s %%");
  EXPECT_EQ(Sentence("%s has the %s", {name, name}).Translated(Italian),
            "100%s %%: lo ha 100%s %%");
  EXPECT_EQ(Sentence(std::string("cup of %s")).Translated(Italian), "cup of %s");
}

TEST(Sentence, WithoutAPartOrWithAnUnknownSignIsSaidAllTheSame) {
  EXPECT_EQ(Sentence("%s has the %s", {kKeeper}).English(), "keeper has the ");
  EXPECT_EQ(Sentence("%9$s, %").English(), ", %");
  EXPECT_EQ(Sentence().English(), "");
}

TEST(Sentence, IsTheSameWhereFormatAndPartsAre) {
  EXPECT_EQ(Sentence("cup of %s", {kWine}), Sentence("cup of %s", {kWine}));
  EXPECT_NE(Sentence("cup of %s", {kWine}), Sentence("cup of %s", {kKeeper}));
  EXPECT_NE(Sentence("cup"), Sentence(std::string("cup")));
}

}  // namespace
}  // namespace lararium
