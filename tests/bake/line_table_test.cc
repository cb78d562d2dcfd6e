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
  const auto json = ReadLinesJson(FormatLinesJson(table), "lines.json");
  ASSERT_TRUE(json.ok()) << json.message();
  EXPECT_EQ(json->table, table);
}

TEST(LineTable, SaysWhereATableIsWrong) {
  const struct {
    const char* text;
    const char* problem;
  } mistakes[] = {
      {"speaker,la\n", "row 1: there is no column 'id'"},
      {"id,la,la\n", "'la' occurs twice"},
      {"id,Latin language\n", "'Latin language' is not a valid language tag"},
      {"id,la\n#note,b\n", "row 2: '#note' cannot be"},
      {"id,la\na,b\na,c\n", "row 3: the id 'a' occurs twice"},
      {"id,la\n../a,b\n", "row 2: '../a' cannot be a line's id"},
      {"id,la\na,b,c\n", "row 2: has more cells"},
      {"id,,la\na,b,c\n", "row 2: holds a text in a column that has no name"},
      {"id,la\na,\"b\n", "row 2: a quote is not closed"},
      {"id,la\na,\"b\"c\n", "row 2: there is text after a closing quote"},
  };
  for (const auto& mistake : mistakes) {
    const auto table = ParseLinesCsv(mistake.text, "lines.csv");
    ASSERT_FALSE(table.ok()) << mistake.text;
    EXPECT_THAT(table.message(), HasSubstr(mistake.problem));
  }
  EXPECT_THAT(ReadLinesJson(R"({"schema": 1, "languages": ["la"],
                                 "lines": [{"id": "a", "text": {"en": "x"}}]})",
                            "lines.json")
                  .message(),
              HasSubstr("'en' is none of the file's"));
}

TEST(LineTable, ReadsWhatSpreadsheetsReallyWrite) {
  const auto table = ParseLinesCsv(kCsv, "lines.csv");
  ASSERT_TRUE(table.ok());
  for (const char* text :
       {"sep=;\r\nid;speaker;notes;la;en\r\nsalvete;keeper;loud;Salvēte, hospitēs!;Greetings!\r\n"
        "vale;keeper;;Valē.;\r\n",
        "ID , Speaker,NOTES,la,en,,,\n"
        " salvete ,keeper,loud, \"Salvēte, hospitēs!\" ,Greetings!,,,\n,,,,,,,\n"
        "vale,keeper,,Valē.,   ,,,\n",
        "\"id\",\"speaker\",\"notes\",\"la\",\"en\"\r\"salvete\",\"keeper\",\"loud\",\"Salvēte, "
        "hospitēs!\",\"Greetings!\"\rvale,keeper,,Valē.,",
        "id|speaker|notes|la|en\nsalvete|keeper|loud|Salvēte, hospitēs!|Greetings!\n"
        "vale|keeper||Valē.\n"}) {
    const auto other = ParseLinesCsv(text, "lines.csv");
    ASSERT_TRUE(other.ok()) << other.message();
    EXPECT_EQ(*other, *table) << text;
  }
  const auto brazil = ParseLinesCsv("id,pt_BR\na,\"um\r\ndois\"\n", "lines.csv");
  ASSERT_TRUE(brazil.ok()) << brazil.message();
  EXPECT_EQ(brazil->Find("a")->text.at("pt-BR"), "um\ndois");
}

TEST(LineTable, ABadRowCostsThatRowAndIsTold) {
  const auto file = ReadLinesCsv(
      "id,la,Latin language\na,\"one\ntwo\"\n!,x\na,again\nb,\"y\"z\nc,1,2,3\nd,\"never closed\n"
      "e,last\n",
      "lines.csv");
  ASSERT_TRUE(file.ok()) << file.message();
  ASSERT_EQ(file->table.lines.size(), 2u);
  EXPECT_EQ(file->table.Find("a")->text.at("la"), "one\ntwo");
  EXPECT_EQ(file->table.Find("e")->text.at("la"), "last");
  std::vector<std::string> left_out;
  for (const Status& status : file->left_out) {
    left_out.push_back(status.message());
  }
  EXPECT_THAT(left_out,
              ElementsAre(HasSubstr("row 1: 'Latin language'"), HasSubstr("row 3 (line 4): '!'"),
                          HasSubstr("row 4 (line 5): the id 'a' occurs twice"),
                          HasSubstr("row 5 (line 6): there is text after"),
                          HasSubstr("row 6 (line 7): has more cells"),
                          HasSubstr("row 7 (line 8): a quote is not closed")));
}

