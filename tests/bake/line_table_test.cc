#include "editor/bake/line_table.h"

#include <gmock/gmock.h>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::bake {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kCsv[] =
    "id,speaker,notes,la,en\n"
    "salvete,keeper,loud,\"Salvēte, hospitēs!\",Greetings!\n"
    "vale,keeper,,Valē.,\n";

TEST(LineTable, ReadsSpreadsheetsWithAnySeparatorAndMark) {
  const auto table = ParseLinesCsv(kCsv, "lines.csv");
  ASSERT_TRUE(table.ok()) << table.message();
  EXPECT_THAT(table->languages, ElementsAre("la", "en"));
  const Line* line = table->Find("salvete");
  ASSERT_NE(line, nullptr);
  EXPECT_EQ(line->speaker, "keeper");
  EXPECT_EQ(line->text.at("la"), "Salvēte, hospitēs!");
  EXPECT_FALSE(table->Find("vale")->text.contains("en")) << "an empty cell is no text";
  for (const char* text :
       {"\xEF\xBB\xBFid;speaker;notes;la;en\r\nsalvete;keeper;loud;\"Salvēte, hospitēs!\";"
        "Greetings!\r\nvale;keeper;;Valē.;\r\n",
        "id\tspeaker\tnotes\tla\ten\nsalvete\tkeeper\tloud\tSalvēte, hospitēs!\tGreetings!\n\n"
        "vale\tkeeper\t\tValē.\t"}) {
    const auto other = ParseLinesCsv(text, "lines.csv");
    ASSERT_TRUE(other.ok()) << other.message();
    EXPECT_EQ(*other, *table);
  }
}

TEST(LineTable, CsvAndJsonAreReadAsTheyWereWritten) {
  LineTable table;
  table.languages = {"la", "en"};
  table.lines = {{"odd", "girl", "with \"quotes\",\nand rows", {{"la", "\"Quid?\"; rogat"}}},
                 {"even", "", "", {{"en", "a,b\tc"}, {"la", "ā"}}}};
  const auto csv = ParseLinesCsv(FormatLinesCsv(table), "lines.csv");
  ASSERT_TRUE(csv.ok()) << csv.message();
  EXPECT_EQ(*csv, table);
  const auto json = ParseLinesJson(FormatLinesJson(table), "lines.json");
  ASSERT_TRUE(json.ok()) << json.message();
  EXPECT_EQ(*json, table);
}

TEST(LineTable, SaysWhereATableIsWrong) {
  const struct {
    const char* text;
    const char* problem;
  } mistakes[] = {
      {"speaker,la\n", "row 1: there is no column 'id'"},
      {"id,la,la\n", "'la' occurs twice"},
      {"id,Latin language\n", "'Latin language' is not a valid language tag"},
      {"id,la\na,b\na,c\n", "row 3: the id 'a' occurs twice"},
      {"id,la\n../a,b\n", "row 2: '../a' cannot be a line's id"},
      {"id,la\na,b,c\n", "row 2: has more cells"},
      {"id,la\na,\"b\n", "row 2: a quote is not closed"},
      {"id,la\na,\"b\"c\n", "row 2: there is text after a closing quote"},
      {"id,la\na,\xFF\n", "is not UTF-8"},
  };
  for (const auto& mistake : mistakes) {
    const auto table = ParseLinesCsv(mistake.text, "lines.csv");
    ASSERT_FALSE(table.ok()) << mistake.text;
    EXPECT_THAT(table.message(), HasSubstr(mistake.problem));
  }
  EXPECT_THAT(ParseLinesJson(R"({"schema": 1, "languages": ["la"],
                                 "lines": [{"id": "a", "text": {"en": "x"}}]})",
                             "lines.json")
                  .message(),
              HasSubstr("'en' is none of the file's"));
}

TEST(Po, TranslatesByContextOrBySourceAndLeavesOutWhatIsFuzzy) {
  constexpr char kPo[] =
      "# a comment\n"
      "msgid \"\"\n"
      "msgstr \"\"\n"
      "\"Language: it\\n\"\n"
      "\n"
      "msgctxt \"salvete\"\n"
      "msgid \"Greetings!\"\n"
      "msgstr \"Salute, \"\n"
      "\"\\\"ospiti\\\"!\"\n"
      "\n"
      "msgid \"Valē.\"\n"
      "msgstr \"Addio.\"\n"
      "\n"
      "#, fuzzy\n"
      "msgctxt \"vale\"\n"
      "msgid \"x\"\n"
      "msgstr \"Forse\"\n"
      "#~ msgid \"retired\"\n"
      "msgctxt \"nowhere\"\n"
      "msgid \"y\"\n"
      "msgstr \"z\"\n";
  const auto po = ParsePo(kPo, "it.po");
  ASSERT_TRUE(po.ok()) << po.message();
  EXPECT_EQ(po->language, "it");
  ASSERT_EQ(po->entries.size(), 4u);
  auto table = ParseLinesCsv(kCsv, "lines.csv");
  ASSERT_TRUE(table.ok());
  const PoImport report = ImportPo(*po, "it", *table);
  EXPECT_EQ(report.translated, 2);
  EXPECT_THAT(report.unknown, ElementsAre(HasSubstr("nowhere")));
  EXPECT_EQ(table->Find("salvete")->text.at("it"), "Salute, \"ospiti\"!");
  EXPECT_EQ(table->Find("vale")->text.at("it"), "Addio.");
  EXPECT_THAT(table->languages, ElementsAre("la", "en", "it"));
}

TEST(Po, SaysWhichLineIsWrong) {
  EXPECT_THAT(ParsePo("msgid \"a\"\nmsgstr b\n", "a.po").message(), HasSubstr("line 2"));
  EXPECT_THAT(ParsePo("\"a\"\n", "a.po").message(), HasSubstr("before any msgid"));
  EXPECT_THAT(ParsePo("hello\n", "a.po").message(), HasSubstr("'hello' is no word"));
}

TEST(LineTable, OfAFolderIsCsvOrJsonAndNeverBoth) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(LoadLines(folder.path())->lines.empty());
  ASSERT_TRUE(WriteFileAtomically(folder / "lines.csv", std::string_view(kCsv)).ok());
  auto table = LoadLines(folder.path());
  ASSERT_TRUE(table.ok());
  EXPECT_EQ(table->lines.size(), 2u);
  table->lines.pop_back();
  ASSERT_TRUE(SaveLines(folder.path(), *table).ok());
  EXPECT_EQ(*LoadLines(folder.path()), *table);
  ASSERT_TRUE(WriteFileAtomically(folder / "lines.json", FormatLinesJson(*table)).ok());
  EXPECT_THAT(LoadLines(folder.path()).message(), HasSubstr("keep one of them"));
}

}  // namespace
}  // namespace lararium::bake
