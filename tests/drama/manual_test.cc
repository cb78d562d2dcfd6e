// Checks docs/drama.md: each of its examples runs, and each function of lua/std has one.

#include <gmock/gmock.h>

#include <set>
#include <sstream>

#include "shared/core/file.h"
#include "shared/drama/timeline_text.h"
#include "tests/drama/drama_fixture.h"
#include "tests/stage/test_props.h"
#include "tests/support/test_files.h"

namespace lararium::drama {
namespace {

using ::testing::IsEmpty;

const std::string kManual = test::SourceDir() / "docs/drama.md";

std::string MustRead(const std::string& path) {
  const auto text = ReadText(path);
  EXPECT_TRUE(text.ok()) << path;
  return text.ok() ? *text : "";
}

struct Example {
  int line = 0;
  std::string script;
};

// The indented blocks of the manual.
std::vector<Example> Examples() {
  std::vector<Example> examples;
  std::istringstream manual(MustRead(kManual));
  std::string line;
  bool inside = false;
  bool after_blank = true;
  for (int number = 1; std::getline(manual, line); ++number) {
    if (line.starts_with("    ") && (inside || after_blank)) {
      if (!inside) {
        examples.push_back({number, ""});
      }
      inside = true;
      examples.back().script += line.substr(4) + "\n";
    } else if (line.empty() && inside) {
      examples.back().script += "\n";
    } else {
      inside = false;
    }
    after_blank = line.empty();
  }
  return examples;
}

class ManualTest : public ::testing::Test {
 protected:
  ManualTest() {
    auto human = std::make_shared<human::Human>(*test::MakeTestHuman());
    human->clips[2].name = "wave";
    for (const char* name : {"keeper", "guest"}) {
      EXPECT_TRUE(stage_.Add(name, human).ok());
    }
    Add("table", test::MakeTable(), {{-1.5f, 0.0f, 0.0f}});
    Add("chest", test::MakeChest(), {{1.5f, 0.0f, 0.0f}});
    Add("cup", test::MakeCup(), {{0.0f, 0.0f, -1.0f}});
    Add("lamp", test::MakeLamp(), {{3.0f, 0.0f, 0.0f}});
    Add("stool", test::MakeStool(), {{-3.0f, 0.0f, 1.0f}});
    human::VisemeTrack track;
    track.keys = {{0.0f, human::Viseme::kAa, 1.0f}};
    track.duration = 1.0f;
    EXPECT_TRUE(stage_.AddSpeech("salvete", track).ok());
    EXPECT_TRUE(stage_.sounds().Add("street", 20.0).ok());
    EXPECT_TRUE(stage_.sounds().Add("pour", 1.5).ok());
  }
  void Add(const char* name, stage::Prop prop, const stage::Pose& pose) {
    EXPECT_TRUE(stage_.AddObject(name, test::Model(std::move(prop)), pose).ok());
  }

  stage::Stage stage_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
};

TEST_F(ManualTest, EveryExampleRuns) {
  const auto examples = Examples();
  ASSERT_GE(examples.size(), 7u);
  for (const Example& example : examples) {
    SCOPED_TRACE("docs/drama.md:" + std::to_string(example.line));
    const auto drama = Drama::Create(example.script, "drama.md", stage_, {}, *log_);
    ASSERT_TRUE(drama.ok()) << drama.message();
    // A visitor comes, looks at the keeper and then at the chest.
    for (int tick = 0; tick < 35 * Drama::kTicksPerSecond; ++tick) {
      Visitor visitor;
      visitor.tracked = true;
      visitor.position = {0.0f, 1.6f, tick < 600 ? 4.0f : 2.2f};
      visitor.direction = {tick < 300 ? 0.0f : 0.53f, tick < 300 ? 0.0f : -0.2f,
                           tick < 300 ? -1.0f : -0.82f};
      (*drama)->SetVisitor(visitor);
      (*drama)->Tick();
    }
    EXPECT_EQ(FirstError(**drama), "");
    const auto timeline = TimelineText::Read(example.script, "drama.md");
    ASSERT_TRUE(timeline.ok()) << timeline.message();
    EXPECT_THAT(timeline->problems(), IsEmpty());
  }
}

// Names that the manual's examples call: name(, name{, :name(, :name{.
bool IsCalled(const std::string& script, const std::string& name, bool is_method) {
  for (size_t at = script.find(name); at != std::string::npos; at = script.find(name, at + 1)) {
    const char before = at == 0 ? ' ' : script[at - 1];
    const char after = at + name.size() < script.size() ? script[at + name.size()] : ' ';
    const bool whole = std::isalnum(static_cast<unsigned char>(before)) == 0 && before != '_';
    const bool called = after == '(' || after == '{' || (before == '.' && after == ',');
    if (whole && called && (is_method == (before == ':' || before == '.'))) {
      return true;
    }
  }
  return false;
}

TEST_F(ManualTest, EveryWordHasAnExample) {
  std::string all;
  for (const Example& example : Examples()) {
    all += example.script;
  }
  std::istringstream library(MustRead(test::SourceDir() / "lua/library/lararium.lua"));
  std::string line;
  int words = 0;
  while (std::getline(library, line)) {
    if (!line.starts_with("function ")) {
      continue;
    }
    ++words;
    const std::string full = line.substr(9, line.find('(') - 9);
    const size_t colon = full.find(':');
    const std::string name = colon == std::string::npos ? full : full.substr(colon + 1);
    EXPECT_TRUE(IsCalled(all, name, colon != std::string::npos)) << full;
  }
  EXPECT_GT(words, 60);
}

}  // namespace
}  // namespace lararium::drama
