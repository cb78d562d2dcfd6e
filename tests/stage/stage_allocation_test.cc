// A busy stage allocates nothing from tick to tick. Its own program: it replaces the
// global allocator.

#include <gtest/gtest.h>

#include "shared/stage/stage.h"
#include "tests/stage/test_human.h"
#include "tests/stage/test_props.h"
#include "tests/support/allocation_counter.h"

namespace lararium::stage {
namespace {

TEST(Stage, ATickAllocatesNothing) {
  Stage stage;
  std::array<ActorId, 4> actors;
  for (size_t i = 0; i < actors.size(); ++i) {
    actors[i] = *stage.Add("a" + std::to_string(i), test::MakeTestHuman());
    stage.Place(actors[i], {static_cast<float>(i) - 1.5f, 0.0f, -3.0f}, 0.0f);
    stage.Show(actors[i], true);
  }
  const ObjectId chest = *stage.AddObject("chest", test::Model(test::MakeChest()), {});
  const ObjectId cup = *stage.AddObject("cup", test::Model(test::MakeCup()), {{2.0f, 0.0f, 0.0f}});
  StageSnapshot previous, current, drawn;
  const auto tick = [&] {
    stage.Advance();
    stage.Perform();
    std::swap(previous, current);
    stage.Capture(current);
    Interpolate(previous, current, 0.5f, drawn);
  };
  PutTarget back;
  back.place = {2.0f, 0.0f};
  const auto demand = [&] {
    EXPECT_TRUE(stage.tasks().Use(actors[0], chest, "open", 0.0f).ok());
    EXPECT_TRUE(stage.tasks().Take(actors[1], cup).ok());
    EXPECT_TRUE(stage.tasks().Give(actors[1], cup, actors[2]).ok());
    EXPECT_TRUE(stage.tasks().Use(actors[3], chest, "shut", 0.0f).ok());
    EXPECT_TRUE(stage.tasks().Walk(actors[0], {-3.0f, 3.0f}, 1.0f, 0.0f).ok());
    EXPECT_TRUE(stage.tasks().Put(actors[2], cup, back).ok());
  };
  demand();
  for (int i = 0; i < 10; ++i) {
    tick();
  }
  test::AllocationCounter counter;
  for (int i = 0; i < 60 * 120; ++i) {
    tick();
  }
  EXPECT_EQ(counter.Stop(), 0);
  EXPECT_FALSE(stage.tasks().any()) << "everything was done meanwhile";
  EXPECT_FALSE(stage.Find(cup)->state.holder);
  EXPECT_EQ(stage.Find(chest)->state.state, 0);
}

}  // namespace
}  // namespace lararium::stage
