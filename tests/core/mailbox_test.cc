#include "shared/core/mailbox.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace lararium {
namespace {

TEST(Mailbox, TheNewestMessageWins) {
  Mailbox<int> box;
  box.Put(1);
  box.Put(2);
  EXPECT_EQ(box.dropped(), 1u);
  EXPECT_EQ(box.TryTake(), 2);
  EXPECT_EQ(box.TryTake(), std::nullopt);
}

TEST(Mailbox, WhatNobodyTookIsGivenBack) {
  Mailbox<std::unique_ptr<int>> box;
  EXPECT_EQ(box.Put(std::make_unique<int>(1)), std::nullopt);
  EXPECT_EQ(**box.Put(std::make_unique<int>(2)), 1);
  EXPECT_EQ(**box.TryTake(), 2);
}

TEST(Mailbox, CloseHandsOutTheLastMessageThenEnds) {
  Mailbox<int> box;
  box.Put(1);
  box.Close();
  EXPECT_FALSE(box.Finished());
  EXPECT_EQ(box.Take({}), 1);
  EXPECT_TRUE(box.Finished());
  EXPECT_EQ(box.Take({}), std::nullopt);
}

TEST(Mailbox, AStopRequestWakesTheReader) {
  Mailbox<int> box;
  std::jthread reader([&](std::stop_token stop) { EXPECT_EQ(box.Take(stop), std::nullopt); });
  reader.request_stop();
}

TEST(Mailbox, MessagesArriveInOrderAndTheLastOneAlways) {
  Mailbox<std::unique_ptr<int>> box;
  std::jthread writer([&] {
    for (int i = 1; i <= 10'000; ++i) {
      box.Put(std::make_unique<int>(i));
    }
    box.Close();
  });
  int last = 0;
  uint64_t taken = 0;
  while (const auto message = box.Take({})) {
    EXPECT_GT(**message, last);
    last = **message;
    ++taken;
  }
  EXPECT_EQ(last, 10'000);
  EXPECT_EQ(taken + box.dropped(), 10'000u);
}

}  // namespace
}  // namespace lararium
