#include "editor/document/titles.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "editor/document/document_fields.h"

namespace lararium::editor {
namespace {

TEST(Titles, MakePlainNames) {
  EXPECT_EQ(PlainNameOf("tavern"), "tavern");
  EXPECT_EQ(PlainNameOf("Casa del Fauno, atrio"), "Casa_del_Fauno_atrio");
  EXPECT_EQ(PlainNameOf("Größe"), "Groesse");
  EXPECT_EQ(PlainNameOf("Gro\xCC\x88\xC3\x9F"
                        "e"),
            "Grosse");  // The accent is a character of its own.
  EXPECT_EQ(PlainNameOf("Città (l'atrio) – 2"), "Citta_l_atrio_2");
  EXPECT_EQ(PlainNameOf("Ærøskøbing, Łódź"), "AEroskobing_Lodz");
  EXPECT_EQ(PlainNameOf("Οἶκος Δήλου"), "O_kos_Deloy");
  EXPECT_EQ(PlainNameOf("οίκος"), "oikos");
  EXPECT_EQ(PlainNameOf("  -x-  "), "x");
  EXPECT_EQ(PlainNameOf("../../etc/passwd"), "etc_passwd");
  EXPECT_EQ(PlainNameOf("東京"), "");
  EXPECT_EQ(PlainNameOf("?!"), "");
  EXPECT_EQ(PlainNameOf(""), "");
}

TEST(Titles, OfAnyBytesMakeNamesThatArePlainOrEmpty) {
  std::string title;
  for (int byte = 1; byte < 256; ++byte) {
    title.assign(3, static_cast<char>(byte));
    const std::string name = PlainNameOf("a" + title + "b");
    EXPECT_TRUE(IsPlainName(name)) << byte << ": " << name;
  }
  EXPECT_TRUE(IsPlainName(PlainNameOf(std::string(5000, 'x'))));
}

TEST(Titles, MakeNamesThatAreNotTaken) {
  const std::set<std::string> known = {"bar", "bar_2", "place"};
  const auto taken = [&](const std::string& name) { return known.contains(name); };
  EXPECT_EQ(FreeNameOf("Bar", "place", taken), "Bar");
  EXPECT_EQ(FreeNameOf("bar", "place", taken), "bar_3");
  EXPECT_EQ(FreeNameOf("東京", "place", taken), "place_2");
  EXPECT_EQ(FreeNameOf("", "person", taken), "person");
}

TEST(Titles, AreAnyTextThatFitsIntoALine) {
  for (const char* good : {"Casa del Fauno, atrio", "Größe", "Οἶκος", "a/b \"c\"", "東京"}) {
    EXPECT_TRUE(IsTitle(good)) << good;
  }
  EXPECT_TRUE(IsTitle(std::string(kMaxTitle, 'a')));
  for (const std::string& bad :
       {std::string(), std::string("  "), std::string("a\nb"), std::string("\x7F"),
        std::string("\xF6"), std::string(kMaxTitle + 1, 'a')}) {
    EXPECT_FALSE(IsTitle(bad)) << bad;
  }
}

}  // namespace
}  // namespace lararium::editor
