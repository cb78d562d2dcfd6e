#include "editor/bake/line_folder.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/test_files.h"

namespace lararium::bake {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class LineFolderTest : public ::testing::Test {
 protected:
  LineFolder With(const std::vector<std::string>& files, const std::vector<std::string>& ids) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      std::filesystem::remove_all(entry.path());
    }
    for (const std::string& file : files) {
      std::ofstream(folder_ / file) << "x";
    }
    std::vector<Line> lines;
    for (const std::string& id : ids) {
      lines.emplace_back().id = id;
    }
    return {folder_.path(), lines};
  }
  std::string RecordingOf(const LineFolder& folder, const std::string& line) {
    const auto found = folder.Recording(line);
    return found.ok() ? found->filename().string() : found.message();
  }

  test::TemporaryFolder folder_;
};

TEST_F(LineFolderTest, FindsRecordingsWhateverTheirCaseAndContainer) {
  for (const char* file :
       {"hail.wav", "hail.WAV", "Hail.wav", "HAIL.Flac", "hail.m4a", "hail.MP3", "hail.ogg",
        "hail.oga", "hail.opus", "hail.aiff", "hail.mov", "hail .wav"}) {
    EXPECT_EQ(RecordingOf(With({file, "hail.txt", "._hail.wav"}, {"hail", "vale"}), "hail"), file);
  }
  EXPECT_EQ(RecordingOf(With({"a-b.wav"}, {"a_b"}), "a_b"), "a-b.wav");
  EXPECT_EQ(RecordingOf(With({}, {"hail"}), "hail"), "");
  EXPECT_EQ(RecordingOf({folder_ / "missing", {}}, "hail"), "");
}

TEST_F(LineFolderTest, TheNameThatFitsExactlyCounts) {
  const LineFolder folder = With({"hail.wav", "Hail.wav"}, {"hail", "Hail"});
  EXPECT_EQ(RecordingOf(folder, "hail"), "hail.wav");
  EXPECT_EQ(RecordingOf(folder, "Hail"), "Hail.wav");
  EXPECT_EQ(RecordingOf(With({"Hail.wav"}, {"hail", "Hail"}), "hail"), "")
      << "the recording of another line";
  EXPECT_EQ(RecordingOf(With({"hail.wav", "Hail.wav"}, {"hail"}), "hail"), "hail.wav");
}

TEST_F(LineFolderTest, TwoRecordingsOfALineAreAnError) {
  for (const char* other : {"hail.flac", "hail.WAV"}) {
    EXPECT_THAT(RecordingOf(With({"hail.wav", other}, {"hail"}), "hail"), HasSubstr("keep one"));
  }
}

TEST_F(LineFolderTest, FindsCaptionsByLineAndLanguage) {
  const LineFolder folder =
      With({"hail.it.SRT", "Hail.pt_BR.vtt", "vale.it.srt", "vale.it.vtt"}, {"hail", "vale"});
  EXPECT_EQ(folder.Captions("hail", "it")->filename(), "hail.it.SRT");
  EXPECT_EQ(folder.Captions("hail", "pt-BR")->filename(), "Hail.pt_BR.vtt");
  EXPECT_EQ(*folder.Captions("hail", "en"), "");
  EXPECT_FALSE(folder.Captions("vale", "it").ok());
  EXPECT_THAT(folder.Strays(), IsEmpty());
}

TEST_F(LineFolderTest, ToldOfAFileThatBelongsToNoLineWhichItNearlyFits) {
  const auto line_of = [&](const std::string& file, const std::vector<std::string>& others = {}) {
    std::vector<std::string> files = others;
    files.push_back(file);
    const auto strays = With(files, {"salvete", "vale", "d_bar", "a"}).Strays();
    return strays.size() == 1 ? strays[0].line : "none";
  };
  EXPECT_EQ(line_of("salvete (1).wav"), "salvete");
  EXPECT_EQ(line_of("01 - Salvete final.WAV"), "salvete");
  EXPECT_EQ(line_of("salvette.mp3"), "salvete");
  EXPECT_EQ(line_of("salvēte.wav"), "salvete");
  EXPECT_EQ(line_of("dbar.ogg"), "d_bar");
  EXPECT_EQ(line_of("vale2.wav"), "vale");
  EXPECT_EQ(line_of("vale2.wav", {"vale.wav"}), "") << "that line has its recording";
  EXPECT_EQ(line_of("noise.wav"), "");
  EXPECT_EQ(line_of("other.it.srt"), "");
  EXPECT_EQ(line_of("notes.txt"), "none");
}

}  // namespace
}  // namespace lararium::bake
