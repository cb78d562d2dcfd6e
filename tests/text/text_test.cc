#include "editor/text/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>
#include <string>

#include "editor/bake/line_table.h"
#include "editor/session/settings.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

constexpr size_t kMaxBytes = size_t{1} << 22;

// The entries of a catalogue, keyed by context and English text.
std::map<std::string, bake::PoEntry> EntriesOf(const std::filesystem::path& file) {
  const Result<std::string> text = ReadText(file, kMaxBytes);
  EXPECT_TRUE(text.ok()) << text.message();
  const Result<bake::PoFile> po = bake::ParsePo(text.ok() ? *text : "", file.string());
  EXPECT_TRUE(po.ok()) << po.message();
  std::map<std::string, bake::PoEntry> entries;
  for (const bake::PoEntry& entry : po.ok() ? po->entries : std::vector<bake::PoEntry>()) {
    entries.emplace(entry.context + '\004' + entry.source, entry);
  }
  return entries;
}

std::set<std::string> KeysOf(const std::map<std::string, bake::PoEntry>& entries) {
  std::set<std::string> keys;
  for (const auto& [key, entry] : entries) {
    keys.insert(key);
  }
  return keys;
}

class Catalogue : public testing::TestWithParam<std::string> {
 protected:
  std::filesystem::path file_ = test::SourceDir() / "po" / (GetParam() + ".po");
  std::map<std::string, bake::PoEntry> entries_ = EntriesOf(file_);
};

TEST_P(Catalogue, HasTheTextsOfTheSourcesAndNoOthers) {
  const std::set<std::string> sources = KeysOf(EntriesOf(LARARIUM_POT));
  EXPECT_GT(sources.size(), 600u);
  EXPECT_EQ(KeysOf(entries_), sources) << "build the target lararium_po, then translate";
}

TEST_P(Catalogue, LeavesNothingUntranslatedOrUnsure) {
  for (const auto& [key, entry] : entries_) {
    EXPECT_FALSE(entry.text.empty()) << entry.source;
    EXPECT_FALSE(entry.fuzzy) << entry.source;
  }
  const std::string text = *ReadText(file_, kMaxBytes);
  EXPECT_THAT(text, testing::Not(testing::ContainsRegex("msgstr\\[[0-9]\\] \"\"\n")));
  // Texts that the sources no longer contain.
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("#~")));
}

// A text that is joined with others keeps its spaces and its ellipsis.
TEST_P(Catalogue, BeginsAndEndsTextsAsTheSourcesDo) {
  const std::string ellipsis = "\xe2\x80\xa6";
  for (const auto& [key, entry] : entries_) {
    if (entry.text.empty()) {
      continue;  // Another test reports this.
    }
    EXPECT_EQ(entry.text.front() == ' ', entry.source.front() == ' ') << entry.source;
    EXPECT_EQ(entry.text.back() == ' ', entry.source.back() == ' ') << entry.source;
    EXPECT_EQ(entry.text.back() == '.', entry.source.back() == '.') << entry.source;
    EXPECT_EQ(entry.text.ends_with(ellipsis), entry.source.ends_with(ellipsis)) << entry.source;
  }
}

std::vector<std::string> Translated() {
  std::vector<std::string> languages;
  for (const std::string language : kLanguages) {
    if (!language.empty() && language != "en") {
      languages.push_back(language);
    }
  }
  return languages;
}
INSTANTIATE_TEST_SUITE_P(Of, Catalogue, testing::ValuesIn(Translated()), [](const auto& info) {
  return info.param;
});

// Sets the texts of the process back to English.
class Texts : public testing::Test {
 protected:
  ~Texts() override { LoadTexts(LARARIUM_LOCALE_DIR, "en"); }
  static void Load(const std::string& language) { LoadTexts(LARARIUM_LOCALE_DIR, language); }
};