TEST(LineTable, OtherEncodingsAreRecognisedAndTold) {
  const auto file =
      ReadLinesCsv("id,it\na,Perch\xE9 \xE8 cos\xEC? L\xE0 c'\xE8 un caff\xE8.\n", "lines.csv");
  ASSERT_TRUE(file.ok()) << file.message();
  EXPECT_EQ(file->table.Find("a")->text.at("it"), "Perché è così? Là c'è un caffè.");
  EXPECT_THAT(file->note, HasSubstr("lines.csv: is not UTF-8 and was read as windows-1252"));
}

TEST(LineTable, AFileWithABadRowIsNotReplaced) {
  const test::TemporaryFolder folder;
  const std::string damaged = std::string(kCsv) + "vale,keeper,,Twice,\n";
  ASSERT_TRUE(WriteFileAtomically(folder / "lines.csv", damaged).ok());
  EXPECT_THAT(LoadLines(folder.path()).message(), HasSubstr("row 4: the id 'vale' occurs twice"));
  const auto read = ReadLines(folder.path());
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->table.lines.size(), 2u);
  EXPECT_THAT(SaveLines(folder.path(), read->table).message(), HasSubstr("would be lost"));
  EXPECT_EQ(*ReadText(folder / "lines.csv"), damaged);
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
      "#, fuzzy\n"
      "#~ msgid \"retired\"\n"
      "#~ msgstr \"ritirato\"\n"
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
  EXPECT_EQ(report.fuzzy, 1);
  EXPECT_THAT(report.unknown, ElementsAre(HasSubstr("nowhere")));
  EXPECT_EQ(table->Find("salvete")->text.at("it"), "Salute, \"ospiti\"!");
  EXPECT_EQ(table->Find("vale")->text.at("it"), "Addio.");
  EXPECT_THAT(table->languages, ElementsAre("la", "en", "it"));
}

TEST(Po, ABadEntryCostsThatEntryAndIsTold) {
  const auto po = ParsePo(
      "msgid \"a\"\nmsgstr b\n\"more\"\n\nmsgid \"c\" \"d\"\nmsgstr \"\"\n\"e\"\n\nhello\n\n"
      "msgid \"f\"\nmsgid_plural \"fs\"\nmsgstr[0] \"g\"\nmsgstr[1] \"h\"\n",
      "a.po");
  ASSERT_TRUE(po.ok()) << po.message();
  ASSERT_EQ(po->entries.size(), 2u);
  EXPECT_EQ(po->entries[0].source, "cd");
  EXPECT_EQ(po->entries[0].text, "e");
  EXPECT_EQ(po->entries[1].text, "g");
  EXPECT_THAT(po->notes, ElementsAre(HasSubstr("line 2: a quoted text was expected"),
                                     HasSubstr("line 9: 'hello' is no word"),
                                     HasSubstr("line 12: of several plural forms the first")));
  EXPECT_THAT(ParsePo("\"a\"\n", "a.po").message(), HasSubstr("before any msgid"));
  EXPECT_THAT(ParsePo("hello\n", "a.po").message(), HasSubstr("'hello' is no word"));
}

TEST(Po, IsReadInTheEncodingAndLanguageOfItsHeader) {
  const auto po = ParsePo(
      "msgid \"\"\nmsgstr \"\"\n\"Language: pt_BR.UTF-8\\n\"\n"
      "\"Content-Type: text/plain; charset=ISO-8859-2\\n\"\n\nmsgid \"a\"\nmsgstr \"\xB1\"\n",
      "a.po");
  ASSERT_TRUE(po.ok()) << po.message();
  EXPECT_EQ(po->language, "pt-BR");
  EXPECT_EQ(po->entries[0].text, "ą");
  EXPECT_TRUE(po->notes.empty());
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
