#include "editor/session/message_log.h"

#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

TEST(MessageLog, DoesNotRepeatTheNewestMessageAndCountsThoseThatWereRemoved) {
  MessageLog log;
  log.Tell(Message::Level::kInfo, "one");
  log.Tell(Message::Level::kInfo, "one");
  EXPECT_EQ(log.told(), 1u);
  for (int i = 0; i < 500; ++i) {
    log.Tell(Message::Level::kInfo, std::to_string(i));
  }
  EXPECT_EQ(log.told(), 501u);
  EXPECT_LT(log.entries().size(), 500u);
  EXPECT_EQ(log.entries().back().text, "499");
}

TEST(MessageLog, ReportsHowATaskEnded) {
  MessageLog log;
  log.Report(Status(), false, "done");
  EXPECT_EQ(log.entries().back().text, "done");
  log.Report(Status::Error("here", "went wrong"), false, "done");
  EXPECT_EQ(log.entries().back().level, Message::Level::kError);
  EXPECT_EQ(log.entries().back().text, "here: went wrong");
  log.Report(Status::Error("here", "cancelled"), true, "done");
  EXPECT_EQ(log.entries().back().level, Message::Level::kInfo);
  EXPECT_FALSE(log.TellFailure(Status()));
  EXPECT_TRUE(log.TellFailure(Status::Error("here", "went wrong")));
}

}  // namespace
}  // namespace lararium::editor
