#include "editor/session/task_text.h"

#include <gtest/gtest.h>

#include "editor/text/text.h"

namespace lararium::editor {
namespace {

// Sets the texts of the process back to English.
class TaskTextTest : public testing::Test {
 protected:
  ~TaskTextTest() override { LoadTexts(LARARIUM_LOCALE_DIR, "en"); }
};

TEST_F(TaskTextTest, NamesTheTaskItsStepAndTheTimeLeft) {
  EXPECT_EQ(TaskText(TaskKind::kExporting, {.step = "packing", .fraction = 0.5, .seconds = 20.0}),
            "Exporting: packing, 20 s left");
}

TEST_F(TaskTextTest, SaysWhichOfTheStepsIsAtWorkWhereTheyAreKnown) {
  EXPECT_EQ(TaskText(TaskKind::kTraining, {.step = "matching", .number = 3, .count = 7}),
            "Training: matching (3 of 7)");
}

TEST_F(TaskTextTest, SaysNoTimeBeforeItIsKnownAndNoStepThatIsCalledAlike) {
  EXPECT_EQ(TaskText(TaskKind::kExporting, {.step = "exporting"}), "Exporting");
  EXPECT_EQ(TaskText(TaskKind::kExporting, {}), "Exporting");
}

TEST_F(TaskTextTest, IsInTheLanguageOfTheInterface) {
  LoadTexts(LARARIUM_LOCALE_DIR, "it");
  EXPECT_EQ(TaskText(TaskKind::kExporting, {.step = "writing", .fraction = 0.5, .seconds = 20.0}),
            std::string(Tr("Exporting")) + ": scrittura, ancora 20 s");
}

}  // namespace
}  // namespace lararium::editor