TEST_F(Texts, FollowTheLanguageThatIsChosenAtOnceAndBack) {
  EXPECT_STREQ(Tr("Save"), "Save");
  Load("it");
  EXPECT_STREQ(Tr("Save"), "Salva");
  Load("en");
  EXPECT_STREQ(Tr("Save"), "Save");
  Load("it");
  EXPECT_STREQ(Tr("Save"), "Salva");
}

TEST_F(Texts, CountInTheLanguage) {
  EXPECT_EQ(TrCount("%d item", "%d items", 1), "1 item");
  EXPECT_EQ(TrCount("%d item", "%d items", 3), "3 items");
  Load("it");
  EXPECT_EQ(TrCount("%d item", "%d items", 1), "1 elemento");
  EXPECT_EQ(TrCount("%d item", "%d items", 3), "3 elementi");
}

TEST_F(Texts, TellTwoMeaningsOfAWordApart) {
  EXPECT_STREQ(TrIn("colours", "Light"), "Light");
  Load("it");
  EXPECT_STREQ(TrIn("colours", "Light"), "Chiari");
  EXPECT_STREQ(Tr("Light"), "Luce");
}

TEST_F(Texts, WithoutATranslationAreEnglish) {
  Load("it");
  const char* const unknown = "No catalogue has this.";
  EXPECT_EQ(Tr(unknown), unknown);
  EXPECT_EQ(TrIn("nowhere", unknown), unknown);
  EXPECT_STREQ(Tr(""), "");
  LoadTexts("/nowhere", "it");
  EXPECT_STREQ(Tr("Quit"), "Quit");
}

// The environment is read only once, so each test runs in a separate process.
class LanguageOfTheEnvironment : public testing::Test {
 protected:
  LanguageOfTheEnvironment() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

  // Whether Save has this translation when no language is chosen.
  [[noreturn]] static void Expect(const char* save,
                                  const char* language,
                                  const char* lc_all,
                                  const char* lang) {
    setenv("LANGUAGE", language, 1);
    setenv("LC_ALL", lc_all, 1);
    setenv("LANG", lang, 1);
    unsetenv("LC_MESSAGES");
    LoadTexts(LARARIUM_LOCALE_DIR, "");
    const bool as_expected = std::string(Tr("Save")) == save;
    LoadTexts(LARARIUM_LOCALE_DIR, "it");
    const bool chosen = std::string(Tr("Save")) == "Salva";
    LoadTexts(LARARIUM_LOCALE_DIR, "");
    std::exit(as_expected && chosen && std::string(Tr("Save")) == save ? 0 : 1);
  }
};

TEST_F(LanguageOfTheEnvironment, HoldsWhereNoneIsChosenAlsoInALocaleThatWasNeverGenerated) {
  EXPECT_EXIT(Expect("Salva", "", "", "it_IT.UTF-8"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(Expect("Salva", "", "it_CH.UTF-8", "de_CH.UTF-8"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(Expect("Salva", "xx:it", "", "C.UTF-8"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(Expect("Save", "", "", "xx_XX.UTF-8"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(Expect("Save", "", "", ""), testing::ExitedWithCode(0), "");
}

TEST_F(LanguageOfTheEnvironment, IsEnglishInThePlainLocaleAsOfAllPrograms) {
  EXPECT_EXIT(Expect("Save", "it", "C", "it_IT.UTF-8"), testing::ExitedWithCode(0), "");
}

TEST_F(Texts, KeepThePointOfNumbers) {
  Load("it");
  EXPECT_EQ(Text("%.2f", 1.25), "1.25");
  EXPECT_EQ(std::strtod("1.25", nullptr), 1.25);
}

TEST_F(Texts, LabelsKeepTheirIdInEveryLanguage) {
  EXPECT_EQ(Label(Tr("Size"), "size"), "Size###size");
  Load("it");
  EXPECT_EQ(Label(Tr("Size"), "size"), "Dimensione###size");
}

}  // namespace
}  // namespace lararium::editor
