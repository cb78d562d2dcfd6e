// Following allocates nothing in steady state. Its own program: it replaces the
// global allocator.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "shared/vision/tracker.h"
#include "tests/vision/poster.h"

namespace {

thread_local bool counting = false;
thread_local int allocations = 0;

void* Allocate(size_t size, size_t alignment) {
  allocations += counting ? 1 : 0;
  void* memory = nullptr;
  if (posix_memalign(&memory, alignment < sizeof(void*) ? sizeof(void*) : alignment,
                     size == 0 ? 1 : size) != 0) {
    std::abort();
  }
  return memory;
}

}  // namespace

void* operator new(size_t size) { return Allocate(size, 16); }
void* operator new[](size_t size) { return Allocate(size, 16); }
void* operator new(size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<size_t>(alignment));
}
void* operator new[](size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }

namespace lararium::vision {
namespace {

TEST(Following, AllocatesNothingInSteadyState) {
  const cv::Mat poster = test::MakePoster();
  auto tracker = *CreateTracker({test::MapOfPoster(poster)}, test::kPosterCamera, {});
  for (int i = 0; i < 40; ++i) {
    const geometry::Frame frame =
        test::PhotographPoster(poster, test::PosterPose(0.005 * i, 0.002 * i, 1.5), i);
    allocations = 0;
    counting = true;
    const TrackedFrame tracked = tracker->Track(frame);
    counting = false;
    ASSERT_TRUE(tracked.camera_from_map.has_value());
    if (i == 0) {
      EXPECT_GT(allocations, 0);  // the count counts
    } else if (i >= 5) {
      EXPECT_TRUE(tracked.followed);
      EXPECT_EQ(allocations, 0) << "frame " << i;
    }
  }
}

}  // namespace
}  // namespace lararium::vision
